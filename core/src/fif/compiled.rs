//! A function on any partition, compiled to 32-bit words.
//!
//! The walk is that of [`Fif::at`], forward along the address of the place `u`:
//! `f(u) = q_j1(u_1) + alpha_j1 q_j2(u_2) + alpha_j1 alpha_j2 q_j3(u_3) + ...` with
//! `u_k = (u_(k-1) - start) / width`. Nothing is divided: with `2^n width` in `(1/2, 1]` a pre-image is
//! `part + part more`, where `part = 2^n (u - start)` is a product and a sum modulo `2^32`, and
//! `more = 1 / (2^n width) - 1`. Places have 32 fractional bits, the weights `alpha_j1 alpha_j2 ...` 31, and
//! values as many as the range of the function allows. The only unit that fits a weight is -1: weights are
//! negative at first, and constants, powers and ends have the opposite sign.
//!
//! The walk takes the same number of maps for every place, unless a pre-image is the left end: enough that
//! either the weight is below `2^-31`, or the cell of the address narrower than `2^-32`. In that cell the
//! value is taken from the chord of the function, which its graph crosses: see `evaluate.rs`.
//!
//! Source: Cochran, Lewis, Hart, eq. 17.

use super::bounds::LEVELS;
use super::error::up;
use super::function::Fif;
use super::map::{Map, first_step};
use super::value::{FRACTION_Q55, ONE_UQ63, fraction_for, real, word};
use crate::Error;
use crate::num::formats::UQ32;
use crate::num::{Angle, Real, Wide, high_rounded, high_u, mul_high_u, product, ratio, round_shift};

/// No word has fewer fractional bits: values are below `2^7`, powers below `2^10`.
const LEAST: u32 = 20;

/// No part is narrower, 63 fractional bits: no two knots become one word.
const NARROWEST: u64 = 1 << 31;

/// One map in 32-bit words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
struct Words<const D: usize> {
    /// `2^n`, and `-2^n start` modulo `2^32`.
    scale: u32,
    offset: u32,
    more: UQ32,
    /// 31 fractional bits.
    scaling: i32,
    /// With the opposite sign; powers have a fractional bit more than the constant.
    constant: i32,
    powers: [i32; D],
}

impl<const D: usize> Words<D> {
    const ZERO: Self = Self { scale: 0, offset: 0, more: 0, scaling: 0, constant: 0, powers: [0; D] };

    /// Of a map whose part begins and ends at these places; an end of 0 is that of the domain.
    fn new(map: &Map<D>, [start, end]: [UQ32; 2], fraction: u32) -> Self {
        // a width of 0 is the whole domain, and one that becomes 0 a power of two: 1
        let width = end.wrapping_sub(start);
        let places = width.wrapping_sub(1).leading_zeros();
        let scale = 1_u32.checked_shl(places).unwrap_or(0);
        let normal = width.wrapping_mul(scale);
        let missing = u64::from(normal.wrapping_neg());
        Self {
            scale,
            offset: start.wrapping_mul(scale).wrapping_neg(),
            more: ratio(missing, 32, (1 << 32) - missing) as u32,
            // less than 1 - 2^-23, as the range of any function asks: no weight becomes 1, which has no word
            scaling: round_shift(map.scaling, 32) as i32,
            constant: word(map.q.constant.wrapping_neg(), fraction),
            powers: map.q.powers.map(|c| word(c.wrapping_neg(), fraction + 1)),
        }
    }

    /// The pre-image of a place in the map's part. Error: below 2 units, downwards
    /// (`a_pre_image_is_low_by_less_than_two_units`).
    #[inline(always)]
    fn pre_image(&self, u: UQ32) -> UQ32 {
        let part = u.wrapping_mul(self.scale).wrapping_add(self.offset);
        part.wrapping_add(high_u(part, self.more))
    }

