//! Integral and derivative: both are fractal interpolation functions over the same knots.
//!
//! Integral (eq. 29-33, with the erratum that the inner integral of eq. 31 runs over the whole domain), in
//! the unit abscissa and with `w = x_N - x_0`:
//! `F(L_j u) = a_j alpha_j F(u) + Y_(j-1) - a_j alpha_j Y_0 + w a_j (integral of q_j from 0 to u)`.
//! Derivative (eq. 34-36): scalings `alpha_j / a_j`, polynomials `q_j' / (w a_j)`.
//!
//! Source: Cochran, Lewis, Hart, section 3; M. F. Barnsley, A. N. Harrington, "The calculus of fractal
//! interpolation functions", 1989.

use heapless::Vec;

use super::function::{Fif, POWERS};
use super::map::Map;
use super::polynomial::{Polynomial, length_of, product_q55, twice_high};
use super::value::{ONE_UQ63, in_range, value};
use crate::Error;
use crate::num::{Wide, mul_high_u, nth, quotient};

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The function `initial + integral of f from x_0 to x`, with room for polynomials of degree `E`.
    ///
    /// Error: at a knot at most a unit, `2^-48`, beyond the integral of
    /// the error of `f` itself (`an_integral_is_within_its_bound`). Repeatable.
    ///
    /// # Errors
    /// [`Error::Capacity`] if `E` is not above the degree of `f`; [`Error::OutOfRange`] if the integral
    /// leaves the format.
    pub fn integral<const E: usize>(&self, initial: Wide) -> Result<Fif<N, E>, Error> {
        let degree = self.degree() + 1;
        if degree > E {
            return Err(Error::Capacity { what: POWERS, needed: degree, capacity: E });
        }
        in_range("initial value", None, initial)?;
        let start = value(initial);
        // eq. 30: the whole integral is w (sum of a_n mean(q_n)) / (1 - sum of a_n alpha_n)
        let total = self.times_width(self.mean());
        inside(total)?;
        let mut maps = Vec::new();
        let mut knot = start; // Y_(j-1)
        for map in &self.maps {
            let scaling = product_q55(map.scaling, map.width);
            let mut q = Polynomial::<E>::ZERO;
            q.constant = knot.wrapping_sub(twice_high(start, scaling));
            let integrated = [map.q.constant].into_iter().chain(map.q.powers).zip(1..);
            for (to, (c, n)) in q.powers.iter_mut().zip(integrated) {
                *to = self.times_width(product_q55(nth(c, n), map.width));
                inside(*to)?;
            }
            let step = q.powers.iter().fold(0_i64, |sum, c| sum.wrapping_add(*c));
            knot = knot.saturating_add(step).saturating_add(twice_high(total, scaling));
            let map = Map { scaling, q, start: map.start, width: map.width, per_width: map.per_width };
            // as many as those of the function: never full
            let _ = maps.push(map);
        }
        Fif::from_maps(maps, self.x0, self.width, self.per_width)
    }

    /// The derivative, a function of its own kind where every map is less steep than narrow.
    ///
    /// # Errors
    /// [`Error::NotDifferentiable`] if `|alpha_j| >= a_j`, [`Error::NotJoined`] if the maps of the derivative
    /// disagree at a knot by more than `2^-22`, [`Error::OutOfRange`] if it leaves the format,
    /// [`Error::Capacity`] if its degree is above `E`.
    pub fn derivative<const E: usize>(&self) -> Result<Fif<N, E>, Error> {
        self.slopes()?.joined()
    }

    /// The derivative between the knots, where it may jump.
    ///
    /// # Errors
    /// As [`Fif::derivative`], but for the joints.
    pub(crate) fn slopes<const E: usize>(&self) -> Result<Fif<N, E>, Error> {
        let degree = self.degree().saturating_sub(1);
        if degree > E {
            return Err(Error::Capacity { what: POWERS, needed: degree, capacity: E });
        }
        let mut maps = Vec::new();
        for (index, map) in self.maps.iter().enumerate() {
            if map.scaling.unsigned_abs() >= map.width {
                return Err(Error::NotDifferentiable { map: index });
            }
            let scaling = quotient(map.scaling, 63, map.width);
            // 1 / (w a_j); w a_j with 48 fractional bits
            let length = length_of(self.width, map.width);
            let per_length = |c: i64| quotient(c, 48, length);
            let slope = map.q.derivative();
            let mut q = Polynomial::<E>::ZERO;
            q.constant = per_length(slope.constant);
            for (to, c) in q.powers.iter_mut().zip(slope.powers) {
                *to = per_length(c);
            }
            let map = Map { scaling, q, start: map.start, width: map.width, per_width: map.per_width };
            let _ = maps.push(map); // as in the integral
        }
        Fif::from_maps(maps, self.x0, self.width, self.per_width)
    }

    /// The mean value over the domain, `sum of a_n mean(q_n) / (1 - sum of a_n alpha_n)`, 55 fractional bits.
    #[inline(never)]
    pub(crate) fn mean(&self) -> i64 {
        let mut sum = 0_i64;
        let mut rest = ONE_UQ63; // stays inside (0, 2): |sum of a_n alpha_n| < 1
        for map in &self.maps {
            sum = sum.saturating_add(product_q55(map.q.mean(), map.width));
            rest = rest.wrapping_sub(product_q55(map.scaling, map.width) as u64);
        }
        quotient(sum, 63, rest)
    }

    /// `value * (x_N - x_0)`, saturated.
    #[inline(never)]
    fn times_width(&self, v: i64) -> i64 {
        let high = mul_high_u(v as u64, self.width).wrapping_sub(if v < 0 { self.width } else { 0 }) as i64;
        let low = (v as u64).wrapping_mul(self.width);
        if high >> 47 == high >> 63 {
            return high << 16 | (low >> 48) as i64;
        }
        (v >> 63) ^ i64::MAX
    }
}

