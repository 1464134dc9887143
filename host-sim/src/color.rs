//! Colour depths: which colour type of embedded-graphics a display has, and how its pixels go into a PNG
//! file.

use attractor::draw::Ink;
pub(crate) use attractor_gallery::ground;
use clap::ValueEnum;
use embedded_graphics::pixelcolor::{BinaryColor, Gray2, Gray4, Gray8, Rgb565, Rgb888};

/// The colour of a display.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ColorDepth {
    /// 16 bits: ili9341, st7789
    Rgb565,
    /// 24 bits
    Rgb888,
    /// 256 greys
    Gray8,
    /// 16 greys, dithered
    Gray4,
    /// 4 greys, dithered: e-paper
    Gray2,
    /// Black and white, dithered: ssd1306, memory LCD
    Mono,
}

/// A colour type that the simulator shows and a PNG file holds.
pub(crate) trait Depth:
    Ink + From<BinaryColor> + From<Rgb888> + Into<Rgb888> + Send + 'static
{
    /// Bits of a grey sample, none for colour.
    const GREY_BITS: Option<u8>;
}

impl Depth for Rgb565 {
    const GREY_BITS: Option<u8> = None;
}
impl Depth for Rgb888 {
    const GREY_BITS: Option<u8> = None;
}
impl Depth for Gray8 {
    const GREY_BITS: Option<u8> = Some(8);
}
impl Depth for Gray4 {
    const GREY_BITS: Option<u8> = Some(4);
}
impl Depth for Gray2 {
    const GREY_BITS: Option<u8> = Some(2);
}
impl Depth for BinaryColor {
    const GREY_BITS: Option<u8> = Some(1);
}

/// Calls a generic function with the colour type of a [`ColorDepth`].
macro_rules! with_depth {
    ($depth:expr, $function:ident, $($argument:expr),*) => {
        match $depth {
            $crate::color::ColorDepth::Rgb565 => $function::<embedded_graphics::pixelcolor::Rgb565>($($argument),*),
            $crate::color::ColorDepth::Rgb888 => $function::<embedded_graphics::pixelcolor::Rgb888>($($argument),*),
            $crate::color::ColorDepth::Gray8 => $function::<embedded_graphics::pixelcolor::Gray8>($($argument),*),
            $crate::color::ColorDepth::Gray4 => $function::<embedded_graphics::pixelcolor::Gray4>($($argument),*),
            $crate::color::ColorDepth::Gray2 => $function::<embedded_graphics::pixelcolor::Gray2>($($argument),*),
            $crate::color::ColorDepth::Mono => $function::<embedded_graphics::pixelcolor::BinaryColor>($($argument),*),
        }
    };
}
pub(crate) use with_depth;
