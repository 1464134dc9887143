//! An environment map: an image all round, infinitely far away.
//!
//! Longitude is the angle from the x axis towards the y axis, the image's width from 0 to a turn; latitude
//! its height, from straight down at the lower edge to straight up at the upper one. What a cone of
//! directions of angle `w` sees is the mean over `w / (2 pi cos latitude)` of the width and `w / pi` of the
//! height. Straight up and down there is no longitude: a cone sees all of them, a line that of the x axis.
//!
//! Source: the course unit V, section 5.8 (environment mapping: the mean over the region of the environment
//! that a pixel's area is reflected to).
//!
//! Format: angles 32 fractional bits of a turn, parts of the image 24.

use super::surroundings::Surroundings;
use super::texture::{Beyond, Image};
use crate::num::{Real, Rgb, Unit, Vec3, atan2, high_u, product, reciprocal, sqrt};

/// An image all round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Panorama<'a> {
    image: Image<'a>,
}

impl<'a> Panorama<'a> {
    /// The image by longitude and latitude; with coarser levels a mirror that is far away does not flicker.
    pub const fn new(image: Image<'a>) -> Self {
        Self { image: image.with_beyond(Beyond::Repeat, Beyond::Edge) }
    }
}

impl Surroundings for Panorama<'_> {
    /// Error: below `2^-13` away from the poles, for an image of 16 times 8 texels (row `Panorama::light`);
    /// of a wider one as much more as its texels are smaller.
    fn light(&self, direction: Vec3<Unit>, width: Unit) -> Rgb {
        let [x, y, z] = [direction.x, direction.y, direction.z].map(Unit::to_bits);
        let level = sqrt((product(x, x) as u64).wrapping_add(product(y, y) as u64)).min(1 << 30);
        let u = Real::from_bits((atan2(y, x).to_bits() >> 8) as i32);
        // from -1/4 to 1/4 of a turn
        let latitude = atan2(z, level as i32).to_bits() as i32;
        let v = Real::from_bits((latitude >> 7) + (1 << 23));
        /// `2^32 / pi`.
        const OVER_PI: u32 = 1_367_130_551;
        let up = high_u(width.max(Unit::ZERO).to_bits().unsigned_abs() >> 6, OVER_PI);
        let (mantissa, shift) = reciprocal(level);
        // half of it over the cosine, which has 30 fractional bits
        let across = (u64::from(up) * u64::from(mantissa)) >> (shift - 29);
        let part = |bits: u64| Real::from_bits(bits.min(1 << 24) as i32);
        self.image.mean(u, v, part(across), part(up.into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::texture::Texels;

    #[test]
    fn a_panorama_shows_what_is_in_each_direction() {
        // four longitudes, light above, dark below
        let bytes = [250, 200, 150, 100, 80, 60, 40, 20];
        let panorama = Panorama::new(Image::new(Texels::Linear, 4, 2, &bytes).unwrap());
        let at = |turn: f64, z: f64| {
            let (y, x) = (turn * core::f64::consts::TAU).sin_cos();
            let [x, y, z] = [x, y, z].map(Real::from_num);
            let direction = Vec3::new(x, y, z).normalised().unwrap();
            panorama.light(direction, Unit::ZERO).g.to_num::<f64>() * 255.0
        };
        for k in 0..4_u8 {
            let longitude = (f64::from(k) + 0.5) / 4.0;
            assert!((at(longitude, 1.0) - f64::from(bytes[usize::from(k)])).abs() < 0.1, "{k}");
            assert!((at(longitude, -1.0) - f64::from(bytes[usize::from(k) + 4])).abs() < 0.1, "{k}");
        }
        // the seam, the poles, and a wide cone
        assert!((at(0.0, 1.0) - 175.0).abs() < 0.1 && (at(1e-6, 1.0) - at(-1e-6, 1.0)).abs() < 0.1);
        // straight up has no longitude: the seam's
        let pole = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE);
        let light = panorama.light(pole, Unit::ZERO).g.to_num::<f64>() * 255.0;
        assert!((light - 175.0).abs() < 0.1, "{light}");
        // and with coarser levels a cone sees all of them
        let mut chain = std::vec![0; Image::length(Texels::Linear, 4, 2, 3)];
        chain[..8].copy_from_slice(&bytes);
        Image::write_levels(Texels::Linear, 4, 2, &mut chain).unwrap();
        let levels = Panorama::new(Image::new(Texels::Linear, 4, 2, &chain).unwrap());
        let light = levels.light(pole, Unit::from_num(0.001)).g.to_num::<f64>() * 255.0;
        let all = bytes.iter().map(|b| f64::from(*b)).sum::<f64>() / 8.0;
        assert!((light - all).abs() < 1.0, "{light} {all}");
        let level = Vec3::new(Unit::ONE, Unit::ZERO, Unit::ZERO);
        // without coarser levels two texels at most
        let wide = panorama.light(level, Unit::ONE).g.to_num::<f64>() * 255.0;
        assert!((wide - 112.5).abs() < 1.0, "{wide}");
    }
}
