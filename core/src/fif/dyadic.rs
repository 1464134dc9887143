//! A function on a uniform dyadic partition, compiled to 32-bit words: the address walk is a shift.
//!
//! With `N = 2^b` equal intervals the digits of an abscissa are its bits. Several digits are taken at once where there is room for the composites of all
//! their maps (eq. 24-28), which are a system for the same function. The value is built from the last digit to the first,
//! `y <- alpha_j y + q_j(u)`, `u <- (j + u) / N`: no polynomial is composed, and each step contracts the error of the last. Words have as many fractional bits
//! as the range of the function allows (24 to 30), products add up in 64 bits and are rounded once a level.

use heapless::Vec;

use super::function::Fif;
use super::value::{FRACTION, ONE};
use crate::num::{Angle, Real, product, round_shift};

/// One map in 32-bit words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
struct Words<const D: usize> {
    /// The constant coefficient, 31 fractional bits more than a word, and half a unit of a word.
    constant: i64,
    /// 31 fractional bits.
    scaling: i32,
    powers: [i32; D],
}

/// A [`Fif`] on `2^b` equal intervals, ready for fast evaluation at dyadic abscissae of up to 32 bits, with room for `M` maps.
///
/// ```
/// use attractor::fif::{Fif, Knot};
/// use attractor::num::{Angle, Real, Scaling, Wide};
///
/// let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
/// let f = Fif::<2, 1>::interpolating(&knots, &[Scaling::from_num(0.5); 2])?;
/// let fast = f.dyadic::<16>().expect("two equal intervals");
/// assert_eq!(fast.at(Angle::from_num(0.75)), Real::from_num(1)); // x = 1.5
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dyadic<const M: usize, const D: usize = 1> {
    maps: Vec<Words<D>, M>,
    /// Bits a step, and `2^9` over that, rounded up.
    bits: u32,
    per_bits: u32,
    /// Fractional bits of a word.
    fraction: u32,
    first: i32,
    error: Real,
}

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The function compiled for its dyadic partition, with room for `M` maps: the more, the more digits are taken at once. With two intervals
    /// `M` = 2 takes one binary digit a step, 16 takes four.
    ///
    /// None if the intervals are not `2^b` equal ones, `1 <= b <= 8`, or `M` is less than `2^b`.
    pub fn dyadic<const M: usize>(&self) -> Option<Dyadic<M, D>> {
        let count = self.maps.len();
        if !count.is_power_of_two() || !(2..=256).contains(&count) || M < count {
            return None;
        }
        let digit = count.trailing_zeros();
        if self.maps.iter().zip(0_u64..).any(|(m, j)| m.start != j << (63 - digit) || m.width != ONE >> digit)
        {
            return None;
        }
        // as many digits a step as there is room for: the composites of all addresses of that length are again such a system
        let (mut bits, mut digits) = (digit, 1);
        while bits + digit <= 8 && M >> (bits + digit) > 0 {
            bits += digit;
            digits += 1;
        }
        let composite = |address: usize| {
            self.composite((0..digits).rev().map(|k| (address >> (k * digit)) & (count - 1)))
        };
        // the largest number that a word must hold: a value, or a partial sum of Horner's scheme without the constant
        let mut largest = self.range.0.saturating_abs().max(self.range.1.saturating_abs());
        let mut steepest = 0;
        for address in 0..1_usize << bits {
            let map = composite(address);
            let powers = map.q.powers.iter().fold(0_i64, |s, c| s.saturating_add(c.saturating_abs()));
            largest = largest.max(powers);
            steepest = steepest.max(map.scaling.unsigned_abs());
        }
        // words with `fraction` bits: largest * 2^(fraction - 55) < 2^31
        let integer_bits = (64 - largest.leading_zeros()).saturating_sub(FRACTION);
        let fraction = 31_u32.saturating_sub(integer_bits).clamp(20, 30);
        let word = |v: i64| {
            round_shift(v, FRACTION - fraction).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
        };
        let mut maps = Vec::new();
        for address in 0..1_usize << bits {
            let map = composite(address);
            // wraps for large constants, as the sums do; the final sum is a value and fits
            let constant = if fraction >= 24 {
                map.q.constant.wrapping_shl(fraction - 24)
            } else {
                map.q.constant >> (24 - fraction)
            };
            // 2^bits <= M: never full
            let _ = maps.push(Words {
                constant: constant.wrapping_add(1 << 30),
                scaling: round_shift(map.scaling, 32).min(i64::from(i32::MAX)) as i32,
                powers: map.q.powers.map(word),
            });
        }
        let units = 3 * D as u64 + 1; // half units of a word a step
        let rest = ((1 << 31) - (steepest >> 32)).saturating_sub(1).max(1);
        let sum = (units << (24 + 30 - fraction)).div_ceil(rest);
        let error = Real::from_bits(sum.saturating_add(1).min(i32::MAX as u64) as i32);
        Some(Dyadic { maps, bits, per_bits: per_bits(bits), fraction, first: word(self.first), error })
    }
}

