//! The picture of a height field: a tone for every pixel.
//!
//! Source: CONTRIBUTING.md, "The picture of a height field, defined"; Cochran, Lewis and Hart, "The Normal of
//! a Fractal Surface", section 5, eq. 52-53 (a pixel is a weighted sum of samples).

use crate::bounds::Bounds;
use crate::camera::{Camera, Ray};
use crate::height_field::{Hit, Trace, leaf_normal, trace};
use crate::shade::{Environment, Finish};
use crate::vector::{Vector, normalised};

/// A height field `h(x, y) = f(x) g(y)`, how it looks and from where.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The cells of `f`.
    pub x: Bounds,
    /// The cells of `g`.
    pub y: Bounds,
    /// The point of view.
    pub camera: Camera,
    /// What the surface is made of.
    pub material: Finish,
    /// What is around it.
    pub environment: Environment,
    /// A vector of any length towards the light.
    pub light: Vector,
    /// N where a picture takes N x N samples a pixel: divides the footprint.
    pub samples_per_axis: usize,
}

impl Scene {
    /// Follows the ray of the sample at `offset` from the centre of `pixel` (column, row).
    pub fn trace(&self, cols: usize, rows: usize, pixel: (usize, usize), offset: (f64, f64)) -> (Ray, Trace) {
        let ray = self.camera.ray(cols, rows, pixel, offset);
        let footprint = self.camera.footprint(rows, self.samples_per_axis);
        (ray, trace(&self.x, &self.y, &ray, footprint))
    }

    /// The tone of one sample.
    pub fn tone(&self, cols: usize, rows: usize, pixel: (usize, usize), offset: (f64, f64)) -> f64 {
        let (ray, trace) = self.trace(cols, rows, pixel, offset);
        match trace.hit {
            Some(hit) => {
                let n = leaf_normal(&self.x, &self.y, &ray, &hit);
                self.material.tone(n, ray.direction, self.light, &self.environment)
            }
            None => self.environment.tone(normalised(ray.direction)),
        }
    }
}

/// The tones of a picture, row by row from the top: for each pixel the sum of weight times tone over
/// `samples`, given as `(dx, dy, weight)` with offsets in pixels from the pixel's centre.
///
/// # Panics
/// When the weights do not add up to 1 within 1e-9.
pub fn render(scene: &Scene, cols: usize, rows: usize, samples: &[(f64, f64, f64)]) -> Vec<f64> {
    let total: f64 = samples.iter().map(|sample| sample.2).sum();
    assert!((total - 1.0).abs() < 1e-9, "the weights add up to {total}");
    let tone = |pixel| {
        samples
            .iter()
            .fold(0.0, |sum, &(dx, dy, weight)| sum + weight * scene.tone(cols, rows, pixel, (dx, dy)))
    };
    (0..rows).flat_map(|j| (0..cols).map(move |i| (i, j))).map(tone).collect()
}

/// The leaf that the sample at `offset` from the centre of `pixel` (column, row) sees.
pub fn hit(
    scene: &Scene,
    cols: usize,
    rows: usize,
    pixel: (usize, usize),
    offset: (f64, f64),
) -> Option<Hit> {
    scene.trace(cols, rows, pixel, offset).1.hit
}

/// The number of boxes tested for a whole picture.
pub fn box_tests(scene: &Scene, cols: usize, rows: usize, samples: &[(f64, f64, f64)]) -> usize {
    let pixel = |pixel| -> usize {
        samples.iter().map(|&(dx, dy, _)| scene.trace(cols, rows, pixel, (dx, dy)).1.box_tests).sum()
    };
    (0..rows).flat_map(|j| (0..cols).map(move |i| (i, j))).map(pixel).sum()
}

#[cfg(test)]
mod tests {
    use super::{Scene, box_tests, hit, render};
    use crate::bounds::Bounds;
    use crate::camera::Camera;
    use crate::fif::{Fif, Map};
    use crate::shade::{Environment, Finish};

    const CENTRE: [(f64, f64, f64); 1] = [(0.0, 0.0, 1.0)];

