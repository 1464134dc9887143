//! Convex polyhedra as intersections of half-spaces: `F = max(n_k p - d_k)`.
//!
//! That there is something inside, and that it has an end on all sides, is found out from the corners:
//! wherever three planes meet, exactly, in whole numbers, the place is a corner if it is outside of none.
//! Planes at ±2 are among them; a polyhedron that has corners there reaches beyond.

use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::half_space::HalfSpace;
use super::shape::{NearCrossing, NearRay, Shape};
use super::slab::Part;
use crate::Error;
use crate::num::formats::Q28;
use crate::num::{Near, Real, Unit, Vec3, Wide, quotient};

/// The generic convex polyhedron: what is inside all of up to 32 half-spaces, within ±2. Faces are the
/// planes, in their order.
///
/// Texture coordinates of a face are distances in its plane: `u = P p`, `v = Q p` with `P` the horizontal
/// direction (`x` for a horizontal face) and `Q = n x P`.
#[derive(Debug, Clone, Copy)]
pub struct Polyhedron<'a> {
    planes: &'a [HalfSpace],
    bounds: [Vec3<Near>; 2],
}

/// Where the box ends: beyond ±2, so that what touches ±2 is still inside.
const LIMIT: Q28 = (2 << 28) + (1 << 8);

/// A plane by its place in the list: those of the box after the polyhedron's own.
fn plane(planes: &[HalfSpace], k: usize) -> HalfSpace {
    planes.get(k).copied().unwrap_or_else(|| {
        let side = k.saturating_sub(planes.len());
        let out = if side & 1 > 0 { 1 << 30 } else { -1 << 30 };
        let normal = [0, 1, 2].map(|axis| if side >> 1 == axis { out } else { 0 });
        HalfSpace { normal, distance: LIMIT }
    })
}

/// The place where three planes meet: numerators and the denominator, above 0.
fn meeting(planes: [HalfSpace; 3]) -> Option<([i128; 3], i128)> {
    let [a, b, c] = planes.map(|p| p.normal.map(i128::from));
    let [da, db, dc] = planes.map(|p| i128::from(p.distance));
    let cross = |u: [i128; 3], v: [i128; 3]| {
        [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    };
    let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
    let determinant = a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2];
    let place = [0, 1, 2].map(|k: usize| da * bc[k] + db * ca[k] + dc * ab[k]);
    match determinant {
        0 => None,
        d if d < 0 => Some((place.map(|c| -c), -d)),
        d => Some((place, d)),
    }
}

impl<'a> Polyhedron<'a> {
    /// The most planes.
    pub const PLANES: usize = 32;

