//! `kind = "random-curve"`: a curve through knots whose midpoints a law displaces at random; the seed repeats
//! it.

use std::convert::Infallible;

use attractor::Error;
use attractor::curve::{Stop, Subdivision, coast, koch};
use attractor::num::{Parameter, Real};
use attractor::plane::{PathElement, Point2};
use attractor_gallery::{Pencil, RandomCurvePicture, Watch, ground_words};
use embedded_graphics::draw_target::DrawTarget;
use serde::Deserialize;
use toml::Spanned;

use super::curve::vertices;
use super::law::{Law, Name, Parameters, Recipe, law};
use super::polyline::{self, Points};
use super::request::Request;
use super::trail::Trail;
use crate::color::Depth;
use crate::fail::Fail;
use crate::palette::Named;
use crate::source::{Num, Place, Source};
use crate::table::Csv;

/// The most halvings between two knots.
const LEVELS: usize = 20;
type Curve<'a> = Subdivision<'a, Law, LEVELS>;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    law: Spanned<Name>,
    knots: Option<Points>,
    coast: Option<Spanned<String>>,
    extrapolate: Option<Spanned<u32>>,
    beta: Option<Num>,
    deviation: Option<Num>,
    offset: Option<Num>,
    ratio: Option<Num>,
    #[serde(default)]
    seed: u64,
    length: Option<Num>,
    norm: Option<Num>,
    parameter: Option<Num>,
    palette: Option<Named>,
    fill: Option<bool>,
}

/// A curve ready to be drawn.
#[derive(Debug)]
pub(crate) struct RandomCurve {
    law: Law,
    pub(crate) recipe: Recipe,
    pub(crate) seed: u64,
    pub(crate) knots: Vec<Point2>,
    /// None: down to the length of a pixel.
    pub(crate) stop: Option<Stop>,
    pub(crate) filled: bool,
    pub(crate) pencil: Pencil,
    /// Where it stops, or its law.
    place: Place,
}

