//! Figure 7, left: a mirroring fractal surface fills the corner of a room, one sample a pixel.
//!
//! Written by `attractor export --gallery figure-7`.

use attractor::Error;
use attractor::fif::{Fif, Knot, Pyramid};
use attractor::num::{Affine3, Angle, Lumen, Near, Real, Rgb, Scaling, Unit, Vec3, Wide};
use attractor::trace::material::{Mixture, Phong, TorranceSparrow};
use attractor::trace::solid::{Moved, Placed, Polygon, Sphere, Torus};
use attractor::trace::texture::Checker;
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, HeightField, Sampling};
use embedded_graphics::geometry::Size;

attractor::surfaces! {
    /// What stands in it.
    #[derive(Debug, Clone, Copy)]
    pub enum Thing<'a> {
        /// `Moved<HeightField<'a>>`.
        HeightField(Moved<HeightField<'a>>),
        /// `Placed<Polygon<16>>`.
        Polygon(Placed<Polygon<16>>),
        /// `Placed<Sphere>`.
        Sphere(Placed<Sphere>),
        /// `Placed<Torus>`.
        Torus(Placed<Torus>),
    }
}

attractor::materials! {
    /// What things are made of.
    #[derive(Debug, Clone, Copy)]
    pub enum Stuff {
        /// `Mixture<Checker>`.
        Checker(Mixture<Checker>),
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
pub fn materials() -> Result<[Stuff; 6], Error> {
    Ok([
        // blue wall
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.2789"), Lumen::lit("0.43416"), Lumen::lit("0.7454")) }).with_parts(const { Unit::lit("0.18") }, const { Unit::lit("0.8") })?),
        // gold
        Stuff::PlainRough(Mixture::matt(const { Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.35153"), Lumen::lit("0.02122")) }).with_parts(const { Unit::lit("0.12") }, const { Unit::lit("0.5") })?.with_highlight(const { Rgb::new(Lumen::lit("1"), Lumen::lit("0.87137"), Lumen::lit("0.52711")) }, TorranceSparrow::new(const { Unit::lit("0.2") }, const { Unit::lit("1") })?).with_reflection(const { Rgb::new(Lumen::lit("0.2"), Lumen::lit("0.15"), Lumen::lit("0.05")) })),
        // green
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.02956"), Lumen::lit("0.2789"), Lumen::lit("0.08022")) }).with_parts(const { Unit::lit("0.15") }, const { Unit::lit("0.75") })?.with_highlight(const { Rgb::new(Lumen::lit("0.35153"), Lumen::lit("0.35153"), Lumen::lit("0.35153")) }, Phong { shininess: 60 })),
        // mirror
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.52711"), Lumen::lit("0.57758"), Lumen::lit("0.63075")) }).with_parts(const { Unit::lit("0.05") }, const { Unit::lit("0.25") })?.with_highlight(const { Rgb::new(Lumen::lit("0.21587"), Lumen::lit("0.21587"), Lumen::lit("0.21587")) }, Phong { shininess: 40 }).with_reflection(const { Rgb::new(Lumen::lit("0.7"), Lumen::lit("0.7"), Lumen::lit("0.7")) })),
        // red wall
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.7454"), Lumen::lit("0.2789"), Lumen::lit("0.16203")) }).with_parts(const { Unit::lit("0.18") }, const { Unit::lit("0.8") })?),
        // tiles
        Stuff::Checker(Mixture::matt(Checker::cubes([const { Real::lit("16") }, const { Real::lit("16") }, const { Real::lit("1") }], const { Rgb::new(Lumen::lit("0.68669"), Lumen::lit("0.63075"), Lumen::lit("0.52711")) }, const { Rgb::new(Lumen::lit("0.0648"), Lumen::lit("0.0578"), Lumen::lit("0.05127")) })).with_parts(const { Unit::lit("0.15") }, const { Unit::lit("0.75") })?),
    ])
}

/// Where the graph passes.
#[rustfmt::skip]
pub static PROFILE_0_KNOTS: [Knot; 3] = [
    Knot::lit("0", "0"),
    Knot::lit("1", "1"),
    Knot::lit("2", "0"),
];

/// One for each interval.
#[rustfmt::skip]
pub static PROFILE_0_VERTICAL_SCALINGS: [Scaling; 2] = [
    Scaling::lit("0.85"),
    Scaling::lit("-0.85"),
];

/// Its maps: the least `N`.
pub const PROFILE_0_MAPS: usize = 2;

/// The degree of their polynomials: the least `D`.
pub const PROFILE_0_DEGREE: usize = 2;

/// The integral of the function through the knots.
///
/// # Errors
/// [`Error::Capacity`] where `N` or `D` is too small.
pub fn profile_0<const N: usize, const D: usize>() -> Result<Fif<N, D>, Error> {
    let f = Fif::<N, D>::interpolating(&PROFILE_0_KNOTS, &PROFILE_0_VERTICAL_SCALINGS)?;
    f.integral::<D>(Wide::ZERO)
}

/// The height fields, by a pyramid of each profile:
/// on 240 pixels a side, 511 cells of profile 0, 8 deep.
///
/// # Errors
/// Those of [`HeightField::new`].
#[rustfmt::skip]
pub fn fields<'a>(pyramids: &[Pyramid<'a>; 1]) -> Result<[HeightField<'a>; 1], Error> {
    Ok([HeightField::new(&pyramids[0], &pyramids[0])?])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves<'a>(fields: &[HeightField<'a>; 1]) -> Result<[Leaf<'a, Thing<'a>>; 6], Error> {
    Ok([
        // floor
        Leaf { surface: Thing::Polygon(Placed::new(Polygon::new(&const { [Vec3::lit("0", "0", "0"), Vec3::lit("1", "0", "0"), Vec3::lit("1", "1", "0"), Vec3::lit("0", "1", "0")] })?, &Affine3::scale(const { Vec3::lit("8", "8", "1") }))?), materials: &[5] },
        // left wall
        Leaf { surface: Thing::Polygon(Placed::new(Polygon::new(&const { [Vec3::lit("0", "0", "0"), Vec3::lit("0", "1", "0"), Vec3::lit("0", "1", "1"), Vec3::lit("0", "0", "1")] })?, &Affine3::scale(const { Vec3::lit("1", "8", "4") }))?), materials: &[4] },
        // right wall
        Leaf { surface: Thing::Polygon(Placed::new(Polygon::new(&const { [Vec3::lit("0", "0", "0"), Vec3::lit("0", "0", "1"), Vec3::lit("1", "0", "1"), Vec3::lit("1", "0", "0")] })?, &Affine3::scale(const { Vec3::lit("8", "1", "4") }))?), materials: &[0] },
        // fractal
        Leaf { surface: Thing::HeightField(Moved::new(fields[0], &Affine3::scale(const { Vec3::lit("1.2", "1.2", "1.7") }).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.5") })?).then(&Affine3::translate(const { Vec3::lit("2.4", "2.4", "0.02") })))?), materials: &[3] },
        // ring
        Leaf { surface: Thing::Torus(Placed::new(Torus::new(const { Near::lit("0.3") })?, &Affine3::scale(const { Vec3::lit("0.42", "0.42", "0.42") }).then(&Affine3::rotate(const { Vec3::lit("1", "0", "0") }, const { Angle::lit("0.1722222222") })?).then(&Affine3::rotate(const { Vec3::lit("0", "0", "1") }, const { Angle::lit("0.111111111") })?).then(&Affine3::translate(const { Vec3::lit("2.75", "0.95", "0.5") })))?), materials: &[1] },
        // ball
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::scale(const { Vec3::lit("0.42", "0.42", "0.42") }).then(&Affine3::translate(const { Vec3::lit("0.85", "2.9", "0.42") })))?), materials: &[2] },
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
        Lamp::point(const { Vec3::lit("2.6", "3.4", "3.7") }, const { Rgb::new(Lumen::lit("1.25"), Lumen::lit("1.2"), Lumen::lit("1.1")) }),
        // light 1
        Lamp::point(const { Vec3::lit("4.5", "1", "3") }, const { Rgb::new(Lumen::lit("0.3"), Lumen::lit("0.32"), Lumen::lit("0.4")) }),
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
    leaves: &[Leaf<'_, Thing<'_>>],
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
pub const EYE: Vec3 = Vec3::lit("5.6", "6.2", "3.6");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0.9", "1", "0.85");

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
pub type Whole<'a> = World<'a, Thing<'a>, Stuff, false>;

/// The world of these parts.
///
/// # Errors
/// None: the command has built it.
pub fn world<'a>(
    leaves: &'a [Leaf<'a, Thing<'a>>],
    objects: &'a [Object<'a>],
    materials: &'a [Stuff],
    lamps: &'a [Lamp],
) -> Result<Whole<'a>, Error> {
    Ok(World::of_leaves(leaves, objects, materials)?.with_lamps(lamps))
}

/// The greys that a display of 16 levels or fewer shows as black and as white: for `draw::Contrast`.
pub const CONTRAST: Option<[u8; 2]> = Some([112, 215]);

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing<'a>, Stuff, Rgb, 17, 6, false>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let _ = seed;
    let caster = Caster::new(world, const { Rgb::new(Lumen::lit("0.05"), Lumen::lit("0.06"), Lumen::lit("0.08")) }, camera()?, size)?;
    caster.with_sampling(Sampling::Centre, Filter::Box)
}
