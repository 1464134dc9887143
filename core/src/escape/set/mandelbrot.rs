//! The Mandelbrot set: for each `c` of a view, the dwell of the orbit `0, c, c^2 + c, ...`.
//!
//! Source: course unit V, "The Mandelbrot set", sections 5.4.2 to 5.4.4. With `d_1 = c` the dwell is
//! `min(iterations until |d_k| > 2, Num)`. Most of the inside costs nothing: the two largest parts of the set
//! are recognised by formula; elsewhere an orbit ends when it repeats itself.

use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use crate::Error;
use crate::escape::orbit::arithmetic::Arithmetic;
use crate::escape::orbit::cardioid;
use crate::escape::orbit::narrow::narrow;
use crate::escape::orbit::word_orbit::WordOrbit;
use crate::escape::value::Dwell;
use crate::escape::value::checked_max;
use crate::escape::view::shallow::View;
use crate::num::Complex;
use crate::num::Wide;
use crate::plane::{Field, along};

/// The dwell at every pixel of a view.
///
/// ```
/// use attractor::escape::{Mandelbrot, View};
/// use attractor::plane::Field;
/// use embedded_graphics_core::geometry::Size;
/// let picture = Mandelbrot::new(View::home(Size::new(24, 20))?, 100)?;
/// let inside = (0..20).flat_map(|y| picture.row(y, 0..24)).filter(|d| d.is_inside()).count();
/// assert_eq!(inside, 100);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::serial::MandelbrotNumbers", into = "crate::serial::MandelbrotNumbers")
)]
pub struct Mandelbrot {
    view: View,
    max: u32,
    arithmetic: Arithmetic,
    interior: bool,
}

impl Mandelbrot {
    /// The set as `view` shows it, with at most `max_dwell` iterations a pixel (a hundred is usual, more for
    /// a deeper view).
    ///
    /// # Errors
    /// [`Error::TooFew`] for a `max_dwell` of 0, [`Error::Capacity`] above
    /// [`MAX_DWELL`](crate::escape::MAX_DWELL).
    pub fn new(view: View, max_dwell: u32) -> Result<Self, Error> {
        let max = checked_max(max_dwell)?;
        Ok(Self { view, max, arithmetic: Arithmetic::of_word(view.pitch(), max), interior: true })
    }

    /// The same with the other arithmetic of 32-bit words than the one that suits the view.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for the wider ones, which [`DeepMandelbrot`](crate::escape::DeepMandelbrot)
    /// has.
    pub const fn with_arithmetic(self, arithmetic: Arithmetic) -> Result<Self, Error> {
        match arithmetic {
            Arithmetic::Word26 | Arithmetic::Word29 => Ok(Self { arithmetic, ..self }),
            _ => Err(Error::Unsupported { what: "arithmetic", allowed: "Word26 and Word29" }),
        }
    }

    pub(crate) fn orbit_of(&self, c: Complex<Wide>) -> Option<WordOrbit> {
        let c = narrow(c)?;
        // the conjugate, as `dwell_at`
        let c = (c.0, c.1.wrapping_abs());
        Some(WordOrbit { z: c, c, arithmetic: self.arithmetic })
    }

    #[inline(always)]
    pub(crate) const fn constant_of(&self, point: Complex<Wide>) -> Complex<Wide> {
        point
    }

    pub(super) const fn set_view(&mut self, view: View) {
        self.view = view;
    }

    /// The view.
    pub const fn view(&self) -> &View {
        &self.view
    }

    /// `Num`, the dwell of a point that does not escape.
    pub const fn max_dwell(&self) -> u32 {
        self.max
    }

    /// How orbits are computed.
    pub const fn arithmetic(&self) -> Arithmetic {
        self.arithmetic
    }

