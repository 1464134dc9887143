//! The torus about the z axis, ring radius 1, tube radius `r`: `F = (sqrt(x^2 + y^2) - 1)^2 + z^2 - r^2`.
//!
//! Without its root, `G = (|p|^2 + 1 - r^2)^2 - 4 (x^2 + y^2)` has the same sign; along a ray it is a quartic
//! in `t`. Its coefficients and its signs are taken in double-doubles, with `t` from the point of closest
//! approach, so that a ray that almost touches is told from one that does not.
//!
//! Texture: `u` is the longitude over `2 pi`, `v` the angle round the tube over `2 pi`, in `[0, 1)` from the
//! outer equator upwards. `P_u = 2 pi (-y, x, 0)`,
//! `P_v = 2 pi r (-sin b cos a, -sin b sin a, cos b)`, `a` and `b` the two angles.
//!
//! Source: course unit V, section 5.7, 4 (whose formula has lost the square root).

use crate::camera::Ray;
use crate::double_double::DoubleDouble;
use crate::vector::{Vector, along, dot};
use crate::world::root::polynomial;
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape, turns};
use core::f64::consts::TAU;

/// The generic torus.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Torus {
    /// The radius `r` of the tube, between 0 and 1.
    pub tube: f64,
}

impl Torus {
    /// `G` along the ray from `start` on, constant coefficient first.
    fn quartic(&self, ray: &Ray, start: f64) -> [DoubleDouble; 5] {
        let dd = DoubleDouble::from;
        let d = ray.direction.map(dd);
        let mut o = ray.origin.map(dd);
        for axis in 0..3 {
            o[axis] = o[axis] + dd(start) * d[axis];
        }
        let two = dd(2.0);
        // x^2 + y^2 and |p|^2 + 1 - r^2 as parabolas.
        let rho = [o[0] * o[0] + o[1] * o[1], two * (o[0] * d[0] + o[1] * d[1]), d[0] * d[0] + d[1] * d[1]];
        let rest = DoubleDouble::ONE - dd(self.tube) * dd(self.tube);
        let all = [rho[0] + o[2] * o[2] + rest, rho[1] + two * o[2] * d[2], rho[2] + d[2] * d[2]];
        let four = dd(4.0);
        [
            all[0] * all[0] - four * rho[0],
            two * all[0] * all[1] - four * rho[1],
            two * all[0] * all[2] + all[1] * all[1] - four * rho[2],
            two * all[1] * all[2],
            all[2] * all[2],
        ]
    }
}

impl Shape for Torus {
    fn crossings(&self, ray: &Ray, _: Cone) -> Vec<Crossing> {
        let square = dot(ray.direction, ray.direction);
        let start = -dot(ray.origin, ray.direction) / square;
        let closest = along(ray.origin, start, ray.direction);
        // A little more than the sphere around it.
        let reach = 1.0 + self.tube + 1e-3;
        let rest = reach * reach - dot(closest, closest);
        if rest <= 0.0 {
            return Vec::new();
        }
        let half = libm::sqrt(rest / square);
        let roots = polynomial(&self.quartic(ray, start), -half, half);
        let crossing =
            |(k, s): (usize, &f64)| Crossing { t: start + s, part: Part::Face(0), enters: k % 2 == 0 };
        roots.iter().enumerate().map(crossing).collect()
    }

    fn value(&self, p: Vector) -> f64 {
        let ring = libm::hypot(p[0], p[1]) - 1.0;
        ring * ring + p[2] * p[2] - self.tube * self.tube
    }

    fn frame(&self, p: Vector, _: Part) -> Frame {
        let longitude = libm::atan2(p[1], p[0]);
        let (c, s) = (libm::cos(longitude), libm::sin(longitude));
        let round = libm::atan2(p[2], libm::hypot(p[0], p[1]) - 1.0);
        let (out, up) = (libm::cos(round), libm::sin(round));
        let per_turn = TAU * self.tube;
        Frame {
            normal: [out * c, out * s, up],
            uv: [turns(longitude), turns(round)],
            p_u: [-TAU * p[1], TAU * p[0], 0.0],
            p_v: [-per_turn * up * c, -per_turn * up * s, per_turn * out],
        }
    }
}
