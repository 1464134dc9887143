//! Running sums of a differentiable function: value, area and the squares of the slope from the left end to
//! each of many places, so that two look-ups tell what the function does between any two.
//!
//! Between `a` and `b`, `w` apart: the mean slope `(F(b) - F(a)) / w`, the mean value `(A(b) - A(a)) / w`
//! with the area `A`, the slope's variance `(Q(b) - Q(a)) / w - slope^2` with the sum `Q` of the squares of
//! slopes, and the covariance of slope and value `slope ((F(a) + F(b)) / 2 - value)`, by the fundamental
//! theorem for `F F'`. The places are the ends of the cells of one level, over which the sums are exact; in a
//! cell value and squares go straight, and the area is that under a straight value. Sources: Crow,
//! "Summed-area tables for texture mapping", SIGGRAPH 1984; the moments of cells: [`super::variance`].
//! Formats: values 24 fractional bits, areas and squares as many as the whole leaves room for.

use core::num::NonZeroU32;

use super::above;
use super::ended::Ended;
use super::function::Fif;
use super::polynomial::{length_of, product_q55};
use super::pyramid::Pyramid;
use super::value::FRACTION_Q55;
use super::variance::FRACTION_OF_SQUARES;
use crate::Error;
use crate::num::formats::{Q21, Q22, Q24};
use crate::num::{
    Real, Wide, high, mul_high, product, product_u, product_within, quotient, ratio, real_from,
    reciprocal_of, sqrt,
};

/// What a function and its slope have come to at one place. 12 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sum {
    value: i32,
    area: i32,
    squares: i32,
}

impl Sum {
    /// All zero: for the memory that sums are lent.
    pub const ZERO: Self = Self { value: 0, area: 0, squares: 0 };

    /// The value, 24 fractional bits.
    #[inline(always)]
    pub(crate) const fn value(&self) -> i32 {
        self.value
    }
}

/// What a function does between two places: mean slope and value, how much the slope varies, and the value
/// with it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Trend {
    /// Mean slope.
    pub slope: Real,
    /// Mean value.
    pub value: Real,
    /// Variance of the slope.
    pub variance: Real,
    /// Covariance of slope and value.
    pub covariance: Real,
}

/// The same before what is derived from it, in the bits that the upper word of a product has.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Course {
    /// Mean slope, 21 fractional bits.
    pub(crate) slope: Q21,
    /// Mean value and mean square of the slope, 22.
    pub(crate) value: Q22,
    pub(crate) squares: Q22,
    /// The mean of the values at both ends: times the mean slope, the mean of slope times value.
    pub(crate) middle: Q24,
}

impl Course {
    /// The mean slope, in the middle of what the bits cut off may be.
    #[inline(always)]
    pub(crate) const fn slope(&self) -> Q24 {
        self.slope << 3 | 4
    }

    /// The mean value, alike.
    #[inline(always)]
    pub(crate) const fn value(&self) -> Q24 {
        self.value << 2 | 2
    }

    /// The variance of the slope.
    #[inline(always)]
    pub(crate) fn variance(&self) -> Q24 {
        // of factors that differ: of a square the compiler knows the sign, and takes more than an instruction
        // to saturate it; below 2^7
        let square = product(self.slope, self.slope());
        let above = ((square >> 32) as i32).clamp(-1 << 20, (1 << 20) - 1);
        let square = above << 11 | (square as u32 >> 21) as i32;
        (self.squares << 2).wrapping_sub(square).max(0)
    }

    /// The covariance of slope and value.
    #[inline(always)]
    pub(crate) fn covariance(&self) -> Q24 {
        product_within::<7>(self.slope(), self.middle.wrapping_sub(self.value()))
    }
}

