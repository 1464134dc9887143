//! Decoding by iteration, as the text has it: maps applied to a whole picture, over and over.
//!
//! The picture is changed in place: a leaf sees what the leaves before it have become, which converges faster
//! than to keep two pictures. A leaf whose domain does not change any more is settled: no sweep draws it
//! again.
//! So a stream whose maps do not depend on each other in a circle comes to its fixed point in few sweeps and
//! stays there to the bit. A sweep reads the stream from its beginning, as nothing is kept but the picture
//! and
//! a bit for each 16 of its pixels.

use core::cell::Cell;

use embedded_graphics_core::geometry::Size;

use super::crc::Crc;
use super::opened::Opened;
use super::planes::{BAND, Part, Planes};
use super::sample::Sample;
use crate::Error;
use crate::plane::Field;

/// A picture of profile [`Iterated`](super::Profile::Iterated) or [`Pure`](super::Profile::Pure), black at
/// first, then sharper with each sweep. It is a field at any time.
///
/// Size: 1.0 KiB and, in a sweep, 1.7 KiB of stack for its decoder on a 32-bit machine, and the samples that
/// [`Opened::samples`] counts: the picture, five quarters of a row, and one for each 128 pixels.
#[derive(Debug)]
pub struct Sweeps<'a, S: Sample, I> {
    planes: Planes<'a, S>,
    source: I,
    crc: Crc,
    done: u32,
}

impl<I: Iterator<Item = u8> + Clone> Opened<I> {
    /// Decodes a stream by iteration, `2^scale` times as large. The picture is black before the first sweep.
    ///
    /// # Errors
    /// As [`Opened::stream`].
    pub fn sweeps<S: Sample>(self, scale: i32, memory: &mut [S]) -> Result<Sweeps<'_, S, I>, Error> {
        self.checked::<S>(false, scale, memory.len())?;
        let (header, crc, source) = self.into_parts();
        let planes = Planes::new(header, scale, Cell::from_mut(memory).as_slice_of_cells());
        planes.blacken();
        Ok(Sweeps { planes, source, crc, done: 0 })
    }
}

impl<'a, S: Sample, I: Iterator<Item = u8> + Clone> Sweeps<'a, S, I> {
    /// Sweeps once more, and says how often that was done. The header says how many its encoder counted on;
    /// more do no harm.
    ///
    /// # Errors
    /// As [`Stream::next_band`](super::Stream::next_band). What was drawn until then stays.
    pub fn sweep(&mut self) -> Result<u32, Error> {
        let mut decoder = self.planes.decoder(self.source.clone(), self.crc);
        let mut row = 0;
        while row < self.planes.header().size.height {
            self.planes.decode(row, &mut decoder, self.done, |_, _, _, _| {})?;
            row += BAND;
        }
        Planes::<S>::end(&mut decoder)?;
        self.done = self.done.saturating_add(1);
        Ok(self.done)
    }

    /// All sweeps that the header counts on which are not done yet.
    ///
    /// # Errors
    /// As [`Sweeps::sweep`].
    pub fn finish(&mut self) -> Result<(), Error> {
        while self.done < u32::from(self.planes.header().reach) {
            self.sweep()?;
        }
        Ok(())
    }

    /// The picture.
    pub fn picture(&self) -> Part<'a, S> {
        self.planes.part(0, self.planes.size().height)
    }
}

impl<S: Sample, I: Iterator<Item = u8> + Clone> Field for Sweeps<'_, S, I> {
    type Value = [S; 3];

    fn size(&self) -> Size {
        self.planes.size()
    }

    #[inline]
    fn at(&self, x: u32, y: u32) -> [S; 3] {
        self.picture().at(x, y)
    }
}