    /// The intersection of half-spaces. Takes a time with the cube of their number: a look at each three.
    ///
    /// # Errors
    /// [`Error::TooFew`] below 4 planes, [`Error::Capacity`] above 32; [`Error::Degenerate`] where nothing is
    /// inside, or nothing thicker than `2^-20`; [`Error::OutOfRange`] for what reaches beyond ±2 or has no
    /// end.
    pub fn new(planes: &'a [HalfSpace]) -> Result<Self, Error> {
        let (given, count) = (planes.len(), planes.len() + 6);
        if given < 4 {
            return Err(Error::TooFew { what: "planes of a polyhedron", given, at_least: 4 });
        }
        if given > Self::PLANES {
            let (what, capacity) = ("planes of a polyhedron", Self::PLANES);
            return Err(Error::Capacity { what, needed: given, capacity });
        }
        let (mut low, mut high) = ([i32::MAX; 3], [i32::MIN; 3]);
        let (mut sum, mut corners) = ([0_i64; 3], 0_i64);
        for i in 0..count {
            for j in i + 1..count {
                for k in j + 1..count {
                    let three = [plane(planes, i), plane(planes, j), plane(planes, k)];
                    let Some((place, under)) = meeting(three) else { continue };
                    // its own three planes it is on
                    let is_outside = |q: usize| {
                        let HalfSpace { normal, distance } = plane(planes, q);
                        let along: i128 = (0..3).map(|k: usize| i128::from(normal[k]) * place[k]).sum();
                        ![i, j, k].contains(&q) && along > i128::from(distance) * under
                    };
                    if (0..count).any(is_outside) {
                        continue;
                    }
                    // inside the box both fit 64 bits when the denominator has 62; 88 fractional bits over 90
                    let places = 66_u32.saturating_sub(under.leading_zeros());
                    let place = place.map(|c| {
                        quotient((c >> places) as i64, 30, ((under >> places) as u64).max(1)) as i32
                    });
                    for axis in 0..3 {
                        low[axis] = low[axis].min(place[axis]);
                        high[axis] = high[axis].max(place[axis]);
                        sum[axis] += i64::from(place[axis]);
                    }
                    corners += 1;
                }
            }
        }
        let empty = Error::Degenerate { what: "inside of a polyhedron" };
        if corners == 0 {
            return Err(empty);
        }
        let most = low.iter().chain(&high).map(|c| c.unsigned_abs()).max().unwrap_or(0);
        if most > 2 << 28 {
            let (what, min, max) = ("corner of a polyhedron", Wide::from_num(-2), Wide::from_num(2));
            return Err(Error::OutOfRange { what, index: None, value: Wide::MAX, min, max });
        }
        let middle = sum.map(|c| c.checked_div(corners).unwrap_or(0) as i32);
        if planes.iter().any(|p| p.along(middle) > p.distance - (1 << 8)) {
            return Err(empty);
        }
        let corner = |v: [i32; 3], by: i32| {
            let [x, y, z] = v.map(|c| Near::from_bits((c + by).clamp(-2 << 28, 2 << 28)));
            Vec3::new(x, y, z)
        };
        Ok(Self { planes, bounds: [corner(low, -2), corner(high, 2)] })
    }

    fn face(&self, face: u8) -> HalfSpace {
        self.planes.get(usize::from(face)).copied().unwrap_or_default()
    }
}

impl Shape for Polyhedron<'_> {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        Some(self.bounds)
    }

    fn faces(&self) -> u8 {
        self.planes.len() as u8
    }

    fn error(&self) -> Near {
        Near::DELTA * 16
    }

    /// Error: on the surface within `2^-24` (`rays_meet_a_polyhedron_where_they_should`).
    #[inline]
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let o = [ray.origin.x, ray.origin.y, ray.origin.z].map(Near::to_bits);
        let d = [ray.direction.x, ray.direction.y, ray.direction.z].map(Near::to_bits);
        let mut part = Part::ALL;
        for (face, plane) in (0_u8..).zip(self.planes) {
            part.below(plane.along(o).saturating_sub(plane.distance), plane.along(d), face);
        }
        part.hand_over(from, found);
    }

    fn value(&self, place: Vec3) -> Wide {
        self.planes.iter().map(|plane| plane.above(place)).max().unwrap_or(Wide::MAX)
    }

    fn normal(&self, _: Vec3<Near>, face: u8) -> Vec3<Near> {
        self.face(face).outward()
    }

    fn chart(&self, place: Vec3<Real>, face: u8) -> Chart {
        let [p, q] = self.face(face).frame();
        charted(place, p, q)
    }
}

