//! Rays against the surface `G x G`.

use core::hint::black_box;

use attractor::fif::{Cell, Pyramid};
use attractor::num::{Real, Unit, Vec3};
use attractor::trace::{HeightField, Hit, Ray, meets};
use embedded_graphics::geometry::Size;

use super::watch::{Tally, Watch};
use crate::exported::figure_3_g;
use crate::float::Float;
use crate::inputs::mixed;
use crate::rivals::{self, CELLS, Caster, DEPTH, Vector};
use crate::surface::mirror;

const SIDE: u32 = 48;
const COUNT: usize = 64;

/// Hands the pyramid of `G` to `work`.
pub(super) fn with_pyramid(work: impl FnOnce(&Pyramid<'_>) -> Tally) -> Tally {
    let mut memory = [Cell::ZERO; CELLS];
    let Ok(g) = figure_3_g::function::<2, 2>() else { return Tally::default() };
    let Ok(pyramid) = Pyramid::new(&g, DEPTH as u32, &mut memory) else { return Tally::default() };
    work(&pyramid)
}

/// Hands the surface to `work`.
fn with_surface(work: impl FnOnce(&Pyramid<'_>, &HeightField<'_>) -> Tally) -> Tally {
    with_pyramid(|pyramid| HeightField::new(pyramid, pyramid).map_or(Tally::default(), |s| work(pyramid, &s)))
}

/// The rays of a picture of 48 x 48 pixels, from pixel to leaf.
#[inline(never)]
pub(super) fn rays(watch: &mut Watch<'_>) -> Tally {
    with_pyramid(|pyramid| {
        let Ok(caster) = mirror(pyramid, Size::new(SIDE, SIDE)) else { return Tally::default() };
        watch.time(|| each_ray(|x, y| caster.hit(x, y).map(|hit| (hit.level, hit.index.0, hit.index.1))))
    })
}

#[inline(never)]
pub(super) fn rays_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    with_pyramid(|pyramid| {
        let caster = Caster::<F>::new(pyramid, SIDE);
        watch.time(|| {
            each_ray(|x, y| {
                let (eye, direction) = (caster.camera.eye, caster.camera.direction(x, y));
                let hit = caster.hit(eye, direction)?;
                black_box(hit.t);
                Some((hit.level, hit.index.0, hit.index.1))
            })
        })
    })
}

#[inline(always)]
fn each_ray(mut hit: impl FnMut(u32, u32) -> Option<(u32, u32, u32)>) -> Tally {
    let mut checksum = 0_u32;
    for y in 0..SIDE {
        for x in 0..SIDE {
            let leaf = hit(x, y).map_or(0, |(level, i, j)| i ^ j << 16 ^ level << 8);
            checksum = checksum.rotate_left(1) ^ leaf;
        }
    }
    Tally { checksum, units: SIDE * SIDE }
}

/// Where the following rays start.
const EYE: [i32; 3] = [-4, -3, 5];

/// Directions from there that all meet the surface, to points of its ground.
fn towards_the_ground() -> [Vec3; COUNT] {
    core::array::from_fn(|i| {
        // 0 .. 2 in both directions
        let place = |k: u32| Real::from_bits((mixed(i) >> k) as i32 & 0x1ff_ffff);
        let [x, y, z] = EYE.map(Real::from_num);
        // inside ±4
        Vec3::new((place(0) - x) >> 1, (place(32) - y) >> 1, -z >> 1)
    })
}

fn rays_to_the_ground() -> [Ray; COUNT] {
    let [x, y, z] = EYE.map(Real::from_num);
    towards_the_ground().map(|direction| Ray::new(Vec3::new(x, y, z), direction))
}

/// Cells of two profiles and the heights between which a ray passes over them: half of them meet.
fn with_boxes(work: impl FnOnce(&[(Cell, Cell, Real, Real); COUNT]) -> Tally) -> Tally {
    with_hits(|hits| {
        let mut count = 0_i32;
        work(&hits.map(|(_, f, g)| {
            count += 1;
            let height = Real::saturating_mul(f.max, g.max) + Real::from_bits((count & 3) << 14);
            (f, g, height, height + Real::from_bits((count & 4) << 12))
        }))
    })
}

#[inline(never)]
pub(super) fn box_fixed(watch: &mut Watch<'_>) -> Tally {
    with_boxes(|boxes| {
        watch.time(|| {
            let mut checksum = 0_u32;
            for (f, g, z_in, z_out) in black_box(boxes) {
                checksum = checksum.rotate_left(1) ^ u32::from(meets(f, g, *z_in, *z_out));
            }
            Tally { checksum, units: COUNT as u32 }
        })
    })
}

