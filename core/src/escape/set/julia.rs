//! Filled-in Julia sets: for each `s` of a view, the dwell of the orbit `s, s^2 + c, (s^2 + c)^2 + c, ...`
//! with one `c` for all.
//!
//! The set itself, the boundary of the filled one, is [`JuliaSet`](crate::escape::JuliaSet). Source: course
//! unit V, "Julia sets", sections 5.5.1 and 5.5.2. With `d_0 = s` the dwell is
//! `min(iterations until |d_k| > 2, Num)`.

use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use crate::Error;
use crate::escape::julia_set::set::checked_constant;
use crate::escape::orbit::arithmetic::Arithmetic;
use crate::escape::orbit::dwell::Point29;
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
/// use attractor::num::Complex;
/// use attractor::escape::{Julia, View};
/// use attractor::num::Wide;
/// use embedded_graphics_core::geometry::Size;
/// let view = View::new(Complex::default(), Wide::from_num(4), Size::new(64, 64))?;
/// let basilica = Julia::new(view, Complex::new(Wide::from_num(-1), Wide::ZERO), 100)?;
/// assert!(basilica.dwell_at(Complex::default()).is_inside());
/// assert_eq!(basilica.dwell_at(Complex::new(Wide::from_num(2), Wide::ZERO)).count, 1);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::serial::JuliaNumbers", into = "crate::serial::JuliaNumbers")
)]
pub struct Julia {
    view: View,
    c: Complex<Wide>,
    constant: Point29,
    max: u32,
    arithmetic: Arithmetic,
}

impl Julia {
    /// The filled-in Julia set of `c` as `view` shows it, with at most `max_dwell` iterations a pixel. The
    /// constant is rounded to 29 fractional bits.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for `|c| > 2` (such a set is dust, and 2 is no bound for its orbits; `|c|` is
    /// reported), [`Error::TooFew`] for a `max_dwell` of 0, [`Error::Capacity`] above
    /// [`MAX_DWELL`](crate::escape::MAX_DWELL).
    pub fn new(view: View, c: Complex<Wide>, max_dwell: u32) -> Result<Self, Error> {
        let max = checked_max(max_dwell)?;
        let constant = checked_constant(c)?;
        Ok(Self { view, c, constant, max, arithmetic: Arithmetic::of_word(view.pitch(), max) })
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
        narrow(c).map(|z| WordOrbit { z, c: self.constant, arithmetic: self.arithmetic })
    }

    pub(crate) const fn constant_of(&self, _: Complex<Wide>) -> Complex<Wide> {
        self.c
    }

    pub(super) const fn set_view(&mut self, view: View) {
        self.view = view;
    }

    /// The view.
    pub const fn view(&self) -> &View {
        &self.view
    }

    /// The constant, as it was given.
    pub const fn constant(&self) -> Complex<Wide> {
        self.c
    }

    /// `Num`, the dwell of a point that does not escape.
    pub const fn max_dwell(&self) -> u32 {
        self.max
    }

    /// How orbits are computed.
    pub const fn arithmetic(&self) -> Arithmetic {
        self.arithmetic
    }

    /// The dwell of the orbit that starts at any point of the plane.
    ///
    /// Domain: all. Result: iterations. Error: the start is the nearest point with 29 fractional bits and
    /// every step is rounded, which shows where the orbit is chaotic: of six sets at 200 iterations four
    /// agree with `f64` at all of 40000 pixels, two differ at 1 in 1000 (`julia_sets_agree_with_float`).
    /// Cost: see [`Arithmetic`].
    #[inline]
    pub fn dwell_at(&self, s: Complex<Wide>) -> Dwell {
        let count = narrow(s).map_or(0, |s| self.arithmetic.dwell(s, self.constant, self.max));
        Dwell { count, max: self.max }
    }
}

impl Field for Julia {
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
    use crate::escape::exact::{Difference, dwell_float};

