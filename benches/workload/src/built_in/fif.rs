//! Graphs and surfaces of fractal interpolation functions.

use attractor::Error;
use attractor::draw::Ink;
use attractor::fif::{Cell, Fif, Pyramid, Sum, Sums};
use attractor::trace::{FilteredCaster, HeightField, Quality, RayCaster};
use attractor_gallery::{CELLS_ACROSS, Chart, Named, depth_for, draw_field, filtered_depth, surface_depth};
use embedded_graphics::geometry::Size;

use super::seed::SEED;
use crate::scene::COLOUR;
use crate::sink::{Colour, Failure, Stage};

/// Cells that the range of a function of so many maps is found with.
pub(super) const fn cells_of_chart(maps: usize) -> usize {
    Pyramid::cells(maps, depth_for(maps, CELLS_ACROSS))
}

/// The claim comes before the frame with the cells.
pub(super) fn chart<C: Colour + Ink, const N: usize, const D: usize, const CELLS: usize>(
    stage: &mut Stage<'_>,
    function: fn() -> Result<Fif<N, D>, Error>,
    address: &[usize],
    palette: Named,
) -> Result<(), Failure> {
    stage.claim(size_of::<Fif<N, D>>() + size_of::<[Cell; CELLS]>())?;
    charted::<C, N, D, CELLS>(stage, function, address, palette)
}

#[inline(never)]
fn charted<C: Colour + Ink, const N: usize, const D: usize, const CELLS: usize>(
    stage: &mut Stage<'_>,
    function: fn() -> Result<Fif<N, D>, Error>,
    address: &[usize],
    palette: Named,
) -> Result<(), Failure> {
    let f = function()?;
    let (size, mut cells, mut columns) = (stage.size(), [Cell::ZERO; CELLS], [0; COLOUR.width as usize]);
    let chart = Chart::new(&f, size, address, palette, &mut cells)?;
    let bytes = size_of_val(&f) + size_of_val(&chart) + size_of_val(&cells) + size_of_val(&columns);
    stage.draw::<C>(bytes, |sink| chart.draw(sink, &mut columns, &mut |_, _, _| true))
}

/// Cells of a pyramid of both factors of a surface.
pub(super) const fn cells_of_surface(maps: usize, depth: Option<u32>, size: Size) -> usize {
    Pyramid::cells(maps, depth_of_surface(maps, depth, size))
}

pub(super) const fn depth_of_surface(maps: usize, depth: Option<u32>, size: Size) -> u32 {
    let side = if size.width > size.height { size.width } else { size.height };
    surface_depth([maps, maps], depth, side)
}

type Caster = for<'a> fn(HeightField<'a>, Size, u32) -> Result<RayCaster<'a>, Error>;

/// Both profiles are one function: one pyramid is enough.
pub(super) fn surface<C: Colour + Ink, const N: usize, const D: usize, const CELLS: usize>(
    stage: &mut Stage<'_>,
    factor: fn() -> Result<Fif<N, D>, Error>,
    depth: Option<u32>,
    caster: Caster,
    palette: Named,
) -> Result<(), Failure> {
    let (f, size) = (factor()?, stage.size());
    let mut cells = [Cell::ZERO; CELLS];
    let pyramid = Pyramid::new(&f, depth_of_surface(N, depth, size), &mut cells)?;
    let caster = caster(HeightField::new(&pyramid, &pyramid)?, size, SEED as u32)?;
    let bytes = size_of_val(&f) + size_of_val(&pyramid) + size_of::<[Cell; CELLS]>() + size_of_val(&caster);
    stage.draw::<C>(bytes, |sink| {
        draw_field(&caster, palette, sink, &mut |_, _, _| true);
        Ok(())
    })
}

/// Places of the sums of a filtered surface.
pub(super) const fn places_of_filtered(maps: usize, depth: Option<u32>, size: Size) -> usize {
    Sums::places(maps, depth_of_filtered(maps, depth, size))
}

const fn depth_of_filtered(maps: usize, depth: Option<u32>, size: Size) -> u32 {
    let side = if size.width > size.height { size.width } else { size.height };
    filtered_depth([maps, maps], depth, side)
}

/// The same with the normals of each pixel integrated.
pub(super) fn filtered<
    C: Colour + Ink,
    const N: usize,
    const D: usize,
    const CELLS: usize,
    const PLACES: usize,
>(
    stage: &mut Stage<'_>,
    factor: fn() -> Result<Fif<N, D>, Error>,
    depth: Option<u32>,
    (caster, quality): (Caster, Quality),
    palette: Named,
) -> Result<(), Failure> {
    stage.claim(size_of::<[Cell; CELLS]>() + size_of::<[Sum; PLACES]>())?;
    filtered_in::<C, N, D, CELLS, PLACES>(stage, factor, depth, (caster, quality), palette)
}

/// The claim comes before the frame with the cells.
#[inline(never)]
fn filtered_in<C: Colour + Ink, const N: usize, const D: usize, const CELLS: usize, const PLACES: usize>(
    stage: &mut Stage<'_>,
    factor: fn() -> Result<Fif<N, D>, Error>,
    depth: Option<u32>,
    (caster, quality): (Caster, Quality),
    palette: Named,
) -> Result<(), Failure> {
    let (f, size) = (factor()?, stage.size());
    let (mut cells, mut places) = ([Cell::ZERO; CELLS], [Sum::ZERO; PLACES]);
    let pyramid = Pyramid::new(&f, depth_of_surface(N, depth, size), &mut cells)?;
    let sums = Sums::new(&f, depth_of_filtered(N, depth, size), &mut places)?;
    let caster = caster(HeightField::new(&pyramid, &pyramid)?, size, SEED as u32)?;
    let caster = FilteredCaster::new(caster, &sums, &sums, quality)?;
    let lent = size_of::<[Cell; CELLS]>() + size_of::<[Sum; PLACES]>();
    let bytes = size_of_val(&f) + size_of_val(&sums) + lent + size_of_val(&caster);
    stage.draw::<C>(bytes, |sink| {
        draw_field(&caster, palette, sink, &mut |_, _, _| true);
        Ok(())
    })
}
