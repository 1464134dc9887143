//! A ball or a half-space that holds a thing: what most rays pass by, and where the others are near it.
//!
//! A ray `o + t d` is closest to a centre `c` at `t_0 = (c - o) . d / |d|^2`, or at its begin. If it is not
//! in the ball there, it never is. `t_0` has 18 fractional bits, so that the way from there to the centre,
//! `c - o - t_0 d`, is exact with 46.

use super::ray::Ray;
use crate::num::formats::{Q18, Q24, Q28, Q30, Q46, UQ16};
use crate::num::{Real, Vec3, high, high_rounded, high_u, product, square};

/// A ball, a half-space, or the whole of space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Ball {
    pub(super) centre: [Q24; 3],
    /// The square of the radius, rounded up; the greatest number for what has no end.
    pub(super) square: UQ16,
    /// What has no end is below a plane through the centre, which this is at right angles to, of a length
    /// about 1; 0 for the whole of space.
    pub(super) up: [Q30; 3],
}

/// What leaves a plane behind by more, with 22 fractional bits, does not meet it: a few units of a place.
pub(super) const LEFT: i32 = 128;

#[inline(always)]
fn dot(a: [i32; 3], b: [i32; 3]) -> i64 {
    product(a[0], b[0]).wrapping_add(product(a[1], b[1])).wrapping_add(product(a[2], b[2]))
}

/// The upper word of the scalar product, each product rounded to nearest.
#[inline(always)]
pub(super) fn high_dot(a: [i32; 3], b: [i32; 3]) -> i32 {
    high_rounded(a[0], b[0]).wrapping_add(high_rounded(a[1], b[1])).wrapping_add(high_rounded(a[2], b[2]))
}

impl Ball {
    /// The whole of space.
    pub const SPACE: Self = Self { centre: [0; 3], square: u32::MAX, up: [0; 3] };

    /// The ball round the box between two corners.
    pub fn round(low: Vec3, high: Vec3) -> Self {
        let (mut centre, mut sum) = ([0; 3], 0_u64);
        for (c, (low, high)) in centre.iter_mut().zip([(low.x, high.x), (low.y, high.y), (low.z, high.z)]) {
            let [low, high] = [low, high].map(|c| i64::from(c.to_bits()));
            *c = ((low + high) >> 1) as i32;
            // 16 fractional bits, and what places are known to
            let half = ((high - low).max(0) >> 9) as u64 + 10;
            sum += half * half;
        }
        // a world ends at 64
        let far = centre.iter().any(|c: &i32| c.unsigned_abs() > 64 << 24);
        match u32::try_from((sum >> 16) + 1) {
            Ok(square) if !far => Self { centre, square, up: [0; 3] },
            _ => Self::SPACE,
        }
    }

    /// Whether a ray certainly never comes into the ball: no ray that does passes it by, and those that miss
    /// it by more than `(1 + b) 2^-14` in squares do, `b` along the ray
    /// (`a_ray_that_grazes_a_ball_does_not_pass_it_by`).
    ///
    /// With `w` the way to the centre and `b` how far along the ray it is closest, or 0 for what is behind
    /// its begin, a ray passes by where `w^2 - b^2` is above the square of the radius.
    #[inline(always)]
    pub(super) fn is_passed_by(&self, ray: &Ray) -> bool {
        let way = self.from(ray);
        if self.square < u32::MAX {
            // 22 fractional bits, below 444; then 20, less what the direction has lost
            let along = high(high_dot(way, ray.fine), ray.slowness).max(0) as u32;
            // 24 fractional bits, below 222
            let along = along << ((4 + ray.steep) & 31);
            // what is rounded of it is 2^-17.6 at most, and counts twice in the square
            let closer = high_u(along, along) + (along >> 24) + 4;
            let far = (square(way) >> 32) as u32;
            // halves, below 2^31; without a pace nobody can tell
            ray.pace != 0 && (far >> 1) as i32 - (closer >> 1) as i32 > (self.square >> 1) as i32
        } else {
            // what is this far away and met before 128 rises by more than is rounded
            let [below, rise] = [way, ray.direction].map(|v| high_dot(v, self.up));
            below ^ rise < 0 && below ^ (below >> 31) > LEFT
        }
    }

    /// Whether a place is in the ball that is so far from the centre: to `2^-14`, which the radius has room
    /// for.
    #[inline(always)]
    pub(super) fn holds(&self, way: [Q46; 3]) -> bool {
        // words with 14 fractional bits, 222 at most
        (square(way.map(|c| (c >> 32) as i32)) >> 12) as u32 <= self.square
    }

