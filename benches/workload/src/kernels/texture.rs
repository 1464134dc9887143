//! Noise and turbulence.
//!
//! The loops in floating point are Perlin's reference implementation, with his gradients as sums of two
//! coordinates with signs.

use attractor::num::{Real, Vec3};
use attractor::trace::texture::{Lattice, Noise, PERMUTATION, Turbulence};

use super::watch::{Tally, Watch};
use crate::float::Float;
use crate::inputs::mixed;

/// Few: in floating point they are made on the stack.
const COUNT: usize = 64;
const OCTAVES: u8 = 4;

/// Places in noise, 16 fractional bits, within the 256 cells of its period.
static PLACES: [[i32; 3]; COUNT] = {
    let mut places = [[0; 3]; COUNT];
    let mut i = 0;
    while i < COUNT {
        let [a, b] = [mixed(2 * i), mixed(2 * i + 1)];
        places[i] = [a as i32 >> 8, (a >> 32) as i32 >> 8, b as i32 >> 8];
        i += 1;
    }
    places
};

#[inline(never)]
pub(super) fn noise_fixed(watch: &mut Watch<'_>) -> Tally {
    watch.over(&PLACES, |place| {
        let [x, y, z] = place.map(Lattice::from_bits);
        Noise::PERLIN.at(Vec3::new(x, y, z)).to_bits() as u32
    })
}

/// The unit is an octave, so that this is what one more costs.
#[inline(never)]
pub(super) fn turbulence_fixed(watch: &mut Watch<'_>) -> Tally {
    let Ok(turbulence) = Turbulence::new(Noise::PERLIN, Real::ONE, OCTAVES) else { return Tally::default() };
    let tally = watch.over(&PLACES, |place| {
        let [x, y, z] = place.map(Real::from_bits);
        turbulence.at(Vec3::new(x, y, z)).to_bits() as u32
    });
    Tally { units: tally.units * u32::from(OCTAVES), ..tally }
}

/// The same places in floating point: 16 or 24 fractional bits.
fn places<F: Float>(one: f64) -> [[F; 3]; COUNT] {
    PLACES.map(|place| place.map(|c| F::of(f64::from(c) / one)))
}

#[inline(never)]
pub(super) fn noise_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    watch.over(&places::<F>(65_536.0), |place| noise(place).fold())
}

#[inline(never)]
pub(super) fn turbulence_float<F: Float>(watch: &mut Watch<'_>) -> Tally {
    let tally = watch.over(&places::<F>(16_777_216.0), |place| turbulence(place).fold());
    Tally { units: tally.units * u32::from(OCTAVES), ..tally }
}

#[inline(always)]
fn turbulence<F: Float>(mut place: [F; 3]) -> F {
    let (mut sum, mut part) = (F::of(0.0), F::of(0.5));
    for _ in 0..OCTAVES {
        sum = part.fused(noise(place), sum);
        part = part * F::of(0.5);
        place = place.map(|c| c + c);
    }
    sum
}

#[inline(always)]
fn noise<F: Float>(place: [F; 3]) -> F {
    let cell = place.map(F::floor);
    let [x, y, z] = [0, 1, 2].map(|i| place[i] - F::of_int(cell[i]));
    let [i, j, k] = cell.map(|c| c as usize & 255);
    let one = F::of(1.0);
    let [u, v, w] = [x, y, z].map(fade);
    let p = |i: usize| usize::from(PERMUTATION[i & 255]);
    let (a, b) = (p(i) + j, p(i + 1) + j);
    let (aa, ab, ba, bb) = (p(a) + k, p(a + 1) + k, p(b) + k, p(b + 1) + k);
    let layer = |k: usize, z: F| {
        mix(
            v,
            mix(u, promise(p(aa + k), x, y, z), promise(p(ba + k), x - one, y, z)),
            mix(u, promise(p(ab + k), x, y - one, z), promise(p(bb + k), x - one, y - one, z)),
        )
    };
    mix(w, layer(0, z), layer(1, z - one))
}

#[inline(always)]
fn fade<F: Float>(t: F) -> F {
    t * t * t * t.fused(t.fused(F::of(6.0), F::of(-15.0)), F::of(10.0))
}

#[inline(always)]
fn mix<F: Float>(t: F, a: F, b: F) -> F {
    t.fused(b - a, a)
}

#[inline(always)]
fn promise<F: Float>(hash: usize, x: F, y: F, z: F) -> F {
    let h = hash & 15;
    let u = if h < 8 { x } else { y };
    let v = if h < 4 {
        y
    } else if h == 12 || h == 14 {
        x
    } else {
        z
    };
    (if h & 1 == 0 { u } else { -u }) + (if h & 2 == 0 { v } else { -v })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_in_floating_point_is_that_of_fixed_point() {
        for (i, place) in PLACES.iter().enumerate() {
            let [x, y, z] = place.map(Lattice::from_bits);
            let exact = Noise::PERLIN.at(Vec3::new(x, y, z)).to_num::<f64>();
            assert!((noise(places::<f64>(65_536.0)[i]) - exact).abs() < 1e-7, "{place:?}");
            assert!((f64::from(noise(places::<f32>(65_536.0)[i])) - exact).abs() < 1e-4, "{place:?}");
        }
        let octaves = Turbulence::new(Noise::PERLIN, Real::ONE, OCTAVES).unwrap();
        let [x, y, z] = PLACES[7].map(Real::from_bits);
        let exact = octaves.at(Vec3::new(x, y, z)).to_num::<f64>();
        assert!((turbulence(places::<f64>(16_777_216.0)[7]) - exact).abs() < 1e-4);
    }
}
