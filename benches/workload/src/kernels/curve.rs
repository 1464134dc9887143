//! Vertices of refined curves, points of L-systems, and subdivisions of random ones: each with the point that
//! it yields.

use core::hint::black_box;

use attractor::curve::catalogue::{GOSPER, HEIGHWAY_DRAGON, LARGEST};
use attractor::curve::{
    Displacement, Elbow, Generator, LineToLine, OneVariable, Stop, Subdivision, TwoVariable, koch,
};
use attractor::num::{Parameter, RandomFunction};
use attractor::num::{Real, Unit};
use attractor::plane::PathElement;

use super::watch::{Tally, Watch};
use crate::exported::plant;
use crate::float::{fold, mul_add};
use crate::inputs::{mixed, table};

/// The orders of the Koch curve whose vertices are counted.
const ORDER: usize = 6;

/// Walks a path to its end, from the same start in each run.
fn walk(watch: &mut Watch<'_>, path: &(impl Iterator<Item = PathElement> + Clone)) -> Tally {
    watch.time(|| {
        let mut tally = Tally::default();
        for PathElement::MoveTo(p) | PathElement::LineTo(p) in path.clone() {
            tally.checksum = tally.checksum.rotate_left(1) ^ p.x.to_bits() as u32 ^ p.y.to_bits() as u32;
            tally.units += 1;
        }
        tally
    })
}

fn refined<const S: usize>(watch: &mut Watch<'_>, generator: &Generator<S>, order: u32) -> Tally {
    match generator.refined::<12>(&koch::SEGMENT, order) {
        Ok(path) => walk(watch, &path),
        Err(_) => Tally::default(),
    }
}

#[inline(never)]
pub(super) fn koch_fixed(watch: &mut Watch<'_>) -> Tally {
    refined(watch, &koch::GENERATOR, ORDER as u32)
}

#[inline(never)]
pub(super) fn gosper(watch: &mut Watch<'_>) -> Tally {
    GOSPER.generator::<LARGEST>().map_or(Tally::default(), |generator| refined(watch, &generator, 4))
}

#[inline(never)]
pub(super) fn dragon(watch: &mut Watch<'_>) -> Tally {
    HEIGHWAY_DRAGON.generator::<2>().map_or(Tally::default(), |generator| refined(watch, &generator, 11))
}

#[inline(never)]
pub(super) fn turtle(watch: &mut Watch<'_>) -> Tally {
    plant::system()
        .and_then(|plant| plant.path::<6, 12>(4))
        .map_or(Tally::default(), |path| walk(watch, &path))
}

/// The same walk with the same stack: a copy at `p` along `d` consists of those at `p + d v_i` along `d w_i`.
macro_rules! koch {
    ($name:ident, $float:ty, $fused:expr, $fold:expr) => {
        #[inline(never)]
        pub(super) fn $name(watch: &mut Watch<'_>) -> Tally {
            const HEIGHT: $float = 0.288_675_13;
            let starts: [[$float; 2]; 4] =
                black_box([[0.0, 0.0], [1.0 / 3.0, 0.0], [0.5, HEIGHT], [2.0 / 3.0, 0.0]]);
            let vectors: [[$float; 2]; 4] =
                black_box([[1.0 / 3.0, 0.0], [1.0 / 6.0, HEIGHT], [1.0 / 6.0, -HEIGHT], [1.0 / 3.0, 0.0]]);
            let times = |[a, b]: [$float; 2], [c, d]: [$float; 2], [x, y]: [$float; 2]| {
                [$fused(a, c, $fused(-b, d, x)), $fused(a, d, $fused(b, c, y))]
            };
            watch.time(|| {
                let mut tally = Tally::default();
                let mut count = |[x, y]: [$float; 2]| {
                    tally.checksum = tally.checksum.rotate_left(1) ^ $fold(x) ^ $fold(y);
                    tally.units += 1;
                };
                let root: ([$float; 2], [$float; 2]) = black_box(([0.0, 0.0], [1.0, 0.0]));
                let mut stack = [(root.0, root.1, 0_usize); ORDER];
                let mut level = 0;
                loop {
                    let (p, d, next) = stack[level];
                    if level == ORDER - 1 {
                        starts.iter().for_each(|v| count(times(d, *v, p)));
                    } else if next < 4 {
                        stack[level].2 += 1;
                        level += 1;
                        stack[level] = (times(d, starts[next], p), times(d, vectors[next], [0.0, 0.0]), 0);
                        continue;
                    }
                    if level == 0 {
                        break;
                    }
                    level -= 1;
                }
                count([root.0[0] + root.1[0], root.0[1] + root.1[1]]);
                tally
            })
        }
    };
}

