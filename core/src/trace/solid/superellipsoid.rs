//! The superellipsoid: `F = (|x|^n + |y|^n)^(m / n) + |z|^m - 1`.
//!
//! It is inside where `N = (F + 1)^(1 / m)` is below 1, and `N` is the norm of a place made of two norms of
//! two numbers: `N = |rho, z|_m`, `rho = |x, y|_n`, `|a, b|_n = (|a|^n + |b|^n)^(1 / n)`. All is computed in
//! logarithms, by `log |a, b|_n = log a + log(1 + (b / a)^n) / n` for `a >= b`, where nothing overflows.
//!
//! Exponents of 1 and more: `N` is convex along a ray, so that Newton's method from where the ray enters the
//! cube `[-1, 1]^3` never passes the crossing by, and `N` above 1 that rises is a miss. The derivatives,
//! `dN / d rho = (rho / N)^(m - 1)` and likewise the others, are at most 1.
//!
//! An exponent below 1: `N` grows with `|x|`, `|y|` and `|z|`, so that over a part of the ray it lies between
//! its values for the least and the greatest of each. A part where both are above 1, or both below, is done;
//! any other is halved, front to back, until it is shorter than `2^-20`.
//!
//! Source: Barr, "Superquadrics and Angle-Preserving Transformations", IEEE Computer Graphics and
//! Applications 1(1), 1981; Duff, "Interval Arithmetic and Recursive Subdivision for Implicit Functions",
//! SIGGRAPH 1992.
//!
//! Formats: `s` and places 28 fractional bits, logarithms and exponents 24, `N` and its derivatives 30.

use core::num::NonZeroU32;
use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::shape::{NearCrossing, NearRay, Shape};
use crate::Error;
use crate::num::formats::{Q24, Q28, Q30, UQ24, UQ28};
use crate::num::{Near, Real, Vec3, Wide, atan2, exp2_minus, log2, product, product_u, reciprocal_of};

/// A superellipsoid with half-axes of 1: sphere (2, 2), cube with rounded edges (above), octahedron (1, 1),
/// star (below).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Superellipsoid {
    across: Norm,
    upright: Norm,
}

/// `|a, b|_n` in logarithms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Norm {
    /// `n`.
    exponent: UQ24,
    /// `1 / n`, at most 5.
    inverse: UQ28,
}

/// The negative logarithm of nothing.
const NOTHING: Q24 = i32::MAX;
/// `N` within `2^-22` of 1 counts as 1.
const SLACK: Q24 = 1 << 2;

/// The negative logarithm of a number with so many fractional bits.
#[inline(always)]
fn logarithm(v: u32, fraction: u32) -> Q24 {
    if v == 0 { NOTHING } else { (fraction << 24) as i32 - log2(v.into()) as i32 }
}

/// `2^-(factor l)` for a factor that is not negative; 1 for an `l` below 0.
#[inline(always)]
fn power(l: Q24, factor: UQ24) -> Q30 {
    if factor == 0 { 1 << 30 } else { exp2_minus(product_u(l.max(0) as u32, factor) >> 16) }
}

impl Norm {
    fn new(exponent: Real) -> Self {
        let exponent = exponent.to_bits().unsigned_abs().max(1);
        let inverse = ((1_u64 << 52) + u64::from(exponent / 2)) / u64::from(exponent);
        Self { exponent, inverse: inverse as u32 }
    }

    /// The negative logarithm of the norm of two numbers with these.
    #[inline(always)]
    fn of(self, a: Q24, b: Q24) -> Q24 {
        let (larger, smaller) = (a.min(b), a.max(b));
        if smaller == NOTHING {
            return larger;
        }
        // a ratio of 2^-32 and less is nothing
        let halvings = product_u(smaller.wrapping_sub(larger) as u32, self.exponent) >> 16;
        if halvings >> 37 > 0 {
            return larger;
        }
        let sum = (1 << 30) + exp2_minus(halvings) as u32;
        let growth = log2(sum.into()) - (30 << 24);
        larger - (product_u(growth, self.inverse) >> 28) as i32
    }
}

impl Superellipsoid {
    /// The superellipsoid with these exponents, `n` in planes across the z axis, `m` along it.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an exponent outside 0.2 to 20.
    pub fn new(n: Real, m: Real) -> Result<Self, Error> {
        const MIN: Real = Real::lit("0.2");
        const MAX: Real = Real::lit("20");
        for (what, exponent) in [("n", n), ("m", m)] {
            if !(MIN..=MAX).contains(&exponent) {
                let [value, min, max] = [exponent, MIN, MAX].map(Wide::from);
                return Err(Error::OutOfRange { what, index: None, value, min, max });
            }
        }
        Ok(Self { across: Norm::new(n), upright: Norm::new(m) })
    }

