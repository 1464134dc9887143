//! Products and powers of numbers in `[0, 1]`, as highlights take them.
//!
//! Format: 30 fractional bits, each product to the nearest.

use crate::num::{Unit, high_u};

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

/// `base^exponent` of four bases at once, 30 fractional bits; what is not in `[0, 1]` counts as the nearer end.
///
/// Inside 32 fractional bits, each product rounded down: short of the power by less than `exponent / 2^30`.
#[inline]
pub(super) fn powers(bases: [i32; 4], exponent: u16) -> [i32; 4] {
    let squares = |square: [u32; 4]| square.map(|s| high_u(s, s));
    let mut square = bases.map(|base| (base.clamp(0, (1 << 30) - 1) as u32) << 2);
    let twos = exponent.trailing_zeros();
    let mut rest = u32::from(exponent) >> twos;
    if rest == 0 {
        return [1 << 30; 4];
    }
    for _ in 0..twos {
        square = squares(square);
    }
    let mut result = square;
    while rest > 1 {
        square = squares(square);
        rest >>= 1;
        if rest & 1 == 1 {
            for (r, s) in result.iter_mut().zip(square) {
                *r = high_u(*r, s);
            }
        }
    }
    result.map(|r| (r >> 2) as i32)
}
