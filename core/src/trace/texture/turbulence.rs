//! Turbulence: noise of many sizes, each half as large and half as strong as the one before.
//!
//! `turb(s, p) = sum of 2^-(k+1) noise(2^k s p)` over `k` from 0 to the number of octaves less 1.
//!
//! Source: the course unit V, section 5.8.7, with three terms and with any number.
//!
//! Format: `s p` 48 fractional bits, of which an octave looks at 16: each one rounds the exact place anew.

use super::noise::{Lattice, Noise};
use crate::Error;
use crate::num::{Real, Unit, Vec3, Wide, product};

/// Turbulence of some noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Turbulence {
    noise: Noise,
    frequency: Real,
    octaves: u8,
}

impl Turbulence {
    /// The most octaves: the last one then is `2^-16` strong.
    pub const MOST_OCTAVES: u8 = 16;

    /// `turb(s, p)` with the frequency `s` and so many octaves.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for no octave or more than [`Turbulence::MOST_OCTAVES`].
    pub fn new(noise: Noise, frequency: Real, octaves: u8) -> Result<Self, Error> {
        if octaves == 0 || octaves > Self::MOST_OCTAVES {
            return Err(Error::OutOfRange {
                what: "octaves of the turbulence",
                index: None,
                value: Wide::from_num(octaves),
                min: Wide::ONE,
                max: Wide::from_num(Self::MOST_OCTAVES),
            });
        }
        Ok(Self { noise, frequency, octaves })
    }

    /// The turbulence at a place.
    ///
    /// Domain: all. Result: in `-1.04 .. 1.04`. Error: below `2^-25` where no octave's place needs more than
    /// 16 fractional bits (row `Turbulence::at`); a place that does is rounded down, and noise has a slope
    /// below
    /// 3. Cost: a noise and 15 instructions an octave at most (kernel row `turbulence`).
    #[inline]
    pub fn at(&self, place: Vec3) -> Unit {
        let mut scaled = [place.x, place.y, place.z].map(|c| product(c.to_bits(), self.frequency.to_bits()));
        let mut sum = Unit::ZERO;
        for k in 1..=u32::from(self.octaves) {
            let [x, y, z] = scaled.map(|c| Lattice::from_bits((c >> 32) as i32));
            let noise = self.noise.at(Vec3::new(x, y, z));
            // the strengths add up to less than 1
            sum = sum.wrapping_add(Unit::from_bits(noise.to_bits() >> (k & 31)));
            // noise repeats: what leaves the format does not count
            scaled = scaled.map(|c| c.wrapping_add(c));
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vector(n: [i32; 3]) -> Vec3 {
        let [x, y, z] = n.map(Real::from_bits);
        Vec3::new(x, y, z)
    }

    /// Places with so few digits that doubling loses none of them.
    #[test]
    fn turbulence_is_the_sum_of_its_octaves() {
        let (noise, frequency) = (Noise::new(5), Real::from_num(0.375));
        let eight = Turbulence::new(noise, frequency, 8).unwrap();
        for n in 0..500_i32 {
            let place = [1234, -777, 4321].map(|c: i32| c.wrapping_mul(n) % 900);
            let sum: i32 = (0..8)
                .map(|k| {
                    // 24 - 16 bits for the format, 3/8 as a product
                    let [x, y, z] = place.map(|c| Lattice::from_bits((c * 3) << k));
                    noise.at(Vec3::new(x, y, z)).to_bits() >> (k + 1)
                })
                .sum();
            assert_eq!(eight.at(vector(place.map(|c| c << 11))).to_bits(), sum, "{place:?}");
            assert!(n == 0 || sum != 0);
        }
    }

    #[test]
    fn turbulence_is_bounded_and_each_octave_adds_its_part() {
        let turbulence = |octaves| Turbulence::new(Noise::PERLIN, Real::from_num(-77), octaves).unwrap();
        let mut most = 0;
        for n in 0..2000_i32 {
            let place = vector([0x2545_f491, 0x6c07_8965, 0x1f12_3bb5].map(|c: i32| c.wrapping_mul(n)));
            let [three, four, most_octaves] =
                [3, 4, 16].map(|octaves| turbulence(octaves).at(place).to_bits());
            assert!((three - four).abs() < 1_117_000_000 >> 4 && (n == 0 || four != most_octaves));
            most = most.max(most_octaves.abs());
        }
        assert!(most > 1 << 28 && most < 1_117_000_000, "{most}");
    }

    #[test]
    fn too_few_and_too_many_octaves_are_refused() {
        let octaves = |octaves| Turbulence::new(Noise::PERLIN, Real::ONE, octaves).is_ok();
        assert_eq!([0, 1, 16, 17, 255].map(octaves), [false, true, true, false, false]);
    }
}
