//! What a texture is: light for each point of a surface.

use super::super::surface::SurfacePoint;
use crate::num::Rgb;

/// A colour that depends on the place: solid textures look at [`SurfacePoint::place`], pictures on a surface
/// at [`SurfacePoint::chart`]. A plain [`Rgb`] is the texture that is the same everywhere.
pub trait Texture {
    /// Whether it looks at texture coordinates.
    fn is_charted(&self) -> bool {
        false
    }

    /// The colour at a point of a surface.
    fn at(&self, point: &SurfacePoint) -> Rgb;
}

impl Texture for Rgb {
    #[inline]
    fn at(&self, _: &SurfacePoint) -> Rgb {
        *self
    }
}
