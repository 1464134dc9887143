//! Packings: how the colours of a few rows lie in a line buffer, as the memory of a display wants them.
//!
//! They are for drivers that take bytes or words instead of colours; the table is [`Packing`]'s.

use embedded_graphics_core::pixelcolor::raw::{RawData, ToBytes};
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray8, IntoStorage, PixelColor, Rgb555, Rgb565, Rgb666,
    Rgb888, RgbColor,
};

/// A layout of colours in memory.
///
/// | packing | element | rows a strip | elements a strip | displays |
/// | --- | --- | --- | --- | --- |
/// | [`Lines`] | the colour | 1 | width | any driver that takes colours |
/// | [`PixelBytes`] | byte | 1 | width times bytes a pixel | st7789, ili9341 (Rgb565: 2 bytes, Rgb666: 3), ssd1351 |
/// | [`PixelWords`] | 16-bit word | 1 | width | the same by 16-bit SPI, DMA or a parallel bus (Rgb565) |
/// | [`MsbRows`] | byte | 1 | width times bits a pixel / 8, rounded up | e-paper, Sharp memory LCD; ssd1322 (Gray4) |
/// | [`LsbPages`] | byte | 8 | width | ssd1306, sh1106 |
///
/// Open: implement it for a display that packs otherwise, or one of these types for a colour of your own.
///
/// ```
/// use attractor::draw::{Grey, Packing, Picture};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{pixelcolor::{Gray4, GrayColor}, prelude::*};
///
/// /// Two pixels a byte, the left one in the low half.
/// struct LowFirst;
///
/// impl Packing<Gray4> for LowFirst {
///     type Unit = u8;
///     const ROWS: u32 = 1;
///     fn length(width: u32) -> usize {
///         width.div_ceil(2) as usize
///     }
///     fn pack(_row: u32, mut colors: impl Iterator<Item = Gray4>, strip: &mut [u8]) {
///         for byte in strip {
///             let mut luma = || colors.next().map_or(0, |color| color.luma());
///             *byte = luma() | luma() << 4;
///         }
///     }
/// }
///
/// let picture = Picture::<_, _, Gray4>::new(from_fn(Size::new(3, 1), |x, _| x as u8 * 17), Grey);
/// assert_eq!(picture.pack::<LowFirst>(0, 0..3, &mut [0; 2])?, [0x10, 0x02]);
/// # Ok::<(), attractor::Error>(())
/// ```
pub trait Packing<C> {
    /// The element of the buffer.
    type Unit: Copy;

    /// How many rows of the picture one strip holds: at least 1, checked at compile time.
    const ROWS: u32;

    /// How many elements a strip of a picture `width` pixels wide takes.
    fn length(width: u32) -> usize;

    /// Puts row `row` of the strip (`0..ROWS`, in this order) into `strip`, which has exactly
    /// [`Packing::length`] elements. The strip's old content means nothing: row 0 clears it.
    fn pack(row: u32, colors: impl Iterator<Item = C>, strip: &mut [Self::Unit]);
}

/// Colours as they are, one row: see [`Picture::lines`](crate::draw::Picture::lines).
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

/// Whole bytes, one row, as the bus of a display with 8 data bits takes them: 2 a pixel for Rgb565, the most
/// significant first; 3 for Rgb888 and for Rgb666, whose channels each have a byte of their own,
/// left-aligned; 1 for Gray8.
///
/// ```
/// use attractor::draw::{Picture, hex};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{pixelcolor::{Rgb565, Rgb666}, prelude::*};
///
/// let orange = |_: bool| hex(0xff8000);
/// let field = from_fn(Size::new(2, 9), |_, _| true);
/// let mut row = [0; 6];
/// let wide = Picture::<_, _, Rgb666>::new(field, orange);
/// assert_eq!(wide.big_endian(&mut row)?.next_strip(), Some((0, &[0xfc, 0x80, 0, 0xfc, 0x80, 0][..])));
/// let short = Picture::<_, _, Rgb565>::new(field, orange);
/// assert_eq!(short.big_endian(&mut row)?.next_strip(), Some((0, &[0xfc, 0x00, 0xfc, 0x00][..])));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelBytes;

