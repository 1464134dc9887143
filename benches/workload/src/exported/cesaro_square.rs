//! Cesaro's curve on the inside of a square, spikes of 85 degrees, down to a pixel.
//!
//! Written by `attractor export --gallery cesaro-square`.

use attractor::Error;
use attractor::curve::Generator;
use attractor::draw::{Gradient, gradients};
use attractor::num::Wide;
use attractor::plane::Point2;
use attractor_gallery::{Named, Pencil};

/// What stands in place of a segment, from its start to its end.
#[rustfmt::skip]
pub static VERTICES: [[Wide; 2]; 5] = [
    [Wide::lit("0"), Wide::lit("0")],
    [Wide::lit("0.459915"), Wide::lit("0")],
    [Wide::lit("0.5"), Wide::lit("0.458165")],
    [Wide::lit("0.540085"), Wide::lit("0")],
    [Wide::lit("1"), Wide::lit("0")],
];

/// Segments of the generator: the least `S`.
pub const SEGMENTS: usize = 4;

/// The generator.
///
/// # Errors
/// [`Error::Capacity`] where it has more than `S` segments.
pub fn generator<const S: usize>() -> Result<Generator<S>, Error> {
    Generator::<S>::polyline(&VERTICES)
}

/// What is refined.
#[rustfmt::skip]
pub static BASE: [Point2; 5] = [
    Point2::lit("0", "0"),
    Point2::lit("1", "0"),
    Point2::lit("1", "1"),
    Point2::lit("0", "1"),
    Point2::lit("0", "0"),
];

/// How often; none: down to the length of a pixel.
pub const ORDER: Option<u32> = None;

/// Whether what it encloses, or what lies below a graph, has a ground: a bit of lent memory for each pixel.
pub const FILLED: bool = true;

/// Where its colours come from.
pub const PALETTE: Gradient<9> = gradients::FIRE;

/// How its colours change along it.
pub const PENCIL: Pencil = Pencil { palette: Named::Fire, closed: true };
