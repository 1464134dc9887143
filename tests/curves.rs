//! Refined curves, the copier and random curves against their references; the spectra of random curves.

use attractor::Error;
use attractor::curve::{
    Displacement, Elbow, Generator, LineToLine, OneVariable, Orientation, Part, Stop, Subdivision,
    TwoVariable, catalogue, coast, koch, turn_over,
};
use attractor::ifs;
use attractor::num::{Parameter, RandomFunction};
use attractor::num::{Real, Unit, Wide};
use attractor::plane::{PathElement, Point2};
use attractor_reference::koch::Show;
use attractor_reference::random_curve::{self, Law};
use attractor_reference::{copier, koch as reference};

fn point(x: f64, y: f64) -> Point2 {
    Point2::new(Real::from_num(x), Real::from_num(y))
}

fn xy(p: Point2) -> (f64, f64) {
    (p.x.to_num(), p.y.to_num())
}

/// The points of one stroke.
fn stroke(steps: impl Iterator<Item = PathElement>) -> Vec<Point2> {
    steps
        .enumerate()
        .map(|(i, step)| match step {
            PathElement::MoveTo(p) if i == 0 => p,
            PathElement::LineTo(p) if i > 0 => p,
            other => panic!("{other:?} at {i}"),
        })
        .collect()
}

fn worst(got: impl IntoIterator<Item = Point2>, want: &[(f64, f64)]) -> f64 {
    let mut count = 0;
    let worst = got.into_iter().zip(want).fold(0.0_f64, |worst, (p, q)| {
        count += 1;
        let (x, y) = xy(p);
        worst.max((x - q.0).abs()).max((y - q.1).abs())
    });
    assert_eq!(count, want.len());
    worst
}

const ULP: f64 = 1.0 / 16_777_216.0;

#[test]
fn the_koch_curve_of_order_6_is_within_one_unit_of_the_drawn_one() {
    for order in 0..=10 {
        let got = stroke(koch::GENERATOR.refined::<12>(&koch::SEGMENT, order).unwrap());
        let error = worst(got, &reference::draw_koch(order));
        println!("order {order}: {:.3} units of 2^-24", error / ULP);
        assert!(error < 1.0 * ULP, "{order}: {error:e}");
        assert!(order == 0 || error > 0.3 * ULP);
    }
}

#[test]
fn every_vertex_is_within_its_bound() {
    let mut overall: f64 = 0.0;
    for curve in catalogue::ALL {
        let generator = curve.generator::<{ catalogue::LARGEST }>().unwrap();
        let degrees = f64::from(curve.angle.to_bits()) / 2.0_f64.powi(32) * 360.0;
        let segments = reference::turtle(curve.word, degrees.round());
        let show = match curve.marker {
            Some([x, y]) => Show::Marker(x.to_num(), y.to_num()),
            None => Show::Vertices,
        };
        let most = (12.0 * 10.0_f64.ln() / 6.0 / (segments.len() as f64).ln()).floor() as u32 * 3;
        let mut largest: f64 = 0.0;
        for order in 0..=most.min(12) {
            let got = stroke(generator.refined::<16>(&koch::SEGMENT, order).unwrap());
            let want = reference::refined(&segments, show, (0.0, 0.0), (1.0, 0.0), order);
            largest = largest.max(worst(got, &want));
        }
        println!("{}: {:.3} units of 2^-24, order {}", curve.name, largest / ULP, most.min(12));
        assert!(largest < 4.0 * ULP, "{}: {largest:e}", curve.name);
        overall = overall.max(largest);
    }
    assert!(overall > 0.5 * ULP, "{overall:e}");
}

#[test]
fn an_order_contains_the_one_before_to_the_last_bit() {
    for curve in catalogue::ALL.iter().filter(|c| c.marker.is_none()) {
        let generator = curve.generator::<{ catalogue::LARGEST }>().unwrap();
        let base = koch::triangle(point(1.5, -20.0), Real::from_num(2.25));
        for order in 0..4 {
            let coarse = stroke(generator.refined::<8>(&base, order).unwrap());
            let fine = stroke(generator.refined::<8>(&base, order + 1).unwrap());
            assert!(fine.iter().step_by(generator.len()).eq(&coarse), "{} {order}", curve.name);
            assert_eq!(fine.last(), base.last());
        }
    }
}

