//! Products, shifts and quotients of 64-bit fixed-point numbers, from the 32-bit products that the target
//! has.
//!
//! Abscissae and values of interpolation functions have more than 32 bits. The compiler would multiply them
//! as `i128`, by a library call on 32-bit machines; these functions are a handful of `SMULL`/`UMULL` each.

use super::formats::{Q31, Real, UQ24, UQ63};
use super::product::{self, high_mixed, product, product_mixed, product_u};
use super::quotient::ratio;

/// `(value * factor) / 2^31`, for a factor with 31 fractional bits in `[-1, 1)`.
///
/// Domain: all. Exact, rounded towards minus infinity; -1 times `i64::MIN` saturates
/// (`a_number_is_scaled_exactly_from_end_to_end`). Cost: 3 multiplications.
#[inline]
pub fn scale31(value: i64, factor: i32) -> i64 {
    if value == i64::MIN && factor == i32::MIN {
        return i64::MAX;
    }
    // the lower word has no sign to be corrected for
    let low = product_u(value as u32, factor as u32) as i64;
    let correction = if factor < 0 { value << 32 } else { 0 };
    // modulo 2^64: the sum fits
    (product((value >> 32) as i32, factor) << 1).wrapping_add(low.wrapping_sub(correction) >> 31)
}

/// The high 64 bits of the 128-bit product, towards minus infinity. Exact.
#[inline]
pub fn mul_high(a: i64, b: i64) -> i64 {
    let ((ah, al), (bh, bl)) = (((a >> 32) as i32, a as u32), ((b >> 32) as i32, b as u32));
    // no sum leaves 64 bits
    let cross1 = product_mixed(ah, bl) + i64::from(product::high_u(al, bl));
    let cross2 = product_mixed(bh, al) + i64::from(cross1 as u32);
    product(ah, bh) + (cross1 >> 32) + (cross2 >> 32)
}

/// `a b / 2^32` towards minus infinity: [`mul_high`] of `2^32 b`. Exact.
#[inline(always)]
pub(crate) fn mul_high_short(a: i64, b: i32) -> i64 {
    product((a >> 32) as i32, b) + i64::from(high_mixed(b, a as u32))
}

/// The high 64 bits of the 128-bit product, rounded down. Exact.
// 70 instructions where products are made by halves: out of line, so that they are there once only
#[cfg_attr(no_long_product, inline(never))]
#[cfg_attr(not(no_long_product), inline)]
pub fn mul_high_u(a: u64, b: u64) -> u64 {
    let ((ah, al), (bh, bl)) = (((a >> 32) as u32, a as u32), ((b >> 32) as u32, b as u32));
    let low = u64::from(product::high_u(al, bl));
    let cross1 = product_u(ah, bl) + low; // cannot overflow: (2^32-1)^2 + 2^32-1 < 2^64
    let cross2 = product_u(al, bh) + (cross1 & 0xffff_ffff);
    product_u(ah, bh) + (cross1 >> 32) + (cross2 >> 32)
}

/// `v mantissa / 2^(half + 1)` towards minus infinity, for `half` at most 31: a number scaled by a reciprocal
/// square root.
#[inline(always)]
pub(crate) fn scaled(v: i32, (mantissa, half): (Q31, u32)) -> i32 {
    // by halves: a 64-bit shift by a variable takes twice as long
    let product = product(v, mantissa);
    ((((product as u32) >> (half & 31)) >> 1) | ((product >> 32) as u32) << ((half & 31) ^ 31)) as i32
}

/// `v << shift`, for shifts below 64.
#[inline(always)]
fn shifted(v: u64, shift: u32) -> u64 {
    // by halves: a 64-bit shift by a variable takes twice as long, or a call
    let (high, low) = if shift < 32 { ((v >> 32) as u32, v as u32) } else { (v as u32, 0) };
    let places = shift & 31;
    u64::from(high << places | (low >> 1) >> (places ^ 31)) << 32 | u64::from(low << places)
}

/// `value / 2^shift`, rounded to nearest (halves up): 0 for shifts of 64 and more. Exact
/// (`a_shift_rounds_to_nearest_at_every_width`).
#[inline]
pub const fn round_shift(value: i64, shift: u32) -> i64 {
    if shift == 0 {
        value
    } else if shift > 63 {
        0
    } else {
        // no overflow: shift first, then add the bit below
        (value >> shift) + ((value >> (shift - 1)) & 1)
    }
}

/// A reciprocal of an unsigned number with 63 fractional bits: `quotient(v)` is `v / d` for `v <= d`.
///
/// Exact when `d` is a power of two; else low by less than `2^-61`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reciprocal {
    mantissa: UQ63,
    shift: u32,
    /// See [`Reciprocal::halvings`].
    halvings: UQ24,
}

