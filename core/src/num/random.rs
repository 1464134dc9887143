//! Choosing one of `n` items with given probabilities in constant time: the alias method.
//!
//! Source: A. J. Walker, "An efficient method for generating discrete random variables", 1977; the table by M. D. Vose, 1991.

use super::ratio;
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
        // Each slot holds `sum` parts; an item with weight w owns n w of them.
        let mut parts = [0_u64; N];
        let mut table = Self { threshold: [u32::MAX; N], other: [0; N], len: n as u32 };
        for (i, (part, weight)) in parts.iter_mut().zip(weights).enumerate() {
            *part = n as u64 * u64::from(*weight);
            if let Some(other) = table.other.get_mut(i) {
                *other = i as u8;
            }
        }
        let mut settled = [false; N];
        for _ in 0..n {
            // the poorest item not settled yet, and the richest
            let open = || {
                parts
                    .iter()
                    .zip(&settled)
                    .enumerate()
                    .take(n)
                    .filter(|(_, (_, s))| !**s)
                    .map(|(i, (p, _))| (*p, i))
            };
            let (Some((poor, i)), Some((_, rich))) = (open().min(), open().max()) else { break };
            if poor >= sum {
                break;
            }
            // poor < sum < 2^40, so that the quotient is below 2^32
            let fraction = ratio(poor, 32, sum) as u32;
            if let (Some(t), Some(o), Some(s)) =
                (table.threshold.get_mut(i), table.other.get_mut(i), settled.get_mut(i))
            {
                *t = fraction;
                *o = rich as u8;
                *s = true;
            }
            if let Some(p) = parts.get_mut(rich) {
                *p = p.saturating_sub(sum - poor);
            }
        }
        Ok(table)
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
        let product = u64::from(word) * u64::from(self.len);
        let slot = (product >> 32) as usize;
        // slot < len <= N: `get` only spares the proof to the compiler
        match (self.threshold.get(slot), self.other.get(slot)) {
            (Some(threshold), Some(other)) if product as u32 >= *threshold => *other as usize,
            _ => slot,
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
