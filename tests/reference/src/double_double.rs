//! Arithmetic with the unevaluated sum of two `f64`, about 106 bits: what keeps the reference's own rounding
//! out of sight.
//!
//! A fractal function with a vertical scaling of 0.99 multiplies every rounding error of its maps by 100, so
//! plain `f64` is no yardstick. Source: T. J. Dekker, "A floating-point technique for extending the available
//! precision", 1971 (two-product by splitting); D. E. Knuth, TAOCP vol. 2, 4.2.2, theorem B (two-sum).

use core::ops::{Add, Div, Mul, Neg, Sub};

/// `high + low`, with `|low|` at most half an ulp of `high`.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(crate) struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    pub(crate) const ZERO: Self = Self { high: 0.0, low: 0.0 };
    pub(crate) const ONE: Self = Self { high: 1.0, low: 0.0 };

    /// The nearest `f64`.
    pub(crate) fn value(self) -> f64 {
        self.high
    }

    /// What the nearest `f64` lacks.
    pub(crate) fn low(self) -> f64 {
        self.low
    }

    /// The smaller of two numbers.
    pub(crate) fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of two numbers.
    pub(crate) fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

/// `a + b` and its rounding error, exact (Knuth).
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    let b_part = high - a;
    DoubleDouble { high, low: (a - (high - b_part)) + (b - b_part) }
}

/// The same for `|a| >= |b|` (Dekker).
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: b - (high - a) }
}

/// `a` as the sum of two numbers of 26 bits (Dekker, Veltkamp).
fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a; // 2^27 + 1
    let high = c - (c - a);
    (high, a - high)
}

/// `a * b` and its rounding error, exact (Dekker).
fn two_product(a: f64, b: f64) -> DoubleDouble {
    let high = a * b;
    let (a1, a2) = split(a);
    let (b1, b2) = split(b);
    DoubleDouble { high, low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2 }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = two_sum(self.high, other.high);
        let low = two_sum(self.low, other.low);
        let sum = quick_two_sum(high.high, high.low + low.high);
        quick_two_sum(sum.high, sum.low + low.low)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = two_product(self.high, other.high);
        quick_two_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    /// Long division, three digits of 53 bits: exact whenever the quotient is a double-double of an `f64`
    /// divisor.
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::from(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::from(second);
        let third = rest.high / other.high;
        quick_two_sum(first, second) + Self::from(third)
    }
}

#[cfg(test)]
mod tests {
    use super::DoubleDouble;

    #[test]
    fn a_sum_keeps_what_f64_would_lose() {
        let tiny = DoubleDouble::from(libm::exp2(-90.0));
        let sum = DoubleDouble::ONE + tiny;
        assert_eq!(sum.value(), 1.0);
        assert_eq!((sum - DoubleDouble::ONE).value(), tiny.value());
    }

    #[test]
    fn a_product_is_exact_to_the_last_bit() {
        let x = 1.0 + libm::exp2(-50.0);
        let square = DoubleDouble::from(x) * DoubleDouble::from(x);
        let rest = square - DoubleDouble::from(1.0 + libm::exp2(-49.0));
        assert_eq!(rest.value(), libm::exp2(-100.0));
    }

    #[test]
    fn a_third_times_three_is_one_to_a_hundred_bits() {
        let three = DoubleDouble::from(3.0);
        let third = DoubleDouble::ONE / three;
        assert_ne!(third, DoubleDouble::from(1.0 / 3.0));
        assert!((third * three - DoubleDouble::ONE).value().abs() < 1e-31);
    }

    #[test]
    fn an_exact_quotient_is_found_exactly() {
        let quotient = DoubleDouble::from(1701.0 / 1024.0);
        assert_eq!(quotient * DoubleDouble::from(308.0) / DoubleDouble::from(308.0), quotient);
    }
}
