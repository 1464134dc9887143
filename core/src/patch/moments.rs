//! Integrals, means and variances over the cells of a lattice, exact at every level: the calculus of a
//! fractal function of two variables.
//!
//! Over a cell of size 1, with its heights `p` and the refinable function `phi` ([`super::lattice`]):
//! - the mean height is `p . w`, `w = 1/4 sum T_ij w`: times its area the integral over any part;
//! - the mean along the side `i` of `s` is `p . e_i`, `e_i = 1/2 sum_j T_ij e_i`. The mean slope along `s` is
//!   what is gained from side to side, `p . (e_1 - e_0)`, and so along `t`, whatever the mask;
//! - the variance of the height, that along a side and, if slopes are square integrable, their covariance are
//!   quadratic forms of `p` ([`super::form`]);
//! - the covariance of height and slope needs no form of its own: by the fundamental theorem for `h h_s`,
//!   `E(h h_s) = (E_1(h^2) - E_0(h^2)) / 2` with the means along both sides.
//!
//! Slopes over a part are twice the slopes of what it is as a cell: of the variance of slopes each level
//! keeps `1/4 * 4 = 1` times what the maps make of it. It exists if `X -> sum T_ij X T_ij^T` on forms that
//! leave planes out has a spectral radius below 1, and the mask leaves planes planes: `sum k m(k)` is the
//! same over each of its four classes, as of any mask that is the same forwards and backwards. Where the
//! translates of `phi` are independent both are necessary (Jia); here both are asked for, and checked. A mask
//! fitted to data bends planes as a rule: the mean square of its slopes grows from level to level without
//! end.
//!
//! Source: the moments of fractal interpolation functions of Cochran, Lewis, Hart, section 6.1, by the
//! two-scale relation instead of their maps; R. Q. Jia, "Smoothness of multiple refinable functions in
//! Sobolev spaces", 1999, for when slopes are square integrable.

use super::columns::{CELL, Column, SIDES, image, mean, rounded};
use super::form::{Form, Free, Law, combined, dyad};
use super::lattice::Mask;
use crate::Error;
use crate::num::formats::{Q24, Q28, Q44};
use crate::num::{Near, Real, product};

/// The weights of a mean: 28 fractional bits.
type Weights = [Q28; 16];

/// How much the sums of a mask's classes along an axis may differ: what rounding its entries leaves.
const PLANE: i64 = 32;

/// A lattice over one of its parts: means, variances and covariances, each saturated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CellMoments {
    /// Mean height.
    pub height: Real,
    /// Mean slopes along `s` and `t`.
    pub slope: [Real; 2],
    /// Variance of the height.
    pub variance: Real,
    /// Covariance of the height with both slopes.
    pub covariance: [Real; 2],
}

/// The slopes of a lattice over one of its parts, each number saturated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CellSlopes {
    /// Means along `s` and `t`.
    pub mean: [Real; 2],
    /// `[var p, cov(p, q), var q]`.
    pub covariance: [Real; 3],
}

/// What a mask says of heights over a cell: their mean, mean slopes, variance, and their covariance with the
/// slopes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct HeightMoments {
    mean: Weights,
    slopes: [Weights; 2],
    variance: Form,
    covariance: [Form; 2],
}

/// What a mask says of the slopes over a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SlopeMoments {
    slopes: [Weights; 2],
    /// `[pp, pq, qq]`.
    covariance: [Form; 3],
}

const BEYOND: Error = Error::NoMoments { why: "they leave their formats, or are approached too slowly" };
const BENT: Error = Error::NoMoments { why: "it bends planes, and slopes grow from level to level" };
const ROUGH: Error = Error::NoMoments { why: "64 levels do not halve what slopes vary by" };

/// With 28 fractional bits, `sum` of them: the greatest takes up what rounding left.
fn weights(column: &Column, sum: Q28) -> Weights {
    let mut weights = column.map(|weight| rounded(weight) as i32);
    let left = weights.iter().fold(sum, |left, weight| left.wrapping_sub(*weight));
    if let Some(most) = weights.iter_mut().max_by_key(|weight| weight.unsigned_abs()) {
        *most = most.wrapping_add(left);
    }
    weights
}

