//! The built-in scenes of the command `attractor`, drawn by the same code with the same numbers.
//!
//! `tests/built_in.rs` holds each to the picture of that name, pixel for pixel: to the checksums of `host-sim/tests/goldens.txt`.

mod curves;
mod fif;
mod sets;
#[expect(unreachable_pub, reason = "a module as `attractor export` writes it")]
mod sunspots;

use attractor::curve::catalogue as curve;
use attractor::ifs::catalogue as attractors;
use attractor_gallery::{Named, ground_words};
use embedded_graphics::pixelcolor::{BinaryColor, Rgb565};

use crate::scenes::{COLOUR, MONO, Scene, colour, mono, roomy};

/// The seed of the command's own pictures.
const SEED: u64 = 1;

/// Words for the ground under a curve.
const GROUND: [usize; 2] = [ground_words(COLOUR), ground_words(MONO)];
/// Pixels within the margin of a density.
const PIXELS: [usize; 2] = [220 * 220, 124 * 60];

/// Both pictures of a scene: in colour, for machines with room, and in black and white.
macro_rules! both {
    ($name:literal, |$stage:ident, $color:ident $(, $i:ident)?| $show:expr) => {
        [
            {
                type $color = Rgb565;
                $(const $i: usize = 0;)?
                roomy(colour($name, |$stage| $show))
            },
            {
                type $color = BinaryColor;
                $(const $i: usize = 1;)?
                mono($name, |$stage| $show)
            },
        ]
    };
}

/// Even the picture in black and white takes more than 16 KiB.
const fn both_roomy([colour, mono]: [Scene; 2]) -> [Scene; 2] {
    [colour, roomy(mono)]
}

