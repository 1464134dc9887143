//! The bounding box of an attractor, without drawing a point of it: a search through addresses that leaves
//! out all that cannot matter (branch and bound).
//!
//! A window has to be chosen before the first point is shown, and a box around sampled points would miss the
//! rare ones. This box is rigorous.
//!
//! How far the attractor `A` reaches in the direction `u` is its support function,
//! `h(u) = max { u . p : p in A }`. `A` is the union of its images under composed maps `w_j1 o .. o w_jk`
//! (`j_1 .. j_k` is an address), and `h` the maximum over all addresses of one length. Only one row of each
//! composed map matters: `u . w_j1 o .. o w_jk (p) = r . p + t`, and appending a map sends `(r, t)` to
//! `(r L_j, t + r . t_j)`. With any set `K` that contains `A`, `max_K (r . p + t)` bounds the address from
//! above; a point of `A` bounds `h` from below. An address that cannot raise the lower bound by more than a
//! tolerance is not made longer. `K` is the intersection of the invariant disc and of the box found so far:
//! four passes, each with an eighth of the tolerance before, tighten the box first where it is cheap.
//!
//! Source: the recursion is Hutchinson's `A = u w_j(A)`; branch and bound is A. H. Land and A. G. Doig, 1960.
//! Formats: `r` has 30 fractional bits, `t` 54. Appending a map is exact in `t` and rounds `r` by `2^-31` an
//! entry, which changes the value at a point of the disc by at most `(|x| + |y|) 2^-31`; an address of `k`
//! letters is widened by `k` times as much.

use heapless::Vec;

use super::affine::{Affine, hypotenuse};
use super::disc::Disc;
use super::system::Ifs;
use crate::num::Real;
use crate::num::formats::{Q24, Q30, Q54};
use crate::plane::{Bounds2, Point2};

/// The longest address that is opened: the capacity of the stack, which holds one entry for each letter.
const DEPTH: usize = 128;

/// How many nodes one search may visit before it stops opening them.
const NODES: u32 = 1 << 14;

/// Tolerances of the passes: the larger extent divided by a power of two.
const PASSES: [u32; 4] = [3, 6, 9, 12];

/// One unit in the last place of [`Real`].
const ULP: Q54 = 1 << 30;

impl<const N: usize> Ifs<N> {
    /// A box that contains the attractor and each point of each chaos game.
    ///
    /// Error: outwards, and in each direction by less than `2^-11` of the larger extent and twice
    /// [`Ifs::deviation`] (`bounds_are_those_of_the_textbooks`), as long as no address of more than 128
    /// letters is needed (contraction factors up to about 0.93) and no direction visits more than 16384
    /// nodes; beyond that still outwards, but wider (`slow_spirals_are_bounded_all_the_same`). Cost: a node
    /// is 15 multiplications and a square root; the catalogue's attractors visit between 212 and 5792 of them
    /// (`the_search_is_short_for_the_catalogue`), the fern 2616 in 672 thousand Cortex-M4 instructions
    /// (kernel `bounds`). Stack: 128 entries of 24 bytes.
    pub fn bounds(&self) -> Bounds2 {
        self.search().0
    }

    /// The bounds, and how many nodes were visited.
    fn search(&self) -> (Bounds2, u32) {
        let mut search = Search::new(self.maps(), self.invariant_disc(), self.start(), self.deviation());
        search.reach(self.start());
        self.seeded_chaos_game(0).take(256).for_each(|p| search.reach(p));
        search.run()
    }
}

/// What a composed map makes of a direction: `r . p + t` is how far the image of `p` lies that way.
#[derive(Debug, Clone, Copy)]
struct Functional {
    r: [Q30; 2],
    t: Q54,
}

impl Functional {
    /// After `map`: the composed address is one letter longer.
    fn after(&self, map: &Affine) -> Self {
        let [r, s] = self.r.map(i64::from);
        let entry =
            |upper: i32, lower: i32| ((r * i64::from(upper) + s * i64::from(lower) + (1 << 29)) >> 30) as i32;
        Self {
            r: [entry(map.a.to_bits(), map.c.to_bits()), entry(map.b.to_bits(), map.d.to_bits())],
            t: self.t + self.linear(Point2::new(map.e, map.f)),
        }
    }

