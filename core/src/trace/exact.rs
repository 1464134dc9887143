//! The first leaf that a ray meets by the definition of a picture, in fractions: what both walks are compared
//! with.
//!
//! A ray is above a node from its last plane of entry to its first of exit. A node's parts are tried in the
//! order in which the ray comes above them; the first that it meets and that is small enough is the leaf.

use core::cmp::Ordering;
use std::vec::Vec;

use super::height_field::boxes::range;
use super::height_field::hierarchy::{Hierarchy, Profile};
use super::height_field::statistics::Statistics;
use super::ray::Ray;
use crate::fif::{Cell, Fif, Knot, Pyramid};
use crate::num::{Real, Scaling, Wide};

/// A fraction with a denominator above 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fraction(i128, i128);

impl Fraction {
    pub(super) fn new(numerator: i128, denominator: i128) -> Self {
        Self(numerator * denominator.signum(), denominator.abs())
    }

    fn compare(self, other: Self) -> Ordering {
        (self.0 * other.1).cmp(&(other.0 * self.1))
    }

    fn max(self, other: Self) -> Self {
        if self.compare(other).is_lt() { other } else { self }
    }

    fn min(self, other: Self) -> Self {
        if self.compare(other).is_gt() { other } else { self }
    }

    /// Whether it is within `units` of the other.
    pub(super) fn is_within(self, units: i128, other: Self) -> bool {
        (self.0 * other.1 - other.0 * self.1).abs() <= units * self.1 * other.1
    }
}

/// Cells of two factors made up at random, each the hull of its parts.
pub(super) struct Surface {
    factors: [(Vec<Cell>, Vec<u32>); 2],
    depth: u32,
    domain: [[i32; 2]; 2],
}

impl Surface {
    /// `starts` with 31 fractional bits and `[origin, width]` with 24, for x and y.
    pub(super) fn new(starts: [&[u32]; 2], depth: u32, domain: [[i32; 2]; 2], seed: u64) -> Self {
        let mut word = words(seed);
        let factors = starts.map(|starts| {
            let (n, leaves) = (starts.len(), starts.len().pow(depth));
            let mut cells = std::vec![Cell::ZERO; Pyramid::cells(n, depth)];
            let first = cells.len() - leaves;
            for cell in &mut cells[first..] {
                let min = (word() >> 40) as i32 - (1 << 22);
                (cell.min, cell.max) = (Real::from_bits(min), Real::from_bits(min + (word() >> 42) as i32));
            }
            for q in (0..first).rev() {
                let parts = &cells[n * q + 1..][..n];
                let (min, max) = (parts.iter().map(|c| c.min).min(), parts.iter().map(|c| c.max).max());
                (cells[q].min, cells[q].max) = (min.unwrap(), max.unwrap());
            }
            (cells, starts.to_vec())
        });
        Self { factors, depth, domain }
    }

    pub(super) fn hierarchy(&self) -> Hierarchy<'_> {
        let profile = |k: usize| Profile {
            cells: &self.factors[k].0,
            starts: &self.factors[k].1,
            origin: self.domain[k][0],
            width: self.domain[k][1],
        };
        let (x, y) = (profile(0), profile(1));
        let leaves = self.depth.checked_sub(1).map_or(0, |d| Pyramid::cells(x.starts.len(), d) as u32);
        Hierarchy { x, y, depth: self.depth, leaves, heights: range(&x.cells[0], &y.cells[0]) }
    }

    /// Rays from around, above, below and inside, most of them towards the surface; every eighth so steep
    /// that it may be 64 away where it leaves the surface.
    pub(super) fn rays(&self, seed: u64, count: usize) -> impl Iterator<Item = Ray> + '_ {
        let mut word = words(seed);
        let (low, high) = self.hierarchy().heights;
        let middles = [self.domain[0], self.domain[1], [low, high - low]].map(|[from, size]| from + size / 2);
        let mut place = move |spread: u32| middles.map(|m| m + ((word() >> 32) as i32 >> spread));
        (0..count).map(move |k| {
            // eyes within 1 to 2 of the middle, targets within 1/2, parameters of a target 1 to 8
            let (mut eye, target) = (place([7, 6, 6, 8][k % 4]), place(8));
            let mut direction = [0, 1, 2].map(|i| (target[i] - eye[i]) << 4 >> (k % 3));
            if k % 8 == 7 {
                // 1/64 to 1/16 along the surface, 4 up or down, 6 to 14 before the target
                let sign = |i: usize| if direction[i] < 0 { -1 } else { 1 };
                let t = (6 << 24) + (eye[2] & ((1 << 27) - 1));
                direction = [0, 1, 2].map(|i| {
                    let along = (1 << 22) + (eye[i] & ((1 << 24) - (1 << 22)));
                    sign(i) * if i == 2 { (1 << 30) - along } else { along }
                });
                eye = [0, 1, 2].map(|i| target[i] - ((i64::from(direction[i]) * i64::from(t)) >> 28) as i32);
            }
            Ray::from_bits(eye, direction)
        })
    }
}

