//! How a surface answers light over a box, by the points that stand for its normals.
//!
//! A point with the slopes `(p, q)`, `n = (-p, -q, 1)`, is seen on an area of the pixel in proportion to
//! `w = -n . d`: the box shows `sum w tone / sum w`. With `n^ = n / |n|`:
//! - diffuse `n^ . l`;
//! - Phong's mirrored ray against the light, `m . l = d . l - 2 (n^ . d) (n^ . l)`;
//! - the mirrored ray itself, `d - 2 (n^ . d) n^`.
//!
//! Diffuse light to second order: with `c = n^ . l` at the mean slopes, `n` and `l` their first two components,
//! `z` the third of `n^`, `S` the covariance,
//! `E(w n^ . l) / E w = c + z^2 / 2 (3 c n' S n - 2 l' S n - c tr S) + z (c n - l)' S d / w`.
//!
//! Formats: slopes and `w` 24 fractional bits, unit vectors and tones 30.

use core::num::NonZeroU32;

use super::footprint::Quality;
use super::slopes::{Slope, Slopes};
use crate::num::{Unit, Vec3, product, reciprocal_of, reciprocal_sqrt_of};
use crate::trace::environment::Environment;
use crate::trace::finish::Finish;
use crate::trace::power::{power, times};

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
    quality: Quality,
}

/// A normal: its length's reciprocal, and how it stands to eye and light.
#[derive(Debug, Clone, Copy)]
struct Facing {
    /// `-n . d`, 24 fractional bits.
    area: i32,
    /// `-n^ . d` and `n^ . l`.
    eye: i32,
    lit: i32,
    root: (i32, u32),
}

/// What a pixel has shown so far: the matt part or the reflection, and the highlight, of 4 times as many boxes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Shown {
    boxes: i64,
    matt: i64,
    highlight: i64,
}

/// `n . v`, 24 fractional bits.
#[inline(always)]
fn dot([p, q]: Slope, [x, y, z]: [i32; 3]) -> i32 {
    (z >> 6).wrapping_sub(((product(p, x) + product(q, y)) >> 30) as i32)
}

/// `a b` of numbers with 30 fractional bits.
#[inline(always)]
fn unit_product(a: i32, b: i32) -> i32 {
    (product(a, b) >> 30) as i32
}

impl Facing {
    #[inline(always)]
    fn new(slope: Slope, view: &View<'_>) -> Self {
        let [p, q] = slope;
        // at least 2^48
        let root = reciprocal_sqrt_of((product(p, p) + product(q, q) + (1 << 48)) as u64);
        let area = dot(slope, view.direction).wrapping_neg();
        let lit = dot(slope, view.light);
        Self { area, eye: scaled(area, root), lit: scaled(lit, root), root }
    }
}

/// A number with 24 fractional bits over the length of a normal, 30 fractional bits.
#[inline(always)]
fn scaled(v: i32, (mantissa, half): (i32, u32)) -> i32 {
    (product(v, mantissa) >> ((half + 1) & 63)) as i32
}

impl<'a> View<'a> {
    pub(super) fn new(
        direction: Vec3<Unit>,
        light: Vec3<Unit>,
        finish: Finish,
        environment: &'a Environment,
        quality: Quality,
    ) -> Self {
        let [direction, towards] = [direction, light].map(|v| [v.x, v.y, v.z].map(Unit::to_bits));
        let straight = direction.iter().zip(towards).fold(0, |sum, (a, b)| sum + unit_product(*a, b));
        Self { direction, light: towards, straight, finish, environment, quality }
    }

