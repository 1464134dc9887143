//! A grid of square pixels in the complex plane, as fine as its coordinates have limbs: the view of a deep
//! zoom.
//!
//! As [`View`](crate::escape::View), eq. 5 of course unit V around the centre:
//! `M.x + (2 i + 1 - cols) W / (2 cols)`, `M.y + (rows - 1 - 2 j) W / (2 cols)`, with quotient and remainder
//! of `W / (2 cols)` kept apart. The coordinates come as decimal strings.

use embedded_graphics_core::geometry::Size;

use crate::Error;
use crate::escape::orbit::block_float::{BlockFloat, Number};
use crate::escape::view::raster::Raster;
use crate::escape::view::shallow::View;
use crate::num::Complex;
use crate::num::{Limbs, Wide};

const FOUR: Wide = Wide::lit("4");

/// Bits that a pixel must have behind it: rounding a corner of a pixel then shows nowhere.
const GUARD: u32 = 8;

/// A rectangle of the complex plane and the square pixels that show it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(
        try_from = "crate::serial::DeepViewNumbers<LIMBS>",
        into = "crate::serial::DeepViewNumbers<LIMBS>"
    )
)]
pub struct DeepView<const LIMBS: usize> {
    centre: Complex<Limbs<LIMBS>>,
    width: Limbs<LIMBS>,
    raster: Raster,
    /// `W / (2 cols)`: quotient and remainder.
    half_pitch: Limbs<LIMBS>,
    rest: u32,
    /// The same as a real block. Error: below `2^-49` of it (`the_grid_is_that_of_the_narrow_view`).
    half_pitch_block: BlockFloat<i64>,
}

impl<const LIMBS: usize> DeepView<LIMBS> {
    /// The rectangle around `centre` that is `width` wide; its height follows from the size.
    ///
    /// Domain: width and height above 0 and below 4, the centre within 4 of 0 in each part, 8 bits behind the
    /// pitch.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] names the width, the height, the part of the centre or the side of the picture;
    /// [`Error::Capacity`] says how many limbs a width as small as this takes.
    pub fn new(centre: Complex<Limbs<LIMBS>>, width: Limbs<LIMBS>, size: Size) -> Result<Self, Error> {
        let raster = Raster::new(size)?;
        let out = |what, value, min| Err(Error::OutOfRange { what, index: None, value, min, max: FOUR });
        let wide = width.to_wide();
        let highest = match width.highest_bit() {
            Some(bit) if !width.is_negative() => bit,
            _ => return out("width of the view", wide, Wide::DELTA),
        };
        if wide >= FOUR {
            return out("width of the view", wide, Wide::DELTA);
        }
        // below 2^51 2^14, shifted down first
        let height =
            ((wide.to_bits() >> 16) * i64::from(size.height)).checked_div(i64::from(size.width)).unwrap_or(0);
        if height >= FOUR.to_bits() >> 16 {
            let height = Wide::from_bits(height.saturating_mul(1 << 16));
            return out("height of the view", height, Wide::DELTA);
        }
        for (what, part) in
            [("real part of the centre", &centre.re), ("imaginary part of the centre", &centre.im)]
        {
            let part = part.to_wide();
            if part.unsigned_abs() > FOUR.unsigned_abs() {
                return out(what, part, -FOUR);
            }
        }
        let bits = size.width.ilog2() + 1 + GUARD;
        if highest < bits {
            let needed = (Limbs::<LIMBS>::FRACTION + 4 + bits - highest).div_ceil(32) as usize;
            let what = "limbs for so small a width";
            return Err(Error::Capacity { what, needed: needed.max(LIMBS + 1), capacity: LIMBS });
        }
        let (half_pitch, rest) = width.divided(2 * size.width);
        let half_pitch_block = half_pitch_block(&width, size);
        Ok(Self { centre, width, raster, half_pitch, rest, half_pitch_block })
    }

    /// [`DeepView::new`] with coordinates in decimal.
    ///
    /// ```
    /// use attractor::escape::DeepView;
    /// use embedded_graphics_core::geometry::Size;
    /// let view = DeepView::<12>::parse("-1.9999999999999999999999999999", "0", "1e-60", Size::new(64, 64))?;
    /// assert_eq!(view.size().width, 64);
    /// assert!(DeepView::<12>::parse("-2", "0", "0", Size::new(64, 64)).is_err());
    /// # Ok::<(), attractor::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`DeepView::new`], and as [`Limbs::from_str`](core::str::FromStr::from_str): too many digits are
    /// told how many fit.
    pub fn parse(re: &str, im: &str, width: &str, size: Size) -> Result<Self, Error> {
        Self::new(Complex::new(re.parse()?, im.parse()?), width.parse()?, size)
    }

