//! The torus: a tube round a ring of radius 1 about the z axis,
//! `F = (sqrt(x^2 + y^2) - 1)^2 + z^2 - tube^2`.
//!
//! Along a ray, let `s` be the length from the point nearest to the centre, `m` the distance of that point,
//! `p` its height, and `u` how fast the ray rises. With `h = (s^2 + m^2 - 1 - tube^2) / 2` and `z = p + u s`
//! the ray is inside where
//!
//! `g(s) = h^2 + z^2 - tube^2 < 0`:
//!
//! a quartic without a cubic term. Words are enough for `h` and `z`, which on the torus are no larger than
//! the tube. Its derivative `2 (h s + z u) = s^3 + P s + Q`, `P = m^2 - 1 - tube^2 + 2 u^2`, `Q = 2 p u`,
//! vanishes at one or three places. The ray is turned round where `Q > 0`, so that the outermost of them is
//! the last; Newton's method finds it, a quadratic equation the other two. A minimum below 0 has a crossing
//! on each side: Newton's method again, from where the parabola at the minimum has it, bracketed by the
//! neighbours.
//!
//! Source: Cychosz, "Intersecting a Ray with an Elliptical Torus", Graphics Gems II, 1991. Only the height
//! and the distance count, a ray that is turned about the axis being the same: whatever rounding does to
//! them, `g` is that of some ray `2^-29` away.
//!
//! Formats: `s`, `p`, `u` 30 fractional bits, `h` and `z` 29, `g` 58.

use core::num::NonZeroU32;
use core::ops::ControlFlow;

use super::super::surface::Chart;
use super::shape::{NearCrossing, NearRay, Shape};
use crate::Error;
use crate::num::formats::{Q26, Q27, Q28, Q29, Q30, Q31, Q58, Q60};
use crate::num::{
    Near, Real, Vec3, Wide, atan2, high, high_u, mul_high_short, product, rough_sqrt, sqrt, square,
};
use crate::num::{reciprocal_of, reciprocal_sqrt_of, scaled};

/// A torus: a tube round a ring of radius 1 about the z axis.
///
/// A crossing lies within `2^-24` of the surface (`hard_rays_cross_where_the_quartic_has_its_roots`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Torus {
    tube: Near,
}

impl Torus {
    /// The torus whose tube has this radius.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for less than `2^-7` or more than `1 - 2^-10`: a tube without width, and one as
    /// wide as its ring, are no tori.
    pub fn new(tube: Near) -> Result<Self, Error> {
        const MIN: Near = Near::lit("0.0078125");
        const MAX: Near = Near::lit("0.9990234375");
        if !(MIN..=MAX).contains(&tube) {
            let [value, min, max] = [tube, MIN, MAX].map(Wide::from);
            return Err(Error::OutOfRange { what: "tube", index: None, value, min, max });
        }
        Ok(Self { tube })
    }

    /// The radius of its tube.
    pub const fn tube(&self) -> Near {
        self.tube
    }
}

/// The reciprocal's mantissa and zeros; 0 counts as 1.
#[inline(always)]
fn reciprocal(v: u32) -> (Q31, u32) {
    reciprocal_of(NonZeroU32::new(v).unwrap_or(NonZeroU32::MIN))
}

/// The quartic `g` along a ray.
struct Quartic {
    /// `m^2 - 1 - tube^2`.
    twice_h: Q60,
    /// `p`, and half a unit of `z`.
    p: Q60,
    u: Q30,
    square_of_tube: Q58,
}

impl Quartic {
    /// `g`, and half its slope. Nowhere that `|s|` and `m` are below 2 does a sum leave its word.
    #[inline(always)]
    fn at(&self, s: Q30) -> (Q58, Q27) {
        let twice_h = self.twice_h + product(s, s);
        let (h, rest): (Q29, i32) = ((twice_h >> 32) as i32, (twice_h as u32 >> 1) as i32);
        let z = ((self.p + product(self.u, s)) >> 31) as i32;
        // with a wide tube the slope near the axis is that of a difference: h^2 takes the lower word too
        let square_of_h = product(h, h) + (i64::from(high(h, rest)) << 2);
        let value = square_of_h + product(z, z) - self.square_of_tube;
        (value, ((product(h, s) + product(z, self.u)) >> 32) as i32)
    }

