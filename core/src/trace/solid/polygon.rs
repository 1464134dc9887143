//! Convex polygons anywhere in space. Open: the upper side is that from which the corners go round
//! counter-clockwise.
//!
//! Texture coordinates are distances along the first edge and, in the plane, at right angles to it, from the
//! first corner: `u = P (p - p_0)`, `v = Q (p - p_0)`, `Q = n x P`.

use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::half_space::HalfSpace;
use super::polyhedron::charted;
use super::shape::{NearCrossing, NearRay, Shape};
use super::slab::{over, slowness};
use crate::Error;
use crate::num::{Near, Real, Unit, Vec3, Wide, product};

/// A convex polygon of up to `N` corners, within ±2.
#[derive(Debug, Clone, Copy)]
pub struct Polygon<const N: usize = 8> {
    plane: HalfSpace,
    /// Each edge's half-space, at right angles to the plane; inside of all of them is inside.
    edges: [HalfSpace; N],
    count: usize,
    first: Vec3,
    along: Vec3<Unit>,
    bounds: [Vec3<Near>; 2],
}

/// How far a corner may be from the plane, and how far in it has to be as seen from an edge: `2^-16`.
const FLAT: i32 = 1 << 12;

type Corner = [i64; 3];

/// Words of 24 fractional bits.
fn bits(v: Vec3) -> Corner {
    [v.x, v.y, v.z].map(|c| i64::from(c.to_bits()))
}

fn minus(a: Corner, b: Corner) -> Corner {
    [0, 1, 2].map(|k: usize| a[k] - b[k])
}

