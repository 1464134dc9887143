//! Deep zooms agree with arbitrary precision: 64 and 128 bits where `f64` shows blocks, perturbation down to
//! a width of 1e-100.
//!
//! # Where the coordinates come from
//! Newton's iteration in 520 fractional bits, started at the published first digits of two Misiurewicz
//! points:
//! - `M_{4,1}`, `-0.1010963638 + 0.9562865108 i`, solves `z_5 = z_4` for the orbit of 0 (a spiral with three
//!   arms), as do `0.3439069960 + 0.7006200202 i` and the real `-1.5436890127`, where the two bands of the
//!   needle meet;
//! - nuclei of small copies of the set: `z_p = 0`, started at `M_{3,1} = -0.2281554936 + 1.1151425080 i`, at
//!   `M_{4,2} = -1.2963551382 + 0.4418516057 i` and, for the chaotic place, at `M_{4,1}`. A nucleus of period
//!   `p` near a Misiurewicz point is `~lambda^-p` away from it, its copy `~lambda^-2p` large: the periods are
//!   chosen so that the copy fills about a tenth of the view.
//!
//! - between seahorses, where orbits take thousands of iterations: the nucleus of period 8007 nearest to
//!   `-0.743643887037158704752191506114774 + 0.131825904205311970493132056385139 i`, the end of the zoom
//!   "Mandelbrot sequence new" on Wikimedia Commons.
//!
//! `the_coordinates_are_what_they_are_said_to_be` follows the orbits and checks both equations to the last
//! digits.

use attractor::Error;
use attractor::escape::{Arithmetic, DeepMandelbrot, DeepView, OrbitPoint};
use attractor::num::Complex;
use attractor::num::Limbs;
use attractor::plane::Field;
use embedded_graphics::geometry::Size;
use num_bigint::{BigInt, Sign};

const LIMBS: usize = 12;

/// What the orbit of 0 does at a place.
enum Kind {
    /// `z_5 = z_4`.
    Misiurewicz,
    /// `z_p = 0`.
    Nucleus(u32),
}

struct Place {
    re: &'static str,
    im: &'static str,
    width: &'static str,
    max: u32,
    kind: Kind,
}

const PLACES: [Place; 9] = [
    Place {
        re: "-0.10109636384562216102578544573862256546380544282625",
        im: "0.95628651080914150077109605772997743580983333651053",
        width: "1e-30",
        max: 600,
        kind: Kind::Misiurewicz,
    },
    Place {
        re: "-0.22815549365396177228498592653253904365159762112307",
        im: "1.11514250803993715834441655794265638994873014695612",
        width: "1e-30",
        max: 700,
        kind: Kind::Nucleus(34),
    },
    Place {
        re: "-1.29635513817303623958400101894480453808696728365555",
        im: "0.44185160573519697390918186054989267280045414010086",
        width: "1e-30",
        max: 700,
        kind: Kind::Nucleus(31),
    },
    Place {
        re: "-0.10109636384562216102578544573862256546380544282625348387693117766078084074047058",
        im: "0.95628651080914150077109605772997743580983333651052917003431432150052465906571673",
        width: "1e-60",
        max: 1000,
        kind: Kind::Misiurewicz,
    },
    Place {
        re: "-0.22815549365396181921457201409910207887969968012743741104577670303254204137130817",
        im: "1.11514250803993735974576463631487868002088899591924130412322572581309247383515200",
        width: "1e-60",
        max: 1200,
        kind: Kind::Nucleus(65),
    },
    Place {
        re: "-1.29635513817303621680830447784551060197279921968606146204176783750494863877796664",
        im: "0.44185160573519660121284858017442289624023451877396908232414922248575215116448564",
        width: "1e-60",
        max: 1200,
        kind: Kind::Nucleus(58),
    },
    Place {
        re: "-0.10109636384562216102578544573862256546380544282625348387693117766078084074047058427482121981051677903340453191",
        im: "0.95628651080914150077109605772997743580983333651052917003431432150052465906571673252697841078733980720434447249",
        width: "1e-100",
        max: 1500,
        kind: Kind::Misiurewicz,
    },
    Place {
        re: "-0.22815549365396181921457201409912600673739835117451009270386201769628603099234657377944451523226489491874662090",
        im: "1.11514250803993735974576463631501406818877809046795753924225444566149377556594720588220938055916567965341089893",
        width: "1e-100",
        max: 2000,
        kind: Kind::Nucleus(105),
    },
    Place {
        re: "-1.29635513817303621680830447784528226626573574844788965989775373437658283646656950419705479937689642448160117166",
        im: "0.44185160573519660121284858017498694884009686670289384049246002968454720003912446200889312161452904430664647486",
        width: "1e-100",
        max: 2000,
        kind: Kind::Nucleus(95),
    },
];

