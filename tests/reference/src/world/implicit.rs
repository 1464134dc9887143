//! A user's implicit surface inside the generic cube: the points of the cube with `F(p) <= 0`, for a function
//! that changes by at most `L` times the distance.
//!
//! Where `|F|` in the middle of a piece of the ray is larger than `L` times half of its length, the piece
//! holds no root; any other is halved, down to a piece of 2^-24, which has a root if the signs at its ends
//! differ: two roots that are closer are none.
//!
//! Faces: 0 is the surface itself, 1 to 6 those of the cube where they cut it off. Texture on face 0:
//! coordinates in the tangent plane, from the foot of the origin, as of a polyhedron's face; on the others
//! those of the cube.
//!
//! Source: course unit V, section 5.7, 4 ("we have to search numerically"); D. Kalra and A. Barr, "Guaranteed
//! ray intersections with implicit surfaces", 1989 (the Lipschitz bound).

use crate::camera::Ray;
use crate::vector::{Vector, dot, normalised};
use crate::world::cube::{Cube, face_frame};
use crate::world::polyhedron::tangents;
use crate::world::root::bracketed;
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape};
use crate::world::span::Span;
use core::fmt::{Debug, Formatter, Result};

/// The shortest piece of a ray, in units of space.
const SHORTEST: f64 = 1.0 / 16_777_216.0;

/// An implicit surface.
pub struct Implicit {
    /// `F`, positive outside.
    pub function: Box<dyn Fn(Vector) -> f64>,
    /// Its gradient.
    pub gradient: Box<dyn Fn(Vector) -> Vector>,
    /// `L`: no gradient in the cube is longer.
    pub lipschitz: f64,
}

impl Debug for Implicit {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.debug_struct("Implicit").field("lipschitz", &self.lipschitz).finish_non_exhaustive()
    }
}

impl Implicit {
    fn roots(&self, ray: &Ray, (low, high): (f64, f64), speed: f64, roots: &mut Vec<f64>) {
        let value = |t: f64| (self.function)(ray.at(t));
        let (middle, half) = (low + (high - low) / 2.0, (high - low) / 2.0 * speed);
        if value(middle).abs() > self.lipschitz * half {
            return;
        }
        if half * 2.0 <= SHORTEST {
            if (value(low) < 0.0) != (value(high) < 0.0) {
                roots.push(bracketed(value, low, high));
            }
            return;
        }
        self.roots(ray, (low, middle), speed, roots);
        self.roots(ray, (middle, high), speed, roots);
    }
}

impl Shape for Implicit {
    fn crossings(&self, ray: &Ray, _: Cone) -> Vec<Crossing> {
        let span = Span::LINE.cube(ray, 1);
        if span.is_empty() {
            return Vec::new();
        }
        let inside = |t: f64| (self.function)(ray.at(t)) < 0.0;
        let mut roots = Vec::new();
        let speed = libm::sqrt(dot(ray.direction, ray.direction));
        self.roots(ray, (span.enter.0, span.leave.0), speed, &mut roots);
        let mut all: Vec<(f64, usize)> = roots.into_iter().map(|t| (t, 0)).collect();
        if inside(span.enter.0) {
            all.insert(0, span.enter);
        }
        if inside(span.leave.0) {
            all.push(span.leave);
        }
        let crossing = |(k, (t, face)): (usize, (f64, usize))| Crossing {
            t,
            part: Part::Face(face),
            enters: k % 2 == 0,
        };
        all.into_iter().enumerate().map(crossing).collect()
    }

    fn value(&self, p: Vector) -> f64 {
        (self.function)(p).max(Cube.value(p))
    }

    fn frame(&self, p: Vector, part: Part) -> Frame {
        match part.face() {
            0 => {
                let normal = normalised((self.gradient)(p));
                let (p_u, p_v) = tangents(normal);
                Frame { normal, uv: [dot(p, p_u), dot(p, p_v)], p_u, p_v }
            }
            face => face_frame(p, face - 1),
        }
    }
}
