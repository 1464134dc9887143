//! What a stream says of itself before its first bin. docs/IMAGE-FORMAT.md has each bit.

use embedded_graphics_core::geometry::Size;

use super::crc::Crc;
use crate::Error;
use crate::num::Wide;
use crate::plane::checked_size;

/// What complaints call a stream.
pub(super) const WHAT: &str = "image";

/// How a picture is made of its stream.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Profile {
    /// In one pass: a domain lies in what is decoded already, in a window of few rows.
    Streaming,
    /// In sweeps over the whole picture, from anywhere to anywhere: an iterated function system.
    Iterated,
    /// The same without a transform: contractive maps alone.
    Pure,
}

/// What planes there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Planes {
    /// One.
    Grey,
    /// Luma and two of chroma, `YCoCg`.
    Colour,
    /// The same, chroma half as wide and half as high.
    ColourHalved,
}

/// The first bytes of a stream.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Header {
    /// 2, or 1 for a file whose models learn as those of the first version: docs/IMAGE-FORMAT.md.
    pub version: u8,
    /// Width and height.
    pub size: Size,
    /// How it is decoded.
    pub profile: Profile,
    /// Grey or colour.
    pub planes: Planes,
    /// Whether a sample has 16 bits instead of 8.
    pub deep: bool,
    /// The step of luma: [`Step`].
    pub step: Step,
    /// Streaming: rows above a band that domains may lie in, of 8, at most 8. Otherwise: sweeps, 1 to 8.
    pub reach: u8,
    /// The step of chroma in sixteenths of luma's; 0 for grey.
    pub chroma: u8,
    /// Bytes between header and checksum.
    pub payload: u32,
}

/// A step of quantisation: an exponent and 8 bits of mantissa.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Step(u16);

impl Step {
    /// The coarsest.
    pub const MAX: Self = Self(24 * 256 - 1);

    /// From its two bytes; none above [`Step::MAX`].
    pub const fn from_bits(bits: u16) -> Option<Self> {
        if bits <= Self::MAX.0 { Some(Self(bits)) } else { None }
    }

    /// Its two bytes.
    pub const fn to_bits(self) -> u16 {
        self.0
    }

    /// In `2^-8`: `(256 + mantissa) 2^exponent / 16`.
    pub const fn value(self) -> u32 {
        ((256 + (self.0 as u32 & 255)) << (self.0 >> 8)) >> 4
    }
}

impl Header {
    /// What a stream begins with.
    pub const MAGIC: [u8; 4] = *b"ATFI";
    /// The version that is written. The one before it is read as well.
    pub const VERSION: u8 = 2;
    /// Bytes before the payload's length.
    const FIXED: usize = 14;
    /// The most bytes that a header has.
    pub const LONGEST: usize = 18;

