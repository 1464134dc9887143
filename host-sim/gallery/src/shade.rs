//! Light on a display: in colour where it has colours, with the contrast of its scene where it has few
//! levels.

use attractor::Error;
use attractor::draw::{Contrast, Palette, Srgb};
use attractor::plane::LinearRgb;
use embedded_graphics::pixelcolor::raw::RawData;
use embedded_graphics::pixelcolor::{PixelColor, Rgb888};

/// The palette of a scene in light.
#[derive(Debug, Clone, Copy)]
pub enum Shade {
    /// True to the light.
    True(Srgb),
    /// Spread over the few levels that there are.
    Spread(Contrast<Srgb>),
}

impl Shade {
    /// On a display of 16 levels or fewer the greys from the first to the second of `contrast` are spread.
    ///
    /// # Errors
    /// [`Error::NotIncreasing`] for a second that is not above the first.
    pub fn new<C: PixelColor>(contrast: Option<[u8; 2]>) -> Result<Self, Error> {
        match contrast {
            Some([black, white]) if C::Raw::BITS_PER_PIXEL <= 4 => {
                Ok(Self::Spread(Contrast::new(Srgb, black, white)?))
            }
            _ => Ok(Self::True(Srgb)),
        }
    }
}

impl Palette<LinearRgb> for Shade {
    #[inline]
    fn rgb(&self, light: LinearRgb) -> Rgb888 {
        match self {
            Self::True(palette) => palette.rgb(light),
            Self::Spread(palette) => palette.rgb(light),
        }
    }

    #[inline]
    fn is_dithered(&self) -> bool {
        matches!(self, Self::True(palette) if Palette::<LinearRgb>::is_dithered(palette))
    }
}
