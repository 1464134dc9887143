//! Points of the chaos game a second: Barnsley's fern.
//!
//! The loop in `f64` takes the same words of the same generator and the same alias table, which are integers
//! anyway; `generator and choice` is what both share, the floor.

use std::hint::black_box;

use attractor::ifs::catalogue::BARNSLEY_FERN;
use attractor::num::Alias;
use attractor::rand_xoshiro::Xoshiro128PlusPlus;
use attractor::rand_xoshiro::rand_core::{Rng, SeedableRng};
use attractor_benches::{MEASUREMENT, SAMPLES, WARM_UP};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

/// How many points an iteration takes.
const POINTS: u32 = 4096;
const SEED: u64 = 7;

fn fern(criterion: &mut Criterion) {
    let fern = BARNSLEY_FERN.ifs::<4>().expect("a fern");
    let weights: Vec<u32> = BARNSLEY_FERN.probabilities.iter().map(|p| p.to_bits().unsigned_abs()).collect();
    let alias = Alias::<4>::new(&weights).expect("a table");
    let maps: Vec<[f64; 6]> = BARNSLEY_FERN
        .maps
        .iter()
        .map(|m| [m.a, m.b, m.c, m.d].map(|v| v.to_num::<f64>()))
        .zip(BARNSLEY_FERN.maps.iter().map(|m| [m.e.to_num::<f64>(), m.f.to_num::<f64>()]))
        .map(|([a, b, c, d], [e, f])| [a, b, c, d, e, f])
        .collect();
    let maps: [[f64; 6]; 4] = maps.try_into().expect("four maps");

    let mut group = criterion.benchmark_group("ifs/points");
    group.throughput(Throughput::Elements(POINTS.into()));
    let mut rng = Xoshiro128PlusPlus::seed_from_u64(SEED);
    group.bench_function("generator and choice", |b| {
        b.iter(|| (0..POINTS).fold(0, |sum, _| sum ^ black_box(&alias).pick(rng.next_u32())));
    });
    let mut game = fern.seeded_chaos_game(SEED);
    group.bench_function("chaos game", |b| {
        b.iter(|| {
            let points = game.by_ref().take(POINTS as usize);
            points.fold(0, |sum, p| sum ^ p.x.to_bits() ^ p.y.to_bits())
        });
    });
    let mut rng = Xoshiro128PlusPlus::seed_from_u64(SEED);
    let (mut x, mut y) = (0.0, 0.0);
    group.bench_function("f64", |b| {
        b.iter(|| {
            let maps = black_box(&maps);
            let mut sum = 0.0;
            for _ in 0..POINTS {
                let [a, b, c, d, e, f] = maps[alias.pick(rng.next_u32()) & 3];
                (x, y) = (a * x + b * y + e, c * x + d * y + f);
                sum += x + y;
            }
            sum
        });
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(WARM_UP).measurement_time(MEASUREMENT).sample_size(SAMPLES);
    targets = fern
}
criterion_main!(benches);
