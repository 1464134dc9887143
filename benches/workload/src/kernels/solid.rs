//! Rays at shapes whose crossings take an iteration.

use core::hint::black_box;
use core::ops::ControlFlow;

use attractor::num::{Angle, Near, Real, Vec3, sin_cos};
use attractor::trace::solid::{NearRay, Shape, Superellipsoid, Torus};

use super::watch::{Tally, Watch};
use crate::float::Float;
use crate::inputs::mixed;
use crate::rivals::iterated;
use crate::rivals::solid::Line;

const COUNT: usize = 64;

/// A number from -1 to 1, 28 fractional bits.
fn random(i: usize, k: usize) -> i32 {
    (mixed(i * 8 + k) >> 35) as i32 - (1 << 28)
}

/// Through places of the middle half of a tube of 0.4: each has at least two crossings.
fn rays_at_a_torus() -> [NearRay; COUNT] {
    core::array::from_fn(|i| {
        let (sin, cos) = sin_cos(Angle::from_bits(mixed(i) as u32));
        if i % 4 == 0 {
            // near the plane of the ring and through its middle: four crossings
            let flat = |v: Near| v >> 4;
            let NearRay { origin, direction } = ray(3 * i, [0; 3]);
            let level = |v: Vec3<Near>| Vec3::new(v.x, v.y, flat(v.z));
            return NearRay { origin: level(origin), direction: level(direction) };
        }
        let place = [cos.to_bits() >> 2, sin.to_bits() >> 2, 0];
        ray(i, [0, 1, 2].map(|k: usize| place[k] + random(i, k) / 9))
    })
}

/// Through places near the middle of a superellipsoid.
fn rays_at_a_superellipsoid() -> [NearRay; COUNT] {
    core::array::from_fn(|i| ray(i, [0, 1, 2].map(|k| random(i, k) / 2)))
}

/// Through a place, from about as far away as 1, in some direction.
fn ray(i: usize, place: [i32; 3]) -> NearRay {
    let mut direction = [3, 4, 5].map(|k| random(i, k));
    // the greatest component is 1 to 2
    direction[i % 3] =
        if direction[i % 3] < 0 { direction[i % 3] - (1 << 28) } else { direction[i % 3] + (1 << 28) };
    let back = random(i, 6) >> 1;
    let origin =
        [0, 1, 2].map(|k: usize| place[k] - ((i64::from(direction[k]) * i64::from(back)) >> 28) as i32);
    let near = |v: [i32; 3]| {
        let [x, y, z] = v.map(Near::from_bits);
        Vec3::new(x, y, z)
    };
    NearRay { origin: near(origin), direction: near(direction) }
}

/// All crossings, or the first, of each ray.
#[inline(always)]
fn cross(watch: &mut Watch<'_>, shape: &impl Shape, rays: &[NearRay; COUNT], all: bool) -> Tally {
    watch.time(|| {
        let mut checksum = 0_u32;
        for ray in black_box(rays) {
            shape.cross(ray, Near::MIN, &mut |crossing| {
                checksum = checksum.rotate_left(1) ^ crossing.s.to_bits() as u32;
                if all { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            });
        }
        Tally { checksum, units: COUNT as u32 }
    })
}

#[inline(never)]
pub(super) fn torus(watch: &mut Watch<'_>) -> Tally {
    let Ok(torus) = Torus::new(Near::lit("0.4")) else { return Tally::default() };
    cross(watch, &torus, &rays_at_a_torus(), true)
}

/// The same rays in floating point.
fn lines<F: Float>(rays: [NearRay; COUNT]) -> [Line<F>; COUNT] {
    let float = |v: Vec3<Near>| [v.x, v.y, v.z].map(|c| F::of(c.to_num::<f64>()));
    rays.map(|ray| (float(ray.origin), float(ray.direction)))
}

#[inline(never)]
pub(super) fn torus_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    let tube = black_box(F::of(0.4));
    watch.over(&lines::<F>(rays_at_a_torus()), |line| {
        let (found, count) = iterated::torus(line, tube);
        found.iter().take(count).fold(count as u32, |sum, s| sum.rotate_left(1) ^ s.fold())
    })
}

#[inline(never)]
pub(super) fn superellipsoid_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    let (n, m) = black_box((F::of(3.5), F::of(2.5)));
    watch.over(&lines::<F>(rays_at_a_superellipsoid()), |line| {
        iterated::superellipsoid(line, n, m).map_or(0, Float::fold)
    })
}

#[inline(never)]
pub(super) fn superellipsoid(watch: &mut Watch<'_>) -> Tally {
    let exponents = (Real::lit("3.5"), Real::lit("2.5"));
    let Ok(shape) = Superellipsoid::new(exponents.0, exponents.1) else { return Tally::default() };
    cross(watch, &shape, &rays_at_a_superellipsoid(), false)
}

#[inline(never)]
pub(super) fn star(watch: &mut Watch<'_>) -> Tally {
    let exponents = (Real::lit("0.7"), Real::lit("0.5"));
    let Ok(shape) = Superellipsoid::new(exponents.0, exponents.1) else { return Tally::default() };
    cross(watch, &shape, &rays_at_a_superellipsoid(), false)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the rows say of their rays.
    #[test]
    fn the_rays_meet_what_they_are_for() {
        let count = |shape: &dyn Fn(&NearRay) -> u32, rays: [NearRay; COUNT]| rays.map(|ray| shape(&ray));
        let torus = Torus::new(Near::lit("0.4")).unwrap();
        let shape = Superellipsoid::new(Real::lit("3.5"), Real::lit("2.5")).unwrap();
        let tori = count(&|ray| crossings(&torus, ray), rays_at_a_torus());
        assert!(tori.iter().all(|n| *n >= 2) && tori.iter().filter(|n| **n == 4).count() > 15, "{tori:?}");
        let hits = count(&|ray| crossings(&shape, ray), rays_at_a_superellipsoid());
        assert!(hits.iter().all(|n| *n == 2), "{hits:?}");
    }

    fn crossings(shape: &impl Shape, ray: &NearRay) -> u32 {
        let mut count = 0;
        shape.cross(ray, Near::MIN, &mut |_| {
            count += 1;
            ControlFlow::Continue(())
        });
        count
    }
}
