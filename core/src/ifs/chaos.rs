//! The chaos game: apply a map chosen at random, show the point, repeat.
//!
//! `p_{k+1} = w_i(p_k)`, `i` drawn with its probability by the alias method. Source: M. F. Barnsley, "Fractals Everywhere", 1988, section 3.8
//! ("random iteration algorithm"). One 32-bit word a point; state: one point, one index and the generator.

use rand_xoshiro::Xoshiro128PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use super::system::Ifs;
use crate::picture::Point2;

impl<const N: usize> Ifs<N> {
    /// The endless orbit of a random walk on the attractor, after a warm-up of as many steps as the contraction factor asks for, at most 1024.
    ///
    /// Result: points within [`Ifs::deviation`] of the attractor and inside [`Ifs::bounds`]
    /// (`a_million_points_lie_inside_the_bounds_and_reach_them`).
    pub fn chaos_game<R: Rng>(&self, rng: R) -> ChaosGame<'_, R, N> {
        let mut game = ChaosGame { ifs: self, rng, point: self.start(), map: 0 };
        for _ in 0..self.warm_up() {
            game.step();
        }
        game
    }

    /// [`Ifs::chaos_game`] with a generator of its own, xoshiro128++: the same seed gives the same points on every machine.
    pub fn seeded_chaos_game(&self, seed: u64) -> ChaosGame<'_, Xoshiro128PlusPlus, N> {
        self.chaos_game(Xoshiro128PlusPlus::seed_from_u64(seed))
    }
}

/// The points of a chaos game, without end.
#[derive(Debug, Clone)]
pub struct ChaosGame<'a, R, const N: usize> {
    ifs: &'a Ifs<N>,
    rng: R,
    point: Point2,
    map: u32,
}

impl<'a, R: Rng, const N: usize> ChaosGame<'a, R, N> {
    /// The index of the map that made the last point: each colours its own image of the attractor.
    pub const fn last_map(&self) -> usize {
        self.map as usize
    }

    /// The same points, each with the index of the map that made it.
    pub const fn with_maps(self) -> WithMaps<'a, R, N> {
        WithMaps(self)
    }

    #[inline]
    fn step(&mut self) -> Point2 {
        let index = self.ifs.choice().pick(self.rng.next_u32());
        if let Some(map) = self.ifs.map(index) {
            self.point = map.step(self.point);
        }
        self.map = index as u32;
        self.point
    }
}

impl<R: Rng, const N: usize> Iterator for ChaosGame<'_, R, N> {
    type Item = Point2;

    #[inline]
    fn next(&mut self) -> Option<Point2> {
        Some(self.step())
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (usize::MAX, None)
    }
}

/// The points of a chaos game with their maps, without end: see [`ChaosGame::with_maps`].
#[derive(Debug, Clone)]
pub struct WithMaps<'a, R, const N: usize>(ChaosGame<'a, R, N>);

impl<R: Rng, const N: usize> Iterator for WithMaps<'_, R, N> {
    type Item = (usize, Point2);

    #[inline]
    fn next(&mut self) -> Option<(usize, Point2)> {
        let point = self.0.step();
        Some((self.0.last_map(), point))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (usize::MAX, None)
    }
}
