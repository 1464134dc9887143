//! The variance of a function over its cells, and its covariance with the powers of the abscissa, by which
//! the variance goes from a cell to its parts.
//!
//! With `t` from 0 to 1 along a cell, `y(t)` over the cell `w` and the map `s y + p(t)` that makes the part
//! `j w` (`p` the map's polynomial over the interval of `w`), all of it central, so that nothing cancels:
//! - `cov(y, t^k)' = s cov(y, t^k) + cov(p, t^k)`,
//!   `cov(t^i, t^k) = i k / ((i + 1) (k + 1) (i + k + 1))`;
//! - `var(y)' = s^2 var(y) + 2 s sum p_k cov(y, t^k) + sum p_k cov(p, t^k)`.
//!
//! Over the whole domain the raw moments solve the same system, weighted by the widths `a_j`: with
//! `(x_j + a_j t)^k = sum B_i t^i`,
//! `E(y t^k) (1 - sum s_j a_j^(k + 1)) = sum a_j (E(q_j B) + s_j sum B_i E(y t^i), i < k)` and
//! `E(y^2) (1 - sum a_j s_j^2) = sum a_j (2 s_j E(q_j y) + E(q_j^2))`.
//!
//! Formats: values 55 fractional bits, their products 46.

use super::function::Fif;
use super::polynomial::{Polynomial, product_q55, twice_high};
use super::value::{FRACTION_Q55, ONE_UQ63};
use crate::num::{mul_high, nth, quotient};

/// Fractional bits of products of two values.
pub(super) const FRACTION_OF_SQUARES: u32 = 2 * FRACTION_Q55 - 64;

/// A function over one of its cells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Variance<const D: usize> {
    /// `var(y)`, 46 fractional bits.
    pub(super) variance: i64,
    /// `cov(y, t^k)` for `k` from 1, 55 fractional bits.
    powers: [i64; D],
}

/// `cov(p, t^k)` for `k` from 1.
fn with_powers<const D: usize>(p: &Polynomial<D>) -> [i64; D] {
    let mut sums = [0; D];
    for (k, sum) in (1..).zip(&mut sums) {
        for (i, c) in (1..).zip(p.powers) {
            // of magnitude below a twelfth of the coefficient
            *sum += nth(c, (i + 1) * (k + 1) * (i + k + 1)) * i64::from(i * k);
        }
    }
    sums
}

/// `E(p t^k)`, 55 fractional bits.
fn moment<const D: usize>(p: &Polynomial<D>, k: u32) -> i64 {
    let terms = [p.constant].into_iter().chain(p.powers).zip(k + 1..);
    terms.fold(0_i64, |sum, (c, n)| sum.wrapping_add(nth(c, n)))
}

impl<const D: usize> Variance<D> {
    pub(super) const ZERO: Self = Self { variance: 0, powers: [0; D] };

    /// Over the part that the map `scaling y + p` makes of this cell.
    pub(super) fn part(&self, scaling: i64, p: &Polynomial<D>) -> Self {
        let mut powers = with_powers(p);
        let mut variance = twice_high(twice_high(self.variance, scaling), scaling);
        for ((to, own), c) in powers.iter_mut().zip(self.powers).zip(p.powers) {
            let scaled = twice_high(own, scaling);
            variance = variance.wrapping_add(mul_high(c, to.wrapping_add(2 * scaled)));
            *to = to.wrapping_add(scaled);
        }
        // what is rounded down may leave a flat part a few units below 0
        Self { variance: variance.max(0), powers }
    }

    /// Over the whole domain.
    pub(super) fn of<const N: usize>(fif: &Fif<N, D>) -> Self {
        let mean = fif.mean();
        let mut raw = [0; D];
        let times = |a: i64, b: i64| mul_high(a, b) << (FRACTION_Q55 - FRACTION_OF_SQUARES);
        for k in 0..D {
            let mut power = Polynomial::<D>::ZERO;
            if let Some(c) = power.powers.get_mut(k) {
                *c = 1 << FRACTION_Q55;
            }
            let (mut sum, mut rest) = (0_i64, ONE_UQ63);
            for map in &fif.maps {
                let b = power.part(map.start, map.width);
                let coefficients = || [b.constant].into_iter().chain(b.powers);
                let of_q = coefficients().zip(0..).map(|(c, i)| times(c, moment(&map.q, i)));
                let lower = [mean].into_iter().chain(raw).take(k + 1);
                let of_y = coefficients().zip(lower).map(|(c, m)| times(c, m));
                let of_y = twice_high(of_y.fold(0, i64::wrapping_add), map.scaling);
                sum = sum.wrapping_add(product_q55(of_q.fold(of_y, i64::wrapping_add), map.width));
                let ratio = (0..k + 2).fold(map.scaling, |ratio, _| product_q55(ratio, map.width));
                rest = rest.wrapping_sub(ratio as u64);
            }
            if let Some(to) = raw.get_mut(k) {
                *to = quotient(sum, 63, rest);
            }
        }
        let (mut sum, mut rest) = (0_i64, ONE_UQ63);
        for map in &fif.maps {
            let coefficients = || [map.q.constant].into_iter().chain(map.q.powers);
            let with_y = coefficients().zip([mean].into_iter().chain(raw)).map(|(c, m)| mul_high(c, m));
            let with_y = twice_high(with_y.fold(0, i64::wrapping_add), map.scaling);
            let own = coefficients().zip(0..).map(|(c, i)| mul_high(c, moment(&map.q, i)));
            let term = own.fold(with_y.wrapping_add(with_y), i64::wrapping_add);
            sum = sum.wrapping_add(product_q55(term, map.width));
            let square = twice_high(map.scaling, map.scaling);
            rest = rest.wrapping_sub(product_q55(square, map.width) as u64);
        }
        let variance = quotient(sum, 63, rest).wrapping_sub(mul_high(mean, mean)).max(0);
        let mut powers = raw;
        for (n, to) in (2..).zip(&mut powers) {
            *to = to.wrapping_sub(nth(mean, n));
        }
        Self { variance, powers }
    }
}
