//! Means over a cell of a refinable lattice, by the equations that they solve.
//!
//! Over a cell a height is `sum p_k phi_k`, and `phi((x + d) / 2) = T_d phi(x)` for its four quarters `d`, so
//! that the slopes there are `2 T_d` times the slopes. Integrals over the cell are the mean of those over the
//! quarters:
//!
//! - `w = 1/4 sum T_d w` for the means of `phi`, with `sum w = 1`;
//! - `M = r/4 sum T_d M T_d^T` for the means of products of two of them, `r` = 1 for two heights, 2 for a
//!   height and a slope, 4 for two slopes; with what is known of sums, since heights of 1 are a level and
//!   heights that are places a plane: `sum phi_k = 1`, `sum k phi_k` = the place and a constant.
//!
//! All as linear equations, solved by least squares (Householder).

use crate::patch::{Matrix, limit, refined};
use crate::projected::Place;

/// The means over a cell.
#[derive(Debug, Clone)]
pub struct CellMeans {
    /// Of each height's function.
    pub height: Vec<f64>,
    /// Of its slopes.
    pub slope: [Vec<f64>; 2],
    /// Of products of two.
    pub squares: Matrix,
    /// Of a function and another's slope, along both axes; of two slopes: along the first, both, the second.
    /// None where slopes are not square integrable, or a plane does not stay one.
    pub with_slopes: Option<([Matrix; 2], [Matrix; 3])>,
}

/// `T_d`, `d` = (i, j).
pub fn part(mask: &[[f64; 5]; 5], i: usize, j: usize) -> Matrix {
    let index = |d: usize, to: usize, from: usize| (d + 3 + to).wrapping_sub(2 * from);
    let entry = |from: usize, to: usize| {
        let (x, y) = (index(i, to / 4, from / 4), index(j, to % 4, from % 4));
        if x < 5 && y < 5 { mask[x][y] } else { 0.0 }
    };
    (0..16).map(|from| (0..16).map(|to| entry(from, to)).collect()).collect()
}

/// The `x` with the least `|A x - b|`.
fn least_squares(mut a: Matrix, mut b: Vec<f64>) -> Vec<f64> {
    let n = a[0].len();
    for k in 0..n {
        let length = a[k..].iter().map(|row| row[k] * row[k]).sum::<f64>().sqrt();
        let mut v: Vec<f64> = a[k..].iter().map(|row| row[k]).collect();
        v[0] += if v[0] < 0.0 { -length } else { length };
        let square: f64 = v.iter().map(|x| x * x).sum();
        for column in k..n {
            let along: f64 = v.iter().zip(&a[k..]).map(|(v, row)| v * row[column]).sum();
            a[k..].iter_mut().zip(&v).for_each(|(row, v)| row[column] -= 2.0 * along / square * v);
        }
        let along: f64 = v.iter().zip(&b[k..]).map(|(v, b)| v * b).sum();
        b[k..].iter_mut().zip(&v).for_each(|(b, v)| *b -= 2.0 * along / square * v);
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|l| a[k][l] * x[l]).sum();
        x[k] = (b[k] - known) / a[k][k];
    }
    x
}

/// What is known of the sums of a matrix of products: weights of its rows, and what they make.
type Sums = Vec<(Vec<f64>, Vec<f64>)>;

/// `M = r/4 sum T_d M T_d^T` with `M c = v` and `c M = v` for what is known.
fn products(mask: &[[f64; 5]; 5], r: f64, right: &Sums, left: &Sums) -> Matrix {
    let (mut a, mut b): (Matrix, Vec<f64>) = (vec![vec![0.0; 256]; 256], vec![0.0; 256]);
    a.iter_mut().enumerate().for_each(|(k, row)| row[k] = 1.0);
    for t in [(0, 0), (0, 1), (1, 0), (1, 1)].map(|(i, j)| part(mask, i, j)) {
        for (k, l) in (0..256).map(|k| (k / 16, k % 16)) {
            for (m, n) in (0..256).map(|m| (m / 16, m % 16)) {
                a[16 * k + l][16 * m + n] -= r / 4.0 * t[k][m] * t[l][n];
            }
        }
    }
    for (known, first) in [(right, false), (left, true)] {
        for (weights, sums) in known {
            for (k, sum) in sums.iter().enumerate() {
                let mut row = vec![0.0; 256];
                for (l, weight) in weights.iter().enumerate() {
                    row[if first { 16 * l + k } else { 16 * k + l }] = *weight;
                }
                a.push(row);
                b.push(*sum);
            }
        }
    }
    let x = least_squares(a, b);
    x.chunks(16).map(<[f64]>::to_vec).collect()
}

