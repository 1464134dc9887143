//! A rocket, the union of two cones and two cylinders.
//!
//! Written by `attractor export --gallery rocket`.

use attractor::Error;
use attractor::num::{Affine3, Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Mixture, Phong, TorranceSparrow};
use attractor::trace::solid::{Placed, Plane, TaperedCylinder};
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, Sampling, Sky};
use embedded_graphics::geometry::Size;

attractor::surfaces! {
    /// What stands in it.
    #[derive(Debug, Clone, Copy)]
    pub enum Thing {
        /// `Placed<Plane>`.
        Plane(Placed<Plane>),
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
        /// `Mixture<Rgb, TorranceSparrow>`.
        PlainRough(Mixture<Rgb, TorranceSparrow>),
    }
}

/// The materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn materials() -> Result<[Stuff; 5], Error> {
    Ok([
        // concrete
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.43416"), Lumen::lit("0.43416"), Lumen::lit("0.43416")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?),
        // ground
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.57758"), Lumen::lit("0.4564"), Lumen::lit("0.314")) }).with_parts(const { Unit::lit("0.25") }, const { Unit::lit("0.75") })?),
        // red
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.57758"), Lumen::lit("0.02122"), Lumen::lit("0.00914")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?.with_highlight(const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.21587"), Lumen::lit("0.21587")) }, Phong { shininess: 40 })),
        // steel
        Stuff::PlainRough(Mixture::matt(const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.2462"), Lumen::lit("0.2789")) }).with_parts(const { Unit::lit("0.1") }, const { Unit::lit("0.3") })?.with_highlight(const { Rgb::new(Lumen::lit("0.52711"), Lumen::lit("0.57758"), Lumen::lit("0.63075")) }, TorranceSparrow::new(const { Unit::lit("0.25") }, const { Unit::lit("1") })?)),
        // white
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.90466"), Lumen::lit("0.88792"), Lumen::lit("0.855")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?.with_highlight(const { Rgb::new(Lumen::lit("0.11697"), Lumen::lit("0.11697"), Lumen::lit("0.11697")) }, Phong { shininess: 40 })),
    ])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves() -> Result<[Leaf<'static, Thing>; 6], Error> {
    Ok([
        // ground
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::IDENTITY)?), materials: &[1] },
        // pad
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("0.9") })?, &Affine3::scale(const { Vec3::lit("1.6", "1.6", "0.15") }))?), materials: &[0] },
        // nozzle
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("0.45") })?, &Affine3::scale(const { Vec3::lit("0.62", "0.62", "0.6") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "0.35") })))?), materials: &[3] },
        // first stage
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("1") })?, &Affine3::scale(const { Vec3::lit("0.5", "0.5", "1.7") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "0.9") })))?), materials: &[4, 2, 2] },
        // second stage
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("1") })?, &Affine3::scale(const { Vec3::lit("0.36", "0.36", "0.8") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "2.6") })))?), materials: &[4] },
        // nose
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("0") })?, &Affine3::scale(const { Vec3::lit("0.42", "0.42", "0.9") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "3.3") })))?), materials: &[2] },
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
        Lamp::distant(const { Vec3::lit("-3", "-5", "4") }, const { Rgb::new(Lumen::lit("0.95"), Lumen::lit("0.9"), Lumen::lit("0.82")) })?,
    ])
}

/// Of which shapes each object is made, in reverse Polish.
#[rustfmt::skip]
pub static PROGRAMS: [&[Op]; 3] = [
    &[Op::Leaf(0)],
    &[Op::Leaf(1)],
    &[Op::Leaf(2), Op::Leaf(3), Op::Union, Op::Leaf(4), Op::Union, Op::Leaf(5), Op::Union],
];

/// How many boxes the objects borrow.
pub const BOXES: usize = 9;

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
    let (one_1, boxes) = boxes.split_at_mut(1);
    let (one_2, _) = boxes.split_at_mut(7);
    Ok([
        Object::new(PROGRAMS[0], surface, one_0)?,
        Object::new(PROGRAMS[1], surface, one_1)?,
        Object::new(PROGRAMS[2], surface, one_2)?,
    ])
}

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("5", "-8", "1.6");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0", "0", "2.15");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("30");

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
pub const CONTRAST: Option<[u8; 2]> = Some([94, 210]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 11, 7>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.0648"), Lumen::lit("0.18782"), Lumen::lit("0.52711")) }, horizon: const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.57758"), Lumen::lit("0.35153")) }, nadir: const { Rgb::new(Lumen::lit("0.05127"), Lumen::lit("0.02956"), Lumen::lit("0.02122")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 2, seed }, Filter::Box)
}
