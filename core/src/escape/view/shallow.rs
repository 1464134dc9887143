//! A grid of square pixels in the complex plane: says which point each pixel of a picture shows.
//!
//! `c_ij = (P.x + (i + 1/2) W / cols) + i (P.y - (j + 1/2) W / cols)`, `P` the upper left corner: course unit
//! V, "The Mandelbrot set", eq. 5. With the centre `M` in place of the corner that is
//! `M.x + (2 i + 1 - cols) W / (2 cols)` and `M.y + (rows - 1 - 2 j) W / (2 cols)`.
//!
//! The quotient `W / (2 cols)` is kept whole: a 64-bit quotient and a remainder. A row steps by adding both,
//! as Bresenham's line does, so that no error accumulates; a point that is dyadic comes out exact.

use core::iter::FusedIterator;
use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use crate::Error;
use crate::escape::orbit::narrow::NARROWED;
use crate::escape::view::raster::Raster;
use crate::num::Complex;
use crate::num::Wide;
use crate::num::formats::Q48;

/// A rectangle of the complex plane and the square pixels that show it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::serial::ViewNumbers", into = "crate::serial::ViewNumbers")
)]
pub struct View {
    centre: Complex<Wide>,
    width: Wide,
    raster: Raster,
    /// Half a pitch, `W / (2 cols)`: quotient and remainder.
    half_pitch: Q48,
    rest: i32,
}

impl View {
    /// The rectangle around `centre` that is `width` wide; its height follows from the size: pixels are
    /// square.
    ///
    /// Domain: `width >= cols / 2^29`, that is a pitch of at least one unit of the 32-bit format; all four
    /// edges inside `-32768 .. 32768`. Pixels beyond the disc `|c| <= 2` are valid and have dwell 0.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] names the width, the side or the edge, and what is allowed.
    ///
    /// ```
    /// use attractor::num::Complex;
    /// use attractor::escape::View;
    /// use attractor::num::Wide;
    /// use embedded_graphics_core::geometry::Size;
    /// let centre = Complex::new(Wide::from_num(-0.5), Wide::ZERO);
    /// let view = View::new(centre, Wide::from_num(4), Size::new(8, 4))?;
    /// assert_eq!(view.point(0, 0), Complex::new(Wide::from_num(-2.25), Wide::from_num(0.75)));
    /// # Ok::<(), attractor::Error>(())
    /// ```
    pub fn new(centre: Complex<Wide>, width: Wide, size: Size) -> Result<Self, Error> {
        let raster = Raster::new(size)?;
        // at most 2^14 each
        let (cols, rows) = (i64::from(size.width), i64::from(size.height));
        let least = Wide::from_bits(cols << NARROWED);
        if width < least {
            let what = "width of the view";
            return Err(Error::OutOfRange { what, index: None, value: width, min: least, max: Wide::MAX });
        }
        let quotient = width.to_bits().checked_div(2 * cols).unwrap_or(0);
        let rest = width.to_bits().checked_rem(2 * cols).unwrap_or(0);
        // from the centre to an edge: cols or rows half pitches, rounded up; rest < 2^15
        let reach = |n: i64| quotient.checked_mul(n).and_then(|d| d.checked_add(((n * rest) >> 1) + 1));
        for (what, middle, n) in
            [("real part at an edge", centre.re, cols), ("imaginary part at an edge", centre.im, rows)]
        {
            let edge = reach(n).and_then(|d| middle.to_bits().checked_abs()?.checked_add(d));
            if edge.is_none() {
                let value = Wide::from_bits(
                    middle.to_bits().saturating_abs().saturating_add(reach(n).unwrap_or(i64::MAX)),
                );
                return Err(Error::OutOfRange { what, index: None, value, min: Wide::MIN, max: Wide::MAX });
            }
        }
        Ok(Self { centre, width, raster, half_pitch: quotient, rest: rest as i32 })
    }

