//! Extrapolation: one more row of knots beyond a side, such that the rim becomes a row of midpoints.
//!
//! "One determines the location of a new far endpoint such that the current far endpoint is a valid midpoint
//! of the extended curve": along each line of knots across the side the new height is
//! `2 (h_m - o_-1 R) - h`, `h_m` that of the rim, `h` that of its inner neighbour, `R` the number of the
//! rim's knot and `o_-1 = o 2^H` the offset of the level above the first. A grid with the new knots has the
//! old surface as a part, bit for bit.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, figure 12.

use super::heights::out_of_range;
use super::plane_to_line::PlaneToLine;
use super::random::Randomness;
use crate::Error;
use crate::num::{Coordinate, Real, Wide, product};

/// A side of a grid of knots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Side {
    /// Where `u` is least.
    West,
    /// Where `u` is greatest.
    East,
    /// Where `v` is least.
    South,
    /// Where `v` is greatest.
    North,
}

impl<R: Randomness> PlaneToLine<'_, R> {
    /// Writes the heights of a row of knots beyond a side: as many as that side has, from west to east or
    /// from south to north.
    ///
    /// Error: half a unit and that of the offset above, together below 2 units
    /// (`an_extrapolated_rim_is_a_row_of_midpoints`).
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for room for more heights or fewer, [`Error::OutOfRange`] for a height
    /// outside ±64.
    pub fn extrapolated(&self, side: Side, heights: &mut [Real]) -> Result<(), Error> {
        let knots = self.heights();
        let (columns, rows) = (knots.columns(), knots.rows());
        let along_v = matches!(side, Side::West | Side::East);
        let expected = if along_v { rows } else { columns } as usize;
        if heights.len() != expected {
            return Err(Error::LengthMismatch {
                what: "extrapolated heights",
                given: heights.len(),
                expected,
            });
        }
        let above = self.law().above();
        for (k, height) in (0..).zip(heights.iter_mut()) {
            let (rim, inner) = match side {
                Side::West => ([0, k], [1, k]),
                Side::East => ([columns - 1, k], [columns - 2, k]),
                Side::South => ([k, 0], [k, 1]),
                Side::North => ([k, rows - 1], [k, rows - 2]),
            };
            let bits = |[i, j]: [u32; 2]| i64::from(knots.bits(i, j));
            let [u, v]: [Coordinate; 2] = self.point(0, rim[0], rim[1]);
            let [along_u, across] = self.random().at(u, v);
            let r = if along_v { along_u } else { across };
            let displacement = (product(above, r.to_bits()) + (1 << 30)) >> 31;
            let far = 2 * bits(rim) - bits(inner) - displacement;
            match i32::try_from(far).ok().filter(|far| far.unsigned_abs() < 64 << 24) {
                Some(far) => *height = Real::from_bits(far),
                None => {
                    let value = Wide::from_bits(far << 24);
                    return Err(out_of_range("extrapolated height", Some(k as usize), value));
                }
            }
        }
        Ok(())
    }
}
