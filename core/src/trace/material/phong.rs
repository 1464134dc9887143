//! Phong's highlight: `(m . l)^e`, `m` the mirrored ray.
//!
//! Source: B. T. Phong, "Illumination for computer generated pictures", 1975; the course unit V, section 5.9.

use super::specular::{Sight, Specular};
use crate::num::formats::{Q30, UQ32};
use crate::num::{Lumen, Unit, Vec3, high_u, product, rounded_down};

/// A highlight as small as its exponent is large.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Phong {
    /// The exponent.
    pub shininess: u16,
}

impl Specular for Phong {
    #[inline]
    fn part(&self, view: &Sight, towards: Vec3<Unit>) -> Lumen {
        // m . l = d . l - 2 (d . n) (n . l)
        let [along, light] = [view.direction, towards].map(|v| view.normal.dot(v).to_bits());
        let cos: Q30 = (view.direction.dot(towards).to_bits())
            .wrapping_sub(rounded_down::<29>(product(along, light)))
            .clamp(0, (1 << 30) - 1);
        let part = power((cos as u32) << 2, self.shininess);
        Lumen::from_bits((part >> 16) + (part >> 15 & 1))
    }
}

/// `base^exponent` by squaring, of a base below 1, upper words alone.
///
/// Error: below `2^-32` times the exponent, and `2^-27` (`a_power_is_within_its_exponents_units`).
#[inline(always)]
fn power(base: UQ32, exponent: u16) -> UQ32 {
    let (mut result, mut square, mut rest) = (u32::MAX, base, exponent);
    while rest > 0 {
        if rest & 1 == 1 {
            result = high_u(result, square);
        }
        square = high_u(square, square);
        rest >>= 1;
    }
    result
}

#[cfg(test)]
mod tests {
    /// Against double precision, of bases from 0 to nearly 1 and all kinds of exponents.
    #[test]
    fn a_power_is_within_its_exponents_units() {
        let (mut worst, mut bright) = (0.0_f64, 0);
        for k in 0..4_000_u32 {
            // many close to 1
            let base = if k % 2 == 0 { k.wrapping_mul(0x9e37_79b9) } else { u32::MAX - (k << (k % 20)) };
            for exponent in [0, 1, 2, 3, 10, 32, 77, 250, 1_000, 65_535_u16] {
                let exact = (f64::from(base) / 2_f64.powi(32)).powi(exponent.into());
                let got = f64::from(power(base, exponent)) / 2_f64.powi(32);
                let unit = f64::from(exponent) * 2_f64.powi(-32) + 2_f64.powi(-27);
                worst = worst.max((got - exact).abs() / unit);
                bright += u32::from(exact > 0.1);
            }
        }
        assert!(worst < 1.0 && worst > 0.2 && bright > 15_000, "{worst} {bright}");
    }

    use super::super::specular::tests::{dot, floats, views};
    use super::*;

    #[test]
    fn phongs_highlight_is_within_two_to_the_minus_16() {
        let (mut worst, mut bright) = (0.0_f64, 0);
        for (view, towards) in views() {
            let (d, n) = (floats(view.direction), floats(view.normal));
            let m: [f64; 3] = core::array::from_fn(|k| d[k] - 2.0 * dot(d, n) * n[k]);
            for shininess in [0, 1, 10, 64] {
                let exact = dot(m, floats(towards)).max(0.0).powi(shininess.into());
                let got = Phong { shininess }.part(&view, towards).to_num::<f64>();
                worst = worst.max((got - exact).abs());
                bright += u32::from(exact > 0.5);
            }
        }
        assert!(worst < 2_f64.powi(-16) && worst > 2_f64.powi(-18) && bright > 2000, "{worst:e} {bright}");
    }
}
