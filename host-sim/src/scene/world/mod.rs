//! `kind = "world"`: objects, lights and materials under a ray tracer, in colour.

pub(super) mod color;
mod figure;
mod file;
mod lamp;
mod material;
mod numbers;
mod object;
mod picture;
mod placement;
mod program;
mod reference;
mod reference_texture;
mod reference_world;
mod stuff;
mod surroundings;
pub(crate) mod texture;
pub(crate) mod values;
mod view;

pub(crate) use figure::Figure;
pub(crate) use lamp::{Light, Stand};
pub(crate) use material::{Colored, Gloss, Matter};
pub(crate) use numbers::sample;
pub(crate) use picture::Picture;
pub(crate) use placement::Step;
pub(crate) use surroundings::Around;
pub(crate) use view::WorldScene;
