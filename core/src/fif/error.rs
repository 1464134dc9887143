//! How far a value can be from the exact one.
//!
//! Two things differ. The arithmetic: scalings have 31 bits, coefficients and products 55, the result 24. And
//! the abscissa: places and knots of the unit interval have 63 bits and a pre-image is low by up to `2^-60`,
//! so that elsewhere than on a dyadic partition the value is that of a point near `x`. Traced back along the
//! address it lies within `2^-60 (1 + a + a a' + ...)` of `x`, `a, a', ...` the widths of the maps; there a
//! rough function may differ much. A walk that ends in a cell less than `2^-63` wide takes the value from the
//! chord of the cell; the graph crosses the chord in the cell, so that it is exact there as well.
//!
//! How much follows from the maps. Over a cell of width `W` values differ by at most `C W^h` for any `h` in
//! `(0, 1]` with `a_j^h > |alpha_j|` and `C` no less than `max f - min f` and
//! `max|q_j'| / (a_j^h - |alpha_j|)`: by induction, `|alpha_j| C W^h + max|q_j'| W <= C (a_j W)^h`. Points
//! `d` apart lie in one or two neighbouring cells less than `d / min a_j` wide, hence
//! `|f(u) - f(v)| <= 2 C (d / min a_j)^h`.
//!
//! Source: M. F. Barnsley, "Fractal functions and interpolation", 1986, on Hölder exponents.

use super::bounds::LEVELS;
use super::function::Fif;
use super::value::{FRACTION_Q55, ONE_UQ63};
use crate::num::{Real, exp_minus, log2, mul_high_u, ratio};

/// One halving, as logarithms are written.
const HALVING: u32 = 1 << 24;
/// An exponential is known at least so well, 30 fractional bits.
const EXPONENTIAL: u32 = 9;

impl<const N: usize, const D: usize> Fif<N, D> {
    /// A bound on the error of [`Fif::at`] at the abscissa that it has evaluated:
    /// `2^-32 max|f| / (1 - max|alpha|)` for scalings rounded to 31 bits, and `2^-25` for the result's
    /// rounding, with all smaller terms and what a walk of 32,768 maps leaves out, rounded up.
    ///
    /// That abscissa is `x` on a dyadic partition of a domain as wide as a power of two, elsewhere one within
    /// `2^-40` of the domain from `x`: for the value at `x` there is [`Fif::error_bound_at_x`].
    pub fn error_bound(&self) -> Real {
        let steepest = self.steepest();
        let rest = ((ONE_UQ63 - steepest) >> 32).max(1);
        let largest = self.range.0.unsigned_abs().max(self.range.1.unsigned_abs());
        // with 55 fractional bits: scalings 2^-32 max|f|, products and coefficients 2^-47, places the slope
        // times their shift, for each level
        let per_level = (largest >> 32) + (1 << (FRACTION_Q55 - 47)) + (self.slope() >> self.shift());
        let sum = ratio(per_level, 31, rest).saturating_add(self.left_out(steepest));
        up(sum.saturating_add(1 << (FRACTION_Q55 - 25)).saturating_add(1 << (FRACTION_Q55 - 30)))
    }

    /// A bound on the error of [`Fif::at`] against the value at `x` itself, whatever the partition:
    /// [`Fif::error_bound`] and, where the abscissa is not exact, [`Fif::oscillation`] over the distance by
    /// which it may be off.
    pub fn error_bound_at_x(&self) -> Real {
        let exact = self.width.is_power_of_two() && self.maps.iter().all(|m| m.width.is_power_of_two());
        let moved = if exact { Real::ZERO } else { self.oscillation(self.shift()) };
        self.error_bound().saturating_add(moved)
    }

