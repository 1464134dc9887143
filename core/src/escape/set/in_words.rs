//! [`EscapeTime`] for the pictures in 32-bit words, [`Mandelbrot`] and [`Julia`], which differ only in what
//! the derivative of an orbit gains at each step.

use core::iter::FusedIterator;
use core::ops::Range;

use super::escape_time::{EscapeTime, Pan};
use super::julia::Julia;
use super::mandelbrot::Mandelbrot;
use crate::Error;
use crate::escape::orbit::block_float::BlockFloat;
use crate::escape::orbit::ending::Ending;
use crate::escape::orbit::word_orbit;
use crate::escape::value::{Dwell, Period};
use crate::num::{Complex, Wide};
use crate::plane::Symmetric;

macro_rules! escape_time {
    ($($picture:ty, gain: $gain:ident;)*) => {$(
        impl Symmetric for $picture {
            fn mirror_image(&self, row: u32) -> Option<u32> {
                // conjugate points have the same dwell where the constant is conjugate too
                self.view().mirror_image(row).filter(|_| BlockFloat::<i32>::$gain == BlockFloat::<i32>::ONE)
            }
        }

        impl EscapeTime for $picture {
            type Point = Complex<Wide>;

            #[inline]
            fn point_at(&self, column: u32, row: u32) -> Complex<Wide> {
                self.view().point(column, row)
            }

            #[inline]
            fn line(
                &self,
                row: u32,
                columns: Range<u32>,
            ) -> impl ExactSizeIterator<Item = Complex<Wide>> + FusedIterator {
                self.view().line(row, columns)
            }

            fn max_dwell(&self) -> u32 {
                self.max_dwell()
            }

            #[inline]
            fn dwell_at(&self, point: Complex<Wide>) -> Dwell {
                self.dwell_at(point)
            }

            fn ending(&self, point: Complex<Wide>) -> Option<Ending> {
                word_orbit::ending::<false>(self.dwell_at(point), self.orbit_of(point), (point, self.constant_of(point)), BlockFloat::<i32>::$gain)
            }

            fn ending_with_derivative(&self, point: Complex<Wide>) -> Option<Ending> {
                word_orbit::ending::<true>(self.dwell_at(point), self.orbit_of(point), (point, self.constant_of(point)), BlockFloat::<i32>::$gain)
            }

            fn period_at(&self, point: Complex<Wide>) -> Option<Period> {
                word_orbit::period(self.orbit_of(point)?, self.max_dwell()).and_then(Period::new)
            }

            fn pitch(&self) -> (u32, i32) {
                // at least 2^19 units
                let pitch = BlockFloat::<i32>::new(self.view().pitch().to_bits(), 0, -(Wide::FRAC_NBITS as i32));
                (pitch.re.unsigned_abs(), pitch.exponent)
            }
        }

        impl Pan for $picture {
            fn pan(&mut self, right: i32, up: i32) -> Result<(), Error> {
                self.set_view(self.view().pan(right, up)?);
                Ok(())
            }
        }
    )*};
}

escape_time! { Mandelbrot, gain: ONE; Julia, gain: ZERO; }
