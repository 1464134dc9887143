//! What writes bins: a binary range coder whose carry waits behind bytes of 255, as in I. Pavlov's LZMA, and
//! what only counts them.

use attractor::codec::Header;
use attractor::codec::shared::{Coder, MODELS, Model, NUMBER, context, number};

/// All models as a stream begins.
pub(super) const NEW: [Model; MODELS] = [Model::new(Header::VERSION); MODELS];

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
    pub(super) counts: Counts,
}

impl RangeEncoder {
    pub(super) const fn new() -> Self {
        Self {
            low: 0,
            range: u32::MAX,
            cache: None,
            pending: 1,
            bytes: Vec::new(),
            models: NEW,
            counts: [[0; 2]; MODELS],
        }
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

    /// Bytes so far.
    pub(super) const fn length(&self) -> usize {
        self.bytes.len()
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
        self.counts[context][usize::from(bin)] += 1;
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

/// How often each model had a 0 and a 1.
pub(super) type Counts = [[u32; 2]; MODELS];

/// What a bin of each probability takes, in bits.
pub(super) struct Prices(Vec<f32>);

impl Prices {
    pub(super) fn new() -> Self {
        Self((0..=8192_u16).map(|p| -(f32::from(p.max(1)) / 8192.0).log2()).collect())
    }

    /// What a 0 and a 1 take under each model as it stands; if there was an encoding before, as it was there
    /// on the whole for so large a part: a model that learns fast follows noise as well.
    pub(super) fn rates(
        &self,
        models: &[Model; MODELS],
        before: Option<(&Counts, f32)>,
        chroma: u32,
    ) -> Rates {
        let bins = std::array::from_fn(|i| {
            let mut zero = models[i].zero() as f32;
            if let Some((before, whole)) = before {
                let [zeros, ones] = before[i].map(|count| count as f32 + 2.0);
                zero += whole * (8192.0 * zeros / (zeros + ones) - zero);
            }
            let zero = (zero as usize).clamp(8, 8184);
            [self.0[zero], self.0[8192 - zero]]
        });
        let mut rates = Rates { bins, last: [[0.0; 256]; 4], magnitudes: [0.0; MAGNITUDES] };
        let bits = |context: usize, value: usize| {
            let mut cost = Cost { rates: &rates, bits: 0.0 };
            number(&mut cost, context, value as u32);
            cost.bits
        };
        let last = std::array::from_fn(|k| {
            std::array::from_fn(|i| bits(context::LAST + (4 * chroma as usize + k) * NUMBER, i))
        });
        let magnitudes = std::array::from_fn(|i| bits(context::MAGNITUDE, i));
        (rates.last, rates.magnitudes) = (last, magnitudes);
        rates
    }
}

/// Numbers whose bits are kept.
const MAGNITUDES: usize = 64;

/// What bins take, in bits.
pub(super) struct Rates {
    /// A 0 and a 1 under each model.
    pub(super) bins: [[f32; 2]; MODELS],
    /// The place of the last coefficient, by size.
    pub(super) last: [[f32; 256]; 4],
    magnitudes: [f32; MAGNITUDES],
}

impl Rates {
    /// So many steps of a mean.
    pub(super) fn mean(&self, chroma: u32, size: u32, mean: i32) -> f32 {
        let (mut cost, k) = (Cost { rates: self, bits: 0.0 }, (4 * chroma + size - 2) as usize);
        number(&mut cost, context::MEAN + k * NUMBER, mean.unsigned_abs());
        if mean != 0 {
            cost.bin(context::MEAN_SIGN + k, mean < 0);
        }
        cost.bits
    }

    /// A magnitude less 2.
    pub(super) fn magnitude(&self, value: u32) -> f32 {
        self.magnitudes.get(value as usize).copied().unwrap_or_else(|| {
            let mut cost = Cost { rates: self, bits: 0.0 };
            number(&mut cost, context::MAGNITUDE, value);
            cost.bits
        })
    }
}

/// Adds up bits; the models learn nothing.
pub(super) struct Cost<'a> {
    pub(super) rates: &'a Rates,
    pub(super) bits: f32,
}

impl Coder for Cost<'_> {
    #[inline]
    fn bin(&mut self, context: usize, bin: bool) -> bool {
        self.bits += self.rates.bins[context][usize::from(bin)];
        bin
    }

    #[inline]
    fn raw(&mut self, count: u32, bits: u32) -> u32 {
        self.bits += count as f32;
        bits
    }
}
