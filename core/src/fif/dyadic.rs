//! A function on a uniform dyadic partition, compiled to 32-bit words: the address walk is a shift.
//!
//! With `N = 2^b` equal intervals the digits of an abscissa are its bits. Several digits are taken at once
//! where there is room for the composites of all their maps (eq. 24-28), which are a system for the same
//! function. The value is built from the last digit to the first, `y <- alpha_j y + q_j(u)`,
//! `u <- (j + u) / N`: no polynomial is composed, and each step contracts the error of the last. Words have
//! as many fractional bits as the range of the function allows (24 to 30), products add up in 64 bits and are
//! rounded once a level.

use heapless::Vec;

use super::compose::Composite;
use super::error::up;
use super::function::Fif;
use super::value::{FRACTION_Q55, ONE_UQ63, fraction_for, real, word};
use crate::num::{Angle, Real, mul_high_u, product, ratio, round_shift};

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

/// A [`Fif`] on `2^b` equal intervals, ready for fast evaluation at dyadic abscissae of up to 32 bits, with
/// room for `M` maps.
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

/// What the words of a function lose, 55 fractional bits.
struct Errors {
    /// A unit of a word.
    unit: u64,
    /// No value is larger.
    value: u64,
    /// The most that a step loses beside its rounding.
    step: u64,
    /// 31 fractional bits.
    steepest: u32,
}

impl Errors {
    /// The powers' bits beyond a word, a unit for each product of Horner's scheme that is cut, the scaling's
    /// bits beyond 31 at the largest value.
    fn add<const D: usize>(&mut self, map: &Composite<D>, words: &Words<D>) {
        let lost =
            |exact: i64, word: i32, unit: u64| exact.abs_diff(i64::from(word).wrapping_mul(unit as i64));
        let powers = map.q.powers.iter().zip(&words.powers);
        let powers = powers.fold(0_u64, |sum, (c, word)| sum.saturating_add(lost(*c, *word, self.unit)));
        let cut = (map.q.degree() as u64).saturating_sub(1).saturating_mul(self.unit);
        let scaling = mul_high_u(self.value << 1, lost(map.scaling, words.scaling, 1 << 32)) + 1;
        self.step = self.step.max(powers.saturating_add(cut).saturating_add(scaling));
        self.steepest = self.steepest.max(words.scaling.unsigned_abs());
    }

    /// With half a unit for a step's rounding, over `1 - max|alpha|`, and the result's. A composite of
    /// `digits` maps has coefficients that are off by less than `4 D + 4` for each.
    fn bound(&self, coefficients: u64, digits: u64) -> Real {
        let composed = digits * coefficients * 4 * coefficients;
        let step = self.step.saturating_add(self.unit / 2).saturating_add(composed);
        let rest = (1_u32 << 31).saturating_sub(self.steepest).max(1);
        // words of 24 bits and fewer are results
        let result = if self.unit < 1 << 31 { 1 << 30 } else { 0 };
        up(ratio(step, 31, rest.into()).saturating_add(result))
    }
}

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The function compiled for its dyadic partition, with room for `M` maps: the more, the more digits are
    /// taken at once. With two intervals `M` = 2 takes one binary digit a step, 16 takes four.
    ///
    /// None if the intervals are not `2^b` equal ones, `1 <= b <= 8`, or `M` is less than `2^b`.
    pub fn dyadic<const M: usize>(&self) -> Option<Dyadic<M, D>> {
        let count = self.maps.len();
        if !count.is_power_of_two() || !(2..=256).contains(&count) || M < count {
            return None;
        }
        let digit = count.trailing_zeros();
        if self
            .maps
            .iter()
            .zip(0_u64..)
            .any(|(m, j)| m.start != j << (63 - digit) || m.width != ONE_UQ63 >> digit)
        {
            return None;
        }
        // as many digits a step as there is room for: the composites of all addresses of that length are
        // again such a system
        let (mut bits, mut digits) = (digit, 1);
        while bits + digit <= 8 && M >> (bits + digit) > 0 {
            bits += digit;
            digits += 1;
        }
        let composite = |address: usize| {
            self.composite((0..digits).rev().map(|k| (address >> (k * digit)) & (count - 1)))
        };
        // the largest number that a word must hold: a value, or a partial sum of Horner's scheme without the
        // constant
        let mut largest = self.range.0.saturating_abs().max(self.range.1.saturating_abs());
        let value = largest.unsigned_abs();
        for address in 0..1_usize << bits {
            let map = composite(address);
            let powers = map.q.powers.iter().fold(0_i64, |s, c| s.saturating_add(c.saturating_abs()));
            largest = largest.max(powers);
        }
        let fraction = fraction_for(largest.unsigned_abs());
        let mut maps = Vec::new();
        let mut errors = Errors { unit: 1 << (FRACTION_Q55 - fraction), value, step: 0, steepest: 0 };
        for address in 0..1_usize << bits {
            let map = composite(address);
            // wraps for large constants, as the sums do; the final sum is a value and fits
            let constant = if fraction >= 24 {
                map.q.constant.wrapping_shl(fraction - 24)
            } else {
                map.q.constant >> (24 - fraction)
            };
            let words = Words {
                constant: constant.wrapping_add(1 << 30),
                scaling: round_shift(map.scaling, 32).min(i64::from(i32::MAX)) as i32,
                powers: map.q.powers.map(|c| word(c, fraction)),
            };
            errors.add(&map, &words);
            // 2^bits <= M: never full
            let _ = maps.push(words);
        }
        let error = errors.bound(D as u64 + 1, digits as u64);
        Some(Dyadic {
            maps,
            bits,
            per_bits: per_bits(bits),
            fraction,
            first: word(self.first, fraction),
            error,
        })
    }
}

