//! Two factors, a plain sky, one sample a pixel.
//!
//! Written by `attractor export two-factors`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::fif::{Fif, Knot};
use attractor::num::{Real, Scaling, Unit, Vec3, Wide};
use attractor::trace::{Camera, Environment, Filter, Finish, HeightField, RayCaster, Sampling};
use embedded_graphics::geometry::Size;

/// Where the graph passes.
#[rustfmt::skip]
pub static F_KNOTS: [Knot; 3] = [
    Knot::lit("0", "0"),
    Knot::lit("1", "1"),
    Knot::lit("2", "0"),
];

/// One for each interval.
#[rustfmt::skip]
pub static F_VERTICAL_SCALINGS: [Scaling; 2] = [
    Scaling::lit("0.5"),
    Scaling::lit("0.5"),
];

/// Its maps: the least `N`.
pub const F_MAPS: usize = 2;

/// The degree of their polynomials: the least `D`.
pub const F_DEGREE: usize = 1;

/// The function.
///
/// # Errors
/// [`Error::Capacity`] where `N` or `D` is too small.
pub fn f<const N: usize, const D: usize>() -> Result<Fif<N, D>, Error> {
    Fif::<N, D>::interpolating(&F_KNOTS, &F_VERTICAL_SCALINGS)
}

/// Where the graph passes.
#[rustfmt::skip]
pub static G_KNOTS: [Knot; 4] = [
    Knot::lit("0", "0.5"),
    Knot::lit("1", "1"),
    Knot::lit("1.5", "0.25"),
    Knot::lit("2", "1"),
];

/// One for each interval.
#[rustfmt::skip]
pub static G_VERTICAL_SCALINGS: [Scaling; 3] = [
    Scaling::lit("0.3"),
    Scaling::lit("-0.2"),
    Scaling::lit("0.1"),
];

/// Its maps: the least `N`.
pub const G_MAPS: usize = 3;

/// The degree of their polynomials: the least `D`.
pub const G_DEGREE: usize = 2;

/// The integral of the function through the knots.
///
/// # Errors
/// [`Error::Capacity`] where `N` or `D` is too small.
pub fn g<const N: usize, const D: usize>() -> Result<Fif<N, D>, Error> {
    let f = Fif::<N, D>::interpolating(&G_KNOTS, &G_VERTICAL_SCALINGS)?;
    f.integral::<D>(Wide::ZERO)
}

/// How deep the pyramids are; none: their cells are as fine as a pixel.
/// A pyramid for each factor: 63 and 364 cells are lent on 240 pixels a side, 5 deep.
pub const DEPTH: Option<u32> = Some(5);

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("-4", "-3", "5");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("1", "1", "0.5");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0.1", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("40");

/// The camera.
///
/// # Errors
/// Those of [`Camera::new`].
pub fn camera() -> Result<Camera, Error> {
    Camera::new(EYE, LOOK_AT, UP, FIELD_OF_VIEW)
}

/// What it is made of.
pub const MATERIAL: Finish = Finish::Diffuse { ambient: Unit::lit("0.125") };

/// What surrounds it.
pub const ENVIRONMENT: Environment = Environment::Plain(Unit::lit("0"));

/// The picture of the surface; the command's seed is 1.
///
/// # Errors
/// Those of [`RayCaster::new`].
pub fn caster<'a>(surface: HeightField<'a>, size: Size, seed: u32) -> Result<RayCaster<'a>, Error> {
    let caster = RayCaster::new(surface, camera()?, size)?;
    let caster = caster.with_finish(MATERIAL)?;
    let caster = caster.with_environment(ENVIRONMENT)?;
    let _ = seed;
    caster.with_sampling(Sampling::Centre, Filter::Box)
}

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::DUSK;
