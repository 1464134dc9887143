//! A step of a lattice: the 4 x 4 heights of a cell become those of one of its parts.
//!
//! `h'(x) = sum_j m(x - 2 j) h(j)`: along each axis an odd `x` meets the entries 3 and 1 of the mask, an even
//! one 4, 2 and 0. So there are four classes of new heights, of 4, 6, 6 and 9 products, 2 x 2 heights each.
//! A class is computed at once: its sums share its entries, and two of them each old height, so that 100
//! products need 42 loads; what a class keeps fits the registers of a Cortex-M4.
//!
//! Formats: entries have 30 fractional bits and are below 2; heights are words of any scale that leaves room
//! for what entries make of them. A product is the upper word, a quarter of the true one, rounded down: a sum
//! of `n` is off by `-4 n` units to none, and by up to `2 n` either way, 18 at most, after `2 n` is added
//! (`a_step_is_the_map_of_its_part`).

use core::cell::Cell;
use core::sync::atomic::{Ordering, compiler_fence};

use crate::num::formats::Q28;
use crate::num::high;

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

/// Where the height `(a, b)` stands.
pub(super) const fn place(a: usize, b: usize) -> usize {
    4 * a + [0, 2, 1, 3][b & 3]
}

/// The heights of the part with these digits.
#[inline(always)]
pub(super) fn refine(classes: &Classes, from: &Window, to: &Window, digits: [bool; 2]) {
    match digits {
        [false, false] => step::<0, 0>(classes, from, to),
        [false, true] => step::<0, 1>(classes, from, to),
        [true, false] => step::<1, 0>(classes, from, to),
        [true, true] => step::<1, 1>(classes, from, to),
    }
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
    let [centre, scaled] = [2 * (R * C) as i32, 2];
    to[place(k, l)].set((upper[0] << scaled).wrapping_add(centre));
    to[place(k, l + 2)].set((upper[1] << scaled).wrapping_add(centre));
    to[place(k + 2, l)].set((lower[0] << scaled).wrapping_add(centre));
    to[place(k + 2, l + 2)].set((lower[1] << scaled).wrapping_add(centre));
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
                refine(&Classes::of(&entries), &from, &to, [i == 1, j == 1]);
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
                    // 28 fractional bits of a unit
                    let off = (i128::from(to[place(k, l)].get()) << 28) - exact;
                    assert!(off.abs() <= 2 * products << 28, "{i} {j}, {k} {l}: {off}");
                    most = most.max(off.abs() >> 28);
                    sum += off;
                    tried += 1;
                }
            }
        }
        // errors as large as eight of nine products round, and none to one side
        assert!(tried == 200 * 64 && most >= 8 && sum.abs() >> 28 < tried / 4, "{tried} {most} {sum}");
    }
}
