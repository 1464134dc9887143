//! Self-similar, as long as its parameter says.
//!
//! Written by `attractor export stopped`.

use attractor::Error;
use attractor::curve::{Elbow, Stop};
use attractor::draw::{Gradient, gradients};
use attractor::num::{Parameter, Real};
use attractor::plane::Point2;

/// The spectral exponent.
pub const BETA: Real = Real::lit("2.5");

/// Selects one of all curves.
pub const SEED: u64 = 9223372036854775807;

/// The law.
///
/// # Errors
/// None: those of [`Elbow`]'s constructors do not occur with these numbers.
pub fn law() -> Result<Elbow, Error> {
    Elbow::self_similar(BETA, SEED)
}

/// What it goes through.
#[rustfmt::skip]
pub static KNOTS: [Point2; 3] = [
    Point2::lit("0", "0"),
    Point2::lit("1", "0.5"),
    Point2::lit("2", "-0.25"),
];

/// Where it stops; none: at the length of a pixel.
pub const STOP: Option<Stop> = Some(Stop::Parameter(Parameter::lit("0.0625")));

/// Whether it is the graph of a function, stretched over the display.
pub const GRAPH: bool = false;

/// Whether what it encloses, or what lies below a graph, has a ground: a bit of lent memory for each pixel.
pub const FILLED: bool = false;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::OCEAN;
