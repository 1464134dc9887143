//! Terrain by bounds alone: a surface by subdivision, however fine, without any memory but the stack.
//!
//! A ray halves the cells that it comes near. What bounds the heights of a cell are its corners and how far
//! all further displacements can reach ([`Law::reach`](crate::terrain::Law::reach)). A cell is a leaf at the
//! lattice's finest level, or, where the ray has a width, as soon as it is no wider than that: the resolution
//! follows the magnification. Leaves are bilinear.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, "Summary".

use core::ops::ControlFlow;

use super::super::ray::{Footprint, Ray};
use super::super::surface::{Crossing, Extent, Surface, SurfacePoint};
use super::leaf::{Frame, Place};
use super::meet::{CROSSINGS, error, extent, handed, point, value};
use super::plot::Rule;
use super::walk::{LEVELS, Tree, walk};
use crate::Error;
use crate::num::formats::Q24;
use crate::num::{RandomField, Real, Unit, Vec3, Wide};
use crate::terrain::{Bilinear, Cell, Form, Halved, PlaneToLine, Randomness};

/// A surface by subdivision over a rectangle of the world.
///
/// ```
/// use attractor::num::{RandomField, Real, Unit};
/// use attractor::terrain::{Heights, Law, PlaneToLine};
/// use attractor::trace::{DeepTerrain, Surface};
///
/// const KNOTS: [Real; 4] = [Real::ZERO; 4];
/// let law = Law::new(const { Unit::lit("0.3") }, const { Unit::lit("0.8") })?;
/// let terrain = PlaneToLine::new(Heights::new(2, 2, &KNOTS)?, law, RandomField::new(7))?;
/// // 4096 x 4096 cells
/// let deep = DeepTerrain::new(&terrain, 12, [[Real::ZERO, Real::ONE]; 2])?;
/// assert!(!deep.is_closed());
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct DeepTerrain<'a, R = RandomField> {
    function: &'a PlaneToLine<'a, R>,
    /// The level of the finest cells of the surface.
    finest: u32,
    /// How far heights inside a cell can lie outside those of its corners, by its level in the tree.
    reach: [Q24; 17],
    frame: Frame,
}

impl<'a, R: Randomness> DeepTerrain<'a, R> {
    /// The surface down to this level, over the rectangle of these ends along x and y.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] where the rectangle leaves ±64, [`Error::Degenerate`] for cells narrower than
    /// `2^-13`, [`Error::Capacity`] for a level above 16 or more than 65536 columns or rows of cells.
    pub fn new(
        terrain: &'a PlaneToLine<'a, R>,
        finest: u32,
        [along_x, along_y]: [[Real; 2]; 2],
    ) -> Result<Self, Error> {
        if finest > crate::terrain::LEVELS {
            let capacity = crate::terrain::LEVELS as usize;
            return Err(Error::Capacity { what: "levels", needed: finest as usize, capacity });
        }
        let knots = terrain.heights();
        let (across, down) = (knots.columns() - 1, knots.rows() - 1);
        let most = across.max(down) << finest;
        if most > 1 << 16 {
            return Err(Error::Capacity { what: "cells a side", needed: most as usize, capacity: 1 << 16 });
        }
        let rule = |what, [from, to]: [Real; 2], count| Rule::new(what, from, to, count);
        let rules = [
            rule("extent along x", along_x, across << finest)?,
            rule("extent along y", along_y, down << finest)?,
        ];
        let reach = core::array::from_fn(|level| {
            let reach = terrain.law().reach(finest.saturating_sub(level as u32), finest);
            // and what arithmetic along a ray may add
            (reach.to_bits() >> 24) as i32 + (1 << 6)
        });
        let whole = terrain.law().reach(0, finest).to_bits() >> 24;
        let [low, high] = knots.range().map(|h| i64::from(h.to_bits()));
        let bits = |c: i64| c.clamp(-(64 << 24), 64 << 24) as i32;
        let heights = [bits(low - whole - (1 << 6)), bits(high + whole + (1 << 6))];
        // the level with one node
        let depth = (finest + 32 - (across.max(down) - 1).leading_zeros()).min(LEVELS);
        Ok(Self { function: terrain, finest, reach, frame: Frame { rules, heights, depth } })
    }

