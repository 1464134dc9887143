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

    /// Mixes the samples at an edge, so many from the first one on: `a b | c d` become `a`,
    /// `(a + 12 b + 3 c) / 16`, `(3 b + 12 c + d) / 16`, `d`, to nearest; `b` only if both
    /// sides may change. Steps lead across the edge and along.
    ///
    /// Error: what the three are off, weighed as they are, and the rounding
    /// (`other_sizes_are_those_of_the_format_and_as_near_to_its_formulas_as_their_roundings_allow`).
    #[inline(never)]
    pub(super) fn join(&self, [across, along]: [u32; 2], count: u32, both: bool) {
        let mut at = self.start - 2 * across;
        for _ in 0..count {
            let sample = |k| self.picture.get((at + k * across) as usize);
            let (Some(a), Some(b), Some(c), Some(d)) = (sample(0), sample(1), sample(2), sample(3)) else {
                break;
            };
            let (before, after) = (b.get().number(), c.get().number());
            let mixed = |behind: &Cell<S>, here: i32, beyond: i32| {
                S::cut((behind.get().number() + 12 * here + 3 * beyond + 8) >> 4)
            };
            if both {
                b.set(mixed(a, before, after));
            }
            c.set(mixed(d, after, before));
            at += along;
        }
    }
}
