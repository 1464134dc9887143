//! Fractal interpolation functions: graphs through given knots that are their own shrunken, sheared copies.
//!
#![doc = include_str!("../../docs/fif.md")]
//!
//! `f(L_j(x)) = alpha_j f(x) + q_j(x)`, `L_j` the affine map of the whole domain onto the interval between
//! knots `j - 1` and `j`.
//!
//! Source: W. O. Cochran, R. R. Lewis, J. C. Hart, "The Normal of a Fractal Surface", 2000, sections 2 and 3;
//! M. F. Barnsley, "Fractal functions and interpolation", 1986.
//!
//! Inside, the abscissa `u = (x - x_0) / (x_N - x_0)` runs over `[0, 1]` with 63 fractional bits, values
//! have 55.

mod above;
mod bounds;
mod calculus;
mod chaos;
mod compiled;
mod compose;
mod dyadic;
mod ended;
mod error;
mod evaluate;
mod function;
mod graph;
mod map;
mod moments;
mod polynomial;
mod pyramid;
mod stretch;
mod sums;
mod surface;
mod value;
mod variance;

pub use chaos::ChaosGame;
pub use compiled::Compiled;
pub use compose::Composite;
pub use dyadic::Dyadic;
pub use function::{Fif, Knot};
pub use graph::Graph;
pub use moments::{Moments, Spread};
pub use pyramid::{Cell, Pyramid};
pub use stretch::Stretch;
pub(crate) use sums::{Course, Width};
pub use sums::{Sum, Sums, Trend};
pub use surface::{Factor, Surface};
