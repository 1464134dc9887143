//! Solids and other shapes in their generic coordinates, and what puts them into a world.
//!
//! Source: the course unit V, sections 5.7 and 5.10.

mod implicit;
mod placed;
mod plane;
mod shape;
mod sphere;
mod superellipsoid;
mod torus;

pub use implicit::{Function, Implicit};
pub use placed::Placed;
pub use plane::Plane;
pub use shape::{NearCrossing, NearRay, Shape};
pub use sphere::Sphere;
pub use superellipsoid::Superellipsoid;
pub use torus::Torus;
