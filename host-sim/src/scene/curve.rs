//! `kind = "curve"`: a polyline each of whose segments is replaced by the generator, again and again.

use std::convert::Infallible;

use attractor::Error;
use attractor::curve::catalogue::{self, Curve};
use attractor::curve::{Generator, Refined, koch};
use attractor::num::{Angle, Real, Wide};
use attractor::plane::{PathElement, Point2};
use attractor_gallery::{CurvePicture, Pencil, Watch, ground_words};
use embedded_graphics::draw_target::DrawTarget;
use serde::Deserialize;
use toml::Spanned;

use super::polyline::{self, Points};
use super::request::Request;
use super::trail::Trail;
use crate::cli::MAX_POINTS;
use crate::color::Depth;
use crate::fail::Fail;
use crate::number::exact;
use crate::palette::Named;
use crate::source::{Num, Place, Source};
use crate::table::Csv;
use crate::theory::{Theory, boundary_of};

/// Room for segments of a generator and for orders.
const SEGMENTS: usize = 64;
const DEPTH: usize = 32;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    curve: Option<Spanned<String>>,
    generator: Option<Points>,
    turtle: Option<Spanned<String>>,
    angle: Option<Num>,
    order: Option<Spanned<i64>>,
    adaptive: Option<Spanned<bool>>,
    base: Option<Points>,
    palette: Option<Named>,
    fill: Option<bool>,
}

/// A curve ready to be drawn.
#[derive(Debug)]
pub(crate) struct CurveScene {
    pub(crate) generator: Box<Generator<SEGMENTS>>,
    pub(crate) origin: Origin,
    pub(crate) base: Vec<Point2>,
    /// None: down to the length of a pixel.
    pub(crate) order: Option<u32>,
    pub(crate) filled: bool,
    pub(crate) pencil: Pencil,
    /// What decides how far it is refined.
    place: Place,
}

/// What a generator is made of.
#[derive(Debug)]
pub(crate) enum Origin {
    Named(&'static Curve),
    Polyline(Vec<[Wide; 2]>),
    Turtle(String, Angle),
}

impl CurveScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let (generator, origin) = generator(source, &file)?;
        let closed = matches!(origin, Origin::Named(curve) if curve.closed);
        let base = match &file.base {
            Some(list) => polyline::points(source, "base", list)?,
            None if closed => koch::triangle(Point2::default(), Real::ONE).to_vec(),
            None => koch::SEGMENT.to_vec(),
        };
        let is_adaptive = file.adaptive.as_ref().is_some_and(|a| *a.get_ref());
        let order = match (&file.order, &file.adaptive) {
            (Some(_), Some(adaptive)) if is_adaptive => {
                return Err(source.fail(adaptive.span(), "adaptive", "an order is given as well"));
            }
            (Some(order), _) => Some(checked_order(source, order, &generator, &base)?),
            (None, _) if is_adaptive => None,
            (None, _) => return Err(source.fail_all("order", "missing, or adaptive = true")),
        };
        let place = match (&file.order, &file.adaptive) {
            (Some(order), _) => source.place(order.span(), "order"),
            (None, adaptive) => source.place(adaptive.as_ref().map_or(0..0, Spanned::span), "adaptive"),
        };
        let closed = base.first() == base.last();
        let scene = Self {
            generator: Box::new(generator),
            origin,
            base,
            order,
            filled: file.fill.unwrap_or(closed),
            pencil: Pencil { palette: file.palette.unwrap_or(Named::Ocean), closed },
            place,
        };
        // what the kernel says against the base
        scene.refined(scene.order.unwrap_or(0)).map_err(|error| match &file.base {
            Some(list) => source.fail(list.span(), "base", error),
            None => source.fail_all("base", error),
        })?;
        Ok(scene)
    }

    fn refined(&self, order: u32) -> Result<Refined<'_, SEGMENTS, DEPTH>, Error> {
        self.generator.refined(&self.base, order)
    }

    /// What measurements need of it: the curve that the refinements tend to, whatever order is drawn.
    pub(super) fn trail(&self) -> Trail<'_> {
        let finer_than = |length: Real| {
            let path = self.generator.refined_to::<DEPTH>(&self.base, length)?;
            Ok(Box::new(path) as Box<dyn Iterator<Item = PathElement>>)
        };
        let theory = Theory::new(
            self.generator.dimension().to_num(),
            "similarity dimension of the generator: sum r_j^D = 1, unless copies overlap",
        );
        let named = catalogue::ALL.iter().find(|curve| curve.generator().as_ref() == Ok(&*self.generator));
        let boundary = named.and_then(|curve| boundary_of(curve.name));
        Trail { finer_than: Box::new(finer_than), theory: Some(theory), boundary, law: None }
    }

    fn picture(&self) -> CurvePicture<'_, SEGMENTS, DEPTH> {
        let Self { generator, base, order, filled, pencil, .. } = self;
        CurvePicture { generator, base, order: *order, filled: *filled, pencil: *pencil }
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

    /// `x,y` of the first vertices.
    pub(super) fn sample(&self, request: &Request, points: u32, out: &mut Csv) -> Result<(), Fail> {
        let path = self.picture().path(request.size);
        vertices(path.map_err(|error| self.place.fail_at(request.size, error))?, points, out)
    }
}

