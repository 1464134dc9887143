//! The copier: all images of a shape, a polyline or a set of points, under the maps of a system composed `k`
//! times, one after the other.
//!
//! It shows how an attractor comes about: a copying machine that reduces each sheet to `N` smaller copies,
//! fed with its own output. `I_{k+1} = w_1(I_k) u .. u w_N(I_k)`, `N^k` images at order `k`. They are visited
//! depth first, with a stack of composed maps `w_i1 o w_i2 o ..`; no image is ever stored. Source: course
//! unit V, sections 5.3.1 to 5.3.3 (`superCopier`).
//!
//! Formats: the linear part of a composed map has 30 fractional bits and is rounded once a level; its
//! translation has 54 and is exact for that linear part, `t' = A t_i + t`. An image of a point is rounded
//! once, at the end. Range: with the invariant disc of [`Ifs`], `|x|, |y| <= 64`, a composed map sends its
//! centre into it, hence the origin no farther than 64 + 91 and a point of [`Real`] no farther than 64 + 272:
//! below 512, the range of 54 fractional bits in 64. What leaves [`Real`] saturates.

use super::affine::Affine;
use super::system::Ifs;
use crate::Error;
use crate::num::formats::{Q30, Q54};
use crate::num::{Real, Unit, product};
use crate::plane::{PathElement, Point2};

/// A composed map, and which of the system's maps is composed with it next.
#[derive(Debug, Clone, Copy, Default)]
struct Composed {
    translation: [Q54; 2],
    linear: [Q30; 4],
    next: u32,
}

impl Composed {
    const IDENTITY: Self = Self { translation: [0; 2], linear: [1 << 30, 0, 0, 1 << 30], next: 0 };

    /// `self o map`.
    #[inline]
    fn with(&self, map: &Affine) -> Self {
        let [a, b, c, d] = self.linear;
        let [p, q, r, s] = [map.a, map.b, map.c, map.d].map(Unit::to_bits);
        // contractions: the rows of both have a norm of at most 1 and a rounding
        let entry =
            |l, m, p, q| (product(l, p).wrapping_add(product(m, q)).wrapping_add(1 << 29) >> 30) as i32;
        Self {
            translation: self.image(Point2::new(map.e, map.f)),
            linear: [entry(a, b, p, r), entry(a, b, q, s), entry(c, d, p, r), entry(c, d, q, s)],
            next: 0,
        }
    }

    /// The image of a point, before it is rounded.
    #[inline]
    fn image(&self, p: Point2) -> [Q54; 2] {
        let ([a, b, c, d], [e, f]) = (self.linear, self.translation);
        let (x, y) = (p.x.to_bits(), p.y.to_bits());
        [
            e.wrapping_add(product(a, x)).wrapping_add(product(b, y)),
            f.wrapping_add(product(c, x)).wrapping_add(product(d, y)),
        ]
    }

    #[inline]
    fn apply(&self, p: Point2) -> Point2 {
        let [x, y] = self.image(p).map(|c| {
            let bits = c.wrapping_add(1 << 29) >> 30;
            Real::from_bits(bits.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
        });
        Point2::new(x, y)
    }
}

/// The composed maps of order `k`, depth first.
#[derive(Debug, Clone)]
struct Compositions<'a, const N: usize, const DEPTH: usize> {
    ifs: &'a Ifs<N>,
    /// Those on the way down; the one at `level` is being composed.
    stack: [Composed; DEPTH],
    level: usize,
    order: usize,
    done: bool,
}

impl<const N: usize, const DEPTH: usize> Compositions<'_, N, DEPTH> {
    #[inline]
    fn next(&mut self) -> Option<Composed> {
        if self.done {
            return None;
        }
        if self.order == 0 {
            self.done = true;
            return Some(Composed::IDENTITY);
        }
        loop {
            // level < order <= DEPTH
            let composed = self.stack.get_mut(self.level)?;
            let index = composed.next as usize;
            let Some(map) = self.ifs.maps().get(index) else {
                match self.level.checked_sub(1) {
                    Some(above) => self.level = above,
                    None => {
                        self.done = true;
                        return None;
                    }
                }
                continue;
            };
            composed.next += 1;
            let below = composed.with(map);
            if self.level + 1 >= self.order {
                return Some(below);
            }
            self.level += 1;
            *self.stack.get_mut(self.level)? = below;
        }
    }
}

