//! The chaos game for the graph of a fractal interpolation function (Algorithm 1).
//!
//! A random map is applied to the last point again and again; every point lies on the graph. Maps are drawn
//! in proportion to their intervals, so that the points spread evenly along the abscissa (for equal intervals
//! this is the paper's uniform choice).
//!
//! Source: Cochran, Lewis, Hart, Algorithm 1.

use rand_core::Rng;

use super::function::Fif;
use super::map::{Map, first_step, map_at};
use super::polynomial::{by_scaling, part_by_width};
use super::value::FRACTION_Q55;
use crate::num::{Real, real_from};
use crate::plane::Point2;

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
        Some(Point2::new(Real::from_bits((self.u >> 39) as i32), real_from(self.y, FRACTION_Q55)))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (usize::MAX, None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fif::Knot;
    use crate::num::{Scaling, Wide};
    use core::convert::Infallible;

    /// Words one after the other, again and again.
    struct Words<'a>(core::iter::Cycle<core::slice::Iter<'a, u32>>);

    impl rand_core::TryRng for Words<'_> {
        type Error = Infallible;
        fn try_next_u32(&mut self) -> Result<u32, Infallible> {
            Ok(self.0.next().copied().unwrap_or(0))
        }
        fn try_next_u64(&mut self) -> Result<u64, Infallible> {
            self.try_next_u32().map(u64::from)
        }
        fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
            bytes.fill(0);
            Ok(())
        }
    }

    /// Parts of a quarter, a half and a quarter; every point against integers, `u` with 63 fractional bits
    /// and `y` with 55 and 31 more.
    #[test]
    fn a_word_draws_the_part_it_lies_in_and_its_map_sends_the_point() {
        let knots =
            [(0, 1), (1, 3), (3, -2), (4, 2)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let scalings = [0.5, -0.75, 0.25].map(Scaling::from_num);
        let f = Fif::<3, 1>::interpolating(&knots, &scalings).unwrap();
        let words = [0, (1 << 30) - 1, 1 << 30, 3 << 30, (3 << 30) - 1, u32::MAX, 0x1234_5678, 0x8765_4321];
        let drawn = [0, 0, 1, 2, 1, 2, 0, 1];
        let (mut u, mut y) = (0_u128, 1_i128 << 86);
        let points = f.chaos_game(Words(words.iter().cycle()));
        assert_eq!(points.size_hint(), (usize::MAX, None));
        for (k, point) in points.take(400).enumerate() {
            let map: usize = drawn[k % 8];
            let (x0, y0) = ([0_u128, 1, 3][map], [1_i128, 3, -2][map]);
            let (width, y1) = ([1_u128, 2, 1][map], [3_i128, -2, 2][map]);
            let alpha = i128::from(scalings[map].to_bits()); // 31 fractional bits
            // q(0) = y_(j-1) - alpha y_0, q(1) = y_j - alpha y_N, 31 fractional bits; y with 86
            let (q0, q1) = ((y0 << 31) - alpha, (y1 << 31) - 2 * alpha);
            y = (q0 << 55) + (((q1 - q0) * u as i128) >> 8) + ((y >> 31) * alpha);
            u = (x0 << 61) + ((u * width) >> 2);
            assert!(u128::from(point.x.to_bits() as u32) == u >> 39, "{k}: {}", point.x);
            // half a unit of 2^-24, and a few of 2^-55
            let off = y - (i128::from(point.y.to_bits()) << 62);
            assert!(off.abs() <= (1 << 61) + (1 << 37), "{k}: {} off by {off}", point.y);
        }
    }
}
