//! A Julia set just outside the Mandelbrot set.
//!
//! Written by `attractor export --gallery dendrite`.

use attractor::Error;
use attractor::draw::{Brightened, Gradient, Inside, gradients, hex};
use attractor::escape::{Julia, View};
use attractor::num::{Complex, Wide};
use embedded_graphics::geometry::Size;

/// The constant of the set.
pub const C: Complex<Wide> = Complex::lit("-0.8", "0.156");

/// The middle of the picture.
pub const CENTRE: Complex<Wide> = Complex::lit("0", "0");

/// Its width at least.
pub const WIDTH: Wide = Wide::lit("3.06404273211956");

/// Its height at least.
pub const HEIGHT: Wide = Wide::lit("3.06404273211956");

/// The most iterations.
pub const MAX_DWELL: u32 = 300;

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
pub fn picture(size: Size) -> Result<Julia, Error> {
    Julia::new(view(size)?, C, MAX_DWELL)
}

/// Its colours on a display with colour.
pub const COLOR: Inside<Brightened<Gradient<9>>> = Inside::new(Brightened(gradients::DUSK), hex(0x000000));

/// Its colours on a display without colour.
pub use self::COLOR as GREY;
