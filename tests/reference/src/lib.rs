//! The fractals of attractor in `f64`, written for clarity from the source texts and independent of the fixed-point kernel:
//! the yardstick that says how wrong every fixed-point result is.
//!
//! Every transcendental comes from `libm`, so the bits are the same on every platform. Functions assert on bad input.

mod bounds;
mod calculus;
mod camera;
mod compose;
pub mod copier;
mod double_double;
mod fif;
mod height_field;
pub mod koch;
mod polynomial;
pub mod random_curve;
mod vector;

pub use bounds::{Bounds, Cell};
pub use camera::{Camera, Ray};
pub use compose::Composite;
pub use fif::{Fif, Map};
pub use height_field::{Hit, Trace, leaf_normal, trace};
pub use vector::Vector;
