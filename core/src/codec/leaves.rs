//! The partition of a stream, leaf by leaf: what its maps are, and what it says of each.

use core::cell::Cell;

use super::header::Profile;
use super::leaf::{Leaf, Setting};
use super::opened::Opened;
use super::planes::{BAND, Planes};
use super::range_decoder::RangeDecoder;
use super::sample::Sample;
use crate::Error;

impl<I: Iterator<Item = u8>> Opened<I> {
    /// Shows each leaf in turn: its plane, what it says, how it was said, its column and row in the plane.
    /// `Shape::place` says where its domain lies.
    ///
    /// # Errors
    /// As [`Opened::stream`] and [`Stream::next_band`](super::Stream::next_band), of any profile.
    #[doc(hidden)]
    pub fn leaves<S: Sample>(
        self,
        memory: &mut [S],
        mut seen: impl FnMut(u32, &Leaf, &Setting, [u32; 2]),
    ) -> Result<(), Error> {
        self.checked::<S>(self.header().profile == Profile::Streaming, 0, memory.len())?;
        let (header, crc, source) = self.into_parts();
        let mut planes = Planes::new(header, 0, &mut Cell::from_mut(memory).as_slice_of_cells());
        let mut decoder = RangeDecoder::new(source, header.payload, crc);
        decoder.begin(header.version);
        let mut row = 0;
        while row < header.size.height {
            let mut shown = |plane, leaf: &_, setting: &_, at, _| seen(plane, leaf, setting, at);
            if !planes.decode(row, &mut decoder, 0, &mut shown) {
                return Planes::<S>::verdict(&decoder, None);
            }
            row += BAND;
        }
        let stated = Planes::<S>::end(&mut decoder);
        Planes::<S>::verdict(&decoder, stated)
    }
}
