//! Steps through the standard grid: `T_ij lambda` where most of `T_ij` is known.
//!
//! Every part of the standard grid has one corner of the patch; seen from there all four are alike. Of the 9
//! columns of its map 4 are corners of the barycentric space, the control points that it has; two are on the
//! sides of the patch that meet there, with 3 entries each; 3 are full: 33 products, of which the 5 of the
//! first weight are what the others leave.
//!
//! Source: Tosan, Guerin, Baskurt, section 4.2. The same bits as [`Barycentric::image`]
//! (`a_known_map_gives_the_same_weights`).

use super::address::{Pair, split};
use super::barycentric::{Barycentric, HALF, unit};
use crate::num::formats::Q28;
use crate::num::product;

type Nine<T> = [T; 9];

/// Whether the maps are those of a standard grid: `r_(2i,2j) = e_ij`.
pub(super) fn is_standard<const N: usize, const J: usize>(maps: &[[Barycentric<J>; N]; N]) -> bool {
    let known = |i: usize, j: usize, map: &Barycentric<J>| {
        let places = [[0, 0], [0, 1], [1, 0], [1, 1]];
        places.iter().all(|[k, l]| map.column(6 * k + 2 * l) == Some(unit(3 * (i + k) + j + l)))
    };
    let mut rows = maps.iter().enumerate();
    (N, J) == (2, 9) && rows.all(|(i, row)| row.iter().enumerate().all(|(j, map)| known(i, j, map)))
}

/// The weights at an address of a standard grid, from those of its end on; as they are for other grids.
#[inline(always)]
pub(super) fn standard_weights<const N: usize, const J: usize>(
    maps: &[[Barycentric<J>; N]; N],
    pair: &Pair,
    mut weights: [Q28; J],
) -> [Q28; J] {
    let [mut s, mut t] = pair.indices;
    let (Ok(nine), [m00, m01, m10, m11]) =
        (<&mut Nine<Q28>>::try_from(&mut weights[..]), maps.as_flattened())
    else {
        return weights;
    };
    for _ in 0..pair.levels {
        let ((rest_s, i), (rest_t, j)) = (split::<2>(s), split::<2>(t));
        match [i, j] {
            [0, 0] => step::<0, 0, J>(m00, nine),
            [0, _] => step::<0, 1, J>(m01, nine),
            [_, 0] => step::<1, 0, J>(m10, nine),
            _ => step::<1, 1, J>(m11, nine),
        }
        (s, t) = (rest_s, rest_t);
    }
    weights
}

/// The sum of the rows from the last on, 56 fractional bits, and what it is rounded to.
type Sum = (i64, Q28);

/// `T_AB lambda` in place.
///
/// Not inline: four of these at once are more than a compiler has registers for.
#[inline(never)]
fn step<const A: usize, const B: usize, const J: usize>(map: &Barycentric<J>, weights: &mut Nine<Q28>) {
    let Ok(rows) = <&Nine<[Q28; J]>>::try_from(map.rows().as_slice()) else { return };
    let from = *weights;
    let mut sum = (HALF, 0);
    weights[8] = row::<A, B, 2, 2, J>(rows, &from, &mut sum);
    weights[7] = row::<A, B, 2, 1, J>(rows, &from, &mut sum);
    weights[6] = row::<A, B, 2, 0, J>(rows, &from, &mut sum);
    weights[5] = row::<A, B, 1, 2, J>(rows, &from, &mut sum);
    weights[4] = row::<A, B, 1, 1, J>(rows, &from, &mut sum);
    weights[3] = row::<A, B, 1, 0, J>(rows, &from, &mut sum);
    weights[2] = row::<A, B, 0, 2, J>(rows, &from, &mut sum);
    weights[1] = row::<A, B, 0, 1, J>(rows, &from, &mut sum);
    // columns add up to 1: all rows together are the weights that were multiplied
    let all = multiplied(A, B).map(|place| from[place]);
    let first = all.iter().fold(0, |sum: Q28, weight| sum.wrapping_add(*weight)).wrapping_sub(sum.1);
    weights[0] = if A == 0 && B == 0 { first.wrapping_add(from[0]) } else { first };
}

/// The columns that are not corners: three full ones, that of the side along `s` and that of the side along
/// `t`.
const fn multiplied(a: usize, b: usize) -> [usize; 5] {
    let (corner_s, corner_t) = (2 * a, 2 * b);
    [4, 3 + 2 - corner_t, 3 * (2 - corner_s) + 1, 3 + corner_t, 3 * corner_s + 1]
}

/// The weight of the control point `(K, L)`.
#[inline(always)]
fn row<const A: usize, const B: usize, const K: usize, const L: usize, const J: usize>(
    map: &Nine<[Q28; J]>,
    weights: &Nine<Q28>,
    sum: &mut Sum,
) -> Q28 {
    let (mut rows, before) = *sum;
    let mut add = |place: usize| {
        let entry = map[3 * K + L].get(place).copied().unwrap_or(0);
        rows = product(entry, weights[place]).wrapping_add(rows);
    };
    let [middle, inner_t, inner_s, side_s, side_t] = multiplied(A, B);
    add(middle);
    add(inner_t);
    add(inner_s);
    if L == 2 * B {
        add(side_s);
    }
    if K == 2 * A {
        add(side_t);
    }
    let rounded = (rows >> 28) as i32;
    *sum = (rows, rounded);
    let weight = rounded.wrapping_sub(before);
    // the control point itself, where the part has it
    match (K.checked_sub(A), L.checked_sub(B)) {
        (Some(k @ ..2), Some(l @ ..2)) => weight.wrapping_add(weights[6 * k + 2 * l]),
        _ => weight,
    }
}
