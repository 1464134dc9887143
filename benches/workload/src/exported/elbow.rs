//! A random elbow, spectral exponent 2: Brownian in both coordinates.
//!
//! Written by `attractor export --gallery elbow`.

use attractor::Error;
use attractor::curve::{Elbow, Stop};
use attractor::draw::{Gradient, gradients};
use attractor::num::{Real, Unit};
use attractor::plane::Point2;
use attractor_gallery::{Named, Pencil};

/// The spectral exponent.
pub const BETA: Real = Real::lit("2");

/// The standard deviation of the first offset, for each length of a segment.
pub const DEVIATION: Unit = Unit::lit("0.3");

/// Selects one of all curves.
pub const SEED: u64 = 7;

/// The law.
///
/// # Errors
/// None: those of [`Elbow`]'s constructors do not occur with these numbers.
pub fn law() -> Result<Elbow, Error> {
    Elbow::new(DEVIATION, BETA, SEED)
}

/// What it goes through.
#[rustfmt::skip]
pub static KNOTS: [Point2; 2] = [
    Point2::lit("0", "0"),
    Point2::lit("1", "0"),
];

/// Where it stops; none: at the length of a pixel.
pub const STOP: Option<Stop> = None;

/// Whether it is the graph of a function, stretched over the display.
pub const GRAPH: bool = false;

/// Whether what it encloses, or what lies below a graph, has a ground: a bit of lent memory for each pixel.
pub const FILLED: bool = false;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::FIRE;

/// How its colours change along it.
pub const PENCIL: Pencil = Pencil { palette: Named::Fire, closed: false };
