//! The lights of a world: `towards` for one that is infinitely far away, or `at` for one that stands at a
//! place.

use attractor::num::{Rgb, Vec3};
use attractor::trace::world::Lamp;
use embedded_graphics::geometry::Size;
use serde::Deserialize;
use toml::Spanned;

use super::super::orbit::carried;
use super::super::standpoint::vector;
use super::color::{Color, light};
use crate::fail::Fail;
use crate::source::{Num, Source};

/// How many times as bright as white a light may be.
const BRIGHTEST: u16 = 64;

/// A table `[[light]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Shining {
    towards: Option<Spanned<[Num; 3]>>,
    at: Option<Spanned<[Num; 3]>>,
    color: Option<Spanned<Color>>,
}

/// Where a lamp is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Stand {
    Towards(Vec3),
    At(Vec3),
}

/// A lamp in numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Light {
    pub(crate) stand: Stand,
    pub(crate) color: Rgb,
}

impl Light {
    pub(super) fn load(
        source: &Source,
        given: &Spanned<Shining>,
        index: usize,
        eye: Vec3,
    ) -> Result<Self, Fail> {
        let key = |name: &str| format!("light[{index}].{name}");
        let table = given.get_ref();
        let color = match &table.color {
            Some(color) => light(source, color, &key("color"), BRIGHTEST)?,
            None => Rgb::WHITE,
        };
        let stand = match (&table.towards, &table.at) {
            (Some(towards), None) => Stand::Towards(vector(source, towards, &key("towards"))?),
            (None, Some(at)) => Stand::At(vector(source, at, &key("at"))?),
            _ => {
                let reason = "a light has either towards, a direction, or at, a place";
                return Err(source.fail(given.span(), &format!("light[{index}]"), reason));
            }
        };
        if let (Stand::At(place), Some(at)) = (stand, &table.at)
            && place == eye
        {
            return Err(source.fail(at.span(), &key("at"), "the camera stands there"));
        }
        let light = Self { stand, color };
        // the kernel says which directions it takes
        light.lamp().map_err(|error| {
            source.fail(table.towards.as_ref().map_or(given.span(), Spanned::span), &key("towards"), error)
        })?;
        Ok(light)
    }

    /// Carries it round a place, or round the world where it is infinitely far away.
    pub(super) fn carry(&mut self, about: Vec3, pan: [i32; 2], size: Size) {
        self.stand = match self.stand {
            Stand::Towards(towards) => Stand::Towards(carried(towards, Vec3::default(), pan, size)),
            Stand::At(at) => Stand::At(carried(at, about, pan, size)),
        };
    }

    /// As a table of a scene file.
    pub(super) fn place(&self) -> String {
        let (key, Vec3 { x, y, z }) = match self.stand {
            Stand::Towards(towards) => ("towards", towards),
            Stand::At(at) => ("at", at),
        };
        let Rgb { r, g, b } = self.color;
        format!("[[light]]\n{key} = [{x}, {y}, {z}]\ncolor = [{r}, {g}, {b}]\n")
    }

    /// As core has it.
    pub(crate) fn lamp(&self) -> Result<Lamp, attractor::Error> {
        match self.stand {
            Stand::Towards(towards) => Lamp::distant(towards, self.color),
            Stand::At(at) => Ok(Lamp::point(at, self.color)),
        }
    }
}
