//! What a plane's samples are: 8 or 16 bits.

use core::ops::{Add, Sub};

mod sealed {
    pub trait Sealed {}
    impl Sealed for u8 {}
    impl Sealed for u16 {}
}

/// A sample of a picture: `u8` or `u16`.
pub trait Sample: Copy + sealed::Sealed + 'static {
    /// How many bits it has.
    const BITS: u32;
    /// The nearest sample of a number.
    fn cut(value: i32) -> Self;
    /// As a number.
    fn number(self) -> i32;
    /// What sums of a transform's products fit.
    #[doc(hidden)]
    type Sum: Copy + From<i32> + Into<i64> + Add<Output = Self::Sum> + Sub<Output = Self::Sum>;
    /// The product of a cosine and a term.
    #[doc(hidden)]
    fn product(cosine: i32, term: i32) -> Self::Sum;
    /// A term as it is kept: 16 of them times cosines of 14 bits stay within a sum.
    #[doc(hidden)]
    fn term(value: i32) -> i32;
}

impl Sample for u8 {
    const BITS: u32 = 8;
    #[inline]
    fn cut(value: i32) -> Self {
        value.clamp(0, 255) as Self
    }
    #[inline]
    fn number(self) -> i32 {
        self.into()
    }
    type Sum = i32;
    #[inline]
    fn product(cosine: i32, term: i32) -> i32 {
        cosine * term
    }
    #[inline]
    fn term(value: i32) -> i32 {
        value.clamp(-(1 << 13), (1 << 13) - 1)
    }
}

impl Sample for u16 {
    const BITS: u32 = 16;
    #[inline]
    fn cut(value: i32) -> Self {
        value.clamp(0, 65535) as Self
    }
    #[inline]
    fn number(self) -> i32 {
        self.into()
    }
    type Sum = i64;
    #[inline]
    fn product(cosine: i32, term: i32) -> i64 {
        i64::from(cosine) * i64::from(term)
    }
    #[inline]
    fn term(value: i32) -> i32 {
        value.clamp(-(1 << 23), (1 << 23) - 1)
    }
}
