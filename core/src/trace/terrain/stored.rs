//! Terrain of stored heights: patches of any inner geometry, and a lent pyramid of bounds.

use core::ops::ControlFlow;

use super::super::ray::Ray;
use super::super::surface::{Crossing, Extent, Surface, SurfacePoint};
use super::meet::{crossings, extent, point, value};
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
        Ok(Self { heights, inner, ranges: memory, begins: begins(columns, rows), frame })
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
        self.inner.patch(&self.heights, place.column, place.row).0
    }

    #[inline(always)]
    fn is_leaf(&self, place: Place, _: Q24) -> bool {
        place.level == 0
    }
}

impl Surface for Terrain<'_> {
    fn extent(&self) -> Extent {
        extent(&self.frame)
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn most_crossings(&self) -> u32 {
        super::meet::CROSSINGS
    }

    /// As far as a hundredth of a cell.
    fn error(&self) -> Real {
        super::meet::error(&self.frame)
    }

    fn cross(&self, ray: &Ray, _: Unit, found: &mut impl FnMut(Crossing) -> ControlFlow<()>) {
        crossings(self, &self.frame, ray, found);
    }

    fn value(&self, place: Vec3) -> Wide {
        value(&self.frame, place, |place| self.patch(place, &()))
    }

    fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint {
        point(&self.frame, ray, cone, crossing, charted, |place| self.patch(place, &()))
    }
}
