//! Where the cells of a terrain lie in the world: equal rectangles, column by column and row by row.
//!
//! The plane between two columns is one number, whichever cell asks for it: rays leave one cell where they
//! enter the next.
//!
//! Formats: lengths 24 fractional bits, pitches 40, places inside a cell 30.

use crate::Error;
use crate::num::formats::{Q14, Q24, Q28, Q30};
use crate::num::{Real, Wide, high, product};

/// Columns or rows of cells along an axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rule {
    origin: Q24,
    end: Q24,
    /// How wide a cell is, 40 fractional bits.
    pitch: i64,
    /// Cells a unit, 23 fractional bits.
    density: i64,
    /// The same as a number of 31 bits and a power of two.
    mantissa: i32,
    exponent: i32,
    pub(super) count: u32,
}

/// `c 2^exponent`, rounded down; the caller knows that it is a word, and that the exponent is above -32.
#[inline(always)]
pub(super) fn shifted(c: i32, exponent: i32) -> i32 {
    if exponent < 0 { c >> (-exponent & 31) } else { c << (exponent & 31) }
}

impl Rule {
    /// So many cells from one coordinate to another.
    pub(super) fn new(what: &'static str, from: Real, to: Real, count: u32) -> Result<Self, Error> {
        let outside = |c: Real| c.to_bits() <= -(64 << 24) || c.to_bits() >= 64 << 24;
        if let Some(end) = [from, to].into_iter().find(|end| outside(*end)) {
            let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
            return Err(Error::OutOfRange { what, index: None, value: end.into(), min, max });
        }
        let width = i64::from(to.to_bits()) - i64::from(from.to_bits());
        // a cell at least 2^-13 wide: below 2^36 cells a unit with 23 fractional bits
        let pitch = (width << 16).checked_div(i64::from(count)).unwrap_or(0);
        if pitch < 1 << 27 {
            return Err(Error::Degenerate { what });
        }
        let density = i64::MAX.checked_div(pitch).unwrap_or(0);
        // 17 bits to 37 of them
        let zeros = density.leading_zeros();
        let mantissa = ((density << (zeros.wrapping_sub(1) & 63)) >> 32) as i32;
        let end = from.to_bits().wrapping_add(((i64::from(count) * pitch) >> 16) as i32);
        Ok(Self { origin: from.to_bits(), end, pitch, density, mantissa, exponent: 10 - zeros as i32, count })
    }

    /// The plane before a cell, or behind the last.
    #[inline(always)]
    pub(super) fn plane(&self, index: u32) -> Q24 {
        self.origin.wrapping_add(((i64::from(index) * self.pitch) >> 16) as i32)
    }

    /// The first and the last plane.
    pub(super) fn ends(&self) -> [Q24; 2] {
        [self.origin, self.end]
    }

    /// How wide a cell is, 24 fractional bits.
    pub(super) fn width(&self) -> Q24 {
        (self.pitch >> 16) as i32
    }

    /// How many columns a direction (28 fractional bits) crosses in a unit of the parameter, times
    /// `2^(shift + 14 - 24)`; the caller knows that it is a word.
    #[inline(always)]
    pub(super) fn columns_along(&self, direction: Q28, shift: i32) -> i32 {
        let exponent = self.exponent - 28 - 24 + 14 + 32 + shift;
        shifted(high(direction, self.mantissa), exponent.max(-31))
    }

    /// How many columns lie before a coordinate, 14 fractional bits; 0 before the first.
    #[inline(always)]
    pub(super) fn columns_before(&self, c: Q24) -> Q14 {
        // an exponent from -15 to 5
        shifted(high(c.wrapping_sub(self.origin).max(0), self.mantissa), self.exponent - 24 + 14 + 32)
    }

    /// How wide so many cells are, which are there, 24 fractional bits.
    #[inline(always)]
    pub(super) fn width_of(&self, count: u32) -> Q24 {
        ((i64::from(count) * self.pitch) >> 16) as i32
    }

    /// How far into a cell that is `size` columns wide a coordinate lies, from 0 to 1.
    #[inline(always)]
    pub(super) fn inside(&self, c: Q24, index: u32, size_log: u32) -> Q30 {
        let along = c.wrapping_sub(self.plane(index)).max(0);
        // along is at most a node and its rounding; an exponent from -37 to -17: two shifts by less than 32
        let part = product(along, self.mantissa) as u64 >> ((-6 - self.exponent) & 31) >> (size_log & 31);
        (part as i32).min(1 << 30)
    }

    /// The cell at a coordinate, those outside being the first or the last.
    pub(super) fn index(&self, c: Q24) -> u32 {
        let along = (i64::from(c) - i64::from(self.origin)).max(0);
        let index = ((i128::from(along) * i128::from(self.density)) >> 47) as i64;
        // no clamp, which would have to know that there are cells
        index.min(i64::from(self.count) - 1).max(0) as u32
    }
}
