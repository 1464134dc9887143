//! A patch whose points divide segments: sharp edges, as rock has them (figure 1).
//!
//! Written by `attractor export --gallery patch-rock`.

use attractor::Error;
use attractor::num::{Near, Real, Vec3};
use attractor::patch::{Patch, Sheet};
use attractor_gallery::{PatchSurfacePicture, Standpoint};

/// The numbers of its maps.
#[rustfmt::skip]
pub static NUMBERS: [Near; 72] = [
    Near::lit("0.62"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.65"),
    Near::lit("0.4"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.34"),
    Near::lit("0"),
    Near::lit("0.791"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.8075"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.22"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.637"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.248"),
    Near::lit("0.4404"),
    Near::lit("0"),
    Near::lit("0.0836"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.4092"),
    Near::lit("0.11594"),
    Near::lit("0"),
    Near::lit("0.22406"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.077"),
    Near::lit("0"),
    Near::lit("0.323"),
    Near::lit("0.39"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.06545"),
    Near::lit("0"),
    Near::lit("0.429"),
    Near::lit("0.221"),
];

/// The control heights.
#[rustfmt::skip]
pub static HEIGHTS: [Real; 9] = [
    Real::lit("0.1"),
    Real::lit("0.35"),
    Real::lit("0"),
    Real::lit("0.3"),
    Real::lit("1"),
    Real::lit("0.45"),
    Real::lit("0.05"),
    Real::lit("0.6"),
    Real::lit("0.15"),
];

/// Cells along a side.
pub const CELLS: u32 = 1;

/// How high 1 is, on a square from -1 to 1.
pub const HEIGHT: Real = Real::lit("1.1");

/// What refines the heights.
///
/// # Errors
/// None: the command has built it.
pub fn scheme() -> Result<Patch<2, 3, 9>, Error> {
    Patch::standard(&NUMBERS)
}

/// The surface over the unit square.
///
/// # Errors
/// None: the command has built it.
pub fn sheet(scheme: &Patch<2, 3, 9>) -> Result<Sheet<'_, Patch<2, 3, 9>, 9>, Error> {
    Sheet::new(scheme, &HEIGHTS, CELLS)
}

/// The camera.
pub const VIEW: Standpoint = Standpoint {
    eye: Vec3::lit("-2.4", "-3.3", "2.5"),
    look_at: Vec3::lit("0", "0", "0.15"),
    up: Vec3::lit("0", "0", "1"),
    field_of_view: Real::lit("35"),
};

/// Towards the sun.
pub const SUN: Vec3 = Vec3::lit("-3", "1", "3");

/// The picture.
///
/// # Errors
/// None: the command has built it.
pub fn picture(scheme: &Patch<2, 3, 9>) -> Result<PatchSurfacePicture<'_, Patch<2, 3, 9>, 9>, Error> {
    Ok(PatchSurfacePicture { sheet: sheet(scheme)?, height: HEIGHT, view: VIEW, sun: SUN, samples: 1 })
}
