//! Where on the picture a surface's box can be seen: no ray need be cast outside.
//!
//! The outline of a box is made of its edges. In a row of pixels it reaches from the leftmost to the
//! rightmost point of the projected edges within the row, widened by two pixels; a box that reaches behind
//! the eye covers every column.

use core::ops::Range;

use super::super::camera::Camera;
use crate::num::{Unit, Vec3, quotient, reciprocal};

/// The projected corners of a box, in pixels with 16 fractional bits, or none where one is not in front of
/// the eye. Bit `k` of a corner's index says on which side it lies along axis `k`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Outline(Option<[(i32, i32); 8]>);

/// The edges: a corner and a neighbour with one more bit set.
const EDGES: [(u8, u8); 12] =
    [(0, 1), (0, 2), (0, 4), (1, 3), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 6), (5, 7), (6, 7)];

impl Outline {
    /// The outline of the box `extent` (24 fractional bits) on a picture of `cols x rows` pixels.
    pub(crate) fn new(extent: [[i32; 2]; 3], camera: &Camera, cols: u32, rows: u32) -> Self {
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
    pub(crate) fn columns(&self, y: u32, cols: u32) -> Range<u32> {
        let Some(corners) = &self.0 else { return 0..cols };
        // the row and two pixels above and below: the samples of a wide filter lie up to that outside their
        // pixel
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

/// The pixel coordinates of a point, 16 fractional bits; none if it is not at least `2^-8` in front of the
/// eye or far outside the picture.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Real;

    const COLS: u32 = 97;
    const ROWS: u32 = 61;

    fn camera() -> Camera {
        let at = |x: i32, y: i32, z: i32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
        Camera::new(at(-9, -7, 6), at(1, 1, 0), at(0, 0, 1), Real::from_num(30)).unwrap()
    }

    /// The pixel coordinates of a point by the definition of a picture (CONTRIBUTING.md).
    fn pixel(point: [f64; 3], camera: &Camera) -> (f64, f64) {
        let eye = [camera.eye.x, camera.eye.y, camera.eye.z].map(|c| c.to_num::<f64>());
        let along = |axis: Vec3<Unit>| {
            let axis = [axis.x, axis.y, axis.z].map(|c| c.to_num::<f64>());
            (0..3).map(|i| (point[i] - eye[i]) * axis[i]).sum::<f64>()
        };
        let k = f64::from(camera.tangent) / 2_f64.powi(28) * along(camera.forward);
        let (half_cols, half_rows) = (f64::from(COLS) / 2.0, f64::from(ROWS) / 2.0);
        (half_cols + along(camera.right) / k * half_rows, half_rows - along(camera.up) / k * half_rows)
    }

    /// All samples of a pixel lie within two pixels of its centre: each pixel whose samples may meet the box
    /// is inside, and none that is far off.
    #[test]
    fn an_outline_holds_what_samples_may_meet_and_little_more() {
        let camera = camera();
        let (mut tight, mut inside) = ([0; 4], 0);
        for i in 0..60 {
            let low = [i * 37 % 13 - 5, i * 29 % 11 - 4, i * 17 % 5 - 2].map(|c| (c << 22) + i * 40_961);
            let size = [1 << 14, 1 << (14 + i % 9), 1 << (14 + i % 8)];
            let extent = [0, 1, 2].map(|k| [low[k], low[k] + size[k]]);
            let outline = Outline::new(extent, &camera, COLS, ROWS);
            let corners: std::vec::Vec<_> = (0..8)
                .map(|c| pixel([0, 1, 2].map(|k| f64::from(extent[k][c >> k & 1]) / 2_f64.powi(24)), &camera))
                .collect();
            let hull = |pick: fn(&(f64, f64)) -> f64| {
                let all = corners.iter().map(pick);
                (all.clone().fold(f64::MAX, f64::min), all.fold(f64::MIN, f64::max))
            };
            let (left, right) = hull(|c| c.0);
            let (top, bottom) = hull(|c| c.1);
            for y in 0..ROWS {
                let columns = outline.columns(y, COLS);
                let row = f64::from(y) + 0.5;
                for x in 0..COLS {
                    let column = f64::from(x) + 0.5;
                    let near =
                        corners.iter().any(|c| (c.0 - column).abs() <= 2.0 && (c.1 - row).abs() <= 2.0);
                    assert!(!near || columns.contains(&x), "{x} {y} of {i}: {columns:?} {corners:?}");
                    inside += usize::from(near);
                    if columns.contains(&x) {
                        assert!(column > left - 4.0 && column < right + 4.0, "{x} {y} of {i}");
                        assert!(row > top - 4.0 && row < bottom + 4.0, "{x} {y} of {i}");
                    }
                    // each margin decides somewhere
                    if near {
                        let sides =
                            [left - column > 1.0, column - right > 1.0, top - row > 1.0, row - bottom > 1.0];
                        for (count, side) in tight.iter_mut().zip(sides) {
                            *count += usize::from(side);
                        }
                    }
                }
            }
        }
        assert!(inside > 1000 && tight.iter().all(|n| *n > 100), "{inside} {tight:?}");
    }

    #[test]
    fn a_box_behind_the_eye_is_everywhere() {
        let extent = [[-20 << 24, 0], [-20 << 24, 0], [0, 12 << 24]];
        let outline = Outline::new(extent, &camera(), COLS, ROWS);
        assert!((0..ROWS).all(|y| outline.columns(y, COLS) == (0..COLS)));
    }

    /// A camera at the origin that looks along x, `tangent` with 28 fractional bits.
    fn along_x(tangent: i32) -> Camera {
        let (zero, one) = (Unit::ZERO, Unit::ONE);
        let [forward, right, up] =
            [Vec3::new(one, zero, zero), Vec3::new(zero, -one, zero), Vec3::new(zero, zero, one)];
        Camera { eye: Vec3::new(Real::ZERO, Real::ZERO, Real::ZERO), forward, right, up, tangent }
    }

    /// Against fractions: `offset / (depth k) rows / 2`, to the right of and below the middle, 16 fractional
    /// bits.
    #[test]
    fn a_projection_is_the_quotient_of_offset_and_depth() {
        let (mut worst, mut tried) = (0_i128, 0);
        for tangent in [2_342_571, 1 << 27, 1 << 28, 464_943_848] {
            for depth in [1 << 16, 77_777, 1 << 20, 9_999_999, 1 << 24, 64 << 24] {
                for (y, z) in [(0, 0), (1, -1), (-70_001, 5_001), (9_999_999, -1 << 24), (1 << 18, 123_457)] {
                    for (cols, rows) in [(97, 61), (1, 1), (320, 16_384)] {
                        let under = 2 * i128::from(depth) * i128::from(tangent);
                        let exact = [-y, -z].map(|o| (i128::from(o) << 44) * i128::from(rows) / under);
                        let is_far = exact.iter().any(|e| e.abs() > (1 << 30) - (1 << 16));
                        let Some(got) = project([depth, y, z], &along_x(tangent), cols, rows) else {
                            assert!(is_far, "{tangent} {depth} {y} {z} {cols} {rows}");
                            continue;
                        };
                        let middle = [cols, rows].map(|n| i128::from(n) << 15);
                        for ((got, middle), exact) in [got.0, got.1].into_iter().zip(middle).zip(exact) {
                            // the depth times `k` has 17 bits where it is least
                            let off = (i128::from(got) - middle - exact).abs() - (exact.abs() >> 16);
                            worst = worst.max(off);
                        }
                        tried += 1;
                    }
                }
            }
        }
        assert!(tried > 200 && worst == 1, "{worst} of {tried}");
    }

    /// From `2^-8` in front of the eye on, up to `2^14` pixels from the middle.
    #[test]
    fn what_is_not_in_front_or_far_outside_is_not_projected() {
        let at = |depth: i32, y: i32, z: i32| project([depth, y, z], &along_x(1 << 28), 2, 2).is_some();
        assert!(at(1 << 16, 0, 0) && !at((1 << 16) - 1, 0, 0) && !at(-(1 << 24), 0, 0));
        // with two rows and a depth of 2^-8 an offset is the number of pixels less its last 16 bits
        let most = (1 << 30) - 1;
        for offset in [most, -most] {
            assert!(at(1 << 16, offset, 0) && at(1 << 16, 0, offset));
            assert!(!at(1 << 16, offset + offset.signum(), 0) && !at(1 << 16, 0, offset + offset.signum()));
        }
    }

    /// Against fractions: from the leftmost to the rightmost point of the edges above the row and two rows on
    /// either side, widened by two columns.
    #[test]
    fn columns_reach_as_far_as_the_edges_above_the_rows() {
        let mut word = super::super::super::exact::words(5);
        let (mut decided, mut empty, mut level) = (0, 0, 0);
        for i in 0..2000 {
            let mut corners = [(0, 0); 8];
            for corner in &mut corners {
                // corners on and between the planes of rows, in the picture and far outside
                let [x, y] = [(); 2].map(|()| (word() >> 33) as i32 >> (7 + i % 3) << 1);
                *corner = (x - (1 << 21), (y >> 4) & if i % 2 == 0 { -1 << 16 } else { -1 });
            }
            if i % 5 == 0 {
                corners[1].1 = corners[0].1;
                level += 1;
            }
            for y in [0, 1, 7, 30, 60] {
                let strip = [(y - 2) << 16, (y + 3) << 16].map(i128::from);
                // numerator and denominator of each end of what an edge has in the strip
                let mut ends = std::vec::Vec::new();
                for (a, b) in EDGES {
                    let [a, b] =
                        [a, b].map(|k| corners[usize::from(k)]).map(|(x, y)| (i128::from(x), i128::from(y)));
                    let (top, bottom) = if a.1 <= b.1 { (a, b) } else { (b, a) };
                    let (from, to) = (top.1.max(strip[0]), bottom.1.min(strip[1]));
                    if from > to {
                        continue;
                    }
                    let fall = (bottom.1 - top.1).max(1);
                    let rows = if top.1 == bottom.1 { [0, 1] } else { [from - top.1, to - top.1] };
                    ends.extend(rows.map(|row| (top.0 * fall + row * (bottom.0 - top.0)).div_euclid(fall)));
                }
                let got = Outline(Some(corners)).columns(y as u32, COLS);
                let (Some(left), Some(right)) = (ends.iter().min(), ends.iter().max()) else {
                    assert_eq!(got, 0..0);
                    empty += 1;
                    continue;
                };
                let column = |end: i128, more: i128| ((end >> 16) + more).clamp(0, i128::from(COLS)) as u32;
                let expected = column(*left, -2)..column(*right, 3);
                // within some units of a column's edge either
                let near = |end: i128| (end + 8) & 0xffff <= 16;
                if !near(*left) && !near(*right) {
                    assert_eq!(got, expected, "{y} {corners:?}");
                    decided += 1;
                }
            }
        }
        assert!(decided > 5000 && empty > 20 && level > 300, "{decided} {empty} {level}");
    }

    /// A box seen as a level line: on the last line that counts, and a 65536th of a pixel beyond.
    #[test]
    fn a_level_line_counts_up_to_two_rows_away() {
        let at = |y: i32| {
            // the first corner is the leftmost, the last the rightmost
            let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|k| (((10 + 3 * k) << 16) + 9, y));
            Outline(Some(corners)).columns(20, COLS)
        };
        let (above, below) = (18 << 16, 23 << 16);
        assert_eq!([at(above), at(below)], [8..34, 8..34]);
        assert_eq!([at(above - 1), at(below + 1)], [0..0, 0..0]);
    }
}
