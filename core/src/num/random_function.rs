//! The random function `R(t)`: normally distributed, mean 0, variance 1, and for the same parameter always
//! the same number.
//!
//! A random curve asks for `R` at the middle of each of its parts. Since the answer depends on the parameter
//! and the seed alone, any piece of the curve can be drawn again, at any resolution, without a stored number:
//! "R is a random function and not a random variable" (L. C. Carpenter, "Computer rendering of fractal curves
//! and surfaces", 1980; table lookup, 10 bits).
//!
//! A hash of the parameter and the seed chooses one of the 1024 numbers of the table of quantiles. The hash
//! is the finalizer of A. Appleby's MurmurHash3.
//!
//! Format: 28 fractional bits.

use super::quantiles::{Deviate, deviate};

/// A parameter of a curve: knots lie at integers, 32 fractional bits between.
pub type Parameter = fixed::types::I32F32;

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
        deviate(hash >> 23, hash & 1 == 1)
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

#[cfg(test)]
mod tests {
    use super::*;

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
