//! A random curve through knots, as a path: each part between two knots is halved until it is short, depth
//! first with a bounded stack.
//!
//! Where a midpoint lies is the business of a law ([`Displacement`]); when a part is short enough to be drawn
//! as a straight line, that of a [`Stop`].
//!
//! The knots have the parameters 0, 1, 2 ..; the point in the middle of a part depends on that part alone. So
//! any piece of a curve, at any resolution, consists of exactly the points that the whole has there. Source:
//! course unit V, section 5.6.1 (`fract`); L. C. Carpenter, "Computer rendering of fractal curves and
//! surfaces", 1980.

use super::displacement::{Displacement, LEVELS as MAX_LEVELS, Part};
use crate::Error;
use crate::num::Parameter;
use crate::num::formats::{Q32, UQ24, UQ32, UQ48};
use crate::num::{Real, Wide};
use crate::plane::{PathElement, Point2};

/// When a part is short enough to be drawn as a straight line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Stop {
    /// When the parameter grows by no more than this along it: all parts are halved equally often.
    Parameter(Parameter),
    /// When `|x_1 - x_2| + |y_1 - y_2|`, which Carpenter calls the infinity norm, is less than this, or it
    /// has been halved as often as there are levels.
    Norm(Real),
    /// When the distance of its ends is less than this, or it has been halved as often as there are levels.
    Length(Real),
}

/// Where a part ends, and how often it has been halved.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct End {
    pub(super) point: Point2,
    pub(super) level: u32,
}

/// The path of a random curve through knots, with at most `LEVELS <= 31` halvings between two. Size on a
/// 32-bit machine: 12 bytes a level, and 88.
///
/// ```
/// use attractor::curve::{Elbow, Stop, Subdivision};
/// use attractor::draw::Stroke;
/// use attractor::num::{Real, Unit};
/// use attractor::plane::{Bounds2, Point2, Window};
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
///
/// const KNOTS: [Point2; 3] = [Point2::lit("0", "0"), Point2::lit("1", "0.5"), Point2::lit("2", "0")];
/// const BOUNDS: Bounds2 = Bounds2 { min: Point2::lit("-0.1", "-0.05"), max: Point2::lit("2.1", "0.55") };
/// let window = Window::stretch(BOUNDS, Size::new(44, 12))?;
/// let law = Elbow::new(const { Unit::lit("0.2") }, const { Real::lit("2.5") }, 7)?;
/// // down to a pixel: 0.05
/// let coast = Subdivision::<_, 20>::new(&law, &KNOTS, Stop::Length(const { Real::lit("0.05") }))?;
/// let mut display = MockDisplay::new();
/// display.set_allow_overdraw(true);
/// Stroke::new(coast, window, BinaryColor::On).draw(&mut display).unwrap();
/// display.assert_pattern(&[
///     "                       ##                   ",
///     "                    ######                  ",
///     "                     #  #                   ",
///     "                    ##  #                   ",
///     "             #     ##   # #  # #            ",
///     "           ## # #####   ######### #         ",
///     "           #  ##           #   #######      ",
///     "    ### ####                   # #    #     ",
///     "    #  ####                       #   #     ",
///     "    #                                 #     ",
///     "  # #                                 ## #  ",
///     "  ##                                    ##  ",
/// ]);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Subdivision<'a, D, const LEVELS: usize> {
    pub(super) law: &'a D,
    /// Knots that are not reached yet.
    pub(super) knots: &'a [Point2],
    /// The last point.
    pub(super) from: Point2,
    /// Its parameter.
    pub(super) at: Q32,
    /// The ends of the parts that wait, each beginning where the one before it ends; the last of them is
    /// next.
    pub(super) ends: [End; LEVELS],
    pub(super) waiting: usize,
    /// The end of the first part, between the step to its beginning and the line along it.
    pub(super) end: Option<End>,
    pub(super) span: Real,
    levels: u32,
    /// The norm or the length below which a part is short; 0 for none.
    limit: UQ24,
    /// The square of a length, 0 for a norm.
    square: UQ48,
    /// The piece of the curve that is wanted, if not all of it.
    piece: [Q32; 2],
    partial: bool,
    pub(super) drawing: bool,
}