impl<const N: usize> Ifs<N> {
    /// The copier of this system set to `order`: images of a shape under all maps that are composed of
    /// `order` of its own. `DEPTH` is the largest order that fits.
    ///
    /// Error: of an image below `2^-20` in each coordinate at order 12 for a shape and translations within 2
    /// of the origin (`curves.rs`: `an_image_of_the_copier_is_within_two_to_the_minus_20`). Cost: 201
    /// Cortex-M4 instructions (kernel `copied point`) an image of a single point, the fern at order 5; 110
    /// (kernel `copied path`) a point for images of four.
    ///
    /// # Errors
    /// [`Error::Capacity`] when `order` exceeds `DEPTH`; [`Error::TooFew`] for an empty shape.
    ///
    /// ```
    /// use attractor::curve::koch;
    /// use attractor::ifs::catalogue;
    /// let gasket = catalogue::SIERPINSKI_GASKET.ifs::<3>()?;
    /// assert_eq!(gasket.copier::<12>(&koch::SEGMENT, 5)?.points().count(), 2 * 3_usize.pow(5));
    /// # Ok::<(), attractor::Error>(())
    /// ```
    pub fn copier<'a, const DEPTH: usize>(
        &'a self,
        shape: &'a [Point2],
        order: u32,
    ) -> Result<Copier<'a, N, DEPTH>, Error> {
        if shape.is_empty() {
            return Err(Error::TooFew { what: "points of the shape", given: 0, at_least: 1 });
        }
        let order = match usize::try_from(order) {
            Ok(order) if order <= DEPTH => order,
            other => {
                let needed = other.unwrap_or(usize::MAX);
                return Err(Error::Capacity { what: "orders", needed, capacity: DEPTH });
            }
        };
        let mut stack = [Composed::default(); DEPTH];
        if let Some(root) = stack.first_mut() {
            *root = Composed::IDENTITY;
        }
        let maps = Compositions { ifs: self, stack, level: 0, order, done: false };
        Ok(Copier { maps, shape, rest: &[], map: Composed::IDENTITY })
    }
}

/// The images of a shape, one after the other. Size on a 32-bit machine: 40 bytes for each of `DEPTH` orders,
/// and 72.
#[derive(Debug, Clone)]
pub struct Copier<'a, const N: usize, const DEPTH: usize> {
    maps: Compositions<'a, N, DEPTH>,
    shape: &'a [Point2],
    /// What is left of the shape under this map.
    rest: &'a [Point2],
    map: Composed,
}

impl<'a, const N: usize, const DEPTH: usize> Copier<'a, N, DEPTH> {
    /// The images as points: for a shape that is a set of points.
    pub const fn points(self) -> CopiedPoints<'a, N, DEPTH> {
        CopiedPoints(self)
    }

    /// The images as paths: for a shape that is a polyline.
    pub const fn path(self) -> CopiedPath<'a, N, DEPTH> {
        CopiedPath(self)
    }

    /// The next point and whether an image begins with it.
    #[inline]
    fn next(&mut self) -> Option<(bool, Point2)> {
        let begins = self.rest.is_empty();
        if begins {
            self.map = self.maps.next()?;
            self.rest = self.shape;
        }
        let (p, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some((begins, self.map.apply(*p)))
    }
}

/// The images of a set of points: see [`Copier::points`].
#[derive(Debug, Clone)]
pub struct CopiedPoints<'a, const N: usize, const DEPTH: usize>(Copier<'a, N, DEPTH>);

impl<const N: usize, const DEPTH: usize> Iterator for CopiedPoints<'_, N, DEPTH> {
    type Item = Point2;

    #[inline]
    fn next(&mut self) -> Option<Point2> {
        self.0.next().map(|(_, p)| p)
    }
}

/// The images of a polyline: see [`Copier::path`].
#[derive(Debug, Clone)]
pub struct CopiedPath<'a, const N: usize, const DEPTH: usize>(Copier<'a, N, DEPTH>);

