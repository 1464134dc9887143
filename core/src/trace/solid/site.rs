//! Where a thing is in a world: rays go to its own coordinates by the inverse of an affine map, normals and
//! tangents come back.
//!
//! `t` is the same on both sides: the direction is not normalised. A ray is moved along itself to where it is
//! closest to the middle of the thing's box, `t = t_0 + s 2^-k`: if it is not inside the ball round the box
//! there, it passes by. `t_0` has so few bits that the place there, `o + t_0 d - c`, is exact to `2^-46` at any
//! distance, and what is left of it is small. Normals come back by the inverse transpose, tangents by the map
//! itself.
//!
//! What is closest in the world is not closest in generic coordinates where the map scales by very different
//! factors; there the ray is moved once more, in those.
//!
//! Source: the course unit V, section 5.7; Glassner (ed.), "An Introduction to Ray Tracing", 1989, section 2.7.

use core::num::NonZeroU32;

use super::super::ball::{Ball, LEFT};
use super::super::ray::Ray;
use super::super::surface::Extent;
use super::shape::NearRay;
use crate::Error;
use crate::num::formats::{Q18, Q24, Q28, Q30, Q46, Q54, Q58};
use crate::num::{
    Affine3, Near, Real, Unit, Vec3, Wide, high_rounded, product, product_u, reciprocal_of, sqrt, square,
    unit,
};

/// A map and what it makes of a box.
#[derive(Debug, Clone, Copy)]
pub(super) struct Site {
    /// `M^-1 = inverse 2^exponent`, its greatest entry in `[1/2, 1]`.
    inverse: [[Q30; 3]; 3],
    /// -8 to 8.
    exponent: i32,
    /// That middle, in generic coordinates: a place of the world's resolution.
    middle: [Q28; 3],
    /// Round the middle of the shape's box; for a half-space it has no end.
    pub(super) ball: Ball,
    /// A place in the ball has `14 + up` fractional bits in a word.
    pub(super) up: u32,
    /// Such a place times `inverse` has 28 in the upper word after a shift to the left by so many places.
    left: u32,
    /// Whether every place in the ball is near the shape in generic coordinates as well, and whether a direction
    /// may be short there.
    is_even: bool,
    is_steep: bool,
    pub(super) limited: bool,
    linear: [Vec3; 3],
    /// The norm of the map, 16 fractional bits.
    norm: u32,
    pub(super) extent: Extent,
}

/// A ray near the shape: `t = start + s 2^-k`.
pub(super) struct Approach {
    pub(super) near: NearRay,
    pub(super) start: Q24,
    /// `k`.
    pub(super) places: i32,
    /// The `s` at `t` = 0, or a little less: `t` is known to within `SAME`.
    pub(super) from: Near,
}

impl Approach {
    /// A near ray that begins at a parameter, `k` places.
    #[inline(always)]
    fn new(near: NearRay, start: Q18, places: i32) -> Self {
        // as much before the ray's begin as parameters are known to
        let (early, up) = (2 * start + 1, 9 + places);
        let from = if (0..=31).contains(&up) && early.leading_zeros() as i32 > up {
            -(early << up)
        } else {
            shifted(-i64::from(early), up)
        };
        Self { near, start: start << 6, places, from: Near::from_bits(from) }
    }

    /// The ray's parameter where the near ray has `s`, to nearest; beyond the format's end none.
    #[inline(always)]
    pub(super) fn parameter(&self, s: Near) -> Option<Real> {
        let (s, right) = (s.to_bits(), 4 + self.places);
        let moved =
            if right >= 1 { ((s >> (right - 1).min(31)) + 1) >> 1 } else { shifted(s.into(), -right) };
        let t = self.start.saturating_add(moved).max(0);
        if t == i32::MAX { None } else { Some(Real::from_bits(t)) }
    }

    /// The place where the near ray has `s`, to nearest, saturated.
    pub(super) fn at(&self, s: Near) -> Vec3<Near> {
        let moved = |origin: Near, direction: Near| {
            let way = (product(direction.to_bits(), s.to_bits()) + (1 << 27)) >> 28;
            Near::from_bits(shifted(i64::from(origin.to_bits()) + way, 0))
        };
        let (o, d) = (self.near.origin, self.near.direction);
        Vec3::new(moved(o.x, d.x), moved(o.y, d.y), moved(o.z, d.z))
    }
}

