//! A patch between two parabolas and two Takagi curves, its diagonal drawn up (figure 4).
//!
//! Written by `attractor export --gallery patch-diagonal`.

use attractor::Error;
use attractor::num::{Near, Real, Vec3};
use attractor::patch::{Patch, Sheet};
use attractor_gallery::{PatchSurfacePicture, Standpoint};

/// The numbers of its maps.
#[rustfmt::skip]
pub static NUMBERS: [Near; 72] = [
    Near::lit("0.375"),
    Near::lit("-0.125"),
    Near::lit("-0.125"),
    Near::lit("0.375"),
    Near::lit("0.25"),
    Near::lit("-0.25"),
    Near::lit("-0.25"),
    Near::lit("0.25"),
    Near::lit("0"),
    Near::lit("0.375"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("-0.125"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("-0.125"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.375"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0.25"),
    Near::lit("-0.25"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("-0.25"),
    Near::lit("0.25"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("0"),
    Near::lit("-0.00625"),
    Near::lit("0.375"),
    Near::lit("-0.09375"),
    Near::lit("0.1875"),
    Near::lit("-0.1875"),
    Near::lit("-0.03125"),
    Near::lit("-0.125"),
    Near::lit("-0.06875"),
    Near::lit("-0.09375"),
    Near::lit("0.375"),
    Near::lit("0.15375"),
    Near::lit("-0.1875"),
    Near::lit("0.1875"),
    Near::lit("0.09125"),
    Near::lit("-0.125"),
    Near::lit("-0.03125"),
    Near::lit("-0.03125"),
    Near::lit("-0.125"),
    Near::lit("0.09125"),
    Near::lit("0.1875"),
    Near::lit("-0.1875"),
    Near::lit("0.15375"),
    Near::lit("0.375"),
    Near::lit("-0.09375"),
    Near::lit("-0.06875"),
    Near::lit("-0.125"),
    Near::lit("-0.03125"),
    Near::lit("-0.1875"),
    Near::lit("0.1875"),
    Near::lit("-0.09375"),
    Near::lit("0.375"),
    Near::lit("-0.00625"),
];

/// The control heights.
#[rustfmt::skip]
pub static HEIGHTS: [Real; 9] = [
    Real::lit("0"),
    Real::lit("0.5"),
    Real::lit("0"),
    Real::lit("0.5"),
    Real::lit("0.9"),
    Real::lit("0.5"),
    Real::lit("0"),
    Real::lit("0.5"),
    Real::lit("0"),
];

/// Cells along a side.
pub const CELLS: u32 = 1;

/// How high 1 is, on a square from -1 to 1.
pub const HEIGHT: Real = Real::lit("0.9");

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
    eye: Vec3::lit("3.1", "-3.5", "2.45"),
    look_at: Vec3::lit("0", "0", "0.35"),
    up: Vec3::lit("0", "0", "1"),
    field_of_view: Real::lit("35"),
};

/// Towards the sun.
pub const SUN: Vec3 = Vec3::lit("-1", "-3", "3");

/// The picture.
///
/// # Errors
/// None: the command has built it.
pub fn picture(scheme: &Patch<2, 3, 9>) -> Result<PatchSurfacePicture<'_, Patch<2, 3, 9>, 9>, Error> {
    Ok(PatchSurfacePicture { sheet: sheet(scheme)?, height: HEIGHT, view: VIEW, sun: SUN, samples: 1 })
}
