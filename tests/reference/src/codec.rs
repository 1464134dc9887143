//! The image format, decoded in f64 from docs/IMAGE-FORMAT.md: what is said is read exactly, what is shown is
//! computed as the formulas have it, with cosines instead of tables, and rounded to samples once. What later
//! means depend on, the base along edges, is in the integers that the page states.

use std::f64::consts::PI;

/// A decoded picture: planes with their sizes, and the sample's greatest value.
#[derive(Debug, Clone)]
pub struct Decoded {
    /// Width, height and samples, row after row.
    pub planes: Vec<(usize, usize, Vec<f64>)>,
    /// The samples in the integers of the format, every rounding as its page states it.
    pub exact: Vec<Vec<i64>>,
    /// Of each sample, by how much a decoder may be off that rounds where the format says so: a whole number.
    /// What is off by `e` before it is rounded may be rounded otherwise only within `e` of a half; in sweeps
    /// what is copied is off by the contrast times what its domain was off.
    pub off: Vec<Vec<f64>>,
    /// 255 or 65535.
    pub peak: f64,
    /// The leaves of the first plane, in their order.
    pub leaves: Vec<Leaf>,
}

/// Half of the last of 7 fractional bits.
const HALF_BIT: f64 = 1.0 / 256.0;

struct Reader<'a> {
    bytes: &'a [u8],
    range: u64,
    code: u64,
    version: u8,
    models: std::collections::HashMap<(&'static str, usize, usize), (u32, u32)>,
}

impl Reader<'_> {
    fn next(&mut self) -> u64 {
        let Some((first, rest)) = self.bytes.split_first() else { return 0 };
        self.bytes = rest;
        u64::from(*first)
    }

    fn fill(&mut self) {
        while self.range < 1 << 24 {
            self.range *= 256;
            self.code = self.code * 256 + self.next();
        }
    }

    /// A bin under the model named so.
    fn bin(&mut self, what: &'static str, of: usize, index: usize) -> bool {
        let (p, count) = *self.models.entry((what, of, index)).or_insert((32768, 0));
        let bound = self.range / 8192 * u64::from(p / 8);
        let one = self.code >= bound;
        if one {
            self.code -= bound;
            self.range -= bound;
        } else {
            self.range = bound;
        }
        self.fill();
        let left = if one { p } else { 65528 - p };
        let by = match self.version {
            1 => left / 8 / [4, 8, 8, 16, 16, 32][count.min(5) as usize] * 8,
            _ => left / (count + 3).min(96),
        };
        self.models.insert((what, of, index), (if one { p - by } else { p + by }, count + 1));
        one
    }

    fn raw(&mut self, count: u32) -> u64 {
        (0..count).fold(0, |bits, _| {
            self.range /= 2;
            let one = self.code >= self.range;
            if one {
                self.code -= self.range;
            }
            self.fill();
            2 * bits + u64::from(one)
        })
    }

    fn tree(&mut self, what: &'static str, of: usize, count: u32) -> usize {
        let node = (0..count).fold(1, |node, _| 2 * node + usize::from(self.bin(what, of, node)));
        node - (1 << count)
    }

    fn number(&mut self, what: &'static str, of: usize) -> i64 {
        let mut doublings = 0;
        while doublings < 20 && self.bin(what, of, doublings.min(9)) {
            doublings += 1;
        }
        if doublings == 0 {
            return 0;
        }
        let first = u64::from(self.bin(what, of, 10 + doublings.min(9)));
        let rest = self.raw(doublings as u32 - 1);
        ((2 + first) * (1 << (doublings - 1)) + rest - 1) as i64
    }
}

/// `v / 2^bits`, to nearest, halves upwards.
fn rounded(v: i64, bits: usize) -> i64 {
    if bits == 0 { v } else { (v + (1 << (bits - 1))) >> bits }
}

/// A leaf of the partition: a map, and what is added.
#[derive(Debug, Clone)]
pub struct Leaf {
    /// Column.
    pub x: usize,
    /// Row.
    pub y: usize,
    /// Side.
    pub n: usize,
    /// Place in the halved picture, isometry, contrast.
    pub domain: Option<(usize, usize, usize, f64)>,
    /// Mean.
    pub mean: f64,
    /// `(v, u)`, level and value.
    pub coefficients: Vec<(usize, usize, i64, f64)>,
    /// The mean in the format's `2^-7`.
    whole: i64,
}

