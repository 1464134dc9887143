//! Curves and surfaces by control points, against the text in f64 and against what is known exactly.

use attractor::Error;
use attractor::num::{Near, Real, Wide};
use attractor::patch::{
    Address, Barycentric, End, Joint, Mask, Patch, ProjectedCurve, Sheet, Tail, Tensor, Type, b_spline,
    bezier, standard_curve, takagi,
};
use attractor::plane::{PathElement, Point2};
use attractor_reference::patch::{self as reference, Matrix};

/// Seeded numbers.
struct Words(u64);

impl Words {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as u32
    }

    /// In `[low, high)`, with the bits of a weight.
    fn between(&mut self, low: f64, high: f64) -> Near {
        Near::from_num(low + (high - low) * f64::from(self.next() >> 3) / f64::from(1 << 28))
    }
}

const UNIT: f64 = 1.0 / (1 << 28) as f64;

fn matrix<const J: usize>(map: &Barycentric<J>) -> Matrix {
    let column = |k: usize| map.column(k).unwrap().iter().map(|w| w.to_num()).collect::<Vec<f64>>();
    reference::from_columns(&(0..J).map(column).collect::<Vec<_>>())
}

fn worst(got: &[Near], want: &[f64]) -> f64 {
    assert_eq!(got.len(), want.len());
    got.iter().zip(want).map(|(a, b)| (a.to_num::<f64>() - b).abs() / UNIT).fold(0.0, f64::max)
}

/// A standard curve whose four numbers are seeded, where it is one.
fn seeded_curve(words: &mut Words) -> Option<ProjectedCurve<2, 3>> {
    let first = [words.between(0.2, 1.1), words.between(-0.5, 0.2)];
    let second = [words.between(0.2, 1.1), words.between(-0.5, 0.2)];
    standard_curve(first, second).ok()
}

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
        let want = reference::phi(&maps, &reference::digits(index, N as u32, levels), end);
        let off = worst(&curve.weights(Address::of(index, levels).unwrap()), &want);
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

/// `ProjectedCurve::weights` and `ProjectedCurve::value` where everything is known: Takagi's function and a parabola to 14 digits
/// to the last bit, Bernstein's polynomials and B-splines.
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

/// The bounds of `Contraction` hold: points stay within `radius` of the ends' mean, and `levels` leave less than a unit.
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

