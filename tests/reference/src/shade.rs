//! The tone of a surface: its material, the light and the environment that it reflects.
//!
//! Source: CONTRIBUTING.md, "The picture of a height field, defined", Tone and Environment; Cochran, Lewis
//! and Hart, "The Normal of a Fractal Surface", section 5 (diffuse, Phong and mirror surfaces). The mirror
//! direction is `m = d - 2 (d . n^) n^`, which the course unit V prints with an error. Tones are clamped to
//! `[0, 1]`.

use crate::vector::{Vector, along, dot, normalised};

/// How a surface answers to light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Finish {
    /// `a + (1 - a) max(0, n^ . l)`.
    Diffuse {
        /// The part `a` that needs no light.
        ambient: f64,
    },
    /// `a + kd max(0, n^ . l) + ks max(0, m^ . l)^shininess`.
    Phong {
        /// The part `a` that needs no light.
        ambient: f64,
        /// `kd`.
        diffuse: f64,
        /// `ks`.
        specular: f64,
        /// The exponent.
        shininess: f64,
    },
    /// `a + kd max(0, n^ . l) + ks F D G / (4 n^ . v)`, the last where `n^ . l > 0`.
    TorranceSparrow {
        /// The part `a` that needs no light.
        ambient: f64,
        /// `kd`.
        diffuse: f64,
        /// `ks`.
        specular: f64,
        /// `s` of `D`.
        roughness: f64,
        /// `f` of `F`.
        reflectance: f64,
    },
    /// The environment in the mirror direction.
    Mirror,
}

/// What is seen in a direction that meets no surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Environment {
    /// The same tone everywhere.
    Plain {
        /// The tone.
        tone: f64,
    },
    /// A tone that changes with the height of the direction.
    Gradient {
        /// Straight up.
        zenith: f64,
        /// Level.
        horizon: f64,
        /// Straight down.
        nadir: f64,
    },
    /// A ceiling and a floor at unit height, tiled with squares, fading towards the horizon.
    Checkerboard {
        /// Squares to a unit of length.
        scale: f64,
        /// The tone of the even squares.
        bright: f64,
        /// The tone of the odd squares.
        dark: f64,
        /// The tone of the horizon.
        horizon: f64,
        /// The height `|e_z|` of a direction below which the squares fade.
        fade: f64,
    },
}

impl Environment {
    /// The tone in direction `e`, a unit vector.
    pub fn tone(&self, e: Vector) -> f64 {
        let height = e[2].abs();
        let tone = match *self {
            Environment::Plain { tone } => tone,
            Environment::Gradient { zenith, horizon, nadir } => {
                let end = if e[2] >= 0.0 { zenith } else { nadir };
                horizon + (end - horizon) * height
            }
            // Wholly faded, and on no tile.
            Environment::Checkerboard { horizon, .. } if height == 0.0 => horizon,
            Environment::Checkerboard { scale, bright, dark, horizon, fade } => {
                let square = libm::floor(scale * e[0] / height) + libm::floor(scale * e[1] / height);
                let even = square == 2.0 * libm::floor(square / 2.0);
                let tone = if even { bright } else { dark };
                horizon + (tone - horizon) * (height / fade).min(1.0)
            }
        };
        tone.clamp(0.0, 1.0)
    }
}

impl Finish {
    /// The tone of a surface with the normal `n`, seen by a ray of direction `d`, lit from `light` (none of
    /// them of unit length).
    ///
    /// # Panics
    /// When one of the three vectors is zero.
    pub fn tone(&self, n: Vector, d: Vector, light: Vector, environment: &Environment) -> f64 {
        self.answer(&Facing::new(n, d, normalised(light)), environment)
    }

    /// The tone of a surface that stands so to eye and light.
    pub(crate) fn answer(&self, facing: &Facing, environment: &Environment) -> f64 {
        let lambert = facing.lit.max(0.0);
        let tone = match *self {
            Finish::Diffuse { ambient } => ambient + (1.0 - ambient) * lambert,
            Finish::Phong { ambient, diffuse, specular, shininess } => {
                let highlight = power(facing.straight.max(0.0), shininess);
                ambient + diffuse * lambert + specular * highlight
            }
            Finish::TorranceSparrow { ambient, diffuse, specular, roughness, reflectance } => {
                let highlight =
                    if facing.lit > 0.0 { facing.sheen(roughness, reflectance).min(1.0) } else { 0.0 };
                ambient + diffuse * lambert + specular * highlight
            }
            Finish::Mirror => environment.tone(facing.mirrored),
        };
        tone.clamp(0.0, 1.0)
    }
}

/// How a normal stands to eye and light.
pub(crate) struct Facing {
    /// The mirrored ray, a unit vector.
    mirrored: Vector,
    /// `n^ . l`.
    lit: f64,
    /// The mirrored ray against the light.
    straight: f64,
    /// `n^ . v`.
    eye: f64,
    /// `v . l`.
    across: f64,
}