    /// The cell of a node, by descent.
    fn cell(&self, place: Place) -> Cell {
        let below = self.finest.saturating_sub(place.level);
        let mut cell = self.function.knot_cell(place.column >> below, place.row >> below);
        for level in 0..below {
            let middles = cell.halved(level, self.function.law(), self.function.random());
            let bit = |index: u32| index >> (below - 1 - level) & 1 > 0;
            cell = cell.part(level, &middles, bit(place.column), bit(place.row));
        }
        cell
    }
}

/// A parameter, saturated.
fn word(t: i64) -> Q24 {
    t.min(i64::from(i32::MAX)) as i32
}

/// A ray with its width.
struct Seen<'b, 'a, R> {
    terrain: &'b DeepTerrain<'a, R>,
    /// How far from the tip of its cone it is as wide as the finest cells, and where it starts from there.
    wide_from: Q24,
    begin: Q24,
}

impl<R: Randomness> Tree for Seen<'_, '_, R> {
    type Node = Cell;
    type Middle = Halved;

    fn root(&self) -> Cell {
        if self.terrain.frame.depth == self.terrain.finest {
            self.terrain.function.knot_cell(0, 0)
        } else {
            Cell::default()
        }
    }

    #[inline(always)]
    fn range(&self, place: Place, cell: &Cell) -> [Q24; 2] {
        if place.level > self.terrain.finest {
            return self.terrain.frame.heights;
        }
        let [low, high] = Bilinear { corners: cell.corners }.range();
        let reach = self.terrain.reach.get(place.level as usize).copied().unwrap_or(0);
        [low.saturating_sub(reach), high.saturating_add(reach)]
    }

    #[inline(always)]
    fn middle(&self, place: Place, cell: &Cell) -> Halved {
        match self.terrain.finest.checked_sub(place.level) {
            Some(level) => cell.all(level, self.terrain.function.law(), self.terrain.function.random()),
            None => Halved::default(),
        }
    }

    #[inline(always)]
    fn part(&self, place: Place, halved: &Halved) -> Cell {
        let finest = self.terrain.finest;
        if place.level < finest {
            halved.quarter(finest - place.level - 1, [place.column & 1, place.row & 1])
        } else if place.level == finest {
            self.terrain.function.knot_cell(place.column, place.row)
        } else {
            Cell::default()
        }
    }

    #[inline(always)]
    fn patch(&self, _: Place, cell: &Cell) -> (Form, u32) {
        let patch = Bilinear { corners: cell.corners };
        (Form::Bilinear(patch), patch.twist() << 5)
    }

    fn leaves(&self, t: Q24) -> (u32, Q24) {
        let far = t.saturating_add(self.begin);
        // twice as far for cells twice as wide
        let is_wide = |level: &u32| far >> (level & 31) >= self.wide_from;
        let level = (1..=self.terrain.finest).take_while(is_wide).last().unwrap_or(0);
        let next = (i64::from(self.wide_from) << (level + 1)) - i64::from(self.begin);
        (level, if level < self.terrain.finest { word(next) } else { i32::MAX })
    }
}

impl<R: Randomness> Surface for DeepTerrain<'_, R> {
    fn extent(&self) -> Extent {
        extent(&self.frame)
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn most_crossings(&self) -> u32 {
        CROSSINGS
    }

    /// A part of a finest cell.
    fn error(&self) -> Real {
        error(&self.frame)
    }

    fn cross(&self, ray: &Ray, cone: Unit, found: &mut impl FnMut(Crossing) -> ControlFlow<()>) {
        let [columns, rows] = &self.frame.rules;
        let width = columns.width().max(rows.width());
        // without a width it sees all
        let (wide_from, begin) = if cone > Unit::ZERO || ray.width > 0 {
            let footprint = Footprint::new(cone);
            (word(footprint.length(width)), word(footprint.length(ray.width)))
        } else {
            (i32::MAX, 0)
        };
        let seen = Seen { terrain: self, wide_from, begin };
        let _ = walk(&seen, &self.frame, &ray.axes(), &mut handed(found));
    }

    fn value(&self, place: Vec3) -> Wide {
        value(&self.frame, place, |place| Form::Bilinear(Bilinear { corners: self.cell(place).corners }))
    }

    fn point(&self, ray: &Ray, cone: Unit, crossing: &Crossing, charted: bool) -> SurfacePoint {
        point(&self.frame, ray, cone, crossing, charted, |place| {
            Form::Bilinear(Bilinear { corners: self.cell(place).corners })
        })
    }
}
