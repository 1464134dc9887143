//! A scene file of `kind = "world"`, read.

use std::collections::BTreeMap;

use attractor::num::{Real, Wide};
use attractor::trace::{Camera, Filter};
use serde::Deserialize;
use toml::Spanned;

use super::super::contrast::contrast;
use super::super::orbit::Orbit;
use super::super::standpoint::{Eye, Standpoint, camera};
use super::lamp::{Light, Shining};
use super::material::{Made, Matter, within};
use super::object::Thing;
use super::program::{Programs, programs};
use super::stuff::{raised, turned};
use super::surroundings::{Around, Table};
use super::texture::{Pattern, Tables};
use crate::fail::Fail;
use crate::source::{Num, Place, Source};

/// The most bounces of a ray that the command has room for.
pub(crate) const DEEPEST: u8 = 30;
/// The most lights: as many as a caster looks for.
const LIGHTS: usize = 64;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    camera: Spanned<Eye>,
    #[serde(default)]
    light: Vec<Spanned<Shining>>,
    #[serde(default)]
    object: Vec<Thing>,
    #[serde(default)]
    material: BTreeMap<String, Made>,
    #[serde(default)]
    texture: Tables,
    environment: Option<Spanned<Table>>,
    samples: Option<Spanned<i64>>,
    contrast: Option<Spanned<[i64; 2]>>,
    filter: Option<Spanned<Weights>>,
    deviation: Option<Num>,
    width: Option<Num>,
    seed: Option<Spanned<u32>>,
    depth: Option<Spanned<i64>>,
    interpenetration: Option<Policy>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Weights {
    Box,
    Gaussian,
}

/// What becomes of transparent things of equal priority that share a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Policy {
    Refuse,
    Priority,
}

/// All that a file says, in numbers.
#[derive(Debug)]
pub(crate) struct Description {
    pub(crate) camera: Camera,
    pub(crate) standpoint: Standpoint,
    pub(crate) eye: Place,
    pub(crate) orbit: Option<Orbit>,
    pub(crate) lights: Vec<Light>,
    pub(crate) things: Vec<Thing>,
    pub(crate) programs: Programs,
    pub(crate) materials: Vec<Matter>,
    pub(crate) textures: Vec<Pattern>,
    pub(crate) texture_names: Vec<String>,
    pub(crate) around: Around,
    pub(crate) samples: u8,
    pub(crate) filter: Filter,
    pub(crate) contrast: Option<[u8; 2]>,
    pub(crate) seed: Option<u32>,
    pub(crate) depth: u8,
    pub(crate) policy: Policy,
}

impl Description {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        if file.object.is_empty() {
            return Err(source.fail_all("object", "a world has one object at least: [[object]]"));
        }
        if file.light.len() > LIGHTS {
            let reason = format!("{} lights; there is room for {LIGHTS}", file.light.len());
            return Err(source.fail_all("light", reason));
        }
        let (camera, standpoint, orbit) = camera(source, &file.camera)?;
        let lights = file.light.iter().enumerate();
        let lights = lights.map(|(i, light)| Light::load(source, light, i, standpoint.eye));
        let numbers = file.texture.keys().enumerate().map(|(i, name)| (name.as_str(), i)).collect();
        let textures = file.texture.iter();
        let textures = textures.map(|(name, given)| Pattern::load(source, name, given, &file.texture));
        let materials = file.material.iter().map(|(name, given)| Matter::load(source, name, given, &numbers));
        let textures: Vec<Pattern> = textures.collect::<Result<_, _>>()?;
        let materials: Vec<Matter> = materials.collect::<Result<_, _>>()?;
        for matter in &materials {
            reliefs(source, matter, &textures)?;
        }
        Ok(Self {
            camera,
            standpoint,
            eye: source.place(file.camera.get_ref().eye.span(), "camera.eye"),
            orbit,
            lights: lights.collect::<Result<_, _>>()?,
            programs: programs(source, &file.object)?,
            materials,
            textures,
            texture_names: file.texture.keys().cloned().collect(),
            around: Around::load(source, file.environment.as_ref())?,
            samples: small(source, "samples", file.samples.as_ref(), (1, 8), 1)?,
            filter: filter(source, &file)?,
            contrast: contrast(source, file.contrast.as_ref())?,
            seed: file.seed.as_ref().map(|seed| *seed.get_ref()),
            depth: small(source, "depth", file.depth.as_ref(), (0, DEEPEST), 5)?,
            policy: file.interpenetration.unwrap_or(Policy::Refuse),
            things: file.object,
        })
    }
}

/// Complains about bumps and grains of textures that have none.
fn reliefs(source: &Source, matter: &Matter, textures: &[Pattern]) -> Result<(), Fail> {
    let refused = |name: &str, reason: &str| {
        Err(source.fail_all(&format!("material.{}.{name}.texture", matter.name), reason))
    };
    let bump = matter.bump.and_then(|(number, strength)| Some(raised(textures.get(number)?, strength)));
    if let Some(Ok(None)) = bump {
        return refused("bump", "bumps come from noise, turbulence, facets or an image");
    }
    let frame = matter.frame.and_then(|(number, strength)| Some(turned(textures.get(number)?, strength)));
    if let Some(Ok(None)) = frame {
        return refused("frame", "a grain comes from a checker, noise, turbulence or an image");
    }
    Ok(())
}

/// A whole number from a small range.
fn small(
    source: &Source,
    key: &str,
    given: Option<&Spanned<i64>>,
    (min, max): (u8, u8),
    usual: u8,
) -> Result<u8, Fail> {
    let Some(given) = given else { return Ok(usual) };
    let fits = u8::try_from(*given.get_ref()).ok().filter(|n| (min..=max).contains(n));
    fits.ok_or_else(|| source.fail(given.span(), key, format!("allowed is {min} to {max}")))
}

fn filter(source: &Source, file: &File) -> Result<Filter, Fail> {
    let gaussian = file.filter.as_ref().is_some_and(|filter| *filter.get_ref() == Weights::Gaussian);
    for (number, key) in [(&file.deviation, "deviation"), (&file.width, "width")] {
        if let Some(number) = number.as_ref().filter(|_| !gaussian) {
            return Err(source.fail(number.span(), key, "a key of filter = \"gaussian\""));
        }
    }
    if !gaussian {
        return Ok(Filter::Box);
    }
    let number = |number: &Option<Num>, key: &str, range, usual: Real| match number {
        Some(number) => within(source, number, key, range),
        None => Ok(usual),
    };
    let four = Wide::from_num(4);
    Ok(Filter::Gaussian {
        deviation: number(&file.deviation, "deviation", (Wide::ONE >> 3, four), Real::ONE / 2)?,
        width: number(&file.width, "width", (Wide::ONE, four), Real::from_num(2))?,
    })
}
