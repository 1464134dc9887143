//! The min-max pyramid of a terrain, in lent memory: bounds of the heights of each square of `2^k` cells.
//!
//! The bounds of a cell are those of its patch, the hull of its Bezier points, which is rigorous; the bounds
//! of a node are the hull of its parts'. Levels stand one behind the other, cells first.
//!
//! Format: 16 bits a bound, 9 of them fractional, rounded outwards.

use crate::num::Real;
use crate::num::formats::Q24;
use crate::terrain::{Heights, InnerGeometry};

/// Bounds of heights, 9 fractional bits: inside ±64.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct HeightRange {
    low: i16,
    high: i16,
}

/// What arithmetic along a ray may add to a height: 2^-18.
const SLACK: i32 = 1 << 6;

impl HeightRange {
    /// Round these heights; none beyond ±64.
    fn outwards([low, high]: [Real; 2]) -> Option<Self> {
        let low = i16::try_from((low.to_bits().saturating_sub(SLACK)) >> 15).ok()?;
        let high = i16::try_from((high.to_bits().saturating_add(SLACK + (1 << 15) - 1)) >> 15).ok()?;
        Some(Self { low, high })
    }

    fn hull(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    #[inline(always)]
    pub(super) fn heights(self) -> [Q24; 2] {
        [i32::from(self.low) << 15, i32::from(self.high) << 15]
    }
}

/// How many nodes a level has along an axis.
const fn nodes(cells: u32, level: u32) -> usize {
    ((cells - 1) >> level) as usize + 1
}

/// The level with one node.
pub(super) const fn depth(columns: u32, rows: u32) -> u32 {
    let cells = if columns > rows { columns } else { rows };
    32 - (cells - 1).leading_zeros()
}

/// How many bounds there are, for so many columns and rows of cells.
pub(super) const fn count(columns: u32, rows: u32) -> usize {
    let (mut sum, mut level) = (0, 0);
    while level <= depth(columns, rows) {
        sum += nodes(columns, level) * nodes(rows, level);
        level += 1;
    }
    sum
}

/// Fills in the bounds of all levels; which cell has heights beyond ±64, if one has.
pub(super) fn fill(
    heights: &Heights<'_>,
    inner: InnerGeometry,
    ranges: &mut [HeightRange],
) -> Result<(), Real> {
    let (columns, rows) = (heights.columns() - 1, heights.rows() - 1);
    let mut places = ranges.iter_mut();
    for row in 0..rows {
        for (column, place) in (0..columns).zip(&mut places) {
            let range = inner.patch(heights, column, row).range();
            let [low, high] = range;
            let farther = if high > -low { high } else { low };
            *place = HeightRange::outwards(range).ok_or(farther)?;
        }
    }
    let mut from = 0_usize;
    for level in 1..=depth(columns, rows) {
        let (across, down) = (nodes(columns, level - 1), nodes(rows, level - 1));
        let (wide, high) = (nodes(columns, level), nodes(rows, level));
        let to = from + across * down;
        let (below, own) = ranges.split_at_mut_checked(to).unwrap_or_default();
        let below = below.get(from..).unwrap_or_default();
        let mut own = own.iter_mut();
        for j in 0..high {
            for (i, place) in (0..wide).zip(&mut own) {
                let (i, j) = (2 * i, 2 * j);
                let (k, l) = ((i + 1).min(across - 1), (j + 1).min(down - 1));
                let at = |i: usize, j: usize| below.get(j * across + i).copied().unwrap_or_default();
                *place = at(i, j).hull(at(k, j)).hull(at(i, l).hull(at(k, l)));
            }
        }
        from = to;
    }
    Ok(())
}

/// Where the levels begin.
pub(super) fn begins(columns: u32, rows: u32) -> [u32; 17] {
    let mut sum = 0;
    core::array::from_fn(|level| {
        let begin = sum;
        sum += (nodes(columns, level as u32) * nodes(rows, level as u32)) as u32;
        begin
    })
}
