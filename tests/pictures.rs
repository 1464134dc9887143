//! Pictures of height fields against the f64 rendering of the same definition (CONTRIBUTING.md).

use attractor::fif::{Cell, Fif, Pyramid};
use attractor::num::{Real, Unit, Vec3, Wide};
use attractor::plane::Field as _;
use attractor::trace::{
    Camera, Environment, Filter, Finish, HeightField, Light, RayCaster, Sampling, Statistics,
};
use attractor_reference as reference;
use attractor_tests::accuracy::{Example, dyadic_examples, other_examples};
use embedded_graphics::geometry::Size;

const SIDE: u32 = 240;

/// A view in numbers that both sides represent exactly.
struct View {
    eye: [f64; 3],
    look_at: [f64; 3],
    degrees: f64,
}

/// From the front corner, the surface fills about a third of the picture.
const CORNER: View = View { eye: [-3.0, -2.5, 4.0], look_at: [1.0, 1.0, 0.75], degrees: 30.0 };
/// Looking straight along x: rays parallel to planes in the middle of the picture.
const ALONG_X: View = View { eye: [-4.0, 1.0, 1.5], look_at: [1.0, 1.0, 0.5], degrees: 40.0 };
/// From inside the surface's box, above the surface.
const INSIDE: View = View { eye: [0.25, 0.25, 0.75], look_at: [2.0, 1.75, 0.0], degrees: 60.0 };
/// From the two corners in between: with [`CORNER`] and [`BELOW`] the four cases of figure 5.
const LEFT: View = View { eye: [-2.75, 4.5, 3.5], look_at: [1.0, 1.0, 0.5], degrees: 28.0 };
const RIGHT: View = View { eye: [5.0, -2.25, 3.0], look_at: [1.0, 1.0, 0.5], degrees: 28.0 };
/// From the opposite corner and from below.
const BELOW: View = View { eye: [5.0, 4.5, -3.0], look_at: [1.0, 1.0, 0.5], degrees: 25.0 };

fn real3(v: [f64; 3]) -> Vec3 {
    Vec3::new(Real::from_num(v[0]), Real::from_num(v[1]), Real::from_num(v[2]))
}

fn unit(v: f64) -> Unit {
    Unit::from_num(v)
}

