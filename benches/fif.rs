//! Evaluations of a fractal interpolation function a second, and what it takes to build its integral and its
//! pyramid.
//!
//! Abscissae are random with 24 binary digits, so that every walk that ends with the digits does so after 24
//! maps. `plain f64` is the walk of `Dyadic` in floating point, as one would write it by hand; the reference
//! computes with pairs of `f64` and is no competitor. `identity` is the floor.

use std::hint::black_box;

use attractor::fif::{Fif, Pyramid};
use attractor::num::{Angle, Wide};
use attractor_benches::{DEPTH, MEASUREMENT, SAMPLES, WARM_UP, exact_g, g, g_integral, memory, words};
use attractor_reference::Bounds;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// How many abscissae an iteration takes.
const COUNT: u32 = 1024;

fn evaluation(criterion: &mut Criterion) {
    let places: Vec<u32> = words(COUNT).into_iter().map(|w| (w & 0xffff_ff00) | 0x100).collect();
    // x = 2 u
    let abscissae: Vec<Wide> = places.iter().map(|u| Wide::from_bits(i64::from(*u) << 17)).collect();
    let floats: Vec<f64> = abscissae.iter().map(|x| x.to_num()).collect();
    let (g, integral) = (g().expect("g"), g_integral().expect("G"));
    let (fast, fast_integral) = (g.dyadic::<16>().expect("dyadic"), integral.dyadic::<16>().expect("dyadic"));
    let (exact, exact_integral) = (exact_g(), exact_g().integral(0.0));

    let mut group = criterion.benchmark_group("fif/evaluations");
    group.throughput(Throughput::Elements(COUNT.into()));
    group.bench_function("identity", |b| b.iter(|| places.iter().fold(0, |sum, u| sum ^ black_box(*u))));
    group.bench_function("Fif::at, g", |b| {
        b.iter(|| abscissae.iter().fold(0, |sum, x| sum ^ g.at(*x).to_bits()));
    });
    group.bench_function("Fif::at, G", |b| {
        b.iter(|| abscissae.iter().fold(0, |sum, x| sum ^ integral.at(*x).to_bits()));
    });
    group.bench_function("Dyadic::at, g", |b| {
        b.iter(|| places.iter().fold(0, |sum, u| sum ^ fast.at(Angle::from_bits(*u)).to_bits()));
    });
    group.bench_function("Dyadic::at, G", |b| {
        b.iter(|| places.iter().fold(0, |sum, u| sum ^ fast_integral.at(Angle::from_bits(*u)).to_bits()));
    });
    let fast = g.compiled().expect("two halves");
    group.bench_function("Compiled::at, g", |b| {
        b.iter(|| places.iter().fold(0, |sum, u| sum ^ fast.at(Angle::from_bits(*u)).to_bits()));
    });
    // start of the interval, constant and linear coefficient, scaling
    let maps = black_box([[0.0, 0.0, 1.0, 0.85], [0.5, 1.0, -1.0, -0.85]]);
    assert!((plain(&maps, places[0]) - exact.at(floats[0])).abs() < 1e-6, "the plain walk is no walk");
    group.bench_function("plain f64, g", |b| {
        b.iter(|| places.iter().map(|u| plain(&maps, *u)).sum::<f64>());
    });
    // slow: fewer of them
    let floats = &floats[..COUNT as usize / 8];
    group.throughput(Throughput::Elements(floats.len() as u64));
    group.bench_function("reference, g", |b| b.iter(|| floats.iter().map(|x| exact.at(*x)).sum::<f64>()));
    group.bench_function("reference, G", |b| {
        b.iter(|| floats.iter().map(|x| exact_integral.at(*x)).sum::<f64>());
    });
    group.finish();
}

/// From the last digit to the first: `y <- alpha_j y + q_j(t)`, `t <- (j + t) / 2`.
fn plain(maps: &[[f64; 4]; 2], place: u32) -> f64 {
    let (mut t, mut y) = (0.0, 0.0);
    let mut digits = place >> 8;
    for _ in 0..24 {
        let [start, constant, linear, scaling] = maps[(digits & 1) as usize];
        y = scaling * y + linear * t + constant;
        t = t * 0.5 + start;
        digits >>= 1;
    }
    y
}

fn integral(criterion: &mut Criterion) {
    let (g, exact) = (g().expect("g"), exact_g());
    let mut group = criterion.benchmark_group("fif/integrals");
    group.throughput(Throughput::Elements(1));
    group.bench_function("Fif::integral, g", |b| {
        b.iter(|| -> Fif<2, 2> { black_box(&g).integral(Wide::ZERO).expect("G") })
    });
    group.bench_function("reference, g", |b| b.iter(|| black_box(&exact).integral(0.0)));
    group.finish();
}

fn pyramid(criterion: &mut Criterion) {
    let (g, exact, mut memory) = (g_integral().expect("G"), exact_g().integral(0.0), memory());
    let mut group = criterion.benchmark_group("fif/cells");
    group.throughput(Throughput::Elements(Pyramid::cells(2, DEPTH) as u64));
    group.bench_function("Pyramid::new, G", |b| {
        b.iter(|| Pyramid::new(black_box(&g), DEPTH, &mut memory).expect("a pyramid").root());
    });
    group.bench_function("reference, G", |b| b.iter(|| Bounds::new(black_box(&exact), DEPTH as usize)));
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(WARM_UP).measurement_time(MEASUREMENT).sample_size(SAMPLES);
    targets = evaluation, integral, pyramid
}
criterion_main!(benches);
