//! What is seen in a direction that meets nothing.
//!
//! Source: CONTRIBUTING.md, "The picture of a world, defined", Surroundings, and "The picture of a height
//! field, defined", Environment (with three colours instead of tones).

use crate::vector::Vector;
use crate::world::light::Colour;
use core::fmt::{Debug, Formatter, Result};

/// The surroundings.
pub enum Surroundings {
    /// The same colour everywhere.
    Plain(Colour),
    /// A colour that changes with the height of the direction.
    Gradient {
        /// Straight up.
        zenith: Colour,
        /// Level.
        horizon: Colour,
        /// Straight down.
        nadir: Colour,
    },
    /// A ceiling and a floor at unit height, tiled with squares, fading towards the horizon.
    Checkerboard {
        /// Squares to a unit of length.
        scale: f64,
        /// The colour of the even squares.
        bright: Colour,
        /// The colour of the odd squares.
        dark: Colour,
        /// The colour of the horizon.
        horizon: Colour,
        /// The height `|e_z|` of a direction below which the squares fade.
        fade: f64,
    },
    /// A picture all round: a function of the unit direction.
    Picture(Box<dyn Fn(Vector) -> Colour>),
}

impl Debug for Surroundings {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Surroundings::Plain(_) => "Plain",
            Surroundings::Gradient { .. } => "Gradient",
            Surroundings::Checkerboard { .. } => "Checkerboard",
            Surroundings::Picture(_) => "Picture",
        })
    }
}

/// `a + (b - a) s`.
fn mixed(a: Colour, b: Colour, s: f64) -> Colour {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * s)
}

impl Surroundings {
    /// The colour in direction `e`, a unit vector.
    pub fn colour(&self, e: Vector) -> Colour {
        let height = e[2].abs();
        match self {
            Surroundings::Plain(colour) => *colour,
            Surroundings::Gradient { zenith, horizon, nadir } => {
                mixed(*horizon, if e[2] >= 0.0 { *zenith } else { *nadir }, height)
            }
            // Wholly faded, and on no tile.
            Surroundings::Checkerboard { horizon, .. } if height == 0.0 => *horizon,
            Surroundings::Checkerboard { scale, bright, dark, horizon, fade } => {
                let square = libm::floor(scale * e[0] / height) + libm::floor(scale * e[1] / height);
                let even = square == 2.0 * libm::floor(square / 2.0);
                mixed(*horizon, if even { *bright } else { *dark }, (height / fade).min(1.0))
            }
            Surroundings::Picture(picture) => picture(e),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Surroundings;
    use crate::shade::Environment;
    use crate::vector::normalised;

    #[test]
    fn in_grey_they_are_the_environment_of_a_height_field() {
        let grey = |tone: f64| [tone; 3];
        let pairs = [
            (
                Environment::Gradient { zenith: 0.9, horizon: 0.5, nadir: 0.25 },
                Surroundings::Gradient { zenith: grey(0.9), horizon: grey(0.5), nadir: grey(0.25) },
            ),
            (
                Environment::Checkerboard { scale: 2.0, bright: 0.75, dark: 0.25, horizon: 0.5, fade: 0.25 },
                Surroundings::Checkerboard {
                    scale: 2.0,
                    bright: grey(0.75),
                    dark: grey(0.25),
                    horizon: grey(0.5),
                    fade: 0.25,
                },
            ),
        ];
        for (tone, colour) in pairs {
            for k in 0..200 {
                let k = f64::from(k);
                let e = normalised([libm::sin(k), libm::cos(1.7 * k), libm::sin(0.6 * k)]);
                assert_eq!(colour.colour(e), grey(tone.tone(e)));
            }
        }
    }

    #[test]
    fn a_gradient_mixes_each_colour_by_itself() {
        let sky = Surroundings::Gradient {
            zenith: [0.0, 0.5, 1.0],
            horizon: [1.0, 0.5, 0.0],
            nadir: [0.25, 0.25, 0.25],
        };
        let half = libm::sqrt(0.75);
        assert_eq!(sky.colour([half, 0.0, 0.5]), [0.5, 0.5, 0.5]);
        assert_eq!(sky.colour([0.0, 0.0, -1.0]), [0.25; 3]);
    }
}
