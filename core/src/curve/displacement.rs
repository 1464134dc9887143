//! Laws of displacement: what tells one random curve from another is where the midpoint of a part lies.
//!
//! [`super::Subdivision`] halves parts and asks a [`Displacement`] for each midpoint. What displaces points
//! of the plane, a law of your own too, can use one formula: `p_m = (p_1 + p_2) / 2 + g (p_2 - p_1)` for a
//! complex `g`, whose real part displaces along the part and whose imaginary part along the perpendicular
//! bisector ([`displaced`]).
//!
//! Formats: points in [`Real`], `g` with 28 fractional bits; one rounding a coordinate.

use crate::Error;
use crate::num::formats::{Q28, Q52, UQ30};
use crate::num::{Deviate, Parameter};
use crate::num::{Real, Wide, decay, product, product_shifted};
use crate::plane::Point2;

/// How often a part between two knots can be halved at most: the parameter has 32 fractional bits.
pub(super) const LEVELS: usize = 32;

/// A part of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Part {
    /// Its first point.
    pub from: Point2,
    /// Its last.
    pub to: Point2,
    /// The parameter of the point between them.
    pub middle: Parameter,
    /// How often the interval between the knots has been halved, below 32.
    pub level: u32,
    /// How much `x` grows between the knots.
    pub span: Real,
}

/// A law of random displacement. The midpoint must depend on nothing but the part.
pub trait Displacement {
    /// The new point in the middle of a part.
    fn midpoint(&self, part: &Part) -> Point2;

    /// Whether a curve can pass through these knots.
    ///
    /// # Errors
    /// What is wrong with them. Without an implementation: nothing.
    fn check(&self, knots: &[Point2]) -> Result<(), Error> {
        let _ = knots;
        Ok(())
    }
}

/// The midpoint for `g = along + across i`.
#[inline]
pub fn displaced(part: &Part, along: Deviate, across: Deviate) -> Point2 {
    let (from, to) = (part.from, part.to);
    let (dx, dy) = (to.x.saturating_sub(from.x), to.y.saturating_sub(from.y));
    let (g, h, dx, dy) = (along.to_bits(), across.to_bits(), dx.to_bits(), dy.to_bits());
    // |p1 + p2| <= 2^32 and each product is at most 2^62: the second sum saturates, the first cannot
    let x = (middle_q52(from.x, to.x) + product(dx, g)).saturating_sub(product(dy, h));
    let y = (middle_q52(from.y, to.y) + product(dy, g)).saturating_add(product(dx, h));
    Point2::new(rounded(x), rounded(y))
}

/// The midpoint for `g = across i`.
#[inline(always)]
pub(super) fn raised_across(part: &Part, across: Q28) -> Point2 {
    let (from, to) = (part.from, part.to);
    if cfg!(no_long_product)
        && let Some(middle) = raised_by_halves(from, to, across)
    {
        return middle;
    }
    raised_in_full(from, to, across)
}

/// For any part; where products are made by halves it is asked seldom.
#[cfg_attr(no_long_product, cold, inline(never))]
#[cfg_attr(not(no_long_product), inline(always))]
fn raised_in_full(from: Point2, to: Point2, across: Q28) -> Point2 {
    let (dx, dy) = (to.x.saturating_sub(from.x), to.y.saturating_sub(from.y));
    Point2::new(raised(from.x, to.x, dy, across.wrapping_neg()), raised(from.y, to.y, dx, across))
}

/// The same bits at half the cost for a machine without a long product, when the part is shorter than 16,
/// begins within ±64, and `|across| < 2`: `a + (d + 1 + 2 g l) / 2` in words.
#[inline(always)]
fn raised_by_halves(from: Point2, to: Point2, across: Q28) -> Option<Point2> {
    let [a, b] = [from.x, from.y].map(Real::to_bits);
    // a difference that leaves its format comes back as 2^30 or more: the part begins within ±64
    let (dx, dy) = (to.x.to_bits().wrapping_sub(a), to.y.to_bits().wrapping_sub(b));
    // what is outside -2^28 .. 2^28 has one of the upper three bits of this
    let shifted = |v: i32| v.wrapping_add(1 << 28) as u32;
    let far = (a.wrapping_add(1 << 30) | b.wrapping_add(1 << 30)) as u32 >> 31;
    if far | (shifted(dx) | shifted(dy) | shifted(across >> 1)) >> 29 != 0 {
        return None;
    }
    // twice the height is at most 2^30: no sum leaves 32 bits
    let raised = |a: i32, d: i32, length: i32| {
        let twice = product_shifted::<27>(length, across, 0).wrapping_add(d).wrapping_add(1);
        Real::from_bits(a.wrapping_add(twice >> 1))
    };
    Some(Point2::new(raised(a, dx, dy.wrapping_neg()), raised(b, dy, dx)))
}

