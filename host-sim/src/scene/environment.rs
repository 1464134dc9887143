//! The surroundings of a surface in a scene file: a name, and tables for those who want other tones.

use attractor::num::{Real, Unit};
use attractor::trace::Environment;
use serde::Deserialize;
use toml::Spanned;

use crate::fail::Fail;
use crate::source::{Num, Source};

/// The environments that have a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Around {
    Gradient,
    Checkerboard,
    Plain,
}

/// The tones of a gradient, where they are not those of core's `Environment::SKY`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Sky {
    zenith: Option<Num>,
    horizon: Option<Num>,
    nadir: Option<Num>,
}

/// The squares, where they are not those of core's `Environment::CHECKERBOARD`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Board {
    bright: Option<Num>,
    dark: Option<Num>,
    horizon: Option<Num>,
    scale: Option<Num>,
    fade: Option<Num>,
}

/// What a file says about the surroundings.
#[derive(Debug)]
pub(super) struct Surroundings {
    pub(super) named: Option<Around>,
    pub(super) gradient: Option<Spanned<Sky>>,
    pub(super) checkerboard: Option<Spanned<Board>>,
}

impl Surroundings {
    /// The environment that is named, with the tones that the file changes.
    pub(super) fn compile(&self, source: &Source) -> Result<Environment, Fail> {
        let (sky, board) = (self.gradient.as_ref(), self.checkerboard.as_ref());
        let tone = |number: &Option<Num>, key: &str, usual: Unit| match number {
            None => Ok(usual),
            Some(number) => source
                .fixed::<Unit>(number, key)
                .ok()
                .filter(|tone| (Unit::ZERO..=Unit::ONE).contains(tone))
                .ok_or_else(|| source.fail(number.span(), key, "allowed is 0 to 1")),
        };
        let unused = |table: Option<std::ops::Range<usize>>, name: &str| match table {
            Some(span) => Err(source.fail(span, name, format!("environment is not {name:?}"))),
            None => Ok(()),
        };
        let named = self.named.unwrap_or(match board {
            Some(_) => Around::Checkerboard,
            None => Around::Gradient,
        });
        if named != Around::Gradient {
            unused(sky.map(Spanned::span), "gradient")?;
        }
        if named != Around::Checkerboard {
            unused(board.map(Spanned::span), "checkerboard")?;
        }
        match (named, Environment::SKY, Environment::CHECKERBOARD) {
            (Around::Gradient, Environment::Gradient { zenith, horizon, nadir }, _) => match sky {
                None => Ok(Environment::SKY),
                Some(sky) => Ok(Environment::Gradient {
                    zenith: tone(&sky.get_ref().zenith, "gradient.zenith", zenith)?,
                    horizon: tone(&sky.get_ref().horizon, "gradient.horizon", horizon)?,
                    nadir: tone(&sky.get_ref().nadir, "gradient.nadir", nadir)?,
                }),
            },
            (Around::Checkerboard, _, Environment::Checkerboard { bright, dark, horizon, scale, fade }) => {
                let Some(board) = board.map(Spanned::get_ref) else { return Ok(Environment::CHECKERBOARD) };
                let scale = match &board.scale {
                    None => scale,
                    Some(number) => {
                        let key = "checkerboard.scale";
                        let given = source.fixed::<Real>(number, key)?;
                        if given < Real::ONE >> 6 || given > 64 {
                            return Err(source.fail(number.span(), key, "allowed is 0.015625 to 64"));
                        }
                        given
                    }
                };
                let faded = tone(&board.fade, "checkerboard.fade", fade)?;
                if let Some(number) = board.fade.as_ref().filter(|_| faded < Unit::ONE >> 6) {
                    return Err(source.fail(number.span(), "checkerboard.fade", "allowed is 0.015625 to 1"));
                }
                Ok(Environment::Checkerboard {
                    bright: tone(&board.bright, "checkerboard.bright", bright)?,
                    dark: tone(&board.dark, "checkerboard.dark", dark)?,
                    horizon: tone(&board.horizon, "checkerboard.horizon", horizon)?,
                    scale,
                    fade: faded,
                })
            }
            _ => Ok(Environment::Plain(Unit::ZERO)),
        }
    }
}
