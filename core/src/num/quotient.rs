//! Quotients of 128-bit numbers by 64-bit ones, a bit at a time, for constructors.
//!
//! The library's division of `i128` takes a kilobyte of code wherever it is inlined. Constructors need few
//! quotients and may take their time: this loop is short and there once.

/// `v 2^shift / d` rounded down, saturated; the greatest number for `d` = 0.
///
/// Domain: `shift < 64`. Exact. Cost: 32 or 64 steps of a shift and a subtraction of 128 bits.
#[inline(never)]
pub(crate) const fn ratio(v: u64, shift: u32, d: u64) -> u64 {
    let (mut rest, mut low, mut quotient) = ((v >> 1) >> (63 - shift), v << shift, 1);
    if rest >= d {
        return u64::MAX;
    }
    // the first word of the quotient is often 0
    let word = rest << 32 | low >> 32;
    if rest >> 32 == 0 && word < d {
        (rest, low, quotient) = (word, low << 32, 1 << 32);
    }
    // the quotient begins as a single 1: when that bit leaves the word above, all 64 digits are there
    loop {
        // rest < d: nothing leaves 64 bits
        let (missing, with_bit) = (d - rest, rest + (low >> 63));
        let one = with_bit >= missing;
        rest = if one { with_bit - missing } else { with_bit + rest };
        low <<= 1;
        let full = quotient >> 63 > 0;
        quotient = quotient << 1 | one as u64;
        if full {
            return quotient;
        }
    }
}

/// The same for a signed number, towards zero, saturated at both ends.
#[inline(never)]
pub(crate) const fn quotient(v: i64, shift: u32, d: u64) -> i64 {
    let sign = v >> 63;
    let (magnitude, most) = (ratio(v.unsigned_abs(), shift, d), i64::MAX.wrapping_sub(sign) as u64);
    let magnitude = if magnitude > most { most } else { magnitude } as i64;
    (magnitude ^ sign).wrapping_sub(sign)
}

/// `v / n` towards zero, for `n` below `2^16` (0 counts as 1): four digits of 16 bits. Cost: 4 divisions of
/// 32 bits.
#[inline(never)]
pub(crate) fn nth(v: i64, n: u32) -> i64 {
    let (mut rest, mut quotient) = (0, 0_i64);
    for shift in [48, 32, 16, 0] {
        let digit = rest << 16 | (v.unsigned_abs() >> shift) as u32 & 0xffff;
        let part = digit.checked_div(n).unwrap_or(digit);
        rest = digit - part * n;
        quotient = quotient << 16 | i64::from(part);
    }
    if v < 0 { quotient.wrapping_neg() } else { quotient }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_are_those_of_128_bits() {
        let samples =
            [0, 1, 2, 3, 10, 0xffff_ffff, 1 << 32, 0x1234_5678_9abc_def0, 1 << 63, u64::MAX - 1, u64::MAX];
        let mut saturated = 0;
        for v in samples {
            for n in [1, 2, 3, 7, 12_870, 65_535] {
                assert_eq!(nth(v as i64 / 2, n), v as i64 / 2 / i64::from(n));
            }
            for d in samples {
                for shift in [0, 1, 17, 32, 48, 63] {
                    let exact = (u128::from(v) << shift).checked_div(u128::from(d)).unwrap_or(u128::MAX);
                    let expected = exact.min(u128::from(u64::MAX)) as u64;
                    assert_eq!(ratio(v, shift, d), expected, "{v} << {shift} / {d}");
                    let exact = (i128::from(v as i64) << shift).checked_div(i128::from(d));
                    let sign = i128::from((v as i64).signum());
                    let limits = (i128::from(i64::MIN), i128::from(i64::MAX));
                    let expected = exact.unwrap_or(sign << 100).clamp(limits.0, limits.1) as i64;
                    if v > 0 || d > 0 {
                        assert_eq!(
                            i128::from(quotient(v as i64, shift, d)),
                            i128::from(expected),
                            "{v} << {shift} / {d}"
                        );
                    }
                    saturated += u32::from(expected == i64::MAX);
                }
            }
        }
        assert!(saturated > 20);
    }

    #[test]
    fn no_parts_count_as_one() {
        assert_eq!([nth(1 << 40, 0), nth(-77, 0)], [1 << 40, -77]);
    }

    /// Seeded words of every length, against 128 bits.
    #[test]
    fn quotients_of_words_of_every_length_are_those_of_128_bits() {
        let mut word = 1_u64;
        let mut next = |k: u64| {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (word ^ word >> 32) >> (k % 64)
        };
        for k in 0..20_000 {
            let (v, d, shift) = (next(k), next(k / 64).max(1), (k % 64) as u32);
            let exact = ((u128::from(v) << shift) / u128::from(d)).min(u128::from(u64::MAX)) as u64;
            assert_eq!(ratio(v, shift, d), exact, "{v} << {shift} / {d}");
            let (signed, n) = (v as i64, (d & 0xffff) as u32);
            let exact = (i128::from(signed) << shift) / i128::from(d);
            let exact = exact.clamp(i128::from(i64::MIN), i128::from(i64::MAX));
            assert_eq!(i128::from(quotient(signed, shift, d)), exact, "{signed} << {shift} / {d}");
            assert_eq!(nth(signed, n), signed / i64::from(n.max(1)), "{signed} / {n}");
        }
    }
}
