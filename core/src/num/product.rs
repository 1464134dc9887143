//! Products of two 32-bit numbers: all 64 bits, or the upper 32 alone.
//!
//! A Cortex-M4 or a RISC-V core has them as one instruction or two. A Cortex-M0 has not: it keeps the lower
//! 32 bits of a product only, and the compiler calls a library function for the rest. Such a target
//! (`build.rs` knows which) multiplies by halves here, inline:
//!
//! `a b = ah bh 2^32 + (ah bl + al bh) 2^16 + al bl`, with `a = ah 2^16 + al`, `al` unsigned.
//!
//! Both ways give the same bits (`both_ways_give_the_same_bits`); every function is exact for all operands.

/// `a b`. Cost: one Cortex-M4 instruction; on a Cortex-M0 17.
#[inline(always)]
pub(crate) fn product(a: i32, b: i32) -> i64 {
    if cfg!(no_long_product) { halves::product(a, b) } else { whole::product(a, b) }
}

/// `a b`. Cost: as [`product`].
#[inline(always)]
pub(crate) fn product_u(a: u32, b: u32) -> u64 {
    if cfg!(no_long_product) { halves::product_u(a, b) } else { whole::product_u(a, b) }
}

/// `a b` for a `b` of 16 bits. Cost: one Cortex-M4 instruction; on a Cortex-M0 8.
#[inline(always)]
pub(crate) fn product_by_short(a: u32, b: u16) -> u64 {
    if cfg!(no_long_product) { halves::product_by_short(a, b) } else { whole::product_u(a, b.into()) }
}

/// `a b` of a number with and one without a sign. Cost: as [`product`], and two instructions on a Cortex-M4.
#[inline(always)]
pub(crate) fn product_mixed(a: i32, b: u32) -> i64 {
    if cfg!(no_long_product) { halves::product_mixed(a, b) } else { whole::product_mixed(a, b) }
}

/// The upper word of that, towards minus infinity.
#[inline(always)]
pub(crate) fn high_mixed(a: i32, b: u32) -> i32 {
    if cfg!(no_long_product) { halves::high_mixed(a, b) } else { (whole::product_mixed(a, b) >> 32) as i32 }
}

/// `a b` of numbers with 24 fractional bits, in the same format; at `2^WHOLE` and beyond it is the end of
/// that range, but for its last 8 bits.
#[inline(always)]
pub(crate) fn product_within<const WHOLE: u32>(a: i32, b: i32) -> i32 {
    let product = product(a, b);
    let most = (1 << (16 + WHOLE)) - 1;
    // an instruction that saturates
    let high = ((product >> 32) as i32).clamp(-most - 1, most);
    high << 8 | (product as u32 >> 24) as i32
}

/// The upper word of `a b`, towards minus infinity. Cost: one Cortex-M4 instruction; on a Cortex-M0 14.
#[inline(always)]
pub(crate) fn high(a: i32, b: i32) -> i32 {
    if cfg!(no_long_product) { halves::high(a, b) } else { (whole::product(a, b) >> 32) as i32 }
}

/// The upper word of `a b`, to nearest: `(a b + 2^31) / 2^32`, halves upwards. Cost: as [`high`].
#[inline(always)]
pub(crate) fn high_rounded(a: i32, b: i32) -> i32 {
    if cfg!(no_long_product) {
        halves::high_rounded(a, b)
    } else {
        ((whole::product(a, b) + (1 << 31)) >> 32) as i32
    }
}

/// The upper word of `2 a b`, to nearest, halves upwards.
///
/// Domain: `|a| < 2^30`, `|a| + |b| <= 2^31 - 2^18`. Cost: a doubling and one multiplication;
/// on a Cortex-M0 14 instructions, and less where the squares are wanted too: the halves are shared.
#[inline(always)]
pub(crate) fn high_of_double(a: i32, b: i32) -> i32 {
    if cfg!(no_long_product) { halves::high_of_double(a, b) } else { high_rounded(a.wrapping_add(a), b) }
}

