//! A closure as a field: the shortest way to a picture of one's own.

use embedded_graphics_core::geometry::Size;

use super::field::Field;

/// The field whose pixel in column `x` and row `y` holds `value(x, y)`, for all `x < size.width` and `y <
/// size.height`.
///
/// Cost: one call for each pixel that is looked at; a skipped one takes none.
///
/// ```
/// use attractor::draw::{Grey, Picture};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
///
/// let wedge = from_fn(Size::new(8, 4), |x, _y| (x * 36) as u8);
/// let picture = Picture::new(wedge, Grey);
/// let mut display = MockDisplay::<BinaryColor>::new();
/// Image::new(&picture, Point::zero()).draw(&mut display)?;
/// display.assert_pattern(&[
///     "..#.####",
///     "...#.#.#",
///     "..#.#.##",
///     "...#.#.#",
/// ]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
pub const fn from_fn<V: Copy, F: Fn(u32, u32) -> V>(size: Size, value: F) -> FromFn<F> {
    FromFn { size, value }
}

/// See [`from_fn`].
#[derive(Debug, Clone, Copy)]
pub struct FromFn<F> {
    size: Size,
    value: F,
}

impl<V: Copy, F: Fn(u32, u32) -> V> Field for FromFn<F> {
    type Value = V;

    fn size(&self) -> Size {
        self.size
    }

    #[inline]
    fn at(&self, x: u32, y: u32) -> V {
        (self.value)(x, y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::cell::Cell;

    #[test]
    fn a_row_calls_the_closure_for_what_it_yields_alone() {
        let calls = Cell::new(0);
        let field = from_fn(Size::new(100, 7), |x, y| {
            calls.set(calls.get() + 1);
            (x, y)
        });
        assert_eq!(field.size(), Size::new(100, 7));
        assert!(field.row(6, 97..100).eq([(97, 6), (98, 6), (99, 6)]));
        assert_eq!(calls.take(), 3);
        let mut row = field.row(3, 10..90);
        assert_eq!(row.nth(50), Some((60, 3)));
        assert_eq!((row.next(), row.size_hint()), (Some((61, 3)), (28, Some(28))));
        assert_eq!((row.nth(28), row.next()), (None, None));
        assert_eq!(calls.get(), 2);
    }
}
