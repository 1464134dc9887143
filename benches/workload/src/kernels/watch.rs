//! What a loop is timed with, and what it tells.

use core::fmt;
use core::hint::black_box;

use crate::machine::Machine;

/// What one run of a loop did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tally {
    /// Over all results. Equal on every machine for fixed point; floating point owes nothing.
    pub checksum: u32,
    /// Units of work: calls, iterations, points, ...
    pub units: u32,
}

/// Times the part of a loop that counts.
pub struct Watch<'m> {
    machine: &'m mut dyn Machine,
    times: u32,
    spent: u32,
}

impl fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Watch")
            .field("times", &self.times)
            .field("spent", &self.spent)
            .finish_non_exhaustive()
    }
}

impl<'m> Watch<'m> {
    /// A watch that lets the work be done so many times: once, but for a histogram.
    pub fn new(machine: &'m mut dyn Machine, times: u32) -> Self {
        Self { machine, times, spent: 0 }
    }

    /// Instructions of what was timed, reading the counter included: a loop that does nothing tells how many
    /// these are.
    pub const fn spent(&self) -> u32 {
        self.spent
    }

    /// Does `work` and counts its instructions.
    #[inline(always)]
    pub fn time(&mut self, mut work: impl FnMut() -> Tally) -> Tally {
        let mut tally = Tally::default();
        let before = self.machine.instructions();
        for _ in 0..self.times {
            tally = black_box(work());
        }
        let after = self.machine.instructions();
        self.spent = after.wrapping_sub(before);
        tally
    }

    /// Times `kernel` on every input. The checksum costs one instruction a result on a machine with a barrel
    /// shifter.
    #[inline(always)]
    pub(super) fn over<T: Copy>(&mut self, inputs: &[T], mut kernel: impl FnMut(T) -> u32) -> Tally {
        self.time(|| {
            let mut checksum = 0_u32;
            for input in black_box(inputs) {
                checksum = checksum.rotate_left(1) ^ kernel(*input);
            }
            Tally { checksum, units: inputs.len() as u32 }
        })
    }
}

/// A loop that can be run again and again.
pub type Loop = fn(&mut Watch<'_>) -> Tally;