#[test]
fn lengths_and_areas_are_those_of_the_text() {
    let base = koch::triangle(Point2::default(), Real::from_num(8));
    let side = 8.0 * 3.0_f64.sqrt();
    let triangle = side * side * 3.0_f64.sqrt() / 4.0;
    for order in 0..=7 {
        let points: Vec<_> =
            stroke(koch::GENERATOR.refined::<8>(&base, order).unwrap()).into_iter().map(xy).collect();
        let perimeter = koch::snowflake_perimeter(order).unwrap().to_wide().to_num::<f64>();
        let area = koch::snowflake_area(order).unwrap().to_wide().to_num::<f64>();
        assert!((reference::length(&points) / side - perimeter).abs() < 1e-4 * perimeter);
        // clockwise
        assert!((-reference::area(&points) / triangle - area).abs() < 1e-6);
        let exact = 1.6 - 0.6 * (4.0_f64 / 9.0).powi(order as i32);
        assert!((area - exact).abs() < 1e-12);
        assert!(
            (koch::length(order).unwrap().to_wide().to_num::<f64>() - (4.0_f64 / 3.0).powi(order as i32))
                .abs()
                < 1e-12
        );
    }
    assert!(koch::length(31).is_some() && koch::length(32).is_none());
    assert!(koch::snowflake_perimeter(31).is_some() && koch::snowflake_perimeter(32).is_none());
    assert!(koch::snowflake_area(19).is_some() && koch::snowflake_area(20).is_none());
    let limit = koch::snowflake_area(19).unwrap();
    assert!((limit.numerator as f64 / limit.denominator as f64 - 1.6).abs() < 2e-7);
}

#[test]
fn an_adaptive_curve_has_no_segment_longer_than_asked() {
    let uneven = Generator::<3>::oriented_polyline(
        &[[0.0, 0.0], [0.75, 0.25], [0.875, 0.0], [1.0, 0.0]].map(|p| p.map(Wide::from_num)),
        &[Orientation::Mirrored, Orientation::Plain, Orientation::MirroredReversed],
    )
    .unwrap();
    for limit in [2.0, 1.0, 0.3, 0.05, 0.01] {
        let points: Vec<_> = stroke(uneven.refined_to::<24>(&koch::SEGMENT, Real::from_num(limit)).unwrap())
            .into_iter()
            .map(xy)
            .collect();
        let lengths: Vec<_> = points.windows(2).map(reference::length).collect();
        let longest = lengths.iter().fold(0.0_f64, |a, b| a.max(*b));
        assert!(longest < limit + 4.0 * ULP, "{limit}: {longest}");
        // no piece was cut that was short enough: its parent, at most 8 times as long, was not
        let shortest = lengths.iter().fold(9.0_f64, |a, b| a.min(*b));
        assert!(limit > 1.0 || shortest > limit * 0.125 - 4.0 * ULP, "{limit}: {shortest}");
    }
    let koch = koch::GENERATOR.refined_to::<12>(&koch::SEGMENT, Real::from_num(0.34)).unwrap();
    assert_eq!(koch.count(), 5);
}

#[test]
fn a_generator_may_turn_its_copies() {
    let orientations =
        [Orientation::Plain, Orientation::Reversed, Orientation::Mirrored, Orientation::MirroredReversed];
    let vertices = [(0.0, 0.0), (0.375, 0.0), (0.5, 0.25), (0.75, -0.125), (1.0, 0.0)];
    let generator = Generator::<4>::oriented_polyline(
        &vertices.map(|(x, y)| [Wide::from_num(x * 3.0 + 7.0), Wide::from_num(y * 3.0)]),
        &orientations,
    )
    .unwrap();
    let segments: Vec<_> = vertices
        .iter()
        .skip(1)
        .zip(["F", "B", "f", "b"])
        .map(|(end, letter)| reference::Segment {
            end: *end,
            reversed: letter.eq_ignore_ascii_case("b"),
            mirrored: letter.chars().all(char::is_lowercase),
        })
        .collect();
    let through = generator.clone().through([0.25, 0.5].map(Unit::from_num)).unwrap();
    for order in 0..6 {
        let (a, b) = ((-3.0, 1.0), (2.0, 4.0));
        let base = [point(a.0, a.1), point(b.0, b.1)];
        let want = reference::refined(&segments, Show::Vertices, a, b, order);
        let got = stroke(generator.refined::<6>(&base, order).unwrap());
        assert!(worst(got, &want) < 3.0 * ULP, "{order}");
        let want = reference::refined(&segments, Show::Marker(0.25, 0.5), a, b, order);
        let got = stroke(through.refined::<6>(&base, order).unwrap());
        assert!(worst(got, &want) < 3.0 * ULP, "{order}");
    }
}

