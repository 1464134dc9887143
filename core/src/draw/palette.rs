//! Palettes: from a value to a colour that knows no display. What a display makes of that colour is
//! [`Ink`](crate::draw::Ink)'s business.

use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

use super::level::{Level, Leveled};
use crate::num::sqrt_short;

/// Turns a value into a display-independent colour.
///
/// Every `Fn(V) -> Rgb888` is a palette, and a type of your own becomes one:
///
/// ```
/// use attractor::draw::{Palette, Picture, hex};
/// use embedded_graphics::pixelcolor::Rgb888;
///
/// /// Land above a water line.
/// struct Atlas {
///     water: i16,
/// }
///
/// impl Palette<i16> for Atlas {
///     fn rgb(&self, height: i16) -> Rgb888 {
///         if height < self.water { hex(0x2a6f97) } else { hex(0x90a955) }
///     }
/// }
///
/// assert_eq!(Atlas { water: 3 }.rgb(2), hex(0x2a6f97));
/// let stripes = |height: i16| if height & 1 == 0 { Rgb888::new(0, 0, 0) } else { Rgb888::new(255, 255, 255) };
/// assert_eq!(stripes.rgb(2), hex(0x000000));
/// ```
///
/// The palettes of this crate accept every [`Leveled`] value, paint values inside the set black, and are
/// `Copy`. They also work by reference, and `&dyn Palette<V>` is a palette, for a choice at run time.
pub trait Palette<V> {
    /// The colour of `value`.
    fn rgb(&self, value: V) -> Rgb888;

    /// Whether displays show it by [`Ink::dithered_ink`](crate::draw::Ink::dithered_ink), true to its light,
    /// instead of [`Ink::ink`](crate::draw::Ink::ink). [`Srgb`](crate::draw::Srgb) asks for it, and
    /// [`Dithered`](crate::draw::Dithered) for any other palette.
    #[inline]
    fn is_dithered(&self) -> bool {
        false
    }
}

impl<V, F: Fn(V) -> Rgb888> Palette<V> for F {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        self(value)
    }
}

impl<V> Palette<V> for &dyn Palette<V> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        (**self).rgb(value)
    }

    #[inline]
    fn is_dithered(&self) -> bool {
        (**self).is_dithered()
    }
}

/// The colour `0xRRGGBB`.
pub const fn hex(rgb: u32) -> Rgb888 {
    Rgb888::new((rgb >> 16) as u8, (rgb >> 8) as u8, rgb as u8)
}

/// The course text's palette: dim blue near 0, through lilac to white; black inside the set.
///
/// Red = green = `v^2`, blue = `v + 0.2` for `v = dwell / Num`, clamped to 1. Source: CS2401 Computer
/// Graphics, unit V, 5.4.4, "Assigning colors according to the orbit's dwell".
///
/// ```
/// use attractor::draw::{CourseUnit, Palette, hex};
/// use attractor::escape::Dwell;
///
/// assert_eq!(CourseUnit.rgb(Dwell { count: 50, max: 100 }), hex(0x4040b3));
/// assert_eq!(CourseUnit.rgb(Dwell { count: 100, max: 100 }), hex(0x000000));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CourseUnit;

impl<V: Leveled> Palette<V> for CourseUnit {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        if value.is_inside() {
            return Rgb888::BLACK;
        }
        let v = u32::from(value.level().to_bits());
        // v^2 with 32 fractional bits; the largest is (1 - 2^-16)^2, rounded to 255 all the same
        let square = ((v * v) >> 16) * 255;
        let red = ((square + (1 << 15)) >> 16) as u8;
        let blue = ((v * 255 + (1 << 15)) >> 16) as u8;
        Rgb888::new(red, red, blue.saturating_add(51))
    }
}

/// Black to white; black inside the set.
///
/// ```
/// use attractor::draw::{Grey, Palette, hex};
///
/// assert_eq!(Grey.rgb(0x40_u8), hex(0x404040));
/// assert_eq!(Grey.rgb(true), hex(0xffffff));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Grey;

impl<V: Leveled> Palette<V> for Grey {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        if value.is_inside() {
            return Rgb888::BLACK;
        }
        // nearest of 256 levels: 255 / 65535 = 1 / 257
        let grey = ((u32::from(value.level().to_bits()) + 128) / 257) as u8;
        Rgb888::new(grey, grey, grey)
    }
}

/// Another palette, with a colour of one's own for the inside of the set.
///
/// ```
/// use attractor::draw::{Grey, Inside, Palette, hex};
///
/// let palette = Inside::new(Grey, hex(0x2d1e4f));
/// assert_eq!(palette.rgb(None::<u8>), hex(0x2d1e4f));
/// assert_eq!(palette.rgb(Some(0x40_u8)), hex(0x404040));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inside<P> {
    palette: P,
    color: Rgb888,
}

