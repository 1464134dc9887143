//! A ray `eye + t d`, and when it crosses planes across an axis.

use core::num::NonZeroU32;

use crate::num::formats::{Q24, Q28, Q30};
use crate::num::{
    Near, Real, Unit, Vec3, product, reciprocal, reciprocal_of, reciprocal_sqrt_of, rounded_down, square,
    unit,
};

/// One coordinate of a ray: origin, direction, and the direction's reciprocal.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axis {
    /// 24 fractional bits.
    pub(crate) origin: i32,
    /// 28 fractional bits.
    pub(crate) direction: i32,
    /// `1 / direction` as a signed mantissa of 29 bits and a power of two.
    mantissa: i32,
    zeros: u32,
}

/// `distance / 2^zeros` for a reciprocal's `zeros` below 32 and mantissa less 2 bits: the parameter after
/// that distance, 24 fractional bits.
#[inline(always)]
fn joined(product: i64, zeros: u32) -> i32 {
    // product >> (32 - zeros) by halves: a 64-bit shift by a variable takes twice as long
    let (high, low) = ((product >> 32) as i32, product as u32);
    high << zeros | ((low >> 1) >> (zeros ^ 31)) as i32
}

/// What a ray with a direction of this magnitude (28 fractional bits) takes for each distance (24 fractional
/// bits), 24 fractional bits: the caller knows that these are less than `2^31`.
#[inline(always)]
pub(super) fn parameters<const N: usize>(distances: [i32; N], magnitude: NonZeroU32) -> [i32; N] {
    let (mantissa, zeros) = reciprocal_of(magnitude);
    distances.map(|distance| joined(i64::from(distance) * i64::from(mantissa >> 2), zeros))
}

impl Axis {
    /// A component of 0 counts as `2^-28`: a ray parallel to a plane leans by less than a direction's
    /// resolution, and every plane is crossed.
    pub(super) fn new(origin: i32, direction: i32) -> Self {
        let direction = if direction == 0 { 1 } else { direction };
        let magnitude = NonZeroU32::new(direction.unsigned_abs()).unwrap_or(NonZeroU32::MIN);
        let (mantissa, zeros) = reciprocal_of(magnitude);
        let mantissa = if direction < 0 { -(mantissa >> 2) } else { mantissa >> 2 };
        Self { origin, direction, mantissa, zeros }
    }

    /// The parameter at which the ray crosses the plane at `plane` (24 fractional bits), saturated.
    pub(crate) fn crossing(&self, plane: i32) -> i32 {
        // |plane|, |origin| <= 64: the difference fits 32 bits
        let product = i64::from(plane.wrapping_sub(self.origin)) * i64::from(self.mantissa);
        let high = (product >> 32) as i32;
        let sign = high >> 31;
        if (high >> ((self.zeros & 31) ^ 31)) == sign {
            joined(product, self.zeros & 31)
        } else {
            sign ^ i32::MAX
        }
    }

    /// The coordinate at parameter `t`; the caller knows that it stays inside the scene.
    #[inline]
    pub(crate) fn at(&self, t: i32) -> i32 {
        self.origin.wrapping_add(((i64::from(self.direction) * i64::from(t)) >> 28) as i32)
    }

    /// The part of `[t_in, t_out]` in which the coordinate lies between `low` and `high`; empty if
    /// `t_in > t_out` in the result.
    pub(crate) fn clip(&self, low: i32, high: i32, (t_in, t_out): (i32, i32)) -> (i32, i32) {
        let (near, far) = if self.direction > 0 { (low, high) } else { (high, low) };
        (t_in.max(self.crossing(near)), t_out.min(self.crossing(far)))
    }
}

/// How wide a sample's cone is: `width = (begin + t) * per_t`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Footprint {
    per_t: Unit,
    /// `1 / per_t` as a mantissa and a shift.
    reciprocal: (u32, u32),
    /// How far its tip is behind the ray's start, 24 fractional bits.
    begin: i64,
}

