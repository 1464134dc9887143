//! What a highlight is: light that leaves a surface near the direction in which it is mirrored.

use super::super::surface::SurfacePoint;
use crate::num::{Lumen, Unit, Vec3, unit};

/// From where a point is looked at: unit vectors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sight {
    /// The normal that light sees, against the ray.
    pub normal: Vec3<Unit>,
    /// The direction of the ray.
    pub direction: Vec3<Unit>,
    /// Along the grain of the surface, at right angles to the normal; any such direction where the point has
    /// no texture coordinates, and none for a model that does not look at it.
    pub tangent: Vec3<Unit>,
}

/// A model of highlights.
pub trait Specular {
    /// Whether it looks at the grain.
    fn is_charted(&self) -> bool {
        false
    }

    /// The part of the light from the unit direction `towards`, above the surface, that is seen: none where
    /// the normal is turned away from the eye, if the model asks how far the eye stands above the surface.
    fn part(&self, view: &Sight, towards: Vec3<Unit>) -> Lumen;
}

/// No highlight.
impl Specular for () {
    fn part(&self, _: &Sight, _: Vec3<Unit>) -> Lumen {
        Lumen::ZERO
    }
}

impl Sight {
    /// Of a point with this normal, looked at in this direction; without a tangent for who does not look at
    /// it.
    #[inline]
    pub(super) fn new(point: &SurfacePoint, direction: Vec3<Unit>, is_charted: bool) -> Self {
        let normal = point.normal;
        let tangent = if is_charted { Self::grain(point, normal) } else { Vec3::default() };
        Self { normal, direction, tangent }
    }

    /// The unit vector along the grain of a point with this normal.
    fn grain(point: &SurfacePoint, normal: Vec3<Unit>) -> Vec3<Unit> {
        let grain = point.chart.along_u;
        // at right angles to the normal: what of the grain lies along it is taken off
        let bits = [grain.x, grain.y, grain.z].map(|c| i64::from(c.to_bits()));
        let n = [normal.x, normal.y, normal.z].map(|c| i64::from(c.to_bits()));
        let along = bits.iter().zip(n).map(|(g, n)| (g * n) >> 30).sum::<i64>();
        let mut tangent = [0; 3];
        for ((t, g), n) in tangent.iter_mut().zip(bits).zip(n) {
            // no longer than the grain: below 2^32
            *t = ((g - ((along * n) >> 30)) >> 1) as i32;
        }
        unit(tangent)
    }

    /// The unit vector half way between the eye and a light.
    pub(super) fn half(&self, towards: Vec3<Unit>) -> Vec3<Unit> {
        let half = |l: Unit, d: Unit| (l.to_bits() >> 1).wrapping_sub(d.to_bits() >> 1);
        let d = self.direction;
        unit([half(towards.x, d.x), half(towards.y, d.y), half(towards.z, d.z)])
    }

    /// How far the eye stands above the surface: `n . v`, at least `2^-12`. None where the normal is turned
    /// away from the eye, as bumps may turn it.
    pub(super) fn height(&self) -> Option<Unit> {
        let height = self.normal.dot(self.direction).saturating_neg();
        (height > 0).then(|| height.clamp(Unit::from_bits(1 << 18), Unit::ONE))
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::num::Real;
    use std::vec::Vec;

    pub(crate) fn floats(v: Vec3<Unit>) -> [f64; 3] {
        [v.x, v.y, v.z].map(|c| c.to_num())
    }

    pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    /// Views from above a surface, each with a light above it: at random, and near the mirrored direction.
    pub(crate) fn views() -> Vec<(Sight, Vec3<Unit>)> {
        let mut word = 5_u64;
        let mut random = || {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            Real::from_bits((word >> 38) as i32 - (1 << 25))
        };
        let mut all = Vec::new();
        while all.len() < 4000 {
            let vector = Vec3::new(random(), random(), random());
            let (Some(normal), Some(eye)) =
                (vector.normalised(), Vec3::new(random(), random(), random()).normalised())
            else {
                continue;
            };
            let direction = if eye.dot(normal) > 0 { Vec3::new(-eye.x, -eye.y, -eye.z) } else { eye };
            let mut towards = Vec3::new(random(), random(), random());
            if all.len() % 2 == 0 {
                let m = super::super::super::snell::mirrored(direction, normal);
                let near = |m: Unit, r: Real| Real::from_bits((m.to_bits() >> 4) + (r.to_bits() >> 3));
                towards = Vec3::new(near(m.x, towards.x), near(m.y, towards.y), near(m.z, towards.z));
            }
            let Some(towards) = towards.normalised().filter(|l| l.dot(normal) > 0.02) else { continue };
            if direction.dot(normal) > -0.02 {
                continue;
            }
            // not along the normal, where a grain tells little
            if normal.x.abs() > 0.9 {
                continue;
            }
            let chart = crate::trace::Chart { along_u: Vec3::X, ..Default::default() };
            let origin = Vec3::new(Real::ZERO, Real::ZERO, Real::ZERO);
            let width = Real::ZERO;
            let point = SurfacePoint {
                position: origin,
                place: origin,
                normal,
                inward: false,
                chart,
                face: 0,
                width,
            };
            all.push((Sight::new(&point, direction, true), towards));
        }
        all
    }

    /// `h` as the definition has it.
    pub(crate) fn half_of(view: &Sight, towards: Vec3<Unit>) -> [f64; 3] {
        let (d, l) = (floats(view.direction), floats(towards));
        let h: [f64; 3] = core::array::from_fn(|k| l[k] - d[k]);
        h.map(|c| c / dot(h, h).sqrt())
    }

    #[test]
    fn a_frame_is_at_right_angles_and_of_unit_length() {
        for (view, towards) in views() {
            // each component is known to 2^-23, and 0.43 and more of the grain lies across the normal
            let (n, t) = (floats(view.normal), floats(view.tangent));
            assert!(
                dot(n, t).abs() < 2_f64.powi(-21) && (dot(t, t) - 1.0).abs() < 2_f64.powi(-26),
                "{view:?}"
            );
            for (got, exact) in floats(view.half(towards)).into_iter().zip(half_of(&view, towards)) {
                // a sum of 0.04 and more, known to 2^-29
                assert!((got - exact).abs() < 2_f64.powi(-24));
            }
        }
    }

    #[test]
    fn what_turns_away_from_the_eye_does_not_shine() {
        use super::super::{anisotropic::Anisotropic, torrance_sparrow::TorranceSparrow};
        let (rough, grain) =
            (TorranceSparrow::new(Unit::ONE, Unit::ONE), Anisotropic::new(Unit::ONE, Unit::ONE));
        let (rough, grain) = (rough.unwrap(), grain.unwrap());
        let (mut shone, mut turned) = (0, 0);
        for (view, towards) in views() {
            let d = view.direction;
            let behind = Sight { direction: Vec3::new(-d.x, -d.y, -d.z), ..view };
            let parts = |view| [rough.part(view, towards), grain.part(view, towards)];
            shone += u32::from(parts(&view).iter().all(|part| *part > Lumen::ZERO));
            assert_eq!(parts(&behind), [Lumen::ZERO; 2]);
            turned += u32::from(behind.height().is_none() && view.height().is_some());
        }
        assert!(shone > 3000 && turned == 4000, "{shone} {turned}");
    }
}
