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

use super::ground::{Ground, Side};
use crate::fif::Course;
use crate::num::{high, high_u, product, product_within, reciprocal_sqrt_of, root_of_word, rough_sqrt};

/// `sqrt 2`, 30 fractional bits.
pub(super) const FAR: i32 = 1_518_500_250;

/// The surface over a box: what is known along x and along y.
#[derive(Debug, Clone, Copy, Default)]
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
    /// The surface so far to both sides of a place; none where too much of that is outside.
    #[inline(always)]
    pub(super) fn around(
        &mut self,
        [x, y]: &[Ground<'_>; 2],
        [u, v]: [i32; 2],
        sides: &[Side; 2],
    ) -> Option<()> {
        x.around(u, &sides[0], &mut self.x)?;
        y.around(v, &sides[1], &mut self.y)
    }

    /// The mean slopes, saturated at ±64.
    #[inline(always)]
    pub(super) fn mean(&self) -> Slope {
        let times = |slope: i32, value: i32| {
            let product = product(slope, value);
            let high = ((product >> 32) as i32).clamp(-(1 << 17), (1 << 17) - 1);
            high << 13 | (product as u32 >> 19) as i32
        };
        [times(self.x.slope, self.y.value), times(self.y.slope, self.x.value)]
    }

    /// The mean height.
    #[inline(always)]
    pub(super) fn height(&self) -> i32 {
        times(self.x.value(), self.y.value())
    }

    /// Four points of equal weight.
    #[inline(always)]
    pub(super) fn points(&self) -> [Slope; 4] {
        let pair = |course: &Course| {
            let ([slope, value], [s, t]) = ([course.slope(), course.value()], deviations(course));
            [
                [slope.saturating_add(s), value.saturating_add(t)],
                [slope.saturating_sub(s), value.saturating_sub(t)],
            ]
        };
        let ([a, b], [c, d]) = (pair(&self.x), pair(&self.y));
        [at(a, c), at(a, d), at(b, c), at(b, d)]
    }

    /// Three points of equal weight with the same means and covariances: 0 and -+sqrt(3/2) deviations along x
    /// with sqrt 2 and -1/sqrt 2 along y for `FAR`, and the other way round for `-FAR`: so that what is of
    /// third order in two boxes side by side cancels.
    #[inline(always)]
    pub(super) fn three(&self, far: i32) -> [Slope; 3] {
        /// `sqrt(3/2)`, 30 fractional bits.
        const ACROSS: i32 = 1_315_059_792;
        let ([s, t], [u, v]) = (times_deviations(&self.x, ACROSS), times_deviations(&self.y, far));
        let ([f, big_f], [g, big_g]) = ([self.x.slope(), self.x.value()], [self.y.slope(), self.y.value()]);
        let near = [g.saturating_sub(u >> 1), big_g.saturating_sub(v >> 1)];
        [
            at([f, big_f], [g.saturating_add(u), big_g.saturating_add(v)]),
            at([f.saturating_add(s), big_f.saturating_add(t)], near),
            at([f.saturating_sub(s), big_f.saturating_sub(t)], near),
        ]
    }
}

/// The slopes where slope and value are these along x and along y.
#[inline(always)]
fn at([f, big_f]: [i32; 2], [g, big_g]: [i32; 2]) -> Slope {
    [times(f, big_g), times(big_f, g)]
}

/// The deviation of the slope, and what the value deviates with it.
#[inline(always)]
fn deviations(course: &Course) -> [i32; 2] {
    let (m, root, up) = root_of_word(course.variance() as u32 | 1);
    // the root of m has 29 fractional bits here, s has 24, and c / s is s's part of c / s^2; by Cauchy and
    // Schwarz it is no larger than the deviation of the value
    let s = (high_u(m, root) >> (up + 2)) as i32;
    [s, high(course.covariance() << up, root as i32) >> 2]
}

/// The same times a factor with 30 fractional bits, below 2.
#[inline(always)]
fn times_deviations(course: &Course, factor: i32) -> [i32; 2] {
    let (m, root, up) = root_of_word(course.variance() as u32 | 1);
    // half of it
    let root = high(root as i32, factor) << 1;
    [high((m >> 1) as i32, root) >> up, high(course.covariance() << up, root) >> 1]
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
    /// Of a box with so large [`spans`].
    #[inline(always)]
    fn new(Slopes { x, y }: &Slopes, [along_x, along_y]: [i32; 2]) -> Self {
        let steep = |slope: i32| slope.clamp(-(1 << 24), (1 << 24) - 1) << 7;
        let high_up = |value: i32| value.clamp(-(1 << 25), (1 << 25) - 1) << 6;
        let (f, big_f, g, big_g) = (steep(x.slope), high_up(x.value), steep(y.slope), high_up(y.value));
        // that of the value, as of a straight line
        let square = |v: i32, slope: i32, deviation: i32| {
            let off = high(slope, deviation) << 1;
            wide(high(v, v).wrapping_add(high(off, off)))
        };
        let (with_f, with_g) = (high(f, wide(x.middle)), high(g, wide(y.middle)));
        Self {
            mean: [high(f, big_g), high(big_f, g)],
            squares: [
                high(x.squares << 2, square(big_g, g, along_y)),
                high(wide(with_f), wide(with_g)) >> 4,
                high(y.squares << 2, square(big_f, f, along_x)),
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

    /// Of two boxes with the same [`spans`] that count alike.
    #[inline(always)]
    pub(super) fn of_two(boxes: &[Slopes; 2], spans: [i32; 2]) -> Self {
        let [a, b] = [Moments::new(&boxes[0], spans), Moments::new(&boxes[1], spans)];
        let middle = |a: i32, b: i32| (a >> 1).wrapping_add(b >> 1);
        let [[p, q], [r, s]] = [a.mean, b.mean];
        let [[pp, pq, qq], [rr, rs, ss]] = [a.squares, b.squares];
        Self::new([middle(p, r), middle(q, s)], [middle(pp, rr), middle(pq, rs), middle(qq, ss)])
    }

    /// Of one box.
    #[inline(always)]
    pub(super) fn of(slopes: &Slopes, spans: [i32; 2]) -> Self {
        let Moments { mean, squares } = Moments::new(slopes, spans);
        Self::new(mean, squares)
    }
}

/// How far a box's places deviate from its middle, `h / sqrt(3)` for half of it, 31 fractional bits. A half
/// beyond 1 counts as 1: that is far beyond what a pixel shows.
#[inline(always)]
pub(super) fn spans([x, y]: [i32; 2]) -> [i32; 2] {
    let deviation = |half: i32| high(half.min((1 << 24) - 1) << 7, 0x49e6_9d16) << 1;
    [deviation(x), deviation(y)]
}
