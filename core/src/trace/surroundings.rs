//! What a ray shows that meets nothing.

use super::environment::Environment;
use crate::num::{Rgb, Unit, Vec3};

/// Light from all round, infinitely far away.
pub trait Surroundings {
    /// The light from a unit direction, where `width` is how wide the cone of directions is that is asked for:
    /// finer details may be averaged.
    fn light(&self, direction: Vec3<Unit>, width: Unit) -> Rgb;
}

/// The same everywhere.
impl Surroundings for Rgb {
    fn light(&self, _: Vec3<Unit>, _: Unit) -> Rgb {
        *self
    }
}

/// In greys.
impl Surroundings for Environment {
    fn light(&self, direction: Vec3<Unit>, _: Unit) -> Rgb {
        Rgb::from_tone(self.tone(direction))
    }
}
