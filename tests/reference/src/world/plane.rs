//! The half-space `z <= 0` under the plane `z = 0`: `F = z`. Texture: `u = x`, `v = y`.

use crate::camera::Ray;
use crate::vector::Vector;
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape};
use crate::world::span::Span;

/// The generic plane, with all that is below it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane;

impl Shape for Plane {
    fn crossings(&self, ray: &Ray, _: Cone) -> Vec<Crossing> {
        Span::LINE.below(ray.origin[2], ray.direction[2], 0).crossings()
    }

    fn value(&self, p: Vector) -> f64 {
        p[2]
    }

    fn frame(&self, p: Vector, _: Part) -> Frame {
        Frame { normal: [0.0, 0.0, 1.0], uv: [p[0], p[1]], p_u: [1.0, 0.0, 0.0], p_v: [0.0, 1.0, 0.0] }
    }
}
