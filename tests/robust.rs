//! Whatever the description: core refuses it or computes with it, and neither panics nor overflows.
//!
//! The tests run with overflow checks (the profile `test`, which is optimised). Each generator mixes numbers from all bits, the ends of the format and
//! ordinary ones; each test asserts how much was accepted, so that it has evaluated something. `PROPTEST_CASES` sets how many descriptions are tried.

mod curves;
mod deep;
mod numbers;
mod systems;

use std::cell::Cell as Counter;

use attractor::draw::Stroke;
use attractor::escape::{Julia, Mandelbrot, View};
use attractor::fif::{Cell, Factor, Fif, Knot, Pyramid, Surface};
use attractor::ifs::{Affine, Ifs};
use attractor::num::Complex;
use attractor::num::{Alias, Angle, Real, Scaling, Unit, Vec3, Wide};
use attractor::plane::{Bounds2, Field, PathElement, Point2, Window};
use attractor::rand_xoshiro::Xoshiro128PlusPlus;
use attractor::rand_xoshiro::rand_core::SeedableRng;
use attractor::trace::{
    Camera, Environment, Filter, HeightField, Light, Material, Ray, RayCaster, Sampling, Statistics,
};
use embedded_graphics::geometry::{Dimensions, Point, Size};
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::{DrawTarget, Drawable, Pixel};
use embedded_graphics::primitives::Rectangle;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};

/// Tries descriptions; `check` says whether one was accepted, `percent` of them must be.
fn fuzz<S: Strategy>(strategy: S, percent: u32, check: impl Fn(S::Value) -> bool) {
    // the same descriptions on every run, unless PROPTEST_RNG_SEED says otherwise
    let default = ProptestConfig::default();
    let rng_seed = match default.rng_seed {
        RngSeed::Random => RngSeed::Fixed(8),
        given => given,
    };
    let config = ProptestConfig { failure_persistence: None, rng_seed, ..default };
    let (tried, accepted) = (Counter::new(0_u32), Counter::new(0_u32));
    let result = TestRunner::new(config).run(&strategy, |description| {
        tried.set(tried.get() + 1);
        accepted.set(accepted.get() + u32::from(check(description)));
        Ok(())
    });
    if let Err(error) = result {
        panic!("{error}");
    }
    let share = 100 * accepted.get() / tried.get().max(1);
    println!("{} of {} accepted", accepted.get(), tried.get());
    assert!(share >= percent, "only {share} % accepted");
}

/// All bits, ends, and numbers of a few bits.
fn word() -> impl Strategy<Value = i32> {
    let edges = prop::sample::select(vec![0, 1, -1, i32::MAX, i32::MIN, i32::MIN + 1, 1 << 30, -(1 << 30)]);
    prop_oneof![any::<i32>(), edges, (-1000..1000_i32, 0..20_u32).prop_map(|(v, s)| v << s)]
}

fn wide() -> impl Strategy<Value = Wide> {
    let edges = prop::sample::select(vec![0, 1, -1, i64::MAX, i64::MIN, i64::MIN + 1, 1 << 48, -(1 << 48)]);
    let bits = prop_oneof![any::<i64>(), edges, (-1000..1000_i64, 0..54_u32).prop_map(|(v, s)| v << s)];
    bits.prop_map(Wide::from_bits)
}

fn real() -> impl Strategy<Value = Real> {
    word().prop_map(Real::from_bits)
}

fn unit() -> impl Strategy<Value = Unit> {
    prop_oneof![word().prop_map(Unit::from_bits), (0..=1 << 30).prop_map(Unit::from_bits)]
}

fn vector(component: impl Strategy<Value = Real>) -> impl Strategy<Value = Vec3> {
    vec(component, 3).prop_map(|v| Vec3::new(v[0], v[1], v[2]))
}

/// A real inside ±`limit`.
fn inside(limit: i32) -> impl Strategy<Value = Real> {
    let limit = (limit << 24) - 1;
    prop_oneof![
        (-limit..=limit).prop_map(Real::from_bits),
        (-limit >> 20..=limit >> 20).prop_map(|b| Real::from_bits(b << 20))
    ]
}

fn point() -> impl Strategy<Value = Point2> {
    (real(), real()).prop_map(|(x, y)| Point2::new(x, y))
}

