//! The highlight of a surface of tiny mirrors that lean at random: `F D G / (4 n . v)`.
//!
//! With `h` half way between eye and light: how many mirrors face that way,
//! `D = exp(-tan^2 a / s^2) / (s^2 cos^4 a)`, `cos a = n . h` (Beckmann's distribution, `s` the roughness);
//! how many of them are not in each other's way, `G = min(1, 2 (n . h)(n . v) / (v . h), 2 (n . h)(n . l) /
//! (v . h))`; how much they reflect, `F = f + (1 - f) (1 - v . h)^5` (Schlick's approximation of Fresnel's
//! equations, `f` at right angles). Diffuse light is `n . l` here, so that `D` is without its `1 / pi`.
//!
//! Source: K. E. Torrance, E. M. Sparrow, "Theory for off-specular reflection from roughened surfaces", 1967;
//! R. L. Cook, K. E. Torrance, 1982. Cochran, Lewis, Hart, section 4.

use super::super::environment::between;
use super::super::power::times;
use super::specular::{Sight, Specular};
use crate::Error;
use crate::num::{Lumen, Real, Unit, Vec3, Wide, exp_minus, reciprocal};

/// A highlight by roughness and reflectance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TorranceSparrow {
    /// The square of the roughness.
    square: Unit,
    reflectance: Unit,
}

impl TorranceSparrow {
    /// The highlight of mirrors whose slopes deviate by `roughness`, 1/32 to 1, and reflect `reflectance` of
    /// what meets them at right angles.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a roughness outside that range or a reflectance outside `[0, 1]`.
    pub fn new(roughness: Unit, reflectance: Unit) -> Result<Self, Error> {
        between("roughness", None, roughness.into(), Wide::ONE >> 5, Wide::ONE)?;
        between("reflectance", None, reflectance.into(), Wide::ZERO, Wide::ONE)?;
        Ok(Self { square: times(roughness, roughness), reflectance })
    }

    /// The same of any numbers, brought into their ranges.
    pub(crate) fn within(roughness: Unit, reflectance: Unit) -> Self {
        let roughness = roughness.clamp(Unit::ONE >> 5, Unit::ONE);
        let reflectance = reflectance.clamp(Unit::ZERO, Unit::ONE);
        Self { square: times(roughness, roughness), reflectance }
    }

    /// The part of the light that is seen, at most 1; none of a light below the surface.
    pub(crate) fn tone(&self, view: &Sight, towards: Vec3<Unit>) -> Unit {
        if view.normal.dot(towards) <= 0 {
            return Unit::ZERO;
        }
        let part = self.part(view, towards).to_bits().min(1 << 16);
        Unit::from_bits((part << 14) as i32)
    }

    /// `D`, 20 fractional bits, saturated: at most 2^10 and a little.
    fn facing(&self, cos: Unit) -> u64 {
        let square = times(cos, cos);
        // where tan^2 a > 31, less than 2^-44 of them face that way
        if square.to_bits() < 1 << 25 {
            return 0;
        }
        let bits = |u: Unit| u.to_bits().unsigned_abs();
        let (mantissa, shift) = reciprocal(bits(times(square, self.square)).max(1));
        // tan^2 a / s^2 = (1 - cos^2) / (s^2 cos^2), 24 fractional bits
        let sine = u64::from(bits(Unit::ONE.saturating_sub(square)));
        let exponent = (sine * u64::from(mantissa)) >> ((shift - 24) & 63);
        let Some(exponent) = i32::try_from(exponent).ok() else { return 0 };
        let e = u64::from(bits(exp_minus(Real::from_bits(exponent))));
        // e / (s^2 cos^2), then over cos^2 again
        let part = (e * u64::from(mantissa)) >> ((shift - 20) & 63);
        let (mantissa, shift) = reciprocal(bits(square));
        (part.min(u64::from(u32::MAX)) * u64::from(mantissa)) >> ((shift - 30) & 63)
    }
}

impl Specular for TorranceSparrow {
    fn part(&self, view: &Sight, towards: Vec3<Unit>) -> Lumen {
        let half = view.half(towards);
        let a = view.normal.dot(half).clamp(Unit::ZERO, Unit::ONE);
        seen(view, towards, half, self.reflectance, self.facing(a))
    }
}

