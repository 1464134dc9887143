//! Carpenter's line to plane, two variables, offset 0.3.
//!
//! Written by `attractor export --gallery carpenter-2`.

use attractor::Error;
use attractor::curve::{Stop, TwoVariable};
use attractor::draw::{Gradient, gradients};
use attractor::num::Unit;
use attractor::plane::Point2;
use attractor_gallery::{Named, Pencil};

/// The offset.
pub const OFFSET: Unit = Unit::lit("0.3");

/// Selects one of all curves.
pub const SEED: u64 = 1980;

/// The law.
///
/// # Errors
/// None: those of [`TwoVariable`]'s constructors do not occur with these numbers.
pub fn law() -> Result<TwoVariable, Error> {
    TwoVariable::new(OFFSET, SEED)
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
pub const PALETTE: Gradient<9> = gradients::MOSS;

/// How its colours change along it.
pub const PENCIL: Pencil = Pencil { palette: Named::Moss, closed: false };
