//! `kind = "l-system"`: a word that is rewritten again and again, and drawn by a turtle.

use std::collections::BTreeMap;
use std::convert::Infallible;

use attractor::Error;
use attractor::curve::LSystem;
use attractor::num::Wide;
use attractor_gallery::{LSystemPicture, Pencil, Watch};
use embedded_graphics::draw_target::DrawTarget;
use serde::Deserialize;
use toml::Spanned;

use super::curve::vertices;
use super::request::Request;
use crate::cli::MAX_POINTS;
use crate::color::Depth;
use crate::fail::Fail;
use crate::palette::Named;
use crate::source::{Num, Source};
use crate::table::Csv;

/// Room for rewritings and for open brackets.
const ORDERS: usize = 32;
const BRANCHES: usize = 128;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(rename = "kind")]
    _kind: String,
    #[serde(rename = "title")]
    _title: Option<String>,
    axiom: Spanned<String>,
    rules: Option<BTreeMap<String, Spanned<String>>>,
    angle: Num,
    heading: Option<Num>,
    order: Spanned<i64>,
    palette: Option<Named>,
}

/// An L-system ready to be drawn.
#[derive(Debug)]
pub(crate) struct LSystemScene {
    pub(crate) axiom: String,
    pub(crate) rules: Vec<(char, String)>,
    pub(crate) angle: Wide,
    pub(crate) heading: Wide,
    pub(crate) order: u32,
    pub(crate) pencil: Pencil,
}

impl LSystemScene {
    pub(super) fn load(source: &Source) -> Result<Self, Fail> {
        let file: File = source.parse()?;
        let mut rules = Vec::new();
        for (key, word) in file.rules.iter().flatten() {
            let mut letters = key.chars();
            let (Some(letter), None) = (letters.next(), letters.next()) else {
                let reason = format!("a rule is for one letter, A to Z or a to z, not for {key:?}");
                return Err(source.fail(word.span(), &format!("rules.{key}"), reason));
            };
            rules.push((letter, word.get_ref().clone()));
        }
        let angle = source.fixed(&file.angle, "angle")?;
        let heading = match &file.heading {
            Some(heading) => source.fixed(heading, "heading")?,
            None => Wide::ZERO,
        };
        let pencil = Pencil { palette: file.palette.unwrap_or(Named::Moss), closed: false };
        let mut scene = Self { axiom: file.axiom.get_ref().clone(), rules, angle, heading, order: 0, pencil };
        // what the kernel says against a word
        scene.with(|_| Ok(())).map_err(|error| {
            let rule = match error {
                Error::Character { index: Some(index), .. } => file.rules.iter().flatten().nth(index),
                _ => None,
            };
            match (rule, &error) {
                (Some((key, word)), _) => source.fail(word.span(), &format!("rules.{key}"), error),
                (None, Error::Character { .. }) => source.fail(file.axiom.span(), "axiom", error),
                _ => source.fail_all("rules", error),
            }
        })?;
        // and against the order
        let allowed = |reason: &dyn std::fmt::Display| source.fail(file.order.span(), "order", reason);
        scene.order = u32::try_from(*file.order.get_ref())
            .map_err(|_| allowed(&format!("allowed is 0 to {ORDERS}")))?;
        let (steps, is_blank) = scene
            .with(|picture| picture.path().map(|path| (path.steps(), path.take(1).count() == 0)))
            .map_err(|error| allowed(&error))?;
        if steps > MAX_POINTS {
            return Err(allowed(&format!("{steps} steps, at most {MAX_POINTS} are drawn")));
        }
        if is_blank {
            return Err(allowed(&"the word has no letter that draws, F or G"));
        }
        Ok(scene)
    }

    fn with<T>(
        &self,
        show: impl FnOnce(LSystemPicture<'_, ORDERS, BRANCHES>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let rules: Vec<(char, &str)> =
            self.rules.iter().map(|(letter, word)| (*letter, word.as_str())).collect();
        let system = LSystem::new(&self.axiom, &rules, self.angle)?.with_heading(self.heading);
        show(LSystemPicture { system, order: self.order, pencil: self.pencil })
    }

    /// How many brackets are open at once.
    pub(crate) fn branches(&self) -> usize {
        let walk = self.with(|picture| picture.system.path::<ORDERS, 0>(self.order).map(|_| ()));
        match walk {
            Err(Error::Capacity { needed, .. }) => needed,
            _ => 0,
        }
    }

    pub(super) fn draw<D>(&self, request: &Request, target: &mut D, watch: Watch<'_, D>) -> Result<(), Fail>
    where
        D: DrawTarget<Error = Infallible>,
        D::Color: Depth,
    {
        self.with(|picture| picture.draw(request.size, target, watch)).map_err(Fail::new)
    }

    /// `x,y` of the first points.
    pub(super) fn sample(&self, points: u32, out: &mut Csv) -> Result<(), Fail> {
        self.with(|picture| Ok(vertices(picture.path()?, points, out))).map_err(Fail::new)?
    }
}
