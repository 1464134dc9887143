//! Fractal interpolation functions: `f(L_j(x)) = alpha_j f(x) + q_j(x)`, evaluated by walking the address of
//! `x`.
//!
//! `f(x) = q_j1(x_1) + alpha_j1 q_j2(x_2) + alpha_j1 alpha_j2 q_j3(x_3) + ...`, where `x_k` is the k-th
//! pre-image of `x` and `j1 j2 j3 ...` its address. Source: Cochran, Lewis and Hart, "The Normal of a Fractal
//! Surface", section 2, eq. 3-17. The calculus is in `calculus.rs`, evaluation by composing maps in
//! `compose.rs`.

use crate::double_double::DoubleDouble;
use crate::polynomial::Polynomial;

/// The walk ends when the product of the vertical scalings is smaller: the rest of the series cannot be seen.
const NEGLIGIBLE: f64 = 1e-20;
/// The longest walk: 0.99^4000 is 3e-18.
const LEVELS: usize = 4000;

/// One map: `F_j(x, y) = vertical_scaling y + q(x)` (Cochran et al., eq. 8). Its `L_j` follows from the knots
/// (eq. 6-7).
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// `alpha_j`, between -1 and 1.
    pub vertical_scaling: f64,
    /// The coefficients of `q_j` in `x`, constant first (eq. 9).
    pub q: Vec<f64>,
}

/// A fractal interpolation function on `[x_0, x_N]` (Cochran et al., section 2).
///
/// The fields are for reading. Values are computed from polynomials in `u = (x - x_0) / (x_N - x_0)`, which
/// lose nothing on domains far from the origin; the `q` of `maps` are the same polynomials in `x`, rounded.
#[derive(Debug, Clone, PartialEq)]
pub struct Fif {
    /// The abscissae `x_0 < x_1 < ... < x_N`.
    pub knots_x: Vec<f64>,
    /// The N maps, from left to right.
    pub maps: Vec<Map>,
    /// `y_0 = f(x_0)`.
    pub first: f64,
    /// `y_N = f(x_N)`.
    pub last: f64,
    /// `q_j` in the normalised abscissa `u`.
    unit_q: Vec<Polynomial>,
}

impl Fif {
    /// The function through `knots` with affine `q_j`, fixed by eq. 10-11.
    ///
    /// # Panics
    /// With fewer than two knots, abscissae that do not increase, or scalings that are not one a map and
    /// inside (-1, 1).
    pub fn interpolating(knots: &[(f64, f64)], vertical_scaling: &[f64]) -> Self {
        assert_eq!(
            knots.len(),
            vertical_scaling.len() + 1,
            "one vertical scaling for each interval between knots"
        );
        let knots_x: Vec<f64> = knots.iter().map(|knot| knot.0).collect();
        let y: Vec<DoubleDouble> = knots.iter().map(|knot| DoubleDouble::from(knot.1)).collect();
        let (first, last) = (y[0], y[y.len() - 1]);
        let affine = |(j, &alpha): (usize, &f64)| {
            let alpha = DoubleDouble::from(alpha);
            Polynomial(vec![y[j] - alpha * first, y[j + 1] - y[j] - alpha * (last - first)])
        };
        let unit_q = vertical_scaling.iter().enumerate().map(affine).collect();
        Self::from_unit(&knots_x, vertical_scaling, unit_q, first.value(), last.value())
    }

    /// The function of given maps. `y_0` and `y_N` are the fixed points of the first and of the last map at
    /// their ends.
    ///
    /// The maps need not join at the inner knots; where they do not, `f` takes the value of the map on the
    /// left.
    ///
    /// # Panics
    /// With abscissae that do not increase, or maps that are not one an interval and of scalings inside (-1,
    /// 1).
    pub fn from_polynomials(knots_x: &[f64], maps: Vec<Map>) -> Self {
        check(knots_x, maps.len());
        let start = DoubleDouble::from(knots_x[0]);
        let length = DoubleDouble::from(knots_x[maps.len()]) - start;
        let unit_q = maps.iter().map(|map| Polynomial::new(&map.q).substitute(start, length)).collect();
        let scaling: Vec<f64> = maps.iter().map(|map| map.vertical_scaling).collect();
        Self { maps, ..Self::from_unit_polynomials(knots_x, &scaling, unit_q) }
    }

