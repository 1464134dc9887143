//! Refined and random curves, L-systems.

use attractor::Error;
use attractor::curve::catalogue::LARGEST;
use attractor::curve::{Displacement, Generator, LSystem, Refined, Stop, Subdivision, Turtle};
use attractor::draw::Ink;
use attractor::plane::Point2;
use attractor_gallery::{CurvePicture, LSystemPicture, Pencil, RandomCurvePicture, ground_words};
use embedded_graphics::geometry::Size;

use crate::sink::{Colour, Failure, Stage};

/// Room for refinements, rewritings and brackets, and for halvings.
const DEPTH: usize = 12;
const LEVELS: usize = 20;

/// Words for the ground under a curve.
pub(super) const fn ground(size: Size) -> usize {
    ground_words(size)
}

/// `WORDS` are lent for the ground of a closed curve. There is code for one size of generators only: for each
/// its own would not fit the smallest flash.
pub(super) fn refined<C: Colour + Ink, const WORDS: usize>(
    stage: &mut Stage<'_>,
    generator: fn() -> Result<Generator<LARGEST>, Error>,
    (base, order): (&[Point2], Option<u32>),
    (filled, pencil): (bool, Pencil),
) -> Result<(), Failure> {
    let generator = &generator()?;
    let picture = CurvePicture::<LARGEST, DEPTH> { generator, base, order, filled, pencil };
    let (size, mut turns) = (stage.size(), [0; WORDS]);
    let bytes = size_of_val(generator) + size_of::<Refined<'_, LARGEST, DEPTH>>() + size_of_val(&turns);
    stage.draw::<C>(bytes, |sink| picture.draw(size, sink, &mut turns, &mut |_, _, _| true))
}

/// `WORDS` are lent for the ground of a closed curve or of a graph.
pub(super) fn random<C: Colour + Ink, L: Displacement + Clone, const WORDS: usize>(
    stage: &mut Stage<'_>,
    law: fn() -> Result<L, Error>,
    (knots, stop, graph): (&[Point2], Option<Stop>, bool),
    (filled, pencil): (bool, Pencil),
) -> Result<(), Failure> {
    let law = &law()?;
    let picture = RandomCurvePicture::<L, LEVELS> { law, graph, knots, stop, filled, pencil };
    let (size, mut turns) = (stage.size(), [0; WORDS]);
    let bytes = size_of_val(law) + size_of::<Subdivision<'_, L, LEVELS>>() + size_of_val(&turns);
    stage.draw::<C>(bytes, |sink| picture.draw(size, sink, &mut turns, &mut |_, _, _| true))
}

pub(super) fn words<C: Colour + Ink>(
    stage: &mut Stage<'_>,
    system: fn() -> Result<LSystem<'static>, Error>,
    order: u32,
    pencil: Pencil,
) -> Result<(), Failure> {
    let picture = LSystemPicture::<DEPTH, DEPTH> { system: system()?, order, pencil };
    let size = stage.size();
    stage.draw::<C>(size_of::<Turtle<'_, DEPTH, DEPTH>>(), |sink| {
        picture.draw(size, sink, &mut |_, _, _| true)
    })
}
