//! What a pixel covers of a height field: a parallelogram above the plane through the surface's mean, cut
//! into boxes along lines that follow the surface.
//!
//! A ray `eye + t d` that moves by `r` on the image plane moves along the plane with slopes `(p, q)` by
//! `t (r - d (n . r) / (n . d))`, `n = (-p, -q, 1)`: the pixel's edges `a` and `b`. The plane is the mean one
//! over a box of a pixel's width and a half, put where the ray through the pixel's centre meets it.
//!
//! The parallelogram is cut into columns and these into rows. Where a line between two rows lies `e` above
//! the surface's mean height along it, its rays meet the surface `e d / (-n . d)` farther: the line is moved
//! so. What a pixel loses at a line, its neighbour gains, and nothing is counted twice. Matt light has the
//! outline instead ([`super::outline`]). Each part has the variances `(a_x^2 + b_x^2) / 12` and `(a_y^2 +
//! b_y^2) / 12`; its box is the one with these. Formats: lengths and heights 24 fractional bits, directions
//! 28, parts of the domain 30.

use core::num::NonZeroU32;

use super::ground::{Ground, Side};
use super::slopes::{Slope, Slopes, spans, times};
use crate::num::{high, product, product_within, reciprocal_of, rough_sqrt, rounded_down};

/// Into how many boxes a pixel's footprint is cut, and so how much a pixel costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Quality {
    /// Two boxes; in diffuse light one, and no outline.
    Coarse,
    /// Ten boxes, in a mirror of a checkerboard six; in diffuse light an outline of eight corners.
    Fine,
    /// Twelve boxes; in diffuse light an outline of fourteen corners.
    Finest,
}

impl Quality {
    /// Parts of the shorter and of the longer edge; `few` where what each shows is smooth.
    #[inline(always)]
    pub(super) const fn parts(self, few: bool) -> [i32; 2] {
        match self {
            Self::Coarse => [1, 2],
            Self::Fine if few => [2, 3],
            Self::Fine => [2, 5],
            Self::Finest => [2, 6],
        }
    }

    /// Cells of a lattice in a pixel, or so.
    pub(super) const fn cells(self) -> i32 {
        match self {
            Self::Coarse => 2,
            Self::Fine => 8,
            Self::Finest => 12,
        }
    }

    /// Columns of an outline.
    #[inline(always)]
    pub(super) const fn columns(self) -> i32 {
        match self {
            Self::Coarse => 1,
            Self::Fine => 3,
            Self::Finest => 6,
        }
    }
}

/// A plane above the ground that a ray meets: where, its slopes, and their [`steepness`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) t: i32,
    pub(super) at: [i32; 2],
    pub(super) slope: Slope,
    pub(super) steep: i32,
}

/// A ray from the eye.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    pub(super) eye: [i32; 3],
    pub(super) direction: [i32; 3],
}

/// `-n . v` in the format of `v`: how much `v` goes into the surface.
#[inline(always)]
pub(super) fn into([p, q]: Slope, [x, y, z]: [i32; 3]) -> i64 {
    ((product(p, x) + product(q, y)) >> 24) - i64::from(z)
}

/// The reciprocal of how much a ray goes into a plane, which is seen at no flatter an angle than some 4
/// degrees: 25 fractional bits.
#[inline(always)]
pub(super) fn steepness(slope: Slope, direction: [i32; 3]) -> i32 {
    let ([p, q], [x, y, z]) = (slope, direction);
    // 20 fractional bits; a 32nd of |p| + |q| + 1 at least
    let steep = (((product(p, x) + product(q, y)) >> 32) as i32).wrapping_sub(z >> 8);
    let least = (p.unsigned_abs().wrapping_add(q.unsigned_abs()).wrapping_add(1 << 24)) >> 9;
    let steep = NonZeroU32::new(steep.max(least as i32) as u32).unwrap_or(NonZeroU32::MIN);
    let (mantissa, zeros) = reciprocal_of(steep);
    // at most 16 zeros
    mantissa >> (17_u32.wrapping_sub(zeros) & 31)
}

/// `v / g` for a reciprocal of `g` with 25 fractional bits, in the format of `v`, saturated at half of it
/// (its last 8 bits are not).
#[inline(always)]
pub(super) fn over(v: i32, per: i32) -> i32 {
    product_within::<7>(v, per) >> 1
}

