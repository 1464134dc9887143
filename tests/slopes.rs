//! Tables of the slopes of a surface against its distribution, which the reference knows from both sides.

use attractor::fif::{Fif, Knot, Sum, Sums};
use attractor::num::{Real, Scaling, Unit, Wide};
use attractor::trace::material::Tabulated;
use attractor_reference as reference;
use reference::slopes::{Effort, slopes};

const SIDE: usize = 32;
/// 256ths.
const REACH: u16 = 512;
const KNOTS: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
const SURFACES: [(&str, [f64; 2]); 2] = [("G x G", [0.85, -0.85]), ("F x F", [0.5, 0.5])];

fn factor(scalings: [f64; 2]) -> reference::Factor {
    reference::Factor::from_slope(reference::Fif::interpolating(&KNOTS, &scalings), 0.0)
}

/// The mean slope, along both axes.
fn centre(factor: &reference::Factor) -> f64 {
    let rise = |f: &reference::Fif| (f.at(2.0) - f.at(0.0)) / 2.0;
    rise(&factor.value) * rise(&factor.integral)
}

/// Least, most and estimate of how much of the surface leans into each square, around the mean and alike for
/// opposite slopes.
fn exact(factor: &reference::Factor, effort: &Effort) -> Vec<[f64; 3]> {
    let reach = f64::from(REACH) / 256.0;
    let all = slopes((factor, factor), [centre(factor); 2], (SIDE, reach), effort);
    let opposite = all.iter().rev();
    all.iter().zip(opposite).map(|(a, b)| [0, 1, 2].map(|k| (a[k] + b[k]) / 2.0)).collect()
}

/// The shares of core's table of 2 `n` points a side.
fn table(scalings: [f64; 2], depth: u32, n: usize) -> Vec<f64> {
    let knots = KNOTS.map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    let slope = Fif::<2, 2>::interpolating(&knots, &scalings.map(Scaling::from_num)).unwrap();
    let f = slope.integral::<2>(Wide::ZERO).unwrap();
    let mut memory = vec![Sum::ZERO; Sums::places(2, depth)];
    let sums = Sums::new(&f, depth, &mut memory).unwrap();
    let mut points = vec![[Real::ZERO; 2]; 2 * n];
    sums.points(Wide::ZERO, Wide::from_num(2), &mut points);
    let (mut counts, mut words) = (vec![0; SIDE * SIDE], vec![0; Tabulated::words(SIDE as u16)]);
    let both = (points.as_slice(), points.as_slice());
    let table = Tabulated::tabulate(both, (SIDE as u16, REACH), &mut counts, &mut words).unwrap();
    assert!(Tabulated::new(table, Unit::ONE).is_ok());
    let sum: f64 = table[3..].iter().map(|w| f64::from(*w)).sum();
    table[3..].iter().map(|w| f64::from(*w) / sum).collect()
}

/// How far a table is from the distribution.
struct Distance {
    /// `L1` from the estimate, and what it is at most.
    l1: f64,
    most: f64,
    kl: f64,
}

fn distance(table: &[f64], exact: &[[f64; 3]]) -> Distance {
    let apart = |k: usize| table.iter().zip(exact).map(|(t, e)| (e[k] - t).abs()).sum::<f64>();
    let unknown = 1.0 - exact.iter().map(|e| e[0]).sum::<f64>();
    let kl = |(t, e): (&f64, &[f64; 3])| if e[2] > 0.0 { e[2] * (e[2] / t.max(1e-9)).ln() } else { 0.0 };
    Distance { l1: apart(2), most: apart(0) + unknown, kl: table.iter().zip(exact).map(kl).sum() }
}

#[test]
fn tables_of_surfaces_are_near_their_exact_distributions() {
    let effort = Effort { depth: 8, steps: [0.04, 0.016], step: 0.004 };
    for ((name, scalings), (l1, least)) in SURFACES.into_iter().zip([(0.0145, 0.81), (0.0075, 0.8)]) {
        let exact = exact(&factor(scalings), &effort);
        let sum = |k: usize| exact.iter().map(|e| e[k]).sum::<f64>();
        assert!((sum(2) - 1.0).abs() < 1e-9 && sum(0) > least && sum(1) < 1.5, "{} {}", sum(0), sum(1));
        assert!(exact.iter().all(|e| e[0] <= e[2] + 1e-12 && e[2] <= e[1] + 1e-12));
        let near = distance(&table(scalings, 11, 2048), &exact);
        println!("{name}: L1 {:.4}, KL {:.5}", near.l1, near.kl);
        assert!(near.l1 < l1 && near.l1 > 1e-3 && near.kl < 8e-4 && near.most < 0.4, "{name} {}", near.l1);
        // of few points it is not
        assert!(distance(&table(scalings, 11, 16), &exact).l1 > 0.03);
    }
}

/// Places of the surface counted one by one lie between the bounds.
#[test]
fn counted_slopes_lie_within_the_bounds_of_their_distribution() {
    let effort = Effort { depth: 8, steps: [0.04, 0.016], step: 0.004 };
    for (name, scalings) in SURFACES {
        let factor = factor(scalings);
        let (n, middle) = (2003, centre(&factor));
        let at = |i: usize| 2.0 * (i as f64 + 0.5) / n as f64;
        let points: Vec<_> = (0..n).map(|i| (factor.slope.at(at(i)), factor.value.at(at(i)))).collect();
        let per = SIDE as f64 / (2.0 * f64::from(REACH) / 256.0);
        let square = |s: f64| (((s - middle) * per + SIDE as f64 / 2.0) as usize).min(SIDE - 1);
        let mut counts = vec![0_u32; SIDE * SIDE];
        for (f, big_f) in &points {
            for (g, big_g) in &points {
                counts[square(big_f * g) * SIDE + square(f * big_g)] += 1;
            }
        }
        let reach = f64::from(REACH) / 256.0;
        let bounds = slopes((&factor, &factor), [middle; 2], (SIDE, reach), &effort);
        let all = (n * n) as f64;
        let outside = |(count, b): (&u32, &[f64; 3])| {
            let share = f64::from(*count) / all;
            (b[0] - share).max(share - b[1]).max(0.0)
        };
        let outside: f64 = counts.iter().zip(&bounds).map(outside).sum();
        let off: f64 = counts.iter().zip(&bounds).map(|(c, b)| (f64::from(*c) / all - b[2]).abs()).sum();
        assert!(outside < 2e-3 && off < 0.15 && off > 1e-3, "{name} {outside} {off}");
    }
}

/// The distances with bounds that prove them: minutes. What it printed last: docs/FILTERED.md.
#[test]
#[ignore = "minutes: cargo test -p attractor-tests --test suite -- --ignored --nocapture proven"]
fn the_distances_of_tables_are_proven() {
    let effort = Effort { depth: 13, steps: [0.01, 0.004], step: 0.00025 };
    for (name, scalings) in SURFACES {
        let exact = exact(&factor(scalings), &effort);
        let near = distance(&table(scalings, 11, 2048), &exact);
        println!("{name}: L1 {:.4}, at most {:.4}, KL {:.5}", near.l1, near.most, near.kl);
        assert!(near.most < 0.03, "{name} {}", near.most);
    }
}
