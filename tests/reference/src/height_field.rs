//! Where a ray meets the height field `h(x, y) = f(x) g(y)`: depth first through boxes that shrink towards
//! the surface.
//!
//! Source: Cochran, Lewis and Hart, "The Normal of a Fractal Surface", section 4, eq. 46-51, figure 5 and
//! Algorithm 3; CONTRIBUTING.md, "The picture of a height field, defined", Hit and Normal. A ray that starts
//! inside a box has `t_0 < 0 < t_1` and is handled as if it entered at 0.

use crate::bounds::Bounds;
use crate::camera::Ray;
use crate::vector::{Vector, dot};

/// The leaf that a ray meets first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The level of the leaf in both pyramids.
    pub level: usize,
    /// The cell of `f` on that level.
    pub i: usize,
    /// The cell of `g` on that level.
    pub j: usize,
    /// The middle of the interval of `t >= 0` inside of the leaf's box.
    pub t: f64,
}

/// The answer for one ray, and what it cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trace {
    /// The leaf, or nothing when the ray misses.
    pub hit: Option<Hit>,
    /// The number of boxes that the ray was tested against, the root included.
    pub box_tests: usize,
}

/// Follows `ray` to the first leaf of the height field with the profiles `x` and `y`.
///
/// A node is a leaf on the finest level that both pyramids have, and where it is not wider than
/// `t_in footprint`.
pub fn trace(x: &Bounds, y: &Bounds, ray: &Ray, footprint: f64) -> Trace {
    let mut search = Search { x, y, ray, footprint, depth: x.depth().min(y.depth()), box_tests: 0 };
    let hit = search.node(0, 0, 0);
    Trace { hit, box_tests: search.box_tests }
}

/// The mean normal over the leaf of a hit, `(-slope_i mean_j, -mean_i slope_j, 1)`, turned round to face the
/// ray.
pub fn leaf_normal(x: &Bounds, y: &Bounds, ray: &Ray, hit: &Hit) -> Vector {
    let (f, g) = (x.levels[hit.level][hit.i], y.levels[hit.level][hit.j]);
    let n = [-f.slope * g.mean, -f.mean * g.slope, 1.0];
    if dot(n, ray.direction) > 0.0 { n.map(|coordinate| -coordinate) } else { n }
}

struct Search<'a> {
    x: &'a Bounds,
    y: &'a Bounds,
    ray: &'a Ray,
    footprint: f64,
    depth: usize,
    box_tests: usize,
}

impl Search<'_> {
    /// Algorithm 3 at the node `(i, j)` of a level.
    fn node(&mut self, level: usize, i: usize, j: usize) -> Option<Hit> {
        let (f, g) = (self.x.levels[level][i], self.y.levels[level][j]);
        self.box_tests += 1;
        let (t_in, t_out) =
            clip(self.ray, [(f.x0, f.x1), (g.x0, g.x1), product((f.min, f.max), (g.min, g.max))])?;
        let width = (f.x1 - f.x0).max(g.x1 - g.x0);
        if level == self.depth || width <= t_in * self.footprint {
            return Some(Hit { level, i, j, t: (t_in + t_out) / 2.0 });
        }
        // Figure 5: along each axis, children in the order in which the ray meets them.
        let order = |direction: f64, n: usize| move |k: usize| if direction < 0.0 { n - 1 - k } else { k };
        let (n, m) = (self.x.maps, self.y.maps);
        let (order_i, order_j) = (order(self.ray.direction[0], n), order(self.ray.direction[1], m));
        for a in 0..n {
            for b in 0..m {
                let hit = self.node(level + 1, i * n + order_i(a), j * m + order_j(b));
                if hit.is_some() {
                    return hit;
                }
            }
        }
        None
    }
}

/// The range of the product of two ranges (eq. 49).
pub(crate) fn product(f: (f64, f64), g: (f64, f64)) -> (f64, f64) {
    let s = [f.0 * g.0, f.0 * g.1, f.1 * g.0, f.1 * g.1];
    (s.into_iter().fold(f64::INFINITY, f64::min), s.into_iter().fold(f64::NEG_INFINITY, f64::max))
}

/// The interval of `t >= 0` for which the ray is inside of the closed box, if there is any (eq. 50-51).
pub(crate) fn clip(ray: &Ray, slabs: [(f64, f64); 3]) -> Option<(f64, f64)> {
    let (mut t_in, mut t_out) = (0.0_f64, f64::INFINITY);
    for (axis, (low, high)) in slabs.into_iter().enumerate() {
        let (origin, direction) = (ray.origin[axis], ray.direction[axis]);
        if direction == 0.0 {
            if origin < low || origin > high {
                return None;
            }
        } else {
            let (a, b) = ((low - origin) / direction, (high - origin) / direction);
            t_in = t_in.max(a.min(b));
            t_out = t_out.min(a.max(b));
        }
    }
    (t_in <= t_out).then_some((t_in, t_out))
}

#[cfg(test)]
mod tests {
    use super::{Hit, clip, leaf_normal, product, trace};
    use crate::bounds::Bounds;
    use crate::camera::Ray;
    use crate::fif::{Fif, Map};

