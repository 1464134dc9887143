//! Sine and cosine by their series, after the angle is brought into an eighth of a turn around zero.

use super::Unit;
use super::product;

/// An angle in turns: the whole range of the number is one turn, so that it wraps as angles do.
pub type Angle = fixed::types::U0F32;

/// Sine and cosine. Error: below `2^-28` (`sine_and_cosine_are_within_two_to_the_minus_28`). Cost: 11 multiplications.
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
    // radians with 31 fractional bits: rest / 2^32 * 2 pi, and 2 pi = PI_4 * 2^3 with 31 fractional bits below
    const PI_4: i32 = 0x6487_ed51; // pi / 4 * 2^31
    let x = (product(rest, PI_4) >> 29) as i32; // |x| <= pi / 4
    let square = rounded(x, x);
    let sine = {
        let mut s = RECIPROCALS[9];
        for k in [7, 5, 3] {
            s = RECIPROCALS[k] - rounded(square, s);
        }
        x - rounded(rounded(square, s), x)
    };
    let cosine = {
        let mut c = RECIPROCALS[10];
        for k in [8, 6, 4, 2] {
            c = RECIPROCALS[k] - rounded(square, c);
        }
        i32::MAX - rounded(square, c)
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

#[inline]
fn rounded(a: i32, b: i32) -> i32 {
    ((product(a, b) + (1 << 30)) >> 31) as i32
}

/// `1/k!` with 31 fractional bits. The ones for 0 and 1 do not fit and are not used.
const RECIPROCALS: [i32; 11] = {
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
