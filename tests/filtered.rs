//! Filtered pictures against what each pixel shows in truth, beside those of one sample and of many.

use attractor::Error;
use attractor::fif::{Cell, Fif, Knot, Pyramid, Sum, Sums};
use attractor::num::{Real, Scaling, Unit, Vec3, Wide};
use attractor::plane::{Field, Tone};
use attractor::trace::{
    Camera, Environment, Filter, FilteredCaster, Finish, Found, HeightField, Light, Quality, RayCaster,
    Sampling,
};
use attractor_reference as reference;
use embedded_graphics::geometry::Size;
use reference::projected::{Pixel, interior};

/// A surface of figure 6, as its scene shows it.
#[derive(Clone, Copy)]
struct View {
    name: &'static str,
    scalings: [f64; 2],
    eye: [f64; 3],
    look_at: [f64; 3],
    degrees: f64,
    light: [f64; 3],
    scale: f64,
    fade: f64,
}

const GG: View = View {
    name: "G x G",
    scalings: [0.85, -0.85],
    eye: [-4.4, -3.7, 2.8],
    look_at: [1.0, 1.0, 0.35],
    degrees: 22.0,
    light: [-1.0, -2.0, 3.0],
    scale: 0.3,
    fade: 0.6,
};

const FF: View = View {
    name: "F x F",
    scalings: [0.5, 0.5],
    eye: [-6.0, -4.9, 4.4],
    look_at: [1.15, 1.15, 1.7],
    degrees: 28.5,
    light: [-3.0, 1.0, 2.0],
    scale: 1.0,
    fade: 0.9,
};

/// Matt, highlights of three exponents, mirrors of a gradient and of a checkerboard, tiny mirrors.
const LOOKS: [&str; 7] =
    ["diffuse", "exponent 8", "exponent 32", "exponent 128", "gradient", "checkerboard", "sheen"];
const QUALITIES: [Quality; 3] = [Quality::Coarse, Quality::Fine, Quality::Finest];

impl View {
    fn looks(&self) -> [(Finish, Environment); 7] {
        let unit = Unit::from_num::<f64>;
        let [zenith, horizon, nadir] = [0.5, 0.12, 0.0].map(unit);
        let sky = Environment::Gradient { zenith, horizon, nadir };
        let board = Environment::Checkerboard {
            bright: unit(0.9375),
            dark: unit(0.1875),
            horizon: unit(0.5),
            scale: Real::from_num(self.scale),
            fade: unit(self.fade),
        };
        let highlight = |shininess| Finish::Phong {
            ambient: unit(0.0),
            diffuse: unit(0.0),
            specular: unit(1.0),
            shininess,
        };
        [
            (Finish::Diffuse { ambient: unit(0.0) }, sky),
            (highlight(8), sky),
            (highlight(32), sky),
            (highlight(128), sky),
            (Finish::Mirror, sky),
            (Finish::Mirror, board),
            (
                Finish::TorranceSparrow {
                    ambient: unit(0.0),
                    diffuse: unit(0.0),
                    specular: unit(1.0),
                    roughness: unit(0.25),
                    reflectance: unit(0.75),
                },
                sky,
            ),
        ]
    }

