//! The function as its maps: knots, vertical scalings, polynomials; what a constructor checks.

use heapless::Vec;

use super::bounds::{Bounds, Image, too_large};
use super::map::Map;
use super::polynomial::{Polynomial, twice_high};
use super::value::{FRACTION_Q55, ONE_UQ63, in_range, real_above, real_below, value, wide};
use crate::Error;
use crate::num::{Real, Reciprocal, Scaling, Wide, mul_high_u, quotient, ratio};

/// A point that the graph passes through.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Knot {
    /// Abscissa.
    pub x: Wide,
    /// Value.
    pub y: Wide,
}

impl Knot {
    /// The knot `(x, y)`.
    pub const fn new(x: Wide, y: Wide) -> Self {
        Self { x, y }
    }

    /// The knot `(x, y)` from decimal literals, for constants: `const TOP: Knot = Knot::lit("0.5", "1")`.
    ///
    /// Text that is no number, or does not fit, is an error at compile time. Call it in a `const` or in
    /// `const { }` only: see [Numbers](crate::num#numbers).
    pub const fn lit(x: &str, y: &str) -> Self {
        Self::new(Wide::lit(x), Wide::lit(y))
    }
}

/// A fractal interpolation function of at most `N` maps with polynomials of degree at most `D`.
///
/// Domain: `[x_0, x_N]`; abscissae outside count as the nearer end. Result: [`Real`].
///
/// ```
/// use attractor::fif::{Fif, Knot};
/// use attractor::num::{Real, Scaling, Wide};
///
/// let knot = |x, y| Knot::new(Wide::from_num(x), Wide::from_num(y));
/// // the function f of figure 1
/// let f = Fif::<2, 1>::interpolating(&[knot(0, 0), knot(1, 1), knot(2, 0)], &[Scaling::from_num(0.5); 2])?;
/// assert_eq!(f.at(Wide::from_num(1.5)), Real::from_num(1));
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fif<const N: usize, const D: usize = 1> {
    pub(crate) maps: Vec<Map<D>, N>,
    /// Left ends of the maps' intervals, 31 fractional bits: what walkers need that know no degree.
    pub(crate) starts: Vec<u32, N>,
    /// `x_0` and `x_N - x_0`, 48 fractional bits.
    pub(crate) x0: i64,
    pub(crate) width: u64,
    pub(crate) per_width: Reciprocal,
    /// `y_0` and `y_N`, 55 fractional bits.
    pub(crate) first: i64,
    pub(crate) last: i64,
    /// Rigorous bounds of the values, 55 fractional bits.
    pub(crate) range: (i64, i64),
    /// No address is longer.
    pub(crate) levels: u32,
}

/// What a degree counts.
pub(crate) const POWERS: &str = "powers of x";

