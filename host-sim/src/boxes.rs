//! Box counting: the cells of a fine grid that a set meets, put together into boxes of several sizes.
//!
//! Boxes of 8 to 64 cells a side are counted, on eight positions of the grid for each size, and `log N` is
//! averaged over the positions: that removes most of the staircase. Boxes below 8 cells feel the cells, those
//! above a 64th of the picture feel its rim.

use attractor::ifs::{Affine, Ifs, MAX_MAPS};
use attractor::plane::{Bounds2, PathElement, Point2};

/// The most images of a set that are opened for one grid.
const MOST_IMAGES: u64 = 1 << 26;
/// The most orbits that go on from a cell.
const HITS: u8 = 8;
/// The most pieces of a path.
const MOST_PIECES: usize = 1 << 24;
/// Sides of boxes in cells.
const BOXES: [i64; 13] = [8, 10, 11, 13, 16, 19, 23, 27, 32, 38, 45, 54, 64];
/// Positions of the grid of boxes for each size.
const POSITIONS: i64 = 8;

/// Which cells of a square are met.
#[derive(Debug)]
pub(crate) struct Grid {
    side: i64,
    x0: f64,
    y0: f64,
    /// The side of a cell.
    cell: f64,
    met: Vec<u64>,
}

impl Grid {
    /// No cell is met: the square on the longer side of a box, from its lower left corner.
    pub(crate) fn empty(bounds: &Bounds2, side: i64) -> Self {
        let cell = extent(bounds) / side as f64;
        let (x0, y0) = (bounds.min.x.to_num(), bounds.min.y.to_num());
        Self { side, x0, y0, cell, met: vec![0; (side * side) as usize / 64] }
    }

    /// Opens addresses until an image is at most this share of a cell across: below half a cell no cell
    /// inside the set is missed; each image leaves a point of the attractor. None when it takes too many
    /// images.
    pub(crate) fn of_attractor(ifs: &Ifs<MAX_MAPS>, side: i64, share: f64) -> Option<Self> {
        let maps = float_maps(ifs);
        let bounds = ifs.bounds();
        let mut grid = Self::empty(&bounds, side);
        let small = share * grid.cell / diagonal(&bounds).max(1e-9);
        let (px, py) = float_of(ifs.maps().first()?.fixed_point()?);
        let mut stack: Vec<[f64; 6]> = vec![[1.0, 0.0, 0.0, 1.0, 0.0, 0.0]];
        let mut opened = 0_u64;
        while let Some([a, b, c, d, e, f]) = stack.pop() {
            let stretch = ((a + d).hypot(b - c) + (a - d).hypot(b + c)) / 2.0;
            if stretch <= small {
                grid.mark((a * px + b * py + e, c * px + d * py + f));
                continue;
            }
            opened += maps.len() as u64;
            if opened > MOST_IMAGES {
                return None;
            }
            stack.extend(maps.iter().map(|[p, q, r, s, t, u]| {
                [
                    a * p + b * r,
                    a * q + b * s,
                    c * p + d * r,
                    c * q + d * s,
                    a * t + b * u + e,
                    c * t + d * u + f,
                ]
            }));
        }
        Some(grid)
    }

    /// Follows all orbits of a fixed point, but not on from a cell that has been hit [`HITS`] times. For maps
    /// that overlap so much that there are too many images. Cells that the set hardly touches are missed,
    /// boxes are not.
    pub(crate) fn of_orbits(ifs: &Ifs<MAX_MAPS>, side: i64) -> Option<Self> {
        let maps = float_maps(ifs);
        let mut grid = Self::empty(&ifs.bounds(), side);
        let mut hits = vec![0_u8; (side * side) as usize];
        let mut stack = vec![float_of(ifs.maps().first()?.fixed_point()?)];
        while let Some((x, y)) = stack.pop() {
            for [a, b, c, d, e, f] in &maps {
                let image = (a * x + b * y + e, c * x + d * y + f);
                let hit = hits.get_mut(grid.index(image)).filter(|hits| **hits < HITS);
                if let Some(hit) = hit {
                    *hit += 1;
                    grid.mark(image);
                    stack.push(image);
                }
            }
        }
        Some(grid)
    }

