//! Levels of a square's coefficients, by rate and distortion: what a level saves of the error, less what its
//! bins cost.
//!
//! Along the scan each level is the best of three, 0 and the two next to the coefficient, at the prices of
//! the
//! models as they stand; then the place to stop is the one where the sum was least.

use attractor::codec::shared::{CLASSES, Leaf, MODELS, Model, NUMBER, Setting, class, context, number, scan};

use super::cosine::Coefficients;
use super::range_encoder::{Cost, Prices};

/// Prices and the exchange rate.
pub(super) struct Quantiser<'a> {
    pub(super) models: &'a [Model; MODELS],
    pub(super) prices: &'a Prices,
    pub(super) step: f32,
    /// Squared error that a bit is worth.
    pub(super) lambda: f32,
}

impl Quantiser<'_> {
    fn number(&self, context: usize, value: u32) -> f32 {
        let mut cost = Cost { models: self.models, prices: self.prices, bits: 0.0 };
        number(&mut cost, context, value);
        cost.bits
    }

    fn bin(&self, context: usize, bin: bool) -> f32 {
        self.prices.bin(self.models[context], bin)
    }

    /// Sets the levels of a leaf, whose domain is known, and tells by how much that changes the error.
    pub(super) fn levels(&self, coefficients: &Coefficients, setting: &Setting, leaf: &mut Leaf) -> f32 {
        let scan = scan(setting.size);
        let value = |i: usize| coefficients[usize::from(scan[i])];
        leaf.levels.clear();
        leaf.last = 0;
        let Some(most) = (1..scan.len()).rev().find(|i| value(*i).abs() > 0.5 * self.step) else {
            return 0.0;
        };
        let k = (setting.size - 2) as usize;
        let last = context::LAST + (setting.chroma as usize * 4 + k) * NUMBER;
        let mut chosen = [0_i32; 256];
        // of what was chosen so far, as if it went on
        let mut sum = 0.0;
        let (mut least, mut end) = (self.lambda * self.number(last, 0), (0, 0));
        for (i, place) in chosen.iter_mut().enumerate().take(most + 1).skip(1) {
            let length = value(i).abs();
            let models = k * CLASSES + class(i as u32);
            let significant = context::SIGNIFICANT + models * 3 + leaf.levels.about(scan[i]);
            let zero = self.lambda * self.bin(significant, false);
            let nearest = ((length / self.step + 0.5) as i32).min(attractor::codec::shared::LARGEST);
            if nearest == 0 {
                sum += zero;
                continue;
            }
            let price = |level: i32| {
                let off = length - level as f32 * self.step;
                let large = self.bin(context::LARGE + models, level > 1);
                let rest = if level > 1 { self.number(context::MAGNITUDE, level as u32 - 2) } else { 0.0 };
                off * off - length * length + self.lambda * (1.0 + large + rest)
            };
            let (mut level, mut cost) = (nearest, price(nearest));
            if nearest > 1 && price(nearest - 1) < cost {
                (level, cost) = (nearest - 1, price(nearest - 1));
            }
            // the last one's significance is not said
            let stop = sum + cost + self.lambda * self.number(last, i as u32);
            if stop < least {
                (least, end) = (stop, (i, level));
            }
            let kept = cost + self.lambda * self.bin(significant, true);
            if kept < zero {
                *place = level;
                leaf.levels.set(scan[i], level);
                sum += kept;
            } else {
                sum += zero;
            }
        }
        chosen[end.0] = end.1;
        leaf.last = end.0 as u32;
        leaf.levels.clear();
        let mut error = 0.0;
        for (i, level) in chosen.iter().enumerate().take(end.0 + 1).skip(1).filter(|(_, level)| **level != 0)
        {
            let off = value(i).abs() - *level as f32 * self.step;
            error += off * off - value(i) * value(i);
            leaf.levels.set(scan[i], if value(i) < 0.0 { -level } else { *level });
        }
        error
    }
}
