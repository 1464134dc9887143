//! A picture without a display driver: strips of rows in a buffer that the caller lends, ready for SPI, DMA
//! or a file.
//!
//! A display of 240 by 240 pixels then needs memory for one row, or for eight where a byte holds a column of
//! them, and the picture is sent as it is computed.

use core::fmt;
use core::marker::PhantomData;
use core::ops::Range;

use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::primitives::Rectangle;

use super::image::Picture;
use super::ink::Ink;
use super::packing::{Lines, LsbPages, MsbRows, Packing, PixelBytes, PixelWords};
use super::palette::Palette;
use crate::Error;
use crate::draw::clip::part;
use crate::plane::Field;

impl<F: Field, P: Palette<F::Value>, C: Ink> Picture<F, P, C> {
    /// Rows of colours, in a buffer of one row.
    ///
    /// ```
    /// use attractor::draw::{Grey, Picture};
    /// use attractor::plane::from_fn;
    /// use embedded_graphics::{pixelcolor::{Gray8, GrayColor}, prelude::*};
    /// # struct Spi;
    /// # impl Spi { fn write(&mut self, _: u32, _: &[Gray8]) -> Result<(), BusError> { Ok(()) } }
    /// # #[derive(Debug)] struct BusError;
    /// # let mut spi = Spi;
    ///
    /// let picture = Picture::<_, _, Gray8>::new(from_fn(Size::new(4, 3), |x, _| x as u8), Grey);
    /// let mut line = [Gray8::BLACK; 4];
    /// picture.lines(&mut line).unwrap().for_each(|y, row| spi.write(y, row))?;
    /// # Ok::<(), BusError>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BufferLength`] for a buffer shorter than a row.
    pub fn lines<'a>(&'a self, line: &'a mut [C]) -> Result<Strips<'a, F, P, C, Lines>, Error> {
        Strips::new(self, line)
    }

    /// Rows of bytes, the most significant first: `2 * width` bytes for Rgb565, `3 * width` for Rgb666. See
    /// [`PixelBytes`].
    ///
    /// # Errors
    /// As [`Picture::lines`].
    pub fn big_endian<'a>(&'a self, line: &'a mut [u8]) -> Result<Strips<'a, F, P, C, PixelBytes>, Error>
    where
        PixelBytes: Packing<C, Unit = u8>,
    {
        Strips::new(self, line)
    }

    /// Rows of 16-bit words, one a pixel. See [`PixelWords`].
    ///
    /// # Errors
    /// As [`Picture::lines`].
    pub fn words<'a>(&'a self, line: &'a mut [u16]) -> Result<Strips<'a, F, P, C, PixelWords>, Error>
    where
        PixelWords: Packing<C, Unit = u16>,
    {
        Strips::new(self, line)
    }

    /// Rows of packed bits, the leftmost pixel in the most significant: `width / 8` bytes, rounded up, for
    /// BinaryColor. See [`MsbRows`].
    ///
    /// # Errors
    /// As [`Picture::lines`].
    pub fn msb_rows<'a>(&'a self, line: &'a mut [u8]) -> Result<Strips<'a, F, P, C, MsbRows>, Error>
    where
        MsbRows: Packing<C, Unit = u8>,
    {
        Strips::new(self, line)
    }

    /// Pages of 8 rows, a byte a column with the top row in the least significant bit: `width` bytes. See
    /// [`LsbPages`].
    ///
    /// # Errors
    /// As [`Picture::lines`].
    pub fn lsb_pages<'a>(&'a self, page: &'a mut [u8]) -> Result<Strips<'a, F, P, C, LsbPages>, Error>
    where
        LsbPages: Packing<C, Unit = u8>,
    {
        Strips::new(self, page)
    }

