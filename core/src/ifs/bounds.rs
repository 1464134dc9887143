//! The bounding box of an attractor, without sampling: branch and bound over addresses.
//!
//! The support function of the attractor, `h(u) = max { u . p : p in A }`, is the maximum over addresses `j_1 .. j_k` of the support function of
//! `w_j1 o .. o w_jk (A)`. Only one row of each composed map matters: `u . w_j1 o .. o w_jk (p) = r . p + t`, and appending a map sends
//! `(r, t)` to `(r L_j, t + r . t_j)`. With any set `K` that contains `A`, `max_K (r . p + t)` bounds the node from above; a point of `A` bounds `h` from below.
//! A node that cannot raise the lower bound by more than a tolerance is not opened. `K` is the intersection of the invariant disc and of the box found so far:
//! four passes, each with an eighth of the tolerance before, tighten the box first where it is cheap.
//!
//! Source: the recursion is Hutchinson's `A = u w_j(A)`; branch and bound is A. H. Land and A. G. Doig, 1960.
//! Formats: `r` has 30 fractional bits, `t` 54. Appending a map is exact in `t` and rounds `r` by `2^-31` an entry, which changes the value
//! at a point of the disc by at most `(|x| + |y|) 2^-31`; a node at depth `k` is widened by `k` times as much.

use heapless::Vec;

use super::affine::{Affine, hypotenuse};
use super::disc::Disc;
use super::system::Ifs;
use crate::num::Real;
use crate::picture::{Bounds2, Point2};

/// The longest address that is opened: the capacity of the stack, which holds one entry for each letter.
const DEPTH: usize = 128;

/// How many nodes one search may visit before it stops opening them.
const NODES: u32 = 1 << 14;

/// Tolerances of the passes: the larger extent divided by a power of two.
const PASSES: [u32; 4] = [3, 6, 9, 12];

/// One unit in the last place of [`Real`], with 54 fractional bits.
const ULP: i64 = 1 << 30;

impl<const N: usize> Ifs<N> {
    /// A box that contains the attractor and each point of each chaos game.
    ///
    /// Error: outwards, and in each direction by less than `2^-11` of the larger extent and twice [`Ifs::deviation`]
    /// (`bounds_are_those_of_the_textbooks`), as long as no address of more than 128 letters is needed (contraction factors up to about 0.93)
    /// and no direction visits more than 16384 nodes; beyond that still outwards, but wider (`slow_spirals_are_bounded_all_the_same`).
    /// Cost: a node is 8 multiplications and a square root; the catalogue's attractors visit between NODES_MIN and NODES_MAX of them
    /// (`the_search_is_short_for_the_catalogue`). Stack: 128 entries of 24 bytes.
    pub fn bounds(&self) -> Bounds2 {
        Search::new(self).run().0
    }
}

/// `r . p + t`.
#[derive(Debug, Clone, Copy)]
struct Functional {
    r: [i32; 2],
    t: i64,
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

    fn linear(&self, p: Point2) -> i64 {
        let [r, s] = self.r.map(i64::from);
        r * i64::from(p.x.to_bits()) + s * i64::from(p.y.to_bits())
    }

    fn at(&self, p: Point2) -> i64 {
        self.t + self.linear(p)
    }
}

struct Node {
    functional: Functional,
    /// The next map to append.
    next: usize,
}

/// The four directions: the index of the coordinate, and the sign.
const DIRECTIONS: [(usize, i32); 4] = [(0, 1), (0, -1), (1, 1), (1, -1)];

struct Search<'a> {
    maps: &'a [Affine],
    disc: Disc,
    /// Contains the attractor: what the searches tighten.
    hull: Bounds2,
    /// A point of the attractor, within one unit.
    probe: Point2,
    /// How much one letter widens a node.
    widening: i64,
    deviation: i64,
    /// Values that the attractor is known to reach in each direction.
    reached: [i64; 4],
}

impl<'a> Search<'a> {
    fn new<const N: usize>(ifs: &'a Ifs<N>) -> Self {
        let disc = ifs.invariant_disc();
        let probe = ifs.start();
        let deviation = i64::from(ifs.deviation());
        let mut reached = [i64::MIN; 4];
        for p in ifs.seeded_chaos_game(0).take(256).chain([probe]) {
            for (value, (axis, sign)) in reached.iter_mut().zip(DIRECTIONS) {
                let bits = if axis == 0 { p.x.to_bits() } else { p.y.to_bits() };
                *value = (*value).max((i64::from(bits) * i64::from(sign) - deviation) * ULP);
            }
        }
        let [x, y] = disc.reach();
        // the reach in units of 2^-24, times 2^-31, with 54 fractional bits
        let widening = (x + y).div_euclid(2) + 1;
        Self { maps: ifs.maps(), disc, hull: disc_box(disc), probe, widening, deviation, reached }
    }

