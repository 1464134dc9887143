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
use super::specular::{Specular, View, times};
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

    /// `D`, 16 fractional bits, saturated.
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
        // e / (s^2 cos^2), then over cos^2 again; each time at most 32 times, or 2^15, larger
        let part = (e * u64::from(mantissa)) >> ((shift - 16) & 63);
        let (mantissa, shift) = reciprocal(bits(square));
        (part.min(u64::from(u32::MAX)) * u64::from(mantissa)) >> ((shift - 30) & 63)
    }
}

impl Specular for TorranceSparrow {
    fn part(&self, view: &View, towards: Vec3<Unit>) -> Lumen {
        let half = view.half(towards);
        let clamped = |u: Unit| u.clamp(Unit::ZERO, Unit::ONE);
        let [a, light] = [half, towards].map(|v| clamped(view.normal.dot(v)));
        let (eye, between) = (view.height(), clamped(view.direction.dot(half).saturating_neg()));
        // 2 (n . h) min(n . v, n . l) / (v . h), 30 fractional bits, at most 1
        let (mantissa, shift) = reciprocal(between.to_bits().unsigned_abs());
        let product = u64::from(times(a, eye.min(light)).to_bits().unsigned_abs());
        let shadowed = ((2 * product * u64::from(mantissa >> 1)) >> ((shift - 31) & 63)).min(1 << 30);
        // over 4 (n . v): 16 fractional bits
        let (mantissa, shift) = reciprocal(eye.to_bits().unsigned_abs());
        let part = (shadowed * u64::from(mantissa)) >> ((shift - 14) & 63);
        let off = Unit::ONE.saturating_sub(between);
        let square = times(off, off);
        let fifth = times(times(square, square), off);
        let fresnel = self.reflectance + times(Unit::ONE.saturating_sub(self.reflectance), fifth);
        let facing = self.facing(a).min(u64::from(u32::MAX));
        let part = (part.min(1 << 27) * u64::from(fresnel.to_bits().unsigned_abs())) >> 30;
        let part = (part.min(1 << 31) * facing) >> 16;
        Lumen::from_bits(u32::try_from(part).unwrap_or(u32::MAX))
    }
}
