//! Reciprocal, square root and reciprocal square root: a table, then Newton's iteration.
//!
//! No 32-bit processor has them for integers, and a division of 64 bits takes longer than the four to nine
//! multiplications here.
//!
//! The argument is brought into an interval of a factor 2 or 4; its first bits choose a seed, a value good to
//! 8 bits, from the table. Newton's iteration, `y <- y (2 - m y)` for `1/m` and `y <- y (3 - m y^2) / 2` for
//! `1/sqrt(m)`, doubles the number of correct bits each time. Formats are chosen so that of every product the
//! high word alone is needed.

use core::num::NonZeroU32;

use super::formats::{Q31, UQ30, UQ31};
use super::product::{high, high_of_square_u, high_u, high_u_below, product_u, square_u};
use super::zeros::{evenly, shifted_up_evenly};

/// Seeds of `1/m` for `m = 1 + (i + 1/2) / 128`, 16 fractional bits.
pub(super) static SEEDS: [u16; 128] = {
    let mut table = [0; 128];
    let mut i = 0;
    while i < 128 {
        // 2^16 / (1 + (2 i + 1) / 256)
        table[i] = ((1_u64 << 24) / (256 + 2 * i as u64 + 1)) as u16;
        i += 1;
    }
    table
};

/// Seeds of `1/sqrt(m)` for `m = (i + 1/2) / 64`, 16 fractional bits. Those below `i` = 64 are never asked
/// for: they spare a subtraction.
static RECIPROCAL_SQRT: [u16; 256] = {
    let mut table = [u16::MAX; 256];
    let mut i = 64;
    while i < 256 {
        // sqrt(2^32 / m) = sqrt(2^39 / (2 i + 1))
        let square = (1_u64 << 39) / (2 * i as u64 + 1);
        let mut root = 0_u64;
        let mut bit = 1_u64 << 16;
        while bit > 0 {
            if (root | bit) * (root | bit) <= square {
                root |= bit;
            }
            bit >>= 1;
        }
        table[i] = root as u16;
        i += 1;
    }
    table
};

/// `1/d` as `mantissa / 2^shift`, the mantissa with 31 fractional bits in `(1/2, 1]`.
///
/// Domain: `d > 0` (0 counts as 1). Error: below `2^-29` relative
/// (`a_reciprocal_is_within_two_to_the_minus_29`). Cost: 4 multiplications, a table of 256 bytes.
#[inline]
pub fn reciprocal(d: u32) -> (u32, u32) {
    let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(d).unwrap_or(NonZeroU32::MIN));
    // d = m 2^(31 - zeros)
    (mantissa as u32, 62 - zeros)
}

/// The mantissa of `1/d`, below `2^31`, and how many zeros lead `d`: `1/d` is `mantissa 2^zeros / 2^62`.
#[inline(always)]
pub(crate) fn reciprocal_of(d: NonZeroU32) -> (Q31, u32) {
    let zeros = d.leading_zeros();
    let m = d.get() << zeros; // 31 fractional bits, in [1, 2)
    let seed = SEEDS[((m >> 24) & 127) as usize];
    // y with 32 fractional bits, m y and 2 - m y with 31, their product with 31; m y is within 2^-7 of 1
    let mut y = u32::from(seed) << 16;
    y = high_u(high_u(m, y).wrapping_neg(), y) << 1;
    (high_u(high_u(m, y).wrapping_neg(), y) as i32, zeros)
}

/// `1/sqrt(v)` as `mantissa / 2^shift`, the mantissa with 31 fractional bits in `(1/2, 1]`.
///
/// Domain: `v > 0` (0 counts as 1). Error: below `2^-29` relative
/// (`a_reciprocal_root_is_within_two_to_the_minus_29`). Cost: 6 multiplications, a table of 512 bytes.
#[inline]
pub fn reciprocal_sqrt(v: u64) -> (u32, u32) {
    let (mantissa, half) = reciprocal_sqrt_of(v);
    (mantissa as u32, 31 + half)
}

