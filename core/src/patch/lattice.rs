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
//! patch. Its ends are not control points: `c_00` is the limit stencil, the eigenvector of `T_00` for 1.
//!
//! Source: N. Dyn, D. Levin, "Subdivision schemes in geometric modelling", 2002, for the stationary scheme;
//! it is a patch of Tosan, Guerin, Baskurt (section 4.1) whose boundary is not a control point's. Formats: 28
//! fractional bits, a row rounded once.

use super::address::{Address, Pair};
use super::barycentric::{Barycentric, ONE, mixed, wide};
use super::contraction::{Contraction, mean};
use super::mask_step::{Square, weights};
use super::scheme::{CORNERS, Scheme};
use crate::Error;
use crate::num::formats::{Q24, Q28};
use crate::num::{Near, Real, product};

/// A stationary mask of 5 x 5 entries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mask {
    entries: [[Q28; 5]; 5],
    /// `c_00` on the 3 x 3 heights about a grid point.
    limit: [[Q28; 3]; 3],
    contraction: Contraction,
}

/// Rounds of `c = T_00 c`: each draws it nearer by the norm of `T_00`.
const ROUNDS: u32 = 128;

impl Mask {
    /// The mask with these entries, the first index along `s`. Where rounding left the sum of a class off by
    /// up to 9 units, its entry in the middle takes it up.
    ///
    /// # Errors
    /// [`Error::NotBarycentric`] for a class with another sum: `column` 0 for the entries with even indices,
    /// 1 where the second is odd, 2 where the first is, 3 for both; [`Error::NotContractive`] and
    /// [`Error::OutOfRange`] as [`Contraction`] says.
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
        let limit = limit(&bits);
        let mask = Self { entries: bits, limit, contraction: Contraction::NONE };
        let mut maps = [Barycentric::IDENTITY; 4];
        for (map, (i, j)) in maps.iter_mut().zip([(0, 0), (0, 1), (1, 0), (1, 1)]) {
            *map = mask.map(i, j)?;
        }
        let middle = mean(CORNERS.map(|corner| flat(&mask.stencil(corner))));
        Ok(Self { contraction: Contraction::prove(&maps, &middle)?, ..mask })
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

    /// `phi` at `s` and `t` in a cell: how much of each of its 4 x 4 heights. All addresses of a place give
    /// the same bits.
    ///
    /// They add up to 1 exactly. Error: below 2 units of `2^-28` a digit, and 2
    /// (`a_lattice_is_within_two_units_a_digit`).
    ///
    /// Cost: 84 products a digit (the kernel row `patch lattice` counts a point of 12 digits).
    pub fn weights(&self, at: [Address<2>; 2]) -> [Near; 16] {
        self.weights_bits(&Pair::of(at)).map(Near::from_bits)
    }

    /// The height at `s` and `t` of a cell, saturated.
    pub fn height(&self, heights: &[Real; 16], at: [Address<2>; 2]) -> Real {
        Real::from_bits(mixed(&heights.map(Real::to_bits), &self.weights_bits(&Pair::of(at))))
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

    /// The weights of a corner of the cell: the limit stencil about it.
    fn stencil(&self, [s, t]: [bool; 2]) -> Square {
        let mut weights = [[0; 4]; 4];
        for (row, of) in weights.iter_mut().skip(s.into()).zip(&self.limit) {
            for (weight, of) in row.iter_mut().skip(t.into()).zip(of) {
                *weight = *of;
            }
        }
        weights
    }

    #[inline(always)]
    fn weights_bits(&self, pair: &Pair) -> [Q28; 16] {
        weights(&self.entries, pair, &self.stencil(pair.at_end))
    }
}

fn flat(weights: &Square) -> [Q28; 16] {
    let mut all = [0; 16];
    for (to, weight) in all.iter_mut().zip(weights.as_flattened()) {
        *to = *weight;
    }
    all
}

/// The stencil that is fixed by one refinement about a grid point, by iteration with 56 fractional bits.
#[inline(never)]
fn limit(entries: &[[Q28; 5]; 5]) -> [[Q28; 3]; 3] {
    // the grid point's own weight 1 is a start like any other
    let mut limit = [[0_i64; 3]; 3];
    limit[1][1] = 1 << 56;
    for _ in 0..ROUNDS {
        let mut next = [[0_i64; 3]; 3];
        for (a, row) in next.iter_mut().enumerate() {
            for (b, to) in row.iter_mut().enumerate() {
                for (k, weights) in limit.iter().enumerate() {
                    for (l, weight) in weights.iter().enumerate() {
                        let index = |to: usize, from: usize| (3 + to).checked_sub(2 * from);
                        let entry = index(k, a).and_then(|i| Some(*entries.get(i)?.get(index(l, b)?)?));
                        let product = i128::from(*weight) * i128::from(entry.unwrap_or(0));
                        *to = to.saturating_add(i64::try_from(product >> 28).unwrap_or(i64::MAX));
                    }
                }
            }
        }
        // rounding down loses what the middle takes up
        let lost = next.iter().flatten().fold(1_i64 << 56, |left, weight| left.saturating_sub(*weight));
        next[1][1] = next[1][1].saturating_add(lost);
        limit = next;
    }
    let mut rounded = limit.map(|row| row.map(|weight| ((weight >> 27).wrapping_add(1) >> 1) as i32));
    let lost = rounded.iter().flatten().fold(ONE, |left, weight| left.saturating_sub(*weight));
    rounded[1][1] = rounded[1][1].saturating_add(lost);
    rounded
}

impl Scheme<16> for Mask {
    const BASE: u32 = 2;
    const SIDES: [usize; 2] = [4; 2];
    const STEPS: [usize; 2] = [1; 2];

    fn contraction(&self) -> &Contraction {
        &self.contraction
    }

    fn part(&self, heights: &[Q24; 16], [i, j]: [u32; 2]) -> [Q24; 16] {
        let mut result = [0; 16];
        for (k, row) in result.chunks_exact_mut(4).enumerate() {
            for (l, to) in row.iter_mut().enumerate() {
                let mut sum = 1_i64 << 27;
                let (top_s, top_t) = (i as usize + 3 + k, j as usize + 3 + l);
                for (a, heights) in heights.chunks_exact(4).enumerate() {
                    let Some(entries) = top_s.checked_sub(2 * a).and_then(|i| self.entries.get(i)) else {
                        continue;
                    };
                    for (b, height) in heights.iter().enumerate() {
                        if let Some(entry) = top_t.checked_sub(2 * b).and_then(|j| entries.get(j)) {
                            sum = product(*height, *entry).wrapping_add(sum);
                        }
                    }
                }
                *to = (sum >> 28) as i32;
            }
        }
        result
    }

    fn corner(&self, heights: &[Q24; 16], at_end: [bool; 2]) -> Q24 {
        mixed(heights, &flat(&self.stencil(at_end)))
    }

    fn at(&self, heights: &[Q24; 16], at: [u32; 2], levels: u32) -> Q24 {
        let [s, t] = at.map(|index| Address::<2>::of(index, levels).ok());
        let (Some(s), Some(t)) = (s, t) else { return 0 };
        mixed(heights, &self.weights_bits(&Pair::of([s, t])))
    }
}
