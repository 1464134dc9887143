//! What core's constructors refuse, with the error's type and, because people read it, its exact text.

use attractor::Error;
use attractor::escape::{Julia, MAX_DWELL, Mandelbrot, View};
use attractor::fif::{Cell, Factor, Fif, Knot, Pyramid};
use attractor::ifs::catalogue::SIERPINSKI_CARPET;
use attractor::ifs::{Affine, Ifs};
use attractor::num::Complex;
use attractor::num::{Alias, Real, Scaling, Unit, Vec3, Wide};
use attractor::plane::{Bounds2, Point2, Window};
use attractor::trace::{Camera, Environment, Filter, Finish, HeightField, Light, RayCaster, Sampling};
use embedded_graphics::geometry::Size;

fn wide(v: f64) -> Wide {
    Wide::from_num(v)
}

fn vec3(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z))
}

/// The text of a refusal.
fn text<T>(result: Result<T, Error>) -> String {
    match result {
        Ok(_) => panic!("accepted"),
        Err(error) => error.to_string(),
    }
}

/// A function through points with these scalings.
fn through(points: &[(f64, f64)], scaling: &[f64]) -> Result<Fif<3, 2>, Error> {
    let knots: Vec<_> = points.iter().map(|(x, y)| Knot::new(wide(*x), wide(*y))).collect();
    let scaling: Vec<_> = scaling.iter().map(|a| Scaling::from_num(*a)).collect();
    Fif::interpolating(&knots, &scaling)
}

fn tent() -> Fif<3, 2> {
    through(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)], &[0.5, 0.5]).expect("figure 1's f")
}

#[test]
fn knots_must_increase() {
    let unsorted = through(&[(0.0, 0.0), (2.0, 1.0), (1.0, 0.0)], &[0.5, 0.5]);
    assert_eq!(unsorted, Err(Error::NotIncreasing { what: "knot", index: 2 }));
    assert_eq!(text(unsorted), "knot 2 is not to the right of knot 1");
    let repeated = through(&[(1.0, 0.0), (1.0, 1.0), (2.0, 0.0)], &[0.5, 0.5]);
    assert_eq!(text(repeated), "knot 1 is not to the right of knot 0");
    let places = [wide(0.0), wide(0.0)];
    let polynomials: [&[Wide]; 1] = [&[Wide::ZERO]];
    let equal = Fif::<1, 1>::from_polynomials(&places, &[Scaling::ZERO], &polynomials);
    assert_eq!(equal, Err(Error::NotIncreasing { what: "knot", index: 1 }));
}

#[test]
fn knots_scalings_and_polynomials_belong_together() {
    assert_eq!(text(through(&[], &[])), "0 knots given, at least 2 needed");
    assert_eq!(text(through(&[(0.0, 0.0)], &[])), "1 knots given, at least 2 needed");
    let five = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (3.0, 1.0), (4.0, 0.0)];
    assert_eq!(text(through(&five, &[0.1; 4])), "4 maps needed, there is room for 3");
    assert_eq!(text(through(&five[..3], &[0.1; 3])), "3 vertical scalings given, 2 expected");
    assert!(matches!(
        through(&five[..3], &[0.1]),
        Err(Error::LengthMismatch { what: "vertical scalings", given: 1, expected: 2 })
    ));
    let places = [wide(0.0), wide(1.0)];
    let constant: [&[Wide]; 2] = [&[], &[]];
    let two = Fif::<2, 1>::from_polynomials(&places, &[Scaling::ZERO], &constant);
    assert_eq!(text(two), "2 polynomials given, 1 expected");
    let none = Fif::<2, 1>::from_polynomials(&[], &[], &[]);
    assert_eq!(none, Err(Error::TooFew { what: "knots", given: 0, at_least: 2 }));
    let square: [&[Wide]; 1] = [&[Wide::ZERO, Wide::ZERO, Wide::ONE]];
    let steep = Fif::<2, 1>::from_polynomials(&places, &[Scaling::ZERO], &square);
    assert_eq!(text(steep), "2 powers of x needed, there is room for 1");
    let knots = places.map(|x| Knot::new(x, x));
    let constant = Fif::<2, 0>::interpolating(&knots, &[Scaling::ZERO]);
    assert_eq!(text(constant), "1 powers of x needed, there is room for 0");
}