    /// `r . p`.
    fn linear(&self, p: Point2) -> Q54 {
        let [r, s] = self.r.map(i64::from);
        r * i64::from(p.x.to_bits()) + s * i64::from(p.y.to_bits())
    }

    fn at(&self, p: Point2) -> Q54 {
        self.t + self.linear(p)
    }
}

/// An address that is open: the search goes on with the addresses one letter longer.
struct Node {
    functional: Functional,
    /// The next map to append.
    next: usize,
}

/// One of the four sides of the box.
#[derive(Debug, Clone, Copy)]
struct BoxSide {
    /// The unit vector outwards.
    r: [Q30; 2],
    /// How far the disc reaches in this direction.
    disc: Q24,
    /// How far a box reaches that contains the attractor: what the searches tighten.
    hull: Q24,
    /// How far the attractor is known to reach.
    reached: Q54,
}

impl BoxSide {
    fn of(disc: Disc, r: [Q30; 2]) -> Self {
        // a coordinate of the centre, at most 64 with its radius
        let centre = (Functional { r, t: 0 }.at(disc.centre) >> 30) as i32;
        let far = centre + disc.radius.to_bits();
        Self { r, disc: far, hull: far, reached: i64::MIN }
    }

    /// The attractor is known to come as near to a point as the deviation.
    fn reach(&mut self, p: Point2, deviation: Q54) {
        self.reached = self.reached.max(Functional { r: self.r, t: -deviation }.at(p));
    }

    /// The coordinate of this side of the final box, outwards.
    fn end(&self, deviation: Q54) -> Q24 {
        (i64::from(self.hull) + (deviation >> 30)).min(self.disc.into()) as i32
    }
}

/// The search for all four sides.
struct Search<'a> {
    maps: &'a [Affine],
    disc: Disc,
    /// Right, left, upper and lower side.
    sides: [BoxSide; 4],
    /// A point of the attractor, within one unit.
    probe: Point2,
    /// How much one letter widens a node.
    widening: Q54,
    /// How far a point of a chaos game may be from the attractor.
    deviation: Q54,
}

impl<'a> Search<'a> {
    fn new(maps: &'a [Affine], disc: Disc, probe: Point2, deviation: u32) -> Self {
        let [x, y] = disc.reach();
        // the reach, 24 fractional bits, times 2^-31 is 2^-1 of it with 54
        let widening = ((x + y) >> 1) + 1;
        const ONE_Q30: Q30 = 1 << 30;
        let directions = [[ONE_Q30, 0], [-ONE_Q30, 0], [0, ONE_Q30], [0, -ONE_Q30]];
        let sides = directions.map(|r| BoxSide::of(disc, r));
        Self { maps, disc, sides, probe, widening, deviation: i64::from(deviation) << 30 }
    }

    #[inline(never)]
    fn reach(&mut self, p: Point2) {
        self.sides.iter_mut().for_each(|side| side.reach(p, self.deviation));
    }

    /// The bounds, and how many nodes were visited.
    #[inline(never)]
    fn run(&mut self) -> (Bounds2, u32) {
        let mut visited = 0;
        for shift in PASSES {
            let [right, left, top, bottom] = self.sides.map(|side| side.reached);
            let extent = (right + left).max(top + bottom).max(0);
            let tolerance = (extent >> shift) + ULP;
            for index in 0..self.sides.len() {
                visited += self.tighten(index, tolerance);
            }
        }
        let [right, left, top, bottom] = self.sides.map(|side| side.end(self.deviation));
        let corner = |x: i32, y: i32| Point2::new(Real::from_bits(x), Real::from_bits(y));
        (Bounds2 { min: corner(-left, -bottom), max: corner(right, top) }, visited)
    }

