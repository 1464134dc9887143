//! A map of weights by all of them but the first, which is what is left of 1.
//!
//! `lambda_0 = 1 - sum_(j>0) lambda_j`, so that `(T lambda)_i = T_i0 + sum_(j>0) (T_ij - T_i0) lambda_j`: of
//! `J^2` products `(J - 1)^2` are left. The same bits as [`Barycentric::image`]
//! (`both_ways_give_the_same_weights`).
//!
//! Formats: differences have 28 fractional bits, what a row begins with 56.

use super::barycentric::{Barycentric, FRACTION, HALF, out_of_range};
use crate::Error;
use crate::num::formats::Q28;
use crate::num::product;

/// A map of the barycentric space in affine coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Affine<const J: usize> {
    /// `T_i0`; that of the last row, which is the first to be rounded, and half a unit.
    starts: [i64; J],
    /// `T_ij - T_i0`; none of the first row and of the first column are used.
    slopes: [[Q28; J]; J],
}

impl<const J: usize> Affine<J> {
    /// Leads to the first corner.
    pub(super) const NONE: Self = Self { starts: [0; J], slopes: [[0; J]; J] };

    /// # Errors
    /// [`Error::OutOfRange`] where two entries of a row differ by 8 or more.
    pub(super) fn of(map: &Barycentric<J>) -> Result<Self, Error> {
        let mut affine = Self::NONE;
        let rows = affine.starts.iter_mut().zip(&mut affine.slopes).zip(map.rows());
        for ((start, slopes), row) in rows.skip(1) {
            let first = row.first().copied().unwrap_or(0);
            *start = i64::from(first) << 28;
            for (slope, entry) in slopes.iter_mut().zip(row) {
                let apart = i64::from(*entry).wrapping_sub(i64::from(first));
                *slope = i32::try_from(apart)
                    .map_err(|_| out_of_range("difference of two columns of a map", apart))?;
            }
        }
        if let Some(start) = affine.starts.last_mut() {
            *start = start.wrapping_add(HALF);
        }
        Ok(affine)
    }

    /// All weights but the first of the image.
    #[inline(always)]
    pub(super) fn image(&self, weights: &[Q28; J]) -> [Q28; J] {
        let mut image = [0; J];
        let mut left = 0;
        for ((to, start), slopes) in image.iter_mut().zip(&self.starts).zip(&self.slopes).skip(1).rev() {
            // the sum is below 2^59, whatever the summands are on the way
            let mut sum = *start | left;
            for (slope, weight) in slopes.iter().zip(weights).skip(1) {
                sum = product(*slope, *weight).wrapping_add(sum);
            }
            *to = (sum >> 28) as i32;
            left = sum & FRACTION;
        }
        image
    }
}

#[cfg(test)]
mod tests {
    use super::super::barycentric::ONE;
    use super::super::barycentric::completed;
    use super::super::seeded::{seeded, words};
    use super::*;
    use crate::num::Near;

    fn compare<const J: usize>(word: &mut impl FnMut(u32) -> i32) {
        let matrix = seeded::<J>(word);
        let affine = Affine::of(&matrix).unwrap();
        let mut weights = completed([(); J].map(|()| word(29)));
        let mut alone = weights;
        for _ in 0..8 {
            weights = matrix.image(&weights).map(|weight| weight >> 2);
            weights = completed(weights);
            alone = affine.image(&alone).map(|weight| weight >> 2);
            assert_eq!(completed(alone), weights);
        }
    }

    #[test]
    fn both_ways_give_the_same_weights() {
        let mut word = words(3);
        for _ in 0..300 {
            compare::<2>(&mut word);
            compare::<3>(&mut word);
            compare::<4>(&mut word);
            compare::<7>(&mut word);
        }
        let near = Near::from_bits;
        let far = [[near(i32::MAX), near(ONE - i32::MAX)], [near(ONE - i32::MAX), near(i32::MAX)]];
        let matrix = Barycentric::from_columns(far).unwrap();
        assert!(matches!(Affine::of(&matrix), Err(Error::OutOfRange { .. })));
    }
}