struct Plane {
    width: usize,
    height: usize,
    /// Logarithm of the size that is drawn, and columns and rows of that.
    scale: i32,
    wide: usize,
    high: usize,
    /// Rows above a band that a domain may lie in; none: anywhere.
    window: Option<usize>,
    largest: usize,
    chroma: usize,
    q: f64,
    q8: i64,
    peak: f64,
    samples: Vec<f64>,
    exact: Vec<i64>,
    /// By how much each may be off.
    off: Vec<f64>,
    /// Whether each was drawn.
    drawn: Vec<bool>,
    /// Base of what was decoded, in the integers of the format, as later means depend on it to the bit; the
    /// depth and whether there is a domain, by pixel.
    base: Vec<i64>,
    seen: Vec<Option<(usize, bool)>>,
    across: usize,
    /// By cell of 4 x 4: no sweep changes it any more.
    settled: Vec<bool>,
    /// Leaves in their order, so that sweeps can be done again.
    leaves: Vec<Leaf>,
}

/// Places of the coefficients of `s` frequencies an axis.
fn zigzag(s: usize) -> Vec<(usize, usize)> {
    let diagonal = |d: usize| {
        let mut places: Vec<_> = (0..=d).map(|v| (v, d - v)).filter(|(v, u)| *v < s && *u < s).collect();
        if d.is_multiple_of(2) {
            places.reverse();
        }
        places
    };
    (0..2 * s - 1).flat_map(diagonal).collect()
}

fn class(i: usize) -> usize {
    [1, 2, 3, 4, 6, 10, 15, 21, 28, 45, 64, 128].iter().filter(|first| i >= **first).count()
}

impl Plane {
    fn at(&self, x: usize, y: usize) -> usize {
        y * self.across + x
    }

    /// The leaf read at a place.
    fn leaf(
        &mut self,
        reader: &mut Reader<'_>,
        x: usize,
        y: usize,
        k: usize,
        window: Option<usize>,
        pure: bool,
    ) {
        let n = 1 << k;
        let band = y / self.largest * self.largest;
        let left = if x == 0 { None } else { self.seen[self.at(x - 1, y)] };
        let above = if y == 0 { None } else { self.seen[self.at(x, y - 1)] };
        let with_domain = [left, above].iter().filter(|leaf| leaf.is_some_and(|(_, domain)| domain)).count();
        let kind = self.chroma * 4 + k;
        let mut domain = None;
        if reader.bin("domain", kind, with_domain) {
            let rows = window.map_or(self.height / 2, |window| (window + self.largest) / 2);
            let (columns, rows) = (self.width / n, rows / (n / 2));
            let far = k > 2 && columns > 0 && rows > 0;
            let near = !far || reader.bin("near", k, 0);
            let isometry = reader.tree("isometry", 0, 3);
            let top = window.map_or(0, |window| band as i64 / 2 - window as i64 / 2);
            let (px, py) = if near {
                let step = if n == 4 { 1 } else { n as i64 / 4 };
                let column = reader.tree("column", k, 4) as i64 - 8;
                let row = reader.tree("row", k, 4) as i64 - if window.is_some() { 14 } else { 8 };
                let from = |v: usize| v as i64 / 2 - n as i64 / 4;
                (from(x) + step * column, from(y) + step * row)
            } else {
                let last = columns * rows - 1;
                let place = (reader.raw(usize::BITS - last.leading_zeros()) as usize).min(last);
                ((place % columns * n / 2) as i64, top + (place / columns * n / 2) as i64)
            };
            let contrast = reader.tree("contrast", k, 4);
            let sign = if contrast >= 8 { -1.0 } else { 1.0 };
            domain = Some((px as usize, py as usize, isometry, sign * (contrast % 8 + 1) as f64 / 8.0));
        }
        let mut steps = reader.number("mean", kind);
        if steps != 0 && reader.bin("sign", kind, 0) {
            steps = -steps;
        }
        let mut coefficients = Vec::new();
        if !pure {
            let scan = zigzag(n.min(16));
            let last = (reader.number("last", kind) as usize).min(scan.len() - 1);
            let mut sizes = [[0; 17]; 17];
            for (i, (v, u)) in scan.iter().enumerate().take(last + 1).skip(1) {
                // one more than the place, so that there is something above and to the left
                let about = (sizes[*v][*u + 1] + sizes[*v + 1][*u]).min(2);
                let of = k * 20 + class(i);
                if i < last && !reader.bin("significant", of, about as usize) {
                    continue;
                }
                let large = reader.bin("large", of, 0);
                let size = if large { 2 + reader.number("magnitude", 0) } else { 1 }.min(8191);
                sizes[*v + 1][*u + 1] = size;
                let level = if reader.raw(1) == 1 { -size } else { size };
                coefficients.push((*v, *u, level, level as f64 * self.q));
            }
        }
        let (mean, whole) = self.expected(x, y, n);
        let moved = rounded(steps * self.q8, 1 + k).clamp(-(1 << 25), 1 << 25);
        let mean = mean + steps as f64 * self.q / n as f64;
        self.keep(Leaf { x, y, n, domain, mean, coefficients, whole: whole + moved });
    }

