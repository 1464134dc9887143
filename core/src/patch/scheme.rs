//! What refines the control heights of a cell: the seam between surfaces by control points and what shows
//! them.
//!
//! A cell is a surface `z = P phi(s, t)` over its square. It has `N x N` parts, which are cells again: that
//! of the digits `(i, j)` has the control heights `P T_ij`. All that a ray needs to know follows from them:
//! rigorous bounds, heights of the corners, the mean normal.
//!
//! Heights have 24 fractional bits; those of a cell are within what [`Contraction`] allows.

use super::contraction::Contraction;
use crate::num::formats::Q24;

/// A way to refine `J` control heights.
pub trait Scheme<const J: usize> {
    /// `N`: a cell has as many parts along each parameter.
    const BASE: u32;
    /// Control heights of a cell along `s` and `t`: `J` in all.
    const SIDES: [usize; 2];
    /// How many control heights the next cell is away.
    const STEPS: [usize; 2];

    /// The proof that refining tends to a surface.
    fn contraction(&self) -> &Contraction;

    /// The control heights of a part, 24 fractional bits.
    fn part(&self, heights: &[Q24; J], digits: [u32; 2]) -> [Q24; J];

    /// The height at a corner of the cell: at the end or at the beginning of `s` and of `t`.
    fn corner(&self, heights: &[Q24; J], at_end: [bool; 2]) -> Q24;

    /// The height at `index / N^levels` of both parameters.
    fn at(&self, heights: &[Q24; J], index: [u32; 2], levels: u32) -> Q24;

    /// The mean of the heights of the corners.
    #[inline]
    fn middle(&self, heights: &[Q24; J]) -> Q24 {
        let sum: i64 = CORNERS.iter().map(|corner| i64::from(self.corner(heights, *corner))).sum();
        (sum >> 2) as i32
    }

    /// Rigorous bounds of all heights of a cell.
    #[inline]
    fn bounds(&self, heights: &[Q24; J]) -> [Q24; 2] {
        let (mut least, mut most) = (i32::MAX, i32::MIN);
        for height in heights {
            (least, most) = (least.min(*height), most.max(*height));
        }
        let middle = self.middle(heights);
        let width = self.contraction().half_width(most.wrapping_sub(least).cast_unsigned());
        // parts are rounded: a unit a level, which the proof's levels halve and halve again
        let width = i32::try_from(width).unwrap_or(i32::MAX).saturating_add(ROUNDING);
        [middle.saturating_sub(width), middle.saturating_add(width)]
    }
}

/// The corners of a cell: whether at the end of `s` and of `t`.
pub(crate) const CORNERS: [[bool; 2]; 4] = [[false, false], [false, true], [true, false], [true, true]];

/// What rounding adds to bounds: control heights of a part are off by half a unit, which later maps make 8
/// times as much at most, in up to 31 levels.
const ROUNDING: Q24 = 128;