    /// Adds what a box shows; `false` where a part of it may turn away from the eye.
    #[inline(always)]
    pub(super) fn add(&self, slopes: &Slopes, shown: &mut Shown) -> bool {
        shown.boxes += 1;
        if let (Quality::Coarse, Finish::Diffuse { .. }) = (self.quality, self.finish)
            && let Some(lit) = self.second_order(slopes)
        {
            shown.matt += i64::from(lit);
            return true;
        }
        let (mut area, mut matt, mut highlight) = (0_u32, 0_i64, 0_i64);
        for slope in slopes.points() {
            let facing = Facing::new(slope, self);
            if facing.area <= 0 {
                return false;
            }
            // 20 fractional bits: below 2^26
            let weight = facing.area >> 4;
            area = area.wrapping_add(weight.unsigned_abs());
            let (a, b) = match self.finish {
                Finish::Diffuse { .. } => (facing.lit.max(0), 0),
                Finish::Phong { shininess, .. } => {
                    let along = self.straight.saturating_add(unit_product(facing.eye, facing.lit) << 1);
                    let along = Unit::from_bits(along.clamp(0, 1 << 30));
                    (facing.lit.max(0), power(along, shininess).to_bits())
                }
                Finish::Mirror => (self.reflection(slope, &facing).to_bits(), 0),
            };
            (matt, highlight) = (matt + product(a, weight), highlight + product(b, weight));
        }
        let Some(area) = NonZeroU32::new(area) else { return false };
        let (mantissa, zeros) = reciprocal_of(area);
        let over = |sum: i64| product((sum << (zeros & 31) >> 32) as i32, mantissa) >> 30;
        shown.matt += over(matt);
        shown.highlight += over(highlight);
        true
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

    /// Diffuse light to second order; none where some of the box may lie in the shade or turn away.
    #[inline(always)]
    fn second_order(&self, slopes: &Slopes) -> Option<i32> {
        let slope = slopes.mean();
        let facing = Facing::new(slope, self);
        // within two deviations of slopes of a half
        if facing.lit < 3 << 28 || facing.eye < 1 << 28 {
            return None;
        }
        let n = slope.map(|s| scaled(s.wrapping_neg(), facing.root));
        let z = scaled(1 << 24, facing.root);
        let [xx, xy, yy] = slopes.covariance();
        if xx | yy >= 1 << 25 {
            return None;
        }
        // S v, 24 fractional bits
        let times_s = |[x, y]: [i32; 2]| {
            let row = |a: i32, b: i32| ((product(a, x) + product(b, y)) >> 30) as i32;
            [row(xx, xy), row(xy, yy)]
        };
        let with = |[a, b]: [i32; 2], [x, y]: [i32; 2]| ((product(a, x) + product(b, y)) >> 30) as i32;
        let [lx, ly, _] = self.light;
        let [dx, dy, _] = self.direction;
        let (sn, c) = (times_s(n), facing.lit);
        let curved = unit_product(3 * with(sn, n) - xx - yy, c) - 2 * with(sn, [lx, ly]);
        let curved = unit_product(unit_product(curved, z), z) >> 1;
        // (c n - l)' S d / (w / |n|), with w / |n| the cosine to the eye, and z / w = z^2 / cosine
        let across = n.map(|n| unit_product(n, c));
        let tilt = with(times_s([dx, dy]), [across[0].wrapping_sub(lx), across[1].wrapping_sub(ly)]);
        let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(facing.eye.unsigned_abs())?);
        let tilt = unit_product(unit_product(tilt, z), z);
        // over a number with 30 fractional bits
        let tilt = (product(tilt, mantissa) >> ((32_u32.wrapping_sub(zeros)) & 63)) as i32;
        let sum = i64::from(c) + (i64::from(curved.saturating_add(tilt)) << 6);
        Some(sum.clamp(0, 1 << 30) as i32)
    }

    /// The tone of all boxes together.
    #[inline(always)]
    pub(super) fn tone(&self, shown: &Shown) -> Unit {
        const PART: [i32; 11] = {
            let (mut part, mut n) = ([0; 11], 1);
            while n < 11 {
                part[n] = (1 << 30) / n as i32;
                n += 1;
            }
            part
        };
        let part = PART.get(shown.boxes as usize).copied().unwrap_or(0);
        // a sum of at most ten ones
        let mean =
            |sum: i64| Unit::from_bits((((sum >> 4) * i64::from(part)) >> 26).clamp(0, 1 << 30) as i32);
        let (matt, highlight) = (mean(shown.matt), mean(shown.highlight));
        match self.finish {
            Finish::Diffuse { ambient } => {
                ambient.saturating_add(times(Unit::ONE.saturating_sub(ambient), matt)).min(Unit::ONE)
            }
            Finish::Phong { ambient, diffuse, specular, .. } => {
                let matt = ambient.saturating_add(times(diffuse, matt)).min(Unit::ONE);
                matt.saturating_add(times(specular, highlight)).min(Unit::ONE)
            }
            Finish::Mirror => matt,
        }
    }
}
