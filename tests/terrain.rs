//! Surfaces by subdivision against their reference: heights, shared edges, statistics, patches, rays.

use std::collections::HashMap;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

use attractor::Error;
use attractor::num::{Coordinate, RandomField, Real, Unit, Vec3};
use attractor::terrain::{
    EdgeLevel, Heights, InnerGeometry, Law, Magnification, PlaneToLine, Randomness, Rows, Seam, Seamed, Side,
    Triangles, Vertex,
};
use attractor::trace::{Crossing, DeepTerrain, HeightRange, Ray, Surface, Terrain};
use attractor_reference::terrain::{self as reference, Inner};

const ULP: f64 = 1.0 / 16_777_216.0;

/// A generator of one's own for places: uniform in 0 .. 1.
struct Uniform(u64);

impl Uniform {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 2.0_f64.powi(53)
    }

    fn below(&mut self, end: u32) -> u32 {
        (self.next() * f64::from(end)) as u32
    }
}

fn real(x: f64) -> Real {
    Real::from_num(x)
}

fn law(offset: f64, similarity: f64) -> Law {
    Law::new(Unit::from_num(offset), Unit::from_num(similarity)).unwrap()
}

/// Knots between ±1.
fn knots(count: u32, seed: u64) -> Vec<Real> {
    let mut uniform = Uniform(seed);
    (0..count).map(|_| real(2.0 * uniform.next() - 1.0)).collect()
}

fn grid(heights: &Heights<'_>) -> reference::Grid {
    let row = |j| (0..heights.columns()).map(|i| heights.at(i, j).to_num()).collect();
    (0..heights.rows()).map(row).collect()
}

/// All heights of a level.
fn lattice(terrain: &PlaneToLine<'_, impl Randomness>, level: u32) -> (u32, u32, Vec<Real>) {
    let cells = terrain.heights().columns() - 1;
    let mut memory = vec![Real::ZERO; Rows::<RandomField>::words(cells, level)];
    let rows = Rows::new(terrain, level, &mut memory).unwrap();
    let (width, count) = (rows.width(), rows.count());
    let mut heights = vec![Real::ZERO; width * count];
    rows.write(&mut heights).unwrap();
    (width as u32, count as u32, heights)
}

/// At random points of every level, for seeds and places at the ends of their ranges, against the recursion of
/// the text.
#[test]
fn heights_are_within_2_units_a_level() {
    let mut uniform = Uniform(1);
    let mut worst = [0.0_f64; 17];
    let mut tried = 0;
    for (seed, origin) in
        [(0, [0, 0]), (1 << 31, [-32768, 32764]), (u64::MAX, [32764, -32768]), (7, [-2, -1])]
    {
        for (offset, similarity) in [(0.3, 0.8), (1.5, 1.0), (0.4, 0.5), (0.0, 0.7), (0.05, 0.0)] {
            let given = knots(12, seed ^ 5);
            let heights = Heights::new(4, 3, &given).unwrap().with_origin(origin[0], origin[1]).unwrap();
            let random = RandomField::new(seed);
            let terrain = PlaneToLine::new(heights, law(offset, similarity), random).unwrap();
            let [u_0, v_0] = origin.map(f64::from);
            let r = |u: f64, v: f64| {
                let [u, v] = [u + u_0, v + v_0].map(Coordinate::from_num);
                random.at(u, v).map(|r| r.to_num())
            };
            for level in 0..=16 {
                for _ in 0..40 {
                    let (i, j) = (uniform.below((3 << level) + 1), uniform.below((2 << level) + 1));
                    let [u, v] = terrain.point(level, i, j);
                    let at = [u.to_num::<f64>() - u_0, v.to_num::<f64>() - v_0];
                    let exact = reference::plane_to_line(
                        &grid(&heights),
                        Unit::from_num(offset).to_num(),
                        Unit::from_num(similarity).to_num(),
                        &r,
                        at,
                    );
                    let error = (terrain.height(u, v).to_num::<f64>() - exact).abs() / ULP;
                    worst[level as usize] = worst[level as usize].max(error);
                    tried += 1;
                }
            }
        }
    }
    println!("{worst:.2?} units of 2^-24 at levels 0 to 16");
    assert_eq!((tried, worst[0]), (4 * 5 * 17 * 40, 0.0));
    for (level, worst) in worst.iter().enumerate().skip(1) {
        assert!(*worst > 0.2 && *worst < 2.0 * level as f64, "{level}: {worst}");
    }
}

