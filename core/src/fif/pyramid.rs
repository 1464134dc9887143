//! What is known about a function above each of its cells: range, mean and mean slope, level by level.
//!
//! A cell of level `k` belongs to an address of `k` maps. With `I_w` the interval of the address `w`,
//! - range: `B(j w) = alpha_j B(w) + range of q_j over I_w`, rigorous for any rigorous `B(w)`; then each
//!   parent becomes the hull of its children and the finest level is computed again from its tightened
//!   parents, until nothing changes;
//! - mean: `m(j w) = alpha_j m(w) + mean of q_j over I_w`;
//! - slope: `s(j w) = (alpha_j s(w) + mean of q_j' over I_w / (x_N - x_0)) / a_j`.
//!
//! No polynomial is ever composed. Ranges are rounded outward. After Cochran, Lewis, Hart, eq. 47-48, which
//! need composites and give boxes two to three times as many.

use super::function::Fif;
use super::map::Map;
use super::polynomial::{Polynomial, length_of, part_of, twice_high};
use super::value::{FRACTION_Q55, ONE_UQ63, real_above, real_below};
use crate::Error;
use crate::num::{Real, mul_high, quotient, real_from};

/// A function above one of its cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cell {
    /// Mean value. Error: below `2^-23 / (1 - max|alpha|)` (row `Cell::mean (integral of g)`).
    pub mean: Real,
    /// Mean slope, `(f(x1) - f(x0)) / (x1 - x0)`, saturated. Error: `2^-23 / (1 - max|alpha_j / a_j|)` where
    /// that is positive (row `Cell::slope (integral of g)`).
    pub slope: Real,
    // the range stands last: what lies at an offset of its own, a Cortex-M4 loads by one instruction
    /// No value is below.
    pub min: Real,
    /// No value is above.
    pub max: Real,
}

impl Cell {
    /// All zero: for the memory that a pyramid is lent.
    pub const ZERO: Self = Self { min: Real::ZERO, max: Real::ZERO, mean: Real::ZERO, slope: Real::ZERO };
}

/// The cells of a function from the whole domain (level 0) down to level `depth`, in memory lent by the
/// caller.
///
/// ```
/// use attractor::fif::{Cell, Fif, Knot, Pyramid};
/// use attractor::num::{Real, Scaling, Wide};
///
/// let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
/// let f = Fif::<2, 1>::interpolating(&knots, &[Scaling::from_num(0.5); 2])?;
/// let mut memory = [Cell::ZERO; Pyramid::cells(2, 8)];
/// let pyramid = Pyramid::new(&f, 8, &mut memory)?;
/// // the function's maximum is 4/3
/// let top = pyramid.root().max.to_num::<f64>();
/// assert!(top >= 4.0 / 3.0 && top < 4.0 / 3.0 + 0.02);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Pyramid<'a> {
    cells: &'a [Cell],
    /// Left ends of the maps' intervals, 31 fractional bits.
    starts: &'a [u32],
    depth: u32,
    x0: i64,
    width: u64,
}

impl Pyramid<'static> {
    /// How many cells the levels 0 to `depth` of a function of `maps` maps have: the length of the memory to
    /// lend.
    pub const fn cells(maps: usize, depth: u32) -> usize {
        let (offset, count) = level_at(maps, depth);
        offset.saturating_add(count)
    }

    /// Levels are never deeper: cell indices have 32 bits.
    pub const MAX_DEPTH: u32 = 16;
}