/// The mean over each side.
fn sides(mask: &[[Q28; 5]; 5]) -> Option<[Column; 4]> {
    let [s0, s1, t0, t1] = SIDES.each_ref().map(|side| mean(mask, side));
    Some([s0?, s1?, t0?, t1?])
}

fn difference(a: &Column, b: &Column) -> Column {
    let mut to = *a;
    to.iter_mut().zip(b).for_each(|(to, b)| *to = to.wrapping_sub(*b));
    to
}

fn entries(mask: &Mask) -> [[Q28; 5]; 5] {
    mask.entries().map(|row| row.map(Near::to_bits))
}

/// `p . w`, 52 fractional bits.
fn dot(heights: &[Real; 16], weights: &Weights) -> i64 {
    heights.iter().zip(weights).fold(0, |sum, (p, w)| product(p.to_bits(), *w).wrapping_add(sum))
}

/// With 24 fractional bits, nearest, saturated; from so many.
fn real(value: i128, fraction: u32) -> Real {
    let shift = fraction.saturating_sub(24).max(1);
    let value = ((value >> (shift - 1)) + 1) >> 1;
    Real::from_bits(value.clamp(i32::MIN.into(), i32::MAX.into()) as Q24)
}

/// The mean slopes over a part as one of so many along a side.
fn mean_slopes(slopes: &[Weights; 2], heights: &[Real; 16], parts: u32) -> [Real; 2] {
    slopes.each_ref().map(|weights| real(i128::from(dot(heights, weights)) * i128::from(parts), 52))
}

impl HeightMoments {
    /// Those of a mask; every mask has them.
    ///
    /// Cost: some dozens of rounds of 12,800 products, and as many again for the four sides; tens of KiB of
    /// stack.
    ///
    /// # Errors
    /// [`Error::NoMoments`] where numbers leave their formats, or where 64 levels do not halve what heights
    /// vary by.
    pub fn new(mask: &Mask) -> Result<Self, Error> {
        let mask = &entries(mask);
        Self::of(mask).ok_or(BEYOND)
    }

    fn of(mask: &[[Q28; 5]; 5]) -> Option<Self> {
        let cell = mean(mask, &CELL)?;
        let sides = sides(mask)?;
        let [s0, s1, t0, t1] = &sides;
        let slopes = [difference(s1, s0), difference(t1, t0)];
        // over some parts, about the mean over all of them
        let variance = |parts: &[[usize; 2]], mean: &Column| {
            let means = parts.iter().map(|part| [difference(&image(mask, *part, mean), mean); 2]);
            Law::new(mask, parts, Free::Level)?.variance(means)
        };
        // mean squares along the sides: variance and square of the mean
        let square = |side: usize| {
            let (parts, mean) = (SIDES.get(side)?, sides.get(side)?);
            Some(combined(&variance(parts, mean)?, &dyad(mean, mean), i64::wrapping_add))
        };
        let covariance = |[first, last]: [usize; 2], slope: &Column| {
            let half = |last: Q44, first: Q44| (last - first) >> 1;
            let product = combined(&square(last)?, &square(first)?, half);
            let central = combined(&product, &dyad(&cell, slope), i64::wrapping_sub);
            Form::new(Free::Level, &central)
        };
        Some(Self {
            mean: weights(&cell, 1 << 28),
            slopes: slopes.each_ref().map(|slope| weights(slope, 0)),
            variance: Form::new(Free::Level, &variance(&CELL, &cell)?)?,
            covariance: [covariance([0, 1], &slopes[0])?, covariance([2, 3], &slopes[1])?],
        })
    }

    /// The mean height over a cell with these heights, saturated: times its area the integral.
    ///
    /// Error: half a unit, and as much for each 32 that heights have in sum
    /// (`moments_of_a_fitted_mask_are_those_of_its_heights`).
    pub fn mean(&self, heights: &[Real; 16]) -> Real {
        real(dot(heights, &self.mean).into(), 52)
    }

