//! The paper's own ray caster, in floating point: Cochran, Lewis, Hart, "The Normal of a Fractal Surface",
//! Algorithms 2 and 3.
//!
//! As it stands there: maps are composed at every step (eq. 24-28), a node's rectangle is the image of the
//! whole graph's (eq. 47-48, both polynomials, either sign of alpha), a box is tested against six planes (eq.
//! 50-51, with reciprocals taken once a ray), the search is recursive, and the normal is exact,
//! `(-f'(x) g(y), -f(x) g'(y), 1)` (eq. 45), four evaluations by Algorithm 2. Two things are given to it:
//! rigorous bounds of the whole function, where the paper plays the chaos game, and what a composition takes
//! of each map, computed once.

use attractor::fif::Pyramid;

use super::camera::Camera;
use super::shade::{mirror, normal, sky};
use super::vector::{Vector, unit};
use crate::float::Float;

/// The surface lies over `[0, 2] x [0, 2]`.
const ENDS: (f64, f64) = (0.0, 2.0);
/// The search ends at this horizontal factor: core's pyramids have as many levels.
const SMALL: f64 = 1.0 / 256.0;
/// An evaluation ends at this one: 24 levels, as in the rows of `fif`.
const SMALLER: f64 = 1.0 / 16_777_216.0;

/// `(x, y) -> (a x + b, alpha y + q(x))` with `C` coefficients, constant first: a map or a composition of
/// maps.
#[derive(Clone, Copy)]
struct Map<F, const C: usize> {
    a: F,
    b: F,
    alpha: F,
    q: [F; C],
}

/// A map, and what a composition takes of it.
#[derive(Clone, Copy)]
struct Inner<F, const C: usize> {
    map: Map<F, C>,
    /// `powers[m][k] = (m over k) a^(m-k) b^k`.
    powers: [[F; C]; C],
    /// The right end of its interval.
    end: F,
}

/// A function of two maps.
struct Function<F, const C: usize> {
    maps: [Inner<F, C>; 2],
    /// The middle knot.
    median: (F, F),
}

impl<F: Float, const C: usize> Map<F, C> {
    fn identity() -> Self {
        Self { a: F::of(1.0), b: F::of(0.0), alpha: F::of(1.0), q: [F::of(0.0); C] }
    }

    /// `self` after `inner`: eq. 24-27, and the pseudo-code under eq. 28.
    #[inline(always)]
    fn after(&self, inner: &Inner<F, C>) -> Self {
        let (outer, map) = (self.q, &inner.map);
        let mut q = map.q.map(|c| self.alpha * c);
        q[0] = q[0] + outer[0];
        for m in 1..C {
            for k in 0..=m {
                q[m - k] = outer[m].fused(inner.powers[m][k], q[m - k]);
            }
        }
        Self { a: self.a * map.a, b: self.a.fused(map.b, self.b), alpha: self.alpha * map.alpha, q }
    }

    #[inline(always)]
    fn q_at(&self, x: F) -> F {
        let mut sum = self.q[C - 1];
        for m in (0..C - 1).rev() {
            sum = sum.fused(x, self.q[m]);
        }
        sum
    }
}

impl<F: Float> Map<F, 3> {
    /// The rectangle around the part of the graph that is the image of the whole one, whose values are
    /// between `low` and `high`.
    #[inline(always)]
    fn rectangle(&self, (low, high): (F, F)) -> [(F, F); 2] {
        let (left, right) = (F::of(ENDS.0), F::of(ENDS.1));
        let [_, linear, square] = self.q;
        let (at_left, at_right) = (self.q_at(left), self.q_at(right));
        let (mut least, mut most) = (at_left.least(at_right), at_left.most(at_right));
        // the slopes at the two ends: where their signs differ the extremum lies between
        let twice = square + square;
        if (linear > F::of(0.0)) != (twice.fused(right, linear) > F::of(0.0)) {
            let extremum = self.q_at(-linear / twice);
            (least, most) = (least.least(extremum), most.most(extremum));
        }
        let (one, other) = (self.alpha * low, self.alpha * high);
        [
            (self.a.fused(left, self.b), self.a.fused(right, self.b)),
            (one.least(other) + least, one.most(other) + most),
        ]
    }
}