    /// Whether a place may be in the ball.
    #[inline]
    pub(super) fn has(&self, place: Vec3) -> bool {
        let ([x, y, z], place) = (self.centre, [place.x, place.y, place.z].map(Real::to_bits));
        let way = [x.wrapping_sub(place[0]), y.wrapping_sub(place[1]), z.wrapping_sub(place[2])];
        // 16 fractional bits, half a unit more at most than in truth; a world ends at 64
        (square(way.map(|c| (c + 128) >> 8)) >> 16) as u32 <= self.square
    }

    /// The parameter where a ray with a pace is closest to the centre, and the way from there to the centre.
    #[inline(always)]
    pub(super) fn closest(&self, ray: &Ray) -> (Q18, [Q46; 3]) {
        let way = self.from(ray);
        let d = ray.direction;
        // less than 2^63: 222 times 7; the parameter ends at 128
        let back = -high((dot(way, d) >> 32) as i32, ray.pace).clamp(0, (1 << 25) - 1);
        let moved = |way: Q24, d: Q28| {
            // way 2^22, by words
            (i64::from(way >> 10) << 32 | i64::from((way << 22) as u32)).wrapping_add(product(back, d))
        };
        (-back, [moved(way[0], d[0]), moved(way[1], d[1]), moved(way[2], d[2])])
    }

    /// The same on the whole line, `t` below 0 as well; none beyond ±128.
    #[inline(always)]
    pub(super) fn closest_on_line(&self, ray: &Ray) -> Option<(Q18, [Q46; 3])> {
        let (way, d) = (self.from(ray), ray.direction);
        let steps = high((dot(way, d) >> 32) as i32, ray.pace);
        // within 2^25
        if steps ^ (steps >> 31) >= 1 << 25 {
            return None;
        }
        let back = steps.wrapping_neg();
        let moved = |way: Q24, d: Q28| {
            (i64::from(way >> 10) << 32 | i64::from((way << 22) as u32)).wrapping_add(product(back, d))
        };
        Some((steps, [moved(way[0], d[0]), moved(way[1], d[1]), moved(way[2], d[2])]))
    }

    /// The way from the ray's origin to the centre.
    #[inline(always)]
    pub(super) fn from(&self, ray: &Ray) -> [Q24; 3] {
        let ([x, y, z], [ox, oy, oz]) = (self.centre, ray.origin);
        [x.wrapping_sub(ox), y.wrapping_sub(oy), z.wrapping_sub(oz)]
    }

    /// Where the centre is.
    pub fn centre(&self) -> Vec3 {
        let [x, y, z] = self.centre.map(Real::from_bits);
        Vec3::new(x, y, z)
    }
}

#[cfg(test)]
mod tests {
    use super::super::exact::words;
    use super::*;

    fn floats(v: Vec3) -> [f64; 3] {
        [v.x, v.y, v.z].map(|c| c.to_num())
    }

