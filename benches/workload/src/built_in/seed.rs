//! The seed of the command's own pictures.

pub(super) const SEED: u64 = 1;
