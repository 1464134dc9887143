//! The maps of a lattice applied to weights, and the weights of means.
//!
//! `(T_ij v)[a,b] = sum m[i + 3 + k - 2 a][j + 3 + l - 2 b] v[k,l]` for weights `v` of the 4 x 4 heights of a
//! cell, `m` the mask. What heights mean over a cell is the mean of what they mean over its parts: the
//! weights `w` of a mean are fixed by the mean of the maps of the parts, over the cell by that of all four,
//! over a side by that of the two along it. Iterated from the weights of one height on, a round draws weights
//! that add up to 0 nearer as the words of [`Contraction`] do. Formats: entries of the mask 28 fractional
//! bits, weights 44, rounded once a sum.
//!
//! [`Contraction`]: super::contraction::Contraction

use crate::num::formats::{Q28, Q44};
use crate::num::product;

/// Weights of the 16 heights of a cell.
pub(super) type Column = [Q44; 16];

/// 1.
pub(super) const ONE: Q44 = 1 << 44;

/// The height next to the beginning of the cell, which takes up what is left: `(a, b)` = (1, 1).
pub(super) const BASE: usize = 5;

/// Parts of a cell, and of its sides at the beginning and the end of `s` and of `t`.
pub(super) const CELL: [[usize; 2]; 4] = [[0, 0], [0, 1], [1, 0], [1, 1]];
pub(super) const SIDES: [[[usize; 2]; 2]; 4] =
    [[[0, 0], [0, 1]], [[1, 0], [1, 1]], [[0, 0], [1, 0]], [[0, 1], [1, 1]]];

/// Rounds that are too many, and what a round may change in the end.
const ROUNDS: u32 = 1 << 12;
const STILL: u64 = 1 << 6;

/// `T_ij v`.
pub(super) fn image(mask: &[[Q28; 5]; 5], [i, j]: [usize; 2], v: &Column) -> Column {
    let mut to = [0; 16];
    for (place, to) in to.iter_mut().enumerate() {
        let (a, b) = (place / 4, place % 4);
        // products of the upper and of the lower 28 bits
        let (mut upper, mut lower) = (0_i64, 1_i64 << 27);
        for (k, row) in v.chunks_exact(4).enumerate() {
            let Some(entries) = (i + 3 + k).checked_sub(2 * a).and_then(|x| mask.get(x)) else { continue };
            for (l, weight) in row.iter().enumerate() {
                let entry = (j + 3 + l).checked_sub(2 * b).and_then(|y| entries.get(y));
                let entry = entry.copied().unwrap_or(0);
                upper = upper.wrapping_add(product((weight >> 28) as i32, entry));
                lower = lower.wrapping_add(product((weight & ((1 << 28) - 1)) as i32, entry));
            }
        }
        *to = upper.wrapping_add(lower >> 28);
    }
    to
}

/// The weights of the mean over what these parts make up, 2 or 4 of them; none where rounds do not end.
pub(super) fn mean(mask: &[[Q28; 5]; 5], parts: &[[usize; 2]]) -> Option<Column> {
    let mut weights = [0; 16];
    weights[BASE] = ONE;
    for _ in 0..ROUNDS {
        let mut next = [0_i64; 16];
        for part in parts {
            for (sum, weight) in next.iter_mut().zip(image(mask, *part, &weights)) {
                *sum = sum.wrapping_add(weight);
            }
        }
        next = next.map(|sum| halved(sum, parts.len()));
        next[BASE] += next.iter().fold(ONE, |left, weight| left - weight);
        let changed: u64 = next.iter().zip(weights).map(|(a, b)| a.abs_diff(b)).sum();
        weights = next;
        if changed <= STILL {
            return Some(weights);
        }
    }
    None
}

/// The mean of so many from their sum, 1, 2 or 4 of them.
pub(super) fn halved(sum: i64, count: usize) -> i64 {
    match count {
        1 => sum,
        2 => (sum + 1) >> 1,
        _ => (sum + 2) >> 2,
    }
}

/// With 28 fractional bits, nearest.
pub(super) fn rounded(weight: Q44) -> i64 {
    ((weight >> 15) + 1) >> 1
}
