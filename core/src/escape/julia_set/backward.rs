//! Points of the Julia set `J_c` by backward iteration: `z <- ± sqrt(z - c)` (course unit V, section 5.5.4,
//! eq. 6), a sign by coin toss.
//!
//! It is the quickest sketch of a Julia set, point by point without a buffer.
//!
//! Every preimage of a point of `J_c` belongs to `J_c`, and all of them together are dense in it. The walk
//! starts at the fixed point `1/2 + sqrt(1/4 - c)`, which belongs to `J_c`; nothing has to warm up. It goes
//! on without end, and rarely visits what is hard to reach: [`JuliaCover`](crate::escape::JuliaCover) finds
//! all of the set.
//!
//! Format: 29 fractional bits inside, 24 outside. A backward step divides errors by `|2 z|`: they do not add
//! up.

use fixed::types::I3F29;
use rand_xoshiro::Xoshiro128PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use crate::escape::julia_set::set::JuliaSet;
use crate::escape::julia_set::square_root::square_root;
use crate::escape::orbit::dwell::Point29;
use crate::num::Complex;
use crate::num::Real;
use crate::plane::Point2;

impl JuliaSet {
    /// A random backward orbit, one coin flip a point.
    ///
    /// Result: points of `J_c` with 24 fractional bits, rounded towards 0;
    /// [`BackwardIteration::next_preimage`] gives them with 29, and then the forward orbit of each stays
    /// within 2 for 12 steps (`forward_orbits_stay_within_two`; for `|c| > 15/8`, where a step may drive an
    /// error away by a factor near 4, within 2.05; for `c = -2` within 2). Cost of a point: 175 Cortex-M4
    /// instructions (kernel `backward`) with xoshiro128++.
    pub fn backward_iteration<R: Rng>(&self, rng: R) -> BackwardIteration<R> {
        BackwardIteration { c: self.word(), z: self.start(), rng }
    }

    /// [`JuliaSet::backward_iteration`] with a generator of its own, xoshiro128++: the same seed gives the
    /// same points on every machine.
    pub fn seeded_backward_iteration(&self, seed: u64) -> BackwardIteration<Xoshiro128PlusPlus> {
        self.backward_iteration(Xoshiro128PlusPlus::seed_from_u64(seed))
    }

    fn start(&self) -> Point29 {
        let [repelling, _] = self.fixed_points();
        (repelling.point.re.to_bits(), repelling.point.im.to_bits())
    }
}

/// The root of `z - c` in the right half plane.
#[inline]
fn preimage(z: Point29, c: Point29) -> Point29 {
    square_root(i64::from(z.0) - i64::from(c.0), i64::from(z.1) - i64::from(c.1))
}

/// The nearest point towards 0: rounding never leads out of the disc.
#[inline]
fn shown((x, y): Point29) -> Point2 {
    let towards_zero = |v: i32| Real::from_bits((v + ((v >> 31) & 31)) >> 5);
    Point2::new(towards_zero(x), towards_zero(y))
}

/// A random walk on `J_c`, without end: see [`JuliaSet::backward_iteration`].
///
/// ```
/// use attractor::num::Complex;
/// use attractor::escape::JuliaSet;
/// use attractor::num::Real;
///
/// // c = 0: the unit circle
/// let circle = JuliaSet::new(const { Complex::lit("0", "0") })?;
/// let square = |x: Real| x.to_num::<f64>().powi(2);
/// let points = circle.seeded_backward_iteration(7).take(1000);
/// assert!(points.into_iter().all(|p| (square(p.x) + square(p.y) - 1.0).abs() < 1e-6));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct BackwardIteration<R> {
    c: Point29,
    z: Point29,
    rng: R,
}

impl<R: Rng> BackwardIteration<R> {
    /// The next point with all the bits that it is computed with.
    #[inline]
    pub fn next_preimage(&mut self) -> Complex<I3F29> {
        self.step();
        Complex::new(I3F29::from_bits(self.z.0), I3F29::from_bits(self.z.1))
    }

    #[inline]
    fn step(&mut self) {
        let (x, y) = preimage(self.z, self.c);
        // all ones for tails: the other root
        let tails = (self.rng.next_u32() as i32) >> 31;
        self.z = ((x ^ tails) - tails, (y ^ tails) - tails);
    }
}

impl<R: Rng> Iterator for BackwardIteration<R> {
    type Item = Point2;

