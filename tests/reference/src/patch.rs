//! Projected attractors from the text: E. Tosan, E. Guerin, A. Baskurt, "Design and Reconstruction of Fractal
//! Surfaces", 2002; products of maps from the first digit on, as eq. 1 has them.

/// A matrix as its rows; its columns are barycentric.
pub type Matrix = Vec<Vec<f64>>;

/// `a b`.
pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    let entry = |row: &Vec<f64>, k: usize| row.iter().zip(b).map(|(x, line)| x * line[k]).sum();
    a.iter().map(|row| (0..b[0].len()).map(|k| entry(row, k)).collect()).collect()
}

/// `T lambda`.
pub fn image(t: &Matrix, lambda: &[f64]) -> Vec<f64> {
    t.iter().map(|row| row.iter().zip(lambda).map(|(a, b)| a * b).sum()).collect()
}

/// The matrix with these columns.
pub fn from_columns(columns: &[Vec<f64>]) -> Matrix {
    (0..columns[0].len()).map(|i| columns.iter().map(|column| column[i]).collect()).collect()
}

/// `phi(sigma) = T_sigma1 ... T_sigmap lambda`, the last digit's map applied first.
pub fn phi(maps: &[Matrix], digits: &[usize], lambda: &[f64]) -> Vec<f64> {
    let Some((first, rest)) = digits.split_first() else { return lambda.to_vec() };
    let all = rest.iter().fold(maps[*first].clone(), |all, digit| product(&all, &maps[*digit]));
    image(&all, lambda)
}

/// The digits of `index` in base `n`, the most significant first.
pub fn digits(index: u32, n: u32, levels: u32) -> Vec<usize> {
    (0..levels).rev().map(|k| (index / n.pow(k) % n) as usize).collect()
}

/// `T_i (x) T_j`.
pub fn tensor(a: &Matrix, b: &Matrix) -> Matrix {
    let row = |x: &Vec<f64>, y: &Vec<f64>| x.iter().flat_map(|x| y.iter().map(move |y| x * y)).collect();
    a.iter().flat_map(|x| b.iter().map(move |y| row(x, y))).collect()
}

/// The maps of the general patch, `T_ij e_kl = r_(mi+k, mj+l)`, row after row; `r` has `(mN + 1)^2` points.
pub fn patch_maps(r: &[Vec<Vec<f64>>], n: usize, m: usize) -> Vec<Matrix> {
    let column = |i: usize, j: usize, k: usize| r[m * i + k / (m + 1)][m * j + k % (m + 1)].clone();
    let map = |i, j| from_columns(&(0..(m + 1) * (m + 1)).map(|k| column(i, j, k)).collect::<Vec<_>>());
    (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| map(i, j)).collect()
}

/// Takagi's function at a dyadic place: the sum ends where its terms vanish.
pub fn takagi(x: f64) -> f64 {
    (0..60).map(|n| (x * f64::powi(2.0, n), n)).map(|(y, n)| (y - y.round()).abs() / f64::powi(2.0, n)).sum()
}

/// Bernstein's polynomials of degree `m`.
pub fn bernstein(m: usize, s: f64) -> Vec<f64> {
    let binomial = |k: usize| (0..k).fold(1.0, |c, i| c * (m - i) as f64 / (i + 1) as f64);
    (0..=m).map(|k| binomial(k) * s.powi(k as i32) * (1.0 - s).powi((m - k) as i32)).collect()
}

/// The uniform cubic B-spline's weights of its four control points between two knots.
pub fn cubic_b_spline(s: f64) -> [f64; 4] {
    let (t, s2, s3) = (1.0 - s, s * s, s * s * s);
    [
        t * t * t / 6.0,
        (3.0 * s3 - 6.0 * s2 + 4.0) / 6.0,
        (-3.0 * s3 + 3.0 * s2 + 3.0 * s + 1.0) / 6.0,
        s3 / 6.0,
    ]
}

/// The grid of half the step, by a stationary mask of 5 x 5: `h'(x) = sum_j m(x - 2 j) h(j)`. Row 0 of a grid
/// lies at -1, so that what is cut off at the rim is not missed inside.
pub fn refined(grid: &Matrix, mask: &[[f64; 5]; 5]) -> Matrix {
    let (rows, columns) = (grid.len() as i64, grid[0].len() as i64);
    let value = |x: i64, y: i64| {
        let mut sum = 0.0;
        for j in -1..rows - 1 {
            for l in -1..columns - 1 {
                let (a, b) = (x - 2 * j + 2, y - 2 * l + 2);
                if (0..5).contains(&a) && (0..5).contains(&b) {
                    sum += mask[a as usize][b as usize] * grid[(j + 1) as usize][(l + 1) as usize];
                }
            }
        }
        sum
    };
    // inside, from -1 to one beyond the last cell
    let last = |count: i64| 2 * (count - 3) + 1;
    (-1..=last(rows)).map(|x| (-1..=last(columns)).map(|y| value(x, y)).collect()).collect()
}

/// What the grids tend to at the point `(0, 0)`, of which the nearest heights are enough.
pub fn limit(about: &Matrix, mask: &[[f64; 5]; 5]) -> f64 {
    let mut near = about.clone();
    for _ in 0..80 {
        // a grid from -1 to 1 is refined to one from -1 to 1
        let next = |x: i64, y: i64| {
            let mut sum = 0.0;
            for j in -1..=1_i64 {
                for l in -1..=1_i64 {
                    let (a, b) = (x - 2 * j + 2, y - 2 * l + 2);
                    if (0..5).contains(&a) && (0..5).contains(&b) {
                        sum += mask[a as usize][b as usize] * near[(j + 1) as usize][(l + 1) as usize];
                    }
                }
            }
            sum
        };
        near = (-1..=1).map(|x| (-1..=1).map(|y| next(x, y)).collect()).collect();
    }
    near[1][1]
}
