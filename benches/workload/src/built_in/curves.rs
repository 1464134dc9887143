//! Refined and random curves, L-systems.

use attractor::Error;
use attractor::curve::catalogue::{Curve, LARGEST};
use attractor::curve::{
    Displacement, Elbow, Generator, LSystem, LineToLine, OneVariable, Refined, Subdivision, Turtle,
    TwoVariable, coast, koch,
};
use attractor::draw::Ink;
use attractor::num::{Real, Unit, Wide};
use attractor::plane::Point2;
use attractor_gallery::{CurvePicture, LSystemPicture, Named, Pencil, RandomCurvePicture};

use crate::sink::{Colour, Failure, Stage};

/// Room for refinements and for halvings.
const DEPTH: usize = 12;
const LEVELS: usize = 20;

const fn point(x: Real, y: Real) -> Point2 {
    Point2::new(x, y)
}

const ZERO: Real = Real::ZERO;
const ONE: Real = Real::ONE;
pub(super) const DIAGONAL: [Point2; 2] = [point(ZERO, ZERO), point(ONE, ONE)];
/// Walked so that what the generator raises points outwards.
pub(super) const SQUARE: [Point2; 5] =
    [point(ZERO, ZERO), point(ZERO, ONE), point(ONE, ONE), point(ONE, ZERO), point(ZERO, ZERO)];

/// A curve of core's catalogue, on its own base unless another is given.
pub(super) fn named<C: Colour + Ink, const WORDS: usize>(
    stage: &mut Stage<'_>,
    curve: &Curve,
    order: u32,
    base: Option<&[Point2]>,
    palette: Named,
) -> Result<(), Failure> {
    let triangle = koch::triangle(Point2::default(), ONE);
    let usual = if curve.closed { &triangle[..] } else { &koch::SEGMENT[..] };
    refined::<C, WORDS>(stage, curve.generator(), base.unwrap_or(usual), Some(order), palette)
}

/// `WORDS` are lent for the ground of a closed curve. There is code for one size of generators only: for each its own would not fit the smallest flash.
fn refined<C: Colour + Ink, const WORDS: usize>(
    stage: &mut Stage<'_>,
    generator: Result<Generator<LARGEST>, Error>,
    base: &[Point2],
    order: Option<u32>,
    palette: Named,
) -> Result<(), Failure> {
    let generator = &generator?;
    let closed = base.first() == base.last();
    let pencil = Pencil { palette, closed };
    let picture = CurvePicture::<LARGEST, DEPTH> { generator, base, order, filled: closed, pencil };
    let (size, mut turns) = (stage.size(), [0; WORDS]);
    let bytes = size_of_val(generator) + size_of::<Refined<'_, LARGEST, DEPTH>>() + size_of_val(&turns);
    stage.draw::<C>(bytes, |sink| picture.draw(size, sink, &mut turns, &mut |_, _, _| true))
}

pub(super) fn cesaro<C: Colour + Ink, const WORDS: usize>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    const SPIKE: [[Wide; 2]; 5] = [
        [Wide::ZERO, Wide::ZERO],
        [Wide::lit("0.459915"), Wide::ZERO],
        [Wide::lit("0.5"), Wide::lit("0.458165")],
        [Wide::lit("0.540085"), Wide::ZERO],
        [Wide::ONE, Wide::ZERO],
    ];
    const BASE: [Point2; 5] =
        [point(ZERO, ZERO), point(ONE, ZERO), point(ONE, ONE), point(ZERO, ONE), point(ZERO, ZERO)];
    refined::<C, WORDS>(stage, Generator::polyline(&SPIKE), &BASE, None, Named::Fire)
}

/// `WORDS` are lent for the ground of a closed curve or of a graph.
fn random<C: Colour + Ink, L: Displacement + Clone, const WORDS: usize>(
    stage: &mut Stage<'_>,
    law: Result<L, Error>,
    (knots, graph): (&[Point2], bool),
    palette: Named,
) -> Result<(), Failure> {
    let law = &law?;
    let closed = knots.first() == knots.last();
    let pencil = Pencil { palette, closed };
    let picture =
        RandomCurvePicture::<L, LEVELS> { law, graph, knots, stop: None, filled: closed || graph, pencil };
    let (size, mut turns) = (stage.size(), [0; WORDS]);
    let bytes = size_of_val(law) + size_of::<Subdivision<'_, L, LEVELS>>() + size_of_val(&turns);
    stage.draw::<C>(bytes, |sink| picture.draw(size, sink, &mut turns, &mut |_, _, _| true))
}

