//! The filtered picture of a lattice, row by row: a height field that is not a product.
//!
//! As the picture of a product ([`super::caster`]), but for where moments come from: every cell of a lattice
//! knows the mean and the covariance of its slopes ([`SlopeMoments`]). The pixel shows the cells of some
//! level that lie in it, each by four points with its mean and covariance, in proportion to the area on which
//! the pixel sees them: cells are looked for from the sheet's own down, and left out with all their parts
//! where their bounds do not meet the pixel's pyramid.
//!
//! A place `D` off where the pixel's ray meets the mean plane is `e = D_z - p D_x - q D_y` above it, and `t =
//! e / (-n . d)` before it along the ray; `D + t d` on the plane is `u a + v b` for the pixel's edges there.
//! So `u`, `v` and `t` are linear in `D`: exact for all that lies near the plane, however steep its own
//! slopes are. A cell counts as much as it overlaps `|u| <= 1/2` and `|v| <= 1/2`, by its own width along
//! both. Where the areas of all do not add up to the pixel's, to a quarter, something turns away or hides
//! something: an edge, which takes samples. Formats: `u` and `v` 12 fractional bits, coefficients alike.

use embedded_graphics_core::geometry::Size;

use super::answer::{Seen, Shown, View};
use super::caster::Found;
use super::footprint::{Place, Quality, Sight, edges, into, over};
use super::slopes::{Slope, Spread};
use crate::num::formats::{Q24, Q28};
use crate::num::{Real, Unit, product, rough_sqrt, unit};
use crate::patch::{Mask, Scheme, SlopeMoments};
use crate::plane::{Field, Tone};
use crate::trace::patch_caster::PatchCaster;
use crate::trace::ray_caster::rounded;

/// Half a pixel, 24 fractional bits.
const HALF: i32 = 1 << 23;

/// The deepest level of cells that are looked up, and how many are for one pixel.
const DEEPEST: u32 = 12;
const MOST_NODES: u32 = 1 << 12;

/// A lattice seen by a camera, the normals of each pixel integrated: a [`Field`] of [`Tone`]s.
#[derive(Debug, Clone)]
pub struct FilteredPatch<'a> {
    caster: PatchCaster<'a, Mask, 16>,
    moments: &'a SlopeMoments,
    quality: Quality,
    /// From a pixel to the next.
    pixel: [[Q28; 3]; 2],
}

/// What a pixel sees near the plane that its ray meets.
struct Pixel {
    /// Where.
    at: [Q24; 3],
    /// Coefficients of `u` and `v`, 12 fractional bits, and of `t`, 22.
    across: [[i32; 3]; 2],
    along: [i32; 3],
    /// How far before the plane, or behind it, what is seen can be.
    reach: i32,
    /// The pixel's area on the plane times `-n . d` of a unit `d`, 40 fractional bits.
    area: i64,
}

/// A half, 12 fractional bits.
const HALF_PIXEL: i64 = 1 << 11;

/// `v / det` of 24 and 48 fractional bits, with 12.
fn coefficient(v: i32, det: i64) -> i32 {
    // of 31 bits
    let shift = (u64::BITS - det.unsigned_abs().leading_zeros()).saturating_sub(31);
    let quotient = (i64::from(v) << 31).checked_div(det >> shift).unwrap_or(0);
    let scaled = if shift >= 5 { quotient >> (shift - 5) } else { quotient << (5 - shift) };
    scaled.clamp(-(1 << 30), 1 << 30) as i32
}

impl Pixel {
    /// None where the plane is seen edge on.
    fn new(place: &Place, z: Q24, sight: &Sight, pixel: [[Q28; 3]; 2], reach: i32) -> Option<Self> {
        let [a, b] = edges(place, sight, pixel);
        let det = product(a[0], b[1]) - product(a[1], b[0]);
        if det == 0 {
            return None;
        }
        let ([dx, dy, _], [p, q]) = (sight.direction, place.slope);
        // 22 fractional bits
        let moved = [dx, dy].map(|d| over(d, place.steep) >> 6);
        let linear = |x: i32, y: i32| {
            let z = ((product(moved[0], x) + product(moved[1], y)) >> 22).clamp(-(1 << 30), 1 << 30) as i32;
            let less = |c: i32, slope: i32| {
                (i64::from(c) - (product(slope, z) >> 24)).clamp(-(1 << 30), 1 << 30) as i32
            };
            [less(x, p), less(y, q), z]
        };
        let of = |v: i32| coefficient(v, det);
        let across = [linear(of(b[1]), of(b[0].wrapping_neg())), linear(of(a[1].wrapping_neg()), of(a[0]))];
        // 1 / (-n . d), 22 fractional bits
        let t = over(1 << 28, place.steep) >> 6;
        let along = [p, q].map(|slope| (product(slope, t) >> 24).clamp(-(1 << 30), 1 << 30) as i32);
        let along = [along[0].wrapping_neg(), along[1].wrapping_neg(), t];
        let d = unit(sight.direction);
        let steep = into(place.slope, [d.x, d.y, d.z].map(Unit::to_bits)) >> 6;
        let area = ((det.saturating_abs() >> 8).min(1 << 35) * steep.clamp(1, 1 << 27)) >> 24;
        Some(Self { at: [place.at[0], place.at[1], z], across, along, reach, area })
    }

