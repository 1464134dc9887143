//! Means, variances and covariance of a function and its slope over the intervals of addresses.
//!
//! Over the whole domain, in the normalised abscissa `u`: `E(y u^k)` and `E(y^2)` solve the systems that
//! `y(L_j u) = s_j y(u) + q_j(u)` gives when the mean is taken part by part. Over the interval of an address
//! the function is `A y + P`, the address's maps composed: `var = A^2 var y + 2 A cov(y, P) + var P`. The
//! covariance of slope and value is computed as that of `A_f f + P_f` and `A_F F + P_F`, where
//! `E(f F) = (F(1)^2 - F(0)^2) / (2 length)`. In double-double numbers, since composed parts cancel.
//!
//! Source: M. F. Barnsley, "Fractal functions and interpolation", 1986 (moments); eq. 25-28 of Cochran, Lewis
//! and Hart (composition).

use crate::double_double::DoubleDouble;
use crate::fif::Fif;
use crate::polynomial::Polynomial;

/// What is known of a function and its slope over an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Mean slope.
    pub slope: f64,
    /// Mean value.
    pub value: f64,
    /// Variance of the slope.
    pub slope_variance: f64,
    /// Variance of the value.
    pub value_variance: f64,
    /// Covariance of the two.
    pub covariance: f64,
    /// The middle of the chord above the mean.
    pub lift: f64,
}

fn product(a: &Polynomial, b: &Polynomial) -> Polynomial {
    let mut c = vec![DoubleDouble::ZERO; a.0.len() + b.0.len() - 1];
    for (i, &x) in a.0.iter().enumerate() {
        for (k, &y) in b.0.iter().enumerate() {
            c[i + k] = c[i + k] + x * y;
        }
    }
    Polynomial(c)
}

/// `E(y u^k)` for `k` up to the degree asked for.
fn raw(fif: &Fif, degree: usize) -> Vec<DoubleDouble> {
    let length = fif.offset(fif.maps.len());
    let mut moments: Vec<DoubleDouble> = Vec::new();
    for k in 0..=degree {
        let (mut sum, mut rest) = (DoubleDouble::ZERO, DoubleDouble::ONE);
        for (j, q) in fif.unit_q().iter().enumerate() {
            let (x, a) = (fif.offset(j) / length, fif.width(j) / length);
            let mut power = vec![DoubleDouble::ZERO; k + 1];
            power[k] = DoubleDouble::ONE;
            let power = Polynomial(power).substitute(x, a);
            sum = sum + a * product(&power, q).mean();
            for (i, &m) in moments.iter().enumerate() {
                sum = sum + a * fif.scaling(j) * power.0[i] * m;
            }
            rest = rest - a * fif.scaling(j) * power.0[k];
        }
        moments.push(sum / rest);
    }
    moments
}

/// `E(y p)` for a polynomial `p`.
fn with(raw: &[DoubleDouble], p: &Polynomial) -> DoubleDouble {
    p.0.iter().zip(raw).fold(DoubleDouble::ZERO, |sum, (&c, &m)| sum + c * m)
}

/// `E(y^2)`.
fn square(fif: &Fif, raw: &[DoubleDouble]) -> DoubleDouble {
    let length = fif.offset(fif.maps.len());
    let (mut sum, mut rest) = (DoubleDouble::ZERO, DoubleDouble::ONE);
    for (j, q) in fif.unit_q().iter().enumerate() {
        let (a, s) = (fif.width(j) / length, fif.scaling(j));
        sum = sum + a * (product(q, q).mean() + DoubleDouble::from(2.0) * s * with(raw, q));
        rest = rest - a * s * s;
    }
    sum / rest
}

/// A function over the whole domain, its mean taken off where squares are meant.
struct Whole<'a> {
    fif: &'a Fif,
    raw: Vec<DoubleDouble>,
    variance: DoubleDouble,
}

impl<'a> Whole<'a> {
    fn new(fif: &'a Fif) -> Self {
        let degree = fif.unit_q().iter().map(|q| q.0.len()).max().unwrap_or(1) + 1;
        let raw = raw(fif, degree);
        let variance = square(fif, &raw) - raw[0] * raw[0];
        Self { fif, raw, variance }
    }

    /// `A` and `P` of an address.
    fn composed(&self, address: &[usize]) -> (DoubleDouble, Polynomial) {
        let length = self.fif.offset(self.fif.maps.len());
        let (mut scaling, mut p) = (DoubleDouble::ONE, Polynomial(vec![DoubleDouble::ZERO]));
        let (mut start, mut width) = (DoubleDouble::ZERO, DoubleDouble::ONE);
        for &j in address.iter().rev() {
            // y over j w is s (y over w) + q_j over the interval of w
            let (s, q) = (self.fif.scaling(j), self.fif.unit_q()[j].substitute(start, width));
            let terms = p.0.len().max(q.0.len());
            let at = |c: &Polynomial, i: usize| c.0.get(i).copied().unwrap_or(DoubleDouble::ZERO);
            p = Polynomial((0..terms).map(|i| s * at(&p, i) + at(&q, i)).collect());
            scaling = scaling * s;
            let (x, a) = (self.fif.offset(j) / length, self.fif.width(j) / length);
            (start, width) = (x + a * start, a * width);
        }
        (scaling, p)
    }

