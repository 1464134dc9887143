//! The fractals of attractor in `f64`, written for clarity from the source texts and independent of the
//! fixed-point kernel: the yardstick that says how wrong every fixed-point result is.
//!
//! Every transcendental comes from `libm`, so the bits are the same on every platform. Functions assert on
//! bad input.

mod backward;
mod bounds;
mod calculus;
mod camera;
pub mod codec;
mod compose;
pub mod copier;
mod double_double;
mod elementary;
mod escape;
mod fif;
mod height_field;
mod ifs;
pub mod koch;
pub mod l_system;
pub mod lattice;
pub mod moments;
pub mod patch;
mod picture;
mod polynomial;
pub mod projected;
pub mod random_curve;
mod sampling;
mod shade;
pub mod slopes;
mod surface;
pub mod terrain;
pub mod texture;
mod vector;
pub mod world;

pub use backward::julia_points;
pub use bounds::{Bounds, Cell};
pub use camera::{Camera, Ray};
pub use compose::Composite;
pub use elementary::Elementary;
pub use escape::{dwell, in_cardioid, in_period_2_bulb, julia_dwell};
pub use fif::{Fif, Map};
pub use height_field::{Hit, Trace, leaf_normal, trace};
pub use ifs::{Affine, Moments, moments};
pub use picture::{Scene, box_tests, hit, render};
pub use sampling::Samples;
pub use shade::{Environment, Finish};
pub use surface::{Factor, Surface};
pub use vector::Vector;
