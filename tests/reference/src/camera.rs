//! The camera: from a sample in a picture to a ray in space.
//!
//! Source: CONTRIBUTING.md, "The picture of a height field, defined", Camera; Cochran, Lewis and Hart, "The
//! Normal of a Fractal Surface", section 4, eq. 46.

use crate::vector::{Vector, along, cross, normalised};

/// A ray `origin + t direction`, `t >= 0` (Cochran et al., eq. 46).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where the ray starts.
    pub origin: Vector,
    /// Its direction, not of unit length: `t` is the depth along the camera's axis.
    pub direction: Vector,
}

impl Ray {
    /// The point at depth `t`.
    pub fn at(&self, t: f64) -> Vector {
        along(self.origin, t, self.direction)
    }
}

/// A pinhole camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The pinhole.
    pub eye: Vector,
    /// The point in the middle of the picture.
    pub look_at: Vector,
    /// Any direction that points up in the picture.
    pub up: Vector,
    /// The vertical angle of view, in radians, inside (0, pi).
    pub field_of_view: f64,
}

impl Camera {
    /// The ray of the sample at offset `(dx, dy)` from the centre of pixel `(i, j)` (column, row from the
    /// top).
    ///
    /// # Panics
    /// When the eye looks at itself or straight along `up`.
    pub fn ray(&self, cols: usize, rows: usize, (i, j): (usize, usize), (dx, dy): (f64, f64)) -> Ray {
        let w = normalised(along(self.look_at, -1.0, self.eye));
        let r = normalised(cross(w, self.up));
        let u = cross(r, w);
        let k = self.half_height();
        let right = (2.0 * (i as f64 + 0.5 + dx) - cols as f64) / rows as f64 * k;
        let upwards = (rows as f64 - 2.0 * (j as f64 + 0.5 + dy)) / rows as f64 * k;
        Ray { origin: self.eye, direction: along(along(w, right, r), upwards, u) }
    }

    /// The footprint at depth 1 of one of `samples_per_axis` squared samples of a pixel:
    /// `2 k / rows / samples_per_axis`.
    pub fn footprint(&self, rows: usize, samples_per_axis: usize) -> f64 {
        2.0 * self.half_height() / rows as f64 / samples_per_axis as f64
    }

    /// `k`, half the height of the picture at depth 1.
    fn half_height(&self) -> f64 {
        libm::tan(self.field_of_view / 2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::Camera;
    use core::f64::consts::FRAC_PI_2;

    /// From the south, towards the north, with x to the right.
    const CAMERA: Camera = Camera {
        eye: [0.0, -2.0, 1.0],
        look_at: [0.0, 3.0, 1.0],
        up: [0.0, 0.0, 1.0],
        field_of_view: FRAC_PI_2,
    };

    fn assert_close(a: [f64; 3], b: [f64; 3]) {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15), "{a:?} is not {b:?}");
    }

    #[test]
    fn the_middle_of_the_picture_is_the_point_looked_at() {
        let ray = CAMERA.ray(4, 2, (1, 0), (0.5, 0.5));
        assert_close(ray.direction, [0.0, 1.0, 0.0]);
        assert_close(ray.at(5.0), CAMERA.look_at);
    }

    #[test]
    fn columns_run_to_the_right_and_rows_downwards() {
        // With 90 degrees, the top of the picture is at a slope of 1 and the side at the aspect ratio.
        assert_close(CAMERA.ray(4, 2, (0, 0), (-0.5, -0.5)).direction, [-2.0, 1.0, 1.0]);
        assert_close(CAMERA.ray(4, 2, (3, 1), (0.5, 0.5)).direction, [2.0, 1.0, -1.0]);
        assert_close(CAMERA.ray(4, 2, (3, 1), (0.0, 0.0)).direction, [1.5, 1.0, -0.5]);
    }

    #[test]
    fn the_footprint_is_the_distance_between_neighbouring_rays() {
        let (a, b) = (CAMERA.ray(64, 48, (10, 7), (0.0, 0.0)), CAMERA.ray(64, 48, (10, 8), (0.0, 0.0)));
        assert!((a.at(3.0)[2] - b.at(3.0)[2] - 3.0 * CAMERA.footprint(48, 1)).abs() < 1e-14);
        assert_eq!(CAMERA.footprint(48, 4), CAMERA.footprint(48, 1) / 4.0);
    }
}
