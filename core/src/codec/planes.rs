//! The planes of a picture, decoded band by band in turn, and what they hold as a field.

use core::cell::Cell;

use embedded_graphics_core::geometry::Size;

use super::header::{Header, WHAT};
use super::kept::{Kept, Unsettled};
use super::leaf::{Leaf, Setting};
use super::levels::Levels;
use super::plane::Plane;
use super::range_decoder::RangeDecoder;
use super::sample::Sample;
use crate::Error;
use crate::plane::Field;

/// Rows of luma in a band.
pub(super) const BAND: u32 = 32;

/// All planes of a picture, and what reads them.
#[derive(Debug)]
pub(super) struct Planes<'a, S: Sample> {
    header: Header,
    planes: [Plane<'a, S>; 3],
}

impl<'a, S: Sample> Planes<'a, S> {
    /// In lent memory of the length that was checked, from its front.
    pub(super) fn new(header: Header, scale: i32, memory: &mut &'a [Cell<S>]) -> Self {
        let mut plane = |index| Plane::new(header.shape(index, scale), memory);
        let planes = [plane(0), plane(1), plane(2)];
        Self { header, planes }
    }

    /// Decodes the band that begins at a row of luma: whether all of it could be.
    pub(super) fn decode<I: Iterator<Item = u8>>(
        &mut self,
        row: u32,
        decoder: &mut RangeDecoder<I>,
        done: u32,
        mut seen: impl FnMut(u32, &Leaf, &Setting, [u32; 2], Option<Unsettled>),
    ) -> bool {
        // here and not with the planes: a stream that is moved takes less
        let mut leaf = Leaf::default();
        for (index, plane) in (0..self.header.count()).zip(self.planes.as_mut_slice()) {
            plane.begin(row >> self.header.halved(index), done);
            let sound = plane.decode(decoder, &mut leaf, RangeDecoder::ended, |leaf, setting, at, map| {
                seen(index, leaf, setting, at, map);
            });
            if !sound || decoder.ended() {
                return false;
            }
        }
        true
    }

    /// Sweeps over leaves that were kept instead of a stream. Apart: what it needs is not on the stack of a
    /// sweep over the stream.
    #[inline(never)]
    pub(super) fn redraw(&mut self, kept: &mut Kept<'a, S>) {
        let planes = &mut self.planes;
        kept.retain(&mut Levels::default(), |index, levels, map| {
            planes.get_mut(index as usize).is_some_and(|plane| !plane.redraw(levels, map))
        });
    }

    /// What follows the last band: the stated checksum, if all bytes of the payload were taken and it is
    /// there.
    pub(super) fn end<I: Iterator<Item = u8>>(decoder: &mut RangeDecoder<I>) -> Option<u32> {
        if decoder.left() > 0 { None } else { decoder.stated() }
    }

    /// What is to be said of a stream of which a decoder takes no more, with the checksum if it came so far.
    #[inline(never)]
    pub(super) fn verdict<I: Iterator<Item = u8>>(
        decoder: &RangeDecoder<I>,
        stated: Option<u32>,
    ) -> Result<(), Error> {
        let (position, computed) = (decoder.taken(), decoder.computed());
        match stated {
            _ if decoder.ended() => Err(Error::Ended { what: WHAT, position }),
            None => Err(Error::Malformed { what: WHAT, position }),
            Some(stated) if stated == computed => Ok(()),
            Some(stated) => Err(Error::Checksum { what: WHAT, stated, computed }),
        }
    }

    /// The header.
    pub(super) const fn header(&self) -> &Header {
        &self.header
    }

    /// Size as it is drawn.
    pub(super) const fn size(&self) -> Size {
        let [luma, ..] = &self.planes;
        Size::new(luma.shape().columns(), luma.shape().rows())
    }

    /// A number of rows of luma, a multiple of four, as it is drawn.
    pub(super) const fn drawn(&self, rows: u32) -> u32 {
        let [luma, ..] = &self.planes;
        luma.shape().scaled(rows)
    }

    /// Luma black, chroma without colour.
    pub(super) fn blacken(&self) {
        for (plane, value) in self.planes.iter().zip([0, 1 << (S::BITS - 1), 1 << (S::BITS - 1)]) {
            for sample in plane.picture() {
                sample.set(S::cut(value));
            }
        }
    }

    /// So many rows that are there, of which the first is `top` in the whole picture.
    pub(super) fn part(&self, top: u32, rows: u32) -> Part<'a, S> {
        let [luma, orange, green] = &self.planes;
        Part {
            samples: [luma.picture(), orange.picture(), green.picture()],
            columns: [luma.shape().columns(), orange.shape().columns()],
            halved: self.header.halved(1),
            top,
            size: Size::new(luma.shape().columns(), rows),
        }
    }
}

/// Decoded rows: a field of luma, orange (`Co`) and green (`Cg`); the latter two are half the range in a grey
/// picture.
/// [`Luma`] has luma alone.
#[derive(Debug, Clone, Copy)]
pub struct Part<'a, S: Sample> {
    samples: [&'a [Cell<S>]; 3],
    columns: [u32; 2],
    halved: u32,
    top: u32,
    size: Size,
}

impl<S: Sample> Part<'_, S> {
    /// Its first row in the whole picture.
    pub const fn top(&self) -> u32 {
        self.top
    }

    /// The sample of a plane at column `x` and row `y` of luma. Outside there is grey: 0, and half the range
    /// for
    /// chroma.
    #[inline]
    pub fn sample(&self, plane: usize, x: u32, y: u32) -> S {
        let [columns, chroma] = self.columns;
        let (x, y, columns) =
            if plane == 0 { (x, y, columns) } else { (x >> self.halved, y >> self.halved, chroma) };
        let at = y as usize * columns as usize + x as usize;
        let sample = self.samples.get(plane).and_then(|samples| samples.get(at));
        sample.map_or_else(|| S::cut(if plane == 0 { 0 } else { 1 << (S::BITS - 1) }), Cell::get)
    }
}

impl<S: Sample> Field for Part<'_, S> {
    type Value = [S; 3];

    fn size(&self) -> Size {
        self.size
    }

    #[inline]
    fn at(&self, x: u32, y: u32) -> [S; 3] {
        [0, 1, 2].map(|plane| self.sample(plane, x, y))
    }
}

/// Luma alone of a field of luma and chroma.
///
/// ```
/// use attractor::codec::Luma;
/// use attractor::plane::{Field, from_fn};
/// use embedded_graphics::geometry::Size;
/// let field = from_fn(Size::new(4, 1), |x, _| [x as u8, 128, 128]);
/// assert!(Luma(field).row(0, 1..4).eq([1, 2, 3]));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Luma<F>(pub F);

impl<S: Sample, F: Field<Value = [S; 3]>> Field for Luma<F> {
    type Value = S;

    fn size(&self) -> Size {
        self.0.size()
    }

    #[inline]
    fn at(&self, x: u32, y: u32) -> S {
        let [luma, ..] = self.0.at(x, y);
        luma
    }
}
