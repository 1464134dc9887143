//! The exponential `e^-x` of a number that is not negative, as spectra, dimensions and error bounds need it.
//!
//! A power of two is a shift, so the exponent is split: `x / ln 2 = k + i / 64 + f` with whole `k`, `i` from
//! 0 to 63 and `f` below `1/64`, and `e^-x = 2^-k 2^(-i / 64) e^(-f ln 2)`. The second factor is from a
//! table; the third is `1 - y + y^2 / 2 - y^3 / 6` for `y = f ln 2 < 0.011`, within `2^-30.7`.

use super::formats::{Q30, UQ30, UQ32};
use super::formats::{Real, Unit};
use super::product::{high_u, product_u};

/// `2^(-i / 64)`, below 1.
static POWERS: [UQ32; 64] = {
    let mut table = [0; 64];
    // 2^(-1/64) with 64 fractional bits: six square roots of 1/2
    let mut step = 1_u128 << 127;
    let mut i = 0;
    while i < 6 {
        step = step.isqrt() << 64;
        i += 1;
    }
    let step = step >> 64;
    let mut power = u64::MAX as u128;
    let mut i = 0;
    while i < 64 {
        table[i] = (power >> 32) as u32;
        power = (power * step) >> 64;
        i += 1;
    }
    table
};

/// `e^-x`. Domain: `x >= 0`; less counts as 0. Error: below `2^-29`, none at 0
/// (`e_to_the_minus_x_is_within_two_to_the_minus_29`). Cost: 32 Cortex-M4 instructions (kernel `exp_minus`),
/// a table of 256 bytes.
pub fn exp_minus(x: Real) -> Unit {
    const PER_LN_2: UQ30 = 0x5c55_1d95; // 1 / ln 2
    Unit::from_bits(exp2_minus(product_u(x.to_bits().max(0).unsigned_abs(), PER_LN_2) >> 22))
}

/// `2^-x`, for an `x` with 32 fractional bits. Error: below `2^-29`, none for whole `x`
/// (`two_to_the_minus_x_is_within_two_to_the_minus_29`).
#[inline]
pub(crate) fn exp2_minus(halvings: u64) -> Q30 {
    let (whole, fraction) = ((halvings >> 32) as u32, halvings as u32);
    // the rest below 1/64 as a whole word: y / ln 2 with 38 fractional bits, y with 38 too
    const LN_2: UQ32 = 0xb172_17f8; // ln 2
    let y = high_u(fraction << 6, LN_2);
    // y^2 / 2 with 38 fractional bits, y^3 / 6 likewise
    let square = high_u(y, y) >> 7;
    let cube = high_u(high_u(square, y), u32::MAX / 3) >> 6;
    // 1 - e^-y
    let less: UQ32 = (y - square + cube) >> 6;
    let power = POWERS[(fraction >> 26) as usize & 63];
    let value = power - high_u(power, less);
    // 1 is one unit more than the word holds; to 30 fractional bits, to nearest
    let halved = (value >> 1).checked_shr(whole).unwrap_or(0);
    ((halved + 1) >> 1) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn e_to_the_minus_x_is_within_two_to_the_minus_29() {
        let mut worst: f64 = 0.0;
        // the last one is the worst of all
        for i in (0..100_000).map(|i| i * 21_001).chain((0..200_000).map(|i| i * 997)).chain([571_017]) {
            let x = Real::from_bits(i);
            worst = worst.max((exp_minus(x).to_num::<f64>() - (-x.to_num::<f64>()).exp()).abs());
        }
        assert_eq!((exp_minus(Real::ZERO), exp_minus(Real::MIN)), (Unit::ONE, Unit::ONE));
        assert!(worst > 1.119 * 2_f64.powi(-30) && worst < 1.12 * 2_f64.powi(-30), "{worst:e}");
    }

    #[test]
    fn two_to_the_minus_x_is_within_two_to_the_minus_29() {
        let mut worst: f64 = 0.0;
        for i in 0..200_000_u64 {
            let x = i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (26 + i % 30);
            let exact = (-(x as f64) / 2_f64.powi(32)).exp2();
            worst = worst.max((f64::from(exp2_minus(x)) / 2_f64.powi(30) - exact).abs());
        }
        for k in 0..31 {
            assert_eq!(exp2_minus(k << 32), 1 << (30 - k));
        }
        assert_eq!(exp2_minus(u64::MAX), 0);
        assert!(worst > 2_f64.powi(-31) && worst < 2_f64.powi(-29), "{worst:e}");
    }

    #[test]
    fn what_is_far_below_a_unit_is_nothing() {
        assert_eq!(exp_minus(Real::MAX), Unit::ZERO);
        assert_eq!(exp_minus(Real::from_num(33)), Unit::ZERO);
    }
}
