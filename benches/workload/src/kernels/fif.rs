//! Evaluation of the function `f` of figure 1 and of its integral.

use attractor::Error;
use attractor::fif::Fif;
use attractor::num::{Angle, Wide};
use attractor::rand_xoshiro::Xoshiro128PlusPlus;
use attractor::rand_xoshiro::rand_core::{Rng, SeedableRng};

use super::watch::{Tally, Watch};
use crate::exported::figure_1_f;
use crate::float::{fold, mul_add};
use crate::inputs::{mixed, table};

table! {
    /// Abscissae with exactly 24 binary digits.
    PLACES: u32, i => (mixed(i) as u32 & 0xffff_ff00) | 0x100
}

/// The paper's `f`: set up by one copy of the code, which the flash of a Cortex-M0 has room for.
#[inline(never)]
fn figure_1() -> Result<Fif<2, 1>, Error> {
    figure_1_f::function()
}

#[inline(never)]
pub(super) fn dyadic(watch: &mut Watch<'_>) -> Tally {
    let Some(f) = figure_1().ok().and_then(|f| f.dyadic::<16>()) else { return Tally::default() };
    watch.over(&PLACES, |u| f.at(Angle::from_bits(u)).to_bits() as u32)
}

#[inline(never)]
pub(super) fn compiled(watch: &mut Watch<'_>) -> Tally {
    let Some(f) = figure_1().and_then(|f| f.compiled()).ok() else { return Tally::default() };
    watch.over(&PLACES, |u| f.at(Angle::from_bits(u)).to_bits() as u32)
}

#[inline(never)]
pub(super) fn any(watch: &mut Watch<'_>) -> Tally {
    let Ok(f) = figure_1() else { return Tally::default() };
    watch.over(&PLACES, |u| f.at(Wide::from_bits(i64::from(u) << 17)).to_bits() as u32)
}

/// The maps of the integral from those of the function.
#[inline(never)]
pub(super) fn integrate(watch: &mut Watch<'_>) -> Tally {
    let Ok(f) = figure_1() else { return Tally::default() };
    watch.time(|| {
        let integral = core::hint::black_box(&f).integral::<2>(Wide::ZERO);
        let (low, high) = integral.map(|f| f.range()).unwrap_or_default();
        Tally { checksum: low.to_bits().rotate_left(16) as u32 ^ high.to_bits() as u32, units: 1 }
    })
}

#[inline(never)]
pub(super) fn integral(watch: &mut Watch<'_>) -> Tally {
    let integral = figure_1().and_then(|f| f.integral::<2>(Wide::ZERO)).ok().and_then(|f| f.dyadic::<16>());
    let Some(f) = integral else { return Tally::default() };
    watch.over(&PLACES, |u| f.at(Angle::from_bits(u)).to_bits() as u32)
}

const POINTS: u32 = 2048;
const SEED: u64 = 7;

#[inline(never)]
pub(super) fn game(watch: &mut Watch<'_>) -> Tally {
    let Ok(f) = figure_1() else { return Tally::default() };
    let start = f.chaos_game(Xoshiro128PlusPlus::seed_from_u64(SEED));
    watch.time(|| {
        let mut checksum = 0_u32;
        for p in start.clone().take(POINTS as usize) {
            checksum = checksum.rotate_left(1) ^ p.x.to_bits() as u32 ^ p.y.to_bits() as u32;
        }
        Tally { checksum, units: POINTS }
    })
}

macro_rules! game {
    ($name:ident, $float:ty, $fused:expr, $fold:expr) => {
        /// The same game: two intervals of one width need no search.
        #[inline(never)]
        pub(super) fn $name(watch: &mut Watch<'_>) -> Tally {
            let maps: [[$float; 4]; 2] = core::hint::black_box([[0.0, 0.0, 1.0, 0.5], [0.5, 1.0, -1.0, 0.5]]);
            let start = Xoshiro128PlusPlus::seed_from_u64(SEED);
            watch.time(|| {
                let mut rng = start.clone();
                let (mut u, mut y): ($float, $float) = (0.0, 0.0);
                let mut checksum = 0_u32;
                for _ in 0..POINTS {
                    let [start, constant, linear, scaling] = maps[(rng.next_u32() >> 31) as usize];
                    y = $fused(scaling, y, $fused(linear, u, constant));
                    u = $fused(u, 0.5, start);
                    checksum = checksum.rotate_left(1) ^ $fold(u) ^ $fold(y);
                }
                Tally { checksum, units: POINTS }
            })
        }
    };
}

game!(game_f32, f32, mul_add, f32::to_bits);
game!(game_f64, f64, |a: f64, b: f64, c: f64| a * b + c, fold);

