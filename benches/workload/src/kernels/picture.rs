//! The scene `fif mirror` pixel by pixel: core's way, and the paper's own in floating point.

use embedded_graphics::geometry::Size;

use attractor::plane::Field as _;

use super::trace::with_pyramid;
use super::watch::{Tally, Watch};
use crate::float::Float;
use crate::rivals::Paper;
use crate::surface::mirror;

/// Side of the scene, and every how many of its rows are drawn. Double precision would take minutes for all
/// of them; a pixel of these costs what a pixel of all costs, to 1 % (tested).
const SIDE: u32 = 240;
const STEP: u32 = 16;

#[inline(never)]
pub(super) fn core(watch: &mut Watch<'_>) -> Tally {
    with_pyramid(|pyramid| {
        let Ok(caster) = mirror(pyramid, Size::new(SIDE, SIDE)) else { return Tally::default() };
        watch.time(|| rows(STEP, |y| caster.row(y, 0..SIDE).map(|tone| u32::from(tone.to_bits()))))
    })
}

#[inline(never)]
pub(super) fn paper<F: Float>(watch: &mut Watch<'_>) -> Tally {
    with_pyramid(|pyramid| {
        let paper = &Paper::<F>::new(pyramid, SIDE);
        watch.time(|| rows(STEP, |y| (0..SIDE).map(move |x| paper.tone(x, y).fold())))
    })
}

/// Every `step`-th row, from the middle of the first `step` on.
#[inline(always)]
fn rows<I: Iterator<Item = u32>>(step: u32, mut row: impl FnMut(u32) -> I) -> Tally {
    let mut tally = Tally::default();
    for y in (step / 2..SIDE).step_by(step as usize) {
        for tone in row(y) {
            tally.checksum = tally.checksum.rotate_left(1) ^ tone;
            tally.units += 1;
        }
    }
    tally
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rows_that_are_drawn_stand_for_the_picture() {
        let mut boxes = [0.0; 2];
        with_pyramid(|pyramid| {
            let paper = Paper::<f64>::new(pyramid, SIDE);
            for (boxes, step) in boxes.iter_mut().zip([STEP, 1]) {
                let mut sum = 0;
                let tally = rows(step, |y| {
                    sum += (0..SIDE).map(|x| paper.box_tests(x, y)).sum::<u32>();
                    0..SIDE
                });
                *boxes = f64::from(sum) / f64::from(tally.units);
            }
            Tally::default()
        });
        let [drawn, all] = boxes;
        assert!((drawn / all - 1.0).abs() < 0.01, "{drawn} boxes a pixel, {all} in the whole picture");
    }
}