    /// Whether both exponents are 1 or more.
    fn is_convex(&self) -> bool {
        self.across.exponent >= 1 << 24 && self.upright.exponent >= 1 << 24
    }

    /// The negative logarithm of `N`, that of `rho`, and those of the coordinates.
    #[inline(always)]
    fn logarithms(&self, place: [u32; 3], fraction: u32) -> (Q24, Q24, [Q24; 3]) {
        let logarithms = place.map(|c| logarithm(c, fraction));
        let rho = self.across.of(logarithms[0], logarithms[1]);
        (self.upright.of(rho, logarithms[2]), rho, logarithms)
    }

    /// `1 / N` and the derivative of `N` at a place in the cube.
    #[inline(always)]
    fn slope(&self, place: [Q28; 3], direction: [Q28; 3]) -> (Q30, Q28) {
        let (norm, rho, [x, y, z]) = self.logarithms(place.map(i32::unsigned_abs), 28);
        let (n, m) = (self.across.exponent - (1 << 24), self.upright.exponent - (1 << 24));
        let along = |k: usize| if place[k] < 0 { -direction[k] } else { direction[k] };
        let part = |a: Q24, b: Q24, exponent: UQ24| power(a.saturating_sub(b), exponent);
        let level = product(part(x, rho, n), along(0)) + product(part(y, rho, n), along(1));
        let slope = product(part(rho, norm, m), (level >> 30) as i32) + product(part(z, norm, m), along(2));
        // N is 1 or more here: its logarithm is not above 0
        (power(norm.saturating_neg(), 1 << 24), (slope >> 30) as i32)
    }

    /// The crossing after `start` in the order of `s`, or against it: where `N` comes down to 1.
    #[inline(never)]
    fn descend(&self, line: &Line, start: Q28, end: Q28) -> Option<Q28> {
        let forwards = end >= start;
        let mut s = start;
        for _ in 0..32 {
            let (inverse, slope) = self.slope(line.at(s), line.direction);
            let over = (1 << 30) - inverse;
            if over <= 1 << 7 {
                return Some(s);
            }
            let fall = if forwards { slope.saturating_neg() } else { slope };
            // (N - 1) / N', N = 1 / inverse
            let fall = NonZeroU32::new((product(fall, inverse).max(0) >> 30) as u32)?;
            let (mantissa, zeros) = reciprocal_of(fall);
            // 30 + 62 - zeros - 28 fractional bits, then 28
            let step = (product(over, mantissa) >> (36 - zeros)).clamp(1, 1 << 31);
            let next = i64::from(s) + if forwards { step } else { -step };
            if if forwards { next > i64::from(end) } else { next < i64::from(end) } {
                return None;
            }
            s = next as i32;
        }
        Some(s)
    }

    /// Whether a part of the line is outside (true) or inside all along, by the bounds of `N`.
    #[inline(never)]
    fn whole(&self, [a, b]: [[Q28; 3]; 2]) -> Option<bool> {
        let pick = |choose: fn(u32, u32) -> u32| {
            [0, 1, 2].map(|k: usize| choose(a[k].unsigned_abs(), b[k].unsigned_abs()))
        };
        let mut least = pick(u32::min);
        for k in 0..3 {
            if (a[k] < 0) != (b[k] < 0) {
                least[k] = 0;
            }
        }
        if self.logarithms(least, 28).0 < -SLACK {
            return Some(true);
        }
        (self.logarithms(pick(u32::max), 28).0 > SLACK).then_some(false)
    }

    fn is_outside(&self, place: [Q28; 3]) -> bool {
        self.logarithms(place.map(i32::unsigned_abs), 28).0 <= 0
    }

