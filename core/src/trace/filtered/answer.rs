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
//! answered to second order; what is mirrored has four points for each, a gentle highlight three, a
//! checkerboard one look-up.
//!
//! Formats: slopes and `w` 24 fractional bits, unit vectors and tones 30.

use core::num::NonZeroU32;

use super::footprint::Footprint;
use super::ground::Ground;
use super::slopes::{FAR, Slope, Slopes, Spread, times};
use crate::num::{
    Unit, Vec3, high, product, product_u, reciprocal_of, reciprocal_sqrt_of_long, rounded_down, scaled,
};
use crate::trace::environment::{Around, Checkerboard, Environment};
use crate::trace::finish::Finish;
use crate::trace::material::{Sight, TorranceSparrow};
use crate::trace::power::{Exponent, times as part_of};

/// The exponent of a highlight up to which three points of a box do, where there are more than two boxes.
const GENTLE: u16 = 16;

/// What light a box is seen in.
#[derive(Debug, Clone, Copy)]
pub(super) struct View<'a> {
    /// The direction of the ray, of length 1; its length does not matter where the finish is matt.
    direction: [i32; 3],
    light: [i32; 3],
    /// `d . l`, where there is a highlight of Phong's.
    straight: i32,
    finish: &'a Finish,
    environment: &'a Environment,
    checkerboard: Option<&'a Checkerboard>,
}

/// A normal: its length's reciprocal, and how it stands to eye and light.
#[derive(Debug, Clone, Copy)]
struct Facing {
    /// `-n . d` and `n . l`, 22 fractional bits.
    area: i32,
    light: i32,
    root: (i32, u32),
}

/// What a pixel has shown so far: the matt part or the reflection, and the highlight, of so many boxes,
/// twelve at most. 28 fractional bits.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Shown {
    pub(super) boxes: u32,
    pub(super) matt: u32,
    pub(super) highlight: u32,
}

/// What points show, each on its area: the sum of the areas, 22 fractional bits, and of what they show
/// times them, 52.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    pub(super) area: NonZeroU32,
    pub(super) matt: i64,
    pub(super) highlight: i64,
}

impl Shown {
    /// One more box.
    #[inline(always)]
    fn add(&mut self, Seen { area, matt, highlight }: &Seen) {
        let (mantissa, zeros) = reciprocal_of(*area);
        let over = |sum: i64| {
            // below the area; four areas leave a zero
            let high = ((sum >> 32) as i32) << (zeros & 31);
            high_part(high | (sum as u32 >> (32_u32.wrapping_sub(zeros) & 31)) as i32, mantissa)
        };
        self.boxes += 1;
        self.matt = self.matt.wrapping_add(over(*matt));
        self.highlight = self.highlight.wrapping_add(over(*highlight));
    }
}

/// The upper word of a product of what is not below 0.
#[inline(always)]
fn high_part(a: i32, b: i32) -> u32 {
    high(a, b) as u32
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
        let root = reciprocal_sqrt_of_long((product(p, p) + product(q, q) + (1 << 48)) as u64);
        let area = dot(slope, view.direction).wrapping_neg();
        Self { area, light: dot(slope, view.light), root }
    }

    /// `-n^ . d`.
    #[inline(always)]
    fn eye(&self) -> i32 {
        cosine(self.area, self.root)
    }

    /// `n^ . l`.
    #[inline(always)]
    fn lit(&self) -> i32 {
        cosine(self.light, self.root)
    }
}

/// What is no longer than a normal (22 fractional bits) over its length, 30 fractional bits, of which 28
/// count.
#[inline(always)]
fn cosine(v: i32, (mantissa, half): (i32, u32)) -> i32 {
    // a length of at least 1 and below 2^7: half is 24 to 30
    high(v << (31_u32.wrapping_sub(half) & 31), mantissa) << 2
}

/// The sum of the areas that points have as their second numbers, each below 2^29; none where one is below 0.
#[inline(always)]
fn area<const N: usize>(points: &[Slope; N]) -> Option<NonZeroU32> {
    let (sum, turned) = points
        .iter()
        .fold((0, 0), |(sum, turned): (i32, i32), [_, area]| (sum.wrapping_add(*area), turned | area));
    // what no unit of area shows does not count
    (turned >= 0).then_some(NonZeroU32::MIN | sum as u32)
}

/// The tone of a matt surface.
#[inline(always)]
fn matte(ambient: Unit, matt: Unit) -> Unit {
    ambient.saturating_add(part_of(Unit::ONE.saturating_sub(ambient), matt)).min(Unit::ONE)
}

impl<'a> View<'a> {
    pub(super) fn new(
        direction: [i32; 3],
        light: Vec3<Unit>,
        finish: &'a Finish,
        environment: &'a Environment,
        checkerboard: Option<&'a Checkerboard>,
    ) -> Self {
        let light = [light.x, light.y, light.z].map(Unit::to_bits);
        let straight = match finish {
            Finish::Phong { .. } => {
                direction.iter().zip(light).fold(0_i32, |sum, (a, b)| sum.wrapping_add(unit_product(*a, b)))
            }
            _ => 0,
        };
        Self { direction, light, straight, finish, environment, checkerboard }
    }