    /// A linear function off the place, and how much it changes within half a cell.
    fn linear(of: &[i32; 3], off: [i32; 3], half: [i32; 3]) -> [i64; 2] {
        let sum = |v: [i32; 3], with: fn(i32) -> i32| {
            of.iter().zip(v).fold(0_i64, |sum, (c, v)| sum.saturating_add(product(with(*c), v))) >> 24
        };
        [sum(off, |c| c), sum(half, i32::wrapping_abs)]
    }

    fn off(&self, middle: [Q24; 3]) -> [i32; 3] {
        let [[x, y, z], [px, py, pz]] = [middle, self.at];
        [x.saturating_sub(px), y.saturating_sub(py), z.saturating_sub(pz)]
    }

    /// Whether a box may be seen in it.
    fn meets(&self, middle: [Q24; 3], half: [i32; 3]) -> bool {
        let off = self.off(middle);
        let near = |of: &[i32; 3], most: i64| {
            let [middle, width] = Self::linear(of, off, half);
            middle.saturating_abs().saturating_sub(width) <= most
        };
        self.across.iter().all(|of| near(of, HALF_PIXEL)) && near(&self.along, i64::from(self.reach >> 2))
    }

    /// How much of a cell that is `2 half` wide lies in it, 12 fractional bits.
    fn share(&self, middle: [Q24; 3], half: i32) -> u32 {
        let off = self.off(middle);
        if Self::linear(&self.along, off, [0; 3])[0].saturating_abs() > i64::from(self.reach >> 2) {
            return 0;
        }
        let part = |of: &[i32; 3]| {
            let [middle, width] = Self::linear(of, off, [half, half, 0]);
            // what both have in common: no more than either
            let inside = (HALF_PIXEL + width - middle.saturating_abs()).min(2 * HALF_PIXEL);
            let inside = inside.max(0).min(2 * width.max(1));
            ((inside << 12).checked_div(2 * width.max(1)).unwrap_or(0)) as u32
        };
        let [u, v] = self.across.each_ref().map(part);
        (u * v) >> 12
    }
}

/// What all cells in a pixel show, each on its area: what it is, and how much.
#[derive(Default)]
struct Sum {
    area: u64,
    matt: i64,
    highlight: i64,
}

/// A node on the way down: control heights, place, and the part that comes next.
#[derive(Clone, Copy)]
struct Node {
    heights: [Q24; 16],
    place: [u32; 2],
    next: u32,
}

impl<'a> FilteredPatch<'a> {
    /// The picture of `caster` with its normals integrated by the moments of its mask; the samples of
    /// `caster` are those of pixels at edges.
    pub fn new(caster: PatchCaster<'a, Mask, 16>, moments: &'a SlopeMoments, quality: Quality) -> Self {
        let pixel = caster.screen.edges();
        Self { caster, moments, quality, pixel }
    }

