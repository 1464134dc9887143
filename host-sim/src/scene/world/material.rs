//! The materials of a world as its file has them: the five components of the text, a model of highlights, a
//! medium, bumps and a grain.

use std::collections::BTreeMap;

use attractor::num::{Real, Rgb, Unit, Wide};
use attractor::trace::material::{Anisotropic, Clear, Highlight, Medium, Mixture, Phong, TorranceSparrow};
use serde::Deserialize;
use toml::Spanned;

use super::color::{Color, light, light_or};
use crate::builtin;
use crate::fail::Fail;
use crate::slopes::Slopes;
use crate::source::{Num, Source};

/// A table `[material.NAME]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Made {
    color: Option<Spanned<Color>>,
    texture: Option<Spanned<String>>,
    ambient: Option<Num>,
    diffuse: Option<Num>,
    specular: Option<Spanned<Color>>,
    model: Option<Spanned<Model>>,
    shininess: Option<Spanned<i64>>,
    roughness: Option<Num>,
    across: Option<Num>,
    reflectance: Option<Num>,
    distribution: Option<Spanned<String>>,
    reflect: Option<Spanned<Color>>,
    transmit: Option<Spanned<Color>>,
    index: Option<Num>,
    fresnel: Option<Spanned<bool>>,
    priority: Option<Spanned<i64>>,
    bump: Option<Spanned<Relief>>,
    frame: Option<Spanned<Relief>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Model {
    Phong,
    TorranceSparrow,
    Anisotropic,
    Tabulated,
}

/// What moves normals or turns the grain, and by how much.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Relief {
    texture: Spanned<String>,
    strength: Option<Num>,
}

/// What colours a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Colored {
    Color(Rgb),
    /// By number.
    Texture(usize),
}

/// A model of highlights in numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Gloss {
    None,
    Phong { shininess: u16 },
    TorranceSparrow { roughness: Unit, reflectance: Unit },
    Anisotropic { along: Unit, across: Unit },
    Tabulated { slopes: Slopes, reflectance: Unit },
}

impl Gloss {
    /// As core has it.
    pub(crate) fn highlight(&self) -> Result<Highlight<'_>, attractor::Error> {
        Ok(match *self {
            Self::None => Highlight::None,
            Self::Phong { shininess } => Highlight::Phong(Phong { shininess }),
            Self::TorranceSparrow { roughness, reflectance } => {
                Highlight::TorranceSparrow(TorranceSparrow::new(roughness, reflectance)?)
            }
            Self::Anisotropic { along, across } => Highlight::Anisotropic(Anisotropic::new(along, across)?),
            Self::Tabulated { ref slopes, reflectance } => Highlight::Tabulated(slopes.model(reflectance)?),
        })
    }
}

/// A material in numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Matter {
    pub(crate) name: String,
    pub(crate) pigment: Colored,
    pub(crate) ambient: Unit,
    pub(crate) diffuse: Unit,
    pub(crate) specular: Rgb,
    pub(crate) gloss: Gloss,
    pub(crate) reflect: Rgb,
    pub(crate) transmit: Rgb,
    pub(crate) medium: Option<Medium>,
    /// Number of the texture, and how much of it.
    pub(crate) bump: Option<(usize, Real)>,
    pub(crate) frame: Option<(usize, Real)>,
}

impl Matter {
    /// White and matt: of what an object is made that names nothing.
    pub(super) fn plain() -> Self {
        Self {
            name: String::new(),
            pigment: Colored::Color(Rgb::WHITE),
            ambient: Unit::ONE / 8,
            diffuse: Unit::ONE / 8 * 7,
            specular: Rgb::BLACK,
            gloss: Gloss::None,
            reflect: Rgb::BLACK,
            transmit: Rgb::BLACK,
            medium: None,
            bump: None,
            frame: None,
        }
    }

