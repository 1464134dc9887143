//! The square pixels of a view, counted: how many half pitches each is from the centre, whatever a pitch is.
//!
//! Both views share it, the one of 64-bit coordinates and the deep one.

use embedded_graphics_core::geometry::Size;

use crate::Error;
use crate::num::Wide;
use crate::plane::checked_size;

/// The most pixels by which [`View::pan`](crate::escape::View::pan) moves a view.
pub const MAX_PAN: u32 = (1 << 15) - 1;

/// Size, and how far the view was panned since it was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Raster {
    size: Size,
    /// Pixels to the right and up.
    panned: (i32, i32),
}

impl Raster {
    /// # Errors
    /// As [`checked_size`](crate::plane::checked_size).
    pub(crate) fn new(size: Size) -> Result<Self, Error> {
        Ok(Self { size: checked_size(size)?, panned: (0, 0) })
    }

    pub(crate) const fn size(self) -> Size {
        self.size
    }

    pub(crate) const fn panned(self) -> (i32, i32) {
        self.panned
    }

    /// Panned by whole pixels once more.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] after more than [`MAX_PAN`](crate::escape::MAX_PAN) pixels in one direction.
    pub(crate) fn pan(self, right: i32, up: i32) -> Result<Self, Error> {
        const MOST: Wide = Wide::from_bits((MAX_PAN as i64) << 48);
        let panned = (self.panned.0.saturating_add(right), self.panned.1.saturating_add(up));
        for pixels in [panned.0, panned.1] {
            if pixels.unsigned_abs() > MAX_PAN {
                let (what, value) = ("pixels to pan", Wide::saturating_from_num(pixels));
                return Err(Error::OutOfRange { what, index: None, value, min: -MOST, max: MOST });
            }
        }
        Ok(Self { panned, ..self })
    }

    /// From the centre to the middle of a column, in half pitches to the right. At most `2^17`.
    pub(crate) const fn across(self, column: u32) -> i32 {
        2 * (column as i32 + self.panned.0) + 1 - self.size.width as i32
    }

    /// From the centre to the middle of a row, in half pitches up.
    pub(crate) const fn up(self, row: u32) -> i32 {
        self.size.height as i32 - 1 - 2 * (row as i32 - self.panned.1)
    }

    /// How many half pitches the farthest edges are from the centre, across and up.
    pub(crate) const fn reach(self) -> [u32; 2] {
        [
            2 * self.panned.0.unsigned_abs() + self.size.width,
            2 * self.panned.1.unsigned_abs() + self.size.height,
        ]
    }
}
