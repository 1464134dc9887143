//! The integral and the derivative of a fractal interpolation function, which are fractal interpolation
//! functions again.
//!
//! Source: Cochran, Lewis and Hart, "The Normal of a Fractal Surface", section 3, eq. 29-36. In eq. 31 the
//! inner integral runs over the whole domain, `x_0` to `x_N`.
//!
//! In the normalised abscissa `u` the integral of `q_j` over `x` is the length of the domain times that over
//! `u`, and `a_j` times the length is the width of the interval of map `j`.

use crate::double_double::DoubleDouble;
use crate::fif::Fif;

/// Two maps join at a knot when their values there differ by no more than this, relative to the largest knot
/// or 1.
const JOIN: f64 = 1e-9;

impl Fif {
    /// `first + integral of f from x_0 to x` (eq. 29), with the same horizontal maps and vertical scalings
    /// `a_j alpha_j`.
    pub fn integral(&self, first: f64) -> Fif {
        let n = self.maps.len();
        let length = self.offset(n);
        let sum = |term: &dyn Fn(usize) -> DoubleDouble, until: usize| {
            (0..until).fold(DoubleDouble::ZERO, |sum, j| sum + term(j))
        };
        // a_j alpha_j, and a_j times the integral of q_j over the whole domain.
        let scaling = |j: usize| self.width(j) / length * self.scaling(j);
        let area = |j: usize| self.width(j) * self.unit_q()[j].mean();
        // Eq. 30: y^_N - y^_0. Eq. 31: y^_j - y^_0.
        let rise = sum(&area, n) / (DoubleDouble::ONE - sum(&scaling, n));
        let knot = |j: usize| sum(&|i| scaling(i) * rise + area(i), j);
        // Eq. 33; the integral of q_j starts at x_0, so its constant is the whole of y^_(j-1) - a_j alpha_j
        // y^_0.
        let first = DoubleDouble::from(first);
        let q = |j: usize| {
            let constant = first + knot(j) - scaling(j) * first;
            self.unit_q()[j].antiderivative(self.width(j), constant)
        };
        let scalings: Vec<f64> = (0..n).map(|j| scaling(j).value()).collect();
        Self::from_unit_polynomials(&self.knots_x, &scalings, (0..n).map(q).collect())
    }

    /// `f'`, with vertical scalings `alpha_j / a_j` and polynomials `q_j' / a_j` (eq. 34-36).
    ///
    /// # Errors
    /// When some `|alpha_j|` is not below `a_j`, or when the maps do not join at a knot: `f` is then no
    /// integral.
    pub fn derivative(&self) -> Result<Fif, String> {
        let n = self.maps.len();
        let length = self.offset(n);
        let mut scalings = Vec::with_capacity(n);
        for j in 0..n {
            let scaling = (self.scaling(j) * length / self.width(j)).value();
            if scaling.abs() >= 1.0 {
                let a = (self.width(j) / length).value();
                let alpha = self.maps[j].vertical_scaling;
                return Err(format!(
                    "map {j}: the vertical scaling {alpha} is not smaller than the horizontal {a}"
                ));
            }
            scalings.push(scaling);
        }
        let knots = self.knots();
        let size = knots.iter().fold(1.0, |size: f64, knot| size.max(knot.1.abs()));
        for (j, &(x, left)) in knots.iter().enumerate().take(n).skip(1) {
            let right =
                self.unit_q()[j].at(DoubleDouble::ZERO) + self.scaling(j) * DoubleDouble::from(self.first);
            let right = right.value();
            if (left - right).abs() > JOIN * size {
                return Err(format!("maps {} and {j} do not join: {left} and {right} at {x}", j - 1));
            }
        }
        let q = (0..n).map(|j| self.unit_q()[j].derivative(self.width(j))).collect();
        Ok(Self::from_unit_polynomials(&self.knots_x, &scalings, q))
    }
}

#[cfg(test)]
mod tests {
    use crate::fif::{Fif, Map};

