//! A ray `eye + t d`, made ready for many intersections with axis-parallel planes.

use crate::num::{Real, Unit, Vec3, reciprocal};

/// One coordinate of a ray: origin, direction, and the direction's reciprocal.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axis {
    /// 24 fractional bits.
    pub(crate) origin: i32,
    /// 28 fractional bits.
    pub(crate) direction: i32,
    /// `1 / direction` as a signed mantissa of 30 bits and a right shift that gives `t` 24 fractional bits.
    mantissa: i32,
    /// From 2 to 31, because a direction's magnitude is from 1 to `2^30`.
    shift: u32,
    /// `32 - shift`.
    rest: u32,
    /// `shift - 1`: bits from there on must be the sign's.
    over: u32,
}

impl Axis {
    /// A component of 0 counts as `2^-28`: a ray parallel to a plane leans by less than a direction's resolution, and every plane is crossed.
    #[inline(always)]
    fn new(origin: i32, direction: i32) -> Self {
        let direction = if direction == 0 { 1 } else { direction };
        let (mantissa, shift) = reciprocal(direction.unsigned_abs());
        let mantissa = (mantissa >> 1) as i32;
        // distance / 2^24 * 2^28 / direction, with 24 fractional bits; the mantissa has lost one
        let shift = shift - 29;
        let mantissa = if direction < 0 { -mantissa } else { mantissa };
        Self { origin, direction, mantissa, shift, rest: 32 - shift, over: shift - 1 }
    }

    /// The parameter at which the ray crosses the plane at `plane` (24 fractional bits), saturated.
    #[inline(always)]
    pub(crate) fn crossing(&self, plane: i32) -> i32 {
        // |plane|, |origin| < 64: the difference fits 32 bits
        let product = i64::from(plane.wrapping_sub(self.origin)) * i64::from(self.mantissa);
        // by halves: a 64-bit shift by a variable takes twice as long
        let (high, low) = ((product >> 32) as i32, product as u32);
        let t = (low >> (self.shift & 31)) | ((high as u32) << (self.rest & 31));
        let sign = high >> 31;
        if (high >> (self.over & 31)) == sign { t as i32 } else { sign ^ i32::MAX }
    }

    /// The coordinate at parameter `t`, saturated by the caller's choice of `t` inside the scene.
    #[inline]
    pub(crate) fn at(&self, t: i32) -> i32 {
        self.origin.wrapping_add(((i64::from(self.direction) * i64::from(t)) >> 28) as i32)
    }

    /// The part of `[t_in, t_out]` in which the coordinate lies between `low` and `high`; empty if `t_in > t_out` in the result.
    #[inline(always)]
    pub(crate) fn clip(&self, low: i32, high: i32, (t_in, t_out): (i32, i32)) -> (i32, i32) {
        let (near, far) = if self.direction > 0 { (low, high) } else { (high, low) };
        (t_in.max(self.crossing(near)), t_out.min(self.crossing(far)))
    }
}

/// How wide a sample's cone is: `width = t * per_t`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Footprint {
    per_t: Unit,
    /// `1 / per_t` as a mantissa and a shift.
    reciprocal: (u32, u32),
}

impl Footprint {
    /// A cone that is `per_t` wide at `t` = 1; 0 and less count as `2^-30`.
    pub(crate) fn new(per_t: Unit) -> Self {
        let per_t = per_t.max(Unit::DELTA);
        Self { per_t, reciprocal: reciprocal(per_t.to_bits().unsigned_abs()) }
    }

    /// Its width at `t` = 1.
    pub(crate) fn per_t(self) -> Unit {
        self.per_t
    }

    /// One of `n` cones side by side.
    pub(crate) fn part(self, n: u32) -> Self {
        Self::new(Unit::from_bits(self.per_t.to_bits().checked_div(n as i32).unwrap_or(0)))
    }

    /// From where on the cone is at least `width` wide (both 24 fractional bits).
    #[inline(always)]
    pub(crate) fn reaches(self, width: i32) -> i64 {
        let (mantissa, shift) = self.reciprocal;
        // per_t has 30 fractional bits
        (i64::from(width) * i64::from(mantissa)) >> ((shift - 30) & 63)
    }
}

/// A ray `origin + t d`, `t >= 0`; `d` need not be of unit length.
#[derive(Debug, Clone, Copy)]
pub struct Ray {
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) z: Axis,
}

impl Ray {
    /// The ray from `origin` (each coordinate inside ±64, saturated to that) along `direction` (each component inside ±4, saturated).
    #[inline]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        // a plane at 64 is less than 128 away
        let o = |c: Real| c.to_bits().clamp(1 - (64 << 24), 64 << 24);
        let d = |c: Real| c.to_bits().clamp(-(4 << 24), 4 << 24).saturating_mul(16);
        Self::from_bits([origin.x, origin.y, origin.z].map(o), [direction.x, direction.y, direction.z].map(d))
    }

    /// Origin with 24, direction with 28 fractional bits.
    #[inline(always)]
    pub(crate) fn from_bits([ox, oy, oz]: [i32; 3], [dx, dy, dz]: [i32; 3]) -> Self {
        Self { x: Axis::new(ox, dx), y: Axis::new(oy, dy), z: Axis::new(oz, dz) }
    }
}
