//! The part of a ray inside of planes: what is left when half-spaces are cut off one after the other.
//!
//! The part of a ray on the inner side of a plane begins or ends where it crosses it; of all beginnings the
//! last counts, of all ends the first. Source: Kay, Kajiya, "Ray Tracing Complex Scenes", 1986.

use core::num::NonZeroU32;
use core::ops::ControlFlow;

use super::shape::NearCrossing;
use crate::num::formats::{Q28, Q31};
use crate::num::{Near, product, reciprocal_of};

/// A part of a ray, and the faces at its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Part {
    pub(super) begin: (Q28, u8),
    pub(super) end: (Q28, u8),
}

/// The reciprocal of a magnitude: mantissa and leading zeros, as [`reciprocal_of`]; of 0 as of `2^-28`: a ray
/// parallel to a plane leans by less than a direction's resolution.
#[inline(always)]
pub(super) fn slowness(d: Q28) -> (Q31, u32) {
    reciprocal_of(NonZeroU32::new(d.unsigned_abs()).unwrap_or(NonZeroU32::MIN))
}

/// `v` over the number whose reciprocal is given, 28 fractional bits, saturated.
#[inline(always)]
pub(super) fn over(v: Q28, (mantissa, zeros): (Q31, u32)) -> Q28 {
    // v mantissa 2^zeros / 2^34
    let product = product(v, mantissa) >> 2;
    let (high, low) = ((product >> 32) as i32, product as u32);
    let sign = high >> 31;
    if high >> ((zeros & 31) ^ 31) == sign {
        // by halves: a 64-bit shift by a variable takes twice as long
        high << (zeros & 31) | ((low >> 1) >> ((zeros & 31) ^ 31)) as i32
    } else {
        sign ^ i32::MAX
    }
}

impl Part {
    /// The whole ray.
    pub(super) const ALL: Self = Self { begin: (i32::MIN, 0), end: (i32::MAX, 0) };

    /// What is behind the crossing `s` with `face`.
    #[inline(always)]
    pub(super) fn from(&mut self, s: Q28, face: u8) {
        if s > self.begin.0 {
            self.begin = (s, face);
        }
    }

    /// What is before it.
    #[inline(always)]
    pub(super) fn until(&mut self, s: Q28, face: u8) {
        if s < self.end.0 {
            self.end = (s, face);
        }
    }

    /// The part inside a plane that is `height` below the origin (above 0: outside), and that the direction
    /// leaves by `up`.
    #[inline(always)]
    pub(super) fn below(&mut self, height: Q28, up: Q28, face: u8) {
        let s = over(height, slowness(up));
        if up < 0 {
            self.from(s, face);
        } else {
            self.until(s.saturating_neg(), face);
        }
    }

    /// Hands over both ends from `from` on, if there is anything between them.
    #[inline(always)]
    pub(super) fn hand_over(self, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let (begin, end) = (Near::from_bits(self.begin.0), Near::from_bits(self.end.0));
        if begin >= end || end < from {
            return;
        }
        if begin >= from && found(NearCrossing { s: begin, enters: true, face: self.begin.1 }).is_break() {
            return;
        }
        let _ = found(NearCrossing { s: end, enters: false, face: self.end.1 });
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::exact::words;
    use super::*;

    #[test]
    fn a_quotient_is_the_exact_one_or_saturates() {
        let mut word = words(5);
        let (mut close, mut saturated, mut worst) = (0, 0, 0);
        for k in 0..40_000_u32 {
            let v = (word() >> 32) as i32 >> (k % 31);
            let d = (word() >> 34) as i32 >> (k / 31 % 29);
            let exact = (i128::from(v) << 28) / i128::from(d.max(1));
            let got = i128::from(over(v, slowness(d)));
            // the reciprocal's 2^-29, and a unit
            let slack = 1 + (exact.abs() >> 29);
            if exact.abs() < (1 << 31) - 8 {
                worst = worst.max((got - exact).abs());
                assert!((got - exact).abs() <= slack + 1, "{v} {d}: {got} {exact}");
                close += 1;
            } else if exact.abs() > (1 << 31) + 8 {
                assert!(got == if v < 0 { i128::from(i32::MIN) } else { i128::from(i32::MAX) }, "{v} {d}");
                saturated += 1;
            }
        }
        assert!(close > 15_000 && saturated > 5_000 && worst >= 2, "{close} {saturated} {worst}");
    }
}
