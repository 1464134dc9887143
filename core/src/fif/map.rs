//! One map of a function: `(u, y) -> (start + width u, scaling y + q(u))`, the shear and shrinking of the
//! whole graph that makes one part of it.

use super::polynomial::Polynomial;
use crate::num::Reciprocal;

/// One map in the unit abscissa: `f(start + width u) = scaling f(u) + q(u)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Map<const D: usize> {
    /// 63 fractional bits.
    pub(crate) scaling: i64,
    pub(crate) q: Polynomial<D>,
    /// 63 fractional bits.
    pub(crate) start: u64,
    /// 63 fractional bits.
    pub(crate) width: u64,
    pub(crate) per_width: Reciprocal,
}

/// The last map that starts at or before `u`, by a search that begins with `step` ([`first_step`]).
#[inline(always)]
pub(super) fn map_at<const D: usize>(maps: &[Map<D>], mut step: usize, u: u64) -> Option<&Map<D>> {
    let mut found = maps.first()?;
    let mut index = 0;
    while step > 0 {
        if let Some(map) = maps.get(index + step)
            && map.start <= u
        {
            (found, index) = (map, index + step);
        }
        step /= 2;
    }
    Some(found)
}

/// The first step of a search among at most `count` maps. One comparison for two maps.
pub(super) const fn first_step(count: usize) -> usize {
    count.next_power_of_two() / 2
}
