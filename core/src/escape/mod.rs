//! Escape-time pictures: the dwell of the Mandelbrot set and of filled-in Julia sets.
//!
//! A [`View`] says which point of the plane each pixel shows; [`Mandelbrot`] and [`Julia`] are [`Field`](crate::picture::Field)s whose
//! value is a [`Dwell`]. Orbits run in 32-bit words with 29 fractional bits; a view finer than that is refused.

mod complex;
mod count;
mod dwell;
#[cfg(test)]
mod exact;
mod interior;
mod julia;
mod mandelbrot;
mod precision;
mod view;

pub use complex::Complex;
pub use count::{Dwell, MAX_DWELL};
pub use julia::{Julia, JuliaRow};
pub use mandelbrot::{Mandelbrot, MandelbrotRow};
pub use precision::Precision;
pub use view::View;

use count::checked_max;
