//! A sheet: a square of cells over `[0, 1] x [0, 1]` that share one scheme, and their heights.
//!
//! Cell `(i, j)` of `g x g` begins at the control height `(i m, j m)`; neighbours have a side of control
//! heights in common, or overlap. One patch is a sheet of one cell.
//!
//! Source: as [`super::grid`] and [`super::lattice`]; that patches share one `T` is left to the reader there.

use super::contraction::Contraction;
use super::scheme::Scheme;
use crate::Error;
use crate::num::formats::Q24;
use crate::num::{Real, Vec3, Wide};

/// Heights of a square of cells, refined by a scheme.
#[derive(Debug)]
pub struct Sheet<'a, S, const J: usize> {
    scheme: &'a S,
    heights: &'a [Real],
    cells: u32,
}

// a copy of the references: schemes need not be `Copy`
impl<S, const J: usize> Copy for Sheet<'_, S, J> {}

impl<S, const J: usize> Clone for Sheet<'_, S, J> {
    fn clone(&self) -> Self {
        *self
    }
}

/// The most cells along a side.
const MOST_CELLS: u32 = 1 << 10;

impl<'a, S: Scheme<J>, const J: usize> Sheet<'a, S, J> {
    /// How many heights `cells x cells` cells take.
    pub const fn heights(cells: u32) -> usize {
        let [along_s, along_t] = Self::sides(cells);
        along_s.saturating_mul(along_t)
    }

    const fn sides(cells: u32) -> [usize; 2] {
        let cells = cells.saturating_sub(1) as usize;
        let ([a, b], [m, l]) = (S::SIDES, S::STEPS);
        [cells.saturating_mul(m).saturating_add(a), cells.saturating_mul(l).saturating_add(b)]
    }

    /// The sheet of `cells x cells` cells with these heights, row after row along `s`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for no cell or more than 1,024 along a side, and for a height that refining
    /// might take out of its format; [`Error::LengthMismatch`] for another number of heights.
    pub fn new(scheme: &'a S, heights: &'a [Real], cells: u32) -> Result<Self, Error> {
        if cells == 0 || cells > MOST_CELLS {
            let number = |n: u32| Wide::saturating_from_num(n);
            let (value, min, max) = (number(cells), Wide::ONE, number(MOST_CELLS));
            return Err(Error::OutOfRange { what: "cells along a side", index: None, value, min, max });
        }
        let expected = Self::heights(cells);
        if heights.len() != expected {
            return Err(Error::LengthMismatch { what: "heights", given: heights.len(), expected });
        }
        let contraction = scheme.contraction();
        for (index, height) in heights.iter().enumerate() {
            if !contraction.allows(i64::from(height.to_bits()).abs()) {
                let max = contraction.most();
                let (value, min) = (Wide::from(*height), -max);
                return Err(Error::OutOfRange { what: "height", index: Some(index), value, min, max });
            }
        }
        Ok(Self { scheme, heights, cells })
    }

    /// Cells along a side.
    pub const fn cells(&self) -> u32 {
        self.cells
    }

    /// The proof that it is a surface.
    pub fn contraction(&self) -> &Contraction {
        self.scheme.contraction()
    }

    pub(crate) const fn scheme(&self) -> &'a S {
        self.scheme
    }

    /// The control heights of a cell; those of the last for one beyond it.
    pub(crate) fn cell(&self, cell: [u32; 2]) -> [Q24; J] {
        let [_, across] = Self::sides(self.cells);
        let ([_, width], [m, l]) = (S::SIDES, S::STEPS);
        let [i, j] = cell.map(|place| place.min(self.cells.saturating_sub(1)) as usize);
        let mut heights = [0; J];
        for (a, row) in heights.chunks_exact_mut(width.max(1)).enumerate() {
            let begin = (i * m + a) * across + j * l;
            for (place, height) in row.iter_mut().zip(self.heights.iter().skip(begin)) {
                *place = height.to_bits();
            }
        }
        heights
    }

    /// The control heights of the part of this size at `index`; those of the last for one beyond it.
    ///
    /// Error: half a unit of `2^-24` a level, as much as later maps make of it
    /// (`moments_of_parts_together_are_those_of_the_whole`).
    pub fn part(&self, index: [u32; 2], levels: u32) -> [Real; J] {
        self.part_bits(index, levels).map(Real::from_bits)
    }

    pub(crate) fn part_bits(&self, index: [u32; 2], levels: u32) -> [Q24; J] {
        let base = S::BASE.max(1);
        let mut places = base.checked_pow(levels).unwrap_or(u32::MAX).max(1);
        let mut heights = self.cell(index.map(|place| place / places));
        let mut rest = index.map(|place| place % places);
        while places > 1 {
            places = (places / base).max(1);
            heights = self.scheme.part(&heights, rest.map(|place| (place / places).min(base - 1)));
            rest = rest.map(|place| place % places);
        }
        heights
    }

    /// The height at `index / (cells N^levels)` of both parameters, which end at 1.
    ///
    /// Error: as that of the scheme's weights times the sum of the heights' magnitudes, and half a unit of
    /// `2^-24` (`a_sheet_is_its_cells`).
    pub fn at(&self, index: [u32; 2], levels: u32) -> Real {
        let parts = S::BASE.checked_pow(levels).unwrap_or(1).max(1);
        let end = u64::from(self.cells) * u64::from(parts);
        let place = index.map(|index| u64::from(index).min(end));
        // a joint belongs to the cell behind it, the end to the last
        let cell = place.map(|place| ((place / u64::from(parts)) as u32).min(self.cells.saturating_sub(1)));
        let [s, t] = [0, 1].map(|axis: usize| {
            let (place, cell) = (place.get(axis).copied().unwrap_or(0), cell.get(axis).copied().unwrap_or(0));
            place.saturating_sub(u64::from(cell) * u64::from(parts)) as u32
        });
        Real::from_bits(self.scheme.at(&self.cell(cell), [s, t], levels))
    }

    /// The mean normal `(-mean h_x, -mean h_y, 1)` over the part of this size at `index`, from the heights of
    /// its corners, components saturated at ±64. The finer the part, the nearer the surface's own where it
    /// has one: a rough surface has none, and its mean normals do not settle.
    pub fn mean_normal(&self, index: [u32; 2], levels: u32) -> Vec3 {
        let [i, j] = index;
        let next = [i.saturating_add(1), j.saturating_add(1)];
        let at = |s: u32, t: u32| i64::from(self.at([s, t], levels).to_bits());
        let corners = [at(i, j), at(i, next[1]), at(next[0], j), at(next[0], next[1])];
        let parts = u64::from(self.cells) * u64::from(S::BASE.checked_pow(levels).unwrap_or(1));
        mean_normal(corners, parts)
    }
}

