//! Sets of leaves, a bit each: which a place is inside of.

/// Which leaves a place is inside of, and of which nobody knows.
#[derive(Debug, Clone, Copy)]
pub(super) struct States {
    pub(super) inside: u64,
    pub(super) unknown: u64,
}

/// The bit of a leaf.
#[inline(always)]
pub(super) fn bit(leaf: u8) -> u64 {
    // by words: a 64-bit shift by a variable takes twice as long
    let word = 1_u32 << (leaf & 31);
    if leaf & 32 == 0 { u64::from(word) } else { u64::from(word) << 32 }
}

/// Whether there is a leaf in a set.
#[inline(always)]
pub(super) fn has(leaves: u64, leaf: u8) -> bool {
    let word = if leaf & 32 == 0 { leaves as u32 } else { (leaves >> 32) as u32 };
    word >> (leaf & 31) & 1 > 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_has_the_leaves_that_are_put_into_it() {
        for leaf in 0..64 {
            assert_eq!(bit(leaf), 1 << leaf);
            for other in 0..64 {
                assert_eq!((has(bit(leaf), other), has(!bit(leaf), other)), (leaf == other, leaf != other));
            }
        }
    }
}
