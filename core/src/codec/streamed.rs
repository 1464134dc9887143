//! A stream in flash as a field: rows in any order, of which only a window is kept.

use core::cell::{Cell, RefCell};
use core::iter::Copied;
use core::ops::Range;
use core::slice::Iter;

use embedded_graphics_core::geometry::Size;

use super::opened::{check, open};
use super::planes::Part;
use super::sample::Sample;
use super::stream::Stream;
use crate::Error;
use crate::plane::{Field, along, inside};

/// A stream in a slice as a picture like any other. Rows from top to bottom are decoded once; a row above the
/// band that is there begins again.
///
/// ```
/// # fn main() -> Result<(), attractor::Error> {
/// use attractor::codec::{Luma, Streamed, open};
/// use attractor::draw::{Grey, Picture};
/// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
/// // eight by eight pixels of one grey
/// const FLAT: &[u8] = &[
///     0x41, 0x54, 0x46, 0x49, 0x01, 0x00, 0x08, 0x00, 0x08, 0x00, 0xcd, 0x06, 0x08, 0x00,
///     0x02, 0xcf, 0xb5, 0x74, 0xe8, 0x0a, 0x6b,
/// ];
/// let mut memory = [0_u8; 2048];
/// let field = Streamed::new(FLAT, 0, &mut memory)?;
/// let picture = Picture::new(Luma(&field), Grey);
/// let mut display = MockDisplay::<Gray8>::new();
/// Image::new(&picture, Point::new(3, 4)).draw(&mut display).unwrap();
/// assert_eq!(display.get_pixel(Point::new(3, 4)), Some(Gray8::new(77)));
/// assert_eq!(field.error(), None);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Streamed<'a, S: Sample> {
    bytes: &'a [u8],
    scale: i32,
    memory: &'a [Cell<S>],
    size: Size,
    stream: RefCell<Option<Stream<'a, S, Copied<Iter<'a, u8>>>>>,
    error: Cell<Option<Error>>,
}

impl<'a, S: Sample> Streamed<'a, S> {
    /// A whole stream, checked by [`check`], in lent memory.
    ///
    /// # Errors
    /// As [`check`] and [`Opened::stream`](super::Opened::stream).
    pub fn new(bytes: &'a [u8], scale: i32, memory: &'a mut [S]) -> Result<Self, Error> {
        check(bytes)?;
        let memory = Cell::from_mut(memory).as_slice_of_cells();
        let stream = open(bytes.iter().copied())?.stream_in(scale, memory)?;
        let size = stream.size();
        Ok(Self { bytes, scale, memory, size, stream: RefCell::new(Some(stream)), error: Cell::new(None) })
    }

    /// What went wrong; rows that could not be decoded are 0. Only a stream that no encoder wrote, and whose
    /// checksum is right all the same, comes to this.
    pub fn error(&self) -> Option<Error> {
        self.error.get()
    }

    /// The band that has row `y`.
    fn band(&self, y: u32) -> Option<Part<'a, S>> {
        let mut slot = self.stream.try_borrow_mut().ok()?;
        let there = slot.as_ref().and_then(Stream::band);
        match there {
            Some(band) if y.wrapping_sub(band.top()) < band.size().height => return Some(band),
            Some(band) if y < band.top() => *slot = None,
            _ => {}
        }
        if slot.is_none() {
            let again =
                open(self.bytes.iter().copied()).and_then(|opened| opened.stream_in(self.scale, self.memory));
            *slot = Some(again.map_err(|error| self.error.set(Some(error))).ok()?);
        }
        let stream = slot.as_mut()?;
        loop {
            match stream.next_band() {
                Ok(Some(band)) if y.wrapping_sub(band.top()) < band.size().height => return Some(band),
                Ok(Some(_)) => {}
                Ok(None) => return None,
                Err(error) => {
                    self.error.set(Some(error));
                    return None;
                }
            }
        }
    }
}

impl<S: Sample> Field for Streamed<'_, S> {
    type Value = [S; 3];

    fn size(&self) -> Size {
        self.size
    }

    fn at(&self, x: u32, y: u32) -> [S; 3] {
        self.band(y).map_or([S::cut(0); 3], |band| band.at(x, y - band.top()))
    }

    /// Read it before the row of another band is asked for.
    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = [S; 3]> {
        let band = self.band(y);
        along(inside(x, self.size.width), move |x| {
            band.map_or([S::cut(0); 3], |band| band.at(x, y - band.top()))
        })
    }
}
