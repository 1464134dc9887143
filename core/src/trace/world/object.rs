//! An object: a Boolean function of the shapes of which it is made, as a program.
//!
//! The bowl `(S1 - S2) - C` of the text, as data: `S1 S2 - C -`, reverse Polish. Whether a point is inside is
//! found from one bit for each shape, in a pass over the program with a stack of bits in a word; up to five
//! shapes have a table of all answers. A ray crosses no shape of a part that it misses: the box of every
//! union and intersection is stored beside its step and tried first, an intersection's is what both parts
//! have in common; and of an intersection or a difference the right part is tried only by a ray that meets
//! the left.
//!
//! Source: the course unit V, section 5.10.

use super::super::ball::Ball;
use super::super::ray::Ray;
use super::super::surface::{Extent, Surface};
use super::states::{bit, has};
use crate::Error;
use crate::num::Wide;

/// A step of an object's program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Op {
    /// A leaf of the world by its number.
    Leaf(u8),
    /// What is in one of the last two or in both.
    Union,
    /// What is in both of the last two.
    Intersection,
    /// What is in the last but one and not in the last.
    Difference,
}

/// A thing of a world: one leaf, or a compound of several.
#[derive(Debug, Clone, Copy)]
pub struct Object<'a> {
    ops: &'a [Op],
    extents: &'a [Extent],
    extent: Extent,
    /// A ball that holds it, and the leaves of which nothing is known where a ray passes it by.
    pub(super) ball: Ball,
    pub(super) others: u64,
    /// Its leaf, where it has only one; and whether a ray that leaves that has left it for good, to the
    /// outside and to the inside.
    only: Option<u8>,
    is_left: [bool; 2],
    /// A bit for each step: whether the leaf there begins the right part of an intersection or a difference.
    guarded: [u32; 4],
    /// Whether a union or an intersection has boxes to be tried.
    is_boxed: bool,
    /// Whether it is what others have left of its first leaf: each is taken away in turn.
    is_carved: bool,
    /// Of an object with five leaves at most that are numbered from `first` on, in the order of the program:
    /// whether a point is inside, by the bits of its leaves.
    table: Option<u32>,
    first: u8,
}

/// The most leaves of a world: one bit each.
pub(super) const LEAVES: usize = 64;

impl<'a> Object<'a> {
    /// How many boxes [`Object::new`] is to be lent for a program of so many steps.
    pub const fn extents(ops: usize) -> usize {
        ops
    }

    /// The object that a program makes of these surfaces, the leaves of the world. Its boxes are kept in
    /// `memory`.
    ///
    /// # Errors
    /// [`Error::TooFew`] for an empty program or a step without operands, [`Error::Capacity`] for more than
    /// 64 leaves, [`Error::LengthMismatch`] if more than one thing is left at the end, [`Error::OutOfRange`]
    /// for a leaf that is not there, [`Error::Unsupported`] for an open surface in a compound,
    /// [`Error::BufferLength`] for too little memory.
    pub fn new<'s, L: Surface + 's>(
        ops: &'a [Op],
        surface: impl Fn(usize) -> Option<&'s L>,
        memory: &'a mut [Extent],
    ) -> Result<Self, Error> {
        let needed = Self::extents(ops.len());
        if memory.len() < needed {
            return Err(Error::BufferLength { what: "boxes of an object", given: memory.len(), needed });
        }
        if ops.len() >= 2 * LEAVES {
            let needed = ops.len() / 2 + 1;
            return Err(Error::Capacity { what: "leaves of an object", needed, capacity: LEAVES });
        }
        let mut height = 0_usize;
        for (index, op) in ops.iter().enumerate() {
            let extent = match *op {
                Op::Leaf(leaf) => {
                    height += 1;
                    let Some(surface) = surface(leaf.into()) else {
                        let (value, max) = (Wide::from_num(leaf), Wide::from_num(LEAVES as u8 - 1));
                        return Err(Error::OutOfRange {
                            what: "number of a leaf",
                            index: Some(index),
                            value,
                            min: Wide::ZERO,
                            max,
                        });
                    };
                    if ops.len() > 1 && !surface.is_closed() {
                        return Err(Error::Unsupported {
                            what: "open shape in a compound",
                            allowed: "closed shapes",
                        });
                    }
                    surface.extent()
                }
                operation => {
                    if height < 2 {
                        return Err(Error::TooFew {
                            what: "operands of a compound",
                            given: height,
                            at_least: 2,
                        });
                    }
                    height -= 1;
                    let right = index.saturating_sub(1);
                    let left = begin(ops, right).saturating_sub(1);
                    let box_of = |k: usize| memory.get(k).copied().unwrap_or(Extent::NOTHING);
                    let (left, right) = (box_of(left), box_of(right));
                    match operation {
                        Op::Union => left.hull(right),
                        Op::Intersection => left.overlap(right),
                        _ => left,
                    }
                }
            };
            if let Some(place) = memory.get_mut(index) {
                *place = extent;
            }
        }
        match height {
            0 => Err(Error::TooFew { what: "steps of an object", given: 0, at_least: 1 }),
            1 => {
                let root = kept(ops);
                let extent = memory.get(root).copied().unwrap_or(Extent::NOTHING);
                let ball = match ops.get(root) {
                    Some(Op::Leaf(leaf)) => surface((*leaf).into()).map(Surface::ball),
                    _ => None,
                };
                let only = if let [Op::Leaf(leaf)] = ops { Some(*leaf) } else { None };
                let surface = only.and_then(|leaf| surface(leaf.into()));
                Ok(Self {
                    only,
                    is_left: surface.map_or([false; 2], is_left),
                    ops,
                    extents: memory.get(..ops.len()).unwrap_or(&[]),
                    extent: ops
                        .len()
                        .checked_sub(1)
                        .and_then(|last| memory.get(last).copied())
                        .unwrap_or(extent),
                    ball: ball.unwrap_or_else(|| Ball::round(extent.low, extent.high)),
                    others: 0,
                    guarded: [0; 4],
                    is_boxed: false,
                    is_carved: false,
                    table: None,
                    first: 0,
                }
                .prepared())
            }
            _ => Err(Error::LengthMismatch {
                what: "things that a program leaves",
                given: height,
                expected: 1,
            }),
        }
    }

