//! A surface by its lines, in parallel projection: how it is subdivided.

use attractor::Error;
use attractor::num::{Coordinate, Real};
use attractor::plane::{PathElement, Point2, Window};
use attractor::terrain::{Magnification, PlaneToLine, Triangles};
use embedded_graphics::geometry::Size;

use crate::page::{Display, Extent, Watch, inner, paper};
use crate::pencil::Pencil;
use crate::terrain::TerrainPicture;

/// Which lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lines {
    /// The edges of the cells between knots, straight and with their middles.
    Edges,
    /// All lines of the lattice.
    Lattice,
    /// Triangles whose edges are halved by magnification.
    Triangles(Magnification),
}

type Function<'a> = PlaneToLine<'a>;

impl TerrainPicture<'_> {
    /// Draws its lines.
    ///
    /// # Errors
    /// Those of [`TerrainPicture::function`]; [`Error::Capacity`] for too many points.
    pub fn draw_lines<D: Display>(
        &self,
        lines: Lines,
        pencil: Pencil,
        size: Size,
        target: &mut D,
        watch: Watch<'_, D>,
    ) -> Result<(), Error> {
        let function = self.function()?;
        match lines {
            Lines::Edges => self.page(pencil, size, target, watch, || {
                let cell = 1 << self.levels;
                self.ruled(&function, (cell, cell)).chain(self.ruled(&function, (cell, 1)))
            }),
            Lines::Lattice => self.page(pencil, size, target, watch, || self.ruled(&function, (1, 1))),
            Lines::Triangles(rule) => self.page(pencil, size, target, watch, || self.sewn(&function, rule)),
        }
    }

    /// A path that can be walked twice, on paper.
    fn page<D: Display, P: Iterator<Item = PathElement>>(
        &self,
        pencil: Pencil,
        size: Size,
        target: &mut D,
        watch: Watch<'_, D>,
        path: impl Fn() -> P,
    ) -> Result<(), Error> {
        let extent = Extent::of(path())?;
        let inner = inner(size, 2);
        let window = Window::fit(extent.room(), inner.size)?;
        paper(size, target);
        pencil.line(path(), extent.points, (window, inner.top_left), target, watch);
        Ok(())
    }

    /// Every so many rows and columns of the lattice, by every so many points of each.
    fn ruled<'b>(
        &'b self,
        function: &'b Function<'b>,
        (every, step): (usize, usize),
    ) -> impl Iterator<Item = PathElement> + 'b {
        let (columns, rows) = self.lattice();
        let at = move |i: u32, j: u32, starts: bool| {
            let [u, v] = function.point(self.levels, i, j);
            to(self.seen([u, v], function.height(u, v)), starts)
        };
        let points = move |count: u32| (0..count).step_by(step);
        let lines = move |count: u32| (0..count).step_by(every);
        let along = lines(rows).flat_map(move |j| points(columns).map(move |i| at(i, j, i == 0)));
        let across = lines(columns).flat_map(move |i| points(rows).map(move |j| at(i, j, j == 0)));
        along.chain(across)
    }

    /// Round each triangle of each cell between knots.
    fn sewn<'b>(
        &'b self,
        function: &'b Function<'b>,
        rule: Magnification,
    ) -> impl Iterator<Item = PathElement> + 'b {
        let heights = function.heights();
        let (columns, rows) = (heights.columns() - 1, heights.rows() - 1);
        let cells = (0..rows).flat_map(move |j| (0..columns).map(move |i| [i, j]));
        let triangles =
            cells.flat_map(move |cell| Triangles::new(function, 0, cell, &rule).into_iter().flatten());
        triangles.flat_map(move |[a, b, c]| {
            [(a, true), (b, false), (c, false), (a, false)]
                .map(|(vertex, starts)| to(self.seen([vertex.u, vertex.v], vertex.height), starts))
        })
    }

    /// Where a point is seen: `x` to the right and forward, `y` to the left and forward, `z` up.
    fn seen(&self, [u, v]: [Coordinate; 2], height: Real) -> Point2 {
        let [u_0, v_0] = self.origin.map(Coordinate::from);
        // 24 fractional bits; displays show no more than that of 64 knots
        let along = |c: Coordinate, first: Coordinate| {
            Real::saturating_from_num(
                c.saturating_sub(first).clamp(Coordinate::ZERO, Coordinate::from_num(60)),
            )
        };
        let (x, y) = (along(u, u_0), along(v, v_0));
        const ACROSS: Real = Real::lit("0.866");
        const AHEAD: Real = Real::lit("0.36");
        let right = (x - y).saturating_mul(ACROSS);
        let up = (x / 2 + y / 2).saturating_mul(AHEAD) * 2;
        Point2::new(right, up.saturating_add(height))
    }
}

fn to(point: Point2, starts: bool) -> PathElement {
    if starts { PathElement::MoveTo(point) } else { PathElement::LineTo(point) }
}
