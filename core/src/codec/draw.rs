//! A leaf's pixels.
//!
//! `p(i, j) = M + x(i, j) + s (D(i, j) - mean D)`, rounded and cut off once: with 7 fractional bits `M`
//! and `x`,
//! `s` in eighths and the mean of `D` with 4. First the leaf's own pixels become a copy of its domain, then
//! each is turned into its sample where it lies: no memory is needed for a domain, so it must not touch the
//! leaf.

use core::cell::Cell;

use super::area::Area;
use super::domain::Source;
use super::kept::Unsettled;
use super::leaf::{Domain, Leaf};
use super::levels::{FREQUENCIES, Levels};
use super::plane::{Plane, rounded};
use super::sample::Sample;
use super::shape::Place;
use super::transform::{Inverse, Term, pixels};

impl<'a, S: Sample> Plane<'a, S> {
    /// A leaf's pixels, and what later leaves need to know of it. False if its domain may not lie there.
    ///
    /// Error: before it is rounded `p` is off from the same in exact numbers by at most `e = 1/128 + E + |s|
    /// (d + mean d + 1/32)`: `E` is the transform's bound, `d` by how much the halved domain is off, at most
    /// what the worst of its pixels is. Rounded, it is off by a whole number, and by nothing where no half
    /// lies within `e`. So a pixel that `k` maps in a row lead to, in one sweep or in several, is off by less
    /// than `(1 + e_0) (1 + 2 |s| + ... + (2 |s|)^k)`, `s` the largest contrast of them and `e_0` that of a
    /// leaf with an exact domain. The base, on which means depend, is off by nothing: it is made of integers
    /// by the format itself
    /// (`samples_are_those_of_the_format_and_as_near_to_its_formulas_as_their_roundings_allow`).
    ///
    /// In sweeps a leaf is settled once it was drawn with a domain of which all is settled, or without
    /// one; then
    /// it stays as it is. The first sweep draws a leaf whose domain is not settled by then as if it had none.
    pub fn draw(&mut self, leaf: &Leaf, x: u32, y: u32, size: u32) -> bool {
        self.drawn(leaf, x, y, size).is_some()
    }

    /// The same: none if its domain may not lie there, else what the next sweep draws again, if it does.
    #[inline(never)]
    pub(super) fn drawn(&mut self, leaf: &Leaf, x: u32, y: u32, size: u32) -> Option<Option<Unsettled>> {
        let stays = self.done > 0 && self.settled.at(x, y);
        if stays && self.shape.scale == 0 && leaf.domain.is_none() {
            // what is settled shows its base
            let area = self.area(x, y, size);
            if area.is_whole(1 << size) {
                self.mark(x, y, size, false);
                self.recall(&area, x, y);
                return Some(None);
            }
        }
        let (mut source, mut unsettled) = (None, None);
        let mean = self.expected(x, y, size) + self.shape.moved(leaf.mean, size);
        if let Some(domain) = leaf.domain.as_ref().filter(|_| !stays) {
            let Place { x: column, y: row, .. } = self.shape.place(domain, x, y, size)?;
            let (contrast, isometry) = (domain.contrast(), domain.isometry);
            let map = Unsettled { x, y, size, mean, column, row, isometry, contrast };
            let settled = self.settled.has(2 * column, 2 * row, 2 << size);
            if settled || self.done > 0 {
                source = Some(self.source(&map));
            }
            unsettled = (!settled).then_some(map);
        }
        self.mark(x, y, size, leaf.domain.is_some());
        let same = self.shape.scale == 0;
        if stays || !same {
            self.edges(leaf, x, y, size, mean);
        }
        if !stays {
            self.fill(&leaf.levels, [x, y, size], mean, source, same);
            if !self.half.is_empty() {
                self.halve(x, y, size);
            }
            self.follow([x, y, size], unsettled.is_none());
        }
        Some(unsettled)
    }

    /// Draws a leaf once more in a sweep, and says whether it is settled now. What later leaves know of it
    /// stays as it is.
    #[inline(never)]
    pub(super) fn redraw(&mut self, levels: &Levels, map: &Unsettled) -> bool {
        let Unsettled { x, y, size, mean, column, row, .. } = *map;
        let settled = self.settled.has(2 * column, 2 * row, 2 << size);
        self.fill(levels, [x, y, size], mean, Some(self.source(map)), false);
        self.follow([x, y, size], settled);
        settled
    }

