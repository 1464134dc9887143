//! A plane of a picture while it is decoded: leaf by leaf, in rows of squares.
//!
//! A leaf of side `n` whose mean was said to be `l` steps from what its neighbours let expect is
//!
//! `p(i, j) = b(i, j) + s (D(i, j) - mean D)`, `b(i, j) = m + l q / n + x(i, j)`,
//!
//! `x` its transform, `D` its domain: a square of `2n`, halved, turned by its isometry, and `s` the contrast.
//! `m` is the mean of `b`, as it was rounded and cut off, along the edges of the neighbours above and to the
//! left; of half the range where there are none. It is the mean of `b`, not of `p`: so it is known without
//! any
//! domain, in every sweep, at every scale.
//!
//! Format: 7 fractional bits, rounded to nearest once; a domain's mean has 4.
//!
//! Source: A. E. Jacquin, "Image coding based on a fractal theory of iterated contractive image
//! transformations", 1992; G. E. Oien, S. Lepsoy, "Fractal-based image coding with fast decoder
//! convergence", 1994, for the mean that is taken off.

use core::cell::Cell;

use super::context;
use super::domain::Source;
use super::leaf::{Domain, Leaf, Setting};
use super::models::Coder;
use super::quadtree::{SMALLEST, Walk};
use super::sample::Sample;
use super::shape::Shape;
use super::transform::Inverse;

/// Memory of a plane.
#[derive(Debug)]
pub struct Plane<'a, S: Sample> {
    shape: Shape,
    /// Rows as they are drawn: of the band, or all.
    picture: &'a [Cell<S>],
    /// Rows of the halved picture; none where all rows are there.
    half: &'a [Cell<S>],
    /// Of the halved picture, the first row in `half`.
    half_top: i32,
    /// The base of the leaves above, along their lower edges.
    above: &'a [Cell<S>],
    /// What leaves above are: [`cell`].
    cells: &'a [Cell<S>],
    /// The base of the leaves to the left, along their right edges.
    left: [S; 32],
    left_cells: [u8; 8],
    /// The first row of the band.
    band: u32,
    /// Whether what has no domain stays as it is.
    again: bool,
}

/// A value of 7 fractional bits as a sample.
#[inline]
fn rounded<S: Sample>(value: i32) -> S {
    S::cut((value + 64) >> 7)
}

/// Depth in the tree and whether there is a domain.
const fn cell(depth: u32, domain: bool) -> u8 {
    (depth << 1) as u8 | domain as u8
}

impl<'a, S: Sample> Plane<'a, S> {
    /// How many samples it borrows, for a window of rows or for all.
    pub const fn samples(shape: &Shape) -> usize {
        let columns = shape.columns() as usize;
        let drawn = match shape.window {
            Some(_) => {
                let half = (shape.columns() >> 1) as usize * shape.scaled(shape.half_rows()) as usize;
                shape.scaled(shape.side()) as usize * columns + half
            }
            None => shape.rows() as usize * columns,
        };
        drawn + shape.padded() as usize + (shape.padded() >> 2) as usize
    }