/// The vector product: 48 fractional bits.
fn cross(a: Corner, b: Corner) -> Corner {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The plane with this normal, of any length, through a corner.
fn plane(normal: Corner, corner: Vec3) -> Result<HalfSpace, Error> {
    let [x, y, z] = normal.map(Wide::from_bits);
    let through = HalfSpace::new(Vec3::new(x, y, z), Wide::ZERO)?;
    let near = [corner.x, corner.y, corner.z].map(|c| c.to_bits() << 4);
    Ok(HalfSpace { distance: through.along(near), ..through })
}

impl<const N: usize> Polygon<N> {
    /// The polygon with these corners.
    ///
    /// # Errors
    /// [`Error::TooFew`] below 3 corners, [`Error::Capacity`] above `N`; [`Error::OutOfRange`] for a corner
    /// outside ±2, or `2^-16` or more from the plane of the others; [`Error::Degenerate`] for two corners in
    /// one place, or all on a line; [`Error::Unsupported`] for corners that do not go round convexly and
    /// once.
    pub fn new(corners: &[Vec3]) -> Result<Self, Error> {
        let given = corners.len();
        let what = "corners of a polygon";
        if given > N {
            return Err(Error::Capacity { what, needed: given, capacity: N });
        }
        let (Some(first), true) = (corners.first().copied(), given >= 3) else {
            return Err(Error::TooFew { what, given, at_least: 3 });
        };
        let (mut low, mut high) = ([i64::MAX; 3], [i64::MIN; 3]);
        for (index, corner) in corners.iter().enumerate() {
            for (k, c) in bits(*corner).into_iter().enumerate() {
                if c.abs() > 2 << 24 {
                    let (min, max, value) = (Wide::from_num(-2), Wide::from_num(2), Wide::from_bits(c << 24));
                    return Err(Error::OutOfRange { what: "corner", index: Some(index), value, min, max });
                }
                if let (Some(low), Some(high)) = (low.get_mut(k), high.get_mut(k)) {
                    (*low, *high) = ((*low).min(c), (*high).max(c));
                }
            }
        }
        // Newell's: twice the area times the normal
        let start = bits(first);
        let normal = corners.windows(2).fold([0; 3], |sum: Corner, pair| {
            let [a, b] = pair else { return sum };
            let part = cross(minus(bits(*a), start), minus(bits(*b), start));
            [0, 1, 2].map(|k: usize| sum[k] + part[k] / 2)
        });
        let plane_of = plane(normal, first)?;
        let next = |k: usize| corners.get(if k + 1 < given { k + 1 } else { 0 }).copied().unwrap_or(first);
        let out = plane_of.normal.map(|c| i64::from(c) >> 6);
        let mut edges = [HalfSpace::default(); N];
        for (k, (edge, corner)) in edges.iter_mut().zip(corners).enumerate() {
            let near = [corner.x, corner.y, corner.z].map(|c| c.to_bits() << 4);
            let off = plane_of.along(near).saturating_sub(plane_of.distance);
            if off.abs() >= FLAT {
                let [max, value] = [FLAT, off].map(|v| Wide::from(Near::from_bits(v)));
                let what = "distance of a corner from the polygon's plane";
                return Err(Error::OutOfRange { what, index: Some(k), value, min: -max, max });
            }
            let along = minus(bits(next(k)), bits(*corner));
            if along.iter().all(|c| c.abs() < 1 << 8) {
                return Err(Error::Degenerate { what: "edge of a polygon" });
            }
            *edge = plane(cross(along, out), *corner)?;
        }
        // every corner is inside of every edge, and the corner after next strictly so
        let mut turns = 0_u32;
        for (k, edge) in edges.iter().take(given).enumerate() {
            for (j, corner) in corners.iter().enumerate() {
                let near = [corner.x, corner.y, corner.z].map(|c| c.to_bits() << 4);
                let own = j == k || j == (k + 1) % given.max(1);
                let above = edge.along(near).saturating_sub(edge.distance);
                if !own && above > -FLAT {
                    let allowed = "convex ones, their corners in order round them";
                    return Err(Error::Unsupported { what: "polygon", allowed });
                }
            }
            turns += 1;
        }
        let along = bits(next(0));
        let [x, y, z] = minus(along, start).map(|c| Real::from_bits(c as i32));
        let along = Vec3::new(x, y, z).normalised().ok_or(Error::Degenerate { what: "edge of a polygon" })?;
        let corner = |v: Corner, by: i64| {
            let [x, y, z] = v.map(|c| Near::from_bits((c * 16 + by).clamp(-2 << 28, 2 << 28) as i32));
            Vec3::new(x, y, z)
        };
        let bounds = [corner(low, -1 << 13), corner(high, 1 << 13)];
        Ok(Self { plane: plane_of, edges, count: turns as usize, first, along, bounds })
    }
}

impl<const N: usize> Shape for Polygon<N> {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        Some(self.bounds)
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn most_crossings(&self) -> u32 {
        1
    }

    fn error(&self) -> Near {
        Near::DELTA * 16
    }

    /// Error: on the plane within `2^-25` (`rays_meet_a_polygon_where_they_should`).
    #[inline]
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let o = [ray.origin.x, ray.origin.y, ray.origin.z].map(Near::to_bits);
        let d = [ray.direction.x, ray.direction.y, ray.direction.z].map(Near::to_bits);
        let up = self.plane.along(d);
        let above = self.plane.along(o).saturating_sub(self.plane.distance);
        if up == 0 {
            return;
        }
        let s = over(above, slowness(up));
        let s = if up < 0 { s } else { s.saturating_neg() };
        if s < from.to_bits() || s == i32::MAX || s == i32::MIN {
            return;
        }
        let place = [0, 1, 2].map(|k: usize| i64::from(o[k]) + (product(d[k], s) >> 28));
        if place.iter().any(|c| c.abs() > 4 << 28) {
            return;
        }
        let place = place.map(|c| c as i32);
        if self.edges.iter().take(self.count).all(|edge| edge.along(place) <= edge.distance) {
            let _ = found(NearCrossing { s: Near::from_bits(s), enters: up < 0, face: 0 });
        }
    }

    fn value(&self, place: Vec3) -> Wide {
        self.plane.above(place)
    }

    fn normal(&self, _: Vec3<Near>, _: u8) -> Vec3<Near> {
        self.plane.outward()
    }

    fn chart(&self, place: Vec3<Real>, _: u8) -> Chart {
        let [x, y, z] = self.plane.normal.map(Unit::from_bits);
        let across = Vec3::new(x, y, z).cross(self.along);
        charted(place.minus(self.first), self.along, across)
    }
}

#[cfg(test)]
mod tests {
    use super::super::judge::{crossings, dot, rays};
    use super::*;
    use std::vec::Vec;

    fn corners(list: &[[f64; 3]]) -> Vec<Vec3> {
        let real = |v: f64| Real::from_num(v);
        list.iter().map(|[x, y, z]| Vec3::new(real(*x), real(*y), real(*z))).collect()
    }

    /// A pentagon on the plane `z = x / 2 + y / 4`.
    fn pentagon() -> Vec<[f64; 3]> {
        [[1.0, 0.0], [0.5, 1.0], [-0.75, 0.75], [-1.0, -0.5], [0.25, -1.0]]
            .map(|[x, y]| [x, y, x / 2.0 + y / 4.0])
            .to_vec()
    }

