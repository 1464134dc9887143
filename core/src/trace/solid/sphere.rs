//! The sphere of radius 1 round the origin: `F = x^2 + y^2 + z^2 - 1`.
//!
//! A ray `o + s d` passes the centre at the distance `|o x d| / |d|`; its crossings are
//! `s = (-o.d -+ sqrt(|d|^2 - |o x d|^2)) / |d|^2`. The vector product takes the place of `|o|^2 - 1` in the
//! quadratic equation, whose two large terms would cancel out.

use core::num::NonZeroU32;
use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::shape::{NearCrossing, NearRay, Shape};
use crate::num::formats::Q28;
use crate::num::{Near, Real, Vec3, Wide, product, reciprocal_of, sqrt, square};

/// The generic sphere: radius 1, round the origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Sphere;

impl Shape for Sphere {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        let one = Near::ONE;
        Some([Vec3::new(-one, -one, -one), Vec3::new(one, one, one)])
    }

    fn error(&self) -> Near {
        Near::DELTA * 16
    }

    #[inline]
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let Some([enters, exits]) = crossings(ray) else { return };
        if enters >= from && found(NearCrossing { s: enters, enters: true, face: 0 }).is_break() {
            return;
        }
        if exits >= from {
            let _ = found(NearCrossing { s: exits, enters: false, face: 0 });
        }
    }

    fn value(&self, place: Vec3) -> Wide {
        let square = |c: Real| product(c.to_bits(), c.to_bits());
        // 48 fractional bits; three squares of 128 are 48 384
        let sum = square(place.x).saturating_add(square(place.y)).saturating_add(square(place.z));
        Wide::from_bits(sum) - Wide::ONE
    }

    fn normal(&self, place: Vec3<Near>, _: u8) -> Vec3<Near> {
        place
    }

    fn chart(&self, _: Vec3<Real>, _: u8) -> Chart {
        Chart::default()
    }
}

/// Where the ray goes in and out.
#[inline(always)]
fn crossings(ray: &NearRay) -> Option<[Near; 2]> {
    let o = [ray.origin.x, ray.origin.y, ray.origin.z].map(Near::to_bits);
    let d = [ray.direction.x, ray.direction.y, ray.direction.z].map(Near::to_bits);
    // 56 fractional bits, below 2^60
    let across = |a: usize, b: usize| product(o[a], d[b]) - product(o[b], d[a]);
    let across = [across(1, 2), across(2, 0), across(0, 1)];
    // |o x d| <= |d| < 4 where they meet
    let far = |v: i64| ((v >> 32) as i32).wrapping_add(1 << 26) as u32 >> 27 != 0;
    if across.into_iter().any(far) {
        return None;
    }
    let across: [Q28; 3] = across.map(|v| ((v + (1 << 27)) >> 28) as i32);
    let (length, distance) = (square(d), square(across));
    if distance >= length {
        return None;
    }
    // 28 fractional bits
    let root = sqrt(length - distance);
    let (mantissa, zeros) = reciprocal_of(NonZeroU32::new((length >> 28) as u32)?);
    // 26 fractional bits, below 32; the quotient has 26 + 34 - zeros, and |d|^2 is at least 1
    let towards = -((product(o[0], d[0]) + product(o[1], d[1]) + product(o[2], d[2])) >> 30) as i32;
    let half = (root >> 2) as i32;
    let over = |v: i32| Near::from_bits((product(v, mantissa) >> (32 - zeros)) as i32);
    Some([over(towards - half), over(towards + half)])
}
