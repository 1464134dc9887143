//! What a surface is made of: its colours, and how much of a light it sends back towards the eye.
//!
//! With `v` the unit direction towards the eye, `l` towards the light, `m` the eye's ray mirrored and
//! `h = (v + l) / |v + l|`, all dot products clamped at 0:
//! - Phong `(m . l)^e`;
//! - Torrance-Sparrow `F D G / (4 n . v)`: `D = exp(-tan^2 a / s^2) / (s^2 cos^4 a)` with `cos a = n . h`,
//!   the facets that mirror `l` to `v`;
//!   `G = min(1, 2 (n . h) (n . v) / (v . h), 2 (n . h) (n . l) / (v . h))`, those not in the shade of
//!   others;
//!   `F = f + (1 - f) (1 - v . h)^5`;
//! - a table of slopes: so with `D = pi P / cos^4 a`, `P` the density of the slopes `-(h . T) / (n . h)`
//!   and `-(h . B) / (n . h)`, 0 where `cos^2 a` is below 1/32;
//! - Ward, with a frame `T, B`:
//!   `sqrt((n . l) / (n . v)) exp(-((h . T / s)^2 + (h . B / q)^2) / (h . n)^2) / (4 s q)`.
//!
//! Source: CONTRIBUTING.md, "The picture of a world, defined", Material; course unit V, section 5.9; R. Cook
//! and K. Torrance, "A reflectance model for computer graphics", 1982; G. Ward, "Measuring and modeling
//! anisotropic reflection", 1992; C. Schlick, "An inexpensive BRDF model", 1994 (F).

use crate::vector::{Vector, along, dot};
use crate::world::light::Colour;
use crate::world::pattern::Pattern;
use crate::world::refraction::mirrored;

/// How much of a surface leans which way: weights of equal squares of slopes `(p, q)`, from `-reach` to
/// `reach`, a row along `p` for each `q`; between their middles bilinear, beyond them 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Slopes {
    reach: f64,
    weights: Vec<Vec<f64>>,
    sum: f64,
}

impl Slopes {
    /// From the weights, as many a row as there are rows.
    pub fn new(reach: f64, rows: impl Iterator<Item = impl Iterator<Item = f64>>) -> Self {
        let weights: Vec<Vec<f64>> = rows.map(Iterator::collect).collect();
        let sum = weights.iter().flatten().sum();
        Self { reach, weights, sum }
    }

    /// The density at a slope, of integral 1.
    fn density(&self, p: f64, q: f64) -> f64 {
        let per_slope = self.weights.len() as f64 / (2.0 * self.reach);
        let place = |s: f64| (s + self.reach) * per_slope - 0.5;
        let (x, y) = (place(p), place(q));
        let (i, j) = (libm::floor(x), libm::floor(y));
        let inside = |k: f64| (k >= 0.0).then_some(k as usize);
        let weight = |i: f64, j: f64| {
            let row = inside(j).and_then(|j| self.weights.get(j));
            row.zip(inside(i)).and_then(|(row, i)| row.get(i)).copied().unwrap_or(0.0)
        };
        let row = |j: f64| weight(i, j) * (1.0 - (x - i)) + weight(i + 1.0, j) * (x - i);
        (row(j) * (1.0 - (y - j)) + row(j + 1.0) * (y - j)) * per_slope * per_slope / self.sum
    }
}

/// How a surface shines.
#[derive(Debug, Clone, PartialEq)]
pub enum Specular {
    /// Not at all.
    None,
    /// A round highlight.
    Phong {
        /// `ks`.
        colour: Colour,
        /// `e`.
        exponent: f64,
    },
    /// Facets that mirror.
    TorranceSparrow {
        /// `ks`.
        colour: Colour,
        /// `s`.
        roughness: f64,
        /// `f`, the reflectance at right angles.
        reflectance: f64,
    },
    /// Along the grain otherwise than across it.
    Ward {
        /// `ks`.
        colour: Colour,
        /// `s`, the roughness along `T`.
        along: f64,
        /// `q`, the roughness along `B`.
        across: f64,
    },
    /// Facets that lean as a table says, along `T` and across it.
    Tabulated {
        /// `ks`.
        colour: Colour,
        /// How many lean which way.
        slopes: Slopes,
        /// `f`, the reflectance at right angles.
        reflectance: f64,
    },
}