/// The scalar product of words, which the caller knows to fit.
#[inline(always)]
fn dot(a: [i32; 3], b: [i32; 3]) -> i64 {
    product(a[0], b[0]).wrapping_add(product(a[1], b[1])).wrapping_add(product(a[2], b[2]))
}

/// The upper word of the scalar product, each product rounded to nearest: a register less than [`dot`] takes.
#[inline(always)]
fn high_dot(a: [i32; 3], b: [i32; 3]) -> i32 {
    high_rounded(a[0], b[0]).wrapping_add(high_rounded(a[1], b[1])).wrapping_add(high_rounded(a[2], b[2]))
}

/// `v 2^places`, saturated to a word; places below 32, shifts to the right round down.
#[inline(never)]
pub(super) fn shifted(v: i64, places: i32) -> i32 {
    let v = if places >= 0 { v.saturating_mul(1 << (places & 63)) } else { v >> (-places).min(63) };
    v.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}

/// `v 2^up / 2^32` for 1 to 31 places, if it fits a word.
#[inline(always)]
fn narrowed(v: i64, up: u32) -> i32 {
    // by words: a 64-bit shift by a variable takes three times as long
    ((v >> 32) as i32) << (up & 31) | ((v as u32) >> (32_u32.wrapping_sub(up) & 31)) as i32
}

/// All bits of upper words without their signs.
#[inline(always)]
fn folded(all: u32, v: i64) -> u32 {
    let high = (v >> 32) as i32;
    all | (high ^ (high >> 31)) as u32
}

/// A coordinate of a place, of 24 + 28 fractional bits less 28.
#[inline(never)]
fn moved(row: &[i64; 3], place: &[i64; 3]) -> i64 {
    (row[0] * place[0] + row[1] * place[1] + row[2] * place[2]) >> 28
}

