//! The camera of both rivals.

use super::vector::{Vector, unit};
use crate::float::Float;

/// A square picture's rays: those of `crate::surface::mirror`.
pub(crate) struct Camera<F> {
    pub(crate) eye: Vector<F>,
    /// Direction through the centre of the top left pixel, and from a pixel to the next.
    corner: Vector<F>,
    right: Vector<F>,
    down: Vector<F>,
    /// Width of a pixel at distance 1.
    pub(super) footprint: F,
}

impl<F: Float> Camera<F> {
    /// From (-4, -3, 5) to (1, 1, 0), 25 degrees. Set-up in double precision: it is not what is measured.
    pub(crate) fn new(side: u32) -> Self {
        let (eye, look_at) = ([-4.0, -3.0, 5.0], [1.0, 1.0, 0.0]);
        let cross = |[a, b, c]: [f64; 3], [x, y, z]: [f64; 3]| [b * z - c * y, c * x - a * z, a * y - b * x];
        let forward = unit([0, 1, 2].map(|i: usize| look_at[i] - eye[i]));
        let right = unit(cross(forward, [0.0, 0.0, 1.0]));
        let up = cross(right, forward);
        let pixel = 2.0 * libm::tan(12.5_f64.to_radians()) / f64::from(side);
        let half = f64::from(side - 1) / 2.0;
        let corner = [0, 1, 2].map(|i: usize| forward[i] + pixel * half * (up[i] - right[i]));
        Self {
            eye: eye.map(F::of),
            corner: corner.map(F::of),
            right: right.map(|c| F::of(c * pixel)),
            down: up.map(|c| F::of(-c * pixel)),
            footprint: F::of(pixel),
        }
    }

    /// The direction through the centre of a pixel.
    #[inline(always)]
    pub(crate) fn direction(&self, x: u32, y: u32) -> Vector<F> {
        let (x, y) = (F::of_int(x as i32), F::of_int(y as i32));
        [0, 1, 2].map(|i: usize| x.fused(self.right[i], y.fused(self.down[i], self.corner[i])))
    }
}
