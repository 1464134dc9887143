//! Steps through a lattice: the weights of 4 x 4 heights from those of a part's.
//!
//! `lambda'(a, b) = sum_kl m(i + 3 + k - 2 a, j + 3 + l - 2 b) lambda(k, l)`: where the digit is 0 the four
//! `a` meet 2, 4, 3 and 1 of the mask's rows, where it is 1 they meet 1, 3, 4 and 2: 100 products of both
//! axes, of which the weight with most, 16, is what the others leave of 1.
//!
//! As in [`super::barycentric`] the sums of the last weights are rounded to nearest, and weights are what
//! they differ by (`a_step_is_the_map_of_its_part`).

use core::cell::Cell;
use core::sync::atomic::{Ordering, compiler_fence};

use super::address::{Pair, split};
use super::barycentric::{HALF, ONE};
use crate::num::formats::Q28;
use crate::num::product;

type Entries = [[Q28; 5]; 5];
pub(super) type Square = [[Q28; 4]; 4];

/// Numbers that are read again and again: a sum has up to 12 entries and 12 weights, of which a compiler that
/// may keep them loads all at once and puts most of them back to memory, for want of registers.
type Kept<const N: usize> = [[Cell<Q28>; N]; N];

fn kept<const N: usize>(all: &[[Q28; N]; N]) -> Kept<N> {
    all.map(|row| row.map(Cell::new))
}

/// The weights at an address, from those of its end on.
#[inline(always)]
pub(super) fn weights(entries: &Entries, pair: &Pair, end: &Square) -> [Q28; 16] {
    let (entries, one, other) = (kept(entries), kept(end), kept(&[[0; 4]; 4]));
    let (mut from, mut to) = (&one, &other);
    let [mut s, mut t] = pair.indices;
    for _ in 0..pair.levels {
        let ((rest_s, i), (rest_t, j)) = (split::<2>(s), split::<2>(t));
        match [i, j] {
            [0, 0] => step::<0, 0>(&entries, from, to),
            [0, _] => step::<0, 1>(&entries, from, to),
            [_, 0] => step::<1, 0>(&entries, from, to),
            _ => step::<1, 1>(&entries, from, to),
        }
        (s, t) = (rest_s, rest_t);
        core::mem::swap(&mut from, &mut to);
    }
    let mut weights = [0; 16];
    for (weight, kept) in weights.iter_mut().zip(from.as_flattened()) {
        *weight = kept.get();
    }
    weights
}

/// The sum of the weights from the last on, 56 fractional bits, and what it is rounded to.
type Sum = (i64, Q28);

/// `T_IJ lambda`.
#[inline(never)]
fn step<const I: usize, const J: usize>(entries: &Kept<5>, from: &Kept<4>, to: &Kept<4>) {
    let mut sum = (HALF, 0);
    row::<I, J, 3>(entries, from, to, &mut sum);
    row::<I, J, 2>(entries, from, to, &mut sum);
    row::<I, J, 1>(entries, from, to, &mut sum);
    row::<I, J, 0>(entries, from, to, &mut sum);
    to[1 + I][1 + J].set(ONE.wrapping_sub(sum.1));
}

/// The weights of the heights `(A, 0..4)`.
#[inline(always)]
fn row<const I: usize, const J: usize, const A: usize>(
    entries: &Kept<5>,
    from: &Kept<4>,
    to: &Kept<4>,
    sum: &mut Sum,
) {
    weight::<I, J, A, 3>(entries, from, to, sum);
    weight::<I, J, A, 2>(entries, from, to, sum);
    weight::<I, J, A, 1>(entries, from, to, sum);
    weight::<I, J, A, 0>(entries, from, to, sum);
}

/// The weight of the height `(A, B)`; that with most products comes last, from what is left.
#[inline(always)]
fn weight<const I: usize, const J: usize, const A: usize, const B: usize>(
    entries: &Kept<5>,
    from: &Kept<4>,
    to: &Kept<4>,
    sum: &mut Sum,
) {
    if A == 1 + I && B == 1 + J {
        return;
    }
    let (mut products, before) = *sum;
    along::<I, A>(|i, k| {
        // what is kept is read here, not before: see `Kept`
        compiler_fence(Ordering::SeqCst);
        along::<J, B>(|j, l| {
            products = product(entries[i][j].get(), from[k][l].get()).wrapping_add(products);
        });
    });
    let rounded = (products >> 28) as i32;
    *sum = (products, rounded);
    to[A][B].set(rounded.wrapping_sub(before));
    compiler_fence(Ordering::SeqCst);
}

/// The entries of an axis that a height has, and the height of the part that each is for.
#[inline(always)]
fn along<const DIGIT: usize, const TO: usize>(mut each: impl FnMut(usize, usize)) {
    let mut height = |k: usize| {
        if let Some(entry @ ..5) = (DIGIT + 3 + k).checked_sub(2 * TO) {
            each(entry, k);
        }
    };
    height(0);
    height(1);
    height(2);
    height(3);
}

#[cfg(test)]
mod tests {
    use super::super::barycentric::completed;
    use super::super::seeded::words;
    use super::*;

    /// The formula in 128 bits; a mask whose classes each add up to 1.
    #[test]
    fn a_step_is_the_map_of_its_part() {
        let mut word = words(9);
        let mut tried = 0;
        for _ in 0..200 {
            let mut entries: Entries = [[(); 5]; 5].map(|row| row.map(|()| word(28)));
            for class in 0..4_usize {
                let odd = [class >> 1, class & 1];
                let all = (0..25_usize).map(|k| [k / 5, k % 5]).filter(|[i, j]| [i & 1, j & 1] == odd);
                let sum: i32 = all.map(|[i, j]| entries[i][j]).sum();
                entries[2 - odd[0]][2 - odd[1]] += ONE - sum;
            }
            let flat = completed([(); 16].map(|()| word(28)));
            let weights = [0, 1, 2, 3].map(|a| [0, 1, 2, 3].map(|b: usize| flat[4 * a + b]));
            for [i, j] in [[0, 0], [0, 1], [1, 0], [1, 1_usize]] {
                let (kept_entries, kept_weights, to) = (kept(&entries), kept(&weights), kept(&[[0; 4]; 4]));
                match [i, j] {
                    [0, 0] => step::<0, 0>(&kept_entries, &kept_weights, &to),
                    [0, _] => step::<0, 1>(&kept_entries, &kept_weights, &to),
                    [_, 0] => step::<1, 0>(&kept_entries, &kept_weights, &to),
                    _ => step::<1, 1>(&kept_entries, &kept_weights, &to),
                }
                let (mut sum, mut exact) = (0_i128, 0_i128);
                let order = (0..16).rev().map(|n| [n / 4, n % 4]).filter(|place| *place != [1 + i, 1 + j]);
                for [a, b] in order {
                    sum += i128::from(to[a][b].get());
                    for (k, weights) in weights.iter().enumerate() {
                        for (l, weight) in weights.iter().enumerate() {
                            let [x, y] = [i + 3 + k, j + 3 + l];
                            if (2 * a..2 * a + 5).contains(&x) && (2 * b..2 * b + 5).contains(&y) {
                                let entry = entries[x - 2 * a][y - 2 * b];
                                exact += i128::from(entry) * i128::from(*weight);
                            }
                        }
                    }
                    assert_eq!(sum, (exact + (1 << 27)) >> 28, "{a} {b}");
                    tried += 1;
                }
                assert_eq!(i128::from(to[1 + i][1 + j].get()), i128::from(ONE) - sum);
            }
        }
        assert_eq!(tried, 200 * 4 * 15);
    }
}
