//! The Mandelbrot set: for each `c` of a view, the dwell of the orbit `0, c, c^2 + c, ...`.
//!
//! Source: course unit V, "The Mandelbrot set", sections 5.4.2 to 5.4.4. With `d_1 = c` the dwell is `min(iterations until |d_k| > 2, Num)`.
//! The two largest parts of the set are recognised by formula; elsewhere cycles are.

use core::iter::FusedIterator;
use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use super::interior;
use super::precision::Precision;
use super::view::{Line, View, narrow};
use super::{Complex, Dwell, checked_max};
use crate::Error;
use crate::num::Wide;
use crate::picture::Field;

/// The dwell at every pixel of a view.
///
/// ```
/// use attractor::escape::{Mandelbrot, View};
/// use attractor::picture::Field;
/// use embedded_graphics_core::geometry::Size;
/// let picture = Mandelbrot::new(View::home(Size::new(24, 20))?, 100)?;
/// let inside = (0..20).flat_map(|y| picture.row(y, 0..24)).filter(|d| d.is_inside()).count();
/// assert_eq!(inside, 94);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mandelbrot {
    view: View,
    max: u32,
    precision: Precision,
    interior: bool,
}

impl Mandelbrot {
    /// The set as `view` shows it, with at most `max_dwell` iterations a pixel (a hundred is usual, more for a deeper view).
    ///
    /// # Errors
    /// [`Error::TooFew`] for a `max_dwell` of 0, [`Error::Capacity`] above [`MAX_DWELL`](super::MAX_DWELL).
    pub fn new(view: View, max_dwell: u32) -> Result<Self, Error> {
        let max = checked_max(max_dwell)?;
        Ok(Self { view, max, precision: Precision::of(view.pitch(), max), interior: true })
    }

    /// The same with another precision than the one that suits the view.
    #[must_use]
    pub const fn with_precision(self, precision: Precision) -> Self {
        Self { precision, ..self }
    }

    /// The view.
    pub const fn view(&self) -> &View {
        &self.view
    }

    /// `Num`, the dwell of a point that does not escape.
    pub const fn max_dwell(&self) -> u32 {
        self.max
    }

    /// How products are rounded.
    pub const fn precision(&self) -> Precision {
        self.precision
    }

    /// The dwell at any point of the plane.
    ///
    /// Domain: all. Result: iterations. Error: none for the nearest point with 29 fractional bits as long as the orbit's rounding does not
    /// matter; how often it does: `dwell_agrees_with_float_on_the_home_view`, `a_dyadic_grid_agrees_with_250_bits`.
    #[inline]
    pub fn dwell_at(&self, c: Complex<Wide>) -> Dwell {
        let count = match narrow(c) {
            None => 0,
            Some(c) if self.interior && interior::contains(c) => self.max,
            Some(c) => self.precision.dwell(c, c, self.max),
        };
        Dwell { count, max: self.max }
    }
}

impl Field for Mandelbrot {
    type Value = Dwell;
    type Row<'a> = MandelbrotRow<'a>;

    fn size(&self) -> Size {
        self.view.size()
    }

    fn row(&self, y: u32, x: Range<u32>) -> MandelbrotRow<'_> {
        MandelbrotRow { picture: self, line: self.view.line(y, x) }
    }
}

/// The dwells of a row, from left to right.
#[derive(Debug, Clone)]
pub struct MandelbrotRow<'a> {
    picture: &'a Mandelbrot,
    line: Line,
}

impl Iterator for MandelbrotRow<'_> {
    type Item = Dwell;

    #[inline]
    fn next(&mut self) -> Option<Dwell> {
        self.line.next().map(|c| self.picture.dwell_at(c))
    }

    #[inline]
    fn nth(&mut self, n: usize) -> Option<Dwell> {
        self.line.nth(n).map(|c| self.picture.dwell_at(c))
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.line.size_hint()
    }
}

impl ExactSizeIterator for MandelbrotRow<'_> {}
impl FusedIterator for MandelbrotRow<'_> {}
