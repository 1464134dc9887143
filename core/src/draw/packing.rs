//! Packings: how the colours of a few rows lie in a line buffer, as the memory of a display wants them.
//!
//! | packing | element | rows a strip | elements a strip | displays |
//! | --- | --- | --- | --- | --- |
//! | [`Lines`] | the colour | 1 | width | any |
//! | [`BigEndian`] | byte | 1 | width times bytes a pixel | st7789, ili9341 (Rgb565: 2 bytes) |
//! | [`MsbRows`] | byte | 1 | width times bits a pixel / 8, rounded up | e-paper, Sharp memory LCD; ssd1322 (Gray4) |
//! | [`LsbPages`] | byte | 8 | width | ssd1306, sh1106 |

use embedded_graphics_core::pixelcolor::raw::{RawData, ToBytes};
use embedded_graphics_core::pixelcolor::{BinaryColor, PixelColor};

/// A layout of colours in memory. Open: implement it for a display that packs otherwise.
pub trait Packing<C> {
    /// The element of the buffer.
    type Unit: Copy;

    /// How many rows of the picture one strip holds, at least 1.
    const ROWS: u32;

    /// How many elements a strip of a picture `width` pixels wide takes.
    fn length(width: u32) -> usize;

    /// Puts row `row` of the strip (`0..ROWS`, in this order) into `strip`, which has exactly [`Packing::length`] elements.
    /// The strip's old content means nothing: row 0 clears it.
    fn pack(row: u32, colors: impl Iterator<Item = C>, strip: &mut [Self::Unit]);
}

/// Colours as they are, one row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lines;

impl<C: Copy> Packing<C> for Lines {
    type Unit = C;
    const ROWS: u32 = 1;

    fn length(width: u32) -> usize {
        width as usize
    }

    fn pack(_row: u32, colors: impl Iterator<Item = C>, strip: &mut [C]) {
        for (place, color) in strip.iter_mut().zip(colors) {
            *place = color;
        }
    }
}

/// Whole bytes, the most significant first, one row: 2 a pixel for Rgb565, 3 for Rgb888, 1 for Gray8.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BigEndian;

impl<C> Packing<C> for BigEndian
where
    C: PixelColor + ToBytes,
    C::Bytes: IntoIterator<Item = u8>,
{
    type Unit = u8;
    const ROWS: u32 = 1;

    fn length(width: u32) -> usize {
        (width as usize).saturating_mul(size_of::<C::Bytes>())
    }

    fn pack(_row: u32, colors: impl Iterator<Item = C>, strip: &mut [u8]) {
        let bytes = colors.flat_map(|color| color.to_be_bytes());
        for (place, byte) in strip.iter_mut().zip(bytes) {
            *place = byte;
        }
    }
}

/// 1, 2 or 4 bits a pixel, the leftmost pixel in the most significant bits, one row. `On` is 1; bits beyond the picture are 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MsbRows;

impl<C> Packing<C> for MsbRows
where
    C: PixelColor + Into<C::Raw>,
    C::Raw: RawData<Storage = u8>,
{
    type Unit = u8;
    const ROWS: u32 = 1;

    fn length(width: u32) -> usize {
        (width as usize).saturating_mul(C::Raw::BITS_PER_PIXEL).div_ceil(8)
    }

    fn pack(_row: u32, mut colors: impl Iterator<Item = C>, strip: &mut [u8]) {
        let bits = C::Raw::BITS_PER_PIXEL.clamp(1, 8) as u32;
        for byte in strip {
            let mut packed = 0_u8;
            let mut shift = 8;
            while shift >= bits {
                shift -= bits;
                let raw = colors.next().map_or(0, |color| color.into().into_inner());
                packed |= raw << (shift & 7);
            }
            *byte = packed;
        }
    }
}

/// One bit a pixel, 8 rows a strip, a byte for each column with the top row in the least significant bit. `On` is 1; rows beyond the
/// picture are 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LsbPages;

impl Packing<BinaryColor> for LsbPages {
    type Unit = u8;
    const ROWS: u32 = 8;

    fn length(width: u32) -> usize {
        width as usize
    }

    fn pack(row: u32, colors: impl Iterator<Item = BinaryColor>, strip: &mut [u8]) {
        if row == 0 {
            strip.fill(0);
        }
        for (byte, color) in strip.iter_mut().zip(colors) {
            *byte |= u8::from(color.is_on()) << (row & 7);
        }
    }
}
