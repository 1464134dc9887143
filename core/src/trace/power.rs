//! Products and powers of numbers in `[0, 1]`, as highlights take them.
//!
//! Format: 30 fractional bits, each product to the nearest.

use crate::num::{Unit, high_u};

/// The product of two numbers in `[0, 1]`.
#[inline]
pub(super) fn times(a: Unit, b: Unit) -> Unit {
    Unit::from_bits(((i64::from(a.to_bits()) * i64::from(b.to_bits()) + (1 << 29)) >> 30) as i32)
}

/// `base^exponent` by squaring, for a base in `[0, 1]`.
#[inline]
pub(super) fn power(base: Unit, exponent: u16) -> Unit {
    let (mut result, mut square, mut rest) = (Unit::ONE, base, exponent);
    while rest > 0 {
        if rest & 1 == 1 {
            result = times(result, square);
        }
        square = times(square, square);
        rest >>= 1;
    }
    result
}

/// An exponent above 0, as an odd number times so many twos.
#[derive(Debug, Clone, Copy)]
pub(super) struct Exponent {
    odd: u32,
    twos: u32,
}

impl Exponent {
    /// None of 0.
    pub(super) const fn new(exponent: u16) -> Option<Self> {
        let twos = exponent.trailing_zeros();
        match exponent.checked_shr(twos) {
            None => None,
            Some(odd) => Some(Self { odd: odd as u32, twos }),
        }
    }

    /// `base^exponent` of some bases at once, 30 fractional bits, in 32; what is not in `[0, 1]` counts as
    /// the nearer end.
    ///
    /// Each product is rounded down: short of the power by less than `exponent / 2^30`.
    #[inline(always)]
    pub(super) fn powers<const N: usize>(self, bases: [i32; N]) -> [u32; N] {
        let squares = |square: [u32; N]| square.map(|s| high_u(s, s));
        let mut square = bases.map(|base| (base.clamp(0, (1 << 30) - 1) as u32) << 2);
        for _ in 0..self.twos {
            square = squares(square);
        }
        let (mut result, mut rest) = (square, self.odd);
        while rest > 1 {
            square = squares(square);
            rest >>= 1;
            if rest & 1 == 1 {
                for (r, s) in result.iter_mut().zip(square) {
                    *r = high_u(*r, s);
                }
            }
        }
        result
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against floating point, and against the power of one base.
    #[test]
    fn four_powers_are_short_of_theirs_by_little() {
        let mut worst: f64 = 0.0;
        for exponent in (0..=70).chain([128, 1000, 4097, u16::MAX]) {
            for i in 0..200_i32 {
                let bases = [i, 2 * i, 3 * i, 5 * i].map(|i| (1 << 30) - i * i * 20);
                let powers = Exponent::new(exponent).map_or([u32::MAX; 4], |exponent| exponent.powers(bases));
                for (base, got) in bases.into_iter().zip(powers.map(|power| (power >> 2) as i32)) {
                    let exact = (f64::from(base) / 2_f64.powi(30)).powi(exponent.into()) * 2_f64.powi(30);
                    let short = (exact - f64::from(got)) / f64::from(exponent.max(1));
                    assert!((-1e-3..1.0 + 1e-3).contains(&short), "{base} {exponent}: {short}");
                    worst = worst.max(short);
                    let one = power(Unit::from_bits(base), exponent).to_bits();
                    assert!(one.abs_diff(got) <= u32::from(exponent) + 1, "{base} {exponent}: {one} {got}");
                }
            }
        }
        assert!(worst > 0.5, "{worst}");
        let cubes = Exponent::new(3).map(|three| three.powers([i32::MIN, -1, 0, i32::MAX]));
        assert_eq!(cubes.map(|cubes| cubes.map(|cube| cube >> 2)), Some([0, 0, 0, (1 << 30) - 3]));
        assert!(Exponent::new(0).is_none());
    }
}
