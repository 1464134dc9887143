//! What a closed path encloses, by the even-odd rule: the ground under its line.

use core::ops::Range;

use attractor::Error;
use attractor::draw::Level;
use attractor::plane::{Field, PathElement, Window};
use embedded_graphics::geometry::{Point, Size};

/// Levels of a whole display, row by row; none outside. The level grows towards the top.
#[derive(Debug)]
pub(crate) struct Area<'a> {
    size: Size,
    corner: Point,
    /// Whether the inside begins or ends at this column: a bit for each of the window's columns and one more,
    /// row by row.
    turns: &'a mut [u32],
    inner: Size,
}

/// How many words the ground under a path takes on a display of this size: a bit for each pixel and one more
/// a row.
pub const fn ground_words(size: Size) -> usize {
    ((size.width as usize + 1) * size.height as usize).div_ceil(32)
}

impl<'a> Area<'a> {
    /// The area of a path through `window`, whose first pixel lies at `corner` of a display of `size`.
    pub(crate) fn of(
        steps: impl Iterator<Item = PathElement>,
        window: &Window,
        (size, corner): (Size, Point),
        turns: &'a mut [u32],
    ) -> Result<Self, Error> {
        let inner = window.size();
        let (given, needed) = (turns.len(), ground_words(inner));
        if given < needed {
            return Err(Error::BufferLength { what: "words of the area", given, needed });
        }
        turns.fill(0);
        let mut area = Self { size, corner, turns, inner };
        let mut pen = None;
        for step in steps {
            let (p, draws) = match step {
                PathElement::MoveTo(p) => (p, false),
                PathElement::LineTo(p) => (p, true),
            };
            let to = window.raster(p);
            if let Some(from) = pen.filter(|_| draws) {
                area.edge(from, to);
            }
            pen = Some(to);
        }
        Ok(area)
    }

    /// The rows between both ends, the lower end left out.
    fn edge(&mut self, from: (i64, i64), to: (i64, i64)) {
        let ((x, top), (u, bottom)) = if from.1 < to.1 { (from, to) } else { (to, from) };
        let width = i64::from(self.inner.width);
        for row in top.max(0)..bottom.min(i64::from(self.inner.height)) {
            let offset = i128::from(row - top) * i128::from(u - x) / i128::from(bottom - top);
            let column = (x + offset as i64).clamp(0, width);
            let index = (row * (width + 1) + column) as usize;
            if let Some(word) = self.turns.get_mut(index / 32) {
                *word ^= 1 << (index % 32);
            }
        }
    }
}

impl Field for Area<'_> {
    type Value = Option<Level>;

    fn size(&self) -> Size {
        self.size
    }

    /// What lies left of the pixel decides: a row costs as much.
    fn at(&self, x: u32, y: u32) -> Option<Level> {
        self.row(y, x..x + 1).next().flatten()
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Option<Level>> {
        let row = y.wrapping_sub(self.corner.y.unsigned_abs());
        let lies_inside = row < self.inner.height;
        let mut area = AreaRow {
            turns: self.turns,
            level: Level::ratio(self.inner.height.saturating_sub(row), self.inner.height),
            index: row as usize * (self.inner.width as usize + 1),
            before: self.corner.x.unsigned_abs(),
            left: if lies_inside { self.inner.width + 1 } else { 0 },
            inside: false,
            columns: x.end - x.start,
        };
        (0..x.start).for_each(|_| area.step());
        area
    }
}

/// A row of an [`Area`].
struct AreaRow<'a> {
    turns: &'a [u32],
    level: Level,
    /// Of the next column.
    index: usize,
    /// Columns left of the window.
    before: u32,
    /// Those of the window that are left.
    left: u32,
    inside: bool,
    /// All that are wanted.
    columns: u32,
}

impl AreaRow<'_> {
    fn step(&mut self) {
        if self.before > 0 {
            self.before -= 1;
        } else if self.left > 0 {
            let word = self.turns.get(self.index / 32).copied().unwrap_or(0);
            self.inside ^= word >> (self.index % 32) & 1 == 1;
            self.index += 1;
            self.left -= 1;
        }
    }
}

impl Iterator for AreaRow<'_> {
    type Item = Option<Level>;

    fn next(&mut self) -> Option<Option<Level>> {
        self.columns = self.columns.checked_sub(1)?;
        self.step();
        Some(self.inside.then_some(self.level))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.columns as usize, Some(self.columns as usize))
    }
}

impl ExactSizeIterator for AreaRow<'_> {}