impl<'a> Pyramid<'a> {
    /// The pyramid of `fif` down to level `depth`.
    ///
    /// Cost: at most 128 passes over the finest level, one product of 64 bits for each coefficient, scaling
    /// and cell; the passes end when no bound moves (about 20 for a function with scalings of 1/2).
    ///
    /// # Errors
    /// [`Error::BufferLength`] if `memory` is shorter than [`Pyramid::cells`]; [`Error::Capacity`] for a
    /// depth above [`Pyramid::MAX_DEPTH`].
    pub fn new<const N: usize, const D: usize>(
        fif: &'a Fif<N, D>,
        depth: u32,
        memory: &'a mut [Cell],
    ) -> Result<Self, Error> {
        if depth > Pyramid::MAX_DEPTH {
            let (needed, capacity) = (depth as usize, Pyramid::MAX_DEPTH as usize);
            return Err(Error::Capacity { what: "levels", needed, capacity });
        }
        let given = memory.len();
        let needed = Pyramid::cells(fif.maps.len(), depth);
        let what = "cells of the pyramid";
        let cells = memory.get_mut(..needed).ok_or(Error::BufferLength { what, given, needed })?;
        if let Some(root) = cells.first_mut() {
            let rise = fif.last.saturating_sub(fif.first);
            let slope = quotient(rise, 48 + 24 - FRACTION_Q55, fif.width);
            *root = Cell {
                min: real_below(fif.range.0),
                max: real_above(fif.range.1),
                mean: real_from(fif.mean(), FRACTION_Q55),
                slope: saturated(slope),
            };
        }
        for level in 0..depth {
            fill(&fif.maps, fif.width, cells, level, Fresh::All);
        }
        for _ in 0..128 {
            tighten(cells, fif.maps.len());
            if depth == 0 || !fill(&fif.maps, fif.width, cells, depth - 1, Fresh::Range) {
                break;
            }
        }
        tighten(cells, fif.maps.len());
        Ok(Self { cells, starts: &fif.starts, depth, x0: fif.x0, width: fif.width })
    }

    /// The cell of the whole domain.
    pub fn root(&self) -> Cell {
        self.cells.first().copied().unwrap_or_default()
    }

    /// The finest level.
    pub const fn depth(&self) -> u32 {
        self.depth
    }

    /// How many parts a cell has at the next level.
    pub const fn branching(&self) -> u32 {
        self.starts.len() as u32
    }

    /// The cells of a level from left to right; empty below the finest.
    pub fn level(&self, level: u32) -> &'a [Cell] {
        let (start, count) = level_at(self.starts.len(), level.min(Pyramid::MAX_DEPTH));
        if level > self.depth { &[] } else { self.cells.get(start..start + count).unwrap_or(&[]) }
    }

    /// All cells, level after level.
    pub(crate) const fn all(&self) -> &'a [Cell] {
        self.cells
    }

    /// Where a level begins among all cells, and how many cells it has.
    pub(super) const fn place(&self, level: u32) -> (usize, usize) {
        level_at(self.starts.len(), level)
    }

    /// Left ends of the parts of a cell, in the cell's unit abscissa with 31 fractional bits.
    pub(crate) const fn starts(&self) -> &'a [u32] {
        self.starts
    }

    /// `x_0` and `x_N - x_0`, 48 fractional bits.
    pub(crate) const fn domain_bits(&self) -> (i64, u64) {
        (self.x0, self.width)
    }

    /// Bounds of the function above `[from, to]`, outward by `2^-25` of the domain and to the cells of the
    /// finest level. Cost: `2 depth * maps` cells.
    pub fn bounds(&self, from: crate::num::Wide, to: crate::num::Wide) -> (Real, Real) {
        let whole = crate::num::Reciprocal::of(self.width);
        let unit = |x: crate::num::Wide| {
            let distance = if x.to_bits() < self.x0 { 0 } else { x.to_bits().wrapping_sub(self.x0) as u64 };
            whole.quotient(distance.min(self.width)) >> 32
        };
        // Places of cells are rounded down to 2^-31, by at most two units a level: look that much to both
        // sides.
        const PAD: u64 = 1 << 6;
        let (from, to) = (unit(from.min(to)).saturating_sub(PAD), unit(from.max(to)) + PAD);
        let mut hull = (Real::MAX, Real::MIN);
        let mut add = |offset: usize, index: usize| {
            if let Some(cell) = self.cells.get(offset + index) {
                hull = (hull.0.min(cell.min), hull.1.max(cell.max));
            }
        };
        let n = self.starts.len();
        let mut offset = 0;
        let (mut left, mut right) = (Span::WHOLE, Span::WHOLE);
        for _ in 0..self.depth {
            offset = offset * n + 1;
            let (a, b) = (left.child(self.starts, from), right.child(self.starts, to));
            // the parts between the two, of the same cell or of the two ends' cells
            if left.index == right.index {
                (a.index + 1..b.index).for_each(|i| add(offset, i));
            } else {
                (a.index + 1..(left.index + 1) * n).for_each(|i| add(offset, i));
                (right.index * n..b.index).for_each(|i| add(offset, i));
            }
            (left, right) = (a, b);
        }
        add(offset, left.index);
        add(offset, right.index);
        hull
    }
}

