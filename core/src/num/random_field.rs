//! The random function `R(u, v)` of a surface: two normally distributed numbers, mean 0, variance 1, for each
//! point of a lattice, and for the same point always the same.
//!
//! Where two pieces of a surface meet they ask for the same points and get the same numbers, so that no gap
//! opens between them, whatever is drawn first; "otherwise a gaping hole will be created" (L. C. Carpenter,
//! "Computer rendering of fractal curves and surfaces", 1980, figure 7).
//!
//! The text adds bytes of `u` and of a rotated `v` and keeps ten bits: shifted copies of that correlate at
//! 0.97, and its spectrum has peaks of 1,312 times its mean. Here the two parameters are one word of 64 bits,
//! which a bijection mixes: no two points share a hash, and none is the mirror image of another. The mix is
//! three multiplications by an odd number with the upper word added to the lower one between them, modulo 2;
//! the seed goes through it first. Each half of the result chooses a number of the table of quantiles. (Two
//! multiplications, the finalizer of MurmurHash3, leave correlations of 0.04 between neighbouring knots.)
//!
//! "Many totally different surfaces may be created using the same table by adding offsets to the computed
//! table indices": the offset is added to what is mixed ([`RandomField::numbered`]); added to an index of a
//! table in order it would give nearly the same surface again.
//!
//! Format: coordinates 16 fractional bits, numbers 28.

use super::quantiles::{Deviate, deviate};

/// A coordinate of a point of a lattice: knots lie at integers, 16 fractional bits between.
pub type Coordinate = fixed::types::I16F16;

/// A function of a point without any visible pattern, one for each seed. Size: 8 bytes.
///
/// ```
/// use attractor::num::{Coordinate, RandomField};
/// let r = RandomField::new(7);
/// let [u, v] = [0.375, -2.5].map(Coordinate::from_num);
/// assert_eq!(r.at(u, v), RandomField::new(7).at(u, v));
/// assert_ne!(r.at(u, v), r.at(v, u));
/// assert_ne!(r.at(u, v), r.numbered(1).at(u, v));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct RandomField {
    key: u64,
}

impl RandomField {
    /// The function of this seed.
    pub const fn new(seed: u64) -> Self {
        Self { key: mixed(seed ^ 0x9e37_79b9_7f4a_7c15) }
    }

    /// One of many functions that have nothing to do with each other; number 0 is this one.
    pub const fn numbered(self, number: u32) -> Self {
        if number == 0 { self } else { Self { key: mixed(self.key.wrapping_add(number as u64)) } }
    }

    /// `R(u, v)`: two numbers that have nothing to do with each other.
    ///
    /// Domain: all. Result: each is one of 1024 numbers in `-3.31 .. 3.31`.
    #[inline(always)]
    pub fn at(self, u: Coordinate, v: Coordinate) -> [Deviate; 2] {
        let point = u64::from(u.to_bits() as u32) << 32 | u64::from(v.to_bits() as u32);
        let hash = mixed(point ^ self.key);
        [(hash >> 32) as u32, hash as u32].map(|half| deviate(half >> 23, half & 1 == 1))
    }
}

/// A bijection of 64 bits.
#[inline(always)]
const fn mixed(mut h: u64) -> u64 {
    // 32 bits: two instructions of a Cortex-M4 multiply, a third one folds
    const MIX: u64 = 0x9e37_79b1;
    h = h.wrapping_mul(MIX);
    h = (h ^ h >> 32).wrapping_mul(MIX);
    h = (h ^ h >> 32).wrapping_mul(MIX);
    h ^ h >> 32
}