    /// The bounds, and how many nodes were visited.
    fn run(mut self) -> (Bounds2, u32) {
        let mut visited = 0;
        for shift in PASSES {
            let [right, left, top, bottom] = self.reached;
            let extent = (right + left).max(top + bottom).max(0);
            let tolerance = (extent >> shift) + ULP;
            for (index, (axis, sign)) in DIRECTIONS.into_iter().enumerate() {
                let r = if axis == 0 { [sign * (1 << 30), 0] } else { [0, sign * (1 << 30)] };
                let known = self.reached.get(index).copied().unwrap_or(i64::MIN);
                let found = self.support(Functional { r, t: 0 }, known, tolerance);
                visited += found.visited;
                if let Some(value) = self.reached.get_mut(index) {
                    *value = found.reached;
                }
                // up to a unit in the last place, not beyond what is known
                let bits = (found.bound + ULP - 1) >> 30;
                tighten(&mut self.hull, index, bits);
            }
        }
        let mut bounds = self.hull;
        let widened = |side: Real, by: i64, low: Real, high: Real| {
            let bits = i64::from(side.to_bits()) + by;
            Real::from_bits(bits.clamp(i64::from(low.to_bits()), i64::from(high.to_bits())) as i32)
        };
        let disc = disc_box(self.disc);
        bounds.min.x = widened(bounds.min.x, -self.deviation, disc.min.x, disc.max.x);
        bounds.min.y = widened(bounds.min.y, -self.deviation, disc.min.y, disc.max.y);
        bounds.max.x = widened(bounds.max.x, self.deviation, disc.min.x, disc.max.x);
        bounds.max.y = widened(bounds.max.y, self.deviation, disc.min.y, disc.max.y);
        (bounds, visited)
    }

    /// Bounds of the support function in the direction of `root`, with 54 fractional bits.
    fn support(&self, root: Functional, known: i64, tolerance: i64) -> Support {
        let mut found = Support { bound: known, reached: known, visited: 0 };
        let mut stack: Vec<Node, DEPTH> = Vec::new();
        let mut candidate = Some(root);
        loop {
            if let Some(functional) = candidate.take() {
                found.visited += 1;
                let slack = self.widening * stack.len() as i64;
                let highest = self.highest(&functional) + slack;
                found.reached = found.reached.max(functional.at(self.probe) - slack - ULP);
                let open = highest > found.reached + tolerance && found.visited < NODES;
                if !open || stack.push(Node { functional, next: 0 }).is_err() {
                    found.bound = found.bound.max(highest);
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
        found.bound = found.bound.max(found.reached);
        found
    }

    /// The largest value in the disc and in the box.
    fn highest(&self, f: &Functional) -> i64 {
        let [r, s] = f.r;
        let Bounds2 { min, max } = self.hull;
        let corner = Point2::new(if r < 0 { min.x } else { max.x }, if s < 0 { min.y } else { max.y });
        let norm = hypotenuse(i64::from(r), i64::from(s)) as i64;
        f.at(corner).min(f.at(self.disc.centre) + norm * i64::from(self.disc.radius.to_bits()))
    }
}

struct Support {
    /// At least the support function.
    bound: i64,
    /// At most the support function.
    reached: i64,
    visited: u32,
}

/// Moves one side of the box inwards to a value in its direction.
fn tighten(hull: &mut Bounds2, direction: usize, bits: i64) {
    let clamped = |bits: i64| Real::from_bits(bits.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32);
    match direction {
        0 => hull.max.x = hull.max.x.min(clamped(bits)),
        1 => hull.min.x = hull.min.x.max(clamped(-bits)),
        2 => hull.max.y = hull.max.y.min(clamped(bits)),
        _ => hull.min.y = hull.min.y.max(clamped(-bits)),
    }
}

/// The box around a disc that reaches no farther than 64.
fn disc_box(disc: Disc) -> Bounds2 {
    let side = |z: Real, by: i32| Real::from_bits(z.to_bits().saturating_add(by));
    let r = disc.radius.to_bits();
    Bounds2 {
        min: Point2::new(side(disc.centre.x, -r), side(disc.centre.y, -r)),
        max: Point2::new(side(disc.centre.x, r), side(disc.centre.y, r)),
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::ifs::catalogue::{self, LARGEST};
    use crate::num::Unit;

    fn sides(b: Bounds2) -> [f64; 4] {
        [b.min.x, b.max.x, b.min.y, b.max.y].map(|z| z.to_num())
    }

    #[test]
    fn print_them() {
        for attractor in catalogue::ALL {
            let ifs = attractor.ifs::<LARGEST>().unwrap();
            let (bounds, visited) = Search::new(&ifs).run();
            let disc = ifs.invariant_disc();
            std::println!(
                "{:18} {:?} nodes {visited} disc {} {} {} s {} dev {}",
                attractor.name,
                sides(bounds),
                disc.centre.x,
                disc.centre.y,
                disc.radius,
                ifs.contraction_factor(),
                ifs.deviation()
            );
            let mut got = [f64::MAX, f64::MIN, f64::MAX, f64::MIN];
            for p in ifs.seeded_chaos_game(1).take(1000000) {
                let (x, y) = (p.x.to_num::<f64>(), p.y.to_num::<f64>());
                got = [got[0].min(x), got[1].max(x), got[2].min(y), got[3].max(y)];
            }
            std::println!("{:18} {:?}", "", got);
        }
    }
}
