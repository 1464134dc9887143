//! A plane cut through a texture: clouds, lava, wood and marble on a display without a ray tracer.
//!
//! The plane is `z` = constant; when `z` grows from picture to picture, noise flows.
//!
//! Source: the course unit V, section 5.8.4 (a solid texture is seen where a shape is cut out of it).

use embedded_graphics_core::geometry::Size;

use super::super::surface::{Chart, SurfacePoint};
use super::field::Texture;
use crate::num::{Real, Unit, Vec3};
use crate::plane::{Bounds2, Field, LinearRgb, Window};

/// A texture where a plane cuts it, as a field of the plane. Texture coordinates go from 0 to 1 over the
/// window.
///
/// ```
/// use attractor::num::{Real, Rgb, Unit};
/// use attractor::plane::{Bounds2, Field, Point2, Window};
/// use attractor::trace::texture::{Mottle, Noise, Slice, Spline, Turbulence};
/// use embedded_graphics::prelude::*;
///
/// let bounds = Bounds2 { min: Point2::lit("-2", "-2"), max: Point2::lit("2", "2") };
/// let window = Window::stretch(bounds, Size::new(64, 64))?;
/// let undulate = Spline::<2>::new(&[(Unit::lit("-0.3"), Rgb::BLACK), (Unit::lit("0.3"), Rgb::WHITE)])?;
/// let turbulence = Turbulence::new(Noise::PERLIN, Real::lit("1"), 4)?;
/// let clouds = Slice::new(Mottle { undulate, turbulence }, window, Real::lit("0.25"));
/// assert_ne!(clouds.at(10, 10), clouds.at(50, 40));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Slice<T> {
    texture: T,
    window: Window,
    z: Real,
    /// From pixel to pixel: along x and y with 40 fractional bits, of `u` and `v` with 40 too.
    steps: [i64; 2],
    parts: [i64; 2],
}

impl<T> Slice<T> {
    /// What a window shows of the plane at a height `z`.
    pub fn new(texture: T, window: Window, z: Real) -> Self {
        let (Bounds2 { min, max }, size) = (window.bounds(), window.size());
        let step = |low: Real, high: Real, count: u32| {
            let extent = (i64::from(high.to_bits()) - i64::from(low.to_bits())) << 16;
            extent.checked_div(count.into()).unwrap_or(extent)
        };
        let part = |count: u32| (1_i64 << 40).checked_div(count.into()).unwrap_or(0);
        Self {
            texture,
            window,
            z,
            steps: [step(min.x, max.x, size.width), step(min.y, max.y, size.height)],
            parts: [part(size.width), part(size.height)],
        }
    }

    /// The same at another height: the next picture of a film.
    #[must_use]
    pub fn at_height(self, z: Real) -> Self {
        Self { z, ..self }
    }

    /// The point that the middle of a pixel shows. Error: below `2^-22` in each coordinate
    /// (`a_pixel_shows_the_point_of_its_middle`).
    pub fn point(&self, x: u32, y: u32) -> SurfacePoint {
        let Bounds2 { min, max } = self.window.bounds();
        // a window has at most 2^14 pixels a side
        let along = |step: i64, k: u32| ((2 * i64::from(k & 0x3fff) + 1) * step) >> 17;
        let real = |bits: i64| Real::from_bits(bits.clamp(i32::MIN.into(), i32::MAX.into()) as i32);
        let [right, down] = [along(self.steps[0], x), along(self.steps[1], y)];
        let place = Vec3::new(
            real(i64::from(min.x.to_bits()) + right),
            real(i64::from(max.y.to_bits()) - down),
            self.z,
        );
        let extent = |low: Real, high: Real| high.saturating_sub(low);
        let chart = Chart {
            u: real(along(self.parts[0], x)),
            v: real((1 << 24) - along(self.parts[1], y)),
            along_u: Vec3::new(extent(min.x, max.x), Real::ZERO, Real::ZERO),
            along_v: Vec3::new(Real::ZERO, extent(min.y, max.y), Real::ZERO),
        };
        let width = real(self.steps[0].max(self.steps[1]) >> 16);
        let normal = Vec3::new(Unit::ZERO, Unit::ZERO, Unit::ONE);
        SurfacePoint { position: place, place, normal, inward: false, chart, face: 0, width }
    }
}

impl<T: Texture> Field for Slice<T> {
    type Value = LinearRgb;

    fn size(&self) -> Size {
        self.window.size()
    }

    #[inline]
    fn at(&self, x: u32, y: u32) -> LinearRgb {
        self.texture.at(&self.point(x, y)).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rgb;
    use crate::plane::Point2;

    #[test]
    fn a_pixel_shows_the_point_of_its_middle() {
        let real = |bits| Real::from_bits(bits);
        for (low, high, side) in [(-7 << 24, 5 << 24, 7), (i32::MIN, i32::MAX, 1 << 14), (0, 99, 3)] {
            let bounds =
                Bounds2 { min: Point2::new(real(low), real(low)), max: Point2::new(real(high), real(high)) };
            let window = Window::stretch(bounds, Size::new(side, side)).unwrap();
            let slice = Slice::new(Rgb::WHITE, window, Real::ONE).at_height(real(77));
            for k in [0, 1, side / 2, side - 1] {
                let point = slice.point(k, k);
                let part = (f64::from(k) + 0.5) / f64::from(side);
                let extent = f64::from(high) - f64::from(low);
                let off = |c: Real, exact: f64| (f64::from(c.to_bits()) - exact).abs();
                assert!(off(point.place.x, f64::from(low) + part * extent) < 2.0, "{k} of {side}");
                assert!(off(point.place.y, f64::from(high) - part * extent) < 2.0, "{k} of {side}");
                assert!(off(point.chart.u, part * 2_f64.powi(24)) < 2.0, "{k} of {side}");
                assert!(off(point.chart.v, (1.0 - part) * 2_f64.powi(24)) < 2.0, "{k} of {side}");
                assert_eq!((point.place.z, slice.at(k, k)), (real(77), Rgb::WHITE.into()));
            }
            assert_eq!(slice.size(), Size::new(side, side));
        }
    }
}
