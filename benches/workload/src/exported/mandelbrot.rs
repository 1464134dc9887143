//! The Mandelbrot set, home view, the course unit's dwell palette.
//!
//! Written by `attractor export --gallery mandelbrot`.

use attractor::Error;
use attractor::draw::{Brightened, CourseUnit, Grey, Inside, hex};
use attractor::escape::{Mandelbrot, View};
use attractor::num::{Complex, Wide};
use embedded_graphics::geometry::Size;

/// The middle of the picture.
pub const CENTRE: Complex<Wide> = Complex::lit("-0.75", "0");

/// Its width at least.
pub const WIDTH: Wide = Wide::lit("3");

/// Its height at least.
pub const HEIGHT: Wide = Wide::lit("2.5");

/// The most iterations.
pub const MAX_DWELL: u32 = 100;

/// What a display of this size shows.
///
/// # Errors
/// Those of [`View::new`].
pub fn view(size: Size) -> Result<View, Error> {
    let (columns, rows) = (i64::from(size.width), i64::from(size.height.max(1)));
    let (whole, rest) = (HEIGHT.to_bits() / rows, HEIGHT.to_bits() % rows);
    let fitting = whole.saturating_mul(columns).saturating_add(rest * columns / rows);
    View::new(CENTRE, WIDTH.max(Wide::from_bits(fitting)), size)
}

/// Every pixel's orbit on a display of this size.
///
/// # Errors
/// Those of [`View::new`].
pub fn picture(size: Size) -> Result<Mandelbrot, Error> {
    Mandelbrot::new(view(size)?, MAX_DWELL)
}

/// Its colours on a display with colour.
pub const COLOR: Inside<CourseUnit> = Inside::new(CourseUnit, hex(0x000000));

/// Its colours on a display without colour.
pub const GREY: Inside<Brightened<Grey>> = Inside::new(Brightened(Grey), hex(0xffffff));
