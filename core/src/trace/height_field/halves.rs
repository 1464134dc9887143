//! The walk through a hierarchy whose nodes have two equal parts along each axis: a quadtree, the ordinary
//! case.
//!
//! It finds the first leaf that a ray meets, going from part to part in the order in which the ray passes
//! above them, and is used wherever both factors have two maps with the knot between them in the middle;
//! [`super::parts`] walks everything else and finds the same leaves. What is gained is that equal parts need
//! neither a stack nor a table of planes:
//!
//! - The number of a node along an axis, plus 1, is a 1 followed by one binary digit a level: 0 for the lower
//!   part of the node above, 1 for the upper. So the nodes that contain a node need not be remembered: they
//!   are the number without its last digits. The walk carries the plane at which the ray enters the node:
//!   the same digits along the ray's way, and zeros up to 32; the number is made of it for each test.
//! - A ray passes the nearer part of a node first, then the farther one, then leaves the node. When it leaves
//!   a node whose place ends in `k` digits that say "farther", it leaves the `k` nodes around it at the same
//!   plane, and the walk rises by `k` levels at once.
//! - With `u` a plane's place across the surface the way the ray goes, from -1/2 to 1/2, the ray crosses it
//!   at `t = middle + whole u`, `middle` the parameter in the middle of the surface and `whole` what the ray
//!   takes across it: one multiplication a plane, at every level.
//! - Boxes lie inside the box of the node that they are parts of, and so do the ray's heights above them: a
//!   ray that misses a node misses its parts. So no box but a leaf's has to be tested, the others are where
//!   it pays. It does not pay where the ray is nearly certain to meet the box: at the first part of the
//!   surface, at the part that a ray enters when it comes out of a node that it has met, and at the far one
//!   of four, as it has met the node and none of the other parts. There the walk goes into the node at once.
//!
//! Of a node's four parts a ray passes at most three. Parameters have 24 fractional bits in 32. A ray so
//! nearly parallel to a plane, or so steep, that it leaves that range above the surface is left to the
//! general walk.
//!
//! After J. Revelles, C. Urena, M. Lastra, "An efficient parametric algorithm for octree traversal", 2000.

use core::num::NonZeroU32;

use super::super::ray::{Footprint, Ray, parameters};
use super::boxes::meets_bits;
use super::hierarchy::{Hierarchy, Leaf, Profile};
use super::statistics::Count;

/// When the ray crosses the planes along one axis: `t = middle + whole u`.
#[derive(Debug, Clone, Copy)]
struct Crossings {
    /// Parameter at the middle plane of the surface.
    middle: i32,
    /// Twice `whole`, what the ray takes across the surface.
    twice: i32,
    /// The digits in which a node's number differs from its place on the ray's way: all of them if the ray
    /// comes from above, and the second of two parts is its first.
    flip: u32,
}

/// The node in which a walk stands, along one axis: the slab of space between its two planes.
#[derive(Debug, Clone, Copy)]
struct Slab {
    /// The plane at which the ray enters it: a 1, and the way there from the surface's near plane as 31
    /// binary digits.
    begin: u32,
    /// The parameter at the plane at which the ray leaves it.
    next: i32,
}

impl Crossings {
    /// None where a parameter might leave its format.
    #[inline(always)]
    fn new(middle: &Middle, direction: i32) -> Option<Self> {
        let magnitude = direction.unsigned_abs();
        if magnitude <= middle.least {
            return None;
        }
        let distance = if direction < 0 { middle.distance.wrapping_neg() } else { middle.distance };
        let [middle, whole] = parameters([distance, middle.width], NonZeroU32::new(magnitude)?);
        Some(Self { middle, twice: whole << 1, flip: (direction >> 31) as u32 >> 1 })
    }

    /// The parameter at a plane, given as [`Slab::begin`]; the far plane of the surface is 0.
    #[inline(always)]
    fn at(&self, plane: u32) -> i32 {
        // from -1/2 to 1/2, 31 fractional bits
        let u = plane.wrapping_add(1 << 30) as i32;
        self.middle.wrapping_add(((i64::from(self.twice) * i64::from(u)) >> 32) as i32)
    }

    /// The parameter at the surface's near plane.
    #[inline(always)]
    fn near(&self) -> i32 {
        self.middle.wrapping_add(self.twice.wrapping_neg() >> 2)
    }

