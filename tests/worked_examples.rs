//! The examples that the papers print, to the last bit that their numbers allow.

use attractor::fif::{Factor, Fif, Knot};
use attractor::num::{Real, Scaling, Wide};

fn knots(points: &[(f64, f64)]) -> Vec<Knot> {
    points.iter().map(|(x, y)| Knot::new(Wide::from_num(*x), Wide::from_num(*y))).collect()
}

/// The functions of figure 1, eq. 18-23.
fn f() -> Fif<2, 1> {
    Fif::interpolating(&knots(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]), &[Scaling::from_num(0.5); 2]).unwrap()
}

fn g() -> Fif<2, 1> {
    let scaling = [Scaling::from_num(0.85), Scaling::from_num(-0.85)];
    Fif::interpolating(&knots(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]), &scaling).unwrap()
}

fn assert_interpolates<const N: usize, const D: usize>(fif: &Fif<N, D>, points: &[(f64, f64)]) {
    let got: Vec<_> = fif.knots().collect();
    assert_eq!(got.len(), points.len());
    for (knot, (x, y)) in got.iter().zip(points) {
        assert_eq!(knot.x, Wide::from_num(*x));
        assert!((knot.y.to_num::<f64>() - y).abs() < 2e-10, "{knot:?} against {y}"); // 0.85 in 31 bits
        assert_eq!(fif.at(knot.x), Real::from_num(*y), "at {x}");
    }
}

#[test]
fn f_and_g_interpolate_their_knots() {
    assert_interpolates(&f(), &[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]);
    assert_interpolates(&g(), &[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)]);
}

#[test]
fn the_integral_of_f_interpolates_0_1_2() {
    assert_interpolates(&f().integral::<2>(Wide::ZERO).unwrap(), &[(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]);
}

#[test]
fn the_integral_of_g_interpolates_0_37_40ths_1() {
    assert_interpolates(
        &g().integral::<2>(Wide::ZERO).unwrap(),
        &[(0.0, 0.0), (1.0, 37.0 / 40.0), (2.0, 1.0)],
    );
}

/// Eq. 37-40 written out: the integral has exactly the maps that the paper prints.
#[test]
fn the_integrals_have_the_maps_of_equations_37_to_40() {
    let wide = |c: &[f64]| c.iter().map(|v| Wide::from_num(*v)).collect::<Vec<_>>();
    let xs = wide(&[0.0, 1.0, 2.0]);
    let with = |alpha: [f64; 2], q: [&[f64]; 2]| {
        let (a, b) = (wide(q[0]), wide(q[1]));
        Fif::<2, 2>::from_polynomials(&xs, &alpha.map(Scaling::from_num), &[&a, &b]).unwrap()
    };
    let printed_f = with([0.25, 0.25], [&[0.0, 0.0, 0.125], &[1.0, 0.5, -0.125]]);
    assert_eq!(f().integral::<2>(Wide::ZERO).unwrap(), printed_f, "every number of f is dyadic");
    let printed_g = with([0.425, -0.425], [&[0.0, 0.0, 0.125], &[0.925, 0.5, -0.125]]);
    let integral = g().integral::<2>(Wide::ZERO).unwrap();
    for i in 0..=2048 {
        let x = Wide::from_num(f64::from(i) / 1024.0);
        let difference = integral.at_wide(x) - printed_g.at_wide(x);
        assert!(difference.abs() < 1e-9, "{x}: {difference}");
    }
}

#[test]
fn the_derivative_of_the_integral_is_the_function() {
    let f = f();
    let back = f.integral::<2>(Wide::from_num(3)).unwrap().derivative::<1>().unwrap();
    assert_eq!(f, back);
    let factor = Factor::<2, 3>::from_slope(&g(), Wide::ZERO).unwrap();
    for i in 0..=4096 {
        let x = Wide::from_num(f64::from(i) / 2048.0);
        assert!((factor.slope().at_wide(x) - g().at_wide(x)).abs() < 1e-9);
    }
}

/// f is 2/3 of itself at x = 2/3 and 4/3: its maximum, 4/3, lies there.
#[test]
fn f_reaches_four_thirds() {
    let third = Wide::from_num(4) / 3;
    assert!((f().at_wide(third).to_num::<f64>() - 4.0 / 3.0).abs() < 1e-11);
}
