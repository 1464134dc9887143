//! Tensor products of two curves: `phi(s, t) = phi_u(s) (x) phi_v(t)`, `T_ij = T_i (x) T_j`.
//!
//! Source: Tosan, Guerin, Baskurt, section 4, first paragraph. Formats: as [`super::curve`]; a height is
//! rounded once along `t` for each row of control points, and once along `s`.

use super::address::Address;
use super::barycentric::mixed;
use super::contraction::Contraction;
use super::curve::ProjectedCurve;
use super::scheme::Scheme;
use crate::Error;
use crate::num::formats::{Q24, Q28};
use crate::num::{Near, Real};

/// The product of a curve of `M` and one of `L` control points in base `N`: a surface by `J = M L` of them,
/// that of `(a, b)` at `a L + b`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tensor<const N: usize, const M: usize, const L: usize, const J: usize> {
    u: ProjectedCurve<N, M>,
    v: ProjectedCurve<N, L>,
    contraction: Contraction,
}

impl<const N: usize, const M: usize, const L: usize, const J: usize> Tensor<N, M, L, J> {
    /// `u` along `s` and `v` along `t`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the products of weights are not proven to stay below 15 in sum.
    pub fn new(u: ProjectedCurve<N, M>, v: ProjectedCurve<N, L>) -> Result<Self, Error> {
        const { assert!(J == M * L, "a product has as many control points as both curves together") };
        let contraction = u.contraction().times(v.contraction())?;
        Ok(Self { u, v, contraction })
    }

    /// The curves along `s` and along `t`.
    pub const fn factors(&self) -> (&ProjectedCurve<N, M>, &ProjectedCurve<N, L>) {
        (&self.u, &self.v)
    }

    /// The height at `s` and `t`, saturated. Error: below 2 units of `2^-28` a digit times the sum of the
    /// heights' magnitudes, and 2 units of `2^-24` (`a_product_is_within_two_units_a_digit`).
    ///
    /// Cost: `(M - 1)^2 + (L - 1)^2` products a digit, and `M L + M` (the kernel rows `patch tensor 3 x 3`
    /// and `patch tensor 4 x 4` count points of 12 digits).
    pub fn height(&self, heights: &[Real; J], [s, t]: [Address<N>; 2]) -> Real {
        let (along_s, along_t) = (self.u.weights_bits(s), self.v.weights_bits(t));
        Real::from_bits(self.mixed(&heights.map(Real::to_bits), &along_s, &along_t))
    }

    /// The proof that it is a surface.
    pub const fn contraction(&self) -> &Contraction {
        &self.contraction
    }

    #[inline(always)]
    fn mixed(&self, heights: &[Q24; J], along_s: &[Q28; M], along_t: &[Q28; L]) -> Q24 {
        let mut rows = [0; M];
        for (row, heights) in rows.iter_mut().zip(heights.chunks_exact(L)) {
            if let Ok(heights) = <&[Q24; L]>::try_from(heights) {
                *row = mixed(heights, along_t);
            }
        }
        mixed(&rows, along_s)
    }
}

impl<const N: usize, const M: usize, const L: usize, const J: usize> Scheme<J> for Tensor<N, M, L, J> {
    const BASE: u32 = N as u32;
    const SIDES: [usize; 2] = [M, L];
    const STEPS: [usize; 2] = [M.saturating_sub(1), L.saturating_sub(1)];

    fn contraction(&self) -> &Contraction {
        &self.contraction
    }

    fn part(&self, heights: &[Q24; J], [i, j]: [u32; 2]) -> [Q24; J] {
        let mut result = *heights;
        let (Some(u), Some(v)) = (self.u.maps().get(i as usize), self.v.maps().get(j as usize)) else {
            return result;
        };
        for row in result.chunks_exact_mut(L) {
            if let Ok(row) = <&mut [Q24; L]>::try_from(row) {
                *row = v.part(row);
            }
        }
        for b in 0..L {
            let mut column = [0; M];
            for (place, row) in column.iter_mut().zip(result.chunks_exact(L)) {
                *place = row.get(b).copied().unwrap_or(0);
            }
            let column = u.part(&column);
            for (value, row) in column.iter().zip(result.chunks_exact_mut(L)) {
                if let Some(place) = row.get_mut(b) {
                    *place = *value;
                }
            }
        }
        result
    }

    fn corner(&self, heights: &[Q24; J], [s, t]: [bool; 2]) -> Q24 {
        let ([u0, u1], [v0, v1]) = (self.u.end_weights(), self.v.end_weights());
        self.mixed(heights, if s { &u1 } else { &u0 }, if t { &v1 } else { &v0 })
    }

    fn at(&self, heights: &[Q24; J], at: [u32; 2], levels: u32) -> Q24 {
        let [s, t] = at.map(|index| Address::of(index, levels).ok());
        let (Some(s), Some(t)) = (s, t) else { return 0 };
        self.mixed(heights, &self.u.weights_bits(s), &self.v.weights_bits(t))
    }
}

/// The weights of a place: the products of those along `s` and along `t`, each rounded once.
impl<const N: usize, const M: usize, const L: usize, const J: usize> Tensor<N, M, L, J> {
    /// `phi` at `s` and `t`.
    pub fn weights(&self, [s, t]: [Address<N>; 2]) -> [Near; J] {
        let (along_s, along_t) = (self.u.weights_bits(s), self.v.weights_bits(t));
        let mut weights = [Near::ZERO; J];
        for (row, s) in weights.chunks_exact_mut(L).zip(along_s) {
            for (weight, t) in row.iter_mut().zip(along_t) {
                // both sums of magnitudes are below 15, and that of the products is proven to be
                *weight = Near::from_bits(((i64::from(s) * i64::from(t) + (1 << 27)) >> 28) as i32);
            }
        }
        weights
    }
}