    fn truth(&self, looks: &[usize], side: u32, places: usize) -> Vec<Pixel> {
        let knots = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];
        let slope = reference::Fif::interpolating(&knots, &self.scalings);
        let factor = reference::Factor::from_slope(slope, 0.0);
        let camera = reference::Camera {
            eye: self.eye,
            look_at: self.look_at,
            up: [0.0, 0.0, 1.0],
            field_of_view: self.degrees.to_radians(),
        };
        use reference::{Environment as Around, Finish as Stuff};
        let sky = Around::Gradient { zenith: 0.5, horizon: 0.12, nadir: 0.0 };
        let (scale, fade) = (self.scale, self.fade);
        let board = Around::Checkerboard { scale, bright: 0.9375, dark: 0.1875, horizon: 0.5, fade };
        let highlight = |shininess| Stuff::Phong { ambient: 0.0, diffuse: 0.0, specular: 1.0, shininess };
        let all = [
            (Stuff::Diffuse { ambient: 0.0 }, sky),
            (highlight(8.0), sky),
            (highlight(32.0), sky),
            (highlight(128.0), sky),
            (Stuff::Mirror, sky),
            (Stuff::Mirror, board),
            (
                Stuff::TorranceSparrow {
                    ambient: 0.0,
                    diffuse: 0.0,
                    specular: 1.0,
                    roughness: 0.25,
                    reflectance: 0.75,
                },
                sky,
            ),
        ];
        let looks: Vec<_> = looks.iter().map(|k| all[*k]).collect();
        interior((&factor, &factor), &camera, self.light, &looks, side as usize, places)
    }

    /// With sums of cells a quarter as wide as those of the pyramid.
    fn with_surface<R>(&self, depth: u32, then: impl FnOnce(&HeightField<'_>, &Sums<'_>) -> R) -> R {
        let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let slope = Fif::<2, 2>::interpolating(&knots, &self.scalings.map(Scaling::from_num)).unwrap();
        let f = slope.integral::<2>(Wide::ZERO).unwrap();
        let finer = depth + 2;
        let mut cells = vec![Cell::ZERO; Pyramid::cells(2, depth)];
        let mut places = vec![Sum::ZERO; Sums::places(2, finer)];
        let pyramid = Pyramid::new(&f, depth, &mut cells).unwrap();
        let sums = Sums::new(&f, finer, &mut places).unwrap();
        then(&HeightField::new(&pyramid, &pyramid).unwrap(), &sums)
    }

    fn caster<'a>(&self, surface: &HeightField<'a>, look: usize, side: u32, n: u8) -> RayCaster<'a> {
        let vector = |[x, y, z]: [f64; 3]| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
        let degrees = Real::from_num(self.degrees);
        let camera = Camera::new(vector(self.eye), vector(self.look_at), Vec3::Z, degrees).unwrap();
        let (finish, environment) = self.looks()[look];
        let sampling = if n == 1 { Sampling::Centre } else { Sampling::Jittered { n, seed: 1 } };
        let caster = RayCaster::new(*surface, camera, Size::new(side, side)).unwrap();
        let caster = caster.with_finish(finish).unwrap().with_environment(environment).unwrap();
        caster
            .with_light(Light::new(vector(self.light)).unwrap())
            .with_sampling(sampling, Filter::Box)
            .unwrap()
    }
}

/// The root of the mean square of what a picture is off.
fn rms(truth: &[Pixel], look: usize, picture: &impl Field<Value = Tone>) -> f64 {
    let off = |p: &Pixel| {
        let tone = picture.at(p.at.0 as u32, p.at.1 as u32);
        f64::from(tone.to_bits()) / 65535.0 - p.tones[look]
    };
    (truth.iter().map(|p| off(p) * off(p)).sum::<f64>() / truth.len() as f64).sqrt()
}

/// Errors by look: of 1, 16 and 64 samples, then of each quality. How many of the pixels took the samples of
/// the caster at fine quality, 16, and what the others are off, is printed after them.
fn table(view: &View, looks: &[usize], side: u32, depth: u32, places: usize) -> Vec<[f64; 6]> {
    let truth = view.truth(looks, side, places);
    let least = truth.iter().map(|p| p.places).min().unwrap_or(0);
    println!("{}, {side} x {side}: {} interior pixels, {least} samples at least", view.name, truth.len());
    let heads = ["1", "16", "64", "coarse", "fine", "finest"].map(|head| format!("{head:>8}")).join(" ");
    println!("{:14} {heads}  16/fine  of fine: sampled, others", "");
    view.with_surface(depth, |surface, sums| {
        let row = |(k, look): (usize, &usize)| {
            let samples = [1, 4, 8].map(|n| rms(&truth, k, &view.caster(surface, *look, side, n)));
            let filtered = QUALITIES.map(|quality| {
                let caster = view.caster(surface, *look, side, 4);
                rms(&truth, k, &FilteredCaster::new(caster, sums, sums, quality).unwrap())
            });
            let row = [samples[0], samples[1], samples[2], filtered[0], filtered[1], filtered[2]];
            let fine =
                FilteredCaster::new(view.caster(surface, *look, side, 4), sums, sums, Quality::Fine).unwrap();
            let is_sampled = |p: &Pixel| fine.found(p.at.0 as u32, p.at.1 as u32) == Found::Sampled;
            let others: Vec<Pixel> = truth.iter().filter(|p| !is_sampled(p)).cloned().collect();
            let (sampled, off) = (truth.len() - others.len(), rms(&others, k, &fine));
            let row_printed = row.map(|e| format!("{e:8.5}")).join(" ");
            let times = row[1] / row[4];
            println!("{:14} {row_printed}  {times:7.1}  {sampled:16}, {off:.5}", LOOKS[*look]);
            row
        };
        looks.iter().enumerate().map(row).collect()
    })
}