impl<F: Float, const C: usize> Function<F, C> {
    fn new(maps: [(f64, [f64; C]); 2], median: f64) -> Self {
        let inner = |(alpha, q): (f64, [f64; C]), b: f64| {
            let a = 0.5_f64;
            let mut powers = [[0.0_f64; C]; C];
            powers[0][0] = 1.0;
            for m in 1..C {
                for k in 0..=m {
                    let longer = if k < m { powers[m - 1][k] * a } else { 0.0 };
                    powers[m][k] = longer + if k > 0 { powers[m - 1][k - 1] * b } else { 0.0 };
                }
            }
            Inner {
                map: Map { a: F::of(a), b: F::of(b), alpha: F::of(alpha), q: q.map(F::of) },
                powers: powers.map(|row| row.map(F::of)),
                end: F::of(a * ENDS.1 + b),
            }
        };
        let [first, second] = maps;
        Self { maps: [inner(first, 0.0), inner(second, 1.0)], median: (F::of(1.0), F::of(median)) }
    }

    /// Algorithm 2.
    #[inline(never)]
    fn at(&self, x: F) -> F {
        let mut w = Map::<F, C>::identity();
        while w.a > F::of(SMALLER) {
            let [first, second] = &self.maps;
            w = w.after(if x > w.a.fused(first.end, w.b) { second } else { first });
        }
        w.alpha.fused(self.median.1, w.q_at(self.median.0))
    }
}

/// A ray and the reciprocals of its direction.
struct Ray<F> {
    eye: Vector<F>,
    direction: Vector<F>,
    reciprocals: Vector<F>,
}

/// The surface `G x G` and its camera.
pub(crate) struct Paper<F> {
    /// `G` (eq. 39-40) and its derivative `g` (eq. 22-23).
    integral: Function<F, 3>,
    slope: Function<F, 2>,
    /// Bounds of `G`.
    bounds: (F, F),
    camera: Camera<F>,
}

impl<F: Float> Paper<F> {
    /// On a picture of `side x side` pixels. The pyramid of `G` is asked for the bounds of the whole function
    /// alone.
    pub(crate) fn new(pyramid: &Pyramid<'_>, side: u32) -> Self {
        let root = pyramid.root();
        Self {
            integral: Function::new([(0.425, [0.0, 0.0, 0.125]), (-0.425, [0.925, 0.5, -0.125])], 0.925),
            slope: Function::new([(0.85, [0.0, 0.5]), (-0.85, [1.0, -0.5])], 1.0),
            bounds: (F::of(root.min.to_num::<f64>()), F::of(root.max.to_num::<f64>())),
            camera: Camera::new(side),
        }
    }

    /// The tone of a pixel: the sky, mirrored where its ray meets the surface.
    pub(crate) fn tone(&self, x: u32, y: u32) -> F {
        let (eye, direction) = (self.camera.eye, unit(self.camera.direction(x, y)));
        let ray = Ray { eye, direction, reciprocals: direction.map(|c| F::of(1.0) / c) };
        let t = self.intersection(&ray, &mut || ());
        if t < F::of(0.0) {
            return sky(direction[2]);
        }
        let clamp = |v: F| v.most(F::of(ENDS.0)).least(F::of(ENDS.1));
        let [x, y] = [0, 1].map(|i: usize| clamp(t.fused(direction[i], eye[i])));
        let slopes = [self.slope.at(x), self.integral.at(x), self.slope.at(y), self.integral.at(y)];
        mirror(normal(slopes), direction)
    }

    fn intersection(&self, ray: &Ray<F>, test: &mut impl FnMut()) -> F {
        self.node(ray, &Map::identity(), &Map::identity(), test)
    }

    /// Algorithm 3: the parameter at which the ray meets the surface, negative if it does not.
    fn node(&self, ray: &Ray<F>, f: &Map<F, 3>, g: &Map<F, 3>, test: &mut impl FnMut()) -> F {
        let miss = F::of(-1.0);
        test();
        let ([x, heights], [y, others]) = (f.rectangle(self.bounds), g.rectangle(self.bounds));
        let (a, b) = (heights.0 * others.0, heights.0 * others.1);
        let (c, d) = (heights.1 * others.0, heights.1 * others.1);
        let z = (a.least(b).least(c.least(d)), a.most(b).most(c.most(d)));
        // a ray that starts inside has t_0 < 0 < t_1
        let (mut t_in, mut t_out) = (F::of(0.0), F::of(1e30));
        for (axis, (low, high)) in [x, y, z].into_iter().enumerate() {
            let (eye, reciprocal) = (ray.eye[axis], ray.reciprocals[axis]);
            let (one, other) = ((low - eye) * reciprocal, (high - eye) * reciprocal);
            t_in = t_in.most(one.least(other));
            t_out = t_out.least(one.most(other));
        }
        if t_in > t_out {
            return miss;
        }
        if f.a <= F::of(SMALL) && g.a <= F::of(SMALL) {
            return (t_in + t_out) * F::of(0.5);
        }
        // figure 5: along each axis in the order in which the ray meets them
        let order = |c: F| if c < F::of(0.0) { [1, 0] } else { [0, 1] };
        for i in order(ray.direction[0]) {
            for j in order(ray.direction[1]) {
                let maps: &[Inner<F, 3>; 2] = &self.integral.maps;
                let (f, g) = (f.after(&maps[i]), g.after(&maps[j]));
                let t = self.node(ray, &f, &g, test);
                if t >= F::of(0.0) {
                    return t;
                }
            }
        }
        miss
    }
}

