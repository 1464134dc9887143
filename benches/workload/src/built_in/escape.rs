//! Views of the Mandelbrot set and of filled-in Julia sets.

use attractor::Error;
use attractor::draw::{Equalised, Ink, Inside, Level, Leveled, Palette, Picture};
use attractor::escape::{DeepMandelbrot, FractionalDwell, OrbitPoint, Smooth};
use attractor::plane::Field;
use attractor_gallery::{PAPER, draw_field, ground};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;

use crate::sink::{Colour, Failure, Stage};

/// Shows a field through a palette.
fn shown<C: Colour + Ink, F: Field, P: Palette<F::Value>>(
    stage: &mut Stage<'_>,
    (field, palette): (F, P),
    borrowed: usize,
) -> Result<(), Failure> {
    stage.draw::<C>(size_of::<Picture<F, P, C>>() + borrowed, |sink| {
        draw_field(field, palette, sink, &mut |_, _, _| true);
        Ok(())
    })
}

pub(super) fn view<C: Colour + Ink, F: Field, P: Palette<F::Value>>(
    stage: &mut Stage<'_>,
    picture: fn(Size) -> Result<F, Error>,
    palette: P,
) -> Result<(), Failure> {
    let field = picture(stage.size())?;
    shown::<C, F, P>(stage, (field, palette), 0)
}

/// With the paper of the display round the set.
pub(super) fn periods<C: Colour + Ink, F: Field, P: Palette<F::Value>>(
    stage: &mut Stage<'_>,
    picture: fn(Size) -> Result<F, Error>,
    palette: fn(Rgb888) -> P,
) -> Result<(), Failure> {
    view::<C, F, P>(stage, picture, palette(ground::<C>(PAPER)))
}

/// A palette that is equalised by a picture, with the counts that it borrows.
type By<F, G> = for<'a> fn(&F, &'a mut [u32]) -> Result<Inside<Equalised<'a, G>>, Error>;

/// The claim comes before the frame with the counts.
pub(super) fn equalised<C: Colour + Ink, F, G: Palette<Level>, const COUNTS: usize>(
    stage: &mut Stage<'_>,
    picture: fn(Size) -> Result<F, Error>,
    palette: By<F, G>,
) -> Result<(), Failure>
where
    F: Field<Value: Leveled>,
{
    stage.claim(size_of::<[u32; COUNTS]>() + size_of::<F>())?;
    counted::<C, F, G, COUNTS>(stage, picture, palette)
}

#[inline(never)]
fn counted<C: Colour + Ink, F, G: Palette<Level>, const COUNTS: usize>(
    stage: &mut Stage<'_>,
    picture: fn(Size) -> Result<F, Error>,
    palette: By<F, G>,
) -> Result<(), Failure>
where
    F: Field<Value: Leveled>,
{
    let (field, mut counts) = (picture(stage.size())?, [0; COUNTS]);
    let palette = palette(&field, &mut counts)?;
    shown::<C, _, _>(stage, (field, palette), size_of::<[u32; COUNTS]>())
}

/// A picture beyond 64 bits in fractional dwells, with the orbit that it borrows.
type Deep = for<'a> fn(Size, &'a mut [OrbitPoint]) -> Result<Smooth<DeepMandelbrot<'a, 12>>, Error>;

/// The claim comes before the frame with the orbit.
pub(super) fn deep<C: Colour + Ink, P: Palette<FractionalDwell>, const ORBIT: usize>(
    stage: &mut Stage<'_>,
    picture: Deep,
    palette: P,
) -> Result<(), Failure> {
    stage.claim(size_of::<[OrbitPoint; ORBIT]>() + size_of::<DeepMandelbrot<'_, 12>>())?;
    perturbed::<C, P, ORBIT>(stage, picture, palette)
}

#[inline(never)]
fn perturbed<C: Colour + Ink, P: Palette<FractionalDwell>, const ORBIT: usize>(
    stage: &mut Stage<'_>,
    picture: Deep,
    palette: P,
) -> Result<(), Failure> {
    let mut orbit = [OrbitPoint::default(); ORBIT];
    let field = picture(stage.size(), &mut orbit)?;
    shown::<C, _, _>(stage, (field, palette), size_of::<[OrbitPoint; ORBIT]>())
}
