//! Moments of lattices: against closed forms, against the equations of the reference, and children against
//! their parent.

use attractor::Error;
use attractor::num::{Near, Real};
use attractor::patch::{CellMoments, CellSlopes, HeightMoments, Mask, Sheet, SlopeMoments};
use attractor_reference::lattice::{self, CellMeans, dot, form};

use super::seeded::{Words, cubic, seeded_mask};

/// 24 fractional bits.
const UNITS: f64 = (1 << 24) as f64;

/// The same in all eight directions, in 64ths of a 64th: entries `(0, 2)`, `(2, 2)` and `(1, 2)`.
fn symmetric([edge, corner, side]: [i32; 3]) -> [[Near; 5]; 5] {
    let entry = |i: usize, j: usize| {
        let (a, b) = (i.abs_diff(2).min(j.abs_diff(2)), i.abs_diff(2).max(j.abs_diff(2)));
        let of = match (a, b) {
            (0, 0) => 4096 - 4 * edge - 4 * corner,
            (0, 1) => 2048 - 2 * side,
            (1, 1) => 1024,
            (0, _) => edge,
            (1, _) => side,
            _ => corner,
        };
        Near::from_bits(of << 16)
    };
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// The cubic mask with seeded changes that leave planes planes: second differences in each class.
fn seeded_planar(words: &mut Words) -> Option<Mask> {
    let mut entries = cubic();
    let patterns: [&[(usize, i32)]; 2] = [&[(0, 1), (2, -2), (4, 1)], &[(1, 1), (3, -1)]];
    for (p, rows) in patterns.iter().enumerate() {
        for (q, columns) in patterns.iter().enumerate() {
            for whole in 0..3 {
                // along both axes, or along one where it has a second difference by itself
                let (rows, columns): (&[_], &[_]) = match whole {
                    1 if p == 0 => (rows, &[(2, 1), (1, 0)]),
                    2 if q == 0 => (&[(2, 1), (1, 0)], columns),
                    _ => (rows, columns),
                };
                let size = words.between(-0.04, 0.04).to_bits() & !3;
                for ((i, a), (j, b)) in rows.iter().flat_map(|r| columns.iter().map(move |c| (*r, *c))) {
                    entries[i][j] += Near::from_bits(size / 4 * a * b);
                }
            }
        }
    }
    Mask::new(entries).ok()
}

fn numbers(mask: &Mask) -> [[f64; 5]; 5] {
    mask.entries().map(|row| row.map(Near::to_num))
}

fn heights(words: &mut Words, size: i32) -> [Real; 16] {
    std::array::from_fn(|_| Real::from_num(words.between(-1.0, 1.0)) * Real::from_num(size))
}

fn all(cell: &CellMoments, slopes: &CellSlopes) -> [f64; 11] {
    let CellMoments { height, slope: [s, t], variance, covariance: [hs, ht] } = *cell;
    let CellSlopes { mean: [p, q], covariance: [pp, pq, qq] } = *slopes;
    [height, s, t, variance, hs, ht, p, q, pp, pq, qq].map(Real::to_num)
}

/// What the reference has for heights and `parts`.
fn exactly(means: &CellMeans, p: &[f64], parts: f64) -> [f64; 11] {
    let (h, [s, t]) = (dot(&means.height, p), means.slope.each_ref().map(|slope| dot(slope, p)));
    let variance = form(&means.squares, p) - h * h;
    let ([hs, ht], [ss, st, tt]) = match &means.with_slopes {
        Some((mixed, both)) => (mixed.each_ref().map(|m| form(m, p)), both.each_ref().map(|m| form(m, p))),
        None => ([f64::NAN; 2], [f64::NAN; 3]),
    };
    let square = parts * parts;
    let [s, t, hs, ht] = [s, t, hs, ht].map(|v| v * parts);
    let [ss, st, tt] = [ss, st, tt].map(|v| v * square);
    [h, s, t, variance, hs - h * s, ht - h * t, s, t, ss - s * s, st - s * t, tt - t * t]
}

/// Integrals of products of the pieces of the uniform cubic B-spline and their slopes, 15120ths: those of two
/// values, of a value and a slope, of two slopes.
fn pieces() -> [[[i128; 4]; 4]; 3] {
    // sixths, from the constant on
    let value = [[1, -3, 3, -1], [4, 0, -6, 3], [1, 3, 3, -3], [0, 0, 0, 1_i128]];
    let slope = value.map(|[_, b, c, d]| [b, 2 * c, 3 * d, 0]);
    let integral = |a: &[i128; 4], b: &[i128; 4]| {
        let term = |i: usize, j: usize| a[i] * b[j] * 420 / (i + j + 1) as i128;
        (0..4).flat_map(|i| (0..4).map(move |j| (i, j))).map(|(i, j)| term(i, j)).sum::<i128>()
    };
    let table = |a: &[[i128; 4]; 4], b: &[[i128; 4]; 4]| {
        std::array::from_fn(|i| std::array::from_fn(|j| integral(&a[i], &b[j])))
    };
    [table(&value, &value), table(&value, &slope), table(&slope, &slope)]
}

/// Against integers: means of products of pieces along both axes.
#[test]
fn moments_of_the_b_spline_are_its_closed_ones() {
    let [both, mixed, slopes] = pieces();
    let mask = Mask::new(cubic()).unwrap();
    let (of_heights, of_slopes) = (HeightMoments::new(&mask).unwrap(), SlopeMoments::new(&mask).unwrap());
    let (mut words, mut worst) = (Words(41), [0.0_f64; 11]);
    let means = [1, 11, 11, 1_i128];
    // at the end less at the beginning: 0 1 4 1 less 1 4 1 0, sixths
    let ends = [-4, -12, 12, 4_i128];
    for round in 0..400 {
        let size = [1, 6][round % 2];
        let p = heights(&mut words, size);
        let h: [i128; 16] = p.map(|h| h.to_bits().into());
        let line = |a: &[i128; 4], b: &[i128; 4]| (0..16).map(|k| a[k / 4] * b[k % 4] * h[k]).sum::<i128>();
        let form = |a: &[[i128; 4]; 4], b: &[[i128; 4]; 4]| {
            let row =
                |k: usize| (0..16).map(|l| a[k / 4][l / 4] * b[k % 4][l % 4] * h[l]).sum::<i128>() * h[k];
            (0..16).map(row).sum::<i128>()
        };
        let transposed = |m: &[[i128; 4]; 4]| std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]));
        // 576ths of 2^24, 15120^2 ths of 2^48
        let (mean, s, t) = (line(&means, &means), line(&ends, &means), line(&means, &ends));
        let square = |v: i128, a: i128, b: i128| {
            // over 15120^2: 576 * 576 divides it 689.0625 times, hence 16 ths
            let exact = 16 * v - 11025 * a * b;
            exact as f64 / (16.0 * 15120.0 * 15120.0) / UNITS
        };
        let exact = [
            mean as f64 / 576.0,
            s as f64 / 576.0,
            t as f64 / 576.0,
            square(form(&both, &both), mean, mean),
            square(form(&mixed, &both), mean, s),
            square(form(&both, &mixed), mean, t),
            s as f64 / 576.0,
            t as f64 / 576.0,
            square(form(&slopes, &both), s, s),
            square(form(&mixed, &transposed(&mixed)), s, t),
            square(form(&both, &slopes), t, t),
        ];
        let got = all(&of_heights.over(&p, 1), &of_slopes.over(&p, 1)).map(|v| v * UNITS);
        for (k, (got, exact)) in got.iter().zip(exact).enumerate() {
            // beyond the format a number is saturated
            if exact.abs() < 127.0 * UNITS {
                worst[k] = worst[k].max((got - exact).abs() / f64::from(size * size));
            }
        }
    }
    let [.., pp, pq, qq] = worst;
    assert!(worst.iter().all(|off| *off < 6.0 && *off > 0.3), "{worst:?}");
    assert!(worst.iter().filter(|off| **off < 1.5).count() == 8 && pp.min(pq).min(qq) > 2.0, "{worst:?}");
}

