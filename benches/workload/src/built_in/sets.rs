//! Attractors by the chaos game and by the copier, Julia sets by backward iteration and covered.

use attractor::Error;
use attractor::draw::Ink;
use attractor::escape::{JuliaCover, JuliaSet};
use attractor::ifs::{ChaosGame, CopiedPath, Ifs};
use attractor::plane::Density;
use attractor::plane::Point2;
use attractor::rand_xoshiro::Xoshiro128PlusPlus;
use attractor_gallery::{Copies, IfsPicture, JuliaSetPicture, Method, Named, Shading};
use embedded_graphics::geometry::Size;

use super::seed::SEED;
use crate::sink::{Colour, Failure, Stage};

/// Counts of a density: a number for each pixel within its margin.
const fn within_margin(size: Size) -> usize {
    let side = if size.width < size.height { size.width } else { size.height };
    let margin = 2 * (side / 24);
    ((size.width - margin) * (size.height - margin)) as usize
}

/// Room for maps where nothing is counted. One for all: code for each number of them would not fit the
/// smallest flash.
const ROOM: usize = 8;

/// Room for so many maps.
pub(super) const fn room(shading: Shading, maps: usize) -> usize {
    if matches!(shading, Shading::Density) || maps > ROOM { maps } else { ROOM }
}

/// Counts that a shading borrows.
pub(super) const fn counts_of_attractor(shading: Shading, size: Size) -> usize {
    if matches!(shading, Shading::Density) { within_margin(size) } else { 0 }
}

type Game<'a, const N: usize> = ChaosGame<'a, Xoshiro128PlusPlus, N>;

/// The claim comes before the frame with the counts.
pub(super) fn attractor<C: Colour + Ink, const N: usize, const COUNTS: usize>(
    stage: &mut Stage<'_>,
    system: fn() -> Result<Ifs<N>, Error>,
    (points, shading, palette): (Option<u32>, Shading, Named),
) -> Result<(), Failure> {
    let density = if COUNTS > 0 { size_of::<Density<'_, u16>>() + size_of::<[u16; COUNTS]>() } else { 0 };
    let bytes = size_of::<Ifs<N>>() + size_of::<Game<'_, N>>() + density;
    stage.claim(bytes)?;
    played::<C, N, COUNTS>(stage, system, (points, shading, palette), bytes)
}

#[inline(never)]
fn played<C: Colour + Ink, const N: usize, const COUNTS: usize>(
    stage: &mut Stage<'_>,
    system: fn() -> Result<Ifs<N>, Error>,
    (points, shading, palette): (Option<u32>, Shading, Named),
    bytes: usize,
) -> Result<(), Failure> {
    let ifs = &system()?;
    let picture = IfsPicture { ifs, points, shading, palette };
    let (look, mut counts) = ((stage.size(), SEED), [0; COUNTS]);
    stage.draw::<C>(bytes, |sink| picture.draw(look, sink, &mut counts, &mut |_, _, _| true))
}

/// Room for maps and for orders of a copier.
const COPIED: usize = 4;
const DEPTH: usize = 12;

pub(super) fn copies<C: Colour + Ink>(
    stage: &mut Stage<'_>,
    system: fn() -> Result<Ifs<COPIED>, Error>,
    (shape, orders): (&[Point2], &[u32]),
    palette: Named,
) -> Result<(), Failure> {
    let ifs = system()?;
    let copies = Copies::<COPIED, DEPTH>::new(&ifs, shape, orders, palette)?;
    let size = stage.size();
    let bytes = size_of_val(&ifs) + size_of_val(&copies) + size_of::<CopiedPath<'_, COPIED, DEPTH>>();
    stage.draw::<C>(bytes, |sink| copies.draw(size, sink, &mut |_, _, _| true))
}

/// Counts that a method borrows: a cover stores nothing.
pub(super) const fn counts_of_julia(method: Method, size: Size) -> usize {
    if matches!(method, Method::Plain) { within_margin(size) } else { 0 }
}

/// The claim comes before the frame with the counts.
pub(super) fn julia<C: Colour + Ink, const COUNTS: usize>(
    stage: &mut Stage<'_>,
    set: fn() -> Result<JuliaSet, Error>,
    (method, points, palette): (Method, Option<u32>, Named),
) -> Result<(), Failure> {
    let density = size_of::<Density<'_, u16>>() + size_of::<[u16; COUNTS]>();
    let bytes = size_of::<JuliaSetPicture>() + if COUNTS > 0 { density } else { size_of::<JuliaCover>() };
    stage.claim(bytes)?;
    found::<C, COUNTS>(stage, set, (method, points, palette), bytes)
}

#[inline(never)]
fn found<C: Colour + Ink, const COUNTS: usize>(
    stage: &mut Stage<'_>,
    set: fn() -> Result<JuliaSet, Error>,
    (method, points, palette): (Method, Option<u32>, Named),
    bytes: usize,
) -> Result<(), Failure> {
    let picture = JuliaSetPicture { set: set()?, method, points, palette };
    let (look, mut counts) = ((stage.size(), SEED), [0; COUNTS]);
    stage.draw::<C>(bytes, |sink| picture.draw(look, sink, &mut counts, &mut |_, _, _| true))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{COLOUR, MONO};

    #[test]
    fn the_margin_is_two_pixels_at_least_and_that_is_what_a_24th_of_these_is() {
        assert_eq!([COLOUR, MONO].map(within_margin), [220 * 220, 124 * 60]);
    }
}
