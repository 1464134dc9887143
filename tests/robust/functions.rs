//! Fractal interpolation functions of any knots and scalings: values, calculus, bounds, surfaces.

use std::cell::Cell as Counter;

use attractor::fif::{Cell, Factor, Fif, Knot, Moments, Pyramid, Spread, Sum, Sums, Surface};
use attractor::num::{Angle, Real, Scaling, Wide};
use attractor::plane::Point2;
use proptest::collection::vec;
use proptest::prelude::*;

use super::{Drawn, fuzz, point, real, wide, word};

/// No evaluation goes through more maps.
const MOST_MAPS: u32 = 32_768;

/// What makes a function: knots, scalings.
fn wild_function() -> impl Strategy<Value = (Vec<Knot>, Vec<Scaling>)> {
    let knots = vec((wide(), wide()).prop_map(|(x, y)| Knot::new(x, y)), 0..=8);
    (knots, vec(word().prop_map(Scaling::from_bits), 0..=8), any::<bool>()).prop_map(
        |(mut knots, mut scaling, tidy)| {
            if tidy {
                knots.sort_by_key(|k| k.x);
                scaling.resize(knots.len().saturating_sub(1), Scaling::from_bits(1 << 29));
            }
            (knots, scaling)
        },
    )
}

/// Mostly acceptable: increasing knots up to ±`reach`, values up to ±`height`, scalings up to 0.9; partly
/// with equal intervals.
pub(super) fn function(reach: i64, height: i64) -> impl Strategy<Value = (Vec<Knot>, Vec<Scaling>)> {
    let maps = prop_oneof![1..=6_usize, Just(2), Just(4)];
    (maps, 0..10_u8, 0..46_u32).prop_flat_map(move |(n, kind, fine)| {
        let end = reach << 48;
        let place = prop_oneof![-end..=end, Just(-end), Just(end), (-end >> fine..=end >> fine)];
        let y = (-height << 48..=height << 48).prop_map(Wide::from_bits);
        let scaling = (-1_932_735_283..=1_932_735_283).prop_map(Scaling::from_bits);
        (vec(place, n + 1), vec(y, n + 1), vec(scaling, n)).prop_map(move |(mut xs, ys, scaling)| {
            xs.sort_unstable();
            // one in ten may have knots at one place
            for k in (1..xs.len()).rev().filter(|_| kind > 0) {
                xs[k - 1] = xs[k - 1].min(xs[k] - 1);
            }
            if kind > 4 {
                xs = (0..=n as i64).map(|i| i << (48 - fine)).collect();
            }
            (xs.iter().zip(ys).map(|(x, y)| Knot::new(Wide::from_bits(*x), y)).collect(), scaling)
        })
    })
}

