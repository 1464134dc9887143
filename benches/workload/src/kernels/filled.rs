//! Whole pictures, plain and with the inside filled in: what filling saves, and where it does not.

use attractor::Error;
use attractor::escape::{
    Arithmetic, DeepMandelbrot, DeepView, Dwell, Filled, Julia, Mandelbrot, OrbitPoint, View,
};
use attractor::num::Complex;
use attractor::num::Wide;
use attractor::plane::Field;
use embedded_graphics::geometry::Size;

use super::{Tally, Watch};

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

fn shallow(re: Wide, im: Wide, width: Wide) -> Result<View, Error> {
    View::new(Complex::new(re, im), width, SIZE)
}

/// Douady's rabbit.
#[inline(never)]
pub(super) fn rabbit<const FILLED: bool>(watch: &mut Watch<'_>) -> Tally {
    const C: Complex<Wide> = Complex::new(Wide::lit("-0.12256116687665"), Wide::lit("0.74486176661974"));
    let picture =
        shallow(Wide::ZERO, Wide::ZERO, const { Wide::lit("3.2") }).and_then(|view| Julia::new(view, C, MAX));
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
    let view =
        shallow(const { Wide::lit("-0.7453") }, const { Wide::lit("0.1127") }, const { Wide::lit("0.0065") });
    let picture = view.and_then(|view| Mandelbrot::new(view, MAX));
    picture.map_or(Tally::default(), |picture| show::<FILLED>(watch, picture))
}

/// A small copy that fills the picture.
fn copy<const FILLED: bool>(
    watch: &mut Watch<'_>,
    [re, im, width]: [&str; 3],
    arithmetic: Arithmetic,
    orbit: &mut [OrbitPoint],
) -> Tally {
    let view = DeepView::<12>::parse(re, im, width, SIZE);
    let picture = view.and_then(|view| DeepMandelbrot::new_in(view, MAX, arithmetic, orbit));
    picture.map_or(Tally::default(), |picture| show::<FILLED>(watch, picture))
}

#[inline(never)]
pub(super) fn word64<const FILLED: bool>(watch: &mut Watch<'_>) -> Tally {
    copy::<FILLED>(watch, ["-1.7548776662466927601", "0", "0.04"], Arithmetic::Word64, &mut [])
}

#[inline(never)]
pub(super) fn perturbed<const FILLED: bool>(watch: &mut Watch<'_>) -> Tally {
    let mut orbit = [OrbitPoint::default(); MAX as usize];
    let [re, im, _] = crate::escape_scenes::PERIOD_95;
    copy::<FILLED>(watch, [re, im, "1e-101"], Arithmetic::Perturbed, &mut orbit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filling_changes_no_pixel_of_these() {
        let pairs: [(super::super::Loop, super::super::Loop); 5] = [
            (rabbit::<false>, rabbit::<true>),
            (home::<false>, home::<true>),
            (seahorses::<false>, seahorses::<true>),
            (word64::<false>, word64::<true>),
            (perturbed::<false>, perturbed::<true>),
        ];
        let run = |work: super::super::Loop| work(&mut Watch::new(&mut crate::Blind, 1));
        for (k, (plain, filled)) in pairs.into_iter().enumerate() {
            let (plain, filled) = (run(plain), run(filled));
            assert!(plain.units == 4096 && plain == filled, "{k}: {plain:?} {filled:?}");
        }
    }
}
