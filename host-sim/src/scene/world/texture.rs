//! The textures of a world as its file has them: checkers, noise, turbulence, wood and marble.

use std::ops::Range;

use attractor::Error;
use attractor::num::{Real, Rgb, Unit, Wide};
use attractor::textures;
use attractor::trace::texture::{
    Checker, Image, Lookup, Mapped, Marble, Mottle, Noise, Spline, Turbulence, Wood,
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
}

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
            Self::Marble => {
                ("marble", &["colors", "knots", "grain", "octaves", "seed", "amplitude", "veins"])
            }
        }
    }
}

/// The most colours of a spline.
const COLORS: usize = 16;

textures! {
    /// What colours a thing.
    #[derive(Debug, Clone, Copy)]
    pub(crate) enum Pigment<'a> {
        Plain(Rgb),
        Checker(Checker),
        Mottle(Mottle<COLORS>),
        Marble(Marble<COLORS>),
        Wood(Wood),
        Image(Mapped<Image<'a>>),
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
    Checker { colors: [Rgb; 2], frequency: [Real; 3], squares: bool },
    Mottle { colors: Vec<(Unit, Rgb)>, grain: Grain },
    Marble { colors: Vec<(Unit, Rgb)>, grain: Grain, amplitude: Real, veins: Real },
    Wood { wood: Wood, rough: Option<(Grain, Real)> },
    Facets { cells: [Real; 2], seed: u32 },
    Image { picture: Picture, lookup: Looked, rows: [[Real; 3]; 2] },
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
        })
    }

    pub(crate) fn load(source: &Source, name: &str, given: &Spanned<Woven>) -> Result<Self, Fail> {
        let span = given.span();
        let given = given.get_ref();
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
            let colors = given.knots.as_ref().map(Spanned::span).or(given.colors.as_ref().map(Spanned::span));
            match (error, colors) {
                (Error::OutOfRange { what, .. }, _) if what.starts_with("octaves") => {
                    let octaves = given.octaves.as_ref().map_or(span, Spanned::span);
                    source.fail(octaves, &reader.key("octaves"), error)
                }
                (Error::Degenerate { .. }, None) => {
                    let rows = given.u.as_ref().or(given.v.as_ref()).map_or(span, Spanned::span);
                    source.fail(rows, &reader.key("u"), error)
                }
                (_, Some(colors)) => source.fail(colors, &reader.key("colors"), error),
                (_, None) => source.fail(span, &format!("texture.{name}"), error),
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
    fn key(&self, name: &str) -> String {
        format!("texture.{}.{name}", self.name)
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
        ];
        match all.into_iter().flatten().find(|(key, _)| !keys.contains(key)) {
            Some((key, span)) => {
                Err(self.source.fail(span, &self.key(key), format!("no key of kind = {kind:?}")))
            }
            None => Ok(()),
        }
    }
}