/// Everything that a function can do.
fn exercise<const N: usize, const D: usize>(f: &Fif<N, D>, xs: &[Wide], epsilon: Real, p: Point2) {
    let (low, high) = f.range();
    assert!(low <= high && f.error_bound() > 0 && f.error_bound_at_x() >= f.error_bound());
    assert_eq!(f.knots().count(), f.maps() + 1);
    let (from, to) = f.domain();
    assert!(from < to && f.knots().all(|k| from <= k.x && k.x <= to) && f.degree() <= D);
    let whole = f.oscillation(0);
    assert!(
        (1..70).chain([u32::MAX]).all(|halvings| (Real::ZERO..=whole).contains(&f.oscillation(halvings)))
    );
    for x in xs {
        let y = f.at(*x);
        let slack = Wide::from(f.error_bound());
        assert!(Wide::from(low) - slack <= y && y <= Wide::from(high) + slack, "{y} outside {low} to {high}");
        f.at_wide(*x);
        f.at_by_composition(*x, epsilon);
    }
    for x in &xs[..1] {
        // an epsilon of 0 asks for more than there is
        let all = f.composite_at(*x, Real::ZERO, u32::MAX);
        assert_eq!(all, f.composite_at(*x, Real::MIN, MOST_MAPS));
        all.image(p);
        assert_eq!(f.composite_at(*x, epsilon, 0), f.composite([]));
    }
    let words = Counter::new(0);
    assert!(f.chaos_game(Drawn::new(1, &words)).take(20).all(|p| p.x >= 0 && p.x <= 1));
    assert!(words.get() <= 20, "{} words for 20 points", words.get());
    assert_eq!((f.graph(0).count(), f.graph(5).count()), (2, 6));
    assert_eq!(f.graph(u32::MAX).len(), u32::MAX as usize);
    f.graph(u32::MAX).nth(3);
    let composite = f.composite([0, 1, usize::MAX, 0]);
    composite.image(p);
    let (from, to) = composite.interval();
    assert!(from <= to);
    composite.vertical_scaling();
    if let Some(fast) = f.dyadic::<16>() {
        for x in xs {
            fast.at(Angle::from_bits(x.to_bits() as u32));
        }
        fast.error_bound();
    }
    if let Ok(fast) = f.compiled() {
        for x in xs {
            let y = Wide::from(fast.at(Angle::from_bits(x.to_bits() as u32)));
            let slack = Wide::from(fast.error_bound());
            assert!(
                Wide::from(low) - slack <= y && y <= Wide::from(high) + slack,
                "{y} outside {low} to {high}"
            );
        }
        fast.abscissa_bound();
    }
}

/// A pyramid's levels for `maps` maps: few enough cells.
pub(super) fn depth(maps: usize) -> u32 {
    (0..=4).rev().find(|d| Pyramid::cells(maps, *d) <= 1400).unwrap_or(0)
}

#[test]
fn functions_of_any_description() {
    let description = prop_oneof![wild_function(), function(30, 30), function(30_000, 30)];
    fuzz((description, vec(wide(), 8), real(), point()), 35, |((knots, scaling), xs, epsilon, p)| {
        let Ok(f) = Fif::<6, 1>::interpolating(&knots, &scaling) else { return false };
        // walks get long, and end: a few are taken
        let xs = if f.max_scaling() > 0.995 { [xs[0]; 8].to_vec() } else { xs };
        exercise(&f, &xs, epsilon, p);
        if let Ok(integral) = f.integral::<3>(xs[0]) {
            exercise(&integral, &xs, epsilon, p);
            if let Ok(again) = integral.integral::<3>(xs[1]) {
                exercise(&again, &xs, epsilon, p);
            }
            if let Ok(back) = integral.derivative::<3>() {
                exercise(&back, &xs, epsilon, p);
            }
        }
        if let Ok(slope) = f.derivative::<1>() {
            exercise(&slope, &xs, epsilon, p);
        }
        let factors = [Factor::<6, 3>::from_slope(&f, xs[2]), Factor::<6, 3>::new(&f)];
        for factor in factors.into_iter().flatten() {
            for part in [factor.value(), factor.slope(), factor.integral()] {
                exercise(part, &xs[..1], epsilon, p);
            }
            let surface = Surface::new(&factor, &factor);
            for pair in xs.windows(4) {
                surface.height(pair[0], pair[1]);
                surface.partials(pair[0], pair[1]);
                surface.normal(pair[0], pair[1]);
                surface.mean_normal((pair[0], pair[1]), (pair[2], pair[3]));
            }
        }
        true
    });
}

