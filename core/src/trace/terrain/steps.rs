//! The walk of a ray over stored heights, from front to back: from node to node of a level, and into the
//! parts of those that it does not pass by for certain.
//!
//! Where the ray passes above or below all heights of a node, the node tells on which side it is; else its
//! parts do, one behind the other, and in the end the patch of a cell. Where the ray leaves a node it enters
//! the next, at one parameter: see [`leaf`](super::leaf) for why no hill is too thin.
//!
//! Source: J. Amanatides, A. Woo, "A fast voxel traversal algorithm for ray tracing", 1987 (from cell to cell
//! by the lesser of two parameters), here on several levels. Parameters of planes by adding up are off by
//! `2^-24` a step, three steps a level.

use core::ops::ControlFlow;

use heapless::Vec;

use super::super::ray::Axis;
use super::course::Course;
use super::leaf::{Change, Frame, Place, cross_leaf};
use super::plot::{Rule, shifted};
use super::ranges::{Doubt, HeightRange, LEVELS, PARTS, STEP, begins, nodes, top};
use super::sides::Above;
use crate::num::formats::{Q14, Q24};
use crate::terrain::Form;

/// What is no longer is left out at the end of a node, so that a ray never steps out of all columns: more
/// than what parameters of planes differ by.
const NEAR: Q24 = 1 << 6;

/// The bounds of all levels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Levels<'a> {
    ranges: &'a [HeightRange],
    begins: [u32; LEVELS],
    /// Where the coarsest begins.
    start: u32,
    /// The unit of heights, as a power of two of 2^-24.
    unit: u32,
    /// Along both axes the coarsest level that has two nodes, and how wide they are.
    widest: [(u32, Q24); 2],
}

impl<'a> Levels<'a> {
    pub(super) fn new(rules: &[Rule; 2], unit: u32, ranges: &'a [HeightRange]) -> Self {
        let [columns, rows] = rules.map(|rule| rule.count);
        let widest = rules.map(|rule| {
            let level = top(columns, rows).min(31 - (rule.count | 1).leading_zeros());
            (level, rule.width_of(1 << level))
        });
        let begins = begins(columns, rows);
        let start = begins.get((top(columns, rows) / STEP) as usize).copied().unwrap_or(0);
        Self { ranges, begins, start, unit, widest }
    }
}

/// What a ray does along an axis.
struct Across<'a> {
    rule: &'a Rule,
    axis: &'a Axis,
    /// From one plane to the next of a level.
    time: Q24,
    level: u32,
}

impl<'a> Across<'a> {
    #[inline(always)]
    fn new(rule: &'a Rule, axis: &'a Axis, (level, width): (u32, Q24)) -> Self {
        let time = axis.crossing(axis.origin.wrapping_add(width));
        Self { rule, axis, time: time ^ (time >> 31), level }
    }

    /// 1 or -1.
    #[inline(always)]
    fn sign(&self) -> i32 {
        (self.axis.direction >> 31) | 1
    }

    /// How many planes there are before the one where the ray leaves a node.
    #[inline(always)]
    fn behind(&self, index: u32) -> u32 {
        index.wrapping_add(u32::from(self.axis.direction > 0))
    }

    /// From one plane to the next of a level that has two.
    #[inline(always)]
    fn time(&self, level: u32) -> Q24 {
        self.time >> (self.level.saturating_sub(level) & 31)
    }

    /// Where the ray comes to so many planes of a level; never behind the last column.
    #[inline(always)]
    fn plane(&self, level: u32, planes: u32) -> Q24 {
        let plane = planes << (level & 31);
        if plane < self.rule.count { self.axis.crossing(self.rule.plane(plane)) } else { i32::MAX }
    }
}

/// The node that a ray is in, among the parts of another.
#[derive(Debug, Clone, Copy)]
struct Open {
    /// Its bounds.
    index: u32,
    /// Where the ray leaves it along both axes.
    next: [Q24; 2],
    /// Where the ray leaves the node whose parts these are.
    end: Q24,
    /// Where the ray comes to it: seen from its corner, and how high.
    here: [Q14; 3],
}

