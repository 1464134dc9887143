//! Escape-time pictures: the dwell of the Mandelbrot set and of filled-in Julia sets.
//!
#![doc = include_str!("../../docs/escape.md")]
//!
//! A [`View`] says which point of the plane each pixel shows; [`Mandelbrot`] and [`Julia`] are
//! [`Field`](crate::plane::Field)s whose value is a [`Dwell`]. Orbits run in 32-bit words with 29 fractional
//! bits; a view finer than that is refused; [`DeepView`] and [`DeepMandelbrot`] go on from there, with 64
//! bits, 128 bits, and perturbation. All three are [`EscapeTime`] pictures, which [`Smooth`], [`Distance`]
//! and [`Interior`] colour, [`Buffered`] mirrors and pans, and [`Filled`] fills in.

mod buffer;
mod coloring;
#[cfg(test)]
mod exact;
mod julia_set;
mod orbit;
mod perturbation;
mod set;
mod value;
mod view;

pub use buffer::buffered::Buffered;
pub use buffer::filled::Filled;
pub use coloring::distance::Distance;
pub use coloring::interior::Interior;
pub use coloring::smooth::{FractionalDwell, Smooth};
pub use julia_set::backward::BackwardIteration;
pub use julia_set::cover::JuliaCover;
pub use julia_set::set::{Connectedness, FixedPoint, JuliaSet, SimpleCase, Stability};
pub use orbit::arithmetic::Arithmetic;
pub use orbit::ending::Ending;
pub use perturbation::reference::OrbitPoint;
pub use set::deep_mandelbrot::DeepMandelbrot;
pub use set::escape_time::{EscapeTime, Pan};
pub use set::julia::Julia;
pub use set::mandelbrot::Mandelbrot;
pub use value::{Dwell, MAX_DWELL, MAX_PERIOD, Period};
pub use view::deep::DeepView;
pub use view::raster::MAX_PAN;
pub use view::shallow::View;
