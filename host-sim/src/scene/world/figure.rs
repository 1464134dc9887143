//! The shapes of a world: numbers as the file has them, and core's surfaces that are made of them.

use attractor::fif::{Cell, Pyramid};
use attractor::num::{Affine3, Near, Real, Vec3, Wide};
use attractor::trace::HeightField;
use attractor::trace::solid::{
    Cube, HalfSpace, Moved, Placed, Plane, Polygon, Polyhedron, Sphere, Square, Superellipsoid,
    TaperedCylinder, Torus,
};
use attractor::{Error, surfaces};
use attractor_gallery::surface_depth;
use toml::Spanned;

use super::super::function::{Description, Function};
use super::object::{Form, Thing};
use super::placement::Step;
use crate::fail::Fail;
use crate::source::{Num, Source};

/// The most corners of a polygon.
const CORNERS: usize = 16;

surfaces! {
    /// A surface of any kind that a file can name.
    #[derive(Debug, Clone, Copy)]
    pub(crate) enum Solid<'a> {
        Plane(Placed<Plane>),
        Square(Placed<Square>),
        Polygon(Placed<Polygon<CORNERS>>),
        Sphere(Placed<Sphere>),
        Cube(Placed<Cube>),
        Polyhedron(Placed<Polyhedron<'a>>),
        TaperedCylinder(Placed<TaperedCylinder>),
        Torus(Placed<Torus>),
        Superellipsoid(Placed<Superellipsoid>),
        HeightField(Moved<HeightField<'a>>),
    }
}

/// A shape in its own coordinates.
#[derive(Debug)]
pub(crate) enum Figure {
    Plane,
    Square,
    Polygon { corners: Vec<Vec3>, polygon: Box<Polygon<CORNERS>> },
    Sphere,
    Cube,
    Polyhedron { planes: Vec<[Wide; 4]>, half_spaces: Vec<HalfSpace> },
    TaperedCylinder { cap: Real, shape: TaperedCylinder },
    Torus(Torus),
    Superellipsoid { n: Real, m: Real, shape: Superellipsoid },
    HeightField(Box<[Function; 2]>),
}

/// Memory for the pyramids of a height field.
pub(crate) type Cells = [Vec<Cell>; 2];

impl Figure {
    /// The shape of a table that is no compound.
    pub(super) fn load(source: &Source, thing: &Thing, prefix: &str) -> Result<Self, Fail> {
        let key = |name: &str| format!("{prefix}{name}");
        let refused = |span, name: &str, error: Error| source.fail(span, &key(name), error);
        let form = *thing.shape.get_ref();
        match (form, &thing.points, &thing.planes, &thing.cap, &thing.tube) {
            (Form::Plane, ..) => Ok(Self::Plane),
            (Form::Square, ..) => Ok(Self::Square),
            (Form::Sphere, ..) => Ok(Self::Sphere),
            (Form::Cube, ..) => Ok(Self::Cube),
            (Form::Polygon, Some(points), ..) => {
                let corners = points.get_ref().iter().enumerate().map(|(i, point)| {
                    let [x, y, z] = source.triple(point.get_ref(), &key(&format!("points[{i}]")))?;
                    Ok(Vec3::new(x, y, z))
                });
                let corners = corners.collect::<Result<Vec<_>, Fail>>()?;
                let polygon =
                    Polygon::new(&corners).map_err(|error| refused(points.span(), "points", error))?;
                Ok(Self::Polygon { corners, polygon: Box::new(polygon) })
            }
            (Form::Polyhedron, _, Some(planes), ..) => polyhedron(source, planes, &key("planes")),
            (Form::TaperedCylinder, _, _, None, _) => {
                let cap = Real::ONE;
                let shape =
                    TaperedCylinder::new(cap).map_err(|error| refused(thing.shape.span(), "shape", error))?;
                Ok(Self::TaperedCylinder { cap, shape })
            }
            (Form::TaperedCylinder, _, _, Some(given), _) => {
                let cap = source.fixed(given, &key("cap"))?;
                let shape = TaperedCylinder::new(cap).map_err(|error| refused(given.span(), "cap", error))?;
                Ok(Self::TaperedCylinder { cap, shape })
            }
            (Form::Torus, .., Some(given)) => {
                let tube: Near = source.fixed(given, &key("tube"))?;
                Torus::new(tube).map(Self::Torus).map_err(|error| refused(given.span(), "tube", error))
            }
            (Form::Superellipsoid, ..) => {
                let missing = || source.fail(thing.shape.span(), &key("shape"), "n and m are missing");
                let (n, m) = (thing.n.as_ref().ok_or_else(missing)?, thing.m.as_ref().ok_or_else(missing)?);
                let numbers = [source.fixed(n, &key("n"))?, source.fixed(m, &key("m"))?];
                let shape = Superellipsoid::new(numbers[0], numbers[1]).map_err(|error| match error {
                    Error::OutOfRange { what: "m", .. } => refused(m.span(), "m", error),
                    _ => refused(n.span(), "n", error),
                })?;
                Ok(Self::Superellipsoid { n: numbers[0], m: numbers[1], shape })
            }
            (Form::HeightField, ..) => height_field(source, thing, prefix),
            // the keys that a shape needs have been looked for, and compounds are none
            _ => Err(source.fail(thing.shape.span(), &key("shape"), "a part of it is missing")),
        }
    }

    /// How deep its pyramids are, 0 for what has none.
    pub(crate) fn depth(&self, side: u32) -> u32 {
        match self {
            Self::HeightField(profiles) => depth(profiles, side),
            _ => 0,
        }
    }

    /// Memory for what it lends, on a display with so many pixels a side.
    pub(crate) fn cells(&self, side: u32) -> Cells {
        match self {
            Self::HeightField(profiles) => {
                let depth = depth(profiles, side);
                [0, 1].map(|k: usize| vec![Cell::ZERO; Pyramid::cells(profiles[k].fixed.maps(), depth)])
            }
            _ => [Vec::new(), Vec::new()],
        }
    }

    /// Variant and type, as a module of Rust names them.
    pub(crate) fn kind(&self) -> (String, String) {
        let name = match self {
            Self::Plane => "Plane",
            Self::Square => "Square",
            Self::Polygon { .. } => "Polygon",
            Self::Sphere => "Sphere",
            Self::Cube => "Cube",
            Self::Polyhedron { .. } => "Polyhedron",
            Self::TaperedCylinder { .. } => "TaperedCylinder",
            Self::Torus(_) => "Torus",
            Self::Superellipsoid { .. } => "Superellipsoid",
            Self::HeightField(_) => "HeightField",
        };
        let kind = match self {
            Self::Polygon { .. } => format!("Polygon<{CORNERS}>"),
            Self::Polyhedron { .. } => "Polyhedron<'a>".to_owned(),
            Self::HeightField(_) => return (name.to_owned(), "Moved<HeightField<'a>>".to_owned()),
            _ => name.to_owned(),
        };
        (name.to_owned(), format!("Placed<{kind}>"))
    }

    /// The shape where these steps put it, in memory that [`Figure::cells`] gave for as many pixels a side.
    pub(crate) fn placed<'a>(
        &'a self,
        steps: &[Step],
        cells: &'a mut Cells,
        side: u32,
    ) -> Result<Solid<'a>, Error> {
        let map = map(steps)?;
        Ok(match self {
            Self::Plane => Solid::Plane(Placed::new(Plane, &map)?),
            Self::Square => Solid::Square(Placed::new(Square, &map)?),
            Self::Polygon { polygon, .. } => Solid::Polygon(Placed::new(**polygon, &map)?),
            Self::Sphere => Solid::Sphere(Placed::new(Sphere, &map)?),
            Self::Cube => Solid::Cube(Placed::new(Cube, &map)?),
            Self::Polyhedron { half_spaces, .. } => {
                Solid::Polyhedron(Placed::new(Polyhedron::new(half_spaces)?, &map)?)
            }
            Self::TaperedCylinder { shape, .. } => Solid::TaperedCylinder(Placed::new(*shape, &map)?),
            Self::Torus(torus) => Solid::Torus(Placed::new(*torus, &map)?),
            Self::Superellipsoid { shape, .. } => Solid::Superellipsoid(Placed::new(*shape, &map)?),
            Self::HeightField(profiles) => {
                let ([f, g], [x, y]) = (&**profiles, cells);
                let depth = depth(profiles, side);
                let (x, y) = (Pyramid::new(&f.fixed, depth, x)?, Pyramid::new(&g.fixed, depth, y)?);
                Solid::HeightField(Moved::new(HeightField::new(&x, &y)?, &map)?)
            }
        })
    }
}

