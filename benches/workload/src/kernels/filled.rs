//! Whole pictures, plain and with the inside filled in: what filling saves, and where it does not.

use attractor::Error;
use attractor::escape::{
    Arithmetic, DeepMandelbrot, DeepView, Dwell, Filled, Julia, Mandelbrot, OrbitPoint, View,
};
use attractor::num::Complex;
use attractor::num::Wide;
use attractor::plane::Field;
use embedded_graphics::geometry::Size;

use super::watch::{Tally, Watch};
use crate::exported::{deep_100, julia, seahorse_valley};

const SIZE: Size = Size::new(64, 64);
const MAX: u32 = 1000;

fn sum(picture: &impl Field<Value = Dwell>) -> Tally {
    let dwells = (0..SIZE.height).flat_map(|y| picture.row(y, 0..SIZE.width));
    Tally {
        checksum: dwells.fold(0, |sum, dwell| sum.rotate_left(1) ^ dwell.count),
        units: SIZE.width * SIZE.height,
    }
}

fn show<const FILLED: bool>(watch: &mut Watch<'_>, picture: impl Field<Value = Dwell>) -> Tally {
    let mut bits = [0; Filled::<Mandelbrot>::bytes(SIZE)];
    watch.time(|| {
        if FILLED {
            Filled::new(&picture, &mut bits).map_or(Tally::default(), |filled| sum(&filled))
        } else {
            sum(&picture)
        }
    })
}

/// Douady's rabbit.
#[inline(never)]
pub(super) fn rabbit<const FILLED: bool>(watch: &mut Watch<'_>) -> Tally {
    let view = View::new(Complex::default(), const { Wide::lit("3.2") }, SIZE);
    let picture = view.and_then(|view| Julia::new(view, julia::C, MAX));
    picture.map_or(Tally::default(), |picture| show::<FILLED>(watch, picture))
}

/// The whole set.
#[inline(never)]
pub(super) fn home<const FILLED: bool>(watch: &mut Watch<'_>) -> Tally {
    let picture = View::home(SIZE).and_then(|view| Mandelbrot::new(view, MAX));
    picture.map_or(Tally::default(), |picture| show::<FILLED>(watch, picture))
}

#[inline(never)]
pub(super) fn seahorses<const FILLED: bool>(watch: &mut Watch<'_>) -> Tally {
    let picture = seahorse_valley::view(SIZE).and_then(|view| Mandelbrot::new(view, MAX));
    picture.map_or(Tally::default(), |picture| show::<FILLED>(watch, picture))
}

/// A small copy that fills the picture.
fn copy<const FILLED: bool>(
    watch: &mut Watch<'_>,
    view: Result<DeepView<12>, Error>,
    arithmetic: Arithmetic,
    orbit: &mut [OrbitPoint],
) -> Tally {
    let picture = view.and_then(|view| DeepMandelbrot::new_in(view, MAX, arithmetic, orbit));
    picture.map_or(Tally::default(), |picture| show::<FILLED>(watch, picture))
}

#[inline(never)]
pub(super) fn word64<const FILLED: bool>(watch: &mut Watch<'_>) -> Tally {
    let view = DeepView::parse("-1.7548776662466927601", "0", "0.04", SIZE);
    copy::<FILLED>(watch, view, Arithmetic::Word64, &mut [])
}

#[inline(never)]
pub(super) fn perturbed<const FILLED: bool>(watch: &mut Watch<'_>) -> Tally {
    let mut orbit = [OrbitPoint::default(); MAX as usize];
    let view = "1e-101".parse().and_then(|width| DeepView::new(deep_100::CENTRE, width, SIZE));
    copy::<FILLED>(watch, view, Arithmetic::Perturbed, &mut orbit)
}

#[cfg(test)]
mod tests {
    use super::super::watch::Loop;
    use super::*;

    #[test]
    fn filling_changes_no_pixel_of_these() {
        let pairs: [(Loop, Loop); 5] = [
            (rabbit::<false>, rabbit::<true>),
            (home::<false>, home::<true>),
            (seahorses::<false>, seahorses::<true>),
            (word64::<false>, word64::<true>),
            (perturbed::<false>, perturbed::<true>),
        ];
        let run = |work: Loop| work(&mut Watch::new(&mut crate::machine::Blind, 1));
        for (k, (plain, filled)) in pairs.into_iter().enumerate() {
            let (plain, filled) = (run(plain), run(filled));
            assert!(plain.units == 4096 && plain == filled, "{k}: {plain:?} {filled:?}");
        }
    }
}