    /// From the `q_j` in the normalised abscissa, with the ends found as fixed points.
    pub(crate) fn from_unit_polynomials(knots_x: &[f64], scaling: &[f64], unit_q: Vec<Polynomial>) -> Self {
        check(knots_x, unit_q.len());
        let fixed = |j: usize, u: DoubleDouble| {
            (unit_q[j].at(u) / (DoubleDouble::ONE - DoubleDouble::from(scaling[j]))).value()
        };
        let (first, last) = (fixed(0, DoubleDouble::ZERO), fixed(unit_q.len() - 1, DoubleDouble::ONE));
        Self::from_unit(knots_x, scaling, unit_q, first, last)
    }

    fn from_unit(knots_x: &[f64], scaling: &[f64], unit_q: Vec<Polynomial>, first: f64, last: f64) -> Self {
        check(knots_x, unit_q.len());
        assert!(scaling.iter().all(|alpha| alpha.abs() < 1.0), "every vertical scaling lies inside (-1, 1)");
        let length = DoubleDouble::from(knots_x[unit_q.len()]) - DoubleDouble::from(knots_x[0]);
        let start = -DoubleDouble::from(knots_x[0]) / length;
        let in_x = |q: &Polynomial| q.substitute(start, DoubleDouble::ONE / length).coefficients();
        let maps = scaling.iter().zip(&unit_q);
        let maps = maps.map(|(&vertical_scaling, q)| Map { vertical_scaling, q: in_x(q) }).collect();
        Self { knots_x: knots_x.to_vec(), maps, first, last, unit_q }
    }

    /// `f(x)`, for `x` in `[x_0, x_N]`: better than 1e-12 for values up to 100 and scalings up to 0.99.
    ///
    /// The address is exact wherever the pre-images are numbers of at most 106 bits (dyadic abscissae on
    /// dyadic partitions, or on partitions by integers); elsewhere the result is that of an abscissa within
    /// about 2^-100 of the domain's width.
    ///
    /// # Panics
    /// When `x` is outside.
    pub fn at(&self, x: f64) -> f64 {
        let n = self.maps.len();
        assert!(self.knots_x[0] <= x && x <= self.knots_x[n], "{x} is outside the domain");
        let length = self.offset(n);
        let mut rest = DoubleDouble::from(x) - DoubleDouble::from(self.knots_x[0]);
        if n == 1 {
            // One map covers the whole domain: f = alpha f + q.
            return (self.unit_q[0].at(rest / length) / (DoubleDouble::ONE - self.scaling(0))).value();
        }
        let (mut sum, mut product) = (DoubleDouble::ZERO, DoubleDouble::ONE);
        for _ in 0..LEVELS {
            let at_an_end = rest == DoubleDouble::ZERO || rest == length;
            if at_an_end || product.value().abs() < NEGLIGIBLE {
                break;
            }
            let j = self.interval(rest);
            rest = (rest - self.offset(j)) * length / self.width(j);
            rest = rest.max(DoubleDouble::ZERO).min(length);
            sum = sum + product * self.unit_q[j].at(rest / length);
            product = product * self.scaling(j);
        }
        let end = if rest + rest <= length { self.first } else { self.last };
        (sum + product * DoubleDouble::from(end)).value()
    }

    /// Number, scaling, constant and slope of each map in the unit abscissa.
    ///
    /// # Panics
    /// When a map is of a higher degree.
    pub(crate) fn affine(&self) -> Vec<(usize, f64, f64, f64)> {
        let map = |(j, q): (usize, &Polynomial)| {
            let q = q.coefficients();
            assert!(q.len() <= 2, "an affine map");
            let coefficient = |k: usize| q.get(k).copied().unwrap_or(0.0);
            (j, self.maps[j].vertical_scaling, coefficient(0), coefficient(1))
        };
        self.unit_q.iter().enumerate().map(map).collect()
    }