    fn scene(f: &Fif, material: Finish) -> Scene {
        let bounds = Bounds::new(f, 8);
        Scene {
            x: bounds.clone(),
            y: bounds,
            camera: Camera {
                eye: [1.0, -3.0, 4.0],
                look_at: [1.0, 1.0, 0.5],
                up: [0.0, 0.0, 1.0],
                field_of_view: 0.7,
            },
            material,
            environment: Environment::Gradient { zenith: 0.9, horizon: 0.5, nadir: 0.25 },
            light: [0.0, 0.0, 3.0],
            samples_per_axis: 1,
        }
    }

    fn rough() -> Fif {
        Fif::interpolating(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)], &[0.85, -0.85]).integral(0.0)
    }

    #[test]
    fn a_level_square_is_a_trapezium_of_one_tone() {
        let level = |c: f64| Map { vertical_scaling: 0.0, q: vec![c] };
        let flat = Fif::from_polynomials(&[0.0, 1.0, 2.0], vec![level(0.5), level(0.5)]);
        let scene = scene(&flat, Finish::Diffuse { ambient: 0.25 });
        let tones = render(&scene, 32, 24, &CENTRE);
        for j in 0..24 {
            for i in 0..32 {
                // The ray meets the plane z = 1/4 of f(x) f(y) inside or outside of [0, 2] x [0, 2].
                let ray = scene.camera.ray(32, 24, (i, j), (0.0, 0.0));
                let p = ray.at((0.25 - 4.0) / ray.direction[2]);
                let inside = (0.0..=2.0).contains(&p[0]) && (0.0..=2.0).contains(&p[1]);
                assert_eq!(tones[j * 32 + i] == 1.0, inside, "{i} {j}");
                assert!(inside || tones[j * 32 + i] < 0.5);
            }
        }
        assert!(tones.contains(&1.0));
    }

    #[test]
    fn a_pixel_is_the_weighted_sum_of_its_samples() {
        let scene = Scene { samples_per_axis: 2, ..scene(&rough(), Finish::Mirror) };
        let at = |dx, dy| render(&scene, 16, 12, &[(dx, dy, 1.0)]);
        let (a, b) = (at(-0.25, 0.25), at(0.25, -0.25));
        let both = render(&scene, 16, 12, &[(-0.25, 0.25, 0.75), (0.25, -0.25, 0.25)]);
        for k in 0..both.len() {
            assert!((both[k] - (0.75 * a[k] + 0.25 * b[k])).abs() < 1e-15);
        }
        assert_ne!(a, b);
    }

    #[test]
    fn the_picture_of_a_symmetrical_surface_is_symmetrical() {
        let f = Fif::interpolating(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)], &[0.5, 0.5]);
        let scene = scene(&f, Finish::Diffuse { ambient: 0.1 });
        let tones = render(&scene, 32, 24, &CENTRE);
        let mut shades = 0;
        for row in tones.chunks(32) {
            for i in 0..16 {
                assert!((row[i] - row[31 - i]).abs() < 1e-9);
                shades += usize::from(row[i] > 0.1 && row[i] < 0.9);
            }
        }
        assert!(shades > 20, "{shades}");
    }

    #[test]
    fn hits_lie_in_the_leaf_that_they_name_and_finer_samples_cost_more() {
        let coarse = scene(&rough(), Finish::Mirror);
        let mut found = 0;
        for pixel in (0..32).map(|i| (i, 12)) {
            let Some(hit) = hit(&coarse, 32, 24, pixel, (0.0, 0.0)) else { continue };
            let p = coarse.camera.ray(32, 24, pixel, (0.0, 0.0)).at(hit.t);
            let (f, g) = (coarse.x.levels[hit.level][hit.i], coarse.y.levels[hit.level][hit.j]);
            assert!(f.x0 <= p[0] && p[0] <= f.x1 && g.x0 <= p[1] && p[1] <= g.x1);
            found += 1;
        }
        assert!(found > 5);
        let fine = Scene { samples_per_axis: 8, ..coarse.clone() };
        assert!(box_tests(&fine, 32, 24, &CENTRE) > box_tests(&coarse, 32, 24, &CENTRE));
    }
}
