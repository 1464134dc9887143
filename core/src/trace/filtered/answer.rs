//! How a surface answers light over a box, by the points that stand for its normals.
//!
//! A point with the slopes `(p, q)`, `n = (-p, -q, 1)`, is seen on an area of the pixel in proportion to
//! `w = -n . d`: the box shows `sum w tone / sum w`. With `n^ = n / |n|`:
//! - diffuse `n^ . l`;
//! - Phong's mirrored ray against the light, `m . l = d . l - 2 (n^ . d) (n^ . l)`;
//! - tiny mirrors that lean at random about each of the normals: Torrance and Sparrow's highlight;
//! - the mirrored ray itself, `d - 2 (n^ . d) n^`.
//!
//! Diffuse light changes so little over a pixel that four points stand for all of it, and one box is
//! answered to second order; what is mirrored has four points for each, but a checkerboard one look-up.
//!
//! Formats: slopes and `w` 24 fractional bits, unit vectors and tones 30.

use core::num::NonZeroU32;

use super::footprint::Footprint;
use super::ground::Ground;
use super::slopes::{Slope, Spread, times};
use crate::num::{Unit, Vec3, high, product, reciprocal_of, reciprocal_sqrt_of, rounded_down};
use crate::trace::environment::{Around, Checkerboard, Environment};
use crate::trace::finish::Finish;
use crate::trace::material::{Sight, TorranceSparrow};
use crate::trace::power::{powers, times as part_of};

/// What light a box is seen in.
#[derive(Debug, Clone, Copy)]
pub(super) struct View<'a> {
    /// The direction of the ray, of length 1.
    direction: [i32; 3],
    light: [i32; 3],
    /// `d . l`.
    straight: i32,
    finish: Finish,
    environment: &'a Environment,
    checkerboard: Option<&'a Checkerboard>,
}

/// A normal: its length's reciprocal, and how it stands to eye and light.
#[derive(Debug, Clone, Copy)]
struct Facing {
    /// `-n . d`, 22 fractional bits.
    area: i32,
    /// `-n^ . d` and `n^ . l`.
    eye: i32,
    lit: i32,
    root: (i32, u32),
}

/// What a pixel has shown so far: the matt part or the reflection, and the highlight, of so many boxes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Shown {
    pub(super) boxes: i64,
    pub(super) matt: i64,
    pub(super) highlight: i64,
}

/// `n . v`, 22 fractional bits.
#[inline(always)]
fn dot([p, q]: Slope, [x, y, z]: [i32; 3]) -> i32 {
    (z >> 8).wrapping_sub(((product(p, x) + product(q, y)) >> 32) as i32)
}

/// `a b` of numbers with 30 fractional bits.
#[inline(always)]
fn unit_product(a: i32, b: i32) -> i32 {
    rounded_down::<30>(product(a, b))
}

impl Facing {
    #[inline(always)]
    fn new(slope: Slope, view: &View<'_>) -> Self {
        let [p, q] = slope;
        // at least 2^48
        let root = reciprocal_sqrt_of((product(p, p) + product(q, q) + (1 << 48)) as u64);
        let area = dot(slope, view.direction).wrapping_neg();
        let lit = dot(slope, view.light);
        Self { area, eye: cosine(area, root), lit: cosine(lit, root), root }
    }
}

/// What is no longer than a normal (22 fractional bits) over its length, 30 fractional bits, of which 28
/// count.
#[inline(always)]
fn cosine(v: i32, (mantissa, half): (i32, u32)) -> i32 {
    // a length of at least 1 and below 2^7: half is 24 to 30
    high(v << (31_u32.wrapping_sub(half) & 31), mantissa) << 2
}

/// A number with 24 fractional bits over the length of a normal, 30 fractional bits.
#[inline(always)]
fn scaled(v: i32, (mantissa, half): (i32, u32)) -> i32 {
    (product(v, mantissa) >> ((half + 1) & 63)) as i32
}

/// The tone of a matt surface.
#[inline(always)]
fn matte(ambient: Unit, matt: Unit) -> Unit {
    ambient.saturating_add(part_of(Unit::ONE.saturating_sub(ambient), matt)).min(Unit::ONE)
}

impl<'a> View<'a> {
    pub(super) fn new(
        direction: Vec3<Unit>,
        light: Vec3<Unit>,
        finish: Finish,
        environment: &'a Environment,
        checkerboard: Option<&'a Checkerboard>,
    ) -> Self {
        let [direction, towards] = [direction, light].map(|v| [v.x, v.y, v.z].map(Unit::to_bits));
        let straight = direction.iter().zip(towards).fold(0, |sum, (a, b)| sum + unit_product(*a, b));
        Self { direction, light: towards, straight, finish, environment, checkerboard }
    }

