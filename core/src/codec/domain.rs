//! The samples of a domain: every second row and column of a square, averaged and turned.

use core::cell::Cell;

use super::sample::Sample;

/// A domain, halved and turned.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source<'a, S: Sample> {
    pub(super) samples: &'a [Cell<S>],
    /// Where the first sample is, and how far the next one and the next row.
    pub(super) start: u32,
    pub(super) right: u32,
    pub(super) down: u32,
    /// How far the pixel below one is, where four of them are averaged; 0 where that was done.
    pub(super) lower: u32,
    /// Eight times the contrast.
    pub(super) contrast: i32,
    /// With 4 fractional bits.
    pub(super) mean: i32,
}

impl<S: Sample> Source<'_, S> {
    /// Takes the mean of a domain drawn with `2^drawn` samples a side, then turns it.
    #[inline]
    pub(super) fn prepare(&mut self, isometry: u32, drawn: u32) {
        let m = 1_u32 << drawn;
        // the mean first, in the order in which the samples lie
        let mut sum = 0_u32;
        for i in 0..m {
            let mut at = self.row(i);
            for _ in 0..m {
                sum = sum.wrapping_add(self.sample(at));
                at = at.wrapping_add(self.right);
            }
        }
        self.mean = (((u64::from(sum) << 4) + ((1 << (2 * drawn)) >> 1)) >> (2 * drawn)) as i32;
        // then the isometry: where (i, j) goes as both grow
        let end = m - 1;
        let (down, right) = (self.down, self.right);
        if isometry & 1 != 0 {
            self.start = self.start.wrapping_add(end * right);
            self.right = right.wrapping_neg();
        }
        if isometry & 2 != 0 {
            self.start = self.start.wrapping_add(end * down);
            self.down = down.wrapping_neg();
        }
        if isometry & 4 != 0 {
            (self.down, self.right) = (self.right, self.down);
        }
    }

    #[inline]
    pub(super) fn row(&self, i: u32) -> u32 {
        self.start.wrapping_add(i.wrapping_mul(self.down))
    }

    #[inline]
    pub(super) fn sample(&self, at: u32) -> u32 {
        let one = |at: u32| self.samples.get(at as usize).map_or(0, |s| s.get().number() as u32);
        if self.lower == 0 {
            return one(at);
        }
        let below = at.wrapping_add(self.lower);
        (one(at) + one(at.wrapping_add(1)) + one(below) + one(below.wrapping_add(1)) + 2) >> 2
    }

    /// What a place of a row adds, with 7 fractional bits; goes to the next.
    #[inline]
    pub(super) fn next(&self, at: &mut u32) -> i32 {
        let added = self.contrast * (((self.sample(*at) << 4) as i32) - self.mean);
        *at = at.wrapping_add(self.right);
        added
    }

    /// The same for the pixel in row `i` and column `j`.
    #[inline]
    pub(super) fn at(&self, i: u32, j: u32) -> i32 {
        let mut at = self.row(i).wrapping_add(j.wrapping_mul(self.right));
        self.next(&mut at)
    }
}