/// A copy of period 245 wound into a spiral: neighbouring pixels share nothing, and bits far behind a pixel
/// decide.
const CHAOTIC: Place = Place {
    re: "-0.10109636384562216102578544573874555904580300638820556440768887442333163856573890",
    im: "0.95628651080914150077109605773014301122275521289360319025125884680254763722810216",
    width: "1e-60",
    max: 3500,
    kind: Kind::Nucleus(245),
};

/// Orbits of thousands of iterations: 62 bits.
const SEAHORSE: Place = Place {
    re: "-0.743643887037158704752191506114779778215256207948181289816883901819",
    im: "0.131825904205311970493132056385140678972952279328918966209127677466",
    width: "1e-27",
    max: 20_000,
    kind: Kind::Nucleus(8007),
};

/// Where the two bands of the real axis meet, a root of `c^3 + 2 c^2 + 2 c + 2`.
const BANDS: Place = Place {
    re: "-1.54368901269207636157085597180174798652520329765098",
    im: "0",
    width: "1e-30",
    max: 1000,
    kind: Kind::Misiurewicz,
};

/// Right of the cardioid.
const RIGHT: Place = Place {
    re: "0.34390699597256808839552244509646392712025143331748",
    im: "0.70062002023500493132272301205745010644179015660561",
    width: "1e-30",
    max: 1000,
    kind: Kind::Misiurewicz,
};

/// Fixed point in any number of bits.
struct Exact {
    bits: u32,
}

impl Exact {
    fn number<const N: usize>(&self, limbs: &Limbs<N>) -> BigInt {
        let sign = if limbs.is_negative() { Sign::Minus } else { Sign::Plus };
        let magnitude = limbs.magnitude();
        let number = BigInt::from_slice(sign, magnitude.limbs());
        let up = i64::from(self.bits) - i64::from(Limbs::<N>::FRACTION);
        assert!(up >= 0);
        number << up
    }

    fn step(&self, (x, y): (&BigInt, &BigInt), c: &(BigInt, BigInt)) -> (BigInt, BigInt) {
        let (xx, yy, sum) = (x * x, y * y, x + y);
        let norm = &xx + &yy;
        let cross: BigInt = &sum * &sum - norm;
        (((xx - yy) >> self.bits) + &c.0, (cross >> self.bits) + &c.1)
    }

    fn dwell(&self, c: &(BigInt, BigInt), max: u32) -> u32 {
        let four = BigInt::from(4) << (2 * self.bits);
        let (mut x, mut y) = c.clone();
        for count in 0..max {
            if &x * &x + &y * &y > four {
                return count;
            }
            (x, y) = self.step((&x, &y), c);
        }
        max
    }
}

/// Pixels of a picture that differ from arbitrary precision, pixels inside, and the number of different
/// dwells.
fn differences<const N: usize>(picture: &DeepMandelbrot<'_, N>, bits: u32) -> (u32, u32, usize) {
    let exact = Exact { bits };
    let size = picture.size();
    let (mut differ, mut inside, mut dwells) = (0, 0, std::collections::BTreeSet::new());
    for y in 0..size.height {
        for (x, dwell) in (0..).zip(picture.row(y, 0..size.width)) {
            let point = picture.view().point(x, y);
            let c = (exact.number(&point.re), exact.number(&point.im));
            let expected = exact.dwell(&c, picture.max_dwell());
            differ += u32::from(dwell.count != expected);
            inside += u32::from(expected == picture.max_dwell());
            dwells.insert(expected);
        }
    }
    (differ, inside, dwells.len())
}

