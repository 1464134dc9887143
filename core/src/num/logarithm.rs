//! The binary logarithm of a whole number, by a table and a polynomial: for smooth colours, tones of a
//! density, dimensions.
//!
//! `v = 2^k m` with `m` in `[1, 2)`, so that only the logarithm of `m` has to be computed. That interval is
//! divided into 128 parts; for each there is a number `r` near `1 / m`, the one that [`super::reciprocal`]
//! begins with: `m r = 1 + t` with `|t| < 2^-7.9`, so that
//!
//! `log2(v) = k - log2(r) + log2(1 + t)`, `log2(1 + t) = (t - t^2 / 2 + t^3 / 3) / ln 2`, within `2^-33`.
//!
//! The table holds `-log2(r)`.

use core::num::NonZeroU32;

use super::formats::{Q30, Q31, UQ31};
use super::product::{high, product_u};
use super::root::SEEDS;

/// `-log2(r)` for the seeds, to nearest.
static LOGARITHMS: [UQ31; 128] = {
    let mut table = [0; 128];
    let mut i = 0;
    while i < 128 {
        // digit by digit: squaring a number doubles its logarithm, and a carry beyond 2 is the next digit
        // (Knuth, TAOCP vol. 1, 1.2.2, exercise 25)
        let mut mantissa = (SEEDS[i] as u64) << 48; // 63 fractional bits, in [1, 2) for r in [1/2, 1)
        let mut digits = 0_u64;
        let mut k = 0;
        while k < 40 {
            let square = (mantissa as u128 * mantissa as u128) >> 63;
            let carry = (square >> 64) as u32;
            mantissa = (square >> carry) as u64;
            digits = digits << 1 | carry as u64;
            k += 1;
        }
        // log2(r) + 1 with 40 digits
        table[i] = (((1 << 40) - digits + (1 << 8)) >> 9) as u32;
        i += 1;
    }
    table
};

/// The coefficients of the polynomial: `1 / ln 2`, `-1 / (2 ln 2)` and `1 / (3 ln 2)`.
const FIRST: Q30 = 0x5c55_1d95;
const SECOND: Q31 = -FIRST;
const THIRD: Q31 = (2 * FIRST as i64 / 3) as i32;

/// `log2(v)` with 24 fractional bits, to nearest.
///
/// Domain: `v > 0` (0 counts as 1). Result: `0..=64` with 24 fractional bits. Error: below `2^-24`
/// (`a_logarithm_is_within_two_to_the_minus_24`), none for powers of two. Cost: 37 Cortex-M4 instructions
/// (kernel `log2`), a table of 512 bytes.
pub fn log2(v: u64) -> u32 {
    // v = 2^whole m, the mantissa with 31 fractional bits
    let (whole, m): (u32, UQ31) = match NonZeroU32::new((v >> 32) as u32) {
        Some(high) => {
            let zeros = high.leading_zeros();
            (63 - zeros, high.get() << zeros | (v as u32 >> 1) >> (zeros ^ 31))
        }
        None => {
            let low = NonZeroU32::new(v as u32).unwrap_or(NonZeroU32::MIN);
            let zeros = low.leading_zeros();
            (31 - zeros, low.get() << zeros)
        }
    };
    let index = ((m >> 24) & 127) as usize;
    // t = m r - 1 with 38 fractional bits: the 1 is beyond the word
    let t = (product_u(m, SEEDS[index].into()) >> 9) as i32;
    let second: Q31 = SECOND + (high(t, THIRD) >> 6);
    let first: Q30 = FIRST + (high(t, second) >> 7);
    let rest: Q31 = high(t, first) >> 5;
    // the fractional part of the logarithm, from -2^-31 to 1
    let fraction = LOGARITHMS[index].wrapping_add_signed(rest).wrapping_add(1 << 6) >> 7;
    (whole << 24) + fraction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_logarithm_is_within_two_to_the_minus_24() {
        let mut worst = 0.0_f64;
        for i in 1..200_000_u64 {
            let v = i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (i % 63);
            let error = f64::from(log2(v)) / 2_f64.powi(24) - (v.max(1) as f64).log2();
            worst = worst.max(error.abs());
        }
        for k in 0..64 {
            assert_eq!(log2(1 << k), k << 24);
        }
        assert_eq!(log2(0), 0);
        assert_eq!(log2(u64::MAX), 64 << 24);
        // half a unit of rounding, and hardly more: a third term or a 1 / ln 2 that is wrong has no room
        assert!(worst > 2_f64.powi(-26) && worst < 0.52 * 2_f64.powi(-24), "{worst:e}");
    }
}
