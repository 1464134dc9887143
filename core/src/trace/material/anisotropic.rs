//! The highlight of a surface with a grain, as brushed metal, cloth or wood.
//!
//! `sqrt((n . l) / (n . v)) exp(-((h . T / s)^2 + (h . B / q)^2) / (h . n)^2) / (4 s q)`, `T` along the grain
//! and `B` across, `s` and `q` how far slopes deviate along each. Without the `1 / pi` that diffuse light
//! lacks here too.
//!
//! Source: G. J. Ward, "Measuring and modeling anisotropic reflection", 1992, eq. 5a. What the course unit V,
//! section 5.8, calls frame mapping turns `T`.

use super::super::environment::between;
use super::specular::{Sight, Specular};
use crate::Error;
use crate::num::{Lumen, Real, Unit, Vec3, Wide, exp_minus, ratio, sqrt};

/// A highlight that is long across the grain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Anisotropic {
    /// `1 / s` and `1 / q`, 16 fractional bits.
    along: u32,
    across: u32,
}

impl Anisotropic {
    /// A highlight whose slopes deviate by `along` the grain and `across` it, each 1/32 to 1.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a roughness outside that range.
    pub fn new(along: Unit, across: Unit) -> Result<Self, Error> {
        between("roughness along the grain", None, along.into(), Wide::ONE >> 5, Wide::ONE)?;
        between("roughness across the grain", None, across.into(), Wide::ONE >> 5, Wide::ONE)?;
        let over = |u: Unit| ratio(1 << 30, 16, u.to_bits().unsigned_abs().into()) as u32;
        Ok(Self { along: over(along), across: over(across) })
    }
}

impl Specular for Anisotropic {
    fn is_charted(&self) -> bool {
        true
    }

    fn part(&self, view: &Sight, towards: Vec3<Unit>) -> Lumen {
        let Some(eye) = view.height() else { return Lumen::ZERO };
        let half = view.half(towards);
        let across = view.normal.cross(view.tangent);
        let up = half.dot(view.normal).clamp(Unit::ZERO, Unit::ONE).to_bits().unsigned_abs();
        let magnitude = |v: Vec3<Unit>| u64::from(half.dot(v).to_bits().unsigned_abs());
        // slopes over what they deviate by: 30 + 16 fractional bits to 16
        let slope = |v: Vec3<Unit>, over: u32| {
            let scaled = (magnitude(v) * u64::from(over)) >> 16;
            ratio(scaled, 16, u64::from(up.max(1))).min(1 << 24)
        };
        let (s, q) = (slope(view.tangent, self.along), slope(across, self.across));
        // below 2^49: 32 fractional bits to 24
        let exponent = (s * s + q * q) >> 8;
        let Some(exponent) = i32::try_from(exponent).ok() else { return Lumen::ZERO };
        let e = u64::from(exp_minus(Real::from_bits(exponent)).to_bits().unsigned_abs());
        let light = u64::from(view.normal.dot(towards).clamp(Unit::ZERO, Unit::ONE).to_bits().unsigned_abs());
        // the root of the quotient, 16 fractional bits, at most 2^6
        let root = u64::from(sqrt(ratio(light, 32, eye.to_bits().unsigned_abs().into())));
        // 1 / (4 s q), 16 fractional bits, at most 2^8
        let over = (u64::from(self.along) * u64::from(self.across)) >> 18;
        // 30 + 16 bits to 24, and again: below 2^24 2^6 2^24
        let part = (((e * root) >> 22) * over) >> 24;
        Lumen::from_bits(u32::try_from(part).unwrap_or(u32::MAX))
    }
}

#[cfg(test)]
mod tests {
    use super::super::specular::tests::{dot, floats, half_of, views};
    use super::*;

    /// Relative to the value where it exceeds 1.
    #[test]
    fn wards_highlight_is_within_two_to_the_minus_10() {
        let (mut worst, mut bright) = (0.0_f64, 0);
        for (s, q) in [(1.0, 1.0), (0.5, 0.125), (0.0625, 0.25), (0.03125, 0.03125)] {
            let model = Anisotropic::new(Unit::from_num(s), Unit::from_num(q)).unwrap();
            for (view, towards) in views() {
                let (n, t, l, h) =
                    (floats(view.normal), floats(view.tangent), floats(towards), half_of(&view, towards));
                let b = [n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2], n[0] * t[1] - n[1] * t[0]];
                let (nv, nl) = (-dot(n, floats(view.direction)), dot(n, l));
                let e = ((dot(h, t) / s).powi(2) + (dot(h, b) / q).powi(2)) / dot(h, n).powi(2);
                let exact = (nl / nv).sqrt() * (-e).exp() / (4.0 * s * q);
                let off = (model.part(&view, towards).to_num::<f64>() - exact).abs() / exact.max(1.0);
                worst = worst.max(off);
                bright += u32::from(exact > 0.5);
            }
        }
        assert!(
            worst < 2_f64.powi(-10) && worst > 2_f64.powi(-18) && bright > 1000,
            "2^{} {bright}",
            worst.log2()
        );
    }

    #[test]
    fn a_grain_is_refused_outside_its_ranges() {
        let new = |s: i32, q: i32| Anisotropic::new(Unit::from_bits(s), Unit::from_bits(q)).is_ok();
        assert!(new(1 << 25, 1 << 30) && new(1 << 30, 1 << 25));
        assert!(!new((1 << 25) - 1, 1 << 28) && !new(1 << 28, (1 << 30) + 1));
    }
}
