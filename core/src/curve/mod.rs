//! Curves by refinement: generators, the Koch curve and its relatives, random curves.
pub mod catalogue;
mod generator;
pub mod koch;
mod refined;
mod turtle;

pub use generator::{Generator, Orientation};
pub use refined::Refined;
pub use turtle::turn_over;
