//! `kind = "mandelbrot"`: the dwell of every pixel's orbit of 0.

use std::convert::Infallible;

use attractor::escape::Mandelbrot;
use attractor::num::Wide;
use attractor_gallery::Watch;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use toml::Spanned;

use super::coloring::{self, Coloring};
use super::deep::{self, Picture};
use super::escape::{self, Escape};
use super::keys::{Grey, Keys};
use super::motion::Motion;
use super::request::Request;
use crate::color::Depth;
use crate::fail::Fail;
use crate::palette::Named;
use crate::source::{Num, Source};
use crate::table::Csv;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    centre: Option<Spanned<[Num; 2]>>,
    width: Option<Num>,
    max_dwell: Option<Spanned<i64>>,
    palette: Option<Named>,
    #[serde(default)]
    lift: bool,
    cycle: Option<Spanned<i64>>,
    inside: Option<Spanned<String>>,
    grey: Option<Grey>,
    coloring: Option<Spanned<Coloring>>,
    #[serde(default)]
    equalised: bool,
}

/// A view of the set ready to be drawn.
#[derive(Debug)]
pub(crate) struct MandelbrotScene(pub(crate) Escape);

impl MandelbrotScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        /// The whole set, as core's `View::home`.
        const HOME: [Wide; 3] = [Wide::lit("-0.75"), Wide::lit("3"), Wide::lit("2.5")];
        let file: File = source.parse()?;
        let keys = Keys {
            centre: file.centre.as_ref(),
            width: file.width.as_ref(),
            max_dwell: file.max_dwell.as_ref(),
            palette: file.palette,
            lift: file.lift,
            cycle: file.cycle.as_ref(),
            inside: file.inside.as_ref(),
            grey: file.grey.as_ref(),
            coloring: file.coloring.as_ref(),
            equalised: file.equalised,
            goes_deep: true,
        };
        Ok(Self(Escape::load(source, &keys, HOME)?))
    }

    fn picture(&self, request: &Request) -> Result<Mandelbrot, Fail> {
        Mandelbrot::new(self.0.view(request.size)?, self.0.max_dwell).map_err(Fail::new)
    }

    /// Moves about on a display of this size; the message says why not.
    pub(super) fn go(&mut self, size: Size, motion: Motion) -> Result<(), Fail> {
        self.0.go(size, motion)
    }

    /// Where the viewer stands, as lines of a scene file.
    pub(super) fn place(&self, size: Size) -> Result<String, Fail> {
        self.0.place(size)
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let Escape { max_dwell, coloring, equalised, .. } = self.0;
        let colors = self.0.colors::<D::Color>();
        if let Some(view) = self.0.deep_view(request.size)? {
            let mut orbit = deep::orbit(&view, max_dwell);
            let picture = Picture::new(view, max_dwell, &mut orbit).map_err(Fail::new)?;
            return coloring::draw(picture, coloring, equalised, colors, target, watch);
        }
        coloring::draw(self.picture(request)?, coloring, equalised, colors, target, watch)
    }

    pub(super) fn sample(&self, request: &Request, out: &mut Csv) -> Result<(), Fail> {
        if let Some(view) = self.0.deep_view(request.size)? {
            let mut orbit = deep::orbit(&view, self.0.max_dwell);
            let picture = Picture::new(view, self.0.max_dwell, &mut orbit).map_err(Fail::new)?;
            return deep::sample(&picture, out);
        }
        let picture = self.picture(request)?;
        let reference = |re, im| attractor_reference::dwell((re, im), self.0.max_dwell);
        escape::sample(picture.view(), |c| picture.dwell_at(c).count, reference, out)
    }
}
