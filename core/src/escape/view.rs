//! A grid of square pixels in the complex plane.
//!
//! `c_ij = (P.x + (i + 1/2) W / cols) + i (P.y - (j + 1/2) W / cols)`, `P` the upper left corner: course unit V, "The Mandelbrot set", eq. 5. With the
//! centre `M` in place of the corner that is `M.x + (2 i + 1 - cols) W / (2 cols)` and `M.y + (rows - 1 - 2 j) W / (2 cols)`.
//!
//! The quotient `W / (2 cols)` is kept whole: a 64-bit quotient and a remainder. A row steps by adding both, as Bresenham's line does, so
//! that no error accumulates; a point that is dyadic comes out exact.

use core::iter::FusedIterator;
use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use super::Complex;
use super::dwell::{FRACTION, Word, is_beyond};
use crate::Error;
use crate::num::{Wide, mul_high_u};
use crate::picture::checked_size;

/// Fractional bits that a point loses when it becomes a [`Word`].
const NARROWED: u32 = Wide::FRAC_NBITS - FRACTION;

/// A rectangle of the complex plane and the square pixels that show it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct View {
    centre: Complex<Wide>,
    width: Wide,
    size: Size,
    /// Half a pitch, `W / (2 cols)`: quotient in units of `2^-48`, and remainder.
    half_pitch: i64,
    rest: i32,
}

impl View {
    /// The rectangle around `centre` that is `width` wide; its height follows from the size: pixels are square.
    ///
    /// Domain: `width >= cols / 2^29`, that is a pitch of at least one unit of the 32-bit format; all four edges inside
    /// `-32768 .. 32768`. Pixels beyond the disc `|c| <= 2` are valid and have dwell 0.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] names the width, the side or the edge, and what is allowed.
    ///
    /// ```
    /// use attractor::escape::{Complex, View};
    /// use attractor::num::Wide;
    /// use embedded_graphics_core::geometry::Size;
    /// let centre = Complex::new(Wide::from_num(-0.5), Wide::ZERO);
    /// let view = View::new(centre, Wide::from_num(4), Size::new(8, 4))?;
    /// assert_eq!(view.point(0, 0), Complex::new(Wide::from_num(-2.25), Wide::from_num(0.75)));
    /// # Ok::<(), attractor::Error>(())
    /// ```
    pub fn new(centre: Complex<Wide>, width: Wide, size: Size) -> Result<Self, Error> {
        let size = checked_size(size)?;
        // at most 2^14 each
        let (cols, rows) = (i64::from(size.width), i64::from(size.height));
        let least = Wide::from_bits(cols << NARROWED);
        if width < least {
            let what = "width of the view";
            return Err(Error::OutOfRange { what, index: 0, value: width, min: least, max: Wide::MAX });
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
                return Err(Error::OutOfRange { what, index: 0, value, min: Wide::MIN, max: Wide::MAX });
            }
        }
        Ok(Self { centre, width, size, half_pitch: quotient, rest: rest as i32 })
    }

    /// The whole Mandelbrot set: centre `-3/4`, at least 3 wide and 5/2 high, as large as it fits.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a size that [`checked_size`] refuses.
    pub fn home(size: Size) -> Result<Self, Error> {
        const CENTRE: Wide = Wide::lit("-0.75");
        const WIDTH: i64 = Wide::lit("3").to_bits();
        const HEIGHT: i64 = Wide::lit("2.5").to_bits();
        let size = checked_size(size)?;
        // 2.5 cols / rows may exceed the format for a very flat display
        let scaled = (HEIGHT >> 16).saturating_mul(i64::from(size.width)); // below 2^34 2^14
        let fitting = scaled.checked_div(i64::from(size.height)).unwrap_or(0).saturating_mul(1 << 16);
        Self::new(Complex::new(CENTRE, Wide::ZERO), Wide::from_bits(fitting.max(WIDTH)), size)
    }

    /// The point in the middle.
    pub const fn centre(&self) -> Complex<Wide> {
        self.centre
    }

    /// The width of the rectangle.
    pub const fn width(&self) -> Wide {
        self.width
    }

    /// Width and height in pixels.
    pub const fn size(&self) -> Size {
        self.size
    }

    /// The distance of two neighbouring pixels, rounded down.
    pub const fn pitch(&self) -> Wide {
        // the remainder of W / (2 cols) is worth another unit of W / cols when it is at least half
        let carry = self.rest as i64 >= self.size.width as i64;
        Wide::from_bits((self.half_pitch << 1) + carry as i64)
    }

    /// The middle of pixel `(column, row)`, `(0, 0)` at the upper left.
    ///
    /// Domain: inside [`View::size`]; others count as the nearest pixel. Error: exact if the point is a multiple of `2^-48`, else below `2^-48`
    /// (`the_grid_is_exact_where_it_can_be_and_rounded_once_elsewhere`).
    pub fn point(&self, column: u32, row: u32) -> Complex<Wide> {
        let (re, rest) = self.abscissa(column.min(self.size.width - 1));
        Complex::new(sticky(re, rest), self.ordinate(row))
    }

    fn ordinate(&self, row: u32) -> Wide {
        let row = row.min(self.size.height - 1);
        let (im, rest) = self.offset(self.size.height as i32 - 1 - 2 * row as i32);
        sticky(self.centre.im.to_bits().wrapping_add(im), rest)
    }

    fn abscissa(&self, column: u32) -> (i64, i32) {
        let column = column.min(self.size.width);
        let (re, rest) = self.offset(2 * column as i32 + 1 - self.size.width as i32);
        (self.centre.re.to_bits().wrapping_add(re), rest)
    }

    /// `n` half pitches as a quotient, rounded down, and a remainder over `2 cols`. |n| <= 2^14 + 1.
    fn offset(&self, n: i32) -> (i64, i32) {
        let divisor = self.divisor();
        let rest = n * self.rest; // below 2^30
        let whole = rest.checked_div_euclid(divisor).unwrap_or(0);
        let rest = rest.checked_rem_euclid(divisor).unwrap_or(0);
        // edges were checked, one pixel beyond may wrap and is never used
        (self.half_pitch.wrapping_mul(i64::from(n)).wrapping_add(i64::from(whole)), rest)
    }

    const fn divisor(&self) -> i32 {
        2 * self.size.width as i32
    }

    /// The points of a row from left to right.
    pub(super) fn line(&self, row: u32, columns: Range<u32>) -> Line {
        let mut line = Line {
            view: *self,
            im: self.ordinate(row),
            next: columns.start.min(self.size.width),
            end: columns.end.min(self.size.width),
            re: 0,
            rest: 0,
        };
        line.seek();
        line
    }
}

