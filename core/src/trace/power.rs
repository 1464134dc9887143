//! Products and powers of numbers in `[0, 1]`, as highlights take them.
//!
//! Format: 30 fractional bits, each product to the nearest.

use crate::num::Unit;

/// The product of two numbers in `[0, 1]`.
#[inline]
pub(super) fn times(a: Unit, b: Unit) -> Unit {
    Unit::from_bits(((i64::from(a.to_bits()) * i64::from(b.to_bits()) + (1 << 29)) >> 30) as i32)
}

/// `base^exponent` by squaring, for a base in `[0, 1]`.
#[inline]
pub(super) fn power(base: Unit, exponent: u16) -> Unit {
    let (mut result, mut square, mut rest) = (Unit::ONE, base, exponent);
    while rest > 0 {
        if rest & 1 == 1 {
            result = times(result, square);
        }
        square = times(square, square);
        rest >>= 1;
    }
    result
}
