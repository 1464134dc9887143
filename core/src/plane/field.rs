//! A field: a value for each pixel, delivered row by row, never stored.
//!
//! It is what the kernels of pictures implement (dwell, density, ray caster) and what [`crate::draw`]
//! colours.

use core::iter::FusedIterator;
use core::ops::Range;

use embedded_graphics_core::geometry::Size;

/// A value for each pixel.
///
/// [`Field::at`] is enough; a kernel that prepares something for a row, or walks along it, writes
/// [`Field::row`] as well, with [`along`]. A closure is a field by [`from_fn`](super::from_fn()).
///
/// ```
/// use attractor::draw::{Grey, Picture};
/// use attractor::plane::Field;
/// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
///
/// /// Rings around the middle.
/// struct Rings(Size);
///
/// impl Field for Rings {
///     type Value = u8;
///
///     fn size(&self) -> Size {
///         self.0
///     }
///
///     fn at(&self, x: u32, y: u32) -> u8 {
///         let off = |v: u32, side: u32| (2 * v + 1).abs_diff(side).pow(2);
///         (off(x, self.0.width) + off(y, self.0.height)) as u8
///     }
/// }
///
/// let picture = Picture::new(Rings(Size::new(8, 8)), Grey);
/// let mut display = MockDisplay::<BinaryColor>::new();
/// Image::new(&picture, Point::zero()).draw(&mut display)?;
/// # Ok::<(), core::convert::Infallible>(())
/// ```
pub trait Field {
    /// What a pixel holds. A number, never a colour: colour enters in [`crate::draw`].
    type Value: Copy;

    /// Width and height in pixels.
    fn size(&self) -> Size;

    /// The value at column `x` and row `y`, `(0, 0)` at the upper left. Both must lie inside [`Field::size`].
    fn at(&self, x: u32, y: u32) -> Self::Value;

    /// The values at row `y` of the columns `x`, from left to right: what [`Field::at`] gives for each. The
    /// row must lie inside [`Field::size`]; columns beyond it have no pixels and are left out. The iterator's
    /// `nth` must not evaluate what it skips: drivers skip what they clip.
    #[inline]
    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Self::Value> {
        along(inside(x, self.size().width), move |x| self.at(x, y))
    }
}

impl<F: Field> Field for &F {
    type Value = F::Value;

    fn size(&self) -> Size {
        (**self).size()
    }

    #[inline]
    fn at(&self, x: u32, y: u32) -> F::Value {
        (**self).at(x, y)
    }

    #[inline]
    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = F::Value> {
        (**self).row(y, x)
    }
}

/// A field some rows of which are the same: those at the same distance above and below an axis.
pub trait Symmetric: Field {
    /// The row above this one that has the same values, to the last bit; none where there is none.
    ///
    /// Images of successive rows are successive: where `row` has one, that of `row - 1`, if any, is the next
    /// below it.
    fn mirror_image(&self, row: u32) -> Option<u32>;
}

impl<F: Symmetric> Symmetric for &F {
    fn mirror_image(&self, row: u32) -> Option<u32> {
        (**self).mirror_image(row)
    }
}

/// What of a range of columns lies inside a picture.
#[inline]
pub(crate) fn inside(columns: Range<u32>, width: u32) -> Range<u32> {
    columns.start.min(width)..columns.end.min(width)
}

/// A row: the value at each of the places, evaluated as it is asked for. Skipped places are not evaluated, as
/// [`Field::row`] promises; the `map` of an iterator evaluates them.
///
/// ```
/// use attractor::plane::along;
/// let mut row = along(10..90_u32, |x| {
///     assert!(x > 59, "never asked for");
///     x * x
/// });
/// assert_eq!((row.nth(50), row.len()), (Some(3600), 29));
/// ```
pub fn along<P, V>(
    places: P,
    value: impl FnMut(P::Item) -> V,
) -> impl ExactSizeIterator<Item = V> + FusedIterator
where
    P: ExactSizeIterator + FusedIterator,
{
    Along { places, value }
}

struct Along<P, F> {
    places: P,
    value: F,
}

impl<P: Iterator, V, F: FnMut(P::Item) -> V> Iterator for Along<P, F> {
    type Item = V;

    #[inline]
    fn next(&mut self) -> Option<V> {
        self.places.next().map(&mut self.value)
    }

    #[inline]
    fn nth(&mut self, n: usize) -> Option<V> {
        self.places.nth(n).map(&mut self.value)
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.places.size_hint()
    }
}

impl<P: ExactSizeIterator, V, F: FnMut(P::Item) -> V> ExactSizeIterator for Along<P, F> {}
impl<P: FusedIterator, V, F: FnMut(P::Item) -> V> FusedIterator for Along<P, F> {}