    /// Takes its memory from the front of `memory`.
    pub fn new(shape: Shape, memory: &mut &'a [Cell<S>]) -> Self {
        let mut take = |length: usize| {
            let (taken, rest) = memory.split_at(length.min(memory.len()));
            *memory = rest;
            taken
        };
        let columns = shape.columns() as usize;
        let (picture, half) = match shape.window {
            Some(_) => (
                take(shape.scaled(shape.side()) as usize * columns),
                take((shape.columns() >> 1) as usize * shape.scaled(shape.half_rows()) as usize),
            ),
            None => (take(shape.rows() as usize * columns), take(0)),
        };
        let above = take(shape.padded() as usize);
        let cells = take((shape.padded() >> 2) as usize);
        let left = [S::cut(0); 32];
        Self {
            shape,
            picture,
            half,
            half_top: 0,
            above,
            cells,
            left,
            left_cells: [0; 8],
            band: 0,
            again: false,
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

    /// Makes ready for a band. `again`: what has no domain was drawn in an earlier sweep.
    pub fn begin(&mut self, band: u32, again: bool) {
        self.again = again;
        if band == 0 {
            for cell in self.cells {
                cell.set(S::cut(0));
            }
        }
        if let Some(window) = self.shape.window {
            if band > 0 {
                // what leaves the window makes room at its end
                let gone = (self.shape.columns() >> 1) * self.shape.scaled(self.shape.side() >> 1);
                let kept = self.half.get(gone as usize..).unwrap_or(&[]);
                for (to, from) in self.half.iter().zip(kept) {
                    to.set(from.get());
                }
            }
            self.half_top = (band >> 1) as i32 - (window >> 1) as i32;
        }
        self.left_cells = [0; 8];
        self.band = band;
    }

    /// Decodes a band, all squares or until `stop` says so; `seen` is shown each leaf, how it was said, and
    /// where it is. False if a domain lies where nothing is decoded.
    pub fn decode<C: Coder>(
        &mut self,
        coder: &mut C,
        leaf: &mut Leaf,
        mut stop: impl FnMut(&C) -> bool,
        mut seen: impl FnMut(&Leaf, &Setting, [u32; 2]),
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
                seen(leaf, &setting, [x, y]);
                if !self.draw(leaf, x, y, size) {
                    return false;
                }
                walk.pass();
            }
            if stop(coder) {
                return true;
            }
            x += self.shape.side();
        }
        true
    }

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
        let n = 1_usize << size;
        let (mut sum, mut doubled) = (0, 0);
        if y > 0 {
            for edge in self.above.iter().skip(x as usize).take(n) {
                sum += edge.get().number();
            }
            doubled += 1;
        }
        if x > 0 {
            for edge in self.left.iter().skip((y - self.band) as usize).take(n) {
                sum += edge.number();
            }
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
        for k in 0..1 << size {
            self.set_above(x + k, mean);
            self.set_left(y + k, mean);
        }
    }

    #[inline(never)]
    fn mark(&mut self, x: u32, y: u32, size: u32, domain: bool) {
        let value = cell(5 - size, domain);
        let cells = 1 << (size - 2);
        for slot in self.cells.iter().skip(x as usize >> 2).take(cells) {
            slot.set(S::cut(value.into()));
        }
        for slot in self.left_cells.iter_mut().skip((y - self.band) as usize >> 2).take(cells) {
            *slot = value;
        }
    }

    #[inline]
    fn set_above(&self, x: u32, base: S) {
        if let Some(slot) = self.above.get(x as usize) {
            slot.set(base);
        }
    }

    #[inline]
    fn set_left(&mut self, y: u32, base: S) {
        if let Some(slot) = self.left.get_mut((y - self.band) as usize) {
            *slot = base;
        }
    }

    /// A leaf's pixels, and what later leaves need to know of it.
    #[inline]
    pub fn draw(&mut self, leaf: &Leaf, x: u32, y: u32, size: u32) -> bool {
        let shape = self.shape;
        let mean = { self.expected(x, y, size) + shape.moved(leaf.mean, size) };
        let source = match &leaf.domain {
            None => None,
            Some(domain) => {
                let Some((px, py)) = shape.place(domain, x, y, size) else { return false };
                self.source(domain, px, py, size)
            }
        };
        self.mark(x, y, size, leaf.domain.is_some());
        let stays = self.again && leaf.domain.is_none();
        if stays || shape.scale != 0 {
            self.edges(leaf, x, y, size, mean);
        }
        if stays {
            return true;
        }
        self.fill(leaf, x, y, size, mean, source);
        if !self.half.is_empty() {
            self.halve(shape.scaled(x), shape.scaled(y), 1 << shape.drawn(size));
        }
        true
    }

    /// What a domain would add to a leaf at full contrast, row by row, with 7 fractional bits: for an
    /// encoder.
    /// Nothing where the domain may not lie there.
    pub fn copied(&self, domain: &Domain, x: u32, y: u32, size: u32, into: &mut [i32]) -> bool {
        let Some((px, py)) = self.shape.place(domain, x, y, size) else { return false };
        let full = Domain { scaling: 7, ..*domain };
        let Some(source) = self.source(&full, px, py, size) else { return false };
        for (i, row) in (0..).zip(into.chunks_exact_mut(1 << size).take(1 << size)) {
            let mut at = source.row(i);
            for slot in row {
                *slot = source.next(&mut at);
            }
        }
        true
    }

    /// What a leaf leaves for later ones without its pixels: for an encoder.
    pub fn settle(&mut self, leaf: &Leaf, x: u32, y: u32, size: u32) {
        let mean = self.expected(x, y, size) + self.shape.moved(leaf.mean, size);
        self.mark(x, y, size, leaf.domain.is_some());
        self.edges(leaf, x, y, size, mean);
    }

