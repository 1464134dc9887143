//! Bilinear patches: the simplest inner geometry, figure 8.
//!
//! `h(s, t) = (1 - t) ((1 - s) a + s b) + t ((1 - s) c + s d)` between the heights `a`, `b` and, north of
//! them, `c`, `d`. Along a straight line over the patch the height is a polynomial of degree 2, given here by
//! its Bernstein coefficients: where these lie, the patch lies between.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, figure 8.
//!
//! Formats: heights 24 fractional bits, `s` and `t` 30.

use super::heights::Heights;
use crate::num::formats::{Q24, Q30};
use crate::num::product;

/// A patch between four heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Bilinear {
    /// South-west, south-east, north-west, north-east.
    pub(crate) corners: [Q24; 4],
}

/// `a + (b - a) s`, to the nearest, for numbers whose difference has the format.
#[inline(always)]
pub(super) fn between(a: Q24, b: Q24, s: Q30) -> Q24 {
    a.wrapping_add((product(b.wrapping_sub(a), s).wrapping_add(1 << 29) >> 30) as i32)
}

impl Bilinear {
    /// The patch of a cell of these heights.
    #[inline(always)]
    pub(crate) fn new(heights: &Heights<'_>, i: u32, j: u32) -> Self {
        let at = |i, j| heights.bits(i, j);
        Self { corners: [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)] }
    }

    pub(crate) fn height(&self, s: Q30, t: Q30) -> Q24 {
        let [a, b, c, d] = self.corners;
        between(between(a, b, s), between(c, d, s), t)
    }

    /// `h_s` and `h_t`.
    pub(crate) fn slopes(&self, s: Q30, t: Q30) -> [Q24; 2] {
        let [a, b, c, d] = self.corners;
        [between(b.wrapping_sub(a), d.wrapping_sub(c), t), between(c.wrapping_sub(a), d.wrapping_sub(b), s)]
    }

    /// The least and the greatest height.
    #[inline(always)]
    pub(crate) fn range(&self) -> [Q24; 2] {
        let [a, b, c, d] = self.corners;
        [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]
    }

    /// The heights along the line from `(s_0, t_0)` to `(s_1, t_1)`: Bernstein coefficients.
    #[inline(always)]
    pub(crate) fn chord(&self, [s_0, t_0]: [Q30; 2], [s_1, t_1]: [Q30; 2]) -> [Q24; 3] {
        let [a, b, c, d] = self.corners;
        let (south, north) = (between(a, b, s_0), between(c, d, s_0));
        let (south_1, north_1) = (between(a, b, s_1), between(c, d, s_1));
        let crossed = [between(south, north, t_1), between(south_1, north_1, t_0)];
        let middle = (i64::from(crossed[0]) + i64::from(crossed[1])) >> 1;
        [between(south, north, t_0), middle as i32, between(south_1, north_1, t_1)]
    }
}
