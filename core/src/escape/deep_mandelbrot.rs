//! The Mandelbrot set as deep as the coordinates reach: 64 bits, 128 bits, or perturbation, by the distance of two pixels.

use core::iter::FusedIterator;
use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use super::block::Block;
use super::perturbation::{OrbitPoint, Reference};
use super::{Complex, DeepView, Dwell, checked_max, wide_dwell};
use crate::Error;
use crate::num::Limbs;
use crate::picture::Field;

/// How the orbits of a deep view are computed.
///
/// Cost in Cortex-M4 instructions, counted with QEMU: an iteration 58 in 64 bits, 256 in 128, 157 to 182 by perturbation; a point of a reference orbit in
/// 12 limbs 7900.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Arithmetic {
    /// Q4.60: the default for a pitch of at least `2^-52`.
    Word64,
    /// Q4.124: the default for a pitch of at least `2^-104`.
    Word128,
    /// One reference orbit, and blocks of 30 bits for the distance of each pixel from it: the default for every deeper view.
    Perturbed,
}

impl Arithmetic {
    /// What suits a pitch of `2^exponent` and more: 8 and 20 bits behind a pixel (below that perturbation is better and costs less). At chaotic places
    /// that shows all the same: at the spiral `M_{4,1}` 10 of 1600 pixels differ in 128 bits at a pitch of `2^-112`, 15 in 64 bits at `2^-48`.
    pub const fn of(exponent: i32) -> Self {
        match exponent {
            -52.. => Self::Word64,
            -104.. => Self::Word128,
            _ => Self::Perturbed,
        }
    }
}

/// The dwell at every pixel of a deep view.
///
/// ```
/// use attractor::escape::{Arithmetic, DeepMandelbrot, DeepView, OrbitPoint};
/// use attractor::picture::Field;
/// use embedded_graphics_core::geometry::Size;
/// // the Misiurewicz point i, where the set looks the same at every depth
/// let view = DeepView::<12>::parse("0", "1", "1e-100", Size::new(9, 9))?;
/// let mut orbit = [OrbitPoint::default(); 400];
/// let picture = DeepMandelbrot::new(view, 400, &mut orbit)?;
/// assert_eq!(picture.arithmetic(), Arithmetic::Perturbed);
/// let row: Vec<u32> = picture.row(3, 0..9).map(|d| d.count).collect();
/// assert!(row.iter().all(|count| (255..285).contains(count)), "{row:?}");
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct DeepMandelbrot<'a, const LIMBS: usize> {
    view: DeepView<LIMBS>,
    max: u32,
    arithmetic: Arithmetic,
    reference: Option<Reference<'a>>,
    half_pitch: Block,
}

impl<'a, const LIMBS: usize> DeepMandelbrot<'a, LIMBS> {
    /// The set as `view` shows it, with at most `max_dwell` iterations a pixel. `orbit` is used by perturbation only: `max_dwell` points;
    /// where 128 bits are enough it may be empty ([`DeepMandelbrot::orbit_points`]).
    ///
    /// # Errors
    /// [`Error::TooFew`] and [`Error::Capacity`] for the iterations as in [`Mandelbrot`](super::Mandelbrot); [`Error::BufferLength`] for a short `orbit`.
    pub fn new(view: DeepView<LIMBS>, max_dwell: u32, orbit: &'a mut [OrbitPoint]) -> Result<Self, Error> {
        Self::with_arithmetic(view, max_dwell, Arithmetic::of(view.pitch_exponent()), orbit)
    }

    /// The same with another arithmetic than the one that suits the view.
    ///
    /// # Errors
    /// As [`DeepMandelbrot::new`].
    pub fn with_arithmetic(
        view: DeepView<LIMBS>,
        max_dwell: u32,
        arithmetic: Arithmetic,
        orbit: &'a mut [OrbitPoint],
    ) -> Result<Self, Error> {
        let max = checked_max(max_dwell)?;
        let reference = match arithmetic {
            Arithmetic::Perturbed => Some(Reference::new(view.centre(), max, orbit)?),
            _ => None,
        };
        Ok(Self { view, max, arithmetic, reference, half_pitch: view.half_pitch_block() })
    }

    /// How many points a picture of this view takes from the lent orbit.
    pub fn orbit_points(view: &DeepView<LIMBS>, max_dwell: u32) -> usize {
        match Arithmetic::of(view.pitch_exponent()) {
            Arithmetic::Perturbed => (max_dwell as usize).max(2),
            _ => 0,
        }
    }

    /// The view.
    pub const fn view(&self) -> &DeepView<LIMBS> {
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

    /// The length of the reference orbit, which ends where it escapes; 0 without one.
    pub fn reference_len(&self) -> usize {
        self.reference.map_or(0, |reference| reference.len())
    }

    /// The dwell at the middle of a pixel.
    ///
    /// Domain: inside the view; others count as the nearest pixel.
    pub fn dwell_at(&self, column: u32, row: u32) -> Dwell {
        let count = match (self.reference, self.arithmetic) {
            (Some(reference), _) => {
                let (across, up) = self.view.steps(column, row);
                let mantissa = i64::from(self.half_pitch.re);
                let offset = Block::new(
                    i64::from(across) * mantissa,
                    i64::from(up) * mantissa,
                    self.half_pitch.exponent,
                );
                reference.dwell(offset, self.max)
            }
            (None, Arithmetic::Word64) => {
                let c = self.view.point(column, row);
                let nearest = |v: i128| ((v + (1 << 63)) >> 64) as i64;
                let c = (nearest(c.re.top128()), nearest(c.im.top128()));
                wide_dwell::dwell(c, c, self.max)
            }
            (None, _) => {
                let c: Complex<Limbs<LIMBS>> = self.view.point(column, row);
                let c = (c.re.top128(), c.im.top128());
                wide_dwell::dwell(c, c, self.max)
            }
        };
        Dwell { count, max: self.max }
    }
}

impl<const LIMBS: usize> Field for DeepMandelbrot<'_, LIMBS> {
    type Value = Dwell;
    type Row<'b>
        = DeepRow<'b, LIMBS>
    where
        Self: 'b;

