//! The chaos game against the exact moments of its measure.

use attractor::ifs::catalogue;
use attractor::plane::Point2;
use attractor_tests::accuracy::exact_moments;

const COUNT: usize = 1_000_000;
/// Neighbouring points are correlated, over far fewer steps than this.
const BATCH: usize = 1000;

/// The means of five products over a chaos game, and their standard errors from the means of its batches.
fn averages(points: impl Iterator<Item = Point2>, centre: [f64; 2]) -> [(f64, f64); 5] {
    let (mut batch, mut sum, mut squares) = ([0.0; 5], [0.0; 5], [0.0; 5]);
    for (i, p) in points.take(COUNT).enumerate() {
        let (x, y) = (p.x.to_num::<f64>() - centre[0], p.y.to_num::<f64>() - centre[1]);
        for (total, value) in batch.iter_mut().zip([x, y, x * x, x * y, y * y]) {
            *total += value / BATCH as f64;
        }
        if (i + 1) % BATCH == 0 {
            for (k, mean) in batch.iter_mut().enumerate() {
                sum[k] += *mean;
                squares[k] += *mean * *mean;
                *mean = 0.0;
            }
        }
    }
    let n = (COUNT / BATCH) as f64;
    core::array::from_fn(|k| {
        let mean = sum[k] / n;
        (mean, ((squares[k] / n - mean * mean) / (n - 1.0)).sqrt())
    })
}

#[test]
fn the_moments_of_a_million_points_are_within_4_standard_errors_of_the_exact_ones() {
    for attractor in [&catalogue::BARNSLEY_FERN, &catalogue::MAPLE_LEAF, &catalogue::HEIGHWAY_DRAGON] {
        let ifs = attractor.ifs::<4>().unwrap();
        let exact = ifs.moments().unwrap();
        let [x, y] = exact.mean.map(|m| m.to_num::<f64>());
        let [xx, xy, yy] = exact.covariance.map(|c| c.to_num::<f64>());
        let mut worst: f64 = 0.0;
        for seed in 1..=3 {
            let got = averages(ifs.seeded_chaos_game(seed), [x, y]);
            for ((mean, error), want) in got.into_iter().zip([0.0, 0.0, xx, xy, yy]) {
                assert!(error > 0.0 && error < 0.02, "{}: {error}", attractor.name);
                worst = worst.max((mean - want).abs() / error);
            }
        }
        println!("{}: {worst:.2} standard errors", attractor.name);
        assert!(worst > 0.1 && worst < 4.0, "{}: {worst}", attractor.name);
    }
}

#[test]
fn the_moments_are_those_of_the_reference() {
    let fern = catalogue::BARNSLEY_FERN.ifs::<4>().unwrap();
    let (got, want) = (fern.moments().unwrap(), exact_moments(&fern));
    assert!(got.mean[1] > 5.0 && got.covariance[2] > 5.0);
    assert!((got.mean[1].to_num::<f64>() - want.mean.1).abs() < 1e-13);
    assert!((got.covariance[2].to_num::<f64>() - want.covariance.2).abs() < 1e-12);
}