    /// Marks what a path passes, every half cell along its segments; single points are steps without a line.
    pub(crate) fn follow(&mut self, steps: impl Iterator<Item = PathElement>) {
        let mut pen = (0.0, 0.0);
        for step in steps {
            let to = float_of(end(step));
            if let PathElement::LineTo(_) = step {
                let (dx, dy) = (to.0 - pen.0, to.1 - pen.1);
                let marks = (2.0 * dx.hypot(dy) / self.cell) as i64;
                for i in 1..=marks {
                    let t = i as f64 / (marks + 1) as f64;
                    self.mark((pen.0 + dx * t, pen.1 + dy * t));
                }
            }
            self.mark(to);
            pen = to;
        }
    }

    fn index(&self, (x, y): (f64, f64)) -> usize {
        // the far edges belong to the last cells
        let cell = |v: f64, least: f64| (((v - least) / self.cell).floor() as i64).clamp(0, self.side - 1);
        (cell(y, self.y0) * self.side + cell(x, self.x0)) as usize
    }

    fn mark(&mut self, point: (f64, f64)) {
        let index = self.index(point);
        if let Some(word) = self.met.get_mut(index / 64) {
            *word |= 1 << (index % 64);
        }
    }

    fn is_met(&self, x: i64, y: i64) -> bool {
        let inside = (0..self.side).contains(&x) && (0..self.side).contains(&y);
        let index = (y * self.side + x) as usize;
        inside && self.met.get(index / 64).is_some_and(|word| word >> (index % 64) & 1 == 1)
    }

    /// The cells that are met; for a boundary those with an empty neighbour.
    fn cells(&self, boundary: bool) -> Vec<(i64, i64)> {
        let on_the_rim = |x: i64, y: i64| {
            [(-1, 0), (1, 0), (0, -1), (0, 1)].iter().any(|(i, j)| !self.is_met(x + i, y + j))
        };
        (0..self.side)
            .flat_map(|y| (0..self.side).map(move |x| (x, y)))
            .filter(|&(x, y)| self.is_met(x, y) && (!boundary || on_the_rim(x, y)))
            .collect()
    }

    /// `(log(1 / size), log N)` for all sizes, the largest boxes first; none for a point, or nearly so.
    pub(crate) fn counts(&self, boundary: bool) -> Option<Vec<(f64, f64)>> {
        let cells = self.cells(boundary);
        if cells.len() < 16 {
            return None;
        }
        let count =
            |side: &i64| ((self.side as f64 / *side as f64).ln(), mean_log_count(&cells, *side, self.side));
        Some(BOXES.iter().rev().map(count).collect())
    }

    /// The sizes in words.
    pub(crate) fn range(&self) -> String {
        format!(
            "boxes of 1/{} to 1/{} of the larger extent, {} sizes, {POSITIONS} positions each",
            self.side / BOXES[BOXES.len() - 1],
            self.side / BOXES[0],
            BOXES.len()
        )
    }
}

/// `x' = a x + b y + e, y' = c x + d y + f`.
fn float_maps(ifs: &Ifs<MAX_MAPS>) -> Vec<[f64; 6]> {
    let float = |m: &Affine| {
        let [a, b, c, d] = [m.a, m.b, m.c, m.d].map(|l| l.to_num::<f64>());
        [a, b, c, d, m.e.to_num::<f64>(), m.f.to_num::<f64>()]
    };
    ifs.maps().iter().map(float).collect()
}

/// The mean logarithm of the number of boxes, over positions spread along both axes.
fn mean_log_count(cells: &[(i64, i64)], side: i64, grid: i64) -> f64 {
    let across = grid / side + 2;
    let mut met = vec![0_i64; (across * across) as usize];
    let mut sum = 0.0;
    for position in 1..=POSITIONS {
        // the second shift by another odd multiple: no two positions share a row
        let (dx, dy) = (position * side / POSITIONS % side, position * 3 * side / POSITIONS % side);
        let mut count = 0_u64;
        for (x, y) in cells {
            if let Some(seen) = met.get_mut(((y + dy) / side * across + (x + dx) / side) as usize)
                && *seen != position
            {
                *seen = position;
                count += 1;
            }
        }
        sum += (count.max(1) as f64).ln();
    }
    sum / POSITIONS as f64
}

