//! What must hold for every function, tried on random ones.

use attractor::fif::{Cell, Fif, Knot, Pyramid};
use attractor::num::{Angle, Real, Scaling, Wide};
use attractor_reference as reference;
use attractor_tests::accuracy::{dyadic_examples, nearest, other_examples, two_to, words};
use core::cell::Cell as Count;
use num_bigint::BigInt;
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};

/// A function of one to six maps: gaps of the knots, values, scalings.
#[derive(Debug, Clone)]
struct Random {
    knots: Vec<(f64, f64)>,
    scaling: Vec<f64>,
}

impl Random {
    fn fixed(&self) -> Fif<6, 3> {
        let knots: Vec<_> =
            self.knots.iter().map(|(x, y)| Knot::new(Wide::from_num(*x), Wide::from_num(*y))).collect();
        let scaling: Vec<_> = self.scaling.iter().map(|a| Scaling::from_num(*a)).collect();
        Fif::interpolating(&knots, &scaling).unwrap()
    }

    fn exact(&self) -> reference::Fif {
        reference::Fif::interpolating(&self.knots, &self.scaling)
    }
}

/// Numbers with few bits, so that fixed and exact describe the same function.
fn functions(steepest: i32) -> impl Strategy<Value = Random> {
    functions_over(prop::collection::vec(1..=64_i32, 1..=6), steepest)
}

/// Functions over one, two or four equal intervals of a dyadic width.
fn dyadic_functions(steepest: i32) -> impl Strategy<Value = Random> {
    functions_over((0..3, 0..4).prop_map(|(n, gap)| vec![8 << gap; 1_usize << n]), steepest)
}

fn functions_over(gaps: impl Strategy<Value = Vec<i32>>, steepest: i32) -> impl Strategy<Value = Random> {
    (gaps, -64..64_i32).prop_flat_map(move |(gaps, start)| {
        let n = gaps.len();
        let ys = prop::collection::vec(-256..=256_i32, n + 1);
        let scaling = prop::collection::vec(-steepest..=steepest, n);
        (Just(gaps), Just(start), ys, scaling).prop_map(|(gaps, start, ys, scaling)| {
            let mut x = f64::from(start) / 16.0;
            let mut knots = vec![(x, f64::from(ys[0]) / 128.0)];
            for (gap, y) in gaps.iter().zip(&ys[1..]) {
                x += f64::from(*gap) / 64.0;
                knots.push((x, f64::from(*y) / 128.0));
            }
            Random { knots, scaling: scaling.iter().map(|a| f64::from(*a) / 1024.0).collect() }
        })
    })
}

