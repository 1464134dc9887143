//! What the levels of a square take, place by place along the scan: bits at the prices of the models as they
//! stand.
//!
//! A level decides about its own bins and about whether those below it and to its right are likely not to be
//! 0. So what a change of one takes is known without walking through all of them.

use std::sync::LazyLock;

use attractor::codec::shared::{CLASSES, class, context, scan};

use super::range_encoder::Rates;

/// From one row of the grid to the next: a column of zeros before the first.
const ROW: usize = 17;

/// Where each place of the grid, and of a row below it, is along the scan.
type Order = [u8; ROW * ROW + ROW];

static ORDERS: LazyLock<[Order; 4]> = LazyLock::new(|| [2, 3, 4, 5].map(order));
/// The class of each place of a scan.
static CLASS: [usize; 256] = {
    let (mut classes, mut i) = ([0; 256], 0);
    while i < 256 {
        classes[i] = class(i as u32);
        i += 1;
    }
    classes
};

const fn cell(place: u8) -> usize {
    ((place >> 4) as usize + 1) * ROW + (place & 15) as usize + 1
}

fn order(size: u32) -> Order {
    let (mut order, scan) = ([0; ROW * ROW + ROW], scan(size));
    let mut i = 1;
    while i < scan.len() {
        order[cell(scan[i])] = i as u8;
        i += 1;
    }
    order
}

/// The levels of a square while they are chosen.
pub(super) struct Bins<'a> {
    rates: &'a Rates,
    scan: &'static [u8],
    /// Logarithm of the side, less 2.
    size: usize,
    /// Levels without sign, in a grid with a row and a column of zeros before the first.
    grid: [i32; ROW * ROW],
    /// Where a place of the grid is along the scan; 0 where it is not.
    order: &'a Order,
    /// The place of the last level that is not 0.
    pub(super) last: usize,
}

impl<'a> Bins<'a> {
    /// No levels, in a square of `2^size`.
    pub(super) fn new(rates: &'a Rates, size: u32) -> Self {
        let k = (size - 2) as usize;
        Self { rates, scan: scan(size), size: k, grid: [0; ROW * ROW], order: &ORDERS[k], last: 0 }
    }

    #[inline]
    pub(super) fn level(&self, i: usize) -> i32 {
        self.grid[cell(self.scan[i])]
    }

    #[inline]
    pub(super) fn set(&mut self, i: usize, level: i32) {
        self.grid[cell(self.scan[i])] = level;
    }

    /// No levels behind a place, which is the last from now on, as far as there are some.
    pub(super) fn stop(&mut self, last: usize, some: usize) {
        for i in last + 1..=some {
            self.set(i, 0);
        }
        self.last = last;
    }

    /// Bits of where the last level is.
    #[inline]
    pub(super) fn end(&self, last: usize) -> f32 {
        self.rates.last[self.size][last]
    }

    /// Bits of the level at a place being 0, and of its being another.
    #[inline]
    pub(super) fn significances(&self, i: usize) -> [f32; 2] {
        let at = cell(self.scan[i]);
        let about = (self.grid[at - ROW] + self.grid[at - 1]).min(2) as usize;
        self.rates.bins[context::SIGNIFICANT + (self.size * CLASSES + CLASS[i]) * 3 + about]
    }

    /// Bits of whether the level at a place is not 0.
    #[inline]
    pub(super) fn significance(&self, i: usize, level: i32) -> f32 {
        self.significances(i)[usize::from(level != 0)]
    }

    /// Bits of a level that is not 0, and of its sign.
    #[inline]
    pub(super) fn magnitude(&self, i: usize, level: i32) -> f32 {
        let large = self.rates.bins[context::LARGE + self.size * CLASSES + CLASS[i]][usize::from(level > 1)];
        let rest = if level > 1 { self.rates.magnitude(level as u32 - 2) } else { 0.0 };
        1.0 + large + rest
    }

    /// Bits of whether a level is 0, here and at the places that depend on it.
    #[inline]
    pub(super) fn around(&mut self, i: usize, level: i32) -> f32 {
        let at = cell(self.scan[i]);
        let before = std::mem::replace(&mut self.grid[at], level);
        let mut bits = if i < self.last { self.significance(i, level) } else { 0.0 };
        for next in [at + 1, at + ROW] {
            let next = usize::from(self.order[next]);
            if next > 0 && next < self.last {
                bits += self.significance(next, self.level(next));
            }
        }
        self.grid[at] = before;
        bits
    }

    /// The place of the last level before the last that is not 0.
    fn last_but_one(&self) -> usize {
        (1..self.last).rev().find(|i| self.level(*i) != 0).unwrap_or(0)
    }

