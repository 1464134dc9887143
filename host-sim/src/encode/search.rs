//! Domains that resemble a square: those near it one by one, those further away from an index.
//!
//! What a domain takes off the square's error at the best contrast `c = <r, d> / <d, d>` is `c <r, d>`, means
//! off: the square of the cosine between the two, times `<r, r>`. So the index is a k-d tree (J. Bentley,
//! 1975)
//! of unit vectors of low frequencies: those near a square's own, or near its negative, are the candidates,
//! whatever their contrast (D. Saupe, "Accelerating fractal image compression by multi-dimensional nearest
//! neighbor search", 1995).

use attractor::codec::shared::{Domain, Place, Shape};
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use pulp::Arch;
use rayon::prelude::*;

use super::cosine::{Coefficients, Cosine};
use super::rounded::rows_of;
use super::samples::Samples;

/// How hard to look.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    /// 1 or 8.
    pub(super) isometries: u32,
    /// How many candidates a square has.
    pub(super) candidates: usize,
    /// Whether to look beyond what is near.
    pub(super) far: bool,
    /// How often the levels of a leaf are weighed again.
    pub(super) rounds: u32,
    /// Whether leaves are weighed once more with their samples as they are rounded.
    pub(super) polish: bool,
    /// What part of a bin's price is that of the encoding before on the whole.
    pub(super) whole: f32,
    /// What part of the bytes asked for is enough.
    pub(super) filled: f64,
    /// Whether there are more encodings, which differ by little, once the bytes are met.
    pub(super) again: bool,
}

/// A domain and what it takes off the error, in little room: there are more of them than pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) gain: f32,
    column: u16,
    row: u16,
    isometry: u8,
    near: bool,
}

impl Candidate {
    const fn new(gain: f32, domain: &Domain) -> Self {
        let Domain { near, column, row, isometry, .. } = *domain;
        // pictures have at most 16384 pixels a side
        Self { gain, column: column as u16, row: row as u16, isometry: isometry as u8, near }
    }

    /// Of any contrast.
    pub(super) fn domain(&self) -> Domain {
        let [column, row] = [self.column, self.row].map(u32::from);
        Domain { near: self.near, column, row, isometry: self.isometry.into(), scaling: 0 }
    }
}

/// The candidates of every square of every size.
pub(super) struct Candidates {
    by_size: [Vec<Box<[Candidate]>>; 4],
    columns: [usize; 4],
}

/// What is asked of the index at a time.
const NEAREST: usize = 8;
/// Low frequencies `(v, u)` that it knows.
const KNOWN: [usize; 8] = [0x01, 0x10, 0x11, 0x02, 0x20, 0x12, 0x21, 0x22];

type Tree = ImmutableKdTree<f32, 8>;

impl Candidates {
    /// None at all.
    pub(super) const fn none() -> Self {
        Self { by_size: [const { Vec::new() }; 4], columns: [0; 4] }
    }

    /// Those in `pool`, the picture halved, for squares with more energy than `least`.
    pub(super) fn find(
        shape: &Shape,
        original: &Samples,
        pool: &Samples,
        effort: Effort,
        least: f32,
    ) -> Self {
        let mut this = Self::none();
        let (cosine, pool) = (Cosine::new(), Pool::new(pool));
        let pool = &pool;
        for size in 2..=shape.largest {
            let k = (size - 2) as usize;
            let (columns, rows) = (shape.width.div_ceil(1 << size), shape.height.div_ceil(1 << size));
            this.columns[k] = columns as usize;
            let bands = (0..shape.height).step_by(shape.side() as usize);
            let indices: Vec<Index> = if effort.far {
                // those of one band are those of all, where there is no window
                bands
                    .take(if shape.window.is_some() { usize::MAX } else { 1 })
                    .map(|band| Index::new(shape, pool, size, band, &cosine))
                    .collect()
            } else {
                Vec::new()
            };
            let square = |i: u32| {
                let (x, y) = ((i % columns) << size, (i / columns) << size);
                let band = if shape.window.is_some() { (y >> shape.largest) as usize } else { 0 };
                Square::new(original, x, y, size).search(
                    shape,
                    pool,
                    indices.get(band),
                    &cosine,
                    effort,
                    least,
                )
            };
            this.by_size[k] = (0..columns * rows).into_par_iter().map(square).collect();
        }
        this
    }

