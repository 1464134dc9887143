//! Complex numbers of any size with a short mantissa: two parts that share an exponent.
//!
//! For values that no fixed point holds: a derivative that may grow to `2^1000`, the distance of two
//! neighbouring orbits at a depth of `10^-100`. 30 bits of them are plenty, and their range is not bounded.
//!
//! The number is `(re + i im) 2^exponent`, the larger part between `2^29` and `2^30` in magnitude: block
//! floating point, as in J. H. Wilkinson, "Rounding Errors in Algebraic Processes", 1963, section 1.26. Each
//! operation rounds to nearest, `2^-30` of the larger part; a sum that cancels is rounded as the larger term
//! is. No exponent wraps: at its ends it stays (`no_exponent_wraps`). `BlockFloat<i64>` has 62 bits: for long
//! products that are made once a picture.

/// `(re + i im) 2^exponent`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub(crate) struct BlockFloat<M = i32> {
    pub(crate) re: M,
    pub(crate) im: M,
    pub(crate) exponent: i32,
}

/// A block of either width, for who computes in both.
pub(crate) trait Number: Copy + PartialEq + core::fmt::Debug {
    /// Of a mantissa.
    const BITS: i32;
    /// 0, smaller than everything else.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// The product.
    fn times(self, other: Self) -> Self;
    /// The sum.
    fn plus(self, other: Self) -> Self;
    /// The number with the other sign.
    fn negated(self) -> Self;
    /// Twice the number.
    fn doubled(self) -> Self;
    /// Whether `|self| > 2`.
    fn is_beyond_two(self) -> bool;
    /// Whether `|self| < |other|`.
    fn is_less(self, other: Self) -> bool;
    /// An exponent of 2 that `|self|` is below.
    fn above(self) -> i32;
    /// An exponent of 2 that `|self|` reaches.
    fn reached(self) -> i32;
    /// The nearest block of 30 bits.
    fn short(self) -> BlockFloat;
    /// The nearest of this width.
    fn nearest(long: BlockFloat<i64>) -> Self;
}

