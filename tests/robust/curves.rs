//! Generators, refinements and random curves of any description.

use attractor::curve::{
    Displacement, Elbow, Generator, LineToLine, OneVariable, Orientation, Stop, Subdivision, TwoVariable,
    dimension_of_ratio, dimension_of_spectrum, koch,
};
use attractor::num::{Parameter, RandomFunction};
use attractor::num::{Real, Unit, Wide};
use attractor::plane::{PathElement, Point2};
use proptest::collection::vec;
use proptest::prelude::*;

use super::{fuzz, inside, point, real, unit, wide, word};

/// Mostly short segments from (0, 0) to (1, 0), partly anything.
fn polyline() -> impl Strategy<Value = Vec<[Wide; 2]>> {
    let near = || (-(1 << 47)..1_i64 << 47).prop_map(Wide::from_bits);
    let tame = vec((near(), near()), 1..6).prop_map(|middle| {
        let mut points = vec![[Wide::ZERO; 2]];
        points.extend(middle.into_iter().map(|(x, y)| [x, y]));
        points.push([Wide::ONE, Wide::ZERO]);
        points
    });
    prop_oneof![3 => tame, 1 => vec((wide(), wide()).prop_map(|(x, y)| [x, y]), 0..8)]
}

/// How many steps a path has at most, and that it is one: the pen is put down first, and nothing is drawn with the pen up.
fn walk(path: impl Iterator<Item = PathElement>, most: usize) -> usize {
    let mut count = 0;
    for (i, step) in path.enumerate() {
        assert!(i > 0 || matches!(step, PathElement::MoveTo(_)), "a path begins with {step:?}");
        assert!(i < most, "more than {most} steps");
        count = i + 1;
    }
    count
}

#[test]
fn generators_of_any_polyline() {
    let base = vec(prop_oneof![3 => inside_the_plane(), 1 => point()], 0..5);
    let description = (polyline(), vec(0..4_u8, 0..8), (unit(), unit()), base, 0..300_u32, real());
    fuzz(description, 20, |(points, turned, marker, base, order, length)| {
        let Ok(generator) = Generator::<7>::polyline(&points) else { return false };
        let orientations: Vec<_> = (0..generator.len())
            .map(|i| match turned.get(i) {
                Some(1) => Orientation::Reversed,
                Some(2) => Orientation::Mirrored,
                Some(3) => Orientation::MirroredReversed,
                _ => Orientation::Plain,
            })
            .collect();
        let _ =
            Generator::<7>::oriented_polyline(&points, &orientations[..turned.len().min(orientations.len())]);
        let turned = Generator::<7>::oriented_polyline(&points, &orientations).expect("the same segments");
        let _ = turned.clone().through([marker.0, marker.1]);
        assert!(!generator.is_empty() && generator.contraction_factor() < 1 && generator.lengthening() >= 0);
        let _ = generator.dimension();
        let segments = generator.len();
        for generator in [&generator, &turned] {
            // a lazy path: what is asked of it is all that it computes
            if let Ok(path) = generator.refined::<6>(&base, order % 8) {
                let all = segments.pow(order % 8) * base.len() + base.len();
                let walked = walk(path.clone().take(5000), 5000);
                assert!(walked <= all + 1, "{walked} of {all}");
            }
            let _ = generator.refined::<6>(&base, order).map(|path| path.take(100).count());
            let _ = generator.refined_to::<9>(&base, length).map(|path| path.take(1000).count());
        }
        true
    });
}

fn inside_the_plane() -> impl Strategy<Value = Point2> {
    (inside(4), inside(4)).prop_map(|(x, y)| Point2::new(x, y))
}