/// The pyramid of a polygon: what is known of it is exact, but for the last unit outward.
pub(super) fn with_polygon<R>(knots: &[(Wide, Wide)], depth: u32, then: impl FnOnce(&Pyramid<'_>) -> R) -> R {
    let knots: Vec<_> = knots.iter().map(|(x, y)| Knot::new(*x, *y)).collect();
    let scalings = std::vec![Scaling::ZERO; knots.len() - 1];
    let polygon = Fif::<4, 1>::interpolating(&knots, &scalings).unwrap();
    let mut memory = std::vec![Cell::ZERO; Pyramid::cells(scalings.len(), depth)];
    then(&Pyramid::new(&polygon, depth, &mut memory).unwrap())
}

/// A seeded sequence of words.
pub(super) fn words(seed: u64) -> impl FnMut() -> u64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        state ^ state >> 31
    }
}

/// What a walk should find.
#[derive(Debug)]
pub(super) struct Truth {
    pub(super) nodes: Option<(u32, u32)>,
    pub(super) span: [Fraction; 2],
    /// The rays and the box tests that it takes, and the deepest level whose parts were tried.
    pub(super) statistics: Statistics,
    /// The most nodes whose parts were not all tried at a time, that of the last part included.
    pub(super) unfinished: u32,
    /// Whether a decision hangs on less than [`SLACK`] units: walks round.
    pub(super) is_close: bool,
}

impl Truth {
    /// By how much a span is off, in sixteenths of a unit of the planes that limit it: a parameter's error
    /// times the least component of the direction.
    pub(super) fn error(&self, span: (i32, i32), ray: &Ray) -> i128 {
        let least = ray.direction.iter().map(|d| i128::from(d.unsigned_abs().max(1))).min().unwrap();
        let error = |(got, exact): (i32, Fraction)| {
            (i128::from(got) * exact.1 - exact.0).abs() * (16 * least) / (exact.1 << 28)
        };
        error((span.0, self.span[0])).max(error((span.1, self.span[1])))
    }
}

/// What decides between two nodes must be this many units of `2^-24` apart to be decided.
const SLACK: i128 = 64;

struct Search<'a> {
    hierarchy: &'a Hierarchy<'a>,
    origin: [i128; 3],
    direction: [i128; 3],
    per_t: i128,
    /// Whether boxes that are met for certain, or nearly so, are not tested.
    spares: bool,
    truth: Truth,
}

#[derive(Clone, Copy)]
struct Node {
    level: u32,
    index: (u32, u32),
    /// Ends along x and y with 40 fractional bits.
    ends: [[i128; 2]; 2],
    span: [Fraction; 2],
}

/// The first leaf of `ray`, for a footprint with 30 fractional bits. `general`: as the walk through any parts
/// finds it, which tries none beyond where the ray leaves the range of all heights, and tests every one.
pub(super) fn first_leaf(hierarchy: &Hierarchy<'_>, ray: &Ray, per_t: i32, general: bool) -> Truth {
    let zero = Fraction(0, 1);
    let truth = Truth {
        nodes: None,
        span: [zero; 2],
        statistics: Statistics { rays: 1, box_tests: 1, stack: 0 },
        unfinished: 0,
        is_close: false,
    };
    // a component of 0 counts as a unit
    let direction = ray.direction.map(|d| if d == 0 { 1 } else { i128::from(d) });
    let origin = ray.origin.map(|o| i128::from(o) << 16);
    let mut search = Search { hierarchy, origin, direction, per_t: per_t.into(), spares: !general, truth };
    let ends =
        [hierarchy.x, hierarchy.y].map(|p| [p.origin, p.origin + p.width].map(|e| i128::from(e) << 16));
    let everywhere = [zero, Fraction(i128::from(i32::MAX), 1)];
    let over = search.above(1, ends[1], search.above(0, ends[0], everywhere));
    let heights = [hierarchy.heights.0, hierarchy.heights.1].map(|e| i128::from(e) << 16);
    let inside = search.above(2, heights, over);
    search.truth.is_close |= inside[0].is_within(SLACK, inside[1]) || over[0].is_within(SLACK, over[1]);
    if inside[0].compare(inside[1]).is_lt() {
        let span = [inside[0], if general { inside[1] } else { over[1] }];
        search.descend(Node { level: 0, index: (0, 0), ends, span }, 0);
    }
    search.truth
}

