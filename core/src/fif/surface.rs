//! Tensor-product surfaces `h(x, y) = f(x) g(y)`, their exact normals and the mean normal over a footprint.
//!
//! `N = (-f'(x) g(y), -f(x) g'(y), 1)` (eq. 41-45). The mean of `h_x` over `[x0, x1] x [y0, y1]` is
//! `(f(x1) - f(x0)) (G(y1) - G(y0)) / area`, `G` the integral of `g`: one evaluation a corner instead of many
//! samples.
//!
//! Its normal is fractal in its own right: above a line along an axis both slopes are multiples of a fractal
//! interpolation function. Those over one partition with the same vertical scalings are a space, as knots and
//! polynomials are added and multiplied, so that surfaces which share a factor have sums and multiples among
//! themselves, with the sums and multiples of their normals
//! (`normals_of_surfaces_that_share_a_factor_are_a_space` in the tests, to the last bit). The sum of products
//! without a common factor is a height field with the sum of their normals, but no product.
//!
//! Source: Cochran, Lewis, Hart, section 3.1; the mean is left as future work there (section 6.1).

use super::function::Fif;
use super::polynomial::twice_high;
use super::value::FRACTION_Q55;
use crate::Error;
use crate::num::{Real, Vec3, Wide, quotient, real_from};

/// One factor of a tensor product: a differentiable function with its derivative and its integral.
///
/// `D` must be at least the degree of the function plus 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Factor<const N: usize, const D: usize> {
    value: Fif<N, D>,
    slope: Fif<N, D>,
    integral: Fif<N, D>,
}

impl<const N: usize, const D: usize> Factor<N, D> {
    /// The factor whose derivative is `slope` (the paper models a surface by its derivative, eq. 2), with the
    /// value `initial` at `x_0`.
    ///
    /// # Errors
    /// Those of [`Fif::integral`].
    pub fn from_slope<const S: usize>(slope: &Fif<N, S>, initial: Wide) -> Result<Self, Error> {
        Self::new(&slope.integral::<D>(initial)?)
    }

    /// The factor with the values of `value`.
    ///
    /// # Errors
    /// Those of [`Fif::derivative`] and [`Fif::integral`].
    pub fn new<const V: usize>(value: &Fif<N, V>) -> Result<Self, Error> {
        let integral = value.integral::<D>(Wide::ZERO)?;
        Ok(Self { slope: value.derivative()?, value: integral.derivative()?, integral })
    }

    /// The function itself.
    pub const fn value(&self) -> &Fif<N, D> {
        &self.value
    }

    /// Its derivative.
    pub const fn slope(&self) -> &Fif<N, D> {
        &self.slope
    }

    /// Its integral from `x_0`.
    pub const fn integral(&self) -> &Fif<N, D> {
        &self.integral
    }

    /// Mean slope and mean value over `[a, b]`, 55 fractional bits; those at `a` where the interval is empty.
    fn means(&self, a: Wide, b: Wide) -> (i64, i64) {
        let (a, b) = (a.min(b), a.max(b));
        let (low, high) = self.value.domain();
        let (a, b) = (a.max(low).min(high), b.max(low).min(high));
        let (u, v) = (self.value.unit(a), self.value.unit(b));
        let length = b.to_bits().wrapping_sub(a.to_bits()) as u64; // a <= b: exact
        if length == 0 {
            return (self.slope.evaluate(u), self.value.evaluate(u));
        }
        let mean = |f: &Fif<N, D>| {
            // values stay below 2^62
            quotient(f.evaluate(v).wrapping_sub(f.evaluate(u)), 48, length)
        };
        (mean(&self.value), mean(&self.integral))
    }
}

/// The surface `h(x, y) = f(x) g(y)`.
#[derive(Debug, Clone, Copy)]
pub struct Surface<'a, const N: usize, const D: usize, const M: usize, const E: usize> {
    f: &'a Factor<N, D>,
    g: &'a Factor<M, E>,
}

impl<'a, const N: usize, const D: usize, const M: usize, const E: usize> Surface<'a, N, D, M, E> {
    /// The tensor product of `f` along x and `g` along y.
    pub const fn new(f: &'a Factor<N, D>, g: &'a Factor<M, E>) -> Self {
        Self { f, g }
    }

