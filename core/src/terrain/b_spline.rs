//! The uniform bicubic B-spline whose vertices are the heights, patch by patch in Bezier form, figure 10.
//!
//! Along each axis `b_0 = (v_0 + 4 v_1 + v_2) / 6`, `b_1 = (2 v_1 + v_2) / 3`, `b_2 = (v_1 + 2 v_2) / 3`,
//! `b_3 = (v_1 + 4 v_2 + v_3) / 6`. What two patches share follows from the same vertices by the same sums, so
//! that it is the same bit for bit; up to rounding the surface is `C2`. Beyond the rim a vertex is the mirror
//! image of its inner neighbour, `v_-1 = 2 v_0 - v_1`: at its corners the surface passes through the heights.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, figure 10; G. Farin,
//! "Curves and surfaces for CAGD", 1988, section 7.4.

use super::bicubic::Bicubic;
use super::heights::Heights;
use crate::num::formats::Q24;

/// Four vertices, of which the first and the last may be beyond the rim, as Bezier points.
#[inline(always)]
fn four([a, b, c, d]: [Option<Q24>; 4]) -> [Q24; 4] {
    // a sixth, 32 fractional bits; sums of six heights are below 2^33
    const SIXTH: i64 = 715_827_883;
    let sixth = |sum: i64| ((sum * SIXTH + (1 << 31)) >> 32) as i32;
    let [b, c] = [b, c].map(|h| i64::from(h.unwrap_or(0)));
    let sum = |before: Option<Q24>, here: i64, behind: i64| match before {
        Some(a) => sixth(i64::from(a) + 4 * here + behind),
        None => here as i32,
    };
    [sum(a, b, c), sixth(4 * b + 2 * c), sixth(2 * b + 4 * c), sum(d, c, b)]
}

/// The patch of a cell of these heights.
pub(crate) fn b_spline(heights: &Heights<'_>, i: u32, j: u32) -> Bicubic {
    let around =
        |k: u32, count: u32| [k.checked_sub(1), Some(k), Some(k + 1), Some(k + 2).filter(|k| *k < count)];
    let columns = around(i, heights.columns());
    let rows = around(j, heights.rows())
        .map(|row| row.map(|row| four(columns.map(|column| column.map(|column| heights.bits(column, row))))));
    let column = |k: usize| four(rows.map(|row| row.and_then(|row| row.get(k).copied())));
    let [p, q, r, w] = [column(0), column(1), column(2), column(3)];
    Bicubic { points: [0, 1, 2, 3].map(|k: usize| [p[k & 3], q[k & 3], r[k & 3], w[k & 3]]) }
}
