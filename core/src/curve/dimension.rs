//! Dimensions of curves from how they are made.
//!
//! - A curve that becomes longer by `ratio` when each part is halved: `D = ln 2 / ln(2 / ratio)` (L. C. Carpenter, 1980);
//! - a graph whose power spectrum falls as `1/f^beta`: `D = (5 - beta) / 2` (course unit V, section 5.6.2);
//! - `n` equal segments of length `r`: `D = ln n / ln(1/r)`.

use super::displacement::checked_spectrum;
use super::generator::Generator;
use crate::Error;
use crate::num::{Real, Wide, log2};

/// `ln 2 / ln(2 / ratio)`; a ratio of 1.3 gives 1.61.
///
/// Error: below `2^-20` for ratios up to 1.5 (`dimensions_are_those_of_the_texts`).
///
/// # Errors
/// [`Error::OutOfRange`] for a ratio outside `1 .. 2`.
///
/// ```
/// use attractor::{curve::dimension_of_ratio, num::Real};
/// assert!(dimension_of_ratio(Real::from_num(1.3))?.abs_diff(attractor::num::Wide::from_num(1.61)) < 0.01);
/// # Ok::<(), attractor::Error>(())
/// ```
pub fn dimension_of_ratio(ratio: Real) -> Result<Wide, Error> {
    let max = Real::from_bits((2 << 24) - 1);
    if ratio < Real::ONE || ratio > max {
        return Err(Error::OutOfRange {
            what: "similarity ratio",
            index: 0,
            value: ratio.into(),
            min: Wide::ONE,
            max: max.into(),
        });
    }
    // 1 - log2(ratio), 24 fractional bits
    let bits = (25 << 24) - i64::from(log2(u64::from(ratio.to_bits().unsigned_abs())));
    Ok(Wide::from_bits((1_i64 << 62).checked_div(bits.max(1)).unwrap_or(0) << 10))
}

/// `(5 - beta) / 2`.
///
/// # Errors
/// [`Error::OutOfRange`] for `beta` outside `1 ..= 3`.
pub fn dimension_of_spectrum(beta: Real) -> Result<Wide, Error> {
    checked_spectrum(beta)?;
    Ok((Wide::from_num(5) - Wide::from(beta)) / 2)
}

impl<const S: usize> Generator<S> {
    /// The dimension of the curve that the generator tends to, unless it overlaps itself: `ln n / ln(1/r)`, none when its segments differ in length.
    ///
    /// Error: below `2^-20`.
    pub fn dimension(&self) -> Option<Wide> {
        let (min, max) = (self.ratios().min()?, self.ratios().max()?);
        // rounding: a part in 2^22
        if max - min > max >> 22 {
            return None;
        }
        let count = i64::from(log2(self.len() as u64));
        let shortening = (30 << 24) - i64::from(log2(u64::from(max)));
        Some(Wide::from_bits((count << 32).checked_div(shortening)? << 16))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::catalogue::{self, LARGEST};

    #[test]
    fn dimensions_are_those_of_the_texts() {
        let mut worst: f64 = 0.0;
        for thousandths in 1000..1500 {
            let ratio = f64::from(thousandths) / 1000.0;
            let got = dimension_of_ratio(Real::from_num(ratio)).unwrap().to_num::<f64>();
            worst = worst.max((got - 2.0_f64.ln() / (2.0 / ratio).ln()).abs());
        }
        assert!(worst > 0.0 && worst < 2.0_f64.powi(-20), "{worst:e}");
        assert_eq!(dimension_of_ratio(Real::ONE).unwrap(), 1);
        assert!(
            dimension_of_ratio(Real::from_num(2)).is_err()
                && dimension_of_ratio(Real::from_num(0.99)).is_err()
        );
        assert_eq!(dimension_of_spectrum(Real::from_num(2)).unwrap(), Wide::from_num(1.5));
        assert!(dimension_of_spectrum(Real::from_num(3.01)).is_err());
        for (curve, d) in [
            (&catalogue::KOCH, 4.0_f64.ln() / 3.0_f64.ln()),
            (&catalogue::MINKOWSKI, 1.5),
            (&catalogue::HILBERT, 2.0),
            (&catalogue::PEANO, 2.0),
            (&catalogue::GOSPER, 2.0),
            (&catalogue::HEIGHWAY_DRAGON, 2.0),
            (&catalogue::SIERPINSKI_ARROWHEAD, 3.0_f64.ln() / 2.0_f64.ln()),
        ] {
            let got = curve.generator::<LARGEST>().unwrap().dimension().unwrap().to_num::<f64>();
            assert!((got - d).abs() < 1e-6, "{}: {got} against {d}", curve.name);
        }
    }
}
