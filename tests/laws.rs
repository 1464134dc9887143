//! What must hold for every function, tried on random ones.

use attractor::fif::{Cell, Fif, Knot, Pyramid};
use attractor::num::{Real, Scaling, Wide};
use attractor_reference as reference;
use attractor_tests::accuracy::{dyadic_examples, other_examples, two_to, words};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

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
    let gaps = prop::collection::vec(1..=64_i32, 1..=6);
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
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() })]

    /// The graph interpolates its knots.
    #[test]
    fn the_graph_passes_through_its_knots(random in functions(960)) {
        let f = random.fixed();
        for (x, y) in &random.knots {
            let error = (f.at(Wide::from_num(*x)).to_num::<f64>() - y).abs();
            prop_assert!(error <= f.error_bound().to_num::<f64>(), "{error} at {x}");
        }
    }

    /// The graph is the fixed point of its maps: f(L_j(x)) = alpha_j f(x) + q_j(x), with the chord as q (affine maps).
    #[test]
    fn the_graph_is_the_fixed_point_of_its_maps(random in functions(960), place in 0..=1024_u32) {
        let f = random.fixed();
        let (first, last) = (random.knots[0], random.knots[random.knots.len() - 1]);
        let u = f64::from(place) / 1024.0;
        let y = f.at_wide(Wide::from_num(first.0 + u * (last.0 - first.0))).to_num::<f64>();
        for (j, alpha) in random.scaling.iter().enumerate() {
            let (a, b) = (random.knots[j], random.knots[j + 1]);
            let image = alpha * y + (a.1 - alpha * first.1) * (1.0 - u) + (b.1 - alpha * last.1) * u;
            let x = a.0 + u * (b.0 - a.0);
            // where x is not representable the value may be that of a neighbour
            if x == Wide::from_num(x).to_num::<f64>() && random.scaling.len().is_power_of_two() && random.knots.windows(2).all(|k| (k[1].0 - k[0].0 - (b.0 - a.0)).abs() < 1e-12) {
                let got = f.at_wide(Wide::from_num(x)).to_num::<f64>();
                prop_assert!((got - image).abs() < 1e-9, "{got} against {image}");
            }
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

/// Elsewhere than on dyadic partitions the value is within the bound of the exact one at an abscissa no further than 2^-40.
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
