//! Where a ray meets the height field `h(x, y) = f(x) g(y)`.
//!
//! Algorithm 3 of the paper without recursion. The cells of both pyramids span an implicit tree of boxes, `N M` parts a node. Inside a node the ray's
//! projection walks its parts from plane to plane in the order in which it crosses them (which contains the four cases of figure 5: the walk steps up or
//! down along each axis by the sign of the direction), so that only parts under the ray are ever tested and the first leaf found is the nearest.
//! One frame a level holds where the walk of that level stands: the stack is as deep as the tree.
//!
//! A box test compares the ray's heights over `[t_in, t_out]`, already cut to the part, with the range of `f g` over it (eq. 49): no plane of constant height is intersected.
//!
//! Formats: lengths and `t` 24 fractional bits, directions 28.

use heapless::Vec;

use super::halves::Cone;
use super::ray::{Axis, Footprint, Ray};
use crate::Error;
use crate::fif::{Cell, Pyramid};
use crate::num::{Real, Unit, Vec3, Wide};

/// A height field `f(x) g(y)` as the pyramids of its factors, for a stack of at most `STACK` frames.
#[derive(Debug, Clone, Copy)]
pub struct HeightField<'a, const STACK: usize = 16> {
    pub(super) x: Side<'a>,
    pub(super) y: Side<'a>,
    depth: u32,
    /// The first node of the deepest level along x.
    pub(super) leaves: u32,
    /// Whether nodes have two equal parts along both axes.
    halved: bool,
}

/// One factor: its pyramid and its domain with 24 fractional bits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side<'a> {
    pub(super) cells: &'a [Cell],
    starts: &'a [u32],
    pub(super) origin: i32,
    pub(super) width: i32,
}

/// The leaf that a ray meets first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hit {
    /// Level of the leaf.
    pub level: u32,
    /// Index of its cells along x and y.
    pub index: (u32, u32),
    /// Parameter of the middle of the ray's part inside the leaf's box.
    pub t: Real,
    pub(crate) cells: (Cell, Cell),
}

impl Hit {
    /// The mean normal of the surface over the leaf, `(-mean h_x, -mean h_y, 1)`, components saturated at ±64.
    pub fn normal(&self) -> Vec3 {
        let [x, y, z] = normal(&self.cells.0, &self.cells.1).map(Real::from_bits);
        Vec3::new(x, y, z)
    }
}

/// A leaf as the walk finds it: its nodes along x and y, their cells, the ray's part above it.
pub(crate) struct Leaf<'a> {
    pub(super) nodes: (u32, u32),
    pub(super) cells: (&'a Cell, &'a Cell),
    pub(super) span: (i32, i32),
}

impl Leaf<'_> {
    /// The mean normal over the leaf, 24 fractional bits, saturated at ±64.
    #[inline(always)]
    pub(crate) fn normal(&self) -> [i32; 3] {
        normal(self.cells.0, self.cells.1)
    }
}

#[inline(always)]
fn normal(f: &Cell, g: &Cell) -> [i32; 3] {
    let product = |a: Real, b: Real| {
        let p = (i64::from(a.to_bits()) * i64::from(b.to_bits())) >> 24;
        -(p.clamp(-(1 << 30), 1 << 30) as i32)
    };
    [product(f.slope, g.mean), product(f.mean, g.slope), 1 << 24]
}

/// What intersections have cost, added up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Statistics {
    /// Rays cast.
    pub rays: u32,
    /// Boxes tested, that of the whole surface included.
    pub box_tests: u32,
    /// Greatest number of frames on the stack.
    pub stack: u32,
}

/// The extent of a node along one axis. Nodes are numbered level by level: the parts of node `q` are `n q + 1` to `n q + n`.
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
    /// Where the ray leaves the part along this axis; the greatest number for the last part, which the node's own end limits.
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

impl<'a> Side<'a> {
    fn new(name: &'static str, pyramid: &Pyramid<'a>) -> Result<Self, Error> {
        let (x0, width) = pyramid.domain_bits();
        let end = x0.saturating_add_unsigned(width);
        // below 64, so that the width fits
        let limit = 64 << 48;
        if x0 < -limit || end >= limit {
            let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
            let value = Wide::from_bits(if end >= limit { end } else { x0 });
            return Err(Error::OutOfRange { what: name, index: 0, value, min, max });
        }
        let origin = (x0 >> 24) as i32;
        Ok(Self {
            cells: pyramid.all(),
            starts: pyramid.starts(),
            origin,
            width: ((end >> 24) as i32) - origin,
        })
    }