#[inline(never)]
pub(super) fn box_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    with_boxes(|boxes| {
        let boxes = boxes.map(|(f, g, z_in, z_out)| {
            let [z_in, z_out] = [z_in, z_out].map(|z| F::of(z.to_num::<f64>()));
            (rivals::Cell::<F>::new(&f), rivals::Cell::<F>::new(&g), z_in, z_out)
        });
        watch.time(|| {
            let mut checksum = 0_u32;
            for (f, g, z_in, z_out) in black_box(&boxes) {
                checksum = checksum.rotate_left(1) ^ u32::from(rivals::meets(f, g, *z_in, *z_out));
            }
            Tally { checksum, units: COUNT as u32 }
        })
    })
}

/// Whole walks to the deepest level.
#[inline(never)]
pub(super) fn walks(watch: &mut Watch<'_>) -> Tally {
    with_surface(|_, surface| {
        let rays = rays_to_the_ground();
        watch.over(&rays, |ray| {
            surface.intersect(&ray, Unit::ZERO).map_or(0, |hit| hit.index.0 ^ hit.index.1 << 16)
        })
    })
}

/// The same walks, which test the same boxes.
#[inline(never)]
pub(super) fn walks_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    with_pyramid(|pyramid| {
        let caster = Caster::<F>::new(pyramid, SIDE).deepest();
        let eye = EYE.map(F::of_int);
        let rays: [Vector<F>; COUNT] =
            towards_the_ground().map(|d| [d.x, d.y, d.z].map(|c| F::of(c.to_num::<f64>())));
        watch.over(&rays, |direction| {
            caster.hit(eye, direction).map_or(0, |hit| {
                black_box(hit.t);
                hit.index.0 ^ hit.index.1 << 16
            })
        })
    })
}

/// Hands the leaves that rays met, and their cells, to `work`.
pub(super) fn with_hits(work: impl FnOnce(&[(Hit, Cell, Cell); COUNT]) -> Tally) -> Tally {
    with_surface(|pyramid, surface| {
        let rays = rays_to_the_ground();
        let found = |ray: &Ray| {
            let hit = surface.intersect(ray, Unit::ZERO)?;
            let cells = pyramid.level(hit.level);
            Some((hit, *cells.get(hit.index.0 as usize)?, *cells.get(hit.index.1 as usize)?))
        };
        let Some(first) = rays.iter().find_map(found) else { return Tally::default() };
        work(&rays.map(|ray| found(&ray).unwrap_or(first)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Blind;
    use attractor::trace::Statistics;

    #[test]
    fn nearly_every_ray_meets_the_surface_after_some_boxes() {
        let tally = with_surface(|_, surface| {
            let mut statistics = Statistics::default();
            let mut hit = |ray: &Ray| surface.intersect_counted(ray, Unit::ZERO, &mut statistics).is_some();
            let hits = rays_to_the_ground().iter().filter(|ray| hit(ray)).count();
            Tally { checksum: hits as u32, units: statistics.box_tests as u32 }
        });
        assert!(tally.units > 5 * COUNT as u32 && tally.checksum > COUNT as u32 * 9 / 10, "{tally:?}");
    }

    /// The walks in floating point do the same work: they end in the same leaves.
    fn same_leaves<F: Float>() -> u32 {
        let mut same = 0;
        with_pyramid(|pyramid| {
            let core = mirror(pyramid, Size::new(SIDE, SIDE)).unwrap();
            let float = Caster::<F>::new(pyramid, SIDE);
            each_ray(|x, y| {
                let (eye, direction) = (float.camera.eye, float.camera.direction(x, y));
                let hit = float.hit(eye, direction);
                let found = hit.map(|hit| (hit.level, hit.index));
                let hit = core.hit(x, y);
                same += u32::from(found == hit.map(|hit| (hit.level, hit.index)));
                None
            })
        });
        same
    }

    #[test]
    fn the_walks_in_floating_point_end_in_the_same_leaves() {
        let [single, double] = [same_leaves::<f32>(), same_leaves::<f64>()];
        assert!(single > SIDE * SIDE - 12 && double > SIDE * SIDE - 4, "{single} {double}");
        let exact = walks(&mut Watch::new(&mut Blind, 1)).checksum;
        assert_eq!(walks_float::<f64>(&mut Watch::new(&mut Blind, 1)).checksum, exact);
    }

    #[test]
    fn boxes_in_floating_point_are_met_as_often() {
        let bits = |work: fn(&mut Watch<'_>) -> Tally| work(&mut Watch::new(&mut Blind, 1)).checksum;
        let exact = bits(box_fixed);
        assert_eq!((bits(box_float::<f32>), bits(box_float::<f64>)), (exact, exact));
    }
}
