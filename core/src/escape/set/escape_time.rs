//! What the escape-time pictures have in common: the trait by which other types colour them in another way or
//! draw them faster.

use core::iter::FusedIterator;
use core::ops::Range;

use crate::Error;
use crate::escape::orbit::ending::Ending;
use crate::escape::value::{Dwell, Period};
use crate::plane::{Symmetric, along, inside};

/// A picture whose pixels are dwells of orbits of `z^2 + c`: [`Mandelbrot`](crate::escape::Mandelbrot),
/// [`Julia`](crate::escape::Julia) and [`DeepMandelbrot`](crate::escape::DeepMandelbrot).
pub trait EscapeTime: Symmetric<Value = Dwell> {
    /// What an orbit belongs to: a point of the plane, or in a deep view the column and row of a pixel.
    type Point: Copy;

    /// The point in the middle of a pixel.
    fn point_at(&self, column: u32, row: u32) -> Self::Point;
    /// The points of a part of a row, from left to right.
    fn line(
        &self,
        row: u32,
        columns: Range<u32>,
    ) -> impl ExactSizeIterator<Item = Self::Point> + FusedIterator {
        along(inside(columns, self.size().width), move |column| self.point_at(column, row))
    }
    /// The dwell of a point that does not escape.
    fn max_dwell(&self) -> u32;
    /// The dwell at a point.
    fn dwell_at(&self, point: Self::Point) -> Dwell;
    /// Where the orbit of a point is when it escapes; none where it does not.
    fn ending(&self, point: Self::Point) -> Option<Ending>;
    /// The same with the derivative by the point.
    fn ending_with_derivative(&self, point: Self::Point) -> Option<Ending>;
    /// The cycle that the orbit of a point is drawn to; none where it escapes or no cycle shows.
    fn period_at(&self, point: Self::Point) -> Option<Period>;
    /// The distance of two neighbouring pixels: `mantissa 2^exponent`, the mantissa at least `2^28`.
    fn pitch(&self) -> (u32, i32);
}

impl<P: EscapeTime> EscapeTime for &P {
    type Point = P::Point;

    #[inline]
    fn point_at(&self, column: u32, row: u32) -> P::Point {
        (**self).point_at(column, row)
    }

    #[inline]
    fn line(&self, row: u32, columns: Range<u32>) -> impl ExactSizeIterator<Item = P::Point> + FusedIterator {
        (**self).line(row, columns)
    }

    fn max_dwell(&self) -> u32 {
        (**self).max_dwell()
    }

    #[inline]
    fn dwell_at(&self, point: P::Point) -> Dwell {
        (**self).dwell_at(point)
    }

    fn ending(&self, point: P::Point) -> Option<Ending> {
        (**self).ending(point)
    }

    fn ending_with_derivative(&self, point: P::Point) -> Option<Ending> {
        (**self).ending_with_derivative(point)
    }

    fn period_at(&self, point: P::Point) -> Option<Period> {
        (**self).period_at(point)
    }

    fn pitch(&self) -> (u32, i32) {
        (**self).pitch()
    }
}

/// A picture whose view can be moved.
pub trait Pan {
    /// Moves the view by whole pixels to the right and up.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] where the view ends; the picture is then unchanged.
    fn pan(&mut self, right: i32, up: i32) -> Result<(), Error>;
}
