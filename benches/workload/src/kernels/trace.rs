//! Rays against the surface `G x G`, its normals, and how it answers light.

use core::hint::black_box;

use attractor::fif::{Cell, Pyramid};
use attractor::num::{Real, Unit, Vec3};
use attractor::trace::{Environment, HeightField, Hit, Light, Material, Ray, Statistics};
use embedded_graphics::geometry::Size;

use super::{Tally, Watch, fold};
use crate::float;
use crate::inputs::mixed;
use crate::surface::{g_integral, mirror};

const DEPTH: u32 = 8;
const CELLS: usize = Pyramid::cells(2, DEPTH);
const SIDE: u32 = 48;
const COUNT: usize = 64;

/// The rays of a picture of 48 x 48 pixels, from pixel to leaf.
#[inline(never)]
pub(super) fn rays(watch: &mut Watch<'_>) -> Tally {
    let mut memory = [Cell::ZERO; CELLS];
    let Ok(g) = g_integral() else { return Tally::default() };
    let Ok(pyramid) = Pyramid::new(&g, DEPTH, &mut memory) else { return Tally::default() };
    let Ok(caster) = mirror(&pyramid, Size::new(SIDE, SIDE)) else { return Tally::default() };
    watch.time(|| {
        let mut checksum = 0_u32;
        for y in 0..SIDE {
            for x in 0..SIDE {
                let leaf = caster.hit(x, y).map_or(0, |hit| hit.index.0 ^ hit.index.1 << 16 ^ hit.level << 8);
                checksum = checksum.rotate_left(1) ^ leaf;
            }
        }
        Tally { checksum, units: SIDE * SIDE }
    })
}

/// Rays that all meet the surface, from one eye to points of its ground.
fn towards_the_ground(eye: Vec3) -> [Ray; COUNT] {
    core::array::from_fn(|i| {
        // 0 .. 2 in both directions
        let place = |k: u32| Real::from_bits((mixed(i) >> k) as i32 & 0x1ff_ffff);
        let direction = Vec3::new(place(0), place(32), Real::ZERO).minus(eye);
        // inside ±4
        Ray::new(eye, Vec3::new(direction.x >> 1, direction.y >> 1, direction.z >> 1))
    })
}

/// Whole walks, divided by the boxes that they test.
#[inline(never)]
pub(super) fn boxes(watch: &mut Watch<'_>) -> Tally {
    let mut memory = [Cell::ZERO; CELLS];
    let Ok(g) = g_integral() else { return Tally::default() };
    let Ok(pyramid) = Pyramid::new(&g, DEPTH, &mut memory) else { return Tally::default() };
    let Ok(surface): Result<HeightField<'_>, _> = HeightField::new(&pyramid, &pyramid) else {
        return Tally::default();
    };
    let eye = Vec3::new(Real::from_num(-4), Real::from_num(-3), Real::from_num(5));
    let rays = towards_the_ground(eye);
    let mut statistics = Statistics::default();
    for ray in &rays {
        black_box(surface.intersect_counted(ray, Unit::ZERO, &mut statistics));
    }
    let tally = watch.over(&rays, |ray| {
        surface.intersect(&ray, Unit::ZERO).map_or(0, |hit| hit.index.0 ^ hit.index.1 << 16)
    });
    Tally { units: statistics.box_tests, ..tally }
}

/// Hands the leaves that rays met, and their cells, to `work`.
fn with_hits(work: impl FnOnce(&[(Hit, Cell, Cell); COUNT]) -> Tally) -> Tally {
    let mut memory = [Cell::ZERO; CELLS];
    let Ok(g) = g_integral() else { return Tally::default() };
    let Ok(pyramid) = Pyramid::new(&g, DEPTH, &mut memory) else { return Tally::default() };
    let Ok(surface): Result<HeightField<'_>, _> = HeightField::new(&pyramid, &pyramid) else {
        return Tally::default();
    };
    let eye = Vec3::new(Real::from_num(-4), Real::from_num(-3), Real::from_num(5));
    let rays = towards_the_ground(eye);
    let found = |ray: &Ray| {
        let hit = surface.intersect(ray, Unit::ZERO)?;
        let cells = pyramid.level(hit.level);
        Some((hit, *cells.get(hit.index.0 as usize)?, *cells.get(hit.index.1 as usize)?))
    };
    let Some(first) = rays.iter().find_map(found) else { return Tally::default() };
    work(&rays.map(|ray| found(&ray).unwrap_or(first)))
}

fn mixed_up<T: Into<i64>>(parts: [T; 3]) -> u32 {
    parts.into_iter().fold(0, |sum: u32, part| sum.rotate_left(5) ^ part.into() as u32)
}

fn bits(v: Vec3<Unit>) -> u32 {
    mixed_up([v.x.to_bits(), v.y.to_bits(), v.z.to_bits()])
}

#[inline(never)]
pub(super) fn normals(watch: &mut Watch<'_>) -> Tally {
    with_hits(|hits| watch.over(hits, |(hit, _, _)| hit.normal().normalised().map_or(0, bits)))
}

macro_rules! normals {
    ($name:ident, $float:ty, $root:expr, $fused:expr, $fold:expr) => {
        #[inline(never)]
        pub(super) fn $name(watch: &mut Watch<'_>) -> Tally {
            with_hits(|hits| {
                let cells = hits
                    .map(|(_, f, g)| [f.slope, f.mean, g.slope, g.mean].map(|v: Real| v.to_num::<$float>()));
                watch.over(&cells, |[df, f, dg, g]| {
                    let (x, y): ($float, $float) = (-df * g, -f * dg);
                    let scale = 1.0 / $root($fused(x, x, $fused(y, y, 1.0)));
                    let parts = [x * scale, y * scale, scale];
                    parts.into_iter().fold(0, |sum: u32, v| sum.rotate_left(5) ^ $fold(v))
                })
            })
        }
    };
}

normals!(normals_f32, f32, float::sqrt, float::mul_add, f32::to_bits);
normals!(normals_f64, f64, libm::sqrt, |a: f64, b: f64, c: f64| a * b + c, fold);

fn shaded(watch: &mut Watch<'_>, material: Material) -> Tally {
    let Ok(light) = Light::new(Vec3::new(Real::NEG_ONE, Real::from_num(-2), Real::from_num(3))) else {
        return Tally::default();
    };
    let Some(d) = Vec3::new(Real::from_num(5), Real::from_num(4), Real::from_num(-5)).normalised() else {
        return Tally::default();
    };
    with_hits(|hits| {
        let normals = hits.map(|(hit, _, _)| hit.normal().normalised().unwrap_or(d));
        let (material, light, sky) = black_box((material, light, Environment::SKY));
        watch.over(&normals, |n| material.tone(n, d, &light, &sky).to_bits() as u32)
    })
}

#[inline(never)]
pub(super) fn mirror_shading(watch: &mut Watch<'_>) -> Tally {
    shaded(watch, Material::Mirror)
}

#[inline(never)]
pub(super) fn phong(watch: &mut Watch<'_>) -> Tally {
    shaded(watch, Material::PHONG)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearly_every_ray_meets_the_surface_after_some_boxes() {
        let tally = boxes(&mut Watch::new(&mut crate::Blind, 1));
        assert!(tally.units > 5 * COUNT as u32, "{tally:?}");
        assert_ne!(tally.checksum, 0);
    }
}