/// `x,y` of the first points of a path.
pub(super) fn vertices(
    path: impl Iterator<Item = PathElement>,
    points: u32,
    out: &mut Csv,
) -> Result<(), Fail> {
    out.write_record(["x", "y"])?;
    for PathElement::MoveTo(p) | PathElement::LineTo(p) in path.take(points as usize) {
        out.write_record([exact(p.x), exact(p.y)])?;
    }
    Ok(())
}

/// The generator, by name, word or polyline, and what it is made of.
fn generator(source: &Source, file: &File) -> Result<(Generator<SEGMENTS>, Origin), Fail> {
    if let Some(angle) = file.angle.as_ref().filter(|_| file.turtle.is_none()) {
        return Err(source.fail(angle.span(), "angle", "it belongs to a turtle word"));
    }
    match (&file.curve, &file.generator, &file.turtle) {
        (Some(name), None, None) => {
            let Some(curve) = catalogue::find(name.get_ref()) else {
                let names: Vec<&str> = catalogue::ALL.iter().map(|curve| curve.name).collect();
                let reason = format!("allowed is {}", names.join(", "));
                return Err(source.fail(name.span(), "curve", reason));
            };
            let generator = curve.generator().map_err(|error| source.fail(name.span(), "curve", error))?;
            Ok((generator, Origin::Named(curve)))
        }
        (None, Some(list), None) => {
            let mut vertices = Vec::new();
            for (i, pair) in list.get_ref().iter().enumerate() {
                vertices.push(source.pair::<Wide>(pair.get_ref(), &format!("generator[{i}]"))?);
            }
            let generator = Generator::polyline(&vertices).map_err(|error| match error {
                Error::NotContractive { map } => {
                    let span = list.get_ref().get(map).map_or(list.span(), Spanned::span);
                    let reason =
                        "the segment from here is no shorter than the one that the generator replaces";
                    source.fail(span, &format!("generator[{map}]"), reason)
                }
                // the kernel has not computed the value
                Error::OutOfRange { index: Some(index), .. } => {
                    let span = list.get_ref().get(index).map_or(list.span(), Spanned::span);
                    let reason = "outside -1 < x < 2, -2 < y < 2, seen from the segment that is replaced";
                    source.fail(span, &format!("generator[{index}]"), reason)
                }
                _ => source.fail(list.span(), "generator", error),
            })?;
            Ok((generator, Origin::Polyline(vertices)))
        }
        (None, None, Some(word)) => {
            let Some(angle) = &file.angle else {
                return Err(source.fail(word.span(), "turtle", "it needs an `angle` in degrees"));
            };
            let degrees = source.fixed::<Wide>(angle, "angle")?;
            // 48 fractional bits, to 32 of a turn, rounded
            let turns = ((i128::from(degrees.to_bits()) << 32) / 180 + (1 << 48)) >> 49;
            let angle = Angle::from_bits(turns as u32);
            let generator = Generator::turtle(word.get_ref(), angle)
                .map_err(|error| source.fail(word.span(), "turtle", error))?;
            Ok((generator, Origin::Turtle(word.get_ref().clone(), angle)))
        }
        _ => Err(source.fail_all("curve", "one of curve, generator and turtle is needed")),
    }
}

/// How many points a path of this order has.
fn points(generator: &Generator<SEGMENTS>, base: &[Point2], order: u32) -> u64 {
    (generator.len() as u64).saturating_pow(order).saturating_mul(base.len().max(1) as u64)
}

fn checked_order(
    source: &Source,
    order: &Spanned<i64>,
    generator: &Generator<SEGMENTS>,
    base: &[Point2],
) -> Result<u32, Fail> {
    let fits = |order: &u32| points(generator, base, *order) <= u64::from(MAX_POINTS);
    let most = (0..=DEPTH as u32).take_while(fits).last().unwrap_or(0);
    // a curve through the middles of squares has but one of them at order 0: a place, no line; what the
    // kernel says against the base is said later
    let path = generator.refined::<DEPTH>(base, 0);
    let least = u32::from(path.is_ok_and(|path| path.take(2).count() < 2));
    match u32::try_from(*order.get_ref()) {
        Ok(n) if (least..=most).contains(&n) => Ok(n),
        _ => {
            let reason =
                format!("allowed is {least} to {most} for this generator: at most {MAX_POINTS} points");
            Err(source.fail(order.span(), "order", reason))
        }
    }
}
