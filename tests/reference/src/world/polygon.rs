//! A plane convex polygon, open; its upper side is the one from which its corners go round to the left.
//! `F` is the height above its plane.
//!
//! Texture: coordinates in the plane's frame, whose origin is the first corner, `u` along the first edge and
//! `v` along `n x u`.
//!
//! Source: course unit V, section 5.7, 1 and 5.8; Cochran, Lewis and Hart, "The Normal of a Fractal Surface",
//! section 5 (polygons beside fractal surfaces).

use crate::camera::Ray;
use crate::vector::{Vector, along, cross, dot, normalised};
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape};

/// A polygon.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    /// Its corners, three at least, in one plane, in the order of its edges.
    pub corners: Vec<Vector>,
}

impl Polygon {
    /// The edges, as corner and difference.
    fn edges(&self) -> impl Iterator<Item = (Vector, Vector)> + '_ {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).map(|(&a, &b)| (a, along(b, -1.0, a)))
    }

    /// The unit normal: the sum of all corners' vector products, as of any plane polygon (Newell).
    fn normal(&self) -> Vector {
        let add = |sum: Vector, (a, edge): (Vector, Vector)| along(sum, 1.0, cross(a, edge));
        normalised(self.edges().fold([0.0; 3], add))
    }
}

impl Shape for Polygon {
    fn crossings(&self, ray: &Ray, _: Cone) -> Vec<Crossing> {
        let n = self.normal();
        let slope = dot(n, ray.direction);
        if slope == 0.0 {
            return Vec::new();
        }
        let t = -self.value(ray.origin) / slope;
        let p = ray.at(t);
        let left = |(a, edge): (Vector, Vector)| dot(cross(edge, along(p, -1.0, a)), n) >= 0.0;
        if !self.edges().all(left) {
            return Vec::new();
        }
        vec![Crossing { t, part: Part::Face(0), enters: slope < 0.0 }]
    }

    fn value(&self, p: Vector) -> f64 {
        dot(self.normal(), along(p, -1.0, self.corners[0]))
    }

    fn frame(&self, p: Vector, _: Part) -> Frame {
        let normal = self.normal();
        let p_u = normalised(along(self.corners[1], -1.0, self.corners[0]));
        let p_v = cross(normal, p_u);
        let from = along(p, -1.0, self.corners[0]);
        Frame { normal, uv: [dot(from, p_u), dot(from, p_v)], p_u, p_v }
    }

    fn is_open(&self) -> bool {
        true
    }
}