    #[test]
    fn rays_meet_a_polygon_where_they_should() {
        // every crossing that `cross` hands over is judged
        let list = pentagon();
        let polygon = Polygon::<5>::new(&corners(&list)).unwrap();
        let (mut tried, mut met, mut worst) = (0, 0, 0.0_f64);
        let normal = [-0.5, -0.25, 1.0];
        for (k, ray) in rays(29).take(30_000).enumerate() {
            let [o, d] = [ray.origin, ray.direction].map(|v| [v.x, v.y, v.z].map(|c| c.to_num::<f64>()));
            let from = if k % 2 == 0 { Near::MIN } else { Near::ZERO };
            let (above, up) = (dot(normal, o), dot(normal, d));
            let s = -above / up;
            let place = [0, 1].map(|k: usize| o[k] + s * d[k]);
            // how far inside the edges seen from above
            let inside = (0..5).map(|k| {
                let ([ax, ay, _], [bx, by, _]) = (list[k], list[(k + 1) % 5]);
                let side = (bx - ax) * (place[1] - ay) - (by - ay) * (place[0] - ax);
                side / (bx - ax).hypot(by - ay)
            });
            let inside = inside.fold(f64::INFINITY, f64::min);
            let slack = 2_f64.powi(-19) * (1.0 + s.abs()) / up.abs().min(1.0);
            let got = crossings(&polygon, &ray, from);
            if up.abs() > 1e-9 && (inside.abs() < slack || s.abs() < slack || (s.abs() - 8.0).abs() < 1e-4) {
                continue;
            }
            tried += 1;
            let want = s.abs() < 8.0 && inside > 0.0 && s > from.to_num::<f64>();
            assert_eq!(got.len(), usize::from(want), "{ray:?}: {s} {inside}");
            for crossing in got {
                met += 1;
                let s = crossing.s.to_num::<f64>();
                worst = worst.max((above + s * up).abs() / dot(normal, normal).sqrt());
                assert_eq!(crossing.enters, up < 0.0);
            }
        }
        assert!(tried > 27_000 && met > 5_000, "{tried} {met}");
        assert!(worst > 2_f64.powi(-29) && worst < 2_f64.powi(-25), "{worst:e}");
    }

    #[test]
    fn a_polygon_is_planar_and_convex() {
        let refused = |list: &[[f64; 3]]| Polygon::<6>::new(&corners(list)).map(|p| p.bounds).err();
        let (what, degenerate) = ("corners of a polygon", |what| Some(Error::Degenerate { what }));
        let list = pentagon();
        assert_eq!(refused(&list), None);
        assert_eq!(refused(&list[..2]), Some(Error::TooFew { what, given: 2, at_least: 3 }));
        let seven = [&list[..], &list[..2]].concat();
        assert_eq!(refused(&seven), Some(Error::Capacity { what, needed: 7, capacity: 6 }));
        // turned round it has the other side up
        let mut other = list.clone();
        other.reverse();
        let normal = |list: &[[f64; 3]]| Polygon::<5>::new(&corners(list)).unwrap().plane.normal[2];
        assert!(normal(&list) > 0 && normal(&other) < 0);
        // a corner lifted, moved in, and one too far out
        let changed = |k: usize, to: [f64; 3]| {
            let mut list = list.clone();
            list[k] = to;
            refused(&list)
        };
        let [x, y, z] = list[2];
        assert!(matches!(changed(2, [x, y, z + 0.01]), Some(Error::OutOfRange { .. })));
        let flat = |x: f64, y: f64| [x, y, x / 2.0 + y / 4.0];
        let convex = Some(Error::Unsupported {
            what: "polygon",
            allowed: "convex ones, their corners in order round them",
        });
        assert_eq!(changed(2, flat(0.1, 0.1)), convex);
        assert_eq!(
            changed(1, flat(1.0, 2.001)),
            Some(Error::OutOfRange {
                what: "corner",
                index: Some(1),
                value: Real::from_num(2.001).into(),
                min: Wide::from_num(-2),
                max: Wide::from_num(2),
            })
        );
        // in the order of a star, twice round, a corner twice, all on a line
        let star = [0, 2, 4, 1, 3].map(|k| list[k]);
        assert_eq!(refused(&star), convex);
        let twice = [&list[..3], &list[..3]].concat();
        assert!(refused(&twice).is_some());
        assert_eq!(changed(1, list[0]), degenerate("edge of a polygon"));
        assert_eq!(refused(&[[0.0; 3], [1.0, 0.0, 0.0], [0.5, 0.0, 0.0]]), degenerate("normal of a plane"));
    }

    #[test]
    fn a_polygon_is_measured_from_its_first_corner_along_its_first_edge() {
        let list = [[1.0, 0.0, 0.5], [1.0, 1.0, 0.5], [0.0, 1.0, 0.5]];
        let polygon = Polygon::<3>::new(&corners(&list)).unwrap();
        let chart = polygon.chart(Vec3::lit("0.5", "0.75", "0.5"), 0);
        assert!(
            (chart.u.to_num::<f64>() - 0.75).abs() < 1e-6 && (chart.v.to_num::<f64>() - 0.5).abs() < 1e-6
        );
        assert!((polygon.value(Vec3::lit("3", "4", "2")).to_num::<f64>() - 1.5).abs() < 1e-7);
    }
}