    fn whole(&self) -> Extent {
        Extent { node: 0, low: self.origin, width: self.width }
    }

    /// Whether a node has two equal parts, the ordinary case, for which [`super::halves`] has a walk of its own.
    fn is_halved(&self) -> bool {
        self.starts == [0, 1 << 30]
    }

    #[inline(always)]
    fn parts(&self) -> u32 {
        self.starts.len() as u32
    }

    /// The left end of part `k` of a node; that of part `n` is the node's right end.
    #[inline(always)]
    fn plane(&self, low: i32, width: i32, k: u32) -> i32 {
        let offset = match self.starts.get(k as usize) {
            Some(start) => ((i64::from(*start) * i64::from(width)) >> 31) as i32,
            None => width,
        };
        low + offset
    }

    /// The part in which the walk begins at `t`: the first that the ray has not left.
    #[inline(always)]
    fn enter(&self, axis: &Axis, extent: Extent, t: i32) -> Along {
        let Extent { node, low, width } = extent;
        let parts = self.parts();
        let at = |part, next| Along { low, width, part, node: node * parts + 1 + part, next };
        if axis.direction > 0 {
            for part in 0..parts - 1 {
                let next = axis.crossing(self.plane(low, width, part + 1));
                if next > t {
                    return at(part, next);
                }
            }
            at(parts - 1, i32::MAX)
        } else {
            for part in (1..parts).rev() {
                let next = axis.crossing(self.plane(low, width, part));
                if next > t {
                    return at(part, next);
                }
            }
            at(0, i32::MAX)
        }
    }

    /// One part on. Never past the last one, whose `next` no parameter reaches.
    #[inline(always)]
    fn advance(&self, axis: &Axis, along: &mut Along) {
        let up = axis.direction > 0;
        let step = if up { 1 } else { u32::MAX };
        along.part = along.part.wrapping_add(step);
        along.node = along.node.wrapping_add(step);
        let last = if up { along.part + 1 >= self.parts() } else { along.part == 0 };
        along.next = if last {
            i32::MAX
        } else {
            axis.crossing(self.plane(along.low, along.width, along.part + u32::from(up)))
        };
    }

    #[inline(always)]
    fn part(&self, along: &Along) -> Extent {
        let low = self.plane(along.low, along.width, along.part);
        Extent { node: along.node, low, width: self.plane(along.low, along.width, along.part + 1) - low }
    }

    /// Level of a node and its index there.
    fn place(&self, node: u32) -> (u32, u32) {
        let (mut level, mut first, mut count) = (0, 0_u32, 1_u32);
        while node >= first.saturating_add(count) && level < Pyramid::MAX_DEPTH {
            first += count;
            count = count.saturating_mul(self.starts.len() as u32);
            level += 1;
        }
        (level, node.saturating_sub(first))
    }
}

impl<'a, const STACK: usize> HeightField<'a, STACK> {
    /// The height field over the domains of two pyramids, down to the depth of the shallower one.
    ///
    /// # Errors
    /// [`Error::Capacity`] if the depth is above `STACK`: a walk stands at most once on each level above the leaves;
    /// [`Error::OutOfRange`] if a domain leaves ±64.
    pub fn new(x: &Pyramid<'a>, y: &Pyramid<'a>) -> Result<Self, Error> {
        let depth = x.depth().min(y.depth());
        if depth as usize > STACK {
            return Err(Error::Capacity {
                what: "frames on the stack",
                needed: depth as usize,
                capacity: STACK,
            });
        }
        let (f, g) = (x.root(), y.root());
        let largest = |c: Cell| i64::from(c.min.to_bits()).abs().max(i64::from(c.max.to_bits()).abs());
        let height = (largest(f) * largest(g)) >> 24;
        if height >= 64 << 24 {
            let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
            return Err(Error::OutOfRange {
                what: "height",
                index: 0,
                value: Wide::from_bits(height << 24),
                min,
                max,
            });
        }
        let leaves = match depth.checked_sub(1) {
            Some(above) => Pyramid::cells(x.branching() as usize, above) as u32,
            None => 0,
        };
        let (x, y) = (Side::new("domain along x", x)?, Side::new("domain along y", y)?);
        let halved = x.is_halved() && y.is_halved();
        Ok(Self { x, y, depth, leaves, halved })
    }