/// Of masks that leave planes planes, the same in all directions and seeded.
#[test]
fn moments_of_lattices_are_those_of_the_reference() {
    let mut words = Words(43);
    let (mut tried, mut worst) = (0, [0.0_f64; 11]);
    let given = [[0, 0, 0], [-123, 0, -204], [-327, 82, -123], [123, 82, -327]];
    while tried < 7 {
        let mask = match given.get(tried) {
            Some(entries) => Mask::new(symmetric(*entries)).ok(),
            None => seeded_planar(&mut words),
        };
        let Some(mask) = mask else { continue };
        let Ok(of_slopes) = SlopeMoments::new(&mask) else { continue };
        let of_heights = HeightMoments::new(&mask).unwrap();
        let means = lattice::means(&numbers(&mask), true);
        for parts in [1, 1, 1, 3, 64] {
            let p = heights(&mut words, 1).map(|h| h / Real::from_num(parts));
            let want = exactly(&means, &p.map(Real::to_num), parts.into());
            let got = all(&of_heights.over(&p, parts as u32), &of_slopes.over(&p, parts as u32));
            for (k, (got, want)) in got.iter().zip(want).enumerate() {
                assert!(want.abs() < 100.0, "{want}");
                let scale = if [0, 3].contains(&k) { 1.0 } else { f64::from(parts) };
                worst[k] = worst[k].max((got - want).abs() * UNITS / scale);
            }
        }
        tried += 1;
    }
    assert!(worst.iter().all(|off| *off < 4.0 && *off > 0.2), "{worst:?}");
}

