//! The walk through a height field whose nodes have two equal parts along each axis: a quadtree, the ordinary case.
//!
//! No stack: where the walk stands is two numbers, and the nodes around it are their leading digits. Leaving a part whose last digit says "far" leaves its
//! parent as well, so that the digits that say so, counted from the last, are the levels to rise. A plane takes one multiplication at whatever level:
//! `t = middle + whole u`, `u` its place in `[-1/2, 1/2]` along the ray's way across the surface. Of a node's four parts at most three are tested.
//! (After J. Revelles, C. Urena, M. Lastra, "An efficient parametric algorithm for octree traversal", 2000.)
//!
//! Parameters have 24 fractional bits in 32. A ray so nearly parallel to a plane, or so steep, that it leaves that range above the surface is left to the
//! general walk; the two find the same leaves.

use core::num::NonZeroU32;

use super::boxes::meets_bits;
use super::height_field::{HeightField, Leaf, Side};
use super::ray::{Footprint, Ray, parameters};
use super::statistics::Count;

/// When the ray crosses the planes along one axis.
#[derive(Debug, Clone, Copy)]
struct Line {
    /// Parameter at the middle plane of the surface.
    middle: i32,
    /// Twice what the ray takes across it.
    twice: i32,
    /// 1 if the ray comes from above, and the second of two parts is its first.
    from_above: u32,
}

/// Where a walk stands along one axis.
#[derive(Debug, Clone, Copy)]
struct Place {
    /// Number of the node: the parts of `q` are `2 q + 1` and `2 q + 2`.
    node: u32,
    /// The plane at which the ray leaves it, 31 fractional bits, and the parameter there.
    end: i32,
    next: i32,
}

/// `u` = 1/2.
const HALF: i32 = 1 << 30;

impl Line {
    /// None where a parameter might leave its format.
    #[inline(always)]
    fn new(side: &Side<'_>, origin: i32, direction: i32) -> Option<Self> {
        let distance = (side.origin + side.width / 2).wrapping_sub(origin);
        let magnitude = direction.unsigned_abs();
        // distance / magnitude, with 24 and 28 fractional bits, is below 64
        if magnitude <= distance.unsigned_abs().max(side.width.unsigned_abs()) >> 2 {
            return None;
        }
        let distance = if direction < 0 { distance.wrapping_neg() } else { distance };
        let [middle, whole] = parameters([distance, side.width], NonZeroU32::new(magnitude)?);
        Some(Self { middle, twice: whole << 1, from_above: (direction as u32) >> 31 })
    }

    /// The parameter at the plane `u`.
    #[inline(always)]
    fn at(&self, u: i32) -> i32 {
        self.middle.wrapping_add(((i64::from(self.twice) * i64::from(u)) >> 32) as i32)
    }

    /// The parameter at the surface's near plane.
    #[inline(always)]
    fn near(&self) -> i32 {
        self.middle.wrapping_add(self.twice.wrapping_neg() >> 2)
    }

    /// From the first of two parts to the second.
    #[inline(always)]
    fn step(&self) -> u32 {
        1_u32.wrapping_sub(self.from_above << 1)
    }
}

impl Place {
    #[inline(always)]
    fn root(line: &Line) -> Self {
        Self { node: 0, end: HALF, next: line.middle.wrapping_add(line.twice >> 2) }
    }

    /// Into the part, `size` wide, in which the ray is at `t`.
    #[inline(always)]
    fn descend(&mut self, line: &Line, size: u32, t: i32) {
        let middle = self.end.wrapping_sub(size as i32);
        let next = line.at(middle);
        self.node = 2 * self.node + 1 + line.from_above;
        if next > t {
            (self.end, self.next) = (middle, next);
        } else {
            self.node = self.node.wrapping_add(line.step());
        }
    }

