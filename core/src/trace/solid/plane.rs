//! The half-space `z <= 0`: `F = z`. It is closed and without limits; its plane is the surface.

use core::num::NonZeroU32;
use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::shape::{NearCrossing, NearRay, Shape};
use crate::num::{Near, Real, Vec3, Wide, product, reciprocal_of};

/// The generic half-space: all that is not above the plane `z = 0`. Texture coordinates are `u = x`, `v = y`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Plane;

impl Plane {
    pub(super) const BOUNDS: Option<[Vec3<Near>; 2]> = None;
    pub(super) const ERROR: Near = Near::from_bits(8);
}

impl Shape for Plane {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        Self::BOUNDS
    }

    fn most_crossings(&self) -> u32 {
        1
    }

    fn error(&self) -> Near {
        Self::ERROR
    }

    #[inline]
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let Some(s) = height_over(ray.origin.z.to_bits(), ray.direction.z.to_bits()) else { return };
        if s >= from.to_bits() {
            let _ = found(NearCrossing { s: Near::from_bits(s), enters: ray.direction.z < 0, face: 0 });
        }
    }

    fn value(&self, place: Vec3) -> Wide {
        place.z.into()
    }

    fn normal(&self, _: Vec3<Near>, _: u8) -> Vec3<Near> {
        Vec3::new(Near::ZERO, Near::ZERO, Near::ONE)
    }

    fn chart(&self, place: Vec3<Real>, _: u8) -> Chart {
        Chart { u: place.x, v: place.y, along_u: Vec3::X, along_v: Vec3::Y }
    }
}

/// The parameter at which the ray is at height 0, if it is within ±8; with 28 fractional bits, as both.
#[inline(always)]
pub(super) fn height_over(height: i32, down: i32) -> Option<i32> {
    let size = down.unsigned_abs();
    // the reciprocal's error may not carry it over 8
    if height.unsigned_abs() >> 3 >= size - (size >> 26) {
        return None;
    }
    let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(size)?);
    let quotient = (product(height, mantissa) >> (34 - zeros)) as i32;
    Some(if down < 0 { quotient } else { quotient.wrapping_neg() })
}
