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
    /// A payload of so many bytes, of which none has been read. It must be told to [`begin`](Self::begin):
    /// what changes it before it lies where it stays makes a compiler keep its models twice on the stack.
    #[inline(always)]
    pub(super) const fn new(source: I, payload: u32, crc: Crc) -> Self {
        let models = [Model::BLANK; COUNT];
        Self { source, range: u32::MAX, code: 0, payload, left: payload, ended: false, crc, models }
    }

    /// Reads what the first bin is found by; no model knows anything, and each learns as in that version.
    #[inline(never)]
    pub(super) fn begin(&mut self, version: u8) {
        self.models.fill(Model::new(version));
        for _ in 0..4 {
            self.code = self.code << 8 | self.byte();
        }
    }

    #[inline(never)]
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

    /// Takes bytes in where the range has become small, and says whether a bin was 1. Apart, as few bins come
    /// here, and last, so that the others save no registers for it.
    #[inline(never)]
    fn refill(&mut self, bin: u32) -> bool {
        while self.range < 1 << 24 {
            self.range <<= 8;
            self.code = self.code << 8 | self.byte();
        }
        bin == 1
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

    /// The checksum of what was taken.
    pub(super) const fn computed(&self) -> u32 {
        self.crc.value()
    }

    /// The checksum that follows the payload; none where the source ended before.
    pub(super) fn stated(&mut self) -> Option<u32> {
        let mut stated = 0;
        for shift in [0, 8, 16, 24] {
            let Some(byte) = self.source.next() else {
                self.ended = true;
                return None;
            };
            stated |= u32::from(byte) << shift;
        }
        Some(stated)
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
        if self.range < 1 << 24 { self.refill(bin.into()) } else { bin }
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
            let one = if self.range < 1 << 24 { self.refill(one.into()) } else { one };
            bits = bits << 1 | u32::from(one);
        }
        bits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bins, raw where there is no context, of which the last is 1, and the least number that says so: by the
    /// format's page, in integers that hold all of it. A decoder's `code` is its `bound` there.
    fn least(version: u8, seed: u32, bins: &[Option<usize>]) -> (std::vec::Vec<bool>, u128, usize) {
        let (mut low, mut range, mut bytes) = (0_u128, u128::from(u32::MAX), 4);
        let mut models = [(32768_u128, 0_usize); 8];
        let mut said = std::vec::Vec::new();
        for (i, bin) in bins.iter().enumerate() {
            let one = i + 1 == bins.len() || seed >> i & 1 == 1;
            let bound = match bin {
                None => range / 2,
                Some(context) => range / 8192 * (models[*context].0 / 8),
            };
            // half of an odd range leaves one out
            range = match (one, bin) {
                (true, Some(_)) => range - bound,
                _ => bound,
            };
            low += if one { bound } else { 0 };
            if let Some(context) = bin {
                let (p, count) = &mut models[*context];
                let left = if one { *p } else { 65528 - *p };
                let by = match version {
                    1 => (left >> [2, 3, 3, 4, 4, 5, 5, 5][(*count).min(7)]) / 8 * 8,
                    _ => left / (*count as u128 + 3).min(96),
                };
                *p = if one { *p - by } else { *p + by };
                *count += 1;
            }
            while range < 1 << 24 {
                (low, range, bytes) = (low << 8, range << 8, bytes + 1);
            }
            said.push(one);
        }
        (said, low, bytes)
    }

    fn heard(version: u8, number: u128, bytes: usize, bins: &[Option<usize>]) -> std::vec::Vec<bool> {
        let all = number.to_be_bytes();
        let source = all[16 - bytes..].iter().copied();
        let mut decoder = RangeDecoder::new(source, bytes as u32, Crc::NEW);
        decoder.begin(version);
        let mut hear = |bin: &Option<usize>| match bin {
            Some(context) => decoder.bin(*context, false),
            None => decoder.raw(1, 0) == 1,
        };
        bins.iter().map(&mut hear).collect()
    }

    #[test]
    fn a_code_word_at_the_bound_is_a_1_and_the_one_below_it_a_0() {
        assert_eq!(least(1, 0, &[Some(0)]), (std::vec![true], 0x7fff_f000, 4));
        assert_eq!(least(2, 0, &[None]), (std::vec![true], 0x7fff_ffff, 4));
        let (mut tried, mut longest) = (0, 0);
        for seed in 1..2000_u32 {
            let seed = seed.wrapping_mul(0x9e37_79b9);
            let length = 1 + seed as usize % 31;
            let kind = |i: usize| (seed.rotate_left(i as u32) % 5 != 0).then_some((seed as usize >> i) % 8);
            let bins: std::vec::Vec<_> = (0..length).map(kind).collect();
            let version = 1 + (seed >> 31) as u8;
            let (mut said, number, bytes) = least(version, seed, &bins);
            assert_eq!(heard(version, number, bytes, &bins), said, "{seed:x}");
            // one less lies below the bound, and says the same until there
            *said.last_mut().unwrap() = false;
            assert_eq!(heard(version, number - 1, bytes, &bins), said, "{seed:x}, one below");
            (tried, longest) = (tried + 1, longest.max(bytes));
        }
        assert!(tried == 1999 && longest >= 7, "{tried} {longest}");
    }
}
