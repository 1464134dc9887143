//! The chaos game, which draws an attractor point by point: apply a map chosen at random, show the point,
//! repeat.
//!
//! `p_{k+1} = w_i(p_k)`, `i` drawn with its probability by the alias method. It needs next to no memory, one
//! point, one index and the generator, and shows a rough picture at once that becomes finer the longer it
//! runs. One 32-bit random word a point. Source: M. F. Barnsley, "Fractals Everywhere", 1988, section 3.8
//! ("random iteration algorithm").

use core::borrow::BorrowMut;
use core::marker::PhantomData;

use rand_xoshiro::Xoshiro128PlusPlus;
use rand_xoshiro::rand_core::{Rng, SeedableRng};

use super::system::Ifs;
use crate::plane::Point2;

impl<const N: usize> Ifs<N> {
    /// The endless orbit of a random walk on the attractor, after a warm-up of as many steps as the
    /// contraction factor asks for, at most 1024.
    ///
    /// Result: points within [`Ifs::deviation`] of the attractor and inside [`Ifs::bounds`]
    /// (`a_million_points_lie_inside_the_bounds_and_reach_them`). Cost of a point: 4 multiplications and a
    /// draw; 46 Cortex-M4 instructions (kernel `chaos game`) for the fern with xoshiro128++, in a loop that
    /// adds the coordinates up.
    pub fn chaos_game<R: Rng>(&self, rng: R) -> ChaosGame<'_, R, N> {
        ChaosGame { ifs: self, walk: self.walk(rng), rng: PhantomData }
    }

    /// [`Ifs::chaos_game`] with a generator of its own, xoshiro128++: the same seed gives the same points on
    /// every machine.
    pub fn seeded_chaos_game(&self, seed: u64) -> ChaosGame<'_, Xoshiro128PlusPlus, N> {
        self.chaos_game(Xoshiro128PlusPlus::seed_from_u64(seed))
    }

    /// The state of a chaos game after its warm-up, without a reference to the system: a structure may hold
    /// both. [`Ifs::resume`] goes on.
    // Out of line and without a reference to the system that outlives it: in the loop over the points the
    // compiler then still knows that nothing has changed the system.
    #[inline(never)]
    pub fn walk<R: Rng>(&self, rng: R) -> Walk<R> {
        let mut walk = Walk { rng, point: self.start(), map: 0 };
        walk.warm_up(self);
        walk
    }

    /// [`Ifs::walk`] of [`Ifs::seeded_chaos_game`].
    pub fn seeded_walk(&self, seed: u64) -> Walk<Xoshiro128PlusPlus> {
        self.walk(Xoshiro128PlusPlus::seed_from_u64(seed))
    }

    /// The chaos game from where `walk` stands, and leaves it: the points of all portions together are those
    /// of one game.
    ///
    /// A walk of another system, if it stands outside the disc of this one, starts anew.
    ///
    /// ```
    /// use attractor::ifs::catalogue::BARNSLEY_FERN;
    /// let fern = BARNSLEY_FERN.ifs::<4>()?;
    /// let mut walk = fern.seeded_walk(7);
    /// let first = fern.resume(&mut walk).take(10).last();
    /// let second = fern.resume(&mut walk).next();
    /// assert_eq!((first, second), (fern.seeded_chaos_game(7).nth(9), fern.seeded_chaos_game(7).nth(10)));
    /// # Ok::<(), attractor::Error>(())
    /// ```
    pub fn resume<'a, R: Rng>(&'a self, walk: &'a mut Walk<R>) -> ChaosGame<'a, R, N, &'a mut Walk<R>> {
        // from any point of the disc a game stays in it: see `Ifs`
        if !self.invariant_disc().holds(walk.point) {
            walk.point = self.start();
            walk.warm_up(self);
        }
        ChaosGame { ifs: self, walk, rng: PhantomData }
    }
}

/// Where a chaos game stands: a point, the map that made it, the generator. See [`Ifs::walk`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Walk<R> {
    rng: R,
    point: Point2,
    map: u32,
}

impl<R: Rng> Walk<R> {
    #[inline]
    fn step<const N: usize>(&mut self, ifs: &Ifs<N>) -> Point2 {
        let index = ifs.choice().pick(self.rng.next_u32());
        if let Some(step) = ifs.step(index) {
            self.point = step.apply_inside(self.point);
        }
        self.map = index as u32;
        self.point
    }

    fn warm_up<const N: usize>(&mut self, ifs: &Ifs<N>) {
        for _ in 0..ifs.warm_up() {
            self.step(ifs);
        }
    }
}

/// The points of a chaos game, without end. `W` is its [`Walk`], or a reference to one.
#[derive(Debug, Clone)]
pub struct ChaosGame<'a, R, const N: usize, W = Walk<R>> {
    ifs: &'a Ifs<N>,
    walk: W,
    rng: PhantomData<fn() -> R>,
}

