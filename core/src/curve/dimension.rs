//! The fractal dimension of a curve from how it is made, without measuring it.
//!
//! - A curve that becomes longer by `ratio` when each part is halved: `D = ln 2 / ln(2 / ratio)` (L. C.
//!   Carpenter, 1980);
//! - a graph whose power spectrum falls as `1/f^beta`: `D = (5 - beta) / 2` (course unit V, section 5.6.2);
//! - a generator with segments of lengths `r_j`: `sum r_j^D = 1` (P. A. P. Moran, "Additive functions of
//!   intervals and Hausdorff measure", 1946); for `n` equal ones `D = ln n / ln(1/r)`.

use super::displacement::checked_spectrum;
use super::generator::Generator;
use crate::Error;
use crate::num::formats::UQ62;
use crate::num::{Real, Wide, exp_minus, log2, ratio as quotient};

/// `ln 2 / ln(2 / ratio)`; a ratio of 1.3 gives 1.61.
///
/// It is the slope of `log 2^k` against `log(1 / mean length)` of the chords after `k` halvings
/// (tests/curves.rs: `a_similarity_ratio_of_1_3_gives_dimension_1_61`). Boxes count otherwise: halves of
/// random lengths `r` fill `2 mean(r^D) = 1` of them (R. D. Mauldin, S. C. Williams, "Random recursive
/// constructions", 1986), 1.70 at a ratio of 1.3, less those that the curve passes twice at its double
/// points. `attractor dimension` measures both.
///
/// Result: from [`Wide::MAX`] on, at a ratio of 1.99995769, it saturates. Error: below `2^-43` of the value
/// (`a_dimension_holds_up_to_the_ends_of_its_domain`).
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
            index: None,
            value: ratio.into(),
            min: Wide::ONE,
            max: max.into(),
        });
    }
    // ln(2 / ratio) = 2 artanh z, z = (2 - ratio) / (2 + ratio) <= 1/3: 62 fractional bits, so that it is
    // exact where it is small
    let bits = u64::from(ratio.to_bits().unsigned_abs());
    let z = quotient((2 << 24) - bits, 62, (2 << 24) + bits);
    let product_uq62 = |a: UQ62, b: UQ62| ((u128::from(a) * u128::from(b)) >> 62) as u64;
    // z + z^3 / 3 + z^5 / 5 + ..: 3^-40 is below the last place
    let (square, mut power, mut artanh) = (product_uq62(z, z), z, 0);
    for odd in (1..40).step_by(2) {
        artanh += power / odd;
        power = product_uq62(power, square);
    }
    const LN_2: UQ62 = 0x2c5c_85fd_f473_de6b;
    let dimension = quotient(LN_2, 48, 2 * artanh);
    Ok(Wide::from_bits(dimension.min(i64::MAX as u64) as i64))
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
    /// The dimension of the curve that the generator tends to, unless it overlaps itself: the solution of
    /// `sum r_j^D = 1`, `1 ..= 2`; 2 where that is greater.
    ///
    /// Error: below `2^-20` where no segment is longer than 3/4 (`a_dimension_solves_its_equation`).
    pub fn dimension(&self) -> Wide {
        // -ln r with 24 fractional bits, ln 2 with 31
        const LN_2: u64 = 0x58b9_0bfc;
        let logarithm = |r: u32| ((((30 << 24) - u64::from(log2(u64::from(r)))) * LN_2) >> 31) as i64;
        // sum r^d, 30 fractional bits, for d with 24; at most 127 terms
        let sum = |d: i64| -> i64 {
            let exponent = |r: u32| ((logarithm(r) * d) >> 24).min(i64::from(i32::MAX)) as i32;
            self.ratios().map(|r| i64::from(exp_minus(Real::from_bits(exponent(r))).to_bits())).sum()
        };
        // falls as d grows; not below 1 at d = 1, since the segments join the ends of the whole
        let (mut low, mut high) = (1_i64 << 24, 2_i64 << 24);
        if sum(high) > 1 << 30 {
            low = high;
        }
        while high - low > 1 {
            let middle = (low + high) / 2;
            if sum(middle) > 1 << 30 {
                low = middle;
            } else {
                high = middle;
            }
        }
        Wide::from_bits(high << 24)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::catalogue::{self, LARGEST};

    #[test]
    fn a_dimension_holds_up_to_the_ends_of_its_domain() {
        // evenly over the domain, and every ratio next to its ends
        let (one, two) = (1_i32 << 24, 2 << 24);
        let middle = (one + 3000..two - 3000).step_by(997);
        let (mut worst, mut before): (f64, _) = (0.0, Wide::ZERO);
        for bits in (one..one + 3000).chain(middle).chain(two - 3000..two) {
            let got = dimension_of_ratio(Real::from_bits(bits)).unwrap();
            // 2 - ratio is exact
            let below = f64::from(two - bits) / f64::from(two);
            let truth = -(2.0_f64.ln()) / (-below).ln_1p();
            assert!(got >= before, "{bits}: {got} after {before}");
            before = got;
            if truth >= 32768.0 {
                assert_eq!(got, Wide::MAX, "{bits}");
            } else {
                worst = worst.max((got.to_num::<f64>() - truth).abs() / truth);
            }
        }
        assert!(worst > 2.0_f64.powi(-45) && worst < 2.0_f64.powi(-43), "2^{}", worst.log2());
        assert!(dimension_of_ratio(Real::ONE).unwrap().abs_diff(Wide::ONE) <= Wide::DELTA * 8);
        // just where it saturates
        let number = |ratio| dimension_of_ratio(Real::from_num(ratio)).unwrap();
        assert!(number(1.999_957_6) < Wide::MAX && number(1.999_957_8) == Wide::MAX);
    }

    #[test]
    fn dimensions_are_those_of_the_texts() {
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
            (&catalogue::TERDRAGON, 2.0),
            (&catalogue::SIERPINSKI_ARROWHEAD, 3.0_f64.ln() / 2.0_f64.ln()),
        ] {
            let got = curve.generator::<LARGEST>().unwrap().dimension().to_num::<f64>();
            assert!((got - d).abs() < 2.0_f64.powi(-20), "{}: {got} against {d}", curve.name);
        }
        // lengths 3/4, 1/2, 1/4 and the like, against the equation itself
        for points in [
            &[[0.0, 0.0], [0.75, 0.0], [0.75, 0.5], [1.0, 0.0]][..],
            &[[0.0, 0.0], [0.125, 0.0], [0.5, 0.375], [0.875, 0.0], [1.0, 0.0]],
            &[[0.0, 0.0], [0.25, 0.0], [0.75, 0.0], [1.0, 0.0]],
            &[[0.0, 0.0], [0.0, 0.75], [0.5, 0.0], [0.5, 0.75], [1.0, 0.0]],
        ] {
            let wide: std::vec::Vec<_> = points.iter().map(|p| p.map(Wide::from_num)).collect();
            let got = Generator::<4>::polyline(&wide).unwrap().dimension().to_num::<f64>();
            let lengths = points.windows(2).map(|w| f64::hypot(w[1][0] - w[0][0], w[1][1] - w[0][1]));
            let excess = |d: f64| lengths.clone().map(|r| r.powf(d)).sum::<f64>() - 1.0;
            let step = 2.0_f64.powi(-20);
            let is_too_rough = got == 2.0 && excess(got) > 0.0;
            assert!(
                is_too_rough || (excess(got - step) > 0.0 && excess(got + step) < 0.0),
                "{points:?}: {got}"
            );
        }
    }

    /// Against the equation, for generators of up to four segments none of which is longer than 3/4.
    #[test]
    fn a_dimension_solves_its_equation() {
        let (mut worst, mut tried) = (0.0_f64, 0);
        let place = |k: i32| f64::from(k) / 32.0;
        for i in 0..24_000 {
            let [a, b, c, d] = [7, 11, 13, 17].map(|n| i * n % 29 - 6 + i / 3000);
            let points = [[0.0, 0.0], [place(a + 12), place(b)], [place(c + 12), place(d)], [1.0, 0.0]];
            let lengths = points.windows(2).map(|w| f64::hypot(w[1][0] - w[0][0], w[1][1] - w[0][1]));
            let lengths: std::vec::Vec<_> = lengths.collect();
            let sum = |d: f64| lengths.iter().map(|r| r.powf(d)).sum::<f64>();
            if lengths.iter().any(|r| *r > 0.75) || sum(2.0) > 1.0 {
                continue;
            }
            let wide = points.map(|p| p.map(Wide::from_num));
            let Ok(generator) = Generator::<4>::polyline(&wide) else { continue };
            let (mut low, mut high) = (1.0, 2.0);
            while high - low > 1e-12 {
                let middle = (low + high) / 2.0;
                if sum(middle) > 1.0 { low = middle } else { high = middle }
            }
            // in units of 2^-24, of which logarithm, exponent and exponential may take 16
            worst = worst.max((generator.dimension().to_num::<f64>() - low).abs() * 16_777_216.0);
            tried += 1;
        }
        assert!(tried > 300 && (4.0..6.0).contains(&worst), "{worst} of {tried}");
    }
}