#[test]
fn a_scaling_is_inside_minus_one_and_one() {
    assert_eq!(Scaling::checked_from_num(1.0), None, "the format has no 1");
    let flipped = through(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)], &[0.5, -1.0]);
    assert!(matches!(flipped, Err(Error::OutOfRange { what: "vertical scaling", index: Some(1), .. })));
    assert_eq!(
        text(flipped),
        "vertical scaling [1] is -1, it must lie between -0.99999999953434 and 0.99999999953434"
    );
}

#[test]
fn values_stay_below_128() {
    let high = through(&[(0.0, 0.0), (1.0, 128.0), (2.0, 0.0)], &[0.5, 0.5]);
    assert_eq!(text(high), "y of knot [1] is 128, it must lie between -128 and 128");
    let low = through(&[(0.0, -200.5), (1.0, 0.0)], &[0.5]);
    assert_eq!(text(low), "y of knot [0] is -200.5, it must lie between -128 and 128");
    // all knots in range, but not the function: 100 / (1 - 0.75)
    let rough = through(&[(0.0, 0.0), (1.0, 100.0), (2.0, 0.0)], &[0.75, 0.75]);
    assert!(matches!(rough, Err(Error::OutOfRange { what: "range of the function", index: None, .. })));
    let initial = tent().integral::<3>(wide(-128.0));
    assert_eq!(text(initial), "initial value is -128, it must lie between -128 and 128");
    let wild =
        through(&[(0.0, 100.0), (1000.0, 100.0)], &[0.0]).expect("a constant").integral::<3>(Wide::ZERO);
    assert!(matches!(wild, Err(Error::OutOfRange { .. })));
}

/// The least number of the format has no absolute value: it once passed as small.
#[test]
fn the_least_number_is_no_value() {
    let knots = [Knot::new(Wide::ZERO, Wide::MIN), Knot::new(Wide::ONE, Wide::ZERO)];
    let refused = Fif::<1, 1>::interpolating(&knots, &[Scaling::ZERO]);
    assert_eq!(text(refused), "y of knot [0] is -32768 or less, it must lie between -128 and 128");
    assert!(tent().integral::<3>(Wide::MIN).is_err());
}

#[test]
fn maps_that_disagree_or_are_too_steep_have_no_calculus() {
    let places = [0.0, 1.0, 2.0].map(wide);
    let jump: [&[Wide]; 2] = [&[Wide::ZERO], &[Wide::ONE]];
    let apart = Fif::<2, 1>::from_polynomials(&places, &[Scaling::ZERO; 2], &jump);
    assert_eq!(apart, Err(Error::NotJoined { knot: 1 }));
    assert_eq!(text(apart), "the maps on both sides of knot 1 disagree there");
    assert_eq!(
        text(tent().derivative::<1>()),
        "map 0 has a vertical scaling no smaller than its horizontal one: no derivative exists"
    );
    assert!(matches!(Factor::<3, 3>::new(&tent()), Err(Error::NotDifferentiable { map: 0 })));
    assert_eq!(text(tent().integral::<1>(Wide::ZERO)), "2 powers of x needed, there is room for 1");
}

#[test]
fn a_pyramid_needs_its_memory() {
    let (f, mut memory) = (tent(), [Cell::ZERO; 31]);
    assert_eq!(text(Pyramid::new(&f, 5, &mut memory)), "a buffer of 31 cells of the pyramid lent, 63 needed");
    let deep = Pyramid::new(&f, 17, &mut memory);
    assert_eq!(text(deep), "17 levels needed, there is room for 16");
}