/// A cell's place: index in its level, left end and width with 31 fractional bits.
#[derive(Clone, Copy)]
struct Span {
    index: usize,
    start: u64,
    width: u64,
}

impl Span {
    const WHOLE: Self = Self { index: 0, start: 0, width: 1 << 31 };

    /// The part that holds `u`; ends count to the part on their left, so that the first part of width 0
    /// holds 0.
    fn child(self, starts: &[u32], u: u64) -> Self {
        let place = |s: u32| self.start + ((u64::from(s) * self.width) >> 31);
        let j = starts.partition_point(|s| place(*s) < u).saturating_sub(1);
        let start = starts.get(j).map_or(self.start, |s| place(*s));
        let end = starts.get(j + 1).map_or(self.start + self.width, |s| place(*s));
        Self { index: self.index * starts.len() + j, start, width: end - start }
    }
}

/// Offset and number of the cells of a level, saturated.
#[inline(never)]
const fn level_at(maps: usize, level: u32) -> (usize, usize) {
    if maps == 1 {
        return (level as usize, 1);
    }
    let (mut offset, mut count) = (0_usize, 1_usize);
    let mut k = 0;
    // nothing is added to what is saturated, and nothing comes of no maps
    while k < level && count > 0 && offset < usize::MAX {
        offset = offset.saturating_add(count);
        count = count.saturating_mul(maps);
        k += 1;
    }
    (offset, count)
}

/// Every cell above the finest level is narrowed to the hull of its parts: from the last to the first, so
/// that the parts come before what they are parts of.
#[inline(never)]
fn tighten(cells: &mut [Cell], maps: usize) {
    // every node but the first is one of the parts `maps q + 1` to `maps q + maps` of a node `q`
    let inner = cells.len().saturating_sub(1).checked_div(maps).unwrap_or(0);
    for node in (0..inner).rev() {
        let Some((upper, lower)) = cells.split_at_mut_checked(node + 1) else { return };
        let (Some(parent), Some(parts)) = (upper.last_mut(), lower.get((maps - 1) * node..)) else { return };
        let (mut low, mut high) = (Real::MAX, Real::MIN);
        for part in parts.iter().take(maps) {
            (low, high) = (low.min(part.min), high.max(part.max));
        }
        (parent.min, parent.max) = (parent.min.max(low), parent.max.min(high));
    }
}

/// What [`fill`] writes: whole cells, or ranges into cells that hold rigorous ones.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Fresh {
    All,
    Range,
}

/// Computes level `level + 1` from level `level`; whether a range has changed.
#[inline(never)]
fn fill<const D: usize>(maps: &[Map<D>], width: u64, cells: &mut [Cell], level: u32, fresh: Fresh) -> bool {
    let (offset, count) = level_at(maps.len(), level);
    let Some((upper, lower)) = cells.split_at_mut_checked(offset + count) else { return false };
    let Some(parents) = upper.get(offset..) else { return false };
    let mut changed = false;
    // position of j w: j count + position of w
    for (map, part) in maps.iter().zip(lower.chunks_exact_mut(count.max(1))) {
        let slopes = Slopes::of(width, map);
        for (index, (cell, parent)) in part.iter_mut().zip(parents).enumerate() {
            let (start, width) = interval(maps, index, level);
            let q = map.q.part(start, width);
            let (low, high) = range(map, &q, parent);
            if fresh == Fresh::All {
                let mean = twice_high(i64::from(parent.mean.to_bits()) << (FRACTION_Q55 - 24), map.scaling)
                    .wrapping_add(q.mean());
                *cell = Cell {
                    min: low,
                    max: high,
                    mean: real_from(mean, FRACTION_Q55),
                    slope: slopes.at(parent.slope, start, width),
                };
                changed = true;
            } else if low > cell.min || high < cell.max {
                (cell.min, cell.max) = (cell.min.max(low), cell.max.min(high));
                changed = true;
            }
        }
    }
    changed
}

