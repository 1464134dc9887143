//! The dwell in 64-bit and 128-bit words, for views so deep that 32 bits do not tell two pixels apart.
//!
//! Source and meaning: [`crate::escape::orbit::dwell`]. Format: Q60 and Q124, `[-8, 8)`. A step from
//! `|z| <= 2` with `|c| <= 2` stays below 6: nothing wraps.
//!
//! - 64 bits: `re = (x - y)(x + y) + c`, `im = 2 x y + c`, each product from four signed 32-bit ones. Rounded
//!   to nearest: half a unit a part.
//! - 128 bits: squares need no signs and fewer products: `re = x^2 - y^2 + c`,
//!   `im = (x + y)^2 - (x^2 + y^2) + c`. Below 1 unit in the real, 2 in the imaginary part.
//!
//! Cost in Cortex-M4 instructions (`cargo xtask target`, what a pixel takes at its start included): 58.3 an
//! iteration in 64 bits, 259.2 in 128.

use crate::escape::orbit::block_float::{BlockFloat, Number};
use crate::escape::orbit::cardioid;
use crate::escape::orbit::cycle::{self, Path};
use crate::escape::orbit::dwell::is_beyond;
use crate::escape::orbit::ending::Steps;
use crate::escape::orbit::upper::Upper;
use crate::num::formats::{Q28, Q60, Q124, UQ24};
use crate::num::{high_of_square, product, product_u};

/// A real word of an orbit.
pub(crate) trait WideWord: Copy + PartialEq {
    /// `z^2 + c` for `|z| <= 2`, `|c| <= 2`.
    fn step(z: (Self, Self), c: (Self, Self)) -> (Self, Self);
    /// The highest 32 bits.
    fn top(self) -> Q28;
    /// Whether `x^2 + y^2 > 4`, exactly.
    fn is_beyond(x: Self, y: Self) -> bool;
    /// The nearest block.
    fn block(z: (Self, Self)) -> BlockFloat;
    /// The difference of two parts within 2.
    fn minus(self, other: Self) -> Self;
    /// 4 units of the last place: more than a step is rounded by.
    const ERROR: Upper;
}

/// An orbit for the colourings.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WideOrbit<W> {
    pub(crate) z: (W, W),
    pub(crate) c: (W, W),
}

impl<W: WideWord> Steps for WideOrbit<W> {
    fn step(&mut self) {
        self.z = W::step(self.z, self.c);
    }

    fn z(&self) -> BlockFloat {
        W::block(self.z)
    }

    fn c(&self) -> BlockFloat {
        W::block(self.c)
    }
}

impl<W: WideWord> Path for WideOrbit<W> {
    type Size = BlockFloat;

    fn size(&self) -> BlockFloat {
        W::block(self.z)
    }

    fn apart(&self, other: &Self) -> BlockFloat {
        self.off(other)
    }

    fn run(&mut self, steps: u32) -> bool {
        (0..steps).all(|_| self.next())
    }

    fn next(&mut self) -> bool {
        if W::is_beyond(self.z.0, self.z.1) {
            return false;
        }
        self.z = W::step(self.z, self.c);
        !W::is_beyond(self.z.0, self.z.1)
    }

    fn z(&self) -> BlockFloat {
        W::block(self.z)
    }

    fn off(&self, other: &Self) -> BlockFloat {
        W::block((self.z.0.minus(other.z.0), self.z.1.minus(other.z.1)))
    }

    fn blur(&self) -> Upper {
        W::ERROR
    }

    fn step_error(&self) -> Upper {
        W::ERROR
    }
}

/// `|z|^2` from which on the exact test decides: `4 - 2^-6`. The tops lose less than `2^-24`.
const NEAR: UQ24 = (4 << 24) - (1 << 18);

/// The dwell of the orbit that starts at `z`.
///
/// Domain: `|c| <= 2` unless `|z| > 2`. Result: iterations, `0..=max`. A point that comes back ends the loop,
/// as in 32 bits.
#[inline(never)]
pub(crate) fn dwell<W: WideWord>(z: (W, W), c: (W, W), max: u32) -> u32 {
    let (mut x, mut y) = z;
    let mut saved = z;
    let mut left = max;
    let mut window = 16_u32;
    while left > 0 {
        let block = window.min(left);
        let mut unfinished = block;
        while unfinished > 0 {
            let (tx, ty) = (x.top(), y.top());
            // |z| < 8 sqrt 2: below 2^31 as unsigned words
            let norm = high_square(tx).wrapping_add(high_square(ty));
            if norm >= NEAR && W::is_beyond(x, y) {
                return max - left + (block - unfinished);
            }
            (x, y) = W::step((x, y), c);
            unfinished -= 1;
            if unfinished & 7 == 0 && x == saved.0 && y == saved.1 {
                return max;
            }
        }
        left -= block;
        saved = (x, y);
        window = window.saturating_mul(2);
    }
    max
}

