//! A shape put into a world by an affine map: rays go to its coordinates, what they meet comes back.
//!
//! `t` is the same on both sides: the direction is not normalised. A ray that comes near is moved along
//! itself to where it is closest to the shape, `t = t_0 + s 2^-k`; `t_0` has so few bits that the place there,
//! `M^-1 (o + t_0 d - c)`, is exact to `2^-29` at any distance. Normals come back by the inverse transpose,
//! tangents by the map itself.
//!
//! Source: the course unit V, section 5.7; Glassner (ed.), "An Introduction to Ray Tracing", 1989, section 2.7.

use core::num::NonZeroU32;
use core::ops::ControlFlow;

use super::super::ray::Ray;
use super::super::surface::{Chart, Crossing, Extent, Surface, SurfacePoint};
use super::shape::{NearRay, Shape};
use crate::Error;
use crate::num::formats::{Q24, Q28, Q29, Q30, Q54, Q58, UQ16};
use crate::num::{
    Affine3, Near, Real, Unit, Vec3, Wide, product, product_u, reciprocal_of, sqrt, square, unit,
};

/// A shape at its place in a world.
///
/// The map may scale by 1/64 to 64, and by a different factor along each axis; it may shear and mirror. For a
/// scale of 1 a crossing lies on the surface within `2^-22` (`a_crossing_lies_on_the_surface`); what is
/// 64 times larger or smaller, within `2^-22` of its size or of 1, whichever is more.
#[derive(Debug, Clone, Copy)]
pub struct Placed<S> {
    shape: S,
    /// `M^-1 = inverse 2^exponent`, its greatest entry in `[1/2, 1]`.
    inverse: [[Q30; 3]; 3],
    /// -8 to 8.
    exponent: i32,
    /// Where the middle of the shape's box is in the world.
    centre: [Q24; 3],
    /// That middle, in generic coordinates.
    middle: [Q29; 3],
    /// The square of the radius of a ball round the centre that holds the shape, 16 fractional bits, rounded
    /// up.
    ball: UQ16,
    limited: bool,
    linear: [Vec3; 3],
    extent: Extent,
    error: Real,
}

/// A ray near the shape: `t = start + s 2^-k`.
struct Approach {
    near: NearRay,
    /// 24 fractional bits.
    start: i64,
    /// `k`.
    places: i32,
    /// The `s` at `t` = 0.
    from: Near,
}

/// The scalar product of words, which the caller knows to fit.
#[inline(always)]
fn dot(a: [i32; 3], b: [i32; 3]) -> i64 {
    product(a[0], b[0]).wrapping_add(product(a[1], b[1])).wrapping_add(product(a[2], b[2]))
}

