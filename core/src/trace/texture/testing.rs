//! Points of surfaces for the tests of this room.

use super::super::surface::{Chart, SurfacePoint};
use crate::num::{Real, Unit, Vec3};

/// A point at this place, in units of the format.
pub(crate) fn placed(bits: [i32; 3]) -> SurfacePoint {
    let [x, y, z] = bits.map(Real::from_bits);
    let place = Vec3::new(x, y, z);
    let normal = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE);
    let (chart, width) = (Chart::default(), Real::ZERO);
    SurfacePoint { position: place, place, normal, inward: false, chart, face: 0, width }
}

/// A point of the unit square in the plane, by its texture coordinates.
pub(crate) fn charted(u: Real, v: Real) -> SurfacePoint {
    let chart = Chart { u, v, along_u: Vec3::X, along_v: Vec3::Y };
    SurfacePoint { chart, ..placed([u.to_bits(), v.to_bits(), 0]) }
}