    /// The picture with one plain sample after another.
    pub const fn caster(&self) -> &PatchCaster<'a, Mask, 16> {
        &self.caster
    }

    /// How a pixel was found; beyond the picture there is none to find.
    pub fn found(&self, x: u32, y: u32) -> Found {
        let Size { width, height } = self.caster.size();
        if x >= width || y >= height { Found::Beyond } else { self.tone(x, y).1 }
    }

    #[inline(never)]
    fn tone(&self, x: u32, y: u32) -> (Unit, Found) {
        let screen = &self.caster.screen;
        let centre = screen.direction(x, y);
        let [direction, below, above] = [0, HALF, -HALF].map(|dy| screen.offset(centre, 0, dy));
        let sampled = || (self.caster.samples(x, y), Found::Sampled);
        let Some(hit) = self.caster.first_hit(below, screen.footprint) else {
            return match self.caster.first_hit(above, screen.footprint) {
                None => (self.caster.surroundings(x, y), Found::Beyond),
                Some(_) => sampled(),
            };
        };
        let parts = self.caster.surface.parts(hit.level);
        let slope = self.moments.over(&hit.heights.map(Real::from_bits), parts).mean.map(Real::to_bits);
        if into(slope, below) <= 0 {
            return sampled();
        }
        let eye = self.caster.eye();
        let (sight, lower) = (Sight { eye, direction }, Sight { eye, direction: below });
        let [[x0, y0, z0], [x1, y1, z1]] = [lower.at(hit.t), sight.at(hit.t)];
        let rise = into(slope, [x1.wrapping_sub(x0), y1.wrapping_sub(y0), 0]) as i32;
        let above = z1.wrapping_sub(z0).wrapping_sub(rise);
        // eight pixels
        let reach = (product(screen.footprint.to_bits(), hit.t) >> 27).min(1 << 30) as i32;
        match self.filtered(&sight, sight.meet(hit.t, slope, above, reach), reach) {
            Some(tone) => (tone, Found::Filtered),
            None => sampled(),
        }
    }

    /// None where a part of the pixel may turn away from the eye, or is not above the square.
    fn filtered(&self, sight: &Sight, first: Place, reach: i32) -> Option<Unit> {
        let PatchCaster { material, light, environment, .. } = &self.caster;
        let d = unit(sight.direction);
        let view = View::new([d.x, d.y, d.z].map(Unit::to_bits), light.towards, material, environment, None);
        // the mean plane of the cell as large as the footprint on that of the leaf
        let wide = width(edges(&first, sight, self.pixel), 1);
        let (slope, above) = self.plane(first.at, self.level(wide))?;
        let [_, _, z] = sight.at(first.t);
        let place = sight.meet(first.t, slope, z.saturating_sub(above), reach);
        let [_, _, z] = sight.at(place.t);
        let wide = width(edges(&place, sight, self.pixel), self.quality.cells());
        let pixel = Pixel::new(&place, z, sight, self.pixel, reach)?;
        let sum = self.sum(&pixel, &view, self.level(wide))?;
        // the areas of cells against the pixel's: 4 points with 20 fractional bits, shares of 12, cells of
        // parts
        let parts = i64::from(self.caster.surface.parts(self.level(wide)));
        let seen = ((sum.area >> 14) as i64).checked_div(parts)?;
        let whole = pixel.area.saturating_mul(parts) >> 20;
        if seen.abs_diff(whole) > whole.unsigned_abs() >> 2 {
            return None;
        }
        let mean = |of: i64| {
            let mean = of.min(1 << 56).wrapping_shl(4).checked_div((sum.area >> 14) as i64)?;
            Some(mean.clamp(0, 1 << 28) as u32)
        };
        let shown = Shown { boxes: 1, matt: mean(sum.matt)?, highlight: mean(sum.highlight)? };
        Some(view.finished(&shown))
    }

    /// The level of cells so wide, 1.4 times at most.
    fn level(&self, wide: i32) -> u32 {
        let small = i64::from(wide) + i64::from(wide >> 2) + i64::from(wide >> 3);
        let mut level = 0;
        while level < DEEPEST && i64::from(self.caster.surface.parts(level)).saturating_mul(small) < 1 << 24 {
            level += 1;
        }
        level
    }

    /// The middle of a cell.
    fn middle(index: [u32; 2], parts: u32) -> [Q24; 2] {
        index.map(|i| ((u64::from(i) << 1 | 1) << 23).checked_div(parts.into()).unwrap_or(0) as i32)
    }

    /// Mean slopes of the cell of a level at a place above the square, and the height of its mean plane
    /// there.
    fn plane(&self, at: [Q24; 2], level: u32) -> Option<(Slope, Q24)> {
        if at.iter().any(|c| !(0..1 << 24).contains(c)) {
            return None;
        }
        let surface = &self.caster.surface;
        let parts = surface.parts(level);
        let index = at.map(|c| ((i64::from(c) * i64::from(parts)) >> 24) as u32);
        let heights = surface.sheet().part_bits(index, level);
        let slope = self.moments.over(&heights.map(Real::from_bits), parts).mean.map(Real::to_bits);
        let [x, y] = Self::middle(index, parts);
        let rise = |slope: i32, by: i32| product(slope, by) >> 24;
        let rise = rise(slope[0], at[0].wrapping_sub(x)).wrapping_add(rise(slope[1], at[1].wrapping_sub(y)));
        let height = surface.sheet().scheme().middle(&heights);
        Some((slope, height.saturating_add(rise.clamp(-(1 << 30), 1 << 30) as i32)))
    }

    /// All cells of a level that lie in a pixel; none where one turns away from the eye, or where they are
    /// too many.
    fn sum(&self, pixel: &Pixel, view: &View<'_>, deepest: u32) -> Option<Sum> {
        let (surface, mut sum) = (&self.caster.surface, Sum::default());
        let (sheet, cells) = (surface.sheet(), surface.sheet().cells());
        let mut nodes = [Node { heights: [0; 16], place: [0; 2], next: 0 }; DEEPEST as usize + 1];
        let mut left = MOST_NODES;
        for place in (0..cells).flat_map(|i| (0..cells).map(move |j| [i, j])) {
            let heights = sheet.cell(place);
            if !self.is_near(pixel, &heights, place, cells) {
                continue;
            }
            if deepest == 0 {
                self.add(pixel, view, (&heights, place, cells), &mut sum)?;
                continue;
            }
            nodes[0] = Node { heights, place, next: 0 };
            let mut level = 0_usize;
            while let Some(node) = nodes.get_mut(level) {
                if node.next == 4 {
                    let Some(above) = level.checked_sub(1) else { break };
                    level = above;
                    continue;
                }
                let digits = [node.next >> 1, node.next & 1];
                node.next += 1;
                left = left.checked_sub(1)?;
                let place = [node.place[0] << 1 | digits[0], node.place[1] << 1 | digits[1]];
                let heights = sheet.scheme().part(&node.heights, digits);
                let parts = surface.parts(level as u32 + 1);
                if !self.is_near(pixel, &heights, place, parts) {
                    continue;
                }
                if level as u32 + 1 >= deepest {
                    self.add(pixel, view, (&heights, place, parts), &mut sum)?;
                    continue;
                }
                level += 1;
                if let Some(node) = nodes.get_mut(level) {
                    *node = Node { heights, place, next: 0 };
                }
            }
        }
        Some(sum)
    }

    /// Half the width of one of so many cells.
    fn half(parts: u32) -> i32 {
        (1_u32 << 23).checked_div(parts).unwrap_or(0) as i32
    }

    fn is_near(&self, pixel: &Pixel, heights: &[Q24; 16], place: [u32; 2], parts: u32) -> bool {
        let [low, high] = self.caster.surface.sheet().scheme().bounds(heights);
        let ([x, y], half) = (Self::middle(place, parts), Self::half(parts).saturating_add(1));
        let (z, up) =
            ((low >> 1).wrapping_add(high >> 1), (high >> 1).wrapping_sub(low >> 1).saturating_add(1));
        pixel.meets([x, y, z], [half, half, up])
    }

    /// Adds what a cell shows.
    fn add(
        &self,
        pixel: &Pixel,
        view: &View<'_>,
        (heights, place, parts): (&[Q24; 16], [u32; 2], u32),
        sum: &mut Sum,
    ) -> Option<()> {
        let [x, y] = Self::middle(place, parts);
        let z = self.caster.surface.sheet().scheme().middle(heights);
        let share = pixel.share([x, y, z], Self::half(parts));
        if share == 0 {
            return Some(());
        }
        let slopes = self.moments.over(&heights.map(Real::from_bits), parts);
        let slopes =
            Spread { mean: slopes.mean.map(Real::to_bits), covariance: slopes.covariance.map(Real::to_bits) };
        let Seen { area, matt, highlight } = view.seen(&mut slopes.points())?;
        sum.area = sum.area.saturating_add(u64::from(area.get() >> 2) * u64::from(share));
        let part = |of: i64| (of >> 22) * i64::from(share);
        sum.matt = sum.matt.saturating_add(part(matt));
        sum.highlight = sum.highlight.saturating_add(part(highlight));
        Some(())
    }
}

/// The side of a square as large as one of `n` parts of a parallelogram.
fn width([a, b]: [[i32; 2]; 2], n: i32) -> i32 {
    let area = (product(a[0], b[1]) - product(a[1], b[0])).unsigned_abs();
    rough_sqrt(area.checked_div(u64::from(n.unsigned_abs())).unwrap_or(0)).max(1) as i32
}

impl Field for FilteredPatch<'_> {
    type Value = Tone;

    fn size(&self) -> Size {
        self.caster.size()
    }

    fn at(&self, x: u32, y: u32) -> Tone {
        rounded(self.tone(x, y).0.to_bits().unsigned_abs())
    }
}
