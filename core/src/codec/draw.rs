//! A leaf's pixels.
//!
//! `p(i, j) = M + x(i, j) + s (D(i, j) - mean D)`, rounded and cut off once: with 7 fractional bits `M`
//! and `x`,
//! `s` in eighths and the mean of `D` with 4. First the leaf's own pixels become a copy of its domain, then
//! each is turned into its sample where it lies: no memory is needed for a domain, so it must not touch the
//! leaf.

use super::area::Area;
use super::domain::{Source, halved};
use super::leaf::{Domain, Leaf};
use super::plane::{Plane, rounded};
use super::sample::Sample;
use super::shape::Place;
use super::transform::{Inverse, Pair};

impl<'a, S: Sample> Plane<'a, S> {
    /// A leaf's pixels, and what later leaves need to know of it. False if its domain may not lie there.
    ///
    /// In sweeps a leaf is settled once it was drawn with a domain of which all is settled, or without
    /// one; then
    /// it stays as it is. The first sweep draws a leaf whose domain is not settled by then as if it had none.
    #[inline(never)]
    pub fn draw(&mut self, leaf: &Leaf, x: u32, y: u32, size: u32) -> bool {
        let stays = self.done > 0 && self.settled.has(x, y, 1);
        let (mut source, mut settled) = (None, true);
        if let Some(domain) = leaf.domain.as_ref().filter(|_| !stays) {
            let Some(place) = self.shape.place(domain, x, y, size) else { return false };
            settled = self.settled.has(2 * place.x, 2 * place.y, 2 << size);
            if settled || self.done > 0 {
                source = self.source(domain, place, size).map(|source| (source, domain.contrast()));
            }
        }
        self.mark(x, y, size, leaf.domain.is_some());
        let mean = self.expected(x, y, size) + self.shape.moved(leaf.mean, size);
        let scaled = self.shape.scale != 0;
        if stays || scaled {
            self.edges(leaf, x, y, size, mean);
        }
        if !stays {
            self.fill(leaf, x, y, size, mean, source);
            if settled {
                self.settled.add(x, y, 1 << size);
            }
            if !self.half.is_empty() {
                self.halve(x, y, size);
            }
        }
        true
    }

    /// What a domain would add to a leaf at full contrast, row by row, with 7 fractional bits: for an
    /// encoder. False where the domain may not lie there.
    pub fn copied(&self, domain: &Domain, x: u32, y: u32, size: u32, into: &mut [i32]) -> bool {
        let source = self.shape.place(domain, x, y, size);
        let source = source.and_then(|place| self.source(domain, place, size));
        source.map(|source| source.copied(self.shape.drawn(size), into)).is_some()
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

    /// Draws a leaf; at scale 1 its base goes along the edges as well.
    #[inline(never)]
    fn fill(
        &mut self,
        leaf: &Leaf,
        x: u32,
        y: u32,
        size: u32,
        mean: i32,
        source: Option<(Source<'a, S>, i32)>,
    ) {
        let drawn = self.shape.drawn(size);
        let (m, edges, area) = (1_u32 << drawn, self.shape.scale == 0, self.area(x, y, size));
        // what a copied sample is multiplied by, and what is added
        let (gain, off) = match source {
            None => (0, mean + 64),
            Some((source, contrast)) => (contrast << 4, mean + 64 - contrast * source.lay(&area, drawn)),
        };
        if leaf.levels.is_empty() || drawn == 0 {
            if edges {
                let base = rounded(mean);
                for k in 0..m {
                    self.set_above(x + k, base);
                    self.set_left(y + k, base);
                }
            }
            for i in 0..area.high {
                for slot in area.row(i) {
                    slot.set(S::cut((off + gain * slot.get().number()) >> 7));
                }
            }
            return;
        }
        let inverse = Inverse::new(&leaf.levels, self.shape.step, size, drawn);
        let mut pair = Pair::default();
        for i in 0..m / 2 {
            let below = m - 1 - i;
            inverse.rows::<S>(i, &mut pair);
            let (upper, lower) = (area.row(i), area.row(below));
            for j in 0..m / 2 {
                let other = m - 1 - j;
                let four = inverse.pixels::<S>(&pair, j);
                if edges {
                    let [_, upper, left, right] = four.map(|value| rounded(mean + value));
                    if i == 0 {
                        self.set_above(x + j, left);
                        self.set_above(x + other, right);
                    }
                    if j == 0 {
                        self.set_left(y + i, upper);
                        self.set_left(y + below, right);
                    }
                }
                let slots = [(upper, j), (upper, other), (lower, j), (lower, other)];
                for ((slots, j), value) in slots.into_iter().zip(four) {
                    if let Some(slot) = slots.get(j as usize) {
                        slot.set(S::cut((off + value + gain * slot.get().number()) >> 7));
                    }
                }
            }
        }
    }

    /// The base along the edges, where the leaf is not drawn, or not in its own size.
    #[inline(never)]
    fn edges(&mut self, leaf: &Leaf, x: u32, y: u32, size: u32, mean: i32) {
        let inverse = Inverse::new(&leaf.levels, self.shape.step, size, size);
        let n = 1 << size;
        let base = |v: i32| rounded(mean + v);
        if leaf.levels.is_empty() {
            for k in 0..n {
                self.set_above(x + k, base(0));
                self.set_left(y + k, base(0));
            }
            return;
        }
        let mut pair = Pair::default();
        for i in 0..n / 2 {
            inverse.rows::<S>(i, &mut pair);
            let [_, upper, _, lower] = inverse.pixels_apart::<S>(&pair, 0);
            self.set_left(y + i, base(upper));
            self.set_left(y + n - 1 - i, base(lower));
            if i == 0 {
                for j in 0..n / 2 {
                    let [_, _, left, right] = inverse.pixels_apart::<S>(&pair, j);
                    self.set_above(x + j, base(left));
                    self.set_above(x + n - 1 - j, base(right));
                }
            }
        }
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
        let rows = shape.rows();
        let offset = shape.scaled(shape.half_rows()) - shape.scaled(shape.side() >> 1);
        for y in y0..y0 + n {
            if 2 * y + 1 >= rows {
                break;
            }
            let from = (2 * y - band) * columns + 2 * x0;
            let at = ((y - (band >> 1) + offset) * width + x0) as usize;
            let Some(to) = self.half.get(at..at + n.min(width - x0) as usize) else { break };
            for (to, k) in to.iter().zip(0..) {
                to.set(S::cut(halved(self.picture, from + 2 * k, columns)));
            }
        }
    }

    /// Where the samples of a domain are; none where a small scale leaves no room.
    #[inline(never)]
    fn source(&self, domain: &Domain, place: Place, size: u32) -> Option<Source<'a, S>> {
        let shape = &self.shape;
        let drawn = shape.drawn(size);
        let m = 1_u32 << drawn;
        let columns = shape.columns();
        let width = columns >> 1;
        let windowed = shape.window.is_some();
        let rows = if windowed { shape.scaled(shape.half_rows()) } else { shape.rows() >> 1 };
        if m > width || m > rows {
            return None;
        }
        let y = if windowed { (place.y as i32 - self.half_top).max(0) as u32 } else { place.y };
        let (px, py) = (shape.scaled(place.x).min(width - m), shape.scaled(y).min(rows - m));
        let source = if windowed {
            Source { samples: self.half, start: py * width + px, right: 1, down: width, lower: 0 }
        } else {
            let down = 2 * columns;
            Source { samples: self.picture, start: py * down + 2 * px, right: 2, down, lower: columns }
        };
        Some(source.turned(domain.isometry, drawn))
    }
}
