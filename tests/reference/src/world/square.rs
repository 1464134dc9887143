//! The square `|x|, |y| <= 1` in the plane `z = 0`, open, its upper side towards +z: `F = z`. Texture:
//! `u = (x + 1) / 2`, `v = (y + 1) / 2`.
//!
//! Source: course unit V, section 5.7, 1.

use crate::camera::Ray;
use crate::vector::Vector;
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape};

/// The generic square.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Square;

impl Shape for Square {
    fn crossings(&self, ray: &Ray, _: Cone) -> Vec<Crossing> {
        if ray.direction[2] == 0.0 {
            return Vec::new();
        }
        let t = -ray.origin[2] / ray.direction[2];
        let p = ray.at(t);
        if p[0].abs() > 1.0 || p[1].abs() > 1.0 {
            return Vec::new();
        }
        vec![Crossing { t, part: Part::Face(0), enters: ray.direction[2] < 0.0 }]
    }

    fn value(&self, p: Vector) -> f64 {
        p[2]
    }

    fn frame(&self, p: Vector, _: Part) -> Frame {
        Frame {
            normal: [0.0, 0.0, 1.0],
            uv: [(p[0] + 1.0) / 2.0, (p[1] + 1.0) / 2.0],
            p_u: [2.0, 0.0, 0.0],
            p_v: [0.0, 2.0, 0.0],
        }
    }

    fn is_open(&self) -> bool {
        true
    }
}
