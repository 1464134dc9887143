//! Frame mapping: a material whose grain is turned.
//!
//! The frame of a point is its normal `N`, a tangent `T` along the grain and the binormal `B = T x N` (here,
//! with `B' = N x T`, its opposite). The grain of a surface is the direction of `P_u`: anisotropic highlights
//! look there. [`Framed`] turns it in the tangent plane by an angle that is looked up, and hands the point
//! on: wood grain, the crossing threads of cloth, streaks in marble. With [`Bumpy`](super::Bumpy) round it,
//! the whole frame is perturbed.
//!
//! Source: the course unit V, section 5.8.3; J. Kajiya, "Anisotropic reflection models", 1985.
//!
//! Format: tangents as the chart has them, 24 fractional bits.

use super::super::material::{Lit, Material, Medium, Response};
use super::super::surface::{Chart, SurfacePoint};
use super::checker::Checker;
use super::image::Image;
use super::turbulence::Turbulence;
use crate::num::{Angle, Real, Rgb, Unit, Vec3, product, sin_cos};

/// Where the grain of a surface goes.
pub trait Grain {
    /// The angle from `P_u` towards `P_v`, counter-clockwise round the normal.
    fn turn(&self, point: &SurfacePoint) -> Angle;
}

/// A material with a turned grain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Framed<M, G> {
    /// What the surface is made of.
    pub material: M,
    /// Where its grain goes.
    pub grain: G,
}

/// The point with its `P_u` turned round the normal: as long as what of it lies across the normal.
///
/// Domain: all. Error: below `2^-21` for tangents shorter than 4
/// (`the_grain_turns_round_the_normal_and_keeps_its_length`).
pub fn turned(point: &SurfacePoint, angle: Angle) -> SurfacePoint {
    let n = [point.normal.x, point.normal.y, point.normal.z].map(Unit::to_bits);
    let grain = [point.chart.along_u.x, point.chart.along_u.y, point.chart.along_u.z].map(Real::to_bits);
    let along: i64 = grain.iter().zip(n).map(|(g, n)| product(*g, n) >> 30).sum();
    let saturated = |bits: i64| bits.clamp(i32::MIN.into(), i32::MAX.into()) as i32;
    let off = n.map(|n| (along * i64::from(n)) >> 30);
    let flat: [i32; 3] = core::array::from_fn(|i| match (grain.get(i), off.get(i)) {
        (Some(g), Some(off)) => saturated(i64::from(*g) - off),
        _ => 0,
    });
    let [a, b, c] = n;
    let [x, y, z] = flat;
    let minor = |n: i32, v: i32, m: i32, w: i32| saturated((product(n, v) - product(m, w)) >> 30);
    let across = [minor(b, z, c, y), minor(c, x, a, z), minor(a, y, b, x)];
    let (sine, cosine) = sin_cos(angle);
    let mixture = |v: i32, w: i32| {
        Real::from_bits(saturated((product(v, cosine.to_bits()) + product(w, sine.to_bits())) >> 30))
    };
    let [p, q, r] = across;
    let along_u = Vec3::new(mixture(x, p), mixture(y, q), mixture(z, r));
    SurfacePoint { chart: Chart { along_u, ..point.chart }, ..*point }
}

impl<M: Material, G: Grain> Framed<M, G> {
    fn turned(&self, point: &SurfacePoint) -> SurfacePoint {
        turned(point, self.grain.turn(point))
    }
}

impl<M: Material, G: Grain> Material for Framed<M, G> {
    const MAY_BE_CLEAR: bool = M::MAY_BE_CLEAR;

    fn is_charted(&self) -> bool {
        true
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
        self.material.respond(&self.turned(point), view, lights)
    }
}

/// The same angle everywhere.
impl Grain for Angle {
    fn turn(&self, _: &SurfacePoint) -> Angle {
        *self
    }
}

/// Threads that cross: along `u` in the even cells of a checker, along `v` in the odd ones.
impl<A, B> Grain for Checker<A, B> {
    fn turn(&self, point: &SurfacePoint) -> Angle {
        if self.is_odd(point) { Angle::from_bits(1 << 30) } else { Angle::ZERO }
    }
}

/// By a table: a grey of 1 is a whole turn.
impl Grain for Image<'_> {
    fn turn(&self, point: &SurfacePoint) -> Angle {
        Angle::from_bits(self.nearest(point.chart.u, point.chart.v).g.to_bits() << 16)
    }
}

