//! The walk through a height field whose nodes have any number of parts of any width: Algorithm 3 of the
//! paper without recursion.
//!
//! Inside a node the ray's projection walks its parts from plane to plane in the order in which it crosses
//! them (which contains the four cases of figure 5: the walk steps up or down along each axis by the sign of
//! the direction), so that only parts under the ray are ever tested and the first leaf found is the nearest.
//! One frame a level holds where the walk of that level stands: the stack is as deep as the tree.

use heapless::Vec;

use super::super::ray::{Axis, Footprint, Ray};
use super::boxes::meets_bits;
use super::hierarchy::{Hierarchy, Leaf, Profile};
use super::statistics::Count;
use crate::fif::Pyramid;

/// The extent of a node along one axis.
#[derive(Debug, Clone, Copy)]
struct Extent {
    node: u32,
    low: i32,
    width: i32,
}

/// Where a walk stands along one axis of a node.
#[derive(Debug, Clone, Copy)]
struct Along {
    /// The extent of the node that is walked.
    low: i32,
    width: i32,
    /// The part where the walk stands, 0 at the low end, and its number.
    part: u32,
    node: u32,
    /// Where the ray leaves the part along this axis; the greatest number for the last part, which the node's
    /// own end limits.
    next: i32,
}

/// A walk through the parts of one node, from `t` with the ray's height `z` there, to `t_out`.
#[derive(Debug, Clone, Copy)]
struct Frame {
    x: Along,
    y: Along,
    t: i32,
    z: i32,
    t_out: i32,
}

impl Profile<'_> {
    fn whole(&self) -> Extent {
        Extent { node: 0, low: self.origin, width: self.width }
    }

    fn parts(&self) -> u32 {
        self.starts.len() as u32
    }

    /// The left end of part `k` of a node; that of part `n` is the node's right end.
    #[inline(never)]
    fn plane(&self, low: i32, width: i32, k: u32) -> i32 {
        let offset = match self.starts.get(k as usize) {
            Some(start) => ((i64::from(*start) * i64::from(width)) >> 31) as i32,
            None => width,
        };
        low + offset
    }

    /// Where the ray leaves part `part` of an extent; the greatest number for the last, which the node's own
    /// end limits.
    #[inline(never)]
    fn leaves(&self, axis: &Axis, low: i32, width: i32, part: u32) -> i32 {
        let up = axis.direction > 0;
        let last = if up { part + 1 >= self.parts() } else { part == 0 };
        if last { i32::MAX } else { axis.crossing(self.plane(low, width, part + u32::from(up))) }
    }

    /// The part in which the walk begins at `t`: the first that the ray has not left.
    #[inline(never)]
    fn enter(&self, axis: &Axis, extent: Extent, t: i32) -> Along {
        let Extent { node, low, width } = extent;
        let mut part = if axis.direction > 0 { 0 } else { self.parts() - 1 };
        loop {
            let next = self.leaves(axis, low, width, part);
            if next > t {
                return Along { low, width, part, node: node * self.parts() + 1 + part, next };
            }
            part = part.wrapping_add(step(axis));
        }
    }

    /// One part on. Never past the last one, whose `next` no parameter reaches.
    fn advance(&self, axis: &Axis, along: &mut Along) {
        along.part = along.part.wrapping_add(step(axis));
        along.node = along.node.wrapping_add(step(axis));
        along.next = self.leaves(axis, along.low, along.width, along.part);
    }

    fn part(&self, along: &Along) -> Extent {
        let low = self.plane(along.low, along.width, along.part);
        Extent { node: along.node, low, width: self.plane(along.low, along.width, along.part + 1) - low }
    }
}

fn step(axis: &Axis) -> u32 {
    if axis.direction > 0 { 1 } else { u32::MAX }
}

/// A walk stands at most once on each level above the leaves.
const FRAMES: usize = Pyramid::MAX_DEPTH as usize;

