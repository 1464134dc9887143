//! Palettes by name.

use attractor::draw::{CourseUnit, Gradient, Grey, Level, Leveled, Palette, gradients};
use embedded_graphics::pixelcolor::Rgb888;

/// The palettes that have a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize), serde(rename_all = "kebab-case"))]
#[expect(missing_docs, reason = "the names are those of core's palettes")]
pub enum Named {
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
    pub fn at(self, level: Level) -> Rgb888 {
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

impl<V: Leveled> Palette<V> for Named {
    #[inline]
    fn rgb(&self, value: V) -> Rgb888 {
        self.at(value.level())
    }
}