/// The upper word of `a b`, rounded down. Cost: as [`high`].
#[inline(always)]
pub(crate) fn high_u(a: u32, b: u32) -> u32 {
    if cfg!(no_long_product) { halves::high_u(a, b) } else { (whole::product_u(a, b) >> 32) as u32 }
}

/// The same for a `b` below `2^32 - 2^15`. Cost: on a Cortex-M0 2 instructions less.
#[inline(always)]
pub(crate) fn high_u_below(a: u32, b: u32) -> u32 {
    if cfg!(no_long_product) { halves::high_u_below(a, b) } else { high_u(a, b) }
}

/// The upper word of `a^2`. Cost: one Cortex-M4 instruction; on a Cortex-M0 9.
#[inline(always)]
pub(crate) fn high_of_square(a: i32) -> i32 {
    if cfg!(no_long_product) { halves::high_of_square(a) } else { (whole::product(a, a) >> 32) as i32 }
}

/// The upper word of `a^2`, rounded down. Cost: as [`high_of_square`].
#[inline(always)]
pub(crate) fn high_of_square_u(a: u32) -> u32 {
    if cfg!(no_long_product) { halves::high_of_square_u(a) } else { (whole::product_u(a, a) >> 32) as u32 }
}

/// `a^2`. Cost: one Cortex-M4 instruction; on a Cortex-M0 10.
#[inline(always)]
pub(crate) fn square_u(a: u32) -> u64 {
    if cfg!(no_long_product) {
        u64::from(halves::high_of_square_u(a)) << 32 | u64::from(a.wrapping_mul(a))
    } else {
        whole::product_u(a, a)
    }
}

/// `(a b + half) / 2^S`, rounded down, for numbers of at most `2^30` and `half` with 16 binary zeros, given
/// without them, at most `2^15`.
///
/// Domain: `16 < S < 32`, and a result that fits. Cost: as [`product`] and a shift; on a Cortex-M0 15
/// instructions, and less where a factor is used again.
#[inline(always)]
pub(crate) fn product_shifted<const S: u32>(a: i32, b: i32, half: i32) -> i32 {
    if cfg!(no_long_product) {
        halves::product_shifted::<S>(a, b, half)
    } else {
        ((whole::product(a, b) + (i64::from(half) << 16)) >> S) as i32
    }
}

/// `p + d v` for complex numbers: the product of `d = a + b i` and `v = x + y i` added to both parts of `p`.
///
/// Domain: `|d| < 2^31`, `x >= -2^31 + 2^15`, `y > -2^31`; the sums modulo `2^64`. Cost: four
/// multiplications that add, and a change of sign; on a Cortex-M0 16 multiplications instead of 20, and half
/// the additions of four products.
#[inline(always)]
pub(crate) fn complex_product_added(p: [i64; 2], d: [i32; 2], v: [i32; 2]) -> [i64; 2] {
    if cfg!(no_long_product) {
        halves::complex_product_added(p, d, v)
    } else {
        whole::complex_product_added(p, d, v)
    }
}

/// `v / 2^S` rounded down, where that fits a word, by words: of a 64-bit shift, cut off to 32 bits, the
/// compiler makes three instructions more wherever the result is multiplied.
///
/// Domain: `0 < S < 32`.
#[inline(always)]
pub(crate) fn rounded_down<const S: u32>(v: i64) -> i32 {
    ((v >> 32) as i32) << (32 - S) | ((v as u32) >> S) as i32
}

/// By the target's instruction.
mod whole {
    #[inline(always)]
    pub(super) fn complex_product_added([p, q]: [i64; 2], [a, b]: [i32; 2], [x, y]: [i32; 2]) -> [i64; 2] {
        [
            p.wrapping_add(product(a, x)).wrapping_add(product(b, y.wrapping_neg())),
            q.wrapping_add(product(a, y)).wrapping_add(product(b, x)),
        ]
    }