    /// The polynomial at a place with 31 fractional bits.
    #[inline(always)]
    fn q(&self, t: i32) -> i32 {
        let sum = |sum: i32, c: &i32| c.wrapping_add(high_rounded(sum, t) << 1);
        self.constant.wrapping_add(high_rounded(self.powers.iter().rev().fold(0, sum), t))
    }
}

/// A [`Fif`] of at most `N` maps on any partition, ready for fast evaluation at places of 32 bits.
///
/// ```
/// use attractor::fif::{Fif, Knot};
/// use attractor::num::{Angle, Real, Scaling, Wide};
///
/// let knots = [(0, 0), (1, 1), (3, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
/// let f = Fif::<2, 1>::interpolating(&knots, &[Scaling::from_num(0.25), Scaling::from_num(-0.5)])?;
/// let fast = f.compiled()?;
/// // x = 0.75: 3/4 + 1/4 f(2.25), and f(2.25) = 3/8 - 1/2 f(1.875), and so on
/// let (got, exact) = (fast.at(Angle::from_num(0.25)), f.at(Wide::from_num(0.75)));
/// assert!((got - exact).abs() < Real::lit("0.0001"), "{got} {exact}");
/// assert!(fast.abscissa_bound() < Angle::from_num(2e-9));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Compiled<const N: usize, const D: usize = 1> {
    maps: [Words<D>; N],
    /// The last place of each part; all of them behind the last map.
    ends: [UQ32; N],
    /// `y_0` and half of `y_N - y_0`, with the opposite sign.
    first: i32,
    half_rise: i32,
    levels: u32,
    /// Fractional bits of values.
    fraction: u32,
    error: Real,
    shift: UQ32,
}

impl<const N: usize, const D: usize> Compiled<N, D> {
    /// The value at the place `u` of the domain, a fraction in `[0, 1)`.
    ///
    /// Error: at most [`Compiled::error_bound`] at a place no further than [`Compiled::abscissa_bound`] from
    /// `u` (`a_compiled_value_is_exact_at_a_place_beside`). Cost: 22.3 Cortex-M4 instructions
    /// (kernel `fif compiled level`) a level for two maps of degree 1, some 5 more for each doubling of `N`
    /// and 2 for each further power; the same number of levels for every place whose pre-images do not meet
    /// the left end, and never more than 32,768: 31 for two equal maps with scalings of a half.
    #[inline]
    pub fn at(&self, u: Angle) -> Real {
        real(self.walk(u.to_bits()), self.fraction)
    }

    /// A bound on the error of [`Compiled::at`] at a place that it has evaluated, for the maps of the
    /// function as it was compiled, scalings of 31 bits among them, rounded up: over `1 - max|alpha|` half a
    /// unit of a word and three quarters for each power, `2^-32 max|f|` and the slope times the shift of the
    /// place; `2^-31 max|f|` for each level; what is left of the function after the last; half a unit of the
    /// result. Hard cases reach half of it
    /// (`a_compiled_error_bound_is_less_than_five_times_the_worst_error`).
    pub fn error_bound(&self) -> Real {
        self.error
    }

    /// How far the place with the exact value may be from the one that was asked for, as a part of the
    /// domain: `2^-32 (2.5 (1 + a + a^2 + ...) - 1)` for the widest part `a`, and 0 where the widths of all
    /// parts are powers of two. How much a rough function may differ over that distance says
    /// [`Fif::oscillation`].
    pub fn abscissa_bound(&self) -> Angle {
        Angle::from_bits(self.shift)
    }

    /// Out of line: where few maps are inlined, the compiler copies them, and chooses number by number.
    #[inline(never)]
    fn walk(&self, mut u: UQ32) -> i32 {
        let mut weight = i32::MIN;
        let mut sum = 1_i64 << 30; // 31 fractional bits more than a value
        let mut left = self.levels;
        while left > 0 {
            left -= 1;
            // index < N: `get` only spares the proof to the compiler
            let Some(map) = self.maps.get(self.index(u)) else { break };
            u = map.pre_image(u);
            sum = sum.wrapping_add(product(weight, map.q((u >> 1) as i32)));
            weight = high_rounded(weight, map.scaling) << 1;
            if u == 0 {
                break;
            }
        }
        let chord = self.first.wrapping_add((product(self.half_rise, (u >> 1) as i32) >> 30) as i32);
        (sum.wrapping_add(product(weight, chord)) >> 31) as i32
    }

