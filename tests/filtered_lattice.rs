//! Pictures of a lattice as a height field, by samples and filtered, against what each pixel shows in truth.

use attractor::num::{Near, Real, Unit, Vec3};
use attractor::patch::{Mask, Sheet, SlopeMoments};
use attractor::plane::{Field, Tone};
use attractor::trace::{
    Camera, Environment, Filter, FilteredPatch, Finish, Found, Light, PatchCaster, PatchSurface, Quality,
    Sampling,
};
use attractor_reference as reference;
use embedded_graphics::geometry::Size;
use reference::projected::{Pixel, interior_of};

const CELLS: u32 = 6;
const DEGREES: f64 = 20.5;

/// The mask of the scene `figure-6-without-grain`: the same in all eight directions.
fn mask() -> Mask {
    let entry =
        |i: usize, j: usize| match (i.abs_diff(2).min(j.abs_diff(2)), i.abs_diff(2).max(j.abs_diff(2))) {
            (0, 0) => 4096,
            (0, 1) => 2048 + 2 * 204,
            (1, 1) => 1024,
            (1, 2) => -204,
            _ => 0,
        };
    let entries = std::array::from_fn(|i| std::array::from_fn(|j| Near::from_bits(entry(i, j) << 16)));
    Mask::new(entries).unwrap()
}

/// Its cone, as steep as wanted.
fn cone(height: f64) -> Vec<Real> {
    let at = |k: i32| f64::from((k / 9 - 4).pow(2) + (k % 9 - 4).pow(2)).sqrt();
    (0..81).map(|k| Real::from_num(height * (1.0 - at(k) / 2.6).max(0.0))).collect()
}

fn unit(v: f64) -> Unit {
    Unit::from_num(v)
}

/// Matt, a sharp highlight, a sheen, mirrors of a gradient and of a checkerboard.
fn looks() -> [(Finish, Environment, reference::projected::Look); 5] {
    use reference::{Environment as Around, Finish as Stuff};
    let sky = Environment::Gradient { zenith: unit(0.5), horizon: unit(0.125), nadir: unit(0.0) };
    let exact_sky = Around::Gradient { zenith: 0.5, horizon: 0.125, nadir: 0.0 };
    let (bright, dark, horizon) = (unit(0.9375), unit(0.1875), unit(0.5));
    let (scale, fade) = (Real::lit("0.3"), unit(0.6));
    let board = Environment::Checkerboard { bright, dark, horizon, scale, fade };
    let exact_board =
        Around::Checkerboard { scale: 0.3, bright: 0.9375, dark: 0.1875, horizon: 0.5, fade: 0.6 };
    let none = Unit::ZERO;
    let shiny = Finish::Phong { ambient: none, diffuse: none, specular: Unit::ONE, shininess: 32 };
    let (roughness, reflectance) = (unit(0.25), unit(0.75));
    let sheen =
        Finish::TorranceSparrow { ambient: none, diffuse: none, specular: Unit::ONE, roughness, reflectance };
    let exact_shiny = Stuff::Phong { ambient: 0.0, diffuse: 0.0, specular: 1.0, shininess: 32.0 };
    let (ambient, diffuse, specular, roughness, reflectance) = (0.0, 0.0, 1.0, 0.25, 0.75);
    let exact_sheen = Stuff::TorranceSparrow { ambient, diffuse, specular, roughness, reflectance };
    [
        (Finish::Diffuse { ambient: none }, sky, (Stuff::Diffuse { ambient }, exact_sky)),
        (shiny, sky, (exact_shiny, exact_sky)),
        (sheen, sky, (exact_sheen, exact_sky)),
        (Finish::Mirror, sky, (Stuff::Mirror, exact_sky)),
        (Finish::Mirror, board, (Stuff::Mirror, exact_board)),
    ]
}

fn caster<'a>(
    mask: &'a Mask,
    heights: &'a [Real],
    (finish, environment): (Finish, Environment),
    side: u32,
    n: u8,
) -> PatchCaster<'a, Mask, 16> {
    let surface = PatchSurface::new(Sheet::new(mask, heights, CELLS).unwrap(), 9).unwrap();
    let (eye, at) = (Vec3::lit("-2.2", "-1.85", "1.4"), Vec3::lit("0.5", "0.5", "0.17"));
    let camera = Camera::new(eye, at, Vec3::Z, Real::from_num(DEGREES)).unwrap();
    let sampling = if n == 1 { Sampling::Centre } else { Sampling::Jittered { n, seed: 1 } };
    PatchCaster::new(surface, camera, Size::new(side, side))
        .unwrap()
        .with_finish(finish)
        .and_then(|caster| caster.with_environment(environment))
        .and_then(|caster| caster.with_sampling(sampling, Filter::Box))
        .unwrap()
        .with_light(Light::new(Vec3::lit("-1", "-2", "3")).unwrap())
}

fn truth(mask: &Mask, heights: &[Real], side: u32, levels: u32) -> Vec<Pixel> {
    let entries = mask.entries().map(|row| row.map(|entry| entry.to_num::<f64>()));
    let heights: Vec<f64> = heights.iter().map(|height| height.to_num()).collect();
    let places = reference::lattice::places(&heights, CELLS as usize, &entries, levels);
    let camera = reference::Camera {
        eye: [-2.2, -1.85, 1.4],
        look_at: [0.5, 0.5, 0.17],
        up: [0.0, 0.0, 1.0],
        field_of_view: DEGREES.to_radians(),
    };
    let ground = 1.0 / f64::from(CELLS << levels).powi(2);
    interior_of(
        places.into_iter(),
        ground,
        &camera,
        [-1.0, -2.0, 3.0],
        &looks().map(|look| look.2),
        side as usize,
    )
}