/// The midpoint of two coordinates raised by `g` times a length.
#[inline]
pub(super) fn raised(a: Real, b: Real, length: Real, g: Q28) -> Real {
    // below 2^60 + 2^62
    rounded(middle_q52(a, b) + product(length.to_bits(), g))
}

/// `(a + b) / 2`, and the half unit that rounds to 24 fractional bits.
#[inline]
fn middle_q52(a: Real, b: Real) -> Q52 {
    ((i64::from(a.to_bits()) + i64::from(b.to_bits())) << 27) + (1 << 27)
}

/// A sum as a coordinate, saturated.
#[inline]
fn rounded(sum: Q52) -> Real {
    Real::from_bits((sum >> 28).clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32)
}

/// The product, rounded. For offsets of at most 2 and deviates of at most 3.4 it stays below 8.
#[inline]
pub(super) fn product_q28(a: Q28, b: Q28) -> Q28 {
    product_shifted::<28>(a, b, 1 << 11)
}

/// `2^(1 - beta)` with 30 fractional bits, for `beta` in `1 ..= 3`.
pub(super) fn checked_spectrum(beta: Real) -> Result<UQ30, Error> {
    let (min, max) = (Real::ONE, Real::from_bits(3 << 24));
    if beta < min || beta > max {
        return Err(Error::OutOfRange {
            what: "beta",
            index: None,
            value: Wide::from(beta),
            min: Wide::from(min),
            max: Wide::from(max),
        });
    }
    Ok(decay(beta - min))
}

/// The end of the part that begins at `from` and has its midpoint at `middle`, for `g = along + across i`:
/// `p_2 - p_1 = (p_m - p_1) / (1/2 + g)`.
pub(super) fn perpendicular(from: Point2, middle: Point2, along: Q28, across: Q28) -> Result<Point2, Error> {
    let difference = |a: Real, b: Real| i128::from(b.to_bits()) - i128::from(a.to_bits());
    let (x, y) = (difference(from.x, middle.x), difference(from.y, middle.y));
    let (u, v) = (i128::from(along) + (1 << 27), i128::from(across));
    let square = u * u + v * v;
    // 2 (x + iy) (u - iv) / |u + iv|^2 with 24 fractional bits, rounded
    let quotient = |numerator: i128| {
        // rounded down first, below 0 as well
        let twice = (numerator << 29).checked_div_euclid(square)?;
        i64::try_from((twice + 1) >> 1).ok()
    };
    if square == 0 {
        return Err(Error::Degenerate { what: "the distance between the midpoint's parts" });
    }
    let far = i64::MAX / 4;
    let [dx, dy] =
        [quotient(x * u + y * v), quotient(y * u - x * v)].map(|q| q.unwrap_or(far).clamp(-far, far));
    undone([i64::from(from.x.to_bits()) + dx, i64::from(from.y.to_bits()) + dy])
}