    #[inline(always)]
    pub(super) fn product(a: i32, b: i32) -> i64 {
        i64::from(a) * i64::from(b)
    }

    #[inline(always)]
    pub(super) fn product_u(a: u32, b: u32) -> u64 {
        u64::from(a) * u64::from(b)
    }

    #[inline(always)]
    pub(super) fn product_mixed(a: i32, b: u32) -> i64 {
        i64::from(a) * i64::from(b)
    }
}

/// By products of 16-bit halves.
mod halves {
    /// Upper half with its sign, lower half without.
    #[inline(always)]
    fn split(a: i32) -> (i32, i32) {
        (a >> 16, a & 0xffff)
    }

    /// `ah bh`, and the two sums of the middle: `ah bl` and the carry of `al bl`; `al bh` and the lower half
    /// of the first.
    ///
    /// Neither leaves 32 bits: `|ah bl| <= 2^15 (2^16 - 1)`, and what is added is below `2^16`.
    #[inline(always)]
    fn parts(a: i32, b: i32) -> (i32, i32, i32) {
        let ((ah, al), (bh, bl)) = (split(a), split(b));
        let low = (al as u32).wrapping_mul(bl as u32);
        let first = ah.wrapping_mul(bl).wrapping_add((low >> 16) as i32);
        let second = al.wrapping_mul(bh).wrapping_add(first & 0xffff);
        (ah.wrapping_mul(bh), first, second)
    }

    #[inline(always)]
    pub(super) fn high(a: i32, b: i32) -> i32 {
        let (top, first, second) = parts(a, b);
        top.wrapping_add(first >> 16).wrapping_add(second >> 16)
    }

    /// As [`parts`], with an upper half of `b` without a sign: the second sum has none and stays below
    /// `2^32`.
    #[inline(always)]
    pub(super) fn high_mixed(a: i32, b: u32) -> i32 {
        let ((ah, al), (bh, bl)) = (split(a), (b >> 16, b & 0xffff));
        let low = (al as u32).wrapping_mul(bl) >> 16;
        let first = ah.wrapping_mul(bl as i32).wrapping_add(low as i32);
        let second = (al as u32).wrapping_mul(bh).wrapping_add(first as u32 & 0xffff);
        ah.wrapping_mul(bh as i32).wrapping_add(first >> 16).wrapping_add((second >> 16) as i32)
    }

    #[inline(always)]
    pub(super) fn product_mixed(a: i32, b: u32) -> i64 {
        (i64::from(high_mixed(a, b)) << 32) | i64::from((a as u32).wrapping_mul(b))
    }

    /// Bit 31 of the product is bit 15 of the second sum, which has no room for half a unit more: it is
    /// halved to it first.
    #[inline(always)]
    pub(super) fn high_rounded(a: i32, b: i32) -> i32 {
        let (top, first, second) = parts(a, b);
        top.wrapping_add(first >> 16).wrapping_add((second >> 15).wrapping_add(1) >> 1)
    }

    /// With a signed lower half of `b`, so that its upper half may be `2^16`. The compiler knows the form
    /// with unsigned halves for what it is, and would put the call of the library back.
    #[inline(always)]
    pub(super) fn high_u(a: u32, b: u32) -> u32 {
        joined(a, ((b >> 16) + (b >> 15 & 1), i32::from(b as i16)))
    }

    /// The upper half stays below `2^16`, so that it is what is left when the lower one is taken off.
    #[inline(always)]
    pub(super) fn high_u_below(a: u32, b: u32) -> u32 {
        let low = i32::from(b as i16);
        joined(a, (b.wrapping_sub(low as u32) >> 16, low))
    }

