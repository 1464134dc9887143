//! A shape put into a world by an affine map: rays go to its coordinates, what they meet comes back.
//!
//! Source: the course unit V, section 5.7.

use core::ops::ControlFlow;

use super::super::ball::Ball;
use super::super::ray::Ray;
use super::super::surface::{Chart, Crossing, Extent, SAME, Surface, SurfacePoint};
use super::shape::{NearRay, Shape};
use super::site::{Site, shifted};
use crate::Error;
use crate::num::{Affine3, Near, Real, Unit, Vec3, Wide};

/// A shape at its place in a world.
///
/// The map may scale by 1/64 to 64, and by a different factor along each axis; it may shear and mirror. For a
/// scale of 1 a crossing lies on the surface within `2^-22` (`a_crossing_lies_on_the_surface`); of what is
/// 64 times as large within `2^-21`, of what is 64 times smaller within `2^-22`, as `t` is known to `2^-24`.
#[derive(Debug, Clone, Copy)]
pub struct Placed<S> {
    shape: S,
    site: Site,
    error: Real,
}

impl<S: Copy> Placed<S> {
    /// A shape of which all that it takes is known, at design time too.
    pub(super) const fn known(
        shape: S,
        bounds: Option<[Vec3<Near>; 2]>,
        radius: Option<Near>,
        error: Near,
        map: &Affine3,
    ) -> Result<Self, Error> {
        match Site::new(bounds, radius, map) {
            Ok(site) => Ok(Self { shape, error: site.error(error), site }),
            Err(error) => Err(error),
        }
    }
}

impl<S: Shape> Placed<S> {
    /// The shape under a map.
    ///
    /// # Errors
    /// [`Error::Degenerate`] for a map without an inverse; [`Error::OutOfRange`] for one that makes the shape
    /// 128 times as large or more, or as small as one 256th or less, or that puts its middle more than 64
    /// from the origin along an axis.
    pub fn new(shape: S, map: &Affine3) -> Result<Self, Error> {
        let site = Site::new(shape.bounds(), shape.radius(), map)?;
        let error = site.error(shape.error());
        Ok(Self { shape, site, error })
    }

    /// The shape.
    pub fn shape(&self) -> &S {
        &self.shape
    }

    /// A line through a place near the shape in the shape's coordinates, as every ray takes it that comes
    /// near.
    ///
    /// Domain: `way` leads from the place to the middle of the shape's box, in units of a power of two in
    /// which all of the shape is within 8 of it. Where a map scales so unevenly that the place is farther
    /// than 4 from the shape in its own coordinates, or a direction is a sixteenth there, the result wraps.
    ///
    /// Error: `2^-25` of the direction's length and of the place's
    /// (`a_line_is_mapped_to_within_two_to_the_minus_25`). Cost: kernel `affine map of a ray`.
    #[inline]
    pub fn line(&self, way: Vec3<Near>, direction: Vec3<Unit>) -> NearRay {
        let way = [way.x, way.y, way.z].map(Near::to_bits);
        self.site.line(way, [direction.x, direction.y, direction.z].map(Unit::to_bits)).0
    }
}

impl<S: Shape> Surface for Placed<S> {
    fn extent(&self) -> Extent {
        self.site.extent
    }

    fn ball(&self) -> Ball {
        self.site.ball
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
        if self.shape.is_round() && self.site.is_round() {
            if let Some(ends) = self.site.round_crossings(ray) {
                let Some([first, last]) = ends else { return };
                // what is a little behind the begin is at it, what is beyond the format's end is not
                let (mut t, mut enters) = if first >= -SAME { (first, true) } else { (last, false) };
                while (-SAME..i32::MAX).contains(&t) {
                    let crossing = Crossing { t: Real::from_bits(t.max(0)), enters, face: 0, memo: [0; 2] };
                    if found(crossing).is_break() || !enters {
                        return;
                    }
                    (t, enters) = (last, false);
                }
                return;
            }
        }
        let Some(approach) = self.site.approach(ray) else { return };
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
        self.shape.value(self.site.place(place))
    }

