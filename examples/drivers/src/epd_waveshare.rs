//! Dithered greys on e-paper: `epd-waveshare` 0.6 over SPI, here the 2.9 inch V2.
//!
//! The driver's colours are of its own; they come from `BinaryColor`, where `On` is black. So the picture is
//! drawn in `BinaryColor` by a palette that is turned round, and `color_converted` does the rest.

use attractor::draw::{Grey, Palette, Picture};
use attractor::escape::{Dwell, Julia, View};
use attractor::num::Complex;
use attractor::num::Wide;
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::{BinaryColor, Rgb888};
use embedded_graphics::prelude::*;
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{InputPin, OutputPin};
use embedded_hal::spi::SpiDevice;
use epd_waveshare::epd2in9_v2::{Display2in9, Epd2in9};
use epd_waveshare::prelude::WaveshareDisplay;

use crate::{Failure, Outcome};

/// The more ink the higher the dwell, most in the set: what is to be dark is drawn light, as `On` is black.
fn ink(dwell: Dwell) -> Rgb888 {
    if dwell.is_inside() { Rgb888::WHITE } else { Grey.rgb(dwell) }
}

/// Douady's rabbit.
///
/// # Errors
/// The display's.
pub fn draw<D: DrawTarget<Color = BinaryColor>>(display: &mut D) -> Outcome<D::Error> {
    const CENTRE: Complex<Wide> = Complex::new(Wide::ZERO, Wide::ZERO);
    const WIDTH: Wide = Wide::lit("3.2");
    const RABBIT: Complex<Wide> = Complex::new(Wide::lit("-0.123"), Wide::lit("0.745"));
    let view = View::new(CENTRE, WIDTH, display.bounding_box().size)?;
    let picture = Picture::new(Julia::new(view, RABBIT, 60)?, ink);
    Image::new(&picture, Point::zero()).draw(display).map_err(Failure::Display)
}

/// From the bus to the picture.
///
/// # Errors
/// The bus's.
pub fn show<SPI: SpiDevice>(
    spi: &mut SPI,
    busy: impl InputPin,
    dc: impl OutputPin,
    reset: impl OutputPin,
    delay: &mut impl DelayNs,
) -> Outcome<SPI::Error> {
    let mut paper = Epd2in9::new(spi, busy, dc, reset, delay, None).map_err(Failure::Display)?;
    let mut display = Display2in9::default();
    draw(&mut display.color_converted()).map_err(|failure| match failure {
        Failure::Picture(error) => Failure::Picture(error),
    })?;
    paper.update_and_display_frame(spi, display.buffer(), delay).map_err(Failure::Display)
}
