//! Core's walk through a height field of two equal parts along each axis, in floating point.
//!
//! The same quadtree, the same steps from plane to plane, the same tests in the same order as
//! `attractor::trace` makes them; only what fixed point needs and floating point does not, care for ranges,
//! is left out. Where the walk stands are integers here too: they number the cells.

use attractor::fif::{self, Pyramid};

use super::camera::Camera;
use super::vector::Vector;
use crate::float::Float;

/// A cell of a pyramid.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cell<F> {
    pub(crate) min: F,
    pub(crate) max: F,
    pub(crate) mean: F,
    pub(crate) slope: F,
}

impl<F: Float> Cell<F> {
    pub(crate) fn new(cell: &fif::Cell) -> Self {
        let [min, max, mean, slope] =
            [cell.min, cell.max, cell.mean, cell.slope].map(|v| F::of(v.to_num::<f64>()));
        Self { min, max, mean, slope }
    }
}

/// Whether a ray that runs from height `z_in` to `z_out` over a part of the surface meets the part's box.
#[inline(always)]
pub(crate) fn meets<F: Float>(f: &Cell<F>, g: &Cell<F>, z_in: F, z_out: F) -> bool {
    let zero = F::of(0.0);
    let (z_low, z_high) = if z_in < z_out { (z_in, z_out) } else { (z_out, z_in) };
    if f.min >= zero && g.min >= zero {
        return z_low <= f.max * g.max && z_high >= f.min * g.min;
    }
    let (low, high) = range(f, g);
    z_low <= high && z_high >= low
}

/// The range of the product of two ranges.
#[inline(never)]
fn range<F: Float>(f: &Cell<F>, g: &Cell<F>) -> (F, F) {
    let [a, b, c, d] = [f.min * g.min, f.min * g.max, f.max * g.min, f.max * g.max];
    (a.least(b).least(c.least(d)), a.most(b).most(c.most(d)))
}

/// Levels of the tree.
pub(crate) const DEPTH: usize = 8;
/// Cells of its pyramid.
pub(crate) const CELLS: usize = Pyramid::cells(2, DEPTH as u32);
/// The surface lies over `[0, 2] x [0, 2]`.
const WIDTH: f64 = 2.0;

/// What a ray parallel to a plane leans by, as in core.
const LEAN: f64 = 1.0 / 268_435_456.0;

/// The surface and its camera.
pub(crate) struct Caster<F> {
    cells: [Cell<F>; CELLS],
    pub(crate) camera: Camera<F>,
    /// From where on a node of each level is small.
    small: [F; DEPTH + 1],
}

/// The leaf that a ray meets first.
pub(crate) struct Hit<F> {
    pub(crate) level: u32,
    pub(crate) index: (u32, u32),
    /// Parameter of the middle of the ray's part inside the leaf's box.
    pub(crate) t: F,
}

/// The leaf as the walk finds it: its nodes along x and y, the ray's part above it.
struct Leaf<F> {
    nodes: (u32, u32),
    span: (F, F),
}

/// When the ray crosses the planes along one axis.
struct Line<F> {
    middle: F,
    /// What the ray takes across the surface, divided by `2^31`.
    part: F,
    /// 1 if the ray comes from above, and the second of two parts is its first.
    from_above: u32,
}

/// Where a walk stands along one axis: its node, the plane at which the ray leaves it (31 fractional bits,
/// the middle is 0), and the parameter there.
struct Place<F> {
    node: u32,
    end: i32,
    next: F,
}

impl<F: Float> Line<F> {
    #[inline(always)]
    fn new(origin: F, direction: F) -> Self {
        let direction = if direction == F::of(0.0) { F::of(LEAN) } else { direction };
        let reciprocal = F::of(1.0) / direction;
        let from_above = direction < F::of(0.0);
        let whole = F::of(WIDTH / 2_147_483_648.0) * reciprocal;
        Self {
            middle: (F::of(WIDTH / 2.0) - origin) * reciprocal,
            part: if from_above { -whole } else { whole },
            from_above: u32::from(from_above),
        }
    }

    /// The parameter at a plane.
    #[inline(always)]
    fn at(&self, u: i32) -> F {
        F::of_int(u).fused(self.part, self.middle)
    }
}

impl<F: Float> Place<F> {
    #[inline(always)]
    fn root(line: &Line<F>) -> Self {
        Self { node: 0, end: 1 << 30, next: line.at(1 << 30) }
    }

    /// Into the part, `size` wide, in which the ray is at `t`.
    #[inline(always)]
    fn descend(&mut self, line: &Line<F>, size: u32, t: F) {
        let middle = self.end.wrapping_sub(size as i32);
        let next = line.at(middle);
        if next > t {
            (self.node, self.end, self.next) = (2 * self.node + 1 + line.from_above, middle, next);
        } else {
            self.node = 2 * self.node + 2 - line.from_above;
        }
    }

