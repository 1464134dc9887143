//! The picture in front of the eye: the direction of the ray through each of its pixels.
//!
//! Directions are carried along a row by addition, with 32 bits more than a ray uses.

use embedded_graphics_core::geometry::Size;

use super::camera::Camera;
use crate::Error;
use crate::num::{Unit, Vec3, Wide, nth};

/// Half a unit of a ray's direction, 60 fractional bits.
const HALF: i64 = 1 << 31;

/// Directions through pixels: that through the centre of the top left one, with half a unit of what a ray
/// uses; steps to the right and downwards; 60 fractional bits.
#[derive(Debug, Clone, Copy)]
pub(super) struct Screen {
    corner: [i64; 3],
    right: [i64; 3],
    down: [i64; 3],
    /// Width of a pixel's cone a unit of `t`.
    pub(super) footprint: Unit,
}

impl Screen {
    /// The screen of `size` pixels before a camera, with `margin` pixels round it.
    pub(super) fn new(camera: &Camera, size: Size, margin: i64) -> Result<Self, Error> {
        let (cols, rows) = (i64::from(size.width), i64::from(size.height));
        in_reach(camera, cols, rows, margin)?;
        // one pixel: 2 k / rows, with 28 + 30 + 2 = 60 fractional bits for a direction cosine of 30
        let step =
            |cosine: Unit| nth((i64::from(camera.tangent) * i64::from(cosine.to_bits())) << 3, size.height);
        let components = |v: Vec3<Unit>| [v.x, v.y, v.z];
        let right = components(camera.right).map(step);
        let down = components(camera.up).map(|c| -step(c));
        let mut corner = components(camera.forward).map(|c| (i64::from(c.to_bits()) << 30) + HALF);
        for ((c, r), d) in corner.iter_mut().zip(right).zip(down) {
            *c -= (r * (cols - 1) + d * (rows - 1)) / 2;
        }
        // 2 k / rows with 30 fractional bits
        let footprint = nth(i64::from(camera.tangent) << 3, size.height).min(i64::from(i32::MAX));
        Ok(Self { corner, right, down, footprint: Unit::from_bits(footprint as i32) })
    }

    /// From a pixel to the next, to the right and downwards, 28 fractional bits.
    pub(super) fn edges(&self) -> [[i32; 3]; 2] {
        [self.right, self.down].map(|edge| edge.map(narrow))
    }

    /// The direction through the centre of pixel `(x, y)`, 60 fractional bits.
    pub(super) fn direction(&self, x: u32, y: u32) -> [i64; 3] {
        let mut direction = self.corner;
        for ((c, r), d) in direction.iter_mut().zip(self.right).zip(self.down) {
            *c += r * i64::from(x) + d * i64::from(y);
        }
        direction
    }

    /// The direction `n` pixels to the right.
    #[inline]
    pub(super) fn stepped(&self, mut direction: [i64; 3], n: u32) -> [i64; 3] {
        for (c, r) in direction.iter_mut().zip(self.right) {
            *c += r * i64::from(n);
        }
        direction
    }

    /// The direction moved by an offset in pixels (24 fractional bits), 28 fractional bits.
    #[inline]
    pub(super) fn offset(&self, mut direction: [i64; 3], dx: i32, dy: i32) -> [i32; 3] {
        if (dx, dy) != (0, 0) {
            for ((c, r), d) in direction.iter_mut().zip(self.right).zip(self.down) {
                // a step has at most 62 bits, an offset is at most 2 pixels
                *c = c.wrapping_add((r >> 24) * i64::from(dx)).wrapping_add((d >> 24) * i64::from(dy));
            }
        }
        direction.map(narrow)
    }
}

/// A direction as a ray has it, 28 fractional bits.
#[inline]
pub(super) fn narrow(direction: i64) -> i32 {
    (direction >> 32) as i32
}

/// Checks that directions stay inside ±4 on a picture with `margin` pixels around it:
/// `|w| + k (cols / rows |r| + |u|) < 4`.
pub(super) fn in_reach(camera: &Camera, cols: i64, rows: i64, margin: i64) -> Result<(), Error> {
    let sides = cols + rows + 4 * margin;
    // a picture has 65,535 rows at most
    let reach = nth(i64::from(camera.tangent) * sides, rows as u32);
    if reach >= 3 << 28 {
        return Err(Error::OutOfRange {
            what: "tangent of half the view, width plus height",
            index: None,
            value: Wide::from_bits(reach.saturating_mul(1 << 20)),
            min: Wide::ZERO,
            max: Wide::from_num(3),
        });
    }
    Ok(())
}