impl<const M: usize, const D: usize> Dyadic<M, D> {
    /// The value at the place `u` of the domain, a fraction in `[0, 1)`.
    ///
    /// Error: at most [`Dyadic::error_bound`] where the maps are exact (row `Dyadic::at (f of figure 1)`). Cost: 7.2 Cortex-M4 instructions
    /// (kernel `fif dyadic level`) a level for degree 1; as many levels as `u` has digits before its trailing zeros.
    #[inline]
    pub fn at(&self, u: Angle) -> Real {
        real(self.word(u.to_bits()), self.fraction)
    }

    /// A bound on the error of [`Dyadic::at`]: `(3 D + 1) / 2` units of a word over `1 - max|alpha|`, and the result's rounding.
    pub fn error_bound(&self) -> Real {
        self.error
    }

    #[inline]
    fn word(&self, u: u32) -> i32 {
        let bits = self.bits;
        // digits up to the last that is not 0; the rest of the address stays on the first knot
        let mut left = whole_part(32 + bits - 1 - u.trailing_zeros(), self.per_bits);
        // the digits, the last one lowest; where b does not divide 32 the last one is filled up with zeros
        let total = left * bits;
        let (mut digits, filled) = if total > 32 { (u, total - 32) } else { (u >> ((32 - total) & 31), 0) };
        let mask = (1_u32 << bits) - 1;
        let mut digit = (digits << filled) & mask;
        digits >>= bits - filled;
        let mut t = 0_u32; // the pre-image, 31 fractional bits
        let mut y = self.first;
        while left > 0 {
            // digit < N = maps.len(): `get` only spares the proof to the compiler
            let Some(map) = self.maps.get(digit as usize) else { break };
            let mut q = 0_i32;
            for (k, c) in map.powers.iter().enumerate().rev() {
                q = q.wrapping_add(*c);
                if k > 0 {
                    q = (product(q, t as i32) >> 31) as i32;
                }
            }
            let sum = map.constant.wrapping_add(product(q, t as i32)).wrapping_add(product(y, map.scaling));
            y = (sum >> 31) as i32;
            t = (t >> bits) | (digit << (31 - bits));
            digit = digits & mask;
            digits >>= bits;
            left -= 1;
        }
        y
    }
}

/// As [`crate::num::real_from`], without its 64 bits.
#[inline(always)]
fn real(word: i32, fraction: u32) -> Real {
    Real::from_bits(match fraction.checked_sub(24) {
        Some(0) => word,
        Some(places) => (word >> (places & 31)) + ((word >> ((places - 1) & 31)) & 1),
        None => word.saturating_mul(1 << ((24 - fraction) & 31)),
    })
}

