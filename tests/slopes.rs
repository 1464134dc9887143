//! Tables of the slopes of a surface against the exact distribution: slopes at very many pairs of places,
//! from the reference.

use attractor::fif::{Fif, Knot, Sum, Sums};
use attractor::num::{Real, Scaling, Unit, Wide};
use attractor::trace::material::Tabulated;
use attractor_reference as reference;

const SIDE: usize = 32;
/// 256ths.
const REACH: u16 = 512;
const KNOTS: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];

/// How much of the surface leans into each square, around the mean and alike for opposite slopes.
fn exact(scalings: [f64; 2], n: usize) -> Vec<f64> {
    let factor = reference::Factor::from_slope(reference::Fif::interpolating(&KNOTS, &scalings), 0.0);
    let at = |i: usize| 2.0 * (i as f64 + 0.5) / n as f64;
    let points: Vec<(f64, f64)> = (0..n).map(|i| (factor.slope.at(at(i)), factor.value.at(at(i)))).collect();
    let mean = |g: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(g).sum::<f64>() / n as f64;
    let centre = mean(&|p| p.0) * mean(&|p| p.1);
    let per = SIDE as f64 / (2.0 * f64::from(REACH) / 256.0);
    let square = |s: f64| (((s - centre) * per + SIDE as f64 / 2.0) as usize).min(SIDE - 1);
    let mut counts = vec![0_u64; SIDE * SIDE];
    for (f, big_f) in &points {
        for (g, big_g) in &points {
            counts[square(big_f * g) * SIDE + square(f * big_g)] += 1;
        }
    }
    let all = (n * n) as f64;
    (0..counts.len()).map(|k| (counts[k] + counts[counts.len() - 1 - k]) as f64 / (2.0 * all)).collect()
}

/// `L1` and `KL` distance of core's table of 2 `n` points a side from the exact distribution.
fn distances(scalings: [f64; 2], depth: u32, n: usize, exact: &[f64]) -> [f64; 2] {
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
    let parts = table[3..].iter().map(|w| f64::from(*w) / sum);
    let l1 = parts.clone().zip(exact).map(|(a, b)| (a - b).abs()).sum();
    let kl = |(a, b): (f64, &f64)| if *b > 0.0 { b * (b / a.max(1e-9)).ln() } else { 0.0 };
    [l1, parts.zip(exact).map(kl).sum()]
}

#[test]
fn tables_of_surfaces_are_near_their_exact_distributions() {
    let mut all = Vec::new();
    for (name, scalings) in [("G x G", [0.85, -0.85]), ("F x F", [0.5, 0.5])] {
        let (rough, exact) = (exact(scalings, 5003), exact(scalings, 12007));
        assert!((exact.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let own: f64 = rough.iter().zip(&exact).map(|(a, b)| (a - b).abs()).sum();
        let [l1, kl] = distances(scalings, 11, 2048, &exact);
        println!("{name}: L1 {l1:.4}, KL {kl:.5}; the exact one of fewer places L1 {own:.4}");
        assert!(l1 < 0.03 && kl < 0.001 && own < 0.05, "{name} {l1} {kl} {own}");
        all.push(l1);
        // of few points it is not
        let [few, _] = distances(scalings, 11, 16, &exact);
        assert!(few > 0.03, "{few}");
    }
    assert!(all.iter().all(|l1| *l1 > 1e-4), "{all:?}");
}
