//! Curves by refinement: generators, the Koch curve and its relatives, random curves.
mod generator;
pub mod koch;
mod refined;

pub use generator::{Generator, Orientation};
pub use refined::Refined;