    /// The root in a bracket at whose lower end `g` is above 0 if it `enters` there.
    #[inline(never)]
    fn root(&self, bracket: Bracket) -> Q30 {
        let Bracket { mut low, mut high, start, enters } = bracket;
        let mut s = start.max(low).min(high);
        // roots that nearly coincide take up to twenty steps, others four
        for _ in 0..32 {
            let (value, slope) = self.at(s);
            if (value > 0) == enters {
                low = s;
            } else {
                high = s;
            }
            let (mantissa, zeros) = reciprocal(slope.unsigned_abs());
            let step = mul_high_short(value, mantissa) >> (32 - zeros);
            let next = i64::from(s) - if slope < 0 { -step } else { step };
            let size = step.unsigned_abs();
            // what is left behind is about the square of the step over the slope
            if size < 16 || size < 1 << 20 && size * size < u64::from(slope.unsigned_abs()) << 4 {
                return next.max(low.into()).min(high.into()) as i32;
            }
            s = if next <= i64::from(low) || next >= i64::from(high) {
                ((i64::from(low) + i64::from(high)) >> 1) as i32
            } else {
                next as i32
            };
        }
        s
    }
}

/// Between two neighbours of which `g` has opposite signs.
#[derive(Clone, Copy, Default)]
struct Bracket {
    low: Q30,
    high: Q30,
    start: Q30,
    enters: bool,
}

/// The derivative `s^3 + p s - r` of `g`, `r` at least 0.
struct Cubic {
    p: Q29,
    r: Q29,
}

impl Cubic {
    #[inline(always)]
    fn slope(&self, s: Q30) -> Q26 {
        (3 * (high(s, s) >> 2) + (self.p >> 3)).max(1)
    }

    /// The greatest root, at most `limit`: from the right, where the cubic is convex.
    #[inline(always)]
    fn outermost(&self, limit: Q30) -> Q30 {
        // r does not count for a narrow tube or a level ray; the first step leads beyond the root
        let mut s = rough_sqrt((i64::from(self.p) << 31).min(0).unsigned_abs()) as i32;
        for _ in 0..24 {
            // 27 and 25 fractional bits
            let value = high(s, (high(s, s) >> 1) + (self.p >> 2)) - (self.r >> 4);
            let slope = self.slope(s);
            let (mantissa, zeros) = reciprocal(slope as u32);
            let step = product(value, mantissa) >> (32 - zeros.max(1)) << 1;
            s = (i64::from(s) - step).max(0).min(limit.into()) as i32;
            let size = step.unsigned_abs();
            if size < 1 << 24 && size * size < u64::from(slope as u32) << 8 {
                break;
            }
        }
        s
    }

    /// About how far from a minimum of that depth `g` is 0: outwards, and inwards.
    ///
    /// `a d^2 +- c d^3 = depth` has the solution `w (1 -+ y / 2 + 5 y^2 / 8 ..)`, `w = sqrt(depth / a)`,
    /// `y = c w / a`.
    #[inline(always)]
    fn widths(&self, minimum: Q30, depth: Q58) -> [Q30; 2] {
        // 2 a
        let (mantissa, zeros) = reciprocal(self.slope(minimum) as u32);
        let quotient = mul_high_short(depth, mantissa);
        let square = if quotient.leading_zeros() < zeros + 2 { 1 << 62 } else { quotient << zeros >> 1 };
        let w = rough_sqrt(square as u64).min(i32::MAX as u32) as i32;
        // of a flat minimum no more than a half
        let y = (product(high(minimum.saturating_abs(), w), mantissa) >> (35 - zeros)).min(1 << 27) as Q28;
        let (half, second) = (y >> 1, 5 * (high(y, y) << 1));
        [second - half, second + half].map(|part| w.saturating_add(high(w, part) << 4))
    }
}

impl Shape for Torus {
    fn bounds(&self) -> Option<[Vec3<Near>; 2]> {
        let (reach, tube) = (Near::ONE + self.tube, self.tube);
        Some([Vec3::new(-reach, -reach, -tube), Vec3::new(reach, reach, tube)])
    }