/// `R` by its definition; the table is within its own error.
#[test]
fn a_random_field_is_the_table_looked_up_by_the_mixed_point() {
    let mut uniform = Uniform(2);
    let (mut worst, mut negative) = (0.0_f64, 0);
    for seed in [0, 1, 1 << 31, u64::MAX] {
        for _ in 0..2000 {
            let [u, v] = [(); 2].map(|()| ((uniform.next() - 0.5) * 2.0_f64.powi(32)) as i32);
            for (u, v) in [(u, v), (u << 16, v << 16), (i32::MIN, v), (u, i32::MAX)] {
                let [got, exact] = [
                    RandomField::new(seed).at(Coordinate::from_bits(u), Coordinate::from_bits(v)),
                    reference::deviates(seed, u, v).map(attractor::num::Deviate::from_num),
                ];
                for (got, exact) in got.into_iter().zip(exact) {
                    worst = worst.max((got.to_num::<f64>() - exact.to_num::<f64>()).abs());
                    negative += u32::from(got < 0);
                }
            }
        }
    }
    println!("{worst:e}, {negative}");
    assert!(worst < 1e-6 && worst > 1e-8 && (31_500..32_500).contains(&negative), "{worst:e} {negative}");
}

/// Rows, whole and in pieces of any base, are the heights on demand, whatever order they are asked in.
#[test]
fn rows_and_pieces_are_the_heights_of_the_whole() {
    let given = knots(12, 3);
    let heights = Heights::new(4, 3, &given).unwrap().with_origin(-3, 2).unwrap();
    let terrain = PlaneToLine::new(heights, law(0.4, 0.6), RandomField::new(9)).unwrap();
    let mut compared = 0;
    for level in 0..7 {
        let (width, count, all) = lattice(&terrain, level);
        assert_eq!((width, count), ((3 << level) + 1, (2 << level) + 1));
        // backwards
        for index in (0..width * count).rev() {
            let [u, v] = terrain.point(level, index % width, index / width);
            assert_eq!(all[index as usize], terrain.height(u, v), "{level} {index}");
            compared += 1;
        }
        for base in 0..=level {
            let (columns, rows) = (1..3 << base, (1 << base)..2 << base);
            let cells = columns.end - columns.start;
            let mut memory = vec![Real::ZERO; Rows::<RandomField>::words(cells, level - base)];
            let mut piece =
                Rows::of(&terrain, base, [columns.clone(), rows.clone()], level, &mut memory).unwrap();
            let (mut row, down) = (rows.start << (level - base), piece.count());
            for _ in 0..down {
                let from = row * width + (columns.start << (level - base));
                let whole = &all[from as usize..][..piece.width()];
                assert_eq!(piece.next_row(), Some(whole), "{level} {base} {row}");
                row += 1;
            }
            assert_eq!(piece.next_row(), None);
            compared += 1;
        }
    }
    assert!(compared > 15_000, "{compared}");
}

/// Two surfaces that share a column of knots share all heights between them; so do the edges of a seam, in
/// any direction, and no others.
#[test]
fn shared_edges_and_seams_are_equal_bit_for_bit() {
    let (left, right) = (knots(6, 4), knots(6, 5));
    let joined: Vec<Real> =
        right.chunks(3).zip(left.chunks(3)).flat_map(|(r, l)| [l[2], r[1], r[2]]).collect();
    let [west, east] = [(&left, 0), (&joined, 2)].map(|(knots, u)| {
        let heights = Heights::new(3, 2, knots).unwrap().with_origin(u, 0).unwrap();
        PlaneToLine::new(heights, law(0.5, 0.7), RandomField::new(1)).unwrap()
    });
    let two = Coordinate::from_num(2);
    let mut different = 0;
    for k in 0..=1 << 10 {
        let v = Coordinate::from_bits(k << 6);
        assert_eq!(west.height(two, v), east.height(two, v));
        different += u32::from(west.height(Coordinate::ONE, v) != east.height(Coordinate::from_num(3), v));
    }
    assert!(different > 1000);
    // a strip of two cells closed to a ring with a twist: its ends run against each other
    let seams = [Seam::new(3, [0, 0], [0, 1]).unwrap(), Seam::new(3, [2, 1], [2, 0]).unwrap()];
    let heights = [0.1, 0.5, -0.3, -0.3, 0.2, 0.1].map(real);
    let strip = Heights::new(3, 2, &heights).unwrap();
    let ring = PlaneToLine::new(strip, law(0.5, 0.7), Seamed::new(RandomField::new(1), &seams)).unwrap();
    let open = PlaneToLine::new(strip, law(0.5, 0.7), RandomField::new(1)).unwrap();
    let (mut closed, mut inside) = (0, 0);
    for k in 0..=1 << 10 {
        let [v, back] = [k << 6, (1 << 16) - (k << 6)].map(Coordinate::from_bits);
        assert_eq!(ring.height(Coordinate::ZERO, v), ring.height(two, back));
        closed += u32::from(open.height(Coordinate::ZERO, v) != open.height(two, back));
        // what no seam reaches is as before: the knots' line between the cells
        inside += u32::from(ring.height(Coordinate::ONE, v) == open.height(Coordinate::ONE, v));
    }
    assert!(closed > 1000 && inside == (1 << 10) + 1, "{closed} {inside}");
}

