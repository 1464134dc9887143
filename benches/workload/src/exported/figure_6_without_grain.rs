//! Beside figure 6: a fractal surface that is no product, and has no grain, as a mirror of a checkerboard.
//!
//! Written by `attractor export --gallery figure-6-without-grain`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::num::{Near, Real, Unit, Vec3};
use attractor::patch::{Mask, Sheet};
use attractor::trace::{Environment, Finish, Quality};
use attractor_gallery::{LatticePicture, Standpoint};

/// The numbers of its maps.
#[rustfmt::skip]
pub static NUMBERS: [Near; 21] = [
    Near::lit("0"),
    Near::lit("-0.049804688"),
    Near::lit("0"),
    Near::lit("-0.049804688"),
    Near::lit("0"),
    Near::lit("-0.049804688"),
    Near::lit("0.25"),
    Near::lit("-0.049804688"),
    Near::lit("0"),
    Near::lit("0.599609375"),
    Near::lit("0"),
    Near::lit("-0.049804688"),
    Near::lit("0.25"),
    Near::lit("0.599609375"),
    Near::lit("0.25"),
    Near::lit("-0.049804688"),
    Near::lit("0"),
    Near::lit("-0.049804688"),
    Near::lit("0"),
    Near::lit("-0.049804688"),
    Near::lit("0"),
];

/// The control heights.
#[rustfmt::skip]
pub static HEIGHTS: [Real; 81] = [
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0.07"),
    Real::lit("0.1154"),
    Real::lit("0.07"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0.07"),
    Real::lit("0.228"),
    Real::lit("0.3077"),
    Real::lit("0.228"),
    Real::lit("0.07"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0.1154"),
    Real::lit("0.3077"),
    Real::lit("0.5"),
    Real::lit("0.3077"),
    Real::lit("0.1154"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0.07"),
    Real::lit("0.228"),
    Real::lit("0.3077"),
    Real::lit("0.228"),
    Real::lit("0.07"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0.07"),
    Real::lit("0.1154"),
    Real::lit("0.07"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
];

/// Cells along a side.
pub const CELLS: u32 = 6;

/// What refines the heights.
///
/// # Errors
/// None: the command has built it.
pub fn scheme() -> Result<Mask, Error> {
    Mask::from_numbers(&NUMBERS)
}

/// The surface over the unit square.
///
/// # Errors
/// None: the command has built it.
pub fn sheet(scheme: &Mask) -> Result<Sheet<'_, Mask, 16>, Error> {
    Sheet::new(scheme, &HEIGHTS, CELLS)
}

/// The camera.
pub const VIEW: Standpoint = Standpoint {
    eye: Vec3::lit("-2.2", "-1.85", "1.4"),
    look_at: Vec3::lit("0.5", "0.5", "0.17"),
    up: Vec3::lit("0", "0", "1"),
    field_of_view: Real::lit("20.5"),
};

/// What it is made of.
pub const MATERIAL: Finish = Finish::Mirror;

/// What surrounds it.
pub const ENVIRONMENT: Environment = Environment::Checkerboard {
    bright: Unit::lit("0.9375"),
    dark: Unit::lit("0.1875"),
    horizon: Unit::lit("0.5"),
    scale: Real::lit("0.3"),
    fade: Unit::lit("0.6"),
};

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::DUSK;

/// The picture.
///
/// # Errors
/// None: the command has built it.
pub fn picture(scheme: &Mask) -> Result<LatticePicture<'_, Gradient<9>>, Error> {
    Ok(LatticePicture {
        sheet: sheet(scheme)?,
        view: VIEW,
        material: MATERIAL,
        environment: ENVIRONMENT,
        light: None,
        samples: 4,
        quality: Some(Quality::Finest),
        palette: PALETTE,
    })
}
