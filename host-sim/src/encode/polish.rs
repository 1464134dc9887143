//! A leaf once more, with its samples as they are rounded and cut off.
//!
//! Of leaves that cost nearly the same before the rounding, one is better than the others after it. So the
//! mean and each level are tried a step lower and a step higher, as long as one of that pays. Where none
//! does, the best of them are made all the same, to see whether another pays after it.

use attractor::codec::shared::{LARGEST, Leaf, scan};

use super::bins::Bins;
use super::cosine::Coefficients;
use super::rounded::Rounded;

/// How many changes of a leaf are weighed at most before one of them is made, and how many are made.
const WEIGHED: usize = 25;
const MADE: usize = 12;
/// By how many of the roots of the squared error what the rounding adds or takes may differ from nothing.
const SLACK: f32 = 3.0;

/// A leaf while it is changed.
pub(super) struct Polish<'a, F> {
    rounded: Rounded<'a>,
    bins: Bins<'a>,
    leaf: &'a mut Leaf,
    scan: &'static [u8],
    step: f32,
    lambda: f32,
    /// What is left of the truth, by frequency.
    left: Coefficients,
    /// Squared error.
    error: f32,
    /// Bits of a mean.
    mean: F,
}

/// A change: a place along the scan, 0 for the mean, and by how much.
#[derive(Clone, Copy)]
struct Change {
    place: usize,
    by: i32,
}

/// What a change costs, squared error with bits; the bits alone, and the error that it leaves.
#[derive(Clone, Copy)]
struct Weighed {
    cost: f32,
    dearer: f32,
    error: f32,
    change: Change,
}

impl<'a, F: Fn(i32) -> f32> Polish<'a, F> {
    /// A leaf as it is drawn by `rounded`, without its coefficients so far; bits of a mean are `mean`, one is
    /// worth `lambda`.
    pub(super) fn new(
        mut rounded: Rounded<'a>,
        mut bins: Bins<'a>,
        leaf: &'a mut Leaf,
        step: f32,
        lambda: f32,
        mean: F,
    ) -> Self {
        let scan = scan(rounded.size());
        for (i, place) in scan.iter().enumerate().take(leaf.last as usize + 1).skip(1) {
            let level = leaf.levels.get(*place);
            if level != 0 {
                rounded.add(*place, level);
                bins.set(i, level.abs());
            }
        }
        bins.last = leaf.last as usize;
        let mut left = [0.0; 256];
        rounded.left(&mut left);
        let error = rounded.error(&rounded.wave(0, 0));
        Self { rounded, bins, leaf, scan, step, lambda, left, error, mean }
    }

    /// Changes the leaf while that takes error and bits off, and tells the squared error left. Of pairs of
    /// changes that do not pay one by one, `ahead` first ones are tried.
    pub(super) fn polish(&mut self, ahead: usize) -> f32 {
        let gain = -1e-3 * self.lambda;
        for _ in 0..MADE {
            let weighed = self.weighed();
            let Some(first) = weighed.first() else { break };
            if first.cost < gain {
                self.make(first.change, first.error);
                continue;
            }
            let pair = weighed.iter().take(ahead).find_map(|first| {
                let error = self.error;
                self.make(first.change, first.error);
                let next = self.weighed().first().copied();
                let pays = next.filter(|next| first.cost + next.cost < gain);
                if pays.is_none() {
                    self.make(Change { by: -first.change.by, ..first.change }, error);
                }
                pays
            });
            let Some(next) = pair else { break };
            self.make(next.change, next.error);
        }
        self.error
    }

    fn level(&self, place: usize) -> i32 {
        if place == 0 { self.leaf.mean } else { self.leaf.levels.get(self.scan[place]) }
    }

    /// What each change costs that is likely to pay, the best first.
    fn weighed(&mut self) -> Vec<Weighed> {
        let last = self.bins.last;
        let mut likely = Vec::with_capacity(2 * self.scan.len());
        let slack = SLACK * self.error.sqrt();
        let mut offer = |place: usize, by: i32, dearer: f32, left: f32| {
            let amount = by as f32 * self.step;
            let cost = amount * amount - 2.0 * amount * left + self.lambda * dearer;
            if cost < slack {
                likely.push(Weighed { cost, dearer, error: 0.0, change: Change { place, by } });
            }
        };
        let mean = self.leaf.mean;
        let said = (self.mean)(mean);
        for by in [-1, 1] {
            offer(0, by, (self.mean)(mean + by) - said, self.left[0]);
        }
        for place in 1..=last {
            let (at, level) = (self.scan[place], self.leaf.levels.get(self.scan[place]));
            for by in [-1, 1] {
                if (level + by).abs() > LARGEST {
                    continue;
                }
                let dearer = self.bins.dearer(place, (level + by).abs());
                offer(place, by, dearer, self.left[usize::from(at)]);
            }
        }
        for (place, dearer) in self.bins.beyond() {
            let left = self.left[usize::from(self.scan[place])];
            offer(place, if left < 0.0 { -1 } else { 1 }, dearer, left);
        }
        if likely.len() > WEIGHED {
            likely.select_nth_unstable_by(WEIGHED, |a, b| a.cost.total_cmp(&b.cost));
            likely.truncate(WEIGHED);
        }
        for Weighed { cost, dearer, error, change } in &mut likely {
            *error = self.rounded.error(&self.rounded.wave(self.scan[change.place], change.by));
            *cost = *error - self.error + self.lambda * *dearer;
        }
        likely.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        likely
    }

