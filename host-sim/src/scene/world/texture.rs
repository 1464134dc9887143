//! The textures of a world as its file has them.

use serde::Deserialize;
use toml::Spanned;

use crate::fail::Fail;
use crate::source::Source;

/// A table `[texture.NAME]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Woven {
    kind: Spanned<String>,
}

/// A texture in numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pattern {}

impl Pattern {
    pub(super) fn load(source: &Source, name: &str, given: &Spanned<Woven>) -> Result<Self, Fail> {
        let _ = (source, name, given.get_ref().kind.get_ref());
        Ok(Self {})
    }
}
