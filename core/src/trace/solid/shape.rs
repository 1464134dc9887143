//! A shape in its generic coordinates, where it is about as large as 1.
//!
//! A sphere knows only the sphere of radius 1 round the origin, a torus only the one round the z axis; an
//! affine map brings rays to it and normals back. A ray that reaches a shape starts near it: it was moved
//! along itself, and its direction made about as long as 1. So every shape computes with numbers of ordinary
//! size, and 28 fractional bits serve a shape of any size at any distance.
//!
//! Source: the course unit V, section 5.7 ("generic" objects).

use core::ops::ControlFlow;

use super::super::surface::Chart;
use crate::num::{Near, Real, Vec3, Wide};

/// A ray `origin + s direction` near a shape, in generic coordinates, `s` of either sign.
///
/// The origin is within ±4, the greatest component of the direction in `[1, 2)` in magnitude.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NearRay {
    /// A place on the ray near the shape.
    pub origin: Vec3<Near>,
    /// Where it goes.
    pub direction: Vec3<Near>,
}

/// The corners of a box, by whole numbers.
pub(super) const fn corners(low: [i32; 3], high: [i32; 3]) -> [Vec3<Near>; 2] {
    const fn corner([x, y, z]: [i32; 3]) -> Vec3<Near> {
        Vec3::new(Near::from_bits(x << 28), Near::from_bits(y << 28), Near::from_bits(z << 28))
    }
    [corner(low), corner(high)]
}

/// Where a ray crosses a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct NearCrossing {
    /// The ray's parameter, of either sign.
    pub s: Near,
    /// Whether the ray goes against the outward normal (of an open shape: of its upper side).
    pub enters: bool,
    /// Which face it is, from 0 on.
    pub face: u8,
}

/// A shape in generic coordinates. What implements it takes part in everything: compounds, shadows,
/// refraction, textures.
pub trait Shape {
    /// The box that holds the shape: least and greatest coordinates, each within ±2. None for a shape
    /// without limits: the half-space `z <= 0`.
    fn bounds(&self) -> Option<[Vec3<Near>; 2]>;

    /// The radius of a ball round the middle of the bounds that holds the shape, if it is less than that of
    /// the ball round the bounds.
    fn radius(&self) -> Option<Near> {
        None
    }

    /// Whether it is the sphere of radius 1 round the origin: as long as a map keeps it round, rays need not
    /// be brought to it.
    fn is_round(&self) -> bool {
        false
    }

    /// Whether it encloses a part of space. An open one has an upper side instead, that of its normal.
    fn is_closed(&self) -> bool {
        true
    }

    /// The most crossings that a ray can have.
    fn most_crossings(&self) -> u32 {
        2
    }

    /// How many faces it has, each of which may have a material of its own.
    fn faces(&self) -> u8 {
        1
    }

    /// How wrong the parameter of a crossing is at most, away from tangency.
    fn error(&self) -> Near;

    /// Hands over the crossings with `s >= from` in the order of `s`, until `found` breaks off. Entries and
    /// exits of a closed shape alternate; a ray that touches it has none.
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>);

    /// The inside-outside function: above 0 outside, 0 on the shape, below 0 inside; for an open shape, above
    /// 0 over its upper side.
    fn value(&self, place: Vec3) -> Wide;

    /// Whether a place is outside by `2^-12` and more. False in case of doubt.
    fn is_clear_of(&self, _: Vec3) -> bool {
        false
    }

    /// The outward normal at a place of the shape, of any length that is not 0.
    fn normal(&self, place: Vec3<Near>, face: u8) -> Vec3<Near>;

    /// The texture coordinates at a place of the shape, and how it moves with them, in generic coordinates.
    fn chart(&self, place: Vec3<Real>, face: u8) -> Chart;
}
