//! Contrast: a narrow range of greys spread over all that a display of few levels has.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::ink::luma;
use super::palette::Palette;
use crate::Error;
use crate::num::formats::UQ16;

/// Another palette in greys, of which `black` and what is darker become black, `white` and what is brighter
/// white, and what lies between is spread evenly.
///
/// Colours that differ in hue are often of nearly one brightness: grass, rock and sea at a distance, which a
/// display of two or four levels dithers to one grey. Levels that are chosen for a picture keep it readable
/// there; on a display that has colours, leave the palette as it is.
///
/// Result: `255 (l - black) / (white - black)`, clamped to `0..=255`, where `l` is the [`luma`]. Error: 0.502
/// of a step of 255 (`greys_are_spread_evenly_between_black_and_white`). Cost: 4 multiplications.
///
/// ```
/// use attractor::draw::{Contrast, Grey, Picture};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
///
/// // from 100 to 149
/// let wedge = from_fn(Size::new(8, 2), |x, _| (100 + x * 7) as u8);
/// let mut display = MockDisplay::<BinaryColor>::new();
/// let picture = Picture::new(wedge, Contrast::new(Grey, 100, 149)?);
/// let Ok(()) = Image::new(&picture, Point::zero()).draw(&mut display);
/// display.assert_pattern(&["..#.####", "...#.#.#"]);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Contrast<P> {
    palette: P,
    black: u8,
    /// `255 / (white - black)`.
    steepness: UQ16,
}

impl<P> Contrast<P> {
    /// Spreads the greys from `black` to `white`, both `0..=255`.
    ///
    /// # Errors
    /// [`Error::NotIncreasing`] unless `black < white`.
    pub const fn new(palette: P, black: u8, white: u8) -> Result<Self, Error>
    where
        P: Copy,
    {
        let range = white.saturating_sub(black) as u32;
        match ((255 << 16) + range / 2).checked_div(range) {
            Some(steepness) => Ok(Self { palette, black, steepness }),
            None => Err(Error::NotIncreasing { what: "level", index: 1 }),
        }
    }
}

impl<V, P: Palette<V>> Palette<V> for Contrast<P> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        let above = u32::from(luma(self.palette.rgb(value)).saturating_sub(self.black));
        // 255 * (255 << 16) + 2^15 < 2^32
        let grey = ((above * self.steepness + (1 << 15)) >> 16).min(255) as u8;
        Rgb888::new(grey, grey, grey)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::Grey;

    /// All levels at all pairs of ends, against exact quotients.
    #[test]
    fn greys_are_spread_evenly_between_black_and_white() {
        let mut worst = 0.0_f64;
        for (black, white) in (0..=255_u8).flat_map(|black| (0..=255).map(move |white| (black, white))) {
            let Ok(contrast) = Contrast::new(Grey, black, white) else {
                assert!(black >= white, "{black}, {white}");
                continue;
            };
            assert!(black < white);
            for level in 0..=255_u8 {
                use embedded_graphics_core::pixelcolor::RgbColor;
                let spread = f64::from(level) - f64::from(black);
                let exact = (255.0 * spread / f64::from(white - black)).clamp(0.0, 255.0);
                worst = worst.max((f64::from(contrast.rgb(level).r()) - exact).abs());
            }
            assert_eq!(contrast.rgb(black), Rgb888::new(0, 0, 0));
            assert_eq!(contrast.rgb(white), Rgb888::new(255, 255, 255));
        }
        assert!(worst > 0.4999 && worst < 0.502, "{worst}");
    }
}
