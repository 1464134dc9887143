//! Where on the picture a surface's box can be seen: no ray need be cast outside.
//!
//! The outline of a box is made of its edges. In a row of pixels it reaches from the leftmost to the rightmost point of the projected edges within the
//! row, widened by two pixels; a box that reaches behind the eye covers every column.

use core::ops::Range;

use super::Camera;
use crate::num::{quotient, reciprocal};

/// The projected edges of a box, or none where a corner is not in front of the eye.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outline(Option<[Edge; 12]>);

/// An edge from its upper end downwards, in pixels with 16 fractional bits.
#[derive(Debug, Clone, Copy, Default)]
struct Edge {
    top: (i32, i32),
    bottom: (i32, i32),
}

impl Outline {
    /// The outline of the box `extent` (24 fractional bits) on a picture of `cols x rows` pixels.
    pub(super) fn new(extent: [[i32; 2]; 3], camera: &Camera, cols: u32, rows: u32) -> Self {
        let mut corners = [(0, 0); 8];
        for (index, corner) in corners.iter_mut().enumerate() {
            let bit = |k: usize| (index >> k) & 1;
            let Some(projected) =
                project([extent[0][bit(0)], extent[1][bit(1)], extent[2][bit(2)]], camera, cols, rows)
            else {
                return Self(None);
            };
            *corner = projected;
        }
        let mut edges = [Edge::default(); 12];
        // a corner and its neighbours with one more bit set
        let pairs = (0..8_usize)
            .flat_map(|a| [1, 2, 4].into_iter().filter(move |b| a & b == 0).map(move |b| (a, a | b)));
        for (edge, (a, b)) in edges.iter_mut().zip(pairs) {
            if let (Some(a), Some(b)) = (corners.get(a), corners.get(b)) {
                *edge = if a.1 <= b.1 { Edge { top: *a, bottom: *b } } else { Edge { top: *b, bottom: *a } };
            }
        }
        Self(Some(edges))
    }

    /// The columns of row `y` in which the box can be seen.
    pub(super) fn columns(&self, y: u32, cols: u32) -> Range<u32> {
        let Some(edges) = &self.0 else { return 0..cols };
        // the row and two pixels above and below: the samples of a wide filter lie up to that outside their pixel
        let (above, below) = (((y as i32) << 16) - (2 << 16), ((y as i32) << 16) + (3 << 16));
        let (mut left, mut right) = (i32::MAX, i32::MIN);
        for Edge { top, bottom } in edges {
            if top.1 > below || bottom.1 < above {
                continue;
            }
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
    let eye = [camera.eye.x, camera.eye.y, camera.eye.z].map(|c| i64::from(c.to_bits()));
    let along = |axis: &crate::num::Vec3<crate::num::Unit>| {
        let axis = [axis.x, axis.y, axis.z].map(|c| i64::from(c.to_bits()));
        let products = point.iter().zip(eye).zip(axis).map(|((p, e), a)| ((i64::from(*p) - e) * a) >> 30);
        products.sum::<i64>()
    };
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