    const KNOTS: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];

    fn assert_close(actual: &[f64], expected: &[f64]) {
        assert_eq!(actual.len(), expected.len());
        for (a, e) in actual.iter().zip(expected) {
            assert!((a - e).abs() < 1e-15, "{actual:?} is not {expected:?}");
        }
    }

    #[test]
    fn the_integral_of_f_is_that_of_equations_37_and_38() {
        let integral = Fif::interpolating(&KNOTS, &[0.5, 0.5]).integral(0.0);
        assert_eq!(integral.knots(), [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]);
        assert_eq!((integral.maps[0].vertical_scaling, integral.maps[1].vertical_scaling), (0.25, 0.25));
        assert_close(&integral.maps[0].q, &[0.0, 0.0, 0.125]);
        assert_close(&integral.maps[1].q, &[1.0, 0.5, -0.125]);
    }

    #[test]
    fn the_integral_of_g_is_that_of_equations_39_and_40() {
        let integral = Fif::interpolating(&KNOTS, &[0.85, -0.85]).integral(0.0);
        let y: Vec<f64> = integral.knots().iter().map(|knot| knot.1).collect();
        assert_close(&y, &[0.0, 37.0 / 40.0, 1.0]);
        assert_eq!((integral.maps[0].vertical_scaling, integral.maps[1].vertical_scaling), (0.425, -0.425));
        assert_close(&integral.maps[0].q, &[0.0, 0.0, 0.125]);
        assert_close(&integral.maps[1].q, &[37.0 / 40.0, 0.5, -0.125]);
    }

    #[test]
    fn the_integral_is_the_limit_of_sums_of_values() {
        // A midpoint sum over 4^k cells; f is Hölder, so it converges slowly, but it knows nothing of eq.
        // 29-33.
        let f = Fif::interpolating(&[(-1.0, 2.0), (0.0, -1.0), (3.0, 1.5)], &[0.3, -0.4]);
        let (cells, width) = (1 << 14, 4.0 / f64::from(1 << 14));
        let sum: f64 = (0..cells).map(|i| f.at(-1.0 + (f64::from(i) + 0.5) * width) * width).sum();
        let integral = f.integral(7.0);
        assert_eq!(integral.at(-1.0), 7.0);
        assert!((integral.at(3.0) - 7.0 - sum).abs() < 1e-4, "{} {sum}", integral.at(3.0) - 7.0);
        assert!(sum.abs() > 0.1);
    }

    #[test]
    fn the_derivative_undoes_the_integral_far_from_the_origin_too() {
        let f = Fif::interpolating(&[(1700.0, 1.0), (1777.0, -2.0), (2008.0, 3.0)], &[0.9, -0.6]);
        let back = f.integral(-4.0).derivative().expect("an integral has a derivative");
        for i in 0..=100 {
            let x = 1700.0 + 3.08 * f64::from(i);
            assert!((back.at(x) - f.at(x)).abs() < 1e-12, "{x}: {} {}", back.at(x), f.at(x));
        }
    }

    #[test]
    fn twice_integrated_polynomials_stay_polynomials() {
        let line = Fif::from_polynomials(&[0.0, 1.0], vec![Map { vertical_scaling: 0.0, q: vec![0.0, 6.0] }]);
        let cubic = line.integral(0.0).integral(1.0);
        assert!((cubic.at(0.5) - 1.125).abs() < 1e-15);
    }

    #[test]
    fn a_rough_function_and_a_broken_one_have_no_derivative() {
        let rough = Fif::interpolating(&KNOTS, &[0.5, 0.5]).derivative();
        assert!(rough.expect_err("too rough").contains("map 0"));
        let step = |c: f64| Map { vertical_scaling: 0.0, q: vec![c] };
        let broken = Fif::from_polynomials(&[0.0, 1.0, 2.0], vec![step(3.0), step(5.0)]).derivative();
        assert!(broken.expect_err("broken").contains("do not join"));
    }
}