/// The table.
#[rustfmt::skip]
pub(crate) const PAIRS: &[[Scene; 2]] = &[
    both_roomy(both!("figure-1-f", |stage, C| fif::chart::<C>(stage, &fif::F, &[]))),
    both_roomy(both!("figure-1-g", |stage, C| fif::chart::<C>(stage, &fif::G, &[]))),
    both_roomy(both!("figure-2", |stage, C| fif::chart::<C>(stage, &fif::F, &[1, 0, 1, 0, 1, 1]))),
    both_roomy(both!("figure-3-f", |stage, C| fif::chart::<C>(stage, &fif::F_INTEGRAL, &[]))),
    both_roomy(both!("figure-3-g", |stage, C| fif::chart::<C>(stage, &fif::G_INTEGRAL, &[]))),
    both_roomy(both!("figure-6-ff", |stage, C, I| fif::surface::<C, { fif::CELLS[I] }>(stage, &fif::FIGURE_6_FF))),
    both_roomy(both!("figure-6-gg", |stage, C, I| fif::surface::<C, { fif::CELLS[I] }>(stage, &fif::FIGURE_6_GG))),
    both_roomy(both!("figure-6-ff-diffuse", |stage, C, I| fif::surface::<C, { fif::CELLS[I] }>(stage, &fif::FIGURE_6_FF_DIFFUSE))),
    both_roomy(both!("figure-6-gg-phong", |stage, C, I| fif::surface::<C, { fif::CELLS[I] }>(stage, &fif::FIGURE_6_GG_PHONG))),
    both_roomy(both!("sunspots", |stage, C| fif::sunspots::<C>(stage))),
    both!("sierpinski", |stage, C| sets::by_maps::<C>(stage, (&sets::SIERPINSKI, &sets::THIRDS), Named::Even)),
    both_roomy(both!("fern", |stage, C, I| sets::density::<C, 4, { PIXELS[I] }>(stage, &attractors::BARNSLEY_FERN, Named::Moss))),
    both_roomy(both!("dragon", |stage, C, I| sets::density::<C, 2, { PIXELS[I] }>(stage, &attractors::DRAGON, Named::Fire))),
    both!("heighway-dragon", |stage, C| sets::named::<C>(stage, &attractors::HEIGHWAY_DRAGON, Named::Dusk)),
    both!("koch-curve", |stage, C| sets::by_maps::<C>(stage, (&sets::KOCH, &sets::QUARTERS), Named::Ocean)),
    both_roomy(both!("levy-c-curve", |stage, C, I| sets::density::<C, 2, { PIXELS[I] }>(stage, &attractors::LEVY_C_CURVE, Named::Dusk))),
    both_roomy(both!("maple-leaf", |stage, C, I| sets::density::<C, 4, { PIXELS[I] }>(stage, &attractors::MAPLE_LEAF, Named::Fire))),
    both!("pentigree", |stage, C| sets::named::<C>(stage, &attractors::PENTIGREE, Named::Even)),
    both!("sierpinski-carpet", |stage, C| sets::by_maps::<C>(stage, (&sets::CARPET, &sets::EIGHTHS), Named::Dusk)),
    both_roomy(both!("spiral", |stage, C, I| sets::density::<C, 3, { PIXELS[I] }>(stage, &attractors::SPIRAL, Named::Ocean))),
    both!("terdragon", |stage, C| sets::named::<C>(stage, &attractors::TERDRAGON, Named::Ocean)),
    both_roomy(both!("tree", |stage, C, I| sets::density::<C, 4, { PIXELS[I] }>(stage, &attractors::FRACTAL_TREE, Named::Moss))),
    both!("koch-snowflake", |stage, C, I| curves::named::<C, { GROUND[I] }>(stage, &curve::KOCH_SNOWFLAKE, 5, None, Named::Ocean)),
    both!("hilbert", |stage, C, I| curves::named::<C, { GROUND[I] }>(stage, &curve::HILBERT, 5, None, Named::Even)),
    both!("peano", |stage, C, I| curves::named::<C, { GROUND[I] }>(stage, &curve::PEANO, 3, Some(&curves::DIAGONAL), Named::Fire)),
    both!("gosper", |stage, C, I| curves::named::<C, { GROUND[I] }>(stage, &curve::GOSPER, 3, None, Named::Dusk)),
    both!("minkowski", |stage, C, I| curves::named::<C, { GROUND[I] }>(stage, &curve::MINKOWSKI, 3, Some(&curves::SQUARE), Named::Moss)),
    both!("cesaro-square", |stage, C, I| curves::cesaro::<C, { GROUND[I] }>(stage)),
    both!("elbow", |stage, C, I| curves::elbow::<C, { GROUND[I] }>(stage)),
    both!("carpenter-1", |stage, C, I| curves::carpenter_1::<C, { GROUND[I] }>(stage)),
    both!("carpenter-2", |stage, C, I| curves::carpenter_2::<C, { GROUND[I] }>(stage)),
    both!("mountain-line", |stage, C, I| curves::mountain_line::<C, { GROUND[I] }>(stage)),
    both!("coastline", |stage, C, I| curves::coastline::<C, { GROUND[I] }>(stage)),
    both!("copier-gasket", |stage, C| sets::copies::<C>(stage, &attractors::SIERPINSKI_GASKET, &sets::LETTER, &[0, 1, 2, 3, 4, 5, 6], Named::Even)),
    both!("copier-fern", |stage, C| sets::copies::<C>(stage, &attractors::BARNSLEY_FERN, &sets::BOX, &[0, 1, 2, 4, 8], Named::Moss)),
    both_roomy(both!("rabbit-outline", |stage, C, I| sets::julia::<C, { PIXELS[I] }>(stage, &sets::RABBIT))),
    both!("julia-dendrite", |stage, C| sets::covered::<C>(stage, &sets::DENDRITE)),
    both!("san-marco", |stage, C| sets::covered::<C>(stage, &sets::SAN_MARCO)),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_density_takes_one_number_for_each_pixel_within_its_margin() {
        let within = |size: embedded_graphics::geometry::Size| {
            let margin = size.width.min(size.height) / 24;
            ((size.width - 2 * margin) * (size.height - 2 * margin)) as usize
        };
        assert_eq!(PIXELS, [within(COLOUR), within(MONO)]);
    }
}
