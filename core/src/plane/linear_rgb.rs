//! The light of a pixel, in a picture with colours.

use crate::num::Rgb;

/// Light of a pixel in 3 times 16 bits, linear: 0 is none, 65535 the white of a display.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LinearRgb {
    /// 65535 times the red part.
    pub r: u16,
    /// 65535 times the green part.
    pub g: u16,
    /// 65535 times the blue part.
    pub b: u16,
}

impl LinearRgb {
    /// From 65535 times the parts.
    pub const fn new(r: u16, g: u16, b: u16) -> Self {
        Self { r, g, b }
    }
}

/// What a display can show of a light: each part at most 1, rounded to nearest.
impl From<Rgb> for LinearRgb {
    #[inline]
    fn from(light: Rgb) -> Self {
        let part = |bits: u32| {
            let bits = bits.min(1 << 16);
            // times 65535 / 65536
            (bits - ((bits + (1 << 15)) >> 16)) as u16
        };
        Self::new(part(light.r.to_bits()), part(light.g.to_bits()), part(light.b.to_bits()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Lumen;

    #[test]
    fn a_pixel_has_the_nearest_part_of_65535_and_is_cut_off_at_white() {
        for bits in [0, 1, 77, 0x7fff, 0x8000, 0x8001, 0xffff, 0x1_0000, 0x1_0001, u32::MAX] {
            let exact = (f64::from(bits).min(65536.0) * 65535.0 / 65536.0).round();
            let got = LinearRgb::from(Rgb::new(Lumen::from_bits(bits), Lumen::ZERO, Lumen::ONE));
            assert!(
                (f64::from(got.r) - exact).abs() <= f64::from(u8::from(bits == 0x8000)),
                "{bits}: {got:?}"
            );
            assert_eq!((got.g, got.b), (0, u16::MAX));
        }
    }
}