impl Sight {
    /// The place at a parameter.
    #[inline(always)]
    pub(super) fn at(&self, t: i32) -> [i32; 3] {
        let ([x, y, z], [dx, dy, dz]) = (self.eye, self.direction);
        let along = |from: i32, by: i32| from.wrapping_add(rounded_down::<28>(product(by, t)));
        [along(x, dx), along(y, dy), along(z, dz)]
    }

    /// Where the ray meets the plane with slopes `slope` through `height` above `at`, no further than `reach`
    /// from `t`.
    #[inline(always)]
    pub(super) fn meet(&self, t: i32, slope: Slope, above: i32, reach: i32) -> Place {
        let steep = steepness(slope, self.direction);
        let off = over(above, steep);
        let t = t.wrapping_add(off.max(reach.wrapping_neg()).min(reach));
        let [x, y, _] = self.at(t);
        Place { t, at: [x, y], slope, steep }
    }
}

/// A pixel's edges along the plane that its ray meets, saturated at ±64.
#[inline(always)]
pub(super) fn edges(place: &Place, sight: &Sight, edges: [[i32; 3]; 2]) -> [[i32; 2]; 2] {
    let [dx, dy, _] = sight.direction;
    let [right, down] = edges;
    let moved = |r: [i32; 3]| {
        // n . r / n . d
        let along = over(into(place.slope, r) as i32, place.steep);
        let moved = |r: i32, d: i32| times((r >> 4).wrapping_sub(high(d, along)), place.t);
        [moved(r[0], dx), moved(r[1], dy)]
    };
    [moved(right), moved(down)]
}

/// The sides of the box with the variances of a parallelogram, and how far its places deviate; one half in
/// `2^firm` of a side may lie outside.
#[inline(always)]
pub(super) fn sides(ground: &[Ground<'_>; 2], [a, b]: [[i32; 2]; 2], firm: u32) -> ([i32; 2], [Side; 2]) {
    let half = |s: i32, t: i32| (rough_sqrt((product(s, s) + product(t, t)) as u64) >> 1) as i32;
    let half = [half(a[0], b[0]), half(a[1], b[1])];
    let [x, y] = ground;
    (spans(half), [x.side(half[0], firm), y.side(half[1], firm)])
}

/// A number where `rest` is left beyond it in a word, the nearer end otherwise: cut off at both ends of the
/// word.
#[inline(always)]
const fn within(v: i32, rest: i32) -> i32 {
    v.saturating_add(rest).saturating_sub(rest).saturating_sub(rest).saturating_add(rest)
}

/// A place on the plane that a pixel's rays meet: in parts of the domain, and how high; or the way from one
/// to another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    pub(super) at: [i32; 2],
    pub(super) height: i32,
}

impl Spot {
    /// The way along a plane with these slopes.
    #[inline(always)]
    pub(super) fn along([x, y]: &[Ground<'_>; 2], [p, q]: Slope, [u, v]: [i32; 2]) -> Self {
        Self { at: [x.part(u), y.part(v)], height: ((product(p, u) + product(q, v)) >> 24) as i32 }
    }

    #[inline(always)]
    pub(super) fn plus(self, way: Self) -> Self {
        let ([x, y], [u, v]) = (self.at, way.at);
        Self { at: [x.wrapping_add(u), y.wrapping_add(v)], height: self.height.wrapping_add(way.height) }
    }

    #[inline(always)]
    pub(super) fn minus(self, way: Self) -> Self {
        let at = way.at.map(i32::wrapping_neg);
        self.plus(Self { at, height: way.height.wrapping_neg() })
    }
}

/// How rays go on from where they meet the plane: a line `above` the surface moves along its rays.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ways {
    /// How far, for a height times `up`, a power of two.
    farther: [i32; 2],
    up: i32,
    /// What is left of a word beyond as far above or below the surface as a line is thought to lie at most.
    rest: i32,
}