fn polyhedron(source: &Source, planes: &Spanned<Vec<Spanned<[Num; 4]>>>, key: &str) -> Result<Figure, Fail> {
    let (mut numbers, mut half_spaces) = (Vec::new(), Vec::new());
    for (i, plane) in planes.get_ref().iter().enumerate() {
        let key = format!("{key}[{i}]");
        let [nx, ny, nz, d] = plane.get_ref();
        let number = |number: &Num, k: usize| source.fixed::<Wide>(number, &format!("{key}[{k}]"));
        let (normal, distance) = (Vec3::new(number(nx, 0)?, number(ny, 1)?, number(nz, 2)?), number(d, 3)?);
        numbers.push([normal.x, normal.y, normal.z, distance]);
        half_spaces
            .push(HalfSpace::new(normal, distance).map_err(|error| source.fail(plane.span(), &key, error))?);
    }
    Polyhedron::new(&half_spaces).map_err(|error| source.fail(planes.span(), key, error))?;
    Ok(Figure::Polyhedron { planes: numbers, half_spaces })
}

/// How deep the pyramids of both profiles are.
fn depth(profiles: &[Function; 2], side: u32) -> u32 {
    let [f, g] = profiles;
    surface_depth([f.fixed.maps(), g.fixed.maps()], None, side)
}