impl<const N: usize, const DEPTH: usize> Iterator for CopiedPath<'_, N, DEPTH> {
    type Item = PathElement;

    #[inline]
    fn next(&mut self) -> Option<PathElement> {
        self.0.next().map(|(begins, p)| if begins { PathElement::MoveTo(p) } else { PathElement::LineTo(p) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ifs::catalogue;

    #[test]
    fn order_0_is_the_shape_itself() {
        let fern = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
        let shape = [Point2::new(Real::MIN, Real::MAX), Point2::new(Real::ONE, Real::ZERO)];
        assert!(fern.copier::<0>(&shape, 0).unwrap().points().eq(shape));
        let steps: heapless::Vec<PathElement, 8> = fern.copier::<3>(&shape, 0).unwrap().path().collect();
        assert_eq!(steps.as_slice(), [PathElement::MoveTo(shape[0]), PathElement::LineTo(shape[1])]);
    }

    #[test]
    fn each_order_is_the_union_of_the_images_of_the_one_before() {
        let fern = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
        let shape = [Point2::new(Real::ONE, Real::from_num(3))];
        for order in 1..6 {
            let images = fern.copier::<8>(&shape, order).unwrap().points();
            let before = || fern.copier::<8>(&shape, order - 1).unwrap().points();
            let expected = fern.maps().iter().flat_map(|m| before().map(|p| m.apply(p)));
            let mut count = 0_u32;
            for (got, want) in images.zip(expected) {
                assert!(got.x.abs_diff(want.x) < 3e-7 && got.y.abs_diff(want.y) < 3e-7);
                count += 1;
            }
            assert_eq!(count, 4_u32.pow(order));
        }
    }

    #[test]
    fn the_far_corners_of_the_format_saturate() {
        let map = Affine::from_thousandths([999, 0, 0, 999, 60, -60]);
        let ifs = Ifs::<1>::new(&[map], &[Unit::ONE]).unwrap();
        let shape = [Point2::new(Real::MAX, Real::MIN)];
        for order in 0..=12 {
            let p = ifs.copier::<12>(&shape, order).unwrap().points().next().unwrap();
            assert!(p.x > 126 && p.y < -126, "{p:?}");
        }
    }

    #[test]
    fn an_order_beyond_the_capacity_and_an_empty_shape_are_refused() {
        let fern = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
        let shape = [Point2::default()];
        let error = fern.copier::<12>(&shape, 13).unwrap_err();
        assert!(matches!(error, Error::Capacity { needed: 13, capacity: 12, .. }), "{error}");
        assert!(matches!(fern.copier::<12>(&[], 1), Err(Error::TooFew { .. })));
    }

    #[test]
    fn a_copier_of_depth_12_takes_at_most_600_bytes() {
        assert!(size_of::<CopiedPath<'_, 4, 12>>() <= 600, "{}", size_of::<CopiedPath<'_, 4, 12>>());
    }

    /// In integers: entries of a composed map rounded once to the nearest, the translation exact for them,
    /// the image rounded once.
    #[test]
    fn an_image_of_order_3_is_rounded_once_an_entry_and_once_at_the_end() {
        let fern = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
        let shape = [Point2::new(Real::from_bits(0x0123_4567), Real::from_bits(-0x0089_abcd))];
        let nearest = |v: i128| (v + (1 << 29)) >> 30;
        let bits = |m: &Affine| [m.a, m.b, m.c, m.d].map(|l| i128::from(l.to_bits()));
        let mut images = fern.copier::<3>(&shape, 3).unwrap().points();
        for address in 0..64 {
            let (mut l, mut t) = ([1_i128 << 30, 0, 0, 1 << 30], [0_i128; 2]);
            let image = |l: [i128; 4], t: [i128; 2], p: Point2| {
                let [x, y] = [p.x, p.y].map(|z| i128::from(z.to_bits()));
                [t[0] + l[0] * x + l[1] * y, t[1] + l[2] * x + l[3] * y]
            };
            for digit in [address / 16, address / 4 % 4, address % 4] {
                let map = &fern.maps()[digit];
                t = image(l, t, Point2::new(map.e, map.f));
                let ([a, b, c, d], [p, q, r, s]) = (l, bits(map));
                l = [a * p + b * r, a * q + b * s, c * p + d * r, c * q + d * s].map(nearest);
            }
            let got = images.next().unwrap();
            let want = image(l, t, shape[0]).map(nearest);
            assert_eq!([got.x, got.y].map(|z| i128::from(z.to_bits())), want, "{address}");
        }
        assert!(images.next().is_none() && images.next().is_none());
    }

    #[test]
    fn a_composed_map_has_the_nearest_entries_and_an_exact_translation() {
        let mut word = 1_u64;
        let mut entry = || {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (word >> 33) as i32 - (1 << 30)
        };
        for _ in 0..5000 {
            let [outer, inner] = [(); 2].map(|()| [entry(), entry(), entry(), entry()].map(|e| e / 2));
            let composed = Composed { translation: [1 << 40, -5], linear: outer, next: 0 };
            let translation = [entry(), entry()].map(Real::from_bits);
            let got = composed.with(&Affine::new(inner.map(Unit::from_bits), translation));
            let ([a, b, c, d], [p, q, r, s]) = (outer.map(i128::from), inner.map(i128::from));
            let exact = [a * p + b * r, a * q + b * s, c * p + d * r, c * q + d * s];
            assert_eq!(got.linear.map(i128::from), exact.map(|v| (v + (1 << 29)) >> 30));
            let [x, y] = translation.map(|t| i128::from(t.to_bits()));
            assert_eq!(got.translation.map(i128::from), [(1 << 40) + a * x + b * y, -5 + c * x + d * y]);
        }
    }

    #[test]
    fn images_outside_the_format_saturate() {
        let turn = Affine::from_ratios([7, -7, 7, 7, 0, 0], 10);
        let ifs = Ifs::<1>::new(&[turn], &[Unit::ONE]).unwrap();
        let shape = [Point2::new(Real::MAX, Real::MAX), Point2::new(Real::MIN, Real::MIN)];
        let images: heapless::Vec<Point2, 2> = ifs.copier::<1>(&shape, 1).unwrap().points().collect();
        assert_eq!([images[0].y, images[1].y], [Real::MAX, Real::MIN]);
        assert!(images.iter().all(|p| p.x.abs() <= Real::DELTA));
    }
}