    /// The dwell at any point of the plane.
    ///
    /// Domain: all. Result: iterations. Error: the orbit starts at the nearest point with 29 fractional bits
    /// and is rounded at every step, which shows where it is chaotic. Against 248 fractional bits 0.64 pixels
    /// in 1000 of a 256 x 256 picture of the whole set differ at 1024 iterations, 0.06 in 1000 by their side
    /// (`a_dyadic_grid_agrees_with_248_bits`); against `f64` 0.2 in 1000 of the home view on 240 x 240 at 100
    /// (`dwell_agrees_with_float_on_the_home_view`). Cost: see [`Arithmetic`]; nothing is iterated in the
    /// main cardioid and the disc of period 2.
    #[inline]
    pub fn dwell_at(&self, c: Complex<Wide>) -> Dwell {
        let count = match narrow(c) {
            None => 0,
            Some(c) if self.interior && cardioid::contains(c) => self.max,
            Some((re, im)) => {
                // the conjugate has the same dwell: the picture is symmetric to the last bit
                let c = (re, im.wrapping_abs());
                self.arithmetic.dwell(c, c, self.max)
            }
        };
        Dwell { count, max: self.max }
    }
}

impl Field for Mandelbrot {
    type Value = Dwell;

    fn size(&self) -> Size {
        self.view.size()
    }

    #[inline]
    fn at(&self, x: u32, y: u32) -> Dwell {
        self.dwell_at(self.view.point(x, y))
    }