    fn size(&self) -> Size {
        self.view.size()
    }

    fn row(&self, y: u32, x: Range<u32>) -> DeepRow<'_, LIMBS> {
        DeepRow { picture: self, y, columns: x }
    }
}

/// The dwells of a row, from left to right.
#[derive(Debug, Clone)]
pub struct DeepRow<'a, const LIMBS: usize> {
    picture: &'a DeepMandelbrot<'a, LIMBS>,
    y: u32,
    columns: Range<u32>,
}

impl<const LIMBS: usize> Iterator for DeepRow<'_, LIMBS> {
    type Item = Dwell;

    #[inline]
    fn next(&mut self) -> Option<Dwell> {
        self.columns.next().map(|x| self.picture.dwell_at(x, self.y))
    }

    #[inline]
    fn nth(&mut self, n: usize) -> Option<Dwell> {
        self.columns.nth(n).map(|x| self.picture.dwell_at(x, self.y))
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.columns.size_hint()
    }
}

impl<const LIMBS: usize> ExactSizeIterator for DeepRow<'_, LIMBS> {}
impl<const LIMBS: usize> FusedIterator for DeepRow<'_, LIMBS> {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::escape::{Mandelbrot, Precision, View};
    use crate::num::Wide;

    #[test]
    fn every_arithmetic_shows_the_same_picture_of_a_shallow_view() {
        let size = Size::new(40, 30);
        let view = DeepView::<4>::parse("-0.74", "0.13", "0.05", size).unwrap();
        let narrow = View::new(
            Complex::new(view.centre().re.to_wide(), view.centre().im.to_wide()),
            view.width().to_wide(),
            size,
        );
        let narrow = Mandelbrot::new(narrow.unwrap(), 300).unwrap().with_precision(Precision::Fine29);
        let mut orbit = [OrbitPoint::default(); 300];
        for arithmetic in [Arithmetic::Word64, Arithmetic::Word128, Arithmetic::Perturbed] {
            let picture = DeepMandelbrot::with_arithmetic(view, 300, arithmetic, &mut orbit).unwrap();
            let differ = (0..30)
                .map(|y| picture.row(y, 0..40).zip(narrow.row(y, 0..40)).filter(|(a, b)| a != b).count());
            assert!(differ.sum::<usize>() <= 4, "{arithmetic:?}");
        }
    }

    #[test]
    fn the_pitch_chooses_the_arithmetic() {
        let of = |width: &str| {
            let view = DeepView::<12>::parse("-0.75", "0.1", width, Size::new(64, 64)).unwrap();
            (Arithmetic::of(view.pitch_exponent()), DeepMandelbrot::orbit_points(&view, 700))
        };
        assert_eq!(of("1"), (Arithmetic::Word64, 0));
        assert_eq!(of("2e-14"), (Arithmetic::Word64, 0));
        assert_eq!(of("1e-14"), (Arithmetic::Word128, 0));
        assert_eq!(of("4e-30"), (Arithmetic::Word128, 0));
        assert_eq!(of("2e-30"), (Arithmetic::Perturbed, 700));
    }

    #[test]
    fn a_short_orbit_names_the_length_it_needs() {
        let view = DeepView::<12>::parse("-0.75", "0.1", "1e-50", Size::new(8, 8)).unwrap();
        let mut orbit = [OrbitPoint::default(); 99];
        let error = DeepMandelbrot::new(view, 100, &mut orbit).unwrap_err();
        assert_eq!(error, Error::BufferLength { given: 99, needed: 100 });
        assert!(DeepMandelbrot::new(view, 99, &mut orbit).is_ok());
        assert!(DeepMandelbrot::new(view, 0, &mut orbit).is_err());
    }

    #[test]
    fn a_reference_that_escapes_at_once_serves_all_the_same() {
        // the centre is outside and escapes early, the left part is inside
        let size = Size::new(40, 40);
        let view = DeepView::<4>::parse("0.4", "0.4", "1.5", size).unwrap();
        let mut orbit = [OrbitPoint::default(); 200];
        let perturbed =
            DeepMandelbrot::with_arithmetic(view, 200, Arithmetic::Perturbed, &mut orbit).unwrap();
        assert!(perturbed.reference_len() < 20);
        let plain = DeepMandelbrot::with_arithmetic(view, 200, Arithmetic::Word128, &mut []).unwrap();
        let mut inside = 0;
        for y in 0..40 {
            for (a, b) in perturbed.row(y, 0..40).zip(plain.row(y, 0..40)) {
                assert_eq!(a, b);
                inside += u32::from(a.is_inside());
            }
        }
        assert!(inside > 100);
        assert_eq!(Wide::ONE, 1);
    }
}
