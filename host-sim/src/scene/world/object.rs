//! The objects of a world as its file has them: names, shapes, compounds, where they stand and what they are
//! made of.

use std::fmt;
use std::ops::Range;

use serde::Deserialize;
use serde::de::{Deserializer, SeqAccess, Visitor};
use toml::Spanned;

use super::super::function::Description;
use super::placement::{Keys, Scale};
use crate::fail::Fail;
use crate::source::{Num, Source};

/// A table `[[object]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Thing {
    pub(super) name: Option<Spanned<String>>,
    pub(super) shape: Spanned<Form>,
    pub(super) scale: Option<Spanned<Scale>>,
    pub(super) rotate: Option<Spanned<Vec<Spanned<Vec<Num>>>>>,
    pub(super) translate: Option<Spanned<[Num; 3]>>,
    pub(super) matrix: Option<Spanned<Vec<Num>>>,
    pub(super) material: Option<Spanned<Names>>,
    pub(super) of: Option<Spanned<Vec<Spanned<String>>>>,
    pub(super) points: Option<Spanned<Vec<Spanned<[Num; 3]>>>>,
    pub(super) planes: Option<Spanned<Vec<Spanned<[Num; 4]>>>>,
    pub(super) cap: Option<Num>,
    pub(super) tube: Option<Num>,
    pub(super) n: Option<Num>,
    pub(super) m: Option<Num>,
    pub(super) f: Option<Spanned<Description>>,
    pub(super) g: Option<Spanned<Description>>,
}

/// What `shape` may say.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Form {
    Plane,
    Square,
    Polygon,
    Sphere,
    Cube,
    Polyhedron,
    TaperedCylinder,
    Torus,
    Superellipsoid,
    HeightField,
    Union,
    Intersection,
    Difference,
}

impl Form {
    /// As files write it, and the keys that it has besides those of every object.
    fn keys(self) -> (&'static str, &'static [&'static str]) {
        match self {
            Self::Plane => ("plane", &[]),
            Self::Square => ("square", &[]),
            Self::Polygon => ("polygon", &["points"]),
            Self::Sphere => ("sphere", &[]),
            Self::Cube => ("cube", &[]),
            Self::Polyhedron => ("polyhedron", &["planes"]),
            Self::TaperedCylinder => ("tapered-cylinder", &["cap"]),
            Self::Torus => ("torus", &["tube"]),
            Self::Superellipsoid => ("superellipsoid", &["n", "m"]),
            Self::HeightField => ("height-field", &["f", "g"]),
            Self::Union => ("union", &["of"]),
            Self::Intersection => ("intersection", &["of"]),
            Self::Difference => ("difference", &["of"]),
        }
    }
}

/// A name, or one for each face.
#[derive(Debug, Clone)]
pub(super) enum Names {
    One(String),
    Each(Vec<Spanned<String>>),
}

impl<'de> Deserialize<'de> for Names {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Either;
        impl<'de> Visitor<'de> for Either {
            type Value = Names;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the name of a material, or a list of names, one a face")
            }
            fn visit_str<E>(self, name: &str) -> Result<Names, E> {
                Ok(Names::One(name.to_owned()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut names: A) -> Result<Names, A::Error> {
                let mut each = Vec::new();
                while let Some(name) = names.next_element()? {
                    each.push(name);
                }
                Ok(Names::Each(each))
            }
        }
        deserializer.deserialize_any(Either)
    }
}

/// The names of a list, or the one name, each with its place.
pub(super) fn each(names: &Spanned<Names>) -> Vec<Spanned<String>> {
    match names.get_ref() {
        Names::One(name) => vec![Spanned::new(names.span(), name.clone())],
        Names::Each(each) => each.clone(),
    }
}

impl Thing {
    /// What messages call it, with a dot at the end.
    pub(crate) fn prefix(&self, index: usize) -> String {
        match &self.name {
            Some(name) => format!("{}.", name.get_ref()),
            None => format!("object[{index}]."),
        }
    }

    /// The keys that say where it stands.
    pub(super) fn placement(&self) -> Keys<'_> {
        Keys {
            scale: self.scale.as_ref(),
            rotate: self.rotate.as_ref(),
            translate: self.translate.as_ref(),
            matrix: self.matrix.as_ref(),
        }
    }

    /// Its own keys that the file gives, with their places.
    fn given(&self) -> Vec<(&'static str, Range<usize>)> {
        fn entry<T>(name: &'static str, value: &Option<Spanned<T>>) -> Option<(&'static str, Range<usize>)> {
            value.as_ref().map(|value| (name, value.span()))
        }
        [
            entry("of", &self.of),
            entry("points", &self.points),
            entry("planes", &self.planes),
            entry("cap", &self.cap),
            entry("tube", &self.tube),
            entry("n", &self.n),
            entry("m", &self.m),
            entry("f", &self.f),
            entry("g", &self.g),
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// Complains about a key of another shape, and about one that is missing.
    pub(super) fn check_keys(&self, source: &Source, prefix: &str) -> Result<(), Fail> {
        let (form, keys) = self.shape.get_ref().keys();
        let given = self.given();
        for (key, span) in &given {
            if !keys.contains(key) {
                let reason = format!("no key of shape = {form:?}");
                return Err(source.fail(span.clone(), &format!("{prefix}{key}"), reason));
            }
        }
        let optional = ["cap"];
        for key in keys.iter().filter(|key| !optional.contains(key)) {
            if !given.iter().any(|(name, _)| name == key) {
                let reason = format!("{key} is missing");
                return Err(source.fail(self.shape.span(), &format!("{prefix}shape"), reason));
            }
        }
        Ok(())
    }
}