/// At every point, edges included: none is raised by a number that has no business there.
#[test]
fn the_mean_of_1000_seeds_is_that_of_the_knots_at_every_point() {
    let zero = [Real::ZERO; 9];
    let heights = Heights::new(3, 3, &zero).unwrap();
    let level = 4;
    let side = (2 << level) + 1;
    let mut sums = vec![[0.0_f64; 2]; side * side];
    for seed in 0..1000 {
        let terrain = PlaneToLine::new(heights, law(0.3, 0.8), RandomField::new(seed)).unwrap();
        for ([sum, square], height) in sums.iter_mut().zip(lattice(&terrain, level).2) {
            let height = height.to_num::<f64>();
            *sum += height;
            *square += height * height;
        }
    }
    let mut worst = 0.0_f64;
    for [sum, square] in sums.iter().filter(|[_, square]| *square > 0.0) {
        let (mean, variance) = (sum / 1000.0, square / 1000.0);
        worst = worst.max(mean.abs() / (variance / 1000.0).sqrt());
    }
    let knots = sums.iter().filter(|[_, square]| *square == 0.0).count();
    println!("{worst:.2} standard errors at most");
    assert!(knots == 9 && worst > 2.0 && worst < 4.0, "{knots} {worst}");
}

/// The numbers of 256 x 256 points of one lattice.
fn numbers(seed: u64, shift: u32) -> Vec<[f64; 2]> {
    let random = RandomField::new(seed);
    let at = |k: i32| Coordinate::from_bits((2 * (k - 128) + 1) << shift);
    let all = (0..1 << 16).map(|k| random.at(at(k % 256), at(k / 256)).map(|r| r.to_num()));
    all.collect()
}

/// Neither with a copy shifted by up to 8, nor with the mirror image about `u = v`, nor with the other number.
#[test]
fn random_fields_do_not_correlate_with_their_copies() {
    let mut worst = 0.0_f64;
    for (seed, shift) in [(0, 0), (1 << 31, 15), (u64::MAX, 12), (5, 8)] {
        let all = numbers(seed, shift);
        let mut compare = |other: &dyn Fn(i32, i32) -> Option<(i32, i32)>, same: bool| {
            let mut sums = [[0.0; 2]; 2];
            let mut count = 0;
            for (k, here) in (0..).zip(&all) {
                let Some((i, j)) = other(k % 256, k / 256) else { continue };
                if !(0..256).contains(&i) || !(0..256).contains(&j) {
                    continue;
                }
                let there = all[(j * 256 + i) as usize];
                for (a, sums) in sums.iter_mut().enumerate() {
                    for (b, sum) in sums.iter_mut().enumerate() {
                        *sum += here[a] * there[b];
                    }
                }
                count += 1;
            }
            let means = sums.map(|row| row.map(|sum| (sum / f64::from(count)).abs()));
            // a field is its own copy
            let own = if same { [0.0; 2] } else { [means[0][0], means[1][1]] };
            worst = [means[0][1], means[1][0], own[0], own[1]].into_iter().fold(worst, f64::max);
        };
        for (di, dj) in (0..9).flat_map(|di| (-8..9).map(move |dj| (di, dj))) {
            compare(&|i, j| Some((i + di, j + dj)), di == 0 && dj == 0);
        }
        compare(&|i, j| (i < j).then_some((j, i)), false);
        compare(&|i, j| Some((255 - i, j)), false);
    }
    println!("{worst:.4}");
    assert!(worst > 0.008 && worst < 0.02, "{worst}");
}

/// The periodogram of white noise has a peak of some 11 times its mean; the text's own index one of 1,312.
#[test]
fn the_spectrum_of_a_random_field_has_no_peak() {
    let mut worst = 0.0_f64;
    for (seed, shift) in [(0, 0), (u64::MAX, 15), (5, 12)] {
        let mut field: Vec<[f64; 2]> = numbers(seed, shift).iter().map(|r| [r[0], 0.0]).collect();
        for row in field.chunks_mut(256) {
            transform(row);
        }
        for column in 0..256 {
            let mut along: Vec<[f64; 2]> = (0..256).map(|row| field[row * 256 + column]).collect();
            transform(&mut along);
            for (row, value) in along.into_iter().enumerate() {
                field[row * 256 + column] = value;
            }
        }
        let power: Vec<f64> = field.iter().map(|[re, im]| re * re + im * im).collect();
        let mean = power.iter().sum::<f64>() / 65_536.0;
        worst = power.iter().fold(worst, |worst, p| worst.max(p / mean));
    }
    println!("{worst:.1} times the mean");
    assert!(worst > 8.0 && worst < 20.0, "{worst}");
}

