//! A cursor that remembers which row of a picture comes next, for a main loop that draws one row a tick and
//! does other things between.

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::Point;

use super::image::Picture;
use super::ink::Ink;
use super::palette::Palette;
use crate::plane::Field;

/// Draws a [`Picture`] downwards, one row a call, and can stop and go on at every row.
///
/// It holds only the number of the row: picture and target stay free between the calls. Rows that the target
/// does not show take no call.
///
/// ```
/// use attractor::draw::{Grey, Picture, RowCursor};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
///
/// let picture = Picture::new(from_fn(Size::new(4, 3), |x, y| (x * y) as u8), Grey);
/// let mut display = MockDisplay::<Gray8>::new();
/// let mut cursor = RowCursor::new();
/// while cursor.draw_next(&picture, &mut display.translated(Point::new(2, 0)))? {
///     // read the buttons, feed the watchdog, give way to another task
/// }
/// assert_eq!(cursor.row(), 3);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RowCursor {
    next: u32,
}

impl RowCursor {
    /// At the first row.
    pub const fn new() -> Self {
        Self::starting_at(0)
    }

    /// At row `row`: what lies above stays as it is on the target.
    pub const fn starting_at(row: u32) -> Self {
        Self { next: row }
    }

    /// The row after the last one drawn; before the first call the row at which it starts.
    pub const fn row(&self) -> u32 {
        self.next
    }

    /// Draws the next row that the target shows of the picture at its origin; `false` if none was left. After
    /// an error the same row comes again.
    ///
    /// # Errors
    /// Those of the target.
    pub fn draw_next<F, P, C, D>(
        &mut self,
        picture: &Picture<F, P, C>,
        target: &mut D,
    ) -> Result<bool, D::Error>
    where
        F: Field,
        P: Palette<F::Value>,
        C: Ink,
        D: DrawTarget<Color = C>,
    {
        let (columns, rows) = picture.shown_on(target);
        let y = self.next.max(rows.start);
        if columns.is_empty() || y >= rows.end {
            return Ok(false);
        }
        picture.fill_row(target, y, columns, Point::zero())?;
        self.next = y + 1;
        Ok(true)
    }
}