/// Errors of 1, 16 and 64 samples, then of each quality, by look.
fn table(height: f64, side: u32, levels: u32) -> Vec<[f64; 6]> {
    let (mask, heights) = (mask(), cone(height));
    let moments = SlopeMoments::new(&mask).unwrap();
    let truth = truth(&mask, &heights, side, levels);
    let least = truth.iter().map(|p| p.places).min().unwrap_or(0);
    println!("height {height}, {side} x {side}: {} interior pixels, {least} samples at least", truth.len());
    let names = ["diffuse", "exponent 32", "sheen", "gradient", "checkerboard"];
    let looks = looks();
    let row = |(k, name): (usize, &str)| {
        let rms = |picture: &dyn Fn(u32, u32) -> Tone| {
            let off =
                |p: &Pixel| f64::from(picture(p.at.0 as u32, p.at.1 as u32).to_bits()) / 65535.0 - p.tones[k];
            (truth.iter().map(|p| off(p) * off(p)).sum::<f64>() / truth.len() as f64).sqrt()
        };
        let caster = |n| caster(&mask, &heights, (looks[k].0, looks[k].1), side, n);
        let samples = [1, 4, 8].map(|n| (caster(n), n)).map(|(caster, _)| rms(&|x, y| caster.at(x, y)));
        let qualities = [Quality::Coarse, Quality::Fine, Quality::Finest];
        let filtered = qualities.map(|quality| {
            let filtered = FilteredPatch::new(caster(4), &moments, quality);
            rms(&|x, y| filtered.at(x, y))
        });
        let row = [samples[0], samples[1], samples[2], filtered[0], filtered[1], filtered[2]];
        println!("{name:14} {}", row.map(|e| format!("{e:8.5}")).join(" "));
        row
    };
    names.into_iter().enumerate().map(row).collect()
}

/// The whole comparison: docs/FILTERED.md.
#[test]
#[ignore = "a minute: cargo test -p attractor-tests --test suite -- --ignored --nocapture lattice_pictures"]
fn lattice_pictures_are_nearer_the_truth_than_samples() {
    for (height, levels) in [(0.15, 9), (0.5, 9)] {
        table(height, 96, levels);
    }
}

/// The same of few pixels: by how much against 16 samples, coarse, fine and finest.
#[test]
fn a_filtered_lattice_is_nearer_the_truth_than_many_samples() {
    let (gentle, steep) = (table(0.05, 40, 7), table(0.5, 40, 7));
    // where a gentle cone has a highlight nothing shines
    let gentle = [gentle[0], gentle[3], gentle[4]].into_iter().zip([
        [2.0, 5.3, 6.6],
        [1.8, 4.7, 6.0],
        [1.2, 1.9, 1.9],
    ]);
    let steep = steep.into_iter().zip([
        [1.2, 3.8, 4.0],
        [1.1, 2.1, 2.4],
        [1.6, 3.6, 3.7],
        [1.1, 2.7, 2.8],
        [1.3, 2.1, 2.2],
    ]);
    let mut tried = 0;
    for ([one, sixteen, _, coarse, fine, finest], factors) in gentle.chain(steep) {
        for (filtered, factor) in [coarse, fine, finest].into_iter().zip(factors) {
            assert!(filtered * factor < sixteen && filtered > 1e-4, "{sixteen}: {filtered} {factor}");
        }
        assert!(sixteen * 2.0 < one, "{one} {sixteen}");
        tried += 1;
    }
    assert_eq!(tried, 8);
}

/// Pixels at edges are those of the samples, and what meets nothing shows the surroundings; rows are pixels.
#[test]
fn edges_of_a_lattice_are_sampled_and_what_lies_beyond_is_as_it_was() {
    let (side, mask, heights) = (48, mask(), cone(0.5));
    let moments = SlopeMoments::new(&mask).unwrap();
    let (finish, environment, _) = looks()[4];
    let plain = caster(&mask, &heights, (finish, environment), side, 4);
    let filtered = FilteredPatch::new(plain.clone(), &moments, Quality::Fine);
    assert_eq!((filtered.size(), filtered.caster().size()), (plain.size(), plain.size()));
    let mut count = [0; 3];
    for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
        let tone = filtered.at(x, y);
        match filtered.found(x, y) {
            Found::Filtered => count[0] += 1,
            Found::Sampled => {
                assert_eq!(tone, plain.at(x, y), "{x} {y}");
                count[1] += 1;
            }
            _ => {
                count[2] += 1;
                // but for corners of pixels
                assert!((i32::from(tone.to_bits()) - i32::from(plain.at(x, y).to_bits())).abs() < 9000);
            }
        }
    }
    assert!(count[0] > 300 && count[1] > 20 && count[2] > 900, "{count:?}");
    for y in [0, 20, 47] {
        let row: Vec<Tone> = filtered.row(y, 0..side + 9).collect();
        assert!(row.len() == side as usize);
        assert!(row.iter().enumerate().all(|(x, tone)| *tone == filtered.at(x as u32, y)));
    }
    assert_eq!(filtered.found(side, 0), Found::Beyond);
}
