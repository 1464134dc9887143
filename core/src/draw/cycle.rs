//! Palettes on counts, whose colours come round again: pictures of deep windows have dwells of thousands,
//! which one pass through a palette would not tell apart.

use core::num::NonZeroU32;

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

use super::level::{Level, Leveled};
use super::palette::Palette;

/// Winds a palette of levels round the counts: `level = ((count + offset) mod period) / period`.
///
/// Move the offset from frame to frame and the colours flow; the kernel's values stay the same. A palette
/// whose ends meet ([`gradients::PORCELAIN`](crate::draw::gradients::PORCELAIN)) shows no seam. Values inside
/// the set stay black.
///
/// ```
/// use attractor::draw::{Cycled, Palette, gradients};
///
/// let palette = Cycled::new(gradients::PORCELAIN, 32);
/// assert_eq!(palette.rgb(5_u32), palette.rgb(37_u32));
/// assert_eq!(palette.with_offset(3).rgb(5_u32), palette.rgb(8_u32));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cycled<P> {
    palette: P,
    period: NonZeroU32,
    offset: u32,
}

impl<P> Cycled<P> {
    /// Once through `palette` every `period` counts; 0 counts as 1.
    pub const fn new(palette: P, period: u32) -> Self {
        let period = match NonZeroU32::new(period) {
            Some(period) => period,
            None => NonZeroU32::MIN,
        };
        Self { palette, period, offset: 0 }
    }

    /// The same, moved by `offset` counts.
    pub fn with_offset(mut self, offset: u32) -> Self {
        self.offset = offset % self.period;
        self
    }

    /// The palette that is wound round.
    pub const fn palette(&self) -> &P {
        &self.palette
    }
}

impl<V: Leveled, P: Palette<Level>> Palette<V> for Cycled<P> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        if value.is_inside() {
            return Rgb888::BLACK;
        }
        let count = value.count() % self.period;
        // offset < period: no overflow
        let to_the_end = self.period.get().wrapping_sub(self.offset);
        let count = if count >= to_the_end { count - to_the_end } else { count.wrapping_add(self.offset) };
        self.palette.rgb(Level::ratio(count, self.period.get()))
    }
}

/// A list of colours, one a count, over and over: the bands of classic dwell pictures. Values inside the set
/// are black.
///
/// ```
/// use attractor::draw::{Palette, Ramp, hex};
///
/// const BANDS: Ramp<2> = Ramp::new([hex(0x003049), hex(0xfcbf49)]);
/// assert_eq!(BANDS.rgb(7_u32), hex(0xfcbf49));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ramp<const N: usize> {
    colors: [Rgb888; N],
}

impl<const N: usize> Ramp<N> {
    /// These colours, the first for the count 0. `N > 0` is checked at compile time.
    pub const fn new(colors: [Rgb888; N]) -> Self {
        const { assert!(N > 0, "a ramp has at least one colour") };
        Self { colors }
    }
}

impl Ramp<6> {
    /// Six colours of a palette, without its darkest fifth: for periods, 1 the first of them.
    pub fn of_periods(palette: impl Palette<Level>) -> Self {
        // periods begin at 1, which gets the first colour: the last one is at 0, where the count 6 comes
        let fifth = |k: usize| Level::ratio((k as u32 + 5) % 6, 5).to_bits() / 5 * 4;
        Self { colors: core::array::from_fn(|k| palette.rgb(Level::from_bits(fifth(k) + 13_000))) }
    }
}

impl<V: Leveled, const N: usize> Palette<V> for Ramp<N> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        if value.is_inside() {
            return Rgb888::BLACK;
        }
        let index = (value.count() as usize).checked_rem(N).unwrap_or(0);
        self.colors.get(index).copied().unwrap_or(Rgb888::BLACK)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::{Grey, hex};

    #[test]
    fn the_cycle_closes_for_every_period_and_offset() {
        for period in [0, 1, 2, 7, 256, 65_537, u32::MAX] {
            for offset in [0, 1, 6, 255, u32::MAX] {
                let palette =
                    Cycled::new(|level: Level| hex(u32::from(level.to_bits())), period).with_offset(offset);
                for count in [0, 1, 5, 300, u32::MAX - 1, u32::MAX] {
                    let period = u64::from(period.max(1));
                    let phase = (u64::from(count) + u64::from(offset)) % period;
                    let expected = hex(u32::from(Level::ratio(phase as u32, period as u32).to_bits()));
                    assert_eq!(palette.rgb(count), expected, "{count} + {offset} mod {period}");
                }
            }
        }
    }

    #[test]
    fn the_inside_does_not_cycle() {
        assert_eq!(Cycled::new(|_: Level| Rgb888::RED, 5).rgb(None::<u32>), Rgb888::BLACK);
        assert_eq!(Ramp::new([Rgb888::RED]).rgb(None::<u32>), Rgb888::BLACK);
        assert_eq!(Cycled::new(Grey, 5).rgb(Some(10_u32)), Rgb888::BLACK);
    }

    #[test]
    fn a_ramp_repeats() {
        let ramp = Ramp::new([hex(1), hex(2), hex(3)]);
        for count in 0..20_u32 {
            assert_eq!(ramp.rgb(count), hex(1 + count % 3));
        }
    }
}
