//! How often each pixel was hit, as a field: the measure of an attractor.

use std::ops::Range;

use attractor::draw::Level;
use attractor::picture::{Field, Point2, Window};
use embedded_graphics::geometry::{Point, Size};

/// Levels of a whole display, row by row; none where no point fell.
#[derive(Debug)]
pub(super) struct Density {
    levels: Vec<Option<Level>>,
    size: Size,
}

impl Density {
    /// Counts points seen through `window`, whose first pixel lies at `corner`.
    pub(super) fn of(
        points: impl Iterator<Item = Point2>,
        window: &Window,
        size: Size,
        corner: Point,
    ) -> Self {
        let mut counts = vec![0_u32; size.width as usize * size.height as usize];
        for pixel in points.filter_map(|p| window.pixel(p)) {
            let at = pixel + corner;
            let index = at.y as usize * size.width as usize + at.x as usize;
            if let Some(count) = counts.get_mut(index) {
                *count = count.saturating_add(1);
            }
        }
        // the scale ends where only one hit pixel in 50 lies above
        let mut hit: Vec<u32> = counts.iter().copied().filter(|c| *c > 0).collect();
        hit.sort_unstable();
        let full = hit.get(hit.len() * 49 / 50).copied().unwrap_or(1);
        // the square root twice: neither the trunk nor the finest leaves are lost
        let level = |count: u32| {
            let root = (u32::from(Level::ratio(count, full).0) * u32::from(u16::MAX)).isqrt();
            Level(((root * u32::from(u16::MAX)).isqrt()) as u16)
        };
        let levels = counts.into_iter().map(|c| (c > 0).then(|| level(c))).collect();
        Self { levels, size }
    }
}

impl Field for Density {
    type Value = Option<Level>;
    type Row<'a> = std::iter::Copied<std::slice::Iter<'a, Option<Level>>>;

    fn size(&self) -> Size {
        self.size
    }

    fn row(&self, y: u32, x: Range<u32>) -> Self::Row<'_> {
        let start = y as usize * self.size.width as usize;
        let row = self.levels.get(start + x.start as usize..start + x.end as usize);
        row.unwrap_or_default().iter().copied()
    }
}