/// Whether an integral has kept inside its format, and is not saturated.
fn inside(v: i64) -> Result<(), Error> {
    if v != (v >> 63) ^ i64::MAX {
        return Ok(());
    }
    let (min, max) = (Wide::from_num(-128), Wide::from_num(128));
    Err(Error::OutOfRange { what: "integral", index: None, value: Wide::from_bits(v), min, max })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fif::Knot;
    use crate::num::Scaling;

    fn through<const N: usize>(knots: &[(i32, i32)], scalings: [f64; N]) -> Fif<N, 1> {
        let knots = knots.iter().map(|(x, y)| Knot::new(Wide::from_num(*x), Wide::from_num(*y)));
        let knots: heapless::Vec<Knot, 8> = knots.collect();
        Fif::interpolating(&knots, &scalings.map(Scaling::from_num)).unwrap()
    }

    /// Whether a number is `numerator / denominator` within so many units of the last place.
    fn is(got: Wide, (numerator, denominator): (i64, i64), units: i64) -> bool {
        let off = i128::from(got.to_bits()) * i128::from(denominator) - (i128::from(numerator) << 48);
        off.abs() <= i128::from(denominator * units)
    }

    /// `a = (1/4, 3/4)`, `alpha = (1/2, -1/4)`: the mean is
    /// `(sum of a mean(q)) / (1 - sum of a alpha) = (77/32) / (17/16)`, and the integral over the first part
    /// `a_1 w (alpha_1 mean + mean(q_1)) = 77/68 + 13/4`.
    #[test]
    fn an_integral_is_the_exact_one_at_its_knots() {
        let f = through(&[(1, 2), (2, 5), (5, -1)], [0.5, -0.25]);
        assert!((i128::from(f.mean()) * 34 - (77 << 55)).abs() <= 2 * 34, "{}", f.mean());
        for initial in [0, 3, -5] {
            let integral = f.integral::<2>(Wide::from_num(initial)).unwrap();
            let start = 1088 * i64::from(initial);
            // 1 + 1/4 is the image of the middle knot under the first map: a_1 (alpha_1 149/34 + 25/16) =
            // 1021/1088
            for (x, numerator) in [(1.0, 0), (1.25, 1021), (2.0, 149 * 32), (5.0, 154 * 64)] {
                let got = integral.at_wide(Wide::from_num(x));
                assert!(is(got, (start + numerator, 1088), 1), "{initial} + {numerator}/1088: {got}");
            }
        }
    }

    /// What was integrated comes back: scalings to the bit, values within a few units.
    #[test]
    fn the_derivative_of_an_integral_is_the_function() {
        let f = through(&[(1, 2), (2, 5), (5, -1)], [0.125, -0.25]);
        let back = f.integral::<2>(Wide::ONE).unwrap().derivative::<1>().unwrap();
        for (map, own) in back.maps.iter().zip(&f.maps) {
            assert_eq!((map.scaling, map.start, map.width), (own.scaling, own.start, own.width));
            assert!((map.q.constant - own.q.constant).abs() <= 1 << 6);
            assert!((map.q.powers[0] - own.q.powers[0]).abs() <= 1 << 6);
        }
        for x in [1.0, 1.0625, 1.25, 1.5, 2.0, 2.75, 4.5, 5.0].map(Wide::from_num) {
            assert!((f.at_wide(x) - back.at_wide(x)).abs() <= 2 * Wide::DELTA, "{x}");
        }
        // f(L_1(2)) = alpha_1 f(2) + q_1(1/4): 5/8 + 7/4 + 27/32
        assert_eq!(back.at(Wide::from_num(1.25)), f.at(Wide::from_num(1.25)));
        assert!(is(f.at_wide(Wide::from_num(1.25)), (103, 32), 1), "{}", f.at_wide(Wide::from_num(1.25)));
    }

    /// `x^3` over two parts of `[-1, 3]`: `f(L(x))` is the cube of `(x - 1) / 2` and of `(x + 3) / 2`; its
    /// derivative is `3 x^2`.
    fn cube() -> Fif<2, 3> {
        let eighths = |cs: [i32; 4]| cs.map(|c| Wide::from_num(c) / 8);
        let (left, right) = (eighths([-1, 3, -3, 1]), eighths([27, 27, 9, 1]));
        let knots = [-1, 1, 3].map(Wide::from_num);
        Fif::from_polynomials(&knots, &[Scaling::ZERO; 2], &[&left, &right]).unwrap()
    }

    #[test]
    fn a_cube_has_the_derivative_and_the_integral_of_the_textbooks() {
        let f = cube();
        let slope = f.derivative::<2>().unwrap();
        let integral = f.integral::<4>(Wide::from_num(-1)).unwrap();
        for eighths in -8..=24_i64 {
            let x = Wide::from_num(eighths) / 8;
            assert!(is(f.at_wide(x), (eighths.pow(3), 512), 1), "{x}");
            assert!(is(slope.at_wide(x), (3 * eighths.pow(2), 64), 1), "{x}: {}", slope.at_wide(x));
            // -1 + (x^4 - 1) / 4
            let quarters = eighths.pow(4) - 4096 - 4 * 4096;
            assert!(is(integral.at_wide(x), (quarters, 4 * 4096), 1), "{x}: {}", integral.at_wide(x));
        }
    }

    #[test]
    fn room_for_one_power_less_is_refused() {
        let f = cube();
        let (needed, capacity) = (4, 3);
        assert_eq!(
            f.integral::<3>(Wide::ZERO).unwrap_err(),
            Error::Capacity { what: POWERS, needed, capacity }
        );
        let (needed, capacity) = (2, 1);
        assert_eq!(f.derivative::<1>().unwrap_err(), Error::Capacity { what: POWERS, needed, capacity });
        let flat = through(&[(0, 1), (1, 1)], [0.0]);
        assert!(flat.integral::<1>(Wide::ZERO).is_ok() && flat.derivative::<0>().is_ok());
        let far = flat.integral::<1>(Wide::from_num(128)).unwrap_err();
        assert!(matches!(far, Error::OutOfRange { what: "initial value", .. }));
    }

    /// In a domain of few units the last one counts.
    #[test]
    fn lengths_of_parts_have_all_of_their_bits() {
        for (width, part, length) in [
            (6, ONE_UQ63 / 2, 3),
            (7, ONE_UQ63, 7),
            (u64::MAX, ONE_UQ63, u64::MAX),
            (u64::MAX, ONE_UQ63 / 2, u64::MAX / 2),
            (3 << 48, ONE_UQ63 / 4, 3 << 46),
        ] {
            assert_eq!(length_of(width, part), length, "{width} {part}");
        }
        for half in [3, 5, 101] {
            let knots =
                [0, half, 2 * half].map(|bits| Knot::new(Wide::from_bits(bits), Wide::from_bits(bits)));
            let line = Fif::<2, 1>::interpolating(&knots, &[Scaling::ZERO; 2]).unwrap();
            let slope = line.derivative::<1>().unwrap();
            for bits in [0, half / 2, half, 2 * half] {
                let off = slope.at_wide(Wide::from_bits(bits)) - Wide::ONE;
                assert!(off.abs() < 1e-6, "{bits} of {half}: {off:?}");
            }
        }
    }

    #[test]
    fn a_map_as_steep_as_narrow_has_no_derivative() {
        let level = |scaling| {
            let knots = [0, 1, 2].map(|x| Knot::new(Wide::from_num(x), Wide::ZERO));
            Fif::<2, 1>::interpolating(&knots, &[Scaling::ZERO, scaling]).unwrap().derivative::<1>()
        };
        let half = Scaling::from_num(0.5);
        for steep in [half, -half] {
            assert_eq!(level(steep).unwrap_err(), Error::NotDifferentiable { map: 1 });
        }
        let less = half - Scaling::from_num(0.002);
        assert!(level(less).is_ok() && level(-less).is_ok());
        // a scaling of 1 - 2^-30 has no range in the format
        for least in [half - Scaling::DELTA, Scaling::DELTA - half] {
            assert!(matches!(level(least), Err(Error::OutOfRange { .. })));
        }
        // a corner is no derivative
        assert_eq!(
            through(&[(0, 0), (1, 1), (2, 0)], [0.0; 2]).derivative::<1>().unwrap_err(),
            Error::NotJoined { knot: 1 }
        );
    }

    /// Against 128 bits: every product rounded down, and an error where it leaves 64.
    #[test]
    fn an_integral_that_leaves_the_format_is_refused() {
        let over = |y: i32, width: i32| through(&[(0, y), (width, y)], [0.0]).integral::<2>(Wide::ZERO);
        for (y, width, what) in [
            (1, 127, None),
            (-1, 127, None),
            (1, 128, Some("range of the function")),
            (-1, 128, Some("range of the function")),
            (1, 256, Some("integral")),
            (-1, 257, Some("integral")),
            (100, 3000, Some("integral")),
            (-100, 3000, Some("integral")),
        ] {
            let got = match over(y, width) {
                Ok(_) => None,
                Err(Error::OutOfRange { what, .. }) => Some(what),
                Err(other) => panic!("{other:?}"),
            };
            assert_eq!(got, what, "{y} over {width}");
        }
        let (mut fits, mut leaves) = (0, 0);
        for k in 0..4000_i64 {
            let width = k.wrapping_mul(0x2545_f491_4f6c_dd1d) as u64 >> (k % 64) | 1;
            let f = Fif::<1, 1> { width, ..through(&[(0, 1), (1, 1)], [0.0]) };
            let v = k.wrapping_mul(0x1f12_3bb5_159a_55e5) >> (k / 64 % 16);
            let exact = (i128::from(v) * i128::from(width)) >> 48;
            let saturated = exact.clamp(i64::MIN.into(), i64::MAX.into());
            assert_eq!(i128::from(f.times_width(v)), saturated, "{v} {width}");
            *if exact == i128::from(exact as i64) { &mut fits } else { &mut leaves } += 1;
        }
        assert!(fits > 1000 && leaves > 300, "{fits} {leaves}");
    }
}