    /// Bits of the last level and of the zeros between that and the one before it.
    fn tail(&self) -> f32 {
        let before = self.last_but_one();
        let zeros: f32 = (before + 1..self.last).map(|i| self.significance(i, 0)).sum();
        let said = if before > 0 { self.significance(before, 1) } else { 0.0 };
        zeros + said + self.magnitude(self.last, self.level(self.last)) + self.end(self.last)
            - self.end(before)
    }

    /// How many bits more it takes to have another level at a place up to the last.
    pub(super) fn dearer(&mut self, i: usize, level: i32) -> f32 {
        let now = self.level(i);
        if i == self.last && level == 0 {
            return -self.tail();
        }
        let bits = |level: i32| if level == 0 { 0.0 } else { self.magnitude(i, level) };
        let more = bits(level) - bits(now);
        more + self.around(i, level) - self.around(i, now)
    }

    /// How many bits more it takes to have a level 1 at each of the places behind the last.
    pub(super) fn beyond(&self) -> impl Iterator<Item = (usize, f32)> {
        let mut bits = -self.end(self.last);
        if self.last > 0 {
            bits += self.significance(self.last, 1);
        }
        (self.last + 1..self.scan.len()).map(move |i| {
            let here = bits + self.end(i) + self.magnitude(i, 1);
            bits += self.significance(i, 0);
            (i, here)
        })
    }

    /// Another level at a place, wherever the last is then.
    pub(super) fn put(&mut self, i: usize, level: i32) {
        self.set(i, level);
        if level != 0 && i > self.last {
            self.last = i;
        }
        while self.last > 0 && self.level(self.last) == 0 {
            self.last -= 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use attractor::codec::shared::{Leaf, MODELS, Setting};

    use super::super::range_encoder::{Cost, NEW, Prices};
    use super::*;

    /// Bits of all that a leaf says.
    fn all(rates: &Rates, leaf: &mut Leaf, size: u32) -> f32 {
        let setting = Setting { size, chroma: 0, neighbours: 0, far: None, transform: true };
        let mut cost = Cost { rates, bits: 0.0 };
        leaf.code(&mut cost, &setting);
        cost.bits
    }

    #[test]
    fn a_change_takes_as_many_bits_more_as_the_whole_leaf_says() {
        let random =
            |seed: u32| seed.wrapping_mul(0x9e37_79b9).rotate_left(13).wrapping_mul(0x85eb_ca6b) >> 8;
        // prices that differ
        let counts = std::array::from_fn(|i| [0, 1].map(|bin| 1 + random(2 * i as u32 + bin) % 40));
        let _: &[[u32; 2]; MODELS] = &counts;
        let rates = Prices::new().rates(&NEW, Some((&counts, 0.7)), 0);
        let mut tried = 0;
        for seed in 0..300_u32 {
            let size = 2 + seed % 4;
            let (scan, mut leaf) = (scan(size), Leaf::default());
            let mut bins = Bins::new(&rates, size);
            for (i, place) in scan.iter().enumerate().skip(1) {
                let level = random(seed << 8 | i as u32) % 11;
                if level < 3 && i < 6 + seed as usize {
                    let level = [1, -1, 3][level as usize];
                    leaf.levels.set(*place, level);
                    bins.put(i, level.abs());
                }
            }
            leaf.last = bins.last as u32;
            let before = all(&rates, &mut leaf, size);
            let beyond: Vec<_> = bins.beyond().collect();
            assert_eq!(beyond.len(), scan.len() - 1 - bins.last);
            let within = (1..=bins.last).flat_map(|i| [(i, -1), (i, 1)]).collect::<Vec<_>>();
            let within = within.into_iter().map(|(i, by)| (i, by, None));
            for (i, by, said) in within.chain(beyond.into_iter().map(|(i, bits)| (i, 1, Some(bits)))) {
                let level = leaf.levels.get(scan[i]);
                let said = said.unwrap_or_else(|| bins.dearer(i, (level + by).abs()));
                leaf.levels.set(scan[i], level + by);
                bins.put(i, (level + by).abs());
                let last = std::mem::replace(&mut leaf.last, bins.last as u32);
                let more = all(&rates, &mut leaf, size) - before;
                assert!((said - more).abs() < 1e-2, "{size} {i} {level} {by}: {said} {more}");
                leaf.levels.set(scan[i], level);
                leaf.last = last;
                bins.put(i, level.abs());
                tried += 1;
            }
            assert_eq!(bins.last, leaf.last as usize);
        }
        assert!(tried > 20_000, "{tried}");
    }
}
