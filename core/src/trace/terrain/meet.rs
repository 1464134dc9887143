//! What both kinds of terrain have in common as surfaces: crossings, points, normals.

use core::ops::ControlFlow;

use super::super::ray::Ray;
use super::super::surface::{Chart, Crossing, Extent, SurfacePoint};
use super::leaf::{Change, Frame, Place};
use super::plot::Rule;
use crate::num::formats::Q24;
use crate::num::{Real, Unit, Vec3, Wide, product, unit};
use crate::terrain::{Form, Patch};

/// How many crossings of a ray are looked for.
pub(super) const CROSSINGS: u32 = 8;

/// The box of a terrain.
pub(super) fn extent(frame: &Frame) -> Extent {
    let [columns, rows] = &frame.rules;
    let ([x_0, x_1], [y_0, y_1], [low, high]) = (columns.ends(), rows.ends(), frame.heights);
    let corner = |x, y, z| Vec3::new(Real::from_bits(x), Real::from_bits(y), Real::from_bits(z));
    Extent { low: corner(x_0, y_0, low), high: corner(x_1, y_1, high) }
}

/// A hundredth of a cell, roughly.
pub(super) fn error(frame: &Frame) -> Real {
    let [columns, rows] = &frame.rules;
    Real::from_bits((columns.width().min(rows.width()) >> 7).max(1 << 4))
}

/// Hands changes of sides over as crossings, so many at most.
#[inline(always)]
pub(super) fn handed(
    found: &mut impl FnMut(Crossing) -> ControlFlow<()>,
) -> impl FnMut(Change) -> ControlFlow<()> {
    let mut left = CROSSINGS;
    move |(t, place, above)| {
        left -= 1;
        // columns and rows are below 2^16, levels below 2^8
        let memo = [place.column << 16 | place.row & 0xffff, place.level];
        found(Crossing { t: Real::from_bits(t), enters: !above, face: 0, memo })?;
        if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// The patch of a leaf and a place on it.
fn local(frame: &Frame, place: Place, position: Vec3, patch: Form) -> (Patch, [Unit; 2]) {
    let [columns, rows] = &frame.rules;
    let along = |rule: &Rule, c: Real, index: u32| {
        Unit::from_bits(rule.inside(c.to_bits(), index << place.level, place.level))
    };
    let s = along(columns, position.x, place.column);
    let t = along(rows, position.y, place.row);
    (Patch(patch), [s, t])
}

/// The height above the surface, outside the rectangle above its rim.
pub(super) fn value(frame: &Frame, at: Vec3, patch: impl Fn(Place) -> Form) -> Wide {
    let [columns, rows] = &frame.rules;
    let (column, row) = (columns.index(at.x.to_bits()), rows.index(at.y.to_bits()));
    let place = Place { level: 0, column, row };
    let (patch, [s, t]) = local(frame, place, at, patch(place));
    Wide::from(at.z) - Wide::from(patch.height(s, t))
}

/// All there is to know of a crossing.
pub(super) fn point(
    frame: &Frame,
    ray: &Ray,
    cone: Unit,
    crossing: &Crossing,
    charted: bool,
    patch: impl Fn(Place) -> Form,
) -> SurfacePoint {
    let position = ray.at(crossing.t);
    let [cell, level] = crossing.memo;
    let place = Place { level, column: cell >> 16, row: cell & 0xffff };
    let [columns, rows] = &frame.rules;
    let (patch, [s, t]) = local(frame, place, position, patch(place));
    let [along_s, along_t] = patch.slopes(s, t).map(Real::to_bits);
    // the sides of the leaf, saturated: below 2^31
    let side = |rule: &Rule| (i64::from(rule.width()) << level).min(i64::from(i32::MAX)) as i32;
    let (a, b) = (side(columns), side(rows));
    let normal = normal([along_s, along_t], [a, b]);
    let chart = if charted { chart(frame, position, [along_s, along_t], [a, b]) } else { Chart::default() };
    let width = ray.width_at(crossing.t, cone);
    SurfacePoint { position, place: position, normal, inward: false, chart, face: 0, width }
}

/// The same on the plain.
pub(super) fn level_point(
    frame: &Frame,
    ray: &Ray,
    cone: Unit,
    crossing: &Crossing,
    charted: bool,
) -> SurfacePoint {
    let position = ray.at(crossing.t);
    let chart = if charted { chart(frame, position, [0; 2], [1; 2]) } else { Chart::default() };
    let width = ray.width_at(crossing.t, cone);
    let normal = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE);
    SurfacePoint { position, place: position, normal, inward: false, chart, face: 1, width }
}

/// The unit normal for these slopes a leaf of these sides: `(-h_s b, -h_t a, a b)`, made 1 long.
fn normal([along_s, along_t]: [Q24; 2], [a, b]: [Q24; 2]) -> Vec3<Unit> {
    let long = [-product(along_s, b), -product(along_t, a), product(a, b)];
    let all = long.iter().fold(0, |all, c| all | c.unsigned_abs());
    // to 30 bits, as far as there are so many
    let places = 34_u32.saturating_sub(all.leading_zeros());
    let more = all.leading_zeros().saturating_sub(34);
    unit(long.map(|c| ((c >> places) << more.min(30)) as i32))
}

/// `u` and `v` go along `x` and `y` from 0 to 1 over the rectangle.
fn chart(frame: &Frame, position: Vec3, slopes: [Q24; 2], sides: [Q24; 2]) -> Chart {
    let one = |axis: usize, c: Real| {
        let rule = frame.rules.get(axis)?;
        let ([from, to], slope, side) = (rule.ends(), *slopes.get(axis)?, *sides.get(axis)?);
        let extent = i64::from(to) - i64::from(from);
        let along = ((i64::from(c.to_bits()) - i64::from(from)) << 24).checked_div(extent)?;
        let rise = (i128::from(slope) * i128::from(extent)).checked_div(i128::from(side))?;
        let rise = rise.clamp(i128::from(i32::MIN), i128::from(i32::MAX)) as i32;
        let extent = extent.min(i64::from(i32::MAX)) as i32;
        Some((along.clamp(0, 1 << 24) as i32, extent, rise))
    };
    let (u, width, rise_u) = one(0, position.x).unwrap_or_default();
    let (v, length, rise_v) = one(1, position.y).unwrap_or_default();
    let [u, width, rise_u, v, length, rise_v] = [u, width, rise_u, v, length, rise_v].map(Real::from_bits);
    Chart {
        u,
        v,
        along_u: Vec3::new(width, Real::ZERO, rise_u),
        along_v: Vec3::new(Real::ZERO, length, rise_v),
    }
}
