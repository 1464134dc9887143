//! A chain of tori, gold and silver.
//!
//! Written by `attractor export --gallery chain`.

use attractor::Error;
use attractor::num::{Affine3, Angle, Lumen, Near, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Mixture, TorranceSparrow};
use attractor::trace::solid::{Placed, Plane, Torus};
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, Sampling, Sky};
use embedded_graphics::geometry::Size;

attractor::surfaces! {
    /// What stands in it.
    #[derive(Debug, Clone, Copy)]
    pub enum Thing {
        /// `Placed<Plane>`.
        Plane(Placed<Plane>),
        /// `Placed<Torus>`.
        Torus(Placed<Torus>),
    }
}

attractor::materials! {
    /// What things are made of.
    #[derive(Debug, Clone, Copy)]
    pub enum Stuff {
        /// `Mixture`.
        Plain(Mixture),
        /// `Mixture<Rgb, TorranceSparrow>`.
        PlainRough(Mixture<Rgb, TorranceSparrow>),
    }
}

/// The materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn materials() -> Result<[Stuff; 3], Error> {
    Ok([
        // gold
        Stuff::PlainRough(Mixture::matt(const { Rgb::new(Lumen::lit("0.7454"), Lumen::lit("0.39157"), Lumen::lit("0.02956")) }).with_parts(const { Unit::lit("0.12") }, const { Unit::lit("0.4") })?.with_highlight(const { Rgb::new(Lumen::lit("1"), Lumen::lit("0.87137"), Lumen::lit("0.52711")) }, TorranceSparrow::new(const { Unit::lit("0.2") }, const { Unit::lit("1") })?).with_reflection(const { Rgb::new(Lumen::lit("0.45"), Lumen::lit("0.32"), Lumen::lit("0.1")) })),
        // silver
        Stuff::PlainRough(Mixture::matt(const { Rgb::new(Lumen::lit("0.52711"), Lumen::lit("0.57758"), Lumen::lit("0.63075")) }).with_parts(const { Unit::lit("0.1") }, const { Unit::lit("0.3") })?.with_highlight(Rgb::WHITE, TorranceSparrow::new(const { Unit::lit("0.2") }, const { Unit::lit("1") })?).with_reflection(const { Rgb::new(Lumen::lit("0.5"), Lumen::lit("0.52"), Lumen::lit("0.55")) })),
        // water
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.02122"), Lumen::lit("0.0648"), Lumen::lit("0.13843")) }).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.3") })?.with_reflection(const { Rgb::new(Lumen::lit("0.45"), Lumen::lit("0.5"), Lumen::lit("0.55")) })),
    ])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves() -> Result<[Leaf<'static, Thing>; 6], Error> {
    Ok([
        // left
        Leaf { surface: Thing::Torus(Placed::new(Torus::new(const { Near::lit("0.26") })?, &Affine3::rotate(const { Vec3::lit("1", "0", "0") }, const { Angle::lit("0.0777777778") })?.then(&Affine3::translate(const { Vec3::lit("-2.45", "0", "0") })))?), materials: &[0] },
        // inner left
        Leaf { surface: Thing::Torus(Placed::new(Torus::new(const { Near::lit("0.26") })?, &Affine3::rotate(const { Vec3::lit("1", "0", "0") }, const { Angle::lit("0.8277777778") })?.then(&Affine3::translate(const { Vec3::lit("-1.225", "0", "0") })))?), materials: &[1] },
        // middle
        Leaf { surface: Thing::Torus(Placed::new(Torus::new(const { Near::lit("0.26") })?, &Affine3::rotate(const { Vec3::lit("1", "0", "0") }, const { Angle::lit("0.0777777778") })?)?), materials: &[0] },
        // inner right
        Leaf { surface: Thing::Torus(Placed::new(Torus::new(const { Near::lit("0.26") })?, &Affine3::rotate(const { Vec3::lit("1", "0", "0") }, const { Angle::lit("0.8277777778") })?.then(&Affine3::translate(const { Vec3::lit("1.225", "0", "0") })))?), materials: &[1] },
        // right
        Leaf { surface: Thing::Torus(Placed::new(Torus::new(const { Near::lit("0.26") })?, &Affine3::rotate(const { Vec3::lit("1", "0", "0") }, const { Angle::lit("0.0777777778") })?.then(&Affine3::translate(const { Vec3::lit("2.45", "0", "0") })))?), materials: &[0] },
        // water
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::translate(const { Vec3::lit("0", "0", "-1.4") }))?), materials: &[2] },
    ])
}

/// What shines.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn lamps() -> Result<[Lamp; 2], Error> {
    Ok([
        // light 0
        Lamp::distant(const { Vec3::lit("-3", "-4", "6") }, const { Rgb::new(Lumen::lit("0.85"), Lumen::lit("0.82"), Lumen::lit("0.76")) })?,
        // light 1
        Lamp::point(const { Vec3::lit("5", "-5", "3") }, const { Rgb::new(Lumen::lit("0.2"), Lumen::lit("0.22"), Lumen::lit("0.3")) }),
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
pub const EYE: Vec3 = Vec3::lit("0", "-11", "4.2");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0", "0", "0.1");

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
pub const CONTRAST: Option<[u8; 2]> = Some([85, 200]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 21, 6, false>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.11697"), Lumen::lit("0.2462"), Lumen::lit("0.47932")) }, horizon: const { Rgb::new(Lumen::lit("0.63075"), Lumen::lit("0.7157"), Lumen::lit("0.80695")) }, nadir: const { Rgb::new(Lumen::lit("0.00519"), Lumen::lit("0.00699"), Lumen::lit("0.01161")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 2, seed }, Filter::Box)
}
