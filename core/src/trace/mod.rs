//! A scanline ray caster for height fields: one row of a picture at a time, front to back through two
//! pyramids of cells.
//!
#![doc = include_str!("../../docs/trace.md")]
//!
//! What a pixel shows is defined in CONTRIBUTING.md ("The picture of a height field, defined"); the f64
//! reference implements the same page.
//!
//! Source: Cochran, Lewis, Hart, "The Normal of a Fractal Surface", 2000, section 4.

mod boxes;
mod camera;
mod choice;
mod environment;
#[cfg(test)]
mod exact;
mod finish;
mod halves;
mod height_field;
mod height_surface;
mod hierarchy;
pub mod material;
mod outline;
mod panorama;
mod parts;
mod ray;
mod ray_caster;
mod sampling;
mod screen;
mod snell;
pub mod solid;
mod statistics;
mod surface;
mod surroundings;
pub mod texture;
pub mod world;

pub use boxes::meets;
pub use camera::Camera;
pub use environment::Environment;
pub use finish::{Finish, Light};
pub use height_field::{HeightField, Hit};
pub use panorama::Panorama;
pub use ray::Ray;
pub use ray_caster::RayCaster;
pub use sampling::{Filter, Sampling};
pub use statistics::Statistics;
pub use surface::{Chart, Crossing, Extent, Surface, SurfacePoint};
pub use surroundings::{Sky, Surroundings, Tiles};
