//! The textures of a world as its file has them: checkers, noise, turbulence, wood, marble, pictures, and
//! pattern polygons pasted on any of them.

use std::collections::BTreeMap;
use std::ops::Range;

use attractor::Error;
use attractor::num::{Real, Rgb, Unit, Wide};
use attractor::textures;
use attractor::trace::SurfacePoint;
use attractor::trace::texture::{
    Checker, Image, Lookup, Mapped, Marble, Mottle, Noise, Pasted, Spline, Texture, Turbulence, Wood,
};
use serde::Deserialize;
use toml::Spanned;

use super::color::{Color, light};
use super::material::within;
use super::picture::Picture;
use super::placement::{Scale, factors};
use crate::fail::Fail;
use crate::source::{Num, Source};

/// A table `[texture.NAME]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Woven {
    kind: Spanned<Weave>,
    colors: Option<Spanned<Vec<Spanned<Color>>>>,
    knots: Option<Spanned<Vec<Num>>>,
    frequency: Option<Spanned<Scale>>,
    squares: Option<Spanned<bool>>,
    grain: Option<Num>,
    octaves: Option<Spanned<i64>>,
    seed: Option<Spanned<u32>>,
    amplitude: Option<Num>,
    veins: Option<Num>,
    rings: Option<Num>,
    tilt: Option<Spanned<[Num; 2]>>,
    wobble: Option<Num>,
    lobes: Option<Spanned<i64>>,
    twist: Option<Num>,
    rough: Option<Num>,
    soft: Option<Num>,
    cells: Option<Spanned<[Num; 2]>>,
    image: Option<Spanned<String>>,
    lookup: Option<Spanned<Looked>>,
    u: Option<Spanned<[Num; 3]>>,
    v: Option<Spanned<[Num; 3]>>,
    parent: Option<Spanned<Color>>,
    detail: Option<Spanned<Color>>,
    points: Option<Spanned<Vec<Spanned<[Num; 2]>>>>,
}

/// The tables `[texture.NAME]` of a file.
pub(crate) type Tables = BTreeMap<String, Spanned<Woven>>;

/// How an image is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Looked {
    Nearest,
    Bilinear,
    Area,
}

/// What `kind` may say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Weave {
    Checker,
    Noise,
    Turbulence,
    Wood,
    Marble,
    Facets,
    Image,
    Pattern,
}

impl Weave {
    /// As files write it, and the keys that it has.
    fn keys(self) -> (&'static str, &'static [&'static str]) {
        match self {
            Self::Checker => ("checker", &["colors", "frequency", "squares"]),
            Self::Noise => ("noise", &["colors", "knots", "grain", "seed"]),
            Self::Turbulence => ("turbulence", &["colors", "knots", "grain", "octaves", "seed"]),
            Self::Wood => (
                "wood",
                &[
                    "colors", "rings", "tilt", "wobble", "lobes", "twist", "rough", "soft", "grain",
                    "octaves", "seed",
                ],
            ),
            Self::Facets => ("facets", &["cells", "seed"]),
            Self::Image => ("image", &["image", "lookup", "u", "v"]),
            Self::Pattern => ("pattern", &["parent", "detail", "points"]),
            Self::Marble => {
                ("marble", &["colors", "knots", "grain", "octaves", "seed", "amplitude", "veins"])
            }
        }
    }
}

/// The most colours of a spline.
const COLORS: usize = 16;
/// The most patterns on one another.
const PASTED: usize = 8;

textures! {
    /// What colours a thing.
    #[derive(Debug, Clone)]
    pub(crate) enum Pigment<'a> {
        Plain(Rgb),
        Checker(Checker),
        Mottle(Mottle<COLORS>),
        Marble(Marble<COLORS>),
        Wood(Wood),
        Image(Mapped<Image<'a>>),
        Pasted(Inlay<'a>),
    }
}

/// A texture with a polygon of another one pasted on it, at any depth.
#[derive(Debug, Clone)]
pub(crate) struct Inlay<'a>(Box<Pasted<'a, Pigment<'a>, Pigment<'a>>>);

impl Texture for Inlay<'_> {
    fn is_charted(&self) -> bool {
        Texture::is_charted(&*self.0)
    }