/// The running sums of a differentiable function, in memory lent by the caller.
///
/// ```
/// use attractor::fif::{Fif, Knot, Sum, Sums};
/// use attractor::num::{Scaling, Wide};
///
/// let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
/// let g = Fif::<2, 2>::interpolating(&knots, &[0.85, -0.85].map(Scaling::from_num))?;
/// let integral = g.integral::<2>(Wide::ZERO)?;
/// let mut memory = [Sum::ZERO; Sums::places(2, 8)];
/// let sums = Sums::new(&integral, 8, &mut memory)?;
/// // the slope of the integral is g, whose variance is 100/333
/// let whole = sums.over(Wide::ZERO, Wide::from_num(2)).unwrap();
/// assert!((whole.variance.to_num::<f64>() - 100.0 / 333.0).abs() < 1e-5);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Sums<'a> {
    places: &'a [Sum],
    /// Left ends of the maps' intervals, 31 fractional bits.
    starts: &'a [u32],
    depth: u32,
    /// How many cells and how wide, as a [`Place`] says it, if they are of one width.
    even: Option<(NonZeroU32, i32)>,
    x0: i64,
    width: u64,
    /// The domain's length as the mantissa and the zeros of [`reciprocal_of`], 24 fractional bits; fewer
    /// zeros than none for a length that does not fit them.
    per_domain: (i32, i32),
    /// Fractional bits of areas and of squares, beyond 24; and twice what areas have more, as a factor.
    extra: [u32; 2],
    up: i32,
}

/// The reciprocals of an interval's width, for [`over`]: a power of two that a difference is multiplied by,
/// and a factor.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Width {
    slope: (i32, i32),
    area: (i32, i32),
    squares: (i32, i32),
}

/// Where a place lies: the sums at both ends of a cell, how far between them, 32 fractional bits, and minus
/// the cell's width, 31.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place<'a> {
    ends: &'a [Sum; 2],
    part: u32,
    less: i32,
}

/// Minus a width of 31 fractional bits, at most the whole.
fn less(width: u32) -> i32 {
    (width as i32).wrapping_neg()
}

/// Shifted up by so much, or the factor down.
#[inline(always)]
fn shifted(up: i32, factor: i32) -> (i32, i32) {
    let down = up.wrapping_neg().clamp(0, 31);
    (1 << up.clamp(0, 31), factor >> down)
}

/// A difference over a width, but for a factor of 4 or 8: its upper word is all that is needed of the
/// product.
#[inline(always)]
fn over(v: i32, (up, factor): (i32, i32)) -> i32 {
    // a shift by a variable takes one more instruction
    high(v.wrapping_mul(up), factor)
}

/// The reciprocal of a domain's width of 48 fractional bits, as [`Sums::per_domain`] has it.
fn per_domain(width: u64) -> (i32, i32) {
    // 24 fractional bits, where these are a word of 22 bits at least; else what is nearest to them
    let bits = 64 - width.leading_zeros();
    let dropped = bits.saturating_sub(22).min(24).max(bits.saturating_sub(32));
    let (mantissa, zeros) =
        reciprocal_of(NonZeroU32::new((width >> dropped) as u32).unwrap_or(NonZeroU32::MIN));
    (mantissa, (zeros + 24) as i32 - dropped as i32)
}

impl Sums<'static> {
    /// How many places the cells of level `depth` of a function of `maps` maps have: the memory to lend.
    pub const fn places(maps: usize, depth: u32) -> usize {
        let (mut count, mut k) = (1_usize, 0);
        while k < depth {
            (count, k) = (count.saturating_mul(maps), k + 1);
        }
        count.saturating_add(1)
    }

    /// Sums are never deeper.
    pub const MAX_DEPTH: u32 = Pyramid::MAX_DEPTH;
}

/// How many more than 24 fractional bits a number leaves room for in 31 bits, given with `fraction`; 10 at
/// most.
fn room(number: i64, fraction: u32) -> u32 {
    let bits = (64 - number.unsigned_abs().leading_zeros() + 24).saturating_sub(fraction);
    30_u32.saturating_sub(bits).min(10)
}

