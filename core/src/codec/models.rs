//! Adaptive probabilities of binary decisions, and what they are asked about.
//!
//! A model is the probability that the next bin is 0. It learns from each bin: with the rate `1/4` at first,
//! ever slower down to `1/64`, so that a short stream is not spent on learning.
//!
//! Format: 13 bits of probability, 3 bits that count the first bins.

use super::rolled::rounds;

/// The probability that a bin is 0. Size: 2 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Model(u16);

/// How many bins a model counts: then its rate does not change any more.
const COUNTED: u16 = 6;

impl Model {
    /// Memory before a model is in it: zeros, which need no copy.
    pub(super) const BLANK: Self = Self(0);
    /// Nothing known: 1/2.
    pub const NEW: Self = Self(0x8000);

    /// The probability of a 0 in 13 bits, from 31 to 8160 of 8192: the slowest rate stops there.
    #[inline]
    pub const fn zero(self) -> u32 {
        (self.0 >> 3) as u32
    }

    /// What it is after a bin. Rates, as shifts, are 2, 3, 3, 4, 4, and 5 from then on.
    #[inline]
    pub const fn learn(self, bin: bool) -> Self {
        let (p, count) = (self.0 >> 3, self.0 & 7);
        let rate = (count + 5) >> 1;
        let counted = self.0 + (count < COUNTED) as u16;
        Self(if bin { counted - (p >> rate << 3) } else { counted + ((8191 - p) >> rate << 3) })
    }
}

/// What reads bins, writes them or adds up what they cost: an encoder and a decoder walk the same syntax.
pub trait Coder {
    /// A bin under a model. A decoder takes no notice of the one that it is given.
    fn bin(&mut self, context: usize, bin: bool) -> bool;

    /// So many bits, the highest first, at most 32, each as likely 0 as 1.
    fn raw(&mut self, count: u32, bits: u32) -> u32;
}

/// `count` bins, the highest first, each under a model of those before it.
#[inline(never)]
pub(super) fn tree(coder: &mut impl Coder, context: usize, count: u32, value: u32) -> u32 {
    let mut node = 1;
    for i in (0..count).rev() {
        let bin = coder.bin(context + node as usize, value >> i & 1 == 1);
        node = node << 1 | u32::from(bin);
    }
    node & !(1 << count)
}

/// The most doublings of a number.
const DOUBLINGS: u32 = 20;

/// A number from 0 to `2^21 - 2` by Elias and Golomb: how often `v + 1` can be halved, in unary, then its
/// bits
/// below the highest, of which the first has a model.
#[inline(never)]
pub fn number(coder: &mut impl Coder, context: usize, value: u32) -> u32 {
    let value = value.saturating_add(1).min((1 << (DOUBLINGS + 1)) - 1);
    let wanted = 31 - value.leading_zeros();
    let (mut doublings, mut model, most) = (0, context, rounds(DOUBLINGS));
    while doublings < most && coder.bin(model, doublings < wanted) {
        doublings += 1;
        model = (model + 1).min(context + 9);
    }
    if doublings == 0 {
        return 0;
    }
    let first = coder.bin(model + 10, value >> (doublings - 1) & 1 == 1);
    let rest = coder.raw(doublings - 1, value & ((1 << (doublings - 1)) - 1));
    ((2 | u32::from(first)) << (doublings - 1) | rest) - 1
}
