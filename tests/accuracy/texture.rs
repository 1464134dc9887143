//! Textures beside those of the reference.

use attractor::num::{Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::texture::{
    Checker, Image, Lattice, Marble, Noise, Slice, Spline, Texels, Texture, Turbulence, Wood, bumped_normal,
};
use attractor::trace::{Chart, Panorama, SurfacePoint, Surroundings};
use attractor_reference::texture as reference;

use super::{Row, row, two_to, words};

/// Places in space: lattice points, the ends of the format, places of few and of many digits.
fn places(count: usize) -> Vec<[i32; 3]> {
    let mut random = words(41);
    let mut next = || random.next().unwrap_or_default();
    let edges = [0, 1, -1, 1 << 16, (1 << 16) - 1, -(1 << 16), i32::MAX, i32::MIN, 1 << 24, -(3 << 24)];
    let edge = move |w: u64| edges[(w % edges.len() as u64) as usize];
    (0..count)
        .map(|i| {
            core::array::from_fn(|_| match i % 8 {
                0 => edge(next()),
                1 => next() as i32 >> 8,
                _ => next() as i32,
            })
        })
        .collect()
}

fn real(bits: [i32; 3]) -> Vec3 {
    let [x, y, z] = bits.map(Real::from_bits);
    Vec3::new(x, y, z)
}

fn float(bits: [i32; 3], one: f64) -> [f64; 3] {
    bits.map(|c| f64::from(c) / one)
}

/// With 24 fractional bits, the lowest of which are 0: no octave of a whole frequency rounds.
fn round(bits: [i32; 3]) -> [i32; 3] {
    bits.map(|c| c >> 12 << 12)
}

fn point(place: Vec3) -> SurfacePoint {
    let normal = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE);
    let (chart, width) = (Chart::default(), Real::ZERO);
    SurfacePoint { position: place, place, normal, inward: false, chart, face: 0, width }
}

const TURBULENT: (f64, u8, f64) = (3.0, 4, 8.0);

fn turbulence(noise: Noise) -> Turbulence {
    Turbulence::new(noise, Real::from_num(TURBULENT.0), TURBULENT.1).expect("a few octaves")
}

pub(super) fn rows() -> Vec<Row> {
    let seeds = [0, 7, 0xffff_ffff].map(Noise::new);
    let noise = seeds.iter().flat_map(|noise| {
        places(20_000).into_iter().map(|bits| {
            let [x, y, z] = bits.map(Lattice::from_bits);
            noise.at(Vec3::new(x, y, z)).to_num::<f64>()
                - reference::noise(noise.keys(), float(bits, 65_536.0))
        })
    });
    let exact_turbulence =
        |noise: Noise, place| reference::turbulence(noise.keys(), TURBULENT.0, TURBULENT.1.into(), place);
    let turbulent = seeds.iter().flat_map(|noise| {
        places(4_000).into_iter().map(round).map(move |bits| {
            turbulence(*noise).at(real(bits)).to_num::<f64>()
                - exact_turbulence(*noise, float(bits, two_to(24)))
        })
    });
    let knots = [(-1.0, 0.125), (-0.25, 0.25), (0.5, 0.9375), (1.0, 0.5)];
    let undulate = Spline::<4>::new(&knots.map(|(x, y)| (Unit::from_num(x), Rgb::grey(Lumen::from_num(y)))))
        .expect("knots in order");
    let noise_of_marble = Noise::new(3);
    let marble = Marble {
        undulate,
        turbulence: turbulence(noise_of_marble),
        amplitude: Real::from_num(TURBULENT.2),
        frequency: Real::from_num(2),
    };
    let vein = move |bits: [i32; 3]| {
        let place = float(bits, two_to(24));
        reference::vein(2.0, TURBULENT.2, exact_turbulence(noise_of_marble, place), place)
    };
    let wood = Wood {
        colors: [Rgb::BLACK, Rgb::WHITE],
        rings: Real::from_num(8),
        tilt: [0.25, -0.125].map(Real::from_num),
        wobble: Real::ONE,
        lobes: 5,
        twist: Real::from_num(0.375),
        rough: None,
        soft: Unit::ZERO,
    };
    let log = reference::Wood { rings: 8.0, tilt: [0.25, -0.125], wobble: 1.0, lobes: 5.0, twist: 0.375 };
    // within 4 of the origin and not too near to the axis, where an angle tells little
    let near = || {
        let around = |p: &[f64; 3]| (p[0] - 0.25 * p[2]).hypot(p[1] + 0.125 * p[2]) > 0.25;
        let bits = places(10_000).into_iter().map(|bits| bits.map(|c| c >> 5));
        bits.filter(move |bits| around(&float(*bits, two_to(24))))
    };
    vec![
        row("Noise::at", "I2F30", two_to(-26), noise),
        row("Turbulence::at", "I2F30", two_to(-25), turbulent),
        row(
            "Marble::vein",
            "I2F30",
            two_to(-19),
            places(4_000)
                .into_iter()
                .map(round)
                .map(|bits| marble.vein(real(bits)).to_num::<f64>() - vein(bits)),
        ),
        row(
            "Marble",
            "U16F16",
            two_to(-15),
            places(4_000).into_iter().map(round).map(|bits| {
                marble.at(&point(real(bits))).g.to_num::<f64>() - reference::spline(&knots, vein(bits))
            }),
        ),
        row(
            "Wood::radius",
            "24 bits",
            two_to(-19),
            near().map(|bits| {
                wood.radius(real(bits)) as f64 / two_to(24) - log.radius(float(bits, two_to(24)), 0.0)
            }),
        ),
        rings(wood, log),
        checker(),
        image(),
        bump(),
        panorama(),
    ]
}

