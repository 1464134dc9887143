//! Evaluation by composition of maps (Algorithm 2, eq. 24-28).
//!
//! The composite of an address `j1 j2 ... jk` sends the whole graph onto its part above one small interval.
//! It evaluates a function as the paper does; the boxes of a ray caster are images under composites. For
//! plain values the forward walk of [`Fif::at`] is faster.

use super::function::Fif;
use super::map::Map;
use super::polynomial::{Polynomial, twice_high};
use super::value::{FRACTION_Q55, ONE_UQ63};
use crate::num::{Real, Scaling, Wide, mul_high_u, real_from};
use crate::plane::Point2;

/// A composition of maps: `(u, y) -> (start + width u, scaling y + q(u))` in the unit abscissa.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Composite<const D: usize> {
    start: u64,
    width: u64,
    pub(super) scaling: i64,
    pub(super) q: Polynomial<D>,
}

impl<const D: usize> Composite<D> {
    /// The identity.
    pub const IDENTITY: Self = Self { start: 0, width: ONE_UQ63, scaling: i64::MAX, q: Polynomial::ZERO };

    /// `self` after `map`: eq. 24-27.
    fn then(&self, map: &Map<D>) -> Self {
        let part = |p: &Polynomial<D>| p.part(map.start, map.width);
        let mut q = part(&self.q);
        let inner = map.q.powers.iter().chain([&map.q.constant]);
        for (c, add) in q.powers.iter_mut().chain([&mut q.constant]).zip(inner) {
            *c = c.saturating_add(twice_high(*add, self.scaling));
        }
        Self {
            start: self.start.wrapping_add(mul_high_u(self.width, map.start << 1)),
            width: if map.width == ONE_UQ63 { self.width } else { mul_high_u(self.width, map.width << 1) },
            scaling: twice_high(self.scaling, map.scaling),
            q,
        }
    }

    /// The image's ordinate over the place `u` with the value `y`, both with the formats of the kernel.
    fn value(&self, u: u64, y: i64) -> i64 {
        twice_high(y, self.scaling).wrapping_add(self.q.at(u))
    }

    /// The image of a point of the graph (unit abscissa, value): another point of the graph, truncated and
    /// rounded to the format.
    pub fn image(&self, point: Point2) -> Point2 {
        let u = (point.x.to_bits().clamp(0, 1 << 24) as u64) << 39;
        let x =
            self.start.wrapping_add(if u == ONE_UQ63 { self.width } else { mul_high_u(self.width, u << 1) });
        let y = self.value(u, i64::from(point.y.to_bits()) << (FRACTION_Q55 - 24));
        Point2::new(Real::from_bits((x >> 39) as i32), real_from(y, FRACTION_Q55))
    }

    /// The interval that the whole domain is sent to, in the unit abscissa, truncated to the format (figure
    /// 2).
    pub fn interval(&self) -> (Real, Real) {
        let end = self.start.wrapping_add(self.width);
        (Real::from_bits((self.start >> 39) as i32), Real::from_bits((end >> 39) as i32))
    }

    /// The vertical scaling of the composition, truncated.
    pub fn vertical_scaling(&self) -> Scaling {
        Scaling::from_bits((self.scaling >> 32) as i32)
    }
}

impl<const N: usize, const D: usize> Fif<N, D> {
    /// The composition of the maps of an address (0 for the first map), the first digit outermost. Digits
    /// beyond the last map count as it.
    pub fn composite(&self, address: impl IntoIterator<Item = usize>) -> Composite<D> {
        address.into_iter().fold(Composite::IDENTITY, |composite, digit| {
            let digit = digit.min(self.maps.len().saturating_sub(1));
            self.maps.get(digit).map_or(composite, |map| composite.then(map))
        })
    }

    /// The value near `x` by composition (Algorithm 2): maps are composed until the horizontal factor is at
    /// most `epsilon`, then the median knot is sent through the composite.
    ///
    /// Result: the value at some abscissa within `epsilon (x_N - x_0)` of `x` (at least `2^-40` of the
    /// domain). Error: there below [`Fif::error_bound`] for degree 1 (row
    /// `Fif::at_by_composition (integral of g)`). Cost: `D^2` products of 64 bits a level, at most 32,768
    /// levels: where a map takes more than 0.9995 of the domain, they may end at an interval wider than
    /// `epsilon`.
    pub fn at_by_composition(&self, x: Wide, epsilon: Real) -> Real {
        let composite = self.composite_at(x, epsilon, self.levels);
        let median = self.maps.get(self.maps.len() / 2).map_or(0, |m| m.start);
        let y = self
            .maps
            .get(self.maps.len() / 2)
            .map_or(0, |m| m.q.at(0).wrapping_add(twice_high(self.first, m.scaling)));
        real_from(composite.value(median, y), FRACTION_Q55)
    }

