//! Marble: veins of a spline, stirred by turbulence.
//!
//! Written by `attractor export --gallery marble`.

use attractor::Error;
use attractor::num::{Affine3, Angle, Lumen, Near, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Mixture, Phong};
use attractor::trace::solid::{Cube, Placed, Plane, Sphere, Torus};
use attractor::trace::texture::{Checker, Marble, Noise, Spline, Turbulence};
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, Sampling, Sky};
use embedded_graphics::geometry::Size;

attractor::surfaces! {
    /// What stands in it.
    #[derive(Debug, Clone, Copy)]
    pub enum Thing {
        /// `Placed<Cube>`.
        Cube(Placed<Cube>),
        /// `Placed<Plane>`.
        Plane(Placed<Plane>),
        /// `Placed<Sphere>`.
        Sphere(Placed<Sphere>),
        /// `Placed<Torus>`.
        Torus(Placed<Torus>),
    }
}

attractor::materials! {
    /// What things are made of.
    #[derive(Debug, Clone, Copy)]
    pub enum Stuff {
        /// `Mixture<Checker>`.
        Checker(Mixture<Checker>),
        /// `Mixture<Marble<4>, Phong>`.
        MarblePhong(Mixture<Marble<4>, Phong>),
    }
}

/// The materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn materials() -> Result<[Stuff; 3], Error> {
    Ok([
        // floor
        Stuff::Checker(Mixture::matt(Checker::cubes([const { Real::lit("0.8") }, const { Real::lit("0.8") }, const { Real::lit("0.8") }], const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.80695"), Lumen::lit("0.68669")) }, const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.18782"), Lumen::lit("0.16203")) })).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.6") })?.with_reflection(const { Rgb::new(Lumen::lit("0.15"), Lumen::lit("0.15"), Lumen::lit("0.15")) })),
        // green
        Stuff::MarblePhong(Mixture::matt(Marble { undulate: Spline::new(&[(const { Unit::lit("-1") }, const { Rgb::new(Lumen::lit("0.00519"), Lumen::lit("0.03955"), Lumen::lit("0.02122")) }), (const { Unit::lit("0") }, const { Rgb::new(Lumen::lit("0.01445"), Lumen::lit("0.09758"), Lumen::lit("0.05127")) }), (const { Unit::lit("0.75") }, const { Rgb::new(Lumen::lit("0.04518"), Lumen::lit("0.20155"), Lumen::lit("0.09758")) }), (const { Unit::lit("1") }, const { Rgb::new(Lumen::lit("0.57758"), Lumen::lit("0.7157"), Lumen::lit("0.57758")) })])?, turbulence: Turbulence::new(Noise::new(5), const { Real::lit("1.2") }, 5)?, amplitude: const { Real::lit("9") }, frequency: const { Real::lit("2.5") } }).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.75") })?.with_highlight(const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.21587"), Lumen::lit("0.21587")) }, Phong { shininess: 70 }).with_reflection(const { Rgb::new(Lumen::lit("0.08"), Lumen::lit("0.08"), Lumen::lit("0.08")) })),
        // white
        Stuff::MarblePhong(Mixture::matt(Marble { undulate: Spline::new(&[(const { Unit::lit("-1") }, const { Rgb::new(Lumen::lit("0.92159"), Lumen::lit("0.88792"), Lumen::lit("0.82278")) }), (const { Unit::lit("0.25") }, const { Rgb::new(Lumen::lit("0.8388"), Lumen::lit("0.7913"), Lumen::lit("0.7157")) }), (const { Unit::lit("0.7") }, const { Rgb::new(Lumen::lit("0.63075"), Lumen::lit("0.57758"), Lumen::lit("0.52711")) }), (const { Unit::lit("1") }, const { Rgb::new(Lumen::lit("0.13843"), Lumen::lit("0.12744"), Lumen::lit("0.16203")) })])?, turbulence: Turbulence::new(Noise::new(0), const { Real::lit("1.4") }, 5)?, amplitude: const { Real::lit("7") }, frequency: const { Real::lit("3.5") } }).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.8") })?.with_highlight(const { Rgb::new(Lumen::lit("0.35153"), Lumen::lit("0.35153"), Lumen::lit("0.35153")) }, Phong { shininess: 90 })),
    ])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves() -> Result<[Leaf<'static, Thing>; 4], Error> {
    Ok([
        // floor
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::IDENTITY)?), materials: &[0] },
        // plinth
        Leaf { surface: Thing::Cube(Placed::new(Cube, &Affine3::scale(const { Vec3::lit("1.1", "1.1", "0.3") }).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.0666666667") })?).then(&Affine3::translate(const { Vec3::lit("0", "0", "0.3") })))?), materials: &[1] },
        // ring
        Leaf { surface: Thing::Torus(Placed::new(Torus::new(const { Near::lit("0.3") })?, &Affine3::scale(const { Vec3::lit("0.62", "0.62", "0.62") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "0.79") })))?), materials: &[2] },
        // ball
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.8", "0.8", "0.8") }).then(&Affine3::rotate(const { Vec3::lit("1", "0.4", "0") }, const { Angle::lit("0.0972222222") })?).then(&Affine3::translate(const { Vec3::lit("0", "0", "1.72") })))?), materials: &[2] },
    ])
}