impl<'a, R: Rng, const N: usize, W: BorrowMut<Walk<R>>> ChaosGame<'a, R, N, W> {
    /// The index of the map that made the last point: each colours its own image of the attractor.
    pub fn last_map(&self) -> u8 {
        self.walk.borrow().map as u8
    }

    /// The same points, each with the index of the map that made it: for [`Density`](crate::plane::Density)
    /// and [`ColoredDots`](crate::draw::ColoredDots).
    pub const fn labelled(self) -> Labelled<'a, R, N, W> {
        Labelled(self)
    }
}

impl<R: Rng, const N: usize, W: BorrowMut<Walk<R>>> Iterator for ChaosGame<'_, R, N, W> {
    type Item = Point2;

    #[inline]
    fn next(&mut self) -> Option<Point2> {
        Some(self.walk.borrow_mut().step(self.ifs))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (usize::MAX, None)
    }
}

/// The points of a chaos game with their maps, without end: see [`ChaosGame::labelled`].
#[derive(Debug, Clone)]
pub struct Labelled<'a, R, const N: usize, W = Walk<R>>(ChaosGame<'a, R, N, W>);

impl<R: Rng, const N: usize, W: BorrowMut<Walk<R>>> Iterator for Labelled<'_, R, N, W> {
    type Item = (Point2, u8);

    #[inline]
    fn next(&mut self) -> Option<(Point2, u8)> {
        let walk = self.0.walk.borrow_mut();
        let point = walk.step(self.0.ifs);
        // a system has at most 256 maps
        Some((point, walk.map as u8))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (usize::MAX, None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ifs::Affine;
    use crate::ifs::catalogue::{self, LARGEST};
    use crate::num::{Real, Unit};

    /// FNV-1a over the bits of the coordinates.
    fn hash(points: impl Iterator<Item = Point2>) -> u64 {
        points
            .flat_map(|p| [p.x.to_bits(), p.y.to_bits()])
            .flat_map(i32::to_le_bytes)
            .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
    }

    #[test]
    fn the_same_seed_gives_the_same_fern_everywhere() {
        let fern = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
        assert_eq!(hash(fern.seeded_chaos_game(2024).take(1000)), 0xcd01_da78_f250_8eec);
        assert_ne!(
            hash(fern.seeded_chaos_game(2025).take(1000)),
            hash(fern.seeded_chaos_game(2024).take(1000))
        );
        // neither the capacity nor a pause nor a copy changes anything
        let roomy = catalogue::BARNSLEY_FERN.ifs::<LARGEST>().unwrap();
        assert!(roomy.seeded_chaos_game(3).take(1000).eq(fern.seeded_chaos_game(3).take(1000)));
        let mut game = fern.seeded_chaos_game(3);
        let first = hash(game.by_ref().take(10));
        assert_ne!(hash(game.clone().take(10)), first);
        assert_eq!(hash(game.clone().take(10)), hash(game.take(10)));
    }

    #[test]
    fn each_point_is_the_image_of_the_one_before() {
        let fern = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
        let mut game = fern.seeded_chaos_game(4);
        let mut before = game.next().unwrap();
        let mut count = [0_u32; 4];
        for _ in 0..100_000 {
            let point = game.next().unwrap();
            assert_eq!(point, fern.maps()[usize::from(game.last_map())].apply(before));
            count[usize::from(game.last_map())] += 1;
            before = point;
        }
        for (count, p) in count.iter().zip(fern.probabilities()) {
            let (got, want) = (f64::from(*count) / 1e5, p.to_num::<f64>());
            // four standard deviations
            assert!((got - want).abs() < 4.0 * (want * (1.0 - want) / 1e5).sqrt(), "{got} against {want}");
        }
        let pairs = fern.seeded_chaos_game(4).labelled().take(1000);
        assert!(pairs.map(|(p, _)| p).eq(fern.seeded_chaos_game(4).take(1000)));
    }

    #[test]
    fn a_walk_goes_on_where_it_stands() {
        /// What a structure of firmware holds.
        struct Game {
            ifs: Ifs<4>,
            walk: Walk<Xoshiro128PlusPlus>,
        }
        let ifs = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
        let walk = ifs.seeded_walk(9);
        let mut game = Game { ifs, walk };
        let whole = game.ifs.seeded_chaos_game(9).labelled().take(700).collect::<std::vec::Vec<_>>();
        let mut parts = std::vec::Vec::new();
        for tick in 0..7 {
            let Game { ifs, walk } = &mut game;
            if tick % 2 == 0 {
                parts.extend(ifs.resume(walk).labelled().take(100));
            } else {
                let mut points = ifs.resume(walk);
                parts.extend((0..100).map(|_| (points.next().unwrap(), points.last_map())));
            }
        }
        assert_eq!(parts, whole);
    }

    #[test]
    fn a_walk_of_another_system_starts_anew() {
        // an attractor about (60, 60), and the fern
        let far = Affine::from_thousandths([500, 0, 0, 500, 30_000, 30_000]);
        let far = Ifs::<1>::new(&[far], &[Unit::ONE]).unwrap();
        let fern = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
        let mut walk = far.seeded_walk(1);
        assert_eq!(far.resume(&mut walk).next(), Some(Point2::new(Real::from_num(60), Real::from_num(60))));
        let bounds = fern.bounds();
        for point in fern.resume(&mut walk).take(1000) {
            assert!(point.x >= bounds.min.x && point.x <= bounds.max.x, "{point:?}");
            assert!(point.y >= bounds.min.y && point.y <= bounds.max.y, "{point:?}");
        }
        // each system of the catalogue keeps its own walks
        for entry in catalogue::ALL {
            let ifs = entry.ifs::<LARGEST>().unwrap();
            let mut walk = ifs.seeded_walk(5);
            for count in 0..2000 {
                let before = walk.clone();
                ifs.resume(&mut walk);
                assert_eq!(walk, before, "{count}");
                ifs.resume(&mut walk).next();
            }
        }
    }

    /// Mean and second moments of the invariant measure: `m = sum p_i (L_i m + t_i)`, and the same for the
    /// products.
    #[test]
    fn the_moments_of_the_fern_are_the_exact_ones() {
        let fern = catalogue::BARNSLEY_FERN;
        let rows = || {
            fern.maps.iter().zip(fern.probabilities).map(|(m, p)| {
                let l = [m.a, m.b, m.c, m.d].map(|l| l.to_num::<f64>());
                (p.to_num::<f64>(), l, [m.e.to_num::<f64>(), m.f.to_num::<f64>()])
            })
        };
        // (I - sum p L) m = sum p t, by Cramer's rule
        let (mut l, mut t) = ([0.0; 4], [0.0; 2]);
        for (p, linear, translation) in rows() {
            for (sum, entry) in l.iter_mut().zip(linear) {
                *sum += p * entry;
            }
            t = [t[0] + p * translation[0], t[1] + p * translation[1]];
        }
        let det = (1.0 - l[0]) * (1.0 - l[3]) - l[1] * l[2];
        let mean = [((1.0 - l[3]) * t[0] + l[1] * t[1]) / det, (l[2] * t[0] + (1.0 - l[0]) * t[1]) / det];
        // E x^2, E x y, E y^2: a contraction again, iterated to its fixed point
        let mut second = [0.0_f64; 3];
        for _ in 0..500 {
            let mut next = [0.0; 3];
            for (p, [a, b, c, d], [e, f]) in rows() {
                let [xx, xy, yy] = second;
                let [x, y] = mean;
                let (u, v) = (a * x + b * y, c * x + d * y);
                next[0] += p * (a * a * xx + 2.0 * a * b * xy + b * b * yy + 2.0 * e * u + e * e);
                next[1] += p * (a * c * xx + (a * d + b * c) * xy + b * d * yy + e * v + f * u + e * f);
                next[2] += p * (c * c * xx + 2.0 * c * d * xy + d * d * yy + 2.0 * f * v + f * f);
            }
            second = next;
        }
        let count = 1_000_000;
        let (mut got, mut got_second) = ([0.0; 2], [0.0; 3]);
        for q in fern.ifs::<4>().unwrap().seeded_chaos_game(5).take(count) {
            let (x, y) = (q.x.to_num::<f64>(), q.y.to_num::<f64>());
            got = [got[0] + x, got[1] + y];
            got_second = [got_second[0] + x * x, got_second[1] + x * y, got_second[2] + y * y];
        }
        for (sum, want) in got.iter().zip(mean).chain(got_second.iter().zip(second)) {
            let value = sum / count as f64;
            assert!((value - want).abs() < 0.005 * (1.0 + want.abs()), "{value} against {want}");
        }
        assert!(mean[1] > 5.0 && second[2] > 40.0, "{mean:?} {second:?}");
    }

    #[test]
    fn a_single_map_stays_at_its_fixed_point() {
        let map = Affine::from_thousandths([500, 0, 0, 500, 1000, -1000]);
        let ifs = crate::ifs::Ifs::<1>::new(&[map], &[Unit::ONE]).unwrap();
        let point = Point2::new(Real::from_num(2), Real::from_num(-2));
        assert!(ifs.seeded_chaos_game(0).take(100).all(|p| p == point));
        assert_eq!(ifs.seeded_chaos_game(0).size_hint(), (usize::MAX, None));
    }
}
