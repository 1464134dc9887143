//! Matrices with barycentric columns: each column adds up to 1, and so does the image of any weights that do.
//!
//! `(T lambda)_i = sum_j T_ij lambda_j` for points `lambda` of the barycentric space
//! `B_J = {lambda : sum lambda_j = 1}`, and `(P T)_k = sum_j p_j T_jk` for control points `P`.
//!
//! Source: E. Tosan, E. Guerin, A. Baskurt, "Design and Reconstruction of Fractal Surfaces", 2002, section
//! 2.3. Formats: entries and weights have 28 fractional bits; a row is a sum of 64 bits. Weights that add up
//! to 1 have an image that does: the sums of its last 1, 2, 3 ... rows are rounded to nearest, and weights
//! are what these differ by. So each weight is less than a unit off, what is off adds up to 0 and is `J - 1`
//! units in sum at most, and the maps of the digits before contract it: a weight at `sigma_1 ... sigma_n` is
//! off by at most `(J - 1) / 2` units times `sum_(k < n) |T_sigma_1 ... T_sigma_k|`, which stays bounded
//! however many digits there are. A level stays level, and what is 0 in both stays 0: a side of a patch knows
//! its own control points only.

use crate::Error;
use crate::num::formats::{Q24, Q28};
use crate::num::{Near, Real, Wide, product};

/// 1 with 28 fractional bits.
pub(super) const ONE: Q28 = 1 << 28;

/// Half a unit of a weight, and what is below a unit, in a sum of products.
pub(super) const HALF: i64 = 1 << 27;
pub(super) const FRACTION: i64 = (1 << 28) - 1;

/// The weights of the corner `index`: 1 there, 0 elsewhere.
pub(super) const fn unit<const J: usize>(index: usize) -> [Near; J] {
    let mut weights = [Near::ZERO; J];
    if index < J {
        weights[index] = Near::ONE;
    }
    weights
}

/// A matrix of `J` columns that each add up to 1: a map of the barycentric space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Barycentric<const J: usize> {
    rows: [[Q28; J]; J],
}

impl<const J: usize> Barycentric<J> {
    /// Leaves every point where it is.
    pub const IDENTITY: Self = {
        let mut rows = [[0; J]; J];
        let mut index = 0;
        while index < J {
            rows[index][index] = ONE;
            index += 1;
        }
        Self { rows }
    };

    /// The matrix with these columns, the images of the corners. Where rounding left a sum off by up to `J`
    /// units, the entry of greatest magnitude takes it up.
    ///
    /// # Errors
    /// [`Error::NotBarycentric`] for a column with another sum.
    pub fn from_columns(columns: [[Near; J]; J]) -> Result<Self, Error> {
        let mut exact = columns.map(|column| column.map(Near::to_bits));
        for (index, column) in exact.iter_mut().enumerate() {
            add_up(column, index)?;
        }
        Ok(Self { rows: transposed(&exact) })
    }

    /// The image of a corner.
    ///
    /// Result: none for an `index` of `J` or more.
    pub fn column(&self, index: usize) -> Option<[Near; J]> {
        (index < J).then(|| self.rows.map(|row| Near::from_bits(row.get(index).copied().unwrap_or(0))))
    }

