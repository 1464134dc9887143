//! The value at an abscissa, by a forward walk along its address.
//!
//! `f(x) = q_j1(u_1) + alpha_j1 q_j2(u_2) + alpha_j1 alpha_j2 q_j3(u_3) + ...`, `u_k` the `k`-th pre-image of
//! `x`. The walk ends exactly where a pre-image is an end of the domain (after finitely many maps for a
//! dyadic abscissa on a dyadic partition), or when the product of the horizontal factors is below `2^-63`, or
//! when that of the scalings is below `2^-40`, or after [`super::bounds::LEVELS`] maps. How far the value can
//! then be from that at `x`: `error.rs`.
//!
//! At the end the function is replaced by its chord, the straight line between its end points. All terms are
//! straight then over the cell of the address, and the value lies on the chord of that cell: the graph, which
//! is continuous, crosses it, and the value is exact at an abscissa of the cell. Where polynomials are curved
//! it need not be; such a walk goes on until the scalings are below `2^-40`.
//!
//! Source: Cochran, Lewis, Hart, eq. 17.

use super::function::Fif;
use super::map::{first_step, map_at};
use super::polynomial::{by_scaling, product_q55};
use super::value::{FRACTION_Q55, ONE_UQ63, wide};
use crate::num::{Real, Wide, mul_high, ratio, real_from};

/// A product of horizontal factors counts as 0 when 1 has been halved so often (24 fractional bits).
const VANISHED: i32 = 63 << 24;

/// Whether a product of scalings counts as 0: below `2^-40`.
#[inline(always)]
fn is_negligible(scaling: i64) -> bool {
    // the upper word, 0 or -1 for a small one, decides nearly always
    ((scaling >> 32) as i32).wrapping_add(1) as u32 <= 1 && is_least(scaling)
}

#[cold]
#[inline(never)]
fn is_least(scaling: i64) -> bool {
    scaling.unsigned_abs() < 1 << 22
}

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The value at `x`.
    ///
    /// Domain: abscissae outside count as the nearer end. Error: at most [`Fif::error_bound_at_x`]; at most
    /// [`Fif::error_bound`] on a dyadic partition, elsewhere at an abscissa no further than `2^-40` of the
    /// domain from `x` (`values_at_x_keep_their_bound_on_any_partition`,
    /// `values_are_exact_at_an_abscissa_within_two_to_the_minus_40`). Cost: 106 Cortex-M4 instructions
    /// (kernel `fif level`) a level on two equal intervals; at most 63 levels for two equal maps, as many as
    /// it takes until the product of the widths is below `2^-63` or that of the scalings below `2^-40`
    /// elsewhere, and never more than 32,768; [`super::Compiled`] takes fewer, and [`super::Dyadic`] 7.1
    /// (kernel `fif dyadic level`) where the partition is dyadic.
    pub fn at(&self, x: Wide) -> Real {
        real_from(self.evaluate(self.unit(x)), FRACTION_Q55)
    }

    /// The value at `x` with 48 fractional bits, for values that are to be subtracted or multiplied.
    ///
    /// Error: that of [`Fif::at`] less the final rounding to [`Real`] (row `Fif::at_wide (g of figure 1)`).
    pub fn at_wide(&self, x: Wide) -> Wide {
        wide(self.evaluate(self.unit(x)))
    }

    /// The value at a unit abscissa with 63 fractional bits, with 55 fractional bits.
    #[inline(never)]
    pub(crate) fn evaluate(&self, unit: u64) -> i64 {
        let mut u = unit.min(ONE_UQ63);
        let mut sum = 0_i64; // 53 fractional bits
        let mut scaling = 1_i64 << 62; // product of the scalings, 62 fractional bits
        let mut left = VANISHED; // of the product of the horizontal factors, 24 fractional bits
        // only the right end itself is 1: pre-images of what lies before it do too
        let mut levels = if u == ONE_UQ63 { 0 } else { self.levels };
        while u != 0 && levels != 0 && left >= 0 && !is_negligible(scaling) {
            let Some(map) = map_at(&self.maps, const { first_step(N) }, u) else { break };
            u = map.per_width.quotient(u - map.start);
            sum = sum.wrapping_add(mul_high(scaling, map.q.before_end(u)));
            scaling = by_scaling(scaling, map.scaling);
            left -= map.per_width.halvings() as i32;
            levels -= 1;
            if D > 1 && left < 0 && self.is_curved() {
                left = VANISHED;
            }
        }
        let chord = self.first.wrapping_add(product_q55(self.last.wrapping_sub(self.first), u));
        sum.wrapping_add(mul_high(scaling, chord)) << 2
    }

    #[cold]
    #[inline(never)]
    fn is_curved(&self) -> bool {
        self.degree() > 1
    }

    /// The value at the place `numerator / denominator` of the domain, as a point's ordinate.
    pub(crate) fn at_fraction(&self, numerator: u32, denominator: u32) -> (u64, Real) {
        let u = ratio(u64::from(numerator), 63, u64::from(denominator)).min(ONE_UQ63);
        (u, real_from(self.evaluate(u), FRACTION_Q55))
    }
}

