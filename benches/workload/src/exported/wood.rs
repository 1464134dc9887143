//! Wood: rings round an axis, cut at every angle.
//!
//! Written by `attractor export --gallery wood`.

use attractor::Error;
use attractor::num::{Affine3, Angle, Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Mixture, Phong};
use attractor::trace::solid::{Cube, Placed, Plane, Sphere, TaperedCylinder};
use attractor::trace::texture::{Mottle, Noise, Spline, Turbulence, Wood};
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
        /// `Placed<TaperedCylinder>`.
        TaperedCylinder(Placed<TaperedCylinder>),
    }
}

attractor::materials! {
    /// What things are made of.
    #[derive(Debug, Clone, Copy)]
    pub enum Stuff {
        /// `Mixture<Mottle<3>>`.
        Mottle(Mixture<Mottle<3>>),
        /// `Mixture`.
        Plain(Mixture),
        /// `Mixture<Wood, Phong>`.
        WoodPhong(Mixture<Wood, Phong>),
    }
}

/// The materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn materials() -> Result<[Stuff; 4], Error> {
    Ok([
        // bark
        Stuff::Mottle(Mixture::matt(Mottle { undulate: Spline::new(&[(const { Unit::lit("-0.4") }, const { Rgb::new(Lumen::lit("0.02519"), Lumen::lit("0.01161"), Lumen::lit("0.00519")) }), (const { Unit::lit("0") }, const { Rgb::new(Lumen::lit("0.10703"), Lumen::lit("0.05127"), Lumen::lit("0.02122")) }), (const { Unit::lit("0.4") }, const { Rgb::new(Lumen::lit("0.26225"), Lumen::lit("0.14996"), Lumen::lit("0.0648")) })])?, turbulence: Turbulence::new(Noise::new(0), const { Real::lit("7") }, 4)? }).with_parts(const { Unit::lit("0.22") }, const { Unit::lit("0.78") })?),
        // bench
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.63075"), Lumen::lit("0.65837"), Lumen::lit("0.57758")) }).with_parts(const { Unit::lit("0.25") }, const { Unit::lit("0.75") })?),
        // cherry
        Stuff::WoodPhong(Mixture::matt(Wood { colors: [const { Rgb::new(Lumen::lit("0.47932"), Lumen::lit("0.11697"), Lumen::lit("0.03955")) }, const { Rgb::new(Lumen::lit("0.20155"), Lumen::lit("0.02956"), Lumen::lit("0.00914")) }], rings: const { Real::lit("6") }, tilt: [const { Real::lit("0.5") }, const { Real::lit("0.3") }], wobble: const { Real::lit("0.3") }, lobes: 4, twist: const { Real::lit("0") }, rough: Some((Turbulence::new(Noise::new(0), const { Real::lit("1.5") }, 4)?, const { Real::lit("0.5") })), soft: const { Unit::lit("0.6") } }).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.75") })?.with_highlight(const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.16203"), Lumen::lit("0.11697")) }, Phong { shininess: 60 })),
        // oak
        Stuff::WoodPhong(Mixture::matt(Wood { colors: [const { Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.39157"), Lumen::lit("0.13843")) }, const { Rgb::new(Lumen::lit("0.33246"), Lumen::lit("0.13843"), Lumen::lit("0.03955")) }], rings: const { Real::lit("7") }, tilt: [const { Real::lit("0.12") }, const { Real::lit("0.05") }], wobble: const { Real::lit("0.35") }, lobes: 3, twist: const { Real::lit("0.2") }, rough: Some((Turbulence::new(Noise::new(0), const { Real::lit("1.6") }, 4)?, const { Real::lit("0.5") })), soft: const { Unit::lit("0.55") } }).with_parts(const { Unit::lit("0.22") }, const { Unit::lit("0.78") })?.with_highlight(const { Rgb::new(Lumen::lit("0.03955"), Lumen::lit("0.02956"), Lumen::lit("0.02122")) }, Phong { shininess: 20 })),
    ])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves() -> Result<[Leaf<'static, Thing>; 4], Error> {
    Ok([
        // bench
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::IDENTITY)?), materials: &[1] },
        // block
        Leaf { surface: Thing::Cube(Placed::new(Cube, &Affine3::scale(const { Vec3::lit("0.9", "0.75", "0.7") }).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.0777777778") })?).then(&Affine3::translate(const { Vec3::lit("0.55", "1.05", "0.7") })))?), materials: &[3] },
        // log
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("1") })?, &Affine3::scale(const { Vec3::lit("0.62", "0.62", "2.3") }).then(&Affine3::rotate(const { Vec3::lit("1", "0", "0") }, const { Angle::lit("0.25") })?).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.0611111112") })?).then(&Affine3::translate(const { Vec3::lit("-0.75", "-0.75", "0.62") })))?), materials: &[0, 3, 3] },
        // ball
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.62", "0.62", "0.62") }).then(&Affine3::translate(const { Vec3::lit("1.75", "-0.5", "0.62") })))?), materials: &[2] },
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
        Lamp::distant(const { Vec3::lit("-4", "-3", "6") }, const { Rgb::new(Lumen::lit("1.35"), Lumen::lit("1.25"), Lumen::lit("1.1")) })?,
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
pub const EYE: Vec3 = Vec3::lit("-3", "-7.2", "4.6");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0.1", "0", "0.75");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("34");

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
pub const CONTRAST: Option<[u8; 2]> = Some([60, 208]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 7, 7, false>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.11697"), Lumen::lit("0.13843"), Lumen::lit("0.16203")) }, horizon: const { Rgb::new(Lumen::lit("0.57758"), Lumen::lit("0.52711"), Lumen::lit("0.4564")) }, nadir: const { Rgb::new(Lumen::lit("0.02956"), Lumen::lit("0.02122"), Lumen::lit("0.01445")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 3, seed }, Filter::Box)
}
