//! Inside the Mandelbrot set: one colour for each period.
//!
//! Written by `attractor export --gallery mandelbrot-periods`.

use attractor::Error;
use attractor::draw::{Grey, Inside, Ramp, gradients};
use attractor::escape::{Interior, Mandelbrot, View};
use attractor::num::{Complex, Wide};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;

/// The middle of the picture.
pub const CENTRE: Complex<Wide> = Complex::lit("-0.3", "0.75");

/// Its width.
pub const WIDTH: Wide = Wide::lit("1");

/// The most iterations.
pub const MAX_DWELL: u32 = 1000;

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
pub fn picture(size: Size) -> Result<Interior<Mandelbrot>, Error> {
    Ok(Interior(Mandelbrot::new(view(size)?, MAX_DWELL)?))
}

/// Its colours on a display with colour.
/// `paper` is what lies outside: 0x0b0e1a, black where that could only be scattered dots.
pub fn color(paper: Rgb888) -> Inside<Ramp<6>> {
    Inside::new(Ramp::of_periods(gradients::EVEN), paper)
}

/// Its colours on a display without colour.
/// `paper` is what lies outside: 0x0b0e1a, black where that could only be scattered dots.
pub fn grey(paper: Rgb888) -> Inside<Ramp<6>> {
    Inside::new(Ramp::of_periods(Grey), paper)
}
