//! Points of the plane and boxes of them.

use crate::num::Real;

/// A point of the plane; `y` points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Point2 {
    /// To the right.
    pub x: Real,
    /// Upwards.
    pub y: Real,
}

impl Point2 {
    /// The point `(x, y)`.
    pub const fn new(x: Real, y: Real) -> Self {
        Self { x, y }
    }

    /// The point `(x, y)` from decimal literals, for constants:
    /// `const TIP: Point2 = Point2::lit("0.5", "0.866")`.
    ///
    /// Text that is no number, or does not fit, is an error at compile time. Call it in a `const` or in
    /// `const { }` only: see [Numbers](crate::num#numbers).
    pub const fn lit(x: &str, y: &str) -> Self {
        Self::new(Real::lit(x), Real::lit(y))
    }
}

/// An axis-parallel box in the plane, both corners included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bounds2 {
    /// Lower left corner.
    pub min: Point2,
    /// Upper right corner.
    pub max: Point2,
}
