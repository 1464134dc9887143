//! The walk of a ray through a tree of cells, from front to back.
//!
//! A node is a square of cells, halved along both axes. Where the ray passes above or below all heights of a
//! node, the node tells on which side it is; else its parts do, one behind the other, and in the end the
//! patch of a cell. A crossing is where one side follows the other: a ray that comes from above and ends
//! below has crossed the surface, whatever rounding does at the edges of cells. So the surface is watertight,
//! and no hill is too thin.
//!
//! What is kept is the way from the root to where the ray is, a node a level, each with four parameters:
//! where the ray leaves it, and where it passes its middle, along x and y. In which part the ray is follows
//! from these. Formats: lengths and parameters 24 fractional bits.

use core::ops::ControlFlow;

use heapless::Vec;

use super::super::ray::Axis;
use super::leaf::{Change, Frame, Place, cross_leaf};
use super::plot::Rule;
use super::sides::Above;
use crate::num::formats::Q24;
use crate::terrain::Form;

/// The most levels of a tree: a side has at most 2^16 cells.
pub(super) const LEVELS: u32 = 16;
/// Every node on the way down to a cell.
const PATH: usize = LEVELS as usize;

/// What is known of the heights of nodes and cells.
pub(super) trait Tree {
    /// What is known of a node.
    type Node: Copy;
    /// What is carried along to its parts.
    type Middle;

    /// The node of all cells.
    fn root(&self) -> Self::Node;

    /// Bounds of the heights.
    fn range(&self, place: Place, node: &Self::Node) -> [Q24; 2];

    /// Ready for the parts.
    fn middle(&self, place: Place, node: &Self::Node) -> Self::Middle;

    /// A part, which is there, at its own place.
    fn part(&self, place: Place, middle: &Self::Middle) -> Self::Node;

    /// The patch that spans a leaf, and an eighth of how much it bends.
    fn patch(&self, place: Place, node: &Self::Node) -> (Form, u32);

    /// Up to which level nodes are leaves where the ray comes to them at `t`, and until when.
    fn leaves(&self, t: Q24) -> (u32, Q24);
}

/// Where the ray passes from the first half of a node to the second along an axis.
#[derive(Debug, Clone, Copy)]
struct Half {
    t: Q24,
    /// How long it takes for a half; 0 where that is not known.
    time: u32,
}

/// The cells along an axis, and the ray's way across them.
struct Across<'a> {
    rule: &'a Rule,
    axis: &'a Axis,
    /// 1 for a ray that comes to the last cell first.
    first: u32,
}

impl Across<'_> {
    /// The middle of a node: so many cells before it are `plane`, and so many are in each half. Those before
    /// it are half of `half` away from the middle of the node that this is a part of.
    #[inline(always)]
    fn half(&self, plane: u32, size: u32, above: Half, is_second: bool) -> Half {
        if plane >= self.rule.count {
            // there is no second half: the first is that of the lower index
            return Half { t: if self.first == 0 { i32::MAX } else { i32::MIN }, time: 0 };
        }
        // what is saturated has no middle
        if above.time > 0 && above.t > i32::MIN && above.t < i32::MAX {
            let time = (above.time + 1) >> 1;
            let t = if is_second {
                above.t.saturating_add_unsigned(time)
            } else {
                above.t.saturating_sub_unsigned(time)
            };
            return Half { t, time };
        }
        self.looked_up(plane, size)
    }

    /// The same from the planes themselves.
    #[inline(never)]
    fn looked_up(&self, plane: u32, size: u32) -> Half {
        let [t, begin] =
            [plane, plane.wrapping_sub(size)].map(|plane| self.axis.crossing(self.rule.plane(plane)));
        let is_far = [t, begin].iter().any(|t| *t == i32::MAX || *t == i32::MIN);
        Half { t, time: if is_far { 0 } else { t.abs_diff(begin) } }
    }
}

/// A node that the ray is inside of.
#[derive(Debug)]
struct Open<M> {
    middle: M,
    /// Column and row of the part that the ray comes to first.
    first: [u32; 2],
    halves: [Half; 2],
    /// Where the ray leaves it along x and along y.
    ends: [Q24; 2],
}

