//! G x G with Phong's highlights, the normals of each pixel integrated.
//!
//! Written by `attractor export --gallery figure-6-gg-phong-filtered`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::fif::{Fif, Knot};
use attractor::num::{Real, Scaling, Unit, Vec3, Wide};
use attractor::trace::{
    Camera, Environment, Filter, Finish, HeightField, Light, Quality, RayCaster, Sampling,
};
use attractor_gallery::Named;
use embedded_graphics::geometry::Size;

/// Where the graph passes.
#[rustfmt::skip]
pub static KNOTS: [Knot; 3] = [
    Knot::lit("0", "0"),
    Knot::lit("1", "1"),
    Knot::lit("2", "0"),
];

/// One for each interval.
#[rustfmt::skip]
pub static VERTICAL_SCALINGS: [Scaling; 2] = [
    Scaling::lit("0.85"),
    Scaling::lit("-0.85"),
];

/// Its maps: the least `N`.
pub const MAPS: usize = 2;

/// The degree of their polynomials: the least `D`.
pub const DEGREE: usize = 2;

/// The integral of the function through the knots.
///
/// # Errors
/// [`Error::Capacity`] where `N` or `D` is too small.
pub fn factor<const N: usize, const D: usize>() -> Result<Fif<N, D>, Error> {
    let f = Fif::<N, D>::interpolating(&KNOTS, &VERTICAL_SCALINGS)?;
    f.integral::<D>(Wide::ZERO)
}

/// How deep the pyramids are; none: their cells are half as wide as a pixel.
/// One pyramid serves for both factors: 511 cells, and as many spreads are lent on 240 pixels a side, 8 deep.
pub const DEPTH: Option<u32> = None;

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("-4.4", "-3.7", "2.8");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("1", "1", "0.35");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("22");

/// The camera.
///
/// # Errors
/// Those of [`Camera::new`].
pub fn camera() -> Result<Camera, Error> {
    Camera::new(EYE, LOOK_AT, UP, FIELD_OF_VIEW)
}

/// Towards the light.
pub const LIGHT: Vec3 = Vec3::lit("-1", "-2", "3");

/// What it is made of.
pub const MATERIAL: Finish = Finish::Phong {
    ambient: Unit::lit("0.125"),
    diffuse: Unit::lit("0.5"),
    specular: Unit::lit("0.375"),
    shininess: 32,
};

/// What surrounds it.
pub const ENVIRONMENT: Environment =
    Environment::Gradient { zenith: Unit::lit("0.5"), horizon: Unit::lit("0.12"), nadir: Unit::lit("0") };

/// The picture of the surface; the command's seed is 1.
///
/// # Errors
/// Those of [`RayCaster::new`].
pub fn caster<'a>(surface: HeightField<'a>, size: Size, seed: u32) -> Result<RayCaster<'a>, Error> {
    let caster = RayCaster::new(surface, camera()?, size)?;
    let caster = caster.with_finish(MATERIAL)?;
    let caster = caster.with_environment(ENVIRONMENT)?;
    let caster = caster.with_light(Light::new(LIGHT)?);
    caster.with_sampling(Sampling::Jittered { n: 4, seed }, Filter::Box)
}

/// How fine the normals of a pixel are integrated.
pub const QUALITY: Quality = Quality::Coarse;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::OCEAN;

/// The same by its name.
pub const NAMED: Named = Named::Ocean;
