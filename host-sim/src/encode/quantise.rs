//! Levels of a square's coefficients, by rate and distortion: what a level saves of the error, less what its
//! bins cost.
//!
//! Along the scan each level is the best of three, 0 and the two next to the coefficient, at the prices of
//! the models as they stand; the place to stop is the one where the sum was least. Then each level is weighed
//! again, one lower and one higher, with what that does to the bins of the places below it and to its right,
//! and so is the place to stop.

use std::sync::LazyLock;

use attractor::codec::shared::{CLASSES, LARGEST, Leaf, Setting, class, context, scan};

use super::cosine::Coefficients;
use super::range_encoder::Rates;

/// From one row of the grid to the next: a column of zeros before the first.
const ROW: usize = 17;

/// Prices and the exchange rate.
pub(super) struct Quantiser<'a> {
    pub(super) rates: &'a Rates,
    pub(super) step: f32,
    /// Squared error that a bit is worth.
    pub(super) lambda: f32,
}

/// The levels of a square while they are chosen.
struct Choice<'a> {
    rates: &'a Rates,
    /// Squared steps that a bit is worth.
    lambda: f32,
    scan: &'static [u8],
    /// Logarithm of the side, less 2.
    size: usize,
    /// Coefficients in steps, along the scan.
    values: [f32; 256],
    /// Levels without sign, in a grid with a row and a column of zeros before the first.
    grid: [i32; ROW * ROW],
    /// Where a place of the grid is along the scan; 0 where it is not.
    order: &'a Order,
    last: usize,
}

const fn cell(place: u8) -> usize {
    ((place >> 4) as usize + 1) * ROW + (place & 15) as usize + 1
}

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

fn order(size: u32) -> Order {
    let (mut order, scan) = ([0; ROW * ROW + ROW], scan(size));
    let mut i = 1;
    while i < scan.len() {
        order[cell(scan[i])] = i as u8;
        i += 1;
    }
    order
}