    /// What a box shows in diffuse light, to second order; none where a part of it may turn away.
    ///
    /// `c = n^ . l` and `w = -n . d` as functions of the slopes, `S` their covariance, `u` the slopes over
    /// `|n|`: `E(w c) / E(w) = c + w' S c' / w + tr(c'' S) / 2` with `w' = d`, `c' = -(l + c u) / |n|` and
    /// `tr(c'' S) = (2 l S u + 3 c u S u - c tr S) / |n|^2`.
    #[inline(always)]
    pub(super) fn glance(&self, ambient: Unit, spread: &Spread) -> Option<Unit> {
        let Spread { mean, covariance: [pp, pq, qq] } = *spread;
        let facing = Facing::new(mean, self);
        let ([dx, dy, _], [lx, ly, _]) = (self.direction, self.light);
        let with = |[a, b]: Slope, x: i32, y: i32| unit_product(a, x).saturating_add(unit_product(b, y));
        let under = |x: i32, y: i32| [with([pp, pq], x, y), with([pq, qq], x, y)];
        let (along, to_light) = (under(dx, dy), under(lx, ly));
        // one deviation may not turn away
        let area = facing.area << 2;
        if area <= 0 || times(area, area) <= with(along, dx, dy) {
            return None;
        }
        let (c, root) = (facing.lit, facing.root);
        let [u, v] = mean.map(|s| scaled(s, root));
        let cross = scaled(with(to_light, dx, dy).saturating_add(unit_product(with(along, u, v), c)), root);
        let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(area.unsigned_abs())?);
        let cross = (product(cross, mantissa) >> (38_u32.saturating_sub(zeros) & 63)) as i32;
        let own = with(under(u, v), u, v).saturating_mul(3).saturating_sub(pp).saturating_sub(qq);
        let bent = (with(to_light, u, v) << 1).saturating_add(unit_product(own, c));
        let bent = unit_product(scaled(bent, root), scaled(1 << 24, root)) >> 1;
        let matt = Unit::from_bits(c.saturating_sub(cross).saturating_add(bent).clamp(0, 1 << 30));
        Some(matte(ambient, matt))
    }

    /// What the footprint shows; none where a part of it may turn away from the eye.
    #[inline(always)]
    pub(super) fn tone(&self, ground: &[Ground<'_>; 2], footprint: &Footprint) -> Option<Unit> {
        let mut shown = Shown::default();
        if let (Finish::Mirror, Some(checkerboard)) = (self.finish, self.checkerboard) {
            footprint.each(ground, |slopes| {
                let mirrored = self.mirrored(&Spread::of(slopes, footprint.half()))?;
                shown.boxes += 1;
                shown.matt += i64::from(checkerboard.over(&mirrored).to_bits());
                Some(())
            })?;
            return Some(self.finished(&shown));
        }
        footprint.each(ground, |slopes| self.add(&slopes.points(), &mut shown))?;
        Some(self.finished(&shown))
    }

    /// What four points show that stand for all of a pixel; none where one turns away from the eye.
    #[inline(always)]
    pub(super) fn shown(&self, points: &[Slope; 4]) -> Option<Unit> {
        let mut shown = Shown::default();
        self.add(points, &mut shown)?;
        Some(self.finished(&shown))
    }

    /// Adds what four points show; none where one turns away from the eye.
    #[inline(always)]
    fn add(&self, points: &[Slope; 4], shown: &mut Shown) -> Option<()> {
        shown.boxes += 1;
        let (area, matt, highlight) = self.seen(points)?;
        let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(area)?);
        let over = |sum: i64| product((sum << (zeros & 31) >> 32) as i32, mantissa) >> 30;
        shown.matt += over(matt);
        shown.highlight += over(highlight);
        Some(())
    }

    /// What four points show, each on its area: the sum of the areas, 20 fractional bits, and of what they
    /// show times them, 50; none where one turns away from the eye.
    #[inline(always)]
    pub(super) fn seen(&self, points: &[Slope; 4]) -> Option<(u32, i64, i64)> {
        let (mut area, mut matt, mut highlight) = (0_u32, 0_i64, 0_i64);
        let (mut along, mut weights) = ([0; 4], [0; 4]);
        for ((slope, along), weight) in points.iter().zip(&mut along).zip(&mut weights) {
            let facing = Facing::new(*slope, self);
            if facing.area <= 0 {
                return None;
            }
            // 20 fractional bits: below 2^26
            *weight = facing.area >> 2;
            area = area.wrapping_add(weight.unsigned_abs());
            let lit = facing.lit.max(0);
            let tone = match self.finish {
                Finish::Diffuse { .. } => lit,
                Finish::TorranceSparrow { roughness, reflectance, .. } => {
                    let model = TorranceSparrow::within(roughness, reflectance);
                    highlight += product(self.sheen(*slope, &facing, model).to_bits(), *weight);
                    lit
                }
                Finish::Phong { .. } => {
                    let twice = (product(facing.eye, facing.lit) >> 29) as i32;
                    *along = self.straight.saturating_add(twice);
                    lit
                }
                Finish::Mirror => self.reflection(*slope, &facing).to_bits(),
            };
            matt += product(tone, *weight);
        }
        // of all four at once
        if let Finish::Phong { shininess, .. } = self.finish {
            for (shown, weight) in powers(along, shininess).into_iter().zip(weights) {
                highlight += product(shown, weight);
            }
        }
        Some((area, matt, highlight))
    }

    /// The highlight of tiny mirrors.
    fn sheen(&self, [p, q]: Slope, facing: &Facing, model: TorranceSparrow) -> Unit {
        let [x, y, z] = [p.wrapping_neg(), q.wrapping_neg(), 1 << 24]
            .map(|c| Unit::from_bits(scaled(c, facing.root).clamp(-1 << 30, 1 << 30)));
        let vector =
            |[x, y, z]: [i32; 3]| Vec3::new(Unit::from_bits(x), Unit::from_bits(y), Unit::from_bits(z));
        let direction = vector(self.direction);
        let sight = Sight { normal: Vec3::new(x, y, z), direction, tangent: Vec3::default() };
        model.tone(&sight, vector(self.light))
    }

    /// The mirrored rays of a box; none where a part of the box may turn away.
    ///
    /// Slopes with the covariance `S` are seen on areas `w = -n . d`, so that their mean is that of all and
    /// `S d / w`. About it the mirrored ray `d + 2 w n / |n|^2` changes by `2 (p d + d_x n - w (1, 0, 0)) /
    /// |n|^2` with `p`, and alike with `q`, but for its length, which does not matter.
    #[inline(always)]
    fn mirrored(&self, spread: &Spread) -> Option<Around> {
        let Spread { mean, covariance: [pp, pq, qq] } = *spread;
        let [dx, dy, dz] = self.direction;
        let sum = |a: i32, b: i32, c: i32, d: i32| rounded_down::<30>(product(a, b) + product(c, d));
        let along = [sum(pp, dx, pq, dy), sum(pq, dx, qq, dy)];
        // one deviation may not turn away
        let area = dot(mean, self.direction).wrapping_neg() << 2;
        if area <= 0 || times(area, area) <= sum(along[0], dx, along[1], dy) {
            return None;
        }
        // 1 / w, 25 fractional bits, at most 32: so flat nothing is seen
        let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(area.max(1 << 19).unsigned_abs())?);
        let per_area = mantissa >> (13_u32.wrapping_sub(zeros) & 31);
        let seen = |mean: i32, along: i32| mean.saturating_add(rounded_down::<25>(product(along, per_area)));
        let [p, q] = [seen(mean[0], along[0]), seen(mean[1], along[1])];
        let Facing { eye, root, .. } = Facing::new([p, q], self);
        let [p, q, up] = [p >> 2, q >> 2, 1 << 22].map(|c| cosine(c, root));
        let turned = sum(p, dy, q.wrapping_neg(), dx);
        let changes = [
            [eye.wrapping_neg(), turned, sum(p, dz, up, dx)],
            [turned.wrapping_neg(), eye.wrapping_neg(), sum(q, dz, up, dy)],
        ];
        // times 4 / |n|^2
        let square = unit_product(up, up);
        let covariance = [pp, pq, qq].map(|c| rounded_down::<28>(product(c, square)));
        let ahead = |d: i32, n: i32| d.wrapping_add(rounded_down::<29>(product(eye, n)));
        let e = [ahead(dx, p.wrapping_neg()), ahead(dy, q.wrapping_neg()), ahead(dz, up)];
        Some(Around { e, changes, covariance })
    }

    /// What the mirrored ray meets.
    #[inline(always)]
    fn reflection(&self, [p, q]: Slope, facing: &Facing) -> Unit {
        let twice = facing.eye << 1;
        let along = |d: i32, n: i32| {
            Unit::from_bits(
                d.saturating_add(unit_product(twice, scaled(n, facing.root))).clamp(-1 << 30, 1 << 30),
            )
        };
        let [x, y, z] = self.direction;
        let z = along(z, 1 << 24);
        // a gradient looks at the height alone
        let level = !matches!(self.environment, Environment::Checkerboard { .. });
        let [x, y] =
            if level { [Unit::ZERO; 2] } else { [along(x, p.wrapping_neg()), along(y, q.wrapping_neg())] };
        self.environment.tone(Vec3::new(x, y, z))
    }

    /// The tone of all boxes together.
    #[inline(always)]
    pub(super) fn finished(&self, shown: &Shown) -> Unit {
        const PART: [i32; 13] = {
            let (mut part, mut n) = ([0; 13], 1);
            while n < 13 {
                part[n] = (1 << 30) / n as i32;
                n += 1;
            }
            part
        };
        let part = PART.get(shown.boxes as usize).copied().unwrap_or(0);
        // a sum of at most twelve ones
        let mean =
            |sum: i64| Unit::from_bits((((sum >> 4) * i64::from(part)) >> 26).clamp(0, 1 << 30) as i32);
        let (matt, highlight) = (mean(shown.matt), mean(shown.highlight));
        match self.finish {
            Finish::Diffuse { ambient } => matte(ambient, matt),
            Finish::Phong { ambient, diffuse, specular, .. }
            | Finish::TorranceSparrow { ambient, diffuse, specular, .. } => {
                let matt = ambient.saturating_add(part_of(diffuse, matt)).min(Unit::ONE);
                matt.saturating_add(part_of(specular, highlight)).min(Unit::ONE)
            }
            Finish::Mirror => matt,
        }
    }
}