    /// The whole Mandelbrot set, as [`View::home`]: where a zoom begins.
    ///
    /// # Errors
    /// As [`View::home`], and [`Error::OutOfRange`] for displays so flat or so high that a side of the view
    /// reaches 4.
    pub fn home(size: Size) -> Result<Self, Error> {
        View::home(size)?.try_into()
    }

    /// The point that was in the middle when the view was made.
    pub const fn centre(&self) -> &Complex<Limbs<LIMBS>> {
        &self.centre
    }

    /// The width of the rectangle.
    pub const fn width(&self) -> &Limbs<LIMBS> {
        &self.width
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
    /// [`Error::OutOfRange`] when an edge is more than 6 away from 0, or after more than
    /// [`MAX_PAN`](crate::escape::MAX_PAN) pixels in one direction.
    pub fn pan(&self, right: i32, up: i32) -> Result<Self, Error> {
        const SIX: Wide = Wide::lit("6");
        let raster = self.raster.pan(right, up)?;
        let half_pitch = i128::from(self.half_pitch.to_wide().to_bits()) + 1;
        let [across, high] = raster.reach();
        for (what, middle, half_pitches) in [
            ("real part at an edge", &self.centre.re, across),
            ("imaginary part at an edge", &self.centre.im, high),
        ] {
            let reach =
                half_pitch * i128::from(half_pitches) + i128::from(middle.to_wide().to_bits().unsigned_abs());
            if reach > i128::from(SIX.to_bits()) {
                let value = Wide::from_bits(i64::try_from(reach).unwrap_or(i64::MAX));
                return Err(Error::OutOfRange { what, index: None, value, min: -SIX, max: SIX });
            }
        }
        Ok(Self { raster, ..*self })
    }

    /// The middle of pixel `(column, row)`, `(0, 0)` at the upper left.
    ///
    /// Domain: inside [`DeepView::size`]; others count as the nearest pixel. Error: below a unit of
    /// the last place, of which `2^-48` is measured (`the_grid_is_that_of_the_narrow_view`).
    pub fn point(&self, column: u32, row: u32) -> Complex<Limbs<LIMBS>> {
        self.point_at(self.steps(column, row))
    }

    pub(crate) fn point_at(&self, (across, up): (i32, i32)) -> Complex<Limbs<LIMBS>> {
        Complex::new(self.centre.re.plus(&self.offset(across)), self.centre.im.plus(&self.offset(up)))
    }

    /// Half pitches from the centre, to the right and up: odd or even, at most 2^17.
    pub(crate) fn steps(&self, column: u32, row: u32) -> (i32, i32) {
        let Size { width, height } = self.raster.size();
        (self.raster.across(column.min(width - 1)), self.raster.up(row.min(height - 1)))
    }

    /// Whether the centre is real: rows as far below the axis as others above it then show the conjugate
    /// points, exactly.
    pub(crate) fn is_mirrored(&self) -> bool {
        self.centre.im == Limbs::ZERO
    }

    /// The row above this one at the conjugate points, if the view has it.
    pub(crate) fn mirror_image(&self, row: u32) -> Option<u32> {
        let (_, up) = self.steps(0, row);
        // two half pitches a row
        let image = u32::try_from(row as i32 + up).ok()?;
        (self.is_mirrored() && up < 0).then_some(image)
    }

    fn offset(&self, steps: i32) -> Limbs<LIMBS> {
        let divisor = 2 * i64::from(self.raster.size().width);
        let units = (i64::from(steps) * i64::from(self.rest)).checked_div_euclid(divisor).unwrap_or(0);
        self.half_pitch.times_small(steps).plus_units(units)
    }

    /// The distance of two neighbouring pixels, rounded down.
    pub fn pitch(&self) -> Limbs<LIMBS> {
        let carry = i64::from(self.rest >= self.raster.size().width);
        self.half_pitch.plus(&self.half_pitch).plus_units(carry)
    }

    /// The exponent of 2 just below the pitch: `2^e <= pitch < 2^(e + 1)`.
    pub fn pitch_exponent(&self) -> i32 {
        let highest = self.half_pitch.highest_bit().unwrap_or(0) as i32;
        highest + 1 - Limbs::<LIMBS>::FRACTION as i32
    }

    /// The distance of two neighbouring pixels.
    pub(crate) fn pitch_block(&self) -> BlockFloat<i64> {
        self.half_pitch_block.doubled()
    }

    /// So many half pitches.
    pub(crate) fn distance(&self, (across, up): (i32, i32)) -> BlockFloat<i64> {
        let BlockFloat { re, exponent, .. } = self.half_pitch_block;
        let part = |steps: i32| i128::from(steps) * i128::from(re);
        BlockFloat::<i64>::new(part(across), part(up), exponent)
    }

    /// An exponent of 2 that the distance of a pixel from the centre is below, also after panning by half the
    /// picture.
    pub(crate) fn reach(&self) -> i32 {
        self.distance((self.raster.size().width as i32, self.raster.size().height as i32)).above() + 1
    }
}

/// The same pixels, where a zoom in 32 bits goes on: centre, width, size and pan are taken over exactly.
///
/// Domain: as [`DeepView::new`] and [`DeepView::pan`], in 2 limbs and more. Exact; a point of the deep view
/// is as exact as its limbs: [`View::point`] is the same point rounded to 48 bits
/// (`a_view_goes_on_at_the_same_points`).
///
/// ```
/// use attractor::escape::{DeepView, View};
/// use embedded_graphics_core::geometry::Size;
/// let shallow = View::home(Size::new(24, 20))?.pan(3, -2)?;
/// let deep = DeepView::<12>::try_from(shallow)?;
/// assert_eq!(deep.width().to_wide(), shallow.width());
/// assert_eq!(deep.panned(), (3, -2));
/// # Ok::<(), attractor::Error>(())
/// ```
///
/// # Errors
/// As [`DeepView::new`] and [`DeepView::pan`]: a [`View`] may be wider than 4.
impl<const LIMBS: usize> TryFrom<View> for DeepView<LIMBS> {
    type Error = Error;

