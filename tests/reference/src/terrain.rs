//! Surfaces by subdivision: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, "A
//! fractal plane-to-line function", and the inner geometries of figures 8 to 11.

/// A grid of numbers at the integers, `grid[v][u]`.
pub type Grid = Vec<Vec<f64>>;

/// The random function of the text: two numbers for each point.
pub type Random<'a> = &'a dyn Fn(f64, f64) -> [f64; 2];

/// The height at `(u, v)`, which is a point of the lattice of `levels` halvings, by recursion as in the text:
/// the offset is multiplied by `2^-similarity` a level.
///
/// # Panics
/// Unless `(u, v)` lies inside the grid.
pub fn plane_to_line(knots: &Grid, offset: f64, similarity: f64, r: Random<'_>, [u, v]: [f64; 2]) -> f64 {
    let i = (u.floor() as usize).min(knots[0].len() - 2);
    let j = (v.floor() as usize).min(knots.len() - 2);
    let corners = [knots[j][i], knots[j][i + 1], knots[j + 1][i + 1], knots[j + 1][i]];
    quadrilateral([i as f64, j as f64], 1.0, corners, offset, libm::exp2(-similarity), r, [u, v])
}

/// One quadrilateral `[u1, v1], [u2, v1], [u2, v2], [u1, v2]`.
fn quadrilateral(
    [u1, v1]: [f64; 2],
    side: f64,
    h: [f64; 4],
    offset: f64,
    factor: f64,
    r: Random<'_>,
    at: [f64; 2],
) -> f64 {
    let (u2, v2, um, vm) = (u1 + side, v1 + side, u1 + side / 2.0, v1 + side / 2.0);
    for (corner, height) in [[u1, v1], [u2, v1], [u2, v2], [u1, v2]].into_iter().zip(h) {
        if corner == at {
            return height;
        }
    }
    assert!(side > 1e-6, "not a point of the lattice");
    // the line-to-line procedure on the edges, the first number along u, the second along v
    let south = (h[0] + h[1]) / 2.0 + offset * r(um, v1)[0];
    let east = (h[1] + h[2]) / 2.0 + offset * r(u2, vm)[1];
    let north = (h[2] + h[3]) / 2.0 + offset * r(um, v2)[0];
    let west = (h[3] + h[0]) / 2.0 + offset * r(u1, vm)[1];
    // on both midlines: the mean, and both displacements added
    let [along, across] = r(um, vm);
    let centre = ((west + east) / 2.0 + (south + north) / 2.0) / 2.0 + offset * (along + across);
    let (corner, h) = match (at[0] < um, at[1] < vm) {
        (true, true) => ([u1, v1], [h[0], south, centre, west]),
        (false, true) => ([um, v1], [south, h[1], east, centre]),
        (false, false) => ([um, vm], [centre, east, h[2], north]),
        (true, false) => ([u1, vm], [west, centre, north, h[3]]),
    };
    quadrilateral(corner, side / 2.0, h, offset * factor, factor, r, at)
}

/// What spans the cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Inner {
    /// Figure 8.
    Bilinear,
    /// Figure 9.
    Ferguson,
    /// Figure 10.
    BSpline,
}

