//! Random curves by subdivision: the texts' procedures, knots, pieces, extrapolation, what is refused.

use attractor::Error;
use attractor::curve::{
    Displacement, Elbow, LineToLine, OneVariable, Part, Stop, Subdivision, TwoVariable, coast,
};
use attractor::num::{Parameter, RandomFunction, Real, Unit};
use attractor::plane::Point2;
use attractor_reference::random_curve::{self, Law};

use super::{ULP, point, stroke, worst, xy};

fn f64_of(r: RandomFunction) -> impl Fn(f64) -> f64 {
    move |t| r.at(Parameter::from_num(t)).to_num()
}

#[test]
fn random_curves_are_those_of_the_recursive_procedures() {
    let r = RandomFunction::new(5);
    let (a, b) = ((-1.0, 0.5), (2.0, 1.0));
    let knots = [point(a.0, a.1), point(b.0, b.1)];
    let stop = Stop::Parameter(Parameter::from_num(1.0 / 4096.0));
    let goes_on = |level: u32, _: (f64, f64), _: (f64, f64)| level < 12;
    let check = |name: &str, got: Vec<Point2>, law: &Law<'_>, limit: f64| {
        let want = random_curve::curve(law, &f64_of(r), &goes_on, (0.0, 1.0), a, b);
        let error = worst(got, &want);
        println!("{name}: {:.2} units of 2^-24", error / ULP);
        assert!(error < limit * ULP && error > 0.3 * ULP, "{name}: {error:e}");
    };
    let offset = Unit::from_num(0.25);
    let law = OneVariable::new(offset, 5).unwrap();
    let got = stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap());
    check("one variable", got, &Law::OneVariable(&|_| 0.25), 4.0);
    let law = TwoVariable::new(offset, 5).unwrap();
    let got = stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap());
    check("two variables", got, &Law::TwoVariable(0.25, &f64_of(r.independent())), 4.0);
    let law = LineToLine::new(offset, 5).unwrap();
    let got = stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap());
    check("line to line", got, &Law::LineToLine(&|level| 0.25 * 3.0 / f64::from(1 << level)), 4.0);
    for beta in [1.0, 1.5, 2.0, 2.5, 3.0] {
        let law = LineToLine::from_spectrum(offset, Real::from_num(beta), 5).unwrap();
        let got = stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap());
        let hurst = (beta - 1.0) / 2.0;
        check("spectrum", got, &Law::LineToLine(&|level| 0.75 * (-hurst * f64::from(level)).exp2()), 8.0);
        let sigma = random_curve::elbow_deviations(0.25, beta, 32);
        let law = Elbow::new(offset, Real::from_num(beta), 5).unwrap();
        for (level, want) in (0..).zip(&sigma) {
            assert!((law.standard_deviation(level).to_num::<f64>() - want).abs() < 1e-7);
        }
        let got = stroke(Subdivision::<_, 12>::new(&law, &knots, stop).unwrap());
        check("elbow", got, &Law::OneVariable(&|level| sigma[level as usize]), 24.0);
    }
}

/// The textbook's recursion with the stopping rules of both texts, where no part is so close to the limit
/// that a rounding decides.
#[test]
fn lengths_and_norms_stop_as_in_the_texts() {
    let (a, b) = ((-1.0, 0.5), (2.0, 1.0));
    let knots = [point(a.0, a.1), point(b.0, b.1)];
    for seed in 0..20 {
        let r = RandomFunction::new(seed);
        let law = OneVariable::new(Unit::from_num(0.25), seed).unwrap();
        let reference = Law::OneVariable(&|_| 0.25);
        let limit = 0.031;
        let norm = |_: u32, p: (f64, f64), q: (f64, f64)| (p.0 - q.0).abs() + (p.1 - q.1).abs() >= limit;
        let length = |_: u32, p: (f64, f64), q: (f64, f64)| (p.0 - q.0).hypot(p.1 - q.1) >= limit;
        for (stop, goes_on) in [
            (Stop::Norm(Real::from_num(limit)), &norm as &dyn Fn(u32, (f64, f64), (f64, f64)) -> bool),
            (Stop::Length(Real::from_num(limit)), &length),
        ] {
            let got = stroke(Subdivision::<_, 24>::new(&law, &knots, stop).unwrap());
            let want = random_curve::curve(&reference, &f64_of(r), goes_on, (0.0, 1.0), a, b);
            assert!(worst(got, &want) < 4.0 * ULP, "{seed}");
            assert!(want.len() > 100);
        }
        // the elbow of the course unit: `fract`, down to a minimum length
        let sigma = random_curve::elbow_deviations(0.25, 2.5, 32);
        let elbow = Elbow::new(Unit::from_num(0.25), Real::from_num(2.5), seed).unwrap();
        let stop = Stop::Length(Real::from_num(limit));
        let got = stroke(Subdivision::<_, 31>::new(&elbow, &knots, stop).unwrap());
        let reference = Law::OneVariable(&|level| sigma[level as usize]);
        let want = random_curve::curve(&reference, &f64_of(r), &length, (0.0, 1.0), a, b);
        assert!(worst(got, &want) < 24.0 * ULP && want.len() > 100, "{seed}");
    }
}