    /// The height at `(x, y)`, saturated. Error: `|f| err(g) + |g| err(f)`, see [`Fif::error_bound_at_x`],
    /// and `2^-25` (row `Surface::height (f x g)`).
    pub fn height(&self, x: Wide, y: Wide) -> Real {
        product(self.f.value.evaluate(self.f.value.unit(x)), self.g.value.evaluate(self.g.value.unit(y)))
    }

    /// The partial derivatives `(h_x, h_y)` at `(x, y)` (eq. 42-43), saturated. Error: below `2^-18` for
    /// factors and slopes up to 8 (row `Surface::partials (f x g)`).
    pub fn partials(&self, x: Wide, y: Wide) -> (Real, Real) {
        let (u, v) = (self.f.value.unit(x), self.g.value.unit(y));
        let (f, df) = (self.f.value.evaluate(u), self.f.slope.evaluate(u));
        let (g, dg) = (self.g.value.evaluate(v), self.g.slope.evaluate(v));
        (product(df, g), product(f, dg))
    }

    /// The normal `(-h_x, -h_y, 1)` at `(x, y)` (eq. 44-45), not of unit length.
    pub fn normal(&self, x: Wide, y: Wide) -> Vec3 {
        let (hx, hy) = self.partials(x, y);
        Vec3::new(hx.saturating_neg(), hy.saturating_neg(), Real::ONE)
    }

    /// The mean of [`Surface::normal`] over `[x0, x1] x [y0, y1]`, in closed form. Parts outside the domain
    /// do not count; an empty interval counts as its point.
    pub fn mean_normal(&self, x: (Wide, Wide), y: (Wide, Wide)) -> Vec3 {
        let (df, f) = self.f.means(x.0, x.1);
        let (dg, g) = self.g.means(y.0, y.1);
        Vec3::new(product(df, g).saturating_neg(), product(f, dg).saturating_neg(), Real::ONE)
    }
}

