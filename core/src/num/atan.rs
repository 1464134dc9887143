//! The angle of a vector in the plane, in turns: texture coordinates round an axis.
//!
//! The smaller component over the larger one is the tangent `q` of the angle to the nearest half-axis, at
//! most an eighth of a turn; that half-axis and the signs tell the rest. The arctangent is the Chebyshev
//! series
//!
//! `atan q = 2 (s T_1(q) - s^3 T_3(q) / 3 + s^5 T_5(q) / 5 - ..)`, `s = sqrt(2) - 1`,
//!
//! up to `T_21`, within `2^-32` of a radian. Source: Fox, Parker, "Chebyshev Polynomials in Numerical
//! Analysis", 1968, section 4.

use core::num::NonZeroU32;

use super::formats::{Q31, UQ31};
use super::product::{high_rounded, high_u, product_u};
use super::root::reciprocal_of;
use super::trig::Angle;

/// The series in powers of `q^2`, over `2 pi`, with 33 fractional bits: `atan q / (2 pi q)`.
const COEFFICIENTS: [i32; 11] = [
    1_367_130_546,
    -455_709_710,
    273_413_207,
    -195_140_154,
    150_721_792,
    -118_952_268,
    89_064_958,
    -57_068_225,
    27_607_645,
    -8_576_027,
    1_250_061,
];

/// The angle of `(x, y)`, words of one format, from the `x` axis towards the `y` axis; 0 for `(0, 0)`.
///
/// Domain: all. Error: below `5 2^-32` of a turn (`the_angle_of_a_vector_is_within_five_units`; row `atan2`
/// of tests/exhaust.toml), none on the axes. Cost: 18 multiplications, the table of the reciprocal.
///
/// ```
/// use attractor::num::{Angle, Near, atan2};
/// let (x, y) = (Near::from_num(-1), Near::from_num(0));
/// assert_eq!(atan2(y.to_bits(), x.to_bits()), Angle::from_num(0.5));
/// ```
pub fn atan2(y: i32, x: i32) -> Angle {
    let (across, along) = (y.unsigned_abs(), x.unsigned_abs());
    let steep = across > along;
    let (smaller, larger) = if steep { (along, across) } else { (across, along) };
    let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(larger).unwrap_or(NonZeroU32::MIN));
    // a quotient of two numbers with 31 fractional bits
    let tangent: UQ31 = (product_u(smaller << zeros, mantissa as u32) >> 31) as u32;
    let square: Q31 = (high_u(tangent, tangent) << 1).min(i32::MAX as u32) as i32;
    let mut sum = 0;
    for coefficient in COEFFICIENTS.iter().rev() {
        sum = coefficient + (high_rounded(sum, square) << 1);
    }
    // from the nearest half-axis, in units of 2^-32
    let angle = high_u(tangent, sum as u32);
    let angle = if steep { (1 << 30) - angle } else { angle };
    let angle = if x < 0 { (1 << 31) - angle } else { angle };
    Angle::from_bits(if y < 0 { angle.wrapping_neg() } else { angle })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In units of the angle, `2^-32` of a turn.
    fn error(y: i32, x: i32) -> f64 {
        let exact = f64::from(y).atan2(f64::from(x)) / core::f64::consts::TAU * 2_f64.powi(32);
        let off = f64::from(atan2(y, x).to_bits()) - exact;
        // modulo a turn
        (off - (off / 2_f64.powi(32)).round() * 2_f64.powi(32)).abs()
    }

    #[test]
    fn the_angle_of_a_vector_is_within_five_units() {
        // `error` is that of `atan2` in units
        let (mut worst, mut tried) = (0.0_f64, 0);
        for i in 0..300_000_u64 {
            let word = (i + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            let shift = (i % 31, i / 31 % 31);
            // one in three of equal size
            let shift = if i % 3 == 0 { (shift.0, shift.0) } else { shift };
            worst = worst.max(error((word >> 32) as i32 >> shift.0, word as i32 >> shift.1));
            tried += 1;
        }
        let ends = [i32::MIN, i32::MIN + 1, -2, -1, 0, 1, 2, i32::MAX - 1, i32::MAX];
        for (y, x) in ends.into_iter().flat_map(|y| ends.map(|x| (y, x))) {
            worst = worst.max(error(y, x));
            tried += 1;
        }
        // what the sweep has found to be the worst of all y beside an x
        worst = worst.max(error(0x40be_28ef, -(1 << 30) - 1));
        assert!(tried > 300_000 && worst > 4.5 && worst < 5.0, "{worst}");
    }

    #[test]
    fn the_axes_are_exact_quarters() {
        for far in [1, 2, 3, 1 << 28, i32::MAX] {
            let quarters = [atan2(0, far), atan2(far, 0), atan2(0, -far), atan2(-far, 0)];
            assert_eq!(quarters.map(Angle::to_bits), [0, 1 << 30, 1 << 31, 3 << 30]);
        }
        assert_eq!(atan2(0, 0), Angle::ZERO);
        // just below the x axis a turn is almost over
        assert!(atan2(-1, i32::MAX) == 0 && atan2(-8, i32::MAX).to_bits() > u32::MAX - 2);
    }
}
