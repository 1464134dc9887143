//! Random curves in the mean: the exponent of their spectrum, and their dimension.

use attractor::curve::{Elbow, LineToLine, OneVariable, Stop, Subdivision};
use attractor::num::{Parameter, Real, Unit};
use attractor::plane::Point2;
use attractor_reference::koch as reference;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::{point, stroke, xy};

/// The power spectrum of a signal of `2^n` samples at the frequencies `1 .. 2^(n-1)`.
fn power(signal: &[f64]) -> Vec<f64> {
    let mut values: Vec<_> = signal.iter().map(Complex::from).collect();
    FftPlanner::new().plan_fft_forward(values.len()).process(&mut values);
    values[1..signal.len() / 2].iter().map(Complex::norm_sqr).collect()
}

/// Minus the slope of log power against log frequency: least squares over octaves, from `2^first` to
/// `2^last`.
fn exponent(power: &[f64], first: u32, last: u32) -> f64 {
    let octaves: Vec<(f64, f64)> = (first..last)
        .map(|k| {
            let range = (1 << k)..(2 << k);
            let mean = power[range.start - 1..range.end - 1].iter().sum::<f64>() / range.len() as f64;
            (f64::from(k), mean.log2())
        })
        .collect();
    let n = octaves.len() as f64;
    let (mx, my) =
        (octaves.iter().map(|o| o.0).sum::<f64>() / n, octaves.iter().map(|o| o.1).sum::<f64>() / n);
    let sxy: f64 = octaves.iter().map(|o| (o.0 - mx) * (o.1 - my)).sum();
    let sxx: f64 = octaves.iter().map(|o| (o.0 - mx).powi(2)).sum();
    -sxy / sxx
}

/// The exponents of the mean spectra over 64 seeds, `2^12` samples each, from 4 to 512 periods: that of
/// `y(t)`, and that of the displacement from the chord, both coordinates added up.
fn measured(curve: impl Fn(u64) -> Vec<Point2>) -> [f64; 2] {
    let mut mean = [vec![0.0; (1 << 11) - 1], vec![0.0; (1 << 11) - 1]];
    for seed in 0..64 {
        let points: Vec<_> = curve(seed).into_iter().take(1 << 12).map(xy).collect();
        let y: Vec<f64> = points.iter().map(|p| p.1).collect();
        let x: Vec<f64> = points.iter().zip(0..).map(|(p, i)| p.0 - f64::from(i) / 4096.0).collect();
        let (px, py) = (power(&x), power(&y));
        for ((sums, x), y) in (0..px.len()).zip(px).zip(py) {
            mean[0][sums] += y;
            mean[1][sums] += x + y;
        }
    }
    mean.map(|power| exponent(&power, 2, 9))
}

/// `y(t)` of an elbow that begins almost straight is steeper than asked while it becomes rough, since
/// displacements begin along `y` and end in all directions: there both coordinates are measured together.
#[test]
fn a_spectrum_falls_as_asked() {
    let knots = [point(0.0, 0.0), point(1.0, 0.0)];
    let stop = Stop::Parameter(Parameter::from_num(1.0 / 4096.0));
    for beta in [1.0, 1.5, 2.0, 2.5, 3.0] {
        let exact = Real::from_num(beta);
        let line = measured(|seed| {
            let law = LineToLine::from_spectrum(Unit::from_num(0.5), exact, seed).unwrap();
            stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap())
        });
        let elbow = |deviation: f64| {
            measured(|seed| {
                let law = Elbow::new(Unit::from_num(deviation), exact, seed).unwrap();
                stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap())
            })
        };
        let (small, large) = (elbow(0.01), elbow(0.2));
        let similar = measured(|seed| {
            let law = Elbow::self_similar(exact, seed).unwrap();
            stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap())
        });
        println!("beta {beta}: line {line:.3?}, elbow {small:.3?} {large:.3?}, self-similar {similar:.3?}");
        let mut all = vec![line[0], small[1], large[0], large[1]];
        // at 3 it is a straight line
        if beta < 3.0 {
            all.extend(similar);
        }
        assert!(all.iter().all(|b| (b - beta).abs() < 0.15), "{beta}: {all:?}");
    }
}

/// "If its length increases by an average ratio of 1.3 each time it is subdivided then its similarity ratio
/// is 1.3", D = 1.61: the lengths of the polylines of `2^k` segments, and the dimension as the slope of their
/// number against the mean segment, over 64 seeds.
///
/// Boxes count otherwise: see `attractor dimension` and its tests.
#[test]
fn a_similarity_ratio_of_1_3_gives_dimension_1_61() {
    let knots = [point(0.0, 0.0), point(1.0, 0.0)];
    let levels = 13;
    let mut lengths = vec![0.0; levels + 1];
    let (mut least, mut greatest) = (f64::MAX, 0.0_f64);
    for seed in 0..64 {
        let law = OneVariable::from_ratio(Real::from_num(1.3), seed).unwrap();
        let step = Stop::Parameter(Parameter::from_bits(1 << (32 - levels)));
        let fine: Vec<_> =
            stroke(Subdivision::<_, 16>::new(&law, &knots, step).unwrap()).into_iter().map(xy).collect();
        let own: Vec<f64> = (0..=levels)
            .map(|level| {
                let coarse: Vec<_> = fine.iter().step_by(1 << (levels - level)).copied().collect();
                reference::length(&coarse)
            })
            .collect();
        let ratio = (own[levels] / own[5]).powf(1.0 / (levels - 5) as f64);
        (least, greatest) = (least.min(ratio), greatest.max(ratio));
        for (sum, length) in lengths.iter_mut().zip(own) {
            *sum += length / 64.0;
        }
    }
    let ratio = (lengths[levels] / lengths[0]).powf(1.0 / levels as f64);
    let d = attractor::curve::dimension_of_ratio(Real::from_num(ratio)).unwrap().to_num::<f64>();
    println!("ratio {ratio:.4}, single curves {least:.4} to {greatest:.4}, D {d:.4}");
    assert!((ratio - 1.3).abs() < 0.02 && (d - 1.61).abs() < 0.05, "{ratio} {d}");
    // by definition: log N against log(1 / mean segment), least squares
    let points: Vec<(f64, f64)> =
        (3..=levels).map(|k| (-(lengths[k] / (1 << k) as f64).ln(), k as f64 * 2.0_f64.ln())).collect();
    let n = points.len() as f64;
    let (x, y) = (points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n);
    let slope = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>()
        / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>();
    println!("slope {slope:.4}");
    assert!((slope - 1.61).abs() < 0.05, "{slope}");
}
