//! The families of surfaces that are fitted: how their maps depend on their numbers.
//!
//! All have base 2 and square cells that share their four maps `T_ij`, whose columns are barycentric. A
//! family says what its maps are for some numbers, how they change with each of them, and the weights of a
//! cell's corners.
//!
//! - *standard*: Tosan, Guerin, Baskurt, section 4.2: the 72 numbers of a 5 x 5 grid, 3 x 3 heights a cell;
//! - *tensor*: `T_ij = T_i (x) T_j`, 4 numbers along each axis, 3 x 3 heights a cell;
//! - *lattice*: one stationary mask of 5 x 5 entries, 21 numbers, 4 x 4 overlapping heights a cell.

use nalgebra::{DMatrix, DVector};

/// What a fitted surface is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Family {
    /// Patches with the 72 numbers of the text's standard grid
    Standard,
    /// Patches that are products of two curves, 8 numbers
    Tensor,
    /// A refinable lattice: one mask of 21 numbers
    Lattice,
}

/// The maps of a cell, the part `(i, j)` at `2 i + j`.
pub(crate) type Maps = [DMatrix<f64>; 4];

/// By how much an entry `(row, column)` of a map changes with a number.
pub(crate) type Change = (usize, usize, usize, f64);

/// Rows of the standard grid that are not control points, in the order of their numbers.
const INNER: [[usize; 2]; 8] = [[1, 2], [3, 2], [2, 1], [2, 3], [1, 1], [1, 3], [3, 1], [3, 3]];

