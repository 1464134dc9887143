//! Given heights: a grid of numbers over knots, of any size from 2 x 2 on.
//!
//! The knots lie at integer coordinates from an origin on, columns along `u`, rows along `v`, row by row in
//! memory. A surface by subdivision passes through them; the patches of an inner geometry hang on them.
//!
//! Format: heights 24 fractional bits, inside ±64.

use crate::Error;
use crate::num::formats::Q24;
use crate::num::{Real, Wide};

/// A grid of heights. Size on a 32-bit machine: 20 bytes.
///
/// ```
/// use attractor::num::Real;
/// use attractor::terrain::Heights;
///
/// let knots = [0, 1, 2, 0, -1, 0].map(Real::from_num);
/// let heights = Heights::new(3, 2, &knots)?.with_origin(-1, 7)?;
/// assert_eq!(heights.at(2, 0), Real::from_num(2));
/// assert!(Heights::new(6, 1, &knots).is_err());
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Heights<'a> {
    heights: &'a [Real],
    columns: u16,
    rows: u16,
    origin: [i16; 2],
}

/// The most columns or rows: coordinates are between ±32768.
const MOST: u16 = 32768;

impl<'a> Heights<'a> {
    /// These heights, row by row, from the knot `(0, 0)` on.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than two columns or rows, [`Error::Capacity`] for more than 32768,
    /// [`Error::LengthMismatch`] unless there is a height for each knot, [`Error::OutOfRange`] for a height
    /// outside ±64.
    pub fn new(columns: u32, rows: u32, heights: &'a [Real]) -> Result<Self, Error> {
        for (what, given) in [("columns of knots", columns), ("rows of knots", rows)] {
            if given < 2 {
                return Err(Error::TooFew { what, given: given as usize, at_least: 2 });
            }
            if given > u32::from(MOST) {
                return Err(Error::Capacity { what, needed: given as usize, capacity: MOST.into() });
            }
        }
        // at most 2^30
        let expected = (columns * rows) as usize;
        if heights.len() != expected {
            return Err(Error::LengthMismatch { what: "heights", given: heights.len(), expected });
        }
        let limit = 64 << 24;
        if let Some(index) = heights.iter().position(|h| h.to_bits().unsigned_abs() >= limit) {
            let value = heights.get(index).copied().unwrap_or_default();
            return Err(out_of_range("height", Some(index), value.into()));
        }
        Ok(Self { heights, columns: columns as u16, rows: rows as u16, origin: [0; 2] })
    }

    /// The same heights with the first knot elsewhere: other random numbers between them.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] where the last knot would lie beyond 32767.
    pub fn with_origin(self, u: i16, v: i16) -> Result<Self, Error> {
        for (what, first, count) in
            [("first column of knots", u, self.columns), ("first row of knots", v, self.rows)]
        {
            let most = 32768 - i32::from(count);
            if i32::from(first) > most {
                return Err(Error::OutOfRange {
                    what,
                    index: None,
                    value: Wide::from_num(first),
                    min: Wide::MIN,
                    max: Wide::from_num(most),
                });
            }
        }
        Ok(Self { origin: [u, v], ..self })
    }

    /// How many columns there are.
    pub const fn columns(&self) -> u32 {
        self.columns as u32
    }

    /// How many rows there are.
    pub const fn rows(&self) -> u32 {
        self.rows as u32
    }

    /// The coordinates of the first knot.
    pub const fn origin(&self) -> [i16; 2] {
        self.origin
    }

    /// The height of a knot by its column and row, those beyond the end being the last.
    #[inline]
    pub fn at(&self, column: u32, row: u32) -> Real {
        Real::from_bits(self.bits(column.min(self.columns() - 1), row.min(self.rows() - 1)))
    }

    /// The height of a knot that is there.
    #[inline(always)]
    pub(crate) fn bits(&self, column: u32, row: u32) -> Q24 {
        let index = row.wrapping_mul(self.columns()).wrapping_add(column);
        self.heights.get(index as usize).copied().unwrap_or_default().to_bits()
    }

    /// Something of the heights of a cell and of what is round it, row by row from south-west; of the nearest
    /// in place of those beyond the rim.
    #[inline(always)]
    pub(crate) fn around<T>(&self, i: u32, j: u32, of: impl Fn(Q24) -> T) -> [[T; 4]; 4] {
        match self.rows_around(i, j) {
            Some(rows) => rows.map(|row| row.each_ref().map(|h| of(h.to_bits()))),
            None => self.around_at_the_rim(i, j).map(|row| row.map(&of)),
        }
    }

    /// The four rows, where none of them is beyond the rim.
    #[inline(always)]
    fn rows_around(&self, i: u32, j: u32) -> Option<[&[Real; 4]; 4]> {
        let (columns, rows) = (self.columns(), self.rows());
        if i == 0 || j == 0 || i + 2 >= columns || j + 2 >= rows {
            return None;
        }
        let row = |from: u32| self.heights.get(from as usize..)?.first_chunk();
        let first = (j - 1).wrapping_mul(columns).wrapping_add(i - 1);
        let (second, third) = (first.wrapping_add(columns), first.wrapping_add(2 * columns));
        Some([row(first)?, row(second)?, row(third)?, row(second.wrapping_add(2 * columns))?])
    }

    #[inline(never)]
    fn around_at_the_rim(&self, i: u32, j: u32) -> [[Q24; 4]; 4] {
        let four = |k: u32, count: u32| [k.saturating_sub(1), k, k + 1, (k + 2).min(count - 1)];
        let columns = four(i, self.columns());
        four(j, self.rows()).map(|row| columns.map(|column| self.bits(column, row)))
    }

    /// The least and the greatest height.
    pub fn range(&self) -> [Real; 2] {
        let (mut low, mut high) = (Real::MAX, Real::MIN);
        for height in self.heights {
            (low, high) = (low.min(*height), high.max(*height));
        }
        [low, high]
    }
}

/// A height outside ±64.
pub(crate) fn out_of_range(what: &'static str, index: Option<usize>, value: Wide) -> Error {
    Error::OutOfRange { what, index, value, min: Wide::from_num(-64), max: Wide::from_num(64) }
}