    /// A leaf of its own, by its number and its surface.
    pub fn leaf(number: u8, surface: &impl Surface) -> Object<'static> {
        Object {
            ops: &[],
            extents: &[],
            extent: surface.extent(),
            ball: surface.ball(),
            others: 0,
            only: Some(number),
            is_left: is_left(surface),
            guarded: [0; 4],
            is_boxed: false,
            is_carved: false,
            table: Some(0xaaaa_aaaa),
            first: number,
        }
    }

    /// With what is found out of the program once for all rays.
    fn prepared(mut self) -> Self {
        for (index, op) in self.ops.iter().enumerate() {
            self.is_boxed |= matches!(op, Op::Union | Op::Intersection);
            if matches!(op, Op::Intersection | Op::Difference) {
                let leaf = begin(self.ops, index.saturating_sub(1));
                if let Some(word) = self.guarded.get_mut(leaf >> 5) {
                    *word |= 1 << (leaf & 31);
                }
            }
        }
        let first = self.leaves().next().unwrap_or(0);
        // a ray that passes the ball by misses the leaf that is the ball's
        let is_kept = |leaf| matches!(self.ops.get(kept(self.ops)), Some(Op::Leaf(own)) if *own == leaf);
        self.others = self.leaves().filter(|leaf| !is_kept(*leaf)).fold(0, |all, leaf| all | bit(leaf));
        let count = self.leaves().count();
        if count <= 5 && self.leaves().zip(first..).all(|(leaf, number)| leaf == number) {
            let bit = |states: u32| u32::from(self.is_inside(u64::from(states) << (first & 63))) << states;
            // bits of other leaves change nothing
            let table = (0..32).fold(0, |table, states| table | bit(states));
            (self.table, self.first) = (Some(table), first);
            // a difference after each leaf
            let mut rest = self.ops.iter().skip(1);
            self.is_carved = count > 1;
            while let Some(op) = rest.next() {
                self.is_carved &= matches!((op, rest.next()), (Op::Leaf(_), Some(Op::Difference)));
            }
        }
        self
    }

    /// The box that holds it.
    pub fn extent(&self) -> Extent {
        self.extent
    }

    /// Its leaves, in the order of the program.
    pub(super) fn leaves(&self) -> impl Iterator<Item = u8> + '_ {
        let alone = if self.ops.is_empty() { self.only } else { None };
        let of = |op: &Op| if let Op::Leaf(leaf) = op { Some(*leaf) } else { None };
        alone.into_iter().chain(self.ops.iter().filter_map(of))
    }

    /// Its only leaf.
    #[inline]
    pub(super) fn only(&self) -> Option<u8> {
        self.only
    }

    /// Whether a ray that starts from one of its leaves, outside or inside, cannot meet the object again: it
    /// is that leaf alone.
    #[inline]
    pub(super) fn is_left_by(&self, departed: u8, inside: u64) -> bool {
        self.only == Some(departed) && self.is_left[usize::from(has(inside, departed))]
    }

    /// The first leaf, and how many are taken away from it one by one, in the order of their numbers; none
    /// for an object that is made otherwise.
    #[inline]
    pub(super) fn carved(&self) -> Option<(u8, core::ops::Range<u8>)> {
        let next = self.first.saturating_add(1);
        self.is_carved.then_some((self.first, next..next.saturating_add(self.ops.len() as u8 / 2)))
    }

    /// The last of its leaves of which there is a bit.
    #[inline]
    pub(super) fn last_of(&self, leaves: u64) -> Option<u8> {
        match self.table {
            Some(_) => 63_u32.checked_sub(leaves.leading_zeros()).map(|leaf| leaf as u8),
            None => self.last_by_program(leaves),
        }
    }

    #[cold]
    #[inline(never)]
    fn last_by_program(&self, leaves: u64) -> Option<u8> {
        let mut last = None;
        for op in self.ops {
            match op {
                Op::Leaf(leaf) if has(leaves, *leaf) => last = Some(*leaf),
                _ => {}
            }
        }
        last
    }

    /// Whether a point is inside that is inside these leaves, a bit each.
    #[inline]
    pub(super) fn is_inside(&self, leaves: u64) -> bool {
        match self.table {
            Some(table) => table >> ((leaves >> (self.first & 63)) as u32 & 31) & 1 > 0,
            None => self.is_inside_by_program(leaves),
        }
    }

    #[inline(never)]
    fn is_inside_by_program(&self, leaves: u64) -> bool {
        // the top of the stack is the lowest bit
        let mut stack = 0_u64;
        for op in self.ops {
            let (last, rest) = (stack & 1, stack >> 1);
            stack = match *op {
                Op::Leaf(leaf) => stack << 1 | (leaves >> (leaf & 63)) & 1,
                Op::Union => rest | last,
                Op::Intersection => rest & (last | !1),
                Op::Difference => rest & !last,
            };
        }
        stack & 1 > 0
    }

    /// Has the leaves crossed that a ray may have to cross: `cross` answers whether any part of the ray is
    /// inside the leaf. Answers which were not crossed, a bit each.
    #[inline]
    pub(super) fn tried(&self, ray: &Ray, mut cross: impl FnMut(u8) -> bool) -> u64 {
        let met = if self.is_boxed { self.met(ray) } else { u64::MAX };
        // the top of the stack is the lowest bit: whether any part of the ray may be inside
        let (mut stack, mut untried) = (0_u64, 0);
        for (index, op) in self.ops.iter().enumerate() {
            let (last, rest) = (stack & 1, stack >> 1);
            stack = match *op {
                Op::Leaf(leaf) => {
                    let own = bit(leaf);
                    let guard = self.guarded.get(index >> 5).map_or(0, |word| word >> (index & 31) & 1);
                    let inside = if met & own > 0 && u64::from(guard) <= last {
                        u64::from(cross(leaf))
                    } else {
                        untried |= own;
                        0
                    };
                    stack << 1 | inside
                }
                Op::Union => rest | last,
                Op::Intersection => rest & (last | !1),
                Op::Difference => rest,
            };
        }
        untried
    }

    /// The leaves of parts whose boxes a ray meets, a bit each.
    fn met(&self, ray: &Ray) -> u64 {
        let axes = ray.axes();
        // from the root on, the right part first; a bit for each part that is still to come: whether its
        // parent is met
        let (mut parents, mut leaves) = (1_u64, 0);
        for (op, extent) in self.ops.iter().zip(self.extents).rev() {
            let parent = parents & 1;
            parents >>= 1;
            match op {
                Op::Leaf(leaf) => leaves |= parent.wrapping_neg() & bit(*leaf),
                // the box of a difference is that of its left part
                Op::Difference => parents = parents << 2 | parent << 1 | parent,
                _ => {
                    let node = u64::from(parent > 0 && extent.is_met(&axes));
                    parents = parents << 2 | node << 1 | node;
                }
            }
        }
        leaves
    }
}

