//! A level: where a value lies on a scale from 0 to 1. Palettes are functions of a level, so that one palette
//! serves every kernel.
//!
//! Format: 16 bits, `0..=65535` for `0..=1`.

use crate::escape::{Dwell, FractionalDwell, MAX_PERIOD, Period};
use crate::num::Real;
use crate::plane::Hits;
use crate::plane::Tone;

/// A fraction from 0 to 1 in steps of 1/65535.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Level(u16);

impl Level {
    /// 0.
    pub const ZERO: Self = Self(0);
    /// 1.
    pub const FULL: Self = Self(u16::MAX);

    /// The level `bits / 65535`.
    #[inline]
    pub const fn from_bits(bits: u16) -> Self {
        Self(bits)
    }

    /// 65535 times the level.
    #[inline]
    pub const fn to_bits(self) -> u16 {
        self.0
    }

    /// `part / whole`.
    ///
    /// Domain: all; 1 where `part > whole`, 0 where `whole` is 0. Error: half a step
    /// (`a_ratio_is_rounded_to_the_nearest_step`).
    /// Cost: one 32-bit division while both are below 65536, else one 64-bit division.
    #[inline]
    pub const fn ratio(part: u32, whole: u32) -> Self {
        if part >= whole {
            return if whole == 0 { Self::ZERO } else { Self::FULL };
        }
        if whole <= 0xffff {
            // 65534 * 65535 + 32767 < 2^32
            match (part * 0xffff + whole / 2).checked_div(whole) {
                Some(level) => Self(level as u16),
                None => Self::ZERO,
            }
        } else {
            match (part as u64 * 0xffff + whole as u64 / 2).checked_div(whole as u64) {
                Some(level) => Self(level as u16),
                None => Self::ZERO,
            }
        }
    }
}

/// A value with a place on a scale: what the palettes of this crate can colour.
///
/// A value of your own needs one method:
///
/// ```
/// use attractor::draw::{Level, Leveled, Palette, gradients};
///
/// #[derive(Clone, Copy)]
/// struct Celsius(i8);
///
/// impl Leveled for Celsius {
///     fn level(&self) -> Level {
///         Level::ratio((i32::from(self.0) + 40).max(0) as u32, 100)
///     }
/// }
///
/// assert_eq!(gradients::FIRE.rgb(Celsius(60)), gradients::FIRE.rgb(Level::FULL));
/// ```
pub trait Leveled {
    /// The place on the scale from 0 to 1.
    fn level(&self) -> Level;

    /// The place on an open scale of counts, which [`Cycled`](crate::draw::Cycled) and
    /// [`Ramp`](crate::draw::Ramp) wind round. Without an implementation of its own: the level's 16 bits.
    #[inline]
    fn count(&self) -> u32 {
        u32::from(self.level().0)
    }

    /// Whether the value lies off the scale because the point belongs to the set: an orbit that never
    /// escaped. The palettes of this crate paint it black; [`Inside`](crate::draw::Inside) paints it
    /// otherwise.
    #[inline]
    fn is_inside(&self) -> bool {
        false
    }
}

impl Leveled for Level {
    #[inline]
    fn level(&self) -> Level {
        *self
    }
}

impl Leveled for bool {
    #[inline]
    fn level(&self) -> Level {
        if *self { Level::FULL } else { Level::ZERO }
    }
}

/// 255 is 1.
impl Leveled for u8 {
    #[inline]
    fn level(&self) -> Level {
        Level(u16::from(*self) * 257)
    }

    #[inline]
    fn count(&self) -> u32 {
        u32::from(*self)
    }
}

impl Leveled for Tone {
    #[inline]
    fn level(&self) -> Level {
        Level(self.to_bits())
    }
}

/// The level is the share of the limit; a point that never escaped is inside.
impl Leveled for Dwell {
    #[inline]
    fn level(&self) -> Level {
        Level::ratio(self.count, self.max)
    }

    #[inline]
    fn count(&self) -> u32 {
        self.count
    }

    #[inline]
    fn is_inside(&self) -> bool {
        Dwell::is_inside(*self)
    }
}

