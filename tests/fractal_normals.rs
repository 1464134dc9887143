//! Normals that are fractal functions in their own right: what the sum and the multiple of two surfaces have
//! for a normal, exactly.
//!
//! The functions through knots above the same abscissae, with the same vertical scalings, are a space: knots
//! are added and multiplied, and values with them, since `f(L_j u) = alpha_j f(u) + q_j(u)` is linear in `f`
//! and `q_j`. The slope of a tensor product `F(x) G(y)` is `(f(x) G(y), F(x) g(y))`: above each line along an
//! axis both components are such functions themselves, multiples of `f` and `F`. So the normals of surfaces
//! that share one factor are a space; and of the sum `F(x) + G(y)` the normal is `(-f, -g, 1)`, two functions
//! of the text. The sum of two products with four factors is none: it is a height field all the same, whose
//! normal is the sum of both. A lattice's slopes are such functions of two variables: the lattice of the sum
//! of heights is the sum of lattices.
//!
//! All numbers here are halves of halves, so that nothing is rounded.

use attractor::fif::{Factor, Fif, Knot, Surface};
use attractor::num::{Near, Real, Scaling, Vec3, Wide};
use attractor::patch::{HeightMoments, Mask, Sheet};

fn wide(v: f64) -> Wide {
    Wide::from_num(v)
}

/// Through so many quarters at 0, 1, 2, 3 and 4.
fn function(quarters: [i32; 5]) -> Fif<4, 2> {
    let knots = (0..5).zip(quarters).map(|(x, y)| Knot::new(Wide::from_num(x), wide(f64::from(y) / 4.0)));
    let scalings = [0.125, -0.125, 0.125, -0.125].map(Scaling::from_num);
    Fif::interpolating(&knots.collect::<Vec<_>>(), &scalings).unwrap()
}

/// `a + k b`, knot by knot.
fn sum(a: [i32; 5], b: [i32; 5], k: i32) -> [i32; 5] {
    std::array::from_fn(|i| a[i] + k * b[i])
}

const PAIRS: [[[i32; 5]; 2]; 3] = [
    [[0, 4, -2, 1, 3], [1, 1, 5, -3, 0]],
    [[2, -4, 0, 8, -1], [-6, 2, 2, 0, 7]],
    [[0, 1, 0, 1, 0], [3, 3, 3, 3, 3]],
];

/// Places down to the fourth level of a function of four maps.
fn places() -> impl Iterator<Item = Wide> {
    (0..=256).map(|k| wide(f64::from(k) / 64.0))
}

/// Values and slopes of the sum of functions, to the last bit, and of their multiples.
#[test]
fn functions_over_the_same_partition_and_scalings_are_a_space() {
    let mut tried = 0;
    for [a, b] in PAIRS {
        for k in [1, -1, 2, -3] {
            let (one, other, both) = (function(a), function(b), function(sum(a, b, k)));
            let times = |v: Real| v * Real::from_num(k);
            for x in places() {
                assert_eq!(both.at_wide(x), one.at_wide(x) + other.at_wide(x) * Wide::from_num(k), "{k} {x}");
                assert_eq!(both.at(x), one.at(x) + times(other.at(x)), "{k} {x}");
                tried += 1;
            }
            assert_eq!((both.maps(), both.domain()), (one.maps(), one.domain()));
        }
    }
    assert_eq!(tried, 12 * 257);
    // with other scalings it is none: the sum is not what goes through the sum of the knots
    let knots = (0..5).map(|x| Knot::new(Wide::from_num(x), wide(f64::from(x % 2))));
    let other = Fif::<4, 2>::interpolating(&knots.collect::<Vec<_>>(), &[Scaling::lit("0.25"); 4]).unwrap();
    let (one, both) = (function([0, 4, 0, 4, 0]), function([0, 8, 0, 8, 0]));
    let off = places().filter(|x| both.at(*x) != one.at(*x) + other.at(*x)).count();
    assert!(off > 100, "{off}");
}

/// Heights and normals of `(F1 + k F2) G` and of what is added along the other axis, to the last bit.
#[test]
fn normals_of_surfaces_that_share_a_factor_are_a_space() {
    let factor = |quarters: [i32; 5]| {
        let slope = function(quarters);
        Factor::<4, 3>::from_slope(&slope, Wide::ZERO).unwrap()
    };
    let (mut tried, mut steep) = (0, 0);
    for [a, b] in PAIRS {
        for k in [1, -1, 2] {
            let shared = factor([1, 2, -1, 0, 2]);
            let (one, other, both) = (factor(a), factor(b), factor(sum(a, b, k)));
            let normals = |f: &Factor<4, 3>, x: Wide, y: Wide| {
                let (along, across) = (Surface::new(f, &shared), Surface::new(&shared, f));
                let ([n, m], h) = ([along.normal(x, y), across.normal(y, x)], along.height(x, y));
                assert_eq!((n.x, n.y, n.z), (m.y, m.x, Real::ONE));
                (n, h)
            };
            let plus = |a: Real, b: Real| a + b * Real::from_num(k);
            for x in places().step_by(16) {
                for y in places().step_by(64) {
                    let ((n, h), (m, g), (s, e)) =
                        (normals(&one, x, y), normals(&other, x, y), normals(&both, x, y));
                    assert_eq!(s, Vec3::new(plus(n.x, m.x), plus(n.y, m.y), Real::ONE), "{x} {y}");
                    assert_eq!(e, plus(h, g));
                    steep += u32::from(s.x.abs() > 1);
                    tried += 1;
                }
            }
        }
    }
    assert!(tried == 9 * 17 * 5 && steep > 25, "{tried} {steep}");
}

/// The lattice of the sum of heights is the sum of lattices: heights, and their means and mean slopes.
#[test]
fn a_sum_of_lattices_is_the_lattice_of_the_sum() {
    let one = [1, 4, 6, 4, 1];
    let mask = Mask::new(one.map(|a| one.map(|b| Near::from_bits((a * b) << 22)))).unwrap();
    let moments = HeightMoments::new(&mask).unwrap();
    let heights = |seed: i32| -> Vec<Real> {
        (0..25).map(|k| Real::from_num((k * k * seed + 3 * k) % 17 - 8) / 2).collect()
    };
    let (a, b) = (heights(5), heights(7));
    let both: Vec<Real> = a.iter().zip(&b).map(|(a, b)| *a - *b * Real::lit("2")).collect();
    let [a, b, both] = [&a, &b, &both].map(|heights| Sheet::new(&mask, heights, 2).unwrap());
    let (mut tried, mut most) = (0, 0);
    for index in (0..64_u32).map(|k| [k / 8, k % 8]) {
        let cell = |sheet: &Sheet<'_, Mask, 16>| sheet.part(index, 2);
        let (p, q, r) = (cell(&a), cell(&b), cell(&both));
        // two levels of 64ths: exact
        assert!(p.iter().zip(q).zip(r).all(|((p, q), r)| r == *p - q * Real::lit("2")), "{index:?}");
        let (m, n, s) = (moments.over(&p, 8), moments.over(&q, 8), moments.over(&r, 8));
        let off = |s: Real, m: Real, n: Real| (s - (m - n * Real::lit("2"))).to_bits().abs();
        most = most.max(off(s.height, m.height, n.height));
        for axis in 0..2 {
            most = most.max(off(s.slope[axis], m.slope[axis], n.slope[axis]));
        }
        tried += 1;
    }
    // each of the three is rounded to nearest, once
    assert!(tried == 64 && (0..=2).contains(&most), "{most}");
}