impl Specular {
    /// What of the light of unit colour from `l` goes towards `v`; `n`, `T`, `B` is the frame of the surface.
    pub fn answer(&self, [n, t, b]: [Vector; 3], v: Vector, l: Vector) -> Colour {
        let clamped = |a: Vector, b: Vector| dot(a, b).max(0.0);
        let sum = along(v, 1.0, l);
        let length = libm::sqrt(dot(sum, sum));
        // Exactly against the light: no half-way direction, and nothing seen.
        let h = sum.map(|c| if length > 0.0 { c / length } else { 0.0 });
        let (n_v, n_l, n_h) = (clamped(n, v), clamped(n, l), clamped(n, h));
        let facets = |reflectance: f64, d: f64| {
            let v_h = clamped(v, h);
            let g = (2.0 * n_h * n_v / v_h).min(2.0 * n_h * n_l / v_h).min(1.0);
            let f = reflectance + (1.0 - reflectance) * libm::pow(1.0 - v_h, 5.0);
            f * d * g / (4.0 * n_v)
        };
        let dark = n_v == 0.0 || n_l == 0.0 || n_h == 0.0;
        let (colour, part) = match *self {
            Specular::None => return [0.0; 3],
            Specular::Phong { colour, exponent } => {
                let m = mirrored(v.map(|c| -c), n);
                (colour, libm::pow(clamped(m, l), exponent))
            }
            _ if dark => return [0.0; 3],
            Specular::TorranceSparrow { colour, roughness, reflectance } => {
                let square = n_h * n_h;
                let tan = (1.0 - square) / square;
                let s = roughness * roughness;
                (colour, facets(reflectance, libm::exp(-tan / s) / (s * square * square)))
            }
            Specular::Tabulated { colour, ref slopes, reflectance } => {
                let square = n_h * n_h;
                let density = slopes.density(-dot(h, t) / n_h, -dot(h, b) / n_h);
                let d = if square < 1.0 / 32.0 { 0.0 } else { core::f64::consts::PI * density };
                (colour, facets(reflectance, d / (square * square)))
            }
            Specular::Ward { colour, along, across } => {
                let (x, y) = (dot(h, t) / along, dot(h, b) / across);
                let lobe = libm::exp(-(x * x + y * y) / (n_h * n_h));
                (colour, libm::sqrt(n_l / n_v) * lobe / (4.0 * along * across))
            }
        };
        colour.map(|c| c * part)
    }
}

/// A material.
#[derive(Debug)]
pub struct Material {
    /// `C`.
    pub pigment: Pattern<Colour>,
    /// `ka`.
    pub ambient: f64,
    /// `kd`.
    pub diffuse: f64,
    /// The highlight.
    pub specular: Specular,
    /// `kr`.
    pub reflect: Colour,
    /// `kt`, of a transparent material.
    pub transmit: Colour,
    /// The index of refraction of a transparent material.
    pub index: Option<f64>,
    /// Whether Fresnel's share of the refracted light is reflected.
    pub fresnel: bool,
    /// Which of several media at a point counts: the one of the highest priority.
    pub priority: i32,
    /// The height that is added to the surface along its normal, as its slopes `(b_u, b_v)`.
    pub bump: Option<Pattern<[f64; 2]>>,
    /// The angle by which the frame is turned about the normal, in radians, from `T` to `B`.
    pub frame: Option<Pattern<f64>>,
}

impl Material {
    /// Diffuse, `ka` 0 and `kd` 1.
    pub fn matte(pigment: Pattern<Colour>) -> Material {
        Material {
            pigment,
            ambient: 0.0,
            diffuse: 1.0,
            specular: Specular::None,
            reflect: [0.0; 3],
            transmit: [0.0; 3],
            index: None,
            fresnel: false,
            priority: 0,
            bump: None,
            frame: None,
        }
    }

    /// A perfect mirror.
    pub fn mirror() -> Material {
        Material { diffuse: 0.0, reflect: [1.0; 3], ..Self::matte(Pattern::plain([1.0; 3])) }
    }

    /// Clear, with Fresnel's reflection.
    pub fn glass(index: f64) -> Material {
        Material {
            diffuse: 0.0,
            transmit: [1.0; 3],
            index: Some(index),
            fresnel: true,
            ..Self::matte(Pattern::plain([1.0; 3]))
        }
    }

    /// What of a light passes: `kt`, or nothing.
    pub fn passes(&self) -> Colour {
        if self.index.is_some() { self.transmit } else { [0.0; 3] }
    }
}

#[cfg(test)]
mod tests {
    use super::Specular;
    use crate::vector::normalised;

    const FRAME: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    const GREY: [f64; 3] = [0.5, 0.25, 1.0];

