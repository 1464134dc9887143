//! A piece of a ray in the coordinates of the cells: columns, rows and units of height.
//!
//! All three grow evenly with the ray's parameter: by a product's upper word.
//!
//! Formats: columns and rows 14 fractional bits, heights in units with as many; parameters 24.

use super::super::ray::Axis;
use super::plot::{Rule, shifted};
use crate::num::formats::{Q14, Q24};
use crate::num::high_rounded;

/// How a ray moves over the cells.
pub(super) struct Course {
    /// What a piece of it is shifted by so that the whole has 30 or 31 bits.
    places: u32,
    growth: [i32; 3],
}

impl Course {
    /// Between two parameters, inside the box of the cells; heights in this unit.
    #[inline(always)]
    pub(super) fn new(rules: &[Rule; 2], [x, y, z]: &[Axis; 3], unit: u32, [t, end]: [Q24; 2]) -> Self {
        // the end comes later
        let places = (end.wrapping_sub(t) as u32 | 1).leading_zeros().wrapping_sub(1) & 31;
        let (shift, [columns, rows]) = (32 - places as i32, rules);
        let across = |rule: &Rule, axis: &Axis| rule.columns_along(axis.direction, shift);
        let height = shifted(z.direction, 14 - unit as i32 - 28 + shift);
        Self { places, growth: [across(columns, x), across(rows, y), height] }
    }

    /// From a place to that which comes so much later.
    #[inline(always)]
    pub(super) fn after(&self, time: Q24, [a, b, c]: [Q14; 3]) -> [Q14; 3] {
        let time = time << self.places;
        let [p, q, r] = self.growth.map(|growth| high_rounded(growth, time));
        [a.wrapping_add(p), b.wrapping_add(q), c.wrapping_add(r)]
    }
}
