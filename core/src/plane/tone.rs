//! How bright a pixel is, in a picture without colours.

/// Brightness of a pixel in 16 bits: 0 is black, 65535 white.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tone(u16);

impl Tone {
    /// The tone `bits / 65535`.
    #[inline]
    pub const fn from_bits(bits: u16) -> Self {
        Self(bits)
    }

    /// 65535 times the tone.
    #[inline]
    pub const fn to_bits(self) -> u16 {
        self.0
    }
}
