//! Core's surfaces of a fitted family: what a scene file describes and what a fit is measured with.

use attractor::Error;
use attractor::num::{Near, Real};
use attractor::patch::{Mask, Patch, Sheet, Tensor, standard_curve};

use super::family::Family;

/// What refines the heights of a cell.
#[derive(Debug)]
pub(crate) enum Scheme {
    Standard(Box<Patch<2, 3, 9>>),
    Tensor(Box<Tensor<2, 3, 3, 9>>),
    Lattice(Box<Mask>),
}

impl Scheme {
    /// The scheme with these numbers.
    ///
    /// # Errors
    /// Those of core; [`Error::LengthMismatch`] for another count of numbers.
    pub(crate) fn new(family: Family, numbers: &[Near]) -> Result<Self, Error> {
        let (given, expected) = (numbers.len(), family.numbers());
        let mismatch = Error::LengthMismatch { what: "numbers", given, expected };
        Ok(match family {
            Family::Standard => {
                Self::Standard(Box::new(Patch::standard(numbers.try_into().map_err(|_| mismatch)?)?))
            }
            Family::Lattice => {
                Self::Lattice(Box::new(Mask::from_numbers(numbers.try_into().map_err(|_| mismatch)?)?))
            }
            Family::Tensor => {
                let [a, b, c, d, e, f, g, h] = *numbers else { return Err(mismatch) };
                let (u, v) = (standard_curve([a, b], [c, d])?, standard_curve([e, f], [g, h])?);
                Self::Tensor(Box::new(Tensor::new(u, v)?))
            }
        })
    }

    /// Whether core takes numbers and heights for a surface: joined by construction, proven to contract, and
    /// no height so great that refining might take it out of its format.
    pub(crate) fn is_one(family: Family, numbers: &[f64], heights: &[f64], cells: usize) -> bool {
        let numbers: Option<Vec<Near>> = numbers.iter().map(|n| rounded(*n)).collect();
        let heights: Option<Vec<Real>> = heights.iter().map(|h| rounded(*h)).collect();
        let (Some(numbers), Some(heights)) = (numbers, heights) else { return false };
        Self::new(family, &numbers).is_ok_and(|scheme| scheme.check(&heights, cells as u32).is_ok())
    }

    /// Whether these heights are those of so many cells.
    ///
    /// # Errors
    /// Those of [`Sheet::new`].
    pub(crate) fn check(&self, heights: &[Real], cells: u32) -> Result<(), Error> {
        match self {
            Self::Standard(scheme) => Sheet::new(&**scheme, heights, cells).map(drop),
            Self::Tensor(scheme) => Sheet::new(&**scheme, heights, cells).map(drop),
            Self::Lattice(scheme) => Sheet::new(&**scheme, heights, cells).map(drop),
        }
    }

    /// All heights of a level, row after row.
    ///
    /// # Errors
    /// Those of [`Sheet::new`].
    pub(crate) fn tabulated(&self, heights: &[Real], cells: u32, levels: u32) -> Result<Vec<Real>, Error> {
        let last = cells << levels;
        let all = || (0..=last).flat_map(|i| (0..=last).map(move |j| [i, j]));
        Ok(match self {
            Self::Standard(scheme) => {
                let sheet = Sheet::new(&**scheme, heights, cells)?;
                all().map(|at| sheet.at(at, levels)).collect()
            }
            Self::Tensor(scheme) => {
                let sheet = Sheet::new(&**scheme, heights, cells)?;
                all().map(|at| sheet.at(at, levels)).collect()
            }
            Self::Lattice(scheme) => {
                let sheet = Sheet::new(&**scheme, heights, cells)?;
                all().map(|at| sheet.at(at, levels)).collect()
            }
        })
    }
}

/// With the fractional bits of core; none outside the format.
fn rounded<F: attractor::fixed::traits::Fixed>(number: f64) -> Option<F> {
    number.is_finite().then(|| F::checked_from_num(number))?
}
