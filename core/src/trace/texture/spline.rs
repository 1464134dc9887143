//! Colours by a number: a smooth curve through given colours.
//!
//! A monotone piecewise cubic for each of red, green and blue: between two knots no part leaves the range of
//! their values, so that light never becomes negative. Where the values of a part turn round it is level, as
//! at both ends; elsewhere its slope is the harmonic mean of the secants on both sides, weighted with
//! `h0 + 2 h1` and `2 h0 + h1`, `h0` and `h1` the widths on both sides.
//!
//! Source: Fritsch, Carlson, "Monotone piecewise cubic interpolation", 1980; Fritsch, Butland, "A method for
//! constructing local monotone piecewise cubic interpolants", 1984. It is the spline `undulate` of the course
//! unit V, section 5.8.8.
//!
//! Format: parts of light 20 fractional bits, parts of a piece 30.

use core::num::NonZeroU32;

use crate::Error;
use crate::num::{Lumen, Rgb, Unit, Wide, high_u, product, ratio, reciprocal_of};

/// A number from -1 to 1 and its colour.
pub type Knot = (Unit, Rgb);

/// A curve through at most `N` knots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Spline<const N: usize> {
    pieces: [Piece; N],
    len: u8,
}

/// From a knot to the next one; after the last knot a constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Piece {
    /// Where it begins, 30 fractional bits.
    from: i32,
    /// The reciprocal of its width, as [`reciprocal_of`] has it.
    over: (i32, u32),
    /// Coefficients of 1, t, t^2 and t^3 for each part, `t` from 0 to 1 in the piece.
    cubics: [[i32; 4]; 3],
}

/// The brightest part of a knot's colour.
const BRIGHTEST: Lumen = Lumen::from_bits(64 << 16);

impl<const N: usize> Spline<N> {
    /// The curve through these knots.
    ///
    /// # Errors
    /// [`Error::TooFew`] for fewer than two knots, [`Error::Capacity`] for more than `N` or 255,
    /// [`Error::NotIncreasing`] where a knot is not to the right of the one before, [`Error::OutOfRange`] for
    /// a knot outside -1 to 1 or a part of a colour above 64.
    pub fn new(knots: &[Knot]) -> Result<Self, Error> {
        if knots.len() < 2 {
            return Err(Error::TooFew { what: "knots of the spline", given: knots.len(), at_least: 2 });
        }
        let capacity = N.min(255);
        if knots.len() > capacity {
            return Err(Error::Capacity { what: "knots of the spline", needed: knots.len(), capacity });
        }
        for (index, (x, color)) in knots.iter().enumerate() {
            let refuse =
                |what, value, min, max| Err(Error::OutOfRange { what, index: Some(index), value, min, max });
            if *x > Unit::ONE || *x < -Unit::ONE {
                return refuse("knot of the spline", (*x).into(), -Wide::ONE, Wide::ONE);
            }
            if color.brightest() > BRIGHTEST {
                let value = Wide::saturating_from_num(color.brightest());
                return refuse("colour of the spline", value, Wide::ZERO, Wide::from_num(64));
            }
        }
        if let Some(before) = knots.windows(2).position(|two| matches!(two, [a, b] if a.0 >= b.0)) {
            return Err(Error::NotIncreasing { what: "knot", index: before + 1 });
        }
        let pieces = core::array::from_fn(|i| Piece::new(knots, i));
        Ok(Self { pieces, len: knots.len() as u8 })
    }

    /// The colour of a number; that of the nearest knot beyond the ends.
    ///
    /// Domain: all. Error: below `2^-16` in each part, for parts up to 1
    /// (`a_spline_is_the_monotone_cubic_of_f64`). Cost: a comparison a knot, 10 multiplications.
    #[inline]
    pub fn at(&self, x: Unit) -> Rgb {
        let x = x.to_bits();
        let pieces = self.pieces.get(..usize::from(self.len)).unwrap_or_default();
        let Some(first) = pieces.first() else { return Rgb::BLACK };
        let piece = pieces.iter().rev().find(|piece| piece.from <= x).unwrap_or(first);
        // below 2^32, and no more than the width but in the last piece, which is a constant
        let along = x.max(piece.from).wrapping_sub(piece.from) as u32;
        let (mantissa, zeros) = piece.over;
        let t = high_u(along << (zeros & 31), mantissa as u32).min(1 << 30) as i32;
        let [r, g, b] = piece.cubics.map(|[a, b, c, d]| {
            let times_t = |v: i32| (product(v, t) >> 30) as i32;
            let value = a + times_t(b + times_t(c + times_t(d)));
            Lumen::from_bits((value.max(0) as u32 + 8) >> 4)
        });
        Rgb::new(r, g, b)
    }
}