    /// Rays that are within a ten thousandth of tangency, at any distance, of any length: against squares of
    /// distances in double precision.
    #[test]
    fn a_ray_that_grazes_a_ball_does_not_pass_it_by() {
        let mut word = words(29);
        let mut random = move || (word() >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0;
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (mut grazed, mut missed, mut kept, mut nearest) = (0, 0, 0, f64::MAX);
        for k in 0..60_000 {
            let far = [63.0, 20.0, 3.0][k % 3];
            let origin = [random(), random(), random()].map(|c| c * far);
            let centre = [random(), random(), random()].map(|c| c * far);
            let square = (0.02 * 2000_f64.powf(random().abs())).powi(2).min(4000.0);
            let ball = Ball {
                centre: centre.map(|c| (c * f64::from(1 << 24)) as i32),
                square: (square * 65536.0) as u32,
                up: [0; 3],
            };
            let [centre, origin] = [ball.centre, origin.map(|c| (c * f64::from(1 << 24)) as i32)];
            let way: [f64; 3] =
                core::array::from_fn(|k| f64::from(centre[k] - origin[k]) / f64::from(1 << 24));
            let square = f64::from(ball.square) / 65536.0;
            let excess = dot(way, way) - square;
            if excess <= 0.0 {
                continue;
            }
            // a direction at right angles to the way, then the tangent, then a little off
            let other = [random(), random(), random()];
            let part = dot(other, way) / dot(way, way);
            let across: [f64; 3] = core::array::from_fn(|k| other[k] - part * way[k]);
            let length = dot(across, across).sqrt();
            let tangent = (square / excess).sqrt() * dot(way, way).sqrt() / length;
            let tangent = tangent * (1.0 + random() * 1e-4);
            let d: [f64; 3] = core::array::from_fn(|k| way[k] + tangent * across[k]);
            let scale = [1.0, 0.8, 1.5, 2.4, 3.9][k % 5] / dot(d, d).sqrt();
            let d = d.map(|c| (c * scale * f64::from(1 << 28)) as i32);
            let ray = Ray::from_bits(origin, d).paced();
            assert_ne!(ray.pace, 0, "{d:?}");
            let d = d.map(|c| f64::from(c) / f64::from(1 << 28));
            let along = (dot(way, d) / dot(d, d).sqrt()).max(0.0);
            let distance = dot(way, way) - along * along;
            let is_passed_by = ball.is_passed_by(&ray);
            let off = (distance - square) * 16384.0 / (1.0 + along);
            if distance <= square {
                assert!(!is_passed_by, "{ball:?} {ray:?} {off}");
                grazed += 1;
            } else if off > 1.0 {
                assert!(is_passed_by, "{ball:?} {ray:?} {off}");
                missed += 1;
            } else {
                kept += u32::from(!is_passed_by);
                if is_passed_by {
                    nearest = f64::min(nearest, off);
                }
            }
        }
        assert!(grazed > 20_000 && missed > 3_000 && kept > 3_000, "{grazed} {missed} {kept}");
        assert!(nearest > 0.05 && nearest < 0.5, "{nearest}");
    }

    /// Against distances in double precision: no ray that comes into the ball passes it by, and few that miss
    /// it by more than a thousandth do not.
    #[test]
    fn a_ray_passes_a_ball_by_that_never_comes_into_it() {
        let mut word = words(23);
        let mut real = move |places: u32| Real::from_bits((word() >> 32) as i32 >> places);
        let (mut met, mut missed) = (0, 0);
        for k in 0..20_000 {
            let low = Vec3::new(real(3), real(3), real(3));
            let size = Vec3::new(real(7), real(7), real(7));
            let up = |a: Real, b: Real| a.saturating_add(b.abs());
            let high = Vec3::new(up(low.x, size.x), up(low.y, size.y), up(low.z, size.z));
            let ball = Ball::round(low, high);
            let origin = Vec3::new(real(2), real(2), real(2));
            let aim = Vec3::new(real(8), real(8), real(8));
            let [c, a, o] = [floats(ball.centre()), floats(aim), floats(origin)];
            let d: [f64; 3] = core::array::from_fn(|k| c[k] + a[k] - o[k]);
            let length = d.iter().map(|c| c * c).sum::<f64>().sqrt();
            let scale = [1.0, 1.4, -1.1, 2.5][k % 4] / length;
            let [x, y, z] = d.map(|c| Real::from_num(c * scale));
            let ray = Ray::new(origin, Vec3::new(x, y, z));
            let d = ray.direction();
            let d = [d.x, d.y, d.z].map(|c| c.to_num::<f64>());
            let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
            let w: [f64; 3] = core::array::from_fn(|k| c[k] - o[k]);
            let t = (dot(w, d) / dot(d, d)).clamp(0.0, 128.0);
            let off: [f64; 3] = core::array::from_fn(|k| w[k] - t * d[k]);
            let half = floats(size).map(|c| c.abs() / 2.0);
            let (distance, radius) = (dot(off, off).sqrt(), dot(half, half).sqrt());
            if distance <= radius {
                assert!(!ball.is_passed_by(&ray), "{ball:?} {ray:?}");
                met += 1;
            } else if distance > radius + 2e-3 {
                assert!(ball.is_passed_by(&ray), "{ball:?} {ray:?} {distance} {radius}");
                missed += 1;
            }
        }
        assert!(met > 3_000 && missed > 8_000, "{met} {missed}");
        let (ray, end) = (Ray::new(Vec3::X, Vec3::X), |c| Vec3::new(c, c, c));
        assert!(!Ball::SPACE.is_passed_by(&ray));
        let [least, most] = [Real::MIN, Real::MAX].map(end);
        assert!(!Ball::round(least, most).is_passed_by(&ray) && Ball::round(most, most) == Ball::SPACE);
        // a half-space is passed by on the way up above it, and on the way down below it
        let half = Ball { centre: [0; 3], square: u32::MAX, up: [0, 0, 1 << 30] };
        let passed = |height: i32, rise: i32| {
            let ray = Ray::from_bits([5 << 24, -(7 << 24), height], [1 << 28, 0, rise]);
            half.is_passed_by(&ray)
        };
        let (far, near) = (1 << 24, 1 << 8);
        assert_eq!(
            [passed(far, 9), passed(far, -9), passed(-far, 9), passed(-far, -9)],
            [true, false, false, true]
        );
        assert_eq!([passed(near, 1 << 20), passed(-near, -(1 << 20))], [false; 2]);
    }
}