impl<'a> Sums<'a> {
    /// The sums of `fif` at the ends of the cells of level `depth`.
    ///
    /// Cost: a step for each cell of each level, of `2 D^2` products of 64 bits.
    ///
    /// # Errors
    /// [`Error::BufferLength`] if `memory` is shorter than [`Sums::places`]; [`Error::Capacity`] for a depth
    /// above [`Sums::MAX_DEPTH`]; [`Error::NotDifferentiable`] if some `|alpha_j| >= a_j`, and
    /// [`Error::OutOfRange`] if the slope leaves the format.
    pub fn new<const N: usize, const D: usize>(
        fif: &'a Fif<N, D>,
        depth: u32,
        memory: &'a mut [Sum],
    ) -> Result<Self, Error> {
        if depth > Sums::MAX_DEPTH {
            let (needed, capacity) = (depth as usize, Sums::MAX_DEPTH as usize);
            return Err(Error::Capacity { what: "levels", needed, capacity });
        }
        let (given, needed) = (memory.len(), Sums::places(fif.maps.len(), depth));
        let what = "places of 12 bytes for the running sums";
        let places = memory.get_mut(..needed).ok_or(Error::BufferLength { what, given, needed })?;
        let mut extra = [0; 2];
        above::walk(fif, depth, |level, cell| {
            // rise over length, which is short of 2^63 / 2^16 of the domain
            let length = length_of(fif.width, cell.width);
            let [first, last] = cell.ends;
            let slope = quotient(last.saturating_sub(first), 48, length.max(1));
            let squares = mul_high(slope, slope).saturating_add(cell.slope.variance);
            if level == 0 {
                let (low, high) = fif.range;
                let most = low.unsigned_abs().max(high.unsigned_abs()).max(high.abs_diff(low));
                extra = [room(most as i64, FRACTION_Q55), room(squares, FRACTION_OF_SQUARES)];
            }
            // means of what stays below 2^31 stay there
            let squares = squares.min(127 << FRACTION_OF_SQUARES);
            if let Some(place) = places.get_mut(cell.index).filter(|_| level == depth) {
                let mean = (first >> 1).wrapping_add(last >> 1).wrapping_sub(cell.lift);
                let part = |v: i64, fraction: u32, extra: u32| {
                    real_from(product_q55(v, cell.width), fraction.saturating_sub(extra)).to_bits()
                };
                *place = Sum {
                    value: real_from(first, FRACTION_Q55).to_bits(),
                    area: part(mean, FRACTION_Q55, extra[0]),
                    squares: part(squares, FRACTION_OF_SQUARES, extra[1]),
                };
            }
        })?;
        // from each cell's own to what lies before it
        let (mut area, mut squares) = (0_i32, 0_i32);
        if let Some(end) = places.last_mut() {
            *end = Sum { value: real_from(fif.last, FRACTION_Q55).to_bits(), area: 0, squares: 0 };
        }
        for place in places.iter_mut() {
            let own = *place;
            (place.area, place.squares) = (area, squares);
            area = area.saturating_add(own.area);
            squares = squares.saturating_add(own.squares);
        }
        let even = |(j, start): (u64, &u32)| {
            let exact = (j << 31).checked_div(fif.maps.len() as u64).unwrap_or(0);
            (exact as u32).abs_diff(*start) <= 1
        };
        let count = NonZeroU32::new((needed - 1).min(u32::MAX as usize) as u32);
        let even = count.filter(|_| (0..).zip(&fif.starts).all(even));
        let even = even.map(|count| (count, less((1_u32 << 31) / count)));
        let per_domain = per_domain(fif.width);
        let (x0, width) = (fif.x0, fif.width);
        let up = 2 << extra[0];
        Ok(Self { places, starts: &fif.starts, depth, even, x0, width, per_domain, extra, up })
    }

    /// Whether a pyramid is that of the same function.
    pub(crate) fn is_of(&self, starts: &[u32]) -> bool {
        core::ptr::eq(self.starts, starts)
    }

