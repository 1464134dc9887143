//! A refinable lattice: heights on a grid, and one stationary mask that makes a grid of half the step of it.
//!
//! `h'(x) = sum_j m(x - 2 j) h(j)`, `x` and `j` pairs of whole numbers, `m` a mask of 5 x 5 entries. The
//! entries of each of its four classes (both indices even, the first, the second, none) add up to 1, so that
//! a level stays level: 25 - 4 = 21 numbers. The surface is what the grids tend to. The cubic mask
//! `(1 4 6 4 1) (x) (1 4 6 4 1) / 64` gives the bicubic B-spline; others give rougher surfaces with as few
//! numbers.
//!
//! A cell between four heights knows 4 x 4 of them, and its quarters are cells again: four maps `T_ij` of 16
//! control heights, `T_ij[(a,b),(k,l)] = m[i + 3 + k - 2 a][j + 3 + l - 2 b]`, a projected system like a
//! patch. Its ends are not control points: `c_00` is the limit stencil, the eigenvector of `T_00` for 1. The
//! refinable function `phi`, what a height of 1 among others of 0 tends to, is known at whole places by it,
//! and at halves by `phi(x) = sum_j m(j) phi(2 x - j)`: the heights of a cell go from digit to digit, and
//! the last digit is in the halves.
//!
//! Source: N. Dyn, D. Levin, "Subdivision schemes in geometric modelling", 2002, for the stationary scheme;
//! it is a patch of Tosan, Guerin, Baskurt (section 4.1) whose boundary is not a control point's. Formats:
//! entries and `phi` 28 fractional bits; heights on their way are what they differ by from one of them, in
//! words of as many fractional bits as there is room for, 14 more than a height's at most.

use core::cell::Cell;

use super::address::{Address, Pair};
use super::barycentric::{Barycentric, ONE, mixed, wide};
use super::contraction::{Contraction, mean};
use super::mask_step::{Classes, MIDDLE, exact_part, place, refine};
use super::scheme::{CORNERS, Scheme};
use crate::Error;
use crate::num::formats::{Q24, Q28};
use crate::num::{Near, Real, Wide, product};

/// A stationary mask of 5 x 5 entries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mask {
    entries: [[Q28; 5]; 5],
    classes: Classes,
    /// `phi(x / 2 - 2, y / 2 - 2)`, row after row.
    halves: [Q28; SIDE * SIDE],
    /// The mean of the weights of the corners.
    middle: [Q28; 16],
    contraction: Contraction,
}

/// Places of `phi` along an axis from -2 to 2, by halves: 0 at both ends.
const SIDE: usize = 9;

/// Rounds of `c = T_00 c`: each draws it nearer by the norm of `T_00`.
const ROUNDS: u32 = 128;

impl Mask {
    /// The mask with these entries, the first index along `s`. Where rounding left the sum of a class off by
    /// up to 9 units, its entry in the middle takes it up.
    ///
    /// # Errors
    /// [`Error::NotBarycentric`] for a class with another sum: `column` 0 for the entries with even indices,
    /// 1 where the second is odd, 2 where the first is, 3 for both; [`Error::OutOfRange`] for an entry of 2
    /// or more in magnitude; [`Error::NotContractive`] and [`Error::OutOfRange`] as [`Contraction`] says.
    pub fn new(entries: [[Near; 5]; 5]) -> Result<Self, Error> {
        let mut bits = entries.map(|row| row.map(Near::to_bits));
        for class in 0..4_usize {
            let odd = [class >> 1, class & 1];
            let sum: i64 = (0..5)
                .flat_map(|i| (0..5).map(move |j| [i, j]))
                .filter(|[i, j]| [i & 1, j & 1] == odd)
                .filter_map(|[i, j]| bits.get(i)?.get(j).copied())
                .map(i64::from)
                .sum();
            let off = i64::from(ONE).saturating_sub(sum);
            if off.unsigned_abs() > 9 {
                return Err(Error::NotBarycentric { column: class, sum: wide(sum) });
            }
            let [i, j] = odd.map(|odd| 2 - odd);
            if let Some(entry) = bits.get_mut(i).and_then(|row| row.get_mut(j)) {
                *entry = entry.saturating_add(off as i32);
            }
        }
        for (index, entry) in bits.iter().flatten().enumerate() {
            if entry.unsigned_abs() >= 2 << 28 {
                let (what, value, max) =
                    ("entry of a mask", wide(i64::from(*entry)), const { Wide::lit("2") });
                return Err(Error::OutOfRange { what, index: Some(index), value, min: -max, max });
            }
        }
        let (classes, halves) = (Classes::of(&bits), halves(&bits));
        let (middle, contraction) = ([0; 16], Contraction::NONE);
        let mask = Self { entries: bits, classes, halves, middle, contraction };
        let mut maps = [Barycentric::IDENTITY; 4];
        for (map, (i, j)) in maps.iter_mut().zip([(0, 0), (0, 1), (1, 0), (1, 1)]) {
            *map = mask.map(i, j)?;
        }
        let mut middle = mean(CORNERS.map(|corner| mask.stencil(corner)));
        // what rounding lost of 1
        let lost = middle.iter().fold(Near::ONE, |left, weight| left.saturating_sub(*weight));
        middle[5] = middle[5].saturating_add(lost);
        let contraction = Contraction::prove(&maps, &middle)?;
        Ok(Self { middle: middle.map(Near::to_bits), contraction, ..mask })
    }

