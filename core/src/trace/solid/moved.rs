//! Any surface under an affine map: a height field that stands upright, lies on its side, or is larger.
//!
//! As a shape does, a surface has a box of its own; in units in which that box is within ±2, rays go to it as
//! to a shape. They begin where they come into the box.

use core::ops::ControlFlow;

use super::super::ball::Ball;
use super::super::ray::Ray;
use super::super::surface::{Chart, Crossing, Extent, Surface, SurfacePoint};
use super::site::{Approach, Site, shifted};
use super::slab::{Part, over, slowness};
use crate::Error;
use crate::num::formats::{Q22, Q28};
use crate::num::{Affine3, Near, Real, Unit, Vec3, Wide, product, quotient, sqrt, square};

/// A surface under an affine map. Its box has to be within ±32.
///
/// The cone of a ray is as wide as in the world, in units of what the map makes of 1 along the surface's x
/// axis or along its y axis, whichever is longer.
#[derive(Debug, Clone, Copy)]
pub struct Moved<S> {
    surface: S,
    site: Site,
    bounds: [[Q28; 3]; 2],
    /// The unit of the site is `2^places` of the surface's.
    places: u32,
    /// What 1 of the world is along the surface's axes: a cone's width there.
    narrowing: Q22,
    error: Real,
}

/// The reciprocal of what a map makes of 1 along x or along y, whichever is longer.
fn narrowing(map: &Affine3) -> Q22 {
    let (rows, _) = map.parts();
    let [x, y] = [rows.map(|row| row.x), rows.map(|row| row.y)].map(|axis| square(axis.map(Real::to_bits)));
    // a scale is below 128, its square below 2^62
    quotient(1 << 22, 24, u64::from(sqrt(x.max(y))).max(1)).clamp(1, i64::from(i32::MAX)) as i32
}

impl<S: Surface> Moved<S> {
    /// The surface under a map.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a surface that reaches beyond ±32; otherwise as
    /// [`Placed::new`](super::Placed::new).
    pub fn new(surface: S, map: &Affine3) -> Result<Self, Error> {
        let Extent { low, high } = surface.extent();
        let corners = [low, high].map(|v| [v.x, v.y, v.z].map(Real::to_bits));
        let most = corners.iter().flatten().map(|c| c.unsigned_abs()).max().unwrap_or(0);
        if most > 32 << 24 {
            let (min, max) = (Wide::from_num(-32), Wide::from_num(32));
            let value = Real::from_bits(i32::try_from(most).unwrap_or(i32::MAX)).into();
            return Err(Error::OutOfRange { what: "extent of a surface", index: None, value, min, max });
        }
        // the least unit in which the box is within 2: 2^25
        let places = (32 - most.saturating_sub(1).leading_zeros()).clamp(25, 29) - 25;
        let bounds = corners.map(|corner| corner.map(|c| c << (4 - places)));
        let near =
            bounds.map(|[x, y, z]| Vec3::new(Near::from_bits(x), Near::from_bits(y), Near::from_bits(z)));
        let unit = Real::from_bits(1 << (24 + places));
        let site = Site::new(Some(near), None, &Affine3::scale(Vec3::new(unit, unit, unit)).then(map))?;
        let error = Near::from_bits(shifted(surface.error().to_bits().into(), 4 - places as i32));
        let error = site.error(error);
        Ok(Self { surface, site, bounds, places, narrowing: narrowing(map), error })
    }

    /// The ray in the surface's coordinates from where it comes into the box, with its width there, the `s`
    /// there, and how much its cone grows.
    fn inner(&self, ray: &Ray, approach: &Approach, cone: Unit) -> Option<(Ray, Near, Unit)> {
        let (o, d) = (approach.near.origin, approach.near.direction);
        let mut part = Part::ALL;
        let [lows, highs] = self.bounds;
        let axes = [(o.x, d.x), (o.y, d.y), (o.z, d.z)];
        for ((o, d), (low, high)) in axes.into_iter().zip(lows.into_iter().zip(highs)) {
            let (o, d) = (o.to_bits(), d.to_bits());
            let slowness = slowness(d);
            let (o, near, far) = if d < 0 { (-o, -high, -low) } else { (o, low, high) };
            // a box may be flat
            part.from(over(near.saturating_sub(o).saturating_sub(1 << 6), slowness), 0);
            part.until(over(far.saturating_sub(o).saturating_add(1 << 6), slowness), 0);
        }
        let start = Near::from_bits(part.begin.0).max(approach.from);
        if start.to_bits() > part.end.0 {
            return None;
        }
        let at = approach.at(start);
        let right = 4 - self.places;
        let origin = [at.x, at.y, at.z].map(|c| c.to_bits() >> right);
        let direction = [d.x, d.y, d.z].map(Near::to_bits);
        // where it comes in, the width is that of the world; 1 of its own parameter is 2^-(k + places) of t
        let begin = approach.parameter(start).unwrap_or(Real::MAX);
        let own =
            |width: i32, places: i32| shifted(product(width, self.narrowing), places.saturating_sub(22));
        let width = Real::from_bits(own(ray.width_at(begin, cone).to_bits(), 0));
        let cone = Unit::from_bits(own(cone.to_bits(), -(approach.places + self.places as i32)).max(1));
        Some((Ray::from_bits(origin, direction).with_width(width), start, cone))
    }
}