    /// With this pigment, as core has it.
    pub(crate) fn mixture<T>(
        &self,
        pigment: T,
    ) -> Result<Mixture<T, Highlight<'_>, Option<Clear>>, attractor::Error> {
        let mixture = Mixture::matt(pigment)
            .with_parts(self.ambient, self.diffuse)?
            .with_highlight(self.specular, self.gloss.highlight()?)
            .with_reflection(self.reflect);
        let clear = self.medium.map(|medium| Clear::new(medium, self.transmit)).transpose()?;
        Ok(mixture.with_interior(clear))
    }

    pub(super) fn load(
        source: &Source,
        name: &str,
        given: &Made,
        textures: &BTreeMap<&str, usize>,
    ) -> Result<Self, Fail> {
        let key = |key: &str| format!("material.{name}.{key}");
        let part = |number: &Option<Num>, name: &str, usual: Unit| match number {
            None => Ok(usual),
            Some(number) => within(source, number, &key(name), (Wide::ZERO, Wide::ONE)),
        };
        let texture = |name: &Spanned<String>, key: &str| match textures.get(name.get_ref().as_str()) {
            Some(number) => Ok(*number),
            None => Err(source.fail(name.span(), key, "there is no texture of this name")),
        };
        let pigment = match (&given.color, &given.texture) {
            (Some(_), Some(texture)) => {
                return Err(source.fail(
                    texture.span(),
                    &key("texture"),
                    "a material has a color or a texture",
                ));
            }
            (None, Some(name)) => Colored::Texture(texture(name, &key("texture"))?),
            (color, None) => Colored::Color(light_or(source, color.as_ref(), &key("color"), Rgb::WHITE)?),
        };
        let medium = medium(source, given, &key)?;
        // glass that says nothing else is clear
        let plain = Self::plain();
        let (ambient, diffuse) = match medium {
            Some(_) => (Unit::ZERO, Unit::ZERO),
            None => (plain.ambient, plain.diffuse),
        };
        let relief = |relief: &Option<Spanned<Relief>>, name: &str| -> Result<Option<(usize, Real)>, Fail> {
            let Some(relief) = relief.as_ref().map(Spanned::get_ref) else { return Ok(None) };
            let number = texture(&relief.texture, &key(&format!("{name}.texture")))?;
            let strength = match &relief.strength {
                Some(strength) => source.fixed::<Real>(strength, &key(&format!("{name}.strength")))?,
                None => Real::ONE,
            };
            Ok(Some((number, strength)))
        };
        Ok(Self {
            name: name.to_owned(),
            pigment,
            ambient: part(&given.ambient, "ambient", ambient)?,
            diffuse: part(&given.diffuse, "diffuse", diffuse)?,
            specular: match &given.specular {
                Some(color) => light(source, color, &key("specular"), 1)?,
                None if given.model.is_some() || given.distribution.is_some() => Rgb::WHITE,
                None => Rgb::BLACK,
            },
            gloss: gloss(source, given, &key)?,
            reflect: light_or(source, given.reflect.as_ref(), &key("reflect"), Rgb::BLACK)?,
            transmit: light_or(source, given.transmit.as_ref(), &key("transmit"), Rgb::WHITE)?,
            medium,
            bump: relief(&given.bump, "bump")?,
            frame: relief(&given.frame, "frame")?,
        })
    }
}

/// A number in a range that the text of a complaint names.
pub(super) fn within<F>(source: &Source, number: &Num, key: &str, (min, max): (Wide, Wide)) -> Result<F, Fail>
where
    F: attractor::fixed::traits::Fixed + std::str::FromStr,
{
    let fits = source.fixed::<Wide>(number, key).ok().filter(|wide| (min..=max).contains(wide));
    fits.and_then(|_| source.fixed::<F>(number, key).ok())
        .ok_or_else(|| source.fail(number.span(), key, format!("allowed is {min} to {max}")))
}

