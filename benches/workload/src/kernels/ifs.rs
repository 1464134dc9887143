//! One point of Barnsley's fern: a word of xoshiro128++, an alias draw, an affine map.

use attractor::ifs::catalogue::BARNSLEY_FERN;
use attractor::num::Alias;
use attractor::rand_xoshiro::Xoshiro128PlusPlus;
use attractor::rand_xoshiro::rand_core::{Rng, SeedableRng};

use super::{Tally, Watch, fold};
use crate::float::mul_add;

const POINTS: u32 = 2048;
const SEED: u64 = 7;

#[inline(never)]
pub(super) fn fern_fixed(watch: &mut Watch<'_>) -> Tally {
    let Ok(fern) = BARNSLEY_FERN.ifs::<4>() else { return Tally::default() };
    let start = fern.seeded_chaos_game(SEED);
    watch.time(|| {
        let mut checksum = 0_u32;
        for point in start.clone().take(POINTS as usize) {
            checksum = checksum.rotate_left(1) ^ point.x.to_bits() as u32 ^ point.y.to_bits() as u32;
        }
        Tally { checksum, units: POINTS }
    })
}

macro_rules! fern {
    ($name:ident, $float:ty, $fused:expr, $fold:expr) => {
        /// The same generator and the same alias table, which are integers anyway.
        #[inline(never)]
        pub(super) fn $name(watch: &mut Watch<'_>) -> Tally {
            let weights = [0, 1, 2, 3].map(|i| BARNSLEY_FERN.probabilities[i].to_bits() as u32);
            let Ok(alias) = Alias::<4>::new(&weights) else { return Tally::default() };
            let maps: [[$float; 6]; 4] = [0, 1, 2, 3].map(|i| {
                let m = &BARNSLEY_FERN.maps[i];
                let [a, b, c, d] = [m.a, m.b, m.c, m.d].map(|v| v.to_num::<$float>());
                [a, b, c, d, m.e.to_num::<$float>(), m.f.to_num::<$float>()]
            });
            let maps = core::hint::black_box(maps);
            let start = Xoshiro128PlusPlus::seed_from_u64(SEED);
            watch.time(|| {
                let mut rng = start.clone();
                let (mut x, mut y): ($float, $float) = (0.0, 0.0);
                let mut checksum = 0_u32;
                for _ in 0..POINTS {
                    let [a, b, c, d, e, f] = maps[alias.pick(rng.next_u32()) & 3];
                    (x, y) = ($fused(a, x, $fused(b, y, e)), $fused(c, x, $fused(d, y, f)));
                    checksum = checksum.rotate_left(1) ^ $fold(x) ^ $fold(y);
                }
                Tally { checksum, units: POINTS }
            })
        }
    };
}

fern!(fern_f32, f32, mul_add, f32::to_bits);
fern!(fern_f64, f64, |a: f64, b: f64, c: f64| a * b + c, fold);