    /// Means, variance and covariance above `[from, to]`; what lies outside the domain does not count, and an
    /// interval without any width inside has none.
    ///
    /// Error: where the ends are those of cells and the interval is at least a 256th of the domain, `2^-18`
    /// of the largest of 1 and the squares of slope and value (`running_sums_tell_what_the_reference_says`);
    /// elsewhere also what a cell at each end varies. As values have 24 fractional bits, slopes are no better
    /// than `2^-23` over the interval's width, which is more in domains below 8 wide
    /// (`domains_of_any_width_have_their_slopes`). Cost: two look-ups in one table.
    pub fn over(&self, from: Wide, to: Wide) -> Option<Trend> {
        let unit = |x: Wide| {
            // domains may be wider than half of the format
            let distance = if x.to_bits() < self.x0 { 0 } else { x.to_bits().abs_diff(self.x0) };
            ratio(distance.min(self.width), 32, self.width).min(u32::MAX.into()) as u32
        };
        let (from, to) = (unit(from.min(to)), unit(from.max(to)));
        let width = self.width_of(NonZeroU32::new(to.wrapping_sub(from))?);
        let mut course = Course::default();
        self.course(from, to, &width, &mut course)?;
        let [slope, value] = [course.slope(), course.value()].map(Real::from_bits);
        let [variance, covariance] = [course.variance(), course.covariance()].map(Real::from_bits);
        Some(Trend { slope, value, variance, covariance })
    }

    /// Slopes and values that stand for the function above `[from, to]`: of each of half as many equal parts
    /// as there are points, two, `f -+ s` with `F -+ c / s`, `s^2` the variance of the slope and `c` the
    /// covariance. An interval without any width inside the domain leaves `points` as they are.
    pub fn points(&self, from: Wide, to: Wide, points: &mut [[Real; 2]]) {
        let (start, end) = (from.to_bits(), to.to_bits());
        let step = ratio(start.abs_diff(end), 1, points.len().max(1) as u64);
        let at = |k: u64| {
            let way = step.saturating_mul(k);
            let reached = if end < start {
                start.saturating_sub_unsigned(way)
            } else {
                start.saturating_add_unsigned(way)
            };
            Wide::from_bits(reached)
        };
        for (k, pair) in (0..).zip(points.chunks_mut(2)) {
            let Some(trend) = self.over(at(k), at(k + 1)) else { continue };
            let [slope, value] = [trend.slope, trend.value].map(Real::to_bits);
            // 24 fractional bits: the root of v, of a unit at least, with 48
            let s = sqrt(u64::from(trend.variance.to_bits().max(1).unsigned_abs()) << 24) as i32;
            let c = quotient(trend.covariance.to_bits().into(), 24, s.unsigned_abs().into());
            let c = c.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
            for (point, (s, c)) in pair.iter_mut().zip([(s, c), (s.wrapping_neg(), c.saturating_neg())]) {
                *point = [slope.saturating_add(s), value.saturating_add(c)].map(Real::from_bits);
            }
        }
    }

    /// The reciprocals of a width.
    #[inline(always)]
    pub(crate) fn width_of(&self, width: NonZeroU32) -> Width {
        let (mantissa, zeros) = reciprocal_of(width);
        let (per_domain, more) = self.per_domain;
        let per_length = (product(mantissa, per_domain) >> 31) as i32;
        // as far up as means that fit their formats allow
        let up = |less: u32| zeros.wrapping_sub(less) as i32;
        let [area, squares] = self.extra.map(|extra| shifted(up(extra), mantissa));
        Width { slope: shifted(up(8).wrapping_add(more), per_length), area, squares }
    }

