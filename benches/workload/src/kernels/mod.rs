//! Inner loops, counted by the unit of work.
//!
//! To add one: write its loops beside those of its room and add a line to [`ALL`]. A loop builds what it
//! needs and hands the work to [`Watch::time`], or to `Watch::over` for a table of inputs; only that is
//! counted. It returns a checksum of everything it computed (so that nothing is optimised away, and so that
//! host and target can be compared) and how many units of work it did.

mod backward;
mod codec;
mod curve;
mod deep;
mod escape;
mod fif;
mod filled;
mod filtered;
mod ifs;
mod lattice;
mod num;
mod patch;
mod picture;
mod shade;
mod shapes;
mod solid;
mod terrain;
mod texture;
mod trace;
mod watch;

use crate::machine::SMALL;

pub use watch::{Loop, Tally, Watch};

/// One row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Kernel {
    /// What is computed.
    pub name: &'static str,
    /// What is counted.
    pub unit: &'static str,
    /// The loop of core.
    pub fixed: Loop,
    /// The same in single precision.
    pub f32: Option<Loop>,
    /// The same in double precision.
    pub f64: Option<Loop>,
    /// Whether a machine with 16 KiB of RAM holds what it needs.
    pub small: bool,
}

/// A row with its floating-point rivals.
const fn beside(name: &'static str, unit: &'static str, fixed: Loop, f32: Loop, f64: Loop) -> Kernel {
    Kernel { name, unit, fixed, f32: Some(f32), f64: Some(f64), small: true }
}

/// A row without.
const fn alone(name: &'static str, unit: &'static str, fixed: Loop) -> Kernel {
    Kernel { name, unit, fixed, f32: None, f64: None, small: true }
}

/// The same, for machines with room.
const fn roomy(kernel: Kernel) -> Kernel {
    Kernel { small: false, ..kernel }
}

/// The table; in an image for Armv6-M the rows that it can run. The first row is the floor: what the loop,
/// its loads and its checksum cost alone.
pub static ALL: &[Kernel] = &{
    let mut all = [TABLE[0]; count()];
    let (mut i, mut kept) = (0, 0);
    while kept < all.len() {
        if fits(i) {
            all[kept] = TABLE[i];
            kept += 1;
        }
        i += 1;
    }
    all
};

const fn fits(i: usize) -> bool {
    TABLE[i].small || !SMALL
}

const fn count() -> usize {
    let (mut i, mut kept) = (0, 0);
    while i < TABLE.len() {
        kept += fits(i) as usize;
        i += 1;
    }
    kept
}