impl Choice<'_> {
    #[inline]
    fn level(&self, i: usize) -> i32 {
        self.grid[cell(self.scan[i])]
    }

    /// Bits of whether the level at a place is not 0.
    #[inline]
    fn significance(&self, i: usize, level: i32) -> f32 {
        let at = cell(self.scan[i]);
        let about = (self.grid[at - ROW] + self.grid[at - 1]).min(2) as usize;
        let model = context::SIGNIFICANT + (self.size * CLASSES + CLASS[i]) * 3 + about;
        self.rates.bins[model][usize::from(level != 0)]
    }

    /// Squared error and price of a level, against that of no level, but for its significance.
    #[inline]
    fn magnitude(&self, i: usize, level: i32) -> f32 {
        if level == 0 {
            return 0.0;
        }
        let (length, l) = (self.values[i], level as f32);
        let large = self.rates.bins[context::LARGE + self.size * CLASSES + CLASS[i]][usize::from(level > 1)];
        let rest = if level > 1 { self.rates.magnitude(level as u32 - 2) } else { 0.0 };
        l * l - 2.0 * l * length + self.lambda * (1.0 + large + rest)
    }

    #[inline]
    fn nearest(&self, i: usize) -> i32 {
        ((self.values[i] + 0.5) as i32).min(LARGEST)
    }

    /// Along the scan, once, without looking ahead: what all costs.
    fn first(&mut self, most: usize) -> f32 {
        let mut sum = 0.0;
        let (mut least, mut end) = (self.lambda * self.rates.last[self.size][0], (0, 0));
        for i in 1..=most {
            let nearest = self.nearest(i);
            let zero = self.lambda * self.significance(i, 0);
            if nearest == 0 {
                sum += zero;
                continue;
            }
            let (mut level, mut cost) = (nearest, self.magnitude(i, nearest));
            if nearest > 1 && self.magnitude(i, nearest - 1) < cost {
                (level, cost) = (nearest - 1, self.magnitude(i, nearest - 1));
            }
            // the last one's significance is not said
            let stop = sum + cost + self.lambda * self.rates.last[self.size][i];
            if stop < least {
                (least, end) = (stop, (i, level));
            }
            let kept = cost + self.lambda * self.significance(i, 1);
            if kept < zero {
                self.grid[cell(self.scan[i])] = level;
                sum += kept;
            } else {
                sum += zero;
            }
        }
        self.last = end.0;
        for place in &self.scan[(end.0 + 1).min(self.scan.len())..] {
            self.grid[cell(*place)] = 0;
        }
        if end.0 > 0 {
            self.grid[cell(self.scan[end.0])] = end.1;
        }
        least
    }

    /// What a place's level costs, with the bins that depend on it.
    fn around(&mut self, i: usize, level: i32) -> f32 {
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
        self.magnitude(i, level) + self.lambda * bits
    }

    /// Each level once more; whether one has changed.
    fn again(&mut self) -> bool {
        let mut changed = false;
        for i in (1..=self.last).rev() {
            let level = self.level(i);
            if level == 0 && self.values[i] < 0.4 {
                continue;
            }
            let mut best = (self.around(i, level), level);
            for other in [level - 1, level + 1] {
                let least = i32::from(i == self.last);
                if other < least || other > self.nearest(i).max(1) {
                    continue;
                }
                let cost = self.around(i, other);
                if cost < best.0 - 1e-4 {
                    best = (cost, other);
                }
            }
            if best.1 != level {
                self.grid[cell(self.scan[i])] = best.1;
                changed = true;
            }
        }
        changed
    }

    /// The place to stop, once more: what all costs, and whether it has changed.
    fn stop(&mut self) -> (f32, bool) {
        let mut sum = 0.0;
        let (mut least, mut end) = (self.lambda * self.rates.last[self.size][0], 0);
        for i in 1..=self.last {
            let level = self.level(i);
            let cost = self.magnitude(i, level);
            if level > 0 {
                let stop = sum + cost + self.lambda * self.rates.last[self.size][i];
                if stop < least {
                    (least, end) = (stop, i);
                }
            }
            sum += cost + self.lambda * self.significance(i, level);
        }
        let changed = end < self.last;
        for i in end + 1..=self.last {
            self.grid[cell(self.scan[i])] = 0;
        }
        self.last = end;
        (least, changed)
    }
}

impl Quantiser<'_> {
    /// Sets the levels of a leaf, whose domain is known, and tells by how much that changes the error, and
    /// what their bits are worth.
    ///
    /// Levels are weighed again `rounds` times at most.
    pub(super) fn levels(
        &self,
        coefficients: &Coefficients,
        setting: &Setting,
        leaf: &mut Leaf,
        rounds: u32,
    ) -> f32 {
        let scan = scan(setting.size);
        let value = |i: usize| coefficients[usize::from(scan[i])];
        leaf.levels.clear();
        leaf.last = 0;
        let Some(most) = (1..scan.len()).rev().find(|i| value(*i).abs() > 0.5 * self.step) else {
            return self.lambda * self.rates.last[(setting.size - 2) as usize][0];
        };
        let mut choice = Choice {
            rates: self.rates,
            lambda: self.lambda / (self.step * self.step),
            scan,
            size: (setting.size - 2) as usize,
            values: [0.0; 256],
            grid: [0; ROW * ROW],
            order: &ORDERS[(setting.size - 2) as usize],
            last: 0,
        };
        let steps = 1.0 / self.step;
        for i in 1..=most {
            choice.values[i] = value(i).abs() * steps;
        }
        let mut cost = choice.first(most);
        for _ in 0..rounds {
            let changed = choice.again();
            let (less, stopped) = choice.stop();
            cost = less;
            if !(stopped || changed) {
                break;
            }
        }
        leaf.last = choice.last as u32;
        for (i, place) in scan.iter().enumerate().take(choice.last + 1).skip(1) {
            let level = choice.level(i);
            if level != 0 {
                leaf.levels.set(*place, if value(i) < 0.0 { -level } else { level });
            }
        }
        cost * self.step * self.step
    }
}
