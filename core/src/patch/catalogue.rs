//! Curves that have a name: Bezier, B-spline, Takagi, and the six types of figure 2.
//!
//! Bezier: de Casteljau's algorithm at 1/2; columns are `binomial(k, i) / 2^k`. B-spline: a uniform one of
//! degree `M - 1` between two knots; its control polygon is refined by `binomial(M, k) / 2^(M-1)` (J. M.
//! Lane, R. F. Riesenfeld, 1980). Takagi: `f(x) = sum_n d(2^n x) / 2^n`, `d` the distance to the next integer
//! (T. Takagi, 1903), over the unit interval through `(0,0) (1/2,1/2) (1,0)`.

use super::barycentric::{Barycentric, unit};
use super::curve::ProjectedCurve;
use crate::Error;
use crate::num::{Near, Wide};

/// `binomial(n, k)` for small `n`; 0 outside `0 ..= n`.
fn binomial(n: usize, k: i64) -> i64 {
    let Ok(k) = u64::try_from(k) else { return 0 };
    (0..k).fold(1, |so_far, i| so_far * (n as i64 - i as i64).max(0) / (i as i64 + 1))
}

/// `numerator / 2^places`, exact for `places` up to 28.
fn dyadic(numerator: i64, places: usize) -> Near {
    Near::from_bits((numerator << 28usize.saturating_sub(places)) as i32)
}

/// A matrix by its entries, column after column.
fn matrix<const M: usize>(entry: impl Fn(usize, usize) -> Near) -> Result<Barycentric<M>, Error> {
    let mut columns = [[Near::ZERO; M]; M];
    for (k, column) in columns.iter_mut().enumerate() {
        for (i, place) in column.iter_mut().enumerate() {
            *place = entry(i, k);
        }
    }
    Barycentric::from_columns(columns)
}

fn of_degree<const M: usize>() -> Result<usize, Error> {
    match M {
        2..=17 => Ok(M - 1),
        0 | 1 => Err(Error::TooFew { what: "control points", given: M, at_least: 2 }),
        _ => Err(Error::Capacity { what: "control points", needed: M, capacity: 17 }),
    }
}

/// The Bezier curve of degree `M - 1`, at most 16.
///
/// # Errors
/// [`Error::TooFew`], [`Error::Capacity`] for other degrees.
pub fn bezier<const M: usize>() -> Result<ProjectedCurve<2, M>, Error> {
    let degree = of_degree::<M>()?;
    let left = matrix(|i, k| dyadic(binomial(k, i as i64), k))?;
    let right = matrix(|i, k| dyadic(binomial(degree - k, i as i64 - k as i64), degree - k))?;
    ProjectedCurve::new([left, right])
}

/// The uniform B-spline of degree `M - 1`, at most 3, between two of its knots.
///
/// # Errors
/// [`Error::TooFew`], [`Error::Unsupported`] for other degrees.
pub fn b_spline<const M: usize>() -> Result<ProjectedCurve<2, M>, Error> {
    let degree = of_degree::<M>()?;
    // the values of the basis at a knot
    let at_a_knot: &[i32] = match degree {
        1 => &[1, 0],
        2 => &[1, 1, 0],
        3 => &[1, 4, 1, 0],
        _ => return Err(Error::Unsupported { what: "degree of a B-spline", allowed: "degrees 1 to 3" }),
    };
    let sum = at_a_knot.iter().sum::<i32>().max(1);
    let mut start = [Near::ZERO; M];
    let mut rest = Near::ONE;
    for (weight, value) in start.iter_mut().zip(at_a_knot) {
        *weight = Near::from_bits((value << 28) / sum);
        rest -= *weight;
    }
    // what rounding left goes to the middle: the two sides stay equal
    if let Some(middle) = start.get_mut(degree / 2) {
        *middle += rest;
    }
    let mut end = [Near::ZERO; M];
    for (weight, value) in end.iter_mut().rev().zip(start) {
        *weight = value;
    }
    // new point k from old point i: binomial(M, k + shift - 2 i + ...)
    let mask = |k: i64, i: i64| dyadic(binomial(M, k - 2 * i + degree as i64), degree);
    let left = matrix(|i, k| mask(k as i64, i as i64))?;
    let right = matrix(|i, k| mask(k as i64 + 1, i as i64))?;
    ProjectedCurve::with_ends([left, right], [start, end])
}

