//! The random elbow: each segment `AB` becomes `AC` and `CB`, with `C` at a random distance on its
//! perpendicular bisector.
//!
//! One number makes it jagged or smooth, the exponent `beta` of its power spectrum. `C = M + t perp(B - A)`,
//! `M` the midpoint, `t` normal with deviation `sigma_k` at level `k`.
//!
//! The deviations follow from the spectrum. Let `V_k` be the mean square of the length of a segment at level
//! `k` and `D_k = sigma_k^2 V_k` that of the displacement; `V_{k+1} = V_k / 4 + D_k`. The power spectrum
//! falls as `1/f^beta` when `D_k` falls as `2^(-2 H k)`, `H = (beta - 1) / 2`; so
//!
//! `sigma_{k+1}^2 = 2^(1 - beta) sigma_k^2 / (1/4 + sigma_k^2)`.
//!
//! While `sigma` is small the factor of `sigma` is `2^((3 - beta) / 2)`, constant as in the course unit's
//! `fract`; in the end `sigma^2 = 2^(1 - beta) - 1/4`, where the curve is self-similar. Both factors that the
//! text prints give other spectra: `2^((1 - beta) / 2)` falls as `1/f^(beta + 2)`. Source: course unit V,
//! section 5.6; `t` from Carpenter's table, so that the seed repeats the curve and so does every part of it.

use super::displacement::{Displacement, LEVELS, Part, checked_spectrum, product_q28, raised_across};
use crate::Error;
use crate::num::RandomFunction;
use crate::num::formats::Q28;
use crate::num::{Real, Unit, checked_offset, sqrt};
use crate::plane::Point2;

/// The law of the random elbow. Size: 136 bytes.
///
/// ```
/// use attractor::curve::{Elbow, Stop, Subdivision};
/// use attractor::num::{Real, Unit};
/// use attractor::plane::{Point2, PathElement};
///
/// const KNOTS: [Point2; 3] = [Point2::lit("0", "0"), Point2::lit("1", "0.5"), Point2::lit("2", "0")];
/// // Brownian motion has a spectrum of 1/f^2
/// let law = Elbow::new(const { Unit::lit("0.25") }, const { Real::lit("2") }, 7)?;
/// let curve = Subdivision::<_, 20>::new(&law, &KNOTS, Stop::Length(const { Real::lit("0.05") }))?;
/// let steps: Vec<PathElement> = curve.collect();
/// assert!(steps.len() > 40 && steps.contains(&PathElement::LineTo(KNOTS[1])));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Elbow {
    random: RandomFunction,
    /// `sigma_k`.
    deviations: [Q28; LEVELS],
}

impl Elbow {
    /// Elbows with this standard deviation at the first level, over the length of the segment, and this
    /// spectral exponent: 1 is jagged, 2 a Brownian path, 3 smooth.
    ///
    /// Result: exponents of the power spectrum over 64 seeds and 4 to 512 periods, deviation 0.2, `y(t)`:
    /// 1.04, 1.53, 2.06, 2.61 and 3.10 for 1, 1.5, 2, 2.5 and 3 (`curves.rs`: `a_spectrum_falls_as_asked`,
    /// within 0.15). With 0.01 both coordinates together are as close, but `y(t)` alone is steeper by 0.2 at
    /// 1 and 1.5, where the curve begins almost straight and ends rough in all directions. At 1 a few long
    /// segments dominate single curves: only the mean over seeds is that smooth. Cost: 12.2 thousand
    /// Cortex-M4 instructions (kernel `elbow law`). The deviation of a curve that is rough in the same way at
    /// all scales is `sqrt(2^(1 - beta) - 1/4)`: [`Elbow::self_similar`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a deviation outside `0 .. 2`, or `beta` outside `1 ..= 3`.
    pub fn new(standard_deviation: Unit, beta: Real, seed: u64) -> Result<Self, Error> {
        let factor = u64::from(checked_spectrum(beta)?);
        let offset = u64::from(checked_offset(standard_deviation)?);
        // 30 fractional bits, at most 4
        let mut square = (offset * offset) >> 26;
        let mut deviations = [0; LEVELS];
        for deviation in &mut deviations {
            *deviation = (sqrt(square << 30) >> 2) as i32;
            square = (factor * square).checked_div((1 << 28) + square).unwrap_or(0);
        }
        Ok(Self { random: RandomFunction::new(seed), deviations })
    }

    /// Elbows with the same deviation at all levels, `sqrt(2^(1 - beta) - 1/4)`: a curve that is
    /// statistically self-similar.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for `beta` outside `1 ..= 3`; at 3 the curve is a straight line.
    pub fn self_similar(beta: Real, seed: u64) -> Result<Self, Error> {
        let square = u64::from(checked_spectrum(beta)?).saturating_sub(1 << 28);
        Self::new(Unit::from_bits(sqrt(square << 30) as i32), beta, seed)
    }

    /// The standard deviation at a level, over the length of the segment; 0 from level 32 on.
    pub fn standard_deviation(&self, level: u32) -> Unit {
        let bits = self.deviations.get(level as usize).copied().unwrap_or(0);
        Unit::from_bits(bits.saturating_mul(4))
    }
}

impl Displacement for Elbow {
    #[inline]
    fn midpoint(&self, part: &Part) -> Point2 {
        let deviation = self.deviations.get(part.level as usize).copied().unwrap_or(0);
        let t = product_q28(deviation, self.random.at(part.middle).to_bits());
        raised_across(part, t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_factor_is_constant_first_and_the_deviation_in_the_end() {
        for beta in [1.0_f64, 1.5, 2.0, 2.5] {
            let law = Elbow::new(Unit::from_num(0.001), Real::from_num(beta), 1).unwrap();
            let sigma: std::vec::Vec<f64> = (0..32).map(|k| law.standard_deviation(k).to_num()).collect();
            assert!((sigma[1] / sigma[0] - ((3.0 - beta) / 2.0).exp2()).abs() < 1e-3, "{beta}: {sigma:?}");
            let limit = ((1.0 - beta).exp2() - 0.25).sqrt();
            assert!(beta > 2.0 || (sigma[31] - limit).abs() < 1e-3, "{beta}: {sigma:?}");
            let similar = Elbow::self_similar(Real::from_num(beta), 1).unwrap();
            for k in 0..32 {
                assert!((similar.standard_deviation(k).to_num::<f64>() - limit).abs() < 1e-7);
            }
        }
        // beta = 3: smaller and smaller, without end
        let smooth = Elbow::new(Unit::from_num(0.5), Real::from_num(3), 1).unwrap();
        assert!((1..32).all(|k| smooth.standard_deviation(k) < smooth.standard_deviation(k - 1)));
    }
}