/// The arithmetic of both widths: `BITS` of a mantissa leave its word a sign and a sum of two.
macro_rules! arithmetic {
    (#[$inline:meta] $word:ty, $half:ty, $double:ty, $unsigned:ty, $bits:literal) => {
        impl BlockFloat<$word> {
            /// 0, smaller than everything else.
            pub(crate) const ZERO: Self = Self { re: 0, im: 0, exponent: -(1 << 28) };
            /// 1.
            pub(crate) const ONE: Self = Self { re: 1 << ($bits - 1), im: 0, exponent: 1 - $bits };

            /// The nearest block. Domain: parts that two bits fewer than the words would hold.
            #[$inline]
            pub(crate) fn new(re: $double, im: $double, exponent: i32) -> Self {
                const MASK: u32 = <$double>::BITS - 1;
                let sign = |v: $double| v >> MASK;
                let magnitude = ((re ^ sign(re)) | (im ^ sign(im))) as $unsigned;
                let places = (<$double>::BITS - $bits) as i32 - magnitude.leading_zeros() as i32;
                if places > 0 {
                    let half = ((1 as $double) << (places as u32 & MASK)) >> 1;
                    let round = |v: $double| (v.wrapping_add(half) >> (places as u32 & MASK)) as $word;
                    Self { re: round(re), im: round(im), exponent: exponent.saturating_add(places) }
                } else if magnitude == 0 && re | im == 0 {
                    Self::ZERO
                } else {
                    let up = places.unsigned_abs() & MASK;
                    Self {
                        re: (re << up) as $word,
                        im: (im << up) as $word,
                        exponent: exponent.saturating_add(places),
                    }
                }
            }

            /// Parts of a word, with the mantissa where it belongs.
            #[inline(always)]
            fn normal(re: $word, im: $word, exponent: i32) -> Self {
                let magnitude =
                    ((re ^ (re >> (<$word>::BITS - 1))) | (im ^ (im >> (<$word>::BITS - 1)))) as $half;
                let zeros = magnitude.leading_zeros();
                if zeros < <$word>::BITS - $bits {
                    // one bit too many
                    let half = |v: $word| (v >> 1) + (v & 1);
                    Self { re: half(re), im: half(im), exponent: exponent.saturating_add(1) }
                } else if re | im == 0 {
                    Self::ZERO
                } else {
                    let up = zeros - (<$word>::BITS - $bits);
                    Self { re: re << up, im: im << up, exponent: exponent.saturating_sub(up as i32) }
                }
            }

            /// `|self|^2` as a mantissa, 4 times from end to end (0 for 0), and an exponent.
            #[inline]
            pub(crate) fn square(self) -> ($unsigned, i32) {
                let (a, b) = (<$double>::from(self.re), <$double>::from(self.im));
                ((a * a + b * b) as $unsigned, self.exponent.saturating_mul(2))
            }
        }

        impl Number for BlockFloat<$word> {
            const BITS: i32 = $bits;
            const ZERO: Self = Self::ZERO;
            const ONE: Self = Self::ONE;

            #[$inline]
            fn times(self, other: Self) -> Self {
                let (a, b) = (<$double>::from(self.re), <$double>::from(self.im));
                let (x, y) = (<$double>::from(other.re), <$double>::from(other.im));
                let (re, im) = (a * x - b * y, a * y + b * x);
                let sign = |v: $double| v >> (<$double>::BITS - 1);
                let magnitude = (((re ^ sign(re)) | (im ^ sign(im))) >> <$word>::BITS) as $half;
                if magnitude == 0 {
                    return Self::ZERO;
                }
                // the modulus of a product is between 2^(2 BITS - 2) and 2^(2 BITS + 1): it has BITS - 2 to
                // BITS + 1 places too many, as many as a shift within two words takes
                let places = (<$double>::BITS - <$word>::BITS - magnitude.leading_zeros() + <$word>::BITS
                    - $bits)
                    .clamp($bits - 2, $bits + 1);
                // at most 2^BITS
                let half = <$double>::from((1 as $word) << ($bits - 3) << (places - ($bits - 2)));
                let part = |v: $double| {
                    let v = v + half;
                    let (high, low) = ((v >> <$word>::BITS) as $half, v as $half);
                    ((high << (<$word>::BITS - places)) | (low >> places)) as $word
                };
                let exponent = self.exponent.saturating_add(other.exponent).saturating_add(places as i32);
                Self { re: part(re), im: part(im), exponent }
            }

            #[$inline]
            fn plus(self, other: Self) -> Self {
                let (large, small) =
                    if self.exponent >= other.exponent { (self, other) } else { (other, self) };
                let apart = large.exponent.wrapping_sub(small.exponent) as u32;
                // what is as small as this does not count
                if apart > $bits {
                    return large;
                }
                // rounded to the larger one's last place, also where the two cancel
                let half = ((1 as $word) << (apart & (<$word>::BITS - 1))) >> 1;
                let sum = |a: $word, b: $word| a.saturating_add((b + half) >> (apart & (<$word>::BITS - 1)));
                Self::normal(sum(large.re, small.re), sum(large.im, small.im), large.exponent)
            }

            #[inline(always)]
            fn negated(self) -> Self {
                Self { re: -self.re, im: -self.im, ..self }
            }

            #[inline(always)]
            fn doubled(self) -> Self {
                Self { exponent: self.exponent.saturating_add(1), ..self }
            }

            #[inline(always)]
            fn is_beyond_two(self) -> bool {
                // the larger part, at most 2^BITS 2^exponent, decides but for three exponents
                if self.exponent < 1 - $bits {
                    return false;
                }
                if self.exponent > 3 - $bits {
                    return true;
                }
                let (mantissa, exponent) = self.square();
                // above 2^(2 - exponent), which is a bit of the upper word
                let above = (mantissa.wrapping_sub(1) >> <$word>::BITS) as $half;
                above >> ((2 - exponent) as u32 & (<$word>::BITS - 1)) != 0
            }

            #[$inline]
            fn is_less(self, other: Self) -> bool {
                let apart = self.exponent.saturating_sub(other.exponent);
                // the larger parts are within a factor of 2 of each other for equal exponents, the moduli
                // within 2 sqrt 2
                if !(-1..=1).contains(&apart) {
                    return apart < 0;
                }
                let ((a, _), (b, _)) = (self.square(), other.square());
                if apart >= 0 { a << (2 * apart) < b } else { a < b << (-2 * apart) }
            }

            #[inline(always)]
            fn above(self) -> i32 {
                // the larger part is at most 2^BITS, the modulus 3/2 of it
                self.exponent.saturating_add($bits + 1)
            }

            #[inline(always)]
            fn reached(self) -> i32 {
                self.exponent.saturating_add($bits - 1)
            }

            #[inline]
            fn short(self) -> BlockFloat {
                BlockFloat::<i32>::new(self.re.into(), self.im.into(), self.exponent)
            }

            #[inline]
            fn nearest(long: BlockFloat<i64>) -> Self {
                Self::new(long.re.into(), long.im.into(), long.exponent)
            }
        }
    };
}

arithmetic!(
    #[inline(always)]
    i32,
    u32,
    i64,
    u64,
    30
);
// hundreds of instructions each, once in an image
arithmetic!(
    #[inline(never)]
    i64,
    u64,
    i128,
    u128,
    62
);