    /// Crossings of a star, front to back.
    #[inline(never)]
    fn search(
        &self,
        line: &Line,
        [start, end]: [Q28; 2],
        found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        // ends of the parts that are left, nearest last: each is half as long as the one before
        let mut ends = [end; 32];
        let (mut left, mut from, mut outside) = (1_usize, start, self.is_outside(line.at(start)));
        // a change that is handed over once the ray is past what is too thin
        let (mut held, mut crossings) = (None::<Q28>, 0);
        for _ in 0..STEPS {
            let Some(to) = left.checked_sub(1).and_then(|last| ends.get(last)).copied() else { break };
            let places = [line.at(from), line.at(to)];
            let whole = match self.whole(places) {
                None if to.saturating_sub(from) <= THIN || left >= ends.len() => self.is_outside(places[1]),
                None => {
                    if let Some(place) = ends.get_mut(left) {
                        *place = ((i64::from(from) + i64::from(to)) >> 1) as i32;
                        left += 1;
                    }
                    continue;
                }
                Some(whole) => whole,
            };
            if whole != outside {
                outside = whole;
                held = if held.is_some() { None } else { Some(from) };
            }
            if let Some(s) = held.filter(|s| to.saturating_sub(*s) > THIN) {
                found(NearCrossing { s: Near::from_bits(s), enters: !outside, face: 0 })?;
                (held, crossings) = (None, crossings + 1);
            }
            (from, left) = (to, left - 1);
            if crossings >= MOST {
                break;
            }
        }
        // what is inside to the end leaves there, unless that is too thin; else it has left just before
        if outside == held.is_some() {
            let s = Near::from_bits(held.unwrap_or(end));
            found(NearCrossing { s, enters: false, face: 0 })?;
        }
        ControlFlow::Continue(())
    }
}

/// The most crossings of a star that are looked for, an even number; and the most parts.
const MOST: u32 = 15;
const STEPS: u32 = 4096;
/// A part of the ray no wider than `2^-20`, inside a star or between two arms, is rounding or left out.
const THIN: Q28 = 1 << 8;

/// A ray, in words.
struct Line {
    origin: [Q28; 3],
    direction: [Q28; 3],
}

impl Line {
    /// The place there, within the cube.
    #[inline(always)]
    fn at(&self, s: Q28) -> [Q28; 3] {
        // written out: on a Cortex-M0 an index of `map` is checked
        let ([x, y, z], [dx, dy, dz]) = (self.origin, self.direction);
        let along = |o: Q28, d: Q28| {
            let way = (product(s, d) + (1 << 27)) >> 28;
            (i64::from(o) + way).clamp(-1 << 28, 1 << 28) as i32
        };
        [along(x, dx), along(y, dy), along(z, dz)]
    }

    /// Where it is in the cube `[-1, 1]^3`.
    #[inline(always)]
    fn span(&self) -> Option<[Q28; 2]> {
        let (mut start, mut end) = (i64::from(i32::MIN), i64::from(i32::MAX));
        for (o, d) in self.origin.into_iter().zip(self.direction) {
            let o = if d < 0 { o.saturating_neg() } else { o };
            // a component of 0 counts as one unit
            let (mantissa, zeros) =
                reciprocal_of(NonZeroU32::new(d.unsigned_abs()).unwrap_or(NonZeroU32::MIN));
            // 28 + 62 - zeros - 28 fractional bits, then 28
            let after = |way: Q28| product(way, mantissa) >> (34 - zeros);
            start = start.max(after((-1_i32 << 28).saturating_sub(o)));
            end = end.min(after((1_i32 << 28).saturating_sub(o)) + 1);
        }
        (start < end).then_some([start as i32, end as i32])
    }
}