/// `alpha B + range of q`, outward.
fn range<const D: usize>(map: &Map<D>, q: &Polynomial<D>, parent: &Cell) -> (Real, Real) {
    /// Errors of products and coefficients, far above and far below one unit of the result.
    const PAD: i64 = 1 << 10;
    let scaled = |y: Real| twice_high(i64::from(y.to_bits()) << (FRACTION_Q55 - 24), map.scaling);
    let (a, b) = (scaled(parent.min), scaled(parent.max));
    let (low, high) = q.range();
    let below = a.min(b).saturating_add(low).saturating_sub(PAD);
    let above = a.max(b).saturating_add(high).saturating_add(PAD);
    (real_below(below), real_above(above))
}

/// The interval of the cell at `index` of `level`, 63 fractional bits.
fn interval<const D: usize>(maps: &[Map<D>], index: usize, level: u32) -> (u64, u64) {
    let (mut start, mut width) = (0_u64, ONE_UQ63);
    let mut rest = index;
    for _ in 0..level {
        // innermost digit first
        let (quotient, digit) =
            (rest.checked_div(maps.len()).unwrap_or(0), rest.checked_rem(maps.len()).unwrap_or(0));
        if let Some(map) = maps.get(digit) {
            start = map.start + part_of(start, map.width);
            width = if width == ONE_UQ63 { map.width } else { part_of(width, map.width) };
        }
        rest = quotient;
    }
    (start, width)
}

/// How a map changes mean slopes: `s -> ratio s + mean of steepness`, `ratio = alpha_j / a_j`,
/// `steepness = q_j' / (a_j (x_N - x_0))`.
struct Slopes<const D: usize> {
    /// 40 fractional bits.
    ratio: i64,
    /// 39 fractional bits.
    steepness: Polynomial<D>,
}

impl<const D: usize> Slopes<D> {
    fn of(width: u64, map: &Map<D>) -> Self {
        let length = length_of(width, map.width); // 48 fractional bits
        let per_length = |c: i64| {
            // 55 + 48 - 48 = 55 bits; 32 are taken off, 4 of them before the product with a power
            quotient(c, 32, length).clamp(-(1 << 58), 1 << 58)
        };
        let quartered = Polynomial { constant: 0, powers: map.q.powers.map(|c| c >> 4) }.derivative();
        Self {
            ratio: quotient(map.scaling, 40, map.width),
            steepness: Polynomial {
                constant: per_length(quartered.constant) << 4,
                powers: quartered.powers.map(|c| per_length(c) << 4),
            },
        }
    }

    fn at(&self, slope: Real, start: u64, width: u64) -> Real {
        let scaled = mul_high(i64::from(slope.to_bits()) << 24, self.ratio);
        saturated(scaled + (self.steepness.part(start, width).mean() >> 15))
    }
}

