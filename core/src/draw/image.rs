//! A field with a palette: an image that is computed while it is drawn, without a frame buffer.

use core::iter::FusedIterator;
use core::marker::PhantomData;
use core::ops::Range;

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, OriginDimensions, Point, Size};
use embedded_graphics_core::image::{GetPixel, ImageDrawable};
use embedded_graphics_core::primitives::Rectangle;

use super::ink::{Ink, shown};
use super::palette::Palette;
use crate::draw::clip::visible;
use crate::plane::Field;

/// A [`Field`] seen through a [`Palette`] in the colour type `C`, which follows from the display.
///
/// It is an [`ImageDrawable`]: `Image::new(&picture, position)` puts it anywhere, `picture.sub_image(&area)`
/// shows a part, both evaluate nothing but the pixels that the target can show, row by row with one
/// `fill_contiguous` a row. Dithering follows the picture's own coordinates: a part shows the same pixels as
/// the whole. [`Picture::with_dither_origin`] lets it follow a pan instead.
///
/// ```
/// use attractor::draw::{Picture, hex};
/// use attractor::plane::from_fn;
/// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
///
/// let checkers = from_fn(Size::new(5, 2), |x, y| (x + y) % 2 == 0);
/// let picture = Picture::new(checkers, |even: bool| if even { hex(0xff0000) } else { hex(0x0000ff) });
/// let mut display = MockDisplay::<Rgb565>::new();
/// Image::new(&picture, Point::new(1, 1)).draw(&mut display)?;
/// display.assert_pattern(&["      ", " RBRBR", " BRBRB"]);
/// # Ok::<(), core::convert::Infallible>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Picture<F, P, C> {
    field: F,
    palette: P,
    dither_origin: Point,
    color: PhantomData<fn() -> C>,
}

impl<F, P, C> Picture<F, P, C> {
    /// Shows `field` in the colours of `palette`. Either may be a reference.
    pub const fn new(field: F, palette: P) -> Self {
        Self { field, palette, dither_origin: Point::zero(), color: PhantomData }
    }

    /// The same picture, dithered as if its pixel `origin` were the top left one. A view that pans keeps it
    /// at the same place of the plane, so that a value shows the same dots wherever it moves to: `-(dx, dy)`
    /// after [`View::pan`](crate::escape::View::pan)`(dx, dy)`, and so on with the sum of all pans. Without
    /// it the dots stand still while the picture moves below them, and the display shimmers.
    ///
    /// ```
    /// use attractor::draw::{Grey, Picture};
    /// use attractor::plane::from_fn;
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    ///
    /// let flat = from_fn(Size::new(8, 1), |_, _| 96_u8);
    /// let mut display = MockDisplay::<BinaryColor>::new();
    /// let picture = Picture::new(flat, Grey);
    /// picture.draw_row(&mut display, 0)?;
    /// // one pixel to the right in the plane: everything moves one to the left
    /// let panned = Picture::new(flat, Grey).with_dither_origin(Point::new(-1, 0));
    /// panned.draw_row(&mut display.translated(Point::new(0, 1)), 0)?;
    /// display.assert_pattern(&[
    ///     "#.#.#.#.",
    ///     ".#.#.#.#",
    /// ]);
    /// # Ok::<(), core::convert::Infallible>(())
    /// ```
    pub const fn with_dither_origin(mut self, origin: Point) -> Self {
        self.dither_origin = origin;
        self
    }

    /// The field.
    pub const fn field(&self) -> &F {
        &self.field
    }

    /// The palette.
    pub const fn palette(&self) -> &P {
        &self.palette
    }
}

