//! Numbers shifted to the upper end of their word, and by how many places.
//!
//! A Cortex-M4 counts leading zeros by an instruction. A Cortex-M0 calls a function of 35 instructions and
//! shifts then; here it halves its way there, inline, and shifts as it goes. Such a machine is the one
//! without a long product (`build.rs`).

use core::num::NonZeroU32;

/// `v` shifted by an even number of places, so that one of its two highest bits is set, and by how many.
/// Exact.
#[inline(always)]
pub(crate) fn shifted_up_evenly(v: NonZeroU32) -> (u32, u32) {
    evenly(v.get())
}

/// The same of a number that its type does not know not to be 0.
#[inline(always)]
pub(crate) fn evenly(v: u32) -> (u32, u32) {
    if cfg!(no_long_product) {
        by_halving(v)
    } else {
        let places = v.leading_zeros() & 30;
        (v << places, places)
    }
}

/// How many places [`shifted_up_evenly`] shifts a number that mostly takes few: on a Cortex-M0 8 instructions
/// for those of at least `2^28`.
#[inline(always)]
pub(crate) fn even_zeros(v: NonZeroU32) -> u32 {
    if !cfg!(no_long_product) { v.leading_zeros() & 30 } else { few_first(v.get()) }
}

#[inline(always)]
fn few_first(v: u32) -> u32 {
    if v >> 28 != 0 { u32::from(v >> 30 == 0) << 1 } else { by_halving(v).1 }
}

#[inline(always)]
fn by_halving(mut v: u32) -> (u32, u32) {
    let mut places = 0;
    for step in [16, 8, 4, 2] {
        if v >> (32 - step) == 0 {
            v <<= step;
            places += step;
        }
    }
    (v, places)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_shift_by_the_even_part_of_the_leading_zeros() {
        let spread = (0..200_000_u32).map(|i| i.wrapping_mul(0x9e37_79b9) >> (i % 32));
        let powers = (0..32).flat_map(|k| [1_u32 << k, (1_u32 << k).wrapping_sub(1), (1 << k) | 1]);
        for v in spread.chain(powers).filter_map(NonZeroU32::new) {
            let zeros = v.leading_zeros();
            let even = zeros & !1;
            assert_eq!(by_halving(v.get()), (v.get() << even, even), "{v}");
            assert_eq!(shifted_up_evenly(v), (v.get() << even, even), "{v}");
            assert_eq!([few_first(v.get()), even_zeros(v)], [even; 2], "{v}");
        }
    }
}