    /// Reads a header.
    #[inline(never)]
    pub(super) fn read(source: &mut impl Iterator<Item = u8>) -> Result<(Self, Crc), Error> {
        let mut crc = Crc::NEW;
        let wrong = |position: usize| Error::Malformed { what: WHAT, position };
        // those of fixed length, then the payload's length
        let (mut fixed, mut payload) = ([0; Self::FIXED], 0_u32);
        for position in 0..Self::LONGEST {
            let byte = source.next().ok_or(Error::Ended { what: WHAT, position })?;
            crc.add(byte);
            if let Some(slot) = fixed.get_mut(position) {
                *slot = byte;
                if Self::MAGIC.get(position).is_some_and(|letter| *letter != byte) {
                    return Err(wrong(position));
                }
                if position == 4 && !(1..=Self::VERSION).contains(&byte) {
                    return Err(Error::Unsupported { what: "version of an image", allowed: "1 and 2" });
                }
                continue;
            }
            payload |= u32::from(byte & 127) << (7 * (position - Self::FIXED));
            if byte < 128 {
                break;
            }
            if position + 1 == Self::LONGEST {
                return Err(wrong(position));
            }
        }
        let [_, _, _, _, version, flags, w0, w1, h0, h1, s0, s1, reach, chroma] = fixed;
        let profile = match flags & 3 {
            0 => Profile::Streaming,
            1 => Profile::Iterated,
            2 => Profile::Pure,
            _ => return Err(wrong(5)),
        };
        let planes = match flags >> 2 & 3 {
            0 => Planes::Grey,
            1 => Planes::Colour,
            2 => Planes::ColourHalved,
            _ => return Err(wrong(5)),
        };
        if flags >> 5 != 0 {
            return Err(wrong(5));
        }
        let [width, height, step] = [[w0, w1], [h0, h1], [s0, s1]].map(u16::from_le_bytes);
        let size = checked_size(Size::new(width.into(), height.into()))?;
        let Some(step) = Step::from_bits(step) else { return Err(wrong(11)) };
        if reach > 8 || (reach == 0 && profile != Profile::Streaming) {
            return Err(wrong(12));
        }
        if (chroma == 0) != (planes == Planes::Grey) {
            return Err(wrong(13));
        }
        let deep = flags >> 4 & 1 == 1;
        Ok((Self { version, size, profile, planes, deep, step, reach, chroma, payload }, crc))
    }

    /// Writes the header into `bytes` and says how many it took.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a payload of `2^28` bytes or more.
    #[doc(hidden)]
    pub fn write(&self, bytes: &mut [u8; Self::LONGEST]) -> Result<usize, Error> {
        if self.payload >> 28 != 0 {
            let (value, max) = (Wide::MAX, Wide::MAX);
            return Err(Error::OutOfRange { what: "payload", index: None, value, min: Wide::ZERO, max });
        }
        let profile = match self.profile {
            Profile::Streaming => 0,
            Profile::Iterated => 1,
            Profile::Pure => 2,
        };
        let planes = match self.planes {
            Planes::Grey => 0,
            Planes::Colour => 1,
            Planes::ColourHalved => 2,
        };
        let [w, h] = [self.size.width as u16, self.size.height as u16].map(u16::to_le_bytes);
        let step = self.step.to_bits().to_le_bytes();
        let flags = profile | planes << 2 | u8::from(self.deep) << 4;
        let [m0, m1, m2, m3] = Self::MAGIC;
        let fixed = [
            m0,
            m1,
            m2,
            m3,
            self.version,
            flags,
            w[0],
            w[1],
            h[0],
            h[1],
            step[0],
            step[1],
            self.reach,
            self.chroma,
        ];
        let mut length = 0;
        let mut payload = self.payload;
        let digits = core::iter::from_fn(|| {
            let digit = (payload & 127) as u8;
            payload >>= 7;
            Some(if payload == 0 { digit } else { digit | 128 })
        });
        let mut open = true;
        for (slot, byte) in bytes.iter_mut().zip(fixed.into_iter().chain(digits.take_while(|byte| {
            let wanted = open;
            open = *byte >= 128;
            wanted
        }))) {
            *slot = byte;
            length += 1;
        }
        Ok(length)
    }

    /// How many planes there are.
    pub(super) const fn count(&self) -> u32 {
        match self.planes {
            Planes::Grey => 1,
            _ => 3,
        }
    }

    /// The step of a plane in `2^-8`.
    pub fn step_of(&self, plane: u32) -> u32 {
        if plane == 0 {
            return self.step.value();
        }
        let step = (u64::from(self.step.value()) * u64::from(self.chroma)) >> 4;
        (step as u32).clamp(1, Step::MAX.value())
    }

    /// Shift of a plane's coordinates against luma's.
    pub const fn halved(&self, plane: u32) -> u32 {
        (plane > 0 && matches!(self.planes, Planes::ColourHalved)) as u32
    }

    /// Size of a plane.
    pub const fn plane_size(&self, plane: u32) -> Size {
        let k = self.halved(plane);
        Size::new((self.size.width + k) >> k, (self.size.height + k) >> k)
    }
}
