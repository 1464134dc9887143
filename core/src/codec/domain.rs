//! The samples of a domain: every second row and column of a square, averaged and turned.

use core::cell::Cell;

use super::area::Area;
use super::sample::Sample;

/// The mean of a square of four samples, of which the upper and the lower two are given.
#[inline]
fn quarter<S: Sample>(upper: [&Cell<S>; 2], lower: [&Cell<S>; 2]) -> i32 {
    let [a, b] = upper.map(|sample| sample.get().number());
    let [c, d] = lower.map(|sample| sample.get().number());
    (a + b + c + d + 2) >> 2
}

/// A domain, halved and turned.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source<'a, S: Sample> {
    /// Of them the first row follows the last.
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

    /// Where a row begins.
    #[inline]
    const fn at(&self, r: u32) -> u32 {
        self.start.wrapping_add(r.wrapping_mul(self.down))
    }
}

impl<'a, S: Sample> Source<'a, S> {
    /// So many pixels from a place on.
    #[inline]
    fn pixels(&self, from: u32, count: u32) -> &'a [Cell<S>] {
        self.samples.get(from as usize..).and_then(|rest| rest.get(..count as usize)).unwrap_or(&[])
    }

    /// Lays `count` samples of row `r`, from the `s`th on, into slots, `step` apart from `at` on, and tells
    /// their sum.
    #[inline(never)]
    pub(super) fn row(&self, [r, s, count]: [u32; 3], slots: &[Cell<S>], mut at: u32, step: u32) -> u32 {
        let (mut sum, mut from) = (0_u32, self.start + r * self.down);
        if from as usize >= self.samples.len() {
            // rows go round and round
            from -= self.samples.len() as u32;
        }
        let mut lay = |value: i32| {
            sum = sum.wrapping_add(value as u32);
            let slot = slots.get(at as usize);
            if let Some(slot) = slot {
                slot.set(S::cut(value));
            }
            at = at.wrapping_add(step);
            slot.is_some()
        };
        if self.lower == 0 {
            self.pixels(from + s, count).iter().all(|sample| lay(sample.get().number()));
            return sum;
        }
        let rows = |from: u32| self.pixels(from + 2 * s, 2 * count).chunks_exact(2);
        let mut lower = rows(from + self.lower);
        for upper in rows(from) {
            let ([a, b], Some([c, d])) = (upper, lower.next()) else { break };
            if !lay(quarter([a, b], [c, d])) {
                break;
            }
        }
        sum
    }

    /// Lays the domain into a leaf and tells its mean, with 4 fractional bits.
    #[inline(never)]
    pub(super) fn lay(&self, leaf: &Area<'_, S>, drawn: u32) -> i32 {
        let side = 1 << drawn;
        if leaf.is_whole(side) {
            let slots = leaf.picture.get(leaf.start as usize..).unwrap_or(&[]);
            return self.turn(slots, drawn, leaf.columns);
        }
        // at the picture's edge each sample finds its own place
        let (mut sum, turned) = (0_u32, Turned::new(self.isometry, side, side));
        let blank = Cell::new(S::cut(0));
        for k in 0..side << drawn {
            let (r, s) = (k >> drawn, k & (side - 1));
            let at = turned.at(r).wrapping_add(s.wrapping_mul(turned.right));
            let slot = leaf.row(at >> drawn).get((at & (side - 1)) as usize).unwrap_or(&blank);
            sum = sum.wrapping_add(self.row([r, s, 1], core::slice::from_ref(slot), 0, 0));
        }
        mean(sum, drawn)
    }

    /// Turns the domain into a square whose rows are `pitch` apart, and tells its mean.
    fn turn(&self, slots: &[Cell<S>], drawn: u32, pitch: u32) -> i32 {
        let (side, mut sum) = (1 << drawn, 0_u32);
        let turned = Turned::new(self.isometry, side, pitch);
        for r in 0..side {
            sum = sum.wrapping_add(self.row([r, 0, side], slots, turned.at(r), turned.right));
        }
        mean(sum, drawn)
    }

    /// What the domain less its mean is at full contrast, with 7 fractional bits: for an encoder, whose
    /// leaves are drawn in their own size, 32 at most.
    pub(super) fn copied(&self, drawn: u32, into: &mut [i32]) {
        let all = core::array::from_fn::<_, 1024, _>(|_| Cell::new(S::cut(0)));
        let mean = self.turn(&all, drawn, 1 << drawn);
        for (slot, sample) in into.iter_mut().zip(&all).take(1 << (2 * drawn)) {
            *slot = 8 * ((sample.get().number() << 4) - mean);
        }
    }
}

/// The mean of a sum of so many samples, with 4 fractional bits.
#[inline]
fn mean(sum: u32, drawn: u32) -> i32 {
    (((u64::from(sum) << 4) + (1 << (2 * drawn) >> 1)) >> (2 * drawn)) as i32
}
