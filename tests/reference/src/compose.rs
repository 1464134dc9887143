//! Evaluation by composing maps: Algorithm 2 of Cochran, Lewis and Hart, "The Normal of a Fractal Surface",
//! section 2.1.
//!
//! The composite of the maps along the address of `x` is one map again,
//! `(x, y) -> (a x + b, alpha y + q(x))`, eq. 24-28. The algorithm stops on the horizontal factor `a`, so its
//! result is exact for *some* abscissa within `epsilon` times the domain's width of `x`. It does not bound
//! the error in `y` when `|alpha|` is large: 0.85^24 is still 0.02. In eq. 28 the inner powers are `x^(m-k)`,
//! as in the pseudo-code under it.

use crate::fif::Fif;

/// The longest composition; a single map never contracts horizontally.
const LEVELS: usize = 4000;

/// A composition of maps in the normalised abscissa `u`, `L(u) = a u + b` and
/// `F(u, y) = vertical_scaling y + q(u)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Composite {
    /// The horizontal factor (eq. 24).
    pub a: f64,
    /// The left end of the image, in `[0, 1]` (eq. 25).
    pub b: f64,
    /// The vertical factor (eq. 26).
    pub vertical_scaling: f64,
    /// The coefficients of the polynomial in `u`, constant first (eq. 27).
    pub q: Vec<f64>,
}

impl Composite {
    /// `L(x) = x, F(x, y) = y`.
    pub fn identity() -> Self {
        Self { a: 1.0, b: 0.0, vertical_scaling: 1.0, q: vec![0.0] }
    }

    /// `self` after `inner`: eq. 24-27.
    #[must_use]
    pub fn after(&self, inner: &Composite) -> Composite {
        let mut q = substitute(&self.q, inner.a, inner.b);
        q.resize(q.len().max(inner.q.len()), 0.0);
        for (sum, c) in q.iter_mut().zip(&inner.q) {
            *sum += self.vertical_scaling * c;
        }
        Composite {
            a: self.a * inner.a,
            b: self.a * inner.b + self.b,
            vertical_scaling: self.vertical_scaling * inner.vertical_scaling,
            q,
        }
    }

    /// The image of the point `(u, y)`.
    pub fn apply(&self, u: f64, y: f64) -> (f64, f64) {
        let q = self.q.iter().rev().fold(0.0, |sum, c| sum * u + c);
        (self.a * u + self.b, self.vertical_scaling * y + q)
    }
}

/// The coefficients of `q(a x + b)`: the pseudo-code under eq. 28.
fn substitute(q: &[f64], a: f64, b: f64) -> Vec<f64> {
    let power = |base: f64, exponent: usize| (0..exponent).fold(1.0, |product, _| product * base);
    let mut p = vec![0.0; q.len()];
    for (m, c) in q.iter().enumerate() {
        let mut binomial = 1.0;
        for k in 0..=m {
            p[m - k] += c * binomial * power(a, m - k) * power(b, k);
            binomial = binomial * (m - k) as f64 / (k + 1) as f64;
        }
    }
    p
}

impl Fif {
    /// Map `j` (from 0) in the normalised abscissa.
    pub fn composite(&self, j: usize) -> Composite {
        let length = self.offset(self.maps.len());
        Composite {
            a: (self.width(j) / length).value(),
            b: (self.offset(j) / length).value(),
            vertical_scaling: self.maps[j].vertical_scaling,
            q: self.unit_q()[j].coefficients(),
        }
    }

    /// The composite of the maps along the address of `x`, until `a <= epsilon` (the loop of Algorithm 2).
    ///
    /// # Panics
    /// When `x` is outside of the domain or `epsilon` is not positive.
    pub fn composition(&self, x: f64, epsilon: f64) -> Composite {
        let n = self.maps.len();
        assert!(self.knots_x[0] <= x && x <= self.knots_x[n], "{x} is outside the domain");
        assert!(epsilon > 0.0, "epsilon is positive");
        let u = (x - self.knots_x[0]) / self.offset(n).value();
        let maps: Vec<Composite> = (0..n).map(|j| self.composite(j)).collect();
        let mut w = Composite::identity();
        for _ in 0..LEVELS {
            let mut j = 0;
            while j < n - 1 && u > w.a * (maps[j].a + maps[j].b) + w.b {
                j += 1;
            }
            w = w.after(&maps[j]);
            if w.a <= epsilon {
                break;
            }
        }
        w
    }

    /// Algorithm 2: the image of the median knot under [`Fif::composition`].
    ///
    /// # Panics
    /// As [`Fif::composition`].
    pub fn at_composition(&self, x: f64, epsilon: f64) -> f64 {
        let n = self.maps.len();
        let (median_x, median_y) = self.knots()[n / 2];
        let u = (median_x - self.knots_x[0]) / self.offset(n).value();
        self.composition(x, epsilon).apply(u, median_y).1
    }
}

#[cfg(test)]
mod tests {
    use super::{Composite, substitute};
    use crate::fif::{Fif, Map};

    const KNOTS: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];

    #[test]
    fn equation_28_expands_a_cubic() {
        // (2x + 3)^3 - (2x + 3)
        assert_eq!(substitute(&[0.0, -1.0, 0.0, 1.0], 2.0, 3.0), [24.0, 52.0, 36.0, 8.0]);
    }

    #[test]
    fn composition_is_application_one_after_the_other() {
        let outer = Composite { a: 0.5, b: 0.25, vertical_scaling: -0.5, q: vec![1.0, 2.0, 4.0] };
        let inner = Composite { a: 0.25, b: 0.5, vertical_scaling: 0.75, q: vec![3.0, 1.0] };
        let (u, y) = inner.apply(0.5, 8.0);
        assert_eq!(outer.after(&inner).apply(0.5, 8.0), outer.apply(u, y));
        assert_eq!(Composite::identity().after(&inner).apply(0.5, 8.0), (u, y));
    }

    #[test]
    fn algorithm_2_is_exact_at_the_abscissa_that_it_reaches() {
        let g = Fif::interpolating(&KNOTS, &[0.85, -0.85]).integral(0.0);
        for i in 0..=200 {
            let x = f64::from(i) / 100.0;
            let epsilon = libm::exp2(-20.0);
            let (u, y) = g.composition(x, epsilon).apply(0.5, g.knots()[1].1);
            assert!((2.0 * u - x).abs() <= 2.0 * epsilon);
            assert!((g.at(2.0 * u) - y).abs() < 1e-13, "{x}");
            assert_eq!(g.at_composition(x, epsilon), y);
            assert!((g.at(x) - y).abs() < 1e-5);
        }
    }

    #[test]
    fn a_small_epsilon_does_not_bound_the_error_of_a_rough_function() {
        let g = Fif::interpolating(&KNOTS, &[0.85, -0.85]);
        let error = |x: f64| (g.at_composition(x, libm::exp2(-24.0)) - g.at(x)).abs();
        let worst = (0..1000).map(|i| error(f64::from(i) / 500.0)).fold(0.0, f64::max);
        assert!(worst > 1e-3 && worst < 0.1, "{worst}");
    }

    #[test]
    fn a_single_map_ends_at_the_level_limit() {
        let one =
            Fif::from_polynomials(&[0.0, 2.0], vec![Map { vertical_scaling: 0.75, q: vec![1.0, 0.0, 0.5] }]);
        // The median knot of a single map is its first.
        assert!((one.at_composition(1.0, 1e-6) - one.at(0.0)).abs() < 1e-14);
    }
}