/// The whole comparison, against 61,000 samples a pixel or more: a quarter of an hour. What it printed
/// last: docs/FILTERED.md.
#[test]
#[ignore = "minutes: cargo test -p attractor-tests --test suite -- --ignored --nocapture filtered"]
fn filtered_pictures_are_nearer_the_truth_than_samples() {
    for (view, places) in [(&GG, 24_000), (&FF, 16_000)] {
        table(view, &[0, 1, 2, 3, 4, 5, 6], 96, 9, places);
    }
    for (view, places) in [(&GG, 56_000), (&FF, 40_000)] {
        table(view, &[0, 1, 2, 3, 4, 5, 6], 240, 10, places);
    }
}

/// The same of few pixels.
#[test]
fn a_filtered_pixel_is_nearer_the_truth_than_many_samples() {
    let rough = table(&GG, &[0, 2, 5, 6], 40, 8, 1800);
    let smooth = table(&FF, &[0, 2, 6], 40, 8, 1500);
    // by how much against 16 samples, fine and finest
    let factors = [[9.3, 9.3], [4.1, 4.6], [3.4, 3.8], [3.7, 4.1]];
    let factors = rough.iter().zip(factors).chain(smooth.iter().zip([[14.5, 16.0], [7.9, 8.8], [5.7, 6.4]]));
    for ([_, sixteen, _, _, eight, twelve], [a, b]) in factors {
        assert!(eight * a < *sixteen && twelve * b < *sixteen, "{sixteen} {eight} {twelve}");
    }
    // two boxes in diffuse light against 64
    for [_, _, sixty_four, two, ..] in [rough[0], smooth[0]] {
        assert!(two < sixty_four, "{two} {sixty_four}");
    }
    assert_eq!((rough.len(), smooth.len()), (4, 3));
}

/// Pixels whose lower edge a ridge grazes: the first ray meets the ridge, all the pixel shows is what lies
/// far behind. They are filtered there, within a fiftieth of 32 x 32 narrow rays over much finer leaves; 16
/// samples,
/// for which the leaves hide more than the surface does, are off by more than a twentieth.
#[test]
fn a_ridge_that_grazes_a_pixel_hides_nothing_of_what_lies_behind() {
    let (side, parts) = (240, 32);
    GG.with_surface(12, |finer, _| {
        let narrow = GG.caster(finer, 0, side * parts, 1);
        GG.with_surface(10, |surface, sums| {
            let caster = GG.caster(surface, 0, side, 4);
            let fine = FilteredCaster::new(caster, sums, sums, Quality::Fine).unwrap();
            for (x, y) in
                [(93, 56), (76, 60), (112, 66), (125, 67), (130, 68), (116, 71), (125, 72), (128, 73)]
            {
                let columns = x * parts..(x + 1) * parts;
                let rows = (y * parts..(y + 1) * parts).flat_map(|row| narrow.row(row, columns.clone()));
                let truth = rows.map(|tone| f64::from(tone.to_bits())).sum::<f64>() / 65535.0;
                let truth = truth / f64::from(parts * parts);
                let off = |tone: Tone| f64::from(tone.to_bits()) / 65535.0 - truth;
                let (one, sixteen) = (off(fine.at(x, y)), off(fine.caster().at(x, y)));
                assert_eq!(fine.found(x, y), Found::Filtered, "{x} {y}");
                assert!(one.abs() < 0.02 && sixteen < -0.05, "{x} {y}: {one} {sixteen}");
            }
        });
    });
}