impl Family {
    /// Its name in a scene.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Standard => "standard",
            Self::Tensor => "tensor",
            Self::Lattice => "lattice",
        }
    }

    /// How many numbers its maps have.
    pub(crate) const fn numbers(self) -> usize {
        match self {
            Self::Standard => 72,
            Self::Tensor => 8,
            Self::Lattice => 21,
        }
    }

    /// Control heights along a side of a cell, and how many to the next cell.
    pub(crate) const fn cell(self) -> (usize, usize) {
        match self {
            Self::Standard | Self::Tensor => (3, 2),
            Self::Lattice => (4, 1),
        }
    }

    /// Heights along a side of so many cells.
    pub(crate) const fn side(self, cells: usize) -> usize {
        let (side, step) = self.cell();
        step * (cells - 1) + side
    }

    /// Numbers and heights of `cells x cells` cells.
    pub(crate) const fn parameters(self, cells: usize) -> usize {
        self.numbers() + self.side(cells) * self.side(cells)
    }

    /// Numbers from which a fit starts: those of smooth surfaces, and of others near them.
    pub(crate) fn starts(self) -> Vec<Vec<f64>> {
        match self {
            // a polyline's product, a parabola's, and mixtures of both
            Self::Standard => [0.25, 0.0, 0.5, 0.75, 1.0].map(standard_start).to_vec(),
            // `x^2 - 3/4 x + 1/8`: the parabola; Takagi's curve
            Self::Tensor => vec![[0.75, -0.125].repeat(4), [1.0, -0.25].repeat(4)],
            Self::Lattice => {
                // the cubic B-spline, the linear one, and mixtures of both
                let mask = |w: f64| {
                    let [cubic, linear] = [[0.125, 0.5, 0.75, 0.5, 0.125], [0.0, 0.5, 1.0, 0.5, 0.0]];
                    let one: Vec<f64> = cubic.iter().zip(linear).map(|(c, l)| c + w * (l - c)).collect();
                    FREE.iter().map(|[i, j]| one[*i] * one[*j]).collect()
                };
                [0.0, 1.0, 0.5, 1.5].map(mask).to_vec()
            }
        }
    }

    /// The sum of squares of samples in `[0, 1]` that being off by 1 in one number costs at first: 72 numbers
    /// of a single patch otherwise run to where maps do not contract.
    pub(crate) const fn pull(self) -> f64 {
        match self {
            Self::Standard => 0.2,
            Self::Tensor | Self::Lattice => 0.0,
        }
    }

    /// The sum of squares that a height costs that is 1 away from the middle of the samples: heights at the
    /// corners of a lattice count for next to nothing, and would be anything.
    pub(crate) const fn tether(self) -> f64 {
        match self {
            Self::Lattice => 1e-4,
            Self::Standard | Self::Tensor => 0.0,
        }
    }

    /// The four maps.
    pub(crate) fn maps(self, numbers: &[f64]) -> Maps {
        match self {
            Self::Standard => {
                let grid = standard_grid(numbers);
                PARTS.map(|[i, j]| {
                    DMatrix::from_fn(9, 9, |row, k| grid[5 * (2 * i + k / 3) + 2 * j + k % 3][row])
                })
            }
            Self::Tensor => {
                let [u, v] = [&numbers[..4], &numbers[4..]].map(curve_maps);
                PARTS.map(|[i, j]| u[i].kronecker(&v[j]))
            }
            Self::Lattice => {
                let mask = entries(numbers);
                PARTS.map(|part| {
                    DMatrix::from_fn(16, 16, |from, to| place(part, from, to).map_or(0.0, |at| mask[at]))
                })
            }
        }
    }

    /// How the maps change with each number: map, row, column, derivative.
    pub(crate) fn changes(self, numbers: &[f64]) -> Vec<Vec<Change>> {
        match self {
            Self::Standard => {
                // affine: the difference of one more is the derivative
                let base = self.maps(&[0.0; 72]);
                let one_more = |p: usize| {
                    let mut numbers = [0.0; 72];
                    numbers[p] = 1.0;
                    differences(&base, &self.maps(&numbers))
                };
                (0..72).map(one_more).collect()
            }
            Self::Tensor => {
                // linear in each of the curves
                let base = self.maps(numbers);
                let one_more = |p: usize| {
                    let mut numbers = numbers.to_vec();
                    numbers[p] += 1.0;
                    differences(&base, &self.maps(&numbers))
                };
                (0..8).map(one_more).collect()
            }
            Self::Lattice => {
                let base = self.maps(&[0.0; 21]);
                let one_more = |p: usize| {
                    let mut numbers = [0.0; 21];
                    numbers[p] = 1.0;
                    differences(&base, &self.maps(&numbers))
                };
                (0..21).map(one_more).collect()
            }
        }
    }

    /// The weights of the corners `00, 01, 10, 11` of a cell and how they change with each number.
    pub(crate) fn corners(self, maps: &Maps, changes: &[Vec<Change>]) -> [(Vec<f64>, Vec<Vec<f64>>); 4] {
        if !matches!(self, Self::Lattice) {
            return [0, 2, 6, 8].map(|corner| {
                let weights = (0..9).map(|k| f64::from(u8::from(k == corner))).collect();
                (weights, vec![vec![0.0; 9]; self.numbers()])
            });
        }
        // the 3 x 3 heights about a grid point: c = T_00 c, and dc = T_00 dc + dT_00 c
        let about: Vec<usize> = (0..9).map(|k| 4 * (k / 3) + k % 3).collect();
        let matrix = DMatrix::from_fn(9, 9, |row, column| maps[0][(about[row], about[column])]);
        // I - T is singular along the columns' sum, which is 1 for c and 0 for dc
        let system = DMatrix::identity(9, 9) - matrix + DMatrix::from_element(9, 9, 1.0);
        let solver = system.lu();
        let zero = || DVector::from_element(9, f64::NAN);
        let c = solver.solve(&DVector::from_element(9, 1.0)).unwrap_or_else(zero);
        let slopes: Vec<DVector<f64>> = changes
            .iter()
            .map(|changes| {
                let mut image = DVector::zeros(9);
                for (map, row, column, by) in changes {
                    let at = |k: usize| about.iter().position(|place| *place == k);
                    if let (0, Some(row), Some(column)) = (*map, at(*row), at(*column)) {
                        image[row] += by * c[column];
                    }
                }
                solver.solve(&image).unwrap_or_else(zero)
            })
            .collect();
        PARTS.map(|[s, t]| {
            let spread = |of: &DVector<f64>| {
                let mut all = vec![0.0; 16];
                for (k, weight) in of.iter().enumerate() {
                    all[4 * (k / 3 + s) + k % 3 + t] = *weight;
                }
                all
            };
            (spread(&c), slopes.iter().map(spread).collect())
        })
    }
}

const PARTS: [[usize; 2]; 4] = [[0, 0], [0, 1], [1, 0], [1, 1]];

/// The entries of the mask that are numbers; the others are what is left of 1 in their class.
const FREE: [[usize; 2]; 21] = {
    let mut free = [[0; 2]; 21];
    let (mut k, mut next) = (0, 0);
    while k < 25 {
        let [i, j] = [k / 5, k % 5];
        if !((i == 1 || i == 2) && (j == 1 || j == 2)) {
            free[next] = [i, j];
            next += 1;
        }
        k += 1;
    }
    free
};