    /// The depth of the tree: no more than this many frames are on the stack.
    pub const fn depth(&self) -> u32 {
        self.depth
    }

    /// Rigorous bounds of the heights.
    pub fn heights(&self) -> (Real, Real) {
        let cell = |side: &Side<'_>| side.cells.first().copied().unwrap_or_default();
        let (low, high) = range(&cell(&self.x), &cell(&self.y));
        (Real::from_bits(low), Real::from_bits(high))
    }

    /// The surface's box, 24 fractional bits: both ends along x, y and z.
    pub(super) fn extent(&self) -> [[i32; 2]; 3] {
        let (low, high) = self.heights();
        let side = |s: &Side<'_>| [s.origin, s.origin + s.width];
        [side(&self.x), side(&self.y), [low.to_bits(), high.to_bits()]]
    }

    /// The first leaf that the ray meets. A node is a leaf at the deepest level, or where it is no wider than `footprint` times the ray's parameter.
    ///
    /// Rays that start inside the surface's box and rays parallel to a plane are handled; the smallest `t` is 0.
    ///
    /// Error: the leaf is the exact one unless the ray passes a box within `2^-22` (tests/pictures.rs). Cost: about 30 Cortex-M4 instructions a box test.
    pub fn intersect(&self, ray: &Ray, footprint: Unit) -> Option<Hit> {
        self.leaf(ray, &self.cone(Footprint::new(footprint))).map(|leaf| self.hit(ray, leaf))
    }

    /// The leaf alone: all that shading needs.
    #[inline(always)]
    pub(super) fn leaf(&self, ray: &Ray, cone: &Cone) -> Option<Leaf<'a>> {
        self.walk(ray, cone, &mut Statistics::default())
    }

    /// As [`HeightField::intersect`], and adds to `statistics` what it took.
    pub fn intersect_counted(&self, ray: &Ray, footprint: Unit, statistics: &mut Statistics) -> Option<Hit> {
        self.walk(ray, &self.cone(Footprint::new(footprint)), statistics).map(|leaf| self.hit(ray, leaf))
    }

    #[inline(always)]
    fn walk(&self, ray: &Ray, cone: &Cone, statistics: &mut Statistics) -> Option<Leaf<'a>> {
        if self.halved {
            self.walk_halves(ray, cone, statistics)
        } else {
            let ray = *ray;
            self.walk_parts(&ray, cone.footprint, statistics)
        }
    }

    /// The walk for any number of parts of any width. Never inlined, so that a ray's numbers may stay in registers elsewhere.
    #[inline(never)]
    pub(super) fn walk_parts(
        &self,
        ray: &Ray,
        footprint: Footprint,
        statistics: &mut Statistics,
    ) -> Option<Leaf<'a>> {
        statistics.rays = statistics.rays.wrapping_add(1);
        statistics.box_tests = statistics.box_tests.wrapping_add(1);
        let (x, y) = (self.x.whole(), self.y.whole());
        let span = ray.x.clip(x.low, x.low + x.width, (0, i32::MAX));
        let span = ray.y.clip(y.low, y.low + y.width, span);
        if span.0 > span.1 {
            return None;
        }
        let (f, g) = (self.x.cells.first()?, self.y.cells.first()?);
        let (low, high) = range(f, g);
        let (t_in, t_out) = ray.z.clip(low, high, span);
        if t_in > t_out || t_out == i32::MAX {
            return None;
        }
        if self.leaves == 0 || is_small(&x, &y, t_in, footprint) {
            return Some(Leaf { nodes: (0, 0), cells: (f, g), span: (t_in, t_out) });
        }
        let mut stack = Vec::<Frame, STACK>::new();
        let mut frame = self.enter(ray, (x, y), t_in, ray.z.at(t_in), t_out);
        loop {
            // the part where the walk stands, up to the next plane
            let t_next = frame.x.next.min(frame.y.next).min(frame.t_out);
            let z_next = ray.z.at(t_next);
            statistics.box_tests = statistics.box_tests.wrapping_add(1);
            let f = self.x.cells.get(frame.x.node as usize)?;
            let g = self.y.cells.get(frame.y.node as usize)?;
            let finished = t_next >= frame.t_out;
            if meets_bits(f, g, frame.z, z_next) {
                let (x, y) = (self.x.part(&frame.x), self.y.part(&frame.y));
                let (t, z) = (frame.t, frame.z);
                if x.node >= self.leaves || is_small(&x, &y, t, footprint) {
                    return Some(Leaf { nodes: (x.node, y.node), cells: (f, g), span: (t, t_next) });
                }
                if !finished {
                    self.advance(ray, &mut frame, t_next, z_next);
                    // never full: at most one frame for each level above the leaves, and depth <= STACK
                    let _ = stack.push(frame);
                    statistics.stack = statistics.stack.max(stack.len() as u32);
                }
                frame = self.enter(ray, (x, y), t, z, t_next);
            } else if finished {
                frame = stack.pop()?;
            } else {
                self.advance(ray, &mut frame, t_next, z_next);
            }
        }
    }

    #[inline(always)]
    fn enter(&self, ray: &Ray, (x, y): (Extent, Extent), t: i32, z: i32, t_out: i32) -> Frame {
        Frame { x: self.x.enter(&ray.x, x, t), y: self.y.enter(&ray.y, y, t), t, z, t_out }
    }

    /// One part on, along the axis whose plane comes first.
    #[inline(always)]
    fn advance(&self, ray: &Ray, frame: &mut Frame, t: i32, z: i32) {
        if frame.x.next <= frame.y.next {
            self.x.advance(&ray.x, &mut frame.x);
        } else {
            self.y.advance(&ray.y, &mut frame.y);
        }
        (frame.t, frame.z) = (t, z);
    }

    fn hit(&self, ray: &Ray, leaf: Leaf<'_>) -> Hit {
        let (f, g) = leaf.cells;
        let (low, high) = range(f, g);
        let (t_in, t_out) = ray.z.clip(low, high, leaf.span);
        // a ray that only touches the box may round to an empty part
        let t = if t_in <= t_out { t_in + (t_out - t_in) / 2 } else { leaf.span.0 };
        let ((level, i), (_, j)) = (self.x.place(leaf.nodes.0), self.y.place(leaf.nodes.1));
        Hit { level, index: (i, j), t: Real::from_bits(t), cells: (*f, *g) }
    }
}

