//! Cloth, silk and brushed steel: highlights along a grain that frame mapping turns.
//!
//! Written by `attractor export --gallery cloth`.

use attractor::Error;
use attractor::num::{Affine3, Lumen, Near, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Anisotropic, Mixture};
use attractor::trace::solid::{Placed, Sphere, Square, TaperedCylinder, Torus};
use attractor::trace::texture::{Checker, Framed};
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, Sampling, Sky};
use embedded_graphics::geometry::Size;

attractor::surfaces! {
    /// What stands in it.
    #[derive(Debug, Clone, Copy)]
    pub enum Thing {
        /// `Placed<Sphere>`.
        Sphere(Placed<Sphere>),
        /// `Placed<Square>`.
        Square(Placed<Square>),
        /// `Placed<TaperedCylinder>`.
        TaperedCylinder(Placed<TaperedCylinder>),
        /// `Placed<Torus>`.
        Torus(Placed<Torus>),
    }
}

attractor::materials! {
    /// What things are made of.
    #[derive(Debug, Clone, Copy)]
    pub enum Stuff {
        /// `Framed<Mixture<Checker, Anisotropic>, Checker>`.
        CheckerGrainedThreads(Framed<Mixture<Checker, Anisotropic>, Checker>),
        /// `Mixture<Rgb, Anisotropic>`.
        PlainGrained(Mixture<Rgb, Anisotropic>),
        /// `Framed<Mixture<Rgb, Anisotropic>, Checker>`.
        PlainGrainedThreads(Framed<Mixture<Rgb, Anisotropic>, Checker>),
    }
}

/// The materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn materials() -> Result<[Stuff; 4], Error> {
    Ok([
        // linen
        Stuff::CheckerGrainedThreads(Framed { material: Mixture::matt(Checker::squares([const { Real::lit("12") }, const { Real::lit("12") }], const { Rgb::new(Lumen::lit("0.87137"), Lumen::lit("0.80695"), Lumen::lit("0.63075")) }, const { Rgb::new(Lumen::lit("0.57758"), Lumen::lit("0.47932"), Lumen::lit("0.2789")) })).with_parts(const { Unit::lit("0.2") }, const { Unit::lit("0.65") })?.with_highlight(const { Rgb::new(Lumen::lit("0.26225"), Lumen::lit("0.23074"), Lumen::lit("0.16203")) }, Anisotropic::new(const { Unit::lit("0.12") }, const { Unit::lit("0.6") })?), grain: Checker::squares([const { Real::lit("96") }, const { Real::lit("96") }], Rgb::WHITE, Rgb::BLACK) }),
        // silk
        Stuff::PlainGrainedThreads(Framed { material: Mixture::matt(const { Rgb::new(Lumen::lit("0.16203"), Lumen::lit("0.00914"), Lumen::lit("0.03955")) }).with_parts(const { Unit::lit("0.12") }, const { Unit::lit("0.4") })?.with_highlight(const { Rgb::new(Lumen::lit("1"), Lumen::lit("0.2789"), Lumen::lit("0.43416")) }, Anisotropic::new(const { Unit::lit("0.16") }, const { Unit::lit("0.7") })?), grain: Checker::squares([const { Real::lit("24") }, const { Real::lit("12") }], Rgb::WHITE, Rgb::BLACK) }),
        // steel
        Stuff::PlainGrained(Mixture::matt(const { Rgb::new(Lumen::lit("0.16203"), Lumen::lit("0.17465"), Lumen::lit("0.18782")) }).with_parts(const { Unit::lit("0.08") }, const { Unit::lit("0.25") })?.with_highlight(const { Rgb::new(Lumen::lit("0.63075"), Lumen::lit("0.65837"), Lumen::lit("0.68669")) }, Anisotropic::new(const { Unit::lit("0.05") }, const { Unit::lit("0.5") })?)),
        // thread
        Stuff::PlainGrained(Mixture::matt(const { Rgb::new(Lumen::lit("0.01161"), Lumen::lit("0.07227"), Lumen::lit("0.26225")) }).with_parts(const { Unit::lit("0.15") }, const { Unit::lit("0.5") })?.with_highlight(const { Rgb::new(Lumen::lit("0.2789"), Lumen::lit("0.47932"), Lumen::lit("1")) }, Anisotropic::new(const { Unit::lit("0.7") }, const { Unit::lit("0.12") })?)),
    ])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves() -> Result<[Leaf<'static, Thing>; 4], Error> {
    Ok([
        // table
        Leaf { surface: Thing::Square(Placed::new(Square, &Affine3::scale(const { Vec3::lit("4", "4", "4") }))?), materials: &[0] },
        // cushion
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("1.05", "1.05", "0.55") }).then(&Affine3::translate(const { Vec3::lit("-1", "0.5", "0.55") })))?), materials: &[1] },
        // reel
        Leaf { surface: Thing::Torus(Placed::new(Torus::new(const { Near::lit("0.42") })?, &Affine3::scale(const { Vec3::lit("0.75", "0.75", "0.75") }).then(&Affine3::translate(const { Vec3::lit("1.15", "-0.5", "0.315") })))?), materials: &[3] },
        // tin
        Leaf { surface: Thing::TaperedCylinder(Placed::new(TaperedCylinder::new(const { Real::lit("1") })?, &Affine3::scale(const { Vec3::lit("0.55", "0.55", "1.1") }).then(&Affine3::translate(const { Vec3::lit("1.2", "1.5", "0") })))?), materials: &[2] },
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
        Lamp::distant(const { Vec3::lit("-3", "-2", "5") }, const { Rgb::new(Lumen::lit("0.95"), Lumen::lit("0.92"), Lumen::lit("0.88")) })?,
        // light 1
        Lamp::distant(const { Vec3::lit("4", "-3", "3") }, const { Rgb::new(Lumen::lit("0.25"), Lumen::lit("0.28"), Lumen::lit("0.38")) })?,
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
pub const EYE: Vec3 = Vec3::lit("-1.8", "-7.2", "4.4");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0", "0", "0.55");

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
pub const CONTRAST: Option<[u8; 2]> = Some([44, 215]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 9, 7, false>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.2789"), Lumen::lit("0.39157")) }, horizon: const { Rgb::new(Lumen::lit("0.7454"), Lumen::lit("0.7157"), Lumen::lit("0.68669")) }, nadir: const { Rgb::new(Lumen::lit("0.01445"), Lumen::lit("0.01161"), Lumen::lit("0.01161")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 3, seed }, Filter::Box)
}