/// The 25 entries of a mask.
fn entries(numbers: &[f64]) -> [f64; 25] {
    let (mut mask, mut rest) = ([0.0; 25], [1.0; 4]);
    for ([i, j], number) in FREE.iter().zip(numbers) {
        mask[5 * i + j] = *number;
        rest[2 * (i % 2) + j % 2] -= number;
    }
    for (class, rest) in rest.into_iter().enumerate() {
        mask[5 * (2 - class / 2) + 2 - class % 2] = rest;
    }
    mask
}

/// The entry of the mask that takes the height `from` of a cell to `to` of its part.
fn place([i, j]: [usize; 2], from: usize, to: usize) -> Option<usize> {
    let index =
        |digit: usize, from: usize, to: usize| (digit + 3 + to).checked_sub(2 * from).filter(|k| *k < 5);
    Some(5 * index(i, from / 4, to / 4)? + index(j, from % 4, to % 4)?)
}

/// The maps of the standard curve: `u = (1 - a - b, a, b)`, `v = (d, c, 1 - c - d)`.
fn curve_maps(numbers: &[f64]) -> [DMatrix<f64>; 2] {
    let [a, b, c, d] = [0, 1, 2, 3].map(|k| numbers[k]);
    let columns = |columns: [[f64; 3]; 3]| DMatrix::from_fn(3, 3, |row, k| columns[k][row]);
    let (e0, e1, e2) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    [columns([e0, [1.0 - a - b, a, b], e1]), columns([e1, [d, c, 1.0 - c - d], e2])]
}

/// The 5 x 5 points of the standard grid.
fn standard_grid(numbers: &[f64]) -> Vec<[f64; 9]> {
    let mut grid = vec![[0.0; 9]; 25];
    for k in 0..9 {
        grid[5 * (2 * (k / 3)) + 2 * (k % 3)][k] = 1.0;
    }
    for (n, k) in numbers[..8].chunks(2).zip([1, 3, 1, 3]).enumerate().map(|(n, (pair, k))| ((n, pair), k)) {
        let (n, pair) = n;
        let weights = [pair[0], 1.0 - pair[0] - pair[1], pair[1]];
        for side in 0..2 {
            for (a, weight) in weights.into_iter().enumerate() {
                if n < 2 {
                    grid[5 * k + 4 * side][3 * a + 2 * side] = weight;
                } else {
                    grid[20 * side + k][6 * side + a] = weight;
                }
            }
        }
    }
    for (of, [k, l]) in numbers[8..].chunks(8).zip(INNER) {
        let point = &mut grid[5 * k + l];
        point[..4].copy_from_slice(&of[..4]);
        point[4] = 1.0 - of.iter().sum::<f64>();
        point[5..].copy_from_slice(&of[4..]);
    }
    grid
}

/// The points of a curve of three control points at quarters: a polyline, and a parabola through them.
const BILINEAR: [[f64; 3]; 4] = [[1.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.5, 0.5]];
const QUADRATIC: [[f64; 3]; 4] =
    [[1.0, 0.0, 0.0], [0.375, 0.75, -0.125], [0.0, 1.0, 0.0], [-0.125, 0.75, 0.375]];

/// The standard grid of the product of two curves, `share` of the way from the polyline to the parabola.
fn standard_start(share: f64) -> Vec<f64> {
    let weights = |k: usize, c: usize| BILINEAR[k][c] + share * (QUADRATIC[k][c] - BILINEAR[k][c]);
    let boundary = [1, 3, 1, 3].into_iter().flat_map(|k| [weights(k, 0), weights(k, 2)]);
    let inner = INNER
        .into_iter()
        .flat_map(|[k, l]| (0..9).filter(|c| *c != 4).map(move |c| weights(k, c / 3) * weights(l, c % 3)));
    boundary.chain(inner).collect()
}

/// Where the maps differ, and by how much.
fn differences(from: &Maps, to: &Maps) -> Vec<Change> {
    let mut changes = Vec::new();
    for (map, (from, to)) in from.iter().zip(to).enumerate() {
        let side = from.nrows();
        for (row, column) in (0..side * side).map(|k| (k / side, k % side)) {
            let by = to[(row, column)] - from[(row, column)];
            if by != 0.0 {
                changes.push((map, row, column, by));
            }
        }
    }
    changes
}
