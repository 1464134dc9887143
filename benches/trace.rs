//! Rays a second: the mirror `G x G`, which fills a third of the picture, one ray a pixel, shading included.
//!
//! Every eighth row of 240 x 240 pixels. The reference follows Algorithm 3 by recursion and computes the
//! camera's frame anew for each ray.

use attractor::fif::Pyramid;
use attractor::plane::Field as _;
use attractor_benches::{DEPTH, MEASUREMENT, SAMPLES, WARM_UP, exact_mirror, g_integral, memory, mirror};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

const SIDE: u32 = 240;
const STEP: u32 = 8;

fn rays(criterion: &mut Criterion) {
    let (g, mut memory) = (g_integral().expect("G"), memory());
    let pyramid = Pyramid::new(&g, DEPTH, &mut memory).expect("a pyramid");
    let picture = mirror(&pyramid, SIDE).expect("a picture");
    let exact = exact_mirror();
    let rows = || (0..SIDE).step_by(STEP as usize);

    let mut group = criterion.benchmark_group("trace/rays");
    group.throughput(Throughput::Elements(u64::from(SIDE / STEP * SIDE)));
    group.bench_function("mirror", |b| {
        b.iter(|| rows().flat_map(|y| picture.row(y, 0..SIDE)).map(|t| u64::from(t.to_bits())).sum::<u64>());
    });
    group.bench_function("reference", |b| {
        let side = SIDE as usize;
        let tone = |x, y| exact.tone(side, side, (x, y as usize), (0.0, 0.0));
        b.iter(|| rows().map(|y| (0..side).map(|x| tone(x, y)).sum::<f64>()).sum::<f64>());
    });
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(WARM_UP).measurement_time(MEASUREMENT).sample_size(SAMPLES);
    targets = rays
}
criterion_main!(benches);
