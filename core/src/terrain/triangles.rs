//! A cell as triangles, with as many points on each edge as the edge asks for.
//!
//! Inside, the cell is a grid as fine as the finest of its four edges; the strip between it and an edge is
//! sewn from both rows of points in turn. All points are points of the lattice. A cell on the other side of
//! an edge has the same points on it, so that each edge of a triangle is one of another, bit for bit, the
//! other way round: no crack, at any pair of levels.
//!
//! Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980, figure 7 and
//! "Summary".

use super::edge_level::EdgeLevel;
use super::law::LEVELS;
use super::plane_to_line::PlaneToLine;
use super::random::Randomness;
use crate::Error;
use crate::num::{Coordinate, RandomField, Real, Wide};

/// A corner of a triangle: coordinates and height.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vertex {
    /// Along the columns.
    pub u: Coordinate,
    /// Along the rows.
    pub v: Coordinate,
    /// The height.
    pub height: Real,
}

/// The triangles of a cell, anticlockwise as seen from above.
///
/// ```
/// use attractor::num::{RandomField, Real, Unit};
/// use attractor::terrain::{Heights, Law, PlaneToLine, Triangles};
///
/// const KNOTS: [Real; 4] = [Real::ZERO; 4];
/// let law = Law::new(const { Unit::lit("0.3") }, const { Unit::lit("0.8") })?;
/// let terrain = PlaneToLine::new(Heights::new(2, 2, &KNOTS)?, law, RandomField::new(7))?;
/// assert_eq!(Triangles::new(&terrain, 0, [0, 0], &3)?.count(), 2 * 8 * 8);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Triangles<'a, 't, R = RandomField> {
    terrain: &'a PlaneToLine<'t, R>,
    /// The first corner and the side, 16 fractional bits.
    corner: [i32; 2],
    side: u32,
    /// How often the edges are halved: south, east, north, west.
    levels: [u32; 4],
    /// The finest of them.
    finest: u32,
    /// The next triangle of the grid inside.
    inside: u32,
    /// The strip that is sewn, and how far along its outer and its inner row.
    strip: usize,
    outer: u32,
    inner: u32,
}

impl<'a, 't, R: Randomness> Triangles<'a, 't, R> {
    /// The triangles of the cell at this level, by its column and row, its edges halved by a rule.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a level above 16 or a cell that is not there.
    pub fn new(
        terrain: &'a PlaneToLine<'t, R>,
        level: u32,
        [column, row]: [u32; 2],
        rule: &impl EdgeLevel,
    ) -> Result<Self, Error> {
        let knots = terrain.heights();
        let most = |count: u32| (count - 1) << level.min(LEVELS);
        for (what, value, most) in [
            ("level", level, LEVELS),
            ("column", column, most(knots.columns()) - 1),
            ("row", row, most(knots.rows()) - 1),
        ] {
            if value > most {
                let [value, max] = [value, most].map(Wide::saturating_from_num);
                return Err(Error::OutOfRange { what, index: None, value, min: Wide::ZERO, max });
            }
        }
        let corner = |i: u32, j: u32| terrain.point(level, column + i, row + j);
        let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        // no finer than the lattice, and no more than 2^15 parts
        let deepest = (LEVELS - level).min(15);
        let levels = [[a, b], [b, c], [c, d], [d, a]].map(|[p, q]| rule.level(p, q).min(deepest));
        let finest = levels.into_iter().fold(0, u32::max);
        Ok(Self {
            terrain,
            corner: a.map(Coordinate::to_bits),
            side: 1 << (LEVELS - level),
            levels,
            finest,
            inside: 0,
            strip: 0,
            outer: 0,
            inner: 1,
        })
    }

    /// The point `x`, `y` parts from the corner.
    fn vertex(&self, [x, y]: [u32; 2]) -> Vertex {
        let part = self.side >> self.finest;
        let [u, v] = self.corner;
        let at = |from: i32, k: u32| Coordinate::from_bits(from.wrapping_add((k * part) as i32));
        let (u, v) = (at(u, x), at(v, y));
        Vertex { u, v, height: self.terrain.height(u, v) }
    }

    /// The next triangle of the grid inside, by its corners.
    fn grid(&mut self, parts: u32) -> Option<[[u32; 2]; 3]> {
        // a cell that is not halved is two triangles; else the outermost ring belongs to the strips
        let (count, from) = if parts == 1 { (1, 0) } else { (parts - 2, 1) };
        let quad = self.inside >> 1;
        let (x, y) = (quad.checked_rem(count)? + from, quad.checked_div(count)? + from);
        if y >= count + from {
            return None;
        }
        self.inside += 1;
        Some(if self.inside & 1 == 1 {
            [[x, y], [x + 1, y], [x + 1, y + 1]]
        } else {
            [[x, y], [x + 1, y + 1], [x, y + 1]]
        })
    }

    /// The next triangle of a strip.
    fn sewn(&mut self, parts: u32) -> Option<[[u32; 2]; 3]> {
        while self.strip < 4 {
            let level = self.levels.get(self.strip).copied()?;
            let step = parts >> level;
            let (a, c) = (self.outer, self.inner);
            // along the edge, and away from it
            let turned = |[along, off]: [u32; 2]| match self.strip {
                0 => [along, off],
                1 => [parts - off, along],
                2 => [parts - along, parts - off],
                _ => [off, parts - along],
            };
            let (ended, inner_ended) = (a == parts, c == parts - 1);
            if ended && inner_ended {
                (self.strip, self.outer, self.inner) = (self.strip + 1, 0, 1);
            } else if !ended && (inner_ended || 2 * a + step <= 2 * c + 1) {
                self.outer = a + step;
                return Some([[a, 0], [a + step, 0], [c, 1]].map(turned));
            } else {
                self.inner = c + 1;
                return Some([[a, 0], [c + 1, 1], [c, 1]].map(turned));
            }
        }
        None
    }
}

impl<R: Randomness> Iterator for Triangles<'_, '_, R> {
    type Item = [Vertex; 3];

    fn next(&mut self) -> Option<[Vertex; 3]> {
        let parts = 1 << self.finest;
        let corners = match self.grid(parts) {
            Some(corners) => corners,
            None if parts == 1 => return None,
            None => self.sewn(parts)?,
        };
        Some(corners.map(|corner| self.vertex(corner)))
    }
}