    /// Makes a change, which leaves that error.
    fn make(&mut self, Change { place, by }: Change, error: f32) {
        let (at, level) = (self.scan[place], self.level(place) + by);
        if place == 0 {
            self.leaf.mean = level;
        } else {
            self.leaf.levels.set(at, level);
            self.bins.put(place, level.abs());
            self.leaf.last = self.bins.last as u32;
        }
        self.rounded.add(at, by);
        self.left[usize::from(at)] -= by as f32 * self.step;
        self.error = error;
    }
}

#[cfg(test)]
mod tests {
    use super::super::cosine::Cosine;
    use super::super::range_encoder::{Cost, NEW, Prices, Rates};
    use super::*;
    use attractor::codec::shared::Setting;

    /// In `2^-8`.
    const STEP: u32 = 640;
    const LAMBDA: f32 = 0.12 * 2.5 * 2.5;

    fn bits(rates: &Rates, leaf: &mut Leaf) -> f32 {
        let setting = Setting { size: 3, chroma: 0, neighbours: 0, far: None, transform: true };
        let mut cost = Cost { rates, bits: 0.0 };
        leaf.code(&mut cost, &setting);
        cost.bits
    }

    /// A square of 8 x 8 with a grain of one grey level, in which a leaf with that mean is drawn.
    fn square<'a>(cosine: &'a Cosine, leaf: &Leaf, seed: u32) -> Rounded<'a> {
        let mut truth = [0.0; 64];
        for (i, value) in (0_u32..64).zip(&mut truth) {
            let grain = (i * 31 + seed).wrapping_mul(0x9e37_79b9) >> 30;
            *value = (2 + i / 24 + grain) as f32;
        }
        let mut rounded = Rounded::new(cosine, (3, 8, STEP), [8, 7], &truth);
        rounded.fill(550, leaf.mean);
        rounded
    }

    #[test]
    fn a_leaf_costs_less_once_it_was_polished_and_says_what_was_weighed() {
        let (cosine, rates) = (Cosine::new(), Prices::new().rates(&NEW, None, 0));
        let mut gained = [0.0; 2];
        for (gained, ahead) in gained.iter_mut().zip([0, 8]) {
            let mut changed = 0;
            for seed in 0..200 {
                let mut leaf = Leaf { mean: (seed % 3) as i32 - 1, last: 2, ..Leaf::default() };
                leaf.levels.set(scan(3)[2], if seed % 2 == 0 { 1 } else { -1 });
                let polish = |leaf: &mut Leaf, ahead: Option<usize>| {
                    let (rounded, mean) = (square(&cosine, leaf, seed), |mean| rates.mean(0, 3, mean));
                    let mut polish = Polish::new(rounded, Bins::new(&rates, 3), leaf, 2.5, LAMBDA, mean);
                    let error = ahead.map_or(polish.error, |ahead| polish.polish(ahead));
                    error + LAMBDA * bits(&rates, leaf)
                };
                let before = polish(&mut leaf, None);
                let said = polish(&mut leaf, Some(ahead));
                let after = polish(&mut leaf, None);
                assert!((said - after).abs() < 1e-2, "{seed}: {said} is {after}");
                assert!(after <= before + 1e-3, "{seed}: {before} became {after}");
                assert!(leaf.last == 0 || leaf.levels.get(scan(3)[leaf.last as usize]) != 0, "{seed}");
                assert!(scan(3)[leaf.last as usize + 1..].iter().all(|place| leaf.levels.get(*place) == 0));
                *gained += before - after;
                changed += u32::from(after < before);
            }
            assert!(changed > 150, "{changed}");
        }
        assert!(gained[0] > 200.0 * LAMBDA && gained[1] > gained[0] + 50.0 * LAMBDA, "{gained:?} {LAMBDA}");
    }
}
