//! Evaluation by composition of maps (Algorithm 2, eq. 24-28).
//!
//! The composite of an address `j1 j2 ... jk` sends the whole graph onto its part above one small interval. It evaluates a function as the paper
//! does; the boxes of a ray caster are images under composites. For plain values the forward walk of [`Fif::at`] is faster.

use super::function::Fif;
use super::map::Map;
use super::polynomial::{Polynomial, twice_high};
use super::value::{FRACTION, ONE};
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
    pub const IDENTITY: Self = Self { start: 0, width: ONE, scaling: i64::MAX, q: Polynomial::ZERO };

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
            width: if map.width == ONE { self.width } else { mul_high_u(self.width, map.width << 1) },
            scaling: twice_high(self.scaling, map.scaling),
            q,
        }
    }

    /// The image's ordinate over the place `u` with the value `y`, both with the formats of the kernel.
    fn value(&self, u: u64, y: i64) -> i64 {
        twice_high(y, self.scaling).wrapping_add(self.q.at(u))
    }

    /// The image of a point of the graph (unit abscissa, value): another point of the graph, truncated and rounded to the format.
    pub fn image(&self, point: Point2) -> Point2 {
        let u = (point.x.to_bits().clamp(0, 1 << 24) as u64) << 39;
        let x = self.start.wrapping_add(if u == ONE { self.width } else { mul_high_u(self.width, u << 1) });
        let y = self.value(u, i64::from(point.y.to_bits()) << (FRACTION - 24));
        Point2::new(Real::from_bits((x >> 39) as i32), real_from(y, FRACTION))
    }

    /// The interval that the whole domain is sent to, in the unit abscissa, truncated to the format (figure 2).
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
    /// The composition of the maps of an address (0 for the first map), the first digit outermost. Digits beyond the last map count as it.
    pub fn composite(&self, address: impl IntoIterator<Item = usize>) -> Composite<D> {
        address.into_iter().fold(Composite::IDENTITY, |composite, digit| {
            let digit = digit.min(self.maps.len().saturating_sub(1));
            self.maps.get(digit).map_or(composite, |map| composite.then(map))
        })
    }

    /// The value near `x` by composition (Algorithm 2): maps are composed until the horizontal factor is at most `epsilon`, then the median knot is sent
    /// through the composite.
    ///
    /// Result: the value at some abscissa within `epsilon (x_N - x_0)` of `x` (at least `2^-40` of the domain). Error: there
    /// below [`Fif::error_bound`] for degree 1 (row `Fif::at_by_composition (integral of g)`). Cost: `D^2` products of 64 bits a level, at most 32,768 levels: where a map takes more than 0.9995 of the
    /// domain, they may end at an interval wider than `epsilon`.
    pub fn at_by_composition(&self, x: Wide, epsilon: Real) -> Real {
        let composite = self.composite_at(x, epsilon, self.levels);
        let median = self.maps.get(self.maps.len() / 2).map_or(0, |m| m.start);
        let y = self
            .maps
            .get(self.maps.len() / 2)
            .map_or(0, |m| m.q.at(0).wrapping_add(twice_high(self.first, m.scaling)));
        real_from(composite.value(median, y), FRACTION)
    }

    /// The composition of the first maps of the address of `x`, as many as it takes until the horizontal factor is at most `epsilon` (at least
    /// `2^-40`), and no more than `most`. Cost: as [`Fif::at_by_composition`].
    pub fn composite_at(&self, x: Wide, epsilon: Real, most: u32) -> Composite<D> {
        let epsilon = (epsilon.to_bits().max(0) as u64).saturating_mul(1 << 39).clamp(1 << 23, ONE);
        let mut u = self.unit(x);
        let mut composite = Composite::IDENTITY;
        for _ in 0..self.levels.min(most) {
            let index = self.maps.partition_point(|m| m.start <= u).min(self.maps.len()).saturating_sub(1);
            let Some(map) = self.maps.get(index) else { break };
            u = map.per_width.quotient(u.saturating_sub(map.start)).min(ONE);
            composite = composite.then(map);
            if composite.width <= epsilon {
                break;
            }
        }
        composite
    }
}
