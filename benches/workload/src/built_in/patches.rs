//! Curves and surfaces by control points, which borrow nothing.

use attractor::Error;
use attractor::draw::{Ink, Palette};
use attractor::patch::{Mask, ProjectedCurve, Scheme, SlopeMoments};
use attractor::plane::{Point2, Tone};
use attractor::trace::PatchSurface;
use attractor_gallery::{LatticePicture, PatchCurvePicture, PatchSurfacePicture, Pencil};

use super::seed::SEED;
use crate::sink::{Colour, Failure, Stage};

pub(super) fn curve<C: Colour + Ink, const M: usize>(
    stage: &mut Stage<'_>,
    curve: fn() -> Result<ProjectedCurve<2, M>, Error>,
    (points, levels): ([Point2; M], u32),
    pencil: Pencil,
) -> Result<(), Failure> {
    let (curve, size) = (&curve()?, stage.size());
    let picture = PatchCurvePicture { curve, points, levels, pencil };
    stage.draw::<C>(size_of_val(curve) + size_of_val(&picture), |sink| {
        picture.draw(size, sink, &mut |_, _, _| true)
    })
}

pub(super) fn surface<C: Colour + Ink, S: Scheme<J>, const J: usize>(
    stage: &mut Stage<'_>,
    scheme: fn() -> Result<S, Error>,
    picture: for<'a> fn(&'a S) -> Result<PatchSurfacePicture<'a, S, J>, Error>,
) -> Result<(), Failure> {
    let (scheme, size) = (scheme()?, stage.size());
    let picture = picture(&scheme)?;
    let bytes = size_of_val(&scheme) + size_of_val(&picture) + size_of::<PatchSurface<'_, S, J>>();
    stage.draw::<C>(bytes, |sink| picture.draw((size, SEED as u32), sink, &mut |_, _, _| true))
}

pub(super) fn lattice<C: Colour + Ink, P: Palette<Tone> + Copy>(
    stage: &mut Stage<'_>,
    scheme: fn() -> Result<Mask, Error>,
    picture: for<'a> fn(&'a Mask) -> Result<LatticePicture<'a, P>, Error>,
) -> Result<(), Failure> {
    let (mask, size) = (scheme()?, stage.size());
    let picture = picture(&mask)?;
    let bytes = size_of_val(&mask) + size_of_val(&picture) + size_of::<PatchSurface<'_, Mask, 16>>();
    let bytes = bytes + picture.quality.map_or(0, |_| size_of::<SlopeMoments>());
    stage.draw::<C>(bytes, |sink| picture.draw((size, SEED as u32), &mask, sink, &mut |_, _, _| true))
}