impl Footprint {
    /// A cone that is `per_t` wide at `t` = 1; 0 and less count as `2^-30`.
    pub(crate) fn new(per_t: Unit) -> Self {
        let per_t = per_t.max(Unit::DELTA);
        Self { per_t, reciprocal: reciprocal(per_t.to_bits().unsigned_abs()), begin: 0 }
    }

    /// As wide as this where the ray starts, 24 fractional bits.
    pub(super) fn with_width(self, width: i32) -> Self {
        Self { begin: self.length(width.max(0)), ..self }
    }

    /// The same cone for a ray that starts at `t`.
    pub(super) fn after(self, t: i32) -> Self {
        Self { begin: self.begin.saturating_add(t.into()), ..self }
    }

    /// How far its tip is behind the ray's start.
    pub(super) fn begin(self) -> i64 {
        self.begin
    }

    /// Its width at `t` = 1.
    #[cfg(test)]
    pub(crate) fn per_t(self) -> Unit {
        self.per_t
    }

    /// The width at `t` (24 fractional bits) of one that begins at a point, saturated.
    pub(super) fn width(self, t: i32) -> i32 {
        (product(self.per_t.to_bits(), t) >> 30).clamp(0, i64::from(i32::MAX)) as i32
    }

    /// One of `n` cones side by side.
    pub(crate) fn part(self, n: u32) -> Self {
        Self::new(Unit::from_bits(self.per_t.to_bits().checked_div(n as i32).unwrap_or(0)))
    }

    /// From where on the cone is at least `width` wide (both 24 fractional bits); below 0 where it is so from
    /// the start.
    pub(crate) fn reaches(self, width: i32) -> i64 {
        // neither is below 0
        self.length(width).wrapping_sub(self.begin)
    }

    /// How far from its tip the cone is `width` wide.
    pub(super) fn length(self, width: i32) -> i64 {
        let (mantissa, shift) = self.reciprocal;
        // per_t has 30 fractional bits
        (i64::from(width) * i64::from(mantissa)) >> ((shift - 30) & 63)
    }
}

/// A ray `origin + t d`, `t >= 0`; `d` need not be of unit length.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    pub(super) origin: [Q24; 3],
    pub(super) direction: [Q28; 3],
    /// `1 / |d|^2`, what it takes to find the place that is closest to another; 0 where nobody asked for it,
    /// and where the square is below 9/16.
    pub(super) pace: Q30,
    /// The direction again where there is a pace, with two bits more, less `steep` where that is too long for
    /// a word.
    pub(super) fine: [Q30; 3],
    pub(super) steep: i32,
    /// `1 / |d|` where there is a pace.
    pub(super) slowness: Q30,
    /// How wide its cone is where it starts.
    pub(super) width: Q24,
}