/// The mantissa of `1/sqrt(v)`, below `2^31`, and `half`, at most 31: `1/sqrt(v)` is
/// `mantissa / 2^(31 + half)`.
#[inline(always)]
pub(crate) fn reciprocal_sqrt_of(v: u64) -> (Q31, u32) {
    let (m, half) = normal(v);
    (newton(m) as i32, half)
}

/// The same for a `v` of at least `2^32`: there is nothing to choose.
#[inline(always)]
pub(crate) fn reciprocal_sqrt_of_long(v: u64) -> (Q31, u32) {
    let (high, even) = evenly((v >> 32) as u32);
    let m = high | ((v as u32) >> 1) >> (even ^ 31);
    (newton(m) as i32, (even >> 1) ^ 31)
}

/// `v` as `m / 4^up` with `m` in `[1, 4)`, 30 fractional bits, and `1/sqrt(m)`, 31 fractional bits, below 1:
/// `m`, the root and `up`, at most 15. Domain: `v > 0`.
#[inline(always)]
pub(crate) fn root_of_word(v: u32) -> (UQ30, UQ31, u32) {
    let (m, even) = evenly(v);
    (m, newton(m), even >> 1)
}

/// `floor(sqrt(v))`. Exact. Cost: 9 multiplications.
pub fn sqrt(v: u64) -> u32 {
    sqrt_by::<{ cfg!(no_long_product) }>(v)
}

/// The same, for a machine that multiplies `BY_HALVES` with products of 16 bits where these will do.
#[inline(always)]
fn sqrt_by<const BY_HALVES: bool>(v: u64) -> u32 {
    if v == 0 {
        return 0;
    }
    let (m, half) = normal(v);
    let seed = RECIPROCAL_SQRT[(m >> 24) as usize];
    let y = if BY_HALVES { newton_short(m, seed) } else { newton_step(m, u32::from(seed) << 16) << 1 };
    // low by a unit of m y^2 more than it was rounded: the root stays below 2^32
    let y = high_u_below(y, (3 << 30) - 4 - high_u(m, high_of_square_u(y)));
    // sqrt(m) with 61 fractional bits, times 2^half: too small by less than 2^5
    let root = (high_u(m, y) << 2) >> (half ^ 31);
    let rest = |root: u32| v.wrapping_sub(square_u(root)) as i64;
    // one more Newton step: the remainder, below 2^7 2^half, times 1 / (2 root)
    let left = rest(root);
    // by words: a 64-bit shift by a variable is a call on a Cortex-M0
    let left = ((left as u32) >> half | (((left >> 32) as u32) << 1) << (half ^ 31)) as i32;
    let step = if BY_HALVES {
        (left.wrapping_mul((y >> 16) as i32) >> 15).wrapping_add(1) >> 1
    } else {
        high(left, y as i32)
    };
    let root = root.wrapping_add(step as u32);
    let left = rest(root);
    if left < 0 { root.wrapping_sub(1) } else { root.wrapping_add(u32::from(left > 2 * i64::from(root))) }
}

/// `floor(sqrt(v))` of 32 bits by products of 16. Exact.
#[inline]
pub(crate) fn sqrt_short(v: u32) -> u32 {
    let Some(v) = NonZeroU32::new(v) else { return 0 };
    let (m, even) = shifted_up_evenly(v);
    // m has 30 fractional bits, its root 15: with the seed for 1/sqrt(m), which has 16, 8 of them
    let seed = u32::from(RECIPROCAL_SQRT[(m >> 24) as usize]);
    let root = (m >> 16).wrapping_mul(seed) >> 15;
    let rest = |root: u32| m.wrapping_sub(root.wrapping_mul(root)) as i32;
    // one Newton step: the remainder, below 2^24, over twice the root; at most a unit from the floor
    let step = (rest(root) >> 10).wrapping_mul(seed as i32) >> 22;
    let root = root.wrapping_add(step as u32);
    let left = rest(root);
    let root =
        if left < 0 { root.wrapping_sub(1) } else { root.wrapping_add(u32::from(left as u32 > 2 * root)) };
    root >> ((even >> 1) & 31)
}

