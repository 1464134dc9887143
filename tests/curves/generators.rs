//! Curves by generators and by the copier: bounds, lengths, areas, what is refused.

use attractor::curve::{Generator, Orientation, catalogue, koch, turn_over};
use attractor::num::{Real, Unit, Wide};
use attractor::plane::{PathElement, Point2};
use attractor::{Error, ifs};
use attractor_reference::koch::Show;
use attractor_reference::{copier, koch as reference};

use super::{ULP, point, stroke, worst, xy};

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