/// Round to odd: the last bit is set when something was cut off, so that a later rounding to fewer bits is as good as the only one.
#[inline(always)]
fn sticky(floor: i64, rest: i32) -> Wide {
    Wide::from_bits(floor | i64::from(rest != 0))
}

/// The points of a part of a row.
#[derive(Debug, Clone)]
pub(super) struct Line {
    view: View,
    im: Wide,
    next: u32,
    end: u32,
    /// The abscissa of `next`: quotient and remainder.
    re: i64,
    rest: i32,
}

impl Line {
    fn seek(&mut self) {
        (self.re, self.rest) = self.view.abscissa(self.next);
    }
}

impl Iterator for Line {
    type Item = Complex<Wide>;

    #[inline]
    fn next(&mut self) -> Option<Self::Item> {
        if self.next >= self.end {
            return None;
        }
        let point = Complex::new(sticky(self.re, self.rest), self.im);
        self.next += 1;
        self.re = self.re.wrapping_add(self.view.half_pitch << 1);
        // 2 rest < 2 divisor: the sum needs at most two carries
        self.rest += 2 * self.view.rest;
        for _ in 0..2 {
            if self.rest >= self.view.divisor() {
                self.rest -= self.view.divisor();
                self.re = self.re.wrapping_add(1);
            }
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

impl ExactSizeIterator for Line {}
impl FusedIterator for Line {}

/// The nearest stored point, none beyond the disc `|c| <= 2`.
///
/// Whether `c` is beyond is decided exactly, on all 48 bits; a point of the disc stays in the disc.
/// Error: half a unit, `2^-30`, ties away from 0; at most one unit within `2^-24` of the circle.
#[inline(always)]
pub(super) fn narrow(c: Complex<Wide>) -> Option<Word> {
    let (x, y) = (c.re.to_bits(), c.im.to_bits());
    // beyond 2 + 2^-16 (an immediate on Cortex-M); what is left fits
    let far = |v: i64| ((v >> 32) as i32).wrapping_add(2 << 16) as u32 > 4 << 16;
    if far(x) || far(y) {
        return None;
    }
    let nearest = |v: i64| ((v + (1 << (NARROWED - 1)) - i64::from(v < 0)) >> NARROWED) as i32;
    let word = (nearest(x), nearest(y));
    // Rounding moves |c|^2 by less than 2^-27, the high words lose less than 2^-25.
    let square = high_square(word.0) + high_square(word.1);
    if square < (1 << 28) - 4 {
        return Some(word);
    }
    if square > (1 << 28) + 4 { None } else { narrow_at_the_circle(x, y, word) }
}

#[inline(always)]
fn high_square(v: i32) -> u32 {
    super::dwell::high(v, v) as u32
}

#[cold]
fn narrow_at_the_circle(x: i64, y: i64, word: Word) -> Option<Word> {
    // |v| < 2^49 + 2^33, times 2^13: below 2^63; the squares, 122 fractional bits, are added in two words
    let halves = |v: i64| {
        let v = v.unsigned_abs() << 13;
        (mul_high_u(v, v), v.wrapping_mul(v))
    };
    let ((x_high, x_low), (y_high, y_low)) = (halves(x), halves(y));
    let (low, carry) = x_low.overflowing_add(y_low);
    let high = x_high + y_high + u64::from(carry);
    // 4 with 122 - 64 fractional bits
    if high > 1 << 60 || (high == 1 << 60 && low > 0) {
        return None;
    }
    let towards_zero = |v: i64| {
        let magnitude = (v.unsigned_abs() >> NARROWED) as i32;
        if v < 0 { -magnitude } else { magnitude }
    };
    if is_beyond(word) { Some((towards_zero(x), towards_zero(y))) } else { Some(word) }
}
