//! What a pixel covers of a height field: a parallelogram above the plane through the surface's mean, cut into
//! boxes.
//!
//! A ray `eye + t d` that moves by `r` on the image plane moves along the plane with slopes `(p, q)` by
//! `t (r - d (n . r) / (n . d))`, `n = (-p, -q, 1)`: the pixel's edges `a` and `b`. A part of the parallelogram
//! has the variances `(a_x^2 + b_x^2) / 12` and `(a_y^2 + b_y^2) / 12`; its box is the one with these. The
//! plane is the mean one over the box of the whole pixel, put where the ray through the pixel's centre meets
//! it. Formats: lengths 24 fractional bits, directions 28.

use core::num::NonZeroU32;

use super::slopes::{Slope, Slopes};
use crate::fif::Moments;
use crate::num::{product, reciprocal, reciprocal_of, rough_sqrt};

/// Into how many boxes a pixel's footprint is cut, and so how much a pixel costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Quality {
    /// Two boxes, diffuse light to second order.
    Coarse,
    /// Six boxes.
    Fine,
    /// Ten boxes.
    Finest,
}

impl Quality {
    /// Parts of the longer and of the shorter edge.
    #[inline(always)]
    const fn parts(self) -> [i32; 2] {
        match self {
            Self::Coarse => [2, 1],
            Self::Fine => [3, 2],
            Self::Finest => [5, 2],
        }
    }
}

/// One axis of the ground: the moments above it and where it lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ground<'a> {
    moments: Moments<'a>,
    origin: i32,
    width: i32,
    /// `2^31 / width` as a mantissa and a shift.
    per_width: (u32, u32),
}

impl<'a> Ground<'a> {
    /// The axis of a profile that begins at `origin` and is `width` long.
    pub(super) fn new(moments: Moments<'a>, origin: i32, width: i32) -> Self {
        let (mantissa, shift) = reciprocal(width.unsigned_abs());
        Self { moments, origin, width, per_width: (mantissa, shift - 31) }
    }

    /// A length as a part of the whole, 31 fractional bits.
    #[inline(always)]
    fn part(&self, length: i32) -> i64 {
        let (mantissa, shift) = self.per_width;
        // a mantissa of 2^31 is that of a power of two
        (i64::from(length) * i64::from(mantissa)) >> (shift & 63)
    }

    /// From the middle so far to both sides; none where more than half of a side leaves the domain.
    #[inline(always)]
    fn around<const ALL: bool>(&self, middle: i32, half: i32) -> Option<crate::fif::Stretch> {
        let (from, to) = (middle.saturating_sub(half), middle.saturating_add(half));
        let (from, to) = (from.checked_sub(self.origin)?, to.checked_sub(self.origin)?);
        if from < -(half >> 1) || to.saturating_sub(self.width) > half >> 1 {
            return None;
        }
        let end = |x: i32| self.part(x.max(0).min(self.width)).clamp(0, 1 << 31) as u32;
        self.moments.covered::<ALL>(end(from), end(to))
    }
}

/// A plane above the ground that a ray meets: where, and its slopes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub(super) t: i32,
    pub(super) at: [i32; 2],
    pub(super) slope: Slope,
}

/// A ray from the eye.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sight {
    pub(super) eye: [i32; 3],
    pub(super) direction: [i32; 3],
}

/// `-n . v` in the format of `v`: how much `v` goes into the surface.
#[inline(always)]
pub(super) fn into([p, q]: Slope, [x, y, z]: [i32; 3]) -> i64 {
    ((product(p, x) + product(q, y)) >> 24) - i64::from(z)
}

/// The reciprocal of how much a ray goes into a plane, which is seen at no flatter an angle than some 4
/// degrees.
#[inline(always)]
fn steepness(slope: Slope, direction: [i32; 3]) -> (i32, u32) {
    let [p, q] = slope.map(|s| i64::from(s.unsigned_abs()));
    let least = (p + q + (1 << 24)) >> 1; // a 32nd of 28 bits
    let steep = into(slope, direction).max(least).min(i64::from(i32::MAX));
    reciprocal_of(NonZeroU32::new(steep as u32).unwrap_or(NonZeroU32::MIN))
}

/// `v / g` for a reciprocal of `g`, in a format with `bits` more than `v` over `g` has, saturated.
#[inline(always)]
fn over(v: i64, (mantissa, zeros): (i32, u32), bits: u32) -> i32 {
    let v = v.clamp(-(1 << 31), (1 << 31) - 1) as i32;
    let shift = 62_u32.saturating_sub(zeros + bits);
    (product(v, mantissa) >> (shift & 63)).clamp(-(1 << 30), 1 << 30) as i32
}