impl Hierarchy<'_> {
    /// The first leaf that the ray meets.
    #[inline(never)]
    pub(crate) fn walk_parts(&self, ray: &Ray, footprint: Footprint, count: &mut impl Count) -> Option<Leaf> {
        count.ray();
        let axes = ray.axes();
        let [ax, ay, az] = &axes;
        let (x, y) = (self.x.whole(), self.y.whole());
        let span = ax.clip(x.low, x.low + x.width, (0, i32::MAX));
        let span = ay.clip(y.low, y.low + y.width, span);
        if span.0 > span.1 {
            return None;
        }
        let (t_in, t_out) = az.clip(self.heights.0, self.heights.1, span);
        if t_in > t_out || t_out == i32::MAX {
            return None;
        }
        if self.leaves == 0 || is_small(&x, &y, t_in, footprint) {
            return Some(Leaf { nodes: (0, 0), span: (t_in, t_out) });
        }
        count.depth(1);
        let mut stack = Vec::<Frame, FRAMES>::new();
        let mut frame = self.enter(&axes, (x, y), t_in, az.at(t_in), t_out);
        loop {
            // the part where the walk stands, up to the next plane
            let t_next = frame.x.next.min(frame.y.next).min(frame.t_out);
            let z_next = az.at(t_next);
            count.test();
            let f = self.x.cells.get(frame.x.node as usize)?;
            let g = self.y.cells.get(frame.y.node as usize)?;
            let finished = t_next >= frame.t_out;
            if meets_bits(f, g, frame.z, z_next) {
                let (x, y) = (self.x.part(&frame.x), self.y.part(&frame.y));
                let (t, z) = (frame.t, frame.z);
                if x.node >= self.leaves || is_small(&x, &y, t, footprint) {
                    return Some(Leaf { nodes: (x.node, y.node), span: (t, t_next) });
                }
                if !finished {
                    self.advance(&axes, &mut frame, t_next, z_next);
                    // never full: at most one frame for each level above the leaves, and depth <= FRAMES
                    let _ = stack.push(frame);
                }
                count.depth(stack.len() as u32 + 1);
                frame = self.enter(&axes, (x, y), t, z, t_next);
            } else if finished {
                frame = stack.pop()?;
            } else {
                self.advance(&axes, &mut frame, t_next, z_next);
            }
        }
    }

    fn enter(&self, [ax, ay, _]: &[Axis; 3], (x, y): (Extent, Extent), t: i32, z: i32, t_out: i32) -> Frame {
        Frame { x: self.x.enter(ax, x, t), y: self.y.enter(ay, y, t), t, z, t_out }
    }

    /// One part on, along the axis whose plane comes first.
    fn advance(&self, [ax, ay, _]: &[Axis; 3], frame: &mut Frame, t: i32, z: i32) {
        if frame.x.next <= frame.y.next {
            self.x.advance(ax, &mut frame.x);
        } else {
            self.y.advance(ay, &mut frame.y);
        }
        (frame.t, frame.z) = (t, z);
    }
}

/// Whether a node is no wider than the footprint at `t`.
fn is_small(x: &Extent, y: &Extent, t: i32, footprint: Footprint) -> bool {
    i64::from(t) >= footprint.reaches(x.width.max(y.width))
}

#[cfg(test)]
mod tests {
    use super::super::super::exact::{Surface, first_leaf};
    use super::super::statistics::Statistics;
    use super::*;
    use crate::fif::Cell;
    use crate::num::{Real, Unit};

    const THIRDS: [u32; 3] = [0, 700_000_001, 1_400_000_003];
    const UNEVEN: [u32; 2] = [0, 600_000_007];

