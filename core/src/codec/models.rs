//! Adaptive probabilities of binary decisions, and what they are asked about.
//!
//! A model is the probability that the next bin is 0. It learns from each bin by counting them: the `n`th
//! moves it by `1/(n + 2)` of the way, as a mean does, and by `1/96` from the 94th on, so that it forgets.
//!
//! Those of version 1 learn with a rate of `1/4` at first, slower down to `1/32` from the sixth bin on, in 13
//! bits.
//!
//! Format: 16 bits of probability, a bit of the version, 15 bits that count.

use super::rolled::rounds;

/// The probability that a bin is 0. Size: 4 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Model(u32);

/// Which of the two ways a model learns.
const FIRST: u32 = 1 << 15;
/// How far a model counts, from 2; those of version 1 from 0.
const COUNTED: u32 = 95;
const COUNTED_FIRST: u32 = 6;
/// The most that a probability comes near to in 16 bits: none of 13 bits is 8192.
const TOP: u32 = 65_528;

impl Model {
    /// Memory before a model is in it: zeros, which need no copy.
    pub(super) const BLANK: Self = Self(0);

    /// Nothing known: 1/2. Any version but the first is taken for the second.
    pub const fn new(version: u8) -> Self {
        Self(1 << 31 | if version == 1 { FIRST } else { 2 })
    }

    /// The probability of a 0 in 13 bits, from 11 to 8179 of 8192 (version 1: 31 to 8160): the slowest rate
    /// stops there.
    #[inline]
    pub const fn zero(self) -> u32 {
        self.0 >> 19
    }

    /// What it is after a bin.
    #[inline]
    pub const fn learn(self, bin: bool) -> Self {
        let count = self.0 & (FIRST - 1);
        let goal = if bin { 0 } else { TOP as i32 };
        let left = goal - (self.0 >> 16) as i32;
        let (by, most) = if self.0 & FIRST == 0 {
            (left / (count as i32 + 1), COUNTED)
        } else {
            // rates, as shifts, are 2, 3, 3, 4, 4 and 5 from then on
            ((left / (8 << (((count & 7) + 5) >> 1))) << 3, COUNTED_FIRST)
        };
        let counted = self.0 + (count < most) as u32;
        Self(counted.wrapping_add((by as u32) << 16))
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
