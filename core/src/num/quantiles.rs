//! The table of the random functions: quantiles of the normal distribution.
//!
//! A random function chooses one of 1024 numbers `+-x_i`, the quantiles of the normal distribution at
//! `1/2 +- (i + 1/2) / 1024`, scaled to variance 1. So the mean is exactly 0, the fourth moment 2.98 instead
//! of 3, and the largest number 3.30. Source: L. C. Carpenter, "Computer rendering of fractal curves and
//! surfaces", 1980 (a table of Gaussian numbers, looked up).
//!
//! Format: 28 fractional bits; the table takes 2 KB of flash.

use super::formats::{Q28, UQ62};

/// Values of a random function: 28 fractional bits.
pub type Deviate = fixed::types::I4F28;

const COUNT: usize = 512;

/// The positive half of the table, ascending.
static QUANTILES: [Q28; COUNT] = {
    let raw = quantiles();
    let mut squares = 0_u64;
    let mut i = 0;
    while i < COUNT {
        squares += (raw[i] * raw[i]) >> 20;
        i += 1;
    }
    // their mean has 36 fractional bits, its root (widened by 20) 28
    let deviation = ((squares / COUNT as u64) << 20).isqrt();
    let mut table = [0; COUNT];
    i = 0;
    while i < COUNT {
        table[i] = (((raw[i] << 28) + deviation / 2) / deviation) as i32;
        i += 1;
    }
    table
};

/// Where the integral of the normal density from 0 reaches `(i + 1/2) / 1024`: 28 fractional bits. By the
/// midpoint rule in steps of `2^-10`, linear in between.
const fn quantiles() -> [u64; COUNT] {
    // densities with 62 fractional bits: at the middle of the first step, and exp(-2^-20)
    let mut density = FIRST_DENSITY as u128;
    const QUOTIENT: u128 = 4_611_681_620_382_973_951;
    let mut ratio = QUOTIENT;
    let mut table = [0; COUNT];
    let mut integral = 0_u128; // 62 fractional bits
    let (mut i, mut x) = (0, 0_u64);
    while i < COUNT {
        let step = density >> 10;
        while i < COUNT && ((2 * i as u128 + 1) << 51) < integral + step {
            let beyond = ((2 * i as u128 + 1) << 51) - integral;
            table[i] = x + (((beyond << 18) / step) as u64);
            i += 1;
        }
        integral += step;
        x += 1 << 18;
        density = (density * ratio) >> 62;
        ratio = (ratio * QUOTIENT) >> 62;
    }
    table
}

/// `exp(-2^-23) / sqrt(2 pi)`.
const FIRST_DENSITY: UQ62 = 1_839_796_317_366_000_629;

/// A number of the table: its index, 9 bits, and whether it is negative.
#[inline(always)]
pub(super) fn deviate(index: u32, negative: bool) -> Deviate {
    let magnitude = QUANTILES.get(index as usize).copied().unwrap_or(0);
    Deviate::from_bits(if negative { -magnitude } else { magnitude })
}

/// The absolute values, each as often as any other.
pub(crate) fn magnitudes() -> &'static [Q28] {
    &QUANTILES
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_mean_0_variance_1_and_is_normal() {
        let x: std::vec::Vec<f64> = QUANTILES.iter().map(|q| f64::from(*q) / f64::from(1 << 28)).collect();
        let moment = |n: i32| x.iter().map(|v| v.powi(n)).sum::<f64>() / COUNT as f64;
        assert!((moment(2) - 1.0).abs() < 1e-8, "{}", moment(2));
        assert!((moment(4) - 2.98).abs() < 0.02, "{}", moment(4));
        assert!(x.is_sorted() && x[0] > 0.0011 && x[511] > 3.29 && x[511] < 3.31, "{} {}", x[0], x[511]);
        // quartile and one standard deviation
        assert!((x[255] - 0.674_49).abs() < 2e-3 && (x[349] - 1.0).abs() < 3e-3, "{} {}", x[255], x[349]);
    }
}
