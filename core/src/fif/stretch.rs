//! Means, variances and covariance of a differentiable function and its slope over an interval, pooled from
//! parts.
//!
//! `v = sum w (v_i + (m_i - m_0)^2) - (sum w (m_i - m_0))^2`, `m_0` the mean of the first part, so that the
//! difference is one of small numbers. Formats: 24 fractional bits, weights 31.

use core::num::NonZeroU32;

use crate::num::{Real, product, reciprocal_of};

/// A function above an interval: mean, variance and covariance of its value and its slope, each saturated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Stretch {
    /// Mean slope.
    pub slope: Real,
    /// Mean value.
    pub value: Real,
    /// Variance of the slope.
    pub slope_variance: Real,
    /// Variance of the value.
    pub value_variance: Real,
    /// Covariance of the two.
    pub covariance: Real,
}

/// Sums over the parts of an interval.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pool {
    from: [i32; 2],
    weight: u32,
    means: [i64; 2],
    /// Of slopes, of values, of both.
    squares: [i64; 3],
}

/// `a b` with 24 fractional bits, saturated.
#[inline(always)]
pub(super) fn times(a: i32, b: i32) -> i32 {
    (product(a, b) >> 24).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

impl Pool {
    /// Of parts whose slopes and values lie around these.
    pub(super) fn around(slope: Real, value: Real) -> Self {
        Self { from: [slope.to_bits(), value.to_bits()], weight: 0, means: [0; 2], squares: [0; 3] }
    }

    /// Adds a part of this weight; all weights together are at most `2^31`.
    #[inline(always)]
    pub(super) fn add(&mut self, part: &Stretch, weight: u32) {
        // the whole domain is a unit short
        let w = weight.min(i32::MAX as u32) as i32;
        self.weight = self.weight.wrapping_add(w as u32);
        let slope = part.slope.to_bits().saturating_sub(self.from[0]);
        let value = part.value.to_bits().saturating_sub(self.from[1]);
        let central = [part.slope_variance, part.value_variance, part.covariance].map(Real::to_bits);
        let around = [times(slope, slope), times(value, value), times(slope, value)];
        self.means[0] = self.means[0].wrapping_add(product(slope, w));
        self.means[1] = self.means[1].wrapping_add(product(value, w));
        for ((sum, c), a) in self.squares.iter_mut().zip(central).zip(around) {
            *sum = sum.wrapping_add(product(c.saturating_add(a), w));
        }
    }

    /// What the parts are together; none without weight.
    #[inline(always)]
    pub(super) fn stretch(&self) -> Option<Stretch> {
        let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(self.weight)?);
        // a sum is below the weight times 2^31
        let over = |sum: i64| {
            let high = ((sum << (zeros & 31)).wrapping_add(1 << 31) >> 32) as i32;
            ((product(high, mantissa).wrapping_add(1 << 29)) >> 30)
                .clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
        };
        let [slope, value] = self.means.map(over);
        let [slopes, values, both] = self.squares.map(over);
        let less = |v: i32, a: i32, b: i32| Real::from_bits(v.saturating_sub(times(a, b)));
        Some(Stretch {
            slope: Real::from_bits(self.from[0].saturating_add(slope)),
            value: Real::from_bits(self.from[1].saturating_add(value)),
            slope_variance: less(slopes, slope, slope).max(Real::ZERO),
            value_variance: less(values, value, value).max(Real::ZERO),
            covariance: less(both, slope, value),
        })
    }
}