    /// A change of coordinates: the control points `P = Q R` of the surface with the control points `Q`,
    /// whose maps are `R T_ij R^-1`, for the maps `T_ij`; saturated. `R e_kl = r_kl` are the corners of the
    /// other system.
    ///
    /// `F = P phi = Q (R phi)`: a patch whose corners are not control points is a patch whose corners are
    /// (Tosan, Guerin, Baskurt, section 4.2), and no matrix has to be inverted.
    ///
    /// Error: half a unit of `2^-24` (`other_coordinates_have_the_same_surface`).
    pub fn control_points(&self, points: &[Real; J]) -> [Real; J] {
        transposed(&self.rows).map(|column| {
            // entries are below 8, but not their sum
            let products = column.iter().zip(points).map(|(a, b)| i128::from(product(*a, b.to_bits())));
            let sum = (products.sum::<i128>() + i128::from(HALF)) >> 28;
            Real::from_bits(sum.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
        })
    }

    pub(super) const fn rows(&self) -> &[[Q28; J]; J] {
        &self.rows
    }

    /// `T lambda`, for weights that add up to 1; those of the image do, to the last bit.
    #[inline(always)]
    pub(super) fn image(&self, weights: &[Q28; J]) -> [Q28; J] {
        let mut image = [0; J];
        let mut left = HALF;
        for (to, row) in image.iter_mut().zip(&self.rows).skip(1).rev() {
            // |T_ij| < 8 and sum |lambda_j| < 15: each sum is below 2^63
            let mut sum = left;
            for (entry, weight) in row.iter().zip(weights) {
                sum = product(*entry, *weight).wrapping_add(sum);
            }
            *to = (sum >> 28) as i32;
            left = sum & FRACTION;
        }
        completed(image)
    }

    /// `P T`: the control points of the part that is the image of this map.
    #[inline(always)]
    pub(super) fn part(&self, points: &[Q24; J]) -> [Q24; J] {
        let mut part = [0; J];
        for (k, to) in part.iter_mut().enumerate() {
            // a sum at a time: as many as there are points do not fit the registers
            let mut sum = HALF;
            for (row, point) in self.rows.iter().zip(points) {
                sum = product(row.get(k).copied().unwrap_or(0), *point).wrapping_add(sum);
            }
            *to = (sum >> 28) as i32;
        }
        part
    }
}

/// Makes a column that rounding left off by up to `J` units add up to 1: its entry of greatest magnitude
/// takes it up.
///
/// # Errors
/// [`Error::NotBarycentric`] for a column with another sum.
pub(super) fn add_up<const J: usize>(column: &mut [Q28; J], index: usize) -> Result<(), Error> {
    let sum: i64 = column.iter().copied().map(i64::from).sum();
    let off = i64::from(ONE).saturating_sub(sum);
    if off.unsigned_abs() > J as u64 {
        return Err(Error::NotBarycentric { column: index, sum: wide(sum) });
    }
    // the first of the greatest, so that equal columns stay equal
    let most = column.iter().map(|entry| entry.unsigned_abs()).max().unwrap_or(0);
    if let Some(entry) = column.iter_mut().find(|entry| entry.unsigned_abs() == most) {
        *entry = entry.saturating_add(off as i32);
    }
    Ok(())
}

/// Weights whose first is what the others leave of 1.
#[inline(always)]
pub(super) fn completed<const J: usize>(mut weights: [Q28; J]) -> [Q28; J] {
    if let Some((first, rest)) = weights.split_first_mut() {
        *first = rest.iter().fold(ONE, |left, weight| left.wrapping_sub(*weight));
    }
    weights
}

/// `P lambda`: what control points make of weights, rounded once and saturated.
///
/// Domain: the sum of the weights' magnitudes below 15, which [`super::Contraction`] proves: a sum below
/// `2^63`.
#[inline(always)]
pub(super) fn mixed<const J: usize>(points: &[Q24; J], weights: &[Q28; J]) -> Q24 {
    let mut sum = HALF;
    for (point, weight) in points.iter().zip(weights) {
        sum = product(*point, *weight).wrapping_add(sum);
    }
    (sum >> 28).clamp(i32::MIN.into(), i32::MAX.into()) as i32
}

/// A number that does not fit the format of weights.
pub(super) fn out_of_range(what: &'static str, value: i64) -> Error {
    Error::OutOfRange { what, index: None, value: wide(value), min: Wide::lit("-8"), max: Wide::lit("8") }
}

/// A number with 28 fractional bits, saturated.
pub(super) fn wide(bits: i64) -> Wide {
    Wide::from_bits(bits.saturating_mul(1 << 20))
}

fn transposed<const J: usize>(of: &[[Q28; J]; J]) -> [[Q28; J]; J] {
    let mut turned = [[0; J]; J];
    for (i, row) in turned.iter_mut().enumerate() {
        for (entry, column) in row.iter_mut().zip(of) {
            *entry = column.get(i).copied().unwrap_or(0);
        }
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::super::seeded::{seeded, words};
    use super::*;

    fn near(v: f64) -> Near {
        Near::from_num(v)
    }

    #[test]
    fn a_column_that_rounding_left_off_by_a_unit_adds_up_to_one() {
        let third = Near::from_num(1) / 3;
        let matrix = Barycentric::from_columns([[third; 3], unit(1), unit(2)]).unwrap();
        let column = matrix.column(0).unwrap();
        assert_eq!(column.iter().copied().sum::<Near>(), Near::ONE);
        assert_eq!(column, [third + Near::DELTA, third, third]);
        assert_eq!((matrix.column(2), matrix.column(3)), (Some(unit(2)), None));
        let error = Barycentric::from_columns([[near(0.5), near(0.25)], unit(1)]).unwrap_err();
        assert_eq!(error, Error::NotBarycentric { column: 0, sum: Wide::lit("0.75") });
        let off = third - Near::DELTA * 3;
        assert!(Barycentric::from_columns([unit(0), [off, off, off], unit(2)]).is_err());
    }

    /// The exact sums of the last rows of an image, 56 fractional bits.
    fn exact_sums<const J: usize>(matrix: &Barycentric<J>, weights: &[Q28; J]) -> [i128; J] {
        let mut sums = [0_i128; J];
        let mut sum = 0;
        for (to, row) in sums.iter_mut().zip(matrix.rows()).rev() {
            sum += row.iter().zip(weights).map(|(a, b)| i128::from(*a) * i128::from(*b)).sum::<i128>();
            *to = sum;
        }
        sums
    }

    /// The sums of the last rows of an image are the exact ones, rounded to nearest; so is each control point
    /// of a part.
    #[test]
    fn sums_of_rows_are_rounded_once() {
        let (mut word, mut tried, mut most) = (words(7), 0, 0);
        for _ in 0..500 {
            let matrix = seeded::<4>(&mut word);
            let weights = completed([(); 4].map(|()| word(28)));
            let (mut sum, mut before) = (0_i128, 0_i128);
            for (exact, got) in exact_sums(&matrix, &weights).iter().zip(matrix.image(&weights)).rev() {
                sum += i128::from(got);
                assert_eq!(sum, (exact + (1 << 27)) >> 28);
                most = most.max(((i128::from(got) << 28) - (exact - before)).abs());
                before = *exact;
                tried += 1;
            }
            assert_eq!(sum, i128::from(ONE));
            for (k, got) in matrix.part(&weights).into_iter().enumerate() {
                let column = matrix.rows().map(|row| row[k]);
                let exact: i128 =
                    column.iter().zip(weights).map(|(a, b)| i128::from(*a) * i128::from(b)).sum();
                assert_eq!(i128::from(got), (exact + (1 << 27)) >> 28);
            }
        }
        // less than a unit off, and often more than half of one
        assert!(tried == 2000 && most < 1 << 28 && most > 9 << 24, "{tried} {most}");
        assert_eq!(mixed(&[i32::MAX; 2], &[ONE; 2]), i32::MAX);
        assert_eq!(mixed(&[i32::MIN; 2], &[ONE; 2]), i32::MIN);
    }
}
