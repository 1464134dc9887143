//! The cube from -1 to 1 along each axis: `F = max(|x|, |y|, |z|) - 1`.
//!
//! Which of three planes a ray crosses last, and which first, is found by products; only these two quotients
//! are taken.
//!
//! Faces are those at `x` = -1, 1, `y` = -1, 1, `z` = -1, 1, from 0 on. Each has texture coordinates in
//! `[0, 1]`, `v` upwards on the sides and along `y` on the others, `u` to the right as seen from outside:
//! `u = (1 + r) / 2`, `v = (1 + w) / 2` with `(r, w)` = `(-y, z)`, `(y, z)`, `(x, z)`, `(-x, z)`, `(-x, y)`,
//! `(x, y)`.

use core::num::NonZeroU32;
use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::shape::{NearCrossing, NearRay, Shape, corners};
use super::slab::{Part, over};
use crate::num::formats::Q28;
use crate::num::{Near, Real, Vec3, Wide, product, reciprocal_of};

/// The generic cube.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cube;

/// Where a ray crosses the plane of a face: at `way / rise`.
#[derive(Clone, Copy)]
struct Edge {
    way: Q28,
    rise: NonZeroU32,
    face: u8,
}

/// Both planes across an axis, in the order in which a ray crosses them. One parallel to them leans by less
/// than a direction's resolution.
#[inline(always)]
fn pair(face: u8, o: Near, d: Near) -> [Edge; 2] {
    const ONE: i32 = 1 << 28;
    let (o, d) = (o.to_bits(), d.to_bits());
    // against a mirrored cube the ray goes upwards
    let (o, back) = if d < 0 { (o.wrapping_neg(), 1) } else { (o, 0) };
    let rise = NonZeroU32::new(d.unsigned_abs()).unwrap_or(NonZeroU32::MIN);
    let edge = |way: Q28, face: u8| Edge { way, rise, face };
    [edge((-ONE).wrapping_sub(o), face + back), edge(ONE.wrapping_sub(o), face + 1 - back)]
}

impl Edge {
    /// Whether this is crossed before the other: quotients by their products, which are exact.
    #[inline(always)]
    fn is_before(self, other: Self) -> bool {
        product(self.way, other.rise.get() as i32) < product(other.way, self.rise.get() as i32)
    }

    #[inline(always)]
    fn later(self, other: Self) -> Self {
        if self.is_before(other) { other } else { self }
    }

    #[inline(always)]
    fn earlier(self, other: Self) -> Self {
        if other.is_before(self) { other } else { self }
    }

    /// The ray's parameter there, and the face.
    #[inline(always)]
    fn met(self) -> (Q28, u8) {
        (over(self.way, reciprocal_of(self.rise)), self.face)
    }
}

impl Cube {
    pub(super) const BOUNDS: Option<[Vec3<Near>; 2]> = Some(corners([-1, -1, -1], [1, 1, 1]));
    pub(super) const ERROR: Near = Near::from_bits(8);
}

impl Shape for Cube {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        Self::BOUNDS
    }

    fn faces(&self) -> u8 {
        6
    }

    fn error(&self) -> Near {
        Self::ERROR
    }

    /// Error: on the surface within `2^-25` (`rays_meet_the_cube_where_they_should`). Cost: kernel `cube`.
    #[inline]
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let (o, d) = (ray.origin, ray.direction);
        let [x, y, z] = [(0, o.x, d.x), (2, o.y, d.y), (4, o.z, d.z)].map(|(face, o, d)| pair(face, o, d));
        let begin = x[0].later(y[0]).later(z[0]);
        let end = x[1].earlier(y[1]).earlier(z[1]);
        if begin.is_before(end) {
            Part { begin: begin.met(), end: end.met() }.hand_over(from, found);
        }
    }

    fn value(&self, place: Vec3) -> Wide {
        let [x, y, z] = [place.x, place.y, place.z].map(|c| Wide::from(c).abs());
        x.max(y).max(z) - Wide::ONE
    }

    fn normal(&self, _: Vec3<Near>, face: u8) -> Vec3<Near> {
        let out = if face & 1 > 0 { Near::ONE } else { -Near::ONE };
        match face >> 1 {
            0 => Vec3::new(out, Near::ZERO, Near::ZERO),
            1 => Vec3::new(Near::ZERO, out, Near::ZERO),
            _ => Vec3::new(Near::ZERO, Near::ZERO, out),
        }
    }

    fn chart(&self, place: Vec3<Real>, face: u8) -> Chart {
        let Vec3 { x, y, z } = place;
        let (along_x, along_y, along_z) = (Vec3::X, Vec3::Y, Vec3::Z);
        let back = Vec3::default();
        let (r, w, along_r, along_w) = match face {
            0 => (-y, z, back.minus(along_y), along_z),
            1 => (y, z, along_y, along_z),
            2 => (x, z, along_x, along_z),
            3 => (-x, z, back.minus(along_x), along_z),
            4 => (-x, y, back.minus(along_x), along_y),
            _ => (x, y, along_x, along_y),
        };
        let half = |c: Real| (c >> 1) + Real::ONE / 2;
        let twice = |v: Vec3| Vec3::new(v.x * 2, v.y * 2, v.z * 2);
        Chart { u: half(r), v: half(w), along_u: twice(along_r), along_v: twice(along_w) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::judge::{Seen, convex, inside};
    use super::*;

    fn planes(offset: f64) -> [[f64; 4]; 6] {
        core::array::from_fn(|face| {
            let mut plane = [0.0, 0.0, 0.0, 1.0 + offset];
            plane[face / 2] = if face % 2 > 0 { 1.0 } else { -1.0 };
            plane
        })
    }

    fn judged(count: usize) -> Seen {
        convex(
            &Cube,
            count,
            |o, d, offset| inside(&planes(offset), o, d),
            |p| planes(0.0).map(|[x, y, z, d]| x * p[0] + y * p[1] + z * p[2] - d),
        )
    }

    #[test]
    fn rays_meet_the_cube_where_they_should() {
        // every crossing that `cross` hands over is judged
        let seen = judged(30_000);
        assert!(seen.judged > 26_000 && seen.met > 20_000, "{seen:?}");
        assert!(seen.faces[..6].iter().all(|n| *n > 2_000), "{seen:?}");
        assert!(seen.off > 2_f64.powi(-28) && seen.off < 2_f64.powi(-25), "{seen:?}");
    }

    /// `cargo test -p attractor --lib -- --ignored rays_meet_the_cube`
    #[test]
    #[ignore = "a million rays"]
    fn a_million_rays_meet_the_cube_where_they_should() {
        let seen = judged(1_000_000);
        assert!(seen.judged > 880_000 && seen.off < 2_f64.powi(-25), "{seen:?}");
    }
}