#[test]
fn the_coordinates_are_what_they_are_said_to_be() {
    let exact = Exact { bits: 32 * LIMBS as u32 };
    for place in PLACES.iter().chain([&CHAOTIC, &SEAHORSE, &BANDS, &RIGHT]) {
        let number = |text: &str| exact.number(&text.parse::<Limbs<LIMBS>>().unwrap());
        let c = (number(place.re), number(place.im));
        let (mut z, mut orbit) = ((BigInt::ZERO, BigInt::ZERO), Vec::new());
        let steps = match place.kind {
            Kind::Misiurewicz => 5,
            Kind::Nucleus(period) => period,
        };
        // an error of the last digit grows with the derivative
        let (mut derivative, mut growth) = ((0.0_f64, 0.0_f64), 0.0_f64);
        for _ in 0..steps {
            let float =
                |v: &BigInt| (v >> (exact.bits - 40)).to_string().parse::<f64>().unwrap() / 2_f64.powi(40);
            let ((x, y), (a, b)) = ((float(&z.0), float(&z.1)), derivative);
            derivative = (2.0 * (x * a - y * b) + 1.0, 2.0 * (x * b + y * a));
            growth = growth.max(derivative.0.hypot(derivative.1).log2());
            z = exact.step((&z.0, &z.1), &c);
            orbit.push(z.clone());
        }
        let last = orbit.last().unwrap();
        let (re, im) = match place.kind {
            Kind::Misiurewicz => {
                let before = &orbit[orbit.len() - 2];
                (&last.0 - &before.0, &last.1 - &before.1)
            }
            Kind::Nucleus(_) => last.clone(),
        };
        let digits = place.re.len() as f64 - 4.0;
        let allowed = f64::from(exact.bits) - digits * 10_f64.log2() + growth + 12.0;
        let residue = re.bits().max(im.bits()) as f64;
        assert!(residue < allowed, "{}: 2^{residue} of 2^{allowed}", place.re);
        // and the equation means something: the limit is far below the orbit itself
        assert!(allowed < f64::from(exact.bits) - 40.0, "{allowed}");
    }
}

#[test]
fn perturbation_agrees_with_arbitrary_precision_down_to_1e_100() {
    const SIDE: u32 = 32;
    let mut inside_anywhere = 0;
    for place in &PLACES {
        let view = DeepView::<LIMBS>::parse(place.re, place.im, place.width, Size::new(SIDE, SIDE)).unwrap();
        let mut orbit = vec![OrbitPoint::default(); place.max as usize];
        let picture = DeepMandelbrot::new_in(view, place.max, Arithmetic::Perturbed, &mut orbit).unwrap();
        let (differ, inside, dwells) = differences(&picture, 32 * LIMBS as u32);
        println!(
            "width {}: {differ} of {} differ, {inside} inside, {dwells} dwells, reference of {} points",
            place.width,
            SIDE * SIDE,
            picture.reference_len()
        );
        assert!(differ * 1000 <= 5 * SIDE * SIDE, "{}: {differ}", place.width);
        assert!(dwells > 10, "{}: only {dwells} different dwells", place.width);
        inside_anywhere += inside;
    }
    assert!(inside_anywhere > 50, "{inside_anywhere}");
}

/// The picture of a place in the arithmetic that suits it, compared.
fn check<const N: usize>(
    place: (&str, &str, &str),
    side: u32,
    max: u32,
    arithmetic: Arithmetic,
    allowed: u32,
) {
    let (re, im, width) = place;
    let view = DeepView::<N>::parse(re, im, width, Size::new(side, side)).unwrap();
    let mut orbit = vec![OrbitPoint::default(); DeepMandelbrot::orbit_points(&view, max)];
    let picture = DeepMandelbrot::new(view, max, &mut orbit).unwrap();
    assert_eq!(picture.arithmetic(), arithmetic, "{re} {width}");
    let (differ, inside, dwells) = differences(&picture, 32 * N as u32);
    let pixels = side * side;
    println!(
        "{arithmetic:?}, {}, pitch 2^{}: {differ} of {pixels} differ, {inside} inside, {dwells} dwells",
        &re[..re.len().min(9)],
        view.pitch_exponent()
    );
    assert!(differ * 1000 <= allowed * pixels, "{re} {width}: {differ}");
    assert!(dwells > 8 && 3 * inside < 2 * pixels, "{re} {width}: {dwells}");
}

#[test]
fn perturbation_agrees_where_neighbours_share_nothing() {
    let place = (CHAOTIC.re, CHAOTIC.im, CHAOTIC.width);
    check::<LIMBS>(place, 32, CHAOTIC.max, Arithmetic::Perturbed, 5);
    let place = (SEAHORSE.re, SEAHORSE.im, SEAHORSE.width);
    check::<7>(place, 15, SEAHORSE.max, Arithmetic::PerturbedLong, 5);
}

