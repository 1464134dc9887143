//! Phong's highlight: `(m . l)^e`, `m` the mirrored ray.
//!
//! Source: B. T. Phong, "Illumination for computer generated pictures", 1975; the course unit V, section 5.9.

use super::super::power::power;
use super::super::snell::mirrored;
use super::specular::{Sight, Specular};
use crate::num::{Lumen, Unit, Vec3};

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
        let cos = mirrored(view.direction, view.normal).dot(towards).clamp(Unit::ZERO, Unit::ONE);
        Lumen::from_bits((power(cos, self.shininess).to_bits() as u32 + (1 << 13)) >> 14)
    }
}

#[cfg(test)]
mod tests {
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