proptest! {
    #![proptest_config(config())]

    /// The graph interpolates its knots.
    #[test]
    fn the_graph_passes_through_its_knots(random in functions(960)) {
        let f = random.fixed();
        for (x, y) in &random.knots {
            let error = (f.at(Wide::from_num(*x)).to_num::<f64>() - y).abs();
            prop_assert!(error <= f.error_bound().to_num::<f64>(), "{error} at {x}");
        }
    }

    /// The derivative of the integral is the function, map by map.
    #[test]
    fn the_derivative_undoes_the_integral(random in functions(960), place in 0..=4096_u32) {
        let f = random.fixed();
        let back: Fif<6, 3> = f.integral::<3>(Wide::ONE).unwrap().derivative().unwrap();
        let (low, high) = f.domain();
        let x = low + (high - low) / 4096 * Wide::from_num(place);
        let difference = (f.at_wide(x) - back.at_wide(x)).to_num::<f64>().abs();
        prop_assert!(difference <= f.error_bound().to_num::<f64>(), "{difference}");
    }

    /// The integral from end to end is the sum over the parts (eq. 30), and the reference's.
    #[test]
    fn the_integral_is_the_references(random in functions(900)) {
        let fixed: Fif<6, 3> = random.fixed().integral(Wide::ZERO).unwrap();
        let exact = random.exact().integral(0.0);
        for (knot, (_, y)) in fixed.knots().zip(exact.knots()) {
            let error = (knot.y.to_num::<f64>() - y).abs();
            prop_assert!(error < 1e-11 * (1.0 + y.abs()) * 100.0, "{error}");
        }
    }

    /// The pyramid contains every value, on every level, and bounds over any sub-interval do.
    #[test]
    fn the_pyramid_contains_every_value(random in functions(900), ends in (0..=1000_u32, 0..=1000_u32), seed in 0..1000_u64) {
        let f = random.fixed();
        let depth = if f.maps() <= 2 { 6 } else { 3 };
        let mut memory = vec![Cell::ZERO; Pyramid::cells(f.maps(), depth)];
        let pyramid = Pyramid::new(&f, depth, &mut memory).unwrap();
        let (low, high) = f.domain();
        let at = |u: f64| low + Wide::from_num((high - low).to_num::<f64>() * u);
        let slack = f.error_bound();
        let (a, b) = (at(f64::from(ends.0.min(ends.1)) / 1000.0), at(f64::from(ends.0.max(ends.1)) / 1000.0));
        let (min, max) = pyramid.bounds(a, b);
        for w in words(seed).take(200) {
            let x = at((w >> 12) as f64 / two_to(52));
            let y = f.at(x);
            let root = pyramid.root();
            prop_assert!(root.min - slack <= y && y <= root.max + slack, "{y} at {x} outside {root:?}");
            if a <= x && x <= b {
                prop_assert!(min - slack <= y && y <= max + slack, "{y} at {x} outside [{min}, {max}]");
            }
        }
        for k in 0..depth {
            for (i, cell) in pyramid.level(k).iter().enumerate() {
                let parts = &pyramid.level(k + 1)[i * f.maps()..(i + 1) * f.maps()];
                prop_assert_eq!(cell.min, parts.iter().map(|c| c.min).min().unwrap());
                prop_assert_eq!(cell.max, parts.iter().map(|c| c.max).max().unwrap());
            }
        }
    }

    /// No wrapped value, whatever the description: construction fails or values stay in the stated range.
    #[test]
    fn values_stay_in_the_stated_range(
        ys in prop::collection::vec(-128.0..128.0_f64, 3), scaling in prop::collection::vec(-1.0..1.0_f64, 2), gap in 0.001..1.999_f64, seed in 0..1000_u64,
    ) {
        let knots = [Knot::new(Wide::ZERO, Wide::from_num(ys[0])), Knot::new(Wide::from_num(gap), Wide::from_num(ys[1])), Knot::new(Wide::from_num(2), Wide::from_num(ys[2]))];
        let scaling: Vec<_> = scaling.iter().map(|a| Scaling::from_num(*a)).collect();
        if let Ok(f) = Fif::<2, 1>::interpolating(&knots, &scaling) {
            let (min, max) = f.range();
            for w in words(seed).take(64) {
                let y = f.at(Wide::from_bits((w >> 15) as i64));
                prop_assert!(min <= y && y <= max, "{y} outside [{min}, {max}]");
            }
        }
    }
}

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 200,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    }
}

/// How far `f(L_j(x))` is from `alpha_j f(x) + q_j(x)`, `q_j` the chord (affine maps), for each map, at the
/// place `u`.
fn off_their_maps(random: &Random, f: &Fif<6, 3>, u: f64) -> Vec<f64> {
    let (first, last) = (random.knots[0], random.knots[random.knots.len() - 1]);
    let y = f.at_wide(Wide::from_num(first.0 + u * (last.0 - first.0))).to_num::<f64>();
    let parts = random.scaling.iter().zip(random.knots.windows(2));
    parts
        .map(|(alpha, ends)| {
            let (a, b) = (ends[0], ends[1]);
            let image = alpha * y + (a.1 - alpha * first.1) * (1.0 - u) + (b.1 - alpha * last.1) * u;
            (f.at_wide(Wide::from_num(a.0 + u * (b.0 - a.0))).to_num::<f64>() - image).abs()
        })
        .collect()
}

