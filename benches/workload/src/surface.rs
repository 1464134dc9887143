//! The surface `G x G` of the paper, `G` the function of figure 3 on the right, mirrored under a sky.

use attractor::Error;
use attractor::fif::Pyramid;
use attractor::num::{Real, Vec3};
use attractor::trace::{Camera, Finish, HeightField, RayCaster};
use embedded_graphics::geometry::Size;

/// From the upper left front; the surface fills a third of a square picture.
pub(crate) fn mirror<'a>(pyramid: &Pyramid<'a>, size: Size) -> Result<RayCaster<'a>, Error> {
    let at = |x: i32, y: i32, z: i32| Vec3::new(Real::from_num(x), Real::from_num(y), Real::from_num(z));
    let camera = Camera::new(at(-4, -3, 5), at(1, 1, 0), at(0, 0, 1), Real::from_num(25))?;
    RayCaster::new(HeightField::new(pyramid, pyramid)?, camera, size)?.with_finish(Finish::Mirror)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exported::figure_3_g;
    use attractor::fif::Cell;

    #[test]
    fn the_surface_fills_a_third_of_a_square_picture() {
        let mut memory = [Cell::ZERO; Pyramid::cells(2, 8)];
        let g = figure_3_g::function::<2, 2>().unwrap();
        let pyramid = Pyramid::new(&g, 8, &mut memory).unwrap();
        let caster = mirror(&pyramid, Size::new(240, 240)).unwrap();
        let hits = (0..240 * 240).filter(|i| caster.hit(i % 240, i / 240).is_some()).count();
        let part = hits as f64 / (240.0 * 240.0);
        assert!((0.32..0.345).contains(&part), "{part}");
    }
}
