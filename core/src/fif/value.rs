//! Abscissae and values inside: 63 fractional bits on the unit interval, 55 above it.

use crate::Error;
use crate::num::{Real, Wide, round_shift};

/// Fractional bits of values and coefficients.
pub(crate) const FRACTION_Q55: u32 = 55;
/// One, as an abscissa with 63 fractional bits.
pub(crate) const ONE_UQ63: u64 = 1 << 63;

/// A description's number with 55 fractional bits; the caller has checked its range.
pub(crate) fn value(y: Wide) -> i64 {
    y.to_bits() << (FRACTION_Q55 - 48)
}

pub(crate) fn wide(value: i64) -> Wide {
    Wide::from_bits(round_shift(value, FRACTION_Q55 - 48))
}

#[inline(never)]
pub(crate) fn real_below(value: i64) -> Real {
    Real::from_bits((value >> (FRACTION_Q55 - 24)).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
}

pub(crate) fn real_above(value: i64) -> Real {
    let up = value.saturating_add((1 << (FRACTION_Q55 - 24)) - 1);
    real_below(up)
}

pub(crate) fn in_range(what: &'static str, index: Option<usize>, y: Wide) -> Result<(), Error> {
    let limit = Wide::from_num(128);
    // not `abs`: the least number has none
    if y.unsigned_abs() >= limit.unsigned_abs() {
        Err(Error::OutOfRange { what, index, value: y, min: -limit, max: limit })
    } else {
        Ok(())
    }
}

/// As many fractional bits as a word has room for above numbers up to `largest`, 20 to 30.
#[inline(never)]
pub(super) fn fraction_for(largest: u64) -> u32 {
    let integer_bits = (64 - largest.leading_zeros()).saturating_sub(FRACTION_Q55);
    31_u32.saturating_sub(integer_bits).clamp(20, 30)
}

/// The nearest word with so many fractional bits, saturated.
#[inline(never)]
pub(super) fn word(value: i64, fraction: u32) -> i32 {
    round_shift(value, FRACTION_Q55 - fraction).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

/// As [`crate::num::real_from`], without its 64 bits.
#[inline(always)]
pub(super) fn real(word: i32, fraction: u32) -> Real {
    Real::from_bits(match fraction.checked_sub(24) {
        Some(0) => word,
        Some(places) => (word >> (places & 31)) + ((word >> ((places - 1) & 31)) & 1),
        None => word.saturating_mul(1 << ((24 - fraction) & 31)),
    })
}
