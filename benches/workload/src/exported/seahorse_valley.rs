//! Between head and body of the Mandelbrot set: seahorse valley.
//!
//! Written by `attractor export --gallery seahorse-valley`.

use attractor::Error;
use attractor::draw::{Cycled, Gradient, Inside, gradients, hex};
use attractor::escape::{Mandelbrot, View};
use attractor::num::{Complex, Wide};
use embedded_graphics::geometry::Size;

/// The middle of the picture.
pub const CENTRE: Complex<Wide> = Complex::lit("-0.7453", "0.1127");

/// Its width.
pub const WIDTH: Wide = Wide::lit("0.0065");

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
pub fn picture(size: Size) -> Result<Mandelbrot, Error> {
    Mandelbrot::new(view(size)?, MAX_DWELL)
}

/// Its colours on a display with colour.
pub const COLOR: Inside<Cycled<Gradient<13>>> =
    Inside::new(Cycled::new(gradients::PORCELAIN, 96), hex(0x000000));

/// Its colours on a display without colour.
pub use self::COLOR as GREY;
