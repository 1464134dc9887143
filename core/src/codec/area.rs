//! Where a leaf's pixels are in the memory of a picture.

use core::cell::Cell;

use super::sample::Sample;

/// The part of a leaf that lies inside the picture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Area<'a, S: Sample> {
    pub(super) picture: &'a [Cell<S>],
    /// Where its first pixel is, and how far the next row.
    pub(super) start: u32,
    pub(super) columns: u32,
    pub(super) wide: u32,
    pub(super) high: u32,
}

impl<'a, S: Sample> Area<'a, S> {
    /// Whether that is all of a leaf with so many pixels a side.
    #[inline]
    pub(super) const fn is_whole(&self, side: u32) -> bool {
        self.wide == side && self.high == side
    }

    /// A row; none below.
    #[inline]
    pub(super) fn row(&self, i: u32) -> &'a [Cell<S>] {
        if i >= self.high {
            return &[];
        }
        let start = (self.start + i * self.columns) as usize;
        self.picture.get(start..start + self.wide as usize).unwrap_or(&[])
    }
}
