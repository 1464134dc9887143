//! The bowl (S1 - S2) - C: one ray meets its wall, another goes over the rim to the wall behind.
//!
//! Written by `attractor export --gallery bowl`.

use attractor::Error;
use attractor::num::{Affine3, Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Mixture, Phong};
use attractor::trace::solid::{Placed, Plane, Sphere, TaperedCylinder};
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
        /// `Placed<TaperedCylinder>`.
        TaperedCylinder(Placed<TaperedCylinder>),
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
pub fn materials() -> Result<[Stuff; 4], Error> {
    Ok([
        // clay
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.39157"), Lumen::lit("0.0648"), Lumen::lit("0.02519")) }).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.8") })?.with_highlight(const { Rgb::new(Lumen::lit("0.05127"), Lumen::lit("0.05127"), Lumen::lit("0.05127")) }, Phong { shininess: 12 })),
        // glaze
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.02733"), Lumen::lit("0.15897"), Lumen::lit("0.2705")) }).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.7") })?.with_highlight(const { Rgb::new(Lumen::lit("0.7454"), Lumen::lit("0.7454"), Lumen::lit("0.7454")) }, Phong { shininess: 80 }).with_reflection(const { Rgb::new(Lumen::lit("0.02956"), Lumen::lit("0.02956"), Lumen::lit("0.02956")) })),
        // rim
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.80695"), Lumen::lit("0.68669"), Lumen::lit("0.39157")) }).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.8") })?),
        // table
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.55202"), Lumen::lit("0.39157")) }).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.8") })?),
    ])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves() -> Result<[Leaf<'static, Thing>; 5], Error> {
    Ok([
        // table
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::IDENTITY)?), materials: &[3] },
        // S1
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::translate(const { Vec3::lit("0", "0", "0.985") }))?), materials: &[0] },
        // S2
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.88", "0.88", "0.88") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "0.985") })))?), materials: &[1] },
        // C
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("0") })?, &Affine3::scale(const { Vec3::lit("1.9", "1.9", "-1.7") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "1.4") })).then(&Affine3::translate(const { Vec3::lit("0", "0", "0.985") })))?), materials: &[2] },
        // foot
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("0.8") })?, &Affine3::scale(const { Vec3::lit("0.5", "0.5", "0.12") }))?), materials: &[0] },
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
        Lamp::distant(const { Vec3::lit("-3", "-3", "6") }, const { Rgb::new(Lumen::lit("0.9"), Lumen::lit("0.86"), Lumen::lit("0.78")) })?,
        // light 1
        Lamp::distant(const { Vec3::lit("4", "-2", "3") }, const { Rgb::new(Lumen::lit("0.12"), Lumen::lit("0.14"), Lumen::lit("0.2")) })?,
    ])
}

/// Of which shapes each object is made, in reverse Polish.
#[rustfmt::skip]
pub static PROGRAMS: [&[Op]; 3] = [
    &[Op::Leaf(0)],
    &[Op::Leaf(1), Op::Leaf(2), Op::Difference, Op::Leaf(3), Op::Difference],
    &[Op::Leaf(4)],
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
) -> Result<[Object<'a>; 3], Error> {
    let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
    let (one_0, boxes) = boxes.split_at_mut(1);
    let (one_1, boxes) = boxes.split_at_mut(5);
    let (one_2, _) = boxes.split_at_mut(1);
    Ok([
        Object::new(PROGRAMS[0], surface, one_0)?,
        Object::new(PROGRAMS[1], surface, one_1)?,
        Object::new(PROGRAMS[2], surface, one_2)?,
    ])
}

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("0", "-6.2", "4.4");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0", "0", "0.72");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("24");

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
pub const CONTRAST: Option<[u8; 2]> = Some([50, 184]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 9, 7>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.08865"), Lumen::lit("0.11697"), Lumen::lit("0.15593")) }, horizon: const { Rgb::new(Lumen::lit("0.7454"), Lumen::lit("0.7157"), Lumen::lit("0.65837")) }, nadir: const { Rgb::new(Lumen::lit("0.01445"), Lumen::lit("0.01445"), Lumen::lit("0.01445")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 2, seed }, Filter::Box)
}
