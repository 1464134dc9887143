//! Minkowski's island: the quadric Koch curve of order 3 round a square.
//!
//! Written by `attractor export --gallery minkowski`.

use attractor::Error;
use attractor::curve::{Generator, catalogue};
use attractor::draw::{Gradient, gradients};
use attractor::plane::Point2;
use attractor_gallery::{Named, Pencil};

/// Segments of the generator: the least `S`.
pub const SEGMENTS: usize = 8;

/// The generator.
///
/// # Errors
/// [`Error::Capacity`] where it has more than `S` segments.
pub fn generator<const S: usize>() -> Result<Generator<S>, Error> {
    catalogue::MINKOWSKI.generator::<S>()
}

/// What is refined.
#[rustfmt::skip]
pub static BASE: [Point2; 5] = [
    Point2::lit("0", "0"),
    Point2::lit("0", "1"),
    Point2::lit("1", "1"),
    Point2::lit("1", "0"),
    Point2::lit("0", "0"),
];

/// How often; none: down to the length of a pixel.
pub const ORDER: Option<u32> = Some(3);

/// Whether what it encloses, or what lies below a graph, has a ground: a bit of lent memory for each pixel.
pub const FILLED: bool = true;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::MOSS;

/// How its colours change along it.
pub const PENCIL: Pencil = Pencil { palette: Named::Moss, closed: true };