    /// Those of a square, the best first.
    pub(super) fn of(&self, x: u32, y: u32, size: u32) -> &[Candidate] {
        let k = (size - 2) as usize;
        let at = (y >> size) as usize * self.columns[k] + (x >> size) as usize;
        self.by_size[k].get(at).map_or(&[], |list| list)
    }
}

/// Where domains lie: samples, and the sums of all above and to the left of each and of their squares.
struct Pool<'a> {
    samples: &'a Samples,
    sums: Vec<[f64; 2]>,
}

impl<'a> Pool<'a> {
    fn new(samples: &'a Samples) -> Self {
        let across = samples.width + 1;
        let mut sums = vec![[0.0; 2]; across];
        for row in samples.values.chunks_exact(samples.width) {
            let mut left = [0.0; 2];
            sums.push(left);
            for value in row {
                let (value, [above, squares]) = (f64::from(*value), sums[sums.len() - across]);
                left = [left[0] + value, left[1] + value * value];
                sums.push([above + left[0], squares + left[1]]);
            }
        }
        Self { samples, sums }
    }

    /// Of a square of `n` a side, its mean off.
    fn energy(&self, x: usize, y: usize, n: usize) -> f32 {
        let across = self.samples.width + 1;
        let corners =
            [(y + n, x + n), (y, x), (y, x + n), (y + n, x)].map(|(y, x)| self.sums[y * across + x]);
        let [sum, squares] = [0, 1].map(|i| corners[0][i] + corners[1][i] - corners[2][i] - corners[3][i]);
        (squares - sum * sum / (n * n) as f64) as f32
    }
}

/// The far domains of leaves of one size.
struct Index {
    tree: Option<Tree>,
    places: Vec<(u32, u32)>,
}

/// The direction of the lower frequencies.
fn direction(coefficients: &Coefficients) -> Option<[f32; 8]> {
    let known = KNOWN.map(|place| coefficients[place]);
    let length = known.iter().map(|value| value * value).sum::<f32>().sqrt();
    (length > 1e-3).then(|| known.map(|value| value / length))
}

impl Index {
    fn new(shape: &Shape, pool: &Pool, size: u32, band: u32, cosine: &Cosine) -> Self {
        let (mut places, mut directions) = (Vec::new(), Vec::new());
        let (mut square, mut coefficients) = ([0.0; 1024], [0.0; 256]);
        for row in 0..shape.far(size).map_or(0, |(_, rows)| rows) {
            for column in 0..shape.far(size).map_or(0, |(columns, _)| columns) {
                let domain = Domain { near: false, column, row, isometry: 0, scaling: 0 };
                // as seen from the end of the band, where most of it is decoded
                let last = (shape.width - 1) >> size << size;
                let below = (band + shape.side() - (1 << size)).min((shape.height - 1) >> size << size);
                let Some(Place { x: px, y: py, .. }) = shape.place(&domain, last, below, size) else {
                    continue;
                };
                pool.samples.square(px, py, 1 << size, &mut square);
                cosine.forward(size, &square, &mut coefficients);
                if let Some(direction) = direction(&coefficients) {
                    places.push((column, row));
                    directions.push(direction);
                }
            }
        }
        let tree = (!places.is_empty()).then(|| Tree::new_from_slice(&directions));
        Self { tree, places }
    }
}

/// The product of a square of `N` a side with one that begins at a sample of a picture so wide.
#[inline(always)]
fn dot<const N: usize>(square: &[f32], (samples, width): (&[f32], usize)) -> f32 {
    let mut sums = [0.0; N];
    let rows = samples.chunks(width).filter_map(|row| row.first_chunk::<N>());
    for (a, b) in rows_of::<N>(square).zip(rows).take(N) {
        for j in 0..N {
            sums[j] += a[j] * b[j];
        }
    }
    sums.iter().sum()
}

/// A square that looks for its domain.
struct Square {
    x: u32,
    y: u32,
    size: u32,
    energy: f32,
    values: [f32; 1024],
}