impl<P> Inside<P> {
    /// Paints values inside the set in `color` and all others as `palette` does.
    pub const fn new(palette: P, color: Rgb888) -> Self {
        Self { palette, color }
    }
}

impl<V: Leveled, P: Palette<V>> Palette<V> for Inside<P> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        if value.is_inside() { self.color } else { self.palette.rgb(value) }
    }
}

/// Another palette at the square root of the level, which makes dark pixels brighter: it spreads the low
/// levels, where most of a dwell picture lies.
///
/// Error: below one step of the level (`brightening_is_the_square_root_rounded_down`). Values inside the set
/// stay black.
///
/// ```
/// use attractor::draw::{Brightened, Grey, Level, Palette, hex};
///
/// assert_eq!(Brightened(Grey).rgb(Level::ratio(1, 4)), hex(0x7f7f7f));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Brightened<P>(pub P);

impl<V: Leveled, P: Palette<Level>> Palette<V> for Brightened<P> {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        if value.is_inside() {
            return Rgb888::BLACK;
        }
        let root = sqrt_short(u32::from(value.level().to_bits()) * u32::from(u16::MAX));
        self.0.rgb(Level::from_bits(root as u16))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::gradients;

    #[test]
    fn the_course_text_palette_is_v_squared_v_squared_v_plus_a_fifth() {
        for level in 0..=u16::MAX {
            let exact = u64::from(level);
            let square = (exact * exact * 255 * 2 + 65535 * 65535) / (2 * 65535 * 65535);
            let blue = ((exact * 255 * 2 + 65535) / (2 * 65535) + 51).min(255);
            let rgb = CourseUnit.rgb(Level::from_bits(level));
            assert!(
                u64::from(rgb.r()).abs_diff(square) <= 1 && u64::from(rgb.b()).abs_diff(blue) <= 1,
                "{level}"
            );
            assert_eq!(rgb.r(), rgb.g());
        }
        assert_eq!(CourseUnit.rgb(Level::ZERO), hex(0x000033));
        assert_eq!(CourseUnit.rgb(Level::FULL), hex(0xffffff));
        assert_eq!(CourseUnit.rgb(Option::<Level>::None), Rgb888::BLACK);
    }

    #[test]
    fn grey_inverts_the_scale_of_8_bits() {
        for value in 0..=u8::MAX {
            assert_eq!(Grey.rgb(value), Rgb888::new(value, value, value));
        }
    }

    #[test]
    fn the_inside_has_a_colour_of_its_own() {
        let palette = Inside::new(Grey, Rgb888::RED);
        assert_eq!(palette.rgb(None::<u8>), Rgb888::RED);
        assert_eq!(palette.rgb(Some(7_u8)), Grey.rgb(7_u8));
    }

    #[test]
    fn brightening_is_the_square_root_rounded_down() {
        let brightened = Brightened(|level: Level| hex(u32::from(level.to_bits())));
        for level in 0..=u16::MAX {
            let root = brightened.rgb(Level::from_bits(level));
            let root = u64::from(root.g()) << 8 | u64::from(root.b());
            let square = u64::from(level) * 65535;
            assert!(root * root <= square && square < (root + 1) * (root + 1), "{level}");
        }
        assert_eq!(brightened.rgb(Level::ZERO), hex(0));
        assert_eq!(brightened.rgb(Level::FULL), hex(65535));
        assert_eq!(brightened.rgb(Level::from_bits(1 << 14)), hex((1 << 15) - 1));
        assert_eq!(brightened.rgb(None::<Level>), Rgb888::BLACK);
    }

    #[test]
    fn closures_references_and_trait_objects_are_palettes() {
        fn first<V: Default, P: Palette<V>>(palette: P) -> Rgb888 {
            palette.rgb(V::default())
        }
        let closure = |value: u8| hex(u32::from(value));
        assert_eq!(first::<u8, _>(closure), Rgb888::BLACK);
        assert_eq!(first::<u8, _>(&closure), Rgb888::BLACK);
        assert_eq!(first::<u8, _>(&CourseUnit), hex(0x33));
        assert_eq!(first::<u8, _>(&gradients::FIRE), first::<u8, _>(gradients::FIRE));
        let choice: [&dyn Palette<u8>; 2] = [&Grey, &closure];
        assert_eq!(choice.map(|palette| palette.rgb(255)), [Rgb888::WHITE, Rgb888::BLUE]);
    }
}
