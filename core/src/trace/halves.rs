//! The walk through a height field whose nodes have two equal parts along each axis: a quadtree, the ordinary case.
//!
//! A plane is never intersected below the root: with the parameters at which the ray crosses a node's near and far planes its middle plane is
//! crossed half-way between, so that a level costs a shift and an addition an axis. (After J. Revelles, C. Urena, M. Lastra, "An
//! efficient parametric algorithm for octree traversal", 2000, in 64-bit integers.) Of a node's four parts at most three are tested.
//!
//! Parameters have 24 fractional bits in 32. A ray so nearly parallel to a plane that it crosses the surface's planes farther away than that is left to the
//! general walk; the two find the same leaves.

use heapless::Vec;

use super::height_field::{HeightField, Leaf, Statistics, range};
use super::ray::{Axis, Footprint, Ray};

/// Where a walk stands along one axis of a node.
#[derive(Debug, Clone, Copy)]
struct Half {
    /// Parameter at the node's middle plane, and from there to its far plane.
    middle: i32,
    rest: i32,
    /// The number of the part where the walk stands.
    node: u32,
    /// Where the ray leaves the part; `i32::MAX` marks the far part.
    next: i32,
}

/// A walk through the parts of one node, from `t` with the ray's height `z` there, to `t_out`.
#[derive(Debug, Clone, Copy)]
struct Frame {
    x: Half,
    y: Half,
    t: i32,
    z: i32,
    t_out: i32,
    /// From this parameter on (16 fractional bits) the node's parts are no wider than the footprint.
    small: i32,
}

impl Half {
    /// Enters node `node`, whose near plane is crossed at `near` and whose parts take `rest` each.
    #[inline(always)]
    fn enter(axis: &Axis, node: u32, near: i32, rest: i32, t: i32) -> Self {
        let middle = near + rest;
        // the near part is the lower one (2 q + 1) unless the ray comes from above
        let from_above = (axis.direction as u32) >> 31;
        if middle > t {
            Self { middle, rest, node: 2 * node + 1 + from_above, next: middle }
        } else {
            Self { middle, rest, node: 2 * node + 2 - from_above, next: i32::MAX }
        }
    }

    /// The part where the walk stands as a node of its own.
    #[inline(always)]
    fn descend(&self, axis: &Axis, t: i32) -> Self {
        let near = if self.next == i32::MAX { self.middle } else { self.middle - self.rest };
        Self::enter(axis, self.node, near, self.rest >> 1, t)
    }

    /// On to the far part.
    #[inline(always)]
    fn advance(&mut self, axis: &Axis) {
        self.node = self.node.wrapping_add(1 | (axis.direction >> 31) as u32);
        self.next = i32::MAX;
    }
}

/// Whether sums and differences of two such numbers fit 32 bits, saturated ones excluded.
#[inline(always)]
fn fits(t: i32) -> bool {
    t.wrapping_add(1 << 30) >= 0
}

/// A footprint made ready for the walk of one surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cone {
    pub(super) footprint: Footprint,
    /// From where on the whole surface is small, 16 fractional bits; none where that does not fit.
    small: Option<i32>,
}

impl<const STACK: usize> HeightField<'_, STACK> {
    pub(super) fn cone(&self, footprint: Footprint) -> Cone {
        let small = footprint.reaches(self.x.width.max(self.y.width)) >> 8;
        Cone { footprint, small: if small < 1 << 30 { Some(small as i32) } else { None } }
    }
}

impl<'a, const STACK: usize> HeightField<'a, STACK> {
    #[inline(always)]
    pub(super) fn walk_halves(
        &self,
        ray: &Ray,
        cone: &Cone,
        statistics: &mut Statistics,
    ) -> Option<Leaf<'a>> {
        let planes = |axis: &Axis, low: i32, width: i32| {
            let (near, far) = if axis.direction < 0 { (low + width, low) } else { (low, low + width) };
            (axis.crossing(near), axis.crossing(far))
        };
        let x = planes(&ray.x, self.x.origin, self.x.width);
        let y = planes(&ray.y, self.y.origin, self.y.width);
        let (Some(small), true) = (cone.small, [x.0, x.1, y.0, y.1].into_iter().all(fits)) else {
            let ray = *ray;
            return self.walk_parts(&ray, cone.footprint, statistics);
        };
        statistics.rays = statistics.rays.wrapping_add(1);
        statistics.box_tests = statistics.box_tests.wrapping_add(1);
        let span = (x.0.max(y.0).max(0), x.1.min(y.1));
        if span.0 > span.1 {
            return None;
        }
        let (f, g) = (self.x.cells.first()?, self.y.cells.first()?);
        let (low, high) = range(f, g);
        let (t_in, t_out) = ray.z.clip(low, high, span);
        if t_in > t_out {
            return None;
        }
        if self.leaves == 0 || t_in >> 8 >= small {
            return Some(Leaf { nodes: (0, 0), cells: (f, g), span: (t_in, t_out) });
        }
        let mut stack = Vec::<Frame, STACK>::new();
        let root = Frame {
            x: Half::enter(&ray.x, 0, x.0, (x.1 - x.0) >> 1, t_in),
            y: Half::enter(&ray.y, 0, y.0, (y.1 - y.0) >> 1, t_in),
            t: t_in,
            z: ray.z.at(t_in),
            t_out,
            small: small >> 1,
        };
        // never full: at most one frame for each level above the leaves, and depth <= STACK
        let _ = stack.push(root);
        loop {
            statistics.stack = statistics.stack.max(stack.len() as u32);
            let frame = stack.last_mut()?;
            // the part where the walk stands, up to the next plane
            let t_next = frame.x.next.min(frame.y.next).min(frame.t_out);
            let z_next = ray.z.at(t_next);
            statistics.box_tests = statistics.box_tests.wrapping_add(1);
            let f = self.x.cells.get(frame.x.node as usize)?;
            let g = self.y.cells.get(frame.y.node as usize)?;
            let (low, high) = range(f, g);
            let (t, z) = (frame.t, frame.z);
            let (z_low, z_high) = if z < z_next { (z, z_next) } else { (z_next, z) };
            let finished = t_next >= frame.t_out;
            if z_low <= high && z_high >= low {
                let nodes = (frame.x.node, frame.y.node);
                if nodes.0 >= self.leaves || t >> 8 >= frame.small {
                    return Some(Leaf { nodes, cells: (f, g), span: (t, t_next) });
                }
                let part = Frame {
                    x: frame.x.descend(&ray.x, t),
                    y: frame.y.descend(&ray.y, t),
                    t,
                    z,
                    t_out: t_next,
                    small: frame.small >> 1,
                };
                if finished {
                    *frame = part;
                } else {
                    frame.advance(ray, t_next, z_next);
                    let _ = stack.push(part);
                }
            } else if finished {
                let _ = stack.pop();
            } else {
                frame.advance(ray, t_next, z_next);
            }
        }
    }
}

impl Frame {
    /// One part on, along the axis whose plane comes first.
    #[inline(always)]
    fn advance(&mut self, ray: &Ray, t: i32, z: i32) {
        if self.x.next <= self.y.next {
            self.x.advance(&ray.x);
        } else {
            self.y.advance(&ray.y);
        }
        (self.t, self.z) = (t, z);
    }
}