fn height_field(source: &Source, thing: &Thing, prefix: &str) -> Result<Figure, Fail> {
    let (Some(f), Some(g)) = (&thing.f, &thing.g) else {
        return Err(source.fail(thing.shape.span(), &format!("{prefix}shape"), "f and g are missing"));
    };
    for (name, given) in [("f", f), ("g", g)] {
        let knots = &given.get_ref().knots;
        if knots.get_ref().len() == 2 {
            let reason =
                "a surface is cut into ever smaller parts: it takes two maps at least, that is three knots";
            return Err(source.fail(knots.span(), &format!("{prefix}{name}.knots"), reason));
        }
    }
    let profile = |given: &Spanned<Description>, name: &str| {
        given.get_ref().compile(source, &format!("{prefix}{name}."))
    };
    Ok(Figure::HeightField(Box::new([profile(f, "f")?, profile(g, "g")?])))
}

/// The map of steps, the first one first.
fn map(steps: &[Step]) -> Result<Affine3, Error> {
    let mut map = Affine3::IDENTITY;
    for step in steps {
        map = map.then(&match *step {
            Step::Scale(factors) => Affine3::scale(factors),
            Step::Rotate { axis, angle } => Affine3::rotate(axis, angle)?,
            Step::Translate(by) => Affine3::translate(by),
            Step::Matrix([x, y, z]) => {
                let row = |[x, y, z, _]: [Wide; 4]| Vec3::new(x, y, z);
                Affine3::matrix([row(x), row(y), row(z)], Vec3::new(x[3], y[3], z[3]))
            }
        });
    }
    Ok(map)
}
