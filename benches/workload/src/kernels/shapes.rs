//! Rays against generic solids, and on their way to them.

use core::ops::ControlFlow;

use attractor::num::{Affine3, Angle, Near, Real, Unit, Vec3};
use attractor::trace::solid::{Cube, NearCrossing, NearRay, Placed, Shape, Sphere, Square, TaperedCylinder};
use attractor::trace::{Chart, Ray, Surface};

use super::watch::{Tally, Watch};
use crate::float::Float;
use crate::inputs::mixed;
use crate::rivals::solid::{self, Line};

const COUNT: usize = 64;

/// Rays as they reach a shape, two thirds of which meet it: past a place within 3/4 of the origin, from
/// nearby.
fn near_rays() -> [NearRay; COUNT] {
    core::array::from_fn(|i| {
        let (place, way) = (mixed(2 * i), mixed(2 * i + 1));
        let number = |word: u64, k: u32| Near::from_bits((word >> k) as i32 >> 3) * 3 / 4;
        let direction = |k: u32| Near::from_bits((way >> k) as i32 >> 3);
        let mut direction = [direction(0), direction(16), direction(32)];
        // one component is at least 1
        if let Some(c) = direction.get_mut(i % 3) {
            *c = if *c < 0 { *c - Near::ONE } else { *c + Near::ONE };
        }
        let [x, y, z] = direction;
        let origin = Vec3::new(number(place, 0), number(place, 16), number(place, 32));
        NearRay { origin, direction: Vec3::new(x, y, z) }
    })
}

fn folded(sum: u32, crossing: NearCrossing) -> u32 {
    sum.rotate_left(5) ^ crossing.s.to_bits() as u32 ^ u32::from(crossing.face)
}

#[inline(always)]
fn over(watch: &mut Watch<'_>, shape: impl Shape) -> Tally {
    watch.over(&near_rays(), |ray| {
        let mut sum = 0;
        shape.cross(&ray, Near::MIN, &mut |crossing| {
            sum = folded(sum, crossing);
            ControlFlow::Continue(())
        });
        sum
    })
}

fn lines<F: Float>() -> [Line<F>; COUNT] {
    let float = |v: Vec3<Near>| [v.x, v.y, v.z].map(|c| F::of(c.to_num::<f64>()));
    near_rays().map(|ray| (float(ray.origin), float(ray.direction)))
}

#[inline(never)]
pub(super) fn sphere(watch: &mut Watch<'_>) -> Tally {
    over(watch, Sphere)
}

#[inline(never)]
pub(super) fn sphere_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    watch.over(&lines::<F>(), |line| solid::sphere(line).map_or(0, |[a, b]| a.fold() ^ b.fold()))
}

#[inline(never)]
pub(super) fn square(watch: &mut Watch<'_>) -> Tally {
    over(watch, Square)
}

#[inline(never)]
pub(super) fn square_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    watch.over(&lines::<F>(), |line| solid::square(line).map_or(0, Float::fold))
}

fn faces<F: Float>(part: Option<[(F, u32); 2]>) -> u32 {
    part.map_or(0, |[(a, face), (b, other)]| a.fold() ^ b.fold() ^ face ^ other)
}

#[inline(never)]
pub(super) fn cube(watch: &mut Watch<'_>) -> Tally {
    over(watch, Cube)
}

#[inline(never)]
pub(super) fn cube_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    watch.over(&lines::<F>(), |line| faces(solid::cube(line)))
}

#[inline(never)]
pub(super) fn tapered(watch: &mut Watch<'_>) -> Tally {
    TaperedCylinder::new(Real::ONE / 2).map_or(Tally::default(), |shape| over(watch, shape))
}

#[inline(never)]
pub(super) fn tapered_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    watch.over(&lines::<F>(), |line| faces(solid::tapered(line)))
}

/// As large as the cube; what reaches it is told as it is.
#[derive(Clone, Copy)]
struct Reached;

impl Shape for Reached {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        Cube.bounds()
    }
    fn error(&self) -> Near {
        Near::DELTA
    }
    #[inline(always)]
    fn cross(&self, ray: &NearRay, _: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let (o, d) = (ray.origin, ray.direction);
        let all = [o.x, o.y, o.z, d.x, d.y, d.z].map(Near::to_bits);
        let s = Near::from_bits(all.into_iter().fold(0, |sum, c| sum ^ c));
        let _ = found(NearCrossing { s, enters: true, face: 0 });
    }
    fn value(&self, _: Vec3) -> attractor::num::Wide {
        attractor::num::Wide::ONE
    }
    fn normal(&self, _: Vec3<Near>, _: u8) -> Vec3<Near> {
        Vec3::new(Near::ZERO, Near::ZERO, Near::ONE)
    }
    fn chart(&self, _: Vec3<Real>, _: u8) -> Chart {
        Chart::default()
    }
}

