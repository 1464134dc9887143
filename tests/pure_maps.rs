//! A stream of profile pure is an iterated function system, and its attractor what its sweeps draw: the
//! copier
//! draws it, all maps applied to a whole picture over and over, and so does the chaos game, one point at a
//! time (CS2401 Computer Graphics, unit V, 5.3.4).
//!
//! A leaf's map halves a square of twice its side, turns it, and takes the height `z` of a point to
//! `s z + M - s d`, `d` the mean of the domain. Both are computed in f64 without any rounding.

use attractor::codec::open;
use attractor::plane::Field as _;
use attractor_reference::codec::{Leaf, decode};

const FILE: &[u8] = include_bytes!("vectors/version-2/pure.atfi");

/// Luma after many sweeps of the kernel's.
fn fixed_point() -> (usize, Vec<f64>) {
    let opened = open(FILE.iter().copied()).unwrap();
    let mut memory = vec![0_u8; opened.samples(0)];
    let mut sweeps = opened.sweeps(0, &mut memory).unwrap();
    for _ in 0..12 {
        sweeps.sweep().unwrap();
    }
    let picture = sweeps.picture();
    let size = picture.size();
    let at = |i: u32| f64::from(picture.sample(0, i % size.width, i / size.width));
    (size.width as usize, (0..size.width * size.height).map(at).collect())
}

/// Where a leaf's pixel `(i, j)` comes from in its domain.
fn turned(isometry: usize, n: usize, i: usize, j: usize) -> (usize, usize) {
    let (row, column) = if isometry & 4 == 0 { (i, j) } else { (j, i) };
    let mirrored = |v: usize, bit: usize| if isometry & bit == 0 { v } else { n - 1 - v };
    (mirrored(row, 2), mirrored(column, 1))
}

fn halved(picture: &[f64], width: usize, x: usize, y: usize) -> f64 {
    let at = 2 * y * width + 2 * x;
    0.25 * (picture[at] + picture[at + 1] + picture[at + width] + picture[at + width + 1])
}

/// The mean of a leaf's domain.
fn mean(leaf: &Leaf, picture: &[f64], width: usize) -> f64 {
    let Some((px, py, ..)) = leaf.domain else { return 0.0 };
    let n = leaf.n;
    (0..n * n).map(|k| halved(picture, width, px + k % n, py + k / n)).sum::<f64>() / (n * n) as f64
}

/// All maps applied to a picture at once.
fn copies(leaves: &[Leaf], picture: &[f64], width: usize) -> Vec<f64> {
    let (height, mut next) = (picture.len() / width, picture.to_vec());
    for leaf in leaves {
        let (n, d) = (leaf.n, mean(leaf, picture, width));
        for k in 0..n * n {
            let (x, y) = (leaf.x + k % n, leaf.y + k / n);
            if x >= width || y >= height {
                continue;
            }
            let copied = leaf.domain.map_or(0.0, |(px, py, isometry, contrast)| {
                let (row, column) = turned(isometry, n, k / n, k % n);
                contrast * (halved(picture, width, px + column, py + row) - d)
            });
            next[y * width + x] = (leaf.mean + copied).clamp(0.0, 255.0);
        }
    }
    next
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() * end as f64) as usize
    }
}

/// Parts of a pixel along each axis.
const PARTS: usize = 4;