impl<F: Field, P: Palette<F::Value>, C: Ink> Picture<F, P, C> {
    /// The colours of row `y` in the columns `x`, from left to right, as far as they lie inside the picture;
    /// none of a row outside.
    ///
    /// `nth` evaluates only the pixel it returns, as far as the field keeps that promise of [`Field::row`].
    ///
    /// ```
    /// use attractor::draw::{Grey, Picture};
    /// use attractor::plane::from_fn;
    /// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
    ///
    /// let picture = Picture::<_, _, Gray8>::new(from_fn(Size::new(9, 9), |x, y| (10 * y + x) as u8), Grey);
    /// let mut row = picture.colors(4, 3..99).expect("row 4 of 9");
    /// assert_eq!((row.next(), row.len(), row.nth(4)), (Some(Gray8::new(43)), 5, Some(Gray8::new(48))));
    /// assert!(picture.colors(9, 0..9).is_none());
    /// ```
    pub fn colors(&self, y: u32, x: Range<u32>) -> Option<impl ExactSizeIterator<Item = C> + FusedIterator> {
        let size = self.field.size();
        if y >= size.height {
            return None;
        }
        let end = x.end.min(size.width);
        let start = x.start.min(end);
        Some(Colors {
            values: self.field.row(y, start..end),
            remaining: end - start,
            palette: &self.palette,
            at: self.dithered_at(Point::new(start as i32, y as i32)),
            color: PhantomData,
        })
    }

    /// Where the dither matrix has the pixel `p`.
    pub(super) fn dithered_at(&self, p: Point) -> Point {
        let Point { x: left, y: top } = self.dither_origin;
        Point::new(p.x.wrapping_sub(left), p.y.wrapping_sub(top))
    }

    /// The columns and the rows that a target shows of the picture at its origin; either may be empty.
    pub(super) fn shown_on(&self, target: &impl Dimensions) -> (Range<u32>, Range<u32>) {
        let size = self.field.size();
        visible(size, &Rectangle::new(Point::zero(), size), &target.bounding_box())
    }

    /// Draws row `y` at its place, with the picture's origin at the target's: the smallest portion of work.
    /// [`RowCursor`](crate::draw::RowCursor) counts the rows for a loop that draws one a tick.
    ///
    /// # Errors
    /// Those of the target.
    pub fn draw_row<D: DrawTarget<Color = C>>(&self, target: &mut D, y: u32) -> Result<(), D::Error> {
        let (columns, rows) = self.shown_on(target);
        if rows.contains(&y) { self.fill_row(target, y, columns, Point::zero()) } else { Ok(()) }
    }

    /// One row, all of it visible; the pixel `origin` of the picture comes to lie on the target's `(0, 0)`.
    pub(super) fn fill_row<D>(
        &self,
        target: &mut D,
        y: u32,
        x: Range<u32>,
        origin: Point,
    ) -> Result<(), D::Error>
    where
        D: DrawTarget<Color = C>,
    {
        if x.is_empty() {
            return Ok(());
        }
        let Some(colors) = self.colors(y, x.clone()) else { return Ok(()) };
        let left = (x.start as i32).wrapping_sub(origin.x);
        let top = (y as i32).wrapping_sub(origin.y);
        let area = Rectangle::new(Point::new(left, top), Size::new(x.end - x.start, 1));
        target.fill_contiguous(&area, colors)
    }
}

impl<F: Field, P, C> OriginDimensions for Picture<F, P, C> {
    fn size(&self) -> Size {
        self.field.size()
    }
}

impl<F: Field, P: Palette<F::Value>, C: Ink> ImageDrawable for Picture<F, P, C> {
    type Color = C;

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<(), D::Error> {
        self.draw_sub_image(target, &Rectangle::new(Point::zero(), self.field.size()))
    }

    /// What of `area` lies outside the picture stays as it is on the target.
    fn draw_sub_image<D>(&self, target: &mut D, area: &Rectangle) -> Result<(), D::Error>
    where
        D: DrawTarget<Color = C>,
    {
        let (columns, rows) = visible(self.field.size(), area, &target.bounding_box());
        for y in rows {
            self.fill_row(target, y, columns.clone(), area.top_left)?;
        }
        Ok(())
    }
}

impl<F: Field, P: Palette<F::Value>, C: Ink> GetPixel for Picture<F, P, C> {
    type Color = C;

    /// Evaluates a row of one pixel; none outside the picture.
    fn pixel(&self, p: Point) -> Option<C> {
        let (x, y) = (u32::try_from(p.x).ok()?, u32::try_from(p.y).ok()?);
        self.colors(y, x..x.saturating_add(1))?.next()
    }
}

/// The colours of a row, from left to right.
struct Colors<'a, V, P, C> {
    values: V,
    remaining: u32,
    palette: &'a P,
    at: Point,
    color: PhantomData<fn() -> C>,
}

