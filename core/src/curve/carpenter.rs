//! Carpenter's three curves: random curves through given knots, in which the midpoint of each part is
//! displaced by a random function of its parameter.
//!
//! They make mountain lines and coasts out of a few points. Each is a law for [`super::Subdivision`], with an
//! offset `o`, how rough the curve is, and the random function `R` of [`crate::num::RandomFunction`]:
//!
//! - [`LineToLine`], `h(t)`: `h_m = (h_1 + h_2) / 2 + o (t_2 - t_1) R(t_m)`;
//! - [`OneVariable`], line to plane: `p_m = (p_1 + p_2) / 2 + o R(t_m) perp(p_2 - p_1)`,
//!   `perp(x, y) = (-y, x)`;
//! - [`TwoVariable`], line to plane:
//!   `p_m = (p_1 + p_2) / 2 + o (R_2(t_m) (p_2 - p_1) + R_1(t_m) perp(p_2 - p_1))`.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, figures 2 to 4 (signs
//! that the scan lost put back) and 12. The paper derives a spectrum of `1/f` for the first; by power, not
//! amplitude, a displacement proportional to the length of the part gives `1/f^3` (Hurst exponent 1).
//! [`LineToLine::from_spectrum`] scales by `2^(-H k)` at level `k` instead, `H = (beta - 1) / 2`, so that the
//! variance falls by `2^(1 - beta)` a level (M. F. Barnsley et al., "The Science of Fractal Images", 1988,
//! section 1.4.3: midpoint displacement).

use super::dimension::dimension_of_ratio;
use super::displacement::{
    Displacement, LEVELS, Part, checked_spectrum, displaced, perpendicular, product_q28, raised,
    raised_across, undone,
};
use crate::Error;
use crate::num::formats::Q28;
use crate::num::{Deviate, Parameter, RandomFunction};
use crate::num::{Real, Unit, checked_offset, offsets, product, product_u, sqrt};
use crate::plane::Point2;

/// The graph of a function `h(t)`: `x` of a point is `t`, `y` is `h`. Size: 136 bytes.
///
/// ```
/// use attractor::curve::{LineToLine, Stop, Subdivision};
/// use attractor::num::{Real, Unit};
/// use attractor::plane::{Point2, PathElement};
///
/// const KNOTS: [Point2; 3] = [Point2::lit("0", "0"), Point2::lit("1", "0.5"), Point2::lit("2", "0")];
/// let law = LineToLine::new(const { Unit::lit("0.25") }, 7)?;
/// let curve = Subdivision::<_, 20>::new(&law, &KNOTS, Stop::Length(const { Real::lit("0.05") }))?;
/// let steps: Vec<PathElement> = curve.collect();
/// assert!(steps.len() > 40 && steps.contains(&PathElement::LineTo(KNOTS[1])));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LineToLine {
    random: RandomFunction,
    /// `o` at each level over the length of the whole.
    offsets: [Q28; LEVELS],
}

impl LineToLine {
    /// Carpenter's function: the displacement is proportional to the length of the part.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an offset outside `0 ..= 2`.
    pub fn new(offset: Unit, seed: u64) -> Result<Self, Error> {
        Self::from_spectrum(offset, Real::from_bits(3 << 24), seed)
    }

    /// A function whose power spectrum falls as `1/f^beta`: 2 is Brownian motion, 3 is [`LineToLine::new`].
    ///
    /// Result: the exponent measured over 64 seeds is within 0.15 of `beta`
    /// (`curves.rs`: `a_spectrum_falls_as_asked`).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an offset outside `0 ..= 2` or `beta` outside `1 ..= 3`.
    pub fn from_spectrum(offset: Unit, beta: Real, seed: u64) -> Result<Self, Error> {
        let decay = checked_spectrum(beta)?;
        let offsets = offsets(checked_offset(offset)?, decay);
        Ok(Self { random: RandomFunction::new(seed), offsets })
    }

