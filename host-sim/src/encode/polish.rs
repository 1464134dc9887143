//! A leaf once more, with its samples as they are rounded and cut off.
//!
//! At an error of about one grey level the rounding is a tenth of it, and it is known: of leaves that cost
//! nearly the same before it, one is better than the others after it. So the mean and each level are tried a
//! step lower and a step higher, as long as one of that pays.

use attractor::codec::shared::{Leaf, scan};

use super::cosine::{Coefficients, Cosine};

/// How many changes of a leaf are weighed at most before one of them is made, and how many are made.
const WEIGHED: usize = 24;
const MADE: usize = 12;

/// The samples of a square, and what a leaf makes of them before they are rounded.
pub(super) struct Rounded<'a> {
    pub(super) cosine: &'a Cosine,
    pub(super) size: u32,
    /// Columns and rows that lie in the picture.
    pub(super) seen: [usize; 2],
    pub(super) peak: f32,
    pub(super) truth: [f32; 1024],
    pub(super) drawn: [f32; 1024],
}

/// A change: a place along the scan, 0 for the mean, and by how much.
#[derive(Clone, Copy)]
struct Change {
    place: usize,
    by: i32,
}

impl Rounded<'_> {
    /// Squared error, once so much of a frequency is added.
    fn error(&self, place: u8, amount: f32) -> f32 {
        // adding it takes the fraction off
        const WHOLE: f32 = 12_582_912.0;
        let n = 1 << self.size;
        let [columns, rows] = self.seen;
        let (down, across) = self.waves(place);
        let mut sum = 0.0;
        let lines = self.truth.chunks_exact(n).zip(self.drawn.chunks_exact(n)).zip(down).take(rows);
        for ((truth, drawn), down) in lines {
            let down = amount * down;
            let mut sums = [0.0_f32; 4];
            let fours = truth[..columns].chunks(4).zip(drawn[..columns].chunks(4)).zip(across.chunks(4));
            for ((truth, drawn), across) in fours {
                for (((sum, truth), drawn), across) in sums.iter_mut().zip(truth).zip(drawn).zip(across) {
                    let sample = ((drawn + down * across + WHOLE) - WHOLE).clamp(0.0, self.peak);
                    *sum += (truth - sample) * (truth - sample);
                }
            }
            sum += sums.iter().sum::<f32>();
        }
        sum
    }

    fn waves(&self, place: u8) -> (&[f32], &[f32]) {
        (self.cosine.wave(self.size, place >> 4), self.cosine.wave(self.size, place & 15))
    }

    /// Adds so much of a frequency.
    pub(super) fn add(&mut self, place: u8, amount: f32) {
        let n = 1 << self.size;
        let cosine = self.cosine;
        let (down, across) = (cosine.wave(self.size, place >> 4), cosine.wave(self.size, place & 15));
        for (row, down) in self.drawn.chunks_exact_mut(n).zip(down) {
            for (drawn, across) in row.iter_mut().zip(across) {
                *drawn += amount * down * across;
            }
        }
    }

    /// Changes the leaf's mean and levels while that takes error and bits, `lambda` each, off. `bits` tells
    /// what a leaf takes.
    pub(super) fn polish(
        &mut self,
        leaf: &mut Leaf,
        step: f32,
        lambda: f32,
        mut bits: impl FnMut(&mut Leaf) -> f32,
    ) {
        let scan = scan(self.size);
        let count = 1 << (2 * self.size);
        let mut rest = [0.0; 1024];
        for ((rest, truth), drawn) in rest.iter_mut().zip(&self.truth).zip(&self.drawn).take(count) {
            *rest = truth - drawn;
        }
        let mut left: Coefficients = [0.0; 256];
        self.cosine.forward(self.size, &rest[..count], &mut left);
        let (mut error, mut said) = (self.error(0, 0.0), bits(leaf));
        for _ in 0..MADE {
            // what the rounding may add or take
            let slack = 2.0 * error.sqrt();
            let mut likely = Vec::new();
            for place in 0..(leaf.last as usize + 6).min(scan.len()) {
                let level = if place == 0 { leaf.mean } else { leaf.levels.get(scan[place]) };
                for by in [-1, 1] {
                    let amount = by as f32 * step;
                    let more = amount * amount - 2.0 * amount * left[usize::from(scan[place])];
                    let saved = if level * by < 0 { 7.0 } else { -1.0 };
                    if more > slack + saved * lambda && place > 0 || more > slack + 3.0 * lambda {
                        continue;
                    }
                    let change = Change { place, by };
                    let last = change.make(leaf, scan);
                    let dearer = bits(leaf) - said;
                    change.undo(leaf, scan, last);
                    let cost = more + lambda * dearer;
                    if cost < slack {
                        likely.push((cost, dearer, change));
                    }
                }
            }
            likely.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut best = None;
            let mut least = -1e-3 * lambda;
            for (_, dearer, change) in likely.into_iter().take(WEIGHED) {
                let other = self.error(scan[change.place], change.by as f32 * step);
                let cost = other - error + lambda * dearer;
                if cost < least {
                    (least, best) = (cost, Some((other, dearer, change)));
                }
            }
            let Some((other, dearer, change)) = best else { return };
            change.make(leaf, scan);
            (error, said) = (other, said + dearer);
            let amount = change.by as f32 * step;
            self.add(scan[change.place], amount);
            left[usize::from(scan[change.place])] -= amount;
        }
    }
}

