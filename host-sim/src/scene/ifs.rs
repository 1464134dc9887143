//! `kind = "ifs"`: the attractor of affine maps by the chaos game.

use std::convert::Infallible;

use attractor::ifs::{Ifs, MAX_MAPS};
use attractor_gallery::{IfsPicture, Shading, Watch};
use embedded_graphics::draw_target::DrawTarget;
use serde::Deserialize;
use toml::Spanned;

use super::request::Request;
use super::system::{Maps, system};
use crate::cli::MAX_POINTS;
use crate::color::Depth;
use crate::fail::Fail;
use crate::number::exact;
use crate::palette::Named;
use crate::source::{Place, Source};
use crate::table::Csv;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    maps: Maps,
    points: Option<Spanned<u32>>,
    shading: Option<Shading>,
    palette: Option<Named>,
}

/// An attractor ready to be drawn.
#[derive(Debug)]
pub(crate) struct IfsScene {
    pub(crate) ifs: Box<Ifs<MAX_MAPS>>,
    pub(crate) points: Option<u32>,
    pub(crate) shading: Shading,
    pub(crate) palette: Named,
    /// Its maps.
    place: Place,
}

impl IfsScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let ifs = system(source, &file.maps)?;
        let points = file.points.map(|points| match *points.get_ref() {
            n @ 1..=MAX_POINTS => Ok(n),
            _ => Err(source.fail(points.span(), "points", format!("allowed is 1 to {MAX_POINTS}"))),
        });
        Ok(Self {
            ifs,
            points: points.transpose()?,
            shading: file.shading.unwrap_or(Shading::Maps),
            palette: file.palette.unwrap_or(Named::Even),
            place: source.place(file.maps.span(), "maps"),
        })
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let (ifs, points, shading, palette) = (&*self.ifs, self.points, self.shading, self.palette);
        let mut counts = match shading {
            Shading::Density => vec![0; (request.size.width * request.size.height) as usize],
            Shading::Maps | Shading::Plain => Vec::new(),
        };
        IfsPicture { ifs, points, shading, palette }
            .draw((request.size, request.seed), target, &mut counts, watch)
            .map_err(|error| self.place.fail_at(request.size, error))
    }

    /// `x,y` of the first points of the chaos game.
    pub(super) fn sample(&self, request: &Request, points: u32, out: &mut Csv) -> Result<(), Fail> {
        out.write_record(["x", "y"])?;
        for p in self.ifs.seeded_chaos_game(request.seed).take(points as usize) {
            out.write_record([exact(p.x), exact(p.y)])?;
        }
        Ok(())
    }
}
