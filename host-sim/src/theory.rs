//! What theory says about dimensions and spectra: equations solved in f64, with where they come from.

use attractor::ifs::Affine;

/// A value and its source.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Theory {
    pub(crate) value: f64,
    pub(crate) source: String,
}

impl Theory {
    pub(crate) fn new(value: f64, source: impl Into<String>) -> Self {
        Self { value, source: source.into() }
    }
}

/// Where a decreasing function passes 0 between two arguments; the nearer end where it does not.
pub(crate) fn root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..80 {
        let middle = (low + high) / 2.0;
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Moran's equation `sum r_j^D = 1` when all maps are similarities; none with a single map. More than 2 is no
/// dimension of a set in the plane.
pub(crate) fn similarity(maps: &[Affine]) -> Option<Theory> {
    let ratio = |m: &Affine| {
        let [a, b, c, d] = [m.a, m.b, m.c, m.d].map(|l| l.to_num::<f64>());
        let near = |u: f64, v: f64| (u - v).abs() < 1e-6;
        let is_similarity = (near(a, d) && near(b, -c)) || (near(a, -d) && near(b, c));
        let ratio = a.hypot(c);
        (is_similarity && ratio > 1e-6).then_some(ratio)
    };
    let ratios: Vec<f64> = maps.iter().map(ratio).collect::<Option<_>>()?;
    let dimension = root(|d| ratios.iter().map(|r| r.powf(d)).sum::<f64>() - 1.0, 0.0, 2.0);
    (ratios.len() > 1)
        .then(|| Theory::new(dimension, "similarity dimension: Moran's equation, unless images overlap"))
}

/// The dimension of the boundary of a curve or an attractor of core's catalogues, where it is known.
pub(crate) fn boundary_of(name: &str) -> Option<Theory> {
    let (value, source) = match name {
        "gosper" => (2.0 * 3.0_f64.ln() / 7.0_f64.ln(), "boundary of Gosper's island: 2 log 3 / log 7"),
        // 2^(D/2) is the real root of x^3 - x^2 - 2
        "heighway-dragon" => (1.523_627_086_2, "boundary of Heighway's dragon"),
        "terdragon" => (4.0_f64.ln() / 3.0_f64.ln(), "boundary of the terdragon: log 4 / log 3"),
        _ => return None,
    };
    Some(Theory::new(value, source))
}

/// The dimension of the graph of a fractal interpolation function with scalings `alpha_j` over intervals that
/// are a part `a_j` of the whole: `sum |alpha_j| a_j^(D - 1) = 1` when `sum |alpha_j| > 1`, else 1.
///
/// Source: M. F. Barnsley, "Fractal functions and interpolation", 1986, theorem 4 (equal intervals); T.
/// Bedford, "Hölder exponents and box dimension for self-affine fractal functions", 1989.
pub(crate) fn graph_dimension(maps: &[(f64, f64)]) -> Theory {
    let sum = |d: f64| maps.iter().map(|(alpha, a)| alpha.abs() * a.powf(d - 1.0)).sum::<f64>() - 1.0;
    Theory::new(
        root(sum, 1.0, 2.0),
        "sum |alpha_j| a_j^(D-1) = 1 where that is above 1, unless the graph is smooth",
    )
}

/// The spectral exponent of the same function: `sum alpha_j^2 a_j^(2 - beta) = 1`, none where that is not
/// between 1 and 3.
///
/// Second differences at distance `a_j h` inside the interval `j` are `alpha_j` times those at `h`, so that
/// their mean square `S` obeys `S(h) = sum a_j alpha_j^2 S(h / a_j)` up to smooth terms, and is a power
/// `h^(beta - 1)`.
pub(crate) fn graph_spectrum(maps: &[(f64, f64)]) -> Option<Theory> {
    // increases with beta
    let sum = |beta: f64| maps.iter().map(|(alpha, a)| alpha * alpha * a.powf(2.0 - beta)).sum::<f64>();
    let beta = root(|beta| 1.0 - sum(beta), 1.0, 3.0);
    (sum(1.0) < 1.0 && sum(3.0) > 1.0).then(|| Theory::new(beta, "sum alpha_j^2 a_j^(2-beta) = 1"))
}

/// The mean of `f(R)` for a standard normal `R`: the midpoint rule.
pub(crate) fn expected(f: impl Fn(f64) -> f64) -> f64 {
    const STEP: f64 = 1.0 / 16.0;
    let density = |x: f64| (-x * x / 2.0).exp() / std::f64::consts::TAU.sqrt();
    (-144..144).map(|i| (f64::from(i) + 0.5) * STEP).map(|x| f(x) * density(x) * STEP).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_equations_have_the_solutions_of_the_texts() {
        // equal intervals: 1 + log(sum |alpha|) / log N and 2 - log(sum alpha^2) / log N
        let thirds = [(0.5, 1.0 / 3.0), (-0.7, 1.0 / 3.0), (0.4, 1.0 / 3.0)];
        let (sum, square) = (1.6_f64, 0.25 + 0.49 + 0.16_f64);
        assert!((graph_dimension(&thirds).value - 1.0 - sum.ln() / 3.0_f64.ln()).abs() < 1e-12);
        assert!((graph_spectrum(&thirds).unwrap().value - 2.0 + square.ln() / 3.0_f64.ln()).abs() < 1e-12);
        // alpha_j = a_j^(1/2): H = 1/2, D = 3/2, beta = 2, as of a Brownian motion
        let uneven = [0.1_f64, 0.6, 0.3].map(|a| (a.sqrt(), a));
        assert!((graph_dimension(&uneven).value - 1.5).abs() < 1e-12);
        assert!((graph_spectrum(&uneven).unwrap().value - 2.0).abs() < 1e-12);
        assert_eq!(graph_dimension(&[(0.3, 0.5), (0.2, 0.5)]).value, 1.0);
        assert!(graph_spectrum(&[(0.01, 0.5), (0.2, 0.5)]).is_none());
    }

    #[test]
    fn normal_moments_are_normal() {
        let odd = [1.0, 1.0, 3.0, 15.0];
        for (n, want) in (0..).zip(odd) {
            assert!((expected(|x| x.powi(2 * n)) - want).abs() < 1e-9, "{n}");
            assert!(expected(|x| x.powi(2 * n + 1)).abs() < 1e-9, "{n}");
        }
    }
}
