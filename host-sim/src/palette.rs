//! Palettes by name: the colours of core's draw room for a scene file.

use attractor::draw::{Brightened, Cycled, Level, Leveled, Palette, hex};
pub(crate) use attractor_gallery::Named;
use embedded_graphics::pixelcolor::Rgb888;
use toml::Spanned;

use crate::fail::Fail;
use crate::source::Source;

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

impl<V: Leveled> Palette<V> for Colors {
    fn rgb(&self, value: V) -> Rgb888 {
        if value.is_inside() {
            return self.inside;
        }
        let named = |level: Level| self.named.at(level);
        match self.cycle {
            Some(period) => Cycled::new(named, period).rgb(value),
            None if self.lift => Brightened(named).rgb(value),
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
