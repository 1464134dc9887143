//! An orange: a sphere with bumps, and half of another.
//!
//! Written by `attractor export --gallery orange`.

use attractor::Error;
use attractor::num::{Affine3, Angle, Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Mixture, Phong};
use attractor::trace::solid::{Placed, Plane, Sphere, TaperedCylinder};
use attractor::trace::texture::{Bumpy, Noise, Rough, Turbulence, Wood};
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
        /// `Bumpy<Mixture<Rgb, Phong>, Rough>`.
        PlainPhongRough(Bumpy<Mixture<Rgb, Phong>, Rough>),
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
        // flesh
        Stuff::WoodPhong(Mixture::matt(Wood { colors: [const { Rgb::new(Lumen::lit("0.93869"), Lumen::lit("0.43416"), Lumen::lit("0.05127")) }, const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.2789"), Lumen::lit("0.01445")) }], rings: const { Real::lit("1") }, tilt: [const { Real::lit("0") }, const { Real::lit("0") }], wobble: const { Real::lit("0") }, lobes: 5, twist: const { Real::lit("0") }, rough: None, soft: const { Unit::lit("1") } }).with_parts(const { Unit::lit("0.25") }, const { Unit::lit("0.75") })?.with_highlight(const { Rgb::new(Lumen::lit("0.11697"), Lumen::lit("0.11697"), Lumen::lit("0.11697")) }, Phong { shininess: 40 })),
        // peel
        Stuff::PlainPhongRough(Bumpy { material: Mixture::matt(const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.23074"), Lumen::lit("0.00914")) }).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.75") })?.with_highlight(const { Rgb::new(Lumen::lit("0.35153"), Lumen::lit("0.2462"), Lumen::lit("0.13843")) }, Phong { shininess: 28 }), bump: Rough { turbulence: Turbulence::new(Noise::new(0), const { Real::lit("16") }, 1)?, height: const { Real::lit("0.035") } } }),
        // stalk
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.08022"), Lumen::lit("0.12744"), Lumen::lit("0.02122")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?),
        // table
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.47932"), Lumen::lit("0.63075"), Lumen::lit("0.52711")) }).with_parts(const { Unit::lit("0.25") }, const { Unit::lit("0.75") })?),
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
        // orange
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::rotate(const { Vec3::lit("0", "1", "0") }, const { Angle::lit("0.0555555555") })?.then(&Affine3::translate(const { Vec3::lit("-0.35", "0.3", "1") })))?), materials: &[1] },
        // stalk
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("0.6") })?, &Affine3::scale(const { Vec3::lit("0.07", "0.07", "0.12") }).then(&Affine3::rotate(const { Vec3::lit("0", "1", "0") }, const { Angle::lit("0.0333333334") })?).then(&Affine3::translate(const { Vec3::lit("-0.13", "0.26", "1.95") })))?), materials: &[2] },
        // small
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.62", "0.62", "0.62") }).then(&Affine3::translate(const { Vec3::lit("1.35", "-0.7", "0.62") })))?), materials: &[1] },
        // knife
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::rotate(const { Vec3::lit("1", "0", "0") }, const { Angle::lit("0.1722222222") })?.then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.9305555555") })?).then(&Affine3::translate(const { Vec3::lit("0", "0", "0") })).then(&Affine3::translate(const { Vec3::lit("1.35", "-0.7", "0.62") })))?), materials: &[0] },
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
        Lamp::distant(const { Vec3::lit("-4", "-4", "6") }, const { Rgb::new(Lumen::lit("1.3"), Lumen::lit("1.25"), Lumen::lit("1.2")) })?,
    ])
}

/// Of which shapes each object is made, in reverse Polish.
#[rustfmt::skip]
pub static PROGRAMS: [&[Op]; 4] = [
    &[Op::Leaf(0)],
    &[Op::Leaf(1)],
    &[Op::Leaf(2)],
    &[Op::Leaf(3), Op::Leaf(4), Op::Intersection],
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
) -> Result<[Object<'a>; 4], Error> {
    let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
    let (one_0, boxes) = boxes.split_at_mut(1);
    let (one_1, boxes) = boxes.split_at_mut(1);
    let (one_2, boxes) = boxes.split_at_mut(1);
    let (one_3, _) = boxes.split_at_mut(3);
    Ok([
        Object::new(PROGRAMS[0], surface, one_0)?,
        Object::new(PROGRAMS[1], surface, one_1)?,
        Object::new(PROGRAMS[2], surface, one_2)?,
        Object::new(PROGRAMS[3], surface, one_3)?,
    ])
}

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("-1.2", "-6.2", "3.3");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0.45", "0", "0.75");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("33");

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
pub const CONTRAST: Option<[u8; 2]> = Some([100, 198]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 8, 7>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.09758"), Lumen::lit("0.18782"), Lumen::lit("0.35153")) }, horizon: const { Rgb::new(Lumen::lit("0.63075"), Lumen::lit("0.65837"), Lumen::lit("0.68669")) }, nadir: const { Rgb::new(Lumen::lit("0.05127"), Lumen::lit("0.03955"), Lumen::lit("0.02956")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 3, seed }, Filter::Box)
}