    fn at(&self, point: &SurfacePoint) -> Rgb {
        self.0.at(point)
    }
}

/// Turbulence in numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grain {
    pub(crate) seed: u32,
    pub(crate) frequency: Real,
    pub(crate) octaves: u8,
}

impl Grain {
    pub(crate) fn turbulence(self) -> Result<Turbulence, Error> {
        Turbulence::new(Noise::new(self.seed), self.frequency, self.octaves)
    }
}

/// A texture in numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Pattern {
    Checker {
        colors: [Rgb; 2],
        frequency: [Real; 3],
        squares: bool,
    },
    Mottle {
        colors: Vec<(Unit, Rgb)>,
        grain: Grain,
    },
    Marble {
        colors: Vec<(Unit, Rgb)>,
        grain: Grain,
        amplitude: Real,
        veins: Real,
    },
    Wood {
        wood: Wood,
        rough: Option<(Grain, Real)>,
    },
    Facets {
        cells: [Real; 2],
        seed: u32,
    },
    Image {
        picture: Picture,
        lookup: Looked,
        rows: [[Real; 3]; 2],
    },
    /// The same everywhere: a part of a pattern.
    Plain(Rgb),
    Pasted {
        parent: Box<Pattern>,
        detail: Box<Pattern>,
        corners: Vec<[Real; 2]>,
    },
}

