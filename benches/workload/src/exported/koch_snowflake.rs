//! Koch's snowflake of order 5: 3072 segments round 8/5 of the triangle.
//!
//! Written by `attractor export --gallery koch-snowflake`.

use attractor::Error;
use attractor::curve::{Generator, catalogue};
use attractor::draw::{Gradient, gradients};
use attractor::plane::Point2;
use attractor_gallery::{Named, Pencil};

/// Segments of the generator: the least `S`.
pub const SEGMENTS: usize = 4;

/// The generator.
///
/// # Errors
/// [`Error::Capacity`] where it has more than `S` segments.
pub fn generator<const S: usize>() -> Result<Generator<S>, Error> {
    catalogue::KOCH_SNOWFLAKE.generator::<S>()
}

/// What is refined.
#[rustfmt::skip]
pub static BASE: [Point2; 4] = [
    Point2::lit("0", "1"),
    Point2::lit("0.8660254", "-0.5"),
    Point2::lit("-0.8660254", "-0.5"),
    Point2::lit("0", "1"),
];

/// How often; none: down to the length of a pixel.
pub const ORDER: Option<u32> = Some(5);

/// Whether what it encloses, or what lies below a graph, has a ground: a bit of lent memory for each pixel.
pub const FILLED: bool = true;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::OCEAN;

/// How its colours change along it.
pub const PENCIL: Pencil = Pencil { palette: Named::Ocean, closed: true };