    /// Against fractions: the leaf, its span, and every box that is tested on the way.
    #[test]
    fn the_first_leaf_of_uneven_parts_is_the_exact_one() {
        let (mut found, mut missed, mut small, mut close, mut worst) = (0, 0, 0, 0, 0);
        for (seed, (starts, depth, domain)) in [
            ([&THIRDS[..], &UNEVEN], 3, [[-(1 << 23), (1 << 24) + 1], [1 << 20, 15_000_001]]),
            ([&UNEVEN, &THIRDS], 2, [[-(1 << 24), 3 << 23], [-(5 << 24), 9_999_999]]),
            ([&UNEVEN, &UNEVEN], 1, [[0, 1 << 24], [-(1 << 24), 1 << 23]]),
            ([&[0], &THIRDS], 2, [[0, 1 << 24], [-(1 << 24), 1 << 24]]),
            ([&THIRDS, &UNEVEN], 0, [[0, 1 << 24], [0, 1 << 24]]),
        ]
        .into_iter()
        .enumerate()
        {
            let surface = Surface::new(starts, depth, domain, 7 + seed as u64);
            let hierarchy = surface.hierarchy();
            for (k, ray) in surface.rays(99 + seed as u64, 3000).enumerate() {
                let per_t = [1, 1 << 26, 1 << 28][k % 3];
                let truth = first_leaf(&hierarchy, &ray, per_t, true);
                if truth.is_close {
                    close += 1;
                    continue;
                }
                let mut statistics = Statistics::default();
                let leaf =
                    hierarchy.walk_parts(&ray, Footprint::new(Unit::from_bits(per_t)), &mut statistics);
                assert_eq!(leaf.as_ref().map(|leaf| leaf.nodes), truth.nodes, "{ray:?} {truth:?}");
                let expected = Statistics { stack: truth.unfinished, ..truth.statistics };
                assert_eq!(statistics, expected, "{ray:?} {truth:?}");
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
        // a plane is rounded down once a level: in sixteenths of a unit
        assert!((16..=48).contains(&worst), "{worst}");
    }

    /// A ray that starts on a plane is above the part that it goes into, not above the one that it leaves.
    #[test]
    fn a_part_ends_before_its_far_plane() {
        let cell = |max: i32| Cell { max: Real::from_bits(max), ..Cell::ZERO };
        let (tall, flat) = (cell(1 << 24), cell(1 << 20));
        for (low, high, direction) in [(tall, flat, 1 << 28), (flat, tall, -(1 << 28))] {
            for axis in 0..2 {
                let (walked, other) = ([tall, low, high], [tall; 3]);
                let profile =
                    |cells, origin| Profile { cells, starts: &[0, 1 << 30], origin, width: 1 << 24 };
                let [x, y] = if axis == 0 { [&walked, &other] } else { [&other, &walked] };
                // the planes between the parts at 0, and the ray in the middle of a part along the other axis
                let origins = if axis == 0 { [-(1 << 23), 0] } else { [0, -(1 << 23)] };
                let (x, y) = (profile(x, origins[0]), profile(y, origins[1]));
                let hierarchy = Hierarchy { x, y, depth: 1, leaves: 1, heights: (0, (1 << 24) + 1) };
                let mut ray = Ray::from_bits([1 << 22, 1 << 22, 1 << 23], [1 << 24, 1 << 24, 0]);
                (ray.origin[axis], ray.direction[axis]) = (0, direction);
                let walk = |ray: &Ray| {
                    hierarchy.walk_parts(ray, Footprint::new(Unit::DELTA), &mut Statistics::default())
                };
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

    /// The surface is closed: a ray that starts on an outer plane and goes out touches it, one that starts a
    /// unit farther on does not. The last part is closed as well.
    #[test]
    fn a_ray_may_touch_the_outer_planes() {
        let cells = [Cell { min: Real::ONE, max: Real::ONE, ..Cell::ZERO }; 3];
        let profile = Profile { cells: &cells, starts: &[0, 1 << 30], origin: -(1 << 23), width: 1 << 24 };
        for (depth, leaves) in [(0, 0), (1, 1)] {
            let hierarchy =
                Hierarchy { x: profile, y: profile, depth, leaves, heights: (1 << 24, (1 << 24) + 1) };
            for axis in 0..3 {
                for up in [true, false] {
                    let [low, high] = [[-(1 << 23), 1 << 23], [1 << 24, (1 << 24) + 1]][axis / 2];
                    let walk = |beyond: i32| {
                        let mut ray = Ray::from_bits([1 << 21, 1 << 21, 1 << 24], [1 << 27, 1 << 27, 0]);
                        ray.origin[axis] = if up { high + beyond } else { low - beyond };
                        ray.direction[axis] = if up { 1 << 28 } else { -(1 << 28) };
                        hierarchy.walk_parts(&ray, Footprint::new(Unit::DELTA), &mut Statistics::default())
                    };
                    let mut nodes = if depth == 0 { [0, 0] } else { [2, 2] };
                    if axis < 2 && !up && depth == 1 {
                        nodes[axis] = 1;
                    }
                    let leaf = walk(0).unwrap();
                    assert_eq!(
                        (leaf.nodes, leaf.span),
                        ((nodes[0], nodes[1]), (0, 0)),
                        "{axis} {up} {depth}"
                    );
                    assert_eq!(walk(1), None, "{axis} {up} {depth}");
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
        let (x, y) = (profile(&cells, &[0, 1 << 30]), profile(&ones, &[0, 1 << 30]));
        let hierarchy = Hierarchy { x, y, depth: 1, leaves: 1, heights: (a, d + 2) };
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
                assert_eq!(
                    hierarchy
                        .walk_parts(&ray, Footprint::new(Unit::DELTA), &mut Statistics::default())
                        .map(|leaf| leaf.nodes.0),
                    part,
                    "{z}"
                );
            }
        }
    }

    /// The planes of a node are whole numbers, rounded down, and each part ends where the next begins.
    #[test]
    fn parts_share_their_planes() {
        for (low, width) in [(-(1 << 24), 3 << 24), (77, 12_345_677), (5, 4)] {
            let profile = Profile { cells: &[], starts: &THIRDS, origin: low, width };
            let whole = profile.whole();
            assert_eq!((whole.node, whole.low, whole.width), (0, low, width));
            let plane = |k: usize| {
                let start = THIRDS.get(k).map_or(1 << 31, |start| i64::from(*start));
                i64::from(low) + ((start * i64::from(width)) >> 31)
            };
            for direction in [1, -1] {
                let before = if direction > 0 { low - 1 } else { low + width + 1 };
                let axis = Axis::new(before, direction << 28);
                let mut along = profile.enter(&axis, whole, 0);
                for k in 0..3_usize {
                    let part = if direction > 0 { k } else { 2 - k };
                    let extent = profile.part(&along);
                    assert_eq!((along.part, extent.node), (part as u32, part as u32 + 1));
                    assert_eq!(
                        (i64::from(extent.low), i64::from(extent.low + extent.width)),
                        (plane(part), plane(part + 1))
                    );
                    if k < 2 {
                        let last = plane(if direction > 0 { part + 1 } else { part }) as i32;
                        assert_eq!(along.next, axis.crossing(last));
                        profile.advance(&axis, &mut along);
                    }
                }
                assert_eq!(along.next, i32::MAX);
            }
        }
    }

    /// A node is small where the footprint reaches the larger of its widths.
    #[test]
    fn a_node_is_as_wide_as_its_wider_side() {
        let extent = |width| Extent { node: 3, low: 9, width };
        let footprint = Footprint::new(Unit::from_bits(777_777));
        let t = footprint.reaches(12_345) as i32;
        for (x, y) in [(12_345, 12_345), (12_345, 7), (7, 12_345)] {
            let small = [t - 1, t].map(|t| is_small(&extent(x), &extent(y), t, footprint));
            assert_eq!(small, [false, true]);
        }
    }

    /// What is passed after 128 is not seen: parameters end there.
    #[test]
    fn a_ray_that_does_not_leave_the_surface_in_time_is_given_up() {
        let cells = [Cell { min: Real::ZERO, max: Real::ONE, ..Cell::ZERO }; 1];
        let profile = Profile { cells: &cells, starts: &[0], origin: 0, width: 1 << 24 };
        let hierarchy = Hierarchy { x: profile, y: profile, depth: 0, leaves: 0, heights: (0, 1 << 24) };
        let walk = |slow: i32| {
            let ray = Ray::from_bits([1 << 23; 3], [slow, -slow, slow]);
            hierarchy.walk_parts(&ray, Footprint::new(Unit::DELTA), &mut Statistics::default())
        };
        // half a unit at 1/128 a unit of the parameter takes 64, at 1/256 it takes 128
        assert!(walk(1 << 21).is_some() && walk(1 << 19).is_none() && walk(1).is_none());
    }
}