impl<V: Iterator, P: Palette<V::Item>, C: Ink> Iterator for Colors<'_, V, P, C> {
    type Item = C;

    // the loop over a row is the display's: it is worth a copy there
    #[inline(always)]
    fn next(&mut self) -> Option<C> {
        self.remaining = self.remaining.checked_sub(1)?;
        let value = self.values.next()?;
        let at = self.at;
        self.at.x = at.x.wrapping_add(1);
        Some(shown(self.palette, value, at))
    }

    #[inline]
    fn nth(&mut self, n: usize) -> Option<C> {
        let skipped = u32::try_from(n).ok().filter(|&n| n < self.remaining);
        let Some(skipped) = skipped else {
            self.remaining = 0;
            return None;
        };
        self.remaining -= skipped + 1;
        let value = self.values.nth(n)?;
        let at = Point::new(self.at.x.wrapping_add(skipped as i32), self.at.y);
        self.at.x = at.x.wrapping_add(1);
        Some(shown(self.palette, value, at))
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.remaining as usize, Some(self.remaining as usize))
    }
}

impl<V: Iterator, P: Palette<V::Item>, C: Ink> ExactSizeIterator for Colors<'_, V, P, C> {}

impl<V: Iterator, P: Palette<V::Item>, C: Ink> FusedIterator for Colors<'_, V, P, C> {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::draw::testing::{Counted, Driver, Frame, Manner};
    use crate::draw::{Grey, RowCursor};
    use crate::plane::from_fn;
    use embedded_graphics::Drawable;
    use embedded_graphics::draw_target::DrawTargetExt;
    use embedded_graphics::image::{Image, ImageDrawableExt};
    use embedded_graphics_core::pixelcolor::{BinaryColor, Gray4, Gray8};

    fn rectangle(x: i32, y: i32, width: u32, height: u32) -> Rectangle {
        Rectangle::new(Point::new(x, y), Size::new(width, height))
    }

    #[test]
    fn a_picture_is_one_exact_row_after_the_other() {
        let field = Counted::new(20, 9);
        let picture = Picture::new(&field, Grey);
        let mut driver = Driver::<Gray8>::new(rectangle(0, 0, 240, 240), Manner::Strict);
        Image::new(&picture, Point::new(30, 40)).draw(&mut driver).unwrap();
        assert_eq!(driver.calls.len(), 9);
        for (y, (area, colors)) in (0..).zip(&driver.calls) {
            assert_eq!(*area, rectangle(30, 40 + y as i32, 20, 1));
            assert!(colors.iter().copied().eq((0..20).map(|x| Gray8::new(Counted::value(x, y)))));
        }
        assert_eq!(field.evaluated.get(), 180);
    }

    #[test]
    fn nothing_is_evaluated_outside_the_target() {
        let field = Counted::new(240, 240);
        let picture = Picture::new(&field, Grey);
        for position in [(-240, 0), (16, 0), (0, -240), (0, 16), (i32::MAX - 300, 5), (-9999, -9999)] {
            let mut driver = Driver::<Gray8>::new(rectangle(0, 0, 16, 16), Manner::Strict);
            Image::new(&picture, position.into()).draw(&mut driver).unwrap();
            assert!(driver.calls.is_empty() && field.evaluated.get() == 0, "{position:?}");
        }
    }

    #[test]
    fn a_small_window_evaluates_no_more_than_its_own_pixels() {
        for corner in [(0, 0), (-100, -57), (-224, -224), (-230, 3)] {
            let field = Counted::new(240, 240);
            let picture = Picture::new(&field, Grey);
            let mut driver = Driver::<Gray8>::new(rectangle(0, 0, 16, 16), Manner::Strict);
            Image::new(&picture, corner.into()).draw(&mut driver).unwrap();
            let shown: usize = driver.calls.iter().map(|(_, colors)| colors.len()).sum();
            assert!(shown > 0 && field.evaluated.get() == shown && shown <= 16 * 16);
        }
        // and through the adapters of embedded-graphics
        let field = Counted::new(240, 240);
        let picture = Picture::new(&field, Grey);
        let mut driver = Driver::<Gray8>::new(rectangle(0, 0, 240, 240), Manner::Strict);
        ImageDrawable::draw(&picture, &mut driver.clipped(&rectangle(70, 80, 16, 16))).unwrap();
        assert_eq!(field.evaluated.get(), 16 * 16);
    }

    #[test]
    fn a_driver_that_skips_evaluates_only_what_it_shows() {
        let field = Counted::new(240, 240);
        let picture = Picture::new(&field, Grey);
        let mut driver = Driver::<Gray8>::new(rectangle(0, 0, 240, 240), Manner::Skip(100, 116));
        ImageDrawable::draw(&picture, &mut driver).unwrap();
        // one for the last of the skipped, which nth(n) returns
        assert_eq!(field.evaluated.get(), 240 * 17);
        for (y, (_, colors)) in (0..).zip(&driver.calls) {
            assert!(colors.iter().copied().eq((100..116).map(|x| Gray8::new(Counted::value(x, y)))));
        }
    }

    #[test]
    fn an_error_ends_the_drawing_and_the_cursor_repeats_the_row() {
        let field = Counted::new(8, 8);
        let picture = Picture::new(&field, Grey);
        let mut driver = Driver::<Gray8>::new(rectangle(0, 0, 8, 8), Manner::FailAt(3));
        assert_eq!(ImageDrawable::draw(&picture, &mut driver), Err("the bus is gone"));
        assert_eq!((driver.calls.len(), field.evaluated.get()), (3, 24));

        let mut cursor = RowCursor::new();
        driver.calls.clear();
        while cursor.draw_next(&picture, &mut driver).is_ok_and(|drawn| drawn) {}
        assert_eq!(cursor.row(), 3);
        driver.manner = Manner::Strict;
        while cursor.draw_next(&picture, &mut driver).unwrap() {}
        let rows: std::vec::Vec<_> = driver.calls.iter().map(|(area, _)| area.top_left.y).collect();
        assert_eq!(rows, [0, 1, 2, 3, 4, 5, 6, 7]);
    }

    #[test]
    fn a_part_shows_the_pixels_of_the_whole() {
        fn check<C: Ink + core::fmt::Debug>(black: C) {
            let field = Counted::new(40, 30);
            let picture = Picture::new(&field, Grey);
            let mut whole = Frame::<C>::new(Size::new(40, 30), black);
            Image::new(&picture, Point::zero()).draw(&mut whole).unwrap();
            for area in [
                rectangle(0, 0, 40, 30),
                rectangle(3, 5, 13, 11),
                rectangle(39, 29, 1, 1),
                rectangle(-4, 20, 99, 99),
            ] {
                let inside = rectangle(0, 0, 40, 30).intersection(&area);
                let mut part = Frame::<C>::new(Size::new(40, 30), black);
                Image::new(&picture.sub_image(&area), Point::zero()).draw(&mut part).unwrap();
                let top_left = Rectangle::new(Point::zero(), inside.size);
                assert_eq!(part.pixels(&top_left), whole.pixels(&inside), "{area:?}");
                assert_eq!(part.drawn, whole.pixels(&inside).len());
                // the same without SubImage, which cuts the area for us
                let mut part = Frame::<C>::new(Size::new(60, 60), black);
                picture.draw_sub_image(&mut part, &area).unwrap();
                let at = Rectangle::new(inside.top_left - area.top_left, inside.size);
                assert_eq!(part.pixels(&at), whole.pixels(&inside), "{area:?}");
            }
            for y in 0..30 {
                let row = whole.pixels(&rectangle(0, y as i32, 40, 1));
                assert!(picture.colors(y, 0..u32::MAX).unwrap().eq(row.iter().copied()));
                assert_eq!(picture.pixel(Point::new(7, y as i32)), row.get(7).copied());
            }
        }
        check(BinaryColor::Off);
        check(Gray4::new(0));
        check(Gray8::new(0));
    }

    #[test]
    fn skipping_in_a_row_is_the_same_as_walking() {
        let field = Counted::new(23, 2);
        let picture = Picture::<_, _, BinaryColor>::new(&field, Grey);
        let all: std::vec::Vec<_> = picture.colors(1, 0..23).unwrap().collect();
        for step in 1..30 {
            let mut colors = picture.colors(1, 2..23).unwrap();
            for x in (2..23_usize).skip(step - 1).step_by(step) {
                assert_eq!(colors.nth(step - 1), Some(all[x]), "{step} {x}");
                assert_eq!(colors.len(), 22 - x);
            }
            assert_eq!((colors.nth(step - 1), colors.next(), colors.len()), (None, None, 0));
        }
        assert_eq!(picture.colors(1, 0..23).unwrap().nth(usize::MAX), None);
        assert!(picture.colors(2, 0..23).is_none());
        assert_eq!(picture.colors(0, 23..99).unwrap().count(), 0);
        assert_eq!(picture.pixel(Point::new(-1, 0)), None);
        assert_eq!(picture.pixel(Point::new(23, 0)), None);
    }

    #[test]
    fn an_empty_field_is_asked_for_nothing() {
        for (width, height) in [(0, 0), (0, 3), (3, 0)] {
            // refuses every row below its own and every column beyond
            let field = Counted::new(width, height);
            let picture = Picture::<_, _, Gray8>::new(&field, Grey);
            for (x, y) in [(0, 0), (1, 0), (0, 2), (i32::MAX, i32::MAX), (-1, -1)] {
                assert_eq!(picture.pixel(Point::new(x, y)), None);
                picture.draw_row(&mut Driver::new(rectangle(0, 0, 9, 9), Manner::Strict), y as u32).unwrap();
            }
            assert_eq!(picture.colors(0, 0..5).is_some(), height > 0);
            assert!(picture.colors(height, 0..5).is_none());
            let mut driver = Driver::new(rectangle(0, 0, 9, 9), Manner::Strict);
            Image::new(&picture, Point::zero()).draw(&mut driver).unwrap();
            assert_eq!(RowCursor::new().draw_next(&picture, &mut driver), Ok(false));
            assert!(driver.calls.is_empty() && field.evaluated.get() == 0);
        }
    }

    #[test]
    fn a_pan_moves_the_dots_with_the_picture() {
        let size = Size::new(40, 30);
        let plane = |dx: i32, dy: i32| {
            from_fn(size, move |x, y| ((x as i32 + dx) * 5 + (y as i32 + dy) * 3).rem_euclid(256) as u8)
        };
        let shown = |dx: i32, dy: i32, origin: Point| {
            let picture = Picture::new(plane(dx, dy), Grey).with_dither_origin(origin);
            let mut frame = Frame::<BinaryColor>::new(size, BinaryColor::Off);
            Image::new(&picture, Point::zero()).draw(&mut frame).unwrap();
            frame
        };
        let before = shown(0, 0, Point::zero());
        for (dx, dy) in [(1, 0), (0, 1), (-3, 2), (9, -7), (-17, -11)] {
            let both = rectangle(0, 0, 40, 30).intersection(&rectangle(dx, dy, 40, 30));
            let there = Rectangle::new(both.top_left - Point::new(dx, dy), both.size);
            let after = shown(dx, dy, Point::new(-dx, -dy));
            assert_eq!(after.pixels(&there), before.pixels(&both), "{dx} {dy}");
            // with the matrix at rest the same values show other dots
            let still = shown(dx, dy, Point::zero());
            assert_ne!(still.pixels(&there), before.pixels(&both), "{dx} {dy}");
        }
    }

    #[test]
    fn a_cursor_draws_what_is_seen_and_no_tick_is_idle() {
        let field = Counted::new(20, 240);
        let picture = Picture::new(&field, Grey);
        let mut driver = Driver::<Gray8>::new(rectangle(0, 100, 20, 16), Manner::Strict);
        let mut cursor = RowCursor::new();
        let mut ticks = 0;
        while cursor.draw_next(&picture, &mut driver).unwrap() {
            ticks += 1;
            assert_eq!(cursor.row(), 100 + ticks);
        }
        assert_eq!((ticks, field.evaluated.get()), (16, 16 * 20));
        // from a row on
        driver.calls.clear();
        let mut cursor = RowCursor::starting_at(113);
        while cursor.draw_next(&picture, &mut driver).unwrap() {}
        assert!(driver.calls.iter().map(|(area, _)| area.top_left.y).eq(113..116));
        // beside the picture, and after its end
        let mut beside = Driver::<Gray8>::new(rectangle(20, 0, 9, 9), Manner::Strict);
        assert_eq!(RowCursor::new().draw_next(&picture, &mut beside), Ok(false));
        assert_eq!(RowCursor::starting_at(u32::MAX).draw_next(&picture, &mut driver), Ok(false));
    }

    extern crate std;
}
