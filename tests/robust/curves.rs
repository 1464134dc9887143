//! Generators, refinements, L-systems and random curves of any description.

use attractor::Error;
use attractor::curve::{
    Backwards, Displacement, Elbow, Generator, LSystem, LineToLine, MAX_LETTERS, OneVariable, Orientation,
    Part, Stop, Subdivision, TwoVariable, catalogue, dimension_of_ratio, dimension_of_spectrum, displaced,
    koch, turn_over,
};
use attractor::num::{Angle, Real, Unit, Wide};
use attractor::num::{Deviate, Parameter, RandomFunction};
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

/// How many steps a path has at most, and that it is one: the pen is put down first, and nothing is drawn
/// with the pen up.
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
    fuzz(description, 28, |(points, turned, marker, base, order, length)| {
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
    let mut back = Backwards::<'_, _, 12>::new(law, knots, stop).unwrap();
    assert_eq!(back.parameter(), Parameter::from_num(knots.len() - 1));
    assert_eq!(walk(back.by_ref().take(20_000), most), count);
    let mut last = curve.parameter();
    let mut halves = curve.clone();
    while halves.next().is_some() {
        assert!(last <= halves.parameter(), "{last} after {}", halves.parameter());
        last = halves.parameter();
    }
    assert_eq!(last, Parameter::from_num(knots.len() - 1));
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
    fuzz(description, 25, |(knots, beta, offset, seed, size, (way, first, last))| {
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
    fuzz((bits, any::<u32>(), point()), 40, |(bits, order, centre)| {
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

/// What a law makes of a part that no curve has.
#[test]
fn midpoints_of_any_part() {
    let part = (point(), point(), any::<i64>(), word(), any::<u32>());
    let laws = (unit(), prop_oneof![(1 << 24..=3 << 24).prop_map(Real::from_bits), real()], any::<u64>());
    fuzz(
        (part, laws, word(), word()),
        80,
        |((from, to, middle, span, level), (offset, beta, seed), along, across)| {
            let part = Part {
                from,
                to,
                middle: Parameter::from_bits(middle),
                level: if seed % 2 == 0 { level } else { level % 32 },
                span: Real::from_bits(span),
            };
            let (g, h) = (Deviate::from_bits(along), Deviate::from_bits(across));
            assert_eq!(displaced(&part, g, h), exactly_displaced(&part, g, h));
            let elbows = [Elbow::new(offset, beta, seed), Elbow::self_similar(beta, seed)];
            let lines = [LineToLine::new(offset, seed), LineToLine::from_spectrum(offset, beta, seed)];
            let mut points: Vec<Point2> = elbows.iter().flatten().map(|law| law.midpoint(&part)).collect();
            points.extend(lines.iter().flatten().map(|law| law.midpoint(&part)));
            points.extend(OneVariable::new(offset, seed).iter().map(|law| law.midpoint(&part)));
            points.extend(TwoVariable::new(offset, seed).iter().map(|law| law.midpoint(&part)));
            !points.is_empty()
        },
    );
    // every end of the format, and its middle, with every other
    let word = |k: u32| [i32::MIN, 0, i32::MAX][k as usize % 3];
    for k in 0..3_u32.pow(6) {
        let place = |k: u32| Point2::new(Real::from_bits(word(k)), Real::from_bits(word(k / 3)));
        let (g, h) = (Deviate::from_bits(word(k / 81)), Deviate::from_bits(word(k / 243)));
        let (from, to) = (place(k), place(k / 9));
        let part = Part { from, to, middle: Parameter::MAX, level: 31, span: Real::MIN };
        assert_eq!(displaced(&part, g, h), exactly_displaced(&part, g, h));
    }
}

/// `(p_1 + p_2) / 2 + (along + across i) (p_2 - p_1)`, differences and result saturated, rounded once.
fn exactly_displaced(part: &Part, along: Deviate, across: Deviate) -> Point2 {
    let bits = |v: Real| i128::from(v.to_bits());
    let (g, h) = (i128::from(along.to_bits()), i128::from(across.to_bits()));
    let (dx, dy) = (part.to.x.saturating_sub(part.from.x), part.to.y.saturating_sub(part.from.y));
    let coordinate = |from: Real, to: Real, moved: i128| {
        let sum = ((bits(from) + bits(to)) << 27) + moved + (1 << 27);
        Real::from_bits((sum >> 28).clamp(i32::MIN.into(), i32::MAX.into()) as i32)
    };
    let across = bits(dx) * h + bits(dy) * g;
    let along = bits(dx) * g - bits(dy) * h;
    Point2::new(coordinate(part.from.x, part.to.x, along), coordinate(part.from.y, part.to.y, across))
}

#[test]
fn turtles_of_any_word() {
    let letters = "[FABab+-]{0,9}";
    let word = prop_oneof![4 => letters, 1 => "[FABab+-]{6,40}", 1 => any::<String>()];
    fuzz((word, any::<u32>(), any::<u32>()), 40, |(word, angle, parts)| {
        let parts = turn_over(if parts % 2 == 0 { parts } else { parts % 9 });
        let mut made = false;
        for angle in [Angle::from_bits(angle), parts] {
            if let Ok(generator) = Generator::<12>::turtle(&word, angle) {
                assert!(generator.len() <= 12 && generator.contraction_factor() < 1);
                made |= true;
            }
            assert!(Generator::<0>::turtle(&word, angle).is_err());
        }
        made
    });
    for curve in catalogue::ALL {
        let generator = curve.generator::<32>().expect("the catalogue is right");
        assert!(curve.generator::<0>().is_err());
        assert!(generator.refined::<0>(&koch::SEGMENT, 1).is_err());
        // a segment itself, or the middle of its tile
        let points = if curve.marker.is_some() { 1 } else { 2 };
        assert_eq!(walk(generator.refined::<0>(&koch::SEGMENT, 0).expect("a segment"), 2), points);
        assert_eq!(catalogue::find(curve.name), Some(*curve));
    }
}

/// A walk comes by no more letters than the limit, and none of a word that grows beyond it begins.
#[test]
fn l_systems_of_any_rules() {
    let balanced = "[FGfXa]{0,3}(\\[[FX+-]{0,3}(\\[[F|]{0,2}\\])?[f-]?\\])?[FGX+|-]{0,3}";
    let word = || prop_oneof![9 => balanced.prop_map(String::from), 1 => any::<String>()];
    let letter = prop_oneof![9 => prop::sample::select(vec!['F', 'G', 'X', 'f', 'a']), 1 => any::<char>()];
    let rules = vec((letter, word()), 0..4);
    let turns = (wide(), wide());
    fuzz(
        (word(), rules, turns, 0..12_u32, any::<u32>()),
        50,
        |(axiom, rules, (angle, heading), order, far)| {
            let rules: Vec<(char, &str)> =
                rules.iter().map(|(letter, word)| (*letter, word.as_str())).collect();
            let Ok(system) = LSystem::new(&axiom, &rules, angle) else { return false };
            let system = system.with_heading(heading);
            assert!(far <= 9 || system.path::<9, 64>(far).is_err());
            let turtle = match system.path::<9, 64>(order) {
                Ok(turtle) => turtle,
                Err(Error::Capacity { needed, capacity, .. }) => {
                    assert!(
                        needed > capacity
                            && (order > 9 || capacity == 64 || capacity == MAX_LETTERS as usize)
                    );
                    return true;
                }
                Err(error) => panic!("{error}"),
            };
            let (step, steps) = (turtle.step(), turtle.steps());
            assert!(
                step > 0 && step <= 1 && i128::from(step.to_bits()) * i128::from(steps) <= 64 << 48,
                "{steps} of {step}"
            );
            // two steps of a path for each of the turtle, at most
            let most = 2 * steps as usize;
            assert!(walk(turtle.clone().take(20_000), most + 1) <= most);
            let reach = Real::from_num(65);
            for place in turtle.take(2_000) {
                let (PathElement::MoveTo(p) | PathElement::LineTo(p)) = place;
                assert!(p.x.abs() < reach && p.y.abs() < reach, "{p:?}");
            }
            true
        },
    );
    let empty = LSystem::new("", &[], Wide::MIN).expect("nothing to draw");
    assert_eq!(empty.path::<0, 0>(0).expect("no order").count(), 0);
    assert!(empty.path::<0, 0>(1).is_err());
    // words of nothing and letters that only rewrite: letters are counted all the same
    let silent = [('X', "XX"), ('Y', "")];
    let silent = LSystem::new("XY", &silent, Wide::ZERO).expect("two rules");
    assert!(
        silent.path::<64, 0>(26).expect("2^27 letters").steps() == 0 && silent.path::<64, 0>(64).is_err()
    );
    let void = LSystem::new("YYYY", &[('Y', "")], Wide::ZERO);
    assert!(void.is_ok_and(|void| void.path::<1, 0>(1).is_ok_and(|mut turtle| turtle.next().is_none())));
}
