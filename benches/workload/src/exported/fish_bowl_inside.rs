//! A fish bowl with the eye in the water: the room through its wall, and total reflection below the surface.
//!
//! Written by `attractor export --gallery fish-bowl-inside`.

use attractor::Error;
use attractor::num::{Affine3, Angle, Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Clear, Medium, Mixture, Phong};
use attractor::trace::solid::{Placed, Plane, Sphere, TaperedCylinder};
use attractor::trace::texture::{Checker, Mottle, Noise, Spline, Turbulence};
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
        /// `Mixture<Checker>`.
        Checker(Mixture<Checker>),
        /// `Mixture<Mottle<2>>`.
        Mottle(Mixture<Mottle<2>>),
        /// `Mixture`.
        Plain(Mixture),
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
pub fn materials() -> Result<[Stuff; 8], Error> {
    Ok([
        // dark
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.00519"), Lumen::lit("0.00519"), Lumen::lit("0.00519")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?.with_highlight(Rgb::WHITE, Phong { shininess: 80 })),
        // glass
        Stuff::PlainPhongClear(Mixture::matt(Rgb::WHITE).with_parts(const { Unit::lit("0") }, const { Unit::lit("0") })?.with_highlight(Rgb::WHITE, Phong { shininess: 250 }).with_interior(Clear::new(Medium { index: const { Real::lit("1.5") }, priority: 2, fresnel: true }, const { Rgb::new(Lumen::lit("0.90466"), Lumen::lit("0.97345"), Lumen::lit("0.95598")) })?)),
        // gold
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.21587"), Lumen::lit("0.00914")) }).with_parts(const { Unit::lit("0.3") }, const { Unit::lit("0.7") })?.with_highlight(const { Rgb::new(Lumen::lit("0.52711"), Lumen::lit("0.35153"), Lumen::lit("0.21587")) }, Phong { shininess: 30 })),
        // red
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.63075"), Lumen::lit("0.02956"), Lumen::lit("0.01445")) }).with_parts(const { Unit::lit("0.3") }, const { Unit::lit("0.7") })?.with_highlight(const { Rgb::new(Lumen::lit("0.35153"), Lumen::lit("0.21587"), Lumen::lit("0.21587")) }, Phong { shininess: 30 })),
        // slate
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.09758"), Lumen::lit("0.13843"), Lumen::lit("0.18782")) }).with_parts(const { Unit::lit("0.3") }, const { Unit::lit("0.7") })?),
        // stone
        Stuff::Mottle(Mixture::matt(Mottle { undulate: Spline::new(&[(const { Unit::lit("-0.4") }, const { Rgb::new(Lumen::lit("0.11697"), Lumen::lit("0.09758"), Lumen::lit("0.08022")) }), (const { Unit::lit("0.4") }, const { Rgb::new(Lumen::lit("0.47932"), Lumen::lit("0.39157"), Lumen::lit("0.314")) })])?, turbulence: Turbulence::new(Noise::new(0), const { Real::lit("6") }, 4)? }).with_parts(const { Unit::lit("0.3") }, const { Unit::lit("0.7") })?),
        // table
        Stuff::Checker(Mixture::matt(Checker::cubes([const { Real::lit("1.25") }, const { Real::lit("1.25") }, const { Real::lit("1.25") }], const { Rgb::new(Lumen::lit("0.80695"), Lumen::lit("0.7454"), Lumen::lit("0.65837")) }, const { Rgb::new(Lumen::lit("0.39157"), Lumen::lit("0.04518"), Lumen::lit("0.03955")) })).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.8") })?),
        // water
        Stuff::PlainPhongClear(Mixture::matt(Rgb::WHITE).with_parts(const { Unit::lit("0") }, const { Unit::lit("0") })?.with_highlight(const { Rgb::new(Lumen::lit("0.05127"), Lumen::lit("0.05127"), Lumen::lit("0.05127")) }, Phong { shininess: 200 }).with_interior(Clear::new(Medium { index: const { Real::lit("1.33") }, priority: 1, fresnel: true }, const { Rgb::new(Lumen::lit("0.77582"), Lumen::lit("0.90466"), Lumen::lit("0.90466")) })?)),
    ])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves() -> Result<[Leaf<'static, Thing>; 16], Error> {
    Ok([
        // table
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::IDENTITY)?), materials: &[6] },
        // outer
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("1.3", "1.3", "1.3") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "1.3") })))?), materials: &[1] },
        // inner
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("1.22", "1.22", "1.22") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "1.3") })))?), materials: &[1] },
        // mouth
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("1") })?, &Affine3::scale(const { Vec3::lit("0.95", "0.95", "1") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "0.6") })).then(&Affine3::translate(const { Vec3::lit("0", "0", "1.3") })))?), materials: &[1] },
        // globe
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("1.25", "1.25", "1.25") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "1.3") })))?), materials: &[7] },
        // level
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::translate(const { Vec3::lit("0", "0", "0.55") }).then(&Affine3::translate(const { Vec3::lit("0", "0", "1.3") })))?), materials: &[7] },
        // body
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.42", "0.16", "0.24") }).then(&Affine3::scale(const { Vec3::lit("0.42", "0.42", "0.42") })).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.05") })?).then(&Affine3::translate(const { Vec3::lit("-0.22", "0.2", "1.48") })))?), materials: &[2] },
        // tail
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("0.25") })?, &Affine3::scale(const { Vec3::lit("0.26", "0.06", "0.36") }).then(&Affine3::rotate(const { Vec3::lit("0", "1", "0") }, const { Angle::lit("0.25") })?).then(&Affine3::translate(const { Vec3::lit("-0.72", "0", "0") })).then(&Affine3::scale(const { Vec3::lit("0.42", "0.42", "0.42") })).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.05") })?).then(&Affine3::translate(const { Vec3::lit("-0.22", "0.2", "1.48") })))?), materials: &[2] },
        // fin
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.2", "0.04", "0.16") }).then(&Affine3::rotate(const { Vec3::lit("0", "1", "0") }, const { Angle::lit("0.0694444445") })?).then(&Affine3::translate(const { Vec3::lit("-0.05", "0", "0.2") })).then(&Affine3::scale(const { Vec3::lit("0.42", "0.42", "0.42") })).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.05") })?).then(&Affine3::translate(const { Vec3::lit("-0.22", "0.2", "1.48") })))?), materials: &[2] },
        // eyeball
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.055", "0.055", "0.055") }).then(&Affine3::translate(const { Vec3::lit("0.3", "-0.1", "0.05") })).then(&Affine3::scale(const { Vec3::lit("0.42", "0.42", "0.42") })).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.05") })?).then(&Affine3::translate(const { Vec3::lit("-0.22", "0.2", "1.48") })))?), materials: &[0] },
        // body
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.42", "0.16", "0.24") }).then(&Affine3::scale(const { Vec3::lit("0.34", "0.34", "0.34") })).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.0277777778") })?).then(&Affine3::translate(const { Vec3::lit("0.12", "0.3", "1.12") })))?), materials: &[3] },
        // tail
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("0.25") })?, &Affine3::scale(const { Vec3::lit("0.26", "0.06", "0.36") }).then(&Affine3::rotate(const { Vec3::lit("0", "1", "0") }, const { Angle::lit("0.25") })?).then(&Affine3::translate(const { Vec3::lit("-0.72", "0", "0") })).then(&Affine3::scale(const { Vec3::lit("0.34", "0.34", "0.34") })).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.0277777778") })?).then(&Affine3::translate(const { Vec3::lit("0.12", "0.3", "1.12") })))?), materials: &[3] },
        // fin
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.2", "0.04", "0.16") }).then(&Affine3::rotate(const { Vec3::lit("0", "1", "0") }, const { Angle::lit("0.0694444445") })?).then(&Affine3::translate(const { Vec3::lit("-0.05", "0", "0.2") })).then(&Affine3::scale(const { Vec3::lit("0.34", "0.34", "0.34") })).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.0277777778") })?).then(&Affine3::translate(const { Vec3::lit("0.12", "0.3", "1.12") })))?), materials: &[3] },
        // eyeball
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.055", "0.055", "0.055") }).then(&Affine3::translate(const { Vec3::lit("0.3", "-0.1", "0.05") })).then(&Affine3::scale(const { Vec3::lit("0.34", "0.34", "0.34") })).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.0277777778") })?).then(&Affine3::translate(const { Vec3::lit("0.12", "0.3", "1.12") })))?), materials: &[0] },
        // pebble
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.3", "0.26", "0.16") }).then(&Affine3::translate(const { Vec3::lit("-0.35", "0.2", "0.25") })))?), materials: &[5] },
        // flat pebble
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.24", "0.28", "0.12") }).then(&Affine3::translate(const { Vec3::lit("0.25", "-0.1", "0.24") })))?), materials: &[4] },
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
        Lamp::distant(const { Vec3::lit("-3", "-3", "6") }, const { Rgb::new(Lumen::lit("0.95"), Lumen::lit("0.92"), Lumen::lit("0.86")) })?,
    ])
}

