//! A symmetric picture: a row is computed once and drawn twice, itself and its mirror image, from a lent row.
//!
//! Rows are drawn from below. Mirror images of successive rows are successive, and lie above them: the range
//! of those that have been drawn is all that is remembered. What has no mirror image in sight is drawn as
//! ever.

use core::cell::Cell;
use core::fmt;
use core::ops::Range;

use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::image::ImageDrawable;
use embedded_graphics_core::pixelcolor::Rgb888;
use embedded_graphics_core::primitives::Rectangle;

use super::image::Picture;
use super::ink::{Ink, inked};
use super::palette::Palette;
use crate::Error;
use crate::draw::clip::visible;
use crate::plane::{Field, Symmetric};

/// A [`Picture`] of a [`Symmetric`] field, half of it computed. [`Picture::mirrored`] makes it.
///
/// It is an [`ImageDrawable`] and shows the same pixels as its picture, in another order: from the last row
/// upwards, with one `fill_contiguous` a row. Dithering, which is not symmetric, follows the place of each
/// pixel.
///
/// Memory: the lent row of 3 bytes a pixel; beyond that 12 bytes on a 32-bit machine.
pub struct Mirrored<'a, F, P, C> {
    picture: &'a Picture<F, P, C>,
    row: Cell<&'a mut [Rgb888]>,
}

impl<F: Symmetric, P: Palette<F::Value>, C: Ink> Picture<F, P, C> {
    /// The same picture, where rows that are equal are computed once, with a row to keep one in.
    ///
    /// Exact where [`Symmetric::mirror_image`] says so: for the Mandelbrot set in a view whose rows come in
    /// conjugate pairs, such as [`View::home`](crate::escape::View::home) of any size. Elsewhere each row is
    /// computed as ever (`the_mirror_changes_no_pixel_and_computes_each_pair_once`).
    ///
    /// ```
    /// use attractor::draw::{CourseUnit, Picture};
    /// use attractor::escape::{Mandelbrot, View};
    /// use embedded_graphics::{image::Image, mock_display::MockDisplay, pixelcolor::Rgb888, prelude::*};
    ///
    /// let set = Mandelbrot::new(View::home(Size::new(24, 20))?, 100)?;
    /// let picture = Picture::<_, _, Rgb888>::new(set, CourseUnit);
    /// let mut row = [Rgb888::BLACK; 24];
    /// let (mut plain, mut mirrored) = (MockDisplay::new(), MockDisplay::new());
    /// Image::new(&picture, Point::zero()).draw(&mut plain).ok();
    /// Image::new(&picture.mirrored(&mut row)?, Point::zero()).draw(&mut mirrored).ok();
    /// mirrored.assert_eq(&plain);
    /// # Ok::<(), attractor::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BufferLength`] for a row shorter than the picture is wide.
    pub fn mirrored<'a>(&'a self, row: &'a mut [Rgb888]) -> Result<Mirrored<'a, F, P, C>, Error> {
        let needed = self.field().size().width as usize;
        if row.len() < needed {
            return Err(Error::BufferLength { what: "pixels of a row", given: row.len(), needed });
        }
        Ok(Mirrored { picture: self, row: Cell::new(row) })
    }
}

impl<F, P, C> fmt::Debug for Mirrored<'_, F, P, C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mirrored").finish_non_exhaustive()
    }
}

impl<F: Field, P, C> OriginDimensions for Mirrored<'_, F, P, C> {
    fn size(&self) -> Size {
        self.picture.field().size()
    }
}

impl<F: Symmetric, P: Palette<F::Value>, C: Ink> Mirrored<'_, F, P, C> {
    /// Computes row `y` in the columns `x` and draws it there and at `image`.
    fn fill_both<D: DrawTarget<Color = C>>(
        &self,
        target: &mut D,
        [y, image]: [u32; 2],
        x: &Range<u32>,
        origin: Point,
    ) -> Result<(), D::Error> {
        let row = self.row.take();
        let values = self.picture.field().row(y, x.clone());
        for (slot, value) in row.iter_mut().zip(values) {
            *slot = self.picture.palette().rgb(value);
        }
        let shown = row.get(..x.len()).unwrap_or_default();
        let palette = self.picture.palette();
        let fill = |target: &mut D, y: u32| {
            let corner = Point::new(x.start as i32, y as i32);
            let at = |i: i32| self.picture.dithered_at(Point::new(corner.x.wrapping_add(i), corner.y));
            let colors = (0_i32..).zip(shown).map(|(i, rgb)| inked(palette.is_dithered(), *rgb, at(i)));
            let corner = Point::new(corner.x.wrapping_sub(origin.x), corner.y.wrapping_sub(origin.y));
            target.fill_contiguous(&Rectangle::new(corner, Size::new(x.end - x.start, 1)), colors)
        };
        let drawn = fill(target, y).and_then(|()| fill(target, image));
        self.row.set(row);
        drawn
    }
}

