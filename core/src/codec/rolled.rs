//! Loops that stay as they are written.
//!
//! A loop of few instructions is written out four times, or sixteen, by a compiler that counts cycles. Where
//! few pixels or bins come by that is flash for nothing: a decoder should fit a small microcontroller.

/// Said in the body of a loop, keeps the compiler from writing it out. Takes no instruction.
#[inline(always)]
pub(super) fn rolled() {
    core::hint::black_box(());
}

/// So many rounds of a loop, which the compiler does not write out one by one.
#[inline(always)]
pub(super) fn rounds(count: u32) -> u32 {
    core::hint::black_box(count)
}
