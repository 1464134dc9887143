//! Points of Barnsley's fern by the chaos game (a word of xoshiro128++, an alias draw, an affine map), alone
//! and counted in pixels, and by the copier; its moments.

use core::hint::black_box;

use attractor::Error;
use attractor::ifs::ChaosGame;
use attractor::ifs::catalogue::BARNSLEY_FERN;
use attractor::num::{Alias, Real};
use attractor::plane::{Bounds2, Field, PathElement, Point2, Window};
use attractor::plane::{Counter, Density, Hits};
use attractor::rand_xoshiro::Xoshiro128PlusPlus;
use attractor::rand_xoshiro::rand_core::{Rng, SeedableRng};

use embedded_graphics::geometry::Size;

use super::watch::{Tally, Watch};
use crate::float::{fold, mul_add};

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

/// The alias table and the maps of the fern.
macro_rules! fern {
    ($float:ty) => {{
        let weights = [0, 1, 2, 3].map(|i| BARNSLEY_FERN.probabilities[i].to_bits() as u32);
        let maps: [[$float; 6]; 4] = [0, 1, 2, 3].map(|i| {
            let m = &BARNSLEY_FERN.maps[i];
            let [a, b, c, d] = [m.a, m.b, m.c, m.d].map(|v| v.to_num::<$float>());
            [a, b, c, d, m.e.to_num::<$float>(), m.f.to_num::<$float>()]
        });
        Alias::<4>::new(&weights).map(|alias| (alias, black_box(maps)))
    }};
}

