//! The built-in scenes of the command `attractor`: a table that pairs the numbers of each, as
//! `attractor export` writes them, with what draws its kind.
//!
//! `tests/built_in.rs` holds each to the picture of that name, pixel for pixel: to the checksums of
//! `host-sim/tests/goldens.txt`.

#[macro_use]
mod rows;
mod escape;
mod fif;
mod image;
mod patches;
mod paths;
mod seed;
mod sets;
mod terrain;
mod worlds;

use attractor::curve::catalogue::LARGEST;
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565};

use seed::SEED;

use crate::exported as of;
use crate::scene::{COLOUR, MONO, Scene, colour, mono, roomy};

/// Even the picture in black and white takes more than 16 KiB, or a path of its own that the flash of the
/// Cortex-M0 image has no room for.
const fn both_roomy([colour, mono]: [Scene; 2]) -> [Scene; 2] {
    [colour, roomy(mono)]
}

/// Even the picture in colour takes no room.
const fn both_small([colour, mono]: [Scene; 2]) -> [Scene; 2] {
    [Scene { small: true, ..colour }, mono]
}

/// The table.
pub(crate) const PAIRS: &[[Scene; 2]] = &[
    both_small(view!("mandelbrot", mandelbrot)),
    both_small(view!("julia", julia)),
    both_small(view!("dendrite", dendrite)),
    both_small(view!("seahorse-valley", seahorse_valley)),
    both_roomy(equalised!("seahorse-smooth", seahorse_smooth)),
    view!("filaments", filaments),
    periods!("mandelbrot-periods", mandelbrot_periods),
    both_roomy(deep!("deep-30", deep_30)),
    both_roomy(deep!("deep-100", deep_100)),
    both_roomy(chart!("figure-1-f", figure_1_f)),
    both_roomy(chart!("figure-1-g", figure_1_g)),
    both_roomy(chart!("figure-2", figure_2)),
    both_roomy(chart!("figure-3-f", figure_3_f)),
    both_roomy(chart!("figure-3-g", figure_3_g)),
    both_roomy(surface!("figure-6-ff", figure_6_ff)),
    both_roomy(surface!("figure-6-gg", figure_6_gg)),
    both_roomy(surface!("figure-6-ff-diffuse", figure_6_ff_diffuse)),
    both_roomy(surface!("figure-6-gg-phong", figure_6_gg_phong)),
    both_roomy(filtered!("figure-6-gg-filtered", figure_6_gg_filtered)),
    both_roomy(filtered!("figure-6-gg-phong-filtered", figure_6_gg_phong_filtered)),
    both_roomy(chart!("sunspots", sunspots)),
    ifs!("sierpinski", sierpinski),
    both_roomy(ifs!("fern", fern)),
    both_roomy(ifs!("dragon", dragon)),
    ifs!("heighway-dragon", heighway_dragon),
    ifs!("koch-curve", koch_curve),
    both_roomy(ifs!("levy-c-curve", levy_c_curve)),
    both_roomy(ifs!("maple-leaf", maple_leaf)),
    ifs!("pentigree", pentigree),
    ifs!("sierpinski-carpet", sierpinski_carpet),
    both_roomy(ifs!("spiral", spiral)),
    ifs!("terdragon", terdragon),
    both_roomy(ifs!("tree", tree)),
    curve!("koch-snowflake", koch_snowflake),
    curve!("hilbert", hilbert),
    curve!("peano", peano),
    curve!("gosper", gosper),
    curve!("minkowski", minkowski),
    curve!("cesaro-square", cesaro_square),
    random_curve!("elbow", elbow),
    both_roomy(random_curve!("carpenter-1", carpenter_1)),
    both_roomy(random_curve!("carpenter-2", carpenter_2)),
    random_curve!("mountain-line", mountain_line),
    random_curve!("extrapolation", extrapolation),
    random_curve!("coastline", coastline),
    both_roomy(patch_curve!("patch-bezier", patch_bezier)),
    both_roomy(patch_curve!("patch-takagi", patch_takagi)),
    both_roomy(patch_curve!("patch-spirals", patch_spirals)),
    l_system!("cantor", cantor),
    l_system!("plant", plant),
    l_system!("dragon-curve", dragon_curve),
    copier!("copier-gasket", copier_gasket),
    copier!("copier-fern", copier_fern),
    both_roomy(julia_set!("rabbit-outline", rabbit_outline)),
    julia_set!("julia-dendrite", julia_dendrite),
    julia_set!("san-marco", san_marco),
];

/// What rays are cast at in a world, and textures, which have an image of their own: together with the others
/// they take more flash than there is.
pub(crate) const WORLDS: &[[Scene; 2]] = &[
    both_roomy(world!("bowl", bowl)),
    both_roomy(world!("rocket", rocket)),
    both_roomy(world!("orange", orange)),
    both_roomy(world!("parcel", parcel)),
    both_roomy(world!("brdf-spheres", brdf_spheres)),
    both_roomy(field_world!("figure-7", figure_7)),
    both_roomy(texture!("clouds", clouds)),
    both_roomy(texture!("lava", lava)),
    both_roomy(lines!("edge-midpoints", edge_midpoints)),
    both_roomy(lines!("centre-midpoints", centre_midpoints)),
    both_roomy(lines!("no-hole", no_hole)),
    both_roomy(terrain!("mountain-bilinear", mountain_bilinear)),
    both_roomy(terrain!("mountain-ferguson", mountain_ferguson)),
    both_roomy(terrain!("mountain-b-spline", mountain_b_spline)),
];

/// Scenes of which the emulator would take a minute for the picture in colour: that in black and white alone.
pub(crate) const IN_MONO: &[Scene] = &[
    both_roomy(patch_surface!("patch-rock", patch_rock))[1],
    both_roomy(patch_surface!("patch-diagonal", patch_diagonal))[1],
    both_roomy(patch_surface!("patch-mountain", patch_mountain))[1],
    both_roomy(patch_surface!("patch-joinings", patch_joinings))[1],
    both_roomy(lattice!("figure-6-without-grain", figure_6_without_grain))[1],
];

/// Encoded pictures, which have an image of their own: their decoders take more flash than that of the others
/// has left.
pub(crate) const IMAGES: &[[Scene; 2]] = &[
    both_roomy(image!("photograph", photograph)),
    both_roomy(image!("photograph-colour", photograph_colour)),
    both_roomy(image!("regeneration", regeneration)),
    both_roomy(image!("maps-alone", maps_alone)),
    both_roomy(image!("elevation", elevation)),
];