impl Ray {
    /// The ray from `origin` (each coordinate inside ±64, saturated to that) along `direction` (each
    /// component inside ±4, saturated).
    #[inline]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        // a plane at 64 is less than 128 away
        let o = |c: Real| c.to_bits().clamp(1 - (64 << 24), 64 << 24);
        let d = |c: Real| c.to_bits().clamp(-(4 << 24), 4 << 24).saturating_mul(16);
        Self::from_bits([origin.x, origin.y, origin.z].map(o), [direction.x, direction.y, direction.z].map(d))
            .paced()
    }

    /// The ray from a place, less than 64 from the origin along each axis, along a unit direction.
    #[inline]
    pub(super) fn unit(origin: Vec3, direction: Vec3<Unit>) -> Self {
        let direction = [direction.x, direction.y, direction.z].map(|c| c.to_bits() >> 2);
        let fine = direction.map(|c| c << 2);
        Self {
            origin: [origin.x, origin.y, origin.z].map(Real::to_bits),
            direction,
            pace: 1 << 30,
            fine,
            steep: 0,
            slowness: 1 << 30,
            width: 0,
        }
    }

    /// The same ray, as wide as this where it starts; below 0 counts as 0.
    #[inline]
    #[must_use]
    pub fn with_width(self, width: Real) -> Self {
        Self { width: width.to_bits().max(0), ..self }
    }

    /// How wide its cone is at a parameter, if it grows by `cone` for each 1 of `t`; saturated.
    #[inline]
    pub fn width_at(&self, t: Real, cone: Unit) -> Real {
        let grown = product(cone.to_bits(), t.to_bits()) >> 30;
        Real::from_bits((i64::from(self.width) + grown).clamp(0, i64::from(i32::MAX)) as i32)
    }

    /// The same ray for things that are placed.
    #[inline]
    pub(super) fn paced(self) -> Self {
        // 56 fractional bits, below 48
        let length = square(self.direction);
        // a little above 1/2, so that the pace is below 2
        if length < 9 << 52 {
            return self;
        }
        // mantissa / 2^(31 + half), half from 27 to 30
        let (mantissa, half) = reciprocal_sqrt_of(length);
        let slowness = mantissa >> (half.wrapping_sub(27) & 3);
        let pace = rounded_down::<30>(product(slowness, slowness));
        // from a length of 2 on a bit less, from 4 on another: components are below 8
        let steep = if length >> 58 == 0 { 0 } else { 1 + i32::from(length >> 60 > 0) };
        let fine = self.direction.map(|c| c << (2 - steep));
        Self { pace, slowness, fine, steep, ..self }
    }

    /// The unit vector along it.
    #[inline]
    pub(super) fn unit_direction(&self) -> Vec3<Unit> {
        if self.pace == 0 || self.steep != 0 {
            return unit(self.direction);
        }
        let part = |c: Q30| Unit::from_bits(rounded_down::<30>(product(c, self.slowness)));
        let [x, y, z] = self.fine;
        Vec3::new(part(x), part(y), part(z))
    }

    /// Where it starts.
    pub fn origin(&self) -> Vec3 {
        let [x, y, z] = self.origin.map(Real::from_bits);
        Vec3::new(x, y, z)
    }

    /// Where it goes, of any length.
    pub fn direction(&self) -> Vec3<Near> {
        let [x, y, z] = self.direction.map(Near::from_bits);
        Vec3::new(x, y, z)
    }

    /// The place at a parameter, to the nearest, saturated.
    pub fn at(&self, t: Real) -> Vec3 {
        let place = |origin: Q24, direction: Q28| {
            let moved = i64::from(direction) * i64::from(t.to_bits()) + (1 << 27);
            // 27 bits and a sign of the upper word fit
            let high = (moved >> 32) as i32;
            let moved = if high.wrapping_add(1 << 27) as u32 >> 28 > 0 {
                high >> 31 ^ i32::MAX
            } else {
                high << 4 | (moved as u32 >> 28) as i32
            };
            Real::from_bits(origin.saturating_add(moved))
        };
        let ([ox, oy, oz], [dx, dy, dz]) = (self.origin, self.direction);
        Vec3::new(place(ox, dx), place(oy, dy), place(oz, dz))
    }

    /// Origin with 24, direction with 28 fractional bits.
    #[inline(always)]
    pub(crate) fn from_bits(origin: [Q24; 3], direction: [Q28; 3]) -> Self {
        Self { origin, direction, pace: 0, fine: [0; 3], steep: 0, slowness: 0, width: 0 }
    }

    /// Its coordinates along x, y and z, ready for many planes.
    pub(super) fn axes(&self) -> [Axis; 3] {
        let ([x, y], z) = (self.level(), self.upright());
        [x, y, z]
    }

    /// Those along x and y.
    pub(super) fn level(&self) -> [Axis; 2] {
        let ([ox, oy, _], [dx, dy, _]) = (self.origin, self.direction);
        [Axis::new(ox, dx), Axis::new(oy, dy)]
    }

    /// That along z.
    pub(super) fn upright(&self) -> Axis {
        let ([.., oz], [.., dz]) = (self.origin, self.direction);
        Axis::new(oz, dz)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACES: [i32; 9] = [1 - (64 << 24), -(5 << 24), -77_777, -1, 0, 1, 3 << 20, 40_000_001, 64 << 24];
    const DIRECTIONS: [i32; 10] =
        [-(4 << 28) + 1, -(1 << 28), -54_321, -1, 1, 77, 1 << 20, 123_456_789, 1 << 28, 1 << 30];

    /// `(plane - origin) / direction` with 24 fractional bits, against the quotient of integers.
    #[test]
    fn a_crossing_is_the_exact_quotient_or_saturates() {
        let (mut close, mut saturated, mut worst) = (0, 0, 0);
        for origin in PLACES {
            for plane in PLACES {
                for direction in DIRECTIONS {
                    let over = (i128::from(plane) - i128::from(origin)) << 28;
                    let exact = over / i128::from(direction);
                    let got = i128::from(Axis::new(origin, direction).crossing(plane));
                    if exact.abs() < (1 << 31) - 64 {
                        // towards 0 by the reciprocal, 2^-29, and by what 29 bits leave of it, 2^-28; then
                        // down by a unit
                        let (under, sign) = (i128::from(direction).abs(), i128::from(direction.signum()));
                        let off = over * sign - got * under;
                        let by_reciprocal = (3 * over * sign).div_euclid(1 << 29);
                        let (least, most) = (by_reciprocal.min(0), by_reciprocal.max(0) + under);
                        assert!((least..=most).contains(&off), "{origin} {plane} {direction}: {got}");
                        let most_of_it = (off * 100).checked_div(by_reciprocal).unwrap_or(0);
                        if exact.abs() > 1 << 30 {
                            worst = worst.max(most_of_it);
                        }
                        close += 1;
                    } else if exact.abs() > (1 << 31) + 64 {
                        let limit = if exact < 0 { i32::MIN } else { i32::MAX };
                        assert!((got - i128::from(limit)).abs() <= 64, "{origin} {plane} {direction}: {got}");
                        saturated += 1;
                    }
                }
            }
        }
        assert!(close > 300 && saturated > 200 && worst > 25, "{close} {saturated} {worst}");
    }

    #[test]
    fn a_ray_is_clipped_to_the_planes_on_both_sides() {
        for (direction, expected) in [(1 << 28, (1 << 24, 3 << 24)), (-(1 << 28), (-3 << 24, -1 << 24))] {
            let axis = Axis::new(0, direction);
            let (t_in, t_out) = axis.clip(1 << 24, 3 << 24, (i32::MIN, i32::MAX));
            assert!((t_in - expected.0).abs() <= 2 && (t_out - expected.1).abs() <= 2, "{t_in} {t_out}");
            assert_eq!(axis.clip(1 << 24, 3 << 24, (7, 5)).1.min(5), axis.clip(1 << 24, 3 << 24, (7, 5)).1);
            assert!((axis.at(2 << 24) - if direction > 0 { 2 << 24 } else { -2 << 24 }).abs() <= 1);
        }
        // parallel to the planes: it leans by the resolution of a direction
        assert_eq!(Axis::new(0, 0).direction, 1);
    }

    #[test]
    fn a_footprint_reaches_a_width_where_the_cone_has_it() {
        for per_t in [1, 1 << 10, 123_457, 1 << 28, 1 << 30] {
            for width in [1, 777, 1 << 24, i32::MAX] {
                let exact = (i128::from(width) << 30) / i128::from(per_t);
                let got = i128::from(Footprint::new(Unit::from_bits(per_t)).reaches(width));
                assert!((got - exact).abs() <= 1 + (exact >> 28), "{per_t} {width}: {got} against {exact}");
            }
        }
        assert_eq!(Footprint::new(Unit::ZERO), Footprint::new(Unit::DELTA));
        assert_eq!(Footprint::new(Unit::ONE).part(4).per_t(), Unit::ONE / 4);
    }

    /// One that is wide already has a width earlier, by as much as its tip is behind.
    #[test]
    fn a_cone_that_is_wide_where_it_starts_reaches_a_width_earlier() {
        let mut early = 0;
        for per_t in [1 << 10, 123_457, 1 << 28, 1 << 30] {
            for begin in [0, 1, 54_321, 5 << 24, i32::MAX] {
                for t in [0, 777, 3 << 24] {
                    for width in [1, 1 << 20, i32::MAX] {
                        let footprint = Footprint::new(Unit::from_bits(per_t)).with_width(begin).after(t);
                        let exact = ((i128::from(width) - i128::from(begin)) << 30) / i128::from(per_t);
                        let got = i128::from(footprint.reaches(width)) + i128::from(t);
                        let slack =
                            2 + ((i128::from(width) + i128::from(begin)) << 30) / i128::from(per_t >> 28 | 1);
                        assert!((got - exact).abs() <= 2 + (slack >> 28), "{per_t} {begin} {t} {width}");
                        early += u32::from(got < 0);
                    }
                }
            }
        }
        assert!(early > 40, "{early}");
        let ray = Ray::new(Vec3::X, Vec3::Z).with_width(Real::ONE * 3);
        assert_eq!(ray.width_at(Real::ONE * 8, Unit::ONE / 4), 5);
        assert_eq!(ray.width_at(Real::MAX, Unit::ONE), Real::MAX);
        assert_eq!(Ray::new(Vec3::X, Vec3::Z).with_width(-Real::ONE).width_at(Real::ZERO, Unit::ONE), 0);
    }

    #[test]
    fn a_ray_is_saturated_to_its_formats() {
        let far = Vec3::new(Real::MAX, Real::MIN, Real::ONE);
        let ray = Ray::new(far, far);
        assert_eq!(ray.origin, [64 << 24, 1 - (64 << 24), 1 << 24]);
        assert_eq!(ray.direction, [1 << 30, -(1 << 30), 1 << 28]);
    }

    /// What many planes share: the same quotient for each distance, and for a footprint's parts.
    #[test]
    fn parameters_are_within_two_units_and_the_reciprocals_error() {
        let mut worst = 0;
        for magnitude in DIRECTIONS.map(|d| d.unsigned_abs()) {
            for distance in PLACES {
                let exact = (i128::from(distance) << 28).div_euclid(i128::from(magnitude));
                if exact.abs() < 1 << 31 {
                    let [one, other] = parameters([77, distance], NonZeroU32::new(magnitude).unwrap());
                    assert_eq!(one, parameters([77], NonZeroU32::new(magnitude).unwrap())[0]);
                    let off = exact - i128::from(other);
                    worst = worst.max(off.abs() - (exact.abs() >> 28));
                    // towards 0 by the reciprocal, then down
                    assert!(
                        if distance < 0 { off >= -8 } else { off >= 0 },
                        "{distance} / {magnitude}: {off}"
                    );
                }
            }
        }
        assert_eq!(worst, 1);
        for (per_t, n) in [(1 << 28, 3), (77_777, 7), (5, 8), (1 << 30, 1)] {
            let part = Footprint::new(Unit::from_bits(per_t)).part(n);
            assert_eq!(part.per_t().to_bits(), (per_t / n as i32).max(1));
        }
    }

    /// The same for directions at random, where the 29 bits that are left of a reciprocal are wrong by most.
    #[test]
    fn a_crossing_is_off_by_what_the_reciprocals_last_bits_do_not_tell() {
        let mut word = super::super::exact::words(3);
        let (mut worst, mut tried) = (0, 0);
        for k in 0..4000 {
            // directions from 15/16 of a power of 2 to that power, planes where the parameter is near 128
            let direction = (1 << 27) - (word() >> 41) as i32;
            let direction = if k % 2 == 0 { direction } else { -direction };
            let plane = ((i64::from(direction) * 127) >> 4) as i32;
            let over = i128::from(plane) << 28;
            let got = i128::from(Axis::new(0, direction).crossing(plane));
            if !(1..=64 << 24).contains(&plane.abs()) {
                continue;
            }
            // a parameter above 0: late by the reciprocal's 2^-29, early by a unit and three times that
            let (over, under) = (over * i128::from(direction.signum()), i128::from(direction).abs());
            let off = over - got * under;
            let most = under + 3 * over / (1 << 29);
            assert!((-over / (1 << 29)..=most).contains(&off), "{plane} {direction}: {got}");
            worst = worst.max(off * 100 / most);
            tried += 1;
        }
        assert!(tried > 3000 && worst > 50, "{worst} of {tried}");
    }
}