#[test]
fn a_surface_lies_inside_64() {
    let high = through(&[(0.0, 10.0), (1.0, 10.0)], &[0.0]).expect("a constant");
    let far = through(&[(-70.0, 1.0), (1.0, 1.0)], &[0.0]).expect("a constant");
    let whole = through(&[(-64.0, 1.0), (64.0, 1.0)], &[0.0]).expect("a constant");
    let (mut a, mut b, mut c) = ([Cell::ZERO; 1], [Cell::ZERO; 1], [Cell::ZERO; 1]);
    let high = Pyramid::new(&high, 0, &mut a).expect("one cell");
    let far = Pyramid::new(&far, 0, &mut b).expect("one cell");
    let whole = Pyramid::new(&whole, 0, &mut c).expect("one cell");
    assert!(matches!(
        HeightField::new(&high, &high),
        Err(Error::OutOfRange { what: "height", index: None, value, .. }) if value >= 100
    ));
    assert_eq!(text(HeightField::new(&far, &far)), "domain along x is -70, it must lie between -64 and 64");
    // 128 is wider than the format of a width
    assert_eq!(text(HeightField::new(&far, &whole)), "domain along x is -70, it must lie between -64 and 64");
    assert_eq!(
        text(HeightField::new(&whole, &whole)),
        "domain along x is 64, it must lie between -64 and 64"
    );
}

#[test]
fn probabilities_add_up_to_one() {
    let half = Affine::from_thousandths([500, 0, 0, 500, 0, 0]);
    let part = |thousandths: i32| Unit::from_bits(((i64::from(thousandths) << 30) / 1000) as i32);
    let system = |shares: &[i32]| {
        let shares: Vec<_> = shares.iter().map(|s| part(*s)).collect();
        Ifs::<2>::new(&[half, half], &shares)
    };
    assert!(system(&[500, 500]).is_ok());
    assert_eq!(text(system(&[500, 250])), "the probabilities add up to 0.75, not to 1");
    assert!(matches!(system(&[750, 500]), Err(Error::Probabilities { sum }) if sum == 1.25));
    let limits = "it must lie between 0.000000000931323 and 1";
    assert_eq!(text(system(&[1500, -500])), format!("probability [1] is -0.5, {limits}"));
    // a map that is never chosen would be missing from the picture without a word
    assert_eq!(text(system(&[1000, 0])), format!("probability [1] is 0, {limits}"));
    assert!(matches!(system(&[0, 0]), Err(Error::OutOfRange { what: "probability", index: Some(0), .. })));
    assert_eq!(text(system(&[1000])), "1 probabilities given, 2 expected");
    assert!(matches!(system(&[1000, 0, 0]), Err(Error::LengthMismatch { given: 3, expected: 2, .. })));
}

#[test]
fn maps_must_contract_and_fit() {
    let half = Affine::from_thousandths([500, 0, 0, 500, 0, 0]);
    let one = Unit::ONE;
    assert_eq!(text(Ifs::<2>::new(&[], &[])), "0 maps given, at least 1 needed");
    assert_eq!(text(Ifs::<2>::new(&[half; 3], &[one; 3])), "3 maps needed, there is room for 2");
    assert_eq!(text(SIERPINSKI_CARPET.ifs::<4>()), "8 maps needed, there is room for 4");
    // a rotation, a stretching, and a shear with small eigenvalues that still stretches
    for linear in [[0, -1000, 1000, 0], [500, 0, 0, 1200], [500, 900, 0, 500]] {
        let [a, b, c, d] = linear;
        let map = Affine::from_thousandths([a, b, c, d, 0, 0]);
        let refused = Ifs::<2>::proportional_to_determinant(&[half, map]);
        assert_eq!(refused, Err(Error::NotContractive { map: 1 }));
        assert_eq!(text(refused), "map 1 is not a contraction");
        let half_each = [Unit::from_bits(1 << 29); 2];
        assert_eq!(Ifs::<2>::new(&[half, map], &half_each), Err(Error::NotContractive { map: 1 }));
    }
    let far = Affine::from_thousandths([500, 0, 0, 500, 40_000, 0]);
    assert_eq!(
        text(Ifs::<1>::proportional_to_determinant(&[far])),
        "fixed point of the map [0] is 80, it must lie between -64 and 64"
    );
}