/// Something checked for each of the laws.
fn with_every_law(seed: u64, mut check: impl FnMut(&str, &dyn Displacement)) {
    let offset = Unit::from_num(0.3);
    let beta = Real::from_num(1.75);
    check("elbow", &Elbow::new(offset, beta, seed).unwrap());
    check("self-similar elbow", &Elbow::self_similar(beta, seed).unwrap());
    check("line to line", &LineToLine::new(offset, seed).unwrap());
    check("line to line, spectrum", &LineToLine::from_spectrum(offset, beta, seed).unwrap());
    check("one variable", &OneVariable::new(offset, seed).unwrap());
    check("two variables", &TwoVariable::new(offset, seed).unwrap());
}

/// A law behind a reference.
struct Dyn<'a>(&'a dyn Displacement);

impl Displacement for Dyn<'_> {
    fn midpoint(&self, part: &Part) -> Point2 {
        self.0.midpoint(part)
    }

    fn check(&self, knots: &[Point2]) -> Result<(), Error> {
        self.0.check(knots)
    }
}

#[test]
fn a_curve_passes_through_its_knots() {
    let knots = [point(-2.0, 0.0), point(-1.0, 0.5), point(1.5, -0.5), point(2.0, 4.0), point(2.25, 0.0)];
    with_every_law(3, |name, law| {
        let law = Dyn(law);
        for k in [0, 1, 9] {
            let step = Stop::Parameter(Parameter::from_bits(1 << (32 - k)));
            let points = stroke(Subdivision::<_, 9>::new(&law, &knots, step).unwrap());
            assert_eq!(points.len(), (4 << k) + 1);
            assert!(points.iter().step_by(1 << k).eq(&knots), "{name}");
        }
        // by length and norm as well, as many points as each part needs
        for stop in [Stop::Length(Real::from_num(0.1)), Stop::Norm(Real::from_num(0.1))] {
            let points = stroke(Subdivision::<_, 20>::new(&law, &knots, stop).unwrap());
            let mut left = points.iter();
            assert!(knots.iter().all(|knot| left.any(|p| p == knot)), "{name}");
            assert!(points.len() > 50, "{name}");
        }
    });
    // a closed curve ends where it began
    let law = OneVariable::new(Unit::from_num(0.16), 1980).unwrap();
    let coast = Subdivision::<_, 16>::new(&law, &coast::ICELAND, Stop::Norm(Real::from_num(0.02))).unwrap();
    let coast = stroke(coast);
    let mut left = coast.iter();
    assert!(coast::ICELAND.iter().all(|cape| left.any(|p| p == cape)) && coast.first() == coast.last());
}

#[test]
fn a_piece_at_any_resolution_has_the_points_of_the_whole() {
    with_every_law(11, |name, law| pieces(name, &Dyn(law)));
}

