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

use super::ray::{Axis, Ray};
use crate::Error;
use crate::fif::{Cell, Pyramid};
use crate::num::{Real, Unit, Vec3, Wide};

/// A height field `f(x) g(y)` as the pyramids of its factors, for a stack of at most `STACK` frames.
#[derive(Debug, Clone, Copy)]
pub struct HeightField<'a, const STACK: usize = 16> {
    x: Side<'a>,
    y: Side<'a>,
    depth: u32,
}

/// One factor: its pyramid and its domain with 24 fractional bits.
#[derive(Debug, Clone, Copy)]
struct Side<'a> {
    cells: &'a [Cell],
    starts: &'a [u32],
    origin: i32,
    width: i32,
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
    #[inline]
    pub fn normal(&self) -> Vec3 {
        let (f, g) = &self.cells;
        let product = |a: Real, b: Real| {
            let p = (i64::from(a.to_bits()) * i64::from(b.to_bits())) >> 24;
            Real::from_bits(-(p.clamp(-(1 << 30), 1 << 30) as i32))
        };
        Vec3::new(product(f.slope, g.mean), product(f.mean, g.slope), Real::ONE)
    }
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

/// The extent of a node along one axis.
#[derive(Debug, Clone, Copy)]
struct Extent {
    index: u32,
    low: i32,
    width: i32,
}

/// A walk through the parts of one node.
#[derive(Debug, Clone, Copy)]
struct Frame {
    level: u32,
    /// Where the cells of the parts' level begin, along x and y.
    below: (u32, u32),
    x: Extent,
    y: Extent,
    /// The part where the walk stands.
    part: (i32, i32),
    t: i32,
    t_out: i32,
}

impl<'a> Side<'a> {
    fn new(name: &'static str, pyramid: &Pyramid<'a>) -> Result<Self, Error> {
        let (x0, width) = pyramid.domain_bits();
        let end = i128::from(x0) + i128::from(width);
        let limit = 64_i128 << 48;
        if i128::from(x0) < -limit || end > limit {
            let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
            let value = Wide::from_bits(if end > limit { end as i64 } else { x0 });
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
        Extent { index: 0, low: self.origin, width: self.width }
    }

    /// The left end of part `k` of a node; that of part `n` is the node's right end.
    #[inline]
    fn plane(&self, node: &Extent, k: i32) -> i32 {
        let offset = match self.starts.get(k as usize) {
            Some(start) => ((i64::from(*start) * i64::from(node.width)) >> 31) as i32,
            None => node.width,
        };
        node.low + offset
    }

    /// The part in which the walk begins: the first whose far plane the ray has not crossed at `t`.
    #[inline]
    fn enter(&self, axis: &Axis, node: &Extent, t: i32) -> i32 {
        let last = self.starts.len() as i32 - 1;
        if axis.direction > 0 {
            let mut k = 0;
            while k < last && axis.crossing(self.plane(node, k + 1)) <= t {
                k += 1;
            }
            k
        } else if axis.direction < 0 {
            let mut k = last;
            while k > 0 && axis.crossing(self.plane(node, k)) <= t {
                k -= 1;
            }
            k
        } else {
            let mut k = 0;
            while k < last && self.plane(node, k + 1) <= axis.origin {
                k += 1;
            }
            k
        }
    }

    /// Where the ray leaves part `k`.
    #[inline]
    fn leave(&self, axis: &Axis, node: &Extent, k: i32) -> i32 {
        if axis.direction > 0 {
            axis.crossing(self.plane(node, k + 1))
        } else if axis.direction < 0 {
            axis.crossing(self.plane(node, k))
        } else {
            i32::MAX
        }
    }

    /// The index of part `k` of a node in its level.
    #[inline]
    fn child(&self, node: &Extent, k: i32) -> u32 {
        node.index * self.starts.len() as u32 + k as u32
    }

    /// Where the cells of the level begin that is below the one that begins at `offset`.
    #[inline]
    fn below(&self, offset: u32) -> u32 {
        offset * self.starts.len() as u32 + 1
    }

    #[inline]
    fn cell(&self, offset: u32, index: u32) -> Option<&'a Cell> {
        self.cells.get((offset + index) as usize)
    }

    #[inline]
    fn part(&self, node: &Extent, k: i32) -> Extent {
        let low = self.plane(node, k);
        Extent { index: self.child(node, k), low, width: self.plane(node, k + 1) - low }
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
        Ok(Self { x: Side::new("domain along x", x)?, y: Side::new("domain along y", y)?, depth })
    }

    /// The depth of the tree: no more than this many frames are on the stack.
    pub const fn depth(&self) -> u32 {
        self.depth
    }

    /// Rigorous bounds of the heights.
    pub fn heights(&self) -> (Real, Real) {
        let (low, high) = self.range(0, 0, 0, 0).unwrap_or((0, 0));
        (Real::from_bits(low), Real::from_bits(high))
    }

    /// The first leaf that the ray meets. A node is a leaf at the deepest level, or where it is no wider than `footprint` times the ray's parameter.
    ///
    /// Rays that start inside the surface's box and rays parallel to a plane are handled; the smallest `t` is 0.
    ///
    /// Error: the leaf is the exact one unless the ray passes a box within `2^-22` (tests/pictures.rs). Cost: about 30 Cortex-M4 instructions a box test.
    pub fn intersect(&self, ray: &Ray, footprint: Unit) -> Option<Hit> {
        self.walk(ray, footprint.to_bits(), &mut Statistics::default())
    }

