//! Patches: surfaces by maps `T_ij` that join along their sides, any `N` and any number of control points.
//!
//! `phi(s, t) = lim T_(s1,t1) ... T_(sn,tn) lambda` over a grid of `M x M` control points, `M = m + 1`. The
//! patch is given by a grid of `(m N + 1)^2` points of the barycentric space, the columns of its maps:
//! `T_ij e_kl = r_(m i + k, m j + l)`. Neighbouring maps have columns in common, so that any grid joins
//! inside; on its boundary it has to be the embedding of one curve along `s` on both sides, and of one along
//! `t`:
//!
//! `r_(k, 0) = q u_k`, `r_(k, mN) = q' u_k`, `r_(0, k) = q v_k`, `r_(mN, k) = q' v_k`.
//!
//! Then both sides of every joint are the image of the same curve, and `phi` is continuous. Corners are
//! fixed: `r_(0,0) = e_00` and so on; a change of coordinates `R e_kl = r_kl` leads there from any other
//! choice.
//!
//! Source: Tosan, Guerin, Baskurt, sections 4.1, 4.2 and 5. Formats: 28 fractional bits, a row rounded once.

use super::address::{Address, Pair, split};
use super::barycentric::{Barycentric, mixed, unit};
use super::contraction::{Contraction, mean};
use super::curve::{ProjectedCurve, enough};
use super::joining::agree;
use super::scheme::{CORNERS, Scheme};
use super::standard_step::{is_standard, standard_weights};
use crate::Error;
use crate::num::formats::{Q24, Q28};
use crate::num::{Near, Real};

/// A patch in base `N` with `J = M M` control points, that of `(a, b)` at `a M + b`; `a` goes along `s`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Patch<const N: usize, const M: usize, const J: usize> {
    maps: [[Barycentric<J>; N]; N],
    /// Whether its grid is the standard one: its maps are then known for the most part.
    standard: bool,
    contraction: Contraction,
}

/// A side of the control grid: `q e_k`, at the beginning or the end of the other parameter.
#[derive(Clone, Copy)]
enum Side {
    /// `s` runs, `t` is fixed.
    AlongS { end: bool },
    /// `t` runs, `s` is fixed.
    AlongT { end: bool },
}

impl Side {
    const ALL: [Self; 4] = [
        Self::AlongS { end: false },
        Self::AlongS { end: true },
        Self::AlongT { end: false },
        Self::AlongT { end: true },
    ];

    /// Which of `side x side` places is the one after `k` along the side.
    fn place(self, k: usize, side: usize) -> usize {
        let last = side.wrapping_sub(1);
        let [row, column] = match self {
            Self::AlongS { end } => [k, if end { last } else { 0 }],
            Self::AlongT { end } => [if end { last } else { 0 }, k],
        };
        row.wrapping_mul(side).wrapping_add(column)
    }

    const fn condition(self) -> &'static str {
        match self {
            Self::AlongS { end: false } => "T_i0 q e_k = q T_i e_k (the side t = 0)",
            Self::AlongS { end: true } => "T_i,N-1 q' e_k = q' T_i e_k (the side t = 1)",
            Self::AlongT { end: false } => "T_0j q e_l = q T_j e_l (the side s = 0)",
            Self::AlongT { end: true } => "T_N-1,j q' e_l = q' T_j e_l (the side s = 1)",
        }
    }
}

impl<const N: usize, const M: usize, const J: usize> Patch<N, M, J> {
    /// How many points the grid has along a side.
    pub const SIDE: usize = M.saturating_sub(1) * N + 1;

