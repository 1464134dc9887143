//! Points of surfaces by control points, at 12 binary digits of both parameters.

use attractor::num::{Near, Real};
use attractor::patch::{Address, Mask, Patch, Tensor, bezier, takagi};

use super::watch::{Tally, Watch};
use crate::inputs::mixed;

const COUNT: usize = 32;
const LEVELS: u32 = 12;

/// Places whose last digit is 1, so that no digit is left out.
fn places() -> [[u32; 2]; COUNT] {
    core::array::from_fn(|i| [0, 32].map(|k| (mixed(i) >> k) as u32 >> (32 - LEVELS) | 1))
}

fn heights<const J: usize>() -> [Real; J] {
    core::array::from_fn(|i| Real::from_bits((mixed(i) >> 40) as i32))
}

fn at([s, t]: [u32; 2]) -> Option<[Address<2>; 2]> {
    Some([Address::of(s, LEVELS).ok()?, Address::of(t, LEVELS).ok()?])
}

fn over(watch: &mut Watch<'_>, height: impl Fn([Address<2>; 2]) -> Real) -> Tally {
    watch.over(&places(), |place| at(place).map_or(0, |at| height(at).to_bits() as u32))
}

#[inline(never)]
pub(super) fn tensor_3(watch: &mut Watch<'_>) -> Tally {
    let product = takagi().and_then(|curve| Tensor::<2, 3, 3, 9>::new(curve, curve));
    let heights = heights();
    match product {
        Ok(product) => over(watch, |at| product.height(&heights, at)),
        Err(_) => over(watch, |_| Real::ZERO),
    }
}

#[inline(never)]
pub(super) fn tensor_4(watch: &mut Watch<'_>) -> Tally {
    let product = bezier::<4>().and_then(|curve| Tensor::<2, 4, 4, 16>::new(curve, curve));
    let heights = heights();
    match product {
        Ok(product) => over(watch, |at| product.height(&heights, at)),
        Err(_) => over(watch, |_| Real::ZERO),
    }
}

/// Numbers halfway between control points, each point moved towards another.
fn numbers() -> [Near; 72] {
    let mut numbers = [Near::ONE / 8; 72];
    for (pair, first) in numbers.chunks_exact_mut(2).take(4).zip([true, false, true, false]) {
        if let [a, b] = pair {
            (*a, *b) = if first { (Near::ONE / 2, Near::ZERO) } else { (Near::ZERO, Near::ONE / 2) };
        }
    }
    numbers
}

#[inline(never)]
pub(super) fn general(watch: &mut Watch<'_>) -> Tally {
    let heights = heights();
    match Patch::standard(&numbers()) {
        Ok(patch) => over(watch, |at| patch.height(&heights, at)),
        Err(_) => over(watch, |_| Real::ZERO),
    }
}

#[inline(never)]
pub(super) fn lattice(watch: &mut Watch<'_>) -> Tally {
    const CUBIC: [i32; 5] = [1, 4, 6, 4, 1];
    let heights = heights();
    match Mask::new(CUBIC.map(|a| CUBIC.map(|b| Near::from_bits((a * b) << 22)))) {
        Ok(mask) => over(watch, |at| mask.height(&heights, at)),
        Err(_) => over(watch, |_| Real::ZERO),
    }
}
