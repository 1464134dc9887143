//! The fractal surface `h(x, y) = f(x) g(y)`, its normal and the mean of its normal over a rectangle.
//!
//! Source: Cochran, Lewis and Hart, "The Normal of a Fractal Surface", section 3.1, eq. 41-45. The mean of
//! the normal has a closed form, which the paper leaves as future work: the mean of `h_x = f'(x) g(y)` over
//! `[x0, x1] x [y0, y1]` is `(f(x1) - f(x0)) (G(y1) - G(y0)) / area`, with `G` the integral of `g`.

use crate::fif::Fif;
use crate::vector::Vector;

/// A differentiable profile with its derivative and its integral, all of them fractal interpolation
/// functions.
#[derive(Debug, Clone, PartialEq)]
pub struct Factor {
    /// The profile `f`.
    pub value: Fif,
    /// `f'`.
    pub slope: Fif,
    /// The integral of `f` from `x_0`, 0 there.
    pub integral: Fif,
}

impl Factor {
    /// The profile with the derivative `slope` and the value `first` at `x_0` (eq. 2 and 29).
    pub fn from_slope(slope: Fif, first: f64) -> Self {
        let value = slope.integral(first);
        let integral = value.integral(0.0);
        Self { value, slope, integral }
    }

    /// The profile `value`.
    ///
    /// # Errors
    /// When it has no derivative that is a fractal interpolation function, as [`Fif::derivative`] says.
    pub fn new(value: Fif) -> Result<Self, String> {
        let slope = value.derivative()?;
        let integral = value.integral(0.0);
        Ok(Self { value, slope, integral })
    }
}

/// The tensor product of two profiles (eq. 41).
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// `f`, a function of `x`.
    pub x: Factor,
    /// `g`, a function of `y`.
    pub y: Factor,
}

impl Surface {
    /// `h(x, y) = f(x) g(y)` (eq. 41).
    pub fn height(&self, x: f64, y: f64) -> f64 {
        self.x.value.at(x) * self.y.value.at(y)
    }

    /// `(h_x, h_y) = (f'(x) g(y), f(x) g'(y))` (eq. 42-43).
    pub fn partials(&self, x: f64, y: f64) -> (f64, f64) {
        (self.x.slope.at(x) * self.y.value.at(y), self.x.value.at(x) * self.y.slope.at(y))
    }

    /// The normal `(-h_x, -h_y, 1)`, not of unit length (eq. 45).
    pub fn normal(&self, x: f64, y: f64) -> Vector {
        let (h_x, h_y) = self.partials(x, y);
        [-h_x, -h_y, 1.0]
    }

    /// The mean of [`Surface::normal`] over the rectangle `[x0, x1] x [y0, y1]`.
    ///
    /// # Panics
    /// When the rectangle is empty or leaves the domain.
    pub fn mean_normal(&self, x0: f64, x1: f64, y0: f64, y1: f64) -> Vector {
        assert!(x0 < x1 && y0 < y1, "the rectangle is not empty");
        let area = (x1 - x0) * (y1 - y0);
        let rise = |f: &Fif, a: f64, b: f64| f.at(b) - f.at(a);
        let h_x = rise(&self.x.value, x0, x1) * rise(&self.y.integral, y0, y1) / area;
        let h_y = rise(&self.x.integral, x0, x1) * rise(&self.y.value, y0, y1) / area;
        [-h_x, -h_y, 1.0]
    }
}

#[cfg(test)]
mod tests {
    use super::{Factor, Surface};
    use crate::bounds::Bounds;
    use crate::fif::{Fif, Map};