/// Fourier's transform of 2^n numbers, in place.
fn transform(values: &mut [[f64; 2]]) {
    let n = values.len();
    if n == 1 {
        return;
    }
    let [mut even, mut odd] = [0, 1].map(|k| values.iter().skip(k).step_by(2).copied().collect::<Vec<_>>());
    transform(&mut even);
    transform(&mut odd);
    for (k, (even, odd)) in even.iter().zip(&odd).enumerate() {
        let (sine, cosine) = (-TAU * k as f64 / n as f64).sin_cos();
        let [re, im] = [odd[0] * cosine - odd[1] * sine, odd[0] * sine + odd[1] * cosine];
        values[k] = [even[0] + re, even[1] + im];
        values[k + n / 2] = [even[0] - re, even[1] - im];
    }
}

/// The rule's own creases: the mean square of the second difference across lines that were born at a step of
/// 64, over that across lines born at the last step.
fn crease(similarity: f64) -> f64 {
    let zero = [Real::ZERO; 4];
    let (mut old, mut new) = ((0.0, 0), (0.0, 0));
    for seed in 0..12 {
        let heights = Heights::new(2, 2, &zero).unwrap();
        let terrain = PlaneToLine::new(heights, law(0.3, similarity), RandomField::new(seed)).unwrap();
        let (width, count, all) = lattice(&terrain, 9);
        for row in 0..count {
            for column in 1..width - 1 {
                let sum = match column.trailing_zeros() {
                    0 => &mut new,
                    6 => &mut old,
                    _ => continue,
                };
                let at = |k: u32| all[(row * width + k) as usize].to_num::<f64>();
                let second = at(column - 1) - 2.0 * at(column) + at(column + 1);
                *sum = (sum.0 + second * second, sum.1 + 1);
            }
        }
    }
    (old.0 / f64::from(old.1)) / (new.0 / f64::from(new.1))
}

/// Published: creases are the text's rule, and a smaller exponent has less of them.
#[test]
fn the_creases_of_the_rule_are_as_published() {
    let [text, rough] = [crease(1.0), crease(0.7)];
    println!("crease ratio {text:.2} for H = 1, {rough:.2} for H = 0.7");
    assert!((text - 3.58).abs() < 0.4 && (rough - 1.59).abs() < 0.15, "{text} {rough}");
}

/// Levels that are all over the place, but the edge's own.
struct Motley;

impl EdgeLevel for Motley {
    fn level(&self, [u_0, v_0]: [Coordinate; 2], [u_1, v_1]: [Coordinate; 2]) -> u32 {
        let middle = |a: Coordinate, b: Coordinate| (a.to_bits() / 2 + b.to_bits() / 2) as u32;
        (middle(u_0, u_1).wrapping_mul(0x9e37_79b1) ^ middle(v_0, v_1).wrapping_mul(0x85eb_ca6b)) >> 24 & 3
    }
}

/// Each edge of a triangle is one of another, the other way round, bit for bit; those that are not make the
/// rim of the whole. And no triangle is turned over: seen from above they cover the square once.
#[test]
fn triangles_of_any_levels_leave_no_crack() {
    let given = knots(25, 6);
    let heights = Heights::new(5, 5, &given).unwrap().with_origin(-2, -2).unwrap();
    let terrain = PlaneToLine::new(heights, law(0.4, 0.7), RandomField::new(3)).unwrap();
    let one = Coordinate::ONE;
    let eye = [-one * 2, -one, one / 2];
    let near = Magnification { eye, length: Unit::from_num(0.25), most: 5 };
    let (motley, mut levels) = (Motley, [0; 6]);
    for (rule, base) in [(&motley as &dyn Rule, 1), (&near, 0), (&2_u32, 2)] {
        let mut edges: HashMap<(Vertex, Vertex), u32> = HashMap::new();
        let mut area = 0_i64;
        let side = 4 << base;
        for cell in 0..side * side {
            for [a, b, c] in rule.triangles(&terrain, base, [cell % side, cell / side]) {
                let off =
                    |p: Vertex| [p.u.to_bits() - a.u.to_bits(), p.v.to_bits() - a.v.to_bits()].map(i64::from);
                let ([x, y], [z, w]) = (off(b), off(c));
                assert!(x * w > y * z, "{a:?} {b:?} {c:?}");
                area += x * w - y * z;
                for edge in [(a, b), (b, c), (c, a)] {
                    assert_eq!(edges.insert(edge, 1), None, "twice the same way");
                }
                let longest = x.abs().max(y.abs()).max(z.abs()).max(w.abs());
                levels[(16 - base - longest.ilog2()).min(5) as usize] += 1;
            }
        }
        assert_eq!(area, 2 << 36);
        for (a, b) in edges.keys().filter(|(a, b)| !edges.contains_key(&(*b, *a))) {
            let rim = |a: Coordinate, b: Coordinate| a == b && (a == -2 || a == 2);
            assert!(rim(a.u, b.u) || rim(a.v, b.v), "{a:?} {b:?}");
        }
        for vertex in edges.keys().map(|(a, _)| a).take(300) {
            assert_eq!(vertex.height, terrain.height(vertex.u, vertex.v));
        }
    }
    println!("{levels:?} triangles by level");
    assert!(levels.iter().filter(|count| **count > 30).count() > 2, "{levels:?}");
}

