//! What the tests of this room compare with: dwell in `f64`, and in 248 fractional bits; the orbits of the
//! 32-bit dwell in exact integers.

extern crate std;

use embedded_graphics_core::geometry::Size;
use std::vec::Vec;

use super::coloring::distance::Distance;
use super::coloring::smooth::FractionalDwell;
use super::coloring::smooth::Smooth;
use super::orbit::arithmetic::Arithmetic;
use crate::escape::orbit::dwell::tests::orbit;
use crate::escape::orbit::narrow::narrow;
use crate::escape::set::julia::Julia;
use crate::escape::set::mandelbrot::Mandelbrot;
use crate::escape::value::Dwell;
use crate::escape::view::shallow::View;
use crate::num::Complex;
use crate::num::{Real, Wide};

/// A pixel of a picture in 32-bit words, and the orbit whose dwell it shows.
pub(crate) struct Pixel {
    pub(crate) dwell: Dwell,
    pub(crate) smooth: FractionalDwell,
    /// In units of the plane, as the pitch.
    pub(crate) distance: Option<f64>,
    pub(crate) pitch: f64,
    /// From the first point to the first one beyond 2, none inside.
    pub(crate) orbit: Vec<(f64, f64)>,
    pub(crate) c: (f64, f64),
    /// What the derivative gains at each step.
    pub(crate) gain: f64,
}

/// Every pixel of the home view and others, of the Mandelbrot set and of a Julia set, in both arithmetics,
/// about the limit where the default changes.
pub(crate) fn every_pixel(mut check: impl FnMut(&Pixel)) {
    let point = |re: f64, im: f64| Complex::new(Wide::from_num(re), Wide::from_num(im));
    let view = |re, im, width| View::new(point(re, im), Wide::from_num(width), Size::new(96, 72)).unwrap();
    let views = [View::home(Size::new(150, 125)).unwrap(), view(-0.75, 0.1, 0.3), view(-1.25, 0.02, 0.2)];
    let seed = point(-0.8, 0.156);
    for (max, view) in [255, 256, 257].into_iter().flat_map(|max| views.map(|view| (max, view))) {
        let (set, julia) = (Mandelbrot::new(view, max).unwrap(), Julia::new(view, seed, max).unwrap());
        assert_eq!(set.arithmetic() == Arithmetic::Word26, max <= 256);
        let Size { width, height } = view.size();
        for at in (0..height).flat_map(|y| view.line(y, 0..width)) {
            let Some((x, y)) = narrow(at) else { continue };
            for arithmetic in [Arithmetic::Word26, Arithmetic::Word29] {
                let (set, julia) =
                    (set.with_arithmetic(arithmetic).unwrap(), julia.with_arithmetic(arithmetic).unwrap());
                // the conjugate, as in the picture
                let upper = (x, y.wrapping_abs());
                let values = (set.dwell_at(at), Smooth(set).value_at(at), Distance(set).value_at(at));
                check(&pixel(values, (upper, upper), 1.0, &view, arithmetic));
                let values = (julia.dwell_at(at), Smooth(julia).value_at(at), Distance(julia).value_at(at));
                check(&pixel(values, ((x, y), narrow(seed).unwrap()), 0.0, &view, arithmetic));
            }
        }
    }
}

fn pixel(
    (dwell, smooth, distance): (Dwell, FractionalDwell, Option<Real>),
    (z, c): ((i32, i32), (i32, i32)),
    gain: f64,
    view: &View,
    arithmetic: Arithmetic,
) -> Pixel {
    let unit = 2_f64.powi(-29);
    let mut points = Vec::new();
    if !dwell.is_inside() {
        let orbit = orbit(z, c, arithmetic == Arithmetic::Word26);
        points.extend(orbit.map(|z| z.map(|v| v as f64 * unit)).map(|[x, y]| (x, y)));
        assert_eq!(dwell.count as usize + 1, points.len());
    }
    let c = (f64::from(c.0) * unit, f64::from(c.1) * unit);
    let pitch = view.pitch().to_num::<f64>();
    let distance = distance.map(|d| d.to_num::<f64>() * pitch);
    Pixel { dwell, smooth, distance, pitch, orbit: points, c, gain }
}

/// How two pictures differ.
#[derive(Debug, Default)]
pub(crate) struct Difference {
    /// Pixels whose dwell differs.
    pub(crate) pixels: u32,
    /// Pixels that are inside in one picture and outside in the other.
    pub(crate) sides: u32,
    /// The greatest difference of a dwell.
    pub(crate) greatest: u32,
    /// Pixels inside in the second: a picture of nothing proves nothing.
    pub(crate) inside: u32,
}

