//! A shape put into a world by an affine map: rays go to its coordinates, what they meet comes back.
//!
//! `t` is the same on both sides: the direction is not normalised. A ray that comes near is moved along
//! itself to where it is closest to the shape, `t = t_0 + s 2^-k`; `t_0` has so few bits that the place there,
//! `M^-1 (o + t_0 d - c)`, is exact to `2^-29` at any distance. Normals come back by the inverse transpose,
//! tangents by the map itself.
//!
//! Source: the course unit V, section 5.7; Glassner (ed.), "An Introduction to Ray Tracing", 1989, section 2.7.

use core::ops::ControlFlow;

use super::super::ray::Ray;
use super::super::surface::{Chart, Crossing, Extent, Surface, SurfacePoint};
use super::placement::{Placement, shifted};
use super::shape::Shape;
use crate::Error;
use crate::num::{Affine3, Near, Real, Unit, Vec3, Wide, product};

/// A shape at its place in a world.
///
/// The map may scale by 1/64 to 64, and by a different factor along each axis; it may shear and mirror. For a
/// scale of 1 a crossing lies on the surface within `2^-22` (`a_crossing_lies_on_the_surface`); what is
/// 64 times larger or smaller, within `2^-22` of its size or of 1, whichever is more.
#[derive(Debug, Clone, Copy)]
pub struct Placed<S> {
    shape: S,
    placement: Placement,
    error: Real,
}

impl<S: Shape> Placed<S> {
    /// The shape under a map.
    ///
    /// # Errors
    /// [`Error::Degenerate`] for a map without an inverse; [`Error::OutOfRange`] for one that makes the shape
    /// 128 times as large or more, or as small as one 256th or less, or that puts its middle more than 64 from
    /// the origin along an axis.
    pub fn new(shape: S, map: &Affine3) -> Result<Self, Error> {
        let placement = Placement::new(shape.bounds(), map)?;
        let error = placement.error(shape.error());
        Ok(Self { shape, placement, error })
    }

    /// The shape.
    pub fn shape(&self) -> &S {
        &self.shape
    }
}

impl<S: Shape> Surface for Placed<S> {
    fn extent(&self) -> Extent {
        self.placement.extent
    }

    fn is_closed(&self) -> bool {
        self.shape.is_closed()
    }

    fn most_crossings(&self) -> u32 {
        self.shape.most_crossings()
    }

    fn faces(&self) -> u8 {
        self.shape.faces()
    }

    fn error(&self) -> Real {
        self.error
    }

    fn cross(&self, ray: &Ray, _: Unit, found: &mut impl FnMut(Crossing) -> ControlFlow<()>) {
        let Some(approach) = self.placement.approach(ray) else { return };
        self.shape.cross(
            &approach.near,
            approach.from,
            &mut |crossing| match approach.parameter(crossing.s) {
                Some(t) => found(Crossing {
                    t,
                    enters: crossing.enters,
                    face: crossing.face,
                    memo: [crossing.s.to_bits() as u32, 0],
                }),
                None => ControlFlow::Break(()),
            },
        );
    }

    fn value(&self, place: Vec3) -> Wide {
        self.shape.value(self.placement.place(place))
    }

    fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint {
        let position = ray.at(crossing.t);
        let (near, place) = self.placement.near_place(ray, crossing).map_or_else(
            || {
                let place = self.placement.place(position);
                let near = |c: Real| Near::from_bits(shifted(i64::from(c.to_bits()), 4));
                (Vec3::new(near(place.x), near(place.y), near(place.z)), place)
            },
            |near| {
                let real = |c: Near| Real::from_bits(((c.to_bits() >> 3) + 1) >> 1);
                (near, Vec3::new(real(near.x), real(near.y), real(near.z)))
            },
        );
        let chart = if charted {
            let chart = self.shape.chart(place, crossing.face);
            Chart {
                along_u: self.placement.mapped_tangent(chart.along_u),
                along_v: self.placement.mapped_tangent(chart.along_v),
                ..chart
            }
        } else {
            Chart::default()
        };
        SurfacePoint {
            position,
            place,
            normal: self.placement.mapped_normal(self.shape.normal(near, crossing.face)),
            chart,
            face: crossing.face,
            width: Real::from_bits((product(cone.to_bits(), crossing.t.to_bits()) >> 30) as i32),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::super::exact::words;
    use super::super::sphere::Sphere;
    use super::*;
    use crate::num::Angle;
    use std::vec::Vec;

    /// The linear part and the translation of a map, as numbers.
    struct Exact {
        inverse: [[f64; 3]; 3],
        centre: [f64; 3],
        /// The greatest factor by which the map makes longer, or a little more.
        size: f64,
    }

    impl Exact {
        fn of(map: &Affine3) -> Self {
            let (rows, t) = map.numbers();
            let minor = |i: usize, j: usize| {
                let (r, s, p, q) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
                rows[r][p] * rows[s][q] - rows[r][q] * rows[s][p]
            };
            let determinant: f64 = (0..3).map(|j| rows[0][j] * minor(0, j)).sum();
            let inverse = [0, 1, 2].map(|i| [0, 1, 2].map(|j| minor(j, i) / determinant));
            let size = rows.iter().flatten().map(|v| v * v).sum::<f64>().sqrt();
            Self { inverse, centre: t, size }
        }

        fn direction(&self, d: [f64; 3]) -> [f64; 3] {
            self.inverse.map(|row| (0..3).map(|k| row[k] * d[k]).sum())
        }

        fn place(&self, at: [f64; 3]) -> [f64; 3] {
            self.direction([0, 1, 2].map(|k| at[k] - self.centre[k]))
        }
    }

    fn numbers(ray: &Ray) -> ([f64; 3], [f64; 3]) {
        (
            ray.origin.map(|c| f64::from(c) / 2_f64.powi(24)),
            ray.direction.map(|c| f64::from(c) / 2_f64.powi(28)),
        )
    }

    fn crossings(surface: &impl Surface, ray: &Ray) -> Vec<Crossing> {
        let mut all = Vec::new();
        surface.cross(ray, Unit::DELTA, &mut |crossing| {
            all.push(crossing);
            ControlFlow::Continue(())
        });
        all
    }

    /// A number in ±1 with 24 fractional bits.
    fn real(word: &mut impl FnMut() -> u64) -> Real {
        Real::from_bits((word() >> 32) as i32 >> 7)
    }

    fn vector(word: &mut impl FnMut() -> u64) -> Vec3 {
        Vec3::new(real(word), real(word), real(word))
    }

    /// A turned thing, `size` large, up to 16 from the origin.
    fn map(size: Vec3, word: &mut impl FnMut() -> u64) -> Affine3 {
        let place = vector(word);
        let place = Vec3::new(place.x * 16, place.y * 16, place.z * 16);
        let turn = Affine3::rotate(vector(word), Angle::from_bits(word() as u32)).unwrap();
        Affine3::scale(size).then(&turn).then(&Affine3::translate(place))
    }

    /// A ray from up to 60 away towards a place `near` the map's origin in its own coordinates.
    fn ray(map: &Affine3, near: i32, word: &mut impl FnMut() -> u64) -> Ray {
        let target = vector(word);
        let target = map.at(Vec3::new(target.x * near, target.y * near, target.z * near));
        let origin = vector(word);
        let origin = match word() % 4 {
            0 => map.at(origin),
            _ => Vec3::new(origin.x * 60, origin.y * 60, origin.z * 60),
        };
        let Some(d) = origin.towards(target) else { return ray(map, near, word) };
        // about as long as a camera makes it
        let length = 3 + (word() % 6) as i32;
        let [x, y, z] = [d.x, d.y, d.z].map(|c| Real::from_bits((c.to_bits() >> 8) * length));
        Ray::new(origin, Vec3::new(x, y, z))
    }

    /// Spheres of every size and shape: how many crossings, and how far from the surface they are in units of
    /// the sphere's size or of 1, against double precision.
    fn spheres(count: u32, sizes: impl Fn(u64) -> Vec3) -> (u32, u32, f64) {
        let mut word = words(7);
        let (mut tried, mut met, mut worst): (u32, u32, f64) = (0, 0, 0.0);
        for _ in 0..count / 20 {
            let map = map(sizes(word()), &mut word);
            let (sphere, exact) = (Placed::new(Sphere, &map).unwrap(), Exact::of(&map));
            for _ in 0..20 {
                let ray = ray(&map, 2, &mut word);
                let (o, d) = numbers(&ray);
                let (p, e) = (exact.place(o), exact.direction(d));
                let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
                let cross = [0, 1, 2]
                    .map(|k: usize| p[(k + 1) % 3] * e[(k + 2) % 3] - p[(k + 2) % 3] * e[(k + 1) % 3]);
                let distance = (dot(cross, cross) / dot(e, e)).sqrt();
                let reach = (1.0 - distance * distance).max(0.0).sqrt() / dot(e, e).sqrt();
                let middle = -dot(p, e) / dot(e, e);
                let ends = [middle - reach, middle + reach];
                // near a tangent, or where one of them is where the ray begins or t ends
                let slack = 2_f64.powi(-21) * exact.size.max(1.0);
                if (distance - 1.0).abs() < 2_f64.powi(-20)
                    || ends.iter().any(|t| t.abs() < slack || (t - 128.0).abs() < slack)
                {
                    continue;
                }
                tried += 1;
                let want = if distance < 1.0 {
                    ends.iter().filter(|t| (0.0..128.0).contains(*t)).count()
                } else {
                    0
                };
                let got = crossings(&sphere, &ray);
                assert_eq!(got.len(), want, "{map:?} {ray:?} {distance} {ends:?} {got:?}");
                for crossing in got {
                    met += 1;
                    let t = crossing.t.to_num::<f64>();
                    let place = exact.place([0, 1, 2].map(|k| o[k] + t * d[k]));
                    worst =
                        worst.max((dot(place, place).sqrt() - 1.0).abs() * exact.size / exact.size.max(1.8));
                    assert_eq!(crossing.enters, (t - ends[0]).abs() < (t - ends[1]).abs(), "{ends:?} {t}");
                }
            }
        }
        (tried, met, worst)
    }

    #[test]
    fn a_crossing_lies_on_the_surface() {
        let (tried, met, worst) = spheres(20_000, |_| Vec3::lit("1", "1", "1"));
        assert!(tried > 19_000 && met > 8_000, "{tried} {met}");
        assert!(worst > 2_f64.powi(-25) && worst < 2_f64.powi(-22), "{worst:e}");
    }
}
