//! How much a function and its slope vary above each cell of a pyramid, and above any interval.
//!
//! A cell has the variance of the slope, that of the value, and the lift `e = (f(x0) + f(x1)) / 2 - mean` of
//! the chord's middle above the mean. With the pyramid's mean slope `m`, which is the rise over the length,
//! the covariance of slope and value needs no table: `cov(f', f) = (f(x1)^2 - f(x0)^2) / (2 length) - m mean
//! = m e`. Source: [`super::variance`]; the identity is the fundamental theorem for `f f'`.

use super::above::{self, Above};
use super::ended::Ended;
use super::function::Fif;
use super::pyramid::{Cell, Pyramid};
use super::stretch::{Pool, Stretch, times};
use super::value::FRACTION_Q55;
use super::variance::FRACTION_OF_SQUARES;
use crate::Error;
use crate::num::{Real, Reciprocal, Wide, real_from};

/// How much a function varies above one of its cells, beside what a [`Cell`] says of it. 12 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Spread {
    /// Variance of the slope, saturated. Error: a unit (`moments_of_cells_are_those_of_the_reference`).
    pub slope: Real,
    /// Variance of the value, saturated. Error: a unit (`moments_of_cells_are_those_of_the_reference`).
    pub value: Real,
    /// The middle of the chord above the mean. Error: a unit (`moments_of_cells_are_those_of_the_reference`).
    pub lift: Real,
}

impl Spread {
    /// All zero: for the memory that moments are lent.
    pub const ZERO: Self = Self { slope: Real::ZERO, value: Real::ZERO, lift: Real::ZERO };

    fn of<const D: usize>(cell: &Above<D>) -> Self {
        Self {
            slope: real_from(cell.slope.variance, FRACTION_OF_SQUARES),
            value: real_from(cell.value.variance, FRACTION_OF_SQUARES),
            lift: real_from(cell.lift, FRACTION_Q55),
        }
    }
}

/// The moments of a differentiable function above the cells of its pyramid, in memory lent by the caller: as
/// many [`Spread`] as the pyramid has cells.
///
/// ```
/// use attractor::fif::{Cell, Fif, Knot, Moments, Pyramid, Spread};
/// use attractor::num::{Scaling, Wide};
///
/// let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
/// let g = Fif::<2, 2>::interpolating(&knots, &[0.85, -0.85].map(Scaling::from_num))?;
/// let integral = g.integral::<2>(Wide::ZERO)?;
/// let (mut cells, mut spreads) = ([Cell::ZERO; Pyramid::cells(2, 6)], [Spread::ZERO; Pyramid::cells(2, 6)]);
/// let pyramid = Pyramid::new(&integral, 6, &mut cells)?;
/// let moments = Moments::new(&integral, &pyramid, &mut spreads)?;
/// // the slope of the integral is g, whose variance is 100/333
/// let whole = moments.over(Wide::ZERO, Wide::from_num(2)).unwrap();
/// assert!((whole.slope_variance.to_num::<f64>() - 100.0 / 333.0).abs() < 1e-6);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Moments<'a> {
    pyramid: Pyramid<'a>,
    spreads: &'a [Spread],
}

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The spread of cell `index` of any level, deeper than any pyramid too: every cell is the whole,
    /// shrunken and sheared. Indices beyond the level's last count from 0 again.
    ///
    /// Error: a unit (`cells_finer_than_a_pyramid_are_those_of_the_reference`). Cost: a step for each level,
    /// of `2 D^2` products of 64 bits.
    ///
    /// # Errors
    /// [`Error::NotDifferentiable`] and [`Error::OutOfRange`] as [`Moments::new`].
    pub fn spread_at(&self, level: u32, index: u64) -> Result<Spread, Error> {
        let slopes: Self = self.slopes()?;
        let mut above = Above::whole(self, &slopes);
        let (mut rest, maps) = (index, self.maps.len() as u64);
        for _ in 0..level {
            // innermost map first
            let j = rest.checked_rem(maps).unwrap_or(0) as usize;
            rest = rest.checked_div(maps).unwrap_or(0);
            if let (Some(map), Some(slope)) = (self.maps.get(j), slopes.maps.get(j)) {
                above = above.part(map, slope, (0, 0));
            }
        }
        Ok(Spread::of(&above))
    }
}

/// What a cell and its spread say together.
#[inline(always)]
fn together(cell: &Cell, spread: &Spread) -> Stretch {
    let covariance = Real::from_bits(times(cell.slope.to_bits(), spread.lift.to_bits()));
    let (slope_variance, value_variance) = (spread.slope, spread.value);
    Stretch { slope: cell.slope, value: cell.mean, slope_variance, value_variance, covariance }
}