#[test]
fn polynomials_of_any_degree() {
    let small = || (-(1_i64 << 50)..1 << 50).prop_map(Wide::from_bits);
    let coefficient = prop_oneof![3 => small(), 1 => wide()];
    let polynomials = vec(vec(coefficient, 0..=14), 0..=4);
    fuzz((function(1, 1), polynomials, vec(wide(), 4)), 28, |((knots, scaling), polynomials, xs)| {
        let places: Vec<Wide> = knots.iter().map(|k| k.x).collect();
        let slices: Vec<&[Wide]> = polynomials.iter().map(Vec::as_slice).collect();
        let _ = Fif::<6, 0>::from_polynomials(&places, &scaling, &slices);
        let _ = Fif::<6, 12>::from_polynomials(&places, &scaling, &slices);
        // one map has nothing to join
        let one = [Wide::ZERO, Wide::from_num(1)];
        let Some((first, alpha)) = slices.first().zip(scaling.first()) else { return false };
        let Ok(f) = Fif::<1, 12>::from_polynomials(&one, &[*alpha], &[first]) else { return false };
        exercise(&f, &xs, Real::DELTA, Point2::new(Real::MIN, Real::MAX));
        let mut memory = [Cell::ZERO; 5];
        let pyramid = Pyramid::new(&f, 4, &mut memory).expect("room for five cells");
        let (min, max) = pyramid.bounds(xs[0], xs[1]);
        let at = f.at(xs[0]);
        let slack = Wide::from(f.error_bound());
        assert!(Wide::from(min) - slack <= at && at <= Wide::from(max) + slack, "{at}: {min} to {max}");
        true
    });
}

#[test]
fn bounds_between_any_arguments() {
    fuzz((function(30, 30), vec(wide(), 8)), 50, |((knots, scaling), xs)| {
        let Ok(f) = Fif::<6, 1>::interpolating(&knots, &scaling) else { return false };
        let mut memory = vec![Cell::ZERO; Pyramid::cells(f.maps(), depth(f.maps()))];
        assert!(Pyramid::new(&f, 99, &mut memory).is_err());
        let levels = depth(f.maps());
        let pyramid = Pyramid::new(&f, levels, &mut memory).expect("the memory is long enough");
        assert_eq!((pyramid.depth(), pyramid.branching() as usize), (levels, f.maps()));
        for pair in xs.windows(2) {
            let (min, max) = pyramid.bounds(pair[0], pair[1]);
            assert!(pyramid.root().min <= min && min <= max && max <= pyramid.root().max);
            let slack = Wide::from(f.error_bound());
            for x in pair {
                let y = Wide::from(f.at(*x));
                assert!(Wide::from(min) - slack <= y && y <= Wide::from(max) + slack, "{y}: {min} to {max}");
            }
        }
        assert!(pyramid.level(u32::MAX).is_empty() && pyramid.level(levels).len() == f.maps().pow(levels));
        true
    });
}

#[test]
fn moments_of_any_function() {
    fuzz((function(30, 30), vec(wide(), 8)), 35, |((knots, scaling), xs)| {
        let Ok(f) = Fif::<6, 1>::interpolating(&knots, &scaling) else { return false };
        let Ok(f) = f.integral::<2>(Wide::ZERO) else { return false };
        let levels = depth(f.maps());
        let mut memory = vec![Cell::ZERO; Pyramid::cells(f.maps(), levels)];
        let mut spreads = vec![Spread::ZERO; memory.len()];
        let pyramid = Pyramid::new(&f, levels, &mut memory).expect("the memory is long enough");
        // a slope may leave the format
        let Ok(moments) = Moments::new(&f, &pyramid, &mut spreads) else { return false };
        assert!(moments.spreads().iter().all(|s| s.slope >= 0 && s.value >= 0));
        assert_eq!(moments.pyramid().depth(), levels);
        for pair in xs.windows(2) {
            if let Some(stretch) = moments.over(pair[0], pair[1]) {
                assert!(stretch.slope_variance >= 0 && stretch.value_variance >= 0);
            }
            f.spread_at(pair[0].to_bits() as u32 % 99, pair[1].to_bits() as u64).expect("a spread");
        }
        let mut places = vec![Sum::ZERO; Sums::places(f.maps(), levels)];
        let sums = Sums::new(&f, levels, &mut places).expect("the memory is long enough");
        for pair in xs.windows(2) {
            assert!(sums.over(pair[0], pair[1]).is_none_or(|trend| trend.variance >= 0));
            sums.points(pair[0], pair[1], &mut [[Real::ZERO; 2]; 5]);
        }
        true
    });
}