/// `sqrt(v)` within 1 unit, and `1/sqrt(v)` within `2^-26` of itself as `mantissa / 2^(62 - places)`: for
/// numbers that have been scaled, at a third of the cost of [`sqrt`].
///
/// Domain: `2^58 <= v < 2^63`. Result: root, mantissa, places (0 to 2).
#[inline]
pub(crate) fn root_and_reciprocal(v: u64) -> (u32, u32, u32) {
    let high_word = (v >> 32) as u32;
    let places = if cfg!(no_long_product) {
        // a Cortex-M0 counts zeros by a call
        u32::from(high_word < 1 << 30) + u32::from(high_word < 1 << 28)
    } else {
        (high_word.leading_zeros() >> 1) & 3
    };
    // the low word is left to the correction
    let m = high_word << (2 * places);
    let y = newton(m);
    let root = (product_u(m, y) >> 30) as u32 >> places;
    // one Newton step: the remainder, below 2^38, over twice the root
    let rest = v.wrapping_sub(square_u(root)) as i64;
    let correction = high((rest >> 8) as i32, (y >> 1) as i32);
    let correction = ((correction >> (21 - places)) + 1) >> 1;
    (root.wrapping_add(correction as u32), y, places)
}

/// `sqrt(v)` within `2^-28` of itself and a unit (0 counts as 1): a third of the cost of [`sqrt`].
///
/// Error: as said (`a_rough_root_is_within_two_to_the_minus_28`).
#[inline(always)]
pub(crate) fn rough_sqrt(v: u64) -> u32 {
    let (m, half) = normal(v);
    // the root of m with 61 fractional bits
    (product_u(m, newton(m)) >> 30) as u32 >> (half ^ 31)
}

/// `v` as `m 4^half` with `m` in `[1, 4)`, truncated.
#[inline(always)]
fn normal(v: u64) -> (UQ30, u32) {
    let low = v as u32;
    match NonZeroU32::new((v >> 32) as u32) {
        Some(high) => {
            let (high, even) = shifted_up_evenly(high);
            (high | (low >> 1) >> (even ^ 31), (even >> 1) ^ 31)
        }
        None => {
            let (low, even) = shifted_up_evenly(NonZeroU32::new(low).unwrap_or(NonZeroU32::MIN));
            (low, (even >> 1) ^ 15)
        }
    }
}

/// `1/sqrt(m)`.
#[inline(always)]
fn newton(m: UQ30) -> UQ31 {
    let y = newton_step(m, u32::from(RECIPROCAL_SQRT[(m >> 24) as usize]) << 16) << 1;
    newton_step(m, y)
}

/// One step from `y`, which has 32 fractional bits.
#[inline(always)]
fn newton_step(m: UQ30, y: u32) -> UQ31 {
    // m y^2 and 3 - m y^2 with 30 fractional bits; their product is twice the next y, with 30
    high_u_below(y, (3 << 30) - high_u(m, high_of_square_u(y)))
}