/// The height over the grid at any place, and its derivatives along `u` and `v`, by basis functions.
pub fn spanned(grid: &Grid, inner: Inner, u: f64, v: f64) -> [f64; 3] {
    let (columns, rows) = (grid[0].len() as i64, grid.len() as i64);
    let i = (u.floor() as i64).clamp(0, columns - 2);
    let j = (v.floor() as i64).clamp(0, rows - 2);
    let (s, t) = (u - i as f64, v - j as f64);
    // beyond the rim, mirrored at the last vertex
    let at = |i: i64, j: i64| -> f64 {
        let along = |j: usize, i: i64| match i {
            -1 => 2.0 * grid[j][0] - grid[j][1],
            i if i == columns => 2.0 * grid[j][i as usize - 1] - grid[j][i as usize - 2],
            i => grid[j][i as usize],
        };
        match j {
            -1 => 2.0 * along(0, i) - along(1, i),
            j if j == rows => 2.0 * along(j as usize - 1, i) - along(j as usize - 2, i),
            j => along(j as usize, i),
        }
    };
    match inner {
        Inner::Bilinear => {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
            [
                a * (1.0 - s) * (1.0 - t) + b * s * (1.0 - t) + c * (1.0 - s) * t + d * s * t,
                (b - a) * (1.0 - t) + (d - c) * t,
                (c - a) * (1.0 - s) + (d - b) * s,
            ]
        }
        Inner::Ferguson => {
            // Hermite's: values, then slopes, at both ends; and their derivatives
            let hermite = |x: f64| {
                [
                    (2.0 * x - 3.0) * x * x + 1.0,
                    (3.0 - 2.0 * x) * x * x,
                    ((x - 2.0) * x + 1.0) * x,
                    (x - 1.0) * x * x,
                ]
            };
            let derived = |x: f64| {
                [6.0 * x * (x - 1.0), 6.0 * x * (1.0 - x), (3.0 * x - 4.0) * x + 1.0, (3.0 * x - 2.0) * x]
            };
            let sum = |f: [f64; 4], g: [f64; 4]| {
                let mut sum = 0.0;
                for (a, b) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let (i, j) = (i + a as i64, j + b as i64);
                    let along_u = (at(i + 1, j) - at(i - 1, j)) / 2.0;
                    let along_v = (at(i, j + 1) - at(i, j - 1)) / 2.0;
                    sum += at(i, j) * f[a] * g[b];
                    sum += along_u * f[2 + a] * g[b] + along_v * f[a] * g[2 + b];
                }
                sum
            };
            [sum(hermite(s), hermite(t)), sum(derived(s), hermite(t)), sum(hermite(s), derived(t))]
        }
        Inner::BSpline => {
            let basis = |x: f64| {
                let y = 1.0 - x;
                [
                    y * y * y,
                    3.0 * x * x * x - 6.0 * x * x + 4.0,
                    3.0 * y * y * y - 6.0 * y * y + 4.0,
                    x * x * x,
                ]
                .map(|b| b / 6.0)
            };
            let derived = |x: f64| {
                let y = 1.0 - x;
                [-y * y / 2.0, (3.0 * x - 4.0) * x / 2.0, -(3.0 * y - 4.0) * y / 2.0, x * x / 2.0]
            };
            let sum = |f: [f64; 4], g: [f64; 4]| {
                let mut sum = 0.0;
                for (a, f) in (-1..).zip(f) {
                    for (b, g) in (-1..).zip(g) {
                        sum += at(i + a, j + b) * f * g;
                    }
                }
                sum
            };
            [sum(basis(s), basis(t)), sum(derived(s), basis(t)), sum(basis(s), derived(t))]
        }
    }
}

/// The two numbers of a random field at a point, in units of `2^-16`: three multiplications by an odd number,
/// the upper word added to the lower one modulo 2 after each; each half of the result is an index of nine
/// bits from above and a sign from below.
pub fn deviates(seed: u64, u: i32, v: i32) -> [f64; 2] {
    let mixed = |mut h: u128| {
        for _ in 0..3 {
            h = h * 0x9e37_79b1 % (1 << 64);
            h ^= h >> 32;
        }
        h
    };
    let key = mixed(u128::from(seed ^ 0x9e37_79b9_7f4a_7c15));
    let point = u128::from(u as u32) << 32 | u128::from(v as u32);
    let hash = mixed(point ^ key);
    [hash >> 32, hash % (1 << 32)].map(|half| {
        let magnitude = quantile((half >> 23) as usize);
        if half % 2 == 1 { -magnitude } else { magnitude }
    })
}

/// The quantiles `1/2 + (i + 1/2) / 1024` of the normal distribution, scaled to variance 1.
fn quantile(index: usize) -> f64 {
    static TABLE: std::sync::LazyLock<Vec<f64>> = std::sync::LazyLock::new(|| {
        let raw: Vec<f64> = (0..512)
            .map(|i| {
                let wanted = (f64::from(i) + 0.5) / 512.0;
                let (mut low, mut high) = (0.0, 8.0);
                for _ in 0..80 {
                    let middle = (low + high) / 2.0;
                    if libm::erf(middle / std::f64::consts::SQRT_2) < wanted {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                low
            })
            .collect();
        let deviation = libm::sqrt(raw.iter().map(|x| x * x).sum::<f64>() / 512.0);
        raw.iter().map(|x| x / deviation).collect()
    });
    TABLE[index]
}
