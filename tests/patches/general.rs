//! The general patch, against the text in f64.

use attractor::Error;
use attractor::num::{Near, Real, Wide};
use attractor::patch::{Address, Barycentric, Patch, ProjectedCurve, Tensor};
use attractor_reference::patch::{self as reference, Matrix};

use super::seeded::{UNIT, Words, allowed, matrix, patch_maps, seeded_patch, worst};

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

/// On the boundary a patch is its boundary curve, in the weights of that side; at joints all four addresses
/// agree, and so do both sides computed by their own maps.
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

/// The grid of a curve: its ends are corners, the points between are seeded.
fn curve_grid<const M: usize>(points: usize, words: &mut Words) -> Vec<[Near; M]> {
    let corner = |k: usize| std::array::from_fn(|i| if i == k { Near::ONE } else { Near::ZERO });
    let mut grid: Vec<[Near; M]> = (0..points)
        .map(|k| {
            // near to the polygon through the corners, so that it contracts
            let along = k as f64 / (points - 1) as f64 * (M - 1) as f64;
            let mut point: [Near; M] = std::array::from_fn(|i| {
                let share = (1.0 - (along - i as f64).abs()).max(0.0);
                Near::from_num(share) + words.between(-0.04, 0.04)
            });
            let rest = point[1..].iter().fold(Near::ONE, |rest, weight| rest - *weight);
            point[0] = rest;
            point
        })
        .collect();
    (grid[0], grid[points - 1]) = (corner(0), corner(M - 1));
    grid
}

/// A patch whose grid is the product of two curves' grids is the product of the curves.
fn compare_with_product<const N: usize, const M: usize, const J: usize>(words: &mut Words) -> f64 {
    let [u, v] = [(); 2].map(|()| curve_grid::<M>((M - 1) * N + 1, words));
    let product = |u: &[Near; M], v: &[Near; M]| {
        let mut point: [Near; J] = std::array::from_fn(|k| u[k / M] * v[k % M]);
        // products are rounded, and the sides are those of the curves
        let rest = point.iter().fold(Near::ONE, |rest, weight| rest - *weight);
        let most = (0..J).max_by_key(|k| point[*k]).unwrap();
        point[most] += rest;
        point
    };
    let grid: Vec<[Near; J]> = u.iter().flat_map(|u| v.iter().map(|v| product(u, v))).collect();
    let patch = Patch::<N, M, J>::from_grid(&grid).unwrap();
    let curves = [u, v].map(|grid| ProjectedCurve::<N, M>::from_grid(&grid).unwrap());
    let tensor = Tensor::<N, M, M, J>::new(curves[0], curves[1]).unwrap();
    let maps: Vec<Matrix> = (0..N * N).map(|k| matrix(patch.map(k / N, k % N).unwrap())).collect();
    let mut corner = vec![0.0; J];
    corner[0] = 1.0;
    let mut most = 0.0_f64;
    for _ in 0..60 {
        let levels = 1 + words.next() % 6;
        let index = [(); 2].map(|()| words.next() % Address::<N>::count(levels).unwrap());
        let at = index.map(|index| Address::of(index, levels).unwrap());
        let [s, t] = index.map(|index| reference::digits(index, N as u32, levels));
        let digits: Vec<usize> = s.iter().zip(t).map(|(i, j)| N * i + j).collect();
        let got = patch.weights(at);
        let off = worst(&got, &reference::phi(&maps, &digits, &corner));
        assert!(off <= allowed(&maps, &digits) + 0.1, "{off} {digits:?}");
        most = most.max(off / f64::from(levels));
        assert_eq!(got.iter().fold(Wide::ZERO, |sum, w| sum + Wide::from(*w)), Wide::ONE);
        // a column of the product is up to J units off in the weight that takes up what was rounded
        let product = tensor.weights(at).map(|weight| weight.to_num::<f64>());
        assert!(worst(&got, &product) < 2.0 * (J as f64) * f64::from(levels));
    }
    most
}

/// Any base and any number of control points.
#[test]
fn a_patch_of_a_product_is_the_product() {
    let mut words = Words(29);
    let worst = [
        compare_with_product::<3, 2, 4>(&mut words),
        compare_with_product::<2, 4, 16>(&mut words),
        compare_with_product::<3, 3, 9>(&mut words),
        compare_with_product::<2, 3, 9>(&mut words),
    ];
    assert!(worst.iter().all(|off| *off > 0.1 && *off < 2.0), "{worst:?}");
}

/// The inverse of a matrix, by elimination with the greatest pivot.
fn inverse(of: &Matrix) -> Matrix {
    let size = of.len();
    let unit = |i: usize| (0..size).map(move |k| f64::from(u8::from(i == k)));
    let mut rows: Matrix =
        of.iter().enumerate().map(|(i, row)| row.iter().copied().chain(unit(i)).collect()).collect();
    for k in 0..size {
        let pivot = (k..size).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs())).unwrap();
        rows.swap(k, pivot);
        let lead: Vec<f64> = rows[k].iter().map(|entry| entry / rows[k][k]).collect();
        for row in &mut rows {
            let by = row[k];
            row.iter_mut().zip(&lead).for_each(|(entry, lead)| *entry -= by * lead);
        }
        rows[k] = lead;
    }
    rows.iter().map(|row| row[size..].to_vec()).collect()
}

/// `Barycentric::control_points`: a surface whose maps are `R T_ij R^-1`, by f64, is that of the maps `T_ij`
/// with other control points.
#[test]
fn other_coordinates_have_the_same_surface() {
    let mut words = Words(31);
    let (mut tried, mut most) = (0, 0.0_f64);
    while tried < 4 {
        let Some((_, patch)) = seeded_patch(&mut words, 0.08) else { continue };
        tried += 1;
        let columns: [[Near; 9]; 9] = std::array::from_fn(|k| {
            let mut column: [Near; 9] = std::array::from_fn(|_| words.between(-0.1, 0.1));
            let rest = column.iter().fold(Near::ONE, |rest, weight| rest - *weight);
            column[k] += rest;
            column
        });
        let change = Barycentric::from_columns(columns).unwrap();
        let points: [Real; 9] = std::array::from_fn(|_| Real::from_num(words.between(-1.0, 1.0)));
        let own = change.control_points(&points);
        let r = matrix(&change);
        let back = inverse(&r);
        let maps: Vec<Matrix> = patch_maps(&patch)
            .iter()
            .map(|map| reference::product(&reference::product(&r, map), &back))
            .collect();
        let corner = reference::image(&r, &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        for _ in 0..60 {
            let [i, j] = [(); 2].map(|()| words.next() % 32);
            let digits = reference::digits(i, 2, 5).into_iter().zip(reference::digits(j, 2, 5));
            let phi = reference::phi(&maps, &digits.map(|(i, j)| 2 * i + j).collect::<Vec<_>>(), &corner);
            let want: f64 = phi.iter().zip(points).map(|(w, p)| w * p.to_num::<f64>()).sum();
            let got = patch.height(&own, [i, j].map(|index| Address::of(index, 5).unwrap()));
            let off = (got.to_num::<f64>() - want).abs() * f64::from(1 << 24);
            // each control point half a unit, and what mixes them half a unit more
            assert!(off < 2.5, "{off}");
            most = most.max(off);
        }
    }
    assert!(most > 0.4, "{most}");
    let far = Barycentric::from_columns([[Near::from_num(7), Near::from_num(-6)]; 2]).unwrap();
    assert_eq!(far.control_points(&[Real::MAX, Real::MIN]), [Real::MAX; 2]);
}
