//! Affine maps of the plane and the moments of the measure that the chaos game draws.
//!
//! A system of maps `T_i` with probabilities `p_i` has one invariant measure: the distribution of a point `P`
//! that is that of `T_i(P)`, `i` chosen with `p_i`. Its mean and covariance solve linear systems, so a chaos
//! game has exact values to meet. Source: course unit V, "Fractals", 5.3.1-5.3.4 (maps, attractor, chaos
//! game); the moments are derived here.

/// The map `x' = a x + b y + e`, `y' = c x + d y + f`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Affine {
    /// How `x'` grows with `x`.
    pub a: f64,
    /// How `x'` grows with `y`.
    pub b: f64,
    /// How `y'` grows with `x`.
    pub c: f64,
    /// How `y'` grows with `y`.
    pub d: f64,
    /// `x'` of the origin.
    pub e: f64,
    /// `y'` of the origin.
    pub f: f64,
}

/// Mean and covariance of a distribution in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moments {
    /// The mean of `(x, y)`.
    pub mean: (f64, f64),
    /// The variance of `x`, the covariance of `x` and `y`, the variance of `y`.
    pub covariance: (f64, f64, f64),
}

impl Affine {
    /// The image of a point.
    pub fn apply(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (self.a * x + self.b * y + self.e, self.c * x + self.d * y + self.f)
    }

    /// The point that the map leaves where it is.
    ///
    /// # Panics
    /// When there is none, or more than one; a contraction has exactly one.
    pub fn fixed_point(&self) -> (f64, f64) {
        let [x, y] = solve([[1.0 - self.a, -self.b], [-self.c, 1.0 - self.d]], [self.e, self.f]);
        (x, y)
    }

    /// The factor by which the map stretches the most: the largest singular value of its matrix. A
    /// contraction is below 1.
    pub fn contraction(&self) -> f64 {
        // Every matrix is a rotation with scaling plus a reflection with scaling; the two factors add up.
        let rotation = libm::hypot(self.a + self.d, self.c - self.b) / 2.0;
        let reflection = libm::hypot(self.a - self.d, self.c + self.b) / 2.0;
        rotation + reflection
    }
}

/// The exact mean and covariance of the invariant measure of maps with probabilities.
///
/// From `m = sum p_i T_i(m)` and, with `s_i = T_i(m) - m`, `C = sum p_i (A_i C A_i^T + s_i s_i^T)`.
///
/// # Panics
/// When the probabilities are not one a map, not negative and of sum 1 within 1e-9, or when the systems are
/// singular.
pub fn moments(maps: &[Affine], probabilities: &[f64]) -> Moments {
    assert_eq!(maps.len(), probabilities.len(), "one probability for each map");
    assert!(probabilities.iter().all(|&p| p >= 0.0), "no probability is negative");
    assert!((probabilities.iter().sum::<f64>() - 1.0).abs() < 1e-9, "the probabilities add up to 1");
    let pairs = || maps.iter().zip(probabilities.iter().copied());
    let average = |term: &dyn Fn(&Affine) -> f64| pairs().fold(0.0, |sum, (map, p)| sum + p * term(map));

    let mean = Affine {
        a: average(&|map| map.a),
        b: average(&|map| map.b),
        c: average(&|map| map.c),
        d: average(&|map| map.d),
        e: average(&|map| map.e),
        f: average(&|map| map.f),
    }
    .fixed_point();

    // (I - sum p A (x) A) C = sum p s s^T, written out for C = (xx, xy, yy).
    let mut matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut right = [0.0; 3];
    for (map, p) in pairs() {
        let Affine { a, b, c, d, .. } = *map;
        let image = [[a * a, 2.0 * a * b, b * b], [a * c, a * d + b * c, b * d], [c * c, 2.0 * c * d, d * d]];
        for (row, image) in matrix.iter_mut().zip(image) {
            row.iter_mut().zip(image).for_each(|(entry, value)| *entry -= p * value);
        }
        let (x, y) = map.apply(mean);
        let (x, y) = (x - mean.0, y - mean.1);
        right = [right[0] + p * x * x, right[1] + p * x * y, right[2] + p * y * y];
    }
    let [xx, xy, yy] = solve(matrix, right);
    Moments { mean, covariance: (xx, xy, yy) }
}

/// The solution of a linear system, by Gaussian elimination with row pivots.
fn solve<const N: usize>(mut matrix: [[f64; N]; N], mut right: [f64; N]) -> [f64; N] {
    for k in 0..N {
        let pivot =
            (k..N).max_by(|&i, &j| matrix[i][k].abs().total_cmp(&matrix[j][k].abs())).expect("a row is left");
        assert!(matrix[pivot][k] != 0.0, "the system has no unique solution");
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        for i in 0..N {
            if i != k {
                let factor = matrix[i][k] / matrix[k][k];
                let row = matrix[k];
                matrix[i].iter_mut().zip(row).for_each(|(entry, value)| *entry -= factor * value);
                right[i] -= factor * right[k];
            }
        }
    }
    core::array::from_fn(|k| right[k] / matrix[k][k])
}

#[cfg(test)]
mod tests {
    use super::{Affine, moments, solve};

