//! What a sweep leaves to the next: the leaves that are not settled, as bytes in lent memory.
//!
//! A leaf whose mean and whose domain's place are known is drawn from them and its coefficients alone. So the
//! sweeps after the first need no stream, if there is room for the leaves that they draw.
//!
//! Format: numbers of 7 bits a byte from the lowest, bit 7 set on all but the last byte; of a leaf
//!
//! - plane, size and isometry: `isometry 16 + plane 4 + size - 2`;
//! - column and row in cells of 4 x 4, column and row of its domain in the halved picture;
//! - mean and contrast: `z(mean) 32 + z(contrast)`, `z(v) = 2 v` or `-2 v - 1`;
//! - each coefficient that is not 0, as `8 zeros + min(z(level), 8)`, `zeros` those before it along the scan,
//!   where that is a multiple of 8 `z(level) - 8` after it; and a 0.

use core::cell::Cell;

use super::leaf::{Leaf, scan};
use super::levels::Levels;
use super::sample::Sample;

/// A leaf without its coefficients, as a sweep draws it that has not read it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unsettled {
    /// Its first column and row.
    pub(super) x: u32,
    pub(super) y: u32,
    /// Logarithm of its side.
    pub(super) size: u32,
    /// With 7 fractional bits.
    pub(super) mean: i32,
    /// Where its domain begins in the halved picture.
    pub(super) column: u32,
    pub(super) row: u32,
    pub(super) isometry: u32,
    /// In eighths.
    pub(super) contrast: i32,
}

/// Leaves in lent memory, a byte a sample.
#[derive(Debug)]
pub(super) struct Kept<'a, S: Sample> {
    bytes: &'a [Cell<S>],
    /// How many of them are taken; more than there are where the memory was too small.
    end: u32,
}

impl<'a, S: Sample> Kept<'a, S> {
    /// None so far.
    pub(super) const fn new(bytes: &'a [Cell<S>]) -> Self {
        Self { bytes, end: 0 }
    }

    /// Whether there was room for all of them.
    pub(super) const fn is_whole(&self) -> bool {
        self.end as usize <= self.bytes.len()
    }

    /// From the beginning.
    pub(super) const fn clear(&mut self) {
        self.end = 0;
    }

    /// A leaf of a plane.
    #[inline(never)]
    pub(super) fn add(&mut self, plane: u32, leaf: &Leaf, map: &Unsettled) {
        self.push(map.isometry << 4 | plane << 2 | (map.size - 2));
        for number in [map.x >> 2, map.y >> 2, map.column, map.row] {
            self.push(number);
        }
        self.push(folded(map.mean) << 5 | folded(map.contrast));
        let mut zeros = 0;
        // the mean, at the first place, is not said
        for place in scan(map.size).iter().take(leaf.last as usize + 1).skip(1) {
            let level = folded(leaf.levels.get(*place));
            zeros += 8;
            if level != 0 {
                self.push(zeros - 8 + level.min(8));
                if level >= 8 {
                    self.push(level - 8);
                }
                zeros = 0;
            }
        }
        self.push(0);
    }

    /// Shows each leaf with its plane, in order; those stay of which `draw` says so.
    #[inline(never)]
    pub(super) fn retain(
        &mut self,
        levels: &mut Levels,
        mut draw: impl FnMut(u32, &Levels, &Unsettled) -> bool,
    ) {
        let (mut at, end) = (0, self.end);
        self.end = 0;
        while at < end {
            let first = at;
            let mut next = || self.number(&mut at);
            let kind = next();
            let [x, y, column, row] = core::array::from_fn(|_| next());
            let said = next();
            let (mean, contrast) = (unfolded(said >> 5), unfolded(said & 31));
            let (size, isometry) = ((kind & 3) + 2, kind >> 4);
            levels.clear();
            let mut places = scan(size).iter().skip(1);
            loop {
                let said = next();
                let Some(before) = said.checked_sub(1) else { break };
                let level = if before & 7 == 7 { 8 + next() } else { said & 7 };
                let Some(place) = places.nth(before as usize >> 3) else { break };
                levels.set(*place, unfolded(level));
            }
            let map = Unsettled { x: x << 2, y: y << 2, size, mean, column, row, isometry, contrast };
            if draw(kind >> 2 & 3, levels, &map) {
                for from in first..at {
                    let byte = self.bytes.get(from as usize).map_or(S::cut(0), Cell::get);
                    self.byte(byte);
                }
            }
        }
    }