/// Hands over where a ray changes sides, in order, until `changed` breaks off; in the end on which side it
/// is.
#[inline(never)]
pub(super) fn walk<T: Tree>(
    tree: &T,
    frame: &Frame,
    axes: &[Axis; 3],
    changed: &mut impl FnMut(Change) -> ControlFlow<()>,
) -> ControlFlow<(), Above> {
    let [x, y, z] = axes;
    let [columns, rows] = &frame.rules;
    let (mut t, end) = frame.clip(axes);
    if t >= end {
        return ControlFlow::Continue(None);
    }
    let first = |axis: &Axis| u32::from(axis.direction < 0);
    let across = Across { rule: columns, axis: x, first: first(x) };
    let down = Across { rule: rows, axis: y, first: first(y) };
    let mut above: Above = None;
    let mut path = Vec::<Open<T::Middle>, PATH>::new();
    let (mut place, mut node) = (Place { level: frame.depth, column: 0, row: 0 }, tree.root());
    let (mut ends, mut z_in, mut second) = ([end; 2], z.at(t), [false; 2]);
    let (mut leaves, mut until) = tree.leaves(t);
    loop {
        let out = ends[0].min(ends[1]);
        let z_out = z.at(out);
        let [low, high] = tree.range(place, &node);
        let side = if z_in.min(z_out) > high {
            Some(true)
        } else if z_in.max(z_out) < low {
            Some(false)
        } else {
            None
        };
        'node: {
            if let Some(passes_above) = side {
                if above != side {
                    if above.is_some() {
                        // between two nodes: the cell where that is
                        let (column, row) = (columns.index(x.at(t)), rows.index(y.at(t)));
                        changed((t, Place { level: 0, column, row }, passes_above))?;
                    }
                    above = side;
                }
            } else {
                if t >= until {
                    (leaves, until) = tree.leaves(t);
                }
                let Place { level, column, row } = place;
                if level > leaves {
                    let size = 1 << (level - 1);
                    let plane = |index: u32| (2 * index + 1) * size;
                    let unknown = Half { t: 0, time: 0 };
                    let halves = path.last().map_or([unknown; 2], |open| open.halves);
                    let halves = [
                        across.half(plane(column), size, halves[0], second[0]),
                        down.half(plane(row), size, halves[1], second[1]),
                    ];
                    let middle = tree.middle(place, &node);
                    let first = [2 * column + across.first, 2 * row + down.first];
                    // one a level: there is room
                    let _ = path.push(Open { middle, first, halves, ends });
                    break 'node;
                }
                let (patch, eighth) = tree.patch(place, &node);
                leaf((frame, axes), level, [column, row], (t, out), (&patch, eighth), &mut above, changed)?;
            }
            (t, z_in) = (out, z_out);
            while path.last().is_some_and(|open| t >= open.ends[0].min(open.ends[1])) {
                let _ = path.pop();
            }
        }
        // the part where the ray is
        let level = frame.depth - path.len() as u32;
        let Some(open) = path.last() else { return ControlFlow::Continue(above) };
        second = open.halves.map(|half| half.t <= t);
        let end = |half: Half, end: Q24, is_second: bool| if is_second { end } else { end.min(half.t) };
        ends = [end(open.halves[0], open.ends[0], second[0]), end(open.halves[1], open.ends[1], second[1])];
        let part = |first: u32, is_second: bool| first ^ u32::from(is_second);
        place = Place { level, column: part(open.first[0], second[0]), row: part(open.first[1], second[1]) };
        node = tree.part(place, &open.middle);
    }
}

/// As [`cross_leaf`], beside the walk: most of it is about nodes.
#[inline(never)]
fn leaf(
    (frame, axes): (&Frame, &[Axis; 3]),
    level: u32,
    [column, row]: [u32; 2],
    piece: (Q24, Q24),
    patch: (&Form, u32),
    above: &mut Above,
    changed: &mut impl FnMut(Change) -> ControlFlow<()>,
) -> ControlFlow<()> {
    cross_leaf(frame, axes, Place { level, column, row }, piece, patch, above, changed)
}