/// Whether a node is no wider than the footprint at `t`.
#[inline(always)]
fn is_small(x: &Extent, y: &Extent, t: i32, footprint: Footprint) -> bool {
    i64::from(t) >= footprint.reaches(x.width.max(y.width))
}

/// Whether a ray that runs from height `z_in` to `z_out` over a part of the surface meets the part's box: the test of which a walk consists
/// (eq. 49-50, the ray being cut to the part already). Heights of magnitude below 64. Cost: about 30 Cortex-M4 instructions.
#[inline]
pub fn meets(f: &Cell, g: &Cell, z_in: Real, z_out: Real) -> bool {
    meets_bits(f, g, z_in.to_bits(), z_out.to_bits())
}

#[inline(always)]
pub(super) fn meets_bits(f: &Cell, g: &Cell, z_in: i32, z_out: i32) -> bool {
    let (low, high) = range(f, g);
    let (z_low, z_high) = if z_in < z_out { (z_in, z_out) } else { (z_out, z_in) };
    z_low <= high && z_high >= low
}

/// Bounds of the product of two ranges (eq. 49), 24 fractional bits, outward by at most one unit more than need be.
#[inline(always)]
pub(super) fn range(f: &Cell, g: &Cell) -> (i32, i32) {
    let product = |a: Real, b: Real| i64::from(a.to_bits()) * i64::from(b.to_bits());
    // one product an end where the signs decide which
    let (low, high) = if f.min >= 0 {
        let low = product(if g.min >= 0 { f.min } else { f.max }, g.min);
        (low, product(if g.max >= 0 { f.max } else { f.min }, g.max))
    } else if g.min >= 0 {
        (product(f.min, g.max), product(f.max, if f.max >= 0 { g.max } else { g.min }))
    } else {
        let (a, b) = (product(f.min, g.max), product(f.max, g.min));
        let (c, d) = (product(f.min, g.min), product(f.max, g.max));
        (a.min(b).min(d), c.max(d).max(a))
    };
    // HeightField::new has checked that the products stay below 64
    ((low >> 24) as i32, (high >> 24) as i32 + 1)
}