    fn directions() -> Vec<[f64; 3]> {
        let around = |k: i32| {
            let (a, z) = (f64::from(k) * 2.4, 0.02 + 0.97 * f64::from(k) / 40.0);
            let rho = libm::sqrt(1.0 - z * z);
            [rho * libm::cos(a), rho * libm::sin(a), z]
        };
        (0..40).map(around).collect()
    }

    /// The light from `l` is `n . l` times the reflection function: the latter is the same both ways.
    fn assert_reciprocal(specular: &Specular) {
        let (mut tried, mut largest) = (0, 0.0_f64);
        for v in directions() {
            for l in directions() {
                let one = specular.answer(FRAME, v, l).map(|c| c / l[2]);
                let other = specular.answer(FRAME, l, v).map(|c| c / v[2]);
                for k in 0..3 {
                    assert!((one[k] - other[k]).abs() <= 1e-11 * one[k].abs() + 1e-300, "{v:?} {l:?}");
                    largest = largest.max(one[k]);
                }
                tried += 1;
            }
        }
        assert!(tried == 1600 && largest > 0.5, "{tried} {largest}");
    }

    #[test]
    fn torrance_sparrow_and_ward_are_reciprocal() {
        for roughness in [0.1, 0.4] {
            let colour = GREY;
            assert_reciprocal(&Specular::TorranceSparrow { colour, roughness, reflectance: 0.1 });
            assert_reciprocal(&Specular::Ward { colour, along: roughness, across: 0.2 });
        }
    }

    #[test]
    fn torrance_sparrow_straight_on_is_the_reflectance_over_four_squares_of_the_roughness() {
        let specular = Specular::TorranceSparrow { colour: GREY, roughness: 0.5, reflectance: 0.2 };
        let up = [0.0, 0.0, 1.0];
        let answer = specular.answer(FRAME, up, up);
        for k in 0..3 {
            assert!((answer[k] - GREY[k] * 0.2).abs() < 1e-15);
        }
    }

    /// The sum of the answers to lights all over the hemisphere, over pi: what a white sky sends back.
    fn albedo(specular: &Specular, v: [f64; 3]) -> f64 {
        let mut sum = 0.0;
        let count = 400;
        for i in 0..count {
            for j in 0..count {
                let z = (f64::from(i) + 0.5) / f64::from(count);
                let a = (f64::from(j) + 0.5) / f64::from(count) * core::f64::consts::TAU;
                let rho = libm::sqrt(1.0 - z * z);
                sum += specular.answer(FRAME, v, [rho * libm::cos(a), rho * libm::sin(a), z])[0];
            }
        }
        sum * core::f64::consts::TAU / f64::from(count * count) / core::f64::consts::PI
    }

    #[test]
    fn no_highlight_sends_back_more_than_it_gets() {
        let colour = [1.0; 3];
        let mut largest = 0.0_f64;
        for z in [0.1, 0.3, 0.7, 1.0] {
            let v = normalised([libm::sqrt(1.0 - z * z), 0.0, z]);
            for roughness in [0.2, 0.5] {
                let shiny = Specular::TorranceSparrow { colour, roughness, reflectance: 1.0 };
                let grain = Specular::Ward { colour, along: roughness, across: 0.3 };
                for specular in [&shiny, &grain] {
                    let sent = albedo(specular, v);
                    assert!(sent < 1.001, "{specular:?} {z}: {sent}");
                    largest = largest.max(sent);
                }
            }
        }
        assert!(largest > 0.8, "{largest}");
    }

    #[test]
    fn a_ward_highlight_is_longer_across_the_smooth_direction() {
        let grain = Specular::Ward { colour: [1.0; 3], along: 0.1, across: 0.5 };
        let v = [0.0, 0.0, 1.0];
        let along = grain.answer(FRAME, v, normalised([0.5, 0.0, 1.0]))[0];
        let across = grain.answer(FRAME, v, normalised([0.0, 0.5, 1.0]))[0];
        assert!(across > 50.0 * along, "{along} {across}");
    }

    #[test]
    fn a_phong_highlight_peaks_where_the_ray_is_mirrored() {
        let shiny = Specular::Phong { colour: GREY, exponent: 2.0 };
        let v = [0.6, 0.0, 0.8];
        assert!((shiny.answer(FRAME, v, [-0.6, 0.0, 0.8])[1] - 0.25).abs() < 1e-15);
        assert!((shiny.answer(FRAME, v, [0.0, 0.0, 1.0])[1] - 0.25 * 0.64).abs() < 1e-15);
    }
}
