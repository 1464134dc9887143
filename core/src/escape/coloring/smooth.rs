//! Fractional dwell, for pictures without steps between the bands of equal dwell.
//!
//! `n + 1 - log2(log2 |z_n|)` for the `n`-th point of an orbit that has escaped. Source: H.-O. Peitgen, D.
//! Saupe, "The Science of Fractal Images", 1988, section 4.2.5 (the potential); the limit of
//! `n - log2(log2 |z_n|)` exists and changes by 1 where the dwell does. The orbit is followed on to
//! `|z| > 1024`, where the rest of the limit is below `2^-20`. The `n` is the dwell's own: both follow one
//! orbit, rounding and all.
//!
//! Format: 20 fractional bits there, 11 in the result.

use core::ops::Range;

use embedded_graphics_core::geometry::Size;
use fixed::types::U21F11;

use crate::escape::orbit::ending::Ending;
use crate::escape::set::escape_time::EscapeTime;
use crate::num::formats::UQ24;
use crate::num::log2;
use crate::plane::{Field, along};

/// A dwell with a fraction, and the limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FractionalDwell {
    /// The limit `n + 1 - log2(log2 |z_n|)`, at least 0; `max` inside.
    pub dwell: U21F11,
    /// `Num`.
    pub max: u32,
}

impl FractionalDwell {
    /// How many steps of an iteration the palettes of this crate tell apart: a period of theirs is as many
    /// times as long.
    pub const STEPS: u32 = 16;

    /// Whether the orbit did not escape in time.
    pub fn is_inside(self) -> bool {
        self.dwell >= U21F11::saturating_from_num(self.max)
    }
}

/// The fractional dwell at every pixel of an escape-time picture.
///
/// ```
/// use attractor::num::Complex;
/// use attractor::escape::{Mandelbrot, Smooth, View};
/// use attractor::num::Wide;
/// use embedded_graphics_core::geometry::Size;
/// let smooth = Smooth(Mandelbrot::new(View::home(Size::new(24, 20))?, 100)?);
/// let at = |re: f32| smooth.value_at(Complex::new(Wide::from_num(re), Wide::ZERO)).dwell;
/// assert!(at(0.5) > at(0.51) && at(0.51) > at(0.52));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Smooth<P>(
    /// The picture.
    pub P,
);

impl<P: EscapeTime> Smooth<P> {
    /// The fractional dwell at a point.
    ///
    /// Domain: all. Error: below `2^-10` beside that of the orbit (`fractional_dwell_agrees_with_float`); the
    /// orbit is that of the dwell (`the_orbit_is_that_of_the_dwell`). Cost: the dwell, in words the same
    /// number of steps once more, about 4 steps and two logarithms; nothing more inside. The home view at 100
    /// iterations takes 653 Cortex-M4 instructions (kernel `fractional dwell`) a pixel, the dwell alone 189
    /// (kernel `dwell of a pixel`).
    pub fn value_at(&self, point: P::Point) -> FractionalDwell {
        let max = self.0.max_dwell();
        let inside = U21F11::saturating_from_num(max);
        // an orbit that escapes in time is outside, whatever the fraction
        let dwell = match self.0.ending(point) {
            None => inside,
            Some(ending) => potential(&ending).min(inside.saturating_sub(U21F11::DELTA)),
        };
        FractionalDwell { dwell, max }
    }
}

/// The limit for an orbit that has escaped, or will: with 20 fractional bits on to `|z| > 1024`.
fn potential(ending: &Ending) -> U21F11 {
    const FAR: u64 = 1 << (20 + 40);
    // below 2^16: less than 2^37
    let ((mut x, mut y), c) = (ending.z.fixed(20), ending.c.fixed(20));
    let mut count = ending.steps;
    // an orbit that rounding holds near 2 ends all the same
    for _ in 0..64 {
        // below 1024 in each part: squares below 2^60
        if x.unsigned_abs().max(y.unsigned_abs()) >= 1 << 30 || (x * x) as u64 + (y * y) as u64 >= FAR {
            break;
        }
        (x, y) = ((((x - y) * (x + y)) >> 20) + c.0, ((x * y) >> 19) + c.1);
        count += 1;
    }
    limit(x.unsigned_abs(), y.unsigned_abs(), count)
}

/// `count + 1 - log2(log2 |z|)` for parts with 20 fractional bits, below 2^40.
fn limit(x: u64, y: u64, count: u32) -> U21F11 {
    // 10 fractional bits: squares below 2^60
    let (x, y) = (x >> 10, y >> 10);
    let twice: UQ24 = log2(x * x + y * y).saturating_sub(20 << 24); // 2 log2 |z|
    // log2 of (2 log2 |z|) = log2(log2 |z|) + 1
    let loglog = i64::from(log2(u64::from(twice))) - (25 << 24);
    let limit = ((i64::from(count) + 1) << 24) - loglog;
    U21F11::from_bits((limit >> 13).max(0) as u32)
}

impl<P: EscapeTime> Field for Smooth<P> {
    type Value = FractionalDwell;

    fn size(&self) -> Size {
        self.0.size()
    }