impl<'a> Moments<'a> {
    /// The moments of `fif` above the cells of its `pyramid`.
    ///
    /// Cost: a step for each cell, of `2 D^2` products of 64 bits.
    ///
    /// # Errors
    /// [`Error::BufferLength`] if `memory` is shorter than the pyramid; [`Error::LengthMismatch`] for the
    /// pyramid of another function; [`Error::NotDifferentiable`] if some `|alpha_j| >= a_j`, and
    /// [`Error::OutOfRange`] if the slope leaves the format.
    pub fn new<const N: usize, const D: usize>(
        fif: &Fif<N, D>,
        pyramid: &Pyramid<'a>,
        memory: &'a mut [Spread],
    ) -> Result<Self, Error> {
        let (given, needed) = (memory.len(), pyramid.all().len());
        let what = "spreads of 12 bytes beside the cells of the pyramid";
        let spreads = memory.get_mut(..needed).ok_or(Error::BufferLength { what, given, needed })?;
        if pyramid.starts() != fif.starts.as_slice() {
            let (given, expected) = (fif.maps.len(), pyramid.starts().len());
            return Err(Error::LengthMismatch { what: "maps of the pyramid's function", given, expected });
        }
        above::walk(fif, pyramid.depth(), |level, cell| {
            let (offset, _) = pyramid.place(level);
            if let Some(spread) = spreads.get_mut(offset + cell.index) {
                *spread = Spread::of(cell);
            }
        })?;
        Ok(Self { pyramid: *pyramid, spreads })
    }

    /// The pyramid beside which they stand.
    pub const fn pyramid(&self) -> &Pyramid<'a> {
        &self.pyramid
    }

    /// The spread of each cell, level after level.
    pub const fn spreads(&self) -> &'a [Spread] {
        self.spreads
    }

    #[inline(always)]
    fn at(&self, node: usize) -> Option<Stretch> {
        Some(together(self.pyramid.all().get(node)?, self.spreads.get(node)?))
    }

    /// Means, variances and covariance above `[from, to]`, pooled from cells; what lies outside the domain
    /// does not count, and an interval without any width inside has none.
    ///
    /// Of the two finest cells at the ends the part inside counts as the whole: an interval should be several
    /// cells wide. Error: 6 units where the ends are those of cells
    /// (`an_interval_is_what_its_cells_are_together`). Cost: `2 depth * maps` cells.
    pub fn over(&self, from: Wide, to: Wide) -> Option<Stretch> {
        let (x0, width) = self.pyramid.domain_bits();
        let whole = Reciprocal::of(width);
        let unit = |x: Wide| {
            let distance = if x.to_bits() < x0 { 0 } else { x.to_bits().wrapping_sub(x0) as u64 };
            (whole.quotient(distance.min(width)).wrapping_add(1 << 31) >> 32) as u32
        };
        self.between(unit(from.min(to)), unit(from.max(to)))
    }

    /// The same in the unit abscissa with 31 fractional bits.
    fn between(&self, from: u32, to: u32) -> Option<Stretch> {
        let (from, to) = (from.min(1 << 31), to.min(1 << 31));
        if from >= to {
            return None;
        }
        let starts = self.pyramid.starts();
        let n = starts.len();
        let mut pool: Option<Pool> = None;
        let mut add = |node: usize, weight: u32| {
            if let Some(part) = self.at(node).filter(|_| weight > 0) {
                pool.get_or_insert_with(|| Pool::around(part.slope, part.value)).add(&part, weight);
            }
        };
        // the cells with the two ends, level by level: first node of the level, then both ends' cells
        let (mut offset, mut left, mut right) = (0, Ended::WHOLE, Ended::WHOLE);
        for _ in 0..self.pyramid.depth() {
            offset = offset * n + 1;
            let last = right.index;
            let same = left.index == last;
            let (a, b) = (left.holding(starts, from, true), right.holding(starts, to, false));
            // whole parts between the two ends
            let mut inner = |cell: Ended, parts: core::ops::Range<usize>| {
                for j in parts {
                    let part = cell.part(starts, j);
                    add(offset + part.index, part.end.saturating_sub(part.start));
                }
            };
            let (i, j) = (a.index - left.index * n, b.index - last * n);
            if same {
                inner(left, i + 1..j);
            } else {
                inner(left, i + 1..n);
                inner(right, 0..j);
            }
            (left, right) = (a, b);
        }
        if left.index == right.index {
            add(offset + left.index, to.min(left.end).saturating_sub(from.max(left.start)));
        } else {
            add(offset + left.index, left.end.saturating_sub(from.max(left.start)));
            add(offset + right.index, to.min(right.end).saturating_sub(right.start));
        }
        pool.and_then(|pool| pool.stretch())
    }
}
