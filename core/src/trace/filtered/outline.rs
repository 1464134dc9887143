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

use super::footprint::{Place, Sight, Spot, Ways, cut, edges, on_mean, sides};
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

/// The corner of a ray.
#[inline(always)]
fn corner(ground: &[Ground<'_>; 2], ways: &Ways, start: Spot, beyond: &mut u32) -> Option<Corner> {
    let ([u, v], [x, y]) = (start.at, ground);
    let [s, t] = ways.moved(ground, start);
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
    let step = |v: [i32; 2]| Spot::along(ground, place.slope, v);
    let [_, _, z] = sight.at(place.t);
    let middle = [x.place(place.at[0]), y.place(place.at[1])];
    let across = cut(a, columns);
    let halves = [[a[0] >> 1, a[1] >> 1], [b[0] >> 1, b[1] >> 1]];
    let (across, down) = (step(across), step(b));
    let mut beyond = 0;
    // along the upper edge, down, back along the lower one, and up
    let mut start = Spot { at: middle, height: z }.minus(step(halves[0])).minus(step(halves[1]));
    let first = corner(ground, &ways, start, &mut beyond)?;
    let (mut last, mut sum) = (first, Loop::default());
    for _ in 0..columns {
        start = start.plus(across);
        let next = corner(ground, &ways, start, &mut beyond)?;
        sum.add(ground, middle[0], &last, &next);
        last = next;
    }
    let second = last;
    start = start.plus(down);
    let third = corner(ground, &ways, start, &mut beyond)?;
    sum.add(ground, middle[0], &second, &third);
    last = third;
    for _ in 0..columns {
        start = start.minus(across);
        let next = corner(ground, &ways, start, &mut beyond)?;
        sum.add(ground, middle[0], &last, &next);
        last = next;
    }
    sum.add(ground, middle[0], &last, &first);
    if beyond > 0 && is_cut([across.at.map(|c| c.wrapping_mul(columns)), down.at], columns, beyond) {
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

#[cfg(test)]
mod tests {
    use super::super::footprint::steepness;
    use super::*;
    use crate::fif::{Fif, Knot, Sums};
    use crate::num::{Scaling, Wide};

    const WHOLE: f64 = 1073741824.0;

    /// Above `[0, 2] x [0, 2]`: `a + b x` times `c + d y`.
    fn with_ground([a, b, c, d]: [f64; 4], then: impl FnOnce(&[Ground<'_>; 2])) {
        let line = |slope: f64, first: f64| {
            let knots = [0, 1, 2].map(|x| Knot::new(Wide::from_num(x), Wide::from_num(slope)));
            let slope = Fif::<2, 1>::interpolating(&knots, &[Scaling::ZERO; 2]).unwrap();
            slope.integral::<2>(Wide::from_num(first)).unwrap()
        };
        let (f, g) = (line(b, a), line(d, c));
        let mut memory = [[Sum::ZERO; Sums::places(2, 8)]; 2];
        let [x, y] = &mut memory;
        let sums = [Sums::new(&f, 8, x).unwrap(), Sums::new(&g, 8, y).unwrap()];
        then(&sums.map(|sums| Ground::new(sums, 0, 2 << 24)));
    }

    fn bits(v: f64) -> i32 {
        (v * 16_777_216.0).round() as i32
    }

    fn value(v: i32) -> f64 {
        f64::from(v) / 16_777_216.0
    }

    /// By Green's theorem with exact numbers: twice the area, and the mean place.
    fn exact(corners: &[[f64; 2]]) -> (f64, [f64; 2]) {
        let (mut twice, mut place) = (0.0, [0.0; 2]);
        for (k, [x, y]) in corners.iter().enumerate() {
            let [u, v] = corners[(k + 1) % corners.len()];
            let cross = x * v - u * y;
            twice += cross;
            place = [place[0] + (x + u) * cross / 3.0, place[1] + (y + v) * cross / 3.0];
        }
        (twice, place.map(|c| c / twice))
    }

    /// The area of a polygon, and the mean slopes of a product of two straight lines above it: those at the
    /// polygon's mean place. From the left and from the right, convex and not.
    #[test]
    fn an_outline_tells_its_area_and_its_mean_slopes() {
        let polygons: [&[[f64; 2]]; 5] = [
            &[[0.5, 0.5], [0.53, 0.51], [0.51, 0.54]],
            &[[1.0, 1.0], [1.03, 0.97], [1.07, 1.01], [1.04, 1.05]],
            &[[1.5, 0.25], [1.5, 0.75], [1.875, 0.75], [1.875, 0.25]],
            // an L and a dart
            &[[0.2, 1.2], [0.4, 1.2], [0.4, 1.25], [0.25, 1.25], [0.25, 1.6], [0.2, 1.6]],
            &[[0.7, 0.7], [1.3, 0.9], [0.9, 0.9], [0.9, 1.3]],
        ];
        for [a, b, c, d] in [[0.25, 0.5, 0.5, 0.75], [1.0, -0.375, 0.25, 0.5], [0.5, 0.25, 1.0, 0.0]] {
            with_ground([a, b, c, d], |ground| {
                for corners in polygons {
                    for turned in [false, true] {
                        let mut corners = corners.to_vec();
                        if turned {
                            corners.reverse();
                        }
                        let (twice, [x, y]) = exact(&corners);
                        let at = |[x, y]: [f64; 2]| {
                            let at = [x, y].map(|c| (c / 2.0 * WHOLE) as i32);
                            let mut beyond = 0;
                            let [u, v] = ground;
                            let sums = [u.at(at[0], &mut beyond).unwrap(), v.at(at[1], &mut beyond).unwrap()];
                            assert_eq!(beyond, 0);
                            Corner { at, sums }
                        };
                        let all: std::vec::Vec<_> = corners.iter().map(|corner| at(*corner)).collect();
                        let mut sum = Loop::default();
                        for (k, from) in all.iter().enumerate() {
                            sum.add(ground, all[0].at[0], from, &all[(k + 1) % all.len()]);
                        }
                        let area = sum.twice as f64 / (WHOLE * WHOLE / 4.0);
                        assert!((area - twice).abs() < 1e-8, "{area} {twice}");
                        let [p, q] = sum.mean(ground).unwrap().map(value);
                        let off = [p - b * (c + d * y), q - d * (a + b * x)];
                        // a unit of a height along the edge of a small polygon
                        let tolerance = 3e-6 / twice.abs().sqrt();
                        assert!(
                            off.iter().all(|off| off.abs() < tolerance),
                            "{off:?} {tolerance} {corners:?}"
                        );
                    }
                }
            });
        }
        with_ground([0.5; 4], |ground| assert!(Loop::default().mean(ground).is_none()));
    }

    /// A pixel from above, around a place, with these sides along x and y at the ground.
    fn from_above(
        ground: &[Ground<'_>; 2],
        [x, y]: [f64; 2],
        [wide, high]: [f64; 2],
        columns: i32,
    ) -> Option<Spread> {
        let direction = [0, 0, -(1 << 28)];
        let sight = Sight { eye: [bits(x), bits(y), bits(8.0)], direction };
        // an eighth of that at the distance of 1, with 28 fractional bits
        let pixel = [[2 * bits(wide), 0, 0], [0, -2 * bits(high), 0]];
        let slope = [0; 2];
        let t = bits(8.0);
        let place = Place { t, at: [bits(x), bits(y)], slope, steep: steepness(slope, direction) };
        spread(ground, &sight, pixel, place, (bits(1.0), columns))
    }

    /// From above a pixel covers a rectangle around its middle, as large as it is at the surface's distance:
    /// mean slopes there, and variances of straight lines over it, whichever edge is the longer one.
    #[test]
    fn a_pixel_from_above_has_the_slopes_of_its_rectangle() {
        let [a, b, c, d] = [0.25, 0.5, 0.5, 0.75];
        with_ground([a, b, c, d], |ground| {
            for (x, y, columns, sides) in [
                (1.0, 1.0, 3, [0.125, 0.125]),
                (0.5, 1.5, 3, [0.125, 0.0625]),
                (1.25, 0.75, 6, [0.0625, 0.125]),
                (1.5, 0.5, 1, [0.1875, 0.0625]),
                (0.75, 0.5, 3, [0.0625, 0.1875]),
            ] {
                let height = (a + b * x) * (c + d * y);
                let [wide, high] = sides.map(|side| side * (8.0 - height) / 8.0);
                let Spread { mean, covariance } = from_above(ground, [x, y], sides, columns).unwrap();
                let exact = [b * (c + d * y), d * (a + b * x)];
                for (got, exact) in mean.iter().zip(exact) {
                    assert!((value(*got) - exact).abs() < 2e-3, "{} {exact}", value(*got));
                }
                // p goes with y alone, q with x
                let exact = [high, wide].map(|side| (b * d * side).powi(2) / 12.0);
                let [pp, pq, qq] = covariance.map(value);
                let near = [pp, qq].iter().zip(exact).all(|(v, exact)| (v / exact - 1.0).abs() < 0.1);
                assert!(near, "{pp} {qq} {exact:?}");
                assert!(pq.abs() < exact[0].min(exact[1]) / 4.0, "{pq}");
            }
        });
    }

    /// A plane has its slopes wherever a pixel is seen from, and no variance.
    #[test]
    fn a_plane_has_its_slopes_from_anywhere() {
        with_ground([0.25, 0.5, 1.0, 0.0], |ground| {
            for [dx, dy] in [[0.5, 0.5], [-0.75, 0.25], [0.125, -0.5]] {
                let direction = [dx, dy, -0.75].map(|c: f64| (c * 268_435_456.0) as i32);
                // 4 before the place (1, 1)
                let eye = [1.0 - 4.0 * dx, 1.0 - 4.0 * dy, 0.75 + 3.0].map(bits);
                let sight = Sight { eye, direction };
                let slope = [bits(0.5), 0];
                let place =
                    Place { t: bits(4.0), at: [bits(1.0); 2], slope, steep: steepness(slope, direction) };
                let pixel = [[0.01, -0.01, 0.0], [-0.005, -0.005, -0.01]];
                let pixel = pixel.map(|edge| edge.map(|c: f64| (c * 268_435_456.0) as i32));
                let Spread { mean, covariance } =
                    spread(ground, &sight, pixel, place, (bits(0.25), 3)).unwrap();
                let [p, q] = mean.map(value);
                assert!((p - 0.5).abs() < 1e-4 && q.abs() < 1e-4, "{p} {q}");
                assert!(covariance.iter().all(|c| value(*c).abs() < 1e-5), "{covariance:?}");
            }
        });
    }

    /// A pixel of which a strip lies beyond the domain: an eighth to one side, a sixteenth before or behind.
    #[test]
    fn a_pixel_that_leaves_the_domain_is_none() {
        with_ground([0.25, 0.0, 1.0, 0.0], |ground| {
            let side = 0.125;
            // as wide as it is at the height of 1/4
            let half = side * (8.0 - 0.25) / 8.0 / 2.0;
            let outside = |part: f64| half - part * 2.0 * half;
            for (part, to_a_side, before) in
                [(0.0, true, true), (0.05, true, true), (0.075, true, false), (0.15, false, false)]
            {
                for columns in [3, 6] {
                    let at = outside(part);
                    let is_some = |place: [f64; 2]| from_above(ground, place, [side; 2], columns).is_some();
                    for (x, y) in [(at, 1.0), (2.0 - at, 1.0)] {
                        assert_eq!(is_some([x, y]), to_a_side, "{part} {columns}");
                    }
                    for (x, y) in [(1.0, at), (1.0, 2.0 - at)] {
                        assert_eq!(is_some([x, y]), before, "{part} {columns}");
                    }
                }
            }
        });
    }
}
