//! A whole picture in a lent buffer of 16 bits a pixel: half of a symmetric one is copied, and what stays in
//! sight while panning is moved.
//!
//! For a program that lets its user move about, on a device with the memory: a pan by one pixel computes one
//! column or row.
//!
//! Conjugate points have conjugate orbits and the same dwell: rows at `y` and `-y` are equal. A view that is
//! panned by whole pixels shows the same points ([`View::pan`](crate::escape::View::pan),
//! [`DeepView::pan`](crate::escape::DeepView::pan)), so that neither the mirror nor panning changes a pixel.

use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use crate::Error;
use crate::escape::set::escape_time::{EscapeTime, Pan};
use crate::escape::value::Dwell;
use crate::plane::{Field, along, checked_size};

/// An escape-time picture, computed, in a lent buffer of 16 bits a pixel.
///
/// ```
/// use attractor::escape::{Buffered, Mandelbrot, View};
/// use embedded_graphics_core::geometry::Size;
/// let mut counts = [0; Buffered::<Mandelbrot>::counts(Size::new(24, 20))];
/// let mut buffered = Buffered::new(Mandelbrot::new(View::home(Size::new(24, 20))?, 100)?, &mut counts)?;
/// assert_eq!(buffered.computed(), 24 * 10);
/// buffered.pan(3, 0)?;
/// assert_eq!(buffered.computed(), 3 * 20);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug)]
pub struct Buffered<'a, P> {
    picture: P,
    counts: &'a mut [u16],
    computed: usize,
}

impl<P> Buffered<'_, P> {
    /// How many counts a picture takes: the length of the memory to lend.
    pub const fn counts(size: Size) -> usize {
        (size.width as usize).saturating_mul(size.height as usize)
    }
}

impl<'a, P: EscapeTime> Buffered<'a, P> {
    /// Computes the whole picture.
    ///
    /// # Errors
    /// [`Error::BufferLength`] if `counts` is shorter than [`Buffered::counts`], [`Error::Capacity`] for more
    /// than 65535 iterations, [`Error::OutOfRange`] for a size that [`checked_size`] refuses.
    pub fn new(picture: P, counts: &'a mut [u16]) -> Result<Self, Error> {
        let size = checked_size(picture.size())?;
        let (what, given, needed) = ("counts", counts.len(), Self::counts(size));
        let counts = counts.get_mut(..needed).ok_or(Error::BufferLength { what, given, needed })?;
        let (most, max) = (usize::from(u16::MAX), picture.max_dwell() as usize);
        if max > most {
            let what = "iterations in 16 bits";
            return Err(Error::Capacity { what, needed: max, capacity: most });
        }
        let mut buffered = Self { picture, counts, computed: 0 };
        buffered.compute(0..size.height);
        Ok(buffered)
    }

    /// The picture.
    pub const fn picture(&self) -> &P {
        &self.picture
    }

    /// How many pixels the last change computed; the others were copied.
    pub const fn computed(&self) -> usize {
        self.computed
    }

    /// Computes whole rows, or copies them from their mirror images, which come before them.
    fn compute(&mut self, rows: Range<u32>) {
        let size = self.picture.size();
        let (width, all) = (size.width as usize, 0..size.width);
        for y in rows.clone() {
            match self.picture.mirror_image(y) {
                // an upper row that has been computed already, or was kept
                Some(image) if image < y && rows.contains(&image) => {
                    self.shift(image as usize * width, y as usize * width, width);
                }
                _ => self.compute_row(y, all.clone()),
            }
        }
    }

    /// Moves `length` counts; the ranges may overlap.
    fn shift(&mut self, from: usize, to: usize, length: usize) {
        for k in 0..length {
            let k = if to <= from { k } else { length - 1 - k };
            let count = self.counts.get(from + k).copied().unwrap_or(0);
            if let Some(slot) = self.counts.get_mut(to + k) {
                *slot = count;
            }
        }
    }

    fn compute_row(&mut self, y: u32, columns: Range<u32>) {
        let start = y as usize * self.picture.size().width as usize + columns.start as usize;
        let slots = self.counts.get_mut(start..start + columns.len()).unwrap_or(&mut []);
        self.computed += slots.len();
        for (slot, dwell) in slots.iter_mut().zip(self.picture.row(y, columns)) {
            *slot = dwell.count as u16;
        }
    }
}

impl<P: EscapeTime + Pan> Buffered<'_, P> {
    /// Moves the view by whole pixels, to the right and up, and computes what comes into sight.
    ///
    /// # Errors
    /// As [`View::pan`](crate::escape::View::pan); the picture is then unchanged.
    pub fn pan(&mut self, right: i32, up: i32) -> Result<(), Error> {
        self.picture.pan(right, up)?;
        self.computed = 0;
        let size = self.picture.size();
        let (width, height) = (size.width as usize, size.height as usize);
        let (across, down) = (right.unsigned_abs() as usize, up.unsigned_abs() as usize);
        if across >= width || down >= height {
            self.compute(0..size.height);
            return Ok(());
        }
        // the picture moves the other way; within the buffer both shifts are one
        let kept = (height - down) * width;
        let (from, to) = if up >= 0 { (0, down * width) } else { (down * width, 0) };
        self.shift(from, to, kept);
        let exposed = if up >= 0 { 0..down as u32 } else { (height - down) as u32..size.height };
        for row in self.counts.chunks_exact_mut(width.max(1)) {
            let across = across.min(row.len());
            if right >= 0 { row.rotate_left(across) } else { row.rotate_right(across) }
        }
        let columns = if right >= 0 { size.width - across as u32..size.width } else { 0..across as u32 };
        for y in (0..size.height).filter(|y| !exposed.contains(y)) {
            self.compute_row(y, columns.clone());
        }
        self.compute(exposed);
        Ok(())
    }
}