/// The graph is the fixed point of its maps: on dyadic partitions, where every abscissa is a number of the
/// format, to the last bits.
#[test]
fn the_graph_is_the_fixed_point_of_its_maps() {
    let evaluated = Count::new(0);
    let law = |(random, place): (Random, u32)| {
        let f = random.fixed();
        for difference in off_their_maps(&random, &f, f64::from(place) / 1024.0) {
            prop_assert!(difference < 1e-9, "{difference}");
            evaluated.set(evaluated.get() + 1);
        }
        Ok(())
    };
    TestRunner::new(config()).run(&(dyadic_functions(960), 0..=1024_u32), law).unwrap();
    assert!(evaluated.get() > 400, "{}", evaluated.get());
}

/// The same on any partition: abscissae are rounded, by less than `2^-42` of the domain.
#[test]
fn the_graph_is_the_fixed_point_of_its_maps_on_any_partition() {
    let (evaluated, telling) = (Count::new(0), Count::new(0));
    let law = |(random, place): (Random, u32)| {
        let f = random.fixed();
        let bound = 2.0 * (f.error_bound() + f.oscillation(42)).to_num::<f64>();
        for difference in off_their_maps(&random, &f, f64::from(place) / 1024.0) {
            prop_assert!(difference <= bound, "{difference} above {bound}");
            evaluated.set(evaluated.get() + 1);
            telling.set(telling.get() + usize::from(bound < 0.01));
        }
        Ok(())
    };
    TestRunner::new(config()).run(&(functions(700), 0..=1024_u32), law).unwrap();
    assert!(evaluated.get() > 600 && telling.get() > 100, "{} {}", evaluated.get(), telling.get());
}

/// The value at `x` of the function through rounded knots, with as many bits as its address needs: pre-images
/// lose none that count.
fn exact(knots: &[(Wide, Wide)], scaling: &[Scaling], x: Wide) -> f64 {
    const PLACE: usize = 1600; // fractional bits of a pre-image
    const VALUE: usize = 160; // of a product of scalings
    let whole = |v: Wide| BigInt::from(v.to_bits());
    let (first, last) = (knots[0], knots[knots.len() - 1]);
    let width = whole(last.0) - whole(first.0);
    let starts: Vec<_> = knots.iter().map(|knot| (whole(knot.0) - whole(first.0)) << PLACE).collect();
    // the abscissa in [0, width]
    let mut place = (whole(x) - whole(first.0)) << PLACE;
    let (mut product, mut sum) = (BigInt::from(1) << VALUE, BigInt::ZERO);
    let (mut lost, mut levels) = (0.0, 0);
    while product.magnitude().bits() + 50 > VALUE as u64 {
        let j = starts[..scaling.len()].iter().take_while(|start| **start <= place).count() - 1;
        let part = whole(knots[j + 1].0) - whole(knots[j].0);
        place = (place - &starts[j]) * &width / &part;
        lost += f64::log2((last.0 - first.0).to_num::<f64>() / (knots[j + 1].0 - knots[j].0).to_num::<f64>());
        let alpha = BigInt::from(scaling[j].to_bits());
        // q with 48 + 31 bits at both ends, the place in the unit interval with VALUE
        let end = |y: Wide, outer: Wide| (whole(y) << 31) - &alpha * whole(outer);
        let t = (&place >> (PLACE - VALUE)) / &width;
        let (left, right) = (end(knots[j].1, first.1), end(knots[j + 1].1, last.1));
        sum += ((&left * ((BigInt::from(1) << VALUE) - &t) + right * t) * &product) >> VALUE;
        product = (product * alpha) >> 31;
        levels += 1;
        assert!(levels < 60_000 && lost < (PLACE - 200) as f64, "{levels} {lost}");
    }
    // 79 + VALUE fractional bits
    let bits: i128 = (sum >> (79 + VALUE - 80)).try_into().expect("below 2^47");
    bits as f64 / two_to(80)
}