#[test]
fn bad_generators_and_orders_are_refused() {
    let polyline = |points: &[[f64; 2]]| {
        let points: Vec<_> = points.iter().map(|p| p.map(Wide::from_num)).collect();
        Generator::<4>::polyline(&points).unwrap_err()
    };
    assert!(matches!(polyline(&[]), Error::TooFew { .. }));
    assert!(matches!(polyline(&[[0.0, 0.0], [1.0, 0.0]]), Error::TooFew { given: 2, .. }));
    assert!(matches!(polyline(&[[0.0; 2], [0.5, 0.5], [0.5, 0.5], [1.0, 0.0]]), Error::Degenerate { .. }));
    assert!(matches!(polyline(&[[1.0; 2], [0.5, 0.5], [1.0, 1.0]]), Error::Degenerate { .. }));
    assert_eq!(polyline(&[[0.0; 2], [0.0, 0.5], [0.0, -0.75], [1.0, 0.0]]), Error::NotContractive { map: 1 });
    assert_eq!(polyline(&[[0.0; 2], [0.0, 1.0], [1.0, 0.0]]), Error::NotContractive { map: 0 });
    assert!(matches!(
        polyline(&[[0.0; 2], [0.0, 3.0], [1.0, 0.0]]),
        Error::OutOfRange { index: Some(1), .. }
    ));
    let many = [[0.0; 2], [0.2, 0.0], [0.4, 0.0], [0.6, 0.0], [0.8, 0.0], [1.0, 0.0]];
    assert!(matches!(polyline(&many), Error::Capacity { needed: 5, capacity: 4, .. }));
    let points = [[0.0; 2], [0.5, 0.5], [1.0, 0.0]].map(|p| p.map(Wide::from_num));
    let error = Generator::<4>::oriented_polyline(&points, &[Orientation::Plain; 3]).unwrap_err();
    assert!(matches!(error, Error::LengthMismatch { given: 3, expected: 2, .. }));
    for (word, parts) in [("F+F+F", 3), ("F++F", 4)] {
        let error = Generator::<4>::turtle(word, turn_over(parts)).unwrap_err();
        assert!(matches!(error, Error::Degenerate { .. }), "{word}: {error}");
    }
    let error = Generator::<4>::turtle("F+X", turn_over(4)).unwrap_err();
    assert!(matches!(error, Error::Character { position: 3, letter: 'X', .. }), "{error}");
    let koch = koch::GENERATOR;
    assert!(matches!(koch.clone().through([Unit::from_num(1.5), Unit::ZERO]), Err(Error::OutOfRange { .. })));
    let order = |n| koch.refined::<12>(&koch::SEGMENT, n).err();
    assert!(order(12).is_none());
    assert!(matches!(order(13), Some(Error::Capacity { needed: 13, capacity: 12, .. })));
    let on = |base: &[Point2]| koch.refined::<12>(base, 2).unwrap_err();
    assert!(matches!(on(&[point(0.0, 0.0)]), Error::TooFew { given: 1, .. }));
    assert!(matches!(on(&[point(0.0, 0.0), point(1.0, 1.0), point(1.0, 1.0)]), Error::Degenerate { .. }));
    assert!(matches!(on(&[point(0.0, 0.0), point(31.0, 31.0)]), Error::OutOfRange { index: Some(0), .. }));
    assert!(matches!(on(&[point(120.0, 0.0), point(127.0, 10.0)]), Error::OutOfRange { index: Some(0), .. }));
    let to = |length: f64| koch.refined_to::<12>(&koch::SEGMENT, Real::from_num(length)).err();
    assert!(matches!(to(0.0), Some(Error::OutOfRange { .. })));
    assert!(matches!(to(1e-6), Some(Error::Capacity { needed: 13, capacity: 12, .. })), "{:?}", to(1e-6));
    assert!(to(2e-6).is_none(), "{:?}", to(2e-6));
}

