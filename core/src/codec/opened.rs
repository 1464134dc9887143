//! A stream whose header has been read: what it needs, and what it becomes.

use super::crc::{Crc, crc32};
use super::header::{Header, Profile, WHAT};
use super::plane::Plane;
use super::rolled::rolled;
use super::sample::Sample;
use super::shape::Shape;
use crate::Error;
use crate::num::Wide;

/// A stream after its header.
///
/// ```
/// # fn main() -> Result<(), attractor::Error> {
/// use attractor::codec::open;
/// // eight by eight pixels of one grey
/// const FLAT: &[u8] = &[
///     0x41, 0x54, 0x46, 0x49, 0x02, 0x00, 0x08, 0x00, 0x08, 0x00, 0x00, 0x00, 0x08, 0x00,
///     0x04, 0xcf, 0xfe, 0x2c, 0xc4, 0x2a, 0xd2, 0x76, 0x6c,
/// ];
/// // bytes from anywhere: flash, a card, a radio
/// let opened = open(FLAT.iter().copied())?;
/// assert_eq!(opened.header().size.width, 8);
/// // as much memory as it says, or more
/// let mut memory = [0_u8; 2048];
/// assert!(opened.samples(0) <= memory.len());
/// let mut stream = opened.stream(0, &mut memory)?;
/// while let Some(band) = stream.next_band()? {
///     assert_eq!((band.top(), band.sample(0, 3, 3)), (0, 77));
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct Opened<I> {
    header: Header,
    crc: Crc,
    source: I,
}

/// Reads the header of a stream.
///
/// # Errors
/// [`Error::Ended`] for fewer bytes than a header has, [`Error::Malformed`] for bytes that no header has,
/// [`Error::Unsupported`] for another version, [`Error::OutOfRange`] for a side of 0 or above
/// [`MAX_SIDE`](crate::plane::MAX_SIDE).
pub fn open<I: Iterator<Item = u8>>(mut source: I) -> Result<Opened<I>, Error> {
    let (header, crc) = Header::read(&mut source)?;
    Ok(Opened { header, crc, source })
}

/// Whether `bytes` are one whole stream and nothing else: header, length and checksum. Decodes nothing.
///
/// # Errors
/// As [`open`]; [`Error::Ended`] if bytes are missing, [`Error::LengthMismatch`] if there are more,
/// [`Error::Checksum`] if some are wrong.
pub fn check(bytes: &[u8]) -> Result<Header, Error> {
    let mut rest = bytes.iter();
    let header = open(rest.by_ref().copied())?.header;
    let expected = bytes.len() - rest.len() + header.payload as usize + 4;
    if bytes.len() < expected {
        return Err(Error::Ended { what: WHAT, position: bytes.len() });
    }
    if bytes.len() > expected {
        return Err(Error::LengthMismatch { what: "bytes of an image", given: bytes.len(), expected });
    }
    let (body, stated) = bytes.split_at(expected - 4);
    let stated = stated.iter().rev().fold(0, |crc, byte| crc << 8 | u32::from(*byte));
    let computed = crc32(body);
    if stated == computed { Ok(header) } else { Err(Error::Checksum { what: WHAT, stated, computed }) }
}

impl<I> Opened<I> {
    /// What the stream says of itself.
    pub const fn header(&self) -> &Header {
        &self.header
    }

    /// How many samples a decoder of it borrows at a scale of `2^scale`, from -2 to 2.
    #[inline(never)]
    pub fn samples(&self, scale: i32) -> usize {
        let mut samples = 0;
        for plane in 0..3 {
            // u8 and u16 take as many
            samples += Plane::<u8>::samples(&self.header.shape(plane, scale.clamp(-2, 2)));
            rolled();
        }
        samples
    }

    /// The parts, for a decoder.
    pub(super) fn into_parts(self) -> (Header, Crc, I) {
        (self.header, self.crc, self.source)
    }

    /// Refuses what a decoder with samples of this kind, for one pass or for sweeps, cannot decode.
    #[inline(never)]
    pub(super) fn checked<S: Sample>(&self, one_pass: bool, scale: i32, given: usize) -> Result<(), Error> {
        if self.header.deep != (S::BITS == 16) {
            let allowed = if self.header.deep { "u16" } else { "u8" };
            return Err(Error::Unsupported { what: "type of samples", allowed });
        }
        if (self.header.profile == Profile::Streaming) != one_pass {
            let allowed = if one_pass { "sweeps" } else { "one pass" };
            return Err(Error::Unsupported { what: "way to decode", allowed });
        }
        if !(-2..=2).contains(&scale) {
            let [value, min, max] = [scale.clamp(-9999, 9999), -2, 2].map(Wide::from_num);
            return Err(Error::OutOfRange { what: "scale", index: None, value, min, max });
        }
        let needed = self.samples(scale);
        if given < needed {
            return Err(Error::BufferLength { what: "samples", given, needed });
        }
        Ok(())
    }
}

impl Header {
    /// Its planes as they are drawn; those of a grey picture beyond the first are empty.
    #[doc(hidden)]
    pub fn shapes(&self, scale: i32) -> [Shape; 3] {
        [0, 1, 2].map(|plane| self.shape(plane, scale))
    }

    /// A plane as it is drawn.
    #[inline(never)]
    pub(super) fn shape(&self, plane: u32, scale: i32) -> Shape {
        let there = plane < self.count();
        let halved = self.halved(plane);
        let size = self.plane_size(plane);
        Shape {
            width: if there { size.width } else { 0 },
            height: if there { size.height } else { 0 },
            largest: 5 - halved,
            chroma: u32::from(plane > 0),
            step: self.step_of(plane),
            window: match self.profile {
                Profile::Streaming => Some(u32::from(self.reach) << 3 >> halved),
                Profile::Iterated | Profile::Pure => None,
            },
            transform: self.profile != Profile::Pure,
            scale,
        }
    }
}
