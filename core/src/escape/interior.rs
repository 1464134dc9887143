//! Two parts of the Mandelbrot set that a formula recognises, so that nobody iterates there.
//!
//! - main cardioid: `q (q + p) <= y^2 / 4` with `p = x - 1/4`, `q = p^2 + y^2`: the orbit tends to a fixed point;
//! - disc of period 2: `(x + 1)^2 + y^2 <= 1/16`: it tends to a cycle of two points.
//!
//! Source: B. Branner, "The Mandelbrot set", Proc. Symp. Appl. Math. 39, 1989: `|2 z| < 1` at the fixed point `z = z^2 + c`, `|4 (c + 1)| < 1`
//! at the cycle. Format: high words, 26 fractional bits, every rounding towards "not inside": a point of the outside is never
//! called inside, and what lies within about `2^-22` of the border is left to the iteration.

use super::dwell::{FRACTION, Word, high};

/// Kept free inside both borders, in units of `2^-26`: the orbit of a point deeper inside is drawn in faster than rounding drives it out.
const MARGIN: i32 = 1 << 4;

/// Whether `c` lies in one of the two parts, apart from a thin rim.
///
/// Domain: `|c| <= 2`. Cost: 6 multiplications.
#[inline(always)]
pub(super) fn contains((x, y): Word) -> bool {
    let yy = i64::from(y) * i64::from(y); // at most 2^60
    let yy_high = (yy >> 32) as i32;
    // p >= -9/4, p^2 + y^2 < 9.1 < 32: no word overflows. Both sums are low by less than 2 units before the margin is added.
    let p = x - (1 << (FRACTION - 2));
    let q = high(p, p) + yy_high + MARGIN;
    let q_plus_p = q + (p >> 3) + 1;
    // 52 fractional bits on both sides. If q + p is negative, so is the exact one, and the exact test holds as well.
    if i64::from(q) * i64::from(q_plus_p) <= yy >> 8 {
        return true;
    }
    let r = x + (1 << FRACTION);
    high(r, r) + yy_high + MARGIN <= 1 << 22
}