/// The first step from a seed of 16 bits by products of 16 and 17 bits, 32 fractional bits: within `2^-13.9`
/// of the exact root, and below 1.
#[inline(always)]
fn newton_short(m: UQ30, seed: u16) -> u32 {
    let y = u32::from(seed);
    // m y^2 with 31 fractional bits, within 2^-6 of 1
    let square = (m >> 15).wrapping_mul(y.wrapping_mul(y) >> 16);
    // half of what was rounded down there is taken off here, so that near m = 1 no y reaches 1
    let rest = ((3 << 30) - (1 << 15) - (square >> 1)) >> 16;
    y.wrapping_mul(rest) << 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inputs() -> impl Iterator<Item = u64> {
        let near_powers = (0..64).flat_map(|k| [(1_u64 << k).wrapping_sub(1), 1 << k, (1 << k) + 1]);
        let spread = (0..100_000_u64).map(|i| i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (i % 63));
        near_powers.chain(spread).filter(|v| *v > 0)
    }

    #[test]
    fn a_reciprocal_is_within_two_to_the_minus_29() {
        let mut worst: f64 = 0.0;
        for d in inputs().map(|v| v as u32).filter(|d| *d > 0) {
            let (m, s) = reciprocal(d);
            worst = worst.max((f64::from(m) / (s as f64).exp2() * f64::from(d) - 1.0).abs());
        }
        assert!(worst > (-31.0_f64).exp2() && worst < (-29.0_f64).exp2(), "{worst:e}");
    }

    #[test]
    fn a_reciprocal_root_is_within_two_to_the_minus_29() {
        let mut worst: f64 = 0.0;
        for v in inputs() {
            let (m, s) = reciprocal_sqrt(v);
            worst = worst.max((f64::from(m) / (s as f64).exp2() * (v as f64).sqrt() - 1.0).abs());
        }
        assert!(worst > (-31.0_f64).exp2() && worst < (-29.0_f64).exp2(), "{worst:e}");
    }

    /// Of large numbers and of words alike: the same mantissas, and numbers as they are taken apart.
    #[test]
    fn a_reciprocal_root_is_the_same_where_less_is_to_be_chosen() {
        for v in inputs().filter(|v| *v > 0) {
            let long = v | 1 << (32 + v % 31);
            assert_eq!(reciprocal_sqrt_of_long(long), reciprocal_sqrt_of(long), "{long}");
            let word = (v >> (v % 33)) as u32 | 1;
            let (m, root, up) = root_of_word(word);
            assert_eq!((m >> (2 * up), (m >> 30 > 0)), (word, true), "{word}");
            assert_eq!(reciprocal_sqrt_of(word.into()), (root as i32, 15 - up), "{word}");
        }
    }

    #[test]
    fn a_rough_root_is_within_two_to_the_minus_28() {
        let mut worst: f64 = 0.0;
        for v in inputs() {
            let off = (f64::from(rough_sqrt(v)) - (v as f64).sqrt()).abs();
            worst = worst.max((off - 1.0) / (v as f64).sqrt());
        }
        assert_eq!(rough_sqrt(0), rough_sqrt(1));
        assert!(worst > (-31.0_f64).exp2() && worst < (-28.0_f64).exp2(), "{worst:e}");
    }

    #[test]
    fn a_root_is_the_floor_of_the_exact_one() {
        for v in inputs().chain([0, u64::MAX, u64::MAX - 1]) {
            assert_eq!([sqrt_by::<false>(v), sqrt_by::<true>(v)].map(u64::from), [v.isqrt(); 2], "{v}");
        }
        // from the square to the last number before the next one
        let roots = inputs().map(|v| (v >> 32).max(1)).chain([u64::from(u32::MAX), (1 << 31) - 1, 1 << 31]);
        for root in roots {
            let square = root * root;
            let both = |v: u64| [sqrt(v), sqrt_by::<false>(v), sqrt_by::<true>(v)].map(u64::from);
            assert_eq!(both(square - 1), [root - 1; 3], "{root}");
            for v in [square, square + 1, square + root, square + 2 * root] {
                assert_eq!(both(v), [root; 3], "{v}");
            }
        }
    }

    /// From the square of every number of 16 bits to the last one before the next.
    #[test]
    fn a_short_root_is_the_floor_of_the_exact_one() {
        for root in 0..=u32::from(u16::MAX) {
            let square = root * root;
            for v in [square, square + root, square + 2 * root] {
                assert_eq!(sqrt_short(v), root, "{v}");
            }
        }
        for v in inputs().map(|v| v as u32) {
            assert_eq!(sqrt_short(v), v.isqrt(), "{v}");
        }
    }

    /// All that the short products see of a number.
    #[test]
    fn the_short_step_is_close_and_stays_in_its_format() {
        let (mut high, mut low): (f64, f64) = (0.0, 0.0);
        for m in ((1_u32 << 30)..=u32::MAX).step_by(1 << 15).flat_map(|m| [m, m | 0x7fff]) {
            let y = newton_short(m, RECIPROCAL_SQRT[(m >> 24) as usize]);
            let off = f64::from(y) / 2_f64.powi(32) * (f64::from(m) / 2_f64.powi(30)).sqrt() - 1.0;
            (high, low) = (high.max(off), low.max(-off));
        }
        // one that reached 1 would begin again at 0
        assert!((1.6e-5..1.7e-5).contains(&high) && (6.1e-5..6.3e-5).contains(&low), "{high:e} {low:e}");
    }

    #[test]
    fn a_scaled_root_is_within_a_unit_and_its_reciprocal_within_two_to_the_minus_26() {
        let mut worst = [0_i128, 0];
        let scaled = inputs().map(|v| v << v.leading_zeros() >> (1 + v % 5)).filter(|v| *v >= 1 << 58);
        let cut = (0..64).map(|k| ((1_u64 << 26) + (k << 20)) << 32 | 0xffff_ffff);
        for v in
            scaled.chain(cut).chain([1 << 58, (1 << 63) - 1, (1 << 60) - 1, 1 << 60, (1 << 62) - 1, 1 << 62])
        {
            let (root, mantissa, places) = root_and_reciprocal(v);
            assert!(places <= 2);
            let (v, root, mantissa) = (i128::from(v), i128::from(root), i128::from(mantissa));
            // (root - 1)^2 <= v <= (root + 1)^2
            assert!((root - 1).pow(2) <= v && v <= (root + 1).pow(2), "{v}: {root}");
            worst[0] = worst[0].max((root * root - v).abs() / root);
            // m / 2^(62 - places) sqrt(v) against 1: the square less 1, in units of 2^-40
            let product = (mantissa * root) >> 16; // 46 - places fractional bits
            let off = product - (1 << (46 - places));
            worst[1] = worst[1].max(off.abs() << places);
        }
        // twice the error of the root, below 2 units; and 2^-26 with 46 fractional bits
        assert!(worst[0] >= 1 && worst[1] > 1 << 18 && worst[1] < 1 << 20, "{worst:?}");
    }

    /// Against integers: `m^2 v` over `2^(2 s)` is 1 within `2^-28`, for each seed at both ends of its part
    /// and in the middle.
    #[test]
    fn every_seed_of_a_reciprocal_root_is_good_to_the_ends_of_its_part() {
        for i in 64..256_u64 {
            for low in [0, 1, 1 << 23, (1 << 24) - 1] {
                let v = (i << 24 | low) << 32; // 62 fractional bits
                let (m, s) = reciprocal_sqrt(v);
                assert_eq!(s, 62);
                // the root of 2^62 / (v / 4): the product of m^2 and v is 2^124
                let square = i128::from(m) * i128::from(m);
                let off = ((square * i128::from(v >> 32)) >> 32) - (1 << 60);
                assert!(off.abs() < 1 << 32, "{i} {low}: {off}");
            }
        }
    }

    /// Against integers: `m d` over `2^s` is 1 within `2^-29`, for each seed at both ends of its part.
    #[test]
    fn every_seed_of_a_reciprocal_is_good_to_the_ends_of_its_part() {
        for i in 128..256_u32 {
            for low in [0, 1, 1 << 23, (1 << 24) - 1] {
                let d = i << 24 | low;
                let (m, s) = reciprocal(d);
                assert_eq!(s, 62);
                let off = i128::from(m) * i128::from(d) - (1 << 62);
                assert!(off.abs() < 1 << 33, "{i} {low}: {off}");
            }
        }
        assert_eq!((reciprocal(0), reciprocal_sqrt(0)), (reciprocal(1), reciprocal_sqrt(1)));
    }
}