impl Site {
    /// The site of a box of generic coordinates, or of a half-space without one, under a map. All of the shape
    /// may be known to be within a radius of the box's middle.
    pub(super) fn new(
        bounds: Option<[Vec3<Near>; 2]>,
        radius: Option<Near>,
        map: &Affine3,
    ) -> Result<Self, Error> {
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
        let corner = |v: Vec3<Near>| [v.x, v.y, v.z].map(Near::to_bits);
        let [low, high] = bounds.map_or([[0; 3]; 2], |[low, high]| [corner(low), corner(high)]);
        // bounds are within 2: no sum leaves a word
        let middle = [0, 1, 2].map(|k: usize| low[k].saturating_add(high[k]) >> 5);
        let [x, y, z] = middle.map(Real::from_bits);
        let middle = middle.map(|c| c << 4);
        let half = [0, 1, 2].map(|k: usize| i64::from(high[k].saturating_sub(low[k]) >> 1) + 16);
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
        let sizes = rows.map(|row| moved(&row.map(i64::abs), &half));
        // what rounding the inverse makes of a place as far away as the box's corner, and a few units
        let greatest = rows.iter().flatten().map(|c| c.abs()).max().unwrap_or(0);
        let largest = sizes.into_iter().fold(0, i64::max);
        let slack = 16 + (((greatest >> 12) * (largest >> 12) * 9) >> (31 - inverse.exponent));
        let reach = sizes.map(|size| size + slack);
        // four corners of the box, the others are opposite; 16 fractional bits
        let mut farthest = 0;
        for (a, b) in [(1, 1), (1, -1), (-1, 1), (-1, -1)] {
            let corner = [half[0], half[1] * a, half[2] * b];
            let mut sum = 0;
            for row in &rows {
                let c = ((moved(row, &corner).abs() + slack) >> 8) + 1;
                sum += c * c;
            }
            farthest = farthest.max(sum >> 16);
        }
        // a ball of generic coordinates becomes longer by the map's norm at most: the squares of that are sums of
        // rows of the columns' products, 16 fractional bits
        if let Some(radius) = radius {
            let mut norm = 0;
            for i in 0..3 {
                let column = |k: usize| rows.map(|row| row[k] >> 2);
                let entry = |j: usize| moved(&column(i), &column(j)).abs() + 1;
                norm = norm.max(entry(0) + entry(1) + entry(2));
            }
            let radius = i64::from(radius.to_bits() >> 12) + 1;
            let square = norm.saturating_mul((radius * radius) >> 16) >> 16;
            // and what was rounded there
            farthest = farthest.min(square + (square >> 8) + i64::from(slack as i32 >> 4));
        }
        // the radius below 2^length
        let ball = u32::try_from(farthest + 1).unwrap_or(u32::MAX);
        let length = (17 - ball.leading_zeros() as i32).div_euclid(2);
        let fractional = (31 - length).min(30 + inverse.exponent);
        // whether what is in the ball is within 4 of the origin in generic coordinates, by the inverse's norm:
        // squares with 16 fractional bits
        let norm: u64 = inverse.rows.iter().flatten().map(|c| u64::from(c.unsigned_abs() >> 15).pow(2)).sum();
        let reached = (norm >> 4).saturating_mul(ball.into()) >> (26 - 2 * inverse.exponent);
        let aside: u64 = middle.iter().map(|c| u64::from(c.unsigned_abs() >> 20)).sum();
        // squares with 32 fractional bits: what the map makes longest has the shortest image, and rows whose
        // sum reaches 2 may make one longer than a word
        let length: u64 = rows.iter().flatten().map(|c| ((c >> 8) * (c >> 8)) as u64).sum();
        let sum = |row: &[Q30; 3]| row.iter().map(|c| u64::from(c.unsigned_abs())).sum::<u64>();
        let is_steep =
            length >> (40 - 2 * inverse.exponent) > 0 || inverse.rows.iter().any(|row| sum(row) >> 31 > 0);
        let is_even = !is_steep && reached <= 998_u64.saturating_sub(aside).pow(2);
        let end = |c: Q24, r: i64| Real::from_bits(shifted(i64::from(c) + r, 0));
        let [x, y, z] = [0, 1, 2].map(|k: usize| (end(centre[k], -reach[k]), end(centre[k], reach[k])));
        let extent = Extent { low: Vec3::new(x.0, y.0, z.0), high: Vec3::new(x.1, y.1, z.1) };
        Ok(Self {
            limited: bounds.is_some(),
            inverse: inverse.rows,
            exponent: inverse.exponent,
            middle,
            ball: match bounds {
                Some(_) => Ball { centre, square: ball, up: [0; 3] },
                None => Ball { centre, square: u32::MAX, up: inverse.rows[2] },
            },
            up: (fractional - 14) as u32,
            left: (30 - fractional + inverse.exponent) as u32,
            is_even,
            is_steep,
            linear,
            norm: sqrt(length),
            extent: if bounds.is_some() { extent } else { Extent::SPACE },
        })
    }

    /// How wrong a parameter is at most where `s` is wrong by `near`, for a direction of length 1.
    pub(super) fn error(&self, near: Near) -> Real {
        // s is worth at most 2 sqrt(3) of t times the map's norm; a place is known to a few units
        let near = i64::from(near.to_bits()) + 8;
        Real::from_bits(shifted(((near * i64::from(self.norm) * 111) >> 25) + 2, 0))
    }

    /// The ray in the shape's coordinates, moved to where it is closest; none if it comes nowhere near.
    #[inline(never)]
    pub(super) fn approach(&self, ray: &Ray) -> Option<Approach> {
        let ball = &self.ball;
        if !self.limited {
            return self.over(ball.from(ray), ray.direction);
        }
        if ray.pace != 0 {
            let (steps, place) = ball.closest(ray);
            if !ball.holds(place) {
                return None;
            }
            if let Some(approach) = self.brought(steps, place, ray) {
                return Some(approach);
            }
        }
        self.mapped(ball.from(ray), ray.direction)
    }

    /// The same as [`Site::approach`] for a ray of which something is known to be met.
    #[inline]
    pub(super) fn approach_met(&self, ray: &Ray) -> Option<Approach> {
        self.approach(ray)
    }