    /// What a box shows in diffuse light, to second order; none where a part of it may turn away.
    ///
    /// `c = n^ . l` and `w = -n . d` as functions of the slopes, `S` their covariance, `u` the slopes over
    /// `|n|`: `E(w c) / E(w) = c + w' S c' / w + tr(c'' S) / 2` with `w' = d`, `c' = -(l + c u) / |n|` and
    /// `tr(c'' S) = (2 l S u + 3 c u S u - c tr S) / |n|^2`. The length of `d` does not matter.
    #[inline(always)]
    pub(super) fn glance(&self, ambient: Unit, spread: &Spread) -> Option<Unit> {
        let Spread { mean, covariance: [pp, pq, qq] } = *spread;
        let facing = Facing::new(mean, self);
        let ([dx, dy, _], [lx, ly, _]) = (self.direction, self.light);
        let sum = |[a, b]: [i32; 2], [x, y]: [i32; 2]| rounded_down::<30>(product(a, x) + product(b, y));
        let under = |v: [i32; 2]| [sum([pp, pq], v), sum([pq, qq], v)];
        let (eye, c, root) = (facing.eye(), facing.lit(), facing.root);
        let u = [scaled(mean[0], root), scaled(mean[1], root)];
        let (along, across) = (under([dx, dy]), under(u));
        // 1 / |n|^2
        let short = high(root.0, root.0) >> (root.1.wrapping_mul(2).wrapping_sub(48) & 31);
        // one deviation may not turn away
        if eye <= 0 || product(eye, eye) >> 36 <= product(sum(along, [dx, dy]), short) >> 30 {
            return None;
        }
        let (mantissa, zeros) = reciprocal_of(NonZeroU32::new(eye.unsigned_abs())?);
        let cross = sum(along, [lx, ly]).wrapping_add(unit_product(sum(along, u), c));
        let cross = product(cross, mantissa);
        let cross = ((cross >> 32) as i32) << (zeros & 31)
            | (cross as u32 >> (32_u32.wrapping_sub(zeros) & 31)) as i32;
        let own = sum(across, u);
        let own = unit_product(own.wrapping_mul(3).wrapping_sub(pp).wrapping_sub(qq), c) >> 1;
        let bent = sum(across, [lx, ly]).wrapping_add(own).wrapping_sub(cross);
        let bent = unit_product(bent, short).clamp(-(1 << 24), 1 << 24) << 6;
        let matt = Unit::from_bits(c.wrapping_add(bent).clamp(0, 1 << 30));
        Some(matte(ambient, matt))
    }