fn complex() -> impl Strategy<Value = Complex<Wide>> {
    let disc = (-3 << 10..3_i64 << 10).prop_map(|b| Wide::from_bits(b << 38));
    let part = || prop_oneof![wide(), disc.clone()];
    (part(), part()).prop_map(|(re, im)| Complex::new(re, im))
}

fn size() -> impl Strategy<Value = Size> {
    let side = || prop_oneof![6 => 1..=400_u32, 2 => 1..=3_u32, 1 => Just(1 << 14), 1 => any::<u32>()];
    (side(), side()).prop_map(|(w, h)| Size::new(w, h))
}

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

/// Mostly acceptable: increasing knots up to ±`reach`, values up to ±`height`, scalings up to 0.9; partly with equal intervals.
fn function(reach: i64, height: i64) -> impl Strategy<Value = (Vec<Knot>, Vec<Scaling>)> {
    let maps = prop_oneof![1..=6_usize, Just(2), Just(4)];
    (maps, any::<bool>(), 0..46_u32).prop_flat_map(move |(n, equal, fine)| {
        let end = reach << 48;
        let place = prop_oneof![-end..=end, Just(-end), Just(end), (-end >> fine..=end >> fine)];
        let y = (-height << 48..=height << 48).prop_map(Wide::from_bits);
        let scaling = (-1_932_735_283..=1_932_735_283).prop_map(Scaling::from_bits);
        (vec(place, n + 1), vec(y, n + 1), vec(scaling, n)).prop_map(move |(mut xs, ys, scaling)| {
            xs.sort_unstable();
            if equal {
                xs = (0..=n as i64).map(|i| i << (48 - fine)).collect();
            }
            (xs.iter().zip(ys).map(|(x, y)| Knot::new(Wide::from_bits(*x), y)).collect(), scaling)
        })
    })
}

/// Everything that a function can do.
fn exercise<const N: usize, const D: usize>(f: &Fif<N, D>, xs: &[Wide], epsilon: Real) {
    let (low, high) = f.range();
    assert!(low <= high && f.error_bound() > 0);
    assert_eq!(f.knots().count(), f.maps() + 1);
    for x in xs {
        let y = f.at(*x);
        let slack = Wide::from(f.error_bound());
        assert!(Wide::from(low) - slack <= y && y <= Wide::from(high) + slack, "{y} outside {low} to {high}");
        f.at_wide(*x);
        f.at_by_composition(*x, epsilon);
    }
    let rng = Xoshiro128PlusPlus::seed_from_u64(1);
    assert!(f.chaos_game(rng).take(20).all(|p| p.x >= 0 && p.x <= 1));
    assert_eq!(f.graph(5).count(), 6);
    f.graph(u32::MAX).nth(3);
    let composite = f.composite([0, 1, usize::MAX, 0]);
    let (from, to) = composite.interval();
    assert!(from <= to);
    composite.vertical_scaling();
    if let Some(fast) = f.dyadic::<16>() {
        for x in xs {
            fast.at(Angle::from_bits(x.to_bits() as u32));
        }
        fast.error_bound();
    }
}

/// A pyramid's levels for `maps` maps: few enough cells.
fn depth(maps: usize) -> u32 {
    (0..=4).rev().find(|d| Pyramid::cells(maps, *d) <= 1400).unwrap_or(0)
}