/// The box round a path; none when it has too many pieces or no point at all.
pub(crate) fn bounds(steps: impl Iterator<Item = PathElement>) -> Option<Bounds2> {
    let mut bounds: Option<Bounds2> = None;
    for (i, step) in steps.enumerate() {
        if i > MOST_PIECES {
            return None;
        }
        let p = end(step);
        let so_far = bounds.get_or_insert(Bounds2 { min: p, max: p });
        so_far.min = Point2::new(so_far.min.x.min(p.x), so_far.min.y.min(p.y));
        so_far.max = Point2::new(so_far.max.x.max(p.x), so_far.max.y.max(p.y));
    }
    bounds
}

/// The longer side of a box.
pub(crate) fn extent(bounds: &Bounds2) -> f64 {
    let ((x0, y0), (x1, y1)) = (float_of(bounds.min), float_of(bounds.max));
    (x1 - x0).max(y1 - y0)
}

fn diagonal(bounds: &Bounds2) -> f64 {
    let ((x0, y0), (x1, y1)) = (float_of(bounds.min), float_of(bounds.max));
    (x1 - x0).hypot(y1 - y0)
}

const fn end(step: PathElement) -> Point2 {
    let (PathElement::MoveTo(p) | PathElement::LineTo(p)) = step;
    p
}

fn float_of(p: Point2) -> (f64, f64) {
    (p.x.to_num(), p.y.to_num())
}

#[cfg(test)]
mod tests {
    use super::*;
    use attractor::num::Real;

    fn point(x: f64, y: f64) -> Point2 {
        Point2::new(Real::from_num(x), Real::from_num(y))
    }

    #[test]
    fn a_diagonal_and_a_square_are_counted_as_what_they_are() {
        const SIDE: usize = 1024;
        let bounds = Bounds2 { min: point(0.0, 0.0), max: point(1.0, 1.0) };
        let mut grid = Grid::empty(&bounds, SIDE as i64);
        grid.follow([PathElement::MoveTo(point(0.0, 0.0)), PathElement::LineTo(point(1.0, 1.0))].into_iter());
        assert_eq!(grid.cells(false).len(), SIDE);
        let slope =
            |grid: &Grid, boundary| crate::fit::Fit::of(&grid.counts(boundary).unwrap()).unwrap().slope;
        assert!((slope(&grid, false) - 1.0).abs() < 0.02, "{}", slope(&grid, false));
        for i in 0..SIDE {
            let y = (i as f64 + 0.5) / SIDE as f64;
            grid.follow([PathElement::MoveTo(point(0.0, y)), PathElement::LineTo(point(1.0, y))].into_iter());
        }
        // boxes across the rim count in full
        let square = slope(&grid, false);
        assert!(square > 1.9 && square < 2.0, "{square}");
        assert_eq!((grid.cells(false).len(), grid.cells(true).len()), (SIDE * SIDE, 4 * SIDE - 4));
        assert!((slope(&grid, true) - 1.0).abs() < 0.05, "{}", slope(&grid, true));
        assert!(Grid::empty(&bounds, SIDE as i64).counts(false).is_none());
    }

    #[test]
    fn orbits_meet_the_boxes_that_addresses_meet() {
        use attractor::ifs::catalogue;
        for attractor in
            [&catalogue::SIERPINSKI_CARPET, &catalogue::HEIGHWAY_DRAGON, &catalogue::BARNSLEY_FERN]
        {
            let ifs = attractor.ifs::<MAX_MAPS>().unwrap();
            let [all, found] =
                [Grid::of_attractor(&ifs, 512, 0.5), Grid::of_orbits(&ifs, 512)].map(Option::unwrap);
            let (all, found) = (all.counts(false).unwrap(), found.counts(false).unwrap());
            // of logarithms: neither way meets all that the other does
            let off = all.iter().zip(&found).fold(0.0_f64, |most, (a, b)| most.max((a.1 - b.1).abs()));
            println!("{}: log N differs by {off:.5}", attractor.name);
            assert!(off < 0.01 && all[12].1 > 6.0, "{}: {off}", attractor.name);
        }
    }
}
