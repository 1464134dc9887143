//! How often an edge is halved: a matter of the edge alone.
//!
//! "The local resolution, or inner scale, can be made dependent on the local magnification". Where cells of
//! different resolution meet, a crack opens unless both know the same points of their common edge. So the
//! level belongs to the edge: it follows from its two ends, and from nothing of the cell on either side.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, "Summary".

use super::law::LEVELS;
use crate::num::{Coordinate, Unit};

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
            twice.unsigned_abs() >> 1
        };
        // each of the three at most 2^32
        let distance = off(u_0, u_1, eye_u) + off(v_0, v_1, eye_v) + u64::from(height.unsigned_abs());
        let length = u64::from(u_0.abs_diff(u_1)) + u64::from(v_0.abs_diff(v_1));
        // where it saturates, it allows more than an edge can have
        let allowed = distance.saturating_mul(self.length.to_bits().unsigned_abs().into()) >> 30;
        let most = self.most.min(LEVELS);
        (0..most).find(|k| length >> k <= allowed).unwrap_or(most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(eye: [f64; 3], length: f64, from: [f64; 2], to: [f64; 2]) -> u32 {
        let coordinate = |v: f64| Coordinate::from_num(v);
        let rule = Magnification { eye: eye.map(coordinate), length: Unit::from_num(length), most: 16 };
        rule.level(from.map(coordinate), to.map(coordinate))
    }

    /// Parts are no longer than allowed at 1.74 times the distance, and their double is longer than allowed
    /// at the distance: from the side, from above, and from the other end of all there is.
    #[test]
    fn the_distance_is_that_of_the_eye() {
        let edge = ([0.0, 0.0], [1.0, 0.0]);
        // straight above the middle the sum is the distance
        for (height, expected) in [(8.0, 0), (4.0, 1), (2.0, 2), (-2.0, 2), (1.0, 3), (0.25, 5)] {
            assert_eq!(level([0.5, 0.0, height], 0.125, edge.0, edge.1), expected, "{height}");
        }
        for (eye, (from, to)) in [
            ([3.0, 4.0, 5.0], edge),
            ([0.5, 0.0, 7.0], edge),
            ([-9.0, 2.0, 0.125], edge),
            ([-30000.0, -30000.0, 30000.0], ([30000.0, 30000.0], [30000.0, 30512.0])),
            ([-30000.0, 30000.0, 0.5], ([30000.0, 30000.0], [30000.0, 29488.0])),
            ([0.0, 0.0, 32767.0], ([0.0, 0.0], [512.0, 0.0])),
        ] {
            let way = [0, 1].map(|k: usize| (from[k] + to[k]) / 2.0 - eye[k]);
            let distance = (way[0] * way[0] + way[1] * way[1] + eye[2] * eye[2]).sqrt();
            for length in [1.0 / 512.0, 1.0 / 64.0, 1.0 / 16.0] {
                let level = level(eye, length, from, to);
                let part = ((to[0] - from[0]).abs() + (to[1] - from[1]).abs()) / f64::from(1 << level);
                assert!(part <= length * distance * 1.74, "{eye:?} {length}: {part}");
                assert!(level == 0 || 2.0 * part >= length * distance * 0.999, "{eye:?} {length}: {part}");
            }
        }
    }
}
