//! Curves by control points, against the text in f64 and against what is known exactly.

use attractor::num::{Near, Real};
use attractor::patch::{Address, ProjectedCurve, Tail, b_spline, bezier, takagi};
use attractor::plane::{PathElement, Point2};
use attractor_reference::patch as reference;

use super::seeded::{Words, allowed, matrix, seeded_curve, worst};

/// The worst error of `phi`, in units and in units a digit, over seeded addresses.
fn curve_errors<const N: usize, const M: usize>(
    curve: &ProjectedCurve<N, M>,
    end: &[f64],
    words: &mut Words,
) -> [f64; 2] {
    let maps: Vec<_> = curve.maps().iter().map(matrix).collect();
    let mut most = [0.0_f64; 2];
    for _ in 0..60 {
        let levels = 1 + words.next() % Address::<N>::MAX_LEVELS;
        let index = words.next() % Address::<N>::count(levels).unwrap();
        let digits = reference::digits(index, N as u32, levels);
        let want = reference::phi(&maps, &digits, end);
        let off = worst(&curve.weights(Address::of(index, levels).unwrap()), &want);
        // and the ends of a spline are rounded
        assert!(off <= allowed(&maps, &digits) + 1.1, "{off} {digits:?}");
        most = [most[0].max(off), most[1].max(off / f64::from(levels))];
    }
    most
}

/// `ProjectedCurve::weights`: any standard curve that is one, Bezier curves, B-splines and base 3.
#[test]
fn weights_are_within_two_units_a_digit() {
    let mut words = Words(1);
    let (mut tried, mut most) = (0, [0.0_f64; 2]);
    let mut take = |errors: [f64; 2]| {
        assert!(errors[1] < 2.0, "{errors:?}");
        most = [most[0].max(errors[0]), most[1].max(errors[1])];
        tried += 1;
    };
    for _ in 0..100 {
        if let Some(curve) = seeded_curve(&mut words) {
            take(curve_errors(&curve, &[1.0, 0.0, 0.0], &mut words));
        }
    }
    take(curve_errors(&bezier::<2>().unwrap(), &[1.0, 0.0], &mut words));
    take(curve_errors(&bezier::<4>().unwrap(), &[1.0, 0.0, 0.0, 0.0], &mut words));
    take(curve_errors(&bezier::<6>().unwrap(), &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], &mut words));
    take(curve_errors(&b_spline::<4>().unwrap(), &[1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0], &mut words));
    let third = Near::ONE / 3;
    let grid = [
        [Near::ONE, Near::ZERO],
        [third * 2, third + Near::DELTA],
        [third / 2, Near::ONE - third / 2],
        [Near::ZERO, Near::ONE],
    ];
    take(curve_errors(&ProjectedCurve::<3, 2>::from_grid(&grid).unwrap(), &[1.0, 0.0], &mut words));
    assert!(tried > 20 && most[0] > 1.0, "{tried} {most:?}");
}

/// `ProjectedCurve::weights` and `ProjectedCurve::value` where everything is known: Takagi's function and a
/// parabola to 14 digits to the last bit, Bernstein's polynomials and B-splines.
#[test]
fn a_parabola_and_takagis_curve_are_exact() {
    let (takagi, parabola) = (takagi().unwrap(), bezier::<3>().unwrap());
    let heights = [Real::ZERO, Real::lit("0.5"), Real::ZERO];
    let mut highest = Real::ZERO;
    for levels in 0..=12 {
        for index in 0..=1_u32 << levels {
            let (address, s) =
                (Address::of(index, levels).unwrap(), f64::from(index) / f64::from(1 << levels));
            let height = takagi.value(&heights, address);
            assert_eq!(height.to_num::<f64>(), reference::takagi(s), "{index} / 2^{levels}");
            highest = highest.max(height);
            assert_eq!(worst(&parabola.weights(address), &reference::bernstein(2, s)), 0.0);
        }
    }
    // 2/3 is the greatest value of Takagi's function
    assert!((highest.to_num::<f64>() - 2.0 / 3.0).abs() < 1e-3);
    for index in 0..=1_u32 << 14 {
        let s = f64::from(index) / f64::from(1 << 14);
        assert_eq!(
            worst(&parabola.weights(Address::of(index, 14).unwrap()), &reference::bernstein(2, s)),
            0.0
        );
    }
    let (cubic, spline, mut most) = (bezier::<4>().unwrap(), b_spline::<4>().unwrap(), 0.0_f64);
    for index in (0..=1_u32 << 20).step_by(999) {
        let (address, s) = (Address::of(index, 20).unwrap(), f64::from(index) / f64::from(1 << 20));
        most = most.max(worst(&cubic.weights(address), &reference::bernstein(3, s)));
        most = most.max(worst(&spline.weights(address), &reference::cubic_b_spline(s)));
    }
    assert!(most > 0.5 && most < 20.0, "{most}");
}

/// Both addresses of every joint, and both computed by their own maps: the same bits.
#[test]
fn both_addresses_of_a_joint_have_the_same_point() {
    let mut words = Words(3);
    let (mut joints, mut curves) = (0, 0);
    while curves < 20 {
        let Some(curve) = seeded_curve(&mut words) else { continue };
        curves += 1;
        let [left, right] = curve.maps();
        assert_eq!(left.column(2), right.column(0));
        for index in 1..64 {
            let one = Address::of(index, 6).unwrap();
            let other = one.other().unwrap();
            assert_ne!(one, other);
            assert_eq!(curve.weights(one), curve.weights(other));
            // digit by digit from 1 1 1 ...: no digit is taken together
            let (index, levels) = other.digits();
            let near = Address::<2>::from_digits(
                &reference::digits(index, 2, levels).iter().map(|d| *d as u8).collect::<Vec<_>>(),
                Tail::Last,
            );
            assert_eq!(curve.weights(near.unwrap()), curve.weights(one));
            joints += 1;
        }
    }
    assert_eq!(joints, 20 * 63);
}

#[test]
fn a_polyline_goes_through_the_points_of_a_level() {
    let curve = bezier::<3>().unwrap();
    let points = [Point2::lit("0", "0"), Point2::lit("1", "2"), Point2::lit("2", "0")];
    let path: Vec<_> = curve.polyline(points, 3).unwrap().collect();
    assert_eq!((path.len(), curve.polyline(points, 3).unwrap().size_hint()), (9, (9, Some(9))));
    for (index, element) in path.iter().enumerate() {
        let x = Real::from_num(index) / 4;
        let y = x * (Real::from_num(2) - x);
        let point = Point2::new(x, y);
        assert_eq!(
            *element,
            if index == 0 { PathElement::MoveTo(point) } else { PathElement::LineTo(point) }
        );
    }
    assert!(curve.polyline(points, 32).is_err());
    assert_eq!(curve.polyline(points, 0).unwrap().count(), 2);
}

/// Points in a plane, or on a line, give a curve in it: what is left of local control.
#[test]
fn control_points_on_a_line_give_a_curve_on_it() {
    let mut words = Words(9);
    let mut tried = 0;
    while tried < 10 {
        let Some(curve) = seeded_curve(&mut words) else { continue };
        let flat = [Real::lit("0.3"); 3];
        for index in 0..=64 {
            let value = curve.value(&flat, Address::of(index, 6).unwrap());
            assert!((value - flat[0]).abs() <= Real::DELTA, "{value}");
        }
        tried += 1;
    }
}
