//! What unit tests of this room draw: words and matrices.

use super::barycentric::{Barycentric, completed};
use crate::num::Near;

/// Seeded words of so many bits.
pub(super) fn words(seed: u64) -> impl FnMut(u32) -> i32 {
    let mut word = seed;
    move |bits| {
        word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (word >> 32) as i32 >> (32 - bits)
    }
}

/// A matrix of seeded columns.
pub(super) fn seeded<const J: usize>(word: &mut impl FnMut(u32) -> i32) -> Barycentric<J> {
    let columns = [(); J].map(|()| completed([(); J].map(|()| word(28))).map(Near::from_bits));
    Barycentric::from_columns(columns).unwrap()
}