#[test]
fn an_image_of_the_copier_is_within_two_to_the_minus_20() {
    let mut overall: f64 = 0.0;
    for attractor in ifs::catalogue::ALL {
        let system = attractor.ifs::<{ ifs::catalogue::LARGEST }>().unwrap();
        let maps: Vec<copier::Affine> = attractor
            .maps
            .iter()
            .map(|m| [m.a.to_num(), m.b.to_num(), m.c.to_num(), m.d.to_num(), m.e.to_num(), m.f.to_num()])
            .collect();
        let shape = [(0.0, 0.0), (1.0, 0.0), (0.625, 2.0)];
        let points = shape.map(|(x, y)| point(x, y));
        let most = ((16.0 * 2.0_f64.ln() / (maps.len() as f64).ln()).ceil() as u32).min(12);
        let mut largest: f64 = 0.0;
        for order in [0, 1, 2, 3, most] {
            let want = copier::super_copier(&maps, &shape, order);
            largest = largest.max(worst(system.copier::<12>(&points, order).unwrap().points(), &want));
            let strokes = system.copier::<12>(&points, order).unwrap().path();
            assert_eq!(strokes.filter(|s| matches!(s, PathElement::MoveTo(_))).count() * 3, want.len());
        }
        println!("{}: {:.3} units of 2^-24 at order {most}", attractor.name, largest / ULP);
        assert!(largest < 16.0 * ULP, "{}: {largest:e}", attractor.name);
        overall = overall.max(largest);
    }
    assert!(overall > 0.5 * ULP, "{overall:e}");
    // depth 12 in full
    let gasket = ifs::catalogue::SIERPINSKI_GASKET.ifs::<3>().unwrap();
    let maps: Vec<copier::Affine> = ifs::catalogue::SIERPINSKI_GASKET
        .maps
        .iter()
        .map(|m| [m.a.to_num(), m.b.to_num(), m.c.to_num(), m.d.to_num(), m.e.to_num(), m.f.to_num()])
        .collect();
    let want = copier::super_copier(&maps, &[(0.25, 0.5)], 12);
    let error = worst(gasket.copier::<12>(&[point(0.25, 0.5)], 12).unwrap().points(), &want);
    assert!(error < 2.0 * ULP, "{error:e}");
}

fn f64_of(r: RandomFunction) -> impl Fn(f64) -> f64 {
    move |t| r.at(Parameter::from_num(t)).to_num()
}

#[test]
fn random_curves_are_those_of_the_recursive_procedures() {
    let r = RandomFunction::new(5);
    let (a, b) = ((-1.0, 0.5), (2.0, 1.0));
    let knots = [point(a.0, a.1), point(b.0, b.1)];
    let stop = Stop::Parameter(Parameter::from_num(1.0 / 4096.0));
    let goes_on = |level: u32, _: (f64, f64), _: (f64, f64)| level < 12;
    let check = |name: &str, got: Vec<Point2>, law: &Law<'_>, limit: f64| {
        let want = random_curve::curve(law, &f64_of(r), &goes_on, (0.0, 1.0), a, b);
        let error = worst(got, &want);
        println!("{name}: {:.2} units of 2^-24", error / ULP);
        assert!(error < limit * ULP && error > 0.3 * ULP, "{name}: {error:e}");
    };
    let offset = Unit::from_num(0.25);
    let law = OneVariable::new(offset, 5).unwrap();
    let got = stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap());
    check("one variable", got, &Law::OneVariable(&|_| 0.25), 4.0);
    let law = TwoVariable::new(offset, 5).unwrap();
    let got = stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap());
    check("two variables", got, &Law::TwoVariable(0.25, &f64_of(r.independent())), 4.0);
    let law = LineToLine::new(offset, 5).unwrap();
    let got = stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap());
    check("line to line", got, &Law::LineToLine(&|level| 0.25 * 3.0 / f64::from(1 << level)), 4.0);
    for beta in [1.0, 1.5, 2.0, 2.5, 3.0] {
        let law = LineToLine::from_spectrum(offset, Real::from_num(beta), 5).unwrap();
        let got = stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap());
        let hurst = (beta - 1.0) / 2.0;
        check("spectrum", got, &Law::LineToLine(&|level| 0.75 * (-hurst * f64::from(level)).exp2()), 8.0);
        let sigma = random_curve::elbow_deviations(0.25, beta, 32);
        let law = Elbow::new(offset, Real::from_num(beta), 5).unwrap();
        for (level, want) in (0..).zip(&sigma) {
            assert!((law.standard_deviation(level).to_num::<f64>() - want).abs() < 1e-7);
        }
        let got = stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap());
        check("elbow", got, &Law::OneVariable(&|level| sigma[level as usize]), 24.0);
    }
}

