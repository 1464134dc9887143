//! What the escape-time pictures have in common, for the types that colour them in another way or draw them faster.

use core::fmt::Debug;
use core::iter::FusedIterator;
use core::ops::Range;

use super::Dwell;
use super::block::{Block, Number};
use super::period::Period;
use crate::Error;
use crate::picture::Symmetric;

/// A picture whose pixels are dwells of orbits of `z^2 + c`: [`Mandelbrot`](super::Mandelbrot), [`Julia`](super::Julia) and
/// [`DeepMandelbrot`](super::DeepMandelbrot).
pub trait EscapeTime: Symmetric<Value = Dwell> {
    /// What an orbit belongs to: a point of the plane, or in a deep view the column and row of a pixel.
    type Point: Copy;
    /// The points of a part of a row.
    type Line: ExactSizeIterator<Item = Self::Point> + FusedIterator + Clone + Debug;

    /// The points of a part of a row, from left to right.
    fn line(&self, row: u32, columns: Range<u32>) -> Self::Line;
    /// The dwell of a point that does not escape.
    fn max_dwell(&self) -> u32;
    /// The dwell at a point.
    fn dwell_at(&self, point: Self::Point) -> Dwell;
    /// Where the orbit of a point is when it escapes; none where it does not.
    fn ending(&self, point: Self::Point) -> Option<Ending>;
    /// The same with the derivative by the point.
    fn ending_with_derivative(&self, point: Self::Point) -> Option<Ending>;
    /// The cycle that the orbit of a point is drawn to.
    fn period_at(&self, point: Self::Point) -> Period;
    /// The distance of two neighbouring pixels: `mantissa 2^exponent`, the mantissa at least `2^28`.
    fn pitch(&self) -> (u32, i32);
    /// The same picture, moved by whole pixels to the right and up.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] where the view ends.
    fn panned(self, right: i32, up: i32) -> Result<Self, Error>
    where
        Self: Sized;
}

/// The last point of an orbit that matters: near 2 or beyond, and what goes on from there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ending {
    /// How many steps the point is away from the first, `c` or a Julia set's start.
    pub(super) steps: u32,
    pub(super) z: Block,
    pub(super) c: Block,
    /// By the point; only where it was asked for.
    pub(super) derivative: Block,
    /// What it gains at each step: 1 where the constant moves with the point.
    pub(super) gain: Block,
}

/// An orbit in words, of any width.
pub(super) trait Steps: Copy {
    /// The next point, wrapped, for a point within 2.
    fn step(&mut self);
    fn z(&self) -> Block;
    fn c(&self) -> Block;
}

/// The last point within 2 of an orbit of this dwell. `gain` is what the derivative gains at each step.
pub(super) fn follow<const DERIVATIVE: bool, O: Steps>(mut orbit: O, dwell: u32, gain: Block) -> Ending {
    let mut derivative = Block::<i32>::ONE;
    let steps = dwell.saturating_sub(1);
    for _ in 0..steps {
        if DERIVATIVE {
            derivative = orbit.z().times(derivative).doubled().plus(gain);
        }
        orbit.step();
    }
    Ending { steps, z: orbit.z(), c: orbit.c(), derivative, gain }
}