    /// Moves a side inwards to the support function within a tolerance. Result: how many nodes were visited.
    fn tighten(&mut self, index: usize, tolerance: Q54) -> u32 {
        let Some(BoxSide { r, hull, reached: known, .. }) = self.sides.get(index).copied() else { return 0 };
        let (mut bound, mut reached, mut visited) = (known, known, 0);
        let mut stack: Vec<Node, DEPTH> = Vec::new();
        let mut candidate = Some(Functional { r, t: 0 });
        loop {
            if let Some(functional) = candidate.take() {
                visited += 1;
                let slack = self.widening * stack.len() as i64;
                let highest = self.highest(&functional) + slack;
                reached = reached.max(functional.at(self.probe) - slack - ULP);
                let open = highest > reached + tolerance && visited < NODES;
                if !open || stack.push(Node { functional, next: 0 }).is_err() {
                    bound = bound.max(highest);
                }
            }
            let Some(node) = stack.last_mut() else { break };
            match self.maps.get(node.next) {
                Some(map) => {
                    node.next += 1;
                    candidate = Some(node.functional.after(map));
                }
                None => {
                    stack.pop();
                }
            }
        }
        if let Some(side) = self.sides.get_mut(index) {
            side.reached = reached;
            // up to a unit in the last place, not beyond what is known; `reached` is within the deviation of
            // a point of the disc: above -2^31
            let bits = (bound.max(reached) + ULP - 1) >> 30;
            side.hull = bits.min(hull.into()) as i32;
        }
        visited
    }

