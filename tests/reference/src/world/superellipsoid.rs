//! The superellipsoid `F = (|x|^n + |y|^n)^(m/n) + |z|^m - 1`, exponents from 0.2 to 20.
//!
//! A ray is cut where a coordinate changes its sign; on each piece `|x|`, `|y|` and `|z|` are monotone, so
//! that the values at the ends bound them, and `F` and `F'` with them. A piece on which `F` cannot be 0 is
//! dropped, one on which `F'` cannot be 0 has a root if the signs at its ends differ, any other is halved.
//! With `N = |x|^n + |y|^n`, `F' / m = N^(m/n - 1) (|x|^(n-1) |x|' + |y|^(n-1) |y|') + |z|^(m-1) |z|'`.
//!
//! Texture: with `w = 2 pi u`, `e = pi (v - 1/2)` and powers that keep the sign,
//! `P = (cos(e)^(2/m) cos(w)^(2/n), cos(e)^(2/m) sin(w)^(2/n), sin(e)^(2/m))`; of a sphere that is longitude
//! and latitude.
//!
//! Source: course unit V, section 5.7, 4 (whose formula has lost the absolute values); Barr, "Superquadrics
//! and Angle-Preserving Transformations", 1981, for the parametrisation.

use crate::camera::Ray;
use crate::vector::Vector;
use crate::world::root::bracketed;
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape, turns};
use crate::world::span::Span;
use core::f64::consts::{PI, TAU};

/// A piece that is narrower is not halved again: two roots that are closer are none.
const NARROW: f64 = 1e-10;
/// What is inside by less is outside: a ray in a flat part of the surface does not cross it at every
/// rounding.
const SKIN: f64 = 1e-15;
/// Nearer to a plane of symmetry a gradient may be too large for an f64.
const NEAR_A_PLANE: f64 = 1e-60;

/// The generic superellipsoid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Superellipsoid {
    /// The exponent `n`, across the axis.
    pub n: f64,
    /// The exponent `m`, along the axis.
    pub m: f64,
}

/// A point of a ray: `t`, the sizes of its coordinates and their powers.
#[derive(Clone, Copy)]
struct Sample {
    t: f64,
    size: Vector,
    power: Vector,
}

impl Superellipsoid {
    fn sample(&self, ray: &Ray, t: f64) -> Sample {
        let size = ray.at(t).map(f64::abs);
        let power = [libm::pow(size[0], self.n), libm::pow(size[1], self.n), libm::pow(size[2], self.m)];
        Sample { t, size, power }
    }

    /// `N^(m/n)`.
    fn across(&self, sum: f64) -> f64 {
        libm::pow(sum, self.m / self.n)
    }

    fn sampled_value(&self, at: &Sample) -> f64 {
        self.across(at.power[0] + at.power[1]) + at.power[2] - 1.0 + SKIN
    }

    /// The derivative of a size's power over its exponent: infinite where the size is 0 and the exponent
    /// below 1.
    fn rate(&self, end: &Sample, axis: usize, slope: f64) -> f64 {
        let exponent = if axis == 2 { self.m } else { self.n };
        match end.size[axis] {
            0.0 if exponent > 1.0 => 0.0,
            0.0 if exponent < 1.0 => slope * f64::INFINITY,
            0.0 => slope,
            size => end.power[axis] / size * slope,
        }
    }

    /// The roots of `F` between two points of one piece; `slope` holds `|x|'`, `|y|'`, `|z|'`.
    fn roots(&self, ray: &Ray, slope: Vector, ends: [Sample; 2], roots: &mut Vec<f64>) {
        let range = |axis: usize| {
            let (a, b) = (ends[0].power[axis], ends[1].power[axis]);
            (a.min(b), a.max(b))
        };
        let (x, y, z) = (range(0), range(1), range(2));
        let n = (x.0 + y.0, x.1 + y.1);
        let raised = (self.across(n.0), self.across(n.1));
        if raised.0 + z.0 - 1.0 + SKIN >= 0.0 || raised.1 + z.1 - 1.0 + SKIN < 0.0 {
            return;
        }
        // |x|^(n-1) |x|' and so on.
        let term = |axis: usize| {
            if slope[axis] == 0.0 {
                return (0.0, 0.0);
            }
            let [a, b] = ends.map(|end| self.rate(&end, axis, slope[axis]));
            (a.min(b), a.max(b))
        };
        let (u, v, w) = (term(0), term(1), term(2));
        let factor = (raised.0 / n.0, raised.1 / n.1);
        let sum = (u.0 + v.0, u.1 + v.1);
        let products = [sum.0 * factor.0, sum.0 * factor.1, sum.1 * factor.0, sum.1 * factor.1];
        let low = products.into_iter().fold(f64::INFINITY, f64::min) + w.0;
        let high = products.into_iter().fold(f64::NEG_INFINITY, f64::max) + w.1;
        // A comparison with what is not a number is false.
        let monotone = n.0 > 0.0 && (low > 0.0 || high < 0.0);
        if monotone || ends[1].t - ends[0].t <= NARROW {
            if (self.sampled_value(&ends[0]) < 0.0) != (self.sampled_value(&ends[1]) < 0.0) {
                let value = |t: f64| self.sampled_value(&self.sample(ray, t));
                roots.push(bracketed(value, ends[0].t, ends[1].t));
            }
            return;
        }
        let middle = self.sample(ray, ends[0].t + (ends[1].t - ends[0].t) / 2.0);
        self.roots(ray, slope, [ends[0], middle], roots);
        self.roots(ray, slope, [middle, ends[1]], roots);
    }