impl Facing {
    /// Of a normal and a ray of any length, and a light of length 1.
    pub(crate) fn new(n: Vector, d: Vector, light: Vector) -> Self {
        let n = normalised(n);
        let mirrored = normalised(along(d, -2.0 * dot(d, n), n));
        let v = normalised(d).map(|c| -c);
        let (eye, across) = (dot(n, v), dot(v, light));
        Self { mirrored, lit: dot(n, light), straight: dot(mirrored, light), eye, across }
    }

    /// `F D G / (4 n . v)`, `D` without its `1 / pi`: CONTRIBUTING.md, "The picture of a world, defined".
    fn sheen(&self, s: f64, f: f64) -> f64 {
        // h = (v + l) / |v + l|
        let length = libm::sqrt(2.0 + 2.0 * self.across);
        let eye = self.eye.max(f64::powi(2.0, -12));
        let (a, between) = ((self.eye + self.lit) / length, length / 2.0);
        let cos2 = a * a;
        let d = libm::exp(-(1.0 - cos2) / (cos2 * s * s)) / (s * s * cos2 * cos2);
        let g = (2.0 * a * eye / between).min(2.0 * a * self.lit / between).min(1.0);
        let fresnel = f + (1.0 - f) * (1.0 - between).powi(5);
        fresnel * d * g / (4.0 * eye)
    }
}

/// `base^exponent`, whole ones by squaring: within their number of ulps, ten times as fast.
fn power(base: f64, exponent: f64) -> f64 {
    let whole = exponent as u16;
    if f64::from(whole) != exponent {
        return libm::pow(base, exponent);
    }
    let (mut result, mut square, mut rest) = (1.0, base, whole);
    while rest > 0 {
        if rest % 2 == 1 {
            result *= square;
        }
        square *= square;
        rest /= 2;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::{Environment, Finish};
    use crate::vector::normalised;

    const UP: [f64; 3] = [0.0, 0.0, 2.0];
    const BLACK: Environment = Environment::Plain { tone: 0.0 };

    #[test]
    fn a_diffuse_surface_follows_the_cosine_and_never_drops_below_its_ambient_part() {
        let material = Finish::Diffuse { ambient: 0.2 };
        let tone = |light| material.tone(UP, [1.0, 0.0, -1.0], light, &BLACK);
        assert!((tone([0.0, 3.0, 4.0]) - (0.2 + 0.8 * 0.8)).abs() < 1e-15);
        assert_eq!(tone([0.0, 3.0, -4.0]), 0.2);
    }

    #[test]
    fn a_phong_highlight_peaks_in_the_mirror_direction() {
        let material = Finish::Phong { ambient: 0.1, diffuse: 0.0, specular: 0.5, shininess: 2.0 };
        let tone = |light| material.tone(UP, [3.0, 0.0, -4.0], light, &BLACK);
        assert!((tone([3.0, 0.0, 4.0]) - 0.6).abs() < 1e-15);
        assert!((tone([0.0, 0.0, 1.0]) - (0.1 + 0.5 * 0.64)).abs() < 1e-15);
        assert_eq!(tone([-4.0, 0.0, 0.0]), 0.1);
        let bright = Finish::Phong { ambient: 0.9, diffuse: 1.0, specular: 1.0, shininess: 1.0 };
        assert_eq!(bright.tone(UP, [0.0, 0.0, -1.0], UP, &BLACK), 1.0);
    }

    #[test]
    fn a_level_mirror_shows_the_sky() {
        let sky = Environment::Gradient { zenith: 0.9, horizon: 0.5, nadir: 0.1 };
        let tone = Finish::Mirror.tone(UP, [3.0, 0.0, -4.0], UP, &sky);
        assert!((tone - (0.5 + 0.4 * 0.8)).abs() < 1e-15);
    }

    #[test]
    fn a_gradient_joins_zenith_horizon_and_nadir() {
        let sky = Environment::Gradient { zenith: 0.9, horizon: 0.5, nadir: 0.1 };
        assert_eq!(sky.tone([1.0, 0.0, 0.0]), 0.5);
        assert!((sky.tone([0.0, 0.0, 1.0]) - 0.9).abs() < 1e-15);
        assert!((sky.tone([0.8, 0.0, -0.6]) - (0.5 - 0.4 * 0.6)).abs() < 1e-15);
    }

    #[test]
    fn a_checkerboard_changes_at_every_square_and_fades_to_the_horizon() {
        let board =
            Environment::Checkerboard { scale: 2.0, bright: 0.75, dark: 0.25, horizon: 0.5, fade: 0.25 };
        // Towards the point (x, y) of the ceiling or floor at height z.
        let tone = |x: f64, y: f64, z: f64| board.tone(normalised([x, y, z]));
        assert_eq!((tone(0.2, 0.2, 1.0), tone(0.7, 0.2, 1.0), tone(0.7, 0.7, -1.0)), (0.75, 0.25, 0.75));
        assert_eq!((tone(-0.2, 0.2, 1.0), tone(-0.2, -0.2, -1.0)), (0.25, 0.75));
        assert_eq!(board.tone([0.0, 1.0, 0.0]), 0.5);
        // Half faded; 0.992 / 0.125 twice is 15.9, an odd square.
        assert_eq!(board.tone([0.992, 0.0, 0.125]), 0.375);
    }
}
