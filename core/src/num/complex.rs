//! Complex numbers as pairs, for whatever says or returns a point of the complex plane.
//!
//! Vocabulary only: what multiplies them is in the kernels, each in the format that suits it.

use super::formats::Wide;

/// `re + i im`; `im` points upwards on a display.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Complex<T> {
    /// Real part.
    pub re: T,
    /// Imaginary part.
    pub im: T,
}

impl<T> Complex<T> {
    /// The number `re + i im`.
    pub const fn new(re: T, im: T) -> Self {
        Self { re, im }
    }
}

impl Complex<Wide> {
    /// The number `re + i im` from decimal literals, for constants:
    /// `const SEAHORSE: Complex<Wide> = Complex::lit("-0.7453", "0.1127")`.
    ///
    /// Text that is no number, or does not fit, is an error at compile time. Call it in a `const` or in
    /// `const { }` only: see [Numbers](crate::num#numbers).
    pub const fn lit(re: &str, im: &str) -> Self {
        Self::new(Wide::lit(re), Wide::lit(im))
    }
}
