//! Reads a decimal string as a fixed-point number of any width.
//!
//! The coordinates of a deep zoom have a hundred decimal places, more than any number type holds: a program
//! is given them as text.
//!
//! The form is `[+-] digits [. digits] [e [+-] digits]`. Places behind the point are read from the last to
//! the first: `v <- (v + digit) / 10`, each quotient rounded to nearest, so that the errors form a geometric
//! series (D. E. Knuth, "The Art of Computer Programming", vol. 2, section 4.4, method 2b).

use core::str::FromStr;

use super::formats::Wide;
use super::limbs::Limbs;
use crate::Error;

const WHAT: &str = "decimal places of a coordinate";

impl<const LIMBS: usize> Limbs<LIMBS> {
    /// How many decimal places fit: a unit of the last one is at least a unit of the format.
    pub const DECIMAL_PLACES: usize = (Self::FRACTION as usize * 30_102) / 100_000;
}

/// How many limbs hold so many decimal places.
///
/// ```
/// use attractor::num::{Limbs, limbs_for};
/// const LIMBS: usize = limbs_for(25);
/// let long: Limbs<LIMBS> = "0.1234567890123456789012345".parse()?;
/// assert_eq!((LIMBS, Limbs::<LIMBS>::DECIMAL_PLACES), (3, 27));
/// # Ok::<(), attractor::Error>(())
/// ```
pub const fn limbs_for(decimal_places: usize) -> usize {
    // 2 limbs are meant at least; the bits of all places, and 4 before the point
    let bits = decimal_places.saturating_mul(100_000).div_ceil(30_102).saturating_add(4);
    let limbs = bits.div_ceil(32);
    if limbs < 2 { 2 } else { limbs }
}

/// Result: the nearest number, within 0.6 units of the last place (`a_decimal_is_read_to_the_last_place`).
///
/// ```
/// use attractor::num::Limbs;
/// let x: Limbs<4> = "-1.25e-1".parse()?;
/// assert_eq!(x.to_wide(), -0.15625 + 0.03125);
/// let long = "0.1234567890123456789012345";
/// assert_eq!(long.parse::<Limbs<2>>().unwrap_err().to_string(), "25 decimal places of a coordinate needed, there is room for 18");
/// # Ok::<(), attractor::Error>(())
/// ```
///
/// # Errors
/// [`Error::Capacity`] for more decimal places than [`Limbs::DECIMAL_PLACES`] ([`limbs_for`] tells how many
/// limbs they take), [`Error::OutOfRange`] for 8 and more in magnitude, [`Error::Malformed`] with the
/// position of the first byte that does not belong.
impl<const LIMBS: usize> FromStr for Limbs<LIMBS> {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let decimal = Decimal::parse(text.as_bytes())?;
        let places = decimal.places();
        if places > Self::DECIMAL_PLACES {
            return Err(Error::Capacity { what: WHAT, needed: places, capacity: Self::DECIMAL_PLACES });
        }
        let mut number = Self::ZERO;
        for place in (1..=places as i64).rev() {
            // below 10: there is room for 16
            number = number.plus_whole(decimal.digit(place)).plus_units(5).divided(10).0;
        }
        // the digits before the point: 8 and above is refused below
        let first = decimal.first_place();
        let whole = if first < -8 {
            // more digits than the error can tell
            u32::MAX
        } else {
            (first..=0).fold(0, |whole, place| whole * 10 + decimal.digit(place))
        };
        if whole > 7 {
            let value = Wide::saturating_from_num(whole);
            const EIGHT: Wide = Wide::lit("8");
            let value = if decimal.negative { -value } else { value };
            return Err(Error::OutOfRange {
                what: "coordinate",
                index: None,
                value,
                min: -EIGHT,
                max: EIGHT,
            });
        }
        let number = number.plus_whole(whole);
        Ok(if decimal.negative { number.negated() } else { number })
    }
}

/// A decimal number as it is written.
struct Decimal<'a> {
    negative: bool,
    /// Digits before the point, and behind it.
    whole: &'a [u8],
    fraction: &'a [u8],
    exponent: i64,
}