/// The mean of `phi` over a set of quarters, 2 or 4.
fn mean(mask: &[[f64; 5]; 5], parts: &[(usize, usize)]) -> Vec<f64> {
    let mut a: Matrix = (0..16).map(|k| (0..16).map(|l| f64::from(u8::from(k == l))).collect()).collect();
    for t in parts.iter().map(|(i, j)| part(mask, *i, *j)) {
        for (row, from) in a.iter_mut().zip(t) {
            row.iter_mut().zip(from).for_each(|(a, t)| *a -= t / parts.len() as f64);
        }
    }
    a.push(vec![1.0; 16]);
    let mut b = vec![0.0; 17];
    b[16] = 1.0;
    least_squares(a, b)
}

/// The means over a cell for a mask; with those of slopes if they are asked for.
pub fn means(mask: &[[f64; 5]; 5], slopes: bool) -> CellMeans {
    let height = mean(mask, &[(0, 0), (0, 1), (1, 0), (1, 1)]);
    let less = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>();
    let along = less(mean(mask, &[(1, 0), (1, 1)]), mean(mask, &[(0, 0), (0, 1)]));
    let across = less(mean(mask, &[(0, 1), (1, 1)]), mean(mask, &[(0, 0), (1, 0)]));
    let (one, none) = (vec![1.0; 16], vec![0.0; 16]);
    let level = |v: &Vec<f64>| (one.clone(), v.clone());
    let squares = products(mask, 1.0, &vec![level(&height)], &vec![level(&height)]);
    let place =
        |axis: usize| (0..16).map(|k| if axis == 0 { k / 4 } else { k % 4 } as f64).collect::<Vec<_>>();
    let with_slopes = slopes.then(|| {
        let slope = [&along, &across];
        // sums of what is multiplied by the slope along an axis
        let plane = |axis: usize, v: &Vec<f64>| {
            vec![level(&none), (place(axis), v.clone()), (place(1 - axis), none.clone())]
        };
        let mixed = [0, 1].map(|axis| products(mask, 2.0, &plane(axis, &height), &vec![level(slope[axis])]));
        let both = [(0, 0), (0, 1), (1, 1)]
            .map(|(p, q)| products(mask, 4.0, &plane(q, slope[p]), &plane(p, slope[q])));
        (mixed, both)
    });
    CellMeans { height, slope: [along, across], squares, with_slopes }
}

/// `p M p`.
pub fn form(m: &Matrix, p: &[f64]) -> f64 {
    m.iter().zip(p).map(|(row, a)| a * row.iter().zip(p).map(|(m, b)| m * b).sum::<f64>()).sum()
}

/// `p w`.
pub fn dot(w: &[f64], p: &[f64]) -> f64 {
    w.iter().zip(p).map(|(w, p)| w * p).sum()
}

/// The heights of a cell at so many halvings, `(2^levels + 1)^2` of them.
pub fn grid(heights: &[f64; 16], mask: &[[f64; 5]; 5], levels: u32) -> Matrix {
    let mut all: Matrix = heights.chunks(4).map(<[f64]>::to_vec).collect();
    for _ in 0..levels {
        all = refined(&all, mask);
    }
    let side = all.len() - 2;
    let about = |i: usize, j: usize| (0..3).map(|a| all[i + a][j..j + 3].to_vec()).collect();
    (0..side).map(|i| (0..side).map(|j| limit(&about(i, j), mask)).collect()).collect()
}

