//! A polyline and its images under all compositions of the maps, order by order, as small multiples on one
//! picture.

use attractor::Error;
use attractor::ifs::{CopiedPath, Ifs};
use attractor::num::Real;
use attractor::plane::{Bounds2, Point2, Window};
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;

use crate::named::Named;
use crate::page::{Display, Extent, Watch, inner, paper};
use crate::pencil::Pencil;

/// A row of copies ready to be drawn.
#[derive(Debug)]
pub struct Copies<'a, const N: usize, const DEPTH: usize> {
    ifs: &'a Ifs<N>,
    shape: &'a [Point2],
    orders: &'a [u32],
    /// What all orders take: one scale for all, so that convergence shows.
    room: Bounds2,
    pencil: Pencil,
}

impl<'a, const N: usize, const DEPTH: usize> Copies<'a, N, DEPTH> {
    /// The images of `shape` at these orders. All of them are walked once, to find their common scale.
    ///
    /// # Errors
    /// Those of [`Ifs::copier`].
    pub fn new(
        ifs: &'a Ifs<N>,
        shape: &'a [Point2],
        orders: &'a [u32],
        palette: Named,
    ) -> Result<Self, Error> {
        let nothing = Bounds2 { min: Point2::default(), max: Point2::default() };
        let mut copies =
            Self { ifs, shape, orders, room: nothing, pencil: Pencil { palette, closed: false } };
        let mut extent: Option<Extent> = None;
        for order in orders {
            let this = Extent::of(copies.path(*order)?)?;
            extent = Some(extent.map_or(this, |before| before.with(this)));
        }
        copies.room = extent.map_or(nothing, |extent| extent.room());
        Ok(copies)
    }

    /// All images of one order.
    ///
    /// # Errors
    /// Those of [`Ifs::copier`].
    pub fn path(&self, order: u32) -> Result<CopiedPath<'a, N, DEPTH>, Error> {
        Ok(self.ifs.copier(self.shape, order)?.path())
    }

    /// Draws all orders.
    ///
    /// # Errors
    /// Those of [`Window::fit`].
    pub fn draw<D: Display>(&self, size: Size, target: &mut D, watch: Watch<'_, D>) -> Result<(), Error> {
        paper(size, target);
        let all = self.orders.len() as u32;
        let panels = Panels::new(inner(size, 2), all, &self.room);
        for (i, order) in (0..).zip(self.orders) {
            let panel = panels.place(i);
            let window = Window::fit(self.room, panel.size)?;
            let points = Extent::of(self.path(*order)?)?.points;
            let part = &mut |target: &mut D, _, _| watch(target, i + 1, all);
            if !self.pencil.line(self.path(*order)?, points, (window, panel.top_left), target, part) {
                break;
            }
        }
        Ok(())
    }
}

/// As many equal rectangles as large as possible for this shape; the last row in the middle.
#[derive(Debug)]
struct Panels {
    area: Rectangle,
    cell: Size,
    gap: u32,
    columns: u32,
    count: u32,
    top: u32,
}

impl Panels {
    fn new(area: Rectangle, count: u32, room: &Bounds2) -> Self {
        let (width, height) = (area.size.width, area.size.height);
        let gap = width.min(height) / 24;
        let side = |whole: u32, parts: u32| (whole.saturating_sub(gap * (parts - 1)) / parts).max(1);
        let cell = |columns: u32| Size::new(side(width, columns), side(height, count.div_ceil(columns)));
        let extent = |min: Real, max: Real| (i64::from(max.to_bits()) - i64::from(min.to_bits())).max(1);
        let (x, y) = (extent(room.min.x, room.max.x), extent(room.min.y, room.max.y));
        // pixels a unit, times 2^56
        let scale = |columns: &u32| {
            let cell = cell(*columns);
            let pixels = |side: u32, extent: i64| (i128::from(side) << 56) / i128::from(extent);
            pixels(cell.width, x).min(pixels(cell.height, y))
        };
        // of equals the first
        let columns = (1..=count).rev().max_by_key(scale).unwrap_or(1);
        let (cell, rows) = (cell(columns), count.div_ceil(columns));
        let top = height.saturating_sub(cell.height * rows + gap * (rows - 1)) / 2;
        Self { area, cell, gap, columns, count, top }
    }

    fn place(&self, i: u32) -> Rectangle {
        let Self { area, cell, gap, columns, count, top } = self;
        let (row, column) = (i / columns, i % columns);
        let in_row = (*columns).min(count - row * columns);
        let left = area.size.width.saturating_sub(cell.width * in_row + gap * (in_row - 1)) / 2;
        let offset =
            Point::new((left + column * (cell.width + gap)) as i32, (top + row * (cell.height + gap)) as i32);
        Rectangle::new(area.top_left + offset, *cell)
    }
}