/// The textbook's recursion with the stopping rules of both texts, where no part is so close to the limit
/// that a rounding decides.
#[test]
fn lengths_and_norms_stop_as_in_the_texts() {
    let (a, b) = ((-1.0, 0.5), (2.0, 1.0));
    let knots = [point(a.0, a.1), point(b.0, b.1)];
    for seed in 0..20 {
        let r = RandomFunction::new(seed);
        let law = OneVariable::new(Unit::from_num(0.25), seed).unwrap();
        let reference = Law::OneVariable(&|_| 0.25);
        let limit = 0.031;
        let norm = |_: u32, p: (f64, f64), q: (f64, f64)| (p.0 - q.0).abs() + (p.1 - q.1).abs() >= limit;
        let length = |_: u32, p: (f64, f64), q: (f64, f64)| (p.0 - q.0).hypot(p.1 - q.1) >= limit;
        for (stop, goes_on) in [
            (Stop::Norm(Real::from_num(limit)), &norm as &dyn Fn(u32, (f64, f64), (f64, f64)) -> bool),
            (Stop::Length(Real::from_num(limit)), &length),
        ] {
            let got = stroke(Subdivision::<_, 24>::new(&law, &knots, stop).unwrap());
            let want = random_curve::curve(&reference, &f64_of(r), goes_on, (0.0, 1.0), a, b);
            assert!(worst(got, &want) < 4.0 * ULP, "{seed}");
            assert!(want.len() > 100);
        }
        // the elbow of the course unit: `fract`, down to a minimum length
        let sigma = random_curve::elbow_deviations(0.25, 2.5, 32);
        let elbow = Elbow::new(Unit::from_num(0.25), Real::from_num(2.5), seed).unwrap();
        let stop = Stop::Length(Real::from_num(limit));
        let got = stroke(Subdivision::<_, 31>::new(&elbow, &knots, stop).unwrap());
        let reference = Law::OneVariable(&|level| sigma[level as usize]);
        let want = random_curve::curve(&reference, &f64_of(r), &length, (0.0, 1.0), a, b);
        assert!(worst(got, &want) < 24.0 * ULP && want.len() > 100, "{seed}");
    }
}

/// Something checked for each of the laws.
fn with_every_law(seed: u64, mut check: impl FnMut(&str, &dyn Displacement)) {
    let offset = Unit::from_num(0.3);
    let beta = Real::from_num(1.75);
    check("elbow", &Elbow::new(offset, beta, seed).unwrap());
    check("self-similar elbow", &Elbow::self_similar(beta, seed).unwrap());
    check("line to line", &LineToLine::new(offset, seed).unwrap());
    check("line to line, spectrum", &LineToLine::from_spectrum(offset, beta, seed).unwrap());
    check("one variable", &OneVariable::new(offset, seed).unwrap());
    check("two variables", &TwoVariable::new(offset, seed).unwrap());
}

/// A law behind a reference.
struct Dyn<'a>(&'a dyn Displacement);

impl Displacement for Dyn<'_> {
    fn midpoint(&self, part: &Part) -> Point2 {
        self.0.midpoint(part)
    }

    fn check(&self, knots: &[Point2]) -> Result<(), Error> {
        self.0.check(knots)
    }
}

#[test]
fn a_curve_passes_through_its_knots() {
    let knots = [point(-2.0, 0.0), point(-1.0, 0.5), point(1.5, -0.5), point(2.0, 4.0), point(2.25, 0.0)];
    with_every_law(3, |name, law| {
        let law = Dyn(law);
        for k in [0, 1, 9] {
            let step = Stop::Parameter(Parameter::from_bits(1 << (32 - k)));
            let points = stroke(Subdivision::<_, 9>::new(&law, &knots, step).unwrap());
            assert_eq!(points.len(), (4 << k) + 1);
            assert!(points.iter().step_by(1 << k).eq(&knots), "{name}");
        }
        // by length and norm as well, as many points as each part needs
        for stop in [Stop::Length(Real::from_num(0.1)), Stop::Norm(Real::from_num(0.1))] {
            let points = stroke(Subdivision::<_, 20>::new(&law, &knots, stop).unwrap());
            let mut left = points.iter();
            assert!(knots.iter().all(|knot| left.any(|p| p == knot)), "{name}");
            assert!(points.len() > 50, "{name}");
        }
    });
    // a closed curve ends where it began
    let law = OneVariable::new(Unit::from_num(0.16), 1980).unwrap();
    let coast = Subdivision::<_, 16>::new(&law, &coast::ICELAND, Stop::Norm(Real::from_num(0.02))).unwrap();
    let coast = stroke(coast);
    let mut left = coast.iter();
    assert!(coast::ICELAND.iter().all(|cape| left.any(|p| p == cape)) && coast.first() == coast.last());
}

#[test]
fn a_piece_at_any_resolution_has_the_points_of_the_whole() {
    with_every_law(11, |name, law| pieces(name, &Dyn(law)));
}

