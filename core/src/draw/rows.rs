//! A picture without a display driver: strips of rows in a buffer that the caller lends, ready for SPI, DMA or a file.

use core::fmt;
use core::marker::PhantomData;

use crate::Error;
use crate::draw::{BigEndian, Ink, Lines, LsbPages, MsbRows, Packing, Palette, Picture};
use crate::picture::Field;

impl<F: Field, P: Palette<F::Value>, C: Ink> Picture<F, P, C> {
    /// Rows of colours, in a buffer of one row.
    ///
    /// ```
    /// use attractor::draw::{Grey, Picture};
    /// # use attractor::picture::Field;
    /// use embedded_graphics::{pixelcolor::{Gray8, GrayColor}, prelude::*};
    /// # struct Flat;
    /// # impl Field for Flat {
    /// #     type Value = u8;
    /// #     type Row<'a> = core::iter::Map<core::ops::Range<u32>, fn(u32) -> u8>;
    /// #     fn size(&self) -> Size { Size::new(4, 3) }
    /// #     fn row(&self, _y: u32, x: core::ops::Range<u32>) -> Self::Row<'_> { x.map(|x| x as u8) }
    /// # }
    /// # struct Spi;
    /// # impl Spi { fn write(&mut self, _: u32, _: &[Gray8]) -> Result<(), BusError> { Ok(()) } }
    /// # #[derive(Debug)] struct BusError;
    /// # let field = Flat;
    /// # let mut spi = Spi;
    ///
    /// let picture = Picture::<_, _, Gray8>::new(field, Grey);
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

    /// Rows of bytes, the most significant first: `2 * width` bytes for Rgb565.
    ///
    /// # Errors
    /// As [`Picture::lines`].
    pub fn big_endian<'a>(&'a self, line: &'a mut [u8]) -> Result<Strips<'a, F, P, C, BigEndian>, Error>
    where
        BigEndian: Packing<C, Unit = u8>,
    {
        Strips::new(self, line)
    }

    /// Rows of packed bits, the leftmost pixel in the most significant: `width / 8` bytes, rounded up, for BinaryColor.
    ///
    /// # Errors
    /// As [`Picture::lines`].
    pub fn msb_rows<'a>(&'a self, line: &'a mut [u8]) -> Result<Strips<'a, F, P, C, MsbRows>, Error>
    where
        MsbRows: Packing<C, Unit = u8>,
    {
        Strips::new(self, line)
    }

    /// Pages of 8 rows, a byte a column with the top row in the least significant bit: `width` bytes.
    ///
    /// # Errors
    /// As [`Picture::lines`].
    pub fn lsb_pages<'a>(&'a self, page: &'a mut [u8]) -> Result<Strips<'a, F, P, C, LsbPages>, Error>
    where
        LsbPages: Packing<C, Unit = u8>,
    {
        Strips::new(self, page)
    }

    /// Packs the strip that begins at row `y` into the front of `buffer` and returns that part: for two buffers in turn, one being
    /// filled while DMA sends the other. Rows below the picture are left out.
    ///
    /// # Errors
    /// [`Error::BufferLength`] for a buffer shorter than a strip.
    pub fn pack<'b, K: Packing<C>>(&self, y: u32, buffer: &'b mut [K::Unit]) -> Result<&'b [K::Unit], Error> {
        let size = self.field().size();
        let needed = K::length(size.width);
        let given = buffer.len();
        let strip = buffer.get_mut(..needed).ok_or(Error::BufferLength {
            what: "units of a strip",
            given,
            needed,
        })?;
        for row in 0..K::ROWS {
            let y = y.saturating_add(row);
            if y >= size.height {
                break;
            }
            K::pack(row, self.colors(y, 0..size.width), strip);
        }
        Ok(strip)
    }
}

/// The strips of a picture from the top down, each in the same lent buffer.
///
/// Not an `Iterator`, since each strip borrows the buffer: `while let Some((y, strip)) = strips.next_strip()`. The loop is the
/// caller's and may `await`, `break` and return errors of any kind; [`Strips::for_each`] is the short form.
pub struct Strips<'a, F, P, C, K: Packing<C>> {
    picture: &'a Picture<F, P, C>,
    buffer: &'a mut [K::Unit],
    next: u32,
    packing: PhantomData<fn() -> K>,
}

impl<'a, F: Field, P: Palette<F::Value>, C: Ink, K: Packing<C>> Strips<'a, F, P, C, K> {
    /// Strips packed as `K` says in `buffer`; a longer buffer than needed is used at its front.
    ///
    /// # Errors
    /// [`Error::BufferLength`] for a buffer shorter than a strip.
    pub fn new(picture: &'a Picture<F, P, C>, buffer: &'a mut [K::Unit]) -> Result<Self, Error> {
        let (given, needed) = (buffer.len(), K::length(picture.field().size().width));
        if given < needed {
            return Err(Error::BufferLength { what: "units of a strip", given, needed });
        }
        Ok(Self { picture, buffer, next: 0, packing: PhantomData })
    }

    /// The next strip and the number of its first row.
    pub fn next_strip(&mut self) -> Option<(u32, &[K::Unit])> {
        let y = self.next;
        if y >= self.picture.field().size().height {
            return None;
        }
        self.next = y.saturating_add(K::ROWS.max(1));
        let strip = self.picture.pack::<K>(y, self.buffer).ok()?;
        Some((y, strip))
    }

    /// Calls `sink` with every strip that is left and the number of its first row, until one call fails.
    ///
    /// # Errors
    /// The first error of `sink`.
    pub fn for_each<E>(mut self, mut sink: impl FnMut(u32, &[K::Unit]) -> Result<(), E>) -> Result<(), E> {
        while let Some((y, strip)) = self.next_strip() {
            sink(y, strip)?;
        }
        Ok(())
    }
}

impl<F, P, C, K: Packing<C>> fmt::Debug for Strips<'_, F, P, C, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Strips").field("next", &self.next).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::testing::Counted;
    use crate::draw::{Grey, hex};
    use embedded_graphics_core::geometry::Point;
    use embedded_graphics_core::image::GetPixel;
    use embedded_graphics_core::pixelcolor::raw::ToBytes;
    use embedded_graphics_core::pixelcolor::{
        BinaryColor, Gray2, Gray4, GrayColor, PixelColor, Rgb565, Rgb888,
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
        assert_eq!(picture.pack::<BigEndian>(0, &mut [0; 39]), Err(error));
        let picture = Picture::<_, _, BinaryColor>::new(&field, Grey);
        let short = |given, needed| Some(Error::BufferLength { what: "units of a strip", given, needed });
        assert_eq!(picture.msb_rows(&mut [0; 2]).err(), short(2, 3));
        assert_eq!(picture.lsb_pages(&mut []).err(), short(0, 20));
        assert_eq!(field.evaluated.get(), 0);
    }

    #[test]
    fn a_failing_bus_ends_the_rows() {
        let field = Counted::new(20, 8);
        let picture = Picture::<_, _, Rgb565>::new(&field, Grey);
        let mut buffer = [0; 40];
        let strips = picture.big_endian(&mut buffer).unwrap();
        let end = strips.for_each(|y, _| if y == 2 { Err("the bus is gone") } else { Ok(()) });
        assert_eq!(end, Err("the bus is gone"));
        assert_eq!(field.evaluated.get(), 60);
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
        assert_eq!(picture.pack::<LowFirst>(0, &mut [9; 3]), Ok(&[0b10101000, 0b00001010][..]));
    }
}