#[cfg(test)]
mod tests {
    use super::super::bounds::LEVELS;
    use super::*;
    use crate::fif::Knot;
    use crate::num::Scaling;

    /// Two maps that meet at `inner` of a domain `outer` wide, both in units of the last place.
    fn two(inner: i64, outer: i64, scalings: [Scaling; 2]) -> Option<Fif<2, 1>> {
        let knots = [(0, 0), (inner, 1 << 20), (outer, 0)];
        let knots = knots.map(|(x, y)| Knot::new(Wide::from_bits(x), Wide::from_bits(y)));
        Fif::interpolating(&knots, &scalings).ok()
    }

    #[test]
    fn no_walk_takes_more_than_32768_maps() {
        let ends = [2, 3, 1 << 20, 10 << 48, (32767 << 48) | 1];
        let (mut longest, mut steepest) = (0, 0);
        // scalings 1 - 2^-k, up to the largest that any function may have
        for k in 0..=31 {
            let scaling = Scaling::from_bits(i32::MAX - ((1_u32 << (31 - k)) - 1) as i32);
            for outer in ends {
                for inner in [1, outer / 2, outer - 1] {
                    let Some(f) = two(inner, outer, [scaling, -scaling]) else { continue };
                    (longest, steepest) = (f.levels.max(longest), k);
                    assert!(
                        f.levels >= 28 && f.levels <= LEVELS,
                        "{scaling} {inner} / {outer}: {}",
                        f.levels
                    );
                    let (low, high) = f.range();
                    for x in [inner - 1, inner + 1, outer - 1, outer / 3] {
                        let y = f.at(Wide::from_bits(x));
                        assert!(low <= y && y <= high, "{scaling} {inner} / {outer}: {y} at {x}");
                    }
                }
            }
        }
        assert_eq!((longest, LEVELS), (LEVELS, 32_768));
        assert!(steepest >= 20, "{steepest}");
    }

    /// The ends of walks are where the exact product of the widths is below `2^-63`, a thousandth of the maps
    /// more or less.
    #[test]
    fn a_walk_ends_with_the_product_of_its_widths() {
        let f = two(10 << 48, 10_001 << 40, [Scaling::from_num(0.999), Scaling::from_num(0.5)]).unwrap();
        let mut halvings = 0_u32;
        let mut maps = 0;
        while halvings <= VANISHED as u32 {
            halvings += f.maps[0].per_width.halvings();
            maps += 1;
        }
        let exact = (63.0 / -(f.maps[0].width as f64 / ONE_UQ63 as f64).log2()).ceil();
        assert!((f64::from(maps) - exact).abs() <= exact * 1e-3, "{maps} against {exact}");
    }

    /// Knots so close that 31 bits do not tell them apart: the right map all the same.
    #[test]
    fn a_crowd_of_knots_is_told_apart() {
        let mut knots = std::vec::Vec::new();
        for x in 0..60 {
            knots.push(Knot::new(Wide::from_bits(x), Wide::from_num(x % 7)));
        }
        knots.push(Knot::new(Wide::ONE << 7, Wide::ZERO));
        let f = Fif::<64, 1>::interpolating(&knots, &[Scaling::ZERO; 60]).unwrap();
        for knot in &knots {
            assert_eq!(f.at_wide(knot.x), knot.y, "{}", knot.x);
        }
    }