    /// The whole Mandelbrot set: centre `-3/4`, at least 3 wide and 5/2 high, as large as it fits.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a size that [`checked_size`](crate::plane::checked_size) refuses.
    pub fn home(size: Size) -> Result<Self, Error> {
        const CENTRE: Wide = Wide::lit("-0.75");
        const WIDTH: i64 = Wide::lit("3").to_bits();
        const HEIGHT: i64 = Wide::lit("2.5").to_bits();
        let size = Raster::new(size)?.size();
        // 2.5 cols / rows may exceed the format for a very flat display
        let scaled = (HEIGHT >> 16).saturating_mul(i64::from(size.width)); // below 2^34 2^14
        let fitting = scaled.checked_div(i64::from(size.height)).unwrap_or(0).saturating_mul(1 << 16);
        Self::new(Complex::new(CENTRE, Wide::ZERO), Wide::from_bits(fitting.max(WIDTH)), size)
    }

    /// The point that was in the middle when the view was made.
    pub const fn centre(&self) -> Complex<Wide> {
        self.centre
    }

    /// The width of the rectangle.
    pub const fn width(&self) -> Wide {
        self.width
    }

    /// Width and height in pixels.
    pub const fn size(&self) -> Size {
        self.raster.size()
    }

    /// By how many pixels it was panned since it was made, to the right and up.
    pub const fn panned(&self) -> (i32, i32) {
        self.raster.panned()
    }

    /// The same grid seen through a window that is moved by whole pixels, to the right and up: pixels that
    /// both show are the same points, bit for bit.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] when an edge leaves `-32768 .. 32768`, or after more than
    /// [`MAX_PAN`](crate::escape::MAX_PAN) pixels in one direction.
    pub fn pan(&self, right: i32, up: i32) -> Result<Self, Error> {
        let raster = self.raster.pan(right, up)?;
        let [across, high] = raster.reach();
        for (what, middle, half_pitches) in [
            ("real part at an edge", self.centre.re, across),
            ("imaginary part at an edge", self.centre.im, high),
        ] {
            // at most 2^14 + 2^16 half pitches of at most 2^63 units
            let half_pitches = i128::from(half_pitches) + 1;
            let reach = i128::from(middle.to_bits().unsigned_abs())
                + half_pitches * (i128::from(self.half_pitch) + 1);
            if reach > i128::from(i64::MAX) {
                return Err(Error::OutOfRange {
                    what,
                    index: None,
                    value: Wide::MAX,
                    min: Wide::MIN,
                    max: Wide::MAX,
                });
            }
        }
        Ok(Self { raster, ..*self })
    }

    /// The distance of two neighbouring pixels, rounded down.
    pub const fn pitch(&self) -> Wide {
        Wide::from_bits(self.whole_pitch().0)
    }

    /// The exponent of 2 just below the pitch: `2^e <= pitch < 2^(e + 1)`.
    pub fn pitch_exponent(&self) -> i32 {
        // a pitch has at least 2^19 units of 2^-48
        self.pitch().to_bits().checked_ilog2().unwrap_or(0) as i32 - Wide::FRAC_NBITS as i32
    }

    /// `W / cols` as quotient and remainder over `2 cols`.
    const fn whole_pitch(&self) -> (Q48, i32) {
        let (pitch, rest) = (self.half_pitch << 1, self.rest << 1);
        if rest >= self.divisor() { (pitch + 1, rest - self.divisor()) } else { (pitch, rest) }
    }

    /// The middle of pixel `(column, row)`, `(0, 0)` at the upper left.
    ///
    /// Domain: inside [`View::size`]; others count as the nearest pixel. Error: exact if the point is a
    /// multiple of `2^-48`, else below `2^-48`
    /// (`the_grid_is_exact_where_it_can_be_and_rounded_once_elsewhere`).
    pub fn point(&self, column: u32, row: u32) -> Complex<Wide> {
        let (re, rest) = self.abscissa(column.min(self.raster.size().width - 1));
        Complex::new(sticky(re, rest), self.ordinate(row))
    }

    fn ordinate(&self, row: u32) -> Wide {
        let (im, rest) = self.offset(self.raster.up(row.min(self.raster.size().height - 1)));
        sticky(self.centre.im.to_bits().wrapping_add(im), rest)
    }