/// A turntable of 64 frames, of which eight move by a tenth of a pixel: how much a pixel's tone is off the
/// mean of those eight frames before and after. What moves by so little hardly changes in truth.
#[test]
fn a_turntable_shimmers_less_than_with_64_samples() {
    let (side, frames, apart) = (32, 64, 8);
    let flicker = GG.with_surface(8, |surface, sums| {
        let mut tones = [vec![], vec![]];
        let mut inside = vec![true; (side * side) as usize];
        for frame in 0..frames {
            let (s, c) = (f64::from(frame) * 0.05_f64.to_radians()).sin_cos();
            let [x, y, z] = GG.eye;
            let (dx, dy) = (x - 1.0, y - 1.0);
            let view = View { eye: [1.0 + c * dx - s * dy, 1.0 + s * dx + c * dy, z], ..GG };
            let plain = view.caster(surface, 0, side, 8);
            let filtered = FilteredCaster::new(plain.clone(), sums, sums, Quality::Coarse).unwrap();
            for (i, inside) in (0..).zip(&mut inside) {
                *inside &= filtered.found(i % side, i / side) == Found::Filtered;
            }
            let places = (0..side).flat_map(|y| (0..side).map(move |x| (x, y)));
            let tone = |tone: attractor::plane::Tone| f64::from(tone.to_bits()) / 65535.0;
            // only those that are inside so far
            let rest = |(x, y): &(u32, u32)| inside[(y * side + x) as usize];
            let each: Vec<_> = places
                .map(|p| {
                    if rest(&p) {
                        (tone(filtered.at(p.0, p.1)), tone(plain.at(p.0, p.1)))
                    } else {
                        (0.0, 0.0)
                    }
                })
                .collect();
            let (a, b) = each.into_iter().unzip::<f64, f64, Vec<_>, Vec<_>>();
            tones[0].push(a);
            tones[1].push(b);
        }
        let count = inside.iter().filter(|inside| **inside).count();
        assert!(count > 150, "{count}");
        tones.map(|tones| {
            let mut sum = 0.0;
            for t in apart..frames as usize - apart {
                for (i, _) in inside.iter().enumerate().filter(|(_, inside)| **inside) {
                    let off = tones[t][i] - (tones[t - apart][i] + tones[t + apart][i]) / 2.0;
                    sum += off * off;
                }
            }
            sum / (count * (frames as usize - 2 * apart)) as f64
        })
    });
    println!("mean squares: filtered {:e}, 64 samples {:e}", flicker[0], flicker[1]);
    assert!(flicker[0] < flicker[1] && flicker[0] > 1e-9, "{flicker:?}");
}

/// Pixels at edges are those of the ray caster, and what meets nothing shows the surroundings.
#[test]
fn edges_are_sampled_and_what_lies_beyond_is_as_it_was() {
    let side = 64;
    GG.with_surface(8, |surface, sums| {
        let plain = GG.caster(surface, 0, side, 4);
        let filtered = FilteredCaster::new(plain.clone(), sums, sums, Quality::Fine).unwrap();
        assert_eq!(filtered.size(), plain.size());
        let one = GG.caster(surface, 0, side, 1);
        let mut count = [0; 3];
        for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
            let (found, tone) = (filtered.found(x, y), filtered.at(x, y));
            let hit = one.hit(x, y).is_some();
            match found {
                Found::Filtered => count[0] += 1,
                Found::Sampled => {
                    assert_eq!(tone, plain.at(x, y), "{x} {y}");
                    count[1] += 1;
                }
                _ => {
                    // but for corners of pixels
                    count[2] += usize::from(hit);
                    assert!(hit || tone == one.at(x, y), "{x} {y}");
                }
            }
        }
        assert!(count[0] > 1000 && (50..500).contains(&count[1]) && count[2] < 4, "{count:?}");
        for y in [0, 20, 33, 63, 99] {
            let row: Vec<_> = filtered.row(y, 0..side + 9).collect();
            assert_eq!(row.len(), side as usize);
            assert!(row.iter().enumerate().all(|(x, tone)| *tone == filtered.at(x as u32, y.min(63))));
        }
        assert_eq!(filtered.found(64, 0), Found::Beyond);
        assert_eq!(filtered.caster().size(), plain.size());
    });
}

#[test]
fn sums_of_another_surface_are_refused() {
    GG.with_surface(4, |surface, sums| {
        FF.with_surface(4, |_, other| {
            let caster = || GG.caster(surface, 0, 8, 1);
            let error = FilteredCaster::new(caster(), sums, other, Quality::Coarse).unwrap_err();
            assert!(matches!(error, Error::Unsupported { what: "running sums", .. }), "{error}");
            assert!(
                error.to_string().contains("those of the functions of the surface's own pyramids"),
                "{error}"
            );
            assert!(FilteredCaster::new(caster(), sums, sums, Quality::Coarse).is_ok());
        });
    });
}