    /// A function over `[-2^14, 2^14]`, whose abscissae have 63 digits, with halves for scalings: the value
    /// from the last digit to the first with 118 fractional bits, each of them exact.
    #[test]
    fn a_walk_ends_where_its_scalings_are_below_two_to_the_minus_40() {
        let knots =
            [(-1, 0), (0, 32), (1, 24)].map(|(x, y)| Knot::new(Wide::from_num(x << 14), Wide::from_num(y)));
        let f = Fif::<2, 1>::interpolating(&knots, &[Scaling::from_num(0.5); 2]).unwrap();
        let value = |u: u64| {
            let (mut y, mut t) = (0_i128, 0_i128);
            for k in 0..63 {
                let digit = u >> k & 1;
                // q(0) = y_(j-1), q(1) = y_j - 12
                let (left, right) = [(0, 20), (32, 12)][digit as usize];
                y = (left << 118) + (((right - left) * t) << 55) + (y >> 1);
                t = (t + (i128::from(digit) << 63)) >> 1;
            }
            y
        };
        let off = |u: u64| {
            let got = f.at_wide(Wide::from_bits((u as i64).wrapping_sub(1 << 62)));
            (value(u) - (i128::from(got.to_bits()) << 70)).abs()
        };
        let (third, mut worst) = (ONE_UQ63 / 3, 0);
        let mut word = 1_u64;
        for _ in 0..2000 {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let head = word >> 1 & !((1 << 22) - 1);
            // what follows the 41st digit begins another walk: at a third of the domain, and beside its ends
            worst = worst.max(off(head | third >> 41));
            assert!(off(head) < 1 << 74, "{head:#x}");
            for near_an_end in [head | 1, head | ((1 << 22) - 1)] {
                assert!(off(near_an_end) < 1 << 74, "{near_an_end:#x}: {}", off(near_an_end));
            }
        }
        // the chord there is 8
        let left_out = (value(third) - (8 << 118)) >> 41;
        assert!(worst > left_out - (1 << 74) && worst < left_out + (1 << 74), "{worst} {left_out}");
    }

    /// Scalings that hardly vanish: the walk takes all 63 digits. Against integers with 80 fractional bits.
    #[test]
    fn a_walk_takes_every_digit() {
        let knots = [(-1, 1), (0, 5), (1, -3)]
            .map(|(x, y)| Knot::new(Wide::from_num(x << 14), Wide::from_num(y) / 16));
        let scalings = [0.96875, -0.9375].map(Scaling::from_num);
        let f = Fif::<2, 1>::interpolating(&knots, &scalings).unwrap();
        let mut word = 7_u64;
        for k in 0..3000 {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let u =
                [word >> 1, 1 << (k % 63), (1 << 62) - 1, ONE_UQ63 - 1, ONE_UQ63 - (1 << (k % 63))][k % 5];
            let (mut y, mut t) = (1_i128 << 76, 0_i128);
            for i in 0..63 {
                let digit = (u >> i & 1) as usize;
                let alpha = i128::from(scalings[digit].to_bits());
                // q(0) = y_(j-1) - alpha y_0, q(1) = y_j - alpha y_N with 31 fractional bits
                let (left, right) = [(1_i128, 5_i128), (5, -3)][digit];
                let (q0, q1) = ((left << 31) - alpha, (right << 31) + 3 * alpha);
                y = (q0 << 45) + (((q1 - q0) * t) >> 18) + ((y * alpha) >> 31);
                t = (t + ((digit as i128) << 63)) >> 1;
            }
            let got = f.at_wide(Wide::from_bits((u as i64).wrapping_sub(1 << 62)));
            let off = y - (i128::from(got.to_bits()) << 32);
            // half a unit of 2^-48, and 63 products of 2^-53
            assert!(off.abs() < 1 << 34, "{u:#x}: {got} off by {off}");
        }
        for knot in knots {
            assert_eq!(f.at_wide(knot.x), knot.y);
        }
        assert_eq!((f.at_wide(Wide::MIN), f.at_wide(Wide::MAX)), (knots[0].y, knots[2].y));
    }

