//! A ray and the patch of a leaf: on which side it is, and where it changes sides.
//!
//! A crossing is where one side follows the other: a ray that comes from above and ends below has crossed
//! the surface, whatever rounding does at the edges of cells. So the surface is watertight, and no hill is
//! too thin.
//!
//! Formats: lengths and parameters 24 fractional bits, places in a cell 30.

use core::ops::ControlFlow;

use super::super::ray::Axis;
use super::plot::Rule;
use super::sides::{Above, sides};
use crate::num::formats::{Q24, Q30};
use crate::num::{product, product_u};
use crate::terrain::Form;

/// A square of `2^level` cells a side, by its column and row among those.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) level: u32,
    pub(super) column: u32,
    pub(super) row: u32,
}

/// The box and the cells of a terrain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    /// Columns and rows.
    pub(super) rules: [Rule; 2],
    /// Bounds of all heights.
    pub(super) heights: [Q24; 2],
    /// The level of the root.
    pub(super) depth: u32,
}

/// A change of sides: parameter, the leaf, and whether the ray is above from there on.
pub(super) type Change = (Q24, Place, bool);

impl Frame {
    /// From where to where a ray is inside the box.
    #[inline(always)]
    pub(super) fn clip(&self, [x, y, z]: &[Axis; 3]) -> (Q24, Q24) {
        let [columns, rows] = &self.rules;
        let (mut t, mut end) = (0, i32::MAX);
        for (axis, [low, high]) in [(z, self.heights), (y, rows.ends()), (x, columns.ends())] {
            let (near, far) = if axis.direction > 0 { (low, high) } else { (high, low) };
            end = end.min(axis.crossing(far));
            // what a ray begins inside of it has not to come to
            if (near.wrapping_sub(axis.origin) ^ axis.direction) >= 0 {
                t = t.max(axis.crossing(near));
            }
            if t >= end {
                break;
            }
        }
        (t, end)
    }
}

/// A ray above a patch, from where it comes over its cell to where it leaves it.
struct Chord<'a> {
    patch: &'a Form,
    from: [Q30; 2],
    to: [Q30; 2],
    heights: [Q24; 2],
}

impl Chord<'_> {
    /// How high above the patch it is.
    #[inline(never)]
    fn over(&self, part: Q30) -> Q24 {
        let along = |a: i32, b: i32| a.wrapping_add((product(b.wrapping_sub(a), part) >> 30) as i32);
        let ([s_0, t_0], [s_1, t_1], [z_0, z_1]) = (self.from, self.to, self.heights);
        along(z_0, z_1).saturating_sub(self.patch.height(along(s_0, s_1), along(t_0, t_1)))
    }

    /// An eighth of a bound of its second derivative `h_ss s'^2 + 2 h_st s' t' + h_tt t'^2`, for that of
    /// `max(|h_ss|, |h_tt|) + |h_st|`, which `s'^2 + t'^2` is to be multiplied by.
    #[inline(always)]
    fn bend(&self, eighth: u32) -> u32 {
        let ([s_0, t_0], [s_1, t_1]) = (self.from, self.to);
        let square = |a: Q30, b: Q30| (product_u(a.abs_diff(b), a.abs_diff(b)) >> 30) as u32;
        // 30 fractional bits, at most 2
        let way = square(s_0, s_1) + square(t_0, t_1) + 2;
        u32::try_from(product_u(way, eighth) >> 30).map_or(u32::MAX, |bend| bend.saturating_add(1))
    }
}

/// Where the ray changes sides inside a leaf, for an eighth of how much its patch bends.
#[inline(always)]
pub(super) fn cross_leaf(
    frame: &Frame,
    [x, y, z]: &[Axis; 3],
    place: Place,
    (t_in, t_out): (Q24, Q24),
    (patch, eighth): (&Form, u32),
    above: &mut Above,
    changed: &mut impl FnMut(Change) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let [columns, rows] = &frame.rules;
    let level = place.level;
    let (column, row) = (place.column << level, place.row << level);
    let inside = |t: Q24| [columns.inside(x.at(t), column, level), rows.inside(y.at(t), row, level)];
    let heights = [t_in, t_out].map(|t| z.at(t));
    let chord = Chord { patch, from: inside(t_in), to: inside(t_out), heights };
    sides(|part| chord.over(part), chord.bend(eighth), above, &mut |part, is_above| {
        let along = product(t_out.wrapping_sub(t_in), part) >> 30;
        changed((t_in.wrapping_add(along as i32), place, is_above))
    })
}