impl RandomCurve {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let (law, recipe) = law(
            source,
            &Parameters {
                law: *file.law.get_ref(),
                beta: file.beta.clone(),
                deviation: file.deviation.clone(),
                offset: file.offset.clone(),
                ratio: file.ratio.clone(),
                seed: file.seed,
            },
        )?;
        let mut knots = match (&file.knots, &file.coast) {
            (Some(list), None) => polyline::points(source, "knots", list)?,
            (None, Some(name)) if name.get_ref() == "iceland" => coast::ICELAND.to_vec(),
            (None, None) => koch::SEGMENT.to_vec(),
            (None, Some(name)) => return Err(source.fail(name.span(), "coast", "allowed is iceland")),
            (Some(_), Some(name)) => {
                return Err(source.fail(name.span(), "coast", "knots are given as well"));
            }
        };
        if let Some(times) = &file.extrapolate {
            extrapolate(source, times, &law, &mut knots)?;
        }
        let (stop, limit) = stop(source, &file)?;
        let scene = {
            let closed = knots.first() == knots.last();
            let is_graph = *file.law.get_ref() == Name::LineToLine;
            let place = match limit {
                Some((key, number)) => source.place(number.span(), key),
                None => source.place(file.law.span(), "law"),
            };
            let palette = file.palette.unwrap_or(Named::Ocean);
            let filled = file.fill.unwrap_or(closed || is_graph);
            let pencil = Pencil { palette, closed };
            Self { law, recipe, seed: file.seed, knots, stop, filled, pencil, place }
        };
        scene.curve(stop.unwrap_or(Stop::Length(Real::ONE))).map_err(|error| match (error, limit) {
            (Error::OutOfRange { .. } | Error::Capacity { .. }, Some((key, number))) => {
                source.fail(number.span(), key, error)
            }
            (Error::NotIncreasing { index, .. }, _) => {
                let span = file.knots.as_ref().and_then(|list| list.get_ref().get(index));
                source.fail(span.map_or(0..0, Spanned::span), &format!("knots[{index}]"), error)
            }
            _ => match &file.knots {
                Some(list) => source.fail(list.span(), "knots", error),
                None => source.fail_all("knots", error),
            },
        })?;
        Ok(scene)
    }

    fn curve(&self, stop: Stop) -> Result<Curve<'_>, Error> {
        Subdivision::new(&self.law, &self.knots, stop)
    }

    /// The law.
    pub(super) fn law(&self) -> &Law {
        &self.law
    }

    /// What measurements need of it, unless it is a graph.
    pub(super) fn trail(&self) -> Trail<'_> {
        // as often as the parameter allows: few parts need it
        let finer_than = |length: Real| {
            let curve = Subdivision::<_, 31>::new(&self.law, &self.knots, Stop::Length(length))?;
            Ok(Box::new(curve) as Box<dyn Iterator<Item = PathElement>>)
        };
        let theory = self.law.similarity();
        Trail { finer_than: Box::new(finer_than), theory, boundary: None, law: Some(&self.law) }
    }

    /// Whether it is the graph of a function.
    pub(crate) fn is_graph(&self) -> bool {
        matches!(self.law, Law::LineToLine(..))
    }

    fn picture(&self) -> RandomCurvePicture<'_, Law, LEVELS> {
        let Self { law, knots, stop, filled, pencil, .. } = self;
        RandomCurvePicture {
            law,
            graph: self.is_graph(),
            knots,
            stop: *stop,
            filled: *filled,
            pencil: *pencil,
        }
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        self.picture()
            .draw(request.size, target, &mut vec![0; ground_words(request.size)], watch)
            .map_err(|error| self.place.fail_at(request.size, error))
    }

    /// `x,y` of the first points.
    pub(super) fn sample(&self, request: &Request, points: u32, out: &mut Csv) -> Result<(), Fail> {
        let path = self.picture().path(request.size);
        vertices(path.map_err(|error| self.place.fail_at(request.size, error))?, points, out)
    }
}

/// Continues a curve by so many knots, figure 12: each makes the one before it a midpoint.
fn extrapolate(
    source: &Source,
    times: &Spanned<u32>,
    law: &Law,
    knots: &mut Vec<Point2>,
) -> Result<(), Fail> {
    let refused = |reason: String| source.fail(times.span(), "extrapolate", reason);
    if !(1..=16).contains(times.get_ref()) {
        return Err(refused("allowed is 1 to 16".to_owned()));
    }
    for _ in 0..*times.get_ref() {
        let [.., from, to] = knots.as_slice() else { return Ok(()) };
        let at = Parameter::saturating_from_num(knots.len() - 1);
        let knot = law
            .extrapolated(*from, *to, at)
            .ok_or_else(|| refused("an elbow depends on its level and has no next knot".to_owned()))?;
        knots.push(knot.map_err(|error| refused(error.to_string()))?);
    }
    Ok(())
}

type Limit<'a> = Option<(&'static str, &'a Num)>;

/// When to stop, and the key that says it.
fn stop<'a>(source: &Source, file: &'a File) -> Result<(Option<Stop>, Limit<'a>), Fail> {
    let given: Vec<(&str, &Num)> =
        [("length", &file.length), ("norm", &file.norm), ("parameter", &file.parameter)]
            .into_iter()
            .filter_map(|(key, number)| Some((key, number.as_ref()?)))
            .collect();
    match given.as_slice() {
        [] => Ok((None, None)),
        [(key, number)] => {
            let stop = match *key {
                "length" => Stop::Length(source.fixed(number, key)?),
                "norm" => Stop::Norm(source.fixed(number, key)?),
                _ => Stop::Parameter(source.fixed(number, key)?),
            };
            Ok((Some(stop), Some((key, number))))
        }
        [(first, _), (key, number), ..] => {
            Err(source.fail(number.span(), key, format!("`{first}` is given as well")))
        }
    }
}