/// The same of a mask that bends planes, as one fitted to data does: heights have moments, slopes have none.
#[test]
fn moments_of_a_fitted_mask_are_those_of_its_heights() {
    let mut words = Words(47);
    let (mut tried, mut worst) = (0, 0.0_f64);
    while tried < 40 {
        let Some(mask) = seeded_mask(&mut words) else { continue };
        let refused = Error::NoMoments { why: "it bends planes, and slopes grow from level to level" };
        assert_eq!(SlopeMoments::new(&mask).unwrap_err(), refused);
        let of_heights = HeightMoments::new(&mask).unwrap();
        if tried < 3 {
            let means = lattice::means(&numbers(&mask), false);
            let p = heights(&mut words, 1);
            let want = exactly(&means, &p.map(Real::to_num), 1.0);
            let none = CellSlopes::default();
            let got = all(&of_heights.over(&p, 1), &none);
            assert_eq!(of_heights.mean(&p).to_num::<f64>(), got[0]);
            for k in 0..4 {
                worst = worst.max((got[k] - want[k]).abs() * UNITS);
            }
        }
        tried += 1;
    }
    assert!(worst < 4.0 && worst > 0.2, "{worst}");
}

/// Means, and means of squares and products, of four parts against those of the whole.
fn pooled(parts: &[[f64; 11]; 4]) -> [f64; 11] {
    let mean = |k: usize| parts.iter().map(|part| part[k]).sum::<f64>() / 4.0;
    let product = |k: usize, a: usize, b: usize| {
        parts.iter().map(|part| part[k] + part[a] * part[b]).sum::<f64>() / 4.0 - mean(a) * mean(b)
    };
    let [h, s, t] = [0, 1, 2].map(mean);
    let [hh, hs, ht] = [product(3, 0, 0), product(4, 0, 1), product(5, 0, 2)];
    [h, s, t, hh, hs, ht, s, t, product(8, 1, 1), product(9, 1, 2), product(10, 2, 2)]
}

