//! The distance from an outer point to the set, estimated: it shows filaments that are thinner than a pixel,
//! which the dwell skips.
//!
//! `|z_n| ln |z_n|^2 / |z'_n|` in pixels, where `z'` is the derivative of the orbit by its start:
//! `z' <- 2 z z' + 1` (Mandelbrot), `2 z z'` (Julia). Source: H.-O. Peitgen, D. Saupe, "The Science of
//! Fractal Images", 1988, section 4.2.5, from J. Milnor: the true distance `d` satisfies
//! `estimate / 4 < d < estimate` (Koebe's quarter theorem) in the limit.
//!
//! Format: the derivative, which grows without bound, as two 32-bit mantissas and a shared exponent.

use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use crate::escape::orbit::block_float::Number;
use crate::escape::orbit::ending::Ending;
use crate::escape::set::escape_time::EscapeTime;
use crate::num::formats::UQ32;
use crate::num::{Real, log2, sqrt};
use crate::plane::{Field, along};

/// The estimated distance at every pixel, in pixels: none inside. As a level, 1 is a pixel and more: thin
/// parts of the set stay visible.
///
/// ```
/// use attractor::draw::{Grey, Picture};
/// use attractor::num::Complex;
/// use attractor::escape::{Distance, Mandelbrot, View};
/// use embedded_graphics::pixelcolor::Gray8;
/// use embedded_graphics::{image::Image, mock_display::MockDisplay, prelude::*};
///
/// let distance = Distance(Mandelbrot::new(View::home(Size::new(64, 54))?, 200)?);
/// // inside; beside the needle, which is thinner than a pixel; far away
/// let at = |c| distance.value_at(c);
/// assert_eq!(at(const { Complex::lit("-1", "0") }), None);
/// assert!(at(const { Complex::lit("-1.7", "0.001") }).is_some_and(|d| d < 0.1));
/// assert!(at(const { Complex::lit("1", "1") }).is_some_and(|d| d > 5));
/// let mut display = MockDisplay::<Gray8>::new();
/// Image::new(&Picture::new(distance, Grey), Point::zero()).draw(&mut display).ok();
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Distance<P>(
    /// The picture.
    pub P,
);

impl<P: EscapeTime> Distance<P> {
    /// The estimate at a point, in pixels of the view.
    ///
    /// Domain: all. Result: saturated at the end of [`Real`], none where the orbit does not escape. Error:
    /// one unit and below `2^-24 (10 + dwell)` of the estimate, beside that of the orbit, which is the
    /// dwell's (`the_orbit_is_that_of_the_dwell`, `the_estimate_agrees_with_float`). Cost: the dwell, in
    /// words the same number of steps once more, each with a derivative, two logarithms: 1807 Cortex-M4
    /// instructions (kernel `distance estimate`) a pixel of the home view at 100 iterations, the dwell alone
    /// 189 (kernel `dwell of a pixel`).
    pub fn value_at(&self, point: P::Point) -> Option<Real> {
        // at a critical point it is infinite
        let Some((estimate, exponent)) = estimate(&self.0.ending_with_derivative(point)?) else {
            return Some(Real::MAX);
        };
        let (pitch, below) = self.0.pitch();
        // at most 32 bits over at least 28
        let quotient = (estimate << 31).checked_div(u64::from(pitch))?;
        // to 24 fractional bits
        let places = exponent.saturating_sub(below).saturating_sub(31 - 24);
        let bits = if places >= 0 {
            if (quotient.leading_zeros() as i32) > places { quotient << (places & 63) } else { u64::MAX }
        } else {
            quotient.checked_shr(places.unsigned_abs()).unwrap_or(0)
        };
        Some(Real::from_bits(bits.min(i32::MAX as u64) as i32))
    }
}

/// `|z| ln |z|^2 / |z'|` after the orbit has gone on to `|z| > 1024`: mantissa of at most 32 bits, and
/// exponent.
fn estimate(ending: &Ending) -> Option<(u64, i32)> {
    let Ending { mut z, c, mut derivative, gain, .. } = *ending;
    for _ in 0..64 {
        // the larger part is at least 2^29 2^exponent
        if z.exponent > 10 - 29 {
            break;
        }
        derivative = z.times(derivative).doubled().plus(gain);
        z = z.times(z).plus(c);
    }
    let (square, twice) = z.square();
    // ln |z|^2 with 24 fractional bits, below 2^30
    const LN_2: UQ32 = 0xb172_17f7;
    let log = i64::from(log2(square)) + (i64::from(twice) << 24);
    let log = (u64::try_from(log).ok()? * u64::from(LN_2)) >> 32;
    let quotient = (u64::from(sqrt(square)) * log).checked_div(u64::from(sqrt(derivative.square().0)))?;
    Some((quotient, z.exponent.saturating_sub(derivative.exponent).saturating_sub(24)))
}

impl<P: EscapeTime> Field for Distance<P> {
    type Value = Option<Real>;

