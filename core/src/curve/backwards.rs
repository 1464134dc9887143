//! A random curve from its other end: the points of [`Subdivision`], the last one first.
//!
//! "Curves and surfaces may be generated all at once, from any boundary, or in any or all directions from
//! somewhere in the middle. The random function guarantees the repeatability of the shape regardless of the
//! direction taken." A part is halved as before, from its first point to its last, but of its halves the
//! second one is walked first. Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces",
//! 1980, "Summary".

use super::displacement::{Displacement, Part};
use super::subdivision::{End, Stop, Subdivision, half};
use crate::Error;
use crate::num::Parameter;
use crate::plane::{PathElement, Point2};

/// The path of a random curve from its last knot to its first. Size: that of [`Subdivision`].
///
/// ```
/// use attractor::curve::{Backwards, LineToLine, Stop, Subdivision, koch};
/// use attractor::num::{Parameter, Unit};
/// use attractor::plane::PathElement;
///
/// let law = LineToLine::new(const { Unit::lit("0.25") }, 7)?;
/// let stop = Stop::Parameter(Parameter::ONE / 8);
/// let point = |step| match step {
///     PathElement::MoveTo(p) | PathElement::LineTo(p) => p,
/// };
/// let there: Vec<_> = Subdivision::<_, 3>::new(&law, &koch::SEGMENT, stop)?.map(point).collect();
/// let back: Vec<_> = Backwards::<_, 3>::new(&law, &koch::SEGMENT, stop)?.map(point).collect();
/// assert!(there.iter().rev().eq(&back));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Backwards<'a, D, const LEVELS: usize> {
    curve: Subdivision<'a, D, LEVELS>,
}

impl<'a, D: Displacement, const LEVELS: usize> Backwards<'a, D, LEVELS> {
    /// The curve of [`Subdivision::new`].
    ///
    /// # Errors
    /// Those of [`Subdivision::new`].
    pub fn new(law: &'a D, knots: &'a [Point2], stop: Stop) -> Result<Self, Error> {
        let mut curve = Subdivision::new(law, knots, stop)?;
        if let Some((last, rest)) = knots.split_last() {
            (curve.from, curve.knots) = (*last, rest);
            // below 2^31 knots
            curve.at = (rest.len() as i64) << 32;
        }
        Ok(Self { curve })
    }

    /// The parameter of the last point.
    pub const fn parameter(&self) -> Parameter {
        self.curve.parameter()
    }

    /// The part that ends at the last point.
    fn first(&mut self) -> Option<End> {
        let curve = &mut self.curve;
        if curve.end.is_some() {
            return curve.end.take();
        }
        if let Some(index) = curve.waiting.checked_sub(1) {
            curve.waiting = index;
            return curve.ends.get(index).copied();
        }
        let (knot, rest) = curve.knots.split_last()?;
        curve.knots = rest;
        curve.span = curve.from.x.saturating_sub(knot.x);
        Some(End { point: *knot, level: 0 })
    }
}

impl<D: Displacement, const LEVELS: usize> Iterator for Backwards<'_, D, LEVELS> {
    type Item = PathElement;

    fn next(&mut self) -> Option<PathElement> {
        let mut end = self.first()?;
        let curve = &mut self.curve;
        while !curve.is_short(&end) {
            let part = Part {
                from: end.point,
                to: curve.from,
                middle: Parameter::from_bits(curve.at.wrapping_sub(i64::from(half(end.level)))),
                level: end.level,
                span: curve.span,
            };
            let level = end.level + 1;
            // each waiting end has a level of its own, 1 to `levels` <= LEVELS
            *curve.ends.get_mut(curve.waiting)? = End { point: end.point, level };
            curve.waiting += 1;
            end = End { point: curve.law.midpoint(&part), level };
        }
        if curve.drawing {
            curve.from = end.point;
            curve.at = curve.at.wrapping_sub(i64::from(half(end.level)) << 1);
            Some(PathElement::LineTo(end.point))
        } else {
            curve.drawing = true;
            curve.end = Some(end);
            Some(PathElement::MoveTo(curve.from))
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::curve::{Elbow, LineToLine, OneVariable, TwoVariable, coast};
    use crate::num::{Real, Unit};
    use std::vec::Vec;

    fn compare<D: Displacement>(law: &D, knots: &[Point2], stop: Stop) -> usize {
        let mut there = Subdivision::<_, 12>::new(law, knots, stop).unwrap();
        let mut back = Backwards::<_, 12>::new(law, knots, stop).unwrap();
        let (mut points, mut reversed) = (Vec::new(), Vec::new());
        while let Some(PathElement::MoveTo(p) | PathElement::LineTo(p)) = there.next() {
            points.push((p, there.parameter()));
        }
        while let Some(PathElement::MoveTo(p) | PathElement::LineTo(p)) = back.next() {
            reversed.push((p, back.parameter()));
        }
        assert!(points.iter().rev().eq(&reversed), "{} {}", points.len(), reversed.len());
        points.len()
    }

    /// All laws and all stops: the same points with the same parameters.
    #[test]
    fn from_the_other_end_a_curve_has_the_same_points() {
        let point = |x: f64, y: f64| Point2::new(Real::from_num(x), Real::from_num(y));
        let graph = [point(0.0, 0.0), point(0.7, 0.5), point(2.0, -0.25), point(2.5, 0.125)];
        let small = Real::from_num(0.02);
        let mut points = 0;
        for stop in [Stop::Parameter(Parameter::ONE / 64), Stop::Norm(small), Stop::Length(small)] {
            let offset = Unit::from_num(0.3);
            points += compare(&LineToLine::new(offset, 3).unwrap(), &graph, stop);
            points += compare(&OneVariable::new(offset, 3).unwrap(), &graph, stop);
            points += compare(&TwoVariable::new(offset, 3).unwrap(), &graph, stop);
            points += compare(&Elbow::new(offset, Real::from_num(2), 3).unwrap(), &coast::ICELAND, stop);
        }
        assert!(points > 3000, "{points}");
    }
}