    fn radius(&self) -> Option<Near> {
        Some(Near::ONE + self.tube)
    }

    fn most_crossings(&self) -> u32 {
        4
    }

    /// Error: times the sine of the angle between ray and surface
    /// (`hard_rays_cross_where_the_quartic_has_its_roots`).
    fn error(&self) -> Near {
        Near::DELTA * 16
    }

    fn cross(&self, ray: &NearRay, from: Near, found: &mut impl FnMut(NearCrossing) -> ControlFlow<()>) {
        let o = [ray.origin.x, ray.origin.y, ray.origin.z].map(Near::to_bits);
        let d = [ray.direction.x, ray.direction.y, ray.direction.z].map(Near::to_bits);
        let dot = |a: [i32; 3]| product(a[0], d[0]) + product(a[1], d[1]) + product(a[2], d[2]);
        // |d| is in [1, 4), so that half is 28 or 29: 1 / |d| = mantissa / 2^(31 + odd)
        let (mantissa, half) = reciprocal_sqrt_of(square(d));
        let odd = half & 1;
        let over_square = (high_u(mantissa as u32, mantissa as u32) >> (2 * odd)) as Q30;
        // the place nearest to the centre, in two steps: the second is below 2^-25
        let nearest: Q28 = -((product((dot(o) >> 30) as i32, over_square) >> 28) as i32);
        let place = |k: usize| {
            let v = (i64::from(o[k]) << 28) + product(nearest, d[k]);
            i32::try_from((v + (1 << 25)) >> 26).ok()
        };
        let (Some(x), Some(y), Some(z)) = (place(0), place(1), place(2)) else { return };
        // 52 fractional bits
        let left = (product((dot([x, y, z]) >> 8) as i32, over_square) >> 28) as i32;
        let moved = |c: Q30, d: Q28| c.saturating_sub((high(left, d) + (1 << 17)) >> 18);
        let place = [moved(x, d[0]), moved(y, d[1]), moved(z, d[2])];
        let nearest = nearest - ((left + (1 << 23)) >> 24);

        let distance = square(place);
        let reach = (1 << 28) + self.tube.to_bits();
        if distance >= (product(reach, reach) as u64) << 4 {
            return;
        }
        let u: Q30 = ((product(d[2], mantissa) + (1 << 28 << odd)) >> 29 >> odd) as i32;
        let square_of_tube = product(self.tube.to_bits(), self.tube.to_bits());
        let twice_h = distance as i64 - (1 << 60) - (square_of_tube << 4);
        let q: Q29 = (product(place[2], u) >> 30) as i32;
        let turned = q > 0;
        let cubic = Cubic { p: ((twice_h + 2 * product(u, u)) >> 31) as i32, r: q.abs() };
        let quartic = Quartic {
            twice_h,
            p: (i64::from(place[2]) << 30) + (1 << 30),
            u: if turned { -u } else { u },
            square_of_tube: square_of_tube << 2,
        };

        let mut brackets = [Bracket::default(); 4];
        let count = isolate(&quartic, &cubic, (reach - 1) << 2 | 3, &mut brackets);
        for k in 0..count {
            let bracket = brackets[(if turned { count - 1 - k } else { k } & 3) as usize];
            let s = quartic.root(bracket);
            let s = if turned { -s } else { s };
            let s = nearest.saturating_add((high(s, mantissa) + (1 << odd)) >> 1 >> odd);
            let crossing = NearCrossing { s: Near::from_bits(s), enters: k & 1 == 0, face: 0 };
            if crossing.s >= from && found(crossing).is_break() {
                return;
            }
        }
    }

    fn value(&self, place: Vec3) -> Wide {
        let [x, y, z] = [place.x, place.y, place.z].map(Real::to_bits);
        // 48 fractional bits
        let across = square([x, y, 0]);
        // rho with as many more bits as there is room for
        let places = (across.leading_zeros() >> 1).min(24);
        let twice_rho = i64::from(sqrt(across << (2 * places))) << (25 - places);
        let one = Wide::ONE.to_bits();
        let height = product(z, z) + one - (product(self.tube.to_bits(), self.tube.to_bits()) >> 8);
        // rho^2 is 2^15 at most
        Wide::from_bits((across.wrapping_sub(twice_rho as u64) as i64).saturating_add(height))
    }

