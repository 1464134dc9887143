//! Ray-traced worlds, and solid textures cut by a plane.

use attractor::Error;
use attractor::draw::Ink;
use attractor::plane::{Field, LinearRgb};
use attractor_gallery::{Shade, draw_field};

use crate::sink::{Colour, Failure, Stage};

/// A field of light in these greys; `bytes` is what it and all that it borrows takes.
pub(super) fn light<C: Colour + Ink>(
    stage: &mut Stage<'_>,
    field: impl Field<Value = LinearRgb>,
    contrast: Option<[u8; 2]>,
    bytes: usize,
) -> Result<(), Failure> {
    stage.draw::<C>(bytes, |sink| {
        draw_field(&field, Shade::new::<C>(contrast)?, sink, &mut |_, _, _| true);
        Ok(())
    })
}

/// A texture as a field.
pub(super) fn texture<C: Colour + Ink, F: Field<Value = LinearRgb>>(
    stage: &mut Stage<'_>,
    picture: fn(embedded_graphics::geometry::Size) -> Result<F, Error>,
) -> Result<(), Failure> {
    let field = picture(stage.size())?;
    let bytes = size_of_val(&field);
    light::<C>(stage, field, None, bytes)
}