impl<'a, D: Displacement, const LEVELS: usize> Subdivision<'a, D, LEVELS> {
    /// The curve through `knots` that `law` describes; closed when the last knot is the first.
    ///
    /// Result: all points in order; a point beyond the range of [`Real`] saturates. Cost of a subdivision,
    /// with the point that it yields: 140 Cortex-M4 instructions (kernel `elbow`) for an elbow that stops by
    /// parameter, 173 (kernel `elbow by length`) by length; 174 (kernel `one variable`) for one variable by
    /// norm, a third more for two; 129 (kernel `line to line`) for a function that stops by parameter.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than two knots, [`Error::OutOfRange`] for neighbours that are 128 or more
    /// apart in a coordinate and for a limit of 0 or less, [`Error::Capacity`] when the parameter asks for
    /// more than `LEVELS` or 31 halvings; what the law says against the knots.
    pub fn new(law: &'a D, knots: &'a [Point2], stop: Stop) -> Result<Self, Error> {
        let Some((first, rest)) = knots.split_first() else {
            return Err(Error::TooFew { what: "knots", given: 0, at_least: 2 });
        };
        if rest.is_empty() {
            return Err(Error::TooFew { what: "knots", given: 1, at_least: 2 });
        }
        law.check(knots)?;
        // the laws' differences have the format of coordinates
        for (index, (a, b)) in knots.iter().zip(rest).enumerate() {
            let (x, y) = (a.x.to_bits().abs_diff(b.x.to_bits()), a.y.to_bits().abs_diff(b.y.to_bits()));
            if x.max(y) > Real::MAX.to_bits().unsigned_abs() {
                return Err(Error::OutOfRange {
                    what: "extent of the part behind knot",
                    index: Some(index),
                    value: Wide::from_bits(i64::from(x.max(y)) << 24),
                    min: Wide::ZERO,
                    max: Wide::from(Real::MAX),
                });
            }
        }
        let capacity = LEVELS.min(MAX_LEVELS - 1);
        let mut curve = Self {
            law,
            knots: rest,
            from: *first,
            at: 0,
            ends: [End::default(); LEVELS],
            waiting: 0,
            end: None,
            span: Real::ZERO,
            levels: capacity as u32,
            limit: 0,
            square: 0,
            piece: [i64::MIN, i64::MAX],
            partial: false,
            drawing: false,
        };
        match stop {
            Stop::Parameter(e) => {
                let bits = positive("parameter step", e.to_bits(), Wide::saturating_from_num(e))?;
                // the least k with 2^-k <= e
                let levels = (1_u64 << 32).div_ceil(bits).next_power_of_two().trailing_zeros();
                if levels > curve.levels {
                    return Err(Error::Capacity { what: "levels", needed: levels as usize, capacity });
                }
                curve.levels = levels;
            }
            Stop::Norm(e) => curve.limit = positive("norm", e.to_bits().into(), e.into())? as u32,
            Stop::Length(e) => {
                let length = positive("length", e.to_bits().into(), e.into())?;
                curve.limit = length as u32;
                curve.square = length * length;
            }
        }
        Ok(curve)
    }

    /// Only the piece between two parameters: the parts that lie in it at least partly. The points are those
    /// of the whole curve.
    pub const fn between(mut self, first: Parameter, last: Parameter) -> Self {
        self.piece = [first.to_bits(), last.to_bits()];
        self.partial = true;
        self
    }

    /// The parameter of the last point.
    pub const fn parameter(&self) -> Parameter {
        Parameter::from_bits(self.at)
    }

    #[inline(always)]
    pub(super) fn is_short(&self, end: &End) -> bool {
        if end.level >= self.levels {
            return true;
        }
        let limit = self.limit;
        if limit == 0 {
            return false;
        }
        let (from, to) = (self.from, end.point);
        let dx = from.x.to_bits().abs_diff(to.x.to_bits());
        let dy = from.y.to_bits().abs_diff(to.y.to_bits());
        // both below 2^31 from here on: neither the sum nor that of the squares overflows
        if dx >= limit || dy >= limit {
            return false;
        }
        if self.square > 0 {
            u64::from(dx) * u64::from(dx) + u64::from(dy) * u64::from(dy) < self.square
        } else {
            dx + dy < limit
        }
    }

    /// The part that ends at `end` is done with.
    #[inline(always)]
    fn advance(&mut self, end: &End) {
        self.from = end.point;
        self.at = self.at.wrapping_add(i64::from(half(end.level)) << 1);
    }

