//! The product of two Takagi curves: every joining line is the boundary again (figure 3).
//!
//! Written by `attractor export --gallery patch-joinings`.

use attractor::Error;
use attractor::num::{Near, Real, Vec3};
use attractor::patch::{Sheet, Tensor, standard_curve};
use attractor_gallery::{PatchSurfacePicture, Standpoint};

/// The numbers of its maps.
#[rustfmt::skip]
pub static NUMBERS: [Near; 8] = [
    Near::lit("1"),
    Near::lit("-0.25"),
    Near::lit("1"),
    Near::lit("-0.25"),
    Near::lit("1"),
    Near::lit("-0.25"),
    Near::lit("1"),
    Near::lit("-0.25"),
];

/// The control heights.
#[rustfmt::skip]
pub static HEIGHTS: [Real; 9] = [
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0.25"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
    Real::lit("0"),
];

/// Cells along a side.
pub const CELLS: u32 = 1;

/// How high 1 is, on a square from -1 to 1.
pub const HEIGHT: Real = Real::lit("2");

/// What refines the heights.
///
/// # Errors
/// None: the command has built it.
pub fn scheme() -> Result<Tensor<2, 3, 3, 9>, Error> {
    let [a, b, c, d, e, f, g, h] = NUMBERS;
    Tensor::new(standard_curve([a, b], [c, d])?, standard_curve([e, f], [g, h])?)
}

/// The surface over the unit square.
///
/// # Errors
/// None: the command has built it.
pub fn sheet(scheme: &Tensor<2, 3, 3, 9>) -> Result<Sheet<'_, Tensor<2, 3, 3, 9>, 9>, Error> {
    Sheet::new(scheme, &HEIGHTS, CELLS)
}

/// The camera.
pub const VIEW: Standpoint = Standpoint {
    eye: Vec3::lit("-2.4", "-3.3", "2.5"),
    look_at: Vec3::lit("0", "0", "0.2"),
    up: Vec3::lit("0", "0", "1"),
    field_of_view: Real::lit("35"),
};

/// Towards the sun.
pub const SUN: Vec3 = Vec3::lit("-3", "1", "3");

/// The picture.
///
/// # Errors
/// None: the command has built it.
pub fn picture(scheme: &Tensor<2, 3, 3, 9>) -> Result<PatchSurfacePicture<'_, Tensor<2, 3, 3, 9>, 9>, Error> {
    Ok(PatchSurfacePicture { sheet: sheet(scheme)?, height: HEIGHT, view: VIEW, sun: SUN, samples: 1 })
}