    /// What a domain would add to a leaf at full contrast, row by row, with 7 fractional bits: for an
    /// encoder. False where the domain may not lie there.
    pub fn copied(&self, domain: &Domain, x: u32, y: u32, size: u32, into: &mut [i32]) -> bool {
        let Some(Place { x: column, y: row, .. }) = self.shape.place(domain, x, y, size) else {
            return false;
        };
        let (contrast, isometry) = (domain.contrast(), domain.isometry);
        let map = Unsettled { x, y, size, mean: 0, column, row, isometry, contrast };
        self.source(&map).0.copied(self.shape.drawn(size), into);
        true
    }

    /// What a leaf leaves for later ones without its pixels: for an encoder.
    pub fn settle(&mut self, leaf: &Leaf, x: u32, y: u32, size: u32) {
        let mean = self.expected(x, y, size) + self.shape.moved(leaf.mean, size);
        self.mark(x, y, size, leaf.domain.is_some());
        self.edges(leaf, x, y, size, mean);
    }

    /// Where a leaf's pixels are.
    #[inline(never)]
    fn area(&self, x: u32, y: u32, size: u32) -> Area<'a, S> {
        let shape = &self.shape;
        let (columns, m) = (shape.columns(), 1_u32 << shape.drawn(size));
        let (top, rows) = match shape.window {
            Some(_) => (y - self.band, shape.scaled(shape.side())),
            None => (y, shape.rows()),
        };
        let (left, top) = (shape.scaled(x), shape.scaled(top));
        Area {
            picture: self.picture,
            start: top * columns + left,
            columns,
            wide: m.min(columns - left.min(columns)),
            high: m.min(rows - top.min(rows)),
        }
    }

    /// Draws a leaf; if it is to leave its edges, its base goes along them as well.
    #[inline(never)]
    fn fill(
        &mut self,
        levels: &Levels,
        [x, y, size]: [u32; 3],
        mean: i32,
        source: Option<(Source<'a, S>, i32)>,
        edges: bool,
    ) {
        let drawn = self.shape.drawn(size);
        let (m, area) = (1_u32 << drawn, self.area(x, y, size));
        // where nothing is added and nothing cut off, the picture shows the base
        let shown = edges && source.is_none() && area.is_whole(m);
        // what a copied sample is multiplied by, and what is added
        let (gain, off) = match source {
            None => (0, mean + 64),
            Some((source, contrast)) => (contrast << 4, mean + 64 - contrast * source.lay(&area, drawn)),
        };
        if levels.is_empty() || drawn == 0 {
            if edges {
                self.level(x, y, m, rounded(mean));
            }
            for i in 0..area.high {
                for slot in area.row(i) {
                    slot.set(S::cut((off + gain * slot.get().number()) >> 7));
                }
            }
            return;
        }
        let inverse = Inverse::new(levels, self.shape.step, size, drawn);
        // most leaves have few frequencies: there is less to clear
        let (mut few, mut all) = ([[0; 2]; 4], None);
        let pair = if inverse.is_narrow() { &mut few[..] } else { all.insert([[0; 2]; FREQUENCIES]) };
        for i in 0..m / 2 {
            inverse.rows::<S>(i, pair);
            if edges && !shown {
                self.edge_rows(&inverse, pair, i, [x, y, size], mean);
            }
            let rows = [area.row(i), area.row(m - 1 - i)];
            paint(inverse.terms(pair), inverse.turn(0), rows, m, (off, gain));
        }
        if shown {
            self.recall(&area, x, y);
        }
    }

    /// What follows on a leaf that was drawn, and is settled now or not.
    #[inline]
    fn follow(&self, [x, y, size]: [u32; 3], settled: bool) {
        if settled {
            self.settled.add(x, y, 1 << size);
        }
        if self.shape.scale > 0 {
            self.join([x, y, size], settled);
        }
    }

    /// Joins a leaf that is drawn larger to what is to the left of it and above: a picture goes on where
    /// cosines are flat. Not to what is above the band in a window of rows, for that was shown. Sweep after
    /// sweep a leaf that is not settled would pull its neighbours along: it alone is changed.
    #[inline(never)]
    fn join(&self, [x, y, size]: [u32; 3], both: bool) {
        let area = self.area(x, y, size);
        if x > 0 {
            area.join([1, area.columns], area.high, both);
        }
        if area.start >= area.columns {
            area.join([area.columns, 1], area.wide, both);
        }
    }

    /// The base along the edges, where the leaf is not drawn, or not in its own size.
    #[inline(never)]
    fn edges(&self, leaf: &Leaf, x: u32, y: u32, size: u32, mean: i32) {
        if leaf.levels.is_empty() {
            self.level(x, y, 1 << size, rounded(mean));
            return;
        }
        let inverse = Inverse::new(&leaf.levels, self.shape.step, size, size);
        let mut pair = [[0; 2]; FREQUENCIES];
        for i in 0..1 << (size - 1) {
            inverse.rows::<S>(i, &mut pair);
            self.edge_rows(&inverse, &pair, i, [x, y, size], mean);
        }
    }

    /// The base along the edges of row `i` of a transform and the one that mirrors it.
    #[inline(never)]
    fn edge_rows(&self, inverse: &Inverse<'_>, pair: &[Term], i: u32, [x, y, size]: [u32; 3], mean: i32) {
        let (n, base) = (1 << size, |value: i32| rounded(mean + value));
        let mut four = [0; 4];
        // the lowest row is that which mirrors the first
        for j in (0..if i == 0 { n / 2 } else { 1 }).rev() {
            four = inverse.pixels_apart::<S>(pair, j);
            if i == 0 {
                self.set_above(x + j, base(four[2]));
                self.set_above(x + n - 1 - j, base(four[3]));
            }
        }
        self.set_left(y + i, base(four[1]));
        self.set_left(y + n - 1 - i, base(four[3]));
    }

    /// The base along the edges of a whole leaf whose pixels show it.
    #[inline(never)]
    fn recall(&self, area: &Area<'a, S>, x: u32, y: u32) {
        let (lower, right) = (area.start + (area.high - 1) * area.columns, area.start + area.wide - 1);
        self.border(x, y, area.wide as usize, area.picture, [(lower, 1), (right, area.columns)]);
    }

    /// Brings the halved picture up to date where a square was drawn.
    #[inline(never)]
    fn halve(&self, x: u32, y: u32, size: u32) {
        let shape = &self.shape;
        let (left, top, m) = (shape.scaled(x), shape.scaled(y), 1 << shape.drawn(size));
        let columns = shape.columns();
        let width = columns >> 1;
        let band = shape.scaled(self.band);
        // a single pixel completes a square of four if it is the last of them
        let (x0, y0) = ((left >> 1).min(width), top >> 1);
        if m == 1 && left & top & 1 == 0 {
            return;
        }
        let n = (m >> 1).max(1);
        let count = n.min(width - x0);
        // of those rows whose lower one is there
        let high = (shape.rows() >> 1).saturating_sub(y0).min(n);
        let (start, down) = ((2 * y0 - band) * columns + 2 * x0, 2 * columns);
        let source = Source { samples: self.picture, start, down, lower: columns, isometry: 0 };
        for r in 0..high {
            source.row([r, 0, count], self.half, self.half_row(y0 + r) * width + x0, 1);
        }
    }

    /// Where the samples of a domain are, and the contrast. At a small scale its place is rounded down: as it
    /// lies in the halved picture, what is drawn of it does as well, and where it does not touch its leaf,
    /// whose place is whole there, that does not either.
    #[inline(never)]
    fn source(&self, map: &Unsettled) -> (Source<'a, S>, i32) {
        let Unsettled { column, row, isometry, contrast, .. } = *map;
        let shape = &self.shape;
        let columns = shape.columns();
        let (px, py) = (shape.scaled(column), shape.scaled(row));
        let source = if shape.window.is_some() {
            let down = columns >> 1;
            Source { samples: self.half, start: self.half_row(py) * down + px, down, lower: 0, isometry }
        } else {
            let down = 2 * columns;
            let start = py * down + 2 * px;
            Source { samples: self.picture, start, down, lower: columns, isometry }
        };
        (source, contrast)
    }
}

/// Turns two rows of a leaf, copies of its domain, into its samples: what is added besides a transform's, and
/// what a copy is multiplied by. `half` is the phase of frequency 1 in the first column.
#[inline(never)]
fn paint<S: Sample>(
    terms: &[Term],
    half: u32,
    [upper, lower]: [&[Cell<S>]; 2],
    m: u32,
    (off, gain): (i32, i32),
) {
    let mut turn = half;
    for j in 0..m / 2 {
        let other = m - 1 - j;
        let slots = [(upper, j), (upper, other), (lower, j), (lower, other)];
        for ((row, j), value) in slots.into_iter().zip(pixels::<S>(terms, turn)) {
            if let Some(slot) = row.get(j as usize) {
                slot.set(S::cut((off + value + gain * slot.get().number()) >> 7));
            }
        }
        turn += 2 * half;
    }
}
