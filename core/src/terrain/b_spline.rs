//! The uniform bicubic B-spline whose vertices are the heights, patch by patch in Bezier form, figure 10.
//!
//! Along each axis `b_0 = (v_0 + 4 v_1 + v_2) / 6`, `b_1 = (2 v_1 + v_2) / 3`, `b_2 = (v_1 + 2 v_2) / 3`,
//! `b_3 = (v_1 + 4 v_2 + v_3) / 6`. What two patches share follows from the same vertices by the same sums,
//! so that it is the same bit for bit; up to rounding the surface is `C2`. Beyond the rim a vertex is the
//! mirror image of its inner neighbour, `v_-1 = 2 v_0 - v_1`: at its corners the surface passes through the
//! heights.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, figure 10; G. Farin,
//! "Curves and surfaces for CAGD", 1988, section 7.4.

use super::bicubic::Bicubic;
use super::heights::Heights;
use crate::num::formats::{Q24, Q30};
use crate::num::{high_u, product};

/// Thirds, 31 fractional bits, and a sixth: each sum of weights is 1.
const THIRDS: [i32; 2] = [715_827_882, 1_431_655_766];
const SIXTH: i32 = 357_913_941;

/// Four vertices as Bezier points; the first and the last may be missing beyond the rim.
#[inline(always)]
fn four([a, b, c, d]: [Q24; 4], [is_first, is_last]: [bool; 2]) -> [Q24; 4] {
    let rounded = |sum: i64| (sum.wrapping_add(1 << 30) >> 31) as i32;
    let [one, two] = THIRDS;
    let end = |a: Q24, b: Q24, c: Q24| {
        rounded(product(a, SIXTH).wrapping_add(product(b, two)).wrapping_add(product(c, SIXTH)))
    };
    let inner = |b: Q24, c: Q24| rounded(product(b, two).wrapping_add(product(c, one)));
    [
        if is_first { b } else { end(a, b, c) },
        inner(b, c),
        inner(c, b),
        if is_last { c } else { end(b, c, d) },
    ]
}

/// A patch by its vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct BSpline {
    /// Those of the cell and round it, row by row from south-west; any beyond the rim. Twice as high: 25
    /// fractional bits.
    vertices: [[i32; 4]; 4],
    /// Whether it is the first or the last along `u` and along `v`.
    rims: [[bool; 2]; 2],
}

/// The weights of four vertices at `s`, 31 fractional bits. They add up to 1, and at 1 they are those at 0 of
/// the patch that follows.
#[inline(always)]
fn weights(s: Q30, [is_first, is_last]: [bool; 2]) -> [i32; 4] {
    const ONE: u32 = 1 << 31;
    // 32 fractional bits
    const SIXTHS: [u32; 2] = [715_827_884, 715_827_882];
    let (s, r) = ((s as u32) << 1, ONE - ((s as u32) << 1));
    let squared = |c: u32| 2 * high_u(c, c);
    let (ss, rr) = (squared(s), squared(r));
    let a = high_u(2 * high_u(rr, r), SIXTHS[0]);
    let d = high_u(2 * high_u(ss, s), SIXTHS[1]);
    // (1 + 3 s + 3 s^2 - 3 s^3) / 6
    let c = (SIXTHS[1] >> 1) + high_u(s, ONE + (s - ss));
    let b = ONE - a - c - d;
    if !(is_first || is_last) {
        return [a, b, c, d].map(|c| c as i32);
    }
    // beyond the rim a vertex is the mirror image of its inner neighbour
    let (b, a_in_c) = if is_first { (b + 2 * a, a) } else { (b, 0) };
    let (c, d_in_b) = if is_last { (c + 2 * d, d) } else { (c, 0) };
    let a = if is_first { 0 } else { a };
    let d = if is_last { 0 } else { d };
    let inner = |weight: u32, less: u32| weight.wrapping_sub(less) as i32;
    [a as i32, inner(b.min(ONE - 1), d_in_b), inner(c.min(ONE - 1), a_in_c), d as i32]
}

/// The weights of four vertices in the slope at `s`, 31 fractional bits: those of the three steps between
/// them, which add up to 1, as differences.
#[inline(always)]
fn slope_weights(s: Q30, [is_first, is_last]: [bool; 2]) -> [i32; 4] {
    const ONE: u32 = 1 << 31;
    let (s, r) = ((s as u32) << 1, ONE - ((s as u32) << 1));
    let (a, c) = (high_u(r, r), high_u(s, s));
    // beyond the rim a step is as the one before it
    let (a, c) = (if is_first { 0 } else { a }, if is_last { 0 } else { c });
    let [a, b, c] = [a, (ONE - a - c).min(ONE - 1), c].map(|step| step as i32);
    [-a, a - b, b - c, c]
}

/// The sum of four heights with 25 fractional bits by such weights, to the nearest: a mean or a slope.
#[inline(always)]
fn sum([a, b, c, d]: &[i32; 4], [p, q, r, w]: [i32; 4]) -> Q24 {
    let two = (1_i64 << 31).wrapping_add(product(*a, p)).wrapping_add(product(*b, q));
    (two.wrapping_add(product(*c, r)).wrapping_add(product(*d, w)) >> 32) as i32
}

impl BSpline {
    /// The patch of a cell of these heights.
    #[inline(always)]
    pub(crate) fn new(heights: &Heights<'_>, i: u32, j: u32) -> Self {
        let ends = |k: u32, count: u32| [k == 0, k + 2 >= count];
        let rims = [ends(i, heights.columns()), ends(j, heights.rows())];
        Self { vertices: heights.around(i, j, |h| h << 1), rims }
    }

    pub(crate) fn height(&self, s: Q30, t: Q30) -> Q24 {
        let [along_u, along_v] = self.rims;
        let (along, across) = (weights(s, along_u), weights(t, along_v));
        let [a, b, c, d] = &self.vertices;
        sum(&[a, b, c, d].map(|row| sum(row, along) << 1), across)
    }

    /// `h_s` and `h_t`.
    pub(crate) fn slopes(&self, s: Q30, t: Q30) -> [Q24; 2] {
        let [along_u, along_v] = self.rims;
        let (w_s, w_t) = (weights(s, along_u), weights(t, along_v));
        let (q_s, q_t) = (slope_weights(s, along_u), slope_weights(t, along_v));
        let [a, b, c, d] = &self.vertices;
        let along_s = [a, b, c, d].map(|row| sum(row, q_s));
        let across = [a, b, c, d].map(|row| sum(row, w_s) << 1);
        // slopes can be twice as great as heights
        let total = along_s.into_iter().zip(w_t).map(|(h, w)| product(h, w)).sum::<i64>();
        [(total.wrapping_add(1 << 30) >> 31) as i32, sum(&across, q_t)]
    }

    /// Bounds of the heights: those of its Bezier points, and what rounding adds.
    pub(crate) fn range(&self) -> [Q24; 2] {
        let [low, high] = self.bezier().range();
        [low.saturating_sub(4), high.saturating_add(4)]
    }

    /// Its Bezier points.
    pub(crate) fn bezier(&self) -> Bicubic {
        let [along_u, along_v] = self.rims;
        let [p, q, r, w] = self.vertices.map(|row| four(row.map(|h| h >> 1), along_u));
        let column = |k: usize| four([p[k & 3], q[k & 3], r[k & 3], w[k & 3]], along_v);
        let [p, q, r, w] = [column(0), column(1), column(2), column(3)];
        Bicubic { points: [0, 1, 2, 3].map(|k: usize| [p[k & 3], q[k & 3], r[k & 3], w[k & 3]]) }
    }
}