impl Difference {
    pub(crate) fn of(cols: u32, rows: u32, max: u32, mut pixel: impl FnMut(u32, u32) -> (u32, u32)) -> Self {
        let mut difference = Self::default();
        for (x, y) in (0..rows).flat_map(|y| (0..cols).map(move |x| (x, y))) {
            let (got, want) = pixel(x, y);
            difference.pixels += u32::from(got != want);
            difference.sides += u32::from((got == max) != (want == max));
            difference.greatest = difference.greatest.max(got.abs_diff(want));
            difference.inside += u32::from(want == max);
        }
        difference
    }
}

/// `min(iterations until |z| > 2, max)` in `f64`.
pub(crate) fn dwell_float((mut x, mut y): (f64, f64), c: (f64, f64), max: u32) -> u32 {
    for n in 0..max {
        if x * x + y * y > 4.0 {
            return n;
        }
        (x, y) = (x * x - y * y + c.0, 2.0 * x * y + c.1);
    }
    max
}

/// A number below 128 in magnitude: sign, and 248 fractional bits, least limb first.
#[derive(Clone, Copy)]
struct Big(bool, [u64; 4]);

impl Big {
    fn new(v: Wide) -> Self {
        // 48 fractional bits: 200 places up, that is three limbs and 8 bits
        let m = v.to_bits().unsigned_abs();
        Self(v < 0, [0, 0, 0, m << 8])
    }

    fn times(self, other: Self) -> Self {
        let mut limbs = [0_u64; 8];
        for (i, a) in self.1.iter().enumerate() {
            let mut carry = 0_u128;
            for (j, b) in other.1.iter().enumerate() {
                carry += u128::from(*a) * u128::from(*b) + u128::from(limbs[i + j]);
                limbs[i + j] = carry as u64;
                carry >>= 64;
            }
            limbs[i + 4] = carry as u64;
        }
        // 496 fractional bits, 248 too many: three limbs and 56 bits
        let limb = |k: usize| (limbs[k + 3] >> 56) | (limbs[k + 4] << 8);
        Self(self.0 != other.0, [limb(0), limb(1), limb(2), limb(3)])
    }

    fn plus(self, other: Self) -> Self {
        if self.0 == other.0 {
            let mut carry = 0_u128;
            let sum = core::array::from_fn(|k| {
                carry += u128::from(self.1[k]) + u128::from(other.1[k]);
                let limb = carry as u64;
                carry >>= 64;
                limb
            });
            return Self(self.0, sum);
        }
        let (large, small) =
            if self.1.iter().rev().ge(other.1.iter().rev()) { (self, other) } else { (other, self) };
        let mut borrow = false;
        let difference = core::array::from_fn(|k| {
            let (d, b1) = large.1[k].overflowing_sub(small.1[k]);
            let (d, b2) = d.overflowing_sub(u64::from(borrow));
            borrow = b1 || b2;
            d
        });
        Self(large.0, difference)
    }
}

/// The dwell of the orbit of 0 under `z^2 + c`.
pub(crate) fn dwell_248(c: Complex<Wide>, max: u32) -> u32 {
    if c.re.abs() > 4 || c.im.abs() > 4 {
        return 0;
    }
    let (cx, cy) = (Big::new(c.re), Big::new(c.im));
    let (mut x, mut y) = (cx, cy);
    for n in 0..max {
        let (xx, yy) = (x.times(x), y.times(y));
        let square = xx.plus(yy).1;
        if square[3] >= 4 << 56 && square != [0, 0, 0, 4 << 56] {
            return n;
        }
        let xy = x.times(y);
        (x, y) = (xx.plus(Big(!yy.0, yy.1)).plus(cx), xy.plus(xy).plus(cy));
    }
    max
}

#[test]
fn the_248_bits_agree_with_float_where_both_are_exact() {
    for (a, b) in [(1.5, 1.25), (-1.5, 1.25), (0.75, -2.0), (-2.0, -1.0), (0.0, 1.0), (1.0, -1.0)] {
        let value = |b: Big| {
            let top = b.1[3] as f64 / 2_f64.powi(56);
            if b.0 { -top } else { top }
        };
        let (p, q) = (Big::new(Wide::from_num(a)), Big::new(Wide::from_num(b)));
        assert_eq!(value(p.times(q)), a * b);
        assert_eq!(value(p.plus(q)), a + b);
    }
}
