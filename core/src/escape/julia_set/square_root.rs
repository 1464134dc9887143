//! The square root of a complex number, the step of backward iteration.
//!
//! With `m = |x + i y|` the root in the right half plane is `u + i v`, `u = sqrt((m + x) / 2)`,
//! `v = y / (2 u)`; for `x < 0` the larger part is the imaginary one and the two formulas change places, so
//! that nothing cancels. Source: W. Kahan, "Branch cuts for complex elementary functions", 1987.
//!
//! Format: 29 fractional bits. The number is first scaled by a power of 4, so that small ones lose nothing.

use core::num::NonZeroU32;

use fixed::types::I3F29;

use crate::num::formats::Q29;
use crate::num::{Complex, even_zeros, high, product_u, root_and_reciprocal, square_u};

impl Complex<I3F29> {
    /// The square root in the right half plane; of a negative number the one above the real axis.
    ///
    /// Domain: all. Result: `re >= 0`. Error: below 2 units of `2^-29` in each part
    /// (`a_root_is_within_two_units`). Cost: 141 Cortex-M4 instructions (kernel `complex sqrt`).
    ///
    /// ```
    /// use attractor::num::Complex;
    /// use attractor::fixed::types::I3F29;
    /// let z = Complex::new(I3F29::from_num(-2.25), I3F29::ZERO);
    /// assert_eq!(z.sqrt(), Complex::new(I3F29::ZERO, I3F29::from_num(1.5)));
    /// ```
    pub fn sqrt(self) -> Self {
        let (re, im) = square_root(i64::from(self.re.to_bits()), i64::from(self.im.to_bits()));
        Self::new(I3F29::from_bits(re), I3F29::from_bits(im))
    }
}

/// The root of `x + i y`, whose parts have 29 fractional bits too. Error: below 2 units of `2^-29` in each
/// part (`a_root_is_within_two_units`), none for the squares of real halves
/// (`squares_of_halves_have_exact_roots`).
///
/// Domain: `|x|, |y| <= 4` (a difference of two points of the disc, 4 included).
#[inline]
pub(crate) fn square_root(x: i64, y: i64) -> (Q29, Q29) {
    let (abs_x, abs_y) = (x.unsigned_abs() as u32, y.unsigned_abs() as u32);
    // twice the larger part, or its highest bit where that is 2^31
    let larger = abs_x | abs_y;
    let Some(doubled) = NonZeroU32::new((larger << 1) | (larger & 1 << 31)) else { return (0, 0) };
    // times 4^half: the larger part is then in [2^29, 2^31]
    let places = even_zeros(doubled);
    let (half, a, b) = (places >> 1, abs_x << places, abs_y << places);
    let square = square_u(a) + square_u(b); // 2^58 to 2^63
    let (modulus, ..) = root_and_reciprocal(square);
    // u with 30 fractional bits: sqrt((m + a) / 2 2^-29) 2^30 = sqrt((m + a) 2^30), between 2^29.5 and 2^31.3
    let (large, reciprocal, places) = root_and_reciprocal((u64::from(modulus) + u64::from(a)) << 30);
    // v = b / (2 u): a quotient, and one correction from its remainder, which is below 2^38
    let places = places & 3;
    let quotient = product_u(b, reciprocal);
    // below 2^32, as it is at most u but for a few units; by words: a 64-bit shift by a variable is a call on
    // a Cortex-M0
    let quotient = (((quotient >> 32) as u32) << places) | ((quotient as u32 >> 1) >> (31 - places));
    let rest = (i64::from(b) << 30).wrapping_sub(product_u(quotient, large) as i64);
    let correction = high((rest >> 8) as i32, (reciprocal >> 1) as i32);
    let small = quotient.wrapping_add((correction >> (21 - places)) as u32);
    // back to 29 fractional bits, to nearest
    let down = half + 1;
    let bias = (1_u32 << down) >> 1;
    let large = (large.wrapping_add(bias) >> down) as i32;
    let small = (small.wrapping_add(bias) >> down) as i32;
    let (re, im) = if x >= 0 { (large, small) } else { (small, large) };
    (re, if y < 0 { -im } else { im })
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;

    /// The greatest error of a part, in units.
    fn error(x: i64, y: i64) -> f64 {
        let (re, im) = square_root(x, y);
        let unit = 2_f64.powi(-29);
        let (a, b) = (x as f64 * unit, y as f64 * unit);
        let m = a.hypot(b);
        let large = ((m + a.abs()) / 2.0).sqrt();
        let small = if large > 0.0 { b.abs() / (2.0 * large) } else { 0.0 };
        let (u, v) = if x >= 0 { (large, small) } else { (small, large) };
        let v = if y < 0 { -v } else { v };
        (f64::from(re) - u / unit).abs().max((f64::from(im) - v / unit).abs())
    }

    #[test]
    fn a_root_is_within_two_units() {
        let mut worst = 0.0_f64;
        let mut word = 1_u64;
        for k in 0..2_000_000_u32 {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let down = k % 34;
            let part = |bits: u64, down: u32| ((bits as u32 as i32) as i64) >> (down.min(31));
            let (x, y) = (part(word >> 32, down), part(word >> 13, (k / 34) % 34));
            worst = worst.max(error(x, y));
            let root = Complex::new(I3F29::from_bits(x as i32), I3F29::from_bits(y as i32)).sqrt();
            assert_eq!((root.re.to_bits(), root.im.to_bits()), square_root(x, y));
        }
        for (x, y) in
            [(1 << 31, 0), (-1 << 31, 1 << 31), (1, 0), (0, 1), (-1, 0), (0, -1), (1 << 31, 1), (-1, 1)]
        {
            worst = worst.max(error(x, y));
        }
        std::println!("square root: {worst} units");
        assert!(worst > 0.4 && worst < 2.0, "{worst}");
    }

    #[test]
    fn squares_of_halves_have_exact_roots() {
        for a in -2..=2_i64 {
            for b in -2..=2_i64 {
                // (a + i b)^2 / 4
                let (x, y) = ((a * a - b * b) << 27, (2 * a * b) << 27);
                let (re, im) = square_root(x, y);
                let (p, q) = ((a as i32) << 28, (b as i32) << 28);
                let off = |p: i32, q: i32| (re - p).abs().max((im - q).abs());
                let off = off(p, q).min(off(-p, -q));
                assert!(off == 0 || (off == 1 && a * b != 0), "{a} {b}: {re} {im}");
            }
        }
        assert_eq!(square_root(1 << 31, 0), (1 << 30, 0));
        assert_eq!(square_root(-1 << 31, 0), (0, 1 << 30));
    }
}
