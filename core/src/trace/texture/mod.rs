//! Textures: how a material changes from place to place.
//!
//! Source: the course unit V, section 5.8.

mod bump;
mod checker;
pub(super) mod field;
mod frame;
mod image;
mod landscape;
mod mapped;
mod marble;
mod noise;
mod pasted;
mod slice;
mod spline;
#[cfg(test)]
mod testing;
mod turbulence;
mod wood;

pub use bump::{Bump, Bumpy, Facets, Relief, Rough, bumped_normal};
pub use checker::Checker;
pub use field::Texture;
pub use frame::{Framed, Grain, turned};
pub use image::{Beyond, Image, Lookup, Texels};
pub use landscape::Landscape;
pub use mapped::Mapped;
pub use marble::{Marble, Mottle};
pub use noise::{Lattice, Noise, PERMUTATION};
pub use pasted::Pasted;
pub use slice::Slice;
pub use spline::{Knot, Spline};
pub use turbulence::Turbulence;
pub use wood::Wood;
