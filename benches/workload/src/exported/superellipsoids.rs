//! Superellipsoids: exponents n across (0.6, 1, 2, 6) and m upwards (0.6, 1, 2, 6).
//!
//! Written by `attractor export --gallery superellipsoids`.

use attractor::Error;
use attractor::num::{Affine3, Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Mixture, Phong};
use attractor::trace::solid::{Placed, Plane, Superellipsoid};
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, Sampling, Sky};
use embedded_graphics::geometry::Size;

attractor::surfaces! {
    /// What stands in it.
    #[derive(Debug, Clone, Copy)]
    pub enum Thing {
        /// `Placed<Plane>`.
        Plane(Placed<Plane>),
        /// `Placed<Superellipsoid>`.
        Superellipsoid(Placed<Superellipsoid>),
    }
}

attractor::materials! {
    /// What things are made of.
    #[derive(Debug, Clone, Copy)]
    pub enum Stuff {
        /// `Mixture`.
        Plain(Mixture),
        /// `Mixture<Rgb, Phong>`.
        PlainPhong(Mixture<Rgb, Phong>),
    }
}

/// The materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn materials() -> Result<[Stuff; 5], Error> {
    Ok([
        // amber
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.7454"), Lumen::lit("0.35153"), Lumen::lit("0.02956")) }).with_parts(const { Unit::lit("0.18") }, const { Unit::lit("0.75") })?.with_highlight(const { Rgb::new(Lumen::lit("0.16203"), Lumen::lit("0.16203"), Lumen::lit("0.16203")) }, Phong { shininess: 40 })),
        // azure
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.03433"), Lumen::lit("0.16203"), Lumen::lit("0.57758")) }).with_parts(const { Unit::lit("0.18") }, const { Unit::lit("0.75") })?.with_highlight(const { Rgb::new(Lumen::lit("0.16203"), Lumen::lit("0.16203"), Lumen::lit("0.16203")) }, Phong { shininess: 40 })),
        // coral
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.08022"), Lumen::lit("0.04518")) }).with_parts(const { Unit::lit("0.18") }, const { Unit::lit("0.75") })?.with_highlight(const { Rgb::new(Lumen::lit("0.16203"), Lumen::lit("0.16203"), Lumen::lit("0.16203")) }, Phong { shininess: 40 })),
        // ground
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.80695"), Lumen::lit("0.77582"), Lumen::lit("0.7157")) }).with_parts(const { Unit::lit("0.25") }, const { Unit::lit("0.75") })?),
        // jade
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.03955"), Lumen::lit("0.35153"), Lumen::lit("0.16203")) }).with_parts(const { Unit::lit("0.18") }, const { Unit::lit("0.75") })?.with_highlight(const { Rgb::new(Lumen::lit("0.16203"), Lumen::lit("0.16203"), Lumen::lit("0.16203")) }, Phong { shininess: 40 })),
    ])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves() -> Result<[Leaf<'static, Thing>; 17], Error> {
    Ok([
        // ground
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::IDENTITY)?), materials: &[3] },
        // object[1]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("0.6") }, const { Real::lit("0.6") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("-3.45", "3.45", "0.87") })))?), materials: &[2] },
        // object[2]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("1") }, const { Real::lit("0.6") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("-1.15", "3.45", "0.87") })))?), materials: &[2] },
        // object[3]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("2") }, const { Real::lit("0.6") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("1.15", "3.45", "0.87") })))?), materials: &[2] },
        // object[4]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("6") }, const { Real::lit("0.6") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("3.45", "3.45", "0.87") })))?), materials: &[2] },
        // object[5]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("0.6") }, const { Real::lit("1") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("-3.45", "1.15", "0.87") })))?), materials: &[0] },
        // object[6]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("1") }, const { Real::lit("1") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("-1.15", "1.15", "0.87") })))?), materials: &[0] },
        // object[7]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("2") }, const { Real::lit("1") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("1.15", "1.15", "0.87") })))?), materials: &[0] },
        // object[8]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("6") }, const { Real::lit("1") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("3.45", "1.15", "0.87") })))?), materials: &[0] },
        // object[9]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("0.6") }, const { Real::lit("2") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("-3.45", "-1.15", "0.87") })))?), materials: &[4] },
        // object[10]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("1") }, const { Real::lit("2") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("-1.15", "-1.15", "0.87") })))?), materials: &[4] },
        // object[11]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("2") }, const { Real::lit("2") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("1.15", "-1.15", "0.87") })))?), materials: &[4] },
        // object[12]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("6") }, const { Real::lit("2") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("3.45", "-1.15", "0.87") })))?), materials: &[4] },
        // object[13]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("0.6") }, const { Real::lit("6") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("-3.45", "-3.45", "0.87") })))?), materials: &[1] },
        // object[14]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("1") }, const { Real::lit("6") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("-1.15", "-3.45", "0.87") })))?), materials: &[1] },
        // object[15]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("2") }, const { Real::lit("6") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("1.15", "-3.45", "0.87") })))?), materials: &[1] },
        // object[16]
        Leaf { surface: Thing::Superellipsoid(Placed::new(Superellipsoid::new(const { Real::lit("6") }, const { Real::lit("6") })?, &Affine3::scale(const { Vec3::lit("0.85", "0.85", "0.85") }).then(&Affine3::translate(const { Vec3::lit("3.45", "-3.45", "0.87") })))?), materials: &[1] },
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
        Lamp::distant(const { Vec3::lit("-2", "-4", "6") }, const { Rgb::new(Lumen::lit("1.25"), Lumen::lit("1.2"), Lumen::lit("1.15")) })?,
    ])
}