#[rustfmt::skip]
const TABLE: &[Kernel] = &[
    beside("identity", "call", num::identity_fixed, num::identity_f32, num::identity_f64),
    beside("reciprocal", "call", num::reciprocal_fixed, num::reciprocal_f32, num::reciprocal_f64),
    beside("reciprocal_sqrt", "call", num::reciprocal_sqrt_fixed, num::reciprocal_sqrt_f32, num::reciprocal_sqrt_f64),
    beside("sqrt", "call", num::sqrt_fixed, num::sqrt_f32, num::sqrt_f64),
    beside("sin_cos", "call", num::sin_cos_fixed, num::sin_cos_f32, num::sin_cos_f64),
    beside("atan2", "call", num::atan2_fixed, num::atan2_f32, num::atan2_f64),
    beside("log2", "call", num::log2_fixed, num::log2_f32, num::log2_f64),
    beside("exp_minus", "call", num::exp_minus_fixed, num::exp_minus_f32, num::exp_minus_f64),
    beside("dwell fine", "iteration", escape::fine, escape::plain_f32, escape::plain_f64),
    beside("dwell coarse", "iteration", escape::coarse, escape::plain_f32, escape::plain_f64),
    roomy(alone("RP2040 frame", "frame of 640x480 at 1000", escape::rp2040)),
    Kernel { f32: None, ..beside("dwell 64", "iteration", deep::word64, escape::plain_f32, escape::plain_f64) },
    alone("dwell 128", "iteration", deep::word128),
    roomy(alone("perturbed", "step", deep::perturbed)),
    roomy(alone("perturbed long", "step in 62 bits", deep::perturbed_long)),
    roomy(alone("perturbed jumping", "iteration at 1e-100", deep::jumping)),
    roomy(alone("reference orbit", "point in 12 limbs", deep::reference)),
    roomy(alone("plain home", "pixel at 1000", filled::home::<false>)),
    roomy(alone("filled home", "pixel at 1000", filled::home::<true>)),
    roomy(alone("plain seahorses", "pixel at 1000", filled::seahorses::<false>)),
    roomy(alone("filled seahorses", "pixel at 1000", filled::seahorses::<true>)),
    roomy(alone("plain rabbit", "pixel at 1000", filled::rabbit::<false>)),
    roomy(alone("filled rabbit", "pixel at 1000", filled::rabbit::<true>)),
    roomy(alone("plain copy 64", "pixel at 1000", filled::word64::<false>)),
    roomy(alone("filled copy 64", "pixel at 1000", filled::word64::<true>)),
    roomy(alone("plain copy 1e-101", "pixel at 1000", filled::perturbed::<false>)),
    roomy(alone("filled copy 1e-101", "pixel at 1000", filled::perturbed::<true>)),
    roomy(alone("patch tensor 3 x 3", "point at 12 digits", patch::tensor_3)),
    roomy(alone("patch tensor 4 x 4", "point at 12 digits", patch::tensor_4)),
    roomy(alone("patch general", "point at 12 digits", patch::general)),
    roomy(alone("patch lattice", "point at 12 digits", patch::lattice)),
    alone("dwell of a pixel", "pixel of the home view", deep::dwell),
    alone("fractional dwell", "pixel of the home view", deep::smooth),
    alone("distance estimate", "pixel of the home view", deep::distance),
    alone("period", "pixel of the home view", deep::period),
    beside("chaos game", "point", ifs::fern_fixed, ifs::fern_f32, ifs::fern_f64),
    beside("density u16", "point", ifs::density_u16, ifs::density_f32, ifs::density_f64),
    beside("density u8", "point", ifs::density_u8, ifs::density_f32, ifs::density_f64),
    roomy(alone("density with maps", "point", ifs::density_with_maps)),
    alone("ifs", "fern set up", ifs::system),
    alone("bounds", "fern", ifs::bounds),
    roomy(alone("moments", "fern", ifs::moments)),
    beside("copied point", "image of one point", ifs::copied_point, ifs::copied_f32, ifs::copied_f64),
    alone("copied path", "point of an image of four", ifs::copied_path),
    beside("koch", "vertex of order 6", curve::koch_fixed, curve::koch_f32, curve::koch_f64),
    alone("gosper", "vertex of order 4", curve::gosper),
    alone("dragon", "vertex of order 11", curve::dragon),
    alone("turtle", "point of a plant of order 4", curve::turtle),
    beside("elbow", "point", curve::elbow, curve::elbow_f32, curve::elbow_f64),
    beside("elbow by length", "point", curve::elbow_by_length, curve::elbow_by_length_f32, curve::elbow_by_length_f64),
    alone("line to line", "point", curve::line_to_line),
    alone("one variable", "point", curve::one_variable),
    alone("two variable", "point", curve::two_variable),
    alone("elbow law", "set up", curve::elbow_law),
    alone("offset of a ratio", "call", curve::offset_of_ratio),
    alone("deviate", "call", curve::deviate),
    beside("backward", "point", backward::plain, backward::plain_f32, backward::plain_f64),
    alone("julia cover", "pixel of 64x64", backward::cover),
    beside("complex sqrt", "call", backward::root, backward::root_f32, backward::root_f64),
    beside("fif dyadic", "call of 24 levels", fif::dyadic, fif::dyadic_f32, fif::dyadic_f64),
    beside("fif dyadic level", "level", fif::dyadic_level, fif::dyadic_level_f32, fif::dyadic_level_f64),
    beside("fif compiled", "call of 24 levels", fif::compiled, fif::any_f32, fif::any_f64),
    beside("fif compiled level", "level", fif::compiled_level, fif::any_level_f32, fif::any_level_f64),
    beside("fif", "call at any abscissa", fif::any, fif::any_f32, fif::any_f64),
    beside("fif level", "level", fif::any_level, fif::any_level_f32, fif::any_level_f64),
    alone("fif integrate", "function of 2 maps", fif::integrate),
    beside("fif integral", "call of 24 levels", fif::integral, fif::integral_f32, fif::integral_f64),
    beside("fif chaos game", "point", fif::game, fif::game_f32, fif::game_f64),
    roomy(beside("ray", "ray that hits or misses", trace::rays, trace::rays_float::<f32>, trace::rays_float::<f64>)),
    roomy(beside("box test", "box", trace::box_fixed, trace::box_float::<f32>, trace::box_float::<f64>)),
    roomy(beside("walk", "ray to the ground", trace::walks, trace::walks_float::<f32>, trace::walks_float::<f64>)),
    roomy(beside("normal", "unit normal of a hit", shade::normals, shade::normals_float::<f32>, shade::normals_float::<f64>)),
    roomy(beside("shade mirror", "call", shade::mirror, shade::mirror_float::<f32>, shade::mirror_float::<f64>)),
    roomy(beside("shade phong", "call", shade::phong, shade::phong_float::<f32>, shade::phong_float::<f64>)),
    roomy(beside("phong rgb", "call, one light", shade::phong_rgb, shade::phong_rgb_float::<f32>, shade::phong_rgb_float::<f64>)),
    roomy(beside("refraction", "call", shade::refraction, shade::refraction_float::<f32>, shade::refraction_float::<f64>)),
    roomy(alone("torrance sparrow", "light", shade::torrance_sparrow)),
    roomy(alone("tabulated", "light, by 32 x 32 slopes", shade::tabulated)),
    roomy(alone("plain diffuse", "pixel of G x G", filtered::plain_diffuse)),
    roomy(alone("filtered diffuse, coarse", "pixel of G x G", filtered::diffuse_coarse)),
    roomy(alone("filtered diffuse, fine", "pixel of G x G", filtered::diffuse_fine)),
    roomy(alone("plain highlight", "pixel of G x G", filtered::plain_highlight)),
    roomy(alone("filtered highlight, fine", "pixel of G x G", filtered::highlight_fine)),
    roomy(alone("filtered highlight, finest", "pixel of G x G", filtered::highlight_finest)),
    roomy(alone("plain highlight of exponent 8", "pixel of G x G", filtered::plain_highlight_8)),
    roomy(alone("filtered highlight of exponent 8, fine", "pixel of G x G", filtered::highlight_8_fine)),
    roomy(alone("plain mirror", "pixel of G x G", filtered::plain_mirror)),
    roomy(alone("filtered mirror, fine", "pixel of G x G", filtered::mirror_fine)),
    roomy(alone("slopes of a lattice", "cell", lattice::slopes)),
    roomy(alone("moments of a lattice", "mask", lattice::moments)),
    roomy(alone("lattice mirror", "pixel of a cone", lattice::mirror)),
    roomy(alone("filtered lattice mirror, coarse", "pixel of a cone", lattice::mirror_coarse)),
    roomy(alone("filtered lattice mirror, fine", "pixel of a cone", lattice::mirror_fine)),
    beside("noise", "value", texture::noise_fixed, texture::noise_float::<f32>, texture::noise_float::<f64>),
    beside("turbulence", "octave of four", texture::turbulence_fixed, texture::turbulence_float::<f32>, texture::turbulence_float::<f64>),
    roomy(beside("sphere", "ray, both crossings", shapes::sphere, shapes::sphere_float::<f32>, shapes::sphere_float::<f64>)),
    roomy(beside("square", "ray", shapes::square, shapes::square_float::<f32>, shapes::square_float::<f64>)),
    roomy(beside("cube", "ray, both crossings and faces", shapes::cube, shapes::cube_float::<f32>, shapes::cube_float::<f64>)),
    roomy(beside("tapered cylinder", "ray, both crossings and faces", shapes::tapered, shapes::tapered_float::<f32>, shapes::tapered_float::<f64>)),
    roomy(beside("affine map of a ray", "ray", shapes::affine, shapes::affine_float::<f32>, shapes::affine_float::<f64>)),
    roomy(beside("approach", "ray brought near; floats: mapped", shapes::reached, shapes::reached_float::<f32>, shapes::reached_float::<f64>)),
    roomy(beside("passing by", "ray, of which most pass; floats: mapped", shapes::passing, shapes::passing_float::<f32>, shapes::passing_float::<f64>)),
    roomy(beside("torus", "ray, all crossings", solid::torus, solid::torus_float::<f32>, solid::torus_float::<f64>)),
    roomy(beside("superellipsoid", "ray, first crossing", solid::superellipsoid, solid::superellipsoid_float::<f32>, solid::superellipsoid_float::<f64>)),
    roomy(alone("star", "ray, first crossing; exponents below 1", solid::star)),
    roomy(alone("decode streaming", "pixel of 240x240, 0.27 bits each", codec::streaming)),
    roomy(alone("decode sweeps", "pixel of 240x240, 0.27 bits each, a stream for two sweeps", codec::two_sweeps)),
    roomy(alone("decode four sweeps", "pixel of 240x240, 0.27 bits each", codec::four_sweeps)),
    alone("terrain height", "height at level 12", terrain::height),
    alone("terrain row", "height of 65 x 65", terrain::row),
    roomy(alone("terrain ray", "ray, first crossing, 64 x 64 cells", terrain::ray)),
    roomy(alone("terrain ray alone", "ray, first crossing, by bounds alone", terrain::ray_alone)),
    roomy(beside("mirror picture", "pixel; floats: the paper's way", picture::core, picture::paper::<f32>, picture::paper::<f64>)),
];