koch!(koch_f32, f32, mul_add, f32::to_bits);
koch!(koch_f64, f64, |a: f64, b: f64, c: f64| a * b + c, fold);

const SEED: u64 = 7;
const OFFSET: Unit = Unit::lit("0.3");
const TWO: Real = Real::lit("2");
/// Halvings between the knots of those that stop by parameter.
const LEVELS: u32 = 10;
const BY_PARAMETER: Stop = Stop::Parameter(Parameter::from_bits(1 << (32 - LEVELS)));
/// Room for halvings of the others.
const DEPTH: usize = 16;
/// Some thousands of points.
const BY_LENGTH: Stop = Stop::Length(Real::from_bits(1 << 17));
const BY_NORM: Stop = Stop::Norm(Real::from_bits(1 << 17));

fn random<D: Displacement + Clone>(
    watch: &mut Watch<'_>,
    law: Result<D, attractor::Error>,
    stop: Stop,
) -> Tally {
    let Ok(law) = law else { return Tally::default() };
    match Subdivision::<D, DEPTH>::new(&law, &koch::SEGMENT, stop) {
        Ok(path) => walk(watch, &path),
        Err(_) => Tally::default(),
    }
}

#[inline(never)]
pub(super) fn elbow(watch: &mut Watch<'_>) -> Tally {
    random(watch, Elbow::new(OFFSET, TWO, SEED), BY_PARAMETER)
}

#[inline(never)]
pub(super) fn elbow_by_length(watch: &mut Watch<'_>) -> Tally {
    random(watch, Elbow::new(OFFSET, TWO, SEED), BY_LENGTH)
}

#[inline(never)]
pub(super) fn line_to_line(watch: &mut Watch<'_>) -> Tally {
    random(watch, LineToLine::new(OFFSET, SEED), BY_PARAMETER)
}

#[inline(never)]
pub(super) fn one_variable(watch: &mut Watch<'_>) -> Tally {
    random(watch, OneVariable::new(OFFSET, SEED), BY_NORM)
}

#[inline(never)]
pub(super) fn two_variable(watch: &mut Watch<'_>) -> Tally {
    random(watch, TwoVariable::new(OFFSET, SEED), BY_NORM)
}

/// The elbow with the same random function and the same stack. Only the points are floating-point numbers:
/// the parameter is an integer anyway.
macro_rules! elbow {
    ($name:ident, $length:ident, $float:ty, $fused:expr, $fold:expr) => {
        #[inline(never)]
        pub(super) fn $name(watch: &mut Watch<'_>) -> Tally {
            elbow_in_floats!(watch, $float, $fused, $fold, 0.0)
        }

        #[inline(never)]
        pub(super) fn $length(watch: &mut Watch<'_>) -> Tally {
            elbow_in_floats!(watch, $float, $fused, $fold, 1.0 / 128.0)
        }
    };
}

