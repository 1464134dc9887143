//! Matrices with barycentric columns: each column adds up to 1, and so does the image of any weights that do.
//!
//! `(T lambda)_i = sum_j T_ij lambda_j` for points `lambda` of the barycentric space
//! `B_J = {lambda : sum lambda_j = 1}`, and `(P T)_k = sum_j p_j T_jk` for control points `P`.
//!
//! Source: E. Tosan, E. Guerin, A. Baskurt, "Design and Reconstruction of Fractal Surfaces", 2002, section 2.3.
//! Formats: entries and weights have 28 fractional bits; a row is a sum of 64 bits, rounded once.

use crate::Error;
use crate::num::formats::{Q24, Q28};
use crate::num::{Near, Wide, product};

/// 1 with 28 fractional bits.
pub(super) const ONE: Q28 = 1 << 28;

/// The weights of the corner `index`: 1 there, 0 elsewhere.
pub(super) const fn unit<const J: usize>(index: usize) -> [Near; J] {
    let mut weights = [Near::ZERO; J];
    if index < J {
        weights[index] = Near::ONE;
    }
    weights
}

/// `sum_j a_j b_j` and half a unit.
///
/// Domain: the sum of `|a_j b_j|` below `2^63`, which [`super::Contraction`] proves of all that is multiplied.
#[inline(always)]
fn sum<const J: usize>(a: &[i32; J], b: &[i32; J]) -> i64 {
    let mut sum = 1 << 27;
    for (a, b) in a.iter().zip(b) {
        sum = product(*a, *b).wrapping_add(sum);
    }
    sum
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
        }
        Ok(Self { rows: transposed(&exact) })
    }

    /// The image of a corner.
    ///
    /// Result: none for an `index` of `J` or more.
    pub fn column(&self, index: usize) -> Option<[Near; J]> {
        (index < J).then(|| self.rows.map(|row| Near::from_bits(row.get(index).copied().unwrap_or(0))))
    }

    pub(super) const fn rows(&self) -> &[[Q28; J]; J] {
        &self.rows
    }

    /// `T lambda`.
    #[inline(always)]
    pub(super) fn image(&self, weights: &[Q28; J]) -> [Q28; J] {
        // |T_ij| < 8 and sum |lambda_j| < 15: each sum is below 2^63
        self.rows.each_ref().map(|row| (sum(row, weights) >> 28) as i32)
    }

    /// `P T`: the control points of the part that is the image of this map.
    #[inline(always)]
    pub(super) fn part(&self, points: &[Q24; J]) -> [Q24; J] {
        let mut sums = [1 << 27; J];
        for (row, point) in self.rows.iter().zip(points) {
            for (sum, entry) in sums.iter_mut().zip(row) {
                *sum = product(*entry, *point).wrapping_add(*sum);
            }
        }
        sums.map(|sum| (sum >> 28) as i32)
    }
}

/// `P lambda`: what control points make of weights.
#[inline(always)]
pub(super) fn mixed<const J: usize>(points: &[Q24; J], weights: &[Q28; J]) -> Q24 {
    (sum(points, weights) >> 28).clamp(i32::MIN.into(), i32::MAX.into()) as i32
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

    /// Each row is the exact sum, rounded once to nearest; so is each control point of a part.
    #[test]
    fn a_row_is_rounded_once() {
        let (mut word, mut tried) = (7_u64, 0);
        let mut number = |bits: u32| {
            word = word.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (word >> 32) as i32 >> (32 - bits)
        };
        for _ in 0..500 {
            let mut columns = [[Near::ZERO; 4]; 4];
            for column in &mut columns {
                let [a, b, c] = [number(31), number(29), number(30)].map(|n| n / 4);
                *column = [a, b, c, ONE - a - b - c].map(Near::from_bits);
            }
            let matrix = Barycentric::from_columns(columns).unwrap();
            let weights = [number(30), number(29), number(28), number(30)];
            for (row, got) in matrix.rows().iter().zip(matrix.image(&weights)) {
                let exact: i128 = row.iter().zip(weights).map(|(a, b)| i128::from(*a) * i128::from(b)).sum();
                assert_eq!(i128::from(got), (exact + (1 << 27)) >> 28);
                tried += 1;
            }
            for (column, got) in columns.iter().zip(matrix.part(&weights)) {
                let exact: i128 =
                    column.iter().zip(weights).map(|(a, b)| i128::from(a.to_bits()) * i128::from(b)).sum();
                assert_eq!(i128::from(got), (exact + (1 << 27)) >> 28);
            }
        }
        assert_eq!(tried, 2000);
        assert_eq!(mixed(&[i32::MAX; 2], &[ONE; 2]), i32::MAX);
        assert_eq!(mixed(&[i32::MIN; 2], &[ONE; 2]), i32::MIN);
    }
}
