//! The lattice of a surface row by row: each row from the two before it on every level, in lent memory.
//!
//! Two rows a level are kept. Level `l` refines the rows that level `l - 1` hands over, and puts one row
//! between each two of them; a step of the finest level moves as many levels on as its row's number has
//! binary zeros at the end. The heights are those of [`PlaneToLine::height`], bit for bit, for a fortieth of
//! the work. Source: L. C. Carpenter, "Computer rendering of fractal curves and surfaces", 1980 ("a fast
//! scanline-like algorithm is possible").

use core::ops::Range;

use super::cell::Cell;
use super::law::{LEVELS, centre, edge};
use super::plane_to_line::PlaneToLine;
use super::random::Randomness;
use crate::Error;
use crate::num::{Coordinate, Real};

/// Rows of heights of a surface, or of a piece of it, from the first on.
///
/// ```
/// use attractor::num::{RandomField, Real, Unit};
/// use attractor::terrain::{Heights, Law, PlaneToLine, Rows};
///
/// const KNOTS: [Real; 4] = [Real::ZERO; 4];
/// let law = Law::new(const { Unit::lit("0.3") }, const { Unit::lit("0.8") })?;
/// let terrain = PlaneToLine::new(Heights::new(2, 2, &KNOTS)?, law, RandomField::new(7))?;
/// let mut memory = [Real::ZERO; Rows::<RandomField>::words(1, 3)];
/// let mut rows = Rows::new(&terrain, 3, &mut memory)?;
/// let mut count = 0;
/// while let Some(row) = rows.next_row() {
///     let [u, v] = terrain.point(3, 5, count);
///     assert_eq!(row.get(5), Some(&terrain.height(u, v)));
///     count += 1;
/// }
/// assert_eq!(count, 9);
/// # Ok::<(), attractor::Error>(())
/// ```
#[derive(Debug)]
pub struct Rows<'a, 't, R = crate::num::RandomField> {
    terrain: &'a PlaneToLine<'t, R>,
    memory: &'a mut [Real],
    /// The level of the cells from which the piece is refined, their first column and row, and how many.
    base: u32,
    first: [u32; 2],
    cells: [u32; 2],
    /// How often these are halved.
    depth: u32,
    /// The row that was handed over last.
    row: Option<u32>,
}

/// How many heights a row has.
const fn width(cells: u32, level: u32) -> usize {
    ((cells as usize) << level) + 1
}

impl<'a, 't, R: Randomness> Rows<'a, 't, R> {
    /// How many heights [`Rows::new`] is to be lent for so many cells a row, each halved `levels` times.
    pub const fn words(cells: u32, levels: u32) -> usize {
        let (mut words, mut level) = (width(cells, 0), 1);
        while level <= levels {
            words += 2 * width(cells, level);
            level += 1;
        }
        words
    }

    /// All rows of the lattice of a level.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a level above 16, [`Error::BufferLength`] for too little memory.
    pub fn new(terrain: &'a PlaneToLine<'t, R>, level: u32, memory: &'a mut [Real]) -> Result<Self, Error> {
        let knots = terrain.heights();
        Self::of(terrain, 0, [0..knots.columns() - 1, 0..knots.rows() - 1], level, memory)
    }

    /// The rows of a piece: of so many columns and rows of cells at the level `base`, each halved down to
    /// `level`.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for a level above 16 or below `base`, or cells that are not there,
    /// [`Error::BufferLength`] for too little memory.
    pub fn of(
        terrain: &'a PlaneToLine<'t, R>,
        base: u32,
        [columns, rows]: [Range<u32>; 2],
        level: u32,
        memory: &'a mut [Real],
    ) -> Result<Self, Error> {
        let out_of = |what, value: u32, min: u32, max: u32| {
            let [value, min, max] = [value, min, max].map(crate::num::Wide::saturating_from_num);
            Err(Error::OutOfRange { what, index: None, value, min, max })
        };
        if base > LEVELS || level > LEVELS || level < base {
            return out_of("level", level, base.min(LEVELS), LEVELS);
        }
        let knots = terrain.heights();
        let pieces = [("column", &columns, knots.columns()), ("row", &rows, knots.rows())];
        for (what, cells, count) in pieces {
            let most = (count - 1) << base;
            if cells.start >= cells.end || cells.end > most {
                return out_of(what, cells.end, cells.start.saturating_add(1), most);
            }
        }
        let cells = [columns.end - columns.start, rows.end - rows.start];
        let depth = level - base;
        let needed = Self::words(cells[0], depth);
        let given = memory.len();
        if given < needed {
            return Err(Error::BufferLength { what: "rows of a surface", given, needed });
        }
        Ok(Self { terrain, memory, base, first: [columns.start, rows.start], cells, depth, row: None })
    }

    /// How many heights a row has.
    pub const fn width(&self) -> usize {
        width(self.cells[0], self.depth)
    }

    /// How many rows there are.
    pub const fn count(&self) -> usize {
        width(self.cells[1], self.depth)
    }

