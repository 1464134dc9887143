//! Height fields with every pixel's normals integrated: what is seen of a fractal surface through a pixel, by
//! the moments of its slopes there instead of by many rays.

mod answer;
mod caster;
mod footprint;
mod ground;
mod outline;
mod patch;
mod slopes;

pub use caster::{FilteredCaster, Found};
pub use footprint::Quality;
pub use patch::FilteredPatch;
