//! Draws one of `n` items, each with its own probability, from one random word in constant time: Walker's
//! alias method.
//!
//! The chaos game draws a map for every point that it shows. A search through the sums of the probabilities
//! would take longer the more maps there are; here a draw is one multiplication, one comparison and two
//! loads.
//!
//! The `2^32` words are divided into `n` slots of equal length, one for each item. An item with less than the
//! average probability owns only the first words of its slot; the rest of the slot is let to one other item,
//! its alias. A word `w` falls into slot `floor(w n / 2^32)`, and the fraction that is left of the product
//! decides between owner and alias.
//!
//! Source: A. J. Walker, "An efficient method for generating discrete random variables", 1977; the table by
//! M. D. Vose, 1991. It is made of whole words: each item gets its share of the `2^32` words first, then they
//! change hands without rounding.

use super::formats::UQ32;
use super::product::product_by_short;
use super::quotient::{nth, ratio};
use crate::Error;

/// An alias table of at most `N <= 256` items. Cost of a draw: one multiplication, one comparison, two loads.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Alias<const N: usize> {
    /// In a slot of its own, below this fraction of it, an item is drawn itself;
    threshold: [UQ32; N],
    /// above it, this other one is.
    other: [u8; N],
    len: u32,
}

impl<const N: usize> Alias<N> {
    /// A table for items with the given weights: the probability of item `i` is `weights[i]` over their sum,
    /// 0 for 0.
    ///
    /// Error: below `2^-32` (`words_are_shared_out_in_proportion_to_the_weights`). Cost: about `n^2`
    /// comparisons.
    ///
    /// # Errors
    /// [`Error::TooFew`] without weights or when all are 0, [`Error::Capacity`] for more than `N` or 256.
    pub fn new(weights: &[u32]) -> Result<Self, Error> {
        let n = weights.len();
        if n > N.min(256) {
            return Err(Error::Capacity { what: "weights", needed: n, capacity: N.min(256) });
        }
        let sum: u64 = weights.iter().map(|w| u64::from(*w)).sum();
        if sum == 0 {
            return Err(Error::TooFew { what: "positive weights", given: 0, at_least: 1 });
        }
        let (mut threshold, mut other) = ([u32::MAX; N], core::array::from_fn(|i| i as u8));
        share(weights, sum, &mut [0_i64; N], &mut threshold, &mut other);
        Ok(Self { threshold, other, len: n as u32 })
    }

    /// How many items there are.
    pub const fn len(&self) -> usize {
        self.len as usize
    }

    /// Never: a table has at least one item.
    pub const fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The item that a uniformly distributed word stands for.
    #[inline]
    pub fn pick(&self, word: u32) -> usize {
        let product = product_by_short(word, self.len as u16);
        let slot = (product >> 32) as usize;
        // slot < len <= N: `get` only spares the proof to the compiler
        match (self.threshold.get(slot), self.other.get(slot)) {
            (Some(threshold), Some(other)) if product as u32 >= *threshold => *other as usize,
            _ => slot,
        }
    }
}

/// The first word of a slot of `n`, for `slot <= n`: `ceil(2^32 slot / n)`.
fn first_word(slot: usize, n: usize) -> i64 {
    nth(((slot as i64) << 32) + n as i64 - 1, n as u32)
}