impl Piece {
    fn new(knots: &[Knot], i: usize) -> Self {
        let none = Self { from: i32::MAX, over: (0, 0), cubics: [[0; 4]; 3] };
        let Some((from, color)) = knots.get(i) else { return none };
        let width = width(knots, i);
        let parts = |color: &Rgb| [color.r, color.g, color.b].map(|part| (part.to_bits() << 4) as i32);
        let starts = parts(color);
        let cubics = core::array::from_fn(|part| {
            let start = starts.get(part).copied().unwrap_or(0);
            if width == 0 {
                return [start, 0, 0, 0];
            }
            let rise = rise(knots, i, part) << 4;
            let (first, last) = (slope(knots, i, part, width), slope(knots, i + 1, part, width));
            // each at most 3 times the rise, of 64 with 20 fractional bits: sums of 9 rises fit
            [start, first, 3 * rise - 2 * first - last, first + last - 2 * rise]
        });
        let over = NonZeroU32::new(width).map_or((0, 0), reciprocal_of);
        Self { from: from.to_bits(), over, cubics }
    }
}

/// From knot `i` to the next, 30 fractional bits; 0 after the last.
fn width(knots: &[Knot], i: usize) -> u32 {
    match (knots.get(i), knots.get(i + 1)) {
        (Some(a), Some(b)) => b.0.to_bits().wrapping_sub(a.0.to_bits()) as u32,
        _ => 0,
    }
}

/// How much a part of the colour rises from knot `i` to the next, 16 fractional bits.
fn rise(knots: &[Knot], i: usize, part: usize) -> i32 {
    let value = |i: usize| {
        let color = knots.get(i).map_or(Rgb::BLACK, |knot| knot.1);
        [color.r, color.g, color.b].get(part).map_or(0, |part| part.to_bits() as i32)
    };
    value(i + 1) - value(i)
}