impl Shape for Superellipsoid {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        let one = Near::ONE;
        Some([Vec3::new(-one, -one, -one), Vec3::new(one, one, one)])
    }

    /// 2 for exponents of 1 and more; of a star no more than 16 are looked for.
    fn most_crossings(&self) -> u32 {
        if self.is_convex() { 2 } else { MOST + 1 }
    }

    /// Error: as said, where `N` changes at least half as fast as `s`
    /// (`crossings_are_those_of_the_function`).
    fn error(&self) -> Near {
        Near::DELTA * 320
    }

    /// What a star has, or what is between two of its arms, may be left out where it is thinner than `2^-18`
    /// along the ray (`a_million_rays_at_superellipsoids`).
    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let line = Line {
            origin: [ray.origin.x, ray.origin.y, ray.origin.z].map(Near::to_bits),
            direction: [ray.direction.x, ray.direction.y, ray.direction.z].map(Near::to_bits),
        };
        let Some([start, end]) = line.span() else { return };
        let from = from.to_bits();
        if end < from {
            return;
        }
        if !self.is_convex() {
            let _ = self.search(&line, [start.max(from), end], found);
            return;
        }
        let Some(enters) = self.descend(&line, start, end) else { return };
        let crossing = |s, enters| NearCrossing { s: Near::from_bits(s), enters, face: 0 };
        if enters >= from && found(crossing(enters, true)).is_break() {
            return;
        }
        let exits = self.descend(&line, end, enters).unwrap_or(enters);
        if exits >= from {
            let _ = found(crossing(exits, false));
        }
    }

    /// Error: below `2^-18 (1 + |F|)` (`the_function_is_that_of_the_formula`).
    fn value(&self, place: Vec3) -> Wide {
        let place = [place.x, place.y, place.z].map(|c| c.to_bits().unsigned_abs());
        let (norm, ..) = self.logarithms(place, 24);
        if norm == NOTHING {
            return -Wide::ONE;
        }
        // N^m
        let power = power_of_two((i64::from(norm) * i64::from(self.upright.exponent)) >> 24);
        Wide::from_bits(power.saturating_sub(Wide::ONE.to_bits()))
    }

    /// The gradient of `N`, so scaled that its greatest component is 1. A coordinate of 0 has the component
    /// 0: what both sides of an edge there have in the middle.
    fn normal(&self, place: Vec3<Near>, _: u8) -> Vec3<Near> {
        let place = [place.x, place.y, place.z].map(Near::to_bits);
        let (norm, rho, [x, y, z]) = self.logarithms(place.map(i32::unsigned_abs), 28);
        // the logarithm of (a / b)^(e - 1)
        let part = |a: Q24, b: Q24, of: Norm| {
            ((i64::from(a) - i64::from(b)) * (i64::from(of.exponent) - (1 << 24))) >> 24
        };
        let across = part(rho, norm, self.upright);
        let parts = [
            across + part(x, rho, self.across),
            across + part(y, rho, self.across),
            part(z, norm, self.upright),
        ];
        let steepest = (0..3).filter(|k| place[*k] != 0).map(|k| parts[k]).fold(i64::MAX, i64::min);
        let component = |k: usize| {
            let size = exp2_minus(parts[k].saturating_sub(steepest).max(0) as u64 * 256) >> 2;
            Near::from_bits(size * place[k].signum())
        };
        Vec3::new(component(0), component(1), component(2))
    }

    /// `u` is the longitude, `v` the latitude of Barr's parametrisation, from the south pole at 0 to the
    /// north pole at 1: with `w = 2 pi u`, `e = pi (v - 1 / 2)` and powers that keep the sign,
    /// `P = (cos(e)^(2 / m) cos(w)^(2 / n), cos(e)^(2 / m) sin(w)^(2 / n), sin(e)^(2 / m))`.
    fn chart(&self, place: Vec3<Real>, _: u8) -> Chart {
        let place = [place.x, place.y, place.z].map(Real::to_bits);
        let (norm, rho, [x, y, z]) = self.logarithms(place.map(i32::unsigned_abs), 24);
        let (across, upright) = (Curve::new(x, y, rho, self.across), Curve::new(rho, z, norm, self.upright));
        let signed = |v: Real, sign: i32| Real::from_bits(v.to_bits() * sign.signum());
        let u = atan2(across.sine * place[1].signum(), across.cosine * place[0].signum());
        let latitude = atan2(upright.sine * place[2].signum(), upright.cosine).to_bits() as i32;
        // a whole turn of u, half a turn of v
        let [x_u, y_u] = across.rates.map(|rate| rate.saturating_add(rate));
        let [rho_v, z_v] = upright.rates;
        // x and y are in proportion to rho
        let share =
            |l: Q24| Real::from_bits(power(l.saturating_sub(rho), 1 << 24) >> 6).saturating_mul(rho_v);
        Chart {
            u: Real::from_bits((u.to_bits() >> 8) as i32),
            v: Real::from_bits((latitude >> 7) + (1 << 23)),
            along_u: Vec3::new(signed(x_u, place[1].saturating_neg()), signed(y_u, place[0]), Real::ZERO),
            along_v: Vec3::new(
                signed(signed(share(x), place[0]), place[2].saturating_neg()),
                signed(signed(share(y), place[1]), place[2].saturating_neg()),
                z_v,
            ),
        }
    }
}

/// `2^-l` with 48 fractional bits, saturated, for an `l` with 24.
fn power_of_two(l: i64) -> i64 {
    let doublings = ((-l).max(0) + 0xff_ffff) >> 24;
    let part = exp2_minus(((l + (doublings << 24)).max(0) as u64) << 8);
    if doublings > 15 { i64::MAX } else { (i64::from(part) << 17).saturating_mul(2 << doublings) }
}

/// A place of the curve `a = r cos(w)^(2 / e), b = r sin(w)^(2 / e)`, in the first quadrant.
struct Curve {
    /// Both in proportion.
    cosine: Q30,
    sine: Q30,
    /// How fast `a` falls and `b` rises with `w`, over a turn of `pi`.
    rates: [Real; 2],
}

