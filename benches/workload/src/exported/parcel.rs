//! A parcel and a tin: pattern polygons pasted on their faces.
//!
//! Written by `attractor export --gallery parcel`.

use attractor::Error;
use attractor::num::{Affine3, Angle, Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Mixture, Phong};
use attractor::trace::solid::{Cube, Placed, Square, TaperedCylinder};
use attractor::trace::texture::{Checker, Marble, Noise, Pasted, Spline, Turbulence, Wood};
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, Sampling, Sky};
use embedded_graphics::geometry::Size;

attractor::surfaces! {
    /// What stands in it.
    #[derive(Debug, Clone, Copy)]
    pub enum Thing {
        /// `Placed<Cube>`.
        Cube(Placed<Cube>),
        /// `Placed<Square>`.
        Square(Placed<Square>),
        /// `Placed<TaperedCylinder>`.
        TaperedCylinder(Placed<TaperedCylinder>),
    }
}

attractor::materials! {
    /// What things are made of.
    #[derive(Debug, Clone, Copy)]
    pub enum Stuff {
        /// `Mixture<Pasted<'static, Pasted<'static, Rgb, Checker>, Marble<3>>>`.
        MarbleOnCheckerOnPlain(Mixture<Pasted<'static, Pasted<'static, Rgb, Checker>, Marble<3>>>),
        /// `Mixture`.
        Plain(Mixture),
        /// `Mixture<Pasted<'static, Rgb, Rgb>>`.
        PlainOnPlain(Mixture<Pasted<'static, Rgb, Rgb>>),
        /// `Mixture<Pasted<'static, Pasted<'static, Rgb, Rgb>, Rgb>>`.
        PlainOnPlainOnPlain(Mixture<Pasted<'static, Pasted<'static, Rgb, Rgb>, Rgb>>),
        /// `Mixture<Pasted<'static, Rgb, Pasted<'static, Rgb, Rgb>>, Phong>`.
        PlainOnPlainOnPlainPhong(Mixture<Pasted<'static, Rgb, Pasted<'static, Rgb, Rgb>>, Phong>),
        /// `Mixture<Rgb, Phong>`.
        PlainPhong(Mixture<Rgb, Phong>),
        /// `Mixture<Wood>`.
        Wood(Mixture<Wood>),
    }
}

/// The materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn materials() -> Result<[Stuff; 7], Error> {
    Ok([
        // card
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.43416"), Lumen::lit("0.2462"), Lumen::lit("0.08022")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?),
        // front
        Stuff::MarbleOnCheckerOnPlain(Mixture::matt(Pasted::new(Pasted::new(const { Rgb::new(Lumen::lit("0.43416"), Lumen::lit("0.2462"), Lumen::lit("0.08022")) }, &const { [[Real::lit("0.1"), Real::lit("0.15")], [Real::lit("0.62"), Real::lit("0.15")], [Real::lit("0.62"), Real::lit("0.7")], [Real::lit("0.1"), Real::lit("0.7")]] }, Checker::squares([const { Real::lit("0") }, const { Real::lit("22") }], const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.8388"), Lumen::lit("0.7454")) }, const { Rgb::new(Lumen::lit("0.35153"), Lumen::lit("0.39157"), Lumen::lit("0.43416")) }))?, &const { [[Real::lit("0.72"), Real::lit("0.62")], [Real::lit("0.92"), Real::lit("0.62")], [Real::lit("0.92"), Real::lit("0.9")], [Real::lit("0.72"), Real::lit("0.9")]] }, Marble { undulate: Spline::new(&[(const { Unit::lit("-1") }, const { Rgb::new(Lumen::lit("0.52711"), Lumen::lit("0.02122"), Lumen::lit("0.02956")) }), (const { Unit::lit("0") }, const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.63075"), Lumen::lit("0.52711")) }), (const { Unit::lit("1") }, const { Rgb::new(Lumen::lit("0.52711"), Lumen::lit("0.02122"), Lumen::lit("0.02956")) })])?, turbulence: Turbulence::new(Noise::new(0), const { Real::lit("3") }, 4)?, amplitude: const { Real::lit("4") }, frequency: const { Real::lit("2") } })?).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?),
        // lid
        Stuff::PlainOnPlain(Mixture::matt(Pasted::new(const { Rgb::new(Lumen::lit("0.43416"), Lumen::lit("0.2462"), Lumen::lit("0.08022")) }, &const { [[Real::lit("0"), Real::lit("0.42")], [Real::lit("1"), Real::lit("0.42")], [Real::lit("1"), Real::lit("0.58")], [Real::lit("0"), Real::lit("0.58")]] }, const { Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.52711"), Lumen::lit("0.2789")) })?).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?),
        // metal
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.2462"), Lumen::lit("0.2789"), Lumen::lit("0.314")) }).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?.with_highlight(const { Rgb::new(Lumen::lit("0.52711"), Lumen::lit("0.52711"), Lumen::lit("0.52711")) }, Phong { shininess: 60 })),
        // side
        Stuff::PlainOnPlainOnPlain(Mixture::matt(Pasted::new(Pasted::new(const { Rgb::new(Lumen::lit("0.43416"), Lumen::lit("0.2462"), Lumen::lit("0.08022")) }, &const { [[Real::lit("0.42"), Real::lit("0.15")], [Real::lit("0.58"), Real::lit("0.15")], [Real::lit("0.58"), Real::lit("0.55")], [Real::lit("0.42"), Real::lit("0.55")]] }, const { Rgb::new(Lumen::lit("0.03955"), Lumen::lit("0.02122"), Lumen::lit("0.00914")) })?, &const { [[Real::lit("0.25"), Real::lit("0.55")], [Real::lit("0.75"), Real::lit("0.55")], [Real::lit("0.5"), Real::lit("0.88")]] }, const { Rgb::new(Lumen::lit("0.03955"), Lumen::lit("0.02122"), Lumen::lit("0.00914")) })?).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?),
        // tin
        Stuff::PlainOnPlainOnPlainPhong(Mixture::matt(Pasted::new(const { Rgb::new(Lumen::lit("0.2462"), Lumen::lit("0.2789"), Lumen::lit("0.314")) }, &const { [[Real::lit("0"), Real::lit("0.12")], [Real::lit("1"), Real::lit("0.12")], [Real::lit("1"), Real::lit("0.88")], [Real::lit("0"), Real::lit("0.88")]] }, Pasted::new(const { Rgb::new(Lumen::lit("0.01445"), Lumen::lit("0.13843"), Lumen::lit("0.03955")) }, &const { [[Real::lit("0.14"), Real::lit("0.5")], [Real::lit("0.2"), Real::lit("0.26")], [Real::lit("0.26"), Real::lit("0.5")], [Real::lit("0.2"), Real::lit("0.74")]] }, const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.63075"), Lumen::lit("0.05127")) })?)?).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?.with_highlight(const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.21587"), Lumen::lit("0.21587")) }, Phong { shininess: 30 })),
        // wood
        Stuff::Wood(Mixture::matt(Wood { colors: [const { Rgb::new(Lumen::lit("0.52711"), Lumen::lit("0.35153"), Lumen::lit("0.18782")) }, const { Rgb::new(Lumen::lit("0.43416"), Lumen::lit("0.26225"), Lumen::lit("0.11697")) }], rings: const { Real::lit("3") }, tilt: [const { Real::lit("0") }, const { Real::lit("6") }], wobble: const { Real::lit("0.4") }, lobes: 5, twist: const { Real::lit("0") }, rough: None, soft: const { Unit::lit("1") } }).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.75") })?),
    ])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves() -> Result<[Leaf<'static, Thing>; 3], Error> {
    Ok([
        // table
        Leaf { surface: Thing::Square(Placed::new(Square, &Affine3::scale(const { Vec3::lit("4", "4", "1") }))?), materials: &[6] },
        // parcel
        Leaf { surface: Thing::Cube(Placed::new(Cube, &Affine3::scale(const { Vec3::lit("1", "0.8", "0.65") }).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.0333333334") })?).then(&Affine3::translate(const { Vec3::lit("-0.35", "0.2", "0.65") })))?), materials: &[4, 4, 1, 1, 0, 2] },
        // tin
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("1") })?, &Affine3::scale(const { Vec3::lit("0.5", "0.5", "1.2") }).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.4305555555") })?).then(&Affine3::translate(const { Vec3::lit("1.5", "-0.7", "0") })))?), materials: &[5, 3, 3] },
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
        Lamp::distant(const { Vec3::lit("-2", "-5", "6") }, const { Rgb::new(Lumen::lit("1.25"), Lumen::lit("1.2"), Lumen::lit("1.1")) })?,
    ])
}

/// Of which shapes each object is made, in reverse Polish.
#[rustfmt::skip]
pub static PROGRAMS: [&[Op]; 3] = [
    &[Op::Leaf(0)],
    &[Op::Leaf(1)],
    &[Op::Leaf(2)],
];

/// How many boxes the objects borrow.
pub const BOXES: usize = 3;

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
    let (one_2, _) = boxes.split_at_mut(1);
    Ok([
        Object::new(PROGRAMS[0], surface, one_0)?,
        Object::new(PROGRAMS[1], surface, one_1)?,
        Object::new(PROGRAMS[2], surface, one_2)?,
    ])
}

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("-3.4", "-6", "3.6");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0.15", "0", "0.75");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("32");

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
pub const CONTRAST: Option<[u8; 2]> = Some([85, 201]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 5, 7, false>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let _ = seed;
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.09758"), Lumen::lit("0.18782"), Lumen::lit("0.35153")) }, horizon: const { Rgb::new(Lumen::lit("0.63075"), Lumen::lit("0.65837"), Lumen::lit("0.68669")) }, nadir: const { Rgb::new(Lumen::lit("0.05127"), Lumen::lit("0.03955"), Lumen::lit("0.02956")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Centre, Filter::Box)
}
