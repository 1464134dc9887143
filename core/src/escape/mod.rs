//! Escape-time pictures: the dwell of the Mandelbrot set and of filled-in Julia sets.
//!
//! A [`View`] says which point of the plane each pixel shows; [`Mandelbrot`] and [`Julia`] are [`Field`](crate::picture::Field)s whose
//! value is a [`Dwell`]. Orbits run in 32-bit words with 29 fractional bits; a view finer than that is refused;
//! [`DeepView`] and [`DeepMandelbrot`] go on from there, with 64 bits, 128 bits, and perturbation. All three are [`EscapeTime`] pictures, which [`Smooth`],
//! [`Distance`] and [`Interior`] colour, [`Canvas`] mirrors and pans, and [`Filled`] fills in.

mod backward;
mod block;
mod canvas;
mod complex;
mod count;
mod cover;
mod deep_mandelbrot;
mod deep_view;
mod distance;
mod dwell;
mod escape_time;
#[cfg(test)]
mod exact;
mod filled;
mod interior;
mod julia;
mod julia_set;
mod jumps;
mod mandelbrot;
mod orbit;
mod period;
mod perturbation;
mod precision;
mod row;
mod smooth;
mod square_root;
mod view;
mod wide_dwell;

pub use backward::BackwardIteration;
pub use canvas::{Canvas, CanvasRow};
pub use complex::Complex;
pub use count::{Dwell, MAX_DWELL};
pub use cover::{JuliaCover, JuliaCoverRow};
pub use deep_mandelbrot::{Arithmetic, DeepMandelbrot, DeepRow};
pub use deep_view::{DeepView, Pixels};
pub use distance::{Distance, DistanceRow};
pub use escape_time::{Ending, EscapeTime};
pub use filled::{Filled, FilledRow};
pub use julia::{Julia, JuliaRow};
pub use julia_set::{Connectedness, FixedPoint, JuliaSet, SimpleCase, Stability};
pub use mandelbrot::{Mandelbrot, MandelbrotRow};
pub use period::{Interior, InteriorRow, MAX_PERIOD, Period};
pub use perturbation::OrbitPoint;
pub use precision::Precision;
pub use smooth::{FractionalDwell, Smooth, SmoothRow};
pub use view::{Line, MAX_PAN, View};

use count::checked_max;