    #[inline]
    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Dwell> {
        along(self.view.line(y, x), |point| self.dwell_at(point))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::escape::exact::{Difference, dwell_248, dwell_float};
    use std::vec::Vec;

    fn point(re: f64, im: f64) -> Complex<Wide> {
        Complex::new(Wide::from_num(re), Wide::from_num(im))
    }

    fn dwells(picture: &Mandelbrot) -> Vec<Dwell> {
        let size = picture.size();
        (0..size.height).flat_map(|y| picture.row(y, 0..size.width)).collect()
    }

    /// A grid over the whole set whose points are multiples of `2^-7`.
    fn dyadic() -> View {
        View::new(point(-0.5, 0.0), Wide::from_num(4), Size::new(256, 256)).unwrap()
    }

    fn both(view: View, max: u32) -> [Mandelbrot; 2] {
        let picture = Mandelbrot::new(view, max).unwrap();
        [Arithmetic::Word29, Arithmetic::Word26].map(|p| picture.with_arithmetic(p).unwrap())
    }

    #[test]
    fn points_with_a_known_orbit_have_its_dwell() {
        for picture in both(View::home(Size::new(64, 64)).unwrap(), 1000) {
            for (re, im, dwell) in [
                (2.0, 0.0, 1),
                (-2.0, 0.0, 1000),
                (0.0, 0.0, 1000),
                (0.0, 1.0, 1000),
                (0.0, -1.0, 1000),
                (-1.0, 0.0, 1000),
                (0.25, 0.0, 1000),
                (1.0, 0.0, 2), // 1, 2, 5
                (0.5, 0.0, 4), // 0.5, 0.75, 1.06, 1.63, 3.15
                (0.0, 2.0, 1), // 2i, -4 + 2i
                (2.1, 0.0, 0),
                (-2.000_000_000_1, 0.0, 0),
                (1.5, 1.5, 0),
                (6.0, 0.0, 0),
                (-2.0, 8.0, 0),
                (30000.0, -30000.0, 0),
            ] {
                let d = picture.dwell_at(point(re, im));
                assert_eq!((d.count, d.is_inside()), (dwell, dwell == 1000), "{re} {im} {picture:?}");
            }
        }
    }

    #[test]
    fn interior_and_cycles_change_no_pixel() {
        let views = [
            View::home(Size::new(240, 240)).unwrap(),
            dyadic(),
            // on the rim of the cardioid and of the disc, where a pixel is two units wide
            View::new(point(-0.75, 0.0), Wide::from_bits(60 << 20), Size::new(60, 60)).unwrap(),
            View::new(point(-1.25, 0.0), Wide::from_bits(60 << 20), Size::new(60, 60)).unwrap(),
            View::new(point(-0.125, 0.6495190528), Wide::from_bits(60 << 22), Size::new(60, 60)).unwrap(),
            View::new(point(0.25, 0.0), Wide::from_bits(60 << 24), Size::new(60, 60)).unwrap(),
        ];
        for view in views {
            for with in both(view, 1000) {
                let without = Mandelbrot { interior: false, ..with };
                assert!(dwells(&with) == dwells(&without), "{with:?}");
                let recognised = dwells(&with).iter().filter(|d| d.is_inside()).count();
                assert!(recognised > 100, "{with:?}: {recognised}");
            }
        }
    }

    #[test]
    fn dwell_agrees_with_float_on_the_home_view() {
        let view = View::home(Size::new(240, 240)).unwrap();
        for max in [100, 1000] {
            for picture in both(view, max) {
                let difference = Difference::of(240, 240, max, |x, y| {
                    let c = view.point(x, y);
                    let c = (c.re.to_num(), c.im.to_num());
                    (picture.dwell_at(view.point(x, y)).count, dwell_float(c, c, max))
                });
                std::println!("home, max {max}, {:?}: {difference:?}", picture.arithmetic());
                let (pixels, sides) = if max == 100 { (15, 6) } else { (140, 12) };
                assert!(difference.pixels <= pixels && difference.sides <= sides, "{difference:?}");
            }
        }
    }

    #[test]
    fn a_dyadic_grid_agrees_with_248_bits() {
        let view = dyadic();
        for max in [256, 1024] {
            let exact: Vec<u32> =
                (0..256 * 256).map(|k| dwell_248(view.point(k % 256, k / 256), max)).collect();
            for picture in both(view, max) {
                let difference = Difference::of(256, 256, max, |x, y| {
                    (picture.dwell_at(view.point(x, y)).count, exact[(256 * y + x) as usize])
                });
                std::println!("dyadic, max {max}, {:?}: {difference:?}", picture.arithmetic());
                let (pixels, sides) = (3 * 65_536 / 1000, 65_536 / 1000);
                assert!(difference.pixels <= pixels / 2 && difference.sides <= sides / 4, "{difference:?}");
            }
        }
    }

    #[test]
    fn a_row_is_the_row_of_points_and_skips_without_iterating() {
        let picture = Mandelbrot::new(View::home(Size::new(97, 53)).unwrap(), MAX).unwrap();
        const MAX: u32 = 1 << 20;
        for y in [0, 26, 52] {
            let row: Vec<_> = picture.row(y, 3..90).collect();
            assert_eq!(row.len(), 87);
            for (x, d) in (3..).zip(&row) {
                assert_eq!(*d, picture.dwell_at(picture.view().point(x, y)));
            }
            let mut skipping = picture.row(y, 3..90);
            assert_eq!(skipping.len(), 87);
            assert_eq!(skipping.nth(40), Some(row[40]));
            assert_eq!(skipping.len(), 46);
            assert_eq!(skipping.nth(45), Some(row[86]));
            assert_eq!((skipping.next(), skipping.nth(3), skipping.next()), (None, None, None));
        }
    }

    #[test]
    fn the_set_is_symmetric_about_the_real_axis() {
        for picture in both(View::home(Size::new(120, 100)).unwrap(), 500) {
            for y in 0..50 {
                assert!(picture.row(y, 0..120).eq(picture.row(99 - y, 0..120)), "row {y}");
            }
        }
    }

    #[test]
    fn a_limit_out_of_range_is_refused() {
        let view = View::home(Size::new(8, 8)).unwrap();
        assert!(matches!(Mandelbrot::new(view, 0), Err(Error::TooFew { given: 0, at_least: 1, .. })));
        assert!(matches!(
            Mandelbrot::new(view, (1 << 20) + 1),
            Err(Error::Capacity { needed: 1_048_577, capacity: 1_048_576, .. })
        ));
        assert!(Mandelbrot::new(view, 1).is_ok() && Mandelbrot::new(view, 1 << 20).is_ok());
    }
}