    /// What the neighbours' edges let expect, and the same in the format's `2^-7`.
    fn expected(&self, x: usize, y: usize, n: usize) -> (f64, i64) {
        let mut edge = Vec::new();
        if y > 0 {
            edge.extend((0..n).map(|j| self.base[self.at(x + j, y - 1)]));
        }
        if x > 0 {
            edge.extend((0..n).map(|i| self.base[self.at(x - 1, y + i)]));
        }
        if edge.is_empty() {
            let half = (self.peak + 1.0) / 2.0;
            return (half, 128 * half as i64);
        }
        let sum: i64 = edge.iter().sum();
        (sum as f64 / edge.len() as f64, rounded(128 * sum, edge.len().ilog2() as usize))
    }

    /// By how much a value is off that is rounded to a sample, where before it was by `off`.
    fn rounded_off(&self, value: f64, off: f64) -> f64 {
        let sample = |value: f64| (value + 0.5).floor().clamp(0.0, self.peak);
        let here = sample(value);
        (sample(value + off) - here).max(here - sample(value - off))
    }

    fn keep(&mut self, leaf: Leaf) {
        let values = leaf.values(self.q8, self.peak as i64, leaf.n);
        for (k, value) in values.into_iter().enumerate() {
            let at = self.at(leaf.x + k % leaf.n, leaf.y + k / leaf.n);
            self.base[at] = rounded(value, 7).clamp(0, self.peak as i64);
            self.seen[at] = Some((leaf.n, leaf.domain.is_some()));
        }
        self.leaves.push(leaf);
    }