    /// The mask with these 21 numbers: the entries row after row without the middle of each class, which
    /// are `[1][1]`, `[1][2]`, `[2][1]` and `[2][2]` and take up what is left of 1.
    ///
    /// # Errors
    /// As [`Mask::new`].
    pub fn from_numbers(numbers: &[Near; 21]) -> Result<Self, Error> {
        let mut entries = [[Near::ZERO; 5]; 5];
        let mut rest = [Near::ONE.to_bits().into(); 4];
        let mut left = numbers.iter();
        for (i, row) in entries.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                if !((1..3).contains(&i) && (1..3).contains(&j)) {
                    *entry = left.next().copied().unwrap_or_default();
                    if let Some(rest) = rest.get_mut(2 * (i & 1) + (j & 1)) {
                        *rest -= i64::from(entry.to_bits());
                    }
                }
            }
        }
        for (class, rest) in rest.into_iter().enumerate() {
            let [i, j] = [class >> 1, class & 1].map(|odd| 2 - odd);
            let Ok(bits) = i32::try_from(rest) else {
                return Err(Error::NotBarycentric { column: class, sum: wide(rest) });
            };
            if let Some(entry) = entries.get_mut(i).and_then(|row| row.get_mut(j)) {
                *entry = Near::from_bits(bits);
            }
        }
        Self::new(entries)
    }

    /// Its entries.
    pub fn entries(&self) -> [[Near; 5]; 5] {
        self.entries.map(|row| row.map(Near::from_bits))
    }

    /// The proof that it tends to a surface.
    pub const fn contraction(&self) -> &Contraction {
        &self.contraction
    }

    /// The height at `s` and `t` of a cell, saturated. All addresses of a place give the same bits.
    ///
    /// Error: 2 units of `2^-24` a digit and 2 for heights within 1 of 0, in proportion beyond
    /// (`a_lattice_is_within_two_units_a_digit`). Proof: a step is off by 18 units of the scale, each `2^(g -
    /// 6)` of `2^-24` for weights of words that are proven to stay below `2^g` in sum, and later steps make
    /// of it what `|phi|_1` says: at most 1.7 a digit for the masks of `docs/FITS.md`, whose `g` is 1 or 2.
    ///
    /// Cost: 100 products a digit but the last, and 16 (the kernel row `patch lattice` counts a point of 12).
    pub fn height(&self, heights: &[Real; 16], at: [Address<2>; 2]) -> Real {
        let pair = Pair::of(at);
        // how far heights are from one of them: halves do not overflow
        let base = heights[5].to_bits();
        let spread = heights.iter().fold(0, |spread, height| {
            let apart = (height.to_bits() >> 1).wrapping_sub(base >> 1);
            spread | (apart ^ (apart >> 31))
        });
        // they differ by up to 2^(33 - zeros) and a unit, and all that refining makes of that fits a word
        let taken = self.contraction.headroom().wrapping_add(2);
        let scale = spread.leading_zeros().wrapping_sub(taken).cast_signed().min(14);
        let scaled: [i32; 16] = core::array::from_fn(|k| {
            let height = heights[place((k >> 2) & 3, k & 3)].to_bits();
            if scale >= 0 {
                height.wrapping_sub(base).wrapping_shl(scale.cast_unsigned())
            } else {
                ((i64::from(height) - i64::from(base)) >> scale.unsigned_abs()) as i32
            }
        });
        let (one, other) = (scaled.map(Cell::new), scaled.map(Cell::new));
        let mut digits = pair.indices.map(|index| index.wrapping_shl(32_u32.wrapping_sub(pair.levels)));
        // the last digits are in the halves
        let steps = pair.levels.saturating_sub(1);
        for _ in 0..steps >> 1 {
            refine(&self.classes, &one, &other, &mut digits);
            refine(&self.classes, &other, &one, &mut digits);
        }
        let mut last = &one;
        if steps & 1 == 1 {
            refine(&self.classes, &one, &other, &mut digits);
            last = &other;
        }
        // places by halves: a digit and, at the end of the part, one more; all of it where there is no digit
        let [[s, t], [end_s, end_t]] =
            [digits.map(|digit| (digit >> 31) as usize), pair.at_end.map(usize::from)];
        let ends = if pair.levels == 0 { 2 } else { 1 };
        let Some(about) = self.about([s + ends * end_s, t + ends * end_t]) else { return heights[5] };
        // what steps took in the middle, and half a unit of the result
        let shift = 28_i32.wrapping_add(scale).cast_unsigned();
        let taken = (steps as i32).wrapping_mul(MIDDLE);
        let mut sum = product(taken, ONE).wrapping_add(1_i64.wrapping_shl(shift.wrapping_sub(1)));
        for a in 0..4 {
            for b in 0..4 {
                let weight = about[(3 - a) * 2 * SIDE + (3 - b) * 2];
                sum = product(last[place(a, b)].get(), weight).wrapping_add(sum);
            }
        }
        // a word times weights below 15 in sum: below 2^63
        let height = sum.wrapping_shr(shift).wrapping_add(base.into());
        Real::from_bits(height.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
    }

    /// The entry that takes a height `from` to a height `to` of the part with this digit.
    fn entry(&self, digits: [usize; 2], from: [usize; 2], to: [usize; 2]) -> Q28 {
        let index = |axis: usize| {
            let [digit, from, to] = [digits, from, to].map(|pair| pair.get(axis).copied().unwrap_or(0));
            (digit + 3 + to).checked_sub(2 * from)
        };
        let entry = index(0).and_then(|i| Some(*self.entries.get(i)?.get(index(1)?)?));
        entry.unwrap_or(0)
    }

    fn map(&self, i: usize, j: usize) -> Result<Barycentric<16>, Error> {
        let mut columns = [[Near::ZERO; 16]; 16];
        for (k, column) in columns.iter_mut().enumerate() {
            for (a, entry) in column.iter_mut().enumerate() {
                *entry = Near::from_bits(self.entry([i, j], [a / 4, a % 4], [k / 4, k % 4]));
            }
        }
        Barycentric::from_columns(columns)
    }

    /// `phi` about each of the heights of a cell, at its place by halves of the cell; 0 beyond it.
    #[inline(always)]
    fn about(&self, [i, j]: [usize; 2]) -> Option<&[Q28; Self::ABOUT]> {
        self.halves.get(SIDE * i + j..)?.first_chunk()
    }

    /// From `phi` about the last height to that about the first.
    const ABOUT: usize = (SIDE + 1) * 6 + 1;

    /// The weights of a corner of the cell: the limit stencil about it.
    #[inline(always)]
    fn stencil(&self, corner: [bool; 2]) -> [Q28; 16] {
        let Some(about) = self.about(corner.map(|end| 2 * usize::from(end))) else { return [0; 16] };
        core::array::from_fn(|k| about.get((3 - k / 4) * 2 * SIDE + (3 - k % 4) * 2).copied().unwrap_or(0))
    }
}