/// A rule of any kind.
trait Rule {
    fn triangles(&self, terrain: &PlaneToLine<'_>, base: u32, cell: [u32; 2]) -> Vec<[Vertex; 3]>;
}

impl<E: EdgeLevel> Rule for E {
    fn triangles(&self, terrain: &PlaneToLine<'_>, base: u32, cell: [u32; 2]) -> Vec<[Vertex; 3]> {
        Triangles::new(terrain, base, cell, self).unwrap().collect()
    }
}

/// Below: the rim is the middle between its inner neighbour and the new knot, displaced as the law says of the
/// level above.
#[test]
fn an_extrapolated_rim_is_a_row_of_midpoints() {
    let given = knots(12, 8);
    let heights = Heights::new(4, 3, &given).unwrap().with_origin(-1, 5).unwrap();
    let (offset, similarity) = (0.2, 0.75);
    let random = RandomField::new(4);
    let terrain = PlaneToLine::new(heights, law(offset, similarity), random).unwrap();
    let mut worst = 0.0_f64;
    for side in [Side::West, Side::East, Side::South, Side::North] {
        let along_v = matches!(side, Side::West | Side::East);
        let count = if along_v { 3 } else { 4 };
        let mut beyond = vec![Real::ZERO; count];
        terrain.extrapolated(side, &mut beyond).unwrap();
        for (k, beyond) in (0..).zip(&beyond) {
            let ([i, j], inner) = match side {
                Side::West => ([0, k], [1, k]),
                Side::East => ([3, k], [2, k]),
                Side::South => ([k, 0], [k, 1]),
                Side::North => ([k, 2], [k, 1]),
            };
            let [u, v] = terrain.point(0, i, j);
            let r = random.at(u, v)[usize::from(!along_v)].to_num::<f64>();
            let h = |i, j| heights.at(i, j).to_num::<f64>();
            let middle = (h(inner[0], inner[1]) + beyond.to_num::<f64>()) / 2.0;
            let displaced = middle + offset * similarity.exp2() * r;
            worst = worst.max((displaced - h(i, j)).abs() / ULP);
        }
        assert_eq!(
            terrain.extrapolated(side, &mut []),
            Err(Error::LengthMismatch { what: "extrapolated heights", given: 0, expected: count })
        );
    }
    println!("{worst:.2} units");
    assert!(worst > 0.05 && worst < 2.0, "{worst}");
}

const INNER: [(InnerGeometry, Inner); 3] = [
    (InnerGeometry::Bilinear, Inner::Bilinear),
    (InnerGeometry::Ferguson, Inner::Ferguson),
    (InnerGeometry::BSpline, Inner::BSpline),
];

/// Heights and slopes by basis functions; bounds hold; neighbours share their edges bit for bit.
#[test]
fn a_patch_is_within_4_units() {
    let mut uniform = Uniform(9);
    for (columns, rows, scale) in [(2, 2, 1.0), (3, 2, 60.0), (6, 5, 3.0)] {
        let given: Vec<Real> =
            knots(columns * rows, 11).iter().map(|h| real(h.to_num::<f64>() * scale)).collect();
        let heights = Heights::new(columns, rows, &given).unwrap();
        let exactly = grid(&heights);
        for (inner, exact) in INNER {
            let (mut worst, mut worst_slope, mut shared) = (0.0_f64, 0.0_f64, 0);
            for _ in 0..2000 {
                let (i, j) = (uniform.below(columns - 1), uniform.below(rows - 1));
                let [s, t] = [(); 2].map(|()| match uniform.below(6) {
                    0 => Unit::ZERO,
                    1 => Unit::ONE,
                    _ => Unit::from_num(uniform.next()),
                });
                let patch = inner.patch(&heights, i, j);
                let (u, v) = (f64::from(i) + s.to_num::<f64>(), f64::from(j) + t.to_num::<f64>());
                let [h, along_u, along_v] = reference::spanned(&exactly, exact, u, v);
                let height = patch.height(s, t);
                worst = worst.max((height.to_num::<f64>() - h).abs() / ULP);
                // at a knot of bilinear patches the slopes are those of the other cell
                if s < Unit::ONE && t < Unit::ONE {
                    for (got, want) in patch.slopes(s, t).into_iter().zip([along_u, along_v]) {
                        worst_slope = worst_slope.max((got.to_num::<f64>() - want).abs() / ULP);
                    }
                }
                let [low, high] = patch.range();
                assert!(low <= height && height <= high, "{inner:?}");
                if i + 2 < columns {
                    let east = inner.patch(&heights, i + 1, j);
                    assert_eq!(patch.height(Unit::ONE, t), east.height(Unit::ZERO, t));
                    shared += 1;
                }
                if j + 2 < rows {
                    let north = inner.patch(&heights, i, j + 1);
                    assert_eq!(patch.height(s, Unit::ONE), north.height(s, Unit::ZERO));
                    shared += 1;
                }
            }
            println!("{columns} x {rows} {inner:?}: {worst:.2} units, slopes {worst_slope:.2}");
            assert!(worst > 0.3 && worst < 4.0 && worst_slope < 16.0, "{worst} {worst_slope}");
            assert!(columns == 2 || shared > 500);
        }
    }
}

/// All crossings of a ray.
fn crossings(surface: &impl Surface, ray: &Ray, cone: Unit) -> Vec<Crossing> {
    let mut all = Vec::new();
    surface.cross(ray, cone, &mut |crossing| {
        all.push(crossing);
        ControlFlow::Continue(())
    });
    all
}

/// A landscape of 32 x 32 cells over ±1.
fn with_landscape(work: impl Fn(Heights<'_>, &PlaneToLine<'_>)) {
    let given = knots(9, 12);
    let terrain =
        PlaneToLine::new(Heights::new(3, 3, &given).unwrap(), law(0.25, 0.8), RandomField::new(6)).unwrap();
    let (width, count, all) = lattice(&terrain, 4);
    work(Heights::new(width, count, &all).unwrap(), &terrain);
}

const OVER: [[Real; 2]; 2] = [[Real::from_bits(-1 << 24), Real::from_bits(1 << 24)]; 2];

fn vector(v: [f64; 3]) -> Vec3 {
    Vec3::new(real(v[0]), real(v[1]), real(v[2]))
}

/// Not so near the rim that they could leave the square above the ground. Rays from above that pass exactly through edges and corners of cells end below: all meet the surface, an odd
/// number of times.
fn rays_through_edges(count: u32) {
    with_landscape(|heights, terrain| {
        let mut memory = [HeightRange::default(); Terrain::ranges(33, 33)];
        let deep = DeepTerrain::new(terrain, 4, OVER).unwrap();
        for (inner, _) in INNER {
            let stored = Terrain::new(heights, inner, OVER, &mut memory).unwrap();
            let mut uniform = Uniform(13);
            let mut met = 0;
            for k in 0..count {
                // a point on an edge and a direction, both such that the ray passes it exactly
                let on = |uniform: &mut Uniform| f64::from(uniform.below(27) + 3) / 16.0 - 1.0;
                let (edge, off) = (on(&mut uniform), uniform.next() * 1.6 - 0.8);
                let off = (off * 65_536.0).round() / 65_536.0;
                let (x, y) = match k % 3 {
                    0 => (edge, off),
                    1 => (off, edge),
                    _ => (edge, on(&mut uniform)),
                };
                let lean = |uniform: &mut Uniform| f64::from(uniform.below(9)) / 64.0 - 1.0 / 16.0;
                let (dx, dy) = (lean(&mut uniform), lean(&mut uniform));
                let from = [x - 8.0 * dx, y - 8.0 * dy, 8.0];
                let ray = Ray::new(vector(from), vector([dx, dy, -1.0]));
                let all = crossings(&stored, &ray, Unit::ZERO);
                assert!(all.len() % 2 == 1 && all[0].enters, "{inner:?} {x} {y} {dx} {dy}: {all:?}");
                if inner == InnerGeometry::Bilinear {
                    let alone = crossings(&deep, &ray, Unit::ZERO);
                    assert!(alone.len() % 2 == 1 && alone[0].enters, "{x} {y} {dx} {dy}: {alone:?}");
                }
                met += all.len();
            }
            assert!(met >= count as usize, "{met}");
        }
    });
}

#[test]
fn a_surface_is_watertight_under_rays_through_its_edges() {
    rays_through_edges(4000);
}

#[test]
#[ignore = "a minute: a million rays for each inner geometry"]
fn a_surface_is_watertight_under_a_million_rays() {
    rays_through_edges(1_000_000);
}

/// Crossings lie on the reference's surface, sides alternate, and a walk along the ray in f64 finds no more:
/// no thin hill is missed. The surface by bounds alone has the crossings of the stored one.
#[test]
fn crossings_are_where_the_reference_changes_sides() {
    with_landscape(|heights, terrain| {
        let exactly = grid(&heights);
        let deep = DeepTerrain::new(terrain, 4, OVER).unwrap();
        let mut memory = [HeightRange::default(); Terrain::ranges(33, 33)];
        for (inner, exact) in INNER {
            let stored = Terrain::new(heights, inner, OVER, &mut memory).unwrap();
            let over = |[x, y, z]: [f64; 3]| {
                z - reference::spanned(&exactly, exact, 16.0 * (x + 1.0), 16.0 * (y + 1.0))[0]
            };
            let mut uniform = Uniform(14);
            let (mut worst, mut met, mut thin, mut tilted) = (0.0_f64, 0, 0, 0.0_f64);
            for _ in 0..600 {
                let mut place = |size: f64| (uniform.next() * 2.0 - 1.0) * size;
                let (eye, target) =
                    ([place(2.0), place(2.0), place(1.0)], [place(0.9), place(0.9), place(0.8)]);
                let off: Vec<f64> = (0..3).map(|k| target[k] - eye[k]).collect();
                let length = off.iter().map(|c| c * c).sum::<f64>().sqrt();
                let ray = Ray::new(vector(eye), vector([0, 1, 2].map(|k: usize| off[k] / length)));
                let all = crossings(&stored, &ray, Unit::ZERO);
                let d = [ray.direction().x, ray.direction().y, ray.direction().z].map(|c| c.to_num::<f64>());
                let o = [ray.origin().x, ray.origin().y, ray.origin().z].map(|c| c.to_num::<f64>());
                let at = |t: f64| [0, 1, 2].map(|k: usize| o[k] + t * d[k]);
                for (k, crossing) in all.iter().enumerate() {
                    let place = at(crossing.t.to_num());
                    worst = worst.max(over(place).abs());
                    assert!(k == 0 || all[k - 1].enters != crossing.enters && all[k - 1].t <= crossing.t);
                    let point = stored.point(&ray, Unit::ZERO, crossing, true);
                    let [_, along_u, along_v] =
                        reference::spanned(&exactly, exact, 16.0 * (place[0] + 1.0), 16.0 * (place[1] + 1.0));
                    let (p, q) = (16.0 * along_u, 16.0 * along_v);
                    let long = (p * p + q * q + 1.0).sqrt();
                    let n = [point.normal.x, point.normal.y, point.normal.z].map(|c| c.to_num::<f64>());
                    let tilt = [n[0] + p / long, n[1] + q / long, n[2] - 1.0 / long];
                    // near an edge of bilinear patches the next cell has another normal
                    let near = |c: f64| (16.0 * c - (16.0 * c).round()).abs() < 1e-3;
                    if !near(place[0]) && !near(place[1]) {
                        tilted = tilt.iter().fold(tilted, |worst, c| worst.max(c.abs()));
                    }
                }
                // sides in f64, as far as they are sure
                let inside = |p: [f64; 3]| p[0].abs() < 1.0 && p[1].abs() < 1.0;
                let sides: Vec<bool> = (0..2000)
                    .map(|k| at(f64::from(k) * 0.003))
                    .filter(|p| inside(*p) && over(*p).abs() > 1e-5)
                    .map(|p| over(p) > 0.0)
                    .collect();
                let changes = sides.windows(2).filter(|pair| pair[0] != pair[1]).count();
                assert!(changes.min(8) <= all.len(), "{inner:?}: {changes} {all:?}");
                thin += usize::from(all.len() > changes);
                met += all.len();
                if inner == InnerGeometry::Bilinear {
                    let alone = crossings(&deep, &ray, Unit::ZERO);
                    assert_eq!(alone.len(), all.len());
                    for (a, b) in alone.iter().zip(&all) {
                        let apart = a.t.to_num::<f64>() - b.t.to_num::<f64>();
                        assert!(a.enters == b.enters && apart.abs() < 1e-4, "{a:?} {b:?}");
                    }
                    let coarse = crossings(&deep, &ray, Unit::from_num(0.5));
                    assert!(coarse.len() <= 8);
                }
            }
            println!("{inner:?}: {met} crossings within {worst:e}, {thin} thin, normals within {tilted:e}");
            assert!(met > 600 && worst > 1e-7 && worst < 1e-5 && tilted < 1e-3, "{met} {worst:e} {tilted:e}");
        }
    });
}

/// Heights inside a cell lie within the reach of its law of those of its corners, and come near it.
#[test]
fn the_reach_of_a_law_is_an_upper_bound() {
    let given = knots(9, 21);
    let heights = Heights::new(3, 3, &given).unwrap();
    let mut nearest = 0.0_f64;
    for (seed, similarity) in [(0, 0.2), (1, 0.6), (2, 1.0), (3, 0.8)] {
        let law = law(0.2, similarity);
        let terrain = PlaneToLine::new(heights, law, RandomField::new(seed)).unwrap();
        let (width, _, all) = lattice(&terrain, 7);
        for base in 3..7 {
            let (reach, side) = (law.reach(base, 7).to_num::<f64>(), 1 << (7 - base));
            for cell in 0..4 << (2 * base) {
                let (x, y) = (side * (cell % (2 << base)), side * (cell / (2 << base)));
                let at = |i: u32, j: u32| all[((y + j) * width + x + i) as usize].to_num::<f64>();
                let corners = [at(0, 0), at(side, 0), at(0, side), at(side, side)];
                let (low, high) =
                    corners.iter().fold((9e9_f64, -9e9_f64), |(l, h), c| (l.min(*c), h.max(*c)));
                for k in 0..(side + 1) * (side + 1) {
                    let height = at(k % (side + 1), k / (side + 1));
                    let outside = (height - high).max(low - height);
                    assert!(outside <= reach, "{base} {cell}: {outside} {reach}");
                    nearest = nearest.max(outside / reach);
                }
            }
        }
    }
    println!("{nearest:.3} of the reach");
    assert!(nearest > 0.5, "{nearest}");
}

/// What constructors refuse, and what they take just before.
#[test]
fn surfaces_out_of_range_are_refused_by_name() {
    let zero = [Real::ZERO; 6];
    let refused = |result: Result<Heights<'_>, Error>| match result {
        Err(
            Error::TooFew { what, .. } | Error::LengthMismatch { what, .. } | Error::OutOfRange { what, .. },
        ) => what,
        Err(Error::Capacity { what, .. }) => what,
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(Heights::new(1, 6, &zero)), "columns of knots");
    assert_eq!(refused(Heights::new(6, 1, &zero)), "rows of knots");
    assert_eq!(refused(Heights::new(2, 2, &zero)), "heights");
    assert_eq!(refused(Heights::new(40_000, 2, &zero)), "columns of knots");
    let high = [0, 0, 64, 0].map(Real::from_num);
    assert_eq!(refused(Heights::new(2, 2, &high)), "height");
    let heights = Heights::new(3, 2, &zero).unwrap();
    assert!(heights.with_origin(32765, -32768).is_ok());
    assert_eq!(refused(heights.with_origin(32766, 0)), "first column of knots");
    assert_eq!(refused(heights.with_origin(0, 32767)), "first row of knots");
    for (offset, similarity, taken) in
        [(0.0, 0.0, true), (1.99, 1.0, true), (-0.01, 0.5, false), (0.1, 1.01, false), (0.1, -0.1, false)]
    {
        let law = Law::new(Unit::from_num(offset), Unit::from_num(similarity));
        assert_eq!(law.is_ok(), taken, "{offset} {similarity}: {law:?}");
    }
    // 16 levels of 1.9 without decay leave the range
    let surface = |offset| PlaneToLine::new(heights, law(offset, 0.0), RandomField::new(0)).map(|_| ());
    assert!(surface(0.3).is_ok());
    let what = "height with its displacements";
    assert!(matches!(surface(0.5), Err(Error::OutOfRange { what: w, .. }) if w == what));
    let terrain = PlaneToLine::new(heights, law(0.1, 0.5), RandomField::new(0)).unwrap();
    let mut memory = [Real::ZERO; 40];
    assert!(Rows::new(&terrain, 17, &mut memory).is_err());
    assert!(Rows::of(&terrain, 2, [0..9, 0..1], 2, &mut memory).is_err());
    assert_eq!(
        Rows::new(&terrain, 3, &mut memory).map(|_| ()).unwrap_err(),
        Error::BufferLength { what: "rows of a surface", given: 40, needed: 3 + 2 * (5 + 9 + 17) }
    );
    assert!(
        Triangles::new(&terrain, 1, [4, 0], &0).is_err() && Triangles::new(&terrain, 17, [0, 0], &0).is_err()
    );
    assert!(Seam::new(0, [0, 0], [1, 1]).is_err() && Seam::new(0, [2, 2], [2, 2]).is_err());
    assert!(DeepTerrain::new(&terrain, 17, OVER).is_err() && DeepTerrain::new(&terrain, 16, OVER).is_err());
    let mut ranges = [HeightRange::default(); 2];
    let stored = Terrain::new(heights, InnerGeometry::Bilinear, OVER, &mut ranges).map(|_| ());
    assert_eq!(stored.unwrap_err(), Error::BufferLength { what: "bounds of a terrain", given: 2, needed: 3 });
}
