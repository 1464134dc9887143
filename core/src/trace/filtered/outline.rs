//! The slopes of all that a pixel covers of a height field, by its outline.
//!
//! Over a part of the ground, `int p dA = loop h dy`, `int q dA = -loop h dx` and `int dA = loop x dy`, by
//! Green's theorem: how high the surface is along the pixel's outline tells its mean slopes, however rough it
//! is inside. Along a straight edge `h = F G` has the mean `F^ G^ + dF dG / 12`, `F^` and `G^` the exact
//! means of both along it, by running sums, and `dF`, `dG` what they gain: what is left out is how `F` bends
//! times how `G` does.
//!
//! The corners are where the pixel's rays meet the surface: each goes from the mean plane, of which it is `e`
//! above the surface, by `e d / (-n . d)`. Left and right edges lie along the rays, so that what the surface
//! does between two corners moves nothing out of them; the upper and the lower edge are cut into columns. A
//! corner beyond the domain stands on the profiles that go on straight: what they make wrong is a small
//! corner of the pixel. How slopes vary about their mean, two boxes tell, each as wide as half of the pixel.
//!
//! (In floating point matt `G x G` in 96 x 96 pixels is so off by 0.00064, of which 0.00044 is what four
//! points for all slopes are off; in eight boxes that follow the surface by 0.00106. With exact means and the
//! spread of one box it would be 0.00096, with the exact spread and the means of eight boxes 0.00103.)
//!
//! Formats: as the footprint.

use core::num::NonZeroU32;

use super::footprint::{Place, Sight, Ways, cut, edges, on_mean, sides};
use super::ground::Ground;
use super::slopes::{Slope, Slopes, Spread};
use crate::fif::Sum;
use crate::num::{product, reciprocal_of};

/// A corner of the outline: where its ray meets the surface, and the sums up to there along both axes.
#[derive(Debug, Clone, Copy)]
struct Corner {
    at: [i32; 2],
    sums: [Sum; 2],
}

/// Where a ray of the pixel meets the mean plane: in parts of the domain, and how high.
#[derive(Debug, Clone, Copy)]
struct Start {
    at: [i32; 2],
    height: i32,
}

impl Start {
    #[inline(always)]
    fn plus(self, ([x, y], rise): ([i32; 2], i32)) -> Self {
        let at = [self.at[0].wrapping_add(x), self.at[1].wrapping_add(y)];
        Self { at, height: self.height.wrapping_add(rise) }
    }

    #[inline(always)]
    fn minus(self, ([x, y], rise): ([i32; 2], i32)) -> Self {
        self.plus(([x.wrapping_neg(), y.wrapping_neg()], rise.wrapping_neg()))
    }
}