/// Of a place where a normal is looked for: so many parts along a side at most, so that what heights are
/// rounded by changes slopes by less than `2^-8`.
const FINE: u64 = 1 << 14;

impl<S: Scheme<J>, const J: usize> Sheet<'_, S, J> {
    /// The normal `(-h_x, -h_y, 1)` at `index / (cells N^levels)`, components saturated at ±64; none where
    /// there is none.
    ///
    /// A surface has a normal where a plane touches it: here, where the eight neighbours, as far away as
    /// parts of the two finest levels up to `2^14` along a side are wide, are off a plane by at most
    /// `tolerance` times as much. A rough surface is off by more the nearer they are. Smooth ones need about
    /// `2^-6`, and more where they are curved much.
    ///
    /// Result: none for a place outside, or with fewer than two finer levels.
    pub fn normal(&self, index: [u32; 2], levels: u32, tolerance: Real) -> Option<Vec3> {
        let base = u64::from(S::BASE);
        let coarse = u64::from(self.cells).checked_mul(base.checked_pow(levels)?)?;
        let (mut level, mut parts) = (levels, coarse);
        while parts.saturating_mul(base) <= FINE && base > 1 {
            (level, parts) = (level.saturating_add(1), parts.saturating_mul(base));
        }
        if level < levels.saturating_add(2) || index.iter().any(|index| u64::from(*index) > coarse) {
            return None;
        }
        // how much a place is higher that is so many parts away, times the parts
        let rise = |[i, j]: [i64; 2], level: u32, parts: u64| {
            let finer = parts.checked_div(coarse)?;
            let place = |index: u32, by: i64| {
                let place = (u64::from(index) * finer).checked_add_signed(by)?;
                u32::try_from(place).ok().filter(|place| u64::from(*place) <= parts)
            };
            let at = |i, j| Some(self.at([place(index[0], i)?, place(index[1], j)?], level).to_bits());
            Some((i64::from(at(i, j)?) - i64::from(at(0, 0)?)) * parts as i64)
        };
        let slope = |[i, j]: [i64; 2]| {
            let [ahead, behind] = [[i, j], [-i, -j]].map(|by| rise(by, level, parts));
            match (ahead, behind) {
                (Some(ahead), Some(behind)) => Some((ahead - behind) / 2),
                (ahead, behind) => ahead.or(behind.map(|rise| -rise)),
            }
        };
        let (x, y) = (slope([1, 0])?, slope([0, 1])?);
        for (level, parts) in [(level, parts), (level.wrapping_sub(1), parts / base.max(1))] {
            for [i, j] in (0..9).map(|k| [k / 3 - 1, k % 3 - 1]) {
                let off = rise([i, j], level, parts).map(|rise| rise - i * x - j * y);
                if off.is_some_and(|off| off.abs() > i64::from(tolerance.to_bits())) {
                    return None;
                }
            }
        }
        let component = |slope: i64| Real::from_bits((-slope).clamp(-(64 << 24), 64 << 24) as i32);
        Some(Vec3::new(component(x), component(y), Real::ONE))
    }
}

/// From the heights of a part's corners, 24 fractional bits, and how many parts lie along a side.
pub(crate) fn mean_normal([h00, h01, h10, h11]: [i64; 4], parts: u64) -> Vec3 {
    let slope = |rise: i64| {
        let slope = i128::from(-rise) * i128::from(parts) / 2;
        Real::from_bits(slope.clamp(-(64 << 24), 64 << 24) as i32)
    };
    Vec3::new(slope(h10 + h11 - h00 - h01), slope(h01 + h11 - h00 - h10), Real::ONE)
}