    /// Packs the columns `x`, as far as they lie in the picture, of the strip that begins at row `y` into the
    /// front of `buffer` and returns that part: for two buffers in turn, one being filled while DMA sends the
    /// other. Rows below the picture are left out.
    ///
    /// ```
    /// use attractor::draw::{Grey, MsbRows, Picture};
    /// use attractor::plane::from_fn;
    /// use embedded_graphics::{pixelcolor::Gray4, prelude::*};
    ///
    /// let picture = Picture::<_, _, Gray4>::new(from_fn(Size::new(9, 2), |x, _| x as u8 * 17), Grey);
    /// assert_eq!(picture.pack::<MsbRows>(1, 3..7, &mut [0; 16])?, [0x34, 0x56]);
    /// assert!(picture.pack::<MsbRows>(2, 3..7, &mut [0; 16]).is_err());
    /// # Ok::<(), attractor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BufferLength`] for a buffer shorter than a strip, [`Error::TooFew`] when the picture has no
    /// row `y`.
    pub fn pack<'b, K: Packing<C>>(
        &self,
        y: u32,
        x: Range<u32>,
        buffer: &'b mut [K::Unit],
    ) -> Result<&'b [K::Unit], Error> {
        let size = self.field().size();
        if y >= size.height {
            let (given, at_least) = (size.height as usize, (y as usize).saturating_add(1));
            return Err(Error::TooFew { what: "rows of the picture", given, at_least });
        }
        let end = x.end.min(size.width);
        let strip = front::<C, K>(&(x.start.min(end)..end), buffer)?;
        self.fill::<K>(y..size.height, x, strip);
        Ok(strip)
    }

    /// Fills a strip from the first of `rows`, of which there is at least one.
    fn fill<K: Packing<C>>(&self, rows: Range<u32>, x: Range<u32>, strip: &mut [K::Unit]) {
        const { assert!(K::ROWS > 0, "a strip has at least one row") };
        for (row, y) in (0..K::ROWS).zip(rows) {
            let Some(colors) = self.colors(y, x.clone()) else { break };
            K::pack(row, colors, strip);
        }
    }
}

/// The front of a buffer that a strip of these columns takes.
fn front<'b, C, K: Packing<C>>(
    x: &Range<u32>,
    buffer: &'b mut [K::Unit],
) -> Result<&'b mut [K::Unit], Error> {
    let (given, needed) = (buffer.len(), K::length(x.end.saturating_sub(x.start)));
    buffer.get_mut(..needed).ok_or(Error::BufferLength { what: "units of a strip", given, needed })
}

/// The strips of a picture or of a part of it from the top down, each in the same lent buffer.
///
/// Not an `Iterator`, since each strip borrows the buffer:
/// `while let Some((y, strip)) = strips.next_strip()`. The loop is the caller's and may `await`, `break` and
/// return errors of any kind; [`Strips::for_each`] is the short form.
///
/// ```
/// use attractor::draw::{Grey, MsbRows, Picture, Strips};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{pixelcolor::BinaryColor, prelude::*, primitives::Rectangle};
///
/// let picture = Picture::<_, _, BinaryColor>::new(from_fn(Size::new(64, 64), |x, y| x == y), Grey);
/// // the rows 40 to 42 of the columns from 32 on: what a partial refresh sends
/// let window = Rectangle::new(Point::new(32, 40), Size::new(16, 3));
/// let mut buffer = [0; 2];
/// let mut strips = Strips::<_, _, _, MsbRows>::of_part(&picture, &window, &mut buffer)?;
/// assert_eq!(strips.next_strip(), Some((40, &[0b0000_0000, 0b1000_0000][..])));
/// // the bus was busy: once more, without computing anything
/// strips.repeat();
/// assert_eq!(strips.next_strip(), Some((40, &[0b0000_0000, 0b1000_0000][..])));
/// assert_eq!(strips.next_strip(), Some((41, &[0b0000_0000, 0b0100_0000][..])));
/// # Ok::<(), attractor::Error>(())
/// ```
pub struct Strips<'a, F, P, C, K: Packing<C>> {
    picture: &'a Picture<F, P, C>,
    /// Of exactly one strip.
    buffer: &'a mut [K::Unit],
    columns: Range<u32>,
    /// The rows that are left.
    rows: Range<u32>,
    /// The first row of the strip in the buffer.
    packed: Option<u32>,
    /// The same when it is to come again.
    again: Option<u32>,
    packing: PhantomData<fn() -> K>,
}

