//! The tapered cylinder about the z axis, of radius 1 at `z = 0` and `S` at `z = 1`:
//! `F = x^2 + y^2 - (1 + (S - 1) z)^2` for `0 < z < 1`, with base and cap. `S = 1` is the cylinder, `S = 0`
//! the cone. It is convex: a line is inside it over one interval.
//!
//! Faces: 0 the side, 1 the base, 2 the cap. Texture: on the side `u` is the longitude over `2 pi`, `v = z`;
//! on the cap `u = (1 + x) / 2`, on the base `u = (1 - x) / 2`, on both `v = (1 + y) / 2`.
//!
//! Source: course unit V, section 5.7, 2 (which prints the base radius 1 as L).

use crate::camera::Ray;
use crate::vector::Vector;
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape, turns};
use crate::world::span::Span;
use core::f64::consts::TAU;

const SIDE: usize = 0;
const BASE: usize = 1;
const CAP: usize = 2;

/// The generic tapered cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaperedCylinder {
    /// The radius `S` of the cap, 0 or more.
    pub cap: f64,
}

impl TaperedCylinder {
    fn radius(&self, z: f64) -> f64 {
        1.0 + (self.cap - 1.0) * z
    }

    fn wall(&self, p: Vector) -> f64 {
        let r = self.radius(p[2]);
        p[0] * p[0] + p[1] * p[1] - r * r
    }
}

impl Shape for TaperedCylinder {
    fn crossings(&self, ray: &Ray, _: Cone) -> Vec<Crossing> {
        let slab = Span::LINE.below(-ray.origin[2], -ray.direction[2], BASE).below(
            ray.origin[2] - 1.0,
            ray.direction[2],
            CAP,
        );
        if slab.is_empty() {
            return Vec::new();
        }
        // The wall along the ray, a s^2 + 2 b s + c, with s from a point near the slab: c stays small.
        let (start, end) = (slab.enter.0, slab.leave.0);
        let d = ray.direction;
        let flat = d[0] * d[0] + d[1] * d[1];
        let near = -(ray.origin[0] * d[0] + ray.origin[1] * d[1]) / flat;
        let shift = if flat > 0.0 { near.clamp(start, end) } else { 0.0 };
        let o = ray.at(shift);
        let (r, r_slope) = (self.radius(o[2]), (self.cap - 1.0) * d[2]);
        let a = flat - r_slope * r_slope;
        let b = o[0] * d[0] + o[1] * d[1] - r * r_slope;
        let c = self.wall(o);
        let discriminant = b * b - a * c;
        let whole = (f64::NEG_INFINITY, f64::INFINITY);
        // The parts of the line inside the wall or its other nappe.
        let inside: [Option<(f64, f64)>; 2] = if discriminant <= 0.0 || (a == 0.0 && b == 0.0) {
            [(a < 0.0 || (a == 0.0 && c <= 0.0)).then_some(whole), None]
        } else {
            // q / a and c / q are the two roots, neither subtracting what is nearly equal.
            let root = libm::sqrt(discriminant);
            let q = if b < 0.0 { root - b } else { -root - b };
            let (s, t) = (q / a, c / q);
            if a > 0.0 {
                [Some((s.min(t), s.max(t))), None]
            } else if a < 0.0 {
                [Some((whole.0, s.min(t))), Some((s.max(t), whole.1))]
            } else if b > 0.0 {
                [Some((whole.0, t)), None]
            } else {
                [Some((t, whole.1)), None]
            }
        };
        // Between base and cap there is no other nappe, so at most one part is longer than a point.
        let clip = |(enter, leave): (f64, f64)| {
            let (enter, leave) = (enter + shift, leave + shift);
            let enter = if enter > start { (enter, SIDE) } else { slab.enter };
            let leave = if leave < end { (leave, SIDE) } else { slab.leave };
            Span { enter, leave }
        };
        let longest = |a: Span, b: Span| if b.leave.0 - b.enter.0 > a.leave.0 - a.enter.0 { b } else { a };
        let span = inside.into_iter().flatten().map(clip).reduce(longest);
        span.map_or(Vec::new(), |span| span.crossings())
    }

    fn value(&self, p: Vector) -> f64 {
        self.wall(p).max(-p[2]).max(p[2] - 1.0)
    }

    fn frame(&self, p: Vector, part: Part) -> Frame {
        // seen from outside, u goes to the right where v goes up
        let disc = |up: f64| Frame {
            normal: [0.0, 0.0, up],
            uv: [(1.0 + up * p[0]) / 2.0, (1.0 + p[1]) / 2.0],
            p_u: [2.0 * up, 0.0, 0.0],
            p_v: [0.0, 2.0, 0.0],
        };
        match part.face() {
            BASE => disc(-1.0),
            CAP => disc(1.0),
            _ => {
                let longitude = libm::atan2(p[1], p[0]);
                let (c, s) = (libm::cos(longitude), libm::sin(longitude));
                let slope = self.cap - 1.0;
                Frame {
                    normal: [c, s, -slope],
                    uv: [turns(longitude), p[2]],
                    p_u: [-TAU * p[1], TAU * p[0], 0.0],
                    p_v: [slope * c, slope * s, 1.0],
                }
            }
        }
    }
}