    const KNOTS: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];

    fn surface() -> Surface {
        Surface {
            x: Factor::from_slope(Fif::interpolating(&KNOTS, &[0.5, 0.5]), 0.25),
            y: Factor::from_slope(Fif::interpolating(&KNOTS, &[0.85, -0.85]), 0.0),
        }
    }

    #[test]
    fn a_bilinear_surface_has_the_normal_of_the_schoolbook() {
        let line = |c0: f64, c1: f64| {
            Fif::from_polynomials(&[0.0, 4.0], vec![Map { vertical_scaling: 0.0, q: vec![c0, c1] }])
        };
        let factor = |c0, c1| Factor::new(line(c0, c1)).expect("smooth");
        let surface = Surface { x: factor(2.0, 1.0), y: factor(0.0, 3.0) };
        assert_eq!(surface.height(1.0, 2.0), 18.0);
        assert_eq!(surface.normal(1.0, 2.0), [-6.0, -9.0, 1.0]);
        assert_eq!(surface.mean_normal(0.0, 2.0, 1.0, 3.0), [-6.0, -9.0, 1.0]);
    }

    #[test]
    fn a_factor_from_its_value_is_the_factor_from_its_slope() {
        let factor = surface().y;
        let again = Factor::new(factor.value.clone()).expect("an integral");
        assert_eq!(again.integral, factor.integral);
        for i in 0..=64 {
            let x = f64::from(i) / 32.0;
            assert!((again.slope.at(x) - factor.slope.at(x)).abs() < 1e-14);
        }
        assert!(Factor::new(factor.slope).is_err());
    }

    #[test]
    fn partials_are_limits_of_differences() {
        let surface = surface();
        let (x, y, step) = (0.75, 1.25, libm::exp2(-20.0));
        let (h_x, h_y) = surface.partials(x, y);
        let along_x = (surface.height(x + step, y) - surface.height(x - step, y)) / (2.0 * step);
        let along_y = (surface.height(x, y + step) - surface.height(x, y - step)) / (2.0 * step);
        // The slope of g is Hölder with the exponent -log2 0.85 = 0.234: 2^(-20 * 0.234) is 0.04.
        assert!((h_x - along_x).abs() < 1e-4 && h_x.abs() > 0.1, "{h_x} {along_x}");
        assert!((h_y - along_y).abs() < 0.1 && h_y.abs() > 0.1, "{h_y} {along_y}");
    }

    #[test]
    fn the_mean_normal_is_the_mean_of_normals() {
        let surface = surface();
        let (x0, x1, y0, y1) = (0.25, 1.0, 0.5, 1.75);
        let closed = surface.mean_normal(x0, x1, y0, y1);
        // Multiples of irrational steps: on a dyadic grid the rough slope of g is far from its mean.
        let count = 4000.0;
        let mut sums = [0.0; 2];
        for k in 0..4000 {
            let part = |step: f64| f64::from(k) * step - libm::floor(f64::from(k) * step);
            let normal = surface.normal(
                x0 + (x1 - x0) * part(0.754_877_666_246_692_8),
                y0 + (y1 - y0) * part(0.569_840_290_998_053_3),
            );
            sums = [sums[0] + normal[0], sums[1] + normal[1]];
        }
        assert!((sums[0] / count - closed[0]).abs() < 1e-3, "{} {}", sums[0] / count, closed[0]);
        assert!((sums[1] / count - closed[1]).abs() < 5e-3, "{} {}", sums[1] / count, closed[1]);
        assert!(closed[0].abs() > 0.1 && closed[1].abs() > 0.1);
    }

    #[test]
    fn the_mean_normal_over_a_leaf_is_that_of_its_cells() {
        let surface = surface();
        let (x, y) = (Bounds::new(&surface.x.value, 5), Bounds::new(&surface.y.value, 5));
        for (f, g) in x.levels[5].iter().zip(y.levels[5].iter().rev()) {
            let mean = surface.mean_normal(f.x0, f.x1, g.x0, g.x1);
            assert!((mean[0] + f.slope * g.mean).abs() < 1e-12);
            assert!((mean[1] + f.mean * g.slope).abs() < 1e-12);
        }
    }
}
