//! Polynomials on the unit interval with 55 fractional bits, and what a fractal interpolation function asks
//! of them.
//!
//! `p(t) = constant + c_1 t + ... + c_D t^D`, `0 <= t <= 1`. The sum of the magnitudes of the coefficients
//! stays below 256, so that no partial sum of Horner's scheme leaves 64 bits, here and on any part of the
//! interval: `|p(h s + t)|_1 <= |p|_1` for `h + t <= 1`.

use super::value::ONE_UQ63;
use crate::num::{mul_high, mul_high_short, mul_high_u, nth, product_u};

/// A polynomial of degree at most `D` on the unit interval, 55 fractional bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Polynomial<const D: usize> {
    pub(crate) constant: i64,
    /// Coefficients of `t`, `t^2`, ...
    pub(crate) powers: [i64; D],
}

/// `value * t` for an abscissa with 63 fractional bits. Error: below 2 units, towards minus infinity; exact
/// for `t` = 1 (`products_are_low_by_less_than_they_say`).
///
/// Out of line: constructors ask for many.
#[inline(never)]
pub(crate) fn product_q55(value: i64, t: u64) -> i64 {
    inline_times(value, t)
}

/// [`times`] for the walk along an address.
#[inline(always)]
fn inline_times(value: i64, t: u64) -> i64 {
    if t >= ONE_UQ63 { value } else { times_before_end(value, t) }
}

/// The same for `t` below 1.
#[inline(always)]
fn times_before_end(value: i64, t: u64) -> i64 {
    mul_high(value, t as i64) << 1
}

/// `2^-63 a b`, for `b` with 63 fractional bits. Error: below 2 units, towards minus infinity
/// (`products_are_low_by_less_than_they_say`).
#[inline(never)]
pub(crate) fn twice_high(a: i64, b: i64) -> i64 {
    mul_high(a, b) << 1
}

/// The same in walks. Scalings that were given have 31 bits: half of the products are spared.
#[inline(always)]
pub(crate) fn by_scaling(a: i64, scaling: i64) -> i64 {
    if scaling as u32 == 0 {
        mul_high_short(a, (scaling >> 32) as i32) << 1
    } else {
        mul_high(a, scaling) << 1
    }
}

/// `a b`, both with 63 fractional bits, for `a` below 1. Error: below a unit, downwards
/// (`products_are_low_by_less_than_they_say`).
#[inline(never)]
pub(crate) fn part_of(a: u64, b: u64) -> u64 {
    mul_high_u(a << 1, b)
}

/// The length of a part of a domain of this width, in the bits of the width; the whole is a part too. Error:
/// below a unit, downwards (`lengths_of_parts_have_all_of_their_bits`).
#[inline(never)]
pub(super) fn length_of(width: u64, part: u64) -> u64 {
    if part == ONE_UQ63 { width } else { part_of(part, width) }
}

/// The same as [`part_of`] in the chaos game. The widths of a dyadic partition have few digits: half of the
/// products are spared.
#[inline(always)]
pub(crate) fn part_by_width(a: u64, width: u64) -> u64 {
    if width as u32 != 0 {
        return mul_high_u(a << 1, width);
    }
    let (twice, width) = (a << 1, (width >> 32) as u32);
    product_u((twice >> 32) as u32, width) + (product_u(twice as u32, width) >> 32)
}

impl<const D: usize> Polynomial<D> {
    pub(crate) const ZERO: Self = Self { constant: 0, powers: [0; D] };

    /// The value at `t`. Error: below `2 D` units (`a_polynomial_keeps_its_bounds`). Cost: `D` products of 64
    /// bits.
    #[inline]
    pub(crate) fn at(&self, t: u64) -> i64 {
        let mut sum = 0_i64;
        for c in self.powers.iter().rev() {
            sum = inline_times(sum.wrapping_add(*c), t);
        }
        sum.wrapping_add(self.constant)
    }

    /// The same for `t` below 1.
    #[inline(always)]
    pub(crate) fn before_end(&self, t: u64) -> i64 {
        let sum = |sum: i64, c: &i64| times_before_end(sum.wrapping_add(*c), t);
        self.powers.iter().rev().fold(0, sum).wrapping_add(self.constant)
    }

    /// The sum of the magnitudes of the coefficients, saturated.
    pub(crate) fn norm(&self) -> i64 {
        norm(self.constant, &self.powers)
    }

    /// The degree, 0 for a constant.
    pub(crate) fn degree(&self) -> usize {
        self.powers.iter().rposition(|c| *c != 0).map_or(0, |i| i + 1)
    }

