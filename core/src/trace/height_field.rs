//! Where a ray meets the height field `h(x, y) = f(x) g(y)`.
//!
//! The cells of both pyramids span an implicit tree of boxes, `N M` parts a node; a walk through it from front to back finds the first leaf that the ray
//! meets, in [`super::halves`] where nodes have two equal parts along each axis, in [`super::parts`] elsewhere.
//!
//! Formats: lengths and `t` 24 fractional bits, directions 28.
//!
//! Source: Cochran, Lewis, Hart, section 4, Algorithm 3.

use super::boxes::range;
use super::halves::Cone;
use super::ray::{Footprint, Ray};
use super::statistics::{Count, Statistics, Uncounted};
use crate::Error;
use crate::fif::{Cell, Pyramid};
use crate::num::{Real, Unit, Vec3, Wide};

/// A height field `f(x) g(y)` as the pyramids of its factors.
#[derive(Debug, Clone, Copy)]
pub struct HeightField<'a> {
    pub(super) x: Side<'a>,
    pub(super) y: Side<'a>,
    depth: u32,
    /// The first node of the deepest level along x.
    pub(super) leaves: u32,
    /// Whether nodes have two equal parts along both axes.
    halved: bool,
    /// Bounds of all heights, 24 fractional bits.
    pub(super) heights: (i32, i32),
}

/// One factor: its pyramid and its domain with 24 fractional bits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side<'a> {
    pub(super) cells: &'a [Cell],
    pub(super) starts: &'a [u32],
    pub(super) origin: i32,
    pub(super) width: i32,
}

/// The leaf that a ray meets first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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

/// A leaf as the walk finds it: its nodes along x and y, the ray's part above it.
pub(super) struct Leaf {
    pub(super) nodes: (u32, u32),
    pub(super) span: (i32, i32),
}

/// The mean normal over a leaf, 24 fractional bits, saturated at ±64.
#[inline(always)]
fn normal(f: &Cell, g: &Cell) -> [i32; 3] {
    let minus_product = |a: Real, b: Real| {
        let product = i64::from(a.to_bits()) * i64::from(b.to_bits());
        let high = (product >> 32) as i32;
        let saturated = ((high >> 31) | 1).wrapping_neg() << 30;
        if (-1 << 22..1 << 22).contains(&high) { -((product >> 24) as i32) } else { saturated }
    };
    [minus_product(f.slope, g.mean), minus_product(f.mean, g.slope), 1 << 24]
}

impl<'a> Side<'a> {
    #[inline(never)]
    fn new(name: &'static str, pyramid: &Pyramid<'a>) -> Result<Self, Error> {
        let (x0, width) = pyramid.domain_bits();
        let end = x0.saturating_add_unsigned(width);
        // below 64, so that the width fits
        let limit = 64 << 48;
        if x0 < -limit || end >= limit {
            let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
            let value = Wide::from_bits(if end >= limit { end } else { x0 });
            return Err(Error::OutOfRange { what: name, index: None, value, min, max });
        }
        let origin = (x0 >> 24) as i32;
        Ok(Self {
            cells: pyramid.all(),
            starts: pyramid.starts(),
            origin,
            width: ((end >> 24) as i32) - origin,
        })
    }

