//! Landscapes: surfaces by subdivision under the ray caster, and by their lines.

use attractor::draw::Ink;
use attractor::num::Real;
use attractor::terrain::PlaneToLine;
use attractor::trace::HeightRange;
use attractor_gallery::{Lines, Pencil, TerrainMemory, TerrainPicture};

use super::seed::SEED;
use crate::sink::{Colour, Failure, Stage};

/// `HEIGHTS`, `WORDS` and `RANGES` are what the picture asks to be lent. The claim comes before the frame.
pub(super) fn land<C: Colour + Ink, const HEIGHTS: usize, const WORDS: usize, const RANGES: usize>(
    stage: &mut Stage<'_>,
    picture: &TerrainPicture<'_>,
) -> Result<(), Failure> {
    stage.claim(
        size_of::<[Real; HEIGHTS]>() + size_of::<[Real; WORDS]>() + size_of::<[HeightRange; RANGES]>(),
    )?;
    landed::<C, HEIGHTS, WORDS, RANGES>(stage, picture)
}

#[inline(never)]
fn landed<C: Colour + Ink, const HEIGHTS: usize, const WORDS: usize, const RANGES: usize>(
    stage: &mut Stage<'_>,
    picture: &TerrainPicture<'_>,
) -> Result<(), Failure> {
    let (mut heights, mut rows) = ([Real::ZERO; HEIGHTS], [Real::ZERO; WORDS]);
    let (mut ranges, size) = ([HeightRange::default(); RANGES], stage.size());
    let bytes = size_of_val(&heights) + size_of_val(&rows) + size_of_val(&ranges) + size_of_val(picture);
    stage.draw::<C>(bytes, |sink| {
        let memory = TerrainMemory { heights: &mut heights, rows: &mut rows, ranges: &mut ranges };
        picture.draw((size, SEED as u32), memory, sink, &mut |_, _, _| true)
    })
}

/// By its lines, which borrow nothing.
pub(super) fn lines<C: Colour + Ink>(
    stage: &mut Stage<'_>,
    picture: &TerrainPicture<'_>,
    (lines, pencil): (Lines, Pencil),
) -> Result<(), Failure> {
    let size = stage.size();
    stage.draw::<C>(size_of::<PlaneToLine<'_>>() + size_of_val(picture), |sink| {
        picture.draw_lines(lines, pencil, size, sink, &mut |_, _, _| true)
    })
}