    fn at(&self, x: u32, y: u32) -> FractionalDwell {
        self.value_at(self.0.point_at(x, y))
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = FractionalDwell> {
        along(self.0.line(y, x), |point| self.value_at(point))
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use crate::escape::exact::every_pixel;
    use crate::escape::{Mandelbrot, View};

    /// `n + 1 - log2(log2 |z_n|)` at `|z| > 2^40`.
    fn float(c: (f64, f64)) -> f64 {
        limit_from(c, c)
    }

    /// The same from a point of an orbit on.
    fn limit_from((mut x, mut y): (f64, f64), c: (f64, f64)) -> f64 {
        for n in 0.. {
            let square = x * x + y * y;
            if square > 2_f64.powi(80) {
                return f64::from(n) + 1.0 - (square.log2() / 2.0).log2();
            }
            (x, y) = (x * x - y * y + c.0, 2.0 * x * y + c.1);
        }
        0.0
    }

    #[test]
    fn fractional_dwell_agrees_with_float() {
        let picture = Mandelbrot::new(View::home(Size::new(120, 100)).unwrap(), 60).unwrap();
        let smooth = Smooth(picture);
        let (mut worst, mut outside) = (0.0_f64, 0);
        for (x, y) in (0..100).flat_map(|y| (0..120).map(move |x| (x, y))) {
            let c = picture.view().point(x, y);
            let value = smooth.value_at(c);
            let dwell = picture.dwell_at(c);
            assert_eq!(value.is_inside(), dwell.is_inside());
            if !value.is_inside() && dwell.count < 20 {
                outside += 1;
                let error =
                    (value.dwell.to_num::<f64>() - float((c.re.to_num(), c.im.to_num())).max(0.0)).abs();
                worst = worst.max(error);
            }
        }
        assert!(outside > 5000, "{outside}");
        assert!(worst > 0.0 && worst < 2_f64.powi(-10), "{worst:e}");
    }

    /// From the first point beyond 2 of the orbit that the dwell follows, in exact integers; then in floating
    /// point. Every pixel against the limit from the last point of the dwell's orbit on, which is followed in
    /// exact integers.
    #[test]
    fn the_orbit_is_that_of_the_dwell() {
        let (mut worst, mut band) = (0.0_f64, [0.0_f64; 2]);
        every_pixel(|pixel| {
            let (smooth, dwell) = (pixel.smooth, pixel.dwell);
            assert_eq!((smooth.is_inside(), smooth.max), (dwell.is_inside(), dwell.max));
            if let Some(far) = pixel.orbit.last() {
                let count = f64::from(dwell.count);
                let most = f64::from(dwell.max) - 2_f64.powi(-11);
                let got = smooth.dwell.to_num::<f64>();
                worst = worst.max((got - (count + limit_from(*far, pixel.c)).clamp(0.0, most)).abs());
                band = [band[0].min(got - count), band[1].max(got - count)];
            }
        });
        std::println!("fractional dwell: {worst:e}, {band:?} beside the dwell");
        assert!(worst > 2_f64.powi(-12) && worst < 2_f64.powi(-10), "{worst:e}");
        // about 2 and -2 the limit itself leaves the unit interval
        assert!(-0.35 < band[0] && band[0] < -0.3 && 2.0 < band[1] && band[1] < 2.35, "{band:?}");
    }

    #[test]
    fn a_row_is_the_row_of_points() {
        let picture = Smooth(Mandelbrot::new(View::home(Size::new(40, 30)).unwrap(), 60).unwrap());
        let mut row = picture.row(7, 3..30);
        assert_eq!(row.len(), 27);
        assert_eq!(row.nth(4), Some(picture.value_at(picture.0.view().point(7, 7))));
        assert_eq!(row.next(), Some(picture.value_at(picture.0.view().point(8, 7))));
    }

    /// The limit itself, rounded down, except where it lies within the logarithms' error of a step: `2^-24`.
    #[test]
    fn a_limit_is_the_formula_rounded_down() {
        let (mut beside, mut tried) = (0, 0);
        for i in 1..200_000_u64 {
            // |z| from 2^10 to 2^19, parts with 10 fractional bits
            let x = (1 << 20) + i * 2_663;
            let y = i.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (44 + i % 16);
            let square = (x as f64 / 1024.0).powi(2) + (y as f64 / 1024.0).powi(2);
            let exact = (f64::from(77_u8) + 1.0 - (square.log2() / 2.0).log2()) * 2048.0;
            let step = (exact - exact.round()) * 2_f64.powi(13);
            if step.abs() > 1.0 {
                assert_eq!(f64::from(limit(x << 10, y << 10, 77).to_bits()), exact.floor(), "{x} {y}");
                tried += 1;
                // these would notice a constant that is off by 3e-6
                beside += u32::from(step.abs() < 24.0);
            }
        }
        assert!(tried > 190_000 && beside > 200, "{beside} of {tried}");
        // powers of 2 have exact logarithms: log2(log2 |z|) = 4
        assert_eq!(limit(1 << 36, 0, 5), U21F11::from_num(2));
    }
}
