//! Curves with coordinates, offsets and limits up to the ends of their formats: refused, or walked without a
//! panic; and the right values there.

use attractor::Error;
use attractor::curve::{
    Displacement, Elbow, Generator, LineToLine, OneVariable, Orientation, Stop, Subdivision, TwoVariable,
    catalogue, dimension_of_ratio, dimension_of_spectrum, koch,
};
use attractor::num::{Angle, Real, Unit, Wide};
use attractor::num::{Parameter, RandomFunction};
use attractor::plane::{PathElement, Point2};
use proptest::prelude::*;

fn point(x: f64, y: f64) -> Point2 {
    Point2::new(Real::from_num(x), Real::from_num(y))
}

const CORNERS: [Point2; 2] = [Point2::new(Real::MIN, Real::MIN), Point2::new(Real::MAX, Real::MAX)];

#[test]
fn a_base_that_is_too_long_is_refused_by_length_as_by_order() {
    for base in [
        CORNERS,
        [CORNERS[1], CORNERS[0]],
        [point(-128.0, 0.0), CORNERS[1]],
        [point(-16.0, -16.0), point(16.0, 16.0)],
        [point(0.0, 0.0), point(32.0, 0.0)],
    ] {
        for curve in catalogue::ALL {
            let generator = curve.generator::<{ catalogue::LARGEST }>().unwrap();
            let by_order = generator.refined::<12>(&base, 2).unwrap_err();
            let by_length = generator.refined_to::<12>(&base, Real::ONE).unwrap_err();
            assert!(matches!(by_order, Error::OutOfRange { index: Some(0), .. }), "{by_order}");
            assert_eq!(by_order, by_length);
        }
    }
    // the longest that is taken
    let longest = [point(0.0, 0.0), Point2::new(Real::from_bits((32 << 24) - 1), Real::ZERO)];
    assert_eq!(koch::GENERATOR.refined_to::<12>(&longest, Real::from_num(11)).unwrap().count(), 5);
    // bad bases, by length too
    let refused = |base: &[Point2]| koch::GENERATOR.refined_to::<12>(base, Real::ONE).unwrap_err();
    assert!(matches!(refused(&[]), Error::TooFew { given: 0, .. }));
    assert!(matches!(refused(&[CORNERS[0]; 2]), Error::Degenerate { .. }));
}

/// By the formula of the text in `f64`, with the offsets as they are.
#[test]
fn a_graph_continues_with_the_largest_offsets_too() {
    let (from, to) = (point(-1.0, 0.5), point(0.25, 1.0));
    let mut largest = 0.0_f64;
    for seed in 0..400 {
        let r = RandomFunction::new(seed).at(Parameter::ONE).to_num::<f64>();
        for (offset, beta) in [(Unit::MAX, 3.0), (Unit::MAX, 2.0), (Unit::MAX, 1.0), (Unit::ONE, 3.0)] {
            let law = LineToLine::from_spectrum(offset, Real::from_num(beta), seed).unwrap();
            // the offset of a level above the first is larger by 2^H
            let above = offset.to_num::<f64>() * ((beta - 1.0) / 2.0_f64).exp2();
            let want = 2.0 * (1.0 - above * 1.25 * r) - 0.5;
            let got = law.extrapolated(from, to, Parameter::ONE).unwrap();
            assert!((got.x.to_num::<f64>() - 1.5).abs() < 1e-6);
            let error = (got.y.to_num::<f64>() - want).abs();
            assert!(error < 4e-7, "{offset} {beta} {seed}: {got:?} against {want}");
            largest = largest.max((above * r).abs());
        }
    }
    // beyond the format of a deviate, in which it wrapped
    assert!(largest > 8.0, "{largest}");
}

#[test]
fn knots_farther_apart_than_a_coordinate_reaches_are_refused() {
    let law = LineToLine::new(Unit::from_num(0.1), 1).unwrap();
    let near = [point(-64.0, 0.0), Point2::new(Real::from_bits((64 << 24) - 1), Real::ZERO)];
    let far = [point(-64.0, 0.0), point(-63.0, 0.0), point(65.0, 0.0)];
    let stop = Stop::Parameter(Parameter::from_num(0.5));
    let middle = Subdivision::<_, 4>::new(&law, &near, stop).unwrap().nth(1).unwrap();
    let PathElement::LineTo(middle) = middle else { panic!("{middle:?}") };
    let r = RandomFunction::new(1).at(Parameter::from_num(0.5)).to_num::<f64>();
    assert!((middle.y.to_num::<f64>() - 12.8 * r).abs() < 1e-5, "{middle:?}");
    let refused = Subdivision::<_, 4>::new(&law, &far, stop).unwrap_err();
    assert!(matches!(refused, Error::OutOfRange { index: Some(1), .. }), "{refused}");
}

