//! Any palette, shown with what ordered dithering adds.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::palette::Palette;

/// Another palette, dithered on every display, with greys and dots as bright as its colours: bands of equal
/// colour become smooth on displays of 16 bits. [`Ink::dithered_ink`](crate::draw::Ink::dithered_ink) says
/// how.
///
/// Outermost: a palette round it computes with its colours and shows them as ever.
///
/// ```
/// use attractor::draw::{Dithered, Grey, Picture};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{pixelcolor::{Rgb565, RgbColor}, prelude::*};
///
/// // 2 of 255 is a quarter of the way to the first red of 31
/// let dark = from_fn(Size::new(8, 8), |_, _| 2_u8);
/// let reds = |picture: &Picture<_, Dithered<Grey>, Rgb565>| -> u32 {
///     (0..8).flat_map(|y| picture.colors(y, 0..8).unwrap()).map(|color| u32::from(color.r())).sum()
/// };
/// assert_eq!(reds(&Picture::new(dark, Dithered(Grey))), 16);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Dithered<P>(pub P);

impl<V, P: Palette<V>> Palette<V> for Dithered<P> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        self.0.rgb(value)
    }

    #[inline]
    fn is_dithered(&self) -> bool {
        true
    }
}
