//! The arithmetics that orbits are computed in, and which of them a view needs: the deeper a view, the more
//! bits tell its pixels apart, and the slower an iteration.

use super::dwell::{self, Coarse, Fine, Point29, Rounding};
use crate::num::Wide;

/// How orbits are computed: in words of a fixed width, or by their small distance from one of them.
///
/// Cost of an iteration: 10 Cortex-M4 instructions (kernel `dwell coarse`) in `Word26`, 13 (kernel
/// `dwell fine`) in `Word29`, 58.3 (kernel `dwell 64`) in `Word64`, 259 (kernel `dwell 128`) in `Word128`. By
/// perturbation a step takes 202.3 (kernel `perturbed`), in 62 bits 815 (kernel `perturbed long`), and a
/// point of the reference orbit in 12 limbs 8584 (kernel `reference orbit`); but most iterations of a deep
/// view are jumped over: at a width of 1e-100 a dwell costs 11.3 (kernel `perturbed jumping`) an iteration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Arithmetic {
    /// Points have 29 fractional bits, products 26: high words only. The default of a
    /// [`View`](crate::escape::View) for a pitch of at least `2^-10` and at most 256 iterations.
    Word26,
    /// Points and products have 29 fractional bits. The default for every other
    /// [`View`](crate::escape::View).
    Word29,
    /// Q4.60. The default of a [`DeepView`](crate::escape::DeepView) for a pitch of at least `2^-44` and at
    /// most 1024 iterations.
    Word64,
    /// Q4.124: the default for a pitch of at least `2^-104`, `2^-72` beyond 1024 iterations.
    Word128,
    /// One reference orbit, and blocks of 30 bits for the distance of each pixel from it: the default for
    /// deeper views up to 4096 iterations.
    Perturbed,
    /// The same with blocks of 62 bits: the default for deeper views and more iterations. Each point of the
    /// orbit takes two [`OrbitPoint`](crate::escape::OrbitPoint)s.
    PerturbedLong,
}

impl Arithmetic {
    /// What suits a deep view whose pitch is `2^exponent` and more, and so many iterations: the dwells of at
    /// most 3 pixels in 1000 differ from arbitrary precision, at spirals, small copies, needles and between
    /// seahorses (`the_default_arithmetic_is_right_where_it_ends`, tests/deep_zoom.rs). Orbits of thousands
    /// of iterations depend on bits far behind a pixel.
    pub const fn of(exponent: i32, max_dwell: u32) -> Self {
        match (exponent, max_dwell) {
            (-44.., ..=1024) => Self::Word64,
            (-72.., _) | (-104.., ..=1024) => Self::Word128,
            (_, ..=4096) => Self::Perturbed,
            _ => Self::PerturbedLong,
        }
    }

    /// How many points a reference orbit of so many iterations takes: the length of the memory to lend. None
    /// is needed where nothing is perturbed.
    pub const fn orbit_points(self, max_dwell: u32) -> usize {
        let steps = if max_dwell < 2 { 2 } else { max_dwell as usize };
        match self {
            Self::Perturbed => steps,
            Self::PerturbedLong => 2 * steps,
            _ => 0,
        }
    }

    /// What suits a view in 32-bit words: the loss of 3 bits changes fewer than 1 pixel in 1000
    /// (`a_dyadic_grid_agrees_with_248_bits`).
    pub(crate) fn of_word(pitch: Wide, max: u32) -> Self {
        const COARSE_PITCH: Wide = Wide::lit("0x1p-10");
        if pitch >= COARSE_PITCH && max <= 256 { Self::Word26 } else { Self::Word29 }
    }

    /// The dwell in 32-bit words: 29 bits but for `Word26`.
    #[inline(always)]
    pub(crate) fn dwell(self, z: Point29, c: Point29, max: u32) -> u32 {
        match self {
            Self::Word26 => dwell::dwell::<Coarse>(z, c, max),
            _ => dwell::dwell::<Fine>(z, c, max),
        }
    }

    /// The next point of the orbit whose dwell this is.
    #[inline]
    pub(crate) fn next(self, z: Point29, c: Point29) -> Point29 {
        match self {
            Self::Word26 => Coarse::next(z, c),
            _ => Fine::next(z, c),
        }
    }
}
