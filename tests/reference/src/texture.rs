//! Textures, from the texts: noise, turbulence, checker, wood, marble, pictures on a surface, bumps, an image
//! all round.
//!
//! Sources: K. Perlin, "Improving Noise", 2002, with the permutation of his listing; the course unit V,
//! section 5.8, whose slips are mended: turbulence is `sum of 2^-(k+1) noise(2^k s p)`, marble
//! `undulate(sin(2 z + A turb))`, a bumpy normal `N + b_u (n x P_v) + b_v (P_u x n)`; Fritsch and Carlson,
//! "Monotone piecewise cubic interpolation", 1980, for the spline.

use crate::vector::{Vector, cross, dot};

const PERMUTATION: [usize; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30, 69, 142, 8, 99,
    37, 240, 21, 10, 23, 190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32,
    57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175, 74, 165, 71, 134, 139, 48, 27,
    166, 77, 146, 158, 231, 83, 111, 229, 122, 60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244,
    102, 143, 54, 65, 25, 63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169, 200, 196, 135, 130,
    116, 188, 159, 86, 164, 100, 109, 198, 173, 186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147,
    118, 126, 255, 82, 85, 212, 207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213, 119,
    248, 152, 2, 44, 154, 163, 70, 221, 153, 101, 155, 167, 43, 172, 9, 129, 22, 39, 253, 19, 98, 108, 110,
    79, 113, 224, 232, 178, 185, 112, 104, 218, 246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179,
    162, 241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106, 157, 184, 84, 204, 176,
    115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93, 222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78,
    66, 215, 61, 156, 180,
];

/// Perlin's noise at a place. `keys` choose another one than his: the first is added to the first index, the
/// others change the bits of what the permutation gives for it and for the second.
pub fn noise(keys: [u8; 3], place: Vector) -> f64 {
    let keys = keys.map(usize::from);
    let cell = place.map(libm::floor);
    let rest: Vector = core::array::from_fn(|i| place[i] - cell[i]);
    let index = cell.map(|c| c.rem_euclid(256.0) as usize);
    let p = |i: usize| PERMUTATION[i % 256];
    let mut sum = 0.0;
    for corner in 0..8_usize {
        let step = [corner >> 2, corner >> 1 & 1, corner & 1];
        let first = p(index[0] + step[0] + keys[0]) ^ keys[1];
        let second = p(first + index[1] + step[1]) ^ keys[2];
        let hash = p(second + index[2] + step[2]);
        let way: Vector = core::array::from_fn(|i| rest[i] - step[i] as f64);
        // the weight of a corner: the product along the axes
        let weight: f64 =
            (0..3).map(|i| if step[i] == 1 { fade(rest[i]) } else { 1.0 - fade(rest[i]) }).product();
        sum += weight * promise(hash & 15, way);
    }
    sum
}

fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Perlin's `grad`.
fn promise(hash: usize, [x, y, z]: Vector) -> f64 {
    let u = if hash < 8 { x } else { y };
    let v = if hash < 4 {
        y
    } else if hash == 12 || hash == 14 {
        x
    } else {
        z
    };
    (if hash & 1 == 0 { u } else { -u }) + (if hash & 2 == 0 { v } else { -v })
}

/// `turb(s, p)` with so many octaves.
pub fn turbulence(keys: [u8; 3], frequency: f64, octaves: u32, place: Vector) -> f64 {
    (0..octaves)
        .map(|k| {
            let scale = frequency * libm::exp2(f64::from(k));
            libm::exp2(-f64::from(k + 1)) * noise(keys, place.map(|c| scale * c))
        })
        .sum()
}

/// Which of two kinds of cubes of side `1 / frequency` a place is in: 0 for the one at the origin, with the
/// lattice moved by `offset` towards negative coordinates.
pub fn checker(frequency: Vector, offset: f64, place: Vector) -> u8 {
    let sum: f64 = (0..3).map(|i| libm::floor(frequency[i] * place[i] + offset)).sum();
    sum.rem_euclid(2.0) as u8
}

/// A log: rings round the z axis, or round another one when it is tilted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wood {
    /// Rings to a unit of length.
    pub rings: f64,
    /// How far the axis goes along x and y with each unit of z.
    pub tilt: [f64; 2],
    /// How many rings the rings wave in and out; inside the first one times the radius.
    pub wobble: f64,
    /// How often they do so in a turn.
    pub lobes: f64,
    /// How many turns the waves go round with each unit of z.
    pub twist: f64,
}

