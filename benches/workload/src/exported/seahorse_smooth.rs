//! Seahorse valley without bands: fractional dwell, equalised palette.
//!
//! Written by `attractor export --gallery seahorse-smooth`.

use attractor::Error;
use attractor::draw::{Equalised, Gradient, Inside, Leveled, gradients, hex};
use attractor::escape::{Mandelbrot, Smooth, View};
use attractor::num::{Complex, Wide};
use attractor::plane::Field;
use embedded_graphics::geometry::Size;

/// The middle of the picture.
pub const CENTRE: Complex<Wide> = Complex::lit("-0.7453", "0.1127");

/// Its width.
pub const WIDTH: Wide = Wide::lit("0.0065");

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
pub fn picture(size: Size) -> Result<Smooth<Mandelbrot>, Error> {
    Ok(Smooth(Mandelbrot::new(view(size)?, MAX_DWELL)?))
}

/// Counts that an equalised palette borrows.
pub const COUNTS: usize = 16001;

/// Its colours on a display with colour.
///
/// # Errors
/// [`Error::BufferLength`] for fewer counts than [`COUNTS`].
pub fn color<'a>(
    picture: &impl Field<Value: Leveled>,
    counts: &'a mut [u32],
) -> Result<Inside<Equalised<'a, Gradient<9>>>, Error> {
    Ok(Inside::new(Equalised::new(picture, counts, gradients::DUSK)?, hex(0x0b0e1a)))
}

/// Its colours on a display without colour.
pub use self::color as grey;
