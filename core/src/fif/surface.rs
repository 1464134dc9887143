//! Tensor-product surfaces `h(x, y) = f(x) g(y)`, their exact normals and the mean normal over a footprint.
//!
//! `N = (-f'(x) g(y), -f(x) g'(y), 1)` (eq. 41-45). The mean of `h_x` over `[x0, x1] x [y0, y1]` is
//! `(f(x1) - f(x0)) (G(y1) - G(y0)) / area`, `G` the integral of `g`: one evaluation a corner instead of many samples.
//!
//! Source: Cochran, Lewis, Hart, section 3.1; the mean is left as future work there (section 6.1).

use super::function::Fif;
use super::polynomial::twice_high;
use super::value::FRACTION;
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
    /// The factor whose derivative is `slope` (the paper models a surface by its derivative, eq. 2), with the value `initial` at `x_0`.
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

    /// The height at `(x, y)`, saturated. Error: `|f| err(g) + |g| err(f)`, see [`Fif::error_bound_at_x`], and
    /// `2^-25` (row `Surface::height (f x g)`).
    pub fn height(&self, x: Wide, y: Wide) -> Real {
        product(self.f.value.evaluate(self.f.value.unit(x)), self.g.value.evaluate(self.g.value.unit(y)))
    }

    /// The partial derivatives `(h_x, h_y)` at `(x, y)` (eq. 42-43), saturated. Error: below `2^-18` for factors and slopes up to 8
    /// (row `Surface::partials (f x g)`).
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

    /// The mean of [`Surface::normal`] over `[x0, x1] x [y0, y1]`, in closed form. Parts outside the domain do not count; an empty interval
    /// counts as its point.
    pub fn mean_normal(&self, x: (Wide, Wide), y: (Wide, Wide)) -> Vec3 {
        let (df, f) = self.f.means(x.0, x.1);
        let (dg, g) = self.g.means(y.0, y.1);
        Vec3::new(product(df, g).saturating_neg(), product(f, dg).saturating_neg(), Real::ONE)
    }
}

/// `a b` of two values with 55 fractional bits, saturated.
fn product(a: i64, b: i64) -> Real {
    // 55 + 55 - 63 = 47 fractional bits, less than 2^15 * 2^47
    real_from(twice_high(a, b), FRACTION - 8)
}