/// With 28 fractional bits. Places that differ by whole ones are the weights of one place, which add up to 1:
/// what rounding loses of it goes to those in the middle.
fn rounded(halves: &[[i64; 7]; 7]) -> [Q28; SIDE * SIDE] {
    let (mut all, mut left) = ([0; SIDE * SIDE], [[ONE; 2]; 2]);
    for (i, row) in halves.iter().enumerate() {
        for (j, weight) in row.iter().enumerate() {
            let weight = ((weight >> 27).wrapping_add(1) >> 1) as i32;
            if let Some(place) = all.get_mut(SIDE * (i + 1) + j + 1) {
                *place = weight;
            }
            let left = &mut left[i & 1][j & 1];
            *left = left.wrapping_sub(weight);
        }
    }
    for [i, j] in [[2, 2], [2, 3], [3, 2], [3, 3_usize]] {
        let middle = &mut all[SIDE * (i + 1) + j + 1];
        *middle = middle.wrapping_add(left[i & 1][j & 1]);
    }
    all
}

/// `phi` at the place `(x, y)` by halves from -3/2 on, from `phi` at whole places: `sum_j m(j) phi(x - j)`,
/// each product rounded down, 56 fractional bits. Out of line: products of 128 bits take many instructions.
#[inline(never)]
fn refined(entries: &[[Q28; 5]; 5], limit: &[[i64; 3]; 3], x: usize, y: usize) -> i64 {
    let mut sum = 0_i64;
    for (k, row) in limit.iter().enumerate() {
        for (l, weight) in row.iter().enumerate() {
            // the entry of j = x - k - 2
            let row = entries.get(x.wrapping_sub(k));
            let entry = row.and_then(|row| row.get(y.wrapping_sub(l))).copied().unwrap_or(0);
            let product = i128::from(*weight) * i128::from(entry);
            sum = sum.saturating_add(i64::try_from(product >> 28).unwrap_or(i64::MAX));
        }
    }
    sum
}