    /// The composition of the first maps of the address of `x`, as many as it takes until the horizontal
    /// factor is at most `epsilon` (at least `2^-40`), and no more than `most`. Cost: as
    /// [`Fif::at_by_composition`].
    pub fn composite_at(&self, x: Wide, epsilon: Real, most: u32) -> Composite<D> {
        let epsilon = (epsilon.to_bits().max(0) as u64).saturating_mul(1 << 39).clamp(1 << 23, ONE_UQ63);
        let mut u = self.unit(x);
        let mut composite = Composite::IDENTITY;
        for _ in 0..self.levels.min(most) {
            let index = self.maps.partition_point(|m| m.start <= u).min(self.maps.len()).saturating_sub(1);
            let Some(map) = self.maps.get(index) else { break };
            u = map.per_width.quotient(u.saturating_sub(map.start)).min(ONE_UQ63);
            composite = composite.then(map);
            if composite.width <= epsilon {
                break;
            }
        }
        composite
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fif::Knot;

    /// Parts of a quarter, a half and a quarter.
    fn function() -> Fif<3, 1> {
        let knots =
            [(1, 1), (2, 3), (4, -2), (5, 2)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        Fif::interpolating(&knots, &[0.5, -0.75, 0.25].map(Scaling::from_num)).unwrap()
    }

    /// `1 - x^2 / 2 + x^3` and a line below it, with scalings: both maps have powers that the other's are
    /// composed with.
    fn cubic() -> Fif<2, 3> {
        let wide = |cs: [f64; 4]| cs.map(Wide::from_num);
        // q_1(2) + f(2) / 2 = q_2(0) - f(0) / 4 for f(0) = 2 q_1(0) = 2, f(2) = q_2(2) / (5/4) = 4
        let (left, right) = (wide([1.0, 0.25, -0.5, 0.125]), wide([3.0, 0.5, 0.0, 0.125]));
        let knots = [0, 1, 2].map(Wide::from_num);
        Fif::from_polynomials(&knots, &[0.5, -0.25].map(Scaling::from_num), &[&left, &right]).unwrap()
    }

    /// Start and width in 256ths, the scaling in 256ths: the product of the widths and of the scalings, the
    /// first digit outermost.
    #[test]
    fn an_address_is_an_interval() {
        let f = function();
        let real = |n: i32| Real::from_bits(n << 16);
        for (address, start, width, scaling) in [
            (&[][..], 0, 256, 256),
            (&[0], 0, 64, 128),
            (&[1], 64, 128, -192),
            (&[2], 192, 64, 64),
            (&[1, 2], 64 + 96, 32, -48),
            (&[2, 1], 192 + 16, 32, -48),
            (&[1, 1], 64 + 32, 64, 144),
            // digits beyond the last map count as it
            (&[9, 0, 3], 192 + 12, 4, 8),
        ] {
            let composite = f.composite(address.iter().copied());
            assert_eq!(composite.interval(), (real(start), real(start + width)), "{address:?}");
            let exact = (i64::from(scaling) << 23).min((1 << 31) - 1);
            let got = i64::from(composite.vertical_scaling().to_bits());
            assert!((exact - 1..=exact).contains(&got), "{address:?}: {got} against {exact}");
        }
    }

    /// The image of a point of the graph is one map after the other, from the last digit on: in integers, `y`
    /// and `q` with 80 fractional bits.
    #[test]
    fn an_image_is_that_of_one_map_after_the_other() {
        let f = cubic();
        for word in 0..1024_usize {
            let digits = |k: usize| (0..k).rev().map(move |i| word >> i & 1);
            for length in [1, 2, 3, 7, 10] {
                let composite = f.composite(digits(length));
                for (x, y) in [(0, 512), (1 << 24, -1024), (3 << 20, 77), (1 << 23, 0), (-5, 5), (1 << 25, 9)]
                {
                    let (mut t, mut exact) = (i128::from(x.clamp(0, 1 << 24)) << 39, i128::from(y) << 56);
                    for digit in (0..length).map(|i| word >> i & 1) {
                        let map = &f.maps[digit];
                        // 40 bits of the abscissa are all it has in ten halvings
                        let at = t >> 28;
                        let q = map
                            .q
                            .powers
                            .iter()
                            .rev()
                            .fold(0, |q, c| ((q + (i128::from(*c) << 20)) * at) >> 35);
                        let q = (q + (i128::from(map.q.constant) << 20)) << 5;
                        exact = q + ((exact * i128::from(map.scaling >> 32)) >> 31);
                        t = (t + ((digit as i128) << 63)) >> 1;
                    }
                    let image = composite.image(Point2::new(Real::from_bits(x), Real::from_bits(y)));
                    assert_eq!(i128::from(image.x.to_bits()), t >> 39, "{word:b} {length} {x}");
                    // half a unit of 2^-24, and a hundred of 2^-55
                    let off = exact - (i128::from(image.y.to_bits()) << 56);
                    assert!(off.abs() <= (1 << 55) + (1 << 32), "{word:b} {length} {x} {y}: {off}");
                }
            }
        }
    }

    /// As many maps as it takes, by the interval's width; no more than the most.
    #[test]
    fn maps_are_composed_until_the_interval_is_narrow_enough() {
        let f = cubic();
        let x = Wide::from_num(1.3125); // 0.65625: the digits 1 0 1 0 1
        let width = |epsilon: Real, most: u32| {
            let (low, high) = f.composite_at(x, epsilon, most).interval();
            (high - low, low)
        };
        let real = |v: f64| Real::from_num(v);
        assert_eq!(width(real(0.125), 99), (real(0.125), real(0.625)));
        assert_eq!(width(real(0.125) - Real::DELTA, 99), (real(0.0625), real(0.625)));
        assert_eq!(width(real(0.126), 99), (real(0.125), real(0.625)));
        assert_eq!(width(Real::ZERO, 5), (real(0.03125), real(0.65625)));
        assert_eq!(width(Real::ZERO, 0), (Real::ONE, Real::ZERO));
        assert_eq!(width(Real::MAX, 9), (real(0.5), real(0.5)));
        // epsilon counts as 2^-40 at least
        assert_eq!(f.composite_at(x, Real::ZERO, 99).width, ONE_UQ63 >> 40);
        assert_eq!(f.composite_at(x, Real::MIN, 99).width, ONE_UQ63 >> 40);
    }

    /// The value is that of the middle knot's image: here a dyadic place, where the walk along the address
    /// gives the same.
    #[test]
    fn composition_and_walk_agree_at_the_image_of_the_middle_knot() {
        for x in (0..=64).map(|k| Wide::from_num(1) + Wide::from_num(k) / 16) {
            let f = function();
            for epsilon in [1.0, 0.2, 0.01, 1e-5].map(Real::from_num) {
                let composite = f.composite_at(x, epsilon, 99);
                // the second of three maps begins at a quarter
                let u = composite.start + (composite.width >> 2);
                let got = f.at_by_composition(x, epsilon);
                let want = super::super::value::wide(f.evaluate(u));
                let off = (i128::from(got.to_bits()) << 24) - i128::from(want.to_bits());
                assert!(off.abs() <= (1 << 23) + 8, "{x} {epsilon}: {got} against {want}");
                assert!(f.unit(x) >= composite.start && f.unit(x) <= composite.start + composite.width);
                assert!(composite.width >> 39 <= epsilon.to_bits() as u64);
            }
        }
    }

    /// The map of a single interval leaves it as it is; an address is no longer than the function's own.
    #[test]
    fn a_map_of_the_whole_domain_is_composed_as_often_as_wanted() {
        let knots = [(0, 1), (4, 3)].map(|(x, y)| Knot::new(Wide::from_num(x), Wide::from_num(y)));
        let line = Fif::<1, 1>::interpolating(&knots, &[Scaling::from_num(0.5)]).unwrap();
        let composite = line.composite([0, 0, 0]);
        assert_eq!(composite.interval(), (Real::ZERO, Real::ONE));
        assert_eq!(composite.image(Point2::new(Real::ONE, Real::ZERO)).x, Real::ONE);
        // nearly all of the domain belongs to one part: it never becomes narrow
        let knots = [0, 1, 1 << 50].map(|x| Knot::new(Wide::from_bits(x), Wide::ZERO));
        let f = Fif::<2, 1>::interpolating(&knots, &[Scaling::ZERO; 2]).unwrap();
        assert_eq!(f.levels, 29);
        assert!(f.composite_at(Wide::from_bits(1 << 49), Real::ZERO, u32::MAX).width > ONE_UQ63 / 2);
    }
}
