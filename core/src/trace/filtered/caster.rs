//! The filtered picture of a height field, row by row.
//!
//! A pixel's ray is cast through the middle of its lower edge: of a height field whatever stands before
//! something else comes from below, so that this ray meets first what hides a part of the pixel. Where the
//! surface stays turned to the eye all over the pixel, its normals are integrated; a pixel whose surface may
//! turn away, or that only its upper edge meets, takes the samples of the ray caster instead. But a ridge may
//! only graze the lower edge: a second, narrower ray a quarter of a pixel above tells what lies behind it.

use core::num::NonZeroU32;
use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use super::answer::View;
use super::footprint::{Place, Quality, Sight, into, settled, whole};
use super::ground::Ground;
use super::outline;
use super::slopes::Spread;
use crate::Error;
use crate::fif::Sums;
use crate::num::{Unit, Vec3, reciprocal_sqrt_of, scaled, square, unit};
use crate::plane::{Field, Tone, along};
use crate::trace::environment::{Around, Checkerboard};
use crate::trace::finish::Finish;
use crate::trace::height_field::halves::Pencil;
use crate::trace::height_field::statistics::Uncounted;
use crate::trace::ray_caster::{RayCaster, narrow, rounded};

/// A height field seen by a camera, the normals of each pixel integrated: a [`Field`] of [`Tone`]s.
#[derive(Debug, Clone)]
pub struct FilteredCaster<'a> {
    caster: RayCaster<'a>,
    ground: [Ground<'a>; 2],
    quality: Quality,
    /// The rays from the eye, as wide as a pixel; half as wide where an outline is looked for, so that a leaf
    /// lies near the place that is met.
    pixels: Pencil,
    /// From a pixel to the next, on the image plane: to the right and downwards, 28 fractional bits.
    edges: [[i32; 3]; 2],
    /// Where that is what surrounds the surface.
    checkerboard: Option<Checkerboard>,
}

/// How a pixel was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub enum Found {
    /// No ray meets the surface.
    Beyond,
    /// By the moments of the surface.
    Filtered,
    /// By the samples of the ray caster: an edge.
    Sampled,
}

/// Whether two places along a ray are no more than four pixels apart.
#[inline(always)]
fn are_near(a: i32, b: i32, reach: i32) -> bool {
    a.wrapping_sub(b).unsigned_abs() <= reach.unsigned_abs() >> 1
}

#[inline(always)]
fn sum([x, y, z]: &[i32; 3], [a, b, c]: [i32; 3]) -> [i32; 3] {
    [x.wrapping_add(a), y.wrapping_add(b), z.wrapping_add(c)]
}

impl<'a> FilteredCaster<'a> {
    /// The picture of `caster` with its normals integrated by the running sums along x and y; the samples of
    /// `caster` are those of pixels at edges. Sums of cells a quarter as wide as a pixel do.
    ///
    /// # Errors
    /// [`Error::Unsupported`] for sums of other functions than those of the surface's pyramids.
    pub fn new(caster: RayCaster<'a>, x: &Sums<'a>, y: &Sums<'a>, quality: Quality) -> Result<Self, Error> {
        let hierarchy = &caster.surface.hierarchy;
        if !x.is_of(hierarchy.x.starts) || !y.is_of(hierarchy.y.starts) {
            let allowed = "those of the functions of the surface's own pyramids";
            return Err(Error::Unsupported { what: "running sums", allowed });
        }
        let ground = [(x, &hierarchy.x), (y, &hierarchy.y)].map(|(s, p)| Ground::new(*s, p.origin, p.width));
        let outlined = quality != Quality::Coarse && matches!(caster.material, Finish::Diffuse { .. });
        let pixels = caster.footprint.part(if outlined { 2 } else { 1 });
        let pixels = caster.surface.pencil(caster.rays.origin, pixels);
        let edges = [caster.right, caster.down].map(|edge| edge.map(narrow));
        let checkerboard = Checkerboard::new(&caster.environment);
        Ok(Self { caster, ground, quality, pixels, edges, checkerboard })
    }