/// `2^9 / bits`, rounded up.
fn per_bits(bits: u32) -> u32 {
    512_u32.div_ceil(bits)
}

/// `n / bits`, rounded down, for `n` below 64 and at most 8 bits: a Cortex-M0 has no division.
#[inline(always)]
fn whole_part(n: u32, per_bits: u32) -> u32 {
    (n * per_bits) >> 9
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fif::Knot;
    use crate::num::{Scaling, Wide};

    /// Constants between two words of 24 fractional bits: steps round to the nearest.
    #[test]
    fn a_step_rounds_to_the_nearest_word() {
        for quarters in [0, 1, 3, 4, 5, 7] {
            for sign in [1, -1] {
                let y = Wide::from_bits(sign * ((100 << 48) + (quarters << 22)));
                let knots = [0, 1, 2].map(|x| Knot::new(Wide::from_num(x), y));
                let f = Fif::<2, 1>::interpolating(&knots, &[Scaling::ZERO; 2]).unwrap();
                let fast = f.dyadic::<2>().unwrap();
                assert_eq!(fast.fraction, 24);
                let nearest = Real::from_bits((sign * ((100 << 24) + (quarters + 2) / 4)) as i32);
                for u in [0.0, 0.5, 0.25, 0.75, 0.625] {
                    assert_eq!(fast.at(Angle::from_num(u)), nearest, "{y} at {u}");
                }
            }
        }
    }

    /// Digits that are taken one, two, three, four at a time make one function, addresses whose length is no multiple of them too.
    #[test]
    fn the_digits_a_step_do_not_change_the_function() {
        let knots = [(0, 1), (1, 3), (2, -2)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let f =
            Fif::<2, 1>::interpolating(&knots, &[Scaling::from_num(0.75), Scaling::from_num(-0.5)]).unwrap();
        let (one, three, four) =
            (f.dyadic::<2>().unwrap(), f.dyadic::<8>().unwrap(), f.dyadic::<16>().unwrap());
        assert_eq!([one.bits, three.bits, four.bits], [1, 3, 4]);
        for i in 0..2000_u32 {
            let u = i.wrapping_mul(0x9e37_79b9) >> (i % 32) << (i % 32);
            let x = Wide::from_bits(i64::from(u) << 17);
            let exact = f.at_wide(x).to_num::<f64>();
            for (got, bound) in [
                (one.at(Angle::from_bits(u)), one.error_bound()),
                (three.at(Angle::from_bits(u)), three.error_bound()),
                (four.at(Angle::from_bits(u)), four.error_bound()),
            ] {
                assert!((got.to_num::<f64>() - exact).abs() <= bound.to_num::<f64>(), "{u:#x}");
            }
        }
    }

    #[test]
    fn a_word_becomes_the_nearest_number() {
        for fraction in 20..=30 {
            for word in [i32::MIN, -0x1357_9bdf, -65, -33, -32, -8, -3, -1, 0, 1, 2, 31, 32, 96, i32::MAX] {
                assert_eq!(
                    real(word, fraction),
                    crate::num::real_from(word.into(), fraction),
                    "{word} {fraction}"
                );
            }
        }
    }

    #[test]
    fn digits_are_counted_exactly() {
        for bits in 1..=8 {
            for n in 0..64 {
                assert_eq!(whole_part(n, per_bits(bits)), n / bits, "{n} / {bits}");
            }
        }
    }

    #[test]
    fn only_equal_intervals_with_room_are_compiled() {
        let through = |xs: [i32; 3]| {
            let knots = xs.map(|x| Knot::new(Wide::from_num(x), Wide::ZERO));
            Fif::<2, 1>::interpolating(&knots, &[Scaling::ZERO; 2]).unwrap()
        };
        assert!(through([0, 1, 2]).dyadic::<2>().is_some() && through([0, 1, 2]).dyadic::<1>().is_none());
        assert!(through([0, 1, 3]).dyadic::<2>().is_none());
    }
}