/// How far neighbouring maps may disagree at a knot: `2^-22`.
const JOIN_TOLERANCE: i64 = 1 << (FRACTION_Q55 - 22);

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The function through the knots with affine polynomials (eq. 10-11), the ordinary construction.
    ///
    /// # Errors
    /// [`Error::TooFew`] knots (2 at least), [`Error::Capacity`] for more than `N + 1` knots or `D` = 0,
    /// [`Error::LengthMismatch`] of the scalings, [`Error::NotIncreasing`], [`Error::OutOfRange`] for a
    /// scaling of -1, a value or a range of the function of 128 or more.
    pub fn interpolating(knots: &[Knot], vertical_scaling: &[Scaling]) -> Result<Self, Error> {
        if D == 0 {
            return Err(Error::Capacity { what: POWERS, needed: 1, capacity: 0 });
        }
        for (index, knot) in knots.iter().enumerate() {
            in_range("y of knot", Some(index), knot.y)?;
        }
        let (Some(first), Some(last)) = (knots.first(), knots.last()) else {
            return Err(Error::TooFew { what: "knots", given: 0, at_least: 2 });
        };
        let (y0, yn) = (value(first.y), value(last.y));
        let mut ys = knots.windows(2);
        Self::build(knots.iter().map(|k| k.x), vertical_scaling, |scaling| {
            // q(0) = y_(j-1) - alpha y_0, q(1) = y_j - alpha y_N
            let (a, b) = match ys.next() {
                Some([a, b]) => (value(a.y), value(b.y)),
                _ => (0, 0),
            };
            let left = a.saturating_sub(twice_high(y0, scaling));
            let right = b.saturating_sub(twice_high(yn, scaling));
            let mut q = Polynomial::ZERO;
            q.constant = left;
            if let Some(c) = q.powers.first_mut() {
                *c = right.saturating_sub(left);
            }
            Ok(q)
        })
    }

    /// The function with given polynomials `q_j(x)`, constant coefficient first (eq. 8-9); the knots' values
    /// follow from the maps.
    ///
    /// # Errors
    /// As [`Fif::interpolating`]; [`Error::Capacity`] for a degree above `D`; [`Error::NotJoined`] if two
    /// maps disagree at their knot by more than `2^-22`.
    pub fn from_polynomials(
        knots_x: &[Wide],
        vertical_scaling: &[Scaling],
        polynomials: &[&[Wide]],
    ) -> Result<Self, Error> {
        let maps = knots_x.len().saturating_sub(1);
        if polynomials.len() != maps {
            return Err(Error::LengthMismatch {
                what: "polynomials",
                given: polynomials.len(),
                expected: maps,
            });
        }
        let (Some(x0), Some(xn)) = (knots_x.first(), knots_x.last()) else {
            return Err(Error::TooFew { what: "knots", given: 0, at_least: 2 });
        };
        let (x0, width) = (x0.to_bits(), i128::from(xn.to_bits()) - i128::from(x0.to_bits()));
        let mut given = polynomials.iter().enumerate();
        let fif = Self::build(knots_x.iter().copied(), vertical_scaling, |_| {
            let Some((index, coefficients)) = given.next() else { return Ok(Polynomial::ZERO) };
            on_unit_interval(index, coefficients, x0, width)
        })?;
        fif.joined()
    }

    /// From knots, scalings and a polynomial in the unit abscissa for each map.
    fn build(
        knots_x: impl ExactSizeIterator<Item = Wide> + Clone,
        vertical_scaling: &[Scaling],
        mut q_of: impl FnMut(i64) -> Result<Polynomial<D>, Error>,
    ) -> Result<Self, Error> {
        let count = knots_x.len();
        if count < 2 {
            return Err(Error::TooFew { what: "knots", given: count, at_least: 2 });
        }
        if count - 1 > N {
            return Err(Error::Capacity { what: "maps", needed: count - 1, capacity: N });
        }
        if vertical_scaling.len() != count - 1 {
            return Err(Error::LengthMismatch {
                what: "vertical scalings",
                given: vertical_scaling.len(),
                expected: count - 1,
            });
        }
        for (index, (a, b)) in knots_x.clone().zip(knots_x.clone().skip(1)).enumerate() {
            if b <= a {
                return Err(Error::NotIncreasing { what: "knot", index: index + 1 });
            }
        }
        let bits = |x: Wide| x.to_bits();
        let x0 = knots_x.clone().next().map_or(0, bits);
        let xn = knots_x.clone().last().map_or(0, bits);
        let width = xn.wrapping_sub(x0) as u64; // below 2^64: exact
        let unit = |x: Wide| ratio(x.to_bits().wrapping_sub(x0) as u64, 63, width);
        let mut maps = Vec::new();
        let ends = knots_x.clone().zip(knots_x.skip(1)).zip(vertical_scaling).enumerate();
        for (index, ((a, b), scaling)) in ends {
            if *scaling == Scaling::MIN {
                return Err(Error::OutOfRange {
                    what: "vertical scaling",
                    index: Some(index),
                    value: Wide::from_num(*scaling),
                    min: Wide::from_num(Scaling::MIN + Scaling::DELTA),
                    max: Wide::from_num(Scaling::MAX),
                });
            }
            let start = unit(a);
            let end = if index + 2 == count { ONE_UQ63 } else { unit(b) };
            let scaling = i64::from(scaling.to_bits()) << 32;
            let map = Map {
                scaling,
                q: q_of(scaling)?,
                start,
                width: end - start,
                per_width: Reciprocal::of(end - start),
            };
            // count - 1 <= N: never full
            let _ = maps.push(map);
        }
        Self::from_maps(maps, x0, width, Reciprocal::of(width))
    }

    /// From maps in the unit abscissa: finds end values, range and levels.
    pub(crate) fn from_maps(
        mut maps: Vec<Map<D>, N>,
        x0: i64,
        width: u64,
        per_width: Reciprocal,
    ) -> Result<Self, Error> {
        if let [only] = maps.as_mut_slice() {
            // N = 1: f = alpha f + q at the same abscissa, so f = q / (1 - alpha)
            let rest = ONE_UQ63.wrapping_sub(only.scaling as u64);
            for c in only.q.powers.iter_mut().chain([&mut only.q.constant]) {
                *c = quotient(*c, 63, rest);
            }
            only.scaling = 0;
        }
        let mut images = Vec::<_, N>::new();
        let mut starts = Vec::new();
        for map in &maps {
            // as many as maps: never full
            let _ = images.push(Image::of(map));
            let _ = starts.push((map.start >> 32) as u32);
        }
        let curved = maps.iter().any(|map| map.q.degree() > 1);
        let Bounds { first, last, range, levels } = Bounds::of(&images, curved)?;
        Ok(Self { maps, starts, x0, width, per_width, first, last, range, levels })
    }

    /// Checks that neighbouring maps agree at their knot.
    pub(crate) fn joined(self) -> Result<Self, Error> {
        for (index, pair) in self.maps.windows(2).enumerate() {
            if let [a, b] = pair {
                let from_left = a.q.at(ONE_UQ63).saturating_add(twice_high(self.last, a.scaling));
                let from_right = b.q.at(0).saturating_add(twice_high(self.first, b.scaling));
                if from_left.saturating_sub(from_right).saturating_abs() > JOIN_TOLERANCE {
                    return Err(Error::NotJoined { knot: index + 1 });
                }
            }
        }
        Ok(self)
    }

    /// How many maps the function has.
    pub fn maps(&self) -> usize {
        self.maps.len()
    }

    /// The highest degree of its polynomials.
    pub fn degree(&self) -> usize {
        self.maps.iter().map(|m| m.q.degree()).max().unwrap_or(0)
    }

    /// The ends of the domain, `x_0` and `x_N`.
    pub fn domain(&self) -> (Wide, Wide) {
        (Wide::from_bits(self.x0), Wide::from_bits(self.x0.wrapping_add_unsigned(self.width)))
    }

    /// The points that the graph interpolates, from left to right.
    pub fn knots(&self) -> impl Iterator<Item = Knot> + '_ {
        let inner = self.maps.iter().map(|m| {
            let y = m.q.at(0).wrapping_add(twice_high(self.first, m.scaling));
            Knot { x: self.abscissa(m.start), y: wide(y) }
        });
        inner.chain([Knot { x: self.domain().1, y: wide(self.last) }])
    }

    /// Rigorous bounds of all values, rounded outward. A [`super::Pyramid`] has tighter ones.
    pub fn range(&self) -> (Real, Real) {
        (real_below(self.range.0), real_above(self.range.1))
    }

    /// The largest magnitude of the vertical scalings.
    pub fn max_scaling(&self) -> Scaling {
        let largest = self.maps.iter().map(|m| m.scaling.unsigned_abs()).max().unwrap_or(0);
        Scaling::from_bits((largest.div_ceil(1 << 32)).min(i32::MAX as u64) as i32)
    }

    /// The abscissa in `[0, 1]`, 63 fractional bits.
    pub(crate) fn unit(&self, x: Wide) -> u64 {
        let bits = x.to_bits();
        if bits <= self.x0 {
            0
        } else {
            let distance = bits.wrapping_sub(self.x0) as u64;
            // exact: what is rounded down stays, so that a dyadic place is one whatever the width
            if distance >= self.width { ONE_UQ63 } else { self.per_width.exact(distance, self.width) }
        }
    }

    /// The abscissa of a place in the unit interval (63 fractional bits), rounded down to the format.
    pub(crate) fn abscissa(&self, u: u64) -> Wide {
        if u >= ONE_UQ63 {
            return self.domain().1;
        }
        let offset = mul_high_u(self.width, u << 1);
        Wide::from_bits(self.x0.wrapping_add_unsigned(offset))
    }
}