    /// A bound on how far the values at two abscissae differ that are at most `2^-halvings` of the domain
    /// apart, rounded up: of Hölder's type, or the range of the function where that is less.
    ///
    /// Cost: 64 exponentials a map.
    pub fn oscillation(&self, halvings: u32) -> Real {
        let whole = self.spread();
        let slope = self.slope();
        let narrowest = self.maps.iter().map(|m| m.width).min().unwrap_or(ONE_UQ63);
        let finer = (halvings.min(63) * HALVING).saturating_sub(halvings_to(narrowest));
        let bound = |k: u32| {
            // the least a_j^h - |alpha_j|, 30 fractional bits
            let gap = self.maps.iter().map(|m| {
                let power = power(halvings_to(m.width), k).0;
                power.saturating_sub((m.scaling.unsigned_abs() >> 33) as u32 + 1)
            });
            let gap = gap.min().filter(|gap| *gap > 0)?;
            let constant = whole.max(ratio(slope, 30, gap.into()).saturating_add(1));
            let factor = power(finer, k).1;
            // 2 C (d / min a_j)^h
            Some((mul_high_u(constant, u64::from(factor) << 33) + 1).saturating_mul(4))
        };
        up((1..=64).filter_map(bound).fold(whole, u64::min))
    }

    /// The largest magnitude of the scalings, 63 fractional bits.
    pub(super) fn steepest(&self) -> u64 {
        self.maps.iter().map(|m| m.scaling.unsigned_abs()).max().unwrap_or(0)
    }

    /// `max f - min f`, 55 fractional bits.
    pub(super) fn spread(&self) -> u64 {
        self.range.1.abs_diff(self.range.0)
    }

    /// The largest magnitude of a polynomial's slope, 55 fractional bits, rounded up.
    pub(super) fn slope(&self) -> u64 {
        let slope = |q: &super::polynomial::Polynomial<D>| q.derivative().norm().unsigned_abs();
        self.maps.iter().map(|m| slope(&m.q)).max().unwrap_or(0).saturating_add(1 << (FRACTION_Q55 - 47))
    }

    /// The abscissa that is evaluated lies within `2^-shift` of the domain from `x`.
    fn shift(&self) -> u32 {
        // 1 + a + a a' + ...: the widest map again and again, or as many as there are
        let widest = self.maps.iter().map(|m| m.width).max().unwrap_or(0);
        let sum = ratio(1, 63, ONE_UQ63.saturating_sub(widest)).min(self.levels.into()).max(3) + 1;
        60_u32.saturating_sub(64 - (sum - 1).leading_zeros())
    }

    /// What is left of the function after the longest walk: `max|alpha|^levels (max f - min f)`, 55
    /// fractional bits.
    fn left_out(&self, steepest: u64) -> u64 {
        if self.levels < LEVELS {
            return 0;
        }
        let square = |power: u64, _| mul_high_u(power << 1, power) + 1;
        let power = (0..LEVELS.trailing_zeros()).fold(steepest, square);
        mul_high_u(self.spread(), power << 1) + 1
    }
}

/// At most so many halvings lead from 1 to a width with 63 fractional bits, 24 fractional bits.
fn halvings_to(width: u64) -> u32 {
    // a width is off by less than a unit, and none is below half of one; a logarithm by less than one of its
    // own
    if width < 2 { 64 * HALVING } else { 63 * HALVING + 1 - log2(width - 1) }
}

/// `2^(-halvings k / 64)` from below and from above, 30 fractional bits.
fn power(halvings: u32, k: u32) -> (u32, u32) {
    // ln 2 with 32 fractional bits, rounded down
    const LN_2: u64 = 0xb172_17f7;
    let product = u64::from(halvings) * u64::from(k);
    let exponential = |halvings: u64, up: u64| {
        let part =
            ((halvings % u64::from(HALVING)) * (LN_2 + up)).wrapping_add(up * u64::from(u32::MAX)) >> 32;
        (exp_minus(Real::from_bits(part as i32)).to_bits().unsigned_abs(), (halvings >> 24) as u32)
    };
    let (low, shift) = exponential(product.div_ceil(64), 1);
    let below = low.saturating_sub(EXPONENTIAL).checked_shr(shift).unwrap_or(0);
    let (high, shift) = exponential(product / 64, 0);
    let above = (high + EXPONENTIAL).checked_shr(shift).unwrap_or(0) + 1;
    (below, above)
}