/// Of each colour the number of bytes and the bytes.
macro_rules! pixel_bytes {
    ($($color:ty: $count:literal, $bytes:expr;)*) => {$(
        impl Packing<$color> for PixelBytes {
            type Unit = u8;
            const ROWS: u32 = 1;

            fn length(width: u32) -> usize {
                (width as usize).saturating_mul($count)
            }

            fn pack(_row: u32, colors: impl Iterator<Item = $color>, strip: &mut [u8]) {
                let bytes: fn($color) -> [u8; $count] = $bytes;
                for (place, byte) in strip.iter_mut().zip(colors.flat_map(bytes)) {
                    *place = byte;
                }
            }
        }
    )*};
}

pixel_bytes! {
    Gray8: 1, ToBytes::to_be_bytes;
    Rgb555: 2, ToBytes::to_be_bytes;
    Bgr555: 2, ToBytes::to_be_bytes;
    Rgb565: 2, ToBytes::to_be_bytes;
    Bgr565: 2, ToBytes::to_be_bytes;
    Rgb666: 3, |color| [color.r(), color.g(), color.b()].map(|channel| channel << 2);
    Bgr666: 3, |color| [color.b(), color.g(), color.r()].map(|channel| channel << 2);
    Rgb888: 3, ToBytes::to_be_bytes;
    Bgr888: 3, ToBytes::to_be_bytes;
}

/// 16-bit words of the machine, one a pixel, one row: for DMA or a bus that moves 16 bits at a time.
///
/// ```
/// use attractor::draw::{Picture, hex};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
///
/// let picture = Picture::<_, _, Rgb565>::new(from_fn(Size::new(3, 2), |_, _| ()), |()| hex(0xff8000));
/// let mut row = [0_u16; 3];
/// assert_eq!(picture.words(&mut row)?.next_strip(), Some((0, &[0xfc00; 3][..])));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelWords;

impl<C: IntoStorage<Storage = u16>> Packing<C> for PixelWords {
    type Unit = u16;
    const ROWS: u32 = 1;

    fn length(width: u32) -> usize {
        width as usize
    }

    fn pack(_row: u32, colors: impl Iterator<Item = C>, strip: &mut [u16]) {
        for (place, color) in strip.iter_mut().zip(colors) {
            *place = color.into_storage();
        }
    }
}

/// 1, 2 or 4 bits a pixel, the leftmost pixel in the most significant bits, one row. `On` is 1; bits beyond
/// the picture are 0.
///
/// ```
/// use attractor::draw::{Grey, Picture};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{pixelcolor::BinaryColor, prelude::*};
///
/// let bars = from_fn(Size::new(10, 1), |x, _| x % 4 < 2);
/// let picture = Picture::<_, _, BinaryColor>::new(bars, Grey);
/// assert_eq!(picture.msb_rows(&mut [0; 2])?.next_strip(), Some((0, &[0b1100_1100, 0b1100_0000][..])));
/// # Ok::<(), attractor::Error>(())
/// ```
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

/// One bit a pixel, 8 rows a strip, a byte for each column with the top row in the least significant bit.
/// `On` is 1; rows beyond the picture are 0.
///
/// ```
/// use attractor::draw::{Grey, Picture};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{pixelcolor::BinaryColor, prelude::*};
///
/// let stairs = from_fn(Size::new(3, 9), |x, y| x <= y);
/// let picture = Picture::<_, _, BinaryColor>::new(stairs, Grey);
/// let mut page = [0; 3];
/// let mut pages = picture.lsb_pages(&mut page)?;
/// assert_eq!(pages.next_strip(), Some((0, &[0xff, 0xfe, 0xfc][..])));
/// assert_eq!(pages.next_strip(), Some((8, &[1, 1, 1][..])));
/// # Ok::<(), attractor::Error>(())
/// ```
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
