//! Choosing one of `n` items with given probabilities in constant time: the alias method.
//!
//! Source: A. J. Walker, "An efficient method for generating discrete random variables", 1977; the table by M. D. Vose, 1991.

use super::{product_by_short, ratio};
use crate::Error;

/// An alias table of at most `N <= 256` items. Cost of a draw: one multiplication, one comparison, two loads.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Alias<const N: usize> {
    /// Below this fraction of its slot an item stands for itself.
    threshold: [u32; N],
    /// Above it, for this one.
    other: [u8; N],
    len: u32,
}

impl<const N: usize> Alias<N> {
    /// A table for items with the given weights: the probability of item `i` is `weights[i]` over their sum, within `2^-31`.
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
        share(weights, sum, &mut [0; N], &mut threshold, &mut other);
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

/// Fills a table in which each of the items stands for itself.
fn share(weights: &[u32], sum: u64, parts: &mut [u64], thresholds: &mut [u32], others: &mut [u8]) {
    // Each slot holds `sum` parts; an item with weight w owns n w of them.
    for (part, weight) in parts.iter_mut().zip(weights) {
        *part = weights.len() as u64 * u64::from(*weight);
    }
    for _ in weights {
        // the poorest item that still stands for itself, and the richest
        let (mut poor, mut rich) = ((sum, 0), (0, 0));
        for (i, ((part, other), _)) in parts.iter().zip(&*others).zip(weights).enumerate() {
            if usize::from(*other) == i {
                if *part < poor.0 {
                    poor = (*part, i);
                }
                if *part >= rich.0 {
                    rich = (*part, i);
                }
            }
        }
        let ((part, i), (_, rich)) = (poor, rich);
        if part >= sum {
            break;
        }
        // part < sum < 2^40, so that the quotient is below 2^32; what is open averages `sum`: the richest is another one and has enough
        if let (Some(threshold), Some(other)) = (thresholds.get_mut(i), others.get_mut(i)) {
            (*threshold, *other) = (ratio(part, 32, sum) as u32, rich as u8);
        }
        if let Some(left) = parts.get_mut(rich) {
            *left = left.wrapping_sub(sum - part);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_shared_out_in_proportion_to_the_weights() {
        for weights in [&[1_u32][..], &[1, 1], &[1, 85, 7, 7], &[0, 3, 0, 5], &[u32::MAX; 5], &[u32::MAX, 1]]
        {
            let table = Alias::<8>::new(weights).unwrap();
            let mut count = [0_u32; 8];
            let total = 1 << 20;
            for i in 0..total {
                count[table.pick(i << 12)] += 1;
            }
            let sum: f64 = weights.iter().map(|w| f64::from(*w)).sum();
            for (c, w) in count.iter().zip(weights) {
                let (got, want) = (f64::from(*c) / f64::from(total), f64::from(*w) / sum);
                assert!((got - want).abs() < 1e-5, "{weights:?}: {got} against {want}");
                assert!(*w > 0 || *c == 0, "an item without weight was drawn");
            }
        }
    }
}
