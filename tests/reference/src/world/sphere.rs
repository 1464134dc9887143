//! The sphere of radius 1 about the origin: `F = x^2 + y^2 + z^2 - 1`.
//!
//! With the point of closest approach `c = o - (o . d / d . d) d`, the line crosses at
//! `t = -o . d / d . d -+ sqrt((1 - c . c) / d . d)`.
//!
//! Texture: `u` is the longitude over `2 pi`, in `[0, 1)` from +x through +y; `v = 1/2 + asin(z) / pi`.
//! `P_u = 2 pi (-y, x, 0)`, `P_v = pi (-z cos a, -z sin a, rho)`, `a` the longitude, `rho` the distance from
//! the axis.
//!
//! Source: course unit V, section 5.7, 4 (the parabola of a quadric).

use crate::camera::Ray;
use crate::vector::{Vector, along, dot};
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape, turns};
use core::f64::consts::{PI, TAU};

/// The generic sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere;

impl Shape for Sphere {
    fn crossings(&self, ray: &Ray, _: Cone) -> Vec<Crossing> {
        let square = dot(ray.direction, ray.direction);
        let middle = -dot(ray.origin, ray.direction) / square;
        let closest = along(ray.origin, middle, ray.direction);
        let rest = 1.0 - dot(closest, closest);
        if rest <= 0.0 {
            return Vec::new();
        }
        let half = libm::sqrt(rest / square);
        let crossing = |t, enters| Crossing { t, part: Part::Face(0), enters };
        vec![crossing(middle - half, true), crossing(middle + half, false)]
    }

    fn value(&self, p: Vector) -> f64 {
        dot(p, p) - 1.0
    }

    fn frame(&self, p: Vector, _: Part) -> Frame {
        let longitude = libm::atan2(p[1], p[0]);
        let rho = libm::hypot(p[0], p[1]);
        let (c, s) = (libm::cos(longitude), libm::sin(longitude));
        Frame {
            normal: p,
            uv: [turns(longitude), 0.5 + libm::asin(p[2].clamp(-1.0, 1.0)) / PI],
            p_u: [-TAU * p[1], TAU * p[0], 0.0],
            p_v: [-PI * p[2] * c, -PI * p[2] * s, PI * rho],
        }
    }
}
