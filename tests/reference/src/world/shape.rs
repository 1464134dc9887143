//! What every shape answers: where a line crosses it, on which side a point lies, and how its surface lies at
//! a crossing.
//!
//! A shape is given in generic coordinates. Its inside-outside function `F` is positive outside, 0 on the
//! surface and negative inside, so that `d(t) = F(S + c t)` changes its sign where a ray crosses.
//!
//! Source: course unit V, section 5.7, 4; CONTRIBUTING.md, "The picture of a world, defined".

use crate::camera::Ray;
use crate::vector::Vector;
use core::fmt::Debug;

/// The part of a shape's surface that is crossed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A face, as the shape numbers them.
    Face(usize),
    /// A leaf of a height field.
    Cell {
        /// Its level in both pyramids.
        level: usize,
        /// The cell of `f`.
        i: usize,
        /// The cell of `g`.
        j: usize,
    },
}

impl Part {
    /// The number of the face; a height field has one.
    pub fn face(&self) -> usize {
        match *self {
            Part::Face(face) => face,
            Part::Cell { .. } => 0,
        }
    }
}

/// A point at which a ray crosses a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Where, on the ray.
    pub t: f64,
    /// What is crossed.
    pub part: Part,
    /// Whether the ray is inside behind it; of an open shape: below, the normal being above.
    pub enters: bool,
}

/// The width of a ray's cone, `width + growth t`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// Where the ray starts.
    pub width: f64,
    /// How much it grows as `t` grows by 1.
    pub growth: f64,
}

impl Cone {
    /// A ray without a width.
    pub const THIN: Cone = Cone { width: 0.0, growth: 0.0 };

    /// The width at `t`.
    pub fn at(&self, t: f64) -> f64 {
        self.width + self.growth * t
    }
}

/// How a surface lies at one of its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The outward normal, of an open shape the upper one; not zero, not of unit length.
    pub normal: Vector,
    /// The texture coordinates.
    pub uv: [f64; 2],
    /// `P_u`, how the point moves with `u`.
    pub p_u: Vector,
    /// `P_v`.
    pub p_v: Vector,
}

/// A shape in generic coordinates.
pub trait Shape: Debug {
    /// Every crossing of the whole line, before and behind the ray's start, by growing `t`; entering and
    /// leaving alternate. A line that only touches has none. (A height field: those with `t >= 0`; it alone
    /// asks for the cone.)
    fn crossings(&self, ray: &Ray, cone: Cone) -> Vec<Crossing>;

    /// The inside-outside function; of an open shape: the height above it.
    fn value(&self, p: Vector) -> f64;

    /// How the surface lies at its point `p` of the given part.
    fn frame(&self, p: Vector, part: Part) -> Frame;

    /// Whether the shape bounds nothing: square, polygon, height field.
    fn is_open(&self) -> bool {
        false
    }
}

/// `angle / 2 pi`, turned into `[0, 1)`.
pub(crate) fn turns(angle: f64) -> f64 {
    let part = angle / core::f64::consts::TAU;
    let part = if part < 0.0 { part + 1.0 } else { part };
    if part >= 1.0 { 0.0 } else { part }
}
