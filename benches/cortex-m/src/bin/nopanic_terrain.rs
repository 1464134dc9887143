//! As `nopanic`, for terrain by subdivision: heights, rows, triangles, patches, and both kinds under rays. An
//! image of its own, so that each fits the flash of a Cortex-M0.
#![no_std]
#![no_main]

use core::hint::black_box as bb;
use core::ops::ControlFlow;

use attractor::Error;
use attractor::num::{RandomField, Real, Unit, Vec3};
use attractor::terrain::{
    Heights, InnerGeometry, Law, Magnification, PlaneToLine, Rows, Seam, Seamed, Side, Triangles,
};
use attractor::trace::{DeepTerrain, HeightRange, Ray, Surface, Terrain};
use attractor_cortex_m::{entry, semihosting};

attractor_cortex_m::never_panics!();

#[entry]
fn main() -> ! {
    // what is refused is refused: only panics count
    let _ = bb(terrain());
    semihosting::process::exit(0)
}

/// Surfaces by subdivision: heights, rows, triangles, patches, and both kinds under rays.
fn terrain() -> Result<(), Error> {
    let knots = bb([Real::ONE; 9]);
    let law = Law::new(bb(Unit::DELTA), bb(Unit::DELTA))?;
    let seams = [Seam::new(bb(1), bb([0, 0]), bb([0, 1]))?];
    let random = Seamed::new(RandomField::new(bb(1)), &seams);
    let knots = Heights::new(bb(3), bb(3), &knots)?.with_origin(bb(1), bb(1))?;
    let function = PlaneToLine::new(knots, law, random)?;
    let [u, v] = function.point(bb(3), bb(1), bb(2));
    bb((function.height(u, v), law.offset(bb(1)), law.reach(bb(1), bb(2)), knots.range()));
    bb(function.extrapolated(bb(Side::West), &mut [Real::ZERO; 3]))?;
    let near = Magnification { eye: bb([u; 3]), length: bb(Unit::DELTA), most: bb(4) };
    bb(Triangles::new(&function, bb(1), bb([0, 0]), &near)?.last());
    let (mut rows, mut heights) = ([Real::ZERO; 64], [Real::ZERO; 81]);
    Rows::of(&function, bb(1), [bb(0)..bb(2), bb(0)..bb(2)], bb(2), &mut rows)?.write(&mut heights)?;
    Rows::new(&function, bb(2), &mut rows)?.write(&mut heights)?;
    let heights = Heights::new(bb(9), bb(9), &heights)?;
    let patch = bb(InnerGeometry::BSpline).patch(&heights, bb(1), bb(2));
    bb((
        patch.height(bb(Unit::DELTA), Unit::DELTA),
        patch.slopes(bb(Unit::DELTA), Unit::DELTA),
        patch.range(),
    ));
    let over = bb([[Real::ZERO, Real::ONE]; 2]);
    crossed(&DeepTerrain::new(&function, bb(3), over)?);
    let mut ranges = [HeightRange::default(); Terrain::ranges(9, 9)];
    let land = Terrain::new(heights, bb(InnerGeometry::Ferguson), over, &mut ranges)?;
    crossed(&land);
    crossed(&land.with_plain(bb(Real::ZERO)));
    Ok(())
}

/// All that a caster asks of a surface.
fn crossed(surface: &impl Surface) {
    let ray = Ray::new(bb(Vec3::X), bb(Vec3::Z));
    let mut last = None;
    surface.cross(&ray, bb(Unit::DELTA), &mut |crossing| {
        last = Some(crossing);
        bb(ControlFlow::Continue(()))
    });
    bb(last.map(|crossing| surface.point(&ray, bb(Unit::DELTA), &crossing, bb(true))));
    bb((surface.value(bb(Vec3::X)), surface.extent(), surface.ball(), surface.error()));
}