/// Whether a ray that leaves a surface to the outside, or to the inside, has left it for good: a line has two
/// crossings with what is convex.
pub(super) fn is_left(surface: &impl Surface) -> [bool; 2] {
    let most = surface.most_crossings();
    [most <= 1 + u32::from(surface.is_closed()), most <= 1]
}

/// The step of what others are taken away from.
fn kept(ops: &[Op]) -> usize {
    let mut root = ops.len().saturating_sub(1);
    while let Some(Op::Difference) = ops.get(root) {
        root = begin(ops, root.saturating_sub(1)).saturating_sub(1);
    }
    root
}

/// The first step of the part whose last one is `last`.
fn begin(ops: &[Op], last: usize) -> usize {
    let (mut wanted, mut at) = (1_usize, last);
    while let Some(op) = ops.get(at) {
        wanted = if let Op::Leaf(_) = op { wanted.saturating_sub(1) } else { wanted + 1 };
        if wanted == 0 || at == 0 {
            break;
        }
        at -= 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use core::ops::ControlFlow;

    use super::super::super::surface::{Crossing, SurfacePoint};
    use super::*;
    use crate::num::{Real, Unit, Vec3};
    use std::boxed::Box;
    use std::vec::Vec;

    /// A box without crossings.
    struct Bounds(Extent, bool);

    impl Surface for Bounds {
        fn extent(&self) -> Extent {
            self.0
        }
        fn is_closed(&self) -> bool {
            self.1
        }
        fn most_crossings(&self) -> u32 {
            2
        }
        fn error(&self) -> Real {
            Real::ZERO
        }
        fn cross(&self, _: &Ray, _: Unit, _: &mut impl FnMut(Crossing) -> ControlFlow<()>) {}
        fn value(&self, _: Vec3) -> Wide {
            Wide::ZERO
        }
        fn point(&self, _: &Ray, _: Unit, _: &Crossing, _: bool) -> SurfacePoint {
            unreachable!("no crossings")
        }
    }

    fn at(x: i32, y: i32, z: i32) -> Vec3 {
        Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z))
    }

    fn unit_box(x: i32) -> Bounds {
        Bounds(Extent { low: at(x, 0, 0), high: at(x + 2, 2, 2) }, true)
    }

    enum Tree {
        Leaf(u8),
        Node(Op, Box<Tree>, Box<Tree>),
    }

    impl Tree {
        fn random(first: u8, count: u8, word: &mut impl FnMut() -> u64) -> Self {
            if count == 1 {
                return Self::Leaf(first);
            }
            let left = 1 + (word() % u64::from(count - 1)) as u8;
            let op = [Op::Union, Op::Intersection, Op::Difference][(word() % 3) as usize];
            let parts = [Self::random(first, left, word), Self::random(first + left, count - left, word)];
            let [a, b] = parts.map(Box::new);
            Self::Node(op, a, b)
        }

        fn program(&self, ops: &mut Vec<Op>) {
            match self {
                Self::Leaf(leaf) => ops.push(Op::Leaf(*leaf)),
                Self::Node(op, a, b) => {
                    a.program(ops);
                    b.program(ops);
                    ops.push(*op);
                }
            }
        }

        fn holds(&self, leaves: u64) -> bool {
            match self {
                Self::Leaf(leaf) => leaves >> leaf & 1 > 0,
                Self::Node(Op::Union, a, b) => a.holds(leaves) || b.holds(leaves),
                Self::Node(Op::Intersection, a, b) => a.holds(leaves) && b.holds(leaves),
                Self::Node(_, a, b) => a.holds(leaves) && !b.holds(leaves),
            }
        }
    }

    fn words() -> impl FnMut() -> u64 {
        let mut word = 9_u64;
        move || {
            word = word.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            word >> 33
        }
    }

    /// Against a recursive tree, for random trees and states; also a tree that leans to the right, which
    /// takes the deepest stack.
    #[test]
    fn a_program_is_the_boolean_function_of_its_tree() {
        let mut word = words();
        let surfaces: Vec<Bounds> = (0..64).map(|_| unit_box(0)).collect();
        let mut inside = 0;
        for k in 0..300_u32 {
            let tree = Tree::random(0, 1 + (k % 64) as u8, &mut word);
            let mut ops = Vec::new();
            tree.program(&mut ops);
            let mut memory = [Extent::NOTHING; 127];
            let object = Object::new(&ops, |leaf| surfaces.get(leaf), &mut memory).unwrap();
            for _ in 0..50 {
                let states = word() << 32 ^ word();
                assert_eq!(object.is_inside(states), tree.holds(states), "{ops:?} {states:b}");
                inside += u32::from(tree.holds(states));
            }
        }
        assert!((1000..14_000).contains(&inside), "{inside}");
        let mut ops: Vec<Op> = (0..64).map(Op::Leaf).collect();
        ops.extend([Op::Intersection; 63]);
        let mut memory = [Extent::NOTHING; 127];
        let object = Object::new(&ops, |leaf| surfaces.get(leaf), &mut memory).unwrap();
        assert!(
            object.is_inside(u64::MAX) && !object.is_inside(u64::MAX - 1) && !object.is_inside(u64::MAX / 2)
        );
    }

    /// The three early outs: a ray that misses what two parts have in common tries neither; one that misses
    /// the left part of a difference does not try the right one; parts of a union are tried each for itself.
    #[test]
    fn a_ray_tries_only_the_parts_that_it_may_need() {
        // boxes from 0 to 2, 1 to 3, 10 to 12 along x
        let surfaces = [unit_box(0), unit_box(1), unit_box(10)];
        let tried = |ops: &[Op], x: i32| {
            let mut memory = [Extent::NOTHING; 8];
            let object = Object::new(ops, |leaf| surfaces.get(leaf), &mut memory).unwrap();
            let mut leaves = Vec::new();
            // down along z, a little inside the edge
            let eye = Vec3::new(Real::from_num(x) + Real::from_num(0.5), Real::ONE, Real::from_num(9));
            let ray = Ray::new(eye, at(0, 0, -1));
            // as the ray would cross them
            let untried = object.tried(&ray, |leaf| {
                leaves.push(leaf);
                surfaces.get(usize::from(leaf)).is_some_and(|surface| surface.extent().is_met(&ray.axes()))
            });
            assert!((0..2).all(|leaf| leaves.contains(&leaf) != has(untried, leaf)), "{ops:?} {x}");
            leaves.sort_unstable();
            leaves
        };
        let both = |op| [Op::Leaf(0), Op::Leaf(1), op];
        for (op, x, expected) in [
            (Op::Union, 0, [0, 1].as_slice()),
            (Op::Union, 5, &[]),
            (Op::Intersection, 1, &[0, 1]),
            (Op::Intersection, 0, &[]),
            (Op::Intersection, 2, &[]),
            (Op::Difference, 0, &[0, 1]),
            (Op::Difference, 2, &[0]),
        ] {
            assert_eq!(tried(&both(op), x), expected, "{op:?} {x}");
        }
        let nested = [Op::Leaf(0), Op::Leaf(1), Op::Intersection, Op::Leaf(2), Op::Union];
        for (x, expected) in [(0, [].as_slice()), (1, &[0, 1, 2]), (10, &[2]), (5, &[2])] {
            assert_eq!(tried(&nested, x), expected, "{x}");
        }
    }

    #[test]
    fn what_is_no_program_is_refused() {
        let surfaces = [unit_box(0), Bounds(Extent::SPACE, false)];
        let refused = |ops: &[Op], memory: usize| {
            let mut memory = std::vec![Extent::NOTHING; memory];
            Object::new(ops, |leaf| surfaces.get(leaf), &mut memory)
                .map(|object| object.extent())
                .unwrap_err()
        };
        let (a, open) = (Op::Leaf(0), Op::Leaf(1));
        assert!(matches!(refused(&[], 9), Error::TooFew { given: 0, at_least: 1, .. }));
        assert!(matches!(refused(&[a, Op::Union], 9), Error::TooFew { given: 1, at_least: 2, .. }));
        assert!(matches!(refused(&[a, a], 9), Error::LengthMismatch { given: 2, expected: 1, .. }));
        assert!(matches!(refused(&[a, Op::Leaf(2), Op::Union], 9), Error::OutOfRange { index: Some(1), .. }));
        assert!(matches!(refused(&[a, open, Op::Union], 9), Error::Unsupported { .. }));
        assert!(matches!(refused(&[a, a, Op::Union], 2), Error::BufferLength { given: 2, needed: 3, .. }));
        assert!(matches!(refused(&[a; 128], 200), Error::Capacity { needed: 65, capacity: 64, .. }));
        let (program, mut memory) = ([open], [Extent::NOTHING; 1]);
        let alone = Object::new(&program, |leaf| surfaces.get(leaf), &mut memory).unwrap();
        assert_eq!((alone.extent(), alone.only(), Object::extents(5)), (Extent::SPACE, Some(1), 5));
    }
}
