//! Two spheres: the left one shines as the surface G x G leans, the right one by Phong.
//!
//! Written by `attractor export --gallery brdf-spheres`.

use attractor::Error;
use attractor::num::{Affine3, Angle, Lumen, Real, Rgb, Unit, Vec3};
use attractor::trace::material::{Mixture, Phong, Tabulated};
use attractor::trace::solid::{Placed, Plane, Sphere};
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
        /// `Mixture<Rgb, Tabulated<'static>>`.
        PlainTabulated(Mixture<Rgb, Tabulated<'static>>),
    }
}

/// A table of slopes: version, side, reach in 256ths, weights.
#[rustfmt::skip]
pub static SLOPES_0: [u16; 1027] = [
    1, 32, 512,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3,
    27, 61, 130, 104, 33, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 11, 58,
    231, 660, 1339, 932, 291, 42, 6, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 2, 6, 15, 21, 32, 72, 165, 369,
    836, 2034, 4335, 2822, 918, 228, 55, 8, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 12, 70, 158, 298, 372, 507, 690, 940, 1314,
    2162, 4186, 8600, 5306, 1851, 635, 198, 39, 1, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 2, 70, 301, 635, 1084, 1278, 1696, 2187, 2774, 3209,
    4357, 7003, 14157, 8131, 3127, 1370, 570, 207, 39, 8, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 6, 158, 635, 1338, 2254, 2622, 3445, 4375, 5329, 5684,
    6917, 9692, 18881, 10479, 4543, 2292, 1124, 570, 198, 55, 6, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 15, 298, 1084, 2254, 3778, 4348, 5610, 7091, 8512, 9106,
    10787, 14164, 25812, 13887, 6763, 3918, 2292, 1370, 635, 228, 42, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 21, 372, 1278, 2622, 4348, 5118, 6608, 8619, 10595, 12196,
    15125, 19638, 32876, 17500, 10018, 6763, 4543, 3127, 1851, 918, 291, 33, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 32, 507, 1696, 3445, 5610, 6608, 8622, 11281, 13776, 15790,
    20250, 27095, 44663, 26106, 17500, 13887, 10479, 8131, 5306, 2822, 932, 104, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 2, 72, 690, 2187, 4375, 7091, 8619, 11281, 24400, 26935, 30344,
    39016, 47863, 65535, 44663, 32876, 25812, 18881, 14157, 8600, 4335, 1339, 130, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 11, 165, 940, 2774, 5329, 8512, 10595, 13776, 26935, 29599, 31522,
    35753, 38755, 47863, 27095, 19638, 14164, 9692, 7003, 4186, 2034, 660, 61, 0, 0, 0, 0,
    0, 0, 0, 0, 3, 58, 369, 1314, 3209, 5684, 9106, 12196, 15790, 30344, 31522, 33198,
    34376, 35753, 39016, 20250, 15125, 10787, 6917, 4357, 2162, 836, 231, 27, 0, 0, 0, 0,
    0, 0, 0, 0, 27, 231, 836, 2162, 4357, 6917, 10787, 15125, 20250, 39016, 35753, 34376,
    33198, 31522, 30344, 15790, 12196, 9106, 5684, 3209, 1314, 369, 58, 3, 0, 0, 0, 0,
    0, 0, 0, 0, 61, 660, 2034, 4186, 7003, 9692, 14164, 19638, 27095, 47863, 38755, 35753,
    31522, 29599, 26935, 13776, 10595, 8512, 5329, 2774, 940, 165, 11, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 130, 1339, 4335, 8600, 14157, 18881, 25812, 32876, 44663, 65535, 47863, 39016,
    30344, 26935, 24400, 11281, 8619, 7091, 4375, 2187, 690, 72, 2, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 104, 932, 2822, 5306, 8131, 10479, 13887, 17500, 26106, 44663, 27095, 20250,
    15790, 13776, 11281, 8622, 6608, 5610, 3445, 1696, 507, 32, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 33, 291, 918, 1851, 3127, 4543, 6763, 10018, 17500, 32876, 19638, 15125,
    12196, 10595, 8619, 6608, 5118, 4348, 2622, 1278, 372, 21, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 42, 228, 635, 1370, 2292, 3918, 6763, 13887, 25812, 14164, 10787,
    9106, 8512, 7091, 5610, 4348, 3778, 2254, 1084, 298, 15, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 6, 55, 198, 570, 1124, 2292, 4543, 10479, 18881, 9692, 6917,
    5684, 5329, 4375, 3445, 2622, 2254, 1338, 635, 158, 6, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 8, 39, 207, 570, 1370, 3127, 8131, 14157, 7003, 4357,
    3209, 2774, 2187, 1696, 1278, 1084, 635, 301, 70, 2, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 1, 39, 198, 635, 1851, 5306, 8600, 4186, 2162,
    1314, 940, 690, 507, 372, 298, 158, 70, 12, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 8, 55, 228, 918, 2822, 4335, 2034, 836,
    369, 165, 72, 32, 21, 15, 6, 2, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 6, 42, 291, 932, 1339, 660, 231,
    58, 11, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 33, 104, 130, 61, 27,
    3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
];