    /// In which cell a place lies, 32 fractional bits: there is one for each.
    #[inline(always)]
    pub(crate) fn place(&self, u: u32) -> Option<Place<'a>> {
        match self.even {
            Some(even) => self.place_among(u, even),
            None => self.place_uneven(u),
        }
    }

    /// What it does between two places so far apart, written to where it stays; none where there are none.
    #[inline(always)]
    pub(crate) fn course(&self, from: u32, to: u32, width: &Width, course: &mut Course) -> Option<()> {
        let Some(even) = self.even else { return self.course_uneven(from, to, width, course) };
        let (from, to) = (self.place_among(from, even)?, self.place_among(to, even)?);
        *course = self.between(&self.at(&from), &self.at(&to), width);
        Some(())
    }

    #[cold]
    #[inline(never)]
    fn course_uneven(&self, from: u32, to: u32, width: &Width, course: &mut Course) -> Option<()> {
        let (from, to) = (self.place_uneven(from)?, self.place_uneven(to)?);
        *course = self.between(&self.at(&from), &self.at(&to), width);
        Some(())
    }

    #[inline(always)]
    fn place_among(&self, u: u32, (count, less): (NonZeroU32, i32)) -> Option<Place<'a>> {
        let place = product_u(u, count.get());
        let ends = self.places.get((place >> 32) as usize..)?.first_chunk()?;
        Some(Place { ends, part: place as u32, less })
    }

    #[cold]
    #[inline(never)]
    fn place_uneven(&self, u: u32) -> Option<Place<'a>> {
        let u = u >> 1;
        let cell = (0..self.depth).fold(Ended::WHOLE, |cell, _| cell.holding(self.starts, u, true));
        let (into, width) = (u.saturating_sub(cell.start), cell.end.saturating_sub(cell.start));
        let part = (u64::from(into) << 32).checked_div(width.into()).unwrap_or(0);
        let ends = self.places.get(cell.index..)?.first_chunk()?;
        Some(Place { ends, part: part.min(u32::MAX.into()) as u32, less: less(width) })
    }

    /// What the function has come to at a place.
    #[inline(always)]
    pub(crate) fn at(&self, Place { ends: [a, b], part, less }: &Place<'_>) -> Sum {
        let half = (part >> 1) as i32;
        let gained = |a: i32, b: i32| high(b.wrapping_sub(a) << 1, half);
        let risen = gained(a.value, b.value);
        // half of what has risen times the rest of the way: a rise leaves room for the bits that areas have
        // more
        let short = high(high(risen.wrapping_mul(self.up), half ^ i32::MAX), *less);
        Sum {
            value: a.value.wrapping_add(risen),
            area: a.area.wrapping_add(gained(a.area, b.area)).wrapping_add(short),
            squares: a.squares.wrapping_add(gained(a.squares, b.squares)),
        }
    }

    /// The value at a place.
    #[inline(always)]
    pub(crate) fn value_at(&self, u: u32) -> i32 {
        let Some(Place { ends: [a, b], part, .. }) = self.place(u) else { return 0 };
        a.value.wrapping_add(high(b.value.wrapping_sub(a.value) << 1, (part >> 1) as i32))
    }

    /// The sums `by` beyond an end, 30 fractional bits, where the function goes on straight, as between the
    /// end and a 1024th of the domain before it.
    #[inline(never)]
    pub(crate) fn beyond(&self, end: &Sum, by: i32) -> Sum {
        let before = if by < 0 { 1 << 22 } else { u32::MAX << 22 };
        let rise = (product(end.value.wrapping_sub(self.value_at(before)), by.wrapping_abs()) >> 20) as i32;
        let mean = end.value.wrapping_add(rise >> 1);
        let area = product(mean, by) >> (30_u32.saturating_sub(self.extra[0]) & 63);
        Sum {
            value: end.value.wrapping_add(rise),
            area: end.area.wrapping_add(area as i32),
            squares: end.squares,
        }
    }

    /// The mean value from one place to another, `width` to the right or to the left, 30 fractional bits;
    /// closer than 2^-12 of the domain that of a straight line.
    #[inline(always)]
    pub(crate) fn mean_between(&self, from: &Sum, to: &Sum, width: i32) -> i32 {
        match NonZeroU32::new(width.unsigned_abs()).filter(|width| width.get() >> 18 > 0) {
            None => (from.value >> 1).wrapping_add(to.value >> 1),
            Some(length) => {
                let (mantissa, zeros) = reciprocal_of(length);
                let up = zeros.wrapping_sub(2 + self.extra[0]) as i32;
                let mean = over(to.area.wrapping_sub(from.area), shifted(up, mantissa)) << 2 | 2;
                if width < 0 { mean.wrapping_neg() } else { mean }
            }
        }
    }

    /// What it does between two places of this width.
    #[inline(always)]
    pub(crate) fn between(&self, a: &Sum, b: &Sum, width: &Width) -> Course {
        // means of what is inside the format
        Course {
            slope: over(b.value.wrapping_sub(a.value), width.slope),
            value: over(b.area.wrapping_sub(a.area), width.area),
            squares: over(b.squares.wrapping_sub(a.squares), width.squares),
            middle: (a.value >> 1).wrapping_add(b.value >> 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fif::Knot;
    use crate::num::Scaling;
    use std::vec::Vec;

    const WHOLE: i32 = 1 << 30;

    /// From `first` on, the integral of the function through (0, `knots[0]`), (1, `knots[1]`), (2,
    /// `knots[2]`).
    fn with_integral(first: f64, knots: [f64; 3], scalings: [f64; 2], then: impl FnOnce(&Sums<'_>)) {
        let knot = |(x, y): (i32, f64)| Knot::new(Wide::from_num(x), Wide::from_num(y));
        let knots = [(0, knots[0]), (1, knots[1]), (2, knots[2])].map(knot);
        let slope = Fif::<2, 2>::interpolating(&knots, &scalings.map(Scaling::from_num)).unwrap();
        let f = slope.integral::<3>(Wide::from_num(first)).unwrap();
        let mut memory: Vec<Sum> = std::vec![Sum::ZERO; Sums::places(2, 9)];
        then(&Sums::new(&f, 9, &mut memory).unwrap());
    }

    impl Sums<'_> {
        /// Up to a part of the whole, 30 fractional bits, outside too.
        fn up_to(&self, u: i32) -> Sum {
            let inside = u.clamp(0, WHOLE - 1);
            let sum = self.at(&self.place((inside as u32) << 2).unwrap());
            if inside == u { sum } else { self.beyond(&sum, u - inside) }
        }

        /// The mean value between two such places.
        fn mean(&self, [a, b]: [i32; 2]) -> f64 {
            f64::from(self.mean_between(&self.up_to(a), &self.up_to(b), b - a)) / 2_f64.powi(24)
        }
    }

    /// Places inside and up to a quarter of the whole outside, in parts of it.
    fn places() -> impl Iterator<Item = [i32; 2]> {
        let place = |i: u32, n: u32| {
            let part = i.wrapping_mul(0x9e37_79b9).wrapping_add(n.wrapping_mul(0x85eb_ca6b)) >> 8;
            (f64::from(part) / 2_f64.powi(24) * 1.5 * f64::from(WHOLE)) as i32 - (WHOLE >> 2)
        };
        (0..400).map(move |i| [place(i, 1), place(i, 2)])
    }

    fn x(u: i32) -> f64 {
        2.0 * f64::from(u) / f64::from(WHOLE)
    }

    /// Two straight parts over `[from, from + width]`, in units of `2^-48`, that rise by `rises`.
    fn over_any_domain(from: i64, width: u64, rises: [f64; 2]) {
        let half = from.saturating_add_unsigned(width / 2);
        let ends = [from, half, from.saturating_add_unsigned(width)];
        let values = [0.0, rises[0], rises[0] + rises[1]];
        let knots = [0, 1, 2].map(|k: usize| Knot::new(Wide::from_bits(ends[k]), Wide::from_num(values[k])));
        let f = Fif::<2, 1>::interpolating(&knots, &[Scaling::ZERO; 2]).unwrap();
        let mut memory: Vec<Sum> = std::vec![Sum::ZERO; Sums::places(2, 6)];
        let sums = Sums::new(&f, 6, &mut memory).unwrap();
        let domain = width as f64 / 2_f64.powi(48);
        let slack = |v: f64| 2_f64.powi(-18) * (v * v).max(1.0);
        let slope_slack = |slope: f64| slack(slope) + 2_f64.powi(-22) / domain;
        let [a, b, c] = ends.map(Wide::from_bits);
        let mut points = [[Real::ZERO; 2]; 4];
        sums.points(a, c, &mut points);
        let parts = [(a, b, rises[0], 0.5, 0), (b, c, rises[1], 0.5, 2), (a, c, values[2], 1.0, 4)];
        for (from, to, rise, part, first) in parts {
            let trend = sums.over(from, to).unwrap();
            let slope = rise / (part * domain);
            let off = trend.slope.to_num::<f64>() - slope;
            assert!(off.abs() < slope_slack(slope), "{domain}: slope off by {off}");
            let value = match first {
                0 => values[1] / 2.0,
                2 => (values[1] + values[2]) / 2.0,
                _ => (2.0 * values[1] + values[2]) / 4.0,
            };
            let off = trend.value.to_num::<f64>() - value;
            assert!(off.abs() < slack(value), "{domain}: value off by {off}");
            for pair in points.chunks(2).skip(first / 2).take(usize::from(first < 4)) {
                let [s, v] =
                    [0, 1].map(|k: usize| (pair[0][k].to_num::<f64>() + pair[1][k].to_num::<f64>()) / 2.0);
                assert!((s - slope).abs() < slope_slack(slope), "{domain}: points' slope {s}");
                assert!((v - value).abs() < slack(value), "{domain}: {v}");
            }
        }
    }

    /// From the narrowest domains in which values have any bits to as wide as the format.
    #[test]
    fn domains_of_any_width_have_their_slopes() {
        for half in [100, 127, 128, 129, 255, 256, 1000, 16383, 16384, 20000, 32767] {
            let width = (2 * half as u64) << 48;
            over_any_domain(-(half << 48), width, [60.0, -90.0]);
            over_any_domain(-(half << 48) + 12345, width - 987_654_321, [-7.5, 1.0]);
        }
        over_any_domain(i64::MIN + 1, u64::MAX - 2, [30.0, -40.0]);
        for bits in [(1 << 28) + (1 << 24) - 1, (1 << 32) - 12345, (1 << 35) / 3, (1 << 45) / 7] {
            let domain = bits as f64 / 2_f64.powi(48);
            over_any_domain(0, bits, [30.0 * domain, -20.0 * domain]);
            over_any_domain(-(5 << 48), bits, [-1.5 * domain, 0.25 * domain]);
        }
    }

    /// Between an eighth and 256 the reciprocal of a domain is that of its 24 fractional bits.
    #[test]
    fn the_reciprocal_of_an_ordinary_domain_has_24_fractional_bits() {
        for width in
            [1 << 45, (1 << 45) + 12345, 1 << 48, (3 << 48) / 7, 2 << 48, 99 << 48, (256 << 48) - 1_u64]
        {
            let (mantissa, zeros) = reciprocal_of(NonZeroU32::new((width >> 24) as u32).unwrap());
            assert_eq!(per_domain(width), (mantissa, zeros as i32), "{width}");
        }
    }

    /// A straight line goes on as it is, at both ends: value and mean value.
    #[test]
    fn a_straight_line_goes_on_beyond_its_ends() {
        for (first, slope) in [(0.25, 0.5), (-1.0, 0.75), (0.5, -0.375), (0.0, 0.0)] {
            with_integral(first, [slope; 3], [0.0; 2], |sums| {
                let line = |x: f64| first + slope * x;
                let mut outside = [0; 2];
                for [a, b] in places() {
                    for u in [a, b] {
                        let value = f64::from(sums.up_to(u).value()) / 2_f64.powi(24);
                        // a unit of the rise over a 1024th
                        let far = (x(u) - x(u.clamp(0, WHOLE - 1))).abs() / 2.0;
                        let tolerance = (2.0 + 2048.0 * far) * 2_f64.powi(-24);
                        assert!((value - line(x(u))).abs() < tolerance, "{u}: {value}");
                        outside[0] += i32::from(u < 0);
                        outside[1] += i32::from(u >= WHOLE);
                    }
                    let (mean, exact) = (sums.mean([a, b]), line((x(a) + x(b)) / 2.0));
                    let close = (x(a) - x(b)).abs() / 2.0;
                    let tolerance = 2_f64.powi(-16) + 2_f64.powi(-24) / close.max(2_f64.powi(-12));
                    assert!((mean - exact).abs() < tolerance, "{a} {b}: {mean} {exact}");
                }
                assert!(outside.iter().all(|n| *n > 80), "{outside:?}");
            });
        }
    }

    /// Mean values of `x^2 / 4` between any two places, from left to right and back; a rough function's means
    /// by how wide each part is add up to that of the whole, outside too.
    #[test]
    fn mean_values_are_those_of_the_area() {
        with_integral(0.125, [0.0, 0.5, 1.0], [0.0; 2], |sums| {
            for [a, b] in places().map(|ends| ends.map(|u| u.clamp(0, WHOLE - 1))) {
                let (s, t) = (x(a), x(b));
                let exact = 0.125 + (s * s + s * t + t * t) / 12.0;
                let tolerance =
                    2_f64.powi(-19) + 2_f64.powi(-24) / ((t - s) / 2.0).abs().max(2_f64.powi(-12));
                for mean in [sums.mean([a, b]), sums.mean([b, a])] {
                    assert!((mean - exact).abs() < tolerance, "{s} {t}: {mean} {exact}");
                }
            }
            // closer than 2^-12: half of both values
            let [a, b] = [WHOLE / 3, WHOLE / 3 + (1 << 17)];
            let [f, g] = [a, b].map(|u| sums.up_to(u));
            assert_eq!(sums.mean_between(&f, &g, b - a), (f.value() >> 1) + (g.value() >> 1));
        });
        with_integral(0.0, [0.0, 1.0, 0.0], [0.85, -0.85], |sums| {
            for ([a, b], [c, _]) in places().zip(places().skip(7)) {
                let width = |ends: [i32; 2]| x(ends[1]) - x(ends[0]);
                let part = |ends: [i32; 2]| width(ends) * sums.mean(ends);
                if [[a, b], [b, c], [a, c]].iter().all(|ends| width(*ends).abs() > 0.01) {
                    let off = part([a, b]) + part([b, c]) - part([a, c]);
                    assert!(off.abs() < 2_f64.powi(-18), "{off}");
                }
            }
        });
    }

    /// Beyond an end a rough function goes on as it does between the end and a 1024th before.
    #[test]
    fn what_lies_beyond_an_end_has_the_slope_before_it() {
        with_integral(0.5, [0.25, 1.0, -0.5], [0.6, 0.7], |sums| {
            for (end, before, by) in [
                (0, 1 << 20, -WHOLE / 16),
                (0, 1 << 20, -WHOLE / 1000),
                (WHOLE - 1, WHOLE - (1 << 20), WHOLE / 16),
                (WHOLE - 1, WHOLE - (1 << 20), WHOLE / 1000),
            ] {
                let [at, inside, outside] = [end, before, end + by].map(|u| f64::from(sums.up_to(u).value()));
                let slope = (at - inside) * 1024.0;
                let exact = at + slope * f64::from(by.abs()) / f64::from(WHOLE);
                assert!((outside - exact).abs() < 4.0 + slope.abs() * 2_f64.powi(-20), "{outside} {exact}");
                let mean = f64::from(sums.mean_between(&sums.up_to(end), &sums.up_to(end + by), by));
                let tolerance = 64.0 + 2.0 / (f64::from(by.abs()) / f64::from(WHOLE));
                assert!((mean - (at + outside) / 2.0).abs() < tolerance, "{by}: {mean} {at} {outside}");
            }
        });
    }
}
