//! Sine and cosine of an angle in turns: headings of turtles, cameras, corners of triangles.
//!
//! The nearest quarter of a turn decides which of the two is which and their signs. What is left is at most
//! an eighth of a turn, where the power series of both, `x - x^3 / 3! + ..` to `x^9` and `1 - x^2 / 2! + ..`
//! to `x^10`, are summed by Horner's scheme.

use super::formats::Q31;
use super::formats::Unit;
use super::product::product;

/// An angle in turns: the whole range of the number is one turn, so that it wraps as angles do.
pub type Angle = fixed::types::U0F32;

/// Sine and cosine. Error: below `2^-28` (`sine_and_cosine_are_within_two_to_the_minus_28`). Cost: 11
/// multiplications.
///
/// ```
/// use attractor::num::{Angle, Unit, sin_cos};
/// let (sin, cos) = sin_cos(Angle::from_num(0.25));
/// assert!(sin.abs_diff(Unit::ONE) < Unit::from_num(4e-9).unsigned_abs() && cos.abs() < 4e-9);
/// ```
pub fn sin_cos(angle: Angle) -> (Unit, Unit) {
    // nearest quarter, and the rest in [-1/8, 1/8) turns
    let quarter = angle.to_bits().wrapping_add(1 << 29) >> 30;
    let rest = angle.to_bits().wrapping_sub(quarter << 30) as i32;
    // radians: rest / 2^32 turns of 2 pi, which is 8 times PI_4
    const PI_4: Q31 = 0x6487_ed51; // pi / 4
    let x: Q31 = (product(rest, PI_4) >> 29) as i32; // |x| <= pi / 4
    let square = product_q31(x, x);
    let sine = {
        let mut s = RECIPROCALS[9];
        for k in [7, 5, 3] {
            s = RECIPROCALS[k] - product_q31(square, s);
        }
        x - product_q31(product_q31(square, s), x)
    };
    let cosine = {
        let mut c = RECIPROCALS[10];
        for k in [8, 6, 4, 2] {
            c = RECIPROCALS[k] - product_q31(square, c);
        }
        i32::MAX - product_q31(square, c)
    };
    let (s, c) = ((sine + 1) >> 1, (cosine >> 1) + 1);
    let (s, c) = match quarter & 3 {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    };
    (Unit::from_bits(s), Unit::from_bits(c))
}

/// The product, rounded to nearest.
#[inline]
fn product_q31(a: Q31, b: Q31) -> Q31 {
    ((product(a, b) + (1 << 30)) >> 31) as i32
}

/// `1/k!`. The ones for 0 and 1 do not fit and are not used.
const RECIPROCALS: [Q31; 11] = {
    let mut table = [0; 11];
    let mut factorial = 1_i64;
    let mut k = 2;
    while k < 11 {
        factorial *= k as i64;
        table[k] = (((1_i64 << 31) + factorial / 2) / factorial) as i32;
        k += 1;
    }
    table
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_are_within_two_to_the_minus_28() {
        let mut worst: f64 = 0.0;
        // the last one is the worst of all
        for bits in (0..200_000_u32).map(|i| i.wrapping_mul(21_475).wrapping_add(i >> 3)).chain([536_736_859])
        {
            let (s, c) = sin_cos(Angle::from_bits(bits));
            let radians = f64::from(bits) / 2_f64.powi(32) * core::f64::consts::TAU;
            worst = worst
                .max((s.to_num::<f64>() - radians.sin()).abs())
                .max((c.to_num::<f64>() - radians.cos()).abs());
        }
        assert!(worst > 3.051 * 2_f64.powi(-30) && worst < 3.052 * 2_f64.powi(-30), "{worst:e}");
    }

    #[test]
    fn whole_quarters_are_exact() {
        let at = |quarters: u32| sin_cos(Angle::from_bits(quarters << 30));
        let (zero, one) = (Unit::ZERO, Unit::ONE);
        assert_eq!([at(0), at(1), at(2), at(3)], [(zero, one), (one, zero), (zero, -one), (-one, zero)]);
    }
}