impl<F: Symmetric, P: Palette<F::Value>, C: Ink> ImageDrawable for Mirrored<'_, F, P, C> {
    type Color = C;

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<(), D::Error> {
        self.draw_sub_image(target, &Rectangle::new(Point::zero(), self.size()))
    }

    /// What of `area` lies outside the picture stays as it is on the target.
    fn draw_sub_image<D>(&self, target: &mut D, area: &Rectangle) -> Result<(), D::Error>
    where
        D: DrawTarget<Color = C>,
    {
        let (columns, rows) = visible(self.size(), area, &target.bounding_box());
        if columns.is_empty() {
            return Ok(());
        }
        // the mirror images that have been drawn
        let mut drawn = 0..0;
        for y in rows.clone().rev() {
            if drawn.contains(&y) {
                continue;
            }
            let image = self.picture.field().mirror_image(y).filter(|image| rows.contains(image));
            match image {
                Some(image) if image < y && (drawn.is_empty() || image == drawn.end) => {
                    self.fill_both(target, [y, image], &columns, area.top_left)?;
                    drawn = if drawn.is_empty() { image } else { drawn.start }..image + 1;
                }
                _ => self.picture.fill_row(target, y, columns.clone(), area.top_left)?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::draw::testing::{Driver, Frame, Manner};
    use crate::draw::{CourseUnit, Grey};
    use crate::escape::{Dwell, Julia, Mandelbrot, View};
    use crate::num::Complex;
    use crate::num::Wide;
    use core::cell::Cell;
    use embedded_graphics::Drawable;
    use embedded_graphics::image::{Image, ImageDrawableExt};
    use embedded_graphics_core::pixelcolor::{BinaryColor, Rgb565, RgbColor};
    use std::vec::Vec;
    use std::{format, vec};

    /// Counts the rows that are computed.
    struct Watched<F>(F, Cell<u32>);

    impl<F: Field> Field for Watched<F> {
        type Value = F::Value;
        fn size(&self) -> Size {
            self.0.size()
        }
        fn at(&self, x: u32, y: u32) -> F::Value {
            self.0.at(x, y)
        }
        fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = F::Value> {
            self.1.set(self.1.get() + 1);
            self.0.row(y, x)
        }
    }

    impl<F: Symmetric> Symmetric for Watched<F> {
        fn mirror_image(&self, row: u32) -> Option<u32> {
            self.0.mirror_image(row)
        }
    }

    fn set(im: f64, size: Size) -> Mandelbrot {
        let centre = Complex::new(Wide::from_num(-0.7), Wide::from_num(im));
        Mandelbrot::new(View::new(centre, Wide::from_num(3), size).unwrap(), 60).unwrap()
    }

    /// Draws a part both ways and compares; how many rows were computed.
    fn compared<F: Symmetric, C: Ink + core::fmt::Debug>(
        field: F,
        palette: impl Palette<F::Value>,
        part: Rectangle,
        blank: C,
    ) -> u32 {
        let size = field.size();
        let picture = Picture::<_, _, C>::new(Watched(field, Cell::new(0)), palette)
            .with_dither_origin(Point::new(3, 1));
        let mut row = vec![Rgb888::BLACK; size.width as usize];
        let mut plain = Frame::<C>::new(size, blank);
        Image::new(&picture.sub_image(&part), Point::new(1, 2)).draw(&mut plain).unwrap();
        picture.field().1.set(0);
        let mirrored = picture.mirrored(&mut row).unwrap();
        let mut twice = Frame::<C>::new(size, blank);
        Image::new(&mirrored.sub_image(&part), Point::new(1, 2)).draw(&mut twice).unwrap();
        let all = Rectangle::new(Point::zero(), size);
        assert_eq!(twice.pixels(&all), plain.pixels(&all), "{size:?} {part:?}");
        assert_eq!(twice.drawn, plain.drawn);
        picture.field().1.get()
    }

    #[test]
    fn the_mirror_changes_no_pixel_and_computes_each_pair_once() {
        let white = |dwell: Dwell| {
            if dwell.count.is_multiple_of(3) { Rgb888::new(90, 90, 90) } else { Rgb888::WHITE }
        };
        for (w, h) in [(30, 24), (31, 25), (30, 1), (1, 30), (8, 2), (32, 3)] {
            let all = Rectangle::new(Point::zero(), Size::new(w, h));
            // the image is cut by two rows below and by a column on the right
            let seen = h.saturating_sub(2);
            let on = compared(set(0.0, all.size), CourseUnit, all, Rgb565::BLACK);
            let pairs = (0..seen).filter(|y| (0..*y).any(|image| image + y == h - 1)).count() as u32;
            assert_eq!(on, if w > 1 { seen - pairs } else { 0 }, "{w} {h}");
            compared(set(0.0, all.size), white, all, BinaryColor::Off);
            // rows in pairs about another row than the middle one, and in none
            compared(set(0.25, all.size), CourseUnit, all, Rgb565::BLACK);
            let off = compared(set(0.123, all.size), white, all, BinaryColor::Off);
            assert_eq!(off, if w > 1 { seen } else { 0 });
        }
        // parts: above the axis, across it, below it
        for (x, y, w, h) in [(0, 0, 30, 9), (3, 8, 20, 12), (5, 13, 9, 9), (-4, -4, 99, 99)] {
            let part = Rectangle::new(Point::new(x, y), Size::new(w, h));
            let rows = compared(set(0.0, Size::new(30, 24)), white, part, BinaryColor::Off);
            assert_eq!(rows, [9, 8, 9, 12][[0, 8, 13, -4].iter().position(|top| *top == y).unwrap()]);
        }
        let plane = View::new(Complex::default(), Wide::from_num(4), Size::new(20, 16)).unwrap();
        let julia = Julia::new(plane, Complex::new(Wide::from_num(-0.1), Wide::from_num(0.7)), 50).unwrap();
        compared(julia, white, Rectangle::new(Point::zero(), julia.size()), BinaryColor::Off);
    }

    #[test]
    fn each_row_is_drawn_once_from_below() {
        let picture = Picture::<_, _, Rgb565>::new(set(0.0, Size::new(16, 9)), CourseUnit);
        let mut row = [Rgb888::BLACK; 16];
        let mirrored = picture.mirrored(&mut row).unwrap();
        let screen = Rectangle::new(Point::zero(), Size::new(99, 99));
        let mut driver = Driver::<Rgb565>::new(screen, Manner::Strict);
        mirrored.draw(&mut driver).unwrap();
        let rows: Vec<_> = driver.calls.iter().map(|(area, _)| area.top_left.y).collect();
        assert_eq!(rows, [8, 0, 7, 1, 6, 2, 5, 3, 4]);
        // an error of the target is passed on, and the row is not lost
        driver.manner = Manner::FailAt(7);
        assert!(mirrored.draw(&mut driver).is_err());
        driver.manner = Manner::Strict;
        driver.calls.clear();
        mirrored.draw(&mut driver).unwrap();
        assert_eq!(driver.calls.len(), 9);
        for (area, colors) in &driver.calls {
            assert!(picture.colors(area.top_left.y as u32, 0..16).unwrap().eq(colors.iter().copied()));
        }
    }

    #[test]
    fn a_row_that_is_too_short_is_refused_with_the_length_it_needs() {
        let picture = Picture::<_, _, BinaryColor>::new(set(0.0, Size::new(16, 9)), Grey);
        let error = picture.mirrored(&mut [Rgb888::BLACK; 15]).unwrap_err();
        assert_eq!(error, Error::BufferLength { what: "pixels of a row", given: 15, needed: 16 });
        assert_eq!(format!("{error}"), "a buffer of 15 pixels of a row lent, 16 needed");
        assert!(picture.mirrored(&mut [Rgb888::BLACK; 17]).is_ok());
    }
}