/// The bound for the value at `x` holds on any partition, and the plain one does not.
#[test]
fn values_at_x_keep_their_bound_on_any_partition() {
    let (mut beyond, mut telling, mut tried) = (0, 0, 0);
    let rough =
        ("rough thirds", vec![(0.0, 0.0), (1.0, 0.6), (2.0, -0.3), (3.0, 0.5)], vec![0.95, -0.95, 0.95]);
    let examples = other_examples().into_iter().filter(|e| e.integrate == 0);
    for (name, knots, scaling) in examples.map(|e| (e.name, e.knots, e.scaling)).chain([rough]) {
        let knots: Vec<_> = knots.iter().map(|(x, y)| (Wide::from_num(*x), Wide::from_num(*y))).collect();
        let scaling: Vec<_> = scaling.iter().map(|a| nearest(*a)).collect();
        let given: Vec<_> = knots.iter().map(|(x, y)| Knot::new(*x, *y)).collect();
        let f = Fif::<3, 1>::interpolating(&given, &scaling).expect(name);
        let (low, high) = f.domain();
        let width = (high.to_bits() - low.to_bits()) as u64;
        let bound = f.error_bound_at_x().to_num::<f64>();
        for w in words(8).take(20) {
            let x = Wide::from_bits(low.to_bits() + (w % width) as i64);
            let error = (f.at(x).to_num::<f64>() - exact(&knots, &scaling, x)).abs();
            assert!(error <= bound, "{} at {x}: {error:e} above {bound:e}", name);
            beyond += usize::from(error > f.error_bound().to_num::<f64>());
            telling += usize::from(bound < 0.1);
            tried += 1;
        }
    }
    assert!(tried == 80 && beyond > 0 && telling >= 20, "{beyond} of {tried}, {telling} telling");
}

/// The function that took seconds an evaluation: a map almost as wide as the domain and almost as high.
#[test]
fn a_long_address_gives_the_exact_value() {
    let knots = [(0.0, 0.0), (10.0, 0.1), (10.001, 0.0)].map(|(x, y)| (Wide::from_num(x), Wide::from_num(y)));
    let scaling = [nearest(0.999), nearest(0.5)];
    let f = Fif::<2, 1>::interpolating(&knots.map(|(x, y)| Knot::new(x, y)), &scaling).unwrap();
    let x = Wide::from_num(0.9999);
    let error = (f.at(x).to_num::<f64>() - exact(&knots, &scaling, x)).abs();
    assert!(error <= f.error_bound_at_x().to_num::<f64>() && error < 1e-3, "{error:e}");
}

/// Elsewhere than on dyadic partitions the value is within the bound of the exact one at an abscissa no
/// further than 2^-40.
#[test]
fn values_are_exact_at_an_abscissa_within_two_to_the_minus_40() {
    for example in other_examples() {
        let (fixed, exact) = (example.fixed(), example.exact());
        let (x0, xn) = (example.knots[0].0, example.knots[example.knots.len() - 1].0);
        let bound = fixed.error_bound().to_num::<f64>();
        let mut tried = 0;
        for w in words(4).take(1000) {
            let x = Wide::from_num(x0 + (w >> 11) as f64 / two_to(53) * (xn - x0));
            let y = fixed.at(x).to_num::<f64>();
            // f is continuous: it takes every value between those it takes near x
            let near = (-200..=200)
                .map(|i| exact.at((x.to_num::<f64>() + f64::from(i) / 200.0 * two_to(-40)).clamp(x0, xn)));
            let (min, max) = near.fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(v), b.max(v)));
            assert!(
                min - bound <= y && y <= max + bound,
                "{} at {x}: {y} outside [{min}, {max}]",
                example.name
            );
            tried += 1;
        }
        assert_eq!(tried, 1000);
    }
}