fn saturated(bits: i64) -> Real {
    Real::from_bits(bits.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fif::Knot;
    use crate::num::{Scaling, Wide};
    use std::vec::Vec;

    fn map(scaling: i32, constant: i64, power: i64) -> Map<1> {
        Map {
            scaling: i64::from(scaling) << 32,
            q: Polynomial { constant, powers: [power] },
            start: 0,
            width: ONE_UQ63,
            per_width: crate::num::Reciprocal::of(ONE_UQ63),
        }
    }

    /// The exact range of `alpha B + q`, 87 fractional bits.
    fn exact(map: &Map<1>, parent: &Cell) -> (i128, i128) {
        let scaled = [parent.min, parent.max].map(|y| i128::from(y.to_bits()) * i128::from(map.scaling));
        let ends = [map.q.constant, map.q.constant + map.q.powers[0]].map(|q| i128::from(q) << 32);
        (scaled[0].min(scaled[1]) + ends[0].min(ends[1]), scaled[0].max(scaled[1]) + ends[0].max(ends[1]))
    }

    /// Against integers: outward, by less than two units, and where the exact end lies just above or below a
    /// number of the format.
    #[test]
    fn a_range_is_rounded_outward_by_less_than_two_units() {
        let mut touching = 0;
        for i in 1..4000_i32 {
            let scaling = i.wrapping_mul(0x2545_f491) | 1;
            // the inverse modulo 2^31 (Newton): scaling * y is one above a number of the format
            let mut y = scaling;
            for _ in 0..5 {
                y = y.wrapping_mul(2_i32.wrapping_sub(scaling.wrapping_mul(y)));
            }
            let y = (y & i32::MAX) >> (i & 1);
            for sign in [1, -1] {
                let (a, b) = (sign * y, sign * (y / 3));
                let parent =
                    Cell { min: Real::from_bits(a.min(b)), max: Real::from_bits(a.max(b)), ..Cell::ZERO };
                for (constant, power) in [(0, 0), (1 << 31, -(1 << 31)), (i64::from(i) << 31, 0), (-1, 2)] {
                    let map = map(scaling, constant, power);
                    let (low, high) = range(&map, &map.q, &parent);
                    let [low, high] = [low, high].map(|end| i128::from(end.to_bits()) << 63);
                    let (least, most) = exact(&map, &parent);
                    if low > -(1 << 94) && high < (i128::from(i32::MAX)) << 63 {
                        assert!(low <= least && most <= high, "{scaling} {parent:?} {constant} {power}");
                        assert!(least - low < 2 << 63 && high - most < 2 << 63, "{scaling} {parent:?}");
                        touching += u32::from(most & ((1 << 63) - 1) == 1 << 32);
                    }
                }
            }
        }
        assert!(touching > 1000, "{touching}");
    }

    /// The range of a parent that becomes the hull of its parts, and the places of cells.
    #[test]
    fn parents_become_the_hulls_of_their_parts() {
        let cell =
            |min: i32, max: i32| Cell { min: Real::from_bits(min), max: Real::from_bits(max), ..Cell::ZERO };
        let mut cells =
            [cell(-9, 9), cell(-8, 3), cell(0, 7), cell(-5, 2), cell(-7, 1), cell(1, 6), cell(2, 9)];
        tighten(&mut cells, 2);
        assert_eq!(cells[..3], [cell(-7, 7), cell(-7, 2), cell(1, 7)]);
        assert_eq!(cells[3..], [cell(-5, 2), cell(-7, 1), cell(1, 6), cell(2, 9)]);
    }

    /// What misses a cell misses its parts: walks through pairs of them pass over boxes by that.
    #[test]
    fn cells_lie_inside_what_they_are_parts_of() {
        let mut word = 77_u64;
        let mut next = || {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            ((word >> 33) as i64) - (1 << 30)
        };
        let mut tried = 0;
        for case in 0..90 {
            let maps = 2 + case % 3;
            let knots: Vec<_> = (0..=maps)
                .map(|i| Knot::new(Wide::from_num(i as i32), Wide::from_bits(next() << 19)))
                .collect();
            let scalings: Vec<_> = (0..maps).map(|_| Scaling::from_bits((next() / 10 * 9) as i32)).collect();
            let f = Fif::<4, 1>::interpolating(&knots, &scalings).unwrap();
            let mut memory = [Cell::ZERO; Pyramid::cells(4, 5)];
            let mut nest = |pyramid: Pyramid<'_>| {
                for level in 0..pyramid.depth() {
                    let parts = pyramid.level(level + 1).chunks_exact(maps);
                    for (cell, parts) in pyramid.level(level).iter().zip(parts) {
                        let inside = |part: &Cell| part.min >= cell.min && part.max <= cell.max;
                        assert!(parts.iter().all(inside), "{case} {level}: {cell:?} {parts:?}");
                        tried += parts.len();
                    }
                }
            };
            nest(Pyramid::new(&f, 5, &mut memory).unwrap());
            let integral = f.integral::<2>(Wide::ZERO).unwrap();
            nest(Pyramid::new(&integral, 5, &mut memory).unwrap());
        }
        assert!(tried > 20_000, "{tried}");
    }

    #[test]
    fn levels_lie_one_behind_the_other() {
        assert_eq!([0, 1, 2, 3].map(|level| level_at(3, level)), [(0, 1), (1, 3), (4, 9), (13, 27)]);
        assert_eq!(
            (Pyramid::cells(3, 2), Pyramid::cells(1, 5), Pyramid::cells(2, 16)),
            (13, 6, (1 << 17) - 1)
        );
        assert_eq!(Pyramid::cells(usize::MAX, 16), usize::MAX);
    }

    /// Thirds are no multiples of the places' unit: just beside the end of a cell both sides count.
    #[test]
    fn bounds_beside_the_end_of_a_cell_hold_the_cell() {
        let knots =
            [(0, 0), (1, 2), (2, -1), (3, 1)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let f = Fif::<3, 1>::interpolating(&knots, &[Scaling::from_num(0.4); 3]).unwrap();
        let mut memory = [Cell::ZERO; Pyramid::cells(3, 7)];
        let pyramid = Pyramid::new(&f, 7, &mut memory).unwrap();
        let cells = pyramid.level(7);
        for (index, pair) in cells.windows(2).enumerate() {
            let (start, _) = interval(&f.maps, index + 1, 7);
            // 3 times the place, 48 fractional bits, towards minus infinity; a place is low by less than
            // 2^-58
            let x = ((u128::from(start) * 3) >> 15) as i64;
            for (x, cell) in [(x - 4, pair[0]), (x + 4, pair[1])] {
                let x = Wide::from_bits(x);
                let (low, high) = pyramid.bounds(x, x);
                assert!(low <= cell.min && cell.max <= high, "{index} at {x}");
            }
        }
    }

    #[test]
    fn cells_are_counted_without_walking_through_the_levels() {
        assert_eq!(level_at(1, u32::MAX), (u32::MAX as usize, 1));
        assert_eq!(level_at(0, u32::MAX), (1, 0));
        assert_eq!(Pyramid::cells(2, u32::MAX), usize::MAX);
        for (maps, cells) in [(0, 1), (1, 4), (2, 15), (3, 40), (10, 1111)] {
            assert_eq!(Pyramid::cells(maps, 3), cells);
        }
    }

    fn rough() -> Fif<2, 1> {
        let knots = [(-2, 1), (0, 3), (2, -2)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        Fif::<2, 1>::interpolating(&knots, &[0.75, -0.5].map(Scaling::from_num)).unwrap()
    }

    /// Against the function and its integral at the ends of each cell: `(F(x1) - F(x0)) / (x1 - x0)` and
    /// `(f(x1) - f(x0)) / (x1 - x0)`.
    #[test]
    fn means_and_slopes_of_cells_are_those_of_their_ends() {
        let f = rough();
        let integral = f.integral::<2>(Wide::ZERO).unwrap();
        let mut memory = [Cell::ZERO; Pyramid::cells(2, 6)];
        let pyramid = Pyramid::new(&f, 6, &mut memory).unwrap();
        for level in 0..=6 {
            let count = 1_i64 << level;
            for (i, cell) in (0..).zip(pyramid.level(level)) {
                let [a, b] = [i, i + 1].map(|i| Wide::from_bits(((4 * i) << 48 >> level) - (2 << 48)));
                // over 4 / count
                let per_width =
                    |f: &dyn Fn(Wide) -> Wide| (f(b) - f(a)).to_bits() as f64 / 2_f64.powi(50) * count as f64;
                let mean = per_width(&|x| integral.at_wide(x));
                assert!(
                    (cell.mean.to_num::<f64>() - mean).abs() < 4.0 * 2_f64.powi(-23),
                    "{level} {i}: {}",
                    cell.mean
                );
                let slope = per_width(&|x| f.at_wide(x)).clamp(-128.0, Real::MAX.to_num());
                // a scaling is steeper than a half by 3/2: what is rounded grows by that each level
                let grown = 1.5_f64.powi(level as i32 + 1) * 4.0 * 2_f64.powi(-24);
                assert!(
                    (cell.slope.to_num::<f64>() - slope).abs() < grown,
                    "{level} {i}: {} {slope}",
                    cell.slope
                );
            }
        }
        assert_eq!((pyramid.branching(), pyramid.depth(), pyramid.level(7).len()), (2, 6, 0));
    }

    /// No pass would move a bound any more, and each one holds the values above its cell.
    #[test]
    fn ranges_have_settled_and_hold_the_values() {
        let f = rough();
        let mut memory = [Cell::ZERO; Pyramid::cells(2, 5)];
        let pyramid = Pyramid::new(&f, 5, &mut memory).unwrap();
        for level in 0..5 {
            let count = 1 << level;
            for (i, cell) in pyramid.level(level + 1).iter().enumerate() {
                let (map, parent) = (&f.maps[i / count], &pyramid.level(level)[i % count]);
                let (start, width) = interval(&f.maps, i % count, level);
                assert_eq!((start, width), ((i % count) as u64 * (ONE_UQ63 >> level), ONE_UQ63 >> level));
                let (low, high) = range(map, &map.q.part(start, width), parent);
                assert!(cell.min >= low && cell.max <= high, "{level} {i}");
                let parts = pyramid.level(level + 2).get(2 * i..2 * i + 2).unwrap_or(&[]);
                let hull = parts.iter().fold((Real::MAX, Real::MIN), |h, c| (h.0.min(c.min), h.1.max(c.max)));
                assert!(parts.is_empty() || cell.min >= hull.0 && cell.max <= hull.1, "{level} {i}");
                let (mut least, mut most) = (Real::MAX, Real::MIN);
                for k in 0..=256 {
                    let y = f
                        .at(f.abscissa(i as u64 * (ONE_UQ63 >> (level + 1)) + k * (ONE_UQ63 >> (level + 9))));
                    (least, most) = (least.min(y), most.max(y));
                }
                assert!(cell.min <= least && most <= cell.max, "{level} {i}");
                // images of boxes are wider than the function
                assert!(
                    cell.max - cell.min < most - least + Real::from_num(1.5),
                    "{level} {i}: {cell:?} {least} {most}"
                );
            }
        }
    }

    /// The hull of the cells that an interval touches, 64 units of `2^-31` of the domain to either side: as
    /// many as there are.
    #[test]
    fn bounds_are_the_hull_of_the_cells_they_touch() {
        let f = rough();
        let mut memory = [Cell::ZERO; Pyramid::cells(2, 5)];
        let pyramid = Pyramid::new(&f, 5, &mut memory).unwrap();
        let cells = pyramid.level(5);
        let mut word = 3_u64;
        let mut next = || {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (word >> 33) as i64
        };
        for k in 0..20_000_i64 {
            // places with 31 bits: anywhere, or at the end of a cell and a few units beside it
            let mut place = || match next() % 3 {
                0 => next() % (1 << 31),
                _ => ((next() % 33) << 26) + next() % 140 - 70,
            };
            let (a, b) = (place(), place());
            let wide = |place: i64| Wide::from_bits((place << 19) - (2 << 48));
            let got = pyramid.bounds(wide(a), wide(b));
            let inside = |place: i64| place.clamp(0, 1 << 31);
            let (from, to) = ((inside(a.min(b)) - 64).max(0), inside(a.max(b)) + 64);
            // an end counts to the part on its left, the first one to the first
            let touched = (0..)
                .zip(cells)
                .filter(|(i, _)| i << 26 < to && ((i + 1) << 26 >= from || *i == 31) || *i == 0 && from == 0);
            let hull = touched.fold((Real::MAX, Real::MIN), |h, (_, c)| (h.0.min(c.min), h.1.max(c.max)));
            assert_eq!(got, hull, "{k}: {a} {b}");
        }
        assert_eq!(
            pyramid.bounds(Wide::MIN, Wide::MAX),
            cells.iter().fold((Real::MAX, Real::MIN), |h, c| (h.0.min(c.min), h.1.max(c.max)))
        );
    }

    #[test]
    fn a_pyramid_has_16_levels_at_most_and_needs_its_memory() {
        let knots = [(0, 0), (1, 1)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let line = Fif::<1, 1>::interpolating(&knots, &[Scaling::ZERO]).unwrap();
        let mut memory = [Cell::ZERO; 20];
        assert!(Pyramid::new(&line, 16, &mut memory).is_ok());
        let deeper = Pyramid::new(&line, 17, &mut memory).unwrap_err();
        assert!(matches!(deeper, Error::Capacity { needed: 17, capacity: 16, .. }));
        let short = Pyramid::new(&line, 16, &mut memory[..16]).unwrap_err();
        assert!(matches!(short, Error::BufferLength { given: 16, needed: 17, .. }));
    }
}
