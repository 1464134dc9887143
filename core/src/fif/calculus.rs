//! Integral and derivative: both are fractal interpolation functions over the same knots.
//!
//! Integral (eq. 29-33, with the erratum that the inner integral of eq. 31 runs over the whole domain), in the unit abscissa and with
//! `w = x_N - x_0`: `F(L_j u) = a_j alpha_j F(u) + Y_(j-1) - a_j alpha_j Y_0 + w a_j (integral of q_j from 0 to u)`.
//! Derivative (eq. 34-36): scalings `alpha_j / a_j`, polynomials `q_j' / (w a_j)`.
//!
//! Source: Cochran, Lewis, Hart, section 3; M. F. Barnsley, A. N. Harrington, "The calculus of fractal interpolation functions", 1989.

use heapless::Vec;

use super::function::{Fif, POWERS};
use super::map::Map;
use super::polynomial::{Polynomial, times, twice_high};
use super::value::{ONE, in_range, value};
use crate::Error;
use crate::num::{Wide, mul_high_u, nth, quotient};

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The function `initial + integral of f from x_0 to x`, with room for polynomials of degree `E`.
    ///
    /// Error: at a knot at most a unit, `2^-48`, beyond the integral of
    /// the error of `f` itself (`an_integral_is_within_its_bound`). Repeatable.
    ///
    /// # Errors
    /// [`Error::Capacity`] if `E` is not above the degree of `f`; [`Error::OutOfRange`] if the integral leaves the format.
    pub fn integral<const E: usize>(&self, initial: Wide) -> Result<Fif<N, E>, Error> {
        let degree = self.degree() + 1;
        if degree > E {
            return Err(Error::Capacity { what: POWERS, needed: degree, capacity: E });
        }
        in_range("initial value", None, initial)?;
        let start = value(initial);
        // eq. 30: the whole integral is w (sum of a_n mean(q_n)) / (1 - sum of a_n alpha_n)
        let total = self.times_width(self.mean());
        inside(total)?;
        let mut maps = Vec::new();
        let mut knot = start; // Y_(j-1)
        for map in &self.maps {
            let scaling = times(map.scaling, map.width);
            let mut q = Polynomial::<E>::ZERO;
            q.constant = knot.wrapping_sub(twice_high(start, scaling));
            let integrated = [map.q.constant].into_iter().chain(map.q.powers).zip(1..);
            for (to, (c, n)) in q.powers.iter_mut().zip(integrated) {
                *to = self.times_width(times(nth(c, n), map.width));
                inside(*to)?;
            }
            let step = q.powers.iter().fold(0_i64, |sum, c| sum.wrapping_add(*c));
            knot = knot.saturating_add(step).saturating_add(twice_high(total, scaling));
            let map = Map { scaling, q, start: map.start, width: map.width, per_width: map.per_width };
            // as many as those of the function: never full
            let _ = maps.push(map);
        }
        Fif::from_maps(maps, self.x0, self.width, self.per_width)
    }

    /// The derivative, a function of its own kind where every map is less steep than narrow.
    ///
    /// # Errors
    /// [`Error::NotDifferentiable`] if `|alpha_j| >= a_j`, [`Error::NotJoined`] if the maps of the derivative disagree at a knot by more than
    /// `2^-22`, [`Error::OutOfRange`] if it leaves the format, [`Error::Capacity`] if its degree is above `E`.
    pub fn derivative<const E: usize>(&self) -> Result<Fif<N, E>, Error> {
        let degree = self.degree().saturating_sub(1);
        if degree > E {
            return Err(Error::Capacity { what: POWERS, needed: degree, capacity: E });
        }
        let mut maps = Vec::new();
        for (index, map) in self.maps.iter().enumerate() {
            if map.scaling.unsigned_abs() >= map.width {
                return Err(Error::NotDifferentiable { map: index });
            }
            let scaling = quotient(map.scaling, 63, map.width);
            // 1 / (w a_j); w a_j with 48 fractional bits
            let length = mul_high_u(self.width, map.width) << 1;
            let per_length = |c: i64| quotient(c, 48, length);
            let slope = map.q.derivative();
            let mut q = Polynomial::<E>::ZERO;
            q.constant = per_length(slope.constant);
            for (to, c) in q.powers.iter_mut().zip(slope.powers) {
                *to = per_length(c);
            }
            let map = Map { scaling, q, start: map.start, width: map.width, per_width: map.per_width };
            let _ = maps.push(map); // as in the integral
        }
        Fif::from_maps(maps, self.x0, self.width, self.per_width)?.joined()
    }

    /// The mean value over the domain, `sum of a_n mean(q_n) / (1 - sum of a_n alpha_n)`, 55 fractional bits.
    #[inline(never)]
    pub(crate) fn mean(&self) -> i64 {
        let mut sum = 0_i64;
        let mut rest = ONE; // stays inside (0, 2): |sum of a_n alpha_n| < 1
        for map in &self.maps {
            sum = sum.saturating_add(times(map.q.mean(), map.width));
            rest = rest.wrapping_sub(times(map.scaling, map.width) as u64);
        }
        quotient(sum, 63, rest)
    }

    /// `value * (x_N - x_0)`, saturated.
    #[inline(never)]
    fn times_width(&self, v: i64) -> i64 {
        let high = mul_high_u(v as u64, self.width).wrapping_sub(if v < 0 { self.width } else { 0 }) as i64;
        let low = (v as u64).wrapping_mul(self.width);
        if high >> 47 == high >> 63 {
            return high << 16 | (low >> 48) as i64;
        }
        (v >> 63) ^ i64::MAX
    }
}

/// Whether an integral has kept inside its format, and is not saturated.
fn inside(v: i64) -> Result<(), Error> {
    if v != (v >> 63) ^ i64::MAX {
        return Ok(());
    }
    let (min, max) = (Wide::from_num(-128), Wide::from_num(128));
    Err(Error::OutOfRange { what: "integral", index: None, value: Wide::from_bits(v), min, max })
}