impl Search<'_> {
    /// The parameter at a plane across an axis, 24 fractional bits.
    fn crossing(&self, axis: usize, plane: i128) -> Fraction {
        Fraction::new((plane - self.origin[axis]) << 12, self.direction[axis])
    }

    /// The part of a span between two planes.
    fn above(&self, axis: usize, [low, high]: [i128; 2], [from, to]: [Fraction; 2]) -> [Fraction; 2] {
        let (a, b) = (self.crossing(axis, low), self.crossing(axis, high));
        [from.max(a.min(b)), to.min(a.max(b))]
    }

    /// Whether the ray meets a node's box above its span: heights with 48 fractional bits.
    fn meets(&mut self, node: &Node) -> bool {
        let cell = |p: &Profile<'_>, q: u32| {
            let cell = p.cells[q as usize];
            [cell.min, cell.max].map(|e| i128::from(e.to_bits()))
        };
        let (f, g) = (cell(&self.hierarchy.x, node.index.0), cell(&self.hierarchy.y, node.index.1));
        let products = f.map(|a| g.map(|b| a * b));
        let products = products.as_flattened();
        let (low, high) = (products.iter().min().unwrap(), products.iter().max().unwrap());
        let [a, b] =
            node.span.map(|t| Fraction((self.origin[2] << 8) * t.1 + ((self.direction[2] * t.0) >> 4), t.1));
        let (low, high) = (Fraction(*low, 1), Fraction(*high, 1));
        let (least, most) = (a.min(b), a.max(b));
        self.truth.is_close |= least.is_within(SLACK << 24, high) || most.is_within(SLACK << 24, low);
        least.compare(high).is_le() && most.compare(low).is_ge()
    }

    fn is_leaf(&mut self, node: &Node) -> bool {
        let width = node.ends.iter().map(|[low, high]| high - low).max().unwrap();
        let reached = Fraction(node.span[0].0 * self.per_t, node.span[0].1);
        let width = Fraction(width << 14, 1);
        self.truth.is_close |= reached.is_within((width.0 >> 12).max(SLACK << 30), width);
        node.level == self.hierarchy.depth || reached.compare(width).is_ge()
    }

    /// Whether a leaf is found in a node that the ray meets, inside of so many whose parts are not all tried.
    fn descend(&mut self, node: Node, around: u32) -> bool {
        if self.is_leaf(&node) {
            (self.truth.nodes, self.truth.span) = (Some(node.index), node.span);
            return true;
        }
        self.truth.statistics.stack = self.truth.statistics.stack.max(node.level + 1);
        self.truth.unfinished = self.truth.unfinished.max(around + 1);
        let parts = |axis: usize, profile: &Profile<'_>| -> Vec<[i128; 2]> {
            let [low, high] = node.ends[axis];
            let planes = profile.starts.iter().map(|s| low + (((high - low) * i128::from(*s)) >> 31));
            let planes: Vec<_> = planes.chain([high]).collect();
            planes.windows(2).map(|w| [w[0], w[1]]).collect()
        };
        let (across, along) = (parts(0, &self.hierarchy.x), parts(1, &self.hierarchy.y));
        let number = |q: u32, parts: usize, k: usize| q * parts as u32 + 1 + k as u32;
        let mut passed: Vec<Node> = Vec::new();
        for (i, x) in across.iter().enumerate() {
            for (j, y) in along.iter().enumerate() {
                let span = self.above(1, *y, self.above(0, *x, node.span));
                self.truth.is_close |= span[0].is_within(SLACK, span[1]);
                if span[0].compare(span[1]).is_lt() {
                    let index = (number(node.index.0, across.len(), i), number(node.index.1, along.len(), j));
                    passed.push(Node { level: node.level + 1, index, ends: [*x, *y], span });
                }
            }
        }
        passed.sort_by(|a, b| a.span[0].compare(b.span[0]));
        // whether the part before was gone into; the first of the surface is taken for met
        let mut entered = node.level == 0;
        for (k, part) in passed.iter().enumerate() {
            let is_far = |axis: usize, q: u32| q.is_multiple_of(2) == (self.direction[axis] > 0);
            let is_last = k > 0 && is_far(0, part.index.0) && is_far(1, part.index.1);
            if !(self.spares && (entered || is_last) && !self.is_leaf(part)) {
                self.truth.statistics.box_tests += 1;
                entered = self.meets(part);
                if !entered {
                    continue;
                }
            }
            entered = true;
            if self.descend(*part, around + u32::from(k + 1 < passed.len())) {
                return true;
            }
        }
        false
    }
}
