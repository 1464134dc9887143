//! What a fit is compared with: tensor products of B-splines by least squares, degrees 1 to 3.
//!
//! Uniform knots, ends repeated, as many coefficients along both sides as make about as many as there are
//! parameters. Source: C. de Boor, "A Practical Guide to Splines", 1978.

use nalgebra::DMatrix;

use super::solver::Samples;

/// The values of all basis functions at each of `samples` places of `[0, 1]`, ends included.
fn basis(coefficients: usize, samples: usize, degree: usize) -> DMatrix<f64> {
    let spans = coefficients - degree;
    let knot = |k: usize| (k.saturating_sub(degree) as f64 / spans as f64).min(1.0);
    let mut all = DMatrix::zeros(samples, coefficients);
    for place in 0..samples {
        let x = place as f64 / (samples - 1) as f64;
        let span = ((x * spans as f64) as usize).min(spans - 1) + degree;
        // de Boor's recurrence for those that are not 0
        let mut values = vec![1.0];
        for d in 1..=degree {
            let mut next = vec![0.0; d + 1];
            for (k, value) in values.iter().enumerate() {
                let (low, high) = (knot(span + k + 1 - d), knot(span + k + 1));
                let share = (x - low) / (high - low);
                next[k] += (1.0 - share) * value;
                next[k + 1] += share * value;
            }
            values = next;
        }
        for (k, value) in values.iter().enumerate() {
            all[(place, span - degree + k)] = *value;
        }
    }
    all
}

/// Coefficients along both sides, about so many in all.
pub(crate) fn sides(parameters: usize) -> [usize; 2] {
    let one = (parameters as f64).sqrt().round().max(2.0) as usize;
    let other = (parameters as f64 / one as f64).round().max(2.0) as usize;
    [one, other]
}

/// The sum of squares that the best spline of a degree leaves; none where there are too few coefficients or
/// samples.
pub(crate) fn squared_error(samples: &Samples, [a, b]: [usize; 2], degree: usize) -> Option<f64> {
    let side = samples.side;
    if a.min(b) <= degree || a.max(b) > side {
        return None;
    }
    let values = DMatrix::from_row_slice(side, side, &samples.values);
    let project = |count: usize| {
        let basis = basis(count, side, degree);
        let solver = (basis.transpose() * &basis).cholesky()?;
        // B (B'B)^-1 B'
        Some(&basis * solver.solve(&basis.transpose()))
    };
    let fitted = project(a)? * &values * project(b)?;
    Some((values - fitted).norm_squared())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Polynomials of the degree are left without a remainder, those of the next are not.
    #[test]
    fn a_spline_reproduces_polynomials_of_its_degree() {
        let samples = |power: i32| {
            let place = |k: usize| k as f64 / 32.0;
            let values =
                (0..33 * 33).map(|k| place(k / 33).powi(power) * (1.0 - place(k % 33)).powi(power)).collect();
            Samples { side: 33, values }
        };
        for degree in 1..=3 {
            let error = |power| squared_error(&samples(power), [7, 9], degree).unwrap();
            assert!(error(degree as i32) < 1e-20 && error(degree as i32 + 1) > 1e-9, "{degree}");
        }
        assert!(
            squared_error(&samples(1), [3, 9], 3).is_none()
                && squared_error(&samples(1), [34, 9], 1).is_none()
        );
        assert_eq!((sides(142), sides(382), sides(81)), ([12, 12], [20, 19], [9, 9]));
    }
}
