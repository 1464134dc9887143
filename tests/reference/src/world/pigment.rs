//! Textures of a world as functions of the point that is seen: solid ones of its generic coordinates, others
//! of its texture coordinates.
//!
//! Source: CONTRIBUTING.md, "The picture of a world, defined", Textures; course unit V, section 5.8.

use crate::texture::{self, Wood};
use crate::vector::{Vector, dot};
use crate::world::light::Colour;
use crate::world::pattern::{Pattern, Point};

/// How far the seams of a checker lie towards smaller coordinates, in cubes: about `2^-11.7`.
const SEAM: f64 = 5_063.0 / 16_777_216.0;

/// Turbulence of a noise with these keys.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turbulence {
    /// As [`texture::noise`] has them.
    pub keys: [u8; 3],
    /// Lumps to a unit of length.
    pub frequency: f64,
    /// How many sizes of them.
    pub octaves: u32,
}

impl Turbulence {
    /// Its value at a place.
    pub fn at(&self, place: Vector) -> f64 {
        texture::turbulence(self.keys, self.frequency, self.octaves, place)
    }
}

/// How a picture is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lookup {
    /// The texel at the place.
    Nearest,
    /// The mean over a box as large as a texel.
    Bilinear,
    /// The mean over what the ray covers, and over a texel at least.
    Area,
}

/// A picture: texels row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Texels {
    /// Columns and rows.
    pub size: [usize; 2],
    /// Their light.
    pub light: Vec<Colour>,
}

impl Texels {
    /// The mean over a box round a place, a texel wide and high at least and at most the whole picture.
    pub fn mean(&self, uv: [f64; 2], parts: [f64; 2]) -> Colour {
        let box_of = |k: usize| parts[k].max(1.0 / self.size[k] as f64).min(1.0);
        let texel = |c: usize| move |i: usize, j: usize| self.light[j * self.size[0] + i][c];
        [0, 1, 2].map(|c| texture::image_mean(texel(c), self.size, uv, [box_of(0), box_of(1)]))
    }

    /// The mean over a box that is moved down or up into the picture, which closes at its sides only.
    pub fn within(&self, u: f64, v: f64, [across, up]: [f64; 2]) -> Colour {
        let up = up.max(1.0 / self.size[1] as f64).min(1.0);
        self.mean([u, v.clamp(up / 2.0, 1.0 - up / 2.0)], [across, up])
    }

    /// The texel at a place; a lower edge is the texel's own.
    pub fn nearest(&self, [u, v]: [f64; 2]) -> Colour {
        let index = |c: f64, count: usize| (c * count as f64).rem_euclid(count as f64) as usize % count;
        let [columns, rows] = self.size;
        let down = (1.0 - v) * rows as f64;
        let j = (libm::ceil(down) - 1.0).rem_euclid(rows as f64) as usize;
        self.light[j * columns + index(u, columns)]
    }
}

/// The colour of a spline through knots at a number.
fn undulate(knots: &[(f64, Colour)], x: f64) -> Colour {
    [0, 1, 2].map(|c| {
        let part: Vec<(f64, f64)> = knots.iter().map(|(knot, light)| (*knot, light[c])).collect();
        texture::spline(&part, x)
    })
}

/// `a + (b - a) s`.
fn mixed(a: Colour, b: Colour, s: f64) -> Colour {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * s)
}

/// What part of a unit of a texture coordinate a ray covers.
pub(super) fn footprint(width: f64, along: Vector) -> f64 {
    let length = libm::sqrt(dot(along, along));
    if length > 0.0 { (width / length).min(1.0) } else { 1.0 }
}

impl Pattern<Colour> {
    /// Cubes of two colours, that of the origin first.
    pub fn cubes(frequency: Vector, colours: [Colour; 2]) -> Self {
        Self(Box::new(move |p| colours[usize::from(texture::checker(frequency, SEAM, p.generic))]))
    }

    /// Squares of texture coordinates.
    pub fn squares([across, up]: [f64; 2], colours: [Colour; 2]) -> Self {
        Self(Box::new(move |p| colours[usize::from(odd_square([across, up], p))]))
    }

    /// The spline at the turbulence.
    pub fn mottle(knots: Vec<(f64, Colour)>, turbulence: Turbulence) -> Self {
        Self(Box::new(move |p| undulate(&knots, turbulence.at(p.generic))))
    }

    /// The spline at `sin(f z + A turb)`.
    pub fn marble(knots: Vec<(f64, Colour)>, turbulence: Turbulence, amplitude: f64, frequency: f64) -> Self {
        Self(Box::new(move |p| {
            undulate(&knots, texture::vein(frequency, amplitude, turbulence.at(p.generic), p.generic))
        }))
    }

    /// Rings of two colours, each over the first part `soft` of a ring from the one before.
    pub fn wood(wood: Wood, colours: [Colour; 2], rough: Option<(Turbulence, f64)>, soft: f64) -> Self {
        Self(Box::new(move |p| {
            let rough = rough.map_or(0.0, |(turbulence, rings)| rings * turbulence.at(p.generic));
            let radius = wood.radius(p.generic, rough);
            let now = usize::from(texture::rings(radius));
            let into = radius - libm::floor(radius);
            if into < soft { mixed(colours[1 - now], colours[now], into / soft) } else { colours[now] }
        }))
    }