fn pieces(name: &str, law: &Dyn<'_>) {
    let knots = [point(0.0, 0.0), point(1.0, 0.5), point(1.5, -0.5), point(3.0, 0.0)];
    let step = |k: i32| Stop::Parameter(Parameter::from_num((-f64::from(k)).exp2()));
    let whole = |k: i32| stroke(Subdivision::<_, 20>::new(law, &knots, step(k)).unwrap());
    let fine = whole(10);
    for k in 0..10 {
        assert!(fine.iter().step_by(1 << (10 - k)).eq(&whole(k)), "{name}: resolution {k}");
    }
    for (first, last) in [(0.25, 0.75), (0.5, 2.25), (1.0, 2.0), (2.875, 3.0), (-5.0, 99.0)] {
        let (t0, t1) = (Parameter::from_num(first), Parameter::from_num(last));
        let piece = stroke(Subdivision::<_, 20>::new(law, &knots, step(10)).unwrap().between(t0, t1));
        let at = |t: f64| (t.clamp(0.0, 3.0) * 1024.0) as usize;
        assert_eq!(piece, fine[at(first)..=at(last)], "{name}");
    }
    // a millionth of the curve in detail that the whole never shows
    let t0 = Parameter::from_num(1.0 + 2.0_f64.powi(-20));
    let t1 = Parameter::from_num(1.0 + 2.0_f64.powi(-19));
    let detail = stroke(Subdivision::<_, 31>::new(law, &knots, step(28)).unwrap().between(t0, t1));
    let coarse = stroke(Subdivision::<_, 31>::new(law, &knots, step(20)).unwrap().between(t0, t1));
    assert_eq!((detail.len(), coarse.len()), (257, 2), "{name}");
    assert_eq!((detail[0], detail[256]), (coarse[0], coarse[1]), "{name}");
    // by length as well, on the scale of the display
    let by_length =
        |limit: f64| Subdivision::<_, 31>::new(law, &knots, Stop::Length(Real::from_num(limit))).unwrap();
    let all = stroke(by_length(0.01));
    let piece = stroke(by_length(0.01).between(Parameter::from_num(1.25), Parameter::from_num(1.5)));
    assert!(piece.len() > 10 && all.windows(piece.len()).any(|w| w == piece), "{name}");
    assert!(stroke(by_length(0.001)).len() > 2 * all.len(), "{name}");
}

#[test]
fn a_seed_repeats_the_curve_and_another_does_not() {
    let knots = [point(0.0, 0.0), point(1.0, 0.0)];
    let hash = |seed| {
        let law = Elbow::new(Unit::from_num(0.2), Real::from_num(2.0), seed).unwrap();
        stroke(Subdivision::<_, 20>::new(&law, &knots, Stop::Length(Real::from_num(0.01))).unwrap())
            .into_iter()
            .flat_map(|p| [p.x.to_bits(), p.y.to_bits()])
            .fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b as u32)).wrapping_mul(0x0100_0000_01b3))
    };
    assert_eq!(hash(1), hash(1));
    assert_ne!(hash(1), hash(2));
    assert_eq!(hash(1), HASH_OF_SEED_1, "the same on every machine: {:#x}", hash(1));
}

const HASH_OF_SEED_1: u64 = 0xfe75_a9b9_2b40_6690;

#[test]
fn a_curve_continues_so_that_its_end_becomes_a_midpoint() {
    let (a, b) = (point(-1.0, 0.5), point(0.25, 1.0));
    let at = Parameter::ONE;
    for seed in 0..50 {
        let g = f64_of(RandomFunction::new(seed))(1.0);
        let g2 = f64_of(RandomFunction::new(seed).independent())(1.0);
        let offset = Unit::from_num(0.25);
        let check = |c: Point2, want: (f64, f64)| {
            let (x, y) = xy(c);
            assert!((x - want.0).abs() < 3.0 * ULP && (y - want.1).abs() < 3.0 * ULP, "{c:?} {want:?}");
        };
        // the midpoint between a and the new knot c is b again
        let c = xy(LineToLine::new(offset, seed).unwrap().extrapolated(a, b, at).unwrap());
        check(b, ((-1.0 + c.0) / 2.0, (0.5 + c.1) / 2.0 + 0.25 * (c.0 + 1.0) * g));
        let c = xy(OneVariable::new(offset, seed).unwrap().extrapolated(a, b, at).unwrap());
        let (dx, dy) = (c.0 + 1.0, c.1 - 0.5);
        check(b, (-1.0 + dx / 2.0 - 0.25 * g * dy, 0.5 + dy / 2.0 + 0.25 * g * dx));
        match TwoVariable::new(offset, seed).unwrap().extrapolated(a, b, at) {
            Ok(c) => {
                let (dx, dy) = (xy(c).0 + 1.0, xy(c).1 - 0.5);
                let (g, g2) = (0.25 * g, 0.25 * g2);
                check(b, (-1.0 + dx / 2.0 + g2 * dx - g * dy, 0.5 + dy / 2.0 + g2 * dy + g * dx));
            }
            Err(error) => panic!("{seed}: {error}"),
        }
    }
    // the kernel itself finds `b` again between the ends of the longer curve
    let half = Parameter::from_num(0.5);
    let found = |law: &dyn Displacement, c: Point2| {
        let points = stroke(Subdivision::<_, 1>::new(&Dyn(law), &[a, c], Stop::Parameter(half)).unwrap());
        assert!(points[1].x.abs_diff(b.x) < 3.0 * ULP && points[1].y.abs_diff(b.y) < 3.0 * ULP, "{points:?}");
        assert_ne!(points[1], point((xy(a).0 + xy(c).0) / 2.0, (xy(a).1 + xy(c).1) / 2.0));
    };
    for seed in 0..50 {
        let offset = Unit::from_num(0.25);
        let law = LineToLine::new(offset, seed).unwrap();
        found(&law, law.extrapolated(a, b, half).unwrap());
        let law = OneVariable::new(offset, seed).unwrap();
        found(&law, law.extrapolated(a, b, half).unwrap());
        let law = TwoVariable::new(offset, seed).unwrap();
        found(&law, law.extrapolated(a, b, half).unwrap());
        // in the other direction, and as a curve through three knots
        let before = law.extrapolated(b, a, half).unwrap();
        let knots = [before, a, b];
        let points = stroke(
            Subdivision::<_, 8>::new(&law, &knots, Stop::Parameter(Parameter::from_num(0.01))).unwrap(),
        );
        assert!(points.iter().step_by(128).eq(&knots) && points.len() == 257);
    }
    let far = OneVariable::new(Unit::ZERO, 1).unwrap().extrapolated(point(-100.0, 0.0), point(20.0, 0.0), at);
    assert!(matches!(far, Err(Error::OutOfRange { index: Some(0), .. })));
}

