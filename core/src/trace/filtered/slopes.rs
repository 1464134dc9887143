//! Mean and covariance of the slopes `(p, q) = (f G, F g)` of a height field over a box, and points that have
//! them.
//!
//! Along x the slope `f` and the value `F` have means, a mean square of the slope and a mean of their
//! product, along y `g` and `G`; the two are independent over a box, so that
//! - `E p = f G`, `E q = F g`;
//! - `E p^2 = E f^2 E G^2`, `E q^2 = E F^2 E g^2`, `E p q = E f F E g G`, with
//!   `E F^2 = F^2 + f^2 h^2 / 3` as of a straight line over `2 h`.
//!
//! Four points with all of them: along each axis, `f -+ s` with `F -+ c / s`, `s^2` the variance of the
//! slope and `c` the covariance: the value goes with the slope. Formats: 24 fractional bits.

use crate::fif::Course;
use crate::num::{high, product, product_within, reciprocal_sqrt_of, rough_sqrt};

/// The surface over a box: what is known along x and along y.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    pub(super) x: Course,
    pub(super) y: Course,
}

/// Slopes at a point: `(p, q)`, 24 fractional bits.
pub(super) type Slope = [i32; 2];

/// `a b`, 24 fractional bits, saturated at ±64 (its last 8 bits are not).
#[inline(always)]
pub(super) fn times(a: i32, b: i32) -> i32 {
    product_within::<6>(a, b)
}