impl<'a, F: Field, P: Palette<F::Value>, C: Ink, K: Packing<C>> Strips<'a, F, P, C, K> {
    /// Strips of the whole picture packed as `K` says in `buffer`; a longer buffer than needed is used at its
    /// front.
    ///
    /// # Errors
    /// [`Error::BufferLength`] for a buffer shorter than a strip.
    pub fn new(picture: &'a Picture<F, P, C>, buffer: &'a mut [K::Unit]) -> Result<Self, Error> {
        Self::of_part(picture, &Rectangle::new(Point::zero(), picture.field().size()), buffer)
    }

    /// Strips of what lies of the picture in `area`: its first column comes first in each strip, its first
    /// row in the first.
    ///
    /// # Errors
    /// As [`Strips::new`].
    pub fn of_part(
        picture: &'a Picture<F, P, C>,
        area: &Rectangle,
        buffer: &'a mut [K::Unit],
    ) -> Result<Self, Error> {
        let (columns, rows) = part(picture.field().size(), area);
        let buffer = front::<C, K>(&columns, buffer)?;
        Ok(Self { picture, buffer, columns, rows, packed: None, again: None, packing: PhantomData })
    }

    /// The next strip and the number of its first row in the picture.
    pub fn next_strip(&mut self) -> Option<(u32, &[K::Unit])> {
        if let Some(y) = self.again.take() {
            return Some((y, self.buffer));
        }
        if self.rows.is_empty() || self.columns.is_empty() {
            return None;
        }
        let y = self.rows.start;
        self.picture.fill::<K>(self.rows.clone(), self.columns.clone(), self.buffer);
        self.rows.start = y.saturating_add(K::ROWS);
        self.packed = Some(y);
        Some((y, self.buffer))
    }

    /// Lets the last strip come again, as it lies in the buffer: nothing is computed. For a bus that failed.
    pub fn repeat(&mut self) {
        self.again = self.packed;
    }

    /// Calls `sink` with every strip that is left and the number of its first row, until one call fails; that
    /// strip then comes again in the next call of this or of [`Strips::next_strip`].
    ///
    /// # Errors
    /// The first error of `sink`.
    pub fn for_each<E>(&mut self, mut sink: impl FnMut(u32, &[K::Unit]) -> Result<(), E>) -> Result<(), E> {
        while let Some((y, strip)) = self.next_strip() {
            let sent = sink(y, strip);
            if sent.is_err() {
                self.repeat();
                return sent;
            }
        }
        Ok(())
    }
}

