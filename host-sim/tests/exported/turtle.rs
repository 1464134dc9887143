//! A word of a turtle round a square.
//!
//! Written by `attractor export turtle`.

use attractor::Error;
use attractor::curve::Generator;
use attractor::draw::{Gradient, gradients};
use attractor::num::Angle;
use attractor::plane::Point2;

/// What stands in place of a segment.
pub const WORD: &str = "F+F--F+F";

/// Of a turn, with 32 fractional bits.
pub const ANGLE: Angle = Angle::from_bits(715827883);

/// Segments of the generator: the least `S`.
pub const SEGMENTS: usize = 4;

/// The generator.
///
/// # Errors
/// [`Error::Capacity`] where it has more than `S` segments.
pub fn generator<const S: usize>() -> Result<Generator<S>, Error> {
    Generator::<S>::turtle(WORD, ANGLE)
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
pub const FILLED: bool = false;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::OCEAN;
