//! The Koch curve and the snowflake: generator, bases to draw them on, exact lengths and areas.
//!
//! `K_{n+1}` replaces the middle third of each segment of `K_n` by the other two sides of an equilateral
//! triangle: turns of 60, -120 and 60 degrees. Length of `K_n`: `(4/3)^n`. The snowflake `S_n` is made of
//! three of them: perimeter `3 (4/3)^n`; each order adds `3 4^(n-1)` triangles of `9^-n` of the first, so
//! that its area is `8/5 - 3/5 (4/9)^n` of the triangle.
//!
//! Source: H. von Koch, "Sur une courbe continue sans tangente", 1904; course unit V, sections 5.1.1 and
//! 5.1.2.

use super::generator::{Generator, ONE_Q30};
use crate::num::formats::Q30;
use crate::num::{Angle, Real, Wide, sin_cos};
use crate::plane::Point2;

/// 1/3, rounded.
const THIRD: Q30 = 357_913_941;
/// `sqrt(3) / 6`, rounded.
const HEIGHT: Q30 = 309_962_566;

/// The generator of the Koch curve, a bump to the left.
pub const GENERATOR: Generator<4> = Generator::from_vertices(
    &[[0, 0], [THIRD, 0], [ONE_Q30 / 2, HEIGHT], [2 * THIRD + 1, 0], [ONE_Q30, 0]],
    &[THIRD as u32 + 1; 4],
);

/// The base of the Koch curve: from `(0, 0)` to `(1, 0)`.
pub const SEGMENT: [Point2; 2] = [Point2::new(Real::ZERO, Real::ZERO), Point2::new(Real::ONE, Real::ZERO)];

/// The base of a snowflake: an equilateral triangle with a corner at the top, closed, walked clockwise, so
/// that all bumps point outwards.
///
/// Domain: all; corners saturate. Error: half a unit and below `2^-27` of the radius
/// (`corners_lie_on_the_circle`).
pub fn triangle(centre: Point2, radius: Real) -> [Point2; 4] {
    [0_u64, 1, 2, 0].map(|third| {
        // a quarter turn, and clockwise from there
        let angle = Angle::from_bits((1_u32 << 30).wrapping_sub(((third << 32) / 3) as u32));
        let (sin, cos) = sin_cos(angle);
        let along = |from: Real, factor: crate::num::Unit| {
            let bits = (i64::from(radius.to_bits()) * i64::from(factor.to_bits()) + (1 << 29)) >> 30;
            // |bits| <= 2^31: a sum of two fits 64 bits
            let sum = i64::from(from.to_bits()) + bits;
            Real::from_bits(sum.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
        };
        Point2::new(along(centre.x, cos), along(centre.y, sin))
    })
}

/// A fraction, not necessarily in lowest terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Fraction {
    /// Above the line.
    pub numerator: u64,
    /// Below it, never 0.
    pub denominator: u64,
}

impl Fraction {
    /// Its value, saturated. Error: below `2^-48`, downwards
    /// (`a_fraction_is_rounded_down`).
    pub fn to_wide(self) -> Wide {
        let quotient = (u128::from(self.numerator) << 48).checked_div(u128::from(self.denominator));
        Wide::from_bits(quotient.and_then(|q| i64::try_from(q).ok()).unwrap_or(i64::MAX))
    }
}

/// The length of the Koch curve of this order on a base of length 1, `(4/3)^n`; none where it does not fit,
/// from order 32 on. Exact.
///
/// ```
/// use attractor::curve::koch;
/// let length = koch::length(2).unwrap();
/// assert_eq!((length.numerator, length.denominator), (16, 9));
/// assert!(koch::snowflake_area(15).unwrap().to_wide().abs_diff(attractor::num::Wide::from_num(1.6)) < 1e-5);
/// ```
pub fn length(order: u32) -> Option<Fraction> {
    Some(Fraction { numerator: 4_u64.checked_pow(order)?, denominator: 3_u64.checked_pow(order)? })
}

/// The perimeter of the snowflake of this order on a triangle of side 1, `3 (4/3)^n`; none from order 32 on.
/// Exact.
pub fn snowflake_perimeter(order: u32) -> Option<Fraction> {
    let Fraction { numerator, denominator } = length(order)?;
    Some(Fraction { numerator: numerator.checked_mul(3)?, denominator })
}

/// The area of the snowflake of this order over that of its triangle, `8/5 - 3/5 (4/9)^n`; none from order 20
/// on. Exact.
pub fn snowflake_area(order: u32) -> Option<Fraction> {
    let nines = 9_u64.checked_pow(order)?;
    let fours = 4_u64.checked_pow(order)?;
    // 3 4^n <= 8 9^n
    Some(Fraction {
        numerator: nines.checked_mul(8)?.checked_sub(fours.checked_mul(3)?)?,
        denominator: nines.checked_mul(5)?,
    })
}
