//! The chart of a function: margins, axes, the ground under the curve, the curve, its knots.

use core::ops::Range;

use attractor::Error;
use attractor::draw::{Level, Stroke, hex};
use attractor::fif::{Cell, Fif, Pyramid};
use attractor::num::{Real, Wide};
use attractor::plane::{Bounds2, Field, PathElement, Point2, Window};
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::Drawable;

use crate::depth::depth_for;
use crate::ink::{ground, solid};
use crate::named::Named;
use crate::nested::Nested;
use crate::page::{Display, PAPER, Watch, draw_field};
use crate::plot::{Plot, value};

/// A pyramid for the range of a function has about as many cells at its finest level: halves of halves, seven
/// times.
pub const CELLS_ACROSS: u32 = 128;

/// Axes and the lines through the knots.
const RULE: Rgb888 = hex(0x3a4260);
/// More knots than this are not marked.
const MARKED: usize = 16;
/// No address of a cell is followed further.
const LONGEST: u32 = 64;

/// Where a function is drawn.
#[derive(Debug)]
pub struct Chart<'a, const N: usize, const D: usize> {
    fif: &'a Fif<N, D>,
    nested: Nested,
    plot: Plot,
    /// Row of the axis in the plot.
    axis: i64,
    palette: Named,
    /// Where the lowest and the highest value lie, from left to right.
    extremes: [Point2; 2],
}

impl<'a, const N: usize, const D: usize> Chart<'a, N, D> {
    /// The chart of a function on all of `size`; below it the intervals of the maps of an address, the
    /// outermost first, at most 16 (figure 2). `cells` has room for a pyramid of the depth that
    /// [`CELLS_ACROSS`] takes; afterwards it is free again.
    ///
    /// # Errors
    /// [`Error::BufferLength`] with the cells needed, and what the function's range or the size may be wrong
    /// with.
    pub fn new(
        fif: &'a Fif<N, D>,
        size: Size,
        address: &[usize],
        palette: Named,
        cells: &mut [Cell],
    ) -> Result<Self, Error> {
        let nested = Nested::new(fif, address, size);
        let side = size.width.min(size.height);
        let margin = if side < 32 { 0 } else { (side / 16).max(3) };
        let inner = Size::new(
            size.width.saturating_sub(2 * margin).max(1),
            size.height.saturating_sub(2 * margin + nested.height()).max(1),
        );
        let ((min, max), extremes) = range(fif, cells)?;
        let bounds = Bounds2 { min: Point2::new(Real::ZERO, min), max: Point2::new(Real::ONE, max) };
        let window = Window::stretch(bounds, inner)?;
        let axis = window.raster(Point2::new(Real::ZERO, Real::ZERO.clamp(min, max))).1;
        let corner = Point::new(margin as i32, margin as i32);
        Ok(Self { fif, nested, plot: Plot { size, corner, window }, axis, palette, extremes })
    }

    /// Draws it. `columns` has room for a number for each column of the display.
    ///
    /// # Errors
    /// [`Error::BufferLength`] with the numbers needed.
    pub fn draw<T: Display>(
        &self,
        target: &mut T,
        columns: &mut [i32],
        watch: Watch<'_, T>,
    ) -> Result<(), Error> {
        let field = Ground::of(self, columns)?;
        let paper = ground::<T::Color>(PAPER);
        let palette = |value: Place| match value {
            Place::Paper => paper,
            Place::Rule => RULE,
            // the depth below the curve: bright close to it, dim further down
            Place::Under(level) => self.palette.at(Level::from_bits(8_000 + level.to_bits() / 4)),
        };
        if !draw_field(field, palette, target, watch) {
            return Ok(());
        }
        let Plot { size, corner, window } = self.plot;
        let line = solid::<T::Color>(self.palette.at(Level::from_bits(56_000)));
        let Ok(_) = Stroke::new(self.graph(window.size().width), window, line).at(corner).draw(target);
        if self.fif.maps() <= MARKED {
            let (from, to) = self.fif.domain();
            for knot in self.fif.knots() {
                let at = Point2::new(fraction(from, to, knot.x), Real::saturating_from_num(knot.y));
                self.plot.mark(at, target);
            }
        }
        self.nested.draw(self.fif, &self.plot, target);
        watch(target, size.height, size.height);
        Ok(())
    }

