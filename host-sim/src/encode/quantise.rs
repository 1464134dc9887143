//! Levels of a square's coefficients, by rate and distortion: what a level saves of the error, less what its
//! bins cost.
//!
//! Along the scan each level is the best of three, 0 and the two next to the coefficient, at the prices of
//! the models as they stand; the place to stop is the one where the sum was least. Then each level is weighed
//! again, one lower and one higher, with what that does to the bins of the places below it and to its right,
//! and so is the place to stop.

use attractor::codec::shared::{LARGEST, Leaf, Setting, scan};

use super::bins::Bins;
use super::cosine::Coefficients;
use super::range_encoder::Rates;

/// Prices and the exchange rate.
pub(super) struct Quantiser<'a> {
    pub(super) rates: &'a Rates,
    pub(super) step: f32,
    /// Squared error that a bit is worth.
    pub(super) lambda: f32,
}

/// The levels of a square while they are chosen.
struct Choice<'a> {
    bins: Bins<'a>,
    /// Squared steps that a bit is worth.
    lambda: f32,
    /// Coefficients in steps, along the scan.
    values: [f32; 256],
}

impl Choice<'_> {
    /// Squared error and price of a level, against that of no level, but for its significance.
    #[inline]
    fn magnitude(&self, i: usize, level: i32) -> f32 {
        if level == 0 {
            return 0.0;
        }
        let (length, l) = (self.values[i], level as f32);
        l * l - 2.0 * l * length + self.lambda * self.bins.magnitude(i, level)
    }

    #[inline]
    fn nearest(&self, i: usize) -> i32 {
        ((self.values[i] + 0.5) as i32).min(LARGEST)
    }

    /// Along the scan, once, without looking ahead: what all costs.
    fn first(&mut self, most: usize) -> f32 {
        let mut sum = 0.0;
        let (mut least, mut end) = (self.lambda * self.bins.end(0), (0, 0));
        for i in 1..=most {
            let nearest = self.nearest(i);
            let [zero, other] = self.bins.significances(i).map(|bits| self.lambda * bits);
            if nearest == 0 {
                sum += zero;
                continue;
            }
            let (mut level, mut cost) = (nearest, self.magnitude(i, nearest));
            if nearest > 1 {
                let less = self.magnitude(i, nearest - 1);
                if less < cost {
                    (level, cost) = (nearest - 1, less);
                }
            }
            // the last one's significance is not said
            let stop = sum + cost + self.lambda * self.bins.end(i);
            if stop < least {
                (least, end) = (stop, (i, level));
            }
            let kept = cost + other;
            if kept < zero {
                self.bins.set(i, level);
                sum += kept;
            } else {
                sum += zero;
            }
        }
        self.bins.stop(end.0, most);
        if end.0 > 0 {
            self.bins.set(end.0, end.1);
        }
        least
    }

    /// What a place's level costs, with the bins that depend on it.
    fn around(&mut self, i: usize, level: i32) -> f32 {
        self.magnitude(i, level) + self.lambda * self.bins.around(i, level)
    }

    /// Each level once more; whether one has changed.
    fn again(&mut self) -> bool {
        let mut changed = false;
        for i in (1..=self.bins.last).rev() {
            let level = self.bins.level(i);
            if level == 0 && self.values[i] < 0.4 {
                continue;
            }
            let mut best = (self.around(i, level), level);
            for other in [level - 1, level + 1] {
                let least = i32::from(i == self.bins.last);
                if other < least || other > self.nearest(i).max(1) {
                    continue;
                }
                let cost = self.around(i, other);
                if cost < best.0 - 1e-4 {
                    best = (cost, other);
                }
            }
            if best.1 != level {
                self.bins.set(i, best.1);
                changed = true;
            }
        }
        changed
    }

    /// The place to stop, once more: what all costs, and whether it has changed.
    fn stop(&mut self) -> (f32, bool) {
        let mut sum = 0.0;
        let (mut least, mut end) = (self.lambda * self.bins.end(0), 0);
        for i in 1..=self.bins.last {
            let level = self.bins.level(i);
            let cost = self.magnitude(i, level);
            if level > 0 {
                let stop = sum + cost + self.lambda * self.bins.end(i);
                if stop < least {
                    (least, end) = (stop, i);
                }
            }
            sum += cost + self.lambda * self.bins.significance(i, level);
        }
        let changed = end < self.bins.last;
        self.bins.stop(end, self.bins.last);
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
            bins: Bins::new(self.rates, setting.size),
            lambda: self.lambda / (self.step * self.step),
            values: [0.0; 256],
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
        leaf.last = choice.bins.last as u32;
        for (i, place) in scan.iter().enumerate().take(choice.bins.last + 1).skip(1) {
            let level = choice.bins.level(i);
            if level != 0 {
                leaf.levels.set(*place, if value(i) < 0.0 { -level } else { level });
            }
        }
        cost * self.step * self.step
    }
}