    /// The knot that makes `to` the midpoint between `from` and it: the curve continued by as much again
    /// (figure 12), so that `[from, to, new]` are three knots. `at` is the parameter of `to`. The other
    /// direction: with `from` and `to` exchanged.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] when the knot leaves the range of [`Real`].
    pub fn extrapolated(&self, from: Point2, to: Point2, at: Parameter) -> Result<Point2, Error> {
        // `to` is the midpoint of a part twice as long as those between knots, one level above the first:
        // o_{-1} (t_2 - t_1) = o_0 / (o_1 / o_0) span over the whole of twice the span
        let [first, second] = self.first_offsets();
        let above = product(first, first).checked_div(i64::from(second).max(1)).unwrap_or(0);
        // at most twice the offset, 4, and the deviate below 3.31: more than 32 bits hold
        let g = (above * i64::from(self.random.at(at).to_bits()) + (1 << 27)) >> 28;
        let span = i128::from(to.x.to_bits()) - i128::from(from.x.to_bits());
        let displacement = ((span * i128::from(g) + (1 << 27)) >> 28) as i64;
        let reflected = |a: Real, m: i64| 2 * m - i64::from(a.to_bits());
        let x = reflected(from.x, i64::from(to.x.to_bits()));
        let y = reflected(from.y, i64::from(to.y.to_bits()) - displacement);
        undone([x, y])
    }

    fn first_offsets(&self) -> [Q28; 2] {
        let mut offsets = self.offsets.iter().copied();
        [offsets.next().unwrap_or(0), offsets.next().unwrap_or(0)]
    }
}

impl Displacement for LineToLine {
    fn check(&self, knots: &[Point2]) -> Result<(), Error> {
        match knots.iter().zip(knots.iter().skip(1)).position(|(a, b)| a.x >= b.x) {
            Some(index) => Err(Error::NotIncreasing { what: "knot", index: index + 1 }),
            None => Ok(()),
        }
    }

    #[inline]
    fn midpoint(&self, part: &Part) -> Point2 {
        let offset = self.offsets.get(part.level as usize).copied().unwrap_or(0);
        let g = product_q28(offset, self.random.at(part.middle).to_bits());
        let (from, to) = (part.from, part.to);
        Point2::new(raised(from.x, to.x, Real::ZERO, 0), raised(from.y, to.y, part.span, g))
    }
}

/// A curve in the plane whose midpoints lie on the perpendicular bisectors. Size: 12 bytes.
///
/// ```
/// use attractor::curve::{OneVariable, Stop, Subdivision};
/// use attractor::num::{Real, Unit};
/// use attractor::plane::{Point2, PathElement};
///
/// const KNOTS: [Point2; 3] = [Point2::lit("0", "0"), Point2::lit("1", "0.5"), Point2::lit("2", "0")];
/// let law = OneVariable::new(const { Unit::lit("0.25") }, 7)?;
/// let curve = Subdivision::<_, 20>::new(&law, &KNOTS, Stop::Length(const { Real::lit("0.05") }))?;
/// let steps: Vec<PathElement> = curve.collect();
/// assert!(steps.len() > 40 && steps.contains(&PathElement::LineTo(KNOTS[1])));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OneVariable {
    random: RandomFunction,
    offset: Q28,
}

impl OneVariable {
    /// The curve with this offset or roughness factor.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an offset outside `0 ..= 2`.
    pub fn new(offset: Unit, seed: u64) -> Result<Self, Error> {
        Ok(Self { random: RandomFunction::new(seed), offset: checked_offset(offset)? as i32 })
    }

