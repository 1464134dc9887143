//! The value at an abscissa, by a forward walk along its address.
//!
//! `f(x) = q_j1(u_1) + alpha_j1 q_j2(u_2) + alpha_j1 alpha_j2 q_j3(u_3) + ...`, `u_k` the `k`-th pre-image of `x`. The walk ends exactly where a pre-image is
//! an end of the domain (after finitely many maps for a dyadic abscissa on a dyadic partition), or when the product of the horizontal factors
//! is below `2^-62` (then the value is exact at an abscissa no further away than that), or when that of the scalings is below `2^-40`.
//!
//! Source: Cochran, Lewis, Hart, eq. 17.

use super::Fif;
use super::function::Map;
use crate::num::{FRACTION, ONE, Real, Wide, mul_high, mul_high_u, ratio, real_from};

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The value at `x`.
    ///
    /// Domain: abscissae outside count as the nearer end. Error: at most [`Fif::error_bound`] on a dyadic partition; elsewhere at most that at an
    /// abscissa no further than `2^-40` from `x` (tests/accuracy.rs). Cost: some 180 Cortex-M4 instructions a level, at most 63 levels for
    /// two equal maps; [`super::Dyadic`] takes 13 a level where the partition is dyadic.
    pub fn at(&self, x: Wide) -> Real {
        real_from(self.evaluate(self.unit(x)), FRACTION)
    }

    /// The value at `x` with 48 fractional bits, for values that are to be subtracted or multiplied.
    ///
    /// Error: that of [`Fif::error_bound`] less the final rounding to [`Real`].
    pub fn at_wide(&self, x: Wide) -> Wide {
        super::function::wide(self.evaluate(self.unit(x)))
    }

    /// A bound on the error of [`Fif::at`]: `2^-32 max|f| / (1 - max|alpha|)` for scalings rounded to 31 bits, and `2^-25` for the result's rounding,
    /// with all smaller terms, rounded up.
    pub fn error_bound(&self) -> Real {
        let steepest = self.maps.iter().map(|m| m.scaling.unsigned_abs()).max().unwrap_or(0);
        let rest = ((ONE - steepest) >> 32).max(1);
        let largest = self.range.0.unsigned_abs().max(self.range.1.unsigned_abs());
        // with 55 fractional bits: scalings 2^-32 max|f|, and 2^-47 for products and coefficients a level
        let per_level = (largest >> 32) + (1 << (FRACTION - 47));
        let sum = ratio(per_level, 31, rest);
        let total = sum.saturating_add(1 << (FRACTION - 25)).saturating_add(1 << (FRACTION - 30));
        let bits = (total >> (FRACTION - 24)) + u64::from(total.trailing_zeros() < FRACTION - 24);
        Real::from_bits(bits.min(i32::MAX as u64) as i32)
    }

    /// The value at a unit abscissa with 63 fractional bits, with 55 fractional bits.
    pub(crate) fn evaluate(&self, unit: u64) -> i64 {
        let unit = unit.min(ONE);
        let mut u = unit;
        let mut sum = 0_i64;
        let mut scaling = 1_i64 << 62; // product of the scalings, 62 fractional bits
        let mut halvings = 0; // the product of the horizontal factors is at least 2^-halvings
        // only the right end itself is 1: pre-images of what lies before it do too
        let levels = if u == ONE { 0 } else { self.levels };
        for level in 0..levels {
            if u == 0 || scaling.unsigned_abs() < 1 << 22 || halvings > 63 && self.vanishes(unit, level) {
                break;
            }
            let Some(map) = self.map_at(u) else { break };
            u = map.per_width.quotient(u - map.start);
            sum = sum.wrapping_add(mul_high(scaling, map.q.at(u)) << 2);
            scaling = mul_high(scaling, map.scaling) << 1;
            halvings += map.per_width.halvings();
        }
        let end = if u < ONE / 2 { self.first } else { self.last };
        sum.wrapping_add(mul_high(scaling, end) << 2)
    }

    /// Whether the product of the first horizontal factors, with 63 fractional bits, is 0.
    #[inline(never)]
    fn vanishes(&self, mut u: u64, factors: u32) -> bool {
        let mut width = ONE;
        for _ in 0..factors {
            let Some(map) = self.map_at(u) else { break };
            u = map.per_width.quotient(u - map.start);
            width = mul_high_u(width, map.width << 1);
        }
        width == 0
    }

    /// The last map that starts at or before `u`.
    #[inline(always)]
    fn map_at(&self, u: u64) -> Option<&Map<D>> {
        let mut index = self.starts.partition_point(|start| *start <= (u >> 32) as u32).checked_sub(1)?;
        let mut map = self.maps.get(index)?;
        // it begins within the 31 bits that were compared, but behind u
        while map.start > u {
            index = index.checked_sub(1)?;
            map = self.maps.get(index)?;
        }
        Some(map)
    }

    /// The value at the place `numerator / denominator` of the domain, as a point's ordinate.
    pub(crate) fn at_fraction(&self, numerator: u32, denominator: u32) -> (u64, Real) {
        let u = ratio(u64::from(numerator), 63, u64::from(denominator)).min(ONE);
        (u, real_from(self.evaluate(u), FRACTION))
    }
}