    /// A picture by `U = a s + b t + c`, `V` likewise.
    ///
    /// # Panics
    /// When both are the same coordinate.
    pub fn image(texels: Texels, lookup: Lookup, rows: [Vector; 2]) -> Self {
        let [[a, b, _], [c, d, _]] = rows;
        let determinant = a * d - b * c;
        assert!(determinant != 0.0, "{rows:?} is one coordinate");
        Self(Box::new(move |p| {
            let uv = rows.map(|[a, b, c]| a * p.uv[0] + b * p.uv[1] + c);
            let sum = |s: f64, t: f64| [0, 1, 2].map(|k| (s * p.p_u[k] + t * p.p_v[k]) / determinant);
            match lookup {
                Lookup::Nearest => texels.nearest(uv),
                Lookup::Bilinear => texels.mean(uv, [0.0; 2]),
                Lookup::Area => {
                    texels.mean(uv, [sum(d, -c), sum(-b, a)].map(|along| footprint(p.width, along)))
                }
            }
        }))
    }

    /// With another one inside a convex polygon of texture coordinates, its edge included.
    pub fn pasted(self, detail: Self, corners: Vec<[f64; 2]>) -> Self {
        Self(Box::new(move |p| {
            let next = corners.iter().cycle().skip(1);
            let turn = |a: [f64; 2], b: [f64; 2]| {
                (b[0] - a[0]) * (p.uv[1] - a[1]) - (b[1] - a[1]) * (p.uv[0] - a[0])
            };
            let inside = corners.iter().zip(next).all(|(a, b)| turn(*a, *b) >= 0.0);
            if inside { detail.at(p) } else { self.at(p) }
        }))
    }
}

/// Whether a point is on an odd square of texture coordinates.
pub(super) fn odd_square([across, up]: [f64; 2], point: &Point) -> bool {
    texture::checker([across, up, 0.0], SEAM, [point.uv[0], point.uv[1], 0.0]) > 0
}

/// Whether a point is in an odd cube.
pub(super) fn odd_cube(frequency: Vector, point: &Point) -> bool {
    texture::checker(frequency, SEAM, point.generic) > 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::shape::Part;

    fn point(uv: [f64; 2]) -> Point {
        Point {
            position: [9.0; 3],
            generic: [0.3, -1.7, 2.9],
            uv,
            normal: [0.0, 0.0, 1.0],
            p_u: [2.0, 0.0, 0.0],
            p_v: [0.0, 1.0, 0.0],
            leaf: 0,
            part: Part::Face(0),
            width: 0.5,
        }
    }

    #[test]
    fn a_pattern_shows_its_detail_inside_its_polygon_and_on_its_edge() {
        let [white, black] = [[1.0; 3], [0.0; 3]];
        let corners = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let pasted = Pattern::plain(black).pasted(Pattern::plain(white), corners);
        for (uv, light) in [
            ([0.25, 0.25], white),
            ([0.5, 0.5], white),
            ([0.0, 0.75], white),
            ([0.6, 0.5], black),
            ([-0.1, 0.1], black),
        ] {
            assert_eq!(pasted.at(&point(uv)), light, "{uv:?}");
        }
    }

    #[test]
    fn a_picture_is_seen_by_its_coordinates_and_by_what_the_ray_covers() {
        let light = (0..8).map(|k| [f64::from(k), 0.0, 0.0]).collect();
        let texels = Texels { size: [4, 2], light };
        let rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let seen = |lookup, rows, uv| Pattern::image(texels.clone(), lookup, rows).at(&point(uv))[0];
        assert_eq!(seen(Lookup::Nearest, rows, [0.3, 0.9]), 1.0);
        // an edge between two rows is the upper one's
        assert_eq!(
            (seen(Lookup::Nearest, rows, [0.0, 0.5]), seen(Lookup::Nearest, rows, [1.3, 0.49])),
            (0.0, 5.0)
        );
        assert_eq!(seen(Lookup::Bilinear, rows, [0.375, 0.75]), 1.0);
        // 1/4 of the picture across, all but a texel of it up
        assert_eq!(seen(Lookup::Area, rows, [0.375, 0.75]), 1.0);
        // twice as often, so that half of it is covered: from 1/4 to 3/4
        let twice = [[2.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert!((seen(Lookup::Area, twice, [0.25, 0.75]) - 1.5).abs() < 1e-12);
    }

    #[test]
    fn softness_leads_over_from_the_ring_before() {
        let wood = Wood { rings: 1.0, tilt: [0.0; 2], wobble: 0.0, lobes: 0.0, twist: 0.0 };
        let soft = Pattern::wood(wood, [[0.0; 3], [1.0; 3]], None, 0.5);
        let at = |x: f64| soft.at(&Point { generic: [x, 0.0, 0.0], ..point([0.0; 2]) })[0];
        assert_eq!([at(0.75), at(1.0), at(1.25), at(1.75), at(2.125)], [0.0, 0.0, 0.5, 1.0, 0.75]);
    }
}
