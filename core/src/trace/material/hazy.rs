//! Aerial perspective: what lies far away takes the colour of the air.
//!
//! Of a point's light `e^(-d / v)` is left after the distance `d` from the eye, `v` the visibility, and the
//! air adds the rest in its own colour: `L e^(-d / v) + A (1 - e^(-d / v))`. What the point mirrors or lets
//! through is faded alike, as the distance of what is seen in it is not known here.
//!
//! Source: F. K. Musgrave, in D. S. Ebert et al., "Texturing and Modeling", 1994, chapter 17 (fog of constant
//! density); J. Beer's law.
//!
//! Formats: lengths 24 fractional bits, parts 30.

use super::super::surface::SurfacePoint;
use super::respond::{Lit, Material, Medium, Response};
use crate::num::{Real, Rgb, Unit, Vec3, exp_minus, product, sqrt, square};

/// A material seen through air.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hazy<M> {
    /// What is seen.
    pub material: M,
    /// From where.
    pub eye: Vec3,
    /// The colour of the air, mostly that of the horizon.
    pub air: Rgb,
    /// `1 / v`: how much of the light a unit of air takes; none for less than 0.
    pub density: Unit,
}

impl<M> Hazy<M> {
    /// How much of a point's light is left.
    ///
    /// Error: below `2^-22` at densities below 1 (`air_takes_light_with_the_distance`).
    pub fn clarity(&self, at: Vec3) -> Unit {
        // halves: their squares fit, and so does the root
        let half = |a: Real, b: Real| ((i64::from(a.to_bits()) - i64::from(b.to_bits())) >> 1) as i32;
        let off = [half(at.x, self.eye.x), half(at.y, self.eye.y), half(at.z, self.eye.z)];
        let distance = sqrt(square(off)).min(i32::MAX as u32) as i32;
        let depth = product(distance, self.density.max(Unit::ZERO).to_bits()) >> 29;
        exp_minus(Real::from_bits(depth.min(i64::from(i32::MAX)) as i32))
    }
}

impl<M: Material> Material for Hazy<M> {
    fn is_charted(&self) -> bool {
        self.material.is_charted()
    }

    fn medium(&self) -> Option<Medium> {
        self.material.medium()
    }

    fn passes(&self) -> Rgb {
        self.material.passes()
    }

    fn normal(&self, point: &SurfacePoint) -> Vec3<Unit> {
        self.material.normal(point)
    }

    fn respond(&self, point: &SurfacePoint, view: Vec3<Unit>, lights: impl Iterator<Item = Lit>) -> Response {
        let Response { light, reflected, refracted } = self.material.respond(point, view, lights);
        if self.density <= 0 {
            return Response { light, reflected, refracted };
        }
        let clarity = self.clarity(point.position);
        Response {
            light: self.air.mixed(light, clarity),
            reflected: reflected.scaled(clarity),
            refracted: refracted.scaled(clarity),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::mixture::Mixture;
    use super::*;
    use crate::num::Lumen;
    use crate::trace::Chart;

    /// Against the formula in f64: how much is left, and what the air adds.
    #[test]
    fn air_takes_light_with_the_distance() {
        let grey = |part: f64| Rgb::grey(Lumen::from_num(part));
        let (mut worst, mut clear, mut far) = (0.0_f64, 0.0_f64, 0);
        for k in 1..400_i32 {
            // up to 221 apart
            let place = |step: i32| Real::from_bits(k.wrapping_mul(step) >> (1 + k % 2));
            let (at, eye) = (
                Vec3::new(place(0x2545_f491), place(0x6c07_8965), place(0x1f12_3bb5)),
                Vec3::new(place(0x4f6c_dd1d), place(0x3141_5927), place(0x2718_2819)),
            );
            let density = Unit::from_bits((k << 21) >> (k % 8));
            let hazy = Hazy { material: Mixture::matt(grey(0.5)), eye, air: grey(0.75), density };
            let off = |a: Real, b: Real| a.to_num::<f64>() - b.to_num::<f64>();
            let distance =
                (off(at.x, eye.x).powi(2) + off(at.y, eye.y).powi(2) + off(at.z, eye.z).powi(2)).sqrt();
            let exact = (-distance * density.to_num::<f64>()).exp();
            clear = clear.max((hazy.clarity(at).to_num::<f64>() - exact).abs());
            far += u32::from(exact < 0.01);
            let normal = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE);
            let point = SurfacePoint {
                position: at,
                place: at,
                normal,
                inward: false,
                chart: Chart::default(),
                face: 0,
                width: Real::ZERO,
            };
            let plain = hazy.material.respond(&point, normal, core::iter::empty()).light.r.to_num::<f64>();
            let got = hazy.respond(&point, normal, core::iter::empty()).light.r.to_num::<f64>();
            worst = worst.max((got - (plain * exact + 0.75 * (1.0 - exact))).abs());
        }
        std::println!("{clear:e} {worst:e} {far}");
        assert!(clear > 2.0_f64.powi(-28) && clear < 2.0_f64.powi(-22), "{clear:e}");
        assert!(worst < 2.0_f64.powi(-15) && far > 100, "{worst:e} {far}");
    }
}