impl Reciprocal {
    /// The reciprocal of `d`, which is taken as 1 when it is 0.
    #[inline(never)]
    pub fn of(d: u64) -> Self {
        let d = d.max(1);
        let shift = d.leading_zeros();
        // 2^63 / m, m = d 2^shift / 2^63 in [1, 2): in (2^62, 2^63]
        Self { mantissa: ratio(1 << 63, 63, d << shift), shift, halvings: halvings(d << shift, shift) }
    }

    /// How often 1 has to be halved to reach `d` with 63 fractional bits: its negative logarithm. Error: low
    /// by less than 6 units (`halvings_are_low_by_less_than_six_units`); 0 where `d` is above 1.
    #[inline]
    pub(crate) fn halvings(self) -> UQ24 {
        self.halvings
    }

    /// `v / d` with 63 fractional bits, for `v <= d`.
    #[inline]
    pub fn quotient(self, v: u64) -> u64 {
        // below 2^64; product of two numbers with 63 fractional bits has 126, its high half 62
        let m = shifted(v, self.shift);
        // 1 has no other mantissa: widths that are powers of two need no product
        if self.mantissa >> 63 > 0 { m & !1 } else { mul_high_u(m, self.mantissa) << 1 }
    }

    /// `v / d` with 63 fractional bits for the `d` of which this is the reciprocal, rounded down, for
    /// `v < d`. Exact.
    pub(crate) fn exact(self, v: u64, d: u64) -> u64 {
        if self.mantissa >> 63 > 0 {
            return shifted(v, self.shift);
        }
        // 0 counts as 1: then v = 0
        let d = d.max(1);
        let mut quotient = self.quotient(v);
        // the remainder, below 5 d: its two words
        let product = (mul_high_u(quotient, d), quotient.wrapping_mul(d));
        let (mut low, borrow) = (v << 63).overflowing_sub(product.1);
        let mut high = (v >> 1).wrapping_sub(product.0).wrapping_sub(u64::from(borrow));
        while high > 0 || low >= d {
            high = high.wrapping_sub(u64::from(low < d));
            low = low.wrapping_sub(d);
            quotient += 1;
        }
        quotient
    }
}

/// What [`Reciprocal::halvings`] says of `m / 2^shift`, `m` with 63 fractional bits in `[1, 2)`.
///
/// Digit by digit: squaring a number doubles its logarithm, and a carry beyond 2 is the next digit (Knuth,
/// TAOCP vol. 1, 1.2.2, exercise 25). A function asks once a map: the table of [`super::log2`] would take ten
/// times the space.
fn halvings(m: u64, shift: u32) -> u32 {
    let mut mantissa = (m >> 32) as u32; // 31 fractional bits
    // 25 digits behind a mark, which ends the loop
    let mut digits = 1_u32;
    while digits >> 25 == 0 {
        let square = product::high_of_square_u(mantissa); // 30
        let carry = square >> 31;
        mantissa = square << (carry ^ 1);
        digits = digits << 1 | carry;
    }
    // to nearest; what squares leave out adds up to less than a unit, and what is left of one keeps the
    // result low
    (shift << 24).saturating_sub(((digits + 1) >> 1) - (1 << 24)).saturating_sub(2)
}