#[test]
fn bad_laws_and_limits_are_refused() {
    let two = [point(0.0, 0.0), point(1.0, 0.0)];
    let beta = |b: f64| Elbow::new(Unit::from_num(0.1), Real::from_num(b), 1).err();
    assert!(beta(1.0).is_none() && beta(3.0).is_none());
    for b in [0.99, 3.01, -2.0, 100.0] {
        assert!(matches!(beta(b), Some(Error::OutOfRange { what: "beta", .. })));
        assert!(Elbow::self_similar(Real::from_num(b), 1).is_err());
        assert!(LineToLine::from_spectrum(Unit::ONE, Real::from_num(b), 1).is_err());
    }
    assert!(OneVariable::new(-Unit::DELTA, 1).is_err() && TwoVariable::new(Unit::MIN, 1).is_err());
    assert!(OneVariable::from_ratio(Real::from_num(2), 1).is_err());
    let law = OneVariable::new(Unit::from_num(0.1), 1).unwrap();
    let new = |knots: &[Point2], stop| Subdivision::<_, 10>::new(&law, knots, stop).err();
    assert!(matches!(new(&[], Stop::Norm(Real::ONE)), Some(Error::TooFew { given: 0, .. })));
    assert!(matches!(new(&two[..1], Stop::Norm(Real::ONE)), Some(Error::TooFew { given: 1, .. })));
    assert!(matches!(new(&two, Stop::Norm(Real::ZERO)), Some(Error::OutOfRange { .. })));
    assert!(matches!(new(&two, Stop::Length(Real::MIN)), Some(Error::OutOfRange { .. })));
    assert!(matches!(new(&two, Stop::Parameter(Parameter::ZERO)), Some(Error::OutOfRange { .. })));
    let step = |e: f64| new(&two, Stop::Parameter(Parameter::from_num(e)));
    assert!(step(1.0 / 1024.0).is_none() && step(7.0).is_none());
    assert!(matches!(step(1.0 / 1025.0), Some(Error::Capacity { needed: 11, capacity: 10, .. })));
    let graph = LineToLine::new(Unit::ONE, 1).unwrap();
    let back = [point(0.0, 0.0), point(1.0, 0.0), point(1.0, 1.0)];
    let error = Subdivision::<_, 10>::new(&graph, &back, Stop::Norm(Real::ONE)).unwrap_err();
    assert_eq!(error, Error::NotIncreasing { what: "knot", index: 2 });
    // points beyond the ends of the format saturate
    let wild = TwoVariable::new(Unit::MAX, 3).unwrap();
    let ends = [Point2::new(Real::MIN, Real::MAX), point(-1.0, 1.0)];
    assert_eq!(
        Subdivision::<_, 12>::new(&wild, &ends, Stop::Parameter(Parameter::from_num(0.0005)))
            .unwrap()
            .count(),
        2049
    );
}