impl Open {
    /// Into the part that follows where the ray leaves one at `t`, there.
    #[inline(always)]
    fn follow(&mut self, t: Q24, [u, v, height]: [Q14; 3], step: &Step) {
        self.here = [u, v, height];
        if self.next[0] <= t {
            self.index = self.index.wrapping_add_signed(step.index[0]);
            self.here[0] = u.wrapping_sub(step.here[0]);
            self.next[0] = self.next[0].saturating_add(step.time[0]);
        }
        if self.next[1] <= t {
            self.index = self.index.wrapping_add_signed(step.index[1]);
            self.here[1] = v.wrapping_sub(step.here[1]);
            self.next[1] = self.next[1].saturating_add(step.time[1]);
        }
    }
}

/// From a node of a level to the next along both axes.
struct Step {
    level: u32,
    index: [i32; 2],
    here: [Q14; 2],
    time: [Q24; 2],
}

impl Step {
    #[inline(always)]
    fn new(across: &[Across<'_>; 2], level: u32) -> Self {
        let [a, b] = across;
        let width = nodes(a.rule.count, level) as i32;
        let size = 1 << ((14 + level) & 31);
        let here = [a.sign().wrapping_mul(size), b.sign().wrapping_mul(size)];
        let index = [a.sign(), b.sign().wrapping_mul(width)];
        Self { level, index, here, time: [a.time(level), b.time(level)] }
    }
}

/// Hands over where a ray changes sides, in order, until `changed` breaks off; in the end on which side it
/// is.
#[inline(never)]
pub(super) fn walk(
    levels: &Levels<'_>,
    patch: impl Fn(Place) -> Form,
    frame: &Frame,
    axes: &[Axis; 3],
    changed: &mut impl FnMut(Change) -> ControlFlow<()>,
) -> ControlFlow<(), Above> {
    let (mut t, end) = frame.clip(axes);
    // the world ends before
    let end = end.min(i32::MAX - NEAR);
    if t >= end {
        return ControlFlow::Continue(None);
    }
    let [x, y, z] = axes;
    let [columns, rows] = &frame.rules;
    let course = Course::new(&frame.rules, axes, levels.unit, [t, end]);
    let [wide, high] = levels.widest;
    let across = [Across::new(columns, x, wide), Across::new(rows, y, high)];
    let mut above: Above = None;
    // one a level: there is room
    let mut path = Vec::<Open, LEVELS>::new();
    let mut step = Step::new(&across, frame.depth);
    let mut open = {
        let level = frame.depth;
        let [a, b] = &across;
        let here = [columns.columns_before(x.at(t)), rows.columns_before(y.at(t))];
        let size = (14 + level) & 31;
        let index = |at: Q14, count: u32| (at as u32 >> size).min(nodes(count, level).wrapping_sub(1));
        let (i, j) = (index(here[0], columns.count), index(here[1], rows.count));
        let corner = |index: u32| (index << size) as i32;
        let height = shifted(z.at(t), 14 - levels.unit as i32);
        Open {
            index: levels.start.wrapping_add(j.wrapping_mul(nodes(columns.count, level))).wrapping_add(i),
            next: [a.plane(level, a.behind(i)).max(t), b.plane(level, b.behind(j)).max(t)],
            end,
            here: [here[0].wrapping_sub(corner(i)), here[1].wrapping_sub(corner(j)), height],
        }
    };
    loop {
        // along the nodes that the ray passes by as those before
        let (out, there, range, side) = loop {
            let out = open.next[0].min(open.next[1]).min(open.end);
            let there = course.after(out.wrapping_sub(t), open.here);
            let Some(range) = levels.ranges.get(open.index as usize) else {
                return ControlFlow::Continue(above);
            };
            let side = range.side([open.here, there]);
            let is_alike = side.as_ref().is_ok_and(|is_above| above == Some(*is_above));
            if !is_alike || out + NEAR >= open.end {
                break (out, there, range, side);
            }
            t = out;
            open.follow(t, there, &step);
        };
        match side {
            Ok(is_above) => {
                if above.replace(is_above).is_some_and(|before| before != is_above) {
                    between((frame, axes), (t, is_above), changed)?;
                }
            }
            Err(doubt) if step.level == 0 => {
                let cell = (levels.place(columns.count, 0, open.index), range.bend(levels.unit));
                above = leaf((frame, axes), cell, &patch, (doubt, [t, out]), above, changed)?;
            }
            Err(_) => {
                let [i, j] = levels.place(columns.count, step.level, open.index);
                let level = step.level.saturating_sub(STEP);
                step = Step::new(&across, level);
                let part = |across: &Across<'_>, index: u32, next: Q24, here: Q14| {
                    let (first, size) = (index << STEP, (14 + level) & 31);
                    let last = nodes(across.rule.count, level).wrapping_sub(1).wrapping_sub(first);
                    let part = ((here >> size).max(0) as u32).min(PARTS - 1).min(last);
                    // as far before the plane where the ray leaves the node
                    let planes = if across.axis.direction > 0 { PARTS - 1 - part } else { part };
                    let next = if next < i32::MAX {
                        next.saturating_sub((planes as i32).saturating_mul(across.time(level)))
                    } else {
                        across.plane(level, across.behind(first + part))
                    };
                    (first + part, next.max(t), here.wrapping_sub((part << size) as i32))
                };
                let ([a, b], [next, over], [u, v, height]) = (&across, open.next, open.here);
                let ((i, next, u), (j, over, v)) = (part(a, i, next, u), part(b, j, over, v));
                open.here = there;
                let _ = path.push(open);
                open = Open {
                    index: levels.index(columns.count, level, [i, j]),
                    next: [next, over],
                    end: out,
                    here: [u, v, height],
                };
                continue;
            }
        }
        (t, open.here) = (out, there);
        if t + NEAR >= open.end {
            let mut level = step.level;
            loop {
                t = open.end;
                let Some(outer) = path.pop() else { return ControlFlow::Continue(above) };
                (open, level) = (outer, level + STEP);
                if t + NEAR < open.end {
                    break;
                }
            }
            step = Step::new(&across, level);
        }
        open.follow(t, open.here, &step);
    }
}