impl<'a> Decimal<'a> {
    fn parse(text: &'a [u8]) -> Result<Self, Error> {
        let position = |rest: &[u8]| text.len() - rest.len();
        let malformed = |rest: &[u8]| Error::Malformed { what: "number", position: position(rest) };
        let (negative, rest) = sign(text);
        let (whole, mut rest) = digits(rest);
        let mut fraction: &[u8] = &[];
        if let Some((b'.', behind)) = rest.split_first() {
            (fraction, rest) = digits(behind);
        }
        if whole.is_empty() && fraction.is_empty() {
            return Err(malformed(rest));
        }
        let mut exponent = 0_i64;
        if let Some((b'e' | b'E', behind)) = rest.split_first() {
            let (minus, behind) = sign(behind);
            let (power, behind) = digits(behind);
            if power.is_empty() {
                return Err(malformed(behind));
            }
            for digit in power {
                exponent = (exponent * 10 + i64::from(digit - b'0')).min(1 << 40);
            }
            exponent = if minus { -exponent } else { exponent };
            rest = behind;
        }
        if !rest.is_empty() {
            return Err(malformed(rest));
        }
        Ok(Self { negative, whole, fraction, exponent })
    }

    /// The digit with the value `10^-place`.
    fn digit(&self, place: i64) -> u32 {
        // place 1 is the first one behind the point as it is written, if the exponent is 0
        let index = self.whole.len() as i64 + place + self.exponent - 1;
        let byte = usize::try_from(index).ok().and_then(|i| match i.checked_sub(self.whole.len()) {
            None => self.whole.get(i),
            Some(i) => self.fraction.get(i),
        });
        byte.map_or(0, |b| u32::from(b.wrapping_sub(b'0')))
    }

    /// How many places behind the point there are, without zeros at the end.
    fn places(&self) -> usize {
        let significant = match self.fraction.iter().rposition(|d| *d != b'0') {
            Some(last) => last as i64 + 1,
            None => match self.whole.iter().rposition(|d| *d != b'0') {
                Some(last) => last as i64 + 1 - self.whole.len() as i64,
                None => return 0,
            },
        };
        (significant - self.exponent).max(0) as usize
    }

    /// The place of the first digit that is not 0, 1 if there is none before the point.
    fn first_place(&self) -> i64 {
        let first = match self.whole.iter().position(|d| *d != b'0') {
            Some(first) => first as i64 + 1 - self.whole.len() as i64,
            None => match self.fraction.iter().position(|d| *d != b'0') {
                Some(first) => first as i64 + 1,
                None => return 1,
            },
        };
        (first - self.exponent).min(1)
    }
}

fn sign(text: &[u8]) -> (bool, &[u8]) {
    match text.split_first() {
        Some((b'-', rest)) => (true, rest),
        Some((b'+', rest)) => (false, rest),
        _ => (false, text),
    }
}

