//! Mean and covariance of the slopes `(p, q) = (f G, F g)` of a height field over a box, and points that have
//! them.
//!
//! Along x the slope `f` and the value `F` have means, a variance of the slope and a covariance, along y `g`
//! and `G`; the two are independent over a box, so that
//! - `E p = f G`, `E q = F g`;
//! - `S_pp = v_f v_G + v_f G^2 + f^2 v_G`, `S_qq` alike, `S_pq = c_F c_G + c_F g G + f F c_G`, with
//!   `v_F = f^2 h^2 / 3` as of a straight line over `2 h`.
//!
//! Four points with all of them: along each axis, `f -+ s` with `F -+ c / s`, `s^2 = v_f`: the value goes
//! with the slope. Formats: 24 fractional bits.

use core::num::NonZeroU32;

use crate::fif::Trend;
use crate::num::{Real, high, product, reciprocal_of, reciprocal_sqrt_of, rough_sqrt};

/// The surface over a box: what is known along x and along y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    pub(super) x: Trend,
    pub(super) y: Trend,
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

    /// The mean height.
    #[inline(always)]
    pub(super) fn height(&self) -> i32 {
        let [_, big_f, _, big_g] = self.bits();
        times(big_f, big_g)
    }

    /// Four points of equal weight.
    #[inline(always)]
    pub(super) fn points(&self) -> [Slope; 4] {
        let pair = |s: &Trend| {
            let [slope, value, variance, covariance] =
                [s.slope, s.value, s.variance, s.covariance].map(Real::to_bits);
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

/// With 28 fractional bits, so that a product's upper word has 24; cut off at 8.
#[inline(always)]
fn wide(v: i32) -> i32 {
    v.clamp(-(1 << 27), (1 << 27) - 1) << 4
}

/// Means and covariances of a box: what counts beyond 8, of slopes and values, counts as 8.
struct Moments {
    mean: Slope,
    /// `[S_pp, S_pq, S_qq]`, 20 fractional bits.
    covariance: [i32; 3],
}

impl Moments {
    /// Of a box with `h^2 / 3`, 31 fractional bits, along both axes.
    #[inline(always)]
    fn new(Slopes { x, y }: &Slopes, [third_x, third_y]: [i32; 2]) -> Self {
        let (f, big_f) = (wide(x.slope.to_bits()), wide(x.value.to_bits()));
        let (g, big_g) = (wide(y.slope.to_bits()), wide(y.value.to_bits()));
        let (vf, vg) = (wide(x.variance.to_bits()), wide(y.variance.to_bits()));
        let (cf, cg) = (x.covariance.to_bits(), y.covariance.to_bits());
        let (ff, gg) = (high(f, f), high(g, g));
        // h^2 / 3 is below 1/3 of what is shown
        let (v_big_f, v_big_g) = (high(ff, third_x) << 1, high(gg, third_y) << 1);
        let pp = high(vf, high(big_g, big_g).wrapping_add(v_big_g)).wrapping_add(high(ff, v_big_g << 2) << 2);
        let qq = high(vg, high(big_f, big_f).wrapping_add(v_big_f)).wrapping_add(high(gg, v_big_f << 2) << 2);
        let with_cf = high(g, big_g).wrapping_add(cg);
        let pq = high(wide(cf), with_cf).wrapping_add(high(wide(cg), high(f, big_f)));
        Self { mean: [high(f, big_g), high(big_f, g)], covariance: [pp, pq, qq] }
    }
}

/// The slopes of several boxes, each with its share, around given slopes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pool {
    around: Slope,
    thirds: [i32; 2],
    share: u32,
    means: [i64; 2],
    squares: [i64; 3],
}

impl Pool {
    /// Of boxes that are `2 half` wide.
    #[inline(always)]
    pub(super) fn new(around: Slope, half: [i32; 2]) -> Self {
        let third = |h: i32| {
            let square = (product(h, h) >> 17).min(i64::from(i32::MAX)) as i32;
            high(square, 0x5555_5555)
        };
        let thirds = [third(half[0]), third(half[1])];
        Self { around, thirds, share: 0, means: [0; 2], squares: [0; 3] }
    }

    /// Adds a box; all shares together are below `2^25`.
    #[inline(always)]
    pub(super) fn add(&mut self, slopes: &Slopes, share: i32) {
        let Moments { mean: [p, q], covariance: [pp, pq, qq] } = Moments::new(slopes, self.thirds);
        let (p, q) = (p.wrapping_sub(self.around[0]), q.wrapping_sub(self.around[1]));
        let (wide_p, wide_q) = (wide(p), wide(q));
        self.share = self.share.wrapping_add(share.unsigned_abs());
        self.means[0] += product(p, share);
        self.means[1] += product(q, share);
        self.squares[0] += product(pp.wrapping_add(high(wide_p, wide_p) >> 4), share);
        self.squares[1] += product(pq.wrapping_add(high(wide_p, wide_q) >> 4), share);
        self.squares[2] += product(qq.wrapping_add(high(wide_q, wide_q) >> 4), share);
    }

    /// Four points of equal weight with the mean and the covariance of all: `(s, c / s -+ r)` and `(-s, -c /
    /// s -+ r)` around the mean, `s^2 = S_pp`, `c = S_pq`, `r^2 = S_qq - (c / s)^2`; where `q` varies more
    /// than `p`, the two change places, so that what is rounded off stays small.
    #[inline(always)]
    pub(super) fn points(&self) -> Option<[Slope; 4]> {
        let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(self.share)?);
        // a sum is below the share times 2^31
        let over = |sum: i64| (product((sum << (zeros & 31) >> 32) as i32, mantissa) >> 30) as i32;
        let (p, q) = (over(self.means[0]), over(self.means[1]));
        let (wide_p, wide_q) = (wide(p), wide(q));
        let central = |sum: i64, a: i32, b: i32| wide(over(sum).wrapping_sub(high(a, b) >> 4));
        let pp = central(self.squares[0], wide_p, wide_p);
        let pq = central(self.squares[1], wide_p, wide_q);
        let qq = central(self.squares[2], wide_q, wide_q);
        let first = pp >= qq;
        let (more, less) = if first { (pp, qq) } else { (qq, pp) };
        let more = more.max(1);
        let (mantissa, half) = reciprocal_sqrt_of(u64::from(more.unsigned_abs()) << 24);
        let per_s = |c: i32| (product(c, mantissa) >> ((half + 7) & 63)) as i32;
        let (s, c) = (per_s(more), per_s(pq));
        let rest = less.saturating_sub(times(c, c)).max(0);
        let r = rough_sqrt(u64::from(rest.unsigned_abs()) << 24) as i32;
        let (p, q) = (p.wrapping_add(self.around[0]), q.wrapping_add(self.around[1]));
        let at = |s: i32, c: i32| {
            let (dp, dq) = if first { (s, c) } else { (c, s) };
            [p.saturating_add(dp), q.saturating_add(dq)]
        };
        let (more, less) = (c.saturating_add(r), c.saturating_sub(r));
        Some([at(s, more), at(s, less), at(-s, more.saturating_neg()), at(-s, less.saturating_neg())])
    }
}
