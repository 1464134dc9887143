//! The square `z = 0`, `|x|, |y| <= 1`, and under an affine map any parallelogram. Open: `z > 0` is its upper
//! side. Texture coordinates are `u = (1 + x) / 2`, `v = (1 + y) / 2`.

use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::plane::height_over;
use super::shape::{NearCrossing, NearRay, Shape, corners};
use crate::num::{Near, Real, Vec3, Wide, product};

/// The generic square.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Square;

impl Square {
    pub(super) const BOUNDS: Option<[Vec3<Near>; 2]> = Some(corners([-1, -1, 0], [1, 1, 0]));
    pub(super) const ERROR: Near = Near::from_bits(8);
}

impl Shape for Square {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        Self::BOUNDS
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn most_crossings(&self) -> u32 {
        1
    }

    fn error(&self) -> Near {
        Self::ERROR
    }

    /// Error: on the plane within `2^-25` (`rays_meet_the_square_where_they_should`). Cost: kernel `square`.
    #[inline]
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let (o, d) = (ray.origin, ray.direction);
        let Some(s) = height_over(o.z.to_bits(), d.z.to_bits()) else { return };
        // twice as far as from -1 to 1, and less than a word
        let inside = |o: Near, d: Near| {
            let c = i64::from(o.to_bits()) + (product(d.to_bits(), s) >> 28);
            (c + (1 << 28)) as u64 <= 2 << 28
        };
        if s >= from.to_bits() && inside(o.x, d.x) && inside(o.y, d.y) {
            let _ = found(NearCrossing { s: Near::from_bits(s), enters: d.z < 0, face: 0 });
        }
    }

    fn value(&self, place: Vec3) -> Wide {
        place.z.into()
    }

    fn normal(&self, _: Vec3<Near>, _: u8) -> Vec3<Near> {
        Vec3::new(Near::ZERO, Near::ZERO, Near::ONE)
    }

    fn chart(&self, place: Vec3<Real>, _: u8) -> Chart {
        let half = |c: Real| (c >> 1) + Real::ONE / 2;
        let two = Real::ONE * 2;
        let along_u = Vec3::new(two, Real::ZERO, Real::ZERO);
        Chart { u: half(place.x), v: half(place.y), along_u, along_v: Vec3::new(Real::ZERO, two, Real::ZERO) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::judge::{crossings, rays};
    use super::*;

    /// How many rays were judged, how many met it, and how far from it.
    fn judged(count: usize) -> (u32, u32, f64) {
        let (mut tried, mut met, mut worst): (u32, u32, f64) = (0, 0, 0.0);
        for (k, ray) in rays(19).take(count).enumerate() {
            let [o, d] = [ray.origin, ray.direction].map(|v| [v.x, v.y, v.z].map(|c| c.to_num::<f64>()));
            let from = if k % 2 == 0 { Near::MIN } else { Near::ZERO };
            let got = crossings(&Square, &ray, from);
            let s = -o[2] / d[2];
            let reach = [0, 1].map(|k: usize| (o[k] + s * d[k]).abs() - 1.0);
            // near the rim, where it begins, or at the end of the format
            let nearly = |a: f64| a.abs() < 2_f64.powi(-20) * (1.0 + s.abs()) / d[2].abs().min(1.0);
            if d[2] != 0.0 && (reach.into_iter().any(nearly) || nearly(s) || (s.abs() - 8.0).abs() < 1e-5) {
                continue;
            }
            tried += 1;
            let met_it = s.abs() < 8.0 && s >= from.to_num::<f64>() && reach.iter().all(|r| *r < 0.0);
            assert_eq!(got.len(), usize::from(met_it), "{ray:?}: {s} {reach:?}");
            for crossing in got {
                met += 1;
                worst = worst.max((o[2] + crossing.s.to_num::<f64>() * d[2]).abs());
                assert_eq!((crossing.enters, crossing.face), (d[2] < 0.0, 0));
            }
        }
        (tried, met, worst)
    }

    #[test]
    fn rays_meet_the_square_where_they_should() {
        // every crossing that `cross` hands over is judged
        let (tried, met, worst) = judged(30_000);
        assert!(tried > 25_000 && met > 6_000, "{tried} {met}");
        assert!(worst > 2_f64.powi(-28) && worst < 2_f64.powi(-25), "{worst:e}");
    }

    /// `cargo test -p attractor --lib -- --ignored rays_meet_the_square`
    #[test]
    #[ignore = "a million rays"]
    fn a_million_rays_meet_the_square_where_they_should() {
        let (tried, _, worst) = judged(1_000_000);
        assert!(tried > 850_000 && worst < 2_f64.powi(-25), "{tried} {worst:e}");
    }
}