/// The corner of a ray.
#[inline(always)]
fn corner(ground: &[Ground<'_>; 2], ways: &Ways, start: &Start, beyond: &mut u32) -> Option<Corner> {
    let ([u, v], [x, y]) = (start.at, ground);
    let [s, t] = ways.moved(ground, start.at, start.height);
    let at = [u.saturating_add(s), v.saturating_add(t)];
    Some(Corner { at, sums: [x.at(at[0], beyond)?, y.at(at[1], beyond)?] })
}

/// What an outline has come to: `loop h dy` and `-loop h dx`, 54 fractional bits, and twice the area, 60, in
/// parts of the domain.
#[derive(Debug, Clone, Copy, Default)]
struct Loop {
    slopes: [i64; 2],
    twice: i64,
}

impl Loop {
    /// Goes along an edge, both ends relative to `middle`.
    #[inline(always)]
    fn add(&mut self, [x, y]: &[Ground<'_>; 2], middle: i32, from: &Corner, to: &Corner) {
        let [dx, dy] = [to.at[0].wrapping_sub(from.at[0]), to.at[1].wrapping_sub(from.at[1])];
        let ([f0, g0], [f1, g1]) = (from.sums, to.sums);
        let (f, g) = (x.mean(&f0, &f1, dx), y.mean(&g0, &g1, dy));
        let gained = product(f1.value().wrapping_sub(f0.value()), g1.value().wrapping_sub(g0.value()));
        // a twelfth with 16 fractional bits
        let height = ((product(f, g) + (gained >> 16) * 5461) >> 24) as i32;
        self.slopes[0] += product(height, dy);
        self.slopes[1] -= product(height, dx);
        let both = from.at[0].wrapping_sub(middle).wrapping_add(to.at[0].wrapping_sub(middle));
        self.twice += product(both, dy);
    }

    /// The mean slopes; none of an outline without any area.
    #[inline(always)]
    fn mean(&self, [x, y]: &[Ground<'_>; 2]) -> Option<Slope> {
        // a whole domain has 2^61
        let twice = self.twice.unsigned_abs();
        let zeros = twice.leading_zeros().clamp(1, 63);
        let (mantissa, _) = reciprocal_of(NonZeroU32::new(((twice << zeros) >> 32) as u32)?);
        let [p, q] = self.slopes.map(|slope| {
            // below 64 of a domain's length
            let part = ((slope << (zeros - 1)) >> 31) as i32;
            (product(part, mantissa) >> 31) as i32
        });
        let sign = if self.twice < 0 { -1 } else { 1 };
        Some([x.per_length(p.wrapping_mul(sign)), y.per_length(q.wrapping_mul(sign))])
    }
}

/// Whether corners so far beyond the domain, of `columns + 1` to the upper and to the lower edge, leave too
/// much of a pixel there: an eighth of its width to one side, a sixteenth behind or before it.
#[cold]
fn is_cut(edges: [[i32; 2]; 2], columns: i32, beyond: u32) -> bool {
    let around = edges.iter().flatten().fold(0_i64, |sum, c| sum + i64::from(c.unsigned_abs()));
    i64::from(beyond) << 5 > around * i64::from(columns.saturating_add(1))
}

/// Mean and covariance of the slopes over a pixel around where its ray meets the mean plane, `columns` to its
/// upper and lower edge; none where it leaves the domain.
#[inline(always)]
pub(super) fn spread(
    ground: &[Ground<'_>; 2],
    sight: &Sight,
    pixel: [[i32; 3]; 2],
    place: Place,
    (reach, columns): (i32, i32),
) -> Option<Spread> {
    let [x, y] = ground;
    // a pixel that is seen at a flat angle is longer than what the plane has been taken above
    let place = on_mean(ground, sight, place, &sides(ground, edges(&place, sight, pixel), 0).1, reach)?;
    let [a, b] = edges(&place, sight, pixel);
    let ways = Ways::new(ground, sight, place.steep, reach);
    let rise = |[u, v]: [i32; 2]| ((product(place.slope[0], u) + product(place.slope[1], v)) >> 24) as i32;
    let step = |v: [i32; 2]| ([x.part(v[0]), y.part(v[1])], rise(v));
    let [_, _, z] = sight.at(place.t);
    let middle = [x.place(place.at[0]), y.place(place.at[1])];
    let across = cut(a, columns);
    let halves = [[a[0] >> 1, a[1] >> 1], [b[0] >> 1, b[1] >> 1]];
    let (across, down) = (step(across), step(b));
    let mut beyond = 0;
    // along the upper edge, down, back along the lower one, and up
    let mut start = Start { at: middle, height: z }.minus(step(halves[0])).minus(step(halves[1]));
    let first = corner(ground, &ways, &start, &mut beyond)?;
    let (mut last, mut sum) = (first, Loop::default());
    for _ in 0..columns {
        start = start.plus(across);
        let next = corner(ground, &ways, &start, &mut beyond)?;
        sum.add(ground, middle[0], &last, &next);
        last = next;
    }
    let second = last;
    start = start.plus(down);
    let third = corner(ground, &ways, &start, &mut beyond)?;
    sum.add(ground, middle[0], &second, &third);
    last = third;
    for _ in 0..columns {
        start = start.minus(across);
        let next = corner(ground, &ways, &start, &mut beyond)?;
        sum.add(ground, middle[0], &last, &next);
        last = next;
    }
    sum.add(ground, middle[0], &last, &first);
    if beyond > 0 && is_cut([across.0.map(|c| c.wrapping_mul(columns)), down.0], columns, beyond) {
        return None;
    }
    let mean = sum.mean(ground)?;
    // two boxes, one behind the other along the longer edge
    let between = |v: [i32; 2], w: [i32; 2]| [(v[0] >> 1) + (w[0] >> 1), (v[1] >> 1) + (w[1] >> 1)];
    let length = |[x, y]: [i32; 2]| product(x, x) + product(y, y);
    let beside = length(a) > length(b);
    let (ends, half) = if beside {
        ([between(first.at, last.at), between(second.at, third.at)], [halves[0], b])
    } else {
        ([between(first.at, second.at), between(last.at, third.at)], [a, halves[1]])
    };
    let (spans, sides) = sides(ground, half, 2);
    let [from, to] = ends;
    let part = [(to[0] - from[0]) >> 2, (to[1] - from[1]) >> 2];
    let mut boxes = [Slopes::default(); 2];
    boxes[0].around(ground, [from[0] + part[0], from[1] + part[1]], &sides)?;
    boxes[1].around(ground, [to[0] - part[0], to[1] - part[1]], &sides)?;
    Some(Spread { mean, ..Spread::of_two(&boxes, spans) })
}