    /// The patch of a grid of `SIDE x SIDE` points of the barycentric space, row after row along `s`.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than two maps or control points a side, [`Error::LengthMismatch`] for
    /// another number of points, [`Error::NotBarycentric`]; [`Error::Unjoined`] for a boundary that is not
    /// the embedding of a curve, by which side, at which point of it and by how much;
    /// [`Error::NotContractive`].
    pub fn from_grid(grid: &[[Near; J]]) -> Result<Self, Error> {
        const { assert!(J == M * M, "a patch has a square of control points") };
        enough::<N, M>()?;
        let expected = Self::SIDE * Self::SIDE;
        if grid.len() != expected {
            return Err(Error::LengthMismatch { what: "points of the grid", given: grid.len(), expected });
        }
        let [u, v] = [Side::ALL[0], Side::ALL[2]].map(|side| side.curve::<N, M, J>(grid));
        for (side, curve) in Side::ALL.into_iter().zip([&u, &u, &v, &v]) {
            side.check::<N, M, J>(grid, curve)?;
        }
        let mut maps = [[Barycentric::IDENTITY; N]; N];
        for (i, row) in maps.iter_mut().enumerate() {
            for (j, map) in row.iter_mut().enumerate() {
                let mut columns = [[Near::ZERO; J]; J];
                for (k, column) in columns.iter_mut().enumerate() {
                    let place = ((M - 1) * i + k / M) * Self::SIDE + (M - 1) * j + k % M;
                    *column = grid.get(place).copied().unwrap_or(unit(0));
                }
                *map = Barycentric::from_columns(columns)?;
            }
        }
        let corners = CORNERS.map(|corner| unit(Self::corner_index(corner)).map(Near::to_bits));
        let contraction = Contraction::prove(maps.as_flattened(), &mean(corners))?;
        let standard = is_standard(&maps);
        Ok(Self { maps, standard, contraction })
    }

    /// The boundary curves along `s` and along `t`, in the coordinates of a side of the control grid.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] as [`ProjectedCurve::new`] says.
    pub fn boundary(&self) -> Result<[ProjectedCurve<N, M>; 2], Error> {
        let mut sides = [[Barycentric::IDENTITY; N]; 2];
        for ((maps, side), along) in sides.iter_mut().zip([Side::ALL[0], Side::ALL[2]]).zip([true, false]) {
            for (i, map) in maps.iter_mut().enumerate() {
                let [row, column] = if along { [i, 0] } else { [0, i] };
                let of = self.maps.get(row).and_then(|row| row.get(column));
                let mut columns = [[Near::ZERO; M]; M];
                for (k, to) in columns.iter_mut().enumerate() {
                    let from = of.and_then(|map| map.column(side.place(k, M))).unwrap_or(unit(0));
                    *to = side.along::<M, J>(&from);
                }
                *map = Barycentric::from_columns(columns)?;
            }
        }
        let [u, v] = sides;
        Ok([ProjectedCurve::new(u)?, ProjectedCurve::new(v)?])
    }

    /// The proof that it is a surface.
    pub const fn contraction(&self) -> &Contraction {
        &self.contraction
    }

    /// The map of the digits `(i, j)`.
    ///
    /// Result: none for a digit of `N` or more.
    pub fn map(&self, i: usize, j: usize) -> Option<&Barycentric<J>> {
        self.maps.get(i)?.get(j)
    }

    /// `phi` at `s` and `t`. All addresses of a place give the same bits, and so do both patches that have a
    /// side in common. They add up to 1 exactly.
    ///
    /// Error: below 2 units of `2^-28` a digit (`a_patch_is_within_two_units_a_digit`).
    ///
    /// Cost: of the standard grid 28 products a digit (the kernel row `patch general` counts a point of 12
    /// digits), of other grids `J (J - 1)`.
    pub fn weights(&self, at: [Address<N>; 2]) -> [Near; J] {
        self.weights_bits(&Pair::of(at)).map(Near::from_bits)
    }

    /// The height at `s` and `t`, saturated.
    pub fn height(&self, heights: &[Real; J], at: [Address<N>; 2]) -> Real {
        Real::from_bits(mixed(&heights.map(Real::to_bits), &self.weights_bits(&Pair::of(at))))
    }