    /// Over the plane at its end, into the next node, and out of the nodes that end there too. Whether the
    /// ray surely meets the box of the next node; none at the end of the surface.
    #[inline(always)]
    fn advance(
        &mut self,
        line: &Line<F>,
        aside: &mut Self,
        line_aside: &Line<F>,
        level: &mut u32,
    ) -> Option<bool> {
        // the last digit that does not say "far"
        let near = (self.node + 1) ^ line.from_above.wrapping_sub(1);
        let mut surely = ((aside.node + 1) ^ line_aside.from_above.wrapping_sub(1)) & 1 == 0;
        if near & 1 == 0 {
            surely = true;
            let levels = near.trailing_zeros();
            if levels >= *level {
                return None;
            }
            *level -= levels;
            let size = 1_u32 << (31 - *level);
            self.node = ((self.node + 1) >> levels).wrapping_sub(1);
            aside.node = ((aside.node + 1) >> levels).wrapping_sub(1);
            aside.end = (aside.end.wrapping_sub(1) | size.wrapping_sub(1) as i32).wrapping_add(1);
            aside.next = line_aside.at(aside.end);
        }
        self.node = self.node.wrapping_add(1).wrapping_sub(line.from_above << 1);
        self.end = self.end.wrapping_add(1 << (31 - *level));
        self.next = line.at(self.end);
        Some(surely)
    }
}

impl<F: Float> Caster<F> {
    /// The surface whose factors have this pyramid, on a picture of `side x side` pixels.
    pub(crate) fn new(pyramid: &Pyramid<'_>, side: u32) -> Self {
        let mut cells = [Cell::new(&fif::Cell::ZERO); CELLS];
        let known = (0..=DEPTH as u32).flat_map(|level| pyramid.level(level));
        for (cell, known) in cells.iter_mut().zip(known) {
            *cell = Cell::new(known);
        }
        let camera = Camera::new(side);
        let small = core::array::from_fn(|level| F::of(WIDTH / f64::from(1 << level)) / camera.footprint);
        Self { cells, camera, small }
    }

    /// Without a footprint: down to the deepest level.
    pub(crate) fn deepest(mut self) -> Self {
        self.small = [F::of(1e30); DEPTH + 1];
        self
    }

    /// The first leaf that the ray meets.
    #[inline(never)]
    fn leaf(&self, [ox, oy, oz]: Vector<F>, [dx, dy, dz]: Vector<F>) -> Option<Leaf<F>> {
        let zero = F::of(0.0);
        let (line_x, line_y) = (Line::new(ox, dx), Line::new(oy, dy));
        let (mut x, mut y) = (Place::root(&line_x), Place::root(&line_y));
        let z_at = |t: F| dz.fused(t, oz);
        let end = x.next.least(y.next);
        let mut t = line_x.at(-1 << 30).most(line_y.at(-1 << 30)).most(zero);
        if t > end {
            return None;
        }
        // on to where the ray enters the range of all heights
        let (low, high) = range(&self.cells[0], &self.cells[0]);
        let z_end = z_at(end);
        let (outside, misses) = if dz < zero { (high - oz, z_end > high) } else { (low - oz, z_end < low) };
        if if dz < zero { outside < zero } else { outside > zero } {
            if misses {
                return None;
            }
            t = t.most((outside / dz).least(end));
        }
        let mut z = z_at(t);
        if z.most(z_end) < low || z.least(z_end) > high {
            return None;
        }
        let is_leaf = |level: u32, t: F| level >= DEPTH as u32 || t >= self.small[level as usize];
        if is_leaf(0, t) {
            return Some(Leaf { nodes: (0, 0), span: (t, end) });
        }
        // a box is tested where it is not taken for met
        let (mut level, mut met) = (0, true);
        loop {
            while !met {
                let next = x.next.least(y.next);
                let z_next = z_at(next);
                if meets(self.cells.get(x.node as usize)?, self.cells.get(y.node as usize)?, z, z_next) {
                    if is_leaf(level, t) {
                        return Some(Leaf { nodes: (x.node, y.node), span: (t, next) });
                    }
                    break;
                }
                (t, z) = (next, z_next);
                let surely = if x.next <= y.next {
                    x.advance(&line_x, &mut y, &line_y, &mut level)?
                } else {
                    y.advance(&line_y, &mut x, &line_x, &mut level)?
                };
                met = surely && !is_leaf(level, t);
            }
            level += 1;
            let size = 1 << (31 - level);
            x.descend(&line_x, size, t);
            y.descend(&line_y, size, t);
            // the first part of the surface
            met = level == 1 && !is_leaf(level, t);
        }
    }

    /// The first leaf that the ray meets, and the middle of the ray's part inside its box.
    #[inline(always)]
    pub(crate) fn hit(&self, eye: Vector<F>, direction: Vector<F>) -> Option<Hit<F>> {
        let leaf = self.leaf(eye, direction)?;
        let (oz, dz) = (eye[2], direction[2]);
        let ((x, y), (t_in, t_out)) = (leaf.nodes, leaf.span);
        let (low, high) = range(self.cells.get(x as usize)?, self.cells.get(y as usize)?);
        let reciprocal = F::of(1.0) / if dz == F::of(0.0) { F::of(LEAN) } else { dz };
        let (a, b) = ((low - oz) * reciprocal, (high - oz) * reciprocal);
        let (t_in, t_out) = (t_in.most(a.least(b)), t_out.least(a.most(b)));
        let t = if t_in <= t_out { (t_in + t_out) * F::of(0.5) } else { leaf.span.0 };
        let level = 31 - (x + 1).leading_zeros();
        Some(Hit { level, index: (x + 1 - (1 << level), y + 1 - (1 << level)), t })
    }
}
