//! How many bits of a product an orbit keeps, and which number of them a view needs.

use super::dwell::{self, Coarse, Fine, Step, Word};
use crate::num::Wide;

/// The width of an orbit's arithmetic.
///
/// Cost of an iteration: 10 Cortex-M4 instructions (kernel `dwell coarse`) in `Coarse26`, 13 (kernel `dwell fine`) in
/// `Fine29`. Deeper views take wider words: see [`Arithmetic`](super::Arithmetic).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Precision {
    /// Points have 29 fractional bits, products 26: high words only. The default for a pitch of at least `2^-10` and at most 256 iterations.
    Coarse26,
    /// Points and products have 29 fractional bits. The default for every other view.
    Fine29,
}

impl Precision {
    /// What suits pixels at this distance: the loss of 3 bits changes fewer than 1 pixel in 1000 (`a_dyadic_grid_agrees_with_248_bits`).
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

    /// The next point of the orbit whose dwell this is.
    #[inline]
    pub(super) fn next(self, z: Word, c: Word) -> Word {
        match self {
            Self::Coarse26 => Coarse::next(z, c),
            Self::Fine29 => Fine::next(z, c),
        }
    }
}