/// Rays from 4 to 12 away, half of which come near a cube at `(1, 2, 3)`; all if `near`.
fn rays(near: bool) -> [Ray; COUNT] {
    core::array::from_fn(|i| {
        let (from, to) = (mixed(2 * i), mixed(2 * i + 1));
        let word = |word: u64, k: u32, places: u32| Real::from_bits((word >> k) as i32 >> places);
        let away = |k: u32| word(from, k, 4);
        let aim = |k: u32| word(to, k, if near { 7 } else { 4 });
        let origin = Vec3::new(away(0), away(16), away(32) + Real::from_num(12));
        let [x, y, z] = [1, 2, 3].map(Real::from_num);
        let d = Vec3::new(aim(0) + x, aim(16) + y, aim(32) + z).minus(origin);
        Ray::new(origin, Vec3::new(d.x >> 3, d.y >> 3, d.z >> 3))
    })
}

/// Turned, at `(1, 2, 3)`.
fn placed() -> Option<Placed<Reached>> {
    let [x, y, z] = [1, 2, 3].map(Real::from_num);
    let turn = Affine3::rotate(Vec3::new(z, x, y), Angle::from_bits(0x1234_5678)).ok()?;
    Placed::new(Reached, &turn.then(&Affine3::translate(Vec3::new(x, y, z)))).ok()
}

/// What every ray takes that comes near a thing: origin and direction through the inverse map.
#[inline(never)]
pub(super) fn affine(watch: &mut Watch<'_>) -> Tally {
    let Some(placed) = placed() else { return Tally::default() };
    // below 1 in length
    let lines = near_rays().map(|NearRay { origin, direction: d }| {
        let unit = |c: Near| Unit::from_bits(c.to_bits());
        (origin, Vec3::new(unit(d.x), unit(d.y), unit(d.z)))
    });
    watch.over(&lines, |(origin, direction)| {
        let NearRay { origin: o, direction: d } = placed.line(origin, direction);
        let all = [o.x, o.y, o.z, d.x, d.y, d.z];
        all.into_iter().fold(0_u32, |sum, c| sum.rotate_left(5) ^ c.to_bits() as u32)
    })
}

#[inline(never)]
pub(super) fn affine_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    let map = map();
    watch.over(&lines::<F>(), |line| folded_line(solid::carried(line, &map)))
}

#[inline(always)]
fn approached(watch: &mut Watch<'_>, near: bool) -> Tally {
    let Some(placed) = placed() else { return Tally::default() };
    watch.over(&rays(near), |ray| {
        let mut sum = 0;
        placed.cross(&ray, Unit::DELTA, &mut |crossing| {
            sum = crossing.t.to_bits() as u32 ^ crossing.memo[0];
            ControlFlow::Break(())
        });
        sum
    })
}

/// Rays that all come near.
#[inline(never)]
pub(super) fn reached(watch: &mut Watch<'_>) -> Tally {
    approached(watch, true)
}

/// Rays of which most pass by.
#[inline(never)]
pub(super) fn passing(watch: &mut Watch<'_>) -> Tally {
    approached(watch, false)
}

#[inline(always)]
fn approached_float<F: Float>(watch: &mut Watch<'_>, near: bool) -> Tally {
    let lines = rays(near).map(|ray| {
        let (o, d) = (ray.origin(), ray.direction());
        let origin = [o.x, o.y, o.z].map(|c| F::of(c.to_num::<f64>()));
        (origin, [d.x, d.y, d.z].map(|c| F::of(c.to_num::<f64>())))
    });
    let map = map();
    watch.over(&lines, |line| solid::mapped(line, &map, F::of(3.0)).map_or(0, folded_line))
}

/// A turn about z, and a place.
fn map<F: Float>() -> solid::Map<F> {
    let row = |x, y, z| [F::of(x), F::of(y), F::of(z)];
    let turn = [row(0.8, 0.6, 0.0), row(-0.6, 0.8, 0.0), row(0.0, 0.0, 1.0)];
    core::hint::black_box((row(1.0, 2.0, 3.0), turn))
}

fn folded_line<F: Float>((o, d): Line<F>) -> u32 {
    o.into_iter().chain(d).fold(0, |sum, c| sum ^ c.fold())
}

#[inline(never)]
pub(super) fn reached_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    approached_float::<F>(watch, true)
}

#[inline(never)]
pub(super) fn passing_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    approached_float::<F>(watch, false)
}
