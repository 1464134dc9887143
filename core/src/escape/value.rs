//! What a pixel of an escape-time picture holds: the dwell of its orbit, or the period of the cycle that the
//! orbit is drawn to.

use core::num::NonZeroU32;

use crate::Error;

/// The greatest `Num` that a picture may ask for.
pub const MAX_DWELL: u32 = 1 << 20;

/// The dwell of an orbit, and the limit that it was given.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Dwell {
    /// Iterations until the orbit exceeded 2, at most `max`.
    pub count: u32,
    /// `Num`, the number of iterations after which nobody waits any longer; at least 1.
    pub max: u32,
}

impl Dwell {
    /// Whether the orbit did not escape in time, and so counts as part of the set.
    pub const fn is_inside(self) -> bool {
        self.count >= self.max
    }
}

/// The longest cycle that is looked for.
pub const MAX_PERIOD: u32 = 256;

/// The length of the cycle that an orbit is drawn to: 1 for a fixed point, at most [`MAX_PERIOD`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Period(pub(crate) NonZeroU32);

impl Period {
    /// A period of so many points; none for 0.
    pub const fn new(length: u32) -> Option<Self> {
        match NonZeroU32::new(length) {
            Some(length) => Some(Self(length)),
            None => None,
        }
    }

    /// How many points the cycle has.
    pub const fn length(self) -> u32 {
        self.0.get()
    }
}

/// # Errors
/// [`Error::TooFew`] for 0, [`Error::Capacity`] above [`MAX_DWELL`].
pub(crate) fn checked_max(max: u32) -> Result<u32, Error> {
    let what = "iterations a pixel";
    if max == 0 {
        return Err(Error::TooFew { what, given: 0, at_least: 1 });
    }
    if max > MAX_DWELL {
        return Err(Error::Capacity { what, needed: max as usize, capacity: MAX_DWELL as usize });
    }
    Ok(max)
}
