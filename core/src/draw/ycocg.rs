//! Luma and chroma as a colour.
//!
//! `t = Y - g`, `R = t + o`, `G = Y + g`, `B = t - o`, with `o = Co - 128` and `g = Cg - 128`, cut off.
//! Source: H. Malvar, G. Sullivan, "YCoCg-R: a color space with RGB reversibility and low dynamic range",
//! 2003;
//! here without its last bits.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::palette::Palette;

/// The palette of decoded images in colour: `[Y, Co, Cg]`, of 16 bits the upper 8.
///
/// ```
/// use attractor::draw::{Palette, YCoCg, hex};
/// assert_eq!(YCoCg.rgb([100_u8, 138, 148]), hex(0x5a7846));
/// assert_eq!(YCoCg.rgb([0x6400_u16, 0x8000, 0x80ff]), hex(0x646464));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct YCoCg;

impl Palette<[u8; 3]> for YCoCg {
    #[inline]
    fn rgb(&self, value: [u8; 3]) -> Rgb888 {
        let [luma, orange, green] = value.map(i16::from);
        let (orange, green) = (orange - 128, green - 128);
        let [r, g, b] =
            [luma - green + orange, luma + green, luma - green - orange].map(|v| v.clamp(0, 255) as u8);
        Rgb888::new(r, g, b)
    }
}

impl Palette<[u16; 3]> for YCoCg {
    #[inline]
    fn rgb(&self, value: [u16; 3]) -> Rgb888 {
        self.rgb(value.map(|v| (v >> 8) as u8))
    }
}
