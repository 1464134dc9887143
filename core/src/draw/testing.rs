//! A field and two targets for the tests of this room.

extern crate std;

use core::cell::Cell;
use core::convert::Infallible;
use std::vec::Vec;

use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::{PointsIter, Rectangle};

use crate::num::Real;
use crate::plane::{Field, Point2};

/// The point of the plane with these integer coordinates.
pub(super) fn point(x: i32, y: i32) -> Point2 {
    Point2::new(Real::from_num(x), Real::from_num(y))
}

/// A field that counts its evaluations; no two neighbouring pixels and no two rows agree.
pub(super) struct Counted {
    pub(super) size: Size,
    pub(super) evaluated: Cell<usize>,
}

impl Counted {
    pub(super) fn new(width: u32, height: u32) -> Self {
        Self { size: Size::new(width, height), evaluated: Cell::new(0) }
    }

    pub(super) fn value(x: u32, y: u32) -> u8 {
        (x * 37 + y * 101 + (x * y) % 7) as u8
    }
}

impl Field for Counted {
    type Value = u8;

    fn size(&self) -> Size {
        self.size
    }

    fn at(&self, x: u32, y: u32) -> u8 {
        assert!(x < self.size.width && y < self.size.height, "asked beyond the field");
        self.evaluated.set(self.evaluated.get() + 1);
        Self::value(x, y)
    }
}

/// A frame buffer that shows only the part `window` of itself, reports that part as its bounding box, and
/// ignores what lies beside it.
pub(super) struct Frame<C> {
    size: Size,
    pub(super) window: Rectangle,
    pub(super) colors: Vec<C>,
    pub(super) drawn: usize,
}

impl<C: PixelColor> Frame<C> {
    pub(super) fn new(size: Size, color: C) -> Self {
        let pixels = (size.width * size.height) as usize;
        let window = Rectangle::new(Point::zero(), size);
        Self { size, window, colors: std::vec![color; pixels], drawn: 0 }
    }

    pub(super) fn pixels(&self, area: &Rectangle) -> Vec<C> {
        area.points().map(|p| self.colors[p.y as usize * self.size.width as usize + p.x as usize]).collect()
    }
}

impl<C> Dimensions for Frame<C> {
    fn bounding_box(&self) -> Rectangle {
        self.window
    }
}

impl<C: PixelColor> DrawTarget for Frame<C> {
    type Color = C;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, color) in pixels {
            if self.window.contains(at) {
                self.colors[at.y as usize * self.size.width as usize + at.x as usize] = color;
                self.drawn += 1;
            }
        }
        Ok(())
    }
}

/// How a [`Driver`] treats the colours of a `fill_contiguous`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Manner {
    /// Reads them all and one more, which must not exist.
    Strict,
    /// Shows only these columns and skips the others with `nth`, as mipidsi clips.
    Skip(i32, i32),
    /// Fails at this row.
    FailAt(i32),
}

/// A driver that accepts nothing but `fill_contiguous` with areas inside its bounding box, and writes down
/// what it was given.
pub(super) struct Driver<C> {
    pub(super) area: Rectangle,
    pub(super) manner: Manner,
    pub(super) calls: Vec<(Rectangle, Vec<C>)>,
}

impl<C> Driver<C> {
    pub(super) fn new(area: Rectangle, manner: Manner) -> Self {
        Self { area, manner, calls: Vec::new() }
    }
}

impl<C> Dimensions for Driver<C> {
    fn bounding_box(&self) -> Rectangle {
        self.area
    }
}

impl<C: PixelColor> DrawTarget for Driver<C> {
    type Color = C;
    type Error = &'static str;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, _: I) -> Result<(), &'static str> {
        panic!("a field is drawn with fill_contiguous");
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colors: I,
    ) -> Result<(), &'static str> {
        assert!(
            !area.is_zero_sized() && self.area.intersection(area) == *area,
            "{area:?} in {:?}",
            self.area
        );
        assert_eq!(area.size.height, 1);
        let count = area.size.width as usize;
        let mut colors = colors.into_iter();
        assert_eq!(colors.size_hint(), (count, Some(count)));
        let seen: Vec<C> = match self.manner {
            Manner::FailAt(row) if row == area.top_left.y => return Err("the bus is gone"),
            Manner::Skip(from, to) => {
                let skip = (from - area.top_left.x).max(0);
                let take = (to - area.top_left.x.max(from)).max(0);
                if skip > 0 {
                    colors.nth(skip as usize - 1);
                }
                colors.take(take as usize).collect()
            }
            Manner::Strict | Manner::FailAt(_) => {
                let all: Vec<C> = colors.by_ref().take(count).collect();
                assert_eq!(all.len(), count, "too few colours");
                assert!(colors.next().is_none() && colors.next().is_none(), "too many colours");
                all
            }
        };
        self.calls.push((*area, seen));
        Ok(())
    }
}