/// Streaks: turbulence of the place, times so many turns.
impl Grain for (Turbulence, Unit) {
    fn turn(&self, point: &SurfacePoint) -> Angle {
        let turns = product(self.0.at(point.place).to_bits(), self.1.to_bits()) >> 28;
        Angle::from_bits(turns as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::super::image::Texels;
    use super::super::noise::Noise;
    use super::super::testing::{charted, placed};
    use super::*;
    use crate::trace::material::{Anisotropic, Mixture};

    #[test]
    fn the_grain_turns_round_the_normal_and_keeps_its_length() {
        let mut worst: f64 = 0.0;
        for n in 0..2000_i32 {
            let bits = [0x2545_f491, 0x6c07_8965, 0x1f12_3bb5].map(|c: i32| c.wrapping_mul(n + 1));
            let [x, y, z] = bits.map(|c| Real::from_bits(c >> 6));
            let along_u = Vec3::new(y >> 1, -z, x >> 2);
            let Some(normal) = Vec3::new(x, y, z).normalised() else { continue };
            let point =
                SurfacePoint { normal, chart: Chart { along_u, ..Chart::default() }, ..placed([0; 3]) };
            let angle = Angle::from_bits(n as u32 * 2_147_480);
            let got = turned(&point, angle).chart.along_u;
            let got = [got.x, got.y, got.z].map(|c| c.to_num::<f64>());
            // Rodrigues' formula for what lies across the normal
            let [n, p] = [
                [normal.x, normal.y, normal.z].map(|c| c.to_num::<f64>()),
                [along_u.x, along_u.y, along_u.z].map(|c| c.to_num::<f64>()),
            ];
            let along: f64 = n.iter().zip(p).map(|(n, p)| n * p).sum();
            let flat: [f64; 3] = core::array::from_fn(|i| p[i] - along * n[i]);
            let side = [
                n[1] * flat[2] - n[2] * flat[1],
                n[2] * flat[0] - n[0] * flat[2],
                n[0] * flat[1] - n[1] * flat[0],
            ];
            let (sine, cosine) = (angle.to_num::<f64>() * core::f64::consts::TAU).sin_cos();
            for i in 0..3 {
                worst = worst.max((got[i] - (cosine * flat[i] + sine * side[i])).abs());
            }
        }
        assert!(worst > 2_f64.powi(-25) && worst < 2_f64.powi(-21), "{worst:e}");
    }

    #[test]
    fn a_grain_is_looked_up_and_a_highlight_follows_it() {
        let quarter = Angle::from_bits(1 << 30);
        let threads = Checker::squares([Real::from_num(2); 2], (), ());
        let [even, odd] = [0.1, 0.6].map(|u| charted(Real::from_num(u), Real::from_num(0.1)));
        assert_eq!(
            (threads.turn(&even), threads.turn(&odd), quarter.turn(&even)),
            (Angle::ZERO, quarter, quarter)
        );
        let image = Image::new(Texels::Linear, 2, 1, &[0, 51]).unwrap();
        assert!((image.turn(&odd).to_num::<f64>() - 0.2).abs() < 1e-4 && image.turn(&even) == 0);
        let turbulence = Turbulence::new(Noise::PERLIN, Real::from_num(3), 3).unwrap();
        let streaks = (turbulence, Unit::from_num(0.5));
        let exact = turbulence.at(odd.place).to_num::<f64>() * 0.5;
        let off = streaks.turn(&odd).to_num::<f64>() - exact;
        assert!((off - off.round()).abs() < 1e-8 && exact != 0.0);

        // along the grain the slopes deviate little, across it much
        let model = Anisotropic::new(Unit::from_num(0.05), Unit::from_num(0.5)).unwrap();
        let cloth = Mixture::matt(Rgb::BLACK).with_highlight(Rgb::WHITE, model);
        let framed = Framed { material: cloth, grain: threads };
        let up = Unit::ONE;
        let down = Vec3::new(Unit::ZERO, Unit::ZERO, -up);
        let towards = Vec3::new(Real::from_num(0.4), Real::ZERO, Real::ONE).normalised().unwrap();
        let light =
            |point| framed.respond(point, down, core::iter::once(Lit { towards, light: Rgb::WHITE })).light.g;
        assert!(light(&odd) > light(&even) + light(&even), "{} {}", light(&odd), light(&even));
        assert!(framed.is_charted() && framed.normal(&odd) == odd.normal);
        assert!(framed.medium().is_none() && framed.passes() == Rgb::BLACK);
    }
}