fn digits(text: &[u8]) -> (&[u8], &[u8]) {
    let end = text.iter().position(|b| !b.is_ascii_digit()).unwrap_or(text.len());
    text.split_at_checked(end).unwrap_or((text, &[]))
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::format;
    use std::string::String;

    #[test]
    fn a_decimal_is_read_to_the_last_place() {
        // against i128 with 124 fractional bits: v = n / 10^k
        let (mut inexact, mut most) = (0, 0.0_f64);
        for k in 1..=27_u32 {
            for n in [1_i128, 7, 3_141_592_653, 10_i128.pow(k) - 1] {
                let n = n % 10_i128.pow(k);
                let text = format!("-0.{:0>width$}", n, width = k as usize);
                let got = text.parse::<Limbs<4>>().unwrap().negated().top128();
                // 2^124 n / 10^k by long division
                let (mut quotient, mut rest) = (0_i128, n);
                for _ in 0..124 {
                    rest *= 2;
                    quotient = 2 * quotient + i128::from(rest >= 10_i128.pow(k));
                    rest %= 10_i128.pow(k);
                }
                // half a unit, a tenth of one, a hundredth ...: 5/9
                let off = (got - quotient) * 10_i128.pow(k) - rest;
                assert!(9 * off.abs() <= 5 * 10_i128.pow(k), "{text}: {off}");
                inexact += i32::from(rest != 0);
                most = most.max(off.abs() as f64 / 10_f64.powi(k as i32));
            }
        }
        assert!(inexact > 50 && most > 0.4, "{inexact} {most}");
    }

    #[test]
    fn exponents_and_signs_move_the_point() {
        let read = |text: &str| text.parse::<Limbs<6>>().unwrap();
        for (a, b) in [
            ("1.5", "15e-1"),
            ("+0.0625", "625E-4"),
            ("-7", "-0.7e1"),
            ("0.001", "1e-3"),
            (".5", "5.e-1"),
            ("0e99", "0"),
            ("000.1200", "12e-2"),
            ("-0", "0"),
            ("7.000000", "700e-2"),
        ] {
            assert_eq!(read(a), read(b), "{a} {b}");
        }
        assert_eq!(read("-1.75").to_wide(), -1.75);
        assert_eq!(read("1e-50").highest_bit(), Some(188 - 167));
    }

    #[test]
    fn limbs_for_is_the_least_that_holds_them() {
        fn check<const N: usize>() {
            let places = Limbs::<N>::DECIMAL_PLACES;
            assert_eq!((limbs_for(places), limbs_for(places + 1)), (N, N + 1));
        }
        check::<2>();
        check::<3>();
        check::<4>();
        check::<12>();
        check::<53>();
    }

    #[test]
    fn what_does_not_fit_says_so() {
        let long = format!("0.{}", String::from_utf8(std::vec![b'3'; 500]).unwrap());
        let error = long.parse::<Limbs<4>>().unwrap_err();
        assert_eq!(error, Error::Capacity { what: WHAT, needed: 500, capacity: 37 });
        assert!(long.parse::<Limbs<52>>().is_err() && long.parse::<Limbs<53>>().is_ok());
        assert!(matches!("1e-40".parse::<Limbs<4>>(), Err(Error::Capacity { needed: 40, .. })));
        assert!("1e-999999999999999999999".parse::<Limbs<4>>().is_err());
        for (text, told) in [("100", 100), ("-12.5", -12), ("3e3", 3000), ("8", 8)] {
            let Err(Error::OutOfRange { value, .. }) = text.parse::<Limbs<4>>() else { panic!("{text}") };
            assert_eq!(value, told, "{text}");
        }
        for text in ["8", "-8.5", "123456789", "1e1", "0.5e99999999999999999999"] {
            assert!(matches!(text.parse::<Limbs<4>>(), Err(Error::OutOfRange { .. })), "{text}");
        }
        for (text, at) in [
            ("", 0),
            ("-", 1),
            ("1.2.3", 3),
            ("x", 0),
            ("1e", 2),
            ("1e-", 3),
            ("1,5", 1),
            (".", 1),
            ("0.1 ", 3),
        ] {
            let expected = Error::Malformed { what: "number", position: at };
            assert_eq!(text.parse::<Limbs<4>>(), Err(expected), "{text:?}");
        }
    }

    #[test]
    fn numbers_end_with_the_last_place_that_fits_and_at_8() {
        let eighteen = "0.123456789012345678";
        assert!(eighteen.parse::<Limbs<2>>().is_ok() && format!("{eighteen}9").parse::<Limbs<2>>().is_err());
        assert!("7.999".parse::<Limbs<2>>().is_ok() && "-7.999".parse::<Limbs<2>>().is_ok());
        for (text, told) in [("8.0", 8), ("12345", 12345), ("-1234.5e1", -12345)] {
            let Err(Error::OutOfRange { value, .. }) = text.parse::<Limbs<4>>() else { panic!("{text}") };
            assert_eq!(value, told, "{text}");
        }
        for text in ["9999999999", "99999999999999999999", "9e40"] {
            let Err(Error::OutOfRange { value, .. }) = text.parse::<Limbs<4>>() else { panic!("{text}") };
            assert_eq!(value, Wide::MAX, "{text}");
        }
    }

    #[test]
    fn as_many_places_as_are_said_to_fit_do_fit() {
        fn check<const N: usize>() {
            // whatever stands before the point; zeros behind it are places
            for (text, leading) in [("0.", 0), ("3.", 0), ("-0.00", 2)] {
                let threes = |count: usize| format!("{text}{}", "3".repeat(count));
                let long = threes(200 * N);
                let Err(Error::Capacity { needed, capacity, .. }) = long.parse::<Limbs<N>>() else {
                    panic!("{N}: {text}")
                };
                assert_eq!((needed, capacity), (200 * N + leading, Limbs::<N>::DECIMAL_PLACES), "{text}");
                assert!(threes(capacity - leading).parse::<Limbs<N>>().is_ok(), "{N}: {text}");
                assert!(threes(capacity - leading + 1).parse::<Limbs<N>>().is_err(), "{N}: {text}");
                // an exponent moves the point, zeros at the end are none
                let moved = format!("{}00e-{}", threes(capacity - leading - 5), 5);
                assert!(moved.parse::<Limbs<N>>().is_ok(), "{moved}");
                let moved = format!("{}00e-{}", threes(capacity - leading - 5), 6);
                assert!(moved.parse::<Limbs<N>>().is_err(), "{moved}");
            }
        }
        check::<2>();
        check::<3>();
        check::<4>();
        check::<12>();
    }
}
