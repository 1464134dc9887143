//! Heights of the plane-to-line function, their law and its statistics.

use attractor::Error;
use attractor::num::{Coordinate, RandomField, Real, Unit};
use attractor::terrain::{Heights, PlaneToLine, Side};
use attractor_reference::terrain as reference;

use super::{ULP, Uniform, grid, knots, lattice, law};

/// At random points of every level, for seeds and places at the ends of their ranges, against the recursion
/// of the text.
#[test]
fn heights_are_within_2_units_a_level() {
    let mut uniform = Uniform(1);
    let mut worst = [0.0_f64; 17];
    let mut tried = 0;
    for (seed, origin) in
        [(0, [0, 0]), (1 << 31, [-32768, 32764]), (u64::MAX, [32764, -32768]), (7, [-2, -1])]
    {
        for (offset, similarity) in [(0.3, 0.8), (1.5, 1.0), (0.4, 0.5), (0.0, 0.7), (0.05, 0.0)] {
            let given = knots(12, seed ^ 5);
            let heights = Heights::new(4, 3, &given).unwrap().with_origin(origin[0], origin[1]).unwrap();
            let random = RandomField::new(seed);
            let terrain = PlaneToLine::new(heights, law(offset, similarity), random).unwrap();
            let [u_0, v_0] = origin.map(f64::from);
            let r = |u: f64, v: f64| {
                let [u, v] = [u + u_0, v + v_0].map(Coordinate::from_num);
                random.at(u, v).map(|r| r.to_num())
            };
            for level in 0..=16 {
                for _ in 0..40 {
                    let (i, j) = (uniform.below((3 << level) + 1), uniform.below((2 << level) + 1));
                    let [u, v] = terrain.point(level, i, j);
                    let at = [u.to_num::<f64>() - u_0, v.to_num::<f64>() - v_0];
                    let exact = reference::plane_to_line(
                        &grid(&heights),
                        Unit::from_num(offset).to_num(),
                        Unit::from_num(similarity).to_num(),
                        &r,
                        at,
                    );
                    let error = (terrain.height(u, v).to_num::<f64>() - exact).abs() / ULP;
                    worst[level as usize] = worst[level as usize].max(error);
                    tried += 1;
                }
            }
        }
    }
    println!("{worst:.2?} units of 2^-24 at levels 0 to 16");
    assert_eq!((tried, worst[0]), (4 * 5 * 17 * 40, 0.0));
    for (level, worst) in worst.iter().enumerate().skip(1) {
        assert!(*worst > 0.2 && *worst < 2.0 * level as f64, "{level}: {worst}");
    }
}

/// At every point, edges included: none is raised by a number that has no business there.
#[test]
fn the_mean_of_1000_seeds_is_that_of_the_knots_at_every_point() {
    let zero = [Real::ZERO; 9];
    let heights = Heights::new(3, 3, &zero).unwrap();
    let level = 4;
    let side = (2 << level) + 1;
    let mut sums = vec![[0.0_f64; 2]; side * side];
    for seed in 0..1000 {
        let terrain = PlaneToLine::new(heights, law(0.3, 0.8), RandomField::new(seed)).unwrap();
        for ([sum, square], height) in sums.iter_mut().zip(lattice(&terrain, level).2) {
            let height = height.to_num::<f64>();
            *sum += height;
            *square += height * height;
        }
    }
    let mut worst = 0.0_f64;
    for [sum, square] in sums.iter().filter(|[_, square]| *square > 0.0) {
        let (mean, variance) = (sum / 1000.0, square / 1000.0);
        worst = worst.max(mean.abs() / (variance / 1000.0).sqrt());
    }
    let knots = sums.iter().filter(|[_, square]| *square == 0.0).count();
    println!("{worst:.2} standard errors at most");
    assert!(knots == 9 && worst > 2.0 && worst < 4.0, "{knots} {worst}");
}

/// The rule's own creases: the mean square of the second difference across lines that were born at a step of
/// 64, over that across lines born at the last step.
fn crease(similarity: f64) -> f64 {
    let zero = [Real::ZERO; 4];
    let (mut old, mut new) = ((0.0, 0), (0.0, 0));
    for seed in 0..12 {
        let heights = Heights::new(2, 2, &zero).unwrap();
        let terrain = PlaneToLine::new(heights, law(0.3, similarity), RandomField::new(seed)).unwrap();
        let (width, count, all) = lattice(&terrain, 9);
        for row in 0..count {
            for column in 1..width - 1 {
                let sum = match column.trailing_zeros() {
                    0 => &mut new,
                    6 => &mut old,
                    _ => continue,
                };
                let at = |k: u32| all[(row * width + k) as usize].to_num::<f64>();
                let second = at(column - 1) - 2.0 * at(column) + at(column + 1);
                *sum = (sum.0 + second * second, sum.1 + 1);
            }
        }
    }
    (old.0 / f64::from(old.1)) / (new.0 / f64::from(new.1))
}

