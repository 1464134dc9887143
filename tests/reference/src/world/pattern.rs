//! What changes over a surface or in space: a function of the point that is seen.
//!
//! Source: CONTRIBUTING.md, "The picture of a world, defined", Material; course unit V, section 5.8.

use crate::vector::{Vector, along, cross, dot, normalised};
use crate::world::polyhedron::tangents;
use crate::world::shape::Part;
use core::fmt::{Debug, Formatter, Result};

/// A point of a surface that a ray has met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// In the world.
    pub position: Vector,
    /// In the generic coordinates of its shape.
    pub generic: Vector,
    /// The texture coordinates.
    pub uv: [f64; 2],
    /// The outward unit normal, turned against the ray.
    pub normal: Vector,
    /// `P_u`, in the world.
    pub p_u: Vector,
    /// `P_v`, in the world.
    pub p_v: Vector,
    /// The leaf of the world that it belongs to.
    pub leaf: usize,
    /// The part of its shape.
    pub part: Part,
    /// The width of the ray's cone.
    pub width: f64,
}

impl Point {
    /// The unit normal of the surface with the height `b` added along the outward normal:
    /// `N' = N + b_u (n x P_v) + b_v (P_u x n)`, `N = P_u x P_v`, turned as [`Point::normal`] is.
    ///
    /// Where `u` and `v` run round the outward normal to the left, `N` is inward; all of `N'` is then turned.
    /// `outward` says whether [`Point::normal`] is the outward normal.
    ///
    /// Source: course unit V, section 5.8.2 (whose sum is a vector product).
    pub fn bumped(&self, [b_u, b_v]: [f64; 2], outward: bool) -> Vector {
        let n = if outward { self.normal } else { self.normal.map(|c| -c) };
        let product = cross(self.p_u, self.p_v);
        let side = libm::copysign(1.0, dot(product, n));
        let along_u = along([0.0; 3], b_u, cross(n, self.p_v));
        let slopes = along(along_u, b_v, cross(self.p_u, n));
        let bumped = along(product.map(|c| side * c), side, slopes);
        // A pole, where one of the tangents is zero, has no slopes.
        let length = dot(bumped, bumped);
        let unit = if length > 0.0 { normalised(bumped) } else { n };
        if outward { unit } else { unit.map(|c| -c) }
    }

    /// The tangent `T` along `P_u` at right angles to the unit normal `n`, turned about it by `angle`, and
    /// `B = n x T`. At a pole, where `P_u` is zero, any tangent.
    pub fn frame(&self, n: Vector, angle: f64) -> [Vector; 3] {
        let level = along(self.p_u, -dot(self.p_u, n), n);
        let t = if dot(level, level) > 0.0 { normalised(level) } else { tangents(n).0 };
        let b = cross(n, t);
        let (c, s) = (libm::cos(angle), libm::sin(angle));
        let turned = along(t.map(|x| c * x), s, b);
        [n, turned, cross(n, turned)]
    }
}

/// A function of the point, with a value of any kind.
pub struct Pattern<T>(pub Box<dyn Fn(&Point) -> T>);

impl<T> Debug for Pattern<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str("Pattern")
    }
}

impl<T: Copy + 'static> Pattern<T> {
    /// The same everywhere.
    pub fn plain(value: T) -> Self {
        Pattern(Box::new(move |_| value))
    }

    /// The value at a point.
    pub fn at(&self, point: &Point) -> T {
        (self.0)(point)
    }
}

#[cfg(test)]
mod tests {
    use super::Point;
    use crate::vector::{cross, dot, normalised};
    use crate::world::shape::Part;

    fn point(normal: [f64; 3], p_u: [f64; 3], p_v: [f64; 3]) -> Point {
        Point {
            position: [0.0; 3],
            generic: [0.0; 3],
            uv: [0.0; 2],
            normal,
            p_u,
            p_v,
            leaf: 0,
            part: Part::Face(0),
            width: 0.0,
        }
    }

    fn assert_close(a: [f64; 3], b: [f64; 3]) {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15), "{a:?} is not {b:?}");
    }

    #[test]
    fn a_constant_slope_tilts_a_plane_by_that_slope_over_the_length_of_p_u() {
        // With P_u of length 2, a height 0.5 u rises by 1/4 per unit of length: the normal is (-1/4, 0, 1).
        let up = [0.0, 0.0, 1.0];
        let plane = point(up, [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        assert_close(plane.bumped([0.5, 0.0], true), normalised([-0.25, 0.0, 1.0]));
        assert_close(plane.bumped([0.0, 0.5], true), normalised([0.0, -0.5, 1.0]));
        // The other way round, u and v change places; the height is the same.
        let other = point(up, [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]);
        assert_close(other.bumped([0.0, 0.5], true), normalised([-0.25, 0.0, 1.0]));
        // Seen from inside it is the same surface, with its normal turned.
        let inside = point([0.0, 0.0, -1.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
        assert_close(inside.bumped([0.5, 0.0], false), normalised([0.25, 0.0, -1.0]));
    }

    #[test]
    fn the_frame_is_at_right_angles_and_follows_p_u() {
        let n = normalised([0.2, -0.4, 1.0]);
        let p = point(n, [3.0, 0.0, 0.1], [0.0, 1.0, 0.3]);
        let [_, t, b] = p.frame(n, 0.0);
        assert!(dot(t, n).abs() < 1e-15 && dot(t, p.p_u) > 2.0);
        assert_close(b, cross(n, t));
        let [_, turned, _] = p.frame(n, core::f64::consts::FRAC_PI_2);
        assert_close(turned, b);
    }
}