/// A number with 55 fractional bits, rounded up.
pub(super) fn up(value: u64) -> Real {
    Real::from_bits(value.div_ceil(1 << (FRACTION_Q55 - 24)).min(i32::MAX as u64) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fif::Knot;
    use crate::num::{Scaling, Wide};

    fn tent(height: i32, scaling: Scaling) -> Fif<2, 1> {
        let knots =
            [(0, 0), (1, height), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        Fif::interpolating(&knots, &[scaling; 2]).unwrap()
    }

    /// Near a third of the tent all terms are `2/3` of the height: a scaling that is half a unit off moves
    /// the value as far as it can.
    #[test]
    fn an_error_bound_is_less_than_four_times_the_worst_error() {
        let scaling = Scaling::from_num(0.95);
        // what the file may have said: half a unit more
        let exact = scaling.to_num::<f64>() + 2_f64.powi(-32);
        let f = tent(6, scaling);
        let levels = 48;
        let x = Wide::from_bits(((1_i64 << 49) / 3) & !1); // 48 digits 01 01 ...
        let mut worst = 0.0_f64;
        for digits in [x, x + Wide::DELTA * 2, x - Wide::DELTA * 4] {
            let (mut u, mut sum, mut product) = (digits.to_bits() as u64, 0.0, 1.0);
            for _ in 0..=levels {
                // u with 49 bits: the maps of the tent fold it over
                let t = if u >= 1 << 48 { (1_u64 << 49) - u } else { u };
                sum += product * 6.0 * t as f64 / 2_f64.powi(48);
                product *= exact;
                u = (u << 1) & ((1 << 49) - 1);
            }
            worst = worst.max((f.at(digits).to_num::<f64>() - sum).abs());
        }
        let bound = f.error_bound().to_num::<f64>();
        assert!(worst <= bound && bound < 4.0 * worst, "{worst:e} against {bound:e}");
        // without the scalings' share it would be two units
        assert!(worst > 4.0 * 2_f64.powi(-24), "{worst:e}");
    }

    #[test]
    fn powers_are_bounded_from_both_sides() {
        for halvings in
            [0, 1, 12_345, HALVING / 3, HALVING, 2 * HALVING + 7, 11 * HALVING, 29 * HALVING + 999]
        {
            for k in [1, 17, 32, 63, 64] {
                let exact =
                    (-f64::from(halvings) * f64::from(k) / f64::from(64 * HALVING)).exp2() * 2_f64.powi(30);
                let (below, above) = power(halvings, k);
                assert!(f64::from(below) <= exact && exact <= f64::from(above), "{halvings} {k}");
                assert!(above - below < 160, "{halvings} {k}: {below} {above}");
            }
        }
    }

    #[test]
    fn halvings_to_a_width_are_not_too_few() {
        for width in [2, 3, 1000, ONE_UQ63 / 3, ONE_UQ63 / 2, ONE_UQ63 - 1, ONE_UQ63] {
            let exact = -((width - 1) as f64 / ONE_UQ63 as f64).log2();
            let got = f64::from(halvings_to(width)) / f64::from(HALVING);
            assert!((exact - 1e-9..exact + 2_f64.powi(-22)).contains(&got), "{width}: {got} against {exact}");
        }
        assert_eq!(halvings_to(1), 64 * HALVING);
    }

    /// The tent over halves: over a distance of `2^-k` its values differ by what is left after `k` maps at
    /// least.
    #[test]
    fn an_oscillation_is_that_of_hoelders_exponent() {
        for (scaling, looseness) in [(0.5_f64, 16.0), (0.75, 8.0), (0.9375, 8.0)] {
            let f = tent(1, Scaling::from_num(scaling));
            let highest = 2.0 / 3.0 / (1.0 - scaling);
            for k in [1, 4, 10, 20, 40] {
                // from 0 up to the highest place of the first cell of level k: alpha^k of the function, and
                // the straight part
                let at_least = highest * scaling.powi(k);
                let got = f.oscillation(k as u32).to_num::<f64>();
                assert!(got >= at_least.min(highest), "{scaling} {k}: {got} below {at_least}");
                let most = looseness * f64::from(k) * at_least + 2_f64.powi(-20);
                assert!(got <= most.max(highest + 0.001), "{scaling} {k}: {got} above {most}");
            }
            assert!(f.oscillation(0).to_num::<f64>() >= highest);
        }
    }

    #[test]
    fn an_exact_abscissa_needs_no_oscillation() {
        let dyadic = tent(1, Scaling::from_num(0.9));
        assert_eq!(dyadic.error_bound_at_x(), dyadic.error_bound());
        // thirds of the same, and the same over a domain that is three wide
        let knots =
            [(0, 0), (1, 1), (2, 1), (3, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let thirds = Fif::<3, 1>::interpolating(&knots, &[Scaling::from_num(0.9); 3]).unwrap();
        assert!(thirds.error_bound_at_x() > thirds.error_bound() * 1000);
        let wide = [(0, 0), (3, 2), (6, 0)].map(|(x, y)| Knot::new(Wide::from_num(x) / 2, Wide::from_num(y)));
        let wide = Fif::<2, 1>::interpolating(&wide, &[Scaling::from_num(0.9); 2]).unwrap();
        assert!(wide.error_bound_at_x() > wide.error_bound() * 1000);
    }

    #[test]
    fn a_walk_that_is_cut_short_says_so() {
        let knots = [0, 1, 1 << 40].map(|x| Knot::new(Wide::from_bits(x), Wide::from_bits(x >> 1)));
        let function = |last: Scaling| Fif::<2, 1>::interpolating(&knots, &[Scaling::ZERO, last]).unwrap();
        let cut = function(Scaling::from_num(0.9999));
        assert_eq!(cut.levels, LEVELS);
        let spread = cut.range().1.to_num::<f64>() - cut.range().0.to_num::<f64>();
        let left = 0.9999_f64.powi(1 << 15) * spread;
        let bound = cut.error_bound().to_num::<f64>();
        assert!(left <= bound && bound < left * 1.5 + 2_f64.powi(-18), "{bound} against {left}");
        let whole = function(Scaling::from_num(0.999));
        assert!(whole.levels < LEVELS && whole.error_bound() < Real::DELTA * 16, "{}", whole.error_bound());
    }

    /// Against the formula of [`Fif::oscillation`] in floating point: not below, and hardly above.
    #[test]
    fn an_oscillation_is_that_of_its_formula() {
        let knots =
            [(0, 0), (1, 3), (3, -1), (4, 1)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        for alphas in [[0.3, -0.2, 0.25], [0.6, 0.1, -0.7], [0.95, 0.9, 0.99], [0.1, 0.0, 0.05]] {
            let f = Fif::<3, 1>::interpolating(&knots, &alphas.map(Scaling::from_num)).unwrap();
            let real = |bits: u64| bits as f64 / 2_f64.powi(55);
            let width = |m: &crate::fif::map::Map<1>| m.width as f64 / 2_f64.powi(63);
            let scaling = |m: &crate::fif::map::Map<1>| m.scaling.unsigned_abs() as f64 / 2_f64.powi(63);
            let narrowest = f.maps.iter().map(width).fold(1.0, f64::min);
            for halvings in [2, 7, 15, 24] {
                let formula = |k: i32| {
                    let h = f64::from(k) / 64.0;
                    let gap = f.maps.iter().map(|m| width(m).powf(h) - scaling(m)).fold(1.0, f64::min);
                    let constant = real(f.spread()).max(real(f.slope()) / gap);
                    let reach = 2.0 * constant * (2_f64.powi(-halvings) / narrowest).powf(h);
                    if gap > 0.0 { reach } else { f64::MAX }
                };
                let exact = (1..=64).map(formula).fold(real(f.spread()), f64::min);
                // beyond the format it saturates
                let exact = exact.min(Real::MAX.to_num());
                let got = f.oscillation(halvings as u32).to_num::<f64>();
                let allowed = exact * (1.0 + 2_f64.powi(-12)) + 2_f64.powi(-20);
                assert!(exact <= got && got <= allowed, "{alphas:?} {halvings}: {got} against {exact}");
            }
        }
    }

    /// Against its formula in integers with 95 fractional bits: never below, and above by less than a unit of
    /// the result.
    #[test]
    fn an_error_bound_is_that_of_its_formula() {
        let mut state = 3_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            state >> 16
        };
        let mut decided = [0_u32; 3];
        for _ in 0..3000 {
            // a map that hardly contracts adds up what is small; only so low a function keeps a range then
            let steepest = (1 << 31) - (1 << 12) - ((next() >> 34) << (next() % 6));
            let [first, middle, last] = [(); 3].map(|()| Wide::from_bits((next() >> 13) as i64 - (1 << 34)));
            let knots = [(0, first), (1, last), (2, middle), (4, last)];
            let knots = knots.map(|(x, y)| Knot::new(Wide::from_num(x), y));
            let scalings = [Scaling::from_bits(steepest as i32), Scaling::ZERO, Scaling::ZERO];
            let f = Fif::<3, 1>::interpolating(&knots, &scalings).unwrap();
            assert!(f.levels < LEVELS);
            let largest = u128::from(f.range.0.unsigned_abs().max(f.range.1.unsigned_abs()));
            let slope = f.maps.iter().map(|m| u128::from(m.q.powers[0].unsigned_abs())).max().unwrap();
            // a quarter, a quarter, a half: 1 + 1/2 + ... is below 3, so that the abscissa moves by less than
            // 3 2^-60
            let shares = [largest << 8, 1 << 48, slope >> 18]
                .map(|share| ((share << 24) / u128::from((1 << 31) - steepest)) << 7);
            let exact = shares.iter().sum::<u128>() + (1 << 70) + (1 << 65);
            let got = u128::from(f.error_bound().to_bits().unsigned_abs()) << 71;
            // divisions, and the slope's unit of 2^-47
            let lost = 1 << 48;
            assert!(got + lost >= exact && got < exact + (1 << 71) + lost, "{f:?}: {got} against {exact}");
            // how often each of them decides
            for (share, count) in [shares[0], shares[1], 1 << 65].into_iter().zip(&mut decided) {
                *count += u32::from(got >= (1 << 71) + exact - share + lost);
            }
        }
        assert!(decided.iter().all(|count| *count > 5), "{decided:?}");
    }

    /// `2^-60 (1 + a + a^2 + ...)` for the widest part: below 3 counts as 3.
    #[test]
    fn an_abscissa_moves_by_a_geometric_series() {
        let parts = |inner: i64, outer: i64| {
            let knots = [0, inner, outer].map(|x| Knot::new(Wide::from_bits(x), Wide::ZERO));
            Fif::<2, 1>::interpolating(&knots, &[Scaling::from_num(0.999); 2]).unwrap().shift()
        };
        // the sums are 2, 4, 8, 100 and 101
        assert_eq!(
            [parts(1, 2), parts(1, 4), parts(1, 8), parts(1, 100), parts(1, 101)],
            [58, 57, 56, 53, 53]
        );
        // parts of a width that is no power of two, on a domain whose width is one
        let knots = [(0, 0), (1, 2), (4, 1)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let f = Fif::<2, 1>::interpolating(&knots, &[Scaling::from_num(0.9); 2]).unwrap();
        assert_eq!(f.error_bound_at_x(), f.error_bound() + f.oscillation(57));
        assert!(f.error_bound_at_x() > f.error_bound() * 100);
    }
}