    /// The number of the node that begins at a plane and is `2^shift` wide.
    #[inline(always)]
    fn node(&self, begin: u32, shift: u32) -> u32 {
        ((begin ^ self.flip) >> (shift & 31)).wrapping_sub(1)
    }
}

impl Slab {
    #[inline(always)]
    fn root(planes: &Crossings) -> Self {
        Self { begin: 1 << 31, next: planes.middle.wrapping_add(planes.twice >> 2) }
    }

    /// From the whole surface into the half in which the ray is at `t`.
    #[inline(always)]
    fn halve(&mut self, planes: &Crossings, t: i32) {
        if planes.middle > t {
            self.next = planes.middle;
        } else {
            self.begin = 3 << 30;
        }
    }

    /// Into the part, `size` wide, in which the ray is at `t`.
    #[inline(always)]
    fn descend(&mut self, planes: &Crossings, size: u32, t: i32) {
        let middle = self.begin.wrapping_add(size);
        let next = planes.at(middle);
        if next > t {
            self.next = next;
        } else {
            self.begin = middle;
        }
    }

    /// Over the plane at its end, into the next node, and out of the nodes, `2^shift` wide, that end there
    /// too. Whether the ray surely meets the box of the next node; none at the end of the surface.
    #[inline(always)]
    fn advance(
        &mut self,
        planes: &Crossings,
        aside: &mut Self,
        planes_aside: &Crossings,
        shift: &mut u32,
    ) -> Option<bool> {
        let size = 1 << (*shift & 31);
        self.begin = self.begin.wrapping_add(size);
        let mut end = self.begin.wrapping_add(size);
        // far along both axes: of the parts of the node above there is no other left
        let mut surely = aside.begin & size != 0;
        if self.begin & size == 0 {
            surely = true;
            // the node was the far part of those that end here
            *shift = NonZeroU32::new(self.begin)?.trailing_zeros();
            let size = 1_u32 << (*shift & 31);
            end = self.begin.wrapping_add(size);
            aside.begin &= size.wrapping_neg();
            aside.next = planes_aside.at(aside.begin.wrapping_add(size));
        }
        self.next = planes.at(end);
        Some(surely)
    }
}

/// Where the middle plane across an axis of a surface is, seen from the origin of rays.
#[derive(Debug, Clone, Copy)]
struct Middle {
    /// How far away, and the width of the surface: 24 fractional bits.
    distance: i32,
    width: i32,
    /// A direction of more than this magnitude crosses every plane at a parameter that fits.
    least: u32,
}

impl Middle {
    fn new(profile: &Profile<'_>, origin: i32) -> Self {
        let width = profile.width;
        let distance = (profile.origin + width / 2).wrapping_sub(origin);
        // distance / magnitude, with 24 and 28 fractional bits, is below 64
        Self { distance, width, least: distance.unsigned_abs().max(width.unsigned_abs()) >> 2 }
    }
}

/// What all rays of one footprint that leave one point share, made ready for walks through one surface.
/// `WIDE` where their cones have a width at that point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pencil<const WIDE: bool = false> {
    /// 24 fractional bits.
    pub(crate) origin: [i32; 3],
    pub(crate) footprint: Footprint,
    detail: LevelOfDetail,
    x: Middle,
    y: Middle,
}

impl<const WIDE: bool> Pencil<WIDE> {
    /// The ray in this direction, 28 fractional bits.
    #[inline(always)]
    pub(crate) fn ray(&self, direction: &[i32; 3]) -> Ray {
        Ray::from_bits(self.origin, *direction)
    }
}

/// From where on the nodes of one surface are no wider than a footprint.
#[derive(Debug, Clone, Copy)]
struct LevelOfDetail {
    /// From where on the whole surface is small: twice that parameter less its last `shift` bits.
    small: u32,
    shift: u32,
    /// How far the cone's tip is behind the ray's start, without these bits.
    begin: u32,
}

impl LevelOfDetail {
    /// Whether a node, `2^shift` wide where the whole surface is `2^31`, is no wider than the footprint at
    /// `t`.
    #[inline(always)]
    fn is_reached<const WIDE: bool>(&self, shift: u32, t: i32) -> bool {
        // halved first, once for all nodes
        let small = (self.small >> 1) >> ((shift & 31) ^ 31);
        let t = (t >> (self.shift & 31)) as u32;
        // both below 2^31
        if WIDE { t.wrapping_add(self.begin) >= small } else { t >= small }
    }
}