    fn byte(&mut self, byte: S) {
        if let Some(slot) = self.bytes.get(self.end as usize) {
            slot.set(byte);
        }
        self.end = self.end.saturating_add(1);
    }

    #[inline(never)]
    fn push(&mut self, mut number: u32) {
        while number >= 128 {
            self.byte(S::cut((number & 127 | 128) as i32));
            number >>= 7;
        }
        self.byte(S::cut(number as i32));
    }

    /// The number at a place, and the place behind it.
    #[inline(never)]
    fn number(&self, at: &mut u32) -> u32 {
        let (mut number, mut shift) = (0, 0);
        loop {
            let byte = self.bytes.get(*at as usize).map_or(0, |byte| byte.get().number() as u32);
            *at += 1;
            number |= (byte & 127) << shift;
            shift += 7;
            if byte < 128 || shift > 28 {
                return number;
            }
        }
    }
}

/// A number with a sign as one without: 0, -1, 1, -2, ...
const fn folded(v: i32) -> u32 {
    (v << 1 ^ v >> 31) as u32
}

const fn unfolded(v: u32) -> i32 {
    (v >> 1) as i32 ^ -((v & 1) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Leaves with the least and the greatest of each of their numbers.
    fn extremes() -> std::vec::Vec<(u32, Leaf, Unsettled)> {
        let mut all = std::vec::Vec::new();
        for (k, size) in (0..4_u32).zip(2..) {
            for mean in [0, 1, -1, (1 << 25) + (1 << 23), -(1 << 25) - (1 << 23)] {
                let (x, y) = ([0, 16_380, 4, 16_352][k as usize], [16_380, 0, 512, 508][k as usize]);
                let (column, row) = ([8191, 0, 127, 128][k as usize], [0, 8191, 16_383, 16_384][k as usize]);
                let contrast = [8, -8, 1, -1][k as usize];
                let map = Unsettled { x, y, size, mean, column, row, isometry: 7 - k, contrast };
                let mut leaf = Leaf::default();
                if mean != 0 {
                    leaf.last = scan(size).len() as u32 - 1;
                    for (i, place) in (1..).zip(scan(size).get(1..).unwrap_or(&[])) {
                        leaf.levels.set(*place, [0, 1, -8191, 8191, -64, 63][(i + k as usize) % 6]);
                    }
                }
                all.push((k % 3, leaf, map));
            }
        }
        all
    }

    #[test]
    fn leaves_come_back_as_they_were_while_there_is_room() {
        let all = extremes();
        let mut memory = std::vec![0_u16; 1 << 14];
        let mut kept = Kept::new(Cell::from_mut(memory.as_mut_slice()).as_slice_of_cells());
        all.iter().for_each(|(plane, leaf, map)| kept.add(*plane, leaf, map));
        assert!(kept.is_whole());
        let length = kept.end as usize;
        // all, then those that were asked to stay
        for every in [2, 1] {
            let mut expected = all.iter().step_by(2 / every);
            let (mut levels, mut seen) = (Levels::default(), 0);
            kept.retain(&mut levels, |plane, levels, map| {
                let (index, leaf, there) = expected.next().unwrap();
                assert_eq!((plane, *map), (*index, *there));
                let same = |place: &u8| levels.get(*place) == leaf.levels.get(*place);
                assert!((0..=255).all(|place| same(&place)), "{map:?}");
                seen += 1;
                seen % 2 == 1
            });
            assert_eq!(seen, all.len() * every / 2);
        }
        for (room, whole) in [(length, true), (length - 1, false), (0, false)] {
            let mut memory = std::vec![0_u8; room];
            let mut kept = Kept::new(Cell::from_mut(memory.as_mut_slice()).as_slice_of_cells());
            all.iter().for_each(|(plane, leaf, map)| kept.add(*plane, leaf, map));
            assert_eq!((kept.is_whole(), kept.end as usize), (whole, length));
        }
    }
}
