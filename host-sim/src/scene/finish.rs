//! What a height field in tones is made of, and how finely its normals are integrated.

use attractor::num::Unit;
use attractor::trace::{Finish, Quality};
use serde::Deserialize;
use toml::Spanned;

use crate::fail::Fail;
use crate::source::{Num, Source};

/// The materials that have a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Named {
    Diffuse,
    Phong,
    TorranceSparrow,
    Mirror,
}

/// The numbers of a Torrance-Sparrow highlight, where they are not those of core's
/// `Finish::TORRANCE_SPARROW`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Mirrors {
    roughness: Option<Num>,
    reflectance: Option<Num>,
}

/// What a file says about the material.
#[derive(Debug)]
pub(super) struct Made {
    pub(super) named: Option<Named>,
    pub(super) torrance_sparrow: Option<Spanned<Mirrors>>,
}

impl Made {
    pub(super) fn compile(&self, source: &Source) -> Result<Finish, Fail> {
        let table = self.torrance_sparrow.as_ref();
        let named = self.named.unwrap_or(match table {
            Some(_) => Named::TorranceSparrow,
            None => Named::Diffuse,
        });
        if let Some(table) = table.filter(|_| named != Named::TorranceSparrow) {
            let reason = "material is not \"torrance-sparrow\"";
            return Err(source.fail(table.span(), "torrance-sparrow", reason));
        }
        let finish = match named {
            Named::Diffuse => Finish::DIFFUSE,
            Named::Phong => Finish::PHONG,
            Named::TorranceSparrow => Finish::TORRANCE_SPARROW,
            Named::Mirror => Finish::Mirror,
        };
        let Finish::TorranceSparrow { ambient, diffuse, specular, roughness, reflectance } = finish else {
            return Ok(finish);
        };
        let given = |of: fn(&Mirrors) -> &Option<Num>, key: &str, usual: Unit, least: Unit| {
            let Some(number) = table.and_then(|table| of(table.get_ref()).as_ref()) else { return Ok(usual) };
            let value = source.fixed::<Unit>(number, key).ok();
            value
                .filter(|value| (least..=Unit::ONE).contains(value))
                .ok_or_else(|| source.fail(number.span(), key, format!("allowed is {least} to 1")))
        };
        let least = Unit::ONE >> 5;
        let roughness = given(|m| &m.roughness, "torrance-sparrow.roughness", roughness, least)?;
        let reflectance = given(|m| &m.reflectance, "torrance-sparrow.reflectance", reflectance, Unit::ZERO)?;
        Ok(Finish::TorranceSparrow { ambient, diffuse, specular, roughness, reflectance })
    }
}

/// The table `[filter]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Filtering {
    quality: Level,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Level {
    Coarse,
    Fine,
    Finest,
}

impl Filtering {
    pub(super) fn quality(&self) -> Quality {
        match self.quality {
            Level::Coarse => Quality::Coarse,
            Level::Fine => Quality::Fine,
            Level::Finest => Quality::Finest,
        }
    }
}