#[test]
fn an_alias_table_needs_weights() {
    assert_eq!(text(Alias::<4>::new(&[])), "0 positive weights given, at least 1 needed");
    assert_eq!(text(Alias::<4>::new(&[0, 0])), "0 positive weights given, at least 1 needed");
    assert_eq!(text(Alias::<2>::new(&[1, 2, 3])), "3 weights needed, there is room for 2");
    assert_eq!(text(Alias::<300>::new(&[1; 300])), "300 weights needed, there is room for 256");
}

fn point(x: f64, y: f64) -> Point2 {
    Point2::new(Real::from_num(x), Real::from_num(y))
}

#[test]
fn sizes_are_from_1_to_16384() {
    let bounds = Bounds2 { min: point(0.0, 0.0), max: point(1.0, 1.0) };
    let plain = Size::new(8, 8);
    let centre = Complex::default();
    assert_eq!(text(Window::stretch(bounds, Size::new(0, 8))), "width is 0, it must lie between 1 and 16384");
    assert_eq!(
        text(View::home(Size::new(8, 1_000_000_000))),
        "height is 32768 or more, it must lie between 1 and 16384"
    );
    for size in [Size::new(8, 0), Size::zero(), Size::new(1_000_000_000, 8), Size::new(16_385, 1)] {
        for refused in [
            Window::fit(bounds, size).map(drop),
            Window::stretch(bounds, size).map(drop),
            View::home(size).map(drop),
            View::new(centre, wide(3.0), size).map(drop),
            with_caster(|caster| caster(size, 30.0).map(drop)),
        ] {
            assert!(matches!(refused, Err(Error::OutOfRange { what: "width" | "height", .. })), "{size}");
        }
    }
    assert!(Window::stretch(bounds, plain).is_ok());
}

#[test]
fn a_window_has_an_area() {
    let size = Size::new(8, 8);
    let bounds = |a, b| Bounds2 { min: a, max: b };
    for (a, b) in [((0.0, 0.0), (0.0, 1.0)), ((0.0, 1.0), (1.0, 1.0)), ((1.0, 0.0), (0.0, 1.0))] {
        let refused = Window::stretch(bounds(point(a.0, a.1), point(b.0, b.1)), size);
        assert_eq!(refused, Err(Error::Degenerate { what: "area of the window" }));
        assert_eq!(text(refused), "area of the window is zero");
    }
    // a line and a point can be fitted, a box turned round cannot
    assert!(Window::fit(bounds(point(0.0, 1.0), point(1.0, 1.0)), size).is_ok());
    assert!(Window::fit(bounds(point(1.0, 1.0), point(1.0, 1.0)), size).is_ok());
    for (a, b) in [((1.0, 0.0), (0.0, 1.0)), ((0.0, 1.0), (1.0, 0.0))] {
        let refused = Window::fit(bounds(point(a.0, a.1), point(b.0, b.1)), size);
        assert_eq!(refused, Err(Error::Degenerate { what: "area of the window" }));
    }
}

#[test]
fn a_view_is_wide_enough_and_inside_the_plane() {
    let view =
        |re: f64, width: f64| View::new(Complex::new(wide(re), Wide::ZERO), wide(width), Size::new(64, 64));
    let limits = "it must lie between 0.00000011920929 and 32767.999999999999996";
    assert_eq!(text(view(0.0, 0.0)), format!("width of the view is 0, {limits}"));
    assert_eq!(text(view(0.0, -3.0)), format!("width of the view is -3, {limits}"));
    // 64 pixels finer than 2^-29 each
    assert!(view(0.0, 0.5_f64.powi(23)).is_ok());
    assert!(matches!(view(0.0, 0.5_f64.powi(24)), Err(Error::OutOfRange { what: "width of the view", .. })));
    assert!(text(view(32_767.0, 4.0)).starts_with("real part at an edge is 32768 or more, "));
    let high = View::new(Complex::new(Wide::ZERO, wide(-32_767.0)), wide(4.0), Size::new(64, 64));
    assert!(matches!(high, Err(Error::OutOfRange { what: "imaginary part at an edge", .. })));
}

