//! `kind = "copier"`: a polyline and its images under all compositions of the maps, order by order, as small
//! multiples on one picture.

use std::convert::Infallible;

use attractor::curve::koch;
use attractor::ifs::{Ifs, MAX_MAPS, catalogue};
use attractor::plane::Point2;
use attractor_gallery::{Copies, Watch};
use embedded_graphics::draw_target::DrawTarget;
use serde::Deserialize;
use toml::Spanned;

use super::curve::vertices;
use super::polyline::{self, Points};
use super::request::Request;
use super::system::{Maps, system};
use crate::cli::MAX_POINTS;
use crate::color::Depth;
use crate::fail::Fail;
use crate::palette::Named;
use crate::source::{Place, Source};
use crate::table::Csv;

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
pub(crate) struct CopierScene {
    /// The system, whose attractor the copies tend to.
    pub(crate) ifs: Box<Ifs<MAX_MAPS>>,
    pub(crate) shape: Vec<Point2>,
    pub(crate) orders: Vec<u32>,
    pub(crate) palette: Named,
    /// What is copied, or by which maps.
    place: Place,
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
        let place = match (&file.polyline, &file.maps, &file.attractor) {
            (Some(list), ..) => source.place(list.span(), "polyline"),
            (None, Some(maps), _) => source.place(maps.span(), "maps"),
            (None, None, name) => source.place(name.as_ref().map_or(0..0, Spanned::span), "attractor"),
        };
        let scene = Self { ifs, shape, orders, palette: file.palette.unwrap_or(Named::Even), place };
        scene.copies()?;
        Ok(scene)
    }

    fn copies(&self) -> Result<Copies<'_, MAX_MAPS, DEPTH>, Fail> {
        let copies = Copies::new(&self.ifs, &self.shape, &self.orders, self.palette);
        copies.map_err(|error| self.place.fail(error))
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let drawn = self.copies()?.draw(request.size, target, watch);
        drawn.map_err(|error| self.place.fail_at(request.size, error))
    }

    /// `x,y` of the first vertices of the last order.
    pub(super) fn sample(&self, points: u32, out: &mut Csv) -> Result<(), Fail> {
        let last = self.orders.last().copied().unwrap_or(0);
        let path = self.copies()?.path(last);
        vertices(path.map_err(|error| self.place.fail(error))?, points, out)
    }
}

fn named(source: &Source, name: &Spanned<String>) -> Result<Box<Ifs<MAX_MAPS>>, Fail> {
    let Some(attractor) = catalogue::find(name.get_ref()) else {
        let names: Vec<&str> = catalogue::ALL.iter().map(|attractor| attractor.name).collect();
        return Err(source.fail(name.span(), "attractor", format!("allowed is {}", names.join(", "))));
    };
    attractor.ifs().map(Box::new).map_err(|error| source.fail(name.span(), "attractor", error))
}

/// 0 to 6 unless said otherwise, or as many as there are points for.
fn orders(
    source: &Source,
    given: Option<&Spanned<Vec<Spanned<i64>>>>,
    maps: usize,
    vertices: usize,
) -> Result<Vec<u32>, Fail> {
    let points = |order: u32| (maps as u64).saturating_pow(order).saturating_mul(vertices.max(1) as u64);
    let fits = |order: &u32| points(*order) <= u64::from(MAX_POINTS);
    let most = (0..=DEPTH as u32).take_while(fits).last().unwrap_or(0);
    let Some(list) = given else { return Ok((0..=most.min(6)).collect()) };
    if list.get_ref().is_empty() || list.get_ref().len() > PANELS {
        let reason = format!("1 to {PANELS} orders are shown");
        return Err(source.fail(list.span(), "orders", reason));
    }
    let order = |(i, order): (usize, &Spanned<i64>)| match u32::try_from(*order.get_ref()) {
        Ok(n) if n <= most => Ok(n),
        _ => {
            let reason = format!("allowed is 0 to {most} for {maps} maps: at most {MAX_POINTS} points");
            Err(source.fail(order.span(), &format!("orders[{i}]"), reason))
        }
    };
    list.get_ref().iter().enumerate().map(order).collect()
}