    /// The points `(x_j, y_j)` that the function passes through.
    pub fn knots(&self) -> Vec<(f64, f64)> {
        let last = DoubleDouble::from(self.last);
        let right = |j: usize| (self.unit_q[j].at(DoubleDouble::ONE) + self.scaling(j) * last).value();
        let inner = (0..self.maps.len()).map(|j| (self.knots_x[j + 1], right(j)));
        core::iter::once((self.knots_x[0], self.first)).chain(inner).collect()
    }

    /// The largest `|alpha_j|`.
    pub fn max_scaling(&self) -> f64 {
        self.maps.iter().fold(0.0, |max, map| map.vertical_scaling.abs().max(max))
    }

    /// The interval that holds the abscissa `x_0 + rest`; a knot belongs to the interval on its left, as in
    /// Algorithm 2.
    fn interval(&self, rest: DoubleDouble) -> usize {
        let last = self.maps.len() - 1;
        (0..last).find(|&j| rest <= self.offset(j + 1)).unwrap_or(last)
    }

    /// `x_j - x_0`, exact.
    pub(crate) fn offset(&self, j: usize) -> DoubleDouble {
        DoubleDouble::from(self.knots_x[j]) - DoubleDouble::from(self.knots_x[0])
    }

    /// The width of the interval of map `j` (from 0), exact.
    pub(crate) fn width(&self, j: usize) -> DoubleDouble {
        DoubleDouble::from(self.knots_x[j + 1]) - DoubleDouble::from(self.knots_x[j])
    }

    /// `alpha_j` of map `j` (from 0).
    pub(crate) fn scaling(&self, j: usize) -> DoubleDouble {
        DoubleDouble::from(self.maps[j].vertical_scaling)
    }

    /// The `q_j` in the normalised abscissa.
    pub(crate) fn unit_q(&self) -> &[Polynomial] {
        &self.unit_q
    }
}

fn check(knots_x: &[f64], maps: usize) {
    assert!(maps > 0 && knots_x.len() == maps + 1, "one map for each interval between knots");
    assert!(knots_x.windows(2).all(|pair| pair[0] < pair[1]), "the abscissae of the knots increase");
}

#[cfg(test)]
mod tests {
    use super::{Fif, Map};

