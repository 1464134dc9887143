//! The random numbers of surfaces: what they are, and that they show no pattern.

use attractor::num::{Coordinate, RandomField};
use attractor_reference::terrain as reference;
use rustfft::FftPlanner;
use rustfft::num_complex::Complex;

use super::Uniform;

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

/// The numbers of 256 x 256 points of one lattice.
fn numbers(seed: u64, shift: u32) -> Vec<[f64; 2]> {
    let random = RandomField::new(seed);
    let at = |k: i32| Coordinate::from_bits((2 * (k - 128) + 1) << shift);
    let all = (0..1 << 16).map(|k| random.at(at(k % 256), at(k / 256)).map(|r| r.to_num()));
    all.collect()
}

/// Neither with a copy shifted by up to 8, nor with the mirror image about `u = v`, nor with the other
/// number.
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

/// Many surfaces from one table: the numbers of one have nothing to do with those of another.
#[test]
fn numbered_fields_do_not_correlate() {
    let at = |k: i32| Coordinate::from_bits((2 * (k - 128) + 1) << 12);
    let all = |number: u32| {
        let random = RandomField::new(5).numbered(number);
        (0..1 << 16).map(move |k| random.at(at(k % 256), at(k / 256)).map(|r| r.to_num::<f64>()))
    };
    let mut worst = 0.0_f64;
    for (one, other) in [(0, 1), (0, u32::MAX), (1, 2), (7, 1 << 31), (65_535, 65_536)] {
        let mut sums = [[0.0; 2]; 2];
        for (here, there) in all(one).zip(all(other)) {
            for (a, sums) in sums.iter_mut().enumerate() {
                for (b, sum) in sums.iter_mut().enumerate() {
                    *sum += here[a] * there[b] / 65_536.0;
                }
            }
        }
        worst = sums.iter().flatten().fold(worst, |worst, mean: &f64| worst.max(mean.abs()));
    }
    println!("{worst:.4}");
    // 20 means of a deviation of 1/256
    assert!(worst > 0.004 && worst < 0.02, "{worst}");
}

/// The periodogram of white noise has a peak of some 11 times its mean; the text's own index one of 1,312.
#[test]
fn the_spectrum_of_a_random_field_has_no_peak() {
    let mut worst = 0.0_f64;
    let along = FftPlanner::new().plan_fft_forward(256);
    for (seed, shift) in [(0, 0), (u64::MAX, 15), (5, 12)] {
        let mut rows: Vec<_> = numbers(seed, shift).iter().map(|r| Complex::from(r[0])).collect();
        along.process(&mut rows);
        let mut columns: Vec<_> = (0..65_536).map(|k| rows[k % 256 * 256 + k / 256]).collect();
        along.process(&mut columns);
        let power: Vec<f64> = columns.iter().map(Complex::norm_sqr).collect();
        let mean = power.iter().sum::<f64>() / 65_536.0;
        worst = power.iter().fold(worst, |worst, p| worst.max(p / mean));
    }
    println!("{worst:.1} times the mean");
    assert!(worst > 8.0 && worst < 20.0, "{worst}");
}