fn pieces(name: &str, law: &Dyn<'_>) {
    let knots = [point(0.0, 0.0), point(1.0, 0.5), point(1.5, -0.5), point(3.0, 0.0)];
    let step = |k: i32| Stop::Parameter(Parameter::from_num((-f64::from(k)).exp2()));
    let whole = |k: i32| stroke(Subdivision::<_, 20>::new(law, &knots, step(k)).unwrap());
    let fine = whole(10);
    for k in 0..10 {
        assert!(fine.iter().step_by(1 << (10 - k)).eq(&whole(k)), "{name}: resolution {k}");
    }
    for (first, last) in [(0.25, 0.75), (0.5, 2.25), (1.0, 2.0), (2.875, 3.0), (-5.0, 99.0)] {
        let (t0, t1) = (Parameter::from_num(first), Parameter::from_num(last));
        let piece = stroke(Subdivision::<_, 20>::new(law, &knots, step(10)).unwrap().between(t0, t1));
        let at = |t: f64| (t.clamp(0.0, 3.0) * 1024.0) as usize;
        assert_eq!(piece, fine[at(first)..=at(last)], "{name}");
    }
    // a millionth of the curve in detail that the whole never shows
    let t0 = Parameter::from_num(1.0 + 2.0_f64.powi(-20));
    let t1 = Parameter::from_num(1.0 + 2.0_f64.powi(-19));
    let detail = stroke(Subdivision::<_, 31>::new(law, &knots, step(28)).unwrap().between(t0, t1));
    let coarse = stroke(Subdivision::<_, 31>::new(law, &knots, step(20)).unwrap().between(t0, t1));
    assert_eq!((detail.len(), coarse.len()), (257, 2), "{name}");
    assert_eq!((detail[0], detail[256]), (coarse[0], coarse[1]), "{name}");
    // by length as well, on the scale of the display
    let by_length =
        |limit: f64| Subdivision::<_, 31>::new(law, &knots, Stop::Length(Real::from_num(limit))).unwrap();
    let all = stroke(by_length(0.01));
    let piece = stroke(by_length(0.01).between(Parameter::from_num(1.25), Parameter::from_num(1.5)));
    assert!(piece.len() > 10 && all.windows(piece.len()).any(|w| w == piece), "{name}");
    assert!(stroke(by_length(0.001)).len() > 2 * all.len(), "{name}");
}

#[test]
fn a_seed_repeats_the_curve_and_another_does_not() {
    let knots = [point(0.0, 0.0), point(1.0, 0.0)];
    let hash = |seed| {
        let law = Elbow::new(Unit::from_num(0.2), Real::from_num(2.0), seed).unwrap();
        stroke(Subdivision::<_, 20>::new(&law, &knots, Stop::Length(Real::from_num(0.01))).unwrap())
            .into_iter()
            .flat_map(|p| [p.x.to_bits(), p.y.to_bits()])
            .fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b as u32)).wrapping_mul(0x0100_0000_01b3))
    };
    assert_eq!(hash(1), hash(1));
    assert_ne!(hash(1), hash(2));
    assert_eq!(hash(1), HASH_OF_SEED_1, "the same on every machine: {:#x}", hash(1));
}

const HASH_OF_SEED_1: u64 = 0xfe75_a9b9_2b40_6690;

