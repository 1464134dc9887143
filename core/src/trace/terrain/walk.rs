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
use super::plot::Rule;
use super::sides::{Above, sides};
use crate::num::formats::{Q24, Q30};
use crate::num::{product, product_u};
use crate::terrain::Form;

/// The most levels of a tree: a side has at most 2^16 cells.
pub(super) const LEVELS: u32 = 16;
/// Every node on the way down to a cell.
const PATH: usize = LEVELS as usize;

/// A square of `2^level` cells a side, by its column and row among those.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) level: u32,
    pub(super) column: u32,
    pub(super) row: u32,
}

/// What is known of the heights of nodes and cells.
pub(super) trait Tree {
    /// What is carried along from a node to its parts.
    type Node: Copy;
    /// What the parts of a node share.
    type Middle;

    /// The node of all cells.
    fn root(&self) -> Self::Node;

    /// Bounds of the heights.
    fn range(&self, place: Place, node: &Self::Node) -> [Q24; 2];

    /// Ready for the parts.
    fn middle(&self, place: Place, node: &Self::Node) -> Self::Middle;

    /// A part, which is there, at its own place.
    fn part(&self, place: Place, node: &Self::Node, middle: &Self::Middle) -> Self::Node;

    /// The patch that spans a leaf.
    fn patch(&self, place: Place, node: &Self::Node) -> Form;

    /// Whether a node is a leaf where the ray comes to it at `t`.
    fn is_leaf(&self, place: Place, t: Q24) -> bool;
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
struct Open<N, M> {
    node: N,
    middle: M,
    /// Column and row of the part that the ray comes to first.
    first: [u32; 2],
    halves: [Half; 2],
    /// Where the ray leaves it along x and along y.
    ends: [Q24; 2],
}

/// The box and the cells of a terrain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    /// Columns and rows.
    pub(super) rules: [Rule; 2],
    /// Bounds of all heights.
    pub(super) heights: [Q24; 2],
    /// The level of the root.
    pub(super) depth: u32,
}

/// A change of sides: parameter, the leaf, and whether the ray is above from there on.
pub(super) type Change = (Q24, Place, bool);

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
    let ([x_0, x_1], [y_0, y_1], [low, high]) = (columns.ends(), rows.ends(), frame.heights);
    let (mut t, end) = z.clip(low, high, y.clip(y_0, y_1, x.clip(x_0, x_1, (0, i32::MAX))));
    if t >= end {
        return ControlFlow::Continue(None);
    }
    let first = |axis: &Axis| u32::from(axis.direction < 0);
    let across = Across { rule: columns, axis: x, first: first(x) };
    let down = Across { rule: rows, axis: y, first: first(y) };
    let mut above: Above = None;
    let mut path = Vec::<Open<T::Node, T::Middle>, PATH>::new();
    let (mut place, mut node) = (Place { level: frame.depth, column: 0, row: 0 }, tree.root());
    let (mut ends, mut z_in, mut second) = ([end; 2], z.at(t), [false; 2]);
    loop {
        let out = ends[0].min(ends[1]);
        let z_out = z.at(out);
        let [low, high] = tree.range(place, &node);
        let passes_above = z_in.min(z_out) > high;
        let passes = passes_above || z_in.max(z_out) < low;
        if !passes && !tree.is_leaf(place, t) {
            let size = 1 << (place.level - 1);
            let plane = |index: u32| (2 * index + 1) * size;
            let unknown = Half { t: 0, time: 0 };
            let halves = path.last().map_or([unknown; 2], |open| open.halves);
            let halves = [
                across.half(plane(place.column), size, halves[0], second[0]),
                down.half(plane(place.row), size, halves[1], second[1]),
            ];
            let middle = tree.middle(place, &node);
            let first = [2 * place.column + across.first, 2 * place.row + down.first];
            // one a level: there is room
            let _ = path.push(Open { node, middle, first, halves, ends });
        } else {
            if passes {
                let other = above.replace(passes_above).is_some_and(|before| before != passes_above);
                if other {
                    // between two nodes: the cell where that is
                    let (column, row) = (columns.index(x.at(t)), rows.index(y.at(t)));
                    changed((t, Place { level: 0, column, row }, passes_above))?;
                }
            } else {
                let patch = tree.patch(place, &node);
                cross_leaf(frame, axes, place, (t, out), &patch, &mut above, changed)?;
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
        node = tree.part(place, &open.node, &open.middle);
    }
}

/// A ray above a patch, from where it comes over its cell to where it leaves it.
struct Chord<'a> {
    patch: &'a Form,
    from: [Q30; 2],
    to: [Q30; 2],
    heights: [Q24; 2],
}

impl Chord<'_> {
    /// How high above the patch it is.
    #[inline(never)]
    fn over(&self, part: Q30) -> Q24 {
        let along = |a: i32, b: i32| a.wrapping_add((product(b.wrapping_sub(a), part) >> 30) as i32);
        let ([s_0, t_0], [s_1, t_1], [z_0, z_1]) = (self.from, self.to, self.heights);
        along(z_0, z_1).saturating_sub(self.patch.height(along(s_0, s_1), along(t_0, t_1)))
    }

    /// An eighth of a bound of its second derivative, `|h_ss| ds^2 + 2 |h_st ds dt| + |h_tt| dt^2`, rounded
    /// up.
    #[inline(always)]
    fn bend(&self) -> u32 {
        let ([s_0, t_0], [s_1, t_1]) = (self.from, self.to);
        let (s, t) = (s_0.abs_diff(s_1), t_0.abs_diff(t_1));
        let [ss, st, tt] = self.patch.bends();
        // 28 fractional bits, and of the sum 44
        let part = |a: u32, b: u32, bend: u32| product_u((product_u(a, b) >> 32) as u32 + 1, bend);
        let eighth = (part(s, s, ss) + 2 * part(s, t, st) + part(t, t, tt)) >> 23;
        u32::try_from(eighth).map_or(u32::MAX, |eighth| eighth.saturating_add(1))
    }
}

/// Where the ray changes sides inside a leaf.
#[inline(always)]
fn cross_leaf(
    frame: &Frame,
    [x, y, z]: &[Axis; 3],
    place: Place,
    (t_in, t_out): (Q24, Q24),
    patch: &Form,
    above: &mut Above,
    changed: &mut impl FnMut(Change) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let [columns, rows] = &frame.rules;
    let level = place.level;
    let (column, row) = (place.column << level, place.row << level);
    let inside = |t: Q24| [columns.inside(x.at(t), column, level), rows.inside(y.at(t), row, level)];
    let heights = [t_in, t_out].map(|t| z.at(t));
    let chord = Chord { patch, from: inside(t_in), to: inside(t_out), heights };
    sides(|part| chord.over(part), chord.bend(), above, &mut |part, is_above| {
        let along = product(t_out.wrapping_sub(t_in), part) >> 30;
        changed((t_in.wrapping_add(along as i32), place, is_above))
    })
}
