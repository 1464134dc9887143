//! Decoding in one pass, band by band, in a window of few rows.

use core::cell::Cell;

use embedded_graphics_core::geometry::Size;

use super::opened::Opened;
use super::planes::{BAND, Part, Planes};
use super::range_decoder::RangeDecoder;
use super::sample::Sample;
use crate::Error;

/// A picture that comes in bands of 32 rows, from the top, as fast as its bytes do.
///
/// A band is a field: `Image::new(&Picture::new(Luma(band), Grey), Point::new(0, band.top() as i32))` draws
/// it.
/// What is drawn is what was decoded; whether all of it was right, the checksum says after the last band.
///
/// Size: 3.7 KiB on a 32-bit machine, and the samples that [`Opened::samples`] counts: 13.4 KiB for 240 x 240
/// grey. With its stack and that of a picture on a display all is at most 19.7 KiB there, image `decoder`.
#[derive(Debug)]
pub struct Stream<'a, S: Sample, I> {
    planes: Planes<'a, S>,
    decoder: RangeDecoder<I>,
    /// Of luma, the first row that is not decoded.
    next: u32,
    /// At the end, or where no more can be decoded: the checksum that is stated, if it came so far.
    stated: Option<u32>,
    over: bool,
}

impl<I: Iterator<Item = u8>> Opened<I> {
    /// Decodes a stream of profile [`Streaming`](super::Profile::Streaming), `2^scale` times as large.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for another profile or another depth than the header says,
    /// [`Error::OutOfRange`]
    /// for a scale beyond 2, [`Error::BufferLength`] for fewer samples than [`Opened::samples`].
    pub fn stream<S: Sample>(self, scale: i32, memory: &mut [S]) -> Result<Stream<'_, S, I>, Error> {
        self.stream_in(scale, Cell::from_mut(memory).as_slice_of_cells())
    }

    /// The same in cells.
    pub(super) fn stream_in<S: Sample>(
        self,
        scale: i32,
        mut memory: &[Cell<S>],
    ) -> Result<Stream<'_, S, I>, Error> {
        self.checked::<S>(true, scale, memory.len())?;
        let (header, crc, source) = self.into_parts();
        let planes = Planes::new(header, scale, &mut memory);
        let decoder = RangeDecoder::new(source, header.payload, crc);
        Ok(Stream { planes, decoder, next: 0, stated: None, over: false })
    }
}

impl<'a, S: Sample, I: Iterator<Item = u8>> Stream<'a, S, I> {
    /// Size of the picture as it is drawn.
    pub const fn size(&self) -> Size {
        self.planes.size()
    }

    /// The next band; none after the last, when the checksum was right. An error comes again.
    ///
    /// # Errors
    /// [`Error::Ended`] if bytes are missing, [`Error::Malformed`] if a domain lies where nothing is decoded
    /// or
    /// bytes of the payload are left over, [`Error::Checksum`].
    pub fn next_band(&mut self) -> Result<Option<Part<'a, S>>, Error> {
        if !self.over {
            if self.next == 0 {
                self.decoder.begin(self.planes.header().version);
            }
            if self.next >= self.planes.header().size.height {
                self.stated = Planes::<S>::end(&mut self.decoder);
            } else if self.planes.decode(self.next, &mut self.decoder, 0, |_, _, _, _, _| {}) {
                self.next += BAND;
                return Ok(self.band());
            }
            self.over = true;
        }
        Planes::<S>::verdict(&self.decoder, self.stated).map(|()| None)
    }

    /// The rows that the last band has; none before the first.
    pub(super) fn band(&self) -> Option<Part<'a, S>> {
        let top = self.planes.drawn(self.next.checked_sub(BAND)?);
        let rows = self.planes.drawn(BAND).min(self.planes.size().height.saturating_sub(top));
        Some(self.planes.part(top, rows))
    }
}
