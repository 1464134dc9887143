//! What the built-in scenes look like: margins, paper, a line whose colour changes along it, the ground under
//! a graph.
//!
//! The command `attractor` and the images for the target draw with this code, so that they show the same
//! pixels. It does what firmware would do: no allocation, buffers are lent, colours are those of any display.
#![no_std]
#![deny(missing_docs)]

mod area;
mod chart;
mod copier;
mod curve;
mod density;
mod depth;
mod equalised;
mod ifs;
mod image;
mod ink;
mod julia_set;
mod l_system;
mod lattice;
mod mesh;
mod named;
mod nested;
mod page;
mod patch_curve;
mod patch_surface;
mod pencil;
mod plot;
mod random_curve;
mod shade;
mod terrain;

pub use area::ground_words;
pub use chart::{CELLS_ACROSS, Chart};
pub use copier::Copies;
pub use curve::CurvePicture;
pub use depth::{depth_for, filtered_depth, surface_depth};
pub use equalised::draw_equalised;
pub use ifs::{IfsPicture, Shading};
pub use image::{Frames, ImagePicture, Tones};
pub use ink::{ground, solid};
pub use julia_set::{JuliaSetPicture, Method};
pub use l_system::LSystemPicture;
pub use lattice::LatticePicture;
pub use mesh::Lines;
pub use named::Named;
pub use page::{Display, MAX_POINTS, PAPER, Watch, draw_field};
pub use patch_curve::PatchCurvePicture;
pub use patch_surface::{PatchSurfacePicture, Standpoint};
pub use pencil::Pencil;
pub use random_curve::RandomCurvePicture;
pub use shade::Shade;
pub use terrain::{Floor, Ground, TerrainMemory, TerrainPicture};
