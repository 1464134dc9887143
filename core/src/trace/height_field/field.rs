//! Where a ray meets the height field `h(x, y) = f(x) g(y)`.
//!
//! A walk through the hierarchy of boxes from front to back finds the first leaf that the ray meets; the part
//! of the ray inside the leaf's box gives the hit.
//!
//! Formats: lengths and `t` 24 fractional bits, directions 28.
//!
//! Source: Cochran, Lewis, Hart, section 4, Algorithm 3.

use super::super::ray::{Footprint, Ray};
use super::boxes::range;
use super::halves::Pencil;
use super::hierarchy::{Hierarchy, Leaf, Profile};
use super::statistics::{Count, Statistics, Uncounted};
use crate::Error;
use crate::fif::{Cell, Pyramid};
use crate::num::{Real, Unit, Vec3, Wide};

/// A height field `f(x) g(y)` as the pyramids of its factors.
#[derive(Debug, Clone, Copy)]
pub struct HeightField<'a> {
    pub(crate) hierarchy: Hierarchy<'a>,
    /// Whether nodes have two equal parts along both axes.
    halved: bool,
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
    /// The mean normal of the surface over the leaf, `(-mean h_x, -mean h_y, 1)`, components saturated at
    /// ±64.
    pub fn normal(&self) -> Vec3 {
        let [x, y, z] = normal(&self.cells.0, &self.cells.1).map(Real::from_bits);
        Vec3::new(x, y, z)
    }
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
        let (x, y) = (Profile::new("domain along x", x)?, Profile::new("domain along y", y)?);
        let halved = x.is_halved() && y.is_halved();
        Ok(Self { hierarchy: Hierarchy { x, y, depth, leaves, heights: range(&f, &g) }, halved })
    }

    /// The depth of the tree, at most [`Pyramid::MAX_DEPTH`]: no more than this many frames are on the stack
    /// of a walk.
    pub const fn depth(&self) -> u32 {
        self.hierarchy.depth
    }

    /// Rigorous bounds of the heights.
    pub fn heights(&self) -> (Real, Real) {
        let (low, high) = self.hierarchy.heights;
        (Real::from_bits(low), Real::from_bits(high))
    }

    /// The surface's box, 24 fractional bits: both ends along x, y and z.
    pub(crate) fn extent(&self) -> [[i32; 2]; 3] {
        self.hierarchy.extent()
    }

    /// The rays with this footprint that leave `origin` (24 fractional bits), ready for walks.
    pub(crate) fn pencil<const WIDE: bool>(&self, origin: [i32; 3], footprint: Footprint) -> Pencil<WIDE> {
        self.hierarchy.pencil(origin, footprint)
    }

    /// The first leaf that the ray meets. A node is a leaf at the deepest level, or where it is no wider than
    /// `footprint` times the ray's parameter.
    ///
    /// Rays that start inside the surface's box and rays parallel to a plane are handled; the smallest
    /// `t` is 0.
    ///
    /// Error: of `t` below `2^-21` over the least component of the direction, as planes are known to a unit;
    /// the leaf is the exact one but for fewer than one ray in 500, which pass the edge of a box (row
    /// `HeightField::intersect (depth)`). Cost: 26.6 Cortex-M4 instructions (kernel `box test`) a box test.
    pub fn intersect(&self, ray: &Ray, footprint: Unit) -> Option<Hit> {
        self.intersect_by(ray, footprint, &mut Uncounted)
    }

    /// The leaf alone: all that shading needs.
    #[inline(always)]
    pub(crate) fn leaf<const WIDE: bool>(
        &self,
        pencil: &Pencil<WIDE>,
        direction: &[i32; 3],
        count: &mut impl Count,
    ) -> Option<Leaf> {
        if self.halved {
            self.hierarchy.walk_halves(pencil, direction, count)
        } else {
            self.hierarchy.walk_parts(&pencil.ray(direction), pencil.footprint, count)
        }
    }

    /// As [`HeightField::intersect`], and adds to `statistics` what it took.
    pub fn intersect_counted(&self, ray: &Ray, footprint: Unit, statistics: &mut Statistics) -> Option<Hit> {
        self.intersect_by(ray, footprint, statistics)
    }

    #[inline(always)]
    fn intersect_by(&self, ray: &Ray, footprint: Unit, count: &mut impl Count) -> Option<Hit> {
        self.first_hit(&self.pencil(ray.origin, Footprint::new(footprint)), &ray.direction, count)
    }

    /// The first leaf that a ray of a pencil meets, and where.
    #[inline(always)]
    pub(crate) fn first_hit(
        &self,
        pencil: &Pencil,
        direction: &[i32; 3],
        count: &mut impl Count,
    ) -> Option<Hit> {
        self.leaf(pencil, direction, count).and_then(|leaf| self.hit(&pencil.ray(direction), &leaf))
    }

    /// The cells of a leaf along x and y.
    #[inline(always)]
    fn cells(&self, leaf: &Leaf) -> Option<(&'a Cell, &'a Cell)> {
        let Hierarchy { x, y, .. } = &self.hierarchy;
        Some((x.cells.get(leaf.nodes.0 as usize)?, y.cells.get(leaf.nodes.1 as usize)?))
    }

    /// The mean normal over a leaf.
    #[inline(always)]
    pub(crate) fn normal(&self, leaf: &Leaf) -> [i32; 3] {
        // a walk's nodes have cells
        self.cells(leaf).map_or([0, 0, 1 << 24], |(f, g)| normal(f, g))
    }

    /// The middle of a ray's part inside a leaf's box, 24 fractional bits.
    pub(super) fn middle(&self, ray: &Ray, leaf: &Leaf) -> Option<i32> {
        let (f, g) = self.cells(leaf)?;
        let (low, high) = range(f, g);
        let z = ray.upright();
        let (t_in, t_out) = z.clip(low, high, leaf.span);
        // a ray that only touches the box may round to an empty part
        Some(if t_in <= t_out { t_in + (t_out - t_in) / 2 } else { leaf.span.0 })
    }

    fn hit(&self, ray: &Ray, leaf: &Leaf) -> Option<Hit> {
        let ((f, g), t) = (self.cells(leaf)?, self.middle(ray, leaf)?);
        let Hierarchy { x, y, .. } = &self.hierarchy;
        let ((level, i), (_, j)) = (x.level_and_index(leaf.nodes.0), y.level_and_index(leaf.nodes.1));
        Some(Hit { level, index: (i, j), t: Real::from_bits(t), cells: (*f, *g) })
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::exact::with_polygon;
    use super::*;

    /// Minus the products of slopes and means: towards plus infinity by a unit at most, saturated at 64.
    #[test]
    fn a_normal_is_minus_the_products_exactly() {
        let numbers = [
            0,
            1,
            -1,
            (1 << 24) - 1,
            12_345_679,
            -98_765_431,
            64 << 24,
            (8 << 24) + 1,
            -(8 << 24),
            i32::MAX,
            i32::MIN,
        ];
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

    /// A plane of height `c` above `[x0, x1]`, as the pyramid of one factor.
    fn with_level<R>(x0: Wide, x1: Wide, c: Wide, depth: u32, then: impl FnOnce(&Pyramid<'_>) -> R) -> R {
        with_polygon(&[(x0, c), (x0 + (x1 - x0) / 2, c), (x1, c)], depth, then)
    }

    /// Straight down on `f(x) g(y)` of two tents: the leaf under the ray, in the middle of its box.
    #[test]
    fn a_hit_is_in_the_middle_of_the_box_of_the_leaf_below() {
        let whole = |n: i32| Wide::from_num(n);
        let tent = [(whole(-1), whole(1)), (whole(1), whole(3)), (whole(3), whole(0))];
        let other = [(whole(-1), whole(2)), (whole(1), whole(1)), (whole(3), whole(4))];
        with_polygon(&tent, 3, |f| {
            with_polygon(&other, 5, |g| {
                let surface = HeightField::new(f, g).unwrap();
                // the shallower of the two
                assert_eq!((surface.depth(), surface.hierarchy.leaves), (3, 7));
                assert_eq!(HeightField::new(g, f).unwrap().depth(), 3);
                let heights = surface.heights();
                assert_eq!((heights.0.to_bits(), heights.1.to_bits()), range(&f.root(), &g.root()));
                assert_eq!(surface.extent()[..2], [[-(1 << 24), 3 << 24]; 2]);
                for i in 0..8 {
                    for j in 0..8 {
                        // leaves are 1/2 wide: a quarter and an eighth from their lower ends
                        let place = |k: i32, part: i32| Real::from_bits((k << 23) - (1 << 24) + part);
                        let eye = Vec3::new(place(i, 1 << 21), place(j, 1 << 22), Real::from_num(20));
                        let down = Vec3::new(Real::ZERO, Real::ZERO, -Real::ONE / 2);
                        let hit = surface.intersect(&Ray::new(eye, down), Unit::ZERO).unwrap();
                        assert_eq!((hit.level, hit.index), (3, (i as u32, j as u32)));
                        let (f, g) = (f.level(3)[i as usize], g.level(3)[j as usize]);
                        assert_eq!(hit.cells, (f, g));
                        let end = |a: Real, b: Real| (i64::from(a.to_bits()) * i64::from(b.to_bits())) >> 24;
                        let (low, high) = (end(f.min, g.min), end(f.max, g.max));
                        let product =
                            |a: Real, b: Real| (i64::from(a.to_bits()) * i64::from(b.to_bits())) >> 24;
                        let exact = [-product(f.slope, g.mean), -product(f.mean, g.slope), 1 << 24];
                        let normal = hit.normal();
                        assert_eq!([normal.x, normal.y, normal.z].map(|c| i64::from(c.to_bits())), exact);
                        let leaf = Leaf { nodes: (7 + i as u32, 7 + j as u32), span: (0, 0) };
                        assert_eq!(surface.normal(&leaf).map(i64::from), exact);
                        // twice 20 less the middle height
                        let exact = (40 << 24) - low - high;
                        assert!(
                            (i64::from(hit.t.to_bits()) - exact).abs() <= 4,
                            "{i} {j}: {} {exact}",
                            hit.t
                        );
                        let up = Ray::new(eye, Vec3::new(Real::ZERO, Real::ZERO, Real::ONE));
                        assert!(surface.intersect(&up, Unit::ZERO).is_none());
                        let mut statistics = Statistics::default();
                        let counted =
                            surface.intersect_counted(&Ray::new(eye, down), Unit::ZERO, &mut statistics);
                        assert_eq!((counted, statistics.rays), (Some(hit), 1));
                    }
                }
                // aslant, by the walk of halves: inside as many nodes as there are levels
                let mut statistics = Statistics::default();
                let eye = Vec3::new(-Real::ONE, -Real::ONE, Real::from_num(7));
                let ray = Ray::new(eye, Vec3::new(Real::ONE / 2, Real::ONE / 4, -Real::ONE));
                assert!(surface.intersect_counted(&ray, Unit::ZERO, &mut statistics).is_some());
                assert_eq!(statistics.stack, 3);
                // a footprint as wide as the whole surface takes it for a leaf
                let eye = Vec3::new(Real::ONE, Real::ONE, Real::from_num(20));
                let down = Vec3::new(Real::ZERO, Real::ZERO, -Real::ONE);
                assert_eq!(surface.intersect(&Ray::new(eye, down), Unit::ONE).unwrap().level, 0);
            });
        });
    }

    /// The part of the ray inside the leaf's box may round to nothing.
    #[test]
    fn a_ray_that_only_touches_a_box_hits_where_it_comes_above_it() {
        let whole = |n: i32| Wide::from_num(n);
        with_level(whole(0), whole(1), whole(1), 1, |f| {
            let surface = HeightField::new(f, f).unwrap();
            let ray = Ray::new(Vec3::default(), Vec3::new(Real::ONE, Real::ONE, Real::ONE));
            let hit = |span| surface.hit(&ray, &Leaf { nodes: (1, 2), span }).unwrap();
            // at height 1 from t = 1 on
            assert_eq!(hit((7, 99)).t.to_bits(), 7);
            let inside = hit((0, 5 << 24)).t.to_bits();
            assert!((inside - (1 << 24)).abs() <= 4, "{inside}");
            assert_eq!((hit((7, 99)).level, hit((7, 99)).index), (1, (0, 1)));
            assert!(surface.hit(&ray, &Leaf { nodes: (1, 3), span: (0, 1) }).is_none());
            assert_eq!(surface.normal(&Leaf { nodes: (3, 1), span: (0, 1) }), [0, 0, 1 << 24]);
        });
    }

    /// From -64 to the last place before 64, and heights below 64.
    #[test]
    fn a_surface_is_refused_from_its_limits_on() {
        let (limit, unit) = (Wide::from_num(64), Wide::DELTA);
        let refused = |x0: Wide, x1: Wide| {
            with_level(x0, x1, Wide::ONE, 1, |f| {
                with_level(Wide::ZERO, Wide::ONE, Wide::ONE, 1, |g| {
                    let error = |surface: Result<HeightField<'_>, Error>| match surface {
                        Err(Error::OutOfRange { what, value, .. }) => Some((what, value)),
                        other => other.map(|_| None).unwrap(),
                    };
                    let (x, y) = (error(HeightField::new(f, g)), error(HeightField::new(g, f)));
                    assert_eq!(x.map(|(_, value)| value), y.map(|(_, value)| value));
                    assert!(y.is_none_or(|(what, _)| what == "domain along y"));
                    x
                })
            })
        };
        let along_x = |value: Wide| Some(("domain along x", value));
        assert_eq!(refused(-limit, Wide::ONE), None);
        assert_eq!(refused(-limit - unit, Wide::ONE), along_x(-limit - unit));
        assert_eq!(refused(Wide::ONE, limit - unit), None);
        assert_eq!(refused(Wide::ONE, limit), along_x(limit));
        // ends are rounded down, each by itself
        for (x0, x1, expected) in [(-1, (3 << 24) - 1, (-1, 3)), ((1 << 24) - 1, 3 << 24, (0, 3))] {
            with_level(Wide::from_bits(x0), Wide::from_bits(x1), Wide::ONE, 0, |f| {
                let Profile { origin, width, .. } = Profile::new("x", f).unwrap();
                assert_eq!((origin, width), expected);
            });
        }
    }

    /// The product of the factors' greatest values, exactly.
    #[test]
    fn heights_are_refused_from_64_on() {
        // the level whose pyramid has this greatest magnitude, by trying quarters of a unit
        let level = |bits: i64, sign: i64| {
            let level = |quarter: i64| Wide::from_bits(sign * ((bits << 24) - (quarter << 22)));
            let root = |c: Wide| with_level(Wide::ZERO, Wide::ONE, c, 1, |f| f.root());
            let magnitude = |cell: Cell| i64::from(cell.max.to_bits()).max(-i64::from(cell.min.to_bits()));
            (0..64).map(level).find(|c| magnitude(root(*c)) == bits).unwrap()
        };
        let refused = |f: Wide, g: Wide| {
            with_level(Wide::ZERO, Wide::ONE, f, 1, |f| {
                with_level(Wide::ZERO, Wide::ONE, g, 1, |g| match HeightField::new(f, g) {
                    Err(Error::OutOfRange { what: "height", value, .. }) => Some(value),
                    surface => surface.map(|_| None).unwrap(),
                })
            })
        };
        let one = 1 << 24;
        for (sign, other) in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
            let (unit, eight) = (level(one, sign), level(8 * one, sign));
            let [below, most, eight_too] = [64 * one - 1, 64 * one, 8 * one].map(|bits| level(bits, other));
            let limit = Some(Wide::from_num(64));
            for (f, g, expected) in [
                (unit, below, None),
                (unit, most, limit),
                (most, unit, limit),
                (below, unit, None),
                (eight, eight_too, limit),
            ] {
                assert_eq!(refused(f, g), expected, "{f} {g}");
            }
            assert_eq!(refused(level(32 * one, sign), level(one, other)), None);
        }
    }

    /// Equal halves along both axes alone have the walk of their own.
    #[test]
    fn a_surface_of_other_parts_is_walked_in_general() {
        let points = |middle: i64| [0, middle, 1 << 48].map(|x| (Wide::from_bits(x), Wide::ONE));
        // down to (0.6, 0.6, 1): in the first part where that ends at 3/4, in the second where it ends at 1/2
        let real =
            |x: f64, y: f64, z: f64| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
        let ray = Ray::new(real(-0.4, -0.4, 2.0), real(1.0, 1.0, -1.0));
        with_polygon(&points(1 << 47), 1, |even| {
            with_polygon(&points(3 << 46), 1, |uneven| {
                let halved = |x, y| HeightField::new(x, y).unwrap().halved;
                assert_eq!(
                    [halved(even, even), halved(even, uneven), halved(uneven, even), halved(uneven, uneven)],
                    [true, false, false, false]
                );
                let hit = |x, y| HeightField::new(x, y).unwrap().intersect(&ray, Unit::ZERO).unwrap().index;
                assert_eq!([hit(even, even), hit(even, uneven), hit(uneven, even)], [(1, 1), (1, 0), (0, 1)]);
            });
        });
        // three parts by two: level 1 has the nodes 1 to 3, or 1 and 2
        let thirds = [0, 1, 2, 3].map(|x| (Wide::from_num(x), Wide::ONE));
        with_polygon(&thirds, 2, |three| {
            with_polygon(&points(1 << 47), 2, |two| {
                let leaves = |x, y| HeightField::new(x, y).unwrap().hierarchy.leaves;
                assert_eq!([leaves(three, two), leaves(two, three)], [4, 3]);
            });
        });
        with_polygon(&points(3 << 46), 0, |whole| {
            let hit = HeightField::new(whole, whole).unwrap().intersect(&ray, Unit::ZERO).unwrap();
            assert_eq!((hit.level, hit.index), (0, (0, 0)));
        });
    }
}
