//! Inner loops, counted by the unit of work.
//!
//! To add one: write its loops beside those of its room, each with [`over`] or by hand, and add a line to [`all`].
//! A loop returns a checksum of everything it computed (so that nothing is optimised away, and so that host and target can be
//! compared) and how many units of work it did.

mod num;

use core::hint::black_box;

/// What one run of a loop did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tally {
    /// Over all results. Equal on every machine for fixed point; floating point owes nothing.
    pub checksum: u32,
    /// Units of work: calls, iterations, points, ...
    pub units: u32,
}

/// A loop that can be run again and again.
pub type Loop = fn() -> Tally;

/// One row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Kernel {
    /// What is computed.
    pub name: &'static str,
    /// What is counted.
    pub unit: &'static str,
    /// The loop of core.
    pub fixed: Loop,
    /// The same in single precision.
    pub f32: Option<Loop>,
    /// The same in double precision.
    pub f64: Option<Loop>,
}

impl Kernel {
    const fn new(name: &'static str, unit: &'static str, fixed: Loop, f32: Loop, f64: Loop) -> Self {
        Self { name, unit, fixed, f32: Some(f32), f64: Some(f64) }
    }
}

/// The table. The first row is the floor: what the loop, its loads and its checksum cost alone.
pub static ALL: &[Kernel] = &[
    Kernel::new("identity", "call", num::identity_fixed, num::identity_f32, num::identity_f64),
    Kernel::new("reciprocal", "call", num::reciprocal_fixed, num::reciprocal_f32, num::reciprocal_f64),
    Kernel::new(
        "reciprocal_sqrt",
        "call",
        num::reciprocal_sqrt_fixed,
        num::reciprocal_sqrt_f32,
        num::reciprocal_sqrt_f64,
    ),
    Kernel::new("sqrt", "call", num::sqrt_fixed, num::sqrt_f32, num::sqrt_f64),
    Kernel::new("sin_cos", "call", num::sin_cos_fixed, num::sin_cos_f32, num::sin_cos_f64),
];

/// Runs `kernel` on every input. The checksum costs one instruction a result on a machine with a barrel shifter.
#[inline(always)]
fn over<T: Copy, const N: usize>(inputs: &'static [T; N], mut kernel: impl FnMut(T) -> u32) -> Tally {
    let mut checksum = 0_u32;
    for input in black_box(inputs) {
        checksum = checksum.rotate_left(1) ^ kernel(*input);
    }
    Tally { checksum, units: N as u32 }
}

/// A result in double precision, for a checksum.
#[inline(always)]
fn fold(v: f64) -> u32 {
    let bits = v.to_bits();
    bits as u32 ^ (bits >> 32) as u32
}