    /// `((1 - 1 / rho) x, (1 - 1 / rho) y, z)`, `rho = sqrt(x^2 + y^2)`, of a length from 1/2 to 1.
    fn normal(&self, place: Vec3<Near>, _: u8) -> Vec3<Near> {
        let [x, y, z] = [place.x, place.y, place.z].map(Near::to_bits);
        let root = reciprocal_sqrt_of(square([x, y, 0]));
        let places = self.tube.to_bits().leading_zeros().saturating_sub(4) & 7;
        // the difference is within the tube's width, whatever its terms
        let outwards = |c: Q28| Near::from_bits(((c << 2).wrapping_sub(scaled(c, root)) << places) >> 2);
        Vec3::new(outwards(x), outwards(y), Near::from_bits(z << places))
    }

    /// `u` is the angle round the z axis from the x axis, `v` that round the tube from the outer equator
    /// upwards, in turns: `P = ((1 + tube cos v) cos u, (1 + tube cos v) sin u, tube sin v)`.
    fn chart(&self, place: Vec3<Real>, _: u8) -> Chart {
        let [x, y, z] = [place.x, place.y, place.z].map(Real::to_bits);
        let across = square([x, y, 0]);
        let root = reciprocal_sqrt_of(across);
        let outwards = (sqrt(across).min(i32::MAX as u32) as i32).saturating_sub(1 << 24);
        let turns = |y, x| Real::from_bits((atan2(y, x).to_bits() >> 8) as i32);
        // a turn is 2 pi, 28 fractional bits
        let in_turns = |c: i32| {
            let v = product(c, 0x6487_ed51) >> 28;
            Real::from_bits(v.clamp(i32::MIN.into(), i32::MAX.into()) as i32)
        };
        // 30 fractional bits of the cosine and the sine of u
        let inwards = |c: i32| in_turns((-product(z, scaled(c, root)) >> 30) as i32);
        Chart {
            u: turns(y, x),
            v: turns(z, outwards),
            along_u: Vec3::new(in_turns(y.saturating_neg()), in_turns(x), Real::ZERO),
            along_v: Vec3::new(inwards(x), inwards(y), in_turns(outwards)),
        }
    }
}

/// Brackets of the crossings, in their order: 0, 2 or 4.
#[inline(always)]
fn isolate(quartic: &Quartic, cubic: &Cubic, limit: Q30, brackets: &mut [Bracket; 4]) -> u32 {
    let last = cubic.outermost(limit);
    let depth = -quartic.at(last).0;
    // the other two are -last / 2 -+ sqrt(rest)
    let rest = (product(last, last) >> 2) - product(last, last) - (i64::from(cubic.p) << 31);
    if rest <= 0 {
        if depth <= 0 {
            return 0;
        }
        let [outwards, inwards] = cubic.widths(last, depth);
        brackets[0] = Bracket { low: -limit, high: last, start: last - inwards, enters: true };
        brackets[1] = Bracket { low: last, high: limit, start: last.saturating_add(outwards), enters: false };
        return 2;
    }
    let width = rough_sqrt(rest as u64).min(i32::MAX as u32) as i32;
    let (first, middle) = ((-(last >> 1)).saturating_sub(width).max(-limit), width - (last >> 1));
    let depth_of_first = -quartic.at(first).0;
    // one minimum alone always has a second crossing
    let parted = depth <= 0 || depth_of_first <= 0 || quartic.at(middle).0 >= 0;
    let mut count = 0;
    let mut push = |low, high, start, enters| {
        if let Some(bracket) = brackets.get_mut(count) {
            *bracket = Bracket { low, high, start, enters };
            count += 1;
        }
    };
    if depth_of_first > 0 {
        let [outwards, inwards] = cubic.widths(first, depth_of_first);
        push(-limit, first, first.saturating_sub(outwards), true);
        if parted {
            push(first, middle, first.saturating_add(inwards), false);
        }
    }
    if depth > 0 {
        let [outwards, inwards] = cubic.widths(last, depth);
        if parted {
            push(middle, last, last - inwards, true);
        }
        push(last, limit, last.saturating_add(outwards), false);
    }
    count as u32
}

