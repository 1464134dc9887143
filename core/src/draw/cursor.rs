//! A cursor that remembers which row comes next: drawing in portions, one row a tick.

use embedded_graphics_core::draw_target::DrawTarget;

use crate::draw::{Ink, Palette, Picture};
use crate::picture::Field;

/// Draws a [`Picture`] from the top, one row a call, and can stop and go on at every row.
///
/// It holds only the number of the row: picture and target stay free between the calls.
///
/// ```
/// use attractor::draw::{Grey, Picture, RowCursor};
/// # use attractor::picture::Field;
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
/// # struct Flat;
/// # impl Field for Flat {
/// #     type Value = u8;
/// #     type Row<'a> = core::iter::Map<core::ops::Range<u32>, fn(u32) -> u8>;
/// #     fn size(&self) -> Size { Size::new(4, 3) }
/// #     fn row(&self, _y: u32, x: core::ops::Range<u32>) -> Self::Row<'_> { x.map(|_| 255) }
/// # }
/// # let field = Flat;
///
/// let picture = Picture::new(field, Grey);
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
        Self { next: 0 }
    }

    /// The row that comes next: how many are done.
    pub const fn row(&self) -> u32 {
        self.next
    }

    /// Draws the next row with [`Picture::draw_row`]; `false` if none was left. After an error the same row comes again.
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
        if self.next >= picture.field().size().height {
            return Ok(false);
        }
        picture.draw_row(target, self.next)?;
        self.next += 1;
        Ok(true)
    }
}