    /// The ray from a place near the centre on, which is seen from there; none where it has to be moved in
    /// generic coordinates.
    #[inline(always)]
    fn brought(&self, steps: Q18, place: [Q46; 3], ray: &Ray) -> Option<Approach> {
        let way = place.map(|c| narrowed(c, self.up));
        if !self.is_even && !self.is_nearby(way) {
            return None;
        }
        let (near, places) = self.line(way, ray.fine);
        Some(Approach::new(near, steps, places + ray.steep))
    }

    /// Whether a place in the ball is near the shape in generic coordinates.
    #[cold]
    #[inline(never)]
    fn is_nearby(&self, way: [i32; 3]) -> bool {
        let far = self.inverse.iter().fold(0, |all, row| folded(all, dot(*row, way)));
        !self.is_steep && far >> (29_u32.wrapping_sub(self.left) & 31) == 0
    }

    /// A line through a place in the ball, from which `way` leads to the middle with `14 + up` fractional bits, in
    /// generic coordinates; and the
    /// logarithm of its direction's unit. The upper words of the products are all that is looked at.
    #[inline(always)]
    pub(super) fn line(&self, way: [i32; 3], d: [Q30; 3]) -> (NearRay, i32) {
        // row by row: each is loaded once
        let [x, y, z] = self.inverse.map(|row| [d, way].map(|v| high_dot(row, v)));
        // the direction's greatest component gets 29 bits
        let all = [x[0], y[0], z[0]].into_iter().fold(0, |all, c| all | (c ^ (c >> 31)));
        let up = all.leading_zeros().wrapping_sub(3);
        let along = |c: Q28| Near::from_bits(c << (up & 31));
        let direction = Vec3::new(along(x[0]), along(y[0]), along(z[0]));
        let place = |middle: i32, moved: i32| Near::from_bits(middle.wrapping_sub(moved << (self.left & 31)));
        let [a, b, c] = self.middle;
        let origin = Vec3::new(place(a, x[1]), place(b, y[1]), place(c, z[1]));
        (NearRay { origin, direction }, self.exponent - up as i32)
    }

    /// The same for a half-space, of which the height alone counts: its ray goes straight up or down.
    #[inline(always)]
    fn over(&self, way: [Q24; 3], d: [Q28; 3]) -> Option<Approach> {
        let [.., row] = self.inverse;
        let (below, rise): (Q54, Q58) = (dot(row, way), dot(row, d));
        // 22 fractional bits; what leaves it behind by more than a few units does not meet it
        let high = (below >> 32) as i32;
        if high ^ ((rise >> 32) as i32) < 0 && high ^ (high >> 31) > LEFT {
            return None;
        }
        // the direction gets 29 bits
        let up = folded(0, rise).leading_zeros().wrapping_sub(3);
        let is_near = (high ^ (high >> 31)) >> (25 - self.exponent).clamp(0, 31) == 0;
        if is_near && (1..=31).contains(&up) && self.exponent >= -5 {
            let place = narrowed(below, (6 + self.exponent) as u32).wrapping_neg();
            let near = upright(place, narrowed(rise, up));
            return Some(Approach::new(near, 0, self.exponent + 2 - up as i32));
        }
        self.moved_over(below, rise)
    }

