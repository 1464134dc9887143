//! The two largest parts of the Mandelbrot set, recognised by a formula, so that nobody iterates there.
//!
//! Nine tenths of the set lie in them, and each of their pixels would take all of its `Num` iterations.
//!
//! - main cardioid: `q (q + p) <= y^2 / 4` with `p = x - 1/4`, `q = p^2 + y^2`: the orbit tends to a fixed
//!   point;
//! - disc of period 2: `(x + 1)^2 + y^2 <= 1/16`: it tends to a cycle of two points.
//!
//! Source: B. Branner, "The Mandelbrot set", Proc. Symp. Appl. Math. 39, 1989: `|2 z| < 1` at the fixed point
//! `z = z^2 + c`, `|4 (c + 1)| < 1` at the cycle.
//!
//! Format: high words, 26 fractional bits, every rounding towards "not inside": a point of the outside is
//! never called inside (`nothing_outside_is_called_inside`), and a rim, `2^-20` wide except near the cusp at
//! 1/4 where it is wider, is left to the iteration (`the_rim_that_is_left_is_thin`).

use crate::escape::orbit::dwell::{FRACTION_Q29, Point29};
use crate::num::formats::Q26;
use crate::num::{high, product};

/// Kept free inside both borders: deeper inside, the orbit is drawn in faster than rounding drives it out
/// (`interior_and_cycles_change_no_pixel`, on the rims themselves).
const MARGIN: Q26 = 1 << 4;

/// Whether `c` lies in one of the two parts, apart from a thin rim.
#[inline(always)]
pub(crate) fn contains(c: Point29) -> bool {
    period(c).is_some()
}

/// The period of the part that `c` lies in, apart from a thin rim.
///
/// Domain: `|c| <= 2`. Cost: 6 multiplications.
#[inline(always)]
pub(crate) fn period((x, y): Point29) -> Option<u32> {
    let yy = product(y, y); // at most 2^60
    let yy_high = (yy >> 32) as i32;
    // p >= -9/4, p^2 + y^2 < 9.1 < 32: no word overflows. Both sums are low by less than 2 units before the
    // margin is added.
    let p = x - (1 << (FRACTION_Q29 - 2));
    let q = high(p, p) + yy_high + MARGIN;
    let q_plus_p = q + (p >> 3) + 1;
    // 52 fractional bits on both sides. If q + p is negative, so is the exact one, and the exact test holds
    // as well.
    if product(q, q_plus_p) <= yy >> 8 {
        return Some(1);
    }
    let r = x + (1 << FRACTION_Q29);
    (high(r, r) + yy_high + MARGIN <= 1 << 22).then_some(2)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    #[test]
    fn nothing_outside_is_called_inside() {
        let mut found = 0;
        for k in 0..20_000 {
            let t = f64::from(k) / 20_000.0 * core::f64::consts::TAU;
            let unit = |v: f64| (v * 2_f64.powi(29)) as i32;
            let cardioid = (t.cos() / 2.0 - (2.0 * t).cos() / 4.0, t.sin() / 2.0 - (2.0 * t).sin() / 4.0);
            let disc = (-1.0 + t.cos() / 4.0, t.sin() / 4.0);
            for (x, y) in [cardioid, disc] {
                for d in [-300, -100, -30, -3, -1, 0, 1, 3, 30, 100, 300] {
                    let (x, y) = (unit(x) + d, unit(y) + d / 2);
                    if contains((x, y)) {
                        found += 1;
                        // 29 fractional bits: exact in 128
                        let (x, y) = (i128::from(x), i128::from(y));
                        let p = x - (1 << 27);
                        let q = p * p + y * y;
                        let in_cardioid = 4 * q * (q + (p << 29)) <= (y * y) << 58;
                        let r = x + (1 << 29);
                        let in_disc = 16 * (r * r + y * y) <= 1 << 58;
                        assert!(in_cardioid || in_disc, "{x} {y}");
                    }
                }
            }
        }
        assert!(found > 10_000, "{found}");
    }

    #[test]
    fn the_rim_that_is_left_is_thin() {
        let unit = |v: f64| (v * 2_f64.powi(29)) as i32;
        let mut found = 0;
        for k in 0..20_000 {
            let t = f64::from(k) / 20_000.0 * core::f64::consts::TAU;
            let r = 0.25 - 2_f64.powi(-20);
            assert!(contains((unit(-1.0 + r * t.cos()), unit(r * t.sin()))), "{t}");
            // the multiplier of the fixed point; the border itself is at 1
            let m = 1.0 - 2_f64.powi(-19);
            if t.cos() < 0.5 {
                let re = m * t.cos() / 2.0 - m * m * (2.0 * t).cos() / 4.0;
                let im = m * t.sin() / 2.0 - m * m * (2.0 * t).sin() / 4.0;
                assert!(contains((unit(re), unit(im))), "{t}");
                found += 1;
            }
        }
        assert!(found > 13_000);
    }
}