    /// The graph, eight points a column. A rough function reaches further within an eighth of a column than
    /// at any abscissa with the bits of a number: each point brings the extremes of its cell along, the
    /// images of those of the whole.
    fn graph(&self, columns: u32) -> impl Iterator<Item = PathElement> + Clone {
        let steps = columns.saturating_mul(8).max(1);
        let (from, to) = self.fif.domain();
        let width = i128::from(to.to_bits()) - i128::from(from.to_bits());
        let cell = Real::from_bits(((1_u32 << 24) / steps).max(1) as i32);
        (0..=steps).flat_map(move |i| {
            let offset = width * i128::from(i) / i128::from(steps);
            let x = Wide::from_bits((i128::from(from.to_bits()) + offset) as i64);
            let u = Real::from_bits(((u64::from(i) << 24) / u64::from(steps)) as i32);
            let point = Point2::new(u, self.fif.at(x));
            let composite = self.fif.composite_at(x, cell, LONGEST);
            let (left, right) = composite.interval();
            // an address too long to be followed: intervals hardly narrower than the domain
            let extremes =
                self.extremes.map(|p| if right - left <= cell { composite.image(p) } else { point });
            let first = if i == 0 { PathElement::MoveTo(point) } else { PathElement::LineTo(point) };
            [first, PathElement::LineTo(extremes[0]), PathElement::LineTo(extremes[1])]
        })
    }

    /// The columns of the knots, if they are marked; the others do not occur.
    fn knot_columns(&self) -> [i32; MARKED + 1] {
        let mut columns = [i32::MIN; MARKED + 1];
        if self.fif.maps() <= MARKED {
            let (from, to) = self.fif.domain();
            for (column, knot) in columns.iter_mut().zip(self.fif.knots()) {
                *column = self.plot.pixel(Point2::new(fraction(from, to, knot.x), Real::ZERO)).x;
            }
        }
        columns
    }
}

/// The smallest and largest values, rigorous and tight, with the axis if it is near; and where these values
/// lie, from left to right.
fn range<const N: usize, const D: usize>(
    fif: &Fif<N, D>,
    cells: &mut [Cell],
) -> Result<((Real, Real), [Point2; 2]), Error> {
    let depth = depth_for(fif.maps(), CELLS_ACROSS);
    let (given, needed) = (cells.len(), Pyramid::cells(fif.maps(), depth));
    let cells =
        cells.get_mut(..needed).ok_or(Error::BufferLength { what: "cells of the pyramid", given, needed })?;
    let pyramid = Pyramid::new(fif, depth, cells)?;
    let root = pyramid.root();
    let (mut min, mut max) = (root.min, root.max);
    let place = |has_it: &dyn Fn(&Cell) -> bool| {
        let index = pyramid.level(depth).iter().position(has_it).unwrap_or(0);
        let digit = |level: u32| (index / fif.maps().pow(level)) % fif.maps();
        let (left, right) = fif.composite((0..depth).rev().map(digit)).interval();
        left + (right - left) / 2
    };
    let mut extremes =
        [Point2::new(place(&|c| c.min == min), min), Point2::new(place(&|c| c.max == max), max)];
    extremes.sort_unstable_by_key(|p| p.x);
    let quarter = Real::from_bits(((i64::from(max.to_bits()) - i64::from(min.to_bits())) / 4) as i32);
    if min > 0 && min <= quarter {
        min = Real::ZERO;
    }
    if max < 0 && -max <= quarter {
        max = Real::ZERO;
    }
    if let Some(y) = constant(fif) {
        let around = (y.saturating_sub(Real::ONE), y.saturating_add(Real::ONE));
        return Ok((around, extremes.map(|p| Point2::new(p.x, y))));
    }
    if max.saturating_sub(min) < Real::DELTA * 16 {
        // a constant, whose bounds are rounded outward
        (min, max) = (min.saturating_sub(Real::ONE), max.saturating_add(Real::ONE));
    }
    Ok(((min, max), extremes))
}

