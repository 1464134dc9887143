//! A convex polyhedron, the points with `n . p <= d` for every half-space `(n, d)`; face `i` bounds the
//! half-space `i`. `F = max((n . p - d) / |n|)`.
//!
//! Texture: coordinates in the plane of the face, from the foot of the origin; `u` along `z x n` (along x
//! where `n` is along z), `v` along `n x u`.
//!
//! Source: course unit V, section 5.7, 3.

use crate::camera::Ray;
use crate::vector::{Vector, cross, dot, normalised};
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape};
use crate::world::span::Span;

/// A convex polyhedron.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyhedron {
    /// The half-spaces, as `(n, d)`.
    pub half_spaces: Vec<(Vector, f64)>,
}

impl Shape for Polyhedron {
    fn crossings(&self, ray: &Ray, _: Cone) -> Vec<Crossing> {
        let clip = |span: Span, (face, &(n, d))| span.half_space(ray, n, d, face);
        self.half_spaces.iter().enumerate().fold(Span::LINE, clip).crossings()
    }

    fn value(&self, p: Vector) -> f64 {
        let height = |&(n, d): &(Vector, f64)| (dot(n, p) - d) / libm::sqrt(dot(n, n));
        self.half_spaces.iter().map(height).fold(f64::NEG_INFINITY, f64::max)
    }

    fn frame(&self, p: Vector, part: Part) -> Frame {
        let normal = normalised(self.half_spaces[part.face()].0);
        let (p_u, p_v) = tangents(normal);
        Frame { normal, uv: [dot(p, p_u), dot(p, p_v)], p_u, p_v }
    }
}

/// Two unit vectors at right angles to the unit vector `n` and to each other: along `z x n` (x where `n` is
/// along z), and `n` times the first.
pub(crate) fn tangents(n: Vector) -> (Vector, Vector) {
    let level = [-n[1], n[0], 0.0];
    let first = if dot(level, level) > 0.0 { normalised(level) } else { [1.0, 0.0, 0.0] };
    (first, cross(n, first))
}