impl Square {
    fn new(original: &Samples, x: u32, y: u32, size: u32) -> Self {
        let mut values = [0.0; 1024];
        original.square(x, y, 1 << size, &mut values);
        let energy = values[..1 << (2 * size)].iter().map(|value| value * value).sum();
        Self { x, y, size, energy, values }
    }

    /// The square laid onto a domain that is turned by the isometry.
    fn turned(&self, isometry: u32) -> [f32; 1024] {
        let n = 1 << self.size;
        let mut turned = [0.0; 1024];
        for i in 0..n {
            for j in 0..n {
                let (mut row, mut column) = if isometry & 4 == 0 { (i, j) } else { (j, i) };
                if isometry & 1 != 0 {
                    column = n - 1 - column;
                }
                if isometry & 2 != 0 {
                    row = n - 1 - row;
                }
                turned[row * n + column] = self.values[i * n + j];
            }
        }
        turned
    }

    fn search(
        &self,
        shape: &Shape,
        pool: &Pool,
        index: Option<&Index>,
        cosine: &Cosine,
        effort: Effort,
        least: f32,
    ) -> Box<[Candidate]> {
        let mut best = Best { list: Vec::with_capacity(effort.candidates + 1), most: effort.candidates };
        if self.energy < least {
            return best.list.into();
        }
        let turned: Vec<[f32; 1024]> = (0..effort.isometries).map(|isometry| self.turned(isometry)).collect();
        Arch::new().dispatch(
            #[inline(always)]
            || {
                for row in 0..16 {
                    for column in 0..16 {
                        let domain = Domain { near: true, column, row, isometry: 0, scaling: 0 };
                        self.weigh(shape, pool, domain, (0..).zip(&turned), &mut best);
                    }
                }
            },
        );
        let Some(Index { tree: Some(tree), places }) = index else { return best.list.into() };
        let mut coefficients = [0.0; 256];
        for (isometry, square) in (0..).zip(&turned) {
            cosine.forward(self.size, square, &mut coefficients);
            let Some(direction) = direction(&coefficients) else { continue };
            for direction in [direction, direction.map(|value| -value)] {
                let nearest = std::num::NonZero::new(NEAREST).unwrap_or(std::num::NonZero::<usize>::MIN);
                for found in tree.nearest_n::<SquaredEuclidean>(&direction, nearest) {
                    let (column, row) = places[found.item as usize];
                    let domain = Domain { near: false, column, row, isometry, scaling: 0 };
                    self.weigh(shape, pool, domain, [(isometry, square)].into_iter(), &mut best);
                }
            }
        }
        best.list.into()
    }

    /// Offers a domain in each of the isometries.
    #[inline(always)]
    fn weigh<'a>(
        &self,
        shape: &Shape,
        pool: &Pool,
        domain: Domain,
        turned: impl Iterator<Item = (u32, &'a [f32; 1024])>,
        best: &mut Best,
    ) {
        let Some(Place { x: px, y: py, .. }) = shape.place(&domain, self.x, self.y, self.size) else {
            return;
        };
        let n = 1_usize << self.size;
        let (px, py) = (px as usize, py as usize);
        let energy = pool.energy(px, py, n);
        if energy < 0.5 * (n * n) as f32 {
            return;
        }
        let place = (&pool.samples.values[py * pool.samples.width + px..], pool.samples.width);
        for (isometry, square) in turned {
            let dot = match self.size {
                2 => dot::<4>(square, place),
                3 => dot::<8>(square, place),
                4 => dot::<16>(square, place),
                _ => dot::<32>(square, place),
            };
            let contrast = (dot / energy).clamp(-1.0, 1.0);
            let gain = 2.0 * contrast * dot - contrast * contrast * energy;
            best.offer(Candidate::new(gain, &Domain { isometry, ..domain }));
        }
    }
}

/// The best so far, the best first.
struct Best {
    list: Vec<Candidate>,
    most: usize,
}

impl Best {
    fn offer(&mut self, candidate: Candidate) {
        let at = self.list.partition_point(|other| other.gain > candidate.gain);
        if at < self.most {
            self.list.insert(at, candidate);
            self.list.truncate(self.most);
        }
    }
}