    /// What the footprint shows; none where a part of it may turn away from the eye.
    #[inline(always)]
    pub(super) fn tone(&self, ground: &[Ground<'_>; 2], footprint: &mut Footprint) -> Option<Unit> {
        let shown = match (*self.finish, self.checkerboard) {
            (Finish::Mirror, Some(checkerboard)) => self.reflected(checkerboard, ground, footprint)?,
            (Finish::Phong { shininess: shininess @ ..=GENTLE, .. }, _) if footprint.count() > 2 => {
                self.gleaming(shininess, ground, footprint)?
            }
            (Finish::Phong { shininess, .. }, _) => self.shining(shininess, ground, footprint)?,
            _ => self.pointed(ground, footprint)?,
        };
        Some(self.finished(&shown))
    }

    /// What it shows of a checkerboard.
    #[inline(never)]
    fn reflected(
        &self,
        checkerboard: &Checkerboard,
        ground: &[Ground<'_>; 2],
        footprint: &mut Footprint,
    ) -> Option<Shown> {
        let (mut shown, mut slopes) = (Shown::default(), Slopes::default());
        for _ in 0..footprint.count() {
            footprint.next(ground, &mut slopes)?;
            let mirrored = self.mirrored(&Spread::of(&slopes, footprint.spans()))?;
            shown.boxes += 1;
            shown.matt = shown.matt.wrapping_add(checkerboard.over(&mirrored).to_bits() as u32 >> 2);
        }
        Some(shown)
    }

    /// What it shows with a gentle highlight.
    #[inline(never)]
    fn gleaming(&self, shininess: u16, ground: &[Ground<'_>; 2], footprint: &mut Footprint) -> Option<Shown> {
        let (mut shown, mut slopes, exponent) =
            (Shown::default(), Slopes::default(), Exponent::new(shininess));
        let ([columns, rows], mut first) = (footprint.parts(), FAR);
        for _ in 0..columns {
            let mut far = first;
            for _ in 0..rows {
                footprint.next(ground, &mut slopes)?;
                shown.add(&self.phong(exponent, &mut slopes.three(far))?);
                far = far.wrapping_neg();
            }
            first = first.wrapping_neg();
        }
        Some(shown)
    }

    /// What it shows with Phong's highlight.
    #[inline(never)]
    fn shining(&self, shininess: u16, ground: &[Ground<'_>; 2], footprint: &mut Footprint) -> Option<Shown> {
        let (mut shown, mut slopes, exponent) =
            (Shown::default(), Slopes::default(), Exponent::new(shininess));
        for _ in 0..footprint.count() {
            footprint.next(ground, &mut slopes)?;
            shown.add(&self.phong(exponent, &mut slopes.points())?);
        }
        Some(shown)
    }

    /// What it shows of anything by points.
    #[inline(never)]
    fn pointed(&self, ground: &[Ground<'_>; 2], footprint: &mut Footprint) -> Option<Shown> {
        let (mut shown, mut slopes) = (Shown::default(), Slopes::default());
        for _ in 0..footprint.count() {
            footprint.next(ground, &mut slopes)?;
            shown.add(&self.seen(&mut slopes.points())?);
        }
        Some(shown)
    }

    /// What four points show that stand for all of a pixel; none where one turns away from the eye.
    #[inline(always)]
    pub(super) fn shown(&self, points: &mut [Slope; 4]) -> Option<Unit> {
        let mut shown = Shown::default();
        shown.add(&self.seen(points)?);
        Some(self.finished(&shown))
    }

    /// What four points show; none where one turns away from the eye. `points` are of no more use.
    #[inline(never)]
    pub(super) fn seen(&self, points: &mut [Slope; 4]) -> Option<Seen> {
        match *self.finish {
            Finish::Diffuse { .. } => self.plain(points, |_, facing| facing.lit().max(0)),
            Finish::Phong { shininess, .. } => self.phong(Exponent::new(shininess), points),
            Finish::TorranceSparrow { roughness, reflectance, .. } => {
                let model = TorranceSparrow::within(roughness, reflectance);
                let mut highlight = 0;
                let seen = self.plain(points, |slope, facing| {
                    highlight += product(self.sheen(*slope, facing, model).to_bits(), facing.area);
                    facing.lit().max(0)
                })?;
                Some(Seen { highlight, ..seen })
            }
            Finish::Mirror => self.plain(points, |slope, facing| self.reflection(*slope, facing).to_bits()),
        }
    }

    /// Points with Phong's highlight; no exponent is that of 0.
    #[inline(always)]
    fn phong<const N: usize>(&self, exponent: Option<Exponent>, points: &mut [Slope; N]) -> Option<Seen> {
        let matt = self.all(points, |slope, facing| {
            let (eye, lit) = (facing.eye(), facing.lit());
            // m . l is at most 1
            slope[0] = self.straight.wrapping_add(high(eye, lit) << 3);
            lit.max(0)
        });
        let area = area(points)?;
        let Some(exponent) = exponent else {
            return Some(Seen { area, matt, highlight: i64::from(area.get()) << 30 });
        };
        let powers = exponent.powers(points.map(|[base, _]| base));
        let on = |sum: u64, (shown, [_, weight]): (&u32, &Slope)| {
            sum.wrapping_add(product_u(*shown, *weight as u32))
        };
        let highlight = powers.iter().zip(&*points).fold(0, on);
        Some(Seen { area, matt, highlight: (highlight >> 2) as i64 })
    }

    /// Points without one; none where one turns away from the eye.
    #[inline(always)]
    fn plain<const N: usize>(
        &self,
        points: &mut [Slope; N],
        tone: impl FnMut(&mut Slope, &Facing) -> i32,
    ) -> Option<Seen> {
        let matt = self.all(points, tone);
        Some(Seen { area: area(points)?, matt, highlight: 0 })
    }

    /// The sum of what `tone` says of points, each times its area, 52 fractional bits. Leaves the areas as
    /// the points' second numbers.
    #[inline(always)]
    fn all<const N: usize>(
        &self,
        points: &mut [Slope; N],
        mut tone: impl FnMut(&mut Slope, &Facing) -> i32,
    ) -> i64 {
        let mut matt = 0_i64;
        for slope in points {
            let facing = Facing::new(*slope, self);
            matt = matt.wrapping_add(product(tone(slope, &facing), facing.area));
            slope[1] = facing.area;
        }
        matt
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
        let facing = Facing::new([p, q], self);
        let (eye, root) = (facing.eye(), facing.root);
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
        let twice = facing.eye() << 1;
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
        const PART: [u32; 13] = {
            let (mut part, mut n) = ([0; 13], 1);
            while n < 13 {
                part[n] = (1 << 30) / n as u32;
                n += 1;
            }
            part
        };
        let part = PART.get(shown.boxes as usize).copied().unwrap_or(0);
        let mean = |sum: u32| Unit::from_bits((product_u(sum, part) >> 28).min(1 << 30) as i32);
        let (matt, highlight) = (mean(shown.matt), mean(shown.highlight));
        match *self.finish {
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