impl<F, P, C, K: Packing<C>> fmt::Debug for Strips<'_, F, P, C, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Strips")
            .field("columns", &self.columns)
            .field("rows", &self.rows)
            .field("again", &self.again)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::testing::Counted;
    use crate::draw::{Grey, hex};
    use embedded_graphics_core::geometry::Size;
    use embedded_graphics_core::image::GetPixel;
    use embedded_graphics_core::pixelcolor::raw::ToBytes;
    use embedded_graphics_core::pixelcolor::{
        Bgr555, Bgr565, Bgr666, BinaryColor, Gray2, Gray4, GrayColor, PixelColor, Rgb555, Rgb565, Rgb666,
        Rgb888,
    };

    extern crate std;
    use std::vec::Vec;

    fn gather<F: Field, P: Palette<F::Value>, C: Ink, K: Packing<C>>(
        strips: Result<Strips<'_, F, P, C, K>, Error>,
    ) -> Vec<(u32, Vec<K::Unit>)> {
        let mut all = Vec::new();
        let mut strips = strips.unwrap();
        while let Some((y, strip)) = strips.next_strip() {
            all.push((y, strip.to_vec()));
        }
        all
    }

    /// The colour at `(x, y)`, `None` outside.
    fn at<C: Ink>(field: &Counted, x: usize, y: u32) -> Option<C> {
        Picture::<_, _, C>::new(field, Grey).pixel(Point::new(x as i32, y as i32))
    }

    #[test]
    fn lines_are_the_rows_of_the_picture() {
        let field = Counted::new(13, 5);
        let picture = Picture::<_, _, Rgb888>::new(&field, |value: u8| hex(u32::from(value)));
        let rows = gather(picture.lines(&mut [Rgb888::default(); 20])); // longer than needed
        assert_eq!(rows.len(), 5);
        for (y, (row, line)) in (0..).zip(rows) {
            assert_eq!(row, y);
            assert!(line.into_iter().eq((0..13).map(|x| hex(u32::from(Counted::value(x, y))))));
        }
    }

    #[test]
    fn big_endian_rows_begin_with_red() {
        let field = Counted::new(7, 2);
        let picture = Picture::<_, _, Rgb565>::new(&field, |_: u8| hex(0xff0008));
        let rows = gather(picture.big_endian(&mut [7; 14]));
        assert!(rows.iter().all(|(_, line)| line.chunks(2).all(|pixel| pixel == [0xf8, 0x01])));
        assert_eq!(rows.iter().map(|(_, line)| line.len()).collect::<Vec<_>>(), [14, 14]);
        let picture = Picture::<_, _, Rgb888>::new(&field, |_: u8| hex(0x123456));
        assert_eq!(gather(picture.big_endian(&mut [0; 21]))[1].1[18..], [0x12, 0x34, 0x56]);
        assert_eq!(Rgb888::new(0x12, 0x34, 0x56).to_be_bytes(), [0x12, 0x34, 0x56]);
    }

    #[test]
    fn packed_rows_hold_the_leftmost_pixel_in_the_highest_bits() {
        fn check<C: Ink>(pixels_a_byte: usize, bits: impl Fn(C) -> u8)
        where
            MsbRows: Packing<C, Unit = u8>,
        {
            let field = Counted::new(21, 6);
            let picture = Picture::<_, _, C>::new(&field, Grey);
            let rows = gather(picture.msb_rows(&mut [0xa5; 64]));
            assert_eq!(rows.len(), 6);
            for (y, line) in rows {
                assert_eq!(line.len(), 21_usize.div_ceil(pixels_a_byte));
                for (i, byte) in line.into_iter().enumerate() {
                    let expected = (0..pixels_a_byte).fold(0, |packed: u32, k| {
                        let pixel = at::<C>(&field, i * pixels_a_byte + k, y);
                        packed << (8 / pixels_a_byte) | u32::from(pixel.map_or(0, &bits))
                    });
                    assert_eq!(u32::from(byte), expected);
                }
            }
        }
        check::<BinaryColor>(8, |color| u8::from(color.is_on()));
        check::<Gray2>(4, |color| color.luma());
        check::<Gray4>(2, |color| color.luma());
    }

    #[test]
    fn pages_hold_the_top_row_in_the_lowest_bit() {
        let field = Counted::new(19, 21);
        let picture = Picture::<_, _, BinaryColor>::new(&field, Grey);
        let pages = gather(picture.lsb_pages(&mut [0xff; 19]));
        assert_eq!(pages.iter().map(|(y, _)| *y).collect::<Vec<_>>(), [0, 8, 16]);
        for (y, page) in pages {
            for (x, byte) in page.into_iter().enumerate() {
                let expected = (0..8).fold(0_u8, |bits, k| {
                    bits | u8::from(at(&field, x, y + k) == Some(BinaryColor::On)) << k
                });
                assert_eq!(byte, expected, "{x} {y}");
            }
        }
    }

    #[test]
    fn a_short_buffer_is_refused_before_anything_is_computed() {
        let field = Counted::new(20, 8);
        let picture = Picture::<_, _, Rgb565>::new(&field, Grey);
        let error = Error::BufferLength { what: "units of a strip", given: 39, needed: 40 };
        assert_eq!(picture.big_endian(&mut [0; 39]).err(), Some(error));
        assert_eq!(picture.pack::<PixelBytes>(0, 0..20, &mut [0; 39]), Err(error));
        let picture = Picture::<_, _, BinaryColor>::new(&field, Grey);
        let short = |given, needed| Some(Error::BufferLength { what: "units of a strip", given, needed });
        assert_eq!(picture.msb_rows(&mut [0; 2]).err(), short(2, 3));
        assert_eq!(picture.lsb_pages(&mut []).err(), short(0, 20));
        assert_eq!(field.evaluated.get(), 0);
    }

    #[test]
    fn a_strip_that_a_bus_refused_comes_again_and_is_not_computed_again() {
        let field = Counted::new(20, 8);
        let picture = Picture::<_, _, Rgb565>::new(&field, Grey);
        let mut buffer = [0; 40];
        let mut strips = picture.big_endian(&mut buffer).unwrap();
        strips.repeat(); // nothing to repeat yet
        let mut sent = Vec::new();
        let mut refused = 0;
        let mut send = |y, strip: &[u8]| {
            if y % 3 == 2 && refused <= y {
                refused += 1;
                return Err("the bus is gone");
            }
            sent.push((y, strip.to_vec()));
            Ok(())
        };
        let mut errors = 0;
        while strips.for_each(&mut send).is_err() {
            errors += 1;
            assert!(errors < 20);
        }
        assert_eq!((errors, field.evaluated.get()), (6, 160));
        let expected = gather(picture.big_endian(&mut [0; 40]));
        assert_eq!(sent, expected);
        // after the last strip too
        let mut buffer = [0; 40];
        let mut strips = picture.big_endian(&mut buffer).unwrap();
        strips.for_each(|_, _| Ok::<_, ()>(())).unwrap();
        assert_eq!(strips.next_strip(), None);
        strips.repeat();
        assert_eq!(strips.next_strip().map(|(y, strip)| (y, strip.to_vec())), expected.last().cloned());
        assert_eq!(strips.next_strip(), None);
    }

    #[test]
    fn a_row_below_the_picture_is_refused_and_leaves_the_buffer_as_it_is() {
        let field = Counted::new(20, 8);
        let picture = Picture::<_, _, BinaryColor>::new(&field, Grey);
        for y in [8, 9, 1000, u32::MAX] {
            let mut buffer = [7; 20];
            let error = Error::TooFew { what: "rows of the picture", given: 8, at_least: y as usize + 1 };
            assert_eq!(picture.pack::<LsbPages>(y, 0..20, &mut buffer), Err(error));
            assert_eq!((buffer, field.evaluated.get()), ([7; 20], 0));
        }
        // the last page holds what is left
        let mut buffer = [7; 20];
        let page = picture.pack::<LsbPages>(5, 0..20, &mut buffer).unwrap();
        for (x, byte) in page.iter().enumerate() {
            let rows = (5..8)
                .fold(0, |bits, y| bits | u8::from(at(&field, x, y) == Some(BinaryColor::On)) << (y - 5));
            assert_eq!(*byte, rows);
        }
        let none = Counted::new(20, 0);
        let picture = Picture::<_, _, BinaryColor>::new(&none, Grey);
        assert!(picture.pack::<LsbPages>(0, 0..20, &mut [0; 20]).is_err());
        assert_eq!(picture.lsb_pages(&mut [0; 20]).unwrap().next_strip(), None);
    }

    #[test]
    fn a_part_is_packed_from_its_own_corner() {
        let field = Counted::new(23, 21);
        let picture = Picture::<_, _, BinaryColor>::new(&field, Grey);
        for (x, y, width, height) in
            [(0, 0, 23, 21), (3, 5, 11, 9), (22, 20, 1, 1), (-4, -2, 9, 8), (9, 7, 99, 99)]
        {
            let area = Rectangle::new(Point::new(x, y), Size::new(width, height));
            let inside = area.intersection(&Rectangle::new(Point::zero(), Size::new(23, 21)));
            let (left, top) = (inside.top_left.x as usize, inside.top_left.y as u32);
            let (width, height) = (inside.size.width as usize, inside.size.height);
            let on = |column: usize, row: u32| {
                column < width
                    && row < height
                    && at(&field, left + column, top + row) == Some(BinaryColor::On)
            };
            field.evaluated.set(0);
            let mut buffer = [0xa5; 30];
            let rows = gather(Strips::<_, _, _, MsbRows>::of_part(&picture, &area, &mut buffer));
            assert_eq!(field.evaluated.get(), width * height as usize);
            assert!(rows.iter().map(|(y, _)| *y).eq(top..top + height));
            for (row, (_, bytes)) in (0..).zip(&rows) {
                assert_eq!(bytes.len(), width.div_ceil(8));
                for (i, byte) in bytes.iter().enumerate() {
                    let bits = (0..8).fold(0, |bits, k| bits << 1 | u8::from(on(8 * i + k, row)));
                    assert_eq!(*byte, bits, "{area:?}");
                }
            }
            // pages begin at the part's first row and leave out what lies below its last
            let pages = gather(Strips::<_, _, _, LsbPages>::of_part(&picture, &area, &mut buffer));
            assert_eq!(pages.len(), height.div_ceil(8) as usize);
            for (page, (y, bytes)) in (0..).zip(&pages) {
                assert_eq!((*y, bytes.len()), (top + 8 * page, width));
                for (column, byte) in bytes.iter().enumerate() {
                    let bits = (0..8).fold(0, |bits, k| bits | u8::from(on(column, 8 * page + k)) << k);
                    assert_eq!(*byte, bits, "{area:?}");
                }
            }
        }
        let beside = Rectangle::new(Point::new(23, 0), Size::new(5, 5));
        let mut strips = Strips::<_, _, _, MsbRows>::of_part(&picture, &beside, &mut []).unwrap();
        assert_eq!(strips.next_strip(), None);
    }

    #[test]
    fn each_channel_of_18_bits_has_a_byte_of_its_own() {
        for (rgb, bytes) in [
            (0xff0000, [0xfc, 0, 0]),
            (0x00ff00, [0, 0xfc, 0]),
            (0x0000ff, [0, 0, 0xfc]),
            (0x0482fb, [0x04, 0x80, 0xf8]),
        ] {
            let field = Counted::new(3, 1);
            let mut buffer = [9; 9];
            let picture = Picture::<_, _, Rgb666>::new(&field, |_: u8| hex(rgb));
            assert_eq!(gather(picture.big_endian(&mut buffer))[0].1, [bytes; 3].concat(), "{rgb:06x}");
            let [r, g, b] = bytes;
            let picture = Picture::<_, _, Bgr666>::new(&field, |_: u8| hex(rgb));
            assert_eq!(gather(picture.big_endian(&mut buffer))[0].1, [[b, g, r]; 3].concat(), "{rgb:06x}");
        }
    }

    #[test]
    fn words_are_the_bytes_of_16_bits_in_the_order_of_the_machine() {
        fn check<C: Ink>()
        where
            PixelBytes: Packing<C, Unit = u8>,
            PixelWords: Packing<C, Unit = u16>,
        {
            let field = Counted::new(17, 4);
            let picture = Picture::<_, _, C>::new(&field, |v: u8| hex(u32::from(v) * 0x01_0b_07));
            let words = gather(picture.words(&mut [0; 17]));
            let bytes = gather(picture.big_endian(&mut [0; 34]));
            assert_eq!(words.len(), 4);
            for ((y, words), (row, bytes)) in words.iter().zip(&bytes) {
                assert_eq!(y, row);
                assert!(words.iter().flat_map(|word| word.to_be_bytes()).eq(bytes.iter().copied()));
            }
        }
        check::<Rgb565>();
        check::<Bgr565>();
        check::<Rgb555>();
        check::<Bgr555>();
    }

    #[test]
    fn an_outsider_adds_a_packing() {
        /// Three colours of a paper in two bits, the leftmost lowest.
        struct LowFirst;
        #[derive(Clone, Copy, PartialEq)]
        struct Paper(u8);
        impl PixelColor for Paper {
            type Raw = ();
        }
        impl Ink for Paper {
            fn ink(rgb: Rgb888, at: Point) -> Self {
                Self(crate::draw::dithered(crate::draw::luma(rgb), 2, at))
            }
        }
        impl Packing<Paper> for LowFirst {
            type Unit = u8;
            const ROWS: u32 = 1;
            fn length(width: u32) -> usize {
                width.div_ceil(4) as usize
            }
            fn pack(_: u32, mut colors: impl Iterator<Item = Paper>, strip: &mut [u8]) {
                for byte in strip {
                    *byte = colors
                        .by_ref()
                        .take(4)
                        .zip(0..)
                        .fold(0, |byte, (color, k)| byte | color.0 << (2 * k));
                }
            }
        }
        let field = Counted::new(6, 1);
        let picture =
            Picture::<_, _, Paper>::new(&field, |value: u8| hex(if value == 0 { 0 } else { 0xffffff }));
        assert_eq!(picture.pack::<LowFirst>(0, 0..6, &mut [9; 3]), Ok(&[0b10101000, 0b00001010][..]));
    }
}
