//! The cube `|x|, |y|, |z| <= 1`: `F = max(|x|, |y|, |z|) - 1`. Its faces are -x, +x, -y, +y, -z, +z, from 0.
//!
//! Texture: on each face `v` along z, on those across z along y, and `u` to the right as seen from outside.
//!
//! Source: course unit V, section 5.7, 3.

use crate::camera::Ray;
use crate::vector::Vector;
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape};
use crate::world::span::Span;

/// The generic cube.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cube;

impl Shape for Cube {
    fn crossings(&self, ray: &Ray, _: Cone) -> Vec<Crossing> {
        Span::LINE.cube(ray, 0).crossings()
    }

    fn value(&self, p: Vector) -> f64 {
        p[0].abs().max(p[1].abs()).max(p[2].abs()) - 1.0
    }

    fn frame(&self, p: Vector, part: Part) -> Frame {
        face_frame(p, part.face())
    }
}

/// How face `face` of the cube lies at `p`.
pub(crate) fn face_frame(p: Vector, face: usize) -> Frame {
    let axis = face / 2;
    let (first, second) = [(1, 2), (0, 2), (0, 1)][axis];
    // to the right is along the axis on +x, -y and +z, against it on the others
    let right = if matches!(face, 1 | 2 | 5) { 1.0 } else { -1.0 };
    let unit = |axis: usize, length: f64| {
        let mut vector = [0.0; 3];
        vector[axis] = length;
        vector
    };
    Frame {
        normal: unit(axis, if face & 1 == 0 { -1.0 } else { 1.0 }),
        uv: [(right * p[first] + 1.0) / 2.0, (p[second] + 1.0) / 2.0],
        p_u: unit(first, 2.0 * right),
        p_v: unit(second, 2.0),
    }
}
