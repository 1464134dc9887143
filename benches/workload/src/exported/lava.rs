//! Lava: marble whose veins glow.
//!
//! Written by `attractor export --gallery lava`.

use attractor::Error;
use attractor::num::{Lumen, Real, Rgb, Unit};
use attractor::plane::{Bounds2, Point2, Window};
use attractor::trace::texture::{Marble, Noise, Slice, Spline, Turbulence};
use embedded_graphics::geometry::Size;

/// The square that is shown at least.
pub const BOUNDS: Bounds2 = Bounds2 { min: Point2::lit("-2", "-2"), max: Point2::lit("2", "2") };

/// Where the plane is: time.
pub const HEIGHT: Real = Real::lit("0.7");

/// The texture.
///
/// # Errors
/// None: the command has built it.
#[rustfmt::skip]
pub fn texture() -> Result<Marble<5>, Error> {
    Ok(Marble { undulate: Spline::new(&[(const { Unit::lit("-1") }, const { Rgb::new(Lumen::lit("0.00914"), Lumen::lit("0.00122"), Lumen::lit("0.00122")) }), (const { Unit::lit("0.1") }, const { Rgb::new(Lumen::lit("0.05127"), Lumen::lit("0.00243"), Lumen::lit("0.00182")) }), (const { Unit::lit("0.65") }, const { Rgb::new(Lumen::lit("0.35153"), Lumen::lit("0.01161"), Lumen::lit("0.00122")) }), (const { Unit::lit("0.93") }, const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.16203"), Lumen::lit("0.00243")) }), (const { Unit::lit("1") }, const { Rgb::new(Lumen::lit("1"), Lumen::lit("0.87137"), Lumen::lit("0.35153")) })])?, turbulence: Turbulence::new(Noise::new(3), const { Real::lit("0.8") }, 6)?, amplitude: const { Real::lit("6") }, frequency: const { Real::lit("2") } })
}

/// The picture of the texture.
///
/// # Errors
/// Those of [`Window::fit`].
pub fn picture(size: Size) -> Result<Slice<Marble<5>>, Error> {
    Ok(Slice::new(texture()?, Window::fit(BOUNDS, size)?, HEIGHT))
}
