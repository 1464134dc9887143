//! A lens, the intersection of two spheres, before three balls on a checkered floor.
//!
//! Written by `attractor export --gallery lens`.

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
pub fn materials() -> Result<[Stuff; 5], Error> {
    Ok([
        // blue
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.01764"), Lumen::lit("0.08022"), Lumen::lit("0.52711")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?.with_highlight(const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.21587"), Lumen::lit("0.21587")) }, Phong { shininess: 60 })),
        // floor
        Stuff::Checker(Mixture::matt(Checker::cubes([const { Real::lit("1") }, const { Real::lit("1") }, const { Real::lit("1") }], const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.8388"), Lumen::lit("0.7454")) }, const { Rgb::new(Lumen::lit("0.11697"), Lumen::lit("0.13843"), Lumen::lit("0.14996")) })).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.8") })?),
        // glass
        Stuff::PlainPhongClear(Mixture::matt(Rgb::WHITE).with_parts(const { Unit::lit("0") }, const { Unit::lit("0") })?.with_highlight(Rgb::WHITE, Phong { shininess: 200 }).with_interior(Clear::new(Medium { index: const { Real::lit("1.5") }, priority: 0, fresnel: true }, Rgb::WHITE)?)),
        // gold
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.69388"), Lumen::lit("0.37627"), Lumen::lit("0.01445")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?.with_highlight(const { Rgb::new(Lumen::lit("0.52711"), Lumen::lit("0.35153"), Lumen::lit("0.11697")) }, Phong { shininess: 60 })),
        // red
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.57758"), Lumen::lit("0.01938"), Lumen::lit("0.01161")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?.with_highlight(const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.21587"), Lumen::lit("0.21587")) }, Phong { shininess: 60 })),
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
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::IDENTITY)?), materials: &[1] },
        // front
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("2.6", "2.6", "2.6") }).then(&Affine3::translate(const { Vec3::lit("0", "2.4", "0") })).then(&Affine3::translate(const { Vec3::lit("0", "-1.6", "1.02") })))?), materials: &[2] },
        // back
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("2.6", "2.6", "2.6") }).then(&Affine3::translate(const { Vec3::lit("0", "-2.4", "0") })).then(&Affine3::translate(const { Vec3::lit("0", "-1.6", "1.02") })))?), materials: &[2] },
        // red
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.34", "0.34", "0.34") }).then(&Affine3::translate(const { Vec3::lit("-0.72", "-0.3", "0.34") })))?), materials: &[4] },
        // gold
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.34", "0.34", "0.34") }).then(&Affine3::translate(const { Vec3::lit("0", "-0.3", "0.34") })))?), materials: &[3] },
        // blue
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.34", "0.34", "0.34") }).then(&Affine3::translate(const { Vec3::lit("0.72", "-0.3", "0.34") })))?), materials: &[0] },
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
        Lamp::distant(const { Vec3::lit("-3", "-4", "6") }, const { Rgb::new(Lumen::lit("0.95"), Lumen::lit("0.92"), Lumen::lit("0.85")) })?,
    ])
}

/// Of which shapes each object is made, in reverse Polish.
#[rustfmt::skip]
pub static PROGRAMS: [&[Op]; 5] = [
    &[Op::Leaf(0)],
    &[Op::Leaf(1), Op::Leaf(2), Op::Intersection],
    &[Op::Leaf(3)],
    &[Op::Leaf(4)],
    &[Op::Leaf(5)],
];

/// How many boxes the objects borrow.
pub const BOXES: usize = 7;

/// The objects.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn objects<'a>(
    leaves: &[Leaf<'static, Thing>],
    boxes: &'a mut [Extent; BOXES],
) -> Result<[Object<'a>; 5], Error> {
    let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
    let (one_0, boxes) = boxes.split_at_mut(1);
    let (one_1, boxes) = boxes.split_at_mut(3);
    let (one_2, boxes) = boxes.split_at_mut(1);
    let (one_3, boxes) = boxes.split_at_mut(1);
    let (one_4, _) = boxes.split_at_mut(1);
    Ok([
        Object::new(PROGRAMS[0], surface, one_0)?,
        Object::new(PROGRAMS[1], surface, one_1)?,
        Object::new(PROGRAMS[2], surface, one_2)?,
        Object::new(PROGRAMS[3], surface, one_3)?,
        Object::new(PROGRAMS[4], surface, one_4)?,
    ])
}

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("0", "-7", "2.1");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0", "0", "0.7");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("26");

/// The camera.
///
/// # Errors
/// Those of [`Camera::new`].
pub fn camera() -> Result<Camera, Error> {
    Camera::new(EYE, LOOK_AT, UP, FIELD_OF_VIEW)
}

/// The world.
pub type Whole<'a> = World<'a, Thing, Stuff>;

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
    Ok(World::new(leaves, objects, materials)?.with_lamps(lamps))
}

/// The greys that a display of 16 levels or fewer shows as black and as white: for `draw::Contrast`.
pub const CONTRAST: Option<[u8; 2]> = Some([80, 224]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 11, 7>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.04231"), Lumen::lit("0.15593"), Lumen::lit("0.39157")) }, horizon: const { Rgb::new(Lumen::lit("0.62396"), Lumen::lit("0.7454"), Lumen::lit("0.82278")) }, nadir: const { Rgb::new(Lumen::lit("0.01599"), Lumen::lit("0.01599"), Lumen::lit("0.01599")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 2, seed }, Filter::Box)
}
