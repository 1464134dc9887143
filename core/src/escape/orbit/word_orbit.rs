//! The orbit of a point in 32-bit words, point by point: for smooth colours, distances and periods, which
//! look at more of it than its dwell.
//!
//! Step by step its points are those that the dwell was counted on, rounding and all; for periods it always
//! has 29 bits.

use crate::escape::orbit::arithmetic::Arithmetic;
use crate::escape::orbit::block_float::BlockFloat;
use crate::escape::orbit::cardioid;
use crate::escape::orbit::cycle::{self, Path, Size};
use crate::escape::orbit::dwell::{FOUR, FRACTION_Q29, Fine, Point29, Rounding, is_beyond};
use crate::escape::orbit::ending::{Ending, Steps, follow};
use crate::escape::orbit::upper::Upper;
use crate::escape::value::Dwell;
use crate::num::Wide;
use crate::num::{Complex, product};

/// The orbit of a point: where it starts, the constant, and how it is rounded: as where the dwell is counted.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WordOrbit {
    pub(crate) z: Point29,
    pub(crate) c: Point29,
    pub(crate) arithmetic: Arithmetic,
}

impl Steps for WordOrbit {
    #[inline]
    fn step(&mut self) {
        self.z = self.arithmetic.next(self.z, self.c);
    }

    #[inline]
    fn z(&self) -> BlockFloat {
        block(self.z)
    }

    fn c(&self) -> BlockFloat {
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
        ((self >> 32) as u32, 32 - 2 * FRACTION_Q29 as i32)
    }
}

#[inline(always)]
fn square((x, y): (i32, i32)) -> u64 {
    // each at most 2^62
    product(x, x) as u64 + product(y, y) as u64
}

impl Path for WordOrbit {
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

    fn z(&self) -> BlockFloat {
        block(self.z)
    }

    fn off(&self, other: &Self) -> BlockFloat {
        // each within 2
        block((self.z.0.wrapping_sub(other.z.0), self.z.1.wrapping_sub(other.z.1)))
    }

    fn blur(&self) -> Upper {
        self.step_error()
    }

    fn step_error(&self) -> Upper {
        // below a unit in each part
        Upper::power(1 - FRACTION_Q29 as i32)
    }
}

fn block((x, y): Point29) -> BlockFloat {
    BlockFloat::<i32>::new(i64::from(x), i64::from(y), -(FRACTION_Q29 as i32))
}

/// A point beyond 2 is no word: 20 fractional bits, as many of them as a block holds.
fn beyond(z: Complex<Wide>, c: Complex<Wide>, gain: BlockFloat) -> Ending {
    let block = |v: Complex<Wide>| BlockFloat::<i32>::new(v.re.to_bits() >> 28, v.im.to_bits() >> 28, -20);
    Ending { steps: 0, z: block(z), c: block(c), derivative: BlockFloat::<i32>::ONE, gain }
}

/// The cycle that an orbit is drawn to, by formula where there is one: for the orbit of 0, which goes on from
/// `c`. From elsewhere an orbit may escape whatever the constant.
pub(crate) fn period(orbit: WordOrbit, max: u32) -> Option<u32> {
    if is_beyond(orbit.c) {
        return None;
    }
    let by_formula = if orbit.z == orbit.c { cardioid::period(orbit.c) } else { None };
    by_formula.or_else(|| cycle::period(orbit, max))
}

/// How the orbit of `z` under the constant `c` ends; none inside. Without an orbit the start is beyond 2
/// already.
pub(crate) fn ending<const DERIVATIVE: bool>(
    dwell: Dwell,
    orbit: Option<WordOrbit>,
    (z, c): (Complex<Wide>, Complex<Wide>),
    gain: BlockFloat,
) -> Option<Ending> {
    if dwell.is_inside() {
        return None;
    }
    Some(orbit.map_or_else(|| beyond(z, c, gain), |orbit| follow::<DERIVATIVE, _>(orbit, dwell.count, gain)))
}