    /// The gradient of `F`, of any length.
    fn gradient(&self, p: Vector) -> Vector {
        let size = p.map(|c| c.abs().max(NEAR_A_PLANE));
        let sum = libm::pow(size[0], self.n) + libm::pow(size[1], self.n);
        let factor = libm::pow(sum, self.m / self.n - 1.0);
        let part = |axis: usize, exponent: f64, factor: f64| match p[axis] {
            0.0 => 0.0,
            c => libm::copysign(libm::pow(size[axis], exponent - 1.0) * factor, c),
        };
        let gradient = [part(0, self.n, factor), part(1, self.n, factor), part(2, self.m, 1.0)];
        let largest = gradient.iter().fold(0.0, |largest: f64, g| largest.max(g.abs()));
        gradient.map(|g| g / largest)
    }
}

impl Shape for Superellipsoid {
    fn crossings(&self, ray: &Ray, _: Cone) -> Vec<Crossing> {
        let span = Span::LINE.cube(ray, 0);
        if span.is_empty() {
            return Vec::new();
        }
        // A little more than the cube, whose faces the surface touches.
        let (start, end) = (span.enter.0, span.leave.0);
        let margin = 1e-9 * (1.0 + start.abs().max(end.abs()));
        let (start, end) = (start - margin, end + margin);
        let zero = |axis: usize| -ray.origin[axis] / ray.direction[axis];
        let mut cuts: Vec<f64> = (0..3).map(zero).filter(|&t| t > start && t < end).collect();
        cuts.extend([start, end]);
        cuts.sort_by(f64::total_cmp);
        let mut roots = Vec::new();
        for piece in cuts.windows(2).filter(|piece| piece[0] < piece[1]) {
            let middle = ray.at(piece[0] + (piece[1] - piece[0]) / 2.0);
            let slope = [0, 1, 2].map(|axis| ray.direction[axis] * libm::copysign(1.0, middle[axis]));
            self.roots(ray, slope, [self.sample(ray, piece[0]), self.sample(ray, piece[1])], &mut roots);
        }
        let crossing = |(k, &t): (usize, &f64)| Crossing { t, part: Part::Face(0), enters: k % 2 == 0 };
        roots.iter().enumerate().map(crossing).collect()
    }

    fn value(&self, p: Vector) -> f64 {
        let size = p.map(f64::abs);
        let sum = libm::pow(size[0], self.n) + libm::pow(size[1], self.n);
        self.across(sum) + libm::pow(size[2], self.m) - 1.0
    }

    fn frame(&self, p: Vector, _: Part) -> Frame {
        let half = |c: f64, exponent: f64| libm::copysign(libm::pow(c.abs(), exponent / 2.0), c);
        let rho = libm::pow(libm::pow(p[0].abs(), self.n) + libm::pow(p[1].abs(), self.n), 1.0 / self.n);
        let w = libm::atan2(half(p[1], self.n), half(p[0], self.n));
        let e = libm::atan2(half(p[2], self.m), half(rho, self.m));
        // cos^(2 / exponent), sin^(2 / exponent) and how both change with the angle
        let powers = |angle: f64, exponent: f64| {
            let k = 2.0 / exponent;
            let (c, s) = (libm::cos(angle), libm::sin(angle));
            let size = |c: f64| c.abs().max(NEAR_A_PLANE);
            let power = |c: f64| libm::copysign(libm::pow(size(c), k), c);
            let rate = |c: f64| k * libm::pow(size(c), k - 1.0);
            ([power(c), power(s)], [-rate(c) * s, rate(s) * c])
        };
        let ([a, b], [a_w, b_w]) = powers(w, self.n);
        let ([across, _], [across_e, up_e]) = powers(e, self.m);
        Frame {
            normal: self.gradient(p),
            uv: [turns(w), 0.5 + e / PI],
            p_u: [across * a_w, across * b_w, 0.0].map(|c| TAU * c),
            p_v: [across_e * a, across_e * b, up_e].map(|c| PI * c),
        }
    }
}
