//! As `nopanic`, for height fields under the ray caster, plain and with filtered normals. An image of its
//! own, so that each fits the flash of a Cortex-M0.
#![no_std]
#![no_main]

use attractor::Error;
use attractor::fif::{Cell, Fif, Knot, Moments, Pyramid, Spread, Sum, Sums};
use attractor::num::{Near, Real, Scaling, Unit, Vec3, Wide};
use attractor::patch::{HeightMoments, Mask, Sheet, SlopeMoments};
use attractor::plane::Field;
use attractor::trace::{
    Camera, Environment, Filter, FilteredCaster, FilteredPatch, Finish, HeightField, Light, PatchCaster,
    PatchSurface, Quality, Ray, RayCaster, Sampling, Statistics,
};
use attractor_cortex_m::{Wire, entry, semihosting};
use core::hint::black_box as bb;
use embedded_graphics::pixelcolor::Rgb565;

attractor_cortex_m::never_panics!();

#[entry]
fn main() -> ! {
    // what is refused is refused: only panics count
    let _ = bb(rays());
    // linked everywhere, and run where there is stack for the moments
    if bb(cfg!(roomy)) {
        let _ = bb(lattice());
    }
    semihosting::process::exit(0)
}

fn rays() -> Result<(), Error> {
    let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    let f = Fif::<2, 1>::interpolating(bb(&knots[..]), bb(&[Scaling::from_bits(1 << 30); 2][..]))?;
    let mut memory = [Cell::ZERO; Pyramid::cells(2, 4)];
    let pyramid = Pyramid::new(&f, bb(4), &mut memory)?;
    let surface = HeightField::new(&pyramid, &pyramid)?;
    bb((surface.depth(), surface.heights()));
    let v = Vec3::new(bb(Real::ONE), bb(Real::ONE), bb(Real::ONE));
    if let Some(hit) = surface.intersect(&Ray::new(v, v), bb(Unit::ZERO)) {
        bb(hit.normal());
    }
    bb(surface.intersect_counted(&Ray::new(v, v), bb(Unit::ZERO), &mut Statistics::default()));
    let camera = Camera::new(v, bb(v), bb(v), bb(Real::ONE))?;
    let caster = RayCaster::new(surface, camera, bb(Wire::<Rgb565>::SIZE))?
        .with_finish(bb(Finish::PHONG))?
        .with_light(Light::new(v)?)
        .with_environment(bb(Environment::SKY))?
        .with_sampling(bb(Sampling::Centre), bb(Filter::Box))?;
    bb((caster.row(bb(0), bb(0)..bb(100)).last(), caster.row(bb(1), bb(0)..bb(100)).nth(bb(5))));
    bb((caster.hit(bb(0), bb(0)), caster.statistics()));
    let mut spreads = [Spread::ZERO; Pyramid::cells(2, 4)];
    let moments = Moments::new(&f, &pyramid, &mut spreads)?;
    bb((moments.over(bb(Wide::ZERO), bb(Wide::ONE)), f.spread_at(bb(9), bb(5))?));
    let mut places = [Sum::ZERO; Sums::places(2, 4)];
    let sums = Sums::new(&f, bb(4), &mut places)?;
    bb(sums.over(bb(Wide::ZERO), bb(Wide::ONE)));
    let filtered = FilteredCaster::new(caster, &sums, &sums, bb(Quality::Fine))?;
    bb((filtered.row(bb(0), bb(0)..bb(100)).last(), filtered.found(bb(3), bb(4))));
    Ok(())
}

/// A lattice and its moments; what they take is given back before a picture is drawn.
fn lattice() -> Result<(), Error> {
    let mask = Mask::from_numbers(bb(&[Near::DELTA; 21]))?;
    let heights = bb([Real::ONE; 25]);
    let sheet = Sheet::<Mask, 16>::new(&mask, bb(&heights[..]), bb(2))?;
    moments(&mask, &sheet)?;
    let of_slopes = SlopeMoments::new(&mask)?;
    let caster = seen(sheet)?;
    bb(caster.row(bb(0), bb(0)..bb(100)).last());
    let filtered = FilteredPatch::new(caster, &of_slopes, bb(Quality::Fine));
    bb((filtered.row(bb(0), bb(0)..bb(100)).last(), filtered.found(bb(3), bb(4))));
    Ok(())
}

#[inline(never)]
fn moments(mask: &Mask, sheet: &Sheet<'_, Mask, 16>) -> Result<(), Error> {
    let part = sheet.part(bb([3, 4]), bb(3));
    let (of_heights, of_slopes) = (HeightMoments::new(mask)?, SlopeMoments::new(mask)?);
    bb((of_heights.over(&part, bb(16)), of_heights.mean(&part), of_slopes.over(&part, bb(16))));
    Ok(())
}

#[inline(never)]
fn seen<'a>(sheet: Sheet<'a, Mask, 16>) -> Result<PatchCaster<'a, Mask, 16>, Error> {
    let v = Vec3::new(bb(Real::ONE), bb(Real::ONE), bb(Real::ONE));
    let camera = Camera::new(v, bb(v), bb(v), bb(Real::ONE))?;
    PatchCaster::new(PatchSurface::new(sheet, bb(5))?, camera, bb(Wire::<Rgb565>::SIZE))?
        .with_finish(bb(Finish::PHONG))?
        .with_light(Light::new(v)?)
        .with_environment(bb(Environment::SKY))?
        .with_sampling(bb(Sampling::Centre), bb(Filter::Box))
}