#[test]
fn orbits_need_a_limit_and_a_constant_of_the_disc() {
    let view = View::home(Size::new(8, 8)).expect("a view");
    assert_eq!(text(Mandelbrot::new(view, 0)), "0 iterations a pixel given, at least 1 needed");
    assert_eq!(
        text(Mandelbrot::new(view, MAX_DWELL + 1)),
        "1048577 iterations a pixel needed, there is room for 1048576"
    );
    let julia = |re, im, max| Julia::new(view, Complex::new(wide(re), wide(im)), max);
    assert!(matches!(julia(0.0, 0.0, 0), Err(Error::TooFew { given: 0, at_least: 1, .. })));
    assert!(julia(-2.0, 0.0, 10).is_ok() && julia(1.25, -1.5, 10).is_ok());
    // each part is below 2, the magnitude is not
    let refused = julia(-1.5, 2.0, 10);
    assert!(
        matches!(refused, Err(Error::OutOfRange { what: "|c|", value, .. }) if value > 2.5 && value < 2.5001)
    );
    assert_eq!(text(refused), "|c| is 2.500030517578125, it must lie between 0 and 2");
    assert_eq!(text(julia(0.0, -32_768.0, 10)), "|c| is 32768 or more, it must lie between 0 and 2");
}

#[test]
fn a_camera_knows_where_it_is_where_it_looks_and_what_is_up() {
    let up = vec3(0.0, 0.0, 1.0);
    let camera =
        |eye, look_at, up, degrees: f64| text(Camera::new(eye, look_at, up, Real::from_num(degrees)));
    let (eye, origin) = (vec3(-3.0, -2.0, 4.0), vec3(0.0, 0.0, 0.0));
    assert_eq!(camera(eye, eye, up, 30.0), "distance from eye to look_at is zero");
    assert_eq!(camera(vec3(0.0, 0.0, 5.0), origin, up, 30.0), "angle between view and up is zero");
    assert_eq!(camera(vec3(0.0, 0.0, -5.0), origin, up, 30.0), "angle between view and up is zero");
    assert_eq!(camera(eye, origin, origin, 30.0), "up is zero");
    let field = |value| format!("field of view is {value}, it must lie between 1 and 120");
    assert_eq!(camera(eye, origin, up, 0.0), field("0"));
    assert_eq!(camera(eye, origin, up, 127.5), field("127.5"));
    assert_eq!(camera(eye, origin, up, -30.0), field("-30"));
    assert_eq!(Real::checked_from_num(180), None, "the format has no 180");
    assert_eq!(
        camera(vec3(0.0, 64.0, 0.0), origin, up, 30.0),
        "eye [1] is 64, it must lie between -64 and 64"
    );
    assert_eq!(
        camera(vec3(0.0, 0.0, -100.0), origin, up, 30.0),
        "eye [2] is -100, it must lie between -64 and 64"
    );
}