macro_rules! game {
    ($name:ident, $float:ty, $fused:expr, $fold:expr) => {
        /// The same generator and the same alias table, which are integers anyway.
        #[inline(never)]
        pub(super) fn $name(watch: &mut Watch<'_>) -> Tally {
            let Ok((alias, maps)) = fern!($float) else { return Tally::default() };
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

game!(fern_f32, f32, mul_add, f32::to_bits);
game!(fern_f64, f64, |a: f64, b: f64, c: f64| a * b + c, fold);

/// Pixels a side of the counts.
const SIDE: u32 = 64;
const PIXELS: usize = (SIDE * SIDE) as usize;
type Game<'a> = ChaosGame<'a, Xoshiro128PlusPlus, 4>;

/// A game counted in pixels. `digest` is what a pixel leaves for the checksum, after the clock has stopped.
fn counted<C: Counter>(
    watch: &mut Watch<'_>,
    (counts, maps): (&mut [C], &mut [u8]),
    play: impl Fn(&mut Density<'_, C>, Game<'_>),
) -> Result<Tally, Error> {
    let fern = BARNSLEY_FERN.ifs::<4>()?;
    let window = Window::fit(fern.bounds(), Size::new(SIDE, SIDE))?;
    let mut density = Density::new(window, counts)?;
    if !maps.is_empty() {
        density = density.with_maps(maps)?;
    }
    let start = fern.seeded_chaos_game(SEED);
    let tally = watch.time(|| {
        play(&mut density, start.clone());
        Tally { checksum: 0, units: POINTS }
    });
    let toned = density.linear(1);
    let pixels = (0..SIDE).flat_map(|y| toned.row(y, 0..SIDE));
    let digest =
        |sum: u32, pixel: Hits| sum.rotate_left(1) ^ u32::from(pixel.count) ^ u32::from(pixel.map) << 16;
    Ok(Tally { checksum: pixels.fold(0, digest), ..tally })
}

fn all<C: Counter>(density: &mut Density<'_, C>, game: Game<'_>) {
    density.extend(game.take(POINTS as usize));
}

#[inline(never)]
pub(super) fn density_u16(watch: &mut Watch<'_>) -> Tally {
    counted(watch, (&mut [0_u16; PIXELS], &mut []), all).unwrap_or_default()
}

#[inline(never)]
pub(super) fn density_u8(watch: &mut Watch<'_>) -> Tally {
    counted(watch, (&mut [0_u8; PIXELS], &mut []), all).unwrap_or_default()
}

#[inline(never)]
pub(super) fn density_with_maps(watch: &mut Watch<'_>) -> Tally {
    let play = |density: &mut Density<'_, u16>, game: Game<'_>| {
        density.extend(game.labelled().take(POINTS as usize));
    };
    counted(watch, (&mut [0_u16; PIXELS], &mut [0; PIXELS]), play).unwrap_or_default()
}

macro_rules! density {
    ($name:ident, $float:ty, $fused:expr) => {
        /// The same game and the same counters: two products, two truncations, a saturating increment.
        #[inline(never)]
        pub(super) fn $name(watch: &mut Watch<'_>) -> Tally {
            let Ok((alias, maps)) = fern!($float) else { return Tally::default() };
            let Ok(fern) = BARNSLEY_FERN.ifs::<4>() else { return Tally::default() };
            let Ok(window) = Window::fit(fern.bounds(), Size::new(SIDE, SIDE)) else {
                return Tally::default();
            };
            let Bounds2 { min, max } = window.bounds();
            let (left, top) = black_box((min.x.to_num::<$float>(), max.y.to_num::<$float>()));
            let scale = black_box(SIDE as $float / (max.x - min.x).to_num::<$float>());
            let start = Xoshiro128PlusPlus::seed_from_u64(SEED);
            let mut counts = [0_u16; PIXELS];
            watch.time(|| {
                let mut rng = start.clone();
                let (mut x, mut y): ($float, $float) = (0.0, 0.0);
                for _ in 0..POINTS {
                    let [a, b, c, d, e, f] = maps[alias.pick(rng.next_u32()) & 3];
                    (x, y) = ($fused(a, x, $fused(b, y, e)), $fused(c, x, $fused(d, y, f)));
                    let (column, row) = (((x - left) * scale) as u32, ((top - y) * scale) as u32);
                    if column < SIDE
                        && let Some(count) = counts.get_mut((row * SIDE + column) as usize)
                    {
                        *count = count.saturating_add(1);
                    }
                }
                Tally {
                    checksum: black_box(&counts).iter().fold(0, |sum, c| sum ^ u32::from(*c)),
                    units: POINTS,
                }
            })
        }
    };
}

#[inline(never)]
pub(super) fn moments(watch: &mut Watch<'_>) -> Tally {
    let Ok(fern) = BARNSLEY_FERN.ifs::<4>() else { return Tally::default() };
    watch.time(|| {
        let Ok(moments) = black_box(&fern).moments() else { return Tally::default() };
        let parts = moments.mean.iter().chain(&moments.covariance);
        let checksum = parts.fold(0_u32, |sum, v| sum.rotate_left(1) ^ v.to_bits() as u32);
        Tally { checksum, units: 1 }
    })
}

#[inline(never)]
pub(super) fn system(watch: &mut Watch<'_>) -> Tally {
    watch.time(|| {
        let Ok(fern) = black_box(&BARNSLEY_FERN).ifs::<4>() else { return Tally::default() };
        Tally { checksum: fern.contraction_factor().to_bits() as u32 ^ fern.deviation(), units: 1 }
    })
}

#[inline(never)]
pub(super) fn bounds(watch: &mut Watch<'_>) -> Tally {
    let Ok(fern) = BARNSLEY_FERN.ifs::<4>() else { return Tally::default() };
    watch.time(|| {
        let Bounds2 { min, max } = black_box(&fern).bounds();
        let parts = [min.x, min.y, max.x, max.y];
        let checksum = parts.iter().fold(0_u32, |sum, v| sum.rotate_left(1) ^ v.to_bits() as u32);
        Tally { checksum, units: 1 }
    })
}

/// The order of the copies that are counted.
const ORDER: usize = 5;
const NEAR: Point2 = Point2::new(Real::lit("0.5"), Real::lit("0.25"));
const FAR: Point2 = Point2::new(Real::lit("-1.5"), Real::lit("9"));

#[inline(never)]
pub(super) fn copied_point(watch: &mut Watch<'_>) -> Tally {
    let Ok(fern) = BARNSLEY_FERN.ifs::<4>() else { return Tally::default() };
    let Ok(copier) = fern.copier::<12>(&[NEAR], ORDER as u32) else { return Tally::default() };
    watch.time(|| {
        let mut tally = Tally::default();
        for p in copier.clone().points() {
            tally.checksum = tally.checksum.rotate_left(1) ^ p.x.to_bits() as u32 ^ p.y.to_bits() as u32;
            tally.units += 1;
        }
        tally
    })
}

#[inline(never)]
pub(super) fn copied_path(watch: &mut Watch<'_>) -> Tally {
    let Ok(fern) = BARNSLEY_FERN.ifs::<4>() else { return Tally::default() };
    let Ok(copier) = fern.copier::<12>(&[NEAR, FAR, NEAR, FAR], ORDER as u32) else {
        return Tally::default();
    };
    watch.time(|| {
        let mut tally = Tally::default();
        for PathElement::MoveTo(p) | PathElement::LineTo(p) in copier.clone().path() {
            tally.checksum = tally.checksum.rotate_left(1) ^ p.x.to_bits() as u32 ^ p.y.to_bits() as u32;
            tally.units += 1;
        }
        tally
    })
}

macro_rules! copied {
    ($name:ident, $float:ty, $fused:expr, $fold:expr) => {
        /// The same stack of composed maps.
        #[inline(never)]
        pub(super) fn $name(watch: &mut Watch<'_>) -> Tally {
            let Ok((_, maps)) = fern!($float) else { return Tally::default() };
            let (px, py): ($float, $float) = black_box((0.5, 0.25));
            watch.time(|| {
                let mut tally = Tally::default();
                let identity: [$float; 6] = [1.0, 0.0, 0.0, 1.0, 0.0, 0.0];
                let mut stack = [(identity, 0_usize); ORDER];
                let mut level = 0;
                loop {
                    let ([a, b, c, d, e, f], next) = stack[level];
                    if next == 4 {
                        if level == 0 {
                            break tally;
                        }
                        level -= 1;
                        continue;
                    }
                    stack[level].1 += 1;
                    let [p, q, r, s, t, u] = maps[next];
                    let below: [$float; 6] = [
                        $fused(a, p, b * r),
                        $fused(a, q, b * s),
                        $fused(c, p, d * r),
                        $fused(c, q, d * s),
                        $fused(a, t, $fused(b, u, e)),
                        $fused(c, t, $fused(d, u, f)),
                    ];
                    if level + 1 < ORDER {
                        level += 1;
                        stack[level] = (below, 0);
                        continue;
                    }
                    let [a, b, c, d, e, f] = below;
                    let (x, y): ($float, $float) =
                        ($fused(a, px, $fused(b, py, e)), $fused(c, px, $fused(d, py, f)));
                    tally.checksum = tally.checksum.rotate_left(1) ^ $fold(x) ^ $fold(y);
                    tally.units += 1;
                }
            })
        }
    };
}

density!(density_f32, f32, mul_add);
density!(density_f64, f64, |a: f64, b: f64, c: f64| a * b + c);
copied!(copied_f32, f32, mul_add, f32::to_bits);
copied!(copied_f64, f64, |a: f64, b: f64, c: f64| a * b + c, fold);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floating_point_makes_as_many_copies() {
        let units =
            |work: fn(&mut Watch<'_>) -> Tally| work(&mut Watch::new(&mut crate::machine::Blind, 1)).units;
        assert_eq!([copied_point, copied_f32, copied_f64].map(units), [4_u32.pow(5); 3]);
        assert_eq!(units(copied_path), 4 * 4_u32.pow(5));
    }

    #[test]
    fn both_counters_count_the_same_points() {
        let run = |work: fn(&mut Watch<'_>) -> Tally| work(&mut Watch::new(&mut crate::machine::Blind, 1));
        assert_eq!(run(density_u16), run(density_u8));
        assert_ne!(run(density_u16).checksum, run(density_with_maps).checksum);
    }
}
