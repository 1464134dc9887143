//! What the loops in floating point compute with, in single and in double precision: C's operators, and two
//! that `core` has not yet.
//!
//! Where the target has a single-precision FPU, a C compiler turns `sqrtf` into VSQRT and, contracting as C
//! compilers do by default, `a * b + c` into VFMA. Rust never contracts, so the f32 loops ask for it by name;
//! otherwise fixed point would win against a straw man. The names are unstable in `core`:
//! `benches/cortex-m/.cargo/config.toml` permits them to this crate alone.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// `float` or `double`.
pub(crate) trait Float:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The nearest number: for constants and set-up, not for loops.
    fn of(v: f64) -> Self;

    /// The nearest number to an integer.
    fn of_int(v: i32) -> Self;

    /// `self * b + c`, fused where the target does it in one instruction.
    fn fused(self, b: Self, c: Self) -> Self;

    /// The square root.
    fn root(self) -> Self;

    /// Of a number above 0.
    fn power(self, exponent: Self) -> Self;

    /// The greatest integer that is not above it.
    fn floor(self) -> i32;

    /// For a checksum.
    fn fold(self) -> u32;

    /// The smaller of two, `self` if neither is.
    #[inline(always)]
    fn least(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of two, `self` if neither is.
    #[inline(always)]
    fn most(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
}

impl Float for f32 {
    #[inline(always)]
    fn of(v: f64) -> Self {
        v as f32
    }

    #[inline(always)]
    fn of_int(v: i32) -> Self {
        v as f32
    }

    #[inline(always)]
    fn fused(self, b: Self, c: Self) -> Self {
        mul_add(self, b, c)
    }

    #[inline(always)]
    fn root(self) -> Self {
        sqrt(self)
    }

    #[inline(always)]
    fn power(self, exponent: Self) -> Self {
        libm::powf(self, exponent)
    }

    #[inline(always)]
    fn floor(self) -> i32 {
        let whole = self as i32;
        whole - i32::from(self < whole as f32)
    }

    #[inline(always)]
    fn fold(self) -> u32 {
        self.to_bits()
    }
}

impl Float for f64 {
    #[inline(always)]
    fn of(v: f64) -> Self {
        v
    }

    #[inline(always)]
    fn of_int(v: i32) -> Self {
        f64::from(v)
    }

    #[inline(always)]
    fn fused(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    #[inline(always)]
    fn root(self) -> Self {
        libm::sqrt(self)
    }

    #[inline(always)]
    fn power(self, exponent: Self) -> Self {
        libm::pow(self, exponent)
    }

    #[inline(always)]
    fn floor(self) -> i32 {
        let whole = self as i32;
        whole - i32::from(self < f64::from(whole))
    }

    #[inline(always)]
    fn fold(self) -> u32 {
        fold(self)
    }
}

/// A result in double precision, for a checksum.
#[inline(always)]
pub(crate) fn fold(v: f64) -> u32 {
    let bits = v.to_bits();
    bits as u32 ^ (bits >> 32) as u32
}

/// `a * b + c`, fused where the target does it in one instruction.
#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
#[inline(always)]
pub(crate) fn mul_add(a: f32, b: f32, c: f32) -> f32 {
    a * b + c
}

#[cfg(not(all(target_arch = "arm", target_abi = "eabihf")))]
pub(crate) use libm::sqrtf as sqrt;

#[cfg(all(target_arch = "arm", target_abi = "eabihf"))]
pub(crate) use core::f32::math::{mul_add, sqrt};