    /// Mean and variance of `A y + P`.
    fn law(&self, a: DoubleDouble, p: &Polynomial) -> (DoubleDouble, DoubleDouble) {
        let covariance = with(&self.raw, p) - self.raw[0] * p.mean();
        let own = product(p, p).mean() - p.mean() * p.mean();
        let variance = a * a * self.variance + DoubleDouble::from(2.0) * a * covariance + own;
        (a * self.raw[0] + p.mean(), variance)
    }
}

/// The function `value` and its slope over the interval of each of these addresses (the outermost map
/// first).
///
/// # Panics
/// Where the derivative is none, or a map does not exist.
pub fn stretches(value: &Fif, slope: &Fif, addresses: &[Vec<usize>]) -> Vec<Stretch> {
    let (big, small) = (Whole::new(value), Whole::new(slope));
    let length = value.offset(value.maps.len());
    let two = DoubleDouble::from(2.0);
    let ends = [value.first, value.last].map(DoubleDouble::from);
    let both = (ends[1] * ends[1] - ends[0] * ends[0]) / (two * length);
    let each = |address: &Vec<usize>| {
        let ((a, p), (alpha, r)) = (big.composed(address), small.composed(address));
        let ((mean, variance), (mean_slope, slope_variance)) = (big.law(a, &p), small.law(alpha, &r));
        let together =
            alpha * (a * both + with(&small.raw, &p)) + a * with(&big.raw, &r) + product(&r, &p).mean();
        let at = |u: DoubleDouble, y: DoubleDouble| a * y + p.at(u);
        let (left, right) = (at(DoubleDouble::ZERO, ends[0]), at(DoubleDouble::ONE, ends[1]));
        Stretch {
            slope: mean_slope.value(),
            value: mean.value(),
            slope_variance: slope_variance.value(),
            value_variance: variance.value(),
            covariance: (together - mean_slope * mean).value(),
            lift: ((left + right) / two - mean).value(),
        }
    };
    addresses.iter().map(each).collect()
}

#[cfg(test)]
mod tests {
    use super::stretches;
    use crate::fif::Fif;

    const KNOTS: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];

    /// The variance of `g` is 100/333, that of a straight line is the square of its rise over 12.
    #[test]
    fn variances_are_those_found_by_hand() {
        let g = Fif::interpolating(&KNOTS, &[0.85, -0.85]);
        let whole = stretches(&g.integral(0.0), &g, &[vec![]])[0];
        assert!((whole.slope_variance - 100.0 / 333.0).abs() < 1e-15, "{whole:?}");
        let line = Fif::interpolating(&[(0.0, 1.0), (1.0, 3.0), (2.0, 5.0)], &[0.5, 0.5]);
        let (value, part) = (line.integral(0.0), &[vec![1, 0]]);
        let part = stretches(&value, &line, part)[0];
        assert!((part.slope_variance - 1.0 / 12.0).abs() < 1e-15 && (part.slope - 3.5).abs() < 1e-15);
    }

    /// Against sums over the exact values at 2^16 places.
    #[test]
    fn moments_are_those_of_many_values() {
        let g = Fif::interpolating(&[(0.0, 0.0), (0.5, 0.75), (2.0, -0.25)], &[0.5, -0.75]);
        let value = g.integral(0.5);
        for (address, from, to) in
            [(vec![], 0.0, 2.0), (vec![1, 0], 0.5, 0.875), (vec![0, 1, 1], 0.21875, 0.5)]
        {
            let stretch = stretches(&value, &g, &[address])[0];
            let n = 1 << 14;
            let mut sums = [0.0; 5];
            for i in 0..n {
                let x = from + (to - from) * (f64::from(i) + 0.5) / f64::from(n);
                let (f, v) = (g.at(x), value.at(x));
                for (sum, term) in sums.iter_mut().zip([f, v, f * f, v * v, f * v]) {
                    *sum += term / f64::from(n);
                }
            }
            let [m, mean, ff, vv, fv] = sums;
            let found = [m, mean, ff - m * m, vv - mean * mean, fv - m * mean];
            let s = stretch;
            let exact = [s.slope, s.value, s.slope_variance, s.value_variance, s.covariance];
            for (a, b) in found.into_iter().zip(exact) {
                assert!((a - b).abs() < 2e-3, "{found:?} {exact:?}");
            }
            assert!((s.covariance - s.slope * s.lift).abs() < 1e-14, "{s:?}");
        }
    }
}