    /// Of the first part that ends at or behind `u`.
    #[inline(always)]
    fn index(&self, u: UQ32) -> usize {
        let (mut index, mut step) = (0, const { first_step(N) });
        while step > 0 {
            if self.ends.get(index + step - 1).is_some_and(|end| *end < u) {
                index += step;
            }
            step /= 2;
        }
        index
    }
}

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The function compiled to 32-bit words. Where the partition is dyadic [`Fif::dyadic`] is faster still.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a part narrower than `2^-32` of the domain.
    pub fn compiled(&self) -> Result<Compiled<N, D>, Error> {
        if let Some((index, map)) = self.maps.iter().enumerate().find(|(_, m)| m.width < NARROWEST) {
            let wide = |width: u64| Wide::from_bits(width.min(i64::MAX as u64) as i64);
            return Err(Error::OutOfRange {
                what: "width of part",
                index: Some(index),
                value: wide(mul_high_u(self.width, map.width << 1)),
                min: wide(self.width >> 32),
                max: wide(self.width),
            });
        }
        // the largest numbers that words must hold; powers have a bit more
        let mut largest = self.range.0.unsigned_abs().max(self.range.1.unsigned_abs());
        for map in &self.maps {
            let powers = map.q.powers.iter().fold(0_u64, |sum, c| sum.saturating_add(c.unsigned_abs()));
            largest = largest.max(powers.saturating_mul(2)).max(map.q.norm().unsigned_abs());
        }
        let losses = Losses::of(self);
        // with room for what is lost
        let fits =
            |fraction: &u32| fraction_for(largest.saturating_add(losses.of_values(*fraction))) >= *fraction;
        let fraction = (LEAST..=fraction_for(largest)).rev().find(fits).unwrap_or(LEAST);
        let mut compiled = Compiled {
            maps: [Words::ZERO; N],
            ends: [u32::MAX; N],
            first: word(self.first.wrapping_neg(), fraction),
            half_rise: word((self.first - self.last) >> 1, fraction),
            levels: losses.levels,
            fraction,
            error: losses.bound(fraction),
            shift: losses.shift,
        };
        let place = |u: u64| ((u + (1 << 30)) >> 31) as u32;
        for ((map, words), last) in self.maps.iter().zip(&mut compiled.maps).zip(&mut compiled.ends) {
            let ends = [place(map.start), place(map.start + map.width)];
            *words = Words::new(map, ends, fraction);
            *last = ends[1].wrapping_sub(1);
        }
        Ok(compiled)
    }
}

/// What a function loses as words. Values have 55 fractional bits.
struct Losses {
    levels: u32,
    /// How far the place whose value it is may be from the place asked for.
    shift: UQ32,
    /// `1 - max|alpha|`, 31 fractional bits.
    rest: u64,
    /// The product of the scalings after the last level, 63 fractional bits.
    weight: u64,
    degree: u64,
    /// The largest value; what a polynomial and a scaling lose at a level, besides units of a word; what is
    /// left of the function after the last.
    value: u64,
    level: u64,
    left: u64,
}