/// Distances along two directions.
pub(super) fn charted(place: Vec3, p: Vec3<Unit>, q: Vec3<Unit>) -> Chart {
    let along = |e: Vec3<Unit>| {
        let product = |a: Real, b: Unit| (i64::from(a.to_bits()) * i64::from(b.to_bits())) >> 2;
        let sum = product(place.x, e.x) + product(place.y, e.y) + product(place.z, e.z);
        Real::from_bits((sum >> 28).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
    };
    let real = |c: Unit| Real::from_bits(c.to_bits() >> 6);
    let vector = |e: Vec3<Unit>| Vec3::new(real(e.x), real(e.y), real(e.z));
    Chart { u: along(p), v: along(q), along_u: vector(p), along_v: vector(q) }
}

#[cfg(test)]
mod tests {
    use super::super::judge::{Seen, convex, inside};
    use super::*;
    use std::vec::Vec;

    fn half_spaces(planes: &[[f64; 4]]) -> Vec<HalfSpace> {
        let wide = |v: f64| Wide::from_num(v);
        let new = |p: &[f64; 4]| HalfSpace::new(Vec3::new(wide(p[0]), wide(p[1]), wide(p[2])), wide(p[3]));
        planes.iter().map(|p| new(p).unwrap()).collect()
    }

    const TETRAHEDRON: [[f64; 4]; 4] =
        [[1.0, 1.0, 1.0, 1.0], [1.0, -1.0, -1.0, 1.0], [-1.0, 1.0, -1.0, 1.0], [-1.0, -1.0, 1.0, 1.0]];
    const PYRAMID: [[f64; 4]; 5] = [
        [0.0, 0.0, -1.0, 0.0],
        [2.0, 0.0, 1.0, 1.0],
        [-2.0, 0.0, 1.0, 1.0],
        [0.0, 2.0, 1.0, 1.0],
        [0.0, -2.0, 1.0, 1.0],
    ];

    fn judged(planes: &[[f64; 4]], count: usize) -> Seen {
        let list = half_spaces(planes);
        // the planes as they are stored
        let stored: Vec<[f64; 4]> = list
            .iter()
            .map(|p| {
                let [x, y, z] = p.normal.map(|c| f64::from(c) / 2_f64.powi(30));
                [x, y, z, f64::from(p.distance) / 2_f64.powi(28)]
            })
            .collect();
        let shape = Polyhedron::new(&list).unwrap();
        convex(
            &shape,
            count,
            |o, d, offset| {
                inside(&stored.iter().map(|[x, y, z, w]| [*x, *y, *z, w + offset]).collect::<Vec<_>>(), o, d)
            },
            |p| {
                core::array::from_fn::<f64, 8, _>(|k| {
                    stored.get(k).map_or(-1.0, |[x, y, z, d]| x * p[0] + y * p[1] + z * p[2] - d)
                })
            },
        )
    }

    #[test]
    fn rays_meet_a_polyhedron_where_they_should() {
        // every crossing that `cross` hands over is judged
        for planes in [&TETRAHEDRON[..], &PYRAMID] {
            let seen = judged(planes, 15_000);
            assert!(seen.judged > 13_000 && seen.met > 4_000, "{seen:?}");
            assert!(seen.faces[..planes.len()].iter().all(|n| *n > 500), "{seen:?}");
            assert!(seen.off > 2_f64.powi(-28) && seen.off < 2_f64.powi(-24), "{seen:?}");
        }
    }

    /// `cargo test -p attractor --lib -- --ignored rays_meet_a_polyhedron`
    #[test]
    #[ignore = "a million rays"]
    fn a_million_rays_meet_a_polyhedron_where_they_should() {
        for planes in [&TETRAHEDRON[..], &PYRAMID] {
            let seen = judged(planes, 500_000);
            assert!(seen.judged > 440_000 && seen.off < 2_f64.powi(-24), "{seen:?}");
        }
    }

    #[test]
    fn a_polyhedron_has_an_inside_and_an_end() {
        let refused = |planes: &[[f64; 4]]| Polyhedron::new(&half_spaces(planes)).map(|p| p.bounds);
        let empty = Error::Degenerate { what: "inside of a polyhedron" };
        let cube = |x: f64, z: f64| {
            [
                [1.0, 0.0, 0.0, x],
                [-1.0, 0.0, 0.0, x],
                [0.0, 1.0, 0.0, 1.0],
                [0.0, -1.0, 0.0, 1.0],
                [0.0, 0.0, 1.0, z],
                [0.0, 0.0, -1.0, 1.0],
            ]
        };
        let [low, high] = refused(&cube(1.5, 0.5)).unwrap();
        for (got, want) in [(low.x, -1.5), (low.z, -1.0), (high.x, 1.5), (high.y, 1.0), (high.z, 0.5)] {
            assert!((got.to_num::<f64>() - want).abs() < 1e-7, "{low:?} {high:?}");
        }
        // as large as it may be, too large by little, and without an end on one side
        assert!(refused(&cube(2.0, 1.0)).is_ok());
        let far = |planes: &[[f64; 4]]| matches!(refused(planes), Err(Error::OutOfRange { .. }));
        assert!(far(&cube(2.001, 1.0)) && far(&cube(1.0, 1.0)[..5]) && far(&cube(1.0, 1.0)[1..]));
        // an edge without an end, at 45 degrees
        assert!(far(&[
            [1.0, 1.0, 0.0, 1.0],
            [1.0, -1.0, 0.0, 1.0],
            [0.0, 0.0, 1.0, 1.0],
            [0.0, 0.0, -1.0, 1.0]
        ]));
        // flat, and turned inside out
        assert_eq!([refused(&cube(1.0, -1.0)), refused(&cube(1.0, -1.5))], [Err(empty), Err(empty)]);
        assert_eq!(refused(&cube(1.0, -1.0 + 2_f64.powi(-21))), Err(empty));
        assert!(refused(&cube(1.0, -1.0 + 2_f64.powi(-17))).is_ok());
        // more planes than needed, one outside of all, and the same twice
        let mut many = cube(1.0, 1.0).to_vec();
        many.extend([[1.0, 1.0, 1.0, 2.5], [1.0, 0.0, 0.0, 1.0], [1.0, 1.0, 0.0, 3.0]]);
        assert_eq!(refused(&many), refused(&cube(1.0, 1.0)));
        let too_few = Error::TooFew { what: "planes of a polyhedron", given: 3, at_least: 4 };
        assert_eq!(refused(&many[..3]), Err(too_few));
        many.resize(32, [1.0, 1.0, 1.0, 2.0]);
        assert!(refused(&many).is_ok());
        many.push([1.0, 1.0, 1.0, 2.0]);
        let needed = Error::Capacity { what: "planes of a polyhedron", needed: 33, capacity: 32 };
        assert_eq!(refused(&many), Err(needed));
    }

    /// `P_u x P_v` is the normal, and the value is the distance from the nearest plane.
    #[test]
    fn a_face_has_the_distances_in_its_plane() {
        let list = half_spaces(&TETRAHEDRON);
        let shape = Polyhedron::new(&list).unwrap();
        assert_eq!(shape.faces(), 4);
        let whole = |n: i32| Real::from_num(n);
        for (face, p) in (0..4).zip(&list) {
            let place = Vec3::new(whole(1), whole(2), whole(-1));
            let chart = shape.chart(place, face);
            let (u, v) = (chart.along_u, chart.along_v);
            let normal = [
                u.y.to_num::<f64>() * v.z.to_num::<f64>() - u.z.to_num::<f64>() * v.y.to_num::<f64>(),
                u.z.to_num::<f64>() * v.x.to_num::<f64>() - u.x.to_num::<f64>() * v.z.to_num::<f64>(),
                u.x.to_num::<f64>() * v.y.to_num::<f64>() - u.y.to_num::<f64>() * v.x.to_num::<f64>(),
            ];
            for (a, b) in normal.into_iter().zip(p.normal) {
                assert!((a - f64::from(b) / 2_f64.powi(30)).abs() < 1e-6);
            }
            let exact = u.x.to_num::<f64>() + 2.0 * u.y.to_num::<f64>() - u.z.to_num::<f64>();
            assert!((chart.u.to_num::<f64>() - exact).abs() < 1e-6);
        }
        // the greatest of 0, 4, 2, -4 less 1, over the root of 3
        let value = shape.value(Vec3::new(whole(1), whole(-1), whole(-2))).to_num::<f64>();
        assert!((value - 3.0 / 3_f64.sqrt()).abs() < 1e-7, "{value}");
    }
}
