//! How many bits of a product an orbit keeps, and which number of them a view needs.

use super::dwell::{self, Coarse, Fine, Word};
use crate::num::Wide;

/// The width of an orbit's arithmetic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Precision {
    /// Points have 29 fractional bits, products 26: high words only.
    Coarse26,
    /// Points and products have 29 fractional bits.
    Fine29,
}

impl Precision {
    /// What suits pixels at this distance.
    pub(super) fn of(pitch: Wide, max: u32) -> Self {
        const COARSE_PITCH: Wide = Wide::lit("0x1p-10");
        if pitch >= COARSE_PITCH && max <= 256 { Self::Coarse26 } else { Self::Fine29 }
    }

    #[inline(always)]
    pub(super) fn dwell(self, z: Word, c: Word, max: u32) -> u32 {
        match self {
            Self::Coarse26 => dwell::dwell::<Coarse>(z, c, max),
            Self::Fine29 => dwell::dwell::<Fine>(z, c, max),
        }
    }
}