    #[inline(always)]
    fn joined(a: u32, (bh, bl): (u32, i32)) -> u32 {
        let (ah, al) = (a >> 16, a & 0xffff);
        // al bl fits a signed word, and so does ah bl with what is added
        let low = (al as i32).wrapping_mul(bl) >> 16;
        let first = (ah as i32).wrapping_mul(bl).wrapping_add(low);
        // at most (2^16 - 1) 2^16 + 2^16 - 1
        let second = al.wrapping_mul(bh).wrapping_add(first as u32 & 0xffff);
        ah.wrapping_mul(bh).wrapping_add_signed(first >> 16).wrapping_add(second >> 16)
    }

    /// As [`high_of_square`]; the sum stays below `2^32`.
    #[inline(always)]
    pub(super) fn high_of_square_u(a: u32) -> u32 {
        let (ah, al) = (a >> 16, a & 0xffff);
        let square = al.wrapping_mul(al) >> 17;
        ah.wrapping_mul(ah).wrapping_add(ah.wrapping_mul(al).wrapping_add(square) >> 15)
    }

    /// `a^2 = ah^2 2^32 + (ah al 2^17 + al^2)`, and the second part over `2^32` is
    /// `(ah al + al^2 / 2^17) / 2^15`.
    #[inline(always)]
    pub(super) fn high_of_square(a: i32) -> i32 {
        let (ah, al) = split(a);
        let square = (al as u32).wrapping_mul(al as u32) >> 17;
        ah.wrapping_mul(ah).wrapping_add(ah.wrapping_mul(al).wrapping_add(square as i32) >> 15)
    }

    /// `(a b + 2^30) / 2^31`: the two products in the middle, below `2^16 (|ah| + |bh|)`, are added before
    /// anything is shifted.
    #[inline(always)]
    pub(super) fn high_of_double(a: i32, b: i32) -> i32 {
        let ((ah, al), (bh, bl)) = (split(a), split(b));
        let low = (al as u32).wrapping_mul(bl as u32) >> 16;
        let middle = ah.wrapping_mul(bl).wrapping_add(al.wrapping_mul(bh)).wrapping_add(low as i32);
        (ah.wrapping_mul(bh) << 1).wrapping_add(middle.wrapping_add(1 << 14) >> 15)
    }

    /// The sum in the middle fits a word: where a lower half is not 0, an upper half is at most `2^14 - 1`,
    /// and below 0 at least `-2^14`, times at most `2^16 - 1`.
    #[inline(always)]
    pub(super) fn product_shifted<const S: u32>(a: i32, b: i32, half: i32) -> i32 {
        let ((ah, al), (bh, bl)) = (split(a), split(b));
        let low = (al as u32).wrapping_mul(bl as u32) >> 16;
        let middle = ah.wrapping_mul(bl).wrapping_add(al.wrapping_mul(bh));
        let middle = middle.wrapping_add(low as i32).wrapping_add(half);
        (ah.wrapping_mul(bh) << (32 - S)).wrapping_add(middle >> (S - 16))
    }

    /// With signed lower halves, from `-2^15` up, sums of two products fit a word: `ah xl - bh yl`, because
    /// `|ah| + |bh| <= sqrt(2) (2^15 + 1)`; `al xh - bl yh` and `bl xh + al yh`, which would reach `2^31`
    /// only for `xh = -2^15`; `al xl - bl yl`; and `al yl + bl xl` from `-2^31 + 2^16` to `2^31`, when its
    /// sign is changed.
    #[inline(always)]
    pub(super) fn complex_product_added([p, q]: [i64; 2], d: [i32; 2], v: [i32; 2]) -> [i64; 2] {
        let [[ah, al], [bh, bl]] = d.map(split_signed);
        let [[xh, xl], [yh, yl]] = v.map(split_signed);
        let difference =
            |[a, x]: [i32; 2], [b, y]: [i32; 2]| a.wrapping_mul(x).wrapping_sub(b.wrapping_mul(y));
        let sum = |[a, y]: [i32; 2], [b, x]: [i32; 2]| a.wrapping_mul(y).wrapping_add(b.wrapping_mul(x));
        let shifted = |word: i32, by: u32| i64::from(word) << by;
        let real = p
            .wrapping_add(difference([al, xl], [bl, yl]).into())
            .wrapping_add(shifted(difference([ah, xl], [bh, yl]), 16))
            .wrapping_add(shifted(difference([al, xh], [bl, yh]), 16))
            .wrapping_add(shifted(difference([ah, xh], [bh, yh]), 32));
        let imaginary = q
            .wrapping_sub(sum([al, yl], [bl, xl]).wrapping_neg().into())
            .wrapping_add(shifted(sum([ah, yl], [bh, xl]), 16))
            .wrapping_add(shifted(sum([al, yh], [bl, xh]), 16))
            .wrapping_add(shifted(sum([ah, yh], [bh, xh]), 32));
        [real, imaginary]
    }

