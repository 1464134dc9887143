//! Lights.
//!
//! Source: CONTRIBUTING.md, "The picture of a world, defined", Light at a point.

use crate::vector::{Vector, along, dot, normalised};

/// Red, green and blue, linear; 1 is the white of a display.
pub type Colour = [f64; 3];

/// Where light comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Light {
    /// From far away.
    Distant {
        /// A vector of any length towards the light.
        towards: Vector,
        /// Its colour.
        colour: Colour,
    },
    /// From a point, equally bright at any distance.
    Point {
        /// The point.
        at: Vector,
        /// Its colour.
        colour: Colour,
    },
}

impl Light {
    /// The unit direction towards the light from `p`, and how far away the light is.
    ///
    /// # Panics
    /// When the light stands at `p`.
    pub fn seen_from(&self, p: Vector) -> (Vector, f64) {
        match *self {
            Light::Distant { towards, .. } => (normalised(towards), f64::INFINITY),
            Light::Point { at, .. } => {
                let way = along(at, -1.0, p);
                (normalised(way), libm::sqrt(dot(way, way)))
            }
        }
    }

    /// Its colour.
    pub fn colour(&self) -> Colour {
        match *self {
            Light::Distant { colour, .. } | Light::Point { colour, .. } => colour,
        }
    }
}
