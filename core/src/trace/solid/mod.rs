//! Solids and other shapes in their generic coordinates, and what puts them into a world.
//!
//! Source: the course unit V, sections 5.7 and 5.10.

mod cube;
mod design;
mod half_space;
mod implicit;
#[cfg(test)]
mod judge;
mod moved;
mod placed;
mod plane;
mod polygon;
mod polyhedron;
mod shape;
mod site;
mod slab;
mod sphere;
mod square;
mod superellipsoid;
mod tapered_cylinder;
mod torus;

pub use cube::Cube;
pub use half_space::HalfSpace;
pub use implicit::{Function, Implicit};
pub use moved::Moved;
pub use placed::Placed;
pub use plane::Plane;
pub use polygon::Polygon;
pub use polyhedron::Polyhedron;
pub use shape::{NearCrossing, NearRay, Shape};
pub use sphere::Sphere;
pub use square::Square;
pub use superellipsoid::Superellipsoid;
pub use tapered_cylinder::TaperedCylinder;
pub use torus::Torus;
