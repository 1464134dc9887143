//! A checker: cubes in space, or squares of texture coordinates, of two textures in turn.
//!
//! Which one a place has tells the parity of `floor(f_x x + o) + floor(f_y y + o) + floor(f_z z + o)`. The
//! offset `o` is about `2^-11.7`: without it a plane that lies exactly between two layers of cubes, as
//! `z = 0` does, would have points a rounding error above and a rounding error below it, and be speckled.
//! Seams that are wanted are at round numbers, and no round number lies at `-o`.
//!
//! Source: the course unit V, section 5.8.4.
//!
//! Format: `f x` with 24 fractional bits in 64.

use super::super::surface::SurfacePoint;
use super::field::Texture;
use crate::num::{Real, Rgb, product};

/// How far seams are moved towards smaller coordinates, in cubes: a part of `2^-11` that no decimal of few
/// digits has.
const OFFSET: Real = Real::from_bits(5_063);

/// Cubes or squares of two textures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Checker<A = Rgb, B = A> {
    even: A,
    odd: B,
    frequency: [Real; 3],
    charted: bool,
}

impl<A, B> Checker<A, B> {
    /// Cubes, so many to a unit along `x`, `y` and `z`, that of the origin `even`.
    pub const fn cubes(frequency: [Real; 3], even: A, odd: B) -> Self {
        Self { even, odd, frequency, charted: false }
    }

    /// Squares, so many to a unit of `u` and of `v`. Round a shape a whole even number has no seam.
    pub const fn squares([across, up]: [Real; 2], even: A, odd: B) -> Self {
        Self { even, odd, frequency: [across, up, Real::ZERO], charted: true }
    }

    /// Whether a point is in a cube of the odd texture. Exact, but for the offset
    /// (`cubes_take_turns_and_planes_between_them_have_one_colour`).
    pub fn is_odd(&self, point: &SurfacePoint) -> bool {
        let coordinates = if self.charted {
            [point.chart.u, point.chart.v, Real::ZERO]
        } else {
            [point.place.x, point.place.y, point.place.z]
        };
        let layers = coordinates.iter().zip(self.frequency).map(|(c, frequency)| {
            let scaled = product(c.to_bits(), frequency.to_bits()) >> 24;
            (scaled + i64::from(OFFSET.to_bits())) >> 24
        });
        layers.sum::<i64>() & 1 > 0
    }
}

impl<A: Texture, B: Texture> Texture for Checker<A, B> {
    fn is_charted(&self) -> bool {
        self.charted || self.even.is_charted() || self.odd.is_charted()
    }

    #[inline]
    fn at(&self, point: &SurfacePoint) -> Rgb {
        if self.is_odd(point) { self.odd.at(point) } else { self.even.at(point) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{charted, placed};
    use super::*;

    #[test]
    fn cubes_take_turns_and_planes_between_them_have_one_colour() {
        let frequency = [1.0, 2.0, 0.75];
        let checker = Checker::cubes(frequency.map(Real::from_num), Rgb::BLACK, Rgb::WHITE);
        let mut odd = 0;
        for n in 0..3000_i32 {
            let place = [0x2545_f491, 0x6c07_8965, 0x1f12_3bb5].map(|c: i32| c.wrapping_mul(n) >> 4);
            let scaled: [f64; 3] =
                core::array::from_fn(|i| f64::from(place[i]) / f64::from(1 << 24) * frequency[i]);
            if scaled.iter().any(|c| (c - c.round()).abs() < 0.001) {
                continue;
            }
            let even = scaled.iter().map(|c| c.floor()).sum::<f64>() % 2.0 == 0.0;
            let light = checker.at(&placed(place));
            assert_eq!(light, if even { Rgb::BLACK } else { Rgb::WHITE }, "{scaled:?}");
            odd += u32::from(!even);
        }
        assert!((1300..1700).contains(&odd), "{odd}");
        // a plane at an integer, met a rounding error above and below
        for height in [-3, -1, 0, 1, 2, 100] {
            for n in 0..200_i32 {
                let place = [n.wrapping_mul(77_777) >> 1, n.wrapping_mul(-99_999) >> 1, height << 24];
                let light = |off: i32| checker.at(&placed([place[0], place[1], place[2] + off]));
                for off in [-255, -16, -1, 1, 16] {
                    assert_eq!(light(off), light(0), "{place:?} {off}");
                }
            }
        }
    }

    #[test]
    fn squares_look_at_texture_coordinates_and_an_even_number_closes_round_a_shape() {
        let checker = Checker::squares([8, 4].map(Real::from_num), Rgb::BLACK, Rgb::WHITE);
        assert!(checker.is_charted() && !Checker::cubes([Real::ONE; 3], Rgb::BLACK, Rgb::WHITE).is_charted());
        let is_odd = |u: f64, v: f64| checker.is_odd(&charted(Real::from_num(u), Real::from_num(v)));
        assert_eq!(
            [(0.01, 0.01), (0.13, 0.01), (0.13, 0.26), (0.01, 0.26)].map(|(u, v)| is_odd(u, v)),
            [false, true, false, true]
        );
        // the square before the seam is another one than that behind it, as everywhere
        assert_ne!(is_odd(0.99, 0.3), is_odd(0.01, 0.3));
    }
}
