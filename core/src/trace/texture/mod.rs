//! Textures: how a material changes from place to place.
//!
//! Source: the course unit V, section 5.8.

mod field;

pub use field::Texture;