/// The value of a function all of whose knots are at one height, joined by polynomials of degree 1 at most.
/// Its bounds are no narrower than what maps that hardly contract make of their rounding.
fn constant<const N: usize, const D: usize>(fif: &Fif<N, D>) -> Option<Real> {
    let first = fif.knots().next()?.y;
    let is_level = |y: Wide| y.saturating_sub(first).saturating_abs() <= Wide::DELTA * (1 << 12);
    let is_constant = fif.degree() <= 1 && fif.knots().all(|knot| is_level(knot.y));
    is_constant.then(|| Real::saturating_from_num(first))
}

/// Where an abscissa lies between the ends of the domain.
fn fraction(from: Wide, to: Wide, x: Wide) -> Real {
    let bits = |v: Wide| i128::from(v.to_bits());
    let width = (bits(to) - bits(from)).max(1);
    Real::from_bits((((bits(x) - bits(from)) << 24) / width) as i32)
}

/// What a pixel of the ground lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Paper,
    Rule,
    /// Between the curve and the axis: full at the curve, 0 at the axis.
    Under(Level),
}

/// The ground as a field: for each column the row of the curve.
struct Ground<'a, const N: usize, const D: usize> {
    chart: &'a Chart<'a, N, D>,
    /// Rows of the display, from the left edge of the plot.
    curve: &'a [i32],
    knots: [i32; MARKED + 1],
    /// The plot's last row.
    bottom: i32,
    /// Columns of the narrowest of the nested intervals.
    focus: Option<Range<i32>>,
}

impl<'a, const N: usize, const D: usize> Ground<'a, N, D> {
    fn of(chart: &'a Chart<'_, N, D>, rows: &'a mut [i32]) -> Result<Self, Error> {
        let Plot { corner, window, .. } = chart.plot;
        let columns = window.size().width;
        let (given, needed) = (rows.len(), columns as usize);
        let curve =
            rows.get_mut(..needed).ok_or(Error::BufferLength { what: "rows of the curve", given, needed })?;
        for (column, row) in (0..columns).zip(curve.iter_mut()) {
            let u = Real::from_bits(((u64::from(2 * column + 1) << 24) / u64::from(2 * columns)) as i32);
            *row = chart.plot.pixel(Point2::new(u, value(chart.fif, u))).y;
        }
        Ok(Self {
            chart,
            curve,
            knots: chart.knot_columns(),
            bottom: corner.y + window.size().height as i32 - 1,
            focus: chart.nested.focus(&chart.plot),
        })
    }

    fn place(&self, x: i32, y: i32) -> Place {
        let corner = self.chart.plot.corner;
        let Some(&curve) = usize::try_from(x - corner.x).ok().and_then(|column| self.curve.get(column))
        else {
            return Place::Paper;
        };
        let axis = corner.y + self.chart.axis as i32;
        if y < corner.y || y > self.bottom {
            return Place::Paper;
        }
        if y == axis {
            return Place::Rule;
        }
        if self.focus.as_ref().is_some_and(|focus| focus.contains(&x)) && y >= curve.min(axis) {
            return Place::Rule;
        }
        if (curve < y && y < axis) || (axis < y && y < curve) {
            let (depth, height) = (y.abs_diff(axis), curve.abs_diff(axis));
            return Place::Under(Level::ratio(depth, height));
        }
        // dotted lines through the knots
        if self.knots.contains(&x) && (y - corner.y) % 4 == 0 { Place::Rule } else { Place::Paper }
    }
}

impl<const N: usize, const D: usize> Field for Ground<'_, N, D> {
    type Value = Place;

    fn size(&self) -> Size {
        self.chart.plot.size
    }

    fn at(&self, x: u32, y: u32) -> Place {
        self.place(x as i32, y as i32)
    }
}