impl Wood {
    /// The distance from the axis in rings, with its waves; `rough` rings are added.
    pub fn radius(&self, [x, y, z]: Vector, rough: f64) -> f64 {
        let (x, y) = (x - self.tilt[0] * z, y - self.tilt[1] * z);
        let angle = libm::atan2(y, x) * self.lobes + self.twist * z * core::f64::consts::TAU;
        let ideal = self.rings * libm::sqrt(x * x + y * y);
        ideal + self.wobble * ideal.clamp(-1.0, 1.0) * libm::sin(angle) + rough
    }
}

/// `rings(r) = int(r) mod 2`.
pub fn rings(radius: f64) -> u8 {
    libm::floor(radius).rem_euclid(2.0) as u8
}

/// `sin(2 z + A turb)`, with `frequency` in place of 2.
pub fn vein(frequency: f64, amplitude: f64, turbulence: f64, place: Vector) -> f64 {
    libm::sin(frequency * place[2] + amplitude * turbulence)
}

/// The monotone cubic through `knots`, `(x, y)` with growing `x`, level at both ends and beyond them.
pub fn spline(knots: &[(f64, f64)], x: f64) -> f64 {
    let last = knots.len() - 1;
    if x <= knots[0].0 {
        return knots[0].1;
    }
    if x >= knots[last].0 {
        return knots[last].1;
    }
    let width = |i: usize| knots[i + 1].0 - knots[i].0;
    let secant = |i: usize| (knots[i + 1].1 - knots[i].1) / width(i);
    let slope = |i: usize| {
        if i == 0 || i == last || secant(i - 1) * secant(i) <= 0.0 {
            return 0.0;
        }
        // the weighted harmonic mean of the secants on both sides
        let (before, after) = (width(i - 1) + 2.0 * width(i), 2.0 * width(i - 1) + width(i));
        (before + after) / (before / secant(i - 1) + after / secant(i))
    };
    let i = (0..last).rev().find(|i| knots[*i].0 <= x).expect("x is beyond the first knot");
    let (h, t) = (width(i), (x - knots[i].0) / width(i));
    let hermite = [
        (1.0 + 2.0 * t) * (1.0 - t) * (1.0 - t),
        t * (1.0 - t) * (1.0 - t),
        t * t * (3.0 - 2.0 * t),
        t * t * (t - 1.0),
    ];
    hermite[0] * knots[i].1
        + hermite[1] * h * slope(i)
        + hermite[2] * knots[i + 1].1
        + hermite[3] * h * slope(i + 1)
}

/// The mean of an image over a box of texture space, the image repeated in both directions: `texel(i, j)` of
/// `columns` times `rows`, row 0 at the top, where `v` is 1.
pub fn image_mean(
    texel: impl Fn(usize, usize) -> f64,
    [columns, rows]: [usize; 2],
    [u, v]: [f64; 2],
    [across, up]: [f64; 2],
) -> f64 {
    let shares = |middle: f64, width: f64, count: usize| {
        let (from, to) = ((middle - width / 2.0) * count as f64, (middle + width / 2.0) * count as f64);
        let (first, last) = (libm::floor(from) as i64, libm::ceil(to) as i64);
        (first..last).map(move |i| {
            let share = (to.min(i as f64 + 1.0) - from.max(i as f64)) / (to - from);
            (i.rem_euclid(count as i64) as usize, share)
        })
    };
    shares(u, across, columns)
        .flat_map(|(i, a)| shares(1.0 - v, up, rows).map(move |(j, b)| (i, j, a * b)))
        .map(|(i, j, share)| share * texel(i, j))
        .sum()
}

/// `N' = N + b_u (n x P_v) + b_v (P_u x n)`, not normalised, for `N = P_u x P_v` and `n = N / |N|`.
pub fn bumped(along_u: Vector, along_v: Vector, [b_u, b_v]: [f64; 2]) -> Vector {
    let normal = cross(along_u, along_v);
    let length = libm::sqrt(dot(normal, normal));
    let unit = normal.map(|c| c / length);
    let (first, second) = (cross(unit, along_v), cross(along_u, unit));
    core::array::from_fn(|i| normal[i] + b_u * first[i] + b_v * second[i])
}

