//! Orbits of `z <- z^2 + c`: the arithmetic that they run in, how they end, and how a cycle of them is
//! proven.

pub(crate) mod arithmetic;
pub(crate) mod block_float;
pub(crate) mod cardioid;
pub(crate) mod cycle;
pub(crate) mod dwell;
pub(crate) mod ending;
pub(crate) mod narrow;
pub(crate) mod upper;
pub(crate) mod wide_dwell;
pub(crate) mod word_orbit;
