//! Spheres of glass and mirrors on a checkered floor.
//!
//! Written by `attractor export --gallery glass-spheres`.

use attractor::Error;
use attractor::num::{Affine3, Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Clear, Medium, Mixture, Phong};
use attractor::trace::solid::{Placed, Plane, Sphere};
use attractor::trace::texture::Checker;
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, Sampling, Sky};
use embedded_graphics::geometry::Size;

attractor::surfaces! {
    /// What stands in it.
    #[derive(Debug, Clone, Copy)]
    pub enum Thing {
        /// `Placed<Plane>`.
        Plane(Placed<Plane>),
        /// `Placed<Sphere>`.
        Sphere(Placed<Sphere>),
    }
}

attractor::materials! {
    /// What things are made of.
    #[derive(Debug, Clone, Copy)]
    pub enum Stuff {
        /// `Mixture<Checker>`.
        Checker(Mixture<Checker>),
        /// `Mixture<Rgb, Phong>`.
        PlainPhong(Mixture<Rgb, Phong>),
        /// `Mixture<Rgb, Phong, Clear>`.
        PlainPhongClear(Mixture<Rgb, Phong, Clear>),
    }
}

/// The materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn materials() -> Result<[Stuff; 6], Error> {
    Ok([
        // floor
        Stuff::Checker(Mixture::matt(Checker::cubes([const { Real::lit("1") }, const { Real::lit("1") }, const { Real::lit("1") }], const { Rgb::new(Lumen::lit("0.90466"), Lumen::lit("0.87137"), Lumen::lit("0.7913")) }, const { Rgb::new(Lumen::lit("0.02122"), Lumen::lit("0.02956"), Lumen::lit("0.04518")) })).with_parts(const { Unit::lit("0.15") }, const { Unit::lit("0.85") })?),
        // glass
        Stuff::PlainPhongClear(Mixture::matt(Rgb::WHITE).with_parts(const { Unit::lit("0") }, const { Unit::lit("0") })?.with_highlight(Rgb::WHITE, Phong { shininess: 250 }).with_interior(Clear::new(Medium { index: const { Real::lit("1.5") }, priority: 0, fresnel: true }, Rgb::WHITE)?)),
        // gold
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.63075"), Lumen::lit("0.314"), Lumen::lit("0.01445")) }).with_parts(const { Unit::lit("0.05") }, const { Unit::lit("0.25") })?.with_highlight(const { Rgb::new(Lumen::lit("1"), Lumen::lit("0.7454"), Lumen::lit("0.35153")) }, Phong { shininess: 120 }).with_reflection(const { Rgb::new(Lumen::lit("0.75"), Lumen::lit("0.52"), Lumen::lit("0.16")) })),
        // green glass
        Stuff::PlainPhongClear(Mixture::matt(Rgb::WHITE).with_parts(const { Unit::lit("0") }, const { Unit::lit("0") })?.with_highlight(Rgb::WHITE, Phong { shininess: 250 }).with_interior(Clear::new(Medium { index: const { Real::lit("1.5") }, priority: 0, fresnel: true }, const { Rgb::new(Lumen::lit("0.43416"), Lumen::lit("0.87137"), Lumen::lit("0.57758")) })?)),
        // mirror
        Stuff::PlainPhong(Mixture::matt(Rgb::BLACK).with_parts(const { Unit::lit("0") }, const { Unit::lit("0") })?.with_highlight(Rgb::WHITE, Phong { shininess: 250 }).with_reflection(const { Rgb::new(Lumen::lit("0.9"), Lumen::lit("0.9"), Lumen::lit("0.92")) })),
        // red
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.57758"), Lumen::lit("0.01445"), Lumen::lit("0.01445")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?.with_highlight(const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.21587"), Lumen::lit("0.21587")) }, Phong { shininess: 50 })),
    ])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves() -> Result<[Leaf<'static, Thing>; 6], Error> {
    Ok([
        // floor
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::IDENTITY)?), materials: &[0] },
        // glass
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::translate(const { Vec3::lit("-0.9", "-0.7", "1") }))?), materials: &[1] },
        // mirror
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("1.2", "1.2", "1.2") }).then(&Affine3::translate(const { Vec3::lit("1.25", "1", "1.2") })))?), materials: &[4] },
        // small glass
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.45", "0.45", "0.45") }).then(&Affine3::translate(const { Vec3::lit("0.75", "-1.2", "0.45") })))?), materials: &[3] },
        // gold
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.6", "0.6", "0.6") }).then(&Affine3::translate(const { Vec3::lit("-1.9", "1.6", "0.6") })))?), materials: &[2] },
        // red
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.35", "0.35", "0.35") }).then(&Affine3::translate(const { Vec3::lit("2.05", "-0.75", "0.35") })))?), materials: &[5] },
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
        Lamp::distant(const { Vec3::lit("-2", "-2", "5") }, const { Rgb::new(Lumen::lit("0.9"), Lumen::lit("0.88"), Lumen::lit("0.82")) })?,
    ])
}

/// Of which shapes each object is made, in reverse Polish.
#[rustfmt::skip]
pub static PROGRAMS: [&[Op]; 6] = [
    &[Op::Leaf(0)],
    &[Op::Leaf(1)],
    &[Op::Leaf(2)],
    &[Op::Leaf(3)],
    &[Op::Leaf(4)],
    &[Op::Leaf(5)],
];

/// How many boxes the objects borrow.
pub const BOXES: usize = 6;

/// The objects.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn objects<'a>(
    leaves: &[Leaf<'static, Thing>],
    boxes: &'a mut [Extent; BOXES],
) -> Result<[Object<'a>; 6], Error> {
    let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
    let (one_0, boxes) = boxes.split_at_mut(1);
    let (one_1, boxes) = boxes.split_at_mut(1);
    let (one_2, boxes) = boxes.split_at_mut(1);
    let (one_3, boxes) = boxes.split_at_mut(1);
    let (one_4, boxes) = boxes.split_at_mut(1);
    let (one_5, _) = boxes.split_at_mut(1);
    Ok([
        Object::new(PROGRAMS[0], surface, one_0)?,
        Object::new(PROGRAMS[1], surface, one_1)?,
        Object::new(PROGRAMS[2], surface, one_2)?,
        Object::new(PROGRAMS[3], surface, one_3)?,
        Object::new(PROGRAMS[4], surface, one_4)?,
        Object::new(PROGRAMS[5], surface, one_5)?,
    ])
}

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("0.6", "-7.6", "2.9");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0", "0.4", "0.75");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("36");

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
pub const CONTRAST: Option<[u8; 2]> = Some([42, 228]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 11, 7, false>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.02122"), Lumen::lit("0.11697"), Lumen::lit("0.39157")) }, horizon: const { Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.77582"), Lumen::lit("0.8388")) }, nadir: const { Rgb::new(Lumen::lit("0.01445"), Lumen::lit("0.01764"), Lumen::lit("0.02122")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 3, seed }, Filter::Box)
}
