//! What borrows: a polyhedron and a height field of two profiles.
//!
//! Written by `attractor export corner`.

use attractor::Error;
use attractor::fif::{Fif, Knot, Pyramid};
use attractor::num::{Affine3, Lumen, Real, Rgb, Scaling, Unit, Vec3, Wide};
use attractor::trace::material::Mixture;
use attractor::trace::solid::{HalfSpace, Moved, Placed, Polyhedron};
use attractor::trace::texture::{Checker, Pasted};
use attractor::trace::world::{Lamp, Leaf, Object, Op, World, WorldCaster};
use attractor::trace::{Camera, Extent, Filter, HeightField, Sampling, Sky};
use embedded_graphics::geometry::Size;

attractor::surfaces! {
    /// What stands in it.
    #[derive(Debug, Clone, Copy)]
    pub enum Thing<'a> {
        /// `Moved<HeightField<'a>>`.
        HeightField(Moved<HeightField<'a>>),
        /// `Placed<Polyhedron<'a>>`.
        Polyhedron(Placed<Polyhedron<'a>>),
    }
}

attractor::materials! {
    /// What things are made of.
    #[derive(Debug, Clone, Copy)]
    pub enum Stuff {
        /// `Mixture`.
        Plain(Mixture),
        /// `Mixture<Pasted<'static, Checker, Rgb>>`.
        PlainOnChecker(Mixture<Pasted<'static, Checker, Rgb>>),
    }
}

/// The materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn materials() -> Result<[Stuff; 2], Error> {
    Ok([
        // flag
        Stuff::PlainOnChecker(Mixture::matt(Pasted::new(Checker::squares([const { Real::lit("8") }, const { Real::lit("8") }], Rgb::WHITE, Rgb::BLACK), &const { [[Real::lit("0.25"), Real::lit("0.25")], [Real::lit("0.75"), Real::lit("0.25")], [Real::lit("0.5"), Real::lit("0.75")]] }, const { Rgb::new(Lumen::lit("0.52711"), Lumen::lit("0.01445"), Lumen::lit("0.01445")) })?).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?),
        // plain
        Stuff::Plain(Mixture::matt(Rgb::WHITE).with_parts(const { Unit::lit("0.125") }, const { Unit::lit("0.875") })?),
    ])
}

/// The half-spaces of the polyhedra.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn half_spaces() -> Result<[HalfSpace; 4], Error> {
    Ok([
        // wedge
        HalfSpace::new(const { Vec3::new(Wide::lit("-1"), Wide::lit("0"), Wide::lit("0")) }, const { Wide::lit("0.5") })?,
        // wedge
        HalfSpace::new(const { Vec3::new(Wide::lit("0"), Wide::lit("-1"), Wide::lit("0")) }, const { Wide::lit("0.3") })?,
        // wedge
        HalfSpace::new(const { Vec3::new(Wide::lit("0"), Wide::lit("0"), Wide::lit("-1")) }, const { Wide::lit("0") })?,
        // wedge
        HalfSpace::new(const { Vec3::new(Wide::lit("1"), Wide::lit("1"), Wide::lit("1")) }, const { Wide::lit("0.7") })?,
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
    Scaling::lit("0.5"),
    Scaling::lit("-0.5"),
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

/// Where the graph passes.
#[rustfmt::skip]
pub static PROFILE_1_KNOTS: [Knot; 3] = [
    Knot::lit("0", "0.5"),
    Knot::lit("0.5", "1"),
    Knot::lit("1", "0.25"),
];

/// One for each interval.
#[rustfmt::skip]
pub static PROFILE_1_VERTICAL_SCALINGS: [Scaling; 2] = [
    Scaling::lit("0.25"),
    Scaling::lit("0.5"),
];

/// Its maps: the least `N`.
pub const PROFILE_1_MAPS: usize = 2;

/// The degree of their polynomials: the least `D`.
pub const PROFILE_1_DEGREE: usize = 1;

/// The function.
///
/// # Errors
/// [`Error::Capacity`] where `N` or `D` is too small.
pub fn profile_1<const N: usize, const D: usize>() -> Result<Fif<N, D>, Error> {
    Fif::<N, D>::interpolating(&PROFILE_1_KNOTS, &PROFILE_1_VERTICAL_SCALINGS)
}

/// The height fields, by a pyramid of each profile:
/// on 240 pixels a side, 511 cells of profile 0, 8 deep, 511 cells of profile 1, 8 deep.
///
/// # Errors
/// Those of [`HeightField::new`].
#[rustfmt::skip]
pub fn fields<'a>(pyramids: &[Pyramid<'a>; 2]) -> Result<[HeightField<'a>; 1], Error> {
    Ok([HeightField::new(&pyramids[0], &pyramids[1])?])
}

/// The shapes, each with the numbers of its materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn leaves<'a>(half_spaces: &'a [HalfSpace; 4], fields: &[HeightField<'a>; 1]) -> Result<[Leaf<'a, Thing<'a>>; 2], Error> {
    Ok([
        // hills
        Leaf { surface: Thing::HeightField(Moved::new(fields[0], &Affine3::IDENTITY)?), materials: &[0] },
        // wedge
        Leaf { surface: Thing::Polyhedron(Placed::new(Polyhedron::new(&half_spaces[0..4])?, &Affine3::translate(const { Vec3::lit("-1", "0", "0.2") }))?), materials: &[1] },
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
        Lamp::distant(const { Vec3::lit("-2", "-3", "5") }, Rgb::WHITE)?,
    ])
}

/// Of which shapes each object is made, in reverse Polish.
#[rustfmt::skip]
pub static PROGRAMS: [&[Op]; 2] = [
    &[Op::Leaf(0)],
    &[Op::Leaf(1)],
];

/// How many boxes the objects borrow.
pub const BOXES: usize = 2;

/// The objects.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn objects<'a>(
    leaves: &[Leaf<'_, Thing<'_>>],
    boxes: &'a mut [Extent; BOXES],
) -> Result<[Object<'a>; 2], Error> {
    let surface = |leaf: usize| leaves.get(leaf).map(|leaf| &leaf.surface);
    let (one_0, boxes) = boxes.split_at_mut(1);
    let (one_1, _) = boxes.split_at_mut(1);
    Ok([
        Object::new(PROGRAMS[0], surface, one_0)?,
        Object::new(PROGRAMS[1], surface, one_1)?,
    ])
}

/// Where the camera stands.
pub const EYE: Vec3 = Vec3::lit("-4", "-3", "4");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0.5", "0.5", "0.3");

/// Which way is up.
pub const UP: Vec3 = Vec3::lit("0", "0", "1");

/// Vertical, in degrees.
pub const FIELD_OF_VIEW: Real = Real::lit("40");

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
pub const CONTRAST: Option<[u8; 2]> = None;

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing<'a>, Stuff, Sky, 10, 7, false>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: Whole<'a>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let _ = seed;
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.13733"), Lumen::lit("0.30518"), Lumen::lit("0.7019")) }, horizon: const { Rgb::new(Lumen::lit("0.68665"), Lumen::lit("0.79346"), Lumen::lit("0.91553")) }, nadir: const { Rgb::new(Lumen::lit("0.12207"), Lumen::lit("0.10681"), Lumen::lit("0.09155")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Centre, Filter::Box)
}
