//! Where a shape stands: an affine map from its generic coordinates to those of the world.
//!
//! A ray goes to generic coordinates by the inverse map, its direction not normalised, so that `t` is the
//! same in both. Points and tangents come back by the map, normals by the inverse transpose of its linear
//! part: a normal is what has the product 0 with every tangent.
//!
//! Source: course unit V, section 5.7.

use crate::camera::Ray;
use crate::vector::{Vector, along, cross, dot, normalised};

/// An affine map of space, `p -> linear p + offset`, that can be undone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placing {
    linear: [Vector; 3],
    inverse: [Vector; 3],
    offset: Vector,
}

/// The product of a matrix, given by its rows, and a vector.
fn apply(rows: &[Vector; 3], v: Vector) -> Vector {
    rows.map(|row| dot(row, v))
}

/// The columns of a matrix.
fn transposed(rows: &[Vector; 3]) -> [Vector; 3] {
    [0, 1, 2].map(|k| rows.map(|row| row[k]))
}

impl Placing {
    /// Where the shape was made.
    pub const IDENTITY: Placing = Placing { linear: UNIT, inverse: UNIT, offset: [0.0; 3] };

    /// From the rows of the linear part, and the offset.
    ///
    /// # Panics
    /// When the map cannot be undone.
    pub fn new(linear: [Vector; 3], offset: Vector) -> Placing {
        // The columns of the inverse are the vector products of two rows, over the determinant.
        let determinant = dot(linear[0], cross(linear[1], linear[2]));
        assert!(determinant != 0.0 && determinant.is_finite(), "the matrix {linear:?} is singular");
        let column = |i: usize| cross(linear[(i + 1) % 3], linear[(i + 2) % 3]).map(|c| c / determinant);
        Placing { linear, inverse: transposed(&[0, 1, 2].map(column)), offset }
    }

    /// A shift.
    pub fn translation(by: Vector) -> Placing {
        Placing { offset: by, ..Self::IDENTITY }
    }

    /// Stretched along the axes.
    pub fn scaling(by: Vector) -> Placing {
        Placing::new([[by[0], 0.0, 0.0], [0.0, by[1], 0.0], [0.0, 0.0, by[2]]], [0.0; 3])
    }

    /// A turn about an axis through the origin, counterclockwise seen against the axis (Rodrigues).
    pub fn rotation(axis: Vector, degrees: f64) -> Placing {
        let a = normalised(axis);
        let (c, s) = (libm::cos(degrees.to_radians()), libm::sin(degrees.to_radians()));
        let column =
            |i: usize| along(along(UNIT[i].map(|e| c * e), s, cross(a, UNIT[i])), (1.0 - c) * a[i], a);
        Placing::new(transposed(&[0, 1, 2].map(column)), [0.0; 3])
    }

    /// This map, and then `next`.
    pub fn then(&self, next: &Placing) -> Placing {
        let columns = transposed(&self.linear).map(|column| apply(&next.linear, column));
        Placing::new(transposed(&columns), next.point(self.offset))
    }

    /// A generic point in the world.
    pub fn point(&self, p: Vector) -> Vector {
        along(self.tangent(p), 1.0, self.offset)
    }

    /// A generic tangent in the world.
    pub fn tangent(&self, v: Vector) -> Vector {
        apply(&self.linear, v)
    }

    /// A generic normal in the world, of another length.
    pub fn normal(&self, n: Vector) -> Vector {
        apply(&transposed(&self.inverse), n)
    }

    /// A point of the world in generic coordinates.
    pub fn generic_point(&self, p: Vector) -> Vector {
        apply(&self.inverse, along(p, -1.0, self.offset))
    }

    /// A ray of the world in generic coordinates, with the same `t`.
    pub fn generic_ray(&self, ray: &Ray) -> Ray {
        Ray { origin: self.generic_point(ray.origin), direction: apply(&self.inverse, ray.direction) }
    }
}

const UNIT: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

#[cfg(test)]
mod tests {
    use super::Placing;
    use crate::camera::Ray;
    use crate::vector::{along, cross, dot};

    fn close(a: [f64; 3], b: [f64; 3]) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14)
    }

    /// Stretched, turned and shifted, with a shear.
    fn skew() -> Placing {
        let shear = Placing::new([[1.0, 0.5, 0.0], [0.0, 1.0, -0.25], [0.0, 0.0, 1.0]], [0.0; 3]);
        Placing::scaling([2.0, 0.5, 3.0])
            .then(&shear)
            .then(&Placing::rotation([1.0, 2.0, 3.0], 40.0))
            .then(&Placing::translation([1.0, -2.0, 0.5]))
    }

    #[test]
    fn a_quarter_turn_about_z_takes_x_to_y() {
        let turn = Placing::rotation([0.0, 0.0, 2.0], 90.0);
        assert!(close(turn.point([1.0, 0.0, 5.0]), [0.0, 1.0, 5.0]));
        let both = turn.then(&Placing::translation([1.0, 0.0, 0.0]));
        assert!(close(both.point([1.0, 0.0, 0.0]), [1.0, 1.0, 0.0]));
    }

    #[test]
    fn a_ray_keeps_its_t() {
        let placing = skew();
        let ray = Ray { origin: [3.0, 1.0, -2.0], direction: [-0.3, 0.9, 2.0] };
        let generic = placing.generic_ray(&ray);
        for t in [0.0, 0.7, 11.0] {
            assert!((0..3).all(|k| (placing.point(generic.at(t))[k] - ray.at(t)[k]).abs() < 1e-13));
        }
    }

    #[test]
    fn normals_stay_at_right_angles_to_tangents() {
        let placing = skew();
        let (a, b) = ([1.0, 0.3, -0.2], [0.1, -1.0, 2.0]);
        let normal = placing.normal(cross(a, b));
        assert!(dot(normal, placing.tangent(a)).abs() < 1e-14);
        assert!(dot(normal, placing.tangent(b)).abs() < 1e-14);
        // The normal goes to the side of what was above.
        assert!(dot(normal, placing.tangent(along([0.0; 3], 1.0, cross(a, b)))) > 0.1);
        // As a tangent it would lean.
        assert!(dot(placing.tangent(cross(a, b)), placing.tangent(a)).abs() > 0.1);
    }

    #[test]
    #[should_panic(expected = "singular")]
    fn a_map_into_a_plane_is_refused() {
        Placing::scaling([1.0, 0.0, 1.0]);
    }
}
