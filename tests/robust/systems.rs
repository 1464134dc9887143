//! Iterated function systems of any maps: the chaos game, copiers, densities and moments.

use std::cell::Cell as Counter;

use attractor::ifs::{Affine, Ifs, catalogue};
use attractor::num::{Alias, Real, Unit};
use attractor::plane::{Bounds2, Field, Point2, Window};
use attractor::plane::{Density, Hits, Toned};
use embedded_graphics::geometry::Size;
use proptest::collection::vec;
use proptest::prelude::*;

use super::{Drawn, fuzz, part_of_a_row, point, size, word};

fn lies_in(p: Point2, bounds: Bounds2) -> bool {
    (bounds.min.x..=bounds.max.x).contains(&p.x) && (bounds.min.y..=bounds.max.y).contains(&p.y)
}

/// The game in portions, by steps: a word a point, and no more than 1024 to warm up.
fn play(system: &Ifs<5>, shape: &[Point2]) {
    let words = Counter::new(0);
    let whole: Vec<_> = system.chaos_game(Drawn::new(7, &words)).take(90).collect();
    let warm_up = words.replace(0) - 90;
    assert!(warm_up <= 1024, "{warm_up} words to warm up");
    let mut walk = system.walk(Drawn::new(7, &words));
    let mut portions = Vec::new();
    for _ in 0..3 {
        let mut game = system.resume(&mut walk).labelled();
        portions.extend(game.by_ref().take(30));
    }
    assert_eq!(words.get(), warm_up + 90);
    assert!(portions.iter().map(|(p, _)| p).eq(&whole));
    assert!(portions.iter().all(|(_, map)| usize::from(*map) < system.maps().len()));
    // a walk of another system, whose points may lie anywhere, warms up again where it has to
    let [a, b, c, d, e, f] = [0, 0, 0, 0, shape[0].x.to_bits(), shape[0].y.to_bits()];
    let there = Affine::new([a, b, c, d].map(Unit::from_bits), [e, f].map(Real::from_bits));
    if let Ok(far) = Ifs::<1>::new(&[there], &[Unit::ONE]) {
        let mut walk = far.seeded_walk(3);
        let mut game = system.resume(&mut walk);
        let bounds = system.bounds();
        let disc = system.invariant_disc();
        let reach = f64::from(disc.radius) + 1e-6;
        for p in game.by_ref().take(50) {
            let off = |a: Real, b: Real| a.to_num::<f64>() - b.to_num::<f64>();
            let from_centre = off(p.x, disc.centre.x).hypot(off(p.y, disc.centre.y));
            assert!(from_centre <= reach, "{p:?} outside {disc:?} of {bounds:?}");
        }
        assert!(usize::from(game.last_map()) < system.maps().len());
    }
}

fn system() -> impl Strategy<Value = Option<Ifs<5>>> {
    let tame = (vec(-(1 << 29)..=1 << 29, 4), vec(-(20 << 24)..=20 << 24, 2));
    let wild = (vec(word(), 4), vec(word(), 2));
    let maps = vec(prop_oneof![9 => tame, 1 => wild], 1..=5);
    maps.prop_map(|maps| {
        let affine = |(l, t): &(Vec<i32>, Vec<i32>)| {
            let linear = [l[0], l[1], l[2], l[3]].map(Unit::from_bits);
            Affine::new(linear, [t[0], t[1]].map(Real::from_bits))
        };
        let maps: Vec<_> = maps.iter().map(affine).collect();
        Ifs::<5>::proportional_to_determinant(&maps).ok()
    })
}

#[test]
fn copiers_of_any_shape() {
    fuzz((system(), vec(point(), 0..4), any::<u32>()), 40, |(system, shape, order)| {
        let Some(system) = system else { return false };
        let _ = system.copier::<6>(&shape, order).map(|copier| copier.points().take(50).count());
        let Ok(copier) = system.copier::<6>(&shape, order % 7) else { return false };
        let images = system.maps().len().pow(order % 7);
        assert_eq!(copier.clone().points().take(5000).count(), (images * shape.len()).min(5000));
        assert_eq!(copier.path().take(5000).count(), (images * shape.len()).min(5000));
        true
    });
}

