//! A plane of a picture while it is decoded: leaf by leaf, in rows of squares.
//!
//! A leaf of side `n` whose mean was said to be `l` steps from what its neighbours let expect is
//!
//! `p(i, j) = b(i, j) + s (D(i, j) - mean D)`, `b(i, j) = m + l q / n + x(i, j)`,
//!
//! `x` its transform, `D` its domain: a square of `2n`, halved, turned by its isometry, and `s` the contrast.
//! `m` is the mean of `b`, as it was rounded and cut off, along the edges of the neighbours above and to the
//! left; of half the range where there are none. It is the mean of `b`, not of `p`: so it is known without
//! any domain, in every sweep, at every scale.
//!
//! Source: A. E. Jacquin, "Image coding based on a fractal theory of iterated contractive image
//! transformations", 1992; G. E. Oien, S. Lepsoy, "Fractal-based image coding with fast decoder
//! convergence", 1994, for the mean that is taken off.

use core::cell::Cell;

use super::kept::Unsettled;
use super::leaf::{Leaf, Setting};
use super::models::Coder;
use super::quadtree::{SMALLEST, Walk};
use super::sample::Sample;
use super::settled::Settled;
use super::shape::Shape;

/// Memory of a plane.
#[derive(Debug)]
pub struct Plane<'a, S: Sample> {
    pub(super) shape: Shape,
    /// Rows as they are drawn: of the band, or all.
    pub(super) picture: &'a [Cell<S>],
    /// Rows of the halved picture, round and round; none where all rows are there.
    pub(super) half: &'a [Cell<S>],
    /// Of the halved picture as it is drawn, the first row of the window.
    pub(super) half_top: i32,
    /// Which of the rows in `half` it is.
    pub(super) half_first: u32,
    /// The base of the leaves above, along their lower edges.
    pub(super) above: &'a [Cell<S>],
    /// What leaves above are: [`cell`].
    pub(super) cells: &'a [Cell<S>],
    /// In sweeps: what stays as it is.
    pub(super) settled: Settled<'a, S>,
    /// The base of the leaves to the left, along their right edges.
    pub(super) left: [Cell<S>; 32],
    pub(super) left_cells: [u8; 8],
    /// The first row of the band.
    pub(super) band: u32,
    /// How many sweeps are done.
    pub(super) done: u32,
}

/// A value of 7 fractional bits as a sample.
#[inline]
pub(super) fn rounded<S: Sample>(value: i32) -> S {
    S::cut((value + 64) >> 7)
}

impl<'a, S: Sample> Plane<'a, S> {
    /// How many samples it borrows, for a window of rows or for all: of the picture, the halved picture, the
    /// edges above, the cells above, and what is settled.
    #[inline(never)]
    const fn lengths(shape: &Shape) -> [usize; 5] {
        let columns = shape.columns() as usize;
        let (rows, half, settled) = match shape.window {
            Some(_) => {
                (shape.scaled(shape.side()), (columns >> 1) * shape.scaled_up(shape.half_rows()) as usize, 0)
            }
            None => (shape.rows(), 0, Settled::<S>::samples(shape.width, shape.height)),
        };
        let padded = shape.padded() as usize;
        [rows as usize * columns, half, padded, padded >> 2, settled]
    }

    /// All of them.
    #[inline(never)]
    pub const fn samples(shape: &Shape) -> usize {
        let [picture, half, above, cells, settled] = Self::lengths(shape);
        picture + half + above + cells + settled
    }

    /// Takes its memory from the front of `memory`.
    #[inline(never)]
    pub fn new(shape: Shape, memory: &mut &'a [Cell<S>]) -> Self {
        let [picture, half, above, cells, settled] = Self::lengths(&shape).map(|length| {
            let (taken, rest) = memory.split_at(length.min(memory.len()));
            *memory = rest;
            taken
        });
        Self {
            shape,
            picture,
            half,
            half_top: 0,
            half_first: 0,
            above,
            cells,
            settled: Settled::new(settled, shape.width),
            left: core::array::from_fn(|_| Cell::new(S::cut(0))),
            left_cells: [0; 8],
            band: 0,
            done: 0,
        }
    }

    /// What it is.
    pub const fn shape(&self) -> &Shape {
        &self.shape
    }

    /// The rows that are there.
    pub const fn picture(&self) -> &'a [Cell<S>] {
        self.picture
    }

    /// Makes ready for a band, after so many sweeps.
    #[inline(never)]
    pub fn begin(&mut self, band: u32, done: u32) {
        self.done = done;
        if band == 0 {
            for cell in self.cells {
                cell.set(S::cut(0));
            }
            if done == 0 {
                self.settled.clear();
            }
        }
        if let Some(window) = self.shape.window {
            // rounded down, as places of domains are
            let top = self.shape.scaled(band >> 1) as i32 - self.shape.scaled_up(window >> 1) as i32;
            if band > 0 {
                // what leaves the window makes room at its end
                self.half_first = self.half_row(top as u32);
            }
            self.half_top = top;
        }
        self.left_cells = [0; 8];
        self.band = band;
    }

    /// Where row `y` of the halved picture, as it is drawn, is in `half`: at most as many rows after the
    /// window's first as there are.
    #[inline]
    pub(super) const fn half_row(&self, y: u32) -> u32 {
        let r = y.wrapping_sub(self.half_top as u32);
        let (row, rows) = (self.half_first + r, self.shape.scaled_up(self.shape.half_rows()));
        if row < rows { row } else { row - rows }
    }

    /// Decodes a band, all squares or until `stop` says so; `seen` is shown each leaf, how it was said, where
    /// it is, and what the next sweep draws again of it. False if a domain lies where nothing is decoded.
    #[inline(never)]
    pub fn decode<C: Coder>(
        &mut self,
        coder: &mut C,
        leaf: &mut Leaf,
        mut stop: impl FnMut(&C) -> bool,
        mut seen: impl FnMut(&Leaf, &Setting, [u32; 2], Option<Unsettled>),
    ) -> bool {
        let mut x = 0;
        while x < self.shape.width {
            let mut walk = Walk::new(self.shape.largest);
            while let Some((dx, dy, size)) = walk.square() {
                let (x, y) = (x + dx, self.band + dy);
                if x >= self.shape.width || y >= self.shape.height {
                    self.skip(x, y, size);
                    walk.pass();
                    continue;
                }
                let setting = self.setting(x, y, size);
                if size > SMALLEST && coder.bin(self.split_context(x, y, size), false) {
                    walk.divide();
                    continue;
                }
                leaf.levels.clear();
                leaf.code(coder, &setting);
                let Some(unsettled) = self.drawn(leaf, x, y, size) else { return false };
                seen(leaf, &setting, [x, y], unsettled);
                walk.pass();
            }
            if stop(coder) {
                return true;
            }
            x += self.shape.side();
        }
        true
    }
}
