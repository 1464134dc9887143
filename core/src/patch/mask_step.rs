//! A step of a lattice: the 4 x 4 heights of a cell become those of one of its parts.
//!
//! `h'(x) = sum_j m(x - 2 j) h(j)`: along each axis an odd `x` meets the entries 3 and 1 of the mask, an even
//! one 4, 2 and 0. So there are four classes of new heights, of 4, 6, 6 and 9 products, 2 x 2 heights each.
//! A class is computed at once: its sums share its entries, and two of them each old height, so that 100
//! products need 42 loads; what a class keeps fits the registers of a Cortex-M4.
//!
//! Formats: entries have 30 fractional bits and are below 2; heights are words of any scale that leaves room
//! for what entries make of them. A product is the upper word, a quarter of the true one, rounded down: a new
//! height is less by up to 4 units a product, 36 at most (`a_step_is_the_map_of_its_part`), in the middle by
//! [`MIDDLE`]. That much more of all heights is as much more of what they tend to, however many steps later.

use core::cell::Cell;
use core::sync::atomic::{Ordering, compiler_fence};

use crate::num::formats::{Q24, Q28};
use crate::num::{high, product};

/// Half of what a step takes from a height at most.
pub(super) const MIDDLE: i32 = 18;

/// The entries of each class, the last row and column first, 30 fractional bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Classes {
    odd: [[i32; 2]; 2],
    odd_even: [[i32; 3]; 2],
    even_odd: [[i32; 2]; 3],
    even: [[i32; 3]; 3],
}

impl Classes {
    /// Of a mask whose entries are below 2 in magnitude.
    pub(super) fn of(entries: &[[Q28; 5]; 5]) -> Self {
        let (odd, even) = ([3, 1], [4, 2, 0]);
        let row = |i: usize, columns: &[usize], at: usize| {
            let entry = columns.get(at).and_then(|j| entries.get(i)?.get(*j));
            entry.map_or(0, |entry| entry.wrapping_shl(2))
        };
        let two = |i: usize| [0, 1].map(|at| row(i, &odd, at));
        let three = |i: usize| [0, 1, 2].map(|at| row(i, &even, at));
        Self { odd: odd.map(two), odd_even: odd.map(three), even_odd: even.map(two), even: even.map(three) }
    }
}

/// The heights of a cell, row after row, of which the columns 0 and 2 stand before 1 and 3: those of a class
/// side by side. They are read when they are needed: a compiler that may keep numbers loads all at once and
/// puts most of them back to memory, for want of registers.
pub(super) type Window = [Cell<i32>; 16];

/// Where the height `(a, b)` stands: the two bits of `b` change places.
pub(super) const fn place(a: usize, b: usize) -> usize {
    4 * a + (b & 1) * 2 + ((b >> 1) & 1)
}

/// The heights of the part with the digits that are the first bits of these words, which are shifted out.
#[inline(always)]
pub(super) fn refine(classes: &Classes, from: &Window, to: &Window, digits: &mut [u32; 2]) {
    match digits.map(|digits| digits >> 31) {
        [0, 0] => step::<0, 0>(classes, from, to),
        [0, _] => step::<0, 1>(classes, from, to),
        [_, 0] => step::<1, 0>(classes, from, to),
        _ => step::<1, 1>(classes, from, to),
    }
    *digits = digits.map(|digits| digits << 1);
}

#[inline(never)]
fn step<const I: usize, const J: usize>(classes: &Classes, from: &Window, to: &Window) {
    class::<I, J, 3, 3>(&classes.even, from, to);
    class::<I, J, 3, 2>(&classes.even_odd, from, to);
    class::<I, J, 2, 3>(&classes.odd_even, from, to);
    class::<I, J, 2, 2>(&classes.odd, from, to);
}

/// The new heights of a class with `R` rows and `C` columns of entries, two where indices are odd.
#[inline(always)]
fn class<const I: usize, const J: usize, const R: usize, const C: usize>(
    entries: &[[i32; C]; R],
    from: &Window,
    to: &Window,
) {
    // the first old height along an axis is the digit's where indices are odd, and 0 where they are even
    let (a, b) = (if R == 2 { I } else { 0 }, if C == 2 { J } else { 0 });
    let heights = old::<C>(from, a, b);
    let row = three(&entries[0]);
    let upper = added::<C>([0; 2], row, heights);
    let heights = old::<C>(from, a + 1, b);
    let lower = added::<C>([0; 2], row, heights);
    let row = three(&entries[1]);
    let upper = added::<C>(upper, row, heights);
    let heights = old::<C>(from, a + 2, b);
    let lower = added::<C>(lower, row, heights);
    let (upper, lower) = if R == 2 {
        (upper, lower)
    } else {
        let row = three(&entries[R - 1]);
        let upper = added::<C>(upper, row, heights);
        let heights = old::<C>(from, a + 3, b);
        (upper, added::<C>(lower, row, heights))
    };
    let (k, l) = (if R == 2 { I } else { 1 - I }, if C == 2 { J } else { 1 - J });
    to[place(k, l)].set(upper[0] << 2);
    to[place(k, l + 2)].set(upper[1] << 2);
    to[place(k + 2, l)].set(lower[0] << 2);
    to[place(k + 2, l + 2)].set(lower[1] << 2);
    compiler_fence(Ordering::SeqCst);
}