    /// The picture with one plain sample after another: the ray caster.
    pub const fn caster(&self) -> &RayCaster<'a> {
        &self.caster
    }

    /// How a pixel was found; beyond the picture there is none to find.
    pub fn found(&self, x: u32, y: u32) -> Found {
        if x >= self.caster.size.width || y >= self.caster.size.height {
            return Found::Beyond;
        }
        self.tone(x, y, self.caster.direction(x, y).map(narrow)).1
    }

    #[inline(always)]
    fn tone(&self, x: u32, y: u32, direction: [i32; 3]) -> (Unit, Found) {
        match self.through(&direction, None) {
            Ok(tone) => (tone, Found::Filtered),
            Err(met) => self.edge(x, y, &direction, met),
        }
    }

    /// A pixel that is not filtered by the ray through its lower edge, which meets the surface so far off or
    /// not at all.
    #[cold]
    #[inline(never)]
    fn edge(&self, x: u32, y: u32, direction: &[i32; 3], met: Option<NonZeroU32>) -> (Unit, Found) {
        if met.is_none() {
            let [_, down] = self.edges;
            let above = sum(direction, down.map(|c| -(c >> 1)));
            if self.caster.surface.leaf(&self.pixels, &above, &mut Uncounted).is_none() {
                return (self.surroundings(x, y, *direction), Found::Beyond);
            }
        } else if let Ok(tone) = self.through(direction, met) {
            // a ridge before something else grazes the pixel's lower edge at most
            return (tone, Found::Filtered);
        }
        (self.caster.samples(x, y), Found::Sampled)
    }

    /// What the pixel around a ray shows, found by the ray through its lower edge, or by a narrower one a
    /// quarter of a pixel above it that does not meet what the first has met; otherwise how far off that ray
    /// meets the surface.
    #[inline(never)]
    fn through(&self, direction: &[i32; 3], met: Option<NonZeroU32>) -> Result<Unit, Option<NonZeroU32>> {
        let [_, down] = self.edges;
        let surface = &self.caster.surface;
        let (below, narrow);
        let (pencil, lower) = match met {
            None => {
                below = down.map(|c| c >> 1);
                (&self.pixels, sum(direction, below))
            }
            Some(_) => {
                below = down.map(|c| c >> 2);
                narrow = surface.pencil(self.pixels.origin, self.caster.footprint.part(4));
                (&narrow, sum(direction, below))
            }
        };
        let leaf = surface.leaf(pencil, &lower, &mut Uncounted).ok_or(None)?;
        let (t_in, t_out) = leaf.span;
        let t = t_in + ((t_out - t_in) >> 1);
        let reach = self.caster.footprint.width(t).saturating_mul(8);
        let far = NonZeroU32::new(t.unsigned_abs());
        if met.is_some_and(|met| are_near(met.get() as i32, t, reach)) {
            return Err(far);
        }
        // 24 fractional bits against 28: a leaf that is seen at less than a quarter of it tells little of the
        // plane, for which a level one does
        let [p, q, _] = surface.normal(&leaf).map(i32::wrapping_neg);
        let size = i64::from(p.unsigned_abs()) + i64::from(q.unsigned_abs()) + (1 << 24);
        let slope = if into([p, q], lower) > size << 2 { [p, q] } else { [0; 2] };
        let sight = Sight { eye: self.pixels.origin, direction: *direction };
        // above the plane through the point of the ray below
        let above = ((into(slope, below) * i64::from(t)) >> 28) as i32;
        self.filtered(&sight, (t, sight.meet(t, slope, above, reach)), reach).ok_or(far)
    }

    /// None where a part of the pixel may turn away from the eye.
    #[inline(always)]
    fn filtered(&self, sight: &Sight, (t, first): (i32, Place), reach: i32) -> Option<Unit> {
        let material = &self.caster.material;
        let place = settled(&self.ground, sight, first, reach)?;
        // a ridge, and something else behind it
        if !are_near(t, place.t, reach) {
            return None;
        }
        if let (Quality::Coarse, Finish::Diffuse { ambient }) = (self.quality, *material) {
            let (slopes, spans) = whole(&self.ground, sight, self.edges, &place)?;
            return self.view(sight.direction).glance(ambient, &Spread::of(&slopes, spans));
        }
        if let Finish::Diffuse { .. } = material {
            let size = (reach, self.quality.columns());
            return self
                .view(sight.direction)
                .shown(&mut outline::spread(&self.ground, sight, self.edges, place, size)?.points());
        }
        let few = matches!(material, Finish::Mirror) && self.checkerboard.is_some();
        self.view_of_length_1(sight).tone(
            &self.ground,
            &mut self.quality.footprint(&self.ground, sight, self.edges, &place, (reach, few)),
        )
    }

    /// The light that a pixel is seen in.
    #[inline(always)]
    fn view(&self, direction: [i32; 3]) -> View<'_> {
        let RayCaster { material, light, environment, .. } = &self.caster;
        View::new(direction, light.towards, material, environment, self.checkerboard.as_ref())
    }

    /// The same for what shines, which asks for a direction of length 1.
    #[inline(never)]
    fn view_of_length_1(&self, sight: &Sight) -> View<'_> {
        let Vec3 { x, y, z } = unit(sight.direction);
        self.view([x, y, z].map(Unit::to_bits))
    }

    /// What surrounds the surface, through a pixel that shows nothing else.
    #[inline(never)]
    fn surroundings(&self, x: u32, y: u32, direction: [i32; 3]) -> Unit {
        let Some(checkerboard) = &self.checkerboard else { return self.caster.surroundings(x, y) };
        let root = reciprocal_sqrt_of(square(direction));
        let over = |[x, y, z]: [i32; 3]| [scaled(x, root), scaled(y, root), scaled(z, root)];
        // 32 times as long with a 1024th of the variance, a twelfth: small edges keep their bits
        let [right, down] = self.edges.map(|edge| over(edge.map(|c| c.saturating_mul(32))));
        let covariance = [(1 << 14) / 12, 0, (1 << 14) / 12];
        checkerboard.over(&Around { e: over(direction), changes: [right, down], covariance })
    }

    #[inline(always)]
    fn pixel(&self, x: u32, y: u32, direction: [i32; 3], visible: bool) -> Tone {
        let tone = if visible { self.tone(x, y, direction).0 } else { self.surroundings(x, y, direction) };
        rounded(tone.to_bits() as u32)
    }
}

impl Field for FilteredCaster<'_> {
    type Value = Tone;

    fn size(&self) -> Size {
        self.caster.size
    }

    fn at(&self, x: u32, y: u32) -> Tone {
        let visible = self.caster.outline.columns(y, self.caster.size.width).contains(&x);
        self.pixel(x, y, self.caster.direction(x, y).map(narrow), visible)
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Tone> {
        // what lies outside the picture has no pixels
        let (y, width) = (y.min(self.caster.size.height.saturating_sub(1)), self.caster.size.width);
        let x = x.start.min(width)..x.end.min(width);
        let visible = self.caster.outline.columns(y, width);
        let directions = self.caster.directions(x, y);
        along(directions, move |(x, direction)| self.pixel(x, y, direction, visible.contains(&x)))
    }
}
