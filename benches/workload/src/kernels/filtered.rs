//! Pixels of the surface `G x G` of figure 6, by one sample and with their normals integrated.
//!
//! Pixels inside the surface, of 96 x 96: those that every quality filters.

use attractor::fif::{Cell, Pyramid, Sum, Sums};
use attractor::num::{Real, Unit, Vec3};
use attractor::plane::{Field as _, Tone};
use attractor::trace::{
    Environment, Filter, FilteredCaster, Finish, Found, HeightField, Light, Quality, RayCaster, Sampling,
};
use embedded_graphics::geometry::Size;

use super::watch::{Tally, Watch};
use crate::exported::{figure_6_gg, figure_6_gg_phong};

const SIDE: u32 = 96;
const DEPTH: u32 = 8;
const CELLS: usize = Pyramid::cells(2, DEPTH);
const FINER: u32 = 10;
const PLACES: usize = Sums::places(2, FINER);
const COUNT: usize = 12;
/// Pixels of a row at a time.
const RUN: u32 = 12;

const fn highlight(shininess: u16) -> Finish {
    Finish::Phong { ambient: Unit::ZERO, diffuse: Unit::ZERO, specular: Unit::ONE, shininess }
}

/// The pixels with this finish, plain where there is no quality.
#[inline(always)]
fn pixels(watch: &mut Watch<'_>, finish: Finish, around: Environment, quality: Option<Quality>) -> Tally {
    timed(watch, finish, around, quality).unwrap_or_default()
}

#[inline(never)]
fn timed(
    watch: &mut Watch<'_>,
    finish: Finish,
    around: Environment,
    quality: Option<Quality>,
) -> Option<Tally> {
    let (mut cells, mut places) = ([Cell::ZERO; CELLS], [Sum::ZERO; PLACES]);
    let g = figure_6_gg::factor::<2, 2>().ok()?;
    let pyramid = Pyramid::new(&g, DEPTH, &mut cells).ok()?;
    let sums = Sums::new(&g, FINER, &mut places).ok()?;
    let surface = HeightField::new(&pyramid, &pyramid).ok()?;
    let caster = RayCaster::new(surface, figure_6_gg::camera().ok()?, Size::new(SIDE, SIDE)).ok()?;
    let caster = caster.with_finish(finish).ok()?.with_environment(around).ok()?;
    let light = Light::new(Vec3::new(Real::NEG_ONE, Real::from_num(-2), Real::from_num(3))).ok()?;
    let caster = caster.with_light(light).with_sampling(Sampling::Centre, Filter::Box).ok()?;
    let finest = FilteredCaster::new(caster.clone(), &sums, &sums, Quality::Finest).ok()?;
    // runs evenly over the picture, as many as there is room for
    let mut places = [(0, 0); COUNT];
    let runs = (0..SIDE * SIDE / RUN).step_by(7).map(|i| (i * RUN % SIDE, i * RUN / SIDE));
    let inside = |x: u32, y: u32| (x..x + RUN).all(|x| finest.found(x, y) == Found::Filtered);
    let runs = runs.filter(|(x, y)| inside(*x, *y));
    places.iter_mut().zip(runs).for_each(|(to, place)| *to = place);
    let fold = |sum: u32, tone: Tone| sum.rotate_left(1) ^ u32::from(tone.to_bits());
    let tally = match quality {
        None => watch.over(&places, |(x, y)| caster.row(y, x..x + RUN).fold(0, fold)),
        Some(quality) => {
            let filtered = FilteredCaster::new(caster, &sums, &sums, quality).ok()?;
            watch.over(&places, |(x, y)| filtered.row(y, x..x + RUN).fold(0, fold))
        }
    };
    Some(Tally { units: tally.units * RUN, ..tally })
}

#[inline(never)]
pub(super) fn plain_diffuse(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, Finish::DIFFUSE, figure_6_gg_phong::ENVIRONMENT, None)
}

#[inline(never)]
pub(super) fn diffuse_coarse(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, Finish::DIFFUSE, figure_6_gg_phong::ENVIRONMENT, Some(Quality::Coarse))
}

#[inline(never)]
pub(super) fn diffuse_fine(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, Finish::DIFFUSE, figure_6_gg_phong::ENVIRONMENT, Some(Quality::Fine))
}

#[inline(never)]
pub(super) fn plain_highlight(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, highlight(32), figure_6_gg_phong::ENVIRONMENT, None)
}

#[inline(never)]
pub(super) fn highlight_fine(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, highlight(32), figure_6_gg_phong::ENVIRONMENT, Some(Quality::Fine))
}

#[inline(never)]
pub(super) fn highlight_finest(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, highlight(32), figure_6_gg_phong::ENVIRONMENT, Some(Quality::Finest))
}

#[inline(never)]
pub(super) fn plain_highlight_8(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, highlight(8), figure_6_gg_phong::ENVIRONMENT, None)
}

#[inline(never)]
pub(super) fn highlight_8_fine(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, highlight(8), figure_6_gg_phong::ENVIRONMENT, Some(Quality::Fine))
}

#[inline(never)]
pub(super) fn plain_mirror(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, Finish::Mirror, figure_6_gg::ENVIRONMENT, None)
}

#[inline(never)]
pub(super) fn mirror_fine(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, Finish::Mirror, figure_6_gg::ENVIRONMENT, Some(Quality::Fine))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Blind;

    #[test]
    fn as_many_pixels_are_filtered_as_there_is_room_for() {
        let tally = |kernel: fn(&mut Watch<'_>) -> Tally| kernel(&mut Watch::new(&mut Blind, 1));
        let (plain, filtered) = (tally(plain_diffuse), tally(diffuse_fine));
        assert_eq!((plain.units, filtered.units), (COUNT as u32 * RUN, COUNT as u32 * RUN));
        assert_ne!(plain.checksum, filtered.checksum);
    }
}