/// The period of the cycle that the orbit of 0 is drawn to, by formula where there is one.
pub(crate) fn period<W: WideWord>(c: (W, W), max: u32) -> Option<u32> {
    // 29 fractional bits; the rim that the formula leaves is wider than what is cut off
    let word = (c.0.top().saturating_mul(2), c.1.top().saturating_mul(2));
    if is_beyond(word) {
        return None;
    }
    cardioid::period(word).or_else(|| cycle::period(WideOrbit { z: c, c }, max))
}

/// The upper word of the square.
#[inline(always)]
fn high_square(v: Q28) -> UQ24 {
    high_of_square(v) as u32
}

/// The full product of two words and two more words: it just fits 64 bits (`UMAAL`).
#[inline(always)]
fn multiply_add(a: u32, b: u32, c: u32, d: u32) -> (u32, u32) {
    let sum = product_u(a, b) + u64::from(c) + u64::from(d);
    (sum as u32, (sum >> 32) as u32)
}

/// Two signed halves, `high 2^32 + low`: four signed products of them make a product.
#[inline(always)]
fn halves(v: i64) -> (i32, i32) {
    let low = v as i32;
    (((v >> 32) as i32).wrapping_add(((low as u32) >> 31) as i32), low)
}

/// `a b / 2^(32 + DOWN)`, to nearest but for `2^-DOWN` units. Domain: `|a|, |b| < 4`, the product below 4.
#[inline(always)]
fn scaled_product<const DOWN: u32>(a: Q60, b: Q60) -> Q60 {
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    // the words in the middle: below 2^63 for factors of at most 2 sqrt 2
    let middle = (product(al, bl) >> 32)
        .wrapping_add(1 << (DOWN - 1))
        .wrapping_add(product(ah, bl))
        .wrapping_add(product(al, bh));
    ((product(ah, bh)) << (32 - DOWN)).wrapping_add(middle >> DOWN)
}

impl WideWord for Q60 {
    #[inline(always)]
    fn step((x, y): (Self, Self), c: (Self, Self)) -> (Self, Self) {
        let real = scaled_product::<28>(x.wrapping_sub(y), x.wrapping_add(y));
        let cross = scaled_product::<27>(x, y); // 2 x y
        (real.wrapping_add(c.0), cross.wrapping_add(c.1))
    }

    #[inline(always)]
    fn top(self) -> Q28 {
        (self >> 32) as i32
    }

    #[cold]
    #[inline(never)]
    fn is_beyond(x: Self, y: Self) -> bool {
        // at most 2^126 each
        let square = |v: i64| u128::from(v.unsigned_abs()) * u128::from(v.unsigned_abs());
        square(x) + square(y) > 1 << 122
    }

    fn block((x, y): (Self, Self)) -> BlockFloat {
        BlockFloat::<i32>::new(x, y, -60)
    }

    fn minus(self, other: Self) -> Self {
        self.wrapping_sub(other)
    }

    const ERROR: Upper = Upper::power(2 - 60);
}

/// The square, modulo 16, rounded down. Domain: `|v| < 4`.
#[inline(always)]
fn square_q124(v: Q124) -> Q124 {
    let v = v.unsigned_abs();
    let [a, b, c, d] = [v as u32, (v >> 32) as u32, (v >> 64) as u32, (v >> 96) as u32];
    // products of different words, without the lowest (a b, which reaches the result by a carry only)
    let (w2, k) = multiply_add(a, c, 0, 0);
    let (w3, k) = multiply_add(a, d, k, 0);
    let (w3, l) = multiply_add(b, c, w3, 0);
    let (w4, k) = multiply_add(b, d, k, l);
    let (w5, w6) = multiply_add(c, d, k, 0);
    // twice, and the squares of the words: b b at words 2 and 3, c c at 4 and 5, d d at 6 and 7
    let word = |low: u32, high: u32| (high << 1) | (low >> 31);
    let twice = [w2 << 1, word(w2, w3), word(w3, w4), word(w4, w5), word(w5, w6), w6 >> 31];
    let (_, k) = multiply_add(b, b, twice[0], 0);
    let (s3, k) = add(twice[1], k);
    let (s4, k2) = multiply_add(c, c, twice[2], k);
    let (s5, k) = add(twice[3], k2);
    let (s6, s7) = multiply_add(d, d, twice[4], k);
    let s7 = s7.wrapping_add(twice[5]);
    let shifted = |low: u32, high: u32| u128::from((high << 4) | (low >> 28));
    (shifted(s3, s4) | (shifted(s4, s5) << 32) | (shifted(s5, s6) << 64) | (shifted(s6, s7) << 96)) as i128
}

impl WideWord for Q124 {
    #[inline(always)]
    fn step((x, y): (Self, Self), c: (Self, Self)) -> (Self, Self) {
        let (xx, yy, ss) = (square_q124(x), square_q124(y), square_q124(x.wrapping_add(y)));
        let cross = ss.wrapping_sub(xx.wrapping_add(yy));
        (xx.wrapping_sub(yy).wrapping_add(c.0), cross.wrapping_add(c.1))
    }

    #[inline(always)]
    fn top(self) -> Q28 {
        (self >> 96) as i32
    }