/// Heights of points of a chaos game by pixel, the mean of the means of its parts, since points need not fall
/// evenly within a pixel; none where a part has no point. A game begins on a flat leaf, of which every
/// point is
/// known, and ends where no domain is.
fn game(leaves: &[Leaf], attractor: &[f64], width: usize, points: usize) -> Vec<Option<f64>> {
    let means: Vec<f64> = leaves.iter().map(|leaf| mean(leaf, attractor, width)).collect();
    let mut over = vec![Vec::new(); attractor.len()];
    for (index, leaf) in leaves.iter().enumerate() {
        let Some((px, py, ..)) = leaf.domain else { continue };
        for k in 0..4 * leaf.n * leaf.n {
            over[(2 * py + k / (2 * leaf.n)) * width + 2 * px + k % (2 * leaf.n)].push(index);
        }
    }
    let flat: Vec<&Leaf> = leaves.iter().filter(|leaf| leaf.domain.is_none()).collect();
    let (mut random, mut sums) = (Random(1), vec![[(0.0, 0_u32); PARTS * PARTS]; attractor.len()]);
    let mut drawn = 0;
    while drawn < points {
        let leaf = flat[random.below(flat.len())];
        let side = leaf.n as f64;
        let (mut x, mut y, mut z) =
            (leaf.x as f64 + side * random.next(), leaf.y as f64 + side * random.next(), leaf.mean);
        // even a game that could go on for ever is begun again
        for _ in 0..60 {
            if x as usize >= width || y as usize >= attractor.len() / width {
                break;
            }
            let pixel = y as usize * width + x as usize;
            let part = |v: f64| (v.fract() * PARTS as f64) as usize;
            let (sum, count) = &mut sums[pixel][part(y) * PARTS + part(x)];
            (*sum, *count) = (*sum + z, *count + 1);
            drawn += 1;
            if over[pixel].is_empty() {
                break;
            }
            let index = over[pixel][random.below(over[pixel].len())];
            let leaf = &leaves[index];
            let Some((px, py, isometry, contrast)) = leaf.domain else { break };
            // from the domain into the leaf: the inverse of where its pixels come from
            let side = leaf.n as f64;
            let (mut column, mut row) = (x / 2.0 - px as f64, y / 2.0 - py as f64);
            if isometry & 1 != 0 {
                column = side - column;
            }
            if isometry & 2 != 0 {
                row = side - row;
            }
            let (i, j) = if isometry & 4 == 0 { (row, column) } else { (column, row) };
            (x, y) = (leaf.x as f64 + j, leaf.y as f64 + i);
            z = (contrast * (z - means[index]) + leaf.mean).clamp(0.0, 255.0);
        }
    }
    let mean = |parts: [(f64, u32); PARTS * PARTS]| {
        let means = parts.map(|(sum, count)| sum / f64::from(count));
        means.iter().all(|mean| mean.is_finite()).then(|| means.iter().sum::<f64>() / means.len() as f64)
    };
    sums.into_iter().map(mean).collect()
}

#[test]
fn the_copier_and_the_chaos_game_draw_what_the_sweeps_draw() {
    let (width, sweeps) = fixed_point();
    let leaves = decode(FILE).leaves;
    let mapped = leaves.iter().filter(|leaf| leaf.domain.is_some()).count();
    assert!(mapped > 50 && mapped < leaves.len(), "{mapped} of {}", leaves.len());
    // the copier, from white
    let mut picture = vec![255.0; sweeps.len()];
    for _ in 0..40 {
        picture = copies(&leaves, &picture, width);
    }
    let again = copies(&leaves, &picture, width);
    assert!(picture.iter().zip(&again).all(|(a, b)| (a - b).abs() < 0.01), "it is no fixed point");
    let rms = |a: &mut dyn Iterator<Item = f64>| {
        let all: Vec<f64> = a.collect();
        (all.iter().map(|v| v * v).sum::<f64>() / all.len() as f64).sqrt()
    };
    let off = rms(&mut picture.iter().zip(&sweeps).map(|(a, b)| a - b));
    let most = picture.iter().zip(&sweeps).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("copier: {off:.3} in the mean, {most:.3} at most");
    // half a unit's rounding alone is 0.29 in the mean; copied ones are rounded again
    assert!((0.2..0.5).contains(&off) && most < 2.5, "{off} {most}");
    let points = game(&leaves, &picture, width, 6_000_000);
    let drawn: Vec<f64> = points.iter().zip(&sweeps).filter_map(|(z, b)| Some((*z)? - b)).collect();
    let off = rms(&mut drawn.iter().copied());
    println!("chaos game: {off:.3} in the mean, {} of {} pixels", drawn.len(), sweeps.len());
    assert!(drawn.len() * 5 > sweeps.len() * 4 && off < 0.7, "{off} {}", drawn.len());
}