pub(super) fn elbow<C: Colour + Ink, const WORDS: usize>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    const DEVIATION: Unit = Unit::lit("0.3");
    let law = Elbow::new(DEVIATION, const { Real::lit("2") }, 7);
    random::<C, _, WORDS>(stage, law, (&koch::SEGMENT, false), Named::Fire)
}

pub(super) fn carpenter_1<C: Colour + Ink, const WORDS: usize>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let law = OneVariable::from_ratio(const { Real::lit("1.3") }, 1980);
    random::<C, _, WORDS>(stage, law, (&koch::SEGMENT, false), Named::Dusk)
}

pub(super) fn carpenter_2<C: Colour + Ink, const WORDS: usize>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let law = TwoVariable::new(const { Unit::lit("0.3") }, 1980);
    random::<C, _, WORDS>(stage, law, (&koch::SEGMENT, false), Named::Moss)
}

pub(super) fn mountain_line<C: Colour + Ink, const WORDS: usize>(
    stage: &mut Stage<'_>,
) -> Result<(), Failure> {
    const KNOTS: [Point2; 4] = [
        point(ZERO, ZERO),
        point(Real::lit("0.9"), Real::lit("0.5")),
        point(Real::lit("1.6"), Real::lit("0.1")),
        point(Real::lit("2"), Real::lit("0.35")),
    ];
    let law = LineToLine::from_spectrum(const { Unit::lit("0.16") }, const { Real::lit("2.2") }, 3);
    random::<C, _, WORDS>(stage, law, (&KNOTS, true), Named::Dusk)
}

pub(super) fn coastline<C: Colour + Ink, const WORDS: usize>(stage: &mut Stage<'_>) -> Result<(), Failure> {
    let law = OneVariable::new(const { Unit::lit("0.16") }, 1980);
    random::<C, _, WORDS>(stage, law, (&coast::ICELAND, false), Named::Moss)
}

/// An L-system of the command.
pub(super) struct Words {
    axiom: &'static str,
    rules: &'static [(char, &'static str)],
    angle: Wide,
    heading: Wide,
    order: u32,
    palette: Named,
}

pub(super) const CANTOR: Words = Words {
    axiom: "A",
    rules: &[('A', "BBBBBB"), ('B', "CCCCCC"), ('C', "[F]+"), ('F', "FfF"), ('f', "fff")],
    angle: Wide::lit("10"),
    heading: Wide::ZERO,
    order: 6,
    palette: Named::Ocean,
};

pub(super) const PLANT: Words = Words {
    axiom: "X",
    rules: &[('X', "F-[[X]+X]+F[+FX]-X"), ('F', "FF")],
    angle: Wide::lit("22.5"),
    heading: Wide::lit("90"),
    order: 5,
    palette: Named::Moss,
};

pub(super) const DRAGON: Words = Words {
    axiom: "FX",
    rules: &[('X', "X+YF+"), ('Y', "-FX-Y")],
    angle: Wide::lit("90"),
    heading: Wide::lit("90"),
    order: 10,
    palette: Named::Fire,
};

pub(super) fn l_system<C: Colour + Ink>(stage: &mut Stage<'_>, words: &Words) -> Result<(), Failure> {
    let system = LSystem::new(words.axiom, words.rules, words.angle)?.with_heading(words.heading);
    let pencil = Pencil { palette: words.palette, closed: false };
    let picture = LSystemPicture::<DEPTH, DEPTH> { system, order: words.order, pencil };
    let size = stage.size();
    stage.draw::<C>(size_of::<Turtle<'_, DEPTH, DEPTH>>(), |sink| {
        picture.draw(size, sink, &mut |_, _, _| true)
    })
}