/// The level is the share of the limit; the count is in steps of `1 / FractionalDwell::STEPS`, so that a
/// palette that comes round shows no bands.
impl Leveled for FractionalDwell {
    #[inline]
    fn level(&self) -> Level {
        // 11 fractional bits and a limit of at most 2^20: the same shift on both sides
        Level::ratio(self.dwell.to_bits(), self.max.saturating_mul(1 << 11))
    }

    #[inline]
    fn count(&self) -> u32 {
        // 11 fractional bits
        self.dwell.to_bits() / (2048 / FractionalDwell::STEPS)
    }

    #[inline]
    fn is_inside(&self) -> bool {
        FractionalDwell::is_inside(*self)
    }
}

/// The level is the share of the longest period; a point without one is off the scale, and black. Use it with
/// [`Ramp`](crate::draw::Ramp).
impl Leveled for Option<Period> {
    #[inline]
    fn level(&self) -> Level {
        Level::ratio(self.count(), MAX_PERIOD)
    }

    #[inline]
    fn count(&self) -> u32 {
        self.map_or(0, Period::length)
    }

    #[inline]
    fn is_inside(&self) -> bool {
        self.is_none()
    }
}

/// The level is the tone; a pixel without hits is off the scale.
impl Leveled for Hits {
    #[inline]
    fn level(&self) -> Level {
        Level(self.tone)
    }

    #[inline]
    fn count(&self) -> u32 {
        u32::from(self.count)
    }

    #[inline]
    fn is_inside(&self) -> bool {
        self.count == 0
    }
}

/// 65535 is 1.
impl Leveled for u16 {
    #[inline]
    fn level(&self) -> Level {
        Level(*self)
    }
}

/// The scale is the range of the type: use a count with [`Cycled`](crate::draw::Cycled) or
/// [`Ramp`](crate::draw::Ramp).
impl Leveled for u32 {
    #[inline]
    fn level(&self) -> Level {
        Level((*self >> 16) as u16)
    }

    #[inline]
    fn count(&self) -> u32 {
        *self
    }
}

/// 1 is 1; what is outside 0 to 1 saturates.
impl Leveled for Real {
    #[inline]
    fn level(&self) -> Level {
        let fraction = self.to_bits().clamp(0, 1 << 24) as u64;
        Level(((fraction * 0xffff + (1 << 23)) >> 24) as u16)
    }
}

/// `None` is inside.
impl<V: Leveled> Leveled for Option<V> {
    #[inline]
    fn level(&self) -> Level {
        self.as_ref().map_or(Level::FULL, V::level)
    }

    #[inline]
    fn count(&self) -> u32 {
        self.as_ref().map_or(u32::MAX, V::count)
    }

    #[inline]
    fn is_inside(&self) -> bool {
        self.as_ref().is_none_or(V::is_inside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_is_rounded_to_the_nearest_step() {
        for whole in [1_u32, 2, 3, 255, 1000, 65535, 65536, 65537, 1 << 20, u32::MAX] {
            for part in [0, 1, 2, whole / 3, whole / 2, whole - 1, whole] {
                let Level(level) = Level::ratio(part.min(whole), whole);
                let error = i128::from(level) * i128::from(whole) - i128::from(part.min(whole)) * 65535;
                assert!(2 * error.abs() <= i128::from(whole), "{part}/{whole}: {level}");
            }
        }
        assert_eq!(Level::ratio(7, 0), Level::ZERO);
        assert_eq!(Level::ratio(9, 4), Level::FULL);
    }

    #[test]
    fn the_ends_of_every_scale_are_0_and_1() {
        assert_eq!(0_u8.level(), Level::ZERO);
        assert_eq!(255_u8.level(), Level::FULL);
        assert_eq!(u32::MAX.level(), Level::FULL);
        assert_eq!(Real::MIN.level(), Level::ZERO);
        assert_eq!(Real::ONE.level(), Level::FULL);
        assert_eq!(Real::MAX.level(), Level::FULL);
        assert_eq!(Real::from_bits(1 << 23).level(), Level(32768));
        assert!(None::<u8>.is_inside() && !Some(7_u8).is_inside());
    }
}
