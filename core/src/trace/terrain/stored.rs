//! Terrain of stored heights: patches of any inner geometry, and a lent pyramid of bounds.

use core::ops::ControlFlow;

use super::super::ball::Ball;
use super::super::ray::{Axis, Ray};
use super::super::surface::{Crossing, Extent, SAME, Surface, SurfacePoint};
use super::meet::{crossings, extent, level_point, point, value};
use super::plot::Rule;
use super::ranges::{HeightRange, begins, count, depth, fill};
use super::walk::{Frame, LEVELS, Place, Tree};
use crate::Error;
use crate::num::formats::Q24;
use crate::num::{Real, Unit, Vec3, Wide};
use crate::terrain::{Form, Heights, InnerGeometry};

/// Heights over a rectangle of the world as a surface, its upper side outward.
///
/// ```
/// use attractor::num::Real;
/// use attractor::terrain::{Heights, InnerGeometry};
/// use attractor::trace::{HeightRange, Terrain, Surface};
///
/// let knots = [0, 1, 0, 1, 2, 1, 0, 1, 0].map(Real::from_num);
/// let mut memory = [HeightRange::default(); Terrain::ranges(3, 3)];
/// let [low, high] = [-2, 2].map(Real::from_num);
/// let heights = Heights::new(3, 3, &knots)?;
/// let hill = Terrain::new(heights, InnerGeometry::BSpline, [[low, high]; 2], &mut memory)?;
/// assert!(hill.extent().high.z >= 1);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Terrain<'a> {
    heights: Heights<'a>,
    inner: InnerGeometry,
    ranges: &'a [HeightRange],
    begins: [u32; 17],
    frame: Frame,
    land: Ball,
    /// The height of the plain.
    plain: Option<Q24>,
}

impl<'a> Terrain<'a> {
    /// How many bounds [`Terrain::new`] is to be lent for so many columns and rows of heights, two of each at
    /// least.
    pub const fn ranges(columns: u32, rows: u32) -> usize {
        count(columns - 1, rows - 1)
    }

    /// The heights over the rectangle of these ends along x and y, spanned by patches.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] where the rectangle or a patch leaves ±64, [`Error::Degenerate`] for cells
    /// narrower than `2^-13`, [`Error::BufferLength`] for too little memory.
    pub fn new(
        heights: Heights<'a>,
        inner: InnerGeometry,
        [along_x, along_y]: [[Real; 2]; 2],
        memory: &'a mut [HeightRange],
    ) -> Result<Self, Error> {
        let (columns, rows) = (heights.columns() - 1, heights.rows() - 1);
        let (given, needed) = (memory.len(), count(columns, rows));
        if given < needed {
            return Err(Error::BufferLength { what: "bounds of a terrain", given, needed });
        }
        let rule = |what, [from, to]: [Real; 2], count| Rule::new(what, from, to, count);
        let rules = [rule("extent along x", along_x, columns)?, rule("extent along y", along_y, rows)?];
        if let Err(value) = fill(&heights, inner, memory) {
            let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
            return Err(Error::OutOfRange {
                what: "height of a patch",
                index: None,
                value: value.into(),
                min,
                max,
            });
        }
        let top = memory.get(needed - 1).copied().unwrap_or_default();
        let frame = Frame { rules, heights: top.heights(), depth: depth(columns, rows).min(LEVELS) };
        let Extent { low, high } = extent(&frame);
        let (begins, land) = (begins(columns, rows), Ball::round(low, high));
        Ok(Self { heights, inner, ranges: memory, begins, frame, land, plain: None })
    }

    /// On a plain or a sea at this height that goes on all round, as a second face: the surface is the higher
    /// of both. What lies below it is not looked for.
    #[must_use]
    pub fn with_plain(mut self, height: Real) -> Self {
        let [low, high] = self.frame.heights;
        self.frame.heights = [low.max(height.to_bits().min(high)), high];
        let Extent { low, high } = extent(&self.frame);
        (self.plain, self.land) = (Some(height.to_bits()), Ball::round(low, high));
        self
    }