    /// What later leaves know of a square's neighbours: for an encoder that tries.
    pub fn edge(&self, x: u32, y: u32, size: u32) -> Edge<S> {
        let blank = S::cut(0);
        let mut edge =
            Edge { x, y, size, above: [blank; 32], cells: [blank; 8], left: [blank; 32], left_cells: [0; 8] };
        let ((n, cells), down) = (edge.lengths(), (y - self.band) as usize);
        for (to, from) in edge.above.iter_mut().zip(self.above.iter().skip(x as usize)).take(n) {
            *to = from.get();
        }
        for (to, from) in edge.cells.iter_mut().zip(self.cells.iter().skip(x as usize >> 2)).take(cells) {
            *to = from.get();
        }
        for (to, from) in edge.left.iter_mut().zip(self.left.iter().skip(down)).take(n) {
            *to = *from;
        }
        for (to, from) in edge.left_cells.iter_mut().zip(self.left_cells.iter().skip(down >> 2)).take(cells) {
            *to = *from;
        }
        edge
    }

    /// As it was.
    pub fn restore(&mut self, edge: &Edge<S>) {
        let ((n, cells), x, down) = (edge.lengths(), edge.x as usize, (edge.y - self.band) as usize);
        for (from, to) in edge.above.iter().zip(self.above.iter().skip(x)).take(n) {
            to.set(*from);
        }
        for (from, to) in edge.cells.iter().zip(self.cells.iter().skip(x >> 2)).take(cells) {
            to.set(*from);
        }
        for (from, to) in edge.left.iter().zip(self.left.iter_mut().skip(down)).take(n) {
            *to = *from;
        }
        for (from, to) in edge.left_cells.iter().zip(self.left_cells.iter_mut().skip(down >> 2)).take(cells) {
            *to = *from;
        }
    }

    /// The base along the edges, for a picture that is drawn at another scale.
    #[inline(never)]
    fn edges(&mut self, leaf: &Leaf, x: u32, y: u32, size: u32, mean: i32) {
        let inverse = Inverse::new::<S>(&leaf.levels, self.shape.step, size, size);
        let n = 1 << size;
        let base = |v: i32| rounded(mean + v);
        if leaf.levels.is_empty() {
            for k in 0..n {
                self.set_above(x + k, base(0));
                self.set_left(y + k, base(0));
            }
            return;
        }
        for i in 0..n / 2 {
            let pair = inverse.rows(i);
            let [_, upper, _, lower] = inverse.pixels::<S>(&pair, 0);
            self.set_left(y + i, base(upper));
            self.set_left(y + n - 1 - i, base(lower));
            if i == 0 {
                for j in 0..n / 2 {
                    let [_, _, left, right] = inverse.pixels::<S>(&pair, j);
                    self.set_above(x + j, base(left));
                    self.set_above(x + n - 1 - j, base(right));
                }
            }
        }
    }

    /// Draws a leaf; at scale 1 its base goes along the edges as well.
    #[inline(never)]
    fn fill(&mut self, leaf: &Leaf, x: u32, y: u32, size: u32, mean: i32, source: Option<Source<'a, S>>) {
        let shape = self.shape;
        let drawn = shape.drawn(size);
        let (columns, m) = (shape.columns(), 1_u32 << drawn);
        let (left, top) =
            (shape.scaled(x), shape.scaled(y - if shape.window.is_some() { self.band } else { 0 }));
        let rows = if shape.window.is_some() { shape.scaled(shape.side()) } else { shape.rows() };
        // how much of the leaf lies inside
        let (wide, high) = (m.min(columns - left.min(columns)), m.min(rows - top.min(rows)));
        let edges = shape.scale == 0;
        let inverse = Inverse::new::<S>(&leaf.levels, shape.step, size, drawn);
        let flat = leaf.levels.is_empty();
        if flat && edges {
            let base = rounded(mean);
            for k in 0..m {
                self.set_above(x + k, base);
                self.set_left(y + k, base);
            }
        }
        let picture = self.picture;
        let row = |i: u32| {
            let start = ((top + i) * columns + left) as usize;
            picture.get(start..start + wide as usize).unwrap_or(&[])
        };
        if flat {
            for i in 0..high {
                match &source {
                    None => {
                        let value = rounded(mean);
                        for slot in row(i) {
                            slot.set(value);
                        }
                    }
                    Some(source) => {
                        let mut at = source.row(i);
                        for slot in row(i) {
                            slot.set(rounded(mean + source.next(&mut at)));
                        }
                    }
                }
            }
            return;
        }
        for i in 0..m.div_ceil(2) {
            let below = m - 1 - i;
            let pair = inverse.rows(i);
            let upper = if i < high { row(i) } else { &[] };
            let lower = if below < high { row(below) } else { &[] };
            for j in 0..m.div_ceil(2) {
                let other = m - 1 - j;
                let [ul, ur, ll, lr] = inverse.pixels::<S>(&pair, j);
                if edges {
                    if i == 0 {
                        self.set_above(x + j, rounded(mean + ll));
                        self.set_above(x + other, rounded(mean + lr));
                    }
                    if j == 0 {
                        self.set_left(y + i, rounded(mean + ur));
                        self.set_left(y + below, rounded(mean + lr));
                    }
                }
                let four = [
                    (upper, i, j, ul),
                    (upper, i, other, ur),
                    (lower, below, j, ll),
                    (lower, below, other, lr),
                ];
                for (slots, i, j, value) in four {
                    if let Some(slot) = slots.get(j as usize) {
                        let copied = source.as_ref().map_or(0, |source| source.at(i, j));
                        slot.set(rounded(mean + value + copied));
                    }
                }
            }
        }
    }

