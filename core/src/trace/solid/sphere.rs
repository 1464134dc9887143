//! The sphere of radius 1 round the origin: `F = x^2 + y^2 + z^2 - 1`.
//!
//! A ray `o + s d` is closest to the centre at `s_0 = -o.d / |d|^2`, in `p = o + s_0 d`; its crossings are
//! `s = s_0 -+ sqrt((1 - |p|^2) / |d|^2)`. The quadratic equation of `o` itself has two large terms that
//! would cancel out.
//!
//! Texture coordinates: `u` is the longitude, `atan2(y, x) / 2 pi`, `v` the latitude from the lower pole to
//! the upper, `1/2 + asin(z) / pi`. `P_u = 2 pi (-y, x, 0)`, `P_v = pi (-x z / r, -y z / r, r)` with `r` the
//! distance from the axis; at the poles `x / r` counts as 1 and `y / r` as 0.

use core::num::NonZeroU32;
use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::shape::{NearCrossing, NearRay, Shape, corners};
use crate::num::{
    Angle, Near, Real, Unit, Vec3, Wide, atan2, product, product_u, reciprocal_of, rough_sqrt, square, unit,
};

/// The generic sphere: radius 1, round the origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sphere;

impl Sphere {
    pub(super) const BOUNDS: Option<[Vec3<Near>; 2]> = Some(corners([-1, -1, -1], [1, 1, 1]));
    pub(super) const RADIUS: Option<Near> = Some(Near::ONE);
    pub(super) const ERROR: Near = Near::from_bits(16);
}

impl Shape for Sphere {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        Self::BOUNDS
    }

    fn radius(&self) -> Option<Near> {
        Self::RADIUS
    }

    fn error(&self) -> Near {
        Self::ERROR
    }

    fn is_round(&self) -> bool {
        true
    }

    /// Error: on the sphere within `2^-24` (`rays_meet_the_sphere_where_they_should`). Cost: kernel `sphere`.
    #[inline]
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let Some([first, last]) = crossings(ray) else { return };
        let (mut s, mut enters) = if first >= from { (first, true) } else { (last, false) };
        while s >= from {
            if found(NearCrossing { s, enters, face: 0 }).is_break() || !enters {
                return;
            }
            (s, enters) = (last, false);
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

    fn chart(&self, place: Vec3<Real>, _: u8) -> Chart {
        let [x, y, z] = [place.x, place.y, place.z].map(Real::to_bits);
        let out = radial(x, y);
        let [cos, sin] = out.map(Unit::to_bits);
        // 24 fractional bits
        let radius = ((product(x, cos) + product(y, sin)) >> 30) as i32;
        let pi = |v: i32| Real::from_bits((product(v, PI) >> 29) as i32);
        // pi first: behind two products by -pi, shifted, LLVM 22.1 loses their upper words on RV32IMAC
        // (`cargo xtask target` looks for such places)
        let up = (product(z, -PI) >> 29) as i32;
        let level = |c: i32| Real::from_bits((product(up, c) >> 30) as i32);
        Chart {
            u: turns(atan2(y, x)),
            // from a quarter of a turn down to a quarter up, twice
            v: Real::from_bits((atan2(z, radius).to_bits() as i32 >> 7) + (1 << 23)),
            along_u: Vec3::new(pi(y.saturating_mul(-2)), pi(x.saturating_mul(2)), Real::ZERO),
            along_v: Vec3::new(level(cos), level(sin), pi(radius)),
        }
    }
}

/// pi, 29 fractional bits.
pub(super) const PI: i32 = 0x6487_ed51;

/// An angle as a number in `[0, 1)`.
pub(super) fn turns(angle: Angle) -> Real {
    Real::from_bits((angle.to_bits() >> 8) as i32)
}

/// Cosine and sine of the direction of `(x, y)`, 1 and 0 for no direction.
pub(super) fn radial(x: i32, y: i32) -> [Unit; 2] {
    let out = unit([x, y, 0]);
    if x | y == 0 { [Unit::ONE, Unit::ZERO] } else { [out.x, out.y] }
}

