//! `kind = "patch-curve"`: a curve by control points in the plane.

use std::convert::Infallible;

use attractor::Error;
use attractor::num::Near;
use attractor::patch::{ProjectedCurve, Type, b_spline, bezier, standard_curve, takagi};
use attractor::plane::{PathElement, Point2};
use attractor_gallery::{PatchCurvePicture, Pencil, Watch};
use embedded_graphics::draw_target::DrawTarget;
use serde::Deserialize;
use toml::Spanned;

use super::curve::vertices;
use super::polyline::{self, Points};
use super::request::Request;
use crate::color::Depth;
use crate::fail::Fail;
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
    control_points: Points,
    curve: Option<Spanned<Name>>,
    maps: Option<Spanned<[[Num; 2]; 2]>>,
    levels: Option<Spanned<u32>>,
    palette: Option<Named>,
}

/// What `curve` may say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Name {
    Bezier,
    BSpline,
    Takagi,
    TypeA,
    TypeB,
    TypeC,
    TypeD,
    TypeE,
    TypeF,
}

impl Name {
    /// The type of figure 2, if it is one.
    fn letter(self) -> Option<&'static Type> {
        let letter = match self {
            Self::TypeA => 'a',
            Self::TypeB => 'b',
            Self::TypeC => 'c',
            Self::TypeD => 'd',
            Self::TypeE => 'e',
            Self::TypeF => 'f',
            Self::Bezier | Self::BSpline | Self::Takagi => return None,
        };
        Type::ALL.iter().find(|of| of.letter == letter)
    }
}

/// A curve of so many control points.
#[derive(Debug)]
pub(crate) enum Shape {
    Two(ProjectedCurve<2, 2>, [Point2; 2]),
    Three(ProjectedCurve<2, 3>, [Point2; 3]),
    Four(ProjectedCurve<2, 4>, [Point2; 4]),
    Five(ProjectedCurve<2, 5>, [Point2; 5]),
    Six(ProjectedCurve<2, 6>, [Point2; 6]),
}

/// A curve ready to be drawn.
#[derive(Debug)]
pub(crate) struct PatchCurve {
    pub(crate) shape: Shape,
    pub(crate) levels: u32,
    pub(crate) pencil: Pencil,
    place: Place,
}

impl PatchCurve {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let points = polyline::points(source, "control_points", &file.control_points)?;
        let place = source.place(file.control_points.span(), "control_points");
        let levels = file.levels.as_ref().map_or(11, |levels| *levels.get_ref());
        if let Some(given) = file.levels.as_ref().filter(|levels| *levels.get_ref() > 16) {
            return Err(source.fail(given.span(), "levels", "allowed is 0 to 16"));
        }
        let shape = match (&file.curve, &file.maps) {
            (Some(name), None) => named(*name.get_ref(), &points),
            (None, Some(maps)) => {
                let [first, second] = maps.get_ref();
                let pair = |pair: &[Num; 2], k: usize| source.pair::<Near>(pair, &format!("maps[{k}]"));
                let curve = standard_curve(pair(first, 0)?, pair(second, 1)?)
                    .map_err(|error| source.fail(maps.span(), "maps", error))?;
                three(curve, &points)
            }
            (Some(name), Some(_)) => return Err(source.fail(name.span(), "curve", "maps are given as well")),
            (None, None) => {
                return Err(source.fail_all("curve", "missing: a name, or maps = [[a, b], [c, d]]"));
            }
        };
        let shape =
            shape.map_err(|error| source.fail(file.control_points.span(), "control_points", error))?;
        let pencil = Pencil { palette: file.palette.unwrap_or(Named::Ocean), closed: false };
        Ok(Self { shape, levels, pencil, place })
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        let (levels, pencil, size) = (self.levels, self.pencil, request.size);
        let drawn = match &self.shape {
            Shape::Two(curve, points) => {
                PatchCurvePicture { curve, points: *points, levels, pencil }.draw(size, target, watch)
            }
            Shape::Three(curve, points) => {
                PatchCurvePicture { curve, points: *points, levels, pencil }.draw(size, target, watch)
            }
            Shape::Four(curve, points) => {
                PatchCurvePicture { curve, points: *points, levels, pencil }.draw(size, target, watch)
            }
            Shape::Five(curve, points) => {
                PatchCurvePicture { curve, points: *points, levels, pencil }.draw(size, target, watch)
            }
            Shape::Six(curve, points) => {
                PatchCurvePicture { curve, points: *points, levels, pencil }.draw(size, target, watch)
            }
        };
        drawn.map_err(|error| self.place.fail_at(size, error))
    }

    /// `x,y` of the first points.
    pub(super) fn sample(&self, points: u32, out: &mut Csv) -> Result<(), Fail> {
        vertices(self.path().map_err(Fail::new)?, points, out)
    }

    fn path(&self) -> Result<Box<dyn Iterator<Item = PathElement> + '_>, Error> {
        let levels = self.levels;
        Ok(match &self.shape {
            Shape::Two(curve, points) => Box::new(curve.polyline(*points, levels)?),
            Shape::Three(curve, points) => Box::new(curve.polyline(*points, levels)?),
            Shape::Four(curve, points) => Box::new(curve.polyline(*points, levels)?),
            Shape::Five(curve, points) => Box::new(curve.polyline(*points, levels)?),
            Shape::Six(curve, points) => Box::new(curve.polyline(*points, levels)?),
        })
    }
}

fn three(curve: ProjectedCurve<2, 3>, points: &[Point2]) -> Result<Shape, Error> {
    let wrong = Error::LengthMismatch { what: "control points", given: points.len(), expected: 3 };
    Ok(Shape::Three(curve, points.try_into().map_err(|_| wrong)?))
}

fn named(name: Name, points: &[Point2]) -> Result<Shape, Error> {
    if let Some(of) = name.letter() {
        return three(of.curve()?, points);
    }
    let spline = name == Name::BSpline;
    Ok(match *points {
        _ if name == Name::Takagi => return three(takagi()?, points),
        [a, b] => Shape::Two(if spline { b_spline()? } else { bezier()? }, [a, b]),
        [a, b, c] => Shape::Three(if spline { b_spline()? } else { bezier()? }, [a, b, c]),
        [a, b, c, d] => Shape::Four(if spline { b_spline()? } else { bezier()? }, [a, b, c, d]),
        [a, b, c, d, e] => Shape::Five(if spline { b_spline()? } else { bezier()? }, [a, b, c, d, e]),
        [a, b, c, d, e, f] => Shape::Six(if spline { b_spline()? } else { bezier()? }, [a, b, c, d, e, f]),
        [] | [_] => return Err(Error::TooFew { what: "control points", given: points.len(), at_least: 2 }),
        _ => return Err(Error::Capacity { what: "control points", needed: points.len(), capacity: 6 }),
    })
}
