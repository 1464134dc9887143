//! Clouds: turbulence of six octaves, cut by a plane.
//!
//! Written by `attractor export --gallery clouds`.

use attractor::Error;
use attractor::num::{Lumen, Real, Rgb, Unit};
use attractor::plane::{Bounds2, Point2, Window};
use attractor::trace::texture::{Mottle, Noise, Slice, Spline, Turbulence};
use embedded_graphics::geometry::Size;

/// The square that is shown at least.
pub const BOUNDS: Bounds2 = Bounds2 { min: Point2::lit("-2.5", "-2.5"), max: Point2::lit("2.5", "2.5") };

/// Where the plane is: time.
pub const HEIGHT: Real = Real::lit("0.25");

/// The texture.
///
/// # Errors
/// None: the command has built it.
#[rustfmt::skip]
pub fn texture() -> Result<Mottle<4>, Error> {
    Ok(Mottle { undulate: Spline::new(&[(const { Unit::lit("-0.25") }, const { Rgb::new(Lumen::lit("0.02122"), Lumen::lit("0.09758"), Lumen::lit("0.39157")) }), (const { Unit::lit("-0.05") }, const { Rgb::new(Lumen::lit("0.0648"), Lumen::lit("0.21587"), Lumen::lit("0.57758")) }), (const { Unit::lit("0.15") }, const { Rgb::new(Lumen::lit("0.39157"), Lumen::lit("0.57758"), Lumen::lit("0.80695")) }), (const { Unit::lit("0.4") }, Rgb::WHITE)])?, turbulence: Turbulence::new(Noise::new(0), const { Real::lit("1") }, 6)? })
}

/// The picture of the texture.
///
/// # Errors
/// Those of [`Window::fit`].
pub fn picture(size: Size) -> Result<Slice<Mottle<4>>, Error> {
    Ok(Slice::new(texture()?, Window::fit(BOUNDS, size)?, HEIGHT))
}