/// Fills a table in which so far each item has all of its own slot: whoever owns fewer words than that gets
/// a lodger, the richest item, in what is left of the slot.
fn share(weights: &[u32], sum: u64, excess: &mut [i64], thresholds: &mut [UQ32], others: &mut [u8]) {
    let n = weights.len();
    // how many words more an item owns than its slot has, from those of all items before it
    let (mut below, mut owned) = (0_u64, 0);
    for (i, (excess, weight)) in excess.iter_mut().zip(weights).enumerate() {
        below += u64::from(*weight);
        let end = ratio(below, 32, sum) as i64;
        *excess = end - owned - (first_word(i + 1, n) - first_word(i, n));
        owned = end;
    }
    for _ in weights {
        // the poorest item that still has its slot alone, and the richest
        let (mut poor, mut rich) = ((0, 0), (0, 0));
        for (i, ((excess, other), _)) in excess.iter().zip(&*others).zip(weights).enumerate() {
            if usize::from(*other) == i {
                if *excess < poor.0 {
                    poor = (*excess, i);
                }
                if *excess >= rich.0 {
                    rich = (*excess, i);
                }
            }
        }
        let ((missing, i), (_, rich)) = (poor, rich);
        if missing >= 0 {
            break;
        }
        // it owns the first words of its slot: `pick` compares `word n` modulo 2^32, which begins below `n`
        // in each slot and grows by `n` from word to word
        let words = first_word(i + 1, n) - first_word(i, n) + missing;
        if let (Some(threshold), Some(other)) = (thresholds.get_mut(i), others.get_mut(i)) {
            (*threshold, *other) = ((words * n as i64) as u32, rich as u8);
        }
        // the excesses of the slots that are not settled add up to 0: the richest is another item, and gives
        // no more than it owns
        if let Some(left) = excess.get_mut(rich) {
            *left += missing;
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};
    use std::vec::Vec;

    /// How many of the 2^32 words stand for each item: exactly, from the last word of each slot that stands
    /// for its own item.
    fn words<const N: usize>(table: &Alias<N>) -> Vec<i128> {
        let n = table.len() as u64;
        let mut words = std::vec![0_i128; table.len()];
        for slot in 0..n {
            let first = (slot << 32).div_ceil(n);
            let end = ((slot + 1) << 32).div_ceil(n);
            // words are picked in this order: its own item, then the other one
            let (mut low, mut high) = (first, end);
            while low < high {
                let middle = (low + high) / 2;
                if table.pick(middle as u32) == slot as usize { low = middle + 1 } else { high = middle }
            }
            words[slot as usize] += i128::from(low - first);
            if low < end {
                let other = table.pick(low as u32);
                assert_eq!(table.pick((end - 1) as u32), other);
                words[other] += i128::from(end - low);
            }
        }
        words
    }

    #[test]
    fn words_are_shared_out_in_proportion_to_the_weights() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(3);
        let mut lists: Vec<Vec<u32>> = [
            &[1_u32][..],
            &[1, 1],
            &[1, 85, 7, 7],
            &[0, 3, 0, 5],
            &[u32::MAX; 5],
            &[u32::MAX, 1],
            &[0, 0, 1],
        ]
        .map(<[u32]>::to_vec)
        .into();
        lists.push((0..256).map(|i| u32::from(i == 77)).collect());
        lists.push(std::vec![1; 255]);
        lists.push((0..256).map(|i| if i == 9 { u32::MAX } else { 1 }).collect());
        for n in [2, 3, 7, 64, 100, 255, 256, 256, 256] {
            for shift in [0, 8, 31] {
                lists.push((0..n).map(|_| rng.next_u32() >> (rng.next_u32() % (shift + 1))).collect());
            }
        }
        let (mut inexact, mut most) = (0, 0.0_f64);
        for weights in lists {
            let words = words(&Alias::<256>::new(&weights).unwrap());
            let sum: i128 = weights.iter().map(|w| i128::from(*w)).sum();
            assert_eq!(words.iter().sum::<i128>(), 1 << 32, "{weights:?}");
            for (words, weight) in words.iter().zip(&weights) {
                // |words / 2^32 - weight / sum| < 2^-32
                let off = words * sum - (i128::from(*weight) << 32);
                assert!(off.abs() < sum, "{weights:?}: {words} for {weight} of {sum}");
                assert!(*weight > 0 || *words == 0, "an item without weight was drawn");
                inexact += u32::from(off != 0);
                most = most.max(off.abs() as f64 / sum as f64);
            }
        }
        assert!(inexact > 1000 && most > 0.9, "{inexact} {most}");
    }

    #[test]
    fn a_table_holds_256_items_and_no_more() {
        assert!(matches!(
            Alias::<300>::new(&[1; 257]),
            Err(Error::Capacity { needed: 257, capacity: 256, .. })
        ));
        assert!(matches!(Alias::<3>::new(&[1; 4]), Err(Error::Capacity { needed: 4, capacity: 3, .. })));
        assert!(matches!(Alias::<3>::new(&[]), Err(Error::TooFew { .. })));
        assert!(matches!(Alias::<3>::new(&[0; 3]), Err(Error::TooFew { .. })));
        let table = Alias::<300>::new(&[1; 256]).unwrap();
        assert_eq!((table.len(), table.is_empty()), (256, false));
        for slot in 0..256_u32 {
            assert_eq!(
                (table.pick(slot << 24), table.pick(slot << 24 | 0xff_ffff)),
                (slot as usize, slot as usize)
            );
        }
    }
}
