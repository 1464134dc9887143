//! The filtered picture of a height field, row by row.
//!
//! A pixel's ray is cast through the middle of its lower edge: of a height field whatever stands before
//! something else comes from below, so that this ray meets first what hides a part of the pixel. Where the
//! surface stays turned to the eye all over the pixel, its normals are integrated; a pixel whose surface may
//! turn away, or that only its upper edge meets, takes the samples of the ray caster instead.

use core::ops::Range;

use embedded_graphics_core::geometry::Size;

use super::answer::View;
use super::footprint::{Place, Quality, Sight, into, whole};
use super::ground::Ground;
use super::slopes::Spread;
use crate::Error;
use crate::fif::Sums;
use crate::num::{Unit, unit};
use crate::plane::{Field, Tone, along};
use crate::trace::finish::Finish;
use crate::trace::height_field::halves::Pencil;
use crate::trace::height_field::statistics::Uncounted;
use crate::trace::ray_caster::{RayCaster, narrow, rounded};

/// Half a pixel, 24 fractional bits.
const HALF: i32 = 1 << 23;

/// A height field seen by a camera, the normals of each pixel integrated: a [`Field`] of [`Tone`]s.
#[derive(Debug, Clone)]
pub struct FilteredCaster<'a> {
    caster: RayCaster<'a>,
    ground: [Ground<'a>; 2],
    quality: Quality,
    /// The rays from the eye, as wide as a pixel.
    pixels: Pencil,
    /// From a pixel to the next, on the image plane: to the right and downwards, 28 fractional bits.
    edges: [[i32; 3]; 2],
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
        let pixels = caster.surface.pencil(caster.rays.origin, caster.footprint);
        let edges = [caster.right, caster.down].map(|edge| edge.map(narrow));
        Ok(Self { caster, ground, quality, pixels, edges })
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
        self.tone(x, y).1
    }

    #[inline(never)]
    fn tone(&self, x: u32, y: u32) -> (Unit, Found) {
        let centre = self.caster.direction(x, y);
        let direction = centre.map(narrow);
        let below = self.caster.offset(centre, 0, HALF);
        let sampled = || (self.caster.samples(x, y), Found::Sampled);
        let Some(hit) = self.caster.surface.first_hit(&self.pixels, &below, &mut Uncounted) else {
            let above = self.caster.offset(centre, 0, -HALF);
            return match self.caster.surface.leaf(&self.pixels, &above, &mut Uncounted) {
                None => (self.caster.surroundings(x, y), Found::Beyond),
                Some(_) => sampled(),
            };
        };
        let [p, q, _] = [hit.normal().x, hit.normal().y, hit.normal().z].map(|c| c.to_bits().wrapping_neg());
        let (slope, t) = ([p, q], hit.t.to_bits());
        if into(slope, below) <= 0 {
            return sampled();
        }
        let (sight, lower) = (
            Sight { eye: self.pixels.origin, direction },
            Sight { eye: self.pixels.origin, direction: below },
        );
        let [[x0, y0, z0], [x1, y1, z1]] = [lower.at(t), sight.at(t)];
        let rise = into(slope, [x1.wrapping_sub(x0), y1.wrapping_sub(y0), 0]) as i32;
        let above = z1.wrapping_sub(z0).wrapping_sub(rise);
        let reach = self.caster.footprint.width(t).saturating_mul(8);
        let first: Place = sight.meet(t, slope, above, reach);
        match self.filtered(&sight, first, reach) {
            Some(tone) => (tone, Found::Filtered),
            None => sampled(),
        }
    }

    /// None where a part of the pixel may turn away from the eye.
    #[inline(always)]
    fn filtered(&self, sight: &Sight, first: Place, reach: i32) -> Option<Unit> {
        let RayCaster { material, light, environment, .. } = &self.caster;
        let view = || View::new(unit(sight.direction), light.towards, *material, environment);
        if let (Quality::Coarse, Finish::Diffuse { ambient }) = (self.quality, *material) {
            let (slopes, half) = whole(&self.ground, sight, self.edges, first, reach)?;
            return view().glance(ambient, &Spread::of(&slopes, half));
        }
        let care = (reach, matches!(material, Finish::Diffuse { .. }));
        let footprint = self.quality.footprint(&self.ground, sight, self.edges, first, care)?;
        view().tone(&self.ground, &footprint)
    }

    #[inline(always)]
    fn pixel(&self, x: u32, y: u32, visible: bool) -> Tone {
        let tone = if visible { self.tone(x, y).0 } else { self.caster.surroundings(x, y) };
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
        self.pixel(x, y, visible)
    }

    fn row(&self, y: u32, x: Range<u32>) -> impl ExactSizeIterator<Item = Tone> {
        // what lies outside the picture has no pixels
        let (y, width) = (y.min(self.caster.size.height.saturating_sub(1)), self.caster.size.width);
        let x = x.start.min(width)..x.end.min(width);
        let visible = self.caster.outline.columns(y, width);
        along(x, move |x| self.pixel(x, y, visible.contains(&x)))
    }
}
