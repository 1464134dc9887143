//! What writes bins: a binary range coder whose carry waits behind bytes of 255, as in I. Pavlov's LZMA, and
//! what only counts them.

use attractor::codec::shared::{Coder, MODELS, Model};

/// All models as a stream begins.
pub(super) const NEW: [Model; MODELS] = [Model::NEW; MODELS];

/// Writes bins. The first byte of the coder is always 0 and left out.
#[derive(Clone)]
pub(super) struct RangeEncoder {
    low: u64,
    range: u32,
    /// The last byte that a carry can reach, and how many bytes of 255 follow it, itself included.
    cache: Option<u8>,
    pending: u64,
    bytes: Vec<u8>,
    pub(super) models: [Model; MODELS],
}

impl RangeEncoder {
    pub(super) const fn new() -> Self {
        Self { low: 0, range: u32::MAX, cache: None, pending: 1, bytes: Vec::new(), models: NEW }
    }

    fn shift(&mut self) {
        if self.low < 0xff00_0000 || self.low >> 32 != 0 {
            let carry = (self.low >> 32) as u8;
            if let Some(cache) = self.cache {
                self.bytes.push(cache.wrapping_add(carry));
            }
            for _ in 1..self.pending {
                self.bytes.push(0xff_u8.wrapping_add(carry));
            }
            self.pending = 0;
            self.cache = Some((self.low >> 24) as u8);
        }
        self.pending += 1;
        self.low = (self.low & 0x00ff_ffff) << 8;
    }

    fn normalise(&mut self) {
        while self.range < 1 << 24 {
            self.range <<= 8;
            self.shift();
        }
    }

    /// The bytes: of the numbers left that with most zeros at its end, without them.
    pub(super) fn finish(mut self) -> Vec<u8> {
        let top = self.low + u64::from(self.range) - 1;
        let round = (0..=32).rev().map(|zeros| top >> zeros << zeros).find(|number| *number >= self.low);
        self.low = round.unwrap_or(self.low);
        for _ in 0..5 {
            self.shift();
        }
        while self.bytes.last() == Some(&0) {
            self.bytes.pop();
        }
        self.bytes
    }
}

impl Coder for RangeEncoder {
    fn bin(&mut self, context: usize, bin: bool) -> bool {
        let model = &mut self.models[context];
        let bound = (self.range >> 13) * model.zero();
        if bin {
            self.low += u64::from(bound);
            self.range -= bound;
        } else {
            self.range = bound;
        }
        *model = model.learn(bin);
        self.normalise();
        bin
    }

    fn raw(&mut self, count: u32, bits: u32) -> u32 {
        for i in (0..count).rev() {
            self.range >>= 1;
            if bits >> i & 1 == 1 {
                self.low += u64::from(self.range);
            }
            self.normalise();
        }
        bits
    }
}

/// What a bin of each probability takes, in bits.
pub(super) struct Prices(Vec<f32>);

impl Prices {
    pub(super) fn new() -> Self {
        Self((0..=8192_u16).map(|p| -(f32::from(p.max(1)) / 8192.0).log2()).collect())
    }

    /// A bin under a model.
    #[inline]
    pub(super) fn bin(&self, model: Model, bin: bool) -> f32 {
        let zero = model.zero() as usize;
        self.0[if bin { 8192 - zero } else { zero }]
    }
}

/// Adds up bits; the models learn nothing.
pub(super) struct Cost<'a> {
    pub(super) models: &'a [Model; MODELS],
    pub(super) prices: &'a Prices,
    pub(super) bits: f32,
}

impl Coder for Cost<'_> {
    #[inline]
    fn bin(&mut self, context: usize, bin: bool) -> bool {
        self.bits += self.prices.bin(self.models[context], bin);
        bin
    }

    #[inline]
    fn raw(&mut self, count: u32, bits: u32) -> u32 {
        self.bits += count as f32;
        bits
    }
}