    fn point(re: f64, im: f64) -> Complex<Wide> {
        Complex::new(Wide::from_num(re), Wide::from_num(im))
    }

    fn julia(c: (f64, f64), max: u32) -> [Julia; 2] {
        let view = View::new(Complex::default(), Wide::from_num(4), Size::new(200, 200)).unwrap();
        let picture = Julia::new(view, point(c.0, c.1), max).unwrap();
        [Arithmetic::Word29, Arithmetic::Word26].map(|p| picture.with_arithmetic(p).unwrap())
    }

    #[test]
    fn for_c_0_the_set_is_the_unit_disc() {
        for picture in julia((0.0, 0.0), 64) {
            assert_eq!(picture.dwell_at(point(2.0, 0.0)).count, 1);
            assert_eq!(picture.dwell_at(point(2.1, 0.0)).count, 0);
            assert_eq!(picture.dwell_at(point(1.5, 0.0)).count, 1); // 1.5, 2.25
            assert_eq!(picture.dwell_at(point(0.0, 1.25)).count, 2); // 1.25i, -1.56, 2.44
            for (x, y) in (0..200).flat_map(|y| (0..200).map(move |x| (x, y))) {
                let s = picture.view().point(x, y);
                let square = s.re.to_num::<f64>().powi(2) + s.im.to_num::<f64>().powi(2);
                assert_eq!(picture.dwell_at(s).is_inside(), square < 1.0);
            }
        }
    }

    #[test]
    fn for_c_minus_2_the_set_is_a_segment() {
        for picture in julia((-2.0, 0.0), 200) {
            for re in [-2.0, -1.999, -1.0, 0.0, 0.3, 1.0, 2.0] {
                assert!(picture.dwell_at(point(re, 0.0)).is_inside(), "{re}");
            }
            // 6 and -6 are 2 when they wrap
            assert_eq!(picture.dwell_at(point(0.0, 2.0)).count, 1);
            assert_eq!(picture.dwell_at(point(0.0, -2.0)).count, 1);
            assert!(!picture.dwell_at(point(0.5, 0.01)).is_inside());
        }
    }

    #[test]
    fn julia_sets_agree_with_float() {
        for c in [(-1.0, 0.0), (-0.123, 0.745), (-0.8, 0.156), (0.285, 0.01), (0.0, 1.0), (0.4, 0.4)] {
            for picture in julia(c, 200) {
                let rounded = picture.constant();
                let c = (rounded.re.to_num(), rounded.im.to_num());
                let difference = Difference::of(200, 200, 200, |x, y| {
                    let s = picture.view().point(x, y);
                    let float = dwell_float((s.re.to_num(), s.im.to_num()), c, 200);
                    (picture.dwell_at(s).count, float)
                });
                std::println!("julia {c:?} {:?}: {difference:?}", picture.arithmetic());
                assert!(difference.pixels <= 120 && difference.sides <= 30, "{c:?}: {difference:?}");
            }
        }
    }

    #[test]
    fn a_set_is_symmetric_about_0() {
        for picture in julia((-0.8, 0.156), 300) {
            for y in 0..100 {
                let back = picture.row(199 - y, 0..200).collect::<std::vec::Vec<_>>();
                assert!(picture.row(y, 0..200).eq(back.into_iter().rev()), "row {y}");
            }
        }
    }

    #[test]
    fn a_constant_beyond_2_is_refused() {
        let view = View::home(Size::new(8, 8)).unwrap();
        assert!(Julia::new(view, point(0.0, -2.0), 9).is_ok());
        let error = Julia::new(view, point(1.5, -2.25), 9);
        // 2.7042 in magnitude
        assert!(matches!(error, Err(Error::OutOfRange { value, .. }) if value > 2.7041 && value < 2.7043));
        assert!(Julia::new(view, Complex::new(Wide::from_num(2) + Wide::DELTA, Wide::ZERO), 9).is_err());
        assert!(Julia::new(view, point(0.0, 0.0), 0).is_err());
    }
}
