//! Numbers between text and fixed point, both ways without loss: decimal digits to the nearest number of a
//! format, and back with all digits.

use std::fmt;
use std::str::FromStr;

use attractor::fixed::traits::Fixed;
use serde::de::{Deserialize, Deserializer, Visitor};

/// A number as a scene file gives it: TOML float, integer, or a string of decimal digits.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Number {
    /// Its own digits are in the file.
    Plain,
    /// A string.
    Text(String),
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Digits;
        impl Visitor<'_> for Digits {
            type Value = Number;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, or a string with a decimal number")
            }
            fn visit_f64<E>(self, _: f64) -> Result<Number, E> {
                Ok(Number::Plain)
            }
            fn visit_i64<E>(self, _: i64) -> Result<Number, E> {
                Ok(Number::Plain)
            }
            fn visit_u64<E>(self, _: u64) -> Result<Number, E> {
                Ok(Number::Plain)
            }
            fn visit_str<E>(self, text: &str) -> Result<Number, E> {
                Ok(Number::Text(text.trim().to_owned()))
            }
        }
        deserializer.deserialize_any(Digits)
    }
}

/// The number of the format that is nearest to a decimal number; ties go to the even one.
///
/// The error says what is wrong in words that follow the value.
pub(crate) fn nearest<F: Fixed + FromStr>(digits: &str) -> Result<F, String> {
    let digits = digits.replace('_', "");
    if let Ok(value) = digits.parse() {
        return Ok(value);
    }
    match digits.parse::<f64>() {
        Ok(value) if value.is_finite() => {
            // a power of two on both sides, 0 below where there is no sign
            let (limit, above) = (format!("{:.0}", F::MIN), format!("{:.0}", F::MAX));
            Err(format!("is outside the format, allowed is from {limit} to just below {above}"))
        }
        _ => Err("is not a finite decimal number".to_owned()),
    }
}

/// A decimal number rounded to so many decimal places, halves away from 0; what is no such number stays as it
/// is.
pub(crate) fn rounded(text: &str, places: usize) -> String {
    let (sign, number) = match text.strip_prefix('-') {
        Some(rest) => ("-", rest),
        None => ("", text.strip_prefix('+').unwrap_or(text)),
    };
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let Ok(exponent) = exponent.parse::<i64>() else { return text.to_owned() };
    let mut digits = [whole, fraction].concat().into_bytes();
    // digits that stay
    let kept = exponent.saturating_add((whole.len() + places) as i64);
    if !digits.iter().all(u8::is_ascii_digit) || kept >= digits.len() as i64 {
        return text.to_owned();
    }
    let Ok(kept) = usize::try_from(kept) else { return "0".to_owned() };
    let up = digits.get(kept).is_some_and(|next| *next >= b'5');
    digits.truncate(kept);
    // a nine is carried over
    let last = digits.iter().rposition(|digit| !up || *digit != b'9');
    let carried = last.map_or(0, |last| last + 1);
    digits.iter_mut().skip(carried).for_each(|nine| *nine = b'0');
    match last.and_then(|last| digits.get_mut(last)) {
        Some(digit) => *digit += u8::from(up),
        None => digits.insert(0, b'0' + u8::from(up)),
    }
    format!("{sign}{}e-{places}", String::from_utf8_lossy(&digits))
}

/// The `f64` nearest to a decimal number.
pub(crate) fn float(digits: &str) -> f64 {
    digits.replace('_', "").parse().unwrap_or(f64::NAN)
}

/// All digits of a fixed-point number: a binary fraction of `n` bits has at most `n` decimals.
pub(crate) fn exact<F: Fixed>(value: F) -> String {
    let digits = format!("{value:.*}", F::FRAC_NBITS as usize);
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.').to_owned() } else { digits }
}

#[cfg(test)]
mod tests {
    use super::*;
    use attractor::num::{Real, Scaling, Wide};

    #[test]
    fn decimal_digits_become_the_nearest_number() {
        assert_eq!(nearest("0.1"), Ok(Wide::from_bits(28147497671066)));
        assert_eq!(nearest("-1e-3"), Ok(Wide::from_bits(-281474976711)));
        assert_eq!(nearest("1_000"), Ok(Wide::from_num(1000)));
        // digits far beyond the format decide between neighbours
        let half = "0.00000000000000177635683940025046467781066894531250000000000000000000";
        assert_eq!(nearest::<Wide>(half), Ok(Wide::ZERO));
        assert_eq!(nearest(&format!("{half}1")), Ok(Wide::from_bits(1)));
        assert_eq!(nearest("0.85"), Ok(Scaling::from_bits(1825361101)));
    }

    #[test]
    fn what_is_no_number_of_the_format_is_named() {
        for digits in ["1e9", "32768", "-32769", "99999999999999999999999999"] {
            assert!(nearest::<Wide>(digits).unwrap_err().contains("outside the format"), "{digits}");
        }
        for digits in ["", "nan", "inf", "1.2.3", "0x10", "one", "1e400"] {
            assert!(nearest::<Wide>(digits).unwrap_err().contains("not a finite"), "{digits}");
        }
        assert!(nearest::<Scaling>("1.0").unwrap_err().contains("outside"));
        assert!(nearest::<Scaling>("0.9999999999").unwrap_err().contains("outside"));
    }

    #[test]
    fn digits_beyond_the_last_place_are_rounded_away() {
        for (text, places, want) in [
            ("0.12345", 3, "0123e-3"),
            ("-0.12350", 3, "-0124e-3"),
            ("0.9996", 3, "1000e-3"),
            ("9.9996", 3, "10000e-3"),
            ("+1.00049", 3, "1000e-3"),
            ("12345e-4", 3, "1235e-3"),
            (".0004", 3, "000e-3"),
            (".0005", 3, "001e-3"),
            ("0.5e-3", 3, "1e-3"),
            ("9.5e-4", 3, "1e-3"),
            ("4e-4", 3, "0e-3"),
            ("1e-9", 3, "0"),
            ("1e-999999999999", 3, "0"),
            ("0.123", 3, "0.123"),
            ("1e300", 3, "1e300"),
            ("x.5555", 3, "x.5555"),
        ] {
            assert_eq!(rounded(text, places), want, "{text}");
        }
    }

    #[test]
    fn numbers_are_printed_with_all_their_digits() {
        assert_eq!(exact(Real::from_num(-1.5)), "-1.5");
        assert_eq!(exact(Real::from_num(100)), "100");
        assert_eq!(exact(Real::ZERO), "0");
        assert_eq!(exact(Wide::DELTA), "0.000000000000003552713678800500929355621337890625");
        for bits in [1, 77, -12345678901234567, i64::MAX, i64::MIN] {
            assert_eq!(nearest(&exact(Wide::from_bits(bits))), Ok(Wide::from_bits(bits)));
        }
    }
}
