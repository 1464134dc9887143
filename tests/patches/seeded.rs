//! Seeded curves, patches and masks, and what their weights are compared by.

use attractor::num::Near;
use attractor::patch::{Barycentric, Mask, Patch, ProjectedCurve, standard_curve};
use attractor_reference::patch::{self as reference, Matrix};

/// Seeded numbers.
pub(super) struct Words(pub(super) u64);

impl Words {
    pub(super) fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as u32
    }

    /// In `[low, high)`, with the bits of a weight.
    pub(super) fn between(&mut self, low: f64, high: f64) -> Near {
        Near::from_num(low + (high - low) * f64::from(self.next() >> 3) / f64::from(1 << 28))
    }
}

pub(super) const UNIT: f64 = 1.0 / (1 << 28) as f64;

pub(super) fn matrix<const J: usize>(map: &Barycentric<J>) -> Matrix {
    let column = |k: usize| map.column(k).unwrap().iter().map(|w| w.to_num()).collect::<Vec<f64>>();
    reference::from_columns(&(0..J).map(column).collect::<Vec<_>>())
}

pub(super) fn worst(got: &[Near], want: &[f64]) -> f64 {
    assert_eq!(got.len(), want.len());
    got.iter().zip(want).map(|(a, b)| (a.to_num::<f64>() - b).abs() / UNIT).fold(0.0, f64::max)
}

/// A standard curve whose four numbers are seeded, where it is one.
pub(super) fn seeded_curve(words: &mut Words) -> Option<ProjectedCurve<2, 3>> {
    let first = [words.between(0.2, 1.1), words.between(-0.5, 0.2)];
    let second = [words.between(0.2, 1.1), words.between(-0.5, 0.2)];
    standard_curve(first, second).ok()
}

/// The 72 numbers of a standard grid near those of the smooth one, where it is a patch.
pub(super) fn seeded_patch(words: &mut Words, spread: f64) -> Option<([Near; 72], Patch<2, 3, 9>)> {
    let quadratic =
        |k: usize| [[1.0, 0.0, 0.0], [0.375, 0.75, -0.125], [0.0, 1.0, 0.0], [-0.125, 0.75, 0.375]][k];
    let mut numbers = [Near::ZERO; 72];
    let mut next = 0;
    let mut put = |value: f64, words: &mut Words| {
        numbers[next] = Near::from_num(value) + words.between(-spread, spread + 1e-9);
        next += 1;
    };
    for k in [1, 3, 1, 3] {
        for c in [0, 2] {
            put(quadratic(k)[c], words);
        }
    }
    for (k, l) in [(1, 2), (3, 2), (2, 1), (2, 3), (1, 1), (1, 3), (3, 1), (3, 3)] {
        for c in (0..9).filter(|c| *c != 4) {
            put(quadratic(k)[c / 3] * quadratic(l)[c % 3], words);
        }
    }
    assert_eq!(next, 72);
    Patch::standard(&numbers).ok().map(|patch| (numbers, patch))
}

pub(super) fn patch_maps(patch: &Patch<2, 3, 9>) -> Vec<Matrix> {
    [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| matrix(patch.map(i, j).unwrap())).to_vec()
}

pub(super) fn cubic() -> [[Near; 5]; 5] {
    let one = [1, 4, 6, 4, 1];
    one.map(|a| one.map(|b| Near::from_bits((a * b) << 22)))
}

/// The cubic mask with seeded changes in each class, where it contracts.
pub(super) fn seeded_mask(words: &mut Words) -> Option<Mask> {
    let mut entries = cubic();
    for class in 0..4_usize {
        let mut sum = Near::ZERO;
        for i in ((class >> 1)..5).step_by(2) {
            for j in ((class & 1)..5).step_by(2) {
                let change = words.between(-0.06, 0.06);
                entries[i][j] += change;
                sum += change;
            }
        }
        entries[2 - (class >> 1)][2 - (class & 1)] -= sum;
    }
    Mask::new(entries).ok()
}

/// What rounding can make of weights, in units: each digit is off by a vector that adds up to 0, of `J - 1`
/// units in sum, which the maps of the digits before it make as much as their norm says, and half of a sum is
/// the most of one weight.
pub(super) fn allowed(maps: &[Matrix], digits: &[usize]) -> f64 {
    let size = maps[0].len();
    let norm = |of: &Matrix| {
        let apart = |i: usize, j: usize| of.iter().map(|row| (row[i] - row[j]).abs()).sum::<f64>() / 2.0;
        (0..size).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| apart(i, j)).fold(0.0, f64::max)
    };
    let mut before: Matrix =
        (0..size).map(|i| (0..size).map(|k| f64::from(u8::from(i == k))).collect()).collect();
    let mut sum = 0.0;
    for digit in digits {
        sum += norm(&before);
        before = reference::product(&before, &maps[*digit]);
    }
    (size - 1) as f64 / 2.0 * sum
}
