//! A binary range decoder (G. N. N. Martin, "Range encoding", 1979; the carry as in I. Pavlov's LZMA).
//!
//! `range` is the width of what is left of the interval, `code` where the stream's number lies in it. A bin
//! of
//! probability `p` divides the range; when it falls below `2^24` a byte is taken in. Beyond the payload's end
//! the bytes are 0.

use super::context::COUNT;
use super::crc::Crc;
use super::models::{Coder, Model};

/// Reads bins from bytes.
#[derive(Debug, Clone)]
pub(super) struct RangeDecoder<I> {
    source: I,
    range: u32,
    code: u32,
    /// Bytes of the payload, and how many of them were not yet taken.
    payload: u32,
    left: u32,
    /// Whether the source ended before the payload.
    ended: bool,
    crc: Crc,
    models: [Model; COUNT],
}

impl<I: Iterator<Item = u8>> RangeDecoder<I> {
    /// A payload of so many bytes, of which none has been read.
    pub(super) fn new(source: I, payload: u32, crc: Crc) -> Self {
        let models = [Model::NEW; COUNT];
        let mut this =
            Self { source, range: u32::MAX, code: 0, payload, left: payload, ended: false, crc, models };
        for _ in 0..4 {
            this.code = this.code << 8 | this.byte();
        }
        this
    }

    #[inline]
    fn byte(&mut self) -> u32 {
        if self.left == 0 || self.ended {
            return 0;
        }
        match self.source.next() {
            Some(byte) => {
                self.left -= 1;
                self.crc.add(byte);
                u32::from(byte)
            }
            None => {
                self.ended = true;
                0
            }
        }
    }

    #[inline]
    fn normalise(&mut self) {
        if self.range < 1 << 24 {
            self.refill();
        }
    }

    /// Apart, as few bins come here.
    #[inline(never)]
    fn refill(&mut self) {
        while self.range < 1 << 24 {
            self.range <<= 8;
            self.code = self.code << 8 | self.byte();
        }
    }

    /// Whether the source ended too early.
    pub(super) const fn ended(&self) -> bool {
        self.ended
    }

    /// How many bytes of the payload were taken.
    pub(super) const fn taken(&self) -> usize {
        (self.payload - self.left) as usize
    }

    /// Bytes of the payload that nothing asked for.
    pub(super) const fn left(&self) -> u32 {
        self.left
    }

    /// What follows the payload, and the checksum of what was taken.
    pub(super) fn rest(&mut self) -> (&mut I, Crc) {
        (&mut self.source, self.crc)
    }
}

impl<I: Iterator<Item = u8>> Coder for RangeDecoder<I> {
    #[inline(never)]
    fn bin(&mut self, context: usize, _: bool) -> bool {
        let Some(model) = self.models.get_mut(context) else { return false };
        let bound = (self.range >> 13) * model.zero();
        let bin = self.code >= bound;
        if bin {
            self.code -= bound;
            self.range -= bound;
        } else {
            self.range = bound;
        }
        *model = model.learn(bin);
        self.normalise();
        bin
    }

    #[inline(never)]
    fn raw(&mut self, count: u32, _: u32) -> u32 {
        let mut bits = 0;
        for _ in 0..count.min(32) {
            self.range >>= 1;
            let one = self.code >= self.range;
            if one {
                self.code -= self.range;
            }
            bits = bits << 1 | u32::from(one);
            self.normalise();
        }
        bits
    }
}