/// Calls with what makes a ray caster of a size and a field of view.
fn with_caster<R>(then: impl FnOnce(&dyn Fn(Size, f64) -> Result<RayCaster<'static>, Error>) -> R) -> R {
    let f: &'static Fif<3, 2> = Box::leak(Box::new(tent()));
    let memory: &'static mut [Cell] = Box::leak(Box::new([Cell::ZERO; 31]));
    let pyramid = Pyramid::new(f, 4, memory).expect("31 cells");
    let surface = HeightField::new(&pyramid, &pyramid).expect("a surface");
    let (eye, look_at, up) = (vec3(-3.0, -2.0, 4.0), vec3(1.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0));
    then(&|size, degrees| {
        let camera = Camera::new(eye, look_at, up, Real::from_num(degrees))?;
        RayCaster::new(surface, camera, size)
    })
}

#[test]
fn a_picture_is_not_too_wide_for_its_camera() {
    with_caster(|caster| {
        let refused = text(caster(Size::new(1600, 100), 30.0).map(drop));
        assert!(refused.starts_with("tangent of half the view, width plus height is 4.55"), "{refused}");
        assert!(refused.ends_with(", it must lie between 0 and 3"), "{refused}");
        assert!(caster(Size::new(100, 1600), 100.0).is_ok());
        // one pixel, and samples two pixels away from it: directions would leave ±4
        let one = caster(Size::new(1, 1), 100.0).expect("a picture of one pixel");
        let filter = Filter::Gaussian { deviation: Real::ONE, width: Real::from_num(4) };
        assert!(matches!(
            one.with_sampling(Sampling::Jittered { n: 8, seed: 1 }, filter),
            Err(Error::OutOfRange { what: "tangent of half the view, width plus height", .. })
        ));
    });
}

/// Places outside the picture once overflowed.
#[test]
fn there_is_nothing_outside_a_picture() {
    use attractor::plane::Field as _;
    with_caster(|caster| {
        let picture = caster(Size::new(16, 16), 40.0).expect("a picture");
        assert!(picture.hit(8, 8).is_some());
        for (x, y) in [(16, 8), (8, 16), (u32::MAX, u32::MAX)] {
            assert_eq!(picture.hit(x, y), None);
        }
        assert_eq!(picture.row(u32::MAX, 0..16).count(), 16);
        assert_eq!(picture.row(0, 8..u32::MAX).count(), 8);
        assert_eq!(picture.row(0, u32::MAX - 1..u32::MAX).count(), 0);
    });
}

#[test]
fn a_light_has_a_direction() {
    let refused = Light::new(vec3(0.0, 0.0, 0.0));
    assert_eq!(refused, Err(Error::Degenerate { what: "direction of the light" }));
    assert_eq!(text(refused), "direction of the light is zero");
}

#[test]
fn materials_environments_and_filters_have_ranges() {
    with_caster(|caster| {
        let picture = || caster(Size::new(16, 16), 40.0).expect("a picture");
        let unit = Unit::from_num::<f64>;
        let material = |m| text(picture().with_finish(m).map(drop));
        assert_eq!(
            material(Finish::Diffuse { ambient: unit(-0.125) }),
            "part of the material [0] is -0.125, it must lie between 0 and 1"
        );
        let (ambient, diffuse, specular) = (unit(0.0), unit(0.5), unit(1.5));
        assert_eq!(
            material(Finish::Phong { ambient, diffuse, specular, shininess: 8 }),
            "part of the material [2] is 1.5, it must lie between 0 and 1"
        );
        let environment = |e| text(picture().with_environment(e).map(drop));
        assert_eq!(
            environment(Environment::Plain(unit(1.25))),
            "tone of the environment [0] is 1.25, it must lie between 0 and 1"
        );
        assert_eq!(
            environment(Environment::Gradient { zenith: unit(1.0), horizon: unit(0.5), nadir: unit(-1.0) }),
            "tone of the environment [2] is -1, it must lie between 0 and 1"
        );
        let squares = |scale: f64, fade| {
            let (bright, dark, horizon) = (unit(1.0), unit(0.0), unit(0.5));
            let scale = Real::from_num(scale);
            environment(Environment::Checkerboard { bright, dark, horizon, scale, fade: unit(fade) })
        };
        assert_eq!(squares(0.0, 0.5), "scale of the checkerboard is 0, it must lie between 0.015625 and 64");
        assert_eq!(squares(1.0, 0.0), "fade of the checkerboard is 0, it must lie between 0.015625 and 1");
        let sampling = |s, f| text(picture().with_sampling(s, f).map(drop));
        let samples = |n| format!("samples a side is {n}, it must lie between 1 and 8");
        assert_eq!(sampling(Sampling::Grid(0), Filter::Box), samples(0));
        assert_eq!(sampling(Sampling::Grid(9), Filter::Box), samples(9));
        assert_eq!(sampling(Sampling::Jittered { n: 255, seed: 1 }, Filter::Box), samples(255));
        let gaussian = |deviation: f64, width: f64| Filter::Gaussian {
            deviation: Real::from_num(deviation),
            width: Real::from_num(width),
        };
        assert_eq!(
            sampling(Sampling::Grid(2), gaussian(0.0, 1.0)),
            "deviation of the filter is 0, it must lie between 0.125 and 4"
        );
        assert_eq!(
            sampling(Sampling::Grid(2), gaussian(0.5, 5.0)),
            "width of the filter is 5, it must lie between 1 and 4"
        );
    });
}
