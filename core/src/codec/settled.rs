//! Which part of a picture no sweep changes any more: a bit for each cell of 4 x 4.

use core::cell::Cell;

use super::sample::Sample;

/// A bit for each cell, in lent samples, 8 of them a sample; all are set where there is no memory.
#[derive(Debug, Clone, Copy)]
pub(super) struct Settled<'a, S: Sample> {
    bits: &'a [Cell<S>],
    /// Samples in a row of cells.
    across: u32,
}

impl<'a, S: Sample> Settled<'a, S> {
    /// How many samples it borrows for a picture.
    pub(super) const fn samples(width: u32, height: u32) -> usize {
        width.div_ceil(32) as usize * height.div_ceil(4) as usize
    }

    /// Of so many columns.
    pub(super) const fn new(bits: &'a [Cell<S>], width: u32) -> Self {
        Self { bits, across: width.div_ceil(32) }
    }

    /// Nothing is.
    pub(super) fn clear(&self) {
        self.bits.iter().for_each(|bits| bits.set(S::cut(0)));
    }

    /// Whether all cells that a square of pixels touches are settled.
    pub(super) fn has(&self, x: u32, y: u32, side: u32) -> bool {
        self.bits.is_empty() || self.each(x, y, side, |bits, mask| bits.get().number() & mask == mask)
    }

    /// They are from now on.
    pub(super) fn add(&self, x: u32, y: u32, side: u32) {
        self.each(x, y, side, |bits, mask| {
            bits.set(S::cut(bits.get().number() | mask));
            true
        });
    }

    /// Shows the cells of a square, eight at a time, until one says no.
    #[inline(never)]
    fn each(&self, x: u32, y: u32, side: u32, mut seen: impl FnMut(&Cell<S>, i32) -> bool) -> bool {
        let (first, last) = (x >> 2, (x + side - 1) >> 2);
        for row in y >> 2..=(y + side - 1) >> 2 {
            for eight in first >> 3..=(last >> 3).min(self.across - 1) {
                let low = first.saturating_sub(8 * eight);
                let high = (last - 8 * eight).min(7);
                let mask = (2 << high) - (1 << low);
                let bits = self.bits.get((row * self.across + eight) as usize);
                if bits.is_some_and(|bits| !seen(bits, mask)) {
                    return false;
                }
            }
        }
        true
    }
}
