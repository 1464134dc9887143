//! The interior by period: colours each point of the set by the length of the cycle that its orbit is drawn
//! to, so that the discs and cardioids which the set is made of stand out, each in the colour of its period.
//!
//! Source: B. Branner, "The Mandelbrot set", 1989: each hyperbolic component is the set of `c` whose orbits
//! tend to a cycle of one length. The cardioid and the disc of period 2 are known by formula; elsewhere the
//! multiplier shows when an orbit has come near its cycle (`crate::escape::orbit::cycle`).

use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use crate::escape::set::escape_time::EscapeTime;
use crate::escape::value::Period;
use crate::plane::{Field, along};

/// The period at every pixel of an escape-time picture.
///
/// ```
/// use attractor::num::Complex;
/// use attractor::escape::{Interior, Mandelbrot, Period, View};
/// use attractor::num::Wide;
/// use embedded_graphics_core::geometry::Size;
/// let interior = Interior(Mandelbrot::new(View::home(Size::new(24, 20))?, 1000)?);
/// let at = |re: f32| interior.value_at(Complex::new(Wide::from_num(re), Wide::ZERO));
/// assert_eq!([at(0.0), at(-1.0), at(-1.755)], [1, 2, 3].map(Period::new));
/// assert_eq!(at(1.0), None);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Interior<P>(
    /// The picture.
    pub P,
);

impl<P: EscapeTime> Interior<P> {
    /// The period at a point.
    ///
    /// Domain: all. Error: what is found is proven for the point as the arithmetic rounds it, so that an
    /// orbit that escapes has none, however late (`an_orbit_that_escapes_has_no_period_however_late`,
    /// `periods_are_those_of_float`); none is found on the edges of components, where an orbit is drawn in
    /// too slowly or rounding hides it. Cost: until the orbit escapes or is near its cycle, at most the
    /// greatest dwell, but at least 4096 and never more than 65,536 steps, and for each doubling a few cycles
    /// of at most [`MAX_PERIOD`](crate::escape::MAX_PERIOD): fewer than 131,072 steps in every arithmetic
    /// (`a_period_takes_a_bounded_number_of_steps`, `perturbation_takes_a_bounded_number_of_steps`). Nothing
    /// is iterated in the cardioid and the disc of period 2, except by perturbation and for Julia sets.
    pub fn value_at(&self, point: P::Point) -> Option<Period> {
        self.0.period_at(point)
    }
}

impl<P: EscapeTime> Field for Interior<P> {
    type Value = Option<Period>;

    fn size(&self) -> Size {
        self.0.size()
    }

    fn at(&self, x: u32, y: u32) -> Option<Period> {
        self.value_at(self.0.point_at(x, y))
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Option<Period>> {
        along(self.0.line(y, x), |point| self.value_at(point))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::escape::MAX_PERIOD;
    use crate::escape::{Julia, Mandelbrot, View};
    use crate::num::Complex;
    use crate::num::Wide;

    /// The period after 20000 steps in `f64`, none near the edge of a component.
    fn float(c: (f64, f64)) -> Option<u32> {
        let step = |(x, y): (f64, f64)| (x * x - y * y + c.0, 2.0 * x * y + c.1);
        let mut z = (0.0, 0.0);
        for _ in 0..20_000 {
            z = step(z);
        }
        let (mut w, mut multiplier) = (z, 1.0);
        for period in 1..=MAX_PERIOD {
            multiplier *= 2.0 * w.0.hypot(w.1);
            w = step(w);
            if (w.0 - z.0).abs().max((w.1 - z.1).abs()) < 1e-9 {
                return (multiplier.powf(1000.0 / f64::from(period)) < 1e-8).then_some(period);
            }
        }
        None
    }

    #[test]
    fn periods_are_those_of_float() {
        let view = View::home(Size::new(120, 100)).unwrap();
        let picture = Interior(Mandelbrot::new(view, 1000).unwrap());
        let mut found = [0; 8];
        for (x, y) in (0..100).flat_map(|y| (0..120).map(move |x| (x, y))) {
            let c = view.point(x, y);
            let Some(period) = picture.value_at(c).map(Period::length) else { continue };
            if let Some(expected) = float((c.re.to_num(), c.im.to_num())) {
                assert_eq!(period, expected, "{c:?}");
                found[(period as usize).min(7)] += 1;
            }
        }
        assert!(found[1] > 1000 && found[2] > 200 && found[3] > 50 && found[4] > 10, "{found:?}");
    }

    #[test]
    fn every_point_of_the_cardioid_has_period_1() {
        // the view of scenes/mandelbrot-periods.toml; and a short dwell blanks nothing
        let centre = Complex::new(Wide::from_num(-0.3), Wide::from_num(0.75));
        let view = View::new(centre, Wide::ONE, Size::new(240, 240)).unwrap();
        for max in [2, 1000] {
            let picture = Interior(Mandelbrot::new(view, max).unwrap());
            let (mut inside, mut missed) = (0, 0);
            for (x, y) in (0..240).flat_map(|y| (0..240).map(move |x| (x, y))) {
                let c = view.point(x, y);
                let (re, im): (f64, f64) = (c.re.to_num(), c.im.to_num());
                let q = (re - 0.25).powi(2) + im * im;
                if q * (q + re - 0.25) < im * im / 4.0 {
                    inside += 1;
                    missed += u32::from(picture.value_at(c) != Period::new(1));
                }
            }
            assert!(inside > 16_000 && missed == 0, "{missed} of {inside} at {max}");
        }
    }

    #[test]
    fn a_whole_julia_set_has_one_period() {
        let view = View::new(Complex::default(), Wide::from_num(4), Size::new(50, 50)).unwrap();
        let rabbit = Complex::new(Wide::from_num(-0.1226), Wide::from_num(0.7449));
        let picture = Interior(Julia::new(view, rabbit, 500).unwrap());
        let inside = || (0..50).flat_map(|y| picture.row(y, 0..50)).flatten();
        assert_eq!(inside().min(), Period::new(3));
        assert_eq!(inside().max(), Period::new(3));
        assert!(inside().count() > 100);
    }

    #[test]
    fn a_start_that_escapes_has_no_period_whatever_the_constant() {
        // constants in the cardioid and in the disc of period 2, where a formula tells the period of 0
        let view = View::new(Complex::default(), Wide::from_num(4), Size::new(64, 64)).unwrap();
        for (c, length) in [((0.0, 0.0), 1), ((0.1, 0.3), 1), ((-1.0, 0.0), 2), ((-0.95, 0.1), 2)] {
            let julia =
                Julia::new(view, Complex::new(Wide::from_num(c.0), Wide::from_num(c.1)), 1000).unwrap();
            let (mut inside, mut outside, mut missed) = (0, 0, 0);
            for (x, y) in (0..64).flat_map(|y| (0..64).map(move |x| (x, y))) {
                let period = Interior(julia).at(x, y);
                if julia.at(x, y).is_inside() {
                    inside += 1;
                    missed += u32::from(period != Period::new(length));
                } else {
                    outside += 1;
                    assert_eq!(period, None, "{c:?} at {x}, {y}");
                }
            }
            assert!(inside > 300 && outside > 1500 && missed == 0, "{c:?}: {missed} of {inside}, {outside}");
            // the orbit of the constant is that of 0
            assert_eq!(Interior(julia).value_at(julia.constant()), Period::new(length));
        }
        let disc = Julia::new(view, Complex::default(), 1000).unwrap();
        assert_eq!(Interior(disc).value_at(Complex::new(Wide::lit("1.5"), Wide::ZERO)), None);
    }
}