impl BlockFloat {
    /// The parts with `bits` fractional bits, towards minus infinity. Domain: parts below `2^(62 - bits)`.
    #[inline]
    pub(crate) fn fixed(self, bits: i32) -> (i64, i64) {
        let places = self.exponent.saturating_add(bits);
        let part = |v: i32| {
            let v = i64::from(v);
            if places >= 0 { v << (places & 63) } else { v >> places.unsigned_abs().min(63) }
        };
        (part(self.re), part(self.im))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(b: BlockFloat) -> (f64, f64) {
        let scale = 2_f64.powi(b.exponent.max(-1000));
        (f64::from(b.re) * scale, f64::from(b.im) * scale)
    }

    fn samples() -> impl Iterator<Item = BlockFloat> {
        (0..400_i64).map(|k| {
            let word = k.wrapping_mul(0x9e37_79b9_7f4a_7c15_u64 as i64);
            BlockFloat::<i32>::new(word >> (k % 40 + 3), (word << 17) >> (k % 23 + 3), (k % 50) as i32 - 60)
        })
    }

    #[test]
    fn no_exponent_wraps() {
        fn all<N: Number>(ends: [N; 9]) {
            for (a, b) in ends.into_iter().flat_map(|a| ends.map(|b| (a, b))) {
                let (large, small) = if a.is_less(b) { (b, a) } else { (a, b) };
                assert!(!large.plus(small).is_less(small) || large.plus(small) == N::ZERO);
                for c in [a.times(b), a.plus(b), a.doubled(), a.negated()] {
                    let _ = (c.is_beyond_two(), c.is_less(a), c.above(), c.reached(), c.times(a), c.plus(b));
                }
            }
            // what stays at an end is neither small nor large by mistake
            let [low, high, ..] = ends;
            assert!(high.times(high).is_beyond_two() && high.doubled().is_beyond_two());
            assert!(!low.times(low).is_beyond_two() && low.times(low).is_less(N::ONE));
        }
        let short = |exponent| BlockFloat::<i32> { exponent, ..BlockFloat::<i32>::ONE };
        let long = |exponent| BlockFloat::<i64> { exponent, ..BlockFloat::<i64>::ONE };
        let at = [i32::MIN, i32::MAX, i32::MIN + 1, i32::MAX - 1, -(1 << 30), 1 << 30, -(1 << 28), 0, -29];
        all(at.map(short));
        all(at.map(long));
        for exponent in at {
            let _ = (BlockFloat::<i32>::new(1 << 60, 1, exponent), BlockFloat::<i32>::new(1, -1, exponent));
            let _ = (BlockFloat::<i64>::new(1 << 124, 1, exponent), BlockFloat::<i64>::new(1, -1, exponent));
            let _ = (short(exponent).square(), short(exponent.min(0)).fixed(24));
        }
    }

    #[test]
    fn sums_products_and_comparisons_are_those_of_float() {
        let mut worst = 0.0_f64;
        for a in samples().chain([BlockFloat::<i32>::ZERO, BlockFloat::<i32>::ONE]) {
            for b in samples().chain([BlockFloat::<i32>::ZERO, BlockFloat::<i32>::ONE]) {
                let ((x, y), (u, v)) = (value(a), value(b));
                let product = (x * u - y * v, x * v + y * u);
                let sum = (x + u, y + v);
                for (got, (re, im)) in [(a.times(b), product), (a.plus(b), sum)] {
                    let size = got.re.unsigned_abs().max(got.im.unsigned_abs());
                    assert!(size == 0 || (1 << 29..=1 << 30).contains(&size));
                    let (p, q) = value(got);
                    let error = (p - re).abs().max((q - im).abs());
                    let terms =
                        if (re, im) == sum { x.hypot(y).max(u.hypot(v)) } else { x.hypot(y) * u.hypot(v) };
                    worst = worst.max(error / re.abs().max(im.abs()).max(terms).max(1e-300));
                }
                let (m, n) = (x.hypot(y), u.hypot(v));
                if (m - n).abs() > 1e-9 * m {
                    assert_eq!(a.is_less(b), m < n, "{a:?} {b:?}");
                }
                if (m - 2.0).abs() > 1e-9 {
                    assert_eq!(a.is_beyond_two(), m > 2.0, "{a:?}");
                }
            }
        }
        assert!(worst > 1e-11 && worst < 2_f64.powi(-29), "{worst:e}");
        assert!(
            !BlockFloat::<i32>::ONE.doubled().is_beyond_two()
                && BlockFloat::<i32>::ONE.plus(BlockFloat::<i32>::ONE) == BlockFloat::<i32>::ONE.doubled()
        );
    }
}
