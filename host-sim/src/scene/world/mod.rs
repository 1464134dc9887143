//! `kind = "world"`: objects, lights and materials under a ray tracer, in colour.

mod color;
mod figure;
mod file;
mod lamp;
mod material;
mod numbers;
mod object;
mod placement;
mod program;
mod surroundings;
mod texture;
mod view;

pub(crate) use view::WorldScene;