    /// Over the plane at its end, into the next node, and out of the nodes that end there too. None at the end of the surface.
    #[inline(always)]
    fn advance(&mut self, line: &Line, aside: &mut Self, line_aside: &Line, size: &mut u32) -> Option<()> {
        // the last digit that does not say "far"
        let near = (self.node + 1) ^ line.from_above.wrapping_sub(1);
        if near & 1 == 0 {
            let levels = near.trailing_zeros() & 31;
            *size <<= levels;
            if *size as i32 <= 0 {
                return None;
            }
            self.node = ((self.node + 1) >> levels).wrapping_sub(1);
            aside.node = ((aside.node + 1) >> levels).wrapping_sub(1);
            aside.end = (aside.end.wrapping_sub(1) | size.wrapping_sub(1) as i32).wrapping_add(1);
            aside.next = line_aside.at(aside.end);
        }
        self.node = self.node.wrapping_add(line.step());
        self.end = self.end.wrapping_add(*size as i32);
        self.next = line.at(self.end);
        Some(())
    }
}

/// A footprint made ready for the walk of one surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cone {
    pub(super) footprint: Footprint,
    /// From where on the whole surface is small: twice that parameter less its last `shift` bits.
    small: u32,
    shift: u32,
}

impl HeightField<'_> {
    pub(super) fn cone(&self, footprint: Footprint) -> Cone {
        let small = footprint.reaches(self.x.width.max(self.y.width)).max(0);
        // at most 31: a width has 31 bits, the reciprocal of a footprint 32
        let shift = 33_u32.saturating_sub(small.leading_zeros());
        Cone { footprint, small: ((small >> shift) << 1) as u32, shift }
    }
}

impl HeightField<'_> {
    #[inline(never)]
    pub(super) fn walk_halves(&self, ray: &Ray, cone: &Cone, count: &mut impl Count) -> Option<Leaf> {
        let ([ox, oy, oz], [dx, dy, dz]) = (ray.origin, ray.direction);
        let (Some(line_x), Some(line_y)) = (Line::new(&self.x, ox, dx), Line::new(&self.y, oy, dy)) else {
            return self.walk_parts(ray, cone.footprint, count);
        };
        let (mut x, mut y) = (Place::root(&line_x), Place::root(&line_y));
        let z_at = |t: i32| oz.wrapping_add(((i64::from(dz) * i64::from(t)) >> 28) as i32);
        let end = x.next.min(y.next);
        if !(-1 << 26..1 << 26).contains(&((i64::from(dz) * i64::from(end)) >> 32)) {
            // 64 or more upwards or downwards
            return self.walk_parts(ray, cone.footprint, count);
        }
        count.ray();
        let mut t = line_x.near().max(line_y.near()).max(0);
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
        if z.max(z_end) < low || z.min(z_end) > high {
            return None;
        }
        let (cells_x, cells_y) = (self.x.cells, self.y.cells);
        let (mut size, last) = (1_u32 << 31, (1 << 31) >> self.depth());
        let mut next = end;
        loop {
            // the ray meets the node where the walk stands
            let small = ((u64::from(cone.small) * u64::from(size)) >> 32) as i32;
            if size <= last || t >> (cone.shift & 31) >= small {
                return Some(Leaf { nodes: (x.node, y.node), span: (t, next) });
            }
            size >>= 1;
            x.descend(&line_x, size, t);
            y.descend(&line_y, size, t);
            count.depth(size.leading_zeros());
            loop {
                next = x.next.min(y.next);
                let z_next = z_at(next);
                let (f, g) = (cells_x.get(x.node as usize)?, cells_y.get(y.node as usize)?);
                count.test();
                if meets_bits(f, g, z, z_next) {
                    break;
                }
                (t, z) = (next, z_next);
                if x.next <= y.next {
                    x.advance(&line_x, &mut y, &line_y, &mut size)?;
                } else {
                    y.advance(&line_y, &mut x, &line_x, &mut size)?;
                }
            }
        }
    }
}
