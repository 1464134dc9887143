//! Textures of any numbers at any points.

use attractor::num::{Angle, Lumen, Real, Rgb, Unit, Vec3};
use attractor::plane::{Bounds2, Field, Point2, Window};
use attractor::trace::material::{Material, Mixture};
use attractor::trace::texture::{
    Beyond, Bump, Bumpy, Checker, Facets, Framed, Grain, Image, Lattice, Lookup, Mapped, Marble, Mottle,
    Noise, Pasted, Relief, Rough, Slice, Spline, Texels, Texture, Turbulence, Wood, bumped_normal, turned,
};
use attractor::trace::{Chart, Panorama, Sky, SurfacePoint, Surroundings, Tiles};
use embedded_graphics::geometry::Size;
use proptest::prelude::*;

use super::{fuzz, real, unit, vector, word};

fn light() -> impl Strategy<Value = Rgb> {
    let part = || prop_oneof![Just(0), 0..=1_u32 << 16, any::<u32>()].prop_map(Lumen::from_bits);
    (part(), part(), part()).prop_map(|(r, g, b)| Rgb::new(r, g, b))
}

/// Mostly no brighter than a spline takes.
fn dim((light, other): (Rgb, Rgb)) -> Rgb {
    let part = |part: Lumen| Lumen::from_bits(part.to_bits() >> 10);
    if other.g == Lumen::MAX { light } else { Rgb::new(part(light.r), part(light.g), part(light.b)) }
}

fn direction() -> impl Strategy<Value = Vec3<Unit>> {
    vector(real()).prop_map(|v| v.normalised().unwrap_or(Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE)))
}

fn point() -> impl Strategy<Value = SurfacePoint> {
    let chart = (real(), real(), vector(real()), vector(real())).prop_map(|(u, v, along_u, along_v)| Chart {
        u,
        v,
        along_u,
        along_v,
    });
    (vector(real()), vector(real()), direction(), chart, real()).prop_map(
        |(position, place, normal, chart, width)| SurfacePoint {
            position,
            place,
            normal,
            inward: normal.x > 0,
            chart,
            face: 0,
            width,
        },
    )
}

/// Whether a vector is about as long as 1.
fn is_unit(v: Vec3<Unit>) -> bool {
    let square: f64 = [v.x, v.y, v.z].map(|c| c.to_num::<f64>().powi(2)).iter().sum();
    (square - 1.0).abs() < 1e-6
}

#[test]
fn solid_textures_of_anything() {
    let numbers = (any::<u32>(), real(), 0..20_u8, [real(), real(), real()], unit(), [light(), light()]);
    let place = prop_oneof![9 => (-(1 << 30)..=1 << 30).prop_map(Unit::from_bits), 1 => unit()];
    let knots =
        proptest::collection::vec((place, (light(), light()).prop_map(dim)), 0..7).prop_map(|mut knots| {
            knots.sort_by_key(|knot| knot.0);
            knots
        });
    fuzz((numbers, knots, point()), 10, |((seed, frequency, octaves, three, soft, colors), knots, point)| {
        let noise = Noise::new(seed);
        let [x, y, z] = three.map(|c| Lattice::from_bits(c.to_bits()));
        assert!(noise.at(Vec3::new(x, y, z)).abs() < 1.04 && noise.keys() == Noise::new(seed).keys());
        let checker = Checker::cubes(three, colors[0], colors[1]);
        assert_eq!(checker.at(&point), colors[usize::from(checker.is_odd(&point))]);
        let _ = Checker::squares([frequency, three[0]], checker, Rgb::WHITE).at(&point);
        let Ok(turbulence) = Turbulence::new(noise, frequency, octaves) else { return false };
        assert!(turbulence.at(point.place).abs() < 1.04);
        let wood = Wood {
            colors,
            rings: frequency,
            tilt: [three[0], three[1]],
            wobble: three[2],
            lobes: octaves,
            twist: frequency,
            rough: Some((turbulence, three[0])),
            soft,
        };
        let _ = (wood.radius(point.place), wood.at(&point));
        let Ok(undulate) = Spline::<6>::new(&knots) else { return false };
        let brightest = knots.iter().map(|knot| knot.1.brightest()).max().unwrap_or_default();
        assert!(undulate.at(soft).brightest() <= brightest + Lumen::DELTA);
        let marble = Marble { undulate, turbulence, amplitude: three[0], frequency: three[1] };
        assert!(marble.vein(point.place).abs() <= Unit::ONE + Unit::DELTA * 4);
        let _ = (marble.at(&point), Mottle { undulate, turbulence }.at(&point));
        true
    });
}