/// Every cell of a sheet down to the fifth level, by three masks: what its four parts are together.
#[test]
fn moments_of_parts_together_are_those_of_the_whole() {
    let mut words = Words(53);
    let masks = [Mask::new(cubic()).unwrap(), Mask::new(symmetric([-123, 0, -204])).unwrap()];
    let seeded = loop {
        match seeded_planar(&mut words).filter(|mask| SlopeMoments::new(mask).is_ok()) {
            Some(mask) => break mask,
            None => continue,
        }
    };
    let (mut tried, mut worst) = (0, [0.0_f64; 11]);
    for mask in masks.iter().chain([&seeded]) {
        let (of_heights, of_slopes) = (HeightMoments::new(mask).unwrap(), SlopeMoments::new(mask).unwrap());
        let control: Vec<Real> = (0..36).map(|_| Real::from_num(words.between(-1.0, 1.0))).collect();
        let sheet = Sheet::new(mask, &control, 3).unwrap();
        let over = |index: [u32; 2], level: u32| {
            let (p, parts) = (sheet.part(index, level), 3 << level);
            all(&of_heights.over(&p, parts), &of_slopes.over(&p, parts))
        };
        for level in 0..4 {
            let parts = 3 << level;
            for [i, j] in (0..parts * parts).map(|k| [k / parts, k % parts]) {
                let whole = over([i, j], level);
                let below =
                    [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[a, b]| over([2 * i + a, 2 * j + b], level + 1));
                for (k, (a, b)) in whole.iter().zip(pooled(&below)).enumerate() {
                    // what heights are rounded by is `parts` times as much in slopes, and these count as they
                    // are
                    let scale = if [0, 3].contains(&k) { 1.0 } else { f64::from(parts) };
                    let size = if k < 8 { 1.0 } else { 1.0 + whole[1].abs() + whole[2].abs() };
                    worst[k] = worst[k].max((a - b).abs() * UNITS / scale / size);
                    assert!(a.abs() < 127.0, "{k}: {a}");
                }
                tried += 1;
            }
        }
    }
    assert!(tried == 3 * 9 * (1 + 4 + 16 + 64), "{tried}");
    assert!(worst.iter().all(|off| *off < 12.0 && *off > 0.3), "{worst:?}");
}

/// The mean square of the slopes from corner to corner grows from level to level where slopes are refused,
/// and settles where they are not.
#[test]
fn slopes_are_refused_where_their_squares_have_no_mean() {
    let growth = |mask: &Mask| {
        let p: [f64; 16] = std::array::from_fn(|k| ((k * 5 + k / 4) % 7) as f64);
        let energy = |levels: u32| {
            let grid = lattice::grid(&p, &numbers(mask), levels);
            let n = grid.len() - 1;
            let rise = |i: usize, j: usize| grid[i + 1][j] - grid[i][j];
            (0..n * (n + 1)).map(|k| rise(k / (n + 1), k % (n + 1)).powi(2)).sum::<f64>()
        };
        let [a, b, c] = [4, 5, 6].map(energy);
        (c - b) / (b - a)
    };
    let mut words = Words(59);
    let rough = Error::NoMoments { why: "64 levels do not halve what slopes vary by" };
    // what a level adds, against what the level before has added: 0.93, 0.90
    for entries in [[-123, 0, -204], [-327, 82, -123]] {
        let mask = Mask::new(symmetric(entries)).unwrap();
        assert!(SlopeMoments::new(&mask).is_ok(), "{entries:?}");
        assert!((0.8..0.95).contains(&growth(&mask)), "{}", growth(&mask));
    }
    for entries in [[0, -123, -328], [-205, -205, -205]] {
        let mask = Mask::new(symmetric(entries)).unwrap();
        assert_eq!(SlopeMoments::new(&mask).unwrap_err(), rough, "{entries:?}");
        assert!(HeightMoments::new(&mask).is_ok());
        println!("{}", growth(&mask));
        assert!(growth(&mask) > 1.02, "{}", growth(&mask));
    }
    let bent = loop {
        match seeded_mask(&mut words) {
            Some(mask) => break mask,
            None => continue,
        }
    };
    assert!(growth(&bent) > 1.02, "{}", growth(&bent));
    let text = SlopeMoments::new(&bent).unwrap_err().to_string();
    assert_eq!(text, "this mask has no moments: it bends planes, and slopes grow from level to level");
}
