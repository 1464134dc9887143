//! Straight lines through logarithms: the exponent of a power law with its standard error.

/// A power law fitted by least squares to pairs of logarithms.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fit {
    /// The slope.
    pub(crate) slope: f64,
    /// The standard error of the slope, from the residuals. Neighbouring scales share their randomness: it is
    /// a lower estimate.
    pub(crate) error: f64,
}

impl Fit {
    /// The line through these points; none with fewer than three of them, or with one abscissa only.
    pub(crate) fn of(points: &[(f64, f64)]) -> Option<Self> {
        let n = points.len() as f64;
        if points.len() < 3 || points.iter().any(|p| !p.0.is_finite() || !p.1.is_finite()) {
            return None;
        }
        let mean = |pick: fn(&(f64, f64)) -> f64| points.iter().map(pick).sum::<f64>() / n;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let spread: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
        if spread <= 0.0 {
            return None;
        }
        let slope = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / spread;
        let rest: f64 = points.iter().map(|p| (p.1 - y - slope * (p.0 - x)).powi(2)).sum();
        Some(Self { slope, error: (rest / (n - 2.0) / spread).sqrt() })
    }

    /// The slope of the second half of the points less that of the first half, the middle one in both: what
    /// is systematic shows there. None with fewer than six.
    pub(crate) fn drift(points: &[(f64, f64)]) -> Option<f64> {
        let n = points.len();
        let (first, second) = (points.get(..n.div_ceil(2))?, points.get(n / 2..)?);
        (n >= 6).then_some(Self::of(second)?.slope - Self::of(first)?.slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_fitted_without_error_and_noise_with_its_own() {
        let exact = Fit::of(&[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0), (5.0, 11.0)]).unwrap();
        assert!((exact.slope - 2.0).abs() < 1e-12 && exact.error < 1e-12);
        // residuals 1, -2, 1 about the mean: s^2 = 6, over a spread of 2
        let noisy = Fit::of(&[(0.0, 1.0), (1.0, -2.0), (2.0, 1.0)]).unwrap();
        assert!(noisy.slope.abs() < 1e-12 && (noisy.error - 3.0_f64.sqrt()).abs() < 1e-12);
        assert!(Fit::of(&[(0.0, 1.0), (1.0, 3.0)]).is_none() && Fit::of(&[(1.0, 1.0); 3]).is_none());
        assert!(Fit::of(&[(0.0, 1.0), (1.0, f64::NEG_INFINITY), (2.0, 1.0)]).is_none());
        // a parabola: slopes 3 and 9 from 0 to 3 and from 3 to 6
        let bent: Vec<(f64, f64)> = (0..5).map(|i| (f64::from(i), f64::from(i * i))).collect();
        assert!(Fit::drift(&bent).is_none());
        let bent: Vec<(f64, f64)> = (0..7).map(|i| (f64::from(i), f64::from(i * i))).collect();
        assert!((Fit::drift(&bent).unwrap() - 6.0).abs() < 1e-12);
    }
}