    /// Whether a node has two equal parts, the ordinary case, for which [`super::halves`] has a walk of its own.
    fn is_halved(&self) -> bool {
        self.starts == [0, 1 << 30]
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

impl<'a> HeightField<'a> {
    /// The height field over the domains of two pyramids, down to the depth of the shallower one.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if a domain or the heights leave ±64.
    pub fn new(x: &Pyramid<'a>, y: &Pyramid<'a>) -> Result<Self, Error> {
        let depth = x.depth().min(y.depth());
        let (f, g) = (x.root(), y.root());
        let largest = |c: Cell| i64::from(c.min.to_bits()).abs().max(i64::from(c.max.to_bits()).abs());
        let height = (largest(f) * largest(g)) >> 24;
        if height >= 64 << 24 {
            let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
            return Err(Error::OutOfRange {
                what: "height",
                index: None,
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
        Ok(Self { x, y, depth, leaves, halved, heights: range(&f, &g) })
    }

    /// The depth of the tree, at most [`Pyramid::MAX_DEPTH`]: no more than this many frames are on the stack of a walk.
    pub const fn depth(&self) -> u32 {
        self.depth
    }

    /// Rigorous bounds of the heights.
    pub fn heights(&self) -> (Real, Real) {
        (Real::from_bits(self.heights.0), Real::from_bits(self.heights.1))
    }

    /// The surface's box, 24 fractional bits: both ends along x, y and z.
    pub(super) fn extent(&self) -> [[i32; 2]; 3] {
        let side = |s: &Side<'_>| [s.origin, s.origin + s.width];
        [side(&self.x), side(&self.y), [self.heights.0, self.heights.1]]
    }

    /// The first leaf that the ray meets. A node is a leaf at the deepest level, or where it is no wider than `footprint` times the ray's parameter.
    ///
    /// Rays that start inside the surface's box and rays parallel to a plane are handled; the smallest `t` is 0.
    ///
    /// Error: below `2^-16` in `t`, and the leaf is the exact one but for fewer than one ray in 500, which pass
    /// the edge of a box (row `HeightField::intersect (depth)`). Cost: 29.7
    /// Cortex-M4 instructions (kernel `box test`) a box test.
    pub fn intersect(&self, ray: &Ray, footprint: Unit) -> Option<Hit> {
        self.leaf(ray, &self.cone(Footprint::new(footprint)), &mut Uncounted)
            .and_then(|leaf| self.hit(ray, &leaf))
    }

    /// The leaf alone: all that shading needs.
    #[inline(always)]
    pub(super) fn leaf(&self, ray: &Ray, cone: &Cone, count: &mut impl Count) -> Option<Leaf> {
        if self.halved {
            self.walk_halves(ray, cone, count)
        } else {
            self.walk_parts(ray, cone.footprint, count)
        }
    }

    /// As [`HeightField::intersect`], and adds to `statistics` what it took.
    pub fn intersect_counted(&self, ray: &Ray, footprint: Unit, statistics: &mut Statistics) -> Option<Hit> {
        self.leaf(ray, &self.cone(Footprint::new(footprint)), statistics)
            .and_then(|leaf| self.hit(ray, &leaf))
    }

    /// The cells of a leaf along x and y.
    #[inline(always)]
    fn cells(&self, leaf: &Leaf) -> Option<(&'a Cell, &'a Cell)> {
        Some((self.x.cells.get(leaf.nodes.0 as usize)?, self.y.cells.get(leaf.nodes.1 as usize)?))
    }

    /// The mean normal over a leaf.
    #[inline(always)]
    pub(super) fn normal(&self, leaf: &Leaf) -> [i32; 3] {
        // a walk's nodes have cells
        self.cells(leaf).map_or([0, 0, 1 << 24], |(f, g)| normal(f, g))
    }

    fn hit(&self, ray: &Ray, leaf: &Leaf) -> Option<Hit> {
        let (f, g) = self.cells(leaf)?;
        let (low, high) = range(f, g);
        let [_, _, z] = ray.axes();
        let (t_in, t_out) = z.clip(low, high, leaf.span);
        // a ray that only touches the box may round to an empty part
        let t = if t_in <= t_out { t_in + (t_out - t_in) / 2 } else { leaf.span.0 };
        let ((level, i), (_, j)) = (self.x.place(leaf.nodes.0), self.y.place(leaf.nodes.1));
        Some(Hit { level, index: (i, j), t: Real::from_bits(t), cells: (*f, *g) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Minus the products of slopes and means: towards plus infinity by a unit at most, saturated at 64.
    #[test]
    fn a_normal_is_minus_the_products_exactly() {
        let numbers =
            [0, 1, -1, 12_345_679, -98_765_431, 64 << 24, (8 << 24) + 1, -(8 << 24), i32::MAX, i32::MIN];
        for slope in numbers {
            for mean in numbers {
                let f = Cell { slope: Real::from_bits(slope), ..Cell::ZERO };
                let g = Cell { mean: Real::from_bits(mean), ..Cell::ZERO };
                let exact = i64::from(slope) * i64::from(mean);
                let expected = if (-(64_i64 << 48)..64 << 48).contains(&exact) {
                    -(exact >> 24)
                } else if exact < 0 {
                    64 << 24
                } else {
                    -(64 << 24)
                };
                assert_eq!(normal(&f, &g).map(i64::from), [expected, 0, 1 << 24], "{slope} {mean}");
                assert_eq!(normal(&g, &f).map(i64::from), [0, expected, 1 << 24], "{slope} {mean}");
            }
        }
    }

    #[test]
    fn a_node_has_its_place_in_its_level() {
        let side = Side { cells: &[], starts: &[0, 1 << 29, 1 << 30], origin: 0, width: 1 << 24 };
        let places = [0, 1, 3, 4, 12, 13, 39].map(|node| side.place(node));
        assert_eq!(places, [(0, 0), (1, 0), (1, 2), (2, 0), (2, 8), (3, 0), (3, 26)]);
    }
}