    const KNOTS: [(f64, f64); 3] = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)];

    #[test]
    fn the_maps_of_f_and_g_are_those_of_equations_20_to_23() {
        let f = Fif::interpolating(&KNOTS, &[0.5, 0.5]);
        assert_eq!((&f.maps[0].q[..], &f.maps[1].q[..]), (&[0.0, 0.5][..], &[1.0, -0.5][..]));
        let g = Fif::interpolating(&KNOTS, &[0.85, -0.85]);
        assert_eq!((&g.maps[0].q, &g.maps[1].q), (&f.maps[0].q, &f.maps[1].q));
        assert_eq!(g.max_scaling(), 0.85);
        assert_eq!(Fif::from_polynomials(&g.knots_x, g.maps.clone()), g);
    }

    #[test]
    fn f_and_g_pass_through_their_knots_and_known_values() {
        let f = Fif::interpolating(&KNOTS, &[0.5, 0.5]);
        let g = Fif::interpolating(&KNOTS, &[0.85, -0.85]);
        assert_eq!((f.knots(), g.knots()), (KNOTS.to_vec(), KNOTS.to_vec()));
        assert_eq!((f.at(0.0), f.at(1.0), f.at(2.0)), (0.0, 1.0, 0.0));
        assert_eq!((f.at(0.5), f.at(0.25), f.at(1.25)), (1.0, 0.75, 1.25));
        assert_eq!((g.at(0.5), g.at(1.5)), (0.85 + 0.5, 0.5 - 0.85));
        // f is twice Takagi's function of x/2, which is 2/3 at a third.
        assert!((f.at(2.0 / 3.0) - 4.0 / 3.0).abs() < 1e-14);
    }

    #[test]
    fn every_map_sends_the_graph_into_itself() {
        let knots = [(-1.0, 2.0), (0.5, -3.0), (1.0, 4.0), (3.0, 1.0)];
        let f = Fif::interpolating(&knots, &[0.3, -0.7, 0.25]);
        for i in 0..=64 {
            let x = -1.0 + f64::from(i) / 16.0;
            for (j, map) in f.maps.iter().enumerate() {
                let image = knots[j].0 + (x + 1.0) / 4.0 * (knots[j + 1].0 - knots[j].0);
                let expected = map.vertical_scaling * f.at(x) + map.q[0] + map.q[1] * x;
                assert!((f.at(image) - expected).abs() < 1e-13, "map {j} at {x}");
            }
        }
    }

    #[test]
    fn large_scalings_agree_with_exact_integer_arithmetic() {
        // alpha = 127/128 and -127/128, knots 0, 90, -50 on [0, 1], x = i / 2^9: everything is an integer
        // over 2^(8 k).
        let f =
            Fif::interpolating(&[(0.0, 0.0), (0.5, 90.0), (1.0, -50.0)], &[127.0 / 128.0, -127.0 / 128.0]);
        let exact = |i: i128| {
            let (mut sum, mut product, mut unit, mut rest) = (0_i128, 1_i128, 0_u32, i);
            while rest != 0 && rest != 512 {
                let (c0, c1, alpha) = if rest <= 256 {
                    (0, 90 * 128 + 127 * 50, 127)
                } else {
                    (90 * 128, -140 * 128 - 127 * 50, -127)
                };
                rest = 2 * rest - if rest <= 256 { 0 } else { 512 };
                // sum is over 2^(9 + 7 unit), product over 2^(7 unit), q over 2^(9 + 7).
                sum = sum * 128 + product * (c0 * 512 + c1 * rest);
                product *= alpha;
                unit += 1;
            }
            sum += product * if rest == 0 { 0 } else { -50 * 512 };
            sum as f64 / libm::exp2(f64::from(9 + 7 * unit))
        };
        let worst = (0..=512).map(|i| (f.at(i as f64 / 512.0) - exact(i)).abs()).fold(0.0, f64::max);
        assert!(worst < 2e-13, "{worst}");
        assert!((0..512).any(|i| exact(i).abs() > 200.0));
    }

    #[test]
    fn a_domain_far_from_the_origin_costs_no_accuracy() {
        let scaling = [0.99, -0.99];
        let near = Fif::interpolating(&[(0.0, 10.0), (0.5, -20.0), (1.0, 15.0)], &scaling);
        let far = Fif::interpolating(&[(1700.0, 10.0), (1854.0, -20.0), (2008.0, 15.0)], &scaling);
        for i in 0..=1024 {
            let u = f64::from(i) / 1024.0 + if i < 512 { libm::exp2(-35.0) } else { 0.0 };
            assert!((near.at(u) - far.at(1700.0 + 308.0 * u)).abs() < 1e-13);
        }
    }

    #[test]
    fn the_fixed_point_of_the_middle_map_is_exact_on_a_partition_by_integers() {
        let f = Fif::interpolating(&[(0.0, 0.0), (1.0, 5.0), (2.0, 7.0), (3.0, 1.0)], &[0.5, 0.99, 0.5]);
        let middle = &f.maps[1];
        let expected = (middle.q[0] + 1.5 * middle.q[1]) / (1.0 - 0.99);
        assert!((f.at(1.5) - expected).abs() < 1e-10 && expected > 400.0);
    }

    #[test]
    fn a_single_map_is_a_polynomial_and_maps_need_not_join() {
        let one =
            Fif::from_polynomials(&[0.0, 2.0], vec![Map { vertical_scaling: 0.75, q: vec![1.0, 0.0, 0.5] }]);
        assert_eq!((one.at(0.0), one.at(1.0), one.at(2.0)), (4.0, 6.0, 12.0));
        let step = |c: f64| Map { vertical_scaling: 0.0, q: vec![c] };
        let jump = Fif::from_polynomials(&[0.0, 1.0, 2.0], vec![step(3.0), step(5.0)]);
        assert_eq!((jump.at(0.0), jump.at(1.0), jump.at(1.25), jump.at(2.0)), (3.0, 3.0, 5.0, 5.0));
    }
}