macro_rules! elbow_in_floats {
    ($watch:ident, $float:ty, $fused:expr, $fold:expr, $limit:expr) => {{
        let Ok(law) = Elbow::new(OFFSET, TWO, SEED) else { return Tally::default() };
        let mut deviations: [$float; 32] = [0.0; 32];
        for (k, deviation) in (0..).zip(&mut deviations) {
            *deviation = law.standard_deviation(k).to_num::<$float>();
        }
        let random = RandomFunction::new(SEED);
        let (start, end, limit): ([$float; 2], [$float; 2], $float) =
            black_box(([0.0, 0.0], [1.0, 0.0], $limit));
        let square = limit * limit;
        $watch.time(|| {
            let mut tally = Tally { checksum: 0, units: 1 };
            let mut stack = [([0.0; 2], 0_u32); DEPTH + 1];
            stack[0] = (end, 0);
            let (mut waiting, mut from, mut at) = (1_usize, start, 0_u32);
            while waiting > 0 {
                let ([x, y], level) = stack[waiting - 1];
                let (dx, dy): ($float, $float) = (x - from[0], y - from[1]);
                let half = (1_u32 << 31) >> level;
                let short = if limit > 0.0 { $fused(dx, dx, dy * dy) < square } else { level >= LEVELS };
                if short || level >= DEPTH as u32 {
                    tally.checksum = tally.checksum.rotate_left(1) ^ $fold(x) ^ $fold(y);
                    tally.units += 1;
                    from = [x, y];
                    at = at.wrapping_add(half << 1);
                    waiting -= 1;
                    continue;
                }
                let middle = Parameter::from_bits(i64::from(at.wrapping_add(half)));
                let normal = random.at(middle).to_bits() as $float * (1.0 / 268_435_456.0);
                let t = deviations[level as usize & 31] * normal;
                let mean = [(from[0] + x) * 0.5, (from[1] + y) * 0.5];
                stack[waiting - 1].1 = level + 1;
                stack[waiting] = ([$fused(-dy, t, mean[0]), $fused(dx, t, mean[1])], level + 1);
                waiting += 1;
            }
            tally
        })
    }};
}

elbow!(elbow_f32, elbow_by_length_f32, f32, mul_add, f32::to_bits);
elbow!(elbow_f64, elbow_by_length_f64, f64, |a: f64, b: f64, c: f64| a * b + c, fold);

#[inline(never)]
pub(super) fn elbow_law(watch: &mut Watch<'_>) -> Tally {
    watch.time(|| {
        let Ok(law) = Elbow::new(black_box(OFFSET), TWO, SEED) else { return Tally::default() };
        let digest = |sum: u32, k| sum.rotate_left(1) ^ law.standard_deviation(k).to_bits() as u32;
        Tally { checksum: (0..32).fold(0, digest), units: 1 }
    })
}

#[inline(never)]
pub(super) fn offset_of_ratio(watch: &mut Watch<'_>) -> Tally {
    const RATIO: Real = Real::lit("1.3");
    watch.time(|| {
        let Ok(law) = OneVariable::from_ratio(black_box(RATIO), SEED) else { return Tally::default() };
        Tally { checksum: law.offset().to_bits() as u32, units: 1 }
    })
}

table! {
    /// Parameters between two knots.
    PARAMETERS: u32, i => mixed(i) as u32
}

#[inline(never)]
pub(super) fn deviate(watch: &mut Watch<'_>) -> Tally {
    let random = black_box(RandomFunction::new(SEED));
    watch.over(&PARAMETERS, |t| random.at(Parameter::from_bits(i64::from(t))).to_bits() as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floating_point_walks_as_many_points() {
        let units =
            |work: fn(&mut Watch<'_>) -> Tally| work(&mut Watch::new(&mut crate::machine::Blind, 1)).units;
        assert_eq!(units(koch_fixed), 4_u32.pow(6) + 1);
        assert_eq!((units(koch_f32), units(koch_f64)), (units(koch_fixed), units(koch_fixed)));
        assert_eq!(units(elbow), (1 << LEVELS) + 1);
        assert_eq!((units(elbow_f32), units(elbow_f64)), (units(elbow), units(elbow)));
        let exact = units(elbow_by_length);
        for other in [units(elbow_by_length_f32), units(elbow_by_length_f64)] {
            assert!(exact > 500 && other.abs_diff(exact) < exact / 50, "{other} against {exact}");
        }
    }
}
