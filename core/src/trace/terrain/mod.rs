//! Terrain under a ray caster: heights over a rectangle, exactly where they are.

mod course;
mod deep;
mod leaf;
mod meet;
mod plot;
mod ranges;
mod sides;
mod steps;
mod stored;
mod walk;

pub use deep::DeepTerrain;
pub use ranges::HeightRange;
pub use stored::Terrain;
