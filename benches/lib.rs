//! What the benches share: how long they measure, and what they measure on.
//!
//! Inputs are figure 1's function `g` (knots (0, 0), (1, 1), (2, 0), vertical scalings 0.85 and -0.85), its
//! integral `G`, and the surface `G x G` from the front corner. Cochran, Lewis, Hart, "The Normal of a
//! Fractal Surface", figures 1 and 6.

use std::time::Duration;

use attractor::Error;
use attractor::fif::{Cell, Fif, Pyramid};
use attractor::num::{Real, Vec3};
use attractor::trace::{Camera, Finish, HeightField, RayCaster};
use attractor_reference as reference;
use attractor_workload::exported::{figure_1_g, figure_3_g};
use embedded_graphics_core::geometry::Size;

/// How long a bench runs before it is measured.
pub const WARM_UP: Duration = Duration::from_millis(300);
/// How long it is measured.
pub const MEASUREMENT: Duration = Duration::from_millis(1000);
/// Into how many samples.
pub const SAMPLES: usize = 20;

/// Levels of the surface's pyramids.
pub const DEPTH: u32 = 8;

/// Figure 1's `g`.
///
/// # Errors
/// None: the function is valid.
pub fn g() -> Result<Fif<2, 1>, Error> {
    figure_1_g::function()
}

/// Its integral `G`, 0 at 0.
///
/// # Errors
/// None: the function is valid.
pub fn g_integral() -> Result<Fif<2, 2>, Error> {
    figure_3_g::function()
}

/// `g` for the reference.
pub fn exact_g() -> reference::Fif {
    reference::Fif::interpolating(&[(0.0, 0.0), (1.0, 1.0), (2.0, 0.0)], &[0.85, -0.85])
}

/// The memory that [`DEPTH`] levels of a function of two maps take.
pub fn memory() -> Vec<Cell> {
    vec![Cell::ZERO; Pyramid::cells(2, DEPTH)]
}

const EYE: [i32; 3] = [-4, -3, 5];
const LOOK_AT: [i32; 3] = [1, 1, 0];
const DEGREES: i32 = 25;

/// A square mirror of the surface whose factors have this pyramid, which fills a third of the picture.
///
/// # Errors
/// Those of [`HeightField::new`]; none for [`DEPTH`] levels of `G`.
pub fn mirror<'a>(pyramid: &Pyramid<'a>, side: u32) -> Result<RayCaster<'a>, Error> {
    let vector = |v: [i32; 3]| {
        let [x, y, z] = v.map(Real::from_num);
        Vec3::new(x, y, z)
    };
    let camera = Camera::new(vector(EYE), vector(LOOK_AT), vector([0, 0, 1]), Real::from_num(DEGREES))?;
    RayCaster::new(HeightField::new(pyramid, pyramid)?, camera, Size::new(side, side))?
        .with_finish(Finish::Mirror)
}

/// The same scene for the reference.
pub fn exact_mirror() -> reference::Scene {
    let bounds = reference::Bounds::new(&exact_g().integral(0.0), DEPTH as usize);
    reference::Scene {
        x: bounds.clone(),
        y: bounds,
        camera: reference::Camera {
            eye: EYE.map(f64::from),
            look_at: LOOK_AT.map(f64::from),
            up: [0.0, 0.0, 1.0],
            field_of_view: f64::from(DEGREES).to_radians(),
        },
        material: reference::Finish::Mirror,
        environment: reference::Environment::Gradient { zenith: 1.0, horizon: 0.5, nadir: 0.125 },
        light: [-1.0, -2.0, 3.0],
        samples_per_axis: 1,
    }
}

/// `count` words with all bits in play (Weyl sequence, then the finaliser of MurmurHash3).
pub fn words(count: u32) -> Vec<u32> {
    let mixed = |i: u32| {
        let h = (i + 1).wrapping_mul(0x9e37_79b9);
        let h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
        let h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
        h ^ (h >> 16)
    };
    (0..count).map(mixed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use attractor::plane::Field as _;

    /// Both sides of the bench of rays do the same work: the mirrors are the same picture.
    #[test]
    fn both_mirrors_are_the_same_picture() {
        const SIDE: u32 = 48;
        let (g, mut memory) = (g_integral().unwrap(), memory());
        let pyramid = Pyramid::new(&g, DEPTH, &mut memory).unwrap();
        let picture = mirror(&pyramid, SIDE).unwrap();
        let exact = exact_mirror();
        let (side, mut hits, mut far) = (SIDE as usize, 0, 0);
        for (y, row) in (0..SIDE).map(|y| (y, picture.row(y, 0..SIDE))) {
            for (x, tone) in row.enumerate() {
                let truth = exact.tone(side, side, (x, y as usize), (0.0, 0.0));
                hits += u32::from(picture.hit(x as u32, y).is_some());
                far += u32::from((f64::from(tone.to_bits()) / 65535.0 - truth).abs() > 2.0 / 255.0);
            }
        }
        assert!((SIDE * SIDE / 4..SIDE * SIDE / 2).contains(&hits), "{hits}");
        assert!(far <= SIDE * SIDE / 200, "{far}");
    }
}