/// Where the ray goes in and out.
#[inline(always)]
fn crossings(ray: &NearRay) -> Option<[Near; 2]> {
    let o = [ray.origin.x, ray.origin.y, ray.origin.z].map(Near::to_bits);
    let d = [ray.direction.x, ray.direction.y, ray.direction.z].map(Near::to_bits);
    // |d|^2 is from 1 to 12, its reciprocal mantissa 2^zeros / 2^34
    let (mantissa, zeros) = reciprocal_of(NonZeroU32::new((square(d) >> 28) as u32)?);
    let zeros = zeros & 3;
    // 26 fractional bits, below 32
    let towards = -((product(o[0], d[0]) + product(o[1], d[1]) + product(o[2], d[2])) >> 30) as i32;
    let quotient = product(towards, mantissa);
    let middle = ((quotient >> 32) as i32) << zeros | ((quotient as u32 >> 1) >> (31 - zeros)) as i32;
    let along = |o: i32, d: i32| o.wrapping_add((product(d, middle) >> 28) as i32);
    // written out: on a Cortex-M0 an index of `map` is checked
    let place = [along(o[0], d[0]), along(o[1], d[1]), along(o[2], d[2])];
    let inside = (1_u64 << 56).checked_sub(square(place))?;
    // 28 + 34 - zeros fractional bits, and of a root half as many; an even number of them
    let odd = zeros & 1;
    let half = rough_sqrt(product_u((inside >> 28) as u32, mantissa as u32) << odd);
    let half = (half >> (3 - (zeros >> 1))) as i32;
    Some([Near::from_bits(middle - half), Near::from_bits(middle + half)])
}

#[cfg(test)]
mod tests {
    use super::super::judge::{Seen, along, convex, dot};
    use super::*;

    fn judged(count: usize) -> Seen {
        convex(
            &Sphere,
            count,
            |o, d, offset| {
                // the distance by the vector product, which cancels nothing
                let cross = [0, 1, 2].map(|k: usize| {
                    let (a, b) = ((k + 1) % 3, (k + 2) % 3);
                    o[a] * d[b] - o[b] * d[a]
                });
                let (length, middle) = (dot(d, d), -dot(o, d) / dot(d, d));
                let half = (1.0 + offset).powi(2) - dot(cross, cross) / length;
                let half = (half > 0.0).then(|| (half / length).sqrt())?;
                Some([middle - half, middle + half])
            },
            |p| [dot(p, p).sqrt() - 1.0],
        )
    }

    #[test]
    fn rays_meet_the_sphere_where_they_should() {
        // every crossing that `cross` hands over is judged
        let seen = judged(40_000);
        assert!(seen.judged > 39_000 && seen.met > 25_000, "{seen:?}");
        assert!(seen.off > 2_f64.powi(-27) && seen.off < 2_f64.powi(-24), "{seen:?}");
    }

    /// `cargo test -p attractor --lib -- --ignored rays_meet_the_sphere`
    #[test]
    #[ignore = "a million rays"]
    fn a_million_rays_meet_the_sphere_where_they_should() {
        let seen = judged(1_000_000);
        assert!(seen.judged > 980_000 && seen.off < 2_f64.powi(-24), "{seen:?}");
    }

    /// `P_u` and `P_v` against differences of places, and no jump but at the seam.
    #[test]
    fn the_chart_of_the_sphere_is_longitude_and_latitude() {
        let at = |u: f64, v: f64| {
            let ((s, c), (z, r)) =
                ((u * core::f64::consts::TAU).sin_cos(), ((v - 0.5) * core::f64::consts::PI).sin_cos());
            [c * r, s * r, z]
        };
        let mut worst = [0.0_f64; 2];
        for (i, j) in (0..64).flat_map(|i| (0..33).map(move |j| (i, j))) {
            let (u, v) = (f64::from(i) / 64.0, (f64::from(j) + 0.02) / 33.0);
            let [x, y, z] = at(u, v).map(Real::from_num);
            let chart = Sphere.chart(Vec3::new(x, y, z), 0);
            // the place has 24 fractional bits
            let near_pole = 1.0 / (v * (1.0 - v));
            worst[0] = worst[0].max((chart.u.to_num::<f64>() - u).abs() / near_pole);
            worst[0] = worst[0].max((chart.v.to_num::<f64>() - v).abs() / near_pole);
            let h = 1e-5;
            for (got, a, b) in
                [(chart.along_u, at(u + h, v), at(u - h, v)), (chart.along_v, at(u, v + h), at(u, v - h))]
            {
                for (got, k) in [got.x, got.y, got.z].into_iter().zip(0..) {
                    worst[1] =
                        worst[1].max((got.to_num::<f64>() - (a[k] - b[k]) / (2.0 * h)).abs() / near_pole);
                }
            }
        }
        assert!(worst[0] > 1e-9 && worst[0] < 1e-7 && worst[1] < 1e-6, "{worst:?}");
        // the seam: just before it nearly 1, behind it 0
        let seam = |y: i32| Sphere.chart(Vec3::new(Real::ONE, Real::from_bits(y), Real::ZERO), 0).u;
        assert!(seam(-8) > 0.999 && seam(8) < 0.001 && seam(0) == 0);
        let pole = Sphere.chart(Vec3::Z, 0);
        assert!(pole.v == 1 && pole.along_v.x < -3 && pole.along_u == Vec3::default(), "{pole:?}");
        assert_eq!(along([0.0; 3], [1.0; 3], 2.0), [2.0; 3]);
    }
}