/// Tells of a change of sides between two nodes, in the cell where that is.
#[inline(never)]
fn between(
    (frame, [x, y, _]): (&Frame, &[Axis; 3]),
    (t, is_above): (Q24, bool),
    changed: &mut impl FnMut(Change) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let [columns, rows] = &frame.rules;
    let (column, row) = (columns.index(x.at(t)), rows.index(y.at(t)));
    changed((t, Place { level: 0, column, row }, is_above))
}

/// Meets the patch of a cell where the bounds leave doubt, beside the walk: most of it is about nodes.
#[inline(never)]
fn leaf(
    (frame, axes): (&Frame, &[Axis; 3]),
    ([column, row], eighth): ([u32; 2], u32),
    patch: impl Fn(Place) -> Form,
    (doubt, piece): (Doubt, [Q24; 2]),
    mut above: Above,
    changed: &mut impl FnMut(Change) -> ControlFlow<()>,
) -> ControlFlow<(), Above> {
    let place = Place { level: 0, column, row };
    let (side, [from, to]) = doubt.narrowed(piece);
    if let Some(is_above) = side
        && above.replace(is_above).is_some_and(|before| before != is_above)
    {
        changed((piece[0], place, is_above))?;
    }
    cross_leaf(frame, axes, place, (from, to), (&patch(place), eighth), &mut above, changed)?;
    ControlFlow::Continue(above)
}

impl Levels<'_> {
    fn begin(&self, level: u32) -> u32 {
        self.begins.get((level / STEP) as usize).copied().unwrap_or(0)
    }

    /// Which bounds are those of a node.
    #[inline(always)]
    fn index(&self, columns: u32, level: u32, [column, row]: [u32; 2]) -> u32 {
        self.begin(level).wrapping_add(row.wrapping_mul(nodes(columns, level))).wrapping_add(column)
    }

    /// And the reverse.
    #[inline(always)]
    fn place(&self, columns: u32, level: u32, index: u32) -> [u32; 2] {
        let (index, width) = (index.wrapping_sub(self.begin(level)), nodes(columns, level));
        let row = index.checked_div(width).unwrap_or(0);
        [index.wrapping_sub(row.wrapping_mul(width)), row]
    }
}
