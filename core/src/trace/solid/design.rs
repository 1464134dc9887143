//! Shapes that are placed at design time: what [`Placed::new`] finds out of a map, as a constant, so that an
//! image has none of the code.

use super::cube::Cube;
use super::placed::Placed;
use super::plane::Plane;
use super::sphere::Sphere;
use super::square::Square;
use super::tapered_cylinder::TaperedCylinder;
use crate::Error;
use crate::num::Affine3;

/// ```
/// use attractor::num::{Affine3, Vec3};
/// use attractor::trace::solid::{Placed, Sphere};
///
/// const BALL: Placed<Sphere> = match Placed::sphere(&Affine3::translate(Vec3::lit("0", "2", "1"))) {
///     Ok(ball) => ball,
///     Err(_) => panic!("no such place"),
/// };
/// # let _ = BALL;
/// ```
impl Placed<Sphere> {
    /// The sphere under a map.
    ///
    /// # Errors
    /// As [`Placed::new`].
    pub const fn sphere(map: &Affine3) -> Result<Self, Error> {
        Self::known(Sphere, Sphere::BOUNDS, Sphere::RADIUS, Sphere::ERROR, map)
    }
}

impl Placed<Plane> {
    /// The half-space under a map.
    ///
    /// # Errors
    /// As [`Placed::new`].
    pub const fn plane(map: &Affine3) -> Result<Self, Error> {
        Self::known(Plane, Plane::BOUNDS, None, Plane::ERROR, map)
    }
}

impl Placed<Square> {
    /// The square under a map.
    ///
    /// # Errors
    /// As [`Placed::new`].
    pub const fn square(map: &Affine3) -> Result<Self, Error> {
        Self::known(Square, Square::BOUNDS, None, Square::ERROR, map)
    }
}

impl Placed<Cube> {
    /// The cube under a map.
    ///
    /// # Errors
    /// As [`Placed::new`].
    pub const fn cube(map: &Affine3) -> Result<Self, Error> {
        Self::known(Cube, Cube::BOUNDS, None, Cube::ERROR, map)
    }
}

impl Placed<TaperedCylinder> {
    /// A cylinder or cone under a map.
    ///
    /// # Errors
    /// As [`Placed::new`].
    pub const fn tapered_cylinder(shape: TaperedCylinder, map: &Affine3) -> Result<Self, Error> {
        Self::known(shape, TaperedCylinder::BOUNDS, TaperedCylinder::RADIUS, TaperedCylinder::ERROR, map)
    }
}

#[cfg(test)]
mod tests {
    use super::super::shape::Shape;
    use super::*;
    use crate::num::Vec3;
    use std::format;

    const MAP: Affine3 = Affine3::scale(Vec3::lit("0.5", "-2", "1")).then(&Affine3::translate(Vec3::lit(
        "3",
        "-2",
        "0.123456789",
    )));

    /// The same as at run time, which other tests look at, and the same refusals.
    #[test]
    fn a_shape_that_is_placed_at_design_time_is_the_same() {
        const SPHERE: Result<Placed<Sphere>, Error> = Placed::sphere(&MAP);
        const PLANE: Result<Placed<Plane>, Error> = Placed::plane(&MAP);
        const SQUARE: Result<Placed<Square>, Error> = Placed::square(&MAP);
        const CUBE: Result<Placed<Cube>, Error> = Placed::cube(&MAP);
        const CONE: Result<Placed<TaperedCylinder>, Error> =
            Placed::tapered_cylinder(TaperedCylinder::CONE, &MAP);
        fn is_same<S: Shape + core::fmt::Debug>(placed: Result<Placed<S>, Error>, shape: S) {
            assert_eq!(format!("{:?}", placed.unwrap()), format!("{:?}", Placed::new(shape, &MAP).unwrap()));
        }
        is_same(SPHERE, Sphere);
        is_same(PLANE, Plane);
        is_same(SQUARE, Square);
        is_same(CUBE, Cube);
        is_same(CONE, TaperedCylinder::CONE);
        const FAR: Result<Placed<Cube>, Error> = Placed::cube(&Affine3::translate(Vec3::lit("65", "0", "0")));
        const FLAT: Result<Placed<Sphere>, Error> = Placed::sphere(&Affine3::scale(Vec3::lit("1", "0", "1")));
        assert!(matches!(FAR, Err(Error::OutOfRange { what: "place of a shape", index: Some(0), .. })));
        assert!(matches!(FLAT, Err(Error::Degenerate { .. })));
    }
}
