//! Iterations of `z^2 + c` a second.
//!
//! - `home view`: the whole Mandelbrot set; elements are the dwells of all pixels added up, whether they are
//!   iterated or, as in the two largest parts of the set, known from a formula. `f64 with formulas` knows the
//!   same two parts.
//! - `interior orbit`: one orbit of a quadratic with a Siegel disc, which turns by an irrational angle: no
//!   cycle ends it early, and every element is an iteration.

use std::hint::black_box;

use attractor::escape::{Arithmetic, Julia, Mandelbrot, View};
use attractor::num::Complex;
use attractor::num::Wide;
use attractor::plane::Field as _;
use attractor_benches::{MEASUREMENT, SAMPLES, WARM_UP};
use attractor_reference::{dwell, in_cardioid, in_period_2_bulb, julia_dwell};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use embedded_graphics_core::geometry::Size;

const SIZE: Size = Size::new(120, 100);
const MAX: u32 = 100;

fn home_view(criterion: &mut Criterion) {
    let view = View::home(SIZE).expect("a view");
    let points: Vec<(f64, f64)> = (0..SIZE.height)
        .flat_map(|row| (0..SIZE.width).map(move |column| view.point(column, row)))
        .map(|c| (c.re.to_num(), c.im.to_num()))
        .collect();
    let picture = Mandelbrot::new(view, MAX).expect("a picture");
    let sum = |picture: &Mandelbrot| -> u64 {
        (0..SIZE.height).flat_map(|y| picture.row(y, 0..SIZE.width)).map(|d| u64::from(d.count)).sum()
    };
    let exact = |points: &[(f64, f64)]| -> u64 { points.iter().map(|c| u64::from(dwell(*c, MAX))).sum() };
    let iterations = exact(&points);
    assert!(sum(&picture).abs_diff(iterations) < iterations / 100, "not the same picture");

    let mut group = criterion.benchmark_group("escape/home view");
    group.throughput(Throughput::Elements(iterations));
    for precision in [Arithmetic::Word26, Arithmetic::Word29] {
        let picture = picture.with_arithmetic(precision).unwrap();
        group.bench_function(format!("{precision:?}"), |b| b.iter(|| sum(black_box(&picture))));
    }
    group.bench_function("f64", |b| b.iter(|| exact(black_box(&points))));
    group.bench_function("f64 with formulas", |b| {
        let known = |c: (f64, f64)| in_cardioid(c) || in_period_2_bulb(c);
        b.iter(|| -> u64 {
            black_box(&points).iter().map(|c| u64::from(if known(*c) { MAX } else { dwell(*c, MAX) })).sum()
        });
    });
    group.finish();
}

fn interior_orbit(criterion: &mut Criterion) {
    // rotation by the golden mean; the disc's centre is (1 - sqrt(1 - 4 c)) / 2
    const C: (f64, f64) = (-0.390_540_870_218, -0.586_787_907_347);
    const START: (f64, f64) = (-0.25, -0.25);
    const MAX: u32 = 10_000;
    let complex = |z: (f64, f64)| Complex::new(Wide::from_num(z.0), Wide::from_num(z.1));
    let view = View::new(Complex::default(), Wide::from_num(4), SIZE).expect("a view");
    let julia = Julia::new(view, complex(C), MAX).expect("a picture");
    assert!(julia.dwell_at(complex(START)).is_inside() && julia_dwell(START, C, MAX) == MAX, "it escapes");

    let mut group = criterion.benchmark_group("escape/interior orbit");
    group.throughput(Throughput::Elements(MAX.into()));
    for precision in [Arithmetic::Word26, Arithmetic::Word29] {
        let julia = julia.with_arithmetic(precision).unwrap();
        group.bench_function(format!("{precision:?}"), |b| {
            b.iter(|| julia.dwell_at(black_box(complex(START))))
        });
    }
    group.bench_function("f64", |b| b.iter(|| julia_dwell(black_box(START), C, MAX)));
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default().warm_up_time(WARM_UP).measurement_time(MEASUREMENT).sample_size(SAMPLES);
    targets = home_view, interior_orbit
}
criterion_main!(benches);
