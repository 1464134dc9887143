//! A ray `eye + t d`, made ready for many intersections with axis-parallel planes.

use crate::num::{Real, Vec3, reciprocal};

/// One coordinate of a ray: origin, direction, and the direction's reciprocal.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axis {
    /// 24 fractional bits.
    pub(crate) origin: i32,
    /// 28 fractional bits.
    pub(crate) direction: i32,
    /// `1 / direction` as a signed mantissa of 30 bits and a right shift that gives `t` 24 fractional bits.
    mantissa: i32,
    shift: u32,
}

impl Axis {
    #[inline]
    fn new(origin: i32, direction: i32) -> Self {
        let (mantissa, shift) = reciprocal(direction.unsigned_abs());
        let mantissa = (mantissa >> 1) as i32;
        Self {
            origin,
            direction,
            mantissa: if direction < 0 { -mantissa } else { mantissa },
            // distance / 2^24 * 2^28 / direction, with 24 fractional bits; the mantissa has lost one
            shift: shift - 29,
        }
    }

    /// The parameter at which the ray crosses the plane at `plane` (24 fractional bits), saturated. Not for `direction` = 0.
    #[inline]
    pub(crate) fn crossing(&self, plane: i32) -> i32 {
        // |plane|, |origin| < 64: the difference fits 32 bits
        let product = i64::from(plane.wrapping_sub(self.origin)) * i64::from(self.mantissa);
        let t = product >> (self.shift & 63);
        let narrow = t as i32;
        if i64::from(narrow) == t { narrow } else { ((t >> 63) as i32) ^ i32::MAX }
    }

    /// The coordinate at parameter `t`, saturated by the caller's choice of `t` inside the scene.
    #[inline]
    pub(crate) fn at(&self, t: i32) -> i32 {
        self.origin.wrapping_add(((i64::from(self.direction) * i64::from(t)) >> 28) as i32)
    }

    /// The part of `[t_in, t_out]` in which the coordinate lies between `low` and `high`; empty if `t_in > t_out` in the result.
    #[inline]
    pub(crate) fn clip(&self, low: i32, high: i32, (t_in, t_out): (i32, i32)) -> (i32, i32) {
        if self.direction == 0 {
            // parallel: all or nothing
            return if low <= self.origin && self.origin <= high { (t_in, t_out) } else { (1, 0) };
        }
        let (near, far) = if self.direction > 0 { (low, high) } else { (high, low) };
        (t_in.max(self.crossing(near)), t_out.min(self.crossing(far)))
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
        let o = |c: Real| c.to_bits().clamp(-(64 << 24), 64 << 24);
        let d = |c: Real| c.to_bits().clamp(-(4 << 24), 4 << 24).saturating_mul(16);
        Self::from_bits([origin.x, origin.y, origin.z].map(o), [direction.x, direction.y, direction.z].map(d))
    }

    /// Origin with 24, direction with 28 fractional bits.
    #[inline]
    pub(crate) fn from_bits([ox, oy, oz]: [i32; 3], [dx, dy, dz]: [i32; 3]) -> Self {
        Self { x: Axis::new(ox, dx), y: Axis::new(oy, dy), z: Axis::new(oz, dz) }
    }
}
