//! Height fields from any camera, in any light, with any samples.

use attractor::fif::{Cell, Fif, Pyramid, Sum, Sums};
use attractor::num::{Real, Unit, Vec3};
use attractor::plane::Field;
use attractor::trace::{
    Camera, Environment, Filter, FilteredCaster, Finish, Found, HeightField, Light, Quality, Ray, RayCaster,
    Sampling, Statistics, meets,
};
use embedded_graphics::geometry::Size;
use proptest::prelude::*;

use super::functions::{depth, function};
use super::{fuzz, inside, part_of_a_row, real, size, unit, vector};

/// An eye, a point to look at, up, degrees.
fn camera() -> impl Strategy<Value = (Vec3, Vec3, Vec3, Real)> {
    let up = prop_oneof![9 => Just(Vec3::new(Real::ZERO, Real::ZERO, Real::ONE)), 1 => vector(real())];
    let degrees = prop_oneof![9 => (1 << 24..=120 << 24).prop_map(Real::from_bits), 1 => real()];
    let eye = prop_oneof![4 => vector(inside(64)), 4 => vector(inside(4)), 1 => vector(real())];
    let look_at = prop_oneof![1 => vector(inside(3)), 1 => vector(real())];
    (eye, look_at, up, degrees)
}

fn shading() -> impl Strategy<Value = (Finish, Environment, Sampling, Filter)> {
    let material = prop_oneof![
        Just(Finish::Mirror),
        unit().prop_map(|ambient| Finish::Diffuse { ambient }),
        (unit(), unit(), unit(), any::<u16>()).prop_map(|(ambient, diffuse, specular, shininess)| {
            Finish::Phong { ambient, diffuse, specular, shininess }
        }),
        (unit(), unit(), unit(), unit(), unit()).prop_map(
            |(ambient, diffuse, specular, roughness, reflectance)| {
                Finish::TorranceSparrow { ambient, diffuse, specular, roughness, reflectance }
            }
        ),
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
    fuzz((surface, view), 20, |((x, y), ((eye, look_at, up, degrees), size, shading, light, at))| {
        let cameras = Camera::new(eye, look_at, up, degrees);
        let Ok(camera) = cameras else { return false };
        let functions = [x, y].map(|(knots, scaling)| Fif::<6, 1>::interpolating(&knots, &scaling));
        let [Ok(x), Ok(y)] = functions else { return false };
        let levels = depth(x.maps()).min(depth(y.maps()));
        let (mut first, mut second) = (vec![Cell::ZERO; 1600], vec![Cell::ZERO; 1600]);
        let px = Pyramid::new(&x, levels, &mut first).expect("room for a pyramid");
        let py = Pyramid::new(&y, levels, &mut second).expect("room for a pyramid");
        let Ok(surface) = HeightField::new(&px, &py) else { return false };
        let (low, high) = surface.heights();
        assert!(low <= high && surface.depth() <= levels);
        // rays in any direction, wherever they begin
        let mut statistics = Statistics::default();
        for footprint in [Unit::ZERO, Unit::MIN, Unit::MAX, Unit::from_bits(1 << 22)] {
            let hit = surface.intersect_counted(&Ray::new(eye, light), footprint, &mut statistics);
            let _ = hit.map(|h| h.normal());
            surface.intersect(&Ray::new(light, eye), footprint);
        }
        assert!(statistics.stack <= surface.depth(), "{statistics:?}");
        // four rays, each no more than all the nodes there are
        let nodes: u64 =
            (0..=levels).map(|level| (px.level(level).len() * py.level(level).len()) as u64).sum();
        assert!(statistics.rays == 4 && statistics.box_tests <= 4 * nodes, "{statistics:?} of {nodes} nodes");
        let Ok(mut picture) = RayCaster::new(surface, camera, size) else { return false };
        let (material, environment, sampling, filter) = shading;
        picture = picture.clone().with_finish(material).unwrap_or(picture);
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
        // the same, filtered, where the factors have slopes
        let (mut third, mut fourth) = (vec![Sum::ZERO; 1600], vec![Sum::ZERO; 1600]);
        if let (Ok(mx), Ok(my)) =
            (Sums::new(&x, px.depth(), &mut third), Sums::new(&y, py.depth(), &mut fourth))
        {
            let quality = [Quality::Coarse, Quality::Fine, Quality::Finest][at[0] as usize % 3];
            let filtered = FilteredCaster::new(picture.clone(), &mx, &my, quality).expect("its own sums");
            part_of_a_row(&filtered, at[0], at[1], (at[2] % 64) as usize);
            part_of_a_row(&filtered, size.height / 2, size.width.saturating_sub(99) / 2, 0);
            let found = filtered.found(at[0] % size.width, at[1] % size.height);
            assert!(found != Found::Filtered || filtered.caster().size() == size);
        }
        let hit = picture.hit(at[0] % size.width, at[1] % size.height);
        assert!(hit.is_none_or(|h| h.level <= levels && h.t >= 0));
        // a picture of a few pixels, counted
        let Ok(small) = RayCaster::new(surface, camera, Size::new(size.width % 5 + 1, size.height % 5 + 1))
        else {
            return true;
        };
        let small = small.clone().with_sampling(sampling, filter).unwrap_or(small);
        let statistics = small.statistics();
        let pixels = u64::from(small.size().width * small.size().height);
        assert!((pixels..=64 * pixels).contains(&statistics.rays), "{statistics:?} of {pixels} pixels");
        assert!(
            statistics.stack <= levels && statistics.box_tests <= nodes * statistics.rays,
            "{statistics:?}"
        );
        true
    });
}

/// Tones in every direction, of what no scene accepts as well, are between black and white.
#[test]
fn tones_of_any_direction() {
    let direction = || (unit(), unit(), unit()).prop_map(|(x, y, z)| Vec3::new(x, y, z));
    let light = prop_oneof![9 => vector(real()), 1 => Just(Vec3::default())];
    fuzz((shading(), direction(), direction(), light), 80, |((material, environment, _, _), n, d, light)| {
        let within = |tone: Unit| {
            assert!((Unit::ZERO..=Unit::ONE).contains(&tone), "{tone} of {material:?} under {environment:?}")
        };
        let Ok(light) = Light::new(light) else { return false };
        within(environment.tone(d));
        within(material.tone(n, d, &light, &environment));
        for ends in [Unit::MIN, Unit::MAX] {
            let (scale, fade) = (Real::from_bits(ends.to_bits()), ends);
            let checkers = Environment::Checkerboard {
                bright: ends,
                dark: ends.wrapping_neg(),
                horizon: Unit::ZERO,
                scale,
                fade,
            };
            within(checkers.tone(Vec3::new(n.x, ends, d.z)));
            let sky = Environment::Gradient { zenith: ends, horizon: Unit::MAX, nadir: Unit::MIN };
            within(sky.tone(Vec3::new(ends, ends, d.z)));
            within(Finish::Mirror.tone(Vec3::new(ends, ends, ends), d, &light, &sky));
            let extreme = Vec3::new(Unit::MIN, Unit::MIN, Unit::MIN);
            within(
                Finish::Phong { ambient: ends, diffuse: ends, specular: ends, shininess: u16::MAX }
                    .tone(extreme, extreme, &light, &sky),
            );
            within(Finish::Diffuse { ambient: ends }.tone(extreme, d, &light, &sky));
            let [roughness, reflectance] = [ends; 2];
            let (ambient, diffuse, specular) = (ends, ends, ends);
            let sheen = Finish::TorranceSparrow { ambient, diffuse, specular, roughness, reflectance };
            within(sheen.tone(extreme, extreme, &light, &sky));
            within(sheen.tone(n, d, &light, &sky));
        }
        true
    });
}

#[test]
fn boxes_of_any_cells() {
    let cell =
        || vector(real()).prop_map(|v| Cell { min: v.x.min(v.y), max: v.x.max(v.y), mean: v.z, slope: v.x });
    fuzz((cell(), cell(), real(), real()), 99, |(f, g, from, to)| {
        let met = meets(&f, &g, from, to);
        for ends in
            [[Real::MAX, Real::ONE], [Real::MIN, -Real::ONE], [Real::MAX, Real::MAX], [Real::MIN, Real::MAX]]
        {
            let [f, g] =
                ends.map(|end| Cell { min: end.min(Real::ZERO), max: end.max(Real::ZERO), ..Cell::ZERO });
            let _ = [meets(&f, &g, from, to), meets(&g, &f, to, Real::MAX), meets(&f, &f, Real::MIN, to)];
        }
        // where products fit, what lies in the box meets it
        let ends = [f.min, f.max].map(Real::to_num::<f64>);
        let products = [g.min, g.max].map(Real::to_num::<f64>).map(|v| ends.map(|u| u * v));
        let (low, high) =
            products.concat().iter().fold((f64::MAX, f64::MIN), |(l, h), p| (l.min(*p), h.max(*p)));
        let (near, far) = (from.min(to).to_num::<f64>(), from.max(to).to_num::<f64>());
        if low > -64.0 && high < 64.0 {
            assert!(met || near > high || far < low, "{f:?} {g:?}: {from} to {to}");
            assert!(!met || (near <= high + 2e-7 && far >= low - 2e-7), "{f:?} {g:?}: {from} to {to}");
        }
        true
    });
}

/// Floats of any bits, what is no number among them: refused, or a camera.
#[test]
fn orbits_of_any_floats() {
    let edges = [0.0, -0.0, 1.0, 60.0, 127.99, -128.0, 1e9, -1e30, f32::MAX, f32::MIN, f32::MIN_POSITIVE];
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    let any_float = || {
        let edges = prop::sample::select(edges.into_iter().chain(odd).collect::<Vec<_>>());
        prop_oneof![12 => -60.0..60.0_f32, 1 => any::<u32>().prop_map(f32::from_bits), 1 => edges]
    };
    let place = (any_float(), any_float(), any_float()).prop_map(|(x, y, z)| [x, y, z].map(|c| c / 2.0));
    let view = prop_oneof![6 => 1.0..120.0_f32, 1 => any_float()];
    fuzz((place, any_float(), any_float(), any_float(), view), 40, |(place, distance, turn, lift, view)| {
        let camera = Camera::orbit(place, distance, turn, lift, view);
        let is_number = place.iter().chain([&distance, &turn, &lift, &view]).all(|v| v.is_finite());
        assert!(is_number || camera.is_err(), "{place:?} {distance} {turn} {lift} {view}");
        camera.is_ok()
    });
}

/// A tone has 16 bits, whatever the samples.
#[test]
fn samples_of_any_pattern() {
    let knots = [(-1.0, 0.0), (0.0, 1.0), (1.0, 0.0)].map(|(x, y)| {
        attractor::fif::Knot::new(attractor::num::Wide::from_num(x), attractor::num::Wide::from_num(y))
    });
    let f = Fif::<2, 1>::interpolating(&knots, &[attractor::num::Scaling::from_num(0.5); 2]).expect("a hill");
    let mut memory = [Cell::ZERO; Pyramid::cells(2, 3)];
    let pyramid = Pyramid::new(&f, 3, &mut memory).expect("room for three levels");
    let surface = HeightField::new(&pyramid, &pyramid).expect("a hill");
    let up = Vec3::lit("0", "0", "1");
    let camera =
        Camera::new(Vec3::lit("-3", "-3", "2"), Vec3::default(), up, Real::from_num(40)).expect("a camera");
    fuzz(
        (shading(), size(), any::<[u32; 2]>()),
        24,
        |((material, environment, sampling, filter), size, at)| {
            let Ok(plain) = RayCaster::new(surface, camera, size) else { return false };
            let white = Environment::Plain(Unit::ONE);
            let lit = plain
                .clone()
                .with_finish(Finish::Mirror)
                .and_then(|p| p.with_environment(white))
                .expect("white");
            let Ok(lit) = lit.with_sampling(sampling, filter) else { return false };
            // the weights add up to 1, but for their last bits
            let Size { width, height } = lit.size();
            let tone = lit.at(at[1] % width, at[0] % height).to_bits();
            assert!(tone >= u16::MAX - 2, "{tone} of white: {sampling:?} {filter:?}");
            let shaded = plain.with_sampling(sampling, filter).and_then(|p| p.with_finish(material));
            let _ = shaded
                .and_then(|p| p.with_environment(environment))
                .map(|p| part_of_a_row(&p, at[0], at[1], 9));
            true
        },
    );
}
