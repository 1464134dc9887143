//! A Bezier curve of degree 5 by de Casteljau's maps.
//!
//! Written by `attractor export --gallery patch-bezier`.

use attractor::Error;
use attractor::draw::{Gradient, gradients};
use attractor::num::Near;
use attractor::patch::{Barycentric, ProjectedCurve};
use attractor::plane::Point2;
use attractor_gallery::{Named, Pencil};

/// The columns of both maps.
#[rustfmt::skip]
pub static COLUMNS: [[Near; 6]; 12] = [
    [Near::lit("1"), Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0")],
    [Near::lit("0.5"), Near::lit("0.5"), Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0")],
    [Near::lit("0.25"), Near::lit("0.5"), Near::lit("0.25"), Near::lit("0"), Near::lit("0"), Near::lit("0")],
    [Near::lit("0.125"), Near::lit("0.375"), Near::lit("0.375"), Near::lit("0.125"), Near::lit("0"), Near::lit("0")],
    [Near::lit("0.0625"), Near::lit("0.25"), Near::lit("0.375"), Near::lit("0.25"), Near::lit("0.0625"), Near::lit("0")],
    [Near::lit("0.03125"), Near::lit("0.15625"), Near::lit("0.3125"), Near::lit("0.3125"), Near::lit("0.15625"), Near::lit("0.03125")],
    [Near::lit("0.03125"), Near::lit("0.15625"), Near::lit("0.3125"), Near::lit("0.3125"), Near::lit("0.15625"), Near::lit("0.03125")],
    [Near::lit("0"), Near::lit("0.0625"), Near::lit("0.25"), Near::lit("0.375"), Near::lit("0.25"), Near::lit("0.0625")],
    [Near::lit("0"), Near::lit("0"), Near::lit("0.125"), Near::lit("0.375"), Near::lit("0.375"), Near::lit("0.125")],
    [Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0.25"), Near::lit("0.5"), Near::lit("0.25")],
    [Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0.5"), Near::lit("0.5")],
    [Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("1")],
];

/// Where it begins and ends.
#[rustfmt::skip]
pub static ENDS: [[Near; 6]; 2] = [
    [Near::lit("1"), Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0")],
    [Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("0"), Near::lit("1")],
];

/// The control points.
#[rustfmt::skip]
pub static POINTS: [Point2; 6] = [
    Point2::lit("0", "0"),
    Point2::lit("0.2", "1.2"),
    Point2::lit("1.4", "1.3"),
    Point2::lit("-0.4", "-0.6"),
    Point2::lit("0.8", "-0.7"),
    Point2::lit("1", "0.4"),
];

/// How many binary digits a parameter has.
pub const LEVELS: u32 = 8;

/// The curve.
///
/// # Errors
/// None: the command has built it.
pub fn curve() -> Result<ProjectedCurve<2, 6>, Error> {
    let (left, right) = COLUMNS.split_at(6);
    let map = |columns: &[_]| {
        let mut all = [[Near::ZERO; 6]; 6];
        all.copy_from_slice(columns);
        Barycentric::from_columns(all)
    };
    ProjectedCurve::with_ends([map(left)?, map(right)?], ENDS)
}

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::MOSS;

/// How it is coloured.
pub const PENCIL: Pencil = Pencil { palette: Named::Moss, closed: false };