/// Of which shapes each object is made, in reverse Polish.
#[rustfmt::skip]
pub static PROGRAMS: [&[Op]; 7] = [
    &[Op::Leaf(0)],
    &[Op::Leaf(1), Op::Leaf(2), Op::Difference, Op::Leaf(3), Op::Difference],
    &[Op::Leaf(4), Op::Leaf(5), Op::Intersection],
    &[Op::Leaf(6), Op::Leaf(7), Op::Union, Op::Leaf(8), Op::Union, Op::Leaf(9), Op::Union],
    &[Op::Leaf(10), Op::Leaf(11), Op::Union, Op::Leaf(12), Op::Union, Op::Leaf(13), Op::Union],
    &[Op::Leaf(14)],
    &[Op::Leaf(15)],
];

/// How many boxes the objects borrow.
pub const BOXES: usize = 25;

/// The objects.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn objects<'a>(
    leaves: &[Leaf<'static, Thing>],
    boxes: &'a mut [Extent; BOXES],
) -> Result<[Object<'a>; 7], Error> {
    let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
    let (one_0, boxes) = boxes.split_at_mut(1);
    let (one_1, boxes) = boxes.split_at_mut(5);
    let (one_2, boxes) = boxes.split_at_mut(3);
    let (one_3, boxes) = boxes.split_at_mut(7);
    let (one_4, boxes) = boxes.split_at_mut(7);
    let (one_5, boxes) = boxes.split_at_mut(1);
    let (one_6, _) = boxes.split_at_mut(1);
    Ok([
        Object::new(PROGRAMS[0], surface, one_0)?,
        Object::new(PROGRAMS[1], surface, one_1)?,
        Object::new(PROGRAMS[2], surface, one_2)?,
        Object::new(PROGRAMS[3], surface, one_3)?,
        Object::new(PROGRAMS[4], surface, one_4)?,
        Object::new(PROGRAMS[5], surface, one_5)?,
        Object::new(PROGRAMS[6], surface, one_6)?,
    ])
}

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("0.7", "-0.85", "1.05");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("-0.2", "0.3", "1.3");

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
pub const CONTRAST: Option<[u8; 2]> = Some([72, 220]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 30, 9>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.0648"), Lumen::lit("0.14996"), Lumen::lit("0.314")) }, horizon: const { Rgb::new(Lumen::lit("0.7157"), Lumen::lit("0.77582"), Lumen::lit("0.7913")) }, nadir: const { Rgb::new(Lumen::lit("0.02956"), Lumen::lit("0.02122"), Lumen::lit("0.01161")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 2, seed }, Filter::Box)
}
