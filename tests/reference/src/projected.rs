//! What the pixels of a height field `f(x) g(y)` show: the mean of the tone over a pixel's area, with every
//! place of the surface projected into the picture.
//!
//! The surface is cut into `n x n` equal squares of its domain; each stands for an area of the picture in
//! proportion to `-n . v / depth^3`, `n = (-h_x, -h_y, 1)`, `v` from the eye to the surface. Along a square
//! of a rough surface the slope still varies: it stands with its mean, the rise over the length, and by turns
//! above and below by its deviation, so that neighbours together have its mean and variance. (With the slopes
//! at their middles, a picture of 24,000 squares a side is off by 0.0004, as all squares above one `x` err
//! alike; with these, one of 6,000 by 0.00004.) A pixel that is covered once over, by a surface that nowhere
//! turns away, is interior: what it shows needs no other rays. Source: CONTRIBUTING.md, "The filtered picture
//! of a height field, defined"; Cochran, Lewis and Hart, eq. 52 with the weight 1 over the pixel.

use crate::camera::Camera;
use crate::shade::{Environment, Facing, Finish};
use crate::surface::Factor;
use crate::vector::{Vector, cross, dot, normalised};

/// How a surface is looked at: its finish under an environment.
pub type Look = (Finish, Environment);

/// A pixel: how many places of the surface it has, and its tone by each look.
#[derive(Debug, Clone, PartialEq)]
pub struct Pixel {
    /// Column and row.
    pub at: (usize, usize),
    /// Places of the surface inside.
    pub places: usize,
    /// One a look.
    pub tones: Vec<f64>,
}

/// One of the equal parts of a domain: its middle, the mean slope, the deviation of the slope, the mean
/// value.
struct Part {
    at: f64,
    slope: f64,
    deviation: f64,
    value: f64,
}

fn table(factor: &Factor, n: usize) -> Vec<Part> {
    const PLACES: usize = 48;
    let knots = &factor.value.knots_x;
    let (from, to) = (knots[0], knots[knots.len() - 1]);
    let length = (to - from) / n as f64;
    let at = |i: f64| from + length * i;
    let part = |i: usize| {
        let [a, b] = [i, i + 1].map(|i| factor.value.at(at(i as f64)));
        let slopes = (0..PLACES).map(|k| factor.slope.at(at(i as f64 + (k as f64 + 0.37) / PLACES as f64)));
        let (sum, squares) = slopes.fold((0.0, 0.0), |(sum, squares), s| (sum + s, squares + s * s));
        let mean = sum / PLACES as f64;
        let deviation = libm::sqrt((squares / PLACES as f64 - mean * mean).max(0.0));
        Part { at: at(i as f64 + 0.5), slope: (b - a) / length, deviation, value: (a + b) / 2.0 }
    };
    (0..n).map(part).collect()
}

/// A place of a surface: where it is, and its slopes.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// Coordinates.
    pub at: Vector,
    /// Along x and y.
    pub slopes: [f64; 2],
}

/// The interior pixels of a picture of `side x side` pixels, from `n x n` places of a product.
pub fn interior(
    (x, y): (&Factor, &Factor),
    camera: &Camera,
    light: Vector,
    looks: &[Look],
    side: usize,
    n: usize,
) -> Vec<Pixel> {
    let (xs, ys) = (table(x, n), table(y, n));
    let length = |t: &[Part]| t[1].at - t[0].at;
    let ground = length(&xs) * length(&ys);
    let sign = |odd: bool| if odd { -1.0 } else { 1.0 };
    let place = |(i, j): (usize, usize)| {
        let (x, y) = (&xs[i], &ys[j]);
        // along x in turns with j, along y with i and half as often with j: all four pairs alike
        let f = x.slope + x.deviation * sign(j % 2 == 1);
        let g = y.slope + y.deviation * sign((i + j / 2) % 2 == 1);
        Place { at: [x.at, y.at, x.value * y.value], slopes: [f * y.value, x.value * g] }
    };
    let places = (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(place);
    interior_of(places, ground, camera, light, looks, side)
}

/// The same from any places, each above as much `ground`.
pub fn interior_of(
    places: impl Iterator<Item = Place>,
    ground: f64,
    camera: &Camera,
    light: Vector,
    looks: &[Look],
    side: usize,
) -> Vec<Pixel> {
    let w = normalised([0, 1, 2].map(|i| camera.look_at[i] - camera.eye[i]));
    let r = normalised(cross(w, camera.up));
    let u = cross(r, w);
    let per_pixel = camera.footprint(side, 1);
    let scale = ground / (per_pixel * per_pixel);
    let (half, light) = (side as f64 / 2.0, normalised(light));
    struct Sum {
        area: f64,
        turned: bool,
        places: usize,
        tones: Vec<f64>,
    }
    let empty = || Sum { area: 0.0, turned: false, places: 0, tones: vec![0.0; looks.len()] };
    let mut sums: Vec<Sum> = (0..side * side).map(|_| empty()).collect();
    for Place { at, slopes: [p, q] } in places {
        let v = [0, 1, 2].map(|i| at[i] - camera.eye[i]);
        let depth = dot(v, w);
        let column = half + dot(v, r) / depth / per_pixel;
        let row = half - dot(v, u) / depth / per_pixel;
        if column < 0.0 || row < 0.0 || column >= side as f64 || row >= side as f64 {
            continue;
        }
        let sum = &mut sums[row as usize * side + column as usize];
        let normal = [-p, -q, 1.0];
        let area = -dot(normal, v) / (depth * depth * depth) * scale;
        sum.turned |= area <= 0.0;
        sum.area += area;
        sum.places += 1;
        let facing = Facing::new(normal, v, light);
        for (tone, (finish, environment)) in sum.tones.iter_mut().zip(looks) {
            *tone += area * finish.answer(&facing, environment);
        }
    }
    let inside = |(index, sum): (usize, Sum)| {
        let interior = !sum.turned && (sum.area - 1.0).abs() < 0.02;
        let tones = sum.tones.iter().map(|tone| tone / sum.area).collect();
        interior.then_some(Pixel { at: (index % side, index / side), places: sum.places, tones })
    };
    sums.into_iter().enumerate().filter_map(inside).collect()
}

#[cfg(test)]
mod tests {
    use super::interior;
    use crate::camera::Camera;
    use crate::fif::{Fif, Map};
    use crate::shade::{Environment, Finish};
    use crate::surface::Factor;

    /// A level square shows one tone wherever it covers a pixel, and as many pixels as its area has.
    #[test]
    fn a_level_square_has_one_tone() {
        let one = || Fif::from_polynomials(&[0.0, 2.0], vec![Map { vertical_scaling: 0.0, q: vec![1.0] }]);
        let factor = Factor::new(one()).expect("smooth");
        let camera = Camera {
            eye: [1.0, 1.0, 5.0],
            look_at: [1.0, 1.0, 0.0],
            up: [0.0, 1.0, 0.0],
            field_of_view: 2.0 * libm::atan(0.5),
        };
        let look = (Finish::Diffuse { ambient: 0.0 }, Environment::Plain { tone: 0.0 });
        let pixels = interior((&factor, &factor), &camera, [3.0, 0.0, 4.0], &[look], 16, 320);
        // the square is 2 wide, the picture 4 at the distance of 4: 8 x 8 of 16 x 16 pixels
        assert_eq!(pixels.len(), 64);
        assert!(pixels.iter().all(|p| (p.tones[0] - 0.8).abs() < 1e-12 && p.places == 1600));
    }
}