#[cfg(test)]
mod tests {
    extern crate std;
    use core::f64::consts::{PI, TAU};
    use std::vec::Vec;

    use rand_xoshiro::Xoshiro128PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    use super::*;

    fn value_of(polynomial: &[f64], x: f64) -> f64 {
        polynomial.iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    /// The roots in a bracket, by bisection between those of the derivative.
    fn roots(polynomial: &[f64], low: f64, high: f64) -> Vec<f64> {
        if polynomial.len() < 2 {
            return Vec::new();
        }
        let derivative: Vec<f64> = (1..polynomial.len()).map(|k| k as f64 * polynomial[k]).collect();
        let mut marks = roots(&derivative, low, high);
        marks.insert(0, low);
        marks.push(high);
        let mut found = Vec::new();
        for pair in marks.windows(2) {
            let (mut a, mut b) = (pair[0], pair[1]);
            let sign = value_of(polynomial, a) < 0.0;
            if (value_of(polynomial, b) < 0.0) == sign {
                continue;
            }
            for _ in 0..60 {
                let middle = (a + b) / 2.0;
                if (value_of(polynomial, middle) < 0.0) == sign { a = middle } else { b = middle }
            }
            found.push((a + b) / 2.0);
        }
        found
    }

    /// A ray in f64, by the place nearest to the centre, and how far from there the origin is.
    struct Exact {
        place: [f64; 3],
        along: [f64; 3],
        origin: f64,
        length: f64,
        tube: f64,
    }

    impl Exact {
        fn new(ray: &NearRay, torus: &Torus) -> Self {
            let o = [ray.origin.x, ray.origin.y, ray.origin.z].map(|c| c.to_num::<f64>());
            let d = [ray.direction.x, ray.direction.y, ray.direction.z].map(|c| c.to_num::<f64>());
            let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
            let along = d.map(|c| c / length);
            let origin = o[0] * along[0] + o[1] * along[1] + o[2] * along[2];
            let place = [0, 1, 2].map(|k: usize| o[k] - origin * along[k]);
            Self { place, along, origin, length, tube: torus.tube().to_num() }
        }

        /// `g`, its coefficients from the constant one on.
        fn quartic(&self) -> [f64; 5] {
            let [p, u] = [self.place[2], self.along[2]];
            let square: f64 = self.place.iter().map(|c| c * c).sum();
            let h = (square - 1.0 - self.tube * self.tube) / 2.0;
            [h * h + p * p - self.tube * self.tube, 2.0 * p * u, h + u * u, 0.0, 0.25]
        }

        /// The distance from the surface after a length.
        fn distance(&self, s: f64) -> f64 {
            let [x, y, z] = [0, 1, 2].map(|k: usize| self.place[k] + s * self.along[k]);
            (x.hypot(y) - 1.0).hypot(z) - self.tube
        }

        /// How fast that changes.
        fn sine(&self, s: f64) -> f64 {
            let [x, y, z] = [0, 1, 2].map(|k: usize| self.place[k] + s * self.along[k]);
            let (rho, [a, b, c]) = (x.hypot(y), self.along);
            ((rho - 1.0) * (x * a + y * b) / rho + z * c) / (rho - 1.0).hypot(z)
        }
    }

    fn random(rng: &mut Xoshiro128PlusPlus) -> f64 {
        f64::from(rng.next_u32()) / 2_f64.powi(32)
    }

    fn near(v: [f64; 3]) -> Vec3<Near> {
        let [x, y, z] = v.map(Near::from_num);
        Vec3::new(x, y, z)
    }

    /// Rays of a world that touch or nearly touch, from up to 60 away and from inside the tube, with
    /// components of 0, moved near.
    fn hard_rays(seed: u64) -> impl Iterator<Item = (Torus, NearRay)> {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(seed);
        (0_u32..).filter_map(move |i| {
            let mut random = || random(&mut rng);
            let tube = match i % 5 {
                0 => 0.999,
                1 => 0.02,
                _ => 0.02 + 0.979 * random(),
            };
            // a place on the tube, just inside or outside, in its middle, or anywhere
            let (turn, around) = (random() * TAU, random() * TAU);
            let depth = [1.0, 1.0 - 1e-6 / tube, 1.0 + 1e-6 / tube, 0.0];
            let depth = tube * depth.get(i as usize % 7).copied().unwrap_or(1.2 * random());
            let rho = 1.0 + depth * around.cos();
            let place = [rho * turn.cos(), rho * turn.sin(), depth * around.sin()];
            let far = [3.0, 60.0, 1.2][i as usize % 3];
            let origin = if i % 2 == 0 {
                // in the tangential plane; along the ring at times
                let tilt = random() * TAU * [0.0, 1e-3, 1.0].get(i as usize / 2 % 13).unwrap_or(&1.0);
                let (ring, tube) = (tilt.cos(), tilt.sin());
                let length = far * (0.3 + 0.7 * random());
                let x = -turn.sin() * ring - around.sin() * turn.cos() * tube;
                let y = turn.cos() * ring - around.sin() * turn.sin() * tube;
                let tangent = [x, y, around.cos() * tube];
                [0, 1, 2].map(|k: usize| place[k] + length * tangent[k])
            } else {
                [(); 3].map(|()| (random() * 2.0 - 1.0) * far)
            };
            let mut direction = [0, 1, 2].map(|k: usize| place[k] - origin[k]);
            match i % 11 {
                0 => (direction[0], direction[1]) = (0.0, 0.0),
                1 => direction[2] = 0.0,
                2 => direction[0] = 0.0,
                _ => (),
            }
            let greatest = direction.iter().fold(0.0_f64, |g, c| g.max(c.abs()));
            if greatest < 1e-6 {
                return None;
            }
            let scale = (1.0 + 0.9999 * random()) / greatest;
            let d = direction.map(|c| c * scale);
            let square: f64 = d.iter().map(|c| c * c).sum();
            let t = -(0..3).map(|k| origin[k] * d[k]).sum::<f64>() / square;
            let t = t + (random() * 2.0 - 1.0) * [1.0, 0.0, 0.2, 0.2][i as usize % 4];
            let o = [0, 1, 2].map(|k: usize| origin[k] + t * d[k]);
            let torus = Torus::new(Near::from_num(tube)).ok()?;
            let is_near = o.iter().all(|c| c.abs() <= 4.0);
            is_near.then(|| (torus, NearRay { origin: near(o), direction: near(d) }))
        })
    }

    fn crossings(torus: &Torus, ray: &NearRay, from: Near) -> Vec<NearCrossing> {
        let mut found = Vec::new();
        torus.cross(ray, from, &mut |crossing| {
            found.push(crossing);
            ControlFlow::Continue(())
        });
        found
    }

    fn try_hard_rays(seed: u64, count: usize) {
        let (mut counts, mut unsure, mut inside) = ([0; 5], 0, 0);
        let (mut distance, mut error, mut steep) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (torus, ray) in hard_rays(seed).take(count) {
            let exact = Exact::new(&ray, &torus);
            let quartic = exact.quartic();
            let derivative = [quartic[1], 2.0 * quartic[2], 0.0, 1.0];
            let found = crossings(&torus, &ray, Near::MIN);
            assert!(
                found.is_sorted_by_key(|c| c.s) && found.len().is_multiple_of(2),
                "{torus:?} {ray:?} {found:?}"
            );
            assert!(found.iter().enumerate().all(|(k, c)| c.enters == (k % 2 == 0)), "{found:?}");
            // from the origin on
            let start = exact.distance(exact.origin);
            if start.abs() > 2_f64.powi(-22) {
                let ahead = crossings(&torus, &ray, Near::ZERO);
                assert_eq!(ahead.len() % 2 == 1, start < 0.0, "{torus:?} {ray:?} {ahead:?}");
                inside += u32::from(start < 0.0);
            }
            if roots(&derivative, -2.5, 2.5).iter().any(|s| exact.distance(*s).abs() < 2_f64.powi(-22)) {
                unsure += 1;
                continue;
            }
            let truth = roots(&quartic, -2.5, 2.5);
            assert_eq!(found.len(), truth.len(), "{torus:?} {ray:?}: {found:?} {truth:?}");
            counts[found.len()] += 1;
            for (crossing, truth) in found.iter().zip(truth) {
                let s = crossing.s.to_num::<f64>() * exact.length + exact.origin;
                let off = (s - truth).abs() / exact.length;
                let sine = exact.sine(truth).abs();
                distance = distance.max(exact.distance(s).abs());
                error = error.max(off * sine);
                if sine > 2_f64.powi(-7) {
                    steep = steep.max(off);
                }
            }
        }
        std::println!(
            "{counts:?}, {unsure} near tangency, {inside} from inside: {distance:e} {error:e} {steep:e}"
        );
        assert!(counts[0] > count / 8 && counts[2] > count / 2 && counts[4] > count / 12, "{counts:?}");
        assert!(unsure < count / 6 && inside > count as u32 / 20, "{unsure} {inside}");
        let bound = Torus { tube: Near::ONE / 2 }.error().to_num::<f64>();
        assert!(error > bound / 32.0 && error < bound, "{error:e}");
        assert!(distance > 2_f64.powi(-28) && distance < 2_f64.powi(-24), "{distance:e}");
        assert!(steep > 1e-7 && steep < 5e-6, "{steep:e}");
    }

    #[test]
    fn hard_rays_cross_where_the_quartic_has_its_roots() {
        let _ = Torus::error;
        try_hard_rays(1, 30_000);
    }

    /// `cargo test --release -p attractor --lib a_million_hard_rays -- --ignored --nocapture`
    #[test]
    #[ignore = "takes ten seconds"]
    fn a_million_hard_rays() {
        try_hard_rays(2, 1_000_000);
    }

    /// Rays straight at a tube of every width from all round: each must be met.
    #[test]
    fn the_surface_has_no_pinholes() {
        let mut tried = 0;
        for tube in [0.0078125, 0.02, 0.3, 0.75, 0.999] {
            let torus = Torus::new(Near::from_num(tube)).unwrap();
            for i in 0..4000_u32 {
                // a spiral round the ring, towards its middle, from twice the distance of the surface
                let (turn, around) = (f64::from(i) * 0.001 * PI, f64::from(i) * 2.399_963);
                let at = |depth: f64| {
                    let rho = 1.0 + depth * around.cos();
                    [rho * turn.cos(), rho * turn.sin(), depth * around.sin()]
                };
                let (from, to) = (at(2.0 * tube), at(0.0));
                let way = [0, 1, 2].map(|k: usize| to[k] - from[k]);
                let greatest = way.iter().fold(0.0_f64, |g, c| g.max(c.abs()));
                let ray = NearRay { origin: near(from), direction: near(way.map(|c| c / greatest * 1.5)) };
                let found = crossings(&torus, &ray, Near::ZERO);
                let first = found.first().unwrap_or_else(|| panic!("{tube} {i}: {ray:?}"));
                // a wide tube may be met on its other side, through the hole
                let exact = Exact::new(&ray, &torus);
                let s = first.s.to_num::<f64>() * exact.length + exact.origin;
                assert!(exact.distance(s).abs() < 2_f64.powi(-24), "{tube} {i}: {found:?}");
                assert!(first.enters || tube > 0.5, "{tube} {i}: {found:?}");
                tried += 1;
            }
        }
        assert_eq!(tried, 20_000);
    }

    #[test]
    fn what_is_no_torus_is_refused() {
        let refused = |tube: f64| match Torus::new(Near::from_num(tube)) {
            Err(Error::OutOfRange { what: "tube", index: None, value, min, max }) => {
                assert_eq!(
                    (value, min, max),
                    (Near::from_num(tube).into(), Wide::lit("0.0078125"), Wide::lit("0.9990234375"))
                );
                true
            }
            _ => false,
        };
        assert!([-0.5, 0.0, 0.0078, 0.9991, 1.0, 2.0].into_iter().all(refused));
        for tube in [0.0078125, 0.5, 0.9990234375] {
            let torus = Torus::new(Near::from_num(tube)).unwrap();
            let [low, high] = torus.bounds().unwrap();
            assert_eq!((torus.tube(), torus.most_crossings()), (Near::from_num(tube), 4));
            assert_eq!(high, near([1.0 + tube, 1.0 + tube, tube]));
            assert_eq!((low.x, low.y, low.z), (-high.x, -high.y, -high.z));
        }
    }

    #[test]
    fn the_function_is_that_of_the_formula() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(3);
        let torus = Torus::new(Near::lit("0.3")).unwrap();
        let tube = torus.tube().to_num::<f64>();
        let mut worst = 0.0_f64;
        for i in 0..20_000 {
            let size = [1.5, 1.5, 20.0, 0.001][i % 4];
            let place = [(); 3].map(|()| Real::from_num((random(&mut rng) * 2.0 - 1.0) * size));
            let [x, y, z] = place.map(|c| c.to_num::<f64>());
            let exact = (x.hypot(y) - 1.0).powi(2) + z * z - tube * tube;
            let value = torus.value(Vec3::new(place[0], place[1], place[2])).to_num::<f64>();
            worst = worst.max((value - exact).abs() / x.hypot(y).max(1.0));
        }
        assert!(worst > 2_f64.powi(-34) && worst < 2_f64.powi(-30), "{worst:e}");
        let corner = Vec3::new(Real::MIN, Real::MIN, Real::MIN);
        assert_eq!(torus.value(corner), Wide::MAX);
    }