/// `q(x_0 + width u)` with 55 fractional bits, from coefficients in `x` with 48.
fn on_unit_interval<const D: usize>(
    index: usize,
    q: &[Wide],
    x0: i64,
    width: i128,
) -> Result<Polynomial<D>, Error> {
    if q.len() > D + 1 {
        return Err(Error::Capacity { what: POWERS, needed: q.len() - 1, capacity: D });
    }
    let too_large = || too_large(index);
    // Horner with 55 fractional bits: p <- p (x_0 + width u) + c
    let product = |p: i128, x: i128| p.checked_mul(x).map(|v| (v + (1 << 47)) >> 48);
    let mut constant = 0_i128;
    let mut powers = [0_i128; D];
    for c in q.iter().rev() {
        let mut below = constant;
        let c = i128::from(c.to_bits()) << (FRACTION_Q55 - 48);
        constant = product(constant, i128::from(x0)).and_then(|v| v.checked_add(c)).ok_or_else(too_large)?;
        for p in &mut powers {
            let next =
                product(*p, i128::from(x0)).zip(product(below, width)).and_then(|(a, b)| a.checked_add(b));
            below = *p;
            *p = next.ok_or_else(too_large)?;
        }
    }
    let narrow = |v: i128| i64::try_from(v).map_err(|_| too_large());
    let mut result = Polynomial::ZERO;
    result.constant = narrow(constant)?;
    for (r, p) in result.powers.iter_mut().zip(powers) {
        *r = narrow(p)?;
    }
    Ok(result)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knot(x: i32, y: i32) -> Knot {
        Knot::new(Wide::from_num(x), Wide::from_num(y))
    }

    #[test]
    fn a_description_that_is_no_function_is_refused() {
        let half = Scaling::from_num(0.5);
        let refused =
            |knots: &[Knot], scalings: &[Scaling]| Fif::<2, 1>::interpolating(knots, scalings).unwrap_err();
        let three = [knot(0, 0), knot(1, 1), knot(2, 0)];
        assert!(matches!(refused(&[], &[]), Error::TooFew { .. }));
        assert!(matches!(refused(&three[..1], &[]), Error::TooFew { given: 1, at_least: 2, .. }));
        let four = [three[0], three[1], three[2], knot(3, 0)];
        assert!(matches!(refused(&four, &[half; 3]), Error::Capacity { needed: 3, capacity: 2, .. }));
        assert!(matches!(refused(&three, &[half]), Error::LengthMismatch { given: 1, expected: 2, .. }));
        for (x, index) in [(0, 1), (-1, 1), (2, 2), (3, 2)] {
            let error = refused(&[three[0], knot(x, 1), three[2]], &[half; 2]);
            assert_eq!(error, Error::NotIncreasing { what: "knot", index });
        }
        let error = refused(&three, &[half, Scaling::MIN]);
        assert!(matches!(error, Error::OutOfRange { what: "vertical scaling", index: Some(1), .. }));
        let far =
            |y: Wide| Fif::<1, 1>::interpolating(&[knot(0, 0), Knot::new(Wide::ONE, y)], &[Scaling::ZERO]);
        let limit = Wide::from_num(128);
        for y in [limit, -limit, limit * 2, Wide::MIN] {
            assert!(
                matches!(far(y), Err(Error::OutOfRange { what: "y of knot", index: Some(1), .. })),
                "{y}"
            );
        }
        // the range is outward by a few units of 2^-16
        let near = limit - Wide::from_num(0.0001);
        assert!(far(near).is_ok() && far(-near).is_ok());
        assert!(matches!(Fif::<1, 0>::interpolating(&three[..2], &[half]), Err(Error::Capacity { .. })));
    }

    /// `f = alpha f + q` at the same abscissa: `q / (1 - alpha)`, whatever the scaling a straight line.
    #[test]
    fn a_single_map_is_its_polynomial() {
        for alpha in [-0.75, 0.0, 0.5, 0.875] {
            let f =
                Fif::<1, 1>::interpolating(&[knot(-1, 3), knot(3, -2)], &[Scaling::from_num(alpha)]).unwrap();
            for quarters in 0..=16_i64 {
                let got = f.at_wide(Wide::from_num(quarters) / 4 - Wide::ONE);
                // 3 - 5 quarters / 16
                assert!(
                    (got - (Wide::from_num(48 - 5 * quarters) / 16)).abs() <= Wide::DELTA,
                    "{alpha}: {got}"
                );
            }
            assert_eq!(f.max_scaling(), Scaling::ZERO);
        }
        let f = Fif::<2, 1>::interpolating(
            &[knot(0, 0), knot(1, 1), knot(2, 0)],
            &[-0.75, 0.5].map(Scaling::from_num),
        );
        assert_eq!(f.unwrap().max_scaling(), Scaling::from_num(0.75));
        // alpha a has more than 31 bits: rounded up
        let f =
            Fif::<2, 1>::interpolating(&[knot(0, 0), knot(1, 1), knot(3, 0)], &[Scaling::from_num(0.6); 2]);
        let integral = f.unwrap().integral::<2>(Wide::ZERO).unwrap();
        let steepest = integral.maps[1].scaling;
        let above = (i64::from(integral.max_scaling().to_bits()) << 32) - steepest;
        assert!((1..1 << 32).contains(&above), "{above}");
    }

    /// `2^-22` apart is a knot, a unit more is none.
    #[test]
    fn maps_join_within_two_to_the_minus_22() {
        let half = Scaling::from_num(0.5);
        let gap = |units: i64| {
            // f(0) = 2, f(2) = 0: 1 + 0 at the middle knot, 2 - 1 and the gap
            let left = [Wide::ONE, Wide::ZERO];
            let right = [Wide::from_bits(units), Wide::from_bits(-units / 2)];
            Fif::<2, 1>::from_polynomials(&[0, 1, 2].map(Wide::from_num), &[half; 2], &[&left, &right])
        };
        let tolerance = 1 << 26;
        for units in [0, tolerance - 8, 8 - tolerance] {
            assert!(gap(units).is_ok(), "{units}");
        }
        for units in [tolerance + 8, -tolerance - 8, 4 * tolerance] {
            assert_eq!(gap(units).unwrap_err(), Error::NotJoined { knot: 1 }, "{units}");
        }
    }

    /// `(x - x_0) / (x_N - x_0)` rounded down, both ends exact; back to the abscissa within a unit.
    #[test]
    fn places_are_rounded_down() {
        for (from, to) in [(0, 3), (-5, 2), (-32768, 32767), (7, 8)] {
            let f = Fif::<1, 1>::interpolating(&[knot(from, 0), knot(to, 1)], &[Scaling::ZERO]).unwrap();
            let (low, width) = (i128::from(from) << 48, i128::from(to - from) << 48);
            for k in 0..1000_i64 {
                let x = Wide::from_bits((low + (i128::from(k * k * 7919) * width / 7_919_000_000)) as i64);
                let exact = (i128::from(x.to_bits()) - low) as u128;
                let u = u128::from(f.unit(x));
                assert!(u * width as u128 <= exact << 63 && (u + 1) * width as u128 > exact << 63, "{x}");
                assert!((f.abscissa(u as u64).to_bits() - x.to_bits()).abs() <= 2, "{x}");
            }
            let ends = f.domain();
            assert_eq!(
                (f.unit(ends.0), f.unit(ends.1), f.unit(Wide::MIN), f.unit(Wide::MAX)),
                (0, ONE_UQ63, 0, ONE_UQ63)
            );
            assert_eq!((f.abscissa(0), f.abscissa(ONE_UQ63)), ends);
        }
    }

    #[test]
    fn reals_are_rounded_outward() {
        for (value, below, above) in
            [(0, 0, 0), (1, 0, 1), (-1, -1, 0), (1 << 31, 1, 1), ((1 << 31) + 1, 1, 2)]
        {
            assert_eq!(
                (real_below(value), real_above(value)),
                (Real::from_bits(below), Real::from_bits(above))
            );
        }
        assert_eq!((real_above(i64::MAX), real_below(i64::MIN)), (Real::MAX, Real::MIN));
    }

    /// A polynomial of `x` on the unit interval: `2 - 3 x + x^2 / 2` over `[-3, 5]` is
    /// `31/2 - 48 u + 32 u^2`; halves of a unit are rounded upwards.
    #[test]
    fn coefficients_are_those_of_the_unit_interval() {
        let wide = |v: f64| Wide::from_num(v);
        let q = on_unit_interval::<3>(0, &[wide(2.0), wide(-3.0), wide(0.5)], -3 << 48, 8 << 48).unwrap();
        let value = |v: f64| (v * 2_f64.powi(55)) as i64;
        assert_eq!(q, Polynomial { constant: value(15.5), powers: [value(-48.0), value(32.0), 0] });
        // x_0 = 2^-48: 128 c of its units of 2^-55, over 2^48
        for (c, rounded) in [((1 << 40) - 1, 0), (1 << 40, 1), (3 << 40, 2), (-1 << 40, 0), (-3 << 40, -1)] {
            let q = on_unit_interval::<1>(0, &[Wide::ZERO, Wide::from_bits(c)], 1, 1 << 48).unwrap();
            assert_eq!(q.constant, rounded, "{c}");
        }
        let needed = on_unit_interval::<1>(0, &[Wide::ONE; 3], 0, 1 << 48).unwrap_err();
        assert!(matches!(needed, Error::Capacity { needed: 2, capacity: 1, .. }));
    }
}