/// A 64-bit accumulator with `fraction` fractional bits as [`Real`], rounded to nearest, saturated.
#[inline]
pub(crate) fn real_from(accumulator: i64, fraction: u32) -> Real {
    let bits = if fraction >= 24 {
        round_shift(accumulator, fraction - 24)
    } else {
        accumulator.saturating_mul(1 << (24 - fraction))
    };
    Real::from_bits(bits.clamp(i32::MIN as i64, i32::MAX as i64) as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_high_product_is_that_of_128_bits() {
        let samples = [
            0,
            1,
            -1,
            i64::MAX,
            i64::MIN,
            0x1234_5678_9abc_def0,
            -0x0fed_cba9_8765_4321,
            1 << 32,
            -(1 << 32),
        ];
        for a in samples {
            for b in samples {
                assert_eq!(mul_high(a, b), ((i128::from(a) * i128::from(b)) >> 64) as i64, "{a} {b}");
                let short = (i128::from(a) * i128::from(b as i32)) >> 32;
                assert_eq!(i128::from(mul_high_short(a, b as i32)), short, "{a} {}", b as i32);
                let (a, b) = (a as u64, b as u64);
                assert_eq!(mul_high_u(a, b), ((u128::from(a) * u128::from(b)) >> 64) as u64, "{a} {b}");
            }
        }
    }

    /// Both ends, 0, and a few beside each; powers of two and their neighbours.
    fn extremes() -> impl Iterator<Item = i64> {
        let near = |v: i64| (-5..=5).map(move |off| v.wrapping_add(off));
        let powers = (0..63).flat_map(move |k| near(1 << k).chain(near(-1 << k)));
        near(i64::MIN).chain(near(0)).chain(powers).chain([0x1234_5678_9abc_def0, -0x0fed_cba9_8765_4321])
    }

    #[test]
    fn a_number_is_scaled_exactly_from_end_to_end() {
        let factors =
            [i32::MIN, i32::MIN + 1, -0x1357_9bdf, -2, -1, 0, 1, 2, 0x2468_ace0, i32::MAX - 1, i32::MAX];
        for (value, factor) in extremes().flat_map(|v| factors.map(|f| (v, f))) {
            let exact = (i128::from(value) * i128::from(factor)) >> 31;
            assert_eq!(i128::from(scale31(value, factor)), exact.min(i64::MAX.into()), "{value} {factor}");
        }
    }

    #[test]
    fn a_shift_rounds_to_nearest_at_every_width() {
        for (value, shift) in extremes().flat_map(|v| (0..70).map(move |s| (v, s))) {
            // halves up
            let exact =
                if shift == 0 { value.into() } else { (i128::from(value) + (1 << (shift - 1))) >> shift };
            assert_eq!(i128::from(round_shift(value, shift)), exact, "{value} / 2^{shift}");
        }
    }

    #[test]
    fn a_number_is_scaled_by_a_root_exactly() {
        for (v, half) in extremes().flat_map(|v| (0..32).map(move |h| (v as i32, h))) {
            for mantissa in [0, 1, i32::MAX, 0x5a82_799a] {
                let exact = (i128::from(v) * i128::from(mantissa)) >> (half + 1);
                if exact == i128::from(exact as i32) {
                    assert_eq!(i128::from(scaled(v, (mantissa, half))), exact, "{v} {mantissa} {half}");
                }
            }
        }
    }

    #[test]
    fn halvings_are_low_by_less_than_six_units() {
        let mut worst: f64 = 0.0;
        let mut word = 1_u64;
        for k in 0..200_000 {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let d = (word >> (k % 64)).max(1);
            let exact = (63.0 - (d as f64).log2()) * 16_777_216.0;
            let got = f64::from(Reciprocal::of(d).halvings());
            if d > 1 << 63 {
                assert_eq!(got, 0.0, "{d}");
            } else {
                // the logarithm in f64 is good to 2^-46, 2^-22 of a unit
                assert!(
                    got == 0.0 && exact < 6.0 || (-1e-6..6.0).contains(&(exact - got)),
                    "{d}: {got} {exact}"
                );
                worst = worst.max(exact - got);
            }
        }
        assert!(worst > 1.5, "{worst}");
    }

    #[test]
    fn a_power_of_two_divides_exactly() {
        for k in 1..63 {
            let r = Reciprocal::of(1 << k);
            for v in [0, 1, (1_u64 << k) - 1, 1 << k] {
                assert_eq!(r.quotient(v), ((u128::from(v) << 63) >> k) as u64, "{v} / 2^{k}");
            }
        }
    }

    #[test]
    fn a_quotient_is_low_by_less_than_two_to_the_minus_61() {
        let mut worst = 0;
        for d in extremes().map(|d| d as u64).filter(|d| *d > 0) {
            let r = Reciprocal::of(d);
            for v in [0, 1, 2, d / 3, d / 2, d / 2 + 1, d - d / 7, d - 1, d].into_iter().filter(|v| *v <= d) {
                let exact = (u128::from(v) << 63) / u128::from(d);
                let got = u128::from(r.quotient(v));
                assert!(got <= exact && exact - got < 4, "{v} / {d}: {got} against {exact}");
                worst = worst.max(exact - got);
                assert!(v == d || u128::from(r.exact(v, d)) == exact, "{v} / {d}");
            }
        }
        assert!(worst > 1);
        assert_eq!(Reciprocal::of(0), Reciprocal::of(1));
    }

    #[test]
    fn halvings_are_never_too_many() {
        for i in 1..20_000_u64 {
            let d = i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (1 + i % 50);
            let exact = (63.0 - (d as f64).log2()) * 2_f64.powi(24);
            let got = f64::from(Reciprocal::of(d).halvings());
            assert!(got <= exact + 1e-6 && got > exact - 6.0, "{d}: {got} {exact}");
        }
    }
}