    /// `p(start + width s)` as a polynomial in `s` (eq. 28), for `start + width <= 1`. Error: below `4 D`
    /// units a coefficient (`a_polynomial_keeps_its_bounds`).
    #[inline(never)]
    pub(crate) fn part(&self, start: u64, width: u64) -> Self {
        let mut part = Self::ZERO;
        // Horner: part <- part * (start + width s) + c
        for c in self.powers.iter().rev().chain([&self.constant]) {
            let mut below = part.constant;
            part.constant = product_q55(part.constant, start).wrapping_add(*c);
            for p in &mut part.powers {
                let next = product_q55(*p, start).wrapping_add(product_q55(below, width));
                below = *p;
                *p = next;
            }
        }
        part
    }

    /// The derivative `p'(t)`.
    pub(crate) fn derivative(&self) -> Self {
        let mut derivative = Self::ZERO;
        for (k, c) in self.powers.iter().enumerate() {
            let scaled = c.saturating_mul(k as i64 + 1);
            match k.checked_sub(1) {
                None => derivative.constant = scaled,
                Some(below) => {
                    if let Some(d) = derivative.powers.get_mut(below) {
                        *d = scaled;
                    }
                }
            }
        }
        derivative
    }

    /// The mean over the unit interval, `sum of c_k / (k + 1)`. Error: below `D` units
    /// (`a_polynomial_keeps_its_bounds`).
    pub(crate) fn mean(&self) -> i64 {
        self.powers.iter().zip(2..).fold(self.constant, |sum, (c, n)| sum.wrapping_add(nth(*c, n)))
    }

    /// Least and greatest value on the unit interval, outward: the hull of the Bernstein coefficients. Exact
    /// for degree 1, else wide by a part of the second differences, which shrink with the square of the
    /// interval; above degree 16 the sum of all magnitudes.
    pub(crate) fn range(&self) -> (i64, i64) {
        match self.powers.as_slice() {
            [] => (self.constant, self.constant),
            [c] => {
                let end = self.constant.wrapping_add(*c);
                (self.constant.min(end), self.constant.max(end))
            }
            _ if D > 16 => (self.norm().saturating_neg(), self.norm()),
            powers => hull(self.constant, powers),
        }
    }
}

/// There once for all degrees.
#[inline(never)]
fn norm(constant: i64, powers: &[i64]) -> i64 {
    powers.iter().fold(constant.saturating_abs(), |sum, c| sum.saturating_add(c.saturating_abs()))
}