/// The same two walks in floating point: from the last digit to the first for 24 digits, and forwards along
/// the pre-images for any abscissa, until the horizontal factor is below the resolution of the type.
///
/// `f`: `q_1 = u`, `q_2 = 1 - u`, `alpha = 1/2`; its integral (eq. 37-38, in `u`): `q_1 = u^2 / 2`,
/// `q_2 = 1 + u - u^2 / 2`, `alpha = 1/4`.
macro_rules! walks {
    ($dyadic:ident, $any:ident, $integral:ident, $float:ty, $fused:expr, $fold:expr, $levels:literal) => {
        #[inline(never)]
        pub(super) fn $dyadic(watch: &mut Watch<'_>) -> Tally {
            // start of the interval, constant and linear coefficient, scaling
            let maps: [[$float; 4]; 2] = core::hint::black_box([[0.0, 0.0, 1.0, 0.5], [0.5, 1.0, -1.0, 0.5]]);
            watch.over(&PLACES, |u| {
                let (mut t, mut y): ($float, $float) = (0.0, 0.0);
                let mut digits = u >> 8;
                for _ in 0..24 {
                    let [start, constant, linear, scaling] = maps[(digits & 1) as usize];
                    y = $fused(scaling, y, $fused(linear, t, constant));
                    t = $fused(t, 0.5, start);
                    digits >>= 1;
                }
                $fold(y)
            })
        }

        #[inline(never)]
        pub(super) fn $any(watch: &mut Watch<'_>) -> Tally {
            let maps: [[$float; 4]; 2] = core::hint::black_box([[0.0, 0.0, 1.0, 0.5], [0.5, 1.0, -1.0, 0.5]]);
            let inputs = PLACES.map(|u| u as $float / 4_294_967_296.0);
            watch.over(&inputs, |place| {
                let mut u = place;
                let (mut sum, mut factor): ($float, $float) = (0.0, 1.0);
                for _ in 0..$levels {
                    let [start, constant, linear, scaling] = maps[usize::from(u >= 0.5)];
                    u = (u - start) * 2.0;
                    sum = $fused(factor, $fused(linear, u, constant), sum);
                    factor *= scaling;
                    if u == 0.0 {
                        break;
                    }
                }
                $fold(sum)
            })
        }

        #[inline(never)]
        pub(super) fn $integral(watch: &mut Watch<'_>) -> Tally {
            let maps: [[$float; 5]; 2] =
                core::hint::black_box([[0.0, 0.0, 0.0, 0.5, 0.25], [0.5, 1.0, 1.0, -0.5, 0.25]]);
            watch.over(&PLACES, |u| {
                let (mut t, mut y): ($float, $float) = (0.0, 0.0);
                let mut digits = u >> 8;
                for _ in 0..24 {
                    let [start, constant, linear, square, scaling] = maps[(digits & 1) as usize];
                    y = $fused(scaling, y, $fused(t, $fused(square, t, linear), constant));
                    t = $fused(t, 0.5, start);
                    digits >>= 1;
                }
                $fold(y)
            })
        }
    };
}

walks!(dyadic_f32, any_f32, integral_f32, f32, mul_add, f32::to_bits, 24);
walks!(dyadic_f64, any_f64, integral_f64, f64, |a: f64, b: f64, c: f64| a * b + c, fold, 53);

/// The same counted by the level. In every format a walk ends where the 24 digits of its abscissa do.
macro_rules! by_level {
    ($($name:ident of $call:ident),*) => {$(
        pub(super) fn $name(watch: &mut Watch<'_>) -> Tally {
            let tally = $call(watch);
            Tally { units: 24 * tally.units, ..tally }
        }
    )*};
}

by_level!(dyadic_level of dyadic, dyadic_level_f32 of dyadic_f32, dyadic_level_f64 of dyadic_f64);
by_level!(compiled_level of compiled, any_level of any, any_level_f32 of any_f32, any_level_f64 of any_f64);

#[cfg(test)]
mod tests {
    use super::*;

    /// The walk of `dyadic_f64`, for one place.
    fn at(maps: [[f64; 5]; 2], u: u32) -> f64 {
        let (mut t, mut y) = (0.0, 0.0);
        for k in 8..32 {
            let [start, constant, linear, square, scaling] = maps[(u >> k & 1) as usize];
            y = scaling * y + t * (square * t + linear) + constant;
            t = t * 0.5 + start;
        }
        y
    }

    #[test]
    fn the_maps_written_in_floating_point_are_those_of_core() {
        let f = figure_1().unwrap();
        let integral = f.integral::<2>(Wide::ZERO).unwrap();
        for u in PLACES {
            let x = Wide::from_bits(i64::from(u) << 17);
            let float = at([[0.0, 0.0, 1.0, 0.0, 0.5], [0.5, 1.0, -1.0, 0.0, 0.5]], u);
            assert!((f.at(x).to_num::<f64>() - float).abs() < 1e-6, "f at {x}");
            let float = at([[0.0, 0.0, 0.0, 0.5, 0.25], [0.5, 1.0, 1.0, -0.5, 0.25]], u);
            assert!((integral.at(x).to_num::<f64>() - float).abs() < 1e-6, "integral at {x}: {float}");
        }
    }
}
