//! Moments of a lattice, and pixels of the scene `figure-6-without-grain`, by one sample and filtered.
//!
//! Pixels of 96 x 96 that the finest quality filters.

use attractor::num::Real;
use attractor::patch::SlopeMoments;
use attractor::plane::{Field as _, Tone};
use attractor::trace::{FilteredPatch, Found, Quality};
use embedded_graphics::geometry::Size;

use super::watch::{Tally, Watch};
use crate::exported::figure_6_without_grain as scene;

const SIZE: Size = Size::new(96, 96);
const COUNT: usize = 48;

/// Mean and covariance of the slopes over a cell.
#[inline(never)]
pub(super) fn slopes(watch: &mut Watch<'_>) -> Tally {
    let cells = [1, 2, 3, 5, 8, 13, 21, 34].map(|k: u32| [k, 40 - k]);
    let mut tally = || {
        let mask = scene::scheme().ok()?;
        let (sheet, moments) = (scene::sheet(&mask).ok()?, SlopeMoments::new(&mask).ok()?);
        let parts: [[Real; 16]; 8] = cells.map(|index| sheet.part(index, 3));
        Some(watch.over(&parts, |heights| {
            let slopes = moments.over(&heights, 48);
            slopes
                .covariance
                .iter()
                .chain(&slopes.mean)
                .fold(0, |sum, part| u32::rotate_left(sum, 1) ^ part.to_bits().cast_unsigned())
        }))
    };
    tally().unwrap_or_default()
}

/// The moments themselves.
#[inline(never)]
pub(super) fn moments(watch: &mut Watch<'_>) -> Tally {
    let mask = scene::scheme();
    watch.over(&[2_u32], |parts| {
        let moments = mask.ok().and_then(|mask| SlopeMoments::new(&mask).ok());
        // no plane, of which slopes do not vary
        let heights = core::array::from_fn(|k| Real::from_bits((k * k) as i32) << 17);
        moments.map_or(0, |moments| moments.over(&heights, parts).covariance[0].to_bits().cast_unsigned())
    })
}

fn pixels(watch: &mut Watch<'_>, quality: Option<Quality>) -> Option<Tally> {
    let mask = scene::scheme().ok()?;
    let picture = scene::picture(&mask).ok()?;
    let one = attractor_gallery::LatticePicture { samples: 1, ..picture };
    let (caster, moments) = (one.caster(SIZE, 1).ok()?, SlopeMoments::new(&mask).ok()?);
    let finest = FilteredPatch::new(caster.clone(), &moments, Quality::Finest);
    let mut places = [(0, 0); COUNT];
    let all = (0..SIZE.width * SIZE.height).step_by(7).map(|i| (i % SIZE.width, i / SIZE.width));
    let inside = all.filter(|(x, y)| finest.found(*x, *y) == Found::Filtered);
    places.iter_mut().zip(inside).for_each(|(to, place)| *to = place);
    let word = |tone: Tone| u32::from(tone.to_bits());
    Some(match quality {
        None => watch.over(&places, |(x, y)| word(caster.at(x, y))),
        Some(quality) => {
            let filtered = FilteredPatch::new(caster, &moments, quality);
            watch.over(&places, |(x, y)| word(filtered.at(x, y)))
        }
    })
}

#[inline(never)]
pub(super) fn mirror(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, None).unwrap_or_default()
}

#[inline(never)]
pub(super) fn mirror_coarse(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, Some(Quality::Coarse)).unwrap_or_default()
}

#[inline(never)]
pub(super) fn mirror_fine(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, Some(Quality::Fine)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Blind;

    #[test]
    fn as_many_pixels_are_filtered_as_there_is_room_for() {
        let tally = |kernel: fn(&mut Watch<'_>) -> Tally| kernel(&mut Watch::new(&mut Blind, 1));
        let (plain, filtered) = (tally(mirror), tally(mirror_fine));
        assert_eq!((plain.units, filtered.units), (COUNT as u32, COUNT as u32));
        assert_ne!(plain.checksum, filtered.checksum);
        assert_ne!(tally(slopes).checksum, 0);
        assert_ne!(tally(moments).checksum, 0);
    }
}