#[test]
fn figure_2_has_six_types() {
    let aspects = Type::ALL.map(|of| of.curve().unwrap().aspect());
    let ends = aspects.map(|aspect| (aspect.first, aspect.last, aspect.joint));
    use End::{Alternating, HalfTangent, Spiral};
    assert_eq!(
        ends,
        [
            (HalfTangent, HalfTangent, Joint::Smooth),
            (HalfTangent, HalfTangent, Joint::Angle),
            (HalfTangent, HalfTangent, Joint::Cusp),
            (Alternating, HalfTangent, Joint::Rough),
            (HalfTangent, Spiral, Joint::Rough),
            (Spiral, Spiral, Joint::Rough),
        ]
    );
    // from the other side: the curve's own points, nearer and nearer to the joint
    let points = [Point2::lit("0", "0"), Point2::lit("0.5", "0.5"), Point2::lit("1", "0")];
    for of in &Type::ALL[..3] {
        let curve = of.curve().unwrap();
        let at = |index: u32| {
            let point = curve.point(&points, Address::of(index, 31).unwrap());
            [point.x.to_num::<f64>(), point.y.to_num::<f64>()]
        };
        let middle = at(1 << 30);
        let direction = |index: u32| (at(index)[1] - middle[1]).atan2(at(index)[0] - middle[0]);
        let step = 1 << 14;
        let (back, on) = (direction((1 << 30) - step), direction((1 << 30) + step));
        let turned = ((on - back) / std::f64::consts::TAU + 0.5).rem_euclid(1.0);
        let turn = curve.turn(&points).unwrap().to_num::<f64>();
        let off = (turn - turned + 0.5).rem_euclid(1.0) - 0.5;
        // Takagi's cusp closes as 1 / log
        let bound = if of.letter == 'c' { 0.03 } else { 0.003 };
        assert!(off.abs() < bound, "{}: {turn} {turned}", of.letter);
    }
    assert!(Type::ALL[5].curve().unwrap().turn(&points).is_none());
    // a joint of opposite eigenvalues has no line of its own
    let balanced = standard_curve([Near::ZERO, Near::lit("0.25")], [Near::lit("0.75"), Near::lit("-0.125")]);
    assert_eq!(balanced.unwrap().aspect().first, End::Balanced);
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

/// The 72 numbers of a standard grid near those of the smooth one, where it is a patch.
fn seeded_patch(words: &mut Words, spread: f64) -> Option<([Near; 72], Patch<2, 3, 9>)> {
    let quadratic =
        |k: usize| [[1.0, 0.0, 0.0], [0.375, 0.75, -0.125], [0.0, 1.0, 0.0], [-0.125, 0.75, 0.375]][k];
    let mut numbers = [Near::ZERO; 72];
    let mut next = 0;
    let mut put = |value: f64, words: &mut Words| {
        numbers[next] = Near::from_num(value) + words.between(-spread, spread + 1e-9);
        next += 1;
    };
    for k in [1, 3, 1, 3] {
        for c in [0, 2] {
            put(quadratic(k)[c], words);
        }
    }
    for (k, l) in [(1, 2), (3, 2), (2, 1), (2, 3), (1, 1), (1, 3), (3, 1), (3, 3)] {
        for c in (0..9).filter(|c| *c != 4) {
            put(quadratic(k)[c / 3] * quadratic(l)[c % 3], words);
        }
    }
    assert_eq!(next, 72);
    Patch::standard(&numbers).ok().map(|patch| (numbers, patch))
}

fn patch_maps(patch: &Patch<2, 3, 9>) -> Vec<Matrix> {
    [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| matrix(patch.map(i, j).unwrap())).to_vec()
}

/// The standard grid by the text: its points, its maps, its boundary; `Patch::weights` against them.
#[test]
fn a_patch_is_within_two_units_a_digit() {
    let mut words = Words(11);
    let (mut tried, mut most) = (0, 0.0_f64);
    while tried < 12 {
        let Some((numbers, patch)) = seeded_patch(&mut words, 0.08) else { continue };
        tried += 1;
        // the grid of the text
        let n: Vec<f64> = numbers.iter().map(|n| n.to_num()).collect();
        let mut r = vec![vec![vec![0.0; 9]; 5]; 5];
        for i in 0..3 {
            for j in 0..3 {
                r[2 * i][2 * j][3 * i + j] = 1.0;
            }
        }
        for (index, k) in [1, 3].into_iter().enumerate() {
            let (u, v) = (&n[2 * index..2 * index + 2], &n[4 + 2 * index..6 + 2 * index]);
            for side in [0, 2] {
                for (a, w) in [u[0], 1.0 - u[0] - u[1], u[1]].into_iter().enumerate() {
                    r[k][2 * side][3 * a + side] = w;
                }
                for (b, w) in [v[0], 1.0 - v[0] - v[1], v[1]].into_iter().enumerate() {
                    r[2 * side][k][3 * side + b] = w;
                }
            }
        }
        let inner = [(1, 2), (3, 2), (2, 1), (2, 3), (1, 1), (1, 3), (3, 1), (3, 3)];
        for ((k, l), of) in inner.into_iter().zip(n[8..].chunks(8)) {
            let rest = 1.0 - of.iter().sum::<f64>();
            r[k][l] = [&of[..4], &[rest], &of[4..]].concat();
        }
        let maps = reference::patch_maps(&r, 2, 2);
        let own = patch_maps(&patch);
        for (a, b) in maps.iter().zip(&own) {
            assert!(a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() < 1.5 * UNIT));
        }
        for _ in 0..60 {
            let levels = 1 + words.next() % 16;
            let [i, j] = [(); 2].map(|()| words.next() % (1 << levels));
            let digits: Vec<usize> = reference::digits(i, 2, levels)
                .iter()
                .zip(reference::digits(j, 2, levels))
                .map(|(i, j)| 2 * i + j)
                .collect();
            let want = reference::phi(&own, &digits, &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let got = patch.weights([i, j].map(|index| Address::of(index, levels).unwrap()));
            let off = worst(&got, &want) / f64::from(levels);
            assert!(off < 2.0, "{off}");
            most = most.max(off);
        }
    }
    assert!(most > 0.2, "{most}");
}

/// On the boundary a patch is its boundary curve, in the weights of that side; at joints all four addresses agree,
/// and so do both sides computed by their own maps.
#[test]
fn a_patch_joins_along_its_sides() {
    let mut words = Words(13);
    let (mut tried, mut joints) = (0, 0);
    while tried < 8 {
        let Some((_, patch)) = seeded_patch(&mut words, 0.08) else { continue };
        tried += 1;
        let [u, v] = patch.boundary().unwrap();
        for index in 0..=32 {
            let at = Address::<2>::of(index, 5).unwrap();
            let [zero, one] = [Address::of(0, 0).unwrap(), Address::of(1, 0).unwrap()];
            for (side, end) in [(0, zero), (2, one)] {
                let (along_s, along_t) = (patch.weights([at, end]), patch.weights([end, at]));
                for k in 0..3 {
                    assert_eq!(along_s[3 * k + side], u.weights(at)[k]);
                    assert_eq!(along_t[3 * side + k], v.weights(at)[k]);
                }
                assert_eq!(
                    along_s.iter().filter(|w| **w != 0).count(),
                    u.weights(at).iter().filter(|w| **w != 0).count()
                );
            }
        }
        // T_00 q' = T_01 q and T_00 p' = T_10 p, column by column
        for k in 0..3 {
            let column = |i, j, k| patch.map(i, j).unwrap().column(k);
            for i in 0..2 {
                assert_eq!(column(i, 0, 3 * k + 2), column(i, 1, 3 * k));
                assert_eq!(column(0, i, 6 + k), column(1, i, k));
            }
        }
        for i in 1..16 {
            for j in 1..16 {
                let one = [i, j].map(|index| Address::<2>::of(index, 4).unwrap());
                let other = one.map(|address| address.other().unwrap());
                let want = patch.weights(one);
                for at in [[one[0], other[1]], [other[0], one[1]], other] {
                    assert_eq!(patch.weights(at), want);
                    joints += 1;
                }
            }
        }
    }
    assert_eq!(joints, 8 * 15 * 15 * 3);
    // a boundary that is not its own curve is refused
    let grid = |change: [usize; 2], by: Near| {
        let mut grid = vec![[Near::ZERO; 9]; 25];
        for k in 0..5 {
            for l in 0..5 {
                let weights = |k: usize| match k % 2 {
                    0 => [k == 0, k == 2, k == 4].map(|at| if at { 1.0 } else { 0.0 }),
                    _ => [if k == 1 { 0.5 } else { 0.0 }, 0.5, if k == 3 { 0.5 } else { 0.0 }],
                };
                for (a, weight) in grid[5 * k + l].iter_mut().enumerate() {
                    *weight = Near::from_num(weights(k)[a / 3] * weights(l)[a % 3]);
                }
            }
        }
        let point = &mut grid[5 * change[0] + change[1]];
        (point[0], point[4]) = (point[0] + by, point[4] - by);
        Patch::<2, 3, 9>::from_grid(&grid)
    };
    assert!(grid([2, 2], Near::ZERO).is_ok());
    let refused = grid([4, 3], Near::lit("0.25")).unwrap_err();
    assert_eq!(
        refused,
        Error::Unjoined {
            condition: "T_N-1,j q' e_l = q' T_j e_l (the side s = 1)",
            map: 3,
            gap: Wide::lit("0.25")
        }
    );
    assert!(matches!(grid([1, 4], Near::lit("0.5")), Err(Error::Unjoined { map: 1, .. })));
    assert!(matches!(grid([0, 0], Near::lit("0.5")), Err(Error::Unjoined { map: 0, .. })));
    // inside, any point joins
    assert!(grid([1, 2], Near::lit("0.25")).is_ok());
}

/// `Tensor::height` against the tensor product of the maps; a product of Takagi's curves to the last bit.
#[test]
fn a_product_is_within_two_units_a_digit() {
    let takagi = takagi().unwrap();
    let product = Tensor::<2, 3, 3, 9>::new(takagi, takagi).unwrap();
    let mut heights = [Real::ZERO; 9];
    heights[4] = Real::lit("0.25");
    for i in 0..=64 {
        for j in 0..=64 {
            let at = [i, j].map(|index| Address::of(index, 6).unwrap());
            let exact = reference::takagi(f64::from(i) / 64.0) * reference::takagi(f64::from(j) / 64.0);
            assert_eq!(product.height(&heights, at).to_num::<f64>(), exact);
        }
    }
    let mut words = Words(17);
    let (mut tried, mut most) = (0, 0.0_f64);
    while tried < 10 {
        let (Some(u), Some(v)) = (seeded_curve(&mut words), seeded_curve(&mut words)) else { continue };
        let Ok(product) = Tensor::<2, 3, 3, 9>::new(u, v) else { continue };
        tried += 1;
        let heights: [Real; 9] = std::array::from_fn(|_| Real::from_num(words.between(-1.0, 1.0)));
        let [u, v] = [u, v].map(|curve| curve.maps().each_ref().map(matrix));
        let maps: Vec<Matrix> =
            u.iter().flat_map(|u| v.iter().map(move |v| reference::tensor(u, v))).collect();
        let size: f64 = heights.iter().map(|h| h.to_num::<f64>().abs()).sum();
        for _ in 0..60 {
            let levels = 1 + words.next() % 16;
            let [i, j] = [(); 2].map(|()| words.next() % (1 << levels));
            let digits: Vec<usize> = reference::digits(i, 2, levels)
                .iter()
                .zip(reference::digits(j, 2, levels))
                .map(|(i, j)| 2 * i + j)
                .collect();
            let phi = reference::phi(&maps, &digits, &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let want: f64 = phi.iter().zip(heights).map(|(w, h)| w * h.to_num::<f64>()).sum();
            let at = [i, j].map(|index| Address::of(index, levels).unwrap());
            let off = (product.height(&heights, at).to_num::<f64>() - want).abs();
            let bound = 2.0 * f64::from(levels) * UNIT * size + 2.0 / f64::from(1 << 24);
            assert!(off < bound, "{off} {bound}");
            most = most.max(off / bound);
            let weights = product.weights(at);
            assert!(worst(&weights, &phi) < 8.0 * f64::from(levels));
        }
    }
    assert!(most > 0.1, "{most}");
}

fn cubic() -> [[Near; 5]; 5] {
    let one = [1, 4, 6, 4, 1];
    one.map(|a| one.map(|b| Near::from_bits((a * b) << 22)))
}

/// The cubic mask with seeded changes in each class, where it contracts.
fn seeded_mask(words: &mut Words) -> Option<Mask> {
    let mut entries = cubic();
    for class in 0..4_usize {
        let mut sum = Near::ZERO;
        for i in ((class >> 1)..5).step_by(2) {
            for j in ((class & 1)..5).step_by(2) {
                let change = words.between(-0.06, 0.06);
                entries[i][j] += change;
                sum += change;
            }
        }
        entries[2 - (class >> 1)][2 - (class & 1)] -= sum;
    }
    Mask::new(entries).ok()
}

/// `Mask::weights` against refined grids and their limits in f64; the cubic mask is the bicubic B-spline.
#[test]
fn a_lattice_is_within_two_units_a_digit() {
    let spline = Mask::new(cubic()).unwrap();
    let mut most = 0.0_f64;
    for i in 0..=32 {
        for j in 0..=32 {
            let (s, t) = (f64::from(i) / 32.0, f64::from(j) / 32.0);
            let weights = spline.weights([i, j].map(|index| Address::of(index, 5).unwrap()));
            let want: Vec<f64> = reference::cubic_b_spline(s)
                .iter()
                .flat_map(|a| reference::cubic_b_spline(t).map(|b| a * b))
                .collect();
            most = most.max(worst(&weights, &want));
        }
    }
    assert!(most > 0.3 && most < 4.0, "{most}");
    let mut words = Words(19);
    let (mut tried, mut most) = (0, 0.0_f64);
    while tried < 6 {
        let Some(mask) = seeded_mask(&mut words) else { continue };
        tried += 1;
        let entries = mask.entries().map(|row| row.map(|w| w.to_num::<f64>()));
        for k in 0..16 {
            let mut grid = vec![vec![0.0; 4]; 4];
            grid[k / 4][k % 4] = 1.0;
            let mut levels = 0;
            while levels < 3 {
                grid = reference::refined(&grid, &entries);
                levels += 1;
                let count = 1_usize << levels;
                for i in 0..=count {
                    for j in 0..=count {
                        let about = (0..3).map(|a| grid[i + a][j..j + 3].to_vec()).collect();
                        let want = reference::limit(&about, &entries);
                        let at = [i, j].map(|index| Address::of(index as u32, levels).unwrap());
                        let off = (mask.weights(at)[k].to_num::<f64>() - want).abs() / UNIT;
                        assert!(off < 2.0 * f64::from(levels) + 2.0, "{off} at {levels}");
                        most = most.max(off);
                    }
                }
            }
        }
    }
    assert!(most > 0.5, "{most}");
}

#[test]
fn a_mask_of_numbers_is_that_of_its_entries_and_a_wrong_one_is_refused() {
    let entries = cubic();
    let numbers: Vec<Near> = (0..25)
        .filter(|k| !((1..3).contains(&(k / 5)) && (1..3).contains(&(k % 5))))
        .map(|k| entries[k / 5][k % 5])
        .collect();
    let numbers: [Near; 21] = numbers.try_into().unwrap();
    assert_eq!(Mask::from_numbers(&numbers).unwrap(), Mask::new(entries).unwrap());
    for class in 0..4_usize {
        let mut wrong = entries;
        wrong[4 - (class >> 1)][4 - (class & 1)] += Near::lit("0.25");
        let refused = Error::NotBarycentric { column: class, sum: Wide::lit("1.25") };
        assert_eq!(Mask::new(wrong).unwrap_err(), refused);
    }
    // a mask that spreads: 9 entries of alternating sign
    let mut wild = entries;
    wild[0][0] += Near::lit("2");
    wild[4][4] += Near::lit("2");
    wild[2][2] -= Near::lit("4");
    assert!(Mask::new(wild).is_err());
}

/// A sheet is its cells, seen from either side of what they have in common.
#[test]
fn a_sheet_is_its_cells() {
    let mut words = Words(23);
    let mask = loop {
        if let Some(mask) = seeded_mask(&mut words) {
            break mask;
        }
    };
    assert_eq!(Sheet::<Mask, 16>::heights(5), 64);
    let heights: Vec<Real> = (0..64).map(|_| Real::from_num(words.between(-1.0, 1.0))).collect();
    let sheet = Sheet::new(&mask, &heights, 5).unwrap();
    assert_eq!((sheet.cells(), sheet.contraction()), (5, mask.contraction()));
    let mut seams = 0;
    for i in 0..=20_u32 {
        for j in 0..=20_u32 {
            let height = sheet.at([i, j], 2);
            // every cell that has the place
            for ci in 0..5_u32 {
                for cj in 0..5_u32 {
                    if (4 * ci..=4 * ci + 4).contains(&i) && (4 * cj..=4 * cj + 4).contains(&j) {
                        let of: [Real; 16] =
                            std::array::from_fn(|k| heights[(ci as usize + k / 4) * 8 + cj as usize + k % 4]);
                        let at = [i - 4 * ci, j - 4 * cj].map(|index| Address::of(index, 2).unwrap());
                        let own = mask.height(&of, at);
                        // the same weights by other maps: to within their rounding
                        assert!((own - height).abs() <= Real::DELTA * 2, "{own} {height}");
                        seams += 1;
                    }
                }
            }
        }
    }
    assert!(seams > 500);
    // the mean normal of a plane
    let slope: Vec<Real> = (0..64).map(|k| Real::from_num(k / 8) / 8).collect();
    let plane = Sheet::new(&mask, &slope, 5).unwrap();
    let normal = plane.mean_normal([1, 2], 0);
    assert!(normal.y.abs() < 1e-5 && normal.z == 1, "{normal:?}");
    let mut twist = heights;
    twist[7] = Real::lit("100");
    assert!(matches!(
        Sheet::new(&mask, &twist, 5),
        Err(Error::OutOfRange { what: "height", index: Some(7), .. })
    ));
    assert!(matches!(
        Sheet::new(&mask, &twist, 4),
        Err(Error::LengthMismatch { expected: 49, given: 64, .. })
    ));
    assert!(matches!(Sheet::new(&mask, &twist, 0), Err(Error::OutOfRange { .. })));
}