/// `F D G / (4 n . v)` where `facing`, `D` with 20 fractional bits, of the mirrors face `half`.
pub(super) fn seen(
    view: &Sight,
    towards: Vec3<Unit>,
    half: Vec3<Unit>,
    reflectance: Unit,
    facing: u64,
) -> Lumen {
    let clamped = |u: Unit| u.clamp(Unit::ZERO, Unit::ONE);
    let [a, light] = [half, towards].map(|v| clamped(view.normal.dot(v)));
    let Some(eye) = view.height() else { return Lumen::ZERO };
    let between = clamped(view.direction.dot(half).saturating_neg());
    // 2 (n . h) min(n . v, n . l) / (v . h), 30 fractional bits, at most 1
    let (mantissa, shift) = reciprocal(between.to_bits().unsigned_abs());
    let product = u64::from(times(a, eye.min(light)).to_bits().unsigned_abs());
    let shadowed = ((2 * product * u64::from(mantissa >> 1)) >> ((shift - 31) & 63)).min(1 << 30);
    // over 4 (n . v), 24 fractional bits, at most 2^10
    let (mantissa, shift) = reciprocal(eye.to_bits().unsigned_abs());
    let part = (shadowed * u64::from(mantissa)) >> ((shift - 22) & 63);
    let off = Unit::ONE.saturating_sub(between);
    let square = times(off, off);
    let fifth = times(times(square, square), off);
    let fresnel = reflectance + times(Unit::ONE.saturating_sub(reflectance), fifth);
    // `(n . h) / (v . h)` is below 2^8 where `D` is not 0: what is cut off is beyond any light
    let part = (part * u64::from(fresnel.to_bits().unsigned_abs())) >> 30;
    let part = (part.min(1 << 32) * facing.min(1 << 31)) >> 28;
    Lumen::from_bits(u32::try_from(part).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::super::specular::tests::{dot, floats, half_of, views};
    use super::*;

    fn exact(view: &Sight, towards: Vec3<Unit>, s: f64, f: f64) -> f64 {
        let (n, l, h) = (floats(view.normal), floats(towards), half_of(view, towards));
        let v = floats(view.direction).map(|c| -c);
        let (a, nv, nl, vh) = (dot(n, h), dot(n, v), dot(n, l), dot(v, h));
        let tan2 = 1.0 / (a * a) - 1.0;
        let d = (-tan2 / (s * s)).exp() / (s * s * a.powi(4));
        let g = (2.0 * a * nv / vh).min(2.0 * a * nl / vh).min(1.0);
        (f + (1.0 - f) * (1.0 - vh).powi(5)) * d * g / (4.0 * nv)
    }

    /// Relative to the value where it exceeds 1.
    #[test]
    fn the_highlight_of_tiny_mirrors_is_within_two_to_the_minus_12() {
        let (mut worst, mut bright) = (0.0_f64, 0);
        for (s, f) in [(1.0, 0.04), (0.5, 0.9), (0.2, 0.5), (0.0625, 0.3), (0.03125, 1.0)] {
            let model = TorranceSparrow::new(Unit::from_num(s), Unit::from_num(f)).unwrap();
            for (view, towards) in views() {
                let exact = exact(&view, towards, s, f);
                let off = (model.part(&view, towards).to_num::<f64>() - exact).abs() / exact.max(1.0);
                worst = worst.max(off);
                bright += u32::from(exact > 0.5);
            }
        }
        assert!(
            worst < 2_f64.powi(-12) && worst > 2_f64.powi(-18) && bright > 2000,
            "2^{} {bright}",
            worst.log2()
        );
    }

    /// With the eye and the light exchanged, the same light is seen for the same light that arrives:
    /// `part / (n . l)` is symmetric.
    #[test]
    fn reflection_is_reciprocal() {
        let model = TorranceSparrow::new(Unit::from_num(0.4), Unit::from_num(0.6)).unwrap();
        let (mut tried, mut worst) = (0, 0.0_f64);
        for (view, towards) in views() {
            let minus = |v: Vec3<Unit>| Vec3::new(-v.x, -v.y, -v.z);
            let back = Sight { direction: minus(towards), ..view };
            let (nl, nv) = (floats(view.normal), floats(view.normal));
            let (nl, nv) = (dot(nl, floats(towards)), -dot(nv, floats(view.direction)));
            let there = model.part(&view, towards).to_num::<f64>() / nl;
            let here = model.part(&back, minus(view.direction)).to_num::<f64>() / nv;
            if nl > 0.1 && nv > 0.1 {
                worst = worst.max((there - here).abs() / there.max(1.0));
                tried += 1;
            }
        }
        assert!(worst < 1e-3 && tried > 2000, "{worst} {tried}");
    }

    /// No more light leaves than arrives: the integral over the light's directions is at most the
    /// reflectance.
    #[test]
    fn no_light_is_made() {
        let up = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE);
        let mut most = 0.0_f64;
        for s in [0.125, 0.3, 1.0] {
            let model = TorranceSparrow::new(Unit::from_num(s), Unit::ONE).unwrap();
            for slant in [0.0, 0.5, 0.9] {
                let direction = Vec3::new(
                    Unit::from_num(slant),
                    Unit::ZERO,
                    -Unit::from_num((1.0_f64 - slant * slant).sqrt()),
                );
                let view =
                    Sight { normal: up, direction, tangent: Vec3::new(Unit::ONE, Unit::ZERO, Unit::ZERO) };
                let (n, mut sum) = (100, 0.0);
                // equal solid angles
                for i in 0..n {
                    for j in 0..n {
                        let z = (f64::from(i) + 0.5) / f64::from(n);
                        let (r, a) = (
                            (1.0 - z * z).sqrt(),
                            (f64::from(j) + 0.5) / f64::from(n) * core::f64::consts::TAU,
                        );
                        let [x, y, z] = [r * a.cos(), r * a.sin(), z].map(Unit::from_num);
                        sum += model.part(&view, Vec3::new(x, y, z)).to_num::<f64>();
                    }
                }
                // 2 pi over n^2 directions, and the pi that is left out of diffuse light
                most = most.max(sum * 2.0 / f64::from(n * n));
            }
        }
        assert!(most < 1.001 && most > 0.8, "{most}");
    }

    #[test]
    fn a_rough_surface_is_refused_outside_its_ranges() {
        let new = |s: i32, f: i32| TorranceSparrow::new(Unit::from_bits(s), Unit::from_bits(f)).is_ok();
        assert!(new(1 << 25, 0) && new(1 << 30, 1 << 30));
        assert!(
            !new((1 << 25) - 1, 0)
                && !new((1 << 30) + 1, 0)
                && !new(1 << 28, -1)
                && !new(1 << 28, (1 << 30) + 1)
        );
    }
}