impl Curve {
    fn new(a: Q24, b: Q24, r: Q24, norm: Norm) -> Self {
        let part =
            |l: Q24| if l == NOTHING { 0 } else { power(l.saturating_sub(a.min(b)), norm.exponent >> 1) };
        // 2 / e r (p / r)^(1 - e / 2) (q / r)^(e / 2); nothing is the least number here
        let [a_near, b_near, r_near] = [a, b, r].map(|l| i64::from(l.min(32 << 24)));
        let half = i64::from(norm.exponent >> 1);
        let rate = |p: i64, q: i64| {
            let l = r_near + (((p - r_near) * ((1 << 24) - half) + (q - r_near) * half) >> 24);
            // 2 pi, 24 fractional bits, over e with 28
            let factor = (product_u(norm.inverse, 0x648_7ed5) >> 28) as i64;
            let size = Real::saturating_from_num(Wide::from_bits(power_of_two(l)));
            size.saturating_mul(Real::from_bits(factor as i32))
        };
        Self { cosine: part(a), sine: part(b), rates: [rate(a_near, b_near), rate(b_near, a_near)] }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use core::f64::consts::{PI, TAU};
    use std::vec::Vec;

    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    use super::*;

    fn norm_of_two(a: f64, b: f64, exponent: f64) -> f64 {
        let (larger, smaller) = (a.abs().max(b.abs()), a.abs().min(b.abs()));
        if larger == 0.0 {
            0.0
        } else {
            larger * (1.0 + (smaller / larger).powf(exponent)).powf(1.0 / exponent)
        }
    }

    fn norm([x, y, z]: [f64; 3], [n, m]: [f64; 2]) -> f64 {
        norm_of_two(norm_of_two(x, y, n), z, m)
    }

    fn random(rng: &mut Xoshiro128PlusPlus) -> f64 {
        f64::from(rng.next_u32()) / 2_f64.powi(32)
    }

    fn near(v: [f64; 3]) -> Vec3<Near> {
        let [x, y, z] = v.map(Near::from_num);
        Vec3::new(x, y, z)
    }

    /// A ray in f64.
    struct Exact {
        origin: [f64; 3],
        direction: [f64; 3],
        exponents: [f64; 2],
    }

    impl Exact {
        fn norm(&self, s: f64) -> f64 {
            norm(self.at(s), self.exponents)
        }

        fn at(&self, s: f64) -> [f64; 3] {
            [0, 1, 2].map(|k: usize| self.origin[k] + s * self.direction[k])
        }

        /// Where it is in the cube.
        fn span(&self) -> [f64; 2] {
            let (mut start, mut end) = (-8.0_f64, 8.0_f64);
            for k in 0..3 {
                let (o, d) = (self.origin[k], self.direction[k]);
                if d == 0.0 {
                    if o.abs() > 1.0 {
                        return [9.0, -9.0];
                    }
                } else {
                    start = start.max(((-1.0 - o) / d).min((1.0 - o) / d));
                    end = end.min(((-1.0 - o) / d).max((1.0 - o) / d));
                }
            }
            [start, end]
        }

        /// Where `N` is 1, by bounds over ever smaller parts: none where that takes too many.
        fn crossings(&self) -> Option<Vec<f64>> {
            let [mut from, end] = self.span();
            let (mut ends, mut found, mut outside, mut steps) = (std::vec![end], Vec::new(), true, 0);
            while let Some(&to) = ends.last() {
                if from >= end {
                    break;
                }
                steps += 1;
                if steps > 3000 {
                    return None;
                }
                let (a, b) = (self.at(from), self.at(to));
                let least = [0, 1, 2].map(|k: usize| {
                    if (a[k] < 0.0) == (b[k] < 0.0) { a[k].abs().min(b[k].abs()) } else { 0.0 }
                });
                let greatest = [0, 1, 2].map(|k: usize| a[k].abs().max(b[k].abs()));
                let here = if norm(least, self.exponents) > 1.0 {
                    true
                } else if norm(greatest, self.exponents) < 1.0 {
                    false
                } else if to - from < 2_f64.powi(-30) {
                    norm(b, self.exponents) > 1.0
                } else {
                    ends.push((from + to) / 2.0);
                    continue;
                };
                if here != outside {
                    found.push(from);
                    outside = here;
                }
                from = to;
                ends.pop();
            }
            if !outside {
                found.push(end);
            }
            Some(found)
        }

        /// Whether the count is not sure: a part inside, or between two of them, is thinner than `2^-18`; or
        /// `N` comes within `2^-20` of 1 and turns back, in a plane of symmetry too, where a star has edges.
        fn is_unsure(&self, truth: &[f64]) -> bool {
            let [start, end] = self.span();
            let width = (end - start) / 511.0;
            let mut places: Vec<f64> = (0..512).map(|k| start + width * f64::from(k)).collect();
            let edges = (0..3).map(|k: usize| -self.origin[k] / self.direction[k]);
            places.extend(edges.filter(|s| (start..end).contains(s)));
            places.sort_by(f64::total_cmp);
            let over = |s: f64, sign: f64| sign * (self.norm(s) - 1.0);
            let turns_at = |part: &[f64], sign: f64| {
                let [mut a, middle, mut b] = [part[0], part[1], part[2]];
                let mut least = over(middle, sign);
                if least > over(a, sign) || least > over(b, sign) {
                    return false;
                }
                for _ in 0..60 {
                    let (x, y) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
                    if over(x, sign) < over(y, sign) {
                        b = y
                    } else {
                        a = x
                    }
                    least = least.min(over(a, sign));
                }
                least.abs() < 2_f64.powi(-20)
            };
            truth.windows(2).any(|pair| pair[1] - pair[0] < 2_f64.powi(-18))
                || places.windows(3).any(|part| turns_at(part, 1.0) || turns_at(part, -1.0))
        }
    }

    fn exponent(random: f64, kind: u32) -> Real {
        Real::from_num(match kind {
            0 => 1.0 + 19.0 * random * random,
            1 => 0.2001 + 0.7999 * random,
            _ => 0.2001 * 99.9_f64.powf(random),
        })
    }

    /// Kinds: exponents of 1 and more, below 1, any.
    fn rays(kind: u32, seed: u64) -> impl Iterator<Item = (Superellipsoid, NearRay, Exact)> {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(seed);
        (0_u32..).filter_map(move |i| {
            let mut random = || random(&mut rng);
            let [n, m] = [(); 2].map(|()| exponent(random(), kind));
            let n = if i % 17 == 0 { Real::ONE } else { n };
            let size = if i % 5 == 0 { 0.2 } else { 0.95 };
            let mut place = [(); 3].map(|()| (random() * 2.0 - 1.0) * size);
            let mut way = [(); 3].map(|()| random() * 2.0 - 1.0);
            match i % 11 {
                0 => (way[0], way[1]) = (0.0, 0.0),
                1 => way[2] = 0.0,
                2 => way[0] = 0.0,
                3 => (place[0], way[0]) = (0.0, 0.0),
                _ => (),
            }
            let greatest = way.iter().fold(0.0_f64, |g, c| g.max(c.abs()));
            if greatest < 1e-6 {
                return None;
            }
            let scale = (1.0 + 0.999 * random()) / greatest;
            let t = random() * 2.0 - 1.0;
            let direction = near(way.map(|c| c * scale));
            let origin = near([0, 1, 2].map(|k: usize| place[k] - t * way[k] * scale));
            let numbers = |v: Vec3<Near>| [v.x, v.y, v.z].map(|c| c.to_num::<f64>());
            let exponents = [n, m].map(|e| e.to_num::<f64>());
            let exact = Exact { origin: numbers(origin), direction: numbers(direction), exponents };
            Some((Superellipsoid::new(n, m).ok()?, NearRay { origin, direction }, exact))
        })
    }

    fn crossings(shape: &Superellipsoid, ray: &NearRay, from: Near) -> Vec<NearCrossing> {
        let mut found = Vec::new();
        shape.cross(ray, from, &mut |crossing| {
            found.push(crossing);
            ControlFlow::Continue(())
        });
        found
    }

    fn try_rays(kind: u32, seed: u64, count: usize) {
        let (mut counts, mut unsure, mut inside, mut worst) = ([0; 17], 0, 0, 0.0_f64);
        for (shape, ray, exact) in rays(kind, seed).take(count) {
            let found = crossings(&shape, &ray, Near::MIN);
            assert!(
                found.is_sorted_by_key(|c| c.s) && found.len().is_multiple_of(2),
                "{shape:?} {ray:?} {found:?}"
            );
            assert!(found.iter().enumerate().all(|(k, c)| c.enters == (k % 2 == 0)), "{found:?}");
            assert!(found.len() <= shape.most_crossings() as usize);
            let Some(truth) = exact.crossings() else {
                unsure += 1;
                continue;
            };
            if found.len() != truth.len() {
                assert!(exact.is_unsure(&truth), "{shape:?} {ray:?}: {found:?} {truth:?}");
                unsure += 1;
                continue;
            }
            counts[found.len()] += 1;
            for (crossing, truth) in found.iter().zip(truth) {
                let off = (crossing.s.to_num::<f64>() - truth).abs();
                let slope = (exact.norm(truth + 1e-6) - exact.norm(truth - 1e-6)).abs() / 2e-6;
                if slope > 0.5 {
                    worst = worst.max(off);
                }
            }
            // a ray that starts inside leaves
            let start = exact.norm(0.0);
            if start < 0.999 {
                let ahead = crossings(&shape, &ray, Near::ZERO);
                assert!(ahead.len() % 2 == 1 && !ahead[0].enters, "{shape:?} {ray:?} {ahead:?}");
                inside += 1;
            }
        }
        std::println!("{kind}: {counts:?}, {unsure} unsure, {inside} from inside: {worst:e}");
        assert!(
            counts[0] > count / 20 && counts[2] > count / 4 && inside > count / 20,
            "{counts:?} {inside}"
        );
        assert!(kind == 0 || counts[4] > count / 50, "{counts:?}");
        assert!(unsure <= if kind == 0 { count / 5_000 } else { count / 80 }, "{unsure}");
        let bound = Superellipsoid::new(Real::ONE, Real::ONE).unwrap().error().to_num::<f64>();
        assert!(worst > bound / 32.0 && worst <= bound, "{worst:e}");
    }

    #[test]
    fn crossings_are_those_of_the_function() {
        try_rays(0, 1, 8_000);
        try_rays(1, 2, 4_000);
        try_rays(2, 3, 4_000);
        let _ = Superellipsoid::error;
    }

    /// `cargo test --release -p attractor --lib a_million_rays_at_superellipsoids -- --ignored --nocapture`
    #[test]
    #[ignore = "half a minute"]
    fn a_million_rays_at_superellipsoids() {
        try_rays(0, 4, 400_000);
        try_rays(1, 5, 300_000);
        try_rays(2, 6, 300_000);
    }

    /// It leaves at so small an angle that rounding brings it in again, for less than `2^-20`.
    #[test]
    fn rounding_makes_no_thin_parts() {
        let shape = Superellipsoid::new(Real::from_bits(13_307_354), Real::from_bits(84_421_382)).unwrap();
        let place = |x, y, z| Vec3::new(Near::lit(x), Near::lit(y), Near::lit(z));
        let ray = NearRay {
            origin: place("0.596560225", "-0.254346233", "-0.43616343"),
            direction: place("-0.25045871", "-0.108731464", "-1.249717366"),
        };
        let found = crossings(&shape, &ray, Near::MIN);
        let [enters, leaves] = found.as_slice() else { panic!("{found:?}") };
        let off = [(enters, 0.072_046_859_184), (leaves, 0.141_957_020_422)]
            .map(|(crossing, truth)| (crossing.s.to_num::<f64>() - truth).abs());
        assert!(off.iter().all(|off| *off < 2.5e-6), "{off:?}");
    }

    #[test]
    fn a_sphere_is_one_and_a_cube_almost() {
        let straight = |x: &str| NearRay {
            origin: Vec3::new(Near::lit(x), Near::ZERO, Near::lit("-2")),
            direction: Vec3::new(Near::ZERO, Near::ZERO, Near::ONE),
        };
        for (exponent, height) in [(2.0, 0.8), (20.0, 0.999_998), (1.0, 0.4), (0.5, 0.050_807)] {
            let e = Real::from_num(exponent);
            let shape = Superellipsoid::new(e, e).unwrap();
            let found = crossings(&shape, &straight("0.6"), Near::MIN);
            let [low, high] = [0, 1].map(|k: usize| found[k].s.to_num::<f64>() - 2.0);
            assert!((low + height).abs() < 2e-6 && (high - height).abs() < 2e-6, "{exponent}: {low} {high}");
            assert!(crossings(&shape, &straight("1.01"), Near::MIN).is_empty());
        }
    }

    #[test]
    fn exponents_beyond_their_range_are_refused() {
        let e = |v: f64| Real::from_num(v);
        assert!(matches!(
            Superellipsoid::new(e(2.0), e(0.19)),
            Err(Error::OutOfRange { what: "m", index: None, value, max, .. })
                if value == Wide::from(e(0.19)) && max == Wide::from_num(20)
        ));
        assert!(matches!(Superellipsoid::new(e(20.1), e(2.0)), Err(Error::OutOfRange { what: "n", .. })));
        for (n, m, most) in [("0.2", "20", 16), ("1", "1", 2), ("20", "0.2", 16), ("20", "20", 2)] {
            let [n, m] = [n, m].map(|text| text.parse().unwrap());
            let shape = Superellipsoid::new(n, m).unwrap();
            assert_eq!(shape.most_crossings(), most);
            assert_eq!(shape.bounds().unwrap()[1], near([1.0; 3]));
        }
    }

    #[test]
    fn the_function_is_that_of_the_formula() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(7);
        let mut worst = 0.0_f64;
        for i in 0..20_000_u32 {
            let [n, m] = [(); 2].map(|()| exponent(random(&mut rng), i % 3));
            let shape = Superellipsoid::new(n, m).unwrap();
            let size = [1.2, 1.2, 0.01, 20.0][i as usize % 4];
            let place = [(); 3].map(|()| Real::from_num((random(&mut rng) * 2.0 - 1.0) * size));
            let value = shape.value(Vec3::new(place[0], place[1], place[2])).to_num::<f64>();
            let m = m.to_num::<f64>();
            let exact = norm(place.map(|c| c.to_num()), [n.to_num(), m]).powf(m) - 1.0;
            if exact > 32_000.0 {
                assert!(value > 31_000.0, "{value} {exact}");
            } else {
                worst = worst.max((value - exact).abs() / (1.0 + exact.abs()));
            }
        }
        assert!(worst > 2_f64.powi(-22) && worst < 2_f64.powi(-18), "{worst:e}");
        let shape = Superellipsoid::new(Real::from_num(20), Real::from_num(20)).unwrap();
        assert_eq!(shape.value(Vec3::default()), -Wide::ONE);
        assert!(shape.value(Vec3::new(Real::MIN, Real::MIN, Real::MIN)) > 32_000);
    }