    #[cold]
    #[inline(never)]
    fn is_beyond(x: Self, y: Self) -> bool {
        // 248 fractional bits in two words of 128, as in `view`: the low half decides ties only
        let square = |v: i128| {
            let v = v.unsigned_abs();
            let (low, high) = (v & u128::from(u64::MAX), v >> 64);
            let cross = low * high; // below 2^127
            let (sum, carry) = (low * low).overflowing_add(cross << 65);
            (high * high + (cross >> 63) + u128::from(carry), sum)
        };
        let ((high_x, low_x), (high_y, low_y)) = (square(x), square(y));
        let (low, carry) = low_x.overflowing_add(low_y);
        let high = high_x + high_y + u128::from(carry);
        high > 1 << 122 || (high == 1 << 122 && low > 0)
    }

    fn block((x, y): (Self, Self)) -> BlockFloat {
        BlockFloat::<i64>::new(x, y, -124).short()
    }

    fn minus(self, other: Self) -> Self {
        self.wrapping_sub(other)
    }

    const ERROR: Upper = Upper::power(2 - 124);
}

#[inline(always)]
fn add(a: u32, b: u32) -> (u32, u32) {
    let sum = u64::from(a) + u64::from(b);
    (sum as u32, (sum >> 32) as u32)
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::escape::exact::dwell_248;
    use crate::num::Complex;
    use crate::num::{Limbs, Wide};

    #[test]
    fn products_are_rounded_down_by_a_unit() {
        let mut word = 1_u64;
        for k in 0..200_000 {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            // up to 2.8, beyond which the square does not fit
            let v = ((word as i64) >> (1 + k % 61)).clamp(-(14 << 57), 14 << 57);
            let v = if v.unsigned_abs() > 11 << 58 { v >> 1 } else { v };
            let w = (word.rotate_left(29) as i64) >> 3;
            for (a, b) in [(v, v), (v, w), (-v, w)] {
                let exact = |down: u32| (i128::from(a) * i128::from(b)) >> down;
                if exact(60).abs() < 1 << 62 {
                    let (single, double) = (scaled_product::<28>(a, b), scaled_product::<27>(a, b));
                    let off =
                        |got: i64, down: u32| i128::from(got) * (1 << down) - i128::from(a) * i128::from(b);
                    assert!(off(single, 60).abs() <= (1 << 59) + (1 << 33), "{a} {b}");
                    assert!(off(double, 59).abs() <= (1 << 58) + (1 << 33), "{a} {b}");
                }
            }
            // 128 bits: against limbs, which round a product towards 0 with a column less
            let wide = (i128::from(v) << 62) ^ (i128::from(word) << 20);
            let limbs = Limbs::<4>::from_limbs([0, 32, 64, 96].map(|s| (wide >> s) as u32));
            let off = square_q124(wide) - limbs.times(&limbs).top128();
            assert!((-1..=1).contains(&off), "{wide}: {off}");
            // an exact square
            let half = i128::from(v) << 62;
            assert_eq!(square_q124(half), i128::from(v) * i128::from(v), "{v}");
        }
    }

    #[test]
    fn the_circle_is_exact() {
        let two = 2_i64 << 60;
        assert!(!i64::is_beyond(two, 0) && i64::is_beyond(two, 1) && i64::is_beyond(-two - 1, 0));
        assert!(!i64::is_beyond(0, -two) && !i64::is_beyond(two - 1, 1 << 30));
        let two = 2_i128 << 124;
        assert!(!i128::is_beyond(two, 0) && i128::is_beyond(two, 1) && i128::is_beyond(-two - 1, 0));
        assert!(!i128::is_beyond(0, -two) && i128::is_beyond(-two * 3, two * 3));
        for k in [0_i128, 1, 1 << 30, 1 << 61, 1 << 62, (1 << 63) - 1] {
            assert!(!i128::is_beyond(two - 1, k), "{k}");
        }
        // (2 - u)^2 + 4 u = 4 + u^2
        assert!(i128::is_beyond(two - 1, 1 << 63));
    }

    #[test]
    fn wide_dwell_agrees_with_248_bits() {
        let (mut pixels, mut differ) = (0, [0, 0]);
        for i in -40..40_i64 {
            for j in 0..30_i64 {
                let c = Complex::new(Wide::from_bits((i << 43) - (1 << 47)), Wide::from_bits(j << 43));
                let (re, im) = (c.re.to_bits(), c.im.to_bits());
                let exact = dwell_248(c, 700);
                let narrow = (re << 12, im << 12);
                let wide = (i128::from(re) << 76, i128::from(im) << 76);
                if exact == 0 {
                    continue;
                }
                pixels += 1;
                differ[0] += u32::from(dwell(narrow, narrow, 700) != exact);
                differ[1] += u32::from(dwell(wide, wide, 700) != exact);
            }
        }
        std::println!("wide dwell: {differ:?} of {pixels}");
        assert!(pixels > 1500 && differ[0] <= 1 && differ[1] == 0, "{differ:?} of {pixels}");
    }
}
