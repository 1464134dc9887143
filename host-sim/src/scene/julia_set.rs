//! `kind = "julia-set"`: the Julia set itself, a cloud of points found by backward iteration.

use std::convert::Infallible;
use std::io::Write;

use attractor::escape::{Complex, JuliaSet, SimpleCase};
use attractor::num::{Real, Wide};
use attractor::picture::{Point2, Step, Window};
use attractor_gallery::{JuliaSetPicture, Method};
use embedded_graphics::draw_target::DrawTarget;
use serde::Deserialize;
use toml::Spanned;

use super::trail::Trail;
use super::{Request, Watch};
use crate::cli::MAX_POINTS;
use crate::color::Depth;
use crate::fail::Fail;
use crate::number::exact;
use crate::palette::Named;
use crate::source::{Num, Place, Source};
use crate::theory::Theory;

/// How often the pruned method goes on from a cell where the set is measured.
const HITS: u8 = 12;
/// The finest grid then.
const FINEST: i64 = 1 << 13;

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
pub(super) struct JuliaSetScene {
    picture: JuliaSetPicture,
    /// Its constant.
    place: Place,
}

impl JuliaSetScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let [re, im] = source.pair::<Wide>(file.c.get_ref(), "c")?;
        let set = JuliaSet::new(Complex::new(re, im)).map_err(|e| source.fail(file.c.span(), "c", e))?;
        let points = file.points.map(|points| match *points.get_ref() {
            n @ 1..=MAX_POINTS => Ok(n),
            _ => Err(source.fail(points.span(), "points", format!("allowed is 1 to {MAX_POINTS}"))),
        });
        let (method, palette) = (file.method.unwrap_or(Method::Pruned), file.palette.unwrap_or(Named::Fire));
        let picture = JuliaSetPicture { set, method, points: points.transpose()?, palette };
        Ok(Self { picture, place: source.place(file.c.span(), "c") })
    }

    /// What measurements need of it.
    pub(super) fn trail(&self) -> Trail<'_> {
        trail(self.picture.set)
    }

    /// The grid of the pruned method.
    fn hits(&self, window: &Window) -> Vec<u8> {
        vec![0; self.picture.grid(window).pow(2)]
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let size = request.size;
        let fail = |error| self.place.fail_at(size, error);
        let mut hits = self.hits(&self.picture.window(size).map_err(fail)?);
        let mut counts = vec![0; (size.width * size.height) as usize];
        self.picture.draw((size, request.seed), target, (&mut counts, &mut hits), watch).map_err(fail)
    }

    /// `x,y` of the first points.
    pub(super) fn sample(&self, request: &Request, points: u32, out: &mut dyn Write) -> Result<(), Fail> {
        let fail = |error| self.place.fail_at(request.size, error);
        let window = self.picture.window(request.size).map_err(fail)?;
        writeln!(out, "x,y")?;
        let print = |found: &mut dyn Iterator<Item = Point2>| -> Result<(), Fail> {
            for p in found {
                writeln!(out, "{},{}", exact(p.x), exact(p.y))?;
            }
            Ok(())
        };
        self.picture.found((&window, request.seed, points), &mut self.hits(&window), print).map_err(fail)?
    }
}

/// The points of a Julia set as measurements need them: one in each cell of a grid that the pruned iteration reaches.
pub(super) fn trail<'a>(set: JuliaSet) -> Trail<'a> {
    let finer_than = move |length: Real| {
        let cells = ((4 << 24) / i64::from(length.to_bits().max(1))).clamp(1, FINEST);
        let side = cells as usize;
        let mut hits = vec![0; side * side];
        let points: Vec<Point2> = set.pruned_iteration(side, HITS, &mut hits)?.collect();
        Ok(Box::new(points.into_iter().map(Step::MoveTo)) as Box<dyn Iterator<Item = Step>>)
    };
    let theory = match set.simple_case() {
        Some(SimpleCase::UnitCircle) => Some(Theory::new(1.0, "the unit circle")),
        Some(SimpleCase::Segment) => Some(Theory::new(1.0, "the segment from -2 to 2")),
        None => None,
    };
    Trail { finer_than: Box::new(finer_than), theory, boundary: None, law: None }
}