    /// As [`HeightField::intersect`], and adds to `statistics` what it took.
    pub fn intersect_counted(&self, ray: &Ray, footprint: Unit, statistics: &mut Statistics) -> Option<Hit> {
        self.walk(ray, footprint.to_bits(), statistics)
    }

    #[inline]
    fn walk(&self, ray: &Ray, footprint: i32, statistics: &mut Statistics) -> Option<Hit> {
        statistics.rays = statistics.rays.wrapping_add(1);
        statistics.box_tests = statistics.box_tests.wrapping_add(1);
        let (low, high) = self.range(0, 0, 0, 0)?;
        let (x, y) = (self.x.whole(), self.y.whole());
        let mut span = (0, i32::MAX);
        span = ray.x.clip(x.low, x.low + x.width, span);
        span = ray.y.clip(y.low, y.low + y.width, span);
        span = ray.z.clip(low, high, span);
        if span.0 > span.1 || span.1 == i32::MAX {
            return None;
        }
        if self.is_leaf(0, &x, &y, span.0, footprint) {
            return self.hit(ray, 0, (0, 0), (0, 0), span);
        }
        let mut stack = Vec::<Frame, STACK>::new();
        let mut frame = self.enter(ray, 0, (1, 1), (x, y), span);
        loop {
            // the part where the walk stands, up to the next plane
            let (a, b) = frame.part;
            let next_x = self.x.leave(&ray.x, &frame.x, a);
            let next_y = self.y.leave(&ray.y, &frame.y, b);
            let (t_in, t_out) = (frame.t, next_x.min(next_y).min(frame.t_out));
            let finished = t_out >= frame.t_out;
            statistics.box_tests = statistics.box_tests.wrapping_add(1);
            let index = (self.x.child(&frame.x, a), self.y.child(&frame.y, b));
            let (low, high) = self.range(frame.below.0, index.0, frame.below.1, index.1)?;
            let (z_in, z_out) = (ray.z.at(t_in), ray.z.at(t_out));
            if z_in.min(z_out) <= high && z_in.max(z_out) >= low {
                let (x, y) = (self.x.part(&frame.x, a), self.y.part(&frame.y, b));
                let (level, below) = (frame.level + 1, frame.below);
                if self.is_leaf(level, &x, &y, t_in, footprint) {
                    return self.hit(ray, level, below, index, (t_in, t_out));
                }
                if !finished {
                    // never full: at most one frame for each level above the leaves, and depth <= STACK
                    let _ = stack.push(frame.advanced(ray, next_x <= next_y, t_out));
                    statistics.stack = statistics.stack.max(stack.len() as u32);
                }
                let below = (self.x.below(below.0), self.y.below(below.1));
                frame = self.enter(ray, level, below, (x, y), (t_in, t_out));
            } else if finished {
                frame = stack.pop()?;
            } else {
                frame = frame.advanced(ray, next_x <= next_y, t_out);
            }
        }
    }

    #[inline]
    fn enter(
        &self,
        ray: &Ray,
        level: u32,
        below: (u32, u32),
        (x, y): (Extent, Extent),
        (t, t_out): (i32, i32),
    ) -> Frame {
        let part = (self.x.enter(&ray.x, &x, t), self.y.enter(&ray.y, &y, t));
        Frame { level, below, x, y, part, t, t_out }
    }

    #[inline]
    fn is_leaf(&self, level: u32, x: &Extent, y: &Extent, t: i32, footprint: i32) -> bool {
        level >= self.depth || i64::from(x.width.max(y.width)) <= (i64::from(t) * i64::from(footprint)) >> 30
    }

    fn hit(
        &self,
        ray: &Ray,
        level: u32,
        below: (u32, u32),
        index: (u32, u32),
        span: (i32, i32),
    ) -> Option<Hit> {
        let (f, g) = (self.x.cell(below.0, index.0)?, self.y.cell(below.1, index.1)?);
        let (low, high) = range(f, g);
        let (t_in, t_out) = ray.z.clip(low, high, span);
        // a ray that only touches the box may round to an empty part
        let t = if t_in <= t_out { t_in + (t_out - t_in) / 2 } else { span.0 };
        Some(Hit { level, index, t: Real::from_bits(t), cells: (*f, *g) })
    }

    #[inline]
    fn range(&self, x_below: u32, i: u32, y_below: u32, j: u32) -> Option<(i32, i32)> {
        Some(range(self.x.cell(x_below, i)?, self.y.cell(y_below, j)?))
    }
}

impl Frame {
    /// The walk after its part: one step along x or y, from `t` on.
    #[inline]
    fn advanced(mut self, ray: &Ray, along_x: bool, t: i32) -> Self {
        if along_x {
            self.part.0 += if ray.x.direction > 0 { 1 } else { -1 };
        } else {
            self.part.1 += if ray.y.direction > 0 { 1 } else { -1 };
        }
        self.t = t;
        self
    }
}

/// Bounds of the product of two ranges (eq. 49), 24 fractional bits, outward.
#[inline]
fn range(f: &Cell, g: &Cell) -> (i32, i32) {
    let product = |a: Real, b: Real| i64::from(a.to_bits()) * i64::from(b.to_bits());
    let (low, high) = if f.min >= 0 && g.min >= 0 {
        (product(f.min, g.min), product(f.max, g.max))
    } else {
        let (a, b, c, d) =
            (product(f.min, g.min), product(f.min, g.max), product(f.max, g.min), product(f.max, g.max));
        (a.min(b).min(c).min(d), a.max(b).max(c).max(d))
    };
    // HeightField::new has checked that the products stay below 64
    ((low >> 24) as i32, ((high + ((1 << 24) - 1)) >> 24) as i32)
}