    const FERN: [Affine; 4] = [
        Affine { a: 0.0, b: 0.0, c: 0.0, d: 0.16, e: 0.0, f: 0.0 },
        Affine { a: 0.85, b: 0.04, c: -0.04, d: 0.85, e: 0.0, f: 1.6 },
        Affine { a: 0.2, b: -0.26, c: 0.23, d: 0.22, e: 0.0, f: 1.6 },
        Affine { a: -0.15, b: 0.28, c: 0.26, d: 0.24, e: 0.0, f: 0.44 },
    ];
    const FERN_PROBABILITIES: [f64; 4] = [0.01, 0.85, 0.07, 0.07];

    fn half(e: f64, f: f64) -> Affine {
        Affine { a: 0.5, b: 0.0, c: 0.0, d: 0.5, e, f }
    }

    #[test]
    fn a_linear_system_with_a_zero_on_the_diagonal_is_solved() {
        assert_eq!(
            solve([[0.0, 2.0, 1.0], [1.0, 0.0, 0.0], [4.0, 1.0, 0.0]], [7.0, 1.0, 6.0]),
            [1.0, 2.0, 3.0]
        );
    }

    #[test]
    fn fixed_points_stay() {
        assert_eq!(half(0.5, 0.25).fixed_point(), (1.0, 0.5));
        for map in FERN {
            let p = map.fixed_point();
            let q = map.apply(p);
            assert!((p.0 - q.0).abs() < 1e-14 && (p.1 - q.1).abs() < 1e-14);
        }
    }

    #[test]
    fn the_contraction_is_the_greatest_stretch_of_any_direction() {
        let turn = Affine { a: 0.0, b: -0.75, c: 0.75, d: 0.0, e: 9.0, f: 9.0 };
        assert_eq!(turn.contraction(), 0.75);
        let shear = Affine { a: 1.0, b: 1.0, c: 0.0, d: 1.0, e: 0.0, f: 0.0 };
        assert!((shear.contraction() - (1.0 + libm::sqrt(5.0)) / 2.0).abs() < 1e-15);
        for map in FERN {
            let stretch = |k: u32| {
                let angle = f64::from(k) * core::f64::consts::PI / 1000.0;
                let p = map.apply((libm::cos(angle), libm::sin(angle)));
                libm::hypot(p.0 - map.e, p.1 - map.f)
            };
            let greatest = (0..1000).map(stretch).fold(0.0, f64::max);
            assert!(greatest <= map.contraction() + 1e-15 && greatest > map.contraction() - 1e-5);
        }
    }

    #[test]
    fn the_unit_interval_has_the_variance_of_a_uniform_distribution() {
        // Two halves of a diagonal: x uniform on [0, 1], y = x.
        let moments = moments(&[half(0.0, 0.0), half(0.5, 0.5)], &[0.5, 0.5]);
        assert_eq!(moments.mean, (0.5, 0.5));
        let (xx, xy, yy) = moments.covariance;
        for variance in [xx, xy, yy] {
            assert!((variance - 1.0 / 12.0).abs() < 1e-16);
        }
    }

    #[test]
    fn the_gasket_of_the_text_balances_at_its_centroid() {
        // Corners (0,0), (1,0), (1/2,1): C = C/4 + (covariance of the corners) / 4, so C is a third of
        // theirs.
        let moments = moments(&[half(0.0, 0.0), half(0.5, 0.0), half(0.25, 0.5)], &[1.0 / 3.0; 3]);
        assert!((moments.mean.0 - 0.5).abs() < 1e-15 && (moments.mean.1 - 1.0 / 3.0).abs() < 1e-15);
        let (xx, xy, yy) = moments.covariance;
        assert!((xx - 1.0 / 18.0).abs() < 1e-15 && xy.abs() < 1e-15 && (yy - 2.0 / 27.0).abs() < 1e-15);
    }

    #[test]
    fn the_moments_of_the_fern_are_those_of_a_long_chaos_game() {
        let exact = moments(&FERN, &FERN_PROBABILITIES);
        let (mut p, mut state) = ((0.0, 0.0), 1_u64);
        let (mut sum, mut squares, count) = ((0.0, 0.0), (0.0, 0.0, 0.0), 1_000_000);
        for _ in 0..count {
            // Knuth's 64-bit linear congruential generator, high bits.
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let uniform = (state >> 11) as f64 / libm::exp2(53.0);
            let map = [0.01, 0.86, 0.93, 1.0].iter().position(|&limit| uniform < limit).expect("below 1");
            p = FERN[map].apply(p);
            sum = (sum.0 + p.0, sum.1 + p.1);
            squares = (squares.0 + p.0 * p.0, squares.1 + p.0 * p.1, squares.2 + p.1 * p.1);
        }
        let n = f64::from(count);
        let mean = (sum.0 / n, sum.1 / n);
        let (xx, xy, yy) = exact.covariance;
        assert!((mean.0 - exact.mean.0).abs() < 0.02 && (mean.1 - exact.mean.1).abs() < 0.05);
        assert!((squares.0 / n - mean.0 * mean.0 - xx).abs() < 0.02 * xx);
        assert!((squares.1 / n - mean.0 * mean.1 - xy).abs() < 0.1);
        assert!((squares.2 / n - mean.1 * mean.1 - yy).abs() < 0.02 * yy);
        assert!(xx > 0.5 && yy > 5.0);
    }
}