impl<P: EscapeTime> Buffered<'_, P> {
    fn dwell(&self, count: u16) -> Dwell {
        Dwell { count: u32::from(count), max: self.picture.max_dwell() }
    }
}

impl<P: EscapeTime> Field for Buffered<'_, P> {
    type Value = Dwell;

    fn size(&self) -> Size {
        self.picture.size()
    }

    fn at(&self, x: u32, y: u32) -> Dwell {
        let index = y.wrapping_mul(self.picture.size().width).wrapping_add(x) as usize;
        self.dwell(self.counts.get(index).copied().unwrap_or(0))
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Dwell> {
        let Size { width, height } = self.picture.size();
        // what lies outside the picture has no pixels; inside, an index is at most 2^28
        let (y, end) = if y < height { (y, x.end.min(width)) } else { (0, 0) };
        let range = (y * width + x.start.min(end)) as usize..(y * width + end) as usize;
        along(self.counts.get(range).unwrap_or(&[]).iter(), |count| self.dwell(*count))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::escape::{Julia, Mandelbrot, View};
    use crate::num::Complex;
    use crate::num::Wide;
    use std::vec;

    fn assert_is_plain<P: EscapeTime + Copy>(buffered: &Buffered<'_, P>) {
        let size = buffered.size();
        for y in 0..size.height {
            assert!(buffered.row(y, 0..size.width).eq(buffered.picture().row(y, 0..size.width)), "row {y}");
        }
    }

    #[test]
    fn the_mirror_changes_no_pixel_and_halves_the_work() {
        for (w, h, im) in [(60, 50, 0.0), (61, 51, 0.0), (64, 48, 0.28125), (64, 48, 0.1), (60, 50, 3.0)] {
            let centre = Complex::new(Wide::from_num(-0.7), Wide::from_num(im));
            let view = View::new(centre, Wide::from_num(3), Size::new(w, h)).unwrap();
            let mut counts = vec![0; (w * h) as usize];
            let buffered = Buffered::new(Mandelbrot::new(view, 200).unwrap(), &mut counts).unwrap();
            assert_is_plain(&buffered);
            if im == 0.0 {
                assert_eq!(buffered.computed(), (w * h.div_ceil(2)) as usize);
            } else if im == 0.28125 {
                assert!(buffered.computed() < (w * h) as usize * 3 / 4);
            }
        }
    }

    #[test]
    fn panning_changes_no_pixel_and_computes_what_comes_into_sight() {
        let centre = Complex::new(Wide::from_num(-0.7), Wide::from_num(0.3));
        let view = View::new(centre, Wide::from_num(1.1), Size::new(50, 40)).unwrap();
        let mut counts = vec![0; 2000];
        let mut buffered = Buffered::new(Mandelbrot::new(view, 100).unwrap(), &mut counts).unwrap();
        for (right, up) in
            [(1, 0), (0, 1), (-3, 5), (7, -9), (0, -1), (49, 39), (0, 0), (50, 1), (-200, 3), (190, -40)]
        {
            buffered.pan(right, up).unwrap();
            assert_is_plain(&buffered);
            let (across, down) = (right.unsigned_abs().min(50) as usize, up.unsigned_abs().min(40) as usize);
            assert!(buffered.computed() <= 2000 - (50 - across) * (40 - down));
        }
        assert!(buffered.pan(1 << 20, 0).is_err() && buffered.pan(i32::MIN, i32::MAX).is_err());
        assert_is_plain(&buffered);
        let home = View::new(Complex::default(), Wide::from_num(4), Size::new(50, 40)).unwrap();
        let julia = Julia::new(home, Complex::new(Wide::from_num(-0.1), Wide::from_num(0.7)), 99).unwrap();
        let mut buffered = Buffered::new(julia, &mut counts).unwrap();
        buffered.pan(-5, 4).unwrap();
        assert_is_plain(&buffered);
    }

    #[test]
    fn a_buffer_of_another_length_names_the_right_one() {
        let picture = Mandelbrot::new(View::home(Size::new(9, 7)).unwrap(), 70_000).unwrap();
        let error = Buffered::new(picture, &mut [0; 62]).err();
        assert_eq!(error, Some(Error::BufferLength { what: "counts", given: 62, needed: 63 }));
        assert!(matches!(Buffered::new(picture, &mut [0; 63]), Err(Error::Capacity { needed: 70_000, .. })));
    }

    #[test]
    fn there_is_nothing_beyond_the_picture() {
        let view = View::home(Size::new(9, 7)).unwrap();
        let mut counts = [0; 63];
        let canvas = Buffered::new(Mandelbrot::new(view, 50).unwrap(), &mut counts).unwrap();
        for (y, x, expected) in
            [(7, 0..9, 0), (u32::MAX, 0..9, 0), (2, 7..u32::MAX, 2), (6, 9..12, 0), (0, 0..9, 9)]
        {
            assert_eq!(canvas.row(y, x.clone()).count(), expected, "{y}, {x:?}");
        }
    }
}
