//! The formats of numbers: the types that are handed over, and names for the raw integers that kernels
//! compute with.
//!
//! A kernel works on plain words, since a shift or the upper word of a product then is one instruction. The
//! word itself does not tell what it is worth. These names do, in signatures, fields, tables and constants,
//! by one rule:
//!
//! - `Qn` is a two's complement number with `n` fractional bits, worth `word / 2^n`. Its word is the
//!   narrowest that has room for the fraction and a sign: an `i32` up to `n` = 31, an `i64` up to 63, an
//!   `i128` above.
//! - `UQn` is the same without a sign: a `u32` up to `n` = 32, a `u64` above.
//!
//! They are aliases: the reader tells a `Q24` from a `Q30`, the compiler does not. A number in a wider word
//! than the rule says, as a sum of many `Q24` in 64 bits, keeps its plain type and a comment. The public
//! interface has types of the crate [`fixed`]: those below.

/// Coordinates, heights, distances: 24 fractional bits, `-128 .. 128`.
pub type Real = fixed::types::I8F24;
/// Direction cosines, weights, matrix entries: 30 fractional bits, `-2 .. 2`.
pub type Unit = fixed::types::I2F30;
/// Places near a shape, in coordinates in which it is about as large as 1: 28 fractional bits, `-8 .. 8`.
pub type Near = fixed::types::I4F28;
/// Light and its parts: 16 fractional bits, `0 .. 65536`.
pub type Lumen = fixed::types::U16F16;
/// Contraction factors: 31 fractional bits, `-1 .. 1`.
pub type Scaling = fixed::types::I1F31;
/// Abscissae and descriptions: 48 fractional bits, `-32768 .. 32768`.
pub type Wide = fixed::types::I16F48;

pub(crate) type Q14 = i32;
pub(crate) type Q16 = i32;
pub(crate) type Q17 = i32;
pub(crate) type Q18 = i32;
pub(crate) type Q21 = i32;
pub(crate) type Q22 = i32;
pub(crate) type Q24 = i32;
pub(crate) type Q25 = i32;
pub(crate) type Q26 = i32;
pub(crate) type Q27 = i32;
pub(crate) type Q28 = i32;
pub(crate) type Q29 = i32;
pub(crate) type Q30 = i32;
pub(crate) type Q31 = i32;
pub(crate) type Q32 = i64;
pub(crate) type Q44 = i64;
pub(crate) type Q46 = i64;
pub(crate) type Q48 = i64;
pub(crate) type Q52 = i64;
pub(crate) type Q54 = i64;
pub(crate) type Q56 = i64;
pub(crate) type Q58 = i64;
pub(crate) type Q60 = i64;
pub(crate) type Q124 = i128;

pub(crate) type UQ16 = u32;
pub(crate) type UQ24 = u32;
pub(crate) type UQ26 = u32;
pub(crate) type UQ27 = u32;
pub(crate) type UQ28 = u32;
pub(crate) type UQ30 = u32;
pub(crate) type UQ31 = u32;
pub(crate) type UQ32 = u32;
pub(crate) type UQ48 = u64;
pub(crate) type UQ56 = u64;
pub(crate) type UQ58 = u64;
pub(crate) type UQ60 = u64;
pub(crate) type UQ62 = u64;
pub(crate) type UQ63 = u64;
pub(crate) type UQ64 = u64;
