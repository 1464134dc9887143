//! Carpenter's figure 12: a line from 0 to 1, extrapolated to 4.
//!
//! Written by `attractor export --gallery extrapolation`.

use attractor::Error;
use attractor::curve::{LineToLine, Stop};
use attractor::draw::{Gradient, gradients};
use attractor::num::{Real, Unit};
use attractor::plane::Point2;
use attractor_gallery::{Named, Pencil};

/// The spectral exponent.
pub const BETA: Real = Real::lit("2.4");

/// The first offset.
pub const OFFSET: Unit = Unit::lit("0.2");

/// Selects one of all curves.
pub const SEED: u64 = 12;

/// The law.
///
/// # Errors
/// None: those of [`LineToLine`]'s constructors do not occur with these numbers.
pub fn law() -> Result<LineToLine, Error> {
    LineToLine::from_spectrum(OFFSET, BETA, SEED)
}

/// What it goes through.
#[rustfmt::skip]
pub static KNOTS: [Point2; 5] = [
    Point2::lit("0", "0"),
    Point2::lit("1", "0.1"),
    Point2::lit("2", "-0.09204686"),
    Point2::lit("3", "-0.89350426"),
    Point2::lit("4", "-0.46046376"),
];

/// Where it stops; none: at the length of a pixel.
pub const STOP: Option<Stop> = None;

/// Whether it is the graph of a function, stretched over the display.
pub const GRAPH: bool = true;

/// Whether what it encloses, or what lies below a graph, has a ground: a bit of lent memory for each pixel.
pub const FILLED: bool = true;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::MOSS;

/// How its colours change along it.
pub const PENCIL: Pencil = Pencil { palette: Named::Moss, closed: false };