/// `v 2^places`, saturated to a word; places below 32, shifts to the right round down.
#[inline(always)]
fn shifted(v: i64, places: i32) -> i32 {
    let v = if places >= 0 { v.saturating_mul(1 << (places & 63)) } else { v >> (-places).min(63) };
    v.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

impl<S: Shape> Placed<S> {
    /// The shape under a map.
    ///
    /// # Errors
    /// [`Error::Degenerate`] for a map without an inverse; [`Error::OutOfRange`] for one that makes the shape
    /// 128 times as large or more, or as small as one 256th or less, or that puts its middle more than 64 from
    /// the origin along an axis.
    pub fn new(shape: S, map: &Affine3) -> Result<Self, Error> {
        let inverse = map.inverse()?;
        let (min, max) = (Wide::ONE / 256, Wide::from_num(128));
        let scale =
            |value: Wide| Error::OutOfRange { what: "scale of a shape", index: None, value, min, max };
        if map.greatest() >= max {
            return Err(scale(map.greatest()));
        }
        // entries below 128 have an inverse whose greatest is above 2^-9
        if !(-8..=8).contains(&inverse.exponent) {
            return Err(scale(Wide::ONE >> inverse.exponent.clamp(0, 47) as u32));
        }
        let (linear, _) = map.parts();
        let bounds = shape.bounds();
        let corner = |v: Vec3<Near>| [v.x, v.y, v.z].map(Near::to_bits);
        let [low, high] = bounds.map_or([[0; 3]; 2], |[low, high]| [corner(low), corner(high)]);
        // bounds are within 2: no sum leaves a word
        let middle = [0, 1, 2].map(|k: usize| low[k].saturating_add(high[k]));
        let half = [0, 1, 2].map(|k: usize| i64::from(high[k].saturating_sub(low[k]) >> 1) + 1);
        let [x, y, z] = middle.map(|c| Real::from_bits(c >> 5));
        let centre = map.at(Vec3::new(x, y, z));
        for (index, c) in [centre.x, centre.y, centre.z].into_iter().enumerate() {
            if c > 64 || c <= -64 {
                let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
                let what = "place of a shape";
                return Err(Error::OutOfRange { what, index: Some(index), value: c.into(), min, max });
            }
        }
        let centre = [centre.x, centre.y, centre.z].map(Real::to_bits);
        let rows = linear.map(|row| [row.x, row.y, row.z].map(|c| i64::from(c.to_bits())));
        let size = |row: [i64; 3]| (0..3).map(|k: usize| (row[k].abs() * half[k]) >> 28).sum::<i64>();
        // what rounding the inverse makes of a place as far away as the box's corner, and a few units
        let greatest = rows.iter().flatten().map(|c| c.abs()).max().unwrap_or(0);
        let largest = rows.iter().map(|row| size(*row)).max().unwrap_or(0);
        let slack = 16 + (((greatest >> 12) * (largest >> 12) * 9) >> (31 - inverse.exponent));
        let reach = rows.map(|row| size(row) + slack);
        // four corners of the box, the others are opposite; 16 fractional bits
        let corners = [(1, 1), (1, -1), (-1, 1), (-1, -1)].map(|(a, b)| {
            let v = rows.map(|row| (row[0] * half[0] + row[1] * half[1] * a + row[2] * half[2] * b) >> 28);
            v.iter().map(|c| ((c.abs() + slack) >> 8) + 1).map(|c| c * c).sum::<i64>() >> 16
        });
        let ball = u32::try_from(corners.into_iter().fold(0, i64::max) + 1).unwrap_or(u32::MAX);
        let end = |c: Q24, r: i64| Real::from_bits(shifted(i64::from(c) + r, 0));
        let [x, y, z] = [0, 1, 2].map(|k: usize| (end(centre[k], -reach[k]), end(centre[k], reach[k])));
        let extent = Extent { low: Vec3::new(x.0, y.0, z.0), high: Vec3::new(x.1, y.1, z.1) };
        // s is worth at most 2 sqrt(3) of t times the map's norm: 16 fractional bits
        let norm = sqrt(rows.iter().flatten().map(|c| ((c >> 8) * (c >> 8)) as u64).sum());
        let near = i64::from(shape.error().to_bits()) + 8;
        let error = shifted(((near * i64::from(norm) * 111) >> 25) + 2, 0);
        Ok(Self {
            limited: bounds.is_some(),
            shape,
            inverse: inverse.rows,
            exponent: inverse.exponent,
            centre,
            middle,
            ball,
            linear,
            extent: if bounds.is_some() { extent } else { Extent::SPACE },
            error: Real::from_bits(error),
        })
    }

    /// The shape.
    pub fn shape(&self) -> &S {
        &self.shape
    }

    /// Whether the ray passes the ball round the shape by, or leaves it behind. `w` is the way from the
    /// centre to the ray's origin.
    #[inline(always)]
    fn is_far(&self, w: [Q24; 3], d: [Q28; 3]) -> bool {
        // the distance of the line is |w x d| / |d|; words of 20 fractional bits, never too large
        let across = |a: usize, b: usize| {
            let v = product(w[a], d[b]).wrapping_sub(product(w[b], d[a]));
            let high = (v >> 32) as i32;
            high ^ (high >> 31)
        };
        let distance = square([across(1, 2), across(2, 0), across(0, 1)]);
        let length = (square(d) >> 32) as u32 + 1;
        if distance > product_u(length, self.ball) {
            return true;
        }
        dot(w, d) > 0 && (square(w) >> 32) as u32 > self.ball
    }

    /// The ray in the shape's coordinates, moved to where it is closest; none if it comes nowhere near.
    #[inline(always)]
    fn approach(&self, ray: &Ray) -> Option<Approach> {
        let d = ray.direction;
        let w = [0, 1, 2].map(|k: usize| ray.origin[k].wrapping_sub(self.centre[k]));
        if self.limited && self.is_far(w, d) {
            return None;
        }
        self.mapped(w, d)
    }

    /// The same without a look at the ball.
    #[inline(always)]
    fn mapped(&self, w: [Q24; 3], d: [Q28; 3]) -> Option<Approach> {
        // both without the inverse's power of two; a row's sum of magnitudes is at most 3
        let origin: [Q54; 3] = self.inverse.map(|row| dot(row, w));
        let along: [Q58; 3] = self.inverse.map(|row| dot(row, d));
        // a sign takes no bit of the magnitude: or is as good as the greatest
        let magnitude = along.iter().fold(0_u64, |all, c| all | (c ^ (c >> 63)) as u64);
        // the direction's greatest component gets 29 bits
        let shift = 35 - magnitude.leading_zeros() as i32;
        if shift < 0 {
            return None;
        }
        let direction: [Q28; 3] = along.map(|c| (c >> shift) as i32);
        // n steps of 2^-(3 + exponent) each: 0 to 128
        let most = 1 << 18 >> (8 - self.exponent);
        let (towards, over) = if self.limited {
            let o = origin.map(|c| (c >> 32) as i32);
            (-dot(o, direction), ((square(direction)) >> 28) as u32)
        } else {
            let down = direction[2];
            let high = (origin[2] >> 32) as i32;
            (if down < 0 { product(high, 1 << 28) } else { product(-high, 1 << 28) }, down.unsigned_abs())
        };
        let n = if towards <= 0 { 0 } else { steps(towards, over, shift, self.exponent, most) };
        // 29 fractional bits: 54 + exponent - 25 of the origin, 58 - 32 + (3 + exponent) of the way
        let place = |k: usize| -> Option<Near> {
            let way = product(n as i32, (along[k] >> 32) as i32)
                .wrapping_add((product_u(n, along[k] as u32) >> 32) as i64);
            let from = (origin[k] >> (25 - self.exponent)).wrapping_add(i64::from(self.middle[k]));
            Some(Near::from_bits(i32::try_from(way.wrapping_add(from)).ok()? >> 1))
        };
        let origin = if self.limited {
            Vec3::new(place(0)?, place(1)?, place(2)?)
        } else {
            // only its height counts
            Vec3::new(Near::ZERO, Near::ZERO, place(2)?)
        };
        let [dx, dy, dz] = direction.map(Near::from_bits);
        Some(Approach {
            near: NearRay { origin, direction: Vec3::new(dx, dy, dz) },
            start: i64::from(n) << (21 - self.exponent),
            places: self.exponent + shift - 30,
            from: Near::from_bits(shifted(-i64::from(n), shift - 5)),
        })
    }

    /// A place of the world in generic coordinates, saturated.
    fn place(&self, at: Vec3) -> Vec3 {
        let at = [at.x, at.y, at.z].map(Real::to_bits);
        let w = [0, 1, 2].map(|k: usize| at[k].saturating_sub(self.centre[k]));
        let [x, y, z] = [0, 1, 2].map(|k: usize| {
            // 54 fractional bits, then 24
            let v = (dot(self.inverse[k], w) >> (29 - self.exponent)) + 1;
            Real::from_bits(shifted((v >> 1) + i64::from(self.middle[k] >> 5), 0))
        });
        Vec3::new(x, y, z)
    }

    /// Where a crossing is in generic coordinates, to the last bit but one; none for a shape without limits.
    fn near_place(&self, ray: &Ray, crossing: &Crossing) -> Option<Vec3<Near>> {
        if !self.limited {
            return None;
        }
        let w = [0, 1, 2].map(|k: usize| ray.origin[k].wrapping_sub(self.centre[k]));
        let NearRay { origin, direction } = self.mapped(w, ray.direction)?.near;
        let moved = |origin: Near, direction: Near| {
            let way = (product(direction.to_bits(), crossing.memo[0] as i32) + (1 << 27)) >> 28;
            Near::from_bits(shifted(i64::from(origin.to_bits()) + way, 0))
        };
        Some(Vec3::new(
            moved(origin.x, direction.x),
            moved(origin.y, direction.y),
            moved(origin.z, direction.z),
        ))
    }

    /// A direction in generic coordinates, brought to the world by the map.
    fn mapped_tangent(&self, v: Vec3) -> Vec3 {
        let v = [v.x, v.y, v.z].map(Real::to_bits);
        let [x, y, z] = self.linear.map(|row| {
            let [a, b, c] = [row.x, row.y, row.z].map(Real::to_bits);
            let sum = (product(a, v[0]) >> 24) + (product(b, v[1]) >> 24) + (product(c, v[2]) >> 24);
            Real::from_bits(shifted(sum, 0))
        });
        Vec3::new(x, y, z)
    }

    /// The unit normal in the world, by the inverse transpose.
    fn mapped_normal(&self, n: Vec3<Near>) -> Vec3<Unit> {
        let n = [n.x, n.y, n.z].map(Near::to_bits);
        let sums = [0, 1, 2].map(|j: usize| dot([0, 1, 2].map(|i: usize| self.inverse[i][j]), n));
        let magnitude = sums.iter().fold(0_u64, |all, c| all | (c ^ (c >> 63)) as u64);
        let shift = 34_u32.saturating_sub(magnitude.leading_zeros());
        unit(sums.map(|c| (c >> shift) as i32))
    }
}

/// How many steps of `2^-(3 + exponent)` it is to the closest place, to nearest, at most `most`.
///
/// `towards` has 22 + 28 fractional bits, `over` 28, and the direction's unit is `2^(shift - 30)`, all without
/// the inverse's `2^exponent`: `t = towards 2^(8 - shift) / over`.
#[inline(always)]
fn steps(towards: i64, over: u32, shift: i32, exponent: i32, most: u32) -> u32 {
    let Some(over) = NonZeroU32::new(over) else { return most };
    let (mantissa, zeros) = reciprocal_of(over);
    // the upper word is enough: the reciprocal is mantissa 2^zeros / 2^62
    let quotient = product((towards >> 32) as i32, mantissa);
    let right = 19 + shift - zeros as i32 - exponent;
    if right < 1 {
        // a mantissa has 31 bits: far beyond the last step
        return if quotient > 0 { most } else { 0 };
    }
    let n = ((quotient >> (right - 1).min(62)) + 1) >> 1;
    n.clamp(0, i64::from(most)) as u32
}

impl<S: Shape> Surface for Placed<S> {
    fn extent(&self) -> Extent {
        self.extent
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
        let Some(approach) = self.approach(ray) else { return };
        let right = 4 + approach.places;
        self.shape.cross(&approach.near, approach.from, &mut |crossing| {
            let s = i64::from(crossing.s.to_bits());
            let moved = if right >= 1 {
                ((s >> (right - 1).min(62)) + 1) >> 1
            } else {
                s.saturating_mul(1 << (-right).min(62))
            };
            match i32::try_from(approach.start.saturating_add(moved).max(0)) {
                Ok(t) => found(Crossing {
                    t: Real::from_bits(t),
                    enters: crossing.enters,
                    face: crossing.face,
                    memo: [crossing.s.to_bits() as u32, 0],
                }),
                Err(_) => ControlFlow::Break(()),
            }
        });
    }

    fn value(&self, place: Vec3) -> Wide {
        self.shape.value(self.place(place))
    }

    fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint {
        let position = ray.at(crossing.t);
        let (near, place) = self.near_place(ray, crossing).map_or_else(
            || {
                let place = self.place(position);
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
                along_u: self.mapped_tangent(chart.along_u),
                along_v: self.mapped_tangent(chart.along_v),
                ..chart
            }
        } else {
            Chart::default()
        };
        SurfacePoint {
            position,
            place,
            normal: self.mapped_normal(self.shape.normal(near, crossing.face)),
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