impl Sight {
    /// The place at a parameter.
    #[inline(always)]
    pub(super) fn at(&self, t: i32) -> [i32; 3] {
        [0, 1, 2].map(|i| {
            let [o, d] = [self.eye, self.direction].map(|v| v.get(i).copied().unwrap_or(0));
            o.wrapping_add((product(d, t) >> 28) as i32)
        })
    }

    /// Where the ray meets the plane with slopes `slope` through `height` above `at`, no further than `reach`
    /// from `t`.
    #[inline(always)]
    pub(super) fn meet(&self, t: i32, slope: Slope, above: i32, reach: i32) -> Place {
        let off = over(i64::from(above), steepness(slope, self.direction), 28);
        let t = t.wrapping_add(off.max(reach.wrapping_neg()).min(reach));
        let [x, y, _] = self.at(t);
        Place { t, at: [x, y], slope }
    }
}

/// The pixel's edges on the ground and how they are cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct Footprint {
    place: Place,
    /// Steps along both edges, and half of a box.
    steps: [[i32; 2]; 2],
    parts: [i32; 2],
    half: [i32; 2],
}

impl Footprint {
    /// Of the pixel with these edges on the image plane.
    #[inline(always)]
    pub(super) fn new(place: Place, sight: &Sight, edges: [[i32; 3]; 2], parts: [i32; 2]) -> Self {
        let steep = steepness(place.slope, sight.direction);
        let [dx, dy, _] = sight.direction;
        let [a, b] = edges.map(|r| {
            let along = over(into(place.slope, r), steep, 28);
            [(r[0], dx), (r[1], dy)].map(|(r, d)| {
                // n . r / n . d is along
                let moved = i64::from(r) - (product(d, along) >> 28);
                ((moved * i64::from(place.t)) >> 28).clamp(-(1 << 29), 1 << 29) as i32
            })
        });
        let length = |[x, y]: [i32; 2]| product(x, x) + product(y, y);
        let parts = if length(a) < length(b) { [parts[1], parts[0]] } else { parts };
        let steps = [cut(a, parts[0]), cut(b, parts[1])];
        let half = [0, 1].map(|i| {
            let [s, t] = steps.map(|s| s.get(i).copied().unwrap_or(0));
            (rough_sqrt((product(s, s) + product(t, t)) as u64) >> 1) as i32
        });
        Self { place, steps, parts, half }
    }

    /// The middles of the boxes.
    #[inline(always)]
    pub(super) fn each(&self, mut then: impl FnMut([i32; 2])) {
        let [a, b] = self.steps;
        let [n, m] = self.parts;
        let first = |i: usize| {
            let [a, b, at] = [a, b, self.place.at].map(|v| v.get(i).copied().unwrap_or(0));
            at.wrapping_sub((a.wrapping_mul(n - 1).wrapping_add(b.wrapping_mul(m - 1))) >> 1)
        };
        let mut row = [first(0), first(1)];
        for _ in 0..n {
            let mut at = row;
            for _ in 0..m {
                then(at);
                at = [at[0].wrapping_add(b[0]), at[1].wrapping_add(b[1])];
            }
            row = [row[0].wrapping_add(a[0]), row[1].wrapping_add(a[1])];
        }
    }

    /// The surface over a box; its means alone unless `ALL`.
    #[inline(always)]
    pub(super) fn slopes<const ALL: bool>(&self, ground: &[Ground<'_>; 2], at: [i32; 2]) -> Option<Slopes> {
        let [x, y] = ground;
        Some(Slopes { x: x.around::<ALL>(at[0], self.half[0])?, y: y.around::<ALL>(at[1], self.half[1])? })
    }
}

/// One of `n` parts, `n` up to 6.
#[inline(always)]
fn cut(v: [i32; 2], n: i32) -> [i32; 2] {
    /// `2^16 / n`.
    const PART: [i32; 7] = [0, 1 << 16, 1 << 15, 21845, 1 << 14, 13107, 10923];
    let part = PART.get(n as usize).copied().unwrap_or(0);
    v.map(|v| (product(v, part) >> 16) as i32)
}

impl Quality {
    /// The footprint of a pixel from where its ray meets the surface: none where no plane fits.
    #[inline(always)]
    pub(super) fn footprint(
        self,
        ground: &[Ground<'_>; 2],
        sight: &Sight,
        edges: [[i32; 3]; 2],
        first: Place,
        reach: i32,
    ) -> Option<Footprint> {
        let whole = Footprint::new(first, sight, edges, [1, 1]);
        let slopes = whole.slopes::<false>(ground, first.at)?;
        let [_, _, z] = sight.at(first.t);
        let place = sight.meet(first.t, slopes.mean(), z.wrapping_sub(slopes.height()), reach);
        Some(Footprint::new(place, sight, edges, self.parts()))
    }
}
