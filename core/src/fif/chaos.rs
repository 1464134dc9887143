//! The chaos game for the graph of a fractal interpolation function (Algorithm 1).
//!
//! A random map is applied to the last point again and again; every point lies on the graph. Maps are drawn in proportion to their intervals,
//! so that the points spread evenly along the abscissa (for equal intervals this is the paper's uniform choice).
//!
//! Source: Cochran, Lewis, Hart, Algorithm 1.

use rand_core::Rng;

use super::function::Fif;
use super::map::{Map, first_step, map_at};
use super::polynomial::{by_scaling, part_by_width};
use super::value::FRACTION;
use crate::num::{Real, real_from};
use crate::picture::Point2;

/// An endless iterator of points of the graph; `x` is the unit abscissa in `[0, 1]`.
#[derive(Debug, Clone)]
pub struct ChaosGame<'a, R, const D: usize> {
    maps: &'a [Map<D>],
    /// How a search among them begins.
    step: usize,
    rng: R,
    u: u64,
    y: i64,
}

impl<const N: usize, const D: usize> Fif<N, D> {
    /// Plays the chaos game from the first knot, which lies on the graph: no warm-up is needed.
    ///
    /// ```
    /// use attractor::fif::{Fif, Knot};
    /// use attractor::num::{Scaling, Wide};
    /// use attractor::rand_xoshiro::{Xoshiro128PlusPlus, rand_core::SeedableRng};
    ///
    /// let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    /// let f = Fif::<2, 1>::interpolating(&knots, &[Scaling::from_num(0.5); 2])?;
    /// let points = f.chaos_game(Xoshiro128PlusPlus::seed_from_u64(1)).take(1000);
    /// assert!(points.into_iter().all(|p| p.x >= 0 && p.x <= 1 && p.y >= 0));
    /// # Ok::<(), attractor::Error>(())
    /// ```
    pub fn chaos_game<R: Rng>(&self, rng: R) -> ChaosGame<'_, R, D> {
        ChaosGame { maps: &self.maps, step: first_step(self.maps.len()), rng, u: 0, y: self.first }
    }
}

impl<R: Rng, const D: usize> Iterator for ChaosGame<'_, R, D> {
    type Item = Point2;

    fn next(&mut self) -> Option<Point2> {
        let place = u64::from(self.rng.next_u32()) << 31;
        let map = map_at(self.maps, self.step, place)?;
        // u < 1: parts are rounded down
        self.y = map.q.before_end(self.u).wrapping_add(by_scaling(self.y, map.scaling));
        self.u = map.start.wrapping_add(part_by_width(self.u, map.width));
        Some(Point2::new(Real::from_bits((self.u >> 39) as i32), real_from(self.y, FRACTION)))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (usize::MAX, None)
    }
}
