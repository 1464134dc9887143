//! Decoding by iteration, as the text has it: maps applied to a whole picture, over and over.
//!
//! The picture is changed in place: a leaf sees what the leaves before it have become, which converges faster
//! than to keep two pictures. A leaf whose domain does not change any more is settled: no sweep draws it
//! again. So a stream whose maps do not depend on each other in a circle comes to its fixed point in few
//! sweeps and stays there to the bit.
//!
//! The first sweep reads the stream and keeps the leaves that it leaves unsettled in what was lent beyond the
//! picture. If they fit, the later ones draw them from there; else each reads the stream from its beginning.

use core::cell::Cell;

use embedded_graphics_core::geometry::Size;

use super::crc::Crc;
use super::header::Header;
use super::kept::Kept;
use super::opened::Opened;
use super::planes::{BAND, Part, Planes};
use super::range_decoder::RangeDecoder;
use super::sample::Sample;
use crate::Error;
use crate::plane::Field;

/// A picture of profile [`Iterated`](super::Profile::Iterated) or [`Pure`](super::Profile::Pure), black at
/// first, then sharper with each sweep. It is a field at any time.
///
/// Size: 0.5 KiB and the samples that [`Opened::samples`] counts: the picture, five quarters of a row, and
/// one for each 128 pixels. More is used as well: a leaf takes 9 samples and mostly 1 for each coefficient,
/// if it depends on itself or on what comes after it. So what is there between sweeps is the picture and 3.3
/// KiB for 240 x 240 at 0.27 bits a pixel. A sweep over the stream takes 3.2 KiB of stack besides, 1.7 of
/// them for its decoder, on a 32-bit machine.
///
/// Cost: in all, with those 3.3 KiB, about 70 instructions a pixel for a stream that was made for two sweeps,
/// kernel `decode sweeps`, and 108 for four, kernel `decode four sweeps`; without, 99 and 191.
#[derive(Debug)]
pub struct Sweeps<'a, S: Sample, I> {
    planes: Planes<'a, S>,
    source: I,
    crc: Crc,
    done: u32,
    kept: Kept<'a, S>,
}

impl<I: Iterator<Item = u8> + Clone> Opened<I> {
    /// Decodes a stream by iteration, `2^scale` times as large. The picture is black before the first sweep.
    /// `memory` beyond [`Opened::samples`] saves sweeps from reading the stream again.
    ///
    /// # Errors
    /// As [`Opened::stream`].
    // apart: what it moves is not on the stack in a sweep
    #[inline(never)]
    pub fn sweeps<S: Sample>(self, scale: i32, memory: &mut [S]) -> Result<Sweeps<'_, S, I>, Error> {
        self.checked::<S>(false, scale, memory.len())?;
        let (header, crc, source) = self.into_parts();
        let mut memory = Cell::from_mut(memory).as_slice_of_cells();
        let planes = Planes::new(header, scale, &mut memory);
        planes.blacken();
        Ok(Sweeps { planes, source, crc, done: 0, kept: Kept::new(memory) })
    }
}

impl<'a, S: Sample, I: Iterator<Item = u8> + Clone> Sweeps<'a, S, I> {
    /// Sweeps once more, and says how often that was done. The header says how many its encoder counted on;
    /// more do no harm.
    ///
    /// # Errors
    /// As [`Stream::next_band`](super::Stream::next_band). What was drawn until then stays.
    pub fn sweep(&mut self) -> Result<u32, Error> {
        if self.done > 0 && self.kept.is_whole() {
            self.planes.redraw(&mut self.kept);
        } else {
            self.read()?;
        }
        self.done = self.done.saturating_add(1);
        Ok(self.done)
    }

    /// A sweep over the stream, which keeps what it leaves to the next.
    #[inline(never)]
    fn read(&mut self) -> Result<(), Error> {
        let Header { version, payload, .. } = *self.planes.header();
        let mut decoder = RangeDecoder::new(self.source.clone(), payload, self.crc);
        decoder.begin(version);
        let kept = &mut self.kept;
        kept.clear();
        let mut row = 0;
        while row < self.planes.header().size.height {
            let drawn = self.planes.decode(row, &mut decoder, self.done, |plane, leaf, _, _, map| {
                if let Some(map) = map {
                    kept.add(plane, leaf, &map);
                }
            });
            if !drawn {
                return Planes::<S>::verdict(&decoder, None);
            }
            row += BAND;
        }
        let stated = Planes::<S>::end(&mut decoder);
        Planes::<S>::verdict(&decoder, stated)
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
