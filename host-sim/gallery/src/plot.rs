//! Where points of a graph lie on a display.

use attractor::draw::hex;
use attractor::picture::{Point2, Window};
use embedded_graphics::Pixel;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb888;

use crate::ink::solid;
use crate::page::Display;

/// Knots and other marks.
pub(crate) const MARK: Rgb888 = hex(0xffb454);
/// A window on a part of a display.
#[derive(Debug)]
pub(crate) struct Plot {
    /// Of the display.
    pub(crate) size: Size,
    /// Left and top of the window.
    pub(crate) corner: Point,
    pub(crate) window: Window,
}

impl Plot {
    /// The pixel that shows a point with a unit abscissa.
    pub(crate) fn pixel(&self, at: Point2) -> Point {
        let (column, row) = self.window.raster(at);
        let size = self.window.size();
        let inside = |v: i64, side: u32| v.clamp(0, i64::from(side) - 1) as i32;
        self.corner + Point::new(inside(column, size.width), inside(row, size.height))
    }

    /// A dot of 3 x 3 pixels, of 5 x 5 on a large display.
    pub(crate) fn mark<T: Display>(&self, at: Point2, target: &mut T) {
        let centre = self.pixel(at);
        let reach = if self.size.width.min(self.size.height) < 200 { 1 } else { 2 };
        let color = solid::<T::Color>(MARK);
        let dots = (-reach..=reach).flat_map(|y| (-reach..=reach).map(move |x| Point::new(x, y)));
        // without its corners, so that it looks round
        let dots = dots.filter(|p| reach == 1 || p.x.abs() + p.y.abs() <= 3);
        let Ok(()) = target.draw_iter(dots.map(|p| Pixel(centre + p, color)));
    }
}
