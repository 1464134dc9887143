//! Where a thing is in a world: rays go to its own coordinates by the inverse of an affine map, normals and
//! tangents come back.
//!
//! `t` is the same on both sides: the direction is not normalised. A ray is moved along itself to where it is
//! closest to the middle of the thing's box, `t = t_0 + s 2^-k`: if it is not inside the ball round the box
//! there, it passes by. `t_0` has so few bits that the place there, `o + t_0 d - c`, is exact to `2^-46` at
//! any distance, and what is left of it is small. Normals come back by the inverse transpose, tangents by the
//! map itself.
//!
//! What is closest in the world is not closest in generic coordinates where the map scales by very different
//! factors; there the ray is moved once more, in those.
//!
//! Source: the course unit V, section 5.7; Glassner (ed.), "An Introduction to Ray Tracing", 1989, section
//! 2.7.

use core::num::NonZeroU32;

use super::super::ball::{Ball, LEFT};
use super::super::ray::Ray;
use super::super::surface::Extent;
use super::shape::NearRay;
use crate::Error;
use crate::num::formats::{Q18, Q24, Q28, Q30, Q46, Q54, Q58, UQ56};
use crate::num::{
    Affine3, Near, Real, Unit, Vec3, Wide, high, high_rounded, product, product_u, reciprocal_of, rough_sqrt,
    rounded_down, square, unit,
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
    /// Whether every place in the ball is near the shape in generic coordinates as well, and whether a
    /// direction may be short there.
    is_even: bool,
    is_steep: bool,
    pub(super) limited: bool,
    /// The square of what the map makes of a radius of 1, below 4 and the same in all directions; 0
    /// otherwise.
    round: UQ56,
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
    // what leaves the word after the shift leaves a smaller range before it
    let up = places.max(0) & 31;
    let v = if places < 0 { v >> (-places).min(63) } else { v };
    if v > i64::from(i32::MAX >> up) {
        i32::MAX
    } else if v < i64::from(i32::MIN >> up) {
        i32::MIN
    } else {
        (v as i32) << up
    }
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
const fn moved(row: &[i64; 3], place: &[i64; 3]) -> i64 {
    (row[0] * place[0] + row[1] * place[1] + row[2] * place[2]) >> 28
}

/// Saturated to a word.
const fn word(v: i64) -> i32 {
    if v > i32::MAX as i64 {
        i32::MAX
    } else if v < i32::MIN as i64 {
        i32::MIN
    } else {
        v as i32
    }
}

const fn greater(a: i64, b: i64) -> i64 {
    if a > b { a } else { b }
}

const fn words(v: Vec3<Near>) -> [Q28; 3] {
    [v.x.to_bits(), v.y.to_bits(), v.z.to_bits()]
}

const fn vector([x, y, z]: [Q24; 3]) -> Vec3 {
    Vec3::new(Real::from_bits(x), Real::from_bits(y), Real::from_bits(z))
}

const fn scale(value: Wide) -> Error {
    let (min, max) = (Wide::from_bits(1 << 40), Wide::from_bits(128 << 48));
    Error::OutOfRange { what: "scale of a shape", index: None, value, min, max }
}

/// How far the corners of a box are from its middle: a square of 16 fractional bits.
const fn corners(rows: &[[i64; 3]; 3], half: [i64; 3], slack: i64) -> i64 {
    let (mut farthest, mut signs) = (0, 0);
    // four corners, the others are opposite
    while signs < 4 {
        let y = if signs & 1 == 0 { half[1] } else { -half[1] };
        let z = if signs & 2 == 0 { half[2] } else { -half[2] };
        let (corner, mut sum, mut k) = ([half[0], y, z], 0, 0);
        while k < 3 {
            let c = ((moved(&rows[k], &corner).abs() + slack) >> 8) + 1;
            sum += c * c;
            k += 1;
        }
        farthest = greater(farthest, sum >> 16);
        signs += 1;
    }
    farthest
}

/// The square of what a map makes of every radius of 1, below 4, 56 fractional bits; 0 where it makes
/// something else of some than of others, by more than `2^-23`.
const fn round(rows: &[[i64; 3]; 3], most: i64) -> UQ56 {
    if most >= 4 << 24 {
        return 0;
    }
    let (mut products, mut k) = ([[0_i64; 3]; 3], 0);
    while k < 9 {
        let (i, j) = (k / 3, k % 3);
        // columns; 48 fractional bits
        products[i][j] = rows[0][i] * rows[0][j] + rows[1][i] * rows[1][j] + rows[2][i] * rows[2][j];
        k += 1;
    }
    let square = (products[0][0] + products[1][1] + products[2][2]) / 3;
    if square >= 16 << 48 {
        return 0;
    }
    // 2 r 2^-23
    let (most, mut k) = ((square.unsigned_abs().isqrt() << 2) as i64, 0);
    while k < 9 {
        let want = if k % 4 == 0 { square } else { 0 };
        if (products[k / 3][k % 3] - want).abs() > most {
            return 0;
        }
        k += 1;
    }
    (square as u64) << 8
}

/// How long a radius becomes, its square: by the map's norm at most, whose square is that of a row of the
/// columns' products. 16 fractional bits.
const fn longest(rows: &[[i64; 3]; 3], radius: Near) -> i64 {
    let (mut columns, mut norm, mut k) = ([[0; 3]; 3], 0, 0);
    while k < 9 {
        columns[k % 3][k / 3] = rows[k / 3][k % 3] >> 2;
        k += 1;
    }
    let mut i = 0;
    while i < 3 {
        let (mut sum, mut j) = (0, 0);
        while j < 3 {
            sum += moved(&columns[i], &columns[j]).abs() + 1;
            j += 1;
        }
        norm = greater(norm, sum);
        i += 1;
    }
    let radius = (radius.to_bits() >> 12) as i64 + 1;
    norm.saturating_mul((radius * radius) >> 16) >> 16
}

impl Site {
    /// The site of a box of generic coordinates, or of a half-space without one, under a map. All of the
    /// shape may be known to be within a radius of the box's middle.
    pub(super) const fn new(
        bounds: Option<[Vec3<Near>; 2]>,
        radius: Option<Near>,
        map: &Affine3,
    ) -> Result<Self, Error> {
        let inverse = match map.inverse() {
            Ok(inverse) => inverse,
            Err(error) => return Err(error),
        };
        let exponent = inverse.exponent;
        let greatest = map.greatest();
        if greatest.to_bits() >= 128 << 48 {
            return Err(scale(greatest));
        }
        // entries below 128 have an inverse whose greatest is above 2^-9
        if exponent < -8 || exponent > 8 {
            let places = if exponent < 0 { 0 } else { exponent };
            return Err(scale(Wide::from_bits(if places > 47 { 2 } else { (1 << 48) >> places })));
        }
        let (linear, _) = map.parts();
        let [low, high] = match bounds {
            Some([low, high]) => [words(low), words(high)],
            None => [[0; 3]; 2],
        };
        let (mut middle, mut half, mut k) = ([0; 3], [0; 3], 0);
        while k < 3 {
            // bounds are within 2: no sum leaves a word
            middle[k] = low[k].saturating_add(high[k]) >> 5;
            half[k] = (high[k].saturating_sub(low[k]) >> 1) as i64 + 16;
            k += 1;
        }
        let [x, y, z] = middle;
        let centre = map.at(Vec3::new(Real::from_bits(x), Real::from_bits(y), Real::from_bits(z)));
        let centre: [Q24; 3] = [centre.x.to_bits(), centre.y.to_bits(), centre.z.to_bits()];
        let mut rows = [[0_i64; 3]; 3];
        let (mut k, mut sizes, mut most, mut largest) = (0, [0; 3], 0, 0);
        while k < 3 {
            if centre[k] > 64 << 24 || centre[k] <= -(64 << 24) {
                let (min, max) = (Wide::from_bits(-64 << 48), Wide::from_bits(64 << 48));
                let value = Wide::from_bits((centre[k] as i64) << 24);
                return Err(Error::OutOfRange { what: "place of a shape", index: Some(k), value, min, max });
            }
            let Vec3 { x, y, z } = linear[k];
            let row = [x.to_bits() as i64, y.to_bits() as i64, z.to_bits() as i64];
            let size = [row[0].abs(), row[1].abs(), row[2].abs()];
            (rows[k], sizes[k]) = (row, moved(&size, &half));
            (most, largest) =
                (greater(most, greater(greater(size[0], size[1]), size[2])), greater(largest, sizes[k]));
            middle[k] <<= 4;
            k += 1;
        }
        // what rounding the inverse makes of a place as far away as the box's corner, and a few units
        let slack = 16 + (((most >> 12) * (largest >> 12) * 9) >> (31 - exponent));
        let mut farthest = corners(&rows, half, slack);
        if let Some(radius) = radius {
            let square = longest(&rows, radius);
            // and what was rounded there
            let round = square + (square >> 8) + (slack as i32 >> 4) as i64;
            farthest = if round < farthest { round } else { farthest };
        }
        // the radius below 2^length
        let ball = if farthest >= u32::MAX as i64 { u32::MAX } else { farthest as u32 + 1 };
        let length = (17 - ball.leading_zeros() as i32).div_euclid(2);
        let fractional = if 31 - length < 30 + exponent { 31 - length } else { 30 + exponent };
        // squares of norms: of the inverse with 28, of the map with 32 fractional bits; what the map makes
        // longest has the shortest image, and rows whose sum reaches 2 may make one longer than a word
        let (mut norm, mut length, mut is_steep, mut k) = (0_u64, 0_u64, false, 0);
        while k < 3 {
            let (mut sum, mut j) = (0_u64, 0);
            while j < 3 {
                let size = inverse.rows[k][j].unsigned_abs() as u64;
                (sum, norm) = (sum + size, norm + (size >> 15) * (size >> 15));
                length += ((rows[k][j] >> 8) * (rows[k][j] >> 8)) as u64;
                j += 1;
            }
            is_steep |= sum >> 31 > 0;
            k += 1;
        }
        is_steep |= length >> (40 - 2 * exponent) > 0;
        // whether what is in the ball is within 4 of the origin in generic coordinates: 16 fractional bits
        let reached = (norm >> 4).saturating_mul(ball as u64) >> (26 - 2 * exponent);
        let aside = (middle[0].unsigned_abs() >> 20)
            + (middle[1].unsigned_abs() >> 20)
            + (middle[2].unsigned_abs() >> 20);
        let within = 998_u64.saturating_sub(aside as u64);
        let is_even = !is_steep && reached <= within * within;
        let limited = bounds.is_some();
        let (mut low, mut high, mut k) = (centre, centre, 0);
        while k < 3 {
            let reach = sizes[k] + slack;
            (low[k], high[k]) = (word(centre[k] as i64 - reach), word(centre[k] as i64 + reach));
            k += 1;
        }
        Ok(Self {
            limited,
            round: round(&rows, most),
            inverse: inverse.rows,
            exponent,
            middle,
            ball: if limited {
                Ball { centre, square: ball, up: [0; 3] }
            } else {
                Ball { centre, square: u32::MAX, up: inverse.rows[2] }
            },
            up: (fractional - 14) as u32,
            left: (30 - fractional + exponent) as u32,
            is_even,
            is_steep,
            linear,
            norm: length.isqrt() as u32,
            extent: if limited { Extent { low: vector(low), high: vector(high) } } else { Extent::SPACE },
        })
    }

    /// How wrong a parameter is at most where `s` is wrong by `near`, for a direction of length 1.
    pub(super) const fn error(&self, near: Near) -> Real {
        // s is worth at most 2 sqrt(3) of t times the map's norm; a place is known to a few units
        let near = near.to_bits() as i64 + 8;
        Real::from_bits(word(((near * self.norm as i64 * 111) >> 25) + 2))
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

    /// Whether the ray is one that [`Site::round_crossings`] knows.
    #[inline(always)]
    pub(super) fn is_round(&self) -> bool {
        self.round > 0
    }

    /// Where a ray goes into the image of the sphere of radius 1 and out of it, wherever these are on its
    /// line, 24 fractional bits; none if it does not, and the whole of it none where nobody can tell.
    ///
    /// With `p` the way from the closest place to the centre, these are
    /// `t_0 + (p . d -+ |d| sqrt(r^2 - p^2)) / |d|^2`.
    #[inline(always)]
    pub(super) fn round_crossings(&self, ray: &Ray) -> Option<Option<[Q24; 2]>> {
        if ray.pace == 0 {
            return None;
        }
        let (steps, way) = self.ball.closest_on_line(ray)?;
        if !self.ball.holds(way) {
            return Some(None);
        }
        // below 4
        let way: [Q28; 3] = way.map(rounded_down::<18>);
        let inside = self.round.wrapping_sub(square(way)) as i64;
        if inside <= 0 {
            return Some(None);
        }
        let half: Q28 = rounded_down::<30>(product(rough_sqrt(inside as u64) as i32, ray.slowness));
        // what is left over of the way to the closest place: 30 fractional bits, below 2^-15
        let rest = high(rounded_down::<26>(dot(way, ray.direction)), ray.pace);
        let end = |s: Q28| (steps << 6).saturating_add((s + 8) >> 4);
        Some(Some([end(rest.wrapping_sub(half)), end(rest.wrapping_add(half))]))
    }

    /// The unit vector from the centre to a place.
    #[inline]
    pub(super) fn away(&self, place: Vec3) -> Vec3<Unit> {
        let ([x, y, z], place) = (self.ball.centre, [place.x, place.y, place.z].map(Real::to_bits));
        unit([place[0].wrapping_sub(x), place[1].wrapping_sub(y), place[2].wrapping_sub(z)])
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

    /// A line through a place in the ball, from which `way` leads to the middle with `14 + up` fractional
    /// bits, in generic coordinates; and the logarithm of its direction's unit. The upper words of the
    /// products are all that is looked at.
    #[inline(always)]
    pub(super) fn line(&self, way: [i32; 3], d: [Q30; 3]) -> (NearRay, i32) {
        // row by row: each is loaded once
        let [x, y, z] = self.inverse.map(|row| [d, way].map(|v| high_dot(row, v)));
        // the direction's greatest component gets 29 bits; a long ray's may have 30 of them before, as the
        // inverse may make it longer
        let all = [x[0], y[0], z[0]].into_iter().fold(0, |all, c| all | (c ^ (c >> 31)));
        let up = all.leading_zeros().wrapping_sub(2);
        let along = |c: Q28| Near::from_bits((c << (up & 31)) >> 1);
        let direction = Vec3::new(along(x[0]), along(y[0]), along(z[0]));
        let place = |middle: i32, moved: i32| Near::from_bits(middle.wrapping_sub(moved << (self.left & 31)));
        let [a, b, c] = self.middle;
        let origin = Vec3::new(place(a, x[1]), place(b, y[1]), place(c, z[1]));
        (NearRay { origin, direction }, self.exponent + 1 - up as i32)
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
        // 54 fractional bits, then 25
        let up = (3 + self.exponent) as u32;
        let [x, y, z] = [0, 1, 2].map(|k: usize| {
            let way = dot(self.inverse[k], w);
            let high = (way >> 32) as i32;
            let middle = self.middle[k] >> 4;
            // what the shift leaves within 30 bits is far from the ends
            let c = if (1..=10).contains(&up) && (high ^ (high >> 31)) >> (29 - up) == 0 {
                ((narrowed(way, up) + 1) >> 1) + middle
            } else {
                self.far_coordinate(way, middle)
            };
            Real::from_bits(c)
        });
        Vec3::new(x, y, z)
    }

    #[cold]
    #[inline(never)]
    fn far_coordinate(&self, way: Q54, middle: Q24) -> Q24 {
        let c = (((way >> (29 - self.exponent)) + 1) >> 1) + i64::from(middle);
        i32::try_from(c).unwrap_or(if c < 0 { i32::MIN } else { i32::MAX })
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
/// `towards` has 22 + 28 fractional bits, `over` 28, and the direction's unit is `2^(shift - 30)`, all
/// without the inverse's `2^exponent`: `t = towards 2^(8 - shift) / over`.
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
