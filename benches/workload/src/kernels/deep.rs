//! The deep formats, the orbit that perturbation follows, and what colours a pixel.
//!
//! As in [`super::escape`] what is counted are iterations: orbits are long, escape, and nothing shortens them
//! but jumps, which a row of its own has.

use core::hint::black_box;

use attractor::Error;
use attractor::escape::{
    Arithmetic, DeepMandelbrot, DeepView, Distance, Interior, Mandelbrot, OrbitPoint, Period, Smooth, View,
};
use attractor::plane::Field;
use embedded_graphics::geometry::Size;

use super::watch::{Tally, Watch};
use crate::exported::deep_100;

const MAX: u32 = 1500;

const SIZE: Size = Size::new(9, 9);

/// Between seahorses: orbits of a thousand iterations, too far apart for a jump.
fn shallow() -> Result<DeepView<4>, Error> {
    DeepView::parse("-0.743643887037151", "0.131825904205330", "6e-9", SIZE)
}

/// Every pixel's dwell; what is counted is the iterations of those that escape.
fn dwells<const LIMBS: usize>(
    watch: &mut Watch<'_>,
    view: Result<DeepView<LIMBS>, Error>,
    arithmetic: Arithmetic,
    max: u32,
    orbit: &mut [OrbitPoint],
) -> Result<Tally, Error> {
    let set = DeepMandelbrot::new_in(view?, max, arithmetic, orbit)?;
    let outside = |x, y| !set.dwell_at(x, y).is_inside();
    let mut pixels = [(0, 0); 32];
    let found = (0..81).map(|i| (i % 9, i / 9)).filter(|(x, y)| outside(*x, *y));
    let mut count = 0;
    for (slot, pixel) in pixels.iter_mut().zip(found) {
        *slot = pixel;
        count += 1;
    }
    Ok(watch.time(|| {
        let mut tally = Tally::default();
        for (x, y) in black_box(&pixels).iter().take(count) {
            let dwell = set.dwell_at(*x, *y).count;
            tally.units += dwell;
            tally.checksum = tally.checksum.rotate_left(1) ^ dwell;
        }
        tally
    }))
}

#[inline(never)]
pub(super) fn word64(watch: &mut Watch<'_>) -> Tally {
    dwells(watch, shallow(), Arithmetic::Word64, MAX, &mut []).unwrap_or_default()
}

#[inline(never)]
pub(super) fn word128(watch: &mut Watch<'_>) -> Tally {
    dwells(watch, shallow(), Arithmetic::Word128, MAX, &mut []).unwrap_or_default()
}

#[inline(never)]
pub(super) fn perturbed(watch: &mut Watch<'_>) -> Tally {
    let mut orbit = [OrbitPoint::default(); MAX as usize];
    dwells(watch, shallow(), Arithmetic::Perturbed, MAX, &mut orbit).unwrap_or_default()
}

#[inline(never)]
pub(super) fn perturbed_long(watch: &mut Watch<'_>) -> Tally {
    let mut orbit = [OrbitPoint::default(); 2 * MAX as usize];
    dwells(watch, shallow(), Arithmetic::PerturbedLong, MAX, &mut orbit).unwrap_or_default()
}

/// At a width of 1e-100, where most iterations are jumped over.
#[inline(never)]
pub(super) fn jumping(watch: &mut Watch<'_>) -> Tally {
    let mut orbit = [OrbitPoint::default(); 1000];
    dwells(watch, deep_100::view(SIZE), Arithmetic::Perturbed, 1000, &mut orbit).unwrap_or_default()
}

/// The reference orbit in 12 limbs.
#[inline(never)]
pub(super) fn reference(watch: &mut Watch<'_>) -> Tally {
    let mut orbit = [OrbitPoint::default(); 200];
    let Ok(view) = deep_100::view(Size::new(64, 64)) else { return Tally::default() };
    watch.time(|| {
        let set = DeepMandelbrot::new_in(black_box(view), 200, Arithmetic::Perturbed, &mut orbit);
        set.map_or(Tally::default(), |set| Tally {
            checksum: set.dwell_at(11, 7).count,
            units: set.reference_len() as u32,
        })
    })
}

/// Every pixel of the home view.
fn pixels<F: Field>(
    watch: &mut Watch<'_>,
    make: impl Fn(Mandelbrot) -> F,
    bits: impl Fn(F::Value) -> u32,
) -> Tally {
    let size = Size::new(30, 25);
    let Ok(set) = View::home(size).and_then(|view| Mandelbrot::new(view, 100)) else {
        return Tally::default();
    };
    let field = make(set);
    watch.time(|| {
        let mut tally = Tally::default();
        for value in (0..size.height).flat_map(|y| field.row(y, 0..size.width)) {
            tally.units += 1;
            tally.checksum = tally.checksum.rotate_left(1) ^ bits(value);
        }
        tally
    })
}

#[inline(never)]
pub(super) fn dwell(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, |set| set, |dwell| dwell.count)
}

#[inline(never)]
pub(super) fn smooth(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, Smooth, |dwell| dwell.dwell.to_bits())
}

#[inline(never)]
pub(super) fn distance(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, Distance, |distance| distance.map_or(0, |d| d.to_bits() as u32))
}

#[inline(never)]
pub(super) fn period(watch: &mut Watch<'_>) -> Tally {
    pixels(watch, Interior, |period| period.map_or(0, Period::length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_loop_does_what_it_says() {
        let run = |work: fn(&mut Watch<'_>) -> Tally| work(&mut Watch::new(&mut crate::machine::Blind, 1));
        let words = [run(word64), run(word128), run(perturbed), run(perturbed_long)];
        assert!(words.iter().all(|tally| tally.units.abs_diff(words[0].units) < 99), "{words:?}");
        assert!(words[0].units > 32 * 500, "{words:?}");
        assert!(run(jumping).units > 32 * 600);
        assert_eq!(run(reference).units, 200);
        assert_eq!(run(dwell).units, 750);
    }
}