#[test]
fn moments_of_any_system() {
    fuzz(system(), 55, |system| {
        let Some(system) = system else { return false };
        let Ok(moments) = system.moments() else { return false };
        let bounds = system.bounds();
        let [x, y] = [moments.mean[0], moments.mean[1]].map(|m| m.to_num::<f64>());
        let slack = 1e-3;
        assert!(
            bounds.min.x.to_num::<f64>() - slack <= x && x <= bounds.max.x.to_num::<f64>() + slack,
            "{x}: {bounds:?}"
        );
        assert!(
            bounds.min.y.to_num::<f64>() - slack <= y && y <= bounds.max.y.to_num::<f64>() + slack,
            "{y}: {bounds:?}"
        );
        true
    });
}

#[test]
fn densities_of_any_points() {
    let description = (vec(point(), 0..300), (point(), point()), size(), any::<[u32; 3]>(), 0..70_000_usize);
    fuzz(description, 50, |(points, (a, b), wanted, at, length)| {
        let corner = |f: fn(Real, Real) -> Real| Point2::new(f(a.x, b.x), f(a.y, b.y));
        let bounds = attractor::plane::Bounds2 { min: corner(Real::min), max: corner(Real::max) };
        let Ok(window) = Window::stretch(bounds, wanted) else { return false };
        let Size { width, height } = window.size();
        // a buffer of the wrong length is refused
        let mut wrong = vec![0_u16; length];
        let pixels = Density::counts_of(window.size());
        assert_eq!(pixels, width as usize * height as usize);
        assert!(Density::new(window, &mut wrong).is_ok() == (length >= pixels));
        if pixels > 1 << 16 {
            return false;
        }
        let (mut counts, mut maps) = (vec![0_u8; pixels], vec![0_u8; pixels]);
        let mut density = Density::new(window, &mut counts).expect("one count a pixel");
        let mut seen = 0;
        for (i, p) in points.iter().enumerate() {
            density.record(*p);
            // points and density agree on what is seen
            seen += usize::from(window.pixel(*p).is_some());
            if pixels <= 1 << 10 || i + 1 == points.len() {
                let total: usize = density.counts().iter().map(|c| usize::from(*c)).sum();
                assert!(total == seen || density.peak() == 255, "{total} of {seen}");
            }
        }
        assert_eq!(density.window(), window);
        let mut density = density.with_maps(&mut maps).expect("one map a pixel");
        density.record_from(Point2::new(b.x, a.y), u8::MAX);
        for one_in in [0, 1, at[0], u32::MAX] {
            let full = density.quantile(one_in);
            let (in_proportion, peak): (Toned<'_, _>, u16) = (density.linear(full), density.peak());
            assert!(in_proportion.row(0, 0..width.min(9)).all(|Hits { count, .. }| count <= peak));
            part_of_a_row(&in_proportion, at[0] % height, at[1], 3);
            part_of_a_row(&density.logarithmic(full), at[0] % height, at[1], 3);
        }
        assert_eq!(density.linear(0).row(u32::MAX, 0..9).count(), 0);
        true
    });
}

#[test]
fn tables_of_any_weights() {
    fuzz((vec(any::<u32>(), 0..300), any::<[u32; 8]>()), 75, |(weights, draws)| {
        let Ok(table) = Alias::<256>::new(&weights) else { return false };
        let edges = [0, 1, u32::MAX, u32::MAX - 1, 1 << 31];
        for word in draws.into_iter().chain(edges) {
            let item = table.pick(word);
            assert!(weights[item] > 0, "item {item} of weight 0");
        }
        true
    });
}

#[test]
fn systems_of_any_maps() {
    let wild = (vec(word(), 4), vec(word(), 2));
    let tame = (vec(-(1 << 29)..=1 << 29, 4), vec(-(20 << 24)..=20 << 24, 2));
    let tidy = (vec(tame, 1..=5), Just(true));
    let any = (vec(wild, 0..=5), any::<bool>());
    let description = prop_oneof![1 => any, 2 => tidy];
    fuzz((description, vec(word(), 5), vec(point(), 4)), 50, |((maps, share), weights, points)| {
        let maps: Vec<Affine> = maps
            .iter()
            .map(|(l, t)| {
                let linear = [l[0], l[1], l[2], l[3]].map(Unit::from_bits);
                Affine::new(linear, [t[0], t[1]].map(Real::from_bits))
            })
            .collect();
        for map in &maps {
            for p in &points {
                map.apply(*p);
            }
            let (factor, _) = (map.contraction_factor(), map.determinant());
            assert!(!map.is_contraction() || factor <= 1);
            map.fixed_point();
            for first in &maps {
                map.after(first);
            }
        }
        let probabilities: Vec<Unit> = if share {
            let part = (1 << 30) / maps.len().max(1) as i32;
            maps.iter().map(|_| Unit::from_bits(part)).collect()
        } else {
            weights.iter().map(|w| Unit::from_bits(*w)).collect()
        };
        let words: Vec<u32> = weights.iter().map(|w| w.unsigned_abs()).collect();
        if let Ok(alias) = Alias::<4>::new(words.get(..4).unwrap_or_default()) {
            assert!(!alias.is_empty() && words.iter().all(|w| alias.pick(*w) < alias.len()));
        }
        let proportional = Ifs::<5>::proportional_to_determinant(&maps);
        for system in [Ifs::<5>::new(&maps, &probabilities), proportional.clone()].into_iter().flatten() {
            let bounds = system.bounds();
            assert!(system.seeded_chaos_game(7).take(300).all(|p| lies_in(p, bounds)));
            assert!(
                system.contraction_factor() < 1 && system.deviation() > 0 && system.deviation() <= 1 << 30
            );
            assert_eq!(system.probabilities().len(), system.maps().len());
            play(&system, &points);
        }
        proportional.is_ok()
    });
}

/// Coefficients of any size become the nearest that there are; nothing at all is refused.
#[test]
fn maps_of_any_numbers() {
    let numbers = vec(word(), 6).prop_map(|v| [v[0], v[1], v[2], v[3], v[4], v[5]]);
    fuzz((numbers, word(), point()), 99, |(numbers, denominator, p)| {
        let by = denominator.max(1);
        let maps = [
            Affine::from_ratios(numbers, denominator),
            Affine::from_thousandths(numbers),
            Affine::from_millionths(numbers),
        ];
        for (map, by) in maps.iter().zip([by, 1000, 1_000_000]) {
            let exact = |k: usize, bits: u32, end: f64| {
                (f64::from(numbers[k]) / f64::from(by)).clamp(-end, end - 2_f64.powi(-(bits as i32)))
            };
            for (k, entry) in [map.a, map.b, map.c, map.d].into_iter().enumerate() {
                assert!(
                    (entry.to_num::<f64>() - exact(k, 30, 2.0)).abs() <= 2_f64.powi(-31),
                    "{numbers:?} / {by}"
                );
            }
            for (k, entry) in [map.e, map.f].into_iter().enumerate() {
                assert!(
                    (entry.to_num::<f64>() - exact(k + 4, 24, 128.0)).abs() <= 2_f64.powi(-25),
                    "{numbers:?} / {by}"
                );
            }
            map.apply(p);
        }
        true
    });
    assert!(Ifs::<0>::new(&[], &[]).is_err() && Ifs::<0>::proportional_to_determinant(&[]).is_err());
    assert!(
        Alias::<0>::new(&[]).is_err() && Alias::<0>::new(&[1]).is_err() && Alias::<2>::new(&[0, 0]).is_err()
    );
    for attractor in catalogue::ALL {
        let ifs = attractor.ifs::<16>().expect("the catalogue is right");
        assert!(attractor.ifs::<1>().is_err() && attractor.ifs::<0>().is_err());
        assert!(
            ifs.copier::<0>(&[Point2::default()], 0)
                .expect("the shape itself")
                .points()
                .eq([Point2::default()])
        );
        assert!(ifs.copier::<0>(&[Point2::default()], 1).is_err() && ifs.copier::<3>(&[], 1).is_err());
        assert_eq!(catalogue::find(attractor.name), Some(*attractor));
    }
}