/// Places of a sheet of `cells x cells` cells over the unit square, one for each cell after so many halvings:
/// the mean height, and by turns one of four slopes that together have the mean and the covariance of the
/// cell.
pub fn places(heights: &[f64], cells: usize, mask: &[[f64; 5]; 5], levels: u32) -> Vec<Place> {
    let (mut all, mut n) = (heights.to_vec(), cells);
    for _ in 0..levels {
        let side = n + 3;
        let value = |x: usize, y: usize| {
            // places from -1 on; entries of even or odd index
            let mut sum = 0.0;
            for (a, b) in (0..25).map(|k| (k / 5, k % 5)) {
                let (j, l) = (x + 3, y + 3);
                if j >= a && l >= b && (j - a) % 2 == 0 && (l - b) % 2 == 0 {
                    let (j, l) = ((j - a) / 2, (l - b) / 2);
                    if j < side && l < side {
                        sum += mask[a][b] * all[j * side + l];
                    }
                }
            }
            sum
        };
        let finer = 2 * n + 3;
        all = (0..finer * finer).map(|k| value(k / finer, k % finer)).collect();
        n *= 2;
    }
    let cell = means(mask, true);
    let (_, both) = cell.with_slopes.as_ref().expect("asked for");
    let side = n + 3;
    let place = |(i, j): (usize, usize)| {
        let p: Vec<f64> = (0..16).map(|k| all[(i + k / 4) * side + j + k % 4] * n as f64).collect();
        let slope = cell.slope.each_ref().map(|w| dot(w, &p));
        let [pp, pq, qq] = both.each_ref().map(|m| form(m, &p));
        let (pp, pq, qq) = (pp - slope[0] * slope[0], pq - slope[0] * slope[1], qq - slope[1] * slope[1]);
        let s = libm::sqrt(pp.max(1e-30));
        let (c, r) = (pq / s, libm::sqrt((qq - pq * pq / pp.max(1e-30)).max(0.0)));
        let sign = |odd: bool| if odd { -1.0 } else { 1.0 };
        let (a, b) = (sign(j % 2 == 1), sign((i + j / 2) % 2 == 1));
        let at = [(i as f64 + 0.5) / n as f64, (j as f64 + 0.5) / n as f64, dot(&cell.height, &p) / n as f64];
        Place { at, slopes: [slope[0] + a * s, slope[1] + a * c + b * r] }
    };
    (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mask that is the same in all eight directions.
    fn mask(edge: f64, corner: f64, side: f64) -> [[f64; 5]; 5] {
        let entry =
            |i: usize, j: usize| match (i.abs_diff(2).min(j.abs_diff(2)), i.abs_diff(2).max(j.abs_diff(2))) {
                (0, 0) => 1.0 - 4.0 * edge - 4.0 * corner,
                (0, 1) => 0.5 - 2.0 * side,
                (1, 1) => 0.25,
                (0, _) => edge,
                (1, _) => side,
                _ => corner,
            };
        std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
    }

    /// What the equations say against sums over a fine grid, and the bilinear lattice in closed form.
    #[test]
    fn means_are_those_of_a_fine_grid() {
        let flat = means(&mask(0.0, 0.0, 0.0), true);
        // bilinear: height 1 at one corner of the cell
        let mut one = [0.0; 16];
        one[5] = 1.0;
        let (mixed, both) = flat.with_slopes.as_ref().unwrap();
        let got = [
            dot(&flat.height, &one),
            dot(&flat.slope[0], &one),
            form(&flat.squares, &one),
            form(&mixed[1], &one),
            form(&both[0], &one),
            form(&both[1], &one),
        ];
        for (got, want) in got.iter().zip([0.25, -0.5, 1.0 / 9.0, -1.0 / 6.0, 1.0 / 3.0, 0.25]) {
            assert!((got - want).abs() < 1e-9, "{got} {want}");
        }
        let rough = mask(-0.03, 0.0, -0.03);
        let (p, levels) = (std::array::from_fn::<f64, 16, _>(|k| ((k * k * 7 + k) % 11) as f64 / 10.0), 5);
        let (all, cell) = (grid(&p, &rough, levels), means(&rough, true));
        let (mixed, both) = cell.with_slopes.as_ref().unwrap();
        let n = all.len() - 1;
        let mut sums = [0.0; 7];
        for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
            let corners = [all[i][j], all[i][j + 1], all[i + 1][j], all[i + 1][j + 1]];
            let h = corners.iter().sum::<f64>() / 4.0;
            let s = (corners[2] + corners[3] - corners[0] - corners[1]) / 2.0 * n as f64;
            let t = (corners[1] + corners[3] - corners[0] - corners[2]) / 2.0 * n as f64;
            for (sum, term) in sums.iter_mut().zip([h, s, t, h * h, h * s, s * s, s * t]) {
                *sum += term / (n * n) as f64;
            }
        }
        let want = [
            dot(&cell.height, &p),
            dot(&cell.slope[0], &p),
            dot(&cell.slope[1], &p),
            form(&cell.squares, &p),
            form(&mixed[0], &p),
            form(&both[0], &p),
            form(&both[1], &p),
        ];
        // slopes have not all been seen yet
        for (k, (sum, want)) in sums.iter().zip(want).enumerate() {
            let allowed = if k < 5 { 0.004 } else { 0.12 };
            assert!((sum - want).abs() < allowed * want.abs().max(1.0), "{k}: {sum} {want}");
        }
    }
}