    /// Near the end of a wide part: a walk goes on until the product of its own widths has vanished. The
    /// distance to the end grows by 4/3 a map: `g(d) = alpha g(4 d / 3) - c 4 d / 3` for the distance of the
    /// value from the last.
    #[test]
    fn a_walk_along_a_wide_part_is_as_long_as_its_widths_ask() {
        let knots = [(0, 0), (1, 2), (4, 1)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let f = Fif::<2, 1>::interpolating(&knots, &[0.25, 0.96875].map(Scaling::from_num)).unwrap();
        for k in 3..30 {
            // domain: 4 wide, ends at 4
            let distance = 2_f64.powi(-k);
            // forward along the address until the scalings vanish: a place is known to 2^-50
            let value = |mut u: f64| {
                let (mut sum, mut weight) = (0.0, 1.0);
                for _ in 0..900 {
                    if u < 0.25 {
                        u *= 4.0;
                        sum += weight * 1.75 * u;
                        weight *= 0.25;
                    } else {
                        u = (u - 0.25) / 0.75;
                        sum += weight * (2.0 - 1.96875 * u);
                        weight *= 0.96875;
                    }
                }
                sum
            };
            let got = f.at_wide(Wide::from_num(4.0 - 4.0 * distance)).to_num::<f64>();
            let mut d = distance;
            let (mut sum, mut weight) = (0.0, 1.0);
            while d <= 0.75 {
                d *= 4.0 / 3.0;
                sum += weight * (1.96875 * d);
                weight *= 0.96875;
            }
            let exact = 1.0 + sum + weight * (value(1.0 - d) - 1.0);
            // what the first part makes of a place that is known to 2^-50
            assert!((got - exact).abs() < 2e-3 * weight + 1e-9, "{k}: {got} against {exact}, {weight}");
        }
    }

    /// `x^2 / 4` over `[0, 3]`, in two parts that meet at 1.
    fn parabola(alphas: [f64; 2]) -> Fif<2, 2> {
        // q_j(x) = (L_j(x)^2 - alpha_j x^2) / 4, L_1(x) = x / 3, L_2(x) = 1 + 2 x / 3
        let q = [[0.0, 0.0, 1.0 / 9.0 - alphas[0]], [1.0, 4.0 / 3.0, 4.0 / 9.0 - alphas[1]]];
        let q = q.map(|q| q.map(|c: f64| Wide::from_num(c / 4.0)));
        let scalings = alphas.map(Scaling::from_num);
        Fif::from_polynomials(&[0, 1, 3].map(Wide::from_num), &scalings, &[&q[0], &q[1]]).unwrap()
    }

    /// Walks end in cells, where scalings near 1 leave much of the function: its chord is not left out.
    #[test]
    fn a_straight_line_and_a_parabola_are_their_own_values() {
        let mut state = 5_u64;
        let mut place = |from: f64, to: f64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            from + (state >> 16) as f64 / 2_f64.powi(48) * (to - from)
        };
        // a bound of the range is as high as the line over 1 - max|alpha|
        for (alpha, height) in [(0.5, 1.0), (0.99, 1.0), (-0.999, 0.125)] {
            for xs in [[0, 1, 3], [0, 7, 8], [-5, 7, 8]] {
                let line = xs.map(|x| Knot::new(Wide::from_num(x), Wide::from_num(x as f64 / 16.0 * height)));
                let scalings = [alpha, 0.9].map(Scaling::from_num);
                let f = Fif::<2, 1>::interpolating(&line, &scalings).unwrap();
                let wider = Fif::<2, 2>::interpolating(&line, &scalings).unwrap();
                let bound = f.error_bound().to_num::<f64>();
                assert!(bound < 1e-4, "{alpha} {xs:?}: {bound}");
                for _ in 0..200 {
                    let x = place(xs[0] as f64, xs[2] as f64);
                    let y = f.at(Wide::from_num(x));
                    let off = y.to_num::<f64>() - x / 16.0 * height;
                    assert!(off.abs() <= bound, "{alpha} {xs:?} at {x}: {off} of {bound}");
                    assert_eq!(wider.at(Wide::from_num(x)), y);
                }
            }
        }
        // up to 9/4, and a bound of its range that is twenty times as high
        for alpha in [0.5, 0.95, -0.95] {
            let f = parabola([alpha, 0.9]);
            // what scalings of 31 bits make of the polynomials, over 1 - max|alpha|
            let bound = f.error_bound().to_num::<f64>() + 2e-9 / (1.0 - f.max_scaling().to_num::<f64>());
            assert!(bound < 1e-3, "{alpha}: {bound}");
            for _ in 0..200 {
                let x = place(0.0, 3.0);
                let off = f.at(Wide::from_num(x)).to_num::<f64>() - x * x / 4.0;
                assert!(off.abs() <= bound, "{alpha} at {x}: {off} of {bound}");
            }
        }
    }
}
