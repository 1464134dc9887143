//! `kind = "julia-set"`: the Julia set itself, a cloud of points found by backward iteration.

use std::convert::Infallible;
use std::io::Write;

use attractor::escape::{Complex, JuliaSet, SimpleCase};
use attractor::num::{Real, Wide};
use attractor::picture::{Point2, Step, Window};
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use toml::Spanned;

use super::chart::PAPER;
use super::density;
use super::ifs::density_color;
use super::plot::{Extent, inner, pitch};
use super::trail::Trail;
use super::{Request, Watch, draw_field};
use crate::cli::MAX_POINTS;
use crate::color::{Depth, ground};
use crate::fail::Fail;
use crate::number::exact;
use crate::palette::Named;
use crate::source::{Num, Source};
use crate::theory::Theory;

/// Points that show how large the set is.
const SCOUTS: usize = 1 << 14;
/// How often the pruned method goes on from a cell of the size of a pixel.
const HITS: u8 = 12;
/// The grid covers the square of side 4; finer than this it would only be larger.
const CELLS: i64 = 1 << 12;
/// The same where the set is measured.
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

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Method {
    /// A coin flip a point.
    Plain,
    /// The tree of all preimages without its crowded branches.
    Pruned,
}

/// A Julia set ready to be drawn.
#[derive(Debug)]
pub(super) struct JuliaSetScene {
    set: JuliaSet,
    method: Method,
    points: Option<u32>,
    palette: Named,
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
        Ok(Self {
            set,
            method: file.method.unwrap_or(Method::Pruned),
            points: points.transpose()?,
            palette: file.palette.unwrap_or(Named::Fire),
        })
    }

    /// What measurements need of it.
    pub(super) fn trail(&self) -> Trail<'_> {
        trail(self.set)
    }

    fn window(&self, request: &Request) -> Result<Window, Fail> {
        let scouts = self.set.seeded_backward_iteration(1).take(SCOUTS);
        let extent = Extent::of(scouts.map(Step::MoveTo))?;
        // the set is its own image under z -> -z; a scout may stop short of the farthest point
        let most = |a: Real, b: Real| a.abs().max(b.abs()).saturating_add(Real::lit("0.01"));
        let mut bounds = extent.bounds;
        let reach = Point2::new(most(bounds.min.x, bounds.max.x), most(bounds.min.y, bounds.max.y));
        (bounds.min, bounds.max) = (Point2::new(-reach.x, -reach.y), reach);
        Window::fit(bounds, inner(request.size).size).map_err(Fail::new)
    }

    /// The points for a display of this size, no more than `most`.
    fn found(&self, request: &Request, window: &Window, most: u32) -> Result<Vec<Point2>, Fail> {
        let most = most as usize;
        match self.method {
            Method::Plain => Ok(self.set.seeded_backward_iteration(request.seed).take(most).collect()),
            Method::Pruned => {
                let cells = ((4 << 24) / i64::from(pitch(window).to_bits().max(1))).clamp(1, CELLS);
                let side = cells as usize;
                let mut hits = vec![0; side * side];
                let points = self.set.pruned_iteration(side, HITS, &mut hits).map_err(Fail::new)?;
                Ok(points.take(most).collect())
            }
        }
    }

    /// As the scene says, else 8 a pixel.
    fn most(&self, size: Size) -> u32 {
        let pixels = size.width.saturating_mul(size.height).saturating_mul(8);
        self.points.unwrap_or(pixels.clamp(1, MAX_POINTS))
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let window = self.window(request)?;
        let points = self.found(request, &window, self.most(request.size))?;
        let margin = inner(request.size).top_left.x.unsigned_abs();
        let paper = ground::<D::Color>(PAPER);
        let color = |hits| density_color(self.palette, paper, density::level(hits));
        density::counted(points.into_iter(), window, request.size, margin, |framed| {
            draw_field(&framed, color, target, watch);
        })?;
        Ok(())
    }

    /// `x,y` of the first points.
    pub(super) fn sample(&self, request: &Request, points: u32, out: &mut dyn Write) -> Result<(), Fail> {
        let window = self.window(request)?;
        writeln!(out, "x,y")?;
        for p in self.found(request, &window, points)? {
            writeln!(out, "{},{}", exact(p.x), exact(p.y))?;
        }
        Ok(())
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
