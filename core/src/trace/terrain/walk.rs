//! The walk of a ray through a tree of cells, from front to back.
//!
//! A node is a square of cells, halved along both axes; at most three of its parts lie on a ray. Where the ray
//! passes above or below all heights of a node, the node tells on which side it is; else its parts do, and in
//! the end the patch of a cell. A crossing is where one side follows the other: a ray that comes from above and
//! ends below has crossed the surface, whatever rounding does at the edges of cells. So the surface is
//! watertight, and no hill is too thin.
//!
//! The stack holds three parts a level at most. Formats: lengths and parameters 24 fractional bits.

use core::ops::ControlFlow;

use heapless::Vec;

use super::super::ray::{Axis, Ray};
use super::plot::Rule;
use super::signs::{Above, signs};
use crate::num::formats::Q24;
use crate::terrain::Form;

/// The most levels of a tree: `3 LEVELS + 1` parts wait.
pub(super) const LEVELS: u32 = 21;
const STACK: usize = 3 * LEVELS as usize + 1;

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

/// A part that waits.
#[derive(Debug, Clone, Copy)]
struct Waiting<N> {
    place: Place,
    node: N,
    span: (Q24, Q24),
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

/// Hands over where a ray changes sides, in order, until `changed` breaks off.
#[inline(never)]
pub(super) fn walk<T: Tree>(
    tree: &T,
    frame: &Frame,
    ray: &Ray,
    changed: &mut impl FnMut(Change) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let axes = ray.axes();
    let [x, y, z] = &axes;
    let [columns, rows] = &frame.rules;
    let ([x_0, x_1], [y_0, y_1], [low, high]) = (columns.ends(), rows.ends(), frame.heights);
    let span = z.clip(low, high, y.clip(y_0, y_1, x.clip(x_0, x_1, (0, i32::MAX))));
    let mut above: Above = None;
    let mut waiting = Vec::<Waiting<T::Node>, STACK>::new();
    let root = Place { level: frame.depth, column: 0, row: 0 };
    if span.0 < span.1 {
        let _ = waiting.push(Waiting { place: root, node: tree.root(), span });
    }
    while let Some(Waiting { place, node, span }) = waiting.pop() {
        let (z_in, z_out) = (z.at(span.0), z.at(span.1));
        let [low, high] = tree.range(place, &node);
        let passes_above = z_in.min(z_out) > high;
        if passes_above || z_in.max(z_out) < low {
            let other = above.replace(passes_above).is_some_and(|before| before != passes_above);
            if other {
                // between two nodes: the cell where that is
                let (column, row) = (columns.index(x.at(span.0)), rows.index(y.at(span.0)));
                changed((span.0, Place { level: 0, column, row }, passes_above))?;
            }
        } else if tree.is_leaf(place, span.0) {
            let patch = tree.patch(place, &node);
            cross_leaf(frame, &axes, place, span, &patch, &mut above, changed)?;
        } else {
            let middle = tree.middle(place, &node);
            let level = place.level - 1;
            let (column, row) = (2 * place.column, 2 * place.row);
            // where the ray passes from one half to the other: never, where there is no other
            let turn = |rule: &Rule, axis: &Axis, index: u32| {
                let plane = (index + 1) << level;
                if plane < rule.count { Some(axis.crossing(rule.plane(plane))) } else { None }
            };
            let (turn_x, turn_y) = (turn(columns, x, column), turn(rows, y, row));
            let far =
                |turn: Option<Q24>, axis: &Axis| turn.is_some_and(|t| (t > span.0) == (axis.direction < 0));
            let (mut east, mut north) = (far(turn_x, x), far(turn_y, y));
            let mut parts = Vec::<Waiting<T::Node>, 3>::new();
            let mut t = span.0;
            loop {
                let next = |turn: Option<Q24>| turn.filter(|at| *at > t).unwrap_or(i32::MAX);
                let (next_x, next_y) = (next(turn_x), next(turn_y));
                let end = next_x.min(next_y).min(span.1);
                let place = Place { level, column: column + u32::from(east), row: row + u32::from(north) };
                let node = tree.part(place, &node, &middle);
                let _ = parts.push(Waiting { place, node, span: (t, end) });
                if end >= span.1 {
                    break;
                }
                east ^= end == next_x;
                north ^= end == next_y;
                t = end;
            }
            while let Some(part) = parts.pop() {
                // three a level: there is room
                let _ = waiting.push(part);
            }
        }
    }
    ControlFlow::Continue(())
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
    let (from, to) = (inside(t_in), inside(t_out));
    let (z_in, z_out) = (i64::from(z.at(t_in)), i64::from(z.at(t_out)));
    let mut found = |part: i32, is_above: bool| {
        let along = ((i64::from(t_out) - i64::from(t_in)) * i64::from(part)) >> 30;
        changed((t_in.wrapping_add(along as i32), place, is_above))
    };
    // the ray above the patch
    match patch {
        Form::Bilinear(patch) => {
            let [a, b, c] = patch.chord(from, to).map(i64::from);
            let over = [z_in - a, ((z_in + z_out) >> 1) - b, z_out - c];
            signs(over.map(saturated), above, &mut found)
        }
        Form::Bicubic(patch) => {
            const SIXTH: i64 = 715_827_883;
            let step = z_out - z_in;
            let mut k = 0;
            let over = patch.chord(from, to).map(|height| {
                let z = z_in + ((step * k * SIXTH + (1 << 31)) >> 32);
                k += 1;
                saturated(z - i64::from(height))
            });
            signs(over, above, &mut found)
        }
    }
}

#[inline(always)]
fn saturated(c: i64) -> Q24 {
    c.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32
}
