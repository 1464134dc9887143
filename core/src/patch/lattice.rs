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
use super::mask_step::{Classes, place, refine};
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
    /// 1 where the second is odd, 2 where the first is, 3 for both; [`Error::OutOfRange`] for an entry of 2 or
    /// more in magnitude; [`Error::NotContractive`] and [`Error::OutOfRange`] as [`Contraction`] says.
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
                let (what, value, max) = ("entry of a mask", wide(i64::from(*entry)), Wide::lit("2"));
                return Err(Error::OutOfRange { what, index: Some(index), value, min: -max, max });
            }
        }
        let (classes, halves) = (Classes::of(&bits), halves(&bits));
        let mask = Self { entries: bits, classes, halves, contraction: Contraction::NONE };
        let mut maps = [Barycentric::IDENTITY; 4];
        for (map, (i, j)) in maps.iter_mut().zip([(0, 0), (0, 1), (1, 0), (1, 1)]) {
            *map = mask.map(i, j)?;
        }
        let middle = mean(CORNERS.map(|corner| mask.stencil(corner)));
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

    /// The height at `s` and `t` of a cell, saturated. All addresses of a place give the same bits.
    ///
    /// Error: 2 units of `2^-24` a digit and 2 where heights are within 1 of 0 and the mask is a fitted one,
    /// in proportion beyond: `36 d r^2 2^-31` a digit for heights that differ by `d` and weights whose
    /// magnitudes are proven to add up to `r` at most (`a_lattice_is_within_two_units_a_digit`).
    ///
    /// Cost: 100 products a digit but the last, and 16 (the kernel row `patch lattice` counts a point of 12).
    pub fn height(&self, heights: &[Real; 16], at: [Address<2>; 2]) -> Real {
        Real::from_bits(self.height_bits(&heights.map(Real::to_bits), &Pair::of(at)))
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
    fn stencil(&self, corner: [bool; 2]) -> [Q28; 16] {
        let Some(about) = self.about(corner.map(|end| 2 * usize::from(end))) else { return [0; 16] };
        core::array::from_fn(|k| about.get((3 - k / 4) * 2 * SIDE + (3 - k % 4) * 2).copied().unwrap_or(0))
    }

    #[inline(always)]
    fn height_bits(&self, heights: &[Q24; 16], pair: &Pair) -> Q24 {
        // how far heights are from one of them: halves do not overflow
        let [base, half] = [heights[5], heights[5] >> 1];
        let spread = heights.iter().fold(0, |spread, height| {
            let apart = (height >> 1).wrapping_sub(half);
            spread | apart ^ (apart >> 31)
        });
        // they differ by up to 2^(33 - zeros) and a unit, and all that refining makes of that fits a word
        let taken = self.contraction.headroom().wrapping_add(2);
        let scale = spread.leading_zeros().wrapping_sub(taken).cast_signed().min(14);
        let (one, other) = ([(); 16].map(|()| Cell::new(0)), [(); 16].map(|()| Cell::new(0)));
        for (k, height) in heights.iter().enumerate() {
            one[place(k / 4, k % 4)].set(if scale >= 0 {
                height.wrapping_sub(base).wrapping_shl(scale.cast_unsigned())
            } else {
                ((i64::from(*height) - i64::from(base)) >> scale.unsigned_abs()) as i32
            });
        }
        let (mut from, mut to) = (&one, &other);
        // the last digits are in the halves
        let [mut s, mut t] = pair.indices.map(|index| index.wrapping_shl(32_u32.wrapping_sub(pair.levels)));
        for _ in 1..pair.levels {
            refine(&self.classes, from, to, [s >> 31 == 1, t >> 31 == 1]);
            (s, t) = (s << 1, t << 1);
            core::mem::swap(&mut from, &mut to);
        }
        let by_halves = |digits: u32, end: bool| {
            if pair.levels == 0 { 2 * usize::from(end) } else { (digits >> 31) as usize + usize::from(end) }
        };
        let [end_s, end_t] = pair.at_end;
        let Some(about) = self.about([by_halves(s, end_s), by_halves(t, end_t)]) else { return base };
        let mut sum = 0;
        for a in 0..4 {
            for b in 0..4 {
                let weight = about[(3 - a) * 2 * SIDE + (3 - b) * 2];
                sum = product(from[place(a, b)].get(), weight).wrapping_add(sum);
            }
        }
        // a word times weights below 15 in sum: below 2^63
        let shift = 28_i32.wrapping_add(scale).cast_unsigned();
        let above = (sum.wrapping_shr(shift.wrapping_sub(1)).wrapping_add(1)) >> 1;
        above.wrapping_add(base.into()).clamp(i32::MIN.into(), i32::MAX.into()) as i32
    }
}

