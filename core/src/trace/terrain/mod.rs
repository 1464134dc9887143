//! Terrain under a ray caster: heights over a rectangle, exactly where they are.

mod deep;
mod meet;
mod plot;
mod ranges;
mod sides;
mod stored;
mod walk;

pub use deep::DeepTerrain;
pub use ranges::HeightRange;
pub use stored::Terrain;