/// All of a law: the curve by each way to stop, pieces of it, points beyond its knots.
fn subdivide(law: &(impl Displacement + Clone), knots: &[Point2], stop: Stop, piece: [Parameter; 2]) -> bool {
    let Ok(curve) = Subdivision::<'_, _, 12>::new(law, knots, stop) else { return false };
    // at most 2^12 pieces between two knots
    let most = (knots.len() - 1) * (1 << 12) + 2;
    let count = walk(curve.clone().take(20_000), most);
    assert!(count >= knots.len(), "{count} points for {} knots", knots.len());
    let part = walk(curve.between(piece[0], piece[1]).take(20_000), most);
    assert!(part <= count + 2, "{part} of {count}");
    true
}

#[test]
fn random_curves_of_any_law() {
    let knots = vec(prop_oneof![9 => inside_the_plane(), 1 => point()], 0..5);
    let beta = prop_oneof![(1 << 24..=3 << 24).prop_map(Real::from_bits), real()];
    let size = prop_oneof![real(), (1 << 18..=1 << 22).prop_map(Real::from_bits)];
    let parameter = || any::<i64>().prop_map(Parameter::from_bits);
    let description = (knots, beta, unit(), any::<u64>(), size, (0..3_u8, parameter(), parameter()));
    fuzz(description, 20, |(knots, beta, offset, seed, size, (way, first, last))| {
        let stop = match way {
            0 => Stop::Parameter(first),
            1 => Stop::Norm(size),
            _ => Stop::Length(size),
        };
        let piece = [first, last];
        let (mut made, mut drawn) = (0, false);
        let ends = knots.first().copied().zip(knots.last().copied());
        for elbow in [Elbow::new(offset, beta, seed), Elbow::self_similar(beta, seed)].into_iter().flatten() {
            elbow.standard_deviation(u32::MAX);
            drawn |= subdivide(&elbow, &knots, stop, piece);
            made += 1;
        }
        for law in [LineToLine::new(offset, seed), LineToLine::from_spectrum(offset, beta, seed)]
            .into_iter()
            .flatten()
        {
            let _ = ends.map(|(a, b)| law.extrapolated(a, b, first));
            drawn |= subdivide(&law, &knots, stop, piece);
            made += 1;
        }
        // a ratio takes a search: asked for now and then
        let searched = if seed % 64 == 0 { OneVariable::from_ratio(beta, seed).ok() } else { None };
        for law in OneVariable::new(offset, seed).ok().into_iter().chain(searched) {
            assert!(law.offset() >= 0);
            let _ = ends.map(|(a, b)| law.extrapolated(a, b, first));
            drawn |= subdivide(&law, &knots, stop, piece);
            made += 1;
        }
        if let Ok(law) = TwoVariable::new(offset, seed) {
            let _ = ends.map(|(a, b)| law.extrapolated(a, b, first));
            drawn |= subdivide(&law, &knots, stop, piece);
            made += 1;
        }
        let deviate = RandomFunction::new(seed).independent().at(last);
        assert!(deviate.abs() < 4, "{deviate}");
        made > 0 && drawn
    });
}

#[test]
fn dimensions_and_exact_lengths_of_anything() {
    let bits = prop_oneof![word(), (1 << 24..=3_i32 << 24)];
    fuzz((bits, any::<u32>(), point()), 20, |(bits, order, centre)| {
        let value = Real::from_bits(bits);
        let dimension = dimension_of_ratio(value);
        if let Ok(d) = dimension {
            // a curve that crosses itself everywhere may have more than the plane's dimension
            assert!(d >= 1, "{value}: {d}");
        }
        let spectral = dimension_of_spectrum(value);
        if let Ok(d) = spectral {
            assert!((1.0..=2.0).contains(&d.to_num::<f64>()), "{value}: {d}");
        }
        koch::triangle(centre, value);
        for fraction in [koch::length(order), koch::snowflake_perimeter(order), koch::snowflake_area(order)] {
            let _ = fraction.map(|f| f.to_wide());
        }
        let offset = Unit::from_bits(bits);
        let _ = OneVariable::new(offset, order.into());
        dimension.is_ok() || spectral.is_ok()
    });
}