    /// `a = ah 2^16 + al`, both with their signs, `ah` up to `2^15`.
    #[inline(always)]
    fn split_signed(a: i32) -> [i32; 2] {
        [(a >> 15).wrapping_add(1) >> 1, i32::from(a as i16)]
    }

    #[inline(always)]
    pub(super) fn product_by_short(a: u32, b: u16) -> u64 {
        let b = u32::from(b);
        let low = (a & 0xffff).wrapping_mul(b) >> 16;
        let high = (a >> 16).wrapping_mul(b).wrapping_add(low) >> 16;
        u64::from(high) << 32 | u64::from(a.wrapping_mul(b))
    }

    /// The lower word is what the target has.
    #[inline(always)]
    pub(super) fn product(a: i32, b: i32) -> i64 {
        (i64::from(high(a, b)) << 32) | i64::from(a.wrapping_mul(b) as u32)
    }

    #[inline(always)]
    pub(super) fn product_u(a: u32, b: u32) -> u64 {
        (u64::from(high_u(a, b)) << 32) | u64::from(a.wrapping_mul(b))
    }
}

#[cfg(test)]
mod tests {
    use super::{halves, whole};

    fn agree(a: i32, b: i32) {
        let exact = whole::product(a, b);
        assert_eq!(halves::product(a, b), exact, "{a} {b}");
        assert_eq!(i64::from(halves::high(a, b)), exact >> 32, "{a} {b}");
        // |exact| <= 2^62: adding half a unit does not overflow
        assert_eq!(i64::from(halves::high_rounded(a, b)), (exact + (1 << 31)) >> 32, "{a} {b}");
        assert_eq!(i64::from(super::high_rounded(a, b)), (exact + (1 << 31)) >> 32, "{a} {b}");
        let (short, other) = (a >> 1, b >> 1);
        for (half, got) in [
            (0, halves::product_shifted::<31>(short, other, 0)),
            (1 << 15, super::product_shifted::<31>(short, other, 1 << 15)),
            (1 << 15, halves::product_shifted::<31>(short, other, 1 << 15)),
        ] {
            let sum = whole::product(short, other) + (half << 16);
            assert_eq!(i64::from(got), sum >> 31, "{short} {other}");
        }
        assert_eq!(i64::from(halves::high_of_square(a)), whole::product(a, a) >> 32, "{a}");
        if i64::from(a).abs() + i64::from(b).abs() <= (1 << 31) - (1 << 18) {
            let half_up = (2 * exact + (1 << 31)) >> 32;
            assert_eq!(i64::from(halves::high_of_double(a, b)), half_up, "{a} {b}");
            if i64::from(a).abs() < 1 << 30 {
                assert_eq!(i64::from(super::high_of_double(a, b)), half_up, "{a} {b}");
            }
        }
        let mixed = i64::from(a) * i64::from(b as u32);
        assert_eq!([halves::product_mixed(a, b as u32), whole::product_mixed(a, b as u32)], [mixed; 2]);
        assert_eq!(i64::from(super::high_mixed(a, b as u32)), mixed >> 32, "{a} {b}");
        let (a, b) = (a as u32, b as u32);
        assert_eq!(halves::product_u(a, b), whole::product_u(a, b), "{a} {b}");
        assert_eq!(u64::from(halves::high_u(a, b)), whole::product_u(a, b) >> 32, "{a} {b}");
        if b < u32::MAX - 0x7fff {
            assert_eq!(u64::from(halves::high_u_below(a, b)), whole::product_u(a, b) >> 32, "{a} {b}");
            assert_eq!(super::high_u_below(a, b), halves::high_u(a, b), "{a} {b}");
        }
        assert_eq!(halves::product_by_short(a, b as u16), whole::product_u(a, u32::from(b as u16)));
        assert_eq!(u64::from(halves::high_of_square_u(a)), whole::product_u(a, a) >> 32, "{a}");
    }

