//! A world of objects, lights and materials, seen in colour.
//!
//! What a pixel shows is defined in CONTRIBUTING.md ("The picture of a world, defined"); the f64 reference
//! implements the same page.
//!
//! Source: the course unit V, sections 5.7 to 5.10; Cochran, Lewis, Hart, sections 4 to 6.

mod bounce;
mod caster;
mod compound;
mod events;
mod lamp;
mod object;
mod scene;
mod search;
mod states;

pub use caster::WorldCaster;
pub use compound::{Difference, Intersection, Union};
pub use lamp::Lamp;
pub use object::{Object, Op};
pub use scene::{Interpenetration, Leaf, World};