/// `a b` of two values with 55 fractional bits, saturated.
fn product(a: i64, b: i64) -> Real {
    // 55 + 55 - 63 = 47 fractional bits, less than 2^15 * 2^47
    real_from(twice_high(a, b), FRACTION_Q55 - 8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Scaling;

    /// `c x^power` over `[low, high]` with two parts, from `f(L(x)) = c L(x)^power`.
    fn monomial(low: i32, high: i32, power: i32, factor: f64) -> Factor<2, 4> {
        let ends = [low, (low + high) / 2, high];
        let q = |start: i32| {
            // L(x) = start + (x - low) / 2
            let c = f64::from(start) - f64::from(low) / 2.0;
            let powers: [f64; 4] = match power {
                1 => [c, 0.5, 0.0, 0.0],
                2 => [c * c, c, 0.25, 0.0],
                _ => [c * c * c, 1.5 * c * c, 0.75 * c, 0.125],
            };
            powers.map(|p| Wide::from_num(p * factor))
        };
        let (left, right) = (q(ends[0]), q(ends[1]));
        let f =
            Fif::<2, 3>::from_polynomials(&ends.map(Wide::from_num), &[Scaling::ZERO; 2], &[&left, &right]);
        Factor::new(&f.unwrap()).unwrap()
    }

    /// The nearest number to `numerator / denominator`, ties and `2^-40` beside them either way.
    fn nearest(got: Real, numerator: i64, denominator: i64) -> bool {
        let (n, d) = (i128::from(numerator), i128::from(denominator));
        let off = 2 * (i128::from(got.to_bits()) * d - (n << 24));
        off.abs() <= d.abs() + (d.abs() >> 16) + 1
    }

    /// `x^2 y^3`: height, slopes and normal at sixteenths.
    #[test]
    fn a_product_of_powers_has_the_slopes_of_the_textbooks() {
        let (f, g) = (monomial(-1, 3, 2, 1.0), monomial(0, 2, 3, 0.5));
        let h = Surface::new(&f, &g);
        let wide = |n: i64| Wide::from_num(n) / 16;
        for i in -16..=48_i64 {
            for j in 0..=32_i64 {
                let (x, y) = (wide(i), wide(j));
                let sixteenths = |k: u32| 16_i64.pow(k);
                assert!(nearest(h.height(x, y), i * i * j * j * j, 2 * sixteenths(5)), "{x} {y}");
                let (dx, dy) = h.partials(x, y);
                assert!(nearest(dx, 2 * i * j * j * j, 2 * sixteenths(4)), "{x} {y}: {dx}");
                assert!(nearest(dy, 3 * i * i * j * j, 2 * sixteenths(4)), "{x} {y}: {dy}");
                assert_eq!(h.normal(x, y), Vec3::new(-dx, -dy, Real::ONE));
            }
        }
    }

    /// `(x1^2 - x0^2) / (x1 - x0) = x0 + x1` times the mean `(y1^4 - y0^4) / (8 (y1 - y0))`, and so on.
    #[test]
    fn a_mean_normal_is_the_closed_form() {
        let (f, g) = (monomial(-1, 3, 2, 1.0), monomial(0, 2, 3, 0.5));
        let h = Surface::new(&f, &g);
        let wide = |n: i64| Wide::from_num(n) / 8;
        for (x0, x1) in [(-8, 24), (-3, 1), (5, 6), (0, 17), (7, 7), (24, 24), (-8, -8)] {
            for (y0, y1) in [(0, 16), (3, 4), (1, 15), (9, 9), (16, 16)] {
                let cubes = (y1 + y0) * (y1 * y1 + y0 * y0);
                let squares = x1 * x1 + x1 * x0 + x0 * x0;
                let expected = [
                    // mean slope of f: eighths; mean of g: 8 of 8^3
                    (-(x0 + x1) * cubes, 8 * 8 * 512),
                    // mean of f: thirds of 8^2; mean slope of g: halves of 8^2
                    (-squares * (y1 * y1 + y1 * y0 + y0 * y0), 3 * 64 * 2 * 64),
                ];
                let one = h.mean_normal((wide(x0), wide(x1)), (wide(y0), wide(y1)));
                let turned = h.mean_normal((wide(x1), wide(x0)), (wide(y1), wide(y0)));
                assert_eq!(one, turned);
                assert_eq!(one.z, Real::ONE);
                for (got, (numerator, denominator)) in [one.x, one.y].into_iter().zip(expected) {
                    assert!(nearest(got, numerator, denominator), "{x0} {x1} {y0} {y1}: {got}");
                }
            }
        }
        // what lies outside does not count
        let all = h.mean_normal((wide(-8), wide(24)), (wide(0), wide(16)));
        assert_eq!(h.mean_normal((Wide::MIN, Wide::MAX), (wide(-3), wide(99))), all);
        let corner = h.mean_normal((wide(24), wide(24)), (wide(0), wide(0)));
        assert_eq!(h.mean_normal((wide(25), Wide::MAX), (Wide::MIN, wide(-1))), corner);
    }

    #[test]
    fn a_factor_from_its_slope_has_that_slope() {
        let slope = monomial(-1, 3, 2, 3.0);
        let factor = Factor::<2, 4>::from_slope(slope.value(), Wide::from_num(-1)).unwrap();
        for i in -16..=48_i64 {
            let x = Wide::from_num(i) / 16;
            assert!(
                (factor.value().at_wide(x) - Wide::from_bits(i.pow(3) << 36)).abs() <= 8 * Wide::DELTA,
                "{x}"
            );
            assert!((factor.slope().at_wide(x) - slope.value().at_wide(x)).abs() <= 8 * Wide::DELTA, "{x}");
            // (x^4 - 1) / 4 from -1 on
            let exact = Wide::from_bits((i.pow(4) - 65_536) << 30);
            assert!((factor.integral().at_wide(x) - exact).abs() <= 8 * Wide::DELTA, "{x}");
        }
    }

    #[test]
    fn products_are_rounded_to_nearest_and_saturate() {
        for (a, b) in [(100, 100), (-100, 100), (11, 11), (11, 12), (-127, 1), (12, -12)] {
            let got = product(i64::from(a) << 55, i64::from(b) << 55);
            assert_eq!(got, Real::saturating_from_num(a * b), "{a} {b}");
        }
        for k in 0..2000_i64 {
            let (a, b) = (
                k.wrapping_mul(0x2545_f491_4f6c_dd1d) >> (3 + k % 7),
                k.wrapping_mul(0x1f12_3bb5_159a_55e5) >> 5,
            );
            let exact = i128::from(a) * i128::from(b); // 110 fractional bits
            let limits = (i128::from(i32::MIN) << 86, i128::from(i32::MAX) << 86);
            let off = (exact.clamp(limits.0, limits.1) - (i128::from(product(a, b).to_bits()) << 86)).abs();
            // half a unit, and two of 2^-47
            assert!(off <= (1 << 85) + (2 << 63), "{a} {b}");
        }
    }
}
