//! Attractors by the chaos game and by the copier, Julia sets by backward iteration and covered.

use attractor::Error;
use attractor::draw::Ink;
use attractor::escape::{JuliaCover, JuliaSet};
use attractor::ifs::catalogue::Attractor;
use attractor::ifs::{Affine, ChaosGame, CopiedPath, Ifs};
use attractor::num::Complex;
use attractor::num::{Real, Unit, Wide};
use attractor::plane::Density;
use attractor::plane::Point2;
use attractor::rand_xoshiro::Xoshiro128PlusPlus;
use attractor_gallery::{Copies, IfsPicture, JuliaSetPicture, Method, Named, Shading};

use super::SEED;
use crate::sink::{Colour, Failure, Stage};

const THIRD: Unit = Unit::lit("0.33333333333");
const SIXTH: Unit = Unit::lit("0.16666666667");
/// `sqrt(3) / 6`.
const HEIGHT: Unit = Unit::lit("0.28867513459");
const NONE: Unit = Unit::ZERO;
const HALF: Unit = Unit::lit("0.5");

pub(super) const THIRDS: [Unit; 3] = [Unit::lit("0.333333333"); 3];
pub(super) const QUARTERS: [Unit; 4] = [Unit::lit("0.25"); 4];
pub(super) const EIGHTHS: [Unit; 8] = [Unit::lit("0.125"); 8];

const fn at(x: Real, y: Real) -> Point2 {
    Point2::new(x, y)
}

/// A map without a turn.
const fn scaled(factor: Unit, to: Point2) -> Affine {
    Affine::new([factor, NONE, NONE, factor], [to.x, to.y])
}

/// The course unit's: corners (0, 0), (1, 0), (1/2, 1).
pub(super) const SIERPINSKI: [Affine; 3] = [
    scaled(HALF, at(Real::ZERO, Real::ZERO)),
    scaled(HALF, at(Real::lit("0.5"), Real::ZERO)),
    scaled(HALF, at(Real::lit("0.25"), Real::lit("0.5"))),
];

const R3: Real = Real::lit("0.33333333333");
const R6: Real = Real::lit("0.66666666667");
const R28: Real = Real::lit("0.28867513459");
const R5: Real = Real::lit("0.5");

pub(super) const CARPET: [Affine; 8] = [
    scaled(THIRD, at(Real::ZERO, Real::ZERO)),
    scaled(THIRD, at(R3, Real::ZERO)),
    scaled(THIRD, at(R6, Real::ZERO)),
    scaled(THIRD, at(R6, R3)),
    scaled(THIRD, at(R6, R6)),
    scaled(THIRD, at(R3, R6)),
    scaled(THIRD, at(Real::ZERO, R6)),
    scaled(THIRD, at(Real::ZERO, R3)),
];

/// With three digits more than core's catalogue.
pub(super) const KOCH: [Affine; 4] = [
    scaled(THIRD, at(Real::ZERO, Real::ZERO)),
    Affine::new([SIXTH, HEIGHT.unwrapped_neg(), HEIGHT, SIXTH], [R3, Real::ZERO]),
    Affine::new([SIXTH, HEIGHT, HEIGHT.unwrapped_neg(), SIXTH], [R5, R28]),
    scaled(THIRD, at(R6, Real::ZERO)),
];

/// Room for maps. One for all: code for each number of them would not fit the smallest flash.
const MAPS: usize = 8;
type Game<'a, const N: usize> = ChaosGame<'a, Xoshiro128PlusPlus, N>;

/// An attractor of core's catalogue, each map in a colour.
pub(super) fn named<C: Colour + Ink>(
    stage: &mut Stage<'_>,
    attractor: &Attractor,
    palette: Named,
) -> Result<(), Failure> {
    by_maps::<C>(stage, (attractor.maps, attractor.probabilities), palette)
}

pub(super) fn by_maps<C: Colour + Ink>(
    stage: &mut Stage<'_>,
    (maps, probabilities): (&[Affine], &[Unit]),
    palette: Named,
) -> Result<(), Failure> {
    let ifs = Ifs::<MAPS>::new(maps, probabilities)?;
    let picture = IfsPicture { ifs: &ifs, points: None, shading: Shading::Maps, palette };
    let look = (stage.size(), SEED);
    let bytes = size_of_val(&ifs) + size_of::<Game<'_, MAPS>>();
    stage.draw::<C>(bytes, |sink| picture.draw(look, sink, &mut [], &mut |_, _, _| true))
}

/// The claim comes before the frame with the buffer.
pub(super) fn density<C: Colour + Ink, const N: usize, const PIXELS: usize>(
    stage: &mut Stage<'_>,
    attractor: &Attractor,
    palette: Named,
) -> Result<(), Failure> {
    let bytes = size_of::<Ifs<N>>()
        + size_of::<Game<'_, N>>()
        + size_of::<Density<'_, u16>>()
        + size_of::<[u16; PIXELS]>();
    stage.claim(bytes)?;
    counted::<C, N, PIXELS>(stage, attractor, palette, bytes)
}

