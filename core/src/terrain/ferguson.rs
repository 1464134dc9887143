//! Ferguson's patches: Hermite bicubics with zero twist, figure 9.
//!
//! The slopes at a corner are half the differences of its two opposite neighbours (figure 11), at the rim the
//! whole difference of the only one. A patch with slopes `p`, `q` at a corner `h` has the Bezier points `h`,
//! `h + p / 3`, `h + q / 3`, `h + p / 3 + q / 3`: the twist is zero. Neighbours share slopes, so the surface
//! is `C1`.
//!
//! Source: J. C. Ferguson, "Multivariable curve interpolation", 1969; L. C. Carpenter, "Computer rendering of
//! fractal curves and surfaces", 1980, figures 9 and 11.

use super::bicubic::Bicubic;
use super::heights::Heights;
use crate::num::formats::Q24;

/// A third of the slope at `here`, between its neighbours.
#[inline(always)]
fn third_of_slope(before: Option<Q24>, here: Q24, behind: Option<Q24>) -> Q24 {
    // a sixth, 32 fractional bits, of a difference below 2^31 and twice as much at the rim
    const SIXTH: i64 = 715_827_883;
    let difference = match (before, behind) {
        (Some(a), Some(b)) => i64::from(b) - i64::from(a),
        (None, Some(b)) => 2 * (i64::from(b) - i64::from(here)),
        (Some(a), None) => 2 * (i64::from(here) - i64::from(a)),
        (None, None) => 0,
    };
    ((difference * SIXTH + (1 << 31)) >> 32) as i32
}

/// The patch of a cell of these heights.
pub(crate) fn ferguson(heights: &Heights<'_>, i: u32, j: u32) -> Bicubic {
    let at = |i: Option<u32>, j: Option<u32>| match (i, j) {
        (Some(i), Some(j)) if i < heights.columns() && j < heights.rows() => Some(heights.bits(i, j)),
        _ => None,
    };
    // height and thirds of the slopes at a corner
    let corner = |i: u32, j: u32| {
        let h = heights.bits(i, j);
        let p = third_of_slope(at(i.checked_sub(1), Some(j)), h, at(Some(i + 1), Some(j)));
        let q = third_of_slope(at(Some(i), j.checked_sub(1)), h, at(Some(i), Some(j + 1)));
        (h, p, q)
    };
    // the two points of a row or column at each end, going inwards
    let four = |(h, p): (Q24, Q24), (k, r): (Q24, Q24)| [h, h.saturating_add(p), k.saturating_sub(r), k];
    let (sw, se, nw, ne) = (corner(i, j), corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1));
    let inward = |(h, p, q): (Q24, Q24, Q24), sign: i32| (h.saturating_add(q.wrapping_mul(sign)), p);
    Bicubic {
        points: [
            four((sw.0, sw.1), (se.0, se.1)),
            four(inward(sw, 1), inward(se, 1)),
            four(inward(nw, -1), inward(ne, -1)),
            four((nw.0, nw.1), (ne.0, ne.1)),
        ],
    }
}