/// The slope at knot `i`, times a width on one of its sides, 20 fractional bits.
fn slope(knots: &[Knot], i: usize, part: usize, over: u32) -> i32 {
    let Some(before) = i.checked_sub(1) else { return 0 };
    if i + 1 >= knots.len() {
        return 0;
    }
    let (low, high) = (rise(knots, before, part), rise(knots, i, part));
    if low.signum() * high.signum() <= 0 {
        return 0;
    }
    // widths over their sum, 30 fractional bits
    let (h0, h1) = (u64::from(width(knots, before)), u64::from(width(knots, i)));
    let share = |h: u64| ratio(h, 30, h0 + h1);
    let (p, q) = (share(h0), (1 << 30) - share(h0));
    let (a, b) = (u64::from(low.unsigned_abs()), u64::from(high.unsigned_abs()));
    // 3 a b / ((1 + q) p b + (1 + p) q a): below 2^22 and 2^31, the sum below 2^54; the quotient at most 3
    // times the greater rise, here with 4 + 4 fractional bits more
    let weighted = ((((1 << 30) + q) * p) >> 30) * b + ((((1 << 30) + p) * q) >> 30) * a;
    let slope = ratio(3 * a * b, 38, weighted);
    // below 2^32 2^30
    let times_width = (slope.min(1 << 32) * share(over.into())) >> 34;
    times_width as i32 * low.signum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    fn grey(value: f64) -> Rgb {
        Rgb::grey(Lumen::from_num(value))
    }

    /// Fritsch and Butland's curve in floating point.
    fn exact(knots: &[(f64, f64)], x: f64) -> f64 {
        let last = knots.len() - 1;
        let (width, rise) = (|i: usize| knots[i + 1].0 - knots[i].0, |i: usize| knots[i + 1].1 - knots[i].1);
        let slope = |i: usize| {
            if i == 0 || i == last || rise(i - 1) * rise(i) <= 0.0 {
                return 0.0;
            }
            let (w, v) = (width(i - 1) + 2.0 * width(i), 2.0 * width(i - 1) + width(i));
            (w + v) / (w * width(i - 1) / rise(i - 1) + v * width(i) / rise(i))
        };
        let i = knots.iter().rposition(|knot| knot.0 <= x).unwrap_or(0).min(last - 1);
        let t = ((x - knots[i].0) / width(i)).clamp(0.0, 1.0);
        let (from, to) = (slope(i) * width(i), slope(i + 1) * width(i));
        let (square, cube) = (t * t, t * t * t);
        knots[i].1
            + rise(i) * (3.0 * square - 2.0 * cube)
            + from * (t - 2.0 * square + cube)
            + to * (cube - square)
    }

    const CURVES: [&[(f64, f64)]; 5] = [
        &[(-1.0, 0.0), (1.0, 1.0)],
        &[(-1.0, 0.25), (-0.5, 0.375), (0.0, 0.9375), (0.125, 1.0), (1.0, 0.0625)],
        &[(-0.75, 1.0), (-0.0625, 0.5), (0.25, 0.5), (0.3125, 0.125), (0.875, 0.0)],
        &[(0.0, 0.0), (0.001953125, 0.5), (0.00390625, 0.75), (1.0, 1.0)],
        &[(-1.0, 0.0), (-0.998046875, 0.001953125), (1.0, 1.0)],
    ];

    #[test]
    fn a_spline_is_the_monotone_cubic_of_f64() {
        let mut worst: f64 = 0.0;
        for curve in CURVES {
            let knots: Vec<Knot> = curve.iter().map(|(x, y)| (Unit::from_num(*x), grey(*y))).collect();
            let spline = Spline::<5>::new(&knots).unwrap();
            for i in -1100..=1100 {
                let x = f64::from(i) / 1000.0;
                let got = spline.at(Unit::from_num(x));
                assert!(got.r == got.g && got.g == got.b);
                let off = (got.r.to_num::<f64>() - exact(curve, x)).abs();
                worst = worst.max(off);
                assert!(off < 2_f64.powi(-16), "{curve:?} at {x}: {got:?}");
            }
            for (x, y) in &knots {
                assert_eq!(spline.at(*x), *y);
            }
        }
        assert!(worst > 2_f64.powi(-18), "{worst:e}");
    }

    /// Red, green and blue have curves of their own, and no part leaves the range of its neighbours.
    #[test]
    fn each_part_stays_between_its_values() {
        let colors = [[0, 64 << 16, 7], [64 << 16, 0, 8], [64 << 16, 1, 7], [0, 2, 64 << 16]];
        let knots: Vec<Knot> = colors
            .iter()
            .enumerate()
            .map(|(i, c)| {
                let [r, g, b] = c.map(Lumen::from_bits);
                (Unit::from_bits((i as i32 - 2) << 29), Rgb::new(r, g, b))
            })
            .collect();
        let spline = Spline::<7>::new(&knots).unwrap();
        for i in 0..3000_i32 {
            let x = -(1 << 30) + i * (1 << 19);
            let piece = ((x + (1 << 30)) >> 29).clamp(0, 2) as usize;
            let light = spline.at(Unit::from_bits(x));
            for (part, value) in [light.r, light.g, light.b].into_iter().enumerate() {
                let ends = [colors[piece][part], colors[piece + 1][part]];
                let (least, most) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
                assert!((least..=most).contains(&value.to_bits()), "{x} {part}: {value}");
            }
        }
    }

    #[test]
    fn knots_that_make_no_curve_are_refused() {
        let knot = |bits| (Unit::from_bits(bits), Rgb::WHITE);
        let refused = |knots: &[Knot]| Spline::<3>::new(knots).unwrap_err();
        assert!(matches!(refused(&[knot(0)]), Error::TooFew { given: 1, .. }));
        assert!(matches!(
            refused(&[knot(0), knot(1), knot(2), knot(3)]),
            Error::Capacity { capacity: 3, .. }
        ));
        assert!(matches!(refused(&[knot(0), knot(1), knot(1)]), Error::NotIncreasing { index: 2, .. }));
        for bits in [i32::MIN, i32::MAX, (1 << 30) + 1, -(1 << 30) - 1] {
            let knots = if bits < 0 { [knot(bits), knot(1)] } else { [knot(0), knot(bits)] };
            let index = Some(usize::from(bits > 0));
            assert!(matches!(refused(&knots), Error::OutOfRange { index: i, .. } if i == index), "{bits}");
        }
        let bright = (Unit::ONE, Rgb::new(Lumen::ZERO, Lumen::ZERO, BRIGHTEST + Lumen::DELTA));
        assert!(matches!(refused(&[knot(0), bright]), Error::OutOfRange { index: Some(1), .. }));
    }
}
