//! Colours that dithering leaves alone.

use attractor::draw::Ink;
use embedded_graphics::geometry::Point;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};

/// The colour at its brightest, never dithered away: for lines and dots.
pub fn solid<C: Ink>(rgb: Rgb888) -> C {
    // Bayer's lowest threshold
    C::ink(rgb, Point::zero())
}

/// A dark ground: black on displays that could only show it as scattered dots.
pub fn ground<C: Ink>(rgb: Rgb888) -> Rgb888 {
    // Bayer's highest threshold
    if C::ink(rgb, Point::new(0, 7)) == C::ink(Rgb888::BLACK, Point::zero()) { Rgb888::BLACK } else { rgb }
}