impl Pattern {
    /// As core has it.
    pub(crate) fn pigment(&self) -> Result<Pigment<'_>, Error> {
        Ok(match self {
            Self::Checker { colors: [even, odd], frequency, squares: false } => {
                Pigment::Checker(Checker::cubes(*frequency, *even, *odd))
            }
            Self::Checker { colors: [even, odd], frequency: [across, up, _], squares: true } => {
                Pigment::Checker(Checker::squares([*across, *up], *even, *odd))
            }
            Self::Mottle { colors, grain } => {
                Pigment::Mottle(Mottle { undulate: Spline::new(colors)?, turbulence: grain.turbulence()? })
            }
            Self::Marble { colors, grain, amplitude, veins } => Pigment::Marble(Marble {
                undulate: Spline::new(colors)?,
                turbulence: grain.turbulence()?,
                amplitude: *amplitude,
                frequency: *veins,
            }),
            Self::Wood { wood, rough } => {
                let rough = rough.map(|(grain, rings)| Ok((grain.turbulence()?, rings)));
                Pigment::Wood(Wood { rough: rough.transpose()?, ..*wood })
            }
            // facets have no colour
            Self::Facets { .. } => Pigment::Plain(Rgb::WHITE),
            Self::Image { picture, lookup, rows } => {
                let lookup = match lookup {
                    Looked::Nearest => Lookup::Nearest,
                    Looked::Bilinear => Lookup::Bilinear,
                    Looked::Area => Lookup::Area,
                };
                Pigment::Image(Mapped::new(picture.image()?.with_lookup(lookup), *rows)?)
            }
            Self::Plain(color) => Pigment::Plain(*color),
            Self::Pasted { parent, detail, corners } => {
                let pasted = Pasted::new(parent.pigment()?, corners, detail.pigment()?)?;
                Pigment::Pasted(Inlay(Box::new(pasted)))
            }
        })
    }

    /// The texture of a table; what a pattern is made of stands in `others`.
    pub(crate) fn load(
        source: &Source,
        name: &str,
        given: &Spanned<Woven>,
        others: &Tables,
    ) -> Result<Self, Fail> {
        Self::within(source, (name, given), others, &[])
    }

    /// The same, as a part of those patterns.
    fn within(
        source: &Source,
        (name, table): (&str, &Spanned<Woven>),
        others: &Tables,
        outer: &[&str],
    ) -> Result<Self, Fail> {
        let span = table.span();
        let given = table.get_ref();
        let reader = Reader { source, name, given };
        reader.check_keys()?;
        let pattern = match given.kind.get_ref() {
            Weave::Checker => Self::Checker {
                colors: reader.two([Rgb::WHITE, Rgb::BLACK])?,
                frequency: match &given.frequency {
                    Some(frequency) => {
                        let each = factors(source, frequency, &reader.key("frequency"))?;
                        [each.x, each.y, each.z]
                    }
                    None => [Real::ONE; 3],
                },
                squares: given.squares.as_ref().is_some_and(|squares| *squares.get_ref()),
            },
            Weave::Noise => Self::Mottle { colors: reader.spline()?, grain: reader.grain(1)? },
            Weave::Turbulence => Self::Mottle { colors: reader.spline()?, grain: reader.grain(4)? },
            Weave::Marble => Self::Marble {
                colors: reader.spline()?,
                grain: reader.grain(4)?,
                amplitude: reader.real(&given.amplitude, "amplitude", Real::from_num(4))?,
                veins: reader.real(&given.veins, "veins", Real::from_num(2))?,
            },
            Weave::Facets => Self::Facets {
                cells: match &given.cells {
                    Some(cells) => source.pair(cells.get_ref(), &reader.key("cells"))?,
                    None => [Real::from_num(16); 2],
                },
                seed: given.seed.as_ref().map_or(0, |seed| *seed.get_ref()),
            },
            Weave::Image => {
                let Some(image) = &given.image else {
                    let reason = "image is missing, the name of a PNG file";
                    return Err(source.fail(given.kind.span(), &reader.key("kind"), reason));
                };
                let row = |row: &Option<Spanned<[Num; 3]>>, name: &str, usual: [Real; 3]| match row {
                    Some(row) => source.triple(row.get_ref(), &reader.key(name)),
                    None => Ok(usual),
                };
                let (one, zero) = (Real::ONE, Real::ZERO);
                Self::Image {
                    picture: Picture::load(source, image, &reader.key("image"))?,
                    lookup: given.lookup.as_ref().map_or(Looked::Area, |lookup| *lookup.get_ref()),
                    rows: [row(&given.u, "u", [one, zero, zero])?, row(&given.v, "v", [zero, one, zero])?],
                }
            }
            Weave::Pattern => {
                let outer = [outer, &[name]].concat();
                let part = |part: &Option<Spanned<Color>>, key: &str| {
                    reader.part(part, key, others, &outer).map(Box::new)
                };
                Self::Pasted {
                    parent: part(&given.parent, "parent")?,
                    detail: part(&given.detail, "detail")?,
                    corners: reader.corners()?,
                }
            }
            Weave::Wood => Self::Wood {
                wood: Wood {
                    colors: reader.two([Rgb::WHITE, Rgb::BLACK])?,
                    rings: reader.real(&given.rings, "rings", Real::from_num(4))?,
                    tilt: match &given.tilt {
                        Some(tilt) => source.pair(tilt.get_ref(), &reader.key("tilt"))?,
                        None => [Real::ZERO; 2],
                    },
                    wobble: reader.real(&given.wobble, "wobble", Real::ZERO)?,
                    lobes: reader.small(&given.lobes, "lobes", (0, 255), 5)?,
                    twist: reader.real(&given.twist, "twist", Real::ZERO)?,
                    rough: None,
                    soft: match &given.soft {
                        Some(soft) => within(source, soft, &reader.key("soft"), (Wide::ZERO, Wide::ONE))?,
                        None => Unit::ZERO,
                    },
                },
                rough: match &given.rough {
                    Some(_) => Some((reader.grain(4)?, reader.real(&given.rough, "rough", Real::ZERO)?)),
                    None => None,
                },
            },
        };
        // the kernel says what it takes
        pattern.pigment().map_err(|error| {
            if let Some(points) = &given.points {
                return source.fail(points.span(), &reader.key("points"), error);
            }
            let colors = match (&given.knots, &given.colors) {
                (Some(knots), _) => Some((knots.span(), "knots")),
                (None, colors) => colors.as_ref().map(|colors| (colors.span(), "colors")),
            };
            match (error, colors) {
                (Error::OutOfRange { what, .. }, _) if what.starts_with("octaves") => {
                    let octaves = given.octaves.as_ref().map_or(span, Spanned::span);
                    source.fail(octaves, &reader.key("octaves"), error)
                }
                (Error::Degenerate { .. }, None) => {
                    let rows = given.u.as_ref().or(given.v.as_ref()).map_or(span, Spanned::span);
                    source.fail(rows, &reader.key("u"), error)
                }
                (_, Some((span, key))) => source.fail(span, &reader.key(key), error),
                (_, None) => source.fail(span, &reader.table(), error),
            }
        })?;
        Ok(pattern)
    }
}

