//! Orbits in 32-bit words, and what the pictures made of them have in common.

use core::ops::Range;

use super::block::Block;
use super::cycle::{self, Path, Size};
use super::dwell::{FOUR, FRACTION, Fine, Step, Word, is_beyond};
use super::escape_time::{Ending, EscapeTime, Steps, follow};
use super::interior;
use super::period::Period;
use super::precision::Precision;
use super::upper::Upper;
use super::view::Line;
use super::{Complex, Dwell, Julia, Mandelbrot};
use crate::Error;
use crate::num::{Wide, product};
use crate::picture::Symmetric;

/// The orbit of a point: where it starts, the constant, and how it is rounded: as where the dwell is counted.
#[derive(Debug, Clone, Copy)]
pub(super) struct Orbit {
    pub(super) z: Word,
    pub(super) c: Word,
    pub(super) precision: Precision,
}

impl Steps for Orbit {
    #[inline]
    fn step(&mut self) {
        self.z = self.precision.next(self.z, self.c);
    }

    #[inline]
    fn z(&self) -> Block {
        block(self.z)
    }

    fn c(&self) -> Block {
        block(self.c)
    }
}

/// `|z|^2` with 58 fractional bits.
impl Size for u64 {
    #[inline(always)]
    fn is_below(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn reached(self) -> (u32, i32) {
        ((self >> 32) as u32, 32 - 2 * FRACTION as i32)
    }
}

#[inline(always)]
fn square((x, y): (i32, i32)) -> u64 {
    // each at most 2^62
    product(x, x) as u64 + product(y, y) as u64
}

impl Path for Orbit {
    type Size = u64;

    #[inline]
    fn size(&self) -> u64 {
        square(self.z)
    }

    #[inline]
    fn apart(&self, other: &Self) -> u64 {
        square((self.z.0.wrapping_sub(other.z.0), self.z.1.wrapping_sub(other.z.1)))
    }

    fn run(&mut self, steps: u32) -> bool {
        let mut z = self.z;
        if is_beyond(z) {
            return false;
        }
        for _ in 0..steps {
            // as `next`
            z = Fine::step(z, self.c);
            if square(z) > FOUR {
                return false;
            }
        }
        self.z = z;
        true
    }

    #[inline]
    fn next(&mut self) -> bool {
        // |c| <= 2: no point beyond 2 wraps into the disc but 6, at c = 2
        self.z = Fine::step(self.z, self.c);
        square(self.z) <= FOUR
    }

    fn z(&self) -> Block {
        block(self.z)
    }

    fn off(&self, other: &Self) -> Block {
        // each within 2
        block((self.z.0.wrapping_sub(other.z.0), self.z.1.wrapping_sub(other.z.1)))
    }

    fn blur(&self) -> Upper {
        self.step_error()
    }

    fn step_error(&self) -> Upper {
        // below a unit in each part
        Upper::power(1 - FRACTION as i32)
    }
}

fn block((x, y): Word) -> Block {
    Block::<i32>::new(i64::from(x), i64::from(y), -(FRACTION as i32))
}

/// A point beyond 2 is no word: 20 fractional bits, as many of them as a block holds.
fn beyond(z: Complex<Wide>, c: Complex<Wide>, gain: Block) -> Ending {
    let block = |v: Complex<Wide>| Block::<i32>::new(v.re.to_bits() >> 28, v.im.to_bits() >> 28, -20);
    Ending { steps: 0, z: block(z), c: block(c), derivative: Block::<i32>::ONE, gain }
}

macro_rules! escape_time {
    ($($picture:ty, gain: $gain:ident;)*) => {$(
        impl Symmetric for $picture {
            fn mirror_image(&self, row: u32) -> Option<u32> {
                // conjugate points have the same dwell where the constant is conjugate too
                self.view().mirror_image(row).filter(|_| Block::<i32>::$gain == Block::<i32>::ONE)
            }
        }

        impl EscapeTime for $picture {
            type Point = Complex<Wide>;
            type Line = Line;

            fn line(&self, row: u32, columns: Range<u32>) -> Line {
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
                ending::<false>(self.dwell_at(point), self.orbit_of(point), (point, self.constant_of(point)), Block::<i32>::$gain)
            }

            fn ending_with_derivative(&self, point: Complex<Wide>) -> Option<Ending> {
                ending::<true>(self.dwell_at(point), self.orbit_of(point), (point, self.constant_of(point)), Block::<i32>::$gain)
            }

            fn period_at(&self, point: Complex<Wide>) -> Period {
                let max = self.max_dwell();
                Period(self.orbit_of(point).map_or(0, |orbit| period(orbit, max)))
            }

            fn pitch(&self) -> (u32, i32) {
                // at least 2^19 units
                let pitch = Block::<i32>::new(self.view().pitch().to_bits(), 0, -(Wide::FRAC_NBITS as i32));
                (pitch.re.unsigned_abs(), pitch.exponent)
            }

            fn panned(self, right: i32, up: i32) -> Result<Self, Error> {
                let view = self.view().pan(right, up)?;
                Ok(self.through(view))
            }
        }
    )*};
}

escape_time! { Mandelbrot, gain: ONE; Julia, gain: ZERO; }

/// By formula where there is one; 0 for none.
fn period(orbit: Orbit, max: u32) -> u32 {
    if is_beyond(orbit.c) {
        return 0;
    }
    // a formula knows at once
    interior::period(orbit.c).or_else(|| cycle::period(orbit, max)).unwrap_or(0)
}

fn ending<const DERIVATIVE: bool>(
    dwell: Dwell,
    orbit: Option<Orbit>,
    (z, c): (Complex<Wide>, Complex<Wide>),
    gain: Block,
) -> Option<Ending> {
    if dwell.is_inside() {
        return None;
    }
    Some(orbit.map_or_else(|| beyond(z, c, gain), |orbit| follow::<DERIVATIVE, _>(orbit, dwell.count, gain)))
}
