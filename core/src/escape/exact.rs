//! What the tests of this room compare with: dwell in `f64`, and in 248 fractional bits.

extern crate std;

use super::Complex;
use crate::num::Wide;

/// How two pictures differ.
#[derive(Debug, Default)]
pub(super) struct Difference {
    /// Pixels whose dwell differs.
    pub(super) pixels: u32,
    /// Pixels that are inside in one picture and outside in the other.
    pub(super) sides: u32,
    /// The greatest difference of a dwell.
    pub(super) greatest: u32,
    /// Pixels inside in the second: a picture of nothing proves nothing.
    pub(super) inside: u32,
}

impl Difference {
    pub(super) fn of(cols: u32, rows: u32, max: u32, mut pixel: impl FnMut(u32, u32) -> (u32, u32)) -> Self {
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
pub(super) fn dwell_float((mut x, mut y): (f64, f64), c: (f64, f64), max: u32) -> u32 {
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
pub(super) fn dwell_248(c: Complex<Wide>, max: u32) -> u32 {
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