    const KNOTS: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];

    fn rough() -> Fif {
        Fif::interpolating(&KNOTS, &[0.85, -0.85]).integral(0.0)
    }

    #[test]
    fn a_ray_from_inside_enters_at_zero_and_a_parallel_one_depends_on_its_origin() {
        let unit = [(0.0, 1.0); 3];
        let ray = |origin, direction| Ray { origin, direction };
        assert_eq!(clip(&ray([0.5; 3], [1.0, 0.0, 0.0]), unit), Some((0.0, 0.5)));
        assert_eq!(clip(&ray([2.0, 0.5, 0.5], [-0.5, 0.0, 0.0]), unit), Some((2.0, 4.0)));
        assert_eq!(clip(&ray([2.0, 1.5, 0.5], [-0.5, 0.0, 0.0]), unit), None);
        assert_eq!(clip(&ray([2.0, 0.5, 0.5], [0.5, 0.0, 0.0]), unit), None);
        assert_eq!(product((-1.0, 2.0), (-3.0, 1.0)), (-6.0, 3.0));
    }

    #[test]
    fn a_vertical_ray_finds_the_height() {
        let f = rough();
        let bounds = Bounds::new(&f, 12);
        for (x, y) in [(0.3, 0.7), (1.9, 0.01), (1.3, 1.7)] {
            let ray = Ray { origin: [x, y, 5.0], direction: [0.0, 0.0, -1.0] };
            let hit = trace(&bounds, &bounds, &ray, 0.0).hit.expect("above the surface");
            assert_eq!((hit.level, hit.i, hit.j), (12, (x * 2048.0) as usize, (y * 2048.0) as usize));
            assert!((5.0 - hit.t - f.at(x) * f.at(y)).abs() < 1e-3);
        }
    }

    #[test]
    fn the_first_hit_is_where_marching_along_the_ray_crosses_the_surface() {
        let (f, g) = (rough(), Fif::interpolating(&KNOTS, &[0.5, 0.5]).integral(0.2));
        let (x, y) = (Bounds::new(&f, 12), Bounds::new(&g, 12));
        let mut hits = 0;
        for k in 0..40 {
            let angle = f64::from(k) * 0.157;
            let (c, s) = (libm::cos(angle), libm::sin(angle));
            let ray = Ray { origin: [1.0 - 2.0 * c, 1.0 - 2.0 * s, 1.9], direction: [c, s, -0.45] };
            let above = |t: f64| {
                let p = ray.at(t);
                let inside = |v: f64| (0.0..=2.0).contains(&v);
                (inside(p[0]) && inside(p[1])).then(|| p[2] > f.at(p[0]) * g.at(p[1]))
            };
            let step = 1.0 / 512.0;
            let crossing = (0..2048)
                .map(|i| f64::from(i) * step)
                .find(|&t| matches!((above(t), above(t + step)), (Some(a), Some(b)) if a != b));
            let hit = trace(&x, &y, &ray, 0.0).hit;
            if let (Some(crossing), Some(hit)) = (crossing, hit) {
                assert!((hit.t - crossing).abs() < 0.02, "{k}: {} {crossing}", hit.t);
                hits += 1;
            }
            assert_eq!(hit.is_some(), crossing.is_some(), "{k}");
        }
        assert!(hits > 10, "{hits}");
    }

    #[test]
    fn a_wide_footprint_ends_the_search_early() {
        let bounds = Bounds::new(&rough(), 12);
        let ray = Ray { origin: [0.3, 0.7, 5.0], direction: [0.0, 0.0, -1.0] };
        let fine = trace(&bounds, &bounds, &ray, 0.0);
        let coarse = trace(&bounds, &bounds, &ray, 0.06);
        // The surface is about 4.5 below; 4.5 times 0.06 is 0.27, and the cells of level 3 are 0.25 wide.
        assert_eq!(coarse.hit.map(|hit| hit.level), Some(3));
        assert!(coarse.box_tests < fine.box_tests);
    }

    #[test]
    fn a_ray_over_the_surface_is_done_after_one_box() {
        let bounds = Bounds::new(&rough(), 12);
        let ray = Ray { origin: [-1.0, 1.0, 3.0], direction: [1.0, 0.0, 0.0] };
        let trace = trace(&bounds, &bounds, &ray, 0.0);
        assert_eq!((trace.hit, trace.box_tests), (None, 1));
    }

    #[test]
    fn the_normal_of_a_bilinear_surface_is_exact_and_faces_the_ray() {
        // h = (2 + x) y: the slopes are y and 2 + x.
        let line = |c0: f64, c1: f64| {
            let map = Map { vertical_scaling: 0.0, q: vec![c0, c1] };
            Bounds::new(&Fif::from_polynomials(&[0.0, 1.0], vec![map]), 0)
        };
        let (x, y) = (line(2.0, 1.0), line(0.0, 1.0));
        let hit = Hit { level: 0, i: 0, j: 0, t: 1.0 };
        let from = |z: f64| Ray { origin: [0.5, 0.5, 5.0 * z], direction: [0.0, 0.0, -z] };
        assert_eq!(leaf_normal(&x, &y, &from(1.0), &hit), [-0.5, -2.5, 1.0]);
        assert_eq!(leaf_normal(&x, &y, &from(-1.0), &hit), [0.5, 2.5, -1.0]);
    }
}
