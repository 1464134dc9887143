//! Mean and covariance of the slopes `(p, q) = (f G, F g)` of a height field over a box, and points that have
//! them.
//!
//! Along x the slope `f` and the value `F` have means, variances and a covariance, along y `g` and `G`; the
//! two are independent over a box, so that
//! - `E p = f G`, `E q = F g`;
//! - `S_pp = v_f v_G + v_f G^2 + f^2 v_G`, `S_qq` alike, `S_pq = c_F c_G + c_F g G + f F c_G`.
//!
//! Four points with all of them: along each axis, `f -+ s` with `F -+ c / s`, `s^2 = v_f`: the value goes with
//! the slope. Formats: 24 fractional bits.

use crate::fif::Stretch;
use crate::num::{Real, product, reciprocal_sqrt_of};

/// The surface over a box: what is known along x and along y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    pub(super) x: Stretch,
    pub(super) y: Stretch,
}

/// Slopes at a point: `(p, q)`, 24 fractional bits.
pub(super) type Slope = [i32; 2];

/// `a b`, 24 fractional bits, saturated at ±64.
#[inline(always)]
pub(super) fn times(a: i32, b: i32) -> i32 {
    let product = product(a, b);
    let high = (product >> 32) as i32;
    let limit = ((high >> 31) | 1) << 30;
    if (-(1 << 22)..1 << 22).contains(&high) { (product >> 24) as i32 } else { limit }
}

impl Slopes {
    #[inline(always)]
    fn bits(&self) -> [i32; 4] {
        [self.x.slope, self.x.value, self.y.slope, self.y.value].map(Real::to_bits)
    }

    /// The mean slopes.
    #[inline(always)]
    pub(super) fn mean(&self) -> Slope {
        let [f, big_f, g, big_g] = self.bits();
        [times(f, big_g), times(big_f, g)]
    }

    /// The mean height, 24 fractional bits.
    #[inline(always)]
    pub(super) fn height(&self) -> i32 {
        let [_, big_f, _, big_g] = self.bits();
        times(big_f, big_g)
    }

    /// `[S_pp, S_pq, S_qq]`.
    #[inline(always)]
    pub(super) fn covariance(&self) -> [i32; 3] {
        let [f, big_f, g, big_g] = self.bits();
        let variances = |s: &Stretch| [s.slope_variance, s.value_variance, s.covariance].map(Real::to_bits);
        let ([vf, v_big_f, cf], [vg, v_big_g, cg]) = (variances(&self.x), variances(&self.y));
        let one = |v: i32, of_value: i32, value: i32, slope: i32| {
            let squares = of_value.saturating_add(times(value, value));
            times(v, squares).saturating_add(times(times(slope, slope), of_value))
        };
        let across = times(cf, cg.saturating_add(times(g, big_g))).saturating_add(times(times(f, big_f), cg));
        [one(vf, v_big_g, big_g, f), across, one(vg, v_big_f, big_f, g)]
    }

    /// Four points of equal weight.
    #[inline(always)]
    pub(super) fn points(&self) -> [Slope; 4] {
        let pair = |s: &Stretch| {
            let [slope, value, variance, covariance] =
                [s.slope, s.value, s.slope_variance, s.covariance].map(Real::to_bits);
            // 1 / s, where v has 24 fractional bits: mantissa / 2^(31 + half) for the word
            let (mantissa, half) = reciprocal_sqrt_of(u64::from(variance.max(1).unsigned_abs()) << 24);
            let over = |c: i32| (product(c, mantissa) >> ((half + 7) & 63)) as i32;
            // by Cauchy and Schwarz no larger than the deviation of the value
            let (s, t) = (over(variance), over(covariance));
            [
                [slope.saturating_add(s), value.saturating_add(t)],
                [slope.saturating_sub(s), value.saturating_sub(t)],
            ]
        };
        let ([a, b], [c, d]) = (pair(&self.x), pair(&self.y));
        let at = |[f, big_f]: [i32; 2], [g, big_g]: [i32; 2]| [times(f, big_g), times(big_f, g)];
        [at(a, c), at(a, d), at(b, c), at(b, d)]
    }
}
