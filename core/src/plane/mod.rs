//! What kernels show, on the plane: points, paths and fields, and the window through which a display looks at
//! it.
//!
//! There are three kinds of picture, each lazy and without a buffer:
//!
//! - *points*: an `Iterator<Item = Point2>` (chaos game, sampled attractors);
//! - *path*: an `Iterator<Item = PathElement>` of move-to and line-to (graphs of functions, Koch curves);
//! - *field*: a [`Field`], one value a pixel, delivered row by row (dwell, ray caster); a closure becomes one
//!   with [`from_fn()`].
//!
//! A path:
//!
#![doc = include_str!("../../docs/curve.md")]
//! A field:
//!
#![doc = include_str!("../../docs/escape.md")]

mod density;
mod field;
mod from_fn;
mod linear_rgb;
mod path;
mod point;
mod size;
mod tone;
mod window;

pub use density::{Counter, Density, Hits, Toned};
pub(crate) use field::inside;
pub use field::{Field, Symmetric, along};
pub use from_fn::{FromFn, from_fn};
pub use linear_rgb::LinearRgb;
pub use path::PathElement;
pub use point::{Bounds2, Point2};
pub use size::{MAX_SIDE, checked_size};
pub use tone::Tone;
pub use window::Window;