    /// A sample of the halved picture, by how much it is off, and the same in integers.
    fn halved(&self, x: usize, y: usize) -> (f64, f64, i64) {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(a, b)| (2 * y + b) * self.wide + 2 * x + a);
        let drawn = self.window.is_none() || four.iter().all(|at| self.drawn[*at]);
        assert!(drawn, "one pass takes ({x}, {y}) of the halved picture before it was drawn");
        let sum: f64 = four.iter().map(|at| self.samples[*at]).sum();
        let off: f64 = four.iter().map(|at| self.off[*at]).sum();
        let exact: i64 = four.iter().map(|at| self.exact[*at]).sum();
        let quarter = |sum: f64| (sum / 4.0 + 0.5).floor();
        let off = (quarter(sum + off) - quarter(sum)).max(quarter(sum) - quarter(sum - off));
        (quarter(sum), off, (exact + 2) >> 2)
    }

    /// A length as it is drawn, rounded down.
    fn scaled(&self, v: usize) -> usize {
        (v << 2) >> (2 - self.scale)
    }

    /// Draws a leaf, with its domain or as if it had none.
    fn draw(&mut self, leaf: &Leaf, with_domain: bool) {
        let n = self.scaled(leaf.n);
        let values = leaf.values(self.q8, self.peak as i64, n);
        // what is added, by how much that is off, and the same in the format's 2^-7
        let mut copy = vec![(0.0, 0.0, 0); n * n];
        if let Some((px, py, isometry, contrast)) = leaf.domain.filter(|_| with_domain) {
            let (px, py) = (self.scaled(px), self.scaled(py));
            let square: Vec<_> = (0..n * n).map(|k| self.halved(px + k % n, py + k / n)).collect();
            let (mut sum, mut off, mut whole) = (0.0, 0.0, 0);
            for (d, e, exact) in &square {
                (sum, off, whole) = (sum + d, off + e, whole + exact);
            }
            // the mean is rounded to 2^-4
            let (mean, mean_off) = (sum / (n * n) as f64, off / (n * n) as f64 + 1.0 / 32.0);
            let whole = rounded(16 * whole, 2 * n.ilog2() as usize);
            for (k, copied) in copy.iter_mut().enumerate() {
                let (i, j) = (k / n, k % n);
                let (mut row, mut column) = if isometry & 4 == 0 { (i, j) } else { (j, i) };
                if isometry & 1 != 0 {
                    column = n - 1 - column;
                }
                if isometry & 2 != 0 {
                    row = n - 1 - row;
                }
                let (d, off, exact) = square[row * n + column];
                let eighths = (8.0 * contrast) as i64;
                let (value, off) = (contrast * (d - mean), contrast.abs() * (off + mean_off));
                *copied = (value, off, eighths * (16 * exact - whole));
            }
        }
        let off: Vec<f64> = (0..n).map(|j| leaf.off(j, n)).collect();
        let (left, top) = (self.scaled(leaf.x), self.scaled(leaf.y));
        for (k, (copied, copied_off, whole)) in copy.into_iter().enumerate() {
            let (x, y) = (left + k % n, top + k / n);
            if x < self.wide && y < self.high {
                let (at, value) = (y * self.wide + x, leaf.mean + leaf.pixel(k / n, k % n, n) + copied);
                self.samples[at] = (value + 0.5).floor().clamp(0.0, self.peak);
                self.off[at] = self.rounded_off(value, off[k % n] + copied_off);
                self.drawn[at] = true;
                self.exact[at] = rounded(values[k] + whole, 7).clamp(0, self.peak as i64);
            }
        }
    }

    /// Joins a leaf that is drawn larger to what is to the left and above; to what is above in a window of
    /// rows only within a band. What is beyond the leaf's edges changes if `both` do.
    fn join(&mut self, leaf: &Leaf, both: bool) {
        let (n, left, top) = (self.scaled(leaf.n), self.scaled(leaf.x), self.scaled(leaf.y));
        let above = if self.window.is_some() { leaf.y % self.largest } else { leaf.y };
        let length = |there: bool| if there && self.scale > 0 { n } else { 0 };
        let down = (0..length(leaf.x > 0)).map(|k| (left, top + k, 1));
        let right = (0..length(above > 0)).map(|k| (left + k, top, self.wide));
        let inside = down.chain(right).filter(|(x, y, _)| *x < self.wide && *y < self.high);
        let seams: Vec<_> = inside.map(|(x, y, step)| (y * self.wide + x, step)).collect();
        for (at, step) in seams {
            // a sample next to an edge, of that behind it, itself and that beyond the edge
            let mean = |behind: usize, here: usize, beyond: usize| {
                let mix = |all: &[f64]| (all[behind] + 12.0 * all[here] + 3.0 * all[beyond]) / 16.0;
                let (value, off) = (mix(&self.samples), mix(&self.off));
                let exact = self.exact[behind] + 12 * self.exact[here] + 3 * self.exact[beyond];
                (here, (value + 0.5).floor(), self.rounded_off(value, off), rounded(exact, 4))
            };
            let means = [mean(at - 2 * step, at - step, at), mean(at + step, at, at - step)];
            for (at, sample, off, exact) in means.into_iter().skip(usize::from(!both)) {
                (self.samples[at], self.off[at], self.exact[at]) = (sample, off, exact);
            }
        }
    }

    /// One sweep; `first` if none was before it.
    fn sweep(&mut self, first: bool) {
        let across = self.across / 4;
        let cells = |x: usize, y: usize, side: usize| {
            (y / 4..(y + side).div_ceil(4))
                .flat_map(move |row| (x / 4..(x + side).div_ceil(4)).map(move |column| row * across + column))
        };
        for leaf in self.leaves.clone() {
            if self.settled[leaf.y / 4 * across + leaf.x / 4] {
                continue;
            }
            let ready = leaf
                .domain
                .is_none_or(|(px, py, ..)| cells(2 * px, 2 * py, 2 * leaf.n).all(|cell| self.settled[cell]));
            self.draw(&leaf, ready || !first);
            if ready {
                cells(leaf.x, leaf.y, leaf.n).for_each(|cell| self.settled[cell] = true);
            }
            self.join(&leaf, ready);
        }
    }

    fn square(
        &mut self,
        reader: &mut Reader<'_>,
        x: usize,
        y: usize,
        k: usize,
        window: Option<usize>,
        pure: bool,
    ) {
        let n = 1 << k;
        if x >= self.width || y >= self.height {
            let (mean, whole) = self.expected(x, y, n);
            let empty = Leaf { x, y, n, domain: None, mean, coefficients: Vec::new(), whole };
            self.keep(empty);
            return;
        }
        if k > 2 {
            let left = if x == 0 { None } else { self.seen[self.at(x - 1, y)] };
            let above = if y == 0 { None } else { self.seen[self.at(x, y - 1)] };
            let smaller = [left, above].iter().filter(|leaf| leaf.is_some_and(|(side, _)| side < n)).count();
            if reader.bin("divided", self.chroma * 4 + k, smaller) {
                for (dx, dy) in [(0, 0), (n / 2, 0), (0, n / 2), (n / 2, n / 2)] {
                    self.square(reader, x + dx, y + dy, k - 1, window, pure);
                }
                return;
            }
        }
        self.leaf(reader, x, y, k, window, pure);
        if window.is_some()
            && let Some(leaf) = self.leaves.last().cloned()
        {
            self.draw(&leaf, true);
        }
    }
}