/// How many different points `f64` has for the columns of a view.
fn columns_in_f64<const N: usize>(view: &DeepView<N>) -> usize {
    let columns = (0..view.size().width).map(|x| {
        let top = view.point(x, 0).re.top64();
        (top as f64).to_bits()
    });
    columns.collect::<std::collections::BTreeSet<_>>().len()
}

#[test]
fn wide_words_agree_with_arbitrary_precision_where_float_shows_blocks() {
    const SIDE: u32 = 40;
    let size = Size::new(SIDE, SIDE);
    for (re, im, width, max, arithmetic) in [
        ("-1.29635513817303622", "0.44185160573519660", "5e-15", 1000, Arithmetic::Word64),
        ("-1.29635513817303622", "-0.44185160573519660", "8e-15", 1000, Arithmetic::Word64),
        ("-2", "0", "6e-15", 1000, Arithmetic::Word64),
        ("-2", "0", "1e-32", 1500, Arithmetic::Word128),
        (PLACES[2].re, PLACES[2].im, "4e-31", 1500, Arithmetic::Word128),
        (PLACES[1].re, PLACES[1].im, "1e-30", 1500, Arithmetic::Word128),
    ] {
        let view = DeepView::<LIMBS>::parse(re, im, width, size).unwrap();
        let picture = DeepMandelbrot::new_in(view, max, arithmetic, &mut []).unwrap();
        let distinct = columns_in_f64(&view);
        let (differ, inside, dwells) = differences(&picture, 32 * LIMBS as u32);
        println!(
            "{arithmetic:?}, width {width}: {differ} of {} differ, {inside} inside, {dwells} dwells, {distinct} columns in f64",
            SIDE * SIDE
        );
        assert!(differ * 1000 <= 3 * SIDE * SIDE, "{width}: {differ}");
        assert!(dwells > 5, "{width}: {dwells}");
        assert!(distinct < SIDE as usize, "f64 would do: {distinct}");
    }
}

#[test]
fn the_default_arithmetic_is_right_where_it_ends() {
    let width = |exponent: i32, side: u32| format!("{:e}", f64::from(side) * 1.1 * 2_f64.powi(exponent));
    let chaotic = (CHAOTIC.re, CHAOTIC.im);
    let needle = ("-1.99999911758766165543764649311537154663", "0");
    for (re, im) in [(PLACES[6].re, PLACES[6].im), (PLACES[8].re, PLACES[8].im), needle, ("0", "1"), chaotic]
    {
        check::<LIMBS>((re, im, &width(-44, 40)), 40, 1000, Arithmetic::Word64, 3);
        check::<LIMBS>((re, im, &width(-104, 32)), 32, 1000, Arithmetic::Word128, 3);
    }
    let (re, im) = (SEAHORSE.re, SEAHORSE.im);
    check::<7>((re, im, &width(-44, 30)), 30, 4000, Arithmetic::Word128, 3);
    check::<7>((re, im, &width(-72, 20)), 20, 14_000, Arithmetic::Word128, 3);
}

#[test]
fn the_seam_between_128_bits_and_perturbation_shows_nothing() {
    const SIDE: u32 = 16;
    const MAX: u32 = 1000;
    let side_of = |exponent| Arithmetic::of(exponent, MAX);
    let seam = (-200..0).find(|e| side_of(*e) == Arithmetic::Word128).unwrap();
    assert_eq!(side_of(seam - 1), Arithmetic::Perturbed);
    let mut orbit = [OrbitPoint::default(); MAX as usize];
    let of = |place: &Place| (place.re, place.im);
    let mut beyond = 0;
    for (re, im) in [
        ("-2", "0"),
        ("0", "1"),
        of(&BANDS),
        of(&RIGHT),
        of(&PLACES[0]),
        of(&PLACES[1]),
        of(&PLACES[2]),
        of(&PLACES[4]),
        of(&PLACES[5]),
        of(&CHAOTIC),
    ] {
        for exponent in [seam, seam - 1] {
            let width = format!("{:e}", f64::from(SIDE) * 1.1 * 2_f64.powi(exponent));
            let view = DeepView::<LIMBS>::parse(re, im, &width, Size::new(SIDE, SIDE)).unwrap();
            assert_eq!(view.pitch_exponent(), exponent);
            let picture = |arithmetic, orbit| DeepMandelbrot::new_in(view, MAX, arithmetic, orbit);
            let words = picture(Arithmetic::Word128, &mut []).unwrap();
            let (by_words, inside, dwells) = differences(&words, 32 * LIMBS as u32);
            let perturbed = picture(Arithmetic::Perturbed, &mut orbit).unwrap();
            let (by_perturbation, ..) = differences(&perturbed, 32 * LIMBS as u32);
            println!(
                "pitch 2^{exponent}, {}: {by_words} differ in 128 bits, {by_perturbation} by perturbation, \
                 {inside} inside, {dwells} dwells",
                &re[..re.len().min(9)]
            );
            // beyond the seam 128 bits are not promised anything: a pixel of the 2560 differs
            let place = format!("{re} 2^{exponent}");
            assert_eq!(by_perturbation, 0, "{place}");
            if exponent == seam || re == "-2" {
                assert_eq!(by_words, 0, "{place}");
            }
            beyond += by_words;
            assert!(dwells > 2 && 3 * inside < 2 * SIDE * SIDE, "{place}: {inside} {dwells}");
        }
    }
    assert!(beyond <= 1, "{beyond}");
}

