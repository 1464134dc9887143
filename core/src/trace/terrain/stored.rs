//! Terrain of stored heights: patches of any inner geometry, and a lent pyramid of bounds.

use core::ops::ControlFlow;

use super::super::ball::Ball;
use super::super::ray::{Axis, Ray};
use super::super::surface::{Crossing, Extent, SAME, Surface, SurfacePoint};
use super::leaf::{Frame, Place};
use super::meet::{extent, handed, level_point, point, value};
use super::plot::Rule;
use super::ranges::{HeightRange, count, fill, top, unit, whole};
use super::steps::{Levels, walk};
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
    levels: Levels<'a>,
    frame: Frame,
    land: Ball,
    /// The height of the plain.
    plain: Option<Q24>,
}

/// How far the box of a terrain goes beyond its heights, more than what a ray's parameters are known to.
const MARGIN: Q24 = 1 << 9;

/// To which power of 1/2 of a cell places along a ray are known: `2^-16`, and what 14 bits tell.
fn loose(rules: &[Rule; 2]) -> u32 {
    let width = rules.iter().fold(i32::MAX, |least, rule| least.min(rule.width()));
    (22 - width.leading_zeros().min(22)).min(11)
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
        let [low, high] = whole(&heights, inner).map_err(|value| {
            let (min, max) = (Wide::from_num(-64), Wide::from_num(64));
            Error::OutOfRange { what: "height of a patch", index: None, value: value.into(), min, max }
        })?;
        let unit = unit([low, high]);
        fill(&heights, inner, (unit, loose(&rules)), memory);
        let levels = Levels::new(&rules, unit, memory);
        // a ray enters above the highest place, and leaves below the lowest
        let heights_of_box = [low.saturating_sub(MARGIN), high.saturating_add(MARGIN)];
        let frame = Frame { rules, heights: heights_of_box, depth: top(columns, rows) };
        let Extent { low, high } = extent(&frame);
        let land = Ball::round(low, high);
        Ok(Self { heights, inner, levels, frame, land, plain: None })
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

    /// The lowest and the highest of land and plain.
    fn ends(&self) -> [Q24; 2] {
        let [low, high] = self.frame.heights;
        match self.plain {
            Some(plain) if plain > high => [low, plain.saturating_add(MARGIN)],
            Some(plain) => [low.min(plain), high],
            None => [low, high],
        }
    }

    /// Where a ray crosses the plain.
    fn plain_crossing(&self, z: &Axis) -> Option<Crossing> {
        let t = z.crossing(self.plain?);
        // what is less than 2^-19 behind
        let is_there = (-SAME..i32::MAX).contains(&t);
        let crossing =
            Crossing { t: Real::from_bits(t.max(0)), enters: z.direction < 0, face: 1, memo: [0; 2] };
        is_there.then_some(crossing)
    }

    /// The patch of a cell that is there.
    #[inline(always)]
    fn patch(&self, place: Place) -> Form {
        self.inner.form(&self.heights, place.column, place.row)
    }

    /// The heights.
    pub const fn heights(&self) -> &Heights<'a> {
        &self.heights
    }
}

impl Surface for Terrain<'_> {
    fn extent(&self) -> Extent {
        let land = extent(&self.frame);
        if self.plain.is_none() {
            return land;
        }
        let Extent { low: Vec3 { x, y, .. }, high } = Extent::SPACE;
        let [bottom, top] = self.ends().map(Real::from_bits);
        Extent { low: Vec3::new(x, y, bottom), high: Vec3::new(high.x, high.y, top) }
    }

    /// With a plain what is below the highest place of both.
    fn ball(&self) -> Ball {
        match self.plain {
            None => self.land,
            Some(_) => Ball { centre: [0, 0, self.ends()[1]], up: [0, 0, 1 << 30], ..Ball::SPACE },
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
        let z = ray.upright();
        let plain = self.plain_crossing(&z);
        // a ray comes to the plain after the land on the way down, and before it on the way up; where it is
        // under the land then, the land is the higher of both
        let mut before = plain.filter(|crossing| !crossing.enters);
        if let Some(crossing) = before
            && self.land.is_passed_by(ray)
        {
            let _ = found(crossing);
            return;
        }
        let [x, y] = ray.level();
        let axes = [x, y, z];
        let walked = walk(
            &self.levels,
            |place| self.patch(place),
            &self.frame,
            &axes,
            &mut handed(&mut |crossing: Crossing| {
                if let Some(first) = before.take()
                    && crossing.enters
                {
                    found(first)?;
                }
                found(crossing)
            }),
        );
        if let (ControlFlow::Continue(above), Some(crossing)) = (walked, plain)
            && above != Some(false)
            && (crossing.enters || before.is_some())
        {
            let _ = found(crossing);
        }
    }

    fn value(&self, place: Vec3) -> Wide {
        let above = value(&self.frame, place, |place| self.patch(place));
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
        point(&self.frame, ray, cone, crossing, charted, |place| self.patch(place))
    }
}