/// Where on an image all round a direction looks: `u` from the x axis towards the y axis, 0 to 1, `v` from
/// straight down to straight up.
pub fn all_round([x, y, z]: Vector) -> [f64; 2] {
    let turn = libm::atan2(y, x) / core::f64::consts::TAU;
    [turn - libm::floor(turn), 0.5 + libm::atan2(z, libm::hypot(x, y)) / core::f64::consts::PI]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A value that many implementations of the reference implementation agree on.
    #[test]
    fn noise_has_its_published_values() {
        // as published: 3.14, which is not pi
        let published = [314.0 / 100.0, 42.0, 7.0];
        assert!((noise([0; 3], published) - 0.136_919_958_784_000_12).abs() < 1e-15);
        assert_eq!(noise([0; 3], [-3.0, 42.0, 256.0]), 0.0);
        assert_eq!(noise([0; 3], [0.25, 0.5, -0.75]), noise([0; 3], [256.25, -255.5, -256.75]));
    }

    #[test]
    fn a_spline_goes_through_its_knots_and_is_monotone_in_between() {
        let knots = [(-1.0, 0.1), (-0.25, 0.2), (0.0, 0.75), (0.5, 0.8), (1.0, 0.3)];
        for (x, y) in knots {
            assert!((spline(&knots, x) - y).abs() < 1e-15);
        }
        let values: Vec<f64> = (0..=150).map(|i| spline(&knots, -1.0 + f64::from(i) / 100.0)).collect();
        assert!(values.is_sorted());
        assert_eq!((spline(&knots, -3.0), spline(&knots, 2.0)), (0.1, 0.3));
    }

    #[test]
    fn a_slope_along_u_turns_the_normal_against_u() {
        let normal = bumped([2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.5, 0.0]);
        // the surface z = b = x / 4: normal (-1/4, 0, 1), here 6 times as long
        assert_eq!(normal, [-1.5, 0.0, 6.0]);
        assert_eq!(bumped([2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 1.5]), [0.0, -3.0, 6.0]);
    }

    #[test]
    fn the_mean_of_an_image_over_a_texel_is_the_texel_and_over_all_the_mean() {
        let texel = |i: usize, j: usize| (i + 10 * j) as f64;
        assert!((image_mean(texel, [4, 2], [0.375, 0.75], [0.25, 0.5]) - 1.0).abs() < 1e-12);
        assert!((image_mean(texel, [4, 2], [0.3, 0.1], [1.0, 1.0]) - 6.5).abs() < 1e-12);
        // half of the last texel of the lower row and half of its first
        assert!((image_mean(texel, [4, 2], [0.0, 0.25], [0.25, 0.5]) - 11.5).abs() < 1e-12);
    }

    #[test]
    fn directions_look_where_they_should() {
        assert_eq!(all_round([1.0, 0.0, 0.0]), [0.0, 0.5]);
        assert_eq!(all_round([0.0, -2.0, 0.0]), [0.75, 0.5]);
        assert_eq!(all_round([0.0, 0.0, 1.0])[1], 1.0);
    }

    #[test]
    fn turbulence_checker_rings_and_veins_are_their_formulas() {
        let place = [0.3, -1.7, 2.9];
        let three: f64 = [(1.0, 0.5), (2.0, 0.25), (4.0, 0.125)]
            .iter()
            .map(|(s, part)| part * noise([0; 3], place.map(|c| s * c)))
            .sum();
        assert!((turbulence([0; 3], 1.0, 3, place) - three).abs() < 1e-15);
        assert_eq!(checker([1.0; 3], 0.0, [0.5, 0.5, -0.5]), 1);
        assert_eq!(checker([2.0; 3], 0.0, [0.75, 0.75, 0.0]), 0);
        assert_eq!((rings(0.5), rings(1.5), rings(-0.5)), (0, 1, 1));
        let wood = Wood { rings: 2.0, tilt: [1.0, 0.0], wobble: 0.5, lobes: 3.0, twist: 0.25 };
        assert!(
            (wood.radius([3.0, 1.0, 0.0], 0.0)
                - (2.0 * 10_f64.sqrt() + 0.5 * (3.0 * libm::atan2(1.0, 3.0)).sin()))
            .abs()
                < 1e-14
        );
        assert!((wood.radius([4.0, 0.0, 1.0], 0.25) - 6.75).abs() < 1e-14);
        assert!((vein(2.0, 3.0, 0.5, [9.0, 9.0, 0.25]) - 2_f64.sin()).abs() < 1e-15);
    }
}
