//! Polynomials in one variable, constant coefficient first: the `q_j` of a fractal interpolation function.
//!
//! Source: Cochran, Lewis and Hart, "The Normal of a Fractal Surface", section 2, eq. 9 and 28.

use crate::double_double::DoubleDouble;

/// A polynomial `c_0 + c_1 u + c_2 u^2 + ...`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Polynomial(pub(crate) Vec<DoubleDouble>);

impl Polynomial {
    /// From `f64` coefficients.
    pub(crate) fn new(coefficients: &[f64]) -> Self {
        Self(coefficients.iter().map(|&c| DoubleDouble::from(c)).collect())
    }

    /// The coefficients, rounded.
    pub(crate) fn coefficients(&self) -> Vec<f64> {
        self.0.iter().map(|c| c.value()).collect()
    }

    /// The value at `u`, by Horner's rule.
    pub(crate) fn at(&self, u: DoubleDouble) -> DoubleDouble {
        self.0.iter().rev().fold(DoubleDouble::ZERO, |sum, &c| sum * u + c)
    }

    /// The polynomial `p(scale v + start)` in `v`: eq. 28, with Horner's rule in place of the binomials.
    pub(crate) fn substitute(&self, start: DoubleDouble, scale: DoubleDouble) -> Self {
        let mut result: Vec<DoubleDouble> = Vec::new();
        for &c in self.0.iter().rev() {
            result.push(DoubleDouble::ZERO);
            for i in (0..result.len()).rev() {
                let below = if i > 0 { result[i - 1] * scale } else { c };
                result[i] = result[i] * start + below;
            }
        }
        Self(result)
    }

    /// `scale` times the antiderivative, with the given constant.
    pub(crate) fn antiderivative(&self, scale: DoubleDouble, constant: DoubleDouble) -> Self {
        let powers = self.0.iter().enumerate().map(|(i, &c)| scale * c / DoubleDouble::from((i + 1) as f64));
        Self(core::iter::once(constant).chain(powers).collect())
    }

    /// The derivative divided by `scale`; the derivative of a constant is one zero coefficient.
    pub(crate) fn derivative(&self, scale: DoubleDouble) -> Self {
        if self.0.len() < 2 {
            return Self(vec![DoubleDouble::ZERO]);
        }
        let powers = self.0.iter().enumerate().skip(1);
        Self(powers.map(|(i, &c)| DoubleDouble::from(i as f64) * c / scale).collect())
    }

    /// The mean over `[0, 1]`, that is the integral.
    pub(crate) fn mean(&self) -> DoubleDouble {
        let terms = self.0.iter().enumerate().map(|(i, &c)| c / DoubleDouble::from((i + 1) as f64));
        terms.fold(DoubleDouble::ZERO, |sum, term| sum + term)
    }

    /// `p(1) - p(0)`, without cancellation.
    pub(crate) fn rise(&self) -> DoubleDouble {
        self.0.iter().skip(1).fold(DoubleDouble::ZERO, |sum, &c| sum + c)
    }

    /// A range that holds every value over `[0, 1]`: exact up to degree 2, the hull of the Bernstein
    /// coefficients above.
    pub(crate) fn range(&self) -> (f64, f64) {
        let c = &self.0;
        let candidates = match c.len() {
            0 => vec![DoubleDouble::ZERO],
            1 => vec![c[0]],
            2 => vec![c[0], c[0] + c[1]],
            3 => {
                let mut points = vec![c[0], c[0] + c[1] + c[2]];
                let vertex = -c[1].value() / (2.0 * c[2].value());
                if vertex > 0.0 && vertex < 1.0 {
                    points.push(c[0] - c[1] * c[1] / (DoubleDouble::from(4.0) * c[2]));
                }
                points
            }
            _ => self.bernstein(),
        };
        let low = candidates.iter().copied().reduce(DoubleDouble::min).expect("not empty");
        let high = candidates.iter().copied().reduce(DoubleDouble::max).expect("not empty");
        (low.value(), high.value())
    }

    /// The Bernstein coefficients over `[0, 1]`:
    /// `b_i = sum over k <= i of binomial(i, k) / binomial(n, k) c_k`.
    fn bernstein(&self) -> Vec<DoubleDouble> {
        let n = self.0.len() - 1;
        let coefficient = |i: usize| {
            let mut sum = DoubleDouble::ZERO;
            let mut ratio = DoubleDouble::ONE;
            for k in 0..=i {
                sum = sum + ratio * self.0[k];
                ratio =
                    ratio * DoubleDouble::from((i - k) as f64) / DoubleDouble::from((n - k).max(1) as f64);
            }
            sum
        };
        (0..=n).map(coefficient).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{DoubleDouble, Polynomial};

    fn dd(x: f64) -> DoubleDouble {
        DoubleDouble::from(x)
    }

    #[test]
    fn substitution_expands_the_square_of_a_binomial() {
        let p = Polynomial::new(&[1.0, 0.0, 1.0]).substitute(dd(3.0), dd(2.0));
        assert_eq!(p.coefficients(), [10.0, 12.0, 4.0]);
    }

    #[test]
    fn the_derivative_undoes_the_antiderivative() {
        let p = Polynomial::new(&[3.0, -1.0, 5.0]);
        assert_eq!(p.antiderivative(dd(2.0), dd(7.0)).derivative(dd(2.0)), p);
        assert_eq!(Polynomial::new(&[4.0]).derivative(dd(1.0)).coefficients(), [0.0]);
    }

    #[test]
    fn mean_and_rise_are_those_over_the_unit_interval() {
        let p = Polynomial::new(&[1.0, 2.0, 3.0]);
        assert_eq!((p.mean().value(), p.rise().value(), p.at(dd(1.0)).value()), (3.0, 5.0, 6.0));
    }

    #[test]
    fn the_range_of_a_parabola_includes_its_vertex_only_inside() {
        assert_eq!(Polynomial::new(&[0.0, 1.0, -1.0]).range(), (0.0, 0.25));
        assert_eq!(Polynomial::new(&[0.0, 3.0, -1.0]).range(), (0.0, 2.0));
    }

    #[test]
    fn the_range_of_a_cubic_holds_its_values_and_is_not_vast() {
        let p = Polynomial::new(&[0.0, 1.0, -3.0, 2.0]);
        let (low, high) = p.range();
        assert_eq!((low, high), (-1.0 / 3.0, 1.0 / 3.0));
        for i in 0..=100 {
            let value = p.at(dd(f64::from(i) / 100.0)).value();
            assert!(low <= value && value <= high);
        }
    }
}