/// Places of a slice through wood whose ring is another one: an error is how far the seam is from them.
fn rings(wood: Wood, log: reference::Wood) -> Row {
    use attractor::plane::{Bounds2, Field, Point2, Window};
    use embedded_graphics::geometry::Size;
    let corner = |v| Point2::new(Real::from_num(v), Real::from_num(v));
    let bounds = Bounds2 { min: corner(-2), max: corner(2) };
    let window = Window::stretch(bounds, Size::new(100, 100)).expect("a window");
    let slice = Slice::new(wood, window, Real::from_num(0.75));
    let wrong = (0..10_000_u32).map(|i| {
        let (x, y) = (i % 100, i / 100);
        let place = slice.point(x, y).place;
        let radius = log.radius([place.x, place.y, place.z].map(|c| c.to_num()), 0.0);
        let got = slice.at(x, y).r > 0;
        let seam = (radius - radius.round()).abs();
        if got == (reference::rings(radius) > 0) { two_to(-40) } else { seam }
    });
    row("Slice of Wood", "distance", two_to(-18), wrong)
}

fn checker() -> Row {
    let frequency = [2.0, 0.75, 1.0];
    let offset = 5_063.0 / two_to(24);
    let cubes = Checker::cubes(frequency.map(Real::from_num), Rgb::BLACK, Rgb::WHITE);
    let wrong = places(10_000).into_iter().map(|bits| {
        let place = float(bits, two_to(24));
        let got = cubes.is_odd(&point(real(bits)));
        let layer = |i: usize| frequency[i] * place[i] + offset;
        let seam = (0..3).map(|i| (layer(i) - layer(i).round()).abs()).fold(1.0, f64::min);
        if got == (reference::checker(frequency, offset, place) > 0) { two_to(-40) } else { seam }
    });
    row("Checker", "distance", two_to(-23), wrong)
}

fn bytes(columns: usize, rows: usize) -> Vec<u8> {
    words(43).take(columns * rows).map(|w| w as u8).collect()
}

fn image() -> Row {
    let bytes = bytes(12, 9);
    let image = Image::new(Texels::Linear, 12, 9, &bytes).expect("a small image");
    let texel = |i: usize, j: usize| f64::from(bytes[j * 12 + i]) / 255.0;
    let mut random = words(44);
    let mut next = move || random.next().unwrap_or_default();
    let errors = (0..5_000).map(|_| {
        let [u, v] = [next(), next()].map(|w| Real::from_bits(w as i32 >> 5));
        // one to two texels
        let part = |w: u64, count: i32| {
            Real::from_bits((1 << 24) / count + 1 + (w as i32 & 0xff_ffff) / (count + 1))
        };
        let (across, up) = (part(next(), 12), part(next(), 9));
        let [x, y, wide, high] = [u, v, across, up].map(|c| c.to_num::<f64>());
        image.mean(u, v, across, up).g.to_num::<f64>()
            - reference::image_mean(texel, [12, 9], [x, y], [wide, high])
    });
    row("Image::mean", "U16F16", two_to(-14), errors.collect::<Vec<_>>())
}

fn bump() -> Row {
    let mut random = words(45);
    let mut next = move || random.next().unwrap_or_default() as i32 >> 4;
    let mut errors = Vec::new();
    while errors.len() < 6_000 {
        let [along_u, along_v] = [(); 2].map(|()| [next() >> 1, next() >> 1, next() >> 1]);
        let [p, q] = [along_u, along_v].map(|bits| float(bits, two_to(24)));
        let length = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
        let slopes = [next(), next()].map(|b| f64::from(b >> 1) / two_to(24));
        let flat = reference::bumped(p, q, [0.0; 2]);
        if length(p) < 0.25 || length(q) < 0.25 || length(flat) < 0.5 * length(p) * length(q) {
            continue;
        }
        let exact = reference::bumped(p, q, slopes);
        let [x, y, z] = flat.map(|c| Unit::from_num(c / length(flat)));
        let chart = Chart { along_u: real(along_u), along_v: real(along_v), ..Chart::default() };
        let raised = SurfacePoint { chart, normal: Vec3::new(x, y, z), ..point(Vec3::default()) };
        let got = bumped_normal(&raised, slopes.map(Real::from_num));
        for (got, c) in [got.x, got.y, got.z].into_iter().zip(exact) {
            errors.push(got.to_num::<f64>() - c / length(exact));
        }
    }
    row("bumped_normal", "I2F30", two_to(-22), errors)
}

/// The light from all round against the mean over the box of the same directions.
fn panorama() -> Row {
    let bytes = bytes(16, 8);
    let image = Image::new(Texels::Linear, 16, 8, &bytes).expect("a small image");
    let sky = Panorama::new(image);
    let texel = |i: usize, j: usize| f64::from(bytes[j * 16 + i]) / 255.0;
    let errors = places(6_000).into_iter().filter_map(|bits| {
        let direction = real(bits).normalised()?;
        let e = [direction.x, direction.y, direction.z].map(|c| c.to_num::<f64>());
        let [u, v] = reference::all_round(e);
        // away from the poles, where the image ends
        if !(1.0 / 16.0..=15.0 / 16.0).contains(&v) {
            return None;
        }
        let exact = reference::image_mean(texel, [16, 8], [u, v], [1.0 / 16.0, 1.0 / 8.0]);
        Some(sky.light(direction, Unit::ZERO).g.to_num::<f64>() - exact)
    });
    row("Panorama::light", "U16F16", two_to(-13), errors.collect::<Vec<_>>())
}
