//! Bicubic patches by their Bezier points: what Ferguson's patches and B-splines become.
//!
//! The patch lies in the hull of its 16 points: their least and greatest are rigorous bounds. Along a straight
//! line over it the height is a polynomial of degree 6. Its Bernstein coefficients follow from the points of
//! the part between the ends of the line (blossoms) along that part's diagonal:
//! `c_m = sum over i + j = m of C(3, i) C(3, j) / C(6, m) b_ij`.
//!
//! Source: G. Farin, "Curves and surfaces for CAGD", 1988, sections 4.4 (blossoms) and 15; J. M. Lane et al.,
//! "Scan line methods for displaying parametrically defined surfaces", 1980.
//!
//! Formats: heights 24 fractional bits, `s` and `t` 30.

use super::bilinear::between;
use crate::num::formats::{Q24, Q30};

/// The points of a patch, row by row from south-west.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Bicubic {
    pub(crate) points: [[Q24; 4]; 4],
}

/// The four points of the part of a cubic from `s` to `t`.
#[inline(always)]
fn part([a, b, c, d]: [Q24; 4], s: Q30, t: Q30) -> [Q24; 4] {
    let [ab, bc, cd] = [between(a, b, s), between(b, c, s), between(c, d, s)];
    let [ab_t, bc_t, cd_t] = [between(a, b, t), between(b, c, t), between(c, d, t)];
    let (ss_0, ss_1) = (between(ab, bc, s), between(bc, cd, s));
    let (st_0, st_1) = (between(ab, bc, t), between(bc, cd, t));
    let (tt_0, tt_1) = (between(ab_t, bc_t, t), between(bc_t, cd_t, t));
    [between(ss_0, ss_1, s), between(ss_0, ss_1, t), between(st_0, st_1, t), between(tt_0, tt_1, t)]
}

/// The value and three times the difference of the last two points: the derivative.
fn cubic([a, b, c, d]: [Q24; 4], s: Q30) -> [Q24; 2] {
    let [ab, bc, cd] = [between(a, b, s), between(b, c, s), between(c, d, s)];
    let (first, last) = (between(ab, bc, s), between(bc, cd, s));
    [between(first, last, s), last.wrapping_sub(first).saturating_mul(3)]
}

impl Bicubic {
    /// Height, `h_s` and `h_t`.
    fn all(&self, s: Q30, t: Q30) -> [Q24; 3] {
        let rows = self.points.map(|row| cubic(row, s));
        let [h, along_t] = cubic(rows.map(|[h, _]| h), t);
        let [along_s, _] = cubic(rows.map(|[_, slope]| slope), t);
        [h, along_s, along_t]
    }

    pub(crate) fn height(&self, s: Q30, t: Q30) -> Q24 {
        let [h, ..] = self.all(s, t);
        h
    }

    /// `h_s` and `h_t`.
    pub(crate) fn slopes(&self, s: Q30, t: Q30) -> [Q24; 2] {
        let [_, along_s, along_t] = self.all(s, t);
        [along_s, along_t]
    }

    /// Bounds of the heights.
    #[inline(always)]
    pub(crate) fn range(&self) -> [Q24; 2] {
        self.points.iter().flatten().fold([i32::MAX, i32::MIN], |[low, high], h| [low.min(*h), high.max(*h)])
    }

    /// The heights along the line from `(s_0, t_0)` to `(s_1, t_1)`: Bernstein coefficients.
    #[inline(always)]
    pub(crate) fn chord(&self, [s_0, t_0]: [Q30; 2], [s_1, t_1]: [Q30; 2]) -> [Q24; 7] {
        let [p, q, r, w] = self.points.map(|row| part(row, s_0, s_1));
        let columns = [0, 1, 2, 3].map(|k: usize| [p[k & 3], q[k & 3], r[k & 3], w[k & 3]]);
        // b[i][j]: i along s, j along t
        let b = columns.map(|column| part(column, t_0, t_1));
        let wide = |i: usize, j: usize| i64::from(b[i & 3][j & 3]);
        // sums of at most 20 heights; a fifth and a tenth by multiplication: 0.2 2^32
        let rounded = |sum: i64, weight: i64| ((sum * weight + (1 << 31)) >> 32) as i32;
        let (half, fifth, twentieth) = (1_i64 << 31, 858_993_459, 214_748_365);
        [
            b[0][0],
            rounded(wide(0, 1) + wide(1, 0), half),
            rounded(wide(0, 2) + wide(2, 0) + 3 * wide(1, 1), fifth),
            rounded(wide(0, 3) + wide(3, 0) + 9 * (wide(1, 2) + wide(2, 1)), twentieth),
            rounded(wide(1, 3) + wide(3, 1) + 3 * wide(2, 2), fifth),
            rounded(wide(2, 3) + wide(3, 2), half),
            b[3][3],
        ]
    }
}