/// Published: creases are the text's rule, and a smaller exponent has less of them.
#[test]
fn the_creases_of_the_rule_are_as_published() {
    let [text, rough] = [crease(1.0), crease(0.7)];
    println!("crease ratio {text:.2} for H = 1, {rough:.2} for H = 0.7");
    assert!((text - 3.58).abs() < 0.4 && (rough - 1.59).abs() < 0.15, "{text} {rough}");
}

/// Below: the rim is the middle between its inner neighbour and the new knot, displaced as the law says of
/// the level above.
#[test]
fn an_extrapolated_rim_is_a_row_of_midpoints() {
    let given = knots(12, 8);
    let heights = Heights::new(4, 3, &given).unwrap().with_origin(-1, 5).unwrap();
    let (offset, similarity) = (0.2, 0.75);
    let random = RandomField::new(4);
    let terrain = PlaneToLine::new(heights, law(offset, similarity), random).unwrap();
    let mut worst = 0.0_f64;
    for side in [Side::West, Side::East, Side::South, Side::North] {
        let along_v = matches!(side, Side::West | Side::East);
        let count = if along_v { 3 } else { 4 };
        let mut beyond = vec![Real::ZERO; count];
        terrain.extrapolated(side, &mut beyond).unwrap();
        for (k, beyond) in (0..).zip(&beyond) {
            let ([i, j], inner) = match side {
                Side::West => ([0, k], [1, k]),
                Side::East => ([3, k], [2, k]),
                Side::South => ([k, 0], [k, 1]),
                Side::North => ([k, 2], [k, 1]),
            };
            let [u, v] = terrain.point(0, i, j);
            let r = random.at(u, v)[usize::from(!along_v)].to_num::<f64>();
            let h = |i, j| heights.at(i, j).to_num::<f64>();
            let middle = (h(inner[0], inner[1]) + beyond.to_num::<f64>()) / 2.0;
            let displaced = middle + offset * similarity.exp2() * r;
            worst = worst.max((displaced - h(i, j)).abs() / ULP);
        }
        assert_eq!(
            terrain.extrapolated(side, &mut []),
            Err(Error::LengthMismatch { what: "extrapolated heights", given: 0, expected: count })
        );
    }
    println!("{worst:.2} units");
    assert!(worst > 0.05 && worst < 2.0, "{worst}");
}

/// Heights inside a cell lie within the reach of its law of those of its corners, and come near it.
#[test]
fn the_reach_of_a_law_is_an_upper_bound() {
    let given = knots(9, 21);
    let heights = Heights::new(3, 3, &given).unwrap();
    let mut nearest = 0.0_f64;
    for (seed, similarity) in [(0, 0.2), (1, 0.6), (2, 1.0), (3, 0.8)] {
        let law = law(0.2, similarity);
        let terrain = PlaneToLine::new(heights, law, RandomField::new(seed)).unwrap();
        let (width, _, all) = lattice(&terrain, 7);
        for base in 3..7 {
            let (reach, side) = (law.reach(base, 7).to_num::<f64>(), 1 << (7 - base));
            for cell in 0..4 << (2 * base) {
                let (x, y) = (side * (cell % (2 << base)), side * (cell / (2 << base)));
                let at = |i: u32, j: u32| all[((y + j) * width + x + i) as usize].to_num::<f64>();
                let corners = [at(0, 0), at(side, 0), at(0, side), at(side, side)];
                let (low, high) =
                    corners.iter().fold((9e9_f64, -9e9_f64), |(l, h), c| (l.min(*c), h.max(*c)));
                for k in 0..(side + 1) * (side + 1) {
                    let height = at(k % (side + 1), k / (side + 1));
                    let outside = (height - high).max(low - height);
                    assert!(outside <= reach, "{base} {cell}: {outside} {reach}");
                    nearest = nearest.max(outside / reach);
                }
            }
        }
    }
    println!("{nearest:.3} of the reach");
    assert!(nearest > 0.5, "{nearest}");
}