/// What shines.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn lamps() -> Result<[Lamp; 1], Error> {
    Ok([
        // light 0
        Lamp::distant(const { Vec3::lit("-4", "-4", "6") }, const { Rgb::new(Lumen::lit("0.92"), Lumen::lit("0.9"), Lumen::lit("0.86")) })?,
    ])
}

/// Of which shapes each object is made, in reverse Polish.
#[rustfmt::skip]
pub static PROGRAMS: [&[Op]; 4] = [
    &[Op::Leaf(0)],
    &[Op::Leaf(1)],
    &[Op::Leaf(2)],
    &[Op::Leaf(3)],
];

/// How many boxes the objects borrow.
pub const BOXES: usize = 4;

/// The objects.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn objects<'a>(
    leaves: &[Leaf<'static, Thing>],
    boxes: &'a mut [Extent; BOXES],
) -> Result<[Object<'a>; 4], Error> {
    let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
    let (one_0, boxes) = boxes.split_at_mut(1);
    let (one_1, boxes) = boxes.split_at_mut(1);
    let (one_2, boxes) = boxes.split_at_mut(1);
    let (one_3, _) = boxes.split_at_mut(1);
    Ok([
        Object::new(PROGRAMS[0], surface, one_0)?,
        Object::new(PROGRAMS[1], surface, one_1)?,
        Object::new(PROGRAMS[2], surface, one_2)?,
        Object::new(PROGRAMS[3], surface, one_3)?,
    ])
}

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("-2.6", "-6.8", "3");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0", "0", "1.15");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("29");

/// The camera.
///
/// # Errors
/// Those of [`Camera::new`].
pub fn camera() -> Result<Camera, Error> {
    Camera::new(EYE, LOOK_AT, UP, FIELD_OF_VIEW)
}

/// The world.
pub type Whole<'a> = World<'a, Thing, Stuff, false>;

/// The world of these parts.
///
/// # Errors
/// None: the command has built it.
pub fn world<'a>(
    leaves: &'a [Leaf<'a, Thing>],
    objects: &'a [Object<'a>],
    materials: &'a [Stuff],
    lamps: &'a [Lamp],
) -> Result<Whole<'a>, Error> {
    Ok(World::of_leaves(leaves, objects, materials)?.with_lamps(lamps))
}

/// The greys that a display of 16 levels or fewer shows as black and as white: for `draw::Contrast`.
pub const CONTRAST: Option<[u8; 2]> = Some([68, 226]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 9, 5, false>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.18782"), Lumen::lit("0.2789"), Lumen::lit("0.39157")) }, horizon: const { Rgb::new(Lumen::lit("0.7454"), Lumen::lit("0.77582"), Lumen::lit("0.7913")) }, nadir: const { Rgb::new(Lumen::lit("0.01445"), Lumen::lit("0.01445"), Lumen::lit("0.01445")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 3, seed }, Filter::Box)
}
