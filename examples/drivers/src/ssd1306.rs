//! Points on a one-bit OLED: `ssd1306` 0.10 over I2C.
//!
//! The driver keeps a buffer of 1 KiB and sends on `flush` what has changed. A chaos game draws points
//! without order: that is what the buffer is for.

use attractor::draw::Dots;
use attractor::ifs::catalogue;
use attractor::plane::Window;
use display_interface::DisplayError;
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::*;
use embedded_hal::i2c::I2c;
use ssd1306::prelude::*;
use ssd1306::{I2CDisplayInterface, Ssd1306};

use crate::{Failure, Outcome};

/// The fern, as large as it fits.
///
/// # Errors
/// The display's.
pub fn draw<D: DrawTarget<Color = BinaryColor>>(display: &mut D) -> Outcome<D::Error> {
    let fern = catalogue::BARNSLEY_FERN.ifs::<4>()?;
    let window = Window::fit(fern.bounds(), display.bounding_box().size)?;
    let points = fern.seeded_chaos_game(7).take(4_000);
    Dots::new(points, window, BinaryColor::On).draw(display).map_err(Failure::Display)?;
    Ok(())
}

/// From the bus to the picture.
///
/// # Errors
/// The display's.
pub fn show(i2c: impl I2c) -> Outcome<DisplayError> {
    let interface = I2CDisplayInterface::new(i2c);
    let display = Ssd1306::new(interface, DisplaySize128x64, DisplayRotation::Rotate0);
    let mut display = display.into_buffered_graphics_mode();
    display.init().map_err(Failure::Display)?;
    draw(&mut display)?;
    display.flush().map_err(Failure::Display)
}