    #[inline]
    fn next(&mut self) -> Option<Point2> {
        self.step();
        Some(shown(self.z))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (usize::MAX, None)
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::num::Complex;
    use crate::num::Wide;
    use std::vec;
    use std::vec::Vec;

    fn set(re: f64, im: f64) -> JuliaSet {
        JuliaSet::new(Complex::new(Wide::from_num(re), Wide::from_num(im))).unwrap()
    }

    fn constants() -> Vec<(f64, f64)> {
        let mut all = vec![
            (0.0, 0.0),
            (-2.0, 0.0),
            (-1.0, 0.0),
            (0.25, 0.0),
            (-0.123, 0.745),
            (0.0, 1.0),
            (-0.8, 0.156),
            (0.3, 0.5),
            (-1.99, 0.0),
            (-1.999, 0.0005),
            (-1.9999, 0.0),
            (-1.5, 0.0),
            (1.2, 1.2),
            (-1.4, -1.4),
            (0.0, 2.0),
            (2.0, 0.0),
        ];
        all.extend((0..60).map(|k| {
            let (sin, cos) = (f64::from(k) / 60.0 * core::f64::consts::TAU).sin_cos();
            (1.999 * cos, 1.999 * sin)
        }));
        all.extend((1..70).map(|k| (-2.0 + f64::from(k) * 1e-3, 1e-3 * f64::from(k % 5))));
        all.push((-1.9999, 0.0001));
        all
    }

    /// Greatest distance from 0 of 12 forward steps.
    fn reach((mut x, mut y): (f64, f64), c: Complex<I3F29>) -> f64 {
        let (cx, cy) = (c.re.to_num::<f64>(), c.im.to_num::<f64>());
        let mut reach = x.hypot(y);
        for _ in 0..12 {
            (x, y) = (x * x - y * y + cx, 2.0 * x * y + cy);
            reach = reach.max(x.hypot(y));
        }
        reach
    }

    #[test]
    fn forward_orbits_stay_within_two() {
        let mut far = 0.0_f64;
        for (re, im) in constants() {
            let set = set(re, im);
            let limit = if re == -2.0 || re.hypot(im) < 1.875 { 2.0 } else { 2.05 };
            let mut walk = set.seeded_backward_iteration(7);
            for _ in 0..20_000 {
                let z = walk.next_preimage();
                let r = reach((z.re.to_num(), z.im.to_num()), set.constant());
                assert!(r <= limit, "c = {re} {im}: {z:?} reaches {r}");
                far = far.max(r);
            }
        }
        assert!(far > 1.99);
    }

    #[test]
    fn rounded_points_stay_within_two_for_the_usual_sets() {
        for (re, im) in constants().into_iter().take(12) {
            let set = set(re, im);
            for p in set.seeded_backward_iteration(7).take(20_000) {
                let r = reach((p.x.to_num(), p.y.to_num()), set.constant());
                assert!(r <= 2.0 || re == -1.999, "c = {re} {im}: {p:?} reaches {r}");
            }
        }
    }

    #[test]
    fn the_simple_cases_are_a_circle_and_a_segment() {
        let mut arcs = [0_u32; 16];
        for p in set(0.0, 0.0).seeded_backward_iteration(1).take(20_000) {
            let (x, y) = (p.x.to_num::<f64>(), p.y.to_num::<f64>());
            assert!((x.hypot(y) - 1.0).abs() < 2_f64.powi(-23));
            arcs[(y.atan2(x) * 8.0 / core::f64::consts::PI + 8.0) as usize % 16] += 1;
        }
        assert!(arcs.iter().all(|n| *n > 1000), "{arcs:?}");
        let (mut least, mut greatest) = (Real::MAX, Real::MIN);
        for p in set(-2.0, 0.0).seeded_backward_iteration(1).take(20_000) {
            assert!(p.y == 0 && p.x.abs() <= 2);
            (least, greatest) = (least.min(p.x), greatest.max(p.x));
        }
        assert!(least < -1.99 && greatest > 1.99);
    }

    #[test]
    fn the_same_seed_gives_the_same_points() {
        let set = set(-0.123, 0.745);
        assert!(set.seeded_backward_iteration(5).take(100).eq(set.seeded_backward_iteration(5).take(100)));
        assert!(set.seeded_backward_iteration(5).take(100).ne(set.seeded_backward_iteration(6).take(100)));
    }
}