/// Cells narrower than `2^-31` of the domain were taken for their neighbours, which hold other values.
#[test]
fn bounds_hold_where_cells_are_narrow() {
    let knots = [(-2.0, 0.0), (-1.875, 4.5), (30.0, 0.0)]
        .map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    let f = Fif::<2, 1>::interpolating(&knots, &[Scaling::ZERO; 2]).expect("a hat");
    let mut memory = [Cell::ZERO; Pyramid::cells(2, 8)];
    let pyramid = Pyramid::new(&f, 8, &mut memory).expect("room for a pyramid");
    // the first cell is 2^-64 of the domain wide, the last one nearly all of it
    for (x, most) in [(-2, 1), (30, 5)] {
        let (min, max) = pyramid.bounds(Wide::from_num(x), Wide::from_num(x));
        assert!(min <= 0 && max >= 0 && max < most, "{min} to {max} at {x}");
    }
}

/// Bounds of polynomials of a high degree once overflowed: factorials.
#[test]
fn polynomials_of_degree_14_have_a_range() {
    // x^14 - x^9 / 2 between 0 and 1
    let mut q = [Wide::ZERO; 15];
    (q[9], q[14]) = (Wide::from_num(-0.5), Wide::ONE);
    let places = [Wide::ZERO, Wide::ONE];
    let f = Fif::<1, 14>::from_polynomials(&places, &[Scaling::ZERO], &[&q]).expect("a polynomial");
    let (low, high) = f.range();
    let least = (0..=1000).map(|i| f.at(Wide::from_num(i) / 1000)).min().expect("values");
    assert!(
        low <= least && least < -0.02 && low > -1 && (0.5..1.1).contains(&high.to_num::<f64>()),
        "{low} {least} {high}"
    );
}

/// Nothing at all, and no room for it.
#[test]
fn functions_without_knots_or_room() {
    const KNOTS: [Knot; 2] = [Knot::lit("0", "0"), Knot::lit("1", "-127")];
    assert!(
        Fif::<0, 0>::interpolating(&[], &[]).is_err()
            && Fif::<0, 1>::interpolating(&KNOTS, &[Scaling::ZERO]).is_err()
    );
    assert!(Fif::<1, 0>::interpolating(&KNOTS, &[Scaling::ZERO]).is_err());
    assert!(Fif::<1, 1>::from_polynomials(&[], &[], &[]).is_err());
    let line = Fif::<1, 1>::interpolating(&KNOTS, &[Scaling::ZERO]).expect("a line");
    assert_eq!(line.at(Wide::MAX), -127);
    assert!(line.integral::<1>(Wide::ZERO).is_err() && line.derivative::<0>().is_ok());
    let halves = [Knot::lit("0", "0"), Knot::lit("0.5", "0"), Knot::lit("1", "0")];
    let flat = Fif::<2, 1>::interpolating(&halves, &[Scaling::ZERO; 2]).expect("two halves");
    assert!(line.dyadic::<9>().is_none() && flat.dyadic::<0>().is_none() && flat.dyadic::<2>().is_some());
    assert!(Pyramid::new(&line, 0, &mut []).is_err());
    // a number of cells is known without counting them
    assert_eq!([Pyramid::cells(0, 0), Pyramid::cells(0, u32::MAX), Pyramid::cells(2, 3)], [1, 1, 15]);
    assert!(Pyramid::cells(1, u32::MAX) >= u32::MAX as usize);
    assert_eq!([Pyramid::cells(2, u32::MAX), Pyramid::cells(usize::MAX, u32::MAX)], [usize::MAX; 2]);
}
