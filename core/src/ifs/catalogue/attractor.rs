//! What an entry of the catalogue says, and the probabilities that several of them share.

use crate::Error;
use crate::ifs::affine::{Affine, ratio};
use crate::ifs::system::Ifs;
use crate::num::Unit;

/// A named iterated function system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Attractor {
    /// Lower case, words joined by hyphens: what [`find`](super::find) looks for.
    pub name: &'static str,
    /// What it is called in print.
    pub title: &'static str,
    /// Where the maps were published.
    pub source: &'static str,
    /// The maps.
    pub maps: &'static [Affine],
    /// The probability of each map.
    #[cfg_attr(feature = "defmt", defmt(Debug2Format))]
    pub probabilities: &'static [Unit],
}

impl Attractor {
    /// The system of its maps; `N` is [`LARGEST`](super::LARGEST) for those of the catalogue whose number of
    /// maps is not known beforehand.
    ///
    /// # Errors
    /// As [`Ifs::new`]; for those of the catalogue only [`Error::Capacity`] when it has more than `N` maps.
    pub fn ifs<const N: usize>(&self) -> Result<Ifs<N>, Error> {
        Ifs::new(self.maps, self.probabilities)
    }
}

/// As many equal probabilities.
pub(super) const fn equal<const N: usize>() -> [Unit; N] {
    over([1; N], N as i32)
}

/// Probabilities over a common denominator.
pub(super) const fn over<const N: usize>(numerators: [i32; N], denominator: i32) -> [Unit; N] {
    let mut shares = [Unit::ZERO; N];
    let mut i = 0;
    while i < N {
        shares[i] = Unit::from_bits(ratio(numerators[i], denominator, 30));
        i += 1;
    }
    shares
}