impl Hierarchy<'_> {
    /// The rays with this footprint that leave `origin` (24 fractional bits).
    pub(crate) fn pencil<const WIDE: bool>(&self, origin: [i32; 3], footprint: Footprint) -> Pencil<WIDE> {
        let [x, y, _] = origin;
        Pencil {
            origin,
            footprint,
            detail: self.level_of_detail::<WIDE>(footprint),
            x: Middle::new(&self.x, x),
            y: Middle::new(&self.y, y),
        }
    }

    fn level_of_detail<const WIDE: bool>(&self, footprint: Footprint) -> LevelOfDetail {
        let begin = if WIDE { footprint.begin() } else { 0 };
        let small = footprint.length(self.x.width.max(self.y.width));
        // at most 31: a width has 31 bits, the reciprocal of a footprint 32
        let shift = 33_u32.saturating_sub(small.leading_zeros());
        let begin = (begin >> shift).min(i64::from(i32::MAX)) as u32;
        LevelOfDetail { small: ((small >> shift) << 1) as u32, shift, begin }
    }

    /// The first leaf that the ray in this direction (28 fractional bits) meets.
    #[inline(never)]
    pub(crate) fn walk_halves<const WIDE: bool>(
        &self,
        pencil: &Pencil<WIDE>,
        direction: &[i32; 3],
        count: &mut impl Count,
    ) -> Option<Leaf> {
        let ([_, _, oz], [dx, dy, dz]) = (pencil.origin, *direction);
        let (Some(planes_x), Some(planes_y)) = (Crossings::new(&pencil.x, dx), Crossings::new(&pencil.y, dy))
        else {
            return self.walk_parts(&pencil.ray(direction), pencil.footprint, count);
        };
        let (mut x, mut y) = (Slab::root(&planes_x), Slab::root(&planes_y));
        let z_at = |t: i32| oz.wrapping_add(((i64::from(dz) * i64::from(t)) >> 28) as i32);
        let end = x.next.min(y.next);
        if !(-1 << 26..1 << 26).contains(&(((i64::from(dz) * i64::from(end)) >> 32) as i32)) {
            // 64 or more upwards or downwards
            return self.walk_parts(&pencil.ray(direction), pencil.footprint, count);
        }
        count.ray();
        let mut t = planes_x.near().max(planes_y.near()).max(0);
        if t > end {
            return None;
        }
        // on to where the ray enters the range of all heights
        let (low, high) = self.heights;
        let (z_end, outside, misses) = match z_at(end) {
            z if dz < 0 => (z, oz - high, z > high),
            z => (z, low - oz, z < low),
        };
        if outside > 0 {
            if misses {
                return None;
            }
            let [entry] = parameters([outside], NonZeroU32::new(dz.unsigned_abs())?);
            t = t.max(entry.min(end));
        }
        let mut z = z_at(t);
        if (z < low && z_end < low) || (z > high && z_end > high) {
            return None;
        }
        let (cells_x, cells_y) = (self.x.cells, self.y.cells);
        // a node is 2^shift wide, a leaf `2^last` or small
        let last = 31_u32.wrapping_sub(self.depth) & 31;
        let is_leaf = |shift: u32, t: i32| shift <= last || pencil.detail.is_reached::<WIDE>(shift, t);
        if is_leaf(31, t) {
            return Some(Leaf { nodes: (0, 0), span: (t, end) });
        }
        x.halve(&planes_x, t);
        y.halve(&planes_y, t);
        let mut shift = 30;
        count.depth(1);
        // a box is tested where it is not taken for met
        let mut met = !is_leaf(shift, t);
        loop {
            while !met {
                let z_next = z_at(x.next.min(y.next));
                let f = cells_x.get(planes_x.node(x.begin, shift) as usize)?;
                let g = cells_y.get(planes_y.node(y.begin, shift) as usize)?;
                count.test();
                if meets_bits(f, g, z, z_next) {
                    if is_leaf(shift, t) {
                        let nodes = (planes_x.node(x.begin, shift), planes_y.node(y.begin, shift));
                        return Some(Leaf { nodes, span: (t, x.next.min(y.next)) });
                    }
                    break;
                }
                z = z_next;
                let surely = if x.next <= y.next {
                    t = x.next;
                    x.advance(&planes_x, &mut y, &planes_y, &mut shift)?
                } else {
                    t = y.next;
                    y.advance(&planes_y, &mut x, &planes_x, &mut shift)?
                };
                met = surely && !is_leaf(shift, t);
            }
            met = false;
            shift = shift.wrapping_sub(1) & 31;
            x.descend(&planes_x, 1 << shift, t);
            y.descend(&planes_y, 1 << shift, t);
            count.depth(31 - shift);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::exact::{Fraction, Surface, first_leaf};
    use super::super::statistics::Statistics;
    use super::*;
    use crate::fif::Cell;
    use crate::num::{Real, Unit};

    const HALVES: [u32; 2] = [0, 1 << 30];
    /// `u` = 1/2.
    const HALF: i32 = 1 << 30;

    /// Down to the deepest level.
    fn walk_down(hierarchy: &Hierarchy<'_>, ray: &Ray) -> Option<Leaf> {
        let pencil: Pencil = hierarchy.pencil(ray.origin, Footprint::new(Unit::DELTA));
        hierarchy.walk_halves(&pencil, &ray.direction, &mut Statistics::default())
    }

    /// A plane as a walk names it.
    fn plane(u: i32) -> u32 {
        u.wrapping_sub(HALF) as u32
    }

    /// Against fractions: the leaf, its span, and every box that is tested on the way.
    #[test]
    fn the_first_leaf_of_equal_parts_is_the_exact_one() {
        let (mut found, mut missed, mut small, mut close, mut worst, mut left) = (0, 0, 0, 0, 0, 0);
        let (mut spared, mut tested) = (0, 0);
        for (seed, (depth, domain)) in [
            (4, [[-(1 << 23), (1 << 24) + 1], [1 << 20, 15_000_001]]),
            (3, [[-(1 << 24), 3 << 23], [-(5 << 24), 9_999_999]]),
            (1, [[0, 1 << 24], [-(1 << 24), 1 << 23]]),
            (0, [[0, 1 << 24], [-(1 << 24), 1 << 24]]),
        ]
        .into_iter()
        .enumerate()
        {
            let surface = Surface::new([&HALVES; 2], depth, domain, 7 + seed as u64);
            let hierarchy = surface.hierarchy();
            for (k, mut ray) in surface.rays(99 + seed as u64, 4000).enumerate() {
                if k % 16 == 0 {
                    // nearly parallel to a plane: what the general walk is for
                    ray.direction[k / 16 % 2] >>= 7;
                }
                let per_t = [1, 1 << 26, 1 << 28][k % 3];
                let clipped = is_left_to_the_general_walk(&hierarchy, &ray);
                left += usize::from(clipped);
                let truth = first_leaf(&hierarchy, &ray, per_t, clipped);
                let every = first_leaf(&hierarchy, &ray, per_t, true);
                if truth.is_close || every.is_close {
                    close += 1;
                    continue;
                }
                // the same leaf whether or not boxes are spared
                assert_eq!(truth.nodes, every.nodes, "{ray:?} {truth:?}");
                spared +=
                    every.statistics.box_tests - truth.statistics.box_tests.min(every.statistics.box_tests);
                tested += every.statistics.box_tests;
                let mut statistics = Statistics::default();
                let pencil: Pencil = hierarchy.pencil(ray.origin, Footprint::new(Unit::from_bits(per_t)));
                let leaf = hierarchy.walk_halves(&pencil, &ray.direction, &mut statistics);
                assert_eq!(leaf.as_ref().map(|leaf| leaf.nodes), truth.nodes, "{ray:?} {truth:?}");
                let stack = if clipped { truth.unfinished } else { truth.statistics.stack };
                assert_eq!(statistics, Statistics { stack, ..truth.statistics }, "{ray:?} {truth:?}");
                let Some(leaf) = leaf else {
                    missed += 1;
                    continue;
                };
                found += 1;
                small += usize::from(leaf.nodes.0 < hierarchy.leaves);
                worst = worst.max(truth.error(leaf.span, &ray));
            }
        }
        assert!(
            found > 3000 && missed > 1000 && small > 500 && close < 500,
            "{found} {missed} {small} {close}"
        );
        // four units: a parameter is off by one or two, and a direction is up to 4
        assert!((16..=64).contains(&worst) && left > 1000, "{worst} {left}");
        assert!(8 * spared > tested, "{spared} of {tested} boxes were not tested");
    }

    /// Whether a parameter or a height leaves its format above the surface.
    fn is_left_to_the_general_walk(hierarchy: &Hierarchy<'_>, ray: &Ray) -> bool {
        let mut end = i128::MAX;
        for (axis, profile) in [hierarchy.x, hierarchy.y].iter().enumerate() {
            let (origin, d) = (i128::from(ray.origin[axis]), i128::from(ray.direction[axis]));
            let (low, width) = (i128::from(profile.origin), i128::from(profile.width));
            let distance = low + width / 2 - origin;
            // 64 or more
            if d == 0 || distance.abs().max(width) << 4 >= d.abs() << 6 {
                return true;
            }
            let far = if d > 0 { low + width } else { low };
            end = end.min(((far - origin) << 28) / d);
        }
        let rise = (i128::from(ray.direction[2]) * end) >> 28;
        !(-64 << 24..64 << 24).contains(&rise)
    }

    /// A ray that starts on a plane is above the part that it goes into, not above the one that it leaves.
    #[test]
    fn a_part_ends_before_its_far_plane() {
        let cell = |max: i32| Cell { max: Real::from_bits(max), ..Cell::ZERO };
        let (tall, flat) = (cell(1 << 24), cell(1 << 20));
        for (low, high, direction) in [(tall, flat, 1 << 28), (flat, tall, -(1 << 28))] {
            for axis in 0..2 {
                let (walked, other) = ([tall, low, high], [tall; 3]);
                let profile = |cells, origin| Profile { cells, starts: &HALVES, origin, width: 1 << 24 };
                let [x, y] = if axis == 0 { [&walked, &other] } else { [&other, &walked] };
                // the planes between the parts at 0, and the ray in the middle of a part along the other axis
                let origins = if axis == 0 { [-(1 << 23), 0] } else { [0, -(1 << 23)] };
                let (x, y) = (profile(x, origins[0]), profile(y, origins[1]));
                let hierarchy = Hierarchy { x, y, depth: 1, leaves: 1, heights: (0, (1 << 24) + 1) };
                let mut ray = Ray::from_bits([1 << 22, 1 << 22, 1 << 23], [1 << 27, 1 << 27, 0]);
                (ray.origin[axis], ray.direction[axis]) = (0, direction);
                let walk = |ray: &Ray| walk_down(&hierarchy, ray);
                assert_eq!(walk(&ray), None, "{axis} {direction}");
                ray.direction[axis] = -direction;
                let part = if direction > 0 { 1 } else { 2 };
                let nodes = walk(&ray).unwrap().nodes;
                assert_eq!(nodes, if axis == 0 { (part, 1) } else { (1, part) });
                // two units before the plane it is not over yet
                (ray.origin[axis], ray.direction[axis]) = (-2 * direction.signum(), direction);
                let leaf = walk(&ray).unwrap();
                assert_eq!(leaf.nodes, nodes, "{axis} {direction}");
                assert!((1..=2).contains(&leaf.span.1), "{:?}", leaf.span);
            }
        }
    }

    /// Parameters of planes against fractions; none exactly where the middle or the width is 64 or more away.
    #[test]
    fn planes_are_crossed_when_they_should_be() {
        let (mut worst, mut crossed, mut none) = (0, 0, 0);
        for (origin, width) in
            [(-(1 << 23), 1 << 24), (5 << 24, 12_345_678), (-(64 << 24), i32::MAX - 1), (3, 2)]
        {
            for from in [-(64 << 24) + 1, -77_777, 0, 1 << 24, 40_000_001, 64 << 24] {
                let middle = i64::from(origin) + i64::from(width / 2) - i64::from(from);
                let limit = (middle.abs().max(i64::from(width)) >> 2) as i32;
                for d in
                    [1 << 30, 1 << 28, 123_456_789, 1 << 24, limit.saturating_add(1), limit, limit - 1, 77]
                {
                    for direction in [d, -d] {
                        let profile = Profile { cells: &[], starts: &HALVES, origin, width };
                        let planes = Crossings::new(&Middle::new(&profile, from), direction);
                        assert_eq!(planes.is_none(), d <= limit, "{origin} {width} {from} {direction}");
                        let Some(planes) = planes else {
                            none += 1;
                            continue;
                        };
                        let forward = i128::from(direction.signum());
                        for u in [-HALF, -HALF / 2, -77_777, 0, 3 << 27, HALF] {
                            let place =
                                (i128::from(middle) << 31) + i128::from(width) * i128::from(u) * forward;
                            let exact = Fraction::new(place, i128::from(direction) << 3);
                            let got = Fraction::new(planes.at(plane(u)).into(), 1);
                            while !exact.is_within(worst, got) {
                                worst += 1;
                            }
                        }
                        crossed += 1;
                        assert_eq!(planes.near(), planes.at(plane(-HALF)));
                        let root = Slab::root(&planes);
                        assert_eq!((root.begin, root.next), (plane(-HALF), planes.at(plane(HALF))));
                        assert_eq!(planes.node(root.begin, 31), 0);
                        // the lower half is the first from below, the second from above
                        let lower = if direction > 0 { plane(-HALF) } else { plane(0) };
                        assert_eq!([lower, lower ^ 1 << 30].map(|begin| planes.node(begin, 30)), [1, 2]);
                    }
                }
            }
        }
        assert!(crossed > 100 && none > 100, "{crossed} {none}");
        // the reciprocal's 2^-29 of a parameter below 64 is 2 units
        assert!((2..=6).contains(&worst), "{worst}");
    }

    /// Nodes are small from the parameter on where the footprint is as wide, early by what the kept bits do
    /// not tell.
    #[test]
    fn a_node_is_small_where_the_footprint_is_as_wide() {
        let (mut worst, mut tried) = (0.0_f64, 0);
        for width in [1 << 24, 9_999_999, 3 << 25, i32::MAX, 1, 77_777] {
            for per_t in [1, 77, 1 << 10, 123_457, 1 << 26, 1 << 29, 777_777_777, i32::MAX] {
                let profile = |width| Profile { cells: &[], starts: &HALVES, origin: 0, width };
                // the wider side counts
                let (x, y) = (profile(width), profile(width / 3));
                let (x, y) = if per_t % 2 == 0 { (x, y) } else { (y, x) };
                let hierarchy = Hierarchy { x, y, depth: 16, leaves: 0, heights: (0, 0) };
                let detail = hierarchy.level_of_detail::<false>(Footprint::new(Unit::from_bits(per_t)));
                for level in 0..=16 {
                    let exact = i128::from(width) << 30;
                    let under = i128::from(per_t) << level;
                    let kept =
                        (exact / i128::from(per_t)).checked_ilog2().map_or(0, |b| b.saturating_sub(30));
                    let (mut low, mut high) = (0_i64, 1 << 31);
                    while low < high {
                        let t = (low + high) / 2;
                        if detail.is_reached::<false>(31 - level, t as i32) { high = t } else { low = t + 1 }
                    }
                    let early = exact - i128::from(low) * under;
                    if low == 1 << 31 {
                        assert!(early > -under, "{width} {per_t} {level}");
                        continue;
                    }
                    tried += 1;
                    let unit = under << kept;
                    assert!(early >= 0, "{width} {per_t} {level}: {low}");
                    worst = worst.max((early - (exact >> 28)) as f64 / unit as f64);
                }
            }
        }
        assert!(tried > 300 && (0.5..1.0).contains(&worst), "{worst} of {tried}");
    }

    /// The same for a cone that is wide where the ray starts: as if it had started at its tip.
    #[test]
    fn a_node_is_small_earlier_where_the_cone_is_wide_already() {
        let (mut tried, mut reached) = (0, 0);
        for width in [1 << 24, 9_999_999, 3 << 25, 77_777] {
            for per_t in [1 << 10, 123_457, 1 << 26, 777_777_777] {
                for begin in [0, 5_000, 1 << 20, 3 << 24] {
                    let profile = Profile { cells: &[], starts: &HALVES, origin: 0, width };
                    let hierarchy =
                        Hierarchy { x: profile, y: profile, depth: 16, leaves: 0, heights: (0, 0) };
                    let footprint = Footprint::new(Unit::from_bits(per_t)).with_width(begin);
                    let detail = hierarchy.level_of_detail::<true>(footprint);
                    for level in 0..=16 {
                        for t in [0, 999, 1 << 22, 7 << 24, i32::MAX] {
                            let exact = (i128::from(begin) << 30) + i128::from(t) * i128::from(per_t);
                            let side = i128::from(width) << (30 - level);
                            // as far from equal as parameters keep bits
                            if (exact - side).abs() < (exact + side) >> 12 {
                                continue;
                            }
                            tried += 1;
                            reached += u32::from(exact >= side);
                            let got = detail.is_reached::<true>(31 - level, t);
                            assert_eq!(got, exact >= side, "{width} {per_t} {begin} {level} {t}");
                        }
                    }
                }
            }
        }
        assert!(tried > 5_000 && (1_000..tried - 1_000).contains(&reached), "{tried} {reached}");
    }

    /// A ray that starts within a unit of an outer plane and goes out touches the last part; planes come up
    /// to a unit early.
    #[test]
    fn a_ray_may_touch_the_outer_planes() {
        let cells = [Cell { min: Real::ONE, max: Real::ONE, ..Cell::ZERO }; 3];
        let profile = Profile { cells: &cells, starts: &HALVES, origin: -(1 << 23), width: 1 << 24 };
        for (depth, leaves) in [(0, 0), (1, 1)] {
            let hierarchy =
                Hierarchy { x: profile, y: profile, depth, leaves, heights: (1 << 24, (1 << 24) + 1) };
            for axis in 0..2 {
                for up in [true, false] {
                    let [low, high] = [[-(1 << 23), 1 << 23], [1 << 24, (1 << 24) + 1]][axis / 2];
                    let walk = |beyond: i32| {
                        let mut ray = Ray::from_bits([1 << 21, 1 << 21, 1 << 24], [1 << 27, 1 << 27, 0]);
                        ray.origin[axis] = if up { high + beyond } else { low - beyond };
                        ray.direction[axis] = if up { 1 << 28 } else { -(1 << 28) };
                        walk_down(&hierarchy, &ray)
                    };
                    let mut nodes = if depth == 0 { [0, 0] } else { [2, 2] };
                    if axis < 2 && !up && depth == 1 {
                        nodes[axis] = 1;
                    }
                    let leaf = walk(-1).unwrap();
                    assert_eq!(
                        (leaf.nodes, leaf.span),
                        ((nodes[0], nodes[1]), (0, 0)),
                        "{axis} {up} {depth}"
                    );
                    assert_eq!([walk(0), walk(1)], [None, None], "{axis} {up} {depth}");
                }
            }
        }
    }

    /// Level rays on the lowest and the highest place of a box, and a unit outside.
    #[test]
    fn a_level_ray_meets_what_is_at_its_height() {
        let cell =
            |min: i32, max: i32| Cell { min: Real::from_bits(min), max: Real::from_bits(max), ..Cell::ZERO };
        let (a, b, c, d) = (5 << 20, 7 << 20, 9 << 20, 12 << 20);
        let one = cell(1 << 24, 1 << 24);
        let (cells, ones) = ([cell(a, d), cell(a, b), cell(c, d)], [one; 3]);
        let profile = |cells, starts| Profile { cells, starts, origin: 0, width: 1 << 24 };
        // a box's highest place is a unit above the product
        let (x, y) = (profile(&cells, &HALVES), profile(&ones, &HALVES));
        let hierarchy = Hierarchy { x, y, depth: 1, leaves: 1, heights: (a, d + 1) };
        for (z, part) in [
            (a - 1, None),
            (a, Some(1)),
            (b + 1, Some(1)),
            (b + 2, None),
            (c - 1, None),
            (c, Some(2)),
            (d + 1, Some(2)),
            (d + 2, None),
        ] {
            for direction in [[1 << 28, 1 << 23, 0], [-(1 << 28), 1 << 26, 0]] {
                let ray = Ray::from_bits([if direction[0] > 0 { -77 } else { 3 << 24 }, 3, z], direction);
                assert_eq!(walk_down(&hierarchy, &ray).map(|leaf| leaf.nodes.0), part, "{z}");
            }
        }
    }

    /// Along one axis from the first node to the last, rising and descending: numbers and planes in exact
    /// integers.
    #[test]
    fn every_node_is_passed_in_order() {
        for flip in [0, u32::MAX >> 1] {
            for depth in [1, 3, 16] {
                // the plane `u` is crossed at u / 16
                let planes = Crossings { middle: 0, twice: 1 << 28, flip };
                let aside_planes = Crossings { middle: 7, twice: 1 << 20, flip: 0 };
                let number = |level: u32, k: u32| {
                    let index = if flip == 0 { k } else { (1 << level) - 1 - k };
                    (1 << level) - 1 + index
                };
                let (mut slab, mut aside) = (Slab::root(&planes), Slab::root(&aside_planes));
                let last = 31 - depth;
                let (mut shift, mut k) = (31, 0_u32);
                loop {
                    // where the node begins
                    let begin = (1 << 31) + (k << last);
                    while shift > last {
                        shift -= 1;
                        slab.descend(&planes, 1 << shift, planes.at(begin));
                        // the second part of the other axis each time
                        aside.descend(&aside_planes, 1 << shift, i32::MAX);
                    }
                    assert_eq!(planes.node(slab.begin, shift), number(depth, k), "{flip} {depth} {k}");
                    assert_eq!(slab.begin, begin);
                    assert_eq!(slab.next, planes.at(begin.wrapping_add(1 << last)));
                    k += 1;
                    if slab.advance(&planes, &mut aside, &aside_planes, &mut shift).is_none() {
                        break;
                    }
                    // up by as many levels as nodes end here
                    let levels = k.trailing_zeros();
                    assert_eq!(shift, last + levels);
                    assert_eq!(planes.node(slab.begin, shift), number(depth - levels, k >> levels));
                    assert_eq!(slab.begin, (1 << 31) + (k << last));
                    assert_eq!(slab.next, planes.at(slab.begin.wrapping_add(1 << shift)));
                    // the second part of the node that is left: the last there, wherever that one is
                    let around = aside_planes.node(aside.begin, shift) + 1;
                    assert!(around.is_power_of_two() || (around + 1).is_power_of_two() || depth > 1);
                    assert_eq!(aside.begin << (32 - shift), 0);
                    assert_eq!(aside.next, aside_planes.at(aside.begin.wrapping_add(1 << shift)));
                }
                assert_eq!(k, 1 << depth, "{flip} {depth}");
            }
        }
    }

    /// A ray that starts a unit outside the range of heights begins where it reaches it.
    #[test]
    fn a_walk_begins_where_the_heights_do() {
        let cells = [Cell { min: Real::ONE, max: Real::ONE, ..Cell::ZERO }; 1];
        let profile = Profile { cells: &cells, starts: &HALVES, origin: 0, width: 1 << 24 };
        let (low, high) = (1 << 24, (1 << 24) + 1);
        let hierarchy = Hierarchy { x: profile, y: profile, depth: 0, leaves: 0, heights: (low, high) };
        // a unit takes 256 at a slope of 1/256
        for (z, slope, begin) in [
            (high + 1, -(1 << 20), 256),
            (high + 2, -(1 << 20), 512),
            (high, -(1 << 20), 0),
            (low - 1, 1 << 20, 256),
            (low - 3, 1 << 20, 768),
            (low, 1 << 20, 0),
        ] {
            let ray = Ray::from_bits([1 << 22, 1 << 22, z], [1 << 28, 1 << 27, slope]);
            let leaf = walk_down(&hierarchy, &ray).unwrap();
            assert!((begin - 1..=begin).contains(&leaf.span.0), "{z} {slope}: {:?}", leaf.span);
        }
        // over 3/4 it falls by 49152 units and rises by one less: to the first height that counts, and to the
        // one beside it
        let walk = |z: i32, slope: i32| {
            let ray = Ray::from_bits([1 << 22, 1 << 22, z], [1 << 28, 1 << 27, slope]);
            walk_down(&hierarchy, &ray).is_some()
        };
        assert_eq!([49_152, 49_153].map(|fall| walk(high + fall, -(1 << 20))), [true, false]);
        assert_eq!([49_151, 49_152].map(|rise| walk(low - rise, 1 << 20)), [true, false]);
    }
}
