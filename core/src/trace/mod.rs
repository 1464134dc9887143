//! Rays: height fields in grey, and worlds of shapes, materials and textures in colour, a row at a time.
//!
#![doc = include_str!("../../docs/trace.md")]
//!
//! A [`RayCaster`] shows the height field of two fractal functions, front to back through two pyramids of
//! cells. A [`world::WorldCaster`] shows what a ray can meet, a [`Surface`]: [shapes](solid) under affine
//! maps, height fields among them, alone or in [compounds](world::Object), of [materials](material) that
//! mirror and bend light, with [textures](texture), among [lamps](world::Lamp).
//!
//! What a pixel shows is defined in CONTRIBUTING.md ("The picture of a height field, defined", "The picture
//! of a world, defined"); the f64 reference implements the same pages.
//!
//! Source: Cochran, Lewis, Hart, "The Normal of a Fractal Surface", 2000, sections 4 to 6; the course unit V,
//! sections 5.7 to 5.10.

mod ball;
mod camera;
mod choice;
mod environment;
#[cfg(test)]
mod exact;
mod filtered;
mod finish;
mod height_field;
pub mod material;
mod panorama;
mod patch_caster;
mod patch_surface;
mod power;
mod ray;
mod ray_caster;
mod sampling;
mod screen;
mod snell;
pub mod solid;
mod surface;
mod surroundings;
mod terrain;
pub mod texture;
pub mod world;

pub use ball::Ball;
pub use camera::Camera;
pub use environment::Environment;
pub use filtered::{FilteredCaster, FilteredPatch, Found, Quality};
pub use finish::{Finish, Light};
pub use height_field::boxes::meets;
pub use height_field::field::{HeightField, Hit};
pub use height_field::statistics::Statistics;
pub use panorama::Panorama;
pub use patch_caster::PatchCaster;
pub use patch_surface::PatchSurface;
pub use ray::Ray;
pub use ray_caster::RayCaster;
pub use sampling::{Filter, Sampling};
pub use snell::refracted_direction;
pub use surface::{Chart, Crossing, Extent, Surface, SurfacePoint};
pub use surroundings::{Sky, Surroundings, Tiles};
pub use terrain::{DeepTerrain, HeightRange, Terrain};