impl<S: Surface> Surface for Moved<S> {
    fn extent(&self) -> Extent {
        self.site.extent
    }

    fn ball(&self) -> Ball {
        self.site.ball
    }

    fn is_closed(&self) -> bool {
        self.surface.is_closed()
    }

    fn most_crossings(&self) -> u32 {
        self.surface.most_crossings()
    }

    fn faces(&self) -> u8 {
        self.surface.faces()
    }

    fn error(&self) -> Real {
        self.error
    }

    fn cross(&self, ray: &Ray, cone: Unit, found: &mut impl FnMut(Crossing) -> ControlFlow<()>) {
        let Some(approach) = self.site.approach(ray) else { return };
        let Some((inner, start, cone)) = self.inner(ray, &approach, cone) else { return };
        self.surface.cross(&inner, cone, &mut |crossing| {
            // the surface's t is 2^places s
            let s = i64::from(start.to_bits()) + (i64::from(crossing.t.to_bits()) << (4 - self.places));
            match i32::try_from(s).ok().and_then(|s| approach.parameter(Near::from_bits(s))) {
                Some(t) => found(Crossing { t, ..crossing }),
                None => ControlFlow::Break(()),
            }
        });
    }

    fn value(&self, place: Vec3) -> Wide {
        let place = self.site.place(place);
        let up = |c: Real| Real::from_bits(shifted(c.to_bits().into(), self.places as i32));
        self.surface.value(Vec3::new(up(place.x), up(place.y), up(place.z)))
    }

    fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint {
        let mut point = SurfacePoint {
            position: ray.at(crossing.t),
            place: Vec3::default(),
            normal: Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE),
            inward: false,
            chart: Chart::default(),
            face: crossing.face,
            width: ray.width_at(crossing.t, cone),
        };
        let Some(approach) = self.site.approach_met(ray) else { return point };
        let Some((inner, start, cone)) = self.inner(ray, &approach, cone) else { return point };
        // back from t to the surface's own: s = (t - start) 2^k
        let s = i64::from(crossing.t.to_bits()) - i64::from(approach.start);
        let s = i64::from(shifted(s, 4 + approach.places));
        let t = (s - i64::from(start.to_bits())) >> (4 - self.places);
        let own = Crossing { t: Real::from_bits(shifted(t.max(0), 0)), ..*crossing };
        let SurfacePoint { place, normal, chart, .. } = self.surface.point(&inner, cone, &own, charted);
        point.place = place;
        point.normal = self.site.normal([normal.x, normal.y, normal.z].map(Unit::to_bits));
        let tangent = |v: Vec3| {
            let v = self.site.tangent(v);
            Vec3::new(v.x >> self.places, v.y >> self.places, v.z >> self.places)
        };
        point.chart = Chart { along_u: tangent(chart.along_u), along_v: tangent(chart.along_v), ..chart };
        point
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::super::super::exact::{with_polygon, words};
    use super::super::super::height_field::field::HeightField;
    use super::*;
    use crate::num::Angle;
    use std::vec::Vec;

    fn crossings(surface: &impl Surface, ray: &Ray, cone: Unit) -> Vec<Crossing> {
        let mut all = Vec::new();
        surface.cross(ray, cone, &mut |crossing| {
            all.push(crossing);
            ControlFlow::Continue(())
        });
        all
    }