    /// A product with 24 fractional bits: rounded down, and at the end of its range within 8 bits.
    #[test]
    fn a_product_within_a_range_is_the_exact_one_or_its_end() {
        let (mut inside, mut outside) = (0, 0);
        let words = [0, 1, -1, 1 << 24, -(1 << 24), 123_456_789, -987_654_321, 1 << 30, i32::MAX, i32::MIN];
        for (a, b) in words.iter().flat_map(|a| words.map(|b| (*a, b))) {
            let exact = (i64::from(a) * i64::from(b)) >> 24;
            let got = i64::from(super::product_within::<6>(a, b));
            if (-1 << 30..1 << 30).contains(&exact) {
                assert_eq!(got, exact, "{a} {b}");
                inside += 1;
            } else {
                let end = if exact < 0 { -1 << 30 } else { (1 << 30) - 256 };
                assert!((end..end + 256).contains(&got), "{a} {b}: {got}");
                outside += 1;
            }
        }
        assert!(inside > 30 && outside > 30, "{inside} {outside}");
    }

    /// Words whose halves are the ends of theirs, in all four places.
    #[test]
    fn both_ways_give_the_same_complex_product() {
        let ends = [0_u32, 1, 0x7fff, 0x8000, 0x8001, 0xffff];
        let words = || ends.iter().flat_map(|h| ends.iter().map(move |l| (h << 16 | l) as i32));
        let wide = i64::from;
        let mut tried = 0;
        for a in words() {
            let square = |v: i32| u64::from(v.unsigned_abs()).pow(2);
            let shorter = |b: &i32| square(a) + square(*b) < 1 << 62;
            for b in words().filter(shorter) {
                for x in words().filter(|x| *x >= i32::MIN + 0x8000) {
                    for y in words().filter(|y| *y > i32::MIN) {
                        let start = [wide(a) << 32 | wide(y) & 0xffff_ffff, wide(x) << 31 | wide(b) & 0xffff];
                        let exact = whole::complex_product_added(start, [a, b], [x, y]);
                        let got = halves::complex_product_added(start, [a, b], [x, y]);
                        assert_eq!(got, exact, "{a} {b} {x} {y}");
                        tried += 1;
                    }
                }
            }
        }
        assert!(tried > 500_000, "{tried}");
    }

    /// Words whose halves are the ends of theirs or beside them, all pairs; then `10^8` pairs at random.
    #[test]
    fn both_ways_give_the_same_bits() {
        let ends = [0_u32, 1, 2, 0x7ffe, 0x7fff, 0x8000, 0x8001, 0xfffe, 0xffff];
        let words = || ends.iter().flat_map(|h| ends.iter().map(move |l| (h << 16 | l) as i32));
        for a in words() {
            for b in words() {
                agree(a, b);
            }
        }
        let mut state = 1_u64;
        for _ in 0..100_000_000_u32 {
            // an LCG's upper bits (Knuth, TAOCP vol. 2, 3.3.4, table 1, line 26)
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (a, b) = ((state >> 32) as i32, (state as u32).rotate_left(16) as i32);
            agree(a, b);
        }
    }
}
