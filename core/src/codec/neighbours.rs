//! What a square learns from those above it and to its left, and leaves to those after it: the base along
//! their edges, how small they are and whether they have domains.

use core::cell::Cell;

use super::context;
use super::leaf::Setting;
use super::plane::{Plane, rounded};
use super::rolled::rolled;
use super::sample::Sample;

/// The sum of samples.
#[inline(never)]
fn total<S: Sample>(edge: Option<&[Cell<S>]>) -> i32 {
    let mut sum = 0;
    for sample in edge.unwrap_or(&[]) {
        sum += sample.get().number();
        rolled();
    }
    sum
}

/// Copies samples, from one place on, so far apart.
#[inline(never)]
fn copy<S: Sample>(to: Option<&[Cell<S>]>, from: &[Cell<S>], (mut at, step): (u32, u32)) {
    for slot in to.unwrap_or(&[]) {
        let Some(sample) = from.get(at as usize) else { return };
        slot.set(sample.get());
        at += step;
        rolled();
    }
}

/// Depth in the tree and whether there is a domain.
const fn cell(depth: u32, domain: bool) -> u8 {
    (depth << 1) as u8 | domain as u8
}

impl<S: Sample> Plane<'_, S> {
    /// The cells above and to the left.
    #[inline]
    fn neighbours(&self, x: u32, y: u32) -> [u32; 2] {
        let above =
            if y == 0 { 0 } else { self.cells.get(x as usize >> 2).map_or(0, |c| c.get().number() as u32) };
        let left = self.left_cells.get((y - self.band) as usize >> 2).map_or(0, |c| u32::from(*c));
        [above, left]
    }

    /// The models of whether a square is divided.
    #[inline]
    pub fn split_context(&self, x: u32, y: u32, size: u32) -> usize {
        let depth = 5 - size;
        let deeper: usize = self.neighbours(x, y).iter().map(|c| usize::from(c >> 1 > depth)).sum();
        context::SPLIT + (self.shape.chroma as usize * 4 + size as usize - 2) * 3 + deeper
    }

    /// What decides how a leaf is said.
    #[inline]
    pub fn setting(&self, x: u32, y: u32, size: u32) -> Setting {
        let [above, left] = self.neighbours(x, y);
        Setting {
            size,
            chroma: self.shape.chroma,
            neighbours: (above & 1) + (left & 1),
            far: self.shape.far(size),
            transform: self.shape.transform,
        }
    }

    /// The mean along the neighbours' edges, with 7 fractional bits.
    #[inline(never)]
    pub fn expected(&self, x: u32, y: u32, size: u32) -> i32 {
        let (n, left) = (1_usize << size, (y - self.band) as usize);
        let (mut sum, mut doubled) = (0, 0);
        if y > 0 {
            sum += total(self.above.get(x as usize..x as usize + n));
            doubled += 1;
        }
        if x > 0 {
            sum += total(self.left.get(left..left + n));
            doubled += 1;
        }
        match doubled {
            0 => 1 << (S::BITS + 6),
            1 => ((sum << 7) + (1 << (size - 1))) >> size,
            _ => ((sum << 6) + (1 << (size - 1))) >> size,
        }
    }

    /// A square outside the picture: as if it were what its neighbours let expect.
    #[inline(never)]
    pub fn skip(&mut self, x: u32, y: u32, size: u32) {
        let mean = rounded(self.expected(x, y, size));
        self.mark(x, y, size, false);
        self.level(x, y, 1 << size, mean);
    }

    /// The same base all along the edges of a square.
    #[inline(never)]
    pub(super) fn level(&self, x: u32, y: u32, side: u32, base: S) {
        self.border(x, y, side as usize, &[Cell::new(base)], [(0, 0); 2]);
    }

    /// The base along the lower and the right edge of a square: from samples, each edge from a place on, so
    /// far apart.
    #[inline(never)]
    pub(super) fn border(&self, x: u32, y: u32, n: usize, from: &[Cell<S>], lines: [(u32, u32); 2]) {
        let (x, y, [lower, right]) = (x as usize, (y - self.band) as usize, lines);
        copy(self.above.get(x..x + n), from, lower);
        copy(self.left.get(y..y + n), from, right);
    }

    #[inline(never)]
    pub(super) fn mark(&mut self, x: u32, y: u32, size: u32, domain: bool) {
        let value = cell(5 - size, domain);
        let (x, y, cells) = (x as usize >> 2, (y - self.band) as usize >> 2, 1 << (size - 2));
        copy(self.cells.get(x..x + cells), &[Cell::new(S::cut(value.into()))], (0, 0));
        if let Some(slots) = self.left_cells.get_mut(y..y + cells) {
            slots.fill(value);
        }
    }

    #[inline]
    pub(super) fn set_above(&self, x: u32, base: S) {
        if let Some(slot) = self.above.get(x as usize) {
            slot.set(base);
        }
    }

    #[inline]
    pub(super) fn set_left(&self, y: u32, base: S) {
        if let Some(slot) = self.left.get((y - self.band) as usize) {
            slot.set(base);
        }
    }
}