    /// Brings the halved picture up to date where a square was drawn.
    #[inline(never)]
    fn halve(&self, left: u32, top: u32, m: u32) {
        let shape = &self.shape;
        let columns = shape.columns();
        let width = columns >> 1;
        let band = shape.scaled(self.band);
        // a single pixel completes a square of four if it is the last of them
        let (x0, y0) = ((left >> 1).min(width), top >> 1);
        if m == 1 && left & top & 1 == 0 {
            return;
        }
        let n = (m >> 1).max(1);
        let rows = shape.rows();
        let offset = shape.scaled(shape.half_rows()) - shape.scaled(shape.side() >> 1);
        for y in y0..y0 + n {
            if 2 * y + 1 >= rows {
                break;
            }
            let upper = ((2 * y - band) * columns + 2 * x0) as usize;
            let lower = upper + columns as usize;
            let (Some(upper), Some(lower)) = (self.picture.get(upper..), self.picture.get(lower..)) else {
                break;
            };
            let at = ((y - (band >> 1) + offset) * width + x0) as usize;
            let Some(to) = self.half.get(at..at + n.min(width - x0) as usize) else { break };
            for ((to, upper), lower) in to.iter().zip(upper.chunks_exact(2)).zip(lower.chunks_exact(2)) {
                if let ([a, b], [c, d]) = (upper, lower) {
                    let sum = a.get().number() + b.get().number() + c.get().number() + d.get().number();
                    to.set(S::cut((sum + 2) >> 2));
                }
            }
        }
    }

    /// Where the samples of a domain are and what their mean is; none where a small scale leaves no room.
    #[inline(never)]
    fn source(&self, domain: &Domain, px: u32, py: u32, size: u32) -> Option<Source<'a, S>> {
        let shape = &self.shape;
        let drawn = shape.drawn(size);
        let m = 1_u32 << drawn;
        let columns = shape.columns();
        let width = columns >> 1;
        let (samples, pitch, rows, y) = if shape.window.is_some() {
            let rows = shape.scaled(shape.half_rows());
            (self.half, width, rows, (py as i32 - self.half_top).max(0) as u32)
        } else {
            (self.picture, 2 * columns, shape.rows() >> 1, py)
        };
        let scaled = |v: u32| if shape.scale >= 0 { v << shape.scale } else { v >> -shape.scale };
        if m > width || m > rows {
            return None;
        }
        let (px, py) = (scaled(px).min(width - m), scaled(y).min(rows - m));
        let across = if shape.window.is_some() { 1 } else { 2 };
        let mut source = Source {
            samples,
            start: py * pitch + px * across,
            right: across,
            down: pitch,
            lower: if shape.window.is_some() { 0 } else { columns },
            contrast: domain.contrast(),
            mean: 0,
        };
        source.prepare(domain.isometry, drawn);
        Some(source)
    }
}

/// What later leaves know of a square's neighbours: [`Plane::edge`].
#[derive(Debug, Clone, Copy)]
pub struct Edge<S> {
    x: u32,
    y: u32,
    size: u32,
    above: [S; 32],
    cells: [S; 8],
    left: [S; 32],
    left_cells: [u8; 8],
}

impl<S> Edge<S> {
    /// Of its pixels and of its cells.
    const fn lengths(&self) -> (usize, usize) {
        (1 << self.size, 1 << (self.size - 2))
    }
}