    /// Hands over a height field over `[0, 2]` squared with a ridge along each axis.
    fn with_field(work: impl FnOnce(&HeightField<'_>)) {
        let whole = |n: i32| Wide::from_num(n);
        let tent = [(whole(0), whole(0)), (whole(1), whole(1)), (whole(2), whole(0))];
        with_polygon(&tent, 6, |f| with_polygon(&tent, 6, |g| work(&HeightField::new(f, g).unwrap())));
    }

    /// The same rays against the field and, mapped, against the mapped field: `t` is the same, whatever the
    /// map, and so are the leaves, but for those at whose edge a ray passes.
    #[test]
    fn a_moved_surface_is_met_at_the_same_parameters() {
        let mut word = words(41);
        let mut number = |scale: i32| Real::from_bits((word() >> 32) as i32 >> 7) * scale;
        let quarter = |axis: Vec3| Affine3::rotate(axis, Angle::from_num(0.25)).unwrap();
        let maps = [
            Affine3::IDENTITY,
            quarter(Vec3::X).then(&Affine3::translate(Vec3::lit("3", "-2", "1"))),
            Affine3::scale(Vec3::lit("2", "0.5", "-3")).then(&quarter(Vec3::lit("1", "2", "3"))),
        ];
        with_field(|field| {
            for map in maps {
                let moved = Moved::new(*field, &map).unwrap();
                assert!(!moved.is_closed() && moved.most_crossings() == field.most_crossings());
                let (mut met, mut other, mut worst) = (0, 0, 0);
                for _ in 0..2_000 {
                    let (eye, to) = (
                        Vec3::new(number(6), number(6), number(6)),
                        Vec3::new(number(1) + Real::ONE, number(1) + Real::ONE, number(1) / 2),
                    );
                    let d = to.minus(eye);
                    let direction = Vec3::new(d.x / 8, d.y / 8, d.z / 8);
                    let (from, origin) = (map.at(eye), map.at(Vec3::default()));
                    let (ray, own) =
                        (Ray::new(from, map.at(direction).minus(origin)), Ray::new(eye, direction));
                    let cone = Unit::from_bits(1 << 16);
                    let (got, want) = (crossings(&moved, &ray, cone), crossings(field, &own, cone));
                    let (Some(got), Some(want)) = (got.first(), want.first()) else {
                        other += u32::from(got.len() != want.len());
                        continue;
                    };
                    if got.memo != want.memo {
                        other += 1;
                        continue;
                    }
                    met += 1;
                    worst = worst.max(got.t.abs_diff(want.t).to_bits());
                    assert_eq!(got.enters, want.enters);
                    let point = moved.point(&ray, cone, got, true);
                    let plain = field.point(&own, cone, want, true);
                    let near = |a: Real, b: Real| (a - b).abs() < Real::from_bits(1 << 10);
                    assert!(near(point.place.x, plain.place.x) && near(point.place.z, plain.place.z));
                    assert!(near(point.chart.u, plain.chart.u) && near(point.chart.v, plain.chart.v));
                    // tangents by the map, the normal at right angles to both
                    let along = map.at(plain.chart.along_u).minus(origin);
                    assert!(near(point.chart.along_u.x, along.x) && near(point.chart.along_u.y, along.y));
                    for tangent in [point.chart.along_u, point.chart.along_v] {
                        let product = |a: Real, b: Unit| a.to_num::<f64>() * b.to_num::<f64>();
                        let (t, n) = (tangent, point.normal);
                        let dot = product(t.x, n.x) + product(t.y, n.y) + product(t.z, n.z);
                        assert!(dot.abs() < 1e-5, "{dot}");
                    }
                }
                // a ray that grazes a leaf's box comes into it much later for a little difference in height
                assert!(met > 1_000 && other < 60 && worst < 1 << 12, "{map:?}: {met} {other} {worst}");
                let place = Vec3::lit("0.7", "1.2", "0.4");
                let [a, b] = [moved.value(map.at(place)), field.value(place)].map(|v| v.to_num::<f64>());
                assert!((a - b).abs() < 0.04, "{a} {b}");
                let (inner, extent) = (Surface::extent(field), moved.extent());
                for corner in [inner.low, inner.high].map(|c| map.at(c)) {
                    assert_eq!(extent.overlap(Extent { low: corner, high: corner }).low, corner);
                }
            }
            let far = Affine3::translate(Vec3::lit("70", "0", "0"));
            assert!(Moved::new(*field, &far).is_err() && moved_twice(field).is_ok());
        });
    }

    /// A cone is as wide as in the world: a node is a leaf where its side is that, whatever the map makes of
    /// it and wherever the ray comes into the box; how wide the ray is where it starts counts as well.
    #[test]
    fn a_cone_has_under_a_map_the_width_that_it_has_in_the_world() {
        let mut word = words(59);
        let mut number = |scale: i32| Real::from_bits((word() >> 32) as i32 >> 7) * scale;
        let turn = Affine3::rotate(Vec3::lit("1", "2", "3"), Angle::from_num(0.15)).unwrap();
        let scaled = |x: &str, y: &str, z: &str| {
            let [x, y, z] = [x, y, z].map(|c| Real::from_num(c.parse::<f64>().unwrap()));
            Affine3::scale(Vec3::new(x, y, z)).then(&turn)
        };
        // and what 1 along x or along y becomes at most
        let maps = [
            (turn.then(&Affine3::translate(Vec3::lit("3", "-2", "1"))), 1.0),
            (scaled("3", "3", "3"), 3.0),
            (scaled("0.25", "0.5", "1"), 0.5),
            (scaled("2", "0.5", "-3"), 2.0),
        ];
        with_field(|field| {
            for (map, longer) in maps {
                let moved = Moved::new(*field, &map).unwrap();
                let (mut same, mut other, mut levels) = (0, 0, [0; 7]);
                for k in 0..1_000 {
                    let (eye, to) = (
                        Vec3::new(number(6), number(6), number(6)),
                        Vec3::new(number(1) + Real::ONE, number(1) + Real::ONE, number(1) / 2),
                    );
                    let d = to.minus(eye);
                    let direction = Vec3::new(d.x / 8, d.y / 8, d.z / 8);
                    let (from, origin) = (map.at(eye), map.at(Vec3::default()));
                    let cone = Unit::from_bits(1 << (20 + k % 7));
                    let width = if k % 3 == 0 { Real::ONE / (1 << (k % 5)) } else { Real::ZERO };
                    let ray = Ray::new(from, map.at(direction).minus(origin)).with_width(width);
                    let narrowed = |c: f64| c / longer;
                    let own = Ray::new(eye, direction).with_width(Real::from_num(narrowed(width.to_num())));
                    let own_cone = Unit::from_num(narrowed(cone.to_num()));
                    let [got, want] = [crossings(&moved, &ray, cone), crossings(field, &own, own_cone)]
                        .map(|all| all.first().map(|crossing| crossing.memo));
                    let Some(leaf) = want else { continue };
                    if got == want {
                        same += 1
                    } else {
                        other += 1
                    }
                    levels[(leaf[0] + 1).ilog2() as usize] += 1;
                }
                assert!(same > 500 && other < same / 40, "{map:?}: {same} {other}");
                assert!(levels.iter().filter(|count| **count > 20).count() > 3, "{levels:?}");
            }
        });
    }

    fn moved_twice<'a>(field: &HeightField<'a>) -> Result<Moved<Moved<HeightField<'a>>>, Error> {
        Moved::new(Moved::new(*field, &Affine3::IDENTITY)?, &Affine3::IDENTITY)
    }

    #[test]
    fn a_surface_beyond_32_is_refused() {
        struct Wall(Real);
        impl Surface for Wall {
            fn extent(&self) -> Extent {
                Extent { low: Vec3::new(-self.0, -self.0, -self.0), high: Vec3::X }
            }
            fn is_closed(&self) -> bool {
                true
            }
            fn most_crossings(&self) -> u32 {
                2
            }
            fn error(&self) -> Real {
                Real::DELTA
            }
            fn cross(&self, _: &Ray, _: Unit, _: &mut impl FnMut(Crossing) -> ControlFlow<()>) {}
            fn value(&self, _: Vec3) -> Wide {
                Wide::ONE
            }
            fn point(&self, _: &Ray, _: Unit, _: &Crossing, _: bool) -> SurfacePoint {
                unreachable!("no crossings")
            }
        }
        let fits = |r: Real| Moved::new(Wall(r), &Affine3::IDENTITY).map(|moved| moved.places).ok();
        let two = Real::ONE * 2;
        let all = [two, two + Real::DELTA, two * 2, two * 16, two * 16 + Real::DELTA].map(fits);
        assert_eq!(all, [Some(0), Some(1), Some(1), Some(4), None]);
    }
}
