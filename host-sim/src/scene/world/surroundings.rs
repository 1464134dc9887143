//! What surrounds a world, as its file has it: one colour, a sky, squares overhead and underfoot, or a
//! picture all round.

use attractor::num::{Real, Rgb, Unit, Vec3, Wide};
use attractor::trace::{Panorama, Sky, Surroundings, Tiles};
use serde::Deserialize;
use toml::Spanned;

use super::color::{Color, light_or};
use super::material::within;
use super::picture::Picture;
use crate::fail::Fail;
use crate::source::{Num, Source};

/// The table `[environment]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Table {
    kind: Option<Spanned<Kind>>,
    color: Option<Spanned<Color>>,
    zenith: Option<Spanned<Color>>,
    horizon: Option<Spanned<Color>>,
    nadir: Option<Spanned<Color>>,
    bright: Option<Spanned<Color>>,
    dark: Option<Spanned<Color>>,
    scale: Option<Num>,
    fade: Option<Num>,
    image: Option<Spanned<String>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    Plain,
    Sky,
    Checkerboard,
    Image,
}

/// What surrounds a world, in numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Around {
    Plain(Rgb),
    Sky(Sky),
    Tiles(Tiles),
    Image(Picture),
}

/// The sky of a world that says nothing of one.
fn usual() -> [Rgb; 3] {
    let lumen = |bits: [u32; 3]| {
        let [r, g, b] = bits.map(attractor::num::Lumen::from_bits);
        Rgb::new(r, g, b)
    };
    [lumen([9_000, 20_000, 46_000]), lumen([45_000, 52_000, 60_000]), lumen([8_000, 7_000, 6_000])]
}

impl Around {
    pub(super) fn load(source: &Source, given: Option<&Spanned<Table>>) -> Result<Self, Fail> {
        let [zenith, horizon, nadir] = usual();
        let Some(given) = given.map(Spanned::get_ref) else {
            return Ok(Self::Sky(Sky { zenith, horizon, nadir }));
        };
        let kind = match &given.kind {
            Some(kind) => *kind.get_ref(),
            None if given.image.is_some() => Kind::Image,
            None if given.color.is_some() => Kind::Plain,
            None if given.bright.is_some() || given.dark.is_some() => Kind::Checkerboard,
            None => Kind::Sky,
        };
        check_keys(source, given, kind)?;
        let color = |color: &Option<Spanned<Color>>, name: &str, usual: Rgb| {
            light_or(source, color.as_ref(), &format!("environment.{name}"), usual)
        };
        Ok(match kind {
            Kind::Plain => Self::Plain(color(&given.color, "color", Rgb::BLACK)?),
            Kind::Sky => Self::Sky(Sky {
                zenith: color(&given.zenith, "zenith", zenith)?,
                horizon: color(&given.horizon, "horizon", horizon)?,
                nadir: color(&given.nadir, "nadir", nadir)?,
            }),
            Kind::Checkerboard => {
                let tiles =
                    [color(&given.bright, "bright", Rgb::WHITE)?, color(&given.dark, "dark", Rgb::BLACK)?];
                Self::Tiles(Tiles {
                    ceiling: tiles,
                    floor: tiles,
                    horizon: color(&given.horizon, "horizon", horizon)?,
                    scale: match &given.scale {
                        None => Real::ONE,
                        Some(number) => {
                            within(source, number, "environment.scale", (Wide::ONE >> 6, Wide::from_num(64)))?
                        }
                    },
                    fade: match &given.fade {
                        None => Unit::ONE / 8,
                        Some(number) => {
                            within(source, number, "environment.fade", (Wide::ONE >> 6, Wide::ONE))?
                        }
                    },
                })
            }
            Kind::Image => match &given.image {
                Some(image) => Self::Image(Picture::load(source, image, "environment.image")?),
                None => {
                    let span = given.kind.as_ref().map_or(0..0, Spanned::span);
                    return Err(source.fail(
                        span,
                        "environment.kind",
                        "image is missing, the name of a PNG file",
                    ));
                }
            },
        })
    }
}

/// Complains about a key of another kind.
fn check_keys(source: &Source, given: &Table, kind: Kind) -> Result<(), Fail> {
    let (name, keys): (_, &[&str]) = match kind {
        Kind::Plain => ("plain", &["color"]),
        Kind::Sky => ("sky", &["zenith", "horizon", "nadir"]),
        Kind::Checkerboard => ("checkerboard", &["bright", "dark", "horizon", "scale", "fade"]),
        Kind::Image => ("image", &["image"]),
    };
    fn span<T>(value: &Option<Spanned<T>>) -> Option<std::ops::Range<usize>> {
        value.as_ref().map(Spanned::span)
    }
    let all = [
        ("color", span(&given.color)),
        ("zenith", span(&given.zenith)),
        ("horizon", span(&given.horizon)),
        ("nadir", span(&given.nadir)),
        ("bright", span(&given.bright)),
        ("dark", span(&given.dark)),
        ("scale", span(&given.scale)),
        ("fade", span(&given.fade)),
        ("image", span(&given.image)),
    ];
    for (key, span) in all {
        if let Some(span) = span.filter(|_| !keys.contains(&key)) {
            return Err(source.fail(
                span,
                &format!("environment.{key}"),
                format!("no key of kind = {name:?}"),
            ));
        }
    }
    Ok(())
}

/// As core has it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Outside<'a> {
    Plain(Rgb),
    Sky(Sky),
    Tiles(Tiles),
    Panorama(Panorama<'a>),
}

impl Surroundings for Outside<'_> {
    fn light(&self, direction: Vec3<Unit>, width: Unit) -> Rgb {
        match self {
            Self::Plain(light) => *light,
            Self::Sky(sky) => sky.light(direction, width),
            Self::Tiles(tiles) => tiles.light(direction, width),
            Self::Panorama(panorama) => panorama.light(direction, width),
        }
    }
}

impl Around {
    /// As core has it.
    pub(crate) fn outside(&self) -> Result<Outside<'_>, attractor::Error> {
        Ok(match self {
            Self::Plain(light) => Outside::Plain(*light),
            Self::Sky(sky) => Outside::Sky(*sky),
            Self::Tiles(tiles) => Outside::Tiles(*tiles),
            Self::Image(picture) => Outside::Panorama(Panorama::new(picture.image()?)),
        })
    }
}
