//! One axis of the ground under a height field: the running sums of its profile above intervals.
//!
//! Formats: lengths 24 fractional bits, places and widths as parts of the domain 30.

use core::num::NonZeroU32;

use crate::fif::{Course, Sum, Sums, Width};
use crate::num::{product, reciprocal_of};

/// The whole domain.
const WHOLE: i32 = 1 << 30;

/// One axis: the sums above it and where it lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ground<'a> {
    sums: Sums<'a>,
    origin: i32,
    /// The reciprocal of its length: mantissa and shift of a product.
    per_length: (i32, u32),
}

/// Half of a box along an axis, and the reciprocals of its width.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    half: i32,
    /// How far to the right it may begin, how much of it may lie outside, and on how much of the ground it
    /// may begin for that.
    last: i32,
    spare: i32,
    allowed: u32,
    width: Width,
}

impl<'a> Ground<'a> {
    /// The axis of a profile that begins at `origin` and is `length` long.
    pub(super) fn new(sums: Sums<'a>, origin: i32, length: i32) -> Self {
        let length = NonZeroU32::new(length.unsigned_abs()).unwrap_or(NonZeroU32::MIN);
        let (mantissa, zeros) = reciprocal_of(length);
        Self { sums, origin, per_length: (mantissa, 32_u32.saturating_sub(zeros).clamp(1, 31)) }
    }

    /// A length as a part of the whole, saturated at twice the whole.
    #[inline(always)]
    pub(super) fn part(&self, length: i32) -> i32 {
        let (mantissa, shift) = self.per_length;
        let product = product(length, mantissa);
        let (high, low) = ((product >> 32) as i32, product as u32);
        // twice the whole is where words end, and a shift is one of 1 to 31
        let sign = high >> 31;
        if high >> (shift.wrapping_sub(1) & 31) == sign {
            high << 1 << (31_u32.wrapping_sub(shift) & 31) | (low >> (shift & 31)) as i32
        } else {
            sign ^ i32::MAX
        }
    }

    /// A factor, 26 fractional bits, as one by which the upper word of a product with `length << up` is a
    /// part of the whole.
    #[inline(always)]
    pub(super) fn factor(&self, times: i32, up: u32) -> i32 {
        let (mantissa, shift) = self.per_length;
        let factor = product(times, mantissa) >> ((shift + up).saturating_sub(6) & 63);
        factor.clamp(i32::MIN.into(), i32::MAX.into()) as i32
    }

    /// Where a place lies in the domain.
    #[inline(always)]
    pub(super) fn place(&self, x: i32) -> i32 {
        self.part(x.saturating_sub(self.origin))
    }

    /// So far to both sides. One half in `2^firm` of that may lie outside where it stands for all of it.
    #[inline(always)]
    pub(super) fn side(&self, half: i32, firm: u32) -> Side {
        let half = self.part(half).clamp(0, WHOLE / 2 - 1) | 1;
        let width = NonZeroU32::new(half.unsigned_abs() << 3).unwrap_or(NonZeroU32::MIN);
        let (last, spare) = (WHOLE - 1 - (half << 1), half >> (firm & 31));
        Side {
            half,
            last,
            spare,
            allowed: (last + 1 + (spare << 1)) as u32,
            width: self.sums.width_of(width),
        }
    }

    /// The profile so far to both sides of a place, moved inside where it is outside by no more than it may;
    /// none where by more. The same along both axes: a function of its own, which writes where its result
    /// stays.
    #[inline(never)]
    pub(super) fn around(&self, middle: i32, side: &Side, course: &mut Course) -> Option<()> {
        let from = middle.saturating_sub(side.half);
        let inside = from.wrapping_add(side.spare) as u32 <= side.allowed;
        if inside { self.beginning(from, side, course) } else { None }
    }

    /// The same moved inside from anywhere.
    #[inline(always)]
    pub(super) fn nearest(&self, middle: i32, side: &Side) -> Option<Course> {
        let mut course = Course::default();
        self.beginning(middle.saturating_sub(side.half), side, &mut course)?;
        Some(course)
    }

    #[inline(always)]
    fn beginning(&self, from: i32, Side { half, last, width, .. }: &Side, course: &mut Course) -> Option<()> {
        let from = from.max(0).min(*last);
        let to = from + (half << 1);
        self.sums.course((from as u32) << 2, (to as u32) << 2, width, course)
    }

    /// The sums up to a place; beyond an end the profile goes on straight, and how far is added to `beyond`.
    #[inline(always)]
    pub(super) fn at(&self, place: i32, beyond: &mut u32) -> Option<Sum> {
        let inside = place.clamp(0, WHOLE - 1);
        let sum = self.sums.at(&self.sums.place((inside as u32) << 2)?);
        if inside == place {
            return Some(sum);
        }
        let by = place.wrapping_sub(inside);
        *beyond = beyond.saturating_add(by.unsigned_abs());
        Some(self.sums.beyond(&sum, by))
    }

    /// The mean value between two places, so far from the first to the second.
    #[inline(always)]
    pub(super) fn mean(&self, from: &Sum, to: &Sum, width: i32) -> i32 {
        self.sums.mean_between(from, to, width)
    }

    /// A slope for one of a number per domain.
    #[inline(always)]
    pub(super) fn per_length(&self, slope: i32) -> i32 {
        let (mantissa, shift) = self.per_length;
        (product(slope, mantissa) >> (shift.wrapping_add(6) & 63)) as i32
    }

    /// The value at a place, that at the nearer end outside.
    #[inline(always)]
    pub(super) fn value(&self, place: i32) -> i32 {
        self.sums.value_at((place.clamp(0, WHOLE - 1) as u32) << 2)
    }
}
