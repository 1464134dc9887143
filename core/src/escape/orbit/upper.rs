//! Bounds of sizes from above, for proofs: every operation rounds up.
//!
//! The radius of a disc that is carried along an orbit is such a number: it may be too large, but never too
//! small, or what it proves would be wrong.
//!
//! `mantissa 2^exponent`, the mantissa at least `2^31`; a result is too large by less than `2^-27` of itself,
//! and never too small (`bounds_are_above_and_near`).

use crate::escape::orbit::block_float::BlockFloat;
use crate::num::{product_u, root_and_reciprocal};

/// Greater than 0. The order of the fields is that of the numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Upper {
    exponent: i32,
    mantissa: u32,
}

impl Upper {
    const HIGHEST: u32 = 1 << 31;

    /// `2^exponent`.
    pub(crate) const fn power(exponent: i32) -> Self {
        Self { exponent: exponent.saturating_sub(31), mantissa: Self::HIGHEST }
    }

    /// `|z|` of all `z` that are rounded to this block.
    #[inline]
    pub(crate) fn of(block: BlockFloat) -> Self {
        let (square, twice) = block.square();
        if square == 0 {
            return Self::power(block.exponent);
        }
        // the root may be a unit too low, and each part of the block was rounded by half a unit
        let (root, ..) = root_and_reciprocal(square);
        let up = root.saturating_add(2);
        let places = up.leading_zeros();
        Self { exponent: (twice >> 1).saturating_sub(places as i32), mantissa: up << (places & 31) }
    }

    /// The product.
    #[inline]
    pub(crate) fn times(self, other: Self) -> Self {
        // at least 2^62, at most 2^64 - 2^33 + 1
        let high = (product_u(self.mantissa, other.mantissa) >> 32) as u32;
        let exponent = self.exponent.saturating_add(other.exponent).saturating_add(32);
        let up = high.saturating_add(1);
        if up < Self::HIGHEST {
            Self { exponent: exponent.saturating_sub(1), mantissa: up << 1 }
        } else {
            Self { exponent, mantissa: up }
        }
    }

    /// The sum.
    #[inline]
    pub(crate) fn plus(self, other: Self) -> Self {
        let (large, small) = if self >= other { (self, other) } else { (other, self) };
        let apart = large.exponent.saturating_sub(small.exponent);
        let low = if apart < 32 { small.mantissa >> (apart & 31) } else { 0 };
        // below 2^33
        let sum = u64::from(large.mantissa) + u64::from(low) + 1;
        if sum >> 32 == 0 {
            Self { exponent: large.exponent, mantissa: sum as u32 }
        } else {
            Self {
                exponent: large.exponent.saturating_add(1),
                mantissa: ((sum >> 1) as u32).saturating_add(1),
            }
        }
    }

    /// The number times `2^places`.
    #[inline]
    pub(crate) const fn scaled(self, places: i32) -> Self {
        Self { exponent: self.exponent.saturating_add(places), ..self }
    }

    /// An exponent of 2 that `2 / (1 - self)` is at most; none for 1 and above.
    #[inline]
    pub(crate) fn twice_over_rest(self) -> Option<i32> {
        let rest = match self.exponent {
            // what is missing to 1, in units of 2^-32
            -32 => self.mantissa.wrapping_neg(),
            ..-32 => Self::HIGHEST,
            _ => return None,
        };
        rest.checked_ilog2().map(|floor| 33 - floor as i32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(u: Upper) -> f64 {
        f64::from(u.mantissa) * 2_f64.powi(u.exponent)
    }

    #[test]
    fn bounds_are_above_and_near() {
        let near = |got: Upper, exact: f64| {
            assert!(got.mantissa >= 1 << 31);
            // f64 rounds by 2^-52
            let over = value(got) / exact - 1.0;
            assert!((-1e-15..2_f64.powi(-27)).contains(&over), "{over:e}");
        };
        let mut word = 1_u64;
        let mut next = || {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (word as i64) >> (2 + (word & 31))
        };
        for k in 0..5000 {
            let (re, im) = (next(), next());
            let a = BlockFloat::<i32>::new(re, im, -60);
            let exact = (re as f64).hypot(im as f64) * 2_f64.powi(-60);
            near(Upper::of(a), exact);
            let b = Upper::of(BlockFloat::<i32>::new(next(), next(), -60 + k % 40));
            let a = Upper::of(a);
            near(a.times(b), value(a) * value(b));
            near(a.plus(b), value(a) + value(b));
            assert_eq!(a < b, value(a) < value(b));
            if let Some(places) = a.twice_over_rest() {
                let ratio = 2_f64.powi(places) * (1.0 - value(a)) / 2.0;
                assert!((1.0..=4.0).contains(&ratio), "{ratio}");
            } else {
                assert!(value(a) >= 1.0);
            }
        }
    }

    #[test]
    fn no_exponent_wraps() {
        let ends = [
            Upper::power(i32::MIN),
            Upper::power(i32::MAX),
            Upper::power(0),
            Upper::of(BlockFloat::<i32>::ZERO),
        ];
        for (a, b) in ends.into_iter().flat_map(|a| ends.map(|b| (a, b))) {
            assert!(a.plus(b) >= a.max(b));
            let _ = (a.times(b), a.scaled(i32::MIN), b.scaled(i32::MAX), a.twice_over_rest());
        }
        let all = Upper { exponent: 0, mantissa: u32::MAX };
        assert!(value(all.times(all)) > value(all) * value(all) && value(all.plus(all)) >= 2.0 * value(all));
    }
}
