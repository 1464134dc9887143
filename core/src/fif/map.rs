//! One map of a function: `(u, y) -> (start + width u, scaling y + q(u))`, the shear and shrinking of the whole graph that makes one part of it.

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