    /// The curve that becomes longer by `ratio` at each subdivision, on average: its dimension is
    /// [`super::dimension_of_ratio`].
    ///
    /// Result: the offset with `mean of sqrt(1 + 4 o^2 R^2) = ratio`. Error: of that ratio below `2^-22`
    /// (`an_offset_gives_the_ratio_asked_for`). Cost: some 12 thousand square roots, 854 thousand Cortex-M4
    /// instructions (kernel `offset of a ratio`).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a ratio outside `1 .. 2`.
    pub fn from_ratio(ratio: Real, seed: u64) -> Result<Self, Error> {
        dimension_of_ratio(ratio)?;
        // increasing in o; a ratio of 2 takes an offset of 1.05
        let (mut low, mut high) = (0, 2 << 28);
        for _ in 0..24 {
            let middle = (low + high) / 2;
            if mean_ratio(middle) <= i64::from(ratio.to_bits()) << 4 {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(Self { random: RandomFunction::new(seed), offset: low })
    }

    /// The offset.
    pub fn offset(&self) -> Unit {
        Unit::from_bits(self.offset.saturating_mul(4))
    }

    /// The knot that makes `to` the midpoint between `from` and it: see [`LineToLine::extrapolated`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] when the knot leaves the range of [`Real`].
    pub fn extrapolated(&self, from: Point2, to: Point2, at: Parameter) -> Result<Point2, Error> {
        let g = product_q28(self.offset, self.random.at(at).to_bits());
        perpendicular(from, to, 0, g)
    }
}

/// The mean of `sqrt(1 + 4 o^2 R^2)`, 28 fractional bits.
fn mean_ratio(offset: Q28) -> i64 {
    let magnitudes = crate::num::magnitudes();
    let sum: i64 = magnitudes
        .iter()
        .map(|r| {
            // twice the product, 27 fractional bits: below 2^31
            let g = product_q28(offset, *r).unsigned_abs();
            i64::from(sqrt((1 << 54) + product_u(g, g))) * 2
        })
        .sum();
    sum.checked_div(magnitudes.len() as i64).unwrap_or(0)
}

impl Displacement for OneVariable {
    #[inline]
    fn midpoint(&self, part: &Part) -> Point2 {
        let g = product_q28(self.offset, self.random.at(part.middle).to_bits());
        raised_across(part, g)
    }
}

/// A curve in the plane whose midpoints are displaced in both directions. Size: 12 bytes.
///
/// ```
/// use attractor::curve::{TwoVariable, Stop, Subdivision};
/// use attractor::num::{Real, Unit};
/// use attractor::plane::{Point2, PathElement};
///
/// const KNOTS: [Point2; 3] = [Point2::lit("0", "0"), Point2::lit("1", "0.5"), Point2::lit("2", "0")];
/// let law = TwoVariable::new(const { Unit::lit("0.25") }, 7)?;
/// let curve = Subdivision::<_, 20>::new(&law, &KNOTS, Stop::Length(const { Real::lit("0.05") }))?;
/// let steps: Vec<PathElement> = curve.collect();
/// assert!(steps.len() > 40 && steps.contains(&PathElement::LineTo(KNOTS[1])));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TwoVariable {
    random: RandomFunction,
    offset: Q28,
}

impl TwoVariable {
    /// The curve with this offset or roughness factor.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an offset outside `0 ..= 2`.
    pub fn new(offset: Unit, seed: u64) -> Result<Self, Error> {
        Ok(Self { random: RandomFunction::new(seed), offset: checked_offset(offset)? as i32 })
    }

    /// The knot that makes `to` the midpoint between `from` and it: see [`LineToLine::extrapolated`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] when the knot leaves the range of [`Real`], [`Error::Degenerate`] when every
    /// knot or none would do.
    pub fn extrapolated(&self, from: Point2, to: Point2, at: Parameter) -> Result<Point2, Error> {
        let [along, across] = self.displacements(at);
        perpendicular(from, to, along, across)
    }

    /// `o R_2` and `o R_1`.
    #[inline]
    fn displacements(&self, t: Parameter) -> [Q28; 2] {
        [
            product_q28(self.offset, self.random.independent().at(t).to_bits()),
            product_q28(self.offset, self.random.at(t).to_bits()),
        ]
    }
}

impl Displacement for TwoVariable {
    #[inline]
    fn midpoint(&self, part: &Part) -> Point2 {
        let [along, across] = self.displacements(part.middle);
        displaced(part, Deviate::from_bits(along), Deviate::from_bits(across))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    #[test]
    fn an_offset_gives_the_ratio_asked_for() {
        let deviates: std::vec::Vec<f64> =
            crate::num::magnitudes().iter().map(|r| f64::from(*r) / 2_f64.powi(28)).collect();
        let mean = |o: f64| {
            deviates.iter().map(|r| (1.0 + 4.0 * o * o * r * r).sqrt()).sum::<f64>() / deviates.len() as f64
        };
        let mut worst = 0.0_f64;
        for bits in (1 << 24..2 << 24).step_by(1 << 18).chain([(1 << 24) + 1, (2 << 24) - 1]) {
            let ratio = Real::from_bits(bits);
            let law = OneVariable::from_ratio(ratio, 1).unwrap();
            let got = mean(f64::from(law.offset) / 2_f64.powi(28));
            worst = worst.max((got - ratio.to_num::<f64>()).abs());
        }
        assert!(worst > 2_f64.powi(-24) && worst < 2_f64.powi(-22), "{worst:e}");
    }
}
