//! What a pixel of an escape-time picture holds.

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

/// # Errors
/// [`Error::TooFew`] for 0, [`Error::Capacity`] above [`MAX_DWELL`].
pub(super) fn checked_max(max: u32) -> Result<u32, Error> {
    let what = "iterations a pixel";
    if max == 0 {
        return Err(Error::TooFew { what, given: 0, at_least: 1 });
    }
    if max > MAX_DWELL {
        return Err(Error::Capacity { what, needed: max as usize, capacity: MAX_DWELL as usize });
    }
    Ok(max)
}