#[test]
fn bad_coordinates_are_told_from_good_ones() {
    let size = Size::new(16, 16);
    let digits = format!("0.{}", "7".repeat(500));
    for (re, im) in [(digits.as_str(), "0"), ("0", digits.as_str())] {
        let error = DeepView::<12>::parse(re, im, "1e-90", size).unwrap_err();
        assert!(matches!(error, Error::Capacity { needed: 500, capacity: 114, .. }), "{error}");
    }
    let error = DeepView::<12>::parse(&digits, "0", "1e-90", size).unwrap_err();
    assert!(matches!(error, Error::Capacity { needed: 500, capacity: 114, .. }), "{error}");
    assert!(error.to_string().contains("500") && error.to_string().contains("114"));
    // where they fit nothing is lost: the number is the nearest one
    let view = DeepView::<56>::parse(&digits, "0", "1e-90", size).unwrap();
    let exact = Exact { bits: Limbs::<56>::FRACTION };
    let sevens =
        (BigInt::from(7) << exact.bits) * (BigInt::from(10).pow(500) - 1) / 9 / BigInt::from(10).pow(500);
    let off: BigInt = exact.number(&view.centre().re) - sevens;
    assert!(off.bits() <= 1, "{off}");
    for width in ["0", "-0", "-1e-90"] {
        let error = DeepView::<12>::parse("0", "0", width, size).unwrap_err();
        assert!(matches!(error, Error::OutOfRange { what: "width of the view", .. }), "{error}");
    }
    assert!(matches!(
        DeepView::<12>::parse("0", "0", "tiny", size),
        Err(Error::Malformed { position: 0, .. })
    ));
    // a lent orbit names the length it needs
    let view = DeepView::<12>::parse("0", "1", "1e-90", size).unwrap();
    for (max, needed) in [(700, 700), (5000, 10_000)] {
        assert_eq!(DeepMandelbrot::orbit_points(&view, max), needed);
        let error = DeepMandelbrot::new(view, max, &mut vec![OrbitPoint::default(); needed - 1]).unwrap_err();
        assert_eq!(error, Error::BufferLength { what: "points of the orbit", given: needed - 1, needed });
        assert!(error.to_string().contains(&needed.to_string()));
    }
}

#[test]
fn a_deep_picture_has_the_same_bits_everywhere() {
    // the same figure as on the Cortex-M4, at 1e-100
    let place = &PLACES[6];
    let c = Complex::new(place.re.parse().unwrap(), place.im.parse().unwrap());
    let view = DeepView::<LIMBS>::new(c, "1e-100".parse().unwrap(), Size::new(16, 16)).unwrap();
    let mut orbit = [OrbitPoint::default(); 2000];
    let picture = DeepMandelbrot::new(view, 2000, &mut orbit).unwrap();
    let dwells = (0..16).flat_map(|y| picture.row(y, 0..16));
    let hash = dwells.fold(0xcbf2_9ce4_8422_2325_u64, |hash, d| {
        (hash ^ u64::from(d.count)).wrapping_mul(0x0100_0000_01b3)
    });
    assert_eq!(hash, 0x7c85_cb0a_f342_ec14, "{hash:x}");
}
