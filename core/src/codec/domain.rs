//! The samples of a domain: every second row and column of a square, averaged and turned.

use core::cell::Cell;

use super::area::Area;
use super::sample::Sample;

/// The mean of a square of four samples, of which the upper and the lower two are given.
#[inline]
pub(super) fn quarter<S: Sample>(upper: [&Cell<S>; 2], lower: [&Cell<S>; 2]) -> i32 {
    let [a, b] = upper.map(|sample| sample.get().number());
    let [c, d] = lower.map(|sample| sample.get().number());
    (a + b + c + d + 2) >> 2
}

/// A domain, halved and turned.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source<'a, S: Sample> {
    pub(super) samples: &'a [Cell<S>],
    /// Where the first sample is, and how far the next row.
    pub(super) start: u32,
    pub(super) down: u32,
    /// How far the pixel below one is, where four of them are averaged; 0 where that was done.
    pub(super) lower: u32,
    pub(super) isometry: u32,
}

/// Where a domain's samples go: the first, and how far the next one of its row and of its column, as places
/// that wrap.
#[derive(Debug, Clone, Copy)]
struct Turned {
    start: u32,
    right: u32,
    down: u32,
}

impl Turned {
    /// Into a square of so many a side whose rows are `pitch` apart.
    const fn new(isometry: u32, side: u32, pitch: u32) -> Self {
        let (mut right, mut down) = if isometry & 4 == 0 { (1, pitch) } else { (pitch, 1) };
        let mut start = 0_u32;
        if isometry & 1 != 0 {
            start = start.wrapping_add((side - 1) * right);
            right = right.wrapping_neg();
        }
        if isometry & 2 != 0 {
            start = start.wrapping_add((side - 1) * down);
            down = down.wrapping_neg();
        }
        Self { start, right, down }
    }
}

impl<S: Sample> Source<'_, S> {
    /// Shows each sample of a domain of so many a side, row by row as it lies, a row until it has seen enough,
    /// and tells their sum.
    #[inline]
    fn each(&self, side: u32, turned: Turned, mut seen: impl FnMut(u32, i32) -> bool) -> u32 {
        let mut sum = 0_u32;
        let rows = |from: u32, length: u32| {
            self.samples.get(from as usize..).and_then(|rest| rest.get(..length as usize)).unwrap_or(&[])
        };
        for r in 0..side {
            let from = self.start + r * self.down;
            let mut at = turned.start.wrapping_add(r.wrapping_mul(turned.down));
            let mut show = |value: i32| {
                sum = sum.wrapping_add(value as u32);
                let goes_on = seen(at, value);
                at = at.wrapping_add(turned.right);
                goes_on
            };
            if self.lower == 0 {
                rows(from, side).iter().all(|sample| show(sample.get().number()));
                continue;
            }
            let mut lower = rows(from + self.lower, 2 * side).chunks_exact(2);
            for upper in rows(from, 2 * side).chunks_exact(2) {
                let ([a, b], Some([c, d])) = (upper, lower.next()) else { break };
                if !show(quarter([a, b], [c, d])) {
                    break;
                }
            }
        }
        sum
    }

    /// Lays the domain into a leaf and tells its mean, with 4 fractional bits.
    #[inline(never)]
    pub(super) fn lay(&self, leaf: &Area<'_, S>, drawn: u32) -> i32 {
        let side = 1 << drawn;
        // a place in the picture, or at the picture's edge one in the leaf, which tells row and column
        let whole = leaf.is_whole(side);
        let pitch = if whole { leaf.columns } else { side };
        let picture = leaf.picture.get(leaf.start as usize..).unwrap_or(&[]);
        let sum = self.each(side, Turned::new(self.isometry, side, pitch), |at, value| {
            let slot = if whole { picture.get(at as usize) } else { leaf.at(at >> drawn, at & (side - 1)) };
            if let Some(slot) = slot {
                slot.set(S::cut(value));
            }
            !whole || slot.is_some()
        });
        mean(sum, drawn)
    }

    /// What the domain less its mean is at full contrast, with 7 fractional bits: for an encoder.
    pub(super) fn copied(&self, drawn: u32, into: &mut [i32]) {
        let side = 1 << drawn;
        let sum = self.each(side, Turned::new(self.isometry, side, side), |at, value| {
            let slot = into.get_mut(at as usize);
            slot.map(|slot| *slot = value).is_some()
        });
        let mean = mean(sum, drawn);
        into.iter_mut().take(1 << (2 * drawn)).for_each(|slot| *slot = 8 * ((*slot << 4) - mean));
    }
}

/// The mean of a sum of so many samples, with 4 fractional bits.
#[inline]
fn mean(sum: u32, drawn: u32) -> i32 {
    (((u64::from(sum) << 4) + (1 << (2 * drawn) >> 1)) >> (2 * drawn)) as i32
}