/// The fixed-point picture's memory: fifteen lines of set-up that every firmware has.
fn with_surface<R>(f: &Fif<16, 4>, depth: u32, then: impl FnOnce(HeightField<'_>) -> R) -> R {
    let mut memory = vec![Cell::ZERO; Pyramid::cells(f.maps(), depth)];
    let pyramid = Pyramid::new(f, depth, &mut memory).unwrap();
    then(HeightField::new(&pyramid, &pyramid).unwrap())
}

struct Case {
    surface: &'static str,
    view: View,
    depth: u32,
    material: (Finish, reference::Finish),
    environment: (Environment, reference::Environment),
    sampling: (Sampling, Filter, Vec<(f64, f64, f64)>),
}

fn diffuse() -> (Finish, reference::Finish) {
    (Finish::Diffuse { ambient: unit(0.125) }, reference::Finish::Diffuse { ambient: 0.125 })
}

fn phong() -> (Finish, reference::Finish) {
    let (ambient, diffuse, specular, shininess) = (0.125, 0.5, 0.375, 24);
    (
        Finish::Phong { ambient: unit(ambient), diffuse: unit(diffuse), specular: unit(specular), shininess },
        reference::Finish::Phong { ambient, diffuse, specular, shininess: f64::from(shininess) },
    )
}

fn mirror() -> (Finish, reference::Finish) {
    (Finish::Mirror, reference::Finish::Mirror)
}

fn gradient() -> (Environment, reference::Environment) {
    let (zenith, horizon, nadir) = (1.0, 0.5, 0.125);
    (
        Environment::Gradient { zenith: unit(zenith), horizon: unit(horizon), nadir: unit(nadir) },
        reference::Environment::Gradient { zenith, horizon, nadir },
    )
}

fn checkerboard() -> (Environment, reference::Environment) {
    let (bright, dark, horizon, scale, fade) = (0.9375, 0.1875, 0.5, 1.0, 0.125);
    (
        Environment::Checkerboard {
            bright: unit(bright),
            dark: unit(dark),
            horizon: unit(horizon),
            scale: Real::from_num(scale),
            fade: unit(fade),
        },
        reference::Environment::Checkerboard { bright, dark, horizon, scale, fade },
    )
}

fn centre() -> (Sampling, Filter, Vec<(f64, f64, f64)>) {
    (Sampling::Centre, Filter::Box, vec![(0.0, 0.0, 1.0)])
}

/// `n x n` samples with weights that fall off with their distance (eq. 53), or equal ones.
fn grid(n: u8, deviation: Option<f64>, width: f64) -> (Sampling, Filter, Vec<(f64, f64, f64)>) {
    let place = |i: u8| (f64::from(i) + 0.5) / f64::from(n) * width - width / 2.0;
    let weight = |d: f64| deviation.map_or(1.0, |s| (-d * d / (2.0 * s * s)).exp());
    let sum: f64 = (0..n).map(|i| weight(place(i))).sum();
    let samples = (0..n).flat_map(|j| {
        (0..n).map(move |i| (place(i), place(j), weight(place(i)) * weight(place(j)) / sum / sum))
    });
    let filter = deviation.map_or(Filter::Box, |s| Filter::Gaussian {
        deviation: Real::from_num(s),
        width: Real::from_num(width),
    });
    (Sampling::Grid(n), filter, samples.collect())
}

fn example(name: &str) -> Example {
    dyadic_examples().into_iter().chain(other_examples()).find(|e| e.name == name).unwrap()
}

/// PSNR in dB, and the share of the pixels that differ by more than 2 levels of 255.
fn compare(case: &Case, side: u32) -> (f64, f64) {
    let e = example(case.surface);
    let fixed = e.fixed();
    let tones = with_surface(&fixed, case.depth, |surface| {
        let View { eye, look_at, degrees } = case.view;
        let up = real3([0.0, 0.0, 1.0]);
        let camera = Camera::new(real3(eye), real3(look_at), up, Real::from_num(degrees)).unwrap();
        let caster = RayCaster::new(surface, camera, Size::new(side, side)).unwrap();
        let caster =
            caster.with_finish(case.material.0).unwrap().with_environment(case.environment.0).unwrap();
        let caster = caster.with_light(Light::new(real3([-1.0, -2.0, 3.0])).unwrap());
        let caster = caster.with_sampling(case.sampling.0, case.sampling.1).unwrap();
        (0..side)
            .flat_map(|y| caster.row(y, 0..side).collect::<Vec<_>>())
            .map(|t| f64::from(t.to_bits()) / 65535.0)
            .collect::<Vec<_>>()
    });
    let bounds = reference::Bounds::new(&e.exact(), case.depth as usize);
    let scene = reference::Scene {
        x: bounds.clone(),
        y: bounds,
        camera: reference::Camera {
            eye: case.view.eye,
            look_at: case.view.look_at,
            up: [0.0, 0.0, 1.0],
            field_of_view: case.view.degrees.to_radians(),
        },
        material: case.material.1,
        environment: case.environment.1,
        light: [-1.0, -2.0, 3.0],
        samples_per_axis: match case.sampling.0 {
            Sampling::Grid(n) | Sampling::Jittered { n, .. } => n.into(),
            Sampling::Centre => 1,
            other => unreachable!("{other:?}"),
        },
    };
    let exact = reference::render(&scene, side as usize, side as usize, &case.sampling.2);
    assert_eq!(tones.len(), exact.len());
    let square: f64 =
        tones.iter().zip(&exact).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / tones.len() as f64;
    let far = tones.iter().zip(&exact).filter(|(a, b)| (*a - *b).abs() > 2.0 / 255.0).count();
    assert!(exact.iter().any(|t| (t - exact[0]).abs() > 0.1), "a picture of nothing");
    (-10.0 * square.max(1e-16).log10(), far as f64 / tones.len() as f64)
}

fn assert_close(case: &Case, side: u32, most_far: f64) {
    let (psnr, far) = compare(case, side);
    println!(
        "{:22} {:?} {:?}: {psnr:.1} dB, {:.4} % differ",
        case.surface,
        case.material.1,
        case.sampling.0,
        far * 100.0
    );
    assert!(psnr >= 40.0, "{}: {psnr} dB", case.surface);
    assert!(far <= most_far, "{}: {far}", case.surface);
}

#[test]
fn diffuse_phong_and_mirror_pictures_are_those_of_the_reference() {
    for surface in ["integral of f", "integral of g"] {
        for material in [diffuse(), phong(), mirror()] {
            let case = Case {
                surface,
                view: CORNER,
                depth: 8,
                material,
                environment: gradient(),
                sampling: centre(),
            };
            assert_close(&case, SIDE, 0.002);
        }
    }
}

#[test]
fn a_mirrored_checkerboard_is_that_of_the_reference() {
    for surface in ["integral of f", "integral of g"] {
        let case = Case {
            surface,
            view: CORNER,
            depth: 8,
            material: mirror(),
            environment: checkerboard(),
            sampling: centre(),
        };
        let (psnr, far) = compare(&case, SIDE);
        println!("{surface}: {psnr:.1} dB, {:.4} % differ", far * 100.0);
        assert!(far <= 0.005, "{surface}: {far}");
    }
}

#[test]
fn every_direction_of_view_gives_the_references_picture() {
    for view in [ALONG_X, INSIDE, LEFT, RIGHT, BELOW] {
        let case = Case {
            surface: "integral of g",
            view,
            depth: 7,
            material: diffuse(),
            environment: gradient(),
            sampling: centre(),
        };
        assert_close(&case, 120, 0.002);
    }
}

#[test]
fn other_partitions_give_the_references_picture() {
    let case = Case {
        surface: "integral of uneven",
        view: CORNER,
        depth: 5,
        material: mirror(),
        environment: gradient(),
        sampling: centre(),
    };
    assert_close(&case, 120, 0.002);
}

#[test]
fn grids_and_gaussian_weights_are_those_of_the_reference() {
    for sampling in [grid(3, None, 1.0), grid(4, Some(0.5), 2.0)] {
        let case = Case {
            surface: "integral of g",
            view: CORNER,
            depth: 8,
            material: mirror(),
            environment: gradient(),
            sampling,
        };
        assert_close(&case, 80, 0.002);
    }
}

/// The closer a surface, the deeper its leaves: the footprint decides.
#[test]
fn leaves_grow_with_the_footprint_as_in_the_reference() {
    let case = |depth| Case {
        surface: "integral of g",
        view: CORNER,
        depth,
        material: diffuse(),
        environment: gradient(),
        sampling: centre(),
    };
    assert_close(&case(12), 60, 0.002);
    let e = example("integral of g");
    let fixed = e.fixed();
    with_surface(&fixed, 12, |surface| {
        let up = real3([0.0, 0.0, 1.0]);
        let camera = Camera::new(real3(CORNER.eye), real3(CORNER.look_at), up, Real::from_num(30)).unwrap();
        let levels = |side: u32| {
            let caster = RayCaster::new(surface, camera, Size::new(side, side)).unwrap();
            (0..side).filter_map(|x| caster.hit(x, side / 2 + side / 8)).map(|h| h.level).max().unwrap()
        };
        assert!(
            levels(32) < levels(128) && levels(128) < levels(512),
            "{} {} {}",
            levels(32),
            levels(128),
            levels(512)
        );
    });
}

#[test]
fn jittered_samples_repeat_with_their_seed_and_approach_the_mean() {
    let e = example("integral of g");
    let fixed = e.fixed();
    with_surface(&fixed, 8, |surface| {
        let up = real3([0.0, 0.0, 1.0]);
        let camera = Camera::new(real3(CORNER.eye), real3(CORNER.look_at), up, Real::from_num(30)).unwrap();
        let tones = |sampling| {
            let caster = RayCaster::new(surface, camera, Size::new(60, 60))
                .unwrap()
                .with_finish(Finish::Mirror)
                .unwrap();
            let caster = caster.with_sampling(sampling, Filter::Box).unwrap();
            (0..60)
                .flat_map(|y| caster.row(y, 0..60).collect::<Vec<_>>())
                .map(|t| f64::from(t.to_bits()) / 65535.0)
                .collect::<Vec<_>>()
        };
        let rmse = |a: &[f64], b: &[f64]| {
            (a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>() / a.len() as f64).sqrt()
        };
        let truth = tones(Sampling::Jittered { n: 8, seed: 1 });
        assert_eq!(truth, tones(Sampling::Jittered { n: 8, seed: 1 }));
        let (one, four) = (tones(Sampling::Centre), tones(Sampling::Jittered { n: 4, seed: 2 }));
        assert!(
            rmse(&four, &truth) < 0.5 * rmse(&one, &truth),
            "{} {}",
            rmse(&four, &truth),
            rmse(&one, &truth)
        );
    });
}

/// Box tests a ray, on the paper's surfaces at depth 8 with a view that fills about a third: at most 13. The
/// stack keeps its bound.
#[test]
fn a_ray_takes_at_most_13_box_tests() {
    for (surface, view) in
        [("integral of f", View { eye: [-4.5, -4.0, 5.5], ..CORNER }), ("integral of g", CORNER)]
    {
        let fixed = example(surface).fixed();
        with_surface(&fixed, 8, |surface| {
            let up = real3([0.0, 0.0, 1.0]);
            let camera =
                Camera::new(real3(view.eye), real3(view.look_at), up, Real::from_num(view.degrees)).unwrap();
            let caster = RayCaster::new(surface, camera, Size::new(SIDE, SIDE)).unwrap();
            let hits = (0..SIDE)
                .flat_map(|y| (0..SIDE).map(move |x| (x, y)))
                .filter(|(x, y)| caster.hit(*x, *y).is_some())
                .count();
            let filled = hits as f64 / f64::from(SIDE * SIDE);
            assert!((0.28..0.45).contains(&filled), "the surface fills {filled}");
            let Statistics { rays, box_tests, stack } = caster.statistics();
            let mean = box_tests as f64 / rays as f64;
            println!("{filled:.2} filled, {mean:.2} box tests a ray, stack {stack}");
            assert_eq!(rays, u64::from(SIDE * SIDE));
            assert!(mean <= 13.0 && mean > 1.0, "{mean}");
            assert!(stack <= surface.depth() && stack > 2, "{stack}");
        });
    }
}

/// What the kernel needs in memory for the picture of G x G: far below 24 KiB.
#[test]
fn a_mirror_picture_takes_at_most_24_kib() {
    let pyramids = 2 * Pyramid::cells(2, 8) * size_of::<Cell>();
    let functions = 2 * size_of::<Fif<2, 2>>();
    let picture = size_of::<RayCaster<'_>>();
    // a frame holds two extents, a part and two parameters
    let stack = Pyramid::MAX_DEPTH as usize * 64;
    let total = pyramids + functions + picture + stack;
    println!("{pyramids} + {functions} + {picture} + {stack} = {total}");
    assert!(total <= 24 * 1024, "{total}");
}

#[test]
fn a_surface_that_does_not_fit_its_memory_or_its_format_is_refused() {
    let fixed = example("integral of g").fixed();
    let short = Pyramid::new(&fixed, 6, &mut [Cell::ZERO; 126]).unwrap_err();
    assert_eq!(short.to_string(), "a buffer of 126 cells of the pyramid lent, 127 needed");
    let years = example("years").fixed();
    let mut memory = vec![Cell::ZERO; Pyramid::cells(3, 2)];
    let pyramid = Pyramid::new(&years, 2, &mut memory).unwrap();
    assert!(HeightField::new(&pyramid, &pyramid).unwrap_err().to_string().contains("domain along x"));
    let _ = Wide::ZERO;
}