/// The materials.
///
/// # Errors
/// None: the command has built them.
#[rustfmt::skip]
pub fn materials() -> Result<[Stuff; 3], Error> {
    Ok([
        // fractal
        Stuff::PlainTabulated(Mixture::matt(const { Rgb::new(Lumen::lit("0.08022"), Lumen::lit("0.01161"), Lumen::lit("0.00699")) }).with_parts(const { Unit::lit("0.3") }, const { Unit::lit("0.5") })?.with_highlight(const { Rgb::new(Lumen::lit("1"), Lumen::lit("0.82"), Lumen::lit("0.52")) }, Tabulated::new(&SLOPES_0, const { Unit::lit("1") })?)),
        // plain
        Stuff::PlainPhong(Mixture::matt(const { Rgb::new(Lumen::lit("0.08022"), Lumen::lit("0.01161"), Lumen::lit("0.00699")) }).with_parts(const { Unit::lit("0.3") }, const { Unit::lit("0.5") })?.with_highlight(const { Rgb::new(Lumen::lit("1"), Lumen::lit("0.82"), Lumen::lit("0.52")) }, Phong { shininess: 24 })),
        // table
        Stuff::Plain(Mixture::matt(const { Rgb::new(Lumen::lit("0.03955"), Lumen::lit("0.03189"), Lumen::lit("0.02519")) }).with_parts(const { Unit::lit("0.25") }, const { Unit::lit("0.75") })?),
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
        Leaf { surface: Thing::Plane(Placed::new(Plane, &Affine3::IDENTITY)?), materials: &[2] },
        // fractal
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::rotate(const { Vec3::lit("1", "0", "0") }, const { Angle::lit("0.95") })?.then(&Affine3::translate(const { Vec3::lit("-1.1", "0", "1") })))?), materials: &[0] },
        // plain
        Leaf { surface: Thing::Sphere(Placed::new(Sphere, &Affine3::translate(const { Vec3::lit("1.1", "0", "1") }))?), materials: &[1] },
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
        Lamp::distant(const { Vec3::lit("-3", "-4", "5") }, const { Rgb::new(Lumen::lit("1"), Lumen::lit("0.95"), Lumen::lit("0.86")) })?,
        // light 1
        Lamp::distant(const { Vec3::lit("4", "-6", "3") }, const { Rgb::new(Lumen::lit("0.3"), Lumen::lit("0.36"), Lumen::lit("0.5")) })?,
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
pub const EYE: Vec3 = Vec3::lit("0", "-6.4", "2.6");

/// What it looks at.
pub const LOOK_AT: Vec3 = Vec3::lit("0", "0", "0.85");

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

/// The picture of the world.
pub type Caster<'a> = WorldCaster<'a, Thing, Stuff, Sky, 5, 7>;

/// The picture of the world; the command's seed is 1.
///
/// # Errors
/// Those of [`WorldCaster::new`].
#[rustfmt::skip]
pub fn caster<'a>(world: World<'a, Thing, Stuff>, size: Size, seed: u32) -> Result<Caster<'a>, Error> {
    let caster = Caster::new(world, Sky { zenith: const { Rgb::new(Lumen::lit("0.02956"), Lumen::lit("0.0648"), Lumen::lit("0.16203")) }, horizon: const { Rgb::new(Lumen::lit("0.57758"), Lumen::lit("0.60382"), Lumen::lit("0.68669")) }, nadir: const { Rgb::new(Lumen::lit("0.02122"), Lumen::lit("0.01764"), Lumen::lit("0.01445")) } }, camera()?, size)?;
    caster.with_sampling(Sampling::Jittered { n: 3, seed }, Filter::Box)
}