    #[test]
    fn normals_and_charts_are_those_of_the_parametrisation() {
        let mut rng = Xoshiro128PlusPlus::seed_from_u64(4);
        let (mut worst, mut moved, mut turned) = (0.0_f64, 0.0_f64, 0.0_f64);
        for i in 0..20_000 {
            let tube = [0.0078125, 0.3, 0.9, 0.999][i % 4];
            let torus = Torus::new(Near::from_num(tube)).unwrap();
            let (u, v) = (random(&mut rng), random(&mut rng));
            let ([sin_u, cos_u], [sin_v, cos_v]) =
                ([(u * TAU).sin(), (u * TAU).cos()], [(v * TAU).sin(), (v * TAU).cos()]);
            let rho = 1.0 + tube * cos_v;
            let place = [rho * cos_u, rho * sin_u, tube * sin_v];
            let normal = torus.normal(near(place), 0);
            let normal = [normal.x, normal.y, normal.z].map(|c| c.to_num::<f64>());
            let length = normal.iter().map(|c| c * c).sum::<f64>().sqrt();
            assert!((0.49..1.01).contains(&length), "{tube}: {length}");
            let exact = [cos_v * cos_u, cos_v * sin_u, sin_v];
            // a place has 2^-29, which a thin tube magnifies, and the axis
            let scale = tube * rho.min(1.0);
            for k in 0..3 {
                worst = worst.max((normal[k] / length - exact[k]).abs() * scale);
            }
            let [x, y, z] = place.map(Real::from_num);
            let chart = torus.chart(Vec3::new(x, y, z), 0);
            let off = |got: Real, exact: f64| {
                let off = got.to_num::<f64>() - exact;
                (off - off.round()).abs()
            };
            turned = turned.max(off(chart.u, u) * rho.min(1.0)).max(off(chart.v, v) * tube);
            let along_u = [-rho * sin_u, rho * cos_u, 0.0].map(|c| c * TAU);
            let along_v = [-sin_v * cos_u, -sin_v * sin_u, cos_v].map(|c| c * TAU * tube);
            for (got, exact) in [(chart.along_u, along_u), (chart.along_v, along_v)] {
                let got = [got.x, got.y, got.z].map(|c| c.to_num::<f64>());
                for k in 0..3 {
                    moved = moved.max((got[k] - exact[k]).abs() * rho.min(1.0));
                }
            }
        }
        assert!(worst > 2_f64.powi(-31) && worst < 2_f64.powi(-27), "{worst:e}");
        assert!(turned > 2_f64.powi(-27) && turned < 2_f64.powi(-23), "{turned:e}");
        assert!(moved > 2_f64.powi(-24) && moved < 2_f64.powi(-20), "{moved:e}");
    }
}
