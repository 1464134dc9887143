//! The exponential `e^-x` by powers of two.

use super::{Real, Unit};

/// `e^-x`. Domain: `x >= 0`; less counts as 0. Error: below `2^-27`. Cost: 160 Cortex-M4 instructions.
pub fn exp_minus(x: Real) -> Unit {
    // x / ln 2 with 32 fractional bits
    const PER_LN_2: i64 = 0x5c55_1d95; // 2^30 / ln 2
    let halvings = (i64::from(x.to_bits().max(0)) * PER_LN_2) >> 22;
    let whole = (halvings >> 32).min(62) as u32;
    // 2^-f = e^(-f ln 2) for f in [0, 1): its series, ln 2 with 30 fractional bits
    const LN_2: i64 = 0x2c5c_85fe;
    let y = ((halvings & 0xffff_ffff) * LN_2) >> 32;
    let mut sum = 1_i64 << 30;
    for k in (1..=11).rev() {
        // sum <- 1 - y sum / k; both are at most 1
        sum = (1 << 30) - i64::from(((y * sum) >> 30) as u32 / k);
    }
    Unit::from_bits((sum >> whole) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn e_to_the_minus_x_is_within_two_to_the_minus_27() {
        let mut worst: f64 = 0.0;
        for i in 0..100_000 {
            let x = Real::from_bits(i * 21_001);
            worst = worst.max((exp_minus(x).to_num::<f64>() - (-x.to_num::<f64>()).exp()).abs());
        }
        assert!(worst > 0.0 && worst < 2_f64.powi(-27), "{worst:e}");
    }
}
