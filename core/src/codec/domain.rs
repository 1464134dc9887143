//! The samples of a domain: every second row and column of a square, averaged and turned.

use core::cell::Cell;

use super::area::Area;
use super::sample::Sample;

/// The mean of a sample, its right neighbour and the two below.
#[inline(never)]
pub(super) fn halved<S: Sample>(samples: &[Cell<S>], at: u32, pitch: u32) -> i32 {
    let two = |at: u32| match samples.get(at as usize..).and_then(|rest| rest.first_chunk()) {
        Some([a, b]) => a.get().number() + b.get().number(),
        None => 0,
    };
    (two(at) + two(at.wrapping_add(pitch)) + 2) >> 2
}

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
}

impl<S: Sample> Source<'_, S> {
    /// Turns a domain drawn with `2^drawn` samples a side by an isometry: where (i, j) goes as both grow.
    #[inline]
    pub(super) fn turned(mut self, isometry: u32, drawn: u32) -> Self {
        let end = (1 << drawn) - 1;
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
        self
    }

    #[inline]
    fn sample(&self, at: u32) -> i32 {
        if self.lower == 0 {
            return self.samples.get(at as usize).map_or(0, |s| s.get().number());
        }
        halved(self.samples, at, self.lower)
    }

    /// Lays the domain into a leaf and tells its mean, with 4 fractional bits.
    #[inline(never)]
    pub(super) fn lay(&self, leaf: &Area<'_, S>, drawn: u32) -> i32 {
        let mut sum = 0_u32;
        let m = 1 << drawn;
        let mut start = self.start;
        for i in 0..m {
            let (row, mut at) = (leaf.row(i), start);
            for j in 0..m {
                let value = self.sample(at);
                sum = sum.wrapping_add(value as u32);
                if let Some(slot) = row.get(j as usize) {
                    slot.set(S::cut(value));
                }
                at = at.wrapping_add(self.right);
            }
            start = start.wrapping_add(self.down);
        }
        mean(sum, drawn)
    }

    /// What the domain less its mean is at full contrast, with 7 fractional bits: for an encoder.
    pub(super) fn copied(&self, drawn: u32, into: &mut [i32]) {
        let (m, mut sum) = (1 << drawn, 0_u32);
        for (i, row) in (0..m).zip(into.chunks_exact_mut(1 << drawn)) {
            let mut at = self.start.wrapping_add(self.down.wrapping_mul(i));
            for slot in row {
                *slot = self.sample(at);
                sum = sum.wrapping_add(*slot as u32);
                at = at.wrapping_add(self.right);
            }
        }
        let mean = mean(sum, drawn);
        into.iter_mut().take(1 << (2 * drawn)).for_each(|slot| *slot = 8 * ((*slot << 4) - mean));
    }
}

/// The mean of a sum of so many samples, with 4 fractional bits.
#[inline]
fn mean(sum: u32, drawn: u32) -> i32 {
    (((u64::from(sum) << 4) + (1 << (2 * drawn) >> 1)) >> (2 * drawn)) as i32
}
