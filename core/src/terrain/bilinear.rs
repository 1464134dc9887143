//! Bilinear patches: the simplest inner geometry, figure 8.
//!
//! `h(s, t) = (1 - t) ((1 - s) a + s b) + t ((1 - s) c + s d)` between the heights `a`, `b` and, north of
//! them, `c`, `d`.
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

/// The same for any two numbers: slopes may be as far apart as all of the format is wide, and twice as far
/// before they are clamped to it.
pub(super) fn between_slopes(a: i64, b: i64, s: Q30) -> i64 {
    // below 2^41: in two parts, so that the product fits the word
    let (difference, s) = (b.wrapping_sub(a), i64::from(s));
    let low = (difference & 255).wrapping_mul(s).wrapping_add(1 << 29) >> 8;
    a.wrapping_add((difference >> 8).wrapping_mul(s).wrapping_add(low) >> 22)
}

/// The nearest number of the format.
pub(super) fn clamped(v: i64) -> Q24 {
    v.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

impl Bilinear {
    /// The patch of a cell of these heights.
    #[inline(always)]
    pub(crate) fn new(heights: &Heights<'_>, i: u32, j: u32) -> Self {
        let at = |i, j| heights.bits(i, j);
        Self { corners: [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)] }
    }

    #[inline(always)]
    pub(crate) fn height(&self, s: Q30, t: Q30) -> Q24 {
        let [a, b, c, d] = self.corners;
        between(between(a, b, s), between(c, d, s), t)
    }

    /// `h_s` and `h_t`.
    pub(crate) fn slopes(&self, s: Q30, t: Q30) -> [Q24; 2] {
        let [a, b, c, d] = self.corners.map(i64::from);
        let (along_s, along_t) = (between_slopes(b - a, d - c, t), between_slopes(c - a, d - b, s));
        [clamped(along_s), clamped(along_t)]
    }

    /// The least and the greatest height.
    #[inline(always)]
    pub(crate) fn range(&self) -> [Q24; 2] {
        let [a, b, c, d] = self.corners;
        [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]
    }

    /// `|h_st|`, 16 fractional bits, rounded up: what a patch bends by, as `h_ss` and `h_tt` are 0.
    #[inline(always)]
    pub(crate) fn twist(&self) -> u32 {
        let [a, b, c, d] = self.corners;
        // of heights within 64 at most 2^32, one bit more than a word of this format has
        let twist = (i64::from(b) - i64::from(a)) + (i64::from(c) - i64::from(d));
        (twist.unsigned_abs() >> 8) as u32 + 1
    }
}
