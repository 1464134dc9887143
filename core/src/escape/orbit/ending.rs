//! How an orbit ends: its last point within 2, from which the colourings go on.
//!
//! The dwell only counts. Smooth colours and distances also need to know where the orbit was when it escaped;
//! an orbit in words is followed once more for that, with the derivative if it is asked for.

use super::block_float::{BlockFloat, Number};

/// The last point of an orbit that matters, near 2 or beyond, and what is needed to go on from there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ending {
    /// How many steps the point is away from the first, `c` or a Julia set's start.
    pub(crate) steps: u32,
    pub(crate) z: BlockFloat,
    pub(crate) c: BlockFloat,
    /// Of `z` by the point that the orbit belongs to; only where it was asked for.
    pub(crate) derivative: BlockFloat,
    /// What the derivative gains at each step: 1 where the constant moves with the point, else 0.
    pub(crate) gain: BlockFloat,
}

/// An orbit in words, of any width.
pub(crate) trait Steps: Copy {
    /// The next point, wrapped, for a point within 2.
    fn step(&mut self);
    fn z(&self) -> BlockFloat;
    fn c(&self) -> BlockFloat;
}

/// The last point within 2 of an orbit of this dwell. `gain` is what the derivative gains at each step.
pub(crate) fn follow<const DERIVATIVE: bool, O: Steps>(mut orbit: O, dwell: u32, gain: BlockFloat) -> Ending {
    let mut derivative = BlockFloat::<i32>::ONE;
    let steps = dwell.saturating_sub(1);
    for _ in 0..steps {
        if DERIVATIVE {
            derivative = orbit.z().times(derivative).doubled().plus(gain);
        }
        orbit.step();
    }
    Ending { steps, z: orbit.z(), c: orbit.c(), derivative, gain }
}