    fn size(&self) -> Size {
        self.0.size()
    }

    fn at(&self, x: u32, y: u32) -> Option<Real> {
        self.value_at(self.0.point_at(x, y))
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Option<Real>> {
        along(self.0.line(y, x), |point| self.value_at(point))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::escape::exact::every_pixel;
    use crate::escape::{Mandelbrot, View};

    /// `orbit` as far as it goes, then in floating point.
    fn estimate_of(orbit: &[(f64, f64)], c: (f64, f64), gain: f64) -> f64 {
        let mut given = orbit.iter().copied();
        let ((mut x, mut y), (mut a, mut b)) = (given.next().unwrap(), (1.0, 0.0));
        while x * x + y * y < 2_f64.powi(60) {
            (a, b) = (2.0 * (x * a - y * b) + gain, 2.0 * (x * b + y * a));
            (x, y) = given.next().unwrap_or((x * x - y * y + c.0, 2.0 * x * y + c.1));
        }
        x.hypot(y) * (x * x + y * y).ln() / a.hypot(b)
    }

    fn float(c: (f64, f64)) -> f64 {
        estimate_of(&[c], c, 1.0)
    }

    /// Every pixel against the estimate along the dwell's orbit, which is followed in exact integers.
    #[test]
    fn the_orbit_is_that_of_the_dwell() {
        let (mut worst, mut pixels) = (0.0_f64, 0);
        every_pixel(|pixel| {
            assert_eq!(pixel.distance.is_none(), pixel.dwell.is_inside());
            let Some(distance) = pixel.distance else { return };
            // saturated at the end of the format
            let want = estimate_of(&pixel.orbit, pixel.c, pixel.gain).min(128.0 * pixel.pitch);
            let error = (distance - want).abs() - pixel.pitch * 2_f64.powi(-24);
            pixels += 1;
            worst = worst.max(error / want / f64::from(10 + pixel.dwell.count));
        });
        std::println!("distance: {worst:e} of {pixels}");
        assert!(
            pixels > 100_000 && worst > 2_f64.powi(-26) && worst < 2_f64.powi(-24),
            "{worst:e} of {pixels}"
        );
    }

    #[test]
    fn the_estimate_agrees_with_float() {
        let view = View::home(Size::new(120, 100)).unwrap();
        let picture = Distance(Mandelbrot::new(view, 60).unwrap());
        let pitch: f64 = view.pitch().to_num();
        let (mut worst, mut outside, mut near) = (0.0_f64, 0, 0);
        for (x, y) in (0..100).flat_map(|y| (0..120).map(move |x| (x, y))) {
            let c = view.point(x, y);
            if let Some(d) = picture.value_at(c) {
                // later the orbits themselves part
                if d == Real::MAX || picture.0.dwell_at(c).count > 20 {
                    continue;
                }
                outside += 1;
                near += u32::from(d < 1);
                let exact = float((c.re.to_num(), c.im.to_num())) / pitch;
                worst = worst.max(((d.to_num::<f64>() - exact).abs() - 6e-8).max(0.0) / exact);
            }
        }
        std::println!("distance: {worst:e} of {outside}, {near} near");
        assert!(outside > 5000 && near > 100);
        assert!(worst > 0.0 && worst < 0.001, "{worst:e}");
    }

    #[test]
    fn a_row_is_the_row_of_points() {
        let picture = Distance(Mandelbrot::new(View::home(Size::new(40, 30)).unwrap(), 60).unwrap());
        let mut row = picture.row(7, 3..30);
        assert_eq!(row.nth(4), Some(picture.value_at(picture.0.view().point(7, 7))));
        assert_eq!(row.len(), 22);
    }

    /// A distance of more pixels than the format holds is its greatest.
    #[test]
    fn a_distance_beyond_the_format_is_saturated() {
        use crate::num::Complex;
        use crate::num::Wide;
        let point = |x: f64, y: f64| Complex::new(Wide::from_num(x), Wide::from_num(y));
        let (mut held, mut saturated) = (0, 0);
        for k in 0..40 {
            let width = Wide::from_bits(64 << (48 - k));
            let Ok(view) = View::new(point(0.5, 0.5), width, Size::new(64, 64)) else { continue };
            let picture = Distance(Mandelbrot::new(view, 60).unwrap());
            for at in [(1.0, 1.0), (20_000.0, -30_000.0)] {
                // in pixels 2^-k wide
                let (got, exact) = (picture.value_at(point(at.0, at.1)), float(at) * 2_f64.powi(k));
                match got {
                    Some(d) if exact < 127.9 => {
                        assert!((d.to_num::<f64>() / exact - 1.0).abs() < 1e-5, "{k}");
                        held += 1;
                    }
                    other => {
                        assert!(other == Some(Real::MAX) && exact > 127.9, "{k}: {other:?}");
                        saturated += 1;
                    }
                }
            }
        }
        assert!(held > 4 && saturated > 30, "{held} {saturated}");
    }
}