impl Leaf {
    /// Mean and transform in `2^-7`, row by row, by the format's three steps, drawn with `n` a side.
    fn values(&self, q8: i64, peak: i64, n: usize) -> Vec<i64> {
        let k = self.n.ilog2() as usize;
        let cosine = |turn: usize| match turn % (4 * n) {
            0 => 1 << 14,
            turn => (16384.0 * (PI * turn as f64 / (2 * n) as f64).cos()).round() as i64,
        };
        // a constant for frequency 0 down
        let down = |v: usize, i: usize| if v == 0 { 11585 } else { cosine((2 * i + 1) * v) };
        let most = if peak > 255 { 1 << 23 } else { 1 << 13 };
        let mut values = Vec::new();
        for i in 0..n {
            let mut terms = [0; 16];
            for (v, u, level, _) in self.coefficients.iter().filter(|(v, u, ..)| *v < n && *u < n) {
                terms[*u] += down(*v, i) * level;
            }
            let mut terms = terms.map(|t| i64::from(rounded(t * q8, 17 + k) as i32).clamp(-most, most - 1));
            terms[0] = rounded(11585 * terms[0], 14);
            for j in 0..n {
                let sum: i64 = (0..n.min(16)).map(|u| cosine((2 * j + 1) * u) * terms[u]).sum();
                values.push(self.whole + rounded(sum, 11));
            }
        }
        values
    }

    /// The transform at row `i` and column `j`, drawn with `side` pixels a side.
    fn pixel(&self, i: usize, j: usize, side: usize) -> f64 {
        let n = side as f64;
        let wave = |k: usize, i: usize| {
            let scale = if k == 0 { 0.5_f64.sqrt() } else { 1.0 };
            scale * (PI * (2 * i + 1) as f64 * k as f64 / (2.0 * n)).cos()
        };
        let there = self.coefficients.iter().filter(|(v, u, ..)| *v < side && *u < side);
        there.map(|(v, u, _, value)| 2.0 / self.n as f64 * value * wave(*v, i) * wave(*u, j)).sum()
    }

    /// By how much mean and transform, drawn with `side` pixels a side, are off in column `j` where they are
    /// computed as the format has it: the mean of the edges and the steps by `2^-8` each; each cosine by
    /// `2^-15`, a column's term by `2^-5`, the first of them twice, the sum by `2^-8`.
    fn off(&self, j: usize, side: usize) -> f64 {
        let n = self.n as f64;
        let (table, term) = (0.5_f64.powi(15), 1.0 / 32.0);
        let mut off = if self.coefficients.is_empty() { 2.0 * HALF_BIT } else { 3.0 * HALF_BIT };
        for u in 0..side.min(16) {
            let column = self.coefficients.iter().filter(|(v, of, ..)| *of == u && *v < side);
            let largest = column.map(|(.., value)| 2.0 / n * value.abs()).sum::<f64>();
            if largest == 0.0 {
                continue;
            }
            let mut column_off = largest * table + term;
            if u == 0 {
                column_off = column_off * 0.5_f64.sqrt() + largest * table + term;
            }
            let wave = (PI * ((2 * j + 1) * u) as f64 / (2 * side) as f64).cos().abs();
            off += (wave + table) * column_off + largest * table;
        }
        off
    }
}