impl Losses {
    #[inline(never)]
    fn of<const N: usize, const D: usize>(f: &Fif<N, D>) -> Self {
        // scalings are rounded to 31 bits
        let steepest = f.steepest() + (1 << 31);
        let widest = f.maps.iter().map(|map| map.width).max().unwrap_or(ONE_UQ63);
        let (flat, _) = powers(steepest, 1 << 32, LEVELS);
        let (narrow, cell) = powers(widest, NARROWEST, LEVELS);
        let by_width = f.degree() < 2 && cell <= NARROWEST && narrow <= flat;
        let levels = if by_width { narrow } else { flat };
        let (_, weight) = powers(steepest, 0, levels);
        let left = if by_width { 0 } else { mul_high_u(f.spread() << 1, weight) + 1 };
        // half a unit for the knots of a level, less than 2 for its pre-image, and one for the last cell:
        // 2.5 (1 + a + a^2 + ...) - 1, the sum with 16 fractional bits
        let sum = ratio(1 << 16, 63, ONE_UQ63.saturating_sub(widest)).min(u64::from(levels) << 16);
        let exact = f.maps.iter().all(|map| map.width.is_power_of_two());
        let shift = if exact { 0 } else { (5 * sum + 5).div_ceil(1 << 17) - 1 };
        // a polynomial is taken at a place that is off by the shift, and by a bit that it has not
        let slope = mul_high_u(f.slope(), (shift + 1) << 32) + 1;
        let rest = ((ONE_UQ63 - steepest) >> 32).max(1);
        let value = f.range.0.unsigned_abs().max(f.range.1.unsigned_abs()) + ratio(slope, 31, rest);
        let degree = f.degree() as u64;
        let level = slope + (value >> 32) + 1;
        Self { levels, shift: shift as u32, rest, weight, degree, value, level, left }
    }

    /// A level loses half a unit of its constant, a quarter of each power and half a unit for each product;
    /// all of them over `1 - max|alpha|`. A weight loses a unit of its own a level, of all values that
    /// follow; the chord at the end less than 4 units.
    #[inline(never)]
    fn of_values(&self, fraction: u32) -> u64 {
        let unit = 1 << (FRACTION_Q55 - fraction);
        let level = self.level.saturating_add(unit / 4 * (3 * self.degree + 2));
        let values = ratio(level, 31, self.rest);
        let weights = ((self.value.saturating_add(values) >> 31) + 1).saturating_mul(self.levels.into());
        let end = self.left.saturating_add(mul_high_u(unit << 3, self.weight) + 1);
        values.saturating_add(weights).saturating_add(end)
    }

    /// With half a unit of the word, and of the result.
    fn bound(&self, fraction: u32) -> Real {
        let unit = 1 << (FRACTION_Q55 - fraction);
        // words of 24 bits and fewer are results
        let result = if fraction > 24 { 1 << (FRACTION_Q55 - 25) } else { 0 };
        up(self.of_values(fraction).saturating_add(unit / 2 + result))
    }
}