    /// The same from farther away: the ray is moved to the plane.
    #[cold]
    #[inline(never)]
    fn moved_over(&self, below: Q54, rise: Q58) -> Option<Approach> {
        let shift = 35 - (rise ^ (rise >> 63)).leading_zeros() as i32;
        if shift < 0 {
            return None;
        }
        let down = (rise >> shift) as i32;
        let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(down.unsigned_abs())?);
        // 2^18 t is 2^22 height / rise; the upper word is enough
        let high = (below >> 32) as i32;
        let towards = product(if down < 0 { high.wrapping_neg() } else { high }, mantissa);
        let steps = (towards >> (8 + shift - zeros as i32)).clamp(0, (1 << 25) - 1) as i32;
        // 44 fractional bits
        let way = product(steps, (rise >> 32) as i32)
            .wrapping_add((product_u(steps as u32, rise as u32) >> 32) as i64);
        let place = i32::try_from(way.wrapping_sub(below >> 10) >> (16 - self.exponent)).ok()?;
        Some(Approach::new(upright(place, down), steps, self.exponent + shift - 30))
    }

    /// The same without a look at the ball.
    #[cold]
    #[inline(never)]
    fn mapped(&self, w: [Q24; 3], d: [Q28; 3]) -> Option<Approach> {
        // both without the inverse's power of two; a row's sum of magnitudes is at most 3
        let origin: [Q54; 3] = self.inverse.map(|row| dot(row, w).wrapping_neg());
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
        let most = (1 << 18 >> (8 - self.exponent)) - 1;
        let towards = -dot(origin.map(|c| (c >> 32) as i32), direction);
        let over = ((square(direction)) >> 28) as u32;
        let n = if towards <= 0 { 0 } else { steps(towards, over, shift, self.exponent, most) };
        // 29 fractional bits: 54 + exponent - 25 of the origin, 58 - 32 + (3 + exponent) of the way
        let place = |k: usize| -> Option<Near> {
            let way = product(n as i32, (along[k] >> 32) as i32)
                .wrapping_add((product_u(n, along[k] as u32) >> 32) as i64);
            let from = (origin[k] >> (25 - self.exponent)).wrapping_add(i64::from(self.middle[k]) << 1);
            Some(Near::from_bits(i32::try_from(way.wrapping_add(from)).ok()? >> 1))
        };
        let origin = Vec3::new(place(0)?, place(1)?, place(2)?);
        let [dx, dy, dz] = direction.map(Near::from_bits);
        let near = NearRay { origin, direction: Vec3::new(dx, dy, dz) };
        Some(Approach::new(near, (n << (15 - self.exponent)) as i32, self.exponent + shift - 30))
    }

    /// A place of the world in generic coordinates, saturated.
    #[inline(never)]
    pub(super) fn place(&self, at: Vec3) -> Vec3 {
        let at = [at.x, at.y, at.z].map(Real::to_bits);
        let w = [0, 1, 2].map(|k: usize| at[k].saturating_sub(self.ball.centre[k]));
        let [x, y, z] = [0, 1, 2].map(|k: usize| {
            // 54 fractional bits, then 24
            let v = (dot(self.inverse[k], w) >> (29 - self.exponent)) + 1;
            let v = (v >> 1) + i64::from(self.middle[k] >> 4);
            Real::from_bits(i32::try_from(v).unwrap_or(if v < 0 { i32::MIN } else { i32::MAX }))
        });
        Vec3::new(x, y, z)
    }

    /// A direction in generic coordinates, brought to the world by the map.
    pub(super) fn tangent(&self, v: Vec3) -> Vec3 {
        let v = [v.x, v.y, v.z].map(Real::to_bits);
        let [x, y, z] = self.linear.map(|row| {
            let [a, b, c] = [row.x, row.y, row.z].map(Real::to_bits);
            let sum = (product(a, v[0]) >> 24) + (product(b, v[1]) >> 24) + (product(c, v[2]) >> 24);
            Real::from_bits(shifted(sum, 0))
        });
        Vec3::new(x, y, z)
    }

    /// The unit normal in the world, by the inverse transpose; that of a shape in any format.
    pub(super) fn normal(&self, n: [i32; 3]) -> Vec3<Unit> {
        let sums = [0, 1, 2].map(|j: usize| dot([0, 1, 2].map(|i: usize| self.inverse[i][j]), n));
        let magnitude = sums.iter().fold(0_u64, |all, c| all | (c ^ (c >> 63)) as u64);
        let shift = 34_u32.saturating_sub(magnitude.leading_zeros());
        unit(sums.map(|c| (c >> shift) as i32))
    }
}

/// A ray straight up or down at a height.
#[inline(always)]
fn upright(height: Q28, up: Q28) -> NearRay {
    let along = |c: i32| Vec3::new(Near::ZERO, Near::ZERO, Near::from_bits(c));
    NearRay { origin: along(height), direction: along(up) }
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
