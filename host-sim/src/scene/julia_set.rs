//! `kind = "julia-set"`: the Julia set itself, covered or as a cloud of points found by backward iteration.

use std::convert::Infallible;

use attractor::escape::JuliaSet;
use attractor::num::Complex;
use attractor::num::Wide;
use attractor::plane::Field as _;
use attractor_gallery::{JuliaSetPicture, Method, Watch};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use toml::Spanned;

use super::request::Request;
use crate::cli::MAX_POINTS;
use crate::color::Depth;
use crate::fail::Fail;
use crate::number::exact;
use crate::palette::Named;
use crate::source::{Num, Place, Source};
use crate::table::Csv;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    c: Spanned<[Num; 2]>,
    points: Option<Spanned<u32>>,
    method: Option<Method>,
    palette: Option<Named>,
}

/// A Julia set ready to be drawn.
#[derive(Debug)]
pub(crate) struct JuliaSetScene {
    pub(crate) c: Complex<Wide>,
    pub(crate) picture: JuliaSetPicture,
    /// Its constant.
    place: Place,
}

impl JuliaSetScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let [re, im] = source.pair::<Wide>(file.c.get_ref(), "c")?;
        let c = Complex::new(re, im);
        let set = JuliaSet::new(c).map_err(|error| source.fail(file.c.span(), "c", error))?;
        let method = file.method.unwrap_or(Method::Cover);
        let points = file.points.map(|points| match (method, *points.get_ref()) {
            (Method::Cover, _) => {
                let reason = "a cover has no points: leave it out, or say method = \"plain\"";
                Err(source.fail(points.span(), "points", reason))
            }
            (Method::Plain, n @ 1..=MAX_POINTS) => Ok(n),
            _ => Err(source.fail(points.span(), "points", format!("allowed is 1 to {MAX_POINTS}"))),
        });
        let palette = file.palette.unwrap_or(Named::Fire);
        let picture = JuliaSetPicture { set, method, points: points.transpose()?, palette };
        Ok(Self { c, picture, place: source.place(file.c.span(), "c") })
    }

    /// What measurements need of it.
    pub(super) fn set(&self) -> JuliaSet {
        self.picture.set
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let size = request.size;
        let mut counts = vec![0; (size.width * size.height) as usize];
        self.picture
            .draw((size, request.seed), target, &mut counts, watch)
            .map_err(|error| self.place.fail_at(size, error))
    }

    /// `x,y` of the first points, or of the middles of the first pixels that the set meets.
    pub(super) fn sample(&self, request: &Request, points: u32, out: &mut Csv) -> Result<(), Fail> {
        out.write_record(["x", "y"])?;
        match self.picture.method {
            Method::Plain => {
                for p in self.picture.walk(request.seed).take(points as usize) {
                    out.write_record([exact(p.x), exact(p.y)])?;
                }
            }
            Method::Cover => {
                let (view, cover) = self
                    .picture
                    .cover(request.size)
                    .map_err(|error| self.place.fail_at(request.size, error))?;
                let Size { width, height } = view.size();
                let pixels =
                    (0..height).flat_map(|y| cover.row(y, 0..width).zip(0..).map(move |(n, x)| (n, x, y)));
                for (_, x, y) in pixels.filter(|(n, ..)| *n > 0).take(points as usize) {
                    let p = view.point(x, y);
                    out.write_record([exact(p.re), exact(p.im)])?;
                }
            }
        }
        Ok(())
    }
}