/// Any number, its ends and what lies next to them more often than chance would have it.
fn bits() -> impl Strategy<Value = i32> {
    prop_oneof![
        any::<i32>(),
        (-40_i32 << 24)..(40 << 24),
        (-2_i32 << 24)..(2 << 24),
        prop::sample::select(vec![
            i32::MIN,
            i32::MIN + 1,
            -1,
            0,
            1,
            i32::MAX - 1,
            i32::MAX,
            1 << 24,
            1 << 30
        ]),
    ]
}

fn wide_bits() -> impl Strategy<Value = i64> {
    prop_oneof![
        any::<i64>(),
        (-2_i64 << 48)..(2 << 48),
        -3_i64..4,
        prop::sample::select(vec![i64::MIN, i64::MIN + 1, i64::MAX, 0, 1 << 48]),
    ]
}

fn points(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Point2>> {
    let point = (bits(), bits()).prop_map(|(x, y)| Point2::new(Real::from_bits(x), Real::from_bits(y)));
    prop::collection::vec(point, count)
}

/// So many steps are walked of each path.
const STEPS: usize = 600;

fn walked(law: &(impl Displacement + Clone), knots: &[Point2], limit: i64, piece: [i64; 2]) -> usize {
    let real = Real::from_bits(limit as i32);
    let stops = [Stop::Parameter(Parameter::from_bits(limit)), Stop::Norm(real), Stop::Length(real)];
    let mut count = 0;
    for stop in stops {
        if let Ok(path) = Subdivision::<_, 31>::new(law, knots, stop) {
            let [first, last] = piece.map(Parameter::from_bits);
            count += path.clone().take(STEPS).count();
            count += path.between(first, last).take(STEPS).count();
        }
    }
    count
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn generators_of_any_numbers_are_refused_or_walked(
        vertices in prop::collection::vec([wide_bits(), wide_bits()], 0..6),
        turned in prop::collection::vec(0_usize..4, 0..6),
        marker in [bits(), bits()],
        base in points(0..4),
        length in bits(),
        order in 0_u32..14,
    ) {
        const ALL: [Orientation; 4] =
            [Orientation::Plain, Orientation::Reversed, Orientation::Mirrored, Orientation::MirroredReversed];
        let vertices: Vec<_> = vertices.iter().map(|p| p.map(Wide::from_bits)).collect();
        let orientations: Vec<_> = turned.iter().map(|i| ALL[*i]).collect();
        let made = [
            Generator::<5>::oriented_polyline(&vertices, &orientations),
            Generator::<5>::turtle("F+a-B-b+F", Angle::from_bits(length as u32)),
        ];
        for generator in made.into_iter().flatten() {
            let _ = (generator.dimension(), generator.lengthening(), generator.contraction_factor());
            let through = generator.clone().through(marker.map(Unit::from_bits));
            for generator in through.iter().chain([&generator]) {
                for path in [
                    generator.refined::<12>(&base, order),
                    generator.refined_to::<12>(&base, Real::from_bits(length)),
                ].into_iter().flatten() {
                    prop_assert!(path.take(STEPS).count() > 0);
                }
            }
        }
    }

    #[test]
    fn random_curves_of_any_numbers_are_refused_or_walked(
        knots in points(0..4),
        offset in bits(),
        exponent in prop_oneof![bits(), (1_i32 << 24)..=(3 << 24)],
        seed in any::<u64>(),
        limit in wide_bits(),
        piece in [wide_bits(), wide_bits()],
        at in wide_bits(),
    ) {
        let (offset, beta, at) = (Unit::from_bits(offset), Real::from_bits(exponent), Parameter::from_bits(at));
        let ends = [knots.first().copied().unwrap_or(CORNERS[0]), knots.last().copied().unwrap_or(CORNERS[1])];
        let (from, to) = (ends[0], ends[1]);
        let sorted = {
            let mut knots = knots.clone();
            knots.sort_by_key(|p| p.x);
            knots
        };
        for law in [LineToLine::new(offset, seed), LineToLine::from_spectrum(offset, beta, seed)].into_iter().flatten() {
            walked(&law, &sorted, limit, piece);
            let _ = law.extrapolated(from, to, at);
        }
        for law in [Elbow::new(offset, beta, seed), Elbow::self_similar(beta, seed)].into_iter().flatten() {
            walked(&law, &knots, limit, piece);
        }
        if let Ok(law) = OneVariable::new(offset, seed) {
            walked(&law, &knots, limit, piece);
            let _ = law.extrapolated(from, to, at);
        }
        if let Ok(law) = TwoVariable::new(offset, seed) {
            walked(&law, &knots, limit, piece);
            let _ = law.extrapolated(from, to, at);
        }
        if let Ok(dimension) = dimension_of_ratio(beta) {
            prop_assert!(dimension >= Wide::ONE - Wide::DELTA * 8);
        }
        if let Ok(dimension) = dimension_of_spectrum(beta) {
            prop_assert!((1..=2).contains(&dimension.ceil().to_num::<i32>()));
        }
        let triangle = koch::triangle(from, to.x);
        prop_assert_eq!(triangle[0], triangle[3]);
    }
}
