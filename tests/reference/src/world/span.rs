//! The part of a line inside a convex shape: an interval of `t`, clipped by one half-space after another.
//!
//! Source: course unit V, section 5.7, 3 (a cube or any convex polyhedron).

use crate::camera::Ray;
use crate::vector::{Vector, dot};
use crate::world::shape::{Crossing, Part};

/// An interval of `t`, and the faces that bound it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span {
    pub(crate) enter: (f64, usize),
    pub(crate) leave: (f64, usize),
}

impl Span {
    /// The whole line.
    pub(crate) const LINE: Span = Span { enter: (f64::NEG_INFINITY, 0), leave: (f64::INFINITY, 0) };
    const EMPTY: Span = Span { enter: (f64::INFINITY, 0), leave: (f64::NEG_INFINITY, 0) };

    /// The part with `height + slope t <= 0`, which `face` bounds.
    pub(crate) fn below(self, height: f64, slope: f64, face: usize) -> Span {
        let t = -height / slope;
        if slope > 0.0 {
            Span { leave: if t < self.leave.0 { (t, face) } else { self.leave }, ..self }
        } else if slope < 0.0 {
            Span { enter: if t > self.enter.0 { (t, face) } else { self.enter }, ..self }
        } else if height > 0.0 {
            Span::EMPTY
        } else {
            self
        }
    }

    /// The part in the half-space `n . p <= d`, which `face` bounds.
    pub(crate) fn half_space(self, ray: &Ray, n: Vector, d: f64, face: usize) -> Span {
        self.below(dot(n, ray.origin) - d, dot(n, ray.direction), face)
    }

    /// The part in the cube `|x|, |y|, |z| <= 1`, with the faces -x, +x, -y, +y, -z, +z from `first` on.
    pub(crate) fn cube(mut self, ray: &Ray, first: usize) -> Span {
        for axis in 0..3 {
            let (o, d) = (ray.origin[axis], ray.direction[axis]);
            self = self.below(-o - 1.0, -d, first + 2 * axis).below(o - 1.0, d, first + 2 * axis + 1);
        }
        self
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.enter.0 >= self.leave.0
    }

    /// The ends that are not at infinity.
    pub(crate) fn crossings(&self) -> Vec<Crossing> {
        let mut crossings = Vec::new();
        if !self.is_empty() {
            for ((t, face), enters) in [(self.enter, true), (self.leave, false)] {
                if t.is_finite() {
                    crossings.push(Crossing { t, part: Part::Face(face), enters });
                }
            }
        }
        crossings
    }
}