    /// All over a cell with these heights, one of `parts` along the unit square.
    ///
    /// Error: of numbers below 8, 4 units, of slopes `parts` times as many
    /// (`moments_of_lattices_are_those_of_the_reference`). Cost: 48 products and three forms of 135.
    pub fn over(&self, heights: &[Real; 16], parts: u32) -> CellMoments {
        let [p, q] = self.covariance.each_ref().map(|form| real(form.of(heights) * i128::from(parts), 48));
        CellMoments {
            height: self.mean(heights),
            slope: mean_slopes(&self.slopes, heights, parts),
            variance: real(self.variance.of(heights), 48).max(Real::ZERO),
            covariance: [p, q],
        }
    }
}

impl SlopeMoments {
    /// Those of a mask whose slopes are square integrable.
    ///
    /// Cost: some dozens of rounds of 12,800 products, three times as many for a rough one; tens of KiB of
    /// stack.
    ///
    /// # Errors
    /// [`Error::NoMoments`] for a mask that bends planes, or where 64 levels do not halve what its slopes
    /// vary by.
    pub fn new(mask: &Mask) -> Result<Self, Error> {
        let mask = &entries(mask);
        if !leaves_planes(mask) {
            return Err(BENT);
        }
        let law = Law::new(mask, &CELL, Free::Plane).ok_or(ROUGH)?;
        let [s0, s1, t0, t1] = sides(mask).ok_or(BEYOND)?;
        let slopes = [difference(&s1, &s0), difference(&t1, &t0)];
        // twice the slopes of a part, about the mean
        let about = |slope: &Column, part: [usize; 2]| {
            let part = image(mask, part, slope).map(|weight| weight.wrapping_mul(2));
            difference(&part, slope)
        };
        let form = |p: usize, q: usize| {
            let (p, q) = (slopes.get(p)?, slopes.get(q)?);
            let square = law.variance(CELL.iter().map(|part| [about(p, *part), about(q, *part)]))?;
            Form::new(Free::Plane, &square)
        };
        let (Some(pp), Some(pq), Some(qq)) = (form(0, 0), form(0, 1), form(1, 1)) else { return Err(BEYOND) };
        Ok(Self { slopes: slopes.each_ref().map(|slope| weights(slope, 0)), covariance: [pp, pq, qq] })
    }

    /// Over a cell with these heights, one of `parts` along the unit square.
    ///
    /// Error: of heights that differ by 2 over `parts`, 6 units of `2^-24` for each of `parts`
    /// (`moments_of_the_b_spline_are_its_closed_ones`). Cost: 32 products and three forms of 104.
    pub fn over(&self, heights: &[Real; 16], parts: u32) -> CellSlopes {
        let square = i128::from(u64::from(parts) * u64::from(parts));
        // forms stay below 2^66, and a side has 2^20 parts at most
        let of = |form: &Form| real(form.of(heights).saturating_mul(square), 48);
        let [pp, pq, qq] = self.covariance.each_ref().map(of);
        let covariance = [pp.max(Real::ZERO), pq, qq.max(Real::ZERO)];
        CellSlopes { mean: mean_slopes(&self.slopes, heights, parts), covariance }
    }
}

/// Whether the sums of `k m(k)` over all classes are the same, but for what rounding leaves.
fn leaves_planes(mask: &[[Q28; 5]; 5]) -> bool {
    let sum = |class: usize, axis: usize| {
        let mut sum = 0_i64;
        for (i, row) in mask.iter().enumerate() {
            for (j, entry) in
                row.iter().enumerate().filter(|(j, _)| (i & 1, j & 1) == (class >> 1, class & 1))
            {
                let along = if axis == 0 { i } else { j };
                sum += (along as i64 - 2) * i64::from(*entry);
            }
        }
        sum
    };
    (0..2).all(|axis| (1..4).all(|class| sum(class, axis).abs_diff(sum(0, axis)) <= PLANE.unsigned_abs()))
}
