//! `kind = "julia"`: the dwell of every pixel's own orbit, one constant for all.

use std::convert::Infallible;

use attractor::escape::{Julia, JuliaSet};
use attractor::num::Complex;
use attractor::num::Wide;
use attractor_gallery::Watch;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use toml::Spanned;

use super::coloring::{self, Coloring};
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
    c: Spanned<[Num; 2]>,
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

/// A view of a filled-in Julia set ready to be drawn.
#[derive(Debug)]
pub(crate) struct JuliaScene {
    pub(crate) escape: Escape,
    pub(crate) c: Complex<Wide>,
    /// The same in `f64`, for the reference.
    float: (f64, f64),
}

impl JuliaScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
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
            goes_deep: false,
        };
        let [re, im] = source.pair(file.c.get_ref(), "c")?;
        let c = Complex::new(re, im);
        // the kernel says which constants it takes
        let set = JuliaSet::new(c).map_err(|error| source.fail(file.c.span(), "c", error))?;
        let across = set.radius() * 2;
        let float = (re.to_num(), im.to_num());
        Ok(Self { escape: Escape::load(source, &keys, [Wide::ZERO, across, across])?, c, float })
    }

    /// What measurements need of it: its boundary, the Julia set itself, whatever part of it is in view.
    pub(super) fn set(&self) -> Result<JuliaSet, Fail> {
        JuliaSet::new(self.c).map_err(Fail::new)
    }

    fn picture(&self, request: &Request) -> Result<Julia, Fail> {
        Julia::new(self.escape.view(request.size)?, self.c, self.escape.max_dwell).map_err(Fail::new)
    }

    /// Moves about on a display of this size; the message says why not.
    pub(super) fn go(&mut self, size: Size, motion: Motion) -> Result<(), Fail> {
        self.escape.go(size, motion)
    }

    /// Where the viewer stands, as lines of a scene file.
    pub(super) fn place(&self, size: Size) -> Result<String, Fail> {
        self.escape.place(size)
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let Escape { coloring, equalised, .. } = self.escape;
        let colors = self.escape.colors::<D::Color>();
        coloring::draw(self.picture(request)?, coloring, equalised, colors, target, watch)
    }

    pub(super) fn sample(&self, request: &Request, out: &mut Csv) -> Result<(), Fail> {
        let picture = self.picture(request)?;
        let reference =
            |re, im| attractor_reference::julia_dwell((re, im), self.float, self.escape.max_dwell);
        escape::sample(picture.view(), |s| picture.dwell_at(s).count, reference, out)
    }
}
