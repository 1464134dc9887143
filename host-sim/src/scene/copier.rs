//! `kind = "copier"`: a polyline and its images under all compositions of the maps, order by order, as small multiples on one picture.

use std::convert::Infallible;
use std::io::Write;

use attractor::curve::koch;
use attractor::ifs::{CopiedPath, Ifs, MAX_MAPS, catalogue};
use attractor::picture::{Bounds2, Point2, Window};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;
use serde::Deserialize;
use toml::Spanned;

use super::curve::vertices;
use super::plot::{Extent, Pencil, inner};
use super::polyline::{self, Points};
use super::system::{Maps, system};
use super::{Request, Watch};
use crate::cli::MAX_POINTS;
use crate::color::Depth;
use crate::fail::Fail;
use crate::palette::Named;
use crate::source::Source;

/// Room for orders.
const DEPTH: usize = 24;
/// The most pictures on one.
const PANELS: usize = 16;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    maps: Option<Maps>,
    attractor: Option<Spanned<String>>,
    polyline: Option<Points>,
    orders: Option<Spanned<Vec<Spanned<i64>>>>,
    palette: Option<Named>,
}

/// A row of copies ready to be drawn.
#[derive(Debug)]
pub(super) struct CopierScene {
    ifs: Box<Ifs<MAX_MAPS>>,
    shape: Vec<Point2>,
    orders: Vec<u32>,
    /// What all orders take: one scale for all, so that convergence shows.
    room: Bounds2,
    palette: Named,
}

impl CopierScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let ifs = match (&file.maps, &file.attractor) {
            (Some(maps), None) => system(source, maps)?,
            (None, Some(name)) => named(source, name)?,
            _ => return Err(source.fail_all("maps", "either maps or the name of an attractor is needed")),
        };
        let shape = match &file.polyline {
            Some(list) => polyline::points(source, "polyline", list)?,
            None => koch::SEGMENT.to_vec(),
        };
        let orders = orders(source, file.orders.as_ref(), ifs.maps().len(), shape.len())?;
        let palette = file.palette.unwrap_or(Named::Even);
        let mut scene = Self {
            ifs,
            shape,
            orders,
            room: Bounds2 { min: Point2::default(), max: Point2::default() },
            palette,
        };
        let mut extent: Option<Extent> = None;
        for order in &scene.orders {
            let path = scene.path(*order).map_err(|fail| match (&file.polyline, fail) {
                (Some(list), Fail::Message(reason)) => source.fail(list.span(), "polyline", reason),
                (_, fail) => fail,
            })?;
            let this = Extent::of(path)?;
            extent = Some(extent.map_or(this, |before| before.with(this)));
        }
        if let Some(extent) = extent {
            scene.room = extent.room();
        }
        Ok(scene)
    }

    /// The system, whose attractor the copies tend to.
    pub(super) fn ifs(&self) -> &Ifs<MAX_MAPS> {
        &self.ifs
    }

    fn path(&self, order: u32) -> Result<CopiedPath<'_, MAX_MAPS, DEPTH>, Fail> {
        Ok(self.ifs.copier(&self.shape, order).map_err(Fail::new)?.path())
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        Pencil::paper(request.size, target);
        let pencil = Pencil { palette: self.palette, closed: false };
        let panels = panels(inner(request.size), self.orders.len() as u32, &self.room);
        let all = self.orders.len() as u32;
        for (done, (order, panel)) in (1..).zip(self.orders.iter().zip(panels)) {
            let window = Window::fit(self.room, panel.size).map_err(Fail::new)?;
            let points = Extent::of(self.path(*order)?)?.points;
            let part = &mut |target: &mut D, _, _| watch(target, done, all);
            if !pencil.line(self.path(*order)?, points, (window, panel.top_left), target, part) {
                break;
            }
        }
        Ok(())
    }

    /// `x,y` of the first vertices of the last order.
    pub(super) fn sample(&self, points: u32, out: &mut dyn Write) -> Result<(), Fail> {
        vertices(self.path(self.orders.last().copied().unwrap_or(0))?, points, out)
    }
}

fn named(source: &Source, name: &Spanned<String>) -> Result<Box<Ifs<MAX_MAPS>>, Fail> {
    let Some(attractor) = catalogue::find(name.get_ref()) else {
        let names: Vec<&str> = catalogue::ALL.iter().map(|attractor| attractor.name).collect();
        return Err(source.fail(name.span(), "attractor", format!("allowed is {}", names.join(", "))));
    };
    attractor.ifs().map(Box::new).map_err(|error| source.fail(name.span(), "attractor", error))
}

/// 0 to 6 unless said otherwise.
fn orders(
    source: &Source,
    given: Option<&Spanned<Vec<Spanned<i64>>>>,
    maps: usize,
    vertices: usize,
) -> Result<Vec<u32>, Fail> {
    let Some(list) = given else { return Ok((0..=6).collect()) };
    if list.get_ref().is_empty() || list.get_ref().len() > PANELS {
        let reason = format!("1 to {PANELS} orders are shown");
        return Err(source.fail(list.span(), "orders", reason));
    }
    let points = |order: u32| (maps as u64).saturating_pow(order).saturating_mul(vertices.max(1) as u64);
    let fits = |order: &u32| points(*order) <= u64::from(MAX_POINTS);
    let most = (0..=DEPTH as u32).take_while(fits).last().unwrap_or(0);
    let order = |(i, order): (usize, &Spanned<i64>)| match u32::try_from(*order.get_ref()) {
        Ok(n) if n <= most => Ok(n),
        _ => {
            let reason = format!("allowed is 0 to {most} for {maps} maps: at most {MAX_POINTS} points");
            Err(source.fail(order.span(), &format!("orders[{i}]"), reason))
        }
    };
    list.get_ref().iter().enumerate().map(order).collect()
}

/// As many equal rectangles as large as possible for this shape; the last row in the middle.
fn panels(area: Rectangle, count: u32, room: &Bounds2) -> Vec<Rectangle> {
    let (width, height) = (area.size.width, area.size.height);
    let gap = width.min(height) / 24;
    let side = |whole: u32, parts: u32| (whole.saturating_sub(gap * (parts - 1)) / parts).max(1);
    let cell = |columns: u32| Size::new(side(width, columns), side(height, count.div_ceil(columns)));
    let extent = |min: attractor::num::Real, max: attractor::num::Real| {
        (i64::from(max.to_bits()) - i64::from(min.to_bits())).max(1)
    };
    let (x, y) = (extent(room.min.x, room.max.x), extent(room.min.y, room.max.y));
    // pixels a unit, times 2^56
    let scale = |columns: &u32| {
        let cell = cell(*columns);
        let pixels = |side: u32, extent: i64| (i128::from(side) << 56) / i128::from(extent);
        pixels(cell.width, x).min(pixels(cell.height, y))
    };
    // of equals the first
    let columns = (1..=count).rev().max_by_key(scale).unwrap_or(1);
    let (cell, rows) = (cell(columns), count.div_ceil(columns));
    let used = |side: u32, parts: u32| side * parts + gap * (parts - 1);
    let top = height.saturating_sub(used(cell.height, rows)) / 2;
    let place = |i: u32| {
        let (row, column) = (i / columns, i % columns);
        let in_row = columns.min(count - row * columns);
        let left = width.saturating_sub(used(cell.width, in_row)) / 2;
        let offset =
            Point::new((left + column * (cell.width + gap)) as i32, (top + row * (cell.height + gap)) as i32);
        Rectangle::new(area.top_left + offset, cell)
    };
    (0..count).map(place).collect()
}
