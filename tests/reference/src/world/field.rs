//! The height field `h(x, y) = f(x) g(y)` as a shape among others, open, its upper side towards +z:
//! `F = z - h(x, y)`.
//!
//! Its crossings are the leaves that the ray meets, front to back, each at the middle of its interval of `t`,
//! with the mean normal over the leaf: the ray goes down through a leaf where `n . d < 0` and up elsewhere. A
//! node is a leaf on the finest level, and where it is not wider than the ray's cone where the ray enters.
//! Where it leaves the leaf's column or row the ray begins anew; what it meets right there is part of the
//! same crossing.
//!
//! Texture: `u` and `v` over the domain, in `[0, 1]`.
//!
//! Source: Cochran, Lewis and Hart, "The Normal of a Fractal Surface", section 4, Algorithm 3 and figure 5;
//! CONTRIBUTING.md, "The picture of a height field, defined", Hit and Normal.

use crate::bounds::Bounds;
use crate::camera::Ray;
use crate::fif::Fif;
use crate::height_field::{clip, product};
use crate::vector::{Vector, dot};
use crate::world::shape::{Cone, Crossing, Frame, Part, Shape};

/// A height field, over the domains of its two profiles.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightField {
    /// The profile `f`.
    pub f: Fif,
    /// The profile `g`.
    pub g: Fif,
    /// The cells of `f`.
    pub x: Bounds,
    /// The cells of `g`.
    pub y: Bounds,
}

/// What begins so soon behind a leaf is right behind it.
const RIGHT_BEHIND: f64 = 1e-6;

/// A leaf that a ray meets: the middle of the ray's part inside its box, and that above the leaf.
struct Leaf {
    t: f64,
    above: (f64, f64),
    part: Part,
}

impl HeightField {
    /// The height field of two profiles, with pyramids of the given depth.
    pub fn new(f: Fif, g: Fif, depth: usize) -> HeightField {
        let (x, y) = (Bounds::new(&f, depth), Bounds::new(&g, depth));
        HeightField { f, g, x, y }
    }

    /// The mean normal over a leaf, upwards.
    fn normal(&self, level: usize, i: usize, j: usize) -> Vector {
        let (f, g) = (self.x.levels[level][i], self.y.levels[level][j]);
        [-f.slope * g.mean, -f.mean * g.slope, 1.0]
    }

    /// The first leaf in the node `(i, j)` of a level that the ray meets from `from` on.
    fn leaf(&self, ray: &Ray, cone: Cone, from: f64, (level, i, j): (usize, usize, usize)) -> Option<Leaf> {
        let (f, g) = (self.x.levels[level][i], self.y.levels[level][j]);
        let [columns, rows] = [(f.x0, f.x1), (g.x0, g.x1)];
        let heights = product((f.min, f.max), (g.min, g.max));
        let (t_in, t_out) = clip(ray, [columns, rows, heights])?;
        let t_in = t_in.max(from);
        if t_in > t_out {
            return None;
        }
        let depth = self.x.depth().min(self.y.depth());
        if level == depth || (f.x1 - f.x0).max(g.x1 - g.x0) <= cone.at(t_in) {
            let above = clip(ray, [columns, rows, (f64::NEG_INFINITY, f64::INFINITY)])?;
            return Some(Leaf { t: (t_in + t_out) / 2.0, above, part: Part::Cell { level, i, j } });
        }
        let order = |direction: f64, n: usize| move |k: usize| if direction < 0.0 { n - 1 - k } else { k };
        let (n, m) = (self.x.maps, self.y.maps);
        let (order_i, order_j) = (order(ray.direction[0], n), order(ray.direction[1], m));
        let parts = (0..n).flat_map(|a| (0..m).map(move |b| (a, b)));
        parts
            .map(|(a, b)| (level + 1, i * n + order_i(a), j * m + order_j(b)))
            .find_map(|node| self.leaf(ray, cone, from, node))
    }

    /// The domain of a profile.
    fn domain(bounds: &Bounds) -> (f64, f64) {
        (bounds.levels[0][0].x0, bounds.levels[0][0].x1)
    }
}

impl Shape for HeightField {
    fn crossings(&self, ray: &Ray, cone: Cone) -> Vec<Crossing> {
        let (mut found, mut from) = (Vec::new(), 0.0);
        while let Some(Leaf { t, above, part }) = self.leaf(ray, cone, from, (0, 0, 0)) {
            let Part::Cell { level, i, j } = part else { break };
            if found.is_empty() || above.0 > from + RIGHT_BEHIND {
                let enters = dot(self.normal(level, i, j), ray.direction) < 0.0;
                found.push(Crossing { t, part, enters });
            }
            // A leaf that is only touched ends where it begins.
            from = if above.1 > from { above.1 } else { from + RIGHT_BEHIND };
        }
        found
    }

    fn value(&self, p: Vector) -> f64 {
        let inside = |c: f64, (low, high): (f64, f64)| c.clamp(low, high);
        let x = inside(p[0], Self::domain(&self.x));
        let y = inside(p[1], Self::domain(&self.y));
        p[2] - self.f.at(x) * self.g.at(y)
    }

    /// # Panics
    /// When the part is no cell.
    fn frame(&self, p: Vector, part: Part) -> Frame {
        let Part::Cell { level, i, j } = part else { panic!("a height field has cells, no faces") };
        let normal = self.normal(level, i, j);
        let ((x0, x1), (y0, y1)) = (Self::domain(&self.x), Self::domain(&self.y));
        let (w, h) = (x1 - x0, y1 - y0);
        Frame {
            normal,
            uv: [(p[0] - x0) / w, (p[1] - y0) / h],
            p_u: [w, 0.0, -normal[0] * w],
            p_v: [0.0, h, -normal[1] * h],
        }
    }

    fn is_open(&self) -> bool {
        true
    }
}
