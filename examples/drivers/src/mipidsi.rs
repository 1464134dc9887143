//! A field on a colour display: `mipidsi` 0.10 over SPI, here an ST7789.
//!
//! Rows are computed while they are sent: there is no framebuffer. The driver collects pixels in a buffer
//! that you lend, the larger the fewer transfers. A field is drawn by `fill_contiguous`, so `mipidsi`'s
//! feature `batch` is not needed.

use attractor::draw::{Picture, gradients};
use attractor::escape::{Mandelbrot, View};
use embedded_graphics::image::Image;
use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::prelude::*;
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiDevice;
use mipidsi::Builder;
use mipidsi::interface::{SpiError, SpiInterface};
use mipidsi::models::ST7789;

use crate::{Failure, Outcome};

/// The whole set.
///
/// # Errors
/// The display's.
pub fn draw<D: DrawTarget<Color = Rgb565>>(display: &mut D) -> Outcome<D::Error> {
    let view = View::home(display.bounding_box().size)?;
    let picture = Picture::new(Mandelbrot::new(view, 100)?, gradients::FIRE);
    Image::new(&picture, Point::zero()).draw(display).map_err(Failure::Display)
}

/// A display that did not start, or failed later.
#[derive(Debug)]
pub enum Trouble<SPI, PIN> {
    /// While it was set up. (What `init` returns has a type that cannot be named outside the driver.)
    Start,
    /// Later.
    Drawing(SpiError<SPI, PIN>),
}

/// From the bus to the picture. `dc` and `reset` are pins of one kind here.
///
/// # Errors
/// The display's.
pub fn show<SPI: SpiDevice, PIN: OutputPin>(
    spi: SPI,
    dc: PIN,
    reset: PIN,
    delay: &mut impl DelayNs,
) -> Outcome<Trouble<SPI::Error, PIN::Error>> {
    let mut buffer = [0; 480];
    let interface = SpiInterface::new(spi, dc, &mut buffer);
    let mut display = Builder::new(ST7789, interface)
        .display_size(240, 240)
        .reset_pin(reset)
        .init(delay)
        .map_err(|_| Failure::Display(Trouble::Start))?;
    draw(&mut display).map_err(|failure| match failure {
        Failure::Picture(error) => Failure::Picture(error),
        Failure::Display(error) => Failure::Display(Trouble::Drawing(error)),
    })
}
