//! What a plane's samples are: 8 or 16 bits.

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
}
