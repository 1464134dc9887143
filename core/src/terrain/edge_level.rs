//! How often an edge is halved: a matter of the edge alone.
//!
//! "The local resolution, or inner scale, can be made dependent on the local magnification". Where cells of
//! different resolution meet, a crack opens unless both know the same points of their common edge. So the
//! level belongs to the edge: it follows from its two ends, and from nothing of the cell on either side.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, "Summary".

use super::law::LEVELS;
use crate::num::{Coordinate, Unit, product_u};

/// A rule for the levels of edges.
pub trait EdgeLevel {
    /// How often the edge between two points is halved. It must not matter which of them is named first.
    fn level(&self, from: [Coordinate; 2], to: [Coordinate; 2]) -> u32;
}

/// The same for all.
impl EdgeLevel for u32 {
    fn level(&self, _: [Coordinate; 2], _: [Coordinate; 2]) -> u32 {
        *self
    }
}

/// By magnification: seen from an eye no part of an edge is longer than so much of its distance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Magnification {
    /// The eye: `u`, `v`, and how high it stands, a unit being the distance of two knots.
    pub eye: [Coordinate; 3],
    /// How long a part may be at distance 1.
    pub length: Unit,
    /// The most halvings.
    pub most: u32,
}

impl EdgeLevel for Magnification {
    /// The distance is that of the edge's middle by the sum of its coordinates, which is at most 1.7 times
    /// the true one and not below it.
    fn level(&self, from: [Coordinate; 2], to: [Coordinate; 2]) -> u32 {
        let [eye_u, eye_v, height] = self.eye.map(Coordinate::to_bits);
        let ([u_0, v_0], [u_1, v_1]) = (from.map(Coordinate::to_bits), to.map(Coordinate::to_bits));
        let off = |a: i32, b: i32, eye: i32| {
            let twice = i64::from(a) + i64::from(b) - 2 * i64::from(eye);
            (twice.unsigned_abs() >> 1).min(u64::from(u32::MAX >> 2))
        };
        let distance = off(u_0, u_1, eye_u) + off(v_0, v_1, eye_v) + u64::from(height.unsigned_abs() >> 2);
        let length = u64::from(u_0.abs_diff(u_1)) + u64::from(v_0.abs_diff(v_1));
        let allowed = product_u(distance as u32, self.length.to_bits().unsigned_abs()) >> 30;
        let most = self.most.min(LEVELS);
        (0..most).find(|k| length >> k <= allowed).unwrap_or(most)
    }
}