/// A point, if it lies in the format; 24 fractional bits.
pub(super) fn undone(bits: [i64; 2]) -> Result<Point2, Error> {
    for (index, bits) in bits.iter().enumerate() {
        if i32::try_from(*bits).is_err() {
            return Err(Error::OutOfRange {
                what: "coordinate of the new knot",
                index: Some(index),
                value: Wide::from_bits(bits.saturating_mul(1 << 24)),
                min: Wide::from(Real::MIN),
                max: Wide::from(Real::MAX),
            });
        }
    }
    let [x, y] = bits.map(|b| Real::from_bits(b as i32));
    Ok(Point2::new(x, y))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against integers: halves upwards, saturated.
    #[test]
    fn midpoints_and_products_are_the_nearest() {
        for i in 1..5000_i32 {
            let [a, b, length, g] =
                [0x2545_f491, 0x6c07_8965, 0x1f12_3bb5, 0x4f6c_dd1d_i32].map(|n| i.wrapping_mul(n));
            let half = (i128::from(a) + i128::from(b)) << 27;
            let exact = (half + i128::from(length) * i128::from(g) + (1 << 27)) >> 28;
            let expected = exact.clamp(i32::MIN.into(), i32::MAX.into());
            let got = raised(Real::from_bits(a), Real::from_bits(b), Real::from_bits(length), g);
            assert_eq!(i128::from(got.to_bits()), expected, "{a} {b} {length} {g}");
            let (a, b) = (a >> 2, b >> 3);
            let exact = (i64::from(a) * i64::from(b) + (1 << 27)) >> 28;
            assert_eq!(i64::from(product_q28(a, b)), exact, "{a} {b}");
        }
        // a half is rounded upwards
        let unit = Real::DELTA;
        assert_eq!(
            [raised(unit, Real::ZERO, unit, 0), raised(-unit, Real::ZERO, unit, 0)],
            [unit, Real::ZERO]
        );
    }

    /// Both parts of a displaced midpoint against integers, where nothing saturates and where it does.
    #[test]
    fn a_displaced_midpoint_is_the_nearest() {
        let (mut inside, mut saturated, mut by_halves) = (0, 0, 0);
        let ends = [i32::MIN, 0, i32::MAX];
        let extremes = (0..729).map(|k| [1, 3, 9, 27, 81, 243].map(|place| ends[k / place % 3]));
        let spread = (1..5000_i32).map(|i| {
            [0x2545_f491, 0x6c07_8965, 0x1f12_3bb5, 0x4f6c_dd1d, 0x3141_5927, 0x2718_2819_i32]
                .map(|n| i.wrapping_mul(n) >> (i % 5))
        });
        // parts shorter than 16 within 64, up to the ends of that
        let near = (1..5000_i32).map(|i| {
            let reach = |n: i32, bits: i32| match (i.wrapping_mul(n) >> 9) & 15 {
                0 => (1 << bits) - 1,
                1 => -(1 << bits),
                _ => i.wrapping_mul(n) >> (31 - bits),
            };
            let (dx, dy, h) = (reach(0x3141_5927, 28), reach(0x2718_2819, 28), reach(0x1f12_3bb5, 29));
            let [a, b] = [0x2545_f491, 0x6c07_8965].map(|n| reach(n, 30));
            [a, b, a.saturating_add(dx), b.saturating_add(dy), 0, h]
        });
        for [a, b, c, d, g, h] in extremes.chain(spread).chain(near) {
            let point = |x, y| Point2::new(Real::from_bits(x), Real::from_bits(y));
            let (from, to) = (point(a, b), point(c, d));
            let parameter = Parameter::default();
            let part = Part { from, to, middle: parameter, level: 0, span: Real::ONE };
            let got = displaced(&part, Deviate::from_bits(g), Deviate::from_bits(h));
            if g == 0 || i64::from(g).abs() > 1 << 28 {
                let alone = displaced(&part, Deviate::ZERO, Deviate::from_bits(h));
                if h != i32::MIN {
                    assert_eq!(raised_across(&part, h), alone, "{a} {b} {c} {d} {h}");
                }
                if let Some(middle) = raised_by_halves(from, to, h) {
                    assert_eq!(middle, alone, "{a} {b} {c} {d} {h}");
                    by_halves += 1;
                }
            }
            let limits = (i128::from(i32::MIN), i128::from(i32::MAX));
            let length = |from: i32, to: i32| (i128::from(to) - i128::from(from)).clamp(limits.0, limits.1);
            let (dx, dy, g, h) = (length(a, c), length(b, d), i128::from(g), i128::from(h));
            let nearest = |from: i32, to: i32, raised: i128| {
                // the intermediate sum saturates at 2^63, far outside
                let sum = ((i128::from(from) + i128::from(to)) << 27) + raised + (1 << 27);
                sum >> 28
            };
            let exact = [nearest(a, c, dx * g - dy * h), nearest(b, d, dy * g + dx * h)];
            for (got, exact) in [got.x, got.y].into_iter().zip(exact) {
                assert_eq!(i128::from(got.to_bits()), exact.clamp(limits.0, limits.1), "{a} {b} {c} {d}");
                if (limits.0..=limits.1).contains(&exact) { inside += 1 } else { saturated += 1 }
            }
        }
        assert!(inside > 2000 && saturated > 500 && by_halves > 4000, "{inside} {saturated} {by_halves}");
    }

    /// `2^(1 - beta)`: the exponent is the nearest, so that half a unit of `2^-24` and the exponential's
    /// `2^-28` remain.
    #[test]
    fn a_spectrum_is_a_power_of_two_within_its_rounding() {
        let mut worst: f64 = 0.0;
        for bits in ((1 << 24)..=3 << 24).step_by(3331) {
            let exact = 2_f64.powf(1.0 - f64::from(bits) / 16_777_216.0);
            let got = checked_spectrum(Real::from_bits(bits)).unwrap() as f64 / 2_f64.powi(30);
            // in units of the exponent
            worst = worst.max((got / exact - 1.0).abs() * 16_777_216.0);
        }
        assert!((0.5..0.75).contains(&worst), "{worst}");
        let fits = [(1 << 24) - 1, 1 << 24, 3 << 24, (3 << 24) + 1]
            .map(|b| checked_spectrum(Real::from_bits(b)).is_ok());
        assert_eq!(fits, [false, true, true, false]);
    }

    /// The end of a part from its midpoint, against fractions: the nearest, a half upwards.
    #[test]
    fn the_end_of_a_part_is_the_nearest() {
        let mut tried = 0;
        for i in 1..4000_i32 {
            let [a, b, x, y, g, h] =
                [0x2545_f491, 0x6c07_8965, 0x1f12_3bb5, 0x4f6c_dd1d, 0x3141_5927, 0x2718_2819_i32]
                    .map(|n| i.wrapping_mul(n) >> 7);
            let (g, h) = (g << 3, h << 3);
            let point = |x, y| Point2::new(Real::from_bits(x), Real::from_bits(y));
            let Ok(got) = perpendicular(point(a, b), point(x, y), g, h) else { continue };
            tried += 1;
            let (u, v) = (i128::from(g) + (1 << 27), i128::from(h));
            let (dx, dy) = (i128::from(x) - i128::from(a), i128::from(y) - i128::from(b));
            // (dx + i dy) / (u + i v) with u, v of 28 fractional bits
            let under = u * u + v * v;
            for (got, from, over) in [(got.x, a, dx * u + dy * v), (got.y, b, dy * u - dx * v)] {
                let off = (i128::from(got.to_bits()) - i128::from(from)) * under - (over << 28);
                assert!(2 * off.abs() <= under, "{i}");
            }
        }
        assert!(tried > 2000, "{tried}");
    }

    /// Every knot has the midpoint of a part that ends where it begins twice as far on; and knots end with
    /// the format.
    #[test]
    fn the_end_of_a_part_is_refused_where_there_is_none() {
        let point = |x: i32, y: i32| Point2::new(Real::from_num(x), Real::from_num(y));
        let refused = perpendicular(point(0, 0), point(1, 2), -(1 << 27), 0);
        let what = "the distance between the midpoint's parts";
        assert_eq!(refused, Err(Error::Degenerate { what }));
        assert_eq!(perpendicular(point(1, 2), point(3, 7), 0, 0), Ok(point(5, 12)));
        for (middle, index, value) in [(point(100, 0), 0, 200), (point(0, -100), 1, -200)] {
            match perpendicular(point(0, 0), middle, 0, 0) {
                Err(Error::OutOfRange {
                    what: "coordinate of the new knot", index: at, value: got, ..
                }) => {
                    assert_eq!((at, got), (Some(index), Wide::from_num(value)));
                }
                other => panic!("{other:?}"),
            }
        }
    }
}