    /// Where a ray with these axes crosses the plain.
    fn plain_crossing(&self, [.., z]: &[Axis; 3]) -> Option<Crossing> {
        let t = z.crossing(self.plain?);
        // what is less than 2^-19 behind
        let is_there = (-SAME..i32::MAX).contains(&t);
        let crossing =
            Crossing { t: Real::from_bits(t.max(0)), enters: z.direction < 0, face: 1, memo: [0; 2] };
        is_there.then_some(crossing)
    }

    /// The heights.
    pub const fn heights(&self) -> &Heights<'a> {
        &self.heights
    }
}

impl Tree for Terrain<'_> {
    type Node = ();
    type Middle = ();

    fn root(&self) {}

    #[inline(always)]
    fn range(&self, place: Place, _: &()) -> [Q24; 2] {
        let across = ((self.heights.columns() - 2) >> place.level) + 1;
        let begin = self.begins.get(place.level as usize).copied().unwrap_or(0);
        let index = begin.wrapping_add(place.row.wrapping_mul(across)).wrapping_add(place.column);
        self.ranges.get(index as usize).copied().unwrap_or_default().heights()
    }

    fn middle(&self, _: Place, _: &()) {}

    fn part(&self, _: Place, _: &(), _: &()) {}

    #[inline(always)]
    fn patch(&self, place: Place, _: &()) -> Form {
        self.inner.form(&self.heights, place.column, place.row)
    }

    #[inline(always)]
    fn is_leaf(&self, place: Place, _: Q24) -> bool {
        place.level == 0
    }
}

impl Surface for Terrain<'_> {
    fn extent(&self) -> Extent {
        let land = extent(&self.frame);
        if self.plain.is_none() {
            return land;
        }
        let Extent { low: Vec3 { x, y, .. }, high } = Extent::SPACE;
        Extent { low: Vec3::new(x, y, land.low.z), high: Vec3::new(high.x, high.y, land.high.z) }
    }

    /// With a plain what is below the summit.
    fn ball(&self) -> Ball {
        match self.plain {
            None => self.land,
            Some(_) => Ball { centre: [0, 0, self.frame.heights[1]], up: [0, 0, 1 << 30], ..Ball::SPACE },
        }
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn most_crossings(&self) -> u32 {
        super::meet::CROSSINGS + u32::from(self.plain.is_some())
    }

    /// The plain is the second.
    fn faces(&self) -> u8 {
        1 + u8::from(self.plain.is_some())
    }

    /// As far as a hundredth of a cell.
    fn error(&self) -> Real {
        super::meet::error(&self.frame)
    }

    fn cross(&self, ray: &Ray, _: Unit, found: &mut impl FnMut(Crossing) -> ControlFlow<()>) {
        let axes = ray.axes();
        let plain = self.plain_crossing(&axes);
        // a ray comes to the plain after the land on the way down, and before it on the way up; where it is
        // under the land then, the land is the higher of both
        let mut before = plain.filter(|crossing| !crossing.enters);
        if let Some(crossing) = before
            && self.land.is_passed_by(ray)
        {
            let _ = found(crossing);
            return;
        }
        let walked = crossings(self, &self.frame, &axes, &mut |crossing| {
            if let Some(first) = before.take()
                && crossing.enters
            {
                found(first)?;
            }
            found(crossing)
        });
        if let (ControlFlow::Continue(above), Some(crossing)) = (walked, plain)
            && above != Some(false)
            && (crossing.enters || before.is_some())
        {
            let _ = found(crossing);
        }
    }

    fn value(&self, place: Vec3) -> Wide {
        let above = value(&self.frame, place, |place| self.patch(place, &()));
        let [columns, rows] = &self.frame.rules;
        let is_over = |rule: &Rule, c: Real| {
            let [from, to] = rule.ends();
            from <= c.to_bits() && c.to_bits() <= to
        };
        match self.plain.map(|plain| Wide::from(place.z) - Wide::from(Real::from_bits(plain))) {
            None => above,
            Some(plain) if is_over(columns, place.x) && is_over(rows, place.y) => plain.min(above),
            Some(plain) => plain,
        }
    }

    fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint {
        if crossing.face > 0 {
            return level_point(&self.frame, ray, cone, crossing, charted);
        }
        point(&self.frame, ray, cone, crossing, charted, |place| self.patch(place, &()))
    }
}
