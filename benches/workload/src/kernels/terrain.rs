//! Surfaces by subdivision: heights on demand and streamed, rays over 64 x 64 cells.

use core::ops::ControlFlow;

use attractor::num::{RandomField, Real, Unit, Vec3};
use attractor::terrain::{Heights, InnerGeometry, LEVELS, Law, PlaneToLine, Rows};
use attractor::trace::{DeepTerrain, HeightRange, Ray, Surface, Terrain};

use super::watch::{Tally, Watch};
use crate::inputs::mixed;

/// A summit among knots: 2 x 2 cells.
static KNOTS: [Real; 9] = [
    Real::lit("-0.25"),
    Real::lit("-0.2"),
    Real::lit("-0.25"),
    Real::lit("-0.2"),
    Real::lit("0.5"),
    Real::lit("-0.2"),
    Real::lit("-0.25"),
    Real::lit("-0.2"),
    Real::lit("-0.25"),
];

/// 64 x 64 cells.
const LEVEL: u32 = 5;
const SIDE: u32 = (2 << LEVEL) + 1;
const HEIGHTS: usize = (SIDE * SIDE) as usize;
const COUNT: usize = 64;

fn with_function(work: impl FnOnce(&PlaneToLine<'_>) -> Tally) -> Tally {
    let law = Law::new(const { Unit::lit("0.24") }, const { Unit::lit("0.9") });
    let function =
        law.and_then(|law| PlaneToLine::new(Heights::new(3, 3, &KNOTS)?, law, RandomField::new(2)));
    function.map_or(Tally::default(), |function| work(&function))
}

/// Points of level 12 that are of no coarser one.
#[inline(never)]
pub(super) fn height(watch: &mut Watch<'_>) -> Tally {
    with_function(|function| {
        let points: [_; COUNT] = core::array::from_fn(|i| {
            let odd = |bits: u64| bits as u32 & ((2 << 12) - 1) | 1;
            function.point(12.min(LEVELS), odd(mixed(i)), odd(mixed(i) >> 32))
        });
        watch.over(&points, |[u, v]| function.height(u, v).to_bits() as u32)
    })
}

/// All rows of 65 x 65 heights.
#[inline(never)]
pub(super) fn row(watch: &mut Watch<'_>) -> Tally {
    with_function(|function| {
        let mut memory = [Real::ZERO; Rows::<RandomField>::words(2, LEVEL)];
        watch.time(|| {
            let mut tally = Tally::default();
            let Ok(mut rows) = Rows::new(function, LEVEL, &mut memory) else { return tally };
            while let Some(row) = rows.next_row() {
                tally.checksum = tally.checksum.rotate_left(1) ^ row.last().map_or(0, |h| h.to_bits() as u32);
                tally.units += row.len() as u32;
            }
            tally
        })
    })
}

const OVER: [[Real; 2]; 2] = [[Real::lit("-1"), Real::lit("1")]; 2];

/// First crossings of rays from one eye to all parts of the ground.
fn cast(watch: &mut Watch<'_>, surface: &impl Surface) -> Tally {
    let eye = const { Vec3::lit("-0.9", "-2.7", "1.35") };
    let rays: [_; COUNT] = core::array::from_fn(|i| {
        let place = |k: u32| Real::from_bits((mixed(i) >> k) as i32 >> 7);
        Ray::new(eye, Vec3::new((place(0) - eye.x) / 2, (place(32) - eye.y) / 2, -eye.z / 2))
    });
    watch.over(&rays, |ray| {
        let mut first = 0;
        surface.cross(&ray, Unit::ZERO, &mut |crossing| {
            first = crossing.t.to_bits() as u32;
            ControlFlow::Break(())
        });
        first
    })
}

#[inline(never)]
pub(super) fn ray(watch: &mut Watch<'_>) -> Tally {
    with_function(|function| {
        let mut heights = [Real::ZERO; HEIGHTS];
        let mut memory = [Real::ZERO; Rows::<RandomField>::words(2, LEVEL)];
        let written = Rows::new(function, LEVEL, &mut memory).and_then(|rows| rows.write(&mut heights));
        let mut ranges = [HeightRange::default(); Terrain::ranges(SIDE, SIDE)];
        let terrain = written
            .and_then(|()| Heights::new(SIDE, SIDE, &heights))
            .and_then(|heights| Terrain::new(heights, InnerGeometry::Bilinear, OVER, &mut ranges));
        terrain.map_or(Tally::default(), |terrain| cast(watch, &terrain))
    })
}

#[inline(never)]
pub(super) fn ray_alone(watch: &mut Watch<'_>) -> Tally {
    with_function(|function| {
        DeepTerrain::new(function, LEVEL, OVER).map_or(Tally::default(), |terrain| cast(watch, &terrain))
    })
}
