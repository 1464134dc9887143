//! Palettes for displays that know two inks: one for the right brightness when a colour becomes dots, and one
//! for its negative.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

use super::palette::Palette;
use crate::num::formats::UQ16;

/// Another palette as greys in linear light: dithered to dots of one bit, they give off as much light as its
/// colours do.
///
/// The channels of a colour are encoded (sRGB): the code 128 means 22 % of the light. Half of all dots, which
/// is what plain dithering shows for it, is 50 %. So a picture that is dithered without this palette is too
/// bright in the middle, by up to 0.29 of full light; with it, it is darker and true. Where dots are few and
/// coarse the brighter picture may still read better: compare both on the display.
///
/// Result: a grey of the relative luminance `0.2126 R + 0.7152 G + 0.0722 B` of IEC 61966-2-1, the channels
/// decoded by `0.01814 v + 0.66743 v^2 + 0.31443 v^3`. Error: 0.85 of a step of 255
/// (`the_light_of_the_dots_is_the_light_of_the_colour`); black and white are exact. Cost: 13 multiplications.
///
/// ```
/// use attractor::draw::{Grey, Luminance, Picture};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
///
/// let middle = from_fn(Size::new(8, 4), |_, _| 128_u8);
/// let mut display = MockDisplay::<BinaryColor>::new();
/// Image::new(&Picture::new(middle, Luminance(Grey)), Point::zero()).draw(&mut display)?;
/// // 7 of 32
/// display.assert_pattern(&[
///     "#.#.#.#.",
///     "........",
///     "#.#...#.",
///     "........",
/// ]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Luminance<P>(pub P);

impl<V, P: Palette<V>> Palette<V> for Luminance<P> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        let rgb = self.0.rgb(value);
        // weights with 16 fractional bits, of sum 2^16
        let sum = light(rgb.r()) * 13_933 + light(rgb.g()) * 46_871 + light(rgb.b()) * 4_732;
        let grey = (((sum >> 16) * 255 + (1 << 15)) >> 16) as u8;
        Rgb888::new(grey, grey, grey)
    }
}

/// The light of an encoded channel, below 1.
#[inline]
fn light(channel: u8) -> UQ16 {
    let v = u32::from(channel) * 257;
    let square = ((v * 20_606) >> 16) + 43_741;
    let line = ((v * square) >> 16) + 1_189;
    (v * line) >> 16
}

/// The negative of another palette: for displays whose `On` is black, as most e-paper's, or for white paper
/// instead of a dark ground.
///
/// Every channel becomes 255 minus itself. Outermost, so that the light is computed first:
/// `Inverted(Luminance(palette))`.
///
/// ```
/// use attractor::draw::{Grey, Inverted, Picture};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
///
/// let wedge = from_fn(Size::new(8, 2), |x, _| (x * 36) as u8);
/// let mut display = MockDisplay::<BinaryColor>::new();
/// Image::new(&Picture::new(wedge, Inverted(Grey)), Point::zero()).draw(&mut display)?;
/// display.assert_pattern(&["###.#...", "##.#.#.."]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inverted<P>(pub P);

impl<V, P: Palette<V>> Palette<V> for Inverted<P> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        let rgb = self.0.rgb(value);
        Rgb888::new(255 - rgb.r(), 255 - rgb.g(), 255 - rgb.b())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::{Grey, Ink, gradients};
    use embedded_graphics_core::geometry::Point;
    use embedded_graphics_core::pixelcolor::BinaryColor;

    /// IEC 61966-2-1.
    fn luminance(rgb: Rgb888) -> f64 {
        let decoded = |channel: u8| {
            let v = f64::from(channel) / 255.0;
            if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * decoded(rgb.r()) + 0.7152 * decoded(rgb.g()) + 0.0722 * decoded(rgb.b())
    }

    /// The share of the dots of a square that are lit.
    fn dots(rgb: Rgb888) -> f64 {
        let lit = |i: i32| BinaryColor::ink(rgb, Point::new(i & 7, i >> 3)).is_on();
        (0..64).filter(|i| lit(*i)).count() as f64 / 64.0
    }

    #[test]
    fn the_light_of_the_dots_is_the_light_of_the_colour() {
        let channel = || (0..=255_u8).step_by(15);
        let cube = || {
            channel()
                .flat_map(move |r| channel().flat_map(move |g| channel().map(move |b| Rgb888::new(r, g, b))))
        };
        let greys = || (0..=u8::MAX).map(|v| Rgb888::new(v, v, v));
        let (mut worst, mut worst_dots) = (0.0_f64, 0.0_f64);
        for color in cube().chain(greys()) {
            let grey = Luminance(|()| color).rgb(());
            assert!(grey.r() == grey.g() && grey.g() == grey.b());
            worst = worst.max((f64::from(grey.r()) - 255.0 * luminance(color)).abs());
            worst_dots = worst_dots.max((dots(grey) - luminance(color)).abs());
        }
        assert!(worst > 0.5 && worst <= 0.85, "{worst}");
        assert!(worst_dots > 0.006 && worst_dots < 0.0115, "{worst_dots}");
        // what it is for
        let plain = greys().map(|color| dots(color) - luminance(color)).fold(0.0, f64::max);
        assert!(plain > 0.28 && plain < 0.30, "{plain}");
        assert_eq!(Luminance(Grey).rgb(255_u8), Rgb888::WHITE);
        assert_eq!(Luminance(Grey).rgb(None::<u8>), Rgb888::BLACK);
        let rising: std::vec::Vec<u8> = (0..=u8::MAX).map(|v| Luminance(Grey).rgb(v).r()).collect();
        assert!(rising.is_sorted());
    }

    #[test]
    fn the_negative_of_the_negative_is_the_palette() {
        for level in 0..=u8::MAX {
            let color = gradients::FIRE.rgb(level);
            assert_eq!(Inverted(Inverted(gradients::FIRE)).rgb(level), color);
            let negative = Inverted(gradients::FIRE).rgb(level);
            assert_eq!((negative.r(), negative.g()), (255 - color.r(), 255 - color.g()));
            assert_eq!(negative.b(), 255 - color.b());
        }
        // on paper, where `On` is black, the dots take as much light as is missing
        for value in 0..=u8::MAX {
            let light = 1.0 - dots(Inverted(Luminance(Grey)).rgb(value));
            assert!((light - luminance(Rgb888::new(value, value, value))).abs() < 0.0115, "{value}");
        }
    }
}