/// The least power of a ratio that is at most a limit, rounded up, and which it is; the last one allowed if
/// none is.
#[inline(never)]
fn powers(ratio: u64, limit: u64, most: u32) -> (u32, u64) {
    let (mut count, mut power) = (1, ratio);
    while power > limit && count < most {
        let twice = power.saturating_mul(2);
        power = mul_high_u(twice, ratio) + u64::from(twice.wrapping_mul(ratio) != 0);
        count += 1;
    }
    (count, power)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fif::Knot;
    use crate::num::Scaling;

    fn next(state: &mut u64) -> u64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        *state ^ *state >> 32
    }

    fn knots<const K: usize>(points: [(i64, f64); K]) -> [Knot; K] {
        points.map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)))
    }

    /// The value with 80 fractional bits, for parts whose widths are powers of two: all pre-images are exact
    /// and the last of at most 32 is 0; from the last digit to the first a value loses less than `D + 1` of
    /// its units a map.
    fn exact<const N: usize, const D: usize>(f: &Fif<N, D>, place: u32) -> i128 {
        let mut address = std::vec::Vec::new();
        let mut u = u64::from(place) << 31;
        while u > 0 {
            let map = f.maps.iter().rev().find(|map| map.start <= u).unwrap();
            u = (u - map.start) << map.width.leading_zeros();
            address.push((map, u));
            assert!(address.len() <= 32);
        }
        address.iter().rev().fold(i128::from(f.first) << 25, |y, (map, u)| {
            let powers = map.q.powers.iter().rev();
            let q = powers.fold(0, |sum, c| ((sum + (i128::from(*c) << 25)) * i128::from(*u >> 31)) >> 32);
            q + (i128::from(map.q.constant) << 25) + ((y * i128::from(map.scaling >> 32)) >> 31)
        })
    }

    /// The largest error over the bound, for scalings up to `1 - gap / 16` and values below about `2^height`.
    fn nearest<const N: usize>(xs: &[i64], height: u32, gap: u64) -> f64 {
        let mut state = (u64::from(height) << 32 | gap) + xs.len() as u64;
        let mut nearest = 0.0_f64;
        for _ in 0..40 {
            let state = &mut state;
            let knots: std::vec::Vec<_> = xs
                .iter()
                .map(|x| Knot::new(Wide::from_num(*x), Wide::from_bits(next(state) as i64 >> (18 - height))))
                .collect();
            let scalings: std::vec::Vec<_> = xs[1..]
                .iter()
                .map(|_| {
                    let size = ((16 - gap) << 27) - (next(state) >> 40);
                    Scaling::from_bits(if next(state) & 1 == 0 { size as i32 } else { -(size as i32) })
                })
                .collect();
            let Ok(f) = Fif::<N, 1>::interpolating(&knots, &scalings) else { continue };
            let Ok(curve) = f.integral::<2>(Wide::ZERO) else { continue };
            nearest = nearest.max(of_bound(&f, state)).max(of_bound(&curve, state));
        }
        nearest
    }

    /// The worst error of a word over what is said of it; no result beyond the bound.
    fn of_bound<const N: usize, const D: usize>(f: &Fif<N, D>, state: &mut u64) -> f64 {
        let fast = f.compiled().unwrap();
        assert_eq!(fast.abscissa_bound(), Angle::ZERO);
        let bound = i128::from(fast.error_bound().to_bits()) << 56;
        let words = Losses::of(f).of_values(fast.fraction) + (1 << (54 - fast.fraction));
        let ends = [0, 1, u32::MAX, 0x5555_5555, 0xaaaa_aaaa, 0x7fff_ffff];
        let mut worst = 0;
        for k in 0..200 {
            let u = ends.get(k).copied().unwrap_or(next(state) as u32);
            let exact = exact(f, u);
            let off = (exact - (i128::from(fast.at(Angle::from_bits(u)).to_bits()) << 56)).abs();
            assert!(off <= bound, "{f:?} at {u:#x}: {off} of {bound}");
            worst = worst.max((exact - (i128::from(fast.walk(u)) << (80 - fast.fraction))).abs());
        }
        let words = i128::from(words) << 25;
        assert!(worst <= words, "{f:?}: {worst} of {words}");
        worst as f64 / words as f64
    }

    /// Against integers with 80 fractional bits where every place is exact: none beyond the bound, and for
    /// each height and slope one above a fifth of it, before the result is rounded.
    #[test]
    fn a_compiled_error_bound_is_less_than_five_times_the_worst_error() {
        for height in [0, 2, 4] {
            for gap in [12, 8, 4, 2] {
                let got = [
                    nearest::<2>(&[0, 1, 2], height, gap),
                    nearest::<3>(&[0, 2, 3, 4], height, gap),
                    nearest::<6>(&[-1, 0, 1, 3, 7], height, gap),
                ];
                assert!(got.iter().all(|got| *got > 0.2), "2^{height}, {gap} sixteenths: {got:?}");
            }
        }
    }

    /// Against the maps of the function in integers: a pre-image goes back to less than two and a half units
    /// from where it came, and the last of a walk to no further from the place than is said.
    #[test]
    fn a_pre_image_is_low_by_less_than_two_units() {
        let mut state = 1;
        for xs in [[0, 1, 3, 5], [0, 10, 11, 12], [0, 5, 9, 1000], [-3, 4, 6, 40]] {
            let f =
                Fif::<3, 1>::interpolating(&knots(xs.map(|x| (x, 0.0))), &[Scaling::lit("0.9"); 3]).unwrap();
            let fast = f.compiled().unwrap();
            let (mut low, mut far) = (0.0_f64, 0.0_f64);
            for _ in 0..3000 {
                let place = next(&mut state) as u32;
                let (mut u, mut cell, mut shift) = (place, 1.0, 0.0);
                for _ in 0..fast.levels {
                    let index = fast.index(u);
                    let (map, pre_image) = (&f.maps[index], fast.maps[index].pre_image(u));
                    let image = (u128::from(map.start) << 32) + u128::from(map.width) * u128::from(pre_image);
                    // units of 2^-32
                    let off = ((u128::from(u) << 63) as i128 - image as i128) as f64 / 2_f64.powi(63);
                    let width = map.width as f64 / 2_f64.powi(63);
                    assert!(off > -0.5 && off < 0.5 + 2.0 * (width + 2_f64.powi(-32)), "{off} for {width}");
                    low = low.max(off / (0.5 + 2.0 * width));
                    shift += cell * off;
                    (u, cell) = (pre_image, cell * width);
                }
                far = far.max(f64::abs(shift));
            }
            let bound = f64::from(fast.shift);
            assert!(far <= bound && far > bound / 5.0 && low > 0.4, "{xs:?}: {far} of {bound}, {low}");
        }
    }

    /// Walks end in cells, where scalings near 1 leave much of the function: its chord is not left out.
    #[test]
    fn a_straight_line_is_compiled_to_one() {
        let mut state = 7;
        // a bound of the range is as high as the line over 1 - max|alpha|
        for (alpha, height) in [(0.5, 1.0), (0.99, 1.0), (-0.999, 0.125)] {
            for xs in [[0, 1, 3], [0, 7, 8], [-5, 7, 8]] {
                let line = knots(xs.map(|x| (x, x as f64 / 16.0 * height)));
                let scalings = [alpha, 0.9].map(Scaling::from_num);
                let f = Fif::<2, 1>::interpolating(&line, &scalings).unwrap();
                let fast = f.compiled().unwrap();
                let bound = fast.error_bound().to_num::<f64>();
                assert!(bound < 3e-3, "{alpha} {xs:?}: {bound}");
                for _ in 0..500 {
                    let u = next(&mut state) as u32;
                    let x = xs[0] as f64 + f64::from(u) / 2_f64.powi(32) * (xs[2] - xs[0]) as f64;
                    let off = fast.at(Angle::from_bits(u)).to_num::<f64>() - x / 16.0 * height;
                    assert!(off.abs() <= bound, "{alpha} {xs:?} at {x}: {off} of {bound}");
                }
            }
        }
    }

    /// `x^2 / 4`, whose chord is no part of it: the walk is as long as its scalings ask.
    #[test]
    fn a_parabola_is_compiled_to_one() {
        // over [0, 3], in parts that meet at 1: q_j(x) = (L_j(x)^2 - alpha_j x^2) / 4
        let q = [[0.0, 0.0, 1.0 / 9.0 - 0.95], [1.0, 4.0 / 3.0, 4.0 / 9.0 + 0.9]];
        let q = q.map(|q| q.map(|c: f64| Wide::from_num(c / 4.0)));
        let scalings = [0.95, -0.9].map(Scaling::from_num);
        let f = Fif::<2, 2>::from_polynomials(&[0, 1, 3].map(Wide::from_num), &scalings, &[&q[0], &q[1]])
            .unwrap();
        let fast = f.compiled().unwrap();
        let bound = fast.error_bound().to_num::<f64>() + 2.0 * f64::from(fast.shift) / 2_f64.powi(32);
        assert!(bound < 1e-3, "{bound}");
        let mut state = 7;
        for _ in 0..500 {
            let u = next(&mut state) as u32;
            let x = f64::from(u) / 2_f64.powi(32) * 3.0;
            let off = fast.at(Angle::from_bits(u)).to_num::<f64>() - x * x / 4.0;
            assert!(off.abs() <= bound, "{x}: {off} of {bound}");
        }
    }

    #[test]
    fn each_part_is_found() {
        let xs = [0, 3, 4, 9, 17, 18, 40, 41, 77, 100, 130, 255, 256];
        let points = xs.map(|x| (x, (x % 7) as f64));
        let f = Fif::<16, 1>::interpolating(&knots(points), &[Scaling::lit("0.25"); 12]).unwrap();
        let fast = f.compiled().unwrap();
        for (index, (x, y)) in points.into_iter().enumerate().take(12) {
            let place = (x as u32) << 24;
            assert_eq!(fast.index(place), index);
            assert_eq!(fast.index(place.wrapping_sub(1)), if x == 0 { 11 } else { index - 1 });
            assert_eq!(fast.at(Angle::from_bits(place)), Real::from_num(y), "{x}");
        }
        let one = Fif::<1, 1>::interpolating(&knots([(0, 1.0), (3, 4.0)]), &[Scaling::lit("0.9")]).unwrap();
        let one = one.compiled().unwrap();
        assert_eq!((one.at(Angle::lit("0.5")), one.abscissa_bound()), (Real::lit("2.5"), Angle::ZERO));
    }

    #[test]
    fn a_part_without_a_place_is_refused() {
        let parts = |inner: i64| {
            let knots = [0, inner, 1 << 50].map(|x| Knot::new(Wide::from_bits(x), Wide::ZERO));
            Fif::<2, 1>::interpolating(&knots, &[Scaling::ZERO; 2]).unwrap().compiled()
        };
        let least = 1 << 18;
        assert!(parts(least).is_ok() && parts((1 << 50) - least).is_ok());
        for (inner, at) in [(least - 1, 0), ((1 << 50) - least + 1, 1)] {
            let expected = Error::OutOfRange {
                what: "width of part",
                index: Some(at),
                value: Wide::from_bits(least - 1),
                min: Wide::from_bits(least),
                max: Wide::from_bits(1 << 50),
            };
            assert_eq!(parts(inner).unwrap_err(), expected);
        }
    }

    /// Of a function that is 0 even, whose range is bounded with 16 fractional bits.
    #[test]
    fn no_function_is_so_steep_that_a_weight_leaves_its_word() {
        let parts = knots([(0, 0.0), (1, 0.0), (3, 0.0)]);
        let mut steepest = 0;
        for k in 1..32 {
            for scaling in [Scaling::MAX, Scaling::MIN + Scaling::DELTA] {
                let scaling = scaling >> k << k;
                let Ok(f) = Fif::<2, 1>::interpolating(&parts, &[scaling; 2]) else { continue };
                let words = f.compiled().unwrap().maps.map(|words| words.scaling);
                assert_eq!(words, [scaling.to_bits(); 2]);
                steepest = words[0].abs().max(steepest);
            }
        }
        let rest = (1_u32 << 31) - steepest as u32;
        assert!(rest > 1 << 8 && rest < 1 << 12, "{rest}");
    }

    #[test]
    fn a_power_is_the_first_below_its_limit() {
        assert_eq!(powers(ONE_UQ63 / 2, 1 << 31, LEVELS), (32, 1 << 31));
        assert_eq!(powers(ONE_UQ63 / 2, (1 << 31) - 1, LEVELS), (33, 1 << 30));
        assert_eq!((powers(0, 0, 9), powers(ONE_UQ63, 1 << 31, 9).0), ((1, 0), 9));
        let (count, power) = powers(ONE_UQ63 / 10 * 9, 1 << 32, LEVELS);
        let exact = 0.9_f64.powi(count as i32) * 2_f64.powi(63);
        assert!(count == 204 && (power as f64 - exact).abs() < 1e-6 * exact, "{count} {power} {exact}");
    }
}