/// Reads the keys of one table.
struct Reader<'a> {
    source: &'a Source,
    name: &'a str,
    given: &'a Woven,
}

impl Reader<'_> {
    /// The table as the file has it: the one texture of a scene of that kind has no name.
    fn table(&self) -> String {
        if self.name.is_empty() { "texture".to_owned() } else { format!("texture.{}", self.name) }
    }

    fn key(&self, name: &str) -> String {
        format!("{}.{name}", self.table())
    }

    fn real(&self, number: &Option<Num>, name: &str, usual: Real) -> Result<Real, Fail> {
        number.as_ref().map_or(Ok(usual), |number| self.source.fixed(number, &self.key(name)))
    }

    fn small(
        &self,
        given: &Option<Spanned<i64>>,
        name: &str,
        (min, max): (u8, u8),
        usual: u8,
    ) -> Result<u8, Fail> {
        let Some(given) = given else { return Ok(usual) };
        let fits = u8::try_from(*given.get_ref()).ok().filter(|n| (min..=max).contains(n));
        let reason = format!("allowed is {min} to {max}");
        fits.ok_or_else(|| self.source.fail(given.span(), &self.key(name), reason))
    }

    fn grain(&self, octaves: u8) -> Result<Grain, Fail> {
        Ok(Grain {
            seed: self.given.seed.as_ref().map_or(0, |seed| *seed.get_ref()),
            frequency: self.real(&self.given.grain, "grain", Real::ONE)?,
            octaves: self.small(&self.given.octaves, "octaves", (1, Turbulence::MOST_OCTAVES), octaves)?,
        })
    }

    fn colors(&self) -> Result<Option<Vec<Rgb>>, Fail> {
        let Some(colors) = &self.given.colors else { return Ok(None) };
        let color = |(i, color)| light(self.source, color, &self.key(&format!("colors[{i}]")), 1);
        colors.get_ref().iter().enumerate().map(color).collect::<Result<_, _>>().map(Some)
    }

    fn two(&self, usual: [Rgb; 2]) -> Result<[Rgb; 2], Fail> {
        match (self.colors()?.as_deref(), &self.given.colors) {
            (Some([a, b]), _) => Ok([*a, *b]),
            (Some(all), Some(colors)) => {
                let reason = format!("{} colours, this texture has 2", all.len());
                Err(self.source.fail(colors.span(), &self.key("colors"), reason))
            }
            _ => Ok(usual),
        }
    }

    /// Colours at their knots, or evenly from -1 to 1.
    fn spline(&self) -> Result<Vec<(Unit, Rgb)>, Fail> {
        let colors = self.colors()?.unwrap_or_else(|| vec![Rgb::BLACK, Rgb::WHITE]);
        let Some(knots) = &self.given.knots else {
            let steps = (colors.len() as i64 - 1).max(1);
            let even = |i: usize| Unit::from_bits((((2 * i as i64 - steps) << 30) / steps) as i32);
            return Ok(colors.into_iter().enumerate().map(|(i, color)| (even(i), color)).collect());
        };
        if knots.get_ref().len() != colors.len() {
            let reason = format!("{} knots for {} colours", knots.get_ref().len(), colors.len());
            return Err(self.source.fail(knots.span(), &self.key("knots"), reason));
        }
        let places = knots.get_ref().iter().enumerate().map(|(i, knot)| {
            within(self.source, knot, &self.key(&format!("knots[{i}]")), (-Wide::ONE, Wide::ONE))
        });
        let places: Vec<Unit> = places.collect::<Result<_, _>>()?;
        Ok(places.into_iter().zip(colors).collect())
    }

    /// A part of a pattern: a colour, or the texture of a name.
    fn part(
        &self,
        given: &Option<Spanned<Color>>,
        key: &str,
        others: &Tables,
        outer: &[&str],
    ) -> Result<Pattern, Fail> {
        let Some(color) = given else {
            let reason = format!("{key} is missing, a colour or the name of a texture");
            return Err(self.source.fail(self.given.kind.span(), &self.key("kind"), reason));
        };
        let key = self.key(key);
        let refused = |reason: &str| Err(self.source.fail(color.span(), &key, reason));
        match color.get_ref() {
            Color::Code(name) if !name.starts_with('#') => match others.get_key_value(name) {
                None => refused("there is no texture of this name"),
                Some((name, _)) if outer.contains(&name.as_str()) => {
                    refused("the pattern is a part of itself")
                }
                Some(_) if outer.len() >= PASTED => {
                    refused("too many patterns on one another, 8 are allowed")
                }
                Some((name, table)) => Pattern::within(self.source, (name, table), others, outer),
            },
            _ => light(self.source, color, &key, 1).map(Pattern::Plain),
        }
    }

    /// The corners of a polygon of texture coordinates.
    fn corners(&self) -> Result<Vec<[Real; 2]>, Fail> {
        let Some(points) = &self.given.points else {
            let reason = "points is missing, the corners of the polygon: [[u, v], ...]";
            return Err(self.source.fail(self.given.kind.span(), &self.key("kind"), reason));
        };
        let corner = |(i, point): (usize, &Spanned<[Num; 2]>)| {
            self.source.pair(point.get_ref(), &self.key(&format!("points[{i}]")))
        };
        points.get_ref().iter().enumerate().map(corner).collect()
    }

    /// Complains about a key of another kind.
    fn check_keys(&self) -> Result<(), Fail> {
        fn entry<T>(name: &'static str, value: &Option<Spanned<T>>) -> Option<(&'static str, Range<usize>)> {
            value.as_ref().map(|value| (name, value.span()))
        }
        let given = self.given;
        let (kind, keys) = given.kind.get_ref().keys();
        let all = [
            entry("colors", &given.colors),
            entry("knots", &given.knots),
            entry("frequency", &given.frequency),
            entry("squares", &given.squares),
            entry("grain", &given.grain),
            entry("octaves", &given.octaves),
            entry("seed", &given.seed),
            entry("amplitude", &given.amplitude),
            entry("veins", &given.veins),
            entry("rings", &given.rings),
            entry("tilt", &given.tilt),
            entry("wobble", &given.wobble),
            entry("lobes", &given.lobes),
            entry("twist", &given.twist),
            entry("rough", &given.rough),
            entry("soft", &given.soft),
            entry("cells", &given.cells),
            entry("image", &given.image),
            entry("lookup", &given.lookup),
            entry("u", &given.u),
            entry("v", &given.v),
            entry("parent", &given.parent),
            entry("detail", &given.detail),
            entry("points", &given.points),
        ];
        match all.into_iter().flatten().find(|(key, _)| !keys.contains(key)) {
            Some((key, span)) => {
                Err(self.source.fail(span, &self.key(key), format!("no key of kind = {kind:?}")))
            }
            None => Ok(()),
        }
    }
}