/// What is lost of 1 by rounding goes to the middle of each of the classes of places by halves; 28 fractional
/// bits.
fn rounded(halves: &[[i64; 7]; 7]) -> [Q28; SIDE * SIDE] {
    let mut all = [0; SIDE * SIDE];
    let mut left = [[ONE; 2]; 2];
    let mut each = |i: usize, j: usize, weight: i64, whole: bool| {
        let place = all.get_mut(SIDE * (i + 1) + j + 1);
        let left = left.get_mut(i & 1).and_then(|left| left.get_mut(j & 1));
        if let (Some(place), Some(left)) = (place, left) {
            *place = if whole { *left } else { ((weight >> 27).wrapping_add(1) >> 1) as i32 };
            *left = left.wrapping_sub(*place);
        }
    };
    // the middle of a class is at 2 or 3 of both indices: the last
    let middle = |index: usize| matches!(index, 2 | 3);
    for last in [false, true] {
        for (i, row) in halves.iter().enumerate() {
            for (j, weight) in row.iter().enumerate() {
                if (middle(i) && middle(j)) == last {
                    each(i, j, *weight, last);
                }
            }
        }
    }
    all
}

/// `phi` at `-3/2, -1 ... 3/2` along both axes: at whole places what is fixed by one refinement about a grid
/// point, by iteration with 56 fractional bits, at the others by one more.
#[inline(never)]
fn halves(entries: &[[Q28; 5]; 5]) -> [Q28; SIDE * SIDE] {
    // the grid point's own weight 1 is a start like any other
    let mut limit = [[0_i64; 3]; 3];
    limit[1][1] = 1 << 56;
    let whole = |limit: &[[i64; 3]; 3], x: usize, y: usize| {
        // phi at (x, y) halves from -3/2 on, from phi at whole places: `sum_j m(j) phi(x - j)`
        let mut sum = 0_i64;
        for (k, row) in limit.iter().enumerate() {
            for (l, weight) in row.iter().enumerate() {
                // the entry of j = x - k - 2
                let entry = (x.wrapping_sub(k), y.wrapping_sub(l));
                let entry = entries.get(entry.0).and_then(|row| row.get(entry.1)).copied().unwrap_or(0);
                let product = i128::from(*weight) * i128::from(entry);
                sum = sum.saturating_add(i64::try_from(product >> 28).unwrap_or(i64::MAX));
            }
        }
        sum
    };
    for _ in 0..ROUNDS {
        let mut next = [1, 3, 5].map(|x| [1, 3, 5].map(|y| whole(&limit, x, y)));
        // rounding down loses what the middle takes up
        let lost = next.iter().flatten().fold(1_i64 << 56, |left, weight| left.saturating_sub(*weight));
        next[1][1] = next[1][1].saturating_add(lost);
        limit = next;
    }
    rounded(&[0, 1, 2, 3, 4, 5, 6].map(|x| [0, 1, 2, 3, 4, 5, 6].map(|y| whole(&limit, x, y))))
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
        mixed(heights, &self.stencil(at_end))
    }

    fn at(&self, heights: &[Q24; 16], at: [u32; 2], levels: u32) -> Q24 {
        let [s, t] = at.map(|index| Address::<2>::of(index, levels).ok());
        let (Some(s), Some(t)) = (s, t) else { return 0 };
        self.height_bits(heights, &Pair::of([s, t]))
    }
}
