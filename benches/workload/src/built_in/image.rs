//! Encoded pictures, which borrow a window of rows or all of themselves.

use attractor::codec::Sample;
use attractor::draw::{Ink, Palette, YCoCg};
use attractor_gallery::{Frames, ImagePicture};
use embedded_graphics::geometry::Size;

use crate::sink::{Colour, Failure, Stage};

/// How many samples a picture borrows of those that it says for each scale.
pub(super) const fn samples(of: [usize; 5], picture: Size, display: Size, frames: usize) -> usize {
    of[(Frames::new(picture, display, frames as u32).scale + 2) as usize]
}

/// Draws it in memory of so many samples.
pub(super) fn decoded<C: Colour + Ink, S: Sample + Default, const SAMPLES: usize>(
    stage: &mut Stage<'_>,
    picture: &ImagePicture<'static>,
) -> Result<(), Failure>
where
    YCoCg: Palette<[S; 3]>,
{
    stage.claim(size_of::<[S; SAMPLES]>())?;
    within::<C, S, SAMPLES>(stage, picture)
}

#[inline(never)]
fn within<C: Colour + Ink, S: Sample + Default, const SAMPLES: usize>(
    stage: &mut Stage<'_>,
    picture: &ImagePicture<'static>,
) -> Result<(), Failure>
where
    YCoCg: Palette<[S; 3]>,
{
    let (mut memory, size) = ([S::default(); SAMPLES], stage.size());
    stage.draw::<C>(size_of_val(&memory), |sink| picture.draw(size, sink, &mut memory, &mut |_, _, _| true))
}