#[inline(never)]
fn counted<C: Colour + Ink, const N: usize, const PIXELS: usize>(
    stage: &mut Stage<'_>,
    attractor: &Attractor,
    palette: Named,
    bytes: usize,
) -> Result<(), Failure> {
    let ifs = attractor.ifs::<N>()?;
    let picture = IfsPicture { ifs: &ifs, points: None, shading: Shading::Density, palette };
    let (look, mut counts) = ((stage.size(), SEED), [0; PIXELS]);
    stage.draw::<C>(bytes, |sink| picture.draw(look, sink, &mut counts, &mut |_, _, _| true))
}

pub(super) const LETTER: [Point2; 11] = {
    const A: [Real; 6] =
        [Real::ZERO, Real::lit("0.2"), Real::lit("0.4"), Real::lit("0.6"), Real::lit("0.8"), Real::ONE];
    const ARM: Real = Real::lit("0.65");
    [
        at(A[1], A[0]),
        at(A[1], A[5]),
        at(A[4], A[5]),
        at(A[4], A[4]),
        at(A[2], A[4]),
        at(A[2], A[3]),
        at(ARM, A[3]),
        at(ARM, A[2]),
        at(A[2], A[2]),
        at(A[2], A[0]),
        at(A[1], A[0]),
    ]
};

pub(super) const BOX: [Point2; 5] = {
    const LEFT: Real = Real::lit("-2.2");
    const RIGHT: Real = Real::lit("2.7");
    const TOP: Real = Real::lit("10");
    [at(LEFT, Real::ZERO), at(RIGHT, Real::ZERO), at(RIGHT, TOP), at(LEFT, TOP), at(LEFT, Real::ZERO)]
};

/// Room for orders.
const DEPTH: usize = 12;

pub(super) fn copies<C: Colour + Ink>(
    stage: &mut Stage<'_>,
    attractor: &Attractor,
    shape: &[Point2],
    orders: &[u32],
    palette: Named,
) -> Result<(), Failure> {
    let ifs = attractor.ifs::<4>()?;
    let copies = Copies::<4, DEPTH>::new(&ifs, shape, orders, palette)?;
    let size = stage.size();
    let bytes = size_of_val(&ifs) + size_of_val(&copies) + size_of::<CopiedPath<'_, 4, DEPTH>>();
    stage.draw::<C>(bytes, |sink| copies.draw(size, sink, &mut |_, _, _| true))
}

/// A Julia set by the parameters of its scene.
pub(super) struct Julia {
    c: Complex<Wide>,
    method: Method,
    points: Option<u32>,
    palette: Named,
}

impl Julia {
    fn picture(&self) -> Result<JuliaSetPicture, Error> {
        let Self { c, method, points, palette } = *self;
        Ok(JuliaSetPicture { set: JuliaSet::new(c)?, method, points, palette })
    }
}

pub(super) const RABBIT: Julia = Julia {
    c: Complex::new(Wide::lit("-0.123"), Wide::lit("0.745")),
    method: Method::Plain,
    points: Some(400_000),
    palette: Named::Dusk,
};
pub(super) const DENDRITE: Julia = Julia {
    c: Complex::new(Wide::ZERO, Wide::ONE),
    method: Method::Cover,
    points: None,
    palette: Named::Even,
};
pub(super) const SAN_MARCO: Julia = Julia {
    c: Complex::new(Wide::lit("-0.75"), Wide::ZERO),
    method: Method::Cover,
    points: None,
    palette: Named::Ocean,
};

/// One that is covered: nothing is stored.
pub(super) fn covered<C: Colour + Ink>(stage: &mut Stage<'_>, julia: &Julia) -> Result<(), Failure> {
    let bytes = size_of::<JuliaSetPicture>() + size_of::<JuliaCover>();
    let picture = julia.picture()?;
    let look = (stage.size(), SEED);
    stage.draw::<C>(bytes, |sink| picture.draw(look, sink, &mut [], &mut |_, _, _| true))
}

pub(super) fn julia<C: Colour + Ink, const PIXELS: usize>(
    stage: &mut Stage<'_>,
    julia: &Julia,
) -> Result<(), Failure> {
    let bytes = size_of::<JuliaSetPicture>() + size_of::<Density<'_, u16>>() + size_of::<[u16; PIXELS]>();
    stage.claim(bytes)?;
    iterated::<C, PIXELS>(stage, julia, bytes)
}

#[inline(never)]
fn iterated<C: Colour + Ink, const PIXELS: usize>(
    stage: &mut Stage<'_>,
    julia: &Julia,
    bytes: usize,
) -> Result<(), Failure> {
    let picture = julia.picture()?;
    let (look, mut counts) = ((stage.size(), SEED), [0; PIXELS]);
    stage.draw::<C>(bytes, |sink| picture.draw(look, sink, &mut counts, &mut |_, _, _| true))
}