/// `phi` at `-3/2, -1 ... 3/2` along both axes: at whole places what is fixed by one refinement about a grid
/// point, by iteration with 56 fractional bits, at the others by one more.
#[inline(never)]
fn halves(entries: &[[Q28; 5]; 5]) -> [Q28; SIDE * SIDE] {
    // the grid point's own weight 1 is a start like any other
    let mut limit = [[0_i64; 3]; 3];
    limit[1][1] = 1 << 56;
    for _ in 0..ROUNDS {
        let mut next = limit;
        for (row, x) in next.iter_mut().zip([1, 3, 5]) {
            for (weight, y) in row.iter_mut().zip([1, 3, 5]) {
                *weight = refined(entries, &limit, x, y);
            }
        }
        // rounding down loses what the middle takes up
        let lost = next.iter().flatten().fold(1_i64 << 56, |left, weight| left.saturating_sub(*weight));
        next[1][1] = next[1][1].saturating_add(lost);
        limit = next;
    }
    let mut halves = [[0; 7]; 7];
    for (x, row) in halves.iter_mut().enumerate() {
        for (y, weight) in row.iter_mut().enumerate() {
            *weight = refined(entries, &limit, x, y);
        }
    }
    rounded(&halves)
}

impl Scheme<16> for Mask {
    const BASE: u32 = 2;
    const SIDES: [usize; 2] = [4; 2];
    const STEPS: [usize; 2] = [1; 2];

    fn contraction(&self) -> &Contraction {
        &self.contraction
    }

    fn part(&self, heights: &[Q24; 16], digits: [u32; 2]) -> [Q24; 16] {
        exact_part(&self.classes, heights, digits.map(|digit| (digit & 1) as usize))
    }

    fn corner(&self, heights: &[Q24; 16], at_end: [bool; 2]) -> Q24 {
        mixed(heights, &self.stencil(at_end))
    }

    fn middle(&self, heights: &[Q24; 16]) -> Q24 {
        mixed(heights, &self.middle)
    }

    fn at(&self, heights: &[Q24; 16], at: [u32; 2], levels: u32) -> Q24 {
        let [s, t] = at.map(|index| Address::<2>::of(index, levels).ok());
        let (Some(s), Some(t)) = (s, t) else { return 0 };
        self.height(&heights.map(Real::from_bits), [s, t]).to_bits()
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::seeded::words;
    use super::*;
    use std::vec::Vec;

    /// What is proven of any word holds of words of up to 12 digits, and is not much more than they make:
    /// heights that are allowed stay in their format.
    #[test]
    fn no_word_makes_more_of_heights_than_is_proven() {
        let mut word = words(31);
        let (mut tried, mut closest) = (0, 0.0_f64);
        while tried < 12 * 50 {
            let cubic = [1, 4, 6, 4, 1];
            let mut entries = cubic.map(|a| cubic.map(|b| ((a * b) << 22) + word(26)));
            for class in 0..4_usize {
                let of = |k: &usize| k / 5 % 2 == class / 2 && k % 5 % 2 == class % 2;
                let sum: i32 = (0..25).filter(of).map(|k| entries[k / 5][k % 5]).sum();
                entries[2 - class / 2][2 - class % 2] += ONE - sum;
            }
            let Ok(mask) = Mask::new(entries.map(|row| row.map(Near::from_bits))) else { continue };
            let maps = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[i, j]| mask.map(i, j).unwrap());
            let proven = 128.0 / mask.contraction().most().to_num::<f64>();
            for _ in 0..50 {
                let mut columns: Vec<[f64; 16]> =
                    (0..16).map(|k| core::array::from_fn(|i| f64::from(u8::from(i == k)))).collect();
                for _ in 0..1 + word(31).unsigned_abs() % 12 {
                    let map = &maps[(word(31) & 3) as usize];
                    for column in &mut columns {
                        let row = |row: &[Q28; 16]| {
                            row.iter().zip(&*column).map(|(a, b)| f64::from(*a) * b).sum::<f64>()
                        };
                        *column = map.rows().each_ref().map(|of| row(of) / f64::from(ONE));
                    }
                }
                let most = columns.iter().map(|column| column.iter().map(|w| w.abs()).sum::<f64>());
                let most = most.fold(0.0, f64::max);
                assert!(most <= proven, "{most} {proven}");
                closest = closest.max(most / proven);
                tried += 1;
            }
        }
        assert!(closest > 0.7 && closest < 1.0, "{closest}");
    }
}