/// Of which shapes each object is made, in reverse Polish.
#[rustfmt::skip]
pub static PROGRAMS: [&[Op]; 17] = [
    &[Op::Leaf(0)],
    &[Op::Leaf(1)],
    &[Op::Leaf(2)],
    &[Op::Leaf(3)],
    &[Op::Leaf(4)],
    &[Op::Leaf(5)],
    &[Op::Leaf(6)],
    &[Op::Leaf(7)],
    &[Op::Leaf(8)],
    &[Op::Leaf(9)],
    &[Op::Leaf(10)],
    &[Op::Leaf(11)],
    &[Op::Leaf(12)],
    &[Op::Leaf(13)],
    &[Op::Leaf(14)],
    &[Op::Leaf(15)],
    &[Op::Leaf(16)],
];

/// How many boxes the objects borrow.
pub const BOXES: usize = 17;

/// The objects.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn objects<'a>(
    leaves: &[Leaf<'static, Thing>],
    boxes: &'a mut [Extent; BOXES],
) -> Result<[Object<'a>; 17], Error> {
    let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
    let (one_0, boxes) = boxes.split_at_mut(1);
    let (one_1, boxes) = boxes.split_at_mut(1);
    let (one_2, boxes) = boxes.split_at_mut(1);
    let (one_3, boxes) = boxes.split_at_mut(1);
    let (one_4, boxes) = boxes.split_at_mut(1);
    let (one_5, boxes) = boxes.split_at_mut(1);
    let (one_6, boxes) = boxes.split_at_mut(1);
    let (one_7, boxes) = boxes.split_at_mut(1);
    let (one_8, boxes) = boxes.split_at_mut(1);
    let (one_9, boxes) = boxes.split_at_mut(1);
    let (one_10, boxes) = boxes.split_at_mut(1);
    let (one_11, boxes) = boxes.split_at_mut(1);
    let (one_12, boxes) = boxes.split_at_mut(1);
    let (one_13, boxes) = boxes.split_at_mut(1);
    let (one_14, boxes) = boxes.split_at_mut(1);
    let (one_15, boxes) = boxes.split_at_mut(1);
    let (one_16, _) = boxes.split_at_mut(1);
    Ok([
        Object::new(PROGRAMS[0], surface, one_0)?,
        Object::new(PROGRAMS[1], surface, one_1)?,
        Object::new(PROGRAMS[2], surface, one_2)?,
        Object::new(PROGRAMS[3], surface, one_3)?,
        Object::new(PROGRAMS[4], surface, one_4)?,
        Object::new(PROGRAMS[5], surface, one_5)?,
        Object::new(PROGRAMS[6], surface, one_6)?,
        Object::new(PROGRAMS[7], surface, one_7)?,
        Object::new(PROGRAMS[8], surface, one_8)?,
        Object::new(PROGRAMS[9], surface, one_9)?,
        Object::new(PROGRAMS[10], surface, one_10)?,
        Object::new(PROGRAMS[11], surface, one_11)?,
        Object::new(PROGRAMS[12], surface, one_12)?,
        Object::new(PROGRAMS[13], surface, one_13)?,
        Object::new(PROGRAMS[14], surface, one_14)?,
        Object::new(PROGRAMS[15], surface, one_15)?,
        Object::new(PROGRAMS[16], surface, one_16)?,
    ])
}

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("-6.4", "-14.2", "11.4");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0.3", "0.2", "0.25");

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
pub const CONTRAST: Option<[u8; 2]> = Some([80, 226]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 131, 7, false>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.05127"), Lumen::lit("0.09758"), Lumen::lit("0.18782")) }, horizon: const { Rgb::new(Lumen::lit("0.57758"), Lumen::lit("0.60382"), Lumen::lit("0.63075")) }, nadir: const { Rgb::new(Lumen::lit("0.02956"), Lumen::lit("0.02956"), Lumen::lit("0.02956")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 2, seed }, Filter::Box)
}
