//! Bumps, as slopes `(b_u, b_v)` of a height over the texture coordinates, and grains, as angles by which the
//! frame is turned.
//!
//! Source: CONTRIBUTING.md, "The picture of a world, defined", Bumps and grains; course unit V, sections
//! 5.8.2 and 5.8.3; A. Appleby's MurmurHash3 for the facets.

use core::f64::consts::{FRAC_PI_2, TAU};

use crate::vector::{Vector, along, dot};
use crate::world::pattern::Pattern;
use crate::world::pigment::{Texels, Turbulence, odd_cube, odd_square};

/// The finaliser of MurmurHash3.
fn stirred(mut h: u32) -> u32 {
    h = (h ^ h >> 16).wrapping_mul(0x85eb_ca6b);
    h = (h ^ h >> 13).wrapping_mul(0xc2b2_ae35);
    h ^ h >> 16
}

fn length(v: Vector) -> f64 {
    libm::sqrt(dot(v, v))
}

impl Pattern<[f64; 2]> {
    /// Turbulence of the place in the world as height, by differences over the ray's width to both sides of
    /// the point along `P_u` and `P_v`; the width counts as `2^-10` at least and as 1 at most.
    pub fn rough(turbulence: Turbulence, height: f64) -> Self {
        Self(Box::new(move |p| {
            let step = p.width.clamp(1.0 / 1024.0, 1.0);
            [p.p_u, p.p_v].map(|tangent| {
                let size = length(tangent);
                if size == 0.0 {
                    return 0.0;
                }
                let at = |s: f64| turbulence.at(along(p.position, s / size, tangent));
                height * (at(step) - at(-step)) / (2.0 * step) * size
            })
        }))
    }

    /// Cells of texture coordinates with slopes of their own, up to `tilt` to a unit of length.
    pub fn facets(cells: [f64; 2], tilt: f64, seed: u32) -> Self {
        Self(Box::new(move |p| {
            let [i, j] = [0, 1].map(|k| libm::floor(p.uv[k] * cells[k]) as i64 as u32);
            let first = stirred(i ^ stirred(j ^ stirred(seed ^ 0x9e37_79b9)));
            let second = stirred(first ^ 0x2c1b_3c6d);
            let part = |hash: u32| f64::from(hash as i32) / 2_147_483_648.0;
            [part(first) * tilt * length(p.p_u), part(second) * tilt * length(p.p_v)]
        }))
    }

    /// The green of a picture as height, by differences over two texels.
    pub fn table(texels: Texels, height: f64) -> Self {
        let [columns, rows] = texels.size.map(|count| count as f64);
        Self(Box::new(move |p| {
            let at = |u: f64, v: f64| texels.mean([p.uv[0] + u, p.uv[1] + v], [0.0; 2])[1];
            let (right, up) = (1.0 / columns, 1.0 / rows);
            [
                height * (at(right, 0.0) - at(-right, 0.0)) / (2.0 * right),
                height * (at(0.0, up) - at(0.0, -up)) / (2.0 * up),
            ]
        }))
    }
}

impl Pattern<f64> {
    /// Threads that cross: along `P_u` in even cubes, a quarter of a turn from it in odd ones.
    pub fn threads_of_cubes(frequency: Vector) -> Self {
        Self(Box::new(move |p| if odd_cube(frequency, p) { FRAC_PI_2 } else { 0.0 }))
    }

    /// The same by squares of texture coordinates.
    pub fn threads_of_squares(frequency: [f64; 2]) -> Self {
        Self(Box::new(move |p| if odd_square(frequency, p) { FRAC_PI_2 } else { 0.0 }))
    }

    /// Turbulence of the place in the shape's coordinates, times so many turns.
    pub fn streaks(turbulence: Turbulence, turns: f64) -> Self {
        Self(Box::new(move |p| turbulence.at(p.generic) * turns * TAU))
    }

    /// The green of the nearest texel, 1 a whole turn.
    pub fn angles(texels: Texels) -> Self {
        Self(Box::new(move |p| texels.nearest(p.uv)[1] * TAU))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::pattern::Point;
    use crate::world::shape::Part;

    fn point(position: Vector, uv: [f64; 2], width: f64) -> Point {
        Point {
            position,
            generic: [0.0; 3],
            uv,
            normal: [0.0, 0.0, 1.0],
            p_u: [2.0, 0.0, 0.0],
            p_v: [0.0, 0.5, 0.0],
            leaf: 0,
            part: Part::Face(0),
            width,
        }
    }

    /// Near the lattice point (0, 0, 0), where the noise is that of one gradient.
    #[test]
    fn a_rough_surface_has_the_slopes_of_its_turbulence() {
        let turbulence = Turbulence { keys: [0; 3], frequency: 1.0, octaves: 2 };
        let rough = Pattern::rough(turbulence, 0.25);
        let p = [0.37, -1.61, 2.2];
        let [b_u, b_v] = rough.at(&point(p, [0.0; 2], 0.0));
        let at = |x: f64, y: f64| turbulence.at([p[0] + x, p[1] + y, p[2]]);
        let d = 1.0 / 4096.0;
        let slopes = [(at(d, 0.0) - at(-d, 0.0)) / (2.0 * d), (at(0.0, d) - at(0.0, -d)) / (2.0 * d)];
        assert!((b_u - 0.25 * slopes[0] * 2.0).abs() < 1e-5 && b_u.abs() > 1e-3, "{b_u}");
        assert!((b_v - 0.25 * slopes[1] * 0.5).abs() < 1e-5 && b_v.abs() > 1e-3, "{b_v}");
        // a wide ray sees less of it
        let wide = rough.at(&point(p, [0.0; 2], 4.0));
        assert!((wide[0] - 0.25 * (at(1.0, 0.0) - at(-1.0, 0.0))).abs() < 1e-12);
    }

    #[test]
    fn facets_are_level_on_average_and_differ_from_cell_to_cell() {
        let facets = Pattern::facets([16.0, 8.0], 0.25, 7);
        let at = |u: f64, v: f64| facets.at(&point([0.0; 3], [u, v], 0.0));
        let (mut sum, mut most) = ([0.0; 2], [0.0_f64; 2]);
        for (i, j) in (0..16).flat_map(|i| (0..8).map(move |j| (i, j))) {
            let slopes = at((f64::from(i) + 0.5) / 16.0, (f64::from(j) + 0.5) / 8.0);
            for k in 0..2 {
                sum[k] += slopes[k] / 128.0;
                most[k] = most[k].max(slopes[k].abs());
            }
        }
        // up to 1/4 a unit of length, P_u two units long and P_v half a one
        assert!(most[0] <= 0.5 && most[0] > 0.45 && most[1] <= 0.125 && most[1] > 0.11, "{most:?}");
        assert!(sum[0].abs() < 0.1 && sum[1].abs() < 0.03, "{sum:?}");
        assert_eq!(at(0.01, 0.01), at(0.06, 0.12));
        assert_ne!(at(0.01, 0.01), at(0.07, 0.12));
    }

    #[test]
    fn a_table_that_rises_has_a_slope() {
        let light = (0..8).map(|k| [0.0, f64::from(k % 4) / 4.0, 0.0]).collect();
        let table = Pattern::table(Texels { size: [4, 2], light }, 0.5);
        let slopes = table.at(&point([0.0; 3], [0.5, 0.5], 0.0));
        assert!((slopes[0] - 0.5).abs() < 1e-12 && slopes[1].abs() < 1e-12, "{slopes:?}");
    }
}