    /// The next row, from west to east; none after the last.
    ///
    /// Cost: on average one hash and two products a height (the kernel row `terrain row` counts them).
    pub fn next_row(&mut self) -> Option<&[Real]> {
        let depth = self.depth;
        match self.row {
            None => {
                self.take(0);
                for level in 1..=depth {
                    self.refine(level, 0);
                }
                self.row = Some(0);
            }
            Some(last) => {
                if last as usize + 1 >= self.count() {
                    return None;
                }
                // the levels below this one stand at an even row and go on
                let moving = depth - last.trailing_zeros().min(depth);
                if moving == 0 {
                    self.take((last >> depth) + 1);
                }
                for level in moving + 1..=depth {
                    let half = last >> (depth - level) >> 1;
                    self.refine(level, half + 1);
                    self.between(level, half);
                }
                self.row = Some(last + 1);
            }
        }
        let row = self.row?;
        let place = self.place(depth, row);
        let width = self.width();
        self.memory.get(place..)?.get(..width)
    }

    /// Writes the heights of all rows, one behind the other, as [`super::Heights`] has them.
    ///
    /// # Errors
    /// [`Error::BufferLength`] for too little room.
    pub fn write(mut self, heights: &mut [Real]) -> Result<(), Error> {
        let (given, needed) = (heights.len(), self.width() * self.count());
        if given < needed {
            return Err(Error::BufferLength { what: "heights of a lattice", given, needed });
        }
        let mut places = heights.chunks_mut(self.width().max(1));
        while let Some(row) = self.next_row() {
            if let Some(place) = places.next() {
                for (place, height) in place.iter_mut().zip(row) {
                    *place = *height;
                }
            }
        }
        Ok(())
    }

    /// Where a row of a level stands: two places are used in turn, an odd row takes that of the one before.
    fn place(&self, level: u32, row: u32) -> usize {
        match level.checked_sub(1) {
            None => 0,
            Some(above) => {
                let width = width(self.cells[0], level);
                let slot = if row & 2 == 0 { 0 } else { width };
                Self::words(self.cells[0], above) + slot
            }
        }
    }

    /// The coordinate of a column or row of a level below the base, 16 fractional bits, from the first of
    /// the piece on.
    fn from(&self, axis: usize) -> i32 {
        let origin = self.terrain.heights().origin().get(axis).copied().unwrap_or(0);
        let first = self.first.get(axis).copied().unwrap_or(0);
        (i32::from(origin) << 16).wrapping_add((first << (LEVELS - self.base)) as i32)
    }

    /// A row of the base.
    fn take(&mut self, row: u32) {
        let [column, first_row] = self.first;
        let (terrain, base) = (self.terrain, self.base);
        let heights = self.memory.iter_mut().take(width(self.cells[0], 0));
        for (column, height) in (column..).zip(heights) {
            let [u, v] = terrain.point(base, column, first_row + row);
            *height = terrain.height(u, v);
        }
    }

    /// The row of the level above with the middles of its edges.
    fn refine(&mut self, level: u32, row: u32) {
        let (from, to) = (self.place(level - 1, row), self.place(level, 2 * row));
        let deep = self.base + level - 1;
        let half = Cell::half(deep);
        let offset = self.terrain.law().at(deep);
        let v = Coordinate::from_bits(self.from(1).wrapping_add(2 * half * row as i32));
        let mut u = self.from(0).wrapping_add(half);
        let (above, own) = self.memory.split_at_mut_checked(to).unwrap_or_default();
        let above = above.get(from..).unwrap_or_default();
        let mut own = own.iter_mut().take(width(self.cells[0], level));
        let mut before = above.first().copied().unwrap_or_default();
        if let Some(place) = own.next() {
            *place = before;
        }
        for next in above.iter().skip(1) {
            let (Some(middle), Some(corner)) = (own.next(), own.next()) else { return };
            let [r, _] = self.terrain.random().at(Coordinate::from_bits(u), v);
            *middle = Real::from_bits(edge(before.to_bits(), next.to_bits(), offset, r));
            *corner = *next;
            before = *next;
            u = u.wrapping_add(2 * half);
        }
    }

    /// The row between two, in the place of the first of them.
    fn between(&mut self, level: u32, half_row: u32) {
        let deep = self.base + level - 1;
        let half = Cell::half(deep);
        let offset = self.terrain.law().at(deep);
        let v = self.from(1).wrapping_add(half).wrapping_add(2 * half * half_row as i32);
        let v = Coordinate::from_bits(v);
        let mut u = self.from(0);
        let random = self.terrain.random();
        let width = width(self.cells[0], level);
        let low = self.place(level, 0);
        let both = self.memory.get_mut(low..).unwrap_or_default();
        let (even, odd) = both.split_at_mut_checked(width).unwrap_or_default();
        let (top, bottom) = if half_row & 1 == 0 { (even, &*odd) } else { (odd, &*even) };
        // south is the row above in memory: the first of both
        let mut columns = top.iter_mut().zip(bottom);
        let Some((first, north)) = columns.next() else { return };
        let [_, r] = random.at(Coordinate::from_bits(u), v);
        let mut west = edge(first.to_bits(), north.to_bits(), offset, r);
        *first = Real::from_bits(west);
        while let (Some((middle, north_middle)), Some((corner, north))) = (columns.next(), columns.next()) {
            let r = random.at(Coordinate::from_bits(u.wrapping_add(half)), v);
            u = u.wrapping_add(2 * half);
            let [_, east] = random.at(Coordinate::from_bits(u), v);
            let east = edge(corner.to_bits(), north.to_bits(), offset, east);
            let edges = [middle.to_bits(), north_middle.to_bits(), west, east];
            *middle = Real::from_bits(centre(edges, offset, r));
            *corner = Real::from_bits(east);
            west = east;
        }
    }
}
