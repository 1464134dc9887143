//! The chart of a function: margins, axes, the ground under the curve, the curve, its knots.

use std::convert::Infallible;
use std::ops::Range;

use attractor::draw::{Level, Stroke, hex};
use attractor::fif::{Cell, Pyramid};
use attractor::num::{Real, Wide};
use attractor::picture::{Bounds2, Field, Point2, Window};
use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::Drawable;

use super::function::{Fixed, depth_for};
use super::nested::Nested;
use super::{Watch, draw_field};
use crate::color::{Depth, ground, solid};
use crate::fail::Fail;
use crate::palette::Named;

/// The ground of every chart.
pub(super) const PAPER: Rgb888 = hex(0x0b0e1a);
/// Axes and the lines through the knots.
const RULE: Rgb888 = hex(0x3a4260);
/// Knots and other marks.
pub(super) const MARK: Rgb888 = hex(0xffb454);
/// More knots than this are not marked.
const MARKED: usize = 16;

/// Where a function is drawn.
#[derive(Debug)]
pub(super) struct Chart<'a> {
    fif: &'a Fixed,
    size: Size,
    /// Left and top of the plot.
    pub(super) corner: Point,
    pub(super) window: Window,
    /// Row of the axis in the plot.
    axis: i64,
    palette: Named,
}

impl<'a> Chart<'a> {
    /// A chart on all of `size` but `below` rows at the bottom.
    pub(super) fn new(fif: &'a Fixed, size: Size, below: u32, palette: Named) -> Result<Self, Fail> {
        let side = size.width.min(size.height);
        let margin = if side < 32 { 0 } else { (side / 16).max(3) };
        let inner = Size::new(
            size.width.saturating_sub(2 * margin).max(1),
            size.height.saturating_sub(2 * margin + below).max(1),
        );
        let (min, max) = range(fif)?;
        let bounds = Bounds2 { min: Point2::new(Real::ZERO, min), max: Point2::new(Real::ONE, max) };
        let window = Window::stretch(bounds, inner).map_err(Fail::new)?;
        let axis = window.raster(Point2::new(Real::ZERO, Real::ZERO.clamp(min, max))).1;
        let corner = Point::new(margin as i32, margin as i32);
        Ok(Self { fif, size, corner, window, axis, palette })
    }

    /// Draws it; whether it was finished.
    pub(super) fn draw<D>(&self, target: &mut D, watch: Watch<'_, D>, nested: &Nested) -> bool
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let field = Ground::of(self, nested);
        let paper = ground::<D::Color>(PAPER);
        let palette = |value: Place| match value {
            Place::Paper => paper,
            Place::Rule => RULE,
            // the depth below the curve: bright close to it, dim further down
            Place::Under(level) => self.palette.at(Level(8_000 + level.0 / 4)),
        };
        if !draw_field(field, palette, target, watch) {
            return false;
        }
        let inner = self.window.size();
        let line = solid::<D::Color>(self.palette.at(Level(56_000)));
        let graph = self.fif.graph(inner.width.saturating_mul(8));
        let Ok(_) = Stroke::new(graph, self.window, line).at(self.corner).draw(target);
        if self.fif.maps() <= MARKED {
            let (from, to) = self.fif.domain();
            for knot in self.fif.knots() {
                let at = Point2::new(fraction(from, to, knot.x), Real::saturating_from_num(knot.y));
                self.mark(at, target);
            }
        }
        true
    }

    /// The pixel that shows a point with a unit abscissa.
    pub(super) fn pixel(&self, at: Point2) -> Point {
        let (column, row) = self.window.raster(at);
        let size = self.window.size();
        let inside = |v: i64, side: u32| v.clamp(0, i64::from(side) - 1) as i32;
        self.corner + Point::new(inside(column, size.width), inside(row, size.height))
    }

    /// A dot of 3 x 3 pixels, of 5 x 5 on a large display.
    pub(super) fn mark<D>(&self, at: Point2, target: &mut D)
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let centre = self.pixel(at);
        let reach = if self.size.width.min(self.size.height) < 200 { 1 } else { 2 };
        let color = solid::<D::Color>(MARK);
        let dots = (-reach..=reach).flat_map(|y| (-reach..=reach).map(move |x| Point::new(x, y)));
        // without its corners, so that it looks round
        let dots = dots.filter(|p| reach == 1 || p.x.abs() + p.y.abs() <= 3);
        let Ok(()) = target.draw_iter(dots.map(|p| Pixel(centre + p, color)));
    }

    /// The curve at a unit abscissa.
    pub(super) fn value(&self, u: Real) -> Real {
        let (from, to) = self.fif.domain();
        let width = i128::from(to.to_bits()) - i128::from(from.to_bits());
        let offset = (width * i128::from(u.to_bits())) >> 24;
        self.fif.at(Wide::from_bits((i128::from(from.to_bits()) + offset) as i64))
    }

    fn knot_columns(&self) -> Vec<i32> {
        let (from, to) = self.fif.domain();
        let column = |x: Wide| self.pixel(Point2::new(fraction(from, to, x), Real::ZERO)).x;
        if self.fif.maps() <= MARKED { self.fif.knots().map(|k| column(k.x)).collect() } else { Vec::new() }
    }
}

/// The smallest and largest values, rigorous and tight, with the axis if it is near.
fn range(fif: &Fixed) -> Result<(Real, Real), Fail> {
    let depth = depth_for(fif.maps(), 4096);
    let mut cells = vec![Cell::ZERO; Pyramid::cells(fif.maps(), depth)];
    let root = Pyramid::new(fif, depth, &mut cells).map_err(Fail::new)?.root();
    let (mut min, mut max) = (root.min, root.max);
    let quarter = Real::from_bits(((i64::from(max.to_bits()) - i64::from(min.to_bits())) / 4) as i32);
    if min > 0 && min <= quarter {
        min = Real::ZERO;
    }
    if max < 0 && -max <= quarter {
        max = Real::ZERO;
    }
    if max.saturating_sub(min) < Real::DELTA * 16 {
        // a constant, whose bounds are rounded outward
        (min, max) = (min.saturating_sub(Real::ONE), max.saturating_add(Real::ONE));
    }
    Ok((min, max))
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
struct Ground<'a> {
    chart: &'a Chart<'a>,
    /// Rows of the display, from the left edge of the plot.
    curve: Vec<i32>,
    knots: Vec<i32>,
    /// The plot's last row.
    bottom: i32,
    /// Columns of the narrowest of the nested intervals.
    focus: Option<Range<i32>>,
}

impl<'a> Ground<'a> {
    fn of(chart: &'a Chart<'a>, nested: &Nested) -> Self {
        let columns = chart.window.size().width;
        let row = |column: u32| {
            let u = Real::from_bits(((u64::from(2 * column + 1) << 24) / u64::from(2 * columns)) as i32);
            chart.pixel(Point2::new(u, chart.value(u))).y
        };
        Self {
            chart,
            curve: (0..columns).map(row).collect(),
            knots: chart.knot_columns(),
            bottom: chart.corner.y + chart.window.size().height as i32 - 1,
            focus: nested.focus(chart),
        }
    }

    fn at(&self, x: i32, y: i32) -> Place {
        let corner = self.chart.corner;
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

impl Field for Ground<'_> {
    type Value = Place;
    type Row<'b>
        = Box<dyn Iterator<Item = Place> + 'b>
    where
        Self: 'b;

    fn size(&self) -> Size {
        self.chart.size
    }

    fn row(&self, y: u32, x: Range<u32>) -> Self::Row<'_> {
        Box::new(x.map(move |x| self.at(x as i32, y as i32)))
    }
}