/// The hull of the Bernstein coefficients `b_i = sum over k <= i of C(i, k) / C(D, k) c_k`.
#[inline(never)]
fn hull(constant: i64, powers: &[i64]) -> (i64, i64) {
    const COARSE: u32 = 16; // 39 fractional bits leave room for binomials
    const PAD: i64 = 1 << (COARSE + 4);
    let degree = powers.len() as u32;
    let (mut min, mut max) = (constant, constant);
    for i in 1..=degree {
        let mut b = constant >> COARSE;
        let (mut over, mut under) = (1, 1);
        for (c, k) in powers.iter().zip(1..=i) {
            // C(i, k) from C(i, k - 1): at most C(16, 8), so that the product stays below 2^61
            over = over * (i + 1 - k) / k;
            under = under * (degree + 1 - k) / k;
            b += nth((c >> COARSE) * i64::from(over), under);
        }
        min = min.min((b << COARSE).saturating_sub(PAD));
        max = max.max((b << COARSE).saturating_add(PAD));
    }
    (min, max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polynomial<const D: usize>(constant: f64, powers: [f64; D]) -> Polynomial<D> {
        let fixed = |v: f64| (v * 2_f64.powi(55)) as i64;
        Polynomial { constant: fixed(constant), powers: powers.map(fixed) }
    }

    fn float(v: i64) -> f64 {
        v as f64 / 2_f64.powi(55)
    }

    #[test]
    fn a_part_is_the_polynomial_on_its_interval_and_inside_its_range() {
        let p = polynomial(1.5, [-7.25, 3.0, 11.0, -8.5]);
        for (start, width) in [(0.0, 1.0), (0.25, 0.5), (0.9, 0.01), (0.5, 0.5)] {
            let part = p.part((start * ONE_UQ63 as f64) as u64, (width * ONE_UQ63 as f64) as u64);
            let (min, max) = part.range();
            let mut sampled = (f64::MAX, f64::MIN);
            for i in 0..=100 {
                let s = f64::from(i) / 100.0;
                let t: f64 = start + width * s;
                let exact = 1.5 - 7.25 * t + 3.0 * t * t + 11.0 * t.powi(3) - 8.5 * t.powi(4);
                assert!((float(part.at((s * ONE_UQ63 as f64) as u64)) - exact).abs() < 1e-13);
                assert!(float(min) <= exact && exact <= float(max));
                sampled = (sampled.0.min(exact), sampled.1.max(exact));
            }
            assert!(float(max) - float(min) < (sampled.1 - sampled.0) * 1.6, "the range is loose");
        }
    }

    /// Words of which a few are at the ends of what is allowed, by an LCG (Knuth, TAOCP vol. 2, 3.3.4, table
    /// 1, line 26).
    fn words() -> impl Iterator<Item = i64> {
        let mut state = 7_u64;
        core::iter::repeat_with(move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state ^ state >> 29) as i64
        })
    }

    #[test]
    fn products_are_low_by_less_than_they_say() {
        let mut words = words();
        let mut next = || words.next().unwrap();
        let mut worst = [0.0_f64; 3];
        for _ in 0..20_000 {
            let (a, b, t) = (next(), next() >> 1, next() as u64 >> 1);
            // what is missing, in units of 2^-63
            let exact = i128::from(a) * i128::from(t);
            let missing = exact - (i128::from(product_q55(a, t)) << 63);
            worst[0] = worst[0].max(missing as f64 / 2_f64.powi(63));
            assert!(missing >= 0);
            let missing = i128::from(a) * i128::from(b) - (i128::from(twice_high(a, b)) << 63);
            worst[1] = worst[1].max(missing as f64 / 2_f64.powi(63));
            assert!(missing >= 0);
            let part = (a as u64) >> 1;
            let missing = i128::from(part) * i128::from(t) - (i128::from(part_of(part, t)) << 63);
            worst[2] = worst[2].max(missing as f64 / 2_f64.powi(63));
            assert!(missing >= 0);
            assert_eq!((product_q55(a, ONE_UQ63), part_of(part, ONE_UQ63)), (a, part));
            // walks take shorter ways for operands of 31 bits
            for b in [b, b >> 32 << 32, -(b >> 40 << 32)] {
                assert_eq!(by_scaling(a, b), twice_high(a, b), "{a} {b}");
            }
            for t in [t, t >> 32 << 32] {
                assert_eq!(part_by_width(part, t), part_of(part, t), "{part} {t}");
            }
        }
        assert!((1.9..2.0).contains(&worst[0]) && (1.9..2.0).contains(&worst[1]), "{worst:?}");
        assert!((0.9..1.0).contains(&worst[2]), "{worst:?}");
    }

    /// Against exact integers: places with 14 binary digits, so that everything fits 128 bits.
    #[test]
    fn a_polynomial_keeps_its_bounds() {
        const D: usize = 4;
        const DIGITS: u32 = 14;
        let mut words = words();
        let mut next = || words.next().unwrap();
        let mut worst = [0.0_f64; 3];
        for _ in 0..4000 {
            // magnitudes that add up to less than 256
            let p = Polynomial { constant: next() >> 3, powers: [(); D].map(|()| next() >> 4) };
            let coefficients =
                [p.constant, p.powers[0], p.powers[1], p.powers[2], p.powers[3]].map(i128::from);
            let place = next() as u64 >> (64 - DIGITS);
            let width = (next() as u64 >> (64 - DIGITS)).min((1 << DIGITS) - place);
            let abscissa = |v: u64| v << (63 - DIGITS);
            // c_k place^k, with 4 times 14 digits more
            let power = |v: u64, k: usize| i128::from(v).pow(k as u32) << (DIGITS as usize * (D - k));
            let unit = (1_i128 << (DIGITS as usize * D)) as f64;
            let exact: i128 = coefficients.iter().enumerate().map(|(k, c)| c * power(place, k)).sum();
            let off = exact - (i128::from(p.at(abscissa(place))) << (DIGITS as usize * D));
            worst[0] = worst[0].max((off as f64 / unit).abs());
            let part = p.part(abscissa(place), abscissa(width));
            let binomials =
                [[1, 1, 1, 1, 1], [0, 1, 2, 3, 4], [0, 0, 1, 3, 6], [0, 0, 0, 1, 4], [0, 0, 0, 0, 1]];
            for (k, row) in binomials.iter().enumerate() {
                let got = if k == 0 { part.constant } else { part.powers[k - 1] };
                let exact: i128 = (k..=D)
                    .map(|j| {
                        let ends = i128::from(place).pow((j - k) as u32) * i128::from(width).pow(k as u32);
                        coefficients[j] * row[j] * (ends << (DIGITS as usize * (D - j)))
                    })
                    .sum();
                let off = exact - (i128::from(got) << (DIGITS as usize * D));
                worst[1] = worst[1].max((off as f64 / unit).abs());
            }
            // 60 is a multiple of 1 to 5
            let exact: i128 = coefficients.iter().zip(1..).map(|(c, n)| c * (60 / n)).sum();
            worst[2] = worst[2].max(((exact - 60 * i128::from(p.mean())) as f64 / 60.0).abs());
        }
        let bounds = [2.0, 4.0, 1.0].map(|units| units * D as f64);
        for (worst, bound) in worst.iter().zip(bounds) {
            assert!(*worst < bound && *worst > bound / 4.0, "{worst} of {bound}");
        }
    }

    #[test]
    fn the_mean_of_the_derivative_is_the_difference_of_the_ends() {
        let p = polynomial(0.5, [1.0, -2.0, 4.0]);
        assert!((p.derivative().mean() - (p.at(ONE_UQ63) - p.at(0))).abs() < 8);
    }

    /// Against exact values at eighths: none outside, and the ends of Bernstein's coefficients within the
    /// pad.
    #[test]
    fn a_range_holds_every_value() {
        for i in 1..3000_i64 {
            let bits = |n: i64| i.wrapping_mul(n) >> (12 + i % 44);
            let p = Polynomial::<3> {
                constant: bits(0x2545_f491_4f6c_dd1d),
                powers: [
                    bits(0x1f12_3bb5_159a_55e5),
                    bits(0x6c07_8965_0000_8967),
                    bits(0x4f6c_dd1d_2545_f491),
                ],
            };
            let [a, b, c] = p.powers.map(i128::from);
            let constant = i128::from(p.constant);
            let (low, high) = p.range();
            let (low, high) = (i128::from(low), i128::from(high));
            for t in 0..=8 {
                // times 8^3
                let value = 512 * constant + 64 * t * a + 8 * t * t * b + t * t * t * c;
                assert!(512 * low <= value && value <= 512 * high, "{p:?} at {t}/8");
            }
            let control =
                [3 * constant, 3 * constant + a, 3 * constant + 2 * a + b, 3 * (constant + a + b + c)];
            let (least, most) = (control.iter().min().unwrap(), control.iter().max().unwrap());
            let slack = 3 * (1 << 22);
            assert!(least - 3 * low < slack && 3 * high - most < slack, "{p:?}: {low} {high}");
        }
    }

    #[test]
    fn a_degree_a_norm_and_a_derivative_are_the_textbooks() {
        let p = |constant: i64, powers: [i64; 4]| Polynomial { constant, powers };
        assert_eq!([p(5, [0; 4]), p(0, [0, 0, -1, 0]), p(0, [0, 0, 0, 1])].map(|p| p.degree()), [0, 3, 4]);
        assert_eq!(p(-5, [1, -2, 3, -4]).norm(), 15);
        assert_eq!(p(i64::MIN, [i64::MIN, 0, 0, 0]).norm(), i64::MAX);
        assert_eq!(p(9, [1, -2, 3, -4]).derivative(), p(1, [-4, 9, -16, 0]));
        assert_eq!(p(9, [0, i64::MAX, 0, 0]).derivative(), p(0, [i64::MAX, 0, 0, 0]));
        assert_eq!(p(60, [60, -60, 60, -60]).mean(), 60 + 30 - 20 + 15 - 12);
    }

    /// Above degree 16 the sum of all magnitudes; at 16 still the Bernstein coefficients, whose binomials are
    /// the largest.
    #[test]
    fn a_range_of_a_high_degree_holds_the_ends() {
        // 2^46 (1 - t)^n: between 0 and 2^46, its coefficients C(n, k) with alternating signs
        fn power<const D: usize>() -> Polynomial<D> {
            let mut p = Polynomial::<D> { constant: 1 << 46, powers: [0; D] };
            let mut c = 1_i64;
            for (k, to) in p.powers.iter_mut().enumerate() {
                c = -c * (D - k) as i64 / (k as i64 + 1);
                *to = c << 46;
            }
            p
        }
        let (low, high) = power::<16>().range();
        let pad = 1 << 22;
        assert!((-pad..=0).contains(&low) && (1 << 46..=(1 << 46) + pad).contains(&high), "{low} {high}");
        assert_eq!(power::<17>().range(), (-i64::MAX, i64::MAX));
    }
}
