//! Where on the picture a surface's box can be seen: no ray need be cast outside.
//!
//! The outline of a box is made of its edges. In a row of pixels it reaches from the leftmost to the rightmost point of the projected edges within the
//! row, widened by two pixels; a box that reaches behind the eye covers every column.

use core::ops::Range;

use super::Camera;
use crate::num::{Unit, Vec3, quotient, reciprocal};

/// The projected corners of a box, in pixels with 16 fractional bits, or none where one is not in front of the eye. Bit `k` of a corner's index says on
/// which side it lies along axis `k`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outline(Option<[(i32, i32); 8]>);

/// The edges: a corner and a neighbour with one more bit set.
const EDGES: [(u8, u8); 12] =
    [(0, 1), (0, 2), (0, 4), (1, 3), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 6), (5, 7), (6, 7)];

impl Outline {
    /// The outline of the box `extent` (24 fractional bits) on a picture of `cols x rows` pixels.
    pub(super) fn new(extent: [[i32; 2]; 3], camera: &Camera, cols: u32, rows: u32) -> Self {
        let mut corners = [(0, 0); 8];
        for (index, corner) in corners.iter_mut().enumerate() {
            let mut bits = index;
            let point = extent.map(|[low, high]| {
                let side = if bits & 1 == 0 { low } else { high };
                bits >>= 1;
                side
            });
            let Some(projected) = project(point, camera, cols, rows) else { return Self(None) };
            *corner = projected;
        }
        Self(Some(corners))
    }

    /// The columns of row `y` in which the box can be seen.
    pub(super) fn columns(&self, y: u32, cols: u32) -> Range<u32> {
        let Some(corners) = &self.0 else { return 0..cols };
        // the row and two pixels above and below: the samples of a wide filter lie up to that outside their pixel
        let (above, below) = (((y as i32) << 16) - (2 << 16), ((y as i32) << 16) + (3 << 16));
        let (mut left, mut right) = (i32::MAX, i32::MIN);
        for (a, b) in EDGES {
            // below 8: `get` only spares the proof to the compiler
            let (Some(a), Some(b)) = (corners.get(usize::from(a & 7)), corners.get(usize::from(b & 7)))
            else {
                continue;
            };
            if a.1.min(b.1) > below || a.1.max(b.1) < above {
                continue;
            }
            let (top, bottom) = if a.1 <= b.1 { (a, b) } else { (b, a) };
            let fall = bottom.1.wrapping_sub(top.1) as u32;
            let run = i64::from(bottom.0) - i64::from(top.0);
            let (mantissa, shift) = reciprocal(fall);
            let at = |row: i32| {
                let below = (i64::from(row) - i64::from(top.1)).max(0).min(i64::from(fall));
                // at most 1, with 30 fractional bits
                let part = (below * i64::from(mantissa)) >> ((shift - 30) & 63);
                top.0.wrapping_add(((part * run) >> 30) as i32)
            };
            // an edge along the row has both its ends there
            let ends = if top.1 == bottom.1 { (top.0, bottom.0) } else { (at(above), at(below)) };
            left = left.min(ends.0.min(ends.1));
            right = right.max(ends.0.max(ends.1));
        }
        if left > right {
            return 0..0;
        }
        let start = ((left >> 16).saturating_sub(2)).max(0) as u32;
        let end = ((right >> 16).saturating_add(3)).max(0) as u32;
        start.min(cols)..end.min(cols)
    }
}

/// The pixel coordinates of a point, 16 fractional bits; none if it is not at least `2^-8` in front of the eye or far outside the picture.
fn project(point: [i32; 3], camera: &Camera, cols: u32, rows: u32) -> Option<(i32, i32)> {
    let offsets = [(point[0], camera.eye.x), (point[1], camera.eye.y), (point[2], camera.eye.z)]
        .map(|(p, e)| i64::from(p) - i64::from(e.to_bits()));
    let along = |axis: &Vec3<Unit>| scalar(&offsets, axis);
    let depth = along(&camera.forward);
    if depth < 1 << 16 {
        return None;
    }
    // offset / (depth k) * rows / 2: 24 fractional bits over 52 - 20, with 16
    let reach = (depth * i64::from(camera.tangent)) >> 20;
    let pixels = |offset: i64| {
        // the offset has at most 34 bits, the rows 15; saturated where it is nothing
        let ratio = quotient(offset * i64::from(rows), 23, reach as u64);
        i32::try_from(ratio).ok().filter(|r| r.unsigned_abs() < 1 << 30)
    };
    let x = pixels(along(&camera.right))? + ((cols as i32) << 15);
    let y = ((rows as i32) << 15) - pixels(along(&camera.up))?;
    Some((x, y))
}

/// The scalar product with a direction, in the format of `v`, whose components are below `2^33`.
#[inline(never)]
fn scalar(v: &[i64; 3], axis: &Vec3<Unit>) -> i64 {
    let axis = [axis.x, axis.y, axis.z];
    v.iter().zip(axis).map(|(v, a)| (v * i64::from(a.to_bits())) >> 30).sum()
}
