//! Textures: how a material changes from place to place.
//!
//! Source: the course unit V, section 5.8.

mod field;
mod noise;
mod turbulence;

pub use field::Texture;
pub use noise::{Lattice, Noise, PERMUTATION};
pub use turbulence::Turbulence;