    #[test]
    fn normals_and_charts_are_those_of_the_parametrisation() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(8);
        let (mut worst, mut turned, mut moved, mut tried) = (0.0_f64, 0.0_f64, 0.0_f64, 0);
        for _ in 0..20_000 {
            let [n, m] = [(); 2].map(|()| Real::from_num(0.5 + 3.5 * random(&mut rng)));
            let shape = Superellipsoid::new(n, m).unwrap();
            let [n, m] = [n, m].map(|e| e.to_num::<f64>());
            // away from the poles and the planes, where some derivative has no bound
            let (u, v) = (random(&mut rng), 0.1 + 0.8 * random(&mut rng));
            let powers =
                |angle: f64, e: f64| [angle.cos(), angle.sin()].map(|c| c.signum() * c.abs().powf(2.0 / e));
            let at = |u: f64, v: f64| {
                let ([a, b], [rho, z]) = (powers(u * TAU, n), powers((v - 0.5) * PI, m));
                [rho * a, rho * b, z]
            };
            let place = at(u, v);
            if place.iter().any(|c| c.abs() < 0.03) {
                continue;
            }
            tried += 1;
            let chart = shape.chart(
                Vec3::new(Real::from_num(place[0]), Real::from_num(place[1]), Real::from_num(place[2])),
                0,
            );
            let wrapped = |off: f64| (off - off.round()).abs();
            turned =
                turned.max(wrapped(chart.u.to_num::<f64>() - u)).max((chart.v.to_num::<f64>() - v).abs());
            let difference = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k: usize| (a[k] - b[k]) / 2e-6);
            let exact =
                [difference(at(u + 1e-6, v), at(u - 1e-6, v)), difference(at(u, v + 1e-6), at(u, v - 1e-6))];
            let numbers = |v: Vec3| [v.x, v.y, v.z].map(|c| c.to_num::<f64>());
            for (got, exact) in [chart.along_u, chart.along_v].map(numbers).iter().zip(exact) {
                for k in 0..3 {
                    moved = moved.max((got[k] - exact[k]).abs() / exact[k].abs().max(1.0));
                }
            }
            // across both tangents
            let normal = shape.normal(near(place), 0);
            let normal = [normal.x, normal.y, normal.z].map(|c| c.to_num::<f64>());
            let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
            assert!(dot(normal, place) > 0.0 && normal.iter().any(|c| c.abs() == 1.0), "{normal:?}");
            for tangent in exact {
                let size = (dot(normal, normal) * dot(tangent, tangent)).sqrt();
                worst = worst.max(dot(normal, tangent).abs() / size);
            }
        }
        assert!(tried > 8_000 && worst > 1e-8 && worst < 1e-5, "{tried} {worst:e}");
        assert!(turned > 1e-8 && turned < 5e-6, "{turned:e}");
        assert!(moved > 1e-7 && moved < 1e-4, "{moved:e}");
        // on an edge, at a pole, at a tip of a star
        for e in ["0.2", "1", "2", "20"] {
            let e = e.parse().unwrap();
            let shape = Superellipsoid::new(e, e).unwrap();
            assert_eq!(shape.normal(near([0.0, 0.0, -1.0]), 0), near([0.0, 0.0, -1.0]));
            assert_eq!(shape.normal(near([1.0, 0.0, 0.0]), 0), near([1.0, 0.0, 0.0]));
            let pole = shape.chart(Vec3::new(Real::ZERO, Real::ZERO, Real::ONE), 0);
            assert_eq!(pole.v, Real::ONE);
        }
    }
}
