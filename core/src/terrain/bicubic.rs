//! Bicubic patches by their Bezier points: what Ferguson's patches and B-splines become.
//!
//! The patch lies in the hull of its 16 points: their least and greatest are rigorous bounds. So do its
//! derivatives in those of the points' differences, which tells how far it can bend.
//!
//! Source: G. Farin, "Curves and surfaces for CAGD", 1988, section 15 (derivatives: 15.6).
//!
//! Formats: heights 24 fractional bits, `s` and `t` 30.

use super::bilinear::{between_slopes, clamped};
use crate::num::formats::{Q24, Q30};
use crate::num::{product, product_u};

/// The points of a patch, row by row from south-west.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Bicubic {
    pub(crate) points: [[Q24; 4]; 4],
}

/// The four polynomials of Bernstein at `s`; they add up to 1.
#[inline(always)]
fn weights(s: Q30) -> [Q30; 4] {
    // of 31 fractional bits each: 30
    let times = |a: u32, b: u32| ((product_u(a, b) + (1 << 31)) >> 32) as u32;
    let (s, r) = ((s as u32) << 1, (1 << 31) - ((s as u32) << 1));
    let (ss, rr) = (2 * times(s, s), 2 * times(r, r));
    let [b, c, d] = [3 * times(rr, s), 3 * times(ss, r), times(ss, s)].map(|c| c as i32);
    [(1 << 30) - b - c - d, b, c, d]
}

/// The mean of four heights, to the nearest.
#[inline(always)]
fn mean(heights: [Q24; 4], weights: [Q30; 4]) -> Q24 {
    let ([a, b, c, d], [p, q, r, s]) = (heights, weights);
    let sum =
        product(a, p).wrapping_add(product(b, q)).wrapping_add(product(c, r)).wrapping_add(product(d, s));
    (sum.wrapping_add(1 << 29) >> 30) as i32
}

/// The value and three times the difference of the last two points, the derivative, of points within `2^31`.
fn cubic([a, b, c, d]: [i64; 4], s: Q30) -> [i64; 2] {
    let between = |a: i64, b: i64| a + (((b - a) * i64::from(s) + (1 << 29)) >> 30);
    let [ab, bc, cd] = [between(a, b), between(b, c), between(c, d)];
    let (first, last) = (between(ab, bc), between(bc, cd));
    [between(first, last), 3 * (last - first)]
}

/// The value alone of slopes, which are within `2^34`.
fn cubic_of_slopes([a, b, c, d]: [i64; 4], s: Q30) -> i64 {
    let [ab, bc, cd] = [between_slopes(a, b, s), between_slopes(b, c, s), between_slopes(c, d, s)];
    between_slopes(between_slopes(ab, bc, s), between_slopes(bc, cd, s), s)
}

impl Bicubic {
    pub(crate) fn height(&self, s: Q30, t: Q30) -> Q24 {
        let along = weights(s);
        mean(self.points.map(|row| mean(row, along)), weights(t))
    }

    /// `h_s` and `h_t`, clamped to the format.
    pub(crate) fn slopes(&self, s: Q30, t: Q30) -> [Q24; 2] {
        let rows = self.points.map(|row| cubic(row.map(i64::from), s));
        let [_, along_t] = cubic(rows.map(|[h, _]| h), t);
        let along_s = cubic_of_slopes(rows.map(|[_, slope]| slope), t);
        [along_s, along_t].map(clamped)
    }

    /// Bounds of the heights.
    #[inline(always)]
    pub(crate) fn range(&self) -> [Q24; 2] {
        self.points.iter().flatten().fold([i32::MAX, i32::MIN], |[low, high], h| [low.min(*h), high.max(*h)])
    }
}

/// The greatest second differences along rows, the greatest mixed ones, and those along columns.
#[inline(always)]
pub(crate) fn differences(points: &[[i32; 4]; 4]) -> [u32; 3] {
    let across = points.map(|[a, b, c, d]| [b.wrapping_sub(a), c.wrapping_sub(b), d.wrapping_sub(c)]);
    let (mut ss, mut st, mut tt) = (0, 0, 0);
    let greatest = |most: &mut u32, c: i32| *most = (*most).max(c.unsigned_abs());
    for [p, q, r] in across {
        greatest(&mut ss, q.wrapping_sub(p));
        greatest(&mut ss, r.wrapping_sub(q));
    }
    let [sw, w, nw, n] = across;
    for (below, above) in [(sw, w), (w, nw), (nw, n)] {
        for (a, b) in below.into_iter().zip(above) {
            greatest(&mut st, b.wrapping_sub(a));
        }
    }
    let [p, q, r, w] = *points;
    for (((a, b), c), d) in p.into_iter().zip(q).zip(r).zip(w) {
        greatest(&mut tt, a.wrapping_sub(b).wrapping_add(c.wrapping_sub(b)));
        greatest(&mut tt, b.wrapping_sub(c).wrapping_add(d.wrapping_sub(c)));
    }
    [ss, st, tt]
}
