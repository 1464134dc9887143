//! The plane-to-line function: the height of a surface at any point of its lattice, on demand.
//!
//! The cell between four knots is halved again and again: the middle of each edge is displaced as that of a
//! curve (figure 5), then the centre (figure 6, [`super::law`]). A height depends on the corners of the cells
//! that hold its point and on `R` at theirs: any piece, in any order, at any resolution consists of the
//! heights of the whole, and what two pieces share is the same, bit for bit.
//!
//! A point is found by descent, one cell a level: time and memory are bounded, nothing is stored.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, "A fractal
//! plane-to-line function".

use super::cell::Cell;
use super::heights::{Heights, out_of_range};
use super::law::{LEVELS, Law};
use super::random::Randomness;
use crate::Error;
use crate::num::{Coordinate, RandomField, Real, Wide};

/// A surface through given heights. Size on a 32-bit machine: 92 bytes.
///
/// ```
/// use attractor::num::{Coordinate, RandomField, Real, Unit};
/// use attractor::terrain::{Heights, Law, PlaneToLine};
///
/// const KNOTS: [Real; 4] = [Real::lit("0"), Real::lit("1"), Real::lit("1"), Real::lit("0")];
/// let law = Law::new(const { Unit::lit("0.3") }, const { Unit::lit("0.8") })?;
/// let terrain = PlaneToLine::new(Heights::new(2, 2, &KNOTS)?, law, RandomField::new(7))?;
/// let at = |u: f64, v: f64| terrain.height(Coordinate::from_num(u), Coordinate::from_num(v));
/// assert_eq!([at(0.0, 0.0), at(1.0, 0.0)], [0, 1].map(Real::from_num));
/// assert_ne!(at(0.5, 0.0), at(0.0, 0.5));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct PlaneToLine<'a, R = RandomField> {
    heights: Heights<'a>,
    law: Law,
    random: R,
}

impl<'a, R: Randomness> PlaneToLine<'a, R> {
    /// The surface through these heights by this law.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if heights could leave ±64: the given ones and all displacements together.
    pub fn new(heights: Heights<'a>, law: Law, random: R) -> Result<Self, Error> {
        let [low, high] = heights.range();
        let largest = Wide::from(high).max(-Wide::from(low)).saturating_add(law.reach(0, LEVELS));
        if largest >= Wide::from_num(64) {
            return Err(out_of_range("height with its displacements", None, largest));
        }
        Ok(Self { heights, law, random })
    }

    /// The given heights.
    pub const fn heights(&self) -> &Heights<'a> {
        &self.heights
    }

    /// Its law.
    pub const fn law(&self) -> &Law {
        &self.law
    }

    /// Its random numbers.
    pub const fn random(&self) -> &R {
        &self.random
    }

    /// The height at a point; one outside the knots is moved to their rim.
    ///
    /// Error: below 2 units of `2^-24` a level (`heights_are_within_2_units_a_level`). Cost:
    /// five hashes and ten products a level (the kernel row `terrain height` counts 12 of them).
    pub fn height(&self, u: Coordinate, v: Coordinate) -> Real {
        let [u_0, v_0] = self.heights.origin();
        // from the first knot on, 16 fractional bits
        let along = |c: Coordinate, first: i16, count: u32| {
            let from = c.saturating_sub(first.into()).to_bits();
            from.clamp(0, i32::try_from((count - 1) << 16).unwrap_or(i32::MAX)) as u32
        };
        let (u, v) = (along(u, u_0, self.heights.columns()), along(v, v_0, self.heights.rows()));
        // the last column and row belong to the cell before
        let i = (u >> 16).min(self.heights.columns() - 2);
        let j = (v >> 16).min(self.heights.rows() - 2);
        let mut cell = self.knot_cell(i, j);
        let (mut u, mut v) = ((u - (i << 16)) as i32, (v - (j << 16)) as i32);
        let mut side = 1 << 16;
        for offset in self.law.offsets() {
            // the point is a corner when both are multiples of the side
            if (u | v) & (side - 1) == 0 {
                break;
            }
            side >>= 1;
            let (east, north) = (u >= side, v >= side);
            let middles = cell.halved_by(side, *offset, &self.random);
            cell = cell.part_by(side, &middles, east, north);
            u -= if east { side } else { 0 };
            v -= if north { side } else { 0 };
        }
        let [a, b, c, d] = cell.corners;
        let [south, north] = if u == 0 { [a, c] } else { [b, d] };
        Real::from_bits(if v == 0 { south } else { north })
    }

    /// The cell between four knots, by the column and row of the first.
    #[inline(always)]
    pub(crate) fn knot_cell(&self, i: u32, j: u32) -> Cell {
        let [u_0, v_0] = self.heights.origin();
        let at = |i: u32, j: u32| self.heights.bits(i, j);
        let from = |first: i16, k: u32| (i32::from(first) << 16).wrapping_add((k << 16) as i32);
        Cell {
            corners: [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)],
            u: from(u_0, i),
            v: from(v_0, j),
        }
    }

    /// The coordinates of a point of the lattice of a level, at most 16, by its column and row.
    pub fn point(&self, level: u32, column: u32, row: u32) -> [Coordinate; 2] {
        let [u_0, v_0] = self.heights.origin();
        let at = |first: i16, k: u32| {
            let from = i64::from(first) << 16;
            let along = i64::from(k) << (LEVELS - level.min(LEVELS));
            Coordinate::from_bits((from + along).min(i64::from(i32::MAX)) as i32)
        };
        [at(u_0, column), at(v_0, row)]
    }
}