#[test]
fn functions_of_any_description() {
    let description = prop_oneof![wild_function(), function(30, 30), function(30_000, 30)];
    fuzz((description, vec(wide(), 8), real()), 25, |((knots, scaling), xs, epsilon)| {
        let Ok(f) = Fif::<6, 1>::interpolating(&knots, &scaling) else { return false };
        // walks get long, and end: a few are taken
        let xs = if f.max_scaling() > 0.995 { [xs[0]; 8].to_vec() } else { xs };
        exercise(&f, &xs, epsilon);
        if let Ok(integral) = f.integral::<3>(xs[0]) {
            exercise(&integral, &xs, epsilon);
            if let Ok(again) = integral.integral::<3>(xs[1]) {
                exercise(&again, &xs, epsilon);
            }
            if let Ok(back) = integral.derivative::<3>() {
                exercise(&back, &xs, epsilon);
            }
        }
        if let Ok(slope) = f.derivative::<1>() {
            exercise(&slope, &xs, epsilon);
        }
        if let Ok(factor) = Factor::<6, 3>::from_slope(&f, xs[2]) {
            let surface = Surface::new(&factor, &factor);
            for pair in xs.windows(4) {
                surface.height(pair[0], pair[1]);
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
    fuzz((function(1, 1), polynomials, vec(wide(), 4)), 20, |((knots, scaling), polynomials, xs)| {
        let places: Vec<Wide> = knots.iter().map(|k| k.x).collect();
        let slices: Vec<&[Wide]> = polynomials.iter().map(Vec::as_slice).collect();
        let _ = Fif::<6, 0>::with_polynomials(&places, &scaling, &slices);
        let _ = Fif::<6, 12>::with_polynomials(&places, &scaling, &slices);
        // one map has nothing to join
        let one = [Wide::ZERO, Wide::from_num(1)];
        let Some((first, alpha)) = slices.first().zip(scaling.first()) else { return false };
        let Ok(f) = Fif::<1, 12>::with_polynomials(&one, &[*alpha], &[first]) else { return false };
        exercise(&f, &xs, Real::DELTA);
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
    fuzz((function(30, 30), vec(wide(), 8)), 30, |((knots, scaling), xs)| {
        let Ok(f) = Fif::<6, 1>::interpolating(&knots, &scaling) else { return false };
        let mut memory = vec![Cell::ZERO; Pyramid::cells(f.maps(), depth(f.maps()))];
        assert!(Pyramid::new(&f, 99, &mut memory).is_err());
        let levels = depth(f.maps());
        let pyramid = Pyramid::new(&f, levels, &mut memory).expect("the memory is long enough");
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
fn systems_of_any_maps() {
    let wild = (vec(word(), 4), vec(word(), 2));
    let tame = (vec(-(1 << 29)..=1 << 29, 4), vec(-(20 << 24)..=20 << 24, 2));
    let tidy = (vec(tame, 1..=5), Just(true));
    let any = (vec(wild, 0..=5), any::<bool>());
    let description = prop_oneof![1 => any, 2 => tidy];
    fuzz((description, vec(word(), 5), vec(point(), 4)), 30, |((maps, share), weights, points)| {
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
            assert!(words.iter().all(|w| alias.pick(*w) < alias.len()));
        }
        let proportional = Ifs::<5>::proportional_to_determinant(&maps);
        for system in [Ifs::<5>::new(&maps, &probabilities), proportional.clone()].into_iter().flatten() {
            let bounds = system.bounds();
            for p in system.seeded_chaos_game(7).take(300) {
                assert!(bounds.min.x <= p.x && p.x <= bounds.max.x, "{p:?} outside {bounds:?}");
                assert!(bounds.min.y <= p.y && p.y <= bounds.max.y, "{p:?} outside {bounds:?}");
            }
        }
        proportional.is_ok()
    });
}

/// Some of a row, wherever it begins; the row need not exist.
fn part_of_a_row<F: Field>(picture: &F, y: u32, x: u32, skip: usize) -> usize {
    let Size { width, height } = picture.size();
    let (x, y) = (x % width, y % height);
    let mut row = picture.row(y, x..width.min(x.saturating_add(48)));
    let _ = row.nth(skip);
    row.count()
}

#[test]
fn escape_times_of_any_view() {
    let width = prop_oneof![wide(), (1_i64 << 40..1 << 51).prop_map(Wide::from_bits)];
    let dwell = prop_oneof![4 => 0..300_u32, 1 => any::<u32>()];
    let description = (complex(), width, size(), dwell, complex());
    fuzz((description, any::<[u32; 3]>(), complex()), 20, |((centre, width, size, dwell, c), at, place)| {
        let _ = View::home(size).map(|home| home.pitch());
        let Ok(view) = View::new(centre, width, size) else { return false };
        view.point(at[0], at[1]);
        view.point(u32::MAX, u32::MAX);
        let steps = dwell.min(2000);
        let skip = (at[2] % 64) as usize;
        let Ok(set) = Mandelbrot::new(view, dwell).and(Mandelbrot::new(view, steps)) else { return false };
        part_of_a_row(&set, at[0], at[1], skip);
        assert!(set.dwell_at(place).count <= steps);
        assert!(set.row(at[0], at[1]..at[2]).count() <= 1 << 14);
        if let Ok(set) = Julia::new(view, c, steps) {
            part_of_a_row(&set, at[0], at[1], skip);
            assert!(set.dwell_at(place).count <= steps);
        }
        true
    });
}

/// A target whose box may lie anywhere, and which accepts no pixel outside it.
struct Target(Rectangle, u32);

impl Dimensions for Target {
    fn bounding_box(&self) -> Rectangle {
        self.0
    }
}

impl DrawTarget for Target {
    type Color = BinaryColor;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(
        &mut self,
        pixels: I,
    ) -> Result<(), Self::Error> {
        let inside = |p: i32, start: i32, length: u32| {
            let distance = i64::from(p) - i64::from(start);
            (0..i64::from(length)).contains(&distance)
        };
        for Pixel(p, _) in pixels {
            let Rectangle { top_left, size } = self.0;
            assert!(inside(p.x, top_left.x, size.width) && inside(p.y, top_left.y, size.height), "{p}");
            self.1 += 1;
        }
        Ok(())
    }
}

#[test]
fn windows_and_strokes_anywhere() {
    let corner = || (word(), word()).prop_map(|(x, y)| Point::new(x, y));
    let near = || (-300..300, -300..300).prop_map(|(x, y)| Point::new(x, y));
    let place = || prop_oneof![corner(), near()];
    let target = (place(), size()).prop_map(|(top_left, size)| Rectangle::new(top_left, size));
    let steps = vec((point(), any::<bool>()), 0..12);
    let description = (point(), point(), size(), any::<bool>());
    fuzz((description, steps, place(), target), 20, |((a, b, size, tidy), steps, at, target)| {
        let mut bounds = Bounds2 { min: a, max: b };
        if tidy {
            bounds.min = Point2::new(a.x.min(b.x), a.y.min(b.y));
            bounds.max = Point2::new(a.x.max(b.x), a.y.max(b.y));
        }
        let windows = [Window::stretch(bounds, size), Window::fit(bounds, size)];
        let accepted = windows[0].is_ok();
        assert!(windows[1].is_ok() || !accepted, "what can be stretched can be fitted");
        for window in windows.into_iter().flatten() {
            for (p, _) in &steps {
                let (column, row) = window.raster(*p);
                assert!(column.abs() <= 1 << 47 && row.abs() <= 1 << 47);
                if let Some(pixel) = window.pixel(*p) {
                    assert_eq!((i64::from(pixel.x), i64::from(pixel.y)), (column, row));
                    assert!(Rectangle::new(Point::zero(), window.size()).contains_pixel(pixel));
                }
            }
            let path = steps
                .iter()
                .map(|(p, pen)| if *pen { PathElement::LineTo(*p) } else { PathElement::MoveTo(*p) });
            let mut target = Target(target, 0);
            let Ok(drawn) = Stroke::new(path, window, BinaryColor::On).at(at).draw(&mut target);
            assert_eq!(drawn, target.1);
        }
        accepted
    });
}

trait ContainsPixel {
    fn contains_pixel(&self, p: Point) -> bool;
}

impl ContainsPixel for Rectangle {
    fn contains_pixel(&self, p: Point) -> bool {
        embedded_graphics::primitives::ContainsPoint::contains(self, p)
    }
}

/// An eye, a point to look at, up, degrees.
fn camera() -> impl Strategy<Value = (Vec3, Vec3, Vec3, Real)> {
    let up = prop_oneof![9 => Just(Vec3::new(Real::ZERO, Real::ZERO, Real::ONE)), 1 => vector(real())];
    let degrees = prop_oneof![9 => (1 << 24..=120 << 24).prop_map(Real::from_bits), 1 => real()];
    let eye = prop_oneof![4 => vector(inside(64)), 4 => vector(inside(4)), 1 => vector(real())];
    let look_at = prop_oneof![1 => vector(inside(3)), 1 => vector(real())];
    (eye, look_at, up, degrees)
}

fn shading() -> impl Strategy<Value = (Material, Environment, Sampling, Filter)> {
    let material = prop_oneof![
        Just(Material::Mirror),
        unit().prop_map(|ambient| Material::Diffuse { ambient }),
        (unit(), unit(), unit(), any::<u16>()).prop_map(|(ambient, diffuse, specular, shininess)| {
            Material::Phong { ambient, diffuse, specular, shininess }
        }),
    ];
    let scale = prop_oneof![real(), (1 << 18..=64 << 24).prop_map(Real::from_bits)];
    let environment = prop_oneof![
        unit().prop_map(Environment::Plain),
        (unit(), unit(), unit()).prop_map(|(zenith, horizon, nadir)| Environment::Gradient {
            zenith,
            horizon,
            nadir
        }),
        (unit(), unit(), unit(), scale, unit()).prop_map(|(bright, dark, horizon, scale, fade)| {
            Environment::Checkerboard { bright, dark, horizon, scale, fade }
        }),
    ];
    let sampling = prop_oneof![
        Just(Sampling::Centre),
        (0..=9_u8).prop_map(Sampling::Grid),
        (1..=8_u8, any::<u32>()).prop_map(|(n, seed)| Sampling::Jittered { n, seed }),
    ];
    let side = || prop_oneof![real(), (1 << 21..=4 << 24).prop_map(Real::from_bits)];
    let filter = prop_oneof![
        Just(Filter::Box),
        (side(), side()).prop_map(|(deviation, width)| Filter::Gaussian { deviation, width }),
    ];
    (material, environment, sampling, filter)
}

#[test]
fn pictures_from_any_camera() {
    let surface = (function(64, 9), function(3, 1));
    let view = (camera(), size(), shading(), vector(real()), any::<[u32; 3]>());
    fuzz((surface, view), 10, |((x, y), ((eye, look_at, up, degrees), size, shading, light, at))| {
        let cameras = Camera::new(eye, look_at, up, degrees);
        let Ok(camera) = cameras else { return false };
        let functions = [x, y].map(|(knots, scaling)| Fif::<6, 1>::interpolating(&knots, &scaling));
        let [Ok(x), Ok(y)] = functions else { return false };
        let levels = depth(x.maps()).min(depth(y.maps()));
        let (mut first, mut second) = (vec![Cell::ZERO; 1600], vec![Cell::ZERO; 1600]);
        let px = Pyramid::new(&x, levels, &mut first).expect("room for a pyramid");
        let py = Pyramid::new(&y, levels, &mut second).expect("room for a pyramid");
        let Ok(surface) = HeightField::new(&px, &py) else { return false };
        // rays in any direction, wherever they begin
        let mut statistics = Statistics::default();
        for footprint in [Unit::ZERO, Unit::MIN, Unit::MAX, Unit::from_bits(1 << 22)] {
            let hit = surface.intersect_counted(&Ray::new(eye, light), footprint, &mut statistics);
            let _ = hit.map(|h| h.normal());
            surface.intersect(&Ray::new(light, eye), footprint);
        }
        assert!(statistics.stack <= surface.depth(), "{statistics:?}");
        let Ok(mut picture) = RayCaster::new(surface, camera, size) else { return false };
        let (material, environment, sampling, filter) = shading;
        picture = picture.clone().with_material(material).unwrap_or(picture);
        picture = picture.clone().with_environment(environment).unwrap_or(picture);
        picture = picture.clone().with_sampling(sampling, filter).unwrap_or(picture);
        if let Ok(light) = Light::new(light) {
            picture = picture.with_light(light);
        }
        part_of_a_row(&picture, at[0], at[1], (at[2] % 64) as usize);
        for y in [0, size.height / 2, size.height - 1] {
            part_of_a_row(&picture, y, 0, 0);
            part_of_a_row(&picture, y, size.width.saturating_sub(48), 0);
        }
        let hit = picture.hit(at[0] % size.width, at[1] % size.height);
        assert!(hit.is_none_or(|h| h.level <= levels && h.t >= 0));
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
    let f = Fif::<1, 14>::with_polynomials(&places, &[Scaling::ZERO], &[&q]).expect("a polynomial");
    let (low, high) = f.range();
    let least = (0..=1000).map(|i| f.at(Wide::from_num(i) / 1000)).min().expect("values");
    assert!(
        low <= least && least < -0.02 && low > -1 && (0.5..1.1).contains(&high.to_num::<f64>()),
        "{low} {least} {high}"
    );
}
