//! Complex numbers as pairs: vocabulary only, the arithmetic is in the kernels.

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