    fn abscissa(&self, column: u32) -> (Q48, i32) {
        let (re, rest) = self.offset(self.raster.across(column.min(self.raster.size().width)));
        (self.centre.re.to_bits().wrapping_add(re), rest)
    }

    /// `n` half pitches as a quotient, rounded down, and a remainder over `2 cols`. |n| <= 2^22.
    fn offset(&self, n: i32) -> (Q48, i32) {
        let divisor = i64::from(self.divisor());
        let rest = i64::from(n) * i64::from(self.rest); // below 2^37
        let whole = rest.checked_div_euclid(divisor).unwrap_or(0);
        let rest = rest.checked_rem_euclid(divisor).unwrap_or(0);
        // edges were checked, one pixel beyond may wrap and is never used
        (self.half_pitch.wrapping_mul(i64::from(n)).wrapping_add(whole), rest as i32)
    }

    const fn divisor(&self) -> i32 {
        2 * self.raster.size().width as i32
    }

    /// The row above this one at the conjugate points, if the view has it.
    pub(crate) fn mirror_image(&self, row: u32) -> Option<u32> {
        let ordinate = |row: u32| self.ordinate(row).to_bits();
        // rows are equally spaced: the sum of the indices is the same for all pairs
        let (first, last) = (ordinate(0), ordinate(self.raster.size().height - 1));
        let pitch = self.pitch().to_bits();
        if last >= 0 || first <= 0 || ordinate(row) >= 0 {
            return None;
        }
        // (first - -y) / pitch, to nearest
        let steps = (first.wrapping_add(ordinate(row)) + pitch / 2).checked_div_euclid(pitch)?;
        let image = u32::try_from(steps).ok()?;
        (image < self.raster.size().height && ordinate(image) == -ordinate(row)).then_some(image)
    }

    /// The points of a row from left to right.
    pub(crate) fn line(&self, row: u32, columns: Range<u32>) -> RowPoints {
        let (pitch, pitch_rest) = self.whole_pitch();
        let mut line = RowPoints {
            view: *self,
            im: self.ordinate(row),
            next: columns.start.min(self.raster.size().width),
            end: columns.end.min(self.raster.size().width),
            re: 0,
            rest: 0,
            pitch,
            pitch_rest,
            divisor: self.divisor(),
        };
        line.seek();
        line
    }
}

/// Round to odd: the last bit is set when something was cut off, so that a later rounding to fewer bits is as
/// good as the only one.
#[inline(always)]
fn sticky(floor: Q48, rest: i32) -> Wide {
    Wide::from_bits(floor | i64::from(rest != 0))
}

/// The points of a part of a row, from left to right.
#[derive(Debug, Clone)]
pub(crate) struct RowPoints {
    view: View,
    im: Wide,
    next: u32,
    end: u32,
    /// The abscissa of `next`: quotient and remainder.
    re: Q48,
    rest: i32,
    /// What a pixel adds, and when the remainder carries.
    pitch: Q48,
    pitch_rest: i32,
    divisor: i32,
}

impl RowPoints {
    fn seek(&mut self) {
        (self.re, self.rest) = self.view.abscissa(self.next);
    }
}

impl Iterator for RowPoints {
    type Item = Complex<Wide>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        if self.next >= self.end {
            return None;
        }
        let point = Complex::new(sticky(self.re, self.rest), self.im);
        self.next += 1;
        self.re = self.re.wrapping_add(self.pitch);
        self.rest += self.pitch_rest;
        if self.rest >= self.divisor {
            self.rest -= self.divisor;
            self.re = self.re.wrapping_add(1);
        }
        Some(point)
    }

    #[inline]
    fn nth(&mut self, n: usize) -> Option<Self::Item> {
        if n > 0 {
            let left = self.end.saturating_sub(self.next);
            self.next += u32::try_from(n).unwrap_or(u32::MAX).min(left);
            self.seek();
        }
        self.next()
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = self.end.saturating_sub(self.next) as usize;
        (left, Some(left))
    }
}

