//! Palettes by name: the colours of core's draw room for a scene file.

use attractor::draw::{CourseUnit, Cycled, Gradient, Grey, Level, Leveled, Lifted, Palette, gradients, hex};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use serde::Deserialize;
use toml::Spanned;

use crate::fail::Fail;
use crate::source::Source;

/// The palettes that have a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Named {
    CourseUnit,
    Grey,
    Dusk,
    Fire,
    Ocean,
    Moss,
    Even,
    Porcelain,
}

impl Named {
    /// The colour of a level.
    pub(crate) fn at(self, level: Level) -> Rgb888 {
        fn on<const N: usize>(gradient: &Gradient<N>, level: Level) -> Rgb888 {
            gradient.at(level)
        }
        match self {
            Self::CourseUnit => CourseUnit.rgb(level),
            Self::Grey => Grey.rgb(level),
            Self::Dusk => on(&gradients::DUSK, level),
            Self::Fire => on(&gradients::FIRE, level),
            Self::Ocean => on(&gradients::OCEAN, level),
            Self::Moss => on(&gradients::MOSS, level),
            Self::Even => on(&gradients::EVEN, level),
            Self::Porcelain => on(&gradients::PORCELAIN, level),
        }
    }
}

/// A palette with what a scene may ask of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Colors {
    pub(crate) named: Named,
    /// The square root of the level: spreads the low ones.
    pub(crate) lift: bool,
    /// Once round every so many counts.
    pub(crate) cycle: Option<u32>,
    /// The inside of the set.
    pub(crate) inside: Rgb888,
}

impl Colors {
    /// A palette as it is, black inside.
    pub(crate) const fn plain(named: Named) -> Self {
        Self { named, lift: false, cycle: None, inside: Rgb888::BLACK }
    }
}

impl<V: Leveled> Palette<V> for Colors {
    fn rgb(&self, value: V) -> Rgb888 {
        if value.is_inside() {
            return self.inside;
        }
        let named = |level: Level| self.named.at(level);
        match self.cycle {
            Some(period) => Cycled::new(named, period).rgb(value),
            None if self.lift => Lifted(named).rgb(value),
            None => named(value.level()),
        }
    }
}

/// `"#rrggbb"`.
pub(crate) fn color(source: &Source, key: &str, text: &Spanned<String>) -> Result<Rgb888, Fail> {
    let digits = text.get_ref().strip_prefix('#').filter(|d| d.len() == 6 && d.is_ascii());
    match digits.and_then(|d| u32::from_str_radix(d, 16).ok()) {
        Some(rgb) => Ok(hex(rgb)),
        None => Err(source.fail(text.span(), key, "a colour is \"#rrggbb\"")),
    }
}
