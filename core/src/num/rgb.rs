//! Light by its three parts, red, green and blue: what lamps give, surfaces reflect and rays carry.
//!
//! The parts are linear, as light adds up, and may exceed 1, which is the white of a display: two lamps are
//! twice as bright as one. A display's pixel is what is left when they are cut off at 1.
//!
//! Format: 16 fractional bits and 16 before the point, saturated.

use super::formats::{Lumen, Unit};

/// Light, or how much of it passes, by red, green and blue.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rgb {
    /// Red.
    pub r: Lumen,
    /// Green.
    pub g: Lumen,
    /// Blue.
    pub b: Lumen,
}

impl Rgb {
    /// No light.
    pub const BLACK: Self = Self::grey(Lumen::ZERO);
    /// The white of a display.
    pub const WHITE: Self = Self::grey(Lumen::ONE);

    /// Red, green and blue.
    pub const fn new(r: Lumen, g: Lumen, b: Lumen) -> Self {
        Self { r, g, b }
    }

    /// The same of each.
    pub const fn grey(part: Lumen) -> Self {
        Self::new(part, part, part)
    }

    /// The same of each, from a tone in `[0, 1]` (clamped), to the nearest.
    pub fn from_tone(tone: Unit) -> Self {
        let bits = tone.clamp(Unit::ZERO, Unit::ONE).to_bits() as u32;
        Self::grey(Lumen::from_bits((bits + (1 << 13)) >> 14))
    }

    /// Both together, saturated.
    #[inline]
    pub fn plus(self, other: Self) -> Self {
        let sum = Lumen::saturating_add;
        Self::new(sum(self.r, other.r), sum(self.g, other.g), sum(self.b, other.b))
    }

    /// What passes of this light where `part` of each passes: the products, to the nearest, saturated.
    #[inline]
    pub fn through(self, part: Self) -> Self {
        Self::new(product(self.r, part.r), product(self.g, part.g), product(self.b, part.b))
    }

    /// `part` of this light: the products, to the nearest, saturated; none for a negative part.
    #[inline]
    pub fn scaled(self, part: Unit) -> Self {
        let part = part.max(Unit::ZERO).to_bits().unsigned_abs();
        let Self { r, g, b } = self;
        if (r | g | b).to_bits() >> 30 == 0 {
            // half a unit of the upper word more
            let scaled = |c: Lumen| {
                Lumen::from_bits(((u64::from(c.to_bits() << 2) * u64::from(part) + (1 << 31)) >> 32) as u32)
            };
            return Self::new(scaled(r), scaled(g), scaled(b));
        }
        let part = u64::from(part);
        let scaled = |c: Lumen| {
            let product = u64::from(c.to_bits()) * part + (1 << 29);
            Lumen::from_bits(if product >> 62 > 0 { u32::MAX } else { (product >> 30) as u32 })
        };
        Self::new(scaled(self.r), scaled(self.g), scaled(self.b))
    }

    /// The greatest of the three.
    #[inline]
    pub fn brightest(self) -> Lumen {
        self.r.max(self.g).max(self.b)
    }

    /// `self + (other - self) part`, each part to the nearest, for a part in `[0, 1]` (clamped).
    #[inline]
    pub fn mixed(self, other: Self, part: Unit) -> Self {
        let part = part.clamp(Unit::ZERO, Unit::ONE);
        self.scaled(Unit::ONE - part).plus(other.scaled(part))
    }
}

#[inline]
fn product(a: Lumen, b: Lumen) -> Lumen {
    // (2^32 - 1)^2 leaves room for half a unit
    let product = (u64::from(a.to_bits()) * u64::from(b.to_bits())).wrapping_add(1 << 15);
    Lumen::from_bits(if product >> 48 > 0 { u32::MAX } else { (product >> 16) as u32 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(bits: u32) -> Rgb {
        Rgb::grey(Lumen::from_bits(bits))
    }

    /// Against 128-bit integers: the nearest, saturated.
    #[test]
    fn products_are_the_nearest_and_saturate() {
        let values = [0, 1, 2, 0x7fff, 0x8000, 0xffff, 0x1_0000, 0x1_0001, 123_456_789, u32::MAX];
        for a in values {
            for b in values {
                let exact = (u128::from(a) * u128::from(b) + (1 << 15)) >> 16;
                assert_eq!(grey(a).through(grey(b)), grey(exact.min(u128::from(u32::MAX)) as u32), "{a} {b}");
                assert_eq!(grey(a).plus(grey(b)), grey(a.saturating_add(b)));
            }
            for part in [-1, 0, 1, 1 << 29, (1 << 30) - 1, 1 << 30, i32::MAX] {
                let exact = (u128::from(a) * part.max(0) as u128 + (1 << 29)) >> 30;
                let exact = exact.min(u128::from(u32::MAX)) as u32;
                assert_eq!(grey(a).scaled(Unit::from_bits(part)), grey(exact), "{a} {part}");
            }
        }
    }

    #[test]
    fn a_mixture_lies_between_and_has_both_ends() {
        let (dark, bright) = (grey(77), Rgb::WHITE);
        assert_eq!(dark.mixed(bright, Unit::ZERO), dark);
        assert_eq!(dark.mixed(bright, Unit::ONE), bright);
        assert_eq!(Rgb::BLACK.mixed(bright, Unit::from_bits(1 << 29)), grey(1 << 15));
        assert_eq!(dark.mixed(bright, -Unit::ONE), dark);
        assert_eq!((Rgb::from_tone(Unit::ONE), Rgb::from_tone(-Unit::ONE)), (Rgb::WHITE, Rgb::BLACK));
        let odd = Rgb::new(Lumen::from_bits(3), Lumen::from_bits(9), Lumen::from_bits(4));
        assert_eq!(odd.brightest(), Lumen::from_bits(9));
    }
}
