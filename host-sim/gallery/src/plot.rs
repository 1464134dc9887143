//! The part of a display on which a function is drawn: where a value lies there, and the dots that mark it.

use attractor::draw::hex;
use attractor::fif::Fif;
use attractor::num::{Real, Wide};
use attractor::plane::{Point2, Window};
use embedded_graphics::Pixel;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb888;

use crate::ink::solid;
use crate::page::Display;

/// Knots and other marks.
pub(crate) const MARK: Rgb888 = hex(0xffb454);

/// Where it is, and what of the plane it shows: abscissae are parts of the domain.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plot {
    /// Of the whole display.
    pub(crate) size: Size,
    /// Left and top.
    pub(crate) corner: Point,
    pub(crate) window: Window,
}

impl Plot {
    /// The pixel that shows a point.
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

/// The value of a function at a part of its domain.
pub(crate) fn value<const N: usize, const D: usize>(fif: &Fif<N, D>, part: Real) -> Real {
    let (from, to) = fif.domain();
    let width = i128::from(to.to_bits()) - i128::from(from.to_bits());
    let offset = (width * i128::from(part.to_bits())) >> 24;
    fif.at(Wide::from_bits((i128::from(from.to_bits()) + offset) as i64))
}