impl Ways {
    #[inline(always)]
    pub(super) fn new([x, y]: &[Ground<'_>; 2], sight: &Sight, steep: i32, reach: i32) -> Self {
        let [dx, dy, _] = sight.direction;
        let up = reach.leading_zeros().saturating_sub(1).min(30);
        let farther = [x.factor(over(dx, steep) >> 2, up), y.factor(over(dy, steep) >> 2, up)];
        Self { farther, up: 1 << up, rest: i32::MAX - reach }
    }

    /// How far a place on the plane is moved to the surface: to where its ray meets that at the height which
    /// it has at the place.
    #[inline(always)]
    pub(super) fn moved(&self, [x, y]: &[Ground<'_>; 2], Spot { at: [u, v], height }: Spot) -> [i32; 2] {
        let surface = rounded_down::<24>(product(x.value(u), y.value(v)));
        let above = within(height.saturating_sub(surface), self.rest).wrapping_mul(self.up);
        [high(above, self.farther[0]), high(above, self.farther[1])]
    }
}

/// A pixel's footprint, how it is cut, and the part that comes next.
#[derive(Debug, Clone, Copy)]
pub(super) struct Footprint {
    /// From a column to the next and from a line to the next.
    steps: [Spot; 2],
    parts: [i32; 2],
    ways: Ways,
    spans: [i32; 2],
    sides: [Side; 2],
    /// The end of a column's first line.
    first: Spot,
    /// The last line, how many come behind it, and where its rays meet the surface.
    line: Spot,
    left: i32,
    before: [i32; 2],
}

impl Footprint {
    /// How far the places of a box deviate from its middle.
    pub(super) const fn spans(&self) -> [i32; 2] {
        self.spans
    }

    /// Columns and rows.
    pub(super) const fn parts(&self) -> [i32; 2] {
        self.parts
    }

    /// How many parts.
    pub(super) const fn count(&self) -> i32 {
        self.parts[0].wrapping_mul(self.parts[1])
    }

    /// Where the rays of the last line meet the surface: at its middle.
    #[inline(always)]
    fn met(&self, ground: &[Ground<'_>; 2]) -> [i32; 2] {
        let ([u, v], [x, y]) = (self.line.at, self.ways.moved(ground, self.line));
        [u.wrapping_add(x), v.wrapping_add(y)]
    }

    /// The next part; none where it leaves the domain.
    #[inline(never)]
    pub(super) fn next(&mut self, ground: &[Ground<'_>; 2], slopes: &mut Slopes) -> Option<()> {
        let [column, row] = self.steps;
        if self.left == 0 {
            self.left = self.parts[1];
            self.line = self.first;
            self.first = self.first.plus(column);
            self.before = self.met(ground);
        }
        self.left = self.left.wrapping_sub(1);
        self.line = self.line.plus(row);
        let ([u, v], [s, t]) = (self.before, self.met(ground));
        self.before = [s, t];
        slopes.around(ground, [(u >> 1) + (s >> 1), (v >> 1) + (t >> 1)], &self.sides)
    }
}

/// One of `n` parts, `n` up to 6.
#[inline(always)]
pub(super) fn cut(v: [i32; 2], n: i32) -> [i32; 2] {
    /// `2^31 / n`.
    const PART: [i32; 7] = [0, i32::MAX, 1 << 30, 0x2aaa_aaab, 1 << 29, 0x1999_999a, 0x1555_5555];
    let part = PART.get(n as usize).copied().unwrap_or(0);
    [high(v[0], part) << 1, high(v[1], part) << 1]
}

/// Half of the box above which a pixel's mean plane is taken: three quarters of a pixel, of which eight are
/// within reach.
#[inline(always)]
fn near([x, y]: &[Ground<'_>; 2], reach: i32) -> [Side; 2] {
    let half = (reach >> 4) + (reach >> 5);
    [x.side(half, 0), y.side(half, 0)]
}

/// Where a ray meets the mean plane above such a box around `from`, or around the place nearest to it in the
/// domain.
#[inline(always)]
pub(super) fn on_mean(
    [x, y]: &[Ground<'_>; 2],
    sight: &Sight,
    from: Place,
    near: &[Side; 2],
    reach: i32,
) -> Option<Place> {
    let [px, py] = from.at;
    let slopes = Slopes { x: x.nearest(x.place(px), &near[0])?, y: y.nearest(y.place(py), &near[1])? };
    let [_, _, z] = sight.at(from.t);
    Some(sight.meet(from.t, slopes.mean(), z.wrapping_sub(slopes.height()), reach))
}

/// The surface over the box of a pixel around where its ray meets the mean plane, and how far its places
/// deviate: none where too much of it leaves the domain.
#[inline(always)]
pub(super) fn whole(
    ground: &[Ground<'_>; 2],
    sight: &Sight,
    pixel: [[i32; 3]; 2],
    place: &Place,
) -> Option<(Slopes, [i32; 2])> {
    let (spans, sides) = sides(ground, edges(place, sight, pixel), 3);
    let ([x, y], [px, py]) = (ground, place.at);
    let mut slopes = Slopes::default();
    slopes.around(ground, [x.place(px), y.place(py)], &sides)?;
    Some((slopes, spans))
}

/// Where a pixel's ray meets the mean plane above a box around where it meets that of the leaf, which may lie
/// far off: three quarters of a pixel to both sides.
#[inline(always)]
pub(super) fn settled(ground: &[Ground<'_>; 2], sight: &Sight, first: Place, reach: i32) -> Option<Place> {
    on_mean(ground, sight, first, &near(ground, reach), reach)
}

impl Quality {
    /// The footprint of a pixel around where its ray meets the mean plane.
    #[inline(always)]
    pub(super) fn footprint(
        self,
        ground: &[Ground<'_>; 2],
        sight: &Sight,
        pixel: [[i32; 3]; 2],
        place: &Place,
        (reach, few): (i32, bool),
    ) -> Footprint {
        let [x, y] = ground;
        let [a, b] = edges(place, sight, pixel);
        // more parts along the longer edge
        let length = |[x, y]: [i32; 2]| product(x, x) + product(y, y);
        let [few, many] = self.parts(few);
        let parts = if length(a) > length(b) { [many, few] } else { [few, many] };
        let [a, b] = [cut(a, parts[0]), cut(b, parts[1])];
        let (spans, sides) = sides(ground, [a, b], if few.wrapping_mul(many) > 2 { 1 } else { 2 });
        let (a, b) = (Spot::along(ground, place.slope, a), Spot::along(ground, place.slope, b));
        // from the middle to the end of the first line
        let back =
            |a: i32, b: i32| (a.wrapping_mul(parts[0] - 1)).wrapping_add(b.wrapping_mul(parts[1])) >> 1;
        let at = [
            x.place(place.at[0]).wrapping_sub(back(a.at[0], b.at[0])),
            y.place(place.at[1]).wrapping_sub(back(a.at[1], b.at[1])),
        ];
        let [_, _, z] = sight.at(place.t);
        let first = Spot { at, height: z.wrapping_sub(back(a.height, b.height)) };
        Footprint {
            steps: [a, b],
            parts,
            ways: Ways::new(ground, sight, place.steep, reach),
            spans,
            sides,
            first,
            line: first,
            left: 0,
            before: at,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_height_is_cut_off_where_it_is_out_of_reach() {
        for reach in [0, 1, 77, 1 << 20, (1 << 30) - 1, 1 << 30] {
            let ends = [reach - 1, reach, reach + 1].into_iter().flat_map(|end| [end, -end, -end - 1]);
            for v in ends.chain([0, 5, -5, i32::MIN, i32::MAX]) {
                assert_eq!(within(v, i32::MAX - reach), v.clamp(-reach - 1, reach), "{v} {reach}");
            }
            // and what a line is moved by stays in its word
            let up = i64::from(1_i32 << reach.leading_zeros().saturating_sub(1).min(30));
            let most = [i64::from(-reach - 1), reach.into()].map(|end| end * up);
            assert!(most.iter().all(|end| i32::try_from(*end).is_ok()), "{reach}");
        }
    }

    #[test]
    fn a_part_of_a_length_is_a_part_of_it() {
        for n in 1..=6 {
            for v in [0, 1, -1, 77, 1_234_567, -7_654_321, 1 << 30, -(1 << 30)] {
                let off = cut([v, -v], n).map(|part| i64::from(part) * i64::from(n));
                let most = 2 * i64::from(n) + 2;
                assert!(
                    (off[0] - i64::from(v)).abs() <= most && (off[1] + i64::from(v)).abs() <= most,
                    "{v} {n}"
                );
            }
        }
    }
}
