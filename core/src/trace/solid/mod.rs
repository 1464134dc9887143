//! Solids and other shapes in their generic coordinates, and what puts them into a world.
//!
//! Source: the course unit V, sections 5.7 and 5.10.

mod shape;

pub use shape::{NearCrossing, NearRay, Shape};
