//! Phong's highlight: `(m . l)^e`, `m` the mirrored ray.
//!
//! Source: B. T. Phong, "Illumination for computer generated pictures", 1975; the course unit V, section 5.9.

use super::super::snell::mirrored;
use super::specular::{Specular, View, times};
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
    fn part(&self, view: &View, towards: Vec3<Unit>) -> Lumen {
        let cos = mirrored(view.direction, view.normal).dot(towards).clamp(Unit::ZERO, Unit::ONE);
        let (mut result, mut square, mut rest) = (Unit::ONE, cos, self.shininess);
        while rest > 0 {
            if rest & 1 == 1 {
                result = times(result, square);
            }
            square = times(square, square);
            rest >>= 1;
        }
        Lumen::from_bits((result.to_bits() as u32 + (1 << 13)) >> 14)
    }
}