/// `C + 1` heights of a row, read here and not before.
#[inline(always)]
fn old<const C: usize>(from: &Window, a: usize, b: usize) -> [i32; 4] {
    compiler_fence(Ordering::SeqCst);
    let [first, second, third] = [0, 1, 2].map(|next| from[place(a, b + next)].get());
    [first, second, third, if C == 2 { 0 } else { from[place(a, b + 3)].get() }]
}

#[inline(always)]
fn three<const C: usize>(row: &[i32; C]) -> [i32; 3] {
    [row[0], row[1], if C == 2 { 0 } else { row[C - 1] }]
}

/// The sums of two neighbours, with the products of a row: first all of one, as their order is the one in
/// which registers suffice.
#[inline(always)]
fn added<const C: usize>([one, other]: [i32; 2], [a, b, c]: [i32; 3], [h, i, j, k]: [i32; 4]) -> [i32; 2] {
    let one = one.wrapping_add(high(h, a)).wrapping_add(high(i, b));
    let one = if C == 2 { one } else { one.wrapping_add(high(j, c)) };
    let other = other.wrapping_add(high(i, a)).wrapping_add(high(j, b));
    [one, if C == 2 { other } else { other.wrapping_add(high(k, c)) }]
}

/// The same for heights that leave no room: sums of 64 bits, each rounded once.
#[inline(never)]
pub(super) fn exact_part(classes: &Classes, from: &[Q24; 16], [i, j]: [usize; 2]) -> [Q24; 16] {
    let mut to = [0; 16];
    let at = |i: usize, j: usize| 4 * i + j;
    exact_class::<3, 3, 16>(&classes.even, from, &mut to, [0, at(1 - i, 1 - j)]);
    exact_class::<3, 2, 15>(&classes.even_odd, from, &mut to, [at(0, j), at(1 - i, j)]);
    exact_class::<2, 3, 12>(&classes.odd_even, from, &mut to, [at(i, 0), at(i, 1 - j)]);
    exact_class::<2, 2, 11>(&classes.odd, from, &mut to, [at(i, j); 2]);
    to
}

/// A class of those, its first old and new heights at these places; `L` old heights from the first to the
/// last.
#[inline(always)]
fn exact_class<const R: usize, const C: usize, const L: usize>(
    entries: &[[i32; C]; R],
    from: &[Q24; 16],
    to: &mut [Q24; 16],
    [first, new]: [usize; 2],
) {
    let from: Option<&[Q24; L]> = from.get(first..).and_then(<[Q24]>::first_chunk);
    let to: Option<&mut [Q24; 11]> = to.get_mut(new..).and_then(<[Q24]>::first_chunk_mut);
    let (Some(from), Some(to)) = (from, to) else { return };
    for (n, m) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let mut sum = 1_i64 << 29;
        for (p, row) in entries.iter().enumerate() {
            for (q, entry) in row.iter().enumerate() {
                // what is nowhere is never asked for: no loop needs to be unrolled to prove it
                let height = from.get(4 * (n + p) + m + q).copied().unwrap_or(0);
                sum = product(height, *entry).wrapping_add(sum);
            }
        }
        if let Some(to) = to.get_mut(8 * n + 2 * m) {
            *to = (sum >> 30) as i32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::seeded::words;
    use super::*;

    /// The formula in 128 bits, for any heights and entries that leave room.
    #[test]
    fn a_step_is_the_map_of_its_part() {
        let mut word = words(9);
        let (mut tried, mut most, mut sum) = (0, 0, 0);
        for _ in 0..200 {
            let entries = [[(); 5]; 5].map(|row| row.map(|()| word(30)));
            let heights = [(); 16].map(|()| word(27));
            let (from, to) = ([(); 16].map(|()| Cell::new(0)), [(); 16].map(|()| Cell::new(0)));
            for (k, height) in heights.iter().enumerate() {
                from[place(k / 4, k % 4)].set(*height);
            }
            for [i, j] in [[0, 0], [0, 1], [1, 0], [1, 1_usize]] {
                refine(&Classes::of(&entries), &from, &to, &mut [i, j].map(|digit| (digit as u32) << 31));
                for [k, l] in (0..16_usize).map(|n| [n / 4, n % 4]) {
                    let (mut exact, mut products) = (0_i128, 0);
                    for [a, b] in (0..16_usize).map(|n| [n / 4, n % 4]) {
                        let [x, y] = [i + 3 + k, j + 3 + l];
                        if (2 * a..2 * a + 5).contains(&x) && (2 * b..2 * b + 5).contains(&y) {
                            let entry = entries[x - 2 * a][y - 2 * b];
                            exact += i128::from(entry) * i128::from(heights[4 * a + b]);
                            products += 1;
                        }
                    }
                    let whole = exact_part(&Classes::of(&entries), &heights, [i, j])[4 * k + l];
                    assert_eq!(i128::from(whole), (exact + (1 << 27)) >> 28);
                    // 28 fractional bits of a unit
                    let less = exact - (i128::from(to[place(k, l)].get()) << 28);
                    assert!((0..=(4 * products) << 28).contains(&less), "{i} {j}, {k} {l}: {less}");
                    most = most.max(less >> 28);
                    sum += less;
                    tried += 1;
                }
            }
        }
        // rounded down, half a unit a product on the average: 12.5 units of which are 4
        assert!(tried == 200 * 64 && most >= 24 && most <= 2 * i128::from(MIDDLE));
        assert_eq!((sum / tried) >> 28, 12, "{most}");
    }
}
