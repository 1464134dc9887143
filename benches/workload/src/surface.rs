//! The surface `G x G` of the paper: `G` is the integral of the function `g` of figure 1 (scalings 0.85 and -0.85), mirrored under a sky.

use attractor::Error;
use attractor::fif::{Fif, Knot, Pyramid};
use attractor::num::{Real, Scaling, Vec3, Wide};
use attractor::trace::{Camera, HeightField, Material, RayCaster};
use embedded_graphics::geometry::Size;

/// The paper's `g`.
pub(crate) fn g() -> Result<Fif<2, 1>, Error> {
    const STEEP: Scaling = Scaling::lit("0.85");
    let knots = [(0, 0), (1, 1), (2, 0)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
    Fif::interpolating(&knots, &[STEEP, -STEEP])
}

/// The paper's `G`.
pub(crate) fn g_integral() -> Result<Fif<2, 2>, Error> {
    g()?.integral::<2>(Wide::ZERO)
}

/// From the upper left front; the surface fills a third of a square picture.
pub(crate) fn mirror<'a>(pyramid: &Pyramid<'a>, size: Size) -> Result<RayCaster<'a>, Error> {
    let at = |x: i32, y: i32, z: i32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
    let camera = Camera::new(at(-4, -3, 5), at(1, 1, 0), at(0, 0, 1), Real::from_num(25))?;
    RayCaster::new(HeightField::new(pyramid, pyramid)?, camera, size)?.with_material(Material::Mirror)
}

#[cfg(test)]
mod tests {
    use super::*;
    use attractor::fif::Cell;

    #[test]
    fn the_surface_fills_a_third_of_a_square_picture() {
        let mut memory = [Cell::ZERO; Pyramid::cells(2, 8)];
        let g = g_integral().unwrap();
        let pyramid = Pyramid::new(&g, 8, &mut memory).unwrap();
        let caster = mirror(&pyramid, Size::new(240, 240)).unwrap();
        let hits = (0..240 * 240).filter(|i| caster.hit(i % 240, i / 240).is_some()).count();
        let part = hits as f64 / (240.0 * 240.0);
        assert!((0.32..0.345).contains(&part), "{part}");
    }
}