#[test]
fn a_curve_continues_so_that_its_end_becomes_a_midpoint() {
    let (a, b) = (point(-1.0, 0.5), point(0.25, 1.0));
    let at = Parameter::ONE;
    for seed in 0..50 {
        let g = f64_of(RandomFunction::new(seed))(1.0);
        let g2 = f64_of(RandomFunction::new(seed).independent())(1.0);
        let offset = Unit::from_num(0.25);
        let check = |c: Point2, want: (f64, f64)| {
            let (x, y) = xy(c);
            assert!((x - want.0).abs() < 3.0 * ULP && (y - want.1).abs() < 3.0 * ULP, "{c:?} {want:?}");
        };
        // the midpoint between a and the new knot c is b again
        let c = xy(LineToLine::new(offset, seed).unwrap().extrapolated(a, b, at).unwrap());
        check(b, ((-1.0 + c.0) / 2.0, (0.5 + c.1) / 2.0 + 0.25 * (c.0 + 1.0) * g));
        let c = xy(OneVariable::new(offset, seed).unwrap().extrapolated(a, b, at).unwrap());
        let (dx, dy) = (c.0 + 1.0, c.1 - 0.5);
        check(b, (-1.0 + dx / 2.0 - 0.25 * g * dy, 0.5 + dy / 2.0 + 0.25 * g * dx));
        match TwoVariable::new(offset, seed).unwrap().extrapolated(a, b, at) {
            Ok(c) => {
                let (dx, dy) = (xy(c).0 + 1.0, xy(c).1 - 0.5);
                let (g, g2) = (0.25 * g, 0.25 * g2);
                check(b, (-1.0 + dx / 2.0 + g2 * dx - g * dy, 0.5 + dy / 2.0 + g2 * dy + g * dx));
            }
            Err(error) => panic!("{seed}: {error}"),
        }
    }
    // the kernel itself finds `b` again between the ends of the longer curve
    let half = Parameter::from_num(0.5);
    let found = |law: &dyn Displacement, c: Point2| {
        let points = stroke(Subdivision::<_, 1>::new(&Dyn(law), &[a, c], Stop::Parameter(half)).unwrap());
        assert!(points[1].x.abs_diff(b.x) < 3.0 * ULP && points[1].y.abs_diff(b.y) < 3.0 * ULP, "{points:?}");
        assert_ne!(points[1], point((xy(a).0 + xy(c).0) / 2.0, (xy(a).1 + xy(c).1) / 2.0));
    };
    for seed in 0..50 {
        let offset = Unit::from_num(0.25);
        let law = LineToLine::new(offset, seed).unwrap();
        found(&law, law.extrapolated(a, b, half).unwrap());
        let law = OneVariable::new(offset, seed).unwrap();
        found(&law, law.extrapolated(a, b, half).unwrap());
        let law = TwoVariable::new(offset, seed).unwrap();
        found(&law, law.extrapolated(a, b, half).unwrap());
        // in the other direction, and as a curve through three knots
        let before = law.extrapolated(b, a, half).unwrap();
        let knots = [before, a, b];
        let points = stroke(
            Subdivision::<_, 8>::new(&law, &knots, Stop::Parameter(Parameter::from_num(0.01))).unwrap(),
        );
        assert!(points.iter().step_by(128).eq(&knots) && points.len() == 257);
    }
    let far = OneVariable::new(Unit::ZERO, 1).unwrap().extrapolated(point(-100.0, 0.0), point(20.0, 0.0), at);
    assert!(matches!(far, Err(Error::OutOfRange { index: Some(0), .. })));
}

#[test]
fn bad_laws_and_limits_are_refused() {
    let two = [point(0.0, 0.0), point(1.0, 0.0)];
    let beta = |b: f64| Elbow::new(Unit::from_num(0.1), Real::from_num(b), 1).err();
    assert!(beta(1.0).is_none() && beta(3.0).is_none());
    for b in [0.99, 3.01, -2.0, 100.0] {
        assert!(matches!(beta(b), Some(Error::OutOfRange { what: "beta", .. })));
        assert!(Elbow::self_similar(Real::from_num(b), 1).is_err());
        assert!(LineToLine::from_spectrum(Unit::ONE, Real::from_num(b), 1).is_err());
    }
    assert!(OneVariable::new(-Unit::DELTA, 1).is_err() && TwoVariable::new(Unit::MIN, 1).is_err());
    assert!(OneVariable::from_ratio(Real::from_num(2), 1).is_err());
    let law = OneVariable::new(Unit::from_num(0.1), 1).unwrap();
    let new = |knots: &[Point2], stop| Subdivision::<_, 10>::new(&law, knots, stop).err();
    assert!(matches!(new(&[], Stop::Norm(Real::ONE)), Some(Error::TooFew { given: 0, .. })));
    assert!(matches!(new(&two[..1], Stop::Norm(Real::ONE)), Some(Error::TooFew { given: 1, .. })));
    assert!(matches!(new(&two, Stop::Norm(Real::ZERO)), Some(Error::OutOfRange { .. })));
    assert!(matches!(new(&two, Stop::Length(Real::MIN)), Some(Error::OutOfRange { .. })));
    assert!(matches!(new(&two, Stop::Parameter(Parameter::ZERO)), Some(Error::OutOfRange { .. })));
    let step = |e: f64| new(&two, Stop::Parameter(Parameter::from_num(e)));
    assert!(step(1.0 / 1024.0).is_none() && step(7.0).is_none());
    assert!(matches!(step(1.0 / 1025.0), Some(Error::Capacity { needed: 11, capacity: 10, .. })));
    let graph = LineToLine::new(Unit::ONE, 1).unwrap();
    let back = [point(0.0, 0.0), point(1.0, 0.0), point(1.0, 1.0)];
    let error = Subdivision::<_, 10>::new(&graph, &back, Stop::Norm(Real::ONE)).unwrap_err();
    assert_eq!(error, Error::NotIncreasing { what: "knot", index: 2 });
    // points beyond the ends of the format saturate
    let wild = TwoVariable::new(Unit::MAX, 3).unwrap();
    let ends = [Point2::new(Real::MIN, Real::MAX), point(-1.0, 1.0)];
    assert_eq!(
        Subdivision::<_, 12>::new(&wild, &ends, Stop::Parameter(Parameter::from_num(0.0005)))
            .unwrap()
            .count(),
        2049
    );
}

