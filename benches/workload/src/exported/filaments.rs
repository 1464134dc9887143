//! Above the Mandelbrot set by its distance estimate: filaments thinner than a pixel.
//!
//! Written by `attractor export --gallery filaments`.

use attractor::Error;
use attractor::draw::{Grey, Inside, hex};
use attractor::escape::{Distance, Mandelbrot, View};
use attractor::num::{Complex, Wide};
use embedded_graphics::geometry::Size;

/// The middle of the picture.
pub const CENTRE: Complex<Wide> = Complex::lit("-0.16", "0.98");

/// Its width.
pub const WIDTH: Wide = Wide::lit("0.36");

/// The most iterations.
pub const MAX_DWELL: u32 = 500;

/// What a display of this size shows.
///
/// # Errors
/// Those of [`View::new`].
pub fn view(size: Size) -> Result<View, Error> {
    View::new(CENTRE, WIDTH, size)
}

/// Every pixel's orbit on a display of this size.
///
/// # Errors
/// Those of [`View::new`].
pub fn picture(size: Size) -> Result<Distance<Mandelbrot>, Error> {
    Ok(Distance(Mandelbrot::new(view(size)?, MAX_DWELL)?))
}

/// Its colours on a display with colour.
pub const COLOR: Inside<Grey> = Inside::new(Grey, hex(0x000000));

/// Its colours on a display without colour.
pub use self::COLOR as GREY;