    /// The part that begins at the last point.
    #[inline(always)]
    fn first(&mut self) -> Option<End> {
        if self.end.is_some() {
            return self.end.take();
        }
        if let Some(index) = self.waiting.checked_sub(1) {
            self.waiting = index;
            return self.ends.get(index).copied();
        }
        let (knot, rest) = self.knots.split_first()?;
        self.knots = rest;
        self.span = knot.x.saturating_sub(self.from.x);
        Some(End { point: *knot, level: 0 })
    }

    /// Leaves out what lies before the piece that is wanted; none behind it.
    #[cold]
    #[inline(never)]
    fn wanted(&mut self, mut end: End) -> Option<End> {
        let [first, last] = self.piece;
        while self.at.wrapping_add(i64::from(half(end.level)) << 1) <= first {
            self.advance(&end);
            end = self.first()?;
        }
        (self.at < last).then_some(end)
    }
}

/// Half the parameter of a part that has been halved `level <= 31` times.
#[inline(always)]
pub(super) const fn half(level: u32) -> UQ32 {
    (1_u32 << 31) >> (level & 31)
}

fn positive(what: &'static str, bits: i64, value: Wide) -> Result<u64, Error> {
    if bits <= 0 {
        return Err(Error::OutOfRange { what, index: None, value, min: Wide::DELTA, max: Wide::MAX });
    }
    Ok(bits.unsigned_abs())
}

impl<D: Displacement, const LEVELS: usize> Iterator for Subdivision<'_, D, LEVELS> {
    type Item = PathElement;

    #[inline]
    fn next(&mut self) -> Option<PathElement> {
        let mut end = self.first()?;
        loop {
            if self.partial {
                end = self.wanted(end)?;
            }
            if self.is_short(&end) {
                break;
            }
            let part = Part {
                from: self.from,
                to: end.point,
                middle: Parameter::from_bits(self.at.wrapping_add(i64::from(half(end.level)))),
                // at most 31: a Cortex-M0 has that number at hand for the parameter, and need not compare
                level: if cfg!(no_long_product) { end.level & 31 } else { end.level },
                span: self.span,
            };
            let level = end.level + 1;
            // each waiting end has a level of its own, 1 to `levels` <= LEVELS
            // counted before it is there, or after on a machine of few registers: each spares a load
            let (waiting, after) = (self.waiting, cfg!(no_long_product));
            self.waiting = waiting + usize::from(!after);
            *self.ends.get_mut(waiting)? = End { point: end.point, level };
            if after {
                self.waiting = waiting + 1;
            }
            end = End { point: self.law.midpoint(&part), level };
        }
        if self.drawing {
            self.advance(&end);
            Some(PathElement::LineTo(end.point))
        } else {
            self.drawing = true;
            self.end = Some(end);
            Some(PathElement::MoveTo(self.from))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::displaced;
    use crate::curve::koch;
    use crate::num::Deviate;

    /// A law of one's own: always to the left by a quarter of the length.
    struct Left;

    impl Displacement for Left {
        fn midpoint(&self, part: &Part) -> Point2 {
            displaced(part, Deviate::ZERO, Deviate::from_num(0.25))
        }
    }

    #[test]
    fn a_law_of_your_own_needs_one_function() {
        let quarter = Stop::Parameter(Parameter::from_num(0.25));
        let points: std::vec::Vec<PathElement> =
            Subdivision::<_, 2>::new(&Left, &koch::SEGMENT, quarter).unwrap().collect();
        let at = |x: f64, y: f64| Point2::new(Real::from_num(x), Real::from_num(y));
        let expected = [at(0.0, 0.0), at(0.1875, 0.25), at(0.5, 0.25), at(0.8125, 0.25), at(1.0, 0.0)];
        assert!(points.iter().skip(1).eq(&expected.map(PathElement::LineTo)[1..]));
        assert_eq!(points.first(), Some(&PathElement::MoveTo(expected[0])));
    }

    #[test]
    fn the_parameter_follows_the_pen() {
        let eighth = Stop::Parameter(Parameter::from_num(0.125));
        let mut curve = Subdivision::<_, 3>::new(&Left, &koch::SEGMENT, eighth).unwrap();
        for k in 0..=8 {
            assert!(curve.next().is_some());
            assert_eq!(curve.parameter(), Parameter::from_num(0.125) * k);
        }
        assert!(curve.next().is_none() && curve.next().is_none());
    }

    #[test]
    fn sixteen_levels_take_at_most_400_bytes() {
        assert!(size_of::<Subdivision<'_, Left, 16>>() <= 400, "{}", size_of::<Subdivision<'_, Left, 16>>());
    }
}
