//! Curves by refinement: generators, the Koch curve and its relatives, random curves.
mod carpenter;
pub mod catalogue;
mod dimension;
mod displacement;
mod elbow;
mod gaussian;
mod generator;
pub mod koch;
mod refined;
mod subdivision;
mod turtle;

pub use carpenter::{LineToLine, OneVariable, TwoVariable};
pub use dimension::{dimension_of_ratio, dimension_of_spectrum};
pub use displacement::{Displacement, Part, displaced};
pub use elbow::Elbow;
pub use gaussian::{Deviate, Parameter, RandomFunction};
pub use generator::{Generator, Orientation};
pub use refined::Refined;
pub use subdivision::{Stop, Subdivision};
pub use turtle::turn_over;