/// Takagi's curve over three control points: both ends and the point above the middle, twice as high as
/// there.
///
/// The control points `(0, 0), (1/2, 1/2), (1, 0)` give the graph of Takagi's function.
///
/// # Errors
/// None.
pub fn takagi() -> Result<ProjectedCurve<2, 3>, Error> {
    const SHEARING: [Near; 2] = [Near::lit("1"), Near::lit("-0.25")];
    standard_curve(SHEARING, SHEARING)
}

/// The curve of three control points through all of them: `T_0 = (e_0, u, e_1)`, `T_1 = (e_1, v, e_2)`, with
/// `u = (1 - a - b, a, b)` and `v = (d, c, 1 - c - d)` for `first = [a, b]` and `second = [c, d]`.
///
/// `L_0` has the eigenvalues of `x^2 - a x - b`, `L_1` those of `x^2 - c x - d`.
///
/// # Errors
/// Those of [`ProjectedCurve::new`].
pub fn standard_curve(first: [Near; 2], second: [Near; 2]) -> Result<ProjectedCurve<2, 3>, Error> {
    let ([a, b], [c, d]) = (first, second);
    let rest = |a: Near, b: Near| {
        let rest = Wide::ONE - Wide::from(a) - Wide::from(b);
        rest.checked_to_num::<Near>().ok_or(Error::OutOfRange {
            what: "first weight",
            index: None,
            value: rest,
            min: Wide::lit("-8"),
            max: Wide::lit("8"),
        })
    };
    let (u, v) = ([rest(a, b)?, a, b], [d, c, rest(c, d)?]);
    ProjectedCurve::from_grid(&[unit(0), u, unit(1), v, unit(2)])
}

/// A curve of figure 2: its letter, and `a, b` of its first and its second map ([`standard_curve`]).
///
/// The text prints no numbers: these are curves of the six types that it describes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Type {
    /// Its letter in the figure.
    pub letter: char,
    /// What it is.
    pub title: &'static str,
    /// `a` and `b` of `T_0`.
    #[cfg_attr(feature = "defmt", defmt(Debug2Format))]
    pub first: [Near; 2],
    /// `c` and `d` of `T_1`.
    #[cfg_attr(feature = "defmt", defmt(Debug2Format))]
    pub second: [Near; 2],
}

const fn pair(a: &str, b: &str) -> [Near; 2] {
    [Near::lit(a), Near::lit(b)]
}

impl Type {
    /// The six types, (a) to (f).
    pub const ALL: [Self; 6] = [
        Self {
            letter: 'a',
            title: "parabola",
            first: pair("0.75", "-0.125"),
            second: pair("0.75", "-0.125"),
        },
        Self { letter: 'b', title: "angle", first: pair("0.9", "-0.18"), second: pair("0.9", "-0.18") },
        Self { letter: 'c', title: "cusp (Takagi)", first: pair("1", "-0.25"), second: pair("1", "-0.25") },
        Self { letter: 'd', title: "alternating", first: pair("-0.2", "0.24"), second: pair("0.9", "-0.18") },
        Self {
            letter: 'e',
            title: "spiral at one end",
            first: pair("0.9", "-0.18"),
            second: pair("0.5", "-0.4"),
        },
        Self { letter: 'f', title: "spirals", first: pair("0.5", "-0.35"), second: pair("0.5", "-0.35") },
    ];

    /// The curve.
    ///
    /// # Errors
    /// None for those of [`Type::ALL`].
    pub fn curve(&self) -> Result<ProjectedCurve<2, 3>, Error> {
        standard_curve(self.first, self.second)
    }
}
