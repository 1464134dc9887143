//! Marble, clouds, lava: colours of a spline, stirred by turbulence.
//!
//! Marble is `undulate(sin(f z + A turb(s, p)))` with `f` = 2 in the text: veins across the z axis that chaos
//! bends. Without veins, `undulate(turb(s, p))`, it is clouds and whatever else is mottled.
//!
//! Source: the course unit V, section 5.8.8; its printed formula has lost the perturbation that its own
//! sentence describes.
//!
//! Format: the phase in radians 48 fractional bits, in turns 32.

use super::super::surface::SurfacePoint;
use super::field::Texture;
use super::spline::Spline;
use super::turbulence::Turbulence;
use crate::num::{Angle, Real, Rgb, Unit, Vec3, high_u, product, sin_cos};

/// Veins of the colours of a spline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Marble<const N: usize> {
    /// From -1 to 1, the colours from the middle of one vein to the middle of the next.
    pub undulate: Spline<N>,
    /// What stirs it.
    pub turbulence: Turbulence,
    /// How much, in radians: `A`.
    pub amplitude: Real,
    /// How many radians a unit of `z` is: the text's 2.
    pub frequency: Real,
}

impl<const N: usize> Marble<N> {
    /// `sin(f z + A turb(s, p))`.
    ///
    /// Domain: all. Error: below `2^-19` at an amplitude of 8, where an octave's place needs no more than 16
    /// fractional bits (row `Marble::vein`). Cost: the turbulence, 16 multiplications.
    #[inline]
    pub fn vein(&self, place: Vec3) -> Unit {
        let stirred = product(self.amplitude.to_bits(), self.turbulence.at(place).to_bits()) >> 6;
        // below 2^14 + 2^8 radians
        let radians = product(self.frequency.to_bits(), place.z.to_bits()).wrapping_add(stirred);
        sin_cos(turns(radians)).0
    }
}

/// An angle in radians, 48 fractional bits, in turns.
#[inline]
fn turns(radians: i64) -> Angle {
    /// `2^64 / (2 pi)`: whole radians are turned modulo a turn without an error that grows.
    const OVER_TAU: u64 = 2_935_890_503_282_001_226;
    let whole = ((radians >> 48) as u64).wrapping_mul(OVER_TAU);
    let rest = high_u((radians >> 16) as u32, (OVER_TAU >> 32) as u32);
    Angle::from_bits(((whole >> 32) as u32).wrapping_add(rest))
}

impl<const N: usize> Texture for Marble<N> {
    #[inline]
    fn at(&self, point: &SurfacePoint) -> Rgb {
        self.undulate.at(self.vein(point.place))
    }
}

/// Colours of turbulence itself: clouds, lava, granite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mottle<const N: usize> {
    /// The colours; turbulence is mostly within a half of 0.
    pub undulate: Spline<N>,
    /// What is seen.
    pub turbulence: Turbulence,
}

impl<const N: usize> Texture for Mottle<N> {
    #[inline]
    fn at(&self, point: &SurfacePoint) -> Rgb {
        self.undulate.at(self.turbulence.at(point.place))
    }
}

#[cfg(test)]
mod tests {
    use super::super::noise::Noise;
    use super::super::testing::placed;
    use super::*;

    #[test]
    fn an_angle_in_radians_is_the_one_in_turns() {
        let mut worst: f64 = 0.0;
        for n in 0..20_000_i64 {
            let radians = n.wrapping_mul(0x9e37_79b9_7f4a_7c15_u64 as i64) >> (1 + n % 20);
            // both parts in turns: whole radians are exact in f64, and so is their remainder
            let whole = (radians >> 48) as f64;
            let exact = (whole % core::f64::consts::TAU + (radians & ((1 << 48) - 1)) as f64 / 2_f64.powi(48))
                / core::f64::consts::TAU;
            let off = turns(radians).to_num::<f64>() - exact;
            worst = worst.max((off - off.round()).abs());
        }
        assert!(worst > 2_f64.powi(-33) && worst < 2_f64.powi(-30), "{worst:e}");
    }

    #[test]
    fn marble_without_turbulence_has_straight_veins_and_with_it_bent_ones() {
        let undulate = Spline::new(&[(-Unit::ONE, Rgb::BLACK), (Unit::ONE, Rgb::WHITE)]).unwrap();
        let turbulence = Turbulence::new(Noise::PERLIN, Real::ONE, 4).unwrap();
        let straight: Marble<2> =
            Marble { undulate, turbulence, amplitude: Real::ZERO, frequency: Real::from_num(2) };
        let stirred = Marble { amplitude: Real::from_num(3), ..straight };
        let mut bent = 0;
        for n in 0..500_i32 {
            let place = [n.wrapping_mul(123_457), n.wrapping_mul(-98_765), n.wrapping_mul(55_555)];
            let point = placed(place);
            let z = point.place.z.to_num::<f64>();
            let vein = straight.vein(point.place);
            assert!((vein.to_num::<f64>() - (2.0 * z).sin()).abs() < 1e-8);
            assert_eq!(straight.at(&point), undulate.at(vein));
            assert_eq!(straight.at(&point), straight.at(&placed([0, 0, place[2]])));
            bent += u32::from(stirred.at(&point) != straight.at(&point));
            let mottle = Mottle { undulate, turbulence };
            assert_eq!(mottle.at(&point), undulate.at(turbulence.at(point.place)));
        }
        assert!(bent > 400, "{bent}");
    }
}
