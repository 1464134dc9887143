//! The random function `R(t)`: normally distributed, mean 0, variance 1, and for the same parameter always
//! the same number.
//!
//! A random curve asks for `R` at the middle of each of its parts. Since the answer depends on the parameter
//! and the seed alone, any piece of the curve can be drawn again, at any resolution, without a stored number:
//! "R is a random function and not a random variable" (L. C. Carpenter, "Computer rendering of fractal curves
//! and surfaces", 1980; table lookup, 10 bits).
//!
//! A hash of the parameter and the seed chooses one of 1024 numbers `+-x_i`, the quantiles of the normal
//! distribution at `1/2 +- (i + 1/2) / 1024`, scaled to variance 1. So the mean is exactly 0, the fourth
//! moment 2.98 instead of 3, and the largest number 3.30. The hash is the finalizer of A. Appleby's
//! MurmurHash3.
//!
//! Format: 28 fractional bits; the table takes 2 KB of flash.

use super::formats::{Q28, UQ62};

/// A parameter of a curve: knots lie at integers, 32 fractional bits between.
pub type Parameter = fixed::types::I32F32;

/// Values of `R`: 28 fractional bits.
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

/// A function of the parameter without any visible pattern, one for each seed. Size: 8 bytes.
///
/// ```
/// use attractor::num::{Parameter, RandomFunction};
/// let r = RandomFunction::new(7);
/// let t = Parameter::from_num(0.375);
/// assert_eq!(r.at(t), RandomFunction::new(7).at(t));
/// assert_ne!(r.at(t), RandomFunction::new(8).at(t));
/// assert_ne!(r.at(t), r.independent().at(t));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RandomFunction {
    low: u32,
    high: u32,
}

impl RandomFunction {
    /// The function of this seed.
    pub const fn new(seed: u64) -> Self {
        Self { low: seed as u32, high: (seed >> 32) as u32 }
    }

    /// A second function that has nothing to do with this one.
    pub const fn independent(self) -> Self {
        Self { low: self.low ^ 0x2c1b_3c6d, high: self.high.wrapping_add(0x5bd1_e995) }
    }

    /// `R(t)`.
    ///
    /// Domain: all. Result: one of 1024 numbers in `-3.31 .. 3.31`. Cost: 3 multiplications and a load, 16
    /// Cortex-M4 instructions (kernel `deviate`).
    #[inline]
    pub fn at(self, t: Parameter) -> Deviate {
        let bits = t.to_bits();
        let (low, high) = (bits as u32, (bits >> 32) as u32);
        let hash = mixed((low ^ self.low).wrapping_add((high ^ self.high).wrapping_mul(0x9e37_79b1)));
        let magnitude = QUANTILES.get((hash >> 23) as usize).copied().unwrap_or(0);
        Deviate::from_bits(if hash & 1 == 0 { magnitude } else { -magnitude })
    }
}

/// The finalizer of MurmurHash3.
#[inline]
pub(crate) const fn mixed(mut h: u32) -> u32 {
    h ^= h >> 16;
    h = h.wrapping_mul(0x85eb_ca6b);
    h ^= h >> 13;
    h = h.wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

/// The absolute values that `R` takes, each as often as any other.
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

    #[test]
    fn neighbouring_parameters_and_seeds_are_uncorrelated() {
        let n = 1 << 16;
        let value = |r: RandomFunction, i: u32, shift: u32| {
            r.at(Parameter::from_bits(i64::from(2 * i + 1) << shift)).to_num::<f64>()
        };
        let r = RandomFunction::new(1);
        for shift in [0, 4, 12, 15, 20] {
            let (mut mean, mut square, mut fourth) = (0.0, 0.0, 0.0);
            let mut products = [0.0; 5];
            for i in 0..n {
                let v = value(r, i, shift);
                mean += v;
                square += v * v;
                fourth += v.powi(4);
                for (sum, other) in products.iter_mut().zip([
                    value(r, i + 1, shift),
                    value(r, i + 2, shift),
                    value(r, i, shift + 1),
                    value(RandomFunction::new(2), i, shift),
                    value(r.independent(), i, shift),
                ]) {
                    *sum += v * other;
                }
            }
            // five standard errors of 2^16 samples
            let n = f64::from(n);
            let limit = 5.0 / n.sqrt();
            assert!(
                (mean / n).abs() < limit && (square / n - 1.0).abs() < 1.5 * limit,
                "{shift}: {mean} {square}"
            );
            assert!((fourth / n - 2.98).abs() < 10.0 * limit, "{shift}: {fourth}");
            assert!(products.iter().all(|p| (p / n).abs() < limit), "{shift}: {products:?}");
        }
    }
}