impl Slopes {
    #[inline(always)]
    fn bits(&self) -> [i32; 4] {
        [self.x.slope, self.x.value, self.y.slope, self.y.value]
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
        let pair = |s: &Course| {
            let (Course { slope, value, .. }, [variance, covariance]) = (*s, s.spread());
            // 1 / s, where v has 24 fractional bits: mantissa / 2^(19 + half)
            let (mantissa, half) = reciprocal_sqrt_of(variance.max(1).unsigned_abs().into());
            let over = |c: i32| (product(c, mantissa) >> ((half + 19) & 63)) as i32;
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

impl Slopes {
    /// Three points of equal weight with the same mean and covariances: along x 0 and +-sqrt(3/2) deviations,
    /// along y sqrt 2 and -+1/sqrt 2; upside down where `odd`, so that what is third in two boxes side by side
    /// cancels.
    #[inline(always)]
    pub(super) fn three(&self, odd: bool) -> [Slope; 3] {
        /// `sqrt(3/2)`, `sqrt 2` and its half, 30 fractional bits.
        const FACTORS: [i32; 3] = [1_315_059_792, 1_518_500_250, 759_250_125];
        let [across, up, down] = FACTORS;
        let ([s, t], [u, v]) = (deviations(&self.x), deviations(&self.y));
        let sign = if odd { -1 } else { 1 };
        let [s, t] = [s, t].map(|c| high(c, across) << 2);
        let [far, near] = [up, down].map(|factor| [u, v].map(|c| (high(c, factor) << 2).wrapping_mul(sign)));
        let (f, big_f, g, big_g) = (self.x.slope, self.x.value, self.y.slope, self.y.value);
        let at = |[f, big_f]: [i32; 2], [g, big_g]: [i32; 2]| [times(f, big_g), times(big_f, g)];
        let far = [g.saturating_add(far[0]), big_g.saturating_add(far[1])];
        let near = [g.saturating_sub(near[0]), big_g.saturating_sub(near[1])];
        [
            at([f, big_f], far),
            at([f.saturating_add(s), big_f.saturating_add(t)], near),
            at([f.saturating_sub(s), big_f.saturating_sub(t)], near),
        ]
    }
}

/// The deviation of the slope, and what the value deviates with it.
#[inline(always)]
fn deviations(course: &Course) -> [i32; 2] {
    let [variance, covariance] = course.spread();
    // 1 / s, where v has 24 fractional bits: mantissa / 2^(19 + half)
    let (mantissa, half) = reciprocal_sqrt_of(variance.max(1).unsigned_abs().into());
    // by Cauchy and Schwarz no larger than the deviation of the value
    [variance, covariance].map(|c| (product(c, mantissa) >> ((half + 19) & 63)) as i32)
}

/// With 28 fractional bits, so that a product's upper word has 24; cut off at 8.
#[inline(always)]
fn wide(v: i32) -> i32 {
    v.clamp(-(1 << 27), (1 << 27) - 1) << 4
}

/// Means of a box: what counts beyond 8, of slopes and values, counts as 8.
struct Moments {
    mean: Slope,
    /// The means of `p^2`, `p q` and `q^2`, 20 fractional bits.
    squares: [i32; 3],
}

impl Moments {
    /// Of a box with `h^2 / 3`, 31 fractional bits, along both axes.
    #[inline(always)]
    fn new(Slopes { x, y }: &Slopes, [third_x, third_y]: [i32; 2]) -> Self {
        let (f, big_f, g, big_g) = (wide(x.slope), wide(x.value), wide(y.slope), wide(y.value));
        // that of the value, as of a straight line: h^2 / 3 is below 1/3 of what is shown
        let square = |v: i32, slope: i32, third: i32| {
            wide(high(v, v).wrapping_add(high(high(slope, slope), third) << 1))
        };
        let (with_f, with_g) = (high(f, wide(x.middle)), high(g, wide(y.middle)));
        Self {
            mean: [high(f, big_g), high(big_f, g)],
            squares: [
                high(x.squares, square(big_g, g, third_y)),
                high(wide(with_f), wide(with_g)) >> 4,
                high(y.squares, square(big_f, f, third_x)),
            ],
        }
    }
}

/// Mean and covariance of slopes: `[S_pp, S_pq, S_qq]`, 24 fractional bits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spread {
    pub(super) mean: Slope,
    pub(super) covariance: [i32; 3],
}

impl Spread {
    #[inline(always)]
    fn new(mean: Slope, squares: [i32; 3]) -> Self {
        let [p, q] = mean.map(wide);
        let central = |square: i32, a: i32, b: i32| wide(square.wrapping_sub(high(a, b) >> 4));
        let [pp, pq, qq] = squares;
        Self { mean, covariance: [central(pp, p, p), central(pq, p, q), central(qq, q, q)] }
    }

    /// Four points of equal weight with the mean and the covariance of it: `(s, c / s -+ r)` and `(-s, -c /
    /// s -+ r)` around the mean, `s^2 = S_pp`, `c = S_pq`, `r^2 = S_qq - (c / s)^2`; where `q` varies more
    /// than `p`, the two change places, so that what is rounded off stays small.
    #[inline(always)]
    pub(super) fn points(&self) -> [Slope; 4] {
        let Self { mean: [p, q], covariance: [pp, pq, qq] } = *self;
        let first = pp >= qq;
        let (more, less) = if first { (pp, qq) } else { (qq, pp) };
        let more = more.max(1);
        let (mantissa, half) = reciprocal_sqrt_of(u64::from(more.unsigned_abs()) << 24);
        let per_s = |c: i32| (product(c, mantissa) >> ((half + 7) & 63)) as i32;
        let (s, c) = (per_s(more), per_s(pq));
        let rest = less.saturating_sub(times(c, c)).max(0);
        let r = rough_sqrt(u64::from(rest.unsigned_abs()) << 24) as i32;
        let at = |s: i32, c: i32| {
            let (dp, dq) = if first { (s, c) } else { (c, s) };
            [p.saturating_add(dp), q.saturating_add(dq)]
        };
        let (more, less) = (c.saturating_add(r), c.saturating_sub(r));
        [at(s, more), at(s, less), at(-s, more.saturating_neg()), at(-s, less.saturating_neg())]
    }

    /// Of two boxes that count alike.
    #[inline(always)]
    pub(super) fn of_two(boxes: &[Slopes; 2], half: [i32; 2]) -> Self {
        let thirds = thirds(half);
        let [a, b] = boxes.each_ref().map(|slopes| Moments::new(slopes, thirds));
        let middle = |a: i32, b: i32| (a >> 1).wrapping_add(b >> 1);
        let [[p, q], [r, s]] = [a.mean, b.mean];
        let [[pp, pq, qq], [rr, rs, ss]] = [a.squares, b.squares];
        Self::new([middle(p, r), middle(q, s)], [middle(pp, rr), middle(pq, rs), middle(qq, ss)])
    }

    /// Of one box.
    #[inline(always)]
    pub(super) fn of(slopes: &Slopes, half: [i32; 2]) -> Self {
        let Moments { mean, squares } = Moments::new(slopes, thirds(half));
        Self::new(mean, squares)
    }
}

/// `h^2 / 3`, 31 fractional bits.
#[inline(always)]
fn thirds(half: [i32; 2]) -> [i32; 2] {
    half.map(|h| {
        let square = (product(h, h) >> 17).min(i64::from(i32::MAX)) as i32;
        high(square, 0x5555_5555)
    })
}
