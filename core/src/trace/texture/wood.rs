//! Wood: rings of two colours round an axis, like the years of a log.
//!
//! `rings(r) = int(r) mod 2` with the radius in rings. An ideal log has `r = f sqrt(x^2 + y^2)`; a real one
//! is
//! - tilted: its axis goes `tilt` along `x` and `y` with each unit of `z`, so that a cut shows ovals;
//! - wobbly: `K sin(m theta + 2 pi B z)` is added to the radius, with a whole number of waves `m` in a turn,
//!   so that there is no seam at `theta` = 0, and `B` turns of them along `z`; inside the first ring times
//!   the radius, so that the pith is no star;
//! - rough: turbulence is added.
//!
//! The colours change at once, as the text has it, or over the first part of each ring.
//!
//! Source: the course unit V, section 5.8.5; F. S. Hill, "Computer graphics using OpenGL", section 14.10, for
//! tilt and wobble.
//!
//! Format: radii 24 fractional bits, in 64 bits.

use super::super::surface::SurfacePoint;
use super::field::Texture;
use super::turbulence::Turbulence;
use crate::num::{Angle, Real, Rgb, Unit, Vec3, atan2, product, reciprocal, sin_cos, sqrt};

/// Rings of two colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wood {
    /// The colours of even and of odd rings, the innermost first.
    pub colors: [Rgb; 2],
    /// Rings to a unit of length.
    pub rings: Real,
    /// Where the axis goes along `x` and `y` with each unit of `z`.
    pub tilt: [Real; 2],
    /// How many rings the rings wave in and out: `K`.
    pub wobble: Real,
    /// How often in a turn: `m`.
    pub lobes: u8,
    /// How many turns the waves go round with each unit of `z`: `B`.
    pub twist: Real,
    /// What is added to the radius, times so many rings.
    pub rough: Option<(Turbulence, Real)>,
    /// The part of a ring over which the colour changes, 0 to 1 (clamped).
    pub soft: Unit,
}

impl Wood {
    /// How many rings a place is away from the axis, 24 fractional bits.
    ///
    /// Domain: all. Error: below `2^-19` for `rings` up to 8, a wobble up to 1 with 5 lobes, and places 1/4
    /// from the axis and farther, where nothing is rough (row `Wood::radius`). Cost: 40 multiplications, a
    /// root, an angle.
    pub fn radius(&self, place: Vec3) -> i64 {
        let across = |c: Real, tilt: Real| {
            let shifted = i64::from(c.to_bits()) - (product(tilt.to_bits(), place.z.to_bits()) >> 24);
            shifted.clamp((i32::MIN + 1).into(), i32::MAX.into()) as i32
        };
        let (x, y) = (across(place.x, self.tilt[0]), across(place.y, self.tilt[1]));
        let square = product(x, x) as u64 + product(y, y) as u64;
        let ideal = (i64::from(sqrt(square)) * i64::from(self.rings.to_bits())) >> 24;
        let round = atan2(y, x).to_bits().wrapping_mul(self.lobes.into());
        // 48 fractional bits of a turn: the upper 16 are whole turns
        let along = (product(self.twist.to_bits(), place.z.to_bits()) >> 16) as u32;
        let (sine, _) = sin_cos(Angle::from_bits(round.wrapping_add(along)));
        let whole_wave = (product(self.wobble.to_bits(), sine.to_bits()) >> 30) as i32;
        let wave = product(whole_wave, ideal.clamp(-(1 << 24), 1 << 24) as i32) >> 24;
        let rough = self
            .rough
            .map_or(0, |(turbulence, rings)| product(rings.to_bits(), turbulence.at(place).to_bits()) >> 30);
        ideal + wave + rough
    }
}

impl Texture for Wood {
    fn at(&self, point: &SurfacePoint) -> Rgb {
        let radius = self.radius(point.place);
        let is_odd = radius >> 24 & 1 > 0;
        let [before, now] = if is_odd { self.colors } else { [self.colors[1], self.colors[0]] };
        let into = (radius & 0xff_ffff) as u32;
        let soft = self.soft.clamp(Unit::ZERO, Unit::ONE).to_bits().unsigned_abs() >> 6;
        if into >= soft {
            return now;
        }
        // a quotient below 1
        let (mantissa, shift) = reciprocal(soft);
        let part = (u64::from(into) * u64::from(mantissa)) >> (shift - 30);
        before.mixed(now, Unit::from_bits(part as i32))
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::placed;
    use super::*;
    use crate::num::Lumen;

    const LOG: Wood = Wood {
        colors: [Rgb::BLACK, Rgb::WHITE],
        rings: Real::from_bits(4 << 24),
        tilt: [Real::ZERO; 2],
        wobble: Real::ZERO,
        lobes: 0,
        twist: Real::ZERO,
        rough: None,
        soft: Unit::ZERO,
    };

    #[test]
    fn rings_of_a_log_change_at_whole_radii_and_do_not_depend_on_z() {
        let mut odd = 0;
        for n in 0..2000_i32 {
            let place = [n.wrapping_mul(48_271), n.wrapping_mul(-69_621), n.wrapping_mul(12_345)];
            let [x, y, _] = place.map(|c| f64::from(c) / f64::from(1 << 24));
            let radius = 4.0 * x.hypot(y);
            if (radius - radius.round()).abs() < 1e-5 {
                continue;
            }
            let light = LOG.at(&placed(place));
            assert_eq!(light, LOG.colors[radius as usize % 2], "{radius}");
            odd += u32::from(light == Rgb::WHITE);
        }
        assert!((800..1200).contains(&odd), "{odd}");
    }

    #[test]
    fn a_soft_ring_changes_linearly_over_its_part() {
        let soft = Wood { soft: Unit::from_num(0.5), ..LOG };
        for n in 1..400_i32 {
            // rings 3 and 4 along x
            let radius = 3.0 + f64::from(n) / 200.0;
            let got = soft.at(&placed([(radius / 4.0 * f64::from(1 << 24)) as i32, 0, 9 << 24]));
            let part = (radius.fract() * 2.0).min(1.0);
            let exact = if radius < 4.0 { part } else { 1.0 - part };
            assert!((got.g.to_num::<f64>() - exact).abs() < 2_f64.powi(-15), "{radius}: {got:?}");
        }
        assert_eq!(soft.at(&placed([3 << 22, 0, 0])).g, Lumen::ZERO);
    }

    /// All round at one radius, the wobbly ring comes back to where it began.
    #[test]
    fn a_wobbly_log_has_no_seam() {
        let log = Wood { wobble: Real::from_num(0.75), lobes: 3, twist: Real::from_num(0.3), ..LOG };
        let at = |turn: f64| {
            let (y, x) = (turn * core::f64::consts::TAU).sin_cos();
            let [x, y] = [x, y].map(Real::from_num);
            log.radius(Vec3::new(x, y, Real::from_num(0.7)))
        };
        let jump = |a: f64, b: f64| (at(a) - at(b)).abs();
        assert!(jump(1e-6, -1e-6) < 1 << 9 && jump(0.5 - 1e-6, 0.5 + 1e-6) < 1 << 9);
        assert!(jump(0.0, 1.0 / 6.0) > 1 << 23);
        assert!(jump(0.1, 0.1 + 1.0 / 3.0) < 1 << 5);
    }
}
