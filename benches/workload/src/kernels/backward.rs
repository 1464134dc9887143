//! Points of Julia sets by backward iteration, the complex square root that each of them takes, and their
//! covers.

use core::hint::black_box;

use attractor::escape::{JuliaCover, View};
use attractor::fixed::types::I3F29;
use attractor::num::Complex;
use attractor::num::Wide;
use attractor::plane::Field as _;
use attractor::rand_xoshiro::Xoshiro128PlusPlus;
use attractor::rand_xoshiro::rand_core::{Rng, SeedableRng};
use embedded_graphics::geometry::Size;

use super::watch::{Tally, Watch};
use crate::exported::rabbit_outline;
use crate::float::{fold, mul_add, sqrt};
use crate::inputs::{mixed, table};

const POINTS: u32 = 2048;
const SEED: u64 = 7;
/// Pixels a side of the picture that is covered.
const SIDE: u32 = 64;

#[inline(never)]
pub(super) fn plain(watch: &mut Watch<'_>) -> Tally {
    let Ok(set) = rabbit_outline::set() else { return Tally::default() };
    let start = set.seeded_backward_iteration(SEED);
    watch.time(|| {
        let mut checksum = 0_u32;
        for p in start.clone().take(POINTS as usize) {
            checksum = checksum.rotate_left(1) ^ p.x.to_bits() as u32 ^ p.y.to_bits() as u32;
        }
        Tally { checksum, units: POINTS }
    })
}

#[inline(never)]
pub(super) fn cover(watch: &mut Watch<'_>) -> Tally {
    let view = View::new(Complex::default(), const { Wide::lit("4") }, Size::new(SIDE, SIDE));
    let (Ok(set), Ok(view)) = (rabbit_outline::set(), view) else { return Tally::default() };
    let Ok(cover) = JuliaCover::new(view, set) else { return Tally::default() };
    watch.time(|| {
        let mut tally = Tally::default();
        for count in (0..SIDE).flat_map(|y| cover.row(y, 0..SIDE)) {
            tally.checksum = tally.checksum.rotate_left(1) ^ u32::from(count);
            tally.units += 1;
        }
        tally
    })
}

table! {
    /// Parts of numbers of every magnitude below 4.
    PARTS: i32, i => (mixed(i) as i32) >> (i % 29)
}

#[inline(never)]
pub(super) fn root(watch: &mut Watch<'_>) -> Tally {
    let inputs = PARTS.map(|re| (re, re.rotate_left(9)));
    watch.over(&inputs, |(re, im)| {
        let root = Complex::new(I3F29::from_bits(re), I3F29::from_bits(im)).sqrt();
        root.re.to_bits() as u32 ^ root.im.to_bits() as u32
    })
}

/// Kahan's formula, without his care for overflow: the larger part first, the other by a division.
macro_rules! floats {
    ($plain:ident, $root:ident, $float:ty, $fused:expr, $sqrt:expr, $fold:expr) => {
        #[inline(never)]
        pub(super) fn $plain(watch: &mut Watch<'_>) -> Tally {
            let c: ($float, $float) = black_box((-0.123, 0.745));
            let start = Xoshiro128PlusPlus::seed_from_u64(SEED);
            watch.time(|| {
                let mut rng = start.clone();
                let (mut x, mut y): ($float, $float) = (1.0, 0.0);
                let mut checksum = 0_u32;
                for _ in 0..POINTS {
                    let (re, im) = complex_root!($float, $fused, $sqrt, x - c.0, y - c.1);
                    (x, y) = if rng.next_u32() >> 31 == 0 { (re, im) } else { (-re, -im) };
                    checksum = checksum.rotate_left(1) ^ $fold(x) ^ $fold(y);
                }
                Tally { checksum, units: POINTS }
            })
        }

        #[inline(never)]
        pub(super) fn $root(watch: &mut Watch<'_>) -> Tally {
            let inputs = PARTS.map(|re| [re, re.rotate_left(9)].map(|v| v as $float / 536_870_912.0));
            watch.over(&inputs, |[x, y]| {
                let (re, im) = complex_root!($float, $fused, $sqrt, x, y);
                $fold(re) ^ $fold(im)
            })
        }
    };
}

macro_rules! complex_root {
    ($float:ty, $fused:expr, $sqrt:expr, $x:expr, $y:expr) => {{
        let (x, y): ($float, $float) = ($x, $y);
        let (a, b) = (x.abs(), y.abs());
        let modulus: $float = $sqrt($fused(a, a, b * b));
        let large: $float = $sqrt((modulus + a) * 0.5);
        let small: $float = if large > 0.0 { b / (large + large) } else { 0.0 };
        let (re, im) = if x >= 0.0 { (large, small) } else { (small, large) };
        (re, if y < 0.0 { -im } else { im })
    }};
}

floats!(plain_f32, root_f32, f32, mul_add, sqrt, f32::to_bits);
floats!(plain_f64, root_f64, f64, |a: f64, b: f64, c: f64| a * b + c, libm::sqrt, fold);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_roots_in_floating_point_are_those_of_core() {
        let unit = 2_f64.powi(-29);
        for re in PARTS {
            let im = re.rotate_left(9);
            let root = Complex::new(I3F29::from_bits(re), I3F29::from_bits(im)).sqrt();
            let (x, y) = (f64::from(re) * unit, f64::from(im) * unit);
            let exact = complex_root!(f64, |a: f64, b: f64, c: f64| a * b + c, libm::sqrt, x, y);
            let error =
                (root.re.to_num::<f64>() - exact.0).abs().max((root.im.to_num::<f64>() - exact.1).abs());
            assert!(error < 2.0 * unit, "{x} {y}: {error:e}");
        }
    }
}
