//! From a point of the plane to the stored point nearest to it, the start of an orbit in 32-bit words.
//!
//! A point beyond the disc `|c| <= 2` has none, as its dwell is 0; which it is, is decided on all bits, so
//! that rounding moves no pixel in or out.

use super::dwell::{FRACTION_Q29, Point29, is_beyond};
use crate::num::formats::{Q29, Q48, UQ26};
use crate::num::{Complex, Wide, high_of_square, mul_high_u};

/// How many fractional bits a coordinate loses when it becomes a stored one.
pub(crate) const NARROWED: u32 = Wide::FRAC_NBITS - FRACTION_Q29;

/// The nearest stored point, none beyond the disc `|c| <= 2`.
///
/// Whether `c` is beyond is decided exactly, on all 48 bits; a point of the disc stays in the disc.
/// Error: half a unit, `2^-30`, ties away from 0; at most one unit within `2^-24` of the circle
/// (`narrowing_decides_the_circle_on_all_bits_and_rounds_to_nearest`).
#[inline(always)]
pub(crate) fn narrow(c: Complex<Wide>) -> Option<Point29> {
    let (x, y) = (c.re.to_bits(), c.im.to_bits());
    // beyond 2 + 2^-16 (an immediate on Cortex-M); what is left fits
    let far = |v: i64| ((v >> 32) as i32).wrapping_add(2 << 16) as u32 > 4 << 16;
    if far(x) || far(y) {
        return None;
    }
    let nearest = |v: i64| ((v + (1 << (NARROWED - 1)) - i64::from(v < 0)) >> NARROWED) as i32;
    let word = (nearest(x), nearest(y));
    // Rounding moves |c|^2 by less than 2^-27, the high words lose less than 2^-25.
    let square = high_square(word.0) + high_square(word.1);
    if square < (1 << 28) - 4 {
        return Some(word);
    }
    if square > (1 << 28) + 4 { None } else { narrow_at_the_circle(x, y, word) }
}

#[inline(always)]
fn high_square(v: Q29) -> UQ26 {
    high_of_square(v) as u32
}

#[cold]
fn narrow_at_the_circle(x: Q48, y: Q48, word: Point29) -> Option<Point29> {
    // |v| < 2^49 + 2^33, times 2^13: below 2^63; the squares, 122 fractional bits, are added in two words
    let halves = |v: i64| {
        let v = v.unsigned_abs() << 13;
        (mul_high_u(v, v), v.wrapping_mul(v))
    };
    let ((x_high, x_low), (y_high, y_low)) = (halves(x), halves(y));
    let (low, carry) = x_low.overflowing_add(y_low);
    let high = x_high + y_high + u64::from(carry);
    // 4 with 122 - 64 fractional bits
    if high > 1 << 60 || (high == 1 << 60 && low > 0) {
        return None;
    }
    let towards_zero = |v: i64| {
        let magnitude = (v.unsigned_abs() >> NARROWED) as i32;
        if v < 0 { -magnitude } else { magnitude }
    };
    if is_beyond(word) { Some((towards_zero(x), towards_zero(y))) } else { Some(word) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn narrowing_decides_the_circle_on_all_bits_and_rounds_to_nearest() {
        let four = 4_i128 << 96;
        let (mut inside, mut outside) = (0, 0);
        let mut check = |x: i64, y: i64| {
            let c = Complex::new(Wide::from_bits(x), Wide::from_bits(y));
            let square = i128::from(x) * i128::from(x) + i128::from(y) * i128::from(y);
            match narrow(c) {
                None => {
                    outside += 1;
                    assert!(square > four, "{c:?}");
                }
                Some(word) => {
                    inside += 1;
                    assert!(square <= four && !is_beyond(word), "{c:?}");
                    let limit = if square > four - (1 << 74) { 1 << 19 } else { 1 << 18 };
                    for (v, w) in [(x, word.0), (y, word.1)] {
                        assert!((v - (i64::from(w) << 19)).abs() <= limit, "{c:?} {word:?}");
                    }
                    let mirrored = Complex::new(-c.re, -c.im);
                    assert_eq!(narrow(mirrored), Some((-word.0, -word.1)));
                }
            }
        };
        const TWO: i64 = 2 << 48;
        for k in 0..2000 {
            let (sin, cos) = (f64::from(k) / 2000.0 * core::f64::consts::TAU).sin_cos();
            let (x, y) = ((cos * TWO as f64) as i64, (sin * TWO as f64) as i64);
            for d in
                [0, 1, 1 << 10, 1 << 17, 1 << 18, (1 << 18) + 1, 1 << 20, 1 << 22, 1 << 24, 1 << 33, 1 << 45]
            {
                for (a, b) in [(d, 0), (-d, 0), (0, d), (0, -d), (d, d), (-d, -d), (-d, d)] {
                    check(x + a, y + b);
                }
            }
        }
        for v in [0, 1, -1, 1 << 18, -(1 << 18), (1 << 18) - 1, TWO / 3] {
            check(v, v);
        }
        for v in [TWO, TWO + 1, -TWO, -TWO - 1, i64::MAX, i64::MIN + 1, 1 << 62] {
            if v.abs() < 1 << 60 {
                check(v, 0);
            } else {
                assert_eq!(narrow(Complex::new(Wide::ZERO, Wide::from_bits(v))), None);
            }
        }
        assert!(inside > 1000 && outside > 1000);
    }
}
