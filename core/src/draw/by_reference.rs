//! Palettes by reference: one that is large or lent is passed on without being copied.

use embedded_graphics_core::pixelcolor::Rgb888;

use super::cycle::{Cycled, Ramp};
use super::dither::Dithered;
use super::equalised::Equalised;
use super::gradient::Gradient;
use super::mono::{Inverted, Luminance};
use super::palette::{Brightened, CourseUnit, Grey, Inside, Palette};
use super::srgb::Srgb;

/// A reference to a palette is a palette. (Not a blanket `impl for &P`: it would overlap with the one for
/// closures.)
macro_rules! by_reference {
    ($([$($generics:tt)*] $name:ty, $value:ty;)*) => {$(
        impl<$($generics)*> Palette<$value> for &$name
        where
            $name: Palette<$value>,
        {
            #[inline]
            fn rgb(&self, value: $value) -> Rgb888 {
                (**self).rgb(value)
            }

            #[inline]
            fn is_dithered(&self) -> bool {
                (**self).is_dithered()
            }
        }
    )*};
}

by_reference! {
    [V] CourseUnit, V;
    [V] Grey, V;
    [V, P] Inside<P>, V;
    [V, P] Brightened<P>, V;
    [V, P] Luminance<P>, V;
    [V, P] Inverted<P>, V;
    [V, P] Dithered<P>, V;
    [V] Srgb, V;
    ['a, V, P] Equalised<'a, P>, V;
    [V, P] Cycled<P>, V;
    [V, const N: usize] Gradient<N>, V;
    [V, const N: usize] Ramp<N>, V;
}