impl Change {
    /// Changes a leaf, and tells the place of its last coefficient before.
    fn make(self, leaf: &mut Leaf, scan: &[u8]) -> u32 {
        let last = leaf.last;
        self.add(leaf, scan, self.by);
        if self.place > leaf.last as usize {
            leaf.last = self.place as u32;
        }
        while leaf.last > 0 && leaf.levels.get(scan[leaf.last as usize]) == 0 {
            leaf.last -= 1;
        }
        last
    }

    fn undo(self, leaf: &mut Leaf, scan: &[u8], last: u32) {
        self.add(leaf, scan, -self.by);
        leaf.last = last;
    }

    fn add(self, leaf: &mut Leaf, scan: &[u8], by: i32) {
        if self.place == 0 {
            leaf.mean += by;
        } else {
            let level = leaf.levels.get(scan[self.place]);
            leaf.levels.set(scan[self.place], level + by);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f32 = 2.5;
    const LAMBDA: f32 = 0.12 * STEP * STEP;

    fn bits(leaf: &mut Leaf) -> f32 {
        let said = scan(3).iter().skip(1).map(|place| leaf.levels.get(*place).unsigned_abs());
        said.map(|level| if level == 0 { 0.0 } else { 3.0 + level as f32 }).sum::<f32>()
            + (2 * leaf.mean.abs()) as f32
            + 0.1 * leaf.last as f32
    }

    /// A square of 8 x 8 with a grain of one grey level, and what a leaf draws of it.
    fn square<'a>(cosine: &'a Cosine, leaf: &Leaf, seed: u32) -> Rounded<'a> {
        let mut truth = [0.0; 1024];
        for (i, value) in (0_u32..64).zip(&mut truth) {
            let grain = (i * 31 + seed).wrapping_mul(0x9e37_79b9) >> 30;
            *value = (2 + i / 24 + grain) as f32;
        }
        let drawn = [4.3 + leaf.mean as f32 * STEP / 8.0; 1024];
        let mut rounded = Rounded { cosine, size: 3, seen: [8, 7], peak: 255.0, truth, drawn };
        for place in &scan(3)[1..] {
            rounded.add(*place, leaf.levels.get(*place) as f32 * STEP);
        }
        rounded
    }

    #[test]
    fn a_leaf_costs_less_once_it_was_polished_and_says_what_was_weighed() {
        let cosine = Cosine::new();
        let (mut gained, mut changed) = (0.0, 0);
        for seed in 0..200 {
            let mut leaf = Leaf { mean: (seed % 3) as i32 - 1, last: 2, ..Leaf::default() };
            leaf.levels.set(scan(3)[2], if seed % 2 == 0 { 1 } else { -1 });
            let cost = |leaf: &mut Leaf| square(&cosine, leaf, seed).error(0, 0.0) + LAMBDA * bits(leaf);
            let before = cost(&mut leaf);
            square(&cosine, &leaf, seed).polish(&mut leaf, STEP, LAMBDA, bits);
            let after = cost(&mut leaf);
            assert!(after <= before + 1e-3, "{seed}: {before} became {after}");
            assert!(leaf.last == 0 || leaf.levels.get(scan(3)[leaf.last as usize]) != 0, "{seed}");
            assert!(scan(3)[leaf.last as usize + 1..].iter().all(|place| leaf.levels.get(*place) == 0));
            gained += before - after;
            changed += u32::from(after < before);
        }
        assert!(changed > 150 && gained > 200.0 * LAMBDA, "{changed} {gained}");
    }
}
