//! Which part of a picture no sweep changes any more: a bit for each cell of 4 x 4.

use core::cell::Cell;

use super::rolled::rolled;
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
        self.bits.is_empty() || self.each(x, y, side, !0)
    }

    /// Whether the cell of a pixel is.
    #[inline]
    pub(super) fn at(&self, x: u32, y: u32) -> bool {
        let bits = self.bits.get(((y >> 2) * self.across + (x >> 5)) as usize);
        bits.is_none_or(|bits| bits.get().number() >> (x >> 2 & 7) & 1 == 1)
    }

    /// They are from now on.
    pub(super) fn add(&self, x: u32, y: u32, side: u32) {
        self.each(x, y, side, 0);
    }

    /// Settles the cells of a square, eight at a time, until one of `wanted` is not: whether there is none.
    #[inline(never)]
    fn each(&self, x: u32, y: u32, side: u32, wanted: i32) -> bool {
        let (first, last) = (x >> 2, (x + side - 1) >> 2);
        for row in y >> 2..=(y + side - 1) >> 2 {
            for eight in first >> 3..=(last >> 3).min(self.across - 1) {
                let low = first.saturating_sub(8 * eight);
                let high = (last - 8 * eight).min(7);
                let mask = (2 << high) - (1 << low);
                let Some(bits) = self.bits.get((row * self.across + eight) as usize) else { break };
                let there = bits.get().number();
                if mask & !there & wanted != 0 {
                    return false;
                }
                bits.set(S::cut(there | mask));
                rolled();
            }
            rolled();
        }
        true
    }
}