impl ExactSizeIterator for RowPoints {}
impl FusedIterator for RowPoints {}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::vec::Vec;

    fn bits(c: Complex<Wide>) -> (i128, i128) {
        (i128::from(c.re.to_bits()), i128::from(c.im.to_bits()))
    }

    #[test]
    fn the_grid_is_exact_where_it_can_be_and_rounded_once_elsewhere() {
        let centre = Complex::new(Wide::from_num(-0.75), Wide::from_bits(12_345_678_901));
        let mut inexact = 0;
        for (width, cols, rows) in [
            (3_i64 << 48, 240_u32, 240_u32),
            (4 << 48, 256, 100),
            (1 << 48, 1000, 1),
            (7 << 48, 16384, 3),
            (12_345_678_901_234, 333, 777),
            (500 << 48, 3, 77),
        ] {
            let view = View::new(centre, Wide::from_bits(width), Size::new(cols, rows)).unwrap();
            let divisor = i128::from(2 * cols);
            let (mx, my) = bits(centre);
            for row in [0, rows / 2, rows - 1] {
                let line: Vec<_> = view.line(row, 0..cols).collect();
                assert_eq!(line.len(), cols as usize);
                for (column, point) in line.into_iter().enumerate() {
                    assert_eq!(point, view.point(column as u32, row), "stepping and direct access");
                    let exact = [
                        mx * divisor + i128::from(width) * (2 * column as i128 + 1 - i128::from(cols)),
                        my * divisor + i128::from(width) * i128::from(rows as i64 - 1 - 2 * row as i64),
                    ];
                    for (exact, got) in exact.into_iter().zip([bits(point).0, bits(point).1]) {
                        let error = (exact - got * divisor).abs();
                        assert!(error < divisor);
                        assert!(error == 0 || (exact % divisor != 0 && got & 1 == 1));
                        inexact += u32::from(error > 0);
                    }
                }
            }
        }
        assert!(inexact > 1000);
    }

    #[test]
    fn skipping_arrives_at_the_same_points() {
        let view = View::home(Size::new(241, 3)).unwrap();
        let all: Vec<_> = view.line(1, 0..241).collect();
        for n in [0, 1, 2, 100, 239, 240, 241, 500, usize::MAX] {
            let mut line = view.line(1, 0..241);
            assert_eq!(line.nth(n), all.get(n).copied());
            assert_eq!(line.next(), n.checked_add(1).and_then(|n| all.get(n).copied()));
            let mut line = view.line(1, 7..200);
            assert_eq!(line.len(), 193);
            assert_eq!(line.nth(n), all[7..200].get(n).copied());
        }
        assert_eq!(view.line(1, 300..400).count() + view.line(1, 9..9).count(), 0);
    }

    #[test]
    fn a_view_that_a_format_cannot_hold_is_refused() {
        let size = Size::new(200, 100);
        let least = Wide::from_bits(200 << 19);
        assert!(View::new(Complex::default(), least, size).is_ok());
        for width in [least - Wide::DELTA, Wide::ZERO, Wide::MIN] {
            assert!(matches!(
                View::new(Complex::default(), width, size),
                Err(Error::OutOfRange { what: "width of the view", value, min, .. }) if value == width && min == least
            ));
        }
        let corner = Complex::new(Wide::MAX, Wide::ZERO);
        assert!(View::new(corner, Wide::ONE, size).is_err());
        assert!(View::new(Complex::new(Wide::ZERO, Wide::MIN), Wide::ONE, size).is_err());
        assert!(View::new(Complex::default(), Wide::MAX, Size::new(1, 16384)).is_err());
        assert!(View::new(Complex::default(), Wide::from_num(32000), size).is_ok());
        assert!(View::new(Complex::default(), Wide::ONE, Size::new(0, 1)).is_err());
    }

    #[test]
    fn home_shows_the_whole_set_on_any_display() {
        for (w, h) in [(128, 64), (240, 240), (320, 240), (64, 128), (1, 16384), (1000, 3)] {
            let view = View::home(Size::new(w, h)).unwrap();
            let width: f64 = view.width().to_num();
            let height = width * f64::from(h) / f64::from(w);
            assert!(width >= 3.0 && height >= 2.499, "{width} {height}");
            assert!(width < 3.0001 || height < 2.5001, "{width} {height}");
        }
    }
}
