//! What a closed path encloses, by the even-odd rule: the ground under its line.

use std::ops::Range;

use attractor::draw::Level;
use attractor::picture::{Field, Step, Window};
use embedded_graphics::geometry::{Point, Size};

/// Levels of a whole display, row by row; none outside. The level grows towards the top.
#[derive(Debug)]
pub(super) struct Area {
    size: Size,
    corner: Point,
    /// Whether the inside begins or ends at this column: the window's columns and one more, row by row.
    turns: Vec<bool>,
    inner: Size,
}

impl Area {
    /// The area of a path through `window`, whose first pixel lies at `corner` of a display of `size`.
    pub(super) fn of(steps: impl Iterator<Item = Step>, window: &Window, size: Size, corner: Point) -> Self {
        let inner = window.size();
        let turns = vec![false; (inner.width as usize + 1) * inner.height as usize];
        let mut area = Self { size, corner, turns, inner };
        let mut pen = None;
        for step in steps {
            let (p, draws) = match step {
                Step::MoveTo(p) => (p, false),
                Step::LineTo(p) => (p, true),
            };
            let to = window.raster(p);
            if let Some(from) = pen.filter(|_| draws) {
                area.edge(from, to);
            }
            pen = Some(to);
        }
        area
    }

    /// The rows between both ends, the lower end left out.
    fn edge(&mut self, from: (i64, i64), to: (i64, i64)) {
        let ((x, top), (u, bottom)) = if from.1 < to.1 { (from, to) } else { (to, from) };
        let width = i64::from(self.inner.width);
        for row in top.max(0)..bottom.min(i64::from(self.inner.height)) {
            let offset = i128::from(row - top) * i128::from(u - x) / i128::from(bottom - top);
            let column = (x + offset as i64).clamp(0, width);
            let index = row * (width + 1) + column;
            if let Some(turn) = usize::try_from(index).ok().and_then(|i| self.turns.get_mut(i)) {
                *turn = !*turn;
            }
        }
    }
}

impl Field for Area {
    type Value = Option<Level>;
    type Row<'a> = Box<dyn Iterator<Item = Option<Level>> + 'a>;

    fn size(&self) -> Size {
        self.size
    }

    fn row(&self, y: u32, x: Range<u32>) -> Self::Row<'_> {
        let (left, row) = (self.corner.x.unsigned_abs(), y.wrapping_sub(self.corner.y.unsigned_abs()));
        if row >= self.inner.height {
            return Box::new(x.map(|_| None));
        }
        let level = Level::ratio(self.inner.height - row, self.inner.height);
        let start = row as usize * (self.inner.width as usize + 1);
        let turns = self.turns.get(start..=start + self.inner.width as usize).unwrap_or_default();
        let skipped = turns.iter().take(x.start.saturating_sub(left) as usize);
        let mut inside = skipped.filter(|turn| **turn).count() % 2 == 1;
        Box::new(x.map(move |x| {
            let turn = x.checked_sub(left).and_then(|column| turns.get(column as usize));
            inside ^= turn.copied().unwrap_or(false);
            inside.then_some(level)
        }))
    }
}
