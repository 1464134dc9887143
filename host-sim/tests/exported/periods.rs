//! Periods of a filled-in set, all of it.
//!
//! Written by `attractor export periods`.

use attractor::Error;
use attractor::draw::{CourseUnit, Inside, Ramp, gradients};
use attractor::escape::{Interior, Julia, View};
use attractor::num::{Complex, Wide};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::Rgb888;

/// The constant of the set.
pub const C: Complex<Wide> = Complex::lit("-0.12", "0.74");

/// The middle of the picture.
pub const CENTRE: Complex<Wide> = Complex::lit("0", "0");

/// Its width at least.
pub const WIDTH: Wide = Wide::lit("2.999666567891836");

/// Its height at least.
pub const HEIGHT: Wide = Wide::lit("2.999666567891836");

/// The most iterations.
pub const MAX_DWELL: u32 = 500;

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
pub fn picture(size: Size) -> Result<Interior<Julia>, Error> {
    Ok(Interior(Julia::new(view(size)?, C, MAX_DWELL)?))
}

/// Its colours on a display with colour.
/// `paper` is what lies outside: 0x0b0e1a, black where that could only be scattered dots.
pub fn color(paper: Rgb888) -> Inside<Ramp<6>> {
    Inside::new(Ramp::of_periods(gradients::FIRE), paper)
}

/// Its colours on a display without colour.
/// `paper` is what lies outside: 0x0b0e1a, black where that could only be scattered dots.
pub fn grey(paper: Rgb888) -> Inside<Ramp<6>> {
    Inside::new(Ramp::of_periods(CourseUnit), paper)
}
