//! Takagi's curve by three control points (figure 2c).
//!
//! Written by `attractor export --gallery patch-takagi`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::num::Near;
use attractor::patch::{Barycentric, ProjectedCurve};
use attractor::plane::Point2;
use attractor_gallery::{Named, Pencil};

/// The columns of both maps.
#[rustfmt::skip]
pub static COLUMNS: [[Near; 3]; 6] = [
    [Near::lit("1"), Near::lit("0"), Near::lit("0")],
    [Near::lit("0.25"), Near::lit("1"), Near::lit("-0.25")],
    [Near::lit("0"), Near::lit("1"), Near::lit("0")],
    [Near::lit("0"), Near::lit("1"), Near::lit("0")],
    [Near::lit("-0.25"), Near::lit("1"), Near::lit("0.25")],
    [Near::lit("0"), Near::lit("0"), Near::lit("1")],
];

/// Where it begins and ends.
#[rustfmt::skip]
pub static ENDS: [[Near; 3]; 2] = [
    [Near::lit("1"), Near::lit("0"), Near::lit("0")],
    [Near::lit("0"), Near::lit("0"), Near::lit("1")],
];

/// The control points.
#[rustfmt::skip]
pub static POINTS: [Point2; 3] = [
    Point2::lit("0", "0"),
    Point2::lit("0.5", "0.5"),
    Point2::lit("1", "0"),
];

/// How many binary digits a parameter has.
pub const LEVELS: u32 = 12;

/// The curve.
///
/// # Errors
/// None: the command has built it.
pub fn curve() -> Result<ProjectedCurve<2, 3>, Error> {
    let (left, right) = COLUMNS.split_at(3);
    let map = |columns: &[_]| {
        let mut all = [[Near::ZERO; 3]; 3];
        all.copy_from_slice(columns);
        Barycentric::from_columns(all)
    };
    ProjectedCurve::with_ends([map(left)?, map(right)?], ENDS)
}

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::OCEAN;

/// How it is coloured.
pub const PENCIL: Pencil = Pencil { palette: Named::Ocean, closed: false };