#[cfg(test)]
impl<F: Float> Paper<F> {
    /// How many boxes the ray of a pixel is tested against.
    pub(crate) fn box_tests(&self, x: u32, y: u32) -> u32 {
        let (mut boxes, direction) = (0, self.camera.direction(x, y));
        let reciprocals = direction.map(|c| F::of(1.0) / c);
        self.intersection(&Ray { eye: self.camera.eye, direction, reciprocals }, &mut || boxes += 1);
        boxes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exported::{figure_1_g, figure_3_g};
    use crate::surface::mirror;
    use attractor::fif::{Cell, Pyramid};
    use attractor::num::Wide;
    use attractor::plane::Field as _;
    use embedded_graphics::geometry::Size;

    #[test]
    fn algorithm_2_evaluates_the_function_of_core() {
        let g = figure_3_g::function::<2, 2>().unwrap();
        let mut memory = [Cell::ZERO; Pyramid::cells(2, 8)];
        let pyramid = Pyramid::new(&g, 8, &mut memory).unwrap();
        let (paper, single) = (Paper::<f64>::new(&pyramid, 8), Paper::<f32>::new(&pyramid, 8));
        for i in 0..=100 {
            let x = f64::from(i) / 50.0;
            let exact = g.at(Wide::from_num(x)).to_num::<f64>();
            assert!((paper.integral.at(x) - exact).abs() < 1e-6, "{x}");
            assert!((f64::from(single.integral.at(x as f32)) - exact).abs() < 1e-5, "{x}");
        }
        // 0.85^24 of the slope's range is left
        let slope = figure_1_g::function::<2, 1>().unwrap();
        for i in 0..=100 {
            let x = f64::from(i) / 50.0;
            let exact = slope.at(Wide::from_num(x)).to_num::<f64>();
            assert!((paper.slope.at(x) - exact).abs() < 0.05, "{x}");
        }
    }

    #[test]
    fn the_paper_finds_what_core_finds() {
        const SIDE: u32 = 240;
        let mut memory = [Cell::ZERO; Pyramid::cells(2, 8)];
        let g = figure_3_g::function::<2, 2>().unwrap();
        let pyramid = Pyramid::new(&g, 8, &mut memory).unwrap();
        let caster = mirror(&pyramid, Size::new(SIDE, SIDE)).unwrap();
        let paper = Paper::<f64>::new(&pyramid, SIDE);
        let (mut rays, mut hits, mut apart, mut difference) = (0_u32, 0_u32, 0_u32, 0.0);
        for y in (8..SIDE).step_by(16) {
            for (x, tone) in caster.row(y, 0..SIDE).enumerate() {
                let x = x as u32;
                let direction = paper.camera.direction(x, y);
                let reciprocals = direction.map(|c| 1.0 / c);
                let t =
                    paper.intersection(&Ray { eye: paper.camera.eye, direction, reciprocals }, &mut || ());
                let near = caster.hit(x, y).map_or(-1.0, |hit| hit.t.to_num::<f64>());
                rays += 1;
                hits += u32::from(t >= 0.0);
                apart += u32::from((t - near).abs() > 0.02);
                difference += (f64::from(tone.to_bits()) / 65535.0 - paper.tone(x, y)).abs();
            }
        }
        assert!((rays / 4..rays / 2).contains(&hits), "{hits} of {rays}");
        assert!(apart < rays / 100, "{apart} of {rays}");
        // core's normals are means over a leaf, the paper's are exact and rougher
        let mean = difference / f64::from(rays);
        assert!(mean > 1e-4 && mean < 0.02, "{mean}");
    }
}