/// The power spectrum of a signal of `2^n` samples at the frequencies `1 .. 2^(n-1)`.
fn power(signal: &[f64]) -> Vec<f64> {
    fn transform(re: &[f64], im: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let n = re.len();
        if n == 1 {
            return (re.to_vec(), im.to_vec());
        }
        let half = |v: &[f64], odd: usize| v.iter().skip(odd).step_by(2).copied().collect::<Vec<_>>();
        let (er, ei) = transform(&half(re, 0), &half(im, 0));
        let (or, oi) = transform(&half(re, 1), &half(im, 1));
        let (mut xr, mut xi) = (vec![0.0; n], vec![0.0; n]);
        for k in 0..n / 2 {
            let (sin, cos) = (-std::f64::consts::TAU * k as f64 / n as f64).sin_cos();
            let (tr, ti) = (or[k] * cos - oi[k] * sin, or[k] * sin + oi[k] * cos);
            (xr[k], xi[k]) = (er[k] + tr, ei[k] + ti);
            (xr[k + n / 2], xi[k + n / 2]) = (er[k] - tr, ei[k] - ti);
        }
        (xr, xi)
    }
    let (re, im) = transform(signal, &vec![0.0; signal.len()]);
    (1..signal.len() / 2).map(|k| re[k] * re[k] + im[k] * im[k]).collect()
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

#[test]
fn a_refinement_lengthens_by_the_sum_of_its_segments() {
    for points in [
        &[[0.0, 0.0], [0.3, 0.4], [1.0, 0.0]][..],
        &[[0.0, 0.0], [0.25, 0.25], [0.5, -0.25], [0.9, 0.1], [1.0, 0.0]],
    ] {
        let wide: Vec<_> = points.iter().map(|p| p.map(Wide::from_num)).collect();
        let generator = Generator::<8>::polyline(&wide).unwrap();
        let exact: f64 = points.windows(2).map(|w| f64::hypot(w[1][0] - w[0][0], w[1][1] - w[0][1])).sum();
        let excess = generator.lengthening().to_num::<f64>() - exact;
        // upwards, but for the rounding of the vertices to 31 bits
        let segment = (-29.0_f64).exp2();
        assert!((-segment..(points.len() - 1) as f64 * segment).contains(&excess), "{excess:e}");
    }
}

#[test]
fn corners_lie_on_the_circle() {
    let mut worst = 0.0_f64;
    for bits in [1, 777, 1 << 20, 1 << 24, (7 << 24) + 12_345, 60 << 24, i32::MAX / 2] {
        let radius = Real::from_bits(bits);
        let r = radius.to_num::<f64>();
        for (k, p) in [0, 1, 2, 0].into_iter().zip(koch::triangle(Point2::default(), radius)) {
            let angle = (90.0 - 120.0 * f64::from(k)).to_radians();
            let (x, y) = xy(p);
            let error = (x - r * angle.cos()).abs().max((y - r * angle.sin()).abs());
            worst = worst.max(error / (ULP / 2.0 + ULP / 8.0 * r));
        }
    }
    assert!(worst > 0.25 && worst < 1.0, "{worst}");
}

#[test]
fn a_fraction_is_rounded_down() {
    for w in attractor_tests::accuracy::words(9).take(1000) {
        let fraction =
            koch::Fraction { numerator: w >> (w % 40), denominator: (w.rotate_left(20) >> (w % 23)) | 1 };
        let (n, d) = (u128::from(fraction.numerator) << 48, u128::from(fraction.denominator));
        let got = fraction.to_wide().to_bits();
        let rest = n - d * got as u128;
        assert!(rest < d || got == i64::MAX, "{fraction:?}");
    }
    let none = koch::Fraction { numerator: 1, denominator: 0 };
    assert_eq!(none.to_wide(), Wide::MAX);
}
