//! What is seen in a direction that meets nothing.
//!
//! Source: CONTRIBUTING.md, "The picture of a world, defined", Surroundings, and "The picture of a height
//! field, defined", Environment (with three colours instead of tones).

use crate::texture::all_round;
use crate::vector::Vector;
use crate::world::light::Colour;
use crate::world::pigment::Texels;
use core::f64::consts::{PI, TAU};
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
    /// A function of the unit direction.
    Picture(Box<dyn Fn(Vector) -> Colour>),
    /// A picture all round, by longitude and latitude.
    Image(Texels),
}

impl Debug for Surroundings {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(match self {
            Surroundings::Plain(_) => "Plain",
            Surroundings::Gradient { .. } => "Gradient",
            Surroundings::Checkerboard { .. } => "Checkerboard",
            Surroundings::Picture(_) => "Picture",
            Surroundings::Image(_) => "Image",
        })
    }
}

/// `a + (b - a) s`.
fn mixed(a: Colour, b: Colour, s: f64) -> Colour {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * s)
}

impl Surroundings {
    /// The colour in direction `e`, a unit vector, that a ray sees which grows by `growth` a unit of its
    /// length.
    pub fn colour(&self, e: Vector, growth: f64) -> Colour {
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
            Surroundings::Image(texels) => {
                let [u, v] = all_round(e);
                let level = libm::hypot(e[0], e[1]);
                // straight up and down a cone sees all longitudes, a line that of the x axis
                let across = if growth == 0.0 { 0.0 } else { (growth / TAU / level).min(1.0) };
                texels.within(u, v, [across, growth / PI])
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Surroundings;
    use crate::shade::Environment;
    use crate::vector::normalised;
    use crate::world::pigment::Texels;

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
                assert_eq!(colour.colour(e, 0.0), grey(tone.tone(e)));
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
        assert_eq!(sky.colour([half, 0.0, 0.5], 0.0), [0.5, 0.5, 0.5]);
        assert_eq!(sky.colour([0.0, 0.0, -1.0], 0.0), [0.25; 3]);
    }

    #[test]
    fn a_picture_all_round_ends_above_and_below_and_closes_round_the_sides() {
        // four longitudes, light above, dark below
        let light = [8.0, 6.0, 4.0, 2.0, 1.5, 1.0, 0.5, 0.0].map(|c| [c; 3]).to_vec();
        let around = Surroundings::Image(Texels { size: [4, 2], light });
        let seen = |e, growth| around.colour(normalised(e), growth)[0];
        // the middle of the first texel of the upper row, the seam beside it, and above its middle
        assert!((seen([1.0, 1.0, libm::sqrt(2.0)], 0.0) - 8.0).abs() < 1e-12);
        assert!((seen([1.0, 0.0, 1.0], 0.0) - 5.0).abs() < 1e-12);
        assert!((seen([1.0, 1.0, 9.0], 0.0) - 8.0).abs() < 1e-12);
        // straight up: a line sees the seam, a cone all longitudes
        assert_eq!((seen([0.0, 0.0, 1.0], 0.0), seen([0.0, 0.0, 1.0], 0.001)), (5.0, 5.0));
        let light = [8.0, 6.0, 4.0, 0.0, 1.5, 1.0, 0.5, 0.0].map(|c| [c; 3]).to_vec();
        let around = Surroundings::Image(Texels { size: [4, 2], light });
        let up = [0.0, 0.0, 1.0];
        assert_eq!((around.colour(up, 0.0)[0], around.colour(up, 0.001)[0]), (4.0, 4.5));
        // all of a half: the mean of both rows
        assert!((around.colour([1.0, 0.0, 0.0], 9.0)[0] - 2.625).abs() < 1e-12);
    }
}