/// The highlight that the keys describe. Keys of another model are refused.
fn gloss(source: &Source, given: &Made, key: &dyn Fn(&str) -> String) -> Result<Gloss, Fail> {
    let model = given.model.as_ref().map(|model| *model.get_ref());
    let default = match (&given.distribution, &given.specular) {
        (Some(_), _) => Some(Model::Tabulated),
        (None, specular) => specular.is_some().then_some(Model::Phong),
    };
    let model = model.or(default);
    let unused = |name: &str, span: Option<std::ops::Range<usize>>, models: &[Model]| match span {
        Some(span) if !model.is_some_and(|model| models.contains(&model)) => {
            let names: Vec<&str> = models.iter().map(|model| model.name()).collect();
            Err(source.fail(span, &key(name), format!("a key of model = {}", names.join(" or "))))
        }
        _ => Ok(()),
    };
    let (rough, phong) = ([Model::TorranceSparrow, Model::Anisotropic], [Model::Phong]);
    let (mirrors, table) = ([Model::TorranceSparrow, Model::Tabulated], [Model::Tabulated]);
    unused("shininess", given.shininess.as_ref().map(Spanned::span), &phong)?;
    unused("roughness", given.roughness.as_ref().map(Spanned::span), &rough)?;
    unused("across", given.across.as_ref().map(Spanned::span), &rough[1..])?;
    unused("reflectance", given.reflectance.as_ref().map(Spanned::span), &mirrors)?;
    unused("distribution", given.distribution.as_ref().map(Spanned::span), &table)?;
    let rough = |number: &Option<Num>, name: &str, usual: Unit| match number {
        None => Ok(usual),
        Some(number) => within(source, number, &key(name), (Wide::ONE >> 5, Wide::ONE)),
    };
    let reflectance = || match &given.reflectance {
        None => Ok(Unit::ONE),
        Some(number) => within(source, number, &key("reflectance"), (Wide::ZERO, Wide::ONE)),
    };
    Ok(match model {
        None => Gloss::None,
        Some(Model::Phong) => {
            let shininess = match &given.shininess {
                None => 32,
                Some(given) => u16::try_from(*given.get_ref())
                    .ok()
                    .filter(|shininess| *shininess > 0)
                    .ok_or_else(|| source.fail(given.span(), &key("shininess"), "allowed is 1 to 65535"))?,
            };
            Gloss::Phong { shininess }
        }
        Some(Model::TorranceSparrow) => Gloss::TorranceSparrow {
            roughness: rough(&given.roughness, "roughness", Unit::ONE / 4)?,
            reflectance: reflectance()?,
        },
        Some(Model::Anisotropic) => Gloss::Anisotropic {
            along: rough(&given.roughness, "roughness", Unit::ONE / 8)?,
            across: rough(&given.across, "across", Unit::ONE / 2)?,
        },
        Some(Model::Tabulated) => {
            let Some(named) = &given.distribution else {
                let span = given.model.as_ref().map_or(0..0, Spanned::span);
                let reason = "distribution is missing, a table of slopes: `attractor brdf` writes it";
                return Err(source.fail(span, &key("model"), reason));
            };
            let slopes = distribution(source, named, &key("distribution"))?;
            Gloss::Tabulated { slopes, reflectance: reflectance()? }
        }
    })
}

/// A table of slopes: that of a built-in surface, or one in a file beside the scene.
fn distribution(source: &Source, named: &Spanned<String>, key: &str) -> Result<Slopes, Fail> {
    let name = named.get_ref();
    if let Some(text) = builtin::distribution(name) {
        return Slopes::load(&Source::built_in(name, text));
    }
    if !name.contains('.') {
        return Err(source.fail(named.span(), key, "allowed is f-x-f, g-x-g or the name of a file"));
    }
    let (name, text) = source.data(named, key)?;
    Slopes::load(&Source::named(name, text))
}

impl Model {
    fn name(self) -> &'static str {
        match self {
            Self::Phong => "\"phong\"",
            Self::TorranceSparrow => "\"torrance-sparrow\"",
            Self::Anisotropic => "\"anisotropic\"",
            Self::Tabulated => "\"tabulated\"",
        }
    }
}

/// What is inside, where the keys say that it is transparent.
fn medium(source: &Source, given: &Made, key: &dyn Fn(&str) -> String) -> Result<Option<Medium>, Fail> {
    let Some(index) = &given.index else {
        let others = [
            ("transmit", given.transmit.as_ref().map(Spanned::span)),
            ("fresnel", given.fresnel.as_ref().map(Spanned::span)),
            ("priority", given.priority.as_ref().map(Spanned::span)),
        ];
        return match others.into_iter().find_map(|(name, span)| Some((name, span?))) {
            Some((name, span)) => {
                Err(source.fail(span, &key(name), "what is transparent has an index of refraction: index"))
            }
            None => Ok(None),
        };
    };
    let refused = || source.fail(index.span(), &key("index"), "allowed is 0.1 to 10");
    let number: Real = source.fixed(index, &key("index")).map_err(|_| refused())?;
    let priority = match &given.priority {
        None => 0,
        Some(given) => u8::try_from(*given.get_ref())
            .map_err(|_| source.fail(given.span(), &key("priority"), "allowed is 0 to 255"))?,
    };
    let fresnel = given.fresnel.as_ref().is_none_or(|fresnel| *fresnel.get_ref());
    let medium = Medium { index: number, priority, fresnel };
    // the kernel says which indices it takes
    Clear::new(medium, Rgb::WHITE).map_err(|_| refused())?;
    Ok(Some(medium))
}