/// The same for functions compiled to words, for places no further than they say; the reference has the same
/// scalings.
#[test]
fn a_compiled_value_is_exact_at_a_place_beside() {
    let mut telling = 0;
    for mut example in other_examples() {
        example.scaling.iter_mut().for_each(|alpha| *alpha = nearest(*alpha).to_num());
        let (fast, exact) = (example.fixed().compiled().unwrap(), example.exact());
        let (x0, xn) = (example.knots[0].0, example.knots[example.knots.len() - 1].0);
        let bound = fast.error_bound().to_num::<f64>();
        let shift = f64::from(fast.abscissa_bound().to_bits());
        assert!(bound < two_to(-20) && shift > 0.0 && shift < 20.0, "{}: {bound} {shift}", example.name);
        let at = |u: f64| exact.at(x0 + (u / two_to(32)).clamp(0.0, 1.0) * (xn - x0));
        for w in words(6).take(100) {
            let u = (w >> 32) as u32;
            let y = fast.at(Angle::from_bits(u)).to_num::<f64>();
            // f is continuous: it takes every value between those it takes near u
            let near = (-300..=300).map(|i| at(f64::from(u) + f64::from(i) / 300.0 * shift));
            let (min, max) = near.fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(v), b.max(v)));
            assert!(
                min - bound <= y && y <= max + bound,
                "{} at {u:#x}: {y} outside [{min}, {max}] by more than {bound}",
                example.name
            );
            telling += u32::from((y - at(f64::from(u))).abs() > bound);
        }
    }
    assert!(telling > 15, "{telling}");
}

/// The pyramids of the papers' functions exceed the sampled range by less than 2 %.
#[test]
fn the_pyramid_is_within_2_percent_of_the_sampled_range() {
    for example in dyadic_examples().into_iter().filter(|e| e.name.contains("integral")) {
        let (fixed, exact) = (example.fixed(), example.exact());
        let mut memory = vec![Cell::ZERO; Pyramid::cells(fixed.maps(), 8)];
        let pyramid = Pyramid::new(&fixed, 8, &mut memory).unwrap();
        let (x0, xn) = (example.knots[0].0, example.knots[example.knots.len() - 1].0);
        let values = (0..=1 << 16).map(|i| exact.at(x0 + f64::from(i) / 65536.0 * (xn - x0)));
        let (min, max) = values.fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(v), b.max(v)));
        let root = pyramid.root();
        let excess = (root.max.to_num::<f64>() - root.min.to_num::<f64>()) / (max - min) - 1.0;
        assert!((0.0..0.02).contains(&excess), "{}: {excess}", example.name);
    }
}

/// A function of one map has a closed form.
#[test]
fn one_map_is_a_polynomial() {
    let knots = [(0.0, 1.0), (2.0, 3.0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    let f = Fif::<1, 1>::interpolating(&knots, &[Scaling::from_num(0.9)]).unwrap();
    for i in 0..=64 {
        let x = Wide::from_num(i) / 32;
        assert_eq!(
            f.at(x),
            Real::from_num(x + Wide::ONE),
            "the straight line through two knots is its own image"
        );
    }
}

/// At its knots an integral is the reference's. The numbers of `f` are exact here, so that its own error does
/// not count.
#[test]
fn an_integral_is_within_its_bound() {
    let (tried, worst) = (Count::new(0_u32), Count::new(0.0_f64));
    let check = |random: Random| {
        let integral: Fif<6, 3> = random.fixed().integral(Wide::ZERO).unwrap();
        let exact = random.exact();
        let unit = two_to(-48);
        for (knot, (_, y)) in integral.knots().zip(exact.integral(0.0).knots()) {
            let error = (knot.y.to_num::<f64>() - y).abs();
            prop_assert!(error <= unit, "{error:e}: {random:?}");
            worst.set(worst.get().max(error / unit));
        }
        tried.set(tried.get() + 1);
        Ok(())
    };
    TestRunner::new(config()).run(&functions(900), check).unwrap();
    println!("{:.3} units", worst.get());
    assert!(tried.get() > 50 && worst.get() > 0.25, "{} of {}", worst.get(), tried.get());
}
