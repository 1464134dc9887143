//! The ray-traced world: shapes, compound objects, light, materials, refraction.
//!
//! Source: course unit V, sections 5.7 to 5.10; Cochran, Lewis and Hart, "The Normal of a Fractal Surface",
//! sections 4 to 6; CONTRIBUTING.md, "The picture of a world, defined".

mod compound;
mod cube;
mod field;
mod implicit;
#[cfg(test)]
mod laws;
mod light;
mod material;
mod medium;
mod pattern;
mod pigment;
mod placing;
mod plane;
mod polygon;
mod polyhedron;
pub mod refraction;
mod relief;
mod root;
#[cfg(test)]
mod scenes;
mod shape;
mod span;
mod sphere;
mod square;
mod superellipsoid;
mod surroundings;
mod tapered_cylinder;
mod torus;
mod tracer;
mod walk;

pub use compound::{Program, Step};
pub use cube::Cube;
pub use field::HeightField;
pub use implicit::Implicit;
pub use light::{Colour, Light};
pub use material::{Material, Slopes, Specular};
pub use medium::{Interpenetration, Policy};
pub use pattern::{Pattern, Point};
pub use pigment::{Lookup, Texels, Turbulence};
pub use placing::Placing;
pub use plane::Plane;
pub use polygon::Polygon;
pub use polyhedron::Polyhedron;
pub use shape::{Cone, Crossing, Frame, Part, Shape};
pub use sphere::Sphere;
pub use square::Square;
pub use superellipsoid::Superellipsoid;
pub use surroundings::Surroundings;
pub use tapered_cylinder::TaperedCylinder;
pub use torus::Torus;
pub use tracer::World;
pub use walk::{FARTHEST, Leaf, OUTERMOST, Object, TOGETHER};
