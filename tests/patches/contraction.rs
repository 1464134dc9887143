//! What does not join or contract is refused; what does is bounded.

use attractor::Error;
use attractor::num::{Near, Real, Wide};
use attractor::patch::{Barycentric, Patch, ProjectedCurve, bezier, standard_curve};
use attractor_reference::patch as reference;

use super::seeded::{Words, matrix, seeded_curve};

/// What does not join is refused with the condition and by how much; what does not contract, too.
#[test]
fn maps_that_do_not_join_or_contract_are_refused() {
    let near = |v: f64| Near::from_num(v);
    let column = |a: f64, b: f64| [near(1.0 - a - b), near(a), near(b)];
    let unit = |k: usize| column(f64::from(u8::from(k == 1)), f64::from(u8::from(k == 2)));
    let map = |columns| Barycentric::from_columns(columns).unwrap();
    let left = map([unit(0), column(0.5, 0.0), unit(1)]);
    let apart = map([column(1.0, 0.25), column(0.5, 0.5), unit(2)]);
    assert_eq!(
        ProjectedCurve::new([left, apart]).unwrap_err(),
        Error::Unjoined { condition: "T_(i-1) c_1 = T_i c_0", map: 1, gap: Wide::lit("0.25") }
    );
    let loose = map([column(0.125, 0.0), column(0.5, 0.0), unit(1)]);
    assert_eq!(
        ProjectedCurve::new([loose, left]).unwrap_err(),
        Error::Unjoined { condition: "T_0 c_0 = c_0", map: 0, gap: Wide::lit("0.125") }
    );
    // the eigenvalues of x^2 - a x - b: a double one of 1 does not contract, nor does one beyond it
    for (a, b) in [(2.0, -1.0), (0.0, 1.0), (1.5, 0.0), (-1.5, 0.0)] {
        let refused = standard_curve([near(a), near(b)], [near(0.5), near(-0.1)]).unwrap_err();
        assert_eq!(refused, Error::NotContractive { map: 0 }, "{a} {b}");
    }
    assert!(matches!(ProjectedCurve::<1, 3>::new([left]), Err(Error::TooFew { what: "maps", given: 1, .. })));
    let point = Barycentric::from_columns([[Near::ONE]]).unwrap();
    assert!(matches!(
        ProjectedCurve::new([point; 2]),
        Err(Error::TooFew { what: "control points", given: 1, .. })
    ));
    assert!(matches!(ProjectedCurve::<0, 0>::from_grid(&[]), Err(Error::TooFew { given: 0, .. })));
    assert!(matches!(Patch::<1, 3, 9>::from_grid(&[]), Err(Error::TooFew { given: 1, .. })));
    assert!(matches!(Patch::<2, 1, 1>::from_grid(&[]), Err(Error::TooFew { given: 1, .. })));
    assert!(matches!(Patch::<0, 0, 0>::from_grid(&[]), Err(Error::TooFew { given: 0, .. })));
    assert!(matches!(
        Patch::<2, 3, 9>::from_grid(&[[Near::ZERO; 9]; 24]),
        Err(Error::LengthMismatch { expected: 25, .. })
    ));
}

/// The bounds of `Contraction` hold: points stay within `radius` of the ends' mean, and `levels` leave less
/// than a unit.
#[test]
fn a_contraction_bounds_what_is_left() {
    let mut words = Words(5);
    let (mut tried, mut near, mut deep) = (0, 0.0_f64, 0);
    while tried < 40 {
        let Some(curve) = seeded_curve(&mut words) else { continue };
        tried += 1;
        let contraction = curve.contraction();
        let (radius, norm) = (contraction.radius().to_num::<f64>(), contraction.norm().to_num::<f64>());
        assert!(norm < 1.0 && (1..=12).contains(&contraction.depth()));
        deep = deep.max(contraction.depth());
        let maps: Vec<_> = curve.maps().iter().map(matrix).collect();
        let distance = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum::<f64>();
        let ends = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        for index in 0..256 {
            let digits = reference::digits(index, 2, 8);
            let points = ends.map(|end| reference::phi(&maps, &digits, &end));
            let far = distance(&points[0], &[0.5, 0.0, 0.5]).max(distance(&points[1], &[0.5, 0.0, 0.5]));
            assert!(far <= radius + 1e-7, "{far} {radius}");
            near = near.max(far / radius);
            // a word of k d digits draws both ends together
            let rounds = 8 / contraction.depth();
            let word = &digits[..(rounds * contraction.depth()) as usize];
            let apart = ends.map(|end| reference::phi(&maps, word, &end));
            assert!(distance(&apart[0], &apart[1]) <= 2.0 * norm.powi(rounds as i32) + 1e-7);
        }
        let levels = contraction.levels(Real::ONE);
        assert!(levels >= 10, "{levels}");
        if levels <= 28 {
            // digits beyond change less than a unit
            let digits = vec![0; levels as usize];
            let [a, b] = ends.map(|end| reference::phi(&maps, &digits, &end));
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 2.0 * f64::powi(2.0, -24)));
        }
    }
    assert!(near > 0.4 && deep > 1, "{near} {deep}");
    // a straight line halves: 25 levels from 1 to half a unit
    assert_eq!(bezier::<2>().unwrap().contraction().depth(), 2);
    assert!((24..=28).contains(&bezier::<2>().unwrap().contraction().levels(Real::ONE)));
}