    /// The corner of the control grid at the ends or the beginnings of `s` and `t`.
    #[inline(always)]
    fn corner_index([s, t]: [bool; 2]) -> usize {
        let last = M.wrapping_sub(1);
        (if s { last.wrapping_mul(M) } else { 0 }) + if t { last } else { 0 }
    }

    #[inline(always)]
    fn weights_bits(&self, pair: &Pair) -> [Q28; J] {
        let mut weights = [0; J];
        if let Some(corner) = weights.get_mut(Self::corner_index(pair.at_end)) {
            *corner = super::barycentric::ONE;
        }
        if self.standard {
            return standard_weights(&self.maps, pair, weights);
        }
        let [mut s, mut t] = pair.indices;
        for _ in 0..pair.levels {
            let (rest_s, i) = split::<N>(s);
            let (rest_t, j) = split::<N>(t);
            if let Some(map) = self.maps.get(i as usize).and_then(|row| row.get(j as usize)) {
                weights = map.image(&weights);
            }
            (s, t) = (rest_s, rest_t);
        }
        weights
    }
}

impl Side {
    /// The weights on the side of a point.
    fn along<const M: usize, const J: usize>(self, point: &[Near; J]) -> [Near; M] {
        let mut weights = [Near::ZERO; M];
        for (k, weight) in weights.iter_mut().enumerate() {
            *weight = point.get(self.place(k, M)).copied().unwrap_or(Near::ZERO);
        }
        weights
    }

    /// The grid of the curve on this side: at most the weights of `side` points are looked at.
    fn curve<const N: usize, const M: usize, const J: usize>(
        self,
        grid: &[[Near; J]],
    ) -> impl Fn(usize) -> [Near; M] {
        move |k| {
            let side = M.saturating_sub(1) * N + 1;
            self.along::<M, J>(grid.get(self.place(k, side)).unwrap_or(&[Near::ZERO; J]))
        }
    }

    /// That every point of the grid on this side is `q` of the curve's, and its ends are corners.
    fn check<const N: usize, const M: usize, const J: usize>(
        self,
        grid: &[[Near; J]],
        curve: &impl Fn(usize) -> [Near; M],
    ) -> Result<(), Error> {
        let side = M.saturating_sub(1) * N + 1;
        for k in 0..side {
            let mut embedded = [Near::ZERO; J];
            let weights = match k {
                0 => unit(0),
                _ if k + 1 == side => unit(M - 1),
                _ => curve(k),
            };
            for (l, weight) in weights.into_iter().enumerate() {
                if let Some(place) = embedded.get_mut(self.place(l, M)) {
                    *place = weight;
                }
            }
            let given = grid.get(self.place(k, side)).unwrap_or(&embedded);
            agree(self.condition(), k, (given, &embedded), 0)?;
        }
        Ok(())
    }
}

impl<const N: usize, const M: usize, const J: usize> Scheme<J> for Patch<N, M, J> {
    const BASE: u32 = N as u32;
    const SIDES: [usize; 2] = [M; 2];
    const STEPS: [usize; 2] = [M.saturating_sub(1); 2];

    fn contraction(&self) -> &Contraction {
        &self.contraction
    }

    fn part(&self, heights: &[Q24; J], [i, j]: [u32; 2]) -> [Q24; J] {
        self.map(i as usize, j as usize).map_or(*heights, |map| map.part(heights))
    }

    fn corner(&self, heights: &[Q24; J], at_end: [bool; 2]) -> Q24 {
        heights.get(Self::corner_index(at_end)).copied().unwrap_or(0)
    }

    fn at(&self, heights: &[Q24; J], at: [u32; 2], levels: u32) -> Q24 {
        let [s, t] = at.map(|index| Address::<N>::of(index, levels).ok());
        let (Some(s), Some(t)) = (s, t) else { return 0 };
        mixed(heights, &self.weights_bits(&Pair::of([s, t])))
    }
}