    /// The largest value that the functional has in both the disc and the box.
    fn highest(&self, f: &Functional) -> Q54 {
        let [r, s] = f.r;
        let [right, left, top, bottom] = &self.sides;
        let x = if r < 0 { -left.hull } else { right.hull };
        let y = if s < 0 { -bottom.hull } else { top.hull };
        let norm = hypotenuse(i64::from(r), i64::from(s)) as i64;
        let corner = Point2::new(Real::from_bits(x), Real::from_bits(y));
        f.at(corner).min(f.at(self.disc.centre) + norm * i64::from(self.disc.radius.to_bits()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ifs::catalogue::{self, LARGEST};
    use crate::num::Unit;
    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    /// Left, right, bottom, top.
    fn sides(b: Bounds2) -> [f64; 4] {
        [b.min.x, b.max.x, b.min.y, b.max.y].map(|z| z.to_num())
    }

    fn larger_extent([left, right, bottom, top]: [f64; 4]) -> f64 {
        (right - left).max(top - bottom)
    }

    /// How far `outer` lies outside `inner` on each side.
    fn margins(outer: [f64; 4], inner: [f64; 4]) -> [f64; 4] {
        [inner[0] - outer[0], outer[1] - inner[1], inner[2] - outer[2], outer[3] - inner[3]]
    }

    #[test]
    fn bounds_are_those_of_the_textbooks() {
        let root3 = 3_f64.sqrt();
        for (attractor, exact) in [
            (&catalogue::SIERPINSKI_GASKET, [0.0, 1.0, 0.0, 1.0]),
            (&catalogue::SIERPINSKI_CARPET, [0.0, 1.0, 0.0, 1.0]),
            (&catalogue::CANTOR_DUST, [0.0, 1.0, 0.0, 1.0]),
            (&catalogue::VICSEK_BOX, [0.0, 1.0, 0.0, 1.0]),
            (&catalogue::KOCH_CURVE, [0.0, 1.0, 0.0, root3 / 6.0]),
            (&catalogue::HEIGHWAY_DRAGON, [-1.0 / 3.0, 7.0 / 6.0, -1.0 / 3.0, 2.0 / 3.0]),
            (&catalogue::LEVY_C_CURVE, [-0.5, 1.5, -0.25, 1.0]),
            // as published, to four decimals
            (&catalogue::BARNSLEY_FERN, [-2.1820, 2.6558, 0.0, 9.9983]),
            // the powers of i - 1 turn full circle in 8 steps, by a factor of 16: sums of geometric series
            (&catalogue::TWINDRAGON, [-13.0 / 15.0, 7.0 / 15.0, -14.0 / 15.0, 11.0 / 15.0]),
        ] {
            let bounds = attractor.ifs::<LARGEST>().unwrap().bounds();
            for margin in margins(sides(bounds), exact) {
                assert!(margin >= 0.0, "{}: {margin:e}", attractor.name);
                let limit = larger_extent(exact) / 2048.0;
                assert!(margin < limit, "{}: {margin:e}", attractor.name);
            }
        }
    }

    #[test]
    fn a_million_points_lie_inside_the_bounds_and_reach_them() {
        for attractor in catalogue::ALL {
            let ifs = attractor.ifs::<LARGEST>().unwrap();
            // the textbooks' probabilities leave the foot of a trunk almost bare: equal ones visit every side
            let share = Unit::from_num(1.0 / attractor.maps.len() as f64);
            let even =
                Ifs::<LARGEST>::new(attractor.maps, &[share; LARGEST][..attractor.maps.len()]).unwrap();
            let Bounds2 { min, max } = ifs.bounds();
            let mut inner = Bounds2 { min: max, max: min };
            let points = ifs.seeded_chaos_game(1).take(1_000_000);
            for p in points.chain(even.seeded_chaos_game(2).take(1_000_000)) {
                inner.min = Point2::new(inner.min.x.min(p.x), inner.min.y.min(p.y));
                inner.max = Point2::new(inner.max.x.max(p.x), inner.max.y.max(p.y));
            }
            assert!(inner.min.x >= min.x && inner.min.y >= min.y, "{} left", attractor.name);
            assert!(inner.max.x <= max.x && inner.max.y <= max.y, "{} right", attractor.name);
            let outer = sides(Bounds2 { min, max });
            for margin in margins(outer, sides(inner)) {
                assert!(margin <= larger_extent(outer) / 100.0, "{}: {margin}", attractor.name);
            }
        }
    }

    #[test]
    fn the_search_is_short_for_the_catalogue() {
        let (mut least, mut most) = (u32::MAX, 0);
        for attractor in catalogue::ALL {
            let visited = attractor.ifs::<LARGEST>().unwrap().search().1;
            (least, most) = (least.min(visited), most.max(visited));
        }
        assert_eq!((least, most), (212, 5792));
    }

    #[test]
    fn slow_spirals_are_bounded_all_the_same() {
        // s = 0.99: 128 letters shrink the disc to 0.28 of itself
        let turn = Affine::from_ratios([9_801, -1_397, 1_397, 9_801, 0, 0], 10_000);
        let seed = Affine::from_thousandths([10, 0, 0, 10, 500, 0]);
        let ifs = Ifs::<2>::proportional_to_determinant(&[turn, seed]).unwrap();
        let bounds = ifs.bounds();
        let outer = sides(bounds);
        let mut inner = [f64::MAX, f64::MIN, f64::MAX, f64::MIN];
        for p in ifs.seeded_chaos_game(2).take(1_000_000) {
            let [x, y] = [p.x, p.y].map(|z| z.to_num::<f64>());
            inner = [inner[0].min(x), inner[1].max(x), inner[2].min(y), inner[3].max(y)];
        }
        for margin in margins(outer, inner) {
            assert!(margin >= 0.0 && margin < larger_extent(inner), "{outer:?} {inner:?}");
        }
    }

    #[test]
    fn many_coinciding_maps_end_the_search() {
        let maps = [Affine::from_thousandths([600, -500, 500, 600, 300, 700]); 256];
        let mut varied = maps;
        for (i, map) in varied.iter_mut().enumerate() {
            map.e = Real::from_bits(i as i32);
        }
        for maps in [maps, varied] {
            let ifs = Ifs::<256>::proportional_to_determinant(&maps).unwrap();
            let (bounds, visited) = ifs.search();
            assert!(visited < 16 * (NODES + DEPTH as u32 * 256), "{visited}");
            let p = ifs.start();
            assert!(bounds.min.x <= p.x && p.x <= bounds.max.x && bounds.min.y <= p.y && p.y <= bounds.max.y);
        }
    }

    /// Two maps that shrink each axis by a positive factor: the attractor reaches from the least fixed point
    /// to the greatest, two fractions. Points a few units apart, so that no tolerance hides a rounding; far
    /// from the origin and near it, fast contractions and slow ones.
    #[test]
    fn the_hull_is_rounded_outwards_to_the_unit() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(20);
        let (mut checked, mut tight) = (0, 0);
        for k in 0..250 {
            let apart = [4, 100, 1 << 20][k % 3];
            let far = [60 << 24, 1 << 20][k % 2];
            let slow = if k % 25 == 0 { (1 << 30) - (1 << 25) } else { 0 };
            let place = [(); 2].map(|()| (i64::from(rng.next_u32() as i32) * far) >> 31);
            let maps = [(); 2].map(|()| {
                let factors = [(); 2].map(|()| slow.max((rng.next_u32() >> 2) as i64 * 15 / 16));
                // the fixed point within a few units of a place both maps share
                let [e, f] = [0, 1].map(|i: usize| {
                    let fixed = place[i] + i64::from(rng.next_u32() % apart);
                    Real::from_bits(((fixed * ((1 << 30) - factors[i])) >> 30) as i32)
                });
                let [a, d] = factors.map(|f| Unit::from_bits(f as i32));
                Affine::new([a, Unit::ZERO, Unit::ZERO, d], [e, f])
            });
            let Ok(ifs) = Ifs::<2>::new(&maps, &[Unit::from_num(0.5); 2]) else { continue };
            let mut search = Search::new(ifs.maps(), ifs.invariant_disc(), ifs.start(), ifs.deviation());
            search.reach(ifs.start());
            let (bounds, _) = search.run();
            let [right, left, top, bottom] = search.sides.map(|side| i128::from(side.hull));
            checked += 1;
            // whatever is within the deviation lies inside, or within the disc
            let deviation = i128::from(ifs.deviation());
            let ends = [bounds.max.x, -bounds.min.x, bounds.max.y, -bounds.min.y];
            for (end, side) in ends.into_iter().zip(search.sides) {
                let wanted = (i128::from(side.hull) + deviation).min(side.disc.into());
                assert_eq!(i128::from(end.to_bits()), wanted, "{maps:?}");
            }
            let mut spare = i128::MAX;
            for map in maps {
                for (factor, t, low, high) in [(map.a, map.e, -left, right), (map.d, map.f, -bottom, top)] {
                    // low <= t / (1 - factor) <= high
                    let gap = (1 << 30) - i128::from(factor.to_bits());
                    let t = i128::from(t.to_bits()) << 30;
                    assert!(low * gap <= t && t <= high * gap, "{maps:?}: {low} {t} / {gap} {high}");
                    spare = spare.min(high * gap - t).min(t - low * gap);
                }
            }
            tight += u32::from(spare < 1 << 27);
            for p in ifs.seeded_chaos_game(k as u64).take(200) {
                let inside =
                    bounds.min.x <= p.x && p.x <= bounds.max.x && bounds.min.y <= p.y && p.y <= bounds.max.y;
                assert!(inside, "{maps:?}: {p:?} {bounds:?}");
            }
        }
        assert!(checked > 200 && tight > 15, "{tight} of {checked}");
    }

    #[test]
    fn a_single_point_has_a_box_of_a_few_units() {
        let map = Affine::from_thousandths([300, -400, 400, 300, 1000, -2000]);
        let ifs = Ifs::<1>::new(&[map], &[Unit::ONE]).unwrap();
        let [left, right, bottom, top] = sides(ifs.bounds());
        let p = map.fixed_point().unwrap();
        let (x, y) = (p.x.to_num::<f64>(), p.y.to_num::<f64>());
        assert!(left <= x && x <= right && bottom <= y && y <= top);
        assert!(right - left < 1e-6 && top - bottom < 1e-6, "{left} {right} {bottom} {top}");
    }

    /// Appending a map rounds both entries by half a unit at most: what that changes at the corner of a
    /// node's reach is below the widening, and reaches it.
    #[test]
    fn a_letter_widens_a_node_by_what_its_rounding_may_change() {
        let ifs = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
        let disc = ifs.invariant_disc();
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(9);
        let mut most = 0;
        for k in 0..20_000 {
            // the sum of both reaches odd and even
            let centre = Point2::new(Real::from_bits(disc.centre.x.to_bits() + k % 2), disc.centre.y);
            let disc = Disc { centre, ..disc };
            let search = Search::new(ifs.maps(), disc, ifs.start(), 0);
            let [x, y] = disc.reach();
            let mut entry = || if k % 3 == 0 { 1 << 29 } else { (rng.next_u32() as i32) >> 2 };
            let map = Affine::new([entry(), entry(), entry(), entry()].map(Unit::from_bits), [Real::ZERO; 2]);
            // (1, 0) at the end: a half in each entry is half a unit
            let r = if k % 3 == 0 { [1, 0] } else { [entry(), entry()] };
            let after = Functional { r, t: 0 }.after(&map);
            let [r, s] = r.map(i128::from);
            let [a, b, c, d] = [map.a, map.b, map.c, map.d].map(|l| i128::from(l.to_bits()));
            let exact = [r * a + s * c, r * b + s * d];
            let off = [0, 1].map(|i: usize| ((i128::from(after.r[i]) << 30) - exact[i]).abs());
            assert!(off.iter().all(|off| *off <= 1 << 29));
            let change = off[0] * i128::from(x) + off[1] * i128::from(y);
            assert!(change <= i128::from(search.widening) << 30, "{map:?} {r} {s}");
            most = most.max(change - ((i128::from(search.widening) - 1) << 30));
        }
        // an odd sum: half a unit of 2^-54 more than is left when it is halved
        assert_eq!(most, 1 << 29);
    }

    /// What a functional reaches in disc and box, from above: the nearer of the two, and by less than a unit
    /// of the norm.
    #[test]
    fn the_highest_value_in_disc_and_box_is_bounded_closely() {
        let at = |x: i32, y: i32| Point2::new(Real::from_bits(x), Real::from_bits(y));
        let disc = Disc { centre: at(1 << 20, -(3 << 20)), radius: Real::from_bits(5 << 20) };
        let mut search = Search::new(&[], disc, disc.centre, 0);
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(10);
        let mut by_box = 0;
        for k in 0..20_000 {
            let r = [(); 2].map(|()| (rng.next_u32() as i32) >> (2 + k % 20));
            for (side, hull) in search.sides.iter_mut().zip([5 << 20, 4 << 20, 3 << 19, 7 << 20]) {
                side.hull = if k % 2 == 0 { side.disc } else { hull };
            }
            let [r0, r1] = r.map(i128::from);
            let norm = (r0 * r0 + r1 * r1).isqrt();
            let centre = r0 * (1 << 20) - r1 * (3 << 20);
            let root = norm + i128::from(norm * norm < r0 * r0 + r1 * r1);
            let round = centre + root * (5 << 20);
            let [right, left, top, bottom] = search.sides.map(|side| i128::from(side.hull));
            let corner = (r0 * right).max(-r0 * left) + (r1 * top).max(-r1 * bottom);
            let got = i128::from(search.highest(&Functional { r, t: 7 }));
            assert_eq!(got, 7 + round.min(corner), "{r:?}");
            by_box += i32::from(corner < round);
        }
        assert!(by_box > 1000, "{by_box}");
    }

    /// Centre and radius, and the centre less the radius turned round.
    #[test]
    fn a_side_begins_at_the_disc() {
        let disc = Disc {
            centre: Point2::new(Real::from_bits(1000), Real::from_bits(-70)),
            radius: Real::from_bits(500),
        };
        let search = Search::new(&[], disc, disc.centre, 3);
        assert_eq!(
            search.sides.map(|side| (side.disc, side.hull)),
            [(1500, 1500), (-500, -500), (430, 430), (570, 570)]
        );
        assert_eq!((search.widening, search.deviation), ((1500 + 570) / 2 + 1, 3 << 30));
    }

    /// A search that finds no end visits as many nodes as it may, and those on the stack.
    #[test]
    fn a_search_without_end_visits_16384_nodes() {
        let mut maps = [Affine::from_thousandths([600, -500, 500, 600, 300, 700]); 256];
        for (i, map) in maps.iter_mut().enumerate() {
            map.e = Real::from_bits(i as i32);
        }
        let visited = Ifs::<256>::proportional_to_determinant(&maps).unwrap().search().1;
        assert!(visited >= NODES, "{visited}");
    }
}