#[test]
fn images_of_anything() {
    let texels = prop::sample::select(vec![Texels::Grey, Texels::Linear, Texels::Rgb888, Texels::Rgb565]);
    let sides = (1..40_u32, 1..40_u32, 0..9_u32);
    let ways = (
        prop::sample::select(vec![Lookup::Nearest, Lookup::Bilinear, Lookup::Area]),
        prop::sample::select(vec![Beyond::Repeat, Beyond::Edge]),
        prop::sample::select(vec![Beyond::Repeat, Beyond::Edge]),
    );
    let map = [[real(), real(), real()], [real(), real(), real()]];
    let scene = (texels, sides, ways, map, any::<u8>(), any::<i8>());
    fuzz((scene, point(), real(), unit(), direction()), 30, |(scene, point, height, width, direction)| {
        let (texels, (columns, rows, levels), (lookup, across, up), map, byte, times) = scene;
        let levels = levels.min(Image::levels_of(columns, rows)).max(1);
        let mut bytes = vec![byte; Image::length(texels, columns, rows, levels)];
        assert!(bytes.len() >= texels.bytes());
        Image::write_levels(texels, columns, rows, &mut bytes).expect("the length is right");
        let image = Image::new(texels, columns, rows, &bytes).expect("the length is right");
        let image = image.with_lookup(lookup).with_beyond(across, up);
        assert_eq!(image.size(), [columns, rows]);
        // a plain image is plain everywhere
        let plain = image.nearest(Real::ZERO, Real::ZERO);
        assert_eq!(image.at(&point), plain, "{point:?}");
        assert_eq!(image.mean(point.chart.u, point.chart.v, height, point.width), plain);
        let panorama = Panorama::new(image);
        assert_eq!(panorama.light(direction, width), plain);
        assert_eq!(Relief { image, height }.slopes(&point), [Real::ZERO; 2]);
        let _ = image.turn(&point);
        let Ok(mapped) = Mapped::new(image, map) else { return false };
        assert_eq!((mapped.at(&point), mapped.inner(), mapped.rows()), (plain, &image, &map));
        let _ = mapped.point(&point);
        Mapped::repeated(Relief { image, height }, times, 1)
            .is_ok_and(|relief| relief.slopes(&point).len() == 2)
    });
}

#[test]
fn frames_and_patterns_of_anything() {
    let corners = proptest::collection::vec([real(), real()], 0..5);
    let numbers = (any::<u32>(), real(), [real(), real()], unit(), word());
    fuzz((corners, numbers, point(), direction()), 95, |(corners, numbers, point, direction)| {
        let (seed, height, pair, tilt, angle) = numbers;
        let material = Mixture::matt(Rgb::WHITE);
        assert!(is_unit(bumped_normal(&point, pair)));
        let turbulence = Turbulence::new(Noise::new(seed), height, 3).expect("three octaves");
        let rough = Bumpy { material, bump: Rough { turbulence, height } };
        let faceted = Bumpy { material, bump: Facets { cells: pair, tilt, seed } };
        assert!(is_unit(rough.normal(&point)) && is_unit(faceted.normal(&point)));
        let _ = turned(&point, Angle::from_bits(angle as u32));
        let framed = Framed { material, grain: (turbulence, tilt) };
        let _ = framed.respond(&point, direction, core::iter::empty());
        if let Ok(pasted) = Pasted::new(material, &corners, material) {
            let _ = (pasted.covers(&point), pasted.respond(&point, direction, core::iter::empty()));
        }
        let sky = Sky { zenith: Rgb::WHITE, horizon: Rgb::WHITE, nadir: Rgb::WHITE };
        let white = [Rgb::WHITE; 2];
        let tiles = Tiles { ceiling: white, floor: white, horizon: Rgb::WHITE, scale: height, fade: tilt };
        for surroundings in [sky.light(direction, tilt), tiles.light(direction, tilt)] {
            assert!(surroundings.g.to_bits().abs_diff(1 << 16) <= 1);
        }
        true
    });
}

#[test]
fn slices_of_anything() {
    let corner = || (real(), real()).prop_map(|(x, y)| Point2::new(x, y));
    fuzz((corner(), corner(), 1..300_u32, 1..300_u32, real()), 20, |(min, max, width, height, z)| {
        let Ok(window) = Window::stretch(Bounds2 { min, max }, Size::new(width, height)) else {
            return false;
        };
        let slice =
            Slice::new(Checker::cubes([z; 3], Rgb::WHITE, Rgb::BLACK), window, z).at_height(Real::ZERO);
        let last = slice.point(width - 1, height - 1).place;
        assert!(last.x >= min.x && last.x <= max.x && last.y >= min.y && last.y <= max.y);
        slice.row(height - 1, 0..width).len() == slice.size().width as usize
    });
}
