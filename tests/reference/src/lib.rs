//! The fractals of attractor in `f64`, written for clarity from the source texts and independent of the fixed-point kernel:
//! the yardstick that says how wrong every fixed-point result is.
//!
//! Every transcendental comes from `libm`, so the bits are the same on every platform. Functions assert on bad input.

mod bounds;
mod calculus;
mod compose;
mod double_double;
mod fif;
mod polynomial;

pub use bounds::{Bounds, Cell};
pub use compose::Composite;
pub use fif::{Fif, Map};