impl<const M: usize, const D: usize> Dyadic<M, D> {
    /// The value at the place `u` of the domain, a fraction in `[0, 1)`.
    ///
    /// Error: at most [`Dyadic::error_bound`] (`an_error_bound_is_less_than_four_times_the_worst_error`).
    /// Cost: 7.1 Cortex-M4 instructions (kernel `fif dyadic level`) a level for degree 1; as many levels as
    /// `u` has digits before its trailing zeros.
    #[inline]
    pub fn at(&self, u: Angle) -> Real {
        real(self.word(u.to_bits()), self.fraction)
    }

    /// A bound on the error of [`Dyadic::at`] for the maps of the function as it was compiled, scalings of 31
    /// bits among them, rounded up: over `1 - max|alpha|` half a unit of a word, one for each power above the
    /// first, and what coefficients and scalings lose as words; beside it half a unit of the result. Hard
    /// cases reach half of it and more.
    pub fn error_bound(&self) -> Real {
        self.error
    }

    // with 13 registers a call costs less than a loop whose numbers lie in memory, as the caller has its own
    #[cfg_attr(not(any(no_long_product, no_carry)), inline(never))]
    #[cfg_attr(any(no_long_product, no_carry), inline)]
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

/// `2^9 / bits`, rounded up.
fn per_bits(bits: u32) -> u32 {
    512_u32.div_ceil(bits.max(1))
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

    /// Digits that are taken one, two, three, four at a time make one function, addresses whose length is no
    /// multiple of them too.
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

    fn next(state: &mut u64) -> i64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 1) as i64 ^ (*state >> 33) as i64
    }

    /// The value of the function of these maps with 80 fractional bits, from the last digit to the first: the
    /// abscissa is exact, a value loses less than `D + 1` of its units a step.
    fn exact<const D: usize>(f: &Fif<2, D>, u: u32) -> i128 {
        let mut y = i128::from(f.first) << 25;
        let mut t = 0_i128; // 32 fractional bits
        for k in 0..32 {
            let digit = u >> k & 1;
            let map = &f.maps[digit as usize];
            let powers = map.q.powers.iter().rev();
            let q = powers.fold(0, |sum, c| ((sum + (i128::from(*c) << 25)) * t) >> 32);
            y = q + (i128::from(map.q.constant) << 25) + ((y * i128::from(map.scaling >> 32)) >> 31);
            t = (t + (i128::from(digit) << 32)) >> 1;
        }
        y
    }

    /// The largest error over the bound, for functions of the degree whose values are below `2^height`,
    /// taking as many digits a step as there is room for `M` maps. `gap` is `1 - max|alpha|` in sixteenths.
    fn nearest<const M: usize, const D: usize>(height: u32, gap: i64) -> f64 {
        let mut state = u64::from(height) << 32 | gap as u64;
        let mut nearest = 0.0_f64;
        for _ in 0..60 {
            let state = &mut state;
            let scalings = [(); 2].map(|()| {
                let spare = next(state) >> 40;
                let size = ((16 - gap) << 27) - spare;
                Scaling::from_bits(if next(state) & 1 == 0 { size } else { -size } as i32)
            });
            let knots = [0, 1, 2].map(Wide::from_num);
            // the coefficients of x^2 ... are the maps' own; what joins them follows
            let mut q = [[0_i64; 5]; 2];
            for c in &mut q {
                c.iter_mut().take(D + 1).for_each(|c| *c = next(state) >> (18 - height + D as u32));
            }
            let join = |q: &mut [[i64; 5]; 2]| {
                // f(2) = q_2(2) / (1 - alpha_2), f(0) = q_1(0) / (1 - alpha_1); q_1(2) + alpha_1 f(2) =
                // q_2(0) + alpha_2 f(0)
                let at = |c: &[i64; 5], x: f64| c.iter().rev().fold(0.0, |sum, c| sum * x + *c as f64);
                let [a, b] = scalings.map(|s| s.to_num::<f64>());
                let (last, first) = (at(&q[1], 2.0) / (1.0 - b), at(&q[0], 0.0) / (1.0 - a));
                let jump = at(&q[0], 2.0) + a * last - q[1][0] as f64 - b * first;
                q[0][1] -= (jump / 2.0) as i64;
            };
            join(&mut q);
            let q = q.map(|c| c.map(Wide::from_bits));
            let polynomials = [&q[0][..=D], &q[1][..=D]];
            let Ok(f) = Fif::<2, D>::from_polynomials(&knots, &scalings, &polynomials) else { continue };
            let fast = f.dyadic::<M>().unwrap();
            let bound = i128::from(fast.error_bound().to_bits()) << 56;
            for k in 0..200 {
                let u = match k {
                    0 => u32::MAX,
                    1 => 0x5555_5555,
                    2 => 0xaaaa_aaaa,
                    3 => 0x7fff_ffff,
                    _ => next(state) as u32,
                };
                let off = (exact(&f, u) - (i128::from(fast.at(Angle::from_bits(u)).to_bits()) << 56)).abs();
                assert!(off <= bound, "{f:?} at {u:#x}: {off} of {bound}");
                nearest = nearest.max(off as f64 / bound as f64);
            }
        }
        nearest
    }

    /// Against integers with 80 fractional bits: none beyond the bound, and for each height and slope one
    /// above two fifths of it.
    #[test]
    fn an_error_bound_is_less_than_four_times_the_worst_error() {
        for height in [0, 2, 4, 6] {
            for gap in [8, 4, 2] {
                let got = [
                    nearest::<2, 1>(height, gap),
                    nearest::<16, 1>(height, gap),
                    nearest::<2, 2>(height, gap),
                    nearest::<16, 2>(height, gap),
                    nearest::<2, 4>(height, gap),
                ];
                assert!(got.iter().all(|got| *got > 0.4), "2^{height}, {gap} sixteenths: {got:?}");
            }
        }
    }

    /// Digits of an address that no step takes evenly: 32 bits, three or five or seven a step, the last one
    /// set.
    #[test]
    fn an_address_of_32_digits_is_filled_up() {
        let knots = [(0, 1), (1, 3), (2, -2)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let f = Fif::<2, 1>::interpolating(&knots, &[0.75, -0.5].map(Scaling::from_num)).unwrap();
        let (three, five, seven) =
            (f.dyadic::<8>().unwrap(), f.dyadic::<32>().unwrap(), f.dyadic::<128>().unwrap());
        assert_eq!([three.bits, five.bits, seven.bits], [3, 5, 7]);
        let mut state = 5;
        for _ in 0..500 {
            for last in [1, 2, 3, 4, 8] {
                let u = (next(&mut state) as u32) << 4 | last;
                let exact = exact(&f, u);
                for (got, bound) in [
                    (three.at(Angle::from_bits(u)), three.error_bound()),
                    (five.at(Angle::from_bits(u)), five.error_bound()),
                    (seven.at(Angle::from_bits(u)), seven.error_bound()),
                ] {
                    let off = exact - (i128::from(got.to_bits()) << 56);
                    assert!(off.abs() <= i128::from(bound.to_bits()) << 56, "{u:#x}: {off}");
                }
            }
        }
    }

    #[test]
    fn two_to_256_intervals_are_compiled_and_eight_digits_a_step() {
        let knots: std::vec::Vec<Knot> =
            (0..=256).map(|x| Knot::new(Wide::from_num(x), Wide::from_num(x % 3))).collect();
        let f = Fif::<256, 1>::interpolating(&knots, &[Scaling::ZERO; 256]).unwrap();
        let fast = f.dyadic::<256>().unwrap();
        for (j, knot) in knots.iter().take(256).enumerate() {
            assert_eq!(fast.at(Angle::from_bits((j as u32) << 24)), Real::from_num(knot.y), "{j}");
        }
        let whole = Fif::<256, 1>::interpolating(&[knots[0], knots[1]], &[Scaling::ZERO]).unwrap();
        assert!(whole.dyadic::<2>().is_none());
        let halves = Fif::<2, 1>::interpolating(&knots[..3], &[Scaling::ZERO; 2]).unwrap();
        assert_eq!(halves.dyadic::<256>().map(|fast| fast.bits), Some(8));
        assert_eq!(halves.dyadic::<512>().map(|fast| fast.bits), Some(8));
        assert_eq!(halves.dyadic::<511>().map(|fast| fast.bits), Some(8));
    }

    /// Against its formula in integers with 55 fractional bits: never below, and above by less than a unit of
    /// the result.
    #[test]
    fn an_error_bound_is_that_of_its_formula() {
        let mut state = 11;
        let (mut turned, mut results) = (0, [0; 2]);
        for k in 0..600 {
            let high = [4, 100][k % 2];
            let knots = [0, 1, 2].map(|x| {
                Knot::new(Wide::from_num(x), Wide::from_bits((next(&mut state) >> 6) % (high << 48)))
            });
            let scalings = [(); 2].map(|()| Scaling::from_bits((next(&mut state) >> 33) as i32));
            let Ok(f) = Fif::<2, 1>::interpolating(&knots, &scalings) else { continue };
            let Some(fast) = f.dyadic::<16>() else { continue };
            let unit = 1_i128 << (55 - fast.fraction);
            let value = i128::from(f.range.0.unsigned_abs().max(f.range.1.unsigned_abs()));
            let (mut step, mut steepest, mut share) = (0, 0, 0);
            for address in 0..16_usize {
                let map = f.composite((0..4).rev().map(|k| address >> k & 1));
                let beside = |v: i64, unit: i128| (i128::from(v) + unit / 2).rem_euclid(unit) - unit / 2;
                let scaling = (value * beside(map.scaling, 1 << 32).abs()) >> 63;
                share = share.max(scaling);
                step = step.max(beside(map.q.powers[0], unit).abs() + scaling);
                steepest = steepest.max(((i128::from(map.scaling) + (1 << 31)) >> 32).abs());
            }
            let result = if fast.fraction > 24 { 1 << 30 } else { 0 };
            let exact = ((step + unit / 2) << 31) / ((1 << 31) - steepest) + result;
            let got = i128::from(fast.error_bound().to_bits()) << 31;
            // four compositions
            assert!(got >= exact && got < exact + (1 << 31) + (1 << 12), "{f:?}: {got} against {exact}");
            turned += u32::from(got - exact + ((share << 31) / ((1 << 31) - steepest)) > 1 << 31);
            results[usize::from(result > 0)] += 1;
        }
        assert!(turned > 5 && results.iter().all(|n| *n > 50), "{turned} {results:?}");
    }
}