/// Decodes a whole, undamaged file.
///
/// # Panics
/// For any other bytes.
pub fn decode(file: &[u8]) -> Decoded {
    decode_scaled(file, 0)
}

/// The same `2^scale` times as large, from -2 to 2.
///
/// # Panics
/// For any other bytes.
pub fn decode_scaled(file: &[u8], scale: i32) -> Decoded {
    let version = file[4];
    assert!(file.starts_with(b"ATFI") && (1..=2).contains(&version));
    let pair = |at: usize| usize::from(file[at]) + 256 * usize::from(file[at + 1]);
    let flags = file[5];
    let (width, height, q8) = (pair(6), pair(8), ((256 + u64::from(file[10])) << file[11]) >> 4);
    let (reach, chroma) = (usize::from(file[12]), u64::from(file[13]));
    let digits = 1 + file[14..].iter().position(|byte| *byte < 128).unwrap();
    let length = (0..digits).map(|k| usize::from(file[14 + k] & 127) << (7 * k)).sum::<usize>();
    let payload = &file[14 + digits..][..length];
    let (profile, kind) = (flags & 3, flags >> 2 & 3);
    let peak = if flags & 16 == 0 { 255.0 } else { 65535.0 };
    let mut planes: Vec<Plane> = (0..if kind == 0 { 1 } else { 3 })
        .map(|plane| {
            let halved = usize::from(plane > 0 && kind == 2);
            let (width, height, largest) =
                ((width + halved) >> halved, (height + halved) >> halved, 32 >> halved);
            let across = width.div_ceil(largest) * largest;
            let all = across * height.div_ceil(largest) * largest;
            let start = if plane == 0 { 0.0 } else { (peak + 1.0) / 2.0 };
            let drawn = |v: usize| ((v << 2) + (1 << (2 - scale)) - 1) >> (2 - scale);
            let (wide, high) = (drawn(width), drawn(height));
            let q8 = if plane == 0 { q8 } else { (q8 * chroma / 16).clamp(1, (511 << 23) >> 4) };
            Plane {
                width,
                height,
                scale,
                wide,
                high,
                window: (profile == 0).then_some(reach * 8 * largest / 32),
                largest,
                chroma: usize::from(plane > 0),
                q: q8 as f64 / 256.0,
                q8: q8 as i64,
                peak,
                samples: vec![start; wide * high],
                exact: vec![start as i64; wide * high],
                off: vec![0.0; wide * high],
                drawn: vec![false; wide * high],
                base: vec![0; all],
                seen: vec![None; all],
                settled: vec![false; all / 16],
                across,
                leaves: Vec::new(),
            }
        })
        .collect();
    let mut reader =
        Reader { bytes: payload, range: (1 << 32) - 1, code: 0, version, models: Default::default() };
    for _ in 0..4 {
        reader.code = 256 * reader.code + reader.next();
    }
    for band in 0..height.div_ceil(32) {
        for plane in &mut planes {
            let window = (profile == 0).then_some(reach * 8 * plane.largest / 32);
            let y = band * plane.largest;
            // the leaf to the left of a band's first is none
            for x in (0..plane.width).step_by(plane.largest) {
                let k = plane.largest.ilog2() as usize;
                plane.square(&mut reader, x, y, k, window, profile == 2);
            }
        }
    }
    if profile == 0 {
        // domains are of what was not joined
        for plane in &mut planes {
            plane.leaves.clone().iter().for_each(|leaf| plane.join(leaf, true));
        }
    } else {
        for sweep in 0..reach {
            planes.iter_mut().for_each(|plane| plane.sweep(sweep == 0));
        }
    }
    Decoded {
        leaves: planes.first().map(|plane| plane.leaves.clone()).unwrap_or_default(),
        exact: planes.iter().map(|plane| plane.exact.clone()).collect(),
        off: planes.iter().map(|plane| plane.off.clone()).collect(),
        planes: planes.into_iter().map(|plane| (plane.wide, plane.high, plane.samples)).collect(),
        peak,
    }
}