    fn try_from(view: View) -> Result<Self, Error> {
        if LIMBS < 2 {
            return Err(Error::Capacity { what: "limbs for 48 bits", needed: 2, capacity: LIMBS });
        }
        let limbs = |what, value, min| {
            let out = Error::OutOfRange { what, index: None, value, min, max: FOUR };
            Limbs::from_wide(value).ok_or(out)
        };
        let Complex { re, im } = view.centre();
        let width = limbs("width of the view", view.width(), Wide::DELTA)?;
        let re = limbs("real part of the centre", re, -FOUR)?;
        let im = limbs("imaginary part of the centre", im, -FOUR)?;
        let (right, up) = view.panned();
        Self::new(Complex::new(re, im), width, view.size())?.pan(right, up)
    }
}

fn half_pitch_block<const LIMBS: usize>(width: &Limbs<LIMBS>, size: Size) -> BlockFloat<i64> {
    let Some(highest) = width.highest_bit() else { return BlockFloat::<i64>::ZERO };
    // 96 bits of the width over 2 cols
    let word = |down| u128::from(highest.checked_sub(down).map_or(0, |p| width.window(p)));
    let bits = (word(0) << 64) | (word(32) << 32) | word(64);
    let quotient = bits.checked_div(u128::from(2 * size.width)).unwrap_or(0);
    BlockFloat::<i64>::new(quotient as i128, 0, highest as i32 - 95 - Limbs::<LIMBS>::FRACTION as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_views_have_the_same_home_and_pitch() {
        for size in [Size::new(24, 20), Size::new(333, 240), Size::new(7, 5), Size::new(16_384, 12_000)] {
            let (shallow, deep) = (View::home(size).unwrap(), DeepView::<4>::home(size).unwrap());
            assert_eq!(deep.pitch().to_wide(), shallow.pitch(), "{size}");
            assert_eq!(deep.pitch_exponent(), shallow.pitch_exponent(), "{size}");
            assert_eq!(deep.width().to_wide(), shallow.width());
        }
        assert!(DeepView::<4>::home(Size::new(300, 100)).is_err());
    }

    #[test]
    fn a_view_goes_on_at_the_same_points() {
        fn check<const LIMBS: usize>(narrow: View) -> u32 {
            let deep = DeepView::<LIMBS>::try_from(narrow).unwrap();
            assert_eq!((deep.size(), deep.panned()), (narrow.size(), narrow.panned()));
            let Size { width, height } = narrow.size();
            let mut between = 0;
            for (column, row) in (0..height).flat_map(|row| (0..width).map(move |column| (column, row))) {
                let (coarse, fine) = (narrow.point(column, row), deep.point(column, row));
                for (coarse, fine) in [(coarse.re, fine.re), (coarse.im, fine.im)] {
                    // what is cut off sets the last bit of the narrow point
                    let floor = Limbs::from_wide(fine.to_wide()).unwrap();
                    let cut = i64::from(floor != fine);
                    assert_eq!(coarse.to_bits(), fine.to_wide().to_bits() | cut, "{narrow:?} {column} {row}");
                    between += u32::from(floor != fine);
                }
            }
            between
        }
        let centre = Complex::new(Wide::from_num(-0.7453), Wide::from_bits(31_719_456_789_011));
        let mut between = 0;
        for (w, h, width) in
            [(64, 48, 1 << 46), (7, 100, 1_234_567_891), (240, 5, 240 << 19), (9, 9, 3 << 48)]
        {
            let home = View::new(centre, Wide::from_bits(width), Size::new(w, h)).unwrap();
            for (right, up) in [(0, 0), (1, -1), (-5, 8)] {
                let narrow = home.pan(right, up).unwrap();
                between += check::<2>(narrow) + check::<3>(narrow) + check::<12>(narrow);
            }
        }
        assert!(between > 1000, "{between}");
    }

    #[test]
    fn a_view_that_a_deep_one_cannot_hold_is_refused() {
        let size = Size::new(8, 8);
        let view = |re, im, width| {
            let centre = Complex::new(Wide::from_num(re), Wide::from_num(im));
            View::new(centre, Wide::from_num(width), size).unwrap()
        };
        for (narrow, part, wrong) in [
            (view(0, 0, 4), "width of the view", 4),
            (view(0, 0, 100), "width of the view", 100),
            (view(-5, 0, 1), "real part of the centre", -5),
            (view(100, 0, 1), "real part of the centre", 100),
            (view(0, -8, 1), "imaginary part of the centre", -8),
            (view(0, 7, 1), "imaginary part of the centre", 7),
        ] {
            let error = DeepView::<4>::try_from(narrow).unwrap_err();
            assert!(
                matches!(error, Error::OutOfRange { what, value, .. } if what == part && value == wrong),
                "{error}"
            );
        }
        let panned = view(0, 0, 1).pan(100, 0).unwrap();
        assert!(DeepView::<4>::try_from(panned).is_err());
        assert!(DeepView::<2>::try_from(view(-4, 4, 3)).is_ok());
        let error = DeepView::<1>::try_from(view(0, 0, 1)).unwrap_err();
        assert_eq!(error, Error::Capacity { what: "limbs for 48 bits", needed: 2, capacity: 1 });
    }

    #[test]
    fn the_grid_is_that_of_the_narrow_view() {
        let centre = Complex::new(Wide::from_num(-0.7), Wide::from_num(0.3));
        for (w, h) in [(64, 48), (240, 135), (7, 100)] {
            let size = Size::new(w, h);
            let width = Wide::from_num(0.25);
            let limbs = |v| Limbs::<5>::from_wide(v).unwrap();
            let narrow = View::new(centre, width, size).unwrap();
            let deep =
                DeepView::new(Complex::new(limbs(centre.re), limbs(centre.im)), limbs(width), size).unwrap();
            for (x, y) in [(0, 0), (w - 1, h - 1), (w / 2, h / 3), (1, 5)] {
                let (a, b) = (narrow.point(x, y), deep.point(x, y));
                assert!(
                    (a.re - b.re.to_wide()).abs() <= Wide::DELTA
                        && (a.im - b.im.to_wide()).abs() <= Wide::DELTA
                );
            }
            let half = deep.half_pitch_block;
            let pitch = 2.0 * half.re as f64 * 2_f64.powi(half.exponent);
            assert!((pitch / (0.25 / f64::from(w)) - 1.0).abs() < 1e-15);
            assert_eq!(deep.pitch_exponent(), (0.25 / f64::from(w)).log2().floor() as i32);
        }
    }

    #[test]
    fn widths_of_0_and_below_and_too_fine_ones_are_refused() {
        let size = Size::new(64, 64);
        let view = |width: &str| DeepView::<4>::parse("-0.5", "0", width, size);
        for width in ["0", "-1", "-1e-30", "4", "7.5"] {
            let error = view(width).unwrap_err();
            assert!(matches!(error, Error::OutOfRange { what: "width of the view", .. }), "{width}: {error}");
        }
        assert!(view("1e-32").is_ok());
        assert!(matches!(view("1e-36"), Err(Error::Capacity { needed: 5, capacity: 4, .. })));
        assert!(matches!(view("1e-50"), Err(Error::Capacity { capacity: 37, .. })));
        assert!(DeepView::<4>::parse("5", "0", "1", size).is_err());
        assert!(DeepView::<4>::parse("0", "0", "1", Size::new(1, 9)).is_err());
        assert!(DeepView::<4>::parse("0", "0", "1", Size::new(0, 9)).is_err());
    }
}