    #[inline(never)]
    fn is_clear_of(&self, place: Vec3) -> bool {
        self.site.limited && (!self.site.ball.has(place) || self.shape.is_clear_of(self.site.place(place)))
    }

    fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint {
        let position = ray.at(crossing.t);
        let is_round = self.shape.is_round() && self.site.is_round();
        let s = Near::from_bits(crossing.memo[0] as i32);
        let approach = if self.site.limited && !is_round { self.site.approach_met(ray) } else { None };
        let (near, place) = match approach {
            Some(approach) => {
                let near = approach.at(s);
                let real = |c: Near| Real::from_bits(((c.to_bits() >> 3) + 1) >> 1);
                (near, Vec3::new(real(near.x), real(near.y), real(near.z)))
            }
            // without limits, and where the ray was not brought near, only the place in the world tells
            None => {
                let place = self.site.place(position);
                let near = |c: Real| Near::from_bits(shifted(c.to_bits().into(), 4));
                (Vec3::new(near(place.x), near(place.y), near(place.z)), place)
            }
        };
        let chart = if charted {
            let chart = self.shape.chart(place, crossing.face);
            let (along_u, along_v) = (self.site.tangent(chart.along_u), self.site.tangent(chart.along_v));
            Chart { along_u, along_v, ..chart }
        } else {
            Chart::default()
        };
        let normal = if is_round {
            self.site.away(position)
        } else {
            let normal = self.shape.normal(near, crossing.face);
            self.site.normal([normal.x, normal.y, normal.z].map(Near::to_bits))
        };
        SurfacePoint {
            position,
            place,
            normal,
            inward: false,
            chart,
            face: crossing.face,
            width: ray.width_at(crossing.t, cone),
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::super::exact::words;
    use super::super::cube::Cube;
    use super::super::plane::Plane;
    use super::super::sphere::Sphere;
    use super::super::square::Square;
    use super::super::tapered_cylinder::TaperedCylinder;
    use super::*;
    use crate::num::Angle;
    use std::vec::Vec;

    /// The linear part and the translation of a map, as numbers.
    struct Exact {
        inverse: [[f64; 3]; 3],
        centre: [f64; 3],
        rows: [[f64; 3]; 3],
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
            Self { inverse, centre: t, rows }
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

    fn numbers_of(v: Vec3) -> [f64; 3] {
        [v.x, v.y, v.z].map(|c| c.to_num::<f64>())
    }

    fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
        (0..3).map(|k| a[k] * b[k]).sum()
    }

    /// How many of these crossings have to be handed over, and how many may be: those at `-2^-19` and later,
    /// give or take the surface's error.
    fn counted(ends: &[f64], surface: &impl Surface, d: [f64; 3]) -> [usize; 2] {
        let error = surface.error().to_num::<f64>() / dot(d, d).sqrt();
        [error, -error].map(|error| {
            let range = -2_f64.powi(-19) + error..128.0 - error;
            ends.iter().filter(|t| range.contains(*t)).count()
        })
    }

    /// Rays that begin within `2^-17` of a crossing, on either side of it: how many there were that must be
    /// handed over though they are behind, and how many are too far behind.
    fn begun<S: Shape + Copy>(shape: S, sizes: impl Fn(u64) -> Vec3, ends: Ends) -> [usize; 2] {
        let mut word = words(31);
        let mut seen = [0; 2];
        for _ in 0..1_000 {
            let map = map(sizes(word()), &mut word);
            let (placed, exact) = (Placed::new(shape, &map).unwrap(), Exact::of(&map));
            let far = ray(&map, 1, &mut word);
            let (o, d) = numbers(&far);
            for end in ends(exact.place(o), exact.direction(d)) {
                let t = end + (word() >> 40) as f64 * 2_f64.powi(-40) - 2_f64.powi(-17);
                let [x, y, z] = [0, 1, 2].map(|k| o[k] + t * d[k]);
                if [x, y, z].iter().any(|c| c.abs() > 60.0) {
                    continue;
                }
                let [x, y, z] = [x, y, z].map(Real::from_num);
                let near = Ray { origin: [x, y, z].map(Real::to_bits), ..far };
                let (o, d) = numbers(&near);
                let ends = ends(exact.place(o), exact.direction(d));
                let [least, most] = counted(&ends, &placed, d);
                let got = crossings(&placed, &near);
                assert!((least..=most).contains(&got.len()), "{map:?} {near:?} {ends:?} {got:?}");
                let ahead = ends.iter().filter(|t| **t >= 0.0).count();
                seen[0] += usize::from(least > ahead);
                seen[1] +=
                    ends.iter().filter(|t| (-2_f64.powi(-18)..0.0).contains(*t)).count() - (most - ahead);
                // what is behind is where the ray begins, and goes the same way
                if got.len() > ahead {
                    assert!(got[0].t <= placed.error(), "{ends:?} {got:?}");
                    assert!(ends.len() == 1 || got[0].enters == (ends.len() - ahead == 1), "{ends:?}");
                }
            }
        }
        seen
    }

    type Ends = fn([f64; 3], [f64; 3]) -> Vec<f64>;

    /// Where a line crosses the sphere, unless it nearly touches it.
    fn of_sphere(p: [f64; 3], e: [f64; 3]) -> Vec<f64> {
        let (a, b, c) = (dot(e, e), dot(p, e), dot(p, p) - 1.0);
        let root = b * b - a * c;
        if root < 0.04 * a {
            return Vec::new();
        }
        [-root.sqrt(), root.sqrt()].map(|root| (root - b) / a).to_vec()
    }

    /// Where one crosses the plane, unless it goes nearly along it.
    fn of_plane(p: [f64; 3], e: [f64; 3]) -> Vec<f64> {
        if e[2].abs() < 0.2 { Vec::new() } else { [-p[2] / e[2]].to_vec() }
    }

    /// Where a ray starts on one surface that touches another, rounding may put the other's crossing behind
    /// it: that counts up to `2^-19`, and no farther.
    #[test]
    fn a_crossing_a_little_behind_the_start_is_at_the_start() {
        let even = |size: i32| {
            move |_| {
                let size = Real::ONE * size / 4;
                Vec3::new(size, size, size)
            }
        };
        let uneven = |word: u64| {
            let size = |shift: u64| Real::from_bits(1 << (22 + (word >> shift) % 5));
            Vec3::new(size(0), size(8), size(16))
        };
        let all = [
            begun(Sphere, even(4), of_sphere),
            begun(Sphere, even(10), of_sphere),
            begun(Sphere, uneven, of_sphere),
            begun(Plane, even(4), of_plane),
        ];
        assert!(all.iter().all(|[behind, beyond]| *behind > 60 && *beyond > 60), "{all:?}");
    }

    /// Spheres of many sizes: how many rays were judged, how many crossings there were, and how far they are
    /// from the surface, in units of the sphere's greatest size or of 1, whichever is more.
    fn spheres(count: u32, sizes: impl Fn(u64) -> Vec3) -> (u32, u32, f64) {
        let mut word = words(7);
        let (mut tried, mut met, mut worst): (u32, u32, f64) = (0, 0, 0.0);
        for _ in 0..count / 20 {
            let factors = sizes(word());
            let size = numbers_of(factors).into_iter().fold(0.0, f64::max);
            let map = map(factors, &mut word);
            let (sphere, exact) = (Placed::new(Sphere, &map).unwrap(), Exact::of(&map));
            for _ in 0..20 {
                let ray = ray(&map, 2, &mut word);
                let (o, d) = numbers(&ray);
                let (p, e) = (exact.place(o), exact.direction(d));
                let cross = [0, 1, 2]
                    .map(|k: usize| p[(k + 1) % 3] * e[(k + 2) % 3] - p[(k + 2) % 3] * e[(k + 1) % 3]);
                let distance = (dot(cross, cross) / dot(e, e)).sqrt();
                let reach = (1.0 - distance * distance).max(0.0).sqrt() / dot(e, e).sqrt();
                let middle = -dot(p, e) / dot(e, e);
                let ends = [middle - reach, middle + reach];
                // near a tangent
                if (distance - 1.0).abs() < 2_f64.powi(-20) / size.min(1.0) {
                    continue;
                }
                tried += 1;
                let [least, most] = if distance < 1.0 { counted(&ends, &sphere, d) } else { [0; 2] };
                let got = crossings(&sphere, &ray);
                assert!((least..=most).contains(&got.len()), "{map:?} {ray:?} {distance} {ends:?} {got:?}");
                for crossing in got {
                    met += 1;
                    let t = crossing.t.to_num::<f64>();
                    // behind where the ray begins
                    if t == 0.0 {
                        continue;
                    }
                    let place = exact.place([0, 1, 2].map(|k| o[k] + t * d[k]));
                    worst = worst.max((dot(place, place).sqrt() - 1.0).abs() * size / size.max(1.0));
                    assert_eq!(crossing.enters, (t - ends[0]).abs() < (t - ends[1]).abs(), "{ends:?} {t}");
                    let (at, extent) = (ray.at(crossing.t), sphere.extent());
                    assert_eq!(extent.overlap(Extent { low: at, high: at }).low, at, "{extent:?} {at:?}");
                    assert!(sphere.ball().has(at) && !sphere.is_clear_of(at), "{:?} {at:?}", sphere.ball());
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

    /// From a 64th to 64, the same along all axes: the unit is the size, or 1 for what is smaller.
    #[test]
    fn a_crossing_lies_on_the_surface_at_every_scale() {
        for power in -6..=6_i32 {
            let size = Real::from_bits(1 << (24 + power).clamp(0, 30));
            let (tried, met, worst) = spheres(4_000, |_| Vec3::new(size, size, size));
            assert!(tried > 2_500 && met > 1_000, "{power}: {tried} {met}");
            assert!(worst > 2_f64.powi(-32) && worst < 2_f64.powi(-22), "{power}: {worst:e}");
        }
    }

    /// Each axis by another factor: what is small along one axis is known as well as what is large along
    /// another.
    #[test]
    fn a_crossing_lies_on_the_surface_of_an_ellipsoid() {
        let (tried, met, worst) = spheres(20_000, |word| {
            let size = |shift: u64| Real::from_bits(1 << (22 + (word >> shift) % 5));
            Vec3::new(size(0), size(8), size(16))
        });
        assert!(tried > 17_000 && met > 7_000, "{tried} {met}");
        assert!(worst > 2_f64.powi(-26) && worst < 2_f64.powi(-20), "{worst:e}");
    }

    /// `cargo test -p attractor --lib -- --ignored a_million_crossings`
    #[test]
    #[ignore = "a million rays"]
    fn a_million_crossings_lie_on_the_surface() {
        let (tried, _, worst) = spheres(1_000_000, |_| Vec3::lit("1", "1", "1"));
        assert!(tried > 950_000 && worst < 2_f64.powi(-22), "{tried} {worst:e}");
    }

    /// A plane has no end: it is met wherever it is, up to `t` = 128, and entered from above.
    #[test]
    fn a_ray_meets_a_plane_wherever_it_is() {
        let mut word = words(11);
        let (mut met, mut missed, mut worst): (u32, u32, f64) = (0, 0, 0.0);
        for _ in 0..10_000 {
            let map = map(Vec3::lit("1", "2", "0.5"), &mut word);
            let (plane, exact) = (Placed::new(Plane, &map).unwrap(), Exact::of(&map));
            let ray = ray(&map, 40, &mut word);
            let (o, d) = numbers(&ray);
            let ([.., height], [.., up]) = (exact.place(o), exact.direction(d));
            let t = -height / up;
            if t.abs() < 1e-5 || (t - 128.0).abs() < 1e-3 || up.abs() < 1e-6 {
                continue;
            }
            let got = crossings(&plane, &ray);
            assert_eq!(got.len(), usize::from((0.0..128.0).contains(&t)), "{map:?} {ray:?} {t} {got:?}");
            for crossing in &got {
                worst = worst.max((height + crossing.t.to_num::<f64>() * up).abs() / 2.0);
                assert_eq!(crossing.enters, up < 0.0);
                let point = plane.point(&ray, Unit::DELTA, crossing, true);
                let position = numbers_of(point.position);
                let at = exact.place(position);
                // what lies beyond the world is at its end
                if position.iter().chain(&at).any(|c| c.abs() > 64.0) {
                    continue;
                }
                for (got, want) in [(point.chart.u, at[0]), (point.chart.v, at[1]), (point.place.z, 0.0)] {
                    assert!(
                        want.abs() > 127.9 || (got.to_num::<f64>() - want).abs() < 1e-6,
                        "{point:?} {at:?}"
                    );
                }
            }
            met += got.len() as u32;
            missed += u32::from(got.is_empty());
        }
        assert!(met > 4_000 && missed > 1_000, "{met} {missed}");
        assert!(worst > 2_f64.powi(-26) && worst < 2_f64.powi(-22), "{worst:e}");
        assert_eq!(Placed::new(Plane, &Affine3::IDENTITY).unwrap().extent(), Extent::SPACE);
    }

    /// Under a different factor along each axis and a mirror image: the normal by the inverse transpose, the
    /// tangents by the map, at right angles to each other still; the place as exact as the shape's numbers.
    #[test]
    fn normals_and_tangents_come_back_from_the_shape() {
        let mut word = words(13);
        let (mut met, mut worst): (u32, [f64; 4]) = (0, [0.0; 4]);
        for k in 0..3_000 {
            let x = if k % 2 == 0 { "0.25" } else { "-0.25" };
            let map = map(
                Vec3::new(Real::from_num(x.parse::<f64>().unwrap()), Real::ONE * 3, Real::ONE),
                &mut word,
            );
            let exact = Exact::of(&map);
            let ray = ray(&map, 1, &mut word);
            let (sphere, cone) =
                (Placed::new(Sphere, &map).unwrap(), Placed::new(TaperedCylinder::CONE, &map).unwrap());
            for surface in [&sphere as &dyn Pointed, &cone] {
                let Some((crossing, point)) = surface.first(&ray) else { continue };
                met += 1;
                let (o, d) = numbers(&ray);
                let t = crossing.t.to_num::<f64>();
                let at = exact.place([0, 1, 2].map(|k| o[k] + t * d[k]));
                let place = numbers_of(point.place);
                worst[0] = (0..3).fold(worst[0], |most, k| most.max((place[k] - at[k]).abs()));
                let generic = surface.generic_normal(at, crossing.face);
                let want: [f64; 3] =
                    [0, 1, 2].map(|j| (0..3).map(|i| exact.inverse[i][j] * generic[i]).sum());
                let length = dot(want, want).sqrt();
                let normal = [point.normal.x, point.normal.y, point.normal.z].map(|c| c.to_num::<f64>());
                worst[1] = (0..3).fold(worst[1], |most, k| most.max((normal[k] - want[k] / length).abs()));
                let [u, v] = [point.chart.along_u, point.chart.along_v].map(numbers_of);
                for tangent in [u, v] {
                    let length = dot(tangent, tangent).sqrt();
                    if length > 0.1 {
                        worst[2] = worst[2].max((dot(tangent, normal) / length).abs());
                    }
                }
                // P_u is the map's image of the generic tangent
                let generic = [-place[1], place[0], 0.0].map(|c| c * core::f64::consts::TAU);
                if crossing.face == 0 {
                    for (k, row) in exact.rows.iter().enumerate() {
                        worst[3] = worst[3].max((dot(*row, generic) - u[k]).abs());
                    }
                }
                assert_eq!(point.width, Real::from_bits(crossing.t.to_bits() >> 1));
            }
        }
        assert!(met > 1_500, "{met}");
        // the cone's tip is met by few rays, and its normals turn there
        assert!(
            worst[0] < 2_f64.powi(-20) && worst[1] < 2e-4 && worst[2] < 2e-4 && worst[3] < 1e-5,
            "{worst:?}"
        );
        assert!(worst.iter().all(|w| *w > 1e-9), "{worst:?}");
    }

    trait Pointed {
        fn first(&self, ray: &Ray) -> Option<(Crossing, SurfacePoint)>;
        fn generic_normal(&self, at: [f64; 3], face: u8) -> [f64; 3];
    }

    impl<S: Shape + Faced> Pointed for Placed<S> {
        fn first(&self, ray: &Ray) -> Option<(Crossing, SurfacePoint)> {
            let crossing = *crossings(self, ray).first()?;
            Some((crossing, self.point(ray, Unit::ONE / 2, &crossing, true)))
        }
        fn generic_normal(&self, at: [f64; 3], face: u8) -> [f64; 3] {
            S::normal_at(at, face)
        }
    }

    trait Faced {
        fn normal_at(at: [f64; 3], face: u8) -> [f64; 3];
    }

    impl Faced for Sphere {
        fn normal_at(at: [f64; 3], _: u8) -> [f64; 3] {
            at
        }
    }

    impl Faced for TaperedCylinder {
        fn normal_at([x, y, _]: [f64; 3], face: u8) -> [f64; 3] {
            let radius = x.hypot(y);
            if face == 0 { [x / radius, y / radius, 1.0] } else { [0.0, 0.0, -1.0] }
        }
    }

    /// Against the exact inverse: the place, and the direction but for a power of two.
    #[test]
    fn a_line_is_mapped_to_within_two_to_the_minus_25() {
        let mut word = words(37);
        let (mut worst, mut least) = ([0.0_f64; 2], 2.0_f64);
        for k in 0..4_000 {
            let size = |shift: u32| Real::from_bits(1 << (20 + (k >> shift) % 8)).min(Real::ONE * 2);
            let size = Vec3::new(size(0), size(0), size(0));
            let size = if k % 5 == 0 { Vec3::new(size.x * 2, size.y, -size.z) } else { size };
            let map = map(size, &mut word);
            let (cone, exact) = (Placed::new(TaperedCylinder::CONE, &map).unwrap(), Exact::of(&map));
            let mut near = || Near::from_bits((word() >> 34) as i32 - (1 << 29));
            let way = Vec3::new(near(), near(), near());
            let Some(d) = vector(&mut word).normalised() else { continue };
            let numbers = |v: Vec3<Near>| [v.x, v.y, v.z].map(|c| c.to_num::<f64>());
            let got = cone.line(way, d);
            let unit = 2_f64.powi(14 - cone.site.up as i32);
            let back = exact.direction(numbers(way).map(|c| c * unit));
            let place = numbers(got.origin);
            let centre = [0.0, 0.0, 0.5];
            for k in 0..3 {
                worst[0] = worst[0].max((place[k] - (centre[k] - back[k])).abs());
            }
            let along = exact.direction([d.x, d.y, d.z].map(|c| c.to_num::<f64>()));
            let got = numbers(got.direction);
            let greatest = got.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
            least = least.min(greatest);
            let scale = (dot(got, got) / dot(along, along)).sqrt().log2().round().exp2();
            for k in 0..3 {
                worst[1] = worst[1].max((got[k] - along[k] * scale).abs());
            }
        }
        assert!(worst.iter().all(|w| *w < 2_f64.powi(-25) && *w > 2_f64.powi(-28)), "{worst:?}");
        assert!(least >= 1.0, "{least}");
    }

    /// A place is clear of a cone only where the cone's function in double precision is above 0, and of most
    /// places that are well outside it is said; what is met is in the ball.
    #[test]
    fn what_is_clear_of_a_shape_is_outside() {
        let mut word = words(29);
        let (mut clear, mut outside): (u32, u32) = (0, 0);
        for _ in 0..400 {
            let size = Vec3::new(Real::ONE + real(&mut word) / 2, Real::ONE, Real::ONE - real(&mut word) / 2);
            let map = map(size, &mut word);
            let (cone, exact) = (Placed::new(TaperedCylinder::CONE, &map).unwrap(), Exact::of(&map));
            for _ in 0..20 {
                let place = vector(&mut word);
                let place = map.at(Vec3::new(place.x * 2, place.y * 2, place.z * 2));
                let [x, y, z] = exact.place(numbers_of(place));
                let height = (x.hypot(y) - (1.0 - z)).max(-z).max(z - 1.0);
                clear += u32::from(cone.is_clear_of(place));
                outside += u32::from(height > 0.01);
                assert!(!cone.is_clear_of(place) || height > 2_f64.powi(-12), "{map:?} {place:?} {height}");
            }
            let ray = ray(&map, 1, &mut word);
            for crossing in crossings(&cone, &ray) {
                assert!(cone.ball().has(ray.at(crossing.t)), "{map:?} {ray:?}");
            }
        }
        assert!(clear > 4_000 && clear > outside * 9 / 10 && clear < 7_900, "{clear} {outside}");
    }

    /// The corners of the box are corners of the mapped box, a few units out.
    #[test]
    fn an_extent_is_the_box_of_the_mapped_bounds() {
        let mut word = words(17);
        for _ in 0..500 {
            let map = map(Vec3::lit("0.25", "3", "1"), &mut word);
            let (exact, extent) = (Exact::of(&map), Placed::new(Sphere, &map).unwrap().extent());
            let (low, high) = (numbers_of(extent.low), numbers_of(extent.high));
            for k in 0..3 {
                let reach: f64 = exact.rows[k].iter().map(|c| c.abs()).sum();
                for (out, end) in [(exact.centre[k] - low[k], reach), (high[k] - exact.centre[k], reach)] {
                    assert!(out >= end && out - end < 2e-6, "{k}: {out} {end}");
                }
            }
        }
    }

    #[test]
    fn a_map_is_refused_that_makes_a_shape_too_large_or_too_small() {
        let scale = |x: Real, y: Real| Affine3::scale(Vec3::new(x, y, x));
        let (one, least) = (Real::ONE, Real::ONE / 64);
        let placed = |map: Affine3| Placed::new(Sphere, &map).map(|_| ());
        assert_eq!(
            placed(scale(one, Real::ZERO)),
            Err(Error::Degenerate { what: "determinant of an affine map" })
        );
        let what = "scale of a shape";
        let refused = |map| matches!(placed(map), Err(Error::OutOfRange { what: w, .. }) if w == what);
        assert_eq!([placed(scale(least, one * 64)), placed(scale(one * 127, -one * 64))], [Ok(()); 2]);
        assert!(refused(scale(one, least / 8)) && refused(scale(one, Real::from_bits(1))));
        let hundred = Affine3::scale(Vec3::new(one * 100, one, one));
        assert!(refused(hundred.then(&hundred)));
        let at = |c: &str| {
            let c = Real::from_num(c.parse::<f64>().unwrap());
            Affine3::translate(Vec3::new(Real::ZERO, c, Real::ZERO))
        };
        let far = |map| matches!(placed(map), Err(Error::OutOfRange { index: Some(1), .. }));
        assert!(far(at("64.1")) && far(at("-64")) && !far(at("64")) && !far(at("-63.9")));
        let (square, map) = (Square, at("1"));
        let placed = Placed::new(square, &map).unwrap();
        assert_eq!((placed.shape(), placed.is_closed(), placed.most_crossings()), (&square, false, 1));
        // 1 above the upper side of the square, which is where its middle is
        assert_eq!(placed.value(Vec3::lit("0.5", "1", "1")), Wide::ONE);
    }

    /// The stated error: t against the exact parameter, for directions of length 1 that are no tangents.
    #[test]
    fn a_parameter_is_as_wrong_as_is_stated_at_most() {
        let mut word = words(19);
        let (mut met, mut worst) = (0, 0.0_f64);
        for _ in 0..4_000 {
            let map = map(Vec3::lit("2", "2", "2"), &mut word);
            let (sphere, exact) = (Placed::new(Sphere, &map).unwrap(), Exact::of(&map));
            let ray = ray(&map, 1, &mut word);
            let (o, d) = numbers(&ray);
            let (p, e) = (exact.place(o), exact.direction(d));
            let (a, b, c) = (dot(e, e), dot(p, e), dot(p, p) - 1.0);
            let root = (b * b - a * c).max(0.0).sqrt();
            // at 1/4 or more from a tangent's angle
            if root / a.sqrt() < 0.25 {
                continue;
            }
            for crossing in crossings(&sphere, &ray) {
                let t = if crossing.enters { (-b - root) / a } else { (-b + root) / a };
                met += 1;
                let off = (crossing.t.to_num::<f64>() - t).abs() * dot(d, d).sqrt();
                worst = worst.max(off / sphere.error().to_num::<f64>());
            }
        }
        assert!(met > 3_000 && worst < 1.0 && worst > 0.02, "{met} {worst}");
    }

    /// A map may make a direction longer than the world's: a ray of any length up to the longest meets a
    /// shape where one of length 1 does.
    #[test]
    fn a_ray_meets_a_shape_in_one_place_however_long_its_direction_is() {
        let mut word = words(23);
        let (mut met, mut steep) = (0, 0);
        for k in 0..300 {
            // once as it was found
            let (map, from, along) = if k == 0 {
                let turn = Affine3::rotate(Vec3::Z, Angle::from_num(0.125)).unwrap();
                let map = Affine3::scale(Vec3::lit("1.45", "1.45", "3")).then(&turn);
                (map, Vec3::lit("-3", "-3", "0.5"), [0.7, 0.7, 0.0])
            } else {
                let size = Real::from_num(1.0 + f64::from(k % 25) / 25.0);
                let turn = Affine3::rotate(vector(&mut word), Angle::from_bits(word() as u32)).unwrap();
                let [from, to] = [vector(&mut word), vector(&mut word)];
                let from = Vec3::new(from.x * 4, from.y * 4, from.z * 4);
                let d = numbers_of(to.minus(from));
                let length = dot(d, d).sqrt();
                (Affine3::scale(Vec3::new(size, size, size)).then(&turn), from, d.map(|c| c / length))
            };
            let at = |length: f64| {
                let [x, y, z] = along.map(|c| Real::from_num(c * length));
                let ray = Ray::new(from, Vec3::new(x, y, z));
                let cube = crossings(&Placed::new(Cube, &map).unwrap(), &ray);
                let cylinder = crossings(&Placed::new(TaperedCylinder::CYLINDER, &map).unwrap(), &ray);
                [cube, cylinder].map(|all| {
                    let tell = |c: &Crossing| (c.t.to_num::<f64>() * length, c.enters);
                    all.iter().map(tell).collect::<Vec<_>>()
                })
            };
            let expected = at(1.0);
            for step in 1..20 {
                let length = 1.0 + f64::from(step) * 0.15;
                for (got, want) in at(length).iter().zip(&expected) {
                    // a corner may be met by one and missed by the other
                    let is_thin = |all: &[(f64, bool)]| all.len() == 2 && all[1].0 - all[0].0 < 1e-4;
                    if is_thin(got) || is_thin(want) {
                        continue;
                    }
                    let same = got.iter().zip(want).all(|(a, b)| (a.0 - b.0).abs() < 1e-5 && a.1 == b.1);
                    assert!(same && got.len() == want.len(), "{k}: {length} times: {got:?}, once: {want:?}");
                    met += got.len();
                    steep += usize::from(length > 1.41 && length < 2.0);
                }
            }
        }
        assert!(met > 3_000 && steep > 1_000, "{met} {steep}");
    }
}
