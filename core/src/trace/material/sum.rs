//! The light of all lamps together, as a material adds it up: a product and a sum in one instruction.
//!
//! `sum L p`, each product rounded to nearest in the upper word; then `pigment sum + color sum` in 64 bits,
//! rounded once. What lamps give is cut off at `2^14`, where a part of it is a word; sums saturate at `2^15`.
//!
//! Formats: parts of at most 1 with 31 fractional bits, so that 1 is `1 - 2^-31`, which rounds to the same;
//! light with 17, sums with 16.

use crate::num::formats::{Q16, Q17, Q31};
use crate::num::{Lumen, Rgb, Unit, high_rounded, product_u};

/// Light of one lamp, below `2^14`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Light([Q17; 3]);

/// The greatest, less what would leave a word.
const MOST: u32 = (1 << 30) - 1;

/// A part of at most 1.
#[inline(always)]
pub(super) fn whole_or_less(part: Lumen) -> Q31 {
    (part.to_bits() as i32).saturating_mul(1 << 15)
}

/// The product of two parts, to nearest, with a bit more.
#[inline(always)]
pub(super) fn part(a: Unit, b: Unit) -> Q31 {
    twice(Unit::from_bits(high_rounded(twice(a), twice(b))))
}

/// A part of at most 1 with a bit more.
#[inline(always)]
pub(super) fn twice(part: Unit) -> Q31 {
    part.to_bits().saturating_add(part.to_bits())
}

impl Light {
    #[inline(always)]
    pub(super) fn new(light: Rgb) -> Self {
        let Rgb { r, g, b } = light;
        let all = [r, g, b].map(Lumen::to_bits);
        if (all[0] | all[1] | all[2]) > MOST {
            return Self(all.map(cut));
        }
        Self(all.map(|c| (c << 1) as i32))
    }

    /// More of it: a part above 1.
    #[cold]
    #[inline(never)]
    pub(super) fn brighter(self, part: Lumen) -> Self {
        let Self(all) = self;
        let bright = |c: Q17| (product_u(c as u32, part.to_bits()) >> 17).min(MOST.into()) as u32;
        Self(all.map(|c| (bright(c) << 1) as i32))
    }
}

#[cold]
#[inline(never)]
fn cut(c: u32) -> Q17 {
    (c.min(MOST) << 1) as i32
}

/// A sum of light.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sum([Q16; 3]);

impl Sum {
    /// A part of white, 0 to 1, to begin with.
    #[inline(always)]
    pub(super) fn of(part: Unit) -> Self {
        Self([(part.to_bits() + (1 << 13)) >> 14; 3])
    }

    /// And this part of a lamp's light.
    #[inline(always)]
    pub(super) fn add(&mut self, light: Light, part: Q31) {
        let (Self([r, g, b]), Light(light)) = (*self, light);
        let added = |sum: Q16, light: Q17| sum.saturating_add(high_rounded(light, part));
        *self = Self([added(r, light[0]), added(g, light[1]), added(b, light[2])]);
    }
}

/// What is seen of sums of light, each through a colour: to the nearest, saturated.
#[inline(always)]
pub(super) fn lit<const N: usize>(parts: [(Rgb, Sum); N]) -> Rgb {
    // two products of 32 and 31 bits, and half a unit
    let mut all = [1_u64 << 15; 3];
    for (color, Sum(sum)) in parts {
        let color = [color.r, color.g, color.b].map(Lumen::to_bits);
        for ((all, color), sum) in all.iter_mut().zip(color).zip(sum) {
            *all = all.wrapping_add(product_u(color, sum as u32));
        }
    }
    let [r, g, b] = all;
    let [r, g, b] = if (r | g | b) >> 48 > 0 {
        all.map(saturated)
    } else {
        all.map(|sum| Lumen::from_bits(((sum >> 32) as u32) << 16 | (sum as u32) >> 16))
    };
    Rgb::new(r, g, b)
}

#[cold]
#[inline(never)]
fn saturated(sum: u64) -> Lumen {
    Lumen::from_bits(u32::try_from(sum >> 16).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(bits: u32) -> Rgb {
        Rgb::grey(Lumen::from_bits(bits))
    }

    /// Against 128-bit integers, at the ends of the formats too: each product to the nearest, halves upwards.
    #[test]
    fn sums_of_light_are_the_nearest_and_saturate() {
        let lights = [0, 1, 3, 0x7fff, 0x1_0000, 0x1_0001, 123_456_789, MOST, 1 << 30, u32::MAX];
        let parts = [0, 1, 1 << 13, 1 << 29, 0x2aaa_aaab, (1 << 30) - 1, 1 << 30];
        let (mut saturated, mut tried) = (0, 0);
        for light in lights {
            let exact = i128::from(light.min(MOST));
            for part in parts {
                let mut sum = Sum::of(Unit::from_bits(1 << 28));
                let mut want = 1_i128 << 14;
                for _ in 0..3 {
                    sum.add(Light::new(grey(light)), twice(Unit::from_bits(part)));
                    want = (want + ((exact * i128::from(part) + (1 << 29)) >> 30)).min(i128::from(i32::MAX));
                }
                for color in [0, 1, 0x8000, 0x1_0000, 0x1_2345, u32::MAX] {
                    let seen = (want * i128::from(color) + (1 << 15)) >> 16;
                    let seen = seen.min(i128::from(u32::MAX));
                    assert_eq!(lit([(grey(color), sum)]), grey(seen as u32), "{light} {part} {color}");
                    let twice = ((2 * want * i128::from(color) + (1 << 15)) >> 16).min(i128::from(u32::MAX));
                    assert_eq!(lit([(grey(color), sum); 2]), grey(twice as u32), "{light} {part} {color}");
                    saturated += u32::from(twice == i128::from(u32::MAX));
                    tried += 1;
                }
            }
            for part in [0x1_0001, 0x3_0000, u32::MAX] {
                let Light([bright, ..]) = Light::new(grey(light)).brighter(Lumen::from_bits(part));
                let want = ((exact * i128::from(part)) >> 16).min(i128::from(MOST));
                assert_eq!(i128::from(bright), 2 * want, "{light} {part}");
            }
        }
        assert!(tried == 420 && (20..300).contains(&saturated), "{tried} {saturated}");
    }
}
